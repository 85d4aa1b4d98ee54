"""A path drawn in the window: strokes, the linkages that follow, what is dragged, kept, left, taped."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pygame
import pytest
from playing import CTRL, SHIFT, NoSearch, Player, the

from linkanim.picture.cognates import cognate_sides
from linkanim.picture.view import Rect
from linkanim.player import background as following
from linkanim.player.action import Action
from linkanim.player.actions import advance
from linkanim.player.background import actions_of, request_of
from linkanim.player.pencil import Pencil, cognate_at
from linkanim.player.state import MOVE_FRAMES, TOAST_FRAMES, PathSketch, State, begin
from linkanim.player.tape import Tape, Taping
from linkanim.player.tape_file import read, write
from linkanim.scenes import load
from linkanim.synthesis.answers import EARLIER, NUMBERS, PathAnswer
from linkanim.synthesis.follower import Reply
from linkanim.ui import screen
from linkanim.ui.shelf import answers_of

ROW = (9.0, 7.0, 30.0, 90.0, 45.0, 30.0, 100.0, 0.0, 80.0)
WIDER = (8.0, 9.0, 32.0, 95.0, 45.0, 30.0, 105.0, 5.0, 85.0)
FIRST, BETTER, OTHER = (
    PathAnswer(off, 1.0, 0.3, 1.0, row, size, angle).numbers
    for off, row, size, angle in ((1.5, ROW, 0.9, 0.7), (0.12, WIDER, 1.1, 0.5), (0.4, ROW, 0.9, 0.7))
)
LOOP = [(100 + 40 * math.cos(turn), 50 + 25 * math.sin(turn)) for turn in np.linspace(0, 6.2, 40)]


def after(state: State, *actions: Action | str) -> State:
    for one in actions:
        state = advance(state, [Action(one) if isinstance(one, str) else one])
    return state


def drawn(state: State, *, start: tuple[str, ...] = ("pencil",)) -> State:
    """Return the state after a loop was drawn with the pencil."""
    first, *others = LOOP
    moves = (Action("pen_to", place) for place in others)
    return after(state, *start, Action("pen_down", first), *moves, "pen_up")


def sketch_of(state: State) -> PathSketch:
    assert state.drawing
    return state.drawing


@pytest.fixture
def plain() -> State:
    return begin(load("crank-rocker"))


@pytest.fixture
def stroke(plain: State) -> State:
    return drawn(plain)


@pytest.fixture
def answered(stroke: State) -> State:
    return after(stroke, Action("follow", FIRST), Action("cards", (0.0, *BETTER, *OTHER)))


def test_a_stroke_that_ends_near_its_start_is_closed(plain: State, stroke: State) -> None:
    sketch = sketch_of(stroke)
    assert sketch.curve is not None
    assert (sketch.curve.closed, sketch.is_blank, sketch.pen) == (True, True, ())
    assert [effect.name for effect in stroke.effects] == ["search"]
    assert stroke.scene is plain.scene


def test_a_stroke_that_ends_elsewhere_is_open(plain: State) -> None:
    moves = [Action("pen_to", (10.0 * n, 3.0 * n * n)) for n in range(1, 9)]
    state = after(plain, "pencil", Action("pen_down", (0.0, 0.0)), *moves, "pen_up")
    curve = sketch_of(state).curve
    assert curve is not None
    assert not curve.closed
    assert (curve.points[0], curve.points[-1]) == pytest.approx((0.0, 80 + 192j))


@pytest.mark.parametrize("name", ["pen_off", "pen_up"])
def test_a_dot_is_no_stroke(plain: State, name: str) -> None:
    state = after(plain, "pencil", Action("pen_down", (3.0, 4.0)), name)
    assert (sketch_of(state).curve, sketch_of(state).pen, state.effects) == (None, (), ())


def test_the_first_answer_is_shown_at_once_and_glides_to_the_refined_one(stroke: State) -> None:
    first = after(stroke, Action("follow", FIRST))
    assert (sketch_of(first).off, first.scene.name, first.glide) == (1.5, "path", None)
    whole = after(first, Action("cards", (0.0, *BETTER, *OTHER)))
    assert (sketch_of(whole).off, len(sketch_of(whole).answers)) == (0.12, 2)
    assert whole.glide is not None
    settled = after(whole, *["direction"] * (MOVE_FRAMES + 1))
    assert settled.glide is None
    assert settled.scene.document["joints"]["A"]["length"] == 32.0


def test_lengths_of_an_answer_are_in_the_unit_of_the_scene_before(answered: State) -> None:
    assert answered.scene.length_unit == sketch_of(answered).before.length_unit
    in_metres = drawn(replace(begin(load("excavator"))))
    unit = in_metres.scene.length_unit
    assert after(in_metres, Action("follow", FIRST)).scene.length_unit == unit


def test_a_stroke_drawn_in_another_unit_has_answers_in_that_unit(plain: State) -> None:
    inches = drawn(after(plain, "unit"))
    state = after(inches, Action("follow", FIRST))
    assert inches.displayed.length_unit != plain.scene.length_unit
    assert state.scene.length_unit == inches.displayed.length_unit
    assert after(state, "unit").look == state.look


def test_another_answer_is_taken_by_its_number(answered: State) -> None:
    other = after(answered, Action("answer", 1))
    assert (sketch_of(other).chosen, sketch_of(other).off) == (1, 0.4)
    assert other.scene.document["joints"]["A"]["length"] == 30.0
    assert after(other, Action("answer", 7)) == replace(other, frame=other.frame + 1, touched=other.frame + 1)


def test_esc_goes_back_to_the_scene_that_was_on_as_if_it_had_gone_on(plain: State, answered: State) -> None:
    back = after(answered, "back")
    alone = plain
    while alone.frame < back.frame:
        alone = advance(alone)
    assert (back.scene, back.sketch, back.editing) == (alone.scene, None, alone.editing)
    assert back.phase == pytest.approx(alone.phase)


def test_a_kept_answer_is_the_scene_and_undo_brings_the_last_one_back(plain: State, answered: State) -> None:
    kept = after(answered, "keep")
    assert (kept.sketch, kept.scene) == (None, answered.scene)
    assert after(kept, "undo").scene == plain.scene
    opened = after(answered, "edit")
    assert (opened.sketch, opened.mode, opened.scene) == (None, "edit", answered.scene)


@pytest.mark.parametrize("name", ["mechanism", "put", "closure"])
def test_what_puts_another_scene_on_lays_the_pencil_down(answered: State, name: str) -> None:
    state = after(answered, Action(name, 1) if name in ("mechanism", "put") else name)
    assert state.sketch is None
    assert state.scene.name != "path"
    assert after(state, Action("mechanism", -1)).scene.name != "path"


def test_a_point_of_the_stroke_takes_its_neighbours_along_and_the_linkage_follows(answered: State) -> None:
    before = sketch_of(answered).curve
    assert before is not None
    to = before.points[10] + (5 + 3j)
    held = after(answered, Action("grasp_point", 10), Action("lead", (to.real, to.imag)))
    curve = sketch_of(held).curve
    assert curve is not None
    moved = np.abs(curve.points - before.points)
    assert curve.points[10] == pytest.approx(to)
    assert 0 < moved[13] < moved[11] < moved[10]
    assert moved[30] == 0
    assert [effect.name for effect in held.effects] == ["follow"]
    led = after(held, Action("follow", OTHER), "direction")
    assert (led.scene.document["joints"]["A"]["length"], sketch_of(led).off) == (30.0, 0.4)
    let_go = after(led, "let_go")
    assert [effect.name for effect in let_go.effects] == ["search"]
    assert (let_go.scene.goal, let_go.scene) == (None, led.scene)


def test_a_pivot_that_is_dragged_is_held_where_it_was_put(answered: State) -> None:
    state = after(answered, Action("grasp_pivot", "O4"), Action("lead", (110.0, 12.0)), "let_go")
    request = request_of(sketch_of(state), search=True)
    assert request is not None
    assert (list(request.pivots), request.near) == ([None, (110.0, 12.0)], BETTER)
    assert sketch_of(drawn(state.without(Pencil))).pivots == ()


def test_strokes_and_drags_are_taken_back_one_by_one(answered: State) -> None:
    held = after(answered, Action("grasp_point", 10), Action("lead", (9.0, 9.0)), Action("follow", OTHER))
    pinned = after(held, "let_go", Action("grasp_pivot", "O2"), Action("lead", (1.0, 2.0)), "let_go")
    drawn_again = drawn(replace(pinned, frame=pinned.frame), start=())
    found = after(drawn_again, Action("follow", FIRST))
    assert sketch_of(found).off == 1.5
    again = after(found, "undo_sketch")
    assert sketch_of(again).pivots == (("O2", (1.0, 2.0)),)
    bent = after(again, "undo_sketch")
    assert (sketch_of(bent).pivots, sketch_of(bent).off) == ((), 0.4)
    whole = after(bent, "undo_sketch")
    assert sketch_of(whole).curve is sketch_of(answered).curve
    assert whole.scene == answered.scene
    blank = after(whole, "undo_sketch")
    assert sketch_of(blank).is_blank
    assert after(blank, "undo_sketch", "undo").sketch == blank.sketch


def test_answers_that_come_while_something_is_dragged_wait_for_the_next(answered: State) -> None:
    held = after(answered, Action("grasp_point", 10), Action("cards", (1.0, *FIRST, *OTHER)))
    assert sketch_of(held).answers == sketch_of(answered).answers


def test_replies_to_another_stroke_are_dropped(answered: State) -> None:
    sketch = sketch_of(answered)
    one = Reply(sketch.strokes, whole=False, numbers=FIRST)
    assert [*actions_of(one, sketch)] == [Action("follow", FIRST)]
    assert [*actions_of(one._replace(stroke=sketch.strokes - 1), sketch)] == []
    none = Reply(sketch.strokes, whole=True, error="no room")
    assert [*actions_of(none, sketch)] == [Action("note", "no room")]
    assert [*actions_of(one, None)] == []
    whole = Reply(sketch.strokes, whole=True, numbers=(*FIRST, *OTHER), chosen=1, way=FIRST)
    cards, way = Action("cards", (1.0, *FIRST, *OTHER)), Action("way", (0.0, *FIRST))
    assert [*actions_of(whole, sketch)] == [cards, way]


def test_a_scene_s_own_trace_is_the_stroke_and_the_scene_is_among_the_answers(plain: State) -> None:
    own = after(plain, "own_trace")
    sketch = sketch_of(own)
    assert sketch.curve is not None
    assert (sketch.answer, sketch.off, own.scene) == (plain.scene, 0.0, plain.scene)
    request = request_of(sketch, search=True)
    assert request is not None
    assert request.near is None
    whole = after(own, Action("follow", FIRST), Action("cards", (0.0, *BETTER, *OTHER)))
    assert (whole.scene, len(sketch_of(whole).answers)) == (plain.scene, 3)
    bent = after(whole, Action("grasp_point", 3), Action("lead", (0.0, 0.0)))
    assert len(sketch_of(bent).answers) == 2


def test_the_scene_itself_is_no_second_answer_to_its_own_trace(plain: State) -> None:
    pins = [plain.scene.linkage.pin(name).position for name in ("O2", "O4")]
    same = PathAnswer(0.0, 1.0, 0.3, 1.0, (*pins[0], *ROW[2:6], *pins[1], ROW[8])).numbers
    whole = after(plain, "own_trace", Action("cards", (0.0, *same, *BETTER)))
    assert [one.off for one in sketch_of(whole).answers[1:]] == [0.12]  # type: ignore[union-attr]


def test_a_scene_without_a_trace_has_none_to_take(plain: State) -> None:
    bare = replace(plain, scene=replace(plain.scene, trace=()))
    state = after(bare, "own_trace")
    assert state.sketch is None
    assert state.toast is not None


# Values that no key or mouse gives, and a tape may hold.
NONSENSE = {
    "no answer": Action("cards", (0.0,)),
    "an answer cut off": Action("cards", (0.0, *BETTER[:-1])),
    "too few numbers": Action("follow", BETTER[:-1]),
    "half a point": Action("stroke", (1.0, 2.0)),
    "a stroke of no size": Action("stroke", (1.0, *(0.0, 0.0) * 5)),
    "a negative length": Action("follow", (*BETTER[:6], -3.0, *BETTER[7:])),
    "a place that is none": Action("grasp_point", -4),
    "a pin that is none": Action("grasp_pivot", "Z"),
    "an answer that is none": Action("cards", (9.0, *BETTER)),
}


@pytest.mark.parametrize("action", NONSENSE.values(), ids=NONSENSE)
def test_nonsense_leaves_the_scene_as_it_is(answered: State, action: Action) -> None:
    from linkanim.player.actions import is_taped

    if is_taped(action):
        state = after(answered, action)
        assert (state.scene, state.effects) == (answered.scene, ())


def test_a_recording_begun_in_a_sketch_begins_with_it(answered: State, tmp_path: Path) -> None:
    held = after(answered, Action("grasp_pivot", "O4"), Action("lead", (110.0, 12.0)), "let_go")
    taping = Taping(held, (1280, 720))
    taping.note(held.frame + 3, (Action("answer", 1),))
    write(taping.tape(held.frame + 5), tmp_path / "mine.tape.json")
    tape = read(tmp_path / "mine.tape.json")
    first, *_, last = tape.states()
    assert first.scene == held.scene
    assert first.phase == pytest.approx(held.phase)
    one, other = sketch_of(first), sketch_of(held)
    assert one.curve is not None
    assert other.curve is not None
    assert (one.answers, one.pivots, one.chosen) == (other.answers, other.pivots, other.chosen)
    assert (one.curve.points == other.curve.points).all()
    assert sketch_of(last).chosen == 1
    assert not tape.is_loop


def test_a_tape_has_what_was_found_and_searches_for_nothing(plain: State) -> None:
    actions = [Action("pencil"), Action("stroke", (1.0, *(part for at in LOOP for part in at)))]
    actions += [Action("follow", FIRST), Action("cards", (0.0, *BETTER, *OTHER))]
    tape = Tape(plain, 30, tuple((3 * n, one) for n, one in enumerate(actions, start=1)))
    *_, last = tape.states()
    assert sketch_of(last).off == 0.12


class InStep(NoSearch):
    """Replies in the place of the process: at once, and always the same."""

    def replies(self) -> Iterator[Reply]:
        asked, self.asked = self.asked, []
        for request in asked:
            yield Reply(request.stroke, whole=False, numbers=tuple(request.near or FIRST))
            if request.search:
                yield Reply(request.stroke, whole=True, numbers=(*BETTER, *OTHER))


@pytest.fixture
def in_step(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(following, "Following", InStep)


def loop(player: Player) -> list[tuple[float, float]]:
    width, height = player.window.screen.size
    turns = np.linspace(0, 6.2, 30)
    return [(width * (0.5 + 0.2 * math.cos(turn)), height * (0.5 + 0.2 * math.sin(turn))) for turn in turns]


def settle(player: Player) -> None:
    """Let what glides come to rest, and the view with it, which begins to move when it is seen."""
    player.tick(3)
    player.tick(2 * MOVE_FRAMES)
    player.tick(MOVE_FRAMES)


@pytest.mark.usefixtures("in_step")
def test_a_path_is_drawn_with_the_mouse_and_its_linkage_written(player: Player, here: Path) -> None:
    paused = player.pixels
    player.type("w")
    assert player.state.mode == "pencil"
    player.tick(MOVE_FRAMES)
    blank = player.pixels
    player.drag(*loop(player))
    assert player.pixels not in (paused, blank)
    player.tick(MOVE_FRAMES + 2)
    assert sketch_of(player.state).off == 0.12
    player.type("2")
    assert sketch_of(player.state).chosen == 1
    player.press(pygame.K_s, CTRL)
    player.press(pygame.K_RETURN)
    player.tick()
    assert load(here / "path.toml").linkage == player.state.scene.linkage
    player.press(pygame.K_ESCAPE)
    player.tick(TOAST_FRAMES)
    player.mouse(pygame.MOUSEMOTION, (1, 1), rel=(0, 0), buttons=(0, 0, 0))  # off what tells itself
    assert player.settle() == paused
    assert player.state.sketch is None


@pytest.mark.usefixtures("in_step")
def test_a_linkage_for_a_stroke_runs_at_once_whatever_was_paused(player: Player) -> None:
    assert player.state.clock.paused
    player.type("w")
    player.drag(*loop(player))
    player.tick()
    paused = [player.state.clock.paused]
    player.press(pygame.K_ESCAPE)
    assert [*paused, player.state.clock.paused] == [False, True]  # the scene from before is as it was


SHAPES = [(1280, 720), (640, 360), (480, 640)]


@pytest.mark.usefixtures("in_step", "here")
@pytest.mark.parametrize("size", SHAPES)
def test_stroke_linkage_cognates_and_cards_are_all_in_sight_and_0_brings_them_back(
    size: tuple[int, int],
) -> None:
    with screen.opened(size):
        player = Player(begin(load("crank-rocker")))
        player.type("w")
        player.drag(*loop(player))
        settle(player)
        sketch = sketch_of(player.state)
        assert any(sketch.cognates)

        def is_seen(turn: float) -> bool:
            view, pose = player.window.screen, player.state.scene.pose(turn, 0)
            bars = [side for n, one in enumerate(sketch.cognates) if one for side in cognate_sides(pose, n)]
            places = [*map(complex, *zip(*pose.position.values(), strict=True)), *sum(bars, ())]
            found = [view.pixel(at.real, at.imag) for at in (*sketch.points, *places)]
            stage = view.last.layout.stage
            low = min((one.place.y for one in view.targets("answer")), default=stage.bottom)
            return all(0 <= x <= size[0] and 0 <= y <= low for x, y in found)

        assert all(is_seen(0.1 * n) for n in range(63))
        player.mouse(pygame.MOUSEMOTION, (5, size[1] - 5), rel=(0, 0), buttons=(0, 0, 0))
        for _ in range(9):
            pygame.event.post(pygame.event.Event(pygame.MOUSEWHEEL, x=0, y=1))
            player.tick()
        box, view = player.window.screen.last.figure.box, player.window.screen
        (left, top), (right, low) = view.pixel(box.left, box.high), view.pixel(box.right, box.low)
        assert Rect(left, top, right - left, low - top).meets(Rect(0, 0, *size))
        player.type("0")
        settle(player)
        assert all(is_seen(0.1 * n) for n in range(63))
        player.window.close()


@pytest.mark.usefixtures("in_step")
@pytest.mark.slow
def test_points_pins_and_pictures_are_under_the_pencil(player: Player) -> None:
    player.type("w")
    player.drag(*loop(player))
    settle(player)
    sketch, screen = sketch_of(player.state), player.window.screen
    assert sketch.curve is not None
    point = sketch.curve.points[20]
    at = screen.pixel(point.real, point.imag)
    goal = complex(*screen.world(round(at[0] + 9), round(at[1] + 4)))
    player.mouse(pygame.MOUSEBUTTONDOWN, at, button=1)
    held = sketch_of(player.state).held
    there = at[0] + 9, at[1] + 4
    player.mouse(pygame.MOUSEMOTION, there, rel=(0, 0), buttons=(1, 0, 0))
    player.mouse(pygame.MOUSEBUTTONUP, there, button=1)
    dragged = sketch_of(player.state).curve
    assert dragged is not None
    assert isinstance(held, int)
    assert abs(held - 20) < 3
    assert dragged.points[held] == pytest.approx(goal)
    settle(player)
    pin = screen.pixel(*player.state.scene.pose(0.0, 0).position["O4"])
    player.drag(pin, (pin[0] + 6, pin[1] + 6))
    assert [name for name, _ in sketch_of(player.state).pivots] == ["O4"]
    settle(player)
    cells = [one.place for one in screen.targets("answer")]
    player.mouse(pygame.MOUSEBUTTONDOWN, (cells[1].x + 5, cells[1].y + 5), button=1)
    player.mouse(pygame.MOUSEBUTTONUP, (cells[1].x + 5, cells[1].y + 5), button=1)
    assert sketch_of(player.state).chosen == 1
    player.drag(*loop(player))
    assert sketch_of(player.state).strokes == 2


@pytest.mark.usefixtures("in_step")
def test_shift_w_takes_the_scene_s_own_trace(player: Player) -> None:
    player.press(ord("w"), SHIFT, "W")
    player.tick(3)
    assert len(sketch_of(player.state).answers) == 3
    assert player.state.scene.name == "crank-rocker"


@pytest.mark.long
@pytest.mark.slow
def test_the_process_answers_a_stroke(stroke: State) -> None:
    request = request_of(sketch_of(stroke), search=True)
    assert request is not None
    search = following.Following()
    try:
        search.ask(request)
        first, whole, last = search.wait(), search.wait(), search.wait()
    finally:
        search.close()
    assert first is not None
    assert whole is not None
    assert last is not None
    assert (first.whole, whole.whole, whole.error) == (False, True, None)
    assert whole.numbers[0] < 1.0
    assert last.numbers[0] <= first.numbers[0]
    for numbers in (first.numbers, whole.numbers, last.numbers, last.way):
        assert len(numbers) >= NUMBERS
        assert len(numbers) % NUMBERS == 0


NARROW = (9.0, 7.0, 29.0, 88.0, 44.0, 29.0, 98.0, 0.0, 79.0)


@pytest.fixture
def fronted(answered: State) -> State:
    """Answers, and three along the front: the last is of another closure, the first two of one family."""
    narrow = PathAnswer(0.3, 1.0, 0.4, 1.0, NARROW, 0.8, 0.8).numbers
    crossed = PathAnswer(0.9, -1.0, 0.3, 1.0, ROW, 0.7, 0.6).numbers
    return after(answered, Action("way", (0.0, *OTHER, *narrow, *crossed)))


def test_the_dial_goes_from_one_answer_over_to_the_next(fronted: State) -> None:
    sketch = sketch_of(after(fronted, Action("dial", 0.25)))
    assert sketch.dialled
    assert sketch.dialled.row == pytest.approx([(a + b) / 2 for a, b in zip(ROW, NARROW, strict=True)])
    assert (sketch.dialled.size, sketch.off) == pytest.approx((0.85, 0.35))


def test_the_dial_jumps_to_another_family_and_no_linkage_between_is_shown(fronted: State) -> None:
    before, then = (sketch_of(after(fronted, Action("dial", at))).dialled for at in (0.7, 0.8))
    assert before
    assert then
    assert (before.row, before.closure, then.row, then.closure) == (NARROW, 1.0, ROW, -1.0)


def test_the_dial_rests_at_an_answer_and_undo_takes_it_back(fronted: State) -> None:
    rest = after(fronted, Action("dial", 0.4), "let_go")
    assert (sketch_of(rest).dial, sketch_of(rest).held, sketch_of(rest).off) == (0.5, None, 0.3)
    assert rest.scene.document["joints"]["A"]["length"] == NARROW[2]
    back = after(rest, "undo_sketch")
    assert (sketch_of(back).dialled, sketch_of(back).off) == (None, 0.12)


def test_between_two_answers_the_crank_starts_between_theirs_the_short_way_round(answered: State) -> None:
    one, other = (PathAnswer(0.3, 1.0, start, 1.0, ROW, 0.8, 0.8).numbers for start in (6.2, 0.2))
    found = sketch_of(after(answered, Action("way", (0.0, *one, *other)), Action("dial", 0.5))).dialled
    assert found
    assert found.start == pytest.approx((6.2 + 0.2 + math.tau) / 2)


def test_a_way_of_two_answers_is_stepped_by_keys_too(answered: State) -> None:
    one, other = (PathAnswer(off, 1.0, 0.4, 1.0, ROW, 0.8, 0.8).numbers for off in (0.3, 0.4))
    two = after(answered, Action("way", (0.0, *one, *other)))
    assert sketch_of(after(two, Action("dial_on", 1))).dial == 1.0
    assert sketch_of(after(two, Action("dial_on", 1), Action("dial_on", -1))).dial == 0.0


def test_a_way_of_one_answer_has_no_dial(answered: State) -> None:
    one = after(answered, Action("way", (0.0, *FIRST)))
    assert len(sketch_of(one).way) == 1
    row = answers_of(one)
    assert row is not None
    assert row.dial is None
    for moved in (("dial_on", 1), ("dial", 1.0)):
        assert sketch_of(after(one, Action(*moved), "let_go")).answers == sketch_of(one).answers


def test_keys_step_the_dial_from_the_answer_that_is_shown(fronted: State) -> None:
    one = after(fronted, Action("dial_on", 1))
    assert sketch_of(one).dial == 0.5
    assert sketch_of(after(one, Action("dial_on", 1), Action("dial_on", 1))).dial == 1.0
    assert sketch_of(after(one, Action("dial_on", -5))).dial == 0.0


def test_a_card_puts_the_dial_where_its_answer_is(fronted: State) -> None:
    taken = after(fronted, Action("dial_on", 1), Action("answer", 1))
    assert (sketch_of(taken).dial, sketch_of(taken).dialled, sketch_of(taken).chosen) == (None, None, 1)
    assert taken.scene.document["joints"]["A"]["length"] == ROW[2]


def test_an_answer_that_was_taken_by_hand_stays_when_more_come(answered: State) -> None:
    taken = after(answered, Action("answer", 1))
    again = after(taken, Action("cards", (0.0, *FIRST, *BETTER)))
    assert sketch_of(again).answer == sketch_of(taken).answer
    assert len(sketch_of(again).answers) == 3


# more of them and fewer: its place among them is another, or was the last
@pytest.mark.parametrize(("number", "later"), [(2, (*OTHER, *FIRST)), (3, FIRST), (0, FIRST)])
def test_an_answer_taken_beside_the_scene_whose_trace_it_follows_stays_when_others_come(
    plain: State, number: int, later: tuple[float, ...]
) -> None:
    three = after(plain, "own_trace", Action("cards", (0.0, *FIRST, *BETTER, *OTHER)))
    taken = after(three, Action("answer", number))
    again = after(taken, Action("cards", (0.0, *later)))
    assert sketch_of(again).answer == sketch_of(taken).answer
    assert again.scene == taken.scene
    row = answers_of(again)
    assert row
    assert row.entries[row.chosen] == sketch_of(taken).answer


OWN, EXACT, COMPACT = (
    ("", "its own"),
    ("most exact", "0.12 % · ×1.1 · 29°"),
    ("most compact", "0.4 % · ×0.9 · 40°"),
)


def _said(state: State) -> list[tuple[str, str]]:
    """Return the words on the cards."""
    row = answers_of(state)
    assert row
    return [*zip(row.names, row.words, strict=True)]


def test_a_card_says_what_its_answer_is_among_them(plain: State, answered: State) -> None:
    assert _said(answered) == [EXACT, COMPACT]
    own = after(plain, "own_trace", Action("cards", (0.0, *BETTER, *OTHER)))
    assert _said(own) == [OWN, EXACT, COMPACT]


def test_cards_say_so_too_where_the_scene_itself_was_found_for_its_trace(plain: State) -> None:
    pins = [plain.scene.linkage.pin(name).position for name in ("O2", "O4")]
    same = PathAnswer(0.0, 1.0, 0.3, 1.0, (*pins[0], *ROW[2:6], *pins[1], ROW[8]), 0.9, 0.7).numbers
    own = after(plain, "own_trace", Action("cards", (0.0, *same, *BETTER, *OTHER)))
    assert _said(own) == [OWN, EXACT, COMPACT]
    later = after(own, Action("cards", (0.0, *same, *OTHER, *BETTER)))
    assert _said(later) == [OWN, COMPACT, EXACT]


def test_cards_of_an_older_tape_say_how_far_each_is_off(stroke: State) -> None:
    bare = [one[:EARLIER] for one in (BETTER, OTHER)]
    assert _said(after(stroke, Action("answers", (0.0, *bare[0], *bare[1])))) == [
        ("", "0.12 %"),
        ("", "0.4 %"),
    ]


def test_a_cognate_takes_the_place_of_the_answer_and_traces_the_same_curve(answered: State) -> None:
    before = sketch_of(answered)
    # of a crank-rocker one is another, the other a double-rocker
    assert the(answered, Pencil).cognate_numbers == (0,)
    taken = after(answered, Action("cognate", 0))
    after_, answer = sketch_of(taken), sketch_of(taken).answer
    assert isinstance(answer, PathAnswer)
    assert (after_.off, len(after_.answers), after_.picked) == (before.off, 2, True)
    assert answer.row != WIDER
    places = np.linspace(0, 2 * math.pi, 40)
    ways = [one.scene.solve(phase=places, derivatives=0).position["P"] for one in (answered, taken)]
    assert ways[0] == pytest.approx(ways[1], abs=1e-9)
    assert after(taken, "undo_sketch").scene.linkage == answered.scene.linkage


def test_the_cognate_of_a_cognate_is_the_answer_itself(answered: State) -> None:
    again = sketch_of(after(answered, Action("cognate", 0), Action("cognate", 0)))
    assert isinstance(again.answer, PathAnswer)
    assert again.answer.row == pytest.approx(WIDER)


def test_a_cognate_leaves_the_dial_where_it_is(fronted: State) -> None:
    rest = after(fronted, Action("dial", 0.5), "let_go")
    row = answers_of(after(rest, Action("cognate", 0)))
    assert row
    assert row.dial
    assert row.dial.value == 0.5


def test_a_cognate_that_is_far_larger_is_not_shown(answered: State) -> None:
    large = answered.with_mode(replace(sketch_of(answered), answers=(_sized(3.0), _sized(0.5))))
    assert [*map(bool, sketch_of(large).cognates)] == [True, False]
    many = PathAnswer(0.12, 1.0, 0.3, 1.0, (0.0, 0.0, 10.0, 40.0, 300.0, 20.0, 42.0, 0.0, 30.0), 3.0, 0.5)
    shown = sketch_of(answered.with_mode(replace(sketch_of(answered), answers=(many,))))
    assert all(one is None or one.size <= 3.0 for one in shown.cognates)


def _sized(size: float) -> PathAnswer:
    return PathAnswer(0.12, 1.0, 0.3, 1.0, WIDER, size, 0.5)


def test_without_an_answer_there_is_no_cognate(plain: State, stroke: State) -> None:
    for state in (plain, stroke):
        assert after(state, Action("cognate", 0)).sketch == state.sketch
    own = after(plain, "own_trace", Action("cognate", 0))
    assert own.scene is plain.scene


@pytest.mark.usefixtures("in_step")
def test_a_click_on_a_faint_linkage_takes_it_and_a_stroke_begun_there_is_drawn(player: Player) -> None:
    pygame.display.set_mode((1280, 720), pygame.RESIZABLE)
    player.type("w")
    player.drag(*loop(player))
    settle(player)
    screen, before = player.window.screen, sketch_of(player.state)
    pose = player.state.displayed.pose(player.state.phase, 0)
    places = [
        begin + share / 9 * (end - begin) for begin, end in cognate_sides(pose, 0) for share in range(9)
    ]
    pixels = [screen.pixel(one.real, one.imag) for one in places]
    at = next(one for one in pixels if the(player.state, Pencil).begun(screen, *one, 30).name == "pen_down")
    assert cognate_at(screen, *at, 10) == 0
    player.mouse(pygame.MOUSEBUTTONDOWN, at, button=1)
    player.mouse(pygame.MOUSEBUTTONUP, at, button=1)
    taken = sketch_of(player.state)
    assert taken.answer != before.answer
    assert taken.off == before.off
    player.press(pygame.K_f, text="f")
    assert sketch_of(player.state).answers[0].row == pytest.approx(before.answers[0].row)  # type: ignore[union-attr]
    player.drag(at, *loop(player))
    assert sketch_of(player.state).strokes == before.strokes + 1


def test_answers_of_an_older_tape_come_without_figures(stroke: State) -> None:
    older = after(stroke, Action("answers", (0.0, *BETTER[:-2], *OTHER[:-2])))
    assert [one.size for one in sketch_of(older).answers if isinstance(one, PathAnswer)] == [0.0, 0.0]
    assert sketch_of(older).names == ()


@pytest.mark.usefixtures("in_step")
@pytest.mark.parametrize("key", ["w", "f2", "f4"])
def test_blank_paper_is_drawn_on_where_a_chart_was(player: Player, key: str) -> None:
    pygame.display.set_mode((900, 500), pygame.RESIZABLE)
    player.window.state = advance(player.state, [Action("plot", "rocker.angle")])
    player.settle()
    chart, phase = player.window.screen.last.layout.chart, player.state.phase
    assert chart
    player.press({"w": pygame.K_w, "f2": pygame.K_F2, "f4": pygame.K_F4}[key])
    player.settle()
    middle = chart.middle.real, chart.middle.imag
    assert player.window.screen.charted(*middle) is None
    player.drag(middle, *((middle[0] + 6 * n, middle[1] - 2 * n) for n in range(8)))
    assert player.state.phase == phase
    begun: dict[str, Callable[[Any], bool]] = {
        "w": lambda state: state.drawing.curve is not None,
        "f2": lambda state: state.look.pan != (0.0, 0.0),
        "f4": lambda state: len(state.posing.poses) == 1,
    }
    assert begun[key](player.state)
