"""Points in one pose and the links through them become the linkage that a chain of dyads describes."""

from __future__ import annotations

import math
import tomllib
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
from published import STEPHENSON

import linkanim
from linkanim.errors import BadInput
from linkanim.mechanics.linkage import RPP, RPR, RRP, RRR, Crank, DrivenSlider, Gear, Rigid, Travel
from linkanim.player.files import SavedScenes
from linkanim.scenes import load
from linkanim.scenes.editing import dimensions, in_unit, with_dimensions
from linkanim.scenes.reading import problems, scene_from
from linkanim.scenes.scene import Scene

EXAMPLES = Path(linkanim.__file__).parent / "examples"

FOUR_BAR = """
[points]
O2 = [0, 0]
O4 = [100, 0]
A = { from = "O2", length = 30, angle = "60 deg" }
B = [89.2, 79.3]
P = [33.2, 62.6]
[links]
ground = ["O2", "O4"]
crank = ["O2", "A"]
coupler = ["A", "B", "P"]
rocker = ["O4", "B"]
[drive]
joint = "O2"
speed = "20 rpm"
"""
SLIDER_CRANK = """
[points]
O = [0, 0]
A = [20, 30]
B = [130, 10]
[links]
ground = ["O"]
crank = ["O", "A"]
rod = ["A", "B"]
block = ["B"]
[slides.block]
link = "block"
on = "ground"
angle = "30 deg"
[drive]
joint = "O"
"""
QUICK_RETURN = """
[points]
A = [0, 0]
B = [0, 50]
C = { from = "B", length = 20, angle = "40 deg" }
D = { from = "A", length = 120, angle = "%s rad" }
[links]
ground = ["A", "B"]
crank = ["B", "C"]
lever = ["A", "D"]
[slides.pin]
point = "C"
on = "lever"
angle = "%s rad"
[drive]
joint = "B"
"""
SLOT = math.atan2(50 + 20 * math.sin(math.radians(40)), 20 * math.cos(math.radians(40)))
YOKE = """
[points]
O = [0, 0]
A = [30, 40]
Y = [30, 0]
[links]
ground = ["O"]
crank = ["O", "A"]
yoke = ["Y"]
[slides.guide]
link = "yoke"
on = "ground"
[slides.slot]
point = "A"
on = "yoke"
angle = "90 deg"
[drive]
joint = "O"
"""
GEARS = """
[points]
O2 = [0, 0]
O4 = [100, 0]
A = [30, 0]
D = [100, 40]
C = [60, 90]
[links]
ground = ["O2", "O4"]
crank = ["O2", "A"]
idler = ["O4", "D"]
one = ["A", "C"]
two = ["D", "C"]
[gears.pair]
links = ["crank", "idler"]
ratio = -2
[drive]
joint = "O2"
"""
PLANET = """
[points]
O = [0, 0]
A = [75, 0]
B = [100, 0]
[links]
ground = ["O"]
arm = ["O", "A"]
planet = ["A", "B"]
[gears.ring]
links = ["ground", "planet"]
ratio = 4
carrier = "arm"
[drive]
joint = "O"
"""
PISTON = """
[points]
O = [0, 0]
B = { from = "O", length = 40, angle = "60 deg" }
C = [130, 0]
[links]
ground = ["O"]
crank = ["O", "B"]
rod = ["B", "C"]
block = ["C"]
[slides.cylinder]
link = "block"
on = "ground"
[lengths]
rod = { "B-C" = 120 }
[drive]
slide = "cylinder"
"""
CYLINDER = """
[points]
O2 = [0, 0]
A = [460, 0]
B = [200, -12]
G = [60, -40]
[links]
ground = ["O2", "G"]
boom = ["O2", "A", "B"]
[drive]
cylinder = { between = ["G", "B"], from = 130, to = 215 }
"""


def read(text: str) -> Scene:
    return scene_from(tomllib.loads(text), name="my", where="my.toml")


def pose_of(text: str) -> dict[str, tuple[float, float]]:
    """Return the scene's joints where its input stands as in the points."""
    scene = read(text)
    start = scene.linkage.drive.start
    motion = scene.solve(angle=start, derivatives=0)
    return {name: tuple(place) for name, place in motion.position.items()}


def test_the_leg_is_the_one_whose_lengths_and_sides_were_worked_out_by_hand() -> None:
    leg = load(EXAMPLES / "11-points.toml").linkage
    assert leg.crank("C").length == math.hypot(4, 21)
    assert leg.drive.start == pytest.approx(math.radians(-100.78429786756261), rel=1e-15)
    h, k, m, f = (leg.joint(name) for name in "HKMF")
    assert isinstance(h, RRR)
    assert isinstance(m, RRR)
    assert dict(zip(h.ends, h.lengths, strict=True)) == {"B": 32.0, "C": math.hypot(44, 9)}
    assert dict(zip(m.ends, m.lengths, strict=True)) == {"D": math.hypot(70, 21), "K": math.hypot(9, 50)}
    assert isinstance(k, Rigid)
    assert k.at == pytest.approx((77.73147337723718, -29.16878548386729), rel=1e-14)
    assert isinstance(f, Rigid)
    assert [body.name for body in leg.bodies] == ["crank", "swing", "coupler", "lower", "leg"]


POSES = [
    ("two dyads", (EXAMPLES / "11-points.toml").read_text(encoding="utf-8")),
    ("a point given by its distance", FOUR_BAR),
    ("a block on an inclined guide", SLIDER_CRANK),
    ("a geared five-bar", GEARS),
    ("a slot through its pivot", QUICK_RETURN % (SLOT, SLOT)),
    ("a slot beside its pivot", QUICK_RETURN % ("1.5", "1.5")),
    ("a yoke", YOKE),
    ("a planet in a ring", PLANET),
]


@pytest.mark.parametrize("text", [row[1] for row in POSES], ids=[row[0] for row in POSES])
def test_the_pose_that_is_given_is_the_pose_at_the_start(text: str) -> None:
    stated = tomllib.loads(text)["points"]
    places = {name: place for name, place in stated.items() if isinstance(place, list)}
    found = pose_of(text)
    for name, place in places.items():
        assert found[name] == pytest.approx(place, abs=1e-13), name


def test_each_kind_of_dyad_is_the_joint_of_that_kind() -> None:
    line = read(SLIDER_CRANK).linkage.joint("B")
    assert isinstance(line, RRP)
    assert line.side == 1
    assert line.line.angle == math.pi / 6
    yoke = read(YOKE).linkage.joint("Y")
    assert isinstance(yoke, RPP)
    assert yoke.slot == math.pi / 2
    assert yoke.line.offset == 0.0
    planet = read(PLANET).linkage.crank("B")
    assert planet == Crank("B", "A", 25.0, Gear("A", Fraction(-3), 0.0))
    idler = read(GEARS).linkage.crank("D")
    assert idler == Crank("D", "O4", 40.0, Gear("A", Fraction(-2), math.pi / 2))


def test_a_stated_length_is_exact_and_the_pose_moves_to_the_nearest_that_has_it() -> None:
    stated = FOUR_BAR + '[lengths]\ncoupler = { "A-B" = 90 }\nrocker = { "O4 - B" = 80 }\n'
    linkage = read(stated).linkage
    assert linkage.crank("A").length == 30.0
    b = linkage.joint("B")
    assert isinstance(b, RRR)
    assert b.lengths == (90.0, 80.0)
    assert b.side == 1
    moved = pose_of(stated)["B"]
    assert math.dist(moved, (89.2, 79.3)) < 3


def test_a_slide_drives_as_far_as_its_bars_let_it() -> None:
    linkage = read(PISTON).linkage
    assert isinstance(linkage.joint("C"), DrivenSlider)
    assert linkage.drive.actuator == Travel(80.0, 160.0)
    ends = PISTON.replace('slide = "cylinder"', 'slide = "cylinder"\nfrom = 90\nto = "15 cm"')
    assert read(ends).linkage.drive.actuator == Travel(90.0, 150.0)


def test_a_cylinder_drives_a_crank_of_points() -> None:
    scene = read(CYLINDER)
    assert scene.linkage.drive.joint == "A"
    assert scene.info.input_range[0] < scene.info.input_range[1]


def test_everything_is_told_of_it_as_of_joints() -> None:
    scene = read(FOUR_BAR)
    joints = scene_from(scene.document, name="my", where="my.toml")
    assert joints.lines == scene.lines
    assert joints.linkage == scene.linkage
    assert scene.info.class_name == "Grashof crank-rocker"
    a, b = scene.cycle(50), joints.cycle(50)
    assert all(np.array_equal(a.position[name], b.position[name]) for name in a.position)


TRIAD = (
    FOUR_BAR.replace('rocker = ["O4", "B"]', 'rocker = ["O4", "B"]\nlast = ["O6", "P"]')
    .replace("P = [33.2, 62.6]", "P = [33.2, 62.6]\nO6 = [0, 100]")
    .replace('ground = ["O2", "O4"]', 'ground = ["O2", "O4", "O6"]')
)
# the lines of A-B, C-D and E-F meet in one point
AT_A_LIMIT = STEPHENSON.partition("[links]")[2]
AT_A_LIMIT = f"""
[points]
A = [0, 0]
B = [10, 20]
C = [30, 20]
D = [40, 0]
E = [25, 40]
F = [60, 40]
G = [60, 10]
[links]{AT_A_LIMIT}"""

KNEE = """
[points]
O = [0, 0]
K = [60, 200]
B = [0, 400]
P = [90, 60]
Q = [90, 330]
[links]
ground = ["O"]
lower = ["O", "K", "P"]
upper = ["K", "B", "Q"]
ram = ["B"]
[slides.guide]
link = "ram"
on = "ground"
angle = "90 deg"
[drive]
{}
"""

REFUSED = [
    # what is not said
    ("no links", "[points]\nA = [0, 0]\n", "links", "names no point"),
    ("links alone", '[links]\nground = ["A"]\n', "links", "goes with [points]"),
    (
        "both forms",
        FOUR_BAR + "[joints.A]\ncrank = 'O2'\nlength = 3\n",
        "joints",
        "does not go with [points]",
    ),
    ("pins, too", FOUR_BAR + "[ground]\nO2 = [0, 0]\n", "ground", "links.ground"),
    # what is not known
    ("an unknown point", FOUR_BAR.replace('"B", "P"]', '"B", "Q"]'), "links.coupler", 'called "Q"'),
    ("a point of no link", FOUR_BAR.replace(', "P"]', "]"), "points.P", "is on no link"),
    ("a stray key", FOUR_BAR + "[slides.s]\nlink = 'crank'\nwith = 'x'\n", "slides.s.with", "unknown key"),
    (
        "an unknown link",
        SLIDER_CRANK.replace('on = "ground"', 'on = "gruond"'),
        "slides.block.on",
        '"ground"',
    ),
    ("a link on itself", SLIDER_CRANK.replace('on = "ground"', 'on = "block"'), "slides.block.on", "itself"),
    ("an unknown drive", FOUR_BAR.replace('joint = "O2"', 'joint = "O3"'), "drive.joint", "is no point"),
    ("an unknown slide", PISTON.replace('slide = "cyl', 'slide = "cyi'), "drive.slide", '"cylinder"'),
    (
        "a gear of one link",
        GEARS.replace('"crank", "idler"]\n', '"crank"]\n'),
        "gears.pair.links",
        "two links",
    ),
    (
        "a length of no pair",
        FOUR_BAR + '[lengths]\ncoupler = { "A-Q" = 90 }\n',
        "lengths.coupler",
        "two points",
    ),
    # what is no linkage
    ("a link of one point", FOUR_BAR.replace('["O4", "B"]', '["B"]'), "links.rocker", "two points"),
    ("a link twice", FOUR_BAR + "[links2]\n", "links2", "unknown key"),
    ("two links that are one", FOUR_BAR.replace('["O4", "B"]', '["A", "B"]'), "links", "one body"),
    ("a point on itself", FOUR_BAR.replace('from = "O2"', 'from = "A"'), "points.A.from", "itself"),
    ("loose", FOUR_BAR.replace('rocker = ["O4", "B"]', ""), "links", "mobility 2"),
    ("immobile", TRIAD, "links", "mobility 0"),
    (
        "a motor where three meet",
        FOUR_BAR.replace('["A", "B", "P"]', '["A", "O2", "P"]'),
        "links",
        "one body",
    ),
    (
        "a cylinder that its links do not let be so short",
        FOUR_BAR.replace('joint = "O2"', 'cylinder = { between = ["O2", "B"], from = 9, to = 10 }'),
        "drive.cylinder: ",
        "let the cylinder's length come to 61.3706 mm, not to 9 mm; choose another end",
    ),
    ("a motor at a point", FOUR_BAR.replace('joint = "O2"', 'joint = "P"'), "drive.joint", "alone"),
    (
        "at a limit",
        FOUR_BAR.replace("[89.2, 79.3]", "[65, 15]")
        .replace("60 deg", "0 deg")
        .replace("[100, 0]", "[100, 30]"),
        "points",
        "stand at a limit",
    ),
    # what moves nothing, or is said twice
    (
        "a motor between a block and a link",
        KNEE.format('joint = "B"'),
        "drive.joint",
        "upper and ram meet, and ram is a block; give ram a second point",
    ),
    (
        "a slide and a cylinder",
        KNEE.format('slide = "guide"\ncylinder = { between = ["P", "Q"], from = 200, to = 270 }'),
        "drive.cylinder",
        "does not go with a slide",
    ),
    ("ends of no slide", KNEE.format('joint = "O"\nfrom = 20\nto = 30'), "drive.from", "no slide drives"),
    (
        "a cylinder in one link, from the ground",
        KNEE.format('cylinder = { between = ["O", "P"], from = 100, to = 120 }'),
        "drive.cylinder.between",
        "O and P are on one link, so nothing would move; name points of two links",
    ),
    (
        "a cylinder with one end",
        KNEE.format('cylinder = { between = ["P", "Q"], from = 240, to = "24 cm" }'),
        "drive.cylinder.to",
        "is the same length as from",
    ),
    (
        "a slide with one end",
        KNEE.format('slide = "guide"\nfrom = 400\nto = 400'),
        "drive.to",
        "is the same place as from",
    ),
    (
        "a slide beyond its limit",
        KNEE.format('slide = "guide"\nfrom = 390\nto = 1500'),
        "drive: ",
        "run from 390 to 417.612 mm only",
    ),
    (
        "a second motor at the first one's crank",
        KNEE.format('joint = "O"\nspeed = "20 rpm"\n[drives.second]\njoint = "K"\nspeed = "20 rpm"'),
        "drives.second.joint",
        "there are none",
    ),
    ("slide and joint", PISTON + 'joint = "O"\n', "drive.joint", "does not go with a slide"),
    (
        "lengths that no pose has",
        FOUR_BAR + '[lengths]\ncoupler = { "A-B" = 9 }\nrocker = { "O4-B" = 8 }\n',
        "lengths",
        "no pose near",
    ),
    (
        "a group behind a cylinder",
        STEPHENSON + 'cylinder = { between = ["A", "F"], from = 39, to = 80 }\n',
        "drive.cylinder: ",
        "let the cylinder's length come to",
    ),
    (
        "a group at a limit",
        AT_A_LIMIT,
        "links",
        "stand at a limit",
    ),
]


@pytest.mark.parametrize(
    ("text", "where", "reason"),
    [row[1:] for row in REFUSED],
    ids=[row[0] for row in REFUSED],
)
def test_what_is_no_linkage_of_dyads_is_one_sentence(text: str, where: str, reason: str) -> None:
    with pytest.raises(BadInput) as refusal:
        read(text)
    said = str(refusal.value)
    assert said.startswith(f"my.toml: {where}")
    assert reason in said
    assert "\n" not in said
    assert all(str(one.message).startswith("my.toml: ") for one in problems(text, name="my", where="my.toml"))


def test_a_problem_has_its_line() -> None:
    text = STEPHENSON.replace('EF = ["E", "F"]\n', "")
    (problem,) = problems(text, name="my", where="my.toml")
    assert problem.line == text.splitlines().index("[links]") + 1
    assert "mobility 2" in problem.message


def test_a_stephenson_linkage_driven_at_its_first_link_is_a_chain() -> None:
    scene = read(STEPHENSON.replace('joint = "G"', 'joint = "A"'))
    places = scene.solve(angle=scene.linkage.drive.start, derivatives=0).position
    for name, place in tomllib.loads(STEPHENSON)["points"].items():
        assert places[name] == pytest.approx(place, abs=1e-13)
    assert isinstance(scene.linkage.joint("F"), RRR)
    assert not any(isinstance(joint, RPR) for joint in scene.linkage.joints)


SAVED = {
    "a four-bar": FOUR_BAR,
    "a slider-crank": SLIDER_CRANK,
    "a leg": (EXAMPLES / "11-points.toml").read_text(),
}


@pytest.mark.parametrize("text", SAVED.values(), ids=SAVED)
def test_it_is_saved_in_the_form_that_it_had(
    text: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("own.toml").write_text(text)
    scene, before = load("own.toml"), tomllib.loads(text)
    written = tomllib.loads(SavedScenes().add(scene, "same").read_text())
    placed = {name: place for name, place in before["points"].items() if isinstance(place, list)}
    assert {name: written["points"][name] for name in placed} == placed
    assert {name: {*on} for name, on in written["links"].items()} == {
        name: {*on} for name, on in before["links"].items()
    }
    assert not {"joints", "form"} & written.keys()
    # the one length that the file states, in place of a point's coordinates
    assert written.get("lengths", {}) == ({"crank": {"O2-A": 30.0}} if "O2" in placed else {})


@pytest.mark.parametrize("text", SAVED.values(), ids=SAVED)
def test_a_length_that_was_edited_is_saved_with_the_points(
    text: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("own.toml").write_text(text)
    scene = load("own.toml")
    length = next(one for one in dimensions(scene) if one.key[-1] == "length")
    changed = with_dimensions(scene, {length.key: round(length.value * 1.05, 1)})
    path = SavedScenes().add(changed, "changed")
    assert "points" in tomllib.loads(path.read_text())
    found = load(path)
    phases = np.linspace(0, changed.period, 50)
    one, other = (each.solve(phase=phases, speed=1.0) for each in (changed, found))
    for name, place in one.position.items():
        assert np.abs(other.position[name] - place).max() < 1e-12 * 200
    assert round(length.value * 1.05, 1) in [of.value for of in dimensions(found)]


def test_joints_are_saved_by_points_where_that_is_asked(tmp_path: Path) -> None:
    asked = scene_from({**load("crank-rocker").document, "form": "points"}, name="my", where="my.toml")
    assert "points" in tomllib.loads(SavedScenes().add(asked, str(tmp_path / "my")).read_text())


# The published Stephenson chain, with a point by its distance, a stated length, and a block on its crank.
IN_UNITS = (
    STEPHENSON.replace("B = [5, 16]", 'B = { from = "A", length = 12, angle = "100 deg" }')
    .replace("[drive]", "block = ['K']\n[slides.block]\nlink = 'block'\non = 'FG'\nangle = '80 deg'\n[drive]")
    .replace("[links]", "K = [44, 24]\n[links]\nDK = ['D', 'K']")
    + '[lengths]\nEF = { "E - F" = 25 }\n'
)


@pytest.mark.slow
def test_a_pose_is_the_same_linkage_in_another_unit() -> None:
    scene = scene_from(tomllib.loads(f'length_unit = "cm"\n{IN_UNITS}'), name="it", where="it")
    labels = {item.label for item in dimensions(scene)}
    assert {"Point B, distance", "Point C, x", "Slide block, direction", "Bar EF E–F"} <= labels
    # a length leads to E, which moves to where it has it; G and F are the crank's
    assert not {"Point E, x", "Point F, y"} & labels
    there = in_unit(scene, "mm")
    for phase in (0.0, 0.4):
        places = scene.pose(phase).position
        for name, (x, y) in there.pose(phase).position.items():
            assert (x / 10, y / 10) == pytest.approx(places[name], rel=1e-12), name
