"""Follow: turn the crank so that the ram stays between two lines on paper that scrolls by.

The track says where the ram has to be along the paper; it is made from the scene's own motion.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import replace
from functools import lru_cache
from math import radians
from random import Random
from typing import Literal
from zlib import crc32

import numpy as np
from numpy.typing import NDArray

from linkanim.errors import BadInput
from linkanim.frozen import frozen
from linkanim.mechanics.linkage import Point
from linkanim.mechanics.measures import output_slider
from linkanim.picture.drawn import Addition
from linkanim.picture.game_panel import Choice, GamePanel, ScoreBar
from linkanim.picture.look import Look
from linkanim.picture.marks import BEYOND, Lane
from linkanim.play.games import GameWords, begun
from linkanim.player.action import Action
from linkanim.player.actions import play, with_scene
from linkanim.player.clock import FRAMES_PER_SECOND
from linkanim.player.state import (
    Game,
    State,
    with_effect,
)
from linkanim.scenes import load, names
from linkanim.scenes.editing import in_unit
from linkanim.scenes.scene import Scene
from linkanim.units import shown
from linkanim.words import said, said_as, to_say

# A track: where a ram has to be along the paper that scrolls by, made from the scene's own motion.

LENGTH = 4_500
"""The length of the paper, in mm."""
LEVELS = 3
_HALF_WIDTHS = (0.11, 0.075, 0.05)
"""Half the space between the lines, in strokes, by level."""
_LEAD = 60
_HALF_TURN = 150
"""The paper, in mm, that goes by before the ram has to move, and while a steady crank makes half a turn."""
_SLOWEST, _FASTEST = 260, 130
"""The most and the least paper, in mm, for one stroke at a steady speed of the ram."""
_RESTS = (40, 90)
_ROUND = 25
"""How far before and behind a corner of the track is made round, in mm."""
_SAMPLES = 1_440


@frozen
class RamTrack:
    """Where the ram of a scene has to be at each mm of the paper: 0 at its back dead centre, 1 forward.

    The mechanism begins at phase 0. `back` and `forward` are the ram's places at its dead
    centres, in the scene's unit; `limits` its travel there.
    """

    places: tuple[float, ...]
    half_width: float
    body: str
    limits: tuple[float, float]
    back: Point
    forward: Point

    def at(self, paper: float) -> float:
        """Return where the ram has to be at a place of the paper (mm)."""
        sample = min(max(paper, 0.0), len(self.places) - 1.001)
        first = int(sample)
        low, high = self.places[first : first + 2]
        return low + (sample - first) * (high - low)

    def share(self, scene: Scene, phase: float) -> float:
        """Return where the ram is at a phase of the scene: 0 at its back dead centre, 1 forward."""
        low, high = self.limits
        return (float(scene.pose(phase, 0).travel[self.body]) - low) / (high - low)


def is_track(scene: Scene) -> bool:
    """Whether a scene has a ram that a crank moves to and fro."""
    ram = output_slider(scene.linkage)
    return ram is not None and ram.slider != scene.linkage.drive.joint and scene.info.dead_centres is not None


@lru_cache(maxsize=1)
def tracks() -> tuple[str, ...]:
    """Return the scenes of the catalogue that are tracks."""
    return tuple(name for name in names() if is_track(load(name)))


@lru_cache(maxsize=2)
def track_of(name: str, level: int) -> RamTrack:
    """Return a scene's track at a level of `LEVELS`; it is always the same."""
    scene = load(name)
    ram, ends = output_slider(scene.linkage), scene.info.dead_centres
    assert ram
    assert ram.slider
    assert ends
    back, forward = (scene.pose(phase, 0) for phase in ends)
    low, high = float(back.travel[ram.name]), float(forward.travel[ram.name])
    motion = scene.solve(phase=np.arange(_SAMPLES) * (scene.period / _SAMPLES), derivatives=0)
    cycle = (np.asarray(motion.travel[ram.name]) - low) / (high - low)
    random = Random(crc32(f"{name} {level}".encode()))
    places = _places(cycle, scene, random)
    return RamTrack(
        places,
        _HALF_WIDTHS[level - 1],
        ram.name,
        (low, high),
        back.position[ram.slider],
        forward.position[ram.slider],
    )


def _places(cycle: NDArray[np.float64], scene: Scene, random: Random) -> tuple[float, ...]:
    """Return the places of a whole track, from where the ram is at phase 0."""
    places = [float(cycle[0])] * _LEAD
    places += _turning(cycle, scene, 0.0, 2)
    while len(places) <= LENGTH + 2 * _ROUND:
        places += _stretch(places[-1], cycle, scene, random)
    weights = np.hanning(2 * _ROUND + 3)[1:-1]
    rounded = np.convolve([places[0]] * _ROUND + places, weights / weights.sum(), "valid")
    return tuple(np.clip(rounded[: LENGTH + 1], 0.0, 1.0).tolist())


def _stretch(place: float, cycle: NDArray[np.float64], scene: Scene, random: Random) -> Iterator[float]:
    """Yield the places of the next stretch: half turns of a steady crank, a steady stroke, or a rest."""
    kind = random.choice(("turn", "turn", "stroke", "stroke", "rest"))
    if kind == "rest":
        yield from [place] * random.randint(*_RESTS)
    elif kind == "stroke":
        end = random.uniform(0.55, 0.97) if place < 0.5 else random.uniform(0.03, 0.45)
        count = max(round(abs(end - place) * random.uniform(_FASTEST, _SLOWEST)), 8)
        yield from (place + (end - place) * n / count for n in range(1, count + 1))
    else:
        near = int(np.abs(cycle - place).argmin()) * (scene.period / _SAMPLES)
        yield from _turning(cycle, scene, near, random.randint(1, 3))


def _turning(cycle: NDArray[np.float64], scene: Scene, phase: float, halves: int) -> list[float]:
    """Return the ram's places while a steady crank makes some half turns from a phase."""
    phases = phase + math.pi / _HALF_TURN * np.arange(1, halves * _HALF_TURN + 1)
    known = np.arange(_SAMPLES + 1) * (scene.period / _SAMPLES)
    places: list[float] = np.interp(phases % scene.period, known, np.append(cycle, cycle[0])).tolist()
    return places


# Follow: turn the crank so that the ram stays between two lines on paper that scrolls by.

Stage = Literal["ready", "counts", "runs", "over"]

_PAPER = (1_000, 1_200, 1_400)
"""How far the paper scrolls in a frame as it begins, in thousandths of a mm, by level."""
_FASTER_EACH, _MOST = 6, 700
"""The frames after which it scrolls by a thousandth more, and the most that it gains, in thousandths."""
_COUNTED = 3 * FRAMES_PER_SECOND
"""The frames of the count 3, 2, 1 before the paper scrolls: a second each."""
_SLACK = 3 * FRAMES_PER_SECOND
"""The number of frames, in all, for which the ram may be outside its lines."""
_NOTCH = radians(0.4)
"""How far the crank turns in a frame at the first notch of the arrow keys."""
_NOTCHES = 12
_COARSE = 3
_AHEAD, _BEHIND, _EVERY = 200, 40, 4
"""How much paper is visible ahead of the ram and behind it, and the step of its points, in mm."""
_WIDTHS = (to_say("wide, slow"), to_say("narrower, faster"), to_say("narrow, fast"))
_FIRST = "slider-crank"
CONTROLS = {
    to_say("drag the crank pin"): to_say("turn it; the first turn starts the count"),
    "← →": to_say("slower, faster (Shift: three steps)"),
    "Space": to_say("stop"),
    "↑ ↓": to_say("another track, before and after a run"),
    "1–3": to_say("wide, narrower, narrow, likewise"),
}
"""What a hand can do, as the manual has it."""
_HINT = to_say("drag the crank pin   ← → slower, faster   Space stops")


@frozen
class FollowRun(Game):
    """A run along a scene's track: how much paper has gone by, and on how much the ram kept to its lines.

    `paper` and `passed` count thousandths of a mm, `frames` and `outside` frames, `counted` the frames of the
    count before the run; `notch` is how fast the arrow keys turn the crank.
    """

    scene: str
    level: int
    stage: Stage = "ready"
    frames: int = 0
    paper: int = 0
    passed: int = 0
    outside: int = 0
    counted: int = 0
    notch: int = 0
    phase: float = 0.0
    best: int = 0
    """The best score so far, in mm."""
    is_within: bool = True

    @property
    def words(self) -> str:
        """The words that begin the run again from here."""
        fields = {name: value for name, value in vars(self).items() if name != "is_within"}
        return str(GameWords("follow", {}).having(**fields))

    @property
    def track(self) -> RamTrack:
        """The track that the ram has to follow."""
        return track_of(self.scene, self.level)

    @property
    def metres(self) -> float:
        """The score: the length of paper on which the ram kept between the lines, in m."""
        return self.passed / 1e6

    def entered(self, state: State) -> State:
        """Return the state with the scene at rest at the run's phase."""
        look = Look(hud=False, trace=False, theme=state.look.theme, unit=state.look.unit)
        state = with_scene(replace(state, look=look), load(self.scene), self.phase, paused=True)
        lane = self._lane(state)
        back, forward = complex(*lane.back), complex(*lane.forward)
        beyond = max(lane.half_width, BEYOND) * (forward - back)
        return replace(state, also=(back - beyond, forward + beyond))

    def carried(self, state: State, action: Action) -> State:
        """Turn the crank; before and after a run choose another track, or another level."""
        match action:
            case Action("back"):
                return play(state, "lobby row=2")
            case Action("scrub", float() | int() as phase):
                return self._turned(state, float(phase), 0)
            case Action("turn", int() as steps) if self.stage != "over":
                step = 1 if steps > 0 else -1
                notch = self.notch + step * (_COARSE if abs(steps) > 1 else 1)
                return self._turned(state, state.phase, min(max(notch, -_NOTCHES), _NOTCHES))
            case Action("next"):
                return self._begun(state) if self.stage == "over" else self._turned(state, state.phase, 0)
            case Action("raise", int() as further) if self.stage in ("ready", "over"):
                known = tracks()
                place = known.index(self.scene) if self.scene in known else 0
                step = 1 if further > 0 else -1
                return replace(self, scene=known[(place - step) % len(known)])._begun(state)
            case Action("option", int() as level) if self.stage in ("ready", "over") and 0 <= level < LEVELS:
                return replace(self, level=level + 1)._begun(state)
        return state

    def _turned(self, state: State, phase: float, notch: int) -> State:
        """Return the state with the crank at a phase; the first turn starts the count."""
        if self.stage == "over":
            return state
        stage: Stage = "counts" if self.stage == "ready" else self.stage
        game = replace(self, stage=stage, notch=notch, phase=phase)
        return replace(state.with_mode(game), clock=state.clock.go(state.frame, phase, paused=True))

    def _begun(self, state: State) -> State:
        return begun(state, "follow", scene=self.scene, level=self.level)

    def aged(self, state: State) -> State:
        """Let the paper scroll, and check whether the ram is between its lines, unless the help is open."""
        if self.stage not in ("counts", "runs") or state.help:
            return state
        sense = 1 if state.scene.linkage.drive.speed > 0 else -1
        phase = state.phase + sense * self.notch * _NOTCH
        clock = state.clock.go(state.frame, phase, paused=True)
        if self.stage == "counts":
            game = replace(self, counted=self.counted + 1, phase=phase)
            starts = game.counted >= _COUNTED
            state = state.with_mode(replace(game, stage="runs") if starts else game)
            return replace(state, clock=clock)
        paper = self.paper + _PAPER[self.level - 1] + min(self.frames // _FASTER_EACH, _MOST)
        track = self.track
        off = track.share(state.scene, phase) - track.at(paper / 1e3)
        within = abs(off) <= track.half_width
        game = replace(
            self,
            frames=self.frames + 1,
            paper=paper,
            passed=self.passed + within * (paper - self.paper),
            outside=self.outside + (not within),
            phase=phase,
            is_within=within,
        )
        state = replace(state, clock=clock)
        if game.outside >= _SLACK or paper >= 1_000 * LENGTH:
            return game._ended(state)
        return state.with_mode(game)

    def _ended(self, state: State) -> State:
        """Return the state with the run over, and its score as an effect."""
        kept = f"best={self.kept_as}:{self.passed // 1_000}"
        state = with_effect(state, "score", kept)
        return state.with_mode(replace(self, stage="over", notch=0))

    @property
    def kept_as(self) -> str:
        """The name under which its best score is stored."""
        return f"follow-{self.scene}.{self.level}"

    @property
    def is_whole(self) -> bool:
        """Whether the run came to the end of the paper, before its time was up."""
        return self.paper >= 1_000 * LENGTH

    def drawn(self, state: State) -> tuple[Addition, ...]:
        """Return the paper ahead of the ram."""
        return (self._lane(state),)

    def panel(self, state: State) -> GamePanel:
        """Return the score."""
        remaining = 1.0 - self.outside / _SLACK
        bars = (
            ScoreBar(said("between the lines"), f"{self.metres:.2f} m", self.passed / (1e3 * LENGTH)),
            ScoreBar(said("slack"), f"{max(_SLACK - self.outside, 0) / FRAMES_PER_SECOND:.1f} s", remaining),
        )
        choices = tuple(Choice(f"{n}", said(words)) for n, words in enumerate(_WIDTHS, 1))
        best = said("best {score}", score=f"{self.best / 1e3:.2f} m")
        runs, counts = self.stage in ("counts", "runs"), self.stage == "counts"
        left_to_count = -((self.counted - _COUNTED) // FRAMES_PER_SECOND)
        return GamePanel(
            f"{left_to_count}" if counts else said_as("game", "Follow"),
            scores=(said(state.scene.title), *([best] if self.best > 0 else [])),
            lines=() if runs and not counts else (said("Keep the ram between the two lines."),),
            choices=() if runs else choices,
            bars=bars,
            verdict=self._verdict if self.stage == "over" else "",
            well=self.is_whole,
            lines_after=(said(state.scene.look_at),) if not runs and state.scene.look_at else (),
            hint=said(_HINT if runs else _AGAIN[self.stage]),
            large=counts,
            chosen=None if runs else self.level - 1,
        )

    @property
    def _verdict(self) -> str:
        best = self.passed // 1_000 > self.best
        end = said("to the end of the paper") if self.is_whole else said("then its time was up")
        known = {"length": f"{self.metres:.2f} m", "end": end}
        if best:
            return said("{length}, {end}; the best so far", **known)
        return said("{length}, {end}; the best was {best} m", **known, best=f"{self.best / 1e3:.2f}")

    def _lane(self, state: State) -> Lane:
        """Return the two lines about the ram, in the shown unit."""
        track, paper = self.track, self.paper / 1e3
        first = int(paper - _BEHIND) // _EVERY * _EVERY
        middle = tuple(
            ((at - paper) / _AHEAD, track.at(at)) for at in range(first, int(paper) + _AHEAD + 1, _EVERY)
        )
        factor = in_unit(state.scene, state.look.unit).linkage.metre ** -1 * state.scene.linkage.metre
        back, forward = ((factor * place[0], factor * place[1]) for place in (track.back, track.forward))
        return Lane(back, forward, middle, track.half_width, self.is_within)


_AGAIN = {
    "ready": to_say("turn the crank: it starts   ↑ ↓ another track   Esc out"),
    "over": to_say("Enter again   ↑ ↓ another track   Esc out"),
}


def read(words: GameWords) -> FollowRun:
    """Return the run that words begin; BadInput where they do not."""
    scene = words.text("scene", _FIRST)
    if scene not in tracks():
        raise BadInput(f"follow: scene={shown(scene)} is no track; there are {', '.join(tracks())}")
    known: tuple[Stage, ...] = ("counts", "runs", "over")
    return FollowRun(
        scene,
        words.whole("level", 1, 1, LEVELS),
        next((stage for stage in known if stage == words.text("stage")), "ready"),
        notch=words.whole("notch", 0, -_NOTCHES, _NOTCHES),
        phase=_number(words.text("phase", "0.0")),
        **{name: words.whole(name) for name in ("frames", "paper", "passed", "outside", "counted", "best")},  # type: ignore[arg-type]
    )


def _number(text: str) -> float:
    with suppress(ValueError):
        if abs(value := float(text)) <= 1e9:
            return value
    raise BadInput(f"follow: phase={shown(text)} is no angle in radians")
