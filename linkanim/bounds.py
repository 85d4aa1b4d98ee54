"""Limits on all that is read or made, so that no input, by slip or on purpose, brings the machine down."""

from __future__ import annotations

MOST_NAMES = 64
"""Joints, pins, bodies, springs or dampers of a scene, of each: as many run smoothly with their names."""
MOST_TURNS = 1_000
"""Turns of the input, or swings there and back, within which every joint has to be back: in a period."""
MOST_GEARED_TURNS = 20_000
"""Turns of the quickest crank in a period."""
MOST_TURNS_ON = 1 << 30
"""Turns of the input, or swings, up to which a pose has all its digits; of a geared crank twice as many."""
MOST_DYAD_TURNS = 2_000
"""Turns of the input in a period times the dyads, each of which is examined over all of them."""
MOST_CHANGE_POINTS = 100
"""Change points of one dyad in a period: near each, other formulas hold, compiled with all the rest."""
MOST_PROBLEMS = 100
"""Problems of one scene file that are printed."""
LONGEST_TEXT = 1_000
"""Characters of a title or any other text that is shown on a line."""
MOST_FRAMES = 100_000
"""Frames of a recording."""
MOST_POSES = 360
"""Faint poses behind the pose of a figure."""
MOST_DRAWN = 5_100
"""Joints in all the poses of a figure: as many are drawn in some ten seconds."""
MOST_DRAWN_PIXELS = 1920 * 1080
"""Pixels of a picture up to which `MOST_DRAWN` holds; in a larger one it is fewer joints in proportion."""
MOST_ASKED = 60_000
"""Questions of a round times the square of a scene's joints: a figure keeps their names off each other."""
MOST_VERSIONS = 500
"""Versions of an exercise times a scene's joints: for each, lengths are sought and a solution is made."""
MOST_CHARTED = 1_200
"""Quantities of a report with `--all`, times its speeds."""
MOST_LISTED = 36
"""Speeds or angles that are given in a list: each has curves, or tables and figures, of its own."""
MOST_NUMBERS = 100_000_000
"""Numbers of a sweep: some 2 GB of CSV."""
MOST_NUMBERS_READ = 4_000_000
"""Numbers of a sweep that is printed as a table: the columns' widths are known only when all rows are."""
MOST_ACTIONS = 100_000
"""Actions of a tape."""
MOST_AT_ONCE = 100
"""Actions of a tape at one frame that take long, such as loading another mechanism."""
LARGEST_SIDE = 16_384
"""Pixels of a picture's width or height; H.264 has no more."""
MOST_PIXELS = 7680 * 4320
"""Pixels of a picture; those of a recording, with the frames in flight, take some 2 GB."""
MOST_DIGITS = 1_000
"""Digits of a number as it is written."""
MOST_ROWS_READ = 20_000
"""Rows of a table that is laid over a chart."""
LARGEST_NUMBER = 1e30
"""The largest number that is computed with, and the inverse of the least: their powers are floats, too."""
NUMBERS = f"a number from {1 / LARGEST_NUMBER:g} to {LARGEST_NUMBER:g}, or 0"


def can_be_computed(*values: float) -> bool:
    """Return whether values are numbers within these bounds."""
    return all(value == 0.0 or 1 / LARGEST_NUMBER <= abs(value) <= LARGEST_NUMBER for value in values)
