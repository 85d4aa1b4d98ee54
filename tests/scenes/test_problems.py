"""Every problem of a file at once: each the reader's own words, with its line, and none of them twice."""

from __future__ import annotations

import contextlib
import tomllib
from typing import Any

import pytest
import tomli_w
from jsonschema import Draft202012Validator
from test_refusals import FOUR_BAR, GEARED, LONG, REFUSED

from linkanim.errors import BadInput
from linkanim.scenes import load, names
from linkanim.scenes.file_form import JOINTS, SHORTHANDS
from linkanim.scenes.reading import Problem, problems, scene_from
from linkanim.scenes.schema import SCHEMA, schema_of
from linkanim.scenes.toml import line_numbers, parse

MANY = """\
title = "x"
lenght_unit = "mm"
[drive]
speed = "20"
[ground]
O2 = [0, 0]
O4 = [100, "a"]

[joints.A]
crank = "O2"
length = -3

[joints.B]
from = ["A", "Q"]
length = [90,
  0]
side = "up"

[joints.H]      # what B lacks is not H's fault
on = ["A", "B"]
at = [1, 2]

[bodies]
3 = { joints = ["A", "B", "H"], con = [1, 2] }

[springs.s]
between = ["A", "Z"]

[dampers.d]
coefficient = "3 N"
"""
FOUND = [
    (2, 'lenght_unit = "mm": unknown key'),
    (4, 'drive.speed: "20" has no unit'),
    (7, 'ground.O4[1]: "a" is not a length'),
    (11, "joints.A.length = -3: must be above zero"),
    (14, 'joints.B.from: no joint is called "Q"'),
    (15, "joints.B.length[1] = 0: must be above zero"),
    (17, 'joints.B.side = "up": must be'),
    (24, "bodies.3.con: unknown key"),
    (27, 'springs.s.between: no joint is called "Z"'),
    (29, 'dampers.d: "between" is missing'),
    (30, 'dampers.d.coefficient: "3 N" is not'),
]


def said(found: list[Problem]) -> list[tuple[int | None, str]]:
    return [(problem.line, problem.message) for problem in found]


def test_all_problems_are_found_at_once_each_at_its_line() -> None:
    found = said(problems(MANY, name="my", where="my.toml"))
    assert [line for line, _ in found] == [line for line, _ in FOUND]
    for (_, message), (_, start) in zip(found, FOUND, strict=True):
        assert message.startswith(f"my.toml: {start}")


@pytest.mark.parametrize("name", names())
def test_a_good_scene_has_none(name: str) -> None:
    text = tomli_w.dumps(dict(load(name).document))
    assert problems(text, name=name, where=name) == []


# What the reader says of a file with one problem is the first thing, and the only one, that is said.
@pytest.mark.parametrize("text", [row[1] for row in REFUSED], ids=[row[0] for row in REFUSED])
def test_a_file_with_one_problem_has_that_one(text: str) -> None:
    with pytest.raises(BadInput) as refusal:
        scene_from(parse(text, "my.toml"), name="my", where="my.toml")
    found = problems(text, name="my", where="my.toml")
    assert str(refusal.value) in [problem.message for problem in found]
    assert len(found) <= 3


def test_lengths_that_cannot_be_put_together_are_a_problem_too() -> None:
    text = FOUR_BAR.replace("ground = 100", "ground = 1000")
    (found,) = problems(text, name="my", where="my.toml")
    assert found.line == 1
    assert "four-bar" in found.message


def test_a_broken_joint_is_not_held_against_what_hangs_on_it() -> None:
    text = LONG.replace('from = ["A", "O4"]', "from = 3") + (
        "[joints.C]\nfrom = ['B', 'O2']\nlength = [300, 300]\n[bodies]\nx = { joints = ['A', 'B'] }\n"
    )
    assert said(problems(text, name="my", where="my.toml")) == [
        (9, 'my.toml: joints.B.from = 3: must be a list of 2 names, such as ["A", "B"]')
    ]


# The excavator's arm with faults in it, and where they are told: each, and nothing that only follows.
SPOILT: dict[str, tuple[dict[str, Any], list[str]]] = {
    "a joint that others stand on": ({"joints.K.at": 3.5}, ["joints.K.at"]),
    "a table that must go whole": (
        {"source": 3, "drive.cylinder.joint": "Z"},
        ["source", "drive.cylinder.joint"],
    ),
}


@pytest.mark.parametrize(("faults", "places"), SPOILT.values(), ids=SPOILT)
def test_what_only_follows_from_a_problem_is_not_told(faults: dict[str, Any], places: list[str]) -> None:
    document = tomllib.loads(tomli_w.dumps(dict(load("excavator").document)))
    for path, value in faults.items():
        *tables, key = path.split(".")
        table = document
        for name in tables:
            table = table[name]
        table[key] = value
    found = problems(tomli_w.dumps(document), name="my", where="my.toml")
    assert [problem.message.split(": ")[1].split(" ")[0] for problem in found] == places


def test_what_is_not_toml_is_told_with_its_line() -> None:
    (found,) = problems(FOUR_BAR + "crank 30\n", name="my", where="my.toml")
    assert found.line == 6


TEXT = '''\
# a comment
title = """
two
lines"""
[a]
"b c".d = { e = 1, f = [1,
  2] }
[[g]]
h = 1
[i . "j.k"]
l = 2
'''


def test_every_key_has_the_line_it_begins_at() -> None:
    assert tomllib.loads(TEXT)
    assert line_numbers(TEXT) == {
        ("title",): 2,
        ("a",): 5,
        ("a", "b c"): 6,
        ("a", "b c", "d"): 6,
        ("a", "b c", "d", "e"): 6,
        ("a", "b c", "d", "f"): 6,
        ("g",): 8,
        ("g", "h"): 9,
        ("i", "j.k"): 10,
        ("i", "j.k", "l"): 11,
    }


def test_of_very_many_problems_the_first_hundred_are_told() -> None:
    text = FOUR_BAR + "".join(f"k{i} = 1\n" for i in range(200))
    found = problems(text, name="my", where="my.toml")
    first = FOUR_BAR.count("\n") + 1
    assert [problem.line for problem in found] == list(range(first, first + 100))


def test_a_list_over_very_many_lines_ends_the_search_for_lines() -> None:
    found = line_numbers("a = 1\nb = [\n" + "[1],\n" * 20_000 + "]\nc = 1\n")
    assert (("a",) in found, ("c",) in found) == (True, False)


VALIDATOR = Draft202012Validator(SCHEMA)


def fits(document: Any) -> bool:
    fit: bool = VALIDATOR.is_valid(document)
    return fit


def test_the_schema_is_one() -> None:
    Draft202012Validator.check_schema(SCHEMA)


@pytest.mark.parametrize("name", names())
def test_every_scene_of_the_catalogue_fits_the_schema(name: str) -> None:
    assert [error.message for error in VALIDATOR.iter_errors(dict(load(name).document))] == []


@pytest.mark.parametrize("length", [1, 32, 33])
def test_the_schema_knows_how_long_names_are(length: int) -> None:
    crank, pin = "A" * length, "O" * length
    joints = {crank: {"crank": pin, "length": 1}}
    document = {"ground": {pin: [0, 0]}, "joints": joints, "trace": {"joints": [crank]}}
    assert fits(document) == (length <= 32)
    assert fits({**document, "ground": {"O": [0, 0]}, "joints": {"A": joints[crank]}}) == (length <= 32)


# What depends on more than one place, or on numbers, no schema says.
BEYOND = (
    "no joint is called", "cannot be found from itself", "cannot depend on itself",
    "moves; name a fixed pin", "is not a crank", "is fixed, so nothing", "rigid body", "one point",
    "already a joint", "cannot meet", "second input", "free to be driven", "can be driven",
    "small fraction", "times as fast", "has both", "itself; ", "beyond what can be computed",
    "too short beside", "whole turns out",
    "does not travel", "not a finite", "speed of zero", "is not TOML", "nested deeper",
    "two joints or more", "too large", "pulls at nothing", "never crosses", "or a fraction", "printable",
    "above zero",
)  # fmt: skip


@pytest.mark.parametrize("text", [row[1] for row in REFUSED], ids=[row[0] for row in REFUSED])
def test_the_schema_refuses_what_is_refused_for_its_form(text: str) -> None:
    with pytest.raises(BadInput) as refusal:
        scene_from(parse(text, "my.toml"), name="my", where="my.toml")
    with contextlib.suppress(BadInput):
        assert any(words in str(refusal.value) for words in BEYOND) or not fits(parse(text, "my.toml"))


# Beside each the reader and the schema agree: what is refused for its form, and what is good.
FORMS = [
    (FOUR_BAR.replace("30", "'30'"), True),
    (FOUR_BAR.replace("30", "0.5"), True),
    (FOUR_BAR.replace("30", "-30"), False),
    (FOUR_BAR.replace("30", "0"), False),
    (FOUR_BAR + "[trace]\njoints = ['A', 'B']\n", True),
    (FOUR_BAR + "[trace]\njoints = ['A', 'A']\n", False),
    (FOUR_BAR + "[dampers.d]\nbetween = ['O2', 'B']\ncoefficient = '200 N s/m'\n", True),
    (FOUR_BAR + "[dampers.d]\nbetween = ['O2', 'B']\ncoefficient = 200\n", False),
    (FOUR_BAR + "[dampers.d]\nbetween = ['O2', 'B']\ncoefficient = '200'\n", False),
    (LONG + GEARED % 1, True),
    (LONG + GEARED % 0, False),
    (f"[ground]\n{'O' * 32} = [0, 0]\n" + FOUR_BAR, True),
    (f"[ground]\n{'O' * 33} = [0, 0]\n" + FOUR_BAR, False),
]


@pytest.mark.parametrize(("text", "good"), FORMS)
def test_the_schema_and_the_reader_agree_on_forms(text: str, good: bool) -> None:
    document = parse(text, "my.toml")
    with contextlib.nullcontext() if good else pytest.raises(BadInput):
        scene_from(document, name="my", where="my.toml")
    assert fits(document) is good


# (what stands before a key that nothing knows; the schema's table that holds it)
TABLES: dict[str, tuple[str, Any]] = {
    "the file": ("", SCHEMA),
    "drive": ("[drive]\n", SCHEMA["properties"]["drive"]),
    "cylinder": ("[drive.cylinder]\n", SCHEMA["properties"]["drive"]["properties"]["cylinder"]),
    "spring": ("[springs.s]\n", SCHEMA["properties"]["springs"]["additionalProperties"]),
    "damper": ("[dampers.d]\n", SCHEMA["properties"]["dampers"]["additionalProperties"]),
    "trace": ("[trace]\n", SCHEMA["properties"]["trace"]),
    "bar": ("[bodies.b]\n", SCHEMA["properties"]["bodies"]["additionalProperties"]["anyOf"][1]),
    "slider": (
        "[bodies.b]\nslider = 'B'\n",
        SCHEMA["properties"]["bodies"]["additionalProperties"]["anyOf"][0],
    ),
    **{
        f"joint {form.mark}": (f"[joints.J]\n{form.mark} = ''\n", schema_of(form))
        for form in JOINTS.forms
        if form.mark != "line"
    },
}


@pytest.mark.parametrize(("text", "table"), TABLES.values(), ids=TABLES)
def test_the_schema_knows_the_keys_that_the_reader_knows(text: str, table: Any) -> None:
    document = tomllib.loads(FOUR_BAR + text)
    inside = document
    for key in filter(None, text.partition("\n")[0].strip("[]").split(".")):
        inside = inside[key]
    inside["nobody"] = 1
    with pytest.raises(BadInput, match="nobody") as refusal:
        scene_from(document, name="my", where="my.toml")
    known = str(refusal.value).split("known here: ")[1].split(", ")
    assert set(known) == set(table["properties"])


@pytest.mark.parametrize("name", SHORTHANDS)
def test_the_schema_knows_the_keys_of_a_shorthand(name: str) -> None:
    with pytest.raises(BadInput, match="nobody") as refusal:
        scene_from({name: {"nobody": 1}}, name="my", where="my.toml")
    assert set(str(refusal.value).split("known here: ")[1].split(", ")) == set(
        SCHEMA["properties"][name]["properties"]
    )


def test_joints_on_a_pin_that_is_missing_describe_a_linkage_all_the_same() -> None:
    text = "".join(f"[joints.{name}]\ncrank = 'O2'\nlength = 30\n" for name in "ABC")
    found = problems(text, name="my", where="my.toml")
    assert [problem.line for problem in found] == [2, 5, 8]
    assert all("no joint is called" in problem.message for problem in found)
