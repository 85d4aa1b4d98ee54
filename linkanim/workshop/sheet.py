"""The page of instructions: parts, layers, steps of assembly, what to predict and what to measure."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from functools import cached_property

import numpy as np

from linkanim.errors import WorkFailed
from linkanim.frozen import frozen
from linkanim.paper import html
from linkanim.paper.figure import Figured
from linkanim.paper.html import Beside, FigurePart, Part
from linkanim.paper.svg import svg
from linkanim.picture.figure import figure
from linkanim.picture.items import Item
from linkanim.picture.look import Look
from linkanim.picture.quantities import driven_words
from linkanim.picture.text import subscripted
from linkanim.play.question import QuizQuestion
from linkanim.play.quiz import LETTERS, next_question, pose_words
from linkanim.units import significant
from linkanim.workshop.drawing import Drawn
from linkanim.workshop.made import MadeLinkage, MadePin

_FIGURE, _PLAN, _SIDE, _EXPLODED, _STEP = (820, 440), (820, 500), (820, 260), (820, 560), (440, 300)
_QUESTIONS = 4
_BY_HAND = ("heading", "turning", "dead centre", "input range", "fastest")
"""The kinds of questions that a model answers when it is turned by hand."""
_KEY = "Key"
_WAYS = {
    "cardboard": "Print parts.pdf at 100 % and check the scale at the foot of a page with a ruler. Glue the "
    "pages onto cardboard and cut the parts out. The pins are brads, or pieces of round rod, {pin} mm thick; "
    "where a part passes over a pin, use rod, as the head of a brad would be in the way.",
    "laser": "Cut the sheet parts-{thick}mm (SVG or DXF): red lines are cut, blue text is engraved. The pins "
    "are pieces of round rod, {pin} mm thick, glued into the ground or into the lowest of their plates.",
    "print": "Print each STL file in the position in which it lies. A pin is put through from below, its "
    "head sunk into the lowest of its plates, and a cap, sunk into the highest, is pressed on; a plate "
    "with a slot has neither.",
}


@frozen
class Sheet:
    """The instructions for assembling a made linkage, as a page to be printed."""

    made: MadeLinkage

    @cached_property
    def phase(self) -> float:
        """The phase of assembly: the one at which the joints are farthest apart."""
        return figure(self.made.scene).clearest

    def document(self) -> str:
        """Return the page as HTML."""
        return html.page(f"{self.made.scene.title}: a model", self._head(), self._chapters(), apart=(_KEY,))

    def _head(self) -> Iterator[str]:
        made, sizes = self.made, self.made.sizes
        fewest = "the fewest in which it turns" if made.fewest else "fewer might do"
        layers = f"{made.layer_words} ({fewest})" if made.layers else made.layer_words
        yield html.paragraph(
            f"{len(made.plates)} flat parts, {sizes.thickness:g} mm thick, {made.size_words}, {layers}. "
            "Bars are "
            f"{_mm(sizes.bar)} wide and holes {_mm(sizes.hole)}. During a whole cycle parts in one layer "
            f"stay at least {_mm(sizes.gap)} apart."
        )
        words = {"pin": significant(sizes.pin, 3), "thick": f"{sizes.thickness:g}"}
        yield html.paragraph(_WAYS[made.way].format(**words))

    def _chapters(self) -> Iterator[tuple[str, Iterable[Part]]]:
        questions = self._questions()
        yield "The linkage", self._overview()
        yield "Parts", self._parts()
        yield "Layers", self._layers()
        yield "Assembly", self._steps()
        yield "Predict, turn and measure", self._tasks(questions)
        yield _KEY, self._key(questions)

    def _overview(self) -> Iterator[Part]:
        scene = self.made.scene
        pose = Figured(scene, _FIGURE, Look(hud=False, names=1, background=False), self.phase)
        where = driven_words(scene, scene.pose(self.phase, 0).coordinate)
        words = f"Links and joints, with the {scene.info.input_name} at {where}"
        yield FigurePart(pose.document(), words, 85)
        drawn = Drawn(self.made, self.phase, _PLAN)
        yield _drawing(drawn.plan(), _PLAN, "The parts from above, in the position of assembly", 100)

    def _parts(self) -> Iterator[Part]:
        made, sizes = self.made, self.made.sizes
        heads = "no.", "part", "number", "layer", "holes", "slots for", "check"
        plates = [(*self._row(number),) for number in range(len(made.plates))]
        yield html.table("Flat parts, numbered as in the figures", heads, plates)
        heads = (
            "pin",
            "number",
            "diameter",
            "length",
            "from layer, to layer",
            "fixed",
            "rings, marked with pin and layer: outer diameter",
        )
        pins = [
            (
                *(subscripted(pin.name), "1", f"{significant(sizes.pin, 3)} mm"),
                f"{(pin.high - pin.low + 1) * sizes.thickness:g} mm",
                f"{_level(pin.low)}, {_level(pin.high)}",
                {"below": "in the ground", "above": "in the bridge", None: ""}[pin.side],
                "; ".join(f"{pin.name} {ring.layer}: {_mm(ring.diameter)}" for ring in pin.spacers),
            )
            for pin in made.pins
        ]
        if pins:
            yield html.table("Pins, and the rings on them that keep layers apart", heads, pins)
        for band in made.bands:
            ends = " and ".join(subscripted(name) for name in band.joints)
            yield html.paragraph(f"The {band.name} is a rubber band between {ends}, above all layers.")

    def _row(self, number: int) -> Iterator[str]:
        """Yield the cells of a plate's row."""
        made, plate = self.made, self.made.plates[number]
        yield from (
            made.numbers[number],
            ", ".join(plate.bodies) or plate.name,
            "1",
            _level(made.layer[number]),
        )
        named = [hole for hole in plate.holes if hole.joint]
        yield ", ".join(subscripted(hole.joint) for hole in named)
        yield ", ".join(subscripted(slot.joint) for slot in plate.slots)
        far = max((abs(one.at - other.at) for one in named for other in named), default=0.0)
        if plate.teeth is not None:
            wheel = plate.teeth.wheel
            yield f"{wheel.teeth} teeth, module {significant(wheel.module, 4)} mm"
        else:
            yield f"{_mm(far)} between the outermost holes" if far else ""

    def _layers(self) -> Iterator[Part]:
        side, exploded = (Drawn(self.made, self.phase, size) for size in (_SIDE, _EXPLODED))
        yield _drawing(side.side(), _SIDE, "The layers from the side, in the position of assembly", 55)
        yield _drawing(exploded.exploded(), _EXPLODED, "The layers, drawn apart", 85)

    def _steps(self) -> Iterator[Part]:
        """Yield a picture for each step with what to do: the ground first, then layer by layer."""
        made = self.made
        order = sorted(range(len(made.plates)), key=lambda number: (made.layer[number], number))
        ground = [number for number in order if made.layer[number] == 0]
        steps = [ground, *([number] for number in order[len(ground) :])]
        pictures = []
        for n, new in enumerate(steps, start=1):
            shown = order[: order.index(new[-1]) + 1]
            drawn = Drawn(made, self.phase, _STEP, shown=shown, new=new)
            words = self._laid_down(new) if n == 1 else self._laid_on(new[0])
            pictures.append(_drawing(drawn.plan(), _STEP, f"Step {n}. {words}", 60))
        yield Beside(tuple(pictures))
        yield html.paragraph(" ".join(self._remarks()))

    def _laid_down(self, plates: Sequence[int]) -> str:
        """Return the sentence on laying down the ground, with its pins and the tongues in its slots."""
        made = self.made
        words = [f"Lay {made.label(0)} flat"]
        if standing := [pin for pin in made.pins if pin.side == "below"]:
            words.append(f"put {_named(standing)} through it from below")
        for number in plates[1:]:
            pins = [pin for pin in made.pins if number in pin.plates]
            through = f", with {_named(pins)} through it from below" if pins else ""
            words.append(f"lay {made.label(number)} into its slot{through}")
        return "; ".join(words) + "."

    def _laid_on(self, number: int) -> str:
        """Return the sentence on laying a plate on those below."""
        made, layer = self.made, self.made.layer[number]
        pins = [pin for pin in made.pins if number in pin.plates]
        there = [pin for pin in pins if pin.low < layer]
        ringed = [pin for pin in there if any(ring.layer < layer for ring in pin.spacers)]
        words = f"Layer {layer}: {made.label(number)}"
        for more, some in (
            (", with {} through it from below", [pin for pin in pins if pin.low == layer]),
            (", over {}", [pin for pin in there if number not in pin.sliding]),
            (", its slot over {}", [pin for pin in there if number in pin.sliding]),
            ("; first put the rings on {} in the layers below", ringed),
            ("; close {}", [pin for pin in there if pin.high == layer and not pin.stuck]),
        ):
            if some:
                words += more.format(_named(some))
        return words + "."

    def _remarks(self) -> Iterator[str]:
        """Yield the other sentences that are needed for assembly."""
        made, drive = self.made, self.made.scene.linkage.drive
        moved = "Turn" if drive.coordinate.is_angle else "Push"
        yield f"{moved} the model at {subscripted(drive.joint)} and compare it with Figure 2."
        if any(plate.role == "slider" and made.layer[n] == 0 for n, plate in enumerate(made.plates)):
            yield "The tongues lie loose in the slots of the ground; a card under the ground keeps them in."
        if any(plate.teeth for plate in made.plates):
            yield "Mesh the wheels with all cranks as in Figure 2: a tooth further gives another linkage."
        if made.scene.info.change_points:
            yield "At a change point it can continue in two ways; guide it there with a finger."

    def _questions(self) -> list[QuizQuestion]:
        """Return questions that the model answers; none where no question can be made."""
        questions: list[QuizQuestion] = []
        for n in range(_QUESTIONS):
            before = [one.question_id for one in questions]
            try:
                question = next_question(self.made.scene, f"make {n}", before, _BY_HAND)
            except WorkFailed:
                break
            if question.question_id not in before:
                questions.append(question)
        return questions

    def _tasks(self, questions: Sequence[QuizQuestion]) -> Iterator[Part]:
        rows = [
            (
                str(n),
                pose_words(one),
                one.text,
                "; ".join(f"{letter}) {text}" for letter, text in _answers(one)),
            )
            for n, one in enumerate(questions, start=1)
        ]
        if rows:
            heads = "", "position", "question", "answers"
            yield html.table("Predict first; then turn the model to the position and look", heads, rows)
        blank = [(what, "", "") for what, _ in self._measures()]
        if blank:
            columns = "quantity", "measured", "calculated from the lengths"
            yield html.table("Measure on the model", columns, blank)

    def _key(self, questions: Sequence[QuizQuestion]) -> Iterator[Part]:
        rows = [
            (str(n), *[") ".join([*_answers(one)][one.right]), one.why])
            for n, one in enumerate(questions, start=1)
        ]
        if rows:
            yield html.table("Predictions", ("", "answer", "reason"), rows)
        if measures := [*self._measures()]:
            yield html.table("Measures of the model", ("quantity", "value"), measures)

    def _measures(self) -> Iterator[tuple[str, str]]:
        """Yield the measures that can be taken on the model, with their values."""
        made, info = self.made, self.made.scene.info
        if info.stroke:
            yield "stroke of the slider", _mm(info.stroke * made.sizes.scale)
        if info.swing is not None:
            yield f"swing of {info.output_name}", f"{math.degrees(info.swing.stroke):.1f}°"
        if info.time_ratio is not None:
            yield (
                "time ratio: the input's angle for the slow stroke over that for the quick one",
                f"{info.time_ratio:.2f}",
            )
        if info.transmission_angle is not None:
            least, most = (math.degrees(angle) for angle in info.transmission_angle)
            yield "least and greatest transmission angle", f"{least:.0f}°, {most:.0f}°"
        cycle = figure(made.scene).cycle
        for joint in made.scene.trace:
            wide, high = np.ptp(np.asarray(cycle.position[joint]) * made.sizes.scale, axis=0)
            yield f"width and height of the curve of {subscripted(joint)}", f"{_mm(wide)}, {_mm(high)}"


def _drawing(items: Iterable[Item], size: tuple[int, int], caption: str, highest: int) -> FigurePart:
    return FigurePart(svg(size, None, items, title=caption), caption, highest)


def _answers(question: QuizQuestion) -> Iterator[tuple[str, str]]:
    return ((letter, answer.text) for letter, answer in zip(LETTERS, question.answers, strict=False))


def _mm(length: float) -> str:
    return f"{significant(float(length), 4)} mm"


def _level(layer: int) -> str:
    return str(layer) if layer else "ground"


def _named(pins: Sequence[MadePin]) -> str:
    """Return pins in words."""
    names = [subscripted(pin.name) for pin in pins]
    return f"pin {names[0]}" if len(names) == 1 else f"pins {', '.join(names[:-1])} and {names[-1]}"
