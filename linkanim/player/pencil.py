"""A mode: the pencil draws a stroke, linkages that follow it come, its points and fixed pins are dragged."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import suppress
from dataclasses import replace
from math import degrees, hypot
from typing import TYPE_CHECKING, ClassVar, Literal

from linkanim.build.places import from_span
from linkanim.errors import BadInput
from linkanim.frozen import frozen
from linkanim.picture.drawn import Addition
from linkanim.picture.items import Group
from linkanim.player import rules
from linkanim.player.action import Action
from linkanim.player.dial import dial as turn_dial
from linkanim.player.dial import dial_on, dialled, place_of
from linkanim.player.edits import Dimensions, drop, exchanged
from linkanim.player.keys import (
    BACK_BAR,
    HOME_BAR,
    LAST_BAR,
    MOVING_BAR,
    BarEntry,
    KeyRow,
    ModeKeys,
    both,
    digits,
    enter,
    on,
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
    DIAL,
    NEAR_HAND,
    PIVOTS,
    REACH,
    AnswerRow,
    Dial,
    PathSketch,
    Rule,
    State,
    nothing_begun,
    with_effect,
    with_toast,
)
from linkanim.scenes.scene import Scene
from linkanim.units import significant
from linkanim.words import said

if TYPE_CHECKING:
    from linkanim.mechanics.motion import Pose
    from linkanim.picture.figure import DrawSetting
    from linkanim.player.hand import Drag, Gesture, Hand
    from linkanim.player.sight import Sight
    from linkanim.synthesis.answers import PathAnswer
    from linkanim.synthesis.curves import DrawnCurve

# The rest of the search is imported when the pencil is taken: the first frame does not wait for it.

MOST_POINTS = 5_000
"""The most points of a stroke under way; further ones are left out."""


def pencil(state: State, _: None) -> State:
    """Take the pencil, or put it down and go back to the scene from before."""
    if state.drawing:
        return leave_sketch(state)
    state = drop(leave_sketch(state), None)
    editing = state.editing
    sketch = Pencil(state.scene, state.clock, nothing_begun(editing), state.displayed.length_unit)
    bare = state.unlisted.without(Dimensions)
    state = replace(bare.with_mode(sketch), editing=editing, glide=None)
    return with_effect(replace(state, toast=None, faded=state.frame), "pencil")


def own(state: State, _: None) -> State:
    """Take the pencil, the scene's own trace as the stroke."""
    from linkanim.mechanics.measures import as_complex
    from linkanim.synthesis.curves import trace_of

    state = leave_sketch(state)
    scene = state.scene
    if not scene.trace:
        return with_toast(state, said("{scene} has no trace to take; W draws a path", scene=scene.name))
    try:
        curve = trace_of(as_complex(state.displayed.cycle(720, derivatives=0).position[scene.trace[0]]))
    except BadInput as error:
        return with_toast(state, str(error))
    return sketching(_searched(pencil(state, None), curve), answers=(scene,))


def down(state: State, at: tuple[float, float]) -> State:
    """Begin a stroke."""
    return sketching(state, pen=(complex(*at),), held=None) if state.drawing else state


def along(state: State, at: tuple[float, float]) -> State:
    """Continue the stroke to a point."""
    sketch = state.drawing
    if sketch is None or not 0 < len(sketch.pen) < MOST_POINTS:
        return state
    return sketching(state, pen=(*sketch.pen, complex(*at)))


def up(state: State, _: None) -> State:
    """End the stroke, and ask for linkages that follow it; a stroke without extent is forgotten."""
    import numpy as np

    from linkanim.synthesis.curves import stroke_of

    sketch = state.drawing
    if sketch is None or not sketch.pen:
        return state
    try:
        curve = stroke_of(np.array(sketch.pen))
    except BadInput:
        return off(state, None)
    return _searched(state, curve)


def off(state: State, _: None) -> State:
    """Forget the stroke that was begun."""
    return sketching(state, pen=()) if state.drawing else state


def stroke(state: State, numbers: tuple[float, ...]) -> State:
    """Take a stroke that is given: 1 where it is closed, else 0, then its points x, y, x, y, …"""
    from linkanim.synthesis.curves import drawn

    points = [complex(x, y) for x, y in zip(numbers[1::2], numbers[2::2], strict=True)]
    return _searched(state, drawn(points, closed=numbers[0] > 0)) if state.drawing else state


def _searched(state: State, curve: DrawnCurve) -> State:
    """Return the state with another stroke, for which linkages are asked."""
    assert state.drawing
    earlier = replace(state.drawing, pen=())
    bare = replace(earlier.undialled, answers=(), chosen=0, names=(), way=(), pivots=(), earlier=earlier)
    sketch = replace(bare, curve=curve, strokes=bare.strokes + 1)
    return with_effect(replace(state.with_mode(sketch), toast=None), "search")


def answers_(state: State, numbers: tuple[float, ...]) -> State:
    """Take all answers from an older tape, which has no sizes and angles for them."""
    from linkanim.synthesis.answers import EARLIER

    return with_answers(state, round(numbers[0]), _answers_of(numbers[1:], EARLIER))


def cards(state: State, numbers: tuple[float, ...]) -> State:
    """Replace all answers: the number of the one to show, then the numbers of each answer.

    An answer that the user chose meanwhile stays.
    """
    from linkanim.synthesis.answers import NUMBERS
    from linkanim.synthesis.front import names_of

    sketch, first, answers = state.drawing, round(numbers[0]), _answers_of(numbers[1:], NUMBERS)
    if sketch and sketch.picked and isinstance(sketch.answer, tuple):
        answers = (*answers, *([] if sketch.answer in answers else [sketch.answer]))
        first = answers.index(sketch.answer)
    after = with_answers(state, first, answers)
    if after is state or after.drawing is None or not all(one.size > 0 for one in answers):
        return after
    kept = [one for one in after.drawing.answers if not isinstance(one, Scene)]
    own = len(after.drawing.answers) - len(kept)
    return sketching(after, names=(*own * ("",), *names_of([one.figures for one in kept])))


def way_(state: State, numbers: tuple[float, ...]) -> State:
    """Take the answers along the front, from the exact end to the compact one: 0, and the numbers of each."""
    from linkanim.synthesis.answers import NUMBERS

    if state.drawing is None or state.drawing.held is not None:
        return state
    return sketching(state, way=_answers_of(numbers[1:], NUMBERS))


def _answers_of(numbers: tuple[float, ...], each: int) -> tuple[PathAnswer, ...]:
    from linkanim.synthesis.answers import answer_from

    return tuple(answer_from(numbers[n : n + each]) for n in range(0, len(numbers), each))


def grasp_point(state: State, point: int) -> State:
    """Take hold of a point of the stroke."""
    sketch = state.drawing
    if sketch is None or sketch.curve is None or not 0 <= point < len(sketch.curve.points):
        return state
    return _grasped(state, sketch, point)


def grasp_pivot(state: State, pivot: str) -> State:
    """Take hold of a fixed pin of the answer that is shown."""
    sketch = state.drawing
    if sketch is None or pivot not in PIVOTS or sketch.answer is None or isinstance(sketch.answer, Scene):
        return state
    return _grasped(state, sketch, pivot)


def _grasped(state: State, sketch: PathSketch, held: int | str) -> State:
    """Return the state with a part of a sketch grasped; what the dial shows becomes an answer."""
    held_sketch = sketch.undialled
    if sketch.dialled:
        answers = (*sketch.answers[: sketch.chosen], sketch.dialled, *sketch.answers[sketch.chosen + 1 :])
        held_sketch = replace(held_sketch, answers=answers)
    held_sketch = replace(
        held_sketch, way=(), names=(), picked=False, held=held, base=state.scene, earlier=sketch
    )
    return replace(state.with_mode(held_sketch), glide=None)


def lead(state: State, to: tuple[float, float]) -> State:
    """Drag what is held to a point, and ask for the linkage that follows."""
    from linkanim.synthesis.curves import bent

    sketch = state.drawing
    if sketch is None or sketch.held is None or sketch.held == DIAL:
        return state
    if isinstance(sketch.held, str):
        pivots = {**dict(sketch.pivots), sketch.held: to}
        return with_effect(sketching(state, pivots=tuple(pivots.items())), "follow")
    assert sketch.curve
    with suppress(BadInput):
        curve = bent(sketch.curve, sketch.held, complex(*to))
        state = with_effect(sketching(state, curve=curve, **_without_own(sketch)), "follow")
    return state


def _without_own(sketch: PathSketch) -> dict[str, object]:
    """Return the answers without the scene whose trace was taken, since the stroke is another curve now."""
    own = sum(isinstance(one, Scene) for one in sketch.answers)
    return {"answers": sketch.answers[own:], "chosen": max(sketch.chosen - own, 0)}


def cognate(state: State, number: int) -> State:
    """Show a cognate of the answer instead of it: one of those that turn fully."""
    sketch = state.drawing
    cognates = [one for one in sketch.cognates if one] if sketch else []
    if sketch is None or not 0 <= number < len(cognates):
        return (
            with_toast(state, said("none of its cognates turns fully"))
            if sketch and sketch.follows
            else state
        )
    from linkanim.synthesis.front import names_of

    answers = (*sketch.answers[: sketch.chosen], cognates[number], *sketch.answers[sketch.chosen + 1 :])
    figures = [one.figures for one in answers if isinstance(one, tuple) and one.size > 0]
    names = names_of(figures) if len(figures) == len(answers) == len(sketch.names) else ()
    taken = replace(sketch.undialled, answers=answers, names=names, picked=True, earlier=sketch)
    state = replace(exchanged(state, taken.scene_of(cognates[number])), glide=None, faded=state.frame)
    return state.with_mode(taken)


def let_go(state: State, _: None) -> State:
    """Release what was dragged; all answers to the sketch as it is now are asked for."""
    sketch = state.drawing
    if sketch is None or sketch.held is None:
        return state
    if sketch.held == DIAL:
        return dialled(state)
    return released(state)


# What is shown of a stroke and its answers.


def _figures(answer: PathAnswer) -> str:
    """Return an answer's deviation, and where they are known its size and least transmission angle."""
    if not answer.size:
        return _percent(answer.off)
    return f"{_percent(answer.off)} · ×{significant(answer.size, 2)} · {round(degrees(answer.angle))}°"


def _percent(share: float) -> str:
    """Return a share in percent, to two digits; below a hundred thousandth it is 0."""
    return f"{significant(share, 2)} %" if share >= 1e-5 else "0 %"


def _off(sketch: PathSketch) -> str | None:
    """Say how far the shown answer deviates, and its other figures."""
    answer = sketch.answer
    if answer is None or sketch.off is None:
        return None
    if isinstance(answer, Scene) or not answer.size:
        return f"{_percent(sketch.off)} off"
    return _figures(answer).replace("%", "% off", 1)


def cognate_at(screen: Sight, x: float, y: float, reach: float) -> int | None:
    """Return the place of the cognate under a pixel among those that are drawn; None elsewhere."""
    sketch = screen.state.of(Pencil)
    numbers = sketch.cognate_numbers if sketch else ()
    if not numbers:
        return None
    from linkanim.picture.cognates import cognate_sides

    pose, at = screen.state.displayed.pose(screen.state.phase, 0), complex(*screen.world(x, y))
    reach *= abs(complex(*screen.world(1.0, 0.0)) - complex(*screen.world(0.0, 0.0)))
    for row, number in enumerate(numbers):
        sides = cognate_sides(pose, number)
        if any(abs(from_span(begin, end, at)) <= reach for begin, end in sides):
            return row
    return None


_DRAGS: Mapping[str, Drag] = {"pen_down": "pen", "grasp_point": "lead", "grasp_pivot": "lead", "dial": "dial"}
"""The kind of drag that follows, by the action that the pencil has begun."""


@frozen
class Pencil(Sketching, PathSketch, Addition):
    """The pencil, and what it has drawn."""

    keys = ModeKeys(
        "pencil",
        {
            "in W": (
                KeyRow("mouse", "draw a path in one stroke; drag its points and the fixed pins"),
                KeyRow("1–9, click", "take another answer", digits("answer")),
                KeyRow(", .", "the dial: more exact, more compact", both(",", ".", "dial_on")),
                KeyRow(
                    "F, click",
                    "take a cognate: the faint linkage, which traces the same curve",
                    on("f", "cognate", 0),
                ),
                KeyRow("Ctrl+Z", "undo the last stroke or drag", on("ctrl+z", "undo_sketch", held=True)),
                KeyRow("Enter", "keep the linkage as the scene; Esc goes back", enter("keep")),
            )
        },
        names={
            Action("dial_on", -1): "the dial: more exact",
            Action("dial_on", 1): "the dial: more compact",
        },
    )
    bar = (
        *(BACK_BAR, HOME_BAR, *MOVING_BAR, BarEntry("again", Action("undo_sketch"), 3, leads=True)),
        *(BarEntry("done", Action("keep"), 1), *LAST_BAR),
    )
    actions: ClassVar[Mapping[str, Rule]] = {
        **ACTIONS,
        "pencil": Rule(rules.nothing, pencil),
        "own_trace": Rule(rules.nothing, own),
        "pen_down": Rule(rules.numbers(2), down),  # (x, y) in the scene's unit
        "pen_to": Rule(rules.numbers(2), along),
        "pen_up": Rule(rules.nothing, up),
        "pen_off": Rule(rules.nothing, off),
        "stroke": Rule(rules.pairs, stroke),  # 1 closed, 0 open; x, y of each point
        "answers": Rule(rules.answers, answers_),  # on older tapes: as "cards", without sizes and angles
        "cards": Rule(rules.cards, cards),  # which one is shown; the numbers of each
        "way": Rule(rules.cards, way_),  # 0; the numbers of each answer along the front
        "dial": Rule(rules.share, turn_dial),  # from 0 to 1, the most compact
        "dial_on": Rule(rules.whole, dial_on),  # so many steps further
        "cognate": Rule(rules.whole, cognate),  # its place among those that turn fully, from 0
        "grasp_point": Rule(rules.whole, grasp_point),  # its place on the stroke
        "grasp_pivot": Rule(rules.text, grasp_pivot),
        "lead": Rule(rules.numbers(2), lead),  # to (x, y) in the scene's unit
        "let_go": Rule(rules.nothing, let_go),
    }
    pointer = "pencil"

    def closed(self, state: State) -> State:
        """Put the pencil down, and go back to the scene from before."""
        return leave_sketch(state)

    @property
    def sign(self) -> str | None:
        """How far off the stroke the linkage's curve is, or that one is looked for."""
        searched = "searching" if self.curve and not self.pen else None
        return searched if self.is_blank else _off(self)

    @property
    def alone(self) -> Literal["", "sheet"]:
        """It stands on a sheet as long as no linkage follows the stroke."""
        return "sheet" if self.is_blank else ""

    @property
    def stroke(self) -> DrawnCurve | None:
        """The stroke that a linkage follows."""
        return None if self.is_blank else self.curve

    def drawn(self, state: State) -> tuple[Addition, ...]:
        """Return the stroke and its cognates."""
        del state
        return (self,)

    def behind(self, setting: DrawSetting, pose: Pose) -> Iterator[Group]:
        """Yield the cognates, faintly."""
        if numbers := self.cognate_numbers:
            from linkanim.picture.cognates import cognate_group

            yield cognate_group(setting, pose, numbers)

    def groups(self, setting: DrawSetting, pose: Pose) -> Iterator[Group]:
        """Yield the pencil's line; once a linkage follows it, the points and pins that can be dragged."""
        del pose
        from linkanim.picture.build_sheet import drawn_line, handles

        if self.is_blank:
            yield drawn_line(setting, self.pen, self.curve)
        elif self.curve:
            held = self.held if isinstance(self.held, int) else None
            pins = [place for _, place in self.pivots]
            yield Group("handles", [*handles(setting, self.curve, held, pins)], over=True)

    @property
    def cognate_numbers(self) -> tuple[int, ...]:
        """The numbers of the cognates that are drawn, 0 and 1."""
        return tuple(n for n, one in enumerate(self.cognates) if one)

    def answer_row(self, state: State) -> AnswerRow | None:
        """Return the row of answers; while something is dragged, with the pictures from before."""
        if self.is_blank:
            return None
        words = tuple("its own" if isinstance(one, Scene) else _figures(one) for one in self.answers)
        names = self.names if len(self.names) == len(words) else tuple("" for _ in words)
        dial = None
        if len(self.way) > 1:
            marks = tuple(n / (len(self.way) - 1) for n, one in enumerate(self.way) if one in self.answers)
            dial = Dial(place_of(self), "exact", "compact", marks, self.held == DIAL)
        chosen = self.chosen if self.dialled is None else -1
        return replace(row_of(state, self, words), names=names, chosen=chosen, dial=dial)

    def mouse(self, gesture: Gesture, mouse: Hand, screen: Sight) -> tuple[Action, ...] | None:
        """Draw, or drag what is under the pencil; None where the mouse acts as without a pencil."""
        reach = REACH * screen.size[1]
        if gesture.kind == "down" and screen.charted(*mouse.at) is None:
            begun = self.begun(screen, *mouse.at, reach)
            mouse.under = cognate_at(screen, *mouse.at, NEAR_HAND * screen.size[1])
            mouse.drag = _DRAGS.get(begun.name)
            return (begun,)
        if mouse.drag not in ("pen", "lead", "dial") or gesture.kind not in ("move", "up"):
            return None
        if gesture.kind == "move" and mouse.drag == "dial":
            return (Action("dial", screen.dialled(mouse.at[0])),)
        if gesture.kind == "move":
            return (Action("pen_to" if mouse.drag == "pen" else "lead", screen.world(*mouse.at)),)
        drag, mouse.drag = mouse.drag, None
        if drag != "pen":
            return (Action("let_go"),)
        if mouse.far > reach:
            return (Action("pen_up"),)
        taken = () if mouse.under is None else (Action("cognate", mouse.under),)
        return (Action("pen_off"), *taken)

    def begun(self, screen: Sight, x: float, y: float, reach: float) -> Action:
        """Return the action that the pencil begins at a pixel: it takes an answer, pin or point, or draws."""
        place = screen.number_at("answer", x, y)
        if place is not None:
            return Action("answer", place)
        if screen.target_at("dial", x, y):
            return Action("dial", screen.dialled(x))
        pose = screen.state.displayed.pose(screen.state.phase, 0)
        pivots = [name for name in PIVOTS if name in pose.position] if self.follows else []
        for pivot in pivots:
            if max(map(abs, screen.away(pose.position[pivot], x, y))) <= reach:
                return Action("grasp_pivot", pivot)
        points = self.curve.points if self.curve and not self.is_blank else ()
        away = [hypot(*screen.away((point.real, point.imag), x, y)) for point in points]
        if away and min(away) <= reach:
            return Action("grasp_point", away.index(min(away)))
        return Action("pen_down", screen.world(x, y))
