"""From a draft to a scene: the document that a scene file would hold, and why there is none yet.

A draft is written as a shorthand where one says the same in fewer lines, and else joint by joint; then it is
read like any file. Words say what is missing in the trade's terms, and what would make the draft move.
"""

from __future__ import annotations

import re
from cmath import phase
from collections.abc import Iterator, Mapping
from functools import partial
from math import degrees, dist, isclose, nan, pi
from typing import Any, NamedTuple

from linkanim import units
from linkanim.build.draft import Draft, Photo, named_in
from linkanim.build.freedom import mobility, redundant_bar
from linkanim.build.places import JointTables, ends_of, place_of, plates_of, solvable_joints
from linkanim.build.pose_form import posed_tables
from linkanim.errors import BadInput, UnitError
from linkanim.mechanics.linkage import RRP, RRR, Body, Crank, Joint, Pin, Point, Rigid
from linkanim.scenes.editing import phase_towards
from linkanim.scenes.file_form import SHORTHANDS, Expansion, names_of
from linkanim.scenes.form import Context, Field, Table
from linkanim.scenes.reading import scene_from
from linkanim.scenes.scene import Scene
from linkanim.words import said, said_many, to_say

# A photograph behind the drawing, and its table in a scene file.


def photo_table(photo: Photo) -> dict[str, Any]:
    """Return a photograph as a scene file's table."""
    turn = {"turn": f"{degrees(photo.turn):.10g} deg"} if photo.turn else {}
    return {"file": photo.file, "place": list(photo.place), "width": photo.width, **turn}


def photo_of(table: Mapping[str, Any], unit: str) -> Photo:
    """Return the photograph of a scene file's table."""
    x, y, width = (units.length(each, unit=unit) for each in (*table["place"], table["width"]))
    return Photo(table["file"], (x, y), width, float(units.angle(table.get("turn", "0 deg"))))


# A draft as a shorthand, where one says the same in fewer lines.

_NEAR = 1e-12
Document = Mapping[str, Any]


def shortened(draft: Draft, document: Document) -> Document:
    """Return a draft's document with a shorthand instead of its joints, where that gives the same linkage.

    Numbers of the shorthand that the draft came from stay as they were written as long as they are right.
    """
    names = {*document.get("ground", {}), *document.get("joints", {})}
    if draft.short is None or "O2" not in names:
        return document
    for key in SHORTHANDS:
        for table in _tables(draft, key):
            given = set(names_of(key, table))
            if given == names or (key in draft.short and given <= names):
                expansion = _expansion(draft, key, table)
                if expansion and all(_says(draft, document, joint) for joint in expansion.joints):
                    return _instead(document, key, table, expansion)
    return document


def table_of(joint: Joint) -> Any:
    """Return the table of a joint that a shorthand gives, without a side that is another joint's."""
    if isinstance(joint, Pin):
        polar = joint.polar
        if polar and not polar.base:
            return {"length": polar.length, "angle": _degrees(polar.angle)}
        return list(joint.position)
    if isinstance(joint, Crank):
        return {"crank": joint.pivot, "length": joint.length}
    if isinstance(joint, RRR):
        side = "" if joint.side_of else joint.sides[joint.side < 0]
        return {"from": list(joint.ends), "length": list(joint.lengths), "side": side}
    if isinstance(joint, RRP):
        line = {
            "through": joint.line.through,
            "angle": _degrees(joint.line.angle),
            "offset": joint.line.offset,
        }
        return {"from": joint.end, "length": joint.length, "line": line, "side": joint.sides[joint.side < 0]}
    assert isinstance(joint, Rigid)
    return {"on": list(joint.on), "at": list(joint.at)}


def _expansion(draft: Draft, key: str, table: Document) -> Expansion | None:
    """Return the meaning of a shorthand's table; None where it is refused."""
    o2 = Pin("O2", draft.places["O2"])
    top = Table("", table, (key,), Context(draft.unit, names_of(key, table)))
    expansion: Expansion | None = top.attempt(SHORTHANDS[key].made, top, o2)
    return None if top.context.problems else expansion


def _says(draft: Draft, document: Document, joint: Joint) -> bool:
    """Tell whether a document's own table of a joint says what a shorthand does."""
    if isinstance(joint, Pin):
        place = complex(*joint.position)
        return abs(place_of(draft, joint.name) - place) <= _NEAR * abs(place)
    own, given = document["joints"].get(joint.name, {}), table_of(joint)
    if isinstance(joint, RRR) and joint.side_of:
        b, p, q = (place_of(draft, name) for name in joint.side_of)
        is_left = ((b - p) * (q - p).conjugate()).imag > 0
        own = {**own, "side": ""}
        if is_left != (joint.side > 0):
            return False
    return _alike(_ordered(own), _ordered(given), draft.unit)


def _ordered(table: Document) -> Document:
    """Return a table with the ends of its two bars in order, and without a line's default values."""
    if "line" in table:
        return {**table, "line": {"angle": "0 deg", "offset": 0, **table["line"]}}
    ends = table.get("from")
    if not isinstance(ends, list) or ends == sorted(ends):
        return table
    side = table["side"] and RRR.sides[table["side"] == RRR.sides[0]]
    return {**table, "from": ends[::-1], "length": table["length"][::-1], "side": side}


def _tables(draft: Draft, key: str) -> Iterator[dict[str, Any]]:
    """Yield a shorthand's table with a draft's numbers, for each closure that it may have."""
    former = (draft.short or {}).get(key, {})
    stated: dict[str, Any] = {}
    for one in SHORTHANDS[key].fields:
        value, old = _value(draft, one), former.get(one.key)
        if value is None and one.key == "link_angle":
            value = old
        if value is not None and (value != one.usual or old is not None):
            stated[one.key] = old if old is not None and _alike(value, old, draft.unit) else value
    if draft.driven == "B":
        stated["driver"] = "rocker"
    tables = [stated]
    for one in SHORTHANDS[key].fields:
        if one.plain and one.plain.options and one.key != "driver":
            options = sorted(one.plain.options, key=lambda option: option != former.get(one.key))
            tables = [{**table, one.key: option} for table in tables for option in options]
    yield from tables


def _value(draft: Draft, one: Field) -> Any:
    """Return what a draft has for a field of a shorthand; None where it has nothing of that kind."""
    if one.drag == "distance":
        lengths = [_distance(draft, *span) for span in one.spans]
        return None if None in lengths else lengths if one.spans[1:] else lengths[0]
    start, end = one.spans[0] if one.spans else ("", "")
    if one.drag == "direction" and {start, end} <= draft.of("pins").keys():
        pin = draft.of("pins")[end]
        span = place_of(draft, end) - place_of(draft, start)
        return pin["angle"] if isinstance(pin, Mapping) else _degrees(phase(span))
    if one.drag == "place":
        return draft.of("points").get(end, {}).get("at")
    guide = draft.of("guides").get(draft.of("sliders").get("B", {}).get("guide"), {})
    return guide.get({"offset": "offset", "line_angle": "angle"}.get(one.key))


def _distance(draft: Draft, start: str, end: str) -> Any:
    """Return the stated distance of two joints, or that of a fixed pin or of a point; None without one."""
    pins, points = draft.of("pins"), draft.of("points")
    if name := draft.bar(start, end):
        return draft.of("bars")[name]["length"]
    if {start, end} <= pins.keys():
        polar = isinstance(pins[end], Mapping) and not place_of(draft, start)
        return pins[end]["length"] if polar else _tidy(abs(place_of(draft, end) - place_of(draft, start)))
    if end in points and points[end]["on"][0] == start:
        return _tidy(abs(complex(*(units.length(part, unit=draft.unit) for part in points[end]["at"]))))
    return None


def _instead(document: Document, key: str, table: Document, expansion: Expansion) -> Document:
    """Return a document with a shorthand's table instead of its joints and their plain bodies."""
    given = {joint.name for joint in expansion.joints}
    sections: dict[str, Any] = {
        section: {name: value for name, value in document.get(section, {}).items() if name not in given}
        for section in ("ground", "joints")
    }
    if document["ground"]["O2"] != [0, 0]:
        sections["ground"] = {"O2": document["ground"]["O2"], **sections["ground"]}
    members = {frozenset(_members(body)): body.name for body in expansion.bodies}
    bodies = document.get("bodies", {}).items()
    sections["bodies"] = {name: body for name, body in bodies if not _plain(name, body, members)}
    kept = {name: value for name, value in document.items() if name not in (*sections, "trace")}
    short = {**kept, key: table, **{name: tables for name, tables in sections.items() if tables}}
    trace = document.get("trace", {"joints": []})
    return short if list(expansion.trace) == trace["joints"] else {**short, "trace": trace}


def _plain(name: str, body: Mapping[str, Any], given: Mapping[frozenset[str], str]) -> bool:
    """Tell whether a body is one that the shorthand gives, without further properties."""
    members = frozenset(body.get("joints", ())) | {body.get("slider", "")} - {""}
    return len(body) == 1 and members in given and (name == given[members] or name.isdigit())


def _members(body: Body) -> tuple[str, ...]:
    return (body.slider,) if body.slider else body.joints


def _alike(one: Any, other: Any, unit: str) -> bool:
    """Tell whether two values are equal, aside from the writing and the rounding of their numbers."""
    if isinstance(one, Mapping) and isinstance(other, Mapping):
        return one.keys() == other.keys() and all(_alike(one[key], other[key], unit) for key in one)
    if isinstance(one, list) and isinstance(other, list):
        return len(one) == len(other) and all(map(_alike, one, other, [unit] * len(one)))
    numbers = [_number(each, unit) for each in (one, other)]
    return one == other or isclose(*numbers, rel_tol=_NEAR, abs_tol=_NEAR)


def _number(value: Any, unit: str) -> float:
    """Return a length or an angle as a number; NaN where it is neither."""
    for read in (partial(units.length, unit=unit), units.angle):
        try:
            return read(value)
        except UnitError:
            continue
    return nan


def _tidy(length: float) -> float | int:
    rounded = float(f"{length:.12g}")
    return int(rounded) if rounded.is_integer() else rounded


def _degrees(angle: float) -> str:
    return f"{degrees(angle):.12g} deg"


# Why a draft does not move yet, in the trade's terms, and what would make it move.

EMPTY = to_say("An empty sheet: click where the first ground pin stands")
_WORDS = {"sliders": to_say("guide"), "yokes": to_say("slot"), "gears": to_say("gear pair")}
_HOLDING = ("points", "bars", "sliders", "slots", "yokes", "gears")
"""The kinds that hold joints."""
_OWN = ("points", "sliders", "yokes", "gears")
_APART = r"(joint |joints\.)(?P<joint>[^:]+): the bars of (?P<lengths>.*) cannot meet"
_KEYS = r"^draft: (joints: |links: |points: |[a-z-]+: (?=joint )|[a-z_.-]+\.(?P<name>[^:.= ]+)[^:]*: )?"


def missing(draft: Draft, known: JointTables) -> str:
    """Return what a draft lacks before its scene can be read; `known` are its found joints. "" if nothing."""
    if not draft.of("pins"):
        return said(EMPTY)
    if not draft.of("bars") and not draft.of("sliders"):
        return said("No bar yet: drag one from a ground pin")
    if draft.driven is None and "motor" not in draft.drive:
        return said("Nothing is driven: choose a crank or a slider, and make it the drive")
    motors = 1 + len(draft.of("drives"))
    if motors > 1 and 0 < mobility(draft) < motors:
        return said("Mobility {draft}, but {motors} motors: remove one", draft=mobility(draft), motors=motors)
    return _too_many(draft, known) or _free(draft, known)


def reworded(draft: Draft, error: BadInput) -> str:
    """Return the reason why a draft's document was refused, as a sentence about the drawing."""
    text = str(error)
    if apart := re.search(_APART, text):
        joint = apart["joint"]
        names = [_body_of(draft, joint, end) for _, end, _ in draft.bars_at(joint)]
        bars = said("{one} and {other}", one=names[0], other=names[1]) if names[1:] else names[0]
        words = said("Bars {bars} ({lengths}) cannot meet", bars=bars, lengths=apart["lengths"])
        return words + text[apart.end() :]
    text = text.replace("give the points in another pose", "move a joint, or turn the crank first")
    name = (re.match(_KEYS, text) or {"name": None})["name"]
    text = f"{name or ''}: {re.sub(_KEYS, '', text)}".removeprefix(": ")
    return text[:1].upper() + text[1:]


def _too_many(draft: Draft, known: JointTables) -> str:
    """Say which things are redundant: they hold joints that are held already; "" where there are none."""
    pins, plates = draft.of("pins"), plates_of(draft)
    for name, table in known.items():
        ends = set(ends_of(table)) if "from" in table else {name}
        if ends <= pins.keys() and "on" not in table.get("line", {}):
            if len(ends) < 2:
                return said(
                    "{name} cannot move: its guide and its bar both stand on the ground; remove one",
                    name=name,
                )
            three = ", ".join(sorted((*ends, name)))
            return said(
                "{joints}: all three pins in one body, which is the ground; remove a bar", joints=three
            )
    for bar, table in draft.of("bars").items():
        one, other = table["joints"]
        both = all(end in known or end in pins for end in (one, other))
        if any({one, other} <= plate.keys() for plate in plates):
            continue
        if both and other not in ends_of(known.get(one, {})) and one not in ends_of(known.get(other, {})):
            why = said("{one} and {other} are held without it", one=one, other=other)
            if third := _third(draft, one, other):
                three = ", ".join(sorted((one, other, third)))
                why = said("{joints} are all three pins in one body", joints=three)
            return said(
                "Bar {name} ({bar}) is one too many: {cause}; remove a bar",
                name=_body_of(draft, one, other),
                bar=bar,
                cause=why,
            )
    for kind, key in (("sliders", "line"), ("yokes", "slide"), ("gears", "gear")):
        for name in draft.of(kind):
            table, settled = known.get(name, {}), _named(draft, draft.of(kind)[name]) <= {*known, *pins}
            if table and settled and key not in table and not (kind == "sliders" and "slide" in table):
                return said(
                    "The {part} of {name} is one too many: it is held without it; remove one",
                    part=said(_WORDS[kind]),
                    name=name,
                )
    for name, slot in draft.of("slots").items():
        held = {slot["through"], *draft.ends(slot["bar"])}
        if {*known, *pins} >= held and not _slides(known, slot, draft.ends(slot["bar"])):
            return said(
                "The slot of {name} is one too many: {part} is held without it; remove one",
                name=name,
                part=slot["through"],
            )
    return ""


def _slides(known: JointTables, slot: Mapping[str, Any], ends: list[str]) -> bool:
    """Tell whether a joint was found by a slot: as the joint in it, or as the slotted bar's end."""
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


def _free(draft: Draft, known: JointTables) -> str:
    """Say how many bars are missing, or too many, for the drives; "" for a chain of dyads, or what moves."""
    stuck = [name for name in draft.places if name not in known and name not in draft.of("pins")]
    if not stuck:
        return ""
    free, motors = mobility(draft), 1 + len(draft.of("drives"))
    if free > motors:
        more = said_many("one more bar", "{count} more bars", free - motors)
        motor = (to_say("a second motor"), to_say("a third motor"), to_say("another motor"))[
            min(motors, 3) - 1
        ]
        loose = (
            name for name in stuck if len(list(draft.bars_at(name))) < 2 and name not in draft.of("points")
        )
        words = said(
            "Mobility {count}: {bars}, {motor} or a gear pair", count=free, bars=more, motor=said(motor)
        )
        hanging = next(loose, "")
        return said("{words}; {joint} is loose", words=words, joint=hanging) if hanging else words
    for group in (_together(draft, stuck, name) for name in stuck):
        if mobility(draft, group | known.keys()) < 1:
            return said(
                "Mobility {free}: {part} cannot move; remove a bar", free=free, part=", ".join(sorted(group))
            )
    if bar := redundant_bar(draft):
        one, other = draft.ends(bar)
        why = said("{one} and {other} are held without it", one=one, other=other)
        return said(
            "Bar {name} ({bar}) is one too many: {cause}; remove a bar",
            name=_body_of(draft, one, other),
            bar=bar,
            cause=why,
        )
    return ""


def _together(draft: Draft, stuck: list[str], begin: str) -> set[str]:
    """Return those joints that are not found and are connected with one of them."""
    group, more = set[str](), {begin}
    while more:
        group |= more
        held = (names for names in _holds(draft) if names & group)
        more = {name for names in held for name in names if name in stuck} - group
    return group


def _holds(draft: Draft) -> Iterator[set[str]]:
    """Yield the joints that each constraint names."""
    for kind in _HOLDING:
        for name, table in draft.of(kind).items():
            yield _named(draft, table) | ({name} if kind in _OWN else set())


def _named(draft: Draft, table: Mapping[str, Any]) -> set[str]:
    """Return the joints that a table names, or its guide or bar."""
    guide = draft.of("guides").get(str(table.get("guide")), {})
    bar = draft.of("bars").get(str(table.get("bar")), {})
    return {joint for each in (table, guide, bar) for _, joint in named_in(each)} & draft.places.keys()


def _body_of(draft: Draft, one: str, other: str) -> str:
    """Return the name of the body that two joints are on; the joints' names where it has none."""
    return draft.body_of([one, other]) or "–".join(sorted((one, other)))


# From a draft to a scene: the document that a scene file would hold, read like any file.

NAME = "draft"
"""The name of a draft's scene, and of its file, unless it has another."""
_WAYS = 16
"""The phases of a turn from which the drawn pose is looked for."""
_FORCE = {"stiffness", "free_length"}


class Made(NamedTuple):
    """The result of a draft: its scene, or None, and words on what is missing for a scene.

    The scene is told `by_points` in the drawn pose where no chain of dyads has all joints.
    """

    scene: Scene | None
    missing: str
    by_points: bool = False

    @property
    def listed(self) -> Scene | None:
        """The scene whose dimensions the draft has; None where the draft's own numbers are all there are."""
        return None if self.by_points else self.scene


def is_chain(draft: Draft, joints: JointTables) -> bool:
    """Return whether a chain of dyads finds all joints."""
    return draft.places.keys() <= {*joints, *draft.of("pins")}


def document(draft: Draft, joints: JointTables) -> Mapping[str, Any]:
    """Return the document of a scene file for a draft: joint by joint where a chain of dyads has them all.

    `joints` are those that the chain finds. Else it is that of points in a pose; BadInput where none is near.
    """
    stated = {key: value for key, value in draft.rest.items() if key != "trace"}
    chained = is_chain(draft, joints)
    if chained:
        further = draft.of("drives")
        # A single crank without a gear is driven without being named.
        drive = {key: value for key, value in draft.drive.items() if key != "joint" or further}
        stated |= {"drive": drive, "drives": {name: {"joint": name, **one} for name, one in further.items()}}
        stated |= {"ground": draft.of("pins"), "joints": joints, "bodies": draft.of("bodies")}
    else:
        stated |= posed_tables(draft)
    stated["springs"] = {name: _whole(spring) for name, spring in draft.of("springs").items()}
    stated["dampers"] = draft.of("dampers")
    trace = [name for name in draft.trace if name in draft.places]
    stated |= {"trace": {"joints": trace}}
    stated |= {"photo": photo_table(draft.photo) if draft.photo else {}}
    whole = {key: value for key, value in stated.items() if value not in ({}, {"joints": []})}
    return shortened(draft, whole) if chained else whole


def made(draft: Draft, name: str = NAME) -> Made:
    """Return the scene that a draft describes, put together; or none, and what it lacks."""
    joints = solvable_joints(draft)
    if reason := missing(draft, joints):
        return Made(None, reason)
    try:
        scene = scene_from(document(draft, joints), name=name, where=name)
    except BadInput as error:
        return Made(None, reworded(draft, error))
    return Made(scene, "", by_points=not is_chain(draft, joints))


def phase_of(
    scene: Scene, places: Mapping[str, Point], *, swung: bool = False, by_points: bool = False
) -> float:
    """Return the phase at which a scene has its drawn pose.

    It is 0 for an input that turns fully, which starts as drawn, unless it `swung` before. For an input that
    goes there and back, it is on the way on which all joints are nearest to where they were drawn. Where the
    scene is told `by_points`, it is that of their pose.
    """
    if by_points:
        solved, start = scene.mechanism, scene.linkage.drive.start
        ways = (n * scene.period / (_WAYS * solved.periods) for n in range(_WAYS * solved.periods))
        candidates = dict.fromkeys(round(solved.phase_of(start, way), 12) for way in ways)
        within = (phase for phase in candidates if phase < round(scene.period, 12))  # a whole period on is 0
        return min((0.0, *within), key=partial(_off, scene, places))
    if scene.info.full_turn and not swung:
        return 0.0
    driven = places[scene.linkage.drive.joint]
    phases = (0.0,) if scene.info.full_turn else (pi / 2, 3 * pi / 2)
    return min((phase_towards(scene, start, driven) for start in phases), key=partial(_off, scene, places))


def _off(scene: Scene, places: Mapping[str, Point], phase: float) -> float:
    """Return the greatest distance of a joint from its place."""
    pose = scene.pose(phase, 0).position
    return max(dist(pose[name], place) for name, place in places.items())


def _whole(spring: Mapping[str, Any]) -> Mapping[str, Any]:
    """Return a spring without its force where only one of stiffness and free length is typed."""
    return spring if spring.keys() >= _FORCE else {key: spring[key] for key in spring.keys() - _FORCE}
