"""One call for many linkages of a form: row by row what each scene gives by itself."""

from __future__ import annotations

import pickle
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import linkanim
from linkanim.errors import BadInput, LinkanimError
from linkanim.mechanics import many
from linkanim.scenes import load
from linkanim.scenes.editing import Number, dimensions, with_dimensions
from linkanim.scenes.many import Many, named_lengths, solve_many
from linkanim.scenes.scene import Scene

Array = NDArray[np.float64]
NEAR = 256 * 2.0**-52
"""A row may differ from the scene's own pose by this share of the greatest value of its kind."""
KINDS = (
    *("position", "velocity", "acceleration", "com_position", "angular_velocity", "angular_acceleration"),
    *("travel", "travel_velocity", "travel_acceleration"),
)

# Turning and swinging inputs, limits on one side and on both, each kind of dyad, gears, dyads down the chain,
# a closure named by another joint, and forms that are read one by one (a cylinder, a rigid triangle of bars).
FORMS = [
    *("crank-rocker", "drag-link", "chebyshev-line", "double-rocker", "triple-rocker", "slider-crank"),
    *("inverted-slider-crank", "oscillating-cylinder", "scotch-yoke", "isosceles-slider", "press", "andrews"),
    *("geared-five-bar-2-1", "epicyclic-hypocycloid", "watt-1", "klann", "kite", "parallelogram"),
    *("rocker-driven", "driven-piston", "toggle-press", "elliptic-trammel", "six-bar"),
]


def lengths_about(scene: Scene, share: float, count: int, seed: int = 3) -> dict[str, Array]:
    """Return rows of all lengths of a scene, each up to that share away from its own."""
    random, values = np.random.default_rng(seed), {one.key: one.value for one in dimensions(scene)}
    names = {number.key: name for name, number in named_lengths(scene).items()}
    usual = scene.linkage.extent / 10
    return {
        name: values[key] + (abs(values[key]) or usual) * random.uniform(-share, share, count)
        for key, name in names.items()
        if key[-1] != "free_length"
    }


def alone(scene: Scene, lengths: Mapping[str, Any], row: int) -> Scene | None:
    """Return the scene with the lengths of a row; None where it cannot be put together."""
    numbers: Mapping[str, Number] = named_lengths(scene)
    try:
        return with_dimensions(scene, {numbers[name].key: float(of[row]) for name, of in lengths.items()})
    except LinkanimError:
        return None


def off(found: Many, row: int, scene: Scene) -> float:
    """Return how far a row is from the scene's own pose, as a share of the greatest value of a kind."""
    pose, worst = scene.pose(float(found.phase[row])), 0.0
    for kind in KINDS:
        meant = {name: np.asarray(value) for name, value in getattr(pose, kind).items()}
        size = max((float(np.abs(value).max()) for value in meant.values()), default=0.0) or 1.0
        for name, value in meant.items():
            worst = max(worst, float(np.abs(getattr(found, kind)[name][row] - value).max()) / size)
    return worst


@pytest.mark.thinned(3)
@pytest.mark.parametrize("name", FORMS)
def test_each_row_is_what_the_scene_with_its_lengths_gives(name: str) -> None:
    scene = load(name)
    for share in (0.02, 0.3):
        lengths, phase = lengths_about(scene, share, 8), np.linspace(-7.0, 14.0, 8)
        found = solve_many(scene, lengths, phase, derivatives=2)
        for row in range(8):
            own = alone(scene, lengths, row)
            if own is None:
                assert np.isnan(found.position[scene.linkage.joints[-1].name][row]).all()
            else:
                assert off(found, row, own) <= NEAR, (share, row)


# Just beside a change point, where a gap between lengths has few digits of theirs, and through a limit.
@pytest.mark.parametrize("gap", [1e-3, -1e-3, 1e-8, -1e-8, 1e-12, 0.0])
@pytest.mark.parametrize("phase", [0.0, 1e-4, 3.0, np.pi, 6.0])
def test_rows_beside_a_change_point_keep_their_digits(gap: float, phase: float) -> None:
    scene = load("crank-rocker")
    lengths = {"crank": [50.0], "coupler": [70.0], "rocker": [80.0 + gap]}
    own = alone(scene, lengths, 0)
    assert own is not None
    assert off(solve_many(scene, lengths, phase, derivatives=2), 0, own) <= NEAR


# A bar that is too long, lengths that are none, and one so small that a file would refuse it.
@pytest.mark.parametrize("coupler", [500.0, 0.0, -85.0, np.nan, np.inf, 1e-40])
def test_a_linkage_that_cannot_be_put_together_is_nan(coupler: float) -> None:
    found = solve_many("crank-rocker", {"coupler": [coupler, 85.0]}, 0.3, derivatives=1)
    assert np.isnan(found.position["B"][0]).all()
    assert np.isnan(found.angular_velocity["rocker"][0])
    assert found.position["B"][1] == pytest.approx(load("crank-rocker").pose(0.3).position["B"])


def test_shapes_units_and_angles_are_those_of_a_motion() -> None:
    found = solve_many("crank-rocker", {"coupler": [84.0, 85.0, 86.0]}, [0.1, 0.2, 0.3])
    assert found.position["B"].shape == (3, 2)
    assert found.velocity == {}
    scene = load("crank-rocker")
    assert found.angle["rocker"][1] == pytest.approx(scene.pose(0.2).angle["rocker"])
    one = solve_many(scene, {"coupler": 85.0}, 0.2, derivatives=2, speed=3.0, acceleration=-0.5)
    pose = scene.pose(0.2, speed=3.0, acceleration=-0.5)
    assert one.acceleration["B"][0] == pytest.approx(pose.acceleration["B"], rel=1e-12)
    assert not one.position["B"].flags.writeable


@pytest.mark.parametrize("name", ["crank-rocker", "double-rocker", "press", "driven-piston"])
def test_without_lengths_each_row_is_the_scene_s_own_pose(name: str) -> None:
    scene, phases = load(name), np.linspace(-3.0, 8.0, 9)
    found = solve_many(scene, {}, phases, speed=2.0, acceleration=0.5, derivatives=2)
    for row, phase in enumerate(phases.tolist()):
        pose = scene.pose(phase, speed=2.0, acceleration=0.5)
        for kind in KINDS:
            assert {joint: tuple(np.ravel(of[row])) for joint, of in getattr(found, kind).items()} == {
                joint: tuple(np.ravel(of)) for joint, of in getattr(pose, kind).items()
            }
    assert solve_many(scene, {}).position.keys() == solve_many(scene, {}, phases).position.keys()


def test_a_length_is_called_by_key_or_by_body() -> None:
    names = named_lengths(load("press"))
    assert names["4"].key == names["C.length"].key == names["joints.C.length"].key
    assert names["7"].key == names["D.length"].key
    assert "3" not in names or names["3"].key == names["B.length.0"].key


@pytest.mark.parametrize(
    ("given", "words"),
    [
        (
            ({"copuler": 1.0},),
            "no length .copuler. .did you mean .coupler.*; it has ground, crank, coupler, rocker,",
        ),
        (({"coupler": "long"},), "coupler"),
        (({"coupler": [1.0, 2.0], "crank": [1.0, 2.0, 3.0]},), r"coupler \(2,\), crank \(3,\)"),
        (({"coupler": [[1.0, 2.0]]},), r"N numbers"),
        (({"coupler": 1.0}, "soon"), "phase"),
        (({"coupler": 1.0}, 1e12), "turns"),
    ],
)
def test_what_cannot_be_solved_is_refused_in_a_sentence(given: tuple[Any, ...], words: str) -> None:
    with pytest.raises(BadInput, match=words):
        linkanim.solve_many("crank-rocker", *given)


# A swing below the ground line, which a stated start asks for.
RIGHT = """
[drive]
joint = "A"
speed = "20 rpm"
start = "-120 deg"
[ground]
O2 = [0, 0]
O4 = { length = 50, angle = "20 deg" }
[joints.A]
crank = "O2"
length = 35
[joints.B]
from = ["A", "O4"]
length = [20, 40]
side = "left"
"""


@pytest.mark.parametrize("start", ["-30 deg", "80 deg", "179 deg"])
def test_of_two_ranges_it_is_the_one_with_the_start(
    start: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.delattr("linkanim.scenes.many.with_dimensions")
    path = tmp_path / "right.toml"
    path.write_text(RIGHT.replace("-120 deg", start), encoding="utf-8")
    scene = load(str(path))
    lengths = {"A.length": [34.0, 35.0, 36.0], "O4.length": [51.0, 50.0, 49.0]}
    found = solve_many(scene, lengths, [0.0, 1.0, 4.0], derivatives=2)
    for row in range(3):
        own = alone(scene, lengths, row)
        assert own is not None
        assert off(found, row, own) <= NEAR


def test_a_pin_that_is_measured_from_another_one_keeps_its_place(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delattr("linkanim.scenes.many.with_dimensions")
    scene = load("six-bar")
    numbers = {name: number for name, number in named_lengths(scene).items() if name.startswith("lengths")}
    for name, number in numbers.items():
        (value,) = (one.value for one in dimensions(scene) if one.key == number.key)
        lengths = {name: [1.01 * value]}
        own = alone(scene, lengths, 0)
        assert own is not None
        assert off(solve_many(scene, lengths, 0.7, derivatives=2), 0, own) <= NEAR, name
    assert len(numbers) == 8


@pytest.mark.parametrize("name", ["crank-rocker", "slider-crank", "press", "rocker-driven", "watt-1"])
def test_linkages_like_the_scene_are_solved_together(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    scene = load(name)
    monkeypatch.delattr("linkanim.scenes.many.with_dimensions")
    found = solve_many(scene, lengths_about(scene, 0.001, 5), [0.0, 1.0, 2.0, 3.0, 4.0])
    assert all(np.isfinite(places).all() for places in found.position.values())


# A cylinder's linkages are read one by one: three of them at forty phases each are three.
def test_a_linkage_that_is_read_by_itself_is_read_once(monkeypatch: pytest.MonkeyPatch) -> None:
    scene, read = load("driven-piston"), list[object]()

    def counted(scene: Scene, values: Mapping[Any, float]) -> Scene:
        read.append(values)
        return with_dimensions(scene, values)

    monkeypatch.setattr("linkanim.scenes.many.with_dimensions", counted)
    places = np.repeat([60.0, 61.0, 62.0], 40)
    found = solve_many(scene, {"P.at.0": places}, np.tile(np.arange(40) / 40, 3))
    assert len(read) == 3
    assert all(np.isfinite(places).all() for places in found.position.values())


# Which way a formula takes, where each is right, follows from the scene and not from its other rows.
@pytest.mark.parametrize("name", ["crank-rocker", "double-rocker", "slider-crank", "inverted-slider-crank"])
def test_a_row_is_the_same_bits_alone_and_among_others(name: str) -> None:
    scene = load(name)
    lengths, phase = lengths_about(scene, 0.4, 12), np.linspace(-3.0, 9.0, 12)
    found = solve_many(replace(scene), lengths, phase, derivatives=2)
    for row in range(12):
        one = {key: of[row] for key, of in lengths.items()}
        own = solve_many(replace(scene), one, phase[row], derivatives=2)
        for kind in KINDS:
            for joint, values in getattr(own, kind).items():
                assert np.array_equal(values[0], getattr(found, kind)[joint][row], equal_nan=True), (
                    row,
                    kind,
                )


def test_a_scene_that_was_solved_so_goes_through_a_pickle() -> None:
    scene = load("double-rocker")
    first = solve_many(scene, {"coupler": 84.0}, 0.4)
    assert scene.quantities
    again = solve_many(pickle.loads(pickle.dumps(scene)), {"coupler": 84.0}, 0.4)
    assert np.array_equal(first.position["B"], again.position["B"])


def test_other_lengths_of_one_form_record_nothing_anew(monkeypatch: pytest.MonkeyPatch) -> None:
    scene = load("six-bar")
    lengths = lengths_about(scene, 0.01, 20)
    first = solve_many(scene, lengths, 0.4)
    monkeypatch.delattr(many, "recorded")
    again = solve_many(scene, {name: of[::-1] for name, of in lengths.items()}, 0.4)
    for name, places in first.position.items():
        assert np.array_equal(again.position[name][::-1], places)
