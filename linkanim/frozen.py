"""A frozen data class that is quick to make: what `dataclass(frozen=True)` gives, in a tenth of its time.

`dataclass(frozen=True)` writes and compiles six methods for each class while its module is imported. That
takes half a millisecond a class, and the window imports over a hundred of them before its first frame. Here
five of the six are shared by all classes, and `__init__` is written when it is first asked for: many classes
of an import never have a value. The rest is Python's own: `field`, `fields`, `replace`, `astuple`, `asdict`.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import MISSING, FrozenInstanceError, dataclass, field, fields
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
        stated: Any = dataclass(init=False, repr=False, eq=False, kw_only=kw_only)(cls)
        methods: dict[str, object] = {
            "__init__": _Constructor(cls),
            "__repr__": _repr,
            "__setattr__": _refuse_to_set,
            "__delattr__": _refuse_to_delete,
        }
        if eq:
            compared = property(_reader(tuple(one.name for one in fields(stated) if one.compare)))
            methods |= {"_compared": compared, "__eq__": _equal, "__hash__": _hash}
        for one in fields(stated):
            if isinstance(getattr(cls, one.name, None), property):
                raise TypeError(f"{cls.__name__}.{one.name}: a base has a property of this name")
        for name in methods.keys() - own:
            setattr(cls, name, methods[name])
        return cls

    return made if cls is None else made(cls)


class _Constructor:
    """Stand where a class has its `__init__`, and put it there when it is first asked for."""

    def __init__(self, owner: type) -> None:
        self._owner = owner

    def __get__(self, value: object, kind: type | None = None) -> Callable[..., None]:
        init = _written_init(self._owner)
        self._owner.__init__ = init  # type: ignore[misc]
        return init.__get__(value, kind)  # type: ignore[no-any-return]


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


def _reader(names: tuple[str, ...]) -> Callable[[Any], tuple[object, ...]]:
    """Return what reads these attributes of a value as a tuple."""
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
