"""Measure what is said on pictures: letters that stand wrong, what lies over what, what a frame leaves empty.

Each rule is checked on finished pictures alone: on the places of joints and links, and on the boxes of all
words. `python tests/measure/stage.py` prints how often each is broken, over all scenes, sizes and looks; with
a number, over so many random linkages.
"""

from __future__ import annotations

import sys
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from itertools import combinations
from math import hypot, inf
from pathlib import Path
from typing import NamedTuple

from linkanim.mechanics.motion import Pose
from linkanim.picture.fit import of_linkage
from linkanim.picture.frame_words import Labelled, lines_of
from linkanim.picture.look import Look
from linkanim.picture.picture import Picture
from linkanim.picture.stills import still_phase
from linkanim.picture.view import Rect
from linkanim.scenes import load, names
from linkanim.scenes.scene import Scene

PHASES = 24
SIZES = ((1280, 720), (1920, 1080), (960, 540), (640, 360), (320, 180), (720, 1280))
"""The sizes of moving pictures; stills have those of `STILLS`."""
STILLS = {"book": ((992, 744), 1.84), "page": ((1890, 1063), 1.03), "slide": ((1920, 1080), 1.57)}
"""The sizes of stills for a book, a page and a slide, and how much larger words are there."""
LOOKS = ("names", "dimensions", "vectors", "centres", "polygons")
ON_PART = ("joint", "body", "dimension", "vector", "angle", "dead-centre", "centre")
"""The kinds of words that stand on the linkage; all others stand in slots."""
SLOTS = ("readout", "legend", "axis", "caption")
TOGETHER = 2.2
"""Joints nearer to each other than this, in heights of letters, excuse faults of a moving picture."""
CLOSE = 1.2
CROWDED = 0.1
RULES = (
    "nearest",
    "close",
    "own link",
    "over pins",
    "over heads",
    "over words",
    "outside",
    "slots",
    "margins",
)


def looks(scene: Scene) -> dict[str, Look]:
    """Return the looks that are measured, with a chart of the scene's first quantity."""
    token = next(iter(scene.quantities))
    return {
        "names": Look(names=1),
        "dimensions": Look(names=2),
        "vectors": Look(names=1, vectors=frozenset("va")),
        "centres": Look(names=1, centres=1),
        "polygons": Look(names=1, polygons=True, chart=token),
    }


class Fault(NamedTuple):
    """A rule that a picture breaks, and what of it breaks it."""

    rule: str
    what: str
    phase: float = 0.0


def of_moving(scene: Scene, size: tuple[int, int], look: Look, phases: int = PHASES) -> Iterator[Fault]:
    """Yield the faults of a moving picture, at phases spread over its period."""
    picture = Picture(scene, size, look)
    crowded: Counter[tuple[str, str]] = Counter()
    for n in range(phases):
        phase = scene.period * n / phases
        for fault in _of_frame(picture, phase, still=False):
            if fault.what.startswith("body:"):
                crowded[fault.rule, fault.what] += 1
            else:
                yield fault
    for (rule, what), count in crowded.items():
        if count > CROWDED * phases:
            yield Fault(rule, f"{what} in {count} of {phases}")


def of_still(scene: Scene, size: tuple[int, int], look: Look, phase: float | None = None) -> Iterator[Fault]:
    """Yield the faults of a still, of the pose that it would show."""
    phase = still_phase(scene) if phase is None else phase
    picture = Picture(scene, size, look, moment=phase, apart=True)
    yield from _of_frame(picture, phase, still=True)
    yield from _margins(picture, phase)


def _of_frame(picture: Picture, phase: float, *, still: bool) -> Iterator[Fault]:
    words = lines_of(picture, phase)
    pose, _ = picture.poses(phase)
    frame = _Frame(picture, pose, words, still)
    for fault in frame.faults():
        yield fault._replace(phase=phase)


class _Frame:
    """A frame: where its joints, links, pins and heads are, and its words."""

    def __init__(self, picture: Picture, pose: Pose, words: Sequence[Labelled], still: bool) -> None:
        self.picture, self.pose, self.still = picture, pose, still
        self.places = {name: picture.view.pixel(at) for name, at in pose.position.items()}
        self.words = words
        self.on_part = [one for one in words if one.of.partition(":")[0] in ON_PART]
        figure, gauge = picture.figure, picture.gauge
        self.em = picture.layout.label_size
        self.rim = gauge.bar + gauge.outline
        self.pins = {name: self.places[name] for name in figure.pins}
        self.heads = [
            (one.of, one.foot + one.reach)
            for kind in picture.drawing.arrows
            for one in kind.seen(pose, picture.view, figure.moving)
        ]
        led = {label.of for label in picture.names.labels if label.leader}
        self.led = led
        self.links = {
            f"body:{body.name}": [
                (self.places[one], self.places[other]) for one, other in combinations(body.joints, 2)
            ]
            for body in figure.bodies
            if body.name
        }

    def faults(self) -> Iterator[Fault]:
        """Yield all faults but those of margins."""
        for one in self.on_part:
            yield from self._of_label(one)
        for one, other in combinations(self.on_part, 2):
            if _inner(one.box).meets(_inner(other.box)) and not self._excused(one, other):
                yield Fault("over words", f"{one.of}" if not other.of.startswith("body:") else other.of)
        width, height = self.picture.size
        for one in self.words:
            box = one.box
            if box.x < -0.5 or box.y < -0.5 or box.right > width + 0.5 or box.bottom > height + 0.5:
                yield Fault("outside", one.of)
        yield from self._slots()

    def _of_label(self, one: Labelled) -> Iterator[Fault]:
        kind, _, name = one.of.partition(":")
        middle, box = one.box.middle, _inner(one.box)
        if kind == "joint" and not self._excused(one):
            own = abs(self.places[name] - middle)
            far = [abs(at - middle) for other, at in self.places.items() if abs(at - self.places[name]) > 0.5]
            if one.of not in self.led and min(far, default=inf) < own:
                yield Fault("nearest", one.of)
        if kind == "joint" and one.of not in self.led:
            gap = _off(one.box, self.places[name])
            rim = self.rim + (
                2.2 * self.picture.gauge.bar if self.picture.figure.linkage.joint(name).travels else 0
            )
            if abs(self.places[name] - middle) > rim + CLOSE * self.em and gap > rim + 0.5 * self.em:
                yield Fault("close", one.of)
        if kind == "body" and one.of in self.links and one.of not in self.led:
            own = min(_off_line(middle, *line) for line in self.links[one.of])
            touch = min(_rect_off_line(one.box, *line) for line in self.links[one.of])
            others = [
                _off_line(middle, *line) for of, lines in self.links.items() if of != one.of for line in lines
            ]
            if len(self.links[one.of]) == 1:
                if touch > self.rim + 0.5 * self.picture.layout.small_size:
                    yield Fault("own link", f"{one.of} off")
                if min(others, default=inf) < own - 1.0:
                    yield Fault("own link", one.of)
        if not self._excused(one):
            pin = self.picture.gauge.pin
            if any(_off(box, at) < pin for at in self.pins.values()):
                yield Fault("over pins", one.of)
            if any(_off(box, at) < 1.0 for of, at in self.heads):
                yield Fault("over heads", one.of)

    def _excused(self, *labels: Labelled) -> bool:
        """Return whether joints of these labels are so near to others that faults are excused."""
        if self.still:
            return False
        names_ = [one.of.partition(":")[2] for one in labels if one.of.startswith("joint:")]
        return any(
            abs(self.places[name] - at) < TOGETHER * self.em
            for name in names_
            for other, at in self.places.items()
            if other != name
        )

    def _slots(self) -> Iterator[Fault]:
        """Yield words in slots that lie over the linkage, or over words on it."""
        lines = [line for sides in self.links.values() for line in sides]
        for one in self.words:
            if one.of.partition(":")[0] not in SLOTS:
                continue
            box = _inner(one.box)
            if any(_rect_off_line(box, *line) < self.rim for line in lines):
                yield Fault("slots", f"{one.of} over a link")
            if any(_off(box, at) < self.rim for at in self.pins.values()):
                yield Fault("slots", f"{one.of} over a pin")
            if any(box.meets(_inner(other.box)) for other in self.on_part):
                yield Fault("slots", f"{one.of} over a name")


def _margins(picture: Picture, phase: float) -> Iterator[Fault]:
    """Yield faults of a still's frame: too small a linkage, or more empty than one margin."""
    composition = picture.composition
    stage = composition.layout.stage
    margin = 0.04 * min(picture.size)
    drawn = composition.extent.pixels(picture.view)
    gaps = (
        min(drawn.x - stage.x, stage.right - drawn.right),
        min(drawn.y - stage.y, stage.bottom - drawn.bottom),
    )
    if min(gaps) > margin + 1.5:
        yield Fault("margins", f"empty {min(gaps):.0f} px for {margin:.0f}")
    linkage = of_linkage(picture.figure, picture.gauge, phase).pixels(picture.view)
    wide, high = linkage.width, linkage.height
    layout, size = composition.layout, picture.size
    room = (stage.width, stage.height) if layout.polygons or layout.chart else size
    share = max(wide / room[0], high / room[1])
    if share < 0.55:
        yield Fault("margins", f"linkage {share:.0%}")


def _inner(box: Rect) -> Rect:
    """Return the letters' part of a line's box: without the room above and below them."""
    return Rect(box.x + 0.5, box.y + 0.12 * box.height, max(box.width - 1, 0), 0.72 * box.height)


def _off(box: Rect, at: complex) -> float:
    return hypot(max(box.x - at.real, 0, at.real - box.right), max(box.y - at.imag, 0, at.imag - box.bottom))


def _off_line(at: complex, begin: complex, end: complex) -> float:
    way = end - begin
    share = min(max(((at - begin) * way.conjugate()).real / max(abs(way) ** 2, 1e-12), 0.0), 1.0)
    return abs(at - begin - share * way)


def _rect_off_line(box: Rect, begin: complex, end: complex) -> float:
    if box.crossed(begin, end) is not None:
        return 0.0
    corners = [complex(x, y) for x in (box.x, box.right) for y in (box.y, box.bottom)]
    return min(*(_off_line(corner, begin, end) for corner in corners), _off(box, begin), _off(box, end))


def measured(
    scenes: Iterable[Scene],
    *,
    told: bool = False,
    sizes: Sequence[tuple[int, int]] = SIZES,
    of: Sequence[str] = LOOKS,
) -> dict[str, Counter[str]]:
    """Return how often each rule is broken, by kind of picture."""
    found: dict[str, Counter[str]] = {}
    for scene in scenes:
        for look_name, look in ((name, look) for name, look in looks(scene).items() if name in of):
            for size in sizes:
                faults = [*of_moving(scene, size, look)]
                _count(found, f"moving {size[0]}x{size[1]}", scene, look_name, faults, told=told)
            for name, (size, scale) in STILLS.items():
                still = [*of_still(scene, size, still_look(look, scale))]
                _count(found, f"still {name}", scene, look_name, still, told=told)
    return found


def still_look(look: Look, scale: float) -> Look:
    """Return the look of a still that shows the same."""
    return replace(look, type_scale=scale, hud=False, chart=None)


def _count(
    found: dict[str, Counter[str]], kind: str, scene: Scene, look: str, faults: Sequence[Fault], *, told: bool
) -> None:
    rules = found.setdefault(f"{kind}, {look}", Counter())
    rules.update(fault.rule for fault in faults)
    if told:
        for (rule, what), count in Counter((fault.rule, fault.what) for fault in faults).items():
            print(f"  {kind}, {look}: {scene.name}: {rule}: {what} ({count})")


def table(found: dict[str, Counter[str]]) -> str:
    """Return the counts as a table."""
    lines = [f"| picture | {' | '.join(RULES)} |", f"|---|{'---:|' * len(RULES)}"]
    lines += [
        f"| {kind} | {' | '.join(str(rules[rule]) for rule in RULES)} |" for kind, rules in found.items()
    ]
    return "\n".join(lines)


def _random(count: int) -> dict[str, Counter[str]]:
    """Return the same of random linkages of four and five links, at one size."""
    sys.path.insert(0, str(Path(__file__).parents[1] / "mechanics"))
    from few_links import drawn

    few = map(drawn, range(count))
    return measured(few, told=True, sizes=SIZES[:1], of=("names", "dimensions", "vectors"))


if __name__ == "__main__":
    chosen = sys.argv[1:] or names()
    numbered = chosen[0].isdecimal()
    print(table(_random(int(chosen[0])) if numbered else measured(map(load, chosen), told=True)))
