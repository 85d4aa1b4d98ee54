# 03  A loop for a slide: one period as a GIF, with velocities and a chart beside it
import linkanim

scene = linkanim.load("crank-rocker")
look = linkanim.Look(vectors=frozenset("v"), chart="rocker.angular_velocity")
recording = linkanim.record(scene, "crank-rocker.gif", size=(640, 360), fps=20, look=look)
print(recording.path, recording.frames, "frames,", recording.seconds, "s")
