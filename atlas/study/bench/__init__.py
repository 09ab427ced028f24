"""Error against time, by the closed forms, by their peers and by integrators.

The question: how many true digits does a second buy, and for how long?

`run.run` measures and returns a `results.Results`; `results.write` and `results.read` keep it as JSON; `tables.tables`
shows it, and the recipes work_precision, horizon and cost draw it.
"""
