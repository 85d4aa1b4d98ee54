# 02  One pose in four lines: positions, velocities and accelerations of the press at 87 degrees
import math, linkanim

press = linkanim.load("press")
motion = press.solve(angle=math.radians(87), speed=10.0)
print("B is at", motion.position["B"], "mm and moves at", motion.velocity["B"], "mm/s")
