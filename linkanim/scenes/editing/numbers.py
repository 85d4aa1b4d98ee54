"""The numbers of a scene's document that can be edited: what each is called, what it lies between."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from typing import Any, NamedTuple

from linkanim.mechanics.linkage.linkage import Body
from linkanim.scenes.fields.drive import DRIVE
from linkanim.scenes.fields.form import Field, Key, fields_in
from linkanim.scenes.fields.scene_file import SCENE_FILE
from linkanim.scenes.fields.shorthands import SHORTHANDS
from linkanim.scenes.fields.types import ValueType
from linkanim.scenes.scene import Scene

_COUNTED = re.compile(r"([a-z]{2})(\d+)$")
_SHORT = 2
"""A name of so many letters stands for nothing by itself."""
_ADJECTIVES = frozenset({"left", "right", "upper", "lower", "large", "small", "short", "long"})
_SPEED = {one.key: one.usual for one in DRIVE.fields if one.key == "speed"}


class Number(NamedTuple):
    """A number of a document: the way to it, its field, which item of a list it is, and what is written."""

    key: Key
    field: Field
    type: ValueType
    part: int | None
    written: Any

    def ends(self, scene: Scene) -> tuple[str | None, str]:
        """Return the joint that it is measured from, if any, and the one that it leads to."""
        if self.field.spans:
            return self.field.spans[0 if self.field.drag == "place" else self.part or 0]
        joint = scene.linkage.joint(str(self.key[1]))
        bars = joint.bars if self.field.drag == "distance" else ()
        return (bars[self.part or 0][0] if bars else None), joint.name

    def label(self, scene: Scene) -> str:
        """Return what it is called, in the words of a class: "Crank 2", "Coupler point, along".

        Links are numbered as in textbooks where a shorthand numbers them, or by the body of the scene that
        the bar belongs to; a bar is called by its two joints where that is not enough.
        """
        labels = self.field.label
        text = labels if isinstance(labels, str) else labels[self.part or 0]
        text = f"{{name}}, {text}" if text[0].islower() else text
        return text.format_map(self._words(text, scene))

    def _words(self, text: str, scene: Scene) -> Mapping[str, str]:
        names = scene.info.link_names
        section, name = self.key[0], str(self.key[-1] if len(self.key) < 2 else self.key[1])
        if section in SHORTHANDS:
            links = {body: words.removeprefix("second ") for body, words in names.items()}
            return links | {body.capitalize(): words.capitalize() for body, words in links.items()}
        if section == "bodies":
            return {"name": _named(name, names)}
        if section in ("springs", "dampers"):
            strut = next(item for item in scene.linkage.springs + scene.linkage.dampers if item.name == name)
            words = scene.linkage.strut_words(strut)
            return {"name": words[:1].upper() + words[1:]}
        return {
            "name": name,
            "bar": _bar(*self.ends(scene), scene) if "{bar}" in text else "",
            "on": "–".join(getattr(scene.linkage.by_name.get(name), "on", ())),
        }


def numbers(document: Mapping[str, Any]) -> Iterator[Number]:
    """Iterate what can be edited, in the order of the form; the drive's speed is always there."""
    stated = {**document, "drive": _SPEED | document.get("drive", {})}
    for key, one, holder in fields_in(SCENE_FILE, stated):
        written = holder[key[-1]]
        if one.plain is None or one.plain.measure is None:
            continue
        if isinstance(written, list):
            yield from (Number((*key, n), one, one.plain, n, item) for n, item in enumerate(written))
        else:
            yield Number(key, one, one.plain, None, written)


def _bar(start: str | None, end: str, scene: Scene) -> str:
    """Return what a bar is called: by its body's number, and by its joints where it is not a crank."""
    body = _body({start, end}, scene)
    word = "Crank" if end in {crank.name for crank in scene.linkage.cranks} else "Bar"
    if body and body.name.isdigit():
        return f"Crank {body.name}" if word == "Crank" else f"Bar {body.name}, {start}–{end}"
    own = body and body.name not in (f"{start}{end}", f"{end}{start}")
    called = _named(body.name, scene.info.link_names) if body and own else word
    return f"{called}{',' * (called.startswith('Bar ') or called[-1].isdigit())} {start}–{end}"


def _body(joints: set[str | None], scene: Scene) -> Body | None:
    return next((body for body in scene.linkage.bodies if joints <= set(body.joints)), None)


def _named(body: str, names: Mapping[str, str]) -> str:
    """Return what a body is called: by its number, "Bar b", "Upper bar", "Rod 2", or by its name alone."""
    if body.isdigit():
        return f"Link {body}"
    words = _COUNTED.sub(r"\1 \2", names[body])
    if len(words) <= _SHORT:
        return f"Bar {words}"
    return f"{words} bar".capitalize() if words in _ADJECTIVES else words[:1].upper() + words[1:]
