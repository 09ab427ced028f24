"""Motions whose axis nutates, in elliptic functions: of a symmetric body, a top, three moments."""
