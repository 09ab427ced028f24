"""Motions: `base` holds the members of every class, a folder one type of motion."""
