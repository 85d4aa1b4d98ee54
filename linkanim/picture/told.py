"""The card of words about a thing under the mouse, beside it, and a joint's two arrows."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from linkanim.frozen import NamedTuple
from linkanim.mechanics.motion import Motion, Pose
from linkanim.picture.figure import DrawSetting
from linkanim.picture.items import Caption, Group
from linkanim.picture.overlay import Told
from linkanim.picture.raster import Colour, Layer
from linkanim.picture.shapes import arrows, box, disc
from linkanim.picture.theme import mixed
from linkanim.picture.view import Rect

_LONGEST = 0.16
"""The longest arrow of a joint's cycle, in heights of the picture."""
_STEP, _MARGIN, _OFF = 1.35, 0.6, 1.2
"""The card's step from line to line, its margin, and its distance from the thing, in sizes of its text."""
Greatest = tuple[float, float]
"""A joint's greatest speed and acceleration over the cycle."""


def greatest(cycle: Motion, joint: str) -> Greatest:
    """Return a joint's greatest finite speed and acceleration over a cycle; 0 where it stands still."""
    sizes = (np.hypot(*np.atleast_2d(rates[joint]).T) for rates in (cycle.velocity, cycle.acceleration))
    speed, acceleration = (float(np.where(np.isfinite(one), one, 0.0).max()) for one in sizes)
    return speed, acceleration


def card(setting: DrawSetting, pose: Pose, told: Told, most: Greatest | None) -> Iterator[Group]:
    """Yield a joint's arrows, to the scale of its own greatest values, and the card with the words."""
    shown = list(_arrows(setting, pose, told.joint, most)) if most and told.joint else []
    foot = setting.view.place(pose.position[told.joint]) if shown else 0j
    yield Group("told-arrows", [layer for arrow in shown for layer in arrow.layers(foot)], over=True)
    theme, size, type_ = setting.theme, setting.layout.small_size, setting.type
    wide = max(type_.width(line, size) for line in told.lines) + 2 * _MARGIN * size
    high = (_STEP * len(told.lines) - (_STEP - 1.0) + 2 * _MARGIN) * size
    busy = (*setting.layout.words, *(arrow.box(foot) for arrow in shown))
    at = _place(setting, setting.view.place(told.at), (wide, high), busy)
    middle = at + complex(wide, high) / 2
    rim = mixed(theme.dim, theme.background, 0.5)
    plates = [
        Layer(rim, [middle + box(wide + 0.16 * size, high + 0.16 * size, 0.4 * size)], 0.9),
        Layer(theme.panel, [middle + box(wide, high, 0.34 * size)], 0.94),
    ]
    left, top = at.real + _MARGIN * size, at.imag + _MARGIN * size
    words = [
        Caption(line, (left, top + _STEP * size * n), size, theme.ink, strong=n == 0)
        for n, line in enumerate(told.lines)
    ]
    yield Group("told", plates, words, over=True)


def _place(setting: DrawSetting, thing: complex, size: tuple[float, float], busy: Sequence[Rect]) -> complex:
    """Return the upper left corner of the card: beside the thing, within the picture, off what is `busy`.

    For one of the words about the scene it may stand beside all of them.
    """
    (wide, high), (right, bottom) = size, setting.layout.size
    off, edge = _OFF * setting.layout.text_size, 0.3 * setting.layout.small_size
    places = [
        complex(
            min(max(thing.real + (off if to_right else -off - wide), edge), right - edge - wide),
            min(max(thing.imag + (off if below else -off - high), edge), bottom - edge - high),
        )
        for below in (False, True)
        for to_right in (True, False)
    ]
    beside = max((one.right for one in setting.layout.words), default=0.0) + 0.5 * off
    if beside + wide <= right - edge:
        places.append(complex(beside, min(max(thing.imag - high / 2, edge), bottom - edge - high)))
    cards = ((at, Rect(at.real, at.imag, wide, high)) for at in places)
    return next((at for at, card_ in cards if not any(card_.meets(one) for one in busy)), places[0])


class _ToldArrow(NamedTuple):
    """An arrow from a joint: its reach in pixels, its colour and the ground's, and its width."""

    reach: complex
    colours: tuple[Colour, Colour]
    width: float

    def layers(self, foot: complex) -> list[Layer]:
        rims = zip(self.colours, (0.0, 0.5 * self.width), strict=True)
        found = [Layer(colour, arrows([foot], [self.reach], self.width, rim)) for colour, rim in rims]
        return found[::-1]

    def box(self, foot: complex) -> Rect:
        low = complex(min(self.reach.real, 0.0), min(self.reach.imag, 0.0))
        return Rect((foot + low).real, (foot + low).imag, abs(self.reach.real), abs(self.reach.imag))


def _arrows(setting: DrawSetting, pose: Pose, joint: str, most: Greatest) -> Iterator[_ToldArrow]:
    theme, longest = setting.theme, _LONGEST * setting.layout.size[1]
    faster = abs(pose.input_speed / setting.figure.linkage.drive.speed)
    kinds = (
        (pose.velocity[joint], most[0] * faster, theme.velocity),
        (pose.acceleration[joint], most[1] * faster**2, theme.acceleration),
    )
    for (x, y), largest, colour in kinds:
        reach = longest * complex(x, -y) / largest if largest > 0.0 else 0j
        if 0.01 * longest < abs(reach) <= 2.0 * longest:
            yield _ToldArrow(reach, (colour, theme.background), 1.8 * setting.gauge.line)


def instant(setting: DrawSetting, places: list[complex]) -> Iterator[Layer]:
    """Yield a light on each curve, where its joint is at the instant under the mouse."""
    for middle in places:
        for reach, alpha in ((2.0, 0.2), (1.3, 0.35), (0.7, 0.9)):
            yield Layer(setting.theme.acceleration, [middle + disc(reach * setting.gauge.bar)], alpha)
