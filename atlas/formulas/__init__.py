"""The constants of motions as formulas, written once for exact rationals, balls and arrays in two words."""
