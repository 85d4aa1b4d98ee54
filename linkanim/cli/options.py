"""Which options each command takes; those that several take are written once."""

from __future__ import annotations

from argparse import Action, BooleanOptionalAction, Namespace, _ActionsContainer
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from linkanim import units
from linkanim.cli import values
from linkanim.cli.parser import Parser
from linkanim.picture.look import TOGGLES, Look, Option, Toggle

IN_SCENE = "a built-in scene's name (see `linkanim scenes`), or the path of a scene file"
EVERY_ANGLE = object()
"""What `--phase` without a value stands for: each angle of the sweep."""


@dataclass(frozen=True)
class Preset:
    """What `record --for` stands for: size in pixels, frames a second, the suffix of the format."""

    size: tuple[int, int]
    fps: float
    suffix: str


DEFAULT = Preset((1280, 720), 25.0, ".gif")

PRESETS = {
    "slides": DEFAULT,
    "beamer": Preset((1280, 720), 25.0, ".png"),
    "web": Preset((640, 360), 20.0, ".gif"),
}


def play(parser: Parser) -> None:
    """Add what the window takes."""
    parser.add_argument("scene", nargs="?", metavar="SCENE", help=f"{IN_SCENE}, or of a tape")
    parser.add_argument(
        "--attract", action="store_true", help="for a stand: full screen, back to the title when left alone"
    )
    parser.add_argument("--size", type=values.size, metavar="WxH", help="the window's, in pixels")
    kept = "where best scores are kept (default: the user's data folder)"
    parser.add_argument("--scores", type=Path, metavar="FILE.json", help=kept)
    at_once = 'begin with a game: "match level=mine.toml", "follow scene=press", "predict level=2"'
    parser.add_argument("--game", metavar="WORDS", help=at_once)
    _look(parser, "play")


def new(parser: Parser) -> None:
    """Add what a window with an empty sheet takes."""
    parser.add_argument("--photo", type=Path, metavar="FILE", help="a photograph to build over")
    parser.add_argument("--size", type=values.size, metavar="WxH", help="the window's, in pixels")
    parser.add_argument(
        "--theme", choices=("light", "dark"), default="light", help="colours (default: light)"
    )


def record(parser: Parser) -> None:
    """Add what a recording takes."""
    parser.add_argument("scene", metavar="SCENE", help=f"{IN_SCENE}, or of a tape")
    _output(parser, "OUT.gif, OUT.mp4 or OUT.png (default: SCENE.gif here)")
    parser.add_argument(
        "--for", dest="preset", choices=tuple(PRESETS), help="size, fps and format for a purpose"
    )
    _clip(parser)
    _look(parser, "record")
    parser.add_argument(
        "--noted", action="store_true", help="have the text say where a limit or a change point is near"
    )
    parser.add_argument("--photo", action="store_true", help="with a tape's photograph behind what is built")
    parser.add_argument("--progress", action="store_true", help="show it also where stderr is no terminal")


def _clip(parser: Parser) -> None:
    """How long, how fast and how large."""
    _size(parser)
    parser.add_argument("--fps", type=values.positive, metavar="N", help="frames a second (default: 25)")
    _speed(parser)
    length = parser.add_mutually_exclusive_group()
    length.add_argument("--periods", type=values.count, metavar="N", help="true periods (default: 1)")
    length.add_argument(
        "--seconds", type=values.positive, metavar="S", help="the clip's length; it need not close"
    )
    parser.add_argument("--reverse", action="store_true", help="run backwards")


def _size(parser: Parser) -> None:
    parser.add_argument("--size", type=values.size, metavar="WxH", help="pixels (default: 1280x720)")


def _output(parser: Parser, text: str) -> None:
    parser.add_argument("-o", "--output", type=Path, metavar="OUT", help=text)


def _text(parser: Parser) -> None:
    words = "leave a PDF's words to LaTeX, in FIG.pdf_tex beside it"
    parser.add_argument("--text", choices=("latex",), help=words)


def _angle(parser: _ActionsContainer) -> None:
    words = 'crank angle, such as "87 deg"'
    parser.add_argument("--angle", type=units.angle, metavar="ANGLE", help=words)


def _pose(parser: Parser) -> None:
    """One pose: by angle or by phase."""
    where = parser.add_mutually_exclusive_group()
    _angle(where)
    where.add_argument(
        "--phase", type=units.angle, metavar="PHASE", help="phase instead (default: joints farthest apart)"
    )


def _speeds(parser: Parser, what: str) -> None:
    words = f'{what}, such as "5 rad/s,10 rad/s" (default: the scene\'s)'
    parser.add_argument("--speeds", type=values.speeds, metavar="SPEED[,SPEED...]", help=words)


def _look(parser: Parser, command: str) -> None:
    """What is shown: the options that the fields of the look have."""
    for name, toggle in TOGGLES.items():
        for option in toggle.options:
            if command in option.commands:
                how = {"dest": name, "default": getattr(Look(), name), "help": option.help}
                parser.add_argument(f"--{option.name}", **how, **_reading(option, toggle, how["default"]))


def _reading(option: Option, toggle: Toggle, usual: object) -> dict[str, Any]:
    """Return how argparse reads an option of a field of the look."""
    match usual:
        case bool() if option.step is None:
            return {"action": BooleanOptionalAction}
        case int():
            return {"action": Further, "const": option.step, "nargs": 0}
        case frozenset():
            return {"type": values.vectors, "metavar": option.metavar}
    return {"choices": toggle.steps} if toggle.steps else {"metavar": option.metavar}


class Further(Action):
    """An option that goes to its step of a field of the look, or a step further; never back."""

    def __call__(self, _parser: object, found: Namespace, _values: object, _word: str | None = None) -> None:
        """Put the step into what is found."""
        steps = TOGGLES[self.dest].steps
        at = steps.index(getattr(found, self.dest))
        to = at + 1 if self.const is None else steps.index(self.const)
        setattr(found, self.dest, steps[max(at, min(to, len(steps) - 1))])


def solve(parser: Parser) -> None:
    """Add what solving takes."""
    parser.add_argument("scene", metavar="SCENE", help=IN_SCENE)
    _angle(parser)
    parser.add_argument(
        "--phase",
        type=units.angle,
        nargs="?",
        const=EVERY_ANGLE,
        metavar="PHASE",
        help="phase instead of the crank angle, through limits too; 360 deg is one period of the drive "
        "(without a value, beside --sweep: sweep the phase)",
    )
    parser.add_argument(
        "--sweep", type=values.sweep, metavar="A:B:STEP", help="a row for each angle from A to B, in degrees"
    )
    _speed(parser)
    parser.add_argument(
        "--acceleration",
        type=units.ANGULAR_ACCELERATION.read,
        default=0.0,
        metavar="ACC",
        help='such as "2 rad/s^2" (default: 0)',
    )
    form = parser.add_mutually_exclusive_group()
    form.add_argument("--json", action="store_true", help="one object, or a list of them for a sweep")
    form.add_argument("--csv", metavar="OUT", help="write the sweep to the file OUT (- for stdout)")
    _look(parser, "solve")


def _speed(parser: Parser) -> None:
    parser.add_argument(
        "--speed", type=units.angular_speed, metavar="SPEED", help='such as "30 rpm" (default: the scene\'s)'
    )


def info(parser: Parser) -> None:
    """Add what telling of a linkage takes."""
    parser.add_argument("scene", metavar="SCENE", help=IN_SCENE)
    parser.add_argument("--json", action="store_true", help="one object; angles in radians, time in s")


def check(parser: Parser) -> None:
    """Add what checking scene files takes."""
    parser.add_argument("files", nargs="*", metavar="FILE", help="scene files")
    parser.add_argument("--json", action="store_true", help="a list of objects, one for each file")
    parser.add_argument("--schema", action="store_true", help="print the JSON Schema of scene files")


def scenes(parser: Parser) -> None:
    """Add what listing the scenes takes."""
    parser.add_argument(
        "word",
        nargs="?",
        metavar="WORD",
        help="only those whose title, class or chapter has this in it (default: all)",
    )


def chart(parser: Parser) -> None:
    """Add what a chart takes."""
    parser.add_argument("scene", metavar="SCENE", help=IN_SCENE)
    parser.add_argument(
        "--quantity",
        required=True,
        metavar="Q[,Q...]",
        help="such as rocker.angular_velocity or B.velocity.x; a wrong one is answered with the list",
    )
    _output(parser, "OUT.png, OUT.svg, OUT.pdf or OUT.csv (default: SCENE.png here)")
    _text(parser)
    _speeds(parser, "a curve for each")
    parser.add_argument(
        "--data", type=Path, metavar="OTHER.csv", help="lay a table over it: what --over says, value"
    )
    parser.add_argument(
        "--label", metavar="TEXT", help="what that table is called (default: its file's name)"
    )
    _size(parser)
    _look(parser, "chart")


def draw(parser: Parser) -> None:
    """Add what a figure takes."""
    parser.add_argument("scene", metavar="SCENE", help=IN_SCENE)
    _output(parser, "OUT.svg, OUT.png or OUT.pdf (default: SCENE.svg here)")
    _text(parser)
    _pose(parser)
    _speed(parser)
    _size(parser)
    _look(parser, "draw")
    parser.add_argument(
        "--poses", type=values.poses, metavar="N", help="N faint poses over the period behind it"
    )
    parser.set_defaults(hud=False)


def share(parser: Parser) -> None:
    """Add what a page that moves takes."""
    parser.add_argument("scene", nargs="?", metavar="SCENE", help=IN_SCENE)
    _output(parser, "LINKAGE.html (default: SCENE.html here)")
    parser.add_argument("--all", type=Path, metavar="DIR", help="every built-in scene, and an index of them")
    _speed(parser)
    _look(parser, "share")
    parser.set_defaults(theme=None)


def explain(parser: Parser) -> None:
    """Add what a worked solution takes."""
    parser.add_argument("scene", metavar="SCENE", help=IN_SCENE)
    _output(parser, "OUT.html, OUT.tex or OUT.md (default: Markdown on stdout)")
    _pose(parser)
    _speed(parser)
    text = "leave the numbers open, with a key on a page of its own"
    parser.add_argument("--exercise", action="store_true", help=text)
    text = "other round lengths, the same kind of motion; a number gives the same ones always"
    parser.add_argument("--seed", type=int, metavar="N", help=text)
    _look(parser, "explain")


def quiz(parser: Parser) -> None:
    """Add what a round of questions takes."""
    parser.add_argument("scene", metavar="SCENE|CHAPTER", help=f"{IN_SCENE}; or a chapter, as sliders")
    _output(parser, "SHEET.html (default: text on stdout)")
    text = "how many questions (default: 10)"
    parser.add_argument("-n", dest="count", type=int, default=10, metavar="N", help=text)
    text = "a number gives the same questions always (default: 0)"
    parser.add_argument("--seed", type=int, default=0, metavar="N", help=text)
    parser.add_argument("--json", action="store_true", help="as a list of objects")


def report(parser: Parser) -> None:
    """Add what a report takes."""
    parser.add_argument("scene", metavar="SCENE", help=IN_SCENE)
    parser.add_argument(
        "-o", "--output", type=Path, required=True, metavar="DIR", help="the folder to make, or to make anew"
    )
    parser.add_argument(
        "--angles",
        type=values.angles,
        metavar="ANGLE[,ANGLE...]",
        help='where to tell every quantity, such as "87 deg,306 deg" (default: the start and the extremes)',
    )
    _speeds(parser, "for tables and charts")
    text = "of the tables' numbers (default: 4)"
    parser.add_argument("--digits", type=values.digits, default=4, metavar="N", help=text)
    parser.add_argument("--all", action="store_true", help="every quantity, and a chart of each, as well")
    _look(parser, "report")


def path(parser: Parser) -> None:
    """Add what finding linkages for a path takes."""
    text = "two columns x and y (a third with the crank's angles), or an SVG"
    parser.add_argument("curve", type=Path, metavar="CURVE", help=text)
    _output(parser, "NAME.toml of the best; the others are NAME-2.toml, ... (default: CURVE.toml here)")
    kinds = ("four-bar", "slider-crank")
    parser.add_argument("--kind", choices=kinds, default=kinds[0], help=f"default: {kinds[0]}")
    for name, read, usual, metavar, text in _PATH:
        parser.add_argument(name, type=read, default=usual, metavar=metavar, help=text)
    parser.add_argument("--open", action="store_true", help="the curve does not close")
    parser.add_argument("--cognates", action="store_true", help="each four-bar's two Roberts cognates, too")
    parser.add_argument("--json", action="store_true", help="a list of objects; angles in radians")


_PATH: tuple[tuple[str, Callable[[str], object], object, str, str], ...] = (
    ("--timing", values.timing, None, "STEP", 'the crank\'s angle a point, "20 deg", or `column`'),
    ("--count", values.count, 5, "N", "answers (default: 5)"),
    ("--box", values.box, None, "X,Y,W,H", "in which all fixed pins lie"),
    ("--largest", values.positive, 8.0, "F", "link, in sizes of the curve (default: 8)"),
    ("--least-angle", units.angle, 0.0, "ANGLE", "of transmission"),
    ("--round", values.step, None, "LENGTH", 'round lengths to, such as "0.1 mm", and fit the rest again'),
)
"""Options of `path` that take a value: how it is read, its default, what help calls it."""


def gallery(parser: Parser) -> None:
    """Add what the gallery takes."""
    parser.add_argument(
        "--into",
        type=Path,
        default=Path("recordings"),
        metavar="FOLDER",
        help="where to (default: recordings)",
    )
