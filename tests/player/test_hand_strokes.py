"""Ten shapes drawn with the mouse, kept as tapes: what is shown of each is what one would choose."""

from __future__ import annotations

from pathlib import Path

import pytest

from linkanim.player.state import PathSketch
from linkanim.player.tape_file import read
from linkanim.synthesis.answers import PathAnswer

STROKES = sorted((Path(__file__).parent / "tapes" / "strokes").glob("*.tape.json"))


def drawn(path: Path) -> tuple[PathSketch, list[PathAnswer], PathAnswer]:
    """Return what the pencil has at the end of a tape, all answers to the stroke, and that which is shown."""
    *_, last = read(path).states()
    sketch = last.drawing
    assert sketch
    answers = [one for one in (*sketch.answers, *sketch.way) if isinstance(one, PathAnswer)]
    assert isinstance(sketch.answer, PathAnswer)
    return sketch, answers, sketch.answer


def test_there_are_ten() -> None:
    assert len(STROKES) == 10


@pytest.mark.thinned(3)
@pytest.mark.parametrize("path", STROKES, ids=lambda path: path.name.partition(".")[0])
def test_what_is_shown_of_a_stroke_is_compact_and_no_card_beats_it(path: Path) -> None:
    sketch, answers, shown = drawn(path)
    best = min(one.off for one in answers)
    assert shown.size <= 2.5 or not any(one.size <= 2.5 and one.off <= 1.5 * best for one in answers)
    assert len(sketch.answers) > 2
    assert len(sketch.way) > 2
    beaten = [
        one
        for one in answers
        if one.off < 0.99 * shown.off and one.size < 0.99 * shown.size and one.angle > shown.angle + 0.01
    ]
    assert not beaten
    halves = [one for one in answers if one.size <= shown.size / 2]
    assert all(max(one.off, 0.3) > 1.49 * shown.off for one in halves)


@pytest.mark.thinned(3)
@pytest.mark.parametrize("path", STROKES, ids=lambda path: path.name.partition(".")[0])
def test_cards_differ_in_their_figures(path: Path) -> None:
    sketch, _, _ = drawn(path)
    figures = [(round(one.off, 2), round(one.size, 2), round(one.angle, 2)) for one in sketch.answers]  # type: ignore[union-attr]
    assert len({*figures}) == len(figures)
