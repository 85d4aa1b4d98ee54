"""What pictures are made of: filled shapes and captions, in groups, for a surface and a file alike."""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Iterator, Sequence
from typing import Any, NamedTuple, Protocol

import pygame

from linkanim.picture.raster import Colour, Layer
from linkanim.picture.shapes import cut
from linkanim.picture.text import Anchor, Type
from linkanim.picture.view import Rect


class Target(NamedTuple):
    """A place that can be clicked, and its value.

    It is a "list", a "row" with its number, the column of "boxes", the "track" of a scroll bar with the
    count of rows, the "help", a "line" of it with its keys, a "toast"; the "bar", a "button" of it with
    its number; a "tool", or an "answer", with its number; the "dial" and the "slider", with the rail of
    their knob; a row among the "numbers" or the "offers" on a sheet, with its number, −1 for their title,
    and the rows; a "chart", with its panel, a "chart-title" with its token, a "polygon" with its order, a
    "reading" with its row's label, "" for the class; the "shelf" with its grid, an "entry" of it with its
    place, its scroll bar, "shelf-track".
    """

    kind: str
    place: Rect
    value: Any = None

    def moved(self, x: float, y: float) -> Target:
        """Return the target by so much further right and down."""
        return self._replace(place=self.place._replace(x=self.place.x + x, y=self.place.y + y))


class DrawnSheet(NamedTuple):
    """A drawn sheet, and where it can be clicked, from its upper left corner."""

    sheet: pygame.Surface
    targets: tuple[Target, ...] = ()

    def at(self, x: float, y: float) -> list[Target]:
        """Return where it can be clicked with its corner there."""
        return [one.moved(x, y) for one in self.targets]


class Underlay(Protocol):
    """What lies below the shapes of a sheet on surfaces, such as a photograph."""

    def draw(self, surface: pygame.Surface) -> None:
        """Draw it on a surface of the picture's size."""


class Halo(NamedTuple):
    """A rim round letters that sets them off from what is below: its colour and width in pixels."""

    colour: Colour
    width: float


class Caption(NamedTuple):
    """One line of text; `at` is its top, at its left, middle or right as `anchor` says.

    `of` is what it names, such as "joint:A"; where it is empty its group says what kind of words it is.
    """

    text: str
    at: tuple[float, float]
    size: int
    colour: Colour
    anchor: Anchor = "left"
    strong: bool = False
    halo: Halo | None = None
    of: str = ""

    def around(self, type_: Type) -> Rect:
        """Return the rectangle that the caption takes up."""
        wide = type_.width(self.text, self.size, strong=self.strong)
        left = self.at[0] - {"left": 0.0, "centre": 0.5, "right": 1.0}[self.anchor] * wide
        return Rect(left, self.at[1], wide, self.size)


Item = Layer | Caption


_KINDS = {"words": "readout", "key": "legend", "far-centres": "legend", "chart": "axis", "reading": "axis"}
"""What words are of that name no part of the linkage, by their groups."""

SHEET = "sheet"
"""The name of the group on which the others are drawn."""


class Group(NamedTuple):
    """Shapes that belong together, under a name, and the words over them.

    Groups lie over each other in their order, except that words lie over the shapes of all groups up to the
    next group that is `over` them. A `still` group is the same object at every frame. A group shows only
    inside the rectangle `within`. Groups of one picture with equal keys have equal shapes. `made_of` is the
    object that places the shapes in a pose, for printers of all poses at once. What lies `under` a sheet is
    drawn on surfaces alone. `targets` are where it can be clicked.
    """

    name: str
    layers: Sequence[Layer]
    captions: Sequence[Caption] = ()
    still: bool = False
    over: bool = False
    within: Rect | None = None
    key: Hashable = None
    made_of: object = None
    under: Underlay | None = None
    targets: tuple[Target, ...] = ()

    def shifted(self, right: float, down: float) -> Group:
        """Return the group so many pixels to the right and down."""
        words = [one._replace(at=(one.at[0] + right, one.at[1] + down)) for one in self.captions]
        layers = [one.placed(complex(right, down)) for one in self.layers]
        targets = tuple(one.moved(right, down) for one in self.targets)
        return self._replace(layers=layers, captions=words, targets=targets)

    @property
    def named(self) -> Iterator[Caption]:
        """The words, each with what it is of: a thing of the linkage, or the kind of the group's words."""
        kind = _KINDS.get(self.name, self.name)
        return (line if line.of else line._replace(of=kind) for line in self.captions)


def grouped(name: str, items: Iterable[Item], *, still: bool = False) -> Group:
    """Return items under a name, the words over the shapes."""
    kept = list(items)
    shapes = [item for item in kept if isinstance(item, Layer)]
    return Group(name, shapes, [item for item in kept if isinstance(item, Caption)], still)


def words_of(items: Iterable[Item | Group]) -> str:
    """Return the words of items and groups, one line behind the other."""
    lines = (item.captions if isinstance(item, Group) else [item] for item in items)
    return " ".join(line.text for some in lines for line in some if isinstance(line, Caption))


def flat(groups: Iterable[Group]) -> Iterator[Layer]:
    """Yield the shapes of all groups in their order."""
    return (layer for group in groups for layer in group.layers)


def clipped(group: Group) -> Iterator[Layer]:
    """Yield the shapes of a group, cut off at the right and lower edge of the rectangle it is within."""
    if group.within is None:
        yield from group.layers
        return
    right, bottom = int(group.within.right), int(group.within.bottom)
    for layer in group.layers:
        loops = (cut(cut(loop, right), bottom, down=True) for loop in layer.loops)
        yield layer._replace(loops=[loop for loop in loops if len(loop) > 2])
