"""Colours that read from the back row, and that colour-blind eyes can tell apart."""

from __future__ import annotations

from itertools import combinations

import numpy as np
import pytest
from pictures import contrast

from linkanim.picture.raster import Colour
from linkanim.picture.theme import DARK, LIGHT, Theme, mixed, theme_of

THEMES = pytest.mark.parametrize("theme", [LIGHT, DARK], ids=["light", "dark"])

# Linear RGB as seen without one kind of cone (Viénot, Brettel, Mollon 1999).
SEEN_BY = {
    "protan": np.array([[0.11238, 0.88762, 0.0], [0.11238, 0.88762, 0.0], [0.00401, -0.00401, 1.0]]),
    "deutan": np.array([[0.29275, 0.70725, 0.0], [0.29275, 0.70725, 0.0], [-0.02234, 0.02234, 1.0]]),
}


def _seen(colour: Colour, eye: str) -> np.ndarray:
    linear = (np.array(colour) / 255) ** 2.2
    return 255 * np.clip(SEEN_BY[eye] @ linear, 0, 1) ** (1 / 2.2)


@THEMES
def test_text_stands_out(theme: Theme) -> None:
    for ground in (theme.background, theme.panel, theme.chosen):
        assert contrast(theme.ink, ground) >= 7
        assert contrast(theme.dim, ground) >= 4.5
        assert contrast(theme.warning, ground) >= 4.5


@THEMES
def test_lines_that_carry_meaning_stand_out(theme: Theme) -> None:
    for colour in (theme.outline, theme.velocity, theme.acceleration, *theme.traces[:2]):
        assert contrast(colour, theme.background) >= 4
    assert contrast(theme.ground, theme.background) >= 3


@THEMES
@pytest.mark.parametrize("eye", SEEN_BY)
def test_the_first_four_bodies_differ_for_colour_blind_eyes(theme: Theme, eye: str) -> None:
    for one, other in combinations(theme.bodies[:4], 2):
        assert np.linalg.norm(_seen(one, eye) - _seen(other, eye)) > 40, (one, other)


@THEMES
@pytest.mark.parametrize("eye", SEEN_BY)
def test_velocity_and_acceleration_differ_for_colour_blind_eyes(theme: Theme, eye: str) -> None:
    assert np.linalg.norm(_seen(theme.velocity, eye) - _seen(theme.acceleration, eye)) > 80


@pytest.mark.parametrize(
    ("one", "other", "ratio"),
    [
        # WCAG's own ends of the scale, and a grey of its tables
        ((0, 0, 0), (255, 255, 255), 21.0),
        ((255, 255, 255), (255, 255, 255), 1.0),
        ((118, 118, 118), (255, 255, 255), 4.54),
    ],
)
def test_contrast_is_that_of_wcag(one: Colour, other: Colour, ratio: float) -> None:
    assert contrast(one, other) == pytest.approx(ratio, abs=0.01)
    assert contrast(other, one) == contrast(one, other)


def test_mixing_goes_from_one_colour_to_the_other() -> None:
    assert mixed((10, 20, 30), (110, 0, 31), 0.0) == (10, 20, 30)
    assert mixed((10, 20, 30), (110, 0, 31), 1.0) == (110, 0, 31)
    assert mixed((10, 20, 30), (110, 0, 30), 0.5) == (60, 10, 30)


def test_themes_go_by_their_names() -> None:
    assert theme_of("light") is LIGHT
    assert theme_of("dark") is DARK
    with pytest.raises(KeyError):
        theme_of("sepia")
