"""A page as it looks: names, key, chart and numbers, with the lengths that it has and with others."""

from __future__ import annotations

import re
from math import degrees
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from browser import PROGRAM, Page, browser
from shared_page import go_to, phase, put, shown
from test_lengths import document

from linkanim.scenes import load
from linkanim.scenes.reading import scene_from
from linkanim.share.lengths import model
from linkanim.share.page import Shared

pytestmark = pytest.mark.skipif(PROGRAM is None, reason="needs chromium")

SCENES = ("crank-rocker", "press", "slider-crank", "whitworth", "jansen", "geared-five-bar-2-1")
SIZES = {"a screen": (1280, 720), "a slide's frame": (800, 450), "a phone": (390, 844)}
NAMES = """(() => {
  const picture = document.getElementById("picture").getBoundingClientRect();
  return [...document.querySelectorAll("#side0 [data-m]:not(.off) text")].map((text) => {
    const box = text.getBoundingClientRect(), { a } = text.getScreenCTM();
    const inside = box.left >= picture.left - 1 && box.right <= picture.right + 1 &&
      box.top >= picture.top - 1 && box.bottom <= picture.bottom + 1;
    return [text.textContent, Number(text.getAttribute("font-size")) * a, inside];
  });
})()"""


@pytest.fixture(scope="module")
def page(tmp_path_factory: pytest.TempPathFactory) -> Any:
    with browser(tmp_path_factory.mktemp("browser")) as opened:
        opened.prefer(reduced_motion="reduce", color_scheme="light")
        yield opened


def change(page: Page, *factors: float) -> list[float]:
    """Multiply the first lengths of a page, and return all."""
    for number, factor in enumerate(factors):
        page.value(f"lengths.change({number}, {factor} * lengths.solver.values[{number}])")
    page.frame()
    return list(page.value("lengths.solver.values"))


@pytest.mark.slow
@pytest.mark.parametrize("where", SIZES)
@pytest.mark.parametrize("name", SCENES)
@pytest.mark.thinned(5)
def test_names_can_be_read_and_are_all_seen(name: str, where: str, page: Page, tmp_path: Path) -> None:
    page.sized(*SIZES[where])
    page.go(put(tmp_path, Shared(load(name), names=1)))
    for factors in ((), (1.3, 0.9)):
        change(page, *factors)
        for at in (0.0, 1.3, 2.6, 3.9, 5.2):
            go_to(page, at)
            names = page.value(NAMES)
            assert len(names) > 4
            assert [one for one in names if one[1] < 11.99 or not one[2]] == [], (factors, at)


@pytest.mark.slow
@pytest.mark.parametrize("name", SCENES)
def test_a_phone_has_no_empty_box(name: str, page: Page, tmp_path: Path) -> None:
    page.sized(390, 844)
    page.go(put(tmp_path, Shared(load(name))))
    assert page.value("document.documentElement.scrollWidth") <= 390
    wide, high, box = page.value(
        "(() => { const picture = document.getElementById('picture'), box = picture.getBoundingClientRect();"
        "const { width, height } = picture.viewBox.baseVal;"
        "return [width, height, [box.width, box.height]]; })()"
    )
    assert box[1] == pytest.approx(box[0] * high / wide, rel=0.02)
    empty = (
        "[...document.querySelectorAll('#told > *, #panes > *')]"
        ".filter((one) => one.checkVisibility() && one.getBoundingClientRect().height > 2"
        " && !one.childElementCount && !one.textContent).map(({ id }) => id)"
    )
    assert page.value(empty) == []


ARROW = """(() => {
  const data = JSON.parse(document.getElementById("data").textContent).sides[0];
  const number = data.movers.findIndex(({ kind, order }) => kind === "arrows" && order === ORDER);
  const group = document.querySelectorAll("#side0 [data-m]")[number];
  const path = group.children[data.movers[number].at.indexOf("P")];
  const corners = path.getAttribute("d").match(/-?[\\d.]+/g).map(Number), { a } = path.getScreenCTM();
  // an arrow's foot is between its first corner and its last, its tip the fourth
  const long = Math.hypot(...[0, 1].map((n) => corners[6 + n] - (corners[n] + corners[12 + n]) / 2));
  return [long * a, document.querySelector("#key svg path").getBoundingClientRect().width];
})()"""


@pytest.mark.slow
@pytest.mark.parametrize(("order", "name"), [(1, "velocity"), (2, "acceleration")])
@pytest.mark.parametrize("factors", [(), (0.8, 1.1)], ids=["its own lengths", "other lengths"])
def test_the_key_says_what_arrows_stand_for(
    order: int, name: str, factors: tuple[float, ...], page: Page, tmp_path: Path
) -> None:
    page.sized(1280, 720)
    scene = load("crank-rocker")
    page.go(put(tmp_path, Shared(scene)))
    values = change(page, *factors)
    assert shown(page, "key") == ""
    page.value(f"document.getElementById('{name}').click()")
    go_to(page, 1.0)
    found = model(scene)
    assert found
    known = scene_from(document(found, values), name="page", where="page.toml")
    motion = known.pose(phase(page), speed=scene.linkage.drive.speed)
    rate = motion.velocity["P"] if order == 1 else motion.acceleration["P"]
    words = re.fullmatch(rf"{name}([\d.]+) mm/s²?", shown(page, "key"))
    assert words
    arrow, sample = page.value(ARROW.replace("ORDER", str(order)))
    assert arrow / sample * float(words[1]) == pytest.approx(float(np.hypot(*rate)), rel=0.02)


def reading(page: Page) -> list[float]:
    """Return the numbers that stand at a chart's cursor."""
    text = page.value("document.querySelector('#chart > text:last-of-type').textContent")
    return [float(one) for one in re.findall(r"-?\d+\.?\d*", text.replace("−", "-"))]


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "token"),
    [
        ("crank-rocker", "P.velocity"),
        ("crank-rocker", "P.position"),
        ("crank-rocker", "P.acceleration.y"),
        ("crank-rocker", "rocker.angle"),
        ("crank-rocker", "rocker.angular_velocity"),
        ("crank-rocker", "coupler.angular_acceleration"),
        ("slider-crank", "slider.travel"),
        ("slider-crank", "slider.travel_velocity"),
        ("whitworth", "bar.angular_velocity"),
    ],
)
def test_a_chart_is_that_of_the_lengths_that_are_shown(
    name: str, token: str, page: Page, tmp_path: Path
) -> None:
    page.sized(1280, 720)
    scene = load(name)
    page.go(put(tmp_path, Shared(scene, chart=token)))
    values, found = change(page, 0.9, 1.05), model(scene)
    assert found
    stated = document(found, values)
    bodies = {body.name: {"joints": list(body.joints)} for body in scene.linkage.bodies if not body.slider}
    sliders = {body.name: {"slider": body.slider} for body in scene.linkage.bodies if body.slider}
    start = f"{degrees(scene.linkage.drive.start)!r} deg"
    other = scene_from({**stated, "bodies": bodies | sliders}, name="page", where="page.toml")
    speed = scene.linkage.drive.speed
    digits = page.value("JSON.parse(document.getElementById('data').textContent).sides[0].charts[0].digits")
    for at in (0.4, 1.7, 3.0, 4.9):
        go_to(page, at)
        pose = other.solve(angle=np.array([scene.linkage.drive.start + phase(page)]), speed=speed)
        true = np.atleast_1d(np.squeeze(other.quantities[token].displayed(pose)))
        told = np.array(reading(page))
        off = told - true
        if other.quantities[token].unit == "rad":
            off = (off + 180) % 360 - 180
        assert np.abs(off).max() <= 0.6 * 10.0**-digits + 1e-6 * np.abs(true).max(), (told, true, start)
    page.value("document.getElementById('reset').click()")
    page.frame()
    own = np.atleast_1d(scene.quantities[token].displayed(scene.pose(phase(page))))
    assert reading(page) == pytest.approx(own.tolist(), abs=0.6 * 10.0**-digits)
    assert page.messages == []


@pytest.mark.slow
def test_a_joint_does_not_seem_to_stand_at_a_limit(page: Page, tmp_path: Path) -> None:
    page.sized(1280, 720)
    page.go(put(tmp_path, Shared(load("crank-rocker"), chart="P.velocity")))
    change(page, 0.8, 1.8)
    for limit in (0.0, np.pi):
        found = []
        for at in (limit, limit + 2e-3):
            go_to(page, float(at))
            found += reading(page)
        assert found[0] > 1.0
        assert found[0] == pytest.approx(found[1], rel=0.02)


@pytest.mark.slow
def test_what_does_not_follow_from_joints_is_said_and_never_stale(page: Page, tmp_path: Path) -> None:
    page.sized(1280, 720)
    scene = load("press")
    page.go(put(tmp_path, Shared(scene, chart="input.torque")))
    assert page.value("document.querySelectorAll('#chart path').length") > 4
    assert "input torque" in shown(page, "rows")
    change(page, 1.05)
    assert page.value("document.querySelectorAll('#chart path').length") == 0
    assert "for the page’s own lengths alone" in shown(page, "chart")
    rows = shown(page, "rows")
    assert "input torque" not in rows
    go_to(page, 1.0)
    ends = page.value("['C', 'G'].map((name) => lengths.tracks.get(name).at(1.0).p)")
    scale = page.value("JSON.parse(document.getElementById('data').textContent).sides[0].view[0]")
    long = float(np.hypot(*np.subtract(*ends))) / scale
    assert f"return spring, length{long:.1f} mm" in shown(page, "rows")


@pytest.mark.slow
@pytest.mark.parametrize("name", ["crank-rocker", "slider-crank", "press"])
def test_no_dimension_of_its_own_stands_beside_other_lengths(name: str, page: Page, tmp_path: Path) -> None:
    page.sized(1280, 720)
    page.go(put(tmp_path, Shared(load(name), names=2)))
    words = "[...document.querySelectorAll('#side0 text')].filter((one) => !one.closest('.off'))"
    words += ".map((one) => one.textContent).filter((text) => text.includes('='))"
    assert len(page.value(words)) > 3
    change(page, 1.1)
    assert page.value(words) == []
    page.value("document.getElementById('reset').click()")
    page.frame()
    assert len(page.value(words)) > 3


@pytest.mark.slow
def test_a_linkage_on_a_change_point_is_seen_with_its_arrows(page: Page, tmp_path: Path) -> None:
    page.sized(1280, 720)
    page.go(put(tmp_path, Shared(load("crank-rocker"))))
    page.value("document.getElementById('acceleration').click()")
    change(page, 0.8, 1.5)
    assert shown(page, "about").startswith("With other lengths: change-point")
    go_to(page, 1.0)
    wide, high = page.value(
        "(() => { const { width, height } = document.getElementById('picture').viewBox.baseVal;"
        "return [width, height]; })()"
    )
    assert wide < 2500
    assert high < 2500
    assert page.messages == []


@pytest.mark.slow
def test_the_sentence_is_that_of_the_lengths_that_are_shown(page: Page, tmp_path: Path) -> None:
    page.sized(1280, 720)
    page.go(put(tmp_path, Shared(load("crank-rocker"))))
    own = shown(page, "about")
    assert own.startswith("Grashof crank-rocker. The crank turns fully")
    change(page, 0.8, 1.8)
    assert shown(page, "about").startswith("With other lengths: triple-rocker")
    assert "The input swings between" in shown(page, "about")
    assert "swings/min" in shown(page, "rows")
    page.value("document.getElementById('reset').click()")
    page.frame()
    assert shown(page, "about") == own
