"""Icons of tools and commands: as large as their button, at any size."""

from __future__ import annotations

import numpy as np
import pytest

from linkanim.picture.layout import Gauge
from linkanim.picture.theme import LIGHT
from linkanim.ui.command_icons import COMMAND_ICONS
from linkanim.ui.tools import ICONS


def _reach(name: str, thin: float) -> float:
    """Return how far an icon reaches from its middle, in thin lines of this width (pixels)."""
    gauge = Gauge(bar=2.1 * thin, outline=0.8 * thin, pin=1.1 * thin, line=thin)
    layers = {**ICONS, **COMMAND_ICONS}[name](gauge, LIGHT)
    corners = np.concatenate([loop for layer in layers for loop in layer.loops])
    return float(max(np.abs(corners.real).max(), np.abs(corners.imag).max()) / thin)


@pytest.mark.parametrize("name", sorted({**ICONS, **COMMAND_ICONS}))
def test_an_icon_fills_its_button_at_any_size(name: str) -> None:
    small, large = (_reach(name, thin) for thin in (0.5, 3.0))
    assert 6.0 < small < 11.1
    assert small == pytest.approx(large, rel=0.01)
