"""Read linkages of other programs: joints with coordinates, links as lists of joints, and what drives.

Its parts, in reading order:

- What every such file holds, and the scene's document that says it.
- Lists of joints with their links: expressions of pyslvs, texts and links of PMKS.
- Links of PMKS+, files of MotionGen.
- Files of Linkage, arrays of LInK, and plain tables.
- Which of them a file is.

Files are data: no reader evaluates anything, and an XML file with definitions of its own is refused.
"""

from __future__ import annotations

import csv
import math
import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from io import BytesIO
from pathlib import Path
from typing import Any, NamedTuple

from linkanim.errors import BadInput
from linkanim.intake import Intake
from linkanim.scenes.file_form import GROUND
from linkanim.scenes.form import OF_DRIVE
from linkanim.units import LENGTH_UNITS, shown

# What every such file holds, and the scene's document that says it.

MOST_JOINTS = 200
_FOREIGN = Intake("a linkage of another program", most_bytes=2_000_000, most_values=50_000)


class Foreign(NamedTuple):
    """A linkage as another program has it: points, links by their points, slides, and the driven joint.

    `left_out` are sentences about what the file has and a linkage has not; `unit` is that of its lengths.
    """

    points: dict[str, tuple[float, float]]
    links: dict[str, list[str]]
    slides: dict[str, dict[str, str]]
    drive: dict[str, Any]
    left_out: tuple[str, ...] = ()
    unit: str = "mm"

    def document(self, title: str, source: str) -> dict[str, Any]:
        """Return the scene's document; lengths are in millimetres where a file names no unit."""
        document: dict[str, Any] = {
            "title": title,
            "source": source,
            "length_unit": self.unit,
            "points": {name: list(place) for name, place in self.points.items()},
            "links": self.links,
        }
        return document | ({"slides": self.slides} if self.slides else {}) | {"drive": self.drive}


def _number(text: str, where: str, what: str) -> float:
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise BadInput(f"{where}: {what} is {shown(text)}, which is no number")
    return value


def _checked(foreign: Foreign, where: str) -> Foreign:
    if not foreign.points or len(foreign.links) < 2:
        raise BadInput(f"{where}: has no joints with links between them, so it is no linkage")
    if len(foreign.points) > MOST_JOINTS:
        raise BadInput(f"{where}: has {len(foreign.points):,} joints, and {MOST_JOINTS} are the most here")
    if not foreign.links.get(GROUND):
        raise BadInput(f"{where}: has no joint that is fixed to the ground")
    if not {"joint", "cylinder"} & foreign.drive.keys():
        raise BadInput(f"{where}: says of no joint that a motor turns there, and none on the ground is free")
    for name, points in foreign.links.items():
        lost = next((point for point in points if point not in foreign.points), None)
        if lost is not None:
            raise BadInput(f"{where}: link {name} is through {shown(lost)}, which is no joint of the file")
    return foreign


def _usual_drive(links: Mapping[str, list[str]]) -> dict[str, Any]:
    """Return the drive at the first fixed joint about which exactly one link turns; empty without one."""
    for point in links.get(GROUND, []):
        if sum(point in points for points in links.values()) == 2:
            return {"joint": point}
    return {}


# Lists of joints with their links: expressions of pyslvs, texts and links of PMKS.


class _ListedJoint(NamedTuple):
    """A joint in a list: its kind R, P or RP, its place, the links that meet there, its line's angle (deg).

    On the first of its links is the line of a P or an RP; what slides there are the others.
    """

    kind: str
    place: tuple[float, float]
    links: tuple[str, ...]
    angle: float = 0.0


def _listed(joints: Sequence[_ListedJoint], where: str, drive: dict[str, Any], dropped: list[str]) -> Foreign:
    """Return the linkage of a list of joints, which are called P0, P1, ...; a usual drive where none is."""
    points = {f"P{n}": joint.place for n, joint in enumerate(joints[: MOST_JOINTS + 1])}
    links: dict[str, list[str]] = {GROUND: []}
    slides: dict[str, dict[str, str]] = {}
    for n, (name, joint) in enumerate(zip(points, joints, strict=False)):
        carrier, carried = (joint.links[0], joint.links[1:]) if joint.kind != "R" else ("", joint.links)
        for link in carried:
            links.setdefault(link, []).append(name)
        if carrier:
            if not carried:
                raise BadInput(f"{where}: joint {n} slides on {carrier}, but no link slides there")
            links.setdefault(carrier, [])
            of = {"point": name} if joint.kind == "RP" else {"link": carried[0], "through": name}
            slides[f"slide {n}"] = {**of, "on": carrier, "angle": f"{joint.angle:.15g} deg"}
    loose = [name for name, on in links.items() if len(on) < 2 and name != GROUND and not _slid(name, slides)]
    kept = {name: on for name, on in links.items() if name not in loose}
    dropped = [*dropped, *(f"link {name}, which has one joint" for name in loose)]
    used = {point for on in kept.values() for point in on}
    if not drive:
        drive = _usual_drive(kept)
        dropped.insert(0, "which joint is driven: the first one on the ground that can be")
    kept_points = {name: place for name, place in points.items() if name in used}
    return Foreign(kept_points, kept, slides, drive, tuple(dropped))


def _slid(link: str, slides: Mapping[str, Mapping[str, str]]) -> bool:
    return any(link in slide.values() for slide in slides.values())


_TOKEN = re.compile(r"\s*([A-Za-z_]\w*|[-+.\d][-+.\deE]*|[\[\],])")
_DEEPEST = 4


def pyslvs(text: str, where: str) -> Foreign:
    """Read an expression M[J[R, color[Green], P[0, 0], L[ground, link_1]], ...]."""
    tokens = _TOKEN.findall(text)
    if "".join(tokens) != "".join(text.split()):
        raise BadInput(f"{where}: is no expression of pyslvs, M[J[R, P[0, 0], L[ground, link_1]], ...]")
    tree, rest = _bracketed(tokens, where, 0)
    if rest or tree[0] != "M":
        raise BadInput(f"{where}: is no expression of pyslvs: it ends before its text does")
    return _listed([_joint_of(joint, where, n) for n, joint in enumerate(tree[1])], where, {}, [])


def _bracketed(tokens: list[str], where: str, depth: int) -> tuple[Any, list[str]]:
    """Return a name with the list in its brackets, or a word alone, and the tokens behind it."""
    if not tokens or depth > _DEEPEST or tokens[0] in "[],":
        raise BadInput(f"{where}: is no expression of pyslvs: brackets do not match")
    name, rest = tokens[0], tokens[1:]
    if not rest or rest[0] != "[":
        return name, rest
    inner, rest = list[Any](), rest[1:]
    while rest and rest[0] != "]":
        one, rest = _bracketed(rest, where, depth + 1)
        inner.append(one)
        if rest and rest[0] == ",":
            rest = rest[1:]
    if not rest:
        raise BadInput(f"{where}: is no expression of pyslvs: a bracket is not closed")
    return (name, inner), rest[1:]


def _joint_of(joint: Any, where: str, n: int) -> _ListedJoint:
    if not isinstance(joint, tuple) or joint[0] != "J" or not joint[1] or not isinstance(joint[1][0], str):
        raise BadInput(f"{where}: entry {n} is no joint J[...]")
    parts: dict[str, Any] = {part[0]: part[1] for part in joint[1] if isinstance(part, tuple)}
    kind = joint[1][0]
    plain = all(isinstance(one, str) for key in ("P", "L", "A") for one in parts.get(key, []))
    if kind not in ("R", "P", "RP") or len(parts.get("P", [])) != 2 or not parts.get("L") or not plain:
        raise BadInput(
            f"{where}: joint {n} needs its kind R, P or RP, its place P[x, y] and its links L[...]"
        )
    x, y = (_number(part, where, f"joint {n}") for part in parts["P"])
    angle = _number((parts.get("A") or ["0"])[0], where, f"the angle of joint {n}")
    return _ListedJoint(kind, (x, y), tuple(parts["L"]), angle)


_PMKS_GROUND = ("0", "1", "gnd", "grnd", "grond", "gound", "groud", GROUND)


def pmks(text: str, where: str) -> Foreign:
    """Read a text or a link of PMKS: of each joint its links, R, P or RP, x, y, angle, four marks t or f.

    The fourth mark is that of the joint that drives; `set=s10` before them is its speed in rpm.
    """
    rows = [row for row in re.split(r"[|\n]", text.rpartition("mech=")[2].partition("&")[0]) if row.strip()]
    joints, driven = list[_ListedJoint](), list[int]()
    for n, row in enumerate(rows[: MOST_JOINTS + 1]):
        joint, drives = _pmks_joint(re.split(r"[\s,]+", row.strip()), where, n)
        joints.append(joint)
        driven += [n] * drives
    if driven and joints[driven[0]].kind != "R":
        raise BadInput(
            f"{where}: joint {driven[0]} drives by sliding, and says not from where to where; give it a pin "
            "that turns, or write the scene with [drive] slide, from and to"
        )
    dropped = [f"the input at joint {n}, a further one" for n in driven[1:]]
    speed = re.search(r"set=[^&\n]*?\bs(-?[\d.]+)", text)
    drive = _motor(f"P{driven[0]}", joints[driven[0]].links) if driven else {}
    if speed and driven and (turning := _number(speed[1], where, "the speed")):
        drive["speed"] = f"{turning:g} rpm"
    return _listed(joints, where, drive, dropped)


def _pmks_joint(cells: list[str], where: str, n: int) -> tuple[_ListedJoint, bool]:
    """Return a joint of PMKS, and whether it drives."""
    kinds = (i for i, cell in enumerate(cells[1:-2], 1) if cell.upper() in ("R", "P", "RP", "G"))
    at = next((i for i in kinds if all(map(_is_number, cells[i + 1 : i + 3]))), None)
    if at is None:
        raise BadInput(f"{where}: joint {n} is no row of PMKS, such as ground,input,R,0,0")
    kind, rest = cells[at].upper(), cells[at + 3 :]
    if kind == "G":
        raise BadInput(f"{where}: joint {n} is a gear (G), whose pitch circles are not read; add [gears]")
    x, y = (_number(cell, where, f"joint {n}") for cell in cells[at + 1 : at + 3])
    angle = _number(rest.pop(0), where, f"the angle of joint {n}") if rest and _is_number(rest[0]) else None
    if kind != "R" and angle is None:
        raise BadInput(f"{where}: joint {n} slides, and its row needs an angle behind x and y")
    names = (cell.lower() for cell in cells[:at] if cell)
    links = tuple(dict.fromkeys(GROUND if name in _PMKS_GROUND else name for name in names))
    drives = bool(rest) and len(rest[0]) == 4 and rest[0].lower()[3] == "t"
    return _ListedJoint(kind, (x, y), links, angle or 0.0), drives


def _unquoted(text: str) -> str:
    """Return the text of a link, with its percent signs read."""

    def letters(match: re.Match[str]) -> str:
        return bytes.fromhex(match[0].replace("%", "")).decode("utf-8", "replace")

    return re.sub(r"(?:%[0-9a-fA-F]{2})+", letters, text)


def _is_number(text: str) -> bool:
    try:
        return math.isfinite(float(text))
    except ValueError:
        return False


def _motor(joint: str, links: Sequence[str]) -> dict[str, Any]:
    """Return the drive at a joint in which these links meet; on the ground, if it is one of them."""
    ordered = sorted(links, key=lambda name: name != GROUND)
    return {"joint": joint} | ({"links": ordered[:2]} if len(links) > 2 else {})


# Links of PMKS+, files of MotionGen.
#
# The form of a link of PMKS+ stands in its source (PMKS-Web, transcoding): settings, joints, links and forces
# between full stops, numbers as whole thousandths to the base 64 with a 0 before negative ones, a character
# for the length, and in later versions a digest (FNV-1a, 32 bits) behind a star.

_BASE_62 = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz"
_BASE_64 = f"{_BASE_62}_-"
_PLUS_PAYLOAD = r"[0-9A-Za-z_-]{1,2}\.[^.?&\s]*\.[^.?&\s]*,[^.?&\s]*\.[0-9]{3,4}\."
_PLUS_ROOTS = "YAMG0123"
"""Marks of links that move as one; the others are parts of those."""
_PRISMATIC, _INPUT, _GROUNDED, _WELDED = 1, 2, 4, 8
_SAFE_NAME = r"[\w' -]{1,32}"


class _PlusJoint(NamedTuple):
    """A joint of PMKS+; `marks` are its flags as bits, `line` the link with its slot and two points there."""

    name: str
    place: tuple[float, float]
    marks: int
    angle: float
    line: tuple[str, ...]
    speed: float


class _PlusReader:
    """What a link of PMKS+ holds, as far as it makes a linkage."""

    def __init__(self, payload: str, where: str) -> None:
        self.where = where
        body, star, digest = payload.partition("*")
        whole = len(body) > 1 and body[-1] == _BASE_62[(len(body) - 1) % 62]
        if not whole or (star and digest != _fnv_1a(body)):
            raise BadInput(f"{where}: is a link to PMKS+ of which a part is missing or changed; copy it anew")
        parts = body[:-1].split(".")
        self.settings, self.rest = parts[:4], parts[4:]
        records = [[row.split(",") for row in self._section()] for _ in range(3)]
        self.joints = {cells[0][1:]: self._joint(cells) for cells in records[0] if cells[0]}
        whole_links = [cells for cells in records[1] if len(cells) > 7 and len(cells[0]) > 2]
        self.owner: dict[str, str] = {}
        self.links: dict[str, list[str]] = {}
        self.blocks: list[list[str]] = []
        self._read_links(whole_links)
        self.forces = len(records[2])

    def _section(self) -> list[str]:
        end = self.rest.index("") if "" in self.rest else len(self.rest)
        section, self.rest = self.rest[:end], self.rest[end + 1 :]
        return section

    def _whole(self, text: str, what: str) -> int:
        if not re.fullmatch(r"[0-9A-Za-z_-]{1,10}", text):
            raise BadInput(f"{self.where}: {what} is {shown(text)}, which is no number of PMKS+")
        digits = text[1:] if text[0] == "0" else text
        value = 0
        for digit in digits:
            value = value * 64 + _BASE_64.index(digit)
        return -value if text[0] == "0" else value

    def _joint(self, cells: list[str]) -> _PlusJoint:
        cells = [*cells, *[""] * 9]
        marks, name = _BASE_64.find(cells[0][0]), cells[0][1:]
        if marks < 0 or not name:
            raise BadInput(f"{self.where}: {shown(cells[0])} is no joint of PMKS+")
        x, y, turned = (self._whole(cell, f"joint {name}") for cell in cells[2:5])
        speed = self._whole(cells[8], f"the speed of joint {name}") / 1000 if cells[8] else 0.0
        return _PlusJoint(cells[1], (x / 1000, y / 1000), marks, turned / 1000, tuple(cells[5:8]), speed)

    def _read_links(self, rows: list[list[str]]) -> None:
        for cells in rows:
            of = cells[7:]
            end = of.index("") if "" in of else len(of)
            joints, name = of[:end], cells[0][2:]
            lost = next((joint for joint in joints if joint not in self.joints), None)
            if lost is not None:
                raise BadInput(f"{self.where}: link {name} is through {shown(lost)}, which is no joint of it")
            if cells[0][1] == "P":
                self.blocks.append(joints)
            elif cells[0][0] in _PLUS_ROOTS:
                self.links[name] = joints
                self.owner |= dict.fromkeys((name, *of[end + 1 :]), name)

    def is_a(self, joint: str, mark: int) -> bool:
        return bool(self.joints[joint].marks & mark)

    def fixed(self) -> list[str]:
        """Take the links that stand still out of the others, and return the joints that do.

        A link stands still that is welded to a fixed joint, or that has two.
        """
        still = [
            name for name, joint in self.joints.items() if joint.marks & (_GROUNDED | _PRISMATIC) == _GROUNDED
        ]
        welded = {name for name in still if self.is_a(name, _WELDED)}
        while True:
            held = [of for of, on in self.links.items() if len({*on} & {*still}) > 1 or {*on} & welded]
            if not held:
                return still
            still = [*dict.fromkeys((*still, *(joint for of in held for joint in self.links.pop(of))))]

    def pins(self) -> dict[str, str]:
        """Return, for each joint that slides, the pin of its block, else itself."""
        pins = {name: name for name in self.joints if self.is_a(name, _PRISMATIC)}
        for block in self.blocks:
            sliding = [name for name in block if name in pins]
            others = [name for name in block if name not in pins]
            if len(sliding) != 1 or len(others) != 1:
                raise BadInput(f"{self.where}: a block through {', '.join(block)} is no slider of PMKS+")
            pins[sliding[0]] = others[0]
        return pins

    def linkage(self) -> Foreign:
        """Return the linkage."""
        still, pins = self.fixed(), self.pins()
        links = {GROUND: still, **self.links}
        doubles = {name for name, pin in pins.items() if name != pin}
        links = {name: [joint for joint in on if joint not in doubles] for name, on in links.items()}
        names = _names(self.joints, {name: joint.name for name, joint in self.joints.items()}, "P")
        used = {joint for on in links.values() for joint in on}
        slides = {f"slide {names[pin]}": self._slide(name, pin, links, names) for name, pin in pins.items()}
        drive, dropped = self._drive(links, names)
        if self.forces:
            dropped.append("forces")
        link_names = {GROUND: GROUND} | _names([name for name in links if name != GROUND], {}, "L")
        for slide in slides.values():
            slide |= {key: link_names[slide[key]] for key in ("on", "link") if key in slide}
        if "links" in drive:
            drive["links"] = [link_names[name] for name in drive["links"]]
        unit = {"0": "in", "2": "m"}.get(self.settings[3][:1], "cm")
        return Foreign(
            {names[joint]: self.joints[joint].place for joint in self.joints if joint in used},
            {link_names[link]: [names[joint] for joint in on] for link, on in links.items()},
            slides,
            drive,
            ("masses and colours", *dropped),
            unit,
        )

    def _slide(
        self, name: str, pin: str, links: Mapping[str, list[str]], names: Mapping[str, str]
    ) -> dict[str, str]:
        joint = self.joints[name]
        if joint.marks & _GROUNDED or not joint.line[0]:
            on, turned = GROUND, _degrees(joint.angle)
        else:
            carrier, *ends = joint.line
            if not {*ends} <= {*self.joints} or carrier not in self.owner:
                raise BadInput(f"{self.where}: joint {name} slides on {shown(carrier)}, which is no link")
            (x, y), (u, v) = (self.joints[end].place for end in ends)
            on = self.owner[carrier] if self.owner[carrier] in links else GROUND
            turned = math.degrees(math.atan2(v - y, u - x))
        angle = f"{turned:.15g} deg"
        if not (self.is_a(pin, _WELDED) or joint.marks & _WELDED):
            return {"point": names[pin], "on": on, "angle": angle}
        riders = [link for link, of in links.items() if pin in of and link != on]
        if len(riders) != 1:
            raise BadInput(f"{self.where}: {len(riders)} links slide at joint {name}, and are welded there")
        return {"link": riders[0], "through": names[pin], "on": on, "angle": angle}

    def _drive(
        self, links: Mapping[str, list[str]], names: Mapping[str, str]
    ) -> tuple[dict[str, Any], list[str]]:
        driven = [name for name in self.joints if self.is_a(name, _INPUT)]
        if not driven:
            return {}, []
        name, *further = driven
        if self.is_a(name, _PRISMATIC):
            raise BadInput(
                f"{self.where}: joint {name} drives by sliding, and says not from where to where; write the "
                "scene with [drive] slide, from and to, or a cylinder"
            )
        drive = _motor(names[name], [link for link, on in links.items() if name in on])
        turns = -1 if _BASE_64.index(self.settings[0][-1]) & 1 else 1  # the first setting: clockwise
        usual = turns * self._whole(self.settings[2].partition(",")[0], "the speed")
        if speed := self.joints[name].speed or usual:
            drive["speed"] = f"{speed:g} rpm"
        return drive, [f"the input at joint {names[one]}, a further one" for one in further]


def _fnv_1a(text: str) -> str:
    value = 0x811C9DC5
    for letter in text:
        value = (value ^ ord(letter)) * 0x01000193 % 2**32
    digits = ""
    for _ in range(6):
        value, last = divmod(value, 62)
        digits = _BASE_62[last] + digits
    return digits


def _degrees(turned: float) -> float:
    """Return an angle that is known to a thousandth of a radian, in degrees: whole ones if it can be."""
    whole = round(math.degrees(turned))
    return whole if abs(math.radians(whole) - turned) < 0.00051 else math.degrees(turned)


def _names(ids: Iterable[str], titles: Mapping[str, str], letter: str) -> dict[str, str]:
    """Return a name for each: its title if no other has it, else what the file calls it, if that is one."""
    names: dict[str, str] = {}
    for n, one in enumerate(ids):
        taken = {GROUND, OF_DRIVE, *names.values()}
        wished = (name for name in (titles.get(one, ""), one) if name.strip() and name not in taken)
        names[one] = next((name for name in wished if re.fullmatch(_SAFE_NAME, name)), f"{letter}{n}'")
    return names


def pmks_plus(text: str, where: str) -> Foreign:
    """Read a link to a linkage in PMKS+, or what stands in one behind the question mark."""
    payload = _unquoted(text.strip()).rpartition("?")[2]
    if not re.match(_PLUS_PAYLOAD, payload):
        raise BadInput(f"{where}: is a link to PMKS+ without a linkage; Share there gives one that has it")
    return _PlusReader(payload, where).linkage()


def motiongen(text: str, where: str) -> Foreign:
    """Read a file of MotionGen: JSON with joints, links through them, the ground, and a rotary actuator."""
    otherwise = "is no file of MotionGen: it has no mechanism with joints and links"
    document = _FOREIGN.parsed(text, where, otherwise)
    whole = document if isinstance(document, dict) else {}
    mechanism, settings = (whole.get(key) for key in ("mechanism", "settings"))
    has = mechanism if isinstance(mechanism, dict) else {}
    joints, links, motors = (_objects(has.get(key)) for key in ("joints", "links", "actuators"))
    if not joints or not links:
        raise BadInput(f"{where}: {otherwise}")
    for key, what in (("slots", "slots"), ("cylinders", "cylinders")):
        if has.get(key):
            raise BadInput(f"{where}: has {what}, whose form is not published; give them as [slides]")
    unit = settings.get("linearUnit", "mm") if isinstance(settings, dict) else "mm"
    if unit not in LENGTH_UNITS:
        known = ", ".join(LENGTH_UNITS)
        raise BadInput(f"{where}: measures in {shown(unit)}; set {known} in MotionGen and save it again")
    welded = next((one for one in joints if one.get("isWelded")), None)
    if welded is not None:
        raise BadInput(f"{where}: welds links at a joint; make them one link in MotionGen and save it again")
    ids = [str(one.get("id")) for one in joints[: MOST_JOINTS + 1]]
    names = {one: _letter(n) for n, one in enumerate(ids)}
    places = [
        tuple(_number(str(joint.get(key)), where, f"{key} of joint {name}") for key in "xy")
        for joint, name in zip(joints, names.values(), strict=False)
    ]
    named: dict[str, list[str]] = {GROUND: []}
    for n, link in enumerate(links, 1):
        on = link.get("jointIds")
        through = [names.get(str(one), str(one)) for one in on] if isinstance(on, list) else []
        if link.get("isGround"):
            named[GROUND] += through
        elif len(through) > 1:
            named[f"L{n}"] = through
    drive, dropped = _rotary(motors, names, named, where)
    points = {name: (x, y) for name, (x, y) in zip(names.values(), places, strict=True)}
    used = {point for on in named.values() for point in on}
    kept = {name: place for name, place in points.items() if name in used}
    return Foreign(kept, named, {}, drive or _usual_drive(named), tuple(dropped), unit)


def _objects(objects: Any) -> list[dict[str, Any]]:
    return [one for one in objects if isinstance(one, dict)] if isinstance(objects, list) else []


def _letter(n: int) -> str:
    """Return A, B, ... Z, A1, B1, ..."""
    return f"{chr(65 + n % 26)}{n // 26 or ''}"


def _rotary(
    motors: list[dict[str, Any]], names: Mapping[str, str], links: Mapping[str, list[str]], where: str
) -> tuple[dict[str, Any], list[str]]:
    """Return the drive of the first actuator, which turns the link of at and to on that of at and from."""
    if not motors:
        return {}, []
    first, *further = motors
    if first.get("type") != "rotary":
        raise BadInput(f"{where}: has a {shown(first.get('type'))} actuator; only a rotary one is read")
    at, base, to = (names.get(str(first.get(key)), "") for key in ("at", "from", "to"))
    ends = [next((name for name, on in links.items() if {at, end} <= {*on}), "") for end in (base, to)]
    if "" in (at, *ends) or ends[0] == ends[1]:
        raise BadInput(f"{where}: its actuator names no joint with a link to either side")
    dropped = ["the motor's speed, whose unit is not published", *["a further actuator"] * len(further)]
    return {"joint": at, "links": ends}, dropped


# Files of Linkage, arrays of LInK, and plain tables.


def linkage2(text: str, where: str) -> Foreign:
    """Read a file of Linkage: connectors with coordinates, links through them, anchors and inputs."""
    from xml.etree import ElementTree

    if "<!" in text.replace("<!--", ""):
        raise BadInput(f"{where}: defines things of its own, as no file of Linkage does; save it anew")
    try:
        root = ElementTree.fromstring(text)
    except ElementTree.ParseError as error:
        raise BadInput(f"{where}: is no file of Linkage: {error}") from None
    points: dict[str, tuple[float, float]] = {}
    ground: list[str] = []
    drive: dict[str, Any] = {}
    dropped: list[str] = []
    for one in root.iter("connector"):
        if one.get("x") is None:
            continue  # a link's mention of one
        if one.get("slider") == "true":
            raise BadInput(
                f"{where}: connector {one.get('id')} slides; give it as a slide of [points] instead"
            )
        name = f"P{one.get('id')}"
        x, y = (_number(one.get(key) or "", where, f"connector {one.get('id')}") for key in "xy")
        points[name] = x, y
        if one.get("anchor") == "true":
            ground.append(name)
        if one.get("input") == "true" and not drive:
            speed = _number(one.get("rpm") or "15", where, f"the speed of connector {one.get('id')}")
            drive = {"joint": name, "speed": f"{-speed:g} rpm"}
        elif one.get("input") == "true":
            dropped.append(f"the input at {name}, the second one")
    links: dict[str, list[str]] = {GROUND: ground}
    for one in (*root.iter("Link"), *root.iter("link")):
        on = [f"P{part.get('id')}" for part in one.iter("connector")]
        if one.get("actuator") == "true":
            if drive or len(on) != 2 or not {*on} <= points.keys():
                reason = "is an actuator beside another input, or not between two connectors"
                raise BadInput(f"{where}: link {one.get('id')} {reason}; leave one of them out")
            drive = _actuated(one.attrib, (on[0], on[1]), points, where)
            continue
        if one.get("gear") == "true":
            dropped.append(f"the teeth of link {one.get('id')}")
        if len(on) > 1 and not {*on} <= {*ground}:
            links[f"L{one.get('id')}"] = on
    used = {point for on in links.values() for point in on}
    kept = {name: place for name, place in points.items() if name in used}
    return Foreign(kept, links, {}, drive or _usual_drive(links), tuple(dropped))


def _actuated(
    actuator: Mapping[str, str], ends: tuple[str, str], points: Mapping[str, tuple[float, float]], where: str
) -> dict[str, Any]:
    """Return the drive of an actuator of Linkage, which grows from the length in the drawing by its throw."""
    what = f"of link {actuator.get('id')}"
    throw = _number(actuator.get("throw") or "", where, f"the throw {what}")
    speed = _number(actuator.get("cpm") or "15", where, f"the speed {what}")
    length = math.dist(*(points[end] for end in ends))
    return {
        "cylinder": {"between": [*ends], "from": length, "to": length + throw},
        "speed": f"{abs(speed):g} rpm",
    }


def link_arrays(data: bytes, where: str) -> Foreign:
    """Read arrays of LInK: A, the bars; x0, places; node_types, 1 of a fixed node; motor, two nodes."""
    from zipfile import BadZipFile

    import numpy as np

    try:
        with np.load(BytesIO(data), allow_pickle=False) as arrays:
            read = {key: np.asarray(arrays[key]) for key in ("A", "x0", "node_types", "motor")}
    except (OSError, ValueError, KeyError, EOFError, BadZipFile) as error:
        raise BadInput(f"{where}: has no arrays A, x0, node_types and motor of LInK: {error}") from None
    joined, places, fixed, motor = (
        read["A"],
        read["x0"],
        read["node_types"].ravel(),
        read["motor"].ravel(),
    )
    count = len(places)
    shapes = joined.shape == (count, count) and places.shape == (count, 2) and len(fixed) == count
    if not shapes or len(motor) != 2 or count > MOST_JOINTS or not np.issubdtype(places.dtype, np.number):
        raise BadInput(f"{where}: arrays A, x0, node_types and motor do not fit each other")
    if not np.isfinite(places).all() or not all(0 <= int(one) < count for one in motor):
        raise BadInput(f"{where}: x0 has places that are no numbers, or motor names no nodes")
    points = {f"P{n}": (float(x), float(y)) for n, (x, y) in enumerate(places)}
    ground = [f"P{n}" for n in range(count) if fixed[n]]
    links = {GROUND: ground}
    for i in range(count):
        for j in range(i):
            if joined[i, j] and not (fixed[i] and fixed[j]):
                links[f"P{j}-P{i}"] = [f"P{j}", f"P{i}"]
    first, second = (f"P{int(one)}" for one in motor)
    pivot, pin = (first, second) if first in ground else (second, first)
    crank = next((name for name, on in links.items() if {*on} == {pivot, pin} and name != GROUND), None)
    if crank is None or pivot not in ground:
        raise BadInput(f"{where}: motor names {first} and {second}, which are no crank on a fixed node")
    used = {point for on in links.values() for point in on}
    kept = {name: place for name, place in points.items() if name in used}
    return Foreign(kept, links, {}, {"joint": pivot, "links": [GROUND, crank]})


def tables(text: str, where: str) -> Foreign:
    """Read plain tables: a row name, x, y for each joint; then a row `link`, and link, joint, joint, ..."""
    points: dict[str, tuple[float, float]] = {}
    links: dict[str, list[str]] = {}
    drive: dict[str, Any] = {}
    in_links = False
    for n, row in enumerate(csv.reader(text.splitlines()), start=1):
        cells = [cell.strip() for cell in row if cell.strip()]
        if not cells or cells[0].startswith("#"):
            continue
        head = cells[0].lower()
        if head in ("link", "links"):
            in_links = True
        elif head in ("name", "joint", "point") and not points:
            continue
        elif head in ("drive", "motor") and len(cells) > 1:
            drive = {"joint": cells[1]} | ({"links": cells[2:4]} if len(cells) > 3 else {})
        elif in_links:
            links[cells[0]] = cells[1:]
        elif len(cells) == 3:
            points[cells[0]] = (
                _number(cells[1], where, f"x in row {n}"),
                _number(cells[2], where, f"y in row {n}"),
            )
        else:
            raise BadInput(
                f"{where}: row {n} has {len(cells)} cells; write name, x, y, then a row link, and links"
            )
    return Foreign(points, links, {}, drive or _usual_drive(links))


# Which of them a file is.

READABLE = (
    "scene files (.toml), expressions of pyslvs (M[J[...]]), texts and links of PMKS and PMKS+, files of"
    " MotionGen (.motiongen) and of Linkage (.linkage2), arrays of LInK (.npz) and plain tables (.csv)"
)
_SEEMS = {".zip": "an archive", ".dxf": "a drawing", ".svg": "a drawing", ".json": "JSON"}
_PMKS_ROW = r"[^\n|]*?[\w,] *[ ,]\s*(R|P|RP|G)\s*[ ,]\s*[-+.\d]"


def read_foreign(path: Path, where: str) -> Foreign:
    """Return the linkage in a file of another program; BadInput, with what it seems to be, for any other."""
    suffix = path.suffix.lower()
    if suffix == ".npz":
        return _checked(link_arrays(_FOREIGN.read_bytes(path, where), where), where)
    return read_text(_FOREIGN.read(path, where), where, suffix)


def is_link(name: str) -> bool:
    """Return whether a name is no file's but a link into the web, which is read as it stands."""
    return name.startswith(("http://", "https://"))


def read_text(text: str, where: str, suffix: str = "") -> Foreign:
    """Return the linkage in the text of a file with this suffix, or in a link; nothing is fetched."""
    begin = text.lstrip()[:400]
    reader: Callable[[str, str], Foreign] | None = None
    if re.match(r"M\s*\[", begin):
        reader = pyslvs
    elif suffix == ".linkage2" or "<linkage2" in begin:
        reader = linkage2
    elif suffix == ".motiongen" or (begin.startswith("{") and '"mechanism"' in text):
        reader = motiongen
    elif suffix == ".csv":
        reader = tables
    elif "pmksplus" in begin.lower() or re.match(_PLUS_PAYLOAD, begin):
        reader = pmks_plus
    elif "mech=" in begin or re.match(_PMKS_ROW, begin, re.IGNORECASE):
        reader, text = pmks, _unquoted(text)
    if reader is None:
        seems = _SEEMS.get(suffix, "a link into the web" if is_link(begin) else "something else")
        raise BadInput(f"{where}: seems to be {seems}; what can be read are {READABLE}")
    return _checked(reader(text, where), where)
