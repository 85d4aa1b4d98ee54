"""Files that appear under their name when they are whole, or not at all.

Work goes to a temporary name beside the target, `.linkanim-PID-TOKEN.part`, and takes the target's
name at the end. What a killed run left behind is cleared by the next one in that folder.
"""

from __future__ import annotations

import os
import re
import secrets
import shutil
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from linkanim.errors import BadInput, RecordingFailed

_PART = re.compile(r"\.linkanim-(\d+)-[0-9a-f]+\.part")


def checked_target(path: str | os.PathLike[str], suffixes: tuple[str, ...]) -> Path:
    """Return the path, where a file can be asked for under it.

    `BadInput` where `path` has none of the suffixes, is a folder, or lies in one that is not there.
    """
    asked = Path(path)
    if asked.is_dir():
        raise BadInput(
            f"{asked} is a folder; give the name of a file in it, such as {asked / ('out' + suffixes[0])}"
        )
    if asked.suffix.lower() not in suffixes:
        raise BadInput(f"{asked}: the name's ending says the format; use one of {', '.join(suffixes)}")
    if not asked.parent.is_dir():
        raise BadInput(f"{asked}: there is no folder {asked.parent}; make it first, or choose another")
    return asked


@contextmanager
def replacing(target: Path) -> Iterator[Path]:
    """Give the path of a new file, which takes the target's name when the block ends well.

    Where the target is a link, what it points to is replaced. Whatever ends the block otherwise,
    the new file goes and an old one stays as it was.
    `RecordingFailed` where the disk or the folder refuses.
    """
    whole = target.resolve()
    clear_stale(whole.parent)
    part = _part(whole.parent)
    try:
        with saying_why(target):
            part.touch(exist_ok=False)
            yield part
            _settle(part)
            part.replace(whole)
    finally:
        with suppress(OSError):
            part.unlink(missing_ok=True)


@contextmanager
def numbering(target: Path) -> Iterator[Path]:
    """Give a new folder for 0001.png, 0002.png, ...; they become NAME-0001.png, ... of NAME.png together.

    Numbered files of the same name that are there already are replaced, and the higher-numbered
    ones go; where the block or the replacing fails they are all as they were. `RecordingFailed` where
    the disk or the folder refuses.
    """
    clear_stale(target.parent)
    part = _part(target.parent)
    try:
        with saying_why(target):
            part.mkdir()
            yield part
            _swap(part, target)
    finally:
        shutil.rmtree(part, ignore_errors=True)


def numbered(target: Path) -> list[Path]:
    """Return the numbered files NAME-0001.png, ... of NAME.png that are there, in order."""
    name = re.compile(re.escape(target.stem) + r"-(\d{4,})" + re.escape(target.suffix))
    files = (path for path in target.parent.iterdir() if path.is_file())
    found = [(match, path) for path in files if (match := name.fullmatch(path.name))]
    return [path for match, path in sorted(found, key=lambda pair: int(pair[0][1]))]


def clear_stale(folder: Path) -> None:
    """Remove what runs that are no longer alive left in a folder; what cannot be removed stays."""
    with suppress(OSError):
        for path in list(folder.iterdir()):
            match = _PART.fullmatch(path.name)
            if match and not _alive(int(match[1])):
                _remove(path)


@contextmanager
def saying_why(target: Path) -> Iterator[None]:
    """Have every failure meanwhile be a `RecordingFailed` that names the target and the reason."""
    try:
        yield
    except RecordingFailed as error:
        raise RecordingFailed(f"{target} was not recorded: {error}") from error
    except OSError as error:
        raise RecordingFailed(f"{target} was not recorded: {error.strerror or error}") from error


def _part(folder: Path) -> Path:
    return folder / f".linkanim-{os.getpid()}-{secrets.token_hex(4)}.part"


def _alive(pid: int) -> bool:
    """Return whether a process is there; where it cannot be asked without harm (Windows), yes."""
    if os.name != "posix":
        return True
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return False
    except (OSError, OverflowError):
        return True
    return True


def _remove(path: Path) -> None:
    if path.is_dir() and not path.is_symlink():
        shutil.rmtree(path, ignore_errors=True)
    else:
        with suppress(OSError):
            path.unlink()


def _settle(path: Path) -> None:
    """Have the bytes on the disk: a disk that is full may say so only now."""
    with path.open("rb+") as file:
        os.fsync(file.fileno())


def _swap(part: Path, target: Path) -> None:
    """Move the old numbered files aside and the new ones in; undo it all where a move fails."""
    aside = part / "before"
    new = sorted(part.iterdir(), key=lambda path: int(path.stem))
    aside.mkdir()
    moves = [(path, aside / path.name) for path in numbered(target)]
    moves += [(path, target.with_name(f"{target.stem}-{path.stem}{target.suffix}")) for path in new]
    done: list[tuple[Path, Path]] = []
    try:
        for source, goal in moves:
            source.rename(goal)
            done.append((source, goal))
    except BaseException:
        for source, goal in reversed(done):
            goal.rename(source)
        raise
