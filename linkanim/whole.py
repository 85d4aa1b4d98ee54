"""Files that appear under their name when they are whole, or not at all.

Work goes to a temporary name beside the target, `.linkanim-PID-TOKEN.part`, and takes the target's
name at the end, when its bytes are on the disk. What a killed run left behind is cleared by the next
one in that folder. Everything that is written goes through here: `WorkFailed` where disk or folder refuse.
"""

from __future__ import annotations

import os
import re
import shutil
from collections.abc import Iterable, Iterator
from contextlib import contextmanager, suppress
from errno import EEXIST
from itertools import chain
from pathlib import Path

from linkanim.errors import BadInput, WorkFailed

_DEVICES = frozenset(
    {"con", "prn", "aux", "nul", *(f"{port}{n}" for port in ("com", "lpt") for n in range(1, 10))}
)
"""Names that Windows keeps for devices, whatever their ending."""
_IN_USE = (5, 32)
"""Windows' numbers for a file that may not be touched and for one that is open elsewhere."""
_PART = re.compile(r"\.linkanim-(\d+)-[0-9a-f]+\.part")


def checked_target(path: str | os.PathLike[str], suffixes: tuple[str, ...]) -> Path:
    """Return the path, where a file can be asked for under it.

    `BadInput` where `path` has none of the suffixes, is a folder or a name of Windows' own, or lies in a
    folder that is not there.
    """
    asked = Path(path)
    if asked.is_dir():
        raise BadInput(
            f"{asked} is a folder; give the name of a file in it, such as {asked / ('out' + suffixes[0])}"
        )
    if asked.suffix.lower() not in suffixes:
        raise BadInput(f"{asked}: the name's ending says the format; use one of {', '.join(suffixes)}")
    if asked.name.split(".")[0].strip().lower() in _DEVICES:
        raise BadInput(f"{asked}: Windows keeps {asked.stem} for a device; choose another name")
    if not asked.parent.is_dir():
        raise BadInput(f"{asked}: there is no folder {asked.parent}; make it first, or choose another")
    return asked


def made_folder(path: Path) -> Path:
    """Return the folder, made where only it is missing; `BadInput` where a file or no parent is there."""
    if path.exists() and not path.is_dir():
        raise BadInput(f"{path} is a file; name a folder")
    if not path.parent.is_dir():
        raise BadInput(f"{path}: there is no folder {path.parent}; make it first, or choose another")
    try:
        path.mkdir(exist_ok=True)
    except OSError as error:
        raise WorkFailed(f"{path}: cannot be made: {(error.strerror or str(error)).lower()}") from error
    return path


@contextmanager
def replacing(target: Path) -> Iterator[Path]:
    """Give the path of a new file, which takes the target's name when the block ends well.

    Where the target is a link, what it points to is replaced. Whatever ends the block otherwise,
    the new file goes and an old one stays as it was.
    """
    whole = target.resolve()
    with _beginning(whole.parent, target) as part:
        yield part
        _settle(part)
        part.replace(whole)


def add(content: bytes, target: Path, others: Iterable[Path] = ()) -> Path:
    """Write a new file under the name, or the first of the others that is free; never over an old one.

    Returns the name it took; all lie in one folder. `WorkFailed` where none is free, too.
    """
    with _beginning(target.parent, target) as part:
        part.write_bytes(content)
        _settle(part)
        for name in chain([target], others):
            if _taken(part, name):
                return name
        raise FileExistsError(EEXIST, os.strerror(EEXIST))


def _taken(part: Path, target: Path) -> bool:
    """Give a part a name that is free, in one step; return whether it was."""
    try:
        target.hardlink_to(part)
    except FileExistsError:
        return False
    except OSError:  # a file system that knows no links
        return _moved(part, target)
    return True


def _moved(part: Path, target: Path) -> bool:
    """Give a part a name that is free by reserving it first; return whether it was."""
    try:
        target.touch(exist_ok=False)
    except FileExistsError:
        return False
    part.replace(target)
    return True


@contextmanager
def _beginning(folder: Path, target: Path) -> Iterator[Path]:
    """Give an empty file of a temporary name, which is gone at the end unless it took another."""
    clear_stale(folder)
    part = _part(folder)
    try:
        with _saying_why(target):
            part.touch(exist_ok=False)
            yield part
    finally:
        with suppress(OSError):
            part.unlink(missing_ok=True)


@contextmanager
def numbering(target: Path) -> Iterator[Path]:
    """Give a new folder for 0001.png, 0002.png, ...; they become NAME-0001.png, ... of NAME.png together.

    Numbered files of the same name that are there already are replaced, and the higher-numbered
    ones go; where the block or the replacing fails they are all as they were.
    """
    clear_stale(target.parent)
    part = _part(target.parent)
    try:
        with _saying_why(target):
            part.mkdir()
            yield part
            _swap(part, target)
    finally:
        shutil.rmtree(part, ignore_errors=True)


@contextmanager
def replacing_folder(target: Path) -> Iterator[Path]:
    """Give a new folder, which takes the target's name when the block ends well; an old one then goes."""
    whole = target.resolve()
    clear_stale(whole.parent)
    part, aside = _part(whole.parent), _part(whole.parent)
    try:
        with _saying_why(target):
            part.mkdir()
            yield part
            for path in part.iterdir():
                _settle(path)
            if whole.exists():
                whole.rename(aside)
            try:
                part.rename(whole)
            except OSError:
                if aside.exists():
                    aside.rename(whole)
                raise
    finally:
        for left in (part, aside):
            shutil.rmtree(left, ignore_errors=True)


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
def _saying_why(target: Path) -> Iterator[None]:
    """Have the system's refusals meanwhile be a `WorkFailed` that names the target and the reason."""
    try:
        yield
    except OSError as error:
        raise WorkFailed(f"{target}: cannot be written: {_reason(error)}") from error


def _reason(error: OSError) -> str:
    """Return why the system refused; Windows refuses to replace what another program has open."""
    if getattr(error, "winerror", None) in _IN_USE:
        return "it is open in another program; close it there, or choose another name"
    return (error.strerror or str(error)).lower()


def _part(folder: Path) -> Path:
    return folder / f".linkanim-{os.getpid()}-{os.urandom(4).hex()}.part"


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
