"""What a lecturer and a student do in one sitting, by real keys and clicks, in few gestures, none wrong."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import pygame
import pytest
from playing import CTRL, SHIFT, Player
from shown_lists import values_in, words_in

from linkanim.play.games import game_of
from linkanim.player.action import Action
from linkanim.player.actions import carried
from linkanim.player.background import Queue
from linkanim.player.state import begin
from linkanim.scenes import load
from linkanim.ui import screen

MODS = {"Ctrl": CTRL, "Shift": SHIFT}
NAMED = {"Enter": pygame.K_RETURN, "Down": pygame.K_DOWN, "Tab": pygame.K_TAB, "Space": pygame.K_SPACE}


class Sitting(Player):
    """A window at 1280 by 720, and its gestures so far: a key, a click, a drag, a word that is typed."""

    gestures = 0

    def key(self, name: str) -> None:
        """Press a key as it is written for readers, such as Ctrl+G."""
        self.gestures += 1
        *held, last = name.split("+")
        code = NAMED.get(last) or (getattr(pygame, f"K_{last}") if len(last) > 1 else ord(last.lower()))
        text = last.lower() if len(last) == 1 and "Ctrl" not in held else ""
        self.press(code, sum(MODS[one] for one in held), text)
        self.tick(2)

    def word(self, text: str) -> None:
        self.gestures += 1
        self.type(text)

    def click(self, at: tuple[float, float], *more: tuple[float, float]) -> None:
        self.gestures += 1
        self.drag(at, *more)
        self.tick(2)

    def words_of_list(self) -> dict[str, str]:
        """Return the rows of the open list as they are drawn: their words, and what stands beside them."""
        shown = words_in(self.state)
        assert shown
        return dict(shown.rows)


@pytest.fixture
def sitting(here: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Sitting]:
    del here
    monkeypatch.setattr(Queue, "add", lambda *_: asked.append("recorded"))
    asked.clear()
    with screen.opened((1280, 720)):
        player = Sitting(carried(replace(begin(load("press")), games=game_of), Action("play", "title")))
        player.tick(20)
        yield player
        player.window.close()


asked: list[str] = []


@pytest.mark.slow
def test_a_lecturer_s_list_takes_at_most_twelve_gestures(sitting: Sitting) -> None:
    one = sitting
    one.key("Enter")  # the press, running
    assert (one.state.scene.name, one.state.mode) == ("press", "play")
    assert one.state.look.trace  # the trace is there
    one.key("Down")  # slower
    assert one.state.clock.level < 0
    one.key("C")  # the ram's chart
    assert one.state.look.chart == "5.travel_velocity"
    one.key("F11")  # full screen
    assert screen.is_full()
    one.key("B")  # the other closure
    assert one.state.scene.linkage != load("press").linkage
    one.key("B")
    one.key("L")  # dark
    assert one.state.look.theme == "dark"
    one.key("Ctrl+G")  # one period as a GIF
    assert asked == ["recorded"]
    one.key("E")  # a length; its panel says the class and what Grashof says
    one.word("60")
    one.key("Enter")
    assert one.state.scene.linkage.crank("A").length == 60
    panel = values_in(one.state)
    assert panel
    assert panel.facts[0] == one.state.scene.info.class_name
    assert one.gestures <= 12
    assert one.state.toast is None or "refused" not in one.state.toast.text


@pytest.mark.slow
def test_a_student_s_homework_takes_at_most_twenty_five_gestures(sitting: Sitting) -> None:
    one = sitting
    one.key("2")  # the door to the sheet
    assert one.state.mode == "build"
    at = one.window.screen.pixel
    one.click(at(0, 0))
    one.click(at(120, 0))
    one.click(at(0, 0), at(10, 20), at(20, 30))
    one.click(at(20, 30), at(60, 60), at(110, 90))
    one.click(at(110, 90), at(115, 40), at(120, 0))
    assert one.state.building
    assert one.state.building.building.made.scene
    one.key("E")  # the list opens at the bar that was drawn last
    for n, value in enumerate(("90", "10 rad/s", "", "120", "35", "110")):
        if n:
            one.key("Tab")
        if value:
            one.word(value)
    one.key("Enter")
    for _ in range(200):
        one.tick()  # it has shown one period, and rests
    middle = one.state.displayed.pose(one.state.phase, 0).position
    (x, y), (across, up) = middle["A"], middle["B"]
    one.gestures += 1  # a double click on the coupler: a point of it
    for _ in range(2):
        one.drag(one.window.screen.pixel((x + across) / 2, (y + up) / 2))
    one.key("F2")
    scene = one.state.scene
    assert [joint.name for joint in scene.linkage.joints if joint.bars] == ["A", "B"]
    assert len(scene.linkage.joints) == 5
    one.word("60")
    one.key("Enter")
    assert one.state.clock.paused
    one.key("K")
    rows = one.words_of_list()
    one.key("Ctrl+K")
    one.word("fact")
    facts = one.words_of_list()
    assert one.gestures <= 25
    # by hand, from the loop's closure: O2 (0, 0), O4 (120, 0), crank 35 at 60 degrees, 10 rad/s
    step = 1e-4
    before, here, after = (rocker_angle(math.radians(60.0) + by * step) for by in (-1, 0, 1))
    omega4, alpha4 = 10.0 * (after - before) / (2 * step), 100.0 * (after - 2 * here + before) / step**2
    theta4 = math.degrees(here)
    read = {words: number_in(value) for words, value in rows.items()}
    assert read["Rocker: angle"] == pytest.approx(theta4, rel=1e-3)
    assert read["Rocker: angular velocity"] == pytest.approx(omega4, rel=1e-3)
    assert read["Rocker: angular acceleration"] == pytest.approx(alpha4, rel=1e-3)
    ends = [value for words, value in facts.items() if words.startswith("dead centre")]
    assert sorted(number_in(f"= {value}") for value in ends) == pytest.approx(dead_centres(), abs=0.06)
    least = math.degrees(math.acos((110**2 + 90**2 - 85**2) / (2 * 110 * 90)))
    assert f"{least:.1f}°" in facts["transmission angle"]


def number_in(text: str) -> float:
    """Return the number after the = of a row's value; NaN where there is none."""
    found = re.search(r"= ([−-]?[\d.]+)", text)
    return float(found[1].replace("−", "-")) if found else math.nan


def rocker_angle(crank: float) -> float:
    """Return the rocker's angle (rad) of the open four-bar 120, 35, 110, 90."""
    pin = 35.0 * complex(math.cos(crank), math.sin(crank))
    to = 120.0 - pin
    inner = math.acos((110.0**2 + abs(to) ** 2 - 90.0**2) / (2 * 110.0 * abs(to)))
    third = math.atan2(to.imag, to.real) + inner
    knee = pin + 110.0 * complex(math.cos(third), math.sin(third))
    return math.atan2(knee.imag, (knee - 120.0).real)


def dead_centres() -> list[float]:
    """Return the crank's angles (°) in line with the coupler: stretched, and folded over."""
    found = []
    for far, turn in ((145.0, 0.0), (75.0, 180.0)):
        angle = math.degrees(math.acos((120.0**2 + far**2 - 90.0**2) / (2 * 120.0 * far)))
        found.append((angle + turn) % 360.0)
    return sorted(found)
