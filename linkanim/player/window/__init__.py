"""The window itself: the loop, the display, what is shown when."""
