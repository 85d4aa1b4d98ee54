"""Which arguments each command takes, in the order of its help; those that several take are written once."""

from __future__ import annotations

from argparse import Action, BooleanOptionalAction, Namespace, _ActionsContainer
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from linkanim import units
from linkanim.bench.command import CHART
from linkanim.cli import values
from linkanim.picture.look import TOGGLES, Look, Option, Toggle
from linkanim.workshop.media import WAYS

EVERY_ANGLE = object()
"""What `--phase` without a value stands for: each angle of the sweep."""

Argument = Callable[[_ActionsContainer], object]
"""What adds an argument, or several, to a parser."""


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


class Further(Action):
    """An option that goes to its step of a field of the look, or a step further; never back."""

    def __call__(self, _parser: object, found: Namespace, _values: object, _word: str | None = None) -> None:
        """Put the step into what is found."""
        steps = TOGGLES[self.dest].steps
        at = steps.index(getattr(found, self.dest))
        to = at + 1 if self.const is None else steps.index(self.const)
        setattr(found, self.dest, steps[max(at, min(to, len(steps) - 1))])


def _takes(*names: str, **how: Any) -> Argument:
    """Return an argument as `add_argument` takes it."""
    return lambda parser: parser.add_argument(*names, **how)


def _value(
    words: str, read: Callable[[str], object], text: str, usual: object = None, **how: Any
) -> Argument:
    """Return an argument with a value: its names and what help calls that, how it is read, its default."""
    *names, metavar = words.split()
    return _takes(*names, metavar=metavar, type=read, help=text, default=usual, **how)


def _flag(name: str, text: str) -> Argument:
    return _takes(name, action="store_true", help=text)


def _either(*arguments: Argument) -> Argument:
    """Return arguments of which one at the most is given."""

    def add(parser: _ActionsContainer) -> None:
        group = parser.add_mutually_exclusive_group()
        for argument in arguments:
            argument(group)

    return add


def _usually(**given: object) -> Argument:
    """Return what a command takes for options that are not given, if not what others do."""
    return lambda parser: parser.set_defaults(**given)


def _scene(more: str = "", **how: Any) -> Argument:
    words = f"a built-in scene's name (see `linkanim scenes`), or the path of a scene file{more}"
    return _takes("scene", help=words, **{"metavar": "SCENE", **how})


def _output(text: str) -> Argument:
    return _value("-o --output OUT", Path, text)


def _speeds(what: str) -> Argument:
    words = f'{what}, such as "5 rad/s,10 rad/s" (default: the scene\'s)'
    return _value("--speeds SPEED[,SPEED...]", values.speeds, words)


def _look(command: str) -> Argument:
    """Return the options that the fields of the look have with a command."""

    def add(parser: _ActionsContainer) -> None:
        for name, toggle in TOGGLES.items():
            for option in toggle.options:
                if command in option.commands:
                    how = {"dest": name, "default": getattr(Look(), name), "help": option.help}
                    parser.add_argument(f"--{option.name}", **how, **_reading(option, toggle, how["default"]))

    return add


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


_SCENE = _scene()
_SIZE = _value("--size WxH", values.size, "pixels (default: 1280x720)")
_WINDOW_SIZE = _value("--size WxH", values.size, "the window's, in pixels")
_TEXT = _takes("--text", choices=("latex",), help="leave a PDF's words to LaTeX, in FIG.pdf_tex beside it")
_ANGLE = _value("--angle ANGLE", units.angle, 'crank angle, such as "87 deg"')
_PHASE = _value("--phase PHASE", units.angle, "phase instead (default: joints farthest apart)")
_SPEED = _value("--speed SPEED", units.angular_speed, 'such as "30 rpm" (default: the scene\'s)')


def _limits(sizes: str) -> tuple[Argument, ...]:
    """Return the limits of what is synthesised."""
    return (
        _value("--box X,Y,W,H", values.box, "in which all fixed pins lie"),
        _value("--largest F", values.positive, f"link, in {sizes} (default: 8)", 8.0),
        _value("--least-angle ANGLE", units.angle, "of transmission", 0.0),
    )


ARGUMENTS: Mapping[str, tuple[Argument, ...]] = {
    "play": (
        _scene(", or of a tape", nargs="?"),
        _flag("--attract", "for a stand: full screen, back to the title when left alone"),
        _WINDOW_SIZE,
        _value("--scores FILE.json", Path, "where best scores are kept (default: the user's data folder)"),
        _value(
            "--game WORDS",
            str,
            'begin with a game: "match level=mine.toml", "follow scene=press", "predict level=2"',
        ),
        _look("play"),
    ),
    "new": (
        _value("--photo FILE", Path, "a photograph to build over"),
        _WINDOW_SIZE,
        _takes("--theme", choices=("light", "dark"), default="light", help="colours (default: light)"),
    ),
    "record": (
        _scene(", or of a tape"),
        _output("OUT.gif, OUT.mp4 or OUT.png (default: SCENE.gif here)"),
        _takes("--for", dest="preset", choices=tuple(PRESETS), help="size, fps and format for a purpose"),
        _SIZE,
        _value("--fps N", values.positive, "frames a second (default: 25)"),
        _SPEED,
        _either(
            _value("--periods N", values.count, "true periods (default: 1)"),
            _value("--seconds S", values.positive, "the clip's length; it need not close"),
        ),
        _flag("--reverse", "run backwards"),
        _look("record"),
        _flag("--noted", "have the text say where a limit or a change point is near"),
        _flag("--photo", "with a tape's photograph behind what is built"),
        _flag("--progress", "show it also where stderr is no terminal"),
    ),
    "solve": (
        _SCENE,
        _ANGLE,
        _value(
            "--phase PHASE",
            units.angle,
            "phase instead of the crank angle, through limits too; 360 deg is one period of the drive "
            "(without a value, beside --sweep: sweep the phase)",
            nargs="?",
            const=EVERY_ANGLE,
        ),
        _value("--sweep A:B:STEP", values.sweep, "a row for each angle from A to B, in degrees"),
        _SPEED,
        _value(
            "--acceleration ACC", units.ANGULAR_ACCELERATION.read, 'such as "2 rad/s^2" (default: 0)', 0.0
        ),
        _either(
            _flag("--json", "one object, or a list of them for a sweep"),
            _value("--csv OUT", str, "write the sweep to the file OUT (- for stdout)"),
        ),
        _look("solve"),
    ),
    "chart": (
        _SCENE,
        _value(
            "--quantity Q[,Q...]",
            str,
            "such as rocker.angular_velocity or B.velocity.x; a wrong one is answered with the list",
            required=True,
        ),
        _output("OUT.png, OUT.svg, OUT.pdf or OUT.csv (default: SCENE.png here)"),
        _TEXT,
        _speeds("a curve for each"),
        _value("--data OTHER.csv", Path, "lay a table over it: what --over says, value"),
        _value("--label TEXT", str, "what that table is called (default: its file's name)"),
        _SIZE,
        _look("chart"),
    ),
    "report": (
        _SCENE,
        _value("-o --output DIR", Path, "the folder to make, or to make anew", required=True),
        _value(
            "--angles ANGLE[,ANGLE...]",
            values.angles,
            'where to tell every quantity, such as "87 deg,306 deg" (default: the start and the extremes)',
        ),
        _speeds("for tables and charts"),
        _value("--digits N", values.digits, "of the tables' numbers (default: 4)", 4),
        _flag("--all", "every quantity, and a chart of each, as well"),
        _look("report"),
    ),
    "info": (_SCENE, _flag("--json", "one object; angles in radians, time in s")),
    "check": (
        _takes("files", nargs="*", metavar="FILE", help="scene files"),
        _flag("--json", "a list of objects, one for each file"),
        _flag("--schema", "print the JSON Schema of scene files"),
    ),
    "scenes": (
        _value(
            "word WORD",
            str,
            "only those whose title, class or chapter has this in it (default: all)",
            nargs="?",
        ),
    ),
    "draw": (
        _SCENE,
        _output("OUT.svg, OUT.png or OUT.pdf (default: SCENE.svg here)"),
        _TEXT,
        _either(_ANGLE, _PHASE),
        _SPEED,
        _SIZE,
        _look("draw"),
        _value("--poses N", values.poses, "N faint poses over the period behind it"),
        _value(
            "--construction N",
            values.count,
            "instead, how `guide`, `function` or `quick-return` made it; the first N steps of that",
            nargs="?",
            const=0,
        ),
        _usually(hud=False),
    ),
    "explain": (
        _SCENE,
        _output("OUT.html, OUT.tex or OUT.md (default: Markdown on stdout)"),
        _either(_ANGLE, _PHASE),
        _SPEED,
        _flag("--exercise", "leave the numbers open, with a key on a page of its own"),
        _value(
            "--seed N",
            values.whole,
            "other round lengths, the same kind of motion; a number gives the same ones always",
        ),
        _look("explain"),
    ),
    "quiz": (
        _scene("; or a chapter, as sliders; or all", metavar="SCENE|CHAPTER"),
        _output("SHEET.html (default: text on stdout)"),
        _value("--moodle OUT.xml", Path, "for Moodle: a category for each chapter, figures and all"),
        _value("--qti OUT.zip", Path, "for Canvas and other learning platforms: a package of QTI 1.2"),
        _value("-n N", values.whole, "how many questions (default: 10)", 10, dest="count"),
        _value("--seed N", values.whole, "a number gives the same questions always (default: 0)", 0),
        _flag("--json", "as a list of objects"),
    ),
    "share": (
        _scene(nargs="?"),
        _output("LINKAGE.html (default: SCENE.html here)"),
        _value("--all DIR", Path, "every built-in scene, and an index of them"),
        _SPEED,
        _look("share"),
        _usually(theme=None),
    ),
    "path": (
        _value("curve CURVE", Path, "two columns x and y (a third with the crank's angles), or an SVG"),
        _output("NAME.toml of the best; the others are NAME-2.toml, ... (default: CURVE.toml here)"),
        _takes("--kind", choices=("four-bar", "slider-crank"), default="four-bar", help="default: four-bar"),
        _value("--timing STEP", values.timing, 'the crank\'s angle a point, "20 deg", or `column`'),
        _value("--count N", values.count, "answers (default: 5)", 5),
        *_limits("sizes of the curve"),
        _value("--round LENGTH", values.step, 'round lengths to, such as "0.1 mm", and fit the rest again'),
        _flag("--open", "the curve does not close"),
        _flag("--cognates", "each four-bar's two Roberts cognates, too"),
        _flag("--json", "a list of objects; angles in radians"),
    ),
    "guide": (
        _value("poses POSES", Path, "a row for each pose: x, y and its angle in degrees; 2 to 5 rows"),
        _value(
            "-o --output NAME.toml",
            Path,
            "of the best; the others are NAME-2.toml, ... (default: POSES.toml)",
        ),
        _takes("--kind", choices=("four-bar", "slider-crank"), default="four-bar", help="default: four-bar"),
        _value("--pivots X,Y", values.pair, "fixed pins that are given, one or two", (), nargs="+"),
        *_limits("sizes of the poses"),
        _takes("--prefer", choices=("compact", "angle"), help="small links, or a large transmission angle"),
        _value("--count N", values.count, "answers (default: 6)", 6),
        _flag("--json", "a list of objects; angles in radians"),
    ),
    "function": (
        _takes("given", metavar="FUNCTION", help='such as "y = log10(x)", or a table of x and y'),
        _value("--from A", values.number, "the first x", dest="first"),
        _value("--to B", values.number, "the last x", dest="last"),
        _takes(
            *("-o", "--file"),
            dest="output_file",
            metavar="NAME.toml",
            type=Path,
            help="of the best; the others are NAME-2.toml, ... (default: function.toml here)",
        ),
        _takes("--kind", choices=("four-bar", "slider-crank"), default="four-bar", help="default: four-bar"),
        _value(
            "--input ANGLE",
            str,
            'over which the crank turns, "60 deg", or from where to where, "30 deg:90 deg" (default: any)',
        ),
        _value(
            "--output RANGE",
            str,
            'likewise of the rocker, or of the slider "80 mm" (default: any, or 100 mm)',
        ),
        _value("--points N", values.count, "precision points, 3 to 5 (default: as many as there can be)"),
        _flag("--chebyshev", "keep the precision points where Chebyshev has them"),
        _value("--count N", values.count, "answers (default: 3)", 3),
        _value("--chart ERROR", Path, "draw the best one's structural error, as SVG, PNG, PDF or CSV"),
        _flag("--json", "a list of objects; angles in radians"),
    ),
    "quick-return": (
        _value("--ratio Q", values.positive, "the slow way's time over the quick way's", required=True),
        _value("--stroke L", values.length, "of the slider, in mm; of a rocker's pin, the chord"),
        _value("--swing ANGLE", units.angle, 'of the rocker, such as "60 deg"'),
        _takes("--kind", choices=("slider-crank", "crank-rocker"), help="default: what the output is"),
        _value("--place S", values.number, "one member of the family, from 0 to 1, instead of the best"),
        _value("--count N", values.count, "answers: the best, and others of its family (default: 5)", 5),
        _output("NAME.toml of the best; the others are NAME-2.toml, ... (default: quick-return.toml here)"),
        _flag("--json", "a list of objects; angles in radians"),
    ),
    "make": (
        _SCENE,
        _value("-o --output FOLDER", Path, "the folder to make, or to make anew"),
        _takes("--way", choices=WAYS, default=WAYS[0], help="of making it (default: cardboard)"),
        _value("--bar W", values.millimetres, "how wide bars are, in mm (default: for the scene's size)"),
        _value("--hole D", values.millimetres, "how wide holes are (default: two fifths of a bar, or 6)"),
        _value("--thickness T", values.millimetres, "of the material (default: 1.5, 3 or 4, by the way)"),
        _value("--clearance C", values.millimetres, "of a pin in its hole (default: 0, 0.2 or 0.4)"),
        _value("--gap G", values.millimetres, "at which parts pass in a layer (default: 0.5)", 0.5),
        _value("--kerf K", values.millimetres, "what the cut takes away (default: 0)", 0.0),
        _value("--sheet WxH", values.sheet, "of the material, in mm, or a page, A4 or Letter"),
        _value("--fit PAGE", str, "A4 or Letter: scale all parts to fit one (default: true size)"),
        _value("--preview PICTURE", Path, "draw the layers, from above and lifted off: .svg, .png or .pdf"),
        _flag("--bridge", "fixed pins may hang from a plate above, where they stand in the way below"),
        _flag("--json", "print parts and pins as one object; lengths in mm"),
    ),
    "gallery": (_value("--into FOLDER", Path, "where to (default: recordings)", Path("recordings")),),
    "bench": (
        _either(
            _flag("--json", "one object"),
            _flag("--markdown", "the table of speed and error as in the README"),
        ),
        _flag("--path", "measure what `linkanim path` finds instead"),
        _value("--seconds S", values.positive, "of its global search (default: 600)", 600.0),
        _value("--into FOLDER", Path, f"where {CHART} goes (default: recordings)", Path("recordings")),
    ),
    "manual": (
        _takes(
            "word", nargs="*", metavar="WORD", help="print the chapter of that name, or what it says on it"
        ),
        _output("OUT.html, the whole manual; it is not opened then"),
    ),
    "examples": (
        _takes("names", nargs="*", metavar="NAME", help="a number, a file's name, or `all` (default: list)"),
        _value("-o --output DIR", Path, "the folder to copy to (default: the current one)"),
    ),
    "completion": (_takes("shell", choices=("bash", "zsh", "fish"), help="the shell to write it for"),),
}
"""The arguments of each command."""


def inputs_of(options: Namespace) -> list[str | Path]:
    """Return the paths that a command reads: its scene's, where that is a file, and a table's."""
    return [path for name in ("scene", "data") if (path := getattr(options, name, None)) is not None]
