"""`linkanim play`: the window."""

from __future__ import annotations

from argparse import Namespace
from pathlib import Path

from linkanim.atomic_files import checked_target, kept_as, write_text
from linkanim.errors import BadInput
from linkanim.picture.look import Look
from linkanim.play.arcade import Arcade
from linkanim.ui.window import run as play


def run(options: Namespace) -> None:
    """Open the window on the title, a scene, a scene file or a tape, and return when it is closed."""
    if options.scores:
        _refuse_foreign(checked_target(options.scores, (".json",)))
    if options.counts:
        _count(options)
        return
    play(
        options.scene,
        look=Look(theme=options.theme, unit=options.unit, material=options.material),
        attract=options.attract,
        size=options.size,
        keeper=Arcade(options.scores, greets=True),
        game=options.game,
        drafts=kept_as("draft.json"),
        reduced_motion=options.reduced_motion,
    )


def _count(options: Namespace) -> None:
    """Write how often each misconception gave an answer, and print the file's path."""
    from linkanim.play.scores import load

    target = checked_target(options.counts, (".csv",))
    write_text(target, load(options.scores or kept_as("scores.json")).counts)
    print(target)


def _refuse_foreign(path: Path) -> None:
    """Raise BadInput for an existing file without scores that we can read: it is not ours to replace."""
    from linkanim.play.scores import load

    try:
        load(path)
    except BadInput as error:
        raise BadInput(f"{error}; it stays as it is: name another file with --scores") from None
