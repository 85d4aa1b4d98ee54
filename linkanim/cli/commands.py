"""Every command with its options, and which module does its work."""

from __future__ import annotations

import sys
from argparse import BooleanOptionalAction, Namespace
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from typing import cast

from linkanim import __version__, units
from linkanim.bench.command import add_arguments
from linkanim.cli import values
from linkanim.cli.parser import Parser, join_negative, valued
from linkanim.cli.presets import PRESETS
from linkanim.errors import BadInput
from linkanim.units import shown

IN_SCENE = "a built-in scene's name (see `linkanim scenes`), or the path of a scene file"
EVERY_ANGLE = object()
"""What `--phase` without a value stands for: each angle of the sweep."""


@dataclass(frozen=True)
class Command:
    """A command: what it does in a line, its options, and examples of its use."""

    summary: str
    options: Callable[[Parser], None]
    examples: tuple[str, ...]


def parse(argv: Sequence[str] | None = None) -> Namespace:
    """Read a command line (default: the process's own); `BadInput` in one sentence where it is wrong."""
    words = join_negative(sys.argv[1:] if argv is None else argv)
    return build().parse_args(_with_command(words))


def run(options: Namespace) -> None:
    """Import the module of the chosen command, and only that, and let it do its work."""
    work = cast(Callable[[Namespace], None], import_module(f"linkanim.cli.{options.command}").run)
    work(options)


def build() -> Parser:
    """Build the parser with every command in it; imports nothing that draws, solves or encodes."""
    parser = Parser(
        prog="linkanim",
        usage="linkanim [SCENE | FILE.toml | FILE.tape.json]\n       linkanim COMMAND ...",
        description="Play planar linkages: see them run, solve them exactly, record loops without a seam.",
        before=_keys,
        examples=(
            "linkanim                                  open the window",
            "linkanim press                            open it on the press",
            "linkanim record press -o press.gif        one period as a GIF, no display needed",
            'linkanim solve press --angle "87 deg"',
        ),
    )
    parser.add_argument("--version", action="version", version=f"linkanim {__version__}")
    add = parser.add_subparsers(
        dest="command", metavar="COMMAND", prog="linkanim", parser_class=Parser, title="commands"
    )
    for name, command in COMMANDS.items():
        about = command.summary
        text = f"{about[0].upper()}{about[1:]}."
        command.options(add.add_parser(name, help=about, description=text, examples=command.examples))
    return parser


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
    from linkanim.document import meant
    from linkanim.scenes import names

    known = (*COMMANDS, *names())
    if word in known or any(mark in word for mark in "./\\"):
        return
    raise BadInput(
        f"{shown(word)} is neither a command ({', '.join(COMMANDS)}), a scene (`linkanim scenes` lists them) "
        f"nor a file{meant(word, known)}"
    )


def _play(parser: Parser) -> None:
    parser.add_argument("scene", nargs="?", metavar="SCENE", help=f"{IN_SCENE}, or of a tape")
    parser.add_argument(
        "--attract", action="store_true", help="walk through the scenes when no key is pressed for a minute"
    )
    parser.add_argument("--size", type=valued(values.size), metavar="WxH", help="the window's, in pixels")
    _theme(parser)


def _record(parser: Parser) -> None:
    parser.add_argument("scene", metavar="SCENE", help=f"{IN_SCENE}, or of a tape")
    parser.add_argument(
        "-o",
        "--output",
        type=Path,
        metavar="OUT",
        help="OUT.gif, OUT.mp4 or OUT.png (default: SCENE.gif here)",
    )
    parser.add_argument(
        "--for", dest="preset", choices=tuple(PRESETS), help="size, fps and format for a purpose"
    )
    _clip(parser)
    _look(parser)
    parser.add_argument("--progress", action="store_true", help="show it also where stderr is no terminal")


def _clip(parser: Parser) -> None:
    """How long, how fast and how large."""
    parser.add_argument("--size", type=valued(values.size), metavar="WxH", help="pixels (default: 1280x720)")
    parser.add_argument(
        "--fps", type=valued(values.positive), metavar="N", help="frames a second (default: 25)"
    )
    _speed(parser)
    length = parser.add_mutually_exclusive_group()
    length.add_argument("--periods", type=valued(values.count), metavar="N", help="true periods (default: 1)")
    length.add_argument(
        "--seconds", type=valued(values.positive), metavar="S", help="the clip's length; it need not close"
    )
    parser.add_argument("--reverse", action="store_true", help="run backwards")


def _look(parser: Parser) -> None:
    """What is shown."""
    _shown(parser)
    parser.add_argument("--hud", action=BooleanOptionalAction, default=True, help="the lines of text")
    parser.add_argument(
        "--noted", action="store_true", help="say in them where a limit or a change point is near"
    )
    parser.add_argument("--chart", metavar="QTY", help="a quantity over the period, such as rocker.angle")
    _theme(parser)
    parser.add_argument("--transparent", action="store_true", help="no background (GIF and PNG)")


def _shown(parser: Parser) -> None:
    """What is shown of the motion itself."""
    parser.add_argument(
        "--trace", action=BooleanOptionalAction, default=True, help="curves of the traced joints"
    )
    parser.add_argument(
        "--vectors",
        type=valued(values.vectors),
        default=frozenset(),
        metavar="v,a",
        help="velocity, acceleration",
    )
    parser.add_argument(
        "--names",
        action="count",
        default=0,
        help="name joints and links; twice: their dimensions and the input's angle, too",
    )
    parser.add_argument(
        "--polygons", action="store_true", help="velocity and acceleration polygons beside the linkage"
    )
    parser.add_argument(
        "--instant-centres",
        action="store_true",
        help="mark the instant centres of all links, of more than five those to the ground",
    )
    parser.add_argument(
        "--centrodes", action="store_true", help="and the curves that the coupler's runs along"
    )


def _theme(parser: Parser) -> None:
    parser.add_argument("--theme", choices=("light", "dark"), default="light", help="default: light")


def _solve(parser: Parser) -> None:
    parser.add_argument("scene", metavar="SCENE", help=IN_SCENE)
    parser.add_argument(
        "--angle", type=valued(units.angle), metavar="ANGLE", help='crank angle, such as "87 deg"'
    )
    parser.add_argument(
        "--phase",
        type=valued(units.angle),
        nargs="?",
        const=EVERY_ANGLE,
        metavar="PHASE",
        help="phase instead of the crank angle, through limits too; 360 deg is one period of the drive "
        "(without a value, beside --sweep: sweep the phase)",
    )
    parser.add_argument(
        "--sweep",
        type=valued(values.sweep),
        metavar="A:B:STEP",
        help="a row for each angle from A to B, in degrees",
    )
    _speed(parser)
    parser.add_argument(
        "--acceleration",
        type=valued(units.angular_acceleration),
        default=0.0,
        metavar="ACC",
        help='such as "2 rad/s^2" (default: 0)',
    )
    form = parser.add_mutually_exclusive_group()
    form.add_argument("--json", action="store_true", help="one object, or a list of them for a sweep")
    form.add_argument("--csv", metavar="OUT", help="write the sweep to the file OUT (- for stdout)")


def _speed(parser: Parser) -> None:
    parser.add_argument(
        "--speed",
        type=valued(units.angular_speed),
        metavar="SPEED",
        help='such as "30 rpm" (default: the scene\'s)',
    )


def _info(parser: Parser) -> None:
    parser.add_argument("scene", metavar="SCENE", help=IN_SCENE)
    parser.add_argument("--json", action="store_true", help="one object; angles in radians, time in s")


def _check(parser: Parser) -> None:
    parser.add_argument("files", nargs="*", metavar="FILE", help="scene files")
    parser.add_argument("--json", action="store_true", help="a list of objects, one for each file")
    parser.add_argument("--schema", action="store_true", help="print the JSON Schema of scene files")


def _scenes(parser: Parser) -> None:
    parser.add_argument(
        "word",
        nargs="?",
        metavar="WORD",
        help="only those whose title, class or chapter has this in it (default: all)",
    )


def _chart(parser: Parser) -> None:
    parser.add_argument("scene", metavar="SCENE", help=IN_SCENE)
    parser.add_argument(
        "--quantity",
        required=True,
        metavar="Q[,Q...]",
        help="such as rocker.angular_velocity or B.velocity.x; a wrong one is answered with the list",
    )
    parser.add_argument(
        "-o",
        "--output",
        type=Path,
        metavar="OUT",
        help="OUT.png, OUT.svg, OUT.pdf or OUT.csv (default: SCENE.png here)",
    )
    parser.add_argument(
        "--over",
        choices=("angle", "time", "phase"),
        help="default: the driven bar's angle, of an input that swings the time",
    )
    parser.add_argument(
        "--speeds",
        metavar="SPEED[,SPEED...]",
        help='a curve for each, such as "5 rad/s,10 rad/s" (default: the scene\'s)',
    )
    parser.add_argument(
        "--data", type=Path, metavar="OTHER.csv", help="lay a table over it: angle in degrees, value"
    )
    parser.add_argument(
        "--label", metavar="TEXT", help="what that table is called (default: its file's name)"
    )
    parser.add_argument("--size", type=valued(values.size), metavar="WxH", help="pixels (default: 1280x720)")
    _theme(parser)


def _draw(parser: Parser) -> None:
    parser.add_argument("scene", metavar="SCENE", help=IN_SCENE)
    parser.add_argument(
        "-o",
        "--output",
        type=Path,
        metavar="OUT",
        help="OUT.svg, OUT.png or OUT.pdf (default: SCENE.svg here)",
    )
    where = parser.add_mutually_exclusive_group()
    where.add_argument(
        "--angle", type=valued(units.angle), metavar="ANGLE", help='crank angle, such as "87 deg"'
    )
    where.add_argument(
        "--phase", type=valued(units.angle), metavar="PHASE", help="phase instead (default: the start)"
    )
    parser.add_argument("--size", type=valued(values.size), metavar="WxH", help="pixels (default: 1280x720)")
    _shown(parser)
    parser.add_argument("--ghost", action="store_true", help="the other closure, faintly")
    parser.add_argument(
        "--poses", type=valued(values.poses), metavar="N", help="N faint poses over the period behind it"
    )
    _theme(parser)
    parser.add_argument("--transparent", action="store_true", help="no background")


def _report(parser: Parser) -> None:
    parser.add_argument("scene", metavar="SCENE", help=IN_SCENE)
    parser.add_argument(
        "-o", "--output", type=Path, required=True, metavar="DIR", help="the folder to make, or to make anew"
    )
    parser.add_argument(
        "--angles",
        metavar="ANGLE[,ANGLE...]",
        help='where to tell every quantity, such as "87 deg,306 deg" (default: the start and the extremes)',
    )
    parser.add_argument(
        "--speeds",
        metavar="SPEED[,SPEED...]",
        help='for tables and charts, such as "5 rad/s,10 rad/s" (default: the scene\'s)',
    )


def _gallery(parser: Parser) -> None:
    parser.add_argument(
        "--into",
        type=Path,
        default=Path("recordings"),
        metavar="FOLDER",
        help="where to (default: recordings)",
    )


def _bench(parser: Parser) -> None:
    add_arguments(parser)


COMMANDS = {
    "play": Command(
        "open the window (the default command)",
        _play,
        ("linkanim play press", "linkanim play my-linkage.toml --theme dark"),
    ),
    "record": Command(
        "write a scene's true period as GIF, MP4 or numbered PNG",
        _record,
        (
            "linkanim record press",
            'linkanim record crank-rocker -o rocker.mp4 --speed "30 rpm" --chart rocker.angle',
            "linkanim record press --for beamer",
        ),
    ),
    "solve": Command(
        "print positions, velocities and accelerations at an angle, or over a sweep",
        _solve,
        (
            'linkanim solve press --angle "87 deg" --speed "10 rad/s" --json',
            "linkanim solve slider-crank --sweep 0:360:1 --csv slider.csv",
            "linkanim solve double-rocker --sweep 0:360:5 --phase",
        ),
    ),
    "chart": Command(
        "draw quantities over one true period as PNG or SVG, or write them as CSV",
        _chart,
        (
            "linkanim chart press --quantity 5.travel_velocity -o ram.svg",
            'linkanim chart press --quantity 3.angular_velocity --speeds "5 rad/s,10 rad/s,20 rad/s"',
            "linkanim chart double-rocker --quantity rocker.angle --over angle -o rocker.csv",
        ),
    ),
    "report": Command(
        "write a page with a scene's figure, facts, tables and charts, and their SVG and CSV",
        _report,
        (
            "linkanim report press -o press-report",
            'linkanim report press -o press-report --angles "87 deg,306 deg" --speeds "5 rad/s,10 rad/s"',
        ),
    ),
    "info": Command(
        "print class, input range, toggles, change points, transmission angle, stroke",
        _info,
        ("linkanim info crank-rocker", "linkanim info my-linkage.toml --json"),
    ),
    "check": Command(
        "name every problem of scene files at once, with their lines",
        _check,
        ("linkanim check my-linkage.toml", "linkanim check *.toml --json", "linkanim check --schema"),
    ),
    "scenes": Command(
        "list the built-in scenes by chapter, name first",
        _scenes,
        ("linkanim scenes", "linkanim scenes slider", 'linkanim scenes "six-bars and more"'),
    ),
    "draw": Command(
        "draw one pose as a figure, SVG or PNG",
        _draw,
        (
            "linkanim draw crank-rocker --names --names",
            'linkanim draw press -o press.png --angle "87 deg" --vectors v --instant-centres',
            "linkanim draw kite -o kite.svg --poses 12 --no-trace",
        ),
    ),
    "gallery": Command(
        "record every built-in scene as a small GIF, and draw the chart of bench",
        _gallery,
        ("linkanim gallery", "linkanim gallery --into slides/linkages"),
    ),
    "bench": Command(
        "measure speed against error, beside the usual ways to solve a linkage",
        _bench,
        ("linkanim bench", "linkanim bench --draw", "linkanim bench --record --json"),
    ),
}
