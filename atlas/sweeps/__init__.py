"""Tables of quantities over many parameters: a grid or a list of them, in parts, on any executor."""
