"""Every command: what it does, what it takes, and which module does its work."""

from __future__ import annotations

import platform
import sys
from argparse import Action, Namespace
from collections.abc import Callable, Iterator, Mapping, Sequence
from importlib import import_module
from pathlib import Path
from typing import Any, cast

from linkanim import __version__
from linkanim.cli.options import ARGUMENTS, Argument, Parser, join_negative
from linkanim.errors import BadInput, WorkFailed
from linkanim.intake import control_in
from linkanim.units import shown
from linkanim.words import ENGLISH, language_of, speaking

_WITHOUT_PYGAME = (
    "solve",
    "info",
    "scenes",
    "check",
    "convert",
    "path",
    "guide",
    "function",
    "quick-return",
    "dwell",
    "completion",
)


def parse(argv: Sequence[str] | None = None) -> Namespace:
    """Read a command line (default: the process's own); `BadInput` in one sentence where it is wrong."""
    words = join_negative(sys.argv[1:] if argv is None else argv)
    for word in words:
        if control := control_in(word):
            raise BadInput(f"{shown(word)} has {control} in it; write plain text, and rename such a file")
    words = _with_command(words)
    return build(words[0] if words[0] in COMMANDS else None).parse_args(words)


def run(chosen: Namespace) -> None:
    """Import the module of the chosen command, and only that, and let it do its work in its language.

    A command that says nothing in the reader's language has no option for it. JSON is in English, unless the
    command line itself names a language: what reads it does not know the environment's.
    """
    if chosen.command not in _WITHOUT_PYGAME:
        refuse_mixed_pygame()
    module = f"linkanim.cli.commands.{chosen.command.replace('-', '_')}"
    work = cast(Callable[[Namespace], None], import_module(module).run)
    language = getattr(chosen, "lang", ENGLISH) or (ENGLISH if vars(chosen).get("json") else language_of())
    with speaking(language):
        work(chosen)


def build(only: str | None = None) -> Parser:
    """Build the parser with every command in it; imports nothing that draws, solves or encodes.

    With `only` that command alone is in it, which a command line that begins with it needs.
    """
    parser = Parser(
        prog="linkanim",
        usage="linkanim [SCENE | FILE.toml | LESSON.toml | FILE.tape.json]\n       linkanim COMMAND ...",
        description="Play planar linkages: see them run, solve them exactly, record loops without a seam.",
        before=_keys,
        examples=(
            "linkanim                                  open the window",
            "linkanim press                            open it on the press",
            "linkanim record press -o press.gif        one period as a GIF, no display needed",
            'linkanim solve press --angle "87 deg"',
        ),
    )
    parser.add_argument(
        "--version",
        action=Versions,
        nargs=0,
        help="show the versions of linkanim, Python, numpy, pygame and ffmpeg",
    )
    add = parser.add_subparsers(
        dest="command", metavar="COMMAND", prog="linkanim", parser_class=Parser, title="commands"
    )
    for name in [only] if only else COMMANDS:
        about, *examples = COMMANDS[name]
        text = f"{about[0].upper()}{about[1:]}."
        made = add.add_parser(name, help=about, description=text, examples=examples)
        for argument in _arguments(name):
            argument(made)
    return parser


def _arguments(command: str) -> tuple[Argument, ...]:
    """Return what a command takes; only one that shows pictures loads the looks that they have."""
    if command in ARGUMENTS:
        return ARGUMENTS[command]
    return import_module("linkanim.cli.picture_arguments").ARGUMENTS[command]  # type: ignore[no-any-return]


class Versions(Action):
    """The option that prints what a report of a fault needs: our version and those of what we build on."""

    def __call__(self, parser: Any, *_: object) -> None:
        """Print a line for each of them, and end the program."""
        print("\n".join(_versions()))
        parser.exit()


def _versions() -> Iterator[str]:
    yield f"linkanim {__version__}"
    yield f"Python {platform.python_version()} on {platform.platform()}"
    for names in (("numpy",), ("pygame-ce", "pygame")):
        yield next(
            (f"{name} {version}" for name in names if (version := _installed(name))), f"{names[0]} none"
        )
    from linkanim.recorder.encode import ffmpeg_version

    yield f"ffmpeg {ffmpeg_version() or 'none'} (imageio-ffmpeg {_installed('imageio-ffmpeg') or 'none'})"


def _installed(package: str) -> str:
    """Return the version of an installed package; empty where it is not installed."""
    from importlib import metadata

    try:
        return metadata.version(package)
    except metadata.PackageNotFoundError:
        return ""


def _keys() -> str:
    from linkanim.player.keys import as_text

    return f"keys in the window:\n{as_text()}\n"


def _with_command(words: list[str]) -> list[str]:
    """Put `play` in front where no command was named."""
    if not words:
        return ["play"]
    first = words[0]
    if first in COMMANDS or first in ("-h", "--help", "--version"):
        return words
    if not first.startswith("-"):
        _refuse_misspelt(first)
    return ["play", *words]


def _refuse_misspelt(word: str) -> None:
    """Raise `BadInput` for a first word that is neither a command, a scene nor a path."""
    from linkanim.intake import meant
    from linkanim.scenes import names

    known = (*COMMANDS, *names())
    if word in known or any(mark in word for mark in "./\\"):
        return
    raise BadInput(
        f"{shown(word)} is neither a command ({', '.join(COMMANDS)}), a scene (`linkanim scenes` lists them) "
        f"nor a file{meant(word, known)}"
    )


def refuse_mixed_pygame() -> None:
    """Raise `WorkFailed` where pygame and pygame-ce lie in one folder, or what is there is not whole.

    The one installed last works until the other is removed or updated, which removes files of both.
    """
    from importlib.util import find_spec

    spec = find_spec("pygame")
    if spec is None:
        raise WorkFailed(f"pygame is not installed; `{sys.executable} -m pip install pygame-ce` mends it")
    folder = Path(next(iter(spec.submodule_search_locations or ())))
    if all(any(folder.parent.glob(f"{name}-*.dist-info")) for name in ("pygame", "pygame_ce")):
        raise WorkFailed(f"pygame and pygame-ce are both installed, in one folder: {folder}; {_way_out()}")
    if spec.origin is None:
        raise WorkFailed(f"pygame is not whole in {folder}; {_way_out()}")


def _way_out() -> str:
    pip = f"{sys.executable} -m pip"
    return f"`{pip} uninstall -y pygame pygame-ce`, then `{pip} install pygame-ce` (or pygame) mends it"


COMMANDS: Mapping[str, tuple[str, ...]] = {
    "play": (
        "open the window (the default command)",
        "linkanim play press",
        "linkanim play my-linkage.toml --theme dark",
        "linkanim play lesson.toml",
    ),
    "new": (
        "open the window with an empty sheet, to build a linkage on",
        "linkanim new",
        "linkanim new --photo digger.jpg",
    ),
    "record": (
        "write a scene's true period as a GIF, a film, numbered pictures or slides",
        "linkanim record press",
        'linkanim record crank-rocker -o rocker.mp4 --speed "30 rpm" --chart rocker.angle',
        "linkanim record press --for beamer",
    ),
    "solve": (
        "print positions, velocities and accelerations at an angle, or over a sweep",
        'linkanim solve press --angle "87 deg" --speed "10 rad/s" --json',
        "linkanim solve slider-crank --sweep 0:360:1 --csv slider.csv",
        "linkanim solve double-rocker --sweep 0:360:5 --phase",
    ),
    "chart": (
        "draw quantities over one true period as PNG, SVG or PDF, or write them as CSV",
        "linkanim chart press --quantity 5.travel_velocity -o ram.svg",
        'linkanim chart press --quantity 3.angular_velocity --speeds "5 rad/s,10 rad/s,20 rad/s"',
        "linkanim chart double-rocker --quantity rocker.angle --over angle -o rocker.csv",
    ),
    "report": (
        "write a hand-out of a few A4 pages: figure, loops, tables and charts, also as SVG and CSV",
        "linkanim report press -o press-report --all",
        'linkanim report press -o press-report --angles "87 deg,306 deg" --speeds "5 rad/s,10 rad/s"',
    ),
    "info": (
        "print the class, input range, toggles, change points, transmission angle and stroke",
        "linkanim info crank-rocker",
        "linkanim info my-linkage.toml --json",
        'linkanim info crank-rocker --tolerance "0.1 mm" --chart off.svg',
    ),
    "closures": (
        "find all ways in which a linkage's lengths can be put together",
        "linkanim closures klann",
        "linkanim closures my-linkage.toml -o closures.gif",
    ),
    "check": (
        "name every problem of scene files, with its line",
        "linkanim check my-linkage.toml",
        "linkanim check *.toml --json",
        "linkanim check --schema",
    ),
    "convert": (
        "write a scene, or a linkage of another program, by its points and links",
        "linkanim convert crank-rocker -o points.toml",
    ),
    "scenes": (
        "list the built-in scenes by chapter",
        "linkanim scenes",
        "linkanim scenes slider",
        'linkanim scenes "six-bars and more"',
    ),
    "draw": (
        "draw one pose as a figure: SVG, PNG or PDF",
        "linkanim draw crank-rocker --names --names",
        'linkanim draw press -o press.png --angle "87 deg" --vectors v --instant-centres',
        "linkanim draw kite -o kite.svg --poses 12 --no-trace",
        "linkanim draw crank-rocker --names --names --for book -o column.svg",
        "linkanim draw lid.toml -o lid.svg --construction",
    ),
    "explain": (
        "work one pose out line by line, with numbers: vector loops, closed forms, linear equations",
        'linkanim explain press --angle "87 deg"',
        'linkanim explain crank-rocker --angle "60 deg" --speed "10 rad/s" -o solution.html',
        'linkanim explain slider-crank --angle "40 deg" --exercise --seed 3 -o sheet.tex',
    ),
    "quiz": (
        "write questions about a scene or a chapter, with solved answers and common misconceptions",
        "linkanim quiz crank-rocker",
        "linkanim quiz press -n 10 --seed 7 -o sheet.html",
        "linkanim quiz four-bars --json",
        "linkanim quiz all -n 64 --moodle questions.xml --qti questions.zip",
    ),
    "share": (
        "write one page that moves in any browser, without a network",
        "linkanim share press",
        'linkanim share crank-rocker -o rocker.html --chart rocker.angle --names --speed "30 rpm"',
        "linkanim share --all site",
    ),
    "path": (
        "find linkages whose coupler point follows a drawn curve, and write them as scenes",
        "linkanim path curve.csv -o follower.toml",
        'linkanim path stroke.svg --open --kind slider-crank --least-angle "30 deg" --json',
        'linkanim path points.csv --timing "20 deg" --box 0,0,200,100 --round "0.1 mm"',
    ),
    "guide": (
        "find linkages that carry a body through two to five poses, and write them as scenes",
        "linkanim guide poses.csv -o lid.toml",
        "linkanim guide poses.csv --pivots 0,0 120,-15",
        'linkanim guide poses.csv --kind slider-crank --box 0,0,200,100 --least-angle "30 deg" --json',
    ),
    "function": (
        "find linkages whose output follows a function, and write them as scenes",
        'linkanim function "y = log10(x)" --from 1 --to 10',
        'linkanim function "y = x^2" --from 0 --to 1 --input "90 deg" --output "60 deg" --chart error.svg',
        'linkanim function table.csv --kind slider-crank --output "80 mm" --points 3',
        'linkanim function "1/x" --from 1 --to 2 --input "30 deg:120 deg" --output "105 deg:165 deg"',
    ),
    "quick-return": (
        "find linkages with a given stroke or swing and time ratio, the best transmission angle first",
        "linkanim quick-return --stroke 80 --ratio 1.4",
        'linkanim quick-return --swing "60 deg" --ratio 1.25 -o rocker.toml --count 1',
        'linkanim quick-return --stroke "8 cm" --ratio 1.4 --place 0.5 --json',
        "linkanim quick-return --kind six-bar --stroke 400 --crank 30 --ratio 1.4 -o shaper.toml",
    ),
    "dwell": (
        "find six-bars whose output rests while the crank turns on, and write them as scenes",
        'linkanim dwell --rest "120 deg" --swing "30 deg"',
        'linkanim dwell --rest "90 deg" --stroke 50 -o feeder.toml --count 1',
        'linkanim dwell --rest "150 deg" --stroke "4 cm" --least-angle "40 deg" --json',
    ),
    "make": (
        "write a scene as parts to cut or print, in layers, with instructions for assembly",
        "linkanim make crank-rocker -o rocker --fit A4",
        "linkanim make press -o press-parts --way laser --thickness 4 --sheet 900x600",
        "linkanim make drag-link -o drag --fit Letter --bridge",
        "linkanim make jansen --fit A4 --preview",
        "linkanim make jansen --preview leg.png",
        "linkanim make jansen --json",
    ),
    "gallery": (
        "record every built-in scene as a small GIF, and draw all of them on one sheet",
        "linkanim gallery",
        "linkanim gallery --into slides/linkages",
    ),
    "bench": (
        "measure speed and error, beside the usual ways to solve a linkage",
        "linkanim bench",
        "linkanim bench --json",
    ),
    "manual": (
        "open the manual as one page that can be searched, or print what it says on a word",
        "linkanim manual",
        "linkanim manual torque",
        "linkanim manual first-hour",
    ),
    "examples": (
        "list numbered examples to copy and change, or copy them",
        "linkanim examples",
        "linkanim examples 06",
        "linkanim examples all -o examples",
    ),
    "completion": (
        "print a script that lets bash, zsh or fish complete commands, options and scenes",
        "linkanim completion bash",
        "linkanim completion fish",
    ),
}
"""Each command: what it does in a line, and examples of its use."""
