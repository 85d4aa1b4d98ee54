"""A mode: a ruler is laid from place to place, and says how long it is and in which direction it lies.

An end that is put on a joint moves with it, so the ruler also shows how a distance changes while the linkage
runs.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from math import atan2, degrees, dist
from typing import TYPE_CHECKING, ClassVar

from linkanim.frozen import frozen
from linkanim.mechanics.linkage import Point
from linkanim.picture.build_sheet import Head, crosshair
from linkanim.picture.drawn import Addition
from linkanim.picture.marks import DimensionLine, measure
from linkanim.picture.text import subscripted
from linkanim.player import rules
from linkanim.player.action import Action
from linkanim.player.keys import BACK_BAR, HOME_BAR, LAST_BAR, MOVING_BAR, KeyRow, ModeKeys
from linkanim.player.state import NEAR_HAND, Mode, Rule, State
from linkanim.scenes.scene import Scene
from linkanim.units import four_digits
from linkanim.words import said, to_say

if TYPE_CHECKING:
    from linkanim.mechanics.motion import Pose
    from linkanim.picture.figure import DrawSetting
    from linkanim.picture.items import Group
    from linkanim.player.hand import Gesture, Hand
    from linkanim.player.sight import Sight

_HINT = to_say("click two places: an end on a joint moves with it")


def _toggle(state: State, _: None) -> State:
    """Lay the ruler down, or take it away."""
    if state.of(Ruler):
        return state.without(Ruler)
    bare = state.unlisted.unhelped
    return bare if bare.keys.alone else bare.with_mode(Ruler(bare.scene))


def _end(state: State, place: tuple[float, float, float]) -> State:
    """Put an end of the ruler at a place, or on the joint that is nearer than the third number."""
    ruler = state.of(Ruler)
    if ruler is None:
        return state
    x, y, reach = place
    metre = state.displayed.linkage.metre
    away, joint = min((dist(at, (x, y)), name) for name, at in _places(state).items())
    before = ruler.ends if len(ruler.ends) < 2 else ()
    return state.with_mode(replace(ruler, ends=(*before, joint if away <= reach else (x * metre, y * metre))))


def _places(state: State) -> Mapping[str, Point]:
    return state.displayed.pose(state.phase, 0).position


@frozen
class Ruler(Mode):
    """The ruler on a scene, with up to two ends: each a joint, or a place in the plane in metres."""

    scene: Scene
    ends: tuple[str | Point, ...] = ()

    keys = ModeKeys(
        "ruler", {"in Shift+R": (KeyRow("click", _HINT), KeyRow("Shift+R, Esc", "put the ruler away"))}
    )
    bar = (BACK_BAR, HOME_BAR, *MOVING_BAR, *LAST_BAR)
    actions: ClassVar[Mapping[str, Rule]] = {
        "ruler": Rule(rules.nothing, _toggle),
        "ruler_end": Rule(rules.numbers(3), _end),  # x and y, and how near a joint is taken
    }
    has_head = True

    def agreed(self, before: State, after: State) -> State:
        """Return the state without the ruler where another linkage is shown."""
        del before
        known = {end for end in self.ends if isinstance(end, str)} <= after.scene.linkage.by_name.keys()
        return after if known and after.scene.name == self.scene.name else after.without(Ruler)

    def drawn(self, state: State) -> tuple[Addition, ...]:
        """Return the ruler, and at the head its length and direction."""
        places, metre = _places(state), state.displayed.linkage.metre
        laid = tuple(
            places[end] if isinstance(end, str) else (end[0] / metre, end[1] / metre) for end in self.ends
        )
        if len(laid) < 2:
            return LaidRuler(laid), Head(said(_HINT))
        (x, y), (u, v) = laid
        first, last = (subscripted(end) if isinstance(end, str) else said("a place") for end in self.ends)
        length = f"{four_digits(dist((x, y), (u, v)))} {state.displayed.length_unit}"
        angle = f"{four_digits(degrees(atan2(v - y, u - x)) % 360)}°"
        words = said(
            "{first} to {last}: {length} at {angle}", first=first, last=last, length=length, angle=angle
        )
        return LaidRuler(laid, length), Head(words)

    def mouse(self, gesture: Gesture, mouse: Hand, screen: Sight) -> tuple[Action, ...] | None:
        """Put down an end; None where the mouse acts as usual."""
        if gesture.kind != "down":
            return None
        mouse.drag = "bar"
        reach = NEAR_HAND * screen.size[1] / screen.last.view.scale
        return (Action("ruler_end", (*screen.world(*mouse.at), reach)),)


@frozen
class LaidRuler(Addition):
    """The ends of a ruler in the plane, and its length in words."""

    ends: tuple[Point, ...]
    length: str = ""

    def groups(self, setting: DrawSetting, pose: Pose) -> Iterator[Group]:
        """Yield the ends, and the line between them."""
        del pose
        for place in self.ends:
            yield crosshair("ruler-end", place, setting)
        if self.length:
            begin, end = map(setting.view.pixel, self.ends)
            yield from measure(setting, begin, end, DimensionLine(("", ""), 0, 1, self.length, chosen=False))
