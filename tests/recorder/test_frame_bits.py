"""Frames and palettes are the same bytes on every machine, and with numpy's vector units off."""

from __future__ import annotations

import json
import os
import subprocess
import sys

import numpy as np
import pytest
from frame_bits import KEPT, hashes, kept, without_words


@pytest.fixture(scope="module")
def found() -> dict[str, str]:
    return hashes()


@pytest.mark.slow
def test_frames_and_palettes_are_the_bytes_that_are_kept(found: dict[str, str]) -> None:
    """`python tests/recorder/frame_bits.py --write` keeps new ones, after a change that is meant."""
    assert without_words(found) == kept()


@pytest.mark.long
@pytest.mark.slow
def test_no_vector_unit_changes_a_byte(found: dict[str, str]) -> None:
    units = np.show_config(mode="dicts")["SIMD Extensions"].get("found", [])
    if not units:
        pytest.skip("numpy uses no vector units here beyond the least")
    environment = {**os.environ, "NPY_DISABLE_CPU_FEATURES": " ".join(units)}
    run = [sys.executable, "-W", "ignore", str(KEPT.with_name("frame_bits.py"))]
    printed = subprocess.run(run, env=environment, capture_output=True, text=True, check=True).stdout
    assert json.loads(printed) == found
