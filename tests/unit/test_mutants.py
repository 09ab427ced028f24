"""The tool that changes one token at a time: what it leaves out is still there, and has a reason."""

import mutants


def test_what_makes_no_difference_is_still_there() -> None:
    """Each entry of equivalent.toml names a change of a line as it stands, and says why nothing can notice it."""
    known = mutants.equivalent(mutants.ROOT)
    assert known
    assert all(reason.endswith(".") for reason in known.values())
    assert all(mutants.is_python(mutant, mutants.ROOT) for mutant in known)


def test_a_change_is_of_one_token() -> None:
    """The changed text differs from the file in one line, from the first column of the token to the last."""
    path = mutants.ROOT / "atlas" / "core" / "arithmetic" / "gyration.py"
    lines = path.read_text(encoding="utf-8").splitlines()
    for mutant in mutants.mutants(path, mutants.ROOT):
        changed = mutant.applied(path.read_text(encoding="utf-8")).splitlines()
        assert [i for i, (a, b) in enumerate(zip(lines, changed, strict=True), 1) if a != b] == [mutant.line]
        assert lines[mutant.line - 1][mutant.start : mutant.end] == mutant.old
