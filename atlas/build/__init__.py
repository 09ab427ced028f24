"""Joins what is below: figures and reports, written whole or not at all."""
