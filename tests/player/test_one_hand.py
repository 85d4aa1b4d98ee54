"""A lecture by the mouse alone, by a finger alone and by the keys alone, kept as tapes that can be filmed.

`LINKANIM_GOLDENS=write pytest tests/player/test_one_hand.py` writes the tapes anew, with answers that are
searched for; else the answers of the kept tapes are given. One is filmed by
`linkanim record tests/player/tapes/by-touch.tape.json -o by-touch.mp4`.
"""

from __future__ import annotations

import math
import os
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pygame
import pytest
from playing import CTRL, SHIFT, NoSearch, Player, bar_cells_in
from shown_lists import words_in

from linkanim.build.tools import TOOLS
from linkanim.picture.layout import tool_cells
from linkanim.play.arcade import Arcade
from linkanim.play.games import game_of
from linkanim.play.menus import DOORS as TITLE_DOORS
from linkanim.player import background, record_dialog
from linkanim.player.action import Action
from linkanim.player.actions import carried
from linkanim.player.browsing import grid as shelf_grid
from linkanim.player.commands import bar
from linkanim.player.shelving import OpenShelf
from linkanim.player.state import State, begin
from linkanim.player.tape import Taping
from linkanim.player.tape_file import read, write
from linkanim.scenes import load
from linkanim.scenes.editing import dimensions
from linkanim.synthesis.follower import Follower, Reply, Request
from linkanim.ui import screen

TAPES = Path(__file__).parent / "tapes"
SIZE = (1280, 720)
FIRST, SECOND = "drag-link", "crank-rocker"
Place = tuple[float, float]


class Hand:
    """A window and one kind of input, by which alone it is used; gestures are counted."""

    name = ""

    def __init__(self, player: Player) -> None:
        self.player, self.gestures = player, 0

    @property
    def state(self) -> State:
        return self.player.state

    def pixel(self, x: float, y: float) -> Place:
        return self.player.window.screen.pixel(x, y)


class Pointing(Hand):
    """What points: buttons, rows, places and ways."""

    def down(self, at: Place) -> None: ...

    def to(self, at: Place) -> None: ...

    def up(self, at: Place) -> None: ...

    def wake(self, at: Place) -> None: ...

    def drag(self, *places: Place) -> None:
        self.gestures += 1
        self.down(places[0])
        for place in places[1:]:
            self.to(place)
        self.up(places[-1])
        self.player.tick()

    def cell(self, name: str) -> tuple[float, float, float]:
        """Return the middle of a button, and its width; the bar is brought back where it has faded."""
        shown = self.player.window.screen
        if not bar(shown.state):
            self.wake((shown.size[0] / 2, shown.size[1] - 30.0))
        assert bar(shown.state)
        buttons = bar(shown.state)
        number = next(n for n, one in enumerate(buttons) if one.name.startswith(name))
        cell = bar_cells_in(shown)[number]
        assert cell
        return cell.middle.real, cell.middle.imag, cell.width

    def press(self, name: str) -> None:
        self.drag(self.cell(name)[:2])

    def row(self, words: str) -> None:
        """Take the row of the open list that begins so, which is scrolled there if it has to be."""
        shown = self.player.window.screen
        assert words_in(shown.state)
        rows_ = words_in(shown.state).rows
        number = next(n for n, one in enumerate(rows_) if one[0].startswith(words))

        def rows() -> dict[int, float]:
            seen = ((shown.row_at(60, y), float(y)) for y in range(718, 2, -2))
            return {row: y for row, y in seen if row is not None}

        if number not in rows():
            x, y = next(
                (float(x), float(y))
                for x in range(60, 640, 2)
                for y in range(2, 718, 4)
                if shown.scrolled_to(x, y, held=False) is not None
            )
            track = [at for at in range(2, 718, 2) if shown.scrolled_to(x, at, held=False) is not None]
            share = number / (len(rows_) - 1)
            self.drag((x, y), (x, track[0] + share * (track[-1] - track[0])))
        self.drag((60.0, rows()[number] + 3))

    def box(self, words: str) -> None:
        """Tick the box of a row of the open list."""
        shown = self.player.window.screen
        assert words_in(shown.state)
        number = next(n for n, one in enumerate(words_in(shown.state).rows) if one[0] == words)
        x = next(float(x) for x in range(60, 2, -1) if shown.on_box(x) and shown.row_at(x, 100) is not None)
        self.drag((x, next(y + 3.0 for y in range(2, 718) if shown.row_at(x, y) == number)))

    def dialog(self, label: str) -> None:
        """Take the row of the dialog of a recording that begins so."""
        found = [label for label, *_ in record_dialog.rows(self.state)]
        number = next(n for n, one in enumerate(found) if one.startswith(label))
        row_at = self.player.window.screen.row_at
        self.drag((60.0, next(y + 3.0 for y in range(2, 718) if row_at(60, y) == number)))

    def tool(self, name: str) -> None:
        number = next(n for n, one in enumerate(TOOLS) if one.name == name)
        cell = tool_cells(self.player.window.screen.last.layout)[number]
        self.drag((cell.middle.real, cell.middle.imag))

    def option(self, number: int) -> None:
        """Take a door, or the row of a game."""
        option = self.player.window.screen.option_at
        self.drag(next((60.0, float(y)) for y in range(2, 718, 2) if option(60, y) == number))

    def mechanism(self) -> None:
        """Take the second mechanism from the shelf."""
        shown, browsing = self.player.window.screen, self.state.of(OpenShelf)
        assert browsing
        cell = shelf_grid(shown.size, browsing).cells[browsing.entries.index(SECOND)]
        self.drag((cell.middle.real, cell.middle.imag))

    def loop(self) -> Iterator[Place]:
        """Yield the places of a closed stroke."""
        stage = self.player.window.screen.last.layout.stage
        middle, reach = stage.middle, 0.25 * min(stage.width, stage.height)
        for turn in np.linspace(0, 6.2, 40).tolist():
            yield middle.real + 1.3 * reach * math.cos(turn), middle.imag + 0.8 * reach * math.sin(turn)

    def choose(self) -> None:
        self.press("the shelf")
        self.mechanism()

    def run(self) -> None:
        self.press("play / pause")

    def pause(self) -> None:
        self.press("play / pause")

    def slow(self) -> None:
        x, y, wide = self.cell("speed")
        self.drag((x, y), (x - 0.3 * wide, y))

    def trace(self) -> None:
        self.press("coupler trace")

    def chart(self) -> None:
        self.press("the list of quantities")
        self.box("Rocker: angle")
        self.box("Rocker: angular velocity")

    def edit(self) -> None:
        self.press("edit dimensions")
        items = [one.label for one in dimensions(self.state.scene)]
        y = next(
            y for y in range(2, 718) if self.player.window.screen.row_at(60, y) == items.index("Coupler 3")
        )
        self.drag((60.0, y + 4.0), (110.0, y + 4.0))

    def close(self) -> None:
        self.press("edit dimensions")

    def swing(self) -> None:
        self.press("construction")
        self.row("the other closure")

    def draw(self) -> None:
        self.press("draw a path")
        self.drag(*self.loop())
        self.player.tick(90)
        self.press("keep the linkage")

    def open_sheet(self) -> None:
        self.press("build a linkage")

    def quick_return(self) -> None:
        self.tool("line")
        self.drag(self.pixel(-20, 30), self.pixel(110, 30))
        self.tool("pins and bars")
        self.drag(self.pixel(0, 0))
        self.drag(self.pixel(0, 0), self.pixel(30, 0))
        self.drag(self.pixel(30, 0), self.pixel(90, 30))

    def done(self) -> None:
        self.press("done: leave the sheet")

    def save(self) -> None:
        self.press("record and save")
        self.dialog("save the scene")
        self.press("write it")

    def record(self) -> None:
        self.press("record and save")
        self.dialog("Record")

    def stop(self) -> None:
        self.press("record and save")

    def leave(self) -> None:
        self.press("all commands")
        self.row("quit")


class ByMouse(Pointing):
    """The mouse."""

    name = "by-mouse"

    def down(self, at: Place) -> None:
        self.player.mouse(pygame.MOUSEMOTION, at, rel=(0, 0), buttons=(0, 0, 0))
        self.player.mouse(pygame.MOUSEBUTTONDOWN, at, button=1)

    def to(self, at: Place) -> None:
        self.player.mouse(pygame.MOUSEMOTION, at, rel=(0, 0), buttons=(1, 0, 0))

    def up(self, at: Place) -> None:
        self.player.mouse(pygame.MOUSEBUTTONUP, at, button=1)

    def wake(self, at: Place) -> None:
        self.player.mouse(pygame.MOUSEMOTION, at, rel=(0, 0), buttons=(0, 0, 0))


class ByTouch(Pointing):
    """A finger: the system's own mouse events of it come as well, as they do on a real screen."""

    name = "by-touch"

    def _event(self, kind: int, like: int, at: Place, **more: Any) -> None:
        share: dict[str, Any] = {"x": at[0] / SIZE[0], "y": at[1] / SIZE[1]}
        pygame.event.post(pygame.event.Event(kind, finger_id=3, touch_id=1, dx=0.0, dy=0.0, **share))
        pygame.event.post(pygame.event.Event(like, pos=(round(at[0]), round(at[1])), touch=True, **more))
        self.player.tick()

    def down(self, at: Place) -> None:
        self._event(pygame.FINGERDOWN, pygame.MOUSEBUTTONDOWN, at, button=1)

    def to(self, at: Place) -> None:
        self._event(pygame.FINGERMOTION, pygame.MOUSEMOTION, at, rel=(0, 0), buttons=(1, 0, 0))

    def up(self, at: Place) -> None:
        self._event(pygame.FINGERUP, pygame.MOUSEBUTTONUP, at, button=1)

    def wake(self, at: Place) -> None:
        self.drag(at)


class ByKeys(Hand):
    """The keys; a word that is typed, or a key that is held, is one gesture."""

    name = "by-keys"

    def key(self, key: int, mod: int = 0, text: str = "", times: int = 1) -> None:
        self.gestures += 1
        for _ in range(times):
            self.player.press(key, mod, text)

    def word(self, text: str) -> None:
        self.gestures += 1
        self.player.type(text)

    def choose(self) -> None:
        self.word("o")
        self.word(SECOND)
        self.key(pygame.K_RETURN)

    def run(self) -> None:
        self.key(pygame.K_SPACE)

    def pause(self) -> None:
        self.key(pygame.K_SPACE)

    def slow(self) -> None:
        self.key(pygame.K_DOWN, times=6)

    def trace(self) -> None:
        self.word("t")

    def chart(self) -> None:
        self.word("c")
        self.key(pygame.K_k, SHIFT, "K")
        self.key(pygame.K_RETURN)

    def edit(self) -> None:
        self.word("e")
        self.key(pygame.K_DOWN, times=2)
        self.key(pygame.K_RIGHT, times=5)

    def close(self) -> None:
        self.key(pygame.K_ESCAPE)

    def swing(self) -> None:
        self.word("b")

    def draw(self) -> None:
        self.key(pygame.K_w, SHIFT, "W")
        self.player.tick(90)
        self.word("2")
        self.key(pygame.K_RETURN)

    def open_sheet(self) -> None:
        self.key(pygame.K_F2)

    def to(self, x: float, y: float) -> None:
        """Move the cursor of the sheet line by line, and press or let go there."""
        sheet, step = self.state.building, self.player.window.screen.grid_step
        assert sheet
        assert sheet.cursor
        across, up = (round((to - at) / step) for to, at in zip((x, y), sheet.cursor, strict=True))
        for key, times in (
            (pygame.K_RIGHT if across > 0 else pygame.K_LEFT, abs(across)),
            (pygame.K_UP if up > 0 else pygame.K_DOWN, abs(up)),
        ):
            if times:
                self.key(key, times=times)
        self.key(pygame.K_RETURN)

    def quick_return(self) -> None:
        step = self.player.window.screen.grid_step
        self.word("3")
        self.key(pygame.K_UP)  # the cursor comes
        sheet = self.state.building
        assert sheet
        assert sheet.cursor
        x, y = sheet.cursor
        self.to(x - step, y + step)
        self.to(x + 5 * step, y + step)
        self.key(pygame.K_1, CTRL)  # a number alone is the value of the line
        self.to(x, y)
        self.to(x, y)
        self.to(x + step, y)
        self.to(x + step, y)
        self.to(x + 4 * step, y + step)

    def done(self) -> None:
        self.key(pygame.K_F2)

    def save(self) -> None:
        self.key(pygame.K_s, CTRL)
        self.word("lecture")
        self.key(pygame.K_RETURN)

    def record(self) -> None:
        self.word("g")

    def stop(self) -> None:
        self.word("g")

    def leave(self) -> None:
        self.word("q")


class Task(NamedTuple):
    """What is to be done, what has come of it, and whether a tape shows it."""

    done: Callable[[State], object]
    most: int | None = 3
    taped: bool = True


def _coupler(state: State) -> float:
    return next(one.value for one in dimensions(state.scene) if one.label == "Coupler 3")


def _is_other(state: State) -> bool:
    return state.scene.name == SECOND and state.scene.pose(0.0, 0).position["B"][1] < 0.0


CHARTED = {"rocker.angle", "rocker.angular_velocity"}


# What a lecture needs, in the order in which it is done; a drawing takes as many gestures as it has lines.
TASKS: dict[str, Task] = {
    "choose": Task(lambda state: state.scene.name == SECOND),
    "pause": Task(lambda state: state.clock.paused),
    "run": Task(lambda state: not state.clock.paused),
    "slow": Task(lambda state: state.clock.level < 0),
    "trace": Task(lambda state: not state.look.trace),
    "chart": Task(lambda state: {*(state.look.chart or "").split(",")} == CHARTED),
    "edit": Task(lambda state: _coupler(state) > 85.0),
    "close": Task(lambda state: state.mode == "play"),
    "swing": Task(_is_other),
    "draw": Task(lambda state: state.scene.name == "path" and state.sketch is None),
    "open_sheet": Task(lambda state: state.building is not None),
    "quick_return": Task(lambda state: "slider-crank" in state.scene.info.class_name, most=None),
    "done": Task(lambda state: state.building is None and "slider" in state.scene.info.class_name),
    "save": Task(lambda state: state.saved_as is not None, taped=False),
    "record": Task(lambda state: state.recording is not None, taped=False),
    "stop": Task(lambda state: state.recording is None, taped=False),
}


def _kept(name: str) -> Path:
    return TAPES / f"{name}.tape.json"


class _FromTheTape(NoSearch):
    """Replies what the kept tape has of the search, at once."""

    name = ""

    def replies(self) -> Iterator[Reply]:
        asked, self.asked = self.asked, []
        for request in asked:
            yield from self.told(request)

    def told(self, request: Request) -> Iterator[Reply]:
        for _, action in read(_kept(self.name), game_of).actions:
            if action.name == "cards" and isinstance(action.value, tuple) and request.search:
                yield Reply(request.stroke, whole=True, numbers=action.value[1:], chosen=int(action.value[0]))


class _Searched(_FromTheTape):
    """Replies what is found, without a process of its own."""

    def told(self, request: Request) -> Iterator[Reply]:
        yield from Follower().replies(request)


WRITES = os.environ.get("LINKANIM_GOLDENS") == "write"
HANDS = (ByMouse, ByTouch, ByKeys)


@pytest.mark.thinned(2)
@pytest.mark.slow
@pytest.mark.parametrize("kind", HANDS, ids=[one.name for one in HANDS])
def test_a_lecture_is_given_by_one_hand_alone(
    kind: type[Hand], here: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(_FromTheTape, "name", kind.name)
    monkeypatch.setattr(background, "Following", _Searched if WRITES else _FromTheTape)
    monkeypatch.setattr("linkanim.player.background._start", lambda *_: pytest.fail("no process is needed"))
    with screen.opened(SIZE):
        player = Player(replace(begin(load(FIRST)), games=game_of))
        player.window._taping = taping = Taping(player.state, SIZE)
        hand: Any = kind(player)
        player.tick(30)
        for name, task in TASKS.items():
            if name == "record":
                tape, player.window._taping = taping.tape(player.state.frame), None
            if name == "stop":
                monkeypatch.setattr(player.window, "_stop", lambda _: None)
            hand.gestures = 0
            getattr(hand, name)()
            player.tick(30)
            assert task.done(player.state), (kind.name, name, player.state.mode, player.state.look.chart)
            assert task.most is None or hand.gestures <= task.most, (kind.name, name, hand.gestures)
        assert [*here.glob("*.toml")]
        hand.gestures = 0
        hand.leave()
        assert not player.tick()
        assert hand.gestures <= 3
        player.window.close()
    if WRITES:
        TAPES.mkdir(exist_ok=True)
        _kept(kind.name).unlink(missing_ok=True)
        write(tape, _kept(kind.name))


@pytest.mark.slow
@pytest.mark.parametrize("kind", HANDS, ids=[one.name for one in HANDS])
def test_the_tape_of_that_lecture_shows_it(kind: type[Hand]) -> None:
    states = read(_kept(kind.name), game_of).states()
    for name, task in TASKS.items():
        if task.taped:
            assert any(task.done(state) for state in states), name
    assert Action("mouse_moved") not in {action for _, action in read(_kept(kind.name), game_of).actions}


# What is seen two gestures after the title, by its doors.
DOORS: dict[str, tuple[Callable[[Any], object], Callable[[Any], object]]] = {
    "run": (lambda hand: hand.press("names"), lambda state: state.mode == "play"),
    "build": (
        lambda hand: hand.drag(hand.pixel(0, 0)),
        lambda state: state.building.building.draft.of("pins"),
    ),
    "path": (
        lambda hand: hand.drag(*hand.loop()),
        lambda state: state.scene.name == "path" and not state.sketch.is_blank,
    ),
    "play": (lambda hand: hand.option(1), lambda state: state.game.words.startswith("match")),
}


@pytest.mark.thinned(3)
@pytest.mark.parametrize("door", DOORS)
@pytest.mark.parametrize("kind", [ByMouse, ByTouch], ids=["mouse", "touch"])
def test_two_gestures_after_the_title_something_moves_or_asks(
    kind: type[Pointing], door: str, here: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(_FromTheTape, "name", kind.name)
    monkeypatch.setattr(background, "Following", _FromTheTape)
    second, seen = DOORS[door]
    keeper = Arcade(here / "scores.json")
    with screen.opened(SIZE):
        state = replace(begin(load(SECOND)), games=keeper.game_of)
        player = Player(carried(state, Action("play", "title")), keeper=keeper)
        player.tick(30)
        hand = kind(player)
        hand.option([*TITLE_DOORS].index(door))
        player.tick(20)
        second(hand)
        player.tick(60)
        assert seen(player.state)
        assert hand.gestures == 2
        player.window.close()
