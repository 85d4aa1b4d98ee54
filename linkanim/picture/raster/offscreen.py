"""A surface without a window, and its bytes."""

from __future__ import annotations

from io import BytesIO

import pygame


def offscreen(size: tuple[int, int], *, alpha: bool = False) -> pygame.Surface:
    """Return a surface of 32-bit pixels whose bytes are blue, green, red and, where `alpha`, opacity."""
    opacity = 0xFF000000 if alpha else 0
    return pygame.Surface(size, pygame.SRCALPHA if alpha else 0, 32, (0xFF0000, 0xFF00, 0xFF, opacity))


def pixel_view(surface: pygame.Surface) -> memoryview:
    """Return a surface's pixels, row by row, as they are; it cannot be drawn on while the view is held."""
    return memoryview(surface.get_buffer())  # type: ignore[arg-type]


def png_bytes(surface: pygame.Surface) -> bytes:
    """Return a surface as a PNG file's bytes."""
    file = BytesIO()
    pygame.image.save(surface, file, ".png")
    return file.getvalue()
