"""How a command ends: its exit code, and one line on stderr when something went wrong."""

from __future__ import annotations

import errno
import os
import signal
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from types import FrameType
from typing import TextIO, cast

from linkanim.errors import LinkanimError, shortened

DONE = 0
FAILED = 1
BAD = 2
INTERRUPTED = 130
HUNG_UP = 129

_ENDING = tuple(getattr(signal, name) for name in ("SIGINT", "SIGTERM", "SIGHUP") if hasattr(signal, name))
_BAD_NAMES = (errno.ENAMETOOLONG,)
"""The system's errors for names that cannot be: whoever chose such a name can mend it."""
_NO_MEMORY = ("failed to map segment", "cannot allocate memory", "out of memory", "can't start new thread")
"""What the system and libraries say where memory ends."""
_LONGEST = 4000
"""Characters of a message that are shown."""
_ONE_AND_THE_SAME = 3.0
"""Seconds in which further signals count as the first: a terminal that closes sends several."""


class Ended(BaseException):
    """A signal that ends the program, with its exit code; no Exception, so that only clean-up catches it."""


def guarded(work: Callable[[], None]) -> int:
    """Do the work, flush what it printed, and return the exit code; never raises, never a traceback."""
    before = sys.stderr
    try:
        with _signals_raise():
            _open_closed()
            _print_anything()
            sys.stderr = cast(TextIO, _Remarks(sys.stderr))
            work()
            _flush()
        return DONE
    except BaseException as error:
        return _code_of(error)
    finally:
        sys.stderr = before


def _code_of(error: BaseException) -> int:
    """Say in one line what ended the work, and return the exit code for it."""
    match error:
        case SystemExit():
            return _flushed(error.code)
        case BrokenPipeError():  # the reader, such as `head`, has all it wanted
            _forget(sys.stdout)
            return DONE
        case KeyboardInterrupt():
            return _say("interrupted", INTERRUPTED)
        case Ended(args=(code,)):
            return _say("the terminal was closed" if code == HUNG_UP else "terminated", code)
        case RuntimeError(__cause__=(Ended() | KeyboardInterrupt()) as cause):
            return _code_of(cause)  # so Python 3.11 wraps what arrives while a class is made
        case LinkanimError():
            reason = error.__cause__
            is_name = isinstance(reason, OSError) and reason.errno in _BAD_NAMES
            return _say(str(error), BAD if is_name else error.exit_code)
        case Exception() if _lacks_memory(error):
            return _say("there is not enough memory for this", FAILED)
        case OSError():
            _forget(sys.stdout)
            return _say(_reason(error), BAD if error.errno in _BAD_NAMES else FAILED)
        case _:
            return _say(f"unexpected {type(error).__name__} in {_place(error)}: {error}", FAILED)


def _lacks_memory(error: BaseException | None) -> bool:
    """Return whether memory ended; a library that lost this error on the way is told by a SystemError."""
    return any(
        isinstance(one, MemoryError | SystemError) or any(words in str(one).lower() for words in _NO_MEMORY)
        for one in (error, *_behind(error))
    )


def _say(message: str, code: int) -> int:
    line = one_line(message)
    if sys.stderr is not None:  # print would take None for stdout
        with suppress(OSError, ValueError):
            print(f"linkanim: {line}", file=sys.stderr)
    return code


def one_line(message: str) -> str:
    """Return a message on one line, with nothing in it that a terminal would take for an order.

    An overlong word, or message, is shortened in its middle, so that the reason and the way out stay visible.
    """
    line = " ".join(shortened(word) for word in message.split())
    return "".join(c if c.isprintable() else "?" for c in shortened(line, _LONGEST))


def _reason(error: OSError) -> str:
    where = f"{error.filename}: " if error.filename else ""
    return f"{where}{error.strerror or error}"


def _place(error: BaseException) -> str:
    """Return file:line where the error arose, for a report."""
    trace = error.__traceback__
    while trace and trace.tb_next:
        trace = trace.tb_next
    if trace is None:
        return "linkanim"
    return f"{os.path.basename(trace.tb_frame.f_code.co_filename)}:{trace.tb_lineno}"  # noqa: PTH119


def _flushed(code: object) -> int:
    """Return the code argparse left with (0 after --help and --version), once its text is out."""
    try:
        _flush()
    except OSError as error:
        return _code_of(error)
    return code if isinstance(code, int) else DONE


def _flush() -> None:
    if sys.stdout is not None:
        sys.stdout.flush()


def _forget(stream: TextIO) -> None:
    """Let the interpreter's last flush go nowhere, or it would report the failure a second time."""
    with suppress(OSError, ValueError, AttributeError):
        os.dup2(os.open(os.devnull, os.O_WRONLY), stream.fileno())


class _Remarks:
    """stderr, as on a full disk: what it does not take is lost, and the work goes on."""

    def __init__(self, stream: TextIO) -> None:
        self._stream = stream

    def __getattr__(self, name: str) -> object:
        return getattr(self._stream, name)

    def write(self, text: str) -> int:
        try:
            self._stream.write(text)
            self._stream.flush()
        except OSError:
            _forget(self._stream)
        return len(text)


def _open_closed() -> None:
    """Have streams that were closed before the start lead nowhere: a later file would take their number."""
    for number in range(3):
        try:
            os.fstat(number)
        except OSError:
            os.open(os.devnull, os.O_RDWR)
    for name, number in (("stdout", 1), ("stderr", 2)):
        if getattr(sys, name) is None:
            setattr(sys, name, os.fdopen(number, "w", encoding="utf-8", closefd=False))


def _print_anything() -> None:
    """Print '?' for what the terminal's encoding lacks (a degree sign, a Greek letter), not an error."""
    for stream in (sys.stdout, sys.stderr):
        reconfigure = getattr(stream, "reconfigure", None)
        if reconfigure is not None:
            reconfigure(errors="replace")


@contextmanager
def _signals_raise() -> Iterator[None]:
    """Turn a signal during the block into an exception, once: a second one does not cut clean-up short.

    Python drops an exception that is raised while an object is deleted; the next signal then counts. A signal
    that is ignored, as SIGHUP is under nohup, stays ignored. Outside the main thread, where Python
    allows no signal handlers, this does nothing.
    """
    threading = sys.modules.get("threading")  # where nobody has loaded it there is one thread
    if threading is not None and threading.current_thread() is not threading.main_thread():
        yield
        return
    raised = [-_ONE_AND_THE_SAME]
    ends: list[BaseException] = []
    told = sys.unraisablehook

    def arrived(number: int, frame: FrameType | None) -> None:
        if time.monotonic() - raised[0] >= _ONE_AND_THE_SAME:
            raised[0] = time.monotonic()
            ends.append(KeyboardInterrupt() if number == signal.SIGINT else Ended(128 + number))
            raise ends[-1]

    def lost(what: sys.UnraisableHookArgs) -> None:
        if what.exc_value in ends:
            raised[0] = -_ONE_AND_THE_SAME  # the next one counts again
        elif not any(one in ends for one in _behind(what.exc_value)) and not _lacks_memory(what.exc_value):
            told(what)  # what a signal or the end of memory broke is no news

    before = {number: signal.getsignal(number) for number in _ENDING}
    ours = {number: old for number, old in before.items() if old not in (signal.SIG_IGN, None)}
    for number in ours:
        signal.signal(number, arrived)
    sys.unraisablehook = lost
    try:
        yield
    except (ImportError, SyntaxError, SystemError) as error:
        # numpy takes an exception that arrives while it is loaded for a failure of its own, and Python one
        # that arrives while its compiler looks up a letter's name; closing a buffer loses it
        if ends:
            raise ends[-1] from error
        raise
    finally:
        sys.unraisablehook = told
        for number, old in ours.items():
            signal.signal(number, old)


def _behind(error: BaseException | None) -> Iterator[BaseException]:
    """Yield what an error was raised from, or while it was handled, the nearest first."""
    while error := error and (error.__cause__ or error.__context__):
        yield error
