"""The stored results of games: best scores, missed questions, the last door; a file whole at any moment."""

from __future__ import annotations

import csv
import json
from collections.abc import Iterable, Mapping
from dataclasses import field, replace
from io import StringIO
from pathlib import Path
from types import MappingProxyType

from linkanim import atomic_files, intake
from linkanim.errors import BadInput, OtherVersion
from linkanim.frozen import frozen
from linkanim.intake import Intake, Section, refuse_controls
from linkanim.play.question import QuestionId

VERSION = 1
_MARK = "linkanim_scores"
_FILE = Intake("a file of scores", most_bytes=5_000_000, most_values=20_000)
_NONE = "holds no scores of linkanim"
_MOST_MISSED = 200
_MOST_BEST = 1_000
_MOST_SLIPS = 500
_HIGHEST = 10**9


@frozen
class Scores:
    """Best scores by round, missed questions that were not answered since, the door taken last.

    `slips` count how often each misconception led to an answer, without names of players or questions. Where
    there are too many best scores, those that were improved longest ago are dropped. `greeted` says that a
    window has told the user once how to begin.
    """

    door: str = ""
    best: Mapping[str, int] = field(default_factory=lambda: MappingProxyType({}))
    missed: tuple[QuestionId, ...] = ()
    slips: Mapping[str, int] = field(default_factory=lambda: MappingProxyType({}))
    greeted: bool = False

    @property
    def counts(self) -> str:
        """How often each misconception led to an answer, as CSV, the most frequent first."""
        rows = sorted(self.slips.items(), key=lambda one: (-one[1], one[0]))
        text = StringIO()
        table = csv.writer(text, lineterminator="\n")
        table.writerows([("misconception", "answers"), *rows])
        return text.getvalue()

    def having(self, name: str, value: str) -> Scores:
        """Return the scores with one result: a door, a question missed or met, or best as ROUND:SCORE."""
        match name:
            case "door":
                return replace(self, door=value)
            case "greeted":
                return replace(self, greeted=True)
            case "best":
                kind, _, score = value.rpartition(":")
                if int(score) <= self.best.get(kind, -1):
                    return self
                rounds = [*(one for one in self.best.items() if one[0] != kind), (kind, int(score))]
                return replace(self, best=MappingProxyType(dict(rounds[-_MOST_BEST:])))
            case "slip":
                others = [one for one in self.slips.items() if one[0] != value]
                count = min(self.slips.get(value, 0) + 1, _HIGHEST)
                return replace(self, slips=MappingProxyType(dict([*others, (value, count)][-_MOST_SLIPS:])))
            case "missed" | "met":
                question_id = QuestionId.of(value)
                rest = tuple(one for one in self.missed if one != question_id)
                kept = (*rest, question_id) if name == "missed" else rest
                return replace(self, missed=kept[-_MOST_MISSED:])
        return self


def load(path: Path) -> Scores:
    """Return the scores in a file; empty ones where there is no file.

    BadInput for a damaged or foreign file, OtherVersion for one of another version.
    """
    where = intake.named(path)
    if not path.exists():
        return Scores()
    document = _FILE.json(path, where, _NONE)
    return _read(Section(where, _FILE.marked(document, where, _MARK, VERSION, _NONE)))


def _read(top: Section) -> Scores:
    refuse_controls(top)
    best, missed, slips = top.table("best"), top.listed("missed"), top.table("slips")
    return Scores(
        top.text("door"),
        MappingProxyType({name: best.whole(name, 0, _HIGHEST) for name in best.values}),
        tuple(_question(missed, key) for key in missed.values),
        MappingProxyType({name: slips.whole(name, 0, _HIGHEST) for name in slips.values}),
        "greeted" in top,
    )


def _question(missed: Section, key: str) -> QuestionId:
    try:
        return QuestionId.of(missed.text(key))
    except BadInput:
        raise missed.error(key, "is no question, which is KIND@SCENE@PHASE@SUBJECT") from None


def save(scores: Scores, path: Path) -> None:
    """Write scores, whole or not at all; BadInput or WorkFailed where they cannot be."""
    document = {
        _MARK: VERSION,
        "door": scores.door,
        "best": dict(scores.best),
        "missed": [str(question_id) for question_id in scores.missed],
        **({"greeted": True} if scores.greeted else {}),
    }
    document |= {"slips": dict(scores.slips)} if scores.slips else {}
    text = json.dumps(document, indent=1, ensure_ascii=False)
    atomic_files.write_text(path, f"{text}\n", folders=True)


def keep(changes: Iterable[str], path: Path, *, own: bool) -> str | None:
    """Make changes, each as "best=all.1:50", to a file's present content, with other windows locked out.

    Where the file is the program's `own`, a damaged one is set aside, and a sentence says where. Errors as in
    `load` and `save`.
    """
    message = None
    with atomic_files.alone(path):
        try:
            before = load(path)
        except OtherVersion:
            raise
        except BadInput as error:
            aside = atomic_files.set_aside(path) if own else None
            if aside is None:
                raise
            before, message = Scores(), f"{error}; it is kept as {aside.name}, and scores begin anew"
        after = before
        for name, _, value in (change.partition("=") for change in changes):
            after = after.having(name, value)
        if after != before:
            save(after, path)
    return message
