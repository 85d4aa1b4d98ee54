"""A figure is the window's drawing, the same as PNG and as SVG, in groups that can be taken up again."""

from __future__ import annotations

import io
import re
from dataclasses import replace
from xml.etree import ElementTree

import numpy as np
import pygame
import pytest
from fidelity import psnr

from linkanim.paper.figure import Figured
from linkanim.picture.look import Look
from linkanim.picture.picture import Picture
from linkanim.picture.quantities import quantity
from linkanim.picture.raster import offscreen
from linkanim.picture.surface import SurfacePrinter
from linkanim.scenes import load

SIZE = (800, 450)
SVG = "{http://www.w3.org/2000/svg}"
FULL = Look(names=2, vectors=frozenset("va"), hud=False)
FLAT = replace(FULL, material="flat")


def _levels(surface: pygame.Surface) -> np.ndarray:
    return pygame.surfarray.array3d(surface).astype(float)


def _groups(figured: Figured) -> dict[str, ElementTree.Element]:
    return {
        group.get("id", ""): group for group in ElementTree.fromstring(figured.document()).iter(f"{SVG}g")
    }


@pytest.mark.parametrize("theme", ["light", "dark"])
@pytest.mark.parametrize("name", ["press", "crank-rocker", "slider-crank", "scotch-yoke", "jansen"])
def test_svg_as_another_program_renders_it_is_the_png(name: str, theme: str) -> None:
    """Pygame's reader of SVG is another's (nanosvg); it knows no text."""
    # the letters of many centres, which it does not draw, would be most of the difference
    look = Look(theme=theme, hud=False, centres=0 if name == "jansen" else 2)  # type: ignore[arg-type]
    figured = Figured(load(name), SIZE, look, phase=1.0, poses=3)
    theirs = pygame.image.load(io.BytesIO(figured.document().encode()), "f.svg")
    assert theirs.get_size() == SIZE
    assert psnr(_levels(figured.surface()), _levels(theirs)) > 30


@pytest.mark.parametrize("name", ["press", "kite"])
@pytest.mark.slow
def test_the_png_is_what_the_window_draws(name: str) -> None:
    """But for names, which a figure places for its pose, and for what stands at the edge of the stage."""
    scene, surface = load(name), offscreen(SIZE)
    bare, beside = replace(FLAT, names=0), replace(FLAT, names=0, polygons=True, centres=2)
    for look, share in ((bare, 0.0), (beside, 1e-4), (FLAT, 0.01)):
        SurfacePrinter().paint(surface, Picture(scene, SIZE, look, moment=1.0), scene.pose(1.0))
        apart = np.abs(_levels(Figured(scene, SIZE, look, phase=1.0).surface()) - _levels(surface))
        assert (apart.max(axis=-1) > 2).mean() <= share


# zoomed, so that the scene would run under its chart
@pytest.mark.parametrize("look", [Look(zoom=2.0, pan=(0.1, 0.2)), Look(theme="dark", polygons=True)])
def test_chart_words_and_key_stand_as_in_the_window(look: Look) -> None:
    scene, size, surface = load("press"), (960, 540), offscreen((960, 540))
    look = replace(look, chart="C.acceleration", vectors=frozenset("va"), material="flat")
    SurfacePrinter().print(surface, Picture(scene, size, look), 1.0, 4.0)
    figured = Figured(scene, size, look, phase=1.0, speed=4.0, as_seen=True)
    assert psnr(_levels(figured.surface()), _levels(surface)) > (30 if look.framed else 45)
    assert {"chart", "words", "key"} <= _groups(figured).keys()


@pytest.mark.parametrize("size", [SIZE, (450, 800)])
def test_what_stands_beside_a_zoomed_scene_is_kept_clear_of_it(size: tuple[int, int]) -> None:
    figured = Figured(load("crank-rocker"), size, Look(zoom=3.0, chart="rocker.angle", names=2), phase=1.0)
    (right, bottom), groups, cut = figured.picture.edge, _groups(figured), 0
    assert right < size[0] or bottom < size[1]
    for name in groups.keys() - {"chart", "reading", "words", "key", "slots"}:
        for path in groups[name].iter(f"{SVG}path"):
            x, y = np.array(re.findall(r"-?[\d.]+", path.attrib["d"]), float).reshape(-1, 2).T
            assert x.max() <= right
            assert y.max() <= bottom
            cut += x.max() > right - 1 or y.max() > bottom - 1
    assert cut


def test_every_body_and_joint_has_a_group_of_its_name() -> None:
    scene = load("press")
    groups = _groups(Figured(scene, SIZE, replace(FULL, centres=1), phase=1.0, poses=2))
    bodies = {f"body-{body.name}" for body in scene.linkage.bodies if len(body.joints) > 1}
    joints = {f"joint-{joint.name}" for joint in scene.linkage.joints}
    assert bodies | joints <= groups.keys()
    assert {
        "strut-return",
        "strut-cushion",
        "ground",
        "curve-H",
        "velocity",
        "pose-2",
        "names",
    } <= groups.keys()
    assert len(list(groups["joint-A"])) == 2


def test_ids_are_unique_and_have_no_spaces() -> None:
    text = Figured(load("jansen"), SIZE, FULL, phase=1.0, poses=3).document()
    ids = [group.get("id", "") for group in ElementTree.fromstring(text).iter(f"{SVG}g")]
    assert len(set(ids)) == len(ids)
    assert not any(name != "".join(name.split()) for name in ids)


def test_names_are_text_in_a_halo_with_their_subscripts() -> None:
    names = _groups(Figured(load("crank-rocker"), (1280, 720), FULL, phase=1.0))["names"]
    said = {"".join(text.itertext()) for text in names}
    assert {"O2", "A", "B", "O4", "P", "crank", "r2 = 50 mm", "θ2"} <= said
    assert all(text.get("paint-order") == "stroke" for text in names)
    lowered = [span for text in names for span in text if "".join(text.itertext()) == "O2"]
    assert [span.text for span in lowered] == ["2"]
    # a rim as wide as the letter's own would cover that letter's edge: "O2" read as "C2"
    (rim,) = (float(span.get("stroke-width", 99)) for span in lowered)
    assert 0 < rim < min(float(text.get("stroke-width", 0)) for text in names)


def test_the_press_is_a_small_file() -> None:
    figured = Figured(load("press"), (1280, 720), replace(FULL, centres=2, polygons=True), phase=1.0)
    assert len(figured.document().encode()) < 220_000  # with the letters that it carries


def test_without_a_background_nothing_is_behind() -> None:
    figured = Figured(load("kite"), SIZE, replace(FULL, background=False), phase=1.0)
    assert pygame.surfarray.array_alpha(figured.surface())[0, 0] == 0
    assert "<rect" not in figured.document()
    assert "<rect" in Figured(load("kite"), SIZE, FULL, phase=1.0).document()


def test_faint_poses_stay_behind_and_faint() -> None:
    scene = load("crank-rocker")
    bare = Look(hud=False, trace=False)
    plain = _levels(Figured(scene, SIZE, bare, phase=1.0).surface())
    many = _levels(Figured(scene, SIZE, bare, phase=1.0, poses=8).surface())
    changed = (many != plain).any(axis=-1)
    assert 0.1 < changed.mean() < 0.8
    assert np.abs(many - plain)[changed].mean() < 60


def test_a_figure_of_which_nothing_is_asked_is_of_one_pose_and_one_closure() -> None:
    scene = load("crank-rocker")
    bare, ghost = (Figured(scene, SIZE, replace(FULL, ghost=ghost), phase=1.0) for ghost in (False, True))
    assert "pose-1" not in _groups(bare)
    assert "pose-1" in _groups(ghost)
    assert "pose-2" not in _groups(ghost)
    assert bare.picture.view != ghost.picture.view


def _plain(symbol: str) -> str:
    return symbol.replace("{", "").replace("}", "")


def test_instant_centres_are_where_the_quantity_says_and_pins_are_not_marked() -> None:
    scene = load("six-bar")
    figured = Figured(scene, (1280, 720), Look(hud=False, centres=1))
    (marked,) = [group for group in figured.groups() if group.name == "instant-centres"]
    (named,) = [group for group in figured.groups() if group.name == "names"]
    own = {caption.text for caption in named.captions if caption.of == f"centre:{_plain(caption.text)}"}
    assert own == {"P_{13}", "P_{15}"}
    pose, view, numbers = (
        scene.pose(figured.shown_phase),
        figured.picture.view,
        figured.picture.figure.by_number,
    )
    lines, crosses = marked.layers
    assert len(crosses.loops) == 2 * 2
    for n, body in enumerate(numbers[number] for number in "35"):
        assert body is not None
        cross = np.concatenate(crosses.loops[2 * n : 2 * n + 2]).mean()
        wanted = view.pixel(quantity(scene, f"{body.name}.pole").read(pose))
        assert abs(cross - wanted) < 1e-6
    assert len(lines.loops) > 8  # Kennedy's, two to each
    # of the press no two lines lead to a centre; its ram's is at infinity
    figured = Figured(load("press"), (1280, 720), Look(hud=False, centres=1), phase=1.0)
    (far,) = [group for group in figured.groups() if group.name == "far-centres"]
    assert [caption.text for caption in far.captions] == ["P_{15}: at ∞"]
    (marked,) = [group for group in figured.groups() if group.name == "instant-centres"]
    assert [caption.text for caption in marked.captions] == ["P_{15}"]
    assert sum(len(layer.loops) for layer in marked.layers) == 1
