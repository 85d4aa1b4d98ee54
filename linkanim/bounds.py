"""The most that is taken of anything, so that no input, by slip or on purpose, brings the machine down."""

from __future__ import annotations

MOST_NAMES = 64
"""Joints, pins, bodies, springs or dampers of a scene, each: so many run smoothly with all their names."""
MOST_TURNS = 1_000
"""Turns of the input, or ways there and back, after which every joint is back."""
MOST_GEARED_TURNS = 20_000
"""Turns of the quickest crank in those."""
MOST_DYAD_TURNS = 2_000
"""The same times the dyads, each of which is looked at all along."""
MOST_CHANGE_POINTS = 100
"""Of one dyad in those: next to each its formulas are others, which are compiled with all the rest."""
MOST_PROBLEMS = 100
"""Problems of one scene file that are printed."""
LONGEST_TEXT = 1_000
"""Characters of a title or any other text that is shown on a line."""
MOST_FRAMES = 100_000
"""Frames of a recording."""
MOST_POSES = 360
"""Poses of one figure behind its own."""
MOST_DRAWN = 5_100
"""Joints in all of them: so many are drawn in some ten seconds."""
MOST_DRAWN_PIXELS = 1920 * 1080
"""Pixels of a picture up to which they are; of a larger one fewer in proportion."""
MOST_ASKED = 60_000
"""Questions of a round times the square of a scene's joints, whose names keep off each other in a figure."""
MOST_VERSIONS = 500
"""Versions of an exercise times a scene's joints: lengths are sought for each, and all is worked out."""
MOST_CHARTED = 1_000
"""Quantities of a report with all of them, at each of its speeds."""
MOST_LISTED = 36
"""Speeds or angles that are given in a list: each has curves, or tables and figures, of its own."""
MOST_NUMBERS = 100_000_000
"""Numbers of a sweep: some 2 GB of CSV."""
MOST_NUMBERS_READ = 4_000_000
"""The same of one that is printed to be read, whose columns are known when all rows are."""
MOST_ACTIONS = 100_000
"""Actions of a tape."""
MOST_AT_ONCE = 100
"""Those of them at one frame that take their time, such as to put another mechanism on."""
LARGEST_SIDE = 16_384
"""Pixels of a picture's width or height; H.264 has no more."""
MOST_PIXELS = 7680 * 4320
"""Pixels of a picture; those of a recording, with the frames in flight, take some 2 GB."""
MOST_DIGITS = 1_000
"""Digits of a number as it is written."""
MOST_ROWS_READ = 20_000
"""Rows of a table that is laid over a chart."""
