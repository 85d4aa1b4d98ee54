"""Files from outside: read whole or refused, and weighed before a parser is let loose on them.

Parsers of TOML and JSON take a time that grows with the square of a key's depth, and a memory many
times the text's size where it is all brackets. A look at the marks outside of texts and comments tells.
"""

from __future__ import annotations

import os
import re
import stat
from dataclasses import dataclass
from errno import EMFILE, ENFILE, ENOMEM
from pathlib import Path
from typing import Any

from linkanim.bounds import MOST_DIGITS
from linkanim.errors import BadInput, OtherVersion, WorkFailed
from linkanim.units import shown

DEEPEST = 16
"""Keys within keys, or brackets within brackets; a scene needs four."""

_TEXTS = re.compile(
    r'"""[\s\S]*?(?:(?<!\\)(?:\\\\)*+"{3,5}|\Z)'
    r"|'''[\s\S]*?(?:'{3,5}|\Z)"
    r'|"[^\n]*?(?:(?<!\\)(?:\\\\)*+"|(?=\n)|\Z)'
    r"|'[^'\n]*+'?"
    r"|\#[^\n]*+"
)
# Before its fifth patch Python 3.11 errs about groups that are repeated without going back and may match
# in several ways: there are none here.
_DOTTED = re.compile(rf"(?<![\w-])(?:[\w-]++[ \t]*+\.[ \t]*+){{{DEEPEST}}}")
_LONG_NUMBER = re.compile(
    rf"(?<![0-9_.])(?:[0-9_.]{{{MOST_DIGITS + 1}}}|0x[0-9a-fA-F_]{{{MOST_DIGITS + 1}}})"
)
_CONTROLS = re.compile(
    r"[\0-\x08\x0b\x0c\x0e-\x1f\x7f-\x9f\u061c\u200e\u200f\u2028-\u202e\u2060-\u206f\ud800-\udfff"
    r"\ufff9-\ufffb\ufffe\uffff\U000e0000-\U000e007f]"
)
_PARTED, _LONGEST_NAME = re.compile(r"[/\\]"), 255
"""What parts the names of a path on any system, and the bytes of a name that a disk holds."""
_BRACKETS = re.compile(r"[\[\]{}]")
_MARKS = "=,:[{"
_OUR_TROUBLE = (EMFILE, ENFILE, ENOMEM)
"""Why the system refuses any file, not this one."""


@dataclass(frozen=True)
class Intake:
    """A kind of file that is read: what it is called, its bytes and values at the most, and its refusal."""

    noun: str
    most_bytes: int
    most_values: int
    refusal: type[BadInput] = BadInput

    def read(self, path: Path, where: str, *, missing: str = "") -> str:
        """Return a file's text; `missing` is added to what is said of one that is not there.

        What is no file with text in it is refused without waiting for it: a folder, a pipe, a device.
        """
        try:
            data = self._bytes(path, where)
        except FileNotFoundError:
            raise self.refusal(f"{where}: no such file{missing}") from None
        except (OSError, ValueError) as error:
            if isinstance(error, OSError) and error.errno in _OUR_TROUBLE:
                raise WorkFailed(f"{where}: cannot be read: {os.strerror(error.errno).lower()}") from None
            reason = (error.strerror or "") if isinstance(error, OSError) else str(error)
            raise self.refusal(f"{where}: cannot be read: {reason.lower() or 'the system refuses'}") from None
        try:
            return data.decode("utf-8-sig")
        except UnicodeDecodeError as error:
            line = data[: error.start].count(b"\n") + 1
            raise self.refusal(f"{where}: is not UTF-8 text (line {line}); save it as UTF-8") from None

    def json(self, path: Path, where: str, otherwise: str) -> Any:
        """Return what a file of JSON holds; one that is none, or has a NaN, is refused as `otherwise`."""
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
        """Return a document of ours, which has its version under a mark.

        OtherVersion for one of another version; one without the mark is refused as `otherwise`.
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
        if path.is_dir():  # Windows cannot open one to be asked
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

        Texts in quotes and comments weigh nothing but by their digits; the time grows with the length alone.
        """
        bare = _TEXTS.sub("s", text)
        if sum(map(bare.count, _MARKS)) > self.most_values:
            raise self.refusal(f"{where}: has more than {self.most_values:,} values; it is not {self.noun}")
        if number := _LONG_NUMBER.search(text):
            line = text.count("\n", 0, number.start()) + 1
            raise self.refusal(
                f"{where}: has a number of more than {MOST_DIGITS:,} digits (line {line}); write fewer"
            )
        if _DOTTED.search(bare) or _depth(bare) > DEEPEST:
            raise self.refusal(f"{where}: is nested deeper than {DEEPEST} levels; {self.noun} needs but four")


def control_in(text: str) -> str | None:
    """Return what in a text is no plain text, in words; None where all of it is.

    Controls of the terminal and of the direction of writing, lines' and paragraphs' separators, halves of
    characters, invisible signs (U+2060 to U+206F, tags): what a terminal obeys, no page may hold or no reader
    can see. Tabs and line breaks pass, and what joins letters or figures into one.
    """
    found = _CONTROLS.search(text)
    return f"the control character U+{ord(found[0]):04X}" if found else None


def unnameable(path: str) -> str | None:
    """Return why no file of ours can name a path, in words; None where it can."""
    if found := control_in(path):
        return f"has {found} in its name"
    if any(len(part.encode()) > _LONGEST_NAME for part in _PARTED.split(path)):
        return f"has a name of more than {_LONGEST_NAME} letters"
    return None if path.strip() else "has no name"


def named(path: str | os.PathLike[str]) -> str:
    """Return a path as it is shown, on one line."""
    return "".join(c if c.isprintable() else "?" for c in os.fspath(path))


def _depth(bare: str) -> int:
    """Return how deeply brackets stand in brackets, or one more than is allowed."""
    depth = deepest = 0
    for bracket in _BRACKETS.findall(bare):
        depth = depth + 1 if bracket in "[{" else max(depth - 1, 0)
        deepest = max(deepest, depth)
        if deepest > DEEPEST:
            break
    return deepest
