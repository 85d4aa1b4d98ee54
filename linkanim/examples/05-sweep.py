"""05  A sweep of lengths, and a chart of what it does to the least transmission angle.

The scene file is a template in which one length is filled in; the chart is linkanim's own.
"""

import math
from pathlib import Path

import linkanim

TEMPLATE = """
[four-bar]
ground  = 100
crank   = 30
coupler = {coupler}
rocker  = 80
"""

rows = []
for coupler in range(60, 121, 5):
    Path("sweep.toml").write_text(TEMPLATE.format(coupler=coupler), encoding="utf-8")
    scene = linkanim.load("sweep.toml")
    least, _ = scene.info.transmission_angle
    rows.append((coupler, math.degrees(least), scene.info.class_name))
    print(f"coupler {coupler:3} mm: least transmission angle {rows[-1][1]:5.1f} deg, {rows[-1][2]}")

text = "coupler (mm),least transmission angle (deg)\n" + "".join(f"{c},{a:.3f}\n" for c, a, _ in rows)
Path("sweep.csv").write_text(text, encoding="utf-8")

try:
    import matplotlib.pyplot as plt
except ImportError:
    print("sweep.csv is written; with matplotlib there would be a chart as well")
else:
    plt.plot([row[0] for row in rows], [row[1] for row in rows])
    plt.xlabel("coupler (mm)")
    plt.ylabel("least transmission angle (deg)")
    plt.savefig("sweep.png")
