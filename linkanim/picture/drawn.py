"""What is drawn into a picture beside its scene: by what is open over it, and where the mouse is."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Literal, NamedTuple, Self

from linkanim.frozen import frozen
from linkanim.mechanics.linkage import Point
from linkanim.mechanics.motion import Pose
from linkanim.picture.figure import DrawSetting
from linkanim.picture.items import Group
from linkanim.scenes.scene import Scene

if TYPE_CHECKING:
    from linkanim.build.draft import Photo
    from linkanim.synthesis.curves import DrawnCurve


Over = tuple[Point, float]
"""The place of a sheet under the mouse, in its unit, and how near is on a thing."""


class Addition:
    """Something drawn beside a scene, from its own data: a frozen value, equal where it looks the same.

    Of what it draws all that is `over` lies over what is not.
    """

    @property
    def alone(self) -> Literal["", "sheet", "bare"]:
        """Whether it stands in the linkage's place, on a sheet or on the bare ground."""
        return ""

    @property
    def is_head(self) -> bool:
        """Whether it stands in the place of the words about the scene."""
        return False

    @property
    def of_window(self) -> bool:
        """Whether it has a place of its own in the picture, and is not cut off where the linkage is."""
        return False

    @property
    def stroke(self) -> DrawnCurve | None:
        """A curve that stands behind the linkage."""
        return None

    def seen(self, over: Over | None, *, recorded: bool) -> Self:
        """Return it with the mouse `over` a place, or as a recording shows it."""
        del over, recorded
        return self

    def behind(self, setting: DrawSetting, pose: Pose) -> Iterable[Group]:
        """Return what lies behind the linkage's bars."""
        del setting, pose
        return ()

    def groups(self, setting: DrawSetting, pose: Pose) -> Iterable[Group]:
        """Return what lies over the linkage, or is drawn alone."""
        del setting, pose
        return ()


class Additions(NamedTuple):
    """All that is drawn beside a scene.

    So many `steps` of its construction are. In a `swing` the linkage is between another closure and its own,
    at a share of the way. `instant` is the phase that the mouse points at on a curve or a chart; the chart's
    cursor may have a `grip`. Where the motion `stands`, polygons are as large as their places. A `photo` lies
    behind a sheet.
    """

    drawn: tuple[Addition, ...] = ()
    steps: int = 0
    swing: tuple[Scene, float] | None = None
    instant: float | None = None
    grip: bool = False
    stands: bool = False
    photo: Photo | None = None


NOTHING_ADDED = Additions()


@frozen
class CurveBehind(Addition):
    """A curve behind the linkage."""

    curve: DrawnCurve

    @property
    def stroke(self) -> DrawnCurve:
        """The curve."""
        return self.curve
