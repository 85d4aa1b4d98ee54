"""Match: joints are dragged, three scores move; every level is solved by a tape, and by the path solver."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator
from dataclasses import replace
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pygame
import pytest
from playing import Player

from linkanim.errors import BadInput
from linkanim.play.arcade import Arcade
from linkanim.play.games import game_of
from linkanim.play.match import MatchGame, Worth, level_names, level_of, made, trace
from linkanim.player.action import Action
from linkanim.player.actions import advance
from linkanim.player.state import State, begin
from linkanim.player.tape import Taping
from linkanim.player.tape_file import from_document, read, to_document
from linkanim.scenes import load
from linkanim.synthesis.curves import drawn
from linkanim.synthesis.linkages import FOUR_BAR, Linkage4
from linkanim.synthesis.path import LARGEST, path
from linkanim.ui import screen as display

TAPES = Path(__file__).parent / "match_tapes"
LEVELS = level_names()
STANDING = Linkage4(0 + 0j, 30 + 0j, 60 + 80j, 100 + 0j, 40 + 60j)
CIRCLE = drawn(50 * np.exp(2j * np.pi * np.arange(40) / 40), closed=True)


def on(words: str) -> State:
    state = replace(begin(load("crank-rocker")), games=game_of)
    return advance(state, [Action("play", words)])


def game(state: State) -> MatchGame:
    assert isinstance(state.game, MatchGame)
    return state.game


def done(state: State, *actions: tuple[Any, ...]) -> State:
    for action in actions:
        state = advance(state, [Action(*action)])
    return state


def dragged(joint: str, x: float, y: float, step: float = 1.0) -> tuple[tuple[Any, ...], ...]:
    return ("grab", joint), ("carry", (x, y, step)), ("drop",)


def standing(joints: Linkage4) -> str:
    numbers = (number for place in joints for number in (place.real, place.imag))
    return f"match level=circle joints={','.join(map(repr, numbers))}"


def test_there_are_twenty_levels_in_their_order() -> None:
    assert len(LEVELS) == 20
    assert LEVELS[0] == "circle"
    assert {"hoecken", "dwell-arc", "d-film-gate", "foot"} <= set(LEVELS)


@pytest.mark.parametrize(("steps", "further"), [(1, -1), (-1, 1)])
def test_the_arrow_keys_go_to_the_level_above_and_below(steps: int, further: int) -> None:
    known = level_names()
    state = done(on(f"match level={known[3]}"), ("raise", steps))
    (begun,) = state.effects
    assert str(begun.value).startswith(f"match level={known[3 + further]}")


@pytest.mark.thinned(4)
@pytest.mark.parametrize("name", LEVELS)
def test_every_level_is_solved_by_its_tape_with_full_score(name: str) -> None:
    tape = read(TAPES / f"{name}.tape.json", game_of)
    *_, last = tape.states()
    assert game(last).level == name
    assert game(last).points == (100, 100, 100)
    assert not game(last).gave_up
    panel = game(last).panel(last)
    assert panel
    assert (
        panel.verdict
        == "Full score, with smaller links and a better transmission angle than the path solver's"
    )


@pytest.mark.parametrize("name", LEVELS)
def test_every_level_is_solved_by_its_answer_which_can_be_beaten(name: str) -> None:
    level = level_of(name)
    assert level.answer
    found = Worth.of(level.answer, level.curve)
    assert found.off <= level.full.off
    # two scores pull away from it: neither is what the solver looks for
    exact, *others = found.shares(level.full)
    assert exact == 1.0
    assert max(others) < 1.0
    for joint in level.fixed:
        assert getattr(level.answer, joint) == pytest.approx(getattr(level.start, joint), abs=1e-6)


# what is asked of the path solver besides, where its bars would lie on one another or reach far away: in the
# level's own sentence, and for the solver
STEEP = math.radians(30)
ASKED: dict[str, tuple[str, dict[str, float]]] = {
    "circle": ("30° or more", {"least_angle": STEEP}),
    "ellipse": ("Links of up to 1.5 sizes", {"largest": 1.5}),
    "swan": ("A full turn at 30° or more", {"least_angle": STEEP}),
    "square": ("30° or more", {"least_angle": STEEP}),
}


@pytest.mark.parametrize("name", LEVELS)
def test_a_level_says_what_is_asked_of_the_path_solver_besides_and_so_it_is(name: str) -> None:
    level = level_of(name)
    words, limits = ASKED.get(name, ("", {}))
    assert ("asked of the path solver" in level.about) == bool(words)
    assert words in level.about
    assert level.answer
    assert level.worth_of_answer.angle >= limits.get("least_angle", 0.0) - 1e-6
    longest = FOUR_BAR.link_lengths(np.array([level.answer.row])).max()
    assert longest <= limits.get("largest", math.inf) * level.curve.size * (1 + 1e-6)


@pytest.mark.long
@pytest.mark.parametrize("name", LEVELS)
def test_the_answers_are_the_path_solver_s(name: str) -> None:
    level = level_of(name)
    pins = [
        (place.real, place.imag) if joint in level.fixed else None
        for joint, place in (("O2", level.start.O2), ("O4", level.start.O4))
    ]
    _, limits = ASKED.get(name, ("", {}))
    found = path(
        level.curve.points,
        level.curve.closed,
        count=5,
        prefer="exact",
        pivots=pins if level.fixed else (),
        least_angle=limits.get("least_angle", 0.0),
        largest=limits.get("largest", LARGEST),
    )
    assert level.answer
    if name == "swan":  # which an input that swings draws, too
        found = tuple(fit for fit in found if FOUR_BAR.margins(np.array([fit.row]), STEEP - 1e-6).min() >= 0)
    # cognates, and mirror images of a straight line's, are as exact: it is one of those
    first = [fit for fit in found if fit.rms < found[0].rms * (1 + 1e-6)]
    own, *others = (
        FOUR_BAR.link_lengths(np.array([row]))[0] for row in (level.answer.row, *(fit.row for fit in first))
    )
    assert any(other == pytest.approx(own, rel=1e-4) for other in others)


def test_a_linkage_is_its_joints() -> None:
    row = STANDING.row
    assert row[:2] + row[6:8] == (0.0, 0.0, 100.0, 0.0)
    assert row[2] == 30.0
    assert row[3] == pytest.approx(abs(30 + 80j))
    drawn_ = trace(STANDING)
    # the point stands on its own curve, which the scene's solver draws, too
    assert min(abs(drawn_ - STANDING.P)) < 1e-9
    state = on(standing(STANDING))
    pose = state.scene.pose(state.phase, 0)
    for joint, place in zip(Linkage4._fields, STANDING, strict=True):
        assert complex(*pose.position[joint]) == pytest.approx(place, abs=1e-9)
    motion = state.scene.cycle(240, derivatives=0).position["P"] @ np.array([1, 1j])
    assert np.abs(motion[:, None] - drawn_).min(axis=1).max() < 1e-6


# off, size of links and angle of linkages whose worth is known otherwise
def test_a_point_on_the_crank_draws_the_circle_exactly() -> None:
    joints = Linkage4(0j, 50 + 0j, 140 + 100j, 160 + 0j, 50 + 0j)
    found = Worth.of(joints, CIRCLE)
    assert found.off < 0.1  # the distance of a circle from its chords
    assert found.links == pytest.approx(sum(abs(b - a) for a, b in pairwise((*joints[:4], 0j))) / CIRCLE.size)


def test_what_swings_has_no_transmission_angle_and_comes_back_on_the_other_closure() -> None:
    joints = Linkage4(0j, 80 + 0j, 60 + 80j, 100 + 0j, 40 + 60j)
    found, line = Worth.of(joints, CIRCLE), trace(joints)
    assert found.angle == 0.0
    assert line[0] == line[-1]
    scene = on(
        "match level=circle joints=" + ",".join(f"{v!r}" for z in joints for v in (z.real, z.imag))
    ).scene
    motion = scene.cycle(240, derivatives=0).position["P"] @ np.array([1, 1j])
    # all of it is on what the scene's solver draws, there and back
    assert np.abs(motion[:, None] - line).min(axis=1).max() < 0.1 * CIRCLE.size
    assert np.abs(line[:, None] - motion).min(axis=1).max() < 0.1 * CIRCLE.size


def test_a_drag_moves_one_joint_and_the_scores() -> None:
    state = on("match level=circle")
    before = game(state)
    state = done(state, *dragged("P", 12.3, -7.8))
    after = game(state)
    assert after.joints == before.joints._replace(P=12 - 8j)
    assert after.worth != before.worth
    assert done(state, *dragged("P", 12.34, -7.81, 0.1)).scene.pose(0.0).position["P"] == pytest.approx(
        (12.3, -7.8)
    )
    assert game(done(state, ("undo",))).joints == before.joints
    assert game(done(state, ("undo",), ("undo",))).joints == before.joints


def test_joints_that_are_fixed_and_bars_without_length_stay_as_they_are() -> None:
    state = on("match level=stirrup")
    start = game(state).joints
    assert game(done(state, *dragged("O2", 0.0, 0.0))).joints == start
    assert game(done(state, *dragged("A", start.B.real, start.B.imag))).joints == start
    assert game(done(state, *dragged("A", 1e6, 0.0))).joints == start


def test_giving_up_shows_the_answer_and_goes_back_to_one_s_own() -> None:
    state = done(on("match level=ellipse"), *dragged("P", 20.0, 10.0))
    own = game(state)
    given = done(state, ("option", 0))
    panel = game(given).panel(given)
    assert panel
    assert game(given).joints == level_of("ellipse").answer
    assert "can be had" in panel.verdict
    assert game(given).best == own.best
    # what is shown cannot be dragged into a score
    assert game(done(given, *dragged("P", 0.0, 0.0))).joints == game(given).joints
    back = done(given, ("option", 0))
    assert (game(back).joints, game(back).gave_up) == (own.joints, False)


def test_a_run_of_drags_replays_to_the_same_score_also_from_its_midst() -> None:
    state = on("match level=eight")
    takes = [Taping(state, (320, 180))]
    moves = [("P", 10.0, 30.0), ("A", -20.0, -30.0), ("O4", 50.0, -60.0), ("B", 40.0, 5.0)]
    for n, move in enumerate(moves):
        for action in dragged(*move):
            state = advance(state, [Action(*action)])
            for take in takes:
                take.note(state.frame, (Action(*action),))
        if n == 1:
            takes.append(Taping(state, (320, 180)))
    for take in takes:
        document = json.loads(json.dumps(to_document(take.tape(state.frame))))
        tape = from_document(document, "drags.tape.json")
        *_, last = replace(tape, start=replace(tape.start, games=game_of)).states()
        assert (game(last).joints, game(last).points) == (game(state).joints, game(state).points)


@pytest.fixture
def player(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Player]:
    monkeypatch.chdir(tmp_path)
    with display.opened((640, 360)):
        player = Player(on("match level=circle"), keeper=Arcade(tmp_path / "scores.json"))
        player.tick(20)
        yield player
        player.window.close()


def test_it_is_played_by_the_mouse(player: Player) -> None:
    screen, view = player.window.screen, player.window.screen.last.view
    at = screen.pixel(*player.state.scene.pose(player.state.phase, 0).position["P"])
    player.drag(at, (at[0] + 20, at[1] - 10), (at[0] + 40, at[1] - 30))
    after = game(player.state)
    assert after.held is None
    x, y = screen.world(round(at[0] + 40), round(at[1] - 30))
    assert complex(round(x), round(y)) == after.joints.P
    # the curve stays where it is under the hand
    assert player.window.screen.last.view == view
    # a click beside the joints is no key: it stands still
    player.mouse(pygame.MOUSEBUTTONDOWN, (500, 20), button=1)
    player.mouse(pygame.MOUSEBUTTONUP, (500, 20), button=1)
    player.tick(5)
    before = player.state.phase
    assert player.state.clock.paused
    player.press(pygame.K_SPACE, 0, " ")
    player.tick(10)
    assert player.state.phase != before
    player.press(pygame.K_DOWN)
    player.tick()
    assert game(player.state).level == LEVELS[1]
    player.press(pygame.K_ESCAPE)
    assert not isinstance(player.state.game, MatchGame)
    assert player.state.home is None


def test_a_better_score_is_kept(player: Player) -> None:
    for action in (("grab", "P"), ("carry", (10.0, 10.0, 1.0)), ("drop",)):
        player.window.state = advance(player.state, [Action(*action)])
    total = sum(game(player.state).points)
    assert game(player.state).best == total > 0
    assert Action("score", f"best=match-circle:{total}") in player.state.effects


@pytest.mark.parametrize("seed", range(40))
def test_a_level_made_from_a_seed_is_solved_by_its_answer(seed: int) -> None:
    level = made(seed)
    assert level.answer
    assert level.worth_of_answer.shares(level.full) == (1.0, 1.0, 1.0)
    assert level.curve.size == pytest.approx(100, rel=0.02)
    again = made(seed)
    assert (again.curve.points == level.curve.points).all()
    assert game(on(f"match level=seed-{seed}")).points != (100, 100, 100)


BY_HAND = """
title = "Mine"
closed = false
points = [[-40, 0], [-20, 1], [0, 0], [20, -1], [40, 0]]
start = { O2 = [-60, -60], A = [-40, -40], B = [40, 20], O4 = [60, -60], P = [0, 0] }
full = { off = 1, links = 5, angle = "40 deg" }
"""

# What is wrong, in place of what is right, and what is said of it.
WRONG = {
    "a key of none": ('title = "Mine"', 'titel = "Mine"', "titel"),
    "no points": ("[[-40, 0], [-20, 1], [0, 0], [20, -1], [40, 0]]", "[[0, 0]]", "3 points"),
    "half a point": ("[-20, 1]", "[-20]", "points"),
    "a joint of none": ("closed = false", 'closed = false\nfixed = ["Q"]', "Q"),
    "a joint missing": (", P = [0, 0] ", " ", "P"),
    "a full score of nothing": ("off = 1", "off = 0", "full.off"),
    "an angle without unit": ('"40 deg"', '"40"', "40"),
}


def test_a_level_written_by_hand_is_played(tmp_path: Path) -> None:
    file = tmp_path / "mine.toml"
    file.write_text(BY_HAND, encoding="utf-8")
    state = on(f"match level={file}")
    assert game(state).of_level.title == "Mine"
    panel = game(state).panel(state)
    assert panel
    assert [choice.text for choice in panel.choices] == ["Begin again", "The next level"]


# a path as it is typed, and what of it could be taken for the end of it, or for a quote
@pytest.mark.parametrize(
    ("folder", "typed"),
    [
        ("my levels", "{}"),
        ("my levels", "'{}'"),
        ("my  own a=b levels", '"{}"'),
        ("under_score", "{}"),
        ("it's #1", '"{}"'),
        ("back\\slash", "{}"),
    ],
)
def test_a_level_s_path_may_have_blanks(folder: str, typed: str, tmp_path: Path) -> None:
    file = tmp_path / folder / "my level.toml"
    file.parent.mkdir()
    file.write_text(BY_HAND, encoding="utf-8")
    state = on(Arcade(tmp_path / "scores.json").completed(f"match level={typed.format(file)}"))
    assert game(state).level == str(file)
    # its words begin it again
    again = game_of(game(state).words)
    assert isinstance(again, MatchGame)
    assert again.level == str(file)


@pytest.mark.parametrize(("right", "wrong", "about"), WRONG.values(), ids=WRONG)
def test_a_level_that_makes_no_sense_says_where(right: str, wrong: str, about: str, tmp_path: Path) -> None:
    assert right in BY_HAND
    file = tmp_path / "wrong.toml"
    file.write_text(BY_HAND.replace(right, wrong), encoding="utf-8")
    with pytest.raises(BadInput, match=about) as raised:
        level_of(str(file))
    assert "\n" not in str(raised.value)


@pytest.mark.parametrize(
    "words",
    ["match level=none", "match joints=1,2", "match level=/nowhere/at.toml", "match level='a", "match a b=1"],
)
def test_words_that_make_no_sense_are_refused(words: str) -> None:
    with pytest.raises(BadInput):
        game_of(words)


def test_the_least_angle_is_the_solver_s() -> None:
    state = on("match level=hoecken")
    state = done(state, *dragged("A", -55.0, -55.0))
    least = state.scene.info.transmission_angle
    assert state.scene.info.full_turn
    assert least
    assert game(state).worth.angle == pytest.approx(least[0], abs=1e-9)


@pytest.mark.parametrize("level", level_names())
def test_doing_nothing_earns_nothing(level: str) -> None:
    state = on(f"match level={level}")
    assert game(state).points == (0, 0, 0)
    panel = game(state).panel(state)
    assert panel
    assert "until the coupler point runs along the dots" in panel.lines[0]
