"""`advance` as a table of actions, and the rules that hold for every state."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import pytest

from linkanim.picture.look import Look
from linkanim.play.games import game_of
from linkanim.player.action import Action
from linkanim.player.actions import advance
from linkanim.player.state import State, begin
from linkanim.scenes import load, names


@pytest.fixture
def rocker() -> State:
    """The crank-rocker, one second in."""
    return run(begin(load("crank-rocker")), 60)


def run(state: State, frames: int) -> State:
    for _ in range(frames):
        state = advance(state)
    return state


def after(state: State, *actions_: Action | str) -> State:
    for one in actions_:
        state = advance(state, [Action(one) if isinstance(one, str) else one])
    return state


def test_a_second_turns_the_crank_by_its_speed(rocker: State) -> None:
    assert rocker.phase == rocker.scene.linkage.drive.speed


# What an action changes, read off the state after it.
CHANGES: dict[str, tuple[Action, Callable[[State], object], object]] = {
    "pause": (Action("pause"), lambda s: s.clock.paused, True),
    "direction": (Action("direction"), lambda s: s.clock.direction, -1),
    "faster": (Action("speed", 1), lambda s: round(s.clock.speed / s.clock.rate, 9), 1.25),
    "slower": (Action("speed", -1), lambda s: round(s.clock.speed / s.clock.rate, 9), 0.8),
    "start": (Action("start"), lambda s: s.phase, 0.0),
    "scrub": (Action("scrub", 1.5), lambda s: (s.phase, s.clock.paused), (1.5, True)),
    "mechanism": (Action("mechanism", 1), lambda s: s.scene.name, "drag-link"),
    "mechanism back": (Action("mechanism", -1), lambda s: s.scene.name, names()[-1]),
    "select": (Action("select", 4), lambda s: s.scene.name, names()[4]),
    "trace": (Action("trace"), lambda s: s.look.trace, False),
    "velocity": (Action("vectors", "v"), lambda s: s.look.vectors, {"v"}),
    "acceleration": (Action("vectors", "a"), lambda s: s.look.vectors, {"a"}),
    "ghost": (Action("ghost"), lambda s: s.look.ghost, True),
    "theme": (Action("theme"), lambda s: s.look.theme, "dark"),
    "help": (Action("help"), lambda s: s.help, True),
    "zoom": (Action("zoom", (1.0, 0.0, 0.0)), lambda s: s.look.zoom, 1.25),
    "zoom ends, near": (Action("zoom", (99.0, 0.0, 0.0)), lambda s: s.look.zoom, 1.25**13),
    "zoom ends, far": (Action("zoom", (-99.0, 0.0, 0.0)), lambda s: s.look.zoom, 1.25**-6),
    "pan": (Action("pan", (0.25, -0.5)), lambda s: s.look.pan, (0.25, -0.5)),
    "record": (Action("record", "mp4"), lambda s: s.effects, (Action("record", "mp4"),)),
    "screenshot": (Action("screenshot"), lambda s: s.effects, (Action("screenshot"),)),
    "svg": (Action("svg"), lambda s: s.effects, (Action("svg"),)),
    "share": (Action("share"), lambda s: s.effects, (Action("share"),)),
    "fullscreen": (Action("fullscreen"), lambda s: s.effects, (Action("fullscreen"),)),
    "save": (Action("save"), lambda s: s.effects, (Action("name"),)),
    "quit": (Action("quit"), lambda s: s.effects, (Action("quit"),)),
    "escape says what quits": (Action("back"), lambda s: s.toast and s.toast.text, "Q quits"),
    "the window's button": (Action("close"), lambda s: s.effects, (Action("quit"),)),
}


@pytest.mark.parametrize(("action", "read", "expected"), CHANGES.values(), ids=CHANGES)
def test_an_action_changes_the_state(
    rocker: State, action: Action, read: Callable[[State], object], expected: object
) -> None:
    assert read(rocker) != expected
    assert read(after(rocker, action)) == expected


# Pairs that undo each other: the picture's inputs are the same again.
UNDONE = {
    "trace": ("trace", "trace"),
    "theme": ("theme", "theme"),
    "ghost": ("ghost", "ghost"),
    "help": ("help", "help"),
    "escape closes help": ("help", "back"),
    "velocity": (Action("vectors", "v"), Action("vectors", "v")),
    "acceleration": (Action("vectors", "a"), Action("vectors", "a")),
    "direction": ("direction", "direction"),
    "speed": (Action("speed", 3), Action("speed", -3)),
    "step": (Action("step", 10), Action("step", -10)),
    "zoom about the middle": (Action("zoom", (3.0, 0.0, 0.0)), Action("zoom", (-3.0, 0.0, 0.0))),
    "zoom out and in": (Action("zoom", (-5.0, 0.0, 0.0)), Action("zoom", (5.0, 0.0, 0.0))),
    "zoom about a corner": (Action("zoom", (2.0, 0.8, -0.3)), Action("zoom", (-2.0, 0.8, -0.3))),
    "pan": (Action("pan", (0.1, 0.2)), Action("pan", (-0.1, -0.2))),
    "pan and fit": (Action("pan", (0.1, 0.2)), "fit"),
    "zoom and fit": (Action("zoom", (2.0, 0.5, 0.5)), "fit"),
    "closure": ("closure", "closure"),
}


@pytest.mark.parametrize(("first", "second"), UNDONE.values(), ids=UNDONE)
def test_a_paused_picture_comes_back(rocker: State, first: Action | str, second: Action | str) -> None:
    paused = after(rocker, "pause")

    def shown(state: State) -> object:
        return state.scene, state.phase, state.look, state.help, state.clock.speed

    assert shown(after(paused, first)) != shown(paused)
    assert shown(after(paused, first, second)) == shown(paused)


@pytest.mark.parametrize("action", [Action("direction"), Action("speed", 2), Action("pause")], ids=str)
def test_the_phase_has_no_jump(rocker: State, action: Action) -> None:
    step = abs(rocker.clock.speed) / 60
    moved = after(rocker, action)
    assert abs(moved.phase - rocker.phase) <= step * 1.0001
    assert abs(after(moved, action).phase - moved.phase) <= 2 * step


def test_a_mechanism_starts_from_its_start(rocker: State) -> None:
    faster = after(rocker, Action("speed", 2), "direction", Action("zoom", (2.0, 0.0, 0.0)), "theme")
    onward = after(faster, Action("mechanism", 1))
    assert (onward.phase, onward.look) == (0.0, Look(theme="dark"))
    assert onward.clock.speed == onward.scene.linkage.drive.speed


def test_a_mechanism_stays_paused(rocker: State) -> None:
    assert after(rocker, "pause", Action("mechanism", 1)).clock.paused


@pytest.mark.slow
def test_the_shelf_goes_round(rocker: State) -> None:
    there = after(rocker, *[Action("mechanism", 1)] * len(names()))
    assert there.scene == rocker.scene
    assert after(rocker, Action("mechanism", 1), Action("mechanism", -1)).scene == rocker.scene


def test_a_scene_of_ones_own_stands_before_the_catalogue() -> None:
    own = replace(load("press"), name="mine")
    state = begin(own)
    assert state.scene is own
    assert after(state, Action("mechanism", 1)).scene == load(names()[0])
    assert after(state, Action("mechanism", 1), Action("mechanism", -1)).scene is own


def test_numbers_choose_of_the_catalogue_also_beside_a_scene_of_ones_own() -> None:
    state = begin(replace(load("press"), name="mine"))
    assert after(state, Action("select", 0)).scene == load(names()[0])


def test_a_number_past_the_shelf_changes_nothing(rocker: State) -> None:
    alone = replace(rocker, shelf=(rocker.scene,), place=0)
    assert after(alone, Action("select", 5)).scene is rocker.scene


def test_the_other_closure_keeps_the_phase(rocker: State) -> None:
    crossed = after(rocker, "closure")
    assert crossed.scene.linkage != rocker.scene.linkage
    assert crossed.phase == run(rocker, 1).phase


def test_a_ghost_of_a_closure_that_is_not_there_is_refused() -> None:
    state = after(begin(load("inverted-slider-crank")), "ghost")
    assert not state.look.ghost
    assert state.toast is not None
    assert "no second closure" in state.toast.text
    assert not after(replace(state, look=Look(ghost=True)), "ghost").look.ghost


def test_escape_closes_help_before_it_says_what_quits(rocker: State) -> None:
    assert after(rocker, "help", "back").effects == ()
    assert after(rocker, "help", "back", "back").toast is not None


def test_effects_last_one_frame(rocker: State) -> None:
    assert run(after(rocker, "screenshot"), 1).effects == ()


def test_a_recording_is_stopped_by_either_key(rocker: State) -> None:
    running = after(rocker, Action("record", "gif"))
    assert running.recording is not None
    stopped = after(running, Action("record", "mp4"))
    assert stopped.recording is None
    assert stopped.effects == (Action("render", "gif"),)


def test_a_toast_is_gone_after_three_seconds(rocker: State) -> None:
    noticed = after(rocker, Action("note", "written"))
    assert run(noticed, 3 * 60 - 1).toast is not None
    assert run(noticed, 3 * 60).toast is None


def test_a_steady_state_does_not_grow(rocker: State) -> None:
    later = run(rocker, 1000)
    assert replace(later, frame=rocker.frame) == rocker


# What somebody leaves on the screen, in a window that opened on the title and in a kiosk.
LEFT: dict[str, tuple[Action | str, ...]] = {
    "paused": ("pause",),
    "help": ("help",),
    "help while paused": ("pause", "help"),
    "help over a list": ("list", "help"),
    "list": ("list",),
    "filtered list": ("list", Action("filter", "vel")),
    "list while paused": ("pause", "list"),
    "files": (Action("files", "one.toml\t2026-01-02\ntwo.toml\t2026-01-01"),),
    "shelf": ("shelf",),
    "filtered shelf": ("shelf", Action("filter", "geneva")),
    "shelf while paused": ("pause", "shelf"),
    "a place typed": ("pause", Action("type_place", "45")),
    "stepped": (Action("step", 10),),
    "edit": ("edit",),
    "edit, a value typed": ("edit", Action("type", "12")),
    "edit, a value refused": ("edit", Action("type", "1e9"), "accept"),
    "edit while paused": ("pause", "edit"),
    "edited": ("edit", Action("nudge", 1)),
    "pencil": ("pencil",),
    "pencil, in a stroke": ("pencil", Action("pen_down", (1.0, 2.0)), Action("pen_to", (3.0, 4.0))),
    "sheet": ("sheet",),
    "sheet, a pin": ("sheet", Action("hand_down", (0.0, 0.0, 2.0, 5.0)), "hand_up"),
    "sheet of the scene": ("build_on", "pause"),
    "sheet, a tool": ("sheet", Action("tool", "spring")),
    "sheet, help": ("sheet", "help"),
    "chart, paused": (Action("plot", "crank.angle"), "pause"),
    "lobby": (Action("play", "lobby"),),
    "menu": (Action("play", "menu"),),
    "predict": (Action("play", "predict seed=1"),),
    "match": (Action("play", "match"),),
    "follow": (Action("play", "follow"),),
    "recording": (Action("record", "gif"),),
    "dialog of a recording": ("record_dialog",),
    "dialog of a recording, a place typed": ("pause", "record_dialog", Action("record_type", "films/one")),
    "all commands": ("menu",),
    "commands of a joint": ("pause", Action("menu", "joint A")),
    "poses": ("poses",),
    "poses, two set down": ("poses", Action("set_poses", (0.0, 0.0, 0.0, 0.0, 40.0, 10.0, 0.6))),
    "layers": ("layers",),
    "construction": ("pause", Action("construct", 1)),
    "three charts": (Action("plot", "crank.angle"), Action("strip", "A.velocity"), "pause"),
    "one large polygon": ("pause", "polygons", "large_polygon"),
}
RUNNING: dict[str, tuple[Action | str, ...]] = {
    "a mechanism": (),
    "a chart": (Action("plot", "crank.angle"),),
    "names": ("names",),
    "edited and closed": ("edit", Action("nudge", 1), "edit"),
}


def untouched(state: State, minutes: int = 20) -> State:
    """Let minutes go by, each looked at for some frames."""
    for _ in range(minutes):
        state = run(replace(state, frame=state.frame + 60 * 60 - 4), 4)
    return state


def still(state: State) -> State:
    """Return what of a state stays while its clock runs on: a message and a flash go."""
    gone = replace(state, frame=0, toast=None, chip=None, place_typed="", faded=None, turned=None, glide=None)
    gone = replace(gone, departures=())
    return replace(gone, effects=(), beneath=None)


@pytest.mark.slow
def test_nothing_walks_away_from_what_was_left() -> None:
    for kiosk, cases in ((False, {**LEFT, **RUNNING}), (True, LEFT)):
        for name, actions in cases.items():
            state = replace(begin(), games=game_of, from_title=True, kiosk=kiosk)
            state = run(after(state, *actions), 90)
            assert still(untouched(state)) == still(state), (kiosk, name)


@pytest.mark.parametrize("name", RUNNING)
def test_the_first_action_in_a_kiosk_only_brings_back_what_was_left(name: str) -> None:
    state = run(after(replace(begin(), games=game_of, kiosk=True), *RUNNING[name]), 90)
    alone = untouched(state, 3)
    assert alone.game
    back = after(alone, Action("option", 1))
    assert still(replace(back, touched=state.touched, clock=state.clock)) == still(state)
    assert back.clock.speed == state.clock.speed
    assert run(back, 60).game is None


def test_the_help_and_a_construction_are_modes_through_which_keys_reach_what_is_below() -> None:
    state = after(begin(load("crank-rocker")), Action("construct", 2), "help", "edit")
    assert [type(mode).__name__ for mode in state.modes] == ["Construction", "Help", "Dimensions"]
    assert (state.constructed, state.help, state.mode) == (2, True, "edit")
    for left in (["Construction", "Dimensions"], ["Construction"], []):
        state = after(state, "back")
        assert [type(mode).__name__ for mode in state.modes] == left
    assert state.mode == "play"
