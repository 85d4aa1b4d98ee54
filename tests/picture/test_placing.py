"""Of a label's places the one is taken that has the fewest faults at all moments, and of these the best."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from linkanim.picture.placing import Alternatives, Obstacles, chosen, crossed, grounded
from linkanim.picture.view import Rect

ROOM = Rect(0, 0, 400, 400)
HERE, THERE = 100 + 100j, 100 + 300j
SIZE = (20.0, 10.0)


def label(*places: complex, moments: int = 1, **more: Any) -> Alternatives:
    """Return a label that likes its first place best."""
    everywhere = np.tile(np.array(places, complex), (moments, 1))
    return Alternatives(SIZE, everywhere, np.linspace(0.0, 0.05, len(places)), **more)


# the room ends at 0 and 400
@pytest.mark.parametrize("moments", [1, 12])
@pytest.mark.parametrize(("edge", "out"), [(10 + 90j, -1), (390 + 90j, 1), (90 + 5j, -1j), (90 + 395j, 1j)])
def test_a_label_stands_at_an_edge_but_not_over_it(edge: complex, out: complex, moments: int) -> None:
    for asked, which in ((edge - 0.1 * out, 0), (edge + 0.1 * out, 1)):
        assert chosen([label(asked, 200 + 200j, moments=moments)], Obstacles(ROOM)) == [which]


def _ground(**more: Any) -> Obstacles:
    return Obstacles(ROOM, **more)


LINE = np.array([[[0 + 100j, 200 + 100j]]])
IN_THE_WAY = {
    "a word": (_ground(rects=np.array([[HERE + 5]]), sizes=np.array([(40.0, 15.0)])), 1),
    "a word beside it": (_ground(rects=np.array([[HERE + 31]]), sizes=np.array([(40.0, 15.0)])), 0),
    "a pin": (_ground(discs=np.array([[HERE + 15]]), radii=np.array([6.0])), 1),
    "a pin beside it": (_ground(discs=np.array([[HERE + 17]]), radii=np.array([6.0])), 0),
    "a line": (_ground(lines=LINE, halves=np.array([1.0])), 1),
    "a line that ends before it": (_ground(lines=LINE - 120, halves=np.array([1.0])), 0),
    "a bar, rather not": (_ground(bars=LINE, thick=np.array([8.0])), 1),
    "words and lines of one moment": (grounded(ROOM, [Rect(90, 95, 5, 5)], [(0j, 9j)]), 1),
}


@pytest.mark.parametrize("case", IN_THE_WAY)
def test_a_label_keeps_off_what_is_in_its_way(case: str) -> None:
    ground, which = IN_THE_WAY[case]
    assert chosen([label(HERE, THERE)], ground) == [which]


def test_a_bar_may_be_covered_and_a_pin_may_not() -> None:
    bar = _ground(bars=LINE, thick=np.array([8.0]))
    pin = _ground(discs=np.array([[HERE]]), radii=np.array([6.0]))
    assert chosen([label(HERE)], bar) == [0]
    assert chosen([label(HERE)], pin) == [None]
    # what has to stand somewhere takes the place with the fewest faults
    assert chosen([label(HERE, most=1.0)], pin) == [0]


def test_a_place_is_as_good_as_it_is_over_all_moments() -> None:
    """A disc is at the better place in a tenth of the moments."""
    way = np.full((40, 1), 350 + 350j)
    way[8:12] = HERE
    ground = _ground(discs=way, radii=np.array([5.0]))
    both, only = label(HERE, THERE, moments=40), label(HERE, moments=40)
    assert chosen([both, only], ground) == [1, None]
    assert chosen([only._replace(most=0.1)], ground) == [0]
    assert chosen([only._replace(most=0.09)], ground) == [None]
    excused = np.zeros(40, bool)
    excused[8:12] = True
    assert chosen([only._replace(excused=excused)], ground) == [0]
    # an excused moment is no reason to stand there all the same
    assert chosen([both._replace(excused=excused)], ground) == [1]


def test_lines_drawn_with_a_label_are_in_the_way_of_others_and_keep_a_gap() -> None:
    """Each of two labels has a line from its place to the left edge."""
    led = label(HERE, THERE, lines=np.array([[[[95 + 100j, 0 + 100j]], [[95 + 300j, 0 + 300j]]]]))
    plain = label(50 + 100j, 50 + 200j)
    assert chosen([led._replace(rank=0), plain], Obstacles(ROOM)) == [0, 1]
    assert chosen([led, plain._replace(rank=0)], Obstacles(ROOM)) == [1, 0]
    near = label(50 + 120j, lines=np.array([[[[0 + 104j, 80 + 104j]]]]))
    for gap, which in ((3.0, 0), (5.0, None)):
        assert chosen([led._replace(rank=0), near._replace(gap=gap)], Obstacles(ROOM)) == [0, which]


@pytest.mark.parametrize("turn", [1, np.exp(2.2j), np.exp(-0.7j)])
def test_boxes_meet_the_thick_lines_that_reach_into_them(turn: complex) -> None:
    """As points all over each tell; a line's ends count as square, so that no touch is missed."""
    line, half = 30 * turn * np.array([-1, 1]), 4.0
    boxes = np.add.outer(np.linspace(-60, 60, 25), 1j * np.linspace(-60, 60, 25)).ravel()
    found = crossed(boxes[None], SIZE, line[None, None], np.array([half]))[0, :, 0]
    inner = np.add.outer(np.linspace(-10, 10, 21), 1j * np.linspace(-5, 5, 11)).ravel()
    for box, met in zip(boxes, found, strict=True):
        share = np.clip(((box + inner) / (30 * turn)).real, -1, 1)
        near = np.abs(box + inner - share * 30 * turn).min()
        assert met or near > half - 1.0
        assert not met or near < half * np.sqrt(2) + 1.0
