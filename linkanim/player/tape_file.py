"""A tape as a file: versioned JSON that contains its scenes as a whole.

A tape is a state to start from, a number of frames (60 a second), and actions, each with its frame.
"""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Callable, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any, NamedTuple

from linkanim import atomic_files, intake
from linkanim.bounds import LARGEST_SIDE, MOST_ACTIONS, MOST_AT_ONCE
from linkanim.errors import BadInput, LinkanimError
from linkanim.intake import Intake, Section, refuse_controls
from linkanim.manifest import Output
from linkanim.player import stored
from linkanim.player.action import Action
from linkanim.player.actions import is_taped
from linkanim.player.building import restored_sheet
from linkanim.player.clock import FRAMES_PER_SECOND, Clock
from linkanim.player.edits import Dimensions
from linkanim.player.helping import Help
from linkanim.player.state import Edited, Editing, Game, Mode, State
from linkanim.player.tape import Tape
from linkanim.scenes import names
from linkanim.scenes.form import Key
from linkanim.scenes.scene import Scene
from linkanim.units import shown

VERSION = 1
SUFFIX = ".tape.json"
TAPE_FILE = Intake("a tape", most_bytes=20_000_000, most_values=1_000_000)

_MARK = "linkanim_tape"
_MOST_FRAMES = 24 * 3600 * FRAMES_PER_SECOND


def write(tape: Tape, path: Path | Output) -> None:
    """Write the tape to a new file, or to an output; WorkFailed where that is impossible."""
    text = json.dumps(to_document(tape), ensure_ascii=False, allow_nan=False, indent=1)
    if isinstance(path, Path):
        atomic_files.add(f"{text}\n".encode(), path)
        return
    with path.replacing() as part:
        part.write_bytes(f"{text}\n".encode())


def read(path: Path, games: Callable[[str], Game] | None = None) -> Tape:
    """Read a tape; BadInput, naming the place, for a file that is no tape, or one of another version.

    `games` reads the tape's games from their words.
    """
    where = intake.named(path)
    document = TAPE_FILE.json(path, where, "is not JSON; a tape is a file that G or M wrote in the window")
    if isinstance(document, dict):
        refuse_controls(Section(where, document))
    tape = from_document(document, where)
    for action in dict.fromkeys(action for _, action in tape.actions if action.name in ("play", "draft")):
        try:
            if action.name == "draft":
                restored_sheet(tape.start, str(action.value))
            elif games:
                games(str(action.value))
        except LinkanimError as error:
            raise BadInput(f"{where}: {error}") from None
    return replace(tape, start=replace(tape.start, games=games)) if games else tape


class TapeValue(NamedTuple):
    """How a value is stored in a tape: the functions that read it at a key of a table, and write it."""

    read: Callable[[Section, str], Any]
    write: Callable[[Any], Any] = lambda value: value


def to_document(tape: Tape) -> dict[str, Any]:
    """Return the tape as JSON's own values."""
    state = tape.start
    clock = state.clock.go(state.frame, state.phase)
    start = _written(_CLOCK, clock) | _written(_state(len(state.shelf)), state)
    start["editing"]["open"] = state.edits_dimensions
    return {
        _MARK: VERSION,
        "scene": _SCENE.write(state.scene),
        "start": start,
        "shelf": _SHELF.write(state.shelf),
        "size": list(tape.size),
        "frames": tape.frames,
        "actions": [[frame, *action[: 1 if action.value is None else 2]] for frame, action in tape.actions],
    }


def from_document(document: object, where: str) -> Tape:
    """Return the tape that a document holds; BadInput where it is no tape of this version."""
    otherwise = "is not a tape; a tape is a file that G or M wrote in the window"
    top = Section(where, TAPE_FILE.marked(document, where, _MARK, VERSION, otherwise))
    frames = top.whole("frames", 0, _MOST_FRAMES)
    return Tape(_start(top), frames, _actions(top, frames), _size(top))


def _size(top: Section) -> tuple[int, int]:
    sides = top.listed("size", 2)
    width, height = (sides.whole(key, 1, LARGEST_SIDE) for key in sides.values)
    return width, height


def _start(top: Section) -> State:
    start, scene = top.table("start"), stored.scene(top, "scene")
    shelf = _SHELF.read(top, "shelf") or (scene,)
    clock = Clock(scene.linkage.drive.speed, **_read(_CLOCK, start))
    edited = start.table("editing")
    modes: tuple[Mode, ...] = (Dimensions(),) if "open" in edited and edited.flag("open") else ()
    known = _read(_state(len(shelf)), start)
    modes += (Help(),) * known.pop("help", False)
    return State(scene, clock, shelf, modes=modes, **known)


def _read(entries: Mapping[str, TapeValue], part: Section) -> dict[str, Any]:
    """Return the values of a table by their keys; an old tape lacks some."""
    return {key: one.read(part, key) for key, one in entries.items() if key in part or key not in _LATER}


def _written(entries: Mapping[str, TapeValue], value: object) -> dict[str, Any]:
    return {key: one.write(getattr(value, key)) for key, one in entries.items()}


def _table(make: Callable[..., Any], entries: Mapping[str, TapeValue]) -> TapeValue:
    """Return the entry of a value that `make` builds from a table's values, which are its attributes."""
    return TapeValue(
        lambda part, key: make(**_read(entries, part.table(key))), lambda value: _written(entries, value)
    )


def _list(of: TapeValue) -> TapeValue:
    def read(part: Section, key: str) -> tuple[Any, ...]:
        items = part.listed(key)
        return tuple(of.read(items, item) for item in items.values)

    return TapeValue(read, lambda values: [of.write(value) for value in values])


def _whole(low: int, high: int) -> TapeValue:
    return TapeValue(lambda part, key: part.whole(key, low, high))


def _entry(entries: Section, key: str) -> Scene | str:
    entry = entries.need(key)
    return str(entry) if entry in names() else stored.scene(entries, key)


def _draft(entries: Section, key: str) -> tuple[Key, str]:
    match entries.items(key):
        case [str(text), *path] if path and all(isinstance(step, str | int) for step in path):
            return tuple(path), text[:40]
    raise entries.error(key, "must be a list of what was typed and the keys of its value")


_QUICK = frozenset({"pen_to", "zoom", "pan", "scrub", "step", "speed"})
"""Actions of which one frame may have many: the mouse may move several times while the window waits."""
_MOST = {"draft": 10, "play": 1_000, "stage": 300}
"""The most of these actions in a whole tape; a tape that begins on a sheet has one draft."""
_LATER = ("kept", "drafts")
"""Keys that older tapes lack."""
_FLAG = TapeValue(Section.flag)
_SCENE = TapeValue(stored.scene, lambda scene: {"name": scene.name, "document": scene.document})
_SCENES = _list(_SCENE)
_SHELF = _list(TapeValue(_entry, lambda entry: entry if isinstance(entry, str) else _SCENE.write(entry)))
_ORIGINAL = TapeValue(
    lambda part, key: stored.scene(part, key) if part.values.get(key) else None,
    lambda scene: scene and _SCENE.write(scene),
)
_EDITING = _table(
    Editing,
    {
        "chosen": _whole(0, 10_000),
        "typed": TapeValue(lambda part, key: part.text(key)[:40]),
        "drafts": _list(TapeValue(_draft, lambda draft: [draft[1], *draft[0]])),
        "past": _SCENES,
        "future": _SCENES,
        "original": _ORIGINAL,
    },
)
_CLOCK = {
    "phase": TapeValue(Section.number),
    "level": _whole(-20, 10),
    "direction": TapeValue(lambda part, key: -1 if part.whole(key, -1, 1) < 0 else 1),
    "paused": _FLAG,
}
"""The fields of a clock that a tape stores."""


def _state(places: int) -> Mapping[str, TapeValue]:
    """Return the other fields of a state that a tape stores, for a shelf with so many places."""
    place = _whole(0, places - 1)
    return {
        "place": place,
        "help": _FLAG,
        "look": TapeValue(
            lambda part, key: stored.look(part.table(key)),
            lambda look: {**vars(look), "vectors": sorted(look.vectors)},
        ),
        "editing": _EDITING,
        "kept": _list(_table(Edited, {"place": place, "scene": _SCENE, "editing": _EDITING})),
    }


def _actions(top: Section, frames: int) -> tuple[tuple[int, Action], ...]:
    entries = top.listed("actions")
    if len(entries.values) > MOST_ACTIONS:
        count = len(entries.values)
        raise top.error("actions", f"are {count:,}, more than {MOST_ACTIONS:,}; record a shorter tape")
    actions: list[tuple[int, Action]] = []
    for key, entry in entries.values.items():
        try:
            frame, action = _action(entry)
        except ValueError as error:
            raise entries.error(key, f"{shown(entry)} is not {error}") from None
        if not (actions[-1][0] if actions else 0) <= frame <= frames:
            raise entries.error(key, f"{shown(entry)} is not in the order of frames, up to {frames}")
        actions.append((frame, action))
    _refuse_crowded(top, actions)
    return tuple(actions)


def _refuse_crowded(top: Section, actions: list[tuple[int, Action]]) -> None:
    """Refuse more slow actions at one frame, or more drafts or games, than a window ever has."""
    crowds = Counter(frame for frame, action in actions if action.name not in _QUICK)
    for frame, count in crowds.most_common(1):
        if count > MOST_AT_ONCE:
            many = f"are {count:,} at frame {frame}, more than {MOST_AT_ONCE}"
            raise top.error("actions", f"{many}; record the tape again")
    names = Counter(action.name for _, action in actions)
    for name, what in (
        ("draft", "drafts"),
        ("play", "beginnings of a game"),
        ("stage", "steps of a lesson"),
    ):
        if (count := names[name]) > (most := _MOST[name]):
            raise top.error("actions", f"have {count:,} {what}, more than {most:,}; record the tape again")


_NAMED = {
    "unbuild": "undo_sheet",
    "rebuild": "redo_sheet",
    "undigit": "erase_number",
    "unmet": "no_linkage",
    "take_untype": "erase_target",
    "take": "accept",
    "take_number": "accept_number",
    "take_back": "undo_sketch",
    "take_point": "grasp_point",
    "take_pivot": "grasp_pivot",
    "take_closure": "choose_closure",
    "taking": "record_dialog",
    "take_places": "record_places",
    "take_row": "record_row",
    "take_turn": "record_turn",
    "take_type": "record_type",
    "take_refused": "record_refused",
}
"""What the actions of earlier tapes are called now."""


def _action(entry: Any) -> tuple[int, Action]:
    """Return the frame and the action of an entry; ValueError with what would be right for any other."""
    match entry:
        case [int(frame), str(name), *rest] if len(rest) < 2:
            value = rest[0] if rest else None
        case _:
            raise ValueError("[frame, name] or [frame, name, value]")
    action = Action(_NAMED.get(name, name), tuple(value) if isinstance(value, list) else value)
    if not is_taped(action):
        raise ValueError("an action of this version; record the tape again")
    return frame, action
