"""Objects, figures and plotters in a notebook; loaded when one is shown, without IPython."""
