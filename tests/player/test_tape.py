"""Tapes: the same pictures again, a file that reads back, refusals in one line."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from linkanim.bounds import MOST_ACTIONS
from linkanim.errors import BadInput
from linkanim.player.action import Action
from linkanim.player.actions import advance, is_known
from linkanim.player.state import State, begin
from linkanim.player.tape import Tape, starting, taped
from linkanim.player.tape_file import from_document, read, to_document, write
from linkanim.scenes import load

SESSION = (
    (5, Action("speed", 2)),
    (9, Action("direction")),
    (20, Action("edit")),
    (22, Action("choose", 1)),
    (25, Action("nudge", -10)),
    (31, Action("closure")),
    (40, Action("zoom", (2.0, 0.3, -0.1))),
    (44, Action("undo")),
    (50, Action("mechanism", 1)),
    (60, Action("scrub", 2.5)),
    (61, Action("pause")),
    (75, Action("vectors", "v")),
    (80, Action("polygons")),
    (81, Action("centres")),
)


def shown(state: State) -> object:
    return state.shown.linkage, state.look, state.clock.paused


@pytest.fixture(scope="module")
def live() -> State:
    """A window some time after its start, with an edit behind it that can still be undone."""
    state = begin(replace(load("six-bar"), name="mine"))
    for action in ("edit", "nudge", "edit", "polygons", "centres"):
        state = advance(state, [Action(action, 1 if action == "nudge" else None)])
    for _ in range(100):
        state = advance(state)
    return state


@pytest.fixture(scope="module")
def tape(live: State) -> Tape:
    """That session, taped."""
    return Tape(starting(live), 90, SESSION, (640, 360))


@pytest.mark.slow
def test_a_tape_goes_through_the_states_of_its_session(live: State, tape: Tape) -> None:
    by_frame = dict(SESSION)
    for again in tape.states():
        if again.frame:
            live = advance(live, [by_frame[again.frame]] if again.frame in by_frame else [])
        assert shown(again) == shown(live)
        assert again.phase == pytest.approx(live.phase, rel=1e-12, abs=1e-12)


def test_undo_goes_back_past_the_start_of_the_tape(tape: Tape) -> None:
    undone = replace(tape, actions=((1, Action("undo")),))
    *_, last = undone.states()
    assert last.scene.linkage == load("six-bar").linkage


def test_a_file_reads_back(tape: Tape, tmp_path: Path) -> None:
    path = tmp_path / "mine.tape.json"
    write(tape, path)
    assert read(path) == tape


def test_what_is_begun_and_named_reads_back(live: State, tmp_path: Path) -> None:
    actions_ = (
        Action("direction"),
        Action("names"),
        Action("edit"),
        Action("type", "7"),
        Action("pass_on", 1),
        Action("type", "8"),
    )
    for action in actions_:
        live = advance(live, [action])
    tape = Tape(starting(live), 5)
    write(tape, tmp_path / "mine.tape.json")
    again = read(tmp_path / "mine.tape.json").start
    assert (again.editing, again.look) == (live.editing, live.look)
    assert again.phase == pytest.approx(live.phase)
    assert again.clock.speed == live.clock.speed
    assert (again.look.names, again.editing.typed, len(again.editing.drafts)) == (1, "8", 1)


def test_a_tape_from_before_names_and_polygons_shows_none(tape: Tape) -> None:
    document = json.loads(json.dumps(to_document(tape)))
    for key in ("names", "polygons", "centres"):
        del document["start"]["look"][key]
    look = from_document(document, "mine.tape.json").start.look
    assert (look.names, look.polygons, look.centres) == (0, False, 0)


def test_actions_of_earlier_tapes_are_those_of_today(tape: Tape) -> None:
    former: dict[str, tuple[str, *tuple[object, ...]]] = {
        "unbuild": ("undo_sheet",),
        "rebuild": ("redo_sheet",),
        "undigit": ("erase_number",),
        "unmet": ("no_linkage", "no linkage"),
        "take": ("accept",),
        "take_number": ("accept_number",),
        "take_back": ("undo_sketch",),
        "take_point": ("grasp_point", 3),
        "take_pivot": ("grasp_pivot", "O2"),
        "take_closure": ("choose_closure", 1),
        "taking": ("record_dialog",),
        "take_places": ("record_places", "/somewhere\none"),
        "take_row": ("record_row", 1),
        "take_turn": ("record_turn", -1),
        "take_type": ("record_type", "x"),
        "take_untype": ("erase_target",),
        "take_refused": ("record_refused", "not there"),
    }
    actions = [[0, name, *now[1:]] for name, now in former.items()]
    document = json.loads(json.dumps(to_document(tape))) | {"actions": actions}
    read = [action for _, action in from_document(document, "mine.tape.json").actions]
    assert read == [Action(*now) for now in former.values()]  # type: ignore[arg-type]


def test_a_file_is_never_written_over(tape: Tape, tmp_path: Path) -> None:
    path = tmp_path / "mine.tape.json"
    path.write_text("mine")
    with pytest.raises(Exception, match="cannot be written"):
        write(tape, path)
    assert path.read_text() == "mine"


def test_a_tape_with_nothing_done_is_a_loop(tape: Tape) -> None:
    assert replace(tape, actions=()).is_loop
    assert not tape.is_loop


# Files, dialogs of the window and what lies over its picture are its user's own.
OUTSIDE = (
    *(Action("record", "gif"), Action("period", "mp4"), Action("record_into", "/home/me/one.gif")),
    *map(Action, ("screenshot", "svg", "share", "make", "save", "save_as", "erase_name", "accept_name")),
    *(Action("write_name", "mine"), Action("open_file", "mine.toml"), Action("files", "mine.toml\t1")),
    *map(Action, ("reload", "fullscreen", "quit", "close", "mouse_moved", "open_toast")),
    *(Action("note", "x"), Action("hint", "x")),
    *map(Action, ("list", "menu", "shelf", "erase_filter")),
    *(Action("filter", "x"), *(Action(name, 1) for name in ("move", "point", "top"))),
)


def test_what_is_done_outside_is_not_taped() -> None:
    assert all(map(is_known, OUTSIDE))
    assert taped((*OUTSIDE, Action("trace"))) == (Action("trace"),)


@pytest.mark.parametrize("fps", [10, 25, 30, 60, 100])
def test_pictures_come_at_any_rate(tape: Tape, fps: int) -> None:
    steady = replace(tape, actions=())
    pictures = list(steady.pictures(fps))
    assert len(pictures) == round(1.5 * fps)
    speed = steady.start.clock.speed
    for k, (_, phase) in enumerate(pictures):
        assert phase == pytest.approx(steady.start.phase + speed * k / fps)


@pytest.mark.slow
def test_a_picture_shows_what_was_done_before_it(tape: Tape) -> None:
    states = list(tape.states())
    for k, (state, _) in enumerate(tape.pictures(25)):
        assert state == states[int(k * 60 / 25)]


Spoil = Callable[[dict[str, Any]], object]

# A tape that is not ours, or not this version's, or broken at one place: the line names the place.
SPOILT: dict[str, tuple[Spoil, str]] = {
    "another version": (lambda d: d.update(linkanim_tape=2), "version 2; this linkanim reads version 1"),
    "a version that is text": (lambda d: d.update(linkanim_tape="1"), 'version "1"'),
    "no tape": (lambda d: d.pop("linkanim_tape"), "is not a tape"),
    "an unknown action": (
        lambda d: d["actions"].append([90, "explode"]),
        "explode.*is not an action of this",
    ),
    "an action of another value": (lambda d: d["actions"].append([90, "speed", "fast"]), "fast"),
    "an action without its value": (lambda d: d["actions"].append([90, "speed"]), "is not an action"),
    "a number beyond floats": (lambda d: d["actions"].append([90, "scrub", 10**400]), "is not an action"),
    "a step beyond floats": (lambda d: d["actions"].append([90, "step", -(10**400)]), "is not an action"),
    "a phase beyond floats": (lambda d: d["start"].update(phase=10**400), "must be a finite number"),
    "a bool for a number": (lambda d: d["actions"].append([90, "step", True]), "is not an action"),
    "a name that is no text": (lambda d: d["actions"].append([90, ["speed"]]), r"\[frame, name\]"),
    "what is done outside": (lambda d: d["actions"].append([90, "quit"]), "is not an action"),
    "an action with two values": (lambda d: d["actions"].append([90, "step", 1, 2]), r"\[frame, name\]"),
    "an entry of another form": (lambda d: d["actions"].append("speed"), r"\[frame, name\]"),
    "frames out of order": (lambda d: d["actions"].append([3, "trace"]), "order of frames"),
    "a frame past the end": (lambda d: d["actions"].append([91, "trace"]), "up to 90"),
    "frames below zero": (lambda d: d.update(frames=-1), "frames = -1: must be a whole number"),
    "no frames": (lambda d: d.pop("frames"), '"frames" is missing'),
    "a phase that is text": (
        lambda d: d["start"].update(phase="0"),
        'start.phase = "0": must be',
    ),
    "a level off the ladder": (lambda d: d["start"].update(level=99), "start.level = 99"),
    "vectors of another kind": (
        lambda d: d["start"]["look"].update(vectors=["x"]),
        r"start.look.vectors\[0\] = \"x\"",
    ),
    "more of the centres than there is": (
        lambda d: d["start"]["look"].update(centres=3),
        "start.look.centres = 3",
    ),
    "a place off the shelf": (lambda d: d["start"].update(place=len(d["shelf"])), "start.place = "),
    "an unknown scene on the shelf": (lambda d: d["shelf"].append("nothing"), r"shelf\[\d+\] = \"nothing\""),
    "a broken scene": (lambda d: d["scene"]["document"].update(speed=1), "speed"),
    "a name that leads elsewhere": (lambda d: d["scene"].update(name="../../mine"), r"scene.name = "),
    "a name of another drive": (lambda d: d["scene"].update(name="C:mine"), r"scene.name = "),
    "a hidden name": (lambda d: d["scene"].update(name=".mine"), r"scene.name = "),
    "no name": (lambda d: d["scene"].update(name=""), r"scene.name = "),
    "a draft of nothing": (lambda d: d["start"]["editing"].update(drafts=[[]]), r"drafts\[0\]: must be"),
    "a draft nowhere": (lambda d: d["start"]["editing"].update(drafts=[["1"]]), r"drafts\[0\]: must be"),
    "a size of one number": (lambda d: d.update(size=[3]), "size"),
    "a size of nothing": (lambda d: d.update(size=[0, 720]), r"size\[0\] = 0"),
}


@pytest.mark.parametrize(("spoil", "reason"), SPOILT.values(), ids=SPOILT)
def test_a_spoilt_tape_is_refused_in_one_line(tape: Tape, spoil: Spoil, reason: str) -> None:
    document = json.loads(json.dumps(to_document(tape)))
    spoil(document)
    with pytest.raises(BadInput, match=reason) as refusal:
        from_document(document, "mine.tape.json")
    assert str(refusal.value).startswith("mine.tape.json: ")
    assert "\n" not in str(refusal.value)


def test_a_tape_nested_deeply_is_refused_before_it_is_parsed(tmp_path: Path) -> None:
    (tmp_path / "x.tape.json").write_text("[" * 100_000)
    with pytest.raises(BadInput, match="nested deeper than 16 levels"):
        read(tmp_path / "x.tape.json")


DRAFT = '{"draft": {"places": {"A": [NaN, 0]}}, "home": [0, 0, 1, 1], "tool": "bar"}'
# JSON's escapes let anything into a text, and a number may have any number of digits.
UNREADABLE: dict[str, tuple[Spoil, str]] = {
    "an escape sequence": (lambda d: d["scene"].update(name="a\x1b[31m"), r"scene.name = .*U\+001B"),
    "half a character": (lambda d: d["scene"]["document"].update(title="\ud800"), r"title = .*U\+D800"),
    "an override in an action": (lambda d: d["actions"].append([90, "type", "\u202e"]), r"U\+202E"),
    "an endless number": (lambda d: d.update(frames=10**1001), r"1,000 digits \(line \d+\)"),
    "a draft with no number": (lambda d: d["actions"].append([90, "draft", DRAFT]), "the draft: is damaged"),
    "a draft that is none": (lambda d: d["actions"].append([90, "draft", "bar"]), "the draft: is damaged"),
    "a hand out of reach": (
        lambda d: d["actions"].append([90, "hand_down", [1e100, 0, 3, 1]]),
        "is not an action of this version",
    ),
    "a hand without a step": (
        lambda d: d["actions"].append([90, "hand_to", [0, 0, 3, 1e-300]]),
        "is not an action of this version",
    ),
    "a cursor out of reach": (
        lambda d: d["actions"].append([90, "cursor", [0, -1e19]]),
        "is not an action of this version",
    ),
    "2,000 rounds at once": (
        lambda d: d.update(actions=[[0, "play", f"predict seed={n}"] for n in range(2_000)]),
        "actions: are 2,000 at frame 0, more than 100; record the tape again",
    ),
    "mechanism after mechanism at once": (
        lambda d: d.update(actions=[[7, "mechanism", 1]] * 101),
        "actions: are 101 at frame 7, more than 100; record the tape again",
    ),
    "a hundred rounds at frame after frame": (
        lambda d: d.update(actions=[[n // 99, "play", f"predict seed={n}"] for n in range(1_001)]),
        "actions: have 1,001 beginnings of a game, more than 1,000; record the tape again",
    ),
    "eleven drafts": (
        lambda d: d.update(actions=[[n, "draft", "{}"] for n in range(11)]),
        "actions: have 11 drafts, more than 10; record the tape again",
    ),
}


@pytest.mark.parametrize(("spoil", "reason"), UNREADABLE.values(), ids=UNREADABLE)
def test_what_a_tape_may_not_hold_is_refused_as_it_is_read(
    tape: Tape, tmp_path: Path, spoil: Spoil, reason: str
) -> None:
    document = json.loads(json.dumps(to_document(tape)))
    spoil(document)
    (tmp_path / "my.tape.json").write_text(json.dumps(document))
    with pytest.raises(BadInput, match=reason):
        read(tmp_path / "my.tape.json")


@pytest.mark.slow
def test_a_tape_of_too_many_actions_is_refused(tape: Tape) -> None:
    document = json.loads(json.dumps(to_document(replace(tape, actions=()))))
    document |= {"frames": 2_000, "actions": [[n // 50, "trace"] for n in range(MOST_ACTIONS)]}
    document["actions"].append([2_000, "trace"])
    with pytest.raises(BadInput, match="actions: are 100,001, more than 100,000"):
        from_document(document, "mine.tape.json")
    document["actions"].pop()
    assert len(from_document(document, "mine.tape.json").actions) == MOST_ACTIONS


NO_JSON = {
    "text": "hello",
    "empty": "",
    "NaN": '{"linkanim_tape": NaN}',
    "binary": "\0\1",
}


@pytest.mark.parametrize("text", NO_JSON.values(), ids=NO_JSON)
def test_a_file_that_is_not_json_is_refused(tmp_path: Path, text: str) -> None:
    path = tmp_path / "x.tape.json"
    path.write_text(text)
    with pytest.raises(BadInput, match="is not JSON"):
        read(path)


@pytest.mark.parametrize(("name", "message"), [("missing.json", "no such file"), (".", "is a folder")])
def test_a_file_that_cannot_be_read_is_refused(tmp_path: Path, name: str, message: str) -> None:
    with pytest.raises(BadInput, match=message):
        read(tmp_path / name)


def test_a_tape_that_plays_over_and_over_starts_anew_at_its_end_only() -> None:
    start = starting(begin("press"))
    tape = Tape(start, 3, ((1, Action("trace")),))
    state, seen = start, []
    for _ in range(8):
        seen.append((state.frame, state.look.trace))
        state = tape.rewound(advance(state, tape.at(state.frame)))
    first, second = start.look.trace, not start.look.trace
    assert seen == 2 * [(0, first), (1, first), (2, second)] + [(0, first), (1, first)]
