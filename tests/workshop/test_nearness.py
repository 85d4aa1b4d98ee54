"""How near pieces come: not above what dense samples show, however coarse the steps that it starts from."""

from __future__ import annotations

from itertools import combinations

import numpy as np
import pytest

from linkanim.picture.layered import Frame
from linkanim.scenes import load
from linkanim.workshop import sweep
from linkanim.workshop.parts import kit
from linkanim.workshop.request import make
from linkanim.workshop.sweep import GROUND, Cycle, MovingPiece, hulls_apart

GAP = 0.5
DENSE = 14_400


def dense(cycle: Cycle, one: MovingPiece, other: MovingPiece) -> float:
    """Return how near two pieces of one cell come at very many phases."""
    a, b = (cycle.paths(piece.frame, piece.cells[0]) for piece in (one, other))
    return float(hulls_apart(a, b).min()) - one.radius - other.radius


# swings through limits, gears, slots, a quick turn near a change point, many bodies
@pytest.mark.parametrize("name", ["double-rocker", "press", "crank-shaper", "triple-rocker-in-in", "jansen"])
def test_coarse_steps_find_what_dense_samples_do(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    scene = load(name)
    sizes = make(scene).sizes
    fine = Cycle(scene, sizes.scale)
    pieces = kit(fine, sizes).pieces(sizes.hole)
    pairs = [
        (i, j, GAP)
        for i, j in combinations(range(1, len(pieces)), 2)
        if len(pieces[i].cells) == len(pieces[j].cells) == 1
    ]
    monkeypatch.setattr(sweep, "_SAMPLES", 36)
    found = Cycle(scene, sizes.scale).nearness(pieces, pairs)
    monkeypatch.setattr(sweep, "_SAMPLES", DENSE)
    monkeypatch.setattr(sweep, "_MOST_SAMPLES", DENSE)
    finest = Cycle(scene, sizes.scale)
    for (i, j, _), near in zip(pairs, found, strict=True):
        least = dense(finest, pieces[i], pieces[j])
        assert near.apart == (least >= GAP), (i, j, least)
        assert not near.apart or GAP <= near.distance <= least + 1e-9


def test_a_way_that_speeds_do_not_account_for_counts_as_straying() -> None:
    still = np.zeros(2, complex)
    jumped = sweep._Placed((np.array([0, 3 + 4j]), still, still), (still + 1, still, still))
    piece = MovingPiece(GROUND, ((0j, 10 + 0j),), 1.0)
    first, last = np.array([0]), np.array([1])
    assert piece.stray(jumped, first, last, 0.1) == [5.0]
    turned = sweep._Placed((still, still, still), (np.array([1, 1j]), still, still))
    # its far end, 10 from the origin, went a quarter turn
    assert piece.stray(turned, first, last, 0.1) == pytest.approx([10 * 2**0.5])


def test_where_it_is_nearest_is_the_phase_that_is_told() -> None:
    scene = load("crank-rocker")
    cycle = Cycle(scene, 1.0)
    moving = MovingPiece(Frame("A"), ((0j,),), 1.0)
    still = MovingPiece(GROUND, ((53.0 + 0j,),), 1.0)
    (near,) = cycle.nearness([moving, still], [(0, 1, 2.0)])
    # the crank, 50 long, comes to 53 along x at its start
    assert not near.apart
    assert near.distance == pytest.approx(1.0)
    assert near.phase == 0.0


def test_what_passes_just_as_near_as_asked_passes() -> None:
    cycle = Cycle(load("crank-rocker"), 1.0)
    moving = MovingPiece(Frame("A"), ((0j,),), 1.0)
    ring = [60.0 * np.exp(2j * np.pi * n / 7) for n in range(7)]
    pieces = [moving, *(MovingPiece(GROUND, ((complex(place),),), 1.0) for place in ring)]
    for asked, apart in ((7.99, True), (8.01, False)):
        found = cycle.nearness(pieces, [(0, n, asked) for n in range(1, 8)])
        assert [near.apart for near in found] == [apart] * 7
