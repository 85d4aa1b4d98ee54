"""Keys, mouse and what they ask for."""
