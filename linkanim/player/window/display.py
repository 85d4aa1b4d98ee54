"""The display: a window on a screen that is really there."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from typing import NamedTuple

import pygame

from linkanim.errors import NoDisplay
from linkanim.player.window.connection import Connection

_INVISIBLE = ("dummy", "offscreen")
_NO_SCREEN = "there is no display to open a window on; `linkanim record SCENE` works without one"
_USUAL = (1280, 720)


@contextmanager
def opened(size: tuple[int, int] | None = None) -> Iterator[Connection]:
    """Open the window, of `size` or as large as suits the screen, and close it on the way out.

    Gives the connection to the display server. NoDisplay where there is no screen; SDL_VIDEODRIVER=dummy
    asks for none, and gets none.
    """
    driver, connection = os.environ.get("SDL_VIDEODRIVER"), Connection()
    _prepare()
    try:
        pygame.display.init()
        if driver is None and pygame.display.get_driver() in _INVISIBLE:
            raise NoDisplay(_NO_SCREEN)
        _hasten(pygame.display.get_driver())
        pygame.display.set_mode(size or _suiting(), pygame.RESIZABLE)
        connection.check()
        yield connection
    except pygame.error as error:
        if pygame.display.get_init() and pygame.display.get_surface():
            raise
        raise NoDisplay(f"{_NO_SCREEN} ({error})") from None
    finally:
        connection.close()
        if driver is None:
            os.environ.pop("SDL_VIDEODRIVER", None)


def _prepare() -> None:
    """Keep SDL off the sound and off our signals; on Linux choose what is quick and quiet there."""
    os.environ.setdefault("SDL_AUDIODRIVER", "dummy")
    os.environ.setdefault("SDL_NO_SIGNAL_HANDLERS", "1")
    if not sys.platform.startswith("linux"):
        return
    # Pygame has put the script's name there by now; window lists and tools look for ours.
    os.environ["SDL_VIDEO_X11_WMCLASS"] = "linkanim"
    # Without this folder Wayland only complains on stderr.
    if not os.environ.get("XDG_RUNTIME_DIR"):
        os.environ.setdefault("SDL_VIDEODRIVER", "x11,kmsdrm")


def _hasten(driver: str) -> None:
    """Let pictures go past OpenGL under X, which is twenty times as fast; Wayland knows only OpenGL."""
    if driver == "x11":
        os.environ.setdefault("SDL_FRAMEBUFFER_ACCELERATION", "0")


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


def name(title: str) -> None:
    """Let the window's frame show a scene's title, without what no frame can show."""
    shown = "".join(char for char in title if char.isprintable())
    pygame.display.set_caption(f"{shown} – linkanim")


def is_full() -> bool:
    """Tell whether the window fills the screen."""
    return bool(surface().get_flags() & pygame.FULLSCREEN)


class Placement(NamedTuple):
    """Where a window is (None: not known) and how large, to go back to from full screen."""

    position: tuple[int, int] | None
    size: tuple[int, int]


def frame() -> Placement:
    """Return where the window is now."""
    return Placement(_position(), pygame.display.get_window_size())


def fill(back: Placement) -> Placement:
    """Fill the screen, or go from there back to a window; return the window to go back to.

    A new mode, and not `toggle_fullscreen`, which warns on stderr where there is no window manager.
    """
    if is_full():
        _set_mode(back.size, pygame.RESIZABLE, back.position)
        return back
    back = frame()
    _set_mode((0, 0), pygame.FULLSCREEN, (0, 0))
    return back


def _set_mode(size: tuple[int, int], flags: int, position: tuple[int, int] | None) -> None:
    """Set another mode; under X with a single screen, where no window manager may be, in a new window.

    Without one an old window would neither move to the screen's corner nor shrink again.
    """
    if pygame.display.get_driver() != "x11" or len(pygame.display.get_desktop_sizes()) > 1:
        pygame.display.set_mode(size, flags)
        return
    caption = pygame.display.get_caption()
    pygame.display.quit()
    pygame.display.init()
    pygame.display.set_caption(*caption)
    pygame.display.set_mode(size, flags)
    if position is not None and hasattr(pygame.display, "set_window_position"):
        pygame.display.set_window_position(position)


def _position() -> tuple[int, int] | None:
    """Return where the window is; None with plain pygame, which cannot tell."""
    known = hasattr(pygame.display, "get_window_position")
    return pygame.display.get_window_position() if known else None
