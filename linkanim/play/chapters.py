"""What rounds are about: a chapter, all of them together, or one scene."""

from __future__ import annotations

from linkanim.errors import BadInput
from linkanim.scenes import chapters, names, titles
from linkanim.units import shown

ALL = "all"


def members(chapter: str) -> tuple[str, ...]:
    """Return the scenes of a chapter, of all, or the one scene of that name; BadInput for another name."""
    if chapter == ALL:
        return names()
    found = chapters().get(chapter, [chapter] if chapter in names() else [])
    if not found:
        raise BadInput(f"there is no chapter {shown(chapter)}; there are {ALL}, {', '.join(chapters())}")
    return tuple(found)


def titled(chapter: str) -> str:
    """Return a chapter's or a scene's name as a heading."""
    return "All mechanisms" if chapter == ALL else titles().get(chapter, chapter[:1].upper() + chapter[1:])
