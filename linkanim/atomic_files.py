"""Write files that appear under their name when they are whole, or not at all.

Its parts, in reading order:

- Files that appear under their name when they are whole, or not at all.
- The user's data folder, where what outlasts a window is kept.
"""

from __future__ import annotations

import os
import re
import stat
import sys
import time
from collections.abc import Iterable, Iterator
from contextlib import contextmanager, suppress
from errno import EEXIST, EINVAL
from itertools import chain
from pathlib import Path

from linkanim.errors import BadInput, WorkFailed

# Files that appear under their name when they are whole, or not at all.
#
# A file is written in a scratch folder beside its target, `.linkanim-TOKEN.part`, and takes the target's name
# when its bytes are on the disk. The folder is the run's that holds the lock on the file `lock` in it; where
# nobody holds it, the next run that writes beside it removes the folder. Removing is finished before a signal
# is obeyed; the lock goes last, once all else is gone. Everything that is written goes through here:
# `BadInput` for a target that is not ours to replace, `WorkFailed` where disk or folder refuse.
#
# A file that several runs change is changed under a `Claim`: read, changed and written with no other run in
# between.

if sys.platform == "win32":
    import msvcrt
else:
    import fcntl

_DEVICES = frozenset(
    {"con", "prn", "aux", "nul", *(f"{port}{n}" for port in ("com", "lpt") for n in range(1, 10))}
)
"""Names that Windows keeps for devices, whatever their ending."""
_IN_USE = (5, 32)
"""Windows' numbers for a file that may not be touched and for one that is open elsewhere."""
_PART = r"\.linkanim-[0-9a-f]{16}\.part"
_LOCK = "lock"
_BEGUN, _FORSAKEN = 60, 7 * 24 * 3600
"""Seconds after which a scratch folder without a lock, or with an empty one, is no run's that begins just
now; and after which one of another machine, whose locks may not show here, is abandoned."""
_PATIENCE, _PAUSE = 2.0, 0.003
"""How long to wait for a file that another run changes, and how long between two tries, in seconds."""


def checked_target(
    path: str | os.PathLike[str], suffixes: tuple[str, ...], inputs: Iterable[str | os.PathLike[str]] = ()
) -> Path:
    """Return the path of a file that can be written.

    `BadInput` where `path` has none of the suffixes, is a folder or a name that Windows reserves, lies in a
    folder that does not exist, is refused by `refuse_blocked`, or is one of the `inputs`, the files that are
    read.
    """
    target = Path(path)
    if target.is_dir():
        raise BadInput(
            f"{target} is a folder; give the name of a file in it, such as {target / ('out' + suffixes[0])}"
        )
    if target.suffix.lower() not in suffixes:
        raise BadInput(f"{target}: the name's ending says the format; use one of {', '.join(suffixes)}")
    if target.name.split(".")[0].strip().lower() in _DEVICES:
        raise BadInput(f"{target}: Windows keeps {target.stem} for a device; choose another name")
    if not target.parent.is_dir():
        raise BadInput(f"{target}: there is no folder {target.parent}; make it first, or choose another")
    refuse_blocked(target)
    refuse_input(target, inputs)
    return target


def refuse_input(target: Path, inputs: Iterable[str | os.PathLike[str]]) -> None:
    """Refuse, as `BadInput`, a file to be written that is one of those that are read, by whatever name.

    Names that differ only in capitals count as one: on some systems they are one file.
    """
    for path in map(Path, inputs):
        if path.is_file() and (_alike(target, path) or (target.exists() and target.samefile(path))):
            raise BadInput(f"{target} is what is read as {path}; choose another name for what is written")


def _alike(one: Path, other: Path) -> bool:
    return str(one.resolve()).casefold() == str(other.resolve()).casefold()


def refuse_blocked(path: Path) -> None:
    """Refuse a name that belongs to something that a file must not replace.

    `BadInput` for a link, wherever it leads, a folder, a pipe, a device, and a read-only file, even for the
    superuser.
    """
    try:
        mode = path.lstat().st_mode
    except (OSError, ValueError):
        return
    if stat.S_ISLNK(mode):
        raise BadInput(f"{path} is a link, which is not written over; name the file itself, or another")
    if not stat.S_ISREG(mode):
        what = "a folder" if stat.S_ISDIR(mode) else "a pipe, a socket or a device"
        raise BadInput(f"{path} is {what}, which is not written over; choose another name")
    if not (mode & stat.S_IWUSR and os.access(path, os.W_OK)):
        raise BadInput(f"{path} is read-only; make it writable, or choose another name")


def checked_folder(path: Path) -> Path:
    """Return a folder that exists, or whose parent does; `BadInput` for any other path."""
    if path.is_dir():
        return path
    if path.is_symlink():
        raise BadInput(f"{path} is a link that leads to no folder; name a folder")
    if path.exists():
        raise BadInput(f"{path} is a file; name a folder")
    if not path.parent.is_dir():
        raise BadInput(f"{path}: there is no folder {path.parent}; make it first, or choose another")
    return path


def made_folder(path: Path) -> Path:
    """Return the folder, made where only it is missing; errors as `checked_folder`, `WorkFailed` too."""
    with saying_why(checked_folder(path), "made"):
        path.mkdir(exist_ok=True)
    return path


@contextmanager
def replacing(target: Path) -> Iterator[Path]:
    """Give the path of a new file, which takes the target's name when the block ends well.

    It takes over the mode of an old file. If an exception ends the block, the new file is removed and an old
    one stays as it was. `BadInput` as `refuse_blocked`; `WorkFailed` where the system refuses.
    """
    refuse_blocked(target)
    with scratch(target.parent, target) as folder:
        part = folder / "new"
        part.touch()
        yield part
        settle(part)
        replace_target(part, target)


def write_text(target: Path, text: str, *, folders: bool = False) -> None:
    """Write a text under a name, whole or not at all, its folders made if asked; errors as `replacing`."""
    if folders:
        with saying_why(target.parent, "made"):
            target.parent.mkdir(parents=True, exist_ok=True)
    with replacing(target) as part:
        part.write_text(text, encoding="utf-8")


def add(content: bytes, target: Path, others: Iterable[Path] = ()) -> Path:
    """Write a new file under the name, or the first of the others that is free; never over an old one.

    Returns the name it took; all the names lie in one folder. `WorkFailed` also where none is free.
    """
    with scratch(target.parent, target) as folder:
        part = folder / "new"
        part.write_bytes(content)
        settle(part)
        for name in chain([target], others):
            if _named_if_free(part, name):
                return name
        raise FileExistsError(EEXIST, os.strerror(EEXIST))


def _named_if_free(part: Path, target: Path) -> bool:
    """Give the new file a name if that is free, in one step; return whether it was free."""
    try:
        target.hardlink_to(part)
    except FileExistsError:
        return False
    except OSError:  # a file system that knows no links
        return _moved(part, target)
    return True


def _moved(part: Path, target: Path) -> bool:
    """Give the new file a name if that is free, by reserving it first; return whether it was free."""
    try:
        target.touch(exist_ok=False)
    except FileExistsError:
        return False
    part.replace(target)
    return True


def set_aside(path: Path) -> Path | None:
    """Rename a damaged file of ours to a free name, and return that; None where it cannot be renamed."""
    names = (path.with_name(f"{path.stem}-aside-{n}{path.suffix}") for n in range(1, 10_000))
    with suppress(OSError):
        free = next(name for name in names if not os.path.lexists(name))
        path.rename(free)
        return free
    return None


class Claim:
    """The right to change a file: no other run of linkanim has it until it is released, or this run ends.

    It is a lock on the file `.NAME.lock` beside the target, which is removed with the claim.
    """

    def __init__(self, path: Path, lock: int) -> None:
        self._path, self._lock = path, lock

    @classmethod
    def on(cls, target: Path) -> Claim | None:
        """Return the claim on a file, its folder made if it is not there; None where another run has it.

        A file system that knows no locks gives it to everyone. `WorkFailed` where the folder cannot be
        written.
        """
        path = target.with_name(f".{target.name}.lock")
        with saying_why(target):
            target.parent.mkdir(parents=True, exist_ok=True)
            # for reading, which is all that another user's file may allow
            lock = _opened(path, os.O_RDONLY | os.O_CREAT)
        try:
            hold(lock)
            # whoever had the claim before may have taken the file away since it was opened
            if os.path.samestat(os.fstat(lock), path.stat()):
                return cls(path, lock)
        except (BlockingIOError, FileNotFoundError):
            pass
        except OSError:
            return cls(path, lock)
        os.close(lock)
        return None

    def release(self) -> None:
        """Let others change the file."""
        if sys.platform == "win32":  # where no open file can be removed
            os.close(self._lock)
        with suppress(OSError):
            self._path.unlink()
        if sys.platform != "win32":
            os.close(self._lock)


@contextmanager
def alone(target: Path) -> Iterator[None]:
    """Keep other runs of linkanim off a file during the block; `WorkFailed` where one has it for too long."""
    until = time.monotonic() + _PATIENCE
    while (claim := Claim.on(target)) is None:
        if time.monotonic() > until:
            raise WorkFailed(f"{target}: cannot be written: another linkanim is using it")
        time.sleep(_PAUSE)
    try:
        yield
    finally:
        claim.release()


def replace_target(part: Path, target: Path) -> None:
    """Rename a file to the target, with the mode and owner of an old one; `BadInput` as `refuse_blocked`."""
    refuse_blocked(target)
    with suppress(FileNotFoundError):
        _look_like(part, target.stat())
    part.replace(target)


def _look_like(part: Path, old: os.stat_result) -> None:
    """Give a file another's owner and mode, as far as the system lets us."""
    if sys.platform != "win32":
        with suppress(OSError):
            os.chown(part, old.st_uid, old.st_gid)
    with suppress(OSError):
        part.chmod(stat.S_IMODE(old.st_mode))


def settle(path: Path) -> None:
    """Force a file's bytes onto the disk: a full disk may report its error only then."""
    with path.open("rb+") as file:
        os.fsync(file.fileno())


@contextmanager
def scratch(folder: Path, target: Path) -> Iterator[Path]:
    """Give a new folder in `folder` for work on the target; it is removed at the end with its content."""
    clear_stale(folder)
    part = folder / f".linkanim-{os.urandom(8).hex()}.part"
    ended: BaseException | None = None
    with saying_why(target):
        try:
            part.mkdir(mode=0o700)
            with _alive(part / _LOCK):
                yield part
        finally:
            while True:  # written here: a signal before a call that removes it would leave it
                try:
                    _remove(part)
                    break
                except BaseException as error:  # a signal; it is obeyed when all is removed
                    ended = error
            if ended:
                raise ended


@contextmanager
def _alive(path: Path) -> Iterator[None]:
    """Hold a new file locked during the block; its content is this machine's name."""
    lock = os.open(path, os.O_RDWR | os.O_CREAT | os.O_EXCL, 0o600)
    try:
        with suppress(OSError):  # a file system that knows no locks
            hold(lock, wait=True)
        # only after the lock: another run that locks the file while it is empty does not take ours for ended
        os.write(lock, _machine())
        yield
    finally:
        os.close(lock)


def hold(lock: int, *, wait: bool = False) -> None:
    """Lock an open file until it is closed or this run ends; BlockingIOError where another run holds it."""
    if sys.platform == "win32":
        try:
            msvcrt.locking(lock, msvcrt.LK_LOCK if wait else msvcrt.LK_NBLCK, 1)
        except PermissionError as error:
            raise BlockingIOError from error
    else:
        fcntl.flock(lock, fcntl.LOCK_EX | (0 if wait else fcntl.LOCK_NB))


def _machine() -> bytes:
    import platform

    return platform.node().encode() or b"unnamed"


def _opened(path: Path, flags: int) -> int:
    """Open a regular file: never through a link, and never waiting, as a pipe has one wait; else OSError."""
    with suppress(FileNotFoundError):
        if not stat.S_ISREG(path.lstat().st_mode):
            raise OSError(EINVAL, f"{path.name} is no file of linkanim's")
    flags |= getattr(os, "O_NOFOLLOW", 0) | getattr(os, "O_NONBLOCK", 0)
    return os.open(path, flags, 0o666)


def clear_stale(folder: Path) -> None:
    """Remove the scratch folders in a folder that are nobody's; what cannot be removed stays."""
    for part in list(folder.glob(".linkanim-*.part")):
        with suppress(OSError):
            if re.fullmatch(_PART, part.name) and not part.is_symlink() and _is_stale(part):
                _remove(part)


def _is_stale(part: Path) -> bool:
    """Return whether the run whose scratch folder this is has ended: nobody holds its lock.

    Where another machine's locks may not show, its name in the lock or its age has to tell. OSError where
    the lock is no file of ours.
    """
    try:
        lock = _opened(part / _LOCK, os.O_RDWR)
    except FileNotFoundError:
        return _is_older(part.stat(), _FORSAKEN if any(part.iterdir()) else _BEGUN)
    try:
        hold(lock)
        if machine := os.read(lock, 1000):
            # Linux numbers only disks of this machine: all locks on them show here
            shows = machine == _machine() or (sys.platform == "linux" and os.major(part.stat().st_dev) > 0)
            return shows or _is_older(os.fstat(lock), _FORSAKEN)
        return _is_older(os.fstat(lock), _BEGUN)
    except BlockingIOError:
        return False
    except OSError:  # a file system that knows no locks
        return _is_older(os.fstat(lock), _FORSAKEN)
    finally:
        os.close(lock)


def _is_older(status: os.stat_result, seconds: float) -> bool:
    return time.time() - status.st_mtime > seconds


def _remove(path: Path) -> None:
    """Remove a file or a folder; a lock goes last, once all else is gone: it tells whose the rest is."""
    with suppress(OSError):
        if path.is_symlink() or not path.is_dir():
            path.unlink()
            return
        lock = path / _LOCK
        for inside in {*path.iterdir()} - {lock}:
            _remove(inside)
        if {*path.iterdir()} <= {lock}:
            lock.unlink(missing_ok=True)
        path.rmdir()


@contextmanager
def saying_why(target: Path, deed: str = "written") -> Iterator[None]:
    """Turn an OSError of the block into a `WorkFailed` that names the target and the reason."""
    try:
        yield
    except OSError as error:
        raise WorkFailed(f"{target}: cannot be {deed}: {_reason(error)}") from error


def _reason(error: OSError) -> str:
    """Return why the system refused; Windows refuses to replace what another program has open."""
    if getattr(error, "winerror", None) in _IN_USE:
        return "it is open in another program; close it there, or choose another name"
    return (error.strerror or str(error)).lower()


# The user's data folder, where what outlasts a window is kept.


def kept_as(name: str) -> Path:
    """Return the path under which something is kept in the user's data folder; neither need exist.

    For a user without a home it lies among the temporary files, and lasts as long as the system keeps those.
    """
    from tempfile import gettempdir

    from platformdirs import user_data_path

    folder = user_data_path("linkanim", appauthor=False)
    return (folder if folder.is_absolute() else Path(gettempdir()) / "linkanim") / name
