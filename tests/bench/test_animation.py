"""What matplotlib is made to animate: all that a scene holds, at each frame where it is."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from stand_ins import Axes, Saved, matplotlib

from linkanim.bench import animation
from linkanim.mechanics.motion import Motion
from linkanim.scenes import load

FRAMES = 10
STRUTS = ("CG", "HS")
BODIES = (("O2", "A", "O2"), ("A", "B", "H", "A"), ("B", "C", "B"), ("D", "B", "D"), ("O7", "D", "O7"))


@pytest.fixture
def cycle() -> Motion:
    return load("press").cycle(FRAMES)


def shown(cycle: Motion, frame: int) -> Iterator[list[tuple[float, float]]]:
    """Yield the points of each line of a frame: the traces with their last three tenths, then the rest."""
    course = {name: np.broadcast_to(place, (FRAMES, 2)) for name, place in cycle.position.items()}
    for joint in "BH":
        yield [tuple(place) for place in course[joint]]
        yield [tuple(course[joint][frame - before]) for before in (3, 2, 1, 0)]
    for joints in (*STRUTS, *BODIES, course):
        yield [tuple(course[joint][frame]) for joint in joints]


# A frame whose last ones lie in the turn before, and one in the middle.
@pytest.mark.parametrize("frame", [1, 7])
def test_each_thing_is_where_it_is_at_the_frame(frame: int, cycle: Motion) -> None:
    axes = Axes()
    updates = list(animation._drawn(axes, load("press"), cycle))
    for number in (0, frame):
        for update in updates:
            update(number)
        assert [line.points for line in axes.lines] == list(shown(cycle, number))
        for joint, arrow in zip("BH", axes.arrows, strict=True):
            assert np.array_equal(arrow.offset, cycle.position[joint][number])
            assert np.array_equal(arrow.velocity, cycle.velocity[joint][number])


def test_the_first_frame_is_drawn_from_the_start(cycle: Motion) -> None:
    axes = Axes()
    list(animation._drawn(axes, load("press"), cycle))
    drawn = [line.points for line in axes.lines]
    first = list(shown(cycle, 0))
    assert (drawn[0], drawn[2], drawn[4:]) == (first[0], first[2], first[4:])
    for joint, arrow in zip("BH", axes.arrows, strict=True):
        assert arrow.offset == tuple(cycle.position[joint][0])
        assert arrow.velocity == tuple(cycle.velocity[joint][0])


def test_a_margin_lies_around_all_places_and_the_longest_arrow_is_a_fifth_of_the_height(
    cycle: Motion,
) -> None:
    axes = Axes()
    list(animation._drawn(axes, load("press"), cycle))
    places = np.concatenate([np.reshape(place, (-1, 2)) for place in cycle.position.values()])
    low, high = places.min(axis=0), places.max(axis=0)
    margin = 0.08 * (high - low).max()
    assert (*axes.x, *axes.y) == pytest.approx(
        (low[0] - margin, high[0] + margin, low[1] - margin, high[1] + margin)
    )
    fastest = np.hypot(*cycle.velocity["B"].T).max()
    assert fastest / axes.arrows[0].scale == pytest.approx(0.2 * (axes.y[1] - axes.y[0]))


def test_a_scene_is_saved_at_the_size_and_pace_of_a_recording(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, cycle: Motion
) -> None:
    saved: list[Saved] = []
    for module in matplotlib(saved):
        monkeypatch.setitem(sys.modules, module.__name__, module)
    scene = load("press")
    animation.animate(scene, tmp_path / "out.gif", size=(320, 180), frames=FRAMES, fps=25.0)
    (made,) = saved
    assert made.sheet.size == pytest.approx((320, 180))
    assert made.sheet.titles == [scene.title]
    assert (made.target, made.interval, made.fps) == (tmp_path / "out.gif", 40.0, 25)
    for number, lines in enumerate(made.shown):
        assert [line.points for line in lines] == list(shown(cycle, number))
    assert len(made.shown) == FRAMES


def test_its_time_is_that_of_the_animation_and_none_without_matplotlib(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    asked: list[tuple[str, str, dict[str, object]]] = []
    clock = iter([10.0, 13.0])
    monkeypatch.setattr(animation, "time", SimpleNamespace(perf_counter=lambda: next(clock)))
    monkeypatch.setattr(
        animation,
        "animate",
        lambda scene, target, **options: asked.append((scene.name, target.name, options)),
    )
    options = {"size": (320, 180), "frames": 4, "fps": 25.0}
    monkeypatch.setattr(animation, "find_spec", lambda name: object() if name == "matplotlib" else None)
    assert animation.animation_seconds("press", size=(320, 180), frames=4, fps=25.0) == 3.0
    assert asked == [("press", "out.gif", options)]
    monkeypatch.setattr(animation, "find_spec", lambda name: None)
    assert animation.animation_seconds("press", size=(320, 180), frames=4, fps=25.0) is None
    assert len(asked) == 1
