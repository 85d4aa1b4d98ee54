"""Scenes: the catalogue as TOML data; reading, checking, editing and writing scene files.

From the ground up; a module imports from those before it only:

    scene      a linkage with its title, its source and its purpose
    toml       a scene file's text, read into a document and written
    form       fields and tables: how the form of a file is described
    file_form  the form of a scene file, stated once
    schema     that form as a JSON Schema, and as a table to read
    links      from points in one pose and the links through them to joints
    posing     a scene by its points in one pose
    foreign    linkages of other programs
    reading    from a document to a checked scene, or to all that is wrong
    files      where scenes come from: the catalogue, and the user's files
    editing    a scene with other dimensions, unit, assembly, input
    closures   every way in which a scene can be put together
    many       a scene with many lengths, solved in one call
    deviation  how far points, output and stroke are off when lengths are
"""

from linkanim.scenes.files import chapter_of, chapters, load, names, title_of, titles
from linkanim.scenes.scene import Scene

__all__ = ["Scene", "chapter_of", "chapters", "load", "names", "title_of", "titles"]
