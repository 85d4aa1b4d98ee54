"""Frozen values that are quick to state: a frozen data class, and a named tuple.

`dataclass(frozen=True)` writes and compiles six methods for each class while its module is imported: a
millisecond a class. Here all classes share their methods, and the fields are Python's own: `field`, `fields`,
`replace`, `astuple` are those of `dataclasses`.
"""

from __future__ import annotations

import collections
from collections.abc import Callable, Iterable, Mapping
from dataclasses import MISSING, FrozenInstanceError, dataclass, field, fields
from functools import cache
from inspect import Parameter, Signature
from operator import attrgetter, itemgetter
from reprlib import recursive_repr
from types import CodeType, FunctionType
from typing import TYPE_CHECKING, Any, NoReturn, TypeVar, dataclass_transform, overload

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
    values = {**usual, **dict(zip(placed, given, strict=False)), **named}
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

if TYPE_CHECKING:
    from typing import NamedTuple as NamedTuple
else:

    class _NamedTupleType(type):
        """Make a class that states its fields a tuple with names."""

        def __new__(mcs, name: str, bases: tuple[type, ...], stated: dict[str, Any]) -> type:
            if not bases:
                return super().__new__(mcs, name, bases, stated)
            names = tuple(stated.get("__annotations__", ()))
            given = {
                "__slots__": (),
                "__new__": _LateMaker(),
                "__match_args__": names,
                "_fields": names,
                "_field_defaults": {one: stated[one] for one in names if one in stated},
            }
            for place, one in enumerate(names):
                given[one] = _field_at(place, one)
            return type(name, (tuple,), {**_OF_TUPLES, **stated, **given})

    class NamedTuple(metaclass=_NamedTupleType):
        """A tuple whose places have the names of the annotated attributes, as of `typing.NamedTuple`."""


def _function(text: str, names: Mapping[str, str], known: dict[str, Any]) -> FunctionType:
    """Return the function that a text defines, its arguments, and texts in it equal to them, renamed.

    Functions of one form are compiled once: renaming takes a twentieth of the time.
    """
    code = _code(text)

    def renamed(words: tuple[Any, ...]) -> tuple[Any, ...]:
        return tuple(names.get(word, word) if isinstance(word, str) else word for word in words)

    code = code.replace(co_varnames=renamed(code.co_varnames), co_consts=renamed(code.co_consts))
    return FunctionType(code, known)


@cache
def _code(text: str) -> CodeType:
    found: dict[str, Any] = {}
    exec(text, found)
    (code,) = (one.__code__ for one in found.values() if isinstance(one, FunctionType))
    return code


class _LateMaker:
    """A stand-in for the `__new__` of a named tuple, which makes that when it is first asked for."""

    def __set_name__(self, owner: Any, name: str) -> None:
        self._owner = owner

    def __get__(self, value: object, kind: type | None = None) -> Callable[..., Any]:
        owner = self._owner
        if vars(owner)["__new__"] is self:
            names = {f"_{n}": one for n, one in enumerate(owner._fields)}
            listed = "".join(f"{one}, " for one in names)
            text = f"def __new__(_cls, {listed}): return _new(_cls, ({listed}))"
            made = _function(text, names, {"_new": tuple.__new__})
            made.__defaults__ = tuple(owner._field_defaults.values())
            made.__module__, made.__qualname__ = owner.__module__, f"{owner.__qualname__}.__new__"
            made.__annotations__ = {**owner.__annotations__}
            owner.__new__ = staticmethod(made)
        return owner.__new__  # type: ignore[no-any-return]


def _tuple_of(cls: Any, values: Iterable[object]) -> Any:
    made = tuple.__new__(cls, values)
    if len(made) != len(cls._fields):
        raise TypeError(f"Expected {len(cls._fields)} arguments, got {len(made)}")
    return made


def _bare(self: tuple[object, ...]) -> tuple[object, ...]:
    return tuple(self)


def _replaced(self: Any, /, **changes: object) -> Any:
    made = self._make(map(changes.pop, self._fields, self))
    if changes:
        raise ValueError(f"Got unexpected field names: {list(changes)!r}")
    return made


def _shown(self: Any) -> str:
    fields_shown = ", ".join(f"{name}={value!r}" for name, value in zip(self._fields, self, strict=True))
    return f"{self.__class__.__name__}({fields_shown})"


_OF_TUPLES: dict[str, object] = {
    "__repr__": _shown,
    "__getnewargs__": _bare,
    "__replace__": _replaced,
    "_make": classmethod(_tuple_of),
    "_replace": _replaced,
    "_asdict": lambda self: dict(zip(self._fields, self, strict=True)),
}
"""What all named tuples have in common, beside what a tuple has."""
_field_at: Callable[[int, str], object] = getattr(
    collections, "_tuplegetter", lambda place, _: property(itemgetter(place))
)
"""Makes a reader of one place of a tuple: the one of Python's own named tuples, where it can be imported."""


class _Field(NamedTuple):
    """A field of a frozen class: its name and type, its default or what makes one, and how it is used."""

    name: str
    type: object
    default: object
    factory: object
    compare: bool
    kw_only: bool
