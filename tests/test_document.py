"""A document's readers take what they say they take, and refuse the rest with its key."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import pytest

from linkanim.errors import BadInput
from linkanim.intake import Section, few, meant

Read = Callable[[Section], Any]


def read(value: Any, how: Read) -> Any:
    return how(Section("file.toml", {"key": value}, ("table",)))


def number(section: Section) -> Any:
    return section.number("key")


def whole(section: Section) -> Any:
    return section.whole("key", 2, 4)


def text(section: Section) -> Any:
    return section.text("key")


def texts(section: Section) -> Any:
    return section.texts("key")


def flag(section: Section) -> Any:
    return section.flag("key")


def table(section: Section) -> Any:
    return section.table("key").values


def pair(section: Section) -> Any:
    return section.items("key", 2)


def choice(section: Section) -> Any:
    return section.choice("key", ("left", "right"))


# True is an int in Python, and no number in a document.
@pytest.mark.parametrize(
    ("how", "value"),
    [
        *((number, value) for value in (1, -2.5, 0)),
        *((whole, value) for value in (2, 4)),
        (text, "some"),
        *((texts, value) for value in ([], ["one"], ["one", "another"])),
        *((flag, value) for value in (True, False)),
        (table, {}),
        (table, {"a": 1}),
        (pair, [1, "two"]),
        *((choice, value) for value in ("left", "right")),
    ],
)
def test_a_value_of_its_kind_is_returned(how: Read, value: Any) -> None:
    found = read(value, how)
    assert (list(found) if isinstance(found, tuple) else found) == value
    assert isinstance(found, bool) == isinstance(value, bool)


@pytest.mark.parametrize(
    ("how", "value"),
    [
        *((number, value) for value in (True, "1", [1], math.nan, math.inf, 10**400)),
        *((whole, value) for value in (True, 1, 5, 3.0, "3")),
        *((text, value) for value in (1, ["some"])),
        *((texts, value) for value in ("one", ["one", 2], {"one": 1})),
        *((flag, value) for value in (1, "true")),
        (table, 1),
        (table, "a"),
        (table, [{}]),
        *((pair, value) for value in ([1], [1, 2, 3], (1, 2), "ab")),
        *((choice, value) for value in ("up", 1, ["left"])),
    ],
)
def test_another_value_is_refused_with_its_file_and_key(how: Read, value: Any) -> None:
    with pytest.raises(BadInput, match=r"^file\.toml: table\.key( = .*)?: must be ") as refused:
        read(value, how)
    assert refused.value.keys == ("table", "key")


@pytest.mark.parametrize("how", [number, whole, text, flag, pair])
def test_what_is_needed_and_missing_is_said(how: Read) -> None:
    with pytest.raises(BadInput, match=r'^file\.toml: table: "key" is missing$'):
        how(Section("file.toml", {}, ("table",)))


@pytest.mark.parametrize(("how", "usual"), [(texts, ()), (table, {}), (choice, "left")])
def test_what_may_be_missing_has_a_usual_value(how: Read, usual: Any) -> None:
    assert how(Section("file.toml", {})) == usual
    assert Section("file.toml", {}).text("key", "usual") == "usual"


def test_a_list_s_items_have_keys_of_their_own() -> None:
    listed = Section("file.toml", {"at": [1, "x"]}, ("joints",)).listed("at", 2)
    assert listed.number("at[0]") == 1
    with pytest.raises(BadInput, match=r'^file\.toml: joints\.at\[1\] = "x": must be a finite number$'):
        listed.number("at[1]")


def test_names_are_listed_by_the_dozen() -> None:
    names = [str(k) for k in range(14)]
    assert few(names[:12]) == "0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11"
    assert few(names).endswith(", 11 and 2 more")
    assert meant("crnk", ("crank", "slot")) == ' (did you mean "crank"?)'
    assert meant("zzz", ("crank", "slot")) == ""
