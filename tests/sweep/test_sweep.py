"""Random linkages by the thousand: each is refused in a sentence, or runs closed, finite and smooth."""

from __future__ import annotations

import json

import pytest
from sweeping import outcome
from typed_linkages import linkages

SEED = 20
LONG_SEED = 8


def failures(seed: int, count: int, *, thorough: int = 1) -> list[str]:
    """Return a line for each linkage that neither is refused nor runs as it must, with its document.

    Every so many-th is looked at thoroughly.
    """
    found = []
    for index, (kind, document) in enumerate(linkages(seed, count)):
        faults = outcome(document, thorough=index % thorough == 0).faults
        if faults:
            found.append(f"{kind}: {'; '.join(faults)}: {json.dumps(document)}")
    return found


@pytest.mark.long
def test_two_thousand_linkages_are_refused_or_run() -> None:
    assert failures(SEED, 2000, thorough=10) == []


@pytest.mark.long
def test_twenty_thousand_linkages_are_refused_or_run() -> None:
    assert failures(LONG_SEED, 20_000) == []
