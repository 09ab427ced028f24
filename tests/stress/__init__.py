"""The stress run: every promise of the register is searched for a motion that breaks it, on extreme inputs.

`make stress` runs it whole, `.ci/run` in short form. A *regime* is a function that draws one motion that is hard on the
formulas; its table (`REGIMES`, `GENERAL` in `regimes`, `TOPS` in `tops`, `ELLIPTIC`, `ASYMMETRIC`) is all that names
it: a new one is the function and a line there. Promised errors of quantities stand in `atlas.motions.register` alone.

run               the search of all families against balls           arrays          the same of motions in arrays
integrated_tops   tops against an integrator that shares no code     three_moments   closed forms against their twins
"""
