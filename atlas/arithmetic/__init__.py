"""Numbers: doubles, two words, balls, exact rationals, and rotations made of them."""
