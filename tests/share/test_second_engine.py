"""The page in a browser of another make: the same joints, the same keys, nothing loaded, nothing logged."""

from __future__ import annotations

from collections.abc import Iterator
from math import cos, degrees, pi, sin
from pathlib import Path

import pytest
from second_engine import FIREFOX, SecondPage, second_browser
from shared_page import FINEST, PHASES, SAMPLE, centre_of, farthest, handle_of, phase, pressed, put

from linkanim.scenes import load, names
from linkanim.scenes.editing import ghost_of
from linkanim.share.page import Shared

pytestmark = [pytest.mark.window, pytest.mark.skipif(not FIREFOX, reason="needs Firefox")]


@pytest.fixture(scope="module")
def page(tmp_path_factory: pytest.TempPathFactory) -> Iterator[SecondPage]:
    with second_browser(tmp_path_factory.mktemp("profile")) as opened:
        yield opened


@pytest.mark.parametrize(
    "name", [pytest.param(name, marks=() if name in SAMPLE else pytest.mark.long) for name in names()]
)
def test_joints_lie_where_the_solver_has_them(name: str, page: SecondPage, tmp_path: Path) -> None:
    scene = load(name)
    page.go(put(tmp_path, Shared(scene, names=1)))
    for one in filter(None, (scene, ghost_of(scene))):
        assert max(farthest(page, one, at * scene.period / (2 * pi)) for at in PHASES) < FINEST
        page.key("b")
    page.value("document.getElementById('play').click()")
    page.frame()
    assert (page.messages, page.loaded) == ([], [])


def test_the_mouse_drags_the_crank_and_keys_do_what_they_do_in_the_window(
    page: SecondPage, tmp_path: Path
) -> None:
    scene = load("crank-rocker")
    page.go(put(tmp_path, Shared(scene)))
    (x, y), pin = centre_of(page), handle_of(page)
    radius, begin = abs(complex(*pin) - complex(x, y)), scene.pose(phase(page), 0).coordinate
    turns = [begin + n / 8 * (170 / 180 * pi - begin) for n in range(9)]
    page.drag([(x + radius * cos(turn), y - radius * sin(turn)) for turn in turns])
    there = degrees(scene.pose(phase(page), 0).coordinate) % 360
    assert there == pytest.approx(170, abs=1.5)  # the protocol has whole pixels
    page.key("ArrowRight")
    page.key("Shift", "ArrowRight")
    assert degrees(scene.pose(phase(page), 0).coordinate) % 360 == pytest.approx(there + 11)
    page.key("v")
    assert pressed(page, "velocity") == "true"
    assert (page.messages, page.loaded) == ([], [])
