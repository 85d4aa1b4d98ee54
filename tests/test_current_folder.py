"""Nothing in the current folder is executed: a student's files lie there, of whatever names."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Mapping
from pathlib import Path

import pytest

from linkanim.errors import RecordingFailed
from linkanim.recorder import encode

THIRD_PARTIES = (
    *("tqdm", "numpy", "pygame", "PIL", "imageio", "imageio_ffmpeg", "orjson", "tomli_w", "fpdf"),
    *("font_source_sans_pro", "IPython", "mpmath", "scipy", "matplotlib", "psutil"),
)
MINE = 'with open({seen!r}, "a") as seen:\n    print(__name__, file=seen)\n'
SCENE = """
[four-bar]
ground = 100
crank = 30
coupler = 90
rocker = 80
"""
START = "import sys\nfrom linkanim.__main__ import main\nsys.exit(main())\n"


def before_us() -> set[str]:
    """Return what the interpreter itself imports before `python -m` comes to us: nothing of ours can help."""
    printed = "import sys, runpy, pkgutil; print(*sys.modules)"
    done = subprocess.run([sys.executable, "-c", printed], check=True, capture_output=True, text=True)
    return {name.partition(".")[0] for name in done.stdout.split()}


@pytest.fixture
def here(tmp_path: Path) -> Path:
    """A current folder with a scene and a module of every name that there is, but for linkanim's."""
    folder = tmp_path / "here"
    folder.mkdir()
    code = MINE.format(seen=str(tmp_path / "seen"))
    for name in {*sys.stdlib_module_names, *THIRD_PARTIES} - before_us():
        (folder / f"{name}.py").write_text(code)
    (folder / "my.toml").write_text(SCENE)
    (tmp_path / "start.py").write_text(START)
    return folder


def run(here: Path, words: list[str], more: Mapping[str, str] | None = None) -> None:
    """Run Python in the folder; it must end well, and nothing there be executed."""
    env = {**os.environ, "SDL_VIDEODRIVER": "dummy", "SDL_AUDIODRIVER": "dummy", **(more or {})}
    done = subprocess.run(
        [sys.executable, *words], check=False, capture_output=True, text=True, cwd=here, env=env, timeout=60
    )
    seen = here.parent / "seen"
    assert not seen.exists(), seen.read_text()
    assert (done.returncode, "Traceback" in done.stderr) == (0, False), done.stderr


COMMANDS = {
    "gif": ["record", "my.toml", "--size", "64x36", "--seconds", "0.1", "-o", "a.gif"],
    "mp4": ["record", "my.toml", "--size", "64x36", "--seconds", "0.1", "-o", "a.mp4"],
    "report": ["report", "my.toml", "-o", "report"],
}


@pytest.mark.parametrize(
    ("command", "start"),
    [
        ("gif", "a script"),
        ("mp4", "-m"),
        pytest.param("report", "a script", marks=pytest.mark.long),
        pytest.param("gif", "-m", marks=pytest.mark.long),
        pytest.param("mp4", "a script", marks=pytest.mark.long),
        pytest.param("report", "-m", marks=pytest.mark.long),
    ],
)
@pytest.mark.slow
def test_no_command_executes_what_lies_in_the_current_folder(here: Path, command: str, start: str) -> None:
    if start == "-m":
        run(here, ["-m", "linkanim", *COMMANDS[command]])
    else:
        package = here / "linkanim"
        package.mkdir()
        (package / "__init__.py").write_text((here / "tqdm.py").read_text())
        run(here, [str(here.parent / "start.py"), *COMMANDS[command]])


# An empty entry of PYTHONPATH is the current folder, and so is what -c begins with.
@pytest.mark.parametrize(
    "path", [os.pathsep, *(pytest.param(path, marks=pytest.mark.long) for path in (".", "HERE"))]
)
@pytest.mark.slow
def test_no_encoder_executes_it_however_python_was_started(here: Path, path: str) -> None:
    words = [*["record", "my.toml", "--size", "64x36", "--seconds", "0.1"], "-o", "a.gif"]
    code = f"import sys\nsys.argv[1:] = {words!r}\n{START}"
    for name in {*sys.stdlib_module_names} - {"json", "struct", "subprocess"}:
        (here / f"{name}.py").unlink(missing_ok=True)
    run(here, ["-c", code], {"PYTHONPATH": path.replace("HERE", str(here))})


# G is pressed twice in the window; what it started is waited for.
PLAYED = """
import os, sys
import pygame
flip, frames = pygame.display.flip, 0
def counted():
    global frames
    frames += 1
    if frames in (3, 8, 12):
        key = {3: pygame.K_g, 8: pygame.K_g, 12: pygame.K_q}[frames]
        pygame.event.post(pygame.event.Event(pygame.KEYDOWN, key=key, mod=0, unicode=chr(key)))
    flip()
pygame.display.flip = counted
from linkanim.__main__ import main
sys.argv[1:] = ["play", "my.toml", "--size", "64x36"]
code = main()
while True:
    try:
        os.wait()
    except ChildProcessError:
        break
sys.exit(code)
"""


@pytest.mark.skipif(os.name != "posix", reason="waits for what was started")
@pytest.mark.slow
def test_the_window_s_recordings_do_not_execute_it(here: Path) -> None:
    (here.parent / "played.py").write_text(PLAYED)
    run(here, [str(here.parent / "played.py")])
    assert (here / "recordings" / "my-1.gif").read_bytes().startswith(b"GIF89a")


@pytest.mark.skipif(os.name != "posix", reason="PATH as POSIX reads it")
@pytest.mark.parametrize("places", ["", ".", "sub", "HERE"])
def test_no_ffmpeg_in_the_current_folder_is_executed(
    places: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def by_its_name() -> str:
        subprocess.run(["ffmpeg"], check=False)
        return "ffmpeg"

    for program in (tmp_path / "ffmpeg", tmp_path / "sub" / "ffmpeg"):
        program.parent.mkdir(exist_ok=True)
        program.write_text(f"#!/bin/sh\ntouch {tmp_path / 'executed'}\n")
        program.chmod(0o755)
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("PATH", places.replace("HERE", str(tmp_path)) + os.pathsep + str(tmp_path / "none"))
    path = os.environ["PATH"]
    monkeypatch.setattr(encode, "get_ffmpeg_exe", lambda: "ffmpeg")
    with pytest.raises(RecordingFailed, match="has no ffmpeg"):
        encode.ffmpeg()
    monkeypatch.setattr(encode, "get_ffmpeg_exe", by_its_name)
    with pytest.raises(FileNotFoundError):
        encode.ffmpeg()
    assert not (tmp_path / "executed").exists()
    assert os.environ["PATH"] == path
