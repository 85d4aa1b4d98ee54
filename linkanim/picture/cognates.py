"""The cognates of the pencil's linkage: further four-bars that trace the same curve, drawn faintly."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from linkanim.mechanics.motion import Pose
from linkanim.picture.figure import DrawSetting
from linkanim.picture.items import Group
from linkanim.picture.raster import Layer
from linkanim.picture.shapes import disc, hull, rounded, stroke
from linkanim.picture.theme import mixed
from linkanim.synthesis.roberts import CognateJoints, cognate_joints

_SLIM, _PIN = 0.8, 0.5
"""Half the width of a bar and the radius of a pin, in half widths of the linkage's bars."""
_JOINTS = ("O2", "O4", "A", "B", "P")
_FAINT, _PANE = 0.35, 0.07
"""The share of the ink in an outline, and the opacity of a bar's fill."""


def cognate_group(setting: DrawSetting, pose: Pose, numbers: Sequence[int]) -> Group:
    """Return the cognates of these numbers, 0 or 1, where they stand in a pose of the linkage."""
    gauge, theme = setting.gauge, setting.theme
    ink, layers = mixed(theme.ink, theme.background, 1 - _FAINT), list[Layer]()
    for number in numbers:
        bars = [[setting.view.pixel((at.real, at.imag)) for at in bar] for bar in cognate_bars(pose, number)]
        outlines = [rounded(bar, _SLIM * gauge.bar) for bar in bars]
        layers.append(Layer(ink, outlines, _PANE))
        layers += [Layer(ink, stroke(one, 0.6 * gauge.line, closed=True)) for one in outlines]
        layers.append(Layer(ink, [at + disc(_PIN * gauge.bar) for bar in bars for at in bar[:2]]))
    return Group("cognates", layers)


def cognate_bars(pose: Pose, number: int) -> tuple[tuple[complex, ...], ...]:
    """Return the joints of a cognate's crank, coupler and rocker, as x + yi; empty for no four-bar."""
    if not {*_JOINTS} <= pose.position.keys():
        return ()
    o2, o4, a, b, p = (complex(*pose.position[name]) for name in _JOINTS)
    joints: tuple[CognateJoints[complex], ...] = cognate_joints((o2, o4), (p - a) / (b - a), (a, b, p))
    pivot, crank, rocker, other = joints[number]
    return (pivot, crank), (crank, rocker, p), (other, rocker)


def cognate_sides(pose: Pose, number: int) -> Iterator[tuple[complex, complex]]:
    """Yield the sides of a cognate's bars: a click on one takes the cognate."""
    for bar in cognate_bars(pose, number):
        corners = hull(bar)
        yield from zip(corners, [*corners[1:], corners[0]], strict=True)
