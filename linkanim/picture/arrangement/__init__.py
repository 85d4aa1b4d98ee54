"""Where scene and words stand in a picture of a size."""
