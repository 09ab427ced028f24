"""Bodies and what acts on them: moments of inertia, charges, fields, units, and bodies that could exist."""
