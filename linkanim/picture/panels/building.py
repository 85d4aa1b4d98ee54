"""What is shown of a linkage that is being built, as data: places in the scene's unit, y up."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

from linkanim.build.draft import Photo
from linkanim.build.shapes import Shape
from linkanim.mechanics.linkage.joint import Point


class Snap(NamedTuple):
    """What is under the hand: a joint, or a line or bar with its ends, and where that is met."""

    at: Point
    ends: tuple[Point, Point] | None = None


class Rubber(NamedTuple):
    """What the hand draws from place to place with a tool, and its measures in words."""

    tool: str
    begin: Point
    end: Point
    words: str = ""


class ToolShown(NamedTuple):
    """A tool of the bar: which icon, its name, its key."""

    icon: str
    name: str
    key: str


@dataclass(frozen=True)
class ToolBar:
    """The bar of tools: the one in hand, and the one that the mouse is over."""

    tools: tuple[ToolShown, ...]
    chosen: int = 0
    pointed: int | None = None


@dataclass(frozen=True)
class DraftShown:
    """A draft that does not move yet: its shapes from the back to the front.

    `crank` are the pivot and the pin of the driven one; a bar's colour is that of its place among the bars,
    the crank first. The joints `traced` bear marks.
    """

    shapes: tuple[Shape, ...] = ()
    crank: tuple[Point, Point] | None = None
    traced: tuple[Point, ...] = ()


@dataclass(frozen=True)
class BuildShown:
    """A sheet with what is built on it: the `draft`, or the linkage itself and what is `loose` beside it.

    `sentence` says what it is or what is missing, as a warning or not, `facts` what it can do. What is
    `chosen` is lit, with its number in words or as it is typed. The `cursor` is that of the keys. Where
    there are no tools, as in a recording, the place of the `hand` is shown. A `photo` lies
    behind, and its `anchor` stays where it is.
    """

    draft: DraftShown | None = None
    loose: DraftShown | None = None
    sentence: str = ""
    facts: tuple[str, ...] = ()
    chosen: Shape | None = None
    number: str = ""
    rubber: Rubber | None = None
    snap: Snap | None = None
    cursor: Point | None = None
    tools: ToolBar | None = None
    hand: Point | None = None
    photo: Photo | None = None
    anchor: Point | None = None
    is_warning: bool = False
