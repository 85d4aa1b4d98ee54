"""Why a draft does not move yet, in the field's words, and what would make it."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from typing import Any

from linkanim.build.draft import Draft, named_in
from linkanim.build.freedom import mobility
from linkanim.build.order import Found, ends_of, plates_of
from linkanim.errors import BadInput

EMPTY = "An empty sheet: click where the first ground pin stands"
_WORDS = {"sliders": "guide", "yokes": "slot", "gears": "gear pair"}
_HOLDING = ("points", "bars", "sliders", "slots", "yokes", "gears")
"""The kinds that hold joints."""
_OWN = ("points", "sliders", "yokes", "gears")
_APART = re.compile(r"(joint |joints\.)(?P<joint>[^:]+): the bars of (?P<lengths>.*) cannot meet")
_KEYS = re.compile(r"^draft: (joints: |[a-z-]+: (?=joint )|[a-z_.-]+\.(?P<name>[^:.= ]+)[^:]*: )?")


def missing(draft: Draft, known: Found) -> str:
    """Return what a draft lacks before its scene can be read, its joints as they are found; "" if nothing."""
    if not draft.of("pins"):
        return EMPTY
    if not draft.of("bars") and not draft.of("sliders"):
        return "No bar yet: drag one from a ground pin"
    if draft.driven is None:
        return "Nothing is driven: choose a crank or a slider, and make it the drive"
    return _too_many(draft, known) or _unfound(draft, known)


def reworded(draft: Draft, error: BadInput) -> str:
    """Return why reading a draft's document refused it, as a sentence about what was drawn."""
    text = str(error)
    if apart := _APART.search(text):
        joint = apart["joint"]
        names = [_body_of(draft, joint, end) for _, end, _ in draft.bars_at(joint)]
        return f"Bars {' and '.join(names[:2])} ({apart['lengths']}) cannot meet{text[apart.end() :]}"
    name = (_KEYS.match(text) or {"name": None})["name"]
    text = f"{name or ''}: {_KEYS.sub('', text)}".removeprefix(": ")
    return text[:1].upper() + text[1:]


def _too_many(draft: Draft, known: Found) -> str:
    """Say what holds joints that are held already; "" where everything is needed."""
    pins, plates = draft.of("pins"), plates_of(draft)
    for name, table in known.items():
        ends = set(ends_of(table)) if "from" in table else {name}
        if ends <= pins.keys() and "on" not in table.get("line", {}):
            if len(ends) < 2:
                return f"{name} cannot move: its guide and its bar both stand on the ground; remove one"
            three = ", ".join(sorted((*ends, name)))
            return f"{three}: all three pins in one body, which is the ground; remove a bar"
    for bar, table in draft.of("bars").items():
        one, other = table["joints"]
        both = all(end in known or end in pins for end in (one, other))
        if any({one, other} <= plate.keys() for plate in plates):
            continue
        if both and other not in ends_of(known.get(one, {})) and one not in ends_of(known.get(other, {})):
            why = f"{one} and {other} are held without it"
            if third := _third(draft, one, other):
                why = f"{', '.join(sorted((one, other, third)))} are all three pins in one body"
            return f"Bar {_body_of(draft, one, other)} ({bar}) is one too many: {why}; remove a bar"
    for kind, key in (("sliders", "line"), ("yokes", "slide"), ("gears", "gear")):
        for name in draft.of(kind):
            table = known.get(name, {})
            if table and key not in table and not (kind == "sliders" and "slide" in table):
                return f"The {_WORDS[kind]} of {name} is one too many: it is held without it; remove one"
    for name, slot in draft.of("slots").items():
        held = {slot["through"], *draft.ends(slot["bar"])}
        if {*known, *pins} >= held and not _slides(known, slot, draft.ends(slot["bar"])):
            return f"The slot of {name} is one too many: {slot['through']} is held without it; remove one"
    return ""


def _slides(known: Found, slot: Mapping[str, Any], ends: list[str]) -> bool:
    """Tell whether a joint was found by a slot: as what runs in it, or as the slotted bar's end."""
    through = slot["through"]
    line = known.get(through, {}).get("line", {})
    by_end = any(known.get(end, {}).get("slot", {}).get("through") == through for end in ends)
    return by_end or line.get("on") == list(ends)


def _third(draft: Draft, one: str, other: str) -> str | None:
    """Return a joint that bars or the ground hold to both of two others."""
    pins = set(draft.of("pins"))
    near = [
        {end for _, end, _ in draft.bars_at(joint)} | (pins if joint in pins else set())
        for joint in (one, other)
    ]
    return min((near[0] & near[1]) - {one, other}, default=None)


def _unfound(draft: Draft, known: Found) -> str:
    """Say what is loose, or closes only all at once; "" where every joint is found."""
    stuck = [name for name in draft.places if name not in known and name not in draft.of("pins")]
    if not stuck:
        return ""
    free = mobility(draft)
    if free > 1:
        bars = "one more bar" if free == 2 else f"{free - 1} more bars"
        hanging = next((name for name in stuck if len(list(draft.bars_at(name))) < 2), stuck[0])
        return f"Mobility {free}: {bars}, or a second drive (a gear pair); {hanging} is loose"
    for group in (_together(draft, stuck, name) for name in stuck):
        if mobility(draft, group | known.keys()) < 1:
            return f"Mobility {free}: {', '.join(sorted(group))} cannot move; remove a bar"
    group = _together(draft, stuck, stuck[0])
    begin = next((name for name in stuck if any(end in known for _, end, _ in draft.bars_at(name))), stuck[0])
    others = ", ".join(name for name in draft.places if name in group and name != begin)
    if not others:
        return (
            f"{begin} is held as no dyad holds it: two bars meet, or a bar and a guide, or a bar and a slot"
        )
    return (
        f"A triad begins at {begin}: it is found only together with {others}, which no chain of dyads can; "
        "drive another crank"
    )


def _together(draft: Draft, stuck: list[str], begin: str) -> set[str]:
    """Return the joints that hang together with one of those that are not found."""
    group, more = set[str](), {begin}
    while more:
        group |= more
        held = (names for names in _holds(draft) if names & group)
        more = {name for names in held for name in names if name in stuck} - group
    return group


def _holds(draft: Draft) -> Iterator[set[str]]:
    """Yield which joints each thing that holds joints names."""
    for kind in _HOLDING:
        for name, table in draft.of(kind).items():
            guide = draft.of("guides").get(table.get("guide"), {})
            bar = draft.of("bars").get(table.get("bar"), {})
            named = {joint for each in (table, guide, bar) for _, joint in named_in(each)}
            yield (named | ({name} if kind in _OWN else set())) & draft.places.keys()


def _body_of(draft: Draft, one: str, other: str) -> str:
    """Return the name of the body that two joints are on; theirs where it has none."""
    return draft.body_of([one, other]) or "–".join(sorted((one, other)))
