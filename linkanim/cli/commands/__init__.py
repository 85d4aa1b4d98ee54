"""A command a file: what it does once its options are read."""
