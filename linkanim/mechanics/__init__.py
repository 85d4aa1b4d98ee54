"""What a linkage is and how it moves; numpy is all it needs."""
