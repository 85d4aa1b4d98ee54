"""Whatever a scene's solver raises, the window runs on with the last good linkage and writes a report."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pygame
import pytest
from playing import Player

from linkanim.mechanics.program import Batch
from linkanim.picture.picture import Picture
from linkanim.picture.surface import SurfacePrinter
from linkanim.player.action import Action
from linkanim.player.actions import ACTIONS, advance
from linkanim.player.state import State, begin
from linkanim.scenes import load
from linkanim.scenes.scene import Scene

pytestmark = pytest.mark.withstands("faults survived")

# What arithmetic can raise where a solver has a hole.
HOLES = [
    ZeroDivisionError("float division by zero"),
    ValueError("math domain error"),
    OverflowError("math range error"),
    np.linalg.LinAlgError("singular"),
    FloatingPointError("underflow"),
    IndexError("tuple index out of range"),
    RecursionError("too deep"),
    AssertionError(),
]


def raising(error: Exception) -> Callable[..., Any]:
    def fail(*_: object, **__: object) -> Any:
        raise type(error)(*error.args)

    return fail


def broken(scene: Scene, error: Exception, monkeypatch: pytest.MonkeyPatch) -> None:
    """Let every scene but this one fail as soon as its facts are asked for."""
    usual_info = Scene.info.func  # type: ignore[attr-defined]

    def info(self: Scene) -> object:
        if self == scene:
            return usual_info(self)
        raise type(error)(*error.args)

    monkeypatch.setattr(Scene, "info", property(info))


@pytest.fixture
def crank() -> State:
    """The crank-rocker's list, standing at its crank."""
    state = begin(load("crank-rocker"))
    return advance(advance(state, [Action("edit")]), [Action("choose", 1)])


@pytest.mark.parametrize("error", HOLES, ids=lambda error: type(error).__name__)
def test_a_value_at_which_the_solver_fails_is_refused_in_a_sentence(
    crank: State, error: Exception, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("linkanim.player.edits.with_dimensions", raising(error))
    state = advance(advance(crank, [Action("type", "47")]), [Action("accept")])
    assert state.scene is crank.scene
    assert type(error).__name__ in str(state.editing.refusal)
    assert "the last good linkage runs on" in str(state.editing.refusal)
    assert [effect.name for effect in state.effects] == ["report"]


# Every way to another scene, and where the scene it leads to is worked out.
WAYS = {
    "a value taken": (Action("accept"), None),
    "a nudge": (Action("nudge", 1), None),
    "the other closure": (Action("closure"), None),
    "Tab": (Action("mechanism", 1), None),
    "a number": (Action("select", 3), None),
    "an unreadable scene": (Action("mechanism", 1), "linkanim.player.edits.load"),
    "a closure that cannot be worked out": (
        Action("closure"),
        "linkanim.player.edits.other_closure",
    ),
}


@pytest.mark.parametrize(("action", "place"), WAYS.values(), ids=WAYS)
def test_a_scene_that_fails_is_not_put_on(
    crank: State, action: Action, place: str | None, monkeypatch: pytest.MonkeyPatch
) -> None:
    crank = advance(crank, [Action("type", "47")])
    if place:
        monkeypatch.setattr(place, raising(HOLES[0]))
    else:
        broken(crank.scene, HOLES[0], monkeypatch)
    state = advance(crank, [action])
    assert (state.scene, state.place, state.editing.past) == (crank.scene, crank.place, ())
    reason = state.editing.refusal or (state.toast and state.toast.text)
    assert "ZeroDivisionError" in str(reason)
    assert [effect.name for effect in state.effects] == ["report"]
    assert advance(state).effects == ()


@pytest.mark.parametrize("what", [(Scene, "pose"), (Batch, "__call__")], ids=["pose", "cycle"])
def test_a_scene_that_cannot_be_solved_is_not_put_on(
    crank: State, what: tuple[type, str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(*what, raising(HOLES[0]))
    state = advance(crank, [Action("closure")])
    assert (state.scene, [effect.name for effect in state.effects]) == (crank.scene, ["report"])


def test_a_way_that_fails_is_left_out(crank: State, monkeypatch: pytest.MonkeyPatch) -> None:
    state = advance(crank, [Action("nudge", 1)])
    monkeypatch.setattr("linkanim.player.state.on_the_way", raising(HOLES[0]))
    after = advance(state)
    assert (after.glide, after.shown) == (None, state.scene)
    assert [effect.name for effect in after.effects] == ["report"]


def test_an_action_that_is_not_in_the_table_is_a_fault_of_ours(crank: State) -> None:
    with pytest.raises(KeyError):
        advance(crank, [Action("explode")])


def report_of(folder: Path, scene: str = "crank-rocker") -> dict[str, Any]:
    """Return the one report that was written."""
    (path,) = (folder / "recordings").iterdir()
    assert path.name == f"{scene}-fault-1.json"
    found: dict[str, Any] = json.loads(path.read_text())
    return found


def test_a_report_holds_what_is_needed_to_find_the_hole(
    player: Player, here: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    player.press(ord("e"), 0, "e")
    player.press(pygame.K_DOWN)
    player.type("47")
    monkeypatch.setattr("linkanim.player.edits.with_dimensions", raising(HOLES[0]))
    assert player.press(pygame.K_RETURN)
    assert player.tick()
    found = report_of(here)
    assert found["document"] == load("crank-rocker").document
    assert (found["key"], found["typed"], found["action"]) == (["four-bar", "crank"], "47", ["accept", None])
    assert found["error"] == "ZeroDivisionError: float division by zero"
    assert any("test_solver_faults.py" in line for line in found["traceback"])
    assert player.state.toast is not None
    assert "recordings/crank-rocker-fault-1.json" in player.state.toast.text
    player.press(pygame.K_RETURN)
    report_of(here)


def test_a_picture_that_cannot_be_painted_gives_way_to_the_last(
    player: Player, here: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    before, paint = player.state.scene, Picture.__init__

    def fail(self: Picture, scene: Scene, *rest: Any, **more: Any) -> None:
        if scene.name != "crank-rocker":
            raise HOLES[0]
        paint(self, scene, *rest, **more)

    monkeypatch.setattr(Picture, "__init__", fail)
    assert player.press(pygame.K_TAB, 0, "\t")
    assert player.state.scene == before
    assert player.tick()
    assert report_of(here, "drag-link")["document"] == load("drag-link").document


def test_a_phase_that_cannot_be_painted_is_not_gone_to(
    player: Player, here: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    stays, paint = player.state.phase, SurfacePrinter.paint

    def fail(
        self: SurfacePrinter, surface: pygame.Surface, picture: Picture, pose: Any, *rest: Any, **more: Any
    ) -> None:
        if pose.phase != stays:
            raise HOLES[1]
        paint(self, surface, picture, pose, *rest, **more)

    monkeypatch.setattr(SurfacePrinter, "paint", fail)
    assert player.press(pygame.K_RIGHT)
    assert player.tick(5)
    assert (player.state.phase, player.state.clock.paused) == (stays, True)
    assert report_of(here)["error"] == "ValueError: math domain error"


def test_every_rule_knows_its_values() -> None:
    for name, rule in ACTIONS.items():
        assert not rule.check(object()), name
