"""The chapters that rounds are about, and all of them together."""

from __future__ import annotations

from linkanim.errors import BadInput
from linkanim.scenes import chapters, names
from linkanim.units import shown

ALL = "all"


def members(chapter: str) -> tuple[str, ...]:
    """Return the scenes of a chapter, or of all; BadInput for another name."""
    if chapter == ALL:
        return names()
    found = chapters().get(chapter)
    if found is None:
        raise BadInput(f"there is no chapter {shown(chapter)}; there are {ALL}, {', '.join(chapters())}")
    return tuple(found)


def titled(chapter: str) -> str:
    """Return a chapter's name as a heading."""
    return "All mechanisms" if chapter == ALL else chapter[:1].upper() + chapter[1:]
