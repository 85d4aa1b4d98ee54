"""Actions on the look: what is shown beside the linkage, in which theme, and how near."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from typing import TypeVar

from linkanim.errors import LinkanimError
from linkanim.picture.diagrams.course import axes_of, axis_of
from linkanim.picture.look import Look, toggled
from linkanim.player.state.state import State, with_toast
from linkanim.scenes.editing.closures import other_closure
from linkanim.units import LENGTH_UNITS

Step = TypeVar("Step")

_NOTCH = 1.25
_NOTCHES = (-8, 16)
_PLACES = 9


def chart(state: State, further: int) -> State:
    """Show the telling quantity so many further; none follows the last, and any that is not telling."""
    charts = (None, *state.scene.telling)
    if state.look.chart not in charts:
        return replace(state, look=replace(state.look, chart=None))
    at = charts.index(state.look.chart)
    return replace(state, look=replace(state.look, chart=charts[(at + further) % len(charts)]))


def toggling(name: str) -> Callable[[State, str | None], State]:
    """Return the handler that takes a field of the look to its next step; of a set, puts in or takes out."""
    return lambda state, member: replace(state, look=toggled(state.look, name, member))


def ghost(state: State, _: None) -> State:
    """Show or hide the other closure, where there is one."""
    if not state.look.ghost:
        try:
            other_closure(state.scene)
        except LinkanimError as error:
            return with_toast(state, str(error))
    return replace(state, look=toggled(state.look, "ghost"))


def unit(state: State, _: None) -> State:
    """Show lengths in the next unit, the scene's own among them."""
    following = _after(settled(state).unit, LENGTH_UNITS, usual=state.scene.length_unit)
    return replace(state, look=replace(state.look, unit=following))


def over(state: State, _: None) -> State:
    """Run the chart over the next axis that the scene has, the usual one among them."""
    axes = axes_of(state.scene)
    following = _after(settled(state).over, axes, usual=axes[0])
    return replace(state, look=replace(state.look, over=following))


def _after(now: Step | None, steps: tuple[Step, ...], *, usual: Step) -> Step | None:
    """Return the step after this one, None for the usual one."""
    following = steps[(steps.index(now) + 1) % len(steps)] if now in steps else usual
    return None if following == usual else following


def settled(state: State) -> Look:
    """Return the look with what the scene has as usual instead of None."""
    scene, look = state.scene, state.look
    return replace(look, unit=look.unit or scene.length_unit, over=axis_of(scene, look.over))


def theme(state: State, _: None) -> State:
    """Go from light to dark, or back."""
    return replace(state, look=toggled(state.look, "theme"), faded=state.frame)


def zoom(state: State, about: tuple[float, float, float]) -> State:
    """Go so many notches nearer to a point."""
    notches, x, y = about
    return replace(state, look=zoomed(state.look, notches, (x, y)))


def pan(state: State, by: tuple[float, float]) -> State:
    """Shift the picture by so many window heights, right and down."""
    (across, down), look = by, state.look
    return replace(state, look=replace(look, pan=_rounded(look.pan[0] + across, look.pan[1] + down)))


def fit(state: State, _: None) -> State:
    """Let the linkage fill its room again."""
    return replace(state, look=replace(state.look, zoom=1.0, pan=(0.0, 0.0)))


def zoomed(look: Look, notches: float, about: tuple[float, float]) -> Look:
    """Return the look so many notches nearer, the point `about` staying where it is.

    `about` is in window heights from the middle of the picture, right and down. So many notches
    out again give the same look, unless the end of the range was met.
    """
    before = math.log(look.zoom, _NOTCH)
    low, high = _NOTCHES
    zoom = _NOTCH ** min(max(round(before + notches), low), high)
    ratio = zoom / look.zoom
    pan = tuple(point - (point - shift) * ratio for point, shift in zip(about, look.pan, strict=True))
    return replace(look, zoom=zoom, pan=_rounded(pan[0], pan[1]))


def _rounded(x: float, y: float) -> tuple[float, float]:
    """Round far below a pixel, so that a way there and back ends on the same picture."""
    return round(x, _PLACES) + 0.0, round(y, _PLACES) + 0.0
