"""Follow: the crank is turned so that the ram keeps to its lane; runs replay to the same score."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator
from dataclasses import replace
from importlib.resources import files
from itertools import pairwise
from pathlib import Path

import numpy as np
import pygame
import pytest
from playing import SIZE, Player
from shown_lists import game_in

from linkanim.errors import BadInput
from linkanim.picture.marks import Lane
from linkanim.play.arcade import Arcade
from linkanim.play.follow import (
    CONTROLS,
    LENGTH,
    LEVELS,
    FollowRun,
    RamTrack,
    is_track,
    read,
    track_of,
    tracks,
)
from linkanim.play.games import GameWords, game_of
from linkanim.player.action import Action
from linkanim.player.actions import advance
from linkanim.player.state import State, begin
from linkanim.player.tape import Taping
from linkanim.player.tape_file import from_document, to_document
from linkanim.scenes import load
from linkanim.scenes.scene import Scene
from linkanim.ui import screen
from linkanim.ui.pictures import Framing


def on(words: str) -> State:
    """A state with that run on."""
    state = replace(begin(load("crank-rocker")), games=game_of)
    return advance(state, [Action("play", words)])


def game(state: State) -> FollowRun:
    assert isinstance(state.game, FollowRun)
    return state.game


def towards(track: RamTrack, scene: Scene, place: float, phase: float) -> float:
    """Return the phase near by at which the ram is nearest to a place: what a steady hand does."""
    phases = phase + np.linspace(-1.2, 1.2, 241)
    low, high = track.limits
    off = np.abs((scene.solve(phase=phases, derivatives=0).travel[track.body] - low) / (high - low) - place)
    good = np.flatnonzero(off <= off.min() + 0.01)
    return float(phases[good[np.abs(phases[good] - phase).argmin()]])


def counted(state: State) -> State:
    """Return the state at the end of the count that the first turn of the crank begins."""
    state = advance(state, [Action("next")])
    while game(state).stage == "counts":
        state = advance(state)
    return state


def followed(state: State, frames: int) -> Iterator[tuple[State, Action]]:
    """Yield states in which the crank is turned after the lane, each with what was done."""
    for _ in range(frames):
        run = game(state)
        place = run.track.at(run.paper / 1e3 + 1.3)
        action = Action("scrub", towards(run.track, state.scene, place, state.phase))
        state = advance(state, [action])
        yield state, action


@pytest.mark.thinned(3)
@pytest.mark.parametrize("name", tracks())
def test_every_slider_scene_is_a_track_that_its_ram_can_follow(name: str) -> None:
    scene = load(name)
    assert is_track(scene)
    for level in range(1, LEVELS + 1):
        track = track_of(name, level)
        assert len(track.places) == LENGTH + 1
        assert all(0.0 <= place <= 1.0 for place in track.places)
        # no jump: what the lane asks for in a frame is well within its width
        assert max(abs(b - a) for a, b in pairwise(track.places)) < 0.75 * track.half_width
        assert abs(track.share(scene, 0.0) - track.at(0.0)) < 1e-6
        assert max(track.places) - min(track.places) > 0.9
    assert len({track_of(name, level).places for level in range(1, LEVELS + 1)}) == LEVELS


def test_scenes_without_a_ram_are_none() -> None:
    assert {"press", "crank-shaper", "slider-crank"} <= set(tracks())
    assert not {"crank-rocker", "driven-piston", "jansen"} & set(tracks())


@pytest.mark.parametrize("name", ["press", "crank-shaper", "toggle-press"])
def test_a_steady_hand_stays_between_the_lines(name: str) -> None:
    *_, (state, _) = followed(counted(on(f"follow scene={name}")), 400)
    run = game(state)
    assert run.stage == "runs"
    assert run.outside == 0
    assert run.passed == run.paper > 400_000


def test_a_crank_that_stands_still_uses_up_the_slack() -> None:
    state = advance(on("follow scene=press"), [Action("next")])
    effects = list[Action]()
    for _ in range(1_200):
        state = advance(state)
        effects += state.effects
        if game(state).stage == "over":
            break
    run = game(state)
    assert run.stage == "over"
    assert run.outside == 180
    assert 0 < run.passed < run.paper
    assert Action("score", f"best=follow-press.1:{run.passed // 1_000}") in effects
    # it is over: nothing scrolls any more
    assert game(advance(state, [Action("scrub", 1.0)])) == run


def test_the_arrow_keys_set_how_fast_the_crank_turns() -> None:
    state, phases = on("follow scene=crank-shaper"), []
    for steps in (1, 1, -10, 0):
        state = advance(state, [Action("turn", steps)] if steps else [Action("next")])
        before, state = state.phase, advance(state)
        phases.append(state.phase - before)
    way = math.copysign(math.radians(0.4), state.scene.linkage.drive.speed)
    assert phases == pytest.approx([way, 2 * way, -way, 0.0])


def test_it_counts_three_two_one_before_the_paper_scrolls() -> None:
    state, seen = advance(on("follow scene=press"), [Action("next")]), []
    while game(state).stage == "counts":
        panel = game(state).panel(state)
        assert panel
        seen.append(panel.heading)
        assert game(state).paper == 0
        state = advance(state)
    assert list(dict.fromkeys(seen)) == ["3", "2", "1"]
    assert len(seen) == 180
    assert game(advance(state)).paper > 0


def test_a_run_replays_to_the_same_score_from_its_start_and_from_its_midst() -> None:
    state = on("follow scene=crank-shaper level=2")
    takes = [Taping(state, (320, 180))]
    for n, (after, action) in enumerate(followed(state, 200)):
        for take in takes:
            take.note(after.frame, (action,))
        if n == 120:
            takes.append(Taping(after, (320, 180)))
        state = after
    for take in takes:
        document = json.loads(json.dumps(to_document(take.tape(state.frame))))
        tape = from_document(document, "run.tape.json")
        *_, last = replace(tape, start=replace(tape.start, games=game_of)).states()
        assert replace(game(last), is_within=True) == replace(game(state), is_within=True)


@pytest.mark.parametrize(
    ("best", "well", "words"),
    [
        pytest.param(0, False, "1.50 m, then its time was up; the best so far", id="the first run"),
        pytest.param(1_499, False, "1.50 m, then its time was up; the best so far", id="by a mm"),
        pytest.param(1_500, False, "1.50 m, then its time was up; the best was 1.50 m", id="as far"),
        pytest.param(2_250, False, "1.50 m, then its time was up; the best was 2.25 m", id="less far"),
    ],
)
def test_a_run_that_is_over_is_compared_with_the_best(best: int, well: bool, words: str) -> None:
    state = on("follow scene=press")
    run = replace(game(state), stage="over", passed=1_500_999, outside=90, paper=1_600_000, best=best)
    panel = run.panel(state)
    assert panel
    assert (panel.well, panel.verdict) == (well, words)
    assert [bar.words for bar in panel.bars] == ["1.50 m", "1.5 s"]
    assert run.level == 1
    whole = replace(run, paper=1_000 * LENGTH).panel(state)
    assert whole
    assert (whole.well, "to the end of the paper" in whole.verdict) == (True, True)


@pytest.mark.parametrize("size", [(1280, 720), (640, 360), (720, 1280)])
@pytest.mark.parametrize("name", ["pumpjack", "crank-shaper", "isosceles-slider", "knuckle-press", "press"])
def test_the_track_is_wholly_in_sight(name: str, size: tuple[int, int]) -> None:
    state, framing = on(f"follow scene={name}"), Framing(window=True)
    picture = framing.fitting(state, size)
    stage = picture.layout.stage
    for paper in range(0, 1_000 * LENGTH, 450_000):
        (shown,) = replace(game(state), paper=paper).drawn(state)
        (drawn,) = shown.behind(picture.drawing.setting, state.scene.pose(state.phase))
        points = np.concatenate([np.ravel(loop) for layer in drawn.layers for loop in layer.loops])
        assert stage.x <= points.real.min()
        assert points.real.max() <= stage.right
        assert stage.y <= points.imag.min()
        assert points.imag.max() <= stage.bottom


@pytest.mark.parametrize("name", ["slider-crank", "press", "whitworth"])
def test_the_track_has_no_corner(name: str) -> None:
    for level in range(1, LEVELS + 1):
        slopes = np.diff(track_of(name, level).places)
        assert np.abs(np.diff(slopes)).max() < 0.1 * np.abs(slopes).max()


def test_the_manual_has_the_keys_of_the_panel() -> None:
    manual = (files("linkanim") / "manual" / "games.md").read_text(encoding="utf-8")
    assert [f"| {keys} | {words} |" for keys, words in CONTROLS.items()] == [
        line for line in manual.splitlines() if line.startswith("| ") and "key, hand" not in line
    ]
    shown = game_in(on("follow scene=press stage=runs"))
    assert all(words in shown.hint for words in ("← → slower, faster", "drag the crank pin", "Space stop"))


def test_words_begin_a_run_where_it_is() -> None:
    *_, (state, _) = followed(on("follow scene=press level=3"), 50)
    assert read(GameWords.of(game(state).words)) == game(state)


WRONG = {
    "a scene without a ram": "follow scene=crank-rocker",
    "a level too many": "follow level=4",
    "no angle": "follow phase=nan",
}


@pytest.mark.parametrize("words", WRONG.values(), ids=WRONG)
def test_words_that_make_no_sense_are_refused(words: str) -> None:
    with pytest.raises(BadInput, match="follow"):
        game_of(words)


@pytest.fixture
def player(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Player]:
    monkeypatch.chdir(tmp_path)
    with screen.opened((2 * SIZE[0], 2 * SIZE[1])):
        player = Player(on("follow scene=slider-crank"), keeper=Arcade(tmp_path / "scores.json"))
        yield player
        player.window.close()


def test_it_is_played_by_mouse_and_keys(player: Player) -> None:
    player.tick(5)
    assert game(player.state).stage == "ready"
    pin = player.window.screen.crank_pin()
    player.drag(pin, (pin[0] + 30, pin[1] + 30))
    run = game(player.state)
    assert run.stage == "counts"
    assert run.phase != 0.0
    player.tick(180)
    player.press(pygame.K_RIGHT)
    assert game(player.state).notch == 1
    player.press(pygame.K_SPACE, 0, " ")
    assert game(player.state).notch == 0
    player.press(pygame.K_h, 0, "h")
    paper = game(player.state).paper
    player.tick(5)
    assert game(player.state).paper == paper  # it waits below the help
    player.press(pygame.K_ESCAPE)
    player.press(pygame.K_ESCAPE)
    assert not isinstance(player.state.game, FollowRun)


@pytest.mark.slow
def test_another_track_or_level_is_chosen_before_it_starts(player: Player) -> None:
    for _ in range(len(tracks())):
        player.press(pygame.K_DOWN)
        player.tick()
    assert player.state.scene.name == "slider-crank"
    player.press(pygame.K_DOWN)
    player.tick()
    assert player.state.scene.name == tracks()[tracks().index("slider-crank") + 1]
    player.press(pygame.K_3, 0, "3")
    player.tick()
    assert game(player.state).level == 3


def test_the_lane_is_drawn_where_the_ram_is() -> None:
    *_, (state, _) = followed(on("follow scene=press"), 60)
    (lane,) = game(state).drawn(state)
    assert isinstance(lane, Lane)
    ram = state.scene.pose(state.phase, 0).position["C"]
    back, forward = (complex(*place) for place in (lane.back, lane.forward))
    share = ((complex(*ram) - back) / (forward - back)).real
    now = min(lane.middle, key=lambda point: abs(point[0]))[1]
    assert share == pytest.approx(now, abs=lane.half_width)
