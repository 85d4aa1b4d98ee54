"""A mode: poses of a body are set down, dragged and turned, and linkages that pass them follow."""

from __future__ import annotations

import cmath
from collections.abc import Iterator, Mapping
from dataclasses import replace
from math import atan2, cos, degrees, dist, hypot, pi, radians, remainder, sin, tau
from typing import TYPE_CHECKING, ClassVar, Literal

import numpy as np

from linkanim.build.places import as_point
from linkanim.errors import BadInput
from linkanim.frozen import frozen
from linkanim.mechanics.linkage import Point
from linkanim.picture.build_sheet import Head
from linkanim.picture.drawn import Addition
from linkanim.picture.items import Group
from linkanim.picture.look import Look
from linkanim.picture.poses import AXIS
from linkanim.player import rules
from linkanim.player.action import Action, Value
from linkanim.player.edits import Dimensions, drop
from linkanim.player.keys import (
    BACK_BAR,
    HOME_BAR,
    LAST_BAR,
    MOVING_BAR,
    BarEntry,
    KeyRow,
    ModeKeys,
    aims,
    both,
    digits,
    enter,
    on,
    tabs,
)
from linkanim.player.sketching import (
    ACTIONS,
    Sketching,
    leave_sketch,
    released,
    row_of,
    sketching,
    with_answers,
)
from linkanim.player.state import (
    LARGEST_DIAL,
    PIVOTS,
    AnswerRow,
    Dial,
    PoseGrip,
    PoseSketch,
    Resolver,
    Rule,
    SetPose,
    State,
    nothing_begun,
    with_effect,
    with_toast,
)
from linkanim.scenes.scene import PosesPurpose
from linkanim.units import short, three_digits
from linkanim.words import said, said_as, to_say

if TYPE_CHECKING:
    from linkanim.mechanics.motion import Pose
    from linkanim.picture.figure import DrawSetting
    from linkanim.player.hand import Gesture, Hand, Outside
    from linkanim.player.sight import Sight
    from linkanim.synthesis.guidance import PoseAnswer

# The theory is imported when a pose is set: the first frame does not wait for it.

MOST = 5
"""The most poses."""
_WHOLE = radians(1)
"""The step in which angles are dragged."""
_NO_CHOICE = to_say("five poses leave no choice of pivots: Burmester's points are where they are")


def poses_(state: State, _: None) -> State:
    """Begin with poses: those that the scene was made for, or none yet; or go back to the earlier scene."""
    if state.posing:
        return leave_sketch(state)
    state = drop(leave_sketch(state), None)
    editing, shown = state.editing, state.displayed
    sketch = Posing(state.scene, state.clock, nothing_begun(editing), shown.length_unit)
    if isinstance(shown.purpose, PosesPurpose):
        sketch = replace(sketch, poses=tuple(SetPose(*row) for row in shown.purpose.poses))
    bare = state.unlisted.without(Dimensions)
    state = replace(bare.with_mode(sketch), editing=editing, glide=None)
    state = with_effect(replace(state, toast=None, faded=state.frame), "poses")
    return with_effect(state, "search") if sketch.is_asked else state


def put(state: State, numbers: tuple[float, ...]) -> State:
    """Take given poses: 1 for linkages that end on a slider, else 0; x, y and angle (rad) of each."""
    sketch = state.posing
    if sketch is None:
        return state
    rows = zip(numbers[1::3], numbers[2::3], numbers[3::3], strict=True)
    poses = tuple(SetPose(*row) for row in rows)[:MOST]
    return _changed(state, replace(sketch, poses=poses, sliding=numbers[0] > 0, earlier=sketch), "anew")


def pin(state: State, at: Point) -> State:
    """Set down a pin, where linkages have to have a fixed pin."""
    sketch = state.posing
    return _with_pin(state, sketch, at) if sketch else state


def _with_pin(state: State, sketch: PoseSketch, at: Point) -> State:
    room = 1 if sketch.sliding else len(PIVOTS)
    if len(sketch.poses) >= MOST:
        return with_toast(state, said(_NO_CHOICE))
    selected = "pin", min(len(sketch.pins), room - 1)
    bare = replace(sketch, pins=(*sketch.pins[: room - 1], at), selected=selected, earlier=sketch)
    return _changed(state, bare, "search")


def under(sketch: PoseSketch, at: Point, reach: float) -> PoseGrip | None:
    """Return the pose, pin or joint that a hand at a point grasps; None where there is none."""
    near = [(dist(place, at), grip) for grip, place in _handles(sketch, reach)]
    far, nearest = min(near, key=lambda one: one[0], default=(0.0, None))
    return nearest if far <= reach else None


def _handles(sketch: PoseSketch, reach: float) -> Iterator[tuple[PoseGrip, Point]]:
    """Yield the things that can be grasped, and where they are; a pin before the pivot at its place."""
    for n, pose in enumerate(sketch.poses):
        yield PoseGrip("pose", n), (pose.x, pose.y)
        yield PoseGrip("axis", n), _tip(pose, reach)
    yield from ((PoseGrip("pin", n), place) for n, place in enumerate(sketch.pins))
    for name, place in free_joints(sketch).items():
        is_pivot = name in PIVOTS
        yield (
            PoseGrip("pin", -1 - PIVOTS.index(name)) if is_pivot else PoseGrip("joint", "AB".index(name)),
            place,
        )


def free_joints(sketch: PoseSketch) -> dict[str, Point]:
    """Return the joints that can be moved while the poses are still met, in the first pose."""
    if sketch.answer is None or len(sketch.poses) >= MOST:
        return {}
    joints = sketch.answer.joints
    # with four poses only one point can be on a slider
    moving = "A" if sketch.answer.sliding and len(sketch.poses) == MOST - 1 else "AB"
    names = (*(name for name in PIVOTS if name in joints), *moving)
    return {name: (joints[name].real, joints[name].imag) for name in names}


def _tip(pose: SetPose, reach: float) -> Point:
    """Return where the x axis of a frame ends, as it is drawn."""
    long = AXIS * reach
    return pose.x + long * cos(pose.angle), pose.y + long * sin(pose.angle)


def has_room(sketch: PoseSketch) -> bool:
    """Return whether a further pose, or pin, can be set down."""
    return sketch.pinning or len(sketch.poses) < MOST


def down(state: State, hand: tuple[float, float, float, float]) -> State:
    """Put the hand down at a point: it grasps what is there, or sets down a frame or a pin."""
    sketch = state.posing
    if sketch is None or sketch.held:
        return state
    x, y, reach, snap = hand
    grip = under(sketch, (x, y), reach)
    if grip is None:
        at = _stepped(x, snap), _stepped(y, snap)
        return _set_down(state, sketch, at, (at[0] - x, at[1] - y))
    state = replace(state, glide=None)
    if grip.what == "pin" and grip.number < 0:
        return _pivot_taken(state, sketch, grip)
    place = next(at for one, at in _handles(sketch, reach) if one == grip)
    grip = grip._replace(off=(place[0] - x, place[1] - y))
    selected = ("pin" if grip.what == "pin" else "pose", grip.number) if grip.what != "joint" else None
    return sketching(state, held=grip, base=state.scene, selected=selected, earlier=sketch)


def _set_down(state: State, sketch: PoseSketch, at: Point, off: Point) -> State:
    """Return the state with a pin or a frame in hand at a place; `off` is its vector from the hand."""
    if sketch.pinning:
        state = _with_pin(state, sketch, at)
        after = state.posing
        held = after is not None and after.pins != sketch.pins
        return sketching(state, held=PoseGrip("pin", len(after.pins) - 1)) if after and held else state
    if len(sketch.poses) >= MOST:
        return state
    angle = sketch.poses[-1].angle if sketch.poses else 0.0
    number = len(sketch.poses)
    set_down = replace(
        sketch,
        poses=(*sketch.poses, SetPose(*at, angle)),
        held=PoseGrip("axis", number, off),
        selected=("pose", number),
        base=state.scene,
        earlier=sketch,
    )
    return replace(state.with_mode(_with_possible_pins(set_down)), glide=None)


def _pivot_taken(state: State, sketch: PoseSketch, grip: PoseGrip) -> State:
    """Return the state with a fixed pin of the linkage in hand: it becomes a pin that is asked for."""
    joints = sketch.answer.joints
    place = joints[PIVOTS[-1 - grip.number]]
    known = [n for n, at in enumerate(sketch.pins) if abs(complex(*at) - place) < 1e-9 * (1 + abs(place))]
    room = 1 if sketch.sliding else len(PIVOTS)
    pins = sketch.pins if known else (*sketch.pins[: room - 1], (place.real, place.imag))
    number = known[0] if known else len(pins) - 1
    held, selected = PoseGrip("pin", number), ("pin", number)
    return sketching(state, held=held, base=state.scene, pins=pins, selected=selected, earlier=sketch)


def along(state: State, hand: tuple[float, float, float, float]) -> State:
    """Move the hand to a point; the thing that it holds follows, and so do linkages."""
    sketch = state.posing
    if sketch is None or sketch.held is None:
        return state
    x, y, reach, snap = hand
    grip, at = sketch.held, (x + sketch.held.off[0], y + sketch.held.off[1])
    to = _stepped(at[0], snap), _stepped(at[1], snap)
    match grip.what:
        case "pose":
            pose = sketch.poses[grip.number]._replace(x=to[0], y=to[1])
        case "axis":
            pose = sketch.poses[grip.number]
            off = at[0] - pose.x, at[1] - pose.y
            if hypot(*off) <= reach:
                return state
            angle = atan2(off[1], off[0])
            pose = pose._replace(angle=_whole(angle) if snap else angle)
        case "pin":
            pins = tuple(to if n == grip.number else place for n, place in enumerate(sketch.pins))
            return _led(state, replace(sketch, pins=pins))
        case "joint":
            return _led(state, replace(sketch, held=grip._replace(at=to)))
    poses = tuple(pose if n == grip.number else one for n, one in enumerate(sketch.poses))
    return _led(state, replace(sketch, poses=poses))


def _led(state: State, sketch: PoseSketch) -> State:
    """Return the state with what the hand has dragged, and ask for the answer that follows."""
    sketch = _with_possible_pins(sketch)
    if not sketch.is_asked:
        return state.with_mode(sketch)
    return with_effect(state.with_mode(sketch), "follow" if sketch.answers else "search")


def up(state: State, _: None) -> State:
    """Lift the hand; where something was changed, ask for all linkages anew."""
    sketch = state.posing
    if sketch is None or sketch.held is None:
        return state
    before = sketch.earlier
    same = before and (sketch.poses, sketch.pins) == (before.poses, before.pins)
    if before and same and (sketch.held.what != "joint" or sketch.held.at is None):
        kept = replace(before, selected=sketch.selected, cursor=sketch.cursor)
        return state.with_mode(replace(kept, strokes=sketch.strokes))
    state = released(sketching(state, strokes=sketch.strokes + 1, refusal=""))
    if not sketch.is_asked:
        return replace(state, effects=())
    other = before is not None and len(sketch.poses) != len(before.poses)
    return with_effect(replace(state, effects=state.effects[:-1]), "anew") if other else state


def off(state: State) -> State:
    """Lift the hand, and leave all as it was before."""
    sketch = state.posing
    if sketch is None or sketch.held is None or sketch.earlier is None:
        return state
    back = replace(sketch.earlier, strokes=sketch.strokes + 1, cursor=sketch.cursor)
    scene = sketch.base or state.scene
    return replace(state.with_mode(back), scene=scene if sketch.answers else state.scene)


def cursor_(state: State, at: Point) -> State:
    """Move the keys' cursor to a point; the thing held by keys follows."""
    state = along(state, (*at, 0.0, 1e-9)) if state.posing and state.posing.held else state
    return sketching(state, cursor=at) if state.posing else state


def further(state: State, by: int) -> State:
    """Choose the next frame or pin, or the one before; the keys' cursor goes there."""
    sketch = state.posing
    if sketch is None or sketch.held:
        return state
    things = [("pose", n) for n in range(len(sketch.poses))] + [("pin", n) for n in range(len(sketch.pins))]
    if not things:
        return state
    at = things.index(sketch.selected) + by if sketch.selected in things else min(by - 1, 0)
    selected = things[at % len(things)]
    place = sketch.pins[selected[1]] if selected[0] == "pin" else sketch.poses[selected[1]][:2]
    return sketching(state, selected=selected, cursor=place)


def remove(state: State, _: None) -> State:
    """Take away the frame or pin that was touched last."""
    sketch = state.posing
    if sketch is None or sketch.held or sketch.selected is None:
        return state
    what, number = sketch.selected
    bare = replace(sketch, selected=None, earlier=sketch)
    if what == "pin":
        bare = replace(bare, pins=tuple(at for n, at in enumerate(sketch.pins) if n != number))
    else:
        bare = replace(bare, poses=tuple(one for n, one in enumerate(sketch.poses) if n != number))
    return _changed(state, bare, "search")


def pinning_(state: State, _: None) -> State:
    """Let the hand set pins, or poses again."""
    return sketching(state, pinning=not state.posing.pinning) if state.posing else state


def sliding_(state: State, _: None) -> State:
    """Ask for linkages that end on a slider, or for four-bars again."""
    sketch = state.posing
    if sketch is None or sketch.held:
        return state
    pins = sketch.pins if sketch.sliding else sketch.pins[:1]
    return _changed(state, replace(sketch, sliding=not sketch.sliding, pins=pins, earlier=sketch), "anew")


def curves_(state: State, _: None) -> State:
    """Show or hide the poses' poles and Burmester's curves and points."""
    return sketching(state, curves=not state.posing.curves) if state.posing else state


def dial_(state: State, share: float) -> State:
    """Turn the dial to a share of its range, 0 for small linkages to 1 for a large transmission angle."""
    sketch = state.posing
    if sketch is None or sketch.held:
        return state
    at = min(max(round((2 * share - 1) * LARGEST_DIAL), -LARGEST_DIAL), LARGEST_DIAL)
    return _changed(state, replace(sketch, dial=at), "anew") if at != sketch.dial else state


def dial_on(state: State, by: int) -> State:
    """Turn the dial by a number of steps towards a large transmission angle."""
    sketch = state.posing
    return dial_(state, (sketch.dial + by + LARGEST_DIAL) / (2 * LARGEST_DIAL)) if sketch else state


def cards(state: State, numbers: tuple[float, ...]) -> State:
    """Replace all linkages: the number of the one to show, then the numbers of each linkage."""
    from linkanim.synthesis.guidance import POSE_NUMBERS, pose_answer_from

    if len(numbers) % POSE_NUMBERS != 1 or state.posing is None:
        return state
    rows = (numbers[n : n + POSE_NUMBERS] for n in range(1, len(numbers), POSE_NUMBERS))
    return with_answers(state, round(numbers[0]), tuple(map(pose_answer_from, rows)))


def no_linkage(state: State, reason: str) -> State:
    """Say why there is no linkage for the poses."""
    sketch = state.posing
    if sketch is None or sketch.held:
        return state
    faded = state.frame if sketch.answers else state.faded
    return replace(sketching(state, refusal=reason, answers=(), chosen=0), faded=faded, glide=None)


def let_go(state: State) -> State | None:
    """Return the state without what is held, else the cursor, a highlight or pins; None without any."""
    sketch = state.posing
    if sketch is None:
        return None
    if sketch.held:
        return off(state)
    for name, none in (("cursor", None), ("selected", None), ("pinning", False)):
        if getattr(sketch, name):
            return sketching(state, **{name: none})
    return None


def _changed(state: State, sketch: PoseSketch, effect: str) -> State:
    """Return the state with another sketch, for which linkages are asked; for too few poses, none."""
    sketch = _with_possible_pins(replace(sketch, strokes=sketch.strokes + 1, refusal=""))
    if not sketch.is_asked:
        return replace(state.with_mode(replace(sketch, answers=(), chosen=0)), glide=None)
    return with_effect(replace(state.with_mode(sketch), toast=None), effect)


def _with_possible_pins(sketch: PoseSketch) -> PoseSketch:
    """Return poses with their pins where these are possible: with four poses, on the centre-point curve."""
    if not sketch.pins or len(sketch.poses) < 4:
        return sketch
    if len(sketch.poses) >= MOST:
        return replace(sketch, pins=())
    from linkanim.synthesis.burmester import CentreCurve, Poses

    try:
        angles = np.array([pose.angle for pose in sketch.poses])
        curve = CentreCurve(Poses(sketch.points, angles))
        feet = [curve.nearest(complex(*at)) for at in sketch.pins]
    except BadInput:
        return sketch
    return replace(sketch, pins=tuple((foot.real, foot.imag) for foot in feet))


def _stepped(value: float, step: float) -> float:
    return round(value / step) * step if step else value


def _whole(angle: float) -> float:
    """Return an angle in whole degrees, from -pi to pi."""
    return remainder(round(angle / _WHOLE) * _WHOLE, tau) if abs(angle) < pi else angle


# What is shown of poses.

_FREE = {
    2: to_say("pivots and joints are free: drag them"),
    3: to_say("a pivot or its joint is free: drag them"),
    4: to_say("pivots and joints slide along Burmester's curves (B)"),
    5: to_say("nothing is free: Burmester's points (B)"),
}
"""The linkages that can be found, by the number of poses."""


def _said_of_poses(state: State, sketch: PoseSketch) -> tuple[str, tuple[str, ...]]:
    """Return words on what is missing, on why there is no linkage, or on the shown one."""
    kind, count = said("slider-crank") if sketch.sliding else said("four-bar"), len(sketch.poses)
    sets = (said("pins"),) if sketch.pinning else ()
    if sketch.refusal:
        return sketch.refusal, sets
    if not sketch.is_asked:
        begun = said("set down two to five poses: press and drag")
        if count:
            begun = said("one pose; set down another")
        return begun, (said("a {kind} is to pass them", kind=kind), *sets)
    answer = sketch.answer
    if answer is None:
        return said("{count} poses: looking for a {kind}", count=count, kind=kind), sets
    angle = f"{degrees(answer.transmission):.0f}°"
    lacks = said_as("list", ", ").join(map(said, answer.named_defects))
    facts = said(
        "longest link {length}, transmission angle {angle}",
        length=f"{short(answer.size)} {sketch.unit}",
        angle=angle,
    )
    lacking = said("passes them in order on one branch")
    if lacks:
        lacking = said("defects: {defects}", defects=lacks)
    words = said("{linkage} through {count} poses", linkage=state.scene.info.class_said, count=count)
    return words[:1].upper() + words[1:], (facts, lacking, said(_FREE[count]), *sets)


def _sized(answer: PoseAnswer, sketch: PoseSketch) -> str:
    """Return an answer's longest link and transmission angle, or its first defect."""
    lacks = answer.named_defects
    words = said(lacks[0]) if lacks else f"{degrees(answer.transmission):.0f}°"
    return f"{three_digits(answer.size)} {sketch.unit} · {words}"


def _aim(window: Outside, way: Value) -> Iterator[Action]:
    """Yield what an arrow means: the cursor moves."""
    sketch = window.state.posing
    if sketch and isinstance(way, tuple):
        yield Action("cursor", window.screen.aimed(sketch.cursor, way))


def _enter(window: Outside, _: Value) -> Iterator[Action]:
    """Yield what Enter means: the hand goes down or up, or the linkage is kept."""
    sketch = window.state.posing
    if sketch and sketch.held:
        yield Action("hand_up")
    elif sketch and sketch.cursor is None:
        yield Action("keep")
    elif sketch and sketch.cursor:
        yield Action("hand_down", window.screen.handed(*window.screen.pixel(*sketch.cursor), 1.0))


@frozen
class Posing(Sketching, PoseSketch, Addition):
    """The poses that are set down."""

    keys = ModeKeys(
        "poses",
        {
            "in F4": (
                KeyRow("press, drag", "set down a frame; drag it, or turn it by its axis"),
                KeyRow("drag a pivot, a joint", "move it; of four poses it slides along its curve"),
                KeyRow("P", "set pins, or frames again", on("p", "pinning")),
                KeyRow("S", "linkages with a slider, or four-bars", on("s", "sliding")),
                KeyRow("B", "poles, Burmester's curves and points", on("b", "theory")),
                KeyRow(
                    ", .",
                    "the dial: smaller links, a larger transmission angle",
                    both(",", ".", "dial_on"),
                ),
                KeyRow("1–9, click", "take another answer", digits("answer")),
                KeyRow(
                    "arrows (Shift: fine), Enter",
                    "move a cursor; press and release there",
                    aims() + enter("enter"),
                ),
                KeyRow(
                    "Tab, Del", "choose a frame or pin; remove it", tabs("further") + on("delete", "remove")
                ),
                KeyRow("Ctrl+Z", "undo the last change", on("ctrl+z", "undo_sketch", held=True)),
                KeyRow(
                    "Enter, Ctrl+Enter",
                    "keep the linkage as the scene; Esc goes back",
                    on("ctrl+return ctrl+kp_enter", "keep"),
                ),
            )
        },
        names={
            Action("dial_on", -1): "the dial: smaller links",
            Action("dial_on", 1): "the dial: a larger transmission angle",
            Action("further", -1): "the frame or pin before",
            Action("further", 1): "the next frame or pin",
        },
    )
    bar = (
        *(BACK_BAR, HOME_BAR, *MOVING_BAR, BarEntry("again", Action("undo_sketch"), 3, leads=True)),
        *(BarEntry("construction", Action("theory"), 4), BarEntry("done", Action("keep"), 1), *LAST_BAR),
    )
    actions: ClassVar[Mapping[str, Rule]] = {
        **ACTIONS,
        "poses": Rule(rules.nothing, poses_),
        "set_poses": Rule(rules.triples, put),  # 1 with a slider, else 0; x, y, angle (rad) of each
        "set_pin": Rule(rules.place_of_sheet, pin),  # (x, y) in the scene's unit
        "pinning": Rule(rules.nothing, pinning_),
        "sliding": Rule(rules.nothing, sliding_),
        "theory": Rule(rules.nothing, curves_),
        "no_linkage": Rule(rules.text, no_linkage),  # why there is no linkage
        "cards": Rule(rules.cards, cards),  # which one is shown; the numbers of each
        "dial": Rule(rules.share, dial_),  # from 0 to 1, the steepest
        "dial_on": Rule(rules.whole, dial_on),  # so many steps further
        "hand_down": Rule(rules.hand, down),  # (x, y), how near counts as on it, the step of what is drawn
        "hand_to": Rule(rules.hand, along),
        "hand_up": Rule(rules.nothing, up),
        "cursor": Rule(rules.place_of_sheet, cursor_),
        "further": Rule(rules.whole, further),
        "remove": Rule(rules.nothing, remove),
    }
    meanings: ClassVar[Mapping[str, Resolver]] = {"aim": _aim, "enter": _enter}
    has_head = True

    def look(self, look: Look) -> Look:
        """Return the look, without numbers."""
        return replace(look, hud=False)

    def closed(self, state: State) -> State:
        """Let go of what is held or chosen; else go back to the scene from before."""
        return let_go(state) or leave_sketch(state)

    @property
    def alone(self) -> Literal["", "sheet"]:
        """It stands on a sheet as long as there is no linkage."""
        return "sheet" if self.is_blank else ""

    def drawn(self, state: State) -> tuple[Addition, ...]:
        """Return the poses, and words about them."""
        return Head(*_said_of_poses(state, self), bool(self.refusal)), self

    def groups(self, setting: DrawSetting, pose: Pose) -> Iterator[Group]:
        """Yield the theory, the shown answer's coupler in each pose, what can be dragged, and the axes."""
        del pose
        from linkanim.picture.poses import axes, couplers, grips, theory

        if self.curves:
            yield theory(setting, self.poses, held=self.held is not None)
        yield couplers(setting, [*self._bodies()])
        yield grips(setting, free_joints(self).values(), self.pins, self.selected)
        yield axes(setting, self.poses, self.selected, self.cursor)

    def _bodies(self) -> Iterator[tuple[Point, ...]]:
        """Yield the corners of the shown answer's coupler in each pose."""
        if answer := self.answer:
            first = self.poses[0]
            for one in self.poses:
                turn = cmath.rect(1.0, one.angle - first.angle)
                corners = (answer.joints[name] - complex(first.x, first.y) for name in "ABP")
                yield tuple(as_point(complex(one.x, one.y) + turn * corner) for corner in corners)

    def answer_row(self, state: State) -> AnswerRow | None:
        """Return the row of answers below their dial, whose middle is marked."""
        if self.is_blank:
            return None
        words = tuple(_sized(one, self) for one in self.answers)
        poses = (self.earlier or self).poses if self.held else self.poses
        share = (self.dial + LARGEST_DIAL) / (2 * LARGEST_DIAL)
        dial = Dial(share, "compact", "steep angle", (0.5,))
        return replace(row_of(state, self, words), dial=dial, poses=poses)

    def mouse(self, gesture: Gesture, mouse: Hand, screen: Sight) -> tuple[Action, ...] | None:
        """Take an answer, or set down and drag frames and pins; None where the mouse acts as usual."""
        if gesture.kind == "down" and screen.charted(*mouse.at) is None:
            place = screen.number_at("answer", *mouse.at)
            if place is not None:
                mouse.drag = None
                return (Action("answer", place),)
            if screen.target_at("dial", *mouse.at):
                mouse.drag = "dial"
                return (Action("dial", screen.dialled(mouse.at[0])),)
            on_it = under(self, screen.world(*mouse.at), screen.near) is not None
            mouse.drag = "hand" if on_it or has_room(self) else "pan"
            mouse.draws = mouse.drag == "hand" and not on_it
            return (mouse.handed("hand_down", screen),) if mouse.drag == "hand" else ()
        if mouse.drag not in ("hand", "dial") or gesture.kind not in ("move", "up"):
            return None
        drag = mouse.drag
        if gesture.kind == "move" and drag == "hand":
            return (mouse.handed("hand_to", screen),)
        if gesture.kind == "move":
            return (Action("dial", screen.dialled(mouse.at[0])),)
        mouse.drag = None
        return (Action("hand_up"),) if drag == "hand" else ()
