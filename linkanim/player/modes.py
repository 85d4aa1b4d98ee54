"""All modes of the window, and one table of their keys and those that always hold."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from linkanim.player.bands import ToleranceBand
from linkanim.player.building import OpenSheet, SheetNumbers
from linkanim.player.edits import Dimensions
from linkanim.player.finding import Finder
from linkanim.player.keys import KEYS, OF_MODES, ModeKeys
from linkanim.player.lesson import CaptionLine
from linkanim.player.listing import Listing
from linkanim.player.making import Layering
from linkanim.player.naming import Naming
from linkanim.player.pencil import Pencil
from linkanim.player.posing import Posing
from linkanim.player.reassembling import OpenClosures
from linkanim.player.record_dialog import RecordDialog
from linkanim.player.ruler import Ruler
from linkanim.player.shelving import OpenShelf
from linkanim.player.state import Game, Mode, Resolver

MODES: tuple[type[Mode], ...] = (
    Dimensions,
    Listing,
    Finder,
    OpenShelf,
    OpenClosures,
    OpenSheet,
    SheetNumbers,
    Pencil,
    Posing,
    Layering,
    ToleranceBand,
    Ruler,
    Game,
    Naming,
    RecordDialog,
    CaptionLine,
)
"""The modes that can be open over the picture."""
KEYS_OF: Mapping[str, ModeKeys] = {one.name: one for one in (*OF_MODES, *(mode.keys for mode in MODES))}
"""The keys of each mode, by its name."""
MEANINGS: Mapping[str, Resolver] = {name: one for mode in MODES for name, one in mode.meanings.items()}
"""What actions ask that depend on what is visible, or outside."""


def key_names() -> tuple[str, ...]:
    """Return every bound key's name once, without modifiers (a key alone may be '+')."""
    tables = (KEYS, *(one.table for one in KEYS_OF.values()))
    names = (bind.key for table in tables for rows in table.values() for row in rows for bind in row.binds)
    return tuple(dict.fromkeys(name.removeprefix("ctrl+").removeprefix("shift+") for name in names))


def _lines() -> Iterator[tuple[str, str]]:
    """Yield all lines of the table, those of a mode under its subject."""
    yield from ((row.keys, row.words) for rows in KEYS.values() for row in rows)
    tables = (one.table for one in KEYS_OF.values())
    lines = (
        (f"{subject}: {row.keys}", row.words) for one in tables for subject in one for row in one[subject]
    )
    yield from dict.fromkeys(lines)


def as_markdown() -> str:
    """Return the table in Markdown, for the manual."""
    return "\n".join(["| key | does |", "|---|---|", *(f"| {keys} | {words} |" for keys, words in _lines())])
