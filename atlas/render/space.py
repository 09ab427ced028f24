def draw_space(axes, panel):
    raise NotImplementedError
