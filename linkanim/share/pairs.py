"""Colours of a page that goes by its reader's setting: each is one of a pair, of light and of dark."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass, field
from itertools import pairwise

from linkanim.paper.svg import drawn, hexadecimal
from linkanim.picture.items import Caption, Item
from linkanim.picture.look import ThemeName
from linkanim.picture.raster.raster import Colour
from linkanim.picture.theme import theme_of


@dataclass(frozen=True)
class Pairs:
    """The colours met so far, numbered in their order; a page's styles have them as --c0, --c1 and on."""

    numbers: dict[tuple[Colour, Colour], int] = field(default_factory=dict)

    def variable(self, light: Colour, dark: Colour) -> str:
        """Return the pair as a style's value."""
        return f"var(--c{self._number(light, dark)})"

    def variables(self, light: Iterable[Colour], dark: Iterable[Colour]) -> list[str]:
        """Return colours of both themes as a style's values."""
        return [self.variable(*pair) for pair in zip(light, dark, strict=True)]

    def elements(self, light: Iterable[Item], dark: Iterable[Item]) -> str:
        """Return the same items, described in both themes, as SVG."""
        coded = [self._coded(*pair) for pair in zip(light, dark, strict=True)]
        return "".join(map(_shorter, drawn(coded, lambda colour: f"var(--c{int.from_bytes(colour)})")))

    def styles(self, themes: tuple[ThemeName, ThemeName], stated: ThemeName | None) -> str:
        """Return the style sheet of the colours, ink and background among them by their names.

        A theme that is stated holds whatever its reader's is.
        """
        pair = [theme_of(name) for name in themes]
        ink = self.variable(pair[0].ink, pair[1].ink)
        back = self.variable(pair[0].background, pair[1].background)
        named = f"--ink: {ink}; --back: {back};"
        light, dark = (self._declared(n) for n in range(2))
        if stated:
            return f":root {{ color-scheme: {stated}; {named} {light} }}"
        return (
            f":root {{ color-scheme: light dark; {named} {light} }}\n"
            f"@media (prefers-color-scheme: dark) {{ :root:not([data-theme=light]) {{ {dark} }} }}\n"
            f":root[data-theme=light] {{ color-scheme: light; }}\n"
            f":root[data-theme=dark] {{ color-scheme: dark; {dark} }}"
        )

    def _declared(self, which: int) -> str:
        colours = (hexadecimal(pair[which]) for pair in self.numbers)
        return " ".join(f"--c{n}: {colour};" for n, colour in enumerate(colours))

    def _number(self, light: Colour, dark: Colour) -> int:
        return self.numbers.setdefault((light, dark), len(self.numbers))

    def _coded(self, light: Item, dark: Item) -> Item:
        """Return an item with the number of its pair for its colour."""
        colour = self._code(light.colour, dark.colour)
        if not (isinstance(light, Caption) and isinstance(dark, Caption)):
            return light._replace(colour=colour)
        halo = light.halo
        if halo and dark.halo:
            halo = halo._replace(colour=self._code(halo.colour, dark.halo.colour))
        return light._replace(colour=colour, halo=halo)

    def _code(self, light: Colour, dark: Colour) -> Colour:
        red, green, blue = self._number(light, dark).to_bytes(3)
        return red, green, blue


def _shorter(element: str) -> str:
    """Return a path with its points from one to the next, in half the letters; another element as it is."""
    return _LOOP.sub(_stepwise, element) if element.startswith("<path") else element


def _stepwise(loop: re.Match[str]) -> str:
    points = [tuple(map(float, point.split())) for point in loop[1].split("L")]
    steps = (_number(to - begin) for pair in pairwise(points) for begin, to in zip(*pair, strict=True))
    short = " ".join(steps).replace(" -", "-")
    return f"M{points[0][0]:g} {points[0][1]:g}" + (f"l{short}Z" if short else "Z")


def _number(step: float) -> str:
    text = f"{round(step, 2) + 0.0:g}"  # -0.0 + 0.0 is 0.0
    return text.replace("0.", ".", 1) if text.startswith(("0.", "-0.")) else text


_LOOP = re.compile("M([^MZ]*)Z")
