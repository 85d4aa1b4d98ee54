"""Scenes and tapes are data: nothing in them is evaluated, and nothing here asks the network or a shell."""

from __future__ import annotations

import ast
import json
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from types import CodeType
from unicodedata import normalize

import numpy as np
import pytest

import linkanim
from linkanim.mechanics import program
from linkanim.scenes.reading import scene_from
from linkanim.scenes.toml import parse

PACKAGE = Path(linkanim.__file__).parent

SMUGGLED = [
    "__import__('os')._exit(7)".replace(".", "\u00b7"),  # a name has no dot
    "A):exec(input()",
    "{0}{pose}",
    "x\\ny=1#",
    "lambda:0",
    '"""+a+"""',
    "';DROP",
]


@pytest.fixture
def sources(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """Return the text of all that is compiled from now on."""
    compiled: list[str] = []

    def watched(source: str, name: str, mode: str) -> CodeType:
        compiled.append(source)
        return compile(source, name, mode)

    monkeypatch.setattr(program, "compile", watched, raising=False)
    return compiled


def hostile(text: str) -> str:
    """Return a scene in which every name and every text is the same hostile one, numbered."""
    q = [json.dumps(f"{text}{k}") for k in range(9)]
    return f"""
title = {q[0]}
source = {q[0]}
[ground]
{q[1]} = [0, 0]
{q[2]} = [100, 0]
[joints.{q[3]}]
crank = {q[1]}
length = 30
[joints.{q[4]}]
from = [{q[3]}, {q[2]}]
length = [90, 80]
[joints.{q[5]}]
on = [{q[3]}, {q[4]}]
at = [10, 20]
[bodies]
{q[6]} = {{ joints = [{q[3]}, {q[4]}, {q[5]}], com = [1, 2] }}
[springs.{q[7]}]
between = [{q[5]}, {q[2]}]
[dampers.{q[8]}]
between = [{q[5]}, {q[1]}]
[trace]
joints = [{q[5]}]
"""


@pytest.mark.parametrize("text", SMUGGLED)
def test_names_are_but_keys_in_the_formulas(text: str, sources: list[str]) -> None:
    scene = scene_from(parse(hostile(text), "my.toml"), name=text, where="my.toml")
    motion = scene.solve(phase=np.linspace(0, 6, 9))
    assert all(np.isfinite(points).all() for points in motion.position.values())
    assert set(scene.pose(0.5).position) == {f"{text}{k}" for k in range(1, 6)}
    assert scene.info.lines
    assert sources
    given: set[object] = set()
    texts: list[object] = []
    for source in sources:
        for node in ast.walk(ast.parse(source)):
            assert not isinstance(node, ast.Import | ast.ImportFrom | ast.Attribute | ast.Lambda)
            if isinstance(node, ast.Dict):
                keys = [key.value for key in node.keys if isinstance(key, ast.Constant)]
                assert len(keys) == len(node.keys)
                given.update(keys)
            if isinstance(node, ast.Constant) and isinstance(node.value, str):
                texts.append(node.value)
            assert not (isinstance(node, ast.Name) and node.id.startswith("__")), node.id
    # a name stands whole, as a text and the key of a value, or not at all; beside it are a pose's own fields
    assert set(texts) == given <= {f"{text}{k}" for k in range(9)} | vars(scene.pose(0.5)).keys()


OPENED = {"manual.py": {"webbrowser"}, "files.py": {"webbrowser"}}
"""The manual opens the page that it has written, a click on a message the folder of its file."""
WRITTEN = ("program.py", "frozen.py")
"""What these compile they write themselves: formulas, with names as keys only, and the fields of classes."""
NEVER = {"socket", "ssl", "http", "urllib", "ftplib", "smtplib", "requests", "webbrowser", "pickle"}


def ways_out(path: Path) -> Iterator[str]:
    # as Python reads names; what none of the words is in need not be taken apart
    text = normalize("NFKC", path.read_text(encoding="utf-8"))
    if not any(word in text for word in {*NEVER, "eval", "exec", "shell"}):
        return
    for node in ast.walk(ast.parse(text)):
        match node:
            case ast.Import(names=names):
                yield from {name.name.split(".")[0] for name in names} & NEVER - OPENED.get(path.name, set())
            case ast.ImportFrom(module=str(module), level=0) if module.split(".")[0] in NEVER:
                yield module
            case ast.Call(func=ast.Name(id="eval" | "exec" as call)) if path.name not in WRITTEN:
                yield call
            case ast.keyword(arg="shell"):
                yield "a shell"


def test_no_file_imports_a_way_out() -> None:
    assert [(path, way) for path in sorted(PACKAGE.rglob("*.py")) for way in ways_out(path)] == []


# What the interpreter itself reports of a run: every socket, every shell, every process.
WATCHED = """
import json, sys
seen, started = [], []
def watch(event, words):
    if event.startswith("socket.") or event in ("os.system", "os.exec", "webbrowser.open"):
        seen.append(event)
    if event == "os.posix_spawn" and words[0] not in started:  # subprocess itself asks for it
        seen.append(f"{event} {words[0]}")
    if event == "subprocess.Popen":
        started.append(words[0])
        seen.extend([] if isinstance(words[1], list) else ["a shell"])
        quiet = {"-nostdin", "-version"} & set(words[1])
        seen.extend([] if quiet or "ffmpeg" not in words[1][0] else [f"{words[1]} listens to the keys"])
sys.addaudithook(watch)
from linkanim.cli import main
small = ["--size", "64x36", "--seconds", "0.1"]
for words in (["info", "press"], ["solve", "kite", "--angle", "1 rad"], ["scenes"],
              ["record", "kite", "-o", "a.gif", *small], ["record", "kite", "-o", "a.mp4", *small]):
    assert main(words) == 0
print(json.dumps(seen))
"""


@pytest.mark.slow
def test_nothing_opens_the_network_or_a_shell(tmp_path: Path) -> None:
    done = subprocess.run(
        [sys.executable, "-c", WATCHED], check=True, capture_output=True, text=True, cwd=tmp_path
    )
    assert json.loads(done.stdout.splitlines()[-1]) == []
    assert {path.name for path in tmp_path.iterdir()} == {"a.gif", "a.mp4"}
