"""argparse as this command needs it: one line for a usage error, `-30 deg` taken as a value."""

from __future__ import annotations

import argparse
import re
from collections.abc import Callable, Sequence
from typing import Any, NoReturn

from linkanim.errors import BadInput
from linkanim.units import shown

_NEGATIVE = re.compile(r"-\.?\d")
_NEGATIVE_LIST = re.compile(r"-\.?\d[^,]*,")


class Parser(argparse.ArgumentParser):
    """A parser that raises `BadInput` for a usage error and whose help ends in its examples."""

    def __init__(
        self, *, examples: Sequence[str] = (), before: Callable[[], str] | None = None, **options: object
    ) -> None:
        super().__init__(
            formatter_class=argparse.RawDescriptionHelpFormatter,
            allow_abbrev=False,
            **options,  # type: ignore[arg-type]
        )
        self._examples = examples
        self._before = before

    def error(self, message: str) -> NoReturn:
        """Raise the usage error as one sentence that names the help to read."""
        raise BadInput(f"{message} (see `{self.prog} --help`)")

    def _get_value(self, action: argparse.Action, arg_string: str) -> Any:
        # argparse's own knows no `BadInput`, and would let it go without the option's name
        try:
            return super()._get_value(action, arg_string)
        except BadInput as error:
            raise argparse.ArgumentError(action, str(error)) from error

    def _check_value(self, action: argparse.Action, value: Any) -> None:
        # argparse's own says the value whole, however long it is
        if action.choices is not None and value not in action.choices:
            choices = ", ".join(map(shown, action.choices))
            raise argparse.ArgumentError(action, f"{shown(value)} is none of its choices: {choices}")

    def format_help(self) -> str:
        """Return argparse's help, what `before` adds, and the examples as its last lines."""
        added = f"\n{self._before()}" if self._before else ""
        examples = "".join(f"  {line}\n" for line in self._examples)
        return f"{super().format_help()}{added}\nexamples:\n{examples}"

    def _print_message(self, message: str, file: Any = None) -> None:
        # argparse's own swallows the error of a full disk or of a reader that left
        print(message, end="", file=file)


def join_negative(words: Sequence[str]) -> list[str]:
    """Write `--angle -30deg` as `--angle=-30deg`, or argparse would take -30deg for an option.

    -3,4 gets a blank in front, which does the same for an option that takes several of them.
    """
    joined: list[str] = []
    for word in words:
        if _NEGATIVE_LIST.match(word):
            joined.append(f" {word}")
        elif joined and joined[-1].startswith("--") and "=" not in joined[-1] and _NEGATIVE.match(word):
            joined[-1] += f"={word}"
        else:
            joined.append(word)
    return joined
