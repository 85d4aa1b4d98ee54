"""Change points of dyads further down the chain, found on the cycle.

The margin U·W of such a dyad touches zero without crossing it where its two bars fall into one line
for an instant; what drives the dyad is at an extreme there (`separation`).
"""

from __future__ import annotations

from dataclasses import replace

from linkanim.errors import AssemblyError
from linkanim.mechanics.closing.assemble import JUST_AFTER, most_turns
from linkanim.mechanics.closing.assembly import Assembly
from linkanim.mechanics.closing.chain import ChainRoot, Touch
from linkanim.mechanics.closing.separation import Separations, separations
from linkanim.mechanics.formulas.planar import Slope

LEAST = 1e-40
"""Share of a margin's scale below which it has no digits left."""


def through_change_points(assembly: Assembly, found: Separations) -> tuple[Assembly, Separations]:
    """Return the assembly with the zeros of the dyads on moving points, and how they fare on it.

    In the chain's order: where one passes onto its other closure, what stands on it goes another way.
    """
    for name in found.names:
        through = _through(assembly, name, found)
        if found.touches(name):
            found = separations(through)
        assembly = through
    return assembly, found


def _through(assembly: Assembly, name: str, found: Separations) -> Assembly:
    """Return the assembly with one dyad's zeros: its limits, which are known, and its change points."""
    path, known = assembly.path, assembly.chain.get(name, ChainRoot((), 0.0))
    touches = tuple(Touch(path.place(phase), path.periods, path.amplitude) for phase in found.touches(name))
    root = ChainRoot((*known.zeros, *touches), found.scale(name) * LEAST)
    if not root.zeros:
        return assembly
    side = root.side(path.state(JUST_AFTER, Slope(1.0)))
    assert isinstance(side, float)
    if len(touches) % 2:
        path = path.doubled()
        if path.periods > (most := most_turns(assembly.linkage)):
            raise AssemblyError(
                f"joint {name}: with the change points up to this one every joint is back after "
                f"{path.periods:,} turns only, and {most:,} are the most here;"
                " make one of its lengths a little longer or shorter"
            )
    return replace(assembly, path=path, chain={**assembly.chain, name: replace(root, sign=side)})
