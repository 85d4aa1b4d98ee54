"""The chart of a tolerance and that of a balance: each curve has its name, and no words lie on others."""

from __future__ import annotations

from collections.abc import Callable
from itertools import combinations

import pytest

from linkanim.paper.balance import BalanceChart
from linkanim.paper.illustration import DrawnPage
from linkanim.paper.tolerances import ToleranceChart
from linkanim.picture.items import Caption
from linkanim.picture.view import Rect
from linkanim.scenes import load
from linkanim.scenes.deviation import tolerance
from linkanim.scenes.reading import scene_from

HEAVY = {
    "four-bar": {"ground": 100, "crank": 30, "coupler": 90, "rocker": 80},
    "bodies": {"coupler": {"joints": ["A", "B"], "com": [45, 10], "mass": "1 kg"}},
}
PAGES: dict[str, Callable[[], DrawnPage]] = {
    "lengths that matter alike": lambda: ToleranceChart(tolerance(load("press"), 0.1)),
    "few lengths": lambda: ToleranceChart(tolerance(load("crank-rocker"), 0.1)),
    "a balance": lambda: BalanceChart(scene_from(HEAVY, name="heavy", where="heavy.toml")),
}


@pytest.mark.parametrize("name", PAGES)
def test_no_words_lie_on_others_and_each_curve_is_named(name: str) -> None:
    page = PAGES[name]()
    captions = [item for item in page.items() if isinstance(item, Caption) and item.text]
    shares, boxes = {"left": 0.0, "centre": 0.5, "right": 1.0}, []
    for one in captions:
        wide = page.pen.type.width(one.text, one.size, strong=one.strong)
        boxes.append(Rect(one.at[0] - shares[one.anchor] * wide, one.at[1], wide, one.size))
    assert not [(one, other) for one, other in combinations(boxes, 2) if one.meets(other)]
    assert all(box.x >= 0 and box.right <= page.size[0] for box in boxes)
    names = {one.text for one in captions}
    assert names >= {"without counterweights", "with them"} or "all lengths" in names
