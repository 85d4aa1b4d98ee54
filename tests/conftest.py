"""What every test needs: no window, no sound, and property tests without a clock."""

from __future__ import annotations

import os

from hypothesis import settings

os.environ.setdefault("SDL_VIDEODRIVER", "dummy")
os.environ.setdefault("SDL_AUDIODRIVER", "dummy")

settings.register_profile("linkanim", deadline=None, derandomize=True, database=None)
settings.load_profile("linkanim")
