"""`linkanim new`: the window with an empty sheet."""

from __future__ import annotations

from argparse import Namespace

from linkanim import intake
from linkanim.errors import BadInput
from linkanim.picture.building.photograph import SUFFIXES
from linkanim.picture.look import Look
from linkanim.player.window.loop import run as play
from linkanim.scenes import names
from linkanim.user_data import kept_as


def run(options: Namespace) -> None:
    """Open the window on an empty sheet, and return when it is closed."""
    look = Look(theme=options.theme)
    photo = options.photo
    if photo and not (photo.is_file() and photo.suffix.lower() in SUFFIXES):
        raise BadInput(f"{intake.named(photo)}: is no picture; a photograph is one of {', '.join(SUFFIXES)}")
    play(names()[0], look=look, size=options.size, drafts=kept_as("draft.json"), sheet=True, photo=photo)
