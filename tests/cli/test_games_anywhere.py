"""Games are reached from every window that a command opens."""

from __future__ import annotations

from typing import Any

import pytest

from linkanim.cli import main
from linkanim.play.arcade import Arcade


@pytest.mark.parametrize("line", ["new", "play press", "make press --preview"])
def test_f3_leads_to_the_games(line: str, monkeypatch: pytest.MonkeyPatch) -> None:
    given: list[dict[str, Any]] = []
    for command in ("new", "play"):
        monkeypatch.setattr(f"linkanim.cli.commands.{command}.play", lambda *_, **more: given.append(more))
    monkeypatch.setattr("linkanim.ui.window.run", lambda *_, **more: given.append(more))
    assert main(line.split()) == 0
    (more,) = given
    assert isinstance(more["keeper"], Arcade)
