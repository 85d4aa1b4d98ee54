"""The same command writes the same bytes, whatever it writes."""

from __future__ import annotations

from pathlib import Path

import pytest

from linkanim.cli import main

SMALL = ["--size", "160x90", "--seconds", "0.12"]


@pytest.mark.parametrize(
    "words",
    [
        ["record", "press", "-o", "out.gif", *SMALL, "--vectors", "v,a"],
        ["record", "press", "-o", "out.png", *SMALL, "--transparent", "--chart", "C.acceleration"],
        ["record", "press", "-o", "out.mp4", *SMALL],
        ["solve", "press", "--sweep", "0:360:7", "--csv", "out.csv"],
        ["chart", "press", "--quantity", "C.velocity", "-o", "out.svg"],
        ["chart", "press", "--quantity", "C.velocity", "-o", "out.csv"],
    ],
    ids=lambda words: f"{words[0]} {' '.join(word for word in words if 'out.' in word)} {len(words)}",
)
@pytest.mark.slow
def test_the_same_command_writes_the_same_bytes(
    words: list[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    written = []
    for name in ("one", "two"):
        (tmp_path / name).mkdir()
        monkeypatch.chdir(tmp_path / name)
        assert main(words) == 0
        written.append({path.name: path.read_bytes() for path in (tmp_path / name).iterdir()})
    assert written[0] == written[1]
    assert all(written[0].values())
