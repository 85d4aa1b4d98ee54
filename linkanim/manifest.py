"""Files whose names we choose: a list beside them says which we wrote, and only those are replaced.

The list, `.linkanim-NAME.json`, holds the SHA-256 of each file. A file that it does not name, or that was
changed since, is never touched: where its name is needed, the set is refused before anything is written.
While a set is put in place its list holds the old sums beside the new, so that a run which is killed at any
moment leaves files that are whole, each the old one or the new, and the next run knows them all.
"""

from __future__ import annotations

import hashlib
import json
import os
import re
import shutil
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager, suppress
from pathlib import Path

from linkanim.atomic_files import (
    checked_folder,
    checked_target,
    hold,
    refuse_blocked,
    replace_target,
    scratch,
    settle,
)
from linkanim.atomic_files import replacing as replacing_any
from linkanim.errors import BadInput, WorkFailed
from linkanim.frozen import frozen
from linkanim.intake import Intake

Sums = Mapping[str, frozenset[str]]
"""The SHA-256 sums under which a file is known as ours, by its name."""

VERSION = 1
_MARK = "linkanim_wrote"
_LIST = Intake("a list of files that linkanim wrote", most_bytes=50_000_000, most_values=1_000_000)
_SUM = re.compile(r"[0-9a-f]{64}")
_STRANGE = {
    True: "was changed after linkanim wrote it, and is not written over",
    False: "may not be linkanim's own (before 0.3.0 it kept no list of what it wrote)",
}


@frozen
class FileSet:
    """Files of one kind in a folder: the name of their list, and what their own names look like."""

    folder: Path
    name: str
    pattern: str

    @property
    def list_path(self) -> Path:
        """The file that says which we wrote."""
        return self.folder / f".linkanim-{self.name}.json"

    def sums(self) -> Sums:
        """Return what we wrote; nothing where there is no list, `BadInput` for a file that is no list."""
        path = self.list_path
        if not os.path.lexists(path):
            return {}
        refuse_blocked(path)
        reason = f"is not {_LIST.noun}; move it away, or choose another folder"
        document = _LIST.json(path, str(path), reason)
        try:
            if document[_MARK] != VERSION:
                raise ValueError
            sums_of = {name: frozenset(_SUM.findall(sums)) for name, sums in document["files"].items()}
        except (ValueError, TypeError, KeyError, AttributeError):
            raise BadInput(f"{path}: {reason}") from None
        return {name: sums for name, sums in sums_of.items() if re.fullmatch(self.pattern, name)}

    def note(self, name: str) -> None:
        """Know a file from now on as one that we wrote, unless the list cannot be written."""
        with (
            suppress(BadInput, WorkFailed),
            scratch(self.folder, self.list_path) as room,
            _alone(self.folder),
        ):
            sums = {**self.sums(), name: frozenset([_sum(self.folder / name)])}
            replace_target(_write_list(room / "list", sums), self.list_path)

    def refuse_foreign(
        self, names: Iterable[str], way_out: str = "move it away, or choose another name"
    ) -> None:
        """Refuse, as `BadInput`, names of files that we did not write, or that were changed since."""
        known = self.sums()
        for name in names:
            path = self.folder / name
            refuse_blocked(path)
            if os.path.lexists(path) and not is_ours(path, known):
                raise BadInput(f"{path} {_STRANGE[name in known]}; {way_out}")


@frozen
class Output:
    """A file to be written: under a name that its user gave, or else under one that we choose.

    Under a name that was given any file is replaced; under one that we chose, only a file that we wrote: one
    that has such a name, or was `noted` under a name that was given. A refusal ends in `way_out` where -o
    cannot give that name.
    """

    path: Path
    named: bool = True
    noted: bool = False
    way_out: str = ""

    @contextmanager
    def replacing(self) -> Iterator[Path]:
        """Give the path of a new file that takes the name when the block ends well; errors as `replacing`."""
        if self.named:
            with replacing_any(self.path) as part:
                yield part
            if self.noted:
                self._files.note(self.path.name)
            return
        with replacing(self._files, [self.path.name], others_go=False, told=self.path) as folder:
            part = folder.with_name("part")
            yield part
            part.rename(folder / self.path.name)  # whole, it has its name

    def refuse_foreign(self) -> None:
        """Refuse, as `BadInput`, a name that we chose and that a file has which we did not write."""
        if not self.named:
            usual = f"give -o {self.path} to replace it, or another name"
            self._files.refuse_foreign([self.path.name], self.way_out or usual)

    def beside(self, name: str) -> Output:
        """Return an output in the same folder, under a name that we choose."""
        way_out = f"move it away, or give another name than {self.path.name} with -o"
        return Output(self.path.with_name(name), named=False, way_out=way_out)

    @property
    def _files(self) -> FileSet:
        """All outputs in the folder whose names we chose."""
        return FileSet(self.path.parent, "outputs", r"[^/]+")


def checked_output(
    named: str | os.PathLike[str] | None,
    usual: str,
    suffixes: tuple[str, ...],
    inputs: Iterable[str | os.PathLike[str]] = (),
    *,
    ours: bool = False,
) -> Output:
    """Return what is to be written: the name that was given, or else the usual one if it is free or ours.

    With `ours` a name that was given has to be free or ours, too. A file that is given the usual name is
    known as ours afterwards, whatever its ending. `BadInput` as `atomic_files.checked_target`, and for a name
    that has to be free or ours where it is a foreign file's.
    """
    way_out = "move it away, or give another name" if ours and named is not None else ""
    is_given = named is not None and not ours
    path = checked_target(named or usual, suffixes, inputs)
    output = Output(path, is_given, path.stem == Path(usual).stem, way_out)
    output.refuse_foreign()
    return output


def single(path: Path) -> FileSet:
    """Return the set of one file."""
    return FileSet(path.parent, path.name, re.escape(path.name))


def is_ours(path: Path, known: Sums) -> bool:
    """Return whether a file is one that we wrote, and still what we wrote."""
    with suppress(OSError, BadInput):
        refuse_blocked(path)
        return path.name in known and _sum(path) in known[path.name]
    return False


@contextmanager
def replacing(
    files: FileSet, names: Iterable[str] = (), *, others_go: bool = True, told: Path | None = None
) -> Iterator[Path]:
    """Give a new folder, whose files take their names in the set when the block ends well.

    With `others_go`, files of the set that the list names, that are still as we wrote them and that are not
    among the new ones are then removed. If an exception ends the block, or a file cannot take its place, all
    files are as they were. The set's folder is made where only it is missing. `BadInput` before any work
    where one of `names`, known beforehand, is taken by a file that is not ours; at the end for all.
    `WorkFailed` where the disk refuses; it names the path `told`, or the set.
    """
    folder = checked_folder(files.folder)
    files.refuse_foreign(names)
    with scratch(folder if folder.is_dir() else folder.parent, told or folder / files.name) as room:
        new = room / "new"
        new.mkdir()
        yield new
        for path in new.iterdir():
            settle(path)
        sums = {path.name: frozenset([_sum(path)]) for path in sorted(new.iterdir())}
        if folder.is_dir():
            with _alone(folder):
                _replace_all(files, room, sums, others_go=others_go)
        else:
            _write_list(new / files.list_path.name, sums)
            new.rename(folder)


def _replace_all(files: FileSet, room: Path, sums: Sums, *, others_go: bool) -> None:
    """Put the new files in place, one by one, and remove others as asked; undo it all where one fails."""
    files.refuse_foreign(sums)
    before, old = files.sums(), room / "old"
    old.mkdir()
    both = {name: before.get(name, frozenset()) | sums.get(name, frozenset()) for name in {**before, **sums}}
    others = [files.folder / name for name in (before.keys() - sums.keys() if others_go else ())]
    gone = [path for path in others if is_ours(path, before)]
    places = {room / "new" / name: files.folder / name for name in sums}
    moves = {_write_list(room / "both", both): files.list_path, **places}
    kept = {path: _kept(path, old) for path in (*moves.values(), *gone) if path.exists()}
    try:
        for part, target in moves.items():
            replace_target(part, target)
        for path in gone:
            path.replace(old / path.name)
        replace_target(
            _write_list(room / "after", sums if others_go else {**before, **sums}), files.list_path
        )
    except BaseException:
        taken = [target for part, target in moves.items() if not part.exists()]
        for path in (*gone, *reversed(taken)):
            _put_back(path, kept.get(path))
        raise


def _kept(path: Path, old: Path) -> Path:
    """Keep a file's content in the folder `old`, as it may have to come back; return its path there."""
    kept = old / os.urandom(8).hex()
    try:
        kept.hardlink_to(path)
    except OSError:  # a file system that knows no links
        shutil.copy2(path, kept)
    return kept


def _put_back(path: Path, kept: Path | None) -> None:
    """Give a name what it had before, if anything."""
    with suppress(OSError):
        if kept is None:
            path.unlink(missing_ok=True)
        else:
            kept.replace(path)


def _write_list(path: Path, sums: Sums) -> Path:
    """Write the list of what we wrote; return its path."""
    document = {
        _MARK: VERSION,
        "about": "linkanim wrote these files and may replace them; without this list it replaces none",
        "files": {name: " ".join(sorted(sums[name])) for name in sorted(sums)},
    }
    path.write_text(json.dumps(document, ensure_ascii=False, indent=1) + "\n", encoding="utf-8")
    settle(path)
    return path


def _sum(path: Path) -> str:
    with path.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


@contextmanager
def _alone(folder: Path) -> Iterator[None]:
    """Let one run at a time change a folder's files, where a folder can be locked: not on Windows."""
    try:
        lock = os.open(folder, os.O_RDONLY)
    except OSError:
        yield
        return
    try:
        with suppress(OSError):
            hold(lock, wait=True)
        yield
    finally:
        os.close(lock)
