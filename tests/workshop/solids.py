"""What is made, as solids that share no code with it: read from the JSON, placed by the solved motion."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import combinations
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray

from linkanim.scenes.scene import Scene
from linkanim.units import metre

_CORNERS = 96

Object = Mapping[str, Any]
Shapes = NDArray[np.object_]

AS_GOOD_AS_NONE = 1e-3
"""In mm²: what polygons overlap that stand for arcs which touch."""


class Solids:
    """The parts and pins of an object, each with its layers, at phases over the true period."""

    def __init__(self, scene: Scene, made: Object, phases: int) -> None:
        self.scene, self.made = scene, made
        self.scale = made["scale"] * 1000 * metre(scene.length_unit)
        self.cycle = scene.cycle(phases, derivatives=0)
        self.count = phases

    def joint(self, name: str) -> NDArray[np.complex128]:
        pairs = np.broadcast_to(self.cycle.position[name], (self.count, 2))
        found: NDArray[np.complex128] = self.scale * (pairs[:, 0] + 1j * pairs[:, 1])
        return found

    def frame(self, thing: Object) -> tuple[NDArray[np.complex128], NDArray[np.complex128]]:
        """Return where something's frame lies at each phase, and its direction."""
        origin = self.joint(thing["origin"]) if thing["origin"] else np.zeros(self.count, complex)
        way = np.full(self.count, np.exp(1j * thing["turned"]))
        if thing["towards"]:
            begin, end = map(self.joint, thing["towards"])
            way = way * (end - begin) / np.abs(end - begin)
        return origin, way

    def part(self, part: Object) -> Shapes:
        """Return a plate at each phase, without its holes, slots and other cuts."""
        origin, way = self.frame(part)

        def ring(points: NDArray[np.complex128]) -> Shapes:
            there = origin[:, None] + way[:, None] * points
            found: Shapes = shapely.linearrings(np.stack((there.real, there.imag), axis=-1))
            return found

        # As polygons around arcs, so that what just fits into them does.
        around = 1 / np.cos(np.pi / _CORNERS)
        cuts = [*(disc(complex(x, y), around * d / 2) for x, y, d in part["holes"])]
        cuts += [bar(complex(a, b), complex(c, d), around * wide / 2) for a, b, c, d, wide in part["slots"]]
        cuts += [np.array([complex(*point) for point in cut]) for cut in part["cuts"]]
        edge = ring(np.array([complex(*point) for point in part["outline"]]))
        if len(part["slots"]) < 2:
            found: Shapes = shapely.polygons(edge, np.stack([*map(ring, cuts)], axis=1) if cuts else None)
            return found
        solid: Shapes = shapely.polygons(edge)
        for cut in cuts:  # slots may cross
            solid = shapely.difference(solid, shapely.polygons(ring(cut)))
        return solid

    def round_(self, pin: Object, diameter: float) -> Shapes:
        """Return a disc about a pin at each phase, as a polygon in it."""
        origin, way = self.frame(pin)
        there = origin + way * complex(*pin["at"])
        points = there[:, None] + disc(0j, diameter / 2)
        found: Shapes = shapely.polygons(np.stack((points.real, points.imag), axis=-1))
        return found

    def layers(self) -> Iterator[tuple[int, dict[str, Shapes]]]:
        """Yield each layer with the solids in it, by their names."""
        plates = [*self.made["parts"], *self.made["fittings"]]
        parts = [(part["layer"], part["number"], self.part(part)) for part in plates]
        all_pins = [*self.made["pins"], *self.made["dowels"]]
        pins = [(pin, self.round_(pin, pin["diameter"])) for pin in all_pins]
        for layer in range(max(layer for layer, _, _ in parts) + 1):
            found = {f"part {number}": solid for own, number, solid in parts if own == layer}
            found |= {
                f"pin {pin['joint']}": solid for pin, solid in pins if pin["from"] <= layer <= pin["to"]
            }
            for pin, _ in pins:
                for own, diameter in pin["spacers"]:
                    if own == layer:
                        found[f"pin {pin['joint']}"] = self.round_(pin, diameter)
            yield layer, found

    def overlaps(self) -> Iterator[str]:
        """Yield what meets in a layer, and how much of it: nothing of what can turn."""
        for layer, solids in self.layers():
            for (one, shape), (other, second) in combinations(solids.items(), 2):
                met = shapely.intersects(shape, second)
                area = shapely.area(shapely.intersection(shape[met], second[met]))
                if met.any() and area.max() > AS_GOOD_AS_NONE:
                    at = float(self.cycle.phase[met][area.argmax()])
                    yield f"{one} and {other} in layer {layer}: {area.max():.3g} mm² at phase {at:.4f}"


def disc(at: complex, radius: float) -> NDArray[np.complex128]:
    found: NDArray[np.complex128] = at + radius * np.exp(2j * np.pi * np.arange(_CORNERS) / _CORNERS)
    return found


def bar(begin: complex, end: complex, radius: float) -> NDArray[np.complex128]:
    """Return the edge of what reaches from one place to another with round ends."""
    way = (end - begin) / abs(end - begin)
    half = np.exp(1j * np.pi * (np.arange(_CORNERS // 2 + 1) / (_CORNERS // 2) - 0.5))
    return np.concatenate((end + radius * way * half, begin - radius * way * half))
