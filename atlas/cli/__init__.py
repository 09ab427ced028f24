"""The command line. Commands import libraries when they run, so that ``--help`` is there at once."""

from atlas.cli.app import main

__all__ = ["main"]
