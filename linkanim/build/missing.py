"""Why a draft does not move yet, in the field's words, and what would make it."""

from __future__ import annotations

from linkanim.build.draft import Draft
from linkanim.build.order import found
from linkanim.errors import BadInput


def missing(draft: Draft) -> str:
    """Return what a draft lacks before its scene can be read; "" where nothing does."""
    if not draft.of("pins"):
        return "An empty sheet: click where the first ground pin stands"
    if not draft.of("bars") and not draft.of("sliders"):
        return "No bar yet: drag one from a ground pin"
    if draft.driven is None:
        return "Nothing is driven: choose a crank or a slider, and make it the drive"
    stuck = [name for name in draft.places if name not in draft.of("pins") and name not in found(draft)]
    free = mobility(draft)
    if stuck and free > 1:
        bars = "one more bar" if free == 2 else f"{free - 1} more bars"
        return f"Mobility {free}: {bars}, or a second drive (a gear pair)"
    if stuck:
        return f"{', '.join(stuck)} cannot be found yet"
    return ""


def mobility(draft: Draft) -> int:
    """Return a draft's degrees of freedom: two of each joint, less what its bars, guides and gears take.

    A point of a body takes both, a bar, a guide, a slot and a gear pair one each.
    """
    held = sum(len(draft.of(kind)) for kind in ("bars", "sliders", "slots", "yokes", "gears"))
    return 2 * (len(draft.places) - len(draft.of("pins")) - len(draft.of("points"))) - held


def reworded(draft: Draft, error: BadInput) -> str:
    """Return why reading a draft's document refused it, as a sentence about what was drawn."""
    return str(error)
