"""What is kept of games: best scores, what was missed, the last door; one small file, whole at any moment."""

from __future__ import annotations

import json
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass, field, replace
from itertools import count
from pathlib import Path
from types import MappingProxyType

from linkanim import atomic_files, intake
from linkanim.document import Section
from linkanim.errors import BadInput, LinkanimError, WorkFailed
from linkanim.intake import Intake
from linkanim.play.question import QuestionId

VERSION = 1
_MARK = "linkanim_scores"
_FILE = Intake("a file of scores", most_bytes=1_000_000, most_values=20_000)
_MOST_MISSED = 200
_MOST_BEST = 1_000
_HIGHEST = 10**9


@dataclass(frozen=True)
class Scores:
    """Best scores by round, questions that were missed and not met since, the door taken last."""

    door: str = ""
    best: Mapping[str, int] = field(default_factory=lambda: MappingProxyType({}))
    missed: tuple[QuestionId, ...] = ()

    def having(self, name: str, value: str) -> Scores:
        """Return them with what a game leaves: a door, a question missed or met, best as ROUND:SCORE."""
        match name:
            case "door":
                return replace(self, door=value)
            case "best":
                kind, _, score = value.rpartition(":")
                best = max(int(score), self.best.get(kind, 0))
                return replace(self, best=MappingProxyType({**self.best, kind: best}))
            case "missed" | "met":
                question_id = QuestionId.of(value)
                others = tuple(one for one in self.missed if one != question_id)
                kept = (*others, question_id) if name == "missed" else others
                return replace(self, missed=kept[-_MOST_MISSED:])
        return self


def load(path: Path) -> Scores:
    """Return what a file holds, nothing where there is none; BadInput for one that is not of this version."""
    where = intake.named(path)
    if not path.exists():
        return Scores()
    document = _FILE.json(path, where, "is not JSON")
    if not isinstance(document, dict) or document.get(_MARK) != VERSION:
        raise BadInput(f"{where}: holds no scores of this version")
    return _read(Section(where, document))


def _read(top: Section) -> Scores:
    best, missed = top.table("best"), top.listed("missed")
    if len(best.values) > _MOST_BEST or len(missed.values) > _MOST_MISSED:
        raise top.wrong("holds more than is ever kept")
    return Scores(
        top.text("door"),
        MappingProxyType({name: best.whole(name, 0, _HIGHEST) for name in best.values}),
        tuple(QuestionId.of(missed.text(key)) for key in missed.values),
    )


def save(scores: Scores, path: Path) -> None:
    """Write scores, whole or not at all; BadInput or WorkFailed where they cannot be."""
    document = {
        _MARK: VERSION,
        "door": scores.door,
        "best": dict(sorted(scores.best.items())),
        "missed": [str(question_id) for question_id in scores.missed],
    }
    text = json.dumps(document, indent=1, ensure_ascii=False)
    atomic_files.write_text(path, f"{text}\n", folders=True)


def loaded(path: Path) -> tuple[Scores, str | None]:
    """Return what a file holds; one that is damaged or not ours is set aside, and a sentence says where."""
    try:
        return load(path), None
    except WorkFailed as error:
        return Scores(), str(error)
    except LinkanimError as error:
        aside = _set_aside(path)
        if aside is None:
            return Scores(), f"{error}; scores are not kept"
        return Scores(), f"{error}; it is kept as {aside.name}, and scores begin anew"


def _set_aside(path: Path) -> Path | None:
    """Give a file another name that is free; None where it cannot be."""
    names = (path.with_name(f"{path.stem}-aside-{n}{path.suffix}") for n in count(1))
    free = next(name for name in names if not name.exists())
    with suppress(OSError):
        path.rename(free)
        return free
    return None
