"""Every answer of `linkanim path` read back from its file, and measured by all options that were given.

Nothing is taken from the search: distances, orders, angles and lengths are those of the scene's own motion.
"""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from random_curves import curves

import linkanim
from linkanim.cli import main
from linkanim.scenes.scene import Scene
from linkanim.synthesis.linkages import FOUR_BAR, Complex, Real

STEPS = 8000
PAIRS = {
    "four-bar": ("O2 A", "A B", "A P", "B P", "O4 B", "O2 O4"),
    "slider-crank": ("O2 A", "A B", "A P", "B P"),
}


def swung(random: np.random.Generator) -> Complex:
    """Return points of a four-bar whose crank swings, up to a hundredth before its limits."""
    while True:
        ground, crank, coupler, rocker = random.uniform(30, 100, 4)
        row = np.array([[0, 0, crank, coupler, *random.uniform(-90, 90, 2), ground, 0, rocker]])
        turn = np.linspace(0, 2 * math.pi, 721)
        way = FOUR_BAR.points(row, np.ones(1), turn[None])[0]
        shut = np.flatnonzero(~np.isfinite(way))
        if len(shut) > 1 and (length := int(np.diff(shut).max())) > 120:
            begin = shut[np.diff(shut).argmax()]
            part = way[begin + length // 100 + 1 : begin + length - length // 100]
            return np.asarray(part[:: max(1, len(part) // 50)])


def drawn(random: np.random.Generator) -> tuple[str, Complex, list[str]]:
    """Return a curve of size 100 with the options that say what it is."""
    kind = str(random.choice(["four-bar", "four-bar", "four-bar", "slider-crank"]))
    mode = random.choice(["closed", "open", "swing"])
    if mode == "swing":
        kind, points = "four-bar", swung(random)
    else:
        count, turn = (
            int(random.choice([8, 20, 48, 64])),
            1.0 if mode == "closed" else random.uniform(0.2, 0.7),
        )
        points = curves(kind, 1, seed=int(random.integers(10**6)), points=count, turn=turn)[0]
    points = points * 100 / np.hypot(np.ptp(points.real), np.ptp(points.imag))
    noise = random.choice([0.0, 0.0, 0.1, 1.0])
    points = points - points.real.min() - 1j * points.imag.min() + 200 + 200j
    points = points + noise * random.normal(size=(len(points), 2)) @ np.array([1.0, 1j])
    return kind, points, [] if mode == "closed" else ["--open"]


def asked(random: np.random.Generator, kind: str, count: int, *, closed: bool) -> dict[str, Any]:
    """Return some of the options, as numbers."""
    found: dict[str, Any] = {"largest": 8.0}
    timing = 2 * math.pi / count if closed else math.radians(5)
    for name, share, value in (
        ("step", 0.15, timing),
        ("column", 0.15, 0.3 + timing * np.arange(count)),
        ("least_angle", 0.3, random.uniform(0.1, 0.7)),
        ("largest", 0.3, random.uniform(1.5, 5)),
        ("box", 0.3, (*random.uniform(50, 200, 2), *random.uniform(150, 400, 2))),
        ("round", 0.3, float(random.choice([0.1, 0.5, 1, 5]))),
        ("cognates", 0.5 if kind == "four-bar" else 0.0, True),
        ("prefer", 0.3, str(random.choice(["compact", "angle"]))),
    ):
        if random.random() < share:
            found[name] = value
    if "column" in found:
        found.pop("step", None)
    return found


def words(options: dict[str, Any]) -> list[str]:
    found = list[str]()
    for name, value in options.items():
        text = {
            "step": f"{value!r} rad",
            "column": "column",
            "least_angle": f"{value!r} rad",
            "box": ",".join(repr(float(one)) for one in value) if name == "box" else "",
            "round": f"{value} mm",
            "prefer": f"{value}",
        }.get(name, repr(value))
        option = {"step": "--timing", "column": "--timing"}.get(name, f"--{name.replace('_', '-')}")
        found += [option] if value is True else [option, text]
    return found


def place(motion: Any, joint: str) -> Complex:
    return np.asarray(motion.position[joint] @ np.array([1.0, 1j]))


def passed(scene: Scene, points: Complex) -> tuple[float, float]:
    """Return the root mean squares of the distances from the traced curve: to the nearest, and in order.

    That order is the points', over one period the way that the drive runs.
    """
    phases = math.copysign(scene.period, scene.linkage.drive.speed) * np.arange(STEPS + 1) / STEPS
    way = place(scene.solve(phase=phases, derivatives=0), "P")
    side, off = np.diff(way)[:, None], points - way[:-1, None]
    share = np.clip((side.conj() * off).real / np.maximum(np.abs(side) ** 2, 1e-300), 0, 1)
    squares = np.abs(off - share * side) ** 2
    first = squares[:, 0]
    begins = np.flatnonzero((first <= np.roll(first, 1)) & (first <= np.roll(first, -1)))
    best = math.inf
    for begin in begins[np.argsort(first[begins])][:6]:
        for early in (0, STEPS // 50):
            turned = np.roll(squares, early - begin, axis=0)
            least = np.minimum.accumulate(turned[:, 0])
            for column in turned.T[1:]:
                least = np.minimum.accumulate(least + column)
            best = min(best, float(least[-1]))
    return math.sqrt(squares.min(axis=0).mean()), math.sqrt(best / len(points))


def transmission(scene: Scene, kind: str, line: float) -> float:
    """Return the least transmission angle over a period: of the rod with the rocker, or across the line."""
    motion = scene.solve(phase=scene.period * np.arange(20_000) / 20_000, derivatives=0)
    pin, end = place(motion, "A"), place(motion, "B")
    other = end - place(motion, "O4") if kind == "four-bar" else 1j * np.exp(1j * line)
    angle = np.abs(np.angle((end - pin) * np.conj(other)))
    return float(np.minimum(angle, math.pi - angle).min())


def wrong(
    row: dict[str, Any], kind: str, points: Complex, options: dict[str, Any], *, closed: bool
) -> list[str]:
    """Return in which figures and limits an answer is not what it says."""
    scene, size = linkanim.load(row["file"]), np.hypot(np.ptp(points.real), np.ptp(points.imag))
    pose = {joint: complex(*at) for joint, at in scene.pose(0.3, 0).position.items()}
    longest = max(abs(pose[pair.split()[0]] - pose[pair.split()[1]]) for pair in PAIRS[kind])
    checks = {
        "longest link": abs(longest - row["largest_link"]) <= 1e-9 * size,
        "largest": longest <= options["largest"] * size * (1 + 1e-8),
        "least angle": row["transmission_angle"] >= options.get("least_angle", 0.0) - 1e-8,
    }
    if "box" in options:
        x, y, width, height = options["box"]
        for joint in ("O2", "O4") if kind == "four-bar" else ("O2",):
            off = pose[joint] - complex(x, y)
            inside = -1e-6 <= off.real <= width + 1e-6 and -1e-6 <= off.imag <= height + 1e-6
            checks[f"{joint} in the box"] = inside
    if "round" in options:
        numbers = [value for name, value in row["parameters"].items() if isinstance(value, float)]
        numbers = [value for value in numbers if value != row["parameters"].get("line_angle")]
        checks["round"] = all(abs(math.remainder(value / options["round"], 1)) < 1e-9 for value in numbers)
    least = transmission(scene, kind, row["parameters"].get("line_angle", 0.0))
    near = abs(least - row["transmission_angle"]) <= 2e-3
    checks["transmission angle"] = near or (not closed and row["transmission_angle"] > least)
    timing = options.get("column", options.get("step", 0.0) * np.arange(len(points)))
    if "step" in options or "column" in options:
        start = scene.linkage.drive.start
        if "column" in options:
            checks["start"] = abs(math.remainder(start - timing[0], 2 * math.pi)) < 1e-9
        motion = scene.solve(angle=start + timing - timing[0], derivatives=0)
        rms = math.sqrt((np.abs(place(motion, "P") - points) ** 2).mean())
        checks["rms in time"] = abs(rms - row["rms"]) <= 1e-6 * rms + 1e-8 * size
    else:
        nearest, ordered = passed(scene, points)
        margin = 3e-6 * size + 1e-3 * row["rms"]
        checks["rms"] = nearest - margin <= row["rms"]
        # an input that swings may follow it better through a limit, on both closures
        checks["rms in order"] = row["rms"] <= ordered + margin or not scene.info.full_turn
        checks["order"] = ordered <= max(3 * row["rms"], row["rms"] + margin)
    return [name for name, holds in checks.items() if not holds]


@pytest.mark.long  # half a minute each
@pytest.mark.parametrize("seed", range(8))
def test_every_answer_is_what_it_says(
    seed: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    random, answers, found = np.random.default_rng(seed), 0, list[Any]()
    for number in range(15):
        kind, points, how = drawn(random)
        options = asked(random, kind, len(points), closed=not how)
        columns: list[Real] = [points.real, points.imag]
        columns += [np.degrees(options["column"])] if "column" in options else []
        np.savetxt("curve.csv", np.stack(columns, axis=1), delimiter=",", fmt="%.17g")
        command = ["path", "curve.csv", "-o", f"{number}.toml", "--kind", kind, "--count", "2", "--json"]
        code = main([*command, *how, *words(options)])
        printed = capsys.readouterr()
        assert "unexpected" not in printed.err
        rows = json.loads(printed.out) if code == 0 else ()
        angles = [row["transmission_angle"] for row in rows]
        if options.get("prefer") == "angle" and "cognates" not in options and angles != sorted(angles)[::-1]:
            found.append((command, options, angles))
        for row in rows:
            answers += 1
            if bad := wrong(row, kind, points, options, closed=not how):
                found.append((command, options, row["file"], row["class"], bad))
    assert not found
    assert answers > 15
