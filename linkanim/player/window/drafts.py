"""The file in which the draft on a sheet is kept, whole and at most a second behind, until it is written."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from linkanim import atomic_files, intake
from linkanim.build.draft import Draft
from linkanim.intake import Intake
from linkanim.player.state.handlers.build import stored_text
from linkanim.player.state.sheet import BuildSheet
from linkanim.player.window.files import from_anywhere

_FILE = Intake("a draft", most_bytes=5_000_000, most_values=500_000)


class DraftFile:
    """A file that holds the draft that is in no scene file, and is not there without one."""

    def __init__(self, path: Path) -> None:
        self._path = path
        self._kept: Draft | None = None

    def found(self) -> str | None:
        """Return what a window left that ended before it was written; None where there is nothing."""
        return _FILE.read(self._path, intake.named(self._path)) if self._path.exists() else None

    def keep(self, sheet: BuildSheet | None) -> None:
        """Write the draft on a sheet if it is another one; remove the file where none would be lost.

        WorkFailed where that cannot be.
        """
        draft = None if sheet is None or sheet.is_written else sheet.lasting.draft
        if draft is self._kept:
            return
        self._kept = draft
        if draft is None or sheet is None:
            with atomic_files.saying_why(self._path, "removed"):
                self._path.unlink(missing_ok=True)
            return
        atomic_files.write_text(self._path, stored_text(_found_anywhere(sheet)), folders=True)


def _found_anywhere(sheet: BuildSheet) -> BuildSheet:
    """Return a sheet as it lasts, its photograph by a path that holds from any folder."""
    draft = sheet.lasting.draft
    photo = draft.photo and draft.photo._replace(file=from_anywhere(draft.photo.file))
    return replace(sheet, building=replace(sheet.lasting, draft=replace(draft, photo=photo)))
