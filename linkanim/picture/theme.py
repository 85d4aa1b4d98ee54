"""Colours: a light and a dark theme, from the colour-blind-safe palette of Okabe and Ito (2008)."""

from __future__ import annotations

from dataclasses import replace

from linkanim.frozen import frozen
from linkanim.picture.raster import Colour

ORANGE = (230, 159, 0)
SKY = (86, 180, 233)
GREEN = (0, 158, 115)
YELLOW = (240, 228, 66)
BLUE = (0, 114, 178)
VERMILLION = (213, 94, 0)
PURPLE = (204, 121, 167)


@frozen
class Theme:
    """Every colour of a picture, by what it is for."""

    background: Colour
    ink: Colour
    """Titles and numbers."""
    dim: Colour
    """Names beside the numbers, ticks."""
    rule: Colour
    """Frames, grid lines and other lines in the background."""
    outline: Colour
    ground: Colour
    gear: Colour
    metal: Colour
    """Springs, piston rods, slider blocks."""
    pin: Colour
    velocity: Colour
    acceleration: Colour
    force: Colour
    warning: Colour
    panel: Colour
    chosen: Colour
    bodies: tuple[Colour, ...]
    """The driven crank's first, then in the order of the scene."""
    traces: tuple[Colour, ...]
    """The colours of traced joints in their order, used again from the first."""
    speeds: tuple[Colour, ...]
    """From standing still to the greatest speed."""
    lit: bool = False
    """Whether bodies throw shadows and have highlights, as a thing of metal has; else it is a diagram's."""


LIGHT = Theme(
    background=(252, 252, 250),
    ink=(24, 28, 34),
    dim=(84, 90, 99),
    rule=(206, 209, 214),
    outline=(38, 43, 51),
    ground=(120, 126, 135),
    gear=(214, 217, 222),
    metal=(150, 157, 167),
    pin=(252, 252, 250),
    velocity=(0, 98, 156),
    acceleration=(190, 72, 0),
    force=(150, 32, 118),
    warning=(186, 34, 22),
    panel=(255, 255, 255),
    chosen=(222, 236, 247),
    bodies=(VERMILLION, BLUE, GREEN, ORANGE, SKY, PURPLE),
    traces=((174, 70, 128), (0, 128, 96), ORANGE),
    speeds=((52, 108, 190), (126, 56, 150), (204, 30, 80), (232, 104, 0)),
)

DARK = Theme(
    background=(17, 20, 26),
    ink=(240, 242, 245),
    dim=(164, 171, 181),
    rule=(54, 60, 70),
    outline=(222, 226, 232),
    ground=(128, 135, 146),
    gear=(48, 54, 64),
    metal=(124, 132, 144),
    pin=(17, 20, 26),
    velocity=SKY,
    acceleration=(255, 150, 64),
    force=(244, 140, 214),
    warning=(255, 122, 104),
    panel=(28, 32, 40),
    chosen=(32, 58, 82),
    bodies=(VERMILLION, BLUE, GREEN, ORANGE, SKY, PURPLE),
    traces=((232, 150, 196), (60, 200, 160), YELLOW),
    speeds=((84, 140, 230), (178, 120, 220), (240, 110, 140), (255, 176, 64)),
)

_THEMES = {"light": LIGHT, "dark": DARK}


_PAPER = (255, 255, 255)
"""What a light figure with a transparent ground lies on."""


def on_paper(theme: Theme) -> Theme:
    """Return the theme for a figure with a transparent ground: the light theme's rims are white as paper."""
    return replace(theme, background=_PAPER, pin=_PAPER) if theme.background == LIGHT.background else theme


_SOFTER, _RECEDED = 0.25, 0.3
"""The share of the background in outlines and in the ground where bodies are lit."""


def theme_of(name: str, *, lit: bool = False) -> Theme:
    """Return the theme "light" or "dark", its outlines softer where bodies are `lit`.

    KeyError for another name.
    """
    theme = _THEMES[name]
    if not lit:
        return theme
    outline = mixed(theme.outline, theme.background, _SOFTER)
    ground = mixed(theme.ground, theme.background, _RECEDED)
    return replace(theme, outline=outline, ground=ground, lit=True)


def mixed(colour: Colour, other: Colour, share: float) -> Colour:
    """Return `colour` with this share (0 to 1) of `other` in it."""
    red, green, blue = (round(a + (b - a) * share) for a, b in zip(colour, other, strict=True))
    return red, green, blue
