"""Write the window's files under free names, and keep the draft of a sheet, at most a second old."""

from __future__ import annotations

import os
import re
import time
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import replace
from itertools import count
from pathlib import Path

import pygame

from linkanim import atomic_files, intake
from linkanim.atomic_files import Claim
from linkanim.build.draft import UNTITLED, Draft
from linkanim.errors import BadInput, WorkFailed
from linkanim.picture.quantities import chart_tokens
from linkanim.picture.raster import png_bytes
from linkanim.player.browsing import OwnFile
from linkanim.player.building import DRAFT, offered, stored_text
from linkanim.player.state import BuildSheet, State
from linkanim.scenes.editing import under_class
from linkanim.scenes.files import in_its_form, opened
from linkanim.scenes.scene import Scene
from linkanim.scenes.toml import content
from linkanim.units import shown as quoted
from linkanim.words import said, to_say

# Files that the window writes, under free names, and the scene file with which it was opened.

FOLDER = Path("recordings")


def free_stem(folder: Path, name: str, suffixes: tuple[str, ...]) -> str:
    """Return the first of `name-1`, `name-2`, … for which no file with any of the suffixes exists."""
    stems = (f"{name}-{number}" for number in count(1))
    return next(stem for stem in stems if not any((folder / (stem + suffix)).exists() for suffix in suffixes))


def free_targets(name: str, last: str | None = None) -> tuple[str, ...]:
    """Return places for a recording, without endings and all free: in the `last` folder, if there is one.

    The others are in recordings/, in the current folder and in the user's folder of films.
    """
    from linkanim.player.tape_file import SUFFIX

    films = (one for one in ("~/Videos", "~/Movies") if typed_path(one).is_dir())
    folders = dict.fromkeys((*([] if last is None else [last]), str(FOLDER), "", *films))
    taken = (SUFFIX, ".gif", ".mp4")
    return tuple(str(Path(one) / free_stem(typed_path(one), name, taken)) for one in folders)


def typed_path(text: str) -> Path:
    """Return the path of a typed text, in which ~ is the user's own folder."""
    with suppress(RuntimeError):  # the user's own folder is not known
        return Path(text).expanduser()
    return Path(text)


def screenshot(surface: pygame.Surface, name: str) -> Path:
    """Write the picture as a PNG under a free name; errors as `_added`."""
    return _added(png_bytes(surface), name, ".png")


def vector(state: State, size: tuple[int, int]) -> Path:
    """Write the picture as an SVG under a free name, without what is beside it; errors as `_added`."""
    from linkanim.paper.figure import Figured

    scene = state.displayed
    shown = Figured(scene, size, state.look, state.phase, speed=state.clock.speed, as_seen=True)
    return _added(shown.document().encode(), scene.name, ".svg")


def page(state: State) -> Path:
    """Write the scene as a page that moves, with its chart; errors as `document`, `_added`."""
    from linkanim.share.page import Shared, document

    look = state.look
    chart = next(iter(chart_tokens(state.scene, look.chart)), None)
    shown = Shared(state.displayed, state.clock.speed, chart=chart, names=look.names)
    return _added(document(shown).encode(), state.scene.name, ".html")


def report(text: str, name: str) -> Path:
    """Write a fault's report under a free name; errors as `_added`."""
    return _added(f"{text}\n".encode(), f"{name}-fault", ".json")


def _added(data: bytes, name: str, suffix: str) -> Path:
    """Write a file under a free name in `FOLDER`, which is made if need be; return its path.

    BadInput where a file has the folder's name, WorkFailed where the disk refuses.
    """
    atomic_files.made_folder(FOLDER)
    first, *others = (FOLDER / f"{name}-{number}{suffix}" for number in range(1, 10_000))
    return atomic_files.add(data, first, others)


def relative(file: str) -> str:
    """Return a file's path relative to the current folder if it lies in it, else the path as it is."""
    path = Path(from_anywhere(file))
    with suppress(OSError, ValueError):  # the current folder is gone, or the file lies elsewhere
        return str(path.relative_to(Path.cwd()))
    return str(path)


def from_anywhere(file: str) -> str:
    """Return a file's absolute path; the path as it is where the current folder is gone."""
    with suppress(OSError):
        return str(Path(file).absolute())
    return file


def current_folder() -> str:
    """Return the current folder's path; empty where the folder is gone."""
    with suppress(OSError):
        return str(Path.cwd())
    return ""


class SceneFile:
    """A scene file, and how it was when it was last looked at."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self._seen = self._state()

    def news(self) -> list[str]:
        """Return in words what has happened to the file since it was last looked at."""
        before, self._seen = self._seen, self._state()
        if before == self._seen:
            return []
        name = intake.named(self.path.name)
        if self._seen is None:
            return [
                said(
                    "{file} is gone; the linkage runs on, and Ctrl+Shift+S writes it as a new file", file=name
                )
            ]
        return [said("{file} has changed; F5 loads it", file=name)]

    def load(self) -> Scene:
        """Read the file as it is now; errors as `scenes.files.opened`."""
        self._seen = self._state()
        return opened(self.path)[0]

    def _state(self) -> tuple[int, int, int] | None:
        """Return numbers that change when the file is written anew; None where there is no file."""
        with suppress(OSError):
            status = self.path.stat()
            return status.st_mtime_ns, status.st_size, status.st_ino
        return None


class SavedScenes:
    """The scene files that a window wrote; it replaces no others, and these only while unchanged."""

    def __init__(self) -> None:
        self._wrote: dict[Path, bytes] = {}

    def proposal(self, scene: Scene) -> str:
        """Return the scene's name, or its class for a new linkage; with a number where that is taken."""
        name = scene.name
        if scene.title == UNTITLED:
            name = "-".join(re.findall(r"\w+", scene.info.class_name.lower())) or name
        names = (name, *(f"{name}-{number}" for number in range(2, 10_000)))
        return next((one for one in names if not os.path.lexists(f"{one}.toml")), name)

    def add(self, scene: Scene, name: str) -> Path:
        """Write a new scene file under a name; BadInput for a name that is taken or that no file can have."""
        if reason := intake.unnameable(name):
            raise BadInput(said("{file}: {reason}; type another name", file=quoted(name), reason=reason))
        target = Path(from_anywhere(f"{name.removesuffix('.toml')}.toml"))
        path = atomic_files.checked_target(target, (".toml",))
        if os.path.lexists(path):
            raise BadInput(said("{file} is there already; type another name", file=intake.named(path.name)))
        data = content(in_its_form(_entitled(scene)), path.parent)
        self._wrote[path] = data
        return atomic_files.add(data, path)

    def write(self, scene: Scene, path: Path) -> Path:
        """Write a file of this window again; BadInput where it was changed meanwhile."""
        with suppress(OSError):
            if path.read_bytes() != self._wrote.get(path):
                raise BadInput(
                    said(
                        "{file} was changed after it was saved; Ctrl+Shift+S writes another",
                        file=intake.named(path.name),
                    )
                )
        data = content(in_its_form(_entitled(scene)), path.parent)
        atomic_files.write_text(path, data.decode("utf-8"))
        self._wrote[path] = data
        return path


def _entitled(scene: Scene) -> Scene:
    """Return the scene; a new linkage gets its class as title."""
    return under_class(scene) if scene.title == UNTITLED else scene


def where(path: Path) -> str:
    """Say that a file is saved, by its whole path."""
    return said("{file} saved", file=intake.named(from_anywhere(str(path))))


def open_folder(text: str) -> None:
    """Open the folder of the file that a text says is saved; do nothing for any other text."""
    before, _, after = said("{file} saved", file="\0").partition("\0")
    path = Path(text.removeprefix(before).partition(after)[0])
    if path.is_absolute() and path.exists():
        import webbrowser  # opens a local folder, without any network

        with suppress(webbrowser.Error):
            webbrowser.open(path.parent.as_uri())


_MOST_FILES = 300
OPENED = (".toml", ".linkage2", ".motiongen", ".pyslvs")
"""The endings of files that stand on the shelf; a table, or a text, may be anything."""


def scene_files() -> tuple[OwnFile, ...]:
    """Return files of linkages in the current folder, the newest first; none where the folder is gone.

    At most the newest three hundred are returned.
    """
    files: list[tuple[float, str]] = []
    with suppress(OSError), os.scandir() as entries:
        for one in entries:
            if one.name.lower().endswith(OPENED) and one.name.isprintable():
                with suppress(OSError):
                    files.append((-one.stat().st_mtime, one.name))
    return tuple(OwnFile(name, _date(-newest)) for newest, name in sorted(files)[:_MOST_FILES])


def _date(seconds: float) -> str:
    with suppress(OSError, OverflowError, ValueError):
        return time.strftime("%Y-%m-%d %H:%M", time.localtime(seconds))
    return ""


# The file in which the draft of a sheet is kept, whole and at most a second old, until a scene file has it.
#
# Each window has a file of its own, `draft.json` or the next name that no open window has, so that windows do
# not disturb each other. A draft left by a window that ended without saving it is offered by the next window.

_MOST = 100
"""The most windows that can have a draft at the same time."""
_OFFER = to_say("unsaved work has been kept: F2 restores it")


class DraftFile:
    """The file of a draft that is in no scene file; without such a draft there is no file."""

    def __init__(self, path: Path) -> None:
        self._first = path
        self._path: Path | None = None
        self._claim: Claim | None = None
        self._kept: Draft | None = None

    def offered(self, state: State) -> tuple[State, str | None]:
        """Return the state with the draft that another window left on offer, and words about it.

        A damaged file, or one of another version, is set aside. WorkFailed where it cannot be read.
        """
        path = self._claimed(there=True)
        if path is None:
            return state, None
        where = intake.named(path)
        try:
            state = offered(state, DRAFT.read(path, where), where)
        except BadInput as error:
            aside = atomic_files.set_aside(path)
            if aside is None:
                self.close()
                raise WorkFailed(said("{error}; drafts are not kept", error=error)) from None
            return state, said("{error}; it is kept as {file}", error=error, file=aside.name)
        self._kept = state.sheet.building.draft if state.sheet else None
        return state, said(_OFFER)

    def waits(self) -> bool:
        """Tell whether another window left a draft, which stays where it is."""
        is_there = self._claimed(there=True) is not None
        self.close()
        return is_there

    def keep(self, sheet: BuildSheet | None) -> None:
        """Write the draft of a sheet if it has changed; remove the file where no draft would be lost.

        WorkFailed where that is impossible; it is tried again the next time.
        """
        draft = None if sheet is None or sheet.is_written else sheet.lasting.draft
        if draft is self._kept:
            return
        path = self._path or self._claimed(there=False)
        if path is None:
            raise WorkFailed(
                said("{file}: {count} windows have a draft; close one", file=self._first, count=_MOST)
            )
        if draft is None or sheet is None:
            with atomic_files.saying_why(path, "removed"):
                path.unlink(missing_ok=True)
        else:
            atomic_files.write_text(path, stored_text(_found_anywhere(sheet)), folders=True)
        self._kept = draft

    def close(self) -> None:
        """Release the file, so that another window can have it and offer what is in it."""
        if self._claim:
            self._claim.release()
        self._claim = self._path = None

    def _claimed(self, *, there: bool) -> Path | None:
        """Claim and return the first file that no open window has; `there` says whether it must exist.

        None where there is no such file.
        """
        for path in self._names():
            claim = Claim.on(path) if path.exists() == there else None
            if claim and path.exists() == there:
                self._path, self._claim = path, claim
                return path
            if claim:  # another window has opened or closed meanwhile
                claim.release()
        return None

    def _names(self) -> Iterator[Path]:
        yield self._first
        yield from (self._first.with_stem(f"{self._first.stem}-{n}") for n in range(2, _MOST + 1))


def _found_anywhere(sheet: BuildSheet) -> BuildSheet:
    """Return a sheet without a gesture, its photograph by an absolute path."""
    draft = sheet.lasting.draft
    photo = draft.photo and draft.photo._replace(file=from_anywhere(draft.photo.file))
    return replace(sheet, building=replace(sheet.lasting, draft=replace(draft, photo=photo)))
