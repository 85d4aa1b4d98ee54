"""Every command of every mode is reached by the mouse alone, by a finger alone and by the keys alone."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import Any

import pygame
import pytest
from playing import CTRL, SHIFT, NoSearch, Player, bar_cells_in, the
from shown_lists import words_in

from linkanim.export import json_text
from linkanim.play.games import game_of
from linkanim.player import background
from linkanim.player.action import Action
from linkanim.player.actions import advance
from linkanim.player.commands import bar, menu_of
from linkanim.player.listing import Listing
from linkanim.player.modes import KEYS_OF
from linkanim.player.state import State, begin
from linkanim.scenes import load
from linkanim.synthesis.answers import PathAnswer
from linkanim.ui import screen
from linkanim.ui.devices import code
from linkanim.words import LANGUAGES, spoken
from linkanim.workshop.request import make

SIZE = (1280, 720)
ROWS = (
    (9.0, 7.0, 30.0, 90.0, 45.0, 30.0, 100.0, 0.0, 80.0),
    (8.0, 9.0, 32.0, 95.0, 45.0, 30.0, 105.0, 5.0, 85.0),
)
ANSWERS = tuple(
    number
    for off, row in zip((0.1, 0.4), ROWS, strict=True)
    for number in PathAnswer(off, 1.0, 0.3, 1.0, row, 1.0 - off, 0.7).numbers
)


def after(state: State, *actions: Action | str) -> State:
    for one in actions:
        state = advance(state, [Action(one) if isinstance(one, str) else one])
    return replace(state, effects=())


def rocker() -> State:
    return after(replace(begin(load("crank-rocker")), games=game_of), "pause")


def _with_dial() -> State:
    corners = (Action("pen_to", (40.0 * n, 10.0 * n * n)) for n in range(1, 6))
    drawn = after(rocker(), "pencil", Action("pen_down", (0.0, 0.0)), *corners, "pen_up")
    return after(drawn, Action("cards", (0.0, *ANSWERS)), Action("way", (0.0, *ANSWERS)))


def _posed() -> State:
    return after(rocker(), "poses", Action("set_poses", (0.0, 0.0, 0.0, 0.0, 40.0, 10.0, 0.6)))


def _in_layers() -> State:
    text = json_text(make(load("crank-rocker"), fit="A4").as_object())
    return after(rocker(), "layers", Action("layered", text))


def _in(words: str) -> Callable[[], State]:
    return lambda: after(rocker(), Action("play", words))


# Every mode, and what of it has commands that stand for something else, or none.
MODES: dict[str, Callable[[], State]] = {
    "paused": rocker,
    "running": lambda: after(rocker(), "pause"),
    "edit": lambda: after(rocker(), "edit"),
    "quantities": lambda: after(rocker(), "list"),
    "shelf": lambda: after(rocker(), "shelf"),
    "blank pencil": lambda: after(rocker(), "pencil"),
    "pencil with its dial": _with_dial,
    "blank poses": lambda: after(rocker(), "poses"),
    "poses": _posed,
    "empty sheet": lambda: after(rocker(), "build"),
    "sheet of a scene": lambda: after(rocker(), "build_on"),
    "layers": _in_layers,
    "title": _in("title"),
    "lobby": _in("lobby"),
    "menu": _in("menu"),
    "predict": _in("predict seed=1"),
    "match": _in("match"),
    "follow": _in("follow"),
}


@pytest.fixture(params=MODES)
def player(request: pytest.FixtureRequest, here: object, monkeypatch: pytest.MonkeyPatch) -> Iterator[Player]:
    del here
    monkeypatch.setattr(background, "Following", NoSearch)
    monkeypatch.setattr("linkanim.player.background._start", lambda *_: pytest.fail("no process is needed"))
    with screen.opened(SIZE):
        player = Player(MODES[request.param]())
        player.tick(20)
        yield player
        player.window.close()


def wanted(state: State) -> list[Action]:
    """Return what the list of a mode has to have: all of its table, in a game what that has now."""
    if state.game:
        every = menu_of(state, None)
        assert every
        return [row.action for row in every.entries]
    mode = "paused" if state.mode in ("list", "shelf") else state.mode
    return [action for _, _, action in KEYS_OF[mode].commands if action.name != "menu"]


def open_list(player: Player) -> None:
    """Open the list of all commands by its button on the bar, which every mode has."""
    player.mouse(pygame.MOUSEMOTION, (5, 5), rel=(0, 0), buttons=(0, 0, 0))
    shown = player.window.screen
    assert bar(shown.state)
    buttons = bar(shown.state)
    number = next(n for n, one in enumerate(buttons) if one.name == "all commands")
    cell = bar_cells_in(shown)[number]
    assert cell
    player.drag((cell.middle.real, cell.middle.imag))


def touched(player: Player, kind: int, at: tuple[float, float]) -> list[pygame.event.Event]:
    """Return what the window makes of a finger."""
    place: dict[str, Any] = {"x": at[0] / SIZE[0], "y": at[1] / SIZE[1]}
    event = pygame.event.Event(kind, finger_id=5, touch_id=1, dx=0.0, dy=0.0, **place)
    return player.window._fingers.pointed([event], SIZE)


def asked_by(player: Player, at: tuple[float, float], *, finger: bool) -> Action | None:
    """Return what a click or tap on the list asks for, which is not done."""
    window, scene = player.window, player.state.scene
    down = [pygame.event.Event(pygame.MOUSEBUTTONDOWN, pos=at, button=1)]
    up = [pygame.event.Event(pygame.MOUSEBUTTONUP, pos=at, button=1)]
    if finger:
        down, up = (touched(player, kind, at) for kind in (pygame.FINGERDOWN, pygame.FINGERUP))
    found = [action for event in down for action in window._mouse.actions(event, window.screen)]
    for event in up:
        window._mouse.actions(event, window.screen)
    picked = next((action for action in found if action.name == "pick"), None)
    assert player.state.of(Listing)
    return the(player.state, Listing).asked(scene, picked.value) if picked else None  # type: ignore[arg-type]


@pytest.mark.slow
@pytest.mark.thinned(5)
def test_every_command_is_reached_by_pointing_alone(player: Player) -> None:
    expected = wanted(player.state)
    open_list(player)
    shown = player.window.screen
    assert words_in(shown.state)
    count = len(words_in(shown.state).rows)
    found: dict[int, tuple[Action | None, ...]] = {}
    strip = next((x for x in range(300, 430, 2) if shown.scrolled_to(x, 300, held=False) is not None), None)
    while len(found) < count:
        before = len(found)
        rows = {shown.row_at(60, y): float(y) for y in range(4, 716, 6)}
        for row, y in rows.items():
            if row is not None and row >= 0 and row not in found:
                found[row] = tuple(asked_by(player, (60.0, y), finger=finger) for finger in (False, True))
        if len(found) < count:  # the scroll bar leads on
            assert strip
            track = [y for y in range(2, 718, 2) if shown.scrolled_to(strip, y, held=False) is not None]
            share = min((max(found) + 10) / (count - 1), 1.0)
            player.drag((strip, 300), (strip, track[0] + share * (track[-1] - track[0])))
        assert len(found) > before
    asked = [found[row] for row in range(count)]
    constructions = [both for both in asked if both[0] and both[0].name == "construction" and both[0].value]
    languages = [] if player.state.game else [Action("language", one) for one in LANGUAGES if one != spoken()]
    wanted_then = [(one, one) for one in (*expected, *languages)]
    assert [both for both in asked if both not in constructions] == wanted_then
    assert all(one == other for one, other in constructions)
    assert len(expected) > 10


def press_of(key: str) -> pygame.event.Event:
    """Return the press of a key of the table, as it is written there."""
    *held, last = key.split("+") if len(key) > 1 else [key]
    mod = sum({"ctrl": CTRL, "shift": SHIFT, "alt": pygame.KMOD_LALT}[one] for one in held)
    text = (last.upper() if held == ["shift"] else last) if len(last) == 1 and "ctrl" not in held else ""
    return pygame.event.Event(pygame.KEYDOWN, key=code(last), mod=mod, unicode=text)


def test_every_command_is_reached_by_the_keys_alone(player: Player) -> None:
    def press(key: int) -> None:
        for action in player.window._meant(pygame.event.Event(pygame.KEYDOWN, key=key, mod=0, unicode="")):
            player.window.state = advance(player.state, [action])

    expected, asked = wanted(player.state), []
    press(pygame.K_F10)
    for _ in expected:
        listing = player.state.of(Listing)
        assert listing
        asked.append(listing.asked(player.state.scene, listing.chosen))
        press(pygame.K_DOWN)
    assert asked == expected
    press(pygame.K_ESCAPE)
    assert player.state.of(Listing) is None


def test_the_keys_of_every_mode_ask_for_its_commands(player: Player) -> None:
    for bind in KEYS_OF[player.state.mode].binds:
        assert player.window._meant(press_of(bind.key)) == (bind.action,), bind.key


def test_answers_and_the_dial_are_under_the_mouse_and_a_finger(here: object) -> None:
    del here
    with screen.opened(SIZE):
        player = Player(_with_dial())
        player.settle()
        shown, room = player.window.screen, player.window.screen.last.layout.dial
        assert room
        card = shown.targets("answer")[1].place.middle
        row = room.middle.imag
        spots = [(x, row) for x in range(0, SIZE[0], 20) if shown.target_at("dial", x, row)]
        for finger in (False, True):
            for at, name in (((card.real, card.imag), "answer"), (spots[-1], "dial")):
                events = [pygame.event.Event(pygame.MOUSEBUTTONDOWN, pos=at, button=1)]
                ups = [pygame.event.Event(pygame.MOUSEBUTTONUP, pos=at, button=1)]
                if finger:
                    events, ups = (touched(player, kind, at) for kind in (pygame.FINGERDOWN, pygame.FINGERUP))
                found = [one for event in events for one in player.window._mouse.actions(event, shown)]
                assert name in {one.name for one in found}, (finger, name)
                for event in ups:
                    player.window._mouse.actions(event, shown)
        player.window.close()
