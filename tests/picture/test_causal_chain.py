"""The input's colour along the chain, as joints are solved."""

from __future__ import annotations

from itertools import pairwise

import pygame
import pytest
from pictures import contrast, painted

from linkanim.mechanics.analysis import solving_steps
from linkanim.picture.bodies import CausalChain
from linkanim.picture.look import Look
from linkanim.picture.picture import Picture
from linkanim.picture.theme import DARK, LIGHT, Theme
from linkanim.scenes import load, names

THEMES = pytest.mark.parametrize("theme", [LIGHT, DARK], ids=["light", "dark"])


@THEMES
@pytest.mark.sampled
@pytest.mark.parametrize("name", names())
def test_each_step_is_nearer_to_the_background(name: str, theme: Theme) -> None:
    colours = CausalChain(solving_steps(load(name).linkage), theme).colours
    assert colours[0] == theme.bodies[0]
    apart = [contrast(colour, theme.background) for colour in colours]
    # by lightness alone, which every eye sees
    assert all(one > 1.04 * other for one, other in pairwise(apart))
    assert apart[-1] > 1.02


# From the input on: what moves what, in words of each scene's file.
CHAINS = {
    "crank-rocker": ["crank", "coupler", "rocker"],
    "six-bar": ["crank", "coupler", "rocker", "coupler2", "rocker2"],
}


@THEMES
@pytest.mark.parametrize("name", CHAINS)
def test_links_fade_in_the_order_in_which_they_move_each_other(name: str, theme: Theme) -> None:
    look = Look(chain=True, theme="light" if theme is LIGHT else "dark", material="flat")
    parts = Picture(load(name), (320, 180), look).drawing.bodies
    coloured = ((part.name, layer.colour) for part in parts for layer in part.layers)
    fill = {name: colour for name, colour in coloured if colour != theme.outline}
    shades = [contrast(fill[body], theme.background) for body in CHAINS[name]]
    assert shades == sorted(shades, reverse=True)
    assert len(set(shades)) == len(shades)


@pytest.mark.parametrize("name", ["press", "crank-rocker", "jansen"])
def test_the_key_shows_a_colour_for_each_step(name: str) -> None:
    scene, look = load(name), Look(chain=True)
    picture = Picture(scene, (1280, 720), look)
    groups = {group.name: group for group in picture.groups(scene.pose(0.4))}
    chain = CausalChain(solving_steps(picture.figure.linkage), LIGHT)
    assert [words.text for words in groups["key"].captions] == ["input", "output"]
    assert [layer.colour for layer in groups["key"].layers[1::2]] == list(chain.colours)


def test_without_it_every_pixel_is_as_it_was() -> None:
    scene = load("press")
    plain, chained = (painted(scene, 0.4, Look(hud=False, chain=on)) for on in (False, True))
    again = painted(scene, 0.4, Look(hud=False))
    assert pygame.image.tobytes(plain, "RGB") == pygame.image.tobytes(again, "RGB")
    assert pygame.image.tobytes(plain, "RGB") != pygame.image.tobytes(chained, "RGB")
