"""Everything that can go wrong and be said in one line.

`BadInput` is the caller's to mend (exit code 2); `WorkFailed` is not (exit code 1).
A message names the file and key where there is one, the value, the reason and the way out.
"""


class LinkanimError(Exception):
    """Base of every error that linkanim raises on purpose."""

    exit_code = 1


class BadInput(LinkanimError):
    """What was asked for cannot be done as asked; `keys` lead to the place in a document, if there is one."""

    exit_code = 2
    keys: tuple[str, ...] = ()


class UnitError(BadInput):
    """A quantity without a unit, with an unknown one, or not a finite number."""


class SceneError(BadInput):
    """A scene file, or a name in the catalogue, that does not describe a linkage."""


class OtherVersion(BadInput):
    """A file of ours that a linkanim of another version wrote; it stays as it is."""


class AssemblyError(BadInput):
    """Lengths that cannot be assembled, or not as asked."""


class DyadAtLimit(AssemblyError):
    """A dyad before or behind links that are solved together comes to a limit: it belongs to them."""


class EndsError(AssemblyError):
    """Ends of an input's length that its linkage cannot reach."""


class OutOfRange(BadInput):
    """An input that the linkage cannot reach."""


class WorkFailed(LinkanimError):
    """The input was right and the work still could not be finished."""


class NoDisplay(WorkFailed):
    """There is no screen to open a window on."""


class RecordingFailed(WorkFailed):
    """The encoder or the disk gave up; nothing was left under the name asked for."""


def shortened(text: str, most: int = 500) -> str:
    """Return a text in at most `most` characters; of a longer one, its beginning and its end."""
    half = (most - 3) // 2
    return text if len(text) <= most else f"{text[:half]}...{text[-half:]}"
