"""Names as a person gives them: O2, O4 for ground pins, A, B for joints, P for points, 2, 3 for bodies."""

from __future__ import annotations

from collections.abc import Container, Iterable, Iterator
from itertools import chain, count

from linkanim.build.draft import Draft

_JOINTS, _POINTS = "ABCDEFGHJKLMN", "PQRSTUVWXYZ"


def pin_name(draft: Draft) -> str:
    """Return the name of the next ground pin."""
    return _free((f"O{number}" for number in count(2, 2)), draft.places)


def joint_name(draft: Draft, *, point: bool = False) -> str:
    """Return the name of the next joint, or of the next point of a body."""
    return _free(_lettered(_POINTS if point else _JOINTS), draft.places)


def body_name(draft: Draft) -> str:
    """Return the number of the next body."""
    return _free(map(str, count(2)), draft.of("bodies"))


def numbered(draft: Draft, kind: str, word: str) -> str:
    """Return the next name of a kind: the word itself, then with 2, 3, ... behind it."""
    return _free(chain([word], (f"{word}{number}" for number in count(2))), draft.of(kind))


def _lettered(letters: str) -> Iterator[str]:
    yield from letters
    yield from (f"{letter}{number}" for number in count(2) for letter in letters)


def _free(names: Iterable[str], taken: Container[str]) -> str:
    return next(name for name in names if name not in taken)
