"""What of a linkage is drawn: its pins, its bodies, and where a cycle takes them."""

from __future__ import annotations

from dataclasses import replace
from functools import cached_property, partial, reduce
from itertools import combinations
from math import tau
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from linkanim.frozen import frozen
from linkanim.mechanics.centres import blocks
from linkanim.mechanics.groups import group_of
from linkanim.mechanics.linkage import Body, Brace, Damper, Linkage, Spring, holding
from linkanim.mechanics.motion import Motion, Pose
from linkanim.picture.layout import Gauge, Layout
from linkanim.picture.look import Look
from linkanim.picture.raster import Loop
from linkanim.picture.text import Type
from linkanim.picture.theme import Theme
from linkanim.picture.view import Box, View
from linkanim.scenes.scene import FREE_STYLE, Scene

if TYPE_CHECKING:
    from linkanim.mechanics.polygons import Order, Side

SAMPLES = 720
_MOST_PERIODS = 4
_STILL = 1e-9
_FLAT = 1e-4
"""How far a curve may be from its chords, in shares of the figure's extent: a fifth of a pixel at 1080p."""
DOWN = np.array([1, -1j])
"""The product of this with a vector (x, y), y up, is x + yi with y down, as in pixels."""


Parts = dict[Body, tuple[str, ...]]
"""Every body that is drawn, with the names of the scene's bodies that it stands for."""


@frozen
class Figure:
    """A scene and one cycle of it, from which drawing takes all its measures."""

    scene: Scene
    cycle: Motion

    @property
    def linkage(self) -> Linkage:
        """The linkage that is drawn."""
        return self.scene.linkage

    @cached_property
    def bodies(self) -> tuple[Body, ...]:
        """The bodies with named joints, and a bar for each length that neither they nor struts show.

        Three bars of a rigid triangle are one plate.
        """
        return tuple(body for body in self._parts if len(body.joints) > 1)

    @cached_property
    def links(self) -> dict[Body, str]:
        """The named bodies, and what each is called: a plate after all of its bars."""
        called = self.scene.info.link_names
        return {
            body: "-".join(called[name] for name in names if name)
            for body, names in self._parts.items()
            if any(names)
        }

    @cached_property
    def numbers(self) -> dict[Body, str]:
        """The links with their numbers: the scene's own, or in its order from 2; the ground is 1.

        Bodies that cannot move against each other share a number.
        """
        if all(body.name.isdecimal() for body in self.links):
            return {body: body.name for body in self.links}
        # the block of a slider is a rigid body of its own
        rigid = [body.slider or holding(self.linkage.rigid_bodies, body.joints) for body in self.links]
        number = {frame: str(n) for n, frame in enumerate(dict.fromkeys(rigid), start=2)}
        return {body: number[frame] for body, frame in zip(self.links, rigid, strict=True)}

    @cached_property
    def by_number(self) -> dict[str, Body | None]:
        """One link of each number: the ground, None, first; last the blocks without a name."""
        links: dict[str, Body | None] = {"1": None}
        for body, number in self.numbers.items():
            links.setdefault(number, body)
        highest = max(int(number) for number in links)
        return links | {str(n): block for n, block in enumerate(blocks(self.linkage), start=highest + 1)}

    @cached_property
    def _parts(self) -> Parts:
        """Every body that is drawn, with the names of the scene's bodies that it stands for."""
        named = [body for body in self.linkage.bodies if len(body.joints) > 1]
        # A length that a spring or damper shows, such as that of a locked cylinder, needs no bar.
        held = [*(set(body.joints) for body in named), *(set(strut.between) for strut in self.struts)]
        spans = [ends for joint in self.linkage.joints for ends in joint.spans]
        bare = [ends for ends in spans if not any(set(ends) <= joints for joints in held)]
        shown = (*(Body("", ends) for ends in bare), *self.linkage.bodies)
        parts: Parts = {body: (body.name,) for body in shown}
        braces = (joint for joint in self.linkage.joints if isinstance(joint, Brace))
        return reduce(partial(_with_plate, self.scene), braces, parts)

    @cached_property
    def pins(self) -> tuple[str, ...]:
        """The joints that are drawn as pins: bars meet in them, or a spring or damper is attached."""
        used = {name for joint in self.linkage.joints for name in joint.pins}
        hung = {name for strut in self.struts for name in strut.between}
        ends = {name for body in self.bodies for name in body.joints}
        fixed = {pin.name for pin in self.linkage.pins}
        names = used - self._free | hung | (ends & fixed)
        return tuple(joint.name for joint in self.linkage.joints if joint.name in names)

    @property
    def _free(self) -> set[str]:
        """The points of links that are solved together which are on one link alone: nothing turns there."""
        group, bodies = group_of(self.linkage), self.linkage.rigid_bodies
        slid = {slide.point for joint in self.linkage.joints for slide in joint.slides}
        points = {name for member in group.members for name in member.points} if group else set[str]()
        once = {name for name in points if group and len(group.at_point(name)) == 1} - slid
        return {name for name in once if sum(name in body for body in bodies) == 1}

    def riding(self, body: Body) -> tuple[str, ...]:
        """Return the ends of unnamed bars that keep their place on a body though they are not in it.

        Such bars, for example a trammel's, lie in line with the body all the time: the body is drawn for
        them.
        """
        ends = sorted({end for joint in body.joints for end in self._bare_ends.get(joint, ())})
        return tuple(
            name
            for name in dict.fromkeys(name for _, name in ends)
            if name not in body.joints and self._kept(body, name)
        )

    @cached_property
    def _bare_ends(self) -> dict[str, list[tuple[int, str]]]:
        """The far ends of the unnamed bars at each joint, each with its bar's number."""
        ends: dict[str, list[tuple[int, str]]] = {}
        for number, body in enumerate(self.bodies):
            if not body.name:
                for near, far in (body.joints[:2], body.joints[1::-1]):
                    ends.setdefault(near, []).append((number, far))
        return ends

    def _kept(self, body: Body, name: str) -> bool:
        """Return whether a joint keeps its place in a body's frame over the cycle."""
        begin, end, there = (self.cycle.position[joint] @ DOWN for joint in (*body.joints[:2], name))
        place = (there - begin) / (end - begin)
        return bool(np.all(np.abs(place - place[0]) <= _STILL * max(abs(place[0]), 1.0)))

    @cached_property
    def struts(self) -> tuple[Spring | Damper, ...]:
        """The springs, then the dampers, and the cylinder that drives."""
        return (*self.linkage.springs, *self.cylinders)

    @cached_property
    def cylinders(self) -> tuple[Damper, ...]:
        """The struts drawn as cylinder and piston: the dampers, and the cylinder that drives."""
        along = self.linkage.drive.actuator.along
        return (*self.linkage.dampers, *((Damper("cylinder", along),) if along else ()))

    @cached_property
    def fixed(self) -> tuple[str, ...]:
        """The pins that are fixed to the ground."""
        return tuple(name for name in self.pins if self.linkage.joint(name).fixed)

    @cached_property
    def in_view(self) -> tuple[str, ...]:
        """The joints that must be in the picture."""
        joints = self.linkage.joints
        drawn = {name for body in self.bodies for name in body.joints}
        names = {*self.pins, *drawn, *self.scene.trace, *(joint.name for joint in joints if joint.travels)}
        return tuple(joint.name for joint in joints if joint.name in names)

    @cached_property
    def lettered(self) -> tuple[str, ...]:
        """The joints in view with a letter; the end of a slot that is called as its link is has none."""
        links = {body.name for body in self.bodies}
        slotted = ((joint.name, bar) for joint in self.linkage.joints for _, bar in joint.slotted)
        ends = {name for name, bar in slotted if name in links and bar[1:] == (name,)}
        return tuple(name for name in self.in_view if name not in ends)

    @cached_property
    def moving(self) -> tuple[str, ...]:
        """The joints that move; of several that always coincide, one."""
        paths: dict[str, NDArray[np.float64]] = {}
        for name in self.in_view:
            path = np.atleast_2d(self.cycle.position[name])
            still, grain = np.ptp(path, axis=0).max() <= _STILL * self.extent, _STILL * self.extent
            if not still and not any(np.abs(path - other).max() <= grain for other in paths.values()):
                paths[name] = path
        return tuple(paths)

    @cached_property
    def box(self) -> Box:
        """The rectangle of the scene that the linkage sweeps; the unit square for an empty one."""
        points = [np.atleast_2d(self.cycle.position[name]) for name in self.in_view]
        if not points:
            return Box(0.0, 0.0, 1.0, 1.0)
        swept = np.concatenate(points)
        low, high = np.nanmin(swept, axis=0), np.nanmax(swept, axis=0)
        return Box(float(low[0]), float(low[1]), float(high[0]), float(high[1]))

    def box_of(self, pose: Pose) -> Box:
        """Return the rectangle of the scene that a pose takes up."""
        x, y = zip(*(pose.position[name] for name in self.in_view), strict=True)
        return Box(min(x), min(y), max(x), max(y))

    @cached_property
    def clearest(self) -> float:
        """The phase at which the joints are farthest `apart`, the first of several; 0 for a rigid linkage."""
        return float(self.cycle.phase[self.apart.argmax()])

    @cached_property
    def apart(self) -> NDArray[np.float64]:
        """How distinct the joints are at each moment of the cycle, as a share of the extent.

        It is the least distance of two joints, or of the end of a bar from the line of a bar that it meets.
        Distances that do not change are left out; 1 for a rigid linkage.
        """
        places = {name: np.atleast_2d(self.cycle.position[name]) @ DOWN for name in self.in_view}
        far = [np.abs(places[one] - places[other]) for one, other in combinations(places, 2)]
        for one, other in combinations((body.joints[:2] for body in self.bodies), 2):
            for joint in {*one} & {*other}:
                ways = [places[end] - places[joint] for pair in (one, other) for end in {*pair} - {joint}]
                longer = np.max(np.abs(ways), axis=0)
                # the distance of the shorter bar's end from the longer bar's line
                far += [
                    np.abs(np.imag(ways[0] * np.conj(ways[-1]))) / np.maximum(longer, _STILL * self.extent)
                ]
        apart = np.stack([*far, np.full(len(self.cycle.phase), self.extent)])
        moving = apart[np.ptp(apart, axis=1) > _STILL * self.extent]
        nearest = np.round(np.nan_to_num(moving).min(axis=0, initial=self.extent) / (_STILL * self.extent))
        return np.asarray(_STILL * nearest, np.float64)

    @cached_property
    def cycle_sides(self) -> tuple[list[Side], list[Side]]:
        """The vectors of the cycle's velocity and acceleration polygons at its own speed."""
        return self.polygon_sides(self.cycle, 1), self.polygon_sides(self.cycle, 2)

    def polygon_sides(self, motion: Motion | Pose, order: Order) -> list[Side]:
        """Return the vectors of a motion's polygon, including those of traced coupler points."""
        from linkanim.mechanics.polygons import chains

        sides = chains(motion, self.linkage, order, self.scene.trace)
        return [side for chain in sides for side in chain.sides]

    @property
    def extent(self) -> float:
        """The sum of the width and the height of `box`."""
        return self.box.right - self.box.left + self.box.high - self.box.low

    @cached_property
    def shortest(self) -> float:
        """The shortest bar, in the scene's unit."""
        spans = [abs(self.start(body.joints[1]) - self.start(body.joints[0])) for body in self.bodies]
        return min(spans, default=1.0)

    def wheel_reach(self, body: Body) -> float:
        """Return how far a body drawn as a wheel reaches from its first joint, in the scene's unit."""
        far = (abs(self.start(name) - self.start(body.joints[0])) for name in body.joints)
        return max(*far, self.scene.style(body.name).radius or 0.0)

    def start(self, name: str) -> complex:
        """Return where a joint stands as the cycle begins, in the scene's unit, y up."""
        x, y = self.cycle.position[name][0]
        return complex(float(x), float(y))

    def pixel(self, name: str, view: View) -> complex:
        """Return the pixel at which a joint stands as the cycle begins."""
        start = self.start(name)
        return view.pixel((start.real, start.imag))

    def path(self, name: str, view: View) -> Loop:
        """Return the pixels a joint passes through in one cycle, at equal steps of phase."""
        points = self.cycle.position[name]
        path: Loop = view.x + view.scale * points[:, 0] + 1j * (view.y - view.scale * points[:, 1])
        return path


@frozen
class DrawContext:
    """What every part is made from: a figure, where it lies in pixels, how thick and in which colours."""

    figure: Figure
    view: View
    gauge: Gauge
    theme: Theme

    @property
    def known(self) -> tuple[Figure, View, Gauge, Theme]:
        """Figure, view, gauge and theme as a tuple, for a function that reads most of them."""
        return self.figure, self.view, self.gauge, self.theme


@frozen
class DrawSetting(DrawContext):
    """A drawing context within a whole picture, with its layout, its look and its letters."""

    layout: Layout
    look: Look
    type: Type


def figure(scene: Scene) -> Figure:
    """Solve one cycle of the scene, closely enough for smooth curves at 4K.

    Where a traced point turns sharply the phases are closer: no chord of its curve may be seen as one.
    """
    periods = min(round(scene.period / tau), _MOST_PERIODS)
    count = scene.mechanism.count(SAMPLES * periods)
    drawn = Figure(scene, scene.cycle(count))
    off = _off_chords(drawn)
    times = next((n for n in (1, 2, 4) if off <= n * n * _FLAT), 8)
    return drawn if times == 1 else Figure(scene, scene.cycle(times * count))


def _off_chords(shown: Figure) -> float:
    """Return how far traced curves are from their chords at the most, as a share of the extent."""
    paths = (np.atleast_2d(shown.cycle.position[name]) for name in shown.scene.trace)
    bends = [np.abs(np.roll(path, -1, 0) - 2 * path + np.roll(path, 1, 0)).sum(axis=1) / 8 for path in paths]
    return max((float(np.nanmax(bend)) for bend in bends), default=0.0) / max(shown.extent, 1e-300)


def _with_plate(
    scene: Scene, parts: dict[Body, tuple[str, ...]], brace: Brace
) -> dict[Body, tuple[str, ...]]:
    """Return the bodies with a brace's two bars and the body that they stand on as one plate.

    They are unchanged where one of the three is not shown, or states its own look.
    """
    free = [body for body in parts if scene.style(body.name) == FREE_STYLE]
    bars = [body for body in free if len(body.joints) == 2]
    base = next((body for body in free if set(brace.on) <= set(body.joints)), None)
    sides = [next((bar for bar in bars if set(bar.joints) == {end, brace.name}), None) for end in brace.on]
    whole = [body for body in parts if body in (base, *sides)]
    if len(whole) < 3:
        return parts
    first = next((body for body in whole if body.name), whole[0])
    corners = tuple(dict.fromkeys(name for body in (first, *whole) for name in body.joints))
    names = tuple(name for body in whole for name in parts[body])
    plate = {body: (replace(body, joints=corners), names) for body in (first,)}
    return dict(
        plate.get(body, (body, of)) for body, of in parts.items() if body is first or body not in whole
    )
