"""An arcade-style player for planar linkages.

`load` gives a scene by name or path, `names` the catalogue, `record` turns a scene into a GIF, MP4
or numbered PNG, `path` a drawn curve into linkages that follow it, `guide` poses into linkages whose
coupler passes them, `function` a function into linkages that generate it, `quick_return` a time ratio
into linkages that have it, `make` a scene into parts to cut and pin together. Everything is imported when
first asked for: `import linkanim` alone brings in neither a window nor an encoder.

`mechanics`, from the ground up; each room imports from those before it only:

    formulas/  arithmetic that knows no linkage: expressions, their programs, exact sums, half angles
    linkage/   what a linkage is, as data: joints, rigid bodies, lines of travel, the drive
    loops/     a dyad on a crank pin and something fixed: its signed root, its triangle
    drive/     the input: how far it goes, how its phase moves it, when everything is back
    closing/   how each kind of joint closes, a walk over all of them, limits down the chain
    motion/    a linkage made ready, and what solving it gives: arrays, or one pose of floats
    facts/     what a linkage is called and can do: class, transmission angle, forces, all quantities

`build`: a linkage drawn by hand: a `draft` and the `gestures` that change it, the dyads in it (`order`),
the scene that it comes to (`making`), and what is `missing` before it comes to one.

`picture`, likewise; what stands between `text` and `parts` (`figure`, `items`, `layout`, `look`, `placing`,
`theme`, `view`) is its floor, and `picture.py` with its printers stands on all of them:

    raster/       outlines, and filling them exactly
    text/         fonts, and lines of text
    parts/        what is drawn of a linkage: bodies, springs, wheels, the ground, traces, arrows
    diagrams/     charts, polygons, instant centres
    panels/       the words about a scene, and what lies over the picture: lists, help, marks
    building/     a linkage that is being built: the sheet, the draft on it, the tools
    labels/       names, dimensions and dead centres on the scene
    arrangement/  what stands where in a window

`explain`: a pose worked out by hand: `expression` and `lines` are what it consists of, `kinds` the steps of
each kind of joint, `inputs` those of what drives, `solution` puts them in order, `documents` prints it.

A kind of joint is its data in `linkage/dyads`, how it closes in `closing/kinds`, how it is written in
`scenes/fields/joints`, how it is worked out in `explain/kinds`; what is drawn of it follows from its bars and
from what slides. A kind of input is its data in `linkage/drive`, its path in `drive/`, how it is written in
`scenes/fields/drive`, how it is worked out in `explain/inputs`.

`play`: what is asked about linkages, printed or played, and other games: pure values over the player's state.

`workshop`: a linkage as flat parts and pins, layers in which it can turn, and the files that it is cut from.
"""

import os
import sys

# Not typing's: whoever starts the command waits for this file before Ctrl-C is answered in one line.
TYPE_CHECKING = False
if TYPE_CHECKING:
    from linkanim.errors import LinkanimError
    from linkanim.picture.look import Look
    from linkanim.recorder.scene_frames import record
    from linkanim.scenes import load, names
    from linkanim.scenes.scene import Scene
    from linkanim.synthesis.generation import function
    from linkanim.synthesis.guidance import guide
    from linkanim.synthesis.quick_returns import quick_return
    from linkanim.synthesis.request import path
    from linkanim.workshop.request import make

# Here, because every import of pygame comes after it: its greeting would stand among a command's output.
os.environ.setdefault("PYGAME_HIDE_SUPPORT_PROMPT", "1")

__version__ = "0.3.0"

__all__ = [
    "LinkanimError",
    "Look",
    "Scene",
    "__version__",
    "function",
    "guide",
    "load",
    "make",
    "names",
    "path",
    "quick_return",
    "record",
]

_HOME = {
    "LinkanimError": "linkanim.errors",
    "Look": "linkanim.picture.look",
    "Scene": "linkanim.scenes.scene",
    "function": "linkanim.synthesis.generation",
    "guide": "linkanim.synthesis.guidance",
    "load": "linkanim.scenes",
    "make": "linkanim.workshop.request",
    "names": "linkanim.scenes",
    "path": "linkanim.synthesis.request",
    "quick_return": "linkanim.synthesis.quick_returns",
    "record": "linkanim.recorder.scene_frames",
}


# An IPython that is only half imported has no shell yet.
_shell = getattr(sys.modules.get("IPython"), "get_ipython", None)
if _shell is not None:
    from linkanim.notebook import register

    register(_shell())


def __getattr__(name: str) -> object:
    """Import a public name from the room it lives in; AttributeError for any other."""
    if name not in _HOME:
        raise AttributeError(f"module 'linkanim' has no attribute {name!r}")
    from importlib import import_module

    return getattr(import_module(_HOME[name]), name)


def __dir__() -> list[str]:
    """List the public names, imported or not."""
    return list(__all__)
