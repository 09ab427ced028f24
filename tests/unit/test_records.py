"""Recorded results that no test can make again to the digit, such as seconds: none is changed by hand.

`pytest tests/unit/test_records.py --snapshot-update` notes the digests of new ones, as the targets of make do that
renew them.
"""

import hashlib

import pytest
from syrupy.assertion import SnapshotAssertion
from syrupy.extensions.json import JSONSnapshotExtension

from atlas.places import folder
from atlas.proof import recorded
from atlas.study.stress import LIMITS, RATCHET, read_ratchet

PATHS = (*(folder("reports") / "data").glob("*.json"), recorded.VERDICTS, recorded.MUTANTS, RATCHET)
RECORDS = {path.name: path for path in PATHS}


@pytest.mark.parametrize("name", sorted(RECORDS))
def test_a_record_is_as_it_was_written(snapshot: SnapshotAssertion, name: str) -> None:
    """Its bytes have the digest that was noted when a run had made it."""
    assert hashlib.sha256(RECORDS[name].read_bytes()).hexdigest() == snapshot.use_extension(JSONSnapshotExtension)


def test_no_recorded_error_exceeds_its_limit() -> None:
    """Each error of the ratchet is finite, no less than half a unit, and within the promise for its quantity."""
    for name, ulps in read_ratchet().items():
        assert 0.0 <= ulps <= LIMITS.get(name.partition(" | ")[0], float("inf")), name
