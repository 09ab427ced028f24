"""Maps over all motions: the energy-momentum map, its critical values, separatrices, wells, monodromy."""
