"""Title, numbers and the sign of a pause stand in their corners, whatever else is shown."""

from __future__ import annotations

import pytest

from linkanim.picture.layout import Docked
from linkanim.picture.look import Look
from linkanim.picture.picture import Deferral, Picture
from linkanim.picture.view import Rect
from linkanim.scenes import load, names
from linkanim.scenes.scene import Scene

SIZES = [(640, 360), (1280, 720), (1920, 1080), (3840, 2160), (720, 1280)]

IN_STEPS = Deferral(names="in steps")
"""The layout is what is looked at: no name needs its place."""


def looks(scene: Scene) -> dict[str, Look]:
    return {
        "bare": Look(),
        "chart": Look(chart=scene.telling[0]),
        "polygons": Look(polygons=True),
        "names": Look(names=1, caption=True),
        "dimensions": Look(names=2, caption=True),
        "arrows": Look(vectors=frozenset("va"), ink=True),
        "all": Look(chart=scene.telling[0], polygons=True, names=1, caption=True),
    }


@pytest.mark.thinned(6)
@pytest.mark.parametrize("size", SIZES)
@pytest.mark.parametrize("name", ["crank-rocker", "press", "driven-piston", "six-bar", "jansen"])
def test_words_and_sign_stand_in_their_corners_in_every_look(name: str, size: tuple[int, int]) -> None:
    scene = load(name)
    corners, signs = set(), set()
    for look in looks(scene).values():
        layout = Picture(scene, size, look, later=IN_STEPS).layout
        if layout.hud:  # a small window has no room for words beside all of it
            corners.add((layout.hud.x, layout.hud.y))
        signs.add((layout.marks.right, layout.marks.y))
    edge = max(20 * min(max(size) / 1280, min(size) / 720), 6.0)
    assert corners == {(edge, edge)}
    assert signs == {(size[0] - edge, edge)}


@pytest.mark.parametrize("size", SIZES)
@pytest.mark.parametrize("listed", [False, True])
def test_the_sign_stays_beside_an_open_list(listed: bool, size: tuple[int, int]) -> None:
    layout = Picture(load("crank-rocker"), size, Look(), docked=Docked(listed=listed), later=IN_STEPS).layout
    assert (layout.marks.right, layout.marks.y) == pytest.approx((size[0] - layout.margin, layout.margin))


@pytest.mark.parametrize("name", names())
@pytest.mark.sampled
def test_nothing_is_drawn_under_words_or_the_sign_of_a_pause(name: str) -> None:
    scene = load(name)
    picture = Picture(scene, (640, 360), Look(), later=IN_STEPS)
    layout = picture.layout
    side = 1.2 * layout.text_size
    sign = Rect(layout.marks.right - side, layout.marks.y, side, side)
    assert not any(sign.meets(words) for words in layout.words)
    for phase in (0.0, 1.0, 2.0, 3.0, 4.0, 5.0):
        for x, y in scene.pose(phase, 0).position.values():
            px, py = picture.view.to_pixel(x, y)
            assert not any(rect.holds(px, py) for rect in (sign, *layout.words))


def test_the_table_of_dimensions_begins_below_the_sign() -> None:
    for name in ("jansen", "press"):
        layout = Picture(load(name), (3840, 2160), Look(names=2), later=IN_STEPS).layout
        if layout.table:
            assert (
                layout.table.y >= layout.marks.y + 1.2 * layout.text_size
                or layout.table.right < layout.marks.x
            )


def test_a_title_keeps_off_the_sign_in_a_narrow_window() -> None:
    for wide in range(200, 700, 20):
        layout = Picture(load("press"), (wide, 360), Look(), later=IN_STEPS).layout
        side = 1.2 * layout.text_size
        sign = Rect(wide - layout.margin - side, layout.margin, side, side)
        assert not any(sign.meets(words) for words in layout.words)
