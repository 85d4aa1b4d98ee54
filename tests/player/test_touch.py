"""Fingers on the window: the first one is the mouse, two zoom, and nothing counts twice."""

from __future__ import annotations

import pygame
from playing import SIZE, Player

from linkanim.ui.devices import Fingers

WIDE, HIGH = SIZE


def finger(kind: int, number: int, x: float, y: float) -> pygame.event.Event:
    return pygame.event.Event(kind, finger_id=number, x=x / WIDE, y=y / HIGH, touch_id=1, dx=0.0, dy=0.0)


def kinds(events: list[pygame.event.Event]) -> list[int]:
    return [event.type for event in events]


def test_a_finger_is_the_mouse_and_what_the_system_makes_of_it_is_left_out() -> None:
    touch = Fingers()
    made = pygame.event.Event(pygame.MOUSEBUTTONDOWN, pos=(40, 50), button=1, touch=True)
    found = touch.pointed([finger(pygame.FINGERDOWN, 7, 40, 50), made], SIZE)
    assert kinds(found) == [pygame.MOUSEMOTION, pygame.MOUSEBUTTONDOWN]
    assert found[1].pos == (40, 50)
    ended = touch.pointed([finger(pygame.FINGERUP, 7, 60, 70)], SIZE)
    assert [(event.type, event.pos) for event in ended] == [(pygame.MOUSEBUTTONUP, (60, 70))]


def test_a_second_finger_lets_go_and_two_turn_the_wheel_about_their_middle() -> None:
    touch = Fingers()
    touch.pointed([finger(pygame.FINGERDOWN, 1, 100, 90)], SIZE)
    second = touch.pointed([finger(pygame.FINGERDOWN, 2, 140, 90)], SIZE)
    assert [(event.type, event.pos) for event in second] == [(pygame.MOUSEBUTTONUP, (100, 90))]
    moved, wheel = touch.pointed([finger(pygame.FINGERMOTION, 2, 180, 90)], SIZE)
    assert (moved.pos, wheel.type) == ((140, 90), pygame.MOUSEWHEEL)
    assert wheel.y == 7  # 1.1 ** 7 is nearest to twice as far
    assert touch.pointed([finger(pygame.FINGERUP, 2, 180, 90)], SIZE) == []


def test_a_finger_that_is_nowhere_stays_where_it_was_and_one_outside_is_at_the_edge() -> None:
    touch, nowhere = Fingers(), float("nan")
    assert touch.pointed([finger(pygame.FINGERDOWN, 1, nowhere, 90)], SIZE) == []
    touch.pointed([finger(pygame.FINGERDOWN, 1, 100, 90)], SIZE)
    (moved,) = touch.pointed([finger(pygame.FINGERMOTION, 1, nowhere, nowhere)], SIZE)
    assert moved.pos == (100, 90)
    (moved,) = touch.pointed([finger(pygame.FINGERMOTION, 1, float("-inf"), 1e300)], SIZE)
    assert moved.pos == (0, HIGH)
    (lifted,) = touch.pointed([finger(pygame.FINGERUP, 1, nowhere, 0)], SIZE)
    assert (lifted.type, lifted.pos) == (pygame.MOUSEBUTTONUP, (0, HIGH))


def test_a_finger_drags_the_crank_pin(player: Player) -> None:
    x, y = player.window.screen.crank_pin()
    for event in (
        finger(pygame.FINGERDOWN, 3, x, y),
        finger(pygame.FINGERMOTION, 3, x, y - 12),
        finger(pygame.FINGERUP, 3, x, y - 12),
    ):
        pygame.event.post(event)
        player.tick()
    assert player.state.clock.paused
    assert player.state.phase > 0.1
