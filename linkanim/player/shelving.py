"""A mode: the shelf, on which all mechanisms and the current folder's scene files stand."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, ClassVar

from linkanim.frozen import frozen
from linkanim.player import rules
from linkanim.player.action import Action, Value
from linkanim.player.browsing import Browsing, Grid, OwnFile, grid
from linkanim.player.keys import (
    BACK_BAR,
    HOME_BAR,
    LAST_BAR,
    KeyRow,
    ModeKeys,
    TypedKeys,
    both,
    digits,
    enter,
)
from linkanim.player.state import STILL, Mode, Resolver, Rule, State
from linkanim.words import said, to_say

if TYPE_CHECKING:
    from linkanim.player.hand import Gesture, Hand, Outside
    from linkanim.player.sight import Sight

_LONGEST = 40
_NO_FILES = to_say("there is no scene file in the current folder; Ctrl+S writes one")


def toggle(state: State, _: None) -> State:
    """Open the shelf, or close it."""
    if state.of(OpenShelf):
        return state.without(OpenShelf)
    return state.unlisted.with_mode(OpenShelf(state.shelf, state.place, state.frame))


def _changed(state: State, work: Callable[[OpenShelf], OpenShelf]) -> State:
    shelf = state.of(OpenShelf)
    return state.with_mode(work(shelf)) if shelf else state


def _move(state: State, further: int) -> State:
    """Choose the entry `further` places on among those found; the shelf wraps around."""

    def moved(shelf: OpenShelf) -> OpenShelf:
        places = shelf.matches
        if shelf.chosen not in places:
            return shelf
        return replace(shelf, chosen=places[(places.index(shelf.chosen) + further) % len(places)])

    return _changed(state, moved)


def _point(state: State, number: int) -> State:
    """Choose a place on the shelf."""
    return _changed(state, lambda one: replace(one, chosen=number) if number in one.matches else one)


def _top(state: State, row: int) -> State:
    """Scroll the shelf to a row."""
    return _changed(state, lambda one: replace(one, top=row))


def _filter(state: State, text: str) -> State:
    """Add letters to what the shelf is searched for."""
    return _changed(state, lambda one: one.filtered((one.typed + text)[:_LONGEST]))


def _erase_filter(state: State, _: None) -> State:
    """Take the last letter off what the shelf is searched for."""
    return _changed(state, lambda one: one.filtered(one.typed[:-1]))


def _files(state: State, lines: str) -> State:
    """Put the user's own files on the open shelf: one a line, its name, a tab and its date."""
    own = tuple(OwnFile(*line.split("\t")[:2]) for line in lines.split("\n") if "\t" in line)
    opened = state if state.of(OpenShelf) else toggle(state, None)
    return _changed(opened, lambda one: replace(one, own=own))


# What keys and the mouse ask that depends on the rows that are visible, and on the folder.


def _ahead(window: Outside) -> Grid | None:
    """Return the grid of the open shelf as it will be drawn; None where none is open."""
    shelf = window.state.of(OpenShelf)
    return grid(window.screen.size, shelf) if shelf else None


def _put_chosen(window: Outside, _: Value) -> Iterator[Action]:
    """Yield the action that shows the chosen mechanism, if any has the typed words."""
    shelf = window.state.of(OpenShelf)
    if shelf and shelf.chosen in shelf.matches:
        yield from _put(window, shelf.chosen)


def _put(window: Outside, place: Value) -> Iterator[Action]:
    """Yield the action that shows what is at a place: a mechanism, or a user's file."""
    shelf = window.state.of(OpenShelf)
    yield from shelf.takes(place) if shelf and isinstance(place, int) else (Action("put", place),)


def _opened(window: Outside, _: Value) -> Iterator[Action]:
    """Yield the actions that open the shelf with the current folder's scene files, or close it."""
    yield Action("shelf")
    files = window.scene_files() if window.state.of(OpenShelf) else ()
    if files:
        yield Action("files", _listed(files))


def _files_here(window: Outside, _: Value) -> Iterator[Action]:
    """Yield the actions that open the shelf at the current folder's scene files."""
    files = window.scene_files()
    if not files:
        yield Action("note", said(_NO_FILES))
        return
    yield Action("files", _listed(files))
    yield Action("point", len(window.state.shelf))


def _listed(files: Iterable[OwnFile]) -> str:
    """Return files as the value of an action."""
    return "\n".join(f"{one.name}\t{one.written}" for one in files)


def _moved(window: Outside, further: Value) -> Iterator[Action]:
    """Yield a step in a list or along the shelf, which scrolls with it."""
    if shown := _ahead(window):
        yield Action("top", shown.top)
    yield Action("move", further)


def _row(window: Outside, rows: Value) -> Iterator[Action]:
    """Yield the action that chooses the mechanism `rows` rows further down."""
    shelf, shown = window.state.of(OpenShelf), _ahead(window)
    if shelf and shown and isinstance(rows, int):
        yield Action("top", shown.top)
        yield Action("point", shown.neighbour(shelf.chosen, rows))


def _scroll(window: Outside, rows: Value) -> Iterator[Action]:
    """Yield the actions that scroll by `rows`; the chosen entry stays a visible one."""
    shelf, shown = window.state.of(OpenShelf), _ahead(window)
    if shelf is None or not shown or not shown.rows or not isinstance(rows, int):
        return
    free = shown.scrolled(rows)
    yield Action("top", free.top)
    if not free.whole(shelf.chosen):
        # in a low window no entry may be visible as a whole
        seen = [n for n in free.cells if free.whole(n)] or [*free.cells]
        yield from (Action("point", n) for n in (seen[:1] if rows > 0 else seen[-1:]))


@frozen
class OpenShelf(Browsing, Mode):
    """The open shelf."""

    keys = ModeKeys(
        "shelf",
        {
            "in O": (
                KeyRow(
                    "arrows, mouse",
                    "choose a mechanism",
                    both("left", "right", "move") + both("up", "down", "row"),
                ),
                KeyRow("type", "filter by title or chapter"),
                KeyRow("1–9", "another of the chapter that is on", digits("select")),
                KeyRow("PgUp, PgDn, wheel", "scroll", both("pageup", "pagedown", "scroll", 2)),
                KeyRow("Enter, click", "put it on", enter("put_chosen", "erase_filter")),
            )
        },
        TypedKeys("filter", frozenset({"space", "h", "o", *"123456789"})),
    )
    bar = (BACK_BAR, HOME_BAR, *LAST_BAR)
    actions: ClassVar[Mapping[str, Rule]] = {
        "shelf": Rule(rules.nothing, toggle, taped=False),
        "files": Rule(rules.text, _files, taped=False),  # scene files with their dates, one a line
        "move": Rule(rules.whole, _move, taped=False),  # places
        "point": Rule(rules.whole, _point, taped=False),  # the place
        "top": Rule(rules.whole, _top, taped=False),  # the first visible row
        "filter": Rule(rules.text, _filter, taped=False),
        "erase_filter": Rule(rules.nothing, _erase_filter, taped=False),
    }
    meanings: ClassVar[Mapping[str, Resolver]] = {
        **{"put": _put, "put_chosen": _put_chosen, "shelf": _opened, "files_here": _files_here},
        **{"move": _moved, "row": _row, "scroll": _scroll},
    }
    gives_way = True

    def takes(self, number: int) -> tuple[Action, ...]:
        """Return the actions that show what is at a place: a mechanism, or a user's file."""
        file = self.file_at(number)
        return (Action("shelf"), Action("open_file", file.name)) if file else (Action("put", number),)

    @property
    def is_live(self) -> bool:
        """Its mechanisms run."""
        return True

    def typing(self, state: State) -> bool:
        """Return whether the shelf is filtered."""
        del state
        return bool(self.typed)

    def mouse(self, gesture: Gesture, mouse: Hand, screen: Sight) -> tuple[Action, ...]:
        """Choose the mechanism under the mouse; a click shows it, and a click elsewhere closes the shelf.

        A drag scrolls: on the pictures these follow the hand, beside them the scroll bar does.
        """
        (x, y), drag = mouse.at, mouse.drag
        seen: Grid | None = next((one.value for one in screen.targets("shelf")), None)
        if seen is None:
            return ()
        place = screen.number_at("entry", x, y)
        moves = mouse.far > STILL * screen.size[1]
        match gesture.kind:
            case "wheel":
                return (Action("scroll", -gesture.notches),)
            case "down":
                on_track = screen.target_at("shelf-track", x, y) is not None
                mouse.drag, mouse.steps = "scroll" if on_track else "shelf", seen.top
                return _scrolled_to(seen.led_to(y), seen.top) if on_track else ()
            case "up":
                mouse.drag = None
                if drag != "shelf" or moves:
                    return ()
                return (Action("shelf") if place is None else Action("put", place),)
        if drag == "scroll":
            return _scrolled_to(seen.led_to(y), seen.top)
        if drag == "shelf":
            to = mouse.steps + round((mouse.begun[1] - y) / seen.step)
            return _scrolled_to(to, seen.top) if moves else ()
        return () if place is None else (Action("point", place),)


def _scrolled_to(row: int, top: int) -> tuple[Action, ...]:
    return (Action("scroll", row - top),) if row != top else ()
