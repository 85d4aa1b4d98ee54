"""Coverage is exact, so edges glide and shapes keep their place to a small part of a pixel."""

from __future__ import annotations

import math
import tracemalloc

import numpy as np
import pygame
import pytest
from fidelity import Pixels, averaged, centre, jitter, psnr
from pictures import alphas, coverage, filled

from linkanim.picture import raster
from linkanim.picture.raster import Layer, Loop, Shapes, covers, in_turn, offscreen, paint, paints
from linkanim.picture.shapes import box, cut, disc, rounded

WHITE = (255, 255, 255)


def _rect(left: float, top: float, right: float, low: float) -> Loop:
    return np.array([complex(left, top), complex(right, top), complex(right, low), complex(left, low)])


@pytest.mark.parametrize(
    ("rect", "pixel", "share"),
    [
        # whole pixels are full or empty, whichever side the edge belongs to
        ((10, 10, 20, 20), (10, 10), 1.0),
        ((10, 10, 20, 20), (9, 10), 0.0),
        ((10, 10, 20, 20), (20, 19), 0.0),
        # an edge inside a pixel covers its part, a corner the product of both
        ((10.25, 10, 20, 20), (10, 15), 0.75),
        ((10, 10.5, 20, 20), (15, 10), 0.5),
        ((10.25, 10.5, 20, 20), (10, 10), 0.375),
        # thinner than a pixel, and in the middle of one
        ((10.4, 10, 10.6, 20), (10, 15), 0.2),
        ((10.4, 10.4, 10.6, 10.6), (10, 10), 0.04),
        # what lies outside the surface leaves what is inside as it is
        ((-30, -30, 100, 100), (0, 0), 1.0),
        ((-30, -30, 5.5, 5.5), (5, 5), 0.25),
        ((60.5, 60.5, 1e6, 1e6), (60, 60), 0.25),
        ((60.5, 60.5, 1e6, 1e6), (63, 63), 1.0),
    ],
)
def test_a_rectangle_covers_its_share_of_each_pixel(
    rect: tuple[float, float, float, float], pixel: tuple[int, int], share: float
) -> None:
    cover = coverage(filled([Layer(WHITE, [_rect(*rect)])]))
    assert cover[pixel[1], pixel[0]] == pytest.approx(share, abs=1 / 255)


# in steps its right end is where floats of 32 bits have no neighbour one step on
def test_the_widest_picture_ends_as_any_other() -> None:
    sloping = [_rect(16_000, 1, 20_000, 3), np.array([16_370 + 4j, 16_384 + 4j, 16_500 + 8j, 16_380 + 9j])]
    wide = coverage(filled([Layer(WHITE, sloping)], (16_384, 10)))
    narrow = coverage(filled([Layer(WHITE, [loop - 16_000 for loop in sloping])], (384, 10)))
    assert (wide[:, :16_000] == 0).all()
    assert (wide[:, 16_000:] == narrow).all()


@pytest.mark.parametrize("turn_deg", [0.0, 17.0, 45.0, 90.0, 133.0])
def test_area_and_centre_of_a_shape_are_kept_at_any_angle(turn_deg: float) -> None:
    place = complex(31.3, 33.7)
    cover = coverage(filled([Layer(WHITE, [place + np.exp(1j * math.radians(turn_deg)) * box(30, 7)])]))
    assert cover.sum() == pytest.approx(210, rel=2e-3)
    assert centre(cover) == pytest.approx(place, abs=0.005)


def test_a_slow_bar_stays_within_a_tenth_of_a_pixel_of_the_truth() -> None:
    assert jitter() < 0.01


def test_an_edge_keeps_to_its_line_within_a_hundredth_of_a_pixel() -> None:
    """The area above a slanted edge, column by column, is the line itself."""
    cover = coverage(filled([Layer(WHITE, [np.array([0, 64, 64 + 40j, 10j])])]))
    columns = np.arange(64) + 0.5
    assert cover.sum(axis=0) == pytest.approx(10 + 30 * columns / 64, abs=0.02)


@pytest.mark.parametrize(
    ("loops", "area"),
    [
        # loops that turn the same way join: the overlap counts once
        ([box(20, 20) + 20 + 20j, box(20, 20) + 30 + 30j], 700.0),
        ([box(20, 20) + 20 + 20j] * 3, 400.0),
        # the other way round cuts a hole, and away from everything it is a shape
        ([box(20, 20) + 20 + 20j, box(10, 10)[::-1] + 20 + 20j], 300.0),
        ([box(20, 20)[::-1] + 20 + 20j], 400.0),
        # loops without area cover nothing
        ([np.array([5 + 5j, 20 + 20j])], 0.0),
        ([np.array([5 + 5j] * 4)], 0.0),
    ],
)
def test_loops_of_a_layer_join_or_cut(loops: list[Loop], area: float) -> None:
    assert coverage(filled([Layer(WHITE, loops)])).sum() == pytest.approx(area, abs=0.5)


def _sampled(loop: Loop, size: tuple[int, int], samples: int = 8) -> Pixels:
    """Return the share of samples² points of each pixel that lie in a convex loop."""
    x, y = ((np.arange(side * samples) + 0.5) / samples for side in size)
    points = x[None, :] + 1j * y[:, None]
    inside = np.ones(points.shape, bool)
    for begin, end in zip(loop, np.roll(loop, -1), strict=True):
        inside &= ((end - begin).conjugate() * (points - begin)).imag >= 0
    return averaged(inside[..., None].astype(float), samples)[..., 0]


@pytest.mark.parametrize(
    "loop",
    [
        20 + 20j + np.exp(0.4j) * rounded([0j, complex(40, 0)], 6),
        40.3 + 30.7j + disc(13.3),
        40 + 30j + np.exp(1.1j) * box(30, 9, 2),
        5 + 5j + rounded([0j, 60 + 10j, 20 + 40j], 5),
    ],
)
def test_shapes_agree_with_sixty_four_samples_a_pixel(loop: Loop) -> None:
    ours = coverage(filled([Layer(WHITE, [loop])], (80, 60)))
    assert psnr(255 * ours, 255 * _sampled(loop, (80, 60))) >= 44


def test_what_reaches_right_of_a_limit_or_below_it_is_cut_off() -> None:
    square = box(10, 6)
    assert cut(square, 9) is square
    right, below = cut(square, 2), cut(square, 1, down=True)
    assert [right.real.min(), right.real.max(), np.ptp(right.imag)] == [-5, 2, 6]
    assert [below.imag.min(), below.imag.max(), np.ptp(below.real)] == [-3, 1, 10]


def test_layers_lie_over_those_before_them() -> None:
    square = box(20, 20) + 32 + 32j
    surface = filled([Layer(WHITE, [square]), Layer((10, 20, 30), [square])])
    assert surface.get_at((32, 32))[:3] == (10, 20, 30)


def _scattered(seed: int, count: int) -> list[Layer]:
    """Return bars and rings, some of them faint, some side by side and some over others."""
    random = np.random.default_rng(seed)
    layers = []
    for _ in range(count):
        place, turn = complex(*random.uniform(-5, 70, 2)), np.exp(1j * random.uniform(0, 6))
        bar = turn * rounded([0j, complex(random.uniform(1, 40), 0)], 3)
        loops = [place + bar] if random.integers(2) else [place + disc(6), place + disc(4)[::-1]]
        red, green, blue = random.integers(0, 256, 3).tolist()
        layers.append(Layer((red, green, blue), loops, random.choice([1.0, 0.6])))
    return layers


@pytest.mark.parametrize("alpha", [False, True])
@pytest.mark.parametrize("seed", range(4))
def test_layers_painted_together_are_those_painted_one_after_the_other(seed: int, alpha: bool) -> None:
    layers, one_by_one = _scattered(seed, 30), filled([], background=90, alpha=alpha)
    for layer in layers:
        paint(one_by_one, [layer])
    together = filled(layers, background=90, alpha=alpha)
    assert together.get_buffer().raw == one_by_one.get_buffer().raw


@pytest.mark.parametrize("alpha", [False, True])
def test_a_cover_does_again_what_its_layers_did_to_the_byte(alpha: bool) -> None:
    layers = _scattered(7, 10)
    (found,) = covers(filled([], background=20, alpha=alpha), [Shapes(layers)])
    assert found.nbytes > 0
    for background in (90, 200):
        painted = filled(layers, background=background, alpha=alpha)
        covered = filled([], background=background, alpha=alpha)
        found.put(covered)
        assert covered.get_buffer().raw == painted.get_buffer().raw


def test_a_faint_layer_mixes_in_its_inside_as_on_its_edge() -> None:
    surface = filled([Layer(WHITE, [_rect(10, 10, 30.5, 30)], 0.5)])
    assert surface.get_at((20, 20))[0] == 128
    assert surface.get_at((30, 20))[0] == 64


@pytest.mark.parametrize("alpha", [False, True])
def test_nothing_to_fill_changes_nothing(alpha: bool) -> None:
    surface = filled([], alpha=alpha)
    before = bytes(surface.get_buffer().raw)
    paint(surface, [Layer(WHITE, [])])
    paint(surface, [Layer(WHITE, [_rect(-50, -50, -10, -10), _rect(100, 3, 120, 20), _rect(3, 100, 9, 200)])])
    assert bytes(surface.get_buffer().raw) == before


def test_on_nothing_the_colour_stays_straight_and_the_edge_is_in_the_opacity() -> None:
    surface = filled([Layer((200, 100, 50), [_rect(10.25, 10, 30, 30)])], alpha=True)
    assert tuple(surface.get_at((10, 20))) == (200, 100, 50, 191)
    assert tuple(surface.get_at((20, 20))) == (200, 100, 50, 255)
    assert alphas(surface)[0, 0] == 0


def test_over_a_half_transparent_pixel_opacity_adds_up() -> None:
    surface = filled([Layer((200, 0, 0), [_rect(0, 0, 64, 64)], 0.5)], alpha=True)
    paint(surface, [Layer((0, 0, 200), [_rect(0, 0, 64, 64)], 0.5)])
    assert tuple(surface.get_at((5, 5))) == pytest.approx((67, 0, 133, 191), abs=1)


def test_a_surface_with_gaps_between_its_rows_is_not_painted_directly() -> None:
    whole = offscreen((64, 64))
    assert paints(whole)
    assert paints(whole.subsurface((0, 10, 64, 20)))
    assert not paints(whole.subsurface((10, 10, 20, 20)))
    assert not paints(pygame.Surface((64, 64), 0, 24))


def test_rows_from_the_end_on_are_left_as_they_are() -> None:
    cover = coverage(filled([Layer(WHITE, [box(20, 20) + 32 + 32j])], ends=(64, 30)))
    assert cover[29, 32] == 1
    assert cover[30:].sum() == 0


@pytest.mark.parametrize("ends", [(-3, 40), (40, -3), (-1, -1), (0, 0)])
def test_of_layers_that_end_before_the_surface_begins_nothing_is_drawn(ends: tuple[int, int]) -> None:
    # in a window two pixels wide what stands beside the scene leaves it less than no room
    layers = [Layer(WHITE, [box(20, 20) + 32 + 32j]), Layer(WHITE, [box(70, 3) + 1j])]
    surface = filled([])
    covers(surface, [Shapes(layers, ends, [Layer(WHITE, [_rect(0, 28, 5, 34)])])])[0].put(surface)
    assert coverage(surface).sum() == 5 * 6


def test_what_lies_over_the_layers_may_reach_beyond_their_ends() -> None:
    surface = filled([])
    limited, free = [Layer(WHITE, [box(20, 20) + 32 + 32j])], [Layer(WHITE, [_rect(0, 28, 5, 34)])]
    covers(surface, [Shapes(limited, (64, 30), free)])[0].put(surface)
    cover = coverage(surface)
    assert (cover[29, 32], cover[30, 32], cover[33, 3]) == (1, 0, 1)


def test_parts_worked_out_together_are_filled_one_after_the_other() -> None:
    parts = [
        [Layer((200, 0, 0), [_rect(5, 5, 40, 40)])],
        [],
        [Layer((0, 0, 200), [_rect(20.5, 3, 50, 30)], 0.5)],
    ]
    together, in_turn = filled([]), filled([])
    for found, part in zip(covers(together, [Shapes(part) for part in parts]), parts, strict=True):
        for surface, one in ((together, found), (in_turn, covers(in_turn, [Shapes(part)])[0])):
            one.put(surface)
            paint(surface, [Layer((0, 200, 0), [_rect(0, 25, 64, 28.25)])])
    assert pygame.image.tobytes(together, "RGBA") == pygame.image.tobytes(in_turn, "RGBA")


@pytest.mark.parametrize("alpha", [False, True])
@pytest.mark.parametrize("most", [1, 3, 1000])
def test_parts_worked_out_a_few_layers_at_a_time_are_the_same_bytes(
    most: int, alpha: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    parts = [
        Shapes(_scattered(1, 20), (50, 40), _scattered(2, 4)),
        Shapes([]),
        Shapes(_scattered(3, 5)),
    ]
    whole = filled([], background=90, alpha=alpha)
    for cover in covers(whole, parts):
        cover.put(whole)
    pieces = filled([], background=90, alpha=alpha)
    monkeypatch.setattr(raster, "_MOST_AT_ONCE", most * 64 * 64)
    monkeypatch.setattr(raster, "_MOST_PAIRS", 10 * most)
    for covers_ in in_turn(pieces, parts):
        for cover in covers_:
            cover.put(pieces)
    assert pieces.get_buffer().raw == whole.get_buffer().raw


@pytest.mark.slow
def test_many_layers_take_no_more_memory_than_some(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(raster, "_MOST_AT_ONCE", 10 * 64 * 64)
    peaks = []
    for count in (10, 200):
        surface, layers = filled([]), [Layer(WHITE, [_rect(0, 0, 64, 64.5)])] * count
        tracemalloc.start()
        for some in in_turn(surface, [Shapes(layers)]):
            for cover in some:
                cover.put(surface)
        peaks.append(tracemalloc.get_traced_memory()[1])
        tracemalloc.stop()
    assert peaks[1] < 2 * peaks[0]


@pytest.mark.slow
def test_many_small_layers_take_no_memory_for_each_pair_of_them(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(raster, "_MOST_PAIRS", 1 << 18)
    layers = [Layer(WHITE, [_rect(n % 60, n % 59, n % 60 + 2.5, n % 59 + 2.5)]) for n in range(3000)]
    tracemalloc.start()
    paint(filled([]), layers)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak < len(layers) ** 2


@pytest.mark.parametrize("right", [0, 1, 20, 33, 64])
def test_columns_from_the_right_end_on_are_left_as_they_are(right: int) -> None:
    loop = 32 + 30j + 25 * np.exp(2j * np.pi * np.arange(90) / 90)
    whole, cut = (coverage(filled([Layer(WHITE, [loop])], ends=(end, 64))) for end in (64, right))
    assert np.array_equal(cut[:, : max(right - 1, 0)], whole[:, : max(right - 1, 0)])
    assert not cut[:, right:].any()
