"""The layers in which a scene can be made, in the window: shown, lifted, asked for again, taped, written."""

from __future__ import annotations

import json
import os
import time
from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import ClassVar

import numpy as np
import pygame
import pytest
from playing import SHIFT, Player, bar_cells_in, fake_start, menu_in, the
from shown_lists import drawn_in

from linkanim.export import json_text
from linkanim.picture.build_sheet import Head
from linkanim.picture.constructed import all_steps, shown_at
from linkanim.picture.drawn import Additions
from linkanim.picture.layered import LayerView
from linkanim.picture.look import Look
from linkanim.picture.picture import Picture
from linkanim.picture.slider import Slider, slider_rect
from linkanim.picture.view import Rect
from linkanim.player import background
from linkanim.player.action import Action
from linkanim.player.actions import advance
from linkanim.player.background import Making
from linkanim.player.commands import bar
from linkanim.player.listing import Listing
from linkanim.player.making import LIFTED, Layering
from linkanim.player.modes import KEYS_OF
from linkanim.player.state import State, begin
from linkanim.player.tape import Taping
from linkanim.scenes import load
from linkanim.scenes.scene import TimeRatioPurpose
from linkanim.synthesis.guidance import guide
from linkanim.synthesis.quick_returns import quick_return
from linkanim.ui import screen
from linkanim.ui.pictures import beside
from linkanim.workshop.request import make


def made_text(name: str) -> str:
    return json_text(make(load(name), fit="A4").as_object())


def after(state: State, *actions: Action | str) -> State:
    for one in actions:
        state = advance(state, [Action(one) if isinstance(one, str) else one])
    return state


@pytest.fixture(scope="module")
def text() -> str:
    return made_text("jansen")


def is_alone(state: State) -> bool:
    """Tell whether something is drawn in the linkage's place."""
    return any(one.alone for one in beside(state).drawn)


@pytest.fixture
def shown(text: str) -> State:
    return after(begin(load("jansen")), "layers", Action("layered", text))


def test_layers_are_asked_for_at_once_and_shown_when_they_are_found(text: str) -> None:
    waiting = after(begin(load("jansen")), "layers")
    assert [effect.name for effect in waiting.effects] == ["layers"]
    assert (waiting.mode, drawn_in(waiting, Slider)) == ("layers", None)
    found = after(waiting, Action("layered", text))
    slider, head, parts = drawn_in(found, Slider), drawn_in(found, Head), the(found, Layering).parts
    assert parts is not None
    assert slider is not None
    assert (parts.layers, len(parts.plates), slider.at, is_alone(found)) == (3, 8, 0, True)
    assert head
    assert "3 layers on the ground" in head.sentence


@pytest.mark.parametrize("name", ["jansen", "press", "scotch-yoke"])
def test_what_is_read_back_is_drawn_as_what_was_made(name: str) -> None:
    made = make(load(name), fit="A4")
    state = after(begin(load(name)), "layers", Action("layered", json_text(made.as_object())))
    assert state.of(Layering)
    assert the(state, Layering).parts
    read, drawn = the(state, Layering).parts, made.layered
    assert read
    assert read.ratio == pytest.approx(drawn.ratio)
    by_number = {plate.number: plate for plate in read.plates}
    pose = made.scene.pose(1.0, 0)
    for plate in drawn.plates:
        other = by_number[plate.number]
        assert (plate.layer, plate.toothed) == (other.layer, other.toothed)
        assert len(plate.loops) == len(other.loops)
        (at, way), (place, turn) = read.lying([plate.frame, other.frame], pose, made.scene.length_unit)
        assert (place, turn) == pytest.approx((at, way))
        one, two = (box_of(loops[0]) for loops in (plate.loops, other.loops))
        assert two == pytest.approx(one, abs=0.2)
    assert sorted((pin.low, pin.high) for pin in read.pins) == sorted(
        (pin.low, pin.high) for pin in drawn.pins
    )


def box_of(loop: np.ndarray) -> tuple[float, float, float, float]:
    return float(loop.real.min()), float(loop.real.max()), float(loop.imag.min()), float(loop.imag.max())


def test_what_cannot_be_made_is_said_in_a_sentence() -> None:
    state = after(begin(load("drag-link")), "layers", Action("layered", made_text("drag-link")))
    head = drawn_in(state, Head)
    assert head is not None
    assert not is_alone(state)
    assert head.is_warning
    assert "cannot be made flat" in head.sentence
    assert drawn_in(state, Slider) is None


@pytest.mark.parametrize(
    "damaged",
    ["{", "[]", '{"parts": 1}', '{"scale": 1, "parts": [], "fittings": [], "pins": [], "dowels": []}'],
)
def test_a_tape_with_damaged_layers_shows_none(damaged: str) -> None:
    state = after(begin(load("jansen")), "layers", Action("layered", damaged))
    assert state.of(Layering)
    assert the(state, Layering).parts is None
    assert state.toast is not None
    assert "the layers" in state.toast.text


def test_layers_of_another_scene_are_refused(text: str) -> None:
    state = after(begin(load("crank-rocker")), "layers", Action("layered", text))
    assert state.of(Layering)
    assert the(state, Layering).parts is None
    assert state.toast is not None
    assert "a joint that the linkage does not have" in state.toast.text


def test_layers_are_lifted_step_by_step_from_flat_to_all_the_room(shown: State) -> None:
    assert after(shown, Action("lift", -1)).of(Layering) == shown.of(Layering)
    high = after(shown, *[Action("lift", 1)] * (LIFTED + 3)).of(Layering)
    slid = after(shown, Action("slide", LIFTED)).of(Layering)
    assert high == slid
    assert high is not None
    assert high.lifted == LIFTED


def test_another_scene_has_its_layers_asked_for_and_stays_lifted(shown: State) -> None:
    state = after(shown, Action("slide", 7), Action("mechanism", 1), "direction")
    assert state.of(Layering)
    assert (the(state, Layering).parts, the(state, Layering).lifted) == (None, 7)
    assert the(state, Layering).scene is state.scene


def test_another_scene_is_not_shown_in_the_parts_of_the_one_before(shown: State) -> None:
    other = after(shown, Action("put", 0))
    head = drawn_in(other, Head)
    assert head
    assert not is_alone(other)
    assert head.sentence.startswith(other.scene.title)
    assert drawn_in(other, Slider) is None
    picture = Picture(other.scene, (320, 180), Look(hud=False))
    assert list(picture.groups(other.scene.pose(0.0), beside(other)))


@pytest.mark.parametrize("name", ["edit", "pencil", "build"])
def test_what_is_done_with_the_linkage_shows_it_again(shown: State, name: str) -> None:
    assert after(shown, name).of(Layering) is None


def test_esc_goes_back_to_the_linkage(shown: State) -> None:
    state = after(shown, "back")
    assert (state.of(Layering), state.scene) == (None, shown.scene)


def test_a_linkage_on_a_sheet_is_kept_for_its_layers() -> None:
    state = after(begin(load("crank-rocker")), "build_on", "layers")
    assert state.sheet is not None
    assert not state.building
    assert state.of(Layering)
    assert the(state, Layering).scene is state.scene


def test_a_draft_that_cannot_move_cannot_be_made() -> None:
    state = after(begin(load("crank-rocker")), "build", "make")
    assert [effect.name for effect in state.effects] == []
    assert state.toast is not None
    assert "only what can move can be made" in state.toast.text


def test_a_tape_that_begins_amid_layers_has_them(shown: State) -> None:
    state = after(shown, Action("slide", 5))
    taping = Taping(state, (640, 360))
    begun = taping.tape(state.frame).begun
    assert begun.of(Layering)
    assert the(begun, Layering).parts is not None
    assert the(begun, Layering).lifted == 5


@pytest.mark.parametrize("mode", ["play", "paused", "pencil", "build", "layers"])
def test_the_list_of_commands_makes_the_parts_in_every_mode(mode: str) -> None:
    assert Action("make") in [action for *_, action in KEYS_OF[mode].commands]


@pytest.mark.parametrize("apart", [0.0, 0.3, 1.0])
def test_all_that_moves_stays_in_its_room_at_every_lift(shown: State, apart: float) -> None:
    assert shown.of(Layering)
    assert the(shown, Layering).parts
    parts, room = the(shown, Layering).parts, Rect(20, 30, 500, 300)
    assert parts
    view = LayerView.fitting(parts.reach, parts.layers, apart, room)
    for phase in np.linspace(0, 2 * np.pi, 24):
        pose = parts.scene.pose(float(phase), 0)
        for plate in parts.plates:
            ((at, turn),) = parts.lying([plate.frame], pose, parts.scene.length_unit)
            seen = view.seen(at + turn * plate.loops[0], plate.layer)
            assert room.inset(-2).holds(seen.real.min(), seen.imag.min())
            assert room.inset(-2).holds(seen.real.max(), seen.imag.max())


class _Found:
    """Stands where `linkanim make` would."""

    text = ""
    started: ClassVar[list[Path | None]] = []

    def __init__(self, scene: object, words: object, folder: Path | None = None) -> None:
        self.scene, self.done = scene, True
        self.started.append(folder)

    def result(self) -> str:
        return self.text

    def words(self) -> str:
        return "the parts are written"

    def close(self) -> None:
        pass


@pytest.fixture
def player(monkeypatch: pytest.MonkeyPatch, text: str, here: Path) -> Iterator[Player]:
    monkeypatch.setattr(_Found, "text", text)
    monkeypatch.setattr(_Found, "started", [])
    monkeypatch.setattr(background, "Making", _Found)
    with screen.opened((640, 360)):
        player = Player(begin(load("jansen")))
        yield player
        player.window.close()


def test_the_keys_show_the_layers_and_write_the_parts(player: Player) -> None:
    before = player.pixels
    player.press(pygame.K_F6)
    player.tick()
    assert player.state.of(Layering)
    assert the(player.state, Layering).parts
    assert player.pixels != before
    player.press(pygame.K_RETURN)
    player.press(pygame.K_F6, SHIFT)
    player.tick(2)
    assert _Found.started == [None, Path("jansen-parts"), Path("jansen-parts")]
    assert player.state.toast is not None
    assert player.state.toast.text == "the parts are written"


def test_the_slider_is_dragged(player: Player) -> None:
    player.press(pygame.K_F6)
    player.tick()
    rect = slider_rect(player.window.screen.last.layout)
    row = rect.middle.imag
    player.drag((rect.x + 15, row), (rect.right + 40, row))
    assert player.state.of(Layering)
    assert the(player.state, Layering).lifted == LIFTED
    player.drag((rect.right - 15, row), (rect.x, row + 80))
    assert the(player.state, Layering).lifted == 0
    assert player.state.look == replace(player.state.look, pan=(0.0, 0.0))


@pytest.mark.slow
def test_parts_of_what_is_on_are_found_and_written_by_a_process_beside(here: Path) -> None:
    scene = replace(load("crank-rocker"))
    found, written = Making(scene, ("--fit", "A4")), Making(scene, ("--fit", "A4"), here / "rocker-parts")
    for making in (found, written):
        for _ in range(600):
            if making.done:
                break
            time.sleep(0.1)
    assert json.loads(found.result())["layers"] == 2
    assert "saved: 4 parts in 2 layers" in written.words()
    assert (here / "rocker-parts" / "assembly.html").exists()
    # what another has put there is not written over
    (here / "taken").mkdir()
    (here / "taken" / "assembly.html").write_text("mine")
    refused = Making(scene, (), here / "taken")
    while not refused.done:
        time.sleep(0.1)
    assert "assembly.html" in refused.words()
    assert "saved" not in refused.words()
    for making in (found, written, refused):
        making.close()


@pytest.mark.parametrize("said", [b"", b'{"layers": 2, "pla'])
def test_an_answer_that_is_cut_off_is_no_layers(said: bytes, monkeypatch: pytest.MonkeyPatch) -> None:
    def start(command: list[str], message: int, out: int) -> object:
        os.write(out, said)
        return fake_start([])(command, message)

    monkeypatch.setattr(background, "_start", start)
    found, written = Making(load("kite"), ()), Making(load("kite"), (), Path("kite-parts"))
    assert json.loads(found.result()) == {"refused": "the search for layers has ended"}
    assert " saved: " in written.words()
    for making in (found, written):
        making.close()


@pytest.fixture
def guided() -> State:
    rows = [(0, 0, 0), (40, 10, 0.6), (70, -5, 1.4)]
    return begin(guide(rows, count=1)[0].scene)


def test_the_construction_is_drawn_step_by_step_and_goes_after_the_last(guided: State) -> None:
    seen, state = [], guided
    # its synthesis, its instant centres, its dead centres if it has some
    count = all_steps(guided.scene)
    assert count >= 6 + 5
    for _ in range(count + 1):
        state = after(state, Action("construct", 1))
        seen.append(beside(state).steps)
    assert seen == [*range(1, count + 1), 0]
    assert beside(after(guided, Action("construct", -1))).steps == count


@pytest.fixture
def large(here: object) -> Iterator[Player]:
    del here
    with screen.opened((900, 500)):
        player = Player(begin(load("crank-rocker")))
        yield player
        player.window.close()


def kind_of(player: Player) -> tuple[str, int]:
    """Return the construction that is drawn, and how many of its steps."""
    kind, steps, _ = shown_at(player.state.scene, player.state.constructed, player.state.phase)
    return kind, len(steps)


def click(player: Player, icon: str) -> None:
    """Click the button of the bar with an icon."""
    player.mouse(pygame.MOUSEMOTION, (5, 5), rel=(0, 0), buttons=(0, 0, 0))
    cells, buttons = bar_cells_in(player.window.screen), bar(player.state)
    (at,) = (cell.middle for cell, one in zip(cells, buttons, strict=True) if one.icon == icon and cell)
    player.mouse(pygame.MOUSEMOTION, (at.real, at.imag), rel=(0, 0), buttons=(0, 0, 0))
    player.drag((at.real, at.imag))


# The first of a crank-rocker is that of its dead centres. However it was begun, there are three ways out.
OUT: dict[str, Callable[[Player], object]] = {
    "Esc": lambda player: player.press(pygame.K_ESCAPE),
    "the arrow back": lambda player: click(player, "back"),
    "done": lambda player: click(player, "done"),
}


@pytest.mark.parametrize("way", OUT)
def test_a_construction_is_left_at_once(large: Player, way: str) -> None:
    for _ in range(3):
        large.press(pygame.K_F7)
    assert kind_of(large) == ("dead-centres", 3)
    OUT[way](large)
    assert (large.state.constructed, large.state.toast, large.state.mode) == (0, None, "play")
    large.press(pygame.K_ESCAPE)
    assert large.state.toast
    assert large.state.toast.text == "Q quits"


def test_the_steps_of_a_construction_go_both_ways_by_keys_and_by_mouse(large: Player) -> None:
    large.press(pygame.K_F7)
    for further, back in (
        (partial(large.press, pygame.K_F7), partial(large.press, pygame.K_F7, SHIFT)),
        (partial(click, large, "after"), partial(click, large, "before")),
    ):
        further()
        assert kind_of(large) == ("dead-centres", 2)
        back()
        assert kind_of(large) == ("dead-centres", 1)


@pytest.mark.parametrize(
    ("typed", "kind"), [("construction dead", "dead-centres"), ("instant constr", "centres")]
)
def test_a_construction_is_found_by_its_name_among_all_commands(large: Player, typed: str, kind: str) -> None:
    large.press(pygame.K_F10)
    large.type(typed)
    large.press(pygame.K_RETURN)
    assert kind_of(large) == (kind, 1)
    assert large.state.of(Listing) is None


@pytest.mark.parametrize("what", ["link crank", "construction"])
def test_a_menu_of_what_it_is_about_has_each_construction(large: Player, what: str) -> None:
    state = after(large.state, Action("menu", what))
    assert state.of(Listing)
    names = [row.words for row in menu_in(state).matches if row.action.name == "construction"]
    assert names == ["construction of its dead centres", "construction of its instant centres"]


def test_the_construction_of_another_scene_is_not_drawn(guided: State) -> None:
    state = after(guided, Action("construct", 2), Action("mechanism", 1))
    assert beside(state).steps == 0
    told = after(begin(load("press")), Action("construct", 1))
    assert told.toast is not None
    assert "has no construction" in told.toast.text


def test_a_tape_has_the_steps_of_a_construction(guided: State) -> None:
    state = after(guided, Action("construct", 3))
    begun = Taping(state, (640, 360)).tape(state.frame).begun
    assert beside(begun).steps == 3


def test_the_picture_says_what_is_done_in_a_step(guided: State) -> None:
    scene = guided.scene
    picture = Picture(scene, (640, 360), Look(hud=False))
    groups = picture.groups(scene.pose(0.0), Additions(steps=3))
    said = [line.text for group in groups for line in group.captions]
    assert any("midperpendiculars" in line for line in said)
    assert any(line.startswith("step 3 of 6") for line in said)


# The family of a time ratio, on a slider beside its construction.

FAMILIES = {
    "slider-crank": {"stroke": 80.0, "ratio": 1.4},
    "centric": {"stroke": 80.0, "ratio": 1.0},
    "crank-rocker": {"swing": np.radians(60), "ratio": 1.2},
}


@pytest.fixture(params=FAMILIES)
def returning(request: pytest.FixtureRequest) -> State:
    scene = quick_return(count=1, **FAMILIES[request.param])[0].scene
    return after(begin(scene), Action("construct", 3))


def test_a_slider_beside_alts_construction_goes_along_the_family(returning: State) -> None:
    slider, purpose = drawn_in(returning, Slider), returning.scene.purpose
    assert slider is not None
    assert isinstance(purpose, TimeRatioPurpose)
    # without a quick return the longest coupler transmits best
    assert 0 < slider.at <= slider.steps
    for step in (slider.steps // 3, slider.steps, 0):
        returning = after(returning, Action("slide", step))
        shown, info = drawn_in(returning, Slider), returning.scene.info
        assert beside(returning).steps == 3
        assert shown is not None
        assert shown.at == step
        assert (info.time_ratio or 1.0) == pytest.approx(purpose.ratio, abs=1e-9)
        assert info.stroke == pytest.approx(purpose.stroke) if purpose.stroke else True


def test_undo_goes_back_to_where_the_slider_was_taken(returning: State) -> None:
    slid = after(returning, Action("slide", 30), Action("slide", 31), Action("slide", 32), "drop")
    assert slid.held is None
    assert slid.scene != returning.scene
    assert after(slid, "undo").scene == returning.scene


def test_keys_go_along_the_family_in_steps(returning: State) -> None:
    begun = after(returning, Action("slide", 40), "drop")
    further = drawn_in(after(begun, Action("dial_on", 2)), Slider)
    assert further is not None
    assert further.at == 42


def test_a_scene_of_no_time_ratio_has_no_slider(guided: State) -> None:
    state = after(guided, Action("construct", 2))
    assert drawn_in(state, Slider) is None
    assert after(state, Action("dial_on", 1)).scene is state.scene
