"""Rows of words on the sheet: where each stands, and which one is under the pointer."""

from __future__ import annotations

import pytest

from linkanim.picture.look import Look
from linkanim.picture.picture import Picture
from linkanim.picture.sheet_rows import SheetRows
from linkanim.scenes import load

BAR = SheetRows(
    "bar A–B", (("length", "100 mm"), ("mass", "12 kg"), ("inertia", "0.02 kg m²"), ("look", "plate")), 1
)
OFFERS = SheetRows("Tab, or a click: it may be", (("a pin on the bar", ""), ("a joint of both", "")), 0)


# at the upper right, at a place, and where it would reach beyond the stage's right and lower edge
@pytest.mark.parametrize("at", [None, (0.0, 0.0), (1e6, -1e6), (-1e6, 1e6)])
@pytest.mark.parametrize("size", [(1280, 720), (320, 180)])
@pytest.mark.parametrize("shown", [BAR, OFFERS], ids=["numbers", "meanings"])
def test_each_row_holds_its_words_and_is_found_there(
    shown: SheetRows, size: tuple[int, int], at: tuple[float, float] | None
) -> None:
    shown = shown._replace(at=at)
    setting = Picture(load("crank-rocker"), size, Look()).drawing.setting
    layout = setting.layout
    group = shown.group("numbers", setting)

    def row_at(x: float, y: float) -> int | None:
        return next((one.value[0] for one in group.targets if one.place.holds(x, y)), None)

    title, *words = group.captions
    told = [text for row in shown.rows for text in row if text]
    assert [title.text, *(one.text for one in words)] == [shown.title, *told]
    ends = dict[int, float]()
    for caption in group.captions:
        place = caption.around(setting.type)
        found = {row_at(x, place.middle.imag) for x in (place.x, place.right)}
        row = next((n for n, one in enumerate(shown.rows) if caption.text in one), -1)
        assert found == {row}, caption.text
        assert layout.stage.holds(place.x, place.y)
        assert layout.stage.holds(place.right, place.bottom)
        assert place.x > ends.get(row, 0.0)
        ends[row] = place.right
    beside = max(loop.real.max() for layer in group.layers for loop in layer.loops) + 1.0
    assert row_at(beside, place.middle.imag) is None
