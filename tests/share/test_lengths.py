"""Other lengths on a page: what its solver finds is what solving finds, and its sliders show it."""

from __future__ import annotations

import json
from math import degrees, isclose, pi, remainder
from pathlib import Path
from random import Random
from typing import Any

import numpy as np
import pytest
from browser import PROGRAM, Page, browser
from shared_page import put

from linkanim.errors import LinkanimError
from linkanim.scenes import load, names
from linkanim.scenes.reading import scene_from
from linkanim.scenes.scene import Scene
from linkanim.share.lengths import model
from linkanim.share.page import Shared

SCENES = (
    "crank-rocker", "slider-crank", "watt-1", "double-rocker", "jansen", "press", "whitworth", "scotch-yoke",
    "scissor-lift", "cardan-gears", "geared-five-bar-2-1",
)  # fmt: skip
EACH, QUICKLY = 40, 5
"""So many sets of lengths of each scene, and in a quick run."""
CLOSE = 1e-9
"""Of a linkage's longest link."""

pytestmark = pytest.mark.skipif(PROGRAM is None, reason="needs chromium")


def document(found: dict[str, Any], values: list[float], *, other: bool = False) -> dict[str, Any]:
    """Return a scene file of a page's linkage with other lengths; on the other closure of its first dyad."""
    pins: dict[str, Any] = {}
    joints: dict[str, Any] = {}
    turned = other
    for one in found["joints"]:
        name, numbers = one["name"], one.get("r")
        match one["kind"]:
            case "pin" if "base" in one:
                base, reach = pins[one["base"]], values[numbers]
                pins[name] = [base[0] + reach * one["way"][0], base[1] + reach * one["way"][1]]
            case "pin":
                pins[name] = list(one["place"])
            case "crank":
                joints[name] = {"crank": one["pivot"], "length": values[numbers]}
                if (one["ratio"], one["offset"]) != (1.0, 0.0):
                    driver = next(name for name, of in joints.items() if "crank" in of and "gear" not in of)
                    shift = f"{degrees(one['offset'])!r} deg"
                    joints[name]["gear"] = {"with": driver, "ratio": one["ratio"], "offset": shift}
            case "slot":
                slot = {"pivot": one["pivot"], "through": one["through"], "offset": values[one["offset"]]}
                joints[name] = {"slot": slot, "length": values[numbers]}
            case "yoke":
                angle, across = (float(np.arctan2(*one[key][::-1])) for key in ("way", "slot"))
                guide: dict[str, Any] = {"through": one["through"], "angle": f"{degrees(angle)!r} deg"}
                guide["offset"] = values[one["offset"]]
                slide = {"pin": one["pin"], "line": guide, "slot": f"{degrees(across - angle)!r} deg"}
                joints[name] = {"slide": slide}
            case "bars":
                side = one["side"] * (-1 if turned else 1)
                joints[name] = {"from": list(one["ends"]), "length": [values[n] for n in numbers]}
                joints[name]["side"] = "left" if side > 0 else "right"
                turned = False
            case "slider":
                side = one["side"] * (-1 if turned else 1)
                bearing = f"{degrees(np.arctan2(*one['way'][::-1]))!r} deg"
                line = {"through": one["through"], "angle": bearing, "offset": values[one["offset"]]}
                joints[name] = {"from": one["end"], "length": values[numbers], "line": line}
                joints[name]["side"] = "forward" if side > 0 else "backward"
                turned = False
            case "point":
                joints[name] = {"on": list(one["on"]), "at": [values[n] for n in numbers]}
    return {"ground": pins, "joints": joints, "drive": {"speed": "1 rad/s"}}


def changed(found: dict[str, Any], random: Random) -> list[float]:
    """Return lengths within the ends of their sliders."""
    spread = random.choice((0.1, 0.5))
    values = list(found["values"])
    for slider in found["sliders"]:
        value = values[slider["number"]] * (1 + random.uniform(-spread, spread))
        values[slider["number"]] = min(max(value, slider["least"]), slider["most"])
    return values


def put_lengths(page: Page, found: dict[str, Any], values: list[float]) -> Any:
    """Move every slider of a page, and return what it then says of the linkage."""
    order = [slider["number"] for slider in found["sliders"]]
    return page.value(
        f"""(() => {{
          const inputs = document.querySelectorAll("#sliders input"), values = {json.dumps(values)};
          {json.dumps(order)}.forEach((number, n) => {{
            inputs[n].value = values[number];
            inputs[n].dispatchEvent(new Event("input"));
          }});
          const {{ solver }} = lengths;
          return {{ set: solver.values, range: solver.range(), grashof: solver.grashof(),
                    closes: solver.range() !== undefined,
                    told: document.getElementById("made").textContent }};
        }})()"""
    )


def solved(page: Page, angles: list[float], flips: dict[str, int]) -> Any:
    return page.value(f"{json.dumps(angles)}.map(angle => lengths.solver.solve(angle, {json.dumps(flips)}))")


def faults(page: Page, found: dict[str, Any], values: list[float]) -> list[str]:
    """Return where a page and solving differ in a linkage with these lengths."""
    said = put_lengths(page, found, values)
    assert np.allclose(said["set"], values, rtol=1e-12)
    try:
        scene = scene_from(document(found, said["set"]), name="page", where="page.toml")
    except LinkanimError as error:
        return [f"closes where {error}"] if said["closes"] else []
    if not said["closes"]:
        return ["is said to close nowhere"]
    wrong = [] if (said["range"] is None) == scene.info.full_turn else [f"range {said['range']}"]
    if wrong:
        return wrong
    low, high = said["range"] or (0.0, 2 * pi)
    chain = sum(joint.dyad for joint in scene.linkage.joints) > 1
    if said["range"] and not chain:  # a chain that swings comes back on other closures, and may go less far
        ends = zip(said["range"], scene.info.input_range, strict=True)
        wrong += [f"limit {one} for {own}" for one, own in ends if abs(remainder(one - own, 2 * pi)) > 1e-7]
    if said["grashof"]:
        wrong += [] if said["grashof"]["name"] == scene.info.class_name else [said["grashof"]["name"]]
        wrong += [] if said["told"].startswith(scene.info.class_name) else [said["told"]]
    angles = [low + share * (high - low) for share in (0.02, 0.3, 0.55, 0.81, 0.97)]
    return wrong + off(page, scene, angles, {})


def off(page: Page, scene: Scene, angles: list[float], flips: dict[str, int]) -> list[str]:
    """Return the joints that a page has elsewhere than solving, at angles of the input."""
    motion = scene.solve(angle=np.array(angles), speed=1.0)
    size = max(length for joint in scene.linkage.joints for _, length in joint.bars)
    found = []
    for n, joints in enumerate(solved(page, angles, flips)):
        for name, known in (joints or {}).items():
            for kind, key in (("position", "p"), ("velocity", "v")):
                true = np.broadcast_to(getattr(motion, kind)[name], (len(angles), 2))[n]
                if np.isnan(true).any():  # beyond where a chain comes back on every closure
                    continue
                reach = size if key == "p" else max(size, float(np.abs(true).max()) * 1e3)
                if not np.allclose(true, known[key], rtol=0, atol=CLOSE * reach):
                    found.append(f"{name} {kind} at {angles[n]}: {known[key]} for {true}")
        if joints is None:
            found.append(f"open at {angles[n]}")
    return found


@pytest.fixture(scope="module")
def page(tmp_path_factory: pytest.TempPathFactory) -> Any:
    with browser(tmp_path_factory.mktemp("browser")) as opened:
        yield opened


@pytest.mark.slow
@pytest.mark.thinned(3)
@pytest.mark.parametrize("sets", [QUICKLY, pytest.param(EACH, marks=pytest.mark.long)])
@pytest.mark.parametrize("name", SCENES)
def test_sliders_solve_as_solving_does(name: str, sets: int, page: Page, tmp_path: Path) -> None:
    scene = load(name)
    found = model(scene)
    assert found
    page.go(put(tmp_path, Shared(scene)))
    random = Random(7)
    wrong = [(n, fault) for n in range(sets) for fault in faults(page, found, changed(found, random))]
    assert wrong == []
    assert page.messages == []
    assert not any(one.startswith("http") for one in page.requests)


@pytest.mark.slow
def test_the_other_closure_and_the_way_back(page: Page, tmp_path: Path) -> None:
    scene = load("crank-rocker")
    found = model(scene)
    assert found
    page.go(put(tmp_path, Shared(scene)))
    assert not page.value("lengths.on")
    values = [value * 1.01 for value in found["values"]]
    put_lengths(page, found, values)
    other = scene_from(document(found, values, other=True), name="page", where="page.toml")
    assert off(page, other, [0.1, 2.0, 4.0], {"B": -1}) == []
    page.value("document.getElementById('closure').click()")
    page.frame()
    assert page.value("lengths.on && !document.getElementById('own').hasAttribute('hidden')")
    assert page.value("document.getElementById('side1').hasAttribute('hidden')")
    page.value("document.getElementById('reset').click()")
    page.frame()
    assert page.value("!lengths.on && document.getElementById('own').hasAttribute('hidden')")
    assert isclose(page.value("Number(document.querySelector('#sliders input').value)"), found["values"][0])


# of two ranges the page takes the one above the ground line, wherever that leads
@pytest.mark.parametrize("angle", [0.0, 30.0, -110.0])
def test_a_page_s_ground_line_is_the_scene_s(angle: float) -> None:
    stated = load("double-rocker").document
    turned = {**stated, "four-bar": {**stated["four-bar"], "ground_angle": f"{angle} deg"}}
    found = model(scene_from(turned, name="turned", where="turned"))
    assert found
    assert degrees(found["level"]) == pytest.approx(angle, abs=1e-9)


@pytest.mark.slow
def test_only_what_the_solver_knows_has_sliders() -> None:
    known = {name for name in names() if model(load(name))}
    assert {"crank-rocker", "slider-crank", "jansen", "stephenson-3"} <= known
    assert not known & {"excavator", "driven-piston", "geared-five-bar-3-2", "parallelogram"}
    assert len(known) == 45
