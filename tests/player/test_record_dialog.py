"""The dialog of a recording: format, size, length, place, by keys and by mouse; nothing foreign is lost."""

from __future__ import annotations

import json
import shutil
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path

import pygame
import pytest
from playing import CTRL, SHIFT, Player
from shown_lists import values_in

from linkanim.cli import main
from linkanim.play.games import game_of
from linkanim.player import background, record_dialog
from linkanim.player.action import Action
from linkanim.player.actions import advance, is_taped
from linkanim.player.record_dialog import RecordDialog
from linkanim.player.state import RecordingChoice, State, begin
from linkanim.player.tape import Tape
from linkanim.player.tape_file import read
from linkanim.scenes import load
from linkanim.ui import screen

SIZE = (1280, 720)


class Asked:
    """What would have been started, and its end, which a test sets."""

    def __init__(self) -> None:
        self.commands: list[list[str]] = []
        self.code: int | None = None

    def poll(self) -> int | None:
        return self.code

    def __call__(self, command: list[str], log: int) -> Asked:
        self.commands.append(command)
        return self

    @property
    def targets(self) -> list[str]:
        return [command[command.index("-o") + 1] for command in self.commands]


@pytest.fixture
def asked(monkeypatch: pytest.MonkeyPatch) -> Asked:
    found = Asked()
    monkeypatch.setattr("linkanim.player.background._start", found)
    return found


@pytest.fixture
def player(here: Path, asked: Asked) -> Iterator[Player]:
    del here, asked
    with screen.opened(SIZE):
        player = Player(replace(begin(load("crank-rocker")), games=game_of))
        player.tick(20)
        yield player
        player.window.close()


def dialog(player: Player) -> RecordDialog:
    found = player.state.of(RecordDialog)
    assert found
    return found


def opened(player: Player) -> None:
    player.press(pygame.K_g, CTRL | SHIFT)
    player.tick(12)
    assert player.state.mode == "record"


def values(state: State) -> dict[str, str]:
    return {label: value for label, value, _ in record_dialog.rows(state)}


def click(player: Player, label: str) -> None:
    number = [label for label, *_ in record_dialog.rows(player.state)].index(label)
    y = next(y for y in range(2, 718) if player.window.screen.row_at(60, y) == number)
    player.drag((60.0, y + 3.0))


# What is chosen, by the keys and by the mouse: rows down and steps to the right, or the row that is clicked.
CHOICES: dict[str, tuple[str, Callable[[Player], object]]] = {
    "format": ("Format", lambda player: player.state.recording_choice.format == "mp4"),
    "size": ("Size", lambda player: player.state.recording_choice.size == (800, 450)),
    "length": ("Length", lambda player: player.state.recording_choice.whole),
    "place": ("Where to", lambda player: values(player.state)["Where to"] == "crank-rocker-1.gif"),
}


@pytest.mark.thinned(3)
@pytest.mark.parametrize("by", ["keys", "tab", "mouse", "wheel"])
@pytest.mark.parametrize("case", CHOICES)
def test_each_choice_is_taken_by_keys_and_by_mouse(player: Player, case: str, by: str) -> None:
    label, is_taken = CHOICES[case]
    opened(player)
    row = [label for label, *_ in record_dialog.rows(player.state)].index(label)
    if by in ("mouse", "wheel"):
        if by == "mouse":
            click(player, label)
        else:
            y = next(y for y in range(2, 718) if player.window.screen.row_at(60, y) == row)
            player.mouse(pygame.MOUSEMOTION, (60, y), rel=(0, 0), buttons=(0, 0, 0))
            pygame.event.post(pygame.event.Event(pygame.MOUSEWHEEL, x=0, y=1))
            player.tick()
    else:
        assert player.state.of(RecordDialog)
        for _ in range(dialog(player).row - row):
            player.press(pygame.K_UP) if by == "keys" else player.press(pygame.K_TAB, SHIFT)
        player.press(pygame.K_RIGHT)
    assert is_taken(player)
    player.press(pygame.K_ESCAPE)
    assert player.state.mode == "play"


def test_what_is_chosen_is_recorded_until_it_is_stopped(player: Player, asked: Asked, here: Path) -> None:
    opened(player)
    click(player, "Size")
    player.type("lecture.mp4")
    assert values(player.state)["Where to"] == "lecture_"
    assert player.state.recording_choice == RecordingChoice("mp4", (800, 450))
    player.press(pygame.K_RETURN)
    assert (player.state.mode, player.state.recording is not None) == ("play", True)
    player.tick(5)
    player.type("n")
    player.type("g")
    assert asked.targets == ["lecture.mp4"]
    assert asked.commands[0][asked.commands[0].index("--size") + 1] == "800x450"
    assert [action for _, action in read(here / "lecture.tape.json", game_of).actions] == [Action("names")]


def test_one_period_is_recorded_at_once(player: Player, asked: Asked, here: Path) -> None:
    opened(player)
    click(player, "Length")
    assert values(player.state)["Length"].startswith("one period, 3")
    click(player, "Record")
    assert player.state.recording is None
    assert asked.targets == ["recordings/crank-rocker-1.gif"]
    assert read(here / "recordings" / "crank-rocker-1.tape.json", game_of).is_loop


def test_the_button_that_opens_it_stops_what_runs(player: Player, asked: Asked) -> None:
    opened(player)
    player.press(pygame.K_RETURN)
    player.press(pygame.K_g, CTRL | SHIFT)
    assert player.state.mode == "play"
    assert player.state.toast
    assert player.state.toast.text == record_dialog.RUNS
    player.type("g")
    assert len(asked.commands) == 1


def test_g_and_m_alone_do_what_they_did(player: Player, asked: Asked) -> None:
    opened(player)
    player.type("elsewhere")
    player.press(pygame.K_ESCAPE)
    for key in "gm":
        player.type(key)
        player.type(key)
        asked.code = 0
        player.tick(30)
    assert asked.targets == ["recordings/crank-rocker-1.gif", "recordings/crank-rocker-2.mp4"]


def _foreign(here: Path) -> None:
    (here / "mine.gif").write_bytes(b"mine")


def _foreign_tape(here: Path) -> None:
    (here / "mine.tape.json").write_bytes(b"mine")


def _link(here: Path) -> None:
    (here / "other.gif").write_bytes(b"other")
    (here / "mine.gif").symlink_to(here / "other.gif")


# Where nothing may be written, and what is said.
REFUSED: dict[str, tuple[str, Callable[[Path], object], str]] = {
    "a file of another": ("mine", _foreign, "may not be linkanim's own"),
    "a tape of another": ("mine", _foreign_tape, "may not be linkanim's own"),
    "a link": ("mine", _link, "is a link"),
    "no folder": ("not/there/x", lambda _: None, "there is no folder"),
    "a folder": ("sub", lambda here: (here / "sub.gif").mkdir(), "is a folder"),
    "a device": ("con", lambda _: None, "Windows"),
}


@pytest.mark.thinned(5)
@pytest.mark.parametrize("whole", [False, True], ids=["as done", "one period"])
@pytest.mark.parametrize("case", REFUSED)
def test_what_is_not_ours_stays(player: Player, asked: Asked, here: Path, case: str, whole: bool) -> None:
    place, made, words = REFUSED[case]
    made(here)
    before = {path: path.read_bytes() for path in here.rglob("*") if path.is_file()}
    player.window.state = replace(player.state, recording_choice=RecordingChoice(whole=whole))
    opened(player)
    player.type(place)
    player.press(pygame.K_RETURN)
    assert player.state.of(RecordDialog)
    assert words in dialog(player).refusal
    assert values_in(player.state)
    assert values_in(player.state).error == dialog(player).refusal
    assert (asked.commands, player.state.recording) == ([], None)
    assert {path: path.read_bytes() for path in here.rglob("*") if path.is_file()} == before
    player.type("-2")
    assert player.state.of(RecordDialog)
    assert dialog(player).refusal == ""


def test_a_file_that_came_meanwhile_is_not_written_over(player: Player, here: Path, asked: Asked) -> None:
    opened(player)
    player.type("mine")
    player.press(pygame.K_RETURN)
    _foreign(here)
    player.type("g")
    player.tick()
    assert player.state.recording
    assert player.state.toast
    assert player.state.toast.text.endswith("the recording runs on")
    player.type("g")
    assert asked.targets == ["recordings/crank-rocker-1.gif"]
    assert (here / "mine.gif").read_bytes() == b"mine"


def test_a_name_on_its_way_is_not_taken_twice(player: Player, asked: Asked) -> None:
    for typed, words in (("one", ""), ("./one", "is being written")):
        player.window.state = replace(player.state, recording_choice=RecordingChoice(whole=True))
        opened(player)
        player.type(typed)
        player.press(pygame.K_RETURN)
        assert words in (dialog(player).refusal if player.state.of(RecordDialog) else "")
    assert len(asked.commands) == 1


def test_where_the_current_folder_is_gone_that_is_said(player: Player, here: Path, asked: Asked) -> None:
    player.window.state = replace(player.state, recording_choice=RecordingChoice(whole=True))
    opened(player)
    shutil.rmtree(here)
    player.press(pygame.K_RETURN)
    player.tick()
    said = [player.state.toast, dialog(player).refusal if player.state.of(RecordDialog) else ""]
    assert any("cannot be made" in str(words) for words in said), said
    assert asked.commands == []


def test_places_are_proposed_and_the_last_folder_is_the_first(player: Player, here: Path) -> None:
    (here / "films").mkdir()
    opened(player)
    assert player.state.of(RecordDialog)
    assert dialog(player).folder == str(here)
    assert dialog(player).places[:2] == ("recordings/crank-rocker-1", "crank-rocker-1")
    player.type("films/one")
    player.press(pygame.K_RETURN)
    player.type("g")
    opened(player)
    assert player.state.of(RecordDialog)
    assert dialog(player).places[0] == "films/crank-rocker-1"


def test_a_folder_alone_has_the_proposed_name(player: Player, here: Path, asked: Asked) -> None:
    (here / "films").mkdir()
    player.window.state = replace(player.state, recording_choice=RecordingChoice(whole=True))
    opened(player)
    player.type("films/")
    player.press(pygame.K_RETURN)
    assert asked.targets == ["films/crank-rocker-1.gif"]


def test_backspace_shortens_what_is_proposed(player: Player) -> None:
    opened(player)
    player.press(pygame.K_BACKSPACE)
    player.type("7")
    assert values(player.state)["Where to"] == "recordings/crank-rocker-7_"


def test_what_else_is_kept_is_done_from_there(player: Player) -> None:
    opened(player)
    click(player, "save the scene")
    player.tick()
    assert player.state.mode == "name"
    player.press(pygame.K_ESCAPE)
    opened(player)
    for _ in range(2):
        player.press(pygame.K_DOWN)
    player.press(pygame.K_RETURN)
    player.tick()
    assert [path.suffix for path in Path("recordings").iterdir()] == [".svg"]


@pytest.mark.parametrize("before", ["list", "shelf", "help", "edit"])
def test_it_takes_the_place_of_what_is_open(player: Player, before: str) -> None:
    player.window.state = advance(player.state, [Action(before)])
    player.tick(2)
    player.window.state = advance(player.state, [Action("record_dialog")])
    player.tick(2)
    assert values_in(player.state).title == "Record and save"
    assert (player.window.screen.shelf, player.state.help) == (None, False)
    player.press(pygame.K_ESCAPE)
    assert player.state.mode == ("edit" if before == "edit" else "play")


def test_in_a_game_there_is_no_period(player: Player) -> None:
    player.window.state = replace(player.state, recording_choice=RecordingChoice(whole=True))
    player.press(pygame.K_F3)
    opened(player)
    assert values(player.state)["Length"] == "until it is stopped"
    assert values_in(player.state).title == "Record and save"
    player.press(pygame.K_RETURN)
    assert (player.state.mode, player.state.recording is not None) == ("game", True)
    player.type("g")


def test_a_tape_shows_the_dialog_and_what_is_chosen() -> None:
    start = begin(load("crank-rocker"))
    actions = (
        *(
            Action("record_dialog"),
            Action("record_places", "/somewhere\nrecordings/one\ntwo"),
            Action("record_row", -1),
        ),
        *(Action("record_turn", 1), Action("record_type", "x"), Action("record_refused", "not there")),
    )
    assert all(map(is_taped, actions))
    tape = Tape(start, 20, tuple(enumerate((*actions, Action("erase_target"), Action("back")), start=1)))
    states = [*tape.states()]
    assert [bool(one.of(RecordDialog)) for one in states[1:10]] == [True] * 7 + [False] * 2
    chosen, refused = (one.of(RecordDialog) for one in (states[4], states[6]))
    assert chosen
    assert chosen.place == "two"
    assert refused
    assert refused.refusal == "not there"


def test_a_closed_dialog_takes_nothing() -> None:
    state = begin(load("crank-rocker"))
    for action in (
        *(Action("record_turn", 1), Action("record_row", 1), Action("record_type", "a")),
        *(Action("erase_target"), Action("record_refused", "a"), Action("record_places", "a\nb")),
    ):
        assert replace(advance(state, [action]), frame=0, touched=0) == state


@pytest.mark.slow
def test_a_recording_of_the_dialog_is_ours_and_may_be_made_again(here: Path) -> None:
    tape = Tape(begin(load("kite")), 6, ())
    for _ in range(2):
        kept = background.keep(tape, "gif", "film.gif")._replace(size="64x36")
        rendering = kept.rendering()
        assert rendering._process.wait() == 0
        rendering.close()
    known = json.loads((here / ".linkanim-outputs.json").read_text())["files"]
    assert {*known} == {"film.gif", "film.tape.json"}
    (here / "film.gif").write_bytes(b"mine now")
    rendering = kept.rendering()
    assert rendering._process.wait() == 2
    assert "was changed after linkanim wrote it" in rendering.words()
    rendering.close()
    assert (here / "film.gif").read_bytes() == b"mine now"


def test_no_clobber_keeps_a_foreign_file(here: Path, capfd: pytest.CaptureFixture[str]) -> None:
    _foreign(here)
    assert main(["record", "kite", "--no-clobber", "-o", "mine.gif"]) == 2
    assert "mine.gif may not be linkanim's own" in capfd.readouterr().err
    assert (here / "mine.gif").read_bytes() == b"mine"
