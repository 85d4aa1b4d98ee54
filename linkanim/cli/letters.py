"""Say on stderr which letters of what was written no font has."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

from linkanim.letters import LATEX, PDF, PIXELS, UNJOINED, Setting, lacking
from linkanim.scenes.scene import Scene

if TYPE_CHECKING:
    from linkanim.manifest import Output
    from linkanim.paper.write import Written

_SET_BY = {".png": PIXELS, ".pdf": PDF}
"""What sets the words of a file; those of an SVG are set by its viewer."""


def tell(words: str, by: Setting) -> None:
    """Say which letters of words have a stand-in where they are set so, if any has."""
    if words.isascii():
        return
    if by is LATEX:
        from linkanim.explain.formula import latex_has

        missing = {by: lacking(words, latex_has)}
    else:
        from linkanim.picture.text import JOINS, Fonts, script_of

        fonts = Fonts()
        missing = {PIXELS: lacking(words, fonts.has)}
        if by is not PIXELS or not JOINS:
            there = "".join(char for char in words if fonts.has(char))
            missing[by if by is not PIXELS else UNJOINED] = lacking(there, lambda char: not script_of(char))
    for setting, letters in missing.items():
        if sentence := setting.sentence(letters):
            print(sentence, file=sys.stderr)


def tell_of_picture(shown: Written, target: Output, *, latex: bool = False) -> None:
    """Say it of the words of a picture that was written; with `latex` they are left to LaTeX."""
    from linkanim.picture.items import words_of

    by = LATEX if latex else _SET_BY.get(target.path.suffix.lower())
    if by:
        tell(words_of(shown.groups()), by)


def tell_of_scene(scene: Scene, by: Setting, *, title: bool = True, names: bool = True) -> None:
    """Say it of a scene's own words, as far as these are shown."""
    linkage = scene.linkage
    called = [joint.name for joint in linkage.joints] + [body.name for body in linkage.bodies]
    called += [strut.name for strut in linkage.springs + linkage.dampers]
    tell(" ".join([scene.title] * title + called * names), by)
