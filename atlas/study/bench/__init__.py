"""Error against time, by the closed forms, by their peers and by integrators.

The question: how many true digits does a second buy, and for how long?

`run` measures and returns a `Record`; `read` and `write` keep it as JSON; `tables` shows it.
"""

from atlas.study.bench.record import Record, read, stored, write
from atlas.study.bench.run import CASES, run
from atlas.study.bench.tables import Table, tables

__all__ = ["CASES", "Record", "Table", "read", "run", "stored", "tables", "write"]
