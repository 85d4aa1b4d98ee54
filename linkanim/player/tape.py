"""Tapes: actions frame by frame, from which the same pictures can be made again at any size."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace
from functools import cached_property

from linkanim.frozen import frozen
from linkanim.player.action import Action
from linkanim.player.actions import advance, carried, is_taped, leave
from linkanim.player.building import stored_text
from linkanim.player.clock import FRAMES_PER_SECOND
from linkanim.player.making import Layering
from linkanim.player.state import LARGEST_DIAL, PoseSketch, State
from linkanim.scenes.scene import Scene


@frozen
class Tape:
    """Actions by frame, and the state at frame 0; `size` is the window's when it was made."""

    start: State
    frames: int
    actions: tuple[tuple[int, Action], ...] = ()
    size: tuple[int, int] = (1280, 720)

    @property
    def is_loop(self) -> bool:
        """Whether it has no actions: such a recording is the scene's seamless loop."""
        return not self.actions

    @property
    def seconds(self) -> float:
        """Its duration in seconds."""
        return self.frames / FRAMES_PER_SECOND

    @cached_property
    def begun(self) -> State:
        """The state to begin with: `start` after the actions of frame 0."""
        state = self.start
        for action in self.at(0):
            state = replace(carried(state, action), glide=None, faded=None, effects=(), toast=None, chip=None)
        return state

    @cached_property
    def _by_frame(self) -> dict[int, list[Action]]:
        by_frame: dict[int, list[Action]] = {}
        for frame, action in self.actions:
            by_frame.setdefault(frame, []).append(action)
        return by_frame

    def at(self, frame: int) -> tuple[Action, ...]:
        """Return the actions of a frame."""
        return tuple(self._by_frame.get(frame, ()))

    def rewound(self, state: State) -> State:
        """Return the state to go on from when a tape repeats: at its end, the state to begin with."""
        return self.begun if state.frame >= self.frames else state

    def states(self) -> Iterator[State]:
        """Iterate the states of frames 0 … `frames`, as the window went through them."""
        state = self.begun
        yield state
        for frame in range(1, self.frames + 1):
            state = advance(state, self.at(frame))
            yield state

    def pictures(self, fps: float) -> Iterator[tuple[State, float]]:
        """Iterate (state, phase) at `fps` pictures a second; phases are exact between frames, too."""
        states = self.states()
        state, count = next(states), max(1, round(self.seconds * fps))
        for picture in range(count):
            time = picture * FRAMES_PER_SECOND / fps
            while state.frame < math.floor(time):
                state = next(states)
            yield state, state.phase_at(time)


def starting(state: State) -> State:
    """Return the state from which a tape starts: at frame 0, at the same phase, without effects."""
    state = leave(state) if state.game else state
    clock, sketch = state.clock.go(0, state.phase), state.sketch or state.building
    kept = {name: getattr(state, name) for name in ("shelf", "place", "look", "kept", "games")}
    if state.building:
        # when the tape opens the sheet again, this is the look to come back to
        before = state.building.look
        kept["look"] = replace(state.look, unit=before.unit, chart=before.chart)
    if sketch:
        clock, editing = clock.at_rate(0, sketch.clock.rate), sketch.editing
        modes = tuple(one for one in state.modes if one.is_help)
        return State(sketch.before, clock, editing=editing, modes=modes, **kept)
    modes = tuple(one for one in state.modes if one.edits_dimensions or one.is_help)
    return State(state.scene, clock, editing=state.editing, modes=modes, **kept)


def resumed(state: State) -> Iterator[Action]:
    """Yield the actions of a tape's frame 0 that restore the pencil's sketch, the sheet or a game."""
    if state.game:
        yield Action("play", state.game.words)
        return
    layers = state.of(Layering)
    if state.constructed:
        yield Action("construct", state.constructed)
    if layers:
        yield Action("layers")
        yield from (Action("layered", text) for text in [layers.text] if text)
        yield Action("slide", layers.lifted)
    if state.building:
        yield Action("draft", stored_text(state.building))
        if state.edits_dimensions:
            yield from (Action("numbers"), Action("choose", state.editing.chosen))
    if state.posing:
        yield from _resumed_poses(state.posing)
    sketch = state.drawing
    if sketch is None:
        return
    yield Action("pencil")
    answers = [one for one in sketch.answers if not isinstance(one, Scene)]
    if len(answers) < len(sketch.answers):
        yield Action("own_trace")
    elif sketch.curve:
        points = (part for point in sketch.curve.points for part in (float(point.real), float(point.imag)))
        yield Action("stroke", (float(sketch.curve.closed), *points))
    if answers:
        yield Action("cards", (0.0, *(number for one in answers for number in one.numbers)))
        yield Action("answer", sketch.chosen)
    if sketch.way:
        yield Action("way", (0.0, *(number for one in sketch.way for number in one.numbers)))
    if sketch.dial is not None:
        yield from (Action("dial", sketch.dial), Action("let_go"))
    for pivot, to in sketch.pivots:
        yield from (Action("grasp_pivot", pivot), Action("lead", to), Action("let_go"))
    yield from (Action("pen_to" if n else "pen_down", (at.real, at.imag)) for n, at in enumerate(sketch.pen))


def _resumed_poses(sketch: PoseSketch) -> Iterator[Action]:
    yield Action("poses")
    rows = (value for pose in sketch.poses for value in pose)
    if sketch.poses:
        yield Action("set_poses", (float(sketch.sliding), *rows))
    yield from (Action("set_pin", at) for at in sketch.pins)
    yield from (Action("theory") for _ in range(sketch.curves))
    yield Action("dial", (sketch.dial + LARGEST_DIAL) / (2 * LARGEST_DIAL))
    if sketch.answers:
        numbers = (number for one in sketch.answers for number in one.numbers)
        yield Action("cards", (float(sketch.chosen), *numbers))


def taped(actions: tuple[Action, ...]) -> tuple[Action, ...]:
    """Return the actions that belong on a tape: those that show in the picture."""
    return tuple(filter(is_taped, actions))


class Taping:
    """A tape that is being made: the state it starts from, and the actions from frame `since` on."""

    def __init__(self, state: State, size: tuple[int, int]) -> None:
        self._start, self.since, self._size = starting(state), state.frame, size
        self._actions: list[tuple[int, Action]] = [(0, action) for action in resumed(state)]

    def note(self, frame: int, actions: tuple[Action, ...]) -> None:
        """Keep the actions that came at a frame of the window."""
        self._actions.extend((frame - self.since, action) for action in taped(actions))

    def tape(self, frame: int) -> Tape:
        """Return the tape up to a frame of the window."""
        return Tape(self._start, frame - self.since, tuple(self._actions), self._size)
