"""From a scene to another one and back to a file: dimensions, handles, labels, writing."""
