"""Read what tapes and lessons have stored, and write it: a scene as a whole, a look."""

from __future__ import annotations

from typing import Any

from linkanim.intake import Section, meant
from linkanim.picture.look import TOGGLES, Look
from linkanim.scenes.reading import scene_from
from linkanim.scenes.scene import Scene

_LEAST_ZOOM, _MOST_ZOOM = 0.01, 100.0


def scene(top: Section, key: str) -> Scene:
    """Return the scene that a table holds as a whole."""
    part = top.table(key)
    document = part.need("document")
    if not isinstance(document, dict):
        raise part.error("document", "must be a scene file's table")
    return scene_from(document, name=_file_name(part), where=part.where)


def _file_name(part: Section) -> str:
    """Return a scene's name, by which files are named; BadInput for one that leads out of their folder."""
    name = part.text("name")
    if not 1 <= len(name) <= 200 or not name.isprintable() or name.startswith(".") or set(name) & set("/\\:"):
        raise part.error("name", "must be a name without a folder; record the tape again")
    return name


def look(part: Section, usual: Look = Look()) -> Look:  # noqa: B008 -- frozen
    """Return the look that a table has; a field that is not in it has its usual value."""
    values: dict[str, Any] = {name: _value(part, name) for name in TOGGLES if name in part}
    if "zoom" in part:
        values["zoom"] = min(max(part.number("zoom"), _LEAST_ZOOM), _MOST_ZOOM)
    if "pan" in part:
        pan = part.listed("pan", 2)
        values["pan"] = tuple(pan.number(side) for side in pan.values)
    return Look(**{**vars(usual), **values})


def refuse_unknown(part: Section, *others: str) -> None:
    """Refuse keys of a table that are no fields of a look, nor one of the `others`."""
    known = (*TOGGLES, "zoom", "pan", *others)
    for key in part.values:
        if key not in known:
            raise part.error(key, f"is not known{meant(key, known)}; there are {', '.join(known)}")


def written_look(shown: Look, usual: Look = Look()) -> dict[str, Any]:  # noqa: B008 -- frozen
    """Return a look as a table: the fields whose values are not the usual ones."""
    names = (*TOGGLES, "zoom", "pan")
    values = {name: getattr(shown, name) for name in names if getattr(shown, name) != getattr(usual, name)}
    return {name: _plain(value) for name, value in values.items()}


def _plain(value: Any) -> Any:
    """Return a value as a file has it: a set, and a pair, as a list."""
    return (
        sorted(value) if isinstance(value, frozenset) else list(value) if isinstance(value, tuple) else value
    )


def _value(part: Section, name: str) -> Any:
    """Return the value of a field of the look."""
    steps, usual = TOGGLES[name].steps, getattr(Look(), name)
    match usual:
        case bool():
            return part.flag(name)
        case int():
            return part.whole(name, steps[0], steps[-1])
        case frozenset():
            members = part.listed(name)
            return frozenset(members.choice(key, steps) for key in members.values)
        case str():
            return part.choice(name, steps)
    if part.need(name) is None:
        return None
    return part.choice(name, steps) if steps else part.text(name)
