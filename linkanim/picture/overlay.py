"""Describe what lies over the picture: lists, help, a toast, marks of state, a linkage being built.

These are data only; places are in the scene's unit, y up. Modules such as `panels`, `game_panel`, `marks`,
`build_sheet` and `tools` draw them.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import replace
from functools import cached_property
from typing import TYPE_CHECKING, ClassVar, Literal, NamedTuple, Protocol, Self, TypeVar

from linkanim.frozen import frozen
from linkanim.mechanics.linkage import Point
from linkanim.picture.game_panel import GamePanel
from linkanim.picture.lists import ListPanel
from linkanim.picture.look import ThemeName
from linkanim.scenes import chapter_of, titles
from linkanim.scenes.scene import Scene
from linkanim.words import said, to_say

if TYPE_CHECKING:
    from linkanim.build.draft import Photo
    from linkanim.mechanics.motion import Pose
    from linkanim.picture.figure import DrawSetting
    from linkanim.picture.items import Group
    from linkanim.synthesis.answers import PathAnswer
    from linkanim.synthesis.curves import DrawnCurve
    from linkanim.synthesis.guidance import PoseAnswer

Key = TypeVar("Key")

# What is shown of a linkage that is being built, as data: places in the scene's unit, y up.


class Hover(NamedTuple):
    """What is under the mouse on a sheet: a place in its unit, and how near is on a thing; or a tool."""

    place: Point
    reach: float
    tool: int | None


@frozen
class ToolBar:
    """The bar of tools: the number of the tool in hand, and of the tool under the mouse.

    Where letters and digits are `typed`, the tools' keys need Ctrl.
    """

    chosen: int = 0
    pointed: int | None = None
    typed: bool = False


# Poses that were set down.

NEAR = 0.022
"""How near to a thing counts as on it, as a share of the window's height."""
AXIS = 3.4
"""How long the x axis of a frame is, in lengths of `NEAR`."""


class Head(NamedTuple):
    """A sentence at the picture's head, perhaps as a warning, and facts below it."""

    sentence: str
    facts: tuple[str, ...] = ()
    is_warning: bool = False


class ModeDrawing(Protocol):
    """What an open mode draws into a picture, from its own data."""

    def behind(self, setting: DrawSetting, pose: Pose) -> Iterable[Group]:
        """Return what lies behind the linkage's bars."""

    def groups(self, setting: DrawSetting, pose: Pose) -> Iterable[Group]:
        """Return what lies over the linkage, or is drawn alone."""


class SliderShown(NamedTuple):
    """A slider: its subject, the meaning of its two ends, how many steps it has, and its present step."""

    label: str
    low: str
    high: str
    steps: int
    at: int


# A linkage on its way to its other closure.


class SwingShown(NamedTuple):
    """The closure that the linkage leaves, and the share of the way to its own that is over."""

    left: Scene
    share: float


# The bar of commands at the foot: its commands, and the state of each.


class Button(NamedTuple):
    """A command on the bar: its icon, its name and key, whether it is on, and why it cannot be done.

    Where room is short, buttons of the highest `rank` are left out first. A button that `leads` begins a
    group. With a `share` (0 to 1) it is a slider, three times as wide. With `on_chart` it stands at the
    chart's head.
    """

    icon: str
    name: str
    key: str = ""
    rank: int = 0
    leads: bool = False
    on: bool = False
    lack: str = ""
    share: float | None = None
    on_chart: bool = False


class CommandBar(NamedTuple):
    """The bar: its commands, the number of the one under the mouse, its opacity in eighths."""

    buttons: tuple[Button, ...]
    pointed: int | None = None
    eighths: int = 8


# What lies over the picture for a while: help, a toast, the marks of state.


NEW = -1
"""The place of an empty sheet on the shelf, before all mechanisms."""
NEW_TITLE = to_say("New: an empty sheet")


MINE = to_say("Mine")
"""The chapter of the scene files in the current folder."""


class OwnFile(NamedTuple):
    """A scene file in the current folder: its name, and when it was written last, in words."""

    name: str
    written: str

    @property
    def title(self) -> str:
        """Its name without the ending."""
        return self.name.removesuffix(".toml")


def filtered(texts: Mapping[Key, tuple[str, ...]], typed: str) -> tuple[Key, ...]:
    """Return the keys whose texts have all the typed words, the best ones first.

    The best is the one whose first text is what was typed; then come those with words that begin so. First of
    either are those whose first text has all the words, then those whose first two have them, and so on, each
    in the order of `texts`.
    """
    if not (words := typed.casefold().split()):
        return tuple(texts)
    rows = [(key, [text.casefold() for text in several]) for key, several in texts.items()]
    for word in words:
        rows = [(key, several) for key, several in rows if any(word in text for text in several)]

    def rank(several: list[str]) -> int:
        if several[0].replace("-", " ").split() == typed.casefold().replace("-", " ").split():
            return 0
        return 1 + max(next(n for n, text in enumerate(several) if word in text) for word in words)

    def is_within(several: list[str]) -> bool:
        starts = re.findall(r"\w+", " ".join(several))
        return not all(any(one.startswith(word) for one in starts) for word in words)

    def order(several: list[str]) -> tuple[bool, bool, int]:
        return rank(several) > 0, is_within(several), rank(several)

    return tuple(key for key, several in sorted(rows, key=lambda one: order(one[1])))


def searched(entry: Scene | str) -> tuple[str, str, str]:
    """Return the texts by which a mechanism is found: its name, its title, its chapter."""
    if isinstance(entry, str):
        entry_chapter = chapter_of(entry) or ""
        return entry, said(titles()[entry]), said(entry_chapter)
    return entry.name, said(entry.title), said(entry.chapter)


@frozen
class Browsing:
    """The open shelf: its mechanisms, the chosen one, and the frame at which it was opened.

    Typed letters filter it; it is scrolled to the row numbered `top`. The user's `own` files have the places
    after those of the mechanisms.
    """

    entries: tuple[Scene | str, ...]
    chosen: int
    since: int
    typed: str = ""
    top: int = 0
    own: tuple[OwnFile, ...] = ()

    has_new: ClassVar[bool] = True
    """Whether an empty sheet stands first."""

    @property
    def heading(self) -> str:
        """What stands over it."""
        return said("Mechanisms")

    @property
    def nothing(self) -> str:
        """What is said where nothing has the typed words."""
        return said("no title or chapter contains that")

    def texts(self, number: int) -> tuple[str, str, str]:
        """Return the texts by which the mechanism at a place is found: its name, its title, its chapter."""
        return searched(self.entries[number])

    @cached_property
    def matches(self) -> tuple[int, ...]:
        """The places of the mechanisms and files that have all the typed words, the best ones first."""
        files = ((one.title, one.written, said(MINE)) for one in self.own)
        texts = dict(enumerate((*map(self.texts, range(len(self.entries))), *files)))
        return filtered({NEW: (NEW_TITLE,), **texts} if self.has_new else texts, self.typed)

    def file_at(self, number: int) -> OwnFile | None:
        """Return the file at a place; None where there is a mechanism, or nothing."""
        behind = number - len(self.entries)
        return self.own[behind] if 0 <= behind < len(self.own) else None

    def filtered(self, typed: str) -> Self:
        """Return the shelf with other letters typed, and the best of what is found chosen."""
        other = replace(self, typed=typed, top=0)
        return replace(other, chosen=(*other.matches, self.chosen)[0]) if typed else other


class Shelf(NamedTuple):
    """The open shelf in its theme, and how many frames it has been open; `still` while paused.

    The mechanisms at the places `edited` differ from their files.
    """

    browsing: Browsing
    frame: int
    theme: ThemeName
    still: bool = False
    edited: frozenset[int] = frozenset()


class DialShown(NamedTuple):
    """Where a knob stands, from 0 at the left to 1, between two words; the track may have `marks`."""

    value: float
    low: str
    high: str
    marks: tuple[float, ...] = ()
    held: bool = False


@frozen
class AnswerRow:
    """Linkages for a path or for poses, as answers or scenes, words about each, and which one is shown.

    Linkages for poses come with these `poses`. Lengths are in `unit`. The pictures are those of a `frame`,
    and `still` while paused. A `dial` stands above.
    """

    entries: tuple[PathAnswer | PoseAnswer | Scene, ...]
    names: tuple[str, ...]
    words: tuple[str, ...]
    chosen: int
    unit: str
    frame: int
    theme: ThemeName
    still: bool = False
    dial: DialShown | None = None
    poses: tuple[tuple[float, float, float], ...] = ()


@frozen
class Fading:
    """Words that come and go, and their opacity in eighths."""

    text: str
    eighths: int = 8


class DimensionLine(NamedTuple):
    """A length in words, from place to place in a frame: 1 is the vector from joint to joint, 1j its left.

    In a frame that names one joint twice, 1 is the scene's unit to the right. A `chosen` line is lit.
    """

    frame: tuple[str, str]
    begin: complex
    end: complex
    words: str
    chosen: bool = True

    @property
    def is_bar(self) -> bool:
        """Whether it lies along a bar from joint to joint."""
        return self.frame[0] != self.frame[1] and (self.begin, self.end) == (0, 1)


class HoverText(NamedTuple):
    """The words about a thing under the mouse, `at` a place of the scene; a `joint` also has its arrows."""

    lines: tuple[str, ...]
    at: Point
    joint: str = ""


Help = tuple[tuple[str, tuple[tuple[str, str], ...]], ...]
"""Subjects, each with its lines of (key, what it does)."""


@frozen
class Overlay:
    """What one frame shows beside the scene; the empty one shows nothing.

    Modes have what they have `drawn`, perhaps `alone`, on a sheet or the bare ground, in the linkage's
    place. A `stroke` lies behind the linkage, which is `off` it by so much. `head` is said at the head.
    `construction` is how many steps of the scene's construction are drawn. The joints `handles` can be
    dragged. With `noted` the HUD says that a limit or a change point is near. `chip` answers a key,
    `hint` says which keys to press, `watch` what to watch for. `measured` are the lines of the chosen
    dimension and of those beside it, `glow` is the joint under the mouse, `hover_text` has words about
    the thing there, `instant` the phase that the mouse points at on a curve; with `grip` the chart's
    cursor has a grip. `shutter` is how white the picture is, in eighths. The `bar` has the commands;
    `tools` are those of a sheet, beside a list of dimensions. In a `swing` the linkage is between two
    closures. The share `shut` of an open list is still beyond the window's edge; the mouse is over its
    row `pointed`. A `photo` lies behind a sheet. For those who describe the rest: `hover` is what the
    mouse is over, and what is `recorded` has no mouse.
    """

    paused: bool = False
    toast: str | None = None
    recording: str | None = None
    help: Help | None = None
    listed: ListPanel | GamePanel | None = None
    pointed: int | None = None
    shelf: Shelf | None = None
    drawn: tuple[ModeDrawing, ...] = ()
    alone: Literal["", "sheet", "bare"] = ""
    stroke: DrawnCurve | None = None
    off: str | None = None
    head: Head | None = None
    row: AnswerRow | None = None
    photo: Photo | None = None
    construction: int = 0
    slider: SliderShown | None = None
    swing: SwingShown | None = None
    handles: tuple[str, ...] = ()
    chip: Fading | None = None
    hint: Fading | None = None
    watch: Fading | None = None
    measured: tuple[DimensionLine, ...] = ()
    glow: str | None = None
    hover_text: HoverText | None = None
    instant: float | None = None
    grip: bool = False
    shutter: int = 0
    noted: bool = False
    bar: CommandBar | None = None
    tools: ToolBar | None = None
    shut: float = 0.0
    hover: Hover | None = None
    recorded: bool = False


NOTHING_OVER = Overlay()
"""The empty overlay, of pictures outside of a window."""
