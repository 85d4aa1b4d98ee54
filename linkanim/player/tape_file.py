"""A tape as a file: versioned JSON with its scenes in it whole.

A tape is a state to start from, a number of frames (60 a second), and the actions with the frame
each of them comes at.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from linkanim import whole
from linkanim.errors import BadInput
from linkanim.picture.look import Look
from linkanim.player.action import Action
from linkanim.player.actions import is_taped
from linkanim.player.clock import FRAMES_PER_SECOND, Clock
from linkanim.player.document import Part
from linkanim.player.editing import Editing
from linkanim.player.state import State
from linkanim.player.tape import Tape
from linkanim.scenes import names
from linkanim.scenes.read import scene_from
from linkanim.scenes.scene import Scene

VERSION = 1
SUFFIX = ".tape.json"

_MARK = "linkanim_tape"
_LARGEST = 50_000_000
_MOST_FRAMES = 24 * 3600 * FRAMES_PER_SECOND


def write(tape: Tape, path: Path) -> None:
    """Write the tape as a file that was not there before; WorkFailed where that cannot be."""
    text = json.dumps(to_document(tape), ensure_ascii=False, allow_nan=False, indent=1)
    whole.add(f"{text}\n".encode(), path)


def read(path: Path) -> Tape:
    """Read a tape; BadInput, naming the place, for what is none, or of another version."""
    where = str(path)
    try:
        with path.open("rb") as file:
            data = file.read(_LARGEST + 1)
        if len(data) > _LARGEST:
            raise BadInput(f"{where}: is larger than {_LARGEST // 1_000_000} MB; that is no tape of ours")
        document = json.loads(data, parse_constant=_no_constant)
    except OSError as error:
        raise BadInput(f"{where}: cannot be read: {error.strerror or error}") from None
    except (ValueError, RecursionError):
        raise BadInput(f"{where}: is not JSON; a tape is a file that G or M wrote in the window") from None
    return from_document(document, where)


def _no_constant(name: str) -> float:
    raise ValueError(name)


def to_document(tape: Tape) -> dict[str, Any]:
    """Return the tape as JSON's own values."""
    state = tape.start
    return {
        _MARK: VERSION,
        "scene": _scene_document(state.scene),
        "start": _start_document(state),
        "shelf": [entry if isinstance(entry, str) else _scene_document(entry) for entry in state.shelf],
        "size": list(tape.size),
        "frames": tape.frames,
        "actions": [
            [frame, action.name] if action.value is None else [frame, action.name, action.value]
            for frame, action in tape.actions
        ],
    }


def _scene_document(scene: Scene) -> dict[str, Any]:
    return {"name": scene.name, "document": scene.document}


def _start_document(state: State) -> dict[str, Any]:
    look, editing = state.look, state.editing
    return {
        "phase": state.phase,
        "level": state.clock.level,
        "direction": state.clock.direction,
        "paused": state.clock.paused,
        "place": state.place,
        "help": state.help,
        "look": {**vars(look), "vectors": sorted(look.vectors)},
        "editing": {
            "open": editing.open,
            "chosen": editing.chosen,
            "typed": editing.typed,
            "past": [_scene_document(scene) for scene in editing.past],
            "future": [_scene_document(scene) for scene in editing.future],
        },
    }


def from_document(document: object, where: str) -> Tape:
    """Return the tape that a document holds; BadInput where it is not one of this version's."""
    if not isinstance(document, dict) or _MARK not in document:
        raise BadInput(f"{where}: is not a tape; a tape is a file that G or M wrote in the window")
    if document[_MARK] != VERSION:
        found = repr(document[_MARK])[:20]
        raise BadInput(f"{where}: is a tape of version {found}; this linkanim reads version {VERSION}")
    top = Part(document, where)
    frames = top.whole("frames", 0, _MOST_FRAMES)
    width, height = top.numbers("size", 2)
    return Tape(_start(top, where), frames, _actions(top, frames), (round(width), round(height)))


def _start(top: Part, where: str) -> State:
    start = top.part("start")
    scene = _scene(top.part("scene"), where)
    shelf = tuple(_entry(top, entry, where) for entry in top.items("shelf")) or (scene,)
    clock = Clock(
        scene.linkage.drive.speed,
        phase=start.number("phase"),
        level=start.whole("level", -20, 10),
        direction=-1 if start.whole("direction", -1, 1) < 0 else 1,
        paused=start.flag("paused"),
    )
    return State(
        scene=scene,
        clock=clock,
        shelf=shelf,
        place=start.whole("place", 0, len(shelf) - 1),
        look=_look(start.part("look")),
        help=start.flag("help"),
        editing=_editing(start.part("editing"), where),
    )


def _entry(top: Part, entry: object, where: str) -> Scene | str:
    if isinstance(entry, str) and entry in names():
        return entry
    if isinstance(entry, dict):
        return _scene(Part(entry, where, "shelf."), where)
    raise top.wrong("shelf", entry, "a scene of the catalogue, or a scene whole")


def _scene(part: Part, where: str) -> Scene:
    return scene_from(part.table("document"), name=part.text("name"), where=where)


def _scenes(part: Part, key: str, where: str) -> tuple[Scene, ...]:
    return tuple(_scene(Part(scene, where, f"{part.path}{key}."), where) for scene in part.items(key))


def _look(part: Part) -> Look:
    zoom = part.number("zoom")
    pan = part.numbers("pan", 2)
    chart = part.value("chart")
    if chart is not None and not isinstance(chart, str):
        raise part.wrong("chart", chart, "a quantity's name, or null")
    vectors = part.items("vectors")
    if not set(map(str, vectors)) <= {"v", "a"}:
        raise part.wrong("vectors", vectors, '"v" and "a"')
    return Look(
        theme="dark" if part.text("theme") == "dark" else "light",
        trace=part.flag("trace"),
        vectors=frozenset(map(str, vectors)),
        chart=chart,
        hud=part.flag("hud"),
        background=part.flag("background"),
        zoom=min(max(zoom, 0.01), 100.0),
        pan=(pan[0], pan[1]),
        ghost=part.flag("ghost"),
    )


def _editing(part: Part, where: str) -> Editing:
    past, future = (_scenes(part, key, where) for key in ("past", "future"))
    return Editing(
        open=part.flag("open"),
        chosen=part.whole("chosen", 0, 10_000),
        typed=part.text("typed")[:40],
        past=past,
        future=future,
    )


def _actions(top: Part, frames: int) -> tuple[tuple[int, Action], ...]:
    found = []
    last = 0
    for entry in top.items("actions"):
        frame, action = _action(top, entry)
        if not last <= frame <= frames:
            raise top.wrong("actions", entry, f"in the order of their frames, up to {frames}")
        last = frame
        found.append((frame, action))
    return tuple(found)


def _action(top: Part, entry: object) -> tuple[int, Action]:
    if not isinstance(entry, list) or len(entry) not in (2, 3) or not isinstance(entry[0], int):
        raise top.wrong("actions", entry, "[frame, name] or [frame, name, value]")
    frame, name, value = entry[0], entry[1], entry[2] if len(entry) == 3 else None
    action = Action(name, tuple(value) if isinstance(value, list) else value)
    if not isinstance(name, str) or not is_taped(action):
        raise top.wrong("actions", entry, "an action of this version; record the tape again")
    return frame, action
