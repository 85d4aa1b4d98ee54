"""What `make` gives: all of the catalogue made or refused, the contract of its JSON, sizes, bridges."""

from __future__ import annotations

import math
from itertools import combinations
from typing import Any

import numpy as np
import pytest
from solids import Solids

import linkanim
from linkanim.errors import BadInput
from linkanim.scenes import load, names
from linkanim.scenes.reading import scene_from
from linkanim.scenes.scene import Scene
from linkanim.units import metre
from linkanim.workshop.layers import Stack
from linkanim.workshop.made import MadeLinkage, _reach
from linkanim.workshop.media import PAGES
from linkanim.workshop.parts import kit
from linkanim.workshop.request import make
from linkanim.workshop.shapes import polygon
from linkanim.workshop.sweep import Cycle, hulls_apart

FULL = "in whatever order they lie"
# Layers on the ground, flat parts, pins at joints; of the others the first two parts that would meet.
TABLE: dict[str, tuple[int, int, int] | str] = {
    "crank-rocker": (2, 4, 4),
    "drag-link": "crank would meet the pin at O4",
    "rocker-driven": (2, 4, 4),
    "crank-rocker-link3": (2, 4, 4),
    "wiper": (3, 6, 6),
    "pumpjack": (2, 6, 6),
    "galloway": "rocker would meet the pin at O2",
    "chebyshev-line": (3, 4, 4),
    "hoecken": (2, 4, 4),
    "roberts-line": (2, 4, 4),
    "watt-line": (2, 4, 4),
    "evans": (3, 6, 6),
    "slider-crank": (2, 4, 3),
    "engine": (2, 4, 3),
    "driven-piston": (2, 4, 3),
    "inverted-slider-crank": (2, 3, 3),
    "oscillating-cylinder": (2, 3, 3),
    "whitworth": "crank would meet the pin at O4",
    "crank-shaper": (2, 5, 5),
    "quick-return-press": "crank would meet the pin at O4",
    "toggle-clamp": (3, 6, 7),
    "knuckle-press": (3, 6, 5),
    "toggle-press": (3, 6, 4),
    "scotch-yoke": (2, 4, 2),
    "elliptic-trammel": "the pin at O would meet the pin at Y",
    "peaucellier": (4, 10, 8),
    "hart": (4, 8, 9),
    "pantograph": (3, 8, 9),
    "six-bar": (2, 6, 7),
    "press": (4, 7, 6),
    "watt-1": (4, 6, 7),
    "watt-2": (3, 6, 7),
    "stephenson-1": "coupler would meet the pin at O2",
    "stephenson-3": (2, 6, 7),
    "dwell-six-bar": (2, 6, 7),
    "jansen": (3, 8, 7),
    "klann": (3, 6, 7),
    "scissor-lift": (3, 11, 13),
    "landing-gear": (3, 6, 7),
    "umbrella": (3, 8, 6),
    "excavator": "a cylinder drives it",
    "geared-five-bar-2-1": (3, 6, 5),
    "geared-five-bar-3-2": (3, 6, 5),
    "cardan-gears": (3, 5, 2),
    "epicyclic-hypocycloid": (3, 5, 2),
    "parallel-locomotive": "rod would meet the pin at O4",
    "parallelogram": (2, 4, 4),
    "antiparallelogram": (2, 4, 4),
    "kite": "rocker would meet the pin at O2",
    "isosceles-slider": "the pin at O2 would meet the pin at B",
    "grashof-limit-six-bar": (3, 6, 7),
    "double-rocker": (3, 4, 4),
    "triple-rocker": (2, 4, 4),
    "triple-rocker-in-in": (2, 4, 4),
    "triple-rocker-out-in": "crank would meet the pin at O4",
    "triple-rocker-in-out": "coupler would meet the pin at O4",
    "andrews": (4, 8, 7),
    "stephenson-2": (2, 6, 7),
    "stephenson-3-link6": (3, 6, 7),
    "double-butterfly": "wing2 would meet the pin at A",
    "steering": (2, 6, 6),
    "plotter": (3, 5, 5),
    "knee-cylinder": "a cylinder drives it",
    "oldham": "cross slides on two links at once, which no flat part does; pin it to one of them instead",
}
# Layers with a bridge; others stay as they are.
BRIDGED = {
    "drag-link": 4,
    "galloway": 4,
    "quick-return-press": 5,
    "elliptic-trammel": 3,
    "kite": 4,
    "isosceles-slider": 3,
    "triple-rocker-out-in": 4,
    "triple-rocker-in-out": 4,
    "crank-rocker": 2,
}


def at_joints(made: MadeLinkage) -> int:
    return sum(not pin.stuck for pin in made.pins)


@pytest.mark.slow
def test_every_scene_of_the_catalogue_is_made_or_refused_with_the_reason() -> None:
    found: dict[str, tuple[int, int, int] | str] = {}
    for name in names():
        made, expected = make(load(name)), TABLE.get(name)
        if made.refused is None:
            found[name] = (made.layers, len(made.plates), at_joints(made))
            assert made.fewest
        else:
            found[name] = expected if isinstance(expected, str) and expected in made.refused else made.refused
            assert made.refused.startswith(f"{name} cannot be made ")
            assert made.plates == ()
    assert found == TABLE


@pytest.mark.parametrize("name", BRIDGED)
def test_a_bridge_carries_pins_that_stand_in_the_way(name: str) -> None:
    scene = load(name)
    made = make(scene, bridge=True)
    assert (made.refused, made.layers) == (None, BRIDGED[name])
    hanging = [pin for pin in made.pins if pin.side == "above"]
    if name == "crank-rocker":
        assert hanging == []
        return
    told = make(scene).refused
    assert told is not None
    assert f"a bridge over it can carry {hanging[0].name} from above (--bridge)" in told
    assert made.plates[-1].role == "bridge"
    assert all(pin.high == made.layers and pin.low > 0 for pin in hanging)
    assert all((pin.low, pin.high) == (0, made.layers) for pin in made.pins if pin.name.startswith("post"))


@pytest.mark.parametrize(
    "name", ["crank-rocker", "press", "jansen", "crank-shaper", "scotch-yoke", "andrews"]
)
def test_holes_lie_as_the_scene_s_joints_do_and_pins_reach_no_further_than_their_parts(name: str) -> None:
    scene = load(name)
    found: Any = make(scene).as_object()
    scale, pose = 1000 * metre(scene.length_unit), scene.pose(0.7, 0)
    through: dict[str, list[int]] = {}
    for part in found["parts"]:
        if part["towards"]:
            first, second = part["towards"]
            assert part["origin"] == first
            assert part["holes"][part["joints"].index(first)][:2] == pytest.approx([0, 0], abs=1e-9)
            x, y, _ = part["holes"][part["joints"].index(second)]
            assert (x > 0, y) == (True, pytest.approx(0, abs=1e-9))
        holes = [(joint, hole) for joint, hole in zip(part["joints"], part["holes"], strict=True) if joint]
        for (one, a), (other, b) in combinations(holes, 2):
            apart = math.dist(pose.position[one], pose.position[other]) * scale
            assert math.dist(a[:2], b[:2]) == pytest.approx(apart, abs=1e-6)
        for joint, _ in holes:
            through.setdefault(joint, []).append(part["layer"])
    for pin in found["pins"]:
        fixed = scene.linkage.joint(pin["joint"]).fixed
        assert pin["from"] == (0 if fixed else min(through[pin["joint"]]))
        assert (pin["side"] == "below") == fixed
        assert pin["to"] >= max(through[pin["joint"]])
    assert found["layers"] == max(part["layer"] for part in found["parts"])
    assert {part["body"] for part in found["parts"]} <= {body.name for body in scene.linkage.bodies}


def test_the_same_is_said_in_inches_and_centimetres() -> None:
    name, scene = "press", load("press")
    for unit in ("in", "cm"):
        document = {**scene.document, "length_unit": unit}
        other = scene_from(document, name=name, where=name)
        true, fitted = make(other), make(other, fit="A4")
        assert true.layers == make(scene).layers
        assert fitted.layers == make(scene, fit="A4").layers


@pytest.mark.parametrize(("name", "fit"), [("jansen", "A4"), ("andrews", "Letter"), ("crank-rocker", "A4")])
def test_what_is_fitted_to_a_page_fits_it_and_no_more(name: str, fit: str) -> None:
    made = make(load(name), fit=fit)
    wide, high = PAGES[fit]
    longest = max(max(np.ptp(points.real), np.ptp(points.imag)) for points in outlines(made))
    assert 0.8 * (wide - 20) < longest <= math.hypot(wide, high)
    assert made.ratio == pytest.approx(float(f"{made.ratio:.2g}"))


def outlines(made: MadeLinkage) -> list[Any]:
    found: Any = made.as_object()
    parts = (*found["parts"], *found["fittings"])
    return [np.array([complex(*point) for point in part["outline"]]) for part in parts]


def test_sizes_that_are_asked_for_are_kept() -> None:
    made = make(load("crank-rocker"), bar=12.0, hole=4.0, thickness=5.0, clearance=0.3, way="print")
    crank = next(part for part in made.plates if part.name == "crank")
    assert {2 * hole.radius for hole in crank.holes} == {4.0}
    assert crank.radius == 6.0
    assert made.sizes.thickness == 5.0
    found: Any = made.as_object()
    assert {pin["diameter"] for pin in found["pins"]} == {3.7}
    wider = make(load("crank-rocker"), hole=8.0)
    assert wider.sizes.bar == 20.0


BAD: list[tuple[dict[str, Any], str]] = [
    ({"bar": 5.0, "hole": 6.0}, "a hole of 6 mm is no narrower than its bar of 5 mm"),
    ({"bar": 5.0, "hole": 5.0}, "make it narrower (--hole), or the bar wider (--bar)"),
    ({"thickness": 0.0}, "thickness=0: give a length in mm from 0.001 to 100000"),
    ({"bar": -1.0}, "bar=-1: give a length"),
    ({"bar": math.nan}, "bar=nan: give a length"),
    ({"hole": math.inf}, "hole=inf: give a length"),
    ({"gap": -0.1}, "gap=-0.1: give a length"),
    ({"hole": 3.0, "clearance": 3.0}, "a clearance of 3 mm leaves nothing of a hole of 3 mm"),
    ({"hole": 3.0, "kerf": 4.0}, "a kerf of 4 mm leaves nothing of a hole of 3 mm"),
    ({"way": "clay"}, 'way="clay": take cardboard, laser, print'),
    ({"fit": "A5"}, 'fit="A5": take A4 or Letter'),
    ({"sheet": "A5"}, 'sheet="A5": take A4 or Letter, or a size in mm'),
    ({"sheet": (600.0, 20.0)}, "a sheet of 600 x 20 mm: give sides above 36 mm"),
    (
        {"bar": 150.0, "fit": "A4"},
        "bars would be shorter than 150 mm, their width; make them narrower (--bar)",
    ),
]


@pytest.mark.parametrize(("asked", "said"), BAD, ids=[said[:40] for _, said in BAD])
def test_sizes_that_make_no_sense_are_named_with_the_way_out(asked: dict[str, Any], said: str) -> None:
    with pytest.raises(BadInput) as caught:
        make(load("crank-rocker"), **asked)
    assert said in str(caught.value)


def test_holes_that_leave_too_little_between_them_are_named() -> None:
    with pytest.raises(BadInput, match=r"K1: the hole O and the hole R, 6.8 and 6.8 mm wide, leave 0.2 mm"):
        make(load("andrews"), bar=8.0, hole=6.8, gap=0.0)


def test_what_only_wide_bars_stop_is_made_with_narrower_ones() -> None:
    wide = make(load("crank-rocker"), bar=60.0, hole=40.0)
    assert wide.refused is not None
    assert wide.refused.endswith("narrower bars can, such as --bar 42")
    assert make(load("crank-rocker"), bar=42.0).refused is None
    widest = make(load("crank-rocker"), bar=500.0)
    assert widest.refused is not None
    assert widest.refused.endswith("narrower bars can, such as --bar 62.5")
    assert make(load("crank-rocker"), bar=62.5).refused is None


def test_a_scene_of_a_thousand_kilometres_is_scaled_to_a_page_or_refused() -> None:
    scene = scaled(1e9)
    with pytest.raises(BadInput, match=r"which nobody can make; scale it to a page \(--fit A4\)"):
        make(scene)


def scaled(factor: float) -> Scene:
    bar = {"ground": 100.0, "crank": 50.0, "coupler": 85.0, "rocker": 80.0}
    document = {
        "title": "far",
        "source": "here",
        "length_unit": "mm",
        "drive": {"speed": "20 rpm"},
        "four-bar": {name: length * factor for name, length in bar.items()},
    }
    return scene_from(document, name="far", where="far")


def test_the_public_name_makes_a_value_that_refuses_to_be_written(tmp_path: Any) -> None:
    made = linkanim.make(linkanim.load("drag-link"))
    assert made.refused is not None
    with pytest.raises(BadInput, match="cannot be made flat"):
        linkanim.make(linkanim.load("drag-link"), tmp_path / "drag")
    assert list(tmp_path.iterdir()) == []


FEW = ("crank-rocker", "drag-link", "press", "scotch-yoke")


@pytest.mark.thinned(2)
@pytest.mark.slow
@pytest.mark.parametrize(
    "name", [*FEW, *(pytest.param(name, marks=pytest.mark.long) for name in names() if name not in FEW)]
)
def test_nothing_that_is_made_meets_anything_else_of_its_layer(name: str) -> None:
    """Over random widths and ways, in the whole catalogue: by shapely, at 720 phases, from the JSON alone."""
    scene = load(name)
    random = np.random.default_rng(len(name))
    usual = make(scene, bridge=True)
    if usual.refused is not None:
        assert isinstance(TABLE[name], str)
        return
    bar = usual.sizes.bar * random.uniform(0.4, 1.5)
    ways: list[dict[str, Any]] = [
        {"way": "cardboard"},
        {
            "way": random.choice(["laser", "print"]),
            "bar": bar,
            "hole": bar * random.uniform(0.15, 0.6),
            "gap": random.choice([0.0, 0.2, 1.0]),
            "thickness": random.uniform(1, 6),
        },
    ]
    for how in ways:
        made: Any = make(scene, bridge=True, **how).as_object()
        assert list(Solids(scene, made, 720).overlaps()) == []


@pytest.mark.thinned(2)
@pytest.mark.parametrize("name", ["press", "cardan-gears", "scotch-yoke", "drag-link", "jansen"])
def test_what_is_held_apart_covers_the_whole_plate(name: str) -> None:
    for plate in make(load(name), bridge=True).plates:
        piece = plate.piece
        edges = [*plate.cuts()][-1:] if plate.role == "ring" else [plate.outline()]
        for point in (point for edge in edges for point in polygon(edge)[::9]):
            cells = (np.array([cell]) for cell in piece.cells)
            away = min(float(hulls_apart(np.array([[point]]), cell)[0]) for cell in cells)
            # a ring's teeth reach inwards as far as its pieces do, and its gaps less far
            assert away <= piece.radius + 1e-6
            assert plate.teeth is not None or away >= piece.radius - 1e-6


def test_rings_of_pins_that_stand_close_leave_room_for_each_other() -> None:
    made = make(load("crank-rocker"))
    parts = kit(Cycle(made.scene, 1.0), made.sizes)
    one, other = len(parts.plates), len(parts.plates) + 1
    found = Stack((0, 1, 3, 1), True, (), {(one, other): 2.5})
    radius = made.sizes.hole / 2 + (2.5 - made.sizes.gap) / 2
    assert _reach(parts, found, 0, 2, made.sizes) == radius == _reach(parts, found, 1, 2, made.sizes)
    assert _reach(parts, found, 2, 2, made.sizes) == made.sizes.bar / 2


def test_the_check_sees_a_plate_in_a_wrong_layer() -> None:
    scene = load("crank-rocker")
    made: Any = make(scene).as_object()
    for part in made["parts"]:
        part["layer"] = 1
    assert any("part 2 and part 3 in layer 1" in found for found in Solids(scene, made, 72).overlaps())
