"""The vector loops as a figure: arrows from joint to joint, as SVG and for LaTeX."""

from __future__ import annotations

from linkanim.explain.solution import Solution


def svg(found: Solution) -> str:
    """Return the arrows of all loops as SVG."""
    return ""


def tikz(found: Solution) -> str:
    """Return the arrows of all loops as a TikZ picture."""
    return ""
