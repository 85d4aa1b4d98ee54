"""A draft as points in one pose and the links through them, and back: what no chain of dyads can say.

Bars and points that cannot move against each other are one link. A joint on a guide is a block; where two
joints of a link are on one guide, or in one slot, the link itself is the block.
"""

from __future__ import annotations

from cmath import phase, rect
from collections.abc import Iterator, Mapping
from itertools import combinations
from math import pi, remainder
from typing import Any

from linkanim import units
from linkanim.build.draft import DRIVE, Draft, joint_name, numbered
from linkanim.build.freedom import assembled
from linkanim.build.places import crank_of, line_of, place_of
from linkanim.errors import BadInput
from linkanim.mechanics.groups import GROUND, GroupLink, GroupSlide, LinkGroup, group_of
from linkanim.mechanics.linkage import Line
from linkanim.scenes.links import in_degrees, nearest
from linkanim.scenes.reading import taken_together
from linkanim.scenes.scene import Scene
from linkanim.words import said

_NEAR = 1e-9
_SAME = 1e-12
"""Numbers that differ by less, as a share of them, are one."""
_TABLES = ("points", "links", "slides", "gears", "lengths", "drive", "drives", "bodies", "springs", "dampers")

# The links of a draft.


def bodies_of(draft: Draft) -> list[list[str]]:
    """Return the joints of each rigid body but the ground, in the order in which it was drawn."""
    bodies = [list(table["joints"]) for table in draft.of("bars").values()]
    waiting = dict(draft.of("points"))
    while True:
        ready = {name: body for name, one in waiting.items() for body in bodies if {*one["on"]} <= {*body}}
        for name, body in ready.items():
            body += [name] if name not in body else []
            del waiting[name]
        first, *others = next(_rigid(bodies), [[]])
        if not others and not ready:
            return bodies
        for other in others:
            first[:] = dict.fromkeys((*first, *other))
            bodies = [body for body in bodies if body is not other]


def _rigid(bodies: list[list[str]]) -> Iterator[list[list[str]]]:
    """Yield bodies that are one: two with two joints in common, or three of which each two have one."""
    for one, other in combinations(bodies, 2):
        if len({*one} & {*other}) > 1:
            yield [one, other]
    for three in combinations(bodies, 3):
        shared = [{*one} & {*other} for one, other in combinations(three, 2)]
        if all(shared) and len(set().union(*shared)) == len(shared):
            yield [*three]


class _Links:
    """The links of a draft, with their names; `blocks` are those on which joints slide."""

    def __init__(self, draft: Draft) -> None:
        self.draft = draft
        self.named: dict[str, list[str]] = {GROUND: [*draft.of("pins")]}
        for joints in bodies_of(draft):
            own = (name for name, on in self._stated() if len({*on} & {*joints}) > 1)
            self.named[self._new(next(own, "".join(joints)))] = joints
        self.slides: dict[str, dict[str, Any]] = {}
        self.blocks: dict[str, str] = {}
        self._slide()

    def _stated(self) -> Iterator[tuple[str, list[str]]]:
        bodies = self.draft.of("bodies").items()
        yield from ((name, body["joints"]) for name, body in bodies if "joints" in body)

    def _new(self, name: str) -> str:
        return f"{name}'" if name in self.named else name

    def of(self, *joints: str) -> str:
        """Return the link that has all these joints; "" where there is none."""
        return next((name for name, on in self.named.items() if {*joints} <= {*on}), "")

    def _slide(self) -> None:
        """Have joints slide on guides and in slots; two of one link on the same line make that the block."""
        lines: dict[tuple[str, str], list[str]] = {}
        for joint, table in self.draft.of("sliders").items():
            lines.setdefault(("", str(table["guide"])), []).append(joint)
        for table in self.draft.of("slots").values():
            lines.setdefault((str(table["bar"]), str(table.get("offset", 0))), []).append(table["through"])
        for (bar, line), joints in lines.items():
            guide: Mapping[str, Any] = {"on": self.draft.ends(bar)} if bar else self.draft.of("guides")[line]
            on = self.of(*guide["on"]) if "on" in guide else GROUND
            where = {"on": on, "angle": in_degrees(phase(line_of(self.draft, guide)[1]))}
            moving = [name for name in self.named if name not in (GROUND, on)]
            pairs = [(name, [one for one in joints if one in self.named[name]]) for name in moving]
            whole = {one: name for name, held in pairs if len(held) > 1 for one in held}
            for joint in joints:
                if joint in whole:
                    self.blocks.setdefault(joint, whole[joint])
                    self.slides.setdefault(whole[joint], {"link": whole[joint], **where})
                elif bar and self.of(joint):
                    self.slides[f"{joint} in {bar}"] = {"point": joint, **where}
                else:
                    self._block(joint, where)
        for joint, yoke in self.draft.of("yokes").items():
            guide = self.draft.of("guides")[self.draft.of("sliders")[joint]["guide"]]
            way = phase(line_of(self.draft, guide)[1] * rect(1.0, units.angle(yoke["slot"])))
            table = {"point": yoke["pin"], "on": self.blocks[joint], "angle": in_degrees(way)}
            self.slides[f"{yoke['pin']} in {self.blocks[joint]}"] = table

    def _block(self, joint: str, where: Mapping[str, Any]) -> None:
        """Have a joint slide as a block of its own."""
        bodies = self.draft.of("bodies").items()
        own = next((name for name, body in bodies if body.get("slider") == joint), f"block {joint}")
        name = self._new(own)
        self.named[name], self.blocks[joint] = [joint], name
        self.slides[name] = {"link": name, **where}


# The document of a scene file with points and links.


def posed_tables(draft: Draft) -> dict[str, Any]:
    """Return the tables of a scene file with points and links; BadInput where its lengths cannot be."""
    pose = assembled(draft)
    if pose is None:
        raise BadInput(said("The bars cannot all meet: no pose near the drawing has all their lengths"))
    links = _Links(pose)
    lengths: dict[str, dict[str, Any]] = {}
    for table in pose.of("bars").values():
        first, second = table["joints"]
        lengths.setdefault(links.of(first, second), {})[f"{first}-{second}"] = table["length"]
    tables = {
        "points": {name: pose.of("pins").get(name, [*place]) for name, place in pose.places.items()},
        "links": links.named,
        "slides": links.slides,
        "gears": {name: _gear(pose, links, name, table) for name, table in pose.of("gears").items()},
        "lengths": lengths,
        "drive": _drive(pose, links),
        "drives": {name: _motor(pose, links, name) | one for name, one in pose.of("drives").items()},
        "bodies": dict(_bodies(pose, links)),
    }
    return {key: table for key, table in tables.items() if table}


def _gear(draft: Draft, links: _Links, joint: str, table: Mapping[str, Any]) -> dict[str, Any]:
    arms = [(crank_of(draft, one) or "", one) for one in (table["with"], joint)]
    return {"links": [links.of(*arm) for arm in arms], "ratio": table["ratio"]}


def _motor(draft: Draft, links: _Links, joint: str) -> dict[str, Any]:
    """Return where the motor of a crank is, and what it turns on what."""
    pivot = crank_of(draft, joint) or ""
    return {"joint": pivot, "links": [GROUND, links.of(pivot, joint)]}


def _drive(draft: Draft, links: _Links) -> dict[str, Any]:
    stated = dict(draft.drive)
    kept: dict[str, Any] = {key: stated[key] for key in ("speed", "returns") if key in stated}
    if "motor" in stated:
        pivot, arms = stated["motor"]["pivot"], stated["motor"]["between"]
        both = [links.of(pivot, arm) for arm in arms]
        if not all(both) or both[0] == both[1]:
            raise BadInput(
                said("The motor at {pivot} has no two links there: let it go on another joint", pivot=pivot)
            )
        return {"joint": pivot, "links": both, **kept}
    if "slider" in stated:
        return {"slide": links.blocks[str(draft.driven)], **_ends(draft, stated["slider"]), **kept}
    if "cylinder" in stated:
        cylinder = {key: value for key, value in stated["cylinder"].items() if key != "joint"}
        kept["cylinder"] = cylinder
        if crank_of(draft, str(draft.driven)) not in draft.of("pins"):
            return kept
    return _motor(draft, links, str(draft.driven)) | kept


def _ends(draft: Draft, slider: Mapping[str, Any]) -> dict[str, Any]:
    """Return the ends of a driving slider's travel, counted as that of a slide is: from the nearest pin."""
    joint = str(draft.driven)
    start, along = line_of(draft, draft.of("guides")[draft.of("sliders")[joint]["guide"]])
    places = {name: place_of(draft, name) for name in draft.places}
    pin = nearest(places, draft.of("pins"), places[joint], phase(along))
    more = ((start - places[pin]) * along.conjugate()).real
    ends = {key: slider[key] for key in ("from", "to")}
    if abs(more) <= _NEAR * max(map(abs, places.values())):
        return ends
    return {key: units.length(end, unit=draft.unit) + more for key, end in ends.items()}


def _bodies(draft: Draft, links: _Links) -> Iterator[tuple[str, dict[str, Any]]]:
    """Yield what is stated of bodies beyond their joints."""
    for name, body in draft.of("bodies").items():
        further = {key: value for key, value in body.items() if key not in ("joints", "slider")}
        if further and "joints" in body and ("com" in further or name not in links.named):
            further["joints"] = body["joints"]
        if further:
            yield name, further


# Back: the draft of a scene whose links are solved together.


def draft_of_group(scene: Scene) -> Draft:
    """Return the draft of a scene with a group, in its file's pose; BadInput where a sheet has no such."""
    return _Apart(scene).draft()


class _Apart:
    """A scene with a group, taken apart into what a hand would have drawn."""

    def __init__(self, scene: Scene) -> None:
        self.scene, self.document = scene, scene.document
        group = group_of(taken_together(scene).linkage)
        assert group
        self.group: LinkGroup = group
        self.base: dict[str, tuple[str, str]] = {}
        """Two points of each link, between which its bar is."""

    def draft(self) -> Draft:
        """Return the draft."""
        members, pins = self.group.members, self.group.by_name[GROUND].points
        if self.cylinder and not {*self.cylinder["between"]} & {*pins}:
            reason = said("is driven by a length between moving links, which a sheet does not draw")
            raise BadInput(f"{self.scene.name}: {reason}")
        places = {name: place for one in members for name, place in zip(one.points, one.places, strict=True)}
        order = [name for name in self.document["points"] if name in places]
        rest = {key: value for key, value in self.document.items() if key not in (*_TABLES, "photo")}
        rest |= {"title": self.scene.title, "length_unit": self.scene.length_unit}
        draft = Draft({name: places[name] for name in order}, rest=rest, short=None)
        written = self.document["points"]
        for name in pins:
            keeps = isinstance(written[name], list)
            draft = draft.having("pins", name, written[name] if keeps else [*places[name]])
        for one in members:
            draft = self._with_link(draft, one) if one.name != GROUND else draft
        drawn = [slide for slide in self.group.slides if not self.cylinder or slide.name != self.group.driven]
        for slide in sorted(drawn, key=lambda one: self.group.line(one) is None):
            draft = self._with_slide(draft, slide)
        draft = self._with_gears(draft)
        for kind in ("springs", "dampers"):
            draft = draft.having_all(kind, self.document.get(kind, {}))
        for name, body in self.document.get("bodies", {}).items():
            draft = draft.having("bodies", name, {**draft.of("bodies").get(name, {}), **body})
        return draft.having(*DRIVE, self._drive(draft))

    def _with_link(self, draft: Draft, link: GroupLink) -> Draft:
        if len(link.points) < 2:
            return draft
        pairs = [*combinations(link.points, 2)]
        fixed = self.group.by_name[GROUND].points
        stated = self.document.get("lengths", {}).get(link.name, {})
        motor = self.group.motor
        arms = {(motor.pivot, arm) for arm in motor.arms} if motor else set()
        wished = [pair for pair in pairs if {pair, pair[::-1]} & arms]
        wished += [pair for pair in pairs if f"{pair[0]}-{pair[1]}" in stated and {*pair} & {*fixed}]
        wished += [pair for pair in pairs if {*pair} & {*fixed} and not {*pair} <= {*fixed}]
        wished += [pair for pair in pairs if f"{pair[0]}-{pair[1]}" in stated]
        first, second = next(p for p in (*wished, *pairs) if abs(link.place(p[0]) - link.place(p[1])) > 0)
        self.base[link.name] = first, second
        span = link.place(second) - link.place(first)
        written = stated.get(f"{first}-{second}")
        draft = draft.with_bar(first, second, _tidy(link.length or abs(span)) if written is None else written)
        for name in link.points:
            if name not in (first, second):
                at = (link.place(name) - link.place(first)) * abs(span) / span
                table = {"on": [first, second], "at": [_tidy(at.real), _tidy(at.imag)]}
                draft = draft.having("points", name, table)
        return draft.having("bodies", link.name, {"joints": [*link.points]})

    def _with_slide(self, draft: Draft, slide: GroupSlide) -> Draft:
        line = self.group.line(slide)
        if line is None:
            return self._with_yoke(draft, slide)
        on, own = self.base.get(slide.on), self.group.by_name[slide.link]
        across = remainder(line.angle, pi)
        if slide.turns and on and abs(across) <= _NEAR and {*(line.on or ())} == {*on}:
            bar = f"{on[0]}–{on[1]}"
            back = -1.0 if (line.on != on) ^ (abs(line.angle) > 1.0) else 1.0
            aside = {"offset": _tidy(back * line.offset)} if abs(line.offset) > _NEAR * self._size else {}
            table = {"bar": bar, "through": slide.point, **aside}
            return draft.having("slots", f"{slide.point} in {bar}", table)
        if slide.point in draft.of("sliders"):
            raise BadInput(
                f"{self.scene.name}: {slide.point} slides on two lines, which a sheet does not draw"
            )
        guide = numbered(draft, "guides", "guide")
        draft = draft.having("guides", guide, _line(line)).having("sliders", slide.point, {"guide": guide})
        if slide.turns or len(own.points) == 1:
            return draft if slide.turns else draft.having("bodies", own.name, {"slider": slide.point})
        start, way = line_of(draft, draft.of("guides")[guide])
        off = {name: abs(((own.place(name) - start) * way.conjugate()).imag) for name in own.points}
        on_it = [name for name, away in off.items() if name != slide.point and away <= _NEAR * self._size]
        if on_it:
            return draft.having("sliders", on_it[0], {"guide": guide})
        # a further point of the block on its line
        first, second = self.base[own.name]
        span = own.place(second) - own.place(first)
        place, name = own.place(slide.point) + way * abs(span), joint_name(draft, point=True)
        at = (place - own.place(first)) * abs(span) / span
        point = {"on": [first, second], "at": [at.real, at.imag]}
        draft = draft.placing(name, place).having("points", name, point)
        return draft.having("sliders", name, {"guide": guide})

    def _with_yoke(self, draft: Draft, slide: GroupSlide) -> Draft:
        block = self.group.by_name[slide.on]
        if not (slide.turns and block.points and block.points[0] in draft.of("sliders")):
            raise BadInput(f"{self.scene.name}: {slide.name} slides on a block, which a sheet does not draw")
        joint = block.points[0]
        guide = draft.of("guides")[draft.of("sliders")[joint]["guide"]]
        turned = remainder(slide.angle - phase(line_of(draft, guide)[1]), pi)
        return draft.having("yokes", joint, {"pin": slide.point, "slot": in_degrees(turned)})

    def _with_gears(self, draft: Draft) -> Draft:
        for gear in self.group.gears:
            mates, own = (self._crank(name) for name in gear.links)
            ends = self.base.get(gear.links[1], ())
            if own is None and mates and mates[1] in ends:  # a geared bar on its mate's end
                own = mates[1], ends[1 - ends.index(mates[1])]
            if gear.carrier != GROUND or not (mates and own):
                raise BadInput(f"{self.scene.name}: gears between moving links are not drawn on a sheet")
            (_, mate), (_, joint) = mates, own
            if gear.motor:
                speed = self.document["drives"][gear.name]["speed"]
                draft = draft.having("drives", joint, {"speed": speed})
                continue
            turn, other = (place_of(draft, arm[1]) - place_of(draft, arm[0]) for arm in (own, mates))
            offset = remainder(phase(turn) - float(gear.ratio) * phase(other), 2 * pi)
            ratio = int(gear.ratio) if gear.ratio.denominator == 1 else str(gear.ratio)
            table = {"with": mate, "ratio": ratio, "offset": in_degrees(offset)}
            draft = draft.having("gears", joint, table)
        return draft

    def _crank(self, link: str) -> tuple[str, str] | None:
        """Return the fixed pivot of a link and the other end of its bar; None for a link without one."""
        first, second = self.base.get(link, ("", ""))
        fixed = self.group.by_name[GROUND].points
        return (first, second) if first in fixed else (second, first) if second in fixed else None

    def _drive(self, draft: Draft) -> dict[str, Any]:
        stated = self.document["drive"]
        kept = {key: stated[key] for key in ("speed", "returns") if key in stated}
        if self.cylinder:
            arm = next(name for name in self.cylinder["between"] if name not in draft.of("pins"))
            return {"cylinder": {**self.cylinder, "joint": arm}, **kept}
        if slide := self.group.driven_slide:
            ends = self.scene.linkage.drive.actuator.stated_lengths
            slider = dict(zip(("joint", "from", "to"), (slide.point, *ends), strict=True))
            return {"slider": slider, **kept}
        if self.group.motor:
            return {"motor": {"pivot": self.group.motor.pivot, "between": [*self.group.motor.arms]}, **kept}
        pivot, joint = self._crank(self.group.crank) or ("", "")
        arm = place_of(draft, joint) - place_of(draft, pivot)
        return {"joint": joint, "start": in_degrees(phase(arm)), **kept}

    @property
    def cylinder(self) -> Mapping[str, Any] | None:
        """The cylinder that drives, as the file states it; None where another thing does."""
        stated: Mapping[str, Any] | None = self.document["drive"].get("cylinder")
        return stated

    @property
    def _size(self) -> float:
        return self.scene.linkage.longest


def _line(line: Line) -> dict[str, Any]:
    table: dict[str, Any] = {"on": [*line.on]} if line.on else {}
    table |= {"through": line.through, "angle": in_degrees(line.angle)}
    return table | ({"offset": line.offset} if line.offset else {})


def _tidy(length: float) -> float | int:
    """Return a length without the rounding in its last digits, if it is such."""
    rounded = float(f"{length:.12g}")
    if abs(rounded - length) > _SAME * abs(length):
        return length
    return int(rounded) if rounded.is_integer() else rounded
