"""Pages are read by everybody: no violation that axe-core knows, and every control by keyboard alone."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

import pytest
from browser import PROGRAM, Page, browser

from linkanim.cli import main
from linkanim.scenes import load
from linkanim.share.page import Shared

AXE = Path(os.environ.get("LINKANIM_AXE", "~/.cache/linkanim-tests/axe.min.js")).expanduser()
"""axe-core's one file: `npm pack axe-core` brings it."""

pytestmark = pytest.mark.skipif(PROGRAM is None, reason="needs chromium")


@pytest.fixture(scope="module")
def page(tmp_path_factory: pytest.TempPathFactory) -> Any:
    with browser(tmp_path_factory.mktemp("browser")) as opened:
        yield opened


MADE: dict[str, tuple[str, ...]] = {
    "share with a chart": ("share", "crank-rocker", "--chart", "rocker.angle", "--names", "-o", "OUT.html"),
    "share, two closures, a swing": ("share", "double-rocker", "-o", "OUT.html"),
    "share, dark": ("share", "press", "--theme", "dark", "-o", "OUT.html"),
    "report": ("report", "slider-crank", "-o", "OUT"),
    "solution": ("explain", "slider-crank", "--angle", "40 deg", "-o", "OUT.html"),
    "exercise": (
        "explain",
        "slider-crank",
        "--angle",
        "40 deg",
        "--exercise",
        "--versions",
        "2",
        "-o",
        "OUT.html",
    ),
    "quiz": ("quiz", "crank-rocker", "-n", "3", "-o", "OUT.html"),
}


def _violations(page: Page) -> list[str]:
    page.value(AXE.read_text(encoding="utf-8") + ";0")
    found = page.value("axe.run(document, {resultTypes: ['violations']})")
    return [
        f"{one['id']} ({one['impact']}): {one['help']}: {[node['html'][:160] for node in one['nodes'][:3]]}"
        for one in found["violations"]
    ]


@pytest.mark.slow
@pytest.mark.skipif(not AXE.exists(), reason="needs axe-core, which LINKANIM_AXE names")
@pytest.mark.parametrize("kind", MADE)
def test_axe_finds_no_violation(kind: str, page: Page, tmp_path: Path) -> None:
    target = tmp_path / "made"
    assert main([word.replace("OUT", str(target)) for word in MADE[kind]]) == 0
    made = target / "report.html" if target.is_dir() else target.with_suffix(".html")
    page.go(made.as_uri())
    assert _violations(page) == []
    if kind.startswith("share"):
        page.value("document.querySelectorAll('details').forEach(one => { one.open = true; })")
        page.frame()
        assert _violations(page) == []


@pytest.mark.slow
@pytest.mark.skipif(not AXE.exists(), reason="needs axe-core, which LINKANIM_AXE names")
def test_axe_finds_no_violation_on_a_site_s_index(page: Page, tmp_path: Path) -> None:
    from linkanim.share.site import write_site

    write_site(tmp_path / "site", ("crank-rocker", "press"), Shared(load("crank-rocker")))
    page.go((tmp_path / "site" / "index.html").as_uri())
    assert _violations(page) == []


@pytest.mark.slow
def test_every_control_is_reached_by_the_tab_key_and_shows_that_it_is(page: Page, tmp_path: Path) -> None:
    target = tmp_path / "page.html"
    assert main(["share", "crank-rocker", "--chart", "rocker.angle", "--names", "-o", str(target)]) == 0
    page.go(target.as_uri())
    shown = page.value(
        "[...document.querySelectorAll('button, select, input, summary, [tabindex]')]"
        ".filter(one => one.checkVisibility()).length"
    )
    seen = []
    for _ in range(shown):
        page.key("Tab", code="Tab", windowsVirtualKeyCode=9)
        seen.append(
            page.value(
                "(() => { const one = document.activeElement, style = getComputedStyle(one);"
                "return [one.id || one.textContent, style.outlineStyle, parseFloat(style.outlineWidth)]; })()"
            )
        )
    names = [name for name, _, _ in seen]
    assert len(set(names)) == shown
    assert {"play", "input", "closure", "values", "curves", "Lengths"} <= set(names)
    assert all(style != "none" and wide >= 1 for _, style, wide in seen)


@pytest.mark.slow
def test_in_a_slide_s_frame_the_mechanism_has_the_largest_share(page: Page, tmp_path: Path) -> None:
    target = tmp_path / "page.html"
    assert main(["share", "crank-rocker", "--chart", "rocker.angle", "-o", str(target)]) == 0
    page.sized(800, 450)
    page.go(target.as_uri())

    def box(name: str) -> dict[str, float]:
        found: dict[str, float] = page.value(
            f"document.getElementById('{name}').getBoundingClientRect().toJSON()"
        )
        return found

    page.value("document.getElementById('play').click()")  # what moves has another height at each frame
    page.frame()
    assert box("picture")["height"] > 0.65 * 450
    drawn = box("side0")["height"]
    assert drawn > 0.6 * 450
    assert box("chart")["width"] == 0
    # beside the picture is room for the numbers
    assert box("rows")["width"] > 50
    page.value("document.getElementById('values').click()")
    page.frame()
    assert box("side0")["height"] == pytest.approx(drawn, rel=0.01)
    page.value("document.getElementById('curves').click()")
    page.frame()
    assert box("chart")["width"] > 50
    page.value("document.getElementById('curves').click()")
    page.value("document.getElementById('numbers').open = true")
    page.frame()
    assert box("picture")["height"] > 0.65 * 450
    page.sized(1280, 720)
    page.go(target.as_uri())
    assert box("rows")["width"] > 0
    assert box("chart")["width"] > 0
    before = box("picture")["height"]
    page.value("document.getElementById('numbers').open = true")
    page.frame()
    assert box("picture")["height"] > 0.9 * before
