from __future__ import annotations

import tracemalloc

import numpy as np
import pytest
from numpy.typing import NDArray

from linkanim.recorder.gallery import reduced
from linkanim.recorder.palette import Indexing, _oklab, make_palette


def frame(*colours: tuple[int, int, int], alpha: int = 0) -> NDArray[np.uint8]:
    """Pixels in a row: blue, green, red, alpha."""
    return np.array([(blue, green, red, alpha) for red, green, blue in colours], np.uint8)


def as_set(palette: NDArray[np.uint8]) -> set[tuple[int, ...]]:
    return {tuple(colour) for colour in palette.tolist()}


def test_few_colours_are_all_kept() -> None:
    samples = [frame((1, 2, 3), (4, 5, 6)), frame((4, 5, 6), (7, 8, 9))]
    assert as_set(make_palette(samples)) == {(1, 2, 3), (4, 5, 6), (7, 8, 9)}


def test_a_sheet_of_few_colours_keeps_each_in_its_place() -> None:
    picture = np.array([[(200, 30, 4), (5, 60, 250)], [(9, 99, 9), (200, 30, 4)]], np.uint8)
    assert (reduced(picture) == picture).all()


def test_given_colours_come_first_and_once() -> None:
    palette = make_palette([frame((1, 2, 3), (4, 5, 6))], [(4, 5, 6), (9, 9, 9), (4, 5, 6)])
    assert palette.tolist() == [[4, 5, 6], [9, 9, 9], [1, 2, 3]]


@pytest.mark.parametrize(("alpha", "kept"), [(255, True), (128, True), (127, False), (0, False)])
def test_only_opaque_pixels_count_where_alpha_does(alpha: int, kept: bool) -> None:
    palette = make_palette([frame((1, 2, 3), alpha=alpha), frame((9, 9, 9), alpha=255)], alpha=True)
    assert ((1, 2, 3) in as_set(palette)) == kept


def test_a_picture_without_opaque_pixels_has_the_given_colours() -> None:
    assert make_palette([frame((1, 2, 3))], [(7, 7, 7)], alpha=True).tolist() == [[7, 7, 7]]


def ramps() -> NDArray[np.uint8]:
    """Flat colours, two of them hardly different, and thousands of mixtures that come up once each."""
    rng = np.random.default_rng(1)
    flat = [(252, 252, 250)] * 5000 + [(252, 252, 248)] * 40 + [(213, 94, 0)] * 900 + [(0, 114, 178)] * 860
    return frame(*flat, *map(tuple, rng.integers(0, 256, (4000, 3)).tolist()))


def test_flat_colours_are_exact_among_thousands() -> None:
    palette = make_palette([ramps()])
    assert len(palette) == 255
    assert {(252, 252, 250), (252, 252, 248), (213, 94, 0), (0, 114, 178)} <= as_set(palette)


@pytest.mark.slow
def test_the_others_lie_near_a_palette_colour() -> None:
    pixels = ramps()[:, 2::-1].astype(int)
    palette = make_palette([ramps()]).astype(int)
    nearest = np.sqrt(((pixels[:, None] - palette[None]) ** 2).sum(axis=2).min(axis=1))
    assert nearest.max() < 60  # uniform in the cube: 255 cells are 40 wide, their corners 35 away
    assert nearest[6800:].mean() < 25


def test_given_colours_take_their_room_among_thousands() -> None:
    given = [(1, 2, 3), (250, 1, 1)]
    palette = make_palette([ramps()], given)
    assert palette[:2].tolist() == [list(colour) for colour in given]
    assert len(palette) == 255


def test_equal_samples_give_equal_palettes() -> None:
    assert make_palette([ramps()]).tobytes() == make_palette([ramps()]).tobytes()


# Lightness and the two colour axes of red, green and blue, as their author tables them.
OKLAB = {
    (255, 255, 255): (1.0, 0.0, 0.0),
    (255, 0, 0): (0.628, 0.225, 0.126),
    (0, 255, 0): (0.866, -0.234, 0.179),
    (0, 0, 255): (0.452, -0.032, -0.312),
    (10, 10, 10): (0.145, 0.0, 0.0),
}


@pytest.mark.parametrize(("colour", "seen"), OKLAB.items())
def test_colours_are_as_far_apart_as_they_look(
    colour: tuple[int, int, int], seen: tuple[float, float, float]
) -> None:
    assert _oklab(np.array([colour], np.uint8))[0] == pytest.approx(seen, abs=1e-3)


@pytest.mark.slow
def test_indices_of_a_large_frame_take_little_memory_and_are_those_of_its_parts() -> None:
    pixels, random = 3840 * 2160, np.random.default_rng(1)
    frame = np.repeat(random.integers(0, 1 << 24, 3840, dtype=np.uint32), 2160)
    palette = [(12 * n, 255 - 12 * n, 7 * n) for n in range(20)]
    indexing = Indexing(palette, pixels, alpha=False)
    tracemalloc.start()
    found = bytes(indexing(frame.tobytes()))
    most = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert most < 90_000_000  # the frame, its indices, and what is worked out in between
    half = Indexing(palette, pixels // 2, alpha=False)
    for part in (0, 1):
        rows = slice(part * pixels // 2, (part + 1) * pixels // 2)
        assert bytes(half(frame[rows].tobytes()))[: pixels // 2] == found[rows]
