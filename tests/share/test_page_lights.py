"""What is pointed at, touched or focused on a page lights its part of the picture, and back."""

from __future__ import annotations

import math
from collections.abc import Iterator
from pathlib import Path

import pytest
from browser import PROGRAM, Page, browser
from shared_page import go_to, put

from linkanim.scenes import load, names
from linkanim.share.page import Shared

pytestmark = [pytest.mark.slow, pytest.mark.skipif(PROGRAM is None, reason="needs chromium")]

SAMPLE = ("press", "whitworth", "excavator", "engine", "pumpjack", "andrews")


@pytest.fixture(scope="module")
def page(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Page]:
    with browser(tmp_path_factory.mktemp("browser")) as opened:
        opened.sized(1280, 1100)
        opened.prefer(reduced_motion="reduce", color_scheme="light")
        yield opened


KEYS = (
    "[...document.querySelectorAll('WHERE [data-y]')].filter(one => !one.closest('[hidden]'))"
    ".flatMap(one => JSON.parse(one.dataset.y))"
)
LIT = (
    "[...document.querySelectorAll('WHERE .lit')]"
    ".filter(one => one.tagName !== 'path' || one.getAttribute('d'))"
    ".flatMap(one => JSON.parse(one.dataset.y))"
)


def keys(page: Page, where: str, script: str = KEYS) -> set[str]:
    return set(page.value(script.replace("WHERE", where)))


def opened(page: Page, name: str, folder: Path, chart: str | None = None) -> None:
    page.go(put(folder, Shared(load(name), names=2, chart=chart)))
    page.value("document.querySelectorAll('details').forEach(one => { one.open = true; })")
    page.frame()


@pytest.mark.parametrize(
    "name", [pytest.param(name, marks=() if name in SAMPLE else pytest.mark.long) for name in names()]
)
def test_all_that_is_said_of_a_part_has_it_in_the_picture(name: str, page: Page, tmp_path: Path) -> None:
    opened(page, name, tmp_path)
    said, drawn = keys(page, "#more") | keys(page, "#rows"), keys(page, "#side0")
    assert said
    assert said <= drawn
    scene = load(name)
    links = {f"l {link}" for link in scene.info.link_names.values()}
    assert {f"v {name}" for name in scene.trace} <= said
    assert {key for key in said if key.startswith("l ")} <= links
    assert page.messages == []


def rest(page: Page) -> None:
    """Take the pointer off everything."""
    page.mouse("mouseMoved", 1, 1)
    page.value("document.activeElement.blur()")
    page.frame()
    assert keys(page, "body", LIT) == set()


POINTED = """(() => {
  const box = (ONE).getBoundingClientRect();
  return [box.x + box.width / 2, box.y + box.height / 2];
})()"""


def middle(page: Page, one: str) -> list[float]:
    page.value(f"({one}).scrollIntoView({{block: 'nearest'}})")
    return list(page.value(POINTED.replace("ONE", one)))


def saying(key: str, where: str) -> str:
    every = f"[...document.querySelectorAll('{where} [data-y]')]"
    return f"{every}.find(one => JSON.parse(one.dataset.y).includes('{key}'))"


@pytest.mark.parametrize(
    ("key", "where"),
    [
        ("v B", "#points"),
        ("a B", "#points"),
        ("j A", "#points"),
        ("l 3", "#links"),
        ("f F_{A,3}", "#forces"),
        ("s C G", "#rows"),
        ("l 2", "#rows"),
        ("l 3", "#sliders"),
        ("g", "#sliders"),
    ],
)
@pytest.mark.parametrize("by", ["mouse", "touch", "focus"])
@pytest.mark.thinned(5)
def test_it_is_lit_by_mouse_touch_and_focus(
    key: str, where: str, by: str, page: Page, tmp_path: Path
) -> None:
    opened(page, "press", tmp_path)
    go_to(page, 3.0)
    one = saying(key, where)
    x, y = middle(page, one)
    left = page.value(f"({one}).getBoundingClientRect().left")
    if by == "mouse":
        page.mouse("mouseMoved", x, y)
    elif by == "touch":
        page.call("Input.dispatchTouchEvent", type="touchStart", touchPoints=[{"x": left + 4, "y": y}])
        page.call("Input.dispatchTouchEvent", type="touchEnd", touchPoints=[])
    else:
        page.value(f"(one => (one.matches('label') ? one.querySelector('input') : one).focus())({one})")
    page.frame()
    assert key in keys(page, "#side0", LIT)
    assert key in keys(page, where, LIT)
    rest(page)


def test_a_part_lights_what_is_said_of_it(page: Page, tmp_path: Path) -> None:
    opened(page, "press", tmp_path)
    go_to(page, 3.0)
    for key in ("v", "f"):
        page.key(key)
    for key, told in {"l 4": "#links", "v B": "#points", "f F_{B,4}": "#forces", "s C G": "#rows"}.items():
        page.value("scrollTo(0, 0)")
        one = saying(key, "#side0")
        outline = f"({one}).matches('path') ? {one} : [...({one}).querySelectorAll('path')].at(-1)"
        page.value(f"({outline}).dispatchEvent(new PointerEvent('pointerover', {{bubbles: true}}))")
        page.frame()
        assert key in keys(page, told, LIT)
    assert page.messages == []


def test_a_chart_lights_what_it_is_of(page: Page, tmp_path: Path) -> None:
    opened(page, "press", tmp_path, "B.velocity")
    page.value("scrollTo(0, 0)")
    page.mouse("mouseMoved", *middle(page, "document.getElementById('chart')"))
    page.frame()
    assert "v B" in keys(page, "#side0", LIT)
    rest(page)


def test_numbers_of_links_and_forces_are_those_of_the_solver(page: Page, tmp_path: Path) -> None:
    scene = load("press")
    opened(page, "press", tmp_path)
    for at in (0.6, 2.9, 4.4):
        go_to(page, at)
        pose = scene.pose(at)
        rows = page.value(
            "['links', 'forces'].map(id => [...document.querySelectorAll(`#${id} tbody tr`)]"
            ".map(row => [...row.children].map(one => one.textContent.replaceAll('−', '-'))))"
        )
        links = {row[0]: [float(one) for one in row[1:]] for row in rows[0]}
        assert set(links) == {"2", "3", "4", "6", "7"}
        for name, (angle, rate, second) in links.items():
            off = (angle - math.degrees(pose.angle[name]) + 180) % 360 - 180
            assert off == pytest.approx(0, abs=0.06)
            assert rate == pytest.approx(pose.angular_velocity[name], rel=6e-4, abs=1e-4)
            assert second == pytest.approx(pose.angular_acceleration[name], rel=6e-4, abs=1e-3)
        force = next(row for row in rows[1] if row[0] == "FA,3")
        x, y = (float(one) for one in force[1].strip("()").split(", "))
        assert (x, y) == pytest.approx(pose.reaction["A"]["3"], abs=0.6)
        assert float(force[2]) == pytest.approx(math.hypot(*pose.reaction["A"]["3"]), abs=0.6)


def test_a_force_too_small_for_its_digits_is_not_told_as_none(page: Page, tmp_path: Path) -> None:
    # a hundredth of a percent of the gas force at its greatest
    scene = load("engine")
    opened(page, "engine", tmp_path)
    go_to(page, 4.9)
    true = math.hypot(*scene.pose(4.9).reaction["A"]["rod"])
    assert 0 < true < 50
    rows = page.value(
        "[...document.querySelectorAll('#forces tbody tr')]"
        ".map(row => [...row.children].map(one => one.textContent))"
    )
    assert ["FA,3", "–", "< 100"] in rows
