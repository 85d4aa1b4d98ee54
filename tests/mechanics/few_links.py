"""Random four- and five-link scenes of four kinds, the same for the same number."""

from __future__ import annotations

import numpy as np

from linkanim.scenes.reading import scene_from
from linkanim.scenes.scene import Scene
from linkanim.scenes.toml import parse


def four_bar(draw: np.random.Generator) -> str:
    crank, ground, coupler = draw.uniform(20, 40), draw.uniform(80, 120), draw.uniform(70, 120)
    rocker = draw.uniform(max(crank + abs(ground - coupler), 50) + 1, ground + coupler - crank - 1)
    lengths = f"ground = {ground}\ncrank = {crank}\ncoupler = {coupler}\nrocker = {rocker}\n"
    return f'[four-bar]\n{lengths}assembly = "{draw.choice(["open", "crossed"])}"\n'


def slider_crank(draw: np.random.Generator) -> str:
    crank, offset = draw.uniform(20, 40), draw.uniform(-20, 20)
    rod = draw.uniform(crank + abs(offset) + 5, 160)
    return f"[slider-crank]\ncrank = {crank}\nrod = {rod}\noffset = {offset}\n"


def inverted(draw: np.random.Generator) -> str:
    crank, ground = draw.uniform(20, 40), draw.uniform(60, 120)
    return (
        f'[ground]\nO2 = [0, 0]\nO4 = [{ground}, 0]\n[joints.A]\ncrank = "O2"\nlength = {crank}\n'
        f'[joints.P]\nslot = {{ pivot = "O4", through = "A", offset = {draw.uniform(-10, 10)} }}\n'
        "length = 200\n"
        '[bodies]\ncrank = { joints = ["O2", "A"] }\nbar = { joints = ["O4", "P"] }\n'
    )


def geared_five_bar(draw: np.random.Generator) -> str:
    ratio, first, second = draw.choice(["-2", "-1", "1", "2"]), draw.uniform(15, 30), draw.uniform(15, 30)
    bars = draw.uniform(90, 120, 2)
    return (
        f'[ground]\nO2 = [0, 0]\nO5 = [100, 0]\n[joints.A]\ncrank = "O2"\nlength = {first}\n'
        f'[joints.D]\ncrank = "O5"\nlength = {second}\n'
        f'gear = {{ with = "A", ratio = {ratio}, offset = "{draw.uniform(0, 360)} deg" }}\n'
        f'[joints.B]\nfrom = ["A", "D"]\nlength = [{bars[0]}, {bars[1]}]\nside = "left"\n'
        '[bodies]\n2 = { joints = ["O2", "A"] }\n3 = { joints = ["A", "B"] }\n'
        '4 = { joints = ["D", "B"] }\n5 = { joints = ["O5", "D"] }\n'
    )


def drawn(number: int) -> Scene:
    draw = np.random.default_rng(number)
    made = (four_bar, slider_crank, inverted, geared_five_bar)[number % 4](draw)
    head = 'title = "Drawn"\nlength_unit = "mm"\n[drive]\nspeed = "20 rpm"\n'
    return scene_from(parse(head + made, "drawn"), name="drawn", where="drawn")
