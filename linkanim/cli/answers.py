"""Answers of a synthesis: as scene files, and on stdout as a table or JSON."""

from __future__ import annotations

from argparse import Namespace
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Protocol, TypeVar

from linkanim.atomic_files import checked_target
from linkanim.export import columns, json_text
from linkanim.scenes.scene import Scene
from linkanim.synthesis.answers import file_set, names_of, write
from linkanim.synthesis.drivers import Motor


class Designed(Protocol):
    """An answer of a synthesis."""

    @property
    def scene(self) -> Scene:
        """The linkage."""


Answer = TypeVar("Answer", bound=Designed)


def target_of(output: Path | None, name: str, count: int) -> Path:
    """Return where the first answer goes: what `-o` names, else `name`.

    BadInput where a name that one of `count` answers will have is not ours to write.
    """
    target = checked_target(output or Path(name), (".toml",))
    there = {path.name for path in target.parent.iterdir()}
    file_set(target).refuse_foreign(name for name in names_of(target, count) if name in there)
    return target


def deliver(
    answers: Sequence[Answer],
    target: Path,
    options: Namespace,
    titles: Sequence[str],
    cells: Callable[[Answer], Sequence[str]],
    values: Callable[[Answer], dict[str, object]],
) -> None:
    """Write the answers' files, and print each file with its `cells` in a table, or its `values` as JSON."""
    files = [str(file) for file in write([one.scene for one in answers], target)]
    rows = list(zip(files, answers, strict=True))
    if options.json:
        print(json_text([{"file": file} | values(one) for file, one in rows], indent=2))
    else:
        print(columns([("file", *titles), *((file, *cells(one)) for file, one in rows)]))


def motor_of(options: Namespace) -> Motor:
    """Return where a driver's motor is asked to stand, or whether a driver is wanted."""
    return options.motor or bool(options.driver)
