"""The display: a window on a screen that is really there."""

from __future__ import annotations

import atexit
import ctypes
import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from typing import Any, NamedTuple

import pygame

from linkanim.errors import NoDisplay

_INVISIBLE = ("dummy", "offscreen")
_NO_SCREEN = "there is no display to open a window on; `linkanim record SCENE` works without one"
_USUAL = (1280, 720)
_IO_ERROR = ctypes.CFUNCTYPE(ctypes.c_int, ctypes.c_void_p)
_EXIT = ctypes.CFUNCTYPE(None, ctypes.c_void_p, ctypes.c_void_p)


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
    """Keep SDL off our signals; on Linux choose what is quick and quiet there."""
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


def point_with(pointer: pygame.Surface | None) -> None:
    """Let the mouse's pointer be a picture, its lower left corner the place; None for the usual one."""
    # a system without pointers of its own colour keeps what it has
    with suppress(pygame.error):
        if pointer is None:
            pygame.mouse.set_cursor(pygame.SYSTEM_CURSOR_ARROW)
        else:
            pygame.mouse.set_cursor(pygame.Cursor((0, pointer.get_height() - 1), pointer))


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


class Connection:
    """Whether the display server is still there, looked at once a frame; else the window ends in order.

    Under X the library would end the process there and then, with lines of its own on stderr. Wayland,
    Windows and macOS ask a window to close before they go.
    """

    def __init__(self) -> None:
        self.lost = False
        self._watched: int | None = None
        # the library calls them until the process ends: they must live as long
        self._handlers = _IO_ERROR(self._broken), _EXIT(self._broken)

    def check(self) -> None:
        """Raise NoDisplay where the server is gone; watch the one that is open now, if it is another."""
        if self.lost:
            raise NoDisplay("the display server is gone; what was being recorded is kept in recordings/")
        if pygame.display.get_driver() != "x11":
            return
        now = _pointer(pygame.display.get_wm_info()["display"])
        if now != self._watched:
            self._watched = now
            self._watch(now)

    def close(self) -> None:
        """Close the window; of one whose server is gone pygame would wait for an answer for ever.

        The rest of pygame stays until the process ends: of fonts that outlive it the memory is lost.
        """
        if self.lost:
            atexit.unregister(pygame.quit)
        else:
            pygame.display.quit()

    def _watch(self, server: int) -> None:
        """Ask the library to go on after an error, which versions before 1.7 (2020) cannot."""
        with suppress(OSError, AttributeError):
            library = ctypes.CDLL("libX11.so.6")
            goes_on = library.XSetIOErrorExitHandler
            goes_on.argtypes, goes_on.restype = (ctypes.c_void_p, _EXIT, ctypes.c_void_p), None
            library.XSetIOErrorHandler.argtypes = (_IO_ERROR,)
            library.XSetIOErrorHandler(self._handlers[0])
            goes_on(server, self._handlers[1], None)

    def _broken(self, *_: object) -> int:
        self.lost = True
        return 0


def _pointer(capsule: Any) -> int:
    """Return the address that a capsule of pygame's holds."""
    address = ctypes.pythonapi.PyCapsule_GetPointer
    address.argtypes, address.restype = (ctypes.py_object, ctypes.c_char_p), ctypes.c_void_p
    return int(address(capsule, b"display") or 0)
