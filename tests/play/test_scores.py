"""What is kept: read back, set aside where it is not ours, whole after a kill at any moment."""

from __future__ import annotations

import errno
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from linkanim.atomic_files import Claim, kept_as
from linkanim.cli import main
from linkanim.errors import BadInput
from linkanim.play.arcade import GREETING, Arcade
from linkanim.play.games import GameWords
from linkanim.play.match import FOLDER, MatchGame
from linkanim.play.menus import Menu
from linkanim.play.predict import Predict
from linkanim.play.question import QuestionId
from linkanim.play.quiz import is_question
from linkanim.play.scores import Scores, load, save

MISSED = QuestionId("dead centre", "slider-crank", 6.075, "slider")
KEPT = Scores("play", {"four-bars.1": 1200, "all.3": 40}, (MISSED,))


def test_it_reads_back_and_is_readable(tmp_path: Path) -> None:
    path = tmp_path / "new folder" / "scores.json"
    save(KEPT, path)
    assert load(path) == KEPT
    assert '"four-bars.1": 1200' in path.read_text(encoding="utf-8")
    assert [one.name for one in path.parent.iterdir()] == ["scores.json"]


def test_without_a_file_there_is_nothing_and_none_is_made(tmp_path: Path) -> None:
    assert load(tmp_path / "scores.json") == Scores()
    assert not list(tmp_path.iterdir())


BAD = {
    "nothing": b"",
    "the beginning": b"{",
    "a list": b"[1]",
    "no text": b"\xff\xfe",
    "a door that is a number": b'{"linkanim_scores": 1, "door": 3, "best": {}, "missed": []}',
    "less than nothing": b'{"linkanim_scores": 1, "door": "", "best": {"a": -1}, "missed": []}',
    "more than a number holds": b'{"linkanim_scores": 1, "door": "", "best": {"a": 1%s}, "missed": []}'
    % (b"0" * 400),
    "no question": b'{"linkanim_scores": 1, "door": "", "best": {}, "missed": ["x"]}',
    "half a character": b'{"linkanim_scores": 1, "door": "", "best": {"\\ud800": 1}, "missed": []}',
    "another program's": b'{"other": "program"}',
    "too deep": b"[" * 100_000,
}
bad = pytest.mark.parametrize("content", BAD.values(), ids=BAD)
NEWER = b'{"linkanim_scores": 2, "everything": "else"}'


@pytest.fixture
def own(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The user's own file of scores; there is none yet."""
    monkeypatch.setattr("platformdirs.user_data_path", lambda *_, **__: tmp_path / "data")
    (tmp_path / "data").mkdir()
    return tmp_path / "data" / "scores.json"


@bad
def test_the_user_s_own_file_that_is_damaged_is_set_aside_with_a_sentence(content: bytes, own: Path) -> None:
    for n in (1, 2):
        own.write_bytes(content)
        arcade = Arcade()
        arcade.completed("title")
        assert own.read_bytes() == content  # until there is something to be kept
        arcade.keep("door=build")
        (sentence,) = arcade.news()
        assert f"scores-aside-{n}.json, and scores begin anew" in sentence
        assert own.with_name(f"scores-aside-{n}.json").read_bytes() == content
        assert load(own).door == "build"
        assert arcade.news() == []


def test_the_user_s_own_file_of_a_newer_version_stays_and_scores_are_not_kept(own: Path) -> None:
    own.write_bytes(NEWER)
    arcade = Arcade()
    for _ in range(3):
        arcade.completed("title")
        arcade.keep("door=build")
    (sentence,) = arcade.news()
    assert sentence.endswith(
        "is a file of scores of version 2; this linkanim reads version 1; scores are not kept"
    )
    assert [path.name for path in own.parent.iterdir()] == ["scores.json"]
    assert own.read_bytes() == NEWER


@pytest.mark.parametrize("content", [*BAD.values(), NEWER], ids=[*BAD, "a newer version"])
def test_a_file_that_was_named_is_left_as_it_is_where_it_holds_no_scores(
    content: bytes, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "tsconfig.json"
    path.write_bytes(content)
    opened: list[object] = []
    monkeypatch.setattr("linkanim.cli.commands.play.play", opened.append)
    assert main(["play", "--scores", str(path)]) == 2
    assert capsys.readouterr().err.endswith("; it stays as it is: name another file with --scores\n")
    arcade = Arcade(path)  # what it becomes while a window is open
    arcade.completed("title")
    arcade.keep("door=build")
    (sentence,) = arcade.news()
    assert sentence.endswith("scores are not kept")
    assert [one.name for one in tmp_path.iterdir()] == ["tsconfig.json"]
    assert path.read_bytes() == content
    assert opened == []


def test_a_file_of_scores_that_was_named_opens_and_so_does_a_name_that_is_free(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("linkanim.cli.commands.play.play", lambda *_, **__: 0)
    for _ in range(2):
        assert main(["play", "--scores", str(tmp_path / "class.json")]) == 0
        save(KEPT, tmp_path / "class.json")


def test_more_than_is_kept_forgets_what_was_bettered_longest_ago(tmp_path: Path) -> None:
    path, arcade = tmp_path / "scores.json", Arcade(tmp_path / "scores.json")
    save(Scores(best={f"match-seed-{n}": n for n in range(1_000)}), path)
    arcade.keep("best=match-seed-0:300")
    arcade.keep("best=match-seed-5:2")
    arcade.keep("best=all.1:50")
    assert arcade.news() == []
    best = load(path).best
    assert (len(best), best["match-seed-0"], best["all.1"]) == (1_000, 300, 50)
    assert {"match-seed-1", "match-seed-5"} - best.keys() == {"match-seed-1"}
    save(Scores(best={f"match-seed-{n}": n for n in range(1_300)}), path)  # from a hand, or another version
    arcade.keep("best=all.1:50")
    assert len(load(path).best) == 1_000


@pytest.mark.parametrize("name", ["four bars, open.toml", "a:b.toml", "50 %.toml", "“quoted” 'x'.toml"])
def test_the_best_of_a_level_of_any_name_is_kept_and_the_menu_opens(name: str, tmp_path: Path) -> None:
    arcade = Arcade(tmp_path / "scores.json")
    level = next(entry for entry in FOLDER.iterdir() if entry.name.endswith("-circle.toml"))
    (tmp_path / name).write_text(level.read_text(encoding="utf-8"), encoding="utf-8")
    game = arcade.game_of(str(GameWords("match", {"level": str(tmp_path / name)})))
    assert isinstance(game, MatchGame)
    arcade.keep(f"best={game.kept_as}:120")
    arcade.keep("best=four-bars.2:900")
    menu = arcade.game_of(arcade.completed("menu"))
    assert isinstance(menu, Menu)
    assert menu.best == (("four-bars.2", 900),)
    again = arcade.game_of(arcade.completed(str(GameWords("match", {"level": str(tmp_path / name)}))))
    assert isinstance(again, MatchGame)
    assert again.best == 120


@pytest.mark.parametrize(
    "name", ["\udcff.toml", "a\u202eb.toml", "n" * 1_001 + ".toml", f"seed-{'9' * 5_000}"]
)
def test_what_no_file_of_scores_can_hold_is_no_level_s_name(name: str) -> None:
    with pytest.raises(BadInput, match=r"^match: "):
        Arcade().game_of(str(GameWords("match", {"level": name})))


def test_a_question_that_is_asked_no_more_does_not_stand_in_the_way(tmp_path: Path) -> None:
    arcade = Arcade(tmp_path / "scores.json")
    for phase, subject in ((1.0, "no such body"), (1e9, "slider"), (6.075, "slider")):
        arcade.keep(f"missed=dead_centre@slider-crank@{phase}@{subject}")
    game = arcade.game_of(arcade.completed("predict chapter=slider-crank level=2"))
    assert isinstance(game, Predict)
    assert all(is_question(one) for one in game.again)
    assert {one.subject for one in game.again} <= {"slider"}


def test_what_a_full_disk_did_not_take_is_kept_when_there_is_room(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(number: int) -> None:
        raise OSError(errno.ENOSPC, "No space left on device")

    arcade = Arcade(tmp_path / "scores.json")
    with monkeypatch.context() as disk:
        disk.setattr(os, "fsync", full)
        for score in (50, 60):
            arcade.keep(f"best=all.{score}:{score}")
        (sentence,) = arcade.news()
        assert sentence.endswith("cannot be written: no space left on device; scores are not kept")
    arcade.keep("door=play")
    assert load(tmp_path / "scores.json") == Scores("play", {"all.50": 50, "all.60": 60})


def test_a_file_that_another_window_does_not_let_go_of_is_waited_for_and_told(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "scores.json"
    claim = Claim.on(path)
    assert claim
    assert Claim.on(path) is None
    monkeypatch.setattr("linkanim.atomic_files._PATIENCE", 0.0)
    arcade = Arcade(path)
    arcade.keep("best=all.1:50")
    assert arcade.news() == [f"{path}: cannot be written: another linkanim is using it; scores are not kept"]
    claim.release()
    arcade.keep("door=play")
    assert load(path).best == {"all.1": 50}
    assert [one.name for one in tmp_path.iterdir()] == ["scores.json"]


# Each waits for the others for as long as it takes: the machine may be busy.
MANY = """
import sys
from pathlib import Path
from linkanim import atomic_files
from linkanim.play.arcade import Arcade
atomic_files._PATIENCE = 600.0
arcade, who, count = Arcade(Path(sys.argv[1])), sys.argv[2], int(sys.argv[3])
for n in range(count):
    arcade.keep(f"best=match-{who}-{n}:{n}")
    if n % 5 == 0:
        arcade.keep(f"missed=turning@press@{n}.5@{who}")
assert arcade.news() == [], arcade.news()
"""


@pytest.mark.slow
def test_of_what_three_windows_keep_at_once_nothing_is_lost(tmp_path: Path) -> None:
    path, count = tmp_path / "scores.json", 60
    runs = [
        subprocess.Popen([sys.executable, "-c", MANY, path, who, str(count)]) for who in ("ann", "bob", "cy")
    ]
    assert [run.wait() for run in runs] == [0, 0, 0]
    found = load(path)
    assert found.best == {f"match-{who}-{n}": n for who in ("ann", "bob", "cy") for n in range(count)}
    assert len(found.missed) == 3 * count // 5
    assert [one.name for one in tmp_path.iterdir()] == ["scores.json"]


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
        found = load(path)
        assert found.best["all.1"] >= max(int(line), before)
        before = found.best["all.1"]
        assert len(found.missed) <= 200
    for part in tmp_path.glob("*.part"):  # one that was killed before its lock said whose it is goes by age
        for old in (*part.iterdir(), part):
            os.utime(old, (0, 0))
    Arcade(path).keep("door=play")
    assert [one.name for one in tmp_path.iterdir()] == ["scores.json"]


def test_the_first_window_says_once_for_ever_how_to_begin(tmp_path: Path) -> None:
    file = tmp_path / "scores.json"
    for greeted in (1, 0):
        arcade = Arcade(file, greets=True)
        news = [line for _ in range(200) for line in arcade.news()]
        assert news == [GREETING] * greeted
    arcade = Arcade(file)
    arcade.keep("best=all.1:50")
    assert load(file).greeted
    assert [line for _ in range(200) for line in Arcade(tmp_path / "other.json").news()] == []
