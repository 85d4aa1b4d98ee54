"""What of LaTeX is here: tests that set a document are left out where its packages are missing."""

from __future__ import annotations

import shutil
import subprocess

import pytest


def _lacking(*styles: str) -> bool:
    if not (shutil.which("pdflatex") and shutil.which("kpsewhich")):
        return True
    found = subprocess.run(["kpsewhich", *styles], capture_output=True, check=False)
    return found.returncode != 0


needs_tex = pytest.mark.skipif(
    _lacking("lmodern.sty", "textcomp.sty", "amsmath.sty", "tikz.sty", "geometry.sty", "graphicx.sty"),
    reason="needs pdflatex with lmodern, amsmath and tikz",
)
