"""Dimensions change one at a time, checked as a file is; a scene written is the scene read."""

from __future__ import annotations

import contextlib
import tomllib
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from linkanim.errors import AssemblyError, SceneError, WorkFailed
from linkanim.intake import control_in
from linkanim.mechanics.linkage import Crank
from linkanim.scenes import load, names
from linkanim.scenes.editing import dimensions, with_dimensions
from linkanim.scenes.form import Key
from linkanim.scenes.reading import scene_from
from linkanim.scenes.scene import Scene
from linkanim.scenes.toml import parse, save, text

COUPLER: Key = ("four-bar", "coupler")


def reread(scene: Scene) -> Scene:
    return scene_from(parse(text(scene), "written"), name=scene.name, where="written")


def labels(scene: Scene) -> list[str]:
    return [dimension.label for dimension in dimensions(scene)]


def test_a_four_bars_dimensions_are_called_as_in_class() -> None:
    assert labels(load("crank-rocker")) == [
        "Ground 1",
        "Crank 2",
        "Coupler 3",
        "Rocker 4",
        "Coupler point, along",
        "Coupler point, to the left",
        "Input speed",
        "Start angle",
    ]


def test_a_six_bars_links_are_numbered() -> None:
    assert labels(load("six-bar"))[:10] == [
        "Ground 1",
        "Crank 2",
        "Coupler 3",
        "Rocker 4",
        "Ground 5",
        "Arm 6",
        "Coupler 7",
        "Rocker 8",
        "Angle of arm 6 on rocker 4",
        "Coupler point, along",
    ]


def test_the_long_forms_dimensions_are_called_by_their_links_and_joints() -> None:
    found = {item.label: (item.value, item.unit, item.kind) for item in dimensions(load("press"))}
    assert found["Crank 2"] == (55.0, "mm", "length")
    assert found["Bar 3, A–B"] == (283.0, "mm", "length")
    assert found["Bar 6, D–B"] == (165.0, "mm", "length")
    assert found["D, gear ratio"] == (-1.0, "", "ratio")
    assert found["D, gear offset"] == (-72.55, "deg", "angle")
    assert found["C, direction of its guide"] == (90.0, "deg", "angle")
    assert found["C, offset of its guide"] == (0.0, "mm", "offset")
    assert found["H on A–B, to the left"] == (45.0, "mm", "offset")
    assert found["Pin O7, distance"] == (330.0, "mm", "length")
    assert found["Pin G, y"] == (-800.0, "mm", "offset")
    assert found["Input speed"] == (20.0, "rpm", "speed")


def test_what_a_scene_states_of_masses_springs_and_dampers_can_be_edited() -> None:
    press = load("press")
    found = {item.label: (item.value, item.unit, item.kind) for item in dimensions(press)}
    assert found["Link 3 centre of mass, to the left"] == (15.0, "mm", "offset")
    assert found["Return spring, stiffness"] == (4000.0, "N/m", "stiffness")
    assert found["Return spring, free length"] == (280.0, "mm", "length")
    assert found["Cushion damper, damping coefficient"] == (200.0, "N s/m", "damping")
    keys = {item.label: item.key for item in dimensions(press)}
    other = with_dimensions(
        press,
        {
            keys["Link 3 centre of mass, to the left"]: "2 cm",
            keys["Return spring, stiffness"]: "5 N/mm",
            keys["Return spring, free length"]: 300,
            keys["Cushion damper, damping coefficient"]: 150,
        },
    ).linkage
    assert next(body.com for body in other.bodies if body.name == "3") == (141.5, 20.0)
    assert (other.springs[0].stiffness, other.springs[0].free_length) == (5000.0, 300.0)
    assert other.dampers[0].coefficient == 150.0


HEAVY = """
gravity = "9.81 m/s^2"
[four-bar]
ground = 100
crank = 30
coupler = 90
rocker = 80
[bodies.coupler]
joints = ["A", "B"]
com = [45, 5]
mass = "3 kg"
inertia = "20 kg cm^2"
"""


def test_what_a_scene_states_of_masses_can_be_edited_and_is_written_back() -> None:
    heavy = scene_from(parse(HEAVY, "heavy"), name="heavy", where="heavy")
    assert heavy.linkage.gravity == 9.81
    found = {item.label: item for item in dimensions(heavy)}
    assert (found["Coupler, mass"].value, found["Coupler, mass"].unit) == (3.0, "kg")
    assert (found["Gravity"].value, found["Gravity"].unit) == (9.81, "m/s^2")
    keys = {name: item.key for name, item in found.items()}
    values: dict[Key, float | str] = {
        keys["Coupler, mass"]: 4,
        keys["Coupler, moment of inertia"]: "0.003 kg m^2",
        keys["Gravity"]: "1.62",
    }
    other = with_dimensions(heavy, values)
    body = next(body for body in other.linkage.bodies if body.name == "coupler")
    assert (body.mass, body.inertia, other.linkage.gravity) == (4.0, 0.003, 1.62)
    assert reread(other) == other


def test_a_bar_of_no_body_is_called_by_its_joints() -> None:
    document = load("press").document
    bare = scene_from({**document, "bodies": {"arm": {"joints": ["A", "B"]}}}, name="bare", where="bare")
    assert {"Crank O2–A", "Arm A–B", "Bar D–B"} <= set(labels(bare))


def test_the_speed_can_be_edited_where_the_file_leaves_it_out() -> None:
    bare = scene_from(
        tomllib.loads("[four-bar]\nground = 100\ncrank = 30\ncoupler = 90\nrocker = 80\n"),
        name="bare",
        where="bare",
    )
    assert labels(bare)[-1] == "Input speed"
    faster = with_dimensions(bare, {("drive", "speed"): 40})
    assert faster.linkage.drive.speed == 2 * bare.linkage.drive.speed


def test_a_scene_without_a_file_has_nothing_to_edit_or_write() -> None:
    made = Scene("made", "Made", "", "mm", load("press").linkage)
    assert dimensions(made) == ()
    with pytest.raises(SceneError, match="no scene file"):
        text(made)


@pytest.mark.parametrize(
    ("name", "key", "typed", "written"),
    [
        # Without a unit it is the dimension's own.
        ("crank-rocker", COUPLER, 95.5, 95.5),
        ("crank-rocker", COUPLER, "95.5", 95.5),
        ("crank-rocker", COUPLER, 95.0, 95),
        ("crank-rocker", ("drive", "speed"), "30", "30 rpm"),
        ("crank-rocker", ("drive", "speed"), -30.0, "-30.0 rpm"),
        ("six-bar", ("six-bar", "link_angle"), "-45", "-45 deg"),
        # With a unit it stays as it was typed.
        ("crank-rocker", COUPLER, " 9.5 cm ", "9.5 cm"),
        ("crank-rocker", ("drive", "speed"), "2 rad/s", "2 rad/s"),
        ("press", ("joints", "D", "gear", "ratio"), "-1/2", "-1/2"),
        # The item of a list.
        ("six-bar", ("six-bar", "lengths", 2), 91, 91),
        ("press", ("joints", "B", "length", 1), "170", 170),
        ("press", ("ground", "G", 1), "-790", -790),
    ],
)
def test_a_value_takes_its_place_in_the_document(
    name: str, key: Key, typed: float | str, written: object
) -> None:
    before = load(name)
    after = with_dimensions(before, {key: typed})
    found: Any = after.document
    for part in key:
        found = found[part]
    assert found == written
    assert type(found) is type(written)
    assert before.document == load(name).document
    assert after.linkage != before.linkage


@pytest.mark.parametrize(
    ("key", "typed", "said"),
    [
        (COUPLER, "", "not a length"),
        (COUPLER, "abc", "not a length"),
        (COUPLER, "-3", "above zero"),
        (COUPLER, 0, "above zero"),
        (COUPLER, float("nan"), "finite"),
        (COUPLER, "1e999", "finite"),
        (COUPLER, "3 deg", "mm, cm, m, in"),
        (("drive", "speed"), "0", "moves nothing"),
        (("drive", "speed"), "3 mm", "rpm, rad/s, deg/s"),
        (("drive", "start"), "x", "not an angle"),
    ],
)
def test_a_value_that_cannot_be_is_refused_and_names_its_key(key: Key, typed: float | str, said: str) -> None:
    with pytest.raises(SceneError) as refusal:
        with_dimensions(load("crank-rocker"), {key: typed})
    assert str(refusal.value).startswith("crank-rocker: " + ".".join(str(part) for part in key))
    assert said in str(refusal.value)


def test_only_dimensions_can_be_changed() -> None:
    with pytest.raises(KeyError):
        with_dimensions(load("crank-rocker"), {("four-bar", "assembly"): "crossed"})


@pytest.mark.parametrize("name", names())
@pytest.mark.sampled
def test_every_dimension_given_its_own_value_changes_nothing(name: str) -> None:
    scene = load(name)
    for dimension in dimensions(scene):
        assert with_dimensions(scene, {dimension.key: dimension.value}).linkage == scene.linkage


@pytest.mark.parametrize("name", names())
def test_a_scene_of_the_catalogue_written_reads_back(name: str) -> None:
    scene = load(name)
    assert reread(scene) == scene
    assert reread(scene).document == scene.document


PHASES = np.linspace(0.1, 25.0, 40)


def bits(scene: Scene) -> dict[str, bytes]:
    """Return every joint's motion, to the last bit."""
    motion = scene.solve(phase=PHASES)
    kinds = {"at": motion.position, "going": motion.velocity, "speeding": motion.acceleration}
    return {f"{name} {kind}": found[name].tobytes() for kind, found in kinds.items() for name in found}


def edited(scene: Scene) -> Scene:
    """Return the scene with its first dimension changed that may be: by a thousandth, or by three."""
    for dimension in dimensions(scene):
        for share in (1.001, 0.997):
            with contextlib.suppress(SceneError, AssemblyError):
                other = with_dimensions(scene, {dimension.key: dimension.value * share})
                if other.linkage != scene.linkage:
                    return other
    raise AssertionError(f"{scene.name}: no dimension can be changed")


@pytest.mark.parametrize("name", names())
@pytest.mark.sampled
def test_a_scene_written_and_read_back_moves_the_same_to_the_last_bit(name: str, tmp_path: Path) -> None:
    scene = load(name)
    for one in (scene, edited(scene)):
        back = load(save(one, tmp_path))
        assert back.linkage == one.linkage
        assert bits(back) == bits(one)


LENGTHS = st.floats(1e-80, 1e80) | st.integers(1, 10**9)
ANGLES = st.floats(-1e3, 1e3).map(lambda value: f"{value!r} deg") | st.floats(-9, 9).map(
    lambda value: f"{value!r} rad"
)
OFFSETS = st.floats(-1e9, 1e9)
TITLES = st.text(st.characters(codec="utf-8"), max_size=20).filter(lambda title: not control_in(title))


@settings(max_examples=40)
@given(
    title=TITLES,
    lengths=st.lists(LENGTHS, min_size=4, max_size=4),
    angle=ANGLES,
    point=st.tuples(OFFSETS, st.floats(1, 9)),
    unit=st.sampled_from(["mm", "cm", "m", "in"]),
    pin=st.tuples(OFFSETS, OFFSETS),
)
@pytest.mark.slow
def test_whatever_a_document_says_is_written_to_the_last_bit(
    title: str,
    lengths: list[float],
    angle: str,
    point: tuple[float, float],
    unit: str,
    pin: tuple[float, float],
) -> None:
    bars = dict(zip(("ground", "crank", "coupler", "rocker"), lengths, strict=True))
    document = {
        "title": title,
        "length_unit": unit,
        "ground": {"O2": list(pin), "G": {"length": lengths[0], "angle": angle}},
        "four-bar": {**bars, "ground_angle": angle, "coupler_point": list(point)},
    }
    scene = Scene("any", title, "", unit, load("kite").linkage, document=document)
    assert parse(text(scene), "any") == document


def test_saving_never_takes_the_place_of_a_file(tmp_path: Path) -> None:
    scene = with_dimensions(load("press"), {("joints", "A", "length"): 54})
    (tmp_path / "press.toml").write_text("mine")
    paths = [save(scene, tmp_path) for _ in range(2)]
    assert [path.name for path in paths] == ["press-2.toml", "press-3.toml"]
    assert (tmp_path / "press.toml").read_text() == "mine"
    saved = load(paths[0])
    assert saved.linkage == scene.linkage
    assert saved.linkage.by_name["A"] == Crank("A", "O2", 54.0)


def test_a_folder_that_is_not_there_fails_in_one_line(tmp_path: Path) -> None:
    with pytest.raises(WorkFailed, match="cannot be written: no such file"):
        save(load("press"), tmp_path / "nowhere")


def test_a_disk_that_fills_up_leaves_nothing_behind(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def full(path: Path, data: bytes) -> int:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(Path, "write_bytes", full)
    with pytest.raises(WorkFailed, match="no space left"):
        save(load("press"), tmp_path)
    assert list(tmp_path.iterdir()) == []
