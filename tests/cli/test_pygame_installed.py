"""Either pygame will do, but not both in one folder: one line says so, and how to mend it."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

from linkanim.cli import main

_CE, _PLAIN = "pygame_ce-2.5.8.dist-info", "pygame-2.6.1.dist-info"
_WHOLE = "pygame/__init__.py"


# what lies in the folder of packages, and what the line says
@pytest.mark.parametrize(
    ("there", "reason"),
    [
        ((_WHOLE, f"{_CE}/METADATA", f"{_PLAIN}/METADATA"), "pygame and pygame-ce are both installed"),
        # one of the two was uninstalled again, and took the files that both had
        (("pygame/left.py", f"{_PLAIN}/METADATA"), "pygame is not whole"),
        ((), "pygame is not installed"),
    ],
)
def test_a_pygame_that_cannot_be_trusted_is_refused_in_one_line(
    there: tuple[str, ...],
    reason: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    for name in there:
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).touch()
    monkeypatch.setattr(sys, "path", [str(tmp_path)])
    monkeypatch.delitem(sys.modules, "pygame", raising=False)
    assert main(["draw", "kite", "-o", str(tmp_path / "kite.svg")]) == 1
    message = capsys.readouterr().err
    assert message.count("\n") == 1
    assert reason in message
    assert "pip install pygame-ce" in message
    assert not (tmp_path / "kite.svg").exists()


# either of them alone is as it should be, and what draws nothing needs neither
@pytest.mark.parametrize("metadata", [_CE, _PLAIN])
def test_one_pygame_is_enough(metadata: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    from linkanim.cli.command_table import refuse_mixed_pygame

    (tmp_path / "pygame").mkdir()
    (tmp_path / _WHOLE).touch()
    (tmp_path / metadata).mkdir()
    monkeypatch.setattr(sys, "path", [str(tmp_path)])
    monkeypatch.delitem(sys.modules, "pygame", raising=False)
    refuse_mixed_pygame()
