"""What the window shows, as a value, and how actions change it."""
