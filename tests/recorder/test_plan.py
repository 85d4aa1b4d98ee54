from __future__ import annotations

import math
from fractions import Fraction

import numpy as np
import pytest

from linkanim.bounds import LARGEST_SIDE, MOST_FRAMES
from linkanim.errors import BadInput
from linkanim.recorder.plan import Clip, Format, make_plan, refuse_size

TURN = 2.0 * math.pi
RPM = TURN / 60.0


def at(
    rpm: float, fps: float = 25.0, periods: int = 1, *, seconds: float | None = None, reverse: bool = False
) -> Clip:
    return Clip(rpm * RPM, TURN, fps, periods, seconds, reverse)


# (reason, clip, format, frames, rate, length in seconds)
CUTS: list[tuple[str, Clip, Format, int, Fraction, float]] = [
    # delays that hundredths of a second can say: frames = round(period x fps)
    ("3 s at 25 fps", at(20), "gif", 75, Fraction(25), 3.0),
    ("4 s at 25 fps", at(15), "gif", 100, Fraction(25), 4.0),
    ("2 s at 50 fps", at(30, fps=50), "gif", 100, Fraction(50), 2.0),
    ("two periods", at(20, periods=2), "gif", 150, Fraction(25), 6.0),
    # delays they cannot: the one beside 1/fps that meets the length, else the nearer
    ("2 s at 30 fps: 3 cs would give 201 cs", at(30, fps=30), "gif", 50, Fraction(25), 2.0),
    ("3 s at 30 fps: 3 cs fits", at(20, fps=30), "gif", 100, Fraction(100, 3), 3.0),
    (
        "2.01 s at 30 fps: 3 cs fits, 4 cs would be short",
        at(60 / 2.01, fps=30),
        "gif",
        67,
        Fraction(100, 3),
        2.01,
    ),
    ("24 fps: 4 cs and 5 cs fit, 4 is nearer", at(20, fps=24), "gif", 75, Fraction(25), 3.0),
    ("15 fps: 6 cs and 7 cs fit, 7 is nearer", at(20, fps=15, seconds=2.1), "gif", 30, Fraction(100, 7), 2.1),
    ("60 fps: browsers slow down below 2 cs", at(20, fps=60), "gif", 150, Fraction(50), 3.0),
    ("3.01 s: no whole number of 4 cs", at(60 / 3.01), "gif", 75, Fraction(25), 3.0),
    # a length that need not close
    ("--seconds", at(20, seconds=2.0), "gif", 50, Fraction(25), 2.0),
    ("--seconds shorter than a frame's half", at(20, seconds=2.01), "gif", 50, Fraction(25), 2.0),
    # MP4: the rate makes the length exact
    ("3 s", at(20), "mp4", 75, Fraction(25), 3.0),
    ("3.01 s", at(60 / 3.01), "mp4", 75, Fraction(7500, 301), 3.01),
    ("a third of a second more", at(18), "mp4", 83, Fraction(249, 10), 10 / 3),
    ("30 fps", at(20, fps=30), "mp4", 90, Fraction(30), 3.0),
    ("--seconds keeps fps", at(20, seconds=2.01), "mp4", 50, Fraction(25), 2.0),
    # PNG: played at fps
    ("frames complete the period", at(60 / 3.01), "png", 75, Fraction(25), 3.0),
]


@pytest.mark.parametrize(("reason", "clip", "form", "frames", "rate", "seconds"), CUTS)
def test_frames_and_rate_are_chosen_together(
    reason: str, clip: Clip, form: Format, frames: int, rate: Fraction, seconds: float
) -> None:
    plan = make_plan(clip, form)
    assert (plan.frames, plan.rate) == (frames, rate)
    assert plan.seconds == pytest.approx(seconds, abs=1e-12)


@pytest.mark.parametrize("form", ["gif", "mp4", "png"])
@pytest.mark.parametrize("rpm", [7.3, -13.37, 20, -240])
@pytest.mark.parametrize("fps", [10, 23.976, 30])
@pytest.mark.parametrize("period", [TURN, 7 * TURN])
def test_a_clip_is_whole_periods_and_never_shows_one_phase_twice(
    form: Format, rpm: float, fps: float, period: float
) -> None:
    plan = make_plan(Clip(rpm * RPM, period, fps, periods=2), form)
    phases = [plan.phase(frame) for frame in range(plan.frames + 1)]
    step = phases[1]
    assert phases[0] == 0.0
    assert phases[-1] == math.copysign(2 * period, rpm)
    assert np.allclose(np.diff(phases), step, rtol=1e-9, atol=0.0)
    assert plan.speed * plan.seconds == pytest.approx(phases[-1], rel=1e-15)


def test_a_gif_misses_its_length_by_half_a_delay_at_most() -> None:
    for hundredths in range(100, 1000, 7):
        for fps in (10, 12.5, 15, 20, 24, 25, 30, 33.3, 40, 50):
            plan = make_plan(at(6000 / hundredths, fps=fps), "gif")
            delay = 100 / plan.rate
            assert delay == int(delay)
            assert abs(plan.frames * delay - hundredths) <= delay / 2


def test_an_mp4_is_as_long_as_its_period() -> None:
    for rpm in (7.3, 13.37, 19.99, 20, 33.3, 59.9):
        assert make_plan(at(rpm), "mp4").seconds == pytest.approx(60 / rpm, abs=1e-6)


def test_reverse_runs_the_phase_backwards() -> None:
    forth, back = make_plan(at(20), "gif"), make_plan(at(20, reverse=True), "gif")
    assert [back.phase(k) for k in range(75)] == [-forth.phase(k) for k in range(75)]
    assert back.speed == -forth.speed


def test_a_length_in_seconds_keeps_the_speed_exactly() -> None:
    plan = make_plan(at(-17.3, seconds=1.37), "gif")
    assert plan.speed == pytest.approx(-17.3 * RPM, rel=1e-15)
    assert not plan.closes


# (reason, clip, what the summary says of it)
SUMMARIES = [
    ("as asked", at(20), "75 frames at 25 fps, 3 s, one period at 20 rpm"),
    ("1 cs off is not said", at(60 / 3.01), "75 frames at 25 fps, 3 s, one period at 20 rpm"),
    (
        "2 cs off is",
        at(60 / 2.42),
        "60 frames at 25 fps, 2.4 s, one period at 25 rpm (24.79 rpm asked, 25 rpm recorded)",
    ),
    ("several periods", at(20, periods=3), "225 frames at 25 fps, 9 s, 3 periods of 3 s at 20 rpm"),
    ("clockwise", at(-20), "75 frames at 25 fps, 3 s, one period at -20 rpm"),
    ("--seconds", at(20, seconds=1.0), "25 frames at 25 fps, 1 s, not closed at 20 rpm"),
    (
        "--seconds off",
        at(20, seconds=1.02),
        "26 frames at 25 fps, 1.04 s, not closed at 20 rpm (1.02 s asked)",
    ),
    ("backwards", at(60 / 2.42, reverse=True), "(-24.79 rpm asked, -25 rpm recorded)"),
]


@pytest.mark.parametrize(("reason", "clip", "message"), SUMMARIES)
def test_the_summary_says_what_rounding_moved(reason: str, clip: Clip, message: str) -> None:
    summary = make_plan(clip, "gif").summary
    assert summary == message or ("backwards" in reason and summary.endswith(message))


# (clip, what the sentence names)
REFUSED = [
    (at(0), "speed of 0"),
    (at(math.inf), "inf"),
    (at(math.nan), "nan"),
    (at(20, fps=0), "0 frames a second"),
    (at(20, fps=-5), "-5 frames a second"),
    (at(20, fps=1e-9), "1e-09 frames a second"),
    (at(20, fps=math.inf), "inf frames a second"),
    (at(20, periods=0), "0 periods"),
    (at(20, seconds=0.0), "0 s"),
    (at(20, seconds=-1.0), "-1 s"),
    (at(20, seconds=math.nan), "nan s"),
    (at(20, seconds=0.001), "less than a frame"),
    (at(6000), "too short"),
    (at(1e300), "too short"),
    (at(1e-3), str(MOST_FRAMES)),
    (at(1e-300), str(MOST_FRAMES)),
    (at(20, periods=10**9), str(MOST_FRAMES)),
    (at(20, seconds=1e9), str(MOST_FRAMES)),
]


@pytest.mark.parametrize(("clip", "named"), REFUSED)
@pytest.mark.parametrize("form", ["gif", "mp4", "png"])
def test_absurd_clips_are_refused_in_a_sentence(clip: Clip, named: str, form: Format) -> None:
    with pytest.raises(BadInput, match=named):
        make_plan(clip, form)


# (reason, clip, how many frames it has, or None where they are too few)
FEWEST = [
    ("two frames a period are a motion to and fro", at(750), 2),
    ("one is none", at(1500), None),
    ("two in each of two periods", at(750, periods=2), 4),
    ("three in two periods", at(1000, periods=2), None),
    ("a clip that need not close may be a single picture", at(20, seconds=0.04), 1),
]


@pytest.mark.parametrize(("reason", "clip", "frames"), FEWEST)
@pytest.mark.parametrize("form", ["gif", "mp4", "png"])
def test_two_frames_a_period_are_the_fewest(
    reason: str, clip: Clip, frames: int | None, form: Format
) -> None:
    if frames is not None:
        assert make_plan(clip, form).frames == frames
        return
    with pytest.raises(BadInput, match="too short"):
        make_plan(clip, form)


@pytest.mark.parametrize("size", [(0, 720), (1280, 8), (16_385, 720), (1280, -1)])
def test_sizes_that_cannot_be_recorded_are_refused(size: tuple[int, int]) -> None:
    with pytest.raises(BadInput, match=f"{size[0]}x{size[1]}"):
        refuse_size(size)


def test_the_largest_picture_and_the_slowest_and_the_longest_clip_are_taken() -> None:
    assert make_plan(at(0.1, fps=0.01), "png").frames == 6
    refuse_size((LARGEST_SIDE, 16))
    assert make_plan(at(20, seconds=MOST_FRAMES / 25), "mp4").frames == MOST_FRAMES
    with pytest.raises(BadInput, match="more than 100000"):
        make_plan(at(20, seconds=(MOST_FRAMES + 1) / 25), "mp4")
