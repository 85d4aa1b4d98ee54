"""Show the window's picture on a real screen.

The display comes first: a window, its size and its pointer. `Screen` has the picture that fits the present
scene, size and look, and what was shown last.
"""

from __future__ import annotations

import atexit
import ctypes
import os
import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
import pygame

from linkanim.build.draft import UNTITLED
from linkanim.errors import NoDisplay
from linkanim.picture.build_sheet import pencil
from linkanim.picture.drawn import Additions
from linkanim.picture.items import Target
from linkanim.picture.layout import Docked, layout
from linkanim.picture.picture import Picture
from linkanim.picture.surface import SurfacePrinter
from linkanim.picture.theme import theme_of
from linkanim.player.browsing import Browsing
from linkanim.player.sight import Sight, shelf_of
from linkanim.player.state import Mode, State
from linkanim.ui.command_bar import share_at
from linkanim.ui.command_icons import window_icon
from linkanim.ui.panels import Panels, PanelSheet, Shown
from linkanim.ui.pictures import Framing, beside, fading, flash, lasting, shutter
from linkanim.ui.pointing import NOWHERE, AtMouse, Pointed, PointedThing, thing_at
from linkanim.ui.shelf import RowPrinter, ShelfPrinter, answers_of
from linkanim.words import said

if TYPE_CHECKING:
    pass

# The display: a window on a real screen.

_INVISIBLE = ("dummy", "offscreen")
_NO_SCREEN = "there is no display to open a window on; `linkanim record SCENE` works without one"
_USUAL = (1280, 720)
_ICON = 64
"""The side of the window's icon, in pixels."""
_IO_ERROR = ctypes.CFUNCTYPE(ctypes.c_int, ctypes.c_void_p)
_EXIT = ctypes.CFUNCTYPE(None, ctypes.c_void_p, ctypes.c_void_p)


@contextmanager
def opened(size: tuple[int, int] | None = None) -> Iterator[Connection]:
    """Open the window, of `size` or as large as suits the screen, and close it on the way out.

    Yields the connection to the display server. NoDisplay where there is no screen; with
    SDL_VIDEODRIVER=dummy none is needed.
    """
    driver, connection = os.environ.get("SDL_VIDEODRIVER"), Connection()
    _prepare()
    try:
        pygame.display.init()
        if driver is None and pygame.display.get_driver() in _INVISIBLE:
            raise NoDisplay(_NO_SCREEN)
        _hasten(pygame.display.get_driver())
        pygame.display.set_icon(window_icon(_ICON))
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
    """Keep SDL from handling signals; on Linux choose settings that are fast and print no warnings."""
    os.environ.setdefault("SDL_NO_SIGNAL_HANDLERS", "1")
    if not sys.platform.startswith("linux"):
        return
    # Pygame has set this to the script's name by now; window lists and tools look for the program's.
    os.environ["SDL_VIDEO_X11_WMCLASS"] = "linkanim"
    # Without this folder Wayland only complains on stderr.
    if not os.environ.get("XDG_RUNTIME_DIR"):
        os.environ.setdefault("SDL_VIDEODRIVER", "x11,kmsdrm")


def _hasten(driver: str) -> None:
    """Bypass OpenGL under X, which is twenty times as fast; Wayland has only OpenGL."""
    if driver == "x11":
        os.environ.setdefault("SDL_FRAMEBUFFER_ACCELERATION", "0")


def _suiting() -> tuple[int, int]:
    """Return the usual size, or the largest of its shape that leaves a small screen some room."""
    screen = min(pygame.display.get_desktop_sizes(), default=_USUAL)
    share = min(1.0, 0.9 * screen[0] / _USUAL[0], 0.9 * screen[1] / _USUAL[1])
    return round(_USUAL[0] * share), round(_USUAL[1] * share)


def display_surface() -> pygame.Surface:
    """Return the window's surface, as large as the window is now; there must be one."""
    surface = pygame.display.get_surface()
    assert surface is not None
    return surface


def name(title: str) -> None:
    """Show a scene's title in the window's frame, without characters that no frame can show."""
    shown = "".join(char for char in title if char.isprintable())
    pygame.display.set_caption(f"{shown} – linkanim")


def point_with(pointer: pygame.Surface | None) -> None:
    """Show a picture as the mouse's pointer, with its tip at the lower left; None for the usual one."""
    # a system without coloured pointers keeps its own
    with suppress(pygame.error):
        if pointer is None:
            pygame.mouse.set_cursor(pygame.SYSTEM_CURSOR_ARROW)
        else:
            pygame.mouse.set_cursor(pygame.Cursor((0, pointer.get_height() - 1), pointer))


def is_full() -> bool:
    """Tell whether the window fills the screen."""
    return bool(display_surface().get_flags() & pygame.FULLSCREEN)


class Placement(NamedTuple):
    """Where a window is (None: not known) and how large, to go back to from full screen."""

    position: tuple[int, int] | None
    size: tuple[int, int]


def frame() -> Placement:
    """Return where the window is now."""
    return Placement(_position(), pygame.display.get_window_size())


def fill(back: Placement) -> Placement:
    """Fill the screen, or go from there back to a window; return the window to go back to.

    It sets a new mode: pygame's `toggle_fullscreen` warns on stderr where there is no window manager.
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
    """The connection to the display server, checked once a frame; where it is lost, the window ends in order.

    Under X the library would end the process at once, with lines of its own on stderr. Wayland, Windows and
    macOS ask a window to close before they go.
    """

    def __init__(self) -> None:
        self.lost = False
        self._asked: Callable[[], object] = lambda: None
        self._watched: int | None = None
        # the library calls these until the process ends, so they must exist as long
        self._handlers = _IO_ERROR(self._broken), _EXIT(self._broken)

    def check(self, recorded: str = "") -> None:
        """Raise NoDisplay where the server is gone; if another connection is open now, watch that one.

        `recorded` is the folder in which what is being recorded is kept.
        """
        if self.lost:
            kept = f"; what was being recorded is kept in {recorded}" if recorded else ""
            raise NoDisplay(f"the display server is gone{kept}")
        if pygame.display.get_driver() != "x11":
            return
        now = _pointer(pygame.display.get_wm_info()["display"])
        if now != self._watched:
            self._watched = now
            self._watch(now)

    def close(self) -> None:
        """Close the window, unless its server is gone: pygame would wait for an answer for ever.

        The rest of pygame stays until the process ends: fonts that outlive it would leak their memory.
        """
        with suppress(pygame.error, KeyError):
            if _pointer(pygame.display.get_wm_info()["display"]) == self._watched:
                self._asked()
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
            library.XSync.argtypes = (ctypes.c_void_p, ctypes.c_int)
            self._asked = lambda: library.XSync(server, 0)  # a question that is answered: is it still there?

    def _broken(self, *_: object) -> int:
        self.lost = True
        return 0


def _pointer(capsule: Any) -> int:
    """Return the address that a capsule of pygame's holds."""
    address = ctypes.pythonapi.PyCapsule_GetPointer
    address.argtypes, address.restype = (ctypes.py_object, ctypes.c_char_p), ctypes.c_void_p
    return int(address(capsule, b"display") or 0)


# The window's picture: the one that fits the present scene, size and look, and what was shown last.


class Screen(Sight):
    """Paints states into the window; a picture that is shown already is not painted again."""

    def __init__(self, state: State) -> None:
        super().__init__(state)
        self.mouse = NOWHERE
        self._shown: object = None
        self._titled: object = None
        self._shelf = ShelfPrinter()
        self._printer = SurfacePrinter()
        self._framing = Framing(window=True)
        self._faded: tuple[State, pygame.Surface] | None = None
        self._row, self._panels = RowPrinter(), Panels()
        self._pointer: object = None

    def show(self, state: State, mouse: AtMouse = NOWHERE) -> None:
        """Paint the state into the window and flip, where it differs from what is shown."""
        surface = display_surface()
        self.state, self.mouse = state, mouse
        shelf, phase, top = self.shelf, state.phase, state.top
        self._point(state, top)
        self._name(state)
        picture, drawn = self._framing.at(state, surface.get_size()), beside(state, mouse)
        sheets, targets = self._over(picture, state, shelf, mouse)
        fades, flashes = fading(state), shutter(state)
        moves = state.frame if any(one.is_live for one in state.modes) else phase
        shown = (picture, moves, state.clock.speed, drawn, sheets, fades, flashes)
        if shown != self._shown:
            old = self._veil(*fades) if fades and fades[1] else None
            self.last = picture
            self._targets = self._paint(surface, picture, state, shelf, drawn, sheets) + tuple(targets)
            if old:
                surface.blit(old, (0, 0))
            if flashes:
                flash(surface, flashes)
            pygame.display.flip()
            self._shown = shown

    def _over(
        self,
        picture: Picture,
        state: State,
        shelf: Browsing | None,
        mouse: AtMouse = NOWHERE,
        shown: Shown = "window",
    ) -> tuple[list[PanelSheet], list[Target]]:
        """Return the sheets over the picture or the shelf, and where they can be clicked."""
        sheets, targets, place = list[PanelSheet](), list[Target](), picture.layout
        if shelf:
            place = layout(self.size, docked=Docked(bar=True))
        else:
            sheets, targets = self._panels.drawn(state, place, picture.theme, mouse, shown)
        if shown == "window":
            bar, buttons = self._panels.bar(state, place, mouse)
            sheets, targets = sheets + bar, targets + buttons
        return sheets, targets

    def _paint(
        self,
        surface: pygame.Surface,
        picture: Picture,
        state: State,
        shelf: Browsing | None,
        drawn: Additions,
        sheets: Sequence[PanelSheet],
    ) -> tuple[Target, ...]:
        """Paint a state's picture or shelf, and the sheets over it; return where the picture is clicked."""
        theme = state.look.theme
        if shelf:
            still, edited = state.clock.paused, state.edited if shelf.has_new else frozenset[int]()
            frame = state.frame - shelf.since
            found = self._shelf.draw(surface, shelf, frame, theme, still=still, edited=edited)
        else:
            self._shelf.close()
            self._printer.print(surface, picture, state.phase, state.clock.speed, drawn)
            row = self._row.draw(surface, picture.layout, answers_of(state), state.frame, theme)
            found = [*self._printer.targets, *row]
        for one in sheets:
            one.surface.set_alpha(round(255 * one.eighths / 8))
            surface.blit(one.surface, one.at)
        return tuple(found)

    def _veil(self, state: State, opacity: int) -> pygame.Surface:
        """Return the picture of a state that fades, at its opacity."""
        if self._faded is None or self._faded[0] is not state or self._faded[1].get_size() != self.size:
            self._faded = state, self.picture(state)
        self._faded[1].set_alpha(opacity)
        return self._faded[1]

    def _point(self, state: State, top: Mode | None) -> None:
        """Show the mouse's pointer as a pencil while the pencil is taken."""
        pointer = (state.look.theme, self.size) if top and top.pointer else None
        if pointer != self._pointer:
            self._pointer = pointer
            drawn = pencil(layout(self.size), theme_of(state.look.theme)) if pointer else None
            point_with(drawn)

    def _name(self, state: State) -> None:
        """Show the scene's title as the window's; the system is asked only where it changes."""
        sheet = state.building
        titled = UNTITLED if sheet and sheet.building.made.scene is None else state.scene.title
        known = titled, titled != UNTITLED and state.place in state.edited, state.language
        if known != self._titled:
            self._titled, title = known, said(titled)
            name(said("{title} • edited", title=title) if known[1] else title)

    def uncovered(self) -> None:
        """Record that the window has to be painted anew."""
        self._shown = None

    def picture(self, state: State) -> pygame.Surface:
        """Return what does not come and go of a state on a surface of its own, as large as the window."""
        surface = display_surface().copy()
        picture = self._framing.at(state, surface.get_size())
        shelf = shelf_of(state)
        sheets, _ = self._over(picture, state, shelf, shown="screenshot")
        self._paint(surface, picture, state, shelf, lasting(state), sheets)
        return surface

    @property
    def size(self) -> tuple[int, int]:
        """The window's size."""
        return pygame.display.get_window_size()

    def from_middle(self, x: float, y: float) -> tuple[float, float]:
        """Return how far a pixel is from that about which the look zooms, in heights of the window.

        Beside a linkage it is the place of the linkage that is nearest: zoomed about that, it stays in sight.
        """
        last, state = self.last, self.state
        is_paper = any(one.is_paper for one in state.modes)
        if not is_paper:
            box, view = last.figure.box, last.view
            (left, top), (right, low) = view.to_pixel(box.left, box.high), view.to_pixel(box.right, box.low)
            x, y = min(max(x, left), right), min(max(y, top), low)
        return (x - last.about[0]) / self.size[1], (y - last.about[1]) / self.size[1]

    def crank_pin(self) -> tuple[float, float]:
        """Return where the input crank's pin is, in pixels."""
        return self.last.crank_pin_px(self.state.displayed.pose(self.state.phase, 0))

    def help_at(self, x: float, y: float) -> str | None:
        """Return the keys of the line of the open help under a pixel, "" elsewhere on it; None off it."""
        line = self.target_at("line", x, y)
        return line.value if line else "" if self.target_at("help", x, y) else None

    def button_at(self, x: float, y: float) -> int | None:
        """Return the number of the command of the bar under a pixel, -1 between them; None off the bar."""
        number = self.number_at("button", x, y)
        return -1 if number is None and self.target_at("bar", x, y) else number

    def share_at(self, number: int, x: float) -> float:
        """Return the share of a slider on the bar, 0 to 1, at a pixel's x."""
        cell = next((one.place for one in self.targets("button") if one.value == number), None)
        return share_at(cell, x) if cell else 0.0

    def on_trace(self, x: float, y: float, reach: float) -> tuple[str, float] | None:
        """Return the joint whose curve passes a pixel within a reach, and its phase there; None elsewhere."""
        picture, at = self.last, complex(*self.world(x, y))
        if not self.state.leads or not (picture.look.trace or picture.look.ink):
            return None
        scene, points = self.state.displayed, []
        for joint in scene.trace:
            path = scene.point_path(joint)
            away = np.abs(path.places - at)
            n = int(away.argmin())
            if path.moves and away[n] * picture.view.scale <= reach:
                points.append((float(away[n]), joint, float(path.phases[n])))
        return min(points)[1:] if points else None

    def pointed(self, x: float, y: float, reach: float) -> Pointed | None:
        """Return the thing of the scene at a pixel, or an instant on its chart or a curve; else None."""
        phase, place, picture = self.charted(x, y), self.world(x, y), self.last
        if phase is not None:
            return Pointed(place, instant=phase)
        reading = self.target_at("reading", x, y) if self.state.mode in ("play", "paused") else None
        if reading:
            return Pointed(place, PointedThing("row", reading.value))
        scale, half = picture.view.scale, picture.gauge.bar
        scene = self.state.displayed
        thing = thing_at(picture.figure, scene.pose(self.state.phase, 0), place, reach / scale, half / scale)
        curve = self.on_trace(x, y, reach) if thing is None or thing.kind != "joint" else None
        thing_there = Pointed(place, None if curve else thing, curve[1] if curve else None)
        return thing_there if thing or curve else None
