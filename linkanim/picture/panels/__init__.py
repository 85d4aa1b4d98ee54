"""What lies over the picture: the HUD, lists, help, chips, marks."""
