"""Arrows of forces on a page: those that solving gives, forth and back, and none where they are not known."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import read_tables
from browser import PROGRAM, Page, browser
from pushed import PUSHED
from shared_page import go_to, pressed, put, shown

from linkanim.cli import main
from linkanim.picture.motion_marks import pulls
from linkanim.scenes import load
from linkanim.scenes.editing import ghost_of, other_return
from linkanim.scenes.reading import scene_from
from linkanim.scenes.scene import Scene
from linkanim.scenes.toml import parse
from linkanim.share.page import Shared, document

LOADED = """
[ground]
O2 = [0, 0]
O4 = [100, 0]
[joints.A]
crank = "O2"
length = 40
[joints.B]
from = ["A", "O4"]
length = [120, 80]
side = "left"
[bodies]
coupler = { joints = ["A", "B"] }
rocker = { joints = ["O4", "B"] }
[loads.wind]
on = "coupler"
at = [30, 25]
force = { size = "50 N", angle = "90 deg", turns = true }
[loads.hand]
on = "rocker"
at = "B"
force = ["20 N", "-7 N"]
[dampers.oil]
between = ["B", "O2"]
coefficient = "300 N s/m"
"""


def scene_of(name: str) -> Scene:
    """Return a scene of the catalogue or of the above; with `, same` it comes back as it went."""
    name, _, more = name.partition(", ")
    text = {"loaded": LOADED, "dead": PUSHED}.get(name)
    scene = scene_from(parse(text, name), name=name, where=name) if text else load(name)
    return {"": lambda: scene, "same": lambda: other_return(scene), "static": lambda: scene.without_inertia}[
        more
    ]()


def held(text: str) -> Any:
    found = re.search(r'id="data">(.*?)</script>', text, re.DOTALL)
    assert found
    return json.loads(found[1])


def arrows_in(data: Any, side: int = 0) -> Any:
    return next(one for one in data["sides"][side]["movers"] if one["kind"] == "arrows" and not one["order"])


def told(data: Any, n: int, phase: float, *, back: bool, side: int = 0) -> tuple[float, float]:
    """Return the force (N) of an arrow as a page has it at a phase."""
    mover = arrows_in(data, side)
    packed = mover["values"][-1 if back else 0]
    steps = read_tables.unpacked({"kind": "i2"}, packed).reshape(len(mover["at"]), 2, -1)[n]
    x, y = (
        mover["grain"][n] * read_tables.read_values(mover, column, data, phase, back=False)
        for column in steps
    )
    return x, y


# masses, a spring and a damper; a gas table with its corners; masses alone; a working force in one way; loads
# off a joint and beside a damper; forces that grow without bound at both ends; at rest
SCENES = ("press", "engine", "andrews", "knuckle-press", "loaded", "dead", "dead, same", "engine, static")


@pytest.mark.parametrize(
    "name",
    [
        pytest.param(one, marks=[pytest.mark.slow] * (one not in ("loaded", "dead", "andrews")))
        for one in SCENES
    ],
)
def test_a_page_s_forces_are_what_is_solved(name: str) -> None:
    scene = scene_of(name)
    data = held(document(Shared(scene)))
    sides = [scene, ghost_of(scene)][: len(data["sides"])]
    for number, one in enumerate(filter(None, sides)):
        mover = arrows_in(data, number)
        for phase in np.linspace(0.013, scene.period, 97, endpoint=False).tolist():
            for way in (1, -1):
                pose = one.pose(phase, speed=way * one.linkage.drive.speed)
                for n, pull in enumerate(pulls(pose)):
                    assert mover["symbols"][n] == pull.symbol
                    found = told(data, n, phase, back=way < 0, side=number)
                    # of what is drawn, a thousandth of the longest arrow's third is not seen
                    near = max(1e-3 * math.hypot(*pull.value), 3e-3 * mover["longest"] / mover["per"])
                    assert math.dist(found, pull.value) <= near, (pull.symbol, phase, way)


def test_what_has_no_forces_has_no_arrows_of_them() -> None:
    movers = held(document(Shared(load("crank-rocker"))))["sides"][0]["movers"]
    assert {one["order"] for one in movers if one["kind"] == "arrows"} == {1, 2}


@pytest.mark.slow
def test_a_page_at_rest_is_asked_for_as_a_chart_at_rest_is(tmp_path: Path, capsys: Any) -> None:
    target = tmp_path / "page.html"
    assert main(["share", "engine", "--static", "-o", str(target)]) == 0
    assert target.read_text(encoding="utf-8") == document(Shared(load("engine").without_inertia))
    assert arrows_in(held(target.read_text(encoding="utf-8")))["words"] == "force as at rest"
    assert main(["share", "crank-rocker", "--static", "-o", str(target)]) == 2
    assert "states no mass" in capsys.readouterr().err
    assert main(["share", "--all", str(tmp_path / "site"), "--static"]) == 2
    assert "--static" in capsys.readouterr().err


@pytest.fixture(scope="module")
def page(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Page]:
    with browser(tmp_path_factory.mktemp("browser")) as opened:
        opened.sized(1280, 720)
        opened.prefer(reduced_motion="reduce", color_scheme="light")
        yield opened


DRAWN = """(() => {
  const { sides } = JSON.parse(document.getElementById("data").textContent), { view, movers } = sides[0];
  const number = movers.findIndex((one) => one.kind === "arrows" && !one.order);
  const group = document.querySelector(`#side0 [data-m="${number}"]`), { per } = movers[number];
  if (group.classList.contains("off")) return null;
  return [...group.querySelectorAll("path")].map((path) => {
    const numbers = path.getAttribute("d").match(/-?[\\d.]+/g)?.map(Number);
    if (!numbers) return null;
    const corner = (n) => [numbers[2 * n], numbers[2 * n + 1]], [x, y] = corner(3);
    const [left, top] = [0, 1].map((n) => (corner(0)[n] + corner(6)[n]) / 2);
    return [(left - view[1]) / view[0], (view[2] - top) / view[0], (x - left) / per, (top - y) / per];
  });
})()"""
needs_chromium = pytest.mark.skipif(PROGRAM is None, reason="needs chromium")


@pytest.mark.slow
@needs_chromium
@pytest.mark.parametrize("name", ["press", "engine", "loaded", "dead"])
def test_arrows_stand_where_forces_act_and_are_as_long(name: str, page: Page, tmp_path: Path) -> None:
    scene = scene_of(name)
    page.go(put(tmp_path, Shared(scene)))
    assert page.value(DRAWN) is None
    page.key("f")
    assert pressed(page, "force") == "true"
    assert re.fullmatch(r"force[\d.]+ N", shown(page, "key"))
    mover, seen = arrows_in(held(document(Shared(scene)))), 0
    for way in (1, -1):
        for at in (0.4, 1.9, 3.3, 5.6):
            go_to(page, at)
            pose = scene.pose(at, speed=way * scene.linkage.drive.speed)
            for drawn, pull in zip(page.value(DRAWN), pulls(pose), strict=True):
                long = math.hypot(*pull.value) * mover["per"]
                if drawn is None:
                    assert not 0.015 * mover["longest"] < long < 0.98 * mover["drawn"], pull.symbol
                    continue
                seen += 1
                assert math.dist(drawn[:2], pull.place) < 0.02
                assert math.dist(drawn[2:], pull.value) * mover["per"] < 0.002 * long + 0.5
        page.key("d")
    assert seen > 12
    assert page.messages == []


@pytest.mark.slow
@needs_chromium
def test_forces_of_other_lengths_are_not_drawn_and_that_is_said(page: Page, tmp_path: Path) -> None:
    page.go(put(tmp_path, Shared(load("press"))))
    page.key("f")
    assert page.value(DRAWN)
    page.value("lengths.change(0, 1.05 * lengths.solver.values[0])")
    page.frame()
    assert page.value(DRAWN) is None
    assert shown(page, "key") == "Forces are known for the page’s own lengths alone."
    page.value("document.getElementById('reset').click()")
    page.frame()
    assert page.value(DRAWN)
    assert "known" not in shown(page, "key")


@pytest.mark.slow
@needs_chromium
def test_a_page_without_forces_has_no_button_for_them(page: Page, tmp_path: Path) -> None:
    page.go(put(tmp_path, Shared(load("crank-rocker"))))
    assert not page.value("document.getElementById('force').checkVisibility()")
    page.key("f")
    assert shown(page, "key") == ""
    assert page.messages == []
