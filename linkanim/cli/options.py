"""Say which arguments each command takes, in the order of its help, and what their texts mean.

Arguments that several commands take are written once. Each reader of a text raises `BadInput` in one
sentence. The parser is argparse with one line for a usage error and `-30 deg` taken as a value.
"""

from __future__ import annotations

import argparse
import math
import re
from argparse import Action, BooleanOptionalAction, Namespace, _ActionsContainer
from collections.abc import Callable, Mapping, Sequence
from decimal import Decimal, InvalidOperation
from pathlib import Path
from typing import Any, NoReturn, TypeVar, cast, get_args

from linkanim import units
from linkanim.bounds import LARGEST_SIDE, MOST_LISTED, MOST_POSES, NUMBERS, can_be_computed
from linkanim.errors import BadInput
from linkanim.frozen import frozen
from linkanim.intake import meant
from linkanim.picture.look import TOGGLES, ConstructionKind, Look, Option, Toggle
from linkanim.picture.purpose import PURPOSES
from linkanim.units import shown
from linkanim.words import LANGUAGES, language_named
from linkanim.workshop.media import PAGES, WAYS

# What the options' texts mean: sizes, counts, sweeps; each raises `BadInput` in one sentence.

MOST_ROWS = 1_000_000
_MOST_DIGITS = 15


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


def size(text: str) -> tuple[int, int]:
    """Read `1280x720`: whole numbers of pixels, width first."""
    match = re.fullmatch(r"\s*(\d{1,6})\s*[x×X]\s*(\d{1,6})\s*", text)
    if not match or "0" in (match[1].lstrip("0") or "0", match[2].lstrip("0") or "0"):
        raise BadInput(f"{shown(text)} is not a size; write width x height in pixels, such as 1280x720")
    width, height = int(match[1]), int(match[2])
    if max(width, height) > LARGEST_SIDE:
        raise BadInput(f"{shown(text)} is too large; a side has {LARGEST_SIDE:,} pixels at the most")
    return width, height


def megabytes(text: str) -> int:
    """Read `1.5MB` or `800 kB`: a number of bytes."""
    match = re.fullmatch(r"\s*(\d+(?:\.\d+)?)\s*([kKmM])[bB]\s*", text)
    if not match or not (count := round(float(match[1]) * {"k": 1e3, "m": 1e6}[match[2].lower()])):
        raise BadInput(f"{shown(text)} is not the size of a file; write it as 1MB or 800kB")
    return count


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


def asked_construction(text: str) -> tuple[ConstructionKind | None, int | None]:
    """Read a kind of construction, a number of steps, or both: `centres:3`.

    No kind is the usual one, no number all steps.
    """
    kind, _, steps = text.partition(":")
    if kind in get_args(ConstructionKind):
        return cast(ConstructionKind, kind), count(steps) if steps else None
    if re.fullmatch(r"\d+", text):
        return None, count(text)
    raise BadInput(
        f"{shown(text)} is no construction; give synthesis, centres or dead-centres, a number of steps, or "
        "both: centres:3"
    )


def whole(text: str) -> int:
    """Read a whole number of at most 18 digits."""
    if not re.fullmatch(r"[+-]?[0-9]{1,18}", text):
        raise BadInput(f"{shown(text)} is not a whole number of at most 18 digits")
    return int(text)


def digits(text: str) -> int:
    """Read how many significant digits a number is written with."""
    number = count(text)
    if number > _MOST_DIGITS:
        raise BadInput(f"{shown(text)} digits are too many; a number has {_MOST_DIGITS} at the most")
    return number


def speeds(text: str) -> dict[str, float]:
    """Read angular speeds with commas between, in rad/s by the words for each; zero is refused."""
    given = _several(text, units.angular_speed)
    if not given or not all(given.values()):
        raise BadInput(f'{shown(text)}: give speeds other than zero, such as "5 rad/s,10 rad/s"')
    return given


def either_speed(text: str) -> Any:
    """Read a speed: an angular one in rad/s, or a length in a time."""
    if not units.names_unit(text, units.TRAVEL_SPEED):
        return units.angular_speed(text)
    from linkanim.scenes.form import TravelSpeed  # so that no other command loads it

    return TravelSpeed(units.TRAVEL_SPEED.read(text))


def angles(text: str) -> tuple[float, ...]:
    """Read angles with commas between, in radians."""
    given = _several(text, units.angle)
    if not given:
        raise BadInput(f'{shown(text)}: give angles with their unit, such as "87 deg,306 deg"')
    return tuple(given.values())


def _several(text: str, read: Callable[[str], float]) -> dict[str, float]:
    parts = [" ".join(part.split()) for part in text.split(",") if part.strip()]
    if len(parts) > MOST_LISTED:
        raise BadInput(f"{len(parts)} values are too many; a list has {MOST_LISTED} at the most")
    return {part: read(part) for part in parts}


def poses(text: str) -> int:
    """Read how many faint poses a figure has behind the one that it shows."""
    number = count(text)
    if number > MOST_POSES:
        raise BadInput(
            f"{shown(text)} is too many; a figure has {MOST_POSES} poses behind its own at the most"
        )
    return number


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


def millimetres(text: str) -> float:
    """Read a length, `12` or `1.2 cm`, in mm."""
    return units.length(text, unit="mm")


def sheet(text: str) -> str | tuple[float, float]:
    """Read the size of a sheet in mm, `600x400`, or the name of a page."""
    if text in PAGES:
        return text
    match = re.fullmatch(r"\s*([\d.]+)\s*[x×X]\s*([\d.]+)\s*(?:mm)?\s*", text)
    if not match:
        pages = ", ".join(PAGES)
        raise BadInput(f"{shown(text)} is no sheet: take {pages}, or a size in mm such as 600x400")
    return positive(match[1]), positive(match[2])


def timing(text: str) -> float | str:
    """Read an angle, or `column`."""
    return "column" if text.strip() == "column" else units.angle(text)


def vectors(text: str) -> frozenset[str]:
    """Read a list such as `v,a`: which of velocity, acceleration and force are drawn."""
    chosen = frozenset(part.strip() for part in text.split(","))
    if not chosen <= set(TOGGLES["vectors"].steps):
        way_out = "take v (velocity), a (acceleration), f (force), or several, as v,a"
        raise BadInput(f"{shown(text)} is not a list of vectors; {way_out}")
    return chosen


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


@frozen
class Preset:
    """What `record --for` stands for: size in pixels, frames a second, the suffix of the format."""

    size: tuple[int, int]
    fps: float
    suffix: str
    projected: bool = False
    """Whether it is shown on a slide, whose letters are read from the last row."""


DEFAULT = Preset((1280, 720), 25.0, ".gif")

PRESETS = {
    "slides": Preset((1280, 720), 25.0, ".gif", projected=True),
    "beamer": Preset((1280, 720), 25.0, ".png", projected=True),
    "web": Preset((640, 360), 20.0, ".gif"),
}


class Further(Action):
    """An option that moves a field of the look on, to its own step or by one step; never back."""

    def __call__(
        self, _parser: object, options: Namespace, _values: object, _word: str | None = None
    ) -> None:
        """Put the new step into the options."""
        steps = TOGGLES[self.dest].steps
        at = steps.index(getattr(options, self.dest))
        to = at + 1 if self.const is None else steps.index(self.const)
        setattr(options, self.dest, steps[max(at, min(to, len(steps) - 1))])


def _argument(*names: str, **how: Any) -> Argument:
    """Return an argument as `add_argument` takes it."""
    return lambda parser: parser.add_argument(*names, **how)


def _value(
    words: str, read: Callable[[str], object], text: str, usual: object = None, **how: Any
) -> Argument:
    """Return an argument with a value: its names, what help calls the value, how it is read, its default."""
    *names, metavar = words.split()
    kind = read if read in (str, Path) else bounded(read)
    return _argument(*names, metavar=metavar, type=kind, help=text, default=usual, **how)


def _flag(name: str, text: str) -> Argument:
    return _argument(name, action="store_true", help=text)


def _either(*arguments: Argument) -> Argument:
    """Return arguments of which one at the most is given."""

    def add(parser: _ActionsContainer) -> None:
        group = parser.add_mutually_exclusive_group()
        for argument in arguments:
            argument(group)

    return add


def _usually(**given: object) -> Argument:
    """Return the defaults of a command's options, where they are not those of other commands."""
    return lambda parser: parser.set_defaults(**given)


def _scene(more: str = "", **how: Any) -> Argument:
    words = f"a built-in scene's name (see `linkanim scenes`), or the path of a scene file{more}"
    return _argument("scene", help=words, **{"metavar": "SCENE", **how})


def _output(text: str) -> Argument:
    return _value("-o --output OUT", Path, text)


def _speeds(what: str) -> Argument:
    words = f'{what}, such as "5 rad/s,10 rad/s" (default: the scene\'s)'
    return _value("--speeds SPEED[,SPEED...]", speeds, words)


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
            return {"type": vectors, "metavar": option.metavar}
    return {"choices": toggle.steps} if toggle.steps else {"metavar": option.metavar}


_SCENE = _scene()
_KIND_SOUGHT = _argument(
    "--kind",
    choices=("four-bar", "slider-crank"),
    default="four-bar",
    help="the kind of linkage (default: four-bar)",
)
_LANG = _value(
    "--lang LANG",
    language,
    f"the language of its words: {', '.join(LANGUAGES)} (default: the environment's, by LANGUAGE or LANG)",
)
_SIZE = _value("--size WxH", size, "width and height in pixels (default: 1280x720)")
_WINDOW_SIZE = _value("--size WxH", size, "the size of the window in pixels")
_PURPOSE = _argument(
    "--for",
    dest="purpose",
    choices=tuple(PURPOSES),
    help="take width, letters and ground for a "
    + ", ".join(f"{name} ({purpose.words})" for name, purpose in PURPOSES.items())
    + "; --size is then its shape",
)
_TEXT = _argument(
    "--text", choices=("latex",), help="leave the words of a PDF to LaTeX, in FIG.pdf_tex beside it"
)
_ANGLE = _value("--angle ANGLE", units.angle, 'the crank angle, such as "87 deg"')
_PHASE = _value(
    "--phase PHASE", units.angle, "a phase instead of an angle (default: the pose that reads best)"
)
_ACCELERATION = _value(
    "--acceleration ACC",
    units.ANGULAR_ACCELERATION.read,
    'the input\'s acceleration, such as "2 rad/s^2" (default: 0)',
    0.0,
)
_STATIC = _flag("--static", "forces as at rest: masses have weight, but no inertia")
_ALT = _value(
    "--alt OUT.txt", Path, "write what it shows in a paragraph, for the alternative text of a page or a slide"
)
_CONSTRUCTION = _value(
    "--construction KIND",
    asked_construction,
    "draw a construction in its steps: `synthesis` (of what `guide`, `function` or `quick-return` found), "
    "`centres` or `dead-centres`; `centres:3` are its first three steps",
    nargs="?",
    const=(None, None),
)
_SPEED = _value(
    "--speed SPEED", units.angular_speed, "the input's speed, such as \"30 rpm\" (default: the scene's)"
)


_DRIVER = (
    _flag("--driver", "give each answer whose input swings a crank on a motor that turns fully, and a rod"),
    _value("--motor X,Y", pair, "where the driver's motor stands; has --driver as well"),
)

_MIRROR = _value(
    "--mirror LINE",
    str,
    'add the mirror image in a line, such as "x=40", geared to the crank: a pair of fingers',
)


def _limits(sizes: str, room: str) -> tuple[Argument, ...]:
    """Return the limits of what is synthesised."""
    return (
        _value("--box X,Y,W,H", box, room, nargs="+"),
        _value("--largest F", positive, f"the longest link allowed, in {sizes} (default: 8)", 8.0),
        _value("--least-angle ANGLE", units.angle, "the least transmission angle allowed", 0.0),
    )


ARGUMENTS: Mapping[str, tuple[Argument, ...]] = {
    "play": (
        _scene(", of a tape or of a lesson", nargs="?"),
        _flag("--attract", "run for a stand: full screen, and back to the title when left alone"),
        _WINDOW_SIZE,
        _value(
            "--scores FILE.json", Path, "keep best scores in this file (default: in the user's data folder)"
        ),
        _value(
            "--counts OUT.csv",
            Path,
            "write how often each misconception gave an answer, without names, and open no window",
        ),
        _value(
            "--game WORDS",
            str,
            'begin with a game, such as "match level=mine.toml", "follow scene=press", "predict level=2"',
        ),
        _argument(
            "--reduced-motion",
            action=BooleanOptionalAction,
            default=None,
            help="change pictures at once, without fades and moving views (default: as the desktop asks)",
        ),
        _look("play"),
        _LANG,
    ),
    "new": (
        _value("--photo FILE", Path, "lay a photograph behind the sheet"),
        _WINDOW_SIZE,
        _argument("--theme", choices=("light", "dark"), default="light", help="the colours (default: light)"),
        _LANG,
    ),
    "record": (
        _scene(", of a tape or of a lesson"),
        _argument("more", nargs="*", metavar="SCENE", help="further scenes, each on a slide of OUT.pptx"),
        _output(
            "write OUT.gif, .mp4, .webm, .webp, .apng, .mov, numbered .png, .pptx (slides) or .pdf (a "
            "page for each frame); default: SCENE.gif in this folder"
        ),
        _argument(
            "--for", dest="preset", choices=tuple(PRESETS), help="take size, rate and format for a purpose"
        ),
        _SIZE,
        _value("--fps N", positive, "frames per second (default: 25)"),
        _SPEED,
        _either(
            _value("--periods N", count, "how many true periods to record (default: 1)"),
            _value("--seconds S", positive, "how long the clip is in seconds; it need not close"),
        ),
        _flag("--reverse", "run the motion backwards"),
        _value("--max-size SIZE", megabytes, "choose size and rate so that a file has at most SIZE, as 1MB"),
        _flag("--titles", "put the loops of slides under their titles"),
        _ALT,
        _look("record"),
        _CONSTRUCTION,
        _flag("--noted", "note nearby limits and change points"),
        _flag("--each", "record each step of a lesson into a file of its own, with its number"),
        _flag("--photo", "show the photograph of a tape on which something is built"),
        _flag("--no-clobber", "write over the file of -o only where linkanim wrote it and nobody changed it"),
        _flag("--progress", "show the progress even if stderr is not a terminal"),
        _LANG,
    ),
    "solve": (
        _SCENE,
        _ANGLE,
        _value(
            "--phase PHASE",
            units.angle,
            "a phase instead of the crank angle, also through limits; 360 deg is one period of the drive "
            "(without a value, --sweep is over the phase)",
            nargs="?",
            const=EVERY_ANGLE,
        ),
        _value("--travel LENGTH", str, 'how far a slider that drives has travelled, such as "28 cm"'),
        _value("--coordinate VALUE", str, "where the input is: the angle of a crank, the travel of a slider"),
        _value("--sweep A:B:STEP", sweep, "a row for each angle from A to B, in degrees"),
        _value(
            "--speed SPEED",
            either_speed,
            'the input\'s speed, such as "30 rpm", at a travel "10 cm/s" (default: the scene\'s)',
        ),
        _ACCELERATION,
        _STATIC,
        _either(
            _flag("--json", "print one object, or a list of them for a sweep"),
            _value("--csv OUT", str, "write the sweep to the file OUT (- for stdout)"),
        ),
        _look("solve"),
    ),
    "chart": (
        _SCENE,
        _value(
            "--quantity Q[,Q...]",
            str,
            "what to draw, such as rocker.angular_velocity or B.velocity.x; `list` lists them",
            required=True,
        ),
        _output("write OUT.png, OUT.svg, OUT.pdf or OUT.csv (default: SCENE.png in this folder)"),
        _PURPOSE,
        _ALT,
        _TEXT,
        _speeds("draw a curve for each speed"),
        _value(
            "--data OTHER.csv",
            Path,
            "lay a table over the first curve; its columns are what --over says, and the value",
        ),
        _value("--label TEXT", str, "the name of that table in the legend (default: its file's name)"),
        _STATIC,
        _flag("--polar", "draw a vector's head round a turn, as a bearing's force is drawn"),
        _SIZE,
        _look("chart"),
        _LANG,
    ),
    "report": (
        _SCENE,
        _value("-o --output DIR", Path, "the folder to write, or to write anew", required=True),
        _value(
            "--angles ANGLE[,ANGLE...]",
            angles,
            'where the tables are, such as "87 deg,306 deg" (default: the start and the extremes)',
        ),
        _speeds("the speeds of tables and charts"),
        _ACCELERATION,
        _value(
            "--data OTHER.csv",
            Path,
            "lay measured values beside the solution: angle or time, then a column for each quantity",
        ),
        _value("--label TEXT", str, "the name of that table (default: its file's name)"),
        _value("--digits N", digits, "significant digits in the tables (default: 4)", 4),
        _value(
            "--polygon-speed SPEED",
            speeds,
            "the speed of polygons, and of comparisons with measured values (default: each of --speeds)",
        ),
        _flag("--no-derivation", "leave the derivation out: positions and differentiated loops in symbols"),
        _flag("--all", "add every quantity, and a chart of each"),
        _look("report"),
        _LANG,
    ),
    "info": (
        _SCENE,
        _value(
            "--fluctuation F",
            positive,
            "how much the speed may change, as a share of its mean, with the flywheel (default: 0.02)",
            0.02,
        ),
        _value(
            "--tolerance LENGTH",
            str,
            'say how far points, output and stroke may be off when each length is, as "0.1 mm"',
        ),
        _value(
            "--chart OFF", Path, "draw how far, over a period, as SVG, PNG, PDF or CSV (with --tolerance)"
        ),
        _value(
            "--balance OUT",
            Path,
            "draw what inertia does to the ground, without and with counterweights (SVG, PNG, PDF, CSV)",
        ),
        _flag("--json", "print one object; angles in radians, times in seconds"),
    ),
    "check": (
        _argument("files", nargs="*", metavar="FILE", help="the scene files to check"),
        _flag("--json", "print a list with an object for each file"),
        _flag("--schema", "print the JSON Schema of scene files"),
    ),
    "closures": (
        _SCENE,
        _output("write OUT.gif, in which all run, OUT.png, or a scene file for each, OUT.toml"),
        _flag("--json", "print a list with an object for each closure; angles in radians"),
        _LANG,
    ),
    "convert": (
        _value(
            "file FILE",
            str,
            "a scene, a link to PMKS(+), a file of PMKS, pyslvs, MotionGen, Linkage or LInK, or a table",
        ),
        _value("-o --output OUT.toml", Path, "the scene file to write", required=True),
    ),
    "scenes": (
        _value(
            "word WORD",
            str,
            "only scenes whose title, class or chapter has this word (default: all)",
            nargs="?",
        ),
    ),
    "draw": (
        _SCENE,
        _output("write OUT.svg, OUT.png or OUT.pdf (default: SCENE.svg in this folder)"),
        _PURPOSE,
        _ALT,
        _TEXT,
        _either(_ANGLE, _PHASE),
        _SPEED,
        _SIZE,
        _look("draw"),
        _value("--poses N", poses, "draw N faint poses of the period behind it"),
        _CONSTRUCTION,
        _usually(hud=False, material="flat"),
        _LANG,
    ),
    "explain": (
        _SCENE,
        _output("write OUT.html, OUT.tex or OUT.md (default: Markdown on stdout)"),
        _either(_ANGLE, _PHASE),
        _SPEED,
        _ACCELERATION,
        _flag("--forces", "work out what each body carries, too: free bodies, their equations, the solution"),
        _value("--moments-about JOINT", str, "take moments about this joint on bodies that have it"),
        _STATIC,
        _flag("--exercise", "ask questions instead, with room to work, and put the key on pages of its own"),
        _argument(
            "--level",
            choices=("drawing", "hints", "formulas"),
            help="what an exercise gives: the drawing alone, hints, or the formulas (default: drawing)",
        ),
        _value(
            "--versions N",
            whole,
            "the number of sheets A, B, ... with other lengths; their keys are in one file",
        ),
        _value(
            "--seed N",
            whole,
            "take other round lengths with the same kind of motion; a seed always gives the same lengths",
        ),
        _look("explain"),
        _LANG,
    ),
    "quiz": (
        _scene("; or a chapter, as sliders; or all", metavar="SCENE|CHAPTER"),
        _output("write SHEET.html (default: text on stdout)"),
        _value("--moodle OUT.xml", Path, "for Moodle: a category for each chapter, figures and all"),
        _value("--qti OUT.zip", Path, "for Canvas and other learning platforms: a package of QTI 1.2"),
        _value("-n N", whole, "the number of questions (default: 10)", 10, dest="count"),
        _value("--seed N", whole, "a seed always gives the same questions (default: 0)", 0),
        _flag("--json", "print a list of objects"),
        _LANG,
    ),
    "share": (
        _scene(nargs="?"),
        _output("write LINKAGE.html (default: SCENE.html in this folder)"),
        _value("--all DIR", Path, "write every built-in scene, and an index of them, to this folder"),
        _SPEED,
        _STATIC,
        _look("share"),
        _usually(theme=None),
        _LANG,
    ),
    "path": (
        _value(
            "curve CURVE", Path, "a table of x and y (and of the crank's angles in a third column), or an SVG"
        ),
        _output(
            "write the best to NAME.toml, the others to NAME-2.toml, ... (default: CURVE.toml in this folder)"
        ),
        _KIND_SOUGHT,
        _value(
            "--timing STEP",
            timing,
            'how far the crank turns from point to point, such as "20 deg", or `column`',
        ),
        _value(
            "--pivots X,Y", pair, "the crank's fixed pin, or both fixed pins, that are given", (), nargs="+"
        ),
        _value("--count N", count, "the number of answers (default: 5)", 5),
        *_limits(
            "sizes of the curve",
            "the rectangle in which all fixed pins lie, or two of them, the crank's pin in the first",
        ),
        _argument(
            "--prefer",
            choices=("balanced", "exact", "compact", "angle"),
            default="balanced",
            help="which answers come first: the one to build (default), the most exact, compact, or easily "
            "driven ones",
        ),
        _value("--front FILE.csv", Path, "write the front of deviation, size and transmission angle"),
        _value("--round LENGTH", step, 'round all lengths to multiples of this, such as "0.1 mm"'),
        _flag("--open", "the curve does not close"),
        *_DRIVER,
        _MIRROR,
        _flag("--cognates", "add the two Roberts cognates of each four-bar"),
        _flag("--json", "print a list of objects; angles in radians"),
    ),
    "guide": (
        _value("poses POSES", Path, "a table of 2 to 5 poses: x, y and the angle in degrees"),
        _value(
            "-o --output NAME.toml",
            Path,
            "write the best to NAME.toml, the others to NAME-2.toml, ... (default: POSES.toml)",
        ),
        _KIND_SOUGHT,
        _value("--pivots X,Y", pair, "one or two fixed pins that are given", (), nargs="+"),
        *_limits(
            "sizes of the poses",
            "the rectangle in which the fixed pins lie that are not given, or two of them, one for each",
        ),
        _argument(
            "--prefer", choices=("compact", "angle"), help="prefer small links, or a large transmission angle"
        ),
        *_DRIVER,
        _MIRROR,
        _value("--count N", count, "the number of answers (default: 6)", 6),
        _flag("--json", "print a list of objects; angles in radians"),
    ),
    "function": (
        _argument(
            "given", metavar="FUNCTION", help='an expression, such as "y = log10(x)", or a table of x and y'
        ),
        _flag(
            "--pairs",
            'FUNCTION is 3 to 5 pairs of angles of crank and rocker in degrees, as "40:70, 45:76, 50:83", '
            "or a table of them (of a slider the places in mm)",
        ),
        _value("--from A", number, "the first x", dest="first"),
        _value("--to B", number, "the last x", dest="last"),
        _argument(
            *("-o", "--file"),
            dest="output_file",
            metavar="NAME.toml",
            type=Path,
            help="write the best to NAME.toml, the others to NAME-2.toml, ... (default: function.toml)",
        ),
        _KIND_SOUGHT,
        _value(
            "--input ANGLE",
            str,
            'the range of the crank, such as "60 deg", or its two ends, "30 deg:90 deg" (default: any)',
        ),
        _value(
            "--output RANGE",
            str,
            'the range of the rocker, or of the slider, "80 mm" (default: any, or 100 mm)',
        ),
        _argument(
            "--prefer",
            choices=("balanced", "exact"),
            default="balanced",
            help="which answer comes first: the one to build (default), or the most exact",
        ),
        _value("--points N", count, "the number of precision points, 3 to 5 (default: as many as possible)"),
        _flag("--chebyshev", "keep Chebyshev's spacing of the precision points"),
        *_DRIVER,
        _value("--count N", count, "the number of answers (default: 3)", 3),
        _value("--chart ERROR", Path, "draw the structural error of the best answer as SVG, PNG, PDF or CSV"),
        _flag("--json", "print a list of objects; angles in radians"),
    ),
    "quick-return": (
        _value(
            "--ratio Q", positive, "the time ratio: the slow way's time over the quick way's", required=True
        ),
        _value("--stroke L", length, "the stroke of the slider in mm; for a rocker, the chord of its pin"),
        _value("--swing ANGLE", units.angle, 'the swing of the rocker, such as "60 deg"'),
        _argument(
            "--kind",
            choices=("slider-crank", "crank-rocker", "six-bar"),
            help="the kind of linkage (default: as --stroke or --swing asks for); a six-bar has a stroke of "
            "many cranks",
        ),
        _value("--crank L", length, "the crank of a six-bar in mm (default: a fifth of the stroke)"),
        _value("--place S", number, "take one member of the family, from 0 to 1, instead of the best"),
        _value(
            "--count N", count, "the number of answers: the best, and others of its family (default: 5)", 5
        ),
        _output("write the best to NAME.toml, the others to NAME-2.toml, ... (default: quick-return.toml)"),
        _flag("--json", "print a list of objects; angles in radians"),
    ),
    "dwell": (
        _value(
            "--rest ANGLE",
            units.angle,
            'how far the crank turns while the output rests, such as "120 deg"',
            required=True,
        ),
        _value("--swing ANGLE", units.angle, 'the whole swing of a rocker, such as "30 deg"'),
        _value("--stroke L", length, "the whole stroke of a slider in mm, in place of a swing"),
        _value(
            "--least-angle ANGLE",
            units.angle,
            "the least transmission angle allowed (default: 30 deg)",
            math.radians(30),
        ),
        _value("--count N", count, "the number of answers (default: 5)", 5),
        _output("write the best to NAME.toml, the others to NAME-2.toml, ... (default: dwell.toml)"),
        _flag("--json", "print a list of objects; angles in radians"),
    ),
    "make": (
        _SCENE,
        _value("-o --output FOLDER", Path, "the folder to write, or to write anew"),
        _argument("--way", choices=WAYS, default=WAYS[0], help="how it is made (default: cardboard)"),
        _value("--bar W", millimetres, "the width of bars in mm (default: by the size of the scene)"),
        _value(
            "--hole D", millimetres, "the diameter of holes in mm (default: two fifths of a bar, at most 6)"
        ),
        _value(
            "--thickness T",
            millimetres,
            "the thickness of the material in mm (default: 1.5, 3 or 4, depending on --way)",
        ),
        _value(
            "--clearance C",
            millimetres,
            "how much wider a hole is than its pin, in mm (default: 0, 0.2 or 0.4)",
        ),
        _value(
            "--gap G",
            millimetres,
            "the least distance of parts that pass in a layer, in mm (default: 0.5)",
            0.5,
        ),
        _value("--kerf K", millimetres, "the width of the cut in mm (default: 0)", 0.0),
        _value("--sheet WxH", sheet, "the size of the material in mm, or of a page, A4 or Letter"),
        _value("--fit PAGE", str, "scale all parts to fit a page, A4 or Letter (default: true size)"),
        _argument(
            *("--preview",),
            metavar="PICTURE",
            type=Path,
            nargs="?",
            const=Path(),
            help="show the layers in the window, or draw them as a picture: .svg, .png or .pdf",
        ),
        _flag("--bridge", "let fixed pins hang from a plate above if they are in the way below"),
        _flag("--json", "print parts and pins as one object; lengths in mm"),
        _LANG,
    ),
    "gallery": (
        _value("--into FOLDER", Path, "the folder to write to (default: recordings)", Path("recordings")),
        _LANG,
    ),
    "bench": (
        _either(
            _flag("--json", "print one object with every case of every method"),
            _flag("--markdown", "print the table as it is in the manual"),
        ),
        _argument(
            "--again",
            nargs="+",
            metavar="NAME",
            help="print an error once more: its case, and its inputs as hexadecimal floats",
        ),
        _value(
            "--into FOLDER", Path, "where speed-vs-error.png goes (default: recordings)", Path("recordings")
        ),
    ),
    "manual": (
        _argument(
            "word",
            nargs="*",
            metavar="WORD",
            help="the name of a chapter, or what to look for (default: open the whole manual)",
        ),
        _output("write the page to OUT.html, and do not open it"),
    ),
    "examples": (
        _argument(
            "names", nargs="*", metavar="NAME", help="a number, a file's name, or `all` (default: list them)"
        ),
        _value("-o --output DIR", Path, "the folder to copy to (default: the current one)"),
    ),
    "completion": (
        _argument("shell", choices=("bash", "zsh", "fish"), help="the shell that reads the script"),
    ),
}
"""The arguments of each command."""


def inputs_of(options: Namespace) -> list[str | Path]:
    """Return what a command reads: its scene, by name or path, and the path of a table."""
    return [path for name in ("scene", "data") if (path := getattr(options, name, None)) is not None]
