"""Claims about the paper's equations and their verdicts; an independent witness."""
