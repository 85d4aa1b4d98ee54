"""Linkages whose positions are published, each stated once for all tests."""

from __future__ import annotations

STEPHENSON = """
[points]
A = [7, 4]
B = [5, 16]
C = [25, 25]
D = [23, 10]
E = [18, 35]
F = [43, 32]
G = [45, 17]
[links]
ground = ["A", "D", "G"]
AB = ["A", "B"]
BCE = ["B", "C", "E"]
CD = ["C", "D"]
EF = ["E", "F"]
FG = ["F", "G"]
[drive]
joint = "G"
"""
"""A Stephenson III driven at its last link; PMKS_Verification v1, stephenson_iii_example_2."""
