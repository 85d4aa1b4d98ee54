"""The window: keys, the pure state behind it, tapes and the loop."""
