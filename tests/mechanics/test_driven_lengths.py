"""A slide, or a cylinder, drives links that are solved together as seventy digits say."""

from __future__ import annotations

import math
import random
from collections.abc import Mapping
from itertools import combinations
from typing import Any

import mpmath as mp
import numpy as np
import pytest

from linkanim.errors import AssemblyError, BadInput
from linkanim.mechanics.forces import input_effort
from linkanim.scenes.editing import phase_along, phase_towards
from linkanim.scenes.reading import scene_from
from linkanim.scenes.scene import Scene

KNEE: dict[str, Any] = {
    "points": {"O": [0, 0], "K": [60, 200], "B": [0, 400], "P": [90, 60], "Q": [90, 330]},
    "links": {"ground": ["O"], "lower": ["O", "K", "P"], "upper": ["K", "B", "Q"], "ram": ["B"]},
    "slides": {"guide": {"link": "ram", "on": "ground", "angle": "90 deg"}},
    "drive": {"cylinder": {"between": ["P", "Q"], "from": 200, "to": 270}, "speed": "30 mm/s"},
}
RACK: dict[str, Any] = {
    "points": {
        "L": [-600, 0],
        "R": [600, 0],
        "A": [-540, -150],
        "B": [540, -150],
        "C": [-250, -120],
        "D": [250, -120],
    },
    "links": {
        "ground": ["L", "R"],
        "left": ["L", "A"],
        "right": ["R", "B"],
        "rack": ["C", "D"],
        "tie": ["A", "C"],
        "other tie": ["D", "B"],
    },
    "slides": {"guide": {"link": "rack", "on": "ground"}},
    "drive": {"slide": "guide", "from": 290, "to": 410, "speed": "80 mm/s"},
}
DRAG_LINK: dict[str, Any] = {
    "points": {
        "L": [-600, 0],
        "R": [600, 0],
        "A": [-540, -150],
        "B": [540, -150],
        "S": [30, -170],
        "C": [-200, -260],
    },
    "links": {
        "ground": ["L", "R"],
        "left": ["L", "A"],
        "right": ["R", "B"],
        "drag": ["A", "B", "S"],
        "rod": ["S", "C"],
        "block": ["C"],
    },
    "slides": {"guide": {"link": "block", "on": "ground"}},
    "drive": {"slide": "guide", "from": 440, "to": 360},
}
LIFT: dict[str, Any] = {
    "points": {
        "O": [0, 0],
        "S": [300, 0],
        "M": [150, 100],
        "T": [300, 200],
        "U": [0, 200],
        "V": [380, 200],
        "X": [75, 30],
        "Y": [105, 150],
    },
    "links": {
        "ground": ["O"],
        "arm": ["O", "M", "T", "X"],
        "other arm": ["S", "M", "U", "Y"],
        "plate": ["U", "V"],
        "block": ["S"],
    },
    "slides": {
        "guide": {"link": "block", "on": "ground"},
        "slot": {"point": "T", "on": "plate", "angle": "0 deg"},
    },
    "drive": {"cylinder": {"between": ["X", "Y"], "from": 110, "to": 140}},
}
BARREL: dict[str, Any] = {
    **KNEE,
    "points": {**KNEE["points"], "S": [90, 200]},
    "links": {**KNEE["links"], "barrel": ["P", "S"], "rod": ["Q"]},
    "slides": {**KNEE["slides"], "piston": {"link": "rod", "on": "barrel", "angle": "90 deg"}},
    "drive": {"slide": "piston", "from": 200, "to": 270},
}
LINKAGES = {
    "a knee's cylinder": KNEE,
    "the same as barrel and rod": BARREL,
    "a rack with two pins": RACK,
    "a drag link held at three places": DRAG_LINK,
    "a lift with its cylinder between its arms": LIFT,
}


DIGITS = 70


def read(document: Mapping[str, Any]) -> Scene:
    return scene_from({"length_unit": "mm", **document}, name="my", where="my.toml")


def turned(slide: Mapping[str, Any]) -> Any:
    return mp.expj(mp.radians(int(slide.get("angle", "0").split()[0])))


class Bars:
    """The places of a linkage's points for a length of its input, by Newton's method in seventy digits."""

    def __init__(self, document: Mapping[str, Any]) -> None:
        self.start = {name: mp.mpc(*place) for name, place in document["points"].items()}
        links, drive, slides = document["links"], document["drive"], document.get("slides", {})
        fixed = links["ground"]
        self.free = [name for name in self.start if name not in fixed]
        spans = [pair for on in links.values() if on is not fixed for pair in combinations(on, 2)]
        with mp.workdps(DIGITS):
            self.spans = [(p, q, abs(self.start[p] - self.start[q])) for p, q in spans]
        if "cylinder" in drive:
            self.ends = tuple(drive["cylinder"]["between"])
        elif slides[drive["slide"]]["on"] != "ground":
            self.ends = "P", "Q"
        else:
            self.ends = ()
            self.rack = links[slides[drive["slide"]]["link"]][0]
            self.zero = self.start[fixed[0]].real
        # each point that slides keeps its distance from a line through the first point of what carries that
        with mp.workdps(DIGITS):
            self.lines = [
                (name, [*links[slide["on"]][:2]] if slide["on"] != "ground" else [], turned(slide))
                for slide in slides.values()
                for name in ([slide["point"]] if "point" in slide else links[slide["link"]])
            ]

    def aside(self, at: Mapping[str, Any], name: str, on: list[str], along: Any) -> Any:
        if not on:
            return (at[name] * mp.conj(along)).imag
        first, second = on
        turned = (at[second] - at[first]) / (self.start[second] - self.start[first])
        return ((at[name] - at[first]) * mp.conj(along * turned)).imag

    def off(self, at: Mapping[str, Any], length: Any) -> list[Any]:
        found = [abs(at[p] - at[q]) - far for p, q, far in self.spans]
        found += [self.aside(at, *line) - self.aside(self.start, *line) for line in self.lines]
        return [*found, self.length(at) - length]

    def length(self, at: Mapping[str, Any]) -> Any:
        """Return how long the cylinder is, or how far the rack has gone."""
        return abs(at[self.ends[0]] - at[self.ends[1]]) if self.ends else at[self.rack].real - self.zero

    def closed(self, length: Any, near: Mapping[str, Any]) -> dict[str, Any]:
        """Return all places near some, by Newton's method; its derivatives are differences of tiny steps."""
        at, tiny = dict(near), mp.mpf(10) ** -40
        for _ in range(12):
            rows = self.off(at, length)
            matrix = mp.zeros(len(rows), 2 * len(self.free))
            for n, name in enumerate(self.free):
                for k, way in enumerate((tiny, 1j * tiny)):
                    moved = self.off({**at, name: at[name] + way}, length)
                    for row, (one, other) in enumerate(zip(moved, rows, strict=True)):
                        matrix[row, 2 * n + k] = (one - other) / tiny
            step = mp.lu_solve(matrix, -mp.matrix(rows))
            for n, name in enumerate(self.free):
                at[name] += mp.mpc(step[2 * n], step[2 * n + 1])
            if mp.norm(step) < mp.mpf(10) ** -62:
                break
        return at

    def rates(
        self, length: Any, at: Mapping[str, Any], h: Any = 1e-13
    ) -> tuple[dict[str, Any], dict[str, Any]]:
        """Return the first and the second derivatives of all places by the length, by differences."""
        less, more = (self.closed(length + way, at) for way in (-h, h))
        first = {name: (more[name] - less[name]) / (2 * h) for name in self.free}
        second = {name: (more[name] - 2 * at[name] + less[name]) / (h * h) for name in self.free}
        return first, second


def ends_of(document: Mapping[str, Any]) -> tuple[float, float]:
    table = document["drive"].get("cylinder", document["drive"])
    return table["from"], table["to"]


@pytest.mark.slow
@pytest.mark.parametrize("document", LINKAGES.values(), ids=LINKAGES)
def test_it_moves_as_seventy_digits_say_also_at_its_ends(document: Mapping[str, Any]) -> None:
    scene, bars = read(document), Bars(document)
    first, last = ends_of(document)
    phases = np.array([0.0, 1e-9, 0.4, 1.3, 2.0, 3.1, math.pi, 4.0, 6.0])
    found, by_length = (one := scene.solve(phase=phases, speed=1.0)), one.per_input
    cycle = scene.cycle(200)
    size = float(np.ptp(np.concatenate([*cycle.position.values()]), axis=0).max())
    with mp.workdps(DIGITS):
        for n, phase in enumerate(map(mp.mpf, phases)):
            half = (mp.mpf(last) - first) / 2
            length, rate, bend = (
                first + half * (1 - mp.cos(phase)),
                half * mp.sin(phase),
                half * mp.cos(phase),
            )
            assert float(found.coordinate[n]) == pytest.approx(float(length), rel=4e-16)
            near = {name: mp.mpc(*map(float, found.position[name][n])) for name in bars.start}
            at = bars.closed(length, near)
            once, twice = bars.rates(length, at)
            scales = (max(abs(one[name]) for name in bars.free) for one in (once, twice))
            steep, bent = map(float, scales)
            for name in bars.free:
                true = at[name], once[name] * rate, twice[name] * rate**2 + once[name] * bend
                shown = found.position[name][n], found.velocity[name][n], found.acceleration[name][n]
                fast = abs(float(half)) * steep + float(half) ** 2 * bent
                for own, solved, scale in zip(true, shown, (size, fast, fast), strict=True):
                    off = abs(own - mp.mpc(*map(float, solved)))
                    assert off <= 1e-14 * max(scale, size), (name, phase, off)
                slopes = by_length.velocity[name][n], by_length.acceleration[name][n]
                for own, solved, scale in zip((once[name], twice[name]), slopes, (steep, bent), strict=True):
                    assert abs(own - mp.mpc(*map(float, solved))) <= 1e-12 * max(scale, 1.0), (name, phase)


@pytest.mark.parametrize("document", LINKAGES.values(), ids=LINKAGES)
def test_it_goes_forth_and_back_without_a_jump(document: Mapping[str, Any]) -> None:
    scene = read(document)
    assert scene.info.true_period == 1
    cycle = scene.cycle(2000)
    for name, place in cycle.position.items():
        steps = np.hypot(*np.diff(np.vstack([place, place[:1]]), axis=0).T)
        speeds = np.hypot(*cycle.velocity[name].T) / scene.linkage.drive.speed * scene.period / 2000
        assert (steps <= 1.5 * np.maximum(speeds, np.roll(speeds, -1)) + 1e-3).all()
        assert np.abs(place[1:] - place[:0:-1]).max() < 1e-12 * 600


def test_barrel_and_rod_are_the_cylinder() -> None:
    phases = np.linspace(0, 6, 20)
    one, other = (read(each).solve(phase=phases, speed=1.0) for each in (KNEE, BARREL))
    for name in "KBPQ":
        for kind in ("position", "velocity", "acceleration"):
            apart = getattr(one, kind)[name] - getattr(other, kind)[name]
            assert np.abs(apart).max() < 1e-12 * 400


class ByArm(Bars):
    """The same bars with the turn of the left arm as their input."""

    def off(self, at: Mapping[str, Any], length: Any) -> list[Any]:
        return [
            *super().off(at, 0)[:-1],
            mp.arg((at["A"] - at["L"]) / (self.start["A"] - self.start["L"])) - length,
        ]


def limit_of(document: Mapping[str, Any], near: Mapping[str, Any]) -> Any:
    """Return the greatest or the least length near some places, by Newton's method in the left arm's turn."""
    bars, at = ByArm(document), {name: mp.mpc(*map(float, place)) for name, place in near.items()}
    turn = mp.arg((at["A"] - at["L"]) / (bars.start["A"] - bars.start["L"]))
    for _ in range(8):
        once, twice = (rates["C"].real for rates in bars.rates(turn, bars.closed(turn, at)))
        turn -= once / twice
        if abs(once) < mp.mpf(10) ** -20:
            break
    return bars.length(bars.closed(turn, at))


@pytest.mark.slow
def test_without_stated_ends_a_slide_goes_from_limit_to_limit() -> None:
    scene = read({**DRAG_LINK, "drive": {"slide": "guide"}})
    with mp.workdps(DIGITS):
        for end, phase in zip(scene.info.input_range, (0.0, math.pi), strict=True):
            limit = limit_of(DRAG_LINK, scene.pose(phase).position)
            assert float(limit) == pytest.approx(end, rel=3e-16)
    # the ends as they are told are those limits again
    low, high = scene.info.input_range
    again = read({**DRAG_LINK, "drive": {"slide": "guide", "from": low, "to": high}})
    assert again.info.lines == scene.info.lines


def between_limits(seed: int) -> None:
    """Assert that random points driven from limit to limit move as seventy digits say, on both closures."""
    chance = random.Random(seed)
    points = {name: [chance.randint(0, 100), chance.randint(0, 100)] for name in "LRABSC"}
    document = {**DRAG_LINK, "points": points, "drive": {"slide": "guide"}}
    scene, bars = read(document), Bars(document)
    phases = np.append(np.random.default_rng(seed).uniform(-math.pi, math.pi, 3), [1e-4, math.pi - 1e-6])
    found, cycle = scene.solve(phase=phases, speed=1.0), scene.cycle(500)
    size = float(np.ptp(np.concatenate([*cycle.position.values()]), axis=0).max())
    pace = scene.solve(phase=cycle.phase, speed=1.0)
    rates = (np.concatenate([*kind.values()]) for kind in (pace.velocity, pace.acceleration))
    scales = (size, *(float(np.abs(rate).max()) for rate in rates))
    with mp.workdps(DIGITS):
        low, high = (limit_of(document, scene.pose(phase).position) for phase in (0.0, math.pi))
        half = (high - low) / 2
        for n, phase in enumerate(map(mp.mpf, phases)):
            length, rate, bend = low + half * (1 - mp.cos(phase)), half * mp.sin(phase), half * mp.cos(phase)
            near = {name: mp.mpc(*map(float, found.position[name][n])) for name in bars.start}
            at = bars.closed(length, near)
            once, twice = bars.rates(length, at, min(abs(rate), mp.mpf(1)) ** 2 * mp.mpf(10) ** -13)
            for name in bars.free:
                true = at[name], once[name] * rate, twice[name] * rate**2 + once[name] * bend
                shown = found.position[name][n], found.velocity[name][n], found.acceleration[name][n]
                for order, (own, solved) in enumerate(zip(true, shown, strict=True)):
                    off = abs(own - mp.mpc(*map(float, solved)))
                    assert off <= (1e-14, 1e-14, 1e-12)[order] * max(scales[order], size), (seed, name, phase)


@pytest.mark.slow
@pytest.mark.parametrize("seed", [3, 17])
def test_between_two_limits_it_comes_back_on_the_other_closure(seed: int) -> None:
    between_limits(seed)


@pytest.mark.slow
@pytest.mark.parametrize("first", range(20, 32, 3))
@pytest.mark.thinned(3)
def test_random_ones_do(first: int) -> None:
    for seed in range(first, first + 3):
        between_limits(seed)


LOADED = {
    **KNEE,
    "bodies": {"upper": {"mass": "2 kg", "com": [100, 0]}, "ram": {"mass": "5 kg"}},
    "gravity": "9.81 m/s^2",
}
LOADED_RACK = {
    **DRAG_LINK,
    "bodies": {"drag": {"mass": "2 kg", "com": [100, 0], "inertia": "0.1 kg m^2"}},
    "gravity": "9.81 m/s^2",
}


@pytest.mark.parametrize("document", [LOADED, LOADED_RACK], ids=["cylinder", "rack"])
def test_its_force_is_that_of_the_balance_of_power(document: Mapping[str, Any]) -> None:
    scene = read(document)
    assert scene.info.effort == ("force", "N")
    motion = scene.solve(phase=np.linspace(0.1, 6.2, 40), speed=2.0, acceleration=0.5)
    forces = motion.reactions.effort
    assert np.abs(forces - input_effort(motion)).max() < 1e-11 * np.abs(forces).max()


def test_the_mouse_sets_it() -> None:
    scene = read(BARREL)
    pose = scene.pose(1.0)
    p, q = (complex(*pose.position[name]) for name in "PQ")
    ahead = q + 12 * (q - p) / abs(q - p)
    length = scene.pose(phase_towards(scene, 1.0, (ahead.real, ahead.imag))).coordinate
    assert length == pytest.approx(pose.coordinate + 12, abs=1e-9)
    end = scene.pose(phase_along(scene, 1.0, (q - p) / abs(q - p))).coordinate
    assert end == pytest.approx(270, abs=1e-6)
    # the end of a cylinder comes as near as it ever does
    knee = read(KNEE)
    place = tuple(knee.pose(2.0).position["Q"])
    assert phase_towards(knee, 1.9, (place[0], place[1])) == pytest.approx(2.0, abs=1e-4)


REFUSED = {
    "beyond a limit": (
        {**KNEE, "drive": {"cylinder": {"between": ["P", "Q"], "from": 240, "to": 280}}},
        "its links let the cylinder's length come to 276.595 mm, not to 280 mm; choose another end",
    ),
    "one link": (
        {**KNEE, "drive": {"cylinder": {"between": ["P", "K"], "from": 240, "to": 280}}},
        "P and K are on one link, so nothing would move",
    ),
    "a start": (
        {**KNEE, "drive": {**KNEE["drive"], "start": "20 deg"}},
        "is that of a crank, but a length drives these links; leave it out",
    ),
    "a joint": (
        {**KNEE, "drive": {**KNEE["drive"], "joint": "K"}},
        r"drive\.joint = .K.: is that of a crank, but the cylinder turns none; leave it out",
    ),
    "a crank of the cylinder": (
        {**KNEE, "drive": {"cylinder": {**KNEE["drive"]["cylinder"], "joint": "P"}}},
        r"drive\.cylinder\.joint = .P.: is that of a crank, but the cylinder turns none; leave it out",
    ),
    "a line that no point shows": (
        {
            **BARREL,
            "links": {**BARREL["links"], "barrel": ["P"]},
            "points": KNEE["points"],
            "slides": {**KNEE["slides"], "piston": {"link": "rod", "on": "barrel", "angle": "60 deg"}},
        },
        "is on a link with one point, which shows no line",
    ),
}


@pytest.mark.parametrize(("document", "reason"), REFUSED.values(), ids=REFUSED)
def test_what_cannot_drive_is_refused(document: Mapping[str, Any], reason: str) -> None:
    with pytest.raises((BadInput, AssemblyError), match=reason.replace("(", "\\(")):
        read(document)
