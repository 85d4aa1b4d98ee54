"""What is looked through in an open overlay: the list of quantities, and the shelf of mechanisms.

Both belong to the window alone, and no tape keeps them: what is chosen there is asked for by an action of
its own ("plot", "put"), and that a tape does keep.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

from linkanim.picture.diagrams.quantities import quantity
from linkanim.picture.shelf import found_among, sifted
from linkanim.scenes.scene import Scene

RESOLVED = frozenset({"pick", "row", "scroll", "files_here", "aim", "enter"})
"""What a key asks for in a list, on the shelf or a sheet; the window asks for what it means there instead."""


@dataclass(frozen=True)
class FileNames:
    """Names of files, of which a folder may have a hundred thousand, and the letters that sift them."""

    names: tuple[str, ...]
    sieve: str = ""

    @cached_property
    def found(self) -> tuple[str, ...]:
        """Those that have all the sieve's words."""
        return sifted({name: name for name in self.names}, self.sieve)

    @cached_property
    def rows(self) -> tuple[tuple[str, str], ...]:
        """The same as rows of a list: words, and nothing behind them."""
        return tuple((name, "") for name in self.found)


@dataclass(frozen=True)
class Listing:
    """The open list: the row that is chosen, and the letters that sift it; of quantities, or of `files`."""

    chosen: int
    sieve: str = ""
    files: FileNames | None = None

    def found(self, scene: Scene) -> tuple[str, ...]:
        """Return the files, or a scene's quantities by their tokens, that have all the sieve's words."""
        return listed(scene, self.sieve) if self.files is None else self.files.found

    def sifted(self, sieve: str) -> Listing:
        """Return it with other letters, at its top."""
        return Listing(0, sieve, self.files and replace(self.files, sieve=sieve))


@dataclass(frozen=True)
class Browsing:
    """The open shelf: its mechanisms as the state has them, the one that is chosen, the frame of opening.

    Letters sift it; it is scrolled to the row numbered `top`.
    """

    entries: tuple[Scene | str, ...]
    chosen: int
    since: int
    sieve: str = ""
    top: int = 0

    @cached_property
    def found(self) -> tuple[int, ...]:
        """The places of those that have all the sieve's words."""
        return found_among(self.entries, self.sieve)

    def sifted(self, sieve: str) -> Browsing:
        """Return it with other letters, at the first that is found where the chosen one is not."""
        other = replace(self, sieve=sieve, top=0)
        return other if self.chosen in other.found else replace(other, chosen=(*other.found, self.chosen)[0])


def listed(scene: Scene, sieve: str) -> tuple[str, ...]:
    """Return the tokens of the quantities that have all the sieve's words, the telling ones first."""
    found = {token: quantity(scene, token) for token in (*scene.telling, *scene.quantities)}
    return sifted({token: f"{token} {one.words} {one.symbol}" for token, one in found.items()}, sieve)
