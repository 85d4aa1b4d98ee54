"""What a sheet shows: its draft or the linkage it makes, words, tools, what is under the hand."""

from __future__ import annotations

from math import atan2, degrees, hypot, isnan

from linkanim.build.dimensions import numbers_of
from linkanim.build.draft import JOINT, Draft, Thing
from linkanim.build.order import line_of
from linkanim.build.places import foot, from_span
from linkanim.build.pointing import under
from linkanim.build.rounding import snapped
from linkanim.build.shapes import Shape, as_point, drawn
from linkanim.digits import significant, typeset
from linkanim.mechanics.linkage.joint import Point
from linkanim.picture.panels.building import BuildShown, DraftShown, Rubber, Snap, ToolBar, ToolShown
from linkanim.player.state.sheet import BuildSheet, Grip, driven_bar
from linkanim.player.state.state import State
from linkanim.player.state.tools import TOOLS

_SHOWN = tuple(ToolShown(tool.icon, tool.name, tool.key) for tool in TOOLS)
_STRETCHED = ("bar", "spring", "damper", "cylinder", "slot", "gear")
"""The tools that draw from a joint."""


class Hover:
    """What the mouse is over on a sheet: a place, in its unit, how near counts as on a thing; or a tool."""

    def __init__(self, place: Point, reach: float, tool: int | None) -> None:
        self.place, self.reach, self.tool = place, reach, tool


def built(state: State, sheet: BuildSheet, hover: Hover | None = None) -> BuildShown:
    """Return what an open sheet shows, with the mouse over it or not."""
    building, seen = sheet.building, sheet.seen(state.scene, state.phase)
    shapes = drawn(seen)
    moves = building.made.scene is not None
    sentence, facts = _words(state, sheet)
    tool = next((n for n, one in enumerate(TOOLS) if one.value == sheet.tool), 0)
    return BuildShown(
        draft=None if moves else _draft(seen, shapes),
        loose=_loose(seen, shapes) if moves else None,
        sentence=sentence,
        facts=facts,
        chosen=next((one for one in shapes if one.thing == building.chosen), None),
        number=_number(sheet, moves=moves and not state.clock.paused),
        rubber=_rubber(seen, sheet, sheet.grip) if sheet.grip and not sheet.grip.is_click else None,
        snap=_snap(seen, sheet, hover),
        cursor=sheet.cursor,
        hand=sheet.grip.at if sheet.grip else None,
        photo=building.draft.photo,
        anchor=sheet.anchor,
        tools=ToolBar(_SHOWN, tool, hover.tool if hover else None),
        is_warning=bool(building.sentence),
    )


def _number(sheet: BuildSheet, *, moves: bool) -> str:
    """Return the number of what is chosen, as it stands or is typed; nothing while it runs."""
    building = sheet.building
    numbers = numbers_of(building.draft, building.chosen)
    if not numbers or sheet.grip or (moves and not building.typed):
        return ""
    one = numbers[building.row % len(numbers)]
    value = "–" if isnan(one.value) else significant(one.value, 6)
    return typeset(f"{one.label} {building.typed}_" if building.typed else f"{one.label} {value} {one.unit}")


def _words(state: State, sheet: BuildSheet) -> tuple[str, tuple[str, ...]]:
    """Return what the last gesture did, else what is missing or what the linkage is, and its facts."""
    building = sheet.building
    if building.made.scene is None:
        missing = building.made.missing
        return building.sentence or missing, (missing,) if building.sentence else ()
    info = state.scene.info
    facts = (*filter(None, [info.grashof]), f"input {info.input_words}")
    if building.sentence:
        return building.sentence, (info.class_name, *facts)
    return info.class_name[:1].upper() + info.class_name[1:], facts


def _loose(seen: Draft, shapes: tuple[Shape, ...]) -> DraftShown | None:
    """Return what the linkage that moves does not show: guides that nothing slides on, pins without a bar."""
    held = {joint for table in seen.of("bars").values() for joint in table["joints"]}
    held |= {
        end for kind in ("springs", "dampers") for one in seen.of(kind).values() for end in one["between"]
    }
    free = [one for one in shapes if one.kind == "pins" and one.label not in held]
    free += [one for one in shapes if one.kind == "guides" and len(one.places) == 2]
    return DraftShown(tuple(free)) if free else None


def _draft(seen: Draft, shapes: tuple[Shape, ...]) -> DraftShown:
    crank = driven_bar(seen)
    ends = seen.of("bars")[crank[1]]["joints"] if crank else ()
    pivot_first = sorted(ends, key=lambda joint: joint not in seen.of("pins"))
    places = tuple(seen.places[joint] for joint in pivot_first)
    traced = tuple(seen.places[joint] for joint in seen.trace if joint in seen.places)
    return DraftShown(shapes, (places[0], places[1]) if crank else None, traced)


def _rubber(seen: Draft, sheet: BuildSheet, grip: Grip) -> Rubber | None:
    """Return what the hand draws, from the joint it began at to the thing or place that it is at."""
    start = under(seen, *grip.begin, grip.reach)
    if sheet.tool in ("move", "photo") or (sheet.tool in _STRETCHED and (start is None or start[0] != JOINT)):
        return None
    begin = seen.places[start[1]] if start and start[0] == JOINT else grip.begin
    hand = as_point(snapped(complex(*grip.at), grip.snap))
    end = _met(seen, under(seen, *grip.at, grip.reach), grip.at) or hand
    across, up = end[0] - begin[0], end[1] - begin[1]
    long, angle = hypot(across, up), degrees(atan2(up, across))
    digits = f"{significant(long, 4)} {seen.unit} · {significant(angle, 3)}°"
    return Rubber(sheet.tool, begin, end, typeset(digits))


def _met(seen: Draft, thing: Thing | None, at: Point) -> Point | None:
    """Return the place of a joint, or the foot of a point on a guide; None elsewhere."""
    if thing and thing[0] == JOINT:
        return seen.places[thing[1]]
    if thing and thing[0] == "guides":
        return as_point(foot(seen, thing[1], complex(*at)))
    return None


def _snap(seen: Draft, sheet: BuildSheet, hover: Hover | None) -> Snap | None:
    """Return what the hand, or the mouse, is on."""
    grip = sheet.grip
    if grip is None and (hover is None or hover.tool is not None):
        return None
    at, reach = (grip.at, grip.reach) if grip else (hover.place, hover.reach)  # type: ignore[union-attr]
    thing = under(seen, at[0], at[1], reach)
    if thing is None or sheet.tool == "photo" or (grip and sheet.tool == "move"):
        return None
    if thing[0] == "bars":
        one, other = (seen.places[joint] for joint in seen.ends(thing[1]))
        place = complex(*at) - from_span(complex(*one), complex(*other), complex(*at))
        return Snap(as_point(place), (one, other))
    if thing[0] == "guides":
        start, way = line_of(seen, seen.of("guides")[thing[1]])
        ends = as_point(start - 1e3 * reach * way), as_point(start + 1e3 * reach * way)
        return Snap(_met(seen, thing, at) or at, ends)
    met = _met(seen, thing, at)
    return Snap(met) if met else None
