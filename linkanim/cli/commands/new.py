"""`linkanim new`: the window with an empty sheet."""

from __future__ import annotations

from argparse import Namespace

from linkanim.atomic_files import kept_as
from linkanim.picture.look import Look
from linkanim.picture.photograph import refuse_lacking
from linkanim.play.arcade import Arcade
from linkanim.scenes import names
from linkanim.ui.window import run as play


def run(options: Namespace) -> None:
    """Open the window on an empty sheet, and return when it is closed."""
    look = Look(theme=options.theme)
    photo = options.photo
    if photo:
        refuse_lacking(str(photo))
    play(
        names()[0],
        look=look,
        size=options.size,
        keeper=Arcade(),
        drafts=kept_as("draft.json"),
        sheet=True,
        photo=photo,
    )
