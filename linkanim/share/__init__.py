"""One page that moves in any browser: a scene's picture and motion in one file."""
