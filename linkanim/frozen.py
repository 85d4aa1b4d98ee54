"""Frozen values that are quick to make: a frozen data class, and a named tuple.

`dataclass(frozen=True)` writes and compiles six methods for each class while its module is imported, and
`typing.NamedTuple` compiles one and looks at every annotation. That is a third and a tenth of a millisecond
a class, and the window imports some three hundred of them before its first frame. Here the methods are
shared by all classes, and whatever a class needs of its own is worked out when it is first asked for: many
classes of an import never have a value. The rest is Python's own: `field`, `fields`, `replace`, `astuple`.
"""

from __future__ import annotations

import collections
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import MISSING, Field, FrozenInstanceError, dataclass, field, fields
from functools import cache
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
        cls.__frozen_statement__ = _Statement(cls, kw_only=kw_only)  # type: ignore[attr-defined]
        methods: dict[str, object] = {
            "__init__": _Late(cls, "__init__", _written_init),
            "__repr__": _repr,
            "__setattr__": _refuse_to_set,
            "__delattr__": _refuse_to_delete,
            "__match_args__": _Late(cls, "__match_args__", _placed),
        }
        if eq:
            compared = _Late(cls, "__frozen_compared__", lambda cls: property(_reader(cls)))
            methods |= {"__frozen_compared__": compared, "__eq__": _equal, "__hash__": _hash}
        for name in methods.keys() - own:
            setattr(cls, name, methods[name])
        setattr(cls, _FIELDS, _Late(cls, _FIELDS, _standard_fields))
        return cls

    return made if cls is None else made(cls)


_FIELDS = "__dataclass_fields__"
"""Where Python looks for the fields of a data class."""


class _Late:
    """A stand-in for an attribute of a class, which makes the attribute when it is first asked for."""

    def __init__(self, owner: type, name: str, make: Callable[[Any], object]) -> None:
        self._owner, self._name, self._make = owner, name, make

    def __get__(self, value: object, kind: type | None = None) -> Any:
        if vars(self._owner).get(self._name) is self:
            setattr(self._owner, self._name, self._make(self._owner))
        return getattr(self._owner if value is None else value, self._name)


class _Statement:
    """The fields that a class itself states, without those of its bases."""

    def __init__(self, cls: type, *, kw_only: bool) -> None:
        self.kw_only = kw_only
        self._types = {
            name: kind
            for name, kind in vars(cls).get("__annotations__", {}).items()
            if not str(kind).startswith(("ClassVar", "typing.ClassVar"))
        }
        self.special = {name: one for name, one in vars(cls).items() if isinstance(one, Field)}
        for name, one in self.special.items():
            if one.default is MISSING:
                delattr(cls, name)
            else:
                setattr(cls, name, one.default)
        self._defaults = {name: getattr(cls, name, MISSING) for name in self._types}

    def fields(self) -> Iterator[_Field]:
        """Iterate the fields in their order."""
        for name, kind in self._types.items():
            factory: object = MISSING
            compare, kw_only = True, self.kw_only
            if (special := self.special.get(name)) is not None:
                factory, compare = special.default_factory, special.compare
                kw_only = kw_only if special.kw_only is MISSING else special.kw_only
            yield _Field(name, kind, self._defaults[name], factory, compare, kw_only)


def _fields(cls: type) -> list[_Field]:
    """Return the fields of a class, those of its bases first."""
    found: dict[str, _Field] = {}
    for kind in reversed(cls.__mro__):
        if "__frozen_statement__" in vars(kind):
            found.update((one.name, one) for one in vars(kind)["__frozen_statement__"].fields())
    return list(found.values())


def _standard_fields(cls: Any) -> object:
    """Return the fields as Python's own functions look for them, such as `replace`."""
    for name, one in cls.__frozen_statement__.special.items():
        setattr(cls, name, one)
    dataclass(init=False, repr=False, eq=False, kw_only=cls.__frozen_statement__.kw_only)(cls)
    return vars(cls)[_FIELDS]


def _placed(cls: type) -> tuple[str, ...]:
    return tuple(one.name for one in _fields(cls) if not one.kw_only)


def _written_init(cls: type) -> Callable[..., None]:
    """Return the `__init__` of a class, as `dataclass(frozen=True)` writes it."""
    stated = sorted(_fields(cls), key=lambda one: one.kw_only)
    made_by = {f"_make{n}": one.factory for n, one in enumerate(stated) if one.factory is not MISSING}
    placed = [f"_{n}" for n, one in enumerate(stated) if not one.kw_only]
    named = [f"_{n}" for n in range(len(placed), len(stated))]
    lines = (
        f"_set(self, '_{n}', "
        + (f"_make{n}() if _{n} is _missing else _{n})" if f"_make{n}" in made_by else f"_{n})")
        for n in range(len(stated))
    )
    last = "self.__post_init__()" if hasattr(cls, "__post_init__") else ""
    arguments = ", ".join(["self", *placed, *(["*", *named] if named else [])])
    body = "\n ".join([*lines, last or "pass"])
    init = _function(
        f"def __init__({arguments}):\n {body}",
        {f"_{n}": one.name for n, one in enumerate(stated)},
        {"_set": object.__setattr__, "_missing": MISSING, **made_by},
    )
    defaults = {
        one.name: MISSING if one.factory is not MISSING else one.default
        for one in stated
        if one.default is not MISSING or one.factory is not MISSING
    }
    init.__defaults__ = tuple(
        defaults[one.name] for one in stated if not one.kw_only and one.name in defaults
    )
    init.__kwdefaults__ = {
        one.name: defaults[one.name] for one in stated if one.kw_only and one.name in defaults
    }
    init.__qualname__, init.__module__ = f"{cls.__qualname__}.__init__", cls.__module__
    init.__annotations__ = {**{one.name: one.type for one in stated}, "return": None}
    return init


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


def _reader(cls: type) -> Callable[[Any], tuple[object, ...]]:
    """Return a function that gives the compared fields of a value as a tuple."""
    names = tuple(one.name for one in _fields(cls) if one.compare)
    if len(names) > 1:
        return attrgetter(*names)  # for one name it returns no tuple
    return lambda value: tuple(getattr(value, name) for name in names)


def _equal(self: Any, other: Any) -> bool:
    if other.__class__ is not self.__class__:
        return NotImplemented  # type: ignore[no-any-return]
    equal: bool = self.__frozen_compared__ == other.__frozen_compared__
    return equal


def _hash(self: Any) -> int:
    return hash(self.__frozen_compared__)


@recursive_repr()
def _repr(self: Any) -> str:
    shown = (f"{one.name}={getattr(self, one.name)!r}" for one in fields(self) if one.repr)
    return f"{self.__class__.__qualname__}({', '.join(shown)})"


def _refuse_to_set(self: object, name: str, value: object) -> NoReturn:
    raise FrozenInstanceError(f"cannot assign to field {name!r}")


def _refuse_to_delete(self: object, name: str) -> NoReturn:
    raise FrozenInstanceError(f"cannot delete field {name!r}")


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
