"""A surface without a window, and its bytes."""

from __future__ import annotations

import pygame


def offscreen(size: tuple[int, int], *, alpha: bool = False) -> pygame.Surface:
    """Return a surface of 32-bit pixels whose bytes are blue, green, red and, where `alpha`, opacity."""
    opacity = 0xFF000000 if alpha else 0
    return pygame.Surface(size, pygame.SRCALPHA if alpha else 0, 32, (0xFF0000, 0xFF00, 0xFF, opacity))


def pixel_bytes(surface: pygame.Surface) -> memoryview:
    """Return a surface's pixels, row by row, without a copy; let go of them before drawing on."""
    return memoryview(surface.get_buffer())
