"""Tables of quantities over many parameters, a grid or a list, computed in parts on any executor."""
