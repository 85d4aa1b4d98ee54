"""A window to be played in tests: keys, mouse, pixels; its time is the test's."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import pygame

from linkanim.picture.view import Rect
from linkanim.player.commands import Entries, bar
from linkanim.player.files import SceneFile
from linkanim.player.listing import Listing
from linkanim.player.state import CHIP_FRAMES, MOUSE_FRAMES, OneMode, State
from linkanim.synthesis.follower import Reply, Request
from linkanim.ui import screen
from linkanim.ui.panels import watched
from linkanim.ui.window import GameKeeper, Window

SIZE = (320, 180)
SHIFT, CTRL = pygame.KMOD_LSHIFT, pygame.KMOD_LCTRL


class Player:
    """A window, the keys and the mouse to use it with, and its pixels to look at."""

    def __init__(self, state: State, file: SceneFile | None = None, keeper: GameKeeper | None = None) -> None:
        self.window = Window(state, file=file, keeper=keeper)
        self.tick()

    @property
    def state(self) -> State:
        return self.window.state

    @property
    def pixels(self) -> bytes:
        return pygame.image.tobytes(screen.display_surface(), "RGB")

    def tick(self, frames: int = 1) -> bool:
        return self.window.tick(frames)

    def press(self, key: int, mod: int = 0, text: str = "") -> bool:
        """Press a key and let one frame go by; False where that closed the window."""
        pygame.event.post(pygame.event.Event(pygame.KEYDOWN, key=key, mod=mod, unicode=text))
        return self.tick()

    def type(self, text: str) -> None:
        for letter in text:
            self.press(ord(letter), 0, letter)

    def settle(self) -> bytes:
        """Let go by what answers a key, the bar, and what to watch for; return the pixels then."""
        moved = self.state.last_mouse_move
        self.tick(max(CHIP_FRAMES, 0 if moved is None else moved + MOUSE_FRAMES - self.state.frame))
        while watched(self.state) and not self.state.look.names:
            self.tick(60)
        return self.pixels

    def mouse(self, kind: int, at: tuple[float, float], **more: Any) -> bool:
        pygame.event.post(pygame.event.Event(kind, pos=(round(at[0]), round(at[1])), **more))
        return self.tick()

    def drag(self, *places: tuple[float, float]) -> None:
        """Press the left button at the first place, go to the others one by one, and let go."""
        self.mouse(pygame.MOUSEBUTTONDOWN, places[0], button=1)
        for place in places[1:]:
            self.mouse(pygame.MOUSEMOTION, place, rel=(0, 0), buttons=(1, 0, 0))
        self.mouse(pygame.MOUSEBUTTONUP, places[-1], button=1)


def bar_cells_in(shown: screen.Screen) -> list[Rect | None]:
    """Return where the buttons of the bar were drawn, by their numbers; None for those without room."""
    found = {one.value: one.place for one in shown.targets("button")}
    return [found.get(number) for number in range(len(bar(shown.state)))]


def the(state: State, kind: type[OneMode]) -> OneMode:
    """Return the open mode of a kind; there must be one."""
    found = state.of(kind)
    assert found is not None
    return found


def menu_in(state: State) -> Entries:
    """Return the rows of the open list of commands; there must be one."""
    others = the(state, Listing).others
    assert others
    return others


class NoSearch:
    """Stands where the process that looks for linkages would, and finds none."""

    is_over = False

    def __init__(self, *words: str) -> None:
        self.asked: list[Request] = []

    def ask(self, request: Request) -> None:
        self.asked.append(request)

    def replies(self) -> Iterator[Reply]:
        yield from ()

    def close(self) -> None:
        self.is_over = True


def fake_start(started: list[list[str]]) -> Callable[..., object]:
    """Return what starts no process, notes its command, and says that it is done; it fails to answer."""

    class Done:
        def __init__(self, code: int) -> None:
            self._code = code

        def poll(self) -> int:
            return self._code

    def start(command: list[str], message: int, out: int | None = None) -> object:
        del message
        started.append(command)
        return Done(0 if out is None else 1)

    return start
