"""Recipes by name."""

import inspect
import math
import re
from pathlib import Path
from typing import Any

import matplotlib as mpl
import numpy as np
import pytest

from atlas import AtlasError
from atlas.cli.figure import setting
from atlas.pictures import recipes
from atlas.pictures.drawing.style import context
from atlas.pictures.parameters import described, fitted, typed_text
from atlas.pictures.style import style


def test_every_file_in_figures_is_a_recipe_with_a_title() -> None:
    """Titles are the first lines of the docstrings, read without running the recipe."""
    assert {"quadrics", "ball", "lssc", "magn", "cone", "motion_sphere"} <= set(recipes.names())
    for name in recipes.names():
        assert recipes.load(name).title


def test_parameters_used_are_noted_in_the_scene() -> None:
    """Defaults and values given stand in the scene in the recipe's order; floats and tuples have one form."""
    scene = recipes.load("quadric").scene(field=[1, 2])
    assert list(scene.parameters) == list(recipes.load("quadric").parameters)
    assert scene.parameters["field"] == (1.0, 2.0)
    assert all(isinstance(component, float) for component in scene.parameters["field"])
    assert scene.parameters["ratio"] == recipes.load("quadric").parameters["ratio"]


def test_an_unknown_recipe_is_named_with_the_nearest() -> None:
    """The error says which figures are meant, and how to list all."""
    with pytest.raises(AtlasError, match=r"no figure 'quadrik' .did you mean 'quadric'.*atlas list figures"):
        recipes.load("quadrik")


def test_an_unknown_parameter_is_named_with_the_nearest() -> None:
    """The error says which parameter is meant, and which there are."""
    with pytest.raises(AtlasError, match=r"no parameter 'feild'.*'quadric'.*did you mean 'field'.*ratio"):
        recipes.load("quadric").scene(feild=(1.0, 2.0))


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Put an empty folder of figures in place of ours."""
    monkeypatch.setattr(recipes, "folder", lambda _kind: tmp_path)
    return tmp_path


@pytest.mark.parametrize("parameter", ["*, ratio", "ratio", "ratio, field=(1.0, 2.0)", "field=(1.0, 2.0), *, ratio"])
def test_a_parameter_without_default_is_refused(folder: Path, parameter: str) -> None:
    """A recipe can be made by its name alone, so each of its parameters has a default."""
    (folder / "bare.py").write_text(f'"""Bare."""\ndef scene({parameter}): ...\n', encoding="utf-8")
    with pytest.raises(AtlasError, match=r"parameter 'ratio' of figures/bare.py has no default"):
        recipes.load("bare")


@pytest.mark.parametrize("star", ["*, ", "", "size=1.0, /, ", "size=1.0, *, ", "size=1.0, "])
def test_parameters_may_be_named_or_in_order(folder: Path, star: str) -> None:
    """A recipe of a reader's own need not write the star before its parameters."""
    text = f'"""Own."""\ndef scene({star}ratio=1.5, field=(1.0, 2.0)): ...\n'
    (folder / "own.py").write_text(text, encoding="utf-8")
    size = {"size": 1.0} if "size" in star else {}
    assert recipes.load("own").parameters == size | {"ratio": 1.5, "field": (1.0, 2.0)}
    assert recipes.load(folder / "own.py") == recipes.load("own")


def test_a_default_that_must_be_computed_is_refused(folder: Path) -> None:
    """The parameters of a recipe are read without running it, so that its defaults are plain values."""
    (folder / "clever.py").write_text('"""Clever."""\ndef scene(*, ratio=1.0 + RATIO): ...\n', encoding="utf-8")
    with pytest.raises(AtlasError, match=r"default of the parameter 'ratio' of figures/clever.py is not a plain value"):
        recipes.load("clever")


def test_parameters_of_a_recipe_agree_with_its_function() -> None:
    """The parameters that are read from the source are those of the function, with the same defaults, in its order."""
    for name in recipes.names():
        parameters = inspect.signature(recipes._function(recipes.load(name).source)[0]).parameters
        assert {key: value.default for key, value in parameters.items()} == recipes.load(name).parameters
        assert list(parameters) == list(recipes.load(name).parameters)


RECIPE = '''"""Typed."""
from typing import Any, Literal
from atlas.pictures import Plane, Scene
RANGES = {"size": (0.5, 2.0)}
def scene(*, pairs: tuple[tuple[int, int], ...] = ((1, 2), (2, 3)), ratio: Any = 1.5,
          field: tuple[float, float] = (1.0, 2.0), levels: tuple[float, ...] = (1.0,),
          omega3: float | None = None, unit: str = "s", columns: int = 1, size: float = 1, free=(1, "x"),
          names: tuple[str, ...] = ("a",), on: bool = True, side: Literal["left", "right"] = "left") -> Scene:
    return Scene(title="", caption="A.", alt="A.", panels=(Plane((), "", ""),))
'''


@pytest.mark.parametrize(
    ("arguments", "fitted"),
    [
        ({"field": [1, 2]}, {"field": (1.0, 2.0)}),
        ({"levels": 3}, {"levels": (3.0,)}),
        ({"pairs": (1, 2)}, {"pairs": ((1, 2),)}),
        ({"pairs": (1, 2, 3, 4)}, {"pairs": ((1, 2), (3, 4))}),
        ({"pairs": [[1, 2]]}, {"pairs": ((1, 2),)}),
        ({"omega3": 2}, {"omega3": 2.0}),
        ({"free": [2, "y"]}, {"free": (2, "y")}),
        ({"names": ["b", "c"]}, {"names": ("b", "c")}),
        ({"ratio": 1}, {"ratio": 1.0}),
        ({"ratio": np.float32(0.5), "field": np.array([1.0, 2.0])}, {"ratio": 0.5, "field": (1.0, 2.0)}),
    ],
)
def test_a_parameter_comes_in_its_type(folder: Path, arguments: dict[str, Any], fitted: dict[str, Any]) -> None:
    """Lists become tuples, whole numbers floats, one value a list where a list of any length is meant."""
    (folder / "typed.py").write_text(RECIPE, encoding="utf-8")
    used = recipes.load("typed").scene(**arguments).parameters
    assert {name: used[name] for name in fitted} == fitted
    assert all(type(used[name]) is type(value) for name, value in fitted.items())


@pytest.mark.parametrize(
    ("arguments", "tells"),
    [
        ({"ratio": "x"}, "ratio must be a number, 0 or of a size between 1e-60 and 1e+60, not 'x'"),
        ({"ratio": 1e61}, "a number, 0 or of a size between 1e-60 and 1e+60, not 1e+61"),
        ({"ratio": float("nan")}, "ratio must be a number, 0 or of a size between 1e-60 and 1e+60, not nan"),
        ({"ratio": (1, 2)}, "ratio must be a number, 0 or of a size between 1e-60 and 1e+60, not (1, 2)"),
        ({"field": 1.0}, "field must be two numbers, each 0 or of a size between 1e-60 and 1e+60, not 1.0"),
        ({"field": (1, 2, 3)}, "field must be two numbers, each 0 or of a size"),
        ({"field": (1, float("inf"))}, "field must be two numbers, each 0 or of a size"),
        ({"field": (1, True)}, "field must be two numbers, each 0 or of a size"),
        ({"levels": ()}, "levels must be a list of 1 to 40 numbers"),
        ({"levels": (1.0,) * 41}, "levels must be a list of 1 to 40 numbers"),
        ({"levels": "many"}, "levels must be a list of 1 to 40 numbers"),
        ({"pairs": (1, 2, 3)}, "pairs must be a list of 1 to 40 lists of two whole numbers, not (1, 2, 3)"),
        ({"omega3": "1"}, "omega3 must be a number, 0 or of a size between 1e-60 and 1e+60, not '1'"),
        ({"unit": 1}, "unit must be a word, not 1"),
        ({"columns": 1.5}, "columns must be a whole number, not 1.5"),
        ({"columns": 0}, "columns must lie between 1 and 6, not 0"),
        ({"size": 10**400}, "size must be a number, 0 or of a size between 1e-60 and 1e+60"),
        ({"size": 0.4}, "size must lie between 0.5 and 2, not 0.4"),
        ({"names": (1,)}, "names must be a list of 1 to 40 words"),
        ({"on": 1}, "on must be true or false, not 1"),
        ({"side": "up"}, "side must be left or right, not 'up'"),
        ({"free": (1,)}, "free must be two values"),
        ({"sise": 1}, "did you mean 'size'?"),
    ],
)
def test_a_parameter_of_another_type_is_one_sentence(folder: Path, arguments: dict[str, Any], tells: str) -> None:
    """It names the parameter and the remedy."""
    (folder / "typed.py").write_text(RECIPE, encoding="utf-8")
    with pytest.raises(AtlasError, match=re.escape(tells)) as caught:
        recipes.load("typed").scene(**arguments)
    assert "\n" not in str(caught.value)


def test_a_recipe_without_scene_or_title_is_refused(folder: Path) -> None:
    """The error names the missing part."""
    (folder / "empty.py").write_text('"""Empty."""\n', encoding="utf-8")
    (folder / "mute.py").write_text("def scene(): ...\n", encoding="utf-8")
    with pytest.raises(AtlasError, match=r"no function scene\(\)"):
        recipes.load("empty")
    with pytest.raises(AtlasError, match="no docstring"):
        recipes.load("mute")


@pytest.mark.parametrize(
    ("text", "tells"),
    [
        (b'"""Broken."""\ndef scene(:\n', r"figures/broken\.py, line 2: SyntaxError: invalid syntax"),
        (
            b'"""Broken."""\nimport no_such_module\ndef scene(): ...\n',
            r"figures/broken\.py, line 2: ModuleNotFoundError: .*no_such_module",
        ),
        (b'"""Broken."""\ndef scene():\n    return 1 / 0\n', r"figures/broken\.py, line 3: ZeroDivisionError"),
        (
            b'"""Broken."""\ndef scene(): return None\n',
            r"figures/broken\.py: scene\(\) must return a Scene, not NoneType",
        ),
        (
            b'"""Broken."""\nfrom atlas.pictures import Scene\ndef scene(): return Scene(caption="A.")\n',
            r"figures/broken\.py: the Scene has no alt and no panels",
        ),
        (b"\xff\xfe", r"figures/broken\.py, line 1: SyntaxError"),
        (b'"""Broken."""\ndef scene(): raise SystemExit(7)\n', r"figures/broken\.py, line 2: SystemExit: 7"),
    ],
)
def test_a_broken_recipe_is_reported_with_its_line(folder: Path, text: bytes, tells: str) -> None:
    """Whatever goes wrong inside a recipe is one sentence that says where."""
    (folder / "broken.py").write_bytes(text)
    with pytest.raises(AtlasError, match=tells):
        recipes.load("broken").scene()


@pytest.mark.parametrize("text", [b'"""Broken."""\ndef scene(:\n', b"\xff\xfe"])
def test_an_unreadable_title_is_reported(folder: Path, text: bytes) -> None:
    """A recipe that is no Python has no title, and the error names it."""
    (folder / "broken.py").write_bytes(text)
    with pytest.raises(AtlasError, match=r"figures/broken\.py"):
        recipes.load("broken")


def test_an_unknown_role_is_named_with_the_nearest() -> None:
    """The error says which role is meant."""
    with pytest.raises(AtlasError, match=r"'hyperbolla' .did you mean 'hyperbola'"):
        style("hyperbolla")


def test_styles_of_lines_that_meet_in_a_plot_differ_in_grey_or_in_dash() -> None:
    """In grey print two of the plotted lines are told apart by lightness, or by their dashes."""
    with context():
        order = list(mpl.rcParams["axes.prop_cycle"])

    def grey(colour: str) -> float:
        red, green, blue = (int(colour.lstrip("#")[i : i + 2], 16) / 255.0 for i in (0, 2, 4))
        return 0.2126 * red**2.2 + 0.7152 * green**2.2 + 0.0722 * blue**2.2

    for i, a in enumerate(order):
        for b in order[i + 1 :]:
            lightness = [116.0 * grey(line["color"]) ** (1.0 / 3.0) for line in (a, b)]
            assert abs(lightness[0] - lightness[1]) > 8.0 or a["linestyle"] != b["linestyle"], (a, b)


def test_a_recipe_is_a_file_anywhere_and_is_read_again_when_it_changes(tmp_path: Path) -> None:
    """A name that ends with .py is a path; nothing is left beside the file, and an edited one counts at once."""
    file = tmp_path / "mine.py"
    file.write_text(RECIPE, encoding="utf-8")
    assert recipes.load(str(file)).scene(size=2).parameters["size"] == 2.0
    file.write_text(RECIPE.replace('"""Typed."""', '"""Typed again."""').replace("(0.5, 2.0)", "(0.5, 3.0)"))
    assert recipes.load(str(file)).title == "Typed again"
    assert recipes.load(str(file)).scene(size=3).parameters["size"] == 3.0
    assert [path.name for path in tmp_path.iterdir()] == ["mine.py"]
    with pytest.raises(AtlasError, match=r"there is no recipe .*other\.py: it would be a file"):
        recipes.load(str(tmp_path / "other.py"))
    file.write_text("def scene(: ...", encoding="utf-8")
    with pytest.raises(AtlasError, match=r"^mine\.py, line 1: SyntaxError"):
        recipes.load(str(file))


def test_types_of_parameters_are_described_in_words(tmp_path: Path) -> None:
    """Each kind of annotation has its words, and words typed after --set read back."""
    file = tmp_path / "mine.py"
    file.write_text(RECIPE, encoding="utf-8")
    recipe = recipes.load(str(file))
    assert recipe.ranges["size"] == (0.5, 2.0)
    hints = recipe.hints()
    descriptions = {name: described(hints.get(name), default) for name, default in recipe.parameters.items()}
    assert descriptions == {
        "pairs": "lists of two whole numbers, one after the other",
        "ratio": "a number",
        "field": "two numbers",
        "levels": "a list of numbers",
        "omega3": "a number",
        "unit": "a word",
        "columns": "a whole number",
        "size": "a number",
        "free": "two values",
        "names": "a list of words",
        "on": "true or false",
        "side": "left or right",
    }
    assert typed_text(recipe.parameters["pairs"]) == "1,2,2,3"
    for value in (1.5, (1.0, 2.0), (1.0,), True, "s", 1e-6, ("a", "b")):
        assert setting(f"x={typed_text(value)}") == ("x", value)


ENDS = {
    "asymmetric_motion": {"turns": (1e-3, 50.0)},
    "cusps": {"nutations": (0.5, 40.0)},
    "flattening": {"stop": (0.1, 200.0)},
    "monodromy": {"points": (24, 200)},
    "phase_portrait": {"levels": (1, 40)},
    "separatrix": {"decay": (0.1, 30.0)},
    "quadrics_of_tops": {"weight": (0.01, 2.0), "moment": (0.01, 2.0), "outside": (0.01, 3.0)},
    "tipping_disk": {"count": (2, 24)},
    "turnover": {"reach": (0.1, 100.0)},
    "wells": {"reach": (0.5, 50.0)},
}
SHARED = {
    "azimuth": (-360.0, 360.0),
    "elevation": (-90.0, 90.0),
    "turns": (1e-3, 1e3),
    "periods": (1e-3, 1e3),
    "reach": (1e-2, 1e2),
    "horizon": (1e-3, 1e9),
    "columns": (1, 6),
}


@pytest.mark.parametrize("name", recipes.names())
def test_each_number_with_ends_is_taken_up_to_them_and_refused_beyond(name: str) -> None:
    """The ends that `atlas figure NAME --help` prints are the last that are taken, each side of each number."""
    recipe, ends = recipes.load(name), {**SHARED, **ENDS.get(name, {})}
    assert recipe.ranges == ends
    assert set(ENDS.get(name, {})) <= set(recipe.parameters)
    for key in recipe.parameters.keys() & ends:
        hint, default = recipe.hints().get(key), recipe.parameters[key]
        many = isinstance(default, tuple)
        for end, beyond in zip(ends[key], (-math.inf, math.inf), strict=True):
            assert fitted(key, end, hint, default, recipe.ranges) in (end, (end,))
            past = end + (1 if beyond > 0 else -1) if isinstance(end, int) else math.nextafter(end, beyond)
            with pytest.raises(AtlasError, match=f"^{key} must lie between .* and .*, not "):
                fitted(key, (past,) if many else past, hint, default, recipe.ranges)
