"""Window, SVG and PDF show one description: other programs draw the files as the window is drawn."""

from __future__ import annotations

import io
from collections.abc import Iterable, Iterator
from dataclasses import replace

import numpy as np
import pygame
import pytest
from fidelity import Pixels, psnr

from linkanim.paper.figure import Figured
from linkanim.paper.pdf import pdf
from linkanim.paper.svg import svg
from linkanim.picture.items import Group
from linkanim.picture.look import Look
from linkanim.picture.picture import Picture
from linkanim.picture.raster import offscreen
from linkanim.picture.surface import SurfacePrinter
from linkanim.scenes import load, names

SIZE = (640, 360)
PHASE = 1.0
FULL = Look(vectors=frozenset("va"), chart="input.angular_velocity", names=2, polygons=True)
LOOKS = {
    "plain": Look(),
    "full": FULL,
    "dark": replace(FULL, theme="dark", ghost=True, centres=2),
    "zoomed": replace(FULL, zoom=2.0, pan=(0.1, 0.2)),
    "far": replace(FULL, zoom=0.6, pan=(-0.2, 0.1), background=False),
}
SAMPLE = [("six-bar", "full"), ("slider-crank", "far"), ("hoecken", "dark")]


def _look(name: str, look: str) -> Look:
    """Return a look of a scene; one that a slider drives has no angular velocity."""
    own = LOOKS[look].chart
    chart = own if own in load(name).quantities else "input.velocity"
    return replace(LOOKS[look], chart=chart if LOOKS[look].chart else None)


def _levels(surface: pygame.Surface) -> Pixels:
    """Return a surface's colours on white."""
    below = offscreen(surface.get_size())
    below.fill((255, 255, 255))
    below.blit(surface, (0, 0))
    return pygame.surfarray.array3d(below).astype(float)


def _wordless(groups: Iterable[Group]) -> Iterator[Group]:
    """Yield the shapes alone: every program sets letters a little differently."""
    return (group._replace(captions=()) for group in groups)


def _window(name: str, look: Look, monkeypatch: pytest.MonkeyPatch) -> Pixels:
    """Return the shapes of the picture as the window has it."""
    scene, surface = load(name), offscreen(SIZE, alpha=not look.background)
    picture = Picture(scene, SIZE, look)
    pose, faint = picture.poses(PHASE)
    groups = list(_wordless(picture.groups(pose, faint=faint)))
    monkeypatch.setattr(picture, "groups", lambda *_, **__: groups)
    SurfacePrinter().paint(surface, picture, pose, faint=faint)
    return _levels(surface)


def _compared(name: str, look: Look, monkeypatch: pytest.MonkeyPatch) -> None:
    window = _window(name, look, monkeypatch)
    figured = Figured(load(name), SIZE, look, PHASE, as_seen=True)
    groups = list(_wordless(figured.groups()))
    background = figured.picture.theme.background if look.background else None
    # the reader of SVG that comes with pygame (nanosvg)
    drawn = pygame.image.load(io.BytesIO(svg(SIZE, background, groups, title=name).encode()), "f.svg")
    assert psnr(_levels(drawn), window) >= 30
    pymupdf = pytest.importorskip("pymupdf")
    page = pymupdf.open(stream=pdf(SIZE, background, groups, title=name), filetype="pdf")[0]
    shown = page.get_pixmap(matrix=pymupdf.Matrix(4 / 3, 4 / 3))
    read = np.frombuffer(shown.samples, np.uint8).reshape(shown.height, shown.width, 3).transpose(1, 0, 2)
    assert psnr(read.astype(float), window) >= 30


@pytest.mark.thinned(2)
@pytest.mark.parametrize(("name", "look"), SAMPLE)
@pytest.mark.slow
def test_a_file_is_the_window_s_picture(name: str, look: str, monkeypatch: pytest.MonkeyPatch) -> None:
    _compared(name, _look(name, look), monkeypatch)


@pytest.mark.long
@pytest.mark.parametrize("look", LOOKS)
@pytest.mark.parametrize("name", names())
def test_every_file_is_the_window_s_picture(name: str, look: str, monkeypatch: pytest.MonkeyPatch) -> None:
    _compared(name, _look(name, look), monkeypatch)
