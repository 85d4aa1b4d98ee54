"""Frames changes_of by what changes, and put together again."""

from __future__ import annotations

import io

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from linkanim.recorder.changes import Change, Comparing, changes

WIDEST = 12
pixels = st.integers(0, 3).map(lambda n: (0, 1, 0xFF000000, 0xFFFFFFFF)[n])


def changes_of(data: bytes, count: int) -> list[Change]:
    return list(changes(io.BytesIO(data), count))


@settings(max_examples=60)
@given(st.lists(st.lists(pixels, min_size=WIDEST, max_size=WIDEST), max_size=6))
def test_changes_make_the_frames_again_and_name_each_changed_pixel_once(rows: list[list[int]]) -> None:
    frames = [np.array(row, np.uint32) for row in rows]
    compare, shown = Comparing(), np.zeros(WIDEST, np.uint32)
    found = changes_of(b"".join(compare(frame.tobytes()) for frame in frames), WIDEST)
    for number, ((place, words), frame) in enumerate(zip(found, frames, strict=True)):
        changed = frame != shown if number else np.ones(WIDEST, bool)
        assert place.tolist() == np.flatnonzero(changed).tolist()
        shown[place] = words
        assert shown.tolist() == frame.tolist()


def test_a_frame_may_be_drawn_over_once_it_is_told() -> None:
    compare, frame = Comparing(), bytearray(12)
    before = compare(frame)
    frame[4] = 7
    assert [change.place.tolist() for change in changes_of(before + compare(frame), 3)] == [[0, 1, 2], [1]]


def test_the_plain_ground_of_a_first_frame_costs_nothing() -> None:
    assert len(Comparing()(np.full(1000, 7, np.uint32).tobytes())) == 8


@pytest.mark.parametrize("kept", [1, 3, 4, 7, 8, 11, 12, 15, 17, 19, 20, 27])
def test_changes_that_break_off_are_an_error(kept: int) -> None:
    compare = Comparing()
    whole = b"".join(compare(np.array(frame, np.uint32).tobytes()) for frame in ([5, 6], [5, 7]))
    assert [len(changes_of(whole[:length], 2)) for length in (16, 28)] == [1, 2]
    with pytest.raises(EOFError):
        changes_of(whole[:kept], 2)


def test_no_frames_are_no_changes() -> None:
    assert changes_of(b"", 5) == []
