"""The scene file that a window was opened on: it may be written anew, or go, while the window is open."""

from __future__ import annotations

from contextlib import suppress
from pathlib import Path

from linkanim import intake
from linkanim.scenes import load
from linkanim.scenes.scene import Scene


class SceneFile:
    """A scene file, and how it was when it was last looked at."""

    def __init__(self, path: Path) -> None:
        self._path = path
        self._seen = self._state()

    def news(self) -> list[str]:
        """Return what has become of the file since it was last looked at, in words."""
        before, self._seen = self._seen, self._state()
        if before == self._seen:
            return []
        name = intake.named(self._path.name)
        if self._seen is None:
            return [f"{name} is gone; the linkage runs on, and Ctrl+S writes it as a new file"]
        return [f"{name} has changed; F5 loads it"]

    def load(self) -> Scene:
        """Read the file as it is now; errors as `scenes.load`."""
        self._seen = self._state()
        return load(self._path)

    def _state(self) -> tuple[int, int, int] | None:
        """Return what is another number once the file is written anew; None where there is none."""
        with suppress(OSError):
            found = self._path.stat()
            return found.st_mtime_ns, found.st_size, found.st_ino
        return None
