"""Frozen data classes that are quick to state.

`dataclass(frozen=True)` writes and compiles six methods for each class while its module is imported: a
millisecond a class. Here all classes share their methods, and the fields are Python's own: `field`, `fields`,
`replace`, `astuple` are those of `dataclasses`.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import MISSING, FrozenInstanceError, dataclass, field, fields
from functools import cache
from inspect import Parameter, Signature
from operator import attrgetter
from reprlib import recursive_repr
from typing import Any, NoReturn, TypeVar, dataclass_transform, overload

Made = TypeVar("Made")


@overload
def frozen(cls: type[Made], /) -> type[Made]: ...
@overload
def frozen(*, eq: bool = True, kw_only: bool = False) -> Callable[[type[Made]], type[Made]]: ...
@dataclass_transform(frozen_default=True, field_specifiers=(field,))
def frozen(
    cls: type[Made] | None = None, /, *, eq: bool = True, kw_only: bool = False
) -> type[Made] | Callable[[type[Made]], type[Made]]:
    """Make a class a frozen data class: its annotated attributes are its fields, which cannot be assigned.

    Two values are equal where they are of one class and their fields are equal, and equal values have one
    hash; with eq=False a value equals itself only. A method that the class defines itself is kept. Every
    field is an argument of `__init__`: there is no `field(init=False)`. A field that has no default cannot
    have the name of a property of a base: TypeError.
    """

    def made(cls: type[Made]) -> type[Made]:
        own = {name for name, value in vars(cls).items() if value is not None}
        for kind in cls.__mro__:
            for name in vars(kind).get("__annotations__", ()):
                if isinstance(getattr(cls, name, None), property):
                    raise TypeError(f"{cls.__name__}.{name}: a base has a property of this name")
        dataclass(init=False, repr=False, eq=False, kw_only=kw_only)(cls)
        methods = {**_METHODS, **_EQUALITY} if eq else _METHODS
        for name in methods.keys() - own:
            setattr(cls, name, methods[name])
        return cls

    return made if cls is None else made(cls)


@cache
def _form(cls: Any) -> tuple[Any, ...]:
    """Return the fields given in order, the names of all, usual values, what makes others, what follows."""
    stated = fields(cls)
    usual = {one.name: one.default for one in stated if one.default is not MISSING}
    makers = {one.name: one.default_factory for one in stated if one.default_factory is not MISSING}
    names = frozenset(one.name for one in stated)
    return cls.__match_args__, names, usual, makers, getattr(cls, "__post_init__", None)


def _filled(self: Any, /, *given: object, **named: object) -> None:
    placed, names, usual, makers, follows = _form(self.__class__)
    values = dict(zip(placed, given, strict=False))
    if named or not len(given) == len(values) == len(names):
        values = {**usual, **values, **named}
        if len(values) < len(names):
            values |= {name: make() for name, make in makers.items() if name not in values}
        if len(values) != len(names) or len(given) > len(placed) or not names.issuperset(named):
            self.__signature__.bind(*given, **named)  # says what is wrong
    self.__dict__.update(values)
    if follows:
        follows(self)


class _Signature:
    """How the values of a class are made, as `inspect` tells it."""

    def __get__(self, value: object, kind: Any) -> Signature:
        return Signature(
            [
                Parameter(
                    one.name,
                    Parameter.POSITIONAL_OR_KEYWORD
                    if one.name in kind.__match_args__
                    else Parameter.KEYWORD_ONLY,
                    default=Parameter.empty if one.default is one.default_factory is MISSING else one.default,
                    annotation=one.type,
                )
                for one in sorted(fields(kind), key=lambda one: one.kw_only is True)
            ],
            return_annotation=None,
        )


@cache
def _compared(cls: Any) -> Callable[[Any], tuple[object, ...]]:
    """Return a function that gives the compared fields of a value as a tuple."""
    names = [one.name for one in fields(cls) if one.compare]
    if len(names) > 1:
        return attrgetter(*names)  # for one name it returns no tuple
    return lambda value: tuple(getattr(value, name) for name in names)


def _equal(self: Any, other: Any) -> bool:
    if other.__class__ is not self.__class__:
        return NotImplemented  # type: ignore[no-any-return]
    read = _compared(self.__class__)
    return read(self) == read(other)


def _hash(self: Any) -> int:
    return hash(_compared(self.__class__)(self))


@recursive_repr()
def _repr(self: Any) -> str:
    shown = (f"{one.name}={getattr(self, one.name)!r}" for one in fields(self) if one.repr)
    return f"{self.__class__.__qualname__}({', '.join(shown)})"


def _refuse_to_set(self: object, name: str, value: object) -> NoReturn:
    raise FrozenInstanceError(f"cannot assign to field {name!r}")


def _refuse_to_delete(self: object, name: str) -> NoReturn:
    raise FrozenInstanceError(f"cannot delete field {name!r}")


_METHODS: Mapping[str, Any] = {
    "__init__": _filled,
    "__signature__": _Signature(),
    "__repr__": _repr,
    "__setattr__": _refuse_to_set,
    "__delattr__": _refuse_to_delete,
}
_EQUALITY: Mapping[str, Any] = {"__eq__": _equal, "__hash__": _hash}
