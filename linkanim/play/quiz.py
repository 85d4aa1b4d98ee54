"""Ask rounds of questions, the same ones for the same seed, and print them with their key."""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Iterator, Sequence
from html import escape
from random import Random

from linkanim.errors import BadInput, WorkFailed
from linkanim.explain.documents import body_style
from linkanim.mechanics.quantities import phrase
from linkanim.paper.figure import Figured
from linkanim.paper.html import embedded
from linkanim.paper.svg import svg
from linkanim.picture.drawn import Additions
from linkanim.picture.frame_words import lines_of
from linkanim.picture.look import Look
from linkanim.picture.marks import Spot, Spots
from linkanim.picture.quantities import speed_words, turned_words
from linkanim.picture.raster import Layer, offscreen, paint, png_bytes
from linkanim.picture.shapes import stroke
from linkanim.play.kinds import KINDS
from linkanim.play.question import Puzzle, QuestionId, QuizAnswer, QuizQuestion
from linkanim.scenes import load, names
from linkanim.scenes.scene import Scene
from linkanim.units import shown, stepped
from linkanim.words import html_language, name_said, said, said_as, sentences

# Rounds of questions about one scene or several, the same ones for the same seed.

_TRIES = 12
"""The phases that are tried for a kind before another kind is taken."""
_DECIMALS = 4
"""The decimals of a question's phase, in radians, so that it can be typed."""


def questions(
    scenes: Sequence[Scene], count: int, seed: int, progress: Callable[[int, int], None] = lambda *_: None
) -> tuple[QuizQuestion, ...]:
    """Return `count` questions, from the scenes one after the other.

    Kinds come in turn, as far as a scene has a question of each; none is asked twice about one subject unless
    the scene has nothing else. `progress` is called with (questions made, in all). WorkFailed where a scene
    has no question because nothing in it clearly moves.
    """
    asked: list[QuizQuestion] = []
    spent: set[tuple[str, str]] = set()
    for number in range(count):
        scene, before = scenes[number % len(scenes)], [one.question_id for one in asked]
        asked.append(next_question(scene, f"{seed} {number}", before, spent=spent))
        progress(number + 1, count)
    return tuple(asked)


def next_question(
    scene: Scene,
    seed: str,
    before: Sequence[QuestionId],
    kinds: Collection[str] = tuple(KINDS),
    *,
    spent: set[tuple[str, str]] | None = None,
) -> QuizQuestion:
    """Return a new question about a scene, of the kind that was asked least often.

    Where the scene has no question of the `kinds` asked for, another kind is taken. Kinds without a new
    question for a scene are added to `spent`, and not tried at length again. WorkFailed as in `questions`.
    """
    spent = set() if spent is None else spent
    random = Random(f"{seed} {scene.name}")
    asked = sorted(name for name, kind in KINDS.items() if scene.purpose or not kind.of_making)
    order = random.sample(asked, len(asked))
    often = [question_id.kind for question_id in before]
    order.sort(key=lambda kind: (kind not in kinds, often.count(kind)))
    known = {(question_id.scene, question_id.kind, question_id.subject) for question_id in before}
    spare = None
    for kind in order:
        if spare and (scene.name, kind) in spent:
            continue
        for _ in range(_TRIES):
            made = _made(kind, scene, round(random.uniform(0.0, scene.period), _DECIMALS))
            if made and (scene.name, kind, made.subject) not in known:
                return made
            spare = spare or made
            if spare and (scene.name, kind) in spent:
                break
        spent.add((scene.name, kind))
    if spare is None:
        raise WorkFailed(f"{scene.name}: nothing in it moves clearly enough for a question")
    return spare


def question_of(question_id: QuestionId) -> QuizQuestion:
    """Return a question of the catalogue again; BadInput where there is no such question."""
    if question_id.kind in KINDS and question_id.scene in names() and abs(question_id.phase) < 1e6:
        made = _made(question_id.kind, load(question_id.scene), question_id.phase)
        if made and made.subject == question_id.subject:
            return made
    raise BadInput(f"{shown(str(question_id))} is no question of this version")


def is_question(question_id: QuestionId) -> bool:
    """Tell whether a stored question can be asked by this version."""
    try:
        question_of(question_id)
    except BadInput:
        return False
    return True


def _made(kind: str, scene: Scene, phase: float) -> QuizQuestion | None:
    return KINDS[kind].make(Puzzle(kind, scene, phase, Random(f"{kind} {scene.name} {phase}")))


# A round of questions as a sheet to be printed, with its key on a page of its own.

_CURVE = (160, 34)
"""The size of a curve on a sheet, in pixels."""
_SHARPER = 3
"""A curve as a PNG has this many pixels for each of that size."""
_INK, _AXIS = (27, 31, 35), (140, 149, 159)
_PRINTED = 12
"""The number of a curve's values in plain text."""
LETTERS = "abcd"
_SIZE, _ON_PAPER = (480, 300), (344, 200)
"""A figure's size in pixels, and that of one on paper, which is 40 mm high with letters of 6 pt."""
_LAST = 2
"""The questions at the end that are kept together."""
_STYLE = (
    body_style("15px/1.45", 54)
    + """\
h1 { font-size: 1.7rem; line-height: 1.2; } h2 { font-size: 1.1rem; margin: 0 0 .3rem; }
section { display: grid; grid-template-columns: 1fr 1.1fr; gap: 0 1.5rem; break-inside: avoid;
          margin: 1.2rem 0; }
section > h2 { grid-column: 1 / -1; } figure { margin: 0; }
figure svg { width: 100%; height: auto; display: block; }
.posed { color: #57606a; font-size: .92em; margin: 0; }
ol.answers { list-style: lower-alpha; margin: .3rem 0; }
.signed { display: flex; gap: 2rem; } .signed span { flex: 1; border-bottom: 1px solid #57606a; }
.signed span:first-child { flex: 2; }
.key { break-before: page; } @page { size: A4; margin: 12mm 14mm; }
@media print { body { margin: 0; padding: 0; max-width: none; font-size: 9pt; line-height: 1.3; }
  h1 { font-size: 14pt; margin: 0 0 .3rem; } h2 { font-size: 10.5pt; } section { margin: .5rem 0; }
  section { grid-template-columns: 70mm 1fr; }
  section figure svg { height: 40mm; width: auto; }
  .last { break-inside: avoid; } h1, h2, .signed { break-after: avoid; } }
"""
)


def pose_words(question: QuizQuestion) -> str:
    """Return a question's scene, where its input is, and how fast and which way that runs."""
    scene, pose = question.scene, question.scene.pose(question.phase)
    drive = scene.linkage.drive
    running = speed_words(scene, drive.speed)
    if drive.coordinate.is_angle:
        # at a limit the input rests, and is about to turn back
        forth = (pose.coordinate_rate or pose.coordinate_second) > 0
        speed = speed_words(scene, abs(drive.speed))
        running = (
            said("{speed} counterclockwise", speed=speed) if forth else said("{speed} clockwise", speed=speed)
        )
    return said(
        "{title}, {link} at {place}, {speed}",
        title=said(scene.title),
        link=scene.info.input_said,
        place=turned_words(scene, pose.coordinate),
        speed=running,
    )


def question_figure(question: QuizQuestion, size: tuple[int, int] = _SIZE) -> Figured:
    """Return the figure of a question for paper: answers that are places are lettered dots."""
    look = Look(hud=False, trace=False, names=1)
    spots = (
        Spot(letter, one.place)
        for n, (letter, one) in enumerate(zip(LETTERS, question.answers, strict=False))
        if one.place and answer_text(question, n) != one.text
    )
    return Figured(question.scene, size, look, question.phase, beside=Additions((Spots(tuple(spots)),)))


def legend(question: QuizQuestion, size: tuple[int, int] = _SIZE) -> str:
    """Return what a question's figure does not say of links: their names, where it has numbers, and a place.

    A link that is asked about and has no label is told by its joints: "2 crank, 3 rod, h: E–F".
    """
    figured, names_ = question_figure(question, size), question.scene.info.link_names
    lines = [line for line in lines_of(figured.picture, question.phase) if line.of.startswith("body:")]
    labels = {line.of.partition(":")[2]: line.text for line in lines}
    entries = []
    for body in question.scene.linkage.bodies:
        label, word = labels.get(body.name), name_said(names_[body.name])
        asked = re.search(rf"{re.escape(phrase(body, names_))}(?![a-z0-9])", question.text)
        if label is None and asked:
            entries.append(
                said("{part}: {measure}", part=word, measure="–".join(body.joints[:2]) or body.slider)
            )
        elif label and label.isdecimal() and word != label:
            entries.append(f"{label} {word}")
    return said_as("list", ", ").join(entries)


def figure_words(question: QuizQuestion, size: tuple[int, int] = _SIZE) -> str:
    """Return what stands below a question's figure: where its input is, and names that it lacks."""
    return said_as("list", "; ").join(filter(None, (pose_words(question), legend(question, size))))


def answer_text(question: QuizQuestion, number: int) -> str:
    """Return an answer's words; for a place without a name in the figure, the letter of its dot."""
    answer = question.answers[number]
    joints = {joint.name for joint in question.scene.linkage.joints}
    named = answer.place is None or answer.text in joints
    return answer.text if named else said("at {letter}", letter=LETTERS[number])


def as_text(round_: Sequence[QuizQuestion]) -> str:
    """Return a round in plain text, the key below."""
    lines = []
    for number, question in enumerate(round_, 1):
        posed = said("{pose} (phase {phase} rad)", pose=pose_words(question), phase=f"{question.phase:g}")
        lines += [f"{number}. {question.text}", f"   {posed}"]
        shown = map(_worded, question.answers)
        lines += [f"   {letter}) {answer}" for letter, answer in zip(LETTERS, shown, strict=False)]
        lines.append("")
    lines.append(said("key"))
    lines += [f"{number}. {_key(question)}" for number, question in enumerate(round_, 1)]
    return "\n".join(lines)


def as_html(
    round_: Sequence[QuizQuestion], title: str, progress: Callable[[int, int], None] = lambda *_: None
) -> str:
    """Return a round as one page of HTML with a figure to each question, without a script.

    `progress` is called with (figures drawn, in all).
    """
    head = f"<meta charset='utf-8'><title>{escape(title)}</title><style>{_STYLE}</style>"
    sections = [*_sections(round_, progress)]
    # the last page has more than one question
    asked = *sections[:-_LAST], f"<div class='last'>{''.join(sections[-_LAST:])}</div>"
    signed = f"<p class='signed'><span>{said('Name')}</span><span>{said('Date')}</span></p>"
    head_lines = (f"<h1>{escape(title)}</h1>", signed)
    body = "\n".join([*head_lines, *asked, *_key_page(round_, title)])
    inside = f"<body>\n<main>\n{body}\n</main>\n</body>"
    return f"<!doctype html>\n<html lang='{html_language()}'><head>{head}</head>{inside}</html>\n"


def _sections(round_: Sequence[QuizQuestion], progress: Callable[[int, int], None]) -> Iterator[str]:
    for number, question in enumerate(round_, 1):
        drawn = question_figure(question, _ON_PAPER).document()
        words = figure_words(question, _ON_PAPER)
        answers = "".join(
            f"<li>{escape(answer_text(question, n))}{_drawn(one.curve)}</li>"
            for n, one in enumerate(question.answers)
        )
        yield (
            f"<section><h2>{number}. {escape(question.text)}</h2>"
            f"<figure>{embedded(drawn, words)}</figure>"
            f"<div><p class='posed'>{escape(words)}</p><ol class='answers'>{answers}</ol></div></section>"
        )
        progress(number, len(round_))


def _key_page(round_: Sequence[QuizQuestion], title: str) -> Iterator[str]:
    heading = escape(said("Key: {title}", title=title))
    yield f"<div class='key'><h1>{heading}</h1><ol>"
    yield from (
        f"<li>{escape(_key(question))}<br><small>{escape(_slips(question))}</small></li>"
        for question in round_
    )
    yield "</ol></div>"


def _worded(answer: QuizAnswer) -> str:
    """Return an answer, with some values of its curve, evenly over the period."""
    values = answer.curve[:: max(len(answer.curve) // _PRINTED, 1)]
    shown = " ".join(stepped(value, 0.01) for value in values)
    return said("{curve}: {values}", curve=answer.text, values=shown) if values else answer.text


def _drawn(curve: Sequence[float]) -> str:
    """Return a curve as an SVG of its own; empty where there is no curve."""
    if not curve:
        return ""
    title = said("a curve")
    return f"<br>{embedded(svg(_CURVE, None, _curve_layers(curve), title=title), title)}"


def curve_png(curve: Sequence[float]) -> bytes:
    """Return a curve that is an answer as a PNG file's bytes, on white."""
    width, height = _CURVE
    surface = offscreen((_SHARPER * width, _SHARPER * height))
    surface.fill((255, 255, 255))
    paint(surface, _curve_layers(curve, _SHARPER))
    return png_bytes(surface)


def _curve_layers(curve: Sequence[float], scale: float = 1.0) -> list[Layer]:
    """Return a curve of values from −1 to 1 over its axis, a pixel of its size `scale` wide."""
    width, height = _CURVE
    step = width / (len(curve) - 1)
    path = [complex(n * step, height / 2 * (1 - 0.94 * value)) for n, value in enumerate(curve)]
    axis = [complex(0, height / 2), complex(width, height / 2)]
    lines = ((_AXIS, axis, 0.5), (_INK, path, 1.1))
    return [
        Layer(colour, stroke([scale * place for place in line], scale * wide)) for colour, line, wide in lines
    ]


def _slips(question: QuizQuestion) -> str:
    """Return, in words, the misconceptions from which the wrong answers come."""
    answers = zip(LETTERS, question.answers, strict=False)
    return said_as("list", "; ").join(f"{letter}) {answer.slip}" for letter, answer in answers if answer.slip)


def _key(question: QuizQuestion) -> str:
    right = said("{found}.", found=answer_text(question, question.right))
    return f"{LETTERS[question.right]}) {sentences(right, question.why)}"
