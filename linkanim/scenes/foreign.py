"""Read linkages of other programs: joints with coordinates, links as lists of joints, and what drives.

Its parts, in reading order:

- What every such file holds, and the scene's document that says it.
- Files of pyslvs, of Linkage, of LInK, and plain tables.
- Which of them a file is.

Files are data: no reader evaluates anything, and an XML file with definitions of its own is refused.
"""

from __future__ import annotations

import csv
import math
import re
from collections.abc import Callable, Mapping
from io import BytesIO
from pathlib import Path
from typing import Any

from linkanim.errors import BadInput
from linkanim.frozen import NamedTuple
from linkanim.intake import Intake
from linkanim.scenes.file_form import GROUND
from linkanim.units import shown

# What every such file holds, and the scene's document that says it.

MOST_JOINTS = 200
_FOREIGN = Intake("a linkage of another program", most_bytes=2_000_000, most_values=50_000)


class Foreign(NamedTuple):
    """A linkage as another program has it: points, links by their points, slides, and the driven joint.

    `left_out` are sentences about what the file has and a linkage has not.
    """

    points: dict[str, tuple[float, float]]
    links: dict[str, list[str]]
    slides: dict[str, dict[str, str]]
    drive: dict[str, Any]
    left_out: tuple[str, ...] = ()

    def document(self, title: str, source: str) -> dict[str, Any]:
        """Return the scene's document; lengths are in millimetres, as such files name no unit."""
        document: dict[str, Any] = {
            "title": title,
            "source": source,
            "length_unit": "mm",
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


def _checked(found: Foreign, where: str) -> Foreign:
    if not found.points or len(found.links) < 2:
        raise BadInput(f"{where}: has no joints with links between them, so it is no linkage")
    if len(found.points) > MOST_JOINTS:
        raise BadInput(f"{where}: has {len(found.points):,} joints, and {MOST_JOINTS} are the most here")
    if not found.links.get(GROUND):
        raise BadInput(f"{where}: has no joint that is fixed to the ground")
    if "joint" not in found.drive:
        raise BadInput(f"{where}: says of no joint that a motor turns there, and none on the ground is free")
    for name, points in found.links.items():
        lost = next((point for point in points if point not in found.points), None)
        if lost is not None:
            raise BadInput(f"{where}: link {name} is through {shown(lost)}, which is no joint of the file")
    return found


def _usual_drive(links: Mapping[str, list[str]]) -> dict[str, Any]:
    """Return the drive at the first fixed joint about which exactly one link turns; empty without one."""
    for point in links.get(GROUND, []):
        if sum(point in points for points in links.values()) == 2:
            return {"joint": point}
    return {}


# Files of pyslvs, of Linkage, of LInK, and plain tables.

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
    points: dict[str, tuple[float, float]] = {}
    links: dict[str, list[str]] = {GROUND: []}
    slides: dict[str, dict[str, str]] = {}
    for n, joint in enumerate(tree[1]):
        name, parts = f"P{n}", _parts_of(joint, where, n)
        if len(points) == MOST_JOINTS:
            break
        x, y = (_number(part, where, f"joint {n}") for part in parts["P"])
        points[name] = x, y
        kind, on = parts["kind"], parts["L"]
        carrier, carried = (on[0], on[1:]) if kind != "R" else ("", on)
        for link in carried:
            links.setdefault(link, []).append(name)
        if kind != "R":
            angle = f"{_number(parts['A'], where, f'the angle of joint {n}'):g} deg"
            if not carried:
                raise BadInput(f"{where}: joint {n} slides on {carrier}, but no link slides there")
            links.setdefault(carrier, [])
            of = {"point": name} if kind == "RP" else {"link": carried[0]}
            slides[f"slide {n}"] = {**of, "on": carrier, "angle": angle}
    loose = [name for name, on in links.items() if len(on) < 2 and name != GROUND and not _slid(name, slides)]
    kept = {name: on for name, on in links.items() if name not in loose}
    left = ["which joint is driven: the first one on the ground that can be"]
    left += [f"link {name}, which has one joint" for name in loose]
    used = {point for on in kept.values() for point in on}
    points = {name: place for name, place in points.items() if name in used}
    return Foreign(points, kept, slides, _usual_drive(kept), tuple(left))


def _slid(link: str, slides: Mapping[str, Mapping[str, str]]) -> bool:
    return any(link in slide.values() for slide in slides.values())


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


def _parts_of(joint: Any, where: str, n: int) -> dict[str, Any]:
    if not isinstance(joint, tuple) or joint[0] != "J" or not joint[1] or not isinstance(joint[1][0], str):
        raise BadInput(f"{where}: entry {n} is no joint J[...]")
    parts: dict[str, Any] = {part[0]: part[1] for part in joint[1] if isinstance(part, tuple)}
    kind = joint[1][0]
    plain = all(isinstance(one, str) for key in ("P", "L", "A") for one in parts.get(key, []))
    if kind not in ("R", "P", "RP") or len(parts.get("P", [])) != 2 or not parts.get("L") or not plain:
        raise BadInput(
            f"{where}: joint {n} needs its kind R, P or RP, its place P[x, y] and its links L[...]"
        )
    angle = parts.get("A", ["0"])
    return {"kind": kind, "P": parts["P"], "L": parts["L"], "A": angle[0] if angle else "0"}


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
    left: list[str] = []
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
            left.append(f"the input at {name}, the second one")
    links: dict[str, list[str]] = {GROUND: ground}
    for one in (*root.iter("Link"), *root.iter("link")):
        on = [f"P{part.get('id')}" for part in one.iter("connector")]
        if one.get("actuator") == "true":
            raise BadInput(f"{where}: link {one.get('id')} is an actuator; drive it by a slide of [points]")
        if one.get("gear") == "true":
            left.append(f"the teeth of link {one.get('id')}")
        if len(on) > 1 and not {*on} <= {*ground}:
            links[f"L{one.get('id')}"] = on
    used = {point for on in links.values() for point in on}
    kept = {name: place for name, place in points.items() if name in used}
    return Foreign(kept, links, {}, drive or _usual_drive(links), tuple(left))


def link_arrays(data: bytes, where: str) -> Foreign:
    """Read arrays of LInK: A, the bars; x0, places; node_types, 1 of a fixed node; motor, two nodes."""
    from zipfile import BadZipFile

    import numpy as np

    try:
        with np.load(BytesIO(data), allow_pickle=False) as arrays:
            found = {key: np.asarray(arrays[key]) for key in ("A", "x0", "node_types", "motor")}
    except (OSError, ValueError, KeyError, EOFError, BadZipFile) as error:
        raise BadInput(f"{where}: has no arrays A, x0, node_types and motor of LInK: {error}") from None
    joined, places, fixed, motor = (
        found["A"],
        found["x0"],
        found["node_types"].ravel(),
        found["motor"].ravel(),
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
    "scene files (.toml), expressions of pyslvs (M[J[...]]), files of Linkage (.linkage2), arrays of LInK"
    " (.npz) and plain tables (.csv)"
)
_SEEMS = {
    ".motiongen": "a file of MotionGen",
    ".zip": "an archive",
    ".dxf": "a drawing",
    ".svg": "a drawing",
    ".json": "JSON",
}


def read_foreign(path: Path, where: str) -> Foreign:
    """Return the linkage in a file of another program; BadInput, with what it seems to be, for any other."""
    suffix = path.suffix.lower()
    if suffix == ".npz":
        return _checked(link_arrays(_FOREIGN.read_bytes(path, where), where), where)
    text = _FOREIGN.read(path, where)
    begin = text.lstrip()[:400]
    reader: Callable[[str, str], Foreign] | None = None
    if re.match(r"M\s*\[", begin):
        reader = pyslvs
    elif suffix == ".linkage2" or "<linkage2" in begin:
        reader = linkage2
    elif suffix == ".csv":
        reader = tables
    if reader is None:
        seems = _SEEMS.get(suffix, "a link to PMKS+" if "pmks" in begin.lower() else "something else")
        raise BadInput(f"{where}: seems to be {seems}; what can be read are {READABLE}")
    return _checked(reader(text, where), where)
