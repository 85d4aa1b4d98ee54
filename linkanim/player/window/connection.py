"""The connection to the display server: when it breaks, the window ends in order, and says why.

Under X the library ends the process there and then, with lines of its own on stderr, unless it is told
otherwise. Wayland, Windows and macOS ask a window to close before they go.
"""

from __future__ import annotations

import atexit
import ctypes
from contextlib import suppress
from typing import Any

import pygame

from linkanim.errors import NoDisplay

_IO_ERROR = ctypes.CFUNCTYPE(ctypes.c_int, ctypes.c_void_p)
_EXIT = ctypes.CFUNCTYPE(None, ctypes.c_void_p, ctypes.c_void_p)


class Connection:
    """Whether the display server is still there, asked once a frame."""

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
