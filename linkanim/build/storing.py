"""A draft as plain data, for JSON, and back: a restored draft can be shown, chosen and drawn on."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import Any

from linkanim.build.building import Building, as_drawn
from linkanim.build.dimensions import rows_of
from linkanim.build.draft import JOINT, OWN, Draft, Photo, named_in
from linkanim.build.gestures import under
from linkanim.build.places import drawn, fitted, within_bodies
from linkanim.intake import Section, refuse_controls

_FARTHEST = 1e30
"""The largest number of a draft: squares of its square are still finite."""
_MOST = 1_000
"""The most joints and things drawn on them; a scene has a few dozen."""
_LIST = (list, tuple)
_HOLDS: Mapping[str, Mapping[str, Any]] = {
    "bars": {"joints": _LIST},
    "points": {"on": _LIST, "at": _LIST},
    "sliders": {"guide": str},
    "slots": {"bar": str, "through": str},
    "yokes": {"pin": str},
    "gears": {"with": str},
    "springs": {"between": _LIST},
    "dampers": {"between": _LIST},
    "sides": {"joints": _LIST, "side": str},
}
"""The keys that each kind always has."""


def stored(draft: Draft) -> dict[str, Any]:
    """Return all of a draft as tables, lists, texts and numbers."""
    return {**vars(draft), "typed": sorted(draft.typed, key=repr)}


def restored(tables: Mapping[str, Any], where: str = "draft") -> Building:
    """Return a building with the draft that was stored; BadInput for tables that are no draft, or damaged.

    Everything that a sheet does with a draft is tried here, so that a damaged one fails here and not in use.
    """
    section = Section(where, tables)
    refuse_controls(section)
    _refuse_far(tables, section)
    try:
        building = Building(within_bodies(_draft(tables)))
        _ask(building)
        return as_drawn(building)
    except Exception as error:  # a malformed table may raise anything
        raise section.wrong(f"is no draft of linkanim: {type(error).__name__}") from None


def _ask(building: Building) -> None:
    """Do with a building what a sheet does; raises whatever that raises, LookupError for missing things."""
    draft = building.draft
    things, tables = {*draft.things()}, [*_tables(draft)]
    if len(things) + len(tables) > _MOST:
        raise OverflowError
    named = {thing for _, _, table in tables for thing in named_in(table)}
    own = {(JOINT, name) for kind, name, _ in tables if kind in OWN}
    traced = {(JOINT, name) for name in draft.trace}
    if not {*named, *own, *traced} <= things:
        raise LookupError
    if not all(name in draft.of(str(kind)) for kind, name, *_ in draft.typed):
        raise LookupError
    for kind, _, table in tables:
        holds = _HOLDS.get(kind, {})
        if kind == "bodies":
            holds = {"slider": str} if "slider" in table else {"joints": _LIST}
        if not all(isinstance(table[key], of) for key, of in holds.items()):
            raise TypeError
    _ = building.made, drawn(draft), under(draft, 0.0, 0.0, 1.0), fitted(draft)
    for thing in draft.things():
        rows_of(draft, thing)


def _tables(draft: Draft) -> Iterator[tuple[str, str, Any]]:
    yield from ((kind, name, table) for kind, every in draft.tables.items() for name, table in every.items())


def _draft(tables: Mapping[str, Any]) -> Draft:
    draft = Draft(
        {str(name): (float(x), float(y)) for name, (x, y) in tables["places"].items()},
        {kind: dict(every) for kind, every in tables["tables"].items()},
        dict(tables["rest"]),
        frozenset(tuple(key) for key in tables["typed"]),
        short=tables["short"],
        phase=float(tables.get("phase", 0.0)),
    )
    if tables["photo"] is None:
        return draft
    file, (x, y), width, turn = tables["photo"]
    if not (isinstance(file, str) and file and width > 0):
        raise ValueError(width)
    return replace(draft, photo=Photo(file, (float(x), float(y)), float(width), float(turn)))


def _refuse_far(value: Any, section: Section) -> None:
    """Refuse a number that is not finite, or beyond what can be computed with, wherever it stands."""
    pending = [value]
    while pending:
        one = pending.pop()
        if isinstance(one, Mapping):
            pending += one.values()
        elif isinstance(one, list | tuple):
            pending += one
        elif isinstance(one, int | float) and not abs(one) <= _FARTHEST:
            raise section.wrong(
                "is no draft of linkanim: it has a number that is beyond what can be computed"
            )
