"""A scene for the tests of forces: where they grow without bound."""

from __future__ import annotations

PUSHED = """
gravity = "9.81 m/s^2"
[drive]
slider = { joint = "C", from = 110, to = 230 }
[ground]
O = [0, 0]
[joints.C]
line = { through = "O" }
[joints.K]
from = ["C", "O"]
length = [110, 120]
[bodies]
ram = { slider = "C" }
upper = { joints = ["O", "K"], com = [60, 0], mass = "1 kg" }
"""
"""A slider that pushes two bars straight: at that end all forces are unbounded, but that on the ground."""
