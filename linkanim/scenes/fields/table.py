"""A table of a scene file, and what is known while the file is read: its joints, and what is wrong so far."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any, ClassVar, Self, TypeVar

from linkanim.bounds import MOST_NAMES, MOST_PROBLEMS
from linkanim.document import Section, few, meant
from linkanim.errors import BadInput, SceneError
from linkanim.mechanics.linkage.joint import Joint, RigidBody
from linkanim.units import shown

Read = TypeVar("Read")


@dataclass(frozen=True)
class Context:
    """What is known of a file while it is read: its unit of length, its joints, and its problems so far.

    `names` are those of all joints that it states. `joints` are those without a fault, in solved order, and
    `rigid` the rigid bodies that they make; none before they are read.
    """

    unit: str = "mm"
    names: tuple[str, ...] = ()
    joints: Mapping[str, Joint] = field(default_factory=dict)
    rigid: tuple[RigidBody, ...] = ()
    problems: list[BadInput] = field(default_factory=list)

    @property
    def sound(self) -> bool:
        """Whether no joint has a fault."""
        return len(self.joints) == len(self.names)


@dataclass(frozen=True)
class Table(Section):
    """One table of a scene file."""

    refusal: ClassVar[type[BadInput]] = SceneError

    context: Context = field(default_factory=Context)

    def under(self, key: str, values: Mapping[str, Any]) -> Self:
        """Return a table that stands under a key."""
        return type(self)(self.where, values, (*self.keys, key), self.context)

    def attempt(self, work: Callable[..., Read], *given: object) -> Read | None:
        """Return what the work returns; None where it refuses, which is one more of the file's problems."""
        try:
            return work(*given)
        except BadInput as error:
            self.context.problems.append(error)
            return None

    def refuse_unknown(self, known: Iterable[str]) -> None:
        """Count every key that is not `known` among the problems, each with the nearest known one."""
        known = tuple(dict.fromkeys(known))
        for key in self.values:
            if key not in known and len(self.context.problems) < MOST_PROBLEMS:
                reason = f"unknown key{meant(key, known)}; known here: {', '.join(known)}"
                self.context.problems.append(self.error(key, reason))

    def saying(self, values: Mapping[str, Any]) -> Self:
        """Return the table as if it said something else."""
        return type(self)(self.where, values, self.keys, self.context)

    def entries(self) -> tuple[str, ...]:
        """Return the names that are this table's keys, each fit to be shown and to be part of a key."""
        if len(self.values) > MOST_NAMES:
            raise self.wrong(f"has {len(self.values):,} entries; {MOST_NAMES} are the most that are read")
        return tuple(name for name in self.values if self.attempt(self._entry, name))

    def _entry(self, name: str) -> str:
        if not 1 <= len(name) <= 32 or not name.isprintable() or "." in name or name != name.strip():
            raise self.error(name, "a name has 1 to 32 printable characters, no dot, no outer spaces")
        return name

    def joint(self, key: str, name: str) -> str:
        """Return a name that stands at a key if it is a joint's."""
        names = self.context.names
        if name not in names:
            raise self.error(
                key, f"no joint is called {shown(name)}{meant(name, names)}; there are {few(names)}"
            )
        return name
