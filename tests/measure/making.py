"""What each scene of the catalogue is made of, or why it is not, and the processor time that takes."""

from __future__ import annotations

import tempfile
import time
from pathlib import Path

from linkanim.export import columns
from linkanim.scenes import load, names
from linkanim.workshop.files import write
from linkanim.workshop.request import make

BOUND_S = 3.0
"""For a scene, its files among it."""


def row(name: str, folder: Path) -> tuple[tuple[str, ...], float]:
    """Return a scene's layers, parts and pins, or the beginning of why not, and its processor time (s)."""
    begun = time.process_time()
    made = make(load(name), fit="A4")
    if made.refused is None:
        write(made, folder / name)
    took = time.process_time() - begun
    if made.refused is not None:
        reason = made.refused.partition("cannot be made ")[2]
        return (name, "–", "–", "–", f"{took:.2f}", reason), took
    pins = sum(not pin.stuck for pin in made.pins)
    least = "" if made.fewest else "at most"
    counts = f"{least} {made.layers}".strip(), str(len(made.plates)), str(pins)
    return (name, *counts, f"{took:.2f}", f"{made.ratio:g} times as large"), took


def main() -> None:
    """Print the table, and the longest time beside its bound."""
    with tempfile.TemporaryDirectory() as room:
        found = [row(name, Path(room)) for name in names()]
    print(
        columns(
            [("scene", "layers", "parts", "pins", "s", "scale, or why not"), *(cells for cells, _ in found)]
        )
    )
    many, longest = sum(cells[1] != "–" for cells, _ in found), max(took for _, took in found)
    print(f"{many} made, {len(found) - many} refused; {longest:.2f} s at the most, {BOUND_S} allowed")


if __name__ == "__main__":
    main()
