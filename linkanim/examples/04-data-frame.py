# 04  A batch of poses as a pandas data frame: one row for each degree of the crank
import numpy as np
import pandas as pd

import linkanim

scene = linkanim.load("slider-crank")
motion = scene.solve(angle=np.radians(np.arange(360)), speed=10.0)
tokens = ("slider.travel", "slider.travel_velocity", "slider.travel_acceleration", "transmission_angle")
frame = pd.DataFrame({token: scene.quantities[token].read(motion) for token in tokens})
frame.index.name = "crank angle (deg)"
print(frame.describe())
frame.to_csv("slider-crank.csv")
