"""As other machines have it: no home, no writable folder, other languages, terminals and paths."""

from __future__ import annotations

import ast
import os
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

import linkanim as package
from linkanim.cli import main

PACKAGE = Path(package.__file__).parent
RECORD = ["record", "kite", "--size", "64x36", "--seconds", "0.1"]


def linkanim(*words: str, folder: Path, **more: str | None) -> subprocess.CompletedProcess[str]:
    """Run a command in a folder, with some of the environment changed, or gone where it is None."""
    environment = {**os.environ, **more}
    return subprocess.run(
        [sys.executable, "-m", "linkanim", *words],
        cwd=folder,
        env={key: value for key, value in environment.items() if value is not None},
        capture_output=True,
        encoding="utf-8",
        errors="replace",
        check=False,
    )


MACHINES: dict[str, dict[str, str | None]] = {
    "no home, 256 colours": {
        **{"HOME": None, "XDG_CACHE_HOME": None, "XDG_CONFIG_HOME": None},
        **{"TERM": "xterm-256color", "COLORTERM": None},
    },
    "a home that is not there, no colours": {"HOME": "/nowhere/at/all", "NO_COLOR": "1", "TERM": "dumb"},
    "the C locale, no terminal": {
        **{"LC_ALL": "C", "LANG": "C", "PYTHONUTF8": "0", "PYTHONCOERCECLOCALE": "0"},
        "TERM": None,
    },
}


@pytest.mark.parametrize(
    "machine",
    [
        pytest.param(machine, id=name, marks=[pytest.mark.long] * ("not there" in name))
        for name, machine in MACHINES.items()
    ],
)
@pytest.mark.slow
def test_it_tells_and_records(tmp_path: Path, machine: dict[str, str | None]) -> None:
    done = linkanim(*RECORD, folder=tmp_path, **machine)
    assert (done.returncode, done.stdout) == (0, "kite.gif\n")
    assert done.stderr.startswith("kite.gif: 2 frames at ")
    assert done.stderr.rstrip("\n").isprintable()  # one line, and no colours in it
    assert sorted(path.name for path in tmp_path.iterdir()) == [".linkanim-outputs.json", "kite.gif"]


def test_a_path_with_spaces_and_chinese_characters(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    folder = tmp_path / "my linkages 机构 %d"
    folder.mkdir()
    kite = 'title = "风筝"\n[four-bar]\nground = 4\ncrank = 2\ncoupler = 2\nrocker = 4\n'
    (folder / "风 筝.toml").write_text(kite, encoding="utf-8")
    monkeypatch.chdir(folder)
    for ending in ("gif", "mp4", "png"):
        assert main(["record", "风 筝.toml", "-o", f"风 筝.{ending}", *RECORD[2:]]) == 0
        assert capsys.readouterr().err.count("\n") == 1
    assert {"风 筝.gif", "风 筝.mp4", "风 筝-0001.png"} <= {path.name for path in folder.iterdir()}


@pytest.mark.skipif(not hasattr(os, "geteuid") or os.geteuid() == 0, reason="root may write anywhere")
def test_a_folder_that_cannot_be_written_is_one_line(tmp_path: Path) -> None:
    tmp_path.chmod(0o555)
    done = linkanim(*RECORD, folder=tmp_path)
    tmp_path.chmod(0o755)
    assert done.returncode == 1
    assert done.stderr == "linkanim: kite.gif: cannot be written: permission denied\n"


@pytest.mark.skipif(not Path("/proc/version").exists(), reason="needs a folder that nobody may write to")
def test_where_nothing_can_be_written_it_still_tells(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir("/proc")
    assert main(["info", "kite"]) == 0
    assert main(RECORD) == 1
    error = capsys.readouterr().err
    assert error.startswith("linkanim: kite.gif: cannot be written: ")
    assert error.count("\n") == 1


# Windows and macOS start a process afresh, without what its parent had in memory.
SPAWNED = """
import multiprocessing, linkanim
if __name__ == "__main__":
    multiprocessing.set_start_method("spawn")
    words = (linkanim.load("kite"), "kite.gif")
    process = multiprocessing.Process(target=linkanim.record, args=words, kwargs={"size": (64, 36)})
    process.start()
    process.join()
    print(process.exitcode)
"""


@pytest.mark.slow
def test_a_process_that_was_spawned_records(tmp_path: Path) -> None:
    (tmp_path / "spawned.py").write_text(SPAWNED)
    words = [sys.executable, "spawned.py"]
    done = subprocess.run(words, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert (done.stdout, done.stderr) == ("0\n", "")
    assert (tmp_path / "kite.gif").read_bytes().startswith(b"GIF89a")


ELSEWHERE = {"pread", "pwrite", "mkfifo", "fork", "forkpty", "getuid", "geteuid", "chown", "setsid", "killpg"}
MODULES = {"multiprocessing", "pwd", "grp", "resource"}


def elsewhere_too(tree: ast.AST) -> Iterator[ast.AST]:
    """Yield what runs on Windows as well."""
    yield tree
    for node in ast.iter_child_nodes(tree):
        if not (isinstance(node, ast.If) and ast.unparse(node.test) == "sys.platform != 'win32'"):
            yield from elsewhere_too(node)


def lacking(path: Path) -> Iterator[str]:
    text = path.read_text(encoding="utf-8")
    if not any(word in text for word in ELSEWHERE | MODULES):
        return
    for node in elsewhere_too(ast.parse(text)):
        match node:
            case ast.Attribute(value=ast.Name(id="os" | "signal"), attr=attribute) if attribute in ELSEWHERE:
                yield attribute
            case ast.Import(names=names):
                yield from {name.name for name in names} & MODULES


def test_nothing_is_asked_of_the_system_that_windows_lacks() -> None:
    assert [(path, call) for path in sorted(PACKAGE.rglob("*.py")) for call in lacking(path)] == []
