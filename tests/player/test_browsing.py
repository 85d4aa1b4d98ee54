"""The list of quantities and the shelf: what is found, what is picked, and what a tape keeps of it."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import pygame
import pytest
from playing import SIZE, Player, fake_start, the
from shown_lists import words_in

from linkanim.picture.quantities import quantity
from linkanim.player.action import Action
from linkanim.player.actions import advance
from linkanim.player.browsing import Grid
from linkanim.player.browsing import grid as shelf_grid
from linkanim.player.commands import Entries, ListRow
from linkanim.player.listing import Listing, listed
from linkanim.player.shelving import OpenShelf
from linkanim.player.state import State, begin
from linkanim.player.tape_file import read
from linkanim.scenes import Scene, load, names
from linkanim.ui import screen


def after(state: State, *actions_: Action | str) -> State:
    for one in actions_:
        state = advance(state, [Action(one) if isinstance(one, str) else one])
    return state


@pytest.fixture
def press() -> State:
    return begin(load("press"))


# Quantities without a value anywhere in a cycle: the ram goes straight, the platform does not turn.
VALUELESS = {
    "crank-rocker": set[str](),
    "press": {"C.curvature_radius"},
    "parallelogram": {"coupler.pole", "coupler.pole.x", "coupler.pole.y"},
}


@pytest.mark.parametrize("name", VALUELESS)
def test_the_list_holds_every_quantity_with_a_value_once_the_telling_ones_first(name: str) -> None:
    scene = load(name)
    tokens = listed(scene, "")
    assert sorted(tokens) == sorted({*scene.quantities} - VALUELESS[name])
    assert tokens[: len(scene.telling)] == scene.telling


@pytest.mark.thinned(8)
@pytest.mark.parametrize("name", names())
def test_every_row_of_k_has_symbol_value_and_unit(name: str) -> None:
    with screen.opened(SIZE):
        player = Player(begin(load(name)))
        player.type("k")
        told = words_in(player.state)
        while told and told.chosen < len(told.rows) - 1:
            for words, text in told.rows[max(told.chosen - 9, 0) : told.chosen + 10]:
                plain = words == "Mechanical advantage"  # a ratio without a unit
                assert re.fullmatch(
                    r"\S.* = [−\d.,∞ ]+(×10[⁻⁰¹²³⁴-⁹]+)?" + ("" if plain else "(°|[a-zN/² ]+)"), text
                ), words
            player.press(pygame.K_PAGEDOWN)
            told = words_in(player.state)
        player.window.close()


# What is typed is looked for in token, words and symbol, word by word, whichever its case.
TYPED = {
    "a token's end": ("travel_velocity", "5.travel_velocity"),
    "words": ("link 3 angular velocity", "3.angular_velocity"),
    "words in another order": ("VELOCITY angular 3", "3.angular_velocity"),
    "a symbol": ("ω₆", "6.angular_velocity"),
    "a name": ("cushion", "cushion.force"),
}


@pytest.mark.parametrize(("typed", "found"), TYPED.values(), ids=TYPED)
def test_letters_filter_the_list(press: State, typed: str, found: str) -> None:
    tokens = listed(press.scene, typed)
    assert found in tokens
    assert len(tokens) < len(press.scene.quantities) / 2


def test_the_list_shows_words_symbol_and_unit(press: State) -> None:
    shown = words_in(after(press, "list", Action("filter", "cushion.f")))
    assert shown is not None
    known = quantity(press.scene, "cushion.force")
    ((words, value),) = shown.rows
    assert (words, value.partition(" = ")[0]) == ("Cushion damper: force", known.symbol)
    force = float(value.partition(" = ")[2].removesuffix(" N").replace("−", "-"))
    assert force == pytest.approx(press.scene.pose(0.0).damper["cushion"].force, rel=1e-3)
    assert (shown.chosen, shown.typed) == (0, "cushion.f")


def test_the_lists_ends_are_ends(press: State) -> None:
    begun = after(press, "list")
    top = after(begun, Action("move", -1))
    assert begun.of(Listing) is not None
    assert top.of(Listing) is not None
    assert the(begun, Listing).chosen == 0
    assert the(top, Listing).chosen == 0
    bottom = after(top, Action("move", 10_000))
    assert bottom.of(Listing) is not None
    assert the(bottom, Listing).chosen == len(listed(press.scene, "")) - 1
    only = after(press, "list", Action("filter", "cushion.f"), Action("move", 1))
    assert only.of(Listing) is not None
    assert the(only, Listing).chosen == 0


def test_backspace_takes_the_last_typed_letter_off(press: State) -> None:
    state = after(press, "list", Action("filter", "ve"), "erase_filter")
    assert state.of(Listing) is not None
    assert the(state, Listing).typed == "v"


def test_filtering_starts_from_the_top(press: State) -> None:
    state = after(press, "list", Action("move", 5), Action("filter", "v"))
    assert state.of(Listing) is not None
    assert (the(state, Listing).chosen, the(state, Listing).typed) == (0, "v")
    state = after(state, Action("move", 2), "erase_filter")
    assert state.of(Listing) is not None
    assert (the(state, Listing).chosen, the(state, Listing).typed) == (0, "")


def test_the_list_opens_at_what_is_charted(press: State) -> None:
    token = [*press.scene.quantities][40]
    state = after(press, Action("plot", token), "list")
    assert state.of(Listing) is not None
    assert listed(press.scene, "")[the(state, Listing).chosen] == token


def test_c_goes_through_the_telling_ones_and_then_shows_none(press: State) -> None:
    charts = []
    state = press
    for _ in range(len(press.scene.telling) + 1):
        state = after(state, Action("chart", 1))
        charts.append(state.look.chart)
    assert charts == [*press.scene.telling, None]
    assert after(state, Action("chart", -1)).look.chart == press.scene.telling[-1]


def test_c_puts_away_a_chart_that_is_not_telling(press: State) -> None:
    token = next(token for token in press.scene.quantities if token not in press.scene.telling)
    assert after(press, Action("plot", token), Action("chart", 1)).look.chart is None


def test_names_are_off_then_names_then_dimensions(press: State) -> None:
    levels = [after(press, *["names"] * count).look.names for count in range(4)]
    assert levels == [0, 1, 2, 0]


@pytest.mark.parametrize("key", ["list", "shelf", "back"])
def test_an_open_list_or_shelf_is_closed_by_its_key_and_by_escape(press: State, key: str) -> None:
    for opening in ("list", "shelf"):
        state = after(press, opening, key if key == "back" else opening)
        assert (state.of(Listing), state.of(OpenShelf), state.effects) == (None, None, ())


def test_one_overlay_is_open_at_a_time(press: State) -> None:
    assert after(press, "list", "shelf").mode == "shelf"
    assert after(press, "shelf", "list").mode == "list"
    assert after(press, "shelf", "edit").mode == "edit"


def test_a_list_of_another_mechanism_is_closed(press: State) -> None:
    assert after(press, "list", Action("mechanism", 1)).modes == ()


def test_an_unknown_quantity_is_not_charted(press: State) -> None:
    state = after(press, Action("plot", "nothing.at_all"))
    assert (state.look.chart, state.toast is not None) == (None, True)


def test_a_chart_stays_on_a_mechanism_that_has_its_quantity(press: State) -> None:
    assert after(press, Action("plot", "cushion.force"), Action("mechanism", 1)).look.chart is None
    angle = after(press, Action("plot", "transmission_angle"), Action("mechanism", 1))
    assert angle.look.chart == "transmission_angle"


def test_the_shelfs_first_mechanism_is_chosen_and_put_on(press: State) -> None:
    state = after(press, "shelf", Action("point", 0))
    assert state.of(OpenShelf) is not None
    assert the(state, OpenShelf).chosen == 0
    assert after(state, Action("put", 0)).scene.name == names()[0]


def test_the_shelf_opens_at_the_mechanism_that_is_on_and_goes_round(press: State) -> None:
    state = after(press, "shelf")
    assert state.of(OpenShelf) is not None
    assert the(state, OpenShelf).entries == names()
    assert the(state, OpenShelf).chosen == press.place
    state = after(state, Action("move", len(names()) + 1))  # and an empty sheet
    assert state.of(OpenShelf) is not None
    assert the(state, OpenShelf).chosen == press.place


@pytest.mark.parametrize("place", [-2, 999])
def test_a_place_off_the_shelf_is_not_gone_to(press: State, place: int) -> None:
    state = after(press, "shelf", Action("point", place), Action("put", place))
    assert state.of(OpenShelf) is not None
    assert (the(state, OpenShelf).chosen, state.scene) == (press.place, press.scene)


def test_the_shelf_opens_at_once_and_reads_a_mechanism_every_second_frame(
    player: Player, monkeypatch: pytest.MonkeyPatch
) -> None:
    read: list[str] = []

    def reading(name: str) -> Scene:
        read.append(name)
        return load(name)

    monkeypatch.setattr("linkanim.ui.shelf.load", reading)
    player.type("o")
    for frame in range(7):
        assert len(read) == (frame + 1) // 2  # what is read in one frame is drawn in the next
        player.tick()
    assert len({*read}) == 4
    assert read[0] == player.state.scene.name


@pytest.mark.parametrize(
    ("on", "key", "then"),
    [("press", "1", "six-bar"), ("hart", "3", "pantograph"), ("hart", "4", "hart"), ("hart", "9", "hart")],
)
def test_a_digit_chooses_within_the_chapter(on: str, key: str, then: str) -> None:
    state = after(begin(load(on)), Action("select", int(key) - 1))
    assert (state.scene.name, state.toast, state.effects) == (then, None, ())


def test_a_quantity_is_charted_from_the_list(player: Player) -> None:
    paused = player.pixels
    player.type("k")
    assert player.pixels != paused
    player.type("rocker a")
    player.press(pygame.K_DOWN)
    player.press(pygame.K_RETURN)
    assert player.state.look.chart == listed(player.state.scene, "rocker a")[1]
    assert player.state.of(Listing) is None


def test_nothing_is_charted_where_nothing_is_found(player: Player) -> None:
    player.type("k")
    player.type("xyzzy")
    player.press(pygame.K_RETURN)
    assert (player.state.look.chart, player.state.of(Listing) is not None) == (None, True)


def test_the_next_quantity_is_charted_below_by_shift_k_and_enter(player: Player) -> None:
    player.type("c")
    for count in (2, 3):
        player.press(pygame.K_k, pygame.KMOD_LSHIFT, "K")
        player.press(pygame.K_RETURN)
        assert player.state.look.chart == ",".join(player.state.scene.telling[:count])
    assert player.state.of(Listing) is None


def _grid(player: Player) -> Grid:
    assert player.state.of(OpenShelf)
    return shelf_grid(player.window.screen.size, the(player.state, OpenShelf))


def test_the_shelf_is_browsed_with_arrows_and_enter(player: Player) -> None:
    player.type("o")
    below = _grid(player).neighbour(1, 1)
    player.press(pygame.K_RIGHT)
    player.press(pygame.K_DOWN)
    player.press(pygame.K_RETURN)
    assert (player.state.scene.name, player.state.of(OpenShelf)) == (names()[below], None)


def test_the_shelf_opened_and_browsed_within_one_frame_goes_a_row_down(player: Player) -> None:
    for key, letter in ((pygame.K_o, "o"), (pygame.K_DOWN, "")):
        pygame.event.post(pygame.event.Event(pygame.KEYDOWN, key=key, mod=0, unicode=letter))
    player.tick()
    assert player.state.of(OpenShelf)
    assert the(player.state, OpenShelf).chosen > 0


def test_the_shelf_is_browsed_with_the_mouse(player: Player) -> None:
    player.type("o")
    cell = _grid(player).cells[1]
    middle = (cell.x + cell.width / 2, cell.y + cell.height / 2)
    player.mouse(pygame.MOUSEMOTION, middle, rel=(0, 0), buttons=(0, 0, 0))
    assert player.state.of(OpenShelf) is not None
    assert the(player.state, OpenShelf).chosen == 1
    player.drag(middle)
    assert player.state.scene.name == names()[1]
    assert not player.state.is_covered


# What is typed is looked for in name, title and chapter; the best of what is found is chosen, whatever was.
FILTERED = {
    "a name, among names that have it": ("quick-return-press", "press", "press"),
    "a name with a space": ("press", "slider crank", "slider-crank"),
    "a name before titles": ("press", "watt", "watt-line"),
    "a title before chapters": ("press", "slid", "slider-crank"),
    "a title": ("press", "double-rocker", "double-rocker"),
    "a chapter": ("press", "exact and", "peaucellier"),
    "a name": ("crank-rocker", "hoecken", "hoecken"),
    "one that is on": ("press", "PUNCH press", "press"),
}


@pytest.mark.parametrize(("on", "typed", "first"), FILTERED.values(), ids=FILTERED)
def test_letters_filter_the_shelf(on: str, typed: str, first: str) -> None:
    state = after(begin(load(on)), "shelf", *(Action("filter", letter) for letter in typed))
    assert state.of(OpenShelf)
    found = [the(state, OpenShelf).entries[n] for n in the(state, OpenShelf).matches]
    assert the(state, OpenShelf).entries[the(state, OpenShelf).chosen] == first
    assert first in found
    assert len(found) < len(names()) / 2
    moved = after(state, Action("move", len(found)))
    assert moved.of(OpenShelf)
    assert the(moved, OpenShelf).chosen == the(state, OpenShelf).chosen
    back = after(state, *["erase_filter"] * len(typed))
    assert back.of(OpenShelf)
    assert (the(back, OpenShelf).typed, len(the(back, OpenShelf).matches)) == ("", len(names()) + 1)


def test_the_shelf_is_filtered_with_keys_and_nothing_is_put_on_where_nothing_is_found(player: Player) -> None:
    player.type("o")
    player.type("peau")
    player.press(pygame.K_RETURN)
    assert (player.state.scene.name, player.state.of(OpenShelf)) == ("peaucellier", None)
    player.type("o")
    player.type("xyzzy")
    player.press(pygame.K_RETURN)
    assert player.state.of(OpenShelf)
    assert player.state.scene.name == "peaucellier"
    player.press(pygame.K_ESCAPE)
    assert player.state.of(OpenShelf) is None


def test_the_wheel_scrolls_the_shelf_and_what_is_chosen_stays_in_sight(player: Player) -> None:
    player.type("o")
    for notches in (-1, -1, -40, 3, 40):
        before = _grid(player)
        pygame.event.post(pygame.event.Event(pygame.MOUSEWHEEL, x=0, y=notches, flipped=False))
        player.tick()
        assert player.state.of(OpenShelf)
        found = _grid(player)
        assert found.whole(the(player.state, OpenShelf).chosen)
        assert (found.top > before.top) == (notches < 0)
    assert found.top == 0


@pytest.mark.slow
def test_arrows_scroll_no_more_than_they_need(player: Player) -> None:
    player.type("o")
    tops = []
    for _ in range(len(_grid(player).rows)):
        tops.append(_grid(player).top)
        player.press(pygame.K_DOWN)
    assert tops == sorted(tops)
    player.press(pygame.K_UP)
    assert player.state.of(OpenShelf)
    assert _grid(player).whole(the(player.state, OpenShelf).chosen)


# What moves about on the shelf by keys and mouse.
MOVES = {
    "an arrow": (pygame.KEYDOWN, {"key": pygame.K_DOWN, "mod": 0, "unicode": ""}),
    "an arrow back": (pygame.KEYDOWN, {"key": pygame.K_UP, "mod": 0, "unicode": ""}),
    "a page": (pygame.KEYDOWN, {"key": pygame.K_PAGEDOWN, "mod": 0, "unicode": ""}),
    "a page back": (pygame.KEYDOWN, {"key": pygame.K_PAGEUP, "mod": 0, "unicode": ""}),
    "the wheel": (pygame.MOUSEWHEEL, {"x": 0, "y": -1, "flipped": False}),
}
on_the_shelf = pytest.mark.parametrize("event", MOVES.values(), ids=MOVES)


@pytest.mark.thinned(3)
@on_the_shelf
def test_where_nothing_is_found_nothing_is_moved_to(
    player: Player, event: tuple[int, dict[str, Any]]
) -> None:
    player.type("o")
    player.type("xyzzy")
    before = player.state.of(OpenShelf)
    pygame.event.post(pygame.event.Event(*event))
    player.tick()
    assert player.state.of(OpenShelf) == before


@pytest.mark.thinned(7)
@on_the_shelf
@pytest.mark.parametrize("size", [(320, 120), (320, 60), (700, 2), (2, 700)])
def test_a_window_too_low_for_a_whole_picture_is_scrolled(
    player: Player, event: tuple[int, dict[str, Any]], size: tuple[int, int]
) -> None:
    pygame.display.set_mode(size, pygame.RESIZABLE)
    player.type("o")
    for _ in range(3):
        pygame.event.post(pygame.event.Event(*event))
        player.tick()
    assert player.state.of(OpenShelf)
    if size == (320, 120) and event[0] == pygame.MOUSEWHEEL:
        assert _grid(player).top == 3
    player.press(pygame.K_RETURN)
    assert player.state.of(OpenShelf) is None


def test_a_click_beside_the_pictures_closes_the_shelf(player: Player) -> None:
    player.type("o")
    player.drag((1, 1))
    assert (player.state.of(OpenShelf), player.state.scene.name) == (None, "crank-rocker")


def fingers(player: Player, *places: tuple[float, float]) -> None:
    """Touch the first place, go to the others, and let go."""
    wide, high = player.window.screen.size
    kinds = [pygame.FINGERDOWN, *[pygame.FINGERMOTION] * (len(places) - 1), pygame.FINGERUP]
    for kind, (x, y) in zip(kinds, (*places, places[-1]), strict=True):
        share: dict[str, Any] = {"x": x / wide, "y": y / high}
        pygame.event.post(pygame.event.Event(kind, finger_id=1, touch_id=1, dx=0.0, dy=0.0, **share))
        player.tick()


@pytest.mark.parametrize("by", ["mouse", "finger"])
@pytest.mark.parametrize("size", [(320, 180), (640, 360), (1280, 720)], ids=str)
def test_the_shelf_is_scrolled_by_its_bar_and_by_a_drag(
    player: Player, size: tuple[int, int], by: str
) -> None:
    pygame.display.set_mode(size, pygame.RESIZABLE)
    player.type("o")
    drag = player.drag if by == "mouse" else lambda *places: fingers(player, *places)
    track = _grid(player).track
    assert track
    x = track.middle.real
    drag((x, track.y + 2), (x, track.bottom - 2))
    bottom = _grid(player)
    assert bottom.whole(len(names()) - 1)
    assert player.state.of(OpenShelf)
    assert bottom.seen.stop == len(bottom.rows)
    drag((x, track.bottom - 2), (x, track.y + 2))
    assert _grid(player).top == 0
    cell = _grid(player).cells[1].middle
    far = (cell.real, cell.imag - 1.1 * _grid(player).step)
    drag((cell.real, cell.imag), (cell.real, 0.5 * (cell.imag + far[1])), far)
    assert _grid(player).top == 1
    assert player.state.scene.name == "crank-rocker"


def test_a_shelf_that_is_all_in_sight_has_no_bar(player: Player) -> None:
    player.type("o")
    player.type("peaucellier")
    assert _grid(player).track is None


@pytest.mark.slow
def test_the_shelf_is_alive_and_still_while_paused(player: Player) -> None:
    player.type("o")
    for _ in range(len(names()) + 12):
        player.tick()
    still = player.pixels
    player.tick(10)
    assert player.pixels == still
    player.type(" ")
    player.tick(30)
    moving = player.pixels
    player.tick(10)
    assert player.pixels not in (still, moving)


def test_a_tape_keeps_what_is_picked_and_not_the_way_there(
    player: Player, here: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("linkanim.player.background._start", fake_start([]))
    player.type("g")
    player.type("k")
    player.type("rocker vel")
    player.press(pygame.K_RETURN)
    player.type("o")
    player.press(pygame.K_RIGHT)
    player.press(pygame.K_RETURN)
    token = listed(load("crank-rocker"), "rocker vel")[0]
    player.type("g")
    tape = read(here / "recordings/crank-rocker-1.tape.json")
    assert [action for _, action in tape.actions] == [Action("plot", token), Action("put", 1)]
    *_, last = tape.states()
    assert last.scene.name == names()[1]


@pytest.mark.slow
def test_a_list_of_very_many_entries_is_filtered_once_for_its_letters(press: State) -> None:
    entries = Entries("Many", tuple(ListRow(f"s{n:05}", "", Action("note", "")) for n in range(50_000)))
    opened = press.with_mode(Listing(0, others=entries))
    lists = [words_in(state) for state in (opened, after(opened, Action("move", 3)))]
    assert [one and one.chosen for one in lists] == [0, 3]
    rows = [one and one.rows for one in lists]
    assert rows[0] is rows[1]  # no frame and no key looks at all of them again
    typed = after(opened, Action("filter", "S49 "), Action("filter", "9999"))
    assert typed.of(Listing)
    assert the(typed, Listing).matches(press.scene) == ("s49999",)
    assert after(typed, *["erase_filter"] * 8).of(Listing) == opened.of(Listing)


@pytest.mark.parametrize("size", [(1280, 720), (720, 1280), (1080, 2160)])
@pytest.mark.slow
def test_every_row_of_k_in_sight_has_its_value(size: tuple[int, int]) -> None:
    """In a tall window more rows are in sight than had values."""
    with screen.opened(size):
        player = Player(begin(load("press")))
        player.type("k")
        for _ in range(7):
            player.tick(20)
            told = words_in(player.state)
            assert told
            found = (player.window.screen.row_at(60, y) for y in range(2, size[1], 4))
            seen = {row for row in found if row is not None and row >= 0}
            assert len(seen) > 10
            assert all(" = " in told.rows[row][1] for row in seen)
            player.press(pygame.K_PAGEDOWN)
