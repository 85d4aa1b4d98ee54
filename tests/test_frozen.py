"""A frozen class behaves as a frozen data class of Python's own: both are made of one statement."""

from __future__ import annotations

import copy
import inspect
import pickle
from collections.abc import Callable
from dataclasses import FrozenInstanceError, asdict, astuple, dataclass, field, fields, replace
from functools import cached_property
from typing import Any, ClassVar

import pytest

from linkanim.frozen import frozen


class Base:
    """What a class states, apart from how it is made."""

    limit: ClassVar[int] = 3


def stated(make: Callable[..., Any]) -> dict[str, Any]:
    """Return one class of each form that is used, made by a decorator."""

    @make
    class Plain(Base):
        a: int
        b: float = 2.5
        c: list[int] = field(default_factory=list)
        seen: str = field(default="", compare=False, repr=False)

        @cached_property
        def twice(self) -> int:
            return 2 * self.a

    @make
    class Child(Plain):
        d: str = "d"

        def __post_init__(self) -> None:
            if self.d == "refused":
                raise ValueError(self.d)

    @make
    class Single:
        a: object

    @make
    class Bare:
        pass

    @make(kw_only=True)
    class Named:
        a: int
        b: int = 1

    @make(eq=False)
    class Itself:
        a: int

    @make
    class Own:  # noqa: PLW1641 -- the hash is what is tested
        a: int

        def __eq__(self, other: object) -> bool:
            return True

        def __repr__(self) -> str:
            return "own"

    return {one.__name__: one for one in (Plain, Child, Single, Bare, Named, Itself, Own)}


def standard(*given: Any, **options: Any) -> Any:
    return dataclass(*given, frozen=True, **options) if options else dataclass(frozen=True)(*given)


OURS, THEIRS = stated(frozen), stated(standard)

CALLS = [
    pytest.param(lambda k: repr(k["Plain"](1)).rpartition(".")[2], id="repr"),
    pytest.param(lambda k: repr(k["Child"](1, d="x")).rpartition(".")[2], id="repr of a child"),
    pytest.param(lambda k: repr(k["Bare"]()).rpartition(".")[2], id="repr without a field"),
    pytest.param(lambda k: repr(k["Own"](1)), id="a method of its own"),
    pytest.param(lambda k: k["Plain"](1) == k["Plain"](1, seen="x"), id="a field that is not compared"),
    pytest.param(lambda k: k["Plain"](1) == k["Plain"](2), id="unequal"),
    pytest.param(lambda k: k["Plain"](1) == k["Child"](1), id="a child is no equal"),
    pytest.param(lambda k: k["Plain"](1).__eq__(1), id="another kind of thing"),
    pytest.param(lambda k: k["Single"](1) == k["Single"](1), id="one field"),
    pytest.param(lambda k: k["Bare"]() == k["Bare"](), id="no field"),
    pytest.param(lambda k: k["Own"](1) == k["Own"](2), id="an equality of its own"),
    pytest.param(lambda k: hash(k["Own"](1)), id="a hash beside an equality of its own"),
    pytest.param(lambda k: k["Itself"](1) == k["Itself"](1), id="equal to itself only"),
    pytest.param(lambda k: hash(k["Single"](1)), id="hash"),
    pytest.param(lambda k: hash(k["Bare"]()), id="hash without a field"),
    pytest.param(lambda k: hash(k["Named"](a=1)), id="hash of two fields"),
    pytest.param(lambda k: hash(k["Plain"](1)), id="hash of a list"),
    pytest.param(lambda k: k["Plain"](1).c is k["Plain"](1).c, id="a default made anew"),
    pytest.param(lambda k: k["Plain"](), id="a field is missing"),
    pytest.param(lambda k: k["Plain"](1, e=2), id="an unknown field"),
    pytest.param(lambda k: k["Named"](1), id="by name only"),
    pytest.param(lambda k: k["Child"](1, d="refused"), id="refused when made"),
    pytest.param(lambda k: astuple(replace(k["Child"](1), b=3.0)), id="replace"),
    pytest.param(lambda k: replace(k["Plain"](1), e=3), id="replace what is not there"),
    pytest.param(lambda k: asdict(k["Child"](1)), id="asdict"),
    pytest.param(lambda k: [one.name for one in fields(k["Child"])], id="fields"),
    pytest.param(lambda k: k["Child"].__match_args__, id="match"),
    pytest.param(lambda k: k["Plain"](3).twice, id="a cached property"),
    pytest.param(lambda k: [*map(str, inspect.signature(k["Single"]).parameters.values())], id="signature"),
    pytest.param(lambda k: str(inspect.signature(k["Named"])), id="signature by name"),
    pytest.param(lambda k: astuple(copy.deepcopy(k["Plain"](1, c=[1]))), id="a deep copy"),
    pytest.param(lambda k: setattr(k["Plain"](1), "a", 2), id="set"),
    pytest.param(lambda k: setattr(k["Plain"](1), "other", 2), id="set what is no field"),
    pytest.param(lambda k: delattr(k["Plain"](1), "a"), id="delete"),
]


def told(work: Callable[[dict[str, Any]], object], kinds: dict[str, Any]) -> object:
    """Return what comes of it, or the kind of error."""
    try:
        return work(kinds)
    except (TypeError, ValueError, AttributeError) as error:
        return type(error)


@pytest.mark.parametrize("work", CALLS)
def test_it_is_as_pythons_own(work: Callable[[dict[str, Any]], object]) -> None:
    assert told(work, OURS) == told(work, THEIRS)


@frozen
class Kept:
    """A value that goes through a pickle."""

    a: int
    inner: object = None


def test_it_goes_through_a_pickle() -> None:
    value = Kept(1, Kept(2))
    assert pickle.loads(pickle.dumps(value)) == value


def test_what_contains_itself_can_be_shown() -> None:
    around: list[object] = []
    value = Kept(1, around)
    around.append(value)
    assert repr(value) == "Kept(a=1, inner=[...])"


def test_a_field_is_not_hidden_by_a_property_of_a_base() -> None:
    class Measured:
        @property
        def size(self) -> int:
            return 1

    with pytest.raises(TypeError, match=r"Box\.size: a base has a property of this name"):

        @frozen
        class Box(Measured):
            size: int


def test_a_class_may_have_helpers_of_any_name() -> None:
    @frozen
    class Report:
        value: int

        def _stated(self) -> int:
            return self.value

        def _compared(self) -> int:
            return self.value

    assert Report(3) == Report(3) != Report(4)
    assert (Report(3)._stated(), Report(4)._compared()) == (3, 4)


def test_an_assignment_is_refused() -> None:
    with pytest.raises(FrozenInstanceError, match="cannot assign to field 'a'"):
        Kept(1).a = 2  # type: ignore[misc]
