"""What the tests of the page ask of any browser: where its joints lie, what stands in it, its handle."""

from __future__ import annotations

from pathlib import Path
from typing import Any, Protocol

from linkanim.scenes.scene import Scene
from linkanim.share.page import Shared, document


class Opened(Protocol):
    """A page that a browser shows."""

    def value(self, script: str) -> Any:
        """Return the value of an expression in the page."""

    def frame(self) -> None:
        """Wait until what was done shows."""


FINEST = 0.01
"""Of a pixel on a screen of 3840 × 2160."""
WIDE = 3840
SAMPLE = ("press", "double-rocker", "excavator", "driven-piston", "kite")
PHASES = (0.0, 0.7, 2.0, 3.1, 4.4, 6.0)


def put(folder: Path, shared: Shared) -> str:
    """Write a page into a folder with blanks in its name, and return its address."""
    room = folder / "a folder with blanks"
    room.mkdir(exist_ok=True)
    target = room / f"{shared.scene.name} 1.html"
    target.write_text(document(shared), encoding="utf-8")
    return target.as_uri()


def shown(page: Opened, name: str) -> str:
    return str(page.value(f"document.getElementById({name!r}).textContent"))


def pressed(page: Opened, name: str) -> str:
    return str(page.value(f"document.getElementById({name!r}).getAttribute('aria-pressed')"))


def phase(page: Opened) -> float:
    return float(page.value("Number(document.getElementById('input').value)"))


def go_to(page: Opened, phase: float) -> None:
    page.value(
        "(() => { const input = document.getElementById('input'); "
        f"input.value = {phase!r}; input.dispatchEvent(new Event('input')); }})()"
    )
    page.frame()


JOINTS = """(() => {
  const data = JSON.parse(document.getElementById("data").textContent);
  const number = data.sides.findIndex((_, n) => !document.getElementById(`side${n}`).hasAttribute("hidden"));
  const side = data.sides[number], found = {};
  const groups = document.getElementById(`side${number}`).querySelectorAll("[data-m]");
  side.movers.forEach((mover, n) => {
    if (mover.kind !== "part") return;
    const { e, f } = groups[n].transform.baseVal.consolidate().matrix;
    found[mover.at] = [e, f];
  });
  return { found, view: side.view, picture: document.getElementById("picture").viewBox.baseVal.width };
})()
"""


def farthest(page: Opened, scene: Scene, phase: float) -> float:
    """Return how far the farthest joint in the page is off, in pixels of the largest screen."""
    go_to(page, phase)
    known = page.value(JOINTS)
    scale, x, y = known["view"]
    places, off = scene.pose(phase, 0).position, 0.0
    for name, (px, py) in known["found"].items():
        if name in places:
            there = complex(x + scale * places[name][0], y - scale * places[name][1])
            off = max(off, abs(complex(px, py) - there))
    assert known["found"]
    return off * WIDE / float(known["picture"])


def centre_of(page: Opened) -> list[float]:
    """Return where the crank's pivot lies on the screen."""
    return list(
        page.value(
            "(() => { const data = JSON.parse(document.getElementById('data').textContent).sides[0];"
            "const svg = document.getElementById('picture').getScreenCTM();"
            "const at = new DOMPoint(data.view[1], data.view[2]).matrixTransform(svg);"
            "return [at.x, at.y]; })()"
        )
    )


def handle_of(page: Opened) -> list[float]:
    """Return where the crank's pin lies on the screen."""
    return list(
        page.value(
            "(() => { const box = document.getElementById('handle').getBoundingClientRect();"
            "return [box.x + box.width / 2, box.y + box.height / 2]; })()"
        )
    )
