"""The worked solution of a pose: its chapters, and the results that they lead to.

It carries as few digits as let every result agree with solving to five significant digits. What is zero shows
none of their rounding, and of a force or a torque, from which nothing follows, only those that are right.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass
from functools import partial

from linkanim.explain.expression import ONE, Symbol
from linkanim.explain.inputs import PoseRequest, place_input
from linkanim.explain.kinds import KINDS
from linkanim.explain.lines import Chapter, Outcome, Step, Words, marked
from linkanim.explain.loops import LoopArrow, VectorLoop, loops_of
from linkanim.explain.names import SymbolNames, names_of
from linkanim.explain.parts import centre_of_mass, effort, strut
from linkanim.explain.rates import BY_INPUT, IN_TIME, ORDERS, Order, Rates
from linkanim.explain.synthesis import synthesis
from linkanim.explain.work import ANGLE, LENGTH, Powers, Scale, Work, rounded
from linkanim.mechanics.facts.register import input_symbol
from linkanim.mechanics.linkage.linkage import Body
from linkanim.picture.figure import figure

_FEWEST, _MOST = 6, 14
_AGREES = 5e-6
"""A result agrees to that share of itself."""
_LONG = 100.0
"""A bar longer than so many times the usual one does not decide how many decimals lengths have."""
_TINY = 1e-300
_BY_INPUT = (
    "Primes are derivatives by the input: h of angles, f of ways. Each loop differentiated gives two linear "
    "equations; a are the entries of their matrix, b the right sides, D the determinant, and both unknowns "
    "follow by Cramer's rule."
)
_IN_TIME = (
    "The loops differentiated in time: the same equations, the input running at its own speed.",
    "Differentiated once more: the same matrix, with ω² and what Coriolis adds on the right sides.",
)
_CARRIED = "As many digits are carried as make five significant ones of every result right."
_NO_LOOP = "There is none to close: each joint follows from the input alone."
_SINGULAR = (
    "No rates follow here in as many digits as a page can show: at a limit or a change point the two linear "
    "equations of a dyad are one. Take a pose beside it."
)


@dataclass(frozen=True)
class Solution:
    """A pose worked out: chapters as they are read, loops to draw, results, and where joints lie (x + yi)."""

    request: PoseRequest
    chapters: tuple[Chapter, ...]
    loops: tuple[VectorLoop, ...]
    results: tuple[Outcome, ...]
    places: dict[str, complex]
    singular: bool
    made: bool = False
    """Whether the last chapter says how the linkage was made."""

    @property
    def loop_chapter(self) -> Chapter:
        """The chapter of the loops, which has the figure."""
        return self.chapters[1]

    @property
    def synthesis_chapter(self) -> Chapter | None:
        """The chapter on how the linkage was made, which has the figure of its construction."""
        return self.chapters[-1] if self.made else None

    @property
    def arrows(self) -> tuple[LoopArrow, ...]:
        """The vectors of all loops, each once."""
        return tuple({arrow.symbol: arrow for loop in self.loops for arrow in loop.arrows}.values())

    @property
    def phase(self) -> float:
        """The phase of the pose."""
        return float(self.request.motion().phase)

    @property
    def title(self) -> str:
        """What it is a solution of."""
        return self.request.scene.title

    @property
    def where(self) -> str:
        """Where the input is, in a sentence."""
        scene = self.request.scene
        place = float(self.request.motion().coordinate)
        words = scene.linkage.drive.coordinate.text(place, scene.length_unit, 0.01)
        return f"At {input_symbol(scene.linkage)} = {words}."


def solution(request: PoseRequest) -> Solution:
    """Return the worked solution of a pose, which its input must reach.

    It ends with positions where no rates follow, or none of five digits: at a limit and at a change point.
    """
    names = names_of(figure(request.scene))
    ways = [(digits, rates) for rates in (True, False) for digits in range(_FEWEST, _MOST + 1)]
    for digits, rates in ways:
        # a root or a quotient of rounded digits is none near a limit: more of them are taken
        with suppress(ZeroDivisionError, ValueError):
            places: dict[Symbol, int] = {}
            found = _Draft(request, names, digits, places).solution(rates)
            # what follows from a number in fewer digits is another number, and may have fewer that are right
            while _agrees(found) and not (fewer := _right_places(found)).items() <= places.items():
                places |= fewer
                found = _Draft(request, names, digits, places).solution(rates)
            if _agrees(found):
                break
    return found


def _compared(found: Solution) -> Iterator[tuple[Outcome, float]]:
    """Yield each result with what solving gives, of an angle on the same turn."""
    motion, quantities = found.request.motion(), found.request.scene.quantities
    for result in found.results:
        true, worked_out = float(quantities[result.token].shown(motion)), result.value.value
        yield (
            result,
            worked_out + math.remainder(true - worked_out, 360) if result.unit == "°" else true,
        )


def _agrees(found: Solution) -> bool:
    return all(
        abs(result.value.value - true) <= max(_AGREES * abs(true), result.least)
        for result, true in _compared(found)
    )


def _right_places(found: Solution) -> dict[Symbol, int]:
    """Return with how many decimals zeros and `last` results are right to the last, where they have more.

    All zeros get fewer where one shows rounding: in what follows from it others would, one after the other.
    """
    zeros: dict[Symbol, int] = {}
    right: dict[Symbol, int] = {}
    rounding = False
    for result, true in _compared(found):
        value, symbol = result.value.value, result.value.symbol
        shown = len(result.value.shown.partition(".")[2])
        if symbol is None:
            continue
        if float(rounded(true, shown)) == 0:
            zeros[symbol] = min(shown, max(math.floor(-math.log10(2 * max(result.least, _TINY))), 0))
            rounding = rounding or value != 0
        elif result.last:
            right[symbol] = next((n for n in range(shown, 0, -1) if rounded(value, n) == rounded(true, n)), 0)
            if right[symbol] == shown:
                del right[symbol]
    return right | (zeros if rounding else {})


class _Draft:
    """A solution in so many digits while it is written, some of its results in fewer decimals."""

    def __init__(
        self, request: PoseRequest, names: SymbolNames, digits: int, places: Mapping[Symbol, int]
    ) -> None:
        self.request, self.motion = request, request.motion()
        self.linkage = request.scene.linkage
        bars = sorted(abs(value) for joint in self.linkage.joints for _, value in joint.bars) or [1.0]
        # one bar far longer than the others does not take their digits
        length = min(bars[-1], _LONG * bars[len(bars) // 2]) or bars[-1]
        angular = self.linkage.drive.coordinate.is_angle
        rate, second = abs(float(self.motion.coordinate_rate)), abs(float(self.motion.coordinate_second))
        pace = max(rate, math.sqrt(second))
        rate = pace if angular else pace / length
        scale = Scale(digits, request.scene.length_unit, length, rate if 0 < rate < math.inf else 1.0)
        self.work = Work(self.linkage, names, self.motion, scale, places)
        rate, per = (1.0, "") if angular else (1.0 / length, scale.unit)
        by = Scale(digits, scale.unit, length, rate, per)
        self.rates, self.slopes = Rates(self.work, IN_TIME, scale), Rates(self.work, BY_INPUT, by)
        self.results: list[Outcome] = []
        self.steps: list[Step] = []

    def solution(self, rates: bool) -> Solution:
        """Return it, with velocities and accelerations or without."""
        places = self._placed()
        loops = loops_of(self.work, places)
        self.work.items.clear()
        if rates:
            rest = [*self._by_input(), *self._in_time(), *self._parts()]
        else:
            rest = [Chapter("Velocities and accelerations", (Step("", (Words(_SINGULAR),)),))]
        given = Chapter(
            "Given", (Step("", (*self.work.given.values(), *([Words(_CARRIED)] if rates else ()))),)
        )
        steps = tuple(loop.step for loop in loops) or (Step("", (Words(_NO_LOOP),)),)
        made = synthesis(self.request.scene, self.work.names)
        chapters = (given, Chapter("Vector loops", steps), places, *rest, *made)
        known = self.request.scene.quantities
        # of parts with one name the last has the token, as it has among the quantities
        results = tuple({one.token: one for one in self.results if one.token in known}.values())
        at = {joint.name: self.work.place(joint.name) for joint in self.linkage.joints}
        return Solution(self.request, chapters, loops, results, at, not rates, bool(made))

    def _step(self, title: str, write: Callable[[], object]) -> None:
        """Add a step with the lines that are written meanwhile; none where there are none."""
        self.work.items.clear()
        write()
        if self.work.items:
            self.steps.append(Step(title, tuple(self.work.items)))

    def _chapter(self, title: str) -> list[Chapter]:
        """Return a chapter of the steps since the last one, if there are any."""
        steps, self.steps = tuple(self.steps), []
        return [Chapter(title, steps)] if steps else []

    def _placed(self) -> Chapter:
        """Return the chapter of positions."""
        scale = self.work.scale
        self._step("The input", partial(place_input, self.request, self.rates))
        for joint in self.linkage.joints:
            self._step(f"Joint {marked(joint.name)}", partial(KINDS[type(joint)].place, joint, self.work))
            self.results += scale.outcomes(f"{joint.name}.position", self.work.points[joint.name], 0)
        self._step("Angles of the links", self._angles)
        for body in self.linkage.bodies:
            if body.slider in self.work.slides:
                travel = self.work.slides[body.slider]
                self.results.append(scale.outcome(f"{body.name}.travel", travel, LENGTH))
        return self._chapter("Positions")[0]

    def _angles(self) -> None:
        for body in self._turning():
            angle = self.work.angle_of(body.joints[0], body.joints[1])
            self.results.append(self.work.scale.outcome(f"{body.name}.angle", angle, ANGLE))

    def _turning(self) -> Iterator[Body]:
        return (body for body in self.linkage.bodies if body.slider is None)

    def _by_input(self) -> Iterator[Chapter]:
        """Yield the chapter of kinematic coefficients."""
        self.slopes.start(ONE)
        self._step("", partial(self.work.say, _BY_INPUT))
        for order, word, token in zip(ORDERS, ("first", "second"), ("", "second_"), strict=True):
            self._moved(self.slopes, order, f", {word} coefficients")
            self._tell_links(self.slopes, order, f"{token}coefficient", f"{token}coefficient")
        yield from self._chapter("Kinematic coefficients")

    def _in_time(self) -> Iterator[Chapter]:
        """Yield the chapters of velocities and accelerations."""
        titles = {"velocity": "Velocities", "acceleration": "Accelerations"}
        for order, (word, title), text in zip(ORDERS, titles.items(), _IN_TIME, strict=True):
            self._step("", partial(self.work.say, text))
            self._moved(self.rates, order)
            for joint in self.linkage.joints:
                moving = self.rates.of(joint.name, order)
                self.results += self.rates.scale.outcomes(f"{joint.name}.{word}", moving, order)
            self._tell_links(self.rates, order, f"angular_{word}", f"travel_{word}")
            yield from self._chapter(title)

    def _moved(self, rates: Rates, order: Order, words: str = "") -> None:
        """Add a step for each joint that moves."""
        for joint in self.linkage.joints:
            title = f"Joint {marked(joint.name)}{words}"
            self._step(title, partial(KINDS[type(joint)].move, joint, rates, order))

    def _tell_links(self, rates: Rates, order: Order, turning: str, sliding: str) -> None:
        for body in self.linkage.bodies:
            way = body.slider or self.work.frame((body.joints[0], body.joints[1]))
            if (way, "s") in rates.known:
                token = f"{body.name}.{sliding if body.slider else turning}"
                measure = Powers(int(body.slider is not None), order)
                self.results.append(rates.scale.outcome(token, rates.rate(way, order), measure))

    def _parts(self) -> Iterator[Chapter]:
        """Yield the chapters of centres of mass, of springs and dampers, and of what the input delivers."""
        for body in self._turning():
            if body.com is not None:
                self._found(f"Link {body.name}", centre_of_mass(body, self.rates))
        yield from self._chapter("Centres of mass")
        for item in self.linkage.springs + self.linkage.dampers:
            word = self.linkage.strut_word(item)
            self._found(f"{word[:1].upper()}{word[1:]} {item.name}", strut(item, self.rates))
        yield from self._chapter("Springs and dampers")
        if self.linkage.forceful:
            known = {result.token: result.value for result in self.results}
            self._found("", effort(self.rates, known))
            yield from self._chapter("Input")

    def _found(self, title: str, found: Iterable[Outcome]) -> None:
        """Add a step with its results."""
        self._step(title, lambda: self.results.extend(found))
