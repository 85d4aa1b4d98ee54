"""Frozen values that are quick to make: a frozen data class, and a named tuple.

`dataclass(frozen=True)` writes and compiles six methods for each class while its module is imported, and
`typing.NamedTuple` compiles one and looks at every annotation. That is a third and a tenth of a millisecond
a class, and the window imports some three hundred of them before its first frame. Here the methods are
shared by all classes, and whatever a class needs of its own is worked out when it is first asked for: many
classes of an import never have a value. The rest is Python's own: `field`, `fields`, `replace`, `astuple`.
"""

from __future__ import annotations

import collections
from collections.abc import Callable, Iterable
from dataclasses import MISSING, Field, FrozenInstanceError, dataclass, field, fields
from operator import attrgetter
from reprlib import recursive_repr
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
        statement = _Statement(cls, kw_only=kw_only)
        methods: dict[str, object] = {
            "__init__": _Late(cls, "__init__", lambda: _written_init(cls)),
            "__repr__": _repr,
            "__setattr__": _refuse_to_set,
            "__delattr__": _refuse_to_delete,
            "__match_args__": _Late(cls, "__match_args__", lambda: statement.read("__match_args__")),
        }
        if eq:
            compared = _Late(cls, "_compared", lambda: property(_reader(cls)))
            methods |= {"_compared": compared, "__eq__": _equal, "__hash__": _hash}
        for name in methods.keys() - own:
            setattr(cls, name, methods[name])
        setattr(cls, _FIELDS, _Late(cls, _FIELDS, lambda: statement.read(_FIELDS)))
        return cls

    return made if cls is None else made(cls)


_FIELDS = "__dataclass_fields__"
"""Where Python looks for the fields of a data class."""


class _Late:
    """Stand where a class has an attribute, and put it there when it is first asked for."""

    def __init__(self, owner: type, name: str, make: Callable[[], object]) -> None:
        self._owner, self._name, self._make = owner, name, make

    def __get__(self, value: object, kind: type | None = None) -> Any:
        if vars(self._owner).get(self._name) is self:
            setattr(self._owner, self._name, self._make())
        return getattr(self._owner if value is None else value, self._name)


class _Statement:
    """What a class states of its fields, until Python's own `dataclass` reads it."""

    def __init__(self, cls: type, *, kw_only: bool) -> None:
        self._cls, self._kw_only = cls, kw_only
        self._stated = {name: one for name, one in vars(cls).items() if isinstance(one, Field)}
        for name, one in self._stated.items():
            if one.default is MISSING:
                delattr(cls, name)
            else:
                setattr(cls, name, one.default)

    def read(self, wanted: str) -> object:
        """Have the class read, and return this attribute, which it has by that."""
        for name, one in self._stated.items():
            setattr(self._cls, name, one)
        if isinstance(vars(self._cls)["__match_args__"], _Late):
            delattr(self._cls, "__match_args__")  # what is there would be kept
        dataclass(init=False, repr=False, eq=False, kw_only=self._kw_only)(self._cls)
        return vars(self._cls)[wanted]


def _written_init(cls: type) -> Callable[..., None]:
    """Return the `__init__` of a class, as `dataclass(frozen=True)` writes it."""
    names: dict[str, Any] = {"_set": object.__setattr__, "_missing": MISSING}
    placed, named, lines = ["self"], ["*"], []
    for one in fields(cls):
        name, value, default = one.name, one.name, ""
        if one.default is not MISSING:
            default = f"=_default_{name}"
            names[f"_default_{name}"] = one.default
        elif one.default_factory is not MISSING:
            default, value = "=_missing", f"_make_{name}() if {name} is _missing else {name}"
            names[f"_make_{name}"] = one.default_factory
        (named if one.kw_only else placed).append(name + default)
        lines.append(f"_set(self, {name!r}, {value})")
    if hasattr(cls, "__post_init__"):
        lines.append("self.__post_init__()")
    arguments = ", ".join(placed + (named if len(named) > 1 else []))
    exec(f"def __init__({arguments}):\n " + "\n ".join(lines or ["pass"]), names)
    init = names["__init__"]
    init.__qualname__ = f"{cls.__qualname__}.__init__"
    init.__module__ = cls.__module__
    init.__annotations__ = {**{one.name: one.type for one in fields(cls)}, "return": None}
    return init  # type: ignore[no-any-return]


def _reader(cls: type) -> Callable[[Any], tuple[object, ...]]:
    """Return what reads the fields of a value that are compared, as a tuple."""
    names = tuple(one.name for one in fields(cls) if one.compare)
    if len(names) > 1:
        return attrgetter(*names)  # one alone it returns bare
    return lambda value: tuple(getattr(value, name) for name in names)


def _equal(self: Any, other: Any) -> bool:
    if other.__class__ is not self.__class__:
        return NotImplemented  # type: ignore[no-any-return]
    equal: bool = self._compared == other._compared
    return equal


def _hash(self: Any) -> int:
    return hash(self._compared)


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
    """Stand where a named tuple has its `__new__`, and put it there when it is first asked for."""

    def __set_name__(self, owner: Any, name: str) -> None:
        self._owner = owner

    def __get__(self, value: object, kind: type | None = None) -> Callable[..., Any]:
        owner = self._owner
        if vars(owner)["__new__"] is self:
            names: dict[str, Any] = {"_new": tuple.__new__}
            listed = "".join(f"{one}, " for one in owner._fields)
            exec(f"def __new__(_cls, {listed}): return _new(_cls, ({listed}))", names)
            made = names["__new__"]
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
_field_at: Callable[[int, str], object] = collections._tuplegetter  # type: ignore[attr-defined]
"""Reads one place of a tuple by its name; Python's own named tuples have no other, and none is as quick."""
