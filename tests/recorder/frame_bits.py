"""The bytes of some frames, of a tape's and of palettes: one hash each, kept beside this file.

`python tests/recorder/frame_bits.py` prints the hashes; with --write it keeps them, which is what a change
of the picture asks for. Those of pictures with words are compared within one machine alone: letters are
drawn by the font library that comes with pygame.
"""

from __future__ import annotations

import hashlib
import json
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np

from linkanim.picture.look import Look
from linkanim.player.action import Action
from linkanim.player.state import begin
from linkanim.player.tape import Tape
from linkanim.recorder.plan import Clip, make_plan
from linkanim.recorder.recording import SceneFrames, palette_of
from linkanim.recorder.tape_frames import TapeFrames
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
DONE = (
    (5, Action("speed", 2)),
    (9, Action("direction")),
    (15, Action("closure")),
    (20, Action("zoom", (2.0, 0.3, -0.1))),
    (30, Action("vectors", "v")),
    (40, Action("theme")),
    (45, Action("pause")),
    (46, Action("scrub", 2.5)),
)
"""What a tape does, frame by frame."""


def hashes() -> dict[str, str]:
    """Return the hashes of frames by their scene, that of a tape's, and those of GIFs' palettes."""
    found = {name: _frames(name.removeprefix(WORDED), look) for name, look in LOOKS.items()}
    return {**found, "tape": _tape(), **{f"{name}, palette": _palette(name) for name in CLIPS}}


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


def _tape() -> str:
    frames, found = (
        TapeFrames(Tape(begin(load("crank-rocker"), look=BARE), 60, DONE), 30.0, SIZE),
        hashlib.sha256(),
    )
    for n in range(30):
        # the fourth byte has no meaning
        found.update(np.frombuffer(frames.draw(n), np.uint8).reshape(-1, 4)[:, :3].tobytes())
    return found.hexdigest()


def _palette(name: str) -> str:
    scene = load(name)
    plan = make_plan(Clip(scene.linkage.drive.speed, scene.period, 5.0), "gif")
    colours = palette_of(SceneFrames(scene, plan, (160, 90), BARE), plan.frames)
    return hashlib.sha256(bytes(sum(colours, ()))).hexdigest()


if __name__ == "__main__":
    printed = hashes()
    if "--write" in sys.argv:
        KEPT.write_text(json.dumps(without_words(printed), indent=1) + "\n")
    sys.stdout.write(json.dumps(printed, indent=1) + "\n")
