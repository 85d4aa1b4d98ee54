"""From one picture to the next: the old one fades while the new one is already there; the shutter's flash."""

from __future__ import annotations

import pygame

from linkanim.picture.view import eased
from linkanim.player.state.state import FADE_FRAMES, State

_WHITE = 0.7
"""How white a screenshot's flash is at its brightest."""


class Fade:
    """Keeps what was shown before another mechanism or theme came on, for as long as it fades."""

    def __init__(self) -> None:
        self._old: pygame.Surface | None = None
        self._since: int | None = None

    def strength(self, state: State, surface: pygame.Surface) -> int:
        """Return how strongly (0 to 255) the old picture still shows; `surface` holds it at first."""
        if state.faded is None:
            self._old = self._since = None
            return 0
        if state.faded != self._since:
            self._old, self._since = surface.copy(), state.faded
        if self._old is None or self._old.get_size() != surface.get_size():
            return 0
        return round(255 * (1.0 - eased((state.frame - state.faded + 1) / FADE_FRAMES)))

    def draw(self, surface: pygame.Surface, strength: int, shutter: int) -> None:
        """Lay the old picture over the new one, and the shutter's white, in eighths, over both."""
        if self._old is not None and strength:
            self._old.set_alpha(strength)
            surface.blit(self._old, (0, 0))
        if shutter:
            white = pygame.Surface(surface.get_size())
            white.fill((255, 255, 255))
            white.set_alpha(round(255 * _WHITE * (shutter / 8) ** 2))
            surface.blit(white, (0, 0))
