"""Whatever comes to a window: events of every kind at eight sizes, while files, disk and pads come and go.

Some hundred events as a rule, a hundred thousand with `pytest -m long`.
"""

from __future__ import annotations

from pathlib import Path

import pytest
from storm import SIZES, Storm

from linkanim.ui import screen


def blown(events: int, seed: int, here: Path, patch: pytest.MonkeyPatch, *, calm: bool = False) -> Storm:
    """Let so many events come; whatever a window raises, or has to report."""
    storm = Storm(seed, here, patch, calm=calm)
    with screen.opened(SIZES[0]):
        storm.blow(events)
    return storm


@pytest.mark.thinned(2)
@pytest.mark.slow
@pytest.mark.withstands("events withstood", 250)
@pytest.mark.parametrize("seed", [1, 2])
def test_a_window_outlasts_whatever_comes(seed: int, here: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    assert blown(250, seed, here, monkeypatch).events >= 250


@pytest.mark.long
@pytest.mark.withstands("events withstood", 12_500)
@pytest.mark.parametrize("seed", range(10, 18))
def test_a_window_outlasts_a_hundred_thousand_events(
    seed: int, here: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert blown(12_500, seed, here, monkeypatch).events >= 12_500


@pytest.mark.long
@pytest.mark.withstands("events withstood", 41_000)
def test_a_window_outlasts_twenty_thousand_ticks_of_keys_and_wheel(
    here: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert blown(41_000, 3, here, monkeypatch, calm=True).ticks > 20_000
