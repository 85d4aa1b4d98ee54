"""Actions that show another scene; and a mode: the list of dimensions, with undo and redo."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from decimal import Decimal
from typing import TYPE_CHECKING, ClassVar

from linkanim.build.building import Step
from linkanim.build.tools import TOOLS
from linkanim.errors import LinkanimError
from linkanim.frozen import frozen
from linkanim.mechanics.analysis import Info
from linkanim.picture.drawn import Addition
from linkanim.picture.lists import EditRow, Panel
from linkanim.picture.marks import DimensionLine, MeasuredLines
from linkanim.picture.quantities import MOST_CHARTS, chart_tokens
from linkanim.picture.text import subscripted_words
from linkanim.player import rules
from linkanim.player.action import Action, Value
from linkanim.player.commands import BUILD_ON_BAR, LISTED_BAR
from linkanim.player.keys import LIST_KEYS, KeyRow, ModeKeys, TypedKeys, on
from linkanim.player.state import (
    FLASH_FRAMES,
    Edited,
    Editing,
    Glide,
    Grasp,
    Held,
    Mode,
    Resolver,
    Rule,
    Sketch,
    State,
    check_of_turning,
    chosen,
    cleared,
    fresh,
    glide,
    loss_of_turning,
    nothing_begun,
    proved,
    still_typed,
    with_toast,
    with_undo,
)
from linkanim.scenes import chapter_of, chapters, load
from linkanim.scenes.editing import (
    Dimension,
    dimensions,
    driven_at,
    drives,
    handles,
    in_unit,
    other_closure,
    other_return,
    stretches,
    traced,
    with_dimensions,
    with_document,
    with_unit,
    with_values,
)
from linkanim.scenes.form import Key
from linkanim.scenes.scene import Scene
from linkanim.units import metre, significant, typeset
from linkanim.words import said, to_say

if TYPE_CHECKING:
    from linkanim.player.hand import Gesture, Hand, Outside
    from linkanim.player.sight import Sight

# Actions that show another scene: from the shelf, or the other closure; the open list of quantities.

_LONGEST = 40


def mechanism(state: State, further: int) -> State:
    """Show the scene that is `further` places along the shelf."""
    return put_on(state, (state.place + further) % len(state.shelf))


def select(state: State, number: int) -> State:
    """Choose a place in the chapter of the present scene; outside the catalogue, in the first chapter."""
    all_, chapter = chapters(), chapter_of(state.scene.name)
    members = all_[chapter] if chapter else next(iter(all_.values()))
    if number >= len(members) or members[number] not in state.shelf:
        return state
    return put_on(state, state.shelf.index(members[number]))


def closure(state: State, _: None) -> State:
    """Exchange the scene for its other closure; undo goes back."""
    try:
        scene = other_closure(state.scene)
    except LinkanimError as error:
        return with_toast(state, str(error))
    return followed(replace(state, editing=with_undo(state.editing, state.scene)), scene)


def renewed(state: State, scene: Scene) -> State:
    """Show the user's own scene as its file has it now; where it is shown already, undo goes back."""
    catalogue = tuple(entry for entry in state.shelf if isinstance(entry, str))
    own = len(state.shelf) - len(catalogue)
    was_on, by = state.place < own, 1 - own
    state = replace(state, shelf=(scene, *catalogue))
    if not was_on:
        # the catalogue's places come after that of the user's own scene, which begins anew
        kept = tuple(one._replace(place=one.place + by) for one in state.kept if one.place >= own)
        return put_on(replace(state, place=state.place + by, kept=kept), 0)
    editing = replace(with_undo(state.editing, state.scene), original=scene)
    return exchanged(replace(state.without(Sketch), held=None, glide=None, editing=editing), scene)


def exchanged(state: State, scene: Scene) -> State:
    """Show a changed scene at the phase of the old one; raises whatever its solver raises."""
    clock = state.clock.at_rate(state.frame, scene.linkage.drive.speed)
    proved(scene, replace(state, clock=clock).phase)
    look = replace(state.look, chart=_kept_chart(state, scene))
    turned = state.turned if _verdict(scene.info) == _verdict(state.scene.info) else state.frame
    editing = still_typed(state.editing, state.scene, scene)
    return replace(state, scene=scene, clock=clock, look=look, turned=turned, editing=editing)


def followed(state: State, scene: Scene) -> State:
    """Let the shown scene glide to a changed one, or swing over to its other closure."""
    placed = state.glide.placed if isinstance(state.glide, Glide) else state.scene
    way = None if state.reduced_motion else glide(state.shown, scene, state.frame, state.phase, placed)
    return replace(exchanged(state, scene), glide=way)


def _verdict(info: Info) -> tuple[str, bool, bool]:
    """Return the class, and whether s + l is below p + q, and above it: both False without Grashof's rule."""
    rule = info.grashof or ""
    return info.class_name, "<" in rule, ">" in rule


def put_on(state: State, number: int) -> State:
    """Start a mechanism of the shelf as it was left, else as in its file; paused if the last one was."""
    state = drop(state, None)
    entry, kept = state.shelf[number], _kept_edits(state)
    was = next((one for one in kept if one.place == number), None)
    scene = proved(was.scene if was else load(entry) if isinstance(entry, str) else entry, 0.0)
    clock = fresh(scene).go(state.frame, 0.0, paused=state.clock.paused)
    look = replace(state.look, zoom=1.0, pan=(0.0, 0.0), chart=_kept_chart(state, scene))
    bare = replace(state.unlisted.without(Sketch), held=None, glide=None, turned=None, faded=state.frame)
    bare = replace(bare, arrived=state.frame)
    editing = was.editing if was else Editing()
    others = tuple(one for one in kept if one is not was)
    return replace(bare, editing=editing, kept=others, scene=scene, place=number, clock=clock, look=look)


def put_scene(state: State, scene: Scene, number: int, phase: float) -> State:
    """Put a scene on as it is, at a place of the shelf whose edits are dropped; its clock is the caller's."""
    state = drop(state, None)
    others = tuple(one for one in _kept_edits(state) if one.place != number)
    bare = replace(state.unlisted.without(Sketch), held=None, glide=None, turned=None, faded=state.frame)
    bare = replace(bare, arrived=state.frame, editing=Editing(), kept=others)
    return replace(bare, scene=proved(scene, phase), place=number)


def _kept_edits(state: State) -> tuple[Edited, ...]:
    """Return the edited scenes of all places; the present one's bare, and without its typed values."""
    own = replace(state.editing, typed="", drafts=(), refusal=None, warned=False)
    if not own.changed:
        return state.kept
    past, future = (tuple(scene.bare for scene in scenes) for scenes in (own.past, own.future))
    own = replace(own, past=past, future=future, original=own.original and own.original.bare)
    return (*state.kept, Edited(state.place, state.scene.bare, own))


def _kept_chart(state: State, scene: Scene) -> str | None:
    """Return those of the charts that another scene has, too."""
    tokens = chart_tokens(state.scene, state.look.chart)
    return ",".join(token for token in tokens if token in scene.quantities) or None


def plot(state: State, token: str) -> State:
    """Chart a quantity, none for "", and close the list."""
    if not token:
        return replace(state.unlisted, look=replace(state.look, chart=None))
    if token not in state.scene.quantities:
        return with_toast(
            state, said("{scene} has no quantity {quantity}", scene=state.scene.name, quantity=token)
        )
    return replace(state.unlisted, look=replace(state.look, chart=token))


def strip(state: State, token: str) -> State:
    """Chart a quantity below the present charts; remove it where it is charted already."""
    charted = chart_tokens(state.scene, state.look.chart)
    if token in charted:
        charted = tuple(one for one in charted if one != token)
    elif token not in state.scene.quantities:
        return with_toast(
            state, said("{scene} has no quantity {quantity}", scene=state.scene.name, quantity=token)
        )
    elif len(charted) >= MOST_CHARTS:
        return with_toast(
            state,
            said("there is room for {count} charts; a click on a title puts one away", count=MOST_CHARTS),
        )
    else:
        charted = (*charted, token)
    return replace(state, look=replace(state.look, chart=",".join(charted) or None))


def put(state: State, number: int) -> State:
    """Show a scene by its place on the shelf, and close the shelf."""
    if not 0 <= number < len(state.shelf):
        return state
    return put_on(state, number)


# Actions on the list of dimensions, and undo and redo.
#
# Every change gives a new scene or a refusal; the last good scene always runs on. A joint that is dragged
# while the list is open changes its lengths; each drag is one step of undo.

AGAIN = to_say("R again: the file's dimensions")

_KEY = r"^[\w.\[\]-]+( =|:) "
_NUDGE = {
    "mm": "1", "cm": "0.1", "m": "0.001", "in": "0.1",
    "deg": "1", "°": "1", "rad": "0.01",
    "rpm": "1", "deg/s": "5", "°/s": "5", "rad/s": "0.1",
}  # fmt: skip


def edit(state: State, _: None) -> State:
    """Open or close the list; a joint is dropped, typed values are discarded, undo and redo stay."""
    state = drop(state, None)
    state = choose(replace(state, editing=replace(state.editing, drafts=())), 0).unlisted
    return state.without(Dimensions) if state.edits_dimensions else state.with_mode(Dimensions())


def choose(state: State, further: int) -> State:
    """Choose the row `further` places on; a typed value is discarded."""
    count = len(dimensions(state.scene))
    at = (state.editing.chosen + further) % count if count else 0
    return replace(state, editing=cleared(state.editing, chosen=at))


def pass_on(state: State, further: int) -> State:
    """Choose the row `further` places on; a typed value is kept, to be checked with the others."""
    return choose(replace(state, editing=replace(state.editing, drafts=_drafts(state))), further)


def write(state: State, text: str) -> State:
    """Add text to the value being typed."""
    return replace(state, editing=cleared(state.editing, typed=(state.editing.typed + text)[:_LONGEST]))


def erase(state: State, _: None) -> State:
    """Erase the last typed character; where none is typed, that of the row's draft."""
    editing, item = state.editing, chosen(state.editing, state.scene)
    draft = dict(editing.drafts).get(item.key, "") if item else ""
    others = tuple(pair for pair in editing.drafts if not item or pair[0] != item.key)
    return replace(state, editing=cleared(editing, typed=(editing.typed or draft)[:-1], drafts=others))


def accept(state: State, _: None) -> State:
    """Take all typed values at once, or say why not.

    Lengths without a unit are in the shown unit, or in the scene's own where none is shown.
    """
    values = dict(_drafts(state))
    return _tried(state, values, state.editing.typed) if values else state


def nudge(state: State, steps: int) -> State:
    """Make the chosen value larger by small steps, or say why not.

    A step depends on the shown unit alone, so that as many steps back end at the same value.
    """
    item = chosen(state.editing, in_unit(state.scene, state.look.unit))
    if item is None:
        return state
    text = nudged(item, steps)
    return _tried(replace(state, editing=cleared(state.editing)), {item.key: text}, text)


def undo(state: State, _: None) -> State:
    """Go back to the scene before the last change; a typed or refused value is discarded first."""
    editing = state.editing
    if editing.begun:
        return replace(state, editing=nothing_begun(editing))
    return _stepped(state, editing.back(state.scene))


def redo(state: State, _: None) -> State:
    """Go forward to the scene that the last undo left."""
    return _stepped(state, state.editing.onward(state.scene))


def _stepped(state: State, step: Step[Scene] | None) -> State:
    """Return the state at a step of undo or redo; unchanged where there is none."""
    if step is None:
        return state
    scene, past, future = step
    return _remade(state, cleared(state.editing, past=past, future=future), scene)


def reset(state: State, _: None) -> State:
    """Go back to the scene as in its file; this can be undone."""
    editing = replace(state.editing, drafts=())
    if editing.original is None or editing.original == state.scene:
        return replace(state, editing=cleared(editing))
    return _remade(state, with_undo(editing, state.scene), editing.original)


def edit_at(state: State, joint: str) -> State:
    """Open the list at the first dimension that follows a joint; say so where none does."""
    own = handles(state.scene, joint) if joint in state.scene.linkage.by_name else ()
    if not own:
        return with_toast(state, said("no dimension of its own places joint {joint}", joint=joint))
    state = state if state.edits_dimensions else edit(state, None)
    keys = [item.key for item in dimensions(state.scene)]
    return choose(replace(state, editing=replace(state.editing, chosen=keys.index(own[0].key))), 0)


def edit_row(state: State, row: int) -> State:
    """Open the list of dimensions at a row."""
    state = state if state.edits_dimensions else edit(state, None)
    return choose(state, row - state.editing.chosen)


def trace_joint(state: State, joint: str) -> State:
    """Draw a joint's curve, or stop drawing it; undo goes back."""
    if joint not in state.scene.linkage.by_name:
        return state
    state = replace(state, look=replace(state.look, trace=True))
    return _remade(state, with_undo(state.editing, state.scene), traced(state.scene, joint))


def drive_joint(state: State, joint: str) -> State:
    """Let another crank be driven; undo goes back."""
    if joint not in drives(state.scene):
        return state
    return _remade(state, with_undo(state.editing, state.scene), driven_at(state.scene, joint))


def returns(state: State, _: None) -> State:
    """Let the input come back on its other closure, or again on the same one."""
    return _remade(state, with_undo(state.editing, state.scene), other_return(state.scene))


def start(state: State, _: None) -> State:
    """Go back to the start; when asked again while the chip says so, to the file's dimensions as well."""
    again = state.chip is not None and state.sketch is None and state.chip.text == said(AGAIN)
    state = replace(reset(state, None) if again else state, chip=None)
    return replace(state, clock=state.clock.go(state.frame, 0.0))


def way_back(_: State, after: State) -> str | None:
    """Say which key brings the file's dimensions back, where they were changed."""
    return said(AGAIN) if after.place in after.edited else None


def grab(state: State, joint: str) -> State:
    """Grasp a joint: it drags the input, or, while the list is open, the dimensions that place it.

    The picture stands still; the list goes to the joint's dimension.
    """
    if not state.edits_dimensions:
        return _grasped(state, joint)
    keys = [item.key for item in dimensions(state.scene)]
    own = handles(state.scene, joint) if joint in state.scene.linkage.by_name else ()
    if not state.edits_dimensions or not own:
        return state
    held = Held(joint, state.scene, state.phase, not state.clock.paused)
    state = drop(state, None)
    state = choose(replace(state, editing=replace(state.editing, chosen=keys.index(own[0].key))), 0)
    return replace(state, held=held, clock=state.clock.pause(state.frame, True), glide=None)


def carry(state: State, to: tuple[float, float, float]) -> State:
    """Drag the held joint to a point of the shown scene, its lengths in whole units times `to[2]`."""
    if state.grasp:
        return _led(state, state.grasp, to)
    held = state.held
    if held is None or not held.joint or not to[2] > 0.0:
        return state
    ratio = metre(state.displayed.length_unit) / metre(state.scene.length_unit)
    point, before = (to[0] * ratio, to[1] * ratio), state.scene
    state = _dragged(state, held, _values_at(held, point, to[2]))
    if state.scene is before:
        return state
    angle = held.scene.pose(held.phase, 0).coordinate
    phase = state.scene.mechanism.phase_of(angle, state.phase)
    return replace(state, clock=state.clock.go(state.frame, phase, paused=True))


def grab_row(state: State, row: int) -> State:
    """Grasp a row's value; a value typed in another row waits as a draft."""
    items, state = dimensions(state.scene), drop(state, None)
    if not state.edits_dimensions or not 0 <= row < len(items):
        return state
    further = row - state.editing.chosen % len(items)
    held = Held("", state.scene, state.phase, not state.clock.paused)
    return replace(pass_on(state, further) if further else state, held=held, glide=None)


def pull(state: State, steps: int) -> State:
    """Set the held value to what it was plus `steps` small steps of the shown unit."""
    held = state.held
    if held is None or held.joint:
        return state
    shown = in_unit(held.scene, state.look.unit)
    item = chosen(state.editing, shown)
    values = {item.key: nudged(item, steps)} if item else {}
    return _dragged(state, held, values if shown is held.scene else _united(shown, values))


def drop(state: State, _: None) -> State:
    """Release the joint; a motion that ran before runs on, at first with the hand's speed."""
    if grasp := state.grasp:
        clock = state.clock.let_go(state.frame, grasp.speed(state.frame), paused=not grasp.ran)
        return replace(state, grasp=None, clock=clock)
    if state.held is None:
        return state
    clock = state.clock.pause(state.frame, not state.held.ran)
    return replace(state, held=None, clock=clock, editing=replace(state.editing, refusal=None))


_TOLERANCE = 0.01
"""A pose farther from the hand than the nearest one by up to this, in sizes of the course, is as good."""


def _grasped(state: State, joint: str) -> State:
    """Grasp a joint that moves, and stop the motion."""
    state = drop(state, None)
    if joint not in state.scene.linkage.by_name or not state.scene.point_path(joint).moves:
        return state
    phase, clock = state.phase, state.clock
    grasp = Grasp(joint, not clock.paused, ((state.frame, phase),), clock.speed > 0.0)
    return replace(state, grasp=grasp, clock=clock.go(state.frame, phase, paused=True), glide=None)


def _led(state: State, grasp: Grasp, to: tuple[float, float, float]) -> State:
    """Bring the joint as near to the hand as the input allows, in a pose next to the present one."""
    scene = state.displayed
    if grasp.joint not in scene.linkage.by_name:
        return replace(state, grasp=None)
    course, at = scene.point_path(grasp.joint), state.phase
    phase = course.nearest(
        (to[0], to[1]), at, tolerance=_TOLERANCE * max(to[2], 0.0) * course.size, forward=grasp.forward
    )
    clock = state.clock.go(state.frame, phase, paused=True)
    return replace(state, clock=clock, grasp=grasp.led(state.frame, phase))


def _dragged(state: State, held: Held, values: Mapping[Key, str]) -> State:
    """Return the state with these values in the scene from before the drag, or why they are refused.

    However far they are dragged, undo goes back to the beginning of the drag.
    """
    editing = state.editing
    try:
        document = with_values(held.scene, values)
        if document == state.scene.document:
            return replace(state, editing=cleared(editing))
        if editing.refusal and document == editing.refused:
            return state
        after = with_document(held.scene, document, check_of_turning(held.scene.info))
        refusal = loss_of_turning(held.scene.info, after.info)
    except LinkanimError as error:
        refusal = str(error).removeprefix(f"{state.scene.name}: ")
    if refusal:
        return replace(state, editing=replace(editing, refusal=refusal, refused=document))
    if state.scene is held.scene:
        editing = with_undo(editing, held.scene)
    return replace(exchanged(state, after), editing=cleared(editing))


def _values_at(held: Held, point: tuple[float, float], share: float) -> dict[Key, str]:
    """Return the dimensions that put the joint near a point, in whole steps of their units times `share`."""
    places = held.scene.pose(held.phase, 0).position
    values = {}
    for handle, unit in held.following:
        step = _step_of(unit) * Decimal(repr(share))
        value = step * round(Decimal(repr(handle.value(places, point))) / step)
        values[handle.key] = f"{value.normalize():f}"
    return values


def nudged(item: Dimension, steps: int) -> str:
    """Return a dimension's value increased by small steps, as it would be typed."""
    value = Decimal(repr(item.value)) + steps * _step_of(item.unit)
    return f"{value.normalize():f}"


def _step_of(unit: str) -> Decimal:
    """Return the step in which a dimension of that unit is nudged."""
    return Decimal(_NUDGE.get(unit, "1"))


def _remade(state: State, editing: Editing, scene: Scene) -> State:
    """Return the state with another editing and another scene, to which the picture glides."""
    if scene is state.scene:
        return replace(state, editing=editing)
    return replace(followed(state, scene), editing=still_typed(editing, state.scene, scene))


def _drafts(state: State) -> tuple[tuple[Key, str], ...]:
    """Return all typed values, that of the chosen row last."""
    editing, item = state.editing, chosen(state.editing, state.scene)
    if item is None or not editing.typed:
        return editing.drafts
    return (*(pair for pair in editing.drafts if pair[0] != item.key), (item.key, editing.typed))


def _tried(state: State, values: Mapping[Key, str], typed: str) -> State:
    """Take values, all at once; refused ones stay typed, to be corrected.

    Values that end the crank's full turn are refused the first time, with words on how to take them anyway.
    The reason is in the shown unit.
    """
    editing, scene, unit = state.editing, state.scene, state.look.unit
    try:
        before, shown = in_unit(scene, unit), with_dimensions(in_unit(scene, unit), values)
        loss = None if editing.warned else loss_of_turning(before.info, shown.info)
        after = shown if before is scene else with_dimensions(scene, _united(before, values))
    except LinkanimError as error:
        reason = _reason(str(error).removeprefix(f"{scene.name}: "), values, scene)
        return replace(state, editing=replace(editing, typed=typed, refusal=reason, warned=False))
    if loss:
        refusal = said("{loss} (Enter again takes it)", loss=loss)
        return replace(state, editing=replace(editing, typed=typed, refusal=refusal, warned=True))
    drafts = tuple(pair for pair in editing.drafts if pair[0] not in values)
    return _remade(state, with_undo(replace(editing, drafts=drafts), scene), after)


def _united(shown: Scene, values: Mapping[Key, str]) -> dict[Key, str]:
    """Return values with their units; those without one get the unit of the shown scene."""
    items = {item.key: item for item in dimensions(shown)}
    return {key: with_unit(text, items[key]) for key, text in values.items()}


def _reason(message: str, values: Mapping[Key, str], scene: Scene) -> str:
    """Return a reason without the key of a single value, beside which it stands; with several, in words."""
    if len(values) == 1:
        return re.sub(_KEY, "", message)
    words = {".".join(map(str, item.key)): item.label for item in dimensions(scene) if item.key in values}
    key, _, reason = message.partition(": ")
    return f"{words[key]}: {reason}" if key in words else message


# What is shown of the list, and what its tools and the mouse do.

HINT = to_say(
    "↑ ↓ choose   ← → nudge   type a value   Tab next   Enter takes   Ctrl+Z undo   Ctrl+R reset   "
    "Ctrl+S save   Esc closes"
)
_DIRECTIONS = (to_say("along"), to_say("to the left"), to_say("to the right"), "x", "y")
"""The words at the end of the labels of places, and the opposite side's."""
_STEPS = 12
"""The number of shades of a flash; each is drawn once."""
_PULL = 0.011
"""How far a drag of a value is for one step, in heights of the window."""
_MOVES = next(n for n, one in enumerate(TOOLS) if one.icon == "move")
"""The tool that is in hand beside the list."""
_INSTEAD: Mapping[Action, tuple[Action, ...]] = {
    Action("undo_sheet"): (Action("undo"),),
    Action("redo_sheet"): (Action("redo"),),
    Action("tool", "move"): (),
}
"""What tools mean beside the list, where joints can be moved already."""


def _tool(name: str) -> Resolver:
    """Return the resolver of a tool: beside the list alone it first opens the sheet."""

    def resolved(window: Outside, value: Value) -> tuple[Action, ...]:
        asked = Action(name, value)
        if type(window.state.top) is not Dimensions:
            return (asked,)
        return _INSTEAD.get(asked, (Action("build_on"), Action("numbers"), asked))

    return resolved


def measured(state: State, items: tuple[Dimension, ...]) -> Iterator[DimensionLine]:
    """Yield the line of the chosen dimension, and those of the others that give the same place."""
    if not items:
        return
    known, scene = {item.key: item for item in items}, in_unit(state.scene, state.look.unit)
    chosen = items[state.editing.chosen % len(items)].key
    for frame, begin, end, key in stretches(scene, chosen):
        yield DimensionLine(frame, begin, end, _worded(known[key], _digits(state)), key == chosen)


def _worded(item: Dimension, digits: int) -> str:
    """Return a dimension's value; for a place on a body, its direction and the value without a sign."""
    ends = (
        one for one in _DIRECTIONS if item.label.endswith(said("{name}, {part}", name="", part=said(one)))
    )
    direction = next(ends, "")
    if direction == "to the left" and item.value < 0:
        item, direction = replace(item, value=-item.value), "to the right"
    value = _valued(item, digits)
    return said("{direction} {length}", direction=said(direction), length=value) if direction else value


def _valued(item: Dimension, digits: int) -> str:
    return typeset(f"{significant(item.value, digits)} {item.unit}".strip())


def _digits(state: State) -> int:
    """Return how many digits a dimension has: all that were written; in another unit, enough."""
    return 10 if state.look.unit in (None, state.scene.length_unit) else 6


def _flash(state: State) -> float:
    """Return how bright the facts are, from 1 as they change down to 0, in a few steps."""
    if state.turned is None:
        return 0.0
    part = (state.frame - state.turned) / FLASH_FRAMES
    return round(_STEPS * (1.0 - part) ** 2) / _STEPS


def panel_of(state: State, items: tuple[Dimension, ...], *, lit: bool) -> Panel:
    """Return the list of dimensions, with typed values in their rows, the chosen one `lit`."""
    editing, info = state.editing, in_unit(state.scene, state.look.unit).info
    at, begun = editing.chosen % max(len(items), 1), dict(editing.drafts)
    at = at if lit else -1
    begun |= {item.key: f"{editing.typed}_" for n, item in enumerate(items) if n == at and editing.typed}
    shown = (begun.get(item.key) or _valued(item, _digits(state)) for item in items)
    rows = (
        EditRow(subscripted_words(item.label), value, chosen=n == at, draft=item.key in begun)
        for n, (item, value) in enumerate(zip(items, shown, strict=True))
    )
    return Panel(
        tuple(rows),
        facts=tuple(fact for fact in (info.class_said, info.grashof) if fact),
        flash=_flash(state),
        error=editing.refusal,
        hint=HINT,
    )


def in_marks(lines: Iterable[DimensionLine]) -> tuple[Addition, ...]:
    """Return lines as a mark on the picture; nothing without lines."""
    found = tuple(lines)
    return (MeasuredLines(found),) if found else ()


@frozen
class Dimensions(Mode):
    """The open list of dimensions of the scene."""

    keys = ModeKeys(
        "edit",
        {
            "in E": (
                *LIST_KEYS,
                KeyRow("F2", "the tools, for this linkage; E shows the list again", on("f2", "build_on")),
            )
        },
        TypedKeys("type", frozenset({"space", "h", "e"})),
    )
    bar = tuple(BUILD_ON_BAR if one.icon == "build" else one for one in LISTED_BAR)
    actions: ClassVar[Mapping[str, Rule]] = {
        "edit": Rule(rules.nothing, edit),
        "edit_at": Rule(rules.text, edit_at),  # a joint
        "edit_row": Rule(rules.whole, edit_row),  # a row of the list
        "choose": Rule(rules.whole, choose),
        "pass_on": Rule(rules.whole, pass_on),
        "nudge": Rule(rules.whole, nudge),
        "type": Rule(rules.text, write),
        "erase": Rule(rules.nothing, erase),
        "accept": Rule(rules.nothing, accept),
        "grab_row": Rule(rules.whole, grab_row),  # a row of the list
        "pull": Rule(rules.whole, pull),  # steps from the value that was taken hold of
    }
    meanings: ClassVar[Mapping[str, Resolver]] = {name: _tool(name) for name in {one.action for one in TOOLS}}
    is_listed, has_tools, edits_dimensions = True, True, True

    def typing(self, state: State) -> bool:
        """Return whether a value is being typed."""
        return bool(state.editing.typed)

    def closed(self, state: State) -> State:
        """Discard what is typed; else close the list."""
        return (
            replace(state, editing=nothing_begun(state.editing)) if state.editing.begun else edit(state, None)
        )

    def panel(self, state: State) -> Panel:
        """Return the list of dimensions."""
        return panel_of(state, dimensions(in_unit(state.scene, state.look.unit)), lit=True)

    def tools(self, state: State) -> tuple[int, bool]:
        """Return the tool in hand, with which nothing is added."""
        del state
        return _MOVES, True

    def drawn(self, state: State) -> tuple[Addition, ...]:
        """Return the chosen dimension's lines."""
        return in_marks(measured(state, dimensions(in_unit(state.scene, state.look.unit))))

    def mouse(self, gesture: Gesture, mouse: Hand, screen: Sight) -> tuple[Action, ...] | None:
        """Take a tool, or act on the list; None where the mouse acts as usual."""
        is_down = gesture.kind == "down" and mouse.drag is None
        tool = screen.number_at("tool", *mouse.at) if is_down else None
        if tool is not None:
            mouse.drag = "bar"
            return (Action(TOOLS[tool].action, TOOLS[tool].value),)
        return self.on_list(gesture, mouse, screen)

    def on_list(self, gesture: Gesture, mouse: Hand, screen: Sight) -> tuple[Action, ...] | None:
        """Return the actions on the list of a click, the wheel or a dragged value; None off it."""
        if mouse.drag == "row" and gesture.kind in ("move", "up"):
            return self._pulled(gesture, mouse, screen)
        row = screen.row_at(*mouse.at) if mouse.drag in (None, "row") else None
        if row is None:
            return None
        if gesture.kind == "wheel":
            # A long list scrolls below a mouse that stands still, so the row where the wheel began is kept.
            mouse.turned = row if mouse.turned is None else mouse.turned
            if mouse.turned < 0:
                return (Action("choose", -gesture.notches),)
            nudged = Action("nudge", gesture.notches * gesture.coarser)
            return (Action("grab_row", mouse.turned), Action("drop"), nudged)
        mouse.turned = None
        if gesture.kind != "down" or row < 0:
            return ()
        mouse.drag, mouse.steps = "row", 0
        return (Action("grab_row", row),)

    def _pulled(self, gesture: Gesture, mouse: Hand, screen: Sight) -> tuple[Action, ...]:
        """Return the change of the held row's value, by how far the mouse has moved to the right."""
        if gesture.kind == "up":
            mouse.drag = None
            return (Action("drop"),)
        before = mouse.steps
        mouse.steps = round((mouse.at[0] - mouse.begun[0]) / (_PULL * screen.size[1]))
        return (Action("pull", mouse.steps * gesture.coarser),) if mouse.steps != before else ()
