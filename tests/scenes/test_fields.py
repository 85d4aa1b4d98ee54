"""The table of fields: every key is described, what can be edited is called something, and it is whole."""

from __future__ import annotations

import tomllib
from collections.abc import Iterator
from typing import Any

import pytest

from linkanim.mechanics.linkage import Joint
from linkanim.scenes import load, names
from linkanim.scenes.editing import dimensions
from linkanim.scenes.file_form import JOINTS, SCENE_FILE
from linkanim.scenes.form import Field, Form, Named
from linkanim.scenes.reading import read, scene_from
from linkanim.scenes.schema import SCHEMA


def fields(what: Form | Named) -> Iterator[Field]:
    """Yield every field of the file, however deep."""
    if isinstance(what, Named):
        for form in what.forms:
            yield from fields(form)
        yield from [what.plain] if what.plain else []
        return
    for one in what.fields:
        yield one
        if not one.plain:
            yield from fields(one.type)  # type: ignore[arg-type]


def test_every_key_is_described_and_every_number_is_called_something() -> None:
    for one in fields(SCENE_FILE):
        assert one.words or (one.plain and one.plain.schema is None), one.key
        assert one.label or not (one.plain and one.plain.measure), one.key


def test_every_kind_of_joint_but_a_brace_is_written_one_way() -> None:
    made = [form.make for form in JOINTS.forms]
    assert len(set(made)) == len(made)
    assert all(issubclass(kind, Joint) for kind in made if isinstance(kind, type))


def test_the_schema_says_what_each_key_is() -> None:
    crank = SCHEMA["properties"]["joints"]["additionalProperties"]["anyOf"][0]
    assert crank["properties"]["crank"]["description"] == "the fixed pin that it turns about"


@pytest.mark.parametrize("name", names())
def test_no_label_is_said_of_two_dimensions(name: str) -> None:
    labels = [item.label for item in dimensions(load(name))]
    assert len(set(labels)) == len(labels)
    assert not any("{" in label for label in labels)


GOOD: dict[str, Any] = {
    "ground": {"O2": [0, 0], "O4": [100, 0]},
    "joints": {
        "A": {"crank": "O2", "length": 30},
        "B": {"from": ["A", "O4"], "length": [90, 80]},
    },
}
# What is wrong, and the keys of all that is: what only follows from it is not among them.
FAULTS: dict[str, tuple[str, list[str]]] = {
    "an unknown key does not hide lengths that do not meet": (
        "stray = 1\n[four-bar]\nground = 1000\ncrank = 30\ncoupler = 90\nrocker = 80\n",
        ["stray", "four-bar"],
    ),
    "a shorthand with a fault has its joints all the same": (
        "[four-bar]\nground = 100\ncrank = -30\ncoupler = 90\nrocker = 'x'\n[trace]\njoints = ['B', 'Q']\n"
        "[bodies]\narm = { joints = ['A', 'O4'] }\n",
        ["four-bar.crank", "four-bar.rocker", "trace.joints"],
    ),
    "two joints with faults, and one that hangs on both": (
        "[ground]\nO2 = [0, 0]\nO4 = [100]\n[joints.A]\ncrank = 'O2'\n[joints.B]\nfrom = ['A', 'O4']\n"
        "length = [90, 80]\n[joints.P]\non = ['A', 'B']\nat = [0, 0]\n",
        ["ground.O4", "joints.A.length", "joints.P.at"],
    ),
    "a shorthand that is no table has its joints all the same": (
        "four-bar = 3\n[joints.Q]\non = ['O4', 'B']\nat = [1, 2]\n[trace]\njoints = ['P', 'Q']\n",
        ["four-bar"],
    ),
    "a drive and a spring, each in two ways": (
        "[four-bar]\nground = 100\ncrank = 30\ncoupler = 90\nrocker = 80\n"
        "[drive]\nspeed = '0 rpm'\nstart = 3\n[springs.s]\nbetween = ['A', 'A']\nstiffness = 3\n",
        ["drive.speed", "drive.start", "springs.s.between", "springs.s.stiffness"],
    ),
    "a circle, and a joint beside it": (
        "[ground]\nO = [0, 0]\n[joints.A]\ncrank = 'O'\nlength = 3\n[joints.B]\non = ['A', 'C']\n"
        "at = [1, 0]\n[joints.C]\non = ['A', 'B']\nat = [1, 0]\n[joints.D]\ncrank = 'A'\nlength = 2\n",
        ["joints.D.crank", "joints"],
    ),
}


@pytest.mark.parametrize(("text", "keys"), FAULTS.values(), ids=FAULTS)
def test_all_that_is_wrong_is_found_in_one_reading(text: str, keys: list[str]) -> None:
    _, problems = read(tomllib.loads(text), name="my", where="my.toml")
    assert [".".join(problem.keys) for problem in problems] == keys


def test_a_good_file_has_no_problem_and_is_read_as_it_was() -> None:
    scene, problems = read(GOOD, name="my", where="my.toml")
    assert problems == []
    assert scene == scene_from(GOOD, name="my", where="my.toml")


def test_a_key_of_no_letters_stands_for_nothing() -> None:
    document = {**GOOD, "joints": {**GOOD["joints"], "B": {"": 1, "from": ["A", "O4"]}}}
    _, problems = read(document, name="my", where="my.toml")
    assert [problem.keys for problem in problems] == [("joints", "B", ""), ("joints", "B", "length")]
