"""What a window asks of its system: how large it is, what SDL is told, before any screen is there."""

from __future__ import annotations

import os
import sys

import pygame
import pytest

from linkanim.ui import screen


# screens, and the window that suits the first of them: its shape kept, some room left
@pytest.mark.parametrize(
    ("screens", "size"),
    [
        ([(1920, 1080)], (1280, 720)),
        ([(3840, 2160)], (1280, 720)),
        ([(1366, 768)], (1229, 691)),
        ([(800, 600)], (720, 405)),
        ([(1024, 768), (3840, 2160)], (922, 518)),
    ],
)
def test_a_window_is_as_large_as_suits_the_smallest_screen(
    screens: list[tuple[int, int]], size: tuple[int, int], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(pygame.display, "get_desktop_sizes", lambda: screens)
    assert screen._suiting() == size


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="what SDL is told on Linux")
def test_sdl_is_told_what_is_quick_and_quiet(monkeypatch: pytest.MonkeyPatch) -> None:
    expected = {
        "SDL_NO_SIGNAL_HANDLERS": "1",
        "SDL_VIDEO_X11_WMCLASS": "linkanim",
        "SDL_VIDEODRIVER": "x11,kmsdrm",
    }
    for name in (*expected, "XDG_RUNTIME_DIR"):
        monkeypatch.setenv(name, "")
        monkeypatch.delenv(name)
    screen._prepare()
    assert {name: os.environ.get(name) for name in expected} == expected


@pytest.mark.parametrize(("driver", "setting"), [("x11", "0"), ("wayland", None)])
def test_pictures_go_past_opengl_where_they_can(
    driver: str, setting: str | None, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("SDL_FRAMEBUFFER_ACCELERATION", "")
    monkeypatch.delenv("SDL_FRAMEBUFFER_ACCELERATION")
    screen._hasten(driver)
    assert os.environ.get("SDL_FRAMEBUFFER_ACCELERATION") == setting


def test_what_is_set_stays_as_it_is(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("SDL_VIDEODRIVER", "dummy")
    screen._prepare()
    assert os.environ["SDL_VIDEODRIVER"] == "dummy"


def test_an_opened_window_has_been_prepared(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("SDL_VIDEODRIVER", "dummy")
    monkeypatch.delenv("SDL_NO_SIGNAL_HANDLERS", raising=False)
    with screen.opened((64, 64)):
        assert os.environ["SDL_NO_SIGNAL_HANDLERS"] == "1"
        assert screen.display_surface().get_size() == (64, 64)
