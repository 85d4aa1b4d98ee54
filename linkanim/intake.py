"""Take in files from outside: read whole or refused, their tables and documents checked key by key.

Its parts, in reading order:

- Files from outside: read whole or refused, and weighed before a parser is let loose on them.
- A document's tables read key by key; what is wrong is said with its file, key, value and way out.
- Tables of numbers as they come: commas, tabs, blanks or semicolons between, with or without a heading.
"""

from __future__ import annotations

import math
import os
import re
import stat
from collections.abc import Iterable, Mapping
from dataclasses import replace
from errno import EMFILE, ENFILE, ENOMEM
from pathlib import Path
from typing import Any, ClassVar, NamedTuple, Self, TypeVar

from linkanim.bounds import LONGEST_TEXT, MOST_DIGITS, MOST_ROWS_READ
from linkanim.errors import BadInput, OtherVersion, WorkFailed, shortened
from linkanim.frozen import frozen
from linkanim.units import shown

# Files from outside: read whole or refused, and weighed before a parser is let loose on them.
#
# Parsers of TOML and JSON take a time that grows with the square of a key's depth, and a memory many times
# the text's size where it is all brackets. Counting the marks outside texts and comments tells beforehand.

DEEPEST = 16
"""Keys within keys, or brackets within brackets; a scene needs four."""

_TEXTS = (
    r'"""[\s\S]*?(?:(?<!\\)(?:\\\\)*+"{3,5}|\Z)'
    r"|'''[\s\S]*?(?:'{3,5}|\Z)"
    r'|"[^\n]*?(?:(?<!\\)(?:\\\\)*+"|(?=\n)|\Z)'
    r"|'[^'\n]*+'?"
    r"|\#[^\n]*+"
)
# Before 3.11.5, Python's `re` errs about possessive groups that may match in several ways: there are none
# here.
_DOTTED = rf"(?<![\w-])(?:[\w-]++[ \t]*+\.[ \t]*+){{{DEEPEST}}}"
_LONG_NUMBER = rf"(?<![0-9_.])(?:[0-9_.]{{{MOST_DIGITS + 1}}}|0x[0-9a-fA-F_]{{{MOST_DIGITS + 1}}})"
_CONTROLS = (
    r"[\0-\x08\x0b\x0c\x0e-\x1f\x7f-\x9f\u061c\u200e\u200f\u2028-\u202e\u2060-\u206f\ud800-\udfff"
    r"\ufff9-\ufffb\ufffe\uffff\U000e0000-\U000e007f]"
)
_PARTED, _LONGEST_NAME = r"[/\\]", 255
"""What separates the names in a path on any system, and the most bytes of a name on a disk."""
_BRACKETS = r"[\[\]{}]"
_MARKS = "=,:[{"
_OUR_TROUBLE = (EMFILE, ENFILE, ENOMEM)
"""Errors that are no fault of the file: the system would refuse any file."""


@frozen
class Intake:
    """A kind of file that is read: its name in messages, its most bytes and values, its refusal."""

    noun: str
    most_bytes: int
    most_values: int
    refusal: type[BadInput] = BadInput

    def read(self, path: Path, where: str, *, missing: str = "") -> str:
        """Return a file's text; `missing` is added to the message about a file that does not exist.

        A folder, a pipe or a device is refused at once: nothing waits for it.
        """
        data = self.read_bytes(path, where, missing=missing)
        try:
            return data.decode("utf-8-sig")
        except UnicodeDecodeError as error:
            line = data[: error.start].count(b"\n") + 1
            raise self.refusal(f"{where}: is not UTF-8 text (line {line}); save it as UTF-8") from None

    def read_bytes(self, path: Path, where: str, *, missing: str = "") -> bytes:
        """Return a file's bytes, with the refusals of `read`."""
        try:
            return self._bytes(path, where)
        except FileNotFoundError:
            raise self.refusal(f"{where}: no such file{missing}") from None
        except (OSError, ValueError) as error:
            if isinstance(error, OSError) and error.errno in _OUR_TROUBLE:
                raise WorkFailed(f"{where}: cannot be read: {os.strerror(error.errno).lower()}") from None
            reason = (error.strerror or "") if isinstance(error, OSError) else str(error)
            raise self.refusal(f"{where}: cannot be read: {reason.lower() or 'the system refuses'}") from None

    def json(self, path: Path, where: str, otherwise: str) -> Any:
        """Return the content of a JSON file; any other, or one with a NaN, is refused with `otherwise`."""
        return self.parsed(self.read(path, where), where, otherwise)

    def parsed(self, text: str, where: str, otherwise: str) -> Any:
        """Return what a text of JSON holds; refused as by `json`."""
        import json

        try:
            self.refuse_heavy(text, where)
            return json.loads(text, parse_constant=int)  # which takes no NaN, nor an infinity
        except (ValueError, RecursionError):
            raise self.refusal(f"{where}: {otherwise}") from None

    def marked(self, document: object, where: str, mark: str, version: int, otherwise: str) -> dict[str, Any]:
        """Return a document of ours, which has its version under the key `mark`.

        OtherVersion for another version; a document without the key is refused with the reason `otherwise`.
        """
        if not isinstance(document, dict) or mark not in document:
            raise self.refusal(f"{where}: {otherwise}")
        if document[mark] != version or isinstance(document[mark], bool):
            raise OtherVersion(
                f"{where}: is {self.noun} of version {shown(document[mark])}; this linkanim reads version "
                f"{version}"
            )
        return document

    def _bytes(self, path: Path, where: str) -> bytes:
        if path.is_dir():  # Windows cannot open a folder
            raise self.refusal(f"{where}: is a folder; name {self.noun} in it")
        # a pipe that nobody writes to would keep us waiting
        descriptor = os.open(path, os.O_RDONLY | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_BINARY", 0))
        with os.fdopen(descriptor, "rb") as file:
            before = os.fstat(descriptor)
            if not stat.S_ISREG(before.st_mode):
                raise self.refusal(f"{where}: is not a file with text in it; name {self.noun}")
            data = file.read(self.most_bytes + 1)
            after = os.fstat(descriptor)
        if len(data) > self.most_bytes:
            megabytes = self.most_bytes // 1_000_000
            raise self.refusal(f"{where}: is larger than {megabytes} MB; it is not {self.noun}")
        if (before.st_size, before.st_mtime_ns) != (after.st_size, after.st_mtime_ns):
            raise self.refusal(f"{where}: changed while it was read; try again when it is written")
        return data

    def refuse_heavy(self, text: str, where: str) -> None:
        """Refuse a document of more values than this kind has, too long a number, or depth beyond `DEEPEST`.

        In quoted texts and in comments only the lengths of numbers count. The time is proportional to the
        length.
        """
        bare = re.sub(_TEXTS, "s", text)
        if sum(map(bare.count, _MARKS)) > self.most_values:
            raise self.refusal(f"{where}: has more than {self.most_values:,} values; it is not {self.noun}")
        if number := re.search(_LONG_NUMBER, text):
            line = text.count("\n", 0, number.start()) + 1
            raise self.refusal(
                f"{where}: has a number of more than {MOST_DIGITS:,} digits (line {line}); write fewer"
            )
        if re.search(_DOTTED, bare) or _depth(bare) > DEEPEST:
            raise self.refusal(f"{where}: is nested deeper than {DEEPEST} levels; {self.noun} needs but four")


def control_in(text: str) -> str | None:
    """Return the first character of a text that plain text does not have, in words; None where there is none.

    Controls of the terminal and of the direction of writing, lines' and paragraphs' separators, halves of
    characters, invisible signs (U+2060 to U+206F, tags): what a terminal obeys, no page may hold or no reader
    can see. Tabs and line breaks pass, and the joiners of letters and of emoji.
    """
    match = re.search(_CONTROLS, text)
    return f"the control character U+{ord(match[0]):04X}" if match else None


def unnameable(path: str) -> str | None:
    """Return why a path cannot be named in a file of ours, in words; None where it can."""
    if control := control_in(path):
        return f"has {control} in its name"
    if any(len(part.encode()) > _LONGEST_NAME for part in re.split(_PARTED, path)):
        return f"has a name of more than {_LONGEST_NAME} letters"
    return None if path.strip() else "has no name"


def named(path: str | os.PathLike[str]) -> str:
    """Return a path as it is shown: on one line, and shortened where it is longer than a path can be."""
    return "".join(c if c.isprintable() else "?" for c in shortened(os.fspath(path)))


def _depth(bare: str) -> int:
    """Return how deeply brackets stand in brackets, or one more than is allowed."""
    depth = deepest = 0
    for bracket in re.findall(_BRACKETS, bare):
        depth = depth + 1 if bracket in "[{" else max(depth - 1, 0)
        deepest = max(deepest, depth)
        if deepest > DEEPEST:
            break
    return deepest


# A document's tables read key by key; what is wrong is said with its file, key, value and way out.
#
# Scene files and tapes are such documents: TOML and JSON come as the same tables, lists and values.

Option = TypeVar("Option", bound=str)

_FEW = 12
_LONG = 60
_BREAK = r"\s*[\t\n\r]\s*"
_BARE_KEY = r"[A-Za-z0-9_-]+(\[\d+\])*"


@frozen
class Section:
    """One table of a document: its values, and the keys that lead to it.

    Every reader raises `refusal` where the key is missing or its value is of another kind.
    """

    refusal: ClassVar[type[BadInput]] = BadInput

    where: str
    values: Mapping[str, Any]
    keys: tuple[str, ...] = ()

    @property
    def path(self) -> str:
        """The keys as TOML writes them."""
        return ".".join(map(_written, self.keys))

    def __contains__(self, key: str) -> bool:
        return key in self.values

    def key(self, key: str) -> str:
        """Return the key's full path, as TOML writes it."""
        return ".".join(map(_written, (*self.keys, key)))

    def error(self, key: str, reason: str) -> BadInput:
        """Return (not raise) the error about one key: file, key, value if it has one, and the reason."""
        value = self.values.get(key)
        shown_value = "" if value is None or isinstance(value, Mapping | list) else f" = {shown(value)}"
        return self.at(f"{self.key(key)}{shown_value}: {reason}", key)

    def wrong(self, reason: str) -> BadInput:
        """Return (not raise) the error about this table as a whole."""
        return self.at(f"{self.path}: {reason}" if self.path else reason)

    def at(self, message: str, *keys: str) -> BadInput:
        """Return (not raise) an error about what stands at keys under this table."""
        error = self.refusal(f"{self.where}: {message}")
        error.keys = (*self.keys, *keys)
        return error

    def need(self, key: str) -> Any:
        """Return the key's value, whatever it is."""
        if key not in self.values:
            place = f"{self.path}: " if self.path else ""
            raise self.at(f'{place}"{key}" is missing', key)
        return self.values[key]

    def table(self, key: str) -> Self:
        """Return the table under a key, empty where there is none."""
        value = self.values.get(key, {})
        if not isinstance(value, Mapping):
            raise self.error(key, f"must be a table, [{self.key(key)}] or {{ ... }}")
        return self.under(key, value)

    def under(self, key: str, values: Mapping[str, Any]) -> Self:
        """Return a table that stands under a key."""
        return type(self)(self.where, values, (*self.keys, key))

    def items(self, key: str, count: int | None = None) -> list[Any]:
        """Return a list, of `count` items if given."""
        value = self.need(key)
        if not isinstance(value, list) or count not in (None, len(value)):
            raise self.error(key, f"must be a list of {count} items" if count else "must be a list")
        return value

    def listed(self, key: str, count: int | None = None) -> Self:
        """Return a list's items as a table in the place of this one, under `key[0]`, `key[1]`, ..."""
        values = {f"{key}[{i}]": value for i, value in enumerate(self.items(key, count))}
        return replace(self, values=values)

    def text(self, key: str, default: str | None = None) -> str:
        """Return a text, on one line; `default` where it is missing, an error where that is None."""
        value = self.need(key) if default is None else self.values.get(key, default)
        if not isinstance(value, str):
            raise self.error(key, "must be a text in quotes")
        if len(value) > LONGEST_TEXT:
            raise self.error(key, f"is longer than {LONGEST_TEXT:,} characters; cut it")
        return re.sub(_BREAK, " ", value)

    def texts(self, key: str) -> tuple[str, ...]:
        """Return a list of texts, empty where it is missing."""
        value = self.values.get(key, [])
        if not isinstance(value, list) or not all(isinstance(text, str) for text in value):
            raise self.error(key, 'must be a list of texts, such as ["one", "another"]')
        items = self.listed(key) if value else self
        return tuple(items.text(item) for item in items.values) if value else ()

    def choice(self, key: str, options: tuple[Option, ...]) -> Option:
        """Return one of the options, the first where the key is missing."""
        value = self.values.get(key, options[0])
        if value not in options:
            raise self.error(key, f"must be {' or '.join(shown(option) for option in options)}")
        return options[options.index(value)]

    def flag(self, key: str) -> bool:
        """Return true or false."""
        value = self.need(key)
        if not isinstance(value, bool):
            raise self.error(key, "must be true or false")
        return value

    def number(self, key: str) -> float:
        """Return a finite number."""
        value = self.need(key)
        if isinstance(value, bool) or not isinstance(value, int | float) or not _is_finite(value):
            raise self.error(key, "must be a finite number")
        return float(value)

    def whole(self, key: str, low: int, high: int) -> int:
        """Return a whole number from `low` to `high`."""
        value = self.need(key)
        if not isinstance(value, int) or isinstance(value, bool) or not low <= value <= high:
            raise self.error(key, f"must be a whole number from {low} to {high}")
        return value


def refuse_controls(document: Section) -> None:
    """Refuse a control character in any key or text of a document, wherever it stands in it."""
    pending: list[tuple[tuple[str, ...], Any]] = [((), document.values)]
    while pending:
        keys, value = pending.pop()
        if isinstance(value, str) and (control := control_in(value)):
            place = ".".join(map(_written, keys))
            raise document.at(f"{place} = {shown(value)}: has {control} in it; leave it out", *keys)
        if isinstance(value, Mapping):
            for key in value:
                if control := control_in(key):
                    place = ".".join(map(_written, (*keys, key)))
                    raise document.at(f"{place}: has {control} in it; leave it out", *keys, key)
            pending += [((*keys, key), inner) for key, inner in value.items()]
        elif isinstance(value, list):
            start, last = keys[:-1], keys[-1] if keys else ""
            pending += [((*start, f"{last}[{n}]"), inner) for n, inner in enumerate(value)]


def _written(key: str) -> str:
    return key if len(key) <= _LONG and re.fullmatch(_BARE_KEY, key) else shown(key)


def meant(name: str, known: Iterable[str]) -> str:
    """Return ' (did you mean "crank"?)' for a name close to a known one, else an empty text."""
    from difflib import get_close_matches  # for what is wrong only: a window opens sooner without

    # what is far longer than any name is near to none, and takes long to compare
    near = get_close_matches(name[:_LONG], list(known), n=1, cutoff=0.6)
    return f" (did you mean {shown(near[0])}?)" if near else ""


def few(names: Iterable[str]) -> str:
    """Return names as a message lists them: a dozen, and how many more there are."""
    listed = list(names)
    more = len(listed) - _FEW
    return ", ".join(listed[:_FEW]) + (f" and {more} more" if more > 0 else "")


def _is_finite(value: float) -> bool:
    try:
        return math.isfinite(value)
    except OverflowError:  # a whole number beyond floats
        return False


# Tables of numbers as they come: commas, tabs, blanks or semicolons between, with or without a heading.

_NUMBER = r"[+-]?(\d+([.,]\d*)?|[.,]\d+)([eE][+-]?\d+)?"
_LONGEST_LINE = 100_000
_WITH_COMMA = re.compile(r"[+-]?\d+(,\d+)?([eE][+-]?\d+)?")


class NumberTable(NamedTuple):
    """A table of numbers: where it is from, the cells of its heading, none without such a line, its rows.

    A row is the number of its line, and its numbers.
    """

    where: str
    heading: tuple[str, ...]
    rows: tuple[tuple[int, tuple[float, ...]], ...]

    @property
    def first(self) -> str:
        """The heading of the first column; "" where it has none."""
        return self.heading[0] if self.heading else ""

    def beside_first(self, column: int, factor: float = 1.0) -> NumberTable:
        """Return the table of its first column and another, times a factor."""
        heading = (self.first, *self.heading[column : column + 1])
        rows = ((line, (numbers[0], factor * numbers[column])) for line, numbers in self.rows)
        return NumberTable(self.where, heading, tuple(rows))

    def refuse_ragged(self) -> None:
        """Raise BadInput for a row that has not as many numbers as there are names."""
        for line, numbers in self.rows:
            if len(numbers) != len(self.heading):
                counts = f"{len(numbers)} numbers under {len(self.heading)} names"
                raise BadInput(f"{self.where}: line {line} has {counts}; give a number under each")


def read_numbers(text: str, where: str, columns: str) -> NumberTable:
    """Return a text's numbers; `columns` are those that it has to have, in words with commas between.

    Cells are parted by semicolons, tabs, commas or blanks: by the first of these that the table has. Where
    commas do not part them, a comma in a number is its decimal mark. Lines without a number before the others
    are a heading; empty lines and what follows # are ignored. `BadInput` names line, column and cell.
    """
    lines = _lines(text, where)
    between, comma = _form([line for _, line in lines])
    table = [(number, _cells(line, between)) for number, line in lines]
    start = next((n for n, (_, cells) in enumerate(table) if not _is_heading(cells)), len(table))
    if start == len(table):
        raise BadInput(f"{where}: has no rows; give a table of numbers: {columns}")
    heading = tuple(cell.strip() for cell in table[start - 1][1]) if start else ()
    rows = ((line, _row(line, cells, columns, where, comma)) for line, cells in table[start:])
    return NumberTable(where, heading, tuple(rows))


def _lines(text: str, where: str) -> list[tuple[int, str]]:
    """Return the lines that hold anything, numbered."""
    lines = []
    for number, line in enumerate(text.splitlines(), start=1):
        if control := control_in(line):
            raise BadInput(f"{where}: line {number} has {control} in it; save it as plain text")
        if len(line) > _LONGEST_LINE:
            raise BadInput(
                f"{where}: line {number} has more than {_LONGEST_LINE:,} characters; give fewer cells"
            )
        bare = line.partition("#")[0].strip(" ")
        if bare.strip(" \t;,"):
            lines.append((number, bare))
    if len(lines) > MOST_ROWS_READ + 1:
        count = f"{len(lines):,} rows; {MOST_ROWS_READ:,} are the most that are read"
        raise BadInput(f"{where}: has {count}: keep every tenth or so")
    return lines


def _form(lines: list[str]) -> tuple[str, bool]:
    """Return what stands between the cells, " " for blanks, and whether a comma is the decimal mark."""
    mark = next((mark for mark in ";\t," if any(mark in line for line in lines)), " ")
    if mark != ",":
        return mark, True
    cells = [line.split() for line in lines if re.match(_NUMBER, _plain(line))]
    decimal = all(len(row) > 1 and all(map(_WITH_COMMA.fullmatch, row)) for row in cells)
    return (" ", True) if cells and decimal else (mark, False)


def _cells(line: str, between: str) -> list[str]:
    import csv

    return line.split() if between == " " else next(csv.reader([line], delimiter=between))


def _is_heading(cells: list[str]) -> bool:
    """Return whether no cell is a number, and the first one does not begin with one, as 87 deg does."""
    return not (
        re.match(_NUMBER, _plain(cells[0])) or any(re.fullmatch(_NUMBER, _plain(cell)) for cell in cells)
    )


def _plain(cell: str) -> str:
    return cell.strip().removesuffix("°").replace("−", "-").replace("\u00a0", "")


def _row(line: int, cells: list[str], columns: str, where: str, comma: bool) -> tuple[float, ...]:
    """Return the numbers of a line's cells; BadInput where they are too few, or one is none."""
    place, needed = f"{where}: line {line}", columns.count(",") + 1
    while len(cells) > needed and not cells[-1].strip():
        cells = cells[:-1]
    if len(cells) < needed:
        text = shown(" ".join(cells))
        raise BadInput(f"{place} has {len(cells)} of {needed} columns ({columns}): {text}")
    numbers = [_number(cell, comma) for cell in cells]
    for column, (cell, number) in enumerate(zip(cells, numbers, strict=True), start=1):
        if not math.isfinite(number):
            way_out = "; give a number" if cell.strip() else "; give a number, or leave the line out"
            raise BadInput(f"{place}, column {column}: {shown(cell)} is not a finite number{way_out}")
    return tuple(numbers)


def _number(cell: str, comma: bool) -> float:
    """Return a cell's number, NaN where it has none."""
    plain = _plain(cell)
    if not re.fullmatch(_NUMBER, plain) or ("," in plain and not comma):
        return math.nan
    return float(plain.replace(",", "."))
