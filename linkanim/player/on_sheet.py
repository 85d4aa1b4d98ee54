"""Draw a sheet: its draft or what the linkage lacks, words, numbers, and what the hand does there."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from functools import cached_property
from math import atan2, degrees, dist, hypot, isnan
from typing import TYPE_CHECKING, Literal

from linkanim.build.building import Building
from linkanim.build.dimensions import PropertyRow, rows_of
from linkanim.build.draft import JOINT, Draft, Thing
from linkanim.build.gestures import under
from linkanim.build.places import Shape, as_point, drawn, foot, from_span, line_of, snapped
from linkanim.frozen import frozen
from linkanim.mechanics.linkage import Point
from linkanim.picture.drawn import Addition, Over
from linkanim.picture.text import subscripted_words
from linkanim.player.state import (
    BuildSheet,
    driven_bar,
)
from linkanim.scenes.scene import Scene
from linkanim.units import short, significant, typeset
from linkanim.words import said

if TYPE_CHECKING:
    from linkanim.mechanics.motion import Pose
    from linkanim.picture.build_sheet import DraftDrawing, Rubber, Snap
    from linkanim.picture.figure import DrawSetting
    from linkanim.picture.items import Group
    from linkanim.picture.sheet_rows import SheetRows

_WORDS = ("pin", "point", "slider", "yoke", "gear")
"""Shapes whose name says more than "joint"."""


def called(draft: Draft, thing: Thing) -> str:
    """Return the words for a thing of a sheet: "pin O2", "bar A–B", "input"."""
    kind, name = thing[0].removesuffix("s"), thing[1]
    if thing[0] == JOINT:
        kind = next((word for word in _WORDS if name in draft.of(f"{word}s")), kind)
    if thing[0] == "drive":
        return said("input")
    return name if name.startswith(kind) else said("{kind} {name}", kind=said(kind), name=name)


def stated(row: PropertyRow, building: Building, is_chosen: bool) -> str:
    """Return the text of a row: its value, or the typed text."""
    one = row.number
    if is_chosen and (building.typed or (building.lettered and not row.options)):
        return f"{building.typed}_"
    if one is None:
        return row.words or "–"
    return "–" if isnan(one.value) else typeset(f"{significant(one.value, 6)} {one.unit}".rstrip())


def _met(seen: Draft, thing: Thing | None, at: Point) -> Point | None:
    """Return the place of a joint, or the foot of a point on a guide; None elsewhere."""
    if thing and thing[0] == JOINT:
        return seen.places[thing[1]]
    if thing and thing[0] == "guides":
        return as_point(foot(seen, thing[1], complex(*at)))
    return None


@frozen
class SheetDrawing(Addition):
    """A sheet at a phase of the scene that is made of it, if there is one.

    The mouse is `over` a place. With the list of dimensions open the sheet `is_listed`; in a recording, where
    there are no tools, the hand is shown. The linkage is at rest while it `rests`.
    """

    sheet: BuildSheet
    scene: Scene
    phase: float
    is_listed: bool
    rests: bool
    over: Over | None = None
    is_recorded: bool = False

    def seen(self, over: Over | None, *, recorded: bool) -> SheetDrawing:
        """Return it with the mouse over a place of the sheet, or as a recording shows it."""
        return replace(self, over=over, is_recorded=recorded)

    @property
    def alone(self) -> Literal["", "sheet"]:
        """Where nothing moves there is no linkage beside it."""
        return "" if self.moves else "sheet"

    def groups(self, setting: DrawSetting, pose: Pose) -> Iterator[Group]:
        """Yield the draft, or what the moving linkage does not show, what the hand does, and the words."""
        del pose
        from linkanim.picture import build_sheet

        layout, sheet = setting.layout, self.sheet
        names, size = [], layout.small_size
        if not self.moves:
            setting = replace(setting, gauge=build_sheet.draft_gauge(layout, setting.view, self.shapes))
            drawing = self.draft(setting)
            yield from drawing.groups()
            names = [*drawing.names(size)]
        elif loose := self.loose(setting):
            yield from loose.groups()
            yield build_sheet.named([*loose.names(size)], over=False)
        if self.dots:
            yield build_sheet.dots(self.dots, setting)
        yield build_sheet.grid_words(setting, sheet.building.draft.unit)
        if chosen := next((one for one in self.shapes if one.thing == sheet.building.chosen), None):
            yield from build_sheet.chosen(chosen, self.number, setting, is_length=self.is_length)
        yield build_sheet.named(names)
        for kind, rows in (("numbers", self.numbers), ("offers", self.offers)):
            if rows:
                yield rows.group(kind, setting)
        if self.rubber:
            yield from self.rubber.groups(setting)
        if self.snap:
            yield self.snap.group(setting)
        for name, at in (("anchor", sheet.anchor), ("cursor", sheet.cursor)):
            if at:
                yield build_sheet.crosshair(name, at, setting)
        if self.is_recorded and sheet.grip:
            yield build_sheet.pointer(sheet.grip.at, setting)
        sentence, facts = self.words
        warns = sheet.building.is_refusal and bool(sheet.building.sentence)
        yield build_sheet.worded(setting, sentence, facts, is_warning=warns, tools=not self.is_recorded)

    @property
    def moves(self) -> bool:
        """Whether the linkage moves."""
        return self.sheet.building.made.scene is not None

    @cached_property
    def _seen(self) -> Draft:
        return self.sheet.seen(self.scene, self.phase)

    @cached_property
    def shapes(self) -> tuple[Shape, ...]:
        """The shapes of the draft where they are seen, from the back to the front."""
        return drawn(self._seen)

    @property
    def dots(self) -> tuple[Point, ...]:
        """The points of bodies of a linkage that moves."""
        return tuple(self._seen.places[name] for name in self._seen.of("points")) if self.moves else ()

    @property
    def _is_measured(self) -> bool:
        """Whether the list of dimensions has the chosen thing's numbers."""
        return self.is_listed and self.sheet.building.made.listed is not None and not self.sheet.rowed

    @property
    def _rows(self) -> tuple[PropertyRow, ...]:
        building = self.sheet.building
        return rows_of(building.draft, building.chosen)

    @property
    def numbers(self) -> SheetRows | None:
        """The chosen thing with all its numbers, including the one that is being typed."""
        building, own_rows = self.sheet.building, self._rows
        thing, draft = building.chosen, building.draft
        if thing is None or not own_rows or self.sheet.grip or self._is_measured:
            return None
        from linkanim.picture.sheet_rows import SheetRows

        row = building.row % len(own_rows)
        rows = [(said(one.label), stated(one, building, n == row)) for n, one in enumerate(own_rows)]
        options = tuple(n for n, one in enumerate(own_rows) if one.options)
        return SheetRows(subscripted_words(called(draft, thing)), tuple(rows), row, options=options)

    @property
    def offers(self) -> SheetRows | None:
        """The meanings of the last drag, with the one carried out lit; None where there is only one."""
        sheet = self.sheet
        if sheet.meant is None or sheet.grip:
            return None
        from linkanim.picture.sheet_rows import SheetRows

        rows = tuple((one.words, "") for one in sheet.offers)
        return SheetRows(said("Tab, or a click: it may be"), rows, sheet.meant, sheet.offered)

    @property
    def number(self) -> str:
        """The number of the chosen thing, as it is or as typed; empty while the linkage runs."""
        building, rows = self.sheet.building, self._rows
        runs = self.moves and not self.rests
        if not rows or self.sheet.grip or self._is_measured or (runs and not building.typed):
            return ""
        one = rows[building.row % len(rows)].number
        if one is None:
            return ""
        value = "–" if isnan(one.value) else significant(one.value, 6)
        return typeset(
            f"{said(one.label)} {building.typed}_"
            if building.typed
            else f"{said(one.label)} {value} {one.unit}"
        )

    @property
    def is_length(self) -> bool:
        """Whether the number to be typed is the length of the chosen bar."""
        rows = self._rows
        return bool(rows) and rows[self.sheet.building.row % len(rows)].key[::2] == ("bars", "length")

    @property
    def words(self) -> tuple[str, tuple[str, ...]]:
        """What the last gesture did, else what is missing or what the linkage is, and its facts."""
        building = self.sheet.building
        if building.made.scene is None:
            missing = building.made.missing
            return building.sentence or missing, (missing,) if building.sentence else ()
        info = self.scene.info
        facts = (*filter(None, [info.grashof]), said("input {motion}", motion=info.motion_words))
        if self.is_listed:
            return building.sentence, ()  # the list shows the rest
        if building.sentence:
            return building.sentence, (info.class_said, *facts)
        return info.class_said[:1].upper() + info.class_said[1:], facts

    def loose(self, setting: DrawSetting) -> DraftDrawing | None:
        """Return what the moving linkage does not show: guides without sliders, pins without bars."""
        seen = self._seen
        held = {joint for table in seen.of("bars").values() for joint in table["joints"]}
        held |= {
            end for kind in ("springs", "dampers") for one in seen.of(kind).values() for end in one["between"]
        }
        held |= {*seen.drive.get("cylinder", {}).get("between", ())}
        free = [one for one in self.shapes if one.kind == "pins" and one.label not in held]
        free += [one for one in self.shapes if one.kind == "guides" and len(one.places) == 2]
        from linkanim.picture.build_sheet import DraftDrawing

        return DraftDrawing(tuple(free), setting) if free else None

    def draft(self, setting: DrawSetting) -> DraftDrawing:
        """Return the draft that does not move yet, with the driven crank and the joints that are traced."""
        from linkanim.picture.build_sheet import DraftDrawing

        seen = self._seen
        crank = driven_bar(seen)
        ends = seen.of("bars")[crank[1]]["joints"] if crank else ()
        pivot_first = sorted(ends, key=lambda joint: joint not in seen.of("pins"))
        places = tuple(seen.places[joint] for joint in pivot_first)
        traced = tuple(seen.places[joint] for joint in seen.trace if joint in seen.places)
        return DraftDrawing(self.shapes, setting, (places[0], places[1]) if crank else None, traced)

    @cached_property
    def rubber(self) -> Rubber | None:
        """What the hand is drawing, from the joint where it began to the thing or place where it is.

        At rest it is the distance of two points of the photograph, as it is or as typed.
        """
        sheet, seen, grip = self.sheet, self._seen, self.sheet.grip
        from linkanim.picture.build_sheet import Rubber

        if grip is None or grip.is_click:
            if not (sheet.tool == "photo" and sheet.anchor and sheet.span):
                return None
            typed, unit = sheet.building.typed, sheet.building.draft.unit
            words = f"{typed}_" if typed else f"{short(dist(sheet.anchor, sheet.span))} {unit}"
            return Rubber("photo", sheet.anchor, sheet.span, typeset(said("distance {length}", length=words)))
        start = under(seen, *grip.begin, grip.reach)
        on_joint = start is not None and start[0] == JOINT
        if sheet.tool in ("move", "photo") or (sheet.tool in ("bar", "slider") and not on_joint):
            return None
        begin = seen.places[start[1]] if start and start[0] == JOINT else grip.begin
        hand = as_point(snapped(complex(*grip.at), grip.snap))
        end = _met(seen, under(seen, *grip.at, grip.reach), grip.at) or hand
        across, up = end[0] - begin[0], end[1] - begin[1]
        long, angle = hypot(across, up), degrees(atan2(up, across))
        digits = f"{short(long)} {seen.unit} · {significant(angle, 3)}°"
        return Rubber(sheet.tool, begin, end, typeset(digits))

    @cached_property
    def snap(self) -> Snap | None:
        """What the hand, or the mouse, is on."""
        grip, seen = self.sheet.grip, self._seen
        near = (grip.at, grip.reach) if grip else self.over
        if near is None:
            return None
        at, reach = near
        thing = under(seen, at[0], at[1], reach)
        if thing is None or self.sheet.tool == "photo" or (grip and self.sheet.tool == "move"):
            return None
        from linkanim.picture.build_sheet import Snap

        if thing[0] == "bars":
            one, other = (seen.places[joint] for joint in seen.ends(thing[1]))
            place = complex(*at) - from_span(complex(*one), complex(*other), complex(*at))
            return Snap(as_point(place), (one, other))
        if thing[0] == "guides":
            start, direction = line_of(seen, seen.of("guides")[thing[1]])
            ends = as_point(start - 1e3 * reach * direction), as_point(start + 1e3 * reach * direction)
            return Snap(_met(seen, thing, at) or at, ends)
        met = _met(seen, thing, at)
        return Snap(met) if met else None
