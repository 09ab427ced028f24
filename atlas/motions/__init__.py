"""Motions: `base` is what all of them offer, a folder holds one kind."""
