"""Predict in the window: keys and clicks, what is shown, and the same score from a tape."""

from __future__ import annotations

import csv
import math
from collections.abc import Iterator
from dataclasses import replace
from itertools import pairwise
from pathlib import Path
from random import Random

import pygame
import pytest
from playing import SIZE, Player
from shown_lists import game_in

from linkanim.cli import main
from linkanim.errors import BadInput
from linkanim.picture.game_panel import GamePanel
from linkanim.play.arcade import Arcade
from linkanim.play.games import game_of
from linkanim.play.kinds import KINDS
from linkanim.play.menus import Menu
from linkanim.play.predict import COUNT, QUICK, TRIES, GivenAnswer, Predict, points
from linkanim.play.question import QuestionId
from linkanim.play.quiz import next_question
from linkanim.play.scores import keep
from linkanim.play.scores import load as load_scores
from linkanim.player.action import Action
from linkanim.player.actions import advance, carried
from linkanim.player.state import State, begin
from linkanim.player.tape import Tape, Taping, resumed, starting
from linkanim.player.tape_file import read, write
from linkanim.scenes import chapters, load, names
from linkanim.ui import screen
from linkanim.ui.pictures import Framing

BEGUN = "predict chapter=four-bars level=1 seed=7"
FASTEST = "fastest@press@0.2105@velocity"
CENTRE = "instant_centre@crank-rocker@4.6593@coupler"
TURNS_BACK = "dead_centre@slider-crank@6.075@slider"


def playing(words: str) -> State:
    state = replace(begin(load("press")), games=game_of)
    return carried(state, Action("play", words))


def round_of(state: State) -> Predict:
    assert isinstance(state.game, Predict)
    return state.game


@pytest.mark.parametrize("name", ["hoecken", "slider-crank", "toggle-clamp", "grashof-limit-six-bar"])
def test_the_points_of_a_question_are_in_sight(name: str) -> None:
    scene, looked = load(name), 0
    for seed in range(3):
        question = next_question(scene, f"{seed}", (), ("instant centre",))
        if question.kind == "instant centre":
            state = playing(f"predict seed=1 again={question.question_id}")
            asked = round_of(state).question
            assert asked
            view = Framing(window=True).fitting(state, (640, 360)).view
            for answer in asked.answers:
                assert answer.place
                x, y = view.to_pixel(*answer.place)
                assert 0 <= x <= 640
                assert 0 <= y <= 342
                looked += 1
    assert looked > 2


def right_of(state: State) -> int:
    question = round_of(state).question
    assert question
    return question.right


def panel_of(state: State) -> GamePanel:
    panel = round_of(state).panel(state)
    assert panel
    return panel


def answered(state: State, *, well: bool) -> State:
    """Answer a question and go on to the next."""
    right = right_of(state)
    state = advance(state, [Action("option", right if well else (right + 1) % 2)])
    return advance(state, [Action("next")])


@pytest.fixture
def player(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Player]:
    """A window on the title, scores in a folder of its own."""
    monkeypatch.chdir(tmp_path)
    arcade = Arcade(tmp_path / "scores.json", Random(3))
    with screen.opened(SIZE):
        state = replace(begin(load("press")), games=game_of)
        player = Player(carried(state, Action("play", arcade.completed("title"))), keeper=arcade)
        yield player
        player.window.close()


def test_from_the_title_its_door_and_enter_begin_a_round_and_a_key_answers(
    player: Player, tmp_path: Path
) -> None:
    for key in (pygame.K_4, pygame.K_RETURN, pygame.K_RETURN):  # Play, Predict, all mechanisms
        player.press(key)
        player.tick()
    game = round_of(player.state)
    assert game.question
    assert player.state.clock.paused
    question_id = player.pixels
    player.press(pygame.K_1 + game.question.right)
    assert round_of(player.state).score > 0
    assert player.state.look.vectors == game.question.shows.vectors
    assert player.pixels != question_id
    before = player.state.phase
    player.tick(100)
    assert player.state.phase == before
    player.tick(60)
    assert player.state.phase != before
    player.press(pygame.K_RETURN)
    assert round_of(player.state).chosen is None
    assert load_scores(tmp_path / "scores.json").door == "play"


def test_a_right_answer_tells_the_points_by_which_the_score_grows() -> None:
    state = playing(BEGUN)
    for well in (True, True, False, True):
        before = round_of(state).score
        right = right_of(state)
        state = advance(state, [Action("option", right if well else (right + 1) % 2)])
        gained = round_of(state).score - before
        assert well == (gained > 0)
        if well:
            assert panel_of(state).verdict == f"Right: {gained} points"
        state = advance(state, [Action("next")])


def test_what_is_missed_is_kept_and_comes_first_the_next_time(player: Player, tmp_path: Path) -> None:
    player.window.state = playing(BEGUN)
    player.tick()
    player.press(pygame.K_1 + (right_of(player.state) + 1) % 2)
    player.tick()
    missed = load_scores(tmp_path / "scores.json").missed
    assert missed == (round_of(player.state).done[0].question_id,)
    words = Arcade(tmp_path / "scores.json").completed("predict chapter=four-bars level=1")
    state = playing(words)
    assert round_of(state).question == round_of(playing(BEGUN)).question
    player.window.state = state
    player.tick()
    player.press(pygame.K_1 + right_of(state))
    player.tick()
    assert load_scores(tmp_path / "scores.json").missed == ()


def test_the_menu_chooses_chapter_and_level_and_shows_best_scores(player: Player, tmp_path: Path) -> None:
    Arcade(tmp_path / "scores.json").keep("best=four-bars.2:321")
    for key in (pygame.K_4, pygame.K_RETURN):  # Play, Predict
        player.press(key)
        player.tick()
    game = player.state.game
    assert isinstance(game, Menu)
    assert dict(game.best) == {"four-bars.2": 321}
    player.press(pygame.K_RIGHT)
    player.press(pygame.K_DOWN)
    player.press(pygame.K_RETURN)
    player.tick()
    assert (round_of(player.state).chapter, round_of(player.state).level) == ("four-bars", 2)
    player.press(pygame.K_ESCAPE)
    player.tick()
    assert isinstance(player.state.game, Menu)
    for kind in ("lobby", "title"):
        player.press(pygame.K_ESCAPE)
        player.tick()
        assert player.state.game
        assert player.state.game.words.startswith(kind)


def test_a_round_can_be_about_the_mechanism_that_was_on() -> None:
    state = playing("menu")
    assert state.game
    panel = game_in(state)
    assert [choice.key for choice in panel.choices] == [f"{n}" for n in range(1, len(panel.choices) + 1)]
    state = carried(state, Action("raise", 1))  # from the first row to the last
    assert isinstance(state.game, Menu)
    assert state.game.chapter == "press"
    state = carried(state, Action("next"))
    (begun,) = state.effects
    state = carried(state, Action("play", str(begun.value)))
    for _ in range(3):
        assert state.scene.name == "press"
        state = answered(state, well=True)


@pytest.mark.parametrize("token", [FASTEST, CENTRE])
def test_a_click_on_a_spot_in_the_picture_answers(player: Player, token: str) -> None:
    player.window.state = playing(f"predict chapter=all level=3 again={token}")
    player.tick(20)
    question = round_of(player.state).question
    assert question
    spots = [player.window.screen.pixel(*one.place) for one in question.answers if one.place]
    place = spots[question.right]
    assert len(spots) == len(question.answers)
    player.mouse(pygame.MOUSEBUTTONDOWN, place, button=1)
    assert round_of(player.state).done[-1].right


def test_the_pose_that_was_asked_stands_then_is_swept_and_stands_again() -> None:
    state = playing(f"predict chapter=all level=1 again={FASTEST}")
    question = round_of(state).question
    assert question
    state = advance(state, [Action("option", question.right)])
    phases = []
    for _ in range(500):
        state = advance(state)
        phases.append(state.phase - question.phase)
    assert set(phases[:119]) == {0.0}
    assert max(phases) == pytest.approx(math.radians(15.0), rel=1e-3)
    assert min(phases) == pytest.approx(-math.radians(15.0), rel=1e-3)
    assert max(abs(b - a) for a, b in pairwise(phases)) < math.radians(0.5)
    assert set(phases[380:]) == {0.0}
    assert state.clock.paused


def test_a_round_ends_with_the_best_score_and_what_was_missed() -> None:
    state = playing(f"{BEGUN} best=5000")
    asked = []
    while not round_of(state).is_over:
        question = round_of(state).question
        assert question
        asked.append(question)
        state = answered(state, well=len(asked) != 3)
    panel = round_of(state).panel(state)
    assert panel
    text = " ".join(panel.lines)
    assert "The best is 5000 points." in text
    assert f"Missed at first: {asked[2].kind}." in text
    assert asked[2].scene.title in text


def test_the_input_runs_to_the_dead_centre_and_stands_there() -> None:
    state = playing(f"predict chapter=sliders level=2 again={TURNS_BACK}")
    question = round_of(state).question
    assert question
    assert not state.look.dead_centres
    state = advance(state, [Action("option", question.right)])
    for _ in range(400):
        state = advance(state)
    assert state.clock.paused
    assert state.phase == question.stops
    assert abs(state.scene.pose(state.phase).travel_velocity["slider"]) < 1e-6


def test_keys_that_would_show_the_answer_do_nothing() -> None:
    state = playing(BEGUN)
    assert (state.look.hud, state.look.trace) == (False, False)
    same = state
    for name, value in (("vectors", "v"), ("step", 10), ("scrub", 1.0), ("chart", 1), ("centres", None)):
        same = carried(same, Action(name, value))
    assert (same.look, same.phase, same.game) == (state.look, state.phase, state.game)


def test_under_the_help_nothing_is_answered_and_no_other_mechanism_comes() -> None:
    state = carried(playing(BEGUN), Action("help"))
    for name, value in (("option", 0), ("mechanism", 1), ("vectors", "v"), ("next", None)):
        state = carried(state, Action(name, value))
    assert state.help
    state = carried(state, Action("back"))
    assert (state.help, state.game, state.scene.name) == (
        False,
        playing(BEGUN).game,
        playing(BEGUN).scene.name,
    )


def test_a_round_asks_ten_and_then_what_was_missed() -> None:
    state = playing(BEGUN)
    seen = []
    for n in range(COUNT):
        seen.append(panel_of(state).scores[:2])
        right = right_of(state)
        state = advance(state, [Action("option", (right + 1) % 2 if n in (2, 5) else right)])
        assert not any(str(effect.value).startswith("best=") for effect in state.effects)
        state = advance(state, [Action("next")])
    assert seen[0] == ("1 / 10", "0 in a row")
    assert seen[-1] == ("10 / 10", "3 in a row")
    assert panel_of(state).scores[0] == "again 1 / 2"
    game = round_of(state)
    assert game.question
    assert game.question.question_id == game.done[2].question_id == game.missed[0]
    state = answered(state, well=True)
    missed = round_of(state).missed[1]
    for time in range(TRIES - 1):
        question = round_of(state).question
        assert question
        assert question.kind == missed.kind
        assert (question.question_id == missed) is (time == 0)
        assert panel_of(state).scores[0] == "again 2 / 2"
        state = advance(state, [Action("option", (right_of(state) + 1) % len(question.answers))])
        assert Action("score", f"missed={missed}") in state.effects
        state = advance(state, [Action("next")])
    question = round_of(state).question
    assert question
    state = advance(state, [Action("option", (right_of(state) + 1) % len(question.answers))])
    best = Action("score", f"best=four-bars.1:{round_of(state).score}")
    assert best in state.effects  # once, with the last answer
    state = advance(state, [Action("next")])
    assert round_of(state).is_over
    assert round_of(state).question is None
    assert len({one.question_id for one in round_of(state).done}) >= COUNT
    assert {one.question_id.scene for one in round_of(state).done} <= {*chapters()["four-bars"]}
    doors = ((Action("next"), "predict"), (Action("option", 0), "predict"), (Action("option", 1), "menu"))
    for action, what in doors:
        (begun,) = carried(state, action).effects
        assert str(begun.value).startswith(f"{what} chapter=four-bars level=1")
    assert carried(state, Action("option", 2)) == state


@pytest.mark.parametrize("count", [3, 7, 14])
def test_a_round_is_about_all_scenes_before_one_comes_again(
    count: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("linkanim.play.predict.members", lambda _: names()[:count])
    state = playing("predict chapter=all level=1 seed=3")
    for _ in range(min(count, COUNT)):
        state = answered(state, well=True)
    asked = [one.question_id.scene for one in round_of(state).done]
    assert len({*asked}) == len(asked)


def test_rounds_begin_with_different_scenes() -> None:
    first = {
        question.scene.name
        for seed in range(4)
        if (question := round_of(playing(f"predict chapter=all level=1 seed={seed}")).question)
    }
    assert len(first) > 2


@pytest.mark.parametrize("named", [True, False])
def test_a_wrong_answer_is_called_by_its_misconception_if_one_gives_it(named: bool) -> None:
    state = playing(f"predict chapter=all level=1 again={FASTEST}")
    question = round_of(state).question
    assert question
    wrong = next(
        n for n, one in enumerate(question.answers) if n != question.right and bool(one.slip) == named
    )
    assert panel_of(state).hint == "1–4 or a click answers   Esc leaves"
    state = advance(state, [Action("option", wrong)])
    panel = panel_of(state)
    assert panel.scores[0] == "1 / 10"  # still that question's, until the next
    assert panel.hint == "Enter goes on   Esc leaves"
    assert panel.verdict == (f"No: that is {question.answers[wrong].slip}." if named else "No.")
    assert panel.lines_after == (question.why,)


@pytest.mark.parametrize("level", [1, 2, 3])
def test_a_level_asks_its_own_kinds(level: int) -> None:
    state = playing(f"predict chapter=four-bars level={level} seed=1")
    for _ in range(5):
        state = answered(state, well=True)
    assert all(level in KINDS[one.question_id.kind].levels for one in round_of(state).done)


# So many frames, so much before: what an answer earns.
EARNED = {
    "at once": (1, [GivenAnswer(QuestionId("a", "b", 0.0, "c"), True, 0)], 150),
    "late": (1, [GivenAnswer(QuestionId("a", "b", 0.0, "c"), True, QUICK)], 100),
    "at level three": (3, [GivenAnswer(QuestionId("a", "b", 0.0, "c"), True, QUICK)], 300),
    "wrong": (1, [GivenAnswer(QuestionId("a", "b", 0.0, "c"), False, 0)], 0),
    "third in a row": (1, [GivenAnswer(QuestionId("a", "b", 0.0, "c"), True, QUICK)] * 3, 120),
    "again": (2, [GivenAnswer(QuestionId("a", "b", 0.0, "c"), True, 0)] * (COUNT + 1), 80),
}


@pytest.mark.parametrize(("level", "done", "expected"), EARNED.values(), ids=EARNED)
def test_an_answer_earns(level: int, done: list[GivenAnswer], expected: int) -> None:
    assert points(level, tuple(done), len(done) - 1) == expected


def test_a_tape_of_a_round_has_its_score_and_one_begun_in_its_midst_goes_on(tmp_path: Path) -> None:
    state = replace(begin(load("press")), games=game_of)
    taping = Taping(state, SIZE)
    script = {3: Action("play", BEGUN), 40: Action("option", 0), 50: Action("next"), 90: Action("option", 1)}
    script |= {99: Action("next"), 130: Action("option", 0)}
    for frame in range(1, 160):
        done = (script[frame],) if frame in script else ()
        state = advance(state, done)
        taping.note(frame, done)
        if frame == 100:
            midway = Tape(starting(state), 40, tuple((0, one) for one in resumed(state)))
    assert round_of(state).score > 0
    path = tmp_path / "round.tape.json"
    write(taping.tape(159), path)
    *_, last = read(path, game_of).states()
    assert (round_of(last).score, round_of(last).done) == (round_of(state).score, round_of(state).done)
    *_, again = midway.states()
    assert round_of(again).done == round_of(state).done[:2]
    assert round_of(again).question == round_of(state).question


@pytest.mark.parametrize(
    "words",
    [
        "predict chapter=no-such",
        "predict level=4",
        "predict again=x",
        "predict done=turning@press@1@2",
        "predict done=turning@press@1@2:2:0",
        "menu best=x",
    ],
)
def test_words_that_make_no_round_are_refused(words: str) -> None:
    with pytest.raises(BadInput):
        game_of(words)


def test_a_right_answer_of_its_kind_ends_what_was_missed() -> None:
    state = playing(BEGUN)
    for n in range(COUNT):
        right = right_of(state)
        state = advance(state, [Action("option", (right + 1) % 2 if n == 4 else right)])
        state = advance(state, [Action("next")])
    missed = round_of(state).missed[0]
    state = answered(state, well=False)
    state = advance(state, [Action("option", right_of(state))])
    assert Action("score", f"met={missed}") in state.effects
    assert advance(state, [Action("next")]).game != state.game
    assert round_of(advance(state, [Action("next")])).is_over


def test_misconceptions_are_counted_without_names_or_questions(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path, counts = tmp_path / "scores.json", tmp_path / "counts.csv"
    slips = ["the way of the other end", 'the "larger" angle, doubled', "the way of the other end"]
    assert keep([*(f"slip={slip}" for slip in slips), "best=all.1:50"], path, own=False) is None
    assert load_scores(path).slips == {slips[0]: 2, slips[1]: 1}
    assert main(["play", "--scores", str(path), "--counts", str(counts)]) == 0
    assert capsys.readouterr().out.strip() == str(counts)
    with counts.open(encoding="utf-8", newline="") as file:
        assert [*csv.reader(file)] == [["misconception", "answers"], [slips[0], "2"], [slips[1], "1"]]
    assert "@" not in counts.read_text(encoding="utf-8")
