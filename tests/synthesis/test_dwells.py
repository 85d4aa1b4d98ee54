"""A six-bar's output rests while its crank turns on, by an arc of a coupler curve."""

from __future__ import annotations

import math
from itertools import combinations
from typing import Any

import mpmath
import numpy as np
import pytest

import linkanim
from linkanim.errors import BadInput
from linkanim.mechanics.measures import as_complex, transmission_angle
from linkanim.scenes.scene import Scene
from linkanim.synthesis.dwells import Dwell
from linkanim.synthesis.front import differ

REST = math.radians(90)


@pytest.fixture(scope="module", params=["rocker", "slider"])
def found(request: pytest.FixtureRequest) -> tuple[Dwell, ...]:
    """The answers for a rest of 90 degrees."""
    wanted: dict[str, Any] = {"swing": math.radians(40)} if request.param == "rocker" else {"stroke": 50.0}
    return linkanim.dwell(rest=REST, count=3, **wanted)


def output(scene: Scene, kind: str, turned: Any) -> Any:
    """Return where the output is when the crank has turned from the scene's start."""
    motion = scene.solve(angle=scene.linkage.drive.start + turned, derivatives=0)
    return motion.travel["slider"] if kind == "slider" else np.unwrap(motion.angle["output"])


def test_the_output_rests_from_the_start_and_has_its_whole_way(found: tuple[Dwell, ...]) -> None:
    wanted = math.radians(40) if found[0].kind == "rocker" else 50.0
    for one in found:
        at_rest = output(one.scene, one.kind, np.linspace(0, REST, 1001))
        assert np.ptp(at_rest) / 2 == pytest.approx(one.deviation, rel=1e-3)
        assert one.deviation < 3e-3 * wanted
        assert one.output == pytest.approx(wanted, rel=1e-12)
        moved = output(one.scene, one.kind, np.linspace(0, 2 * math.pi, 20_001))
        assert np.ptp(moved) == pytest.approx(wanted, rel=1e-7)
        assert np.ptp(moved[5001:]) > 0.99 * wanted


def test_the_crank_turns_fully_and_both_dyads_transmit(found: tuple[Dwell, ...]) -> None:
    for one in found:
        assert one.scene.info.full_turn
        motion = one.scene.cycle(2000, derivatives=0)
        least = min(float(transmission_angle(motion, dyad).min()) for dyad in ("B", "D"))
        assert least == pytest.approx(one.transmission_angle, abs=1e-4)
        assert one.transmission_angle >= math.radians(30)
        places = [as_complex(at) for at in one.scene.pose(0.0, 0).position.values()]
        assert one.size <= max(abs(a - b) for a, b in combinations(map(complex, places), 2)) * (1 + 1e-9)


def test_answers_differ_to_a_reader_and_those_that_rest_best_come_first(found: tuple[Dwell, ...]) -> None:
    assert all(differ(one.figures, other.figures) for one, other in combinations(found, 2))
    assert [one.deviation for one in found[1:]] == sorted(one.deviation for one in found[1:])


# The swing in fifty digits: the greatest and the least angle of the rocker over the turn.
@pytest.mark.slow
def test_a_swing_is_met_to_its_digits() -> None:
    one = linkanim.dwell(rest=math.radians(60), swing=math.radians(35), count=1)[0]
    p = {name: mpmath.mpf(value) for name, value in one.parameters.items()}
    signs = [1 if one.scene.document["joints"][name]["side"] == "left" else -1 for name in ("B", "D")]

    def closed(start: Any, end: Any, a: Any, b: Any, sign: int) -> Any:
        way = end - start
        square = abs(way) ** 2
        root = mpmath.sqrt(((a + b) ** 2 - square) * (square - (a - b) ** 2))
        return start + way * (square + a * a - b * b + 1j * sign * root) / (2 * square)

    def angle(theta: Any) -> Any:
        o4, o6 = mpmath.mpc(p["x4"], p["y4"]), mpmath.mpc(p["x6"], p["y6"])
        pin = mpmath.mpc(p["x"], p["y"]) + p["crank"] * mpmath.expj(theta)
        end = closed(pin, o4, p["coupler"], p["rocker"], signs[0])
        point = pin + mpmath.mpc(p["along"], p["across"]) * (end - pin) / p["coupler"]
        return mpmath.arg((closed(point, o6, p["rod"], p["output"], signs[1]) - o6) / rest)

    with mpmath.workdps(50):
        rest = mpmath.mpf(1)
        rest = mpmath.expj(angle(mpmath.mpf(one.scene.linkage.drive.start)))
        samples = [(angle(mpmath.mpf(n) / 100), mpmath.mpf(n) / 100) for n in range(629)]
        ends = [
            angle(mpmath.findroot(lambda at: mpmath.diff(angle, at), pick(samples)[1])) for pick in (min, max)
        ]
        assert abs(ends[1] - ends[0] - mpmath.radians(35)) < 1e-13


@pytest.mark.parametrize(
    ("asked", "says"),
    [
        ({"rest": 0.1, "swing": 0.5}, "give 20 to 240 deg of the crank"),
        ({"rest": 5.0, "swing": 0.5}, "give 20 to 240 deg of the crank"),
        ({"rest": 2.0}, "give the swing of a rocker"),
        ({"rest": 2.0, "swing": 0.5, "stroke": 3.0}, "or the stroke of a slider"),
        ({"rest": 2.0, "swing": 3.0}, "swings by 2 to 120 deg"),
        ({"rest": 2.0, "stroke": -1.0}, "give a length above zero"),
        ({"rest": 2.0, "stroke": math.inf}, "give a length above zero"),
        ({"rest": 2.0, "stroke": 3.0, "least_angle": 1.6}, "give 0 to 90 deg"),
        ({"rest": 4.0, "swing": 2.0, "least_angle": 1.4}, "ask for a shorter rest"),
        ({"rest": math.nan, "swing": 2.0}, "give 20 to 240 deg"),
    ],
    ids=["short", "long", "nothing", "both", "wide", "backwards", "endless", "flat", "none", "no number"],
)
def test_what_makes_no_sense_is_refused(asked: dict[str, float], says: str) -> None:
    with pytest.raises(BadInput, match=says):
        linkanim.dwell(**asked)  # type: ignore[arg-type]


@pytest.mark.parametrize("scale", [1e-6, 1e6])
@pytest.mark.slow
def test_a_stroke_of_another_size_has_the_same_linkage(scale: float) -> None:
    usual, other = (linkanim.dwell(rest=REST, stroke=stroke, count=1)[0] for stroke in (50.0, 50.0 * scale))
    assert other.parameters["crank"] == pytest.approx(usual.parameters["crank"] * scale, rel=1e-9)
    assert other.deviation == pytest.approx(usual.deviation * scale, rel=1e-3)
