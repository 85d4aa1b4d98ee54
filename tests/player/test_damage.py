"""Drafts, scores, tapes, levels and pictures that are damaged: used, or refused in a line; the file stays.

A few dozen of each as a rule, five hundred with `pytest -m long`.
"""

from __future__ import annotations

import json
import tomllib
from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import replace
from functools import cache
from io import BytesIO
from pathlib import Path
from random import Random
from typing import Any

import pygame
import pytest
import tomli_w
from damage import damaged
from hand import drawn
from PIL import Image
from playing import SIZE
from test_sessions import SESSIONS

from linkanim.build.building import Building, building_of
from linkanim.build.tools import TOOLS
from linkanim.errors import LinkanimError
from linkanim.picture.photograph import refuse_lacking
from linkanim.picture.surface import SurfacePrinter
from linkanim.play.arcade import Arcade
from linkanim.play.games import GameWords, game_of
from linkanim.play.match import FOLDER, level_of
from linkanim.play.scores import load as scores_of
from linkanim.player.action import Action
from linkanim.player.actions import advance, carried
from linkanim.player.building import DRAFT, restored_sheet, stored_text
from linkanim.player.state import State, begin
from linkanim.player.tape import Tape, Taping
from linkanim.player.tape_file import read, to_document
from linkanim.recorder.tape_frames import TapeFrames
from linkanim.scenes import load
from linkanim.ui.panels import Panels
from linkanim.ui.pictures import Framing, beside

FEW, ALL = 30, 500


class Shown:
    """Paints states small, one after the other, and holds them to no fault that asks for a report."""

    def __init__(self) -> None:
        self._framing, self._printer, self._panels = Framing(), SurfacePrinter(), Panels()
        self._surface = pygame.Surface(SIZE, 0, 32)

    def __call__(self, state: State) -> None:
        assert not [effect.value for effect in state.effects if effect.name == "report"]
        picture = self._framing.fitting(state, SIZE)
        self._printer.print(self._surface, picture, state.phase, state.clock.speed, beside(state))
        self._panels.drawn(state, picture.layout, picture.theme)


def sheet(building: Building) -> dict[str, Any]:
    """Return what is kept of a sheet with something built."""
    opened = carried(begin(load("press")), Action("sheet")).building
    assert opened
    found: dict[str, Any] = json.loads(stored_text(replace(opened, building=building)))
    return found


def a_hand(random: Random, state: State) -> Iterator[Action]:
    """Yield what a hand does with any tool, from what is drawn or from paper."""
    places = [*state.building.building.draft.places.values()] if state.building else []
    free = (random.uniform(-150, 150), random.uniform(-150, 150))
    yield Action("tool", random.choice([tool.value for tool in TOOLS if tool.action == "tool"]))
    for name in ("hand_down", "hand_to"):
        yield Action(name, (*random.choice([*places, free]), 5.0, 1.0))
    yield Action("hand_up")
    more = ("remove", "trace_on", "drive_by", "undo_sheet", "redo_sheet", "accept_number")
    yield from (Action(name) for name in random.sample(more, 3))
    yield from (Action("further", 1), Action("digits", "5"), Action("accept_number"))


@cache
def sheets() -> list[dict[str, Any]]:
    built = [drawn(one.lines) for one in SESSIONS[:3]]
    return [sheet(building) for building in (*built, building_of(load("kite")))]


def drafts(random: Random) -> bytes:
    return damaged(random.choice(sheets()), random)


def draft_taken(path: Path, random: Random) -> None:
    """Take a draft up and draw on it."""
    shown, state = Shown(), begin(load("press"))
    text = DRAFT.read(path, path.name)
    restored_sheet(state, text, path.name)
    state = advance(state, [Action("draft", text)])
    shown(state)
    for action in a_hand(random, state):
        state = advance(state, [action])
        assert not [effect.value for effect in state.effects if effect.name == "report"]
    shown(state)


def scores(random: Random) -> bytes:
    missed = [f"{kind}@press@{random.random()}@2" for kind in ("turning", "dead_centre", "fastest")]
    best = {
        name: random.randrange(900) for name in ("all.1", "match-bean", "match-a,b.toml", "follow-press.2")
    }
    return damaged({"linkanim_scores": 1, "door": "play", "best": best, "missed": missed}, random)


def scores_kept(path: Path, _: Random) -> None:
    """Read scores, and begin with them whatever there is to play."""
    scores_of(path)
    arcade = Arcade(path, Random(1))
    for words in ("title", "menu", "match", "follow", "predict level=1 chapter=press"):
        game_of(arcade.completed(words))
    assert arcade.news() == []


@cache
def taped() -> list[Tape]:
    """Return tapes of edits, of a path, of a game and of a sheet."""
    links = (0.1, 1.0, 0.3, 1.0, 9.0, 7.0, 30.0, 90.0, 45.0, 30.0, 100.0, 0.0, 80.0)
    done: dict[str, list[Action]] = {
        "crank-rocker": [Action("edit"), Action("type", "55"), Action("accept"), Action("nudge", 3)],
        "press": [
            Action("pencil"),
            Action("stroke", (1.0, *range(24))),
            Action("answers", (0.0, *links, *links)),
        ],
        "kite": [Action("play", "match level=bean"), Action("grab", "A"), Action("carry", (1.0, 2.0, 1.0))],
        "hoecken": [Action("build_on"), Action("hand_down", (1.0, 2.0, 3.0, 1.0)), Action("hand_up")],
    }
    found = []
    for name, actions in done.items():
        state = replace(begin(load(name)), games=game_of)
        taping = Taping(state, SIZE)
        for action in actions:
            state = advance(state, [action])
            taping.note(state.frame, (action,))
        found.append(taping.tape(state.frame + 5))
        found.append(Taping(state, SIZE).tape(state.frame + 5))
    return found


def tapes(random: Random) -> bytes:
    document = to_document(random.choice(taped()))
    if random.random() < 0.5:
        return damaged(document, random)
    part = random.choice(("actions", "start", "scene"))
    with suppress(ValueError):
        document |= json.loads(damaged({part: document[part]}, random))
    return json.dumps(document).encode()


def tape_played(path: Path, _: Random) -> None:
    tape = read(path, game_of)
    frames = TapeFrames(tape, 10.0, (64, 36))
    for frame in range(min(max(1, round(tape.seconds * 10)), 5)):
        frames.draw(frame)


def levels(random: Random) -> bytes:
    names = sorted(entry.name for entry in FOLDER.iterdir() if entry.name.endswith(".toml"))
    document = tomllib.loads((FOLDER / random.choice(names)).read_text(encoding="utf-8"))
    text = damaged(document, random)
    with suppress(ValueError, TypeError, RecursionError):
        return tomli_w.dumps(json.loads(text)).encode("utf-8", "surrogatepass")
    return text


def level_played(path: Path, random: Random) -> None:
    """Play a level: drag its joints, give up, begin again."""
    shown, state = Shown(), replace(begin(load("press")), games=game_of)
    level_of(str(path))
    words = str(GameWords("match", {"level": str(path)}))
    game_of(words)
    state = advance(state, [Action("play", words)])
    assert state.game
    for joint in ("A", "P"):
        to = (random.uniform(-90, 90), random.uniform(-90, 90), 1.0)
        for action in (Action("grab", joint), Action("carry", to), Action("drop"), Action("option", 0)):
            state = advance(state, [action])
            shown(state)


def pictures(random: Random) -> bytes:
    """Return a picture whose header is real, with some of its bytes others: of its sizes, as a rule."""
    file, kind = BytesIO(), random.choice(("PNG", "JPEG", "BMP", "WEBP"))
    Image.effect_noise((60, 40), 90).convert("RGB").save(file, kind)
    data = bytearray(file.getvalue())
    for _ in range(random.choice((1, 3, 30))):
        data[random.randrange(min(len(data), random.choice((30, 300, 10**6))))] = random.randrange(256)
    return bytes(data[: random.choice((len(data), random.randrange(len(data))))])


def picture_shown(path: Path, _: Random) -> None:
    refuse_lacking(str(path))
    shown, state = Shown(), begin(load("press"))
    shown(advance(state, [Action("photo", str(path))]))


KINDS: dict[str, tuple[str, Callable[[Random], bytes], Callable[[Path, Random], None]]] = {
    "drafts": ("draft.json", drafts, draft_taken),
    "scores": ("scores.json", scores, scores_kept),
    "tapes": ("my.tape.json", tapes, tape_played),
    "levels": ("mine.toml", levels, level_played),
    "pictures": ("digger.png", pictures, picture_shown),
}
kinds = pytest.mark.parametrize("kind", KINDS)


def tried(kind: str, count: int, here: Path) -> None:
    """Try so many damaged files of a kind: each is used, or refused in a line that names it."""
    name, make, use = KINDS[kind]
    random, refused = Random(kind), 0
    for number in range(count):
        path = here / f"{number}-{name}"
        content = make(random)
        path.write_bytes(content)
        try:
            use(path, random)
        except LinkanimError as error:
            refused += 1
            said = str(error)
            if len(said.splitlines()) != 1 or not said.isprintable() or path.name not in said:
                raise
        assert path.read_bytes() == content
        assert [one.name for one in here.iterdir()] == [path.name]
        path.unlink()
    assert refused > 0


@pytest.mark.thinned(2)
@pytest.mark.slow
@pytest.mark.withstands("bad inputs tried", FEW)
@kinds
def test_a_damaged_file_is_used_or_refused_in_a_line_and_stays_as_it_is(kind: str, here: Path) -> None:
    tried(kind, FEW, here)


@pytest.mark.long
@pytest.mark.withstands("bad inputs tried", ALL)
@kinds
def test_five_hundred_damaged_files_are(kind: str, here: Path) -> None:
    tried(kind, ALL, here)
