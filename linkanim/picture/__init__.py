"""The picture: everything between a pose and the pixels of a surface."""
