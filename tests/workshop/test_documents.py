"""What is cut and printed, read back by readers that are not ours: ezdxf, trimesh, poppler, an XML parser."""

from __future__ import annotations

import math
import re
import shutil
import subprocess
from io import BytesIO, StringIO
from itertools import combinations
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import ezdxf.filemanagement
import numpy as np
import pytest
import shapely
import trimesh
from ezdxf import path as dxf_path
from numpy.typing import NDArray
from PIL import Image

from linkanim.errors import BadInput
from linkanim.picture.raster import Layer
from linkanim.scenes import load
from linkanim.workshop import documents
from linkanim.workshop.made import MadeLinkage
from linkanim.workshop.media import PAGES, Size
from linkanim.workshop.nesting import Laid, nested
from linkanim.workshop.request import make
from linkanim.workshop.shapes import moved, polygon, rounded

_DPI = 400


@pytest.mark.parametrize("name", ["crank-rocker", "jansen", "scotch-yoke"])
def test_a_dxf_has_each_part_s_holes_as_far_apart_as_the_scene_s_joints(name: str) -> None:
    made = make(load(name), way="laser", sheet=(1500.0, 900.0), kerf=0.2)
    drawing = ezdxf.filemanagement.read(StringIO(documents.dxf(made)))
    assert drawing.audit().errors == []
    assert drawing.units == ezdxf.units.MM
    space = drawing.modelspace()
    edges, circles = space.query('LWPOLYLINE[layer=="CUT"]'), space.query('CIRCLE[layer=="CUT"]')
    regions = [
        shapely.Polygon([(p.x, p.y) for p in dxf_path.make_path(edge).flattening(0.001)]) for edge in edges
    ]
    middles = [shapely.Point(circle.dxf.center.x, circle.dxf.center.y) for circle in circles]
    found = sorted(spans([p for p in middles if region.contains(p)]) for region in regions)
    found = [some for some in found if some]
    expected = sorted(
        spans([shapely.Point(hole.begin.real, hole.begin.imag) for hole in plate.holes])
        for plate in made.plates
    )
    for one, other in zip(found, [some for some in expected if some], strict=True):
        assert one == pytest.approx(other, abs=1e-6)
    radii = {round(circle.dxf.radius, 9) for circle in circles}
    assert {round(hole.radius - 0.1, 9) for hole in made.plates[1].holes} <= radii


def spans(points: list[Any]) -> list[float]:
    return sorted(one.distance(other) for one, other in combinations(points, 2))


def test_an_svg_is_in_mm_and_its_parts_lie_apart_on_the_sheet() -> None:
    made = make(load("crank-rocker"), way="laser", kerf=0.4, sheet=(250.0, 100.0))
    root = ElementTree.fromstring(documents.svg(made))
    assert root.get("width") == "250mm"
    assert root.get("viewBox") == "0 0 250 100"
    paths = [element.get("d", "") for element in root.iter("{http://www.w3.org/2000/svg}path")]
    assert len(paths) == len(documents.flat_parts(made))
    crank = made.plates[1]
    hole = crank.holes[0].radius
    # an arc's radius is a hole's less half the kerf, an edge's with it
    assert any(f"A{hole - 0.2:.6f} {hole - 0.2:.6f}" in path for path in paths)
    assert any(f"A{crank.radius + 0.2:.6f} {crank.radius + 0.2:.6f}" in path for path in paths)
    labels = [element.text for element in root.iter("{http://www.w3.org/2000/svg}text")]
    assert [label for label in labels if label and label[0].isdecimal()][:4] == [
        "1 ground", "2 crank", "3 coupler", "4 rocker"
    ]  # fmt: skip


@pytest.mark.parametrize("room", [(300.0, 200.0), (130.0, 400.0)])
def test_parts_lie_apart_within_their_sheets(room: tuple[float, float]) -> None:
    made = make(load("press"), way="laser", fit="A4")
    edges = [part.edge for part in documents.flat_parts(made)]
    sheets: dict[int, list[Any]] = {}
    for edge, one in zip(edges, nested(edges, room, 3.0), strict=True):
        assert isinstance(one, Laid)
        lying = polygon(moved(edge, one.at, one.turn))
        sheets.setdefault(one.sheet, []).append(shapely.Polygon([(p.real, p.imag) for p in lying]))
    assert sorted(sheets) == list(range(len(sheets)))
    for parts in sheets.values():
        assert all(
            shapely.box(-1e-6, -1e-6, *(side + 1e-6 for side in room)).contains(part) for part in parts
        )
        assert all(one.distance(other) > 2.999 for one, other in combinations(parts, 2))


@pytest.mark.parametrize(("way", "document"), [("laser", documents.svg), ("print", documents.bodies)])
def test_a_part_larger_than_its_sheet_is_named_with_the_way_out(way: str, document: Any) -> None:
    made = make(load("press"), way=way, sheet=(300.0, 200.0))
    with pytest.raises(BadInput, match=r"1 ground is 797 x 366 mm, which a sheet of 300 x 200 mm does not"):
        list(document(made))


def test_what_takes_hundreds_of_pages_is_refused_with_the_way_out() -> None:
    with pytest.raises(
        BadInput, match=r"pumpjack takes \d{3} pages of 210 x 297 mm; make it smaller \(--fit"
    ):
        documents.paper(make(load("pumpjack")))


def rasterised(document: bytes, page: Size, folder: Path, window: tuple[float, float, float, float]) -> Any:
    """Yield of each page what poppler draws in a window: left, foot, width and height in mm."""
    (folder / "parts.pdf").write_bytes(document)
    left, foot, wide, high = window
    sides = {"-x": left, "-y": page[1] - foot - high, "-W": wide, "-H": high}
    cut = [word for side, mm in sides.items() for word in (side, str(round(mm * _DPI / 25.4)))]
    program = ["pdftoppm", "-r", str(_DPI), "-gray", *cut, "parts.pdf", "page"]
    subprocess.run(program, cwd=folder, check=True, timeout=120)
    for path in sorted(folder.glob("page*.pgm")):
        yield np.asarray(Image.open(path)) < 128


def marks(row: NDArray[np.bool_]) -> list[float]:
    """Return the middles of what is dark in a row of pixels, in mm."""
    dark = np.flatnonzero(row)
    groups = np.split(dark, np.flatnonzero(np.diff(dark) > 1) + 1)
    return [float(group.mean()) * 25.4 / _DPI for group in groups]


@pytest.mark.slow
@pytest.mark.skipif(shutil.which("pdftoppm") is None, reason="needs poppler")
@pytest.mark.parametrize("page", PAGES)
def test_the_ruler_on_each_page_is_100_mm_long(page: str, tmp_path: Path) -> None:
    made = make(load("crank-shaper"), sheet=page)
    # a strip above the ruler's line that only its longest marks reach: at 0, 50 and 100 mm
    strips = list(rasterised(documents.paper(made), PAGES[page], tmp_path, (5.0, 21.2, 150.0, 0.5)))
    assert len(strips) > 1  # the lever is longer than a page
    for strip in strips:
        left, middle, right = marks(strip[len(strip) // 2])
        assert left + 5 == pytest.approx(10.0, abs=0.1)
        assert right - left == pytest.approx(100.0, abs=0.1)
        assert middle - left == pytest.approx(50.0, abs=0.1)


@pytest.mark.slow
@pytest.mark.skipif(shutil.which("pdftoppm") is None, reason="needs poppler")
def test_a_part_on_paper_is_in_true_size(tmp_path: Path) -> None:
    made = make(load("inverted-slider-crank"), bar=16.0, hole=5.0)
    # 20.25 mm above the foot of the room: across the bar, which stands upright at the left, and the ground
    (strip, *_) = rasterised(documents.paper(made), PAGES["A4"], tmp_path, (5.0, 46.0, 200.0, 0.5))
    bar_left, bar_right, ground_left, ground_right = marks(strip[len(strip) // 2])
    assert bar_left + 5 == pytest.approx(10.0, abs=0.1)
    assert bar_right - bar_left == pytest.approx(16.0, abs=0.1)
    # the ground's ends are half circles of 16 mm, 110 mm apart, their middles 16 mm above the foot
    assert ground_right - ground_left == pytest.approx(110 + 2 * math.sqrt(16.0**2 - 4.25**2), abs=0.1)


def test_crosses_of_neighbouring_pages_lie_over_each_other() -> None:
    made = make(load("press"))
    part = documents.flat_parts(made)[0]
    room = 190.0, 261.0
    tiles = documents._Tiles.of(part, room)
    assert (tiles.across, tiles.up) in {(2, 4), (5, 2), (2, 3), (4, 2), (5, 1), (1, 5)}
    places: dict[tuple[int, int], int] = {}
    step = room[0] - 10.0, room[1] - 10.0
    for row in range(tiles.up):
        for column in range(tiles.across):
            corner = complex(column * step[0], row * step[1])
            for cross in list(tiles._crosses(made, column, row))[::2]:
                assert isinstance(cross, Layer)
                middle = complex(np.mean(cross.loops[0])) / documents._PIXELS
                at = corner + complex(middle.real - 10.0, 297.0 - 26.0 - middle.imag)
                key = round(at.real), round(at.imag)
                places[key] = 1 + places.get(key, 0)
    assert set(places.values()) == {2}


@pytest.mark.thinned(2)
@pytest.mark.slow
@pytest.mark.parametrize("name", ["crank-rocker", "press", "scotch-yoke", "cardan-gears"])
def test_every_body_is_watertight_and_as_thick_as_the_material(name: str) -> None:
    made = make(load(name), way="print", thickness=5.0, bar=12.0 if name != "cardan-gears" else None)
    bodies = read_back(made)
    assert {label.split("-")[0] for label in bodies} >= {"part", "pin", "cap"}
    for label, body in bodies.items():
        assert body.is_watertight, label
        assert body.is_winding_consistent, label
        assert body.volume > 0, label
        high = body.extents[2]
        if label.startswith("part"):
            assert high == pytest.approx(5.0, abs=1e-5)
    for pin in made.pins:
        assert bodies[f"pin-{pin.name}"].extents[2] == pytest.approx(5.0 * (pin.high - pin.low + 1), abs=1e-4)
    ground = made.plates[0]
    area = shapely.Polygon([(p.real, p.imag) for p in polygon(ground.outline())]).area
    assert 0.5 * area * 5 < bodies["part-1 ground"].volume < area * 5


def test_a_pin_s_head_and_cap_lie_sunk_in_its_outermost_plates() -> None:
    made = make(load("crank-rocker"), way="print", bar=20.0, hole=8.0, thickness=6.0)
    bodies = read_back(made)
    pin, crank = bodies["pin-A"], bodies["part-2 crank"]
    # the crank, the lower of the two, has the head of A and the cap of O2: two steps of 2 mm deep
    bare = crank_area(made) * 6.0
    head = math.pi / 4 * ((8.0 + 3.0 + 0.4) ** 2 - 8.0**2) * 2.0
    assert crank.volume == pytest.approx(bare - 2 * head, rel=2e-3)
    assert pin.extents[0] == pytest.approx(11.0, abs=0.02)
    assert pin.volume == pytest.approx(math.pi / 4 * (7.6**2 * 12 + (11.0**2 - 7.6**2) * 2.0), rel=2e-3)
    assert bodies["cap"].extents[2] == pytest.approx(2.0, abs=1e-5)


def read_back(made: MadeLinkage) -> dict[str, Any]:
    return {
        label: trimesh.load(BytesIO(content), file_type="stl") for label, content in documents.bodies(made)
    }


def crank_area(made: MadeLinkage) -> float:
    edge, *holes = (
        shapely.Polygon([(p.real, p.imag) for p in polygon(outline)])
        for outline in (made.plates[1].outline(), *made.plates[1].cuts())
    )
    return float(edge.area - sum(hole.area for hole in holes))


def test_labels_stand_clear_of_holes() -> None:
    for name in ("crank-rocker", "press", "cardan-gears", "crank-shaper"):
        made = make(load(name), fit="A4")
        for part, plate in zip(documents.flat_parts(made), made.plates, strict=False):
            for hole in plate.holes:
                assert abs(hole.begin - part.at) > hole.radius, part.label
    assert re.fullmatch(r"\d+", make(load("press")).label(1))
    assert rounded([0j], 1.0)[0][1] == 1.0


def test_a_ring_s_name_is_on_the_ring_or_above_it() -> None:
    """On paper it lies level, however the ring is turned; each of its letters is off the hole and the rim."""
    made = make(load("jansen"), fit="A4")
    rings = [part for part in documents.flat_parts(made) if math.isfinite(part.room)]
    assert rings
    for part in rings:
        (outer, inner) = (abs(outline[0][0] - outline[1][0]) / 2 for outline in (part.edge, *part.holes))
        half = 0.5 * part.room * complex(0.55 * len(part.label), 1)
        corners = [
            part.at + x + y for x in (-half.real, half.real) for y in (-1j * half.imag, 1j * half.imag)
        ]
        assert all(inner < abs(corner.imag) and abs(corner) < outer for corner in corners)
        assert abs(part.at.imag) - half.imag > inner


@pytest.mark.parametrize("name", ["crank-rocker", "slider-crank", "six-bar", "press"])
def test_every_hole_has_its_letter_on_its_part_beside_it(name: str) -> None:
    made = make(load(name), way="laser", fit="A4")
    parts = documents.flat_parts(made)
    for plate, part in zip(made.plates, parts, strict=False):
        holes = [*(hole.joint for hole in plate.holes if hole.joint), *(slot.joint for slot in plate.slots)]
        assert [joint for joint, _ in part.letters] == holes
        whole = shapely.Polygon([(p.real, p.imag) for p in polygon(part.edge)])
        for joint, at in part.letters:
            assert whole.contains(shapely.Point(at.real, at.imag)), joint
            assert all(abs(at - hole.begin) > hole.radius for hole in plate.holes)
    text = documents.svg(made)
    drawing = ezdxf.filemanagement.read(StringIO(documents.dxf(made)))
    engraved = [one.dxf.text for one in drawing.modelspace().query("TEXT")]
    ground = [hole.joint for hole in made.plates[0].holes if hole.joint]
    assert ground
    for joint in ground:
        assert f">{joint}</text>" in text
        assert joint in engraved
