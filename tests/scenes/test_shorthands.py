"""A shorthand is the same linkage as its long form, with lengths and directions to the last bit."""

from __future__ import annotations

import math
import tomllib

import pytest

from linkanim.mechanics.linkage import RRP, RRR, Body, Crank, Drive, Joint, Line, Pin, Point, Polar, Rigid
from linkanim.scenes.reading import scene_from
from linkanim.scenes.scene import Scene


def read(text: str) -> Scene:
    return scene_from(tomllib.loads(text), name="my", where="my.toml")


def joints(scene: Scene) -> dict[str, Joint]:
    return dict(scene.linkage.by_name)


FOUR_BAR = """
[four-bar]
ground = 100
crank = 30
coupler = 90
rocker = 80
coupler_point = [45, 30]
"""


def test_a_four_bar_has_its_pins_joints_bodies_and_traced_point() -> None:
    scene = read(FOUR_BAR)
    assert scene.linkage.joints == (
        Pin("O2", (0.0, 0.0)),
        Pin("O4", (100.0, 0.0), Polar(100.0, 0.0, "O2")),
        Crank("A", "O2", 30.0),
        RRR("B", ("A", "O4"), (90.0, 80.0), 1),
        Rigid("P", ("A", "B"), (45.0, 30.0)),
    )
    assert scene.linkage.bodies == (
        Body("crank", ("O2", "A")),
        Body("coupler", ("A", "B", "P")),
        Body("rocker", ("O4", "B")),
    )
    assert scene.linkage.drive == Drive("A", 2 * math.pi / 3, 0.0)
    assert scene.trace == ("P",)
    assert (scene.length_unit, scene.linkage.metre) == ("mm", 0.001)


def test_crossed_is_the_other_side() -> None:
    assert joints(read(FOUR_BAR + "assembly = 'crossed'\n"))["B"] == RRR("B", ("A", "O4"), (90.0, 80.0), -1)


@pytest.mark.parametrize(("assembly", "side"), [("open", 1), ("crossed", -1)])
def test_a_four_bar_driven_at_its_rocker_is_named_by_the_side_of_b(assembly: str, side: int) -> None:
    scene = read(FOUR_BAR + f"driver = 'rocker'\nassembly = '{assembly}'\n")
    assert joints(scene)["B"] == Crank("B", "O4", 80.0)
    assert joints(scene)["A"] == RRR("A", ("B", "O2"), (90.0, 30.0), side, side_of=("B", "A", "O4"))
    assert scene.linkage.drive.joint == "B"


# Change-point linkages at the rocker, where B may lie on one side of A -> O4 for both closures.
@pytest.mark.parametrize("assembly", ["", "assembly = 'open'", "assembly = 'crossed'"])
@pytest.mark.parametrize("lengths", [(4, 2, 4, 2), (4, 2, 5, 3), (5, 2, 4, 3), (3, 3, 5, 5), (2, 2, 2, 2)])
def test_a_change_point_linkage_loads_driven_at_its_rocker(
    lengths: tuple[int, int, int, int], assembly: str
) -> None:
    keys = ("ground", "crank", "coupler", "rocker")
    table = "".join(f"{key} = {length}\n" for key, length in zip(keys, lengths, strict=True))
    assert read(f"[four-bar]\n{table}driver = 'rocker'\n{assembly}\n").period > 0


@pytest.mark.parametrize(
    ("angle", "place"),
    [
        # cos 90° is 6e-17 in floats; a ground line straight up has none of that.
        ("90 deg", (0.0, 100.0)),
        ("180 deg", (-100.0, 0.0)),
        ("-90 deg", (0.0, -100.0)),
        ("270 deg", (0.0, -100.0)),
        ("720 deg", (100.0, 0.0)),
    ],
)
def test_ground_lines_along_the_axes_are_exact(angle: str, place: Point) -> None:
    o4 = joints(read(FOUR_BAR + f"ground_angle = '{angle}'\n"))["O4"]
    assert isinstance(o4, Pin)
    assert o4.position == place


def test_a_shorthand_stands_where_the_file_puts_o2() -> None:
    found = joints(read("[ground]\nO2 = [5, -7]\nG = [1, 2]\n" + FOUR_BAR))
    assert found["O2"] == Pin("O2", (5.0, -7.0))
    assert found["O4"] == Pin("O4", (105.0, -7.0), Polar(100.0, 0.0, "O2"))
    assert found["G"] == Pin("G", (1.0, 2.0))


def test_a_slider_crank_has_a_slider_body_and_a_line_through_o2() -> None:
    scene = read(
        "[slider-crank]\ncrank = 40\nrod = 120\noffset = -20\nline_angle = '180 deg'\n"
        "coupler_point = [60, 20]\nassembly = 'backward'\n"
    )
    assert scene.linkage.joints == (
        Pin("O2", (0.0, 0.0)),
        Crank("A", "O2", 40.0),
        RRP("B", "A", 120.0, Line("O2", math.pi, -20.0), -1),
        Rigid("P", ("A", "B"), (60.0, 20.0)),
    )
    assert scene.linkage.bodies == (
        Body("crank", ("O2", "A")),
        Body("rod", ("A", "B", "P")),
        Body("slider", slider="B"),
    )


SIX_BAR = "[six-bar]\nlengths = [100, 40, 90, 80, 140, 70, 120, 95]\nassembly2 = 'crossed'\n"


def test_a_six_bar_is_two_four_bars_on_one_ground_line() -> None:
    scene = read(SIX_BAR + "link_angle = '90 deg'\ncoupler_point2 = [45, 40]\n")
    assert scene.linkage.joints == (
        Pin("O2", (0.0, 0.0)),
        Pin("O4", (100.0, 0.0), Polar(100.0, 0.0, "O2")),
        Pin("O6", (240.0, 0.0), Polar(140.0, 0.0, "O4")),
        Crank("A", "O2", 40.0),
        RRR("B", ("A", "O4"), (90.0, 80.0), 1),
        Rigid("C", ("O4", "B"), (0.0, 70.0)),
        RRR("D", ("C", "O6"), (120.0, 95.0), -1),
        Rigid("P2", ("C", "D"), (45.0, 40.0)),
    )
    assert [(body.name, body.joints) for body in scene.linkage.bodies] == [
        ("crank", ("O2", "A")),
        ("coupler", ("A", "B")),
        ("rocker", ("O4", "B", "C")),
        ("coupler2", ("C", "D", "P2")),
        ("rocker2", ("O6", "D")),
    ]
    assert scene.trace == ("P2",)


def test_a_six_bars_second_crank_lies_along_the_first_rocker_unless_turned() -> None:
    assert joints(read(SIX_BAR))["C"] == Rigid("C", ("O4", "B"), (70.0, 0.0))


@pytest.mark.parametrize(("unit", "lengths"), [("mm", "30 mm"), ("cm", "3"), ("m", "3 cm"), ("in", "30 mm")])
def test_lengths_are_in_the_scenes_unit(unit: str, lengths: str) -> None:
    scene = read(f"length_unit = '{unit}'\n" + FOUR_BAR.replace("crank = 30", f"crank = '{lengths}'"))
    crank = joints(scene)["A"]
    assert isinstance(crank, Crank)
    assert crank.length * scene.linkage.metre == pytest.approx(0.03, rel=1e-15)


def test_what_stands_beside_a_shorthand_adds_to_it() -> None:
    scene = read(
        FOUR_BAR
        + "[ground]\nG = [0, 50]\n[joints.Q]\non = ['O4', 'B']\nat = [10, 20]\n"
        + "[bodies]\ncoupler = { joints = ['A', 'B', 'P'], com = [45, 0] }\nflag = { joints = ['O4', 'Q'] }\n"
        + "[springs.s]\nbetween = ['Q', 'G']\n[dampers.d]\nbetween = ['P', 'G']\ncoefficient = '3 N s/m'\n"
        + "[trace]\njoints = ['Q', 'P']\n"
    )
    assert joints(scene)["Q"] == Rigid("Q", ("O4", "B"), (10.0, 20.0))
    assert [body.name for body in scene.linkage.bodies] == ["crank", "coupler", "rocker", "flag"]
    assert scene.linkage.bodies[1].com == (45.0, 0.0)
    assert [spring.between for spring in scene.linkage.springs] == [("Q", "G")]
    assert [damper.coefficient for damper in scene.linkage.dampers] == [3.0]
    assert scene.trace == ("Q", "P")
