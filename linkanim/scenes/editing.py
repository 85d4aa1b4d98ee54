"""Change a scene: its dimensions, its unit, its assembly, its joints as handles, its input by hand.

Its parts, in reading order:

- The numbers of a scene's document that can be edited: each one's name, and the joints it lies between.
- Titles and classes: which words of a class a title says, and the title of a scene whose class changes.
- The dimensions of a scene as a list to be edited, and the scene with some of them changed.
- A scene in another unit of length: for pictures, tables and lists.
- The other closure: the same lengths, put together the other way.
- What is no number: the joints whose curves are drawn, and the crank that is driven.
- Joints as handles: which dimensions follow when a joint is dragged.
- What a dimension measures: straight lines in the frames of joints with which they move.
- Where a hand turns the input: towards a point of the scene, or along a direction.
"""

from __future__ import annotations

import cmath
import re
from cmath import rect
from collections.abc import Iterator, Mapping
from dataclasses import replace
from fractions import Fraction
from math import atan2, degrees, hypot
from typing import TYPE_CHECKING, Any, NamedTuple

from linkanim import units
from linkanim.errors import AssemblyError, BadInput, LinkanimError, SceneError
from linkanim.frozen import frozen
from linkanim.mechanics.angles import unit
from linkanim.mechanics.linkage import Body, Joint, Line, Pin, Point, Rigid, Slide
from linkanim.scenes.file_form import DRIVE, SCENE_FILE, SHORTHANDS
from linkanim.scenes.form import LENGTHS, Field, Key, Measure, ValueType, fields_in
from linkanim.scenes.reading import Check, scene_from
from linkanim.scenes.scene import Scene
from linkanim.words import name_said, said, spoken, to_say

if TYPE_CHECKING:
    from difflib import Match

# The numbers of a scene's document that can be edited: each one's name, and the joints it lies between.

_COUNTED = r"([a-z]{2})(\d+)$"
_SHORT = 2
"""A name of up to this many letters does not say by itself what it names."""
_ADJECTIVES = frozenset({"left", "right", "upper", "lower", "large", "small", "short", "long"})
_SPEED = {one.key: one.usual for one in DRIVE.fields if one.key == "speed"}


class Number(NamedTuple):
    """A number of a document: its key, its field, its place in a list, and the value as written."""

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
        """Return the number's name, in the words of a class: "Crank 2", "Coupler point, along".

        Links are numbered as in textbooks where a shorthand numbers them, or by the scene's body to which the
        bar belongs; where that is not enough, a bar is named by its two joints.
        """
        labels = self.field.label
        text = labels if isinstance(labels, str) else labels[self.part or 0]
        if text[0].islower():
            text = said("{name}, {part}", name="{name}", part=said(text))
        elif text != "{bar}":
            text = said(text)
        return text.format_map(self._words(text, scene))

    def _words(self, text: str, scene: Scene) -> Mapping[str, str]:
        names = scene.info.link_names
        section, name = self.key[0], str(self.key[-1] if len(self.key) < 2 else self.key[1])
        if section in SHORTHANDS:
            links = {body: words.removeprefix("second ") for body, words in names.items()}
            links = {body: name_said(words) for body, words in links.items()}
            return links | {body.capitalize(): words.capitalize() for body, words in links.items()}
        if section == "bodies":
            return {"name": _named(name, names)}
        if section == "lengths":
            link = _named(name, names) if name in names else name.capitalize()
            pair = re.sub(" *- *", "–", str(self.key[-1]))
            return {"name": f"{link} {pair}"}
        if section == "loads":
            return {"name": said("Load {name}", name=name)}
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
    """Iterate the numbers that can be edited, in the order of the form; the drive's speed is always there."""
    stated = {**document, "drive": _SPEED | document.get("drive", {})}
    for key, one, holder in fields_in(SCENE_FILE, stated):
        written = holder[key[-1]]
        if one.plain is None or one.plain.measure is None or (one.plain.refers and isinstance(written, str)):
            continue
        if isinstance(written, list):
            yield from (Number((*key, n), one, one.plain, n, item) for n, item in enumerate(written))
        else:
            yield Number(key, one, one.plain, None, written)


def _bar(start: str | None, end: str, scene: Scene) -> str:
    """Return a bar's name: its body's number, and its joints where it is not a crank."""
    body = _body({start, end}, scene)
    word = to_say("Crank") if end in {crank.name for crank in scene.linkage.cranks} else to_say("Bar")
    if body and body.name.isdigit():
        if word == "Crank":
            return said("Crank {name}", name=body.name)
        return said("Bar {name}, {joints}", name=body.name, joints=f"{start}–{end}")
    own = body and body.name not in (f"{start}{end}", f"{end}{start}")
    called = _named(body.name, scene.info.link_names) if body and own else said(word)
    if called.startswith(said("Bar {name}", name="")) or called[-1].isdigit():
        return said("{name}, {part}", name=called, part=f"{start}–{end}")
    return f"{called} {start}–{end}"


def _body(joints: set[str | None], scene: Scene) -> Body | None:
    return next((body for body in scene.linkage.bodies if joints <= set(body.joints)), None)


def _named(body: str, names: Mapping[str, str]) -> str:
    """Return a body's name in the list: by its number, "Bar b", "Upper bar", "Rod 2", or its own name."""
    if body.isdigit():
        return said("Link {name}", name=body)
    words = re.sub(_COUNTED, r"\1 \2", names[body])
    if len(words) <= _SHORT:
        return said("Bar {name}", name=words)
    called = said("{adjective} bar", adjective=name_said(words)) if words in _ADJECTIVES else name_said(words)
    return called[:1].upper() + called[1:]


# Titles and classes: which words of a class a title says, and the title of a scene whose class changes.

_BOUND = frozenset({"a", "an", "and", "at", "by", "its", "of", "the", "with"})
"""Words that need the words before them."""


def beyond_title(title: str, class_name: str) -> str:
    """Return the part of a class that the title does not say: "Grashof" for a crank-rocker titled so."""
    if set(_words(class_name)) <= set(_words(title)):
        return ""
    same, words = _shared(title, class_name), list(re.finditer(r"\w+", class_name))
    if same is None:
        return class_name
    begin, end = words[same.b].start(), words[same.b + same.size - 1].end()
    rest = f"{class_name[:begin].rstrip()} {class_name[end:].lstrip(' ,:')}".strip()
    if rest == "linkage":
        return ""
    if rest.partition(" ")[0] in _BOUND:
        return class_name
    return rest[1:-1] if rest.startswith("(") and rest.endswith(")") else rest


def retitled(before: Scene, after: Scene) -> Scene:
    """Return a scene changed from another under the title that fits it.

    A title that names the class stays as long as it is right; else the new class is the title. A title that
    names no class stays.
    """
    title, phrase = before.original_title or (before.title, _phrase(before.title, before.info.class_name))
    if not phrase:
        return after
    class_name = after.info.class_name
    if f" {phrase} " not in f" {' '.join(_words(class_name))} ":
        own, title = title, _capital(class_name)
        after = replace(after, original_title=(own, phrase))
    document = {**after.document, "title": title} if "title" in after.document else after.document
    return replace(after, title=title, document=document)


def under_class(scene: Scene) -> Scene:
    """Return a scene with its class as its title, in its document too."""
    title = _capital(scene.info.class_name)
    return replace(scene, title=title, document={**scene.document, "title": title})


def _capital(words: str) -> str:
    return words[:1].upper() + words[1:]


def _phrase(title: str, class_name: str) -> str:
    """Return the consecutive words of a class that a title says."""
    same = _shared(title, class_name)
    return " ".join(_words(class_name)[same.b : same.b + same.size]) if same else ""


def _shared(title: str, class_name: str) -> Match | None:
    """Return the longest run of words that title and class share; None where it is no phrase."""
    known, words = _words(title), list(re.finditer(r"\w+", class_name.lower()))
    named = [word[0] for word in words]
    from difflib import SequenceMatcher  # needed for an edited scene only: a window opens sooner without it

    same = SequenceMatcher(None, known, named, autojunk=False).find_longest_match()
    # A single inner word, or words from a preposition on, are no phrase.
    if not same.size or (same.b and (same.size == 1 or named[same.b] in _BOUND)):
        return None
    begin, end = words[same.b].start(), words[same.b + same.size - 1].end()
    return None if "-" in (class_name[begin - 1 : begin], class_name[end : end + 1]) else same


def _words(text: str) -> list[str]:
    return re.findall(r"\w+", text.lower())


# The dimensions of a scene as a list to be edited, and the scene with some of them changed.
#
# A change is made to the document and read again, so that it is checked exactly as a file is.

_BARE = r"(?ia)[+-]?(?:\d+\.?\d*|\.\d+)(?:e[+-]?\d+)?"
_EXACT = 2**53


@frozen
class Dimension:
    """One number of a scene that can be edited.

    `key` is its path into the document, `label` its name. `value` is in `unit`: the scene's for lengths, ""
    for a gear ratio, and for all else, such as angles and masses, the unit as written; only where it is
    `bare` may the unit be left out.
    """

    key: Key
    label: str
    value: float
    unit: str
    kind: Measure
    bare: bool


def dimensions(scene: Scene) -> tuple[Dimension, ...]:
    """Return the dimensions that can be edited, in the order of the scene file's form.

    They are those that the file states, and always the drive's speed; none for a scene without a document.
    They are cached: a window whose list is open asks for them in every frame.
    """
    kept: dict[str, Any] = vars(scene)
    language = f"_dimensions_{spoken()}"
    if language not in kept:
        found = _independent(scene) if scene.document else ()
        kept[language] = tuple(_dimension(number, scene) for number in found)
    return kept[language]  # type: ignore[no-any-return]


def _independent(scene: Scene) -> Iterator[Number]:
    """Yield the scene's numbers, but for places of moving points to which a stated length leads.

    Such a point is moved to the nearest place that has its lengths, so its place is not what is written.
    """
    pairs = (pair for link in scene.document.get("lengths", {}).values() for pair in link)
    ends = {end.strip() for pair in pairs for end in pair.split("-", 1)}
    for number in numbers(scene.document):
        place = number.key[0] == "points" and number.key[1] in ends
        if not place or scene.linkage.joint(str(number.key[1])).fixed:
            yield number


def with_dimensions(scene: Scene, values: Mapping[Key, float | str]) -> Scene:
    """Return the scene with some dimensions changed at once; `scene` itself stays as it is.

    A number, or a text without a unit, is taken in the dimension's unit; a text may name another
    ("3 cm", "1 rad", "90 deg/s"), and a ratio may be a fraction ("1/3"). KeyError for a key that is
    not one of the scene's dimensions; SceneError and AssemblyError as reading a file raises them.
    """
    return with_document(scene, with_values(scene, values))


def with_document(scene: Scene, document: Mapping[str, Any], check: Check | None = None) -> Scene:
    """Return the scene with its document changed; `check` and errors as reading a file has them."""
    return retitled(scene, scene_from(document, name=scene.name, where=scene.name, check=check))


def on_the_way(scene: Scene, values: Mapping[Key, float | str]) -> Scene:
    """Return a scene on the way to `scene`, with these dimensions for an instant; errors as above.

    Where no dyad down the chain limits `scene`, none is checked: a dyad that does not close gives NaN.
    """
    return scene_from(with_values(scene, values), name=scene.name, where=scene.name, goal=scene)


def with_values(scene: Scene, values: Mapping[Key, float | str]) -> Mapping[str, Any]:
    """Return the scene's document with some dimensions changed; KeyError as above."""
    known, document = {number.key: number for number in numbers(scene.document)}, scene.document
    for key, value in values.items():
        document = replaced(document, key, written(value, _dimension(known[key], scene)))
    return document


def _dimension(number: Number, scene: Scene) -> Dimension:
    return dimension_of(number.key, number.label(scene), number.type, number.written, scene.length_unit)


def dimension_of(key: Key, label: str, kind: ValueType, stated: Any, length_unit: str) -> Dimension:
    """Return the dimension of a number with the `stated` value; lengths are in that unit."""
    measure = kind.measure
    assert measure
    if measure in LENGTHS:
        value, unit = units.length(stated, unit=length_unit), length_unit
    elif measure == "ratio":
        value, unit = float(Fraction(stated)), ""
    else:
        value, unit = units.split(stated)
    return Dimension(key, label, value, unit, measure, kind.bare)


def written(value: float | str, dimension: Dimension) -> object:
    """Return a new value as the document writes it: a number, or a text with its unit."""
    text = value.strip() if isinstance(value, str) else repr(value)
    if re.fullmatch(_BARE, text) is None or not dimension.bare:
        return with_unit(text, dimension)
    number = float(text)
    return int(number) if number.is_integer() and abs(number) < _EXACT else number


def with_unit(text: str, dimension: Dimension) -> str:
    """Return a typed value, with the dimension's unit added where it is a number without one."""
    return f"{text} {dimension.unit}" if re.fullmatch(_BARE, text.strip()) and dimension.unit else text


def replaced(document: Any, key: Key, value: object) -> Any:
    """Return the document with another value at a key; the tables around it are new, the rest is shared."""
    if not key:
        return value
    part, rest = key[0], key[1:]
    if isinstance(document, list):
        return [replaced(item, rest, value) if i == part else item for i, item in enumerate(document)]
    return {**document, part: replaced(document.get(part, {}), rest, value)}


# A scene in another unit of length: for pictures, tables and lists.


def in_unit(scene: Scene, unit: str | None) -> Scene:
    """Return the scene in another unit of length, and with it of velocity; itself for its own, and for None.

    It is the same linkage: each length is read again with the unit in which it was written, and rounded once.
    It is for showing; the original scene is the one that is edited and saved. The result is cached.
    SceneError for an unknown unit of length, for a scene without a document, and where a length is too large
    or small to be computed with in that unit.
    """
    if unit is None or unit == scene.length_unit:
        return scene
    if unit not in scene.derived:
        scene.derived[unit] = _read_in(scene, unit)
    return scene.derived[unit]


def _read_in(scene: Scene, unit: str) -> Scene:
    if not scene.document:
        raise SceneError(f"{scene.name}: has no scene file behind it; it stays in {scene.length_unit}")
    document: Any = {**scene.document, "length_unit": unit}
    for number in (one for one in numbers(scene.document) if one.type.measure in LENGTHS):
        if not isinstance(number.written, str) or not units.split(number.written)[1]:
            document = replaced(document, number.key, f"{number.written} {scene.length_unit}")
    goal = scene.goal and in_unit(scene.goal, unit)
    try:
        read = scene_from(document, name=scene.name, where=scene.name, goal=goal)
    except BadInput as error:
        raise SceneError(f"{error}; show it in another unit") from None
    return replace(read, title=scene.title, original_title=scene.original_title)


# The other closure: the same lengths, put together the other way.


_OTHER_CLOSURE = "other closure"


ClosureChoice = tuple[tuple[str, ...], str, str]
"""Where a document says which closure holds: the key, behind its joint's; that closure; and the other one."""


def other_closure(scene: Scene) -> Scene:
    """Return the scene with its first loop on the other closure; twice gives the same linkage again.

    The first loop is the one nearest the input. AssemblyError where there is no second closure, or where it
    cannot be assembled further down the chain.
    """
    choice = _choice(scene)
    if choice is None:
        raise AssemblyError(f"{scene.name} has no second closure: no loop of it can be put together two ways")
    key, name, other_name = choice
    other = scene.derived.pop(_OTHER_CLOSURE, None)
    other = other or with_document(scene, replaced(scene.document, key, other_name))
    if replaced(other.document, key, name) == scene.document:
        other.derived[_OTHER_CLOSURE] = scene  # going back needs no search
    return other


def other_return(scene: Scene) -> Scene:
    """Return the scene whose input comes back from its limits on the other, or on the same, closure.

    AssemblyError where the input turns fully, or can come back on the same closure only.
    """
    if scene.info.full_turn:
        raise AssemblyError(f"{scene.name}: its input turns fully, and never comes back")
    if scene.mechanism.retraced and not scene.linkage.drive.retraced:
        raise AssemblyError(
            f"{scene.name}: it comes back on the same closure, as its links do not close on the whole "
            "swing beyond its limits"
        )
    returns = "other" if scene.linkage.drive.retraced else "same"
    document = replaced(scene.document, ("drive", "returns"), returns)
    return with_document(scene, document)


def closure_name(scene: Scene) -> str | None:
    """Return the name of the first loop's closure (open, crossed, ...); None where it has no other."""
    choice = _choice(scene)
    return choice and said(choice[1])


def ghost_of(scene: Scene) -> Scene | None:
    """Return the other closure, to be drawn behind this one; None where there is none.

    It is cached until it is asked for as a scene of its own.
    """
    try:
        scene.derived[_OTHER_CLOSURE] = other_closure(scene)
    except LinkanimError:
        return None
    return scene.derived[_OTHER_CLOSURE]


def _choice(scene: Scene) -> ClosureChoice | None:
    """Return where the first closure that can be chosen is."""
    return next(iter(closure_choices(scene)), None)


def closure_choices(scene: Scene) -> list[ClosureChoice]:
    """Return where the closures are that can be chosen; a missing key means the first option."""
    document = scene.document
    choices = list[ClosureChoice]()
    joints = document.get("joints", {})
    fields = ((key, form.field("assembly").plain) for key, form in SHORTHANDS.items() if key in document)
    shorthands = [((key, "assembly"), plain.options) for key, plain in fields if plain]
    dyads = (joint for joint in scene.linkage.joints if joint.name in joints)
    sides = [(("joints", joint.name, "side"), joint.sides) for joint in dyads if joint.sides]
    for (*tables, key), options in (*shorthands, *sides):
        table = document
        for name in tables:
            table = table[name]
        now = table.get(key, options[0])
        choices.append(((*tables, key), now, options[now == options[0]]))
    return choices


# What is no number: the joints whose curves are drawn, and the crank that is driven.


def traced(scene: Scene, joint: str) -> Scene:
    """Return the scene with a joint's curve drawn, or not drawn any more; `scene` itself stays as it is."""
    joints = [name for name in scene.trace if name != joint]
    table = {"joints": joints if joint in scene.trace else [*joints, joint]}
    return with_document(scene, {**scene.document, "trace": table})


def drives(scene: Scene) -> tuple[str, ...]:
    """Return the joints by which the scene can be driven instead: pins of cranks that no gear turns."""
    linkage, shorthand = scene.linkage, scene.document.get("four-bar")
    pins = ["A", "B"] if shorthand is not None else []
    if shorthand is None and linkage.drive.coordinate.is_angle:
        pins = [crank.name for crank in linkage.cranks if crank.gear is None]
    return tuple(name for name in pins if name in linkage.by_name and name != linkage.drive.joint)


def driven_at(scene: Scene, joint: str) -> Scene:
    """Return the scene driven at one of its `drives`; errors as reading a file raises them."""
    document, shorthand = dict(scene.document), scene.document.get("four-bar")
    if shorthand is not None:
        document["four-bar"] = {**shorthand, "driver": "rocker" if joint == "B" else "crank"}
    else:
        drive = {key: value for key, value in document.get("drive", {}).items() if key != "start"}
        document["drive"] = {**drive, "joint": joint}
    return with_document(scene, document)


# Joints as handles: which dimensions follow when a joint is dragged.


@frozen
class Handle:
    """A dimension that follows a joint: the distance from `start`, or one coordinate of its place on a body.

    `part` is 0 along the body's axis `on` and 1 to its left, or 0 for x and 1 for y of a fixed pin; None for
    a distance. With `angle` the dimension is the direction of the line from `start`.
    """

    key: Key
    start: str | None = None
    on: tuple[str, str] | None = None
    part: int | None = None
    angle: bool = False

    def value(self, places: Mapping[str, Point], point: Point) -> float:
        """Return the value with the joint at `point`, the others at their places; angles in degrees."""
        if self.on:
            (x0, y0), (x1, y1) = (places[name] for name in self.on)
            length = hypot(x1 - x0, y1 - y0)
            ux, uy, x, y = (x1 - x0) / length, (y1 - y0) / length, point[0] - x0, point[1] - y0
            return -x * uy + y * ux if self.part else x * ux + y * uy
        if self.part is not None:
            return point[self.part]
        x, y = places[self.start] if self.start else (0.0, 0.0)
        return degrees(atan2(point[1] - y, point[0] - x)) if self.angle else hypot(point[0] - x, point[1] - y)


def handles(scene: Scene, joint: str) -> tuple[Handle, ...]:
    """Return the dimensions that follow a joint; none where it is found from other joints alone."""
    own = scene.linkage.joint(joint)
    dragged = [number for number in numbers(scene.document) if number.field.drag]
    return tuple(handle for number in dragged for handle in _handles(number, own, scene))


def _handles(number: Number, joint: Joint, scene: Scene) -> Iterator[Handle]:
    """Yield the handle of a number, if it follows the joint."""
    (start, end), drag = number.ends(scene), number.field.drag
    on = joint.on if isinstance(joint, Rigid) else None
    found_from = {bar[0] for bar in joint.bars} | set((on or ())[:1])
    if drag == "distance" and end == joint.name and (joint.fixed or start in found_from):
        yield Handle(number.key, start)
    elif drag == "distance" and start == joint.name and end in found_from:
        yield Handle(number.key, end)
    elif drag == "place" and end == joint.name:
        yield Handle(number.key, on=on, part=number.part)
    elif drag == "direction" and end == joint.name and _in_degrees(number.written):
        yield Handle(number.key, start, angle=True)


def _in_degrees(written: object) -> bool:
    """Tell whether an angle is written in degrees, as "30 deg" or "30°"."""
    text = str(written)
    return text.rstrip().endswith("°") or "deg" in text.lower()


# What a dimension measures: straight lines in the frames of joints with which they move.


class Stretch(NamedTuple):
    """A straight line from `begin` to `end` in the frame of two joints.

    In that frame 1 is the vector from one joint to the other, and 1j points to its left. Where the frame
    names one joint twice, 1 is one unit of the scene to the right. `key` is the dimension that the line
    shows.
    """

    frame: tuple[str, str]
    begin: complex
    end: complex
    key: Key


def stretches(scene: Scene, key: Key) -> tuple[Stretch, ...]:
    """Return the line that a dimension measures, then the others to the same place; none for an angle.

    For a place on a body these are the part along its axis and the part to its left, for a fixed pin x and y.
    """
    number = next((number for number in numbers(scene.document) if number.key == key), None)
    stretched = _of(number, scene) if number else ()
    return tuple(sorted(stretched, key=lambda stretch: stretch.key != key))


def _of(number: Number, scene: Scene) -> Iterator[Stretch]:
    joint = scene.linkage.by_name.get(
        number.ends(scene)[1] if number.field.drag else _named_stretches(number, scene)
    )
    if number.field.drag == "distance" and joint:
        start = number.ends(scene)[0]
        frame = (start or joint.name, joint.name)
        begin, end = (0, 1) if start else (-complex(*_place(scene, joint.name)), 0)
        yield Stretch(frame, begin, end, number.key)
    elif number.field.drag == "place" and joint:
        yield from _of_place(joint, scene, number.key)
    elif number.key[-2:-1] == ("com",):
        body = next(body for body in scene.linkage.bodies if body.name == number.key[1])
        if body.com and len(body.joints) > 1:
            yield from _legs(scene, (body.joints[0], body.joints[1]), complex(*body.com), number.key)
    elif number.key[-1] == "offset" and number.type.measure == "offset" and joint:
        yield from _of_offset(joint, scene, number.key)


def _named_stretches(number: Number, scene: Scene) -> str:
    """Return the joint in whose table a number stands; in a shorthand, the joint that has a line."""
    guided = (joint.name for joint in scene.linkage.joints if getattr(joint, "line", None))
    return str(number.key[1]) if number.key[0] == "joints" else next(guided, "")


def _of_place(joint: Joint, scene: Scene, key: Key) -> Iterator[Stretch]:
    if isinstance(joint, Rigid):
        yield from _legs(scene, joint.on, complex(*joint.at), key)
    elif isinstance(joint, Pin):
        x, y = joint.position
        own = joint.name, joint.name
        yield Stretch(own, complex(-x, -y), complex(0, -y), (*key[:-1], 0))
        yield Stretch(own, complex(0, -y), 0, (*key[:-1], 1))


def _legs(scene: Scene, on: tuple[str, str], at: complex, key: Key) -> Iterator[Stretch]:
    """Yield the stretch along a body's axis and the one from there to its left."""
    at /= _apart(scene, *on)
    yield Stretch(on, 0, at.real, (*key[:-1], 0))
    yield Stretch(on, at.real, at, (*key[:-1], 1))


def _of_offset(joint: Joint, scene: Scene, key: Key) -> Iterator[Stretch]:
    """Yield the stretch from a pivot to its slot, or from a line's joint to the line."""
    line: Line | None = getattr(joint, "line", None)
    if line is None:
        pivot, offset = getattr(joint, "pivot", ""), getattr(joint, "offset", 0.0)
        if pivot:
            yield Stretch((pivot, joint.name), 0, 1j * offset / _apart(scene, pivot, joint.name), key)
        return
    across = rect(line.offset, line.angle) * 1j
    if line.on is None:
        yield Stretch((line.through, line.through), 0, across, key)
        return
    first, second, through = (complex(*_place(scene, name)) for name in (*line.on, line.through))
    base = (through - first) / (second - first)
    yield Stretch(line.on, base, base + across / abs(second - first), key)


def _place(scene: Scene, joint: str) -> tuple[float, float]:
    return scene.pose(0.0, 0).position[joint]


def _apart(scene: Scene, one: str, other: str) -> float:
    return abs(complex(*_place(scene, one)) - complex(*_place(scene, other)))


# Where a hand turns the input: towards a point of the scene, or along a direction.


def _driven_along(slide: Slide, at: Mapping[str, complex]) -> complex:
    """Return the direction of the line along which a driven joint slides, of length 1."""
    turned = complex(*unit(slide.angle))
    if slide.axis is None:
        return turned
    first, second = (at[name] for name in slide.axis)
    return turned * (second - first) / abs(second - first)


def phase_towards(scene: Scene, phase: float, point: tuple[float, float]) -> float:
    """Return the phase near `phase` at which the input crank points at `point` (scene's unit).

    A slider that drives comes as near to the point as its guide allows, which may move, as it lies now; the
    end of a cylinder that stands on a moving link comes as near as it ever does.

    An input that swings stops at its limits. Of the two phases of an angle the nearer one is returned; past a
    limit, the one on the other way. A point on the pivot itself changes nothing.
    """
    mechanism, (driven, pivot, _, base) = scene.mechanism, scene.linkage.driven
    if driven.driven_between:
        return scene.point_path(driven.name).nearest(point, phase)
    at = {name: complex(*place) for name, place in scene.pose(phase, 0).position.items()}
    if slide := driven.driven_slide:
        way = (complex(*point) - at[slide.line.through]) * _driven_along(slide, at).conjugate()
        return mechanism.phase_of(way.real, phase)
    way = complex(*point) - at[pivot]
    if base is not None:
        way /= at[base] - at[pivot]
    return phase if way == 0 else mechanism.phase_of(cmath.phase(way), phase)


def phase_along(scene: Scene, phase: float, direction: complex) -> float:
    """Return the phase near `phase` at which the input crank points along `direction` (x + yi, y up).

    Limits are as in `phase_towards`. A slider that drives is put at the component of `direction`, of length 1
    at the most, along its guide: 0 is the middle of its travel, 1 its end.
    """
    mechanism, slide = scene.mechanism, scene.linkage.driven.joint.driven_slide
    if slide is None:
        return mechanism.phase_of(cmath.phase(direction), phase)
    low, high = scene.info.input_range
    at = {name: complex(*place) for name, place in scene.pose(phase, 0).position.items()}
    along = (direction * _driven_along(slide, at).conjugate()).real
    return mechanism.phase_of((low + high) / 2 + along * (high - low) / 2, phase)
