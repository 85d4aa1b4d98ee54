"""Text: every character is drawn, spelt or left out, and none is a box."""

from __future__ import annotations

from dataclasses import replace

import pygame
import pytest

from linkanim.picture import fonts
from linkanim.picture.hud import hud_for
from linkanim.picture.layout import layout
from linkanim.picture.look import Look
from linkanim.picture.text import Type
from linkanim.picture.theme import LIGHT
from linkanim.scenes import load

SIZE = 21
INK = (10, 20, 30)


def _bytes(type_: Type, char: str) -> bytes:
    return pygame.image.tobytes(type_.glyph(char, SIZE, INK), "RGBA")


@pytest.fixture
def alone(monkeypatch: pytest.MonkeyPatch) -> Type:
    """A type on a system without fonts."""
    monkeypatch.setattr(fonts, "_WIDE", ())
    return Type()


# What no font here has, and what stands for it.
@pytest.mark.parametrize(
    ("char", "spelt"),
    [
        # other scripts without a font for them, an emoji, what is for private use, not a character at all
        ("曲", ""),
        ("😀", ""),
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
        ("ｱ", ""),
        ("Ａ", "A"),
        ("①", "1"),
    ],
)
def test_what_no_font_has_is_spelt_or_left_out(alone: Type, char: str, spelt: str) -> None:
    assert alone.width(char, SIZE) == alone.width(spelt, SIZE)
    assert not spelt or _bytes(alone, char) == _bytes(alone, spelt)


@pytest.mark.parametrize("char", "aßжΩµ°…−²×")
def test_the_bundled_font_has_what_scenes_are_written_in(alone: Type, char: str) -> None:
    assert alone.width(char, SIZE) > 0
    assert _bytes(alone, char) != _bytes(alone, "a" if char != "a" else "b")


def test_a_letter_and_its_mark_are_drawn_as_one(alone: Type) -> None:
    assert alone.width("e\u0301", SIZE) == alone.width("é", SIZE)


def test_a_font_of_the_system_draws_what_the_bundled_one_lacks() -> None:
    """Where the system has one; it stands on the bundled font's line and is as high."""
    type_ = Type()
    if type_.width("曲", SIZE) == 0:
        pytest.skip("no font of this system has it")
    drawn, plain = type_.glyph("曲", SIZE, INK), type_.glyph("0", SIZE, INK)
    assert drawn.get_height() == plain.get_height()
    box = drawn.get_bounding_rect()
    assert box.height > 0.5 * plain.get_height()
    assert 0 <= box.top < box.bottom <= plain.get_height()
    assert _bytes(type_, "曲") != _bytes(type_, "柄")


def test_a_system_that_cannot_list_its_fonts_has_none(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(pygame.font, "get_fonts", lambda: [])
    assert Type().width("曲", SIZE) == 0


@pytest.mark.parametrize("text", ["one two three", "a/path/without/spaces", "曲柄搖杆機構" * 5, "A" * 70])
@pytest.mark.parametrize("width", [60, 150, 400])
def test_lines_are_no_wider_than_they_may_be_and_lose_nothing(text: str, width: int) -> None:
    type_ = Type()
    lines = type_.wrapped(text, SIZE, width)
    assert all(type_.width(line, SIZE) <= width for line in lines)
    assert "".join(lines).replace(" ", "") == text.replace(" ", "")


def test_a_title_that_no_font_has_gives_way_to_the_scene_s_name(alone: Type) -> None:
    scene = replace(load("crank-rocker"), name="mine", title="曲柄")
    hud = hud_for(scene, layout((640, 360), Look()), alone, LIGHT)
    assert hud is not None
    assert hud.lines[0].text == "mine"
