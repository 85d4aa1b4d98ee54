"""Two modes: the sheet, on which a linkage is built by hand, and the list of dimensions on it."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from math import ceil, dist, radians, tau
from typing import TYPE_CHECKING, Any, ClassVar

from linkanim.build import building as built
from linkanim.build import dimensions, gestures
from linkanim.build.building import Building, building_of, choosing, draft_of, knowing
from linkanim.build.draft import JOINT, Thing
from linkanim.build.meanings import Meaning, drag, meanings
from linkanim.build.numbers import chosen_row, renumbered, rows_of_all, thing_at
from linkanim.build.storing import restored, stored
from linkanim.build.tools import TOOLS, Tool
from linkanim.errors import BadInput
from linkanim.frozen import frozen
from linkanim.intake import Intake, Section, unnameable
from linkanim.mechanics.linkage import Point
from linkanim.picture.drawn import Addition
from linkanim.picture.figure import figure
from linkanim.picture.lists import EditRow, Panel
from linkanim.picture.look import Look
from linkanim.picture.quantities import chart_tokens
from linkanim.picture.text import subscripted_words
from linkanim.picture.view import Box
from linkanim.player import rules
from linkanim.player.action import Action, Value
from linkanim.player.browsing import NEW
from linkanim.player.clock import FRAMES_PER_SECOND
from linkanim.player.edits import (
    HINT,
    Dimensions,
    carry,
    closure,
    drop,
    exchanged,
    grab,
    in_marks,
    measured,
    nudged,
    panel_of,
    pass_on,
    reset,
    returns,
)
from linkanim.player.edits import put as put_on
from linkanim.player.keys import (
    BACK_BAR,
    HOME_BAR,
    LAST_BAR,
    LIST_KEYS,
    MOVING_BAR,
    TAKEN,
    BarEntry,
    KeyRow,
    ModeKeys,
    TypedKeys,
    aims,
    both,
    enter,
    on,
    tabs,
    undo_keys,
)
from linkanim.player.on_sheet import SheetDrawing, called, stated
from linkanim.player.sketching import REFUSED, leave_sketch
from linkanim.player.state import (
    BLANK,
    HOME,
    LIVE,
    STILL,
    BuildSheet,
    Editing,
    Grip,
    Mode,
    Resolver,
    Rule,
    State,
    cleared,
    driven_bar,
    nothing_begun,
    with_toast,
    with_undo,
)
from linkanim.scenes.editing import Dimension, in_unit, other_closure
from linkanim.scenes.editing import dimensions as dimensions_of
from linkanim.units import shown
from linkanim.words import said, to_say

if TYPE_CHECKING:
    from linkanim.player.hand import Gesture, Hand, Outside
    from linkanim.player.sight import Sight

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
_OFF_THE_SHEET = frozenset(
    {
        *("edit", "edit_at", "edit_row", "trace_joint", "drive_joint", "layers", "pencil", "own_trace"),
        *("poses", "mechanism", "select", "put", "closure", "closures", "choose_closure", "reset", "returns"),
        "stage",
    }
)
"""Actions for which the sheet is left first."""
_IN_THE_LIST = frozenset({"closure", "reset", "returns"})
"""Those of these actions that stay on the sheet while the list of dimensions is open on it."""
LOST = to_say("the draft is not saved: Ctrl+S saves it; press again to begin anew")
_MEANT = to_say("the draft is not saved: Ctrl+S saves it; press again to close, and it is offered next time")


def build(state: State, _: None) -> State:
    """Open the sheet, as it was left if there is one; or leave it with what was built on it."""
    if state.building:
        return leave_sheet(state)
    return _opened(state, state.sheet.building if state.sheet else Building())


def build_on(state: State, _: None) -> State:
    """Open a sheet with the present scene; where a draft would be lost, only when asked once more.

    Its undo continues into earlier edits. Where the scene came from a sheet, that sheet is opened again.
    """
    sheet, editing = state.sheet, state.editing
    if state.building:
        return leave_sheet(state)
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
        return with_toast(state, said(BLANK))
    bare = replace(state.unlisted, editing=cleared(replace(state.editing, drafts=())), held=None)
    return bare.without(SheetNumbers) if state.edits_dimensions else bare.with_mode(SheetNumbers())


def new(state: State, _: None) -> State:
    """Open an empty sheet; where a draft would be lost, only when asked once more."""
    return _anew(state, Building)


def _anew(state: State, make: Callable[[], Building]) -> State:
    """Return the state with another sheet; where a draft is in no file, only when asked once more."""
    sheet = state.sheet
    if sheet and not (sheet.is_written or sheet.warned or _is_undone_to(state, sheet)):
        return with_toast(replace(state, sheet=replace(sheet, warned=True)), said(LOST))
    building = make()
    return _opened(replace(leave_sheet(state), sheet=None), building, known=True)


def _is_undone_to(state: State, sheet: BuildSheet) -> bool:
    """Return whether the linkage of a sheet is shown, or undo goes back to it."""
    made = sheet.building.made.scene
    return made is not None and any(one is made for one in (state.scene, *state.editing.past))


def _opened(state: State, building: Building, *, known: bool = False) -> State:
    """Return the state with a sheet open over its scene; `known` says that its draft is in a file."""
    state, last = leave_sketch(drop(state, None)), state.sheet
    editing = nothing_begun(state.editing)
    sheet = BuildSheet(state.scene, state.clock, editing, building, HOME, written=building.draft)
    sheet = replace(sheet, look=state.look)
    if last and not known:
        sheet = replace(sheet, written=last.written, saved=last.saved, tool=last.tool, home=last.home)
    elif building.draft.places:
        sheet = replace(sheet, home=figure(state.scene).box)
    look = replace(state.look, unit=None, zoom=1.0, pan=(0.0, 0.0), chart=None)
    bare = state.unlisted.without(Dimensions).with_mode(OpenSheet())
    bare = replace(bare, editing=Editing(), glide=None, toast=None, look=look)
    return _shown(replace(bare, sheet=sheet, faded=state.frame), building)


def leave_sheet(state: State) -> State:
    """Leave the sheet: a linkage that moves becomes the scene, which can be undone; the sheet is kept."""
    sheet = state.building
    if sheet is None:
        return state
    after = state.without(OpenSheet).without(SheetNumbers)
    after = replace(after, sheet=replace(sheet, grip=None, cursor=None, rests=None, warned=False))
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
    sheet = replace(restored_sheet(state, text, where), closes=True)
    bare, beneath = state.without(OpenSheet), state.beneath
    return replace(bare, sheet=sheet, beneath=beneath and replace(beneath, sheet=sheet))


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
    return with_toast(replace(state, sheet=replace(sheet, closes=True)), said(_MEANT))


def put(state: State, number: int) -> State:
    """Put on a mechanism of the shelf, or an empty sheet."""
    return new(state.unlisted, None) if number == NEW else put_on(state, number)


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
    after = exchanged(replace(drawn, glide=None), scene)
    clock = after.clock.go(state.frame, building.draft.phase, paused=True)
    stands = live or known or not any(joint.dyad or joint.grouped for joint in scene.linkage.joints)
    after = replace(after, clock=clock, sheet=replace(sheet_of(drawn), rests=None))
    return after if stands else _once(after)


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
    if state.clock.paused:
        return replace(state, sheet=replace(sheet, rests=None))
    if state.frame < sheet.rests:
        return state
    clock = state.clock.go(state.frame, sheet.building.draft.phase, paused=True)
    return replace(state, clock=clock, sheet=replace(sheet, rests=None))


def tool(state: State, name: str) -> State:
    """Take a tool; a linkage that runs goes back to its drawn pose, and rests there."""
    sheet = state.building
    if sheet and sheet.building.made.scene and not state.clock.paused:
        state = replace(state, clock=state.clock.go(state.frame, sheet.building.draft.phase, paused=True))
    return _with(state, tool=name, grip=None, anchor=None, span=None)


def tool_on(state: State, by: int) -> State:
    """Take the next tool of the bar; where the last drag has several meanings, carry out the next one."""
    sheet = state.building
    if sheet is None:
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
    sheet = state.building
    if sheet is None:
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
        said("Type the true distance between the two, then Enter")
        if second
        else said("Now click a point at a known distance")
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


def accept(state: State, _: None) -> State:
    """Take the typed value: for the distance of two points of a photograph, or for the chosen thing."""
    sheet = state.building
    if sheet and sheet.tool == "photo" and sheet.anchor and sheet.span and sheet.building.typed:
        return _scaled(state, sheet, complex(*sheet.anchor), complex(*sheet.span))
    return _accepted(state, None)


def offer(state: State, number: int) -> State:
    """Carry out another of the meanings of the last drag."""
    sheet = state.building
    if sheet is None or sheet.grip or sheet.meant is None:
        return state
    return _shown(state, sheet.offers[number % len(sheet.offers)].building)


def cursor(state: State, at: tuple[float, float]) -> State:
    """Move the keys' cursor to a point; a gesture begun by keys follows."""
    sheet = state.building
    if sheet is None:
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
        sheet = state.building
        if sheet is None or sheet.grip:
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
_accepted = _changed(dimensions.accept)
remove = _changed(gestures.delete)
trace = _changed(gestures.trace)


def drive(state: State, _: None) -> State:
    """Have the chosen thing driven; what else that can mean is offered beside it."""
    sheet = state.building
    if sheet is None or sheet.grip:
        return state
    draft, thing = sheet.seen(state.scene, state.phase), sheet.building.chosen
    ends = draft.ends(thing[1]) if thing and thing[0] == "bars" else [thing[1]] if thing else []
    places = [draft.places[end] for end in ends if end in draft.places] or [(0.0, 0.0)]
    middle = sum(x for x, _ in places) / len(places), sum(y for _, y in places) / len(places)
    return _driven(_with(state, clicked=None), sheet.building, middle)


def motor(state: State, at: tuple[float, float, float, float]) -> State:
    """Let a motor go at a point: it turns there, on a joint or a bar."""
    held = down(state, at)
    if held.building is None or held.building.grip is None:
        return state
    grip = held.building.grip
    dropped = gestures.motor(grip.base, *grip.at, reach=grip.reach)
    return _driven(_with(held, grip=None), dropped, grip.at, here=True)


def _driven(state: State, building: Building, at: Point, *, here: bool = False) -> State:
    """Return the state with a chosen thing driven, and the other ways of it offered at a place."""
    ways = () if building.is_refusal else tuple(gestures.drives(building, here=here))[:_OFFERED]
    offers = tuple(Meaning(*way) for way in ways)
    driven = _shown(state, offers[0].building if offers else building)
    return _with(driven, offers=offers if len(offers) > 1 else (), offered=at)


def reassemble(state: State, _: None) -> State:
    """Put the first loop together the other way."""
    sheet = state.building
    if sheet is None or sheet.grip:
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
    if is_old and after.scene is not before.scene and sheet.building.made.listed:
        grows = after.editing.past is not before.editing.past
        building = renumbered(sheet.building, after.scene, grows=grows)
        editing = replace(after.editing, past=before.editing.past, future=before.editing.future)
        after = replace(_with(after, building=building, rests=None, warned=False), editing=editing)
        return _chosen_by_row(after) if after.edits_dimensions else after
    if not after.edits_dimensions:
        return after
    if was is None or not before.edits_dimensions:
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
    thing, scene = sheet.building.chosen, sheet.building.made.listed
    if thing is None or scene is None:
        return state
    things = [thing_at(sheet.building.draft, scene, item.key) for item in dimensions_of(scene)]
    if thing not in things or things[state.editing.chosen % len(things)] == thing:
        return state
    return replace(state, editing=cleared(state.editing, chosen=things.index(thing)))


def _chosen_by_row(state: State) -> State:
    """Return the state with the thing of the list's chosen row chosen on the sheet."""
    sheet = sheet_of(state)
    scene, items = sheet.building.made.listed, dimensions_of(state.scene)
    if scene is None or not items:
        return state
    key = items[state.editing.chosen % len(items)].key
    building = choosing(sheet.building, thing_at(sheet.building.draft, scene, key))
    return _with(state, building=building, rowed=False)


def _in_rows(work: Callable[[State, BuildSheet, Any], State]) -> Handler:
    """Make a handler of a function for the list where its rows are the draft's own."""

    def handle(state: State, value: Any) -> State:
        sheet = state.building
        return state if sheet is None or sheet.grip else work(state, sheet, value)

    return handle


def _row_chosen(state: State, sheet: BuildSheet, row: int) -> State:
    rows = rows_of_all(sheet.building.draft)
    if not rows:
        return state
    thing, place, _ = rows[row % len(rows)]
    return _with(state, building=replace(choosing(sheet.building, thing), row=place))


def _row_further(state: State, sheet: BuildSheet, by: int) -> State:
    at = chosen_row(sheet.building)
    return _row_chosen(state, sheet, 0 if at is None else at + by)


def _row_nudged(state: State, sheet: BuildSheet, steps: int) -> State:
    at, rows = chosen_row(sheet.building), rows_of_all(sheet.building.draft)
    if at is None:
        return state
    _, place, row = rows[at]
    assert row.number
    typed = replace(sheet.building, row=place, typed=nudged(row.number, steps))
    return _shown(state, replace(dimensions.accept(typed), row=place))


def _unused(state: State, _: object) -> State:
    return state


def _passed_on(state: State, further: int) -> State:
    """Go on in the list; what is typed as a bar's length waits in its row there, another value is taken."""
    building = sheet_of(state).building
    if building.typed and (building.row or (building.chosen or ("",))[0] != "bars"):
        state, building = (taken := _accepted(state, None)), sheet_of(taken).building
        if building.is_refusal:
            return state
    bare = _with(state, building=choosing(replace(building, typed=""), None), rowed=False)
    return pass_on(replace(bare, editing=replace(bare.editing, typed=building.typed)), further)


_OWN_ROWS: Mapping[str, Handler] = {"type": write, "erase": erase, "accept": _accepted, "pass_on": _passed_on}
_DRAFT_ROWS: Mapping[str, Handler] = {
    "choose": _in_rows(_row_further),
    "pass_on": _in_rows(_row_further),
    "grab_row": _in_rows(_row_chosen),
    "nudge": _in_rows(_row_nudged),
    **{name: _OWN_ROWS[name] for name in ("type", "erase", "accept")},
    **dict.fromkeys(("pull", "reset", "returns", "grab", "carry"), _unused),
    "closure": reassemble,
}
"""Handlers for the list of dimensions on a sheet where its rows are the draft's own."""


def let_go(state: State) -> State | None:
    """Return the state without a gesture, typed text, a choice, or a special tool; None where there is none.

    With the list of dimensions open, only what was typed in it is discarded.
    """
    sheet = state.sheet
    assert sheet
    if sheet.grip:
        return off(state, None)
    if state.edits_dimensions:
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
    sheet, building = state.building, changes.get("building")
    if sheet is None:
        return state
    if building and building.draft is sheet.building.draft:
        knowing(building, sheet.building.made)
    return replace(state, sheet=replace(sheet, **changes))


# Which things are under the hand, and what the keys and the mouse do there.


def thing_under(screen: Sight, x: float, y: float) -> Thing | None:
    """Return the thing of the draft under a pixel: as it is drawn, or as it is shown while it moves."""
    sheet, state = screen.state.building, screen.state
    assert sheet
    place = screen.world(x, y)
    if not state.clock.paused and (thing := gestures.under(sheet.building.draft, *place, screen.near)):
        return thing
    return gestures.under(sheet.seen(state.scene, state.phase), *place, screen.near)


def _begun_at(screen: Sight, x: float, y: float) -> str:
    """Return what the hand does at a pixel: it draws ("hand"), turns the "crank", or shifts the "paper"."""
    sheet = screen.state.building
    assert sheet
    near = thing_under(screen, x, y)
    if sheet.tool == "photo":
        return "hand"
    if near is None:
        return "paper" if sheet.tool in ("bar", "move") else "hand"
    moves = sheet.building.made.scene is not None and sheet.tool in ("bar", "move")
    return "crank" if moves and near == driven_bar(sheet.building.draft) else "hand"


def _aim(window: Outside, way: Value) -> Iterator[Action]:
    """Yield what an arrow means: the cursor moves."""
    sheet = window.state.building
    if sheet and window.screen.state.building and isinstance(way, tuple):
        yield Action("cursor", window.screen.aimed(sheet.cursor, way))


def _enter(window: Outside, twice: Value) -> Iterator[Action]:
    """Yield what Enter means: a number is taken, or the hand goes down or up at the cursor."""
    sheet, screen = window.state.building, window.screen
    if sheet is None or screen.state.building is None:
        return
    if sheet.building.typed:
        yield Action("accept_number")
    elif sheet.grip:
        yield Action("hand_up")
    elif sheet.cursor:
        x, y = screen.pixel(*sheet.cursor)
        on_grid = thing_under(screen, x, y) is None
        click = Action("hand_down", screen.handed(x, y, 1.0, on_grid=on_grid)), Action("hand_up")
        on_paper = _begun_at(screen, x, y) == "paper"
        yield from 2 * click if twice else click if on_paper else click[:1]


def _handed(name: str, mouse: Hand, screen: Sight) -> Action:
    """Return the hand's action at the mouse; off all things its place is moved to a near line of the grid."""
    return mouse.handed(name, screen, on_grid=thing_under(screen, *mouse.at) is None)


def _row_asks(screen: Sight, x: float, y: float) -> Action | None:
    """Return the action of a click on a list of the sheet: another meaning or number; None off it."""
    for kind in ("offers", "numbers"):
        target = screen.target_at(kind, x, y)
        if target is None:
            continue
        row, rows = target.value
        if row == rows.chosen and row in rows.options:
            return Action("option_on")
        if kind == "numbers":
            return Action("number", max(row, 0) - rows.chosen if row >= 0 else 0)
        return Action("offer", row if row >= 0 else rows.chosen)
    return None


def _motor(gesture: Gesture, mouse: Hand, screen: Sight) -> tuple[Action, ...]:
    """Return the actions of a motor that is dragged from its tool: on the tool, it is the chosen thing's."""
    if gesture.kind != "up":
        return ()
    mouse.drag = None
    if screen.target_at("tool", *mouse.at):
        return (Action("drive_by"),)
    return (_handed("motor", mouse, screen),)


def _of_tool(tool: Tool) -> KeyRow:
    """Return the line of a tool; a tool on a digit also has Ctrl with it, for where digits are typed."""
    key = tool.key.lower()
    keys = f"{key} kp{key} ctrl+{key} ctrl+kp{key}" if key.isdigit() else key
    return KeyRow(tool.key, tool.name, on(keys, tool.action, tool.value))


_SHEET_KEYS = (
    KeyRow("Ctrl+← →", "choose", both("ctrl+left", "ctrl+right", "further")),
    KeyRow("Del", "remove it and what depends on it", on("delete", "remove")),
    KeyRow("Ctrl+Z, Ctrl+Y", "undo, redo", undo_keys("undo_sheet", "redo_sheet")),
    KeyRow("E", "the list of all dimensions; E again: without it", on("e", "numbers")),
    KeyRow("Ctrl+N", "an empty sheet", on("ctrl+n", "sheet")),
    KeyRow("F2", "done: leave the sheet and keep the linkage; F2 returns to it", on("f2", "build")),
    KeyRow("Esc", "let go; leave the sheet", on("escape", "back")),
)
"""The meaning of keys on a sheet, with or without the list of dimensions."""


def _in_list(name: str, usual: Handler | None) -> Handler:
    """Return the handler of an action in the list on a sheet, which may be for the sheet's own rows."""

    def handle(state: State, value: Any) -> State:
        sheet = state.building
        own = _DRAFT_ROWS if sheet and sheet.building.made.listed is None else {}
        own = own or (_OWN_ROWS if sheet and sheet.rowed else {})
        work = own.get(name, usual)
        return work(state, value) if work else state

    return handle


_LIST_ACTIONS: Mapping[str, tuple[Callable[[object], bool], Handler]] = {
    **{name: Dimensions.actions[name][:2] for name in ("type", "erase", "accept", "choose", "pass_on")},
    **{name: Dimensions.actions[name][:2] for name in ("grab_row", "nudge", "pull")},
    **{"reset": (rules.nothing, reset), "returns": (rules.nothing, returns)},
    **{"grab": (rules.text, grab), "carry": (rules.numbers(3), carry), "closure": (rules.nothing, closure)},
}
"""Actions that may be for the sheet's own rows while the list is open: their tests and usual handlers."""


def _panel_of_draft(building: Building) -> Panel:
    """Return the list of all numbers of a draft, as of one that does not move."""
    draft, at = building.draft, chosen_row(building)
    rows = (
        EditRow(
            subscripted_words(
                said("{part}, {property}", part=called(draft, thing), property=said(row.label))
            ),
            stated(row, building, n == at),
            chosen=n == at,
            draft=n == at and building.typed != "",
        )
        for n, (thing, _, row) in enumerate(rows_of_all(draft))
    )
    error = building.sentence if building.is_refusal else None
    return Panel(tuple(rows), facts=(), error=error, hint=HINT)


def _has_row(state: State, items: tuple[Dimension, ...]) -> bool:
    """Return whether the thing chosen on the sheet, if any, is that of the list's chosen row."""
    sheet = sheet_of(state)
    if not sheet.rowed:
        return True
    at = state.editing.chosen % max(len(items), 1)
    things = (thing_at(sheet.building.draft, state.scene, item.key) for item in items[at : at + 1])
    return sheet.building.chosen in things


@frozen
class OpenSheet(Mode):
    """The open sheet, on which a linkage is built: the state's `sheet`."""

    keys = ModeKeys(
        "build",
        {
            "in F2": (
                KeyRow(
                    "click, drag",
                    "set a ground pin; draw a bar from a pin or joint; double-click a bar: a point of it",
                ),
                KeyRow("let go on a joint, line, bar", "join the bar there; make a slider; make a slot"),
                KeyRow("drag the drive's tool", "a motor on the joint, or the bar, where it is let go"),
                KeyRow("drag the crank", "turn it; Shift: tenths, Alt: free of the grid, while drawing"),
                *map(_of_tool, TAKEN),
                KeyRow(
                    "digits, Enter",
                    "type the value of what is chosen, if anything is; Ctrl+↑ ↓: its other rows, "
                    "name and colour too",
                    both("ctrl+up", "ctrl+down", "number") + on("backspace", "erase_number", held=True),
                ),
                KeyRow(
                    "arrows (Shift: fine), Enter",
                    "move a cursor; press and release there",
                    aims() + enter("enter"),
                ),
                KeyRow(
                    "Shift+Enter",
                    "a point of the body at the cursor",
                    on("shift+return shift+kp_enter insert", "enter", 2),
                ),
                KeyRow("Tab, Shift+Tab", "the next tool; what else a drag can mean", tabs("tool_on")),
                KeyRow("B", "the other closure", on("b", "reassemble")),
                *_SHEET_KEYS,
            ),
        },
        TypedKeys("digits", begins="123456789.-"),
        names={Action("build"): "done: leave the sheet and keep the linkage"},
    )
    bar = (
        BACK_BAR,
        HOME_BAR,
        *MOVING_BAR,
        BarEntry("edit", Action("numbers"), 7, leads=True),
        BarEntry("undo", Action("undo_sheet"), 5, leads=True),
        BarEntry("redo", Action("redo_sheet"), 9),
        BarEntry("new", Action("sheet"), 6, leads=True),
        BarEntry("save", Action("save"), 4),
        BarEntry("done", Action("build"), 3),
        *LAST_BAR,
    )
    actions: ClassVar[Mapping[str, Rule]] = {
        "build": Rule(rules.nothing, build),
        "build_on": Rule(rules.nothing, build_on),
        "sheet": Rule(rules.nothing, new),
        "draft": Rule(rules.text, draft),  # a draft as it is stored
        "numbers": Rule(rules.nothing, numbers),
        "tool": Rule(rules.text, tool),
        "tool_on": Rule(rules.whole, tool_on),  # tools further
        "photo": Rule(rules.text, photo),  # a picture's file, "" for none
        "hand_down": Rule(rules.hand, down),  # (x, y), how near counts as on it, the step of what is drawn
        "hand_to": Rule(rules.hand, along),
        "hand_up": Rule(rules.nothing, up),
        "cursor": Rule(rules.place_of_sheet, cursor),  # (x, y) of the sheet
        "further": Rule(rules.whole, further),
        "offer": Rule(rules.whole, offer),  # the place of what the last drag can mean
        "number": Rule(rules.whole, number),
        "option_on": Rule(rules.nothing, option),  # another of what the chosen row can be
        "digits": Rule(rules.text, write),
        "erase_number": Rule(rules.nothing, erase),
        "accept_number": Rule(rules.nothing, accept),
        "reassemble": Rule(
            rules.nothing, reassemble, answer=rules.closure
        ),  # as "closure", and the sheet stays
        "remove": Rule(rules.nothing, remove),
        "trace_on": Rule(rules.nothing, trace),
        "drive_by": Rule(rules.nothing, drive),
        "motor": Rule(rules.hand, motor),  # (x, y), how near counts as on it, the step of what is drawn
        "undo_sheet": Rule(rules.nothing, undo, answer=rules.stuck(to_say("nothing to undo"))),
        "redo_sheet": Rule(rules.nothing, redo, answer=rules.stuck(to_say("nothing to redo"))),
    }
    meanings: ClassVar[Mapping[str, Resolver]] = {"aim": _aim, "enter": _enter}
    has_head, has_tools, is_sheet, is_paper = True, True, True, True

    def typing(self, state: State) -> bool:
        """Return whether a value or a name is being typed."""
        building = sheet_of(state).building
        return bool(building.typed or building.lettered)

    def look(self, look: Look) -> Look:
        """Return the look, without numbers."""
        return replace(look, hud=False)

    def forbids(self, state: State, action: Action) -> str | None:
        """Refuse edits of the scene, another unit, and quantities of what does not move."""
        if action.name in REFUSED:
            return ""
        return (sheet_of(state).building.made.missing or None) if action.name == "list" else None

    def ready_for(self, state: State, action: Action) -> State:
        """Leave the sheet for an action on the scene."""
        stays = state.edits_dimensions and action.name in _IN_THE_LIST
        return leave_sheet(state) if action.name in _OFF_THE_SHEET and not stays else state

    def agreed(self, before: State, after: State) -> State:
        """Return the state with the sheet and the open list of dimensions in agreement."""
        return agreed(before, after)

    def aged(self, state: State) -> State:
        """Let the linkage rest once it has run for a period."""
        return rested(state)

    def closed(self, state: State) -> State:
        """Let go of a gesture, typed text, a choice, or a tool; else leave the sheet."""
        return let_go(state) or leave_sheet(state)

    def drawn(self, state: State) -> tuple[Addition, ...]:
        """Return the draft, or what the linkage does not show, words, and what is under the hand."""
        sheet, rests, is_listed = sheet_of(state), state.clock.paused, state.edits_dimensions
        return (SheetDrawing(sheet, state.scene, state.phase, is_listed=is_listed, rests=rests),)

    def tools(self, state: State) -> tuple[int, bool]:
        """Return the tool in hand; beside the list digits are values."""
        tool = next((n for n, one in enumerate(TOOLS) if one.value == sheet_of(state).tool), 0)
        return tool, state.edits_dimensions

    def menu(self, mouse: Hand, screen: Sight) -> tuple[Action, ...]:
        """Choose what a right click is on, and list its commands; else list all."""
        chosen = sheet_of(screen.state).tool in ("bar", "move") and thing_under(screen, *mouse.at)
        click = (_handed("hand_down", mouse, screen), Action("hand_up"), Action("menu", "chosen"))
        return click if chosen else (Action("menu"),)

    def mouse(self, gesture: Gesture, mouse: Hand, screen: Sight) -> tuple[Action, ...] | None:
        """Draw, take a tool, turn the crank, or shift the paper; None where the mouse acts as usual."""
        if gesture.kind == "down" and screen.charted(*mouse.at) is None:
            tool, row = screen.number_at("tool", *mouse.at), _row_asks(screen, *mouse.at)
            if row is not None:
                mouse.drag = None
                return (row,)
            if tool is not None and TOOLS[tool].action == "drive_by":
                mouse.drag = "motor"
                return ()
            if tool is not None:
                mouse.drag = None
                return (Action(TOOLS[tool].action, TOOLS[tool].value),)
            begun = _begun_at(screen, *mouse.at)
            mouse.turns = begun == "crank"
            mouse.drag = "paper" if begun == "paper" else "hand"
            return (_handed("hand_down", mouse, screen),) if mouse.drag == "hand" else ()
        if mouse.drag == "motor":
            return _motor(gesture, mouse, screen)
        if mouse.drag not in ("hand", "paper") or gesture.kind not in ("move", "up"):
            return None
        drag, stays = mouse.drag, mouse.far <= STILL * screen.size[1]
        if gesture.kind == "move":
            if mouse.turns and not stays:  # no click, which would choose the crank
                mouse.drag = "crank"
                return (Action("back"), *mouse.moved(screen))
            if drag == "hand":
                return () if mouse.turns else (_handed("hand_to", mouse, screen),)
            return () if stays else (Action("pan", gesture.by),)
        mouse.drag = None
        if drag == "hand":
            return (Action("hand_up"),)
        return (_handed("hand_down", mouse, screen), Action("hand_up")) if stays else ()


@frozen
class SheetNumbers(Dimensions):
    """The open list of dimensions on a sheet: of the linkage, or of a draft that does not move."""

    keys = ModeKeys(
        "numbers",
        {
            "in E": LIST_KEYS,
            "in E, F2": (
                KeyRow("click, drag", "what they do on the sheet; beside it, what they do in the list"),
                KeyRow(
                    "Ctrl+↑ ↓",
                    "a row of what is chosen, to be typed: name and colour too",
                    both("ctrl+up", "ctrl+down", "number"),
                ),
                *_SHEET_KEYS,
            ),
        },
        TypedKeys("type", frozenset({"space", "h", "e"})),
    )
    bar = OpenSheet.bar
    actions: ClassVar[Mapping[str, Rule]] = {
        **Dimensions.actions,
        **{name: Rule(check, _in_list(name, usual)) for name, (check, usual) in _LIST_ACTIONS.items()},
    }
    meanings: ClassVar[Mapping[str, Resolver]] = {}

    def typing(self, state: State) -> bool:
        """Return whether a value is being typed, in the list or for the chosen thing."""
        return bool(state.editing.typed or sheet_of(state).building.typed)

    def closed(self, state: State) -> State:
        """Discard what is typed; else leave list and sheet, which are one mode."""
        return let_go(state) or leave_sheet(state)

    def panel(self, state: State) -> Panel:
        """Return the list of the linkage, or of the draft where nothing moves."""
        sheet = sheet_of(state)
        if sheet.building.made.listed is None:
            return _panel_of_draft(sheet.building)
        items = dimensions_of(in_unit(state.scene, state.look.unit))
        return panel_of(state, items, lit=_has_row(state, items))

    def tools(self, state: State) -> tuple[int, bool]:
        """Return the tool in hand on the sheet."""
        return OpenSheet().tools(state)

    def drawn(self, state: State) -> tuple[Addition, ...]:
        """Return the chosen dimension's lines."""
        sheet = sheet_of(state)
        if sheet.building.made.listed is None or sheet.rowed:
            return ()
        return in_marks(measured(state, dimensions_of(in_unit(state.scene, state.look.unit))))

    def menu(self, mouse: Hand, screen: Sight) -> tuple[Action, ...]:
        """Choose what a right click is on, and list its commands; else list all."""
        return OpenSheet().menu(mouse, screen)

    def mouse(self, gesture: Gesture, mouse: Hand, screen: Sight) -> tuple[Action, ...] | None:
        """Act on the list where the mouse is on it, else on the sheet."""
        actions = self.on_list(gesture, mouse, screen) if mouse.drag in (None, "row") else None
        return OpenSheet().mouse(gesture, mouse, screen) if actions is None else actions
