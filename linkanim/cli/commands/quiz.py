"""`linkanim quiz`: questions about a scene or a chapter, made from what is solved, with their key."""

from __future__ import annotations

from argparse import Namespace
from collections.abc import Sequence

from linkanim.atomic_files import checked_target, write_text
from linkanim.bounds import MOST_ASKED
from linkanim.cli.commands.record import bar
from linkanim.cli.options import inputs_of
from linkanim.errors import BadInput
from linkanim.export import json_text
from linkanim.play.question import QuizQuestion
from linkanim.play.round import questions
from linkanim.play.sheet import as_html, as_text
from linkanim.scenes import chapters, load
from linkanim.scenes.scene import Scene

SUFFIXES = (".html", ".htm")
_MOST = 200


def run(options: Namespace) -> None:
    """Print the round, or write it as a sheet and print its path.

    `BadInput` for an output that cannot be, and for no questions or too many of so large scenes, before any
    is made.
    """
    target = None if options.output is None else checked_target(options.output, SUFFIXES, inputs_of(options))
    if not 1 <= options.count <= _MOST:
        raise BadInput(f"-n {options.count}: give a number of questions from 1 to {_MOST}")
    if target and options.json:
        raise BadInput("-o writes a sheet, --json prints a list; leave one of them out")
    scenes, title = _scenes(options.scene)
    _refuse_many(scenes, options.count)
    with bar(unit=" questions") as progress:
        found = questions(scenes, options.count, options.seed, progress)
    if target is None:
        print(json_text([_as_object(one) for one in found], indent=2) if options.json else as_text(found))
        return
    with bar(unit=" figures") as progress:
        page = as_html(found, f"{title}: {len(found)} questions", progress)
    write_text(target, page)
    print(target)


def _refuse_many(scenes: Sequence[Scene], count: int) -> None:
    """Refuse more questions than can be made, and drawn, of scenes of so many joints."""
    joints = sum(len(scene.linkage.joints) for scene in scenes) / len(scenes)
    if count * joints > MOST_ASKED:
        most = max(int(MOST_ASKED / joints), 1)
        raise BadInput(
            f"-n {count}: of scenes of {joints:.0f} joints a round has {most} questions at the most; "
            f"take {most} or fewer"
        )


def _scenes(name: str) -> tuple[tuple[Scene, ...], str]:
    """Return the scenes of a chapter, named as `linkanim scenes` does or with dashes, or one scene."""
    by_name = {chapter.replace(" ", "-"): names for chapter, names in chapters().items()}
    chosen = by_name.get(name.replace(" ", "-"))
    if chosen is None:
        scene = load(name)
        return (scene,), scene.title
    return tuple(map(load, chosen)), name.replace("-", " ").capitalize()


def _as_object(question: QuizQuestion) -> dict[str, object]:
    answers, slips, _, curves = zip(*question.answers, strict=True)
    found = {"scene": question.scene.name, "kind": question.kind, "phase": question.phase}
    found |= {"subject": question.subject, "answers": answers, "right": question.right, "why": question.why}
    shown = {"curves": curves} if all(curves) else {}
    return {**found, "slips": slips, **shown, "question": question.text}
