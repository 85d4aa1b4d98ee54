"""What lies over the picture for a while: help, the edit list, a toast, the marks of state."""

from __future__ import annotations

from dataclasses import dataclass

from linkanim.mechanics.linkage.joint import Point
from linkanim.picture.look import ThemeName
from linkanim.scenes.scene import Scene


@dataclass(frozen=True)
class EditRow:
    """One dimension in the edit list: its name, its value as written, and whether it is chosen.

    A `draft` is a value that was typed and is not judged yet.
    """

    label: str
    value: str
    chosen: bool = False
    draft: bool = False


@dataclass(frozen=True)
class Panel:
    """The edit list; `error` is the reason, in words, why the chosen value is refused.

    `facts` are what the lengths make of the linkage; they stand out while `flash` (0 to 1) is above 0.
    """

    rows: tuple[EditRow, ...]
    title: str = "Edit dimensions"
    facts: tuple[str, ...] = ()
    flash: float = 0.0
    error: str | None = None
    hint: str = ""


@dataclass(frozen=True)
class Quantities:
    """The list of quantities: rows of words and symbol, the chosen one's number, the letters that sift."""

    rows: tuple[tuple[str, str], ...]
    chosen: int
    sieve: str = ""
    hint: str = ""


@dataclass(frozen=True)
class Shelf:
    """All mechanisms, those of the catalogue by their names, the chosen one's place, and how many frames it
    has been open; `still` while paused. The places of `edited` are not as their files have them.
    """

    entries: tuple[Scene | str, ...]
    chosen: int
    frame: int
    theme: ThemeName
    still: bool = False
    edited: frozenset[int] = frozenset()


@dataclass(frozen=True)
class Fading:
    """Words that come and go: shown as strongly as so many eighths say."""

    text: str
    eighths: int = 8


@dataclass(frozen=True)
class DimensionLine:
    """A bar between two places of the scene, and its length in words."""

    ends: tuple[Point, Point]
    words: str


Help = tuple[tuple[str, tuple[tuple[str, str], ...]], ...]
"""Subjects, each with its lines of (key, what it does)."""


@dataclass(frozen=True)
class Overlay:
    """What one frame shows beside the scene; the empty one shows nothing.

    With `noted` the HUD says where a limit or a change point is near. `chip` answers a key, `hint` says what
    there is to press. `measured` are two joints and the words for their distance, `glow` the joint under the
    mouse; with `grip` the chart's cursor has one. `shutter` is how white the picture is, in eighths.
    """

    paused: bool = False
    toast: str | None = None
    recording: str | None = None
    help: Help | None = None
    panel: Panel | None = None
    quantities: Quantities | None = None
    shelf: Shelf | None = None
    chip: Fading | None = None
    hint: Fading | None = None
    measured: tuple[str, str, str] | None = None
    glow: str | None = None
    grip: bool = False
    shutter: int = 0
    noted: bool = False
