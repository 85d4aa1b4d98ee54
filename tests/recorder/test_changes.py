"""Frames told by what changes, and put together again."""

from __future__ import annotations

import io

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from linkanim.recorder.changes import Comparing, changes

WIDEST = 12
pixels = st.integers(0, 3).map(lambda n: (0, 1, 0xFF000000, 0xFFFFFFFF)[n])


@settings(max_examples=60)
@given(st.lists(st.lists(pixels, min_size=WIDEST, max_size=WIDEST), max_size=6))
def test_changes_make_the_frames_again_and_name_each_changed_pixel_once(rows: list[list[int]]) -> None:
    frames = [np.array(row, np.uint32) for row in rows]
    compare, shown = Comparing(WIDEST), np.zeros(WIDEST, np.uint32)
    told = list(changes(io.BytesIO(b"".join(compare(frame.tobytes()) for frame in frames))))
    for (place, words), frame in zip(told, frames, strict=True):
        assert place.tolist() == np.flatnonzero(frame != shown).tolist()
        shown[place] = words
        assert shown.tolist() == frame.tolist()


def test_a_frame_may_be_drawn_over_once_it_is_told() -> None:
    compare, frame = Comparing(3), bytearray(12)
    compare(frame)
    frame[4] = 7
    assert [change.place.tolist() for change in changes(io.BytesIO(compare(frame)))] == [[1]]


@pytest.mark.parametrize("kept", [1, 3, 4, 5, 11, 19])
def test_changes_that_break_off_are_an_error(kept: int) -> None:
    whole = Comparing(2)(np.array([5, 6], np.uint32).tobytes())
    assert len(whole) == 20
    with pytest.raises(EOFError):
        list(changes(io.BytesIO(whole[:kept])))


def test_no_frames_are_no_changes() -> None:
    assert list(changes(io.BytesIO())) == []
