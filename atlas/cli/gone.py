"""Names that went, and what took their place."""

GONE = {"general": "--omega W1 W2 W3", "asymmetric": "--inertia I1 I2 I3"}
"""Commands that are part of `atlas motion`, with the option that asks for what they did."""
