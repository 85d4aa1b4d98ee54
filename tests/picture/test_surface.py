"""A painter draws a pose the same way every time, and what stands still once."""

from __future__ import annotations

import math
import subprocess
import sys
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pygame
import pytest
from fidelity import frame_decibels
from pictures import BARE, SMALL, alphas, painted, pixels, stated, with_panels

from linkanim.errors import BadInput
from linkanim.picture.bodies import colours_of
from linkanim.picture.drawn import Additions
from linkanim.picture.figure import figure
from linkanim.picture.game_panel import GamePanel
from linkanim.picture.items import Caption, Group, Halo, Target
from linkanim.picture.layout import Docked
from linkanim.picture.lists import EditRow, Panel, Quantities
from linkanim.picture.look import Look, ThemeName
from linkanim.picture.marks import Glow
from linkanim.picture.picture import Picture
from linkanim.picture.raster import offscreen
from linkanim.picture.shapes import hull
from linkanim.picture.surface import SurfacePrinter
from linkanim.picture.text import Fonts
from linkanim.picture.theme import theme_of
from linkanim.player.clock import Clock
from linkanim.player.state import RunningRecording, State
from linkanim.scenes import load, names
from linkanim.scenes.editing import ghost_of, on_the_way
from linkanim.scenes.scene import Scene
from linkanim.ui.panels import Panels

FULL = Look(vectors=frozenset("va"), chart="B.velocity")


def _bytes(surface: pygame.Surface) -> bytes:
    return bytes(surface.get_buffer().raw)


@pytest.mark.thinned(3)
@pytest.mark.parametrize(
    ("name", "theme"), [(name, ("light", "dark")[k % 2]) for k, name in enumerate(names())]
)
@pytest.mark.sampled
def test_every_scene_is_painted_on_its_theme(name: str, theme: ThemeName) -> None:
    surface = painted(load(name), 1.0, Look(theme=theme, vectors=frozenset("va")))
    assert surface.get_at((SMALL[0] - 1, 0))[:3] == theme_of(theme).background
    assert len(np.unique(pixels(surface).reshape(-1, 3), axis=0)) > 50


@pytest.mark.parametrize("look", [FULL, replace(FULL, theme="dark"), BARE, replace(BARE, background=False)])
def test_the_same_pose_gives_the_same_bytes_whatever_came_between(look: Look) -> None:
    scene = load("press")
    painter, surface = Picture(scene, (640, 360), look), offscreen((640, 360), alpha=not look.background)
    printer = SurfacePrinter()
    printer.paint(surface, painter, scene.pose(1.0))
    first = _bytes(surface)
    for phase in (2.0, 3.5, 100.0):
        printer.paint(surface, painter, scene.pose(phase), Additions((Glow("A"),), grip=True, stands=True))
        assert _bytes(surface) != first
    printer.paint(surface, painter, scene.pose(1.0))
    assert _bytes(surface) == first
    assert _bytes(painted(scene, 1.0, look, (640, 360))) == first


@pytest.mark.parametrize(
    "change",
    [
        {"theme": "dark"},
        {"trace": False},
        {"vectors": frozenset("v")},
        {"vectors": frozenset("a")},
        {"chart": "3.angle"},
        {"hud": False},
        {"zoom": 1.25},
        {"pan": (0.1, 0.0)},
    ],
)
def test_each_choice_of_the_look_changes_the_picture(change: dict[str, Any]) -> None:
    scene = load("press")
    look = replace(Look(), **change)
    assert _bytes(painted(scene, 1.0, look)) != _bytes(painted(scene, 1.0, Look()))


@pytest.mark.slow
def test_what_is_kept_of_a_picture_has_a_bound() -> None:
    """Shapes that come again take no more than a few pictures, labels no more than a few frames'."""
    scene, size, printer = load("press"), SMALL, SurfacePrinter()
    picture, surface = Picture(scene, size, replace(FULL, names=2)), offscreen(size)
    taken = []
    for step in range(12):
        printer.paint(surface, picture, scene.pose(0.0685 * step))
        taken.append(sum(cover.nbytes for _, cover in printer._covers.values()))
    assert 0 < max(taken) <= 8 * surface.get_buffer().length
    for number in range(40):  # as a length under the hand
        line = Caption(f"{number} mm", (60.0, 40.0), 12, (0, 0, 0), halo=Halo((255, 255, 255), 2.0))
        printer._words(surface, picture.type, (Group("names", (), [line]),))
        printer._labels.let_go()
    assert len(printer._labels._kept) < 12


@pytest.mark.parametrize("name", ["press", "crank-rocker", "slider-crank"])
def test_a_frame_is_the_mean_of_sixty_four_samples_of_the_same_drawing(name: str) -> None:
    # Below what two equal pictures have: something is drawn.
    assert 44 <= frame_decibels(load(name), (1.0,)) < 80


@pytest.mark.parametrize("look", [FULL, replace(FULL, theme="dark", chart=None)])
@pytest.mark.parametrize("size", [(640, 360), (320, 180)])
def test_a_painter_that_takes_over_paints_as_one_that_begins(look: Look, size: tuple[int, int]) -> None:
    scene, beside = load("press"), Additions((Glow("A"),), grip=True)
    printer, pictures = SurfacePrinter(), []
    printer.paint(offscreen((640, 360)), Picture(scene, (640, 360), FULL), scene.pose(0.5), beside)
    for one in (SurfacePrinter(), printer):
        surface = offscreen(size)
        one.paint(surface, Picture(scene, size, look), scene.pose(1.0), beside)
        pictures.append(_bytes(surface))
    assert pictures[0] == pictures[1]


def test_a_painter_that_takes_over_renders_no_glyph_again(monkeypatch: pytest.MonkeyPatch) -> None:
    scene = load("press")
    with_panels(Picture(scene, (640, 360), FULL), 0.5, stated(words="told"))

    def refused(*_: object) -> None:
        raise AssertionError("a glyph is rendered again")

    monkeypatch.setattr(Fonts, "render", refused)
    with_panels(Picture(scene, (640, 360), FULL), 0.5, stated(words="told"))


@pytest.mark.parametrize("change", [{"theme": "dark"}, {"pan": (0.1, 0.2), "zoom": 2.0}])
def test_another_theme_or_view_composes_nothing_anew(change: dict[str, Any]) -> None:
    scene, look = load("press"), Look(names=2)
    before = Picture(scene, (640, 360), look)
    after = Picture(scene, (640, 360), replace(look, **change))
    assert after.composition is before.composition
    assert (after.view != before.view) == ("zoom" in change)


@pytest.mark.parametrize("change", [{"theme": "dark"}, {"vectors": frozenset("va")}, {"chart": "3.angle"}])
def test_a_hud_follows_its_theme_and_its_place(change: dict[str, Any]) -> None:
    scene, look = load("press"), replace(Look(), **change)
    picture = Picture(scene, (640, 360), look)
    found = picture._hud
    assert found is not None
    assert (found.place, found.block, found.theme) == (
        picture.layout.hud,
        picture.composition.block,
        picture.theme,
    )


def test_without_a_background_only_what_is_drawn_is_opaque() -> None:
    scene, look = load("crank-rocker"), Look(hud=False, background=False, theme="dark")
    clear, solid = painted(scene, 1.0, look), painted(scene, 1.0, replace(look, background=True))
    opacity = alphas(clear)
    assert opacity[0, 0] == 0
    inside, plate = opacity == 255, (opacity > 0.5 * 255) & (opacity < 0.75 * 255)
    assert 0.01 < inside.mean() < 0.1
    assert 0.03 < plate.mean() < 0.2
    assert pixels(clear)[inside] == pytest.approx(pixels(solid)[inside], abs=2)


def test_pins_and_rims_of_a_light_picture_without_a_background_are_as_white_as_paper() -> None:
    scene, look = load("crank-rocker"), Look(hud=False, background=False, material="flat")
    clear, solid = painted(scene, 1.0, look), painted(scene, 1.0, replace(look, background=True))
    grounded = (alphas(clear) == 255) & (pixels(solid) == theme_of("light").background).all(axis=-1)
    assert grounded.any()
    assert (pixels(clear)[grounded] == 255).all()


@pytest.mark.parametrize(
    "surface",
    [pygame.Surface((400, 200), 0, 24), pygame.Surface(SMALL, 0, 32, (0xFF, 0xFF00, 0xFF0000, 0))],
    ids=["larger, three bytes to a pixel", "red first"],
)
def test_a_surface_of_another_kind_or_size_gets_the_same_picture(surface: pygame.Surface) -> None:
    scene = load("press")
    painter, wanted = Picture(scene, SMALL, BARE), pixels(painted(scene, 1.0))
    for phase in (0.5, 1.0):
        SurfacePrinter().paint(surface, painter, scene.pose(phase))
    assert np.array_equal(pixels(surface)[: SMALL[1], : SMALL[0]], wanted)


def test_zoom_enlarges_about_the_middle_and_pan_shifts_by_the_height() -> None:
    scene = load("crank-rocker")
    fitted, near = (
        Picture(scene, SMALL, BARE).view,
        Picture(scene, SMALL, replace(BARE, zoom=2.0)).view,
    )
    assert near.scale == pytest.approx(2 * fitted.scale)
    assert near.to_world(160, 90) == pytest.approx(fitted.to_world(160, 90))
    shifted = Picture(scene, SMALL, replace(BARE, pan=(0.5, -0.25))).view
    assert (shifted.x - fitted.x, shifted.y - fitted.y) == pytest.approx((90, -45))


def test_the_crank_pin_lies_where_the_pose_has_it() -> None:
    scene = load("press")
    painter, pose = Picture(scene, SMALL, Look()), scene.pose(0.7)
    assert painter.view.to_world(*painter.crank_pin_px(pose)) == pytest.approx(pose.position["A"])


def test_the_chart_tells_the_phase_under_a_pixel() -> None:
    scene = load("kite")
    painter = Picture(scene, (640, 360), Look(chart="rocker.angle"))
    assert painter.layout.chart
    middle = painter.layout.chart.middle
    (chart,) = _charts(painter)
    low, *_, high = (chart.value.phase_at(px) for px in range(640) if chart.place.holds(px, middle.imag))
    assert not chart.place.holds(*painter.crank_pin_px(scene.pose(0.0)))
    # from the crank's angle 0 through two turns; the drive starts at 60°
    for phase, turned in ((low, 0.0), (high, 2 * math.tau)):
        away = math.remainder(scene.linkage.drive.start + phase - turned, scene.period)
        assert away == pytest.approx(0.0, abs=0.1)
    assert _charts(Picture(scene, (640, 360), Look())) == []


def _charts(picture: Picture) -> list[Target]:
    groups = picture.groups(picture.scene.pose(0.0))
    return [one for group in groups for one in group.targets if one.kind == "chart"]


def test_an_unknown_chart_is_answered_with_the_list() -> None:
    with pytest.raises(BadInput, match=r"rocker\.colour.*nearest are .*rocker\.angle, .*--quantity list"):
        Picture(load("crank-rocker"), SMALL, Look(chart="rocker.colour"))


def test_the_ghost_is_drawn_where_the_look_asks_and_behind_this_closure() -> None:
    scene = load("crank-rocker")
    other = scene.pose(2.5)
    look = replace(BARE, ghost=True)
    plain = pixels(painted(scene, 1.0, look))
    haunted = pixels(painted(scene, 1.0, look, ghost=other))
    changed = np.any(haunted != plain, axis=-1)
    assert changed.mean() > 0.02
    assert np.abs(haunted - plain)[changed].mean() < 80
    colour = theme_of("light").bodies[0]
    solid = np.all(plain == colour, axis=-1)
    assert np.array_equal(haunted[solid], plain[solid])


# As a window shows it: with the ghost, zoomed, panned; else the scene has all the room.
def test_the_other_closure_takes_room_only_where_it_is_shown() -> None:
    scene = load("crank-rocker")
    alone, both = (Picture(scene, SMALL, look).fitted for look in (BARE, replace(BARE, ghost=True)))
    assert both.scale < 0.8 * alone.scale
    for look in (replace(BARE, zoom=2.0), replace(BARE, pan=(0.1, 0.0)), replace(BARE, pan=(0.0, 0.1))):
        assert Picture(scene, SMALL, look).fitted == alone


# A scene, and one on the way to it, whose ghost has its lengths.
@pytest.mark.parametrize("gone", [False, True])
def test_the_ghost_is_the_other_closure_at_the_same_phase(gone: bool) -> None:
    scene = load("crank-rocker")
    shown = on_the_way(scene, {("four-bar", "crank"): 45.0}) if gone else scene
    other, look = ghost_of(shown), replace(BARE, ghost=True)
    assert other is not None
    pose, (faint,) = Picture(shown, SMALL, look).poses(1.0, 2.0)
    assert (pose.input_speed, faint.phase) == (2.0, 1.0)
    for joint, place in other.pose(1.0, 0).position.items():
        assert faint.position[joint] == pytest.approx(place)
    assert Picture(shown, SMALL, BARE).poses(1.0)[1] == ()


@pytest.mark.parametrize("crank", [20.0, 45.0])
def test_a_scene_on_the_way_is_seen_in_the_view_of_the_one_it_becomes(crank: float) -> None:
    scene = load("crank-rocker")
    shown = on_the_way(scene, {("four-bar", "crank"): crank})
    picture = Picture(shown, SMALL, BARE)
    assert picture.view == Picture(scene, SMALL, BARE).view
    assert picture.figure.scene is shown


PANELS = {
    "a pause": stated(clock=Clock(4.0, paused=True)),
    "a recording": stated(recording=RunningRecording("gif", 0)),
    "a message": stated(words="saved crank-rocker.gif"),
    "the help": stated(helped=True),
    "a list": stated(Quantities((("Rocker: angle", "θ₄ (°)"),), 0, "rock", "Enter charts")),
    "an empty list": stated(Quantities((), 0, "nothing")),
    "values": stated(Panel((EditRow("crank", "40 mm", chosen=True),), error="too long", hint="Esc closes")),
}


@pytest.mark.parametrize("state", PANELS.values(), ids=PANELS)
def test_each_panel_shows(state: State) -> None:
    painter = Picture(load("crank-rocker"), (640, 360), Look(), docked=Docked(bar=True))
    assert _bytes(with_panels(painter, 1.0, state)) != _bytes(with_panels(painter, 1.0))


def test_a_panel_that_is_kept_follows_what_it_says() -> None:
    picture, panels = Picture(load("crank-rocker"), (640, 360), Look(), docked=Docked(bar=True)), Panels()
    said = []
    for words in ("one", "another", "one"):
        sheets, _ = panels.drawn(stated(words=words), picture.layout, picture.theme)
        said.append([(_bytes(one.surface), one.at) for one in sheets])
    assert said[0] != said[1]
    assert said[0] == said[2]


@pytest.mark.parametrize("size", [(320, 180), (640, 360), (1920, 1080), (500, 700)])
def test_a_long_help_fits_any_window(size: tuple[int, int]) -> None:
    scene = load("crank-rocker")
    surface = with_panels(Picture(scene, size, Look(chart="B.velocity")), 1.0, stated(helped=True))
    background = (*theme_of("light").background, 255)
    assert all(tuple(surface.get_at((x, size[1] // 2))) == background for x in (0, size[0] - 1))
    assert all(tuple(surface.get_at((size[0] // 2, y))) == background for y in (0, size[1] - 1))


def test_the_help_veils_a_game_s_panel() -> None:
    picture, panels = Picture(load("crank-rocker"), (640, 360), Look()), []
    panel = GamePanel("Heading", lines=("A question?",))
    for helped in (False, True):
        surface = with_panels(picture, 1.0, stated(panel, helped=helped))
        panels.append(min(sum(surface.get_at((x, y))[:3]) for x in range(8, 120) for y in range(8, 30)))
    clear, veiled = panels  # the darkest of its words
    assert veiled > clear + 200


LONG = (
    "s + l = 180 > p + q = 130: the crank cannot turn fully; it swings −115.6°…115.6° (Enter again takes it)"
)


HINT = "↑ ↓ choose   ← → nudge   digits type   Enter takes   Ctrl+Z undo   Ctrl+S save   Esc closes"


@pytest.mark.parametrize("size", [(640, 360), (1280, 720), (500, 700)])
@pytest.mark.parametrize(("count", "chosen"), [(8, 7), (30, 0), (30, 11), (30, 29)])
def test_an_edit_list_stays_inside_the_window_and_shows_the_chosen_row_at_a_size_that_reads(
    count: int, chosen: int, size: tuple[int, int]
) -> None:
    rows = tuple(EditRow(f"joints.A{n}.length", "55 mm", n == chosen) for n in range(count))
    picture = Picture(load("crank-rocker"), size, Look())
    surface = with_panels(picture, 1.0, stated(Panel(rows, error=LONG, hint=HINT)))
    theme = theme_of("light")
    edge = [(x, y) for x in range(0, size[0] // 2, 7) for y in (0, size[1] - 1)]
    assert all(tuple(surface.get_at(place)) == (*theme.background, 255) for place in edge)
    marked = (pixels(surface) == theme.chosen).all(axis=-1).any(axis=1)
    assert marked.sum() >= 1.2 * 17 * size[0] / 1280


@pytest.mark.parametrize("size", [(64, 36), (16, 16), (200, 900), (2000, 90)])
def test_odd_windows_are_painted_without_complaint(size: tuple[int, int]) -> None:
    surface = painted(load("press"), 1.0, FULL, size)
    assert len(np.unique(pixels(surface).reshape(-1, 3), axis=0)) > 3


@pytest.mark.parametrize("theme", ["light", "dark"])
@pytest.mark.parametrize(
    ("name", "phase", "pin", "bar"),
    [
        ("triple-rocker-in-out", 0.0, "A", "rocker"),
        ("triple-rocker-in-out", 2.0, "O2", "rocker"),
        ("double-rocker", 0.0, "A", "rocker"),
        ("kite", 5.227, "O2", "rocker"),
    ],
)
def test_a_pin_that_passes_behind_a_bar_does_not_show_on_it(
    name: str, phase: float, pin: str, bar: str, theme: ThemeName
) -> None:
    """Such a pin would look like a joint of that bar, which the linkage does not have."""
    scene, size, look = load(name), (1280, 720), replace(BARE, theme=theme)
    x, y = Picture(scene, size, look).view.to_pixel(*scene.pose(phase).position[pin])
    drawn = painted(scene, phase, look, size)
    wanted = colours_of(figure(scene), theme_of(theme))[bar]
    assert tuple(drawn.get_at((int(x), int(y))))[:3] == wanted


@pytest.mark.parametrize("theme", ["light", "dark"])
@pytest.mark.parametrize(
    ("name", "phase"), [("slider-crank", 0.0), ("slider-crank", 0.3), ("crank-rocker", 4.5), ("six-bar", 2.0)]
)
def test_a_curve_is_not_cut_where_it_enters_a_plate(name: str, phase: float, theme: ThemeName) -> None:
    scene, size, look = load(name), (640, 360), replace(BARE, theme=theme)
    with_curve, without = (
        pixels(painted(scene, phase, replace(look, trace=trace), size)) for trace in (True, False)
    )
    differ = np.abs(with_curve - without).max(axis=-1)
    behind = [differ[int(y), int(x)] for x, y in _curve_behind_plates(scene, phase, size)]
    assert len(behind) > 15
    assert min(behind) > 9


def _curve_behind_plates(scene: Scene, phase: float, size: tuple[int, int]) -> list[tuple[float, float]]:
    """Return pixels of the traced joint's curve that lie well inside a plate, and behind no bar."""
    shown, painter, pose = figure(scene), Picture(scene, size, BARE), scene.pose(phase)
    at = {name: painter.view.pixel(place) for name, place in pose.position.items()}
    plates = [[at[name] for name in body.joints] for body in shown.bodies if len(body.joints) > 2]
    bars = [[at[name] for name in body.joints] for body in shown.bodies if len(body.joints) == 2]
    points = [place for name in scene.trace for place in shown.path(name, painter.view)[::3]]
    return [
        (point.real, point.imag)
        for point in points
        if any(_margin(point, plate) > 8 for plate in plates)
        and all(_distance(point, *bar) > 12 for bar in bars)
    ]


def _margin(point: complex, corners: list[complex]) -> float:
    """Return how far a point lies inside a convex polygon; negative outside."""
    ring = hull(corners)
    sides = zip(ring, ring[1:] + ring[:1], strict=True)
    return min(((point - one) * (other - one).conjugate()).imag / abs(other - one) for one, other in sides)


def _distance(point: complex, one: complex, other: complex) -> float:
    """Return how far a point lies from a line between two others."""
    along = ((point - one) / (other - one)).real
    return abs(point - one - min(max(along, 0.0), 1.0) * (other - one))


def test_beside_an_open_list_no_words_are_measured(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("linkanim.picture.composition.widest_rows", lambda *_: pytest.fail("no HUD is shown"))
    Picture(load("press"), (640, 360), Look(), docked=Docked(listed=1))


@pytest.mark.parametrize(
    "name",
    [
        "epicyclic-hypocycloid",
        *(pytest.param(name, marks=pytest.mark.long) for name in ("six-bar", "press")),
    ],
)
@pytest.mark.slow
def test_frames_in_any_order_are_those_that_a_fresh_printer_prints(name: str) -> None:
    """Nothing of a frame is left in what a printer keeps for the next; a pixel's fourth byte is not seen."""
    scene = load(name)
    look = Look(vectors=frozenset("va"), names=2, ghost=name == "six-bar", chart="input.angular_velocity")
    one, surface, printer = Picture(scene, SMALL, look), offscreen(SMALL), SurfacePrinter()

    @cache
    def fresh(phase: float) -> bytes:
        page = offscreen(SMALL)
        ghosts = (scene.pose(phase + 1.0),)
        SurfacePrinter().paint(page, Picture(scene, SMALL, look), scene.pose(phase), faint=ghosts)
        return pygame.image.tobytes(page, "RGB")

    for phase in (5.1, 0.4, 5.1):
        printer.paint(surface, one, scene.pose(phase), faint=(scene.pose(phase + 1.0),))
        assert pygame.image.tobytes(surface, "RGB") == fresh(phase)


_FAULTS = """
from resource import RUSAGE_SELF, getrusage
from linkanim.picture.items import Caption, Group, Halo
from linkanim.picture.look import Look
from linkanim.picture.picture import Picture
from linkanim.picture.raster import offscreen
from linkanim.picture.surface import SurfacePrinter
from linkanim.scenes import load
scene, size = load("crank-rocker"), (1280, 720)
picture, surface, printer = Picture(scene, size, Look()), offscreen(size), SurfacePrinter()
poses = [scene.pose(0.1 * frame) for frame in range(40)]
for pose in poses[:20]:
    printer.paint(surface, picture, pose)
before = getrusage(RUSAGE_SELF).ru_minflt
for pose in poses[20:]:
    printer.paint(surface, picture, pose)
print((getrusage(RUSAGE_SELF).ru_minflt - before) / 20)
"""


@pytest.mark.skipif(sys.platform != "linux", reason="counts the pages that Linux hands out")
@pytest.mark.slow
def test_a_frame_works_in_the_memory_of_the_one_before() -> None:
    """Asked back from the system page by page, memory took half of a frame's time: 1,400 pages each."""
    told = subprocess.run([sys.executable, "-c", _FAULTS], capture_output=True, text=True, check=True).stdout
    assert float(told.split()[-1]) < 100
