"""The page in a real browser: where joints lie in it, hand and keys, what it loads and logs."""

from __future__ import annotations

from collections.abc import Iterator
from html import escape
from math import atan2, cos, degrees, floor, log10, pi, radians, sin
from pathlib import Path

import pytest
from browser import PROGRAM, Page, browser
from shared_page import (
    FINEST,
    PHASES,
    SAMPLE,
    centre_of,
    farthest,
    go_to,
    handle_of,
    phase,
    pressed,
    put,
    shown,
)

from linkanim.picture.hud import rows as readings
from linkanim.scenes import load, names
from linkanim.scenes.editing import ghost_of
from linkanim.scenes.reading import scene_from
from linkanim.scenes.toml import parse
from linkanim.share.page import Shared, document

pytestmark = [pytest.mark.window, pytest.mark.skipif(not PROGRAM, reason="needs Chromium")]


@pytest.fixture(scope="module")
def page(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Page]:
    with browser(tmp_path_factory.mktemp("profile")) as opened:
        opened.sized(1280, 720)
        opened.prefer(reduced_motion="reduce", color_scheme="light")
        yield opened


@pytest.mark.parametrize(
    "name", [pytest.param(name, marks=() if name in SAMPLE else pytest.mark.long) for name in names()]
)
def test_joints_lie_where_the_solver_has_them_on_both_closures(name: str, page: Page, tmp_path: Path) -> None:
    scene = load(name)
    address = put(tmp_path, Shared(scene, names=1))
    page.go(address)
    for one in filter(None, (scene, ghost_of(scene))):
        assert max(farthest(page, one, at * scene.period / (2 * pi)) for at in PHASES) < FINEST
        page.key("b")
    page.value("document.getElementById('play').click()")
    page.frame()
    assert page.messages == []
    assert page.requests == [address]


ODD = """
title = "odd names"
[ground]
constructor = [0, 0]
toString = [100, 0]
valueOf = [200, 0]
[joints.__proto__]
crank = "constructor"
length = 30
[joints.hasOwnProperty]
from = ["__proto__", "toString"]
length = [90, 80]
side = "left"
[joints.length]
from = ["hasOwnProperty", "valueOf"]
length = [110, 80]
side = "left"
[bodies.constructor]
joints = ["__proto__", "hasOwnProperty"]
com = [20, 10]
[trace]
joints = ["length"]
"""


def test_joints_are_called_as_every_object_s_own_things(page: Page, tmp_path: Path) -> None:
    (tmp_path / "odd.toml").write_text(ODD, encoding="utf-8")
    scene = load(tmp_path / "odd.toml")
    page.go(put(tmp_path, Shared(scene, names=1)))
    page.value("document.getElementById('numbers').open = true")
    assert max(farthest(page, scene, at) for at in PHASES) < FINEST
    rows = page.value("[...document.querySelectorAll('#points tbody th')].map((cell) => cell.textContent)")
    centre = "constructor (centre of mass)"
    assert sorted(rows) == sorted([*(joint.name for joint in scene.linkage.joints), centre])
    assert page.messages == []


def test_the_mouse_drags_the_crank(page: Page, tmp_path: Path) -> None:
    scene = load("crank-rocker")
    page.go(put(tmp_path, Shared(scene)))
    for target in (40.0, 100.0, 170.0, 250.0, 330.0):
        drag(page, target)
        assert degrees(scene.pose(phase(page), 0).coordinate) % 360 == pytest.approx(target, abs=0.6)
    assert shown(page, "play") == "Play"


def drag(page: Page, target: float) -> None:
    """Drag the crank's pin to an angle, in degrees."""
    pin = handle_of(page)
    centre = centre_of(page)
    radius = abs(complex(*pin) - complex(*centre))
    begin = atan2(centre[1] - pin[1], pin[0] - centre[0])
    turn = (target / 180 * pi - begin + pi) % (2 * pi) - pi
    page.mouse("mouseMoved", *pin)
    page.mouse("mousePressed", *pin)
    for n in range(1, 9):
        angle = begin + turn * n / 8
        page.mouse("mouseMoved", centre[0] + radius * cos(angle), centre[1] - radius * sin(angle))
    page.frame()
    page.mouse("mouseReleased", *pin)


def test_a_finger_drags_an_input_that_swings_on_through_its_limit(page: Page, tmp_path: Path) -> None:
    scene = load("double-rocker")
    page.go(put(tmp_path, Shared(scene)))
    go_to(page, 0.9 * pi)
    there = handle_of(page)
    page.call("Input.dispatchTouchEvent", type="touchStart", touchPoints=[{"x": there[0], "y": there[1]}])
    for at in (0.95, 1.0, 1.05, 1.1):
        place = page.value(
            f"(() => {{ const data = JSON.parse(document.getElementById('data').textContent);"
            "const svg = document.getElementById('picture').getScreenCTM(), view = data.sides[0].view;"
            f"const point = {list(scene.pose(at * pi, 0).position[scene.linkage.drive.joint])};"
            "const to = new DOMPoint(view[1] + view[0] * point[0], view[2] - view[0] * point[1]);"
            "const at = to.matrixTransform(svg); return [at.x, at.y]; })()"
        )
        page.call("Input.dispatchTouchEvent", type="touchMove", touchPoints=[{"x": place[0], "y": place[1]}])
        page.frame()
    page.call("Input.dispatchTouchEvent", type="touchEnd", touchPoints=[])
    assert phase(page) == pytest.approx(1.1 * pi, abs=0.02)


def test_keys_do_what_they_do_in_the_window(page: Page, tmp_path: Path) -> None:
    page.go(put(tmp_path, Shared(load("press"), chart="5.travel_velocity", names=1)))
    assert shown(page, "play") == "Play"
    page.key("ArrowRight", code="ArrowRight")
    page.key("ArrowRight", code="ArrowRight", modifiers=8)
    assert degrees(phase(page)) == pytest.approx(11.0)
    page.key("ArrowLeft", code="ArrowLeft")
    assert degrees(phase(page)) == pytest.approx(10.0)
    for key, name, now in (("t", "trace", "false"), ("v", "velocity", "true"), ("a", "acceleration", "true")):
        page.key(key)
        assert pressed(page, name) == now
    page.key("d")
    assert pressed(page, "reverse") == "true"
    assert shown(page, "rows").startswith("crank angle10.0°input speed−20 rpm")
    page.key(" ")
    assert shown(page, "play") == "Pause"
    page.key("r")
    page.key(" ")
    assert page.messages == []


def test_numbers_are_those_of_the_solver(page: Page, tmp_path: Path) -> None:
    scene = load("press")
    page.go(put(tmp_path, Shared(scene, chart="5.travel_velocity")))
    go_to(page, 1.0)
    page.value("document.getElementById('numbers').open = true")
    page.frame()
    motion = scene.pose(1.0)
    assert f"{motion.spring['return'].length:.1f} mm" in shown(page, "rows")
    assert f"{motion.damper['cushion'].force:.1f} N" in shown(page, "rows")
    x, y = (f"{value:.4g}".replace("-", "−") for value in motion.position["B"])
    assert f"B({x}, {y})" in shown(page, "numbers")
    assert f"{motion.travel_velocity['5']:.1f} mm/s" in shown(page, "chart")


# Quick changes of acceleration lie between the nodes of a track.
@pytest.mark.parametrize("name", ["press", "klann", "crank-rocker", "double-rocker"])
def test_rates_are_those_of_the_solver_in_all_four_digits(name: str, page: Page, tmp_path: Path) -> None:
    scene = load(name)
    page.go(put(tmp_path, Shared(scene)))
    page.value("document.getElementById('numbers').open = true")
    lines = "[...document.querySelectorAll('#points tbody tr')]"
    cells = f"{lines}.map(row => [...row.children].map(one => one.textContent))"
    for at in (1.4386, *(0.37 + 0.9 * n for n in range(6))):
        go_to(page, at)
        pose = scene.pose(at)
        for joint, _, *told in (row for row in page.value(cells) if row[0] in pose.velocity):
            for said, true in zip(told, (pose.velocity[joint], pose.acceleration[joint]), strict=True):
                found = [float(one) for one in said.strip("()").replace("−", "-").split(", ")]
                size = max(map(abs, true))
                last = 10.0 ** (floor(log10(size)) - 3) if size > 1e-9 else 1e-9
                assert found == pytest.approx(true, abs=0.9 * last), (joint, at)


def test_the_cursor_of_a_chart_reads_a_value_beside_a_pole(page: Page, tmp_path: Path) -> None:
    scene, token = load("slider-crank"), "mechanical_advantage"
    page.go(put(tmp_path, Shared(scene, chart=token)))
    for at in (2.3612, 2.35, 1.0):
        go_to(page, at)
        told = page.value("document.querySelector('#chart > text:last-of-type').textContent")
        exact = float(scene.quantities[token].read(scene.pose(phase(page))))
        assert float(told) == pytest.approx(exact, rel=1e-4, abs=0.006)


def test_the_pointer_reads_the_joint_under_it(page: Page, tmp_path: Path) -> None:
    scene = load("crank-rocker")
    page.go(put(tmp_path, Shared(scene)))
    go_to(page, 1.0)
    centre = centre_of(page)
    page.mouse("mouseMoved", *centre)
    page.frame()
    assert shown(page, "reading").startswith("O2 (0, 0) mm\nv = 0 mm/s")


# 359.999° is 0° to four digits.
@pytest.mark.parametrize(
    ("name", "link", "phases", "reading"),
    [
        ("wiper", "link", (0.0, 1.0, pi, 4.0), "link: ω = 0 rad/s\n260 mm at 0°"),
        ("crank-rocker", "crank", (2 * pi - 1e-5,), "crank: ω = 2.094 rad/s\n50 mm at 0°"),
    ],
)
def test_the_pointer_reads_0_where_a_link_s_number_is_0(
    name: str, link: str, phases: tuple[float, ...], reading: str, page: Page, tmp_path: Path
) -> None:
    page.go(put(tmp_path, Shared(load(name))))
    middle = (
        "(() => { const { movers } = JSON.parse(document.getElementById('data').textContent).sides[0];"
        f"const number = movers.findIndex((mover) => mover.link === '{link}');"
        "const box = document.querySelector(`#side0 [data-m='${number}']`).getBoundingClientRect();"
        "return [(box.left + box.right) / 2, (box.top + box.bottom) / 2]; })()"
    )
    for at in phases:
        go_to(page, at)
        page.mouse("mouseMoved", *page.value(middle))
        page.frame()
        assert shown(page, "reading") == reading


def test_it_runs_in_a_frame_and_rests_where_motion_is_not_wanted(page: Page, tmp_path: Path) -> None:
    held = escape(document(Shared(load("slider-crank"))), quote=True)
    outer = tmp_path / "slide.html"
    outer.write_text(
        f"<!doctype html><title>slide</title><link rel=icon href='data:,'>"
        f'<iframe width=640 height=360 srcdoc="{held}"></iframe>',
        encoding="utf-8",
    )
    inside = "document.querySelector('iframe').contentDocument.getElementById('play').textContent"
    for wish, word in (("reduce", "Play"), ("no-preference", "Pause")):
        page.prefer(reduced_motion=wish)
        page.go(outer.as_uri())
        assert page.value(inside) == word
        high, whole = page.value(
            "(() => { const root = document.querySelector('iframe').contentDocument.documentElement;"
            "return [root.scrollHeight, root.clientHeight]; })()"
        )
        assert high <= whole
        assert page.messages == []
    page.prefer(reduced_motion="reduce")


def test_colours_go_by_the_reader_s_setting_unless_one_is_stated(page: Page, tmp_path: Path) -> None:
    back = "getComputedStyle(document.body).backgroundColor"
    dark, light = "rgb(17, 20, 26)", "rgb(252, 252, 250)"
    for stated, wish, found in ((None, "dark", dark), (None, "light", light), ("light", "dark", light)):
        page.prefer(color_scheme=wish, reduced_motion="reduce")
        page.go(put(tmp_path, Shared(load("kite"), theme=stated)))  # type: ignore[arg-type]
        assert page.value(back) == found
    page.prefer(color_scheme="light", reduced_motion="reduce")


def test_all_that_is_pressed_has_a_name_for_a_screen_reader(page: Page, tmp_path: Path) -> None:
    page.go(put(tmp_path, Shared(load("press"), chart="5.travel_velocity", names=1)))
    nodes = page.call("Accessibility.getFullAXTree")["nodes"]
    roles = ("button", "slider", "combobox", "image", "toolbar")
    named = [
        (node["role"]["value"], node.get("name", {}).get("value", ""))
        for node in nodes
        if not node.get("ignored") and node.get("role", {}).get("value") in roles
    ]
    assert ("slider", "crank angle") in named
    assert len(named) >= 12
    assert [role for role, name in named if not name] == []


SIMPLE = """
length_unit = "mm"
gravity = "9.81 m/s^2"
[slider-crank]
crank = 60
rod = 40
[bodies.slider]
slider = "B"
mass = "450 g"
"""


@pytest.mark.parametrize("returns", ["other", "same"])
def test_a_torque_beside_a_limit_is_a_number_and_at_it_not_bounded(
    returns: str, page: Page, tmp_path: Path
) -> None:
    text = SIMPLE.replace("[slider-crank]", f'[drive]\nreturns = "{returns}"\n[slider-crank]')
    scene = scene_from(parse(text, "simple"), name="simple", where="simple")
    page.go(put(tmp_path, Shared(scene, chart="B.velocity.x")))
    for degrees_ in (0.0, 0.01, 1.0, 178.0, 179.9, 180.0, 180.01, 181.0, 183.5, 359.0):
        pose = scene.pose(radians(degrees_))
        go_to(page, radians(degrees_))
        told = dict(readings(scene, pose))["input torque"]
        page_says = shown(page, "rows").rpartition("torque")[2]
        one, other = (
            float(words.removesuffix(" N m").replace("−", "-").replace("∞", "inf"))
            for words in (page_says, told)
        )
        assert one == pytest.approx(other, rel=1e-3), degrees_
        cursor = str(page.value("document.querySelector('#chart > text:last-of-type').textContent"))
        velocity = float(cursor.strip().removesuffix(" mm/s").replace("−", "-"))
        assert velocity == pytest.approx(pose.velocity["B"][0], abs=0.6)
