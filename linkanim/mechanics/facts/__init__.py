"""What a linkage is called and can do: class, names, transmission angle, forces, all quantities."""
