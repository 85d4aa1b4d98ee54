"""`linkanim check`: every problem of scene files at once, each with its line."""

from __future__ import annotations

from argparse import Namespace
from collections.abc import Iterator
from itertools import chain
from pathlib import Path
from typing import NamedTuple

from linkanim import intake
from linkanim.cli.progress import along
from linkanim.errors import BadInput
from linkanim.export import json_text
from linkanim.scenes import load
from linkanim.scenes.reading import Problem, problems
from linkanim.scenes.scene import Scene
from linkanim.scenes.schema import SCHEMA
from linkanim.scenes.toml import SCENE_FILE
from linkanim.units import degrees


class Checked(NamedTuple):
    """A file, its problems, and its scene if there are no problems."""

    file: str
    problems: list[Problem]
    scene: Scene | None

    def lines(self) -> Iterator[str]:
        """Yield what is printed of it: its title and class, or a line for each problem."""
        if self.scene is not None:
            notes = "".join(f"; {note}" for note in _notes(self.scene))
            yield f"{self.file}: good: {self.scene.title}: {self.scene.info.class_name}{notes}"
        for line, message in self._listed:
            yield f"{self.file}{'' if line is None else f':{line}'}: {message}"

    def as_object(self) -> dict[str, object]:
        """Return what `--json` prints of it."""
        listed = [{"line": line, "message": message} for line, message in self._listed]
        scene = self.scene and {
            "title": self.scene.title,
            "class": self.scene.info.class_name,
            "notes": _notes(self.scene),
        }
        return {"file": self.file, "good": not listed, "problems": listed, "scene": scene or None}

    @property
    def _listed(self) -> list[tuple[int | None, str]]:
        return [(one.line, one.message.removeprefix(f"{self.file}: ")) for one in self.problems]


def run(options: Namespace) -> None:
    """Print the problems of each file, or its title and class; `BadInput` where there is any problem."""
    if options.schema:
        print(json_text(SCHEMA, indent=2))
        return
    if not options.files:
        raise BadInput("name the scene files to check, such as `linkanim check my-linkage.toml`")
    checked = [_checked(Path(file)) for file in along(options.files, " files", len(options.files))]
    if options.json:
        print(json_text([one.as_object() for one in checked], indent=2))
    else:
        print("\n".join(chain.from_iterable(one.lines() for one in checked)))
    wrong = [one for one in checked if one.problems]
    if wrong:
        count = sum(len(one.problems) for one in wrong)
        raise BadInput(f"{_count(count, 'problem')} in {len(wrong)} of {_count(len(checked), 'file')}")


def _count(number: int, noun: str) -> str:
    return f"{number} {noun}{'s' * (number != 1)}"


def _checked(path: Path) -> Checked:
    where = intake.named(path)
    try:
        text = SCENE_FILE.read(path, where)
    except BadInput as error:
        return Checked(where, [Problem(str(error))], None)
    problems_there = problems(text, name=path.stem, where=where)
    return Checked(where, problems_there, None if problems_there else load(path))


def _notes(scene: Scene) -> list[str]:
    """Return notes on what a scene states without effect."""
    return [*_unreached(scene), *_unshown(scene)]


def _unreached(scene: Scene) -> Iterator[str]:
    start = scene.info.unreached_start
    if start is not None:
        yield f"drive.start = {degrees(start)} is not reached: the input {scene.info.input_words}"


def _unshown(scene: Scene) -> Iterator[str]:
    """Yield why the photograph is not shown, if it is not."""
    if photo := scene.document.get("photo"):
        from linkanim.picture.photograph import lack

        if reason := lack(photo["file"]):
            yield reason
