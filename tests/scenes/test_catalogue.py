"""Every scene of the catalogue runs: it closes, it comes back, and there is something to watch."""

from __future__ import annotations

import math

import numpy as np
import pytest
from numpy.typing import NDArray

from linkanim.mechanics.groups import GroupPoint
from linkanim.mechanics.linkage import RPR, RRP, RRR, Crank, Rigid
from linkanim.mechanics.motion import Motion
from linkanim.scenes import load, names
from linkanim.scenes.files import titles
from linkanim.scenes.scene import Scene

STEPS = 720
# what stands upright, as it does in the world or so that its line lies level
UPRIGHT = (
    "press", "engine", "toggle-press", "hoecken", "roberts-line", "evans", "quick-return-press", "watt-1",
    "stephenson-3", "scissor-lift", "landing-gear", "excavator", "andrews",
    "knee-cylinder",
)  # fmt: skip


@pytest.fixture(params=names())
def scene(request: pytest.FixtureRequest) -> Scene:
    return load(request.param)


def lengths(scene: Scene) -> list[float]:
    found: list[float] = []
    for joint in scene.linkage.joints:
        match joint:
            case RRR(lengths=both):
                found += both
            case Crank(length=length) | RRP(length=length) | RPR(length=length):
                found.append(length)
            case GroupPoint(bars=bars):
                found += (length for _, length in bars)
    return found


def places(motion: Motion) -> NDArray[np.float64]:
    """Return all joints' places, (joints, steps, 2)."""
    return np.stack([np.asarray(motion.position[name]) for name in motion.position])


def distance(motion: Motion, first: str, second: str) -> NDArray[np.float64]:
    apart = np.asarray(motion.position[first]) - np.asarray(motion.position[second])
    return np.hypot(apart[..., 0], apart[..., 1])


def bars(scene: Scene) -> list[tuple[str, str, float]]:
    """Return every bar: its ends and its length."""
    found = []
    for joint in scene.linkage.joints:
        match joint:
            case RRR(name=name, ends=ends, lengths=both):
                found += [(end, name, length) for end, length in zip(ends, both, strict=True)]
            case Crank(name=name, pivot=end, length=length) | RRP(name=name, end=end, length=length):
                found.append((end, name, length))
            case Rigid(name=name, on=(end, _), at=at):
                found.append((end, name, math.hypot(*at)))
            case GroupPoint(name=name, group=group):
                for link in group.at_point(name):
                    others = (end for end in link.points if end != name)
                    found += ((end, name, abs(link.place(end) - link.place(name))) for end in others)
    return found


def test_every_bar_keeps_its_length_over_the_true_period(scene: Scene) -> None:
    motion, longest = scene.cycle(STEPS), max(lengths(scene))
    for start, end, length in bars(scene):
        assert np.max(np.abs(distance(motion, start, end) - length)) <= 1e-14 * longest, (start, end)


def test_every_joint_is_back_after_the_true_period(scene: Scene) -> None:
    first, last = scene.solve(phase=0.3), scene.solve(phase=0.3 + scene.period)
    assert np.max(np.abs(places(first) - places(last))) <= 1e-13 * max(lengths(scene))


def test_the_motion_has_no_jump(scene: Scene) -> None:
    def roughness(steps: int) -> float:
        way = places(scene.cycle(steps))
        bend = np.roll(way, -1, axis=1) - 2 * way + np.roll(way, 1, axis=1)
        return float(np.max(np.abs(bend)))

    # A jump stays as it is however small the step; a smooth way's second difference falls with its square.
    assert roughness(4 * STEPS) < roughness(STEPS) / 12


def test_a_loop_reads_well_on_a_slide(scene: Scene) -> None:
    assert 2.0 <= scene.period / abs(scene.linkage.drive.speed) <= 5.0


def test_no_bar_is_lost_beside_the_longest(scene: Scene) -> None:
    assert min(lengths(scene)) >= max(lengths(scene)) / 10


def test_what_is_traced_covers_a_good_part_of_the_picture(scene: Scene) -> None:
    motion = scene.cycle(STEPS)
    whole = np.ptp(places(motion).reshape(-1, 2), axis=0)
    spans = [np.ptp(np.asarray(motion.position[name]), axis=0) for name in scene.trace]
    # The squeezer's spring, which is as published, reaches far beyond what moves.
    least = 0.14 if scene.name == "andrews" else 0.15
    assert max(float(np.max(span)) for span in spans) >= least * float(np.max(whole))


def test_what_moves_fits_a_wide_picture(scene: Scene) -> None:
    width, height = np.ptp(places(scene.cycle(STEPS)).reshape(-1, 2), axis=0)
    if scene.name == "parallel-locomotive":
        # its wheels reach beyond its joints
        width, height = width + 2 * (64 - 34), 2 * 64.0
    assert (0.4 if scene.name in UPRIGHT else 0.95) <= width / height <= 2.2


def test_the_four_kinds_of_triple_rocker_are_there() -> None:
    # The longest link decides: a limit is outward where the input cannot point away from the other pivot.
    longest = {
        "triple-rocker": "ground",
        "triple-rocker-out-in": "crank",
        "triple-rocker-in-in": "coupler",
        "triple-rocker-in-out": "rocker",
    }
    for name, link in longest.items():
        bar = {key: load(name).document["four-bar"][key] for key in ("ground", "crank", "coupler", "rocker")}
        shortest, *others = sorted(bar.values())
        assert max(bar, key=lambda key: bar[key]) == link
        assert shortest + others[-1] > sum(others[:-1])
        assert bar[link] < sum(bar.values()) - bar[link]


def test_each_title_is_its_own() -> None:
    assert len(set(titles().values())) == len(names())


def test_each_scene_names_its_source(scene: Scene) -> None:
    assert len(scene.source) > 20


def test_each_scene_says_in_a_sentence_what_to_look_at(scene: Scene) -> None:
    assert 40 <= len(scene.look_at) <= 140
    assert scene.look_at[0].isupper()
    assert scene.look_at.endswith(".")
    assert scene.trace


def test_what_no_source_gives_is_said_to_be_chosen(scene: Scene) -> None:
    published = ("jansen", "klann", "andrews", "stephenson-3-link6", "double-butterfly")
    assert (scene.name in published) != ("chosen here" in scene.source)


def test_the_press_says_what_the_report_does_not() -> None:
    assert "chosen here" in load("press").source
