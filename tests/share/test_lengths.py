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
from shared_page import go_to, put

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
    drive = {"speed": "1 rad/s", "joint": found["drive"], "returns": "same" if found["retraced"] else "other"}
    drive |= {} if found["stated"] is None else {"start": f"{found['stated']!r} rad"}
    return {"ground": pins, "joints": joints, "drive": drive}


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
          const {{ solver }} = lengths, range = solver.range();
          return {{ set: solver.values, range: range && [range.low, range.high], grashof: solver.grashof(),
                    closes: range !== undefined,
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
    stops = scene.mechanism.stops
    if said["range"] and all(stops):
        ends = zip(said["range"], scene.info.input_range, strict=True)
        wrong += [f"limit {one} for {own}" for one, own in ends if abs(remainder(one - own, 2 * pi)) > 1e-7]
    if all(stops):
        wrong += swung(page, scene)
    if said["grashof"]:
        wrong += [] if said["grashof"]["name"] == scene.info.class_name else [said["grashof"]["name"]]
        wrong += [] if said["told"].startswith(scene.info.class_name) else [said["told"]]
    angles = [low + share * (high - low) for share in (0.02, 0.3, 0.55, 0.81, 0.97)]
    return wrong + off(page, scene, angles, {})


SWINGS: dict[str, dict[str, Any]] = {
    "comes back on the same closure": {
        "drive": {"returns": "same"},
        "four-bar": {"ground": 110, "crank": 130, "coupler": 50, "rocker": 100},
    },
    "comes back on the other closure": {
        "four-bar": {"ground": 110, "crank": 130, "coupler": 50, "rocker": 100},
    },
    "is back after two turns, of which a dyad lets it swing": {
        "drive": {"joint": "A", "returns": "same"},
        "ground": {"O": [0, 0], "G": [100, 0]},
        "joints": {
            "A": {"crank": "O", "length": 40},
            "B": {"crank": "G", "length": 50, "gear": {"with": "A", "ratio": "1/2"}},
            "C": {"from": ["A", "B"], "length": [60, 60], "side": "left"},
        },
    },
    "is stopped at both ends by its second loop": {
        "six-bar": {"lengths": [100, 30, 90, 80, 120, 60, 90, 80]},
    },
    "is stopped by its second loop inside the range of the first": {
        "drive": {"start": "1 rad"},
        "six-bar": {"lengths": [100, 80, 30, 90, 120, 60, 110, 50]},
    },
    "is stopped by its first loop, all the way": {
        "drive": {"start": "1 rad"},
        "six-bar": {"lengths": [100, 80, 30, 90, 120, 60, 160, 150]},
    },
    "is stopped by a slider with a short rod": {
        "slider-crank": {"crank": 60, "rod": 40, "offset": 5},
    },
    "is stopped by a slot that misses its pivot": {
        "drive": {"joint": "A"},
        "ground": {"O": [0, 0], "Q": [50, 0]},
        "joints": {
            "A": {"crank": "O", "length": 30},
            "P": {"slot": {"pivot": "Q", "through": "A", "offset": 40}, "length": 60},
        },
    },
}


@pytest.mark.parametrize("what", SWINGS)
def test_a_page_s_own_linkage_swings_as_the_scene_does(what: str, page: Page, tmp_path: Path) -> None:
    scene = scene_from(SWINGS[what], name="swing", where="swing")
    page.go(put(tmp_path, Shared(scene)))
    low, high = page.value("[lengths.range.low, lengths.range.high]")
    assert (low, high) == pytest.approx(scene.info.input_range, abs=1e-7)
    assert swung(page, scene) == []


def swung(page: Page, scene: Scene) -> list[str]:
    """Return the joints that a page's own linkage has elsewhere than the scene, at phases of a period."""
    period = page.value("lengths.tracks.period")
    wrong = [] if isclose(period, scene.period, rel_tol=1e-12) else [f"is back after {period}"]
    phases = np.linspace(0.03, scene.period + 0.05, 41)
    motion = scene.solve(phase=phases, speed=1.0)
    size = max(length for joint in scene.linkage.joints for _, length in joint.bars)
    found = page.value(
        f"""(() => {{
          const {{ view }} = JSON.parse(document.getElementById("data").textContent).sides[0];
          return {json.dumps(phases.tolist())}.map((phase) => Object.fromEntries(
            [...lengths.tracks.keys()].map((name) => {{
              const {{ p, v }} = lengths.tracks.get(name).at(phase), [scale, left, top] = view;
              return [name, [p[0] - left, top - p[1], v[0], -v[1]].map((one) => one / scale)];
            }})));
        }})()"""
    )
    for n, joints in enumerate(found):
        for name, (x, y, *velocity) in joints.items():
            if name not in motion.position:
                continue  # a centre of mass: the document of this test has no bodies
            for told, kind in (((x, y), "position"), (velocity, "velocity")):
                true = np.broadcast_to(getattr(motion, kind)[name], (len(phases), 2))[n]
                if np.abs(told - true).max() > 1e-5 * max(size, float(np.abs(true).max())):
                    wrong.append(f"{name} {kind} at {phases[n]}: {told} for {true}")
    return wrong


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
    assert page.value("lengths.on && !document.getElementById('side1').hasAttribute('hidden')")
    assert page.value("document.getElementById('side0').hasAttribute('hidden')")
    page.value("document.getElementById('reset').click()")
    page.frame()
    assert not page.value("lengths.on")
    assert isclose(page.value("Number(document.querySelector('#sliders input').value)"), found["values"][0])


BOXES = """(() => {
  const { movers } = JSON.parse(document.getElementById("data").textContent).sides[0];
  return [...document.querySelectorAll("#side0 [data-m]")].map((group, n) => {
    const { x, y, width, height } = group.getBoundingClientRect();
    const back = document.getElementById("picture").getScreenCTM().inverse();
    const ends = [[x, y], [x + width, y + height]].map((end) => new DOMPoint(...end).matrixTransform(back));
    return { kind: movers[n].kind, given: Boolean(movers[n].given), box: ends.flatMap(({ x, y }) => [x, y]) };
  });
})()"""
ENDS = """(() => {
  const { movers } = JSON.parse(document.getElementById("data").textContent).sides[0];
  const groups = document.querySelectorAll("#side0 [data-m]"), found = [];
  movers.forEach(({ link, at, head }, n) => {
    if (!link) return;
    const paths = [...groups[n].querySelectorAll("path")], turned = groups[n].getScreenCTM().inverse();
    for (const name of [at, head]) {
      const { p } = lengths.tracks.get(name).at(Number(document.getElementById("input").value));
      const on = document.getElementById("picture").getScreenCTM();
      const there = new DOMPoint(p[0], p[1]).matrixTransform(on).matrixTransform(turned);
      const inside = (off) => paths.some((path) => path.isPointInFill(new DOMPoint(there.x + off, there.y)));
      found.push([`${link} at ${name}`, inside(0)]);
    }
  });
  return found;
})()"""


@pytest.mark.slow
@pytest.mark.parametrize("name", [*SCENES, "engine", "oscillating-cylinder", "landing-gear", "toggle-clamp"])
@pytest.mark.thinned(4)
def test_a_page_draws_changed_lengths_as_it_draws_its_own(name: str, page: Page, tmp_path: Path) -> None:
    page.sized(2400, 1500)  # so large that no name is enlarged
    page.go(put(tmp_path, Shared(load(name), names=1)))
    go_to(page, 1.0)
    own = page.value(BOXES)
    page.value("lengths.change(0, lengths.solver.values[0])")
    page.frame()
    changed = page.value(BOXES)
    assert len(own) == len(changed) > 5
    for one, other in zip(own, changed, strict=True):
        if not one["given"] and one["kind"] not in ("given", "arrows"):
            # the width of a stroke is not in its box
            near = {"rails": 5.0, "label": 1.0}.get(one["kind"], 0.3)
            assert one["box"] == pytest.approx(other["box"], abs=near), one
    assert page.messages == []


@pytest.mark.slow
@pytest.mark.parametrize("name", ["crank-rocker", "slider-crank", "jansen", "press", "whitworth"])
@pytest.mark.parametrize("share", [0.9, 1.04])
@pytest.mark.thinned(3)
def test_bars_end_at_their_joints_with_other_lengths(
    name: str, share: float, page: Page, tmp_path: Path
) -> None:
    page.go(put(tmp_path, Shared(load(name), names=1)))
    for number in range(2):
        page.value(f"lengths.change({number}, {share} * lengths.solver.values[{number}])")
    go_to(page, 1.0)
    found = page.value(ENDS)
    assert len(found) > 3
    assert [where for where, inside in found if not inside] == []


@pytest.mark.slow
def test_a_wheel_stays_round_and_holds_its_pin(page: Page, tmp_path: Path) -> None:
    page.sized(2400, 1500)
    page.go(put(tmp_path, Shared(load("engine"))))
    go_to(page, 0.0)
    sides = "(() => { const { width, height } = [...document.querySelectorAll('#side0 [data-m]')]"
    sides += ".map((group) => group.getBBox()).sort((a, b) => b.width * b.height - a.width * a.height)"
    sides += ".find(({ width, height }) => Math.abs(width / height - 1) < 0.01); return [width, height]; })()"
    before = page.value(sides)
    page.value("lengths.change(0, 1.5 * lengths.solver.values[0])")
    page.frame()
    wide, high = page.value(sides)
    assert wide == pytest.approx(high, rel=1e-3)
    assert 1.2 * before[0] < wide < 1.5 * before[0]


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
