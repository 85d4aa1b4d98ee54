"""Scenes: the catalogue as TOML data; reading, checking, editing and writing scene files."""

from linkanim.scenes.files import chapter_of, chapters, load, names, titles
from linkanim.scenes.scene import Scene

__all__ = ["Scene", "chapter_of", "chapters", "load", "names", "titles"]
