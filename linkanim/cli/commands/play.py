"""`linkanim play`: the window."""

from __future__ import annotations

from argparse import Namespace

from linkanim.atomic_files import checked_target
from linkanim.picture.look import Look
from linkanim.play.arcade import Arcade
from linkanim.player.window.loop import run as play
from linkanim.user_data import kept_as


def run(options: Namespace) -> None:
    """Open the window on the title, a scene, a scene file or a tape, and return when it is closed."""
    play(
        options.scene,
        look=Look(theme=options.theme, unit=options.unit),
        attract=options.attract,
        size=options.size,
        keeper=Arcade(options.scores and checked_target(options.scores, (".json",))),
        game=options.game,
        drafts=kept_as("draft.json"),
    )
