"""What is not a scene is refused in one line that names the file, the key, the reason and a way out."""

from __future__ import annotations

import contextlib
import datetime
import re
import tomllib
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from limits import Limits

import linkanim.scenes
from linkanim.errors import AssemblyError, BadInput, SceneError
from linkanim.scenes import load
from linkanim.scenes.reading import scene_from
from linkanim.scenes.toml import parse

FOUR_BAR = "[four-bar]\nground = 100\ncrank = 30\ncoupler = 90\nrocker = 80\n"
CATALOGUE = Path(linkanim.scenes.__file__).with_name("catalogue")
LONG = """
[ground]
O2 = [0, 0]
O4 = [100, 0]
[joints.A]
crank = "O2"
length = 30
[joints.B]
from = ["A", "O4"]
length = [90, 80]
"""
ON_B = "coupler_point = [90, 0]\n"
PHOTO = '[photo]\nfile = "%s"\nplace = [0, 0]\nwidth = 90\n'
GEARED = '[joints.D]\ncrank = "O4"\nlength = 20\ngear = { with = "A", ratio = %s }\n'

REFUSED: list[tuple[str, str, str, str]] = [
    # Keys and tables that are not known: a misspelt key must not be passed over in silence.
    ("misspelt top table", FOUR_BAR + "[drve]\n", "drve", 'did you mean "drive"'),
    ("misspelt top key", "titel = 'x'\n" + FOUR_BAR, "titel", 'did you mean "title"'),
    ("misspelt length", FOUR_BAR.replace("coupler", "cuopler"), "four-bar.cuopler", 'did you mean "coupler"'),
    (
        "a number as a line",
        LONG + "[joints.C]\nfrom = 'B'\nlength = 99\nline = 3\n",
        "joints.C.line",
        "must be a table",
    ),
    (
        "a list where a slider has one end",
        LONG + "line = { through = 'O2', angle = '0 deg' }\n",
        "joints.B.from",
        "must be a text",
    ),
    ("misspelt kind", LONG.replace("from", "form"), "joints.B.form", 'did you mean "from"'),
    ("stray key in a joint", LONG + "colour = 'red'\n", "joints.B.colour", "known here: from, length, side"),
    ("stray key in gear", LONG + GEARED % "1, phase = 0", "joints.D.gear.phase", "with, ratio, offset"),
    ("stray key in drive", FOUR_BAR + "[drive]\nrpm = 20\n", "drive.rpm", "joint, speed, start"),
    # Names that are not known.
    (
        "unknown pivot",
        LONG.replace('crank = "O2"', 'crank = "O3"'),
        "joints.A.crank",
        "there are O2, O4, A, B",
    ),
    ("unknown end", LONG.replace('["A"', '["a"'), "joints.B.from", 'no joint is called "a"'),
    ("unknown trace", FOUR_BAR + "[trace]\njoints = ['Q']\n", "trace.joints", "there are O2, O4, A, B"),
    ("unknown driven joint", FOUR_BAR + "[drive]\njoint = 'Q'\n", "drive.joint", "that is A"),
    ("unknown spring end", FOUR_BAR + "[springs.s]\nbetween = ['A', 'Q']\n", "springs.s.between", '"Q"'),
    ("unknown damper end", FOUR_BAR + "[dampers.d]\nbetween = ['Q', 'A']\n", "dampers.d.between", '"Q"'),
    ("unknown gear", LONG + GEARED.replace('"A"', '"Z"') % 1, "joints.D.gear.with", '"Z"'),
    ("unknown slider", FOUR_BAR + "[bodies]\nx = { slider = 'Q' }\n", "bodies.x.slider", '"Q"'),
    # A joint cannot be found from itself, however long the way round.
    ("self", LONG.replace('["A"', '["B"'), "joints.B.from", "itself"),
    (
        "circle",
        LONG + "[joints.C]\non = ['A', 'D']\nat = [1, 1]\n[joints.D]\non = ['A', 'C']\nat = [1, 1]\n",
        "joints",
        "-> ",
    ),
    (
        "a circle of many",
        LONG + "".join(f"[joints.J{n}]\non = ['A', 'J{(n + 1) % 30}']\nat = [1, 1]\n" for n in range(30)),
        "joints",
        "J12 -> ...: a joint cannot depend on itself",
    ),
    ("geared to itself", LONG + (GEARED % 1).replace('"A"', '"D"'), "joints.D.gear.with", "itself"),
    # One shorthand a file, and no second joint of a name.
    (
        "two shorthands",
        FOUR_BAR + "[slider-crank]\ncrank = 1\nrod = 3\n",
        "[four-bar] and [slider-crank]",
        "keep one",
    ),
    ("a name twice", FOUR_BAR + "[joints.A]\ncrank = 'O2'\nlength = 3\n", "joints.A", "already"),
    ("a pin like a joint", LONG + "[joints.O2]\ncrank = 'O4'\nlength = 3\n", "joints.O2", "already"),
    ("nothing at all", "title = 'x'\n", "no linkage", "four-bar"),
    # Lengths.
    ("zero", FOUR_BAR.replace("30", "0"), "four-bar.crank = 0", "above zero"),
    ("negative", FOUR_BAR.replace("30", "-30"), "four-bar.crank = -30", "above zero"),
    ("nan", FOUR_BAR.replace("30", "nan"), "four-bar.crank", "finite"),
    ("inf", FOUR_BAR.replace("30", "inf"), "four-bar.crank", "finite"),
    (
        "a picture of a name that no disk has",
        FOUR_BAR + PHOTO % ("n" * 300),
        "photo.file",
        "more than 255 letters",
    ),
    ("a picture without a name", FOUR_BAR + PHOTO % " ", "photo.file", "has no name"),
    (
        "far too long",
        FOUR_BAR.replace("30", "1e101"),
        "four-bar.crank",
        "beyond what can be computed; 1e+12 mm is the most",
    ),
    ("far too short", FOUR_BAR.replace("30", "1e-101"), "four-bar.crank", "; 1e-12 mm is the least"),
    ("far away", "[ground]\nO2 = [-1e101, 0]\n" + FOUR_BAR, "ground.O2[0]", "beyond"),
    ("1e999", FOUR_BAR.replace("30", "1e999"), "four-bar.crank", "finite"),
    ("a word", FOUR_BAR.replace("30", "'long'"), "four-bar.crank", "not a length"),
    ("true", FOUR_BAR.replace("30", "true"), "four-bar.crank", "true is not a length"),
    ("an angle", FOUR_BAR.replace("30", "'30 deg'"), "four-bar.crank", "mm, cm, m, in"),
    ("one length for two bars", LONG.replace("[90, 80]", "90"), "joints.B.length", "such as [10, 20]"),
    ("the second of two", LONG.replace("[90, 80]", "[90, -80]"), "joints.B.length[1] = -80", "above zero"),
    ("missing length", FOUR_BAR.replace("crank = 30\n", ""), "four-bar", '"crank" is missing'),
    ("seven of eight", "[six-bar]\nlengths = [1, 2, 3, 4, 5, 6, 7]\n", "six-bar.lengths", "list of 8"),
    (
        "zero polar pin",
        LONG.replace("[100, 0]", "{ length = 0, angle = '0 deg' }"),
        "ground.O4.length",
        "above zero",
    ),
    ("pin of three", LONG.replace("[100, 0]", "[100, 0, 0]"), "ground.O4", "list of 2"),
    ("unknown length unit", "length_unit = 'ft'\n" + FOUR_BAR, "length_unit", '"mm" or "cm" or "m" or "in"'),
    # Angles and speeds carry their unit.
    ("bare angle", FOUR_BAR + "ground_angle = 30\n", "four-bar.ground_angle", '"30 deg"'),
    ("bare speed", FOUR_BAR + "[drive]\nspeed = 20\n", "drive.speed", '"20 rpm"'),
    ("bare start", FOUR_BAR + "[drive]\nstart = 0\n", "drive.start", '"0 deg"'),
    ("no speed", FOUR_BAR + "[drive]\nspeed = '0 rpm'\n", "drive.speed", "moves nothing"),
    # Gears: the ratio says after how many turns the motion repeats.
    ("not a fraction", LONG + GEARED % 3.14159, "joints.D.gear.ratio = 3.14159", '"22/7"'),
    ("rounded third", LONG + GEARED % 0.333, "joints.D.gear.ratio", '"1/3"'),
    ("thirteenth", LONG + GEARED % "'5/13'", "joints.D.gear.ratio", '"3/8"'),
    ("zero ratio", LONG + GEARED % 0, "joints.D.gear.ratio", "other than zero"),
    ("zero below", LONG + GEARED % "'1/0'", "joints.D.gear.ratio", "other than zero"),
    ("nan ratio", LONG + GEARED % "nan", "joints.D.gear.ratio", "other than zero"),
    ("just too steep", LONG + GEARED % 101, "joints.D.gear.ratio = 101", "100"),
    ("just too steep backwards", LONG + GEARED % "'-1201/12'", "joints.D.gear.ratio", "100"),
    ("very steep", LONG + GEARED % 1e300, "joints.D.gear.ratio", "100"),
    ("very slow", LONG + GEARED % 1e-300, "joints.D.gear.ratio", "1/12"),
    ("true ratio", LONG + GEARED % "true", "joints.D.gear.ratio", "other than zero"),
    (
        "no ratio",
        LONG + '[joints.D]\ncrank = "O4"\nlength = 2\ngear = { with = "A" }\n',
        "gear",
        '"ratio" is missing',
    ),
    ("geared to no crank", LONG + (GEARED % 1).replace('"A"', '"B"'), "joints.D.gear.with", "not a crank"),
    # One input.
    ("two inputs", LONG + "[joints.D]\ncrank = 'O4'\nlength = 20\n", "D is a second input", "gear"),
    (
        "no input",
        "[ground]\nO = [0, 0]\nG = [9, 0]\n[joints.P]\non = ['O', 'G']\nat = [1, 2]\n",
        "joints",
        "no crank is free",
    ),
    ("driving the geared", LONG + GEARED % 1 + "[drive]\njoint = 'D'\n", "drive.joint", "that is A"),
    # What is held by the ground must be a fixed pin.
    (
        "crank on a moving pin",
        LONG + "[joints.D]\ncrank = 'A'\nlength = 2\n",
        "joints.D.crank",
        "A moves",
    ),
    (
        "line through a moving pin",
        LONG + "[joints.C]\nfrom = 'B'\nlength = 99\nline = { through = 'A', angle = '0 deg' }\n",
        "joints.C.line.through",
        "A moves; name a fixed pin (O2, O4)",
    ),
    (
        "line that two bodies would have to carry",
        LONG + "[joints.C]\nfrom = 'A'\nlength = 9\nline = { on = ['O4', 'B'], through = 'A' }\n",
        "joints.C",
        "O4, B and A are not on one rigid body; name joints of one bar",
    ),
    # Points and bodies are rigid.
    ("point on two bars", LONG + "[joints.P]\non = ['O2', 'B']\nat = [1, 2]\n", "joints.P", "rigid"),
    (
        "point on its own joint",
        LONG + "[joints.P]\non = ['A', 'B']\nat = [0, 0]\n",
        "joints.P.at",
        "A itself",
    ),
    ("coupler point on A", FOUR_BAR + "coupler_point = [0, 0]\n", "four-bar.coupler_point", "A itself"),
    ("point on one joint", LONG + "[joints.P]\non = ['A', 'A']\nat = [1, 2]\n", "joints.P.on", "twice"),
    (
        "body of two bars",
        FOUR_BAR + "[bodies]\nx = { joints = ['A', 'B', 'O4'] }\n",
        "bodies.x.joints",
        "rigid",
    ),
    ("body of one joint", FOUR_BAR + "[bodies]\nx = { joints = ['A'] }\n", "bodies.x.joints", "two joints"),
    ("slider that turns", FOUR_BAR + "[bodies]\nx = { slider = 'B' }\n", "bodies.x.slider", "travel"),
    ("body of nothing", FOUR_BAR + "[bodies.x]\n", "bodies.x", '"joints" is missing'),
    ("joint of no kind", LONG + "[joints.C]\nlength = 3\n", "joints.C", "crank, line, from, slot, slide, on"),
    # Where two joints are one point no direction leads from one to the other.
    (
        "point on one point twice",
        FOUR_BAR + ON_B + "[joints.Q]\non = ['B', 'P']\nat = [1, 2]\n",
        "joints.Q",
        "one point",
    ),
    (
        "body that has no direction",
        FOUR_BAR + ON_B + "[bodies]\nx = { joints = ['B', 'P'] }\n",
        "bodies.x",
        "one point",
    ),
    # A slider or a slot that hangs on fixed pins only does not move.
    (
        "slider on a fixed pin",
        LONG + "[joints.C]\nfrom = 'O4'\nlength = 99\nline = { through = 'O2' }\n",
        "joints.C.from",
        "moves",
    ),
    (
        "yoke whose slot lies along its line",
        LONG + "[joints.C]\nslide = { pin = 'B', line = { through = 'O2' }, slot = '180 deg' }\n",
        "joints.C.slide.slot",
        "never crosses it",
    ),
    (
        "yoke on a fixed pin",
        LONG + "[joints.C]\nslide = { pin = 'O4', line = { through = 'O2' } }\n",
        "joints.C.slide.pin",
        "a joint that moves",
    ),
    (
        "slot on a fixed pin",
        LONG + "[joints.C]\nslot = { pivot = 'O2', through = 'O4' }\nlength = 9\n",
        "joints.C.slot.through",
        "moves",
    ),
    # Springs and dampers.
    (
        "half a force",
        FOUR_BAR + "[springs.s]\nbetween = ['A', 'O4']\nstiffness = '4 N/m'\n",
        "springs.s",
        "free_length",
    ),
    (
        "bare stiffness",
        FOUR_BAR + "[springs.s]\nbetween = ['A', 'O4']\nfree_length = 3\nstiffness = 4\n",
        "springs.s.stiffness",
        '"4 N/m"',
    ),
    (
        "negative damping",
        FOUR_BAR + "[dampers.d]\nbetween = ['A', 'O4']\ncoefficient = '-4 N s/m'\n",
        "dampers.d.coefficient",
        "above zero",
    ),
    ("spring on one joint", FOUR_BAR + "[springs.s]\nbetween = ['A', 'A']\n", "springs.s.between", "twice"),
    (
        "spring of three",
        FOUR_BAR + "[springs.s]\nbetween = ['A', 'B', 'O4']\n",
        "springs.s.between",
        "2 joints",
    ),
    # Masses: known where they are, in their own units; gravity pulls at them alone.
    (
        "a mass without its place",
        FOUR_BAR + "[bodies.x]\njoints = ['O2', 'A']\nmass = '3 kg'\n",
        "bodies.x.mass",
        "com = [15, 0] is halfway from O2 to A",
    ),
    (
        "a bare mass",
        FOUR_BAR + "[bodies.x]\njoints = ['O2', 'A']\ncom = [1, 0]\nmass = 3\n",
        "bodies.x.mass",
        '"3 kg" or "3 g"',
    ),
    (
        "a bare moment of inertia",
        FOUR_BAR + "[bodies.x]\njoints = ['O2', 'A']\ninertia = 3\n",
        "bodies.x.inertia",
        '"3 kg m^2"',
    ),
    (
        "no mass at all",
        FOUR_BAR + "[bodies.x]\njoints = ['O2', 'A']\ncom = [1, 0]\nmass = '0 kg'\n",
        "bodies.x.mass",
        "above zero",
    ),
    (
        "a slider that could turn",
        "[slider-crank]\ncrank = 1\nrod = 3\n[bodies.slider]\nslider = 'B'\ninertia = '1 kg m^2'\n",
        "bodies.slider.inertia",
        "known here: slider, mass",
    ),
    ("gravity without a mass", "gravity = '9.81 m/s^2'\n" + FOUR_BAR, "gravity", "give a body its mass"),
    ("bare gravity", "gravity = 9.81\n" + FOUR_BAR, "gravity", '"9.81 m/s^2"'),
    # Choices, and tables that are something else.
    ("no such assembly", FOUR_BAR + "assembly = 'closed'\n", "four-bar.assembly", '"open" or "crossed"'),
    ("no such side", LONG + "side = 'up'\n", "joints.B.side", '"left" or "right"'),
    ("a list as side", LONG + "side = ['left']\n", "joints.B.side", '"left" or "right"'),
    ("a number as title", "title = 3\n" + FOUR_BAR, "title = 3", "text in quotes"),
    ("a number as drive", "drive = 3\n" + FOUR_BAR, "drive = 3", "must be a table"),
    ("a list as joints", "joints = [1]\n" + FOUR_BAR, "joints", "must be a table"),
    ("a list as bodies", "bodies = [1]\n" + FOUR_BAR, "bodies", "must be a table"),
    ("a number as body", FOUR_BAR + "[bodies]\nx = 3\n", "bodies.x = 3", "must be a table"),
    ("numbers as names", FOUR_BAR + "[trace]\njoints = [1]\n", "trace.joints", "list of joint names"),
    # Names become keys of tables, JSON and charts ("B.velocity").
    ("a dot in a name", LONG + "[joints.'a.b']\non = ['A', 'B']\nat = [1, 2]\n", 'joints."a.b"', "no dot"),
    ("a line in a name", LONG + "[joints.\"a\\nb\"]\non = ['A', 'B']\nat = [1, 2]\n", "joints", "printable"),
    ("an empty name", LONG + "[joints.'']\non = ['A', 'B']\nat = [1, 2]\n", "joints", "1 to 32"),
    ("a body called so", LONG + "[bodies.input]\njoints = ['O2', 'A']\n", "bodies.input", "another"),
    ("a joint called so", LONG + "[joints.input]\non = ['A', 'B']\nat = [1, 2]\n", "joints.input", "another"),
    # Not TOML at all.
    ("not TOML", FOUR_BAR + "crank 30\n", "is not TOML", "line 6"),
    ("a key twice", FOUR_BAR + "crank = 30\n", "is not TOML", "line 6"),
    ("deep brackets", "x = " + "[" * 5000, "nested deeper than 16 levels", ""),
    ("endless integer", FOUR_BAR.replace("30", "3" * 5000), "more than 1,000 digits", "line 3"),
    ("endless by sixteens", FOUR_BAR.replace("30", "0x" + "f" * 5000), "more than 1,000 digits", "line 3"),
    ("endless decimal", FOUR_BAR.replace("30", "0." + "3" * 5000), "more than 1,000 digits", "line 3"),
    ("endless length", FOUR_BAR.replace("30", f'"{"3" * 5000} mm"'), "more than 1,000 digits", "line 3"),
    # What no digits and no pixels show together, or at all.
    ("sizes far apart", FOUR_BAR.replace("30", "3e11"), "four-bar: a bar of 80", "1e+09 times"),
    ("a pin far away", "[ground]\nG = [1e11, 0]\n" + FOUR_BAR, "four-bar: a bar of 30", "the 1e+11 mm of G"),
    ("a point on its joint", FOUR_BAR + "coupler_point = [0, 1e-12]\n", "a bar of 1e-12", "too short"),
    ("a length in light-years", FOUR_BAR.replace("30", "1e13"), "four-bar.crank", "1e+12 mm is the most"),
    ("a start turns away", FOUR_BAR + '[drive]\nstart = "36001 deg"\n', "drive.start", "whole turns out"),
    (
        "a bare speed of a cylinder",
        LONG + '[drive]\nspeed = 30\ncylinder = { between = ["O4", "A"], from = 80, to = 100 }\n',
        "drive.speed",
        '"30 mm/s" or "30 cm/s"',
    ),
    (
        "a speed of a slider in kilograms",
        '[ground]\nO = [0, 0]\n[joints.S]\nline = { through = "O" }\n'
        '[drive]\nspeed = "30 kg"\nslider = { joint = "S", from = 80, to = 100 }\n',
        "drive.speed",
        "mm/s, cm/s, m/s, in/s, rpm",
    ),
    (
        "a bare speed of a crank",
        FOUR_BAR + "[drive]\nspeed = 30\n",
        "drive.speed",
        'write an angular speed as "30 rpm" or "30 rad/s" or "30 deg/s"',
    ),
    (
        "a cylinder on the crank's own pivot",
        LONG.replace("O4", "G = [0, 0]\nO4", 1)
        + '[drive]\ncylinder = { between = ["G", "A"], from = 1, to = 2 }\n',
        "drive.cylinder.between",
        "G and O2 are one point",
    ),
    # Text that a terminal would obey, or that no page may hold.
    ("an escape in a title", 'title = "a\\u001bb"\n' + FOUR_BAR, 'title = "a?b"', "U+001B"),
    ("an override in a note", 'notes = ["a", "\\u202e"]\n' + FOUR_BAR, "notes[1]", "U+202E"),
    ("a line separator in a name", '"\\u2028" = 1\n' + FOUR_BAR, '"?": has', "U+2028"),
]


@pytest.mark.parametrize(
    ("text", "where", "reason"), [row[1:] for row in REFUSED], ids=[row[0] for row in REFUSED]
)
def test_a_bad_scene_is_refused_in_one_line(text: str, where: str, reason: str) -> None:
    with pytest.raises(SceneError) as refusal:
        scene_from(parse(text, "my.toml"), name="my", where="my.toml")
    said = str(refusal.value)
    assert said.startswith("my.toml: ")
    assert where in said
    assert reason in said
    assert "\n" not in said


def _tables(values: dict[str, Any], path: tuple[str, ...] = ()) -> Iterator[tuple[str, dict[str, Any]]]:
    """Yield the tables of a document, each with its key."""
    yield ".".join(path), values
    for key, value in values.items():
        if isinstance(value, dict):
            yield from _tables(value, (*path, key))


@pytest.mark.slow
def test_a_stray_key_is_refused_in_every_table_of_every_kind() -> None:
    kinds = set()
    for file in sorted(CATALOGUE.rglob("*.toml")):
        document = tomllib.loads(file.read_text(encoding="utf-8"))
        for key, table in list(_tables(document)):
            kind = (key.partition(".")[0], key.count("."), *sorted(table))
            if kind in kinds:
                continue
            kinds.add(kind)
            table["stray"] = 1
            with pytest.raises(SceneError, match=re.escape(f"{key}.stray".lstrip("."))):
                scene_from(document, name="my", where="my.toml")
            del table["stray"]
    assert len(kinds) > 60


@pytest.mark.parametrize("text", [FOUR_BAR, LONG, LONG + GEARED % -1])
def test_the_texts_that_are_spoilt_above_are_good_before(text: str) -> None:
    assert scene_from(tomllib.loads(text), name="my", where="my.toml").linkage.joints


@pytest.mark.parametrize(
    "ratio",
    ["1", "-1", "0.5", "'1/3'", "'-5/12'", "0.1", "0.3333333333333333", "' 2 / 6 '", "'0.25'", "100", "-100"],
)
def test_small_fractions_are_gear_ratios(ratio: str) -> None:
    linkage = scene_from(tomllib.loads(LONG + GEARED % ratio), name="my", where="my.toml").linkage
    geared = [crank.gear for crank in linkage.cranks if crank.gear]
    assert [gear.ratio.denominator <= 12 for gear in geared] == [True]


UNASSEMBLED: list[tuple[str, str, str, str]] = [
    # s + p + q < l: no angle of the crank closes the loop.
    ("ground too long", FOUR_BAR.replace("100", "400"), "four-bar", "joint B"),
    ("crank too long", FOUR_BAR.replace("30", "300"), "four-bar", "joint B"),
    ("long form", LONG.replace("[90, 80]", "[9, 8]"), "joints", "joint B"),
    ("offset too large", "[slider-crank]\ncrank = 40\nrod = 120\noffset = 161\n", "slider-crank", "joint B"),
    ("rod too short", "[slider-crank]\ncrank = 4\nrod = 12\noffset = -17\n", "slider-crank", "joint B"),
    (
        "slot too far aside",
        LONG + "[joints.C]\nslot = { pivot = 'O4', through = 'A', offset = 131 }\nlength = 9\n",
        "joints",
        "joint C",
    ),
    # A brace on one body either fits or does not, whatever the input does.
    (
        "brace too short",
        LONG + "[joints.T]\nfrom = ['A', 'B']\nlength = [40, 40]\n",
        "joints.T",
        "90 mm apart",
    ),
    (
        "brace too long",
        LONG + "[joints.T]\nfrom = ['A', 'B']\nlength = [10, 110]\n",
        "joints.T",
        "90 mm apart",
    ),
    (
        "brace on one point",
        FOUR_BAR + ON_B + "[joints.T]\nfrom = ['P', 'B']\nlength = [9, 9]\n",
        "joints.T",
        "0 mm apart",
    ),
]


@pytest.mark.parametrize(
    ("text", "where", "reason"), [row[1:] for row in UNASSEMBLED], ids=[row[0] for row in UNASSEMBLED]
)
def test_lengths_that_cannot_be_assembled_are_refused_when_read(text: str, where: str, reason: str) -> None:
    with pytest.raises(AssemblyError) as refusal:
        scene_from(parse(text, "my.toml"), name="my", where="my.toml")
    said = str(refusal.value)
    assert said.startswith(f"my.toml: {where}")
    assert reason in said
    assert "\n" not in said


@pytest.mark.parametrize("length", range(0, 290, 3))
def test_a_file_cut_short_is_refused_or_read_but_never_fails(length: int) -> None:
    whole = LONG + GEARED % -1 + "[bodies]\nx = { joints = ['A', 'B'] }\n"
    with contextlib.suppress(SceneError):
        assert scene_from(parse(whole[:length], "my.toml"), name="my", where="my.toml").name == "my"


def nodes(document: Any, path: tuple[str | int, ...] = ()) -> Iterator[tuple[str | int, ...]]:
    """Iterate the paths of all tables, lists and values of a document."""
    yield path
    if isinstance(document, dict | list):
        for key, value in document.items() if isinstance(document, dict) else enumerate(document):
            yield from nodes(value, (*path, key))


def spoilt(document: Any, path: tuple[str | int, ...], value: object) -> Any:
    """Return the document with another value at a path."""
    if not path:
        return value
    if isinstance(document, list):
        return [spoilt(item, path[1:], value) if i == path[0] else item for i, item in enumerate(document)]
    return {**document, path[0]: spoilt(document[path[0]], path[1:], value)}


JUNK: st.SearchStrategy[object] = st.recursive(
    st.booleans()
    | st.integers()
    | st.floats()
    | st.text(max_size=8)
    | st.sampled_from(["A", "B", "O2", "P", "90 deg", "20 rpm", "3 mm", "left", "1/3"])
    | st.sampled_from([10**400, datetime.date.min]),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=4), inner, max_size=3),
    max_leaves=4,
)


@settings(max_examples=120)
@given(st.data())
@pytest.mark.slow
def test_a_scene_spoilt_anywhere_is_refused_or_read_but_never_fails(data: st.DataObject) -> None:
    document = load(data.draw(st.sampled_from(["press", "crank-rocker", "slider-crank", "six-bar"]))).document
    path = data.draw(st.sampled_from([path for path in nodes(document) if path]))
    bad = spoilt(document, path, data.draw(JUNK))
    try:
        scene_from(bad, name="my", where="my.toml")
        said = "my.toml: "
    except BadInput as error:
        said = str(error)
    assert said.startswith("my.toml: ")
    assert "\n" not in said


def test_a_heavy_file_is_refused_before_it_is_parsed(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(tomllib, "loads", lambda text: pytest.fail("parsed"))
    with pytest.raises(SceneError, match=r"my\.toml: is nested deeper than 16 levels"):
        parse("a" + ".a" * 20_000 + " = 1", "my.toml")
    with pytest.raises(SceneError, match=r"my\.toml: has more than 50,000 values"):
        parse("[bodies]\n" * 60_000, "my.toml")


@pytest.mark.parametrize("section", ["joints", "ground", "bodies", "springs", "dampers"])
def test_more_entries_than_are_drawn_are_refused(section: str) -> None:
    entry = "[0, 0]" if section == "ground" else "{}"
    many = "\n".join(f"x{k} = {entry}" for k in range(65))
    with pytest.raises(SceneError, match=rf"my\.toml: {section}: has 65 entries; 64 are the most"):
        scene_from(parse(f"{FOUR_BAR}\n[{section}]\n{many}", "my.toml"), name="my", where="my.toml")


def test_a_list_of_names_to_choose_from_stays_short() -> None:
    pins = "\n".join(f"x{k} = [0, {k}]" for k in range(60))
    text = f"{FOUR_BAR}\n[ground]\n{pins}\n[trace]\njoints = ['Q']"
    with pytest.raises(SceneError, match=r"x\d+ and \d+ more$"):
        scene_from(parse(text, "my.toml"), name="my", where="my.toml")


@pytest.mark.slow
def test_a_crank_that_turns_too_often_is_refused_and_one_that_turns_often_takes_little_memory() -> None:
    def geared(last: int) -> dict[str, Any]:
        train = {"A": {"crank": "O2", "length": 30}}
        for mate, name, ratio in (("A", "B", 100), ("B", "C", 100), ("C", "D", last)):
            train[name] = {"crank": mate, "length": 9, "gear": {"with": mate, "ratio": ratio}}
        arm = {"joints": ["A", "B"], "com": [5, 0], "mass": "2 kg"}
        return {"ground": {"O2": [0, 0]}, "joints": train, "bodies": {"arm": arm}}

    with pytest.raises(AssemblyError, match=r"joint D: it turns 30000 times as fast as the input"):
        scene_from(geared(3), name="geared", where="geared.toml")
    with Limits(10, 200).held():
        assert scene_from(geared(2), name="geared", where="geared.toml").info.demand is not None
