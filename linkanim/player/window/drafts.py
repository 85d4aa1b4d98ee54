"""The file in which the draft on a sheet is kept, whole and at most a second behind, until it is written.

Each window has a file of its own, `draft.json` or the next name that no open window has: what one draws is
never in another's way. What a window left that ended before its draft was written is offered by the next.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

from linkanim import atomic_files, intake
from linkanim.atomic_files import Claim
from linkanim.build.draft import Draft
from linkanim.errors import BadInput, WorkFailed
from linkanim.player.state.handlers.build import DRAFT, offered, stored_text
from linkanim.player.state.sheet import BuildSheet
from linkanim.player.state.state import State
from linkanim.player.window.files import from_anywhere

_MOST = 100
"""So many windows have a draft at once."""
_OFFER = "a draft that was in no scene file has been kept: F2 takes it up"


class DraftFile:
    """A file that holds the draft that is in no scene file, and is not there without one."""

    def __init__(self, path: Path) -> None:
        self._first = path
        self._path: Path | None = None
        self._claim: Claim | None = None
        self._kept: Draft | None = None

    def offered(self, state: State) -> tuple[State, str | None]:
        """Return the state with what another window left on offer, and what there is to say of it.

        What is damaged, or of another version, is set aside. WorkFailed where it cannot be read.
        """
        path = self._taken(there=True)
        if path is None:
            return state, None
        where = intake.named(path)
        try:
            state = offered(state, DRAFT.read(path, where), where)
        except BadInput as error:
            aside = atomic_files.set_aside(path)
            if aside is None:
                self.close()
                raise WorkFailed(f"{error}; drafts are not kept") from None
            return state, f"{error}; it is kept as {aside.name}"
        self._kept = state.sheet.building.draft if state.sheet else None
        return state, _OFFER

    def keep(self, sheet: BuildSheet | None) -> None:
        """Write the draft on a sheet if it is another one; remove the file where none would be lost.

        WorkFailed where that cannot be; the next time it is tried again.
        """
        draft = None if sheet is None or sheet.is_written else sheet.lasting.draft
        if draft is self._kept:
            return
        path = self._path or self._taken(there=False)
        if path is None:
            raise WorkFailed(f"{self._first}: {_MOST} windows have a draft; close one")
        if draft is None or sheet is None:
            with atomic_files.saying_why(path, "removed"):
                path.unlink(missing_ok=True)
        else:
            atomic_files.write_text(path, stored_text(_found_anywhere(sheet)), folders=True)
        self._kept = draft

    def close(self) -> None:
        """Let another window have the file, and offer what is in it."""
        if self._claim:
            self._claim.release()
        self._claim = self._path = None

    def _taken(self, *, there: bool) -> Path | None:
        """Return the first file, there or not, that no open window has; it is this one's from now on.

        None where there is none such.
        """
        for path in self._names():
            claim = Claim.on(path) if path.exists() == there else None
            if claim and path.exists() == there:
                self._path, self._claim = path, claim
                return path
            if claim:  # another window has come or gone meanwhile
                claim.release()
        return None

    def _names(self) -> Iterator[Path]:
        yield self._first
        yield from (self._first.with_stem(f"{self._first.stem}-{n}") for n in range(2, _MOST + 1))


def _found_anywhere(sheet: BuildSheet) -> BuildSheet:
    """Return a sheet as it lasts, its photograph by a path that holds from any folder."""
    draft = sheet.lasting.draft
    photo = draft.photo and draft.photo._replace(file=from_anywhere(draft.photo.file))
    return replace(sheet, building=replace(sheet.lasting, draft=replace(draft, photo=photo)))
