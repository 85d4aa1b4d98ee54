"""Drawings by hand: what the gestures make of an empty sheet, and that it moves."""

from __future__ import annotations

from functools import reduce

from linkanim.build.building import Building, redo, undo
from linkanim.build.pointing import click, drag

FOUR_BAR = (
    ("click", 0, 0),
    ("click", 100, 0),
    ("drag", 0, 0, 50, 0),
    ("drag", 50, 0, 68, 83),
    ("drag", 68, 83, 100, 0),
)


def hand(building: Building, gesture: tuple[str | float, ...]) -> Building:
    """Return the building after a gesture as a tape has it."""
    name, *numbers = gesture
    points = [float(number) for number in numbers]
    act = {"click": click, "drag": drag}[str(name)]
    return act(building, "bar", *points, reach=3.0, snap=1.0)  # type: ignore[operator, no-any-return]


def test_a_four_bar_moves_after_its_last_bar() -> None:
    steps = [Building()]
    for gesture in FOUR_BAR:
        steps.append(hand(steps[-1], gesture))
    assert [step.made.scene is not None for step in steps] == [
        False,
        False,
        False,
        True,
        False,
        True,
    ]  # a crank alone moves
    scene = steps[-1].made.scene
    assert scene
    lengths = {joint.name: joint.lengths for joint in scene.linkage.joints}
    assert lengths == {"O2": (0, 0), "O4": (100, 0), "A": (50,), "B": (85, 89)}


def test_undo_goes_back_to_the_empty_sheet_and_redo_on_again() -> None:
    done = reduce(hand, FOUR_BAR, Building())
    back = reduce(lambda building, _: undo(building), FOUR_BAR, done)
    assert back.draft == Building().draft
    assert reduce(lambda building, _: redo(building), FOUR_BAR, back).draft == done.draft
