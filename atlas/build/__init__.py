"""Joins the floors below: from a report file to pages and PDF, from a recipe to a figure."""

from atlas.build.figure import build_figure
from atlas.build.report import Built, build_report

__all__ = ["Built", "build_figure", "build_report"]
