"""`linkanim manual`: the manual as one page in the browser, or a chapter of it in the terminal."""

from __future__ import annotations

import os
import shutil
import sys
from argparse import Namespace
from contextlib import suppress

from linkanim import manual
from linkanim.atomic_files import kept_as, write_text
from linkanim.errors import BadInput
from linkanim.intake import meant
from linkanim.manifest import checked_output
from linkanim.units import shown

SUFFIXES = (".html", ".htm")
_WIDEST = 100
"""The most letters of a line: longer lines are hard to read."""
_FURTHER = 8


def run(options: Namespace) -> None:
    """Print the chapter or section on a word; without a word write the page, print its path and open it."""
    if options.word:
        if options.output is not None:
            raise BadInput("-o is for the whole manual; leave out the word, or -o")
        print(_about(options.word))
        return
    if options.output is not None:
        target = checked_output(options.output, "manual.html", SUFFIXES)
        with target.replacing() as part:
            part.write_text(manual.page(), encoding="utf-8")
        print(target.path)
        return
    path = kept_as("manual.html")
    write_text(path, manual.page(), folders=True)
    print(path)
    if _has_screen():
        import webbrowser  # opens our own file; asks no network

        with suppress(webbrowser.Error):
            webbrowser.open(path.as_uri())


def _has_screen() -> bool:
    """Return whether a browser has a screen to open on; without one it would take over the terminal."""
    return sys.platform in ("win32", "darwin") or bool(
        os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY")
    )


def _about(words: list[str]) -> str:
    """Return the chapter of that name, or else the section that has most on it, and a list of others."""
    width = min(shutil.get_terminal_size().columns, _WIDEST)
    name = " ".join(words).casefold()
    titles = {one.chapter: one.title for one in manual.sections()}
    for chapter, title in titles.items():
        if name in (chapter, title.casefold()):
            return manual.printed(chapter, width)
    sections = manual.search(words)
    if not sections:
        sought = " ".join(words)
        raise BadInput(
            f"the manual has nothing on {shown(sought)}{meant(sought, titles)}; it has {', '.join(titles)}"
        )
    first, *others = sections
    text = manual.section_text(first, width)
    listed = "".join(f"  {one.chapter:<14} {one.heading.strip('`')}\n" for one in others[:_FURTHER])
    more = f"\n\nAlso (linkanim manual CHAPTER prints a whole chapter):\n{listed}" if others else ""
    return f"[{first.chapter}] {text}{more}".rstrip()
