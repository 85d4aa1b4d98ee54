"""Text: every character is drawn, spelt, or has a stand-in, and none is a box."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pygame
import pytest
from fidelity import Pixels
from pictures import pixels

from linkanim.letters import lacking
from linkanim.picture import text as fonts
from linkanim.picture.hud import columns
from linkanim.picture.layout import layout
from linkanim.picture.raster import offscreen
from linkanim.picture.text import Type, runs, subscripted, typesetting
from linkanim.scenes import load

SIZE = 21
INK = (10, 20, 30)


def _bytes(type_: Type, char: str, size: int = SIZE) -> bytes:
    return pygame.image.tobytes(type_._glyph(char, size, INK, fonts.REGULAR, 0).sprite, "RGBA")


def _box(type_: Type, char: str, size: int) -> pygame.Rect:
    """Return where a character's ink lies below and right of its own corner."""
    ink = type_._glyph(char, size, INK, fonts.REGULAR, 0)
    return ink.sprite.get_rect(topleft=(ink.right, ink.down))


def unshared() -> Type:
    """Return a type with glyphs of its own: those that the tests share are of the fonts that are here."""
    type_ = Type()
    type_._fonts, type_._steps, type_._glyphs = fonts.Fonts(), {}, {}
    return type_


@pytest.fixture
def alone(monkeypatch: pytest.MonkeyPatch) -> Type:
    """A type on a system without fonts."""
    monkeypatch.setattr(fonts, "_WIDE", ())
    return unshared()


# What no font here has, and what stands for it.
@pytest.mark.parametrize(
    ("char", "spelt"),
    [
        # other scripts without a font for them, an emoji: their place is seen
        ("曲", "?"),
        ("😀", "?"),
        # what is for private use, not a character at all
        ("\ue000", ""),
        ("\uffff", ""),
        # nothing to be seen: of no width, controls, a mark without its letter
        ("\u200b", ""),
        ("\ufeff", ""),
        ("\x00", ""),
        ("\u0301", ""),
        # other kinds of space, and ends of lines
        ("\t", " "),
        ("\n", " "),
        ("\u3000", " "),
        # made of parts that the font has
        ("ｱ", "?"),
        ("Ａ", "A"),
        ("①", "1"),
    ],
)
def test_what_no_font_has_is_spelt_or_has_a_stand_in(alone: Type, char: str, spelt: str) -> None:
    assert alone.width(char, SIZE) == alone.width(spelt, SIZE)
    assert not spelt or _bytes(alone, char) == _bytes(alone, spelt)


@pytest.mark.parametrize("char", "aßжΩµ°…−²×→↑←↓½±∞≤√′" + "αβγδθμφψωΔΣ" + "₀₁₂₃₄₅₆₇₈₉")
def test_the_bundled_face_has_what_scenes_are_written_in(alone: Type, char: str) -> None:
    assert alone.width(char, SIZE) > 0
    assert _bytes(alone, char) != _bytes(alone, "a" if char != "a" else "b")


def test_a_letter_and_its_mark_are_drawn_as_one(alone: Type) -> None:
    assert alone.width("e\u0301", SIZE) == alone.width("é", SIZE)


def test_a_font_of_the_system_draws_what_the_bundled_one_lacks() -> None:
    """Where the system has one; it stands on the bundled font's line."""
    type_ = Type()
    if not type_._fonts.has("曲"):
        pytest.skip("no font of this system has it")
    box = _box(type_, "曲", SIZE)
    assert box.height > 0.5 * SIZE
    assert 0 <= box.top < box.bottom <= 1.5 * SIZE
    assert _bytes(type_, "曲") != _bytes(type_, "柄")


def test_what_the_bundled_face_lacks_stands_on_its_line_in_a_font_of_the_system(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """A font that pygame brings stands for the system's; it has a long s, which would be spelt s."""
    path = Path(pygame.__file__).with_name(pygame.font.get_default_font())
    monkeypatch.setattr(pygame.font, "get_fonts", lambda: ["notosans"])
    monkeypatch.setattr(pygame.font, "match_font", lambda name: str(path))
    type_, size = Type(), 48
    assert _bytes(type_, "\u017f", size) != _bytes(type_, "s", size)
    boxes = _box(type_, "\u017f", size), _box(type_, "l", size)
    assert type_.width("\u017f", size) == pytest.approx(boxes[0].right, abs=2)
    assert abs(boxes[0].bottom - boxes[1].bottom) <= 1
    assert boxes[0].height == pytest.approx(boxes[1].height, rel=0.2)


def test_a_system_that_cannot_list_its_fonts_has_none(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(pygame.font, "get_fonts", lambda: [])
    fonts_here = unshared()._fonts
    assert lacking("曲四 Ａθ? 曲", fonts_here.has) == "曲四"


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("crank angle", [("crank angle", False)]),
        # with Unicode's own signs, several digits together, letters among them
        ("O₂", [("O", False), ("2", True)]),
        ("r₁₀ = aₓ", [("r", False), ("10", True), (" = a", False), ("x", True)]),
        # what Unicode has no sign for; a decomposed letter
        ("v_{BA}, e\u0301", [("v", False), ("BA", True), (", é", False)]),
        # no subscripts: a name with a low line, an open brace, nothing between the braces
        ("coupler_point", [("coupler_point", False)]),
        ("a_{b", [("a_{b", False)]),
        ("a_{}b", [("a", False), ("b", False)]),
        ("", []),
    ],
)
def test_a_line_is_told_in_runs(text: str, told: list[tuple[str, bool]]) -> None:
    assert [tuple(run) for run in runs(text)] == told


@pytest.mark.parametrize(
    ("name", "set_as"),
    [("O2", "O₂"), ("P12", "P₁₂"), ("A_3", "A₃"), ("A", "A"), ("3", "3"), ("rod", "rod"), ("A2b", "A2b")],
)
def test_a_name_s_number_is_its_subscript(name: str, set_as: str) -> None:
    assert subscripted(name) == set_as


def _line(text: str, size: int, *, strong: bool = False) -> Pixels:
    """Return how dark a line is drawn, in columns of the picture (x, y), from (4, 20)."""
    surface = offscreen((300, 80))
    surface.fill((255, 255, 255))
    Type().draw(surface, text, (4, 20), size=size, colour=(0, 0, 0), strong=strong)
    return 255 - pixels(surface)[..., 0].T


# a line's height, and that of text as large as its subscripts: 0.72 of it, but 8 pixels where it is larger
@pytest.mark.parametrize(("size", "lowered"), [(7, 7), (8, 8), (11, 8), (13, 9), (17, 12), (24, 17)])
def test_a_subscript_is_as_large_as_can_be_read(size: int, lowered: int) -> None:
    assert typesetting(size).small == typesetting(lowered).em
    type_ = Type()
    beside = type_.width("M_{222222}", size) - type_.width("M", size)
    assert beside == pytest.approx(type_.width("222222", lowered), abs=2)


@pytest.mark.parametrize("text", ["O₂", "O_{2}"])
def test_a_subscript_is_smaller_and_lower_than_its_letter(text: str) -> None:
    letter, whole = (np.flatnonzero(_line(one, SIZE).max(axis=0) > 60) for one in ("O", text))
    digit = np.flatnonzero(_line(text, SIZE)[4 + Type().width("O", SIZE) :].max(axis=0) > 60)
    assert whole[-1] == digit[-1] > letter[-1] + 1
    assert np.ptp(digit) < 0.85 * np.ptp(letter)
    assert digit[0] > letter[0] + 3


WORDS = ("crank angle", "Grashof", "minute", "illumination", "double-rocker", "0123456789", "near the limit")


@pytest.mark.parametrize("strong", [False, True])
@pytest.mark.parametrize("size", range(9, 15))
@pytest.mark.parametrize("word", WORDS)
def test_small_letters_do_not_fuse(word: str, size: int, strong: bool) -> None:
    """Between two neighbours there is a column that is less than half as dark as ink."""
    columns, type_ = _line(word, size, strong=strong).max(axis=1), Type()
    for end in range(1, len(word)):
        edge = 4 + type_.width(word[:end], size, strong=strong)
        assert columns[edge - 2 : edge + 2].min() < 128, word[end - 1 : end + 1]


@pytest.mark.parametrize("strong", [False, True])
@pytest.mark.parametrize("size", [9, 14, 21, 40])
def test_a_number_keeps_its_place_while_its_digits_change(size: int, strong: bool) -> None:
    type_ = Type()
    assert len({type_.width(f"{digit}17.3°", size, strong=strong) for digit in range(10)}) == 1


def test_the_semibold_weight_is_darker() -> None:
    assert _line("crank angle", SIZE, strong=True).sum() > 1.2 * _line("crank angle", SIZE).sum()


@pytest.mark.parametrize("text", ["one two three", "a/path/without/spaces", "曲柄搖杆機構" * 5, "A" * 70])
@pytest.mark.parametrize("width", [60, 150, 400])
def test_lines_are_no_wider_than_they_may_be_and_lose_nothing(text: str, width: int) -> None:
    type_ = Type()
    lines = type_.wrapped(text, SIZE, width)
    assert all(type_.width(line, SIZE) <= width for line in lines)
    assert "".join(lines).replace(" ", "") == text.replace(" ", "")


def test_a_title_that_no_font_has_gives_way_to_the_scene_s_name(alone: Type) -> None:
    scene = replace(load("crank-rocker"), name="mine", title="曲柄")
    block = next(columns((scene,), (), layout((640, 360)), alone))
    assert block.title == ("mine",)


# Letters that stand clear of each other, that touch, with a subscript, with nothing to be seen among them.
@pytest.mark.parametrize("text", ["202.9 mm", "gwkxryVVKAjj", "v_{BA} of O₂", "a\u200b b"])
@pytest.mark.parametrize("size", [9, 16, 37])
def test_a_line_has_the_pixels_of_its_glyphs_put_down_one_by_one(text: str, size: int) -> None:
    type_, whole = Type(), pygame.Surface((600, 80), 0, 32)
    whole.fill((250, 240, 220))
    single = whole.copy()
    base = 10 + round(0.78 * size)
    for char, small, x, y in type_._set(text, size, fonts.SEMIBOLD)[:-1]:
        ink = type_._glyph(char, small, INK, fonts.SEMIBOLD, x % 4)
        single.blit(ink.sprite, (10 + x // 4 + ink.right, base + y + ink.down))
    assert (pixels(single) != pixels(whole)).any()
    for _ in range(2):
        drawn = whole.copy()
        type_.draw(drawn, text, (10, 10), size=size, colour=INK, strong=True)
        assert (pixels(drawn) == pixels(single)).all()


def test_lines_that_are_kept_take_no_more_than_their_room() -> None:
    type_, surface = Type(), pygame.Surface((1200, 300), 0, 32)
    # each takes some 250 kB
    for value in range(100):
        for _ in range(2):  # a line is kept when it comes again
            type_.draw(surface, f"{value:04d} mm", (0, 0), size=150, colour=INK)
        kept = [letters.sprite for _, inked in type_._inked.values() for letters in inked]
        assert 0 < sum(sprite.get_width() * sprite.get_height() * 4 for sprite in kept) <= 16e6
    assert 0 < len(type_._inked) < 100
