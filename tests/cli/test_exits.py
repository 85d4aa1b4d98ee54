"""Each way of ending has its exit code and at most one line on stderr."""

from __future__ import annotations

import os
import shlex
import signal
import subprocess
import sys
import weakref
from collections.abc import Callable, Sequence
from pathlib import Path

import pygame
import pytest

from linkanim.cli import main
from linkanim.cli.command_table import COMMANDS
from linkanim.cli.exits import HUNG_UP, Ended, guarded
from linkanim.errors import BadInput, NoDisplay, RecordingFailed, SceneError


def raising(error: BaseException) -> Callable[[], None]:
    def work() -> None:
        raise error

    return work


def lost(error: Exception) -> Exception:
    """Return the error of a library that has caught another."""
    found = ValueError("no more")
    found.__context__ = error
    return found


@pytest.mark.parametrize(
    ("error", "code", "message"),
    [
        # the caller's to mend
        (BadInput("no scene is called 'x'"), 2, "linkanim: no scene is called 'x'"),
        (SceneError("a.toml: joints.A: length is 0"), 2, "linkanim: a.toml: joints.A: length is 0"),
        # not the caller's
        (NoDisplay("there is no display"), 1, "linkanim: there is no display"),
        (RecordingFailed("the disk is full"), 1, "linkanim: the disk is full"),
        (OSError(28, "No space left on device"), 1, "linkanim: No space left on device"),
        (PermissionError(13, "Permission denied", "/x"), 1, "linkanim: /x: Permission denied"),
        (MemoryError(), 1, "linkanim: there is not enough memory for this"),
        (
            ImportError("x.so: failed to map segment from it"),
            1,
            "linkanim: there is not enough memory for this",
        ),
        # as libraries tell it, or lose it on the way
        (pygame.error("Out of memory"), 1, "linkanim: there is not enough memory for this"),
        (RuntimeError("can't start new thread"), 1, "linkanim: there is not enough memory for this"),
        (
            SystemError("<built-in method close> returned NULL without setting an exception"),
            1,
            "linkanim: there is not enough memory for this",
        ),
        (lost(MemoryError()), 1, "linkanim: there is not enough memory for this"),
        # several lines in a message are one on stderr
        (BadInput("one\n  two"), 2, "linkanim: one two"),
        # nothing in one is an order to the terminal
        (BadInput("a \x1b[31m\u202e"), 2, "linkanim: a ?[31m?"),
        # what it repeats has an end
        (BadInput(f"{'x' * 500}: no"), 2, f"linkanim: {'x' * 248}...{'x' * 247}: no"),
        (BadInput(f"{'x ' * 9_000}: no"), 2, f"linkanim: {'x ' * 999}...{'x ' * 997}: no"),
        # from outside
        (KeyboardInterrupt(), 130, "linkanim: interrupted"),
        (Ended(143), 143, "linkanim: terminated"),
        (Ended(HUNG_UP), 129, "linkanim: the terminal was closed"),
    ],
)
def test_what_ends_the_work_is_one_line_and_a_code(
    error: BaseException, code: int, message: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert guarded(raising(error)) == code
    printed = capsys.readouterr()
    assert printed.out == ""
    assert printed.err == f"{message}\n"


def test_a_defect_is_one_line_that_says_where(capsys: pytest.CaptureFixture[str]) -> None:
    assert guarded(raising(ValueError("odd"))) == 1
    err = capsys.readouterr().err
    assert err.startswith("linkanim: unexpected ValueError in test_exits.py:")
    assert err.count("\n") == 1


def test_no_order_to_the_terminal_is_repeated(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["info", "\x1b]0;mine\x07\u202e.toml", "a\nb"]) == 2
    printed = capsys.readouterr().err
    assert printed.count("\n") == 1
    assert printed.rstrip("\n").isprintable()


@pytest.mark.parametrize(("left", "code"), [(None, 0), (0, 0), (3, 3), ("words", 0)])
def test_work_that_leaves_by_itself_ends_with_its_number(left: object, code: int) -> None:
    assert guarded(raising(SystemExit(left))) == code


def test_work_that_ends_well_is_silent(capsys: pytest.CaptureFixture[str]) -> None:
    assert guarded(lambda: None) == 0
    assert capsys.readouterr() == ("", "")


class Thing:
    """Something that can be let go."""


AT_END = [(signal.SIGINT, 130), (signal.SIGTERM, 143)]
AT_END += [(signal.SIGHUP, 129)] if hasattr(signal, "SIGHUP") else []


@pytest.mark.parametrize(("number", "code"), AT_END)
def test_a_signal_unwinds_the_work_and_the_handler_is_put_back(number: signal.Signals, code: int) -> None:
    def mine(number: int, frame: object) -> None: ...

    before = signal.signal(number, mine)
    cleaned: list[str] = []

    def work() -> None:
        try:
            os.kill(os.getpid(), number)
        finally:
            cleaned.append("cleaned")

    assert guarded(work) == code
    assert cleaned == ["cleaned"]
    assert signal.signal(number, before) is mine


# A terminal that closes sends several, and Ctrl-C is pressed twice.
@pytest.mark.parametrize("second", [number for number, _ in AT_END])
def test_a_second_signal_does_not_cut_the_clean_up_short(second: signal.Signals) -> None:
    cleaned: list[str] = []

    def work() -> None:
        try:
            signal.raise_signal(signal.SIGTERM)
        finally:
            signal.raise_signal(second)
            cleaned.append("cleaned")

    assert guarded(work) == 143
    assert cleaned == ["cleaned"]


@pytest.mark.parametrize(("number", "code"), AT_END)
def test_after_a_signal_that_python_drops_while_an_object_is_let_go_the_next_one_ends_us(
    number: signal.Signals, code: int, capsys: pytest.CaptureFixture[str]
) -> None:
    def work() -> None:
        thing = Thing()
        told = weakref.ref(thing, lambda _: signal.raise_signal(number))
        del thing
        signal.raise_signal(number)
        raise AssertionError(told)

    before = signal.signal(number, signal.SIG_DFL)  # a shell's nohup has SIGHUP ignored
    try:
        assert guarded(work) == code
    finally:
        signal.signal(number, before)
    assert capsys.readouterr().err.count("\n") == 1


def test_what_breaks_on_a_signals_way_out_is_not_told(capsys: pytest.CaptureFixture[str]) -> None:
    """So it is with a buffer that is closed while the signal passes."""

    def close(_: object) -> None:
        raise SystemError("returned a result with an exception set")

    def work() -> None:
        thing = Thing()
        told = weakref.ref(thing, close)
        try:
            signal.raise_signal(signal.SIGTERM)
        finally:
            del thing
        raise AssertionError(told)

    assert guarded(work) == 143
    assert capsys.readouterr().err == "linkanim: terminated\n"


def test_a_signal_that_is_ignored_stays_so() -> None:
    before = signal.signal(signal.SIGTERM, signal.SIG_IGN)
    try:
        assert guarded(lambda: signal.raise_signal(signal.SIGTERM)) == 0
    finally:
        signal.signal(signal.SIGTERM, before)


USAGE = [
    # words that are no command, scene or file
    (["recrod", "press"], "did you mean"),
    (["pres"], "did you mean"),
    (["play", "pres"], "pres"),
    (["nowhere.toml"], "nowhere.toml"),
    # missing or too many
    (["record"], "SCENE"),
    (["solve"], "SCENE"),
    (["solve", "press"], "--angle"),
    (["info", "press", "kite"], '"kite" is one argument too many (see `linkanim info --help`)'),
    (["scenes", "--all"], '"--all" (see `linkanim scenes --help`)'),
    (["record", "press", "--fsp=3"], '"--fsp" (did you mean "--fps"?; see `linkanim record --help`)'),
    # units are written, numbers are finite
    (["solve", "press", "--angle", "87"], "no unit"),
    (["solve", "press", "--angle", "-87"], "no unit"),
    (["solve", "press", "--angle", "nan deg"], "--angle"),
    (["solve", "press", "--angle", "87 deg", "--speed", "10 mph"], "mph"),
    # what is to lie below a drawing
    (["new", "--photo", "none.png"], "none.png: is not there"),
    (["new", "--photo", "n" * 300 + ".png"], "file name too long"),
    (["new", "--photo", __file__], "is no picture"),
    # options that do not go together
    (["solve", "press", "--angle", "1 deg", "--phase", "1 deg"], "one of"),
    (["solve", "press", "--angle", "1 deg", "--sweep", "0:1:1"], "--sweep"),
    (["solve", "press", "--phase", "1 deg", "--sweep", "0:1:1"], "no other angle"),
    (["solve", "press", "--angle", "1 deg", "--phase", "--sweep", "0:1:1"], "no other angle"),
    (["solve", "press", "--angle", "1 deg", "--csv", "a.csv"], "--sweep"),
    (["solve", "press", "--phase"], "--phase"),
    (["solve", "press", "--sweep", "0:1:1", "--csv", "a.csv", "--json"], "--json"),
    (["record", "press", "--periods", "2", "--seconds", "2"], "--seconds"),
    # sweeps that never arrive, or never end
    (["solve", "press", "--sweep", "0:360"], "FIRST:LAST:STEP"),
    (["solve", "press", "--sweep", "0:360:0"], "step"),
    (["solve", "press", "--sweep", "0:360:-1"], "step"),
    (["solve", "press", "--sweep", "360:10:5"], "step"),
    (["solve", "press", "--sweep", "0:360:1e-9"], "rows"),
    (["solve", "press", "--sweep", "0:inf:1"], "inf"),
    (["solve", "press", "--sweep", "a:b:c"], '"a"'),
    (["path", "c.csv", "--count", "1" * 400_000], '1111..."'),
    # a recording's options
    (["record", "press", "--size", "1280"], "1280x720"),
    (["record", "press", "--size", "0x720"], "0x720"),
    (["record", "press", "--size", "16385x720"], "16,384"),
    (["play", "press", "--size", "1280x99999"], "16,384"),
    (["record", "press", "--fps", "0"], "--fps"),
    (["record", "press", "--fps", "nan"], "--fps"),
    (["record", "press", "--periods", "0"], "--periods"),
    (["record", "press", "--periods", "1.5"], "--periods"),
    (["record", "press", "--seconds", "-1"], "--seconds"),
    (["record", "press", "--vectors", "v,x"], "v,x"),
    (["record", "press", "--theme", "blue"], "blue"),
    (["record", "press", "--for", "cinema"], "cinema"),
    (["record", "press", "--thene", "dark"], "--thene"),
]


@pytest.fixture
def refused(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> Callable[[Sequence[str]], tuple[str, str]]:
    """Run a command line that is refused in one line and writes nothing; return what it printed."""

    def run(words: Sequence[str]) -> tuple[str, str]:
        monkeypatch.chdir(tmp_path)
        assert main(words) == 2
        printed = capsys.readouterr()
        assert printed.err.count("\n") == 1
        assert list(tmp_path.iterdir()) == []
        return printed.out, printed.err

    return run


@pytest.mark.withstands("bad inputs tried")
@pytest.mark.parametrize(("words", "named"), USAGE, ids=[" ".join(words) for words, _ in USAGE])
def test_bad_usage_is_one_line_that_names_the_word(
    words: list[str], named: str, refused: Callable[[Sequence[str]], tuple[str, str]]
) -> None:
    told, error = refused(words)
    assert told == ""
    assert error.startswith("linkanim: ")
    assert named in error


ENDLESS = "q" * 100_000
"""Longer than any path: what is wrong with it is to be seen beside it."""


@pytest.mark.parametrize(
    "words",
    [
        (ENDLESS,),
        (f"--{ENDLESS}",),
        *(
            (command, *words)
            for command in COMMANDS
            for words in ((ENDLESS,), (f"./{ENDLESS}.toml",), ("kite", "-o", f"{ENDLESS}.svg"))
        ),
        ("solve", "a " * 50_000 + ".toml", "--angle", "1 deg"),
        ("check", f"{ENDLESS}.toml"),
    ],
    ids=lambda words: " ".join(word[:20] for word in words),
)
def test_what_has_no_end_is_not_repeated_whole(
    words: tuple[str, ...], refused: Callable[[Sequence[str]], tuple[str, str]]
) -> None:
    assert len("".join(refused(words))) < 4100


LINKANIM = [sys.executable, "-m", "linkanim"]
SWEEP = ["solve", "crank-rocker", "--sweep", "0:3600:1", "--csv", "-"]
# What is printed is kept back until there is more of it, as on most machines.
BUFFERED = {name: value for name, value in os.environ.items() if name != "PYTHONUNBUFFERED"}


# in the middle of a long table, or before anything is there
@pytest.mark.parametrize(("words", "lines"), [(SWEEP, 1), (["scenes"], 0)], ids=["table", "list"])
@pytest.mark.slow
def test_a_reader_that_leaves_early_is_not_a_failure(words: list[str], lines: int) -> None:
    pipe = subprocess.PIPE
    with subprocess.Popen([*LINKANIM, *words], stdout=pipe, stderr=pipe, text=True, env=BUFFERED) as process:
        assert process.stdout is not None
        assert process.stderr is not None
        for _ in range(lines):
            process.stdout.readline()
        process.stdout.close()
        assert process.stderr.read() == ""
    assert process.returncode == 0


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="needs /dev/full")
@pytest.mark.parametrize("words", [["scenes"], ["--help"]])
def test_a_full_disk_behind_stdout_is_one_line(words: list[str]) -> None:
    with Path("/dev/full").open("w") as full:
        done = subprocess.run(
            [*LINKANIM, *words], check=False, stdout=full, stderr=subprocess.PIPE, text=True, env=BUFFERED
        )
    assert done.returncode == 1
    assert done.stderr == "linkanim: No space left on device\n"


# What is said on stderr is beside the work, which is done whether or not it can be said.
@pytest.mark.skipif(not Path("/dev/full").exists(), reason="needs /dev/full")
@pytest.mark.parametrize(
    ("words", "code"),
    [
        (["record", "kite", "--size", "64x36", "--seconds", "0.1", "-o", "out.gif"], 0),
        (["record", "kite", "--size", "64x36", "--seconds", "0.1", "-o", "out.gif", "--progress"], 0),
        (["draw", "kite", "--phase", "1 rad", "-o", "out.svg"], 0),
        (["info", "nowhere"], 2),
        (["info"], 2),
    ],
    ids=lambda words: " ".join(words) if isinstance(words, list) else "",
)
@pytest.mark.slow
def test_a_full_disk_behind_stderr_is_no_failure(words: list[str], code: int, tmp_path: Path) -> None:
    with Path("/dev/full").open("w") as full:
        done = subprocess.run(
            [*LINKANIM, *words], check=False, stdout=subprocess.PIPE, stderr=full, cwd=tmp_path
        )
    assert done.returncode == code
    assert done.stdout.decode() == (f"{words[words.index('-o') + 1]}\n" if code == 0 else "")


@pytest.mark.skipif(os.name != "posix", reason="needs a POSIX shell")
@pytest.mark.slow
def test_a_reader_of_stderr_that_leaves_stops_no_work(tmp_path: Path) -> None:
    words = [*LINKANIM, "record", "kite", "--size", "64x36", "--seconds", "0.1", "-o", "out.gif"]
    read, write = os.pipe()
    os.close(read)
    done = subprocess.run(words, check=False, stdout=subprocess.PIPE, stderr=write, cwd=tmp_path)
    os.close(write)
    assert (done.returncode, done.stdout) == (0, b"out.gif\n")


@pytest.mark.skipif(os.name != "posix", reason="needs a POSIX shell")
def test_with_stderr_closed_stdout_holds_no_error() -> None:
    words = shlex.join([*LINKANIM, "info", "nowhere"])
    done = subprocess.run(["sh", "-c", f"{words} 2>&-"], check=False, stdout=subprocess.PIPE)
    assert (done.returncode, done.stdout) == (2, b"")


# Each of the three streams may be closed, as by a daemon: what is opened later must not take its place.
@pytest.mark.skipif(os.name != "posix", reason="needs a POSIX shell")
@pytest.mark.parametrize("closed", ["<&- >&- 2>&-", pytest.param(">&-", marks=pytest.mark.long)])
@pytest.mark.slow
def test_a_recording_needs_no_standard_streams(tmp_path: Path, closed: str) -> None:
    words = shlex.join([*LINKANIM, "record", "kite", "--size", "64x36", "--seconds", "0.1", "-o", "out.gif"])
    done = subprocess.run(["sh", "-c", f"{words} {closed}"], check=False, cwd=tmp_path)
    assert done.returncode == 0
    assert [path.name for path in tmp_path.iterdir()] == ["out.gif"]
    assert (tmp_path / "out.gif").read_bytes().startswith(b"GIF89a")


@pytest.mark.skipif(os.name != "posix", reason="needs a POSIX shell")
@pytest.mark.slow
def test_a_table_for_a_closed_stdout_goes_nowhere() -> None:
    words = shlex.join([*LINKANIM, "solve", "kite", "--sweep", "0:9:3", "--csv", "-"])
    done = subprocess.run(["sh", "-c", f"{words} >&-"], check=False, stderr=subprocess.PIPE)
    assert (done.returncode, done.stderr) == (0, b"")


# Ctrl-C at every other import of the start, in a process of its own each; the imports before `main` are the
# interpreter's, and what it says then is not ours.
INTERRUPTED_START = """
import builtins, os, signal, sys
from linkanim.__main__ import main
real, count = builtins.__import__, 0

def counted(*words, **more):
    global count
    count += 1
    if count == at:
        signal.raise_signal(signal.SIGINT)
    return real(*words, **more)

sys.argv = ["linkanim", "info", "kite"]
for at in [*range(1, 60, 2), *range(60, 1000, 120)]:
    child = os.fork()
    if child == 0:
        builtins.__import__ = counted
        sys.exit(main())
    print(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]), flush=True)
"""


@pytest.mark.skipif(not hasattr(os, "fork"), reason="needs fork")
@pytest.mark.slow
def test_ctrl_c_during_the_start_is_one_line() -> None:
    done = subprocess.run(
        [sys.executable, "-c", INTERRUPTED_START], check=True, capture_output=True, text=True
    )
    codes = [line for line in done.stdout.splitlines() if line.isdigit()]
    assert codes[:30] == ["130"] * 30
    assert set(codes) <= {"130", "0"}
    assert done.stderr.splitlines() == ["linkanim: interrupted"] * codes.count("130")


def test_before_ctrl_c_is_answered_next_to_nothing_is_imported() -> None:
    output = (
        "import sys; before = set(sys.modules); import linkanim.__main__; print(*set(sys.modules) - before)"
    )
    done = subprocess.run([sys.executable, "-c", output], check=True, capture_output=True, text=True)
    assert set(done.stdout.split()) == {"linkanim", "linkanim.__main__"}


def test_a_terminal_without_greek_letters_gets_question_marks() -> None:
    done = subprocess.run(
        [*LINKANIM, "--help"],
        capture_output=True,
        env={**os.environ, "PYTHONIOENCODING": "ascii"},
        check=True,
    )
    assert b"?" in done.stdout
    assert done.stderr == b""


@pytest.mark.parametrize(
    ("ending", "code"), [(Ended(129), 129), (Ended(143), 143), (KeyboardInterrupt(), 130)]
)
def test_a_signal_while_a_class_is_made_ends_us_as_any_other(
    ending: BaseException, code: int, capsys: pytest.CaptureFixture[str]
) -> None:
    def wrapped() -> None:
        raise RuntimeError("Error calling __set_name__ on 'cached_property' instance") from ending

    assert guarded(wrapped) == code
    assert "unexpected" not in capsys.readouterr().err


LOST = {
    "while a buffer is closed": SystemError("error return without exception set"),
    "while numpy is loaded": ImportError("Importing the numpy C-extensions failed."),
    "while a letter's name is compiled": SyntaxError("(unicode error) can't load unicodedata module"),
}


@pytest.mark.parametrize("error", LOST.values(), ids=LOST)
@pytest.mark.parametrize(
    ("number", "code", "said"), [(signal.SIGINT, 130, "interrupted"), (signal.SIGTERM, 143, "terminated")]
)
def test_a_signal_that_foreign_code_loses_ends_us_as_any_other(
    number: signal.Signals, code: int, said: str, error: Exception, capsys: pytest.CaptureFixture[str]
) -> None:
    def work() -> None:
        try:
            signal.raise_signal(number)
        except (KeyboardInterrupt, Ended):
            raise error from None

    assert guarded(work) == code
    assert capsys.readouterr().err == f"linkanim: {said}\n"
