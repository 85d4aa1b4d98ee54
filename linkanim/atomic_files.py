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
from errno import EEXIST
from itertools import chain
from pathlib import Path

from linkanim.errors import BadInput, WorkFailed

# Files that appear under their name when they are whole, or not at all.
#
# Work goes into a scratch folder beside the target, `.linkanim-TOKEN.part`, and takes the target's name at
# the end, when its bytes are on the disk. A lock held on `lock` in it says that its run is alive; what a
# killed run left behind is cleared by the next one in that folder. Everything that is written goes through
# here: `BadInput` for a target that is not ours to replace, `WorkFailed` where disk or folder refuse.
#
# A file that several runs change is changed under a `Claim`: read, changed and written without another
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
_FORSAKEN = 7 * 24 * 3600
"""Seconds after which a scratch folder of another machine, whose locks we may not see, is left behind."""
_PATIENCE, _PAUSE = 2.0, 0.003
"""Seconds for which a file that another run changes is waited for, and between looking."""


def checked_target(
    path: str | os.PathLike[str], suffixes: tuple[str, ...], inputs: Iterable[str | os.PathLike[str]] = ()
) -> Path:
    """Return the path of a file that can be written.

    `BadInput` where `path` has none of the suffixes, is a folder or a name of Windows' own, lies in a
    folder that is not there, is taken as by `refuse_taken`, or is one of the `inputs`, which are read.
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
    refuse_taken(target)
    refuse_input(target, inputs)
    return target


def refuse_input(target: Path, inputs: Iterable[str | os.PathLike[str]]) -> None:
    """Refuse, as `BadInput`, a file to be written that is one of those that are read, by whatever name.

    Names that differ in capitals alone are one: elsewhere they are one file.
    """
    for path in map(Path, inputs):
        if path.is_file() and (_alike(target, path) or (target.exists() and target.samefile(path))):
            raise BadInput(f"{target} is what is read as {path}; choose another name for what is written")


def _alike(one: Path, other: Path) -> bool:
    return str(one.resolve()).casefold() == str(other.resolve()).casefold()


def refuse_taken(path: Path) -> None:
    """Refuse a name under which something is that a file must not replace.

    `BadInput` for a link, wherever it leads, a folder, a pipe, a device, and a file that is read-only, for
    the superuser, too.
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
    """Return a folder that is there, or of which only itself is missing; `BadInput` for any other."""
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
    """Return the folder, made where only it is missing; `BadInput` where a file or no parent is there."""
    with saying_why(checked_folder(path), "made"):
        path.mkdir(exist_ok=True)
    return path


@contextmanager
def replacing(target: Path) -> Iterator[Path]:
    """Give the path of a new file, which takes the target's name when the block ends well.

    A file that is there keeps its mode. Whatever ends the block otherwise, the new file goes and an old
    one stays as it was. `BadInput` as `refuse_taken`.
    """
    refuse_taken(target)
    with scratch(target.parent, target) as folder:
        part = folder / "new"
        part.touch()
        yield part
        settle(part)
        take_place(part, target)


def write_text(target: Path, text: str, *, folders: bool = False) -> None:
    """Write a text under a name, whole or not at all, its folders made if asked; errors as `replacing`."""
    if folders:
        with saying_why(target.parent, "made"):
            target.parent.mkdir(parents=True, exist_ok=True)
    with replacing(target) as part:
        part.write_text(text, encoding="utf-8")


def add(content: bytes, target: Path, others: Iterable[Path] = ()) -> Path:
    """Write a new file under the name, or the first of the others that is free; never over an old one.

    Returns the name it took; all lie in one folder. `WorkFailed` where none is free, too.
    """
    with scratch(target.parent, target) as folder:
        part = folder / "new"
        part.write_bytes(content)
        settle(part)
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


def set_aside(path: Path) -> Path | None:
    """Give a file of ours that is damaged another name, which is free; None where that cannot be."""
    names = (path.with_name(f"{path.stem}-aside-{n}{path.suffix}") for n in range(1, 10_000))
    with suppress(OSError):
        free = next(name for name in names if not os.path.lexists(name))
        path.rename(free)
        return free
    return None


class Claim:
    """The right to change a file: no other run of linkanim has it until it is released, or we are gone.

    A file beside it is locked, `.NAME.lock`, and goes with the claim.
    """

    def __init__(self, path: Path, lock: int) -> None:
        self._path, self._lock = path, lock

    @classmethod
    def on(cls, target: Path) -> Claim | None:
        """Return the claim on a file, its folder made if it is not there; None where another run has it.

        A file system that knows no locks gives it to everyone. `WorkFailed` where the folder refuses.
        """
        path = target.with_name(f".{target.name}.lock")
        with saying_why(target):
            target.parent.mkdir(parents=True, exist_ok=True)
            # of a file that is another user's no more than this may be asked
            lock = os.open(path, os.O_RDONLY | os.O_CREAT, 0o666)
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
    """Have no other run of linkanim change a file meanwhile; `WorkFailed` where one does so for long."""
    until = time.monotonic() + _PATIENCE
    while (claim := Claim.on(target)) is None:
        if time.monotonic() > until:
            raise WorkFailed(f"{target}: cannot be written: another linkanim is using it")
        time.sleep(_PAUSE)
    try:
        yield
    finally:
        claim.release()


def take_place(part: Path, target: Path) -> None:
    """Have a file take the name, and the mode and owner of what is there; `BadInput` as `refuse_taken`."""
    refuse_taken(target)
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
    """Have the bytes on the disk: a disk that is full may say so only now."""
    with path.open("rb+") as file:
        os.fsync(file.fileno())


@contextmanager
def scratch(folder: Path, target: Path) -> Iterator[Path]:
    """Give a new folder in `folder` for work on the target; it goes at the end with all that is in it."""
    clear_stale(folder)
    part = folder / f".linkanim-{os.urandom(8).hex()}.part"
    with saying_why(target):
        try:
            part.mkdir(mode=0o700)
            with _alive(part / _LOCK):
                yield part
        finally:
            _remove(part)


@contextmanager
def _alive(path: Path) -> Iterator[None]:
    """Hold a new file locked meanwhile, with what tells this machine in it."""
    lock = os.open(path, os.O_RDWR | os.O_CREAT | os.O_EXCL, 0o600)
    try:
        with suppress(OSError):  # a file system that knows no locks
            hold(lock, wait=True)
        # only now: nobody takes the lock of a file without it for one whose run is gone
        os.write(lock, _machine())
        yield
    finally:
        os.close(lock)


def hold(lock: int, *, wait: bool = False) -> None:
    """Lock an open file until it is closed or we are gone; BlockingIOError where another holds it."""
    if sys.platform == "win32":
        try:
            msvcrt.locking(lock, msvcrt.LK_LOCK if wait else msvcrt.LK_NBLCK, 1)
        except PermissionError as error:
            raise BlockingIOError from error
    else:
        fcntl.flock(lock, fcntl.LOCK_EX | (0 if wait else fcntl.LOCK_NB))


def _machine() -> bytes:
    """Return what tells this machine, since it was started, from others: containers on it are one."""
    try:
        return Path("/proc/sys/kernel/random/boot_id").read_bytes().strip()
    except OSError:
        import platform

        return platform.node().encode()


def clear_stale(folder: Path) -> None:
    """Remove what runs that are no longer alive left in a folder; what cannot be removed stays."""
    with suppress(OSError):
        for path in list(folder.iterdir()):
            if re.fullmatch(_PART, path.name) and path.is_dir() and not path.is_symlink() and _is_stale(path):
                _remove(path)


def _is_stale(part: Path) -> bool:
    """Return whether the run whose scratch folder this is has ended.

    The lock tells, of a run on this machine; another's locks may not be seen here, and only its age does.
    """
    try:
        lock = os.open(part / _LOCK, os.O_RDWR)
    except FileNotFoundError:  # begun just now, or never gone on
        return time.time() - part.stat().st_mtime > _FORSAKEN
    try:
        left_behind = time.time() - os.fstat(lock).st_mtime > _FORSAKEN
        hold(lock)
        return left_behind or os.read(lock, 100) == _machine()
    except BlockingIOError:
        return False
    except OSError:  # a file system that knows no locks
        return left_behind
    finally:
        os.close(lock)


def _remove(path: Path) -> None:
    """Remove a file or a folder, the lock in it last: without it nobody could tell whose the rest is."""
    with suppress(OSError):
        if path.is_symlink() or not path.is_dir():
            path.unlink()
            return
        for inside in sorted(path.iterdir(), key=lambda inside: inside.name == _LOCK):
            _remove(inside)
        path.rmdir()


@contextmanager
def saying_why(target: Path, deed: str = "written") -> Iterator[None]:
    """Have the system's refusals meanwhile be a `WorkFailed` that names the target and the reason."""
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
    """Return the path under which something is kept in the user's data folder; neither need be there.

    Of a user without a home it is kept as long as the system keeps temporary files.
    """
    from tempfile import gettempdir

    from platformdirs import user_data_path

    folder = user_data_path("linkanim", appauthor=False)
    return (folder if folder.is_absolute() else Path(gettempdir()) / "linkanim") / name
