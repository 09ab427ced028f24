"""The point charge, and the flight of a point of the body."""
