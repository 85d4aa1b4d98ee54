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
from linkanim.words import name_said, row_said, said, said_as, said_many, sentences, to_say
from linkanim.workshop.drawing import Drawn
from linkanim.workshop.made import MadeLinkage
from linkanim.workshop.parts import MadePin

_FIGURE, _PLAN, _SIDE, _EXPLODED, _STEP = (820, 440), (820, 500), (820, 260), (820, 560), (440, 300)
_QUESTIONS = 4
_BY_HAND = ("heading", "turning", "dead centre", "input range", "fastest")
"""The kinds of questions that a model answers when it is turned by hand."""
_KEY = to_say("Key")
_WAYS = {
    "cardboard": to_say(
        "Print parts.pdf at 100 % and check the scale at the foot of a page with a ruler. Glue the "
        "pages onto cardboard and cut the parts out. The pins are brads, or pieces of round rod, {pin} mm "
        "thick; where a part passes over a pin, use rod, as the head of a brad would be in the way."
    ),
    "laser": to_say(
        "Cut the sheet parts-{thick}mm (SVG or DXF): red lines are cut, blue text is engraved. The pins "
        "are pieces of round rod, {pin} mm thick, glued into the ground or into the lowest of their plates."
    ),
    "print": to_say(
        "Print each STL file in the position in which it lies. A pin is put through from below, its "
        "head sunk into the lowest of its plates, and a cap, sunk into the highest, is pressed on; a plate "
        "with a slot has neither."
    ),
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
        return html.page(
            said("{title}: a model", title=said(self.made.scene.title)),
            self._head(),
            self._chapters(),
            apart=(said(_KEY),),
        )

    def _head(self) -> Iterator[str]:
        made, sizes = self.made, self.made.sizes
        fewest = said("the fewest in which it turns") if made.fewest else said("fewer might do")
        layers = made.layer_words
        if made.layers:
            layers = said("{layers} ({fewest})", layers=layers, fewest=fewest)
        yield html.paragraph(
            sentences(
                said(
                    "{count} flat parts, {thickness} mm thick, {size}, {layers}.",
                    count=len(made.plates),
                    thickness=f"{sizes.thickness:g}",
                    size=made.size_words,
                    layers=layers,
                ),
                said("Bars are {bar} wide and holes {hole}.", bar=_mm(sizes.bar), hole=_mm(sizes.hole)),
                said(
                    "During a whole cycle parts in one layer stay at least {gap} apart.", gap=_mm(sizes.gap)
                ),
            )
        )
        words = {"pin": significant(sizes.pin, 3), "thick": f"{sizes.thickness:g}"}
        yield html.paragraph(said(_WAYS[made.way]).format(**words))

    def _chapters(self) -> Iterator[tuple[str, Iterable[Part]]]:
        questions = self._questions()
        yield said("The linkage"), self._overview()
        yield said("Parts"), self._parts()
        yield said("Layers"), self._layers()
        yield said("Assembly"), self._steps()
        yield said("Predict, turn and measure"), self._tasks(questions)
        yield said(_KEY), self._key(questions)

    def _overview(self) -> Iterator[Part]:
        scene = self.made.scene
        pose = Figured(scene, _FIGURE, Look(hud=False, names=1, background=False), self.phase)
        where = driven_words(scene, scene.pose(self.phase, 0).coordinate)
        words = said(
            "Links and joints, with the {link} at {place}",
            link=name_said(scene.info.input_name),
            place=where,
        )
        yield FigurePart(pose.document(), words, 85)
        drawn = Drawn(self.made, self.phase, _PLAN)
        yield _drawing(drawn.plan(), _PLAN, said("The parts from above, in the position of assembly"), 100)

    def _parts(self) -> Iterator[Part]:
        made, sizes = self.made, self.made.sizes
        heads = (
            *(said("no."), said("part"), said_as("column", "number"), said("layer"), said("holes")),
            *(said("slots for"), said("check")),
        )
        plates = [(*self._row(number),) for number in range(len(made.plates))]
        yield html.table(said("Flat parts, numbered as in the figures"), heads, plates)
        heads = (
            said("pin"),
            said_as("column", "number"),
            said("diameter"),
            said("length"),
            said("from layer, to layer"),
            said("fixed"),
            said("rings, marked with pin and layer: outer diameter"),
        )
        pins = [
            (
                *(subscripted(pin.name), "1", f"{significant(sizes.pin, 3)} mm"),
                f"{(pin.high - pin.low + 1) * sizes.thickness:g} mm",
                f"{_level(pin.low)}, {_level(pin.high)}",
                {"below": said("in the ground"), "above": said("in the bridge"), None: ""}[pin.side],
                "; ".join(f"{pin.name} {layer}: {_mm(diameter)}" for layer, diameter in pin.spacers),
            )
            for pin in made.pins
        ]
        if pins:
            yield html.table(said("Pins, and the rings on them that keep layers apart"), heads, pins)
        for band, joints in made.bands:
            ends = row_said([subscripted(name) for name in joints])
            yield html.paragraph(
                said(
                    "The {band} is a rubber band between {joints}, above all layers.", band=band, joints=ends
                )
            )

    def _row(self, number: int) -> Iterator[str]:
        """Yield the cells of a plate's row."""
        made, plate = self.made, self.made.plates[number]
        yield from (
            made.numbers[number],
            ", ".join(map(name_said, plate.bodies)) or plate.name,
            "1",
            _level(made.layer[number]),
        )
        named = [hole for hole in plate.holes if hole.joint]
        yield ", ".join(subscripted(hole.joint) for hole in named)
        yield ", ".join(subscripted(slot.joint) for slot in plate.slots)
        far = max((abs(one.begin - other.begin) for one in named for other in named), default=0.0)
        if plate.teeth is not None:
            wheel = plate.teeth.wheel
            module = f"{significant(wheel.module, 4)} mm"
            yield said("{count} teeth, module {module}", count=wheel.teeth, module=module)
        else:
            yield said("{length} between the outermost holes", length=_mm(far)) if far else ""

    def _layers(self) -> Iterator[Part]:
        side, exploded = (Drawn(self.made, self.phase, size) for size in (_SIDE, _EXPLODED))
        yield _drawing(side.side(), _SIDE, said("The layers from the side, in the position of assembly"), 55)
        yield _drawing(exploded.exploded(), _EXPLODED, said("The layers, drawn apart"), 85)

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
            pictures.append(
                _drawing(drawn.plan(), _STEP, said("Step {number}. {words}", number=n, words=words), 60)
            )
        yield Beside(tuple(pictures))
        yield html.paragraph(sentences(*self._remarks()))

    def _laid_down(self, plates: Sequence[int]) -> str:
        """Return the sentence on laying down the ground, with its pins and the tongues in its slots."""
        made = self.made
        words = [said("Lay {part} flat", part=made.label(0))]
        if standing := [pin for pin in made.pins if pin.side == "below"]:
            words.append(said("put {pins} through it from below", pins=_named(standing)))
        for number in plates[1:]:
            pins = [pin for pin in made.pins if number in pin.plates]
            step = said("lay {part} into its slot", part=made.label(number))
            if pins:
                step = said(
                    "lay {part} into its slot, with {pins} through it from below",
                    part=made.label(number),
                    pins=_named(pins),
                )
            words.append(step)
        return said("{clauses}.", clauses=said_as("list of clauses", "; ").join(words))

    def _laid_on(self, number: int) -> str:
        """Return the sentence on laying a plate on those below."""
        made, layer = self.made, self.made.layer[number]
        pins = [pin for pin in made.pins if number in pin.plates]
        there = [pin for pin in pins if pin.low < layer]
        ringed = [pin for pin in there if any(between < layer for between, _ in pin.spacers)]
        words = said("Layer {number}: {part}", number=layer, part=made.label(number))
        for more, some in (
            (to_say(", with {pins} through it from below"), [pin for pin in pins if pin.low == layer]),
            (to_say(", over {pins}"), [pin for pin in there if number not in pin.sliding]),
            (to_say(", its slot over {pins}"), [pin for pin in there if number in pin.sliding]),
            (to_say("; first put the rings on {pins} in the layers below"), ringed),
            (to_say("; close {pins}"), [pin for pin in there if pin.high == layer and not pin.stuck]),
        ):
            if some:
                words += said(more, pins=_named(some))
        return said("{clauses}.", clauses=words)

    def _remarks(self) -> Iterator[str]:
        """Yield the other sentences that are needed for assembly."""
        made, drive = self.made, self.made.scene.linkage.drive
        joint = subscripted(drive.joint)
        if drive.coordinate.is_angle:
            yield said("Turn the model at {joint} and compare it with Figure 2.", joint=joint)
        else:
            yield said("Push the model at {joint} and compare it with Figure 2.", joint=joint)
        if any(plate.role == "slider" and made.layer[n] == 0 for n, plate in enumerate(made.plates)):
            yield said(
                "The tongues lie loose in the slots of the ground; a card under the ground keeps them in."
            )
        if any(plate.teeth for plate in made.plates):
            yield said(
                "Mesh the wheels with all cranks as in Figure 2: a tooth further gives another linkage."
            )
        if made.scene.info.change_points:
            yield said("At a change point it can continue in two ways; guide it there with a finger.")

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
            heads = "", said("position"), said("question"), said("answers")
            yield html.table(said("Predict first; then turn the model to the position and look"), heads, rows)
        blank = [(what, "", "") for what, _ in self._measures()]
        if blank:
            columns = said("quantity"), said("measured"), said("calculated from the lengths")
            yield html.table(said("Measure on the model"), columns, blank)

    def _key(self, questions: Sequence[QuizQuestion]) -> Iterator[Part]:
        rows = [
            (str(n), *[") ".join([*_answers(one)][one.right]), one.why])
            for n, one in enumerate(questions, start=1)
        ]
        if rows:
            yield html.table(said("Predictions"), ("", said("answer"), said("reason")), rows)
        if measures := [*self._measures()]:
            yield html.table(said("Measures of the model"), (said("quantity"), said("value")), measures)

    def _measures(self) -> Iterator[tuple[str, str]]:
        """Yield the measures that can be taken on the model, with their values."""
        made, info = self.made, self.made.scene.info
        if info.stroke:
            yield said("stroke of the slider"), _mm(info.stroke * made.sizes.scale)
        if info.swing is not None:
            yield (
                said("swing of {link}", link=name_said(info.output_name)),
                f"{math.degrees(info.swing.stroke):.1f}°",
            )
        if info.time_ratio is not None:
            yield (
                said("time ratio: the input's angle for the slow stroke over that for the quick one"),
                f"{info.time_ratio:.2f}",
            )
        if info.transmission_angle is not None:
            least, most = (math.degrees(angle) for angle in info.transmission_angle)
            yield said("least and greatest transmission angle"), f"{least:.0f}°, {most:.0f}°"
        cycle = figure(made.scene).cycle
        for joint in made.scene.trace:
            wide, high = np.ptp(np.asarray(cycle.position[joint]) * made.sizes.scale, axis=0)
            yield (
                said("width and height of the curve of {joint}", joint=subscripted(joint)),
                f"{_mm(wide)}, {_mm(high)}",
            )


def _drawing(items: Iterable[Item], size: tuple[int, int], caption: str, highest: int) -> FigurePart:
    return FigurePart(svg(size, None, items, title=caption), caption, highest)


def _answers(question: QuizQuestion) -> Iterator[tuple[str, str]]:
    return ((letter, answer.text) for letter, answer in zip(LETTERS, question.answers, strict=False))


def _mm(length: float) -> str:
    return f"{significant(float(length), 4)} mm"


def _level(layer: int) -> str:
    return str(layer) if layer else name_said("ground")


def _named(pins: Sequence[MadePin]) -> str:
    """Return pins in words."""
    names = [subscripted(pin.name) for pin in pins]
    return said_many("pin {names}", "pins {names}", len(names), names=row_said(names))
