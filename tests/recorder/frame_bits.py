"""The bytes of some frames and of a GIF: one hash each, kept beside this file.

`python tests/recorder/frame_bits.py` prints the hashes; with --write it keeps them, which is what a change
of the picture asks for. Those of pictures with words are compared within one machine alone: letters are
drawn by the font library that comes with pygame.
"""

from __future__ import annotations

import hashlib
import json
import sys
import tempfile
from dataclasses import replace
from pathlib import Path

from linkanim.picture.look import Look
from linkanim.recorder.plan import Clip, make_plan
from linkanim.recorder.scene_frames import SceneFrames, record
from linkanim.scenes import load

KEPT = Path(__file__).with_name("frame_bits.json")
WORDED = "with words: "
SIZE = (320, 180)
BARE = Look(hud=False)
ALL = Look(vectors=frozenset("va"), names=2, chart="C.acceleration")
LOOKS = {
    "press": replace(BARE, vectors=frozenset("va")),
    "crank-rocker": replace(BARE, theme="dark"),
    "six-bar": replace(BARE, ghost=True),
    "epicyclic-hypocycloid": replace(BARE, background=False),
    "quick-return-press": replace(BARE, zoom=2.0, pan=(0.1, 0.2)),
    f"{WORDED}press": ALL,
}
PHASES = (0.0, 1.0, 2.5, 5.9)
CLIPS = ("press", "scotch-yoke")


def hashes() -> dict[str, str]:
    """Return the hashes of frames by their scene, and those of GIFs."""
    found = {name: _frames(name.removeprefix(WORDED), look) for name, look in LOOKS.items()}
    return {**found, **{f"{name}.gif": _gif(name) for name in CLIPS}}


def kept() -> dict[str, str]:
    """Return the hashes that are kept."""
    found: dict[str, str] = json.loads(KEPT.read_text())
    return found


def without_words(found: dict[str, str]) -> dict[str, str]:
    """Return the hashes of pictures that hold no text."""
    return {name: value for name, value in found.items() if not name.startswith(WORDED)}


def _frames(name: str, look: Look) -> str:
    scene, found = load(name), hashlib.sha256()
    for phase in PHASES:
        clip = Clip(scene.linkage.drive.speed, scene.period, 25.0, start=phase)
        found.update(SceneFrames(scene, make_plan(clip, "png"), SIZE, look).draw(0))
    return found.hexdigest()


def _gif(name: str) -> str:
    with tempfile.TemporaryDirectory() as folder:
        made = record(load(name), Path(folder, "out.gif"), size=(160, 90), fps=5.0, look=BARE)
        return hashlib.sha256(made.path.read_bytes()).hexdigest()


if __name__ == "__main__":
    printed = hashes()
    if "--write" in sys.argv:
        KEPT.write_text(json.dumps(without_words(printed), indent=1) + "\n")
    sys.stdout.write(json.dumps(printed, indent=1) + "\n")
