"""Actions of the sheet: it is opened and left, the hand draws on it, the chosen thing is changed."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from math import ceil, dist, radians, tau
from typing import Any

from linkanim.build import building as built
from linkanim.build import dimensions, gestures
from linkanim.build.building import Building, building_of, choosing, draft_of, knowing
from linkanim.build.draft import JOINT
from linkanim.build.meanings import Meaning, drag, meanings
from linkanim.build.numbers import chosen_row, renumbered, rows_of_all, thing_at
from linkanim.build.storing import restored, stored
from linkanim.build.tools import TOOLS
from linkanim.errors import BadInput
from linkanim.intake import Intake, Section, unnameable
from linkanim.picture.figure import figure
from linkanim.picture.look import Look
from linkanim.picture.overlay import NEW
from linkanim.picture.quantities import chart_tokens
from linkanim.picture.view import Box
from linkanim.player.clock import FRAMES_PER_SECOND
from linkanim.player.edits import drop, exchanged, nudged
from linkanim.player.edits import put as put_on
from linkanim.player.sketching import left as abandoned
from linkanim.player.state import (
    BLANK,
    HOME,
    LIVE,
    BuildSheet,
    Editing,
    Grip,
    State,
    cleared,
    nothing_begun,
    with_toast,
    with_undo,
)
from linkanim.scenes.editing import dimensions as dimensions_of
from linkanim.scenes.editing import other_closure
from linkanim.units import shown

Handler = Callable[[State, Any], State]

_DOUBLE = 24
"""Frames within which a second click at a place makes a double one."""
_OFFERED = 4
"""The most meanings of a drag that are offered."""
_LONGEST = 10 * FRAMES_PER_SECOND
"""A linkage that can move runs for one period where that is no longer than this, in frames."""
VERSION = 1
_MARK = "linkanim_draft"
_DAMAGED = "is damaged, or not a draft of linkanim"
DRAFT = Intake("a draft", most_bytes=5_000_000, most_values=500_000)
_FARTHEST = 1e15
"""The farthest coordinate that is visible on a sheet."""
LOST = "the draft is not saved: Ctrl+S saves it; press again to begin anew"
_MEANT = "the draft is not saved: Ctrl+S saves it; press again to close, and it is offered next time"


def build(state: State, _: None) -> State:
    """Open the sheet, as it was left if there is one; or leave it with what was built on it."""
    if state.sheet is None:
        return _opened(state, Building())
    return left(state) if state.sheet.open else _opened(state, state.sheet.building)


def build_on(state: State, _: None) -> State:
    """Open a sheet with the present scene; where a draft would be lost, only when asked once more.

    Its undo continues into earlier edits. Where the scene came from a sheet, that sheet is opened again.
    """
    sheet, editing = state.sheet, state.editing
    if sheet and sheet.open:
        return left(state)
    if sheet and sheet.building.made.scene is state.scene:
        return _opened(state, sheet.building)
    past, future = (tuple(map(draft_of, scenes)) for scenes in (editing.past, editing.future))
    building = replace(building_of(state.scene), past=past, future=future)
    original, saved = editing.original or state.scene, state.saved_as or ""
    opened = _anew(state, lambda: building)
    if opened.sheet is None or opened.sheet.building is not building:
        return opened
    opened = replace(opened, editing=replace(Editing(), chosen=editing.chosen, original=original))
    return _with(opened, saved=saved)


def numbers(state: State, _: None) -> State:
    """Open or close the list of all dimensions on a sheet; typed values are discarded."""
    sheet = state.building
    if sheet is None:
        return state
    if not rows_of_all(sheet.building.draft):
        return with_toast(state, BLANK)
    editing = cleared(replace(state.editing, drafts=()), open=not state.editing.open)
    return replace(state.unlisted, editing=editing, held=None)


def new(state: State, _: None) -> State:
    """Open an empty sheet; where a draft would be lost, only when asked once more."""
    return _anew(state, Building)


def _anew(state: State, make: Callable[[], Building]) -> State:
    """Return the state with another sheet; where a draft is in no file, only when asked once more."""
    sheet = state.sheet
    if sheet and not (sheet.is_written or sheet.warned or _is_undone_to(state, sheet)):
        return with_toast(replace(state, sheet=replace(sheet, warned=True)), LOST)
    building = make()
    return _opened(replace(left(state), sheet=None), building, known=True)


def _is_undone_to(state: State, sheet: BuildSheet) -> bool:
    """Return whether the linkage of a sheet is shown, or undo goes back to it."""
    made = sheet.building.made.scene
    return made is not None and any(one is made for one in (state.scene, *state.editing.past))


def _opened(state: State, building: Building, *, known: bool = False) -> State:
    """Return the state with a sheet open over its scene; `known` says that its draft is in a file."""
    state, last = abandoned(drop(state, None)), state.sheet
    editing = nothing_begun(replace(state.editing, open=False))
    sheet = BuildSheet(state.scene, state.clock, editing, building, HOME, written=building.draft)
    sheet = replace(sheet, look=state.look)
    if last and not known:
        sheet = replace(sheet, written=last.written, saved=last.saved, tool=last.tool, home=last.home)
    elif building.draft.places:
        sheet = replace(sheet, home=figure(state.scene).box)
    look = replace(state.look, unit=None, zoom=1.0, pan=(0.0, 0.0), chart=None)
    bare = replace(state.unlisted, editing=Editing(), glide=None, toast=None, look=look)
    return _shown(replace(bare, sheet=sheet, faded=state.frame), building)


def left(state: State) -> State:
    """Leave the sheet: a linkage that moves becomes the scene, which can be undone; the sheet is kept."""
    sheet = state.sheet
    if sheet is None or not sheet.open:
        return state
    after = replace(state, sheet=replace(sheet, open=False, grip=None, cursor=None, warned=False))
    after = replace(after, faded=state.frame, look=_look_after(state, sheet), held=None)
    if sheet.building.made.scene is None:
        return replace(after, scene=sheet.before, clock=sheet.clock, editing=sheet.editing)
    after = replace(after, clock=state.clock.pause(state.frame, sheet.clock.paused))
    editing = with_undo(sheet.editing, sheet.before)
    if sheet.saved:
        editing = replace(editing, saved=(state.scene.name, sheet.saved))
    return replace(after, editing=replace(editing, original=state.scene) if sheet.is_written else editing)


def _look_after(state: State, sheet: BuildSheet) -> Look:
    """Return the look after a sheet: with the unit and the charts from before, where they still apply."""
    scene = sheet.before if sheet.building.made.scene is None else state.scene
    tokens = chart_tokens(sheet.before, sheet.look.chart)
    charts = state.look.chart or ",".join(token for token in tokens if token in scene.quantities) or None
    return replace(state.look, zoom=1.0, pan=(0.0, 0.0), unit=sheet.look.unit, chart=charts)


def draft(state: State, text: str) -> State:
    """Open a sheet from the text that it was stored as; BadInput for any other text."""
    look, sheet = state.look, restored_sheet(state, text)
    opened = _opened(replace(state, sheet=sheet), sheet.building)
    return replace(opened, look=replace(look, unit=None, chart=None))


def offered(state: State, text: str, where: str) -> State:
    """Return the state with a sheet read from its stored text, for F2 to open."""
    sheet = replace(restored_sheet(state, text, where), open=False, closes=True)
    return replace(state, sheet=sheet, beneath=state.beneath and replace(state.beneath, sheet=sheet))


def stored_text(sheet: BuildSheet) -> str:
    """Return a sheet with its draft as text that `draft` takes."""
    import json  # imported here, so that the first frame does not wait for it

    draft = stored(sheet.building.draft)
    table = {_MARK: VERSION, "draft": draft, "home": sheet.home, "tool": sheet.tool}
    return json.dumps(table, ensure_ascii=False)


def restored_sheet(state: State, text: str, where: str = "the draft") -> BuildSheet:
    """Return a sheet from the text that it was stored as; BadInput, OtherVersion as for any document."""
    document = DRAFT.parsed(text, where, _DAMAGED)
    # the document of an older tape has no version mark
    known = {_MARK: VERSION, **document} if isinstance(document, dict) and "draft" in document else document
    top = Section(where, DRAFT.marked(known, where, _MARK, VERSION, _DAMAGED))
    edges = top.listed("home", 4)
    left, low, right, high = (edges.number(key) for key in edges.values)
    if not (left < right and low < high and max(map(abs, (left, low, right, high))) <= _FARTHEST):
        raise top.error("home", "must be the left, lower, right and upper edge of what is seen")
    tool = top.choice("tool", tuple(one.value for one in TOOLS if one.action == "tool" and one.value))
    building = restored(top.table("draft").values, where)
    return BuildSheet(
        state.scene, state.clock, state.editing, building, Box(left, low, right, high), tool=tool
    )


def written(state: State, file: str) -> State:
    """Return the state with the note that its scene, and its draft, are in a scene file."""
    sheet = state.sheet
    if sheet and sheet.building.made.scene == state.scene:
        sheet = replace(sheet, written=sheet.building.draft, saved=file, warned=False, closes=False)
        state = replace(state, sheet=sheet)
    if state.building:
        return state
    editing = replace(state.editing, original=state.scene, saved=(state.scene.name, file))
    return replace(state, editing=editing)


def closing(state: State) -> State | None:
    """Return the state that asks before a draft in no file is lost; None where there is nothing to ask."""
    sheet = state.sheet
    if sheet is None or sheet.is_written or sheet.closes:
        return None
    return with_toast(replace(state, sheet=replace(sheet, closes=True)), _MEANT)


def put(state: State, place: int) -> State:
    """Put on a mechanism of the shelf, or an empty sheet."""
    return new(state.unlisted, None) if place == NEW else put_on(state, place)


def _shown(state: State, building: Building, *, live: bool = False) -> State:
    """Return the state with another building, its linkage running for a period.

    The linkage stands still while it is `live` under the hand; and where there is no loop yet, so that one
    can draw the next bar from there.
    """
    sheet = sheet_of(state)
    same = building.draft is sheet.building.draft
    building = knowing(building, sheet.building.made) if same else building
    warned, closes = sheet.warned and same, sheet.closes and same
    drawn = replace(state, sheet=replace(sheet, building=building, warned=warned, closes=closes))
    scene = building.made.scene
    if scene is None or scene is state.scene:
        return drawn
    known = scene.linkage == state.scene.linkage and state.clock.paused and not live
    found = exchanged(replace(drawn, glide=None), scene)
    clock = found.clock.go(state.frame, building.draft.phase, paused=True)
    stands = live or known or not any(joint.dyad for joint in scene.linkage.joints)
    found = replace(found, clock=clock, sheet=replace(sheet_of(drawn), rests=None))
    return found if stands else _once(found)


def sheet_of(state: State) -> BuildSheet:
    """Return the sheet of a state that has one."""
    assert state.sheet
    return state.sheet


def _once(state: State) -> State:
    """Return the state with its linkage running for one period, or without end where that is long."""
    clock = state.clock.pause(state.frame, False)
    frames = ceil(FRAMES_PER_SECOND * state.scene.period / abs(clock.speed))
    rests = state.frame + frames if frames <= _LONGEST else None
    return replace(state, clock=clock, sheet=replace(sheet_of(state), rests=rests))


def rested(state: State) -> State:
    """Return the state with the linkage at rest as drawn, once it has run for a period."""
    sheet = state.sheet
    if sheet is None or sheet.rests is None:
        return state
    if state.clock.paused or not sheet.open:
        return replace(state, sheet=replace(sheet, rests=None))
    if state.frame < sheet.rests:
        return state
    clock = state.clock.go(state.frame, sheet.building.draft.phase, paused=True)
    return replace(state, clock=clock, sheet=replace(sheet, rests=None))


def tool(state: State, name: str) -> State:
    """Take a tool; a linkage that runs goes back to its drawn pose, and rests there."""
    sheet = state.sheet
    if sheet and sheet.open and sheet.building.made.scene and not state.clock.paused:
        state = replace(state, clock=state.clock.go(state.frame, sheet.building.draft.phase, paused=True))
    return _with(state, tool=name, grip=None, anchor=None, span=None)


def tool_on(state: State, by: int) -> State:
    """Take the next tool of the bar; where the last drag has several meanings, carry out the next one."""
    sheet = state.sheet
    if sheet is None or not sheet.open:
        return state
    if sheet.meant is not None:
        return offer(state, sheet.meant + by)
    known = tuple(one.value for one in TOOLS if one.action == "tool" and one.value)
    return tool(state, known[(known.index(sheet.tool) + by) % len(known)])


def photo(state: State, file: str) -> State:
    """Put a photograph behind the sheet, as wide as the visible part, and take the tool that fits it.

    BadInput for a file name that cannot be stored with a sheet.
    """
    if file and (reason := unnameable(file)):
        raise BadInput(f"{shown(file)}: {reason}; rename the picture")
    state = state if state.building else build(state, None)
    home = sheet_of(state).home
    width = home.right - home.left
    laid = gestures.lay_photo(sheet_of(state).building, file, home.left, home.low, width)
    return tool(_shown(state, laid), "photo" if file else "bar")


def down(state: State, at: tuple[float, float, float, float]) -> State:
    """Put the hand down at a point; a linkage that runs goes back to its drawn pose.

    Where only the pose that was visible had something at the point, it rests at the nearest whole degree.
    """
    sheet = state.sheet
    if sheet is None or not sheet.open:
        return state
    x, y, reach, snap = at
    base, ran = sheet.building, not state.clock.paused
    if base.made.scene:
        phase = picked(state, sheet, x, y, reach)
        base = built.posed(base, phase)
        state = replace(state, clock=state.clock.go(state.frame, phase, paused=True))
    cursor = sheet.cursor if sheet.cursor and dist(sheet.cursor, (x, y)) <= reach else None
    return _with(state, grip=Grip((x, y), (x, y), reach, snap, base, ran), cursor=cursor)


def picked(state: State, sheet: BuildSheet, x: float, y: float, reach: float) -> float:
    """Return the phase at which a linkage rests for a hand that goes down at a point."""
    now, drawn_at = radians(round(state.phase / tau * 360)), sheet.building.draft.phase
    if state.clock.paused:
        return now
    if gestures.under(sheet.building.draft, x, y, reach):
        return drawn_at
    return now if gestures.under(sheet.seen(state.scene, state.phase), x, y, reach) else drawn_at


def along(state: State, at: tuple[float, float, float, float]) -> State:
    """Move the hand to a point; the thing that it holds follows."""
    sheet = state.sheet
    if sheet is None or sheet.grip is None:
        return state
    x, y, _, snap = at
    grip = sheet.grip._replace(at=(x, y), snap=snap)
    state, live = _with(state, grip=grip), sheet.tool in LIVE and not grip.is_click
    return _shown(state, _drawn(sheet, grip), live=True) if live else state


def up(state: State, _: None) -> State:
    """Lift the hand: a click or a drag is carried out."""
    sheet = state.sheet
    if sheet is None or sheet.grip is None:
        return state
    grip = sheet.grip
    state = _with(state, grip=None, clicked=(state.frame, grip.begin) if grip.is_click else None)
    offers: tuple[Meaning, ...] = ()
    if grip.is_click and sheet.tool == "photo" and grip.base.draft.photo:
        return _spanned(state, sheet, grip)
    if grip.is_click:
        building = _clicked(state, sheet, grip)
    elif sheet.tool in LIVE:
        building = _drawn(sheet, grip)
    else:
        offers = meanings(grip.base, sheet.tool, *grip.begin, *grip.at, reach=grip.reach, snap=grip.snap)
        building = offers[0].building
    state = _with(state, offers=offers[:_OFFERED] if len(offers) > 1 else (), offered=grip.at)
    if building.draft is grip.base.draft:
        kept = replace(building, draft=sheet.building.draft) if sheet.tool not in LIVE else building
        return _running(_shown(state, kept), ran=grip.ran)
    state = _shown(state, building)
    if sheet.tool == "photo":
        return _with(state, anchor=sheet.anchor or grip.at, span=None)
    moved = sheet.tool == "move" and building.made.scene is not None
    return _once(state) if moved else state


def off(state: State, _: None) -> State:
    """Lift the hand, and leave all as it was before."""
    sheet = state.sheet
    if sheet is None or sheet.grip is None:
        return state
    return _running(_shown(_with(state, grip=None), sheet.grip.base), ran=sheet.grip.ran)


def _running(state: State, *, ran: bool) -> State:
    return replace(state, clock=state.clock.pause(state.frame, not ran))


def _clicked(state: State, sheet: BuildSheet, grip: Grip) -> Building:
    """Return the building after a click, or after a double click where it is the second one at a place."""
    (x, y), near = grip.begin, {"reach": grip.reach, "snap": grip.snap}
    frame, before = sheet.clicked or (state.frame - 2 * _DOUBLE, grip.begin)
    if state.frame - frame <= _DOUBLE and dist(before, grip.begin) <= grip.reach:
        return gestures.double_click(grip.base, x, y, **near)
    if sheet.tool == "photo":
        return grip.base
    if sheet.tool == "move" and gestures.under(grip.base.draft, x, y, grip.reach) is None:
        return replace(grip.base, chosen=None, sentence="")
    return gestures.click(grip.base, sheet.tool, x, y, **near)


def _drawn(sheet: BuildSheet, grip: Grip) -> Building:
    """Return the building after a drag."""
    ends = (*grip.begin, *grip.at)
    if sheet.tool == "photo":
        held = sheet.anchor and (*sheet.anchor, *sheet.anchor)
        return gestures.fit_photo(grip.base, *held, *ends) if held else gestures.move_photo(grip.base, *ends)
    return drag(grip.base, sheet.tool, *ends, reach=grip.reach, snap=grip.snap)


def _spanned(state: State, sheet: BuildSheet, grip: Grip) -> State:
    """Take a point of the photograph, or a second one, whose distance from the first is then typed."""
    second = sheet.anchor is not None and sheet.span is None and dist(sheet.anchor, grip.begin) > grip.reach
    how = (
        "Type how far it is from there in truth, then Enter"
        if second
        else "Now click a point at a known distance"
    )
    building = replace(choosing(grip.base, None), sentence=how, is_refusal=False)
    places = {"span": grip.begin} if second else {"anchor": grip.begin, "span": None}
    return _with(_running(state, ran=grip.ran), building=building, **places)


def _scaled(state: State, sheet: BuildSheet, one: complex, other: complex) -> State:
    """Return the state with the photograph scaled, so that two of its points are as far apart as typed."""
    building = sheet.building
    try:
        length = dimensions.typed_length(building, abs(other - one))
    except BadInput as error:
        return _with(state, building=replace(building, sentence=str(error), is_refusal=True))
    after = gestures.scale_photo(building, one, other, length)
    there = one + (other - one) * length / abs(other - one)
    return _with(_shown(state, replace(after, typed="")), span=(there.real, there.imag))


def take(state: State, _: None) -> State:
    """Take the typed value: for the distance of two points of a photograph, or for the chosen thing."""
    sheet = state.sheet
    if (
        sheet
        and sheet.open
        and sheet.tool == "photo"
        and sheet.anchor
        and sheet.span
        and sheet.building.typed
    ):
        return _scaled(state, sheet, complex(*sheet.anchor), complex(*sheet.span))
    return _taken(state, None)


def offer(state: State, place: int) -> State:
    """Carry out another of the meanings of the last drag."""
    sheet = state.sheet
    if sheet is None or not sheet.open or sheet.grip or sheet.meant is None:
        return state
    return _shown(state, sheet.offers[place % len(sheet.offers)].building)


def cursor(state: State, at: tuple[float, float]) -> State:
    """Move the keys' cursor to a point; a gesture begun by keys follows."""
    sheet = state.sheet
    if sheet is None or not sheet.open:
        return state
    if sheet.grip:
        state = along(state, (*at, 0.0, sheet.grip.snap))
    return _with(state, cursor=at)


def further(state: State, by: int) -> State:
    """Choose the next thing, or the one before; the keys' cursor goes to a joint.

    Where the last drag has several meanings, the next one is carried out instead.
    """
    if state.sheet and state.sheet.meant is not None:
        return offer(state, state.sheet.meant + by)
    state = _changed(gestures.choose)(state, by)
    sheet = state.sheet
    thing = sheet.building.chosen if sheet else None
    if sheet is None or thing is None or thing[0] != JOINT:
        return state
    return _with(state, cursor=sheet.seen(state.scene, state.phase).places[thing[1]])


def _changed(work: Callable[..., Building]) -> Handler:
    """Make a handler of a function that changes the building; an action's value is passed on to it."""

    def handle(state: State, value: Any) -> State:
        sheet = state.sheet
        if sheet is None or not sheet.open or sheet.grip:
            return state
        building = work(sheet.building, *(() if value is None else (value,)))
        return _shown(_with(state, clicked=None), building)

    return handle


def number(state: State, further: int) -> State:
    """Choose another number of the chosen thing, to be typed."""
    return _with(_changed(dimensions.choose_number)(state, further), rowed=True)


option = _changed(dimensions.next_option)
write = _changed(dimensions.write)
erase = _changed(dimensions.erase)
_taken = _changed(dimensions.take)
remove = _changed(gestures.delete)
trace = _changed(gestures.trace)
drive = _changed(gestures.drive)


def reassemble(state: State, _: None) -> State:
    """Put the first loop together the other way."""
    sheet = state.sheet
    if sheet is None or not sheet.open or sheet.grip:
        return state
    scene = sheet.building.made.scene
    if scene is None:
        return with_toast(state, sheet.building.made.missing)
    return _shown(state, renumbered(sheet.building, other_closure(scene)))


def undo(state: State, _: None) -> State:
    """Undo a change; measured points of a photograph are discarded.

    Values typed in the list of dimensions are discarded first.
    """
    if state.editing.begun:
        return replace(state, editing=nothing_begun(state.editing))
    return _changed(built.undo)(_with(state, span=None), None)


def redo(state: State, _: None) -> State:
    """Redo the change undone last."""
    return _changed(built.redo)(_with(state, span=None), None)


# The list of all dimensions on the sheet: it edits the linkage as it does anywhere, and the draft follows.


def agreed(before: State, after: State) -> State:
    """Return the state after an action, with the building and the open list of dimensions in agreement.

    A scene that the list changed becomes the draft's, as one step of the sheet's undo. The thing chosen on
    the sheet has its row chosen in the list, and the other way round. A thing chosen by hand is typed in its
    own rows, as without the list.
    """
    sheet, was = after.building, before.building
    if sheet is None:
        return after
    is_old = was is not None and sheet.building is was.building
    if is_old and after.scene is not before.scene and sheet.building.made.scene:
        grows = after.editing.past is not before.editing.past
        building = renumbered(sheet.building, after.scene, grows=grows)
        editing = replace(after.editing, past=before.editing.past, future=before.editing.future)
        after = replace(_with(after, building=building, rests=None, warned=False), editing=editing)
        return _chosen_by_row(after) if editing.open else after
    if not after.editing.open:
        return after
    if was is None or not before.editing.open:
        return _rowed(after) if sheet.building.chosen else _chosen_by_row(after)
    if sheet.building is not was.building:
        if sheet.building.draft is not was.building.draft:
            after = replace(after, editing=cleared(after.editing, drafts=()))
        if sheet.building.chosen is None:
            return _with(after, rowed=False)
        return after if sheet.building.chosen == was.building.chosen else _rowed(after)
    return after if after.editing.chosen == before.editing.chosen else _chosen_by_row(after)


def _rowed(state: State) -> State:
    """Return the state with the first row of the chosen thing as the chosen row of the list."""
    state = _with(state, rowed=True)
    sheet = sheet_of(state)
    thing, scene = sheet.building.chosen, sheet.building.made.scene
    if thing is None or scene is None:
        return state
    things = [thing_at(sheet.building.draft, scene, item.key) for item in dimensions_of(scene)]
    if thing not in things or things[state.editing.chosen % len(things)] == thing:
        return state
    return replace(state, editing=cleared(state.editing, chosen=things.index(thing)))


def _chosen_by_row(state: State) -> State:
    """Return the state with the thing of the list's chosen row chosen on the sheet."""
    sheet = sheet_of(state)
    scene, items = sheet.building.made.scene, dimensions_of(state.scene)
    if scene is None or not items:
        return state
    key = items[state.editing.chosen % len(items)].key
    building = choosing(sheet.building, thing_at(sheet.building.draft, scene, key))
    return _with(state, building=building, rowed=False)


def _in_rows(work: Callable[[State, BuildSheet, Any], State]) -> Handler:
    """Make a handler of a function for the list while the draft does not move."""

    def handle(state: State, value: Any) -> State:
        sheet = state.building
        return state if sheet is None or sheet.grip else work(state, sheet, value)

    return handle


def _row_chosen(state: State, sheet: BuildSheet, place: int) -> State:
    rows = rows_of_all(sheet.building.draft)
    if not rows:
        return state
    one = rows[place % len(rows)]
    return _with(state, building=replace(choosing(sheet.building, one.thing), row=one.place))


def _row_further(state: State, sheet: BuildSheet, by: int) -> State:
    at = chosen_row(sheet.building)
    return _row_chosen(state, sheet, 0 if at is None else at + by)


def _row_nudged(state: State, sheet: BuildSheet, steps: int) -> State:
    at, rows = chosen_row(sheet.building), rows_of_all(sheet.building.draft)
    if at is None:
        return state
    one = rows[at]
    assert one.row.number
    typed = replace(sheet.building, row=one.place, typed=nudged(one.row.number, steps))
    return _shown(state, replace(dimensions.take(typed), row=one.place))


def _unused(state: State, _: object) -> State:
    return state


_OWN_ROWS: Mapping[str, Handler] = {"type": write, "erase": erase, "take": _taken}
_WHILE_IT_STANDS: Mapping[str, Handler] = {
    "choose": _in_rows(_row_further),
    "pass_on": _in_rows(_row_further),
    "grab_row": _in_rows(_row_chosen),
    "nudge": _in_rows(_row_nudged),
    **_OWN_ROWS,
    **dict.fromkeys(("pull", "reset", "returns", "grab", "carry"), _unused),
    "closure": reassemble,
}
"""Handlers for the list of dimensions on a sheet with nothing that moves: its rows are the draft's."""


def in_list(state: State, name: str, usual: Handler) -> Handler:
    """Return the handler of an action of the list of dimensions on the sheet: a special one, or `usual`."""
    sheet = state.building
    if sheet is None or not state.editing.open:
        return usual
    instead = _WHILE_IT_STANDS if sheet.building.made.scene is None else _OWN_ROWS if sheet.rowed else {}
    return instead.get(name, usual)


def let_go(state: State) -> State | None:
    """Return the state without a gesture, typed text, a choice, or a special tool; None where there is none.

    With the list of dimensions open, only what was typed in it is discarded.
    """
    sheet = state.sheet
    assert sheet
    if sheet.grip:
        return off(state, None)
    if state.editing.open:
        bare = _with(state, building=replace(sheet.building, typed="", sentence=""))
        begun = state.editing.begun or sheet.building.typed
        return replace(bare, editing=nothing_begun(state.editing)) if begun else None
    building = sheet.building
    if building.typed or building.chosen:
        kept = building.chosen if building.typed else None
        return _with(state, building=replace(building, typed="", chosen=kept, sentence=""))
    return _with(state, tool="bar") if sheet.tool != "bar" else None


def _with(state: State, **changes: Any) -> State:
    """Return the state with these changes of its sheet, if one is open."""
    sheet, building = state.sheet, changes.get("building")
    if sheet is None or not sheet.open:
        return state
    if building and building.draft is sheet.building.draft:
        knowing(building, sheet.building.made)
    return replace(state, sheet=replace(sheet, **changes))
