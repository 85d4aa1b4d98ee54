"""An arcade-style player for planar linkages.

`load` gives a scene by name or path, `names` the catalogue, `record` turns a scene into a GIF, MP4
or numbered PNG, `path` a drawn curve into linkages that follow it, `guide` poses into linkages whose
coupler passes them, `function` a function into linkages that generate it, `quick_return` a time ratio
into linkages that have it, `dwell` a rest into linkages that keep it, `make` a scene into parts to cut and
pin together; `solve_many` solves a scene with many lengths in one call, `tolerance` says how far it is off
when its lengths are; with `speaking` pictures and pages are in another language. Everything is imported
when first asked for: `import linkanim` alone brings in neither a window nor an encoder.

The rooms, from the ground up. Each imports only from those before it; its docstring lists its modules in
the order in which they are read:

    mechanics  what a linkage is and how it moves; `mechanics.solver` is for `mechanics` alone
    scenes     the catalogue, and scene files
    synthesis  linkages for a path, poses, a function, a time ratio, a rest
    build      a linkage drawn by hand
    picture    everything between a pose and pixels
    explain    a pose worked out by hand: formulas, steps, joints, chapters, documents
    paper      figures, charts and reports
    share      a page that moves in a browser
    player     what is behind the window: keys, the state and its modes, tapes
    ui         the window on a screen: what is drawn and clicked, devices, the loop
    play       questions about linkages, printed or played, and other games
    workshop   a linkage as flat parts and pins, in layers in which it can turn
    recorder   frames to GIF, MP4 and PNG
    bench      speed against error
    cli        the commands
    notebook   how a scene and a motion show themselves in a notebook

The modules beside this one (`errors`, `frozen`, `units`, ...) and the `manual` belong to no room: every room
may import them. How a frame and a recording come about, and the reason for each large choice, is in
`manual/design.md`.

A kind of joint is its data in `mechanics/linkage`, how it closes in `mechanics/solver/closing`, what it
carries in `mechanics/reactions`, how it is written in `scenes/file_form`, how it is worked out in
`explain/joints` and `explain/forces`; what is drawn of it follows from its bars and from what slides. What
holds links that are solved together is an equation in `mechanics/solver/following`. A kind of input is its
data in `mechanics/linkage`, its path in `mechanics/solver/strokes`, how it is written in `scenes/file_form`,
how it is worked out in `explain/solution`.
"""

import os
import sys

# Not imported from typing: before this file has run, Ctrl-C is not answered in one line, so it has to be
# quick.
TYPE_CHECKING = False
if TYPE_CHECKING:
    from linkanim.errors import LinkanimError
    from linkanim.picture.look import Look
    from linkanim.recorder.recording import record
    from linkanim.scenes import load, names
    from linkanim.scenes.deviation import tolerance
    from linkanim.scenes.many import solve_many
    from linkanim.scenes.scene import Scene
    from linkanim.synthesis.dwells import dwell
    from linkanim.synthesis.generation import function
    from linkanim.synthesis.guidance import guide
    from linkanim.synthesis.path import path
    from linkanim.synthesis.quick_returns import quick_return
    from linkanim.words import speaking
    from linkanim.workshop.request import make

# Here, because every import of pygame comes after it: its greeting would stand among a command's output.
os.environ.setdefault("PYGAME_HIDE_SUPPORT_PROMPT", "1")

__version__ = "0.3.0"

__all__ = [
    "LinkanimError",
    "Look",
    "Scene",
    "__version__",
    "dwell",
    "function",
    "guide",
    "load",
    "make",
    "names",
    "path",
    "quick_return",
    "record",
    "solve_many",
    "speaking",
    "tolerance",
]

_HOME = {
    "LinkanimError": "linkanim.errors",
    "Look": "linkanim.picture.look",
    "Scene": "linkanim.scenes.scene",
    "dwell": "linkanim.synthesis.dwells",
    "function": "linkanim.synthesis.generation",
    "guide": "linkanim.synthesis.guidance",
    "load": "linkanim.scenes",
    "make": "linkanim.workshop.request",
    "names": "linkanim.scenes",
    "path": "linkanim.synthesis.path",
    "quick_return": "linkanim.synthesis.quick_returns",
    "record": "linkanim.recorder.recording",
    "solve_many": "linkanim.scenes.many",
    "speaking": "linkanim.words",
    "tolerance": "linkanim.scenes.deviation",
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
