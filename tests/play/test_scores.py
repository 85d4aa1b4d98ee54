"""What is kept: read back, set aside where it is not ours, whole after a kill at any moment."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from linkanim.play.arcade import Arcade
from linkanim.play.question import QuestionId
from linkanim.play.scores import Scores, load, loaded, save
from linkanim.user_data import kept_as

MISSED = QuestionId("dead centre", "slider-crank", 6.075, "slider")
KEPT = Scores("play", {"four-bars.1": 1200, "all.3": 40}, (MISSED,))


def test_it_reads_back_and_is_readable(tmp_path: Path) -> None:
    path = tmp_path / "new folder" / "scores.json"
    save(KEPT, path)
    assert load(path) == KEPT
    assert '"four-bars.1": 1200' in path.read_text(encoding="utf-8")
    assert [one.name for one in path.parent.iterdir()] == ["scores.json"]


def test_without_a_file_there_is_nothing_and_none_is_made(tmp_path: Path) -> None:
    assert loaded(tmp_path / "scores.json") == (Scores(), None)
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(
    "content",
    [
        b"",
        b"{",
        b"[1]",
        b"\xff\xfe",
        b'{"linkanim_scores": 2}',
        b'{"linkanim_scores": 1, "door": 3, "best": {}, "missed": []}',
        b'{"linkanim_scores": 1, "door": "", "best": {"a": -1}, "missed": []}',
        b'{"linkanim_scores": 1, "door": "", "best": {}, "missed": ["x"]}',
        b'{"other": "program"}',
        b"[" * 100_000,
    ],
)
def test_a_damaged_or_foreign_file_is_set_aside_with_a_sentence(content: bytes, tmp_path: Path) -> None:
    path = tmp_path / "scores.json"
    for n in (1, 2):
        path.write_bytes(content)
        arcade = Arcade(path)
        arcade.keep("door=build")
        (sentence,) = arcade.news()
        assert f"scores-aside-{n}.json" in sentence
        assert (tmp_path / f"scores-aside-{n}.json").read_bytes() == content
        assert load(path).door == "build"
        assert arcade.news() == []


def test_the_best_stays_and_what_is_met_goes(tmp_path: Path) -> None:
    arcade, path = Arcade(tmp_path / "scores.json"), tmp_path / "scores.json"
    for words in ("best=all.1:50", "best=all.1:30", f"missed={MISSED}", f"missed={MISSED}"):
        arcade.keep(words)
    assert load(path) == Scores("", {"all.1": 50}, (MISSED,))
    arcade.keep(f"met={MISSED}")
    assert load(path).missed == ()


@pytest.mark.skipif(os.name != "posix" or os.geteuid() == 0, reason="the superuser may write anywhere")
def test_where_nothing_can_be_written_a_sentence_says_so(tmp_path: Path) -> None:
    tmp_path.chmod(0o500)
    arcade = Arcade(tmp_path / "scores.json")
    arcade.keep("door=build")
    assert "not kept" in arcade.news()[0]


def test_a_folder_in_its_place_is_said_and_the_games_go_on(tmp_path: Path) -> None:
    (tmp_path / "scores.json").mkdir()
    arcade = Arcade(tmp_path / "scores.json")
    arcade.keep("door=build")
    assert arcade.news()
    assert arcade.completed("title").startswith("title door=")


def test_the_usual_place_is_no_user_s_while_tests_run() -> None:
    assert "linkanim-tests-" in str(kept_as("scores.json"))


def test_a_user_without_a_home_leaves_no_folder_named_for_one(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("platformdirs.user_data_path", lambda *_, **__: Path("~/.local/share/linkanim"))
    assert kept_as("scores.json").is_absolute()


WRITER = """
import sys
from pathlib import Path
from linkanim.play.arcade import Arcade
arcade, n = Arcade(Path(sys.argv[1])), 0
while True:
    n += 1
    arcade.keep(f"best=all.1:{n}")
    arcade.keep(f"missed=turning@press@{n}.0@3")
    print(n, flush=True)
"""


@pytest.mark.slow
@pytest.mark.skipif(os.name != "posix", reason="kills as POSIX has them")
def test_it_survives_being_killed_at_any_moment(tmp_path: Path) -> None:
    path, before = tmp_path / "scores.json", 0
    for turn in range(3):
        with subprocess.Popen([sys.executable, "-c", WRITER, path], stdout=subprocess.PIPE, text=True) as run:
            assert run.stdout
            line = run.stdout.readline()  # it has begun to write
            end = time.monotonic() + 0.0047 * turn
            while time.monotonic() < end:
                line = line or ""
            run.send_signal(signal.SIGKILL)
            run.wait()
        found, sentence = loaded(path)
        assert sentence is None
        assert found.best["all.1"] >= max(int(line), before)
        before = found.best["all.1"]
        assert len(found.missed) <= 200
    for part in tmp_path.glob("*.part"):  # one that was killed before its lock said whose it is goes by age
        for old in (*part.iterdir(), part):
            os.utime(old, (0, 0))
    save(found, path)
    assert [one.name for one in tmp_path.iterdir()] == ["scores.json"]
