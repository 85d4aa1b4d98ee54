"""`linkanim quiz`: questions about a scene or a chapter, made from solved values, with their key."""

from __future__ import annotations

from argparse import Namespace
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

from linkanim.atomic_files import checked_target, replacing
from linkanim.bounds import MOST_ASKED
from linkanim.cli.options import inputs_of
from linkanim.cli.progress import bar
from linkanim.errors import BadInput
from linkanim.export import json_text
from linkanim.play.games import ALL
from linkanim.play.platforms import Rounds, moodle, qti
from linkanim.play.question import QuizQuestion
from linkanim.play.quiz import as_html, as_text, questions
from linkanim.scenes import chapter_of, chapters, load, names
from linkanim.scenes.scene import Scene
from linkanim.words import said, said_many

_MOST = 200

Printer = Callable[[Sequence[QuizQuestion], str, Callable[[int, int], None]], bytes]


def _sheet(asked: Sequence[QuizQuestion], title: str, progress: Callable[[int, int], None]) -> bytes:
    return as_html(
        asked,
        said("{title}: {part}", title=title, part=said_many("one question", "{count} questions", len(asked))),
        progress,
    ).encode()


def _moodle(asked: Sequence[QuizQuestion], title: str, progress: Callable[[int, int], None]) -> bytes:
    return moodle(_by_chapter(asked, title), progress)


def _qti(asked: Sequence[QuizQuestion], title: str, progress: Callable[[int, int], None]) -> bytes:
    return qti(_by_chapter(asked, title), title, progress)


OUTPUTS: Mapping[str, tuple[tuple[str, ...], Printer]] = {
    "output": ((".html", ".htm"), _sheet),
    "moodle": ((".xml",), _moodle),
    "qti": ((".zip",), _qti),
}
"""The files of a round, by option: the endings of a file's name, and the function that makes its bytes."""


def run(options: Namespace) -> None:
    """Print the round, or write it as the files that are asked for and print their paths.

    `BadInput`, before any question is made, for an output that cannot be written, and for no questions or
    more than the scenes' joints allow.
    """
    targets: list[tuple[Path, Printer]] = []
    for name, (suffixes, printer) in OUTPUTS.items():
        path = getattr(options, name)
        if path is not None:
            targets.append((checked_target(path, suffixes, inputs_of(options)), printer))
    if not 1 <= options.count <= _MOST:
        raise BadInput(f"-n {options.count}: give a number of questions from 1 to {_MOST}")
    if targets and options.json:
        raise BadInput("-o, --moodle and --qti write files, --json prints a list; leave one of them out")
    scenes, title = _scenes(options.scene)
    _refuse_many(scenes, options.count)
    with bar(unit=" questions") as progress:
        asked = questions(scenes, options.count, options.seed, progress)
    if not targets:
        print(json_text([_as_object(one) for one in asked], indent=2) if options.json else as_text(asked))
    for target, printer in targets:
        with bar(unit=" figures") as progress:
            content = printer(asked, title, progress)
        with replacing(target) as part:
            part.write_bytes(content)
        print(target)


def _by_chapter(asked: Sequence[QuizQuestion], title: str) -> Rounds:
    """Return questions by the chapter of their scene; for a scene outside the catalogue, by its title."""
    rounds: dict[str, list[QuizQuestion]] = {}
    for question in asked:
        chapter = chapter_of(question.scene.name)
        heading = said(chapter) if chapter else title
        rounds.setdefault(heading[:1].upper() + heading[1:], []).append(question)
    return rounds


def _refuse_many(scenes: Sequence[Scene], count: int) -> None:
    """Refuse more questions than can be made, and drawn, for scenes with their number of joints."""
    joints = sum(len(scene.linkage.joints) for scene in scenes) / len(scenes)
    if count * joints**2 > MOST_ASKED:
        most = max(int(MOST_ASKED / joints**2), 1)
        raise BadInput(
            f"-n {count}: of scenes of {joints:.0f} joints a round has {most} questions at the most; "
            f"take {most} or fewer"
        )


def _scenes(name: str) -> tuple[tuple[Scene, ...], str]:
    """Return the scenes of a chapter (with spaces or dashes in its name), all, or one scene; and a title."""
    if name == ALL:
        return tuple(map(load, names())), said("All mechanisms")
    by_name = {chapter.replace(" ", "-"): names for chapter, names in chapters().items()}
    chosen = by_name.get(name.replace(" ", "-"))
    if chosen is None:
        scene = load(name)
        return (scene,), said(scene.title)
    return tuple(map(load, chosen)), said(name.replace("-", " ")).capitalize()


def _as_object(question: QuizQuestion) -> dict[str, object]:
    answers, slips, _, curves, _ = zip(*question.answers, strict=True)
    document = {"scene": question.scene.name, "kind": question.kind, "phase": question.phase}
    document |= {
        "subject": question.subject,
        "answers": answers,
        "right": question.right,
        "why": question.why,
    }
    shown = {"curves": curves} if all(curves) else {}
    return {**document, "slips": slips, **shown, "question": question.text}
