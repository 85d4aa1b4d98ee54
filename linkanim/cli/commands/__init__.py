"""One module for each command: its `run` does the work once the options are read."""
