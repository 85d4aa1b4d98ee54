"""Say which arguments the commands take that show pictures, record them or make parts, and what they mean.

The look's own table gives most of them; so a command that shows nothing loads no looks.
"""

from __future__ import annotations

import re
from argparse import Action, BooleanOptionalAction, Namespace, _ActionsContainer
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any, NamedTuple, cast, get_args

from linkanim import units
from linkanim.bounds import LARGEST_SIDE, MOST_LISTED, MOST_POSES
from linkanim.cli.options import (
    ACCELERATION,
    ANGLE,
    LANG,
    SCENE,
    SPEED,
    STATIC,
    Argument,
    argument,
    count,
    either,
    flag,
    output,
    positive,
    scene_named,
    valued,
    whole,
)
from linkanim.errors import BadInput
from linkanim.picture.look import TOGGLES, ConstructionKind, Look, Option, Toggle
from linkanim.picture.purpose import PURPOSES
from linkanim.units import shown
from linkanim.workshop.media import PAGES, WAYS

_MOST_DIGITS = 15


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


def sheet(text: str) -> str | tuple[float, float]:
    """Read the size of a sheet in mm, `600x400`, or the name of a page."""
    if text in PAGES:
        return text
    match = re.fullmatch(r"\s*([\d.]+)\s*[x×X]\s*([\d.]+)\s*(?:mm)?\s*", text)
    if not match:
        pages = ", ".join(PAGES)
        raise BadInput(f"{shown(text)} is no sheet: take {pages}, or a size in mm such as 600x400")
    return positive(match[1]), positive(match[2])


def vectors(text: str) -> frozenset[str]:
    """Read a list such as `v,a`: which of velocity, acceleration and force are drawn."""
    chosen = frozenset(part.strip() for part in text.split(","))
    if not chosen <= set(TOGGLES["vectors"].steps):
        way_out = "take v (velocity), a (acceleration), f (force), or several, as v,a"
        raise BadInput(f"{shown(text)} is not a list of vectors; {way_out}")
    return chosen


def millimetres(text: str) -> float:
    """Read a length, `12` or `1.2 cm`, in mm."""
    return units.length(text, unit="mm")


class Preset(NamedTuple):
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


def _speeds(what: str) -> Argument:
    words = f'{what}, such as "5 rad/s,10 rad/s" (default: the scene\'s)'
    return valued("--speeds SPEED[,SPEED...]", speeds, words)


def _usually(**given: object) -> Argument:
    """Return the defaults of a command's options, where they are not those of other commands."""
    return lambda parser: parser.set_defaults(**given)


SIZE = valued("--size WxH", size, "width and height in pixels (default: 1280x720)")
_WINDOW_SIZE = valued("--size WxH", size, "the size of the window in pixels")
_PURPOSE = argument(
    "--for",
    dest="purpose",
    choices=tuple(PURPOSES),
    help="take width, letters and ground for a "
    + ", ".join(f"{name} ({purpose.words})" for name, purpose in PURPOSES.items())
    + "; --size is then its shape",
)
_TEXT = argument(
    "--text", choices=("latex",), help="leave the words of a PDF to LaTeX, in FIG.pdf_tex beside it"
)
PHASE = valued(
    "--phase PHASE", units.angle, "a phase instead of an angle (default: the pose that reads best)"
)
_ALT = valued(
    "--alt OUT.txt", Path, "write what it shows in a paragraph, for the alternative text of a page or a slide"
)
_CONSTRUCTION = valued(
    "--construction KIND",
    asked_construction,
    "draw a construction in its steps: `synthesis` (of what `guide`, `function` or `quick-return` found), "
    "`centres` or `dead-centres`; `centres:3` are its first three steps",
    nargs="?",
    const=(None, None),
)

ARGUMENTS: Mapping[str, tuple[Argument, ...]] = {
    "play": (
        scene_named(", of a tape or of a lesson", nargs="?"),
        flag("--attract", "run for a stand: full screen, and back to the title when left alone"),
        _WINDOW_SIZE,
        valued(
            "--scores FILE.json", Path, "keep best scores in this file (default: in the user's data folder)"
        ),
        valued(
            "--counts OUT.csv",
            Path,
            "write how often each misconception gave an answer, without names, and open no window",
        ),
        valued(
            "--game WORDS",
            str,
            'begin with a game, such as "match level=mine.toml", "follow scene=press", "predict level=2"',
        ),
        argument(
            "--reduced-motion",
            action=BooleanOptionalAction,
            default=None,
            help="change pictures at once, without fades and moving views (default: as the desktop asks)",
        ),
        _look("play"),
        LANG,
    ),
    "new": (
        valued("--photo FILE", Path, "lay a photograph behind the sheet"),
        _WINDOW_SIZE,
        argument("--theme", choices=("light", "dark"), default="light", help="the colours (default: light)"),
        LANG,
    ),
    "record": (
        scene_named(", of a tape or of a lesson"),
        argument("more", nargs="*", metavar="SCENE", help="further scenes, each on a slide of OUT.pptx"),
        output(
            "write OUT.gif, .mp4, .webm, .webp, .apng, .mov, numbered .png, .pptx (slides) or .pdf (a "
            "page for each frame); default: SCENE.gif in this folder"
        ),
        argument(
            "--for", dest="preset", choices=tuple(PRESETS), help="take size, rate and format for a purpose"
        ),
        SIZE,
        valued("--fps N", positive, "frames per second (default: 25)"),
        SPEED,
        either(
            valued("--periods N", count, "how many true periods to record (default: 1)"),
            valued("--seconds S", positive, "how long the clip is in seconds; it need not close"),
        ),
        flag("--reverse", "run the motion backwards"),
        valued("--max-size SIZE", megabytes, "choose size and rate so that a file has at most SIZE, as 1MB"),
        flag("--titles", "put the loops of slides under their titles"),
        _ALT,
        _look("record"),
        _CONSTRUCTION,
        flag("--noted", "note nearby limits and change points"),
        flag("--each", "record each step of a lesson into a file of its own, with its number"),
        flag("--photo", "show the photograph of a tape on which something is built"),
        flag("--no-clobber", "write over the file of -o only where linkanim wrote it and nobody changed it"),
        flag("--progress", "show the progress even if stderr is not a terminal"),
        LANG,
    ),
    "chart": (
        SCENE,
        valued(
            "--quantity Q[,Q...]",
            str,
            "what to draw, such as rocker.angular_velocity or B.velocity.x; `list` lists them",
            required=True,
        ),
        output("write OUT.png, OUT.svg, OUT.pdf or OUT.csv (default: SCENE.png in this folder)"),
        _PURPOSE,
        _ALT,
        _TEXT,
        _speeds("draw a curve for each speed"),
        valued(
            "--data OTHER.csv",
            Path,
            "lay a table over the first curve; its columns are what --over says, and the value",
        ),
        valued("--label TEXT", str, "the name of that table in the legend (default: its file's name)"),
        STATIC,
        flag("--polar", "draw a vector's head round a turn, as a bearing's force is drawn"),
        SIZE,
        _look("chart"),
        LANG,
    ),
    "report": (
        SCENE,
        valued("-o --output DIR", Path, "the folder to write, or to write anew", required=True),
        valued(
            "--angles ANGLE[,ANGLE...]",
            angles,
            'where the tables are, such as "87 deg,306 deg" (default: the start and the extremes)',
        ),
        _speeds("the speeds of tables and charts"),
        ACCELERATION,
        valued(
            "--data OTHER.csv",
            Path,
            "lay measured values beside the solution: angle or time, then a column for each quantity",
        ),
        valued("--label TEXT", str, "the name of that table (default: its file's name)"),
        valued("--digits N", digits, "significant digits in the tables (default: 4)", 4),
        valued(
            "--polygon-speed SPEED",
            speeds,
            "the speed of polygons, and of comparisons with measured values (default: each of --speeds)",
        ),
        flag("--no-derivation", "leave the derivation out: positions and differentiated loops in symbols"),
        flag("--all", "add every quantity, and a chart of each"),
        _look("report"),
        LANG,
    ),
    "draw": (
        SCENE,
        output("write OUT.svg, OUT.png or OUT.pdf (default: SCENE.svg in this folder)"),
        _PURPOSE,
        _ALT,
        _TEXT,
        either(ANGLE, PHASE),
        SPEED,
        SIZE,
        _look("draw"),
        valued("--poses N", poses, "draw N faint poses of the period behind it"),
        _CONSTRUCTION,
        _usually(hud=False, material="flat"),
        LANG,
    ),
    "explain": (
        SCENE,
        output("write OUT.html, OUT.tex or OUT.md (default: Markdown on stdout)"),
        either(ANGLE, PHASE),
        SPEED,
        ACCELERATION,
        flag("--forces", "work out what each body carries, too: free bodies, their equations, the solution"),
        valued("--moments-about JOINT", str, "take moments about this joint on bodies that have it"),
        STATIC,
        flag("--exercise", "ask questions instead, with room to work, and put the key on pages of its own"),
        argument(
            "--level",
            choices=("drawing", "hints", "formulas"),
            help="what an exercise gives: the drawing alone, hints, or the formulas (default: drawing)",
        ),
        valued(
            "--versions N",
            whole,
            "the number of sheets A, B, ... with other lengths; their keys are in one file",
        ),
        valued(
            "--seed N",
            whole,
            "take other round lengths with the same kind of motion; a seed always gives the same lengths",
        ),
        _look("explain"),
        LANG,
    ),
    "share": (
        scene_named(nargs="?"),
        output("write LINKAGE.html (default: SCENE.html in this folder)"),
        valued("--all DIR", Path, "write every built-in scene, and an index of them, to this folder"),
        SPEED,
        STATIC,
        _look("share"),
        _usually(theme=None),
        LANG,
    ),
    "make": (
        SCENE,
        valued("-o --output FOLDER", Path, "the folder to write, or to write anew"),
        argument("--way", choices=WAYS, default=WAYS[0], help="how it is made (default: cardboard)"),
        valued("--bar W", millimetres, "the width of bars in mm (default: by the size of the scene)"),
        valued(
            "--hole D", millimetres, "the diameter of holes in mm (default: two fifths of a bar, at most 6)"
        ),
        valued(
            "--thickness T",
            millimetres,
            "the thickness of the material in mm (default: 1.5, 3 or 4, depending on --way)",
        ),
        valued(
            "--clearance C",
            millimetres,
            "how much wider a hole is than its pin, in mm (default: 0, 0.2 or 0.4)",
        ),
        valued(
            "--gap G",
            millimetres,
            "the least distance of parts that pass in a layer, in mm (default: 0.5)",
            0.5,
        ),
        valued("--kerf K", millimetres, "the width of the cut in mm (default: 0)", 0.0),
        valued("--sheet WxH", sheet, "the size of the material in mm, or of a page, A4 or Letter"),
        valued("--fit PAGE", str, "scale all parts to fit a page, A4 or Letter (default: true size)"),
        argument(
            *("--preview",),
            metavar="PICTURE",
            type=Path,
            nargs="?",
            const=Path(),
            help="show the layers in the window, or draw them as a picture: .svg, .png or .pdf",
        ),
        flag("--bridge", "let fixed pins hang from a plate above if they are in the way below"),
        flag("--json", "print parts and pins as one object; lengths in mm"),
        LANG,
    ),
}
"""The arguments of the commands that show pictures."""
