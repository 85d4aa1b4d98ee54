"""The display: a window on a screen that is really there."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager

import pygame

from linkanim.errors import NoDisplay

_INVISIBLE = ("dummy", "offscreen")
_NO_SCREEN = "there is no display to open a window on; `linkanim record SCENE` works without one"
_USUAL = (1280, 720)


@contextmanager
def opened(size: tuple[int, int] | None = None) -> Iterator[None]:
    """Open the window, of `size` or as large as suits the screen, and close it on the way out.

    NoDisplay where there is no screen; SDL_VIDEODRIVER=dummy asks for none, and gets none.
    """
    asked = os.environ.get("SDL_VIDEODRIVER")
    _prepare()
    try:
        pygame.display.init()
        if asked is None and pygame.display.get_driver() in _INVISIBLE:
            raise NoDisplay(_NO_SCREEN)
        pygame.display.set_mode(size or _suiting(), pygame.RESIZABLE)
        yield
    except pygame.error as error:
        if pygame.display.get_init() and pygame.display.get_surface():
            raise
        raise NoDisplay(f"{_NO_SCREEN} ({error})") from None
    finally:
        pygame.quit()
        if asked is None:
            os.environ.pop("SDL_VIDEODRIVER", None)


def _prepare() -> None:
    """Keep SDL off the sound, off our signals, and off a Wayland that would complain on stderr."""
    os.environ.setdefault("SDL_AUDIODRIVER", "dummy")
    os.environ.setdefault("SDL_NO_SIGNAL_HANDLERS", "1")
    if sys.platform.startswith("linux") and not os.environ.get("XDG_RUNTIME_DIR"):
        os.environ.setdefault("SDL_VIDEODRIVER", "x11,kmsdrm")


def _suiting() -> tuple[int, int]:
    """Return the usual size, or the largest of its shape that leaves a small screen some room."""
    screen = min(pygame.display.get_desktop_sizes(), default=_USUAL)
    share = min(1.0, 0.9 * screen[0] / _USUAL[0], 0.9 * screen[1] / _USUAL[1])
    return round(_USUAL[0] * share), round(_USUAL[1] * share)


def surface() -> pygame.Surface:
    """Return the window's surface, as large as the window is now; there must be one."""
    found = pygame.display.get_surface()
    assert found is not None
    return found


def is_full() -> bool:
    """Tell whether the window fills the screen."""
    return bool(surface().get_flags() & pygame.FULLSCREEN)


def fill(windowed: tuple[int, int]) -> tuple[int, int]:
    """Fill the screen, or go back to a window of that size; return the size to go back to.

    A new mode, and not `toggle_fullscreen`, which warns on stderr where there is no window manager.
    """
    if is_full():
        pygame.display.set_mode(windowed, pygame.RESIZABLE)
        return windowed
    windowed = pygame.display.get_window_size()
    pygame.display.set_mode((0, 0), pygame.FULLSCREEN)
    return windowed
