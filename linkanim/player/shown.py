"""Describe the state as an overlay: what lies over the picture, and what a sheet shows."""

from __future__ import annotations

import re
from dataclasses import replace
from functools import lru_cache
from math import atan2, degrees, dist, hypot, isnan
from typing import TYPE_CHECKING

from linkanim.build.building import Building
from linkanim.build.dimensions import PropertyRow, rows_of
from linkanim.build.draft import JOINT, Draft, Thing
from linkanim.build.gestures import under
from linkanim.build.places import Shape, as_point, drawn, foot, from_span, line_of, snapped
from linkanim.build.tools import TOOLS
from linkanim.mechanics.linkage import Point
from linkanim.picture.overlay import (
    BuildShown,
    DraftShown,
    Fading,
    Hover,
    Overlay,
    RowsShown,
    Rubber,
    Snap,
    SwingShown,
    ToolBar,
)
from linkanim.picture.text import subscripted
from linkanim.player.clock import FRAMES_PER_SECOND
from linkanim.player.commands import bar
from linkanim.player.pointing import Pointed, hover_text
from linkanim.player.state import (
    SHUTTER_FRAMES,
    BuildSheet,
    Changeover,
    Grip,
    State,
    driven_bar,
)
from linkanim.units import short, significant, typeset

if TYPE_CHECKING:
    pass

# What a sheet shows: its draft or the linkage made from it, words, tools, what is under the hand.

_WORDS = ("pin", "point", "slider", "yoke", "gear")
"""Shapes whose name says more than "joint"."""


def built(state: State, sheet: BuildSheet, hover: Hover | None = None) -> BuildShown:
    """Return what an open sheet shows; `hover` is what is under the mouse there, if it is there."""
    building, seen = sheet.building, sheet.seen(state.scene, state.phase)
    shapes = drawn(seen)
    moves = building.made.scene is not None
    # as beside the list of dimensions
    measured = state.edits_dimensions and building.made.listed is not None and not sheet.rowed
    sentence, facts = _words(state, sheet)
    tool = next((n for n, one in enumerate(TOOLS) if one.value == sheet.tool), 0)
    return BuildShown(
        draft=None if moves else _draft(seen, shapes),
        loose=_loose(seen, shapes) if moves else None,
        sentence=sentence,
        facts=facts,
        chosen=next((one for one in shapes if one.thing == building.chosen), None),
        number="" if measured else _number(sheet, moves=moves and not state.clock.paused),
        measures=_measures(building),
        rubber=_rubber(seen, sheet, sheet.grip) if sheet.grip and not sheet.grip.is_click else _span(sheet),
        snap=_snap(seen, sheet, hover),
        cursor=sheet.cursor,
        hand=sheet.grip.at if sheet.grip else None,
        photo=building.draft.photo,
        anchor=sheet.anchor,
        tools=ToolBar(tool, hover.tool if hover else None, typed=state.edits_dimensions),
        is_warning=building.is_refusal and bool(building.sentence),
        panel=None if sheet.grip or measured else _numbers(building),
        offers=_offers(sheet),
        dots=tuple(seen.places[name] for name in seen.of("points")) if moves else (),
        unit=building.draft.unit,
    )


def _numbers(building: Building) -> RowsShown | None:
    """Return the chosen thing with all its numbers, including the one that is being typed."""
    thing, draft = building.chosen, building.draft
    own_rows = rows_of(draft, thing)
    if thing is None or not own_rows:
        return None
    row = building.row % len(own_rows)
    rows = [(one.label, stated(one, building, n == row)) for n, one in enumerate(own_rows)]
    title = subscripted_words(called(draft, thing))
    options = tuple(n for n, one in enumerate(own_rows) if one.options)
    return RowsShown(title, tuple(rows), row, options=options)


def called(draft: Draft, thing: Thing) -> str:
    """Return the words for a thing of a sheet: "pin O2", "bar A–B", "input"."""
    kind, name = thing[0].removesuffix("s"), thing[1]
    if thing[0] == JOINT:
        kind = next((word for word in _WORDS if name in draft.of(f"{word}s")), kind)
    return "input" if thing[0] == "drive" else name if name.startswith(kind) else f"{kind} {name}"


def stated(row: PropertyRow, building: Building, is_chosen: bool) -> str:
    """Return the text of a row: its value, or the typed text."""
    one = row.number
    if is_chosen and (building.typed or (building.lettered and not row.options)):
        return f"{building.typed}_"
    if one is None:
        return row.words or "–"
    return "–" if isnan(one.value) else typeset(f"{significant(one.value, 6)} {one.unit}".rstrip())


def _offers(sheet: BuildSheet) -> RowsShown | None:
    """Return the meanings of the last drag, with the one carried out lit; None where there is only one."""
    if sheet.meant is None or sheet.grip:
        return None
    rows = tuple((one.words, "") for one in sheet.offers)
    return RowsShown("Tab, or a click: it may be", rows, sheet.meant, sheet.offered)


def _number(sheet: BuildSheet, *, moves: bool) -> str:
    """Return the number of the chosen thing, as it is or as typed; empty while the linkage runs."""
    building = sheet.building
    rows = rows_of(building.draft, building.chosen)
    if not rows or sheet.grip or (moves and not building.typed):
        return ""
    one = rows[building.row % len(rows)].number
    if one is None:
        return ""
    value = "–" if isnan(one.value) else significant(one.value, 6)
    return typeset(f"{one.label} {building.typed}_" if building.typed else f"{one.label} {value} {one.unit}")


def _measures(building: Building) -> bool:
    """Return whether the number to be typed is the length of the chosen bar."""
    rows = rows_of(building.draft, building.chosen)
    return bool(rows) and rows[building.row % len(rows)].key[::2] == ("bars", "length")


def _words(state: State, sheet: BuildSheet) -> tuple[str, tuple[str, ...]]:
    """Return what the last gesture did, else what is missing or what the linkage is, and its facts."""
    building = sheet.building
    if building.made.scene is None:
        missing = building.made.missing
        return building.sentence or missing, (missing,) if building.sentence else ()
    info = state.scene.info
    facts = (*filter(None, [info.grashof]), f"input {info.motion_words}")
    if state.edits_dimensions:
        return building.sentence, ()  # the list shows the rest
    if building.sentence:
        return building.sentence, (info.class_name, *facts)
    return info.class_name[:1].upper() + info.class_name[1:], facts


def _loose(seen: Draft, shapes: tuple[Shape, ...]) -> DraftShown | None:
    """Return what the moving linkage does not show: guides without sliders, pins without bars."""
    held = {joint for table in seen.of("bars").values() for joint in table["joints"]}
    held |= {
        end for kind in ("springs", "dampers") for one in seen.of(kind).values() for end in one["between"]
    }
    held |= {*seen.drive.get("cylinder", {}).get("between", ())}
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
    """Return what the hand is drawing, from the joint where it began to the thing or place where it is."""
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


def _span(sheet: BuildSheet) -> Rubber | None:
    """Return the distance of two points of the photograph, as it is or as typed."""
    if not (sheet.tool == "photo" and sheet.anchor and sheet.span):
        return None
    typed, unit = sheet.building.typed, sheet.building.draft.unit
    words = f"{typed}_" if typed else f"{short(dist(sheet.anchor, sheet.span))} {unit}"
    return Rubber("photo", sheet.anchor, sheet.span, typeset(f"distance {words}"))


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
        start, direction = line_of(seen, seen.of("guides")[thing[1]])
        ends = as_point(start - 1e3 * reach * direction), as_point(start + 1e3 * reach * direction)
        return Snap(_met(seen, thing, at) or at, ends)
    met = _met(seen, thing, at)
    return Snap(met) if met else None


# What lies over the picture: the state as an overlay.

_BAR = "Space pause · Tab next · drag any joint · right click: all commands · H keys"
_BAR_FRAMES = 6 * FRAMES_PER_SECOND
_WATCH_FRAMES = 6 * FRAMES_PER_SECOND
_NAME = r"\b[^\W\d_]\w*"


def overlay(
    state: State,
    hover: str | None = None,
    row: int | None = None,
    over: Hover | None = None,
    button: int | None = None,
    pointed: Pointed | None = None,
) -> Overlay:
    """Return all that the window shows beside the scene.

    These are what is under the mouse: `hover` a joint, `row` a row of a list, `over` a place of a sheet,
    `button` the number of a command on the bar, `pointed` a thing of the scene with words about it.
    """
    lists = _lasting(state, over)
    return replace(
        lists,
        pointed=row if lists.listed else None,
        toast=_plain(lists.toast or (state.toast.text if state.toast else None)),
        chip=_chip(state),
        hint=_hint_bar(state),
        watch=None if state.game else _watch(state),
        glow=_glow(state, hover),
        hover_text=hover_text(state, pointed) if pointed else None,
        instant=pointed.instant if pointed else None,
        grip=state.look.chart is not None and not state.game,
        shutter=0 if state.shot is None else 8 - 8 * (state.frame - state.shot) // SHUTTER_FRAMES,
        swing=_swing(state),
        bar=bar(state, button),
    )


def _plain(text: str | None) -> str | None:
    """Return a message without the marks in which a terminal's messages have commands."""
    return text and text.replace("`", "")


def _swing(state: State) -> SwingShown | None:
    """Return the closure that is left, and how far, while the linkage swings over."""
    swing = state.glide if isinstance(state.glide, Changeover) else None
    return SwingShown(swing.left, swing.share(state.frame)) if swing else None


def _glow(state: State, hover: str | None) -> str | None:
    """Return the joint of the scene that is lit: the one in the hand, else the one under the mouse."""
    held = state.held or state.grasp
    joint = held.joint if held else hover
    return joint if joint in state.shown.linkage.by_name else None


def lasting(state: State) -> Overlay:
    """Return the part of the overlay that belongs on a screenshot: all that does not come and go."""
    return replace(_lasting(state), measured=(), tools=None)


def _lasting(state: State, over: Hover | None = None) -> Overlay:
    overlay = Overlay(
        paused=_stands(state) and not state.game,
        noted=True,
        recording=_recording(state),
        hover=over,
    )
    for mode in state.modes:
        overlay = mode.shown(state, overlay)
    return replace(overlay, hover=None)


def _stands(state: State) -> bool:
    """Return whether the motion is paused, and not merely dragged by a hand."""
    return state.clock.paused and not (state.grasp and state.grasp.ran)


def _chip(state: State) -> Fading | None:
    return Fading(state.chip.text, min(state.chip.until - state.frame, 8)) if state.chip else None


def _hint_bar(state: State) -> Fading | None:
    """Return the hint bar: once, after the first seconds, unless the user does something before."""
    if state.touched or not state.is_bare or state.toast or state.chip:
        return None
    since = max(state.frame - _WATCH_FRAMES, 0)
    eighths = min(since, _BAR_FRAMES - since, 32) // 4
    return Fading(_BAR, eighths) if eighths > 0 else None


def _watch(state: State) -> Fading | None:
    """Return the sentence on what to watch for: with the names, and in a mechanism's first seconds.

    Of these it is there until something is done.
    """
    if state.is_covered or state.recording or state.toast:
        return None
    gone = state.frame - (state.frame if state.arrived is None else state.arrived)
    is_new = 0 < gone < _WATCH_FRAMES and state.touched <= (state.arrived or 0)
    return Fading(state.shown.look_at) if is_new or state.look.names else None


def _recording(state: State) -> str | None:
    if state.recording is None:
        return None
    seconds = (state.frame - state.recording.since) // FRAMES_PER_SECOND
    return f"REC {state.recording.format.upper()} {seconds // 60}:{seconds % 60:02d}"


@lru_cache(maxsize=512)
def subscripted_words(words: str) -> str:
    """Return words with the digits at the ends of names as subscripts."""
    return re.sub(_NAME, lambda name: subscripted(name[0]), words)
