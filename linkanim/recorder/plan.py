"""How a clip is divided: how many frames, how long each stands, and at which phases."""

from __future__ import annotations

import math
from fractions import Fraction
from typing import Literal, NamedTuple

from linkanim.bounds import LARGEST_SIDE, MOST_FRAMES, MOST_PIXELS
from linkanim.errors import BadInput
from linkanim.frozen import frozen
from linkanim.units import rpm, short

Format = Literal["gif", "mp4", "png", "webm", "webp", "apng", "mov", "pdf"]

FEWEST_PER_PERIOD = 2
SIDES = (16, LARGEST_SIDE)
"""The smallest and the largest width or height, in pixels."""

RATES = (0.01, 1000)
"""The lowest and the highest number of frames a second."""

HOLD = 2
"""Seconds that the last step of a construction stands longer than the others."""
_CENTISECONDS = 100
_SHORTEST_DELAY = 2
"""Browsers show a delay of 1 cs as 10 cs."""
_FINEST = 10_000
"""Largest denominator of a clip's length in seconds; with `MOST_FRAMES` it keeps a rate within 32 bits."""


class Clip(NamedTuple):
    """The clip that is asked for: `speed` is dφ/dt (rad/s, signed), `period` the true period (rad of phase).

    `periods` true periods, or `seconds` where it is not None; `fps` frames a second; `start` is the first
    frame's phase (rad). With `steps` it shows that number of steps of a construction instead, a second each
    and the last one `HOLD` s longer; nothing moves.
    """

    speed: float
    period: float
    fps: float = 25.0
    periods: int = 1
    seconds: float | None = None
    reverse: bool = False
    start: float = 0.0
    steps: int = 0

    @property
    def length(self) -> float:
        """The length in seconds."""
        if self.steps:
            return float(self.steps + HOLD)
        return self.periods * self.period / abs(self.speed) if self.seconds is None else self.seconds


@frozen
class Plan:
    """The clip that is recorded: `frames` at `rate` frames a second divide `sweep` of phase (rad, signed).

    The frame after the last would be `sweep` further than the first: a whole number of true periods, if the
    clip `closes`.
    """

    frames: int
    rate: Fraction
    sweep: float
    clip: Clip
    closes: bool

    def phase(self, frame: int) -> float:
        """Return the phase (rad) of a frame; closed form, so the frames are equally spaced."""
        return self.clip.start + self.sweep * (frame / self.frames)

    def step(self, frame: int) -> int:
        """Return the number of the step that a frame shows, from 1."""
        return min(int(frame / self.rate), self.clip.steps - 1) + 1

    @property
    def seconds(self) -> float:
        """The clip's length as written."""
        return float(self.frames / self.rate)

    @property
    def speed(self) -> float:
        """The signed dφ/dt as recorded (rad/s)."""
        return self.sweep / self.seconds

    @property
    def summary(self) -> str:
        """The clip in words: frames, length, periods, speed; also what was asked, if over 1 cs off."""
        clip = f"{self.frames} frames at {short(float(self.rate))} fps, {short(self.seconds)} s"
        if self.clip.steps:
            return f"{clip}, {self.clip.steps} steps of a second"
        text = f"{clip}, {self._extent} at {rpm(self.speed)}"
        if abs(self.seconds - float(_requested_seconds(self.clip))) <= 0.01 + 1e-9:
            return text
        if not self.closes:
            return f"{text} ({short(self.clip.length)} s asked)"
        requested = rpm(math.copysign(self.clip.speed, self.speed))
        return f"{text} ({requested} asked, {rpm(self.speed)} recorded)"

    @property
    def _extent(self) -> str:
        if not self.closes:
            return "not closed"
        if self.clip.periods == 1:
            return "one period"
        return f"{self.clip.periods} periods of {short(self.clip.period / abs(self.speed))} s"


def make_plan(clip: Clip, form: Format) -> Plan:
    """Choose frames and rate together, so that frames / rate is the length asked for.

    GIF: the delay is in whole hundredths of a second, that neighbour of 1/fps which comes nearer to the
    length. PNG and PDF: at `fps`, at which frames are played. All others: frames = round(length x fps) at
    the exact rate frames / length. `BadInput` for a speed of zero, a number that is not finite, fewer than
    two frames a period, or more than `MOST_FRAMES`.
    """
    _refuse_nonsense(clip)
    frames, rate = _cut(_requested_seconds(clip), Fraction(clip.fps).limit_denominator(_FINEST), clip, form)
    _refuse_too_few(clip, frames)
    sign = -1.0 if clip.reverse else 1.0
    if clip.steps:
        sweep = 0.0
    elif clip.seconds is None:
        sweep = math.copysign(clip.period * clip.periods, clip.speed)
    else:
        sweep = clip.speed * float(frames / rate)
    return Plan(frames, rate, sign * sweep, clip, closes=clip.seconds is None)


def refuse_size(size: tuple[int, int], *, painted: bool = True) -> None:
    """Raise `BadInput` for a picture too small to read, too large to encode or, if `painted`, to hold."""
    low, high = SIDES
    width, height = size
    if not all(low <= side <= high for side in size):
        raise BadInput(
            f"a size of {width}x{height} cannot be drawn; both sides must be {low} to {high} pixels"
        )
    if painted and width * height > MOST_PIXELS:
        raise BadInput(
            f"a size of {width}x{height} has {width * height:,} pixels, more than are held at once; "
            f"{MOST_PIXELS:,} are the most, such as 7680x4320"
        )


def _requested_seconds(clip: Clip) -> Fraction:
    """Return the clip's length asked for, as the simplest fraction that a file can hold."""
    return Fraction(clip.length).limit_denominator(_FINEST)


def _cut(length: Fraction, fps: Fraction, clip: Clip, form: Format) -> tuple[int, Fraction]:
    """Return (frames, frames a second)."""
    if form == "gif":
        return _centiseconds(length * _CENTISECONDS, fps)
    frames = round(length * fps)
    exact = form not in ("png", "pdf") and clip.seconds is None and frames > 0
    return frames, frames / length if exact else fps


def _centiseconds(length: Fraction, fps: Fraction) -> tuple[int, Fraction]:
    """Return (frames, rate) of a GIF `length` hundredths of a second long."""
    ideal = _CENTISECONDS / fps
    delays = {max(round_(ideal), _SHORTEST_DELAY) for round_ in (math.floor, math.ceil)}

    def misses(delay: int) -> tuple[Fraction, Fraction]:
        return abs(round(length / delay) * delay - length), abs(delay - ideal)

    best = min(sorted(delays), key=misses)
    return round(length / best), Fraction(_CENTISECONDS, best)


def _refuse_nonsense(clip: Clip) -> None:
    """Raise `BadInput` for what is not a number of its kind, or makes a clip of absurd length."""
    if not math.isfinite(clip.speed) or clip.speed == 0.0:
        raise BadInput(f"a speed of {clip.speed:g} rad/s has no period to record; give one such as 30 rpm")
    slowest, fastest = RATES
    if not slowest <= clip.fps <= fastest:
        raise BadInput(
            f"{clip.fps:g} frames a second cannot be recorded; give {slowest} to {fastest}, such as 25"
        )
    if clip.periods < 1:
        raise BadInput(f"{clip.periods} periods cannot be recorded; give a whole number from 1")
    if clip.seconds is not None and not (math.isfinite(clip.seconds) and clip.seconds > 0.0):
        raise BadInput(f"{clip.seconds:g} s cannot be recorded; give a positive number of seconds")
    if clip.length * clip.fps > MOST_FRAMES:
        raise BadInput(
            f"{short(clip.length)} s at {short(clip.fps)} fps are {short(clip.length * clip.fps)} frames,"
            f" more than {MOST_FRAMES}; raise the speed, or lower the frames a second or the length"
        )


def _refuse_too_few(clip: Clip, frames: int) -> None:
    """Raise `BadInput` where frames are so few that no motion can be seen."""
    if clip.seconds is None and not clip.steps and frames < FEWEST_PER_PERIOD * clip.periods:
        period = clip.period / abs(clip.speed)
        raise BadInput(
            f"one period at {rpm(clip.speed)} lasts {short(period)} s, too short for"
            f" {FEWEST_PER_PERIOD} frames at {short(clip.fps)} fps;"
            " lower the speed, or raise the frames a second"
        )
    if frames < 1:
        raise BadInput(
            f"{short(clip.length)} s at {short(clip.fps)} fps is less than a frame; ask for longer"
        )
