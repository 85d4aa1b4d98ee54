"""A game's words: its kind, then its parameters, as `predict chapter=four-bars level=2 seed=7`."""

from __future__ import annotations

from shlex import quote, shlex
from typing import NamedTuple, Self

from linkanim.errors import BadInput
from linkanim.units import shown


class GameWords(NamedTuple):
    """What a game is begun with."""

    kind: str
    fields: dict[str, str]

    @classmethod
    def of(cls, text: str) -> Self:
        """Read them; BadInput where a parameter is not written as name=value.

        A value may have quotes, as in a shell; without any, words that have no name belong to the one before.
        """
        kind, parts = "", list[str]()
        for part in _split(text):
            if not kind:
                kind = part
            elif "=" not in part and parts:
                parts[-1] += f" {part}"
            else:
                parts.append(part)
        if not all("=" in part for part in parts):
            raise BadInput(f"{shown(text)} is no game; one is written as predict level=1 seed=7")
        return cls(kind, dict(part.split("=", 1) for part in parts))

    def __str__(self) -> str:
        return " ".join([self.kind, *(quote(f"{name}={value}") for name, value in self.fields.items())])

    def text(self, name: str, usual: str = "") -> str:
        """Return a parameter, spaces for its underscores."""
        return self.fields.get(name, usual).replace("_", " ")

    def whole(self, name: str, usual: int = 0, low: int = 0, high: int = 10**9) -> int:
        """Return a parameter that is a whole number within bounds; BadInput for any other."""
        value = self.fields.get(name, str(usual))
        try:
            number = int(value)
        except ValueError:
            number = low - 1
        if not low <= number <= high:
            raise BadInput(f"{self.kind}: {name}={shown(value)} is no whole number from {low} to {high}")
        return number

    def having(self, **fields: object) -> Self:
        """Return them with other parameters; what is "" is left out."""
        given = {name: str(value) for name, value in fields.items() if value != ""}
        return self._replace(fields={**self.fields, **given})


def _split(text: str) -> list[str]:
    """Return what spaces part, but those in quotes; a backslash is a character as others."""
    lexer = shlex(text, posix=True)
    lexer.whitespace_split, lexer.escape, lexer.commenters = True, "", ""
    try:
        return [*lexer]
    except ValueError:
        raise BadInput(f"{shown(text)} has a quote that does not end") from None
