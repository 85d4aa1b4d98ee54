"""`linkanim examples`: numbered examples to copy and change, listed or copied."""

from __future__ import annotations

import re
from argparse import Namespace
from pathlib import Path

from linkanim.atomic_files import add, checked_folder, made_folder
from linkanim.errors import BadInput
from linkanim.intake import meant
from linkanim.units import shown

FOLDER = Path(__file__).parents[2] / "examples"
_NUMBERED = re.compile(r"\d\d-")


def run(options: Namespace) -> None:
    """List the examples, or copy those that are named; an existing file is never replaced."""
    if not options.names:
        if options.output is not None:
            raise BadInput("name what to copy, such as `linkanim examples 06`, or `linkanim examples all`")
        print(_listed())
        return
    folder = checked_folder(Path() if options.output is None else options.output)
    files = {
        folder / name: (FOLDER / name).read_bytes()
        for name in dict.fromkeys(one for word in options.names for one in _named(word))
    }
    there = [target for target in files if target.exists()]
    if changed := [
        target for target in there if not (target.is_file() and target.read_bytes() == files[target])
    ]:
        raise BadInput(f"{changed[0]} is there already and is not the example; name another folder with -o")
    made_folder(folder)
    for target, content in files.items():
        print(target if target in there else add(content, target))


def _listed() -> str:
    every = _names()
    width = max(map(len, every))
    lines = [f"{name:<{width}}  {_about(name)}" for name in every]
    return "\n".join(
        [*lines, "", "linkanim examples 06 copies one of them, linkanim examples all copies all."]
    )


def _names() -> list[str]:
    """Return the files' names: the numbered ones, then the data that they and the manual read."""
    files = (path.name for path in FOLDER.iterdir() if path.is_file())
    return sorted(files, key=lambda name: (not _NUMBERED.match(name), name))


def _about(name: str) -> str:
    """Return what an example shows, from its first lines."""
    if not _NUMBERED.match(name):
        return "data for an example or for the manual"
    match = re.search(rf"\b{name[:2]}  ([^\n\"\\]+)", _head(name))
    return match[1].partition(":  ")[0].strip().rstrip(".,") if match else ""


def _head(name: str) -> str:
    return (FOLDER / name).read_text(encoding="utf-8")[:400]


def _named(word: str) -> list[str]:
    """Return the files that a word names: a number, a file's name with or without its ending, or all."""
    every = _names()
    if word == "all":
        return every
    number = f"{word:0>2}-"
    matching = [name for name in every if word in (name, Path(name).stem) or name.startswith(number)]
    if not matching:
        raise BadInput(
            f"no example is called {shown(word)}{meant(word, every)}; `linkanim examples` lists them"
        )
    return [*matching, *(name for name in every if not _NUMBERED.match(name) and name in _head(matching[0]))]
