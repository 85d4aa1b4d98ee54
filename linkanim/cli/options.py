"""Say which arguments a command takes, in the order of its help, and what their texts mean.

Arguments that several commands take are written once; those of commands that show pictures stand in
`picture_arguments`. Each reader of a text raises `BadInput` in one sentence. The parser is argparse with one
line for a usage error and `-30 deg` taken as a value.
"""

from __future__ import annotations

import argparse
import math
import re
from argparse import Namespace, _ActionsContainer
from collections.abc import Callable, Mapping, Sequence
from decimal import Decimal, InvalidOperation
from pathlib import Path
from typing import Any, NoReturn, TypeVar

from linkanim import units
from linkanim.bounds import NUMBERS, can_be_computed
from linkanim.errors import BadInput
from linkanim.intake import meant
from linkanim.units import shown
from linkanim.words import LANGUAGES, language_named

# What the options' texts mean: sizes, counts, sweeps; each raises `BadInput` in one sentence.

MOST_ROWS = 1_000_000


def sweep(text: str) -> tuple[Decimal, Decimal, int]:
    """Read `a:b:step` in degrees, exactly as typed: the first angle, the step, and how many angles.

    b is included where it falls on a step.
    """
    parts = text.split(":")
    if len(parts) != 3:
        raise BadInput(f"{shown(text)} is not FIRST:LAST:STEP in degrees, such as 0:360:1")
    first, last, step = (_decimal(part, text) for part in parts)
    if step == 0 or (last - first) * step < 0:
        raise BadInput(f"the step of {shown(text)} does not lead from {first} to {last}; give one that does")
    if abs(last - first) >= abs(step) * MOST_ROWS:
        raise BadInput(f"{shown(text)} has more than {MOST_ROWS:,} rows; take a longer step")
    return first, step, int((last - first) / step) + 1


def _decimal(part: str, text: str) -> Decimal:
    try:
        value = Decimal(part.strip())
    except InvalidOperation:
        raise BadInput(f"{shown(part)} in {shown(text)} is not a number of degrees") from None
    if not value.is_finite() or abs(value) > Decimal("1e12"):
        raise BadInput(f"{shown(part)} in {shown(text)} is not a number of degrees between -1e12 and 1e12")
    return value


def number(text: str) -> float:
    """Read a finite number."""
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise BadInput(f"{shown(text)} is not a finite number")
    return value


def positive(text: str) -> float:
    """Read a finite number greater than zero."""
    try:
        value = number(text)
    except BadInput:
        value = 0.0
    if value <= 0:
        raise BadInput(f"{shown(text)} is not a number greater than zero")
    return value


def language(text: str) -> str:
    """Read the name of a language, such as zh_TW."""
    found = language_named(text)
    if found is None:
        raise BadInput(f"{shown(text)} is not a language that is here; there are {', '.join(LANGUAGES)}")
    return found


T = TypeVar("T")


def bounded(read: Callable[[str], T]) -> Callable[[str], T]:
    """Return a reader that refuses numbers, or lists of them, that are too large or small to compute with."""

    def read_within_bounds(text: str) -> T:
        value = read(text)
        several = (
            value.values() if isinstance(value, Mapping) else value if isinstance(value, tuple) else [value]
        )
        if not all(can_be_computed(one) for one in several if isinstance(one, float)):
            raise BadInput(f"{shown(text)} is beyond what can be computed; give {NUMBERS}")
        return value

    return read_within_bounds


def count(text: str) -> int:
    """Read a whole number of at least one."""
    if not re.fullmatch(r"\d{1,6}", text) or int(text) == 0:
        raise BadInput(f"{shown(text)} is not a whole number from 1 to 999999")
    return int(text)


def whole(text: str) -> int:
    """Read a whole number of at most 18 digits."""
    if not re.fullmatch(r"[+-]?[0-9]{1,18}", text):
        raise BadInput(f"{shown(text)} is not a whole number of at most 18 digits")
    return int(text)


def either_speed(text: str) -> Any:
    """Read a speed: an angular one in rad/s, or a length in a time; what has neither unit is told of both."""
    units.EITHER_SPEED.read(text)
    if not units.names_unit(text, units.TRAVEL_SPEED):
        return units.angular_speed(text)
    from linkanim.scenes.form import TravelSpeed  # so that no other command loads it

    return TravelSpeed(units.TRAVEL_SPEED.read(text))


def box(text: str) -> tuple[float, ...]:
    """Read four numbers with commas between: x, y, width and height."""
    return _numbers(text, 4, "X,Y,W,H: four numbers with commas between, such as 0,0,200,100")


def pair(text: str) -> tuple[float, float]:
    """Read two numbers with a comma between: x and y."""
    x, y = _numbers(text, 2, "X,Y: two numbers with a comma between, such as 20,-40")
    return x, y


def _numbers(text: str, count: int, form: str) -> tuple[float, ...]:
    """Read `count` finite numbers; `BadInput` says the form in which they are written."""
    try:
        values = tuple(map(float, text.split(",")))
    except ValueError:
        values = ()
    if len(values) != count or not all(map(math.isfinite, values)):
        raise BadInput(f"{shown(text.strip())} is not {form}")
    return values


def length(text: str) -> float:
    """Read a length above zero in mm, which needs no unit."""
    value = units.length(text, unit="mm")
    if value <= 0:
        raise BadInput(f"{shown(text)} is no length above zero; give one such as 80 mm")
    return value


def step(text: str) -> float:
    """Read a length above zero in mm, such as `0.1 mm`."""
    value = units.length(text, unit="mm")
    if value <= 0:
        raise BadInput(f"{shown(text)} is no length to round to; give one above zero, such as 0.1 mm")
    return value


def timing(text: str) -> float | str:
    """Read an angle, or `column`."""
    return "column" if text.strip() == "column" else units.angle(text)


# argparse as this command needs it: one line for a usage error, `-30 deg` taken as a value.

_NEGATIVE = re.compile(r"-\.?\d")
_NEGATIVE_LIST = re.compile(r"-\.?\d[^,]*,")


class Parser(argparse.ArgumentParser):
    """A parser that raises `BadInput` for a usage error and whose help ends in its examples."""

    def __init__(
        self, *, examples: Sequence[str] = (), before: Callable[[], str] | None = None, **options: object
    ) -> None:
        super().__init__(
            formatter_class=self._formatter,
            allow_abbrev=False,
            **options,  # type: ignore[arg-type]
        )
        self._examples = examples
        self._before = before

    _width: int | None = 80
    """In columns; None for the terminal's."""

    def _formatter(self, prog: str) -> argparse.HelpFormatter:
        # argparse makes one for each argument, to check it; asking for the terminal's width would take longer
        return argparse.RawDescriptionHelpFormatter(prog, width=self._width)

    def error(self, message: str) -> NoReturn:
        """Raise the usage error as one sentence that names the help to read."""
        told = f"{message[:-1]}; " if message.endswith(")") else f"{message} ("
        raise BadInput(f"{told}see `{self.prog} --help`)")

    def parse_known_args(self, args: Any = None, namespace: Any = None) -> Any:
        """Refuse what a command does not know with that command's own help, and its nearest option."""
        known, unknown = super().parse_known_args(args, namespace)
        if unknown and self._subparsers is None:
            word, *_ = unknown[0].split("=")
            if not word.startswith("-"):
                self.error(f"{shown(unknown[0])} is one argument too many")
            options = [option for action in self._actions for option in action.option_strings]
            self.error(f"there is no option {shown(word)}{meant(word, options)}")
        return known, unknown

    def _get_value(self, action: argparse.Action, arg_string: str) -> Any:
        # argparse does not know `BadInput`, and would let it pass without the option's name
        try:
            return super()._get_value(action, arg_string)
        except BadInput as error:
            raise argparse.ArgumentError(action, str(error)) from error

    def _check_value(self, action: argparse.Action, value: Any) -> None:
        # argparse would repeat the whole value, however long it is
        if action.choices is not None and value not in action.choices:
            choices = ", ".join(map(shown, action.choices))
            raise argparse.ArgumentError(action, f"{shown(value)} is not one of its choices: {choices}")

    def format_help(self) -> str:
        """Return argparse's help, what `before` adds, and the examples as its last lines."""
        self._width = None
        added = f"\n{self._before()}" if self._before else ""
        examples = "".join(f"  {line}\n" for line in self._examples)
        return f"{super().format_help()}{added}\nexamples:\n{examples}"

    def _print_message(self, message: str, file: Any = None) -> None:
        # argparse's own swallows the error of a full disk or of a reader that left
        print(message, end="", file=file)


def join_negative(words: Sequence[str]) -> list[str]:
    """Write `--angle -30deg` as `--angle=-30deg`, or argparse would take -30deg for an option.

    `-3,4` gets a blank in front, which serves an option that takes several values, too.
    """
    joined: list[str] = []
    for word in words:
        if _NEGATIVE_LIST.match(word):
            joined.append(f" {word}")
        elif joined and joined[-1].startswith("--") and "=" not in joined[-1] and _NEGATIVE.match(word):
            joined[-1] += f"={word}"
        else:
            joined.append(word)
    return joined


# Which arguments each command takes, in the order of its help; those that several take are written once.

EVERY_ANGLE = object()
"""What `--phase` without a value stands for: each angle of the sweep."""

Argument = Callable[[_ActionsContainer], object]
"""A function that adds an argument, or several, to a parser."""


def argument(*names: str, **how: Any) -> Argument:
    """Return an argument as `add_argument` takes it."""
    return lambda parser: parser.add_argument(*names, **how)


def valued(
    words: str, read: Callable[[str], object], text: str, usual: object = None, **how: Any
) -> Argument:
    """Return an argument with a value: its names, what help calls the value, how it is read, its default."""
    *names, metavar = words.split()
    kind = read if read in (str, Path) else bounded(read)
    return argument(*names, metavar=metavar, type=kind, help=text, default=usual, **how)


def flag(name: str, text: str) -> Argument:
    """Return an argument that is given or not."""
    return argument(name, action="store_true", help=text)


def either(*arguments: Argument) -> Argument:
    """Return arguments of which one at the most is given."""

    def add(parser: _ActionsContainer) -> None:
        group = parser.add_mutually_exclusive_group()
        for argument in arguments:
            argument(group)

    return add


def scene_named(more: str = "", **how: Any) -> Argument:
    """Return the argument that names a scene, or `more`."""
    words = f"a built-in scene's name (see `linkanim scenes`), or the path of a scene file{more}"
    return argument("scene", help=words, **{"metavar": "SCENE", **how})


def output(text: str) -> Argument:
    """Return the option that says where to write."""
    return valued("-o --output OUT", Path, text)


SCENE = scene_named()
_KIND_SOUGHT = argument(
    "--kind",
    choices=("four-bar", "slider-crank"),
    default="four-bar",
    help="the kind of linkage (default: four-bar)",
)
LANG = valued(
    "--lang LANG",
    language,
    f"the language of its words: {', '.join(LANGUAGES)} (default: the environment's, by LANGUAGE or LANG)",
)
ANGLE = valued("--angle ANGLE", units.angle, 'the crank angle, such as "87 deg"')
ACCELERATION = valued(
    "--acceleration ACC",
    units.ANGULAR_ACCELERATION.read,
    'the input\'s acceleration, such as "2 rad/s^2" (default: 0)',
    0.0,
)
STATIC = flag("--static", "forces as at rest: masses have weight, but no inertia")
SPEED = valued(
    "--speed SPEED", units.angular_speed, "the input's speed, such as \"30 rpm\" (default: the scene's)"
)


_DRIVER = (
    flag("--driver", "give each answer whose input swings a crank on a motor that turns fully, and a rod"),
    valued("--motor X,Y", pair, "where the driver's motor stands; has --driver as well"),
)

_MIRROR = valued(
    "--mirror LINE",
    str,
    'add the mirror image in a line, such as "x=40", geared to the crank: a pair of fingers',
)


def _limits(sizes: str, room: str) -> tuple[Argument, ...]:
    """Return the limits of what is synthesised."""
    return (
        valued("--box X,Y,W,H", box, room, nargs="+"),
        valued("--largest F", positive, f"the longest link allowed, in {sizes} (default: 8)", 8.0),
        valued("--least-angle ANGLE", units.angle, "the least transmission angle allowed", 0.0),
    )


ARGUMENTS: Mapping[str, tuple[Argument, ...]] = {
    "solve": (
        SCENE,
        ANGLE,
        valued(
            "--phase PHASE",
            units.angle,
            "a phase instead of the crank angle, also through limits; 360 deg is one period of the drive "
            "(without a value, --sweep is over the phase)",
            nargs="?",
            const=EVERY_ANGLE,
        ),
        valued("--travel LENGTH", str, 'how far a slider that drives has travelled, such as "28 cm"'),
        valued("--coordinate VALUE", str, "where the input is: the angle of a crank, the travel of a slider"),
        valued("--sweep A:B:STEP", sweep, "a row for each angle from A to B, in degrees"),
        valued(
            "--speed SPEED",
            either_speed,
            'the input\'s speed, such as "30 rpm", at a travel "10 cm/s" (default: the scene\'s)',
        ),
        ACCELERATION,
        STATIC,
        either(
            flag("--json", "print one object, or a list of them for a sweep"),
            valued("--csv OUT", str, "write the sweep to the file OUT (- for stdout)"),
        ),
        argument(
            "--unit",
            choices=units.LENGTH_UNITS,
            help="the unit of lengths, and so of velocities (default: the file's)",
        ),
    ),
    "info": (
        SCENE,
        valued(
            "--fluctuation F",
            positive,
            "how much the speed may change, as a share of its mean, with the flywheel (default: 0.02)",
            0.02,
        ),
        valued(
            "--tolerance LENGTH",
            str,
            'say how far points, output and stroke may be off when each length is, as "0.1 mm"',
        ),
        valued(
            "--chart OFF", Path, "draw how far, over a period, as SVG, PNG, PDF or CSV (with --tolerance)"
        ),
        valued(
            "--balance OUT",
            Path,
            "draw what inertia does to the ground, without and with counterweights (SVG, PNG, PDF, CSV)",
        ),
        flag("--json", "print one object; angles in radians, times in seconds"),
    ),
    "check": (
        argument("files", nargs="*", metavar="FILE", help="the scene files to check"),
        flag("--json", "print a list with an object for each file"),
        flag("--schema", "print the JSON Schema of scene files"),
    ),
    "closures": (
        SCENE,
        output("write OUT.gif, in which all run, OUT.png, or a scene file for each, OUT.toml"),
        flag("--json", "print a list with an object for each closure; angles in radians"),
        LANG,
    ),
    "convert": (
        valued(
            "file FILE",
            str,
            "a scene, a link to PMKS(+), a file of PMKS, pyslvs, MotionGen, Linkage or LInK, or a table",
        ),
        valued("-o --output OUT.toml", Path, "the scene file to write", required=True),
    ),
    "scenes": (
        valued(
            "word WORD",
            str,
            "only scenes whose title, class or chapter has this word (default: all)",
            nargs="?",
        ),
    ),
    "quiz": (
        scene_named("; or a chapter, as sliders; or all", metavar="SCENE|CHAPTER"),
        output("write SHEET.html (default: text on stdout)"),
        valued("--moodle OUT.xml", Path, "for Moodle: a category for each chapter, figures and all"),
        valued("--qti OUT.zip", Path, "for Canvas and other learning platforms: a package of QTI 1.2"),
        valued("-n N", whole, "the number of questions (default: 10)", 10, dest="count"),
        valued("--seed N", whole, "a seed always gives the same questions (default: 0)", 0),
        flag("--json", "print a list of objects"),
        LANG,
    ),
    "path": (
        valued(
            "curve CURVE", Path, "a table of x and y (and of the crank's angles in a third column), or an SVG"
        ),
        output(
            "write the best to NAME.toml, the others to NAME-2.toml, ... (default: CURVE.toml in this folder)"
        ),
        _KIND_SOUGHT,
        valued(
            "--timing STEP",
            timing,
            'how far the crank turns from point to point, such as "20 deg", or `column`',
        ),
        valued(
            "--pivots X,Y", pair, "the crank's fixed pin, or both fixed pins, that are given", (), nargs="+"
        ),
        valued("--count N", count, "the number of answers (default: 5)", 5),
        *_limits(
            "sizes of the curve",
            "the rectangle in which all fixed pins lie, or two of them, the crank's pin in the first",
        ),
        argument(
            "--prefer",
            choices=("balanced", "exact", "compact", "angle"),
            default="balanced",
            help="which answers come first: the one to build (default), the most exact, compact, or easily "
            "driven ones",
        ),
        valued("--front FILE.csv", Path, "write the front of deviation, size and transmission angle"),
        valued("--round LENGTH", step, 'round all lengths to multiples of this, such as "0.1 mm"'),
        flag("--open", "the curve does not close"),
        *_DRIVER,
        _MIRROR,
        flag("--cognates", "add the two Roberts cognates of each four-bar"),
        flag("--json", "print a list of objects; angles in radians"),
    ),
    "guide": (
        valued("poses POSES", Path, "a table of 2 to 5 poses: x, y and the angle in degrees"),
        valued(
            "-o --output NAME.toml",
            Path,
            "write the best to NAME.toml, the others to NAME-2.toml, ... (default: POSES.toml)",
        ),
        _KIND_SOUGHT,
        valued("--pivots X,Y", pair, "one or two fixed pins that are given", (), nargs="+"),
        *_limits(
            "sizes of the poses",
            "the rectangle in which the fixed pins lie that are not given, or two of them, one for each",
        ),
        argument(
            "--prefer", choices=("compact", "angle"), help="prefer small links, or a large transmission angle"
        ),
        *_DRIVER,
        _MIRROR,
        valued("--count N", count, "the number of answers (default: 6)", 6),
        flag("--json", "print a list of objects; angles in radians"),
    ),
    "function": (
        argument(
            "given", metavar="FUNCTION", help='an expression, such as "y = log10(x)", or a table of x and y'
        ),
        flag(
            "--pairs",
            'FUNCTION is 3 to 5 pairs of angles of crank and rocker in degrees, as "40:70, 45:76, 50:83", '
            "or a table of them (of a slider the places in mm)",
        ),
        valued("--from A", number, "the first x", dest="first"),
        valued("--to B", number, "the last x", dest="last"),
        argument(
            *("-o", "--file"),
            dest="output_file",
            metavar="NAME.toml",
            type=Path,
            help="write the best to NAME.toml, the others to NAME-2.toml, ... (default: function.toml)",
        ),
        _KIND_SOUGHT,
        valued(
            "--input ANGLE",
            str,
            'the range of the crank, such as "60 deg", or its two ends, "30 deg:90 deg" (default: any)',
        ),
        valued(
            "--output RANGE",
            str,
            'the range of the rocker, or of the slider, "80 mm" (default: any, or 100 mm)',
        ),
        argument(
            "--prefer",
            choices=("balanced", "exact"),
            default="balanced",
            help="which answer comes first: the one to build (default), or the most exact",
        ),
        valued("--points N", count, "the number of precision points, 3 to 5 (default: as many as possible)"),
        flag("--chebyshev", "keep Chebyshev's spacing of the precision points"),
        *_DRIVER,
        valued("--count N", count, "the number of answers (default: 3)", 3),
        valued("--chart ERROR", Path, "draw the structural error of the best answer as SVG, PNG, PDF or CSV"),
        flag("--json", "print a list of objects; angles in radians"),
    ),
    "quick-return": (
        valued(
            "--ratio Q", positive, "the time ratio: the slow way's time over the quick way's", required=True
        ),
        valued("--stroke L", length, "the stroke of the slider in mm; for a rocker, the chord of its pin"),
        valued("--swing ANGLE", units.angle, 'the swing of the rocker, such as "60 deg"'),
        argument(
            "--kind",
            choices=("slider-crank", "crank-rocker", "six-bar"),
            help="the kind of linkage (default: as --stroke or --swing asks for); a six-bar has a stroke of "
            "many cranks",
        ),
        valued("--crank L", length, "the crank of a six-bar in mm (default: a fifth of the stroke)"),
        valued("--place S", number, "take one member of the family, from 0 to 1, instead of the best"),
        valued(
            "--count N", count, "the number of answers: the best, and others of its family (default: 5)", 5
        ),
        output("write the best to NAME.toml, the others to NAME-2.toml, ... (default: quick-return.toml)"),
        flag("--json", "print a list of objects; angles in radians"),
    ),
    "dwell": (
        valued(
            "--rest ANGLE",
            units.angle,
            'how far the crank turns while the output rests, such as "120 deg"',
            required=True,
        ),
        valued("--swing ANGLE", units.angle, 'the whole swing of a rocker, such as "30 deg"'),
        valued("--stroke L", length, "the whole stroke of a slider in mm, in place of a swing"),
        valued(
            "--least-angle ANGLE",
            units.angle,
            "the least transmission angle allowed (default: 30 deg)",
            math.radians(30),
        ),
        valued("--count N", count, "the number of answers (default: 5)", 5),
        output("write the best to NAME.toml, the others to NAME-2.toml, ... (default: dwell.toml)"),
        flag("--json", "print a list of objects; angles in radians"),
    ),
    "gallery": (
        valued("--into FOLDER", Path, "the folder to write to (default: recordings)", Path("recordings")),
        LANG,
    ),
    "bench": (
        either(
            flag("--json", "print one object with every case of every method"),
            flag("--markdown", "print the table as it is in the manual"),
        ),
        argument(
            "--again",
            nargs="+",
            metavar="NAME",
            help="print an error once more: its case, and its inputs as hexadecimal floats",
        ),
        valued(
            "--into FOLDER", Path, "where speed-vs-error.png goes (default: recordings)", Path("recordings")
        ),
    ),
    "manual": (
        argument(
            "word",
            nargs="*",
            metavar="WORD",
            help="the name of a chapter, or what to look for (default: open the whole manual)",
        ),
        output("write the page to OUT.html, and do not open it"),
    ),
    "examples": (
        argument(
            "names", nargs="*", metavar="NAME", help="a number, a file's name, or `all` (default: list them)"
        ),
        valued("-o --output DIR", Path, "the folder to copy to (default: the current one)"),
    ),
    "completion": (
        argument("shell", choices=("bash", "zsh", "fish"), help="the shell that reads the script"),
    ),
}
"""The arguments of the commands that show no picture."""


def inputs_of(options: Namespace) -> list[str | Path]:
    """Return what a command reads: its scene, by name or path, and the path of a table."""
    return [path for name in ("scene", "data") if (path := getattr(options, name, None)) is not None]
