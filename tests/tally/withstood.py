"""The table of what was withstood: sums of what the tests that passed have said of themselves.

A test says it with `@pytest.mark.withstands("bad inputs tried", 500)`, and with `record_property` where it
is measured.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator

MARK = "withstands"
ROWS: dict[str, Callable[[Iterable[float]], float]] = {
    "bad inputs tried": sum,
    "bad inputs, s of processor time at most": max,
    "bad inputs, MB at most": max,
    "faults survived": sum,
    "frames run": sum,
    "memory growth, MB": max,
}
"""What there is to withstand, and what of several tests' figures is shown."""


def table(properties: Iterable[tuple[object, ...]]) -> Iterator[str]:
    """Yield the rows for which there are figures, as Markdown; what is no figure of the table is left out."""
    found: dict[str, list[float]] = {name: [] for name in ROWS}
    for name, figure in properties:
        if name in ROWS and isinstance(figure, int | float):
            found[str(name)].append(figure)
    for name, figures in found.items():
        if figures:
            yield f"| {name} | {_shown(ROWS[name](figures))} |"


def _shown(figure: float) -> str:
    return f"{figure:,}" if isinstance(figure, int) else f"{figure:.1f}"
