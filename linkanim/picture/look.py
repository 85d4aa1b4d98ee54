"""What is shown of a scene, apart from the pose; each field says how users change it.

`TOGGLES` is the one table of these changes: keys, the help sheet, the window's answers, tapes and the options
of the commands read it, so that a field added here is in all of them.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import field, fields, replace
from typing import Any, Literal, NamedTuple, TypeVar

from linkanim.frozen import frozen
from linkanim.units import LENGTH_UNITS
from linkanim.words import said

ThemeName = Literal["light", "dark"]
Material = Literal["lit", "flat"]
"""How bodies look: lit, with shadows and highlights; or flat, as a diagram."""
Over = Literal["angle", "time", "phase"]
"""The horizontal axis of a chart."""
ConstructionKind = Literal["synthesis", "dead-centres", "centres"]
"""What is drawn in steps: how a linkage was found, its instant centres, its dead centres."""
Default = TypeVar("Default")

VELOCITY: Literal["v"] = "v"
ACCELERATION: Literal["a"] = "a"
FORCE: Literal["f"] = "f"


class Option(NamedTuple):
    """An option of the command line, written `--name`: its help, and the commands that take it.

    `step` is the value that it stands for. Without one each mention of the option goes a step further, and a
    toggle of two steps has a `--no-name`, too. With a `metavar` the option takes a value.
    """

    name: str
    help: str
    step: object = None
    metavar: str | None = None
    commands: tuple[str, ...] = ("record", "draw")


class Toggle(NamedTuple):
    """How one field of `Look` is changed; its name is that of the action and of the tape's key, too.

    `steps` are its values in the order in which its key goes through them; for a set, its members, each with
    a key of its own; without steps the value is free text. `answers` is what the window says at each step. In
    the help sheet its keys stand with their `title` under a `subject`; without one, in a line with others.
    """

    steps: tuple[Any, ...] = (False, True)
    answers: tuple[str, ...] = ()
    keys: tuple[str, ...] = ()
    title: str = ""
    subject: str = ""
    options: tuple[Option, ...] = ()

    @property
    def members(self) -> tuple[str | None, ...]:
        """What the action of each key names: for a set its member, else None."""
        return self.steps if len(self.keys) > 1 else (None,)


def _toggle(default: Default, *options: Option, **how: Any) -> Default:
    """Return a field of `Look` with a default, and how users change it."""
    return field(default=default, metadata={"toggle": Toggle(options=options, **how)})


@frozen(kw_only=True)
class Look:
    """What is shown; two pictures of one pose with equal looks and sizes have the same bytes.

    With `ink` traces are thickened and coloured by speed. `vectors` holds "v" (velocity), "a"
    (acceleration) and "f" (force, where the scene has any). `chart` is one of `scene.quantities`, up to three
    with commas between, or None for no chart; `over` is its horizontal axis, "angle", "time" or "phase", or
    None for the usual one. Lengths are shown in `unit`, or in the scene's own if it is None. With
    `background` False the ground stays
    transparent. `zoom` multiplies the fitted scale; `pan` shifts the picture right and down, in fractions
    of the window's height. `ghost` draws the other closure faintly. `names` is 0 for none, 1 for the names
    of joints and links with the input's direction of turning, 2 for dimensions and the input's angle as
    well; with either a slider's guide has its `dead_centres`, if they are asked for.
    `caption` adds the scene's sentence on what to watch for. `polygons` draws the velocity and acceleration
    polygons beside the linkage; `large_polygon` 1 draws the first of them alone, 2 the second. `chain`
    colours the links in the order in which they are solved. `centres` is 0 for none, 1 for the instant
    centres with Kennedy's lines, 2 for the coupler's centrodes as well.
    Words are `type_scale` times as large as usual.
    """

    trace: bool = _toggle(
        True,
        Option("trace", "draw the curves of the traced joints"),
        answers=("no trace", "trace"),
        keys=("t",),
        title="coupler trace",
        subject="look",
    )
    ink: bool = _toggle(
        False,
        Option("ink", "colour and thicken the traces by their points' speed, with dots at equal times", True),
        answers=("trace in its colour", "trace inked by speed"),
        keys=("y",),
        title="the trace inked by speed",
        subject="look",
    )
    vectors: frozenset[str] = _toggle(
        frozenset(),
        Option("vectors", "draw velocities, accelerations, forces, or several of them", metavar="v,a,f"),
        steps=(VELOCITY, ACCELERATION, FORCE),
        answers=("velocity", "acceleration", "force"),
        keys=("v", "a", "f"),
        title="velocity, acceleration, force",
        subject="measure",
    )
    names: int = _toggle(
        0,
        Option(
            "names",
            "name joints and links; given twice, add dimensions and the input's angle",
            commands=("record", "draw", "share"),
        ),
        steps=(0, 1, 2),
        answers=("no names", "names", "names and dimensions"),
        keys=("n",),
        title="names: off, joints and links, with dimensions",
        subject="look",
    )
    dead_centres: bool = _toggle(
        False,
        Option(
            "dead-centres",
            "with names, mark a slider's dead centres with the input's angles there",
            True,
            commands=("record", "draw", "share"),
        ),
        answers=("no dead centres", "dead centres, with names"),
        keys=("shift+n",),
    )
    polygons: bool = _toggle(
        False,
        Option("polygons", "draw the velocity and acceleration polygons beside the linkage", True),
        answers=("no polygons", "polygons"),
        keys=("p",),
    )
    large_polygon: int = _toggle(
        0,
        steps=(0, 1, 2),
        answers=("no polygon alone", "the velocity polygon, large", "the acceleration polygon, large"),
        keys=("shift+p",),
    )
    centres: int = _toggle(
        0,
        Option(
            "instant-centres",
            "mark all instant centres, with Kennedy's lines; of more than five links those to the ground",
            1,
        ),
        Option("centrodes", "and the centrodes, the paths of the coupler's instant centre", 2),
        steps=(0, 1, 2),
        answers=("no instant centres", "instant centres", "instant centres and centrodes"),
        keys=("i",),
        title="instant centres: off, marked, with centrodes",
        subject="measure",
    )
    chain: bool = _toggle(
        False,
        Option(
            "chain", "colour the links in the order in which they are solved, fading from the input", True
        ),
        answers=("links in their colours", "the input's colour along the chain"),
        keys=("j",),
        title="the input's colour along the chain, as it is solved",
        subject="look",
    )
    ghost: bool = _toggle(
        False,
        Option("ghost", "draw the other closure faintly", True, commands=("draw",)),
        answers=("one closure", "both closures"),
        keys=("shift+b",),
    )
    caption: bool = _toggle(
        False,
        Option("caption", "add the scene's sentence on what to watch for", True, commands=("record", "draw")),
    )
    hud: bool = _toggle(True, Option("hud", "show the lines of text", commands=("record",)))
    chart: str | None = _toggle(
        None,
        Option(
            "chart",
            "add the chart of a quantity, such as rocker.angle; record takes three, with commas between",
            metavar="QTY",
            commands=("record", "share"),
        ),
        steps=(),
    )
    over: Over | None = _toggle(
        None,
        Option(
            "over",
            "the horizontal axis of the chart (default: angle; for an input that swings, time)",
            commands=("record", "chart"),
        ),
        steps=("angle", "time", "phase"),
        answers=("charts over the input's angle", "charts over time", "charts over phase"),
        keys=("x",),
    )
    unit: str | None = _toggle(
        None,
        Option(
            "unit",
            "the unit of lengths, and so of velocities (default: the file's)",
            commands=("play", "record", "draw", "chart", "explain", "report", "share"),
        ),
        steps=LENGTH_UNITS,
        answers=tuple(f"lengths in {unit}" for unit in LENGTH_UNITS),
        keys=("shift+u",),
    )
    theme: ThemeName = _toggle(
        "light",
        Option("theme", "the colours (default: light)", commands=("play", "record", "chart", "draw")),
        Option("theme", "the colours (default: as the reader's system is set)", commands=("share",)),
        steps=("light", "dark"),
        answers=("light", "dark"),
        keys=("l",),
    )
    material: Material = _toggle(
        "lit",
        Option(
            "look",
            "lit, as of metal, or flat, as in print (default: lit; of a figure, flat)",
            commands=("play", "record", "draw"),
        ),
        steps=("lit", "flat"),
        answers=("lit, as of metal", "flat, as in print"),
        keys=("shift+l",),
    )
    background: bool = _toggle(
        True,
        Option("transparent", "leave the background out (not of MP4)", False, commands=("record",)),
        Option("transparent", "leave the background out", False, commands=("draw",)),
        steps=(True, False),
    )
    zoom: float = 1.0
    pan: tuple[float, float] = (0.0, 0.0)
    type_scale: float = 1.0

    @property
    def framed(self) -> bool:
        """Whether it is zoomed or panned."""
        return self.zoom != 1 or self.pan != (0.0, 0.0)

    @property
    def polygons_shown(self) -> int:
        """0 for no polygons, 1 for both, 2 for a large one alone."""
        return 2 if self.large_polygon else int(self.polygons)

    @property
    def named(self) -> bool:
        """Whether names are drawn on the linkage: of its parts, or of instant centres in joints."""
        return self.joints_named or self.centres > 0

    @property
    def joints_named(self) -> bool:
        """Whether joints' names are drawn: also for polygons, whose vectors are named by joints."""
        return self.names > 0 or self.polygons_shown == 1


TOGGLES: Mapping[str, Toggle] = {
    one.name: one.metadata["toggle"] for one in fields(Look) if "toggle" in one.metadata
}
"""How each field is changed, by its name."""


def toggled(look: Look, name: str, member: str | None = None) -> Look:
    """Return the look with a field at its next step, or with a member of a set put in or taken out."""
    value, steps = getattr(look, name), TOGGLES[name].steps
    if isinstance(value, frozenset):
        changed: Any = value ^ {member}
    else:
        changed = steps[(steps.index(value) + 1) % len(steps)]
    return replace(look, **{name: changed})


def answer(before: Look, after: Look, name: str) -> str | None:
    """Return in a word or two the new value of a field; None where it has not changed."""
    was, now = getattr(before, name), getattr(after, name)
    words: dict[Any, str] = dict(zip(TOGGLES[name].steps, TOGGLES[name].answers, strict=True))
    if was == now:
        return None
    if isinstance(now, frozenset):
        one = next(iter(was ^ now))
        return said(words[one]) if one in now else said("no {shown}", shown=said(words[one]))
    return said(words[now])
