"""The gallery: every scene as a small GIF, and all of them on one sheet."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterable
from dataclasses import replace
from pathlib import Path

import imageio.v3 as iio
import numpy as np

from linkanim.atomic_files import checked_folder
from linkanim.errors import RecordingFailed
from linkanim.manifest import FileSet, replacing
from linkanim.picture.figure import figure
from linkanim.picture.gears import teeth_a_second
from linkanim.picture.look import Look
from linkanim.recorder.palette import Bytes, make_palette, nearest, rgb
from linkanim.recorder.plan import Clip, make_plan
from linkanim.recorder.recording import Progress, Recording, SceneFrames, record
from linkanim.recorder.tape_frames import record_tape
from linkanim.scenes import load
from linkanim.scenes.scene import Scene

SIZE = (400, 225)
RATES = (20.0, 100 / 6, 12.5, 10.0)
"""Frames a second, the first that keeps a GIF within `LARGEST`."""
FASTEST = 25.0
"""Frames a second of a scene whose teeth are too fast for all `RATES`."""
LARGEST = 150_000
MOST = 400_000
"""A GIF that is larger even at its lowest rate is recorded at a smaller size."""
SHARES = (1.0, 0.8, 0.6, 0.5)
"""The sizes, in shares of `SIZE`."""
LOOK = Look(hud=False)
SHEET = "contact-sheet.png"
TAPE = ".tape.json"

_FRAMES_A_TOOTH = 3
"""With two frames a tooth seems to stand still, with fewer to turn backwards."""
_COLUMNS = 4
_GAP = 6
_COLOURS = 160
"""Colours of the sheet: it looks the same as with all of its colours (50 dB), in a third of the bytes."""
"""The pictures of a period on a running sheet, and how long each stands (ms)."""
_EARLY = 0.09
"""The share of its period at which the sheet shows a scene: off its limits, where links lie in line."""


def make_gallery(
    into: Path, names: Iterable[str], watch: Callable[[str], Progress] | None = None
) -> tuple[tuple[Recording, ...], Path]:
    """Record scenes by name into a folder as NAME.gif, by a NAME.tape.json if one is there, and the sheet.

    Returns the GIFs, and the sheet's path.

    A GIF has the most frames a second, 25 to 10, that keep it within `LARGEST` bytes, and never so few that a
    gear's teeth seem to stand or to turn back. The folder is made where only it is missing. Each file appears
    when it is whole, and replaces one that we wrote; those finished stay where a later one fails. `watch`
    gives the progress to report to, by scene. `BadInput` before any work where `into` cannot be a folder or a
    name is taken by another file; other errors as `record`.
    """
    chosen = tuple(names)
    files = gallery_files(into)
    checked_folder(into)
    files.refuse_foreign([*map(_gif, chosen), SHEET])
    recordings = tuple(_kept(files, name, watch(name) if watch else None) for name in chosen)
    with replacing(files, [SHEET], others_go=False) as new:
        (new / SHEET).write_bytes(contact_sheet([load(name) for name in chosen]))
    return recordings, into / SHEET


def gallery_files(folder: Path) -> FileSet:
    """Return the set of a gallery's files in a folder."""
    return FileSet(folder, "gallery", rf"[\w.-]+\.gif|{re.escape(SHEET)}")


def rates(scene: Scene) -> tuple[float, ...]:
    """Return those of `RATES` at which a tooth moves less than a third of its pitch, else the fastest."""
    teeth = teeth_a_second(figure(scene))
    return tuple(fps for fps in RATES if fps > _FRAMES_A_TOOTH * teeth) or (FASTEST,)


def contact_sheet(scenes: Iterable[Scene]) -> bytes:
    """Return one picture of each scene, four in a row, as a PNG."""
    tiles = [_tile(scene) for scene in scenes]
    width, height = SIZE
    rows = math.ceil(len(tiles) / _COLUMNS)
    sheet = np.full((rows * (height + _GAP) + _GAP, _COLUMNS * (width + _GAP) + _GAP, 3), 206, np.uint8)
    for number, tile in enumerate(tiles):
        row, column = divmod(number, _COLUMNS)
        top, left = _GAP + row * (height + _GAP), _GAP + column * (width + _GAP)
        sheet[top : top + height, left : left + width] = tile
    # at most 2 to the power `bits` colours: the sheet has no more, so none changes
    return iio.imwrite("<bytes>", reduced(sheet), extension=".png", optimize=True, bits=8)


def reduced(picture: Bytes) -> Bytes:
    """Return a picture (height, width, 3) in at most `_COLOURS` colours; flat areas keep their colours."""
    pixels = np.insert(picture[..., ::-1], 3, 0, axis=2)
    words, which = np.unique(pixels.view(np.uint32).reshape(-1), return_inverse=True)
    palette = make_palette([pixels], most=_COLOURS)
    colours: Bytes = palette[nearest(rgb(words).astype(float), palette.astype(float))]
    return colours[which.reshape(-1)].reshape(picture.shape)


def _gif(name: str) -> str:
    return f"{name}.gif"


def _kept(files: FileSet, name: str, progress: Progress | None) -> Recording:
    """Record a scene, by its tape if the gallery has one, under its name in the gallery."""
    with replacing(files, [_gif(name)], others_go=False) as new:
        try:
            made = _recorded(files.folder, new / _gif(name), name, progress)
        except RecordingFailed as error:  # it names the file as it would be called
            raise RecordingFailed(str(error).replace(str(new), str(files.folder))) from error
    return replace(made, path=files.folder / made.path.name)


def _recorded(into: Path, target: Path, name: str, progress: Progress | None) -> Recording:
    """Record a scene at the highest rate that keeps the file small; at the lowest where none does.

    Where it exceeds `MOST` bytes even so, it is recorded at a smaller size.
    """
    scene, tape = load(name), into / f"{name}{TAPE}"
    for share in SHARES:
        size = round(share * SIZE[0]), round(share * SIZE[1])
        for fps in rates(scene):
            if tape.is_file():
                made = record_tape(tape, target, size=size, fps=fps, progress=progress)
            else:
                made = record(scene, target, size=size, fps=fps, look=LOOK, progress=progress)
            if made.file_bytes <= LARGEST:
                break
        if made.file_bytes <= MOST:
            break
    return made


def _tile(scene: Scene) -> Bytes:
    """Return one picture of a scene, (height, width, 3)."""
    clip = Clip(scene.linkage.drive.speed, scene.period, start=_EARLY * scene.period, seconds=1.0)
    plan = make_plan(clip, "png")
    pixels = np.frombuffer(SceneFrames(scene, plan, SIZE, Look()).draw(0), np.uint8)
    return pixels.reshape(SIZE[1], SIZE[0], 4)[..., 2::-1]
