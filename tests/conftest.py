"""What every test needs: no window, no sound, and property tests without a clock."""

from __future__ import annotations

import os

import pytest
from hypothesis import settings

os.environ.setdefault("SDL_VIDEODRIVER", "dummy")
os.environ.setdefault("SDL_AUDIODRIVER", "dummy")

settings.register_profile("linkanim", deadline=None, derandomize=True, database=None)
settings.load_profile("linkanim")


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Skip what needs a real window where there is no display to open it on."""
    if not os.environ.get("DISPLAY"):
        no_display = pytest.mark.skip(reason="needs a display; .ci/run starts one")
        for item in items:
            if "window" in item.keywords:
                item.add_marker(no_display)
