"""A pin in the slots of two links, of which one turns and one does not: the centres of its block."""

from __future__ import annotations

from itertools import combinations
from typing import Any

import pytest
from mpmath import mp, mpc, mpf

from linkanim.mechanics.centres import blocks, centre, kennedy, slide_between, touch
from linkanim.mechanics.linkage import Body
from linkanim.scenes import load
from linkanim.scenes.reading import scene_from
from linkanim.scenes.scene import Scene

PHASES = [0.1, 0.7, 1.9, 3.3, 4.6, 5.8]


def two_slots(*, named: bool) -> Scene:
    """Return a crank whose pin A is in the slot of a bar about G and in the slot of a yoke."""
    document = {
        "drive": {"speed": "3 rad/s"},
        "ground": {"O": [0, 0], "G": [-3, -10]},
        "joints": {
            "A": {"crank": "O", "length": 7},
            "E": {"slot": {"pivot": "G", "through": "A"}, "length": 6},
            "Y": {"slide": {"line": {"through": "G", "angle": "0 deg"}, "pin": "A", "slot": "60 deg"}},
        },
    }
    if named:
        document["bodies"] = {
            "crank": {"joints": ["O", "A"]},
            "bar": {"joints": ["G", "E"]},
            "yoke": {"slider": "Y"},
        }
    return scene_from(document, name="two-slots", where="two-slots.toml")


def block_and_yoke(scene: Scene) -> tuple[Body, Body]:
    one = {body.slider: body for body in (*scene.linkage.bodies, *blocks(scene.linkage))}
    return one["A"], one["Y"]


def pin_at(phase: Any) -> Any:
    return 7 * mp.expj(phase)


def yoke_at(phase: Any) -> Any:
    """Return where the slot through the pin, at 60°, meets the yoke's line y = -10."""
    pin = pin_at(phase)
    return mpc(pin.real - (pin.imag + 10) / mp.tan(mp.pi / 3), -10)


@pytest.mark.parametrize("named", [False, True])
@pytest.mark.parametrize("phase", PHASES)
def test_the_centre_of_the_bar_s_block_to_the_yoke_is_what_fifty_digits_say(
    phase: float, named: bool
) -> None:
    scene = two_slots(named=named)
    pose = scene.pose(phase, 1)
    with mp.workdps(50):
        start = mpf(phase)
        rate = mp.diff(lambda at: mp.arg(pin_at(at) - mpc(-3, -10)), start)
        against = mp.diff(lambda at: pin_at(at) - yoke_at(at), start)
        place = complex(pin_at(start) + mpc(0, 1) * against / rate)
    found = centre(pose, *block_and_yoke(scene))
    assert found is not None
    assert found.place == pytest.approx(place, rel=1e-11)


@pytest.mark.parametrize("phase", PHASES)
def test_the_centres_of_any_three_links_lie_in_one_line(phase: float) -> None:
    scene = two_slots(named=True)
    pose = scene.pose(phase, 1)
    for three in combinations((None, *scene.linkage.bodies, *blocks(scene.linkage)), 3):
        centres = [centre(pose, one, other) for one, other in combinations(three, 2)]
        points = [
            (each.place, 1.0) if each.place is not None else (each.direction, 0.0) for each in centres if each
        ]
        assert len(points) == 3
        (a, u), (b, v), (c, w) = points
        # in homogeneous coordinates: where they lie in one line, also one at infinity, the determinant is 0
        minors = ((b.conjugate() * c).imag * u, (c.conjugate() * a).imag * v, (a.conjugate() * b).imag * w)
        assert abs(sum(minors)) <= 1e-9 * max(1.0, *map(abs, minors))


def test_the_block_touches_its_bar_and_not_the_yoke() -> None:
    scene = two_slots(named=True)
    linkage = scene.linkage
    bodies = {body.name: body for body in linkage.bodies}
    (block,) = blocks(linkage)
    assert slide_between(linkage, block, bodies["bar"])
    assert not touch(linkage, block, bodies["yoke"])
    assert touch(linkage, None, bodies["yoke"])


def test_kennedy_s_theorem_leads_to_nothing_by_a_slot_that_the_block_is_not_in() -> None:
    linkage = two_slots(named=False).linkage
    links = {"1": None, "2": blocks(linkage)[0], "3": blocks(linkage)[1]}
    assert kennedy(linkage, links) == ()


def test_a_block_on_the_lines_of_two_links_travels_along_the_first() -> None:
    coupling = load("oldham")
    motion = coupling.solve(phase=[0.0, *PHASES], derivatives=0)
    o, a, m = (motion.position[name] @ [1, 1j] for name in ("O2", "A", "M"))
    assert coupling.linkage.slides["M"].start == "O2"
    assert motion.travel["cross"] == pytest.approx(((m - o) / (a - o) * abs(a - o)).real, abs=1e-12)
