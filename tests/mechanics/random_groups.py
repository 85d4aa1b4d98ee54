"""Random linkages that no chain of dyads finds, from points put down, and their motion in fifty digits.

As the points come first, each of them can be assembled. The check knows nothing of the solver: it closes the
bars by Newton's method in fifty digits from the pose that it is given, and its rates are those of the bars.
"""

from __future__ import annotations

import random
from collections.abc import Mapping
from typing import Any

import mpmath as mp

TRIAD = {
    "crank": "OA",
    "AB": "AB",
    "plate": "BCE",
    "CD": "CD",
    "EF": "EF",
}
STEPHENSON_III = {"crank": "OA", "AB": "AB", "plate": "BCD", "CP": "CP", "DE": "DE", "EQ": "EQ"}
BUTTERFLY = {
    "crank": "OCD",
    "CE": "CE",
    "EFG": "EFG",
    "BFJ": "BFJ",
    "DHI": "DHI",
    "GH": "GH",
    "IJ": "IJ",
}
STEPHENSON_II = {"crank": "OA", "AB": "ABC", "CD": "CD", "DEP": "DEP", "BE": "BE"}
FORMS: Mapping[str, tuple[dict[str, str], str]] = {
    "triad": (TRIAD, "ODF"),
    "double butterfly": (BUTTERFLY, "OB"),
}
"""The links of each form by their points, and its fixed points; the crank turns about O."""


def document(form: str, seed: int) -> dict[str, Any]:
    """Return a scene's document of a form, its points put down at random."""
    links, ground = FORMS[form]
    chance = random.Random(f"{form} {seed}")
    names = sorted({*"".join(links.values()), *ground})
    points = {name: [round(chance.uniform(0, 100), 2), round(chance.uniform(0, 100), 2)] for name in names}
    return {
        "length_unit": "mm",
        "points": points,
        "links": {"ground": [*ground], **{name: [*on] for name, on in links.items()}},
        "drive": {"joint": "O", "speed": "1 rad/s"},
    }


class Bars:
    """The bars of a linkage of points, in fifty digits: closed and differentiated for an angle of its crank.

    `crank` are the places of its points in its own frame, in floats.
    """

    def __init__(self, document: Mapping[str, Any], crank: Mapping[str, complex]) -> None:
        self.points = {name: mp.mpc(*place) for name, place in document["points"].items()}
        links = dict(document["links"])
        self.fixed = fixed = links.pop("ground")
        self.pivot = next(name for name in crank if name in fixed)
        own = {name: at - crank[self.pivot] for name, at in crank.items()}
        self.crank = {name: mp.mpc(at) for name, at in own.items() if name != self.pivot}
        self.free = [name for name in self.points if name not in fixed and name not in crank]
        pairs = []
        for name, on in links.items():
            if name != "crank":
                first, second, *others = on
                pairs += [(first, second), *((end, other) for other in others for end in (first, second))]
        self.pairs = pairs
        self.squares = [abs(self.points[p] - self.points[q]) ** 2 for p, q in pairs]

    def driven(self, angle: Any) -> tuple[dict[str, Any], dict[str, Any], dict[str, Any]]:
        """Return places, velocities and accelerations of what the crank carries, at 1 rad/s, and of pins."""
        pivot, turn = self.points[self.pivot], mp.expj(angle)
        places = {name: self.points[name] for name in self.fixed}
        places |= {name: pivot + at * turn for name, at in self.crank.items()}
        first = {name: 1j * (place - pivot) * (name in self.crank) for name, place in places.items()}
        second = {name: -(place - pivot) * (name in self.crank) for name, place in places.items()}
        return places, first, second

    def rows(self, places: Mapping[str, Any]) -> Any:
        """Return the derivatives of the squares of the bars by the free points' coordinates."""
        matrix = mp.zeros(len(self.pairs), 2 * len(self.free))
        for row, (p, q) in enumerate(self.pairs):
            way = places[p] - places[q]
            for name, sign in ((p, 1), (q, -1)):
                if name in self.free:
                    n = 2 * self.free.index(name)
                    matrix[row, n] += 2 * sign * way.real
                    matrix[row, n + 1] += 2 * sign * way.imag
        return matrix

    def closed(self, angle: Any, near: Mapping[str, Any]) -> tuple[dict[str, Any], Any]:
        """Return all places at an angle, on the closure near some places, and the derivatives' matrix."""
        places = {**self.driven(angle)[0], **{name: mp.mpc(*near[name]) for name in self.free}}
        for _ in range(12):
            squares = [abs(places[p] - places[q]) ** 2 for p, q in self.pairs]
            off = mp.matrix([one - other for one, other in zip(squares, self.squares, strict=True)])
            matrix = self.rows(places)
            step = mp.lu_solve(matrix, -off)
            for n, name in enumerate(self.free):
                places[name] += mp.mpc(step[2 * n], step[2 * n + 1])
            if mp.norm(step) < mp.mpf(10) ** -45:
                break
        return places, self.rows(places)

    def rates(
        self, angle: Any, places: Mapping[str, Any], matrix: Any
    ) -> tuple[dict[str, Any], dict[str, Any]]:
        """Return velocities and accelerations by the crank's angle."""
        _, known, bent = self.driven(angle)
        first = self._solved(matrix, places, known, {})
        second = self._solved(matrix, places, bent, first)
        return first, second

    def _solved(self, matrix: Any, places: Mapping[str, Any], known: Mapping[str, Any], before: Any) -> Any:
        right = []
        for p, q in self.pairs:
            way = places[p] - places[q]
            moved = known.get(p, 0) - known.get(q, 0)
            value = (mp.conj(way) * moved).real if moved else mp.mpf(0)
            if before:
                value += abs(before[p] - before[q]) ** 2
            right.append(-2 * value)
        step = mp.lu_solve(matrix, mp.matrix(right))
        found = dict(known)
        return found | {name: mp.mpc(step[2 * n], step[2 * n + 1]) for n, name in enumerate(self.free)}

    def limit(self, angle: Any, near: Mapping[str, Any]) -> Any:
        """Return the angle near `angle` at which the bars' matrix is singular, by Newton in fifty digits.

        The unknowns are the places, a direction in which they could move alone, and the angle.
        """
        places = {**self.driven(angle)[0], **{name: mp.mpc(*near[name]) for name in self.free}}
        count = 2 * len(self.free)
        matrix = self.rows(places)
        # by inverse iteration: the direction in which the matrix is least
        along = mp.matrix([mp.mpf(1) / (n + 1) for n in range(count)])
        for _ in range(4):
            along = mp.lu_solve(matrix.T * matrix + mp.eye(count) * mp.mpf(10) ** -40, along)
            along /= mp.norm(along)
        fixed = along.copy()
        for _ in range(30):
            known, rates, _ = self.driven(angle)
            places |= known
            matrix = self.rows(places)
            off = mp.matrix(2 * count + 1, 1)
            whole = mp.zeros(2 * count + 1)
            moving = {name: mp.mpc(along[2 * n], along[2 * n + 1]) for n, name in enumerate(self.free)}
            bent = self.rows({name: moving.get(name, mp.mpc(0)) for name in places})
            for row, ((p, q), square) in enumerate(zip(self.pairs, self.squares, strict=True)):
                way = places[p] - places[q]
                off[row] = abs(way) ** 2 - square
                drift = rates.get(p, mp.mpc(0)) - rates.get(q, mp.mpc(0))
                whole[row, 2 * count] = 2 * (mp.conj(way) * drift).real
                turn = moving.get(p, mp.mpc(0)) - moving.get(q, mp.mpc(0))
                whole[count + row, 2 * count] = 2 * (mp.conj(turn) * drift).real
                for n in range(count):
                    whole[row, n] = whole[count + row, count + n] = matrix[row, n]
                    whole[count + row, n] = bent[row, n]
            for n in range(count):
                off[count + n] = sum(matrix[n, k] * along[k] for k in range(count))
                whole[2 * count, count + n] = fixed[n]
            off[2 * count] = sum(fixed[k] * along[k] for k in range(count)) - 1
            step = mp.lu_solve(whole, -off)
            for n, name in enumerate(self.free):
                places[name] += mp.mpc(step[2 * n], step[2 * n + 1])
            for n in range(count):
                along[n] += step[count + n]
            angle += step[2 * count]
            if mp.norm(step) < mp.mpf(10) ** -40:
                break
        return angle
