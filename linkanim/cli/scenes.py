"""`linkanim scenes`: the catalogue, a line for each scene."""

from __future__ import annotations

from argparse import Namespace

from linkanim.scenes import names, titles


def run(options: Namespace) -> None:
    """Print each built-in scene's name and title; reads the titles only, and solves nothing."""
    width = max(map(len, names()))
    for name, title in titles().items():
        print(f"{name:<{width}}  {title}")
