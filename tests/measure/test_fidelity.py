"""How true a picture is: the measures themselves, on pictures of which the answer is known."""

from __future__ import annotations

import math

import fidelity
import numpy as np
import pytest
from cost import _decibels
from fidelity import Pixels

from linkanim.mechanics.motion import Pose
from linkanim.picture.look import Look
from linkanim.picture.view import View
from linkanim.scenes import load
from linkanim.scenes.scene import Scene


# Every level off by so much: 20 log10(255 / off).
@pytest.mark.parametrize(("off", "decibels"), [(0, math.inf), (1, 48.1308), (255, 0.0), (51, 13.9794)])
def test_decibels_are_those_of_the_mean_squared_error(off: int, decibels: float) -> None:
    grey = np.full((2, 3, 3), 100.0)
    assert fidelity.psnr(grey, grey + off) == pytest.approx(decibels, abs=1e-4)
    shown = np.full((2, 3, 3), off, np.uint8)
    assert _decibels(iter([shown]), np.zeros((1, 24), np.uint8)) == pytest.approx(decibels, abs=1e-4)


def test_the_worst_frame_counts_without_words_and_against_64_samples_a_pixel(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    made: list[tuple[int, int]] = []

    class Painter:
        def __init__(self, scene: Scene, size: tuple[int, int], look: Look, view: View | None = None) -> None:
            assert (scene.name, look.hud, look.vectors) == ("press", False, frozenset("va"))
            assert view == (View(16.0, 24.0, 32.0) if made else None)
            made.append(size)
            self.size, self.view = size, View(2.0, 3.0, 4.0)

    def painted(painter: Painter, pose: Pose) -> Pixels:
        width, height = painter.size
        off = {0.0: 1.0, 1.0: 51.0, 2.5: 2.0}[pose.phase] if painter.size == made[1] else 0.0
        return np.full((height, width, 3), off)

    monkeypatch.setattr(fidelity, "SIZE", (32, 18))
    monkeypatch.setattr(fidelity, "Picture", Painter)
    monkeypatch.setattr(fidelity, "_painted", painted)
    found = fidelity.frame_decibels(load("press"), (0.0, 1.0, 2.5))
    assert found == pytest.approx(13.9794, abs=1e-4)
    (width, height), (wider, higher) = made
    assert (width, height, wider * higher / (width * height)) == (32, 18, 64)


def test_a_pixel_has_three_levels_and_a_byte_that_does_not_count() -> None:
    levels = fidelity._levels(bytes(range(24)), (3, 2))
    assert levels.shape == (2, 3, 3)
    assert levels[1].tolist() == [[12, 13, 14], [16, 17, 18], [20, 21, 22]]


@pytest.mark.parametrize("shown", [0, 1, 3])
def test_a_file_that_shows_fewer_or_more_frames_has_no_decibels(shown: int) -> None:
    pictures = [np.zeros((2, 3, 3), np.uint8)] * shown
    with pytest.raises(ValueError, match="argument"):
        _decibels(iter(pictures), np.zeros((2, 24), np.uint8))


def test_the_mean_is_that_of_each_square() -> None:
    picture = np.arange(16.0).reshape(4, 4, 1)
    assert fidelity.averaged(picture, 2)[..., 0].tolist() == [[2.5, 4.5], [10.5, 12.5]]


def test_the_centre_of_a_pixel_is_half_a_pixel_in() -> None:
    cover = np.zeros((4, 8))
    cover[1, 5] = 0.5
    assert fidelity.centre(cover) == 5.5 + 1.5j
    cover[1, 6] = 1.5
    assert fidelity.centre(cover) == 6.25 + 1.5j


def test_a_bar_that_is_drawn_beside_its_place_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    drawn = fidelity._white
    monkeypatch.setattr(fidelity, "_white", lambda bar: drawn(bar + 0.3 + 0.4j))
    assert fidelity.jitter(steps=4) == pytest.approx(0.5, abs=0.01)
