"""The record of a family of motions or surfaces; the families stand in `atlas.motions.register`."""
