"""ARCHITECTURE.md speaks of files and names that are there, and no folder hides a public name."""

import ast
import pkgutil
import re
import subprocess
import sys
from pathlib import Path

import pytest
from contracts import imported_by_string

import atlas
from atlas.motions.register import FAMILIES

ROOT = Path(__file__).resolve().parents[2]
TEXT = (ROOT / "ARCHITECTURE.md").read_text("utf-8")
TICKED = sorted(set(re.findall(r"`([^`\n]+)`", TEXT)))
PATHS = [x for x in TICKED if re.fullmatch(r"(atlas|figures|reports)/[\w/]*(\.py)?", x)]
CLASSES = [x for x in TICKED if re.fullmatch(r"[A-Z]\w+", x)]


@pytest.mark.parametrize("path", sorted({*PATHS, *re.findall(r"\batlas/\w+", TEXT)}))
def test_named_paths_exist(path: str) -> None:
    """Each file and folder that the text or its drawing names is one, but for modules without their ending."""
    assert (ROOT / path).exists() or (ROOT / f"{path}.py").exists()


def test_named_classes_are_defined() -> None:
    """Each class or constant that the text names is defined somewhere in the package."""
    code = "\n".join(file.read_text("utf-8") for file in (ROOT / "atlas").rglob("*.py"))
    absent = [name for name in CLASSES if not re.search(rf"^(class {name}\b|{name}\b.*=)", code, re.MULTILINE)]
    assert len(CLASSES) > 10
    assert not absent
    assert all(re.search(rf"^ *def {name}\(", code, re.MULTILINE) for name in ("load", "closed_form", "distances"))


def test_no_module_has_a_public_name() -> None:
    """A module `atlas.fit` would stand in the place of the function as soon as it is imported."""
    modules = {module.name for module in pkgutil.iter_modules(atlas.__path__)}
    assert modules & set(atlas.__all__) == set()


@pytest.mark.slow
@pytest.mark.parametrize(
    "module", ["atlas.fitting", "atlas.checking.check", "atlas.sweeps.run", "atlas.pictures.drawing"]
)
def test_no_import_order_replaces_a_public_function_by_a_module(module: str) -> None:
    """The functions of the package, after the modules that hold them, and these after the functions."""
    names = "fit, check, sweep, figure, plotter, animate, motion, simulate, drift, monodromy, clebsch"
    code = f"import {module}, atlas; from atlas import {names}; import {module}\n" + "".join(
        f"assert callable(atlas.{name}) and atlas.{name} is {name}\n" for name in names.split(", ")
    )
    subprocess.run([sys.executable, "-P", "-c", code], check=True)


def test_an_import_written_as_a_string_is_seen() -> None:
    """The contract against circles counts these: in full, and in front of a brace."""
    assert set(imported_by_string("atlas.trial.proofs.run")) == {"atlas.trial.proofs"}


def names_compared(code: str) -> list[str]:
    """Return the comparisons of a module with the name of a family, but those of a motion's kind or case."""
    comparisons = []
    for node in ast.walk(ast.parse(code)):
        if isinstance(node, ast.Compare):
            sides = (node.left, *node.comparators)
            words = {x.value for side in sides for x in ast.walk(side) if isinstance(x, ast.Constant)}
            if words & set(FAMILIES) and not any(ast.unparse(side).endswith(("kind", "case")) for side in sides):
                comparisons.append(ast.unparse(node))
    return comparisons


@pytest.mark.slow
def test_no_code_outside_its_folder_asks_for_the_name_of_a_family() -> None:
    """Code asks for a property of a family in its line in the register."""
    assert names_compared("motion.family == 'top'")
    assert names_compared("args[:1] == ['asymmetric']")
    assert names_compared("family.name not in ('general', 'free')")
    assert not names_compared("motion.kind == 'ball'")
    comparisons = {
        path.relative_to(ROOT).as_posix(): names
        for path in sorted((ROOT / "atlas").rglob("*.py"))
        if (names := names_compared(path.read_text("utf-8")))
    }
    assert comparisons == {}
