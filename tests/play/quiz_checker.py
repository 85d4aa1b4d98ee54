"""Questions held against a motion worked out anew, to fifty digits: nothing is shared with what made them.

A question is read by its own words. Its key must be right, every other answer wrong, none may be about what
rests or ties, the numbers of its reason must be those of the motion, and a wrong answer may be told to come
from a misconception only where that, carried out, gives this answer.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cached_property, partial
from itertools import combinations, pairwise
from math import degrees, isclose, pi, radians
from typing import Any

import numpy as np
from exact_motion import SAMPLES, ExactMotion
from mpmath import mp

from linkanim.mechanics.linkage import (
    RPR,
    RRP,
    RRR,
    Body,
    Crank,
    Cylinder,
    Damper,
    Joint,
    Slide,
    Spring,
    Travel,
)
from linkanim.play.question import QuizAnswer, QuizQuestion
from linkanim.scenes.scene import FunctionPurpose, PosesPurpose

REST = 1e-12
"""A rate that is a smaller share of what the input's speed would give the longest length is no rate."""
SEEN = 0.05
"""A rate that is a smaller share of its greatest is hardly seen."""
SAME = 1e-3
"""Numbers that are told to four digits are off by less."""
WAYS = {"to the right": 1, "up": 1j, "to the left": -1, "down": -1j}
FACTORS = {"as large as before": 1, "twice as large": 2, "four times as large": 4, "eight times as large": 8}
AT_LIMIT: dict[type[Joint], str] = {
    RRR: "lie in one line",
    RRP: "stands straight across",
    RPR: "offset of the slot",
}
"""How a dyad stands where it closes no farther, in a question's words."""


def faults(question: QuizQuestion, motion: ExactMotion) -> list[str]:
    """Return a sentence for everything that is not as it is said; none for a question that holds."""
    return [f"{question.question_id}: {fault}" for fault in Checked(question, motion).faults()]


@dataclass(frozen=True)
class Checked:
    """A question beside the motion of its scene."""

    question: QuizQuestion
    motion: ExactMotion

    @cached_property
    def right(self) -> QuizAnswer:
        return self.question.answers[self.question.right]

    @cached_property
    def wrong(self) -> list[QuizAnswer]:
        return [one for n, one in enumerate(self.question.answers) if n != self.question.right]

    @property
    def phase(self) -> float:
        return self.question.phase

    @cached_property
    def bodies(self) -> dict[str, Body]:
        return {body.name: body for body in self.question.scene.linkage.bodies}

    def faults(self) -> Iterator[str]:
        texts = [one.text for one in self.question.answers]
        if len(set(texts)) != len(texts) or len(texts) < 2:
            yield f"its answers are {texts}"
        if self.right.slip:
            yield f"the right answer is told to be {self.right.slip!r}"
        drawn = [(one.place is None, not one.curve) for one in self.question.answers]
        if len(set(drawn)) != 1:
            yield f"some of its answers are drawn: {drawn}"
        yield from KEYS[self.question.kind](self)
        yield from self.reasons()
        for answer in self.wrong:
            if answer.slip and not self._from(answer):
                yield f"{answer.text!r} does not come of {answer.slip!r}"

    def _from(self, answer: QuizAnswer) -> bool:
        """Return whether a wrong answer is what its misconception, carried out, gives."""
        for pattern, gives in MISCONCEPTIONS[self.question.kind].items():
            if found := re.fullmatch(pattern, answer.slip):
                return gives(self, answer, *found.groups())
        return False

    # what is at rest

    def clear(self, value: complex, *, lengths: int = 1, rates: int = 1) -> bool:
        """Return whether a rate is none of rounding."""
        return abs(value) > REST * self.motion.size**lengths * abs(self.motion.speed) ** rates

    def velocity(self, joint: str) -> complex:
        return self.motion.velocity(joint, self.phase)

    def acceleration(self, joint: str) -> complex:
        return self.motion.acceleration(joint, self.phase)

    def place(self, joint: str) -> complex:
        return complex(self.motion.at(self.phase)[joint])

    # the keys, kind by kind

    def turning(self) -> Iterator[str]:
        rate = self.motion.body_rate(self.bodies[self.question.subject], self.phase)
        if not self.clear(rate, lengths=0):
            yield f"it is about what does not turn: {rate} rad/s"
        elif self.right.text != ("counterclockwise" if rate > 0 else "clockwise"):
            yield f"it turns with {rate} rad/s"
        elif abs(rate) < SEEN * self.motion.quickest(self.bodies[self.question.subject]):
            yield f"it hardly turns: {rate} rad/s"
        yield from self.told(r"(\S+) rad/s", abs(rate))

    def fastest(self) -> Iterator[str]:
        speeds = {one.text: abs(self.velocity(one.text)) for one in self.question.answers}
        order = sorted(speeds.values())
        if any(not self.clear(speed) for speed in order):
            yield f"it is about what rests: {speeds}"
        if any(high - low < 0.02 * order[-1] for low, high in pairwise(order)):
            yield f"two are as fast: {speeds}"
        if self.right.text != max(speeds, key=lambda name: speeds[name]):
            yield f"the speeds are {speeds}"
        for name, speed in speeds.items():
            yield from self.told(rf"\b{re.escape(name)} (\S+) \S+/s", speed)

    def heading(self) -> Iterator[str]:
        velocity = self.velocity(self.question.subject)
        if not self.clear(velocity):
            yield f"it is about what rests: {velocity}"
        elif self.apart(velocity, WAYS[self.right.text]) > 31:
            yield f"it moves with {velocity}"
        joint = self.question.scene.linkage.joint(self.question.subject)
        if any(slide.start is None for slide in joint.slides if slide.point == joint.name):
            answers = [WAYS[one.text] for one in self.question.answers]
            if len(answers) != 2 or answers[0] != -answers[1]:
                yield "its guide has two ways only"
        yield from self.told(r" at (\S+) \S+/s", abs(velocity))

    @staticmethod
    def apart(one: complex, other: complex) -> float:
        """Return the angle between two directions, in degrees."""
        return abs(degrees(float(np.angle(one / other))))

    def speeding(self) -> Iterator[str]:
        velocity, acceleration = (
            self.velocity(self.question.subject),
            self.acceleration(self.question.subject),
        )
        along = (velocity.conjugate() * acceleration).real / abs(velocity)
        if not self.clear(velocity) or not self.clear(along, rates=2):
            yield f"it is about what rests, or runs evenly: {velocity}, {along}"
        elif self.right.text != ("it speeds up" if along > 0 else "it slows down"):
            yield f"its acceleration along its velocity is {along}"
        elif abs(along) < SEEN * abs(acceleration):
            yield f"it hardly changes its speed: {along} of {abs(acceleration)}"
        yield from self.told(r"(\S+) \S+/s²", along)

    def doubled(self) -> Iterator[str]:
        joint, kind = self.question.subject.rsplit(".", 1)
        value = self.velocity(joint) if kind == "velocity" else self.acceleration(joint)
        if not self.clear(value, rates=1 if kind == "velocity" else 2):
            yield f"it is about what rests: {value}"
        yield from self.grows({"velocity": 2, "acceleration": 4}[kind], abs(value))

    def force(self) -> Iterator[str]:
        linkage = self.question.scene.linkage
        items: tuple[Spring | Damper, ...] = (*linkage.springs, *linkage.dampers)
        struts = {item.name: item for item in items}
        strut = struts.get(self.question.subject)
        if strut is None:
            value = self.acceleration(self.question.subject.rsplit(".", 1)[0])
            if not self.clear(value, rates=2):
                yield f"it is about what is not accelerated: {value}"
            yield from self.grows(4, None)
        else:
            yield from self.grows(1 if isinstance(strut, Spring) else 2, self.pull(strut))

    def pull(self, strut: Spring | Damper) -> float:
        """Return how large the force of a spring or damper is, in N; 0 where it is but rounding."""
        one, other = strut.between
        metre = self.question.scene.linkage.metre
        here = self.motion.at(self.phase)
        if isinstance(strut, Spring):
            assert strut.stiffness is not None
            assert strut.free_length is not None
            longer = float(abs(here[other] - here[one]) - strut.free_length)
            return abs(strut.stiffness * metre * longer) if abs(longer) > REST * self.motion.size else 0.0
        rate = float(self.motion.rate(lambda at: abs(at[other] - at[one]), self.phase))
        assert strut.coefficient is not None
        return abs(strut.coefficient * metre * rate) if self.clear(rate) else 0.0

    def grows(self, factor: int, value: float | None) -> Iterator[str]:
        if value == 0:
            yield "it is about a force that is none"
        if FACTORS[self.right.text] != factor:
            yield f"it becomes {factor} times as large"
        if value is not None:
            yield from self.told(r"([−\d.e]+)(?: N)? becomes", value)
            yield from self.told(r"becomes (\S+) ", factor * value)
            yield from self.told(r"stays (\S+) ", factor * value)

    def instant_centre(self) -> Iterator[str]:
        body = self.bodies[self.question.subject]
        rate = self.motion.body_rate(body, self.phase)
        if not self.clear(rate, lengths=0):
            yield f"it does not turn: {rate}"
            return
        pole, size = self.pole(body), self.motion.size
        places = [complex(*one.place) for one in self.question.answers if one.place]
        if len(places) != len(self.question.answers) or any(
            abs(one - other) < 0.01 * size for one, other in combinations(places, 2)
        ):
            yield f"its places are {places}"
        if not self.right.place or abs(complex(*self.right.place) - pole) > 1e-6 * size:
            yield f"the pole is {pole}"
        for one in self.question.answers:
            x, y = (number(word) for word in re.findall(r"[−\d.e]+", one.text)[:2])
            if one.place and abs(complex(x, y) - complex(*one.place)) > 2 * SAME * max(
                size, abs(complex(x, y))
            ):
                yield f"{one.text} is not at {one.place}"

    def pole(self, body: Body) -> complex:
        """Return the point of a body's plane that stands still."""
        rate = self.motion.body_rate(body, self.phase)
        return self.place(body.joints[0]) + 1j * self.velocity(body.joints[0]) / rate

    def dead_centre(self) -> Iterator[str]:
        for one in self.question.answers:
            rates = self.around(float(one.text.rstrip("°")))
            if not all(self.clear(rate, lengths=bool(self.output.slider)) for rate in rates):
                yield f"it rests at {one.text}: {rates}"
            elif (rates[0] * rates[1] < 0) != (one is self.right):
                yield f"at {one.text} its rates are {rates}"
        angles = re.findall(r"[\d.]+(?=°)", self.question.why)
        if not angles:
            yield "its reason tells no angle"
        for angle in angles:
            rates = self.around(number(angle))
            if rates[0] * rates[1] >= 0:
                yield f"its reason has it turn back at {angle}°"

    def around(self, angle: float, reach: float = 0.1) -> tuple[float, float]:
        """Return the output's rates a little before and after a crank angle in degrees."""
        first, last = (
            self.motion.body_rate(
                self.output, radians(angle + part) - self.question.scene.linkage.drive.start
            )
            for part in (-reach, reach)
        )
        return first, last

    @property
    def output(self) -> Body:
        """The body that a question about the output is about."""
        return self.bodies[self.question.subject.split(".")[0]]

    def input_range(self) -> Iterator[str]:
        swings = {one.text: swing_of(one.text) for one in self.question.answers}
        if sum(found is None for found in swings.values()) != 1:
            yield f"not one of {[*swings]} is a full turn"
        own = self.own_range()
        found = swings.pop(self.right.text)
        if (own is None) != (found is None) or (own and found and not near(own, found, 0.051)):
            yield f"it goes over {own}"
        for text, other in swings.items():
            if own and other and near(own, other, 2.0, turns=True):
                yield f"{text} is as good as {own}"
        if own is not None:
            yield from self.ended()
        elif said := re.search(r"less than ([\d.]+)°", self.question.why):
            least = self.least_transmission()
            if not number(said[1]) - 1e-9 <= least < number(said[1]) + 1:
                yield f"its reason says {said[1]} of {least}"
        elif said := re.search(r"the shortest link is the (.*): (both)?", self.question.why):
            links = self.four_bar()
            if min(links, key=lambda part: links[part]) != said[1] or bool(said[2]) != (said[1] == "ground"):
                yield f"its reason says {said[1]} of {links}"

    def least_transmission(self) -> float:
        """Return the least angle between two bars, or a bar and its guide's normal, in degrees."""
        period = self.question.scene.period
        found = []
        for phase in np.arange(SAMPLES) * (period / SAMPLES):
            at = self.motion.at(float(phase))
            found += [
                angle for joint in self.question.scene.linkage.joints for angle in transmission(joint, at)
            ]
        return degrees(min(found))

    def own_range(self) -> tuple[float, float] | None:
        """Return the input's range in degrees; None where every dyad closes all the way round."""
        motion = self.motion
        if motion.turns_fully:
            scene = self.question.scene
            worst = min(
                share
                for phase in np.arange(72) * (scene.period / 72)
                for share in (
                    0,
                    *motion.discriminants(motion.coordinate(phase), motion.signs(phase)).values(),
                )
            )
            return None if worst > -1e-12 else (0.0, 0.0)
        low, high = (degrees(end.coordinate) for end in motion.ends)
        return low, high

    def ended(self) -> Iterator[str]:
        """Yield what is wrong in the reason why an input ends."""
        why, stated = self.question.why, isinstance(self.question.scene.linkage.drive.actuator, Cylinder)
        yield from self.misnamed(why)
        if ("stroke" in why) != stated:
            yield "its reason tells of a stroke" if not stated else "its reason tells of no stroke"
        for kind in self.at_limit:
            if AT_LIMIT[kind] not in why and not stated:
                yield f"its reason does not tell of the {kind.__name__} at its limit"

    def misnamed(self, words: str) -> Iterator[str]:
        """Yield the kinds of dyads that words have at their limits, and that are not."""
        for kind, said in AT_LIMIT.items():
            if said in words and kind not in self.at_limit:
                yield f"there is no {kind.__name__} at its limit"

    @cached_property
    def at_limit(self) -> set[type[Joint]]:
        """The kinds of the dyads that close no farther at an end of the input."""
        linkage = self.question.scene.linkage
        return {type(linkage.joint(name)) for end in self.motion.ends for name in end.dyads}

    def closure(self) -> Iterator[str]:
        """At a limit of a dyad that runs on through it, the input comes back on the other closure."""
        retraced = self.question.scene.linkage.drive.retraced
        if ("No velocity jumps" in self.question.text) == retraced:
            yield "the scene says how it returns, the question says otherwise"
        if ("change their sign" in self.question.text) != retraced:
            yield "the question does not say how it returns"
        if not any(end.dyads for end in self.motion.ends):
            yield "no dyad is at its limit"
        yield from self.misnamed(self.question.text)
        for name, before, after in self.closures():
            if (before == after) == ("other" in self.right.text):
                yield f"{name} goes from closure {before} to {after}"

    def closures(self) -> Iterator[tuple[str, int, int]]:
        """Yield each dyad at a limit with its closures before and after it."""
        for phase, end in zip((0.0, pi), self.ends_by_phase(), strict=True):
            before, after = (self.motion.signs(phase + part) for part in (-0.01, 0.01))
            yield from ((name, before[name], after[name]) for name in end.dyads)

    def ends_by_phase(self) -> list[Any]:
        low, high = self.motion.ends
        forward = self.motion.coordinate(0.0) < self.motion.coordinate(pi)
        return [low, high] if forward else [high, low]

    def grashof(self) -> Iterator[str]:
        links = self.links()
        yield from self.lengths_told(links)
        s, p, q, longest = sorted(links.values())
        gap = (s + longest - p - q) / longest
        relation = "=" if abs(gap) < 1e-9 else "<" if gap < 0 else ">"
        if 1e-9 < abs(gap) < 0.01:
            yield f"s + l and p + q are as good as equal: {gap}"
        if not re.search(rf"s \+ l {relation} p \+ q", self.right.text):
            yield f"s + l {relation} p + q"
        sums = [number(word) for word in re.findall(r"\d[\d.]*", self.question.why)[:4]]
        if not near(sums, (s, longest, p, q), SAME * longest) and not near(
            sums, (s, longest, q, p), SAME * longest
        ):
            yield f"its reason has the sums {sums}"
        elif (sums[0] + sums[1] > sums[2] + sums[3], sums[0] + sums[1] < sums[2] + sums[3]) != (
            relation == ">",
            relation == "<",
        ):
            yield f"its reason's sums {sums} do not show {relation}"

    def four_bar(self) -> dict[str, float]:
        """Return the lengths of the one four-bar that there is."""
        (dyad,) = (joint.name for joint in self.question.scene.linkage.joints if joint.dyad)
        return self.links(dyad)

    def links(self, dyad: str = "") -> dict[str, float]:
        """Return the lengths of the four-bar that the input drives, from where its joints lie."""
        linkage = self.question.scene.linkage
        crank, joint = linkage.joint(linkage.drive.joint), linkage.joint(dyad or self.question.subject)
        assert isinstance(crank, Crank)
        assert isinstance(joint, RRR)
        (pin,) = (end for end in joint.ends if end != crank.name)
        here = self.motion.at(self.phase)
        ends = {
            "ground": (crank.pivot, pin),
            "input": (crank.pivot, crank.name),
            "coupler": (crank.name, joint.name),
            "output": (pin, joint.name),
        }
        return {part: float(abs(here[one] - here[other])) for part, (one, other) in ends.items()}

    def lengths_told(self, links: dict[str, float]) -> Iterator[str]:
        for part, length in links.items():
            found = re.search(rf"{part} ([\d.]+)|([\d.]+) \({part}\)", self.question.text)
            if not found or not isclose(number(found[1] or found[2]), length, rel_tol=SAME):
                yield f"the {part} is {length} long"

    def grashof_sum(self) -> Iterator[str]:
        links = self.links()
        yield from self.lengths_told(links)
        misplaced = self.misplaced(links)
        if len(misplaced) != 2:
            yield f"in a wrong place are {misplaced}"
        if [one.text in misplaced for one in self.question.answers].count(True) != 1:
            yield f"of its answers {misplaced} are in a wrong place"
        if self.right.text not in misplaced:
            yield f"in a wrong place are {misplaced}"

    def written(self) -> list[str]:
        """Return the links as they stand in the sum: s, l, p, q."""
        return re.findall(r"\((\w+)\)", self.question.text)

    def misplaced(self, links: dict[str, float]) -> list[str]:
        s, p, q, longest = sorted(links, key=lambda part: links[part])
        places = zip(self.written(), ({s}, {longest}, {p, q}, {p, q}), strict=True)
        return [part for part, own in places if part not in own]

    def curves(self) -> Iterator[str]:
        _, _, token = self.question.subject.partition(".")
        wanted = 1 if token.endswith("velocity") else 2
        for one in self.question.answers:
            order = self.order_of(one)
            if (order == wanted) != (one is self.right):
                yield f"{one.text} is of order {order}"

    def order_of(self, answer: QuizAnswer) -> int | None:
        """Return whether a curve is the output's place, 0, its velocity or its acceleration; None: no one."""
        own, given = self.own_curves, np.array(answer.curve)
        if len(given) != len(own[0]):
            return None
        apart = [float(np.abs(given - curve).max()) for curve in own]
        return int(np.argmin(apart)) if min(apart) < 0.02 else None

    @cached_property
    def own_curves(self) -> list[Any]:
        """The output's place, velocity and acceleration as time goes, each at most 1 in size."""
        body, scene, count = self.output, self.question.scene, len(self.right.curve)
        phases = [n * scene.period / count for n in range(count)]
        if scene.linkage.drive.speed < 0:
            phases.reverse()
        rates = [self.motion.body_rate(body, phase) for phase in phases]
        seconds = [self.motion.body_rate(body, phase, 2) for phase in phases]
        if max(map(abs, rates)) < REST * abs(self.motion.speed):
            return [np.full(count, np.nan)] * 3
        places = self.places(body, phases)
        return [part / np.abs(part).max() for part in (places, np.array(rates), np.array(seconds))]

    def places(self, body: Body, phases: list[float]) -> Any:
        """Return a body's angles, without jumps, or how far it has travelled; about their middle."""
        with mp.workdps(30):
            poses = [self.motion.at(phase) for phase in phases]
            if body.slider:
                found = np.array([float(self.motion.travel(body.slider, at)) for at in poses])
            else:
                first, second = body.joints[:2]
                found = np.unwrap([float(mp.arg(at[second] - at[first])) for at in poses])
        return found - (found.max() + found.min()) / 2

    def coriolis(self) -> Iterator[str]:
        if self.question.scene.linkage.joint(self.question.subject).fixed:
            yield "a fixed pin has no acceleration"
        terms = [term for _, term in self.coriolis_terms()]
        if (
            not terms
            or len({abs(term) > REST * self.motion.size * self.motion.speed**2 for term in terms}) > 1
        ):
            yield f"it does not say which guide is meant: {terms}"
        elif (self.right.text == "yes") != self.clear(terms[0], rates=2):
            yield f"the term is {terms[0]}"

    def coriolis_terms(self) -> Iterator[tuple[float, float]]:
        """Yield for each guide that the question may mean how fast it turns, and 2ωv."""
        point = self.question.subject
        for joint in self.question.scene.linkage.joints:
            for slide in (one for one in joint.slides if one.point == point):
                if not self.is_meant(slide):
                    continue
                turning = self.motion.turning(slide.axis, self.phase) if slide.axis else 0.0
                start = slide.start or slide.line.through
                yield turning, 2 * turning * self.sliding(start, point, turning)

    def is_meant(self, slide: Slide) -> bool:
        """Return whether the question's words for a guide are those of this one."""
        words = self.question.text
        if "a fixed line" in words:
            return slide.start is None
        if f"the slot at {slide.start}" in words:
            return slide.axis is None
        axis = set(slide.axis) if slide.axis else set()
        bodies = (body for body in self.bodies.values() if axis and axis <= {*body.joints})
        return any(f"along {name}." in words for body in bodies for name in self.called(body))

    def called(self, body: Body) -> tuple[str, ...]:
        """Return the words that may stand for a body."""
        word = self.question.scene.info.link_names[body.name]
        return f"the {word}", f"the {word} ({body.name})", f"the {word} link", f"link {word}"

    def sliding(self, start: str, point: str, turning: float) -> float:
        """Return how fast a point goes, seen from the plane of a joint that turns so."""
        arm = self.place(point) - self.place(start)
        return abs(self.velocity(point) - self.velocity(start) - 1j * turning * arm)

    # what reasons tell

    def reasons(self) -> Iterator[str]:
        """Yield what is wrong in the places, ways, ratios and bars that a reason names."""
        why = self.question.why
        for second, side, first, way in re.findall(
            r"(\S+) lies (above|below|to the left of|to the right of) (\S+) and moves (.+?):", why
        ):
            yield from self.beside(self.place(second) - self.place(first), side)
            yield from self.towards(self.velocity(second) - self.velocity(first), way)
        for first, second, side, way in re.findall(
            r"Seen from (\S+), (\S+) lies (above|below|on the left|on the right) and moves (.+?):", why
        ):
            yield from self.beside(self.place(second) - self.place(first), side)
            yield from self.towards(self.velocity(second) - self.velocity(first), way)
        for turns, about, side in re.findall(
            r"It turns (\w+) about (.+) and lies (above|below|to the left of|to the right of) it", why
        ):
            yield from self.about(turns, about, side)
        for one, other, _, times in re.findall(
            r"(\S+) and (\S+) turn with the same ω about (.+), and \1 is ([\d.]+) times", why
        ):
            ratio = abs(self.velocity(one)) / abs(self.velocity(other))
            if not isclose(ratio, number(times), rel_tol=SAME, abs_tol=0.006):
                yield f"its reason says {times} of {ratio}"
        for end, joint, what in re.findall(r"moves the bar (\S+)–(\S+) .*: it (pushes|pulls)", why):
            arm = self.place(joint) - self.place(end)
            if ((arm.conjugate() * self.velocity(end)).real > 0) != (what == "pushes"):
                yield f"its reason has {end} {what} {joint}"
        for a, b, c, d in re.findall(r"there (\S+)–(\S+) and (\S+)–(\S+) lie in one line", why):
            yield from self.in_line((a, b), (c, d))

    def beside(self, arm: complex, side: str) -> Iterator[str]:
        ways = {"above": 1j, "below": -1j, "left": -1, "right": 1}
        word = next(word for word in ways if word in side)
        if self.apart(arm, ways[word]) > 45.1:
            yield f"its reason says {side} of {arm}"

    def towards(self, velocity: complex, way: str) -> Iterator[str]:
        if self.apart(velocity, WAYS[way]) > 45.1:
            yield f"its reason has {velocity} go {way}"

    def about(self, turns: str, about: str, side: str) -> Iterator[str]:
        """Yield that a point does not turn so about a pin, or about the instant centre of its link."""
        subject, pins = self.question.subject, {pin.name for pin in self.question.scene.linkage.pins}
        arms = [self.place(subject) - self.place(about)] if about in pins else []
        if not arms:
            bodies = [
                body
                for body in self.bodies.values()
                if body.joints and about in {f"the instant centre of {name}" for name in self.called(body)}
            ]
            arms = [self.place(subject) - self.pole(body) for body in bodies]
        velocity = self.velocity(subject)
        across = [arm for arm in arms if abs(self.apart(velocity, arm) - 90) < 0.1]
        if not across or ((across[0].conjugate() * velocity).imag > 0) != (turns == "counterclockwise"):
            yield f"its reason has it turn {turns} about {about}"
        else:
            yield from self.beside(across[0], side)

    def in_line(self, bar: tuple[str, str], other: tuple[str, str]) -> Iterator[str]:
        for angle in re.findall(r"[\d.]+(?=°)", self.question.why):
            at = self.motion.at(radians(number(angle)) - self.question.scene.linkage.drive.start)
            turn = complex((at[bar[1]] - at[bar[0]]) / (at[other[1]] - at[other[0]]))
            if abs(turn.imag) > 0.01 * abs(turn):
                yield f"at {angle}° its bars are not in one line"

    # how a linkage was made

    def slow_way(self) -> Iterator[str]:
        """The crank's way between the output's dead centres, the longer one, as the motion has it."""
        slow = degrees(max(self.ways_of_output()))
        for one in self.question.answers:
            if (abs(number(one.text) - slow) < 0.3) != (one is self.right):
                yield f"{one.text} of a slow way of {slow}"
        told = [number(word) for word in re.findall(r"[\d.]+(?=°)", self.question.why)]
        if not told or abs(told[0] - slow) > 0.3 or abs(sum(told) - 360) > 0.2:
            yield f"its reason says {told}"

    def ways_of_output(self) -> tuple[float, float]:
        """Return how far the crank turns on each way of the output, in radians, from near-by poses."""
        motion = self.question.scene.cycle(3600, derivatives=0)
        phases, ends = motion.phase, motion.position["B"] @ np.array([1, 1j])
        pins = [pin.position for pin in self.question.scene.linkage.pins if pin.name == "O4"]
        along = np.unwrap(np.angle(ends - complex(*pins[0]))) if pins else ends.real
        between = abs(float(phases[along.argmax()] - phases[along.argmin()]))
        return between, 2 * pi - between

    def precision_point(self) -> Iterator[str]:
        """The output is where its scale has y at the right answer alone."""
        purpose = self.question.scene.purpose
        assert isinstance(purpose, FunctionPurpose)
        for one in self.question.answers:
            x = number(one.text.removeprefix("x = "))
            exact = [n for n, known in enumerate(purpose.x) if isclose(x, known, rel_tol=SAME, abs_tol=1e-9)]
            if bool(exact) != (one is self.right):
                yield f"{one.text} of {purpose.x}"
            for n in exact:
                motion = self.question.scene.solve(angle=purpose.input[n], derivatives=0)
                sliding = "slider" in self.bodies
                place = motion.travel["slider"] if sliding else motion.angle["rocker"]
                off = float(place) - purpose.output[n]
                if abs(off - (0 if sliding else 2 * pi * round(off / (2 * pi)))) > 1e-9 * self.motion.size:
                    yield f"the output is {off} off"
        listed = self.question.why.partition(";")[0].removeprefix("Its precision points are ")
        told = [number(word.removeprefix("x = ")) for word in re.split(", | and ", listed)]
        if len(told) != len(purpose.x) or not np.allclose(told, purpose.x, rtol=SAME, atol=1e-9):
            yield f"its reason lists {listed} of {purpose.x}"

    @cached_property
    def two_poses(self) -> tuple[complex, complex, complex]:
        """The places of the two poses of a question, and the turn between them as a unit number."""
        found = re.findall(r"\((\S+), (\S+)\) \S+, turned by (\S+),", self.question.text)
        (x, y, first), (u, v, second) = ([number(word) for word in pose] for pose in found)
        return complex(x, y), complex(u, v), complex(np.exp(1j * radians(second - first)))

    @staticmethod
    def told_place(answer: QuizAnswer) -> complex:
        x, y = (number(word) for word in re.findall(r"[−\d.e]+", answer.text)[:2])
        return complex(x, y)

    def near(self, answer: QuizAnswer, place: complex) -> bool:
        one, other, _ = self.two_poses
        return abs(self.told_place(answer) - place) < 0.01 * abs(other - one)

    def pole_of_poses(self) -> Iterator[str]:
        """A turn about the right answer alone takes the one pose to the other."""
        one, other, turn = self.two_poses
        for answer in self.question.answers:
            place = self.told_place(answer)
            off = abs(place + turn * (one - place) - other)
            if (off < 0.01 * abs(other - one)) != (answer is self.right):
                yield f"a turn about {answer.text} is {off} off"
        away = abs(self.told_place(self.right) - (one + other) / 2)
        yield from self.told(r"way between both places, (\S+) ", away)

    def other_way_round_about(self, answer: QuizAnswer) -> bool:
        one, other, turn = self.two_poses
        return self.near(answer, (other - turn.conjugate() * one) / (1 - turn.conjugate()))

    def middle_of_way(self, answer: QuizAnswer) -> bool:
        one, other, _ = self.two_poses
        return self.near(answer, (one + other) / 2)

    def pole_of_others(self, answer: QuizAnswer, first: str, second: str) -> bool:
        purpose = self.question.scene.purpose
        assert isinstance(purpose, PosesPurpose)
        (x, y, start), (u, v, end) = (purpose.poses[int(n) - 1] for n in (first, second))
        turn = np.exp(1j * (end - start))
        return self.near(answer, complex((complex(u, v) - turn * complex(x, y)) / (1 - turn)))

    def slow_told_as(self, answer: QuizAnswer, share: Callable[[float], float]) -> bool:
        slow = degrees(max(self.ways_of_output()))
        return abs(number(answer.text) - share(slow)) < 0.5

    def between_points(self, answer: QuizAnswer) -> bool:
        purpose = self.question.scene.purpose
        assert isinstance(purpose, FunctionPurpose)
        x = number(answer.text.removeprefix("x = "))
        return any(isclose(x, (low + high) / 2, rel_tol=SAME) for low, high in pairwise(purpose.x))

    # numbers that are told

    def told(self, pattern: str, value: float) -> Iterator[str]:
        """Yield that a number of the reason is not so; nothing where the reason does not have it."""
        found = re.search(pattern, self.question.why)
        if found and not isclose(number(found[1]), value, rel_tol=SAME if abs(value) > 0.1 else 5 * SAME):
            yield f"its reason says {found[1]} of {value}"

    # the misconceptions, carried out

    def input_way(self, answer: QuizAnswer) -> bool:
        """The input's own direction."""
        at = self.motion.coordinate
        forward = (at(self.phase + 1e-6) - at(self.phase - 1e-6)) * self.motion.speed > 0
        return self.question.scene.linkage.drive.coordinate.is_angle and answer.text == (
            "counterclockwise" if forward else "clockwise"
        )

    def backwards(self, answer: QuizAnswer) -> bool:
        """The opposite of what it does."""
        if self.question.kind == "heading":
            return WAYS[answer.text] == -WAYS[self.right.text]
        return {answer.text, self.right.text} == {"clockwise", "counterclockwise"}

    def input_joint(self, answer: QuizAnswer) -> bool:
        return answer.text == self.question.scene.linkage.drive.joint

    def farthest(self, answer: QuizAnswer, pivot: str) -> bool:
        """The farthest of all answers from the crank's pivot."""
        crank = self.question.scene.linkage.joint(self.question.scene.linkage.drive.joint)
        if not isinstance(crank, Crank) or pivot != crank.pivot:
            return False
        away = {
            one.text: abs(self.place(one.text) - self.place(crank.pivot)) for one in self.question.answers
        }
        return answer.text == max(away, key=lambda name: away[name])

    def as_accelerated(self, answer: QuizAnswer) -> bool:
        acceleration = self.acceleration(self.question.subject)
        return self.clear(acceleration, rates=2) and self.apart(acceleration, WAYS[answer.text]) < 45

    def along_link(self, answer: QuizAnswer) -> bool:
        """The way along a link that turns about a fixed pin, to the pin or from it."""
        subject = self.question.subject
        for pin in self.question.scene.linkage.pins:
            poses = [self.motion.at(self.phase + part) for part in (0.0, -0.4, 0.3)]
            lengths = [float(abs(at[subject] - at[pin.name])) for at in poses]
            arm = self.place(subject) - self.place(pin.name)
            if arm and max(lengths) - min(lengths) < 1e-12 * lengths[0]:
                return min(self.apart(arm, WAYS[answer.text] * sign) for sign in (1, -1)) < 45
        return False

    def sign_alone(self, answer: QuizAnswer) -> bool:
        """Speeding up where the larger part of the acceleration is to the right or up."""
        acceleration = self.acceleration(self.question.subject)
        x, y = acceleration.real, acceleration.imag
        larger = x if abs(x) > abs(y) else y
        return answer.text == ("it speeds up" if larger > 0 else "it slows down")

    def with_power(self, answer: QuizAnswer, what: str) -> bool:
        powers = {
            "a spring's force": 1,
            "a velocity or a damper's force": 2,
            "an acceleration": 4,
            "the power that accelerates a mass": 8,
        }
        return FACTORS[answer.text] == powers[what]

    def middle_of_link(self, answer: QuizAnswer) -> bool:
        first, second = self.coupler_ends
        return self.lies(answer, (first + second) / 2)

    def nearer_joint(self, answer: QuizAnswer) -> bool:
        pole = self.pole(self.bodies[self.question.subject])
        return self.lies(answer, min(self.coupler_ends, key=lambda end: abs(end - pole)))

    def moving_joint(self, answer: QuizAnswer) -> bool:
        return any(
            self.lies(answer, self.place(joint.name)) and self.clear(self.velocity(joint.name))
            for joint in self.question.scene.linkage.joints
        )

    def fixed_pin(self, answer: QuizAnswer) -> bool:
        return any(self.lies(answer, self.place(pin.name)) for pin in self.question.scene.linkage.pins)

    @property
    def coupler_ends(self) -> tuple[complex, complex]:
        first, second = self.bodies[self.question.subject].joints[:2]
        return self.place(first), self.place(second)

    def lies(self, answer: QuizAnswer, place: complex) -> bool:
        return answer.place is not None and abs(complex(*answer.place) - place) < 1e-6 * self.motion.size

    def quickest(self, answer: QuizAnswer) -> bool:
        """The crank angle at which the output is fastest."""
        scene = self.question.scene
        at = radians(float(answer.text.rstrip("°"))) - scene.linkage.drive.start
        return abs(self.motion.body_rate(self.output, at)) >= self.motion.quickest(self.output) * (1 - SAME)

    def half_turn_on(self, answer: QuizAnswer) -> bool:
        """Half a turn from a dead centre."""
        rates = self.around(float(answer.text.rstrip("°")) + 180)
        return rates[0] * rates[1] < 0

    def still_closes(self, answer: QuizAnswer) -> bool:
        """A limit that is none: the input goes through both of its ends."""
        swing = swing_of(answer.text)
        own = self.own_range()
        return swing is not None and (own is None or all(own[0] < end < own[1] for end in swing))

    def limit_overlooked(self, answer: QuizAnswer) -> bool:
        return swing_of(answer.text) is None and any(end.dyads for end in self.motion.ends)

    def stroke_overlooked(self, answer: QuizAnswer) -> bool:
        stated = isinstance(self.question.scene.linkage.drive.actuator, Cylinder | Travel)
        return swing_of(answer.text) is None and stated

    def other_swing(self, answer: QuizAnswer, name: str) -> bool:
        """The swing of another link, of that name."""
        swing = swing_of(answer.text)
        bodies = [body for body in self.bodies.values() if not body.slider and name in self.called(body)]
        return swing is not None and any(
            near(self.swing_of_body(body), swing, 0.06, turns=True) for body in bodies
        )

    def swing_of_body(self, body: Body) -> tuple[float, float]:
        """Return between which angles in degrees a body swings."""
        period = self.question.scene.period
        phases = [n * period / SAMPLES for n in range(SAMPLES + 1)]
        first, second = body.joints[:2]

        def angle(phase: float) -> float:
            at = self.motion.at(phase)
            return degrees(float(mp.arg(at[second] - at[first])))

        angles = np.degrees(np.unwrap(np.radians([angle(phase) for phase in phases])))
        found = []
        for pick, sign in ((np.argmin, -1.0), (np.argmax, 1.0)):
            place, reach = phases[int(pick(angles))], period / SAMPLES
            middle = float(angles[int(pick(angles))])
            for _ in range(8):
                near_by = [place + reach * part for part in (-1, -0.5, 0, 0.5, 1)]
                values = [middle + (angle(one) - middle + 180) % 360 - 180 for one in near_by]
                best = max(range(5), key=lambda n: sign * values[n])
                place, reach = near_by[best], reach / 2
            found.append(values[best])
        return found[0], found[1]

    def dead_centres(self, answer: QuizAnswer, name: str) -> bool:
        """Between the crank angles at which the output turns back."""
        swing = swing_of(answer.text)
        for body in (body for body in self.bodies.values() if name in self.called(body)):
            rates = [self.rates_around(body, end) for end in swing or ()]
            if rates and all(one * other < 0 for one, other in rates):
                return True
        return False

    def rates_around(self, body: Body, angle: float) -> tuple[float, float]:
        start = self.question.scene.linkage.drive.start
        one, other = (self.motion.body_rate(body, radians(angle + part) - start) for part in (-0.1, 0.1))
        return one, other

    def mirrored(self, answer: QuizAnswer) -> bool:
        swing, own = swing_of(answer.text), self.own_range()
        return bool(swing and own and near(swing, (-own[1], -own[0]), 0.11))

    def from_its_limit(self, answer: QuizAnswer) -> bool:
        swing, own = swing_of(answer.text), self.own_range()
        return bool(swing and own and near(swing, (0.0, own[1] - own[0]), 0.11))

    def came_by(self, answer: QuizAnswer) -> bool:
        return "same" in answer.text

    def beyond(self, answer: QuizAnswer) -> bool:
        return "other" in answer.text

    def other_way_round(self, answer: QuizAnswer) -> bool:
        """The two sums exchanged."""
        relations = [re.search(r"[<>=]", one.text)[0] for one in (answer, self.right)]  # type: ignore[index]
        return sorted(relations) == ["<", ">"]

    def equal_sums(self, answer: QuizAnswer) -> bool:
        return "=" in self.right.text and "=" not in answer.text

    def expected_as(self, answer: QuizAnswer, part: str, place: str) -> bool:
        """Who takes a part for the shortest, or the longest, finds it in a wrong place elsewhere."""
        return answer.text == part and self.written()[("shortest", "longest").index(place)] != part

    def of_order(self, answer: QuizAnswer, taken: str, wanted: str) -> bool:
        orders = ["position", "velocity", "acceleration"]
        return self.order_of(answer) == orders.index(taken) and self.order_of(self.right) == orders.index(
            wanted
        )

    def no_turning(self, answer: QuizAnswer) -> bool:
        """A term left out although the guide turns."""
        return answer.text == "no" and any(
            self.clear(turning, lengths=0) for turning, _ in self.coriolis_terms()
        )

    def no_guide_turns(self, answer: QuizAnswer) -> bool:
        return answer.text == "yes" and not any(
            self.clear(turning, lengths=0) for turning, _ in self.coriolis_terms()
        )


Held = Callable[[Checked], Iterator[str]]
KEYS: dict[str, Held] = {
    "turning": Checked.turning,
    "fastest": Checked.fastest,
    "heading": Checked.heading,
    "speeding": Checked.speeding,
    "doubled": Checked.doubled,
    "force": Checked.force,
    "instant centre": Checked.instant_centre,
    "dead centre": Checked.dead_centre,
    "input range": Checked.input_range,
    "closure": Checked.closure,
    "grashof": Checked.grashof,
    "grashof sum": Checked.grashof_sum,
    "curves": Checked.curves,
    "coriolis": Checked.coriolis,
    "slow way": Checked.slow_way,
    "precision point": Checked.precision_point,
    "pole": Checked.pole_of_poses,
}
_POWERS = {r"how (.*) changes": Checked.with_power}
MISCONCEPTIONS: dict[str, dict[str, Callable[..., bool]]] = {
    "turning": {
        r"the input's direction, passed on along the chain": Checked.input_way,
        r"the way it turns when the input runs backwards": Checked.backwards,
    },
    "fastest": {
        r"the input taken for the fastest: a chain of links can speed up": Checked.input_joint,
        r"the point farthest from (\S+), taken for the fastest": Checked.farthest,
    },
    "heading": {
        r"the way it moves when the input runs backwards": Checked.backwards,
        r"the acceleration taken for the velocity": Checked.as_accelerated,
        r"along its link, not across": Checked.along_link,
    },
    "speeding": {r"the sign of the acceleration alone, whichever way the point moves": Checked.sign_alone},
    "doubled": _POWERS,
    "force": _POWERS,
    "instant centre": {
        r"the middle of the link taken for the pole": Checked.middle_of_link,
        r"the nearer joint taken for the pole": Checked.nearer_joint,
        r"a joint that moves, taken for the pole": Checked.moving_joint,
        r"a fixed pin, about which another link turns": Checked.fixed_pin,
    },
    "dead centre": {
        r"the greatest speed taken for the dead centre": Checked.quickest,
        r"the other dead centre, taken to lie half a turn on": Checked.half_turn_on,
    },
    "input range": {
        r"a limit seen where the loop still closes": Checked.still_closes,
        r"the limit overlooked: beyond it the loop does not close": Checked.limit_overlooked,
        r"the stroke of the drive overlooked": Checked.stroke_overlooked,
        r"the swing of (.*) taken for that of the input": Checked.other_swing,
        r"the dead centres of (.*) taken for limits of the crank": Checked.dead_centres,
        r"the angles counted clockwise": Checked.mirrored,
        r"the swing counted from its own limit": Checked.from_its_limit,
    },
    "closure": {
        r"the closure that it came by": Checked.came_by,
        r"the closure beyond the limit": Checked.beyond,
    },
    "grashof": {
        r"the sums compared the wrong way round": Checked.other_way_round,
        r"equal sums taken for unequal ones": Checked.equal_sums,
    },
    "grashof sum": {
        r"the (input|ground) taken for the (shortest|longest), whatever its length": Checked.expected_as
    },
    "curves": {
        r"the (position|velocity|acceleration) taken for the (velocity|acceleration)": Checked.of_order
    },
    "coriolis": {
        r"the guide's turning overlooked": Checked.no_turning,
        r"sliding alone taken for a Coriolis term": Checked.no_guide_turns,
    },
    "slow way": {
        r"the quick stroke taken for the slow one": partial(
            Checked.slow_told_as, share=lambda slow: 360 - slow
        ),
        r"half a turn times the time ratio": partial(
            Checked.slow_told_as, share=lambda slow: 180 * slow / (360 - slow)
        ),
        r"the angle between the directions of the dead centres halved": partial(
            Checked.slow_told_as, share=lambda slow: 90 + slow / 2
        ),
    },
    "precision point": {
        r"a place between two precision points, where the error is near an extreme": Checked.between_points
    },
    "pole": {
        r"the turn taken the other way round": Checked.other_way_round_about,
        r"the middle between the places, about which it would turn by half a turn": Checked.middle_of_way,
        r"the pole of poses (\d) and (\d)": Checked.pole_of_others,
    },
}


def transmission(joint: Joint, at: dict[str, Any]) -> Iterator[float]:
    """Yield the angle between a dyad's two bars, or of its bar from its guide's normal."""
    match joint:
        case RRR():
            turn = (at[joint.ends[0]] - at[joint.name]) / (at[joint.ends[1]] - at[joint.name])
            yield float(mp.atan2(abs(mp.im(turn)), abs(mp.re(turn))))
        case RRP():
            along = mp.expj(joint.line.angle)
            if joint.line.on is not None:
                along *= at[joint.line.on[1]] - at[joint.line.on[0]]
            turn = (at[joint.name] - at[joint.end]) / along
            yield float(mp.atan2(abs(mp.re(turn)), abs(mp.im(turn))))
        case RPR():
            arm = abs(at[joint.through] - at[joint.pivot])
            yield float(mp.acos(min(abs(joint.offset) / arm, mp.mpf(1)))) if arm else pi / 2


def number(text: str) -> float:
    """Return a number as it is set in a question."""
    return float(text.replace("−", "-").rstrip("°,;.)").lstrip("("))


def swing_of(text: str) -> tuple[float, float] | None:
    """Return the angles between which an answer has something swing; None for a full turn."""
    found = re.findall(r"[−\d.]+(?=°)", text)
    return (number(found[0]), number(found[1])) if found else None


def near(one: Any, other: Any, least: float, *, turns: bool = False) -> bool:
    """Return whether numbers differ by less; in whole `turns` of degrees they may."""
    apart = [a - b for a, b in zip(one, other, strict=True)]
    if turns:
        apart = [a - 360 * round(apart[0] / 360) for a in apart]
    return all(abs(a) < least for a in apart)
