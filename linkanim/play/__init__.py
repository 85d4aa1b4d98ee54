"""What is played with linkages; it stands on all that shows them."""
