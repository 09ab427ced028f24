"""Joins what is below: figures and reports, built only where something changed, written whole or not at all."""
