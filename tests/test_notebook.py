"""What a notebook is told, and what scenes and motions then show."""

from __future__ import annotations

import subprocess
import sys
from base64 import b64decode
from collections.abc import Callable
from types import SimpleNamespace
from typing import Any
from xml.etree import ElementTree

import numpy as np
import pytest

from linkanim.notebook import register
from linkanim.scenes import load, names
from linkanim.scenes.reading import scene_from
from linkanim.scenes.toml import parse
from linkanim.share.page import Shared, document

SVG = "{http://www.w3.org/2000/svg}"
Shown = dict[tuple[str, str], Callable[[Any], str]]


@pytest.fixture
def shown() -> Shown:
    """Return what a shell is told: what shows a class, by its module and name."""
    registered: Shown = {}

    def by_name(module: str, name: str, show: Callable[[Any], str]) -> None:
        registered[module, name] = show

    page = SimpleNamespace(for_type_by_name=by_name)
    register(SimpleNamespace(display_formatter=SimpleNamespace(formatters={"text/html": page})))
    return registered


def parsed(thing: Any, shown: Shown) -> ElementTree.Element:
    kind = type(thing)
    return ElementTree.fromstring(shown[kind.__module__, kind.__name__](thing))


def texts(page: ElementTree.Element, tag: str) -> list[str]:
    return ["".join(cell.itertext()) for cell in page.iter(tag)]


@pytest.mark.thinned(3)
@pytest.mark.parametrize("name", ["scotch-yoke", "press", "double-rocker"])
@pytest.mark.slow
def test_a_scene_shows_the_page_that_moves_beside_its_facts(name: str, shown: Shown) -> None:
    """Where the notebook is not trusted the frame and the style are left out, and the figure shows."""
    scene = load(name)
    page = parsed(scene, shown)
    (frame,) = page.iter("iframe")
    # as XML, an attribute has blanks for its line breaks
    assert frame.get("srcdoc") == document(Shared(scene, names=1)).replace("\n", " ")
    assert frame.get("sandbox") == "allow-scripts"
    assert [style.text for style in page.iter("style")] == ["iframe.linkanim + img { display: none; }"]
    (picture,) = page.iter("img")
    assert picture.get("alt") == scene.title
    kind, _, data = (picture.get("src") or "").partition(",")
    assert kind == "data:image/svg+xml;base64"
    groups = {group.get("id") for group in ElementTree.fromstring(b64decode(data)).iter(f"{SVG}g")}
    assert {f"body-{body.name}" for body in scene.linkage.bodies if len(body.joints) > 1} <= groups
    assert scene.info.class_name in texts(page, "td")


def test_a_scene_without_such_a_page_shows_its_figure(shown: Shown, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("linkanim.share.page.LARGEST", 1000)
    page = parsed(load("scotch-yoke"), shown)
    assert [*page.iter("iframe"), *page.iter("style")] == []
    assert len([*page.iter("img")]) == 1


def test_a_motion_shows_its_table_and_a_chart(shown: Shown) -> None:
    motion = load("crank-rocker").solve(angle=np.radians(np.arange(0, 360, 2)))
    page = parsed(motion, shown)
    rows = [texts(row, "td") for row in page.iter("tr")][1:]
    assert len(rows) == 11
    assert rows[5] == ["… 170 more rows …"]
    titles = texts(page, "th")
    at = titles.index("xB (mm)")
    assert [float(row[at]) for row in rows[:5]] == pytest.approx(motion.position["B"][:5, 0], rel=1e-5)
    assert [row[0] for row in rows[-5:]] == ["350", "352", "354", "356", "358"]
    assert "Rocker: angular velocity ω₄ (rad/s)" in " ".join(texts(page, f"{SVG}text")).replace("ω4", "ω₄")


# one instant; positions alone; a sweep that leaves the range; a swing by its phase; all rows the same
MOTIONS = {
    "one instant": ("press", {"angle": 1.0}, False),
    "positions alone": ("press", {"phase": np.linspace(0, 6, 20), "derivatives": 0}, True),
    "beyond the range": ("double-rocker", {"angle": np.linspace(0, 3, 20)}, True),
    "a swing": ("double-rocker", {"phase": np.linspace(0, 6, 20)}, True),
    "all the same": ("press", {"angle": np.ones(5)}, True),
}


@pytest.mark.parametrize(("name", "given", "charted"), MOTIONS.values(), ids=MOTIONS)
def test_any_motion_can_be_shown(name: str, given: dict[str, Any], charted: bool, shown: Shown) -> None:
    page = parsed(load(name).solve(**given), shown)
    assert bool(list(page.iter(f"{SVG}path"))) == charted
    assert "nan" not in "".join(page.itertext())


@pytest.mark.parametrize("name", names())
@pytest.mark.sampled
def test_every_scene_s_cycle_can_be_shown(name: str, shown: Shown) -> None:
    assert list(parsed(load(name).cycle(12), shown).iter(f"{SVG}path"))


def test_no_shell_is_told_nothing() -> None:
    register(None)


def test_the_package_tells_a_shell_that_is_there_and_imports_nothing_for_it() -> None:
    code = """
import sys, types
told = []
page = types.SimpleNamespace(for_type_by_name=lambda *asked: told.append(asked[:2]))
shell = types.SimpleNamespace(display_formatter=types.SimpleNamespace(formatters={"text/html": page}))
sys.modules["IPython"] = types.SimpleNamespace(get_ipython=lambda: shell)
import linkanim
assert [name for _, name in told] == ["Scene", "Motion"], told
assert not {"numpy", "pygame", "linkanim.scenes"} & set(sys.modules)
"""
    subprocess.run([sys.executable, "-c", code], check=True)


LONE = """
length_unit = "mm"
[drive]
slider = { joint = "C", from = -60, to = 60 }
speed = "20 rpm"
[ground]
O = [0, 0]
[joints.C]
line = { through = "O", angle = "30 deg" }
"""


def test_a_lone_slider_that_drives_can_be_shown(shown: Shown) -> None:
    scene = scene_from(parse(LONE, "my.toml"), name="my", where="my.toml")
    assert list(parsed(scene.cycle(12), shown).iter(f"{SVG}path"))


def test_the_input_of_a_slider_that_drives_is_its_travel(shown: Shown) -> None:
    motion = load("toggle-press").solve(phase=[0.5, 1.0, 2.0])
    page = parsed(motion, shown)
    assert texts(page, "th")[0] == "input travel (mm)"
    first = [texts(row, "td")[0] for row in list(page.iter("tr"))[1:]]
    assert [float(cell.replace("−", "-")) for cell in first] == pytest.approx(motion.coordinate, rel=1e-5)


def test_an_ipython_that_is_half_imported_is_no_shell() -> None:
    code = """
import sys, types
sys.modules["IPython"] = types.ModuleType("IPython")
import linkanim
"""
    subprocess.run([sys.executable, "-c", code], check=True)
