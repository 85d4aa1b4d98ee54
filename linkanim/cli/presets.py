"""What `record --for` stands for."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Preset:
    """A size in pixels, frames a second and the suffix that names the format."""

    size: tuple[int, int]
    fps: float
    suffix: str


DEFAULT = Preset((1280, 720), 25.0, ".gif")

PRESETS = {
    "slides": DEFAULT,
    "beamer": Preset((1280, 720), 25.0, ".png"),
    "web": Preset((640, 360), 20.0, ".gif"),
}
