"""Fields, and the tables that they make up: what a table of a scene file may say, and what that becomes."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, Literal

from linkanim.scenes.fields.table import Table
from linkanim.scenes.fields.types import ValueType

Key = tuple[str | int, ...]
"""The way to a value in a scene's document."""

NEEDED = object()
"""What is usual of a key that must not be missing."""
SPREAD = ""
"""Where the values of a table go that are those of the table around it."""


@dataclass(frozen=True)
class Field:
    """One key of a table.

    `words` say what it is. `usual` stands where the key is missing, as the file would say it; None where
    nothing does. `into` is the argument that it becomes, its own key unless stated.

    A joint that it names `must` be fixed or a crank; where it must be "moving", one at least of all joints
    that the table names must be. With the key `unless` beside it, it may be missing, and may move.

    `label` is what a number is called in the list of dimensions, one for each item of a list; one in small
    letters follows the name of the table. By `drag` a number follows a joint: as its distance from another
    one, the direction from there, or its place on its body; of a shorthand `spans` are those two joints.
    """

    key: str
    type: ValueType | Form | Named
    words: str = ""
    usual: object = NEEDED
    into: str | None = None
    must: Literal["", "fixed", "crank", "moving"] = ""
    unless: str | None = None
    label: str | tuple[str, ...] = ""
    drag: Literal["", "distance", "direction", "place"] = ""
    spans: tuple[tuple[str, str], ...] = ()

    @property
    def plain(self) -> ValueType | None:
        """What stands there that is no table."""
        return self.type if isinstance(self.type, ValueType) else None

    def stated(self, table: Table) -> bool:
        """Tell whether there is anything to read: the key, what is usual, or that it is missing."""
        return self.key in table or (self.usual is not None and self.unless not in table.values)

    def read(self, table: Table) -> Any:
        """Return what stands at the key, or what is usual; None where that has a fault in it."""
        if self.key not in table:
            if self.usual is NEEDED:
                table.need(self.key)
            table = table.saying({self.key: self.usual})
        return self.type.read(table, self.key)


@dataclass(frozen=True)
class Form:
    """A table: its fields, and what makes a value of what they say.

    Of several forms that may stand in one place `mark` is the key that shows this one, where none of
    `without` stands beside it. `refuse` raises where values do not go together. `together` are keys, each
    with another that it needs beside it.
    """

    fields: tuple[Field, ...]
    make: Callable[..., Any] = dict
    words: str = ""
    mark: str = ""
    without: tuple[str, ...] = ()
    refuse: Callable[[Table, Mapping[str, Any]], None] = lambda table, values: None
    together: Mapping[str, str] = field(default_factory=dict)

    @cached_property
    def keys(self) -> Mapping[str, Field]:
        """The fields by their keys, which are those that are known."""
        return {one.key: one for one in self.fields}

    def field(self, key: str) -> Field:
        """Return the field of a key, which must be known."""
        return self.keys[key]

    def fits(self, values: Mapping[str, Any]) -> bool:
        """Tell whether a table is of this form, by the keys in it."""
        return (not self.mark or self.mark in values) and not any(key in values for key in self.without)

    def read(self, table: Table, key: str) -> Any:
        """Return what is made of the table at a key; None where anything in it has a fault."""
        return self.made(table.table(key))

    def made(self, table: Table, *given: object, known: Iterable[str] = ()) -> Any:
        """Return what is made of a table, and of what is `given` besides; None where it has a fault.

        `known` are the keys that are no slips, the form's own unless stated.
        """
        if not table.values.keys() <= self.keys.keys():
            table.refuse_unknown(known or self.keys)
        values: dict[str, Any] = {}
        sound = True
        for one in self.fields:
            if one.stated(table):
                value = table.attempt(one.read, table)
                sound = sound and value is not None
                values |= value if one.into == SPREAD and value else {one.into or one.key: value}
        return table.attempt(self._make, table, values, given) if sound else None

    def _make(self, table: Table, values: Mapping[str, Any], given: tuple[object, ...]) -> Any:
        self.refuse(table, values)
        return self.make(*given, **values)


def form(words: str, *fields: Field, **how: Any) -> Form:
    """Return the form of a table: what it is and its fields; `how` as in `Form`."""
    return Form(fields, words=words, **how)


@dataclass(frozen=True)
class Named:
    """A table of tables by their names, as [joints.A], [joints.B]: each of one of the `forms`.

    Where an entry may be a list instead of a table, `plain` is its field, and `make` makes a value of it.
    """

    forms: tuple[Form, ...]
    plain: Field | None = None
    make: Callable[..., Any] = dict

    @property
    def marks(self) -> tuple[str, ...]:
        """The keys that show which form an entry has."""
        return tuple(dict.fromkeys(form.mark for form in self.forms))

    def read(self, table: Table, key: str) -> dict[str, Any]:
        """Return what is made of each entry, by its name; None of those that have a fault."""
        group = table.table(key)
        return {name: group.attempt(self._entry, group, name) for name in group.entries()}

    def _entry(self, group: Table, name: str) -> Any:
        if self.plain and not isinstance(group.values[name], Mapping):
            place = self.plain.type.read(group, name)
            return place and self.make(name, place)
        table = group.table(name)
        form = self.form(table.values)
        akin = (one for one in self.forms if form is None or one.mark == form.mark)
        known = (key for one in akin for key in one.keys)
        if form:
            return form.made(table, name, known=known)
        table.refuse_unknown(known)
        raise table.wrong(f"says no way to find the joint; give it one of {', '.join(self.marks)}")

    def form(self, value: object) -> Form | None:
        """Return the form that an entry has; None where it has none of them."""
        if not isinstance(value, Mapping):
            return None
        return next((form for form in self.forms if form.fits(value)), None)


def fields_in(
    form: Form | None, values: Mapping[str, Any], path: Key = ()
) -> Iterator[tuple[Key, Field, Any]]:
    """Iterate the fields that a table states, and those of the tables in it, each with its table's values."""
    for one in form.fields if form else ():
        if one.key in values:
            yield from _fields_at(one, values, (*path, one.key))


def _fields_at(one: Field, values: Mapping[str, Any], path: Key) -> Iterator[tuple[Key, Field, Any]]:
    value = values[path[-1]]  # type: ignore[index]
    if isinstance(one.type, ValueType):
        yield path, one, values
    elif isinstance(one.type, Form):
        yield from fields_in(one.type, value, path)
    else:
        for name, entry in value.items():
            if form := one.type.form(entry):
                yield from fields_in(form, entry, (*path, name))
            elif one.type.plain:
                yield from _fields_at(one.type.plain, value, (*path, name))
