"""Match: a four-bar is dragged until its coupler point runs along a dotted curve. From the ground up: what a
linkage is worth beside a curve, the levels, the game."""
