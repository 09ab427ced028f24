"""Texts of objects, figures and plotters in a terminal and in a notebook."""

import copy
import pickle
import re
import struct
import sys
from base64 import b64decode
from typing import Any

import numpy as np
import pytest
from flint import arb, ctx
from matplotlib.figure import Figure

import atlas
from atlas import (
    AsymmetricMotion,
    AtlasError,
    BallMotion,
    ElementaryMotion,
    EllipticMotion,
    Field,
    Flight,
    FreeMotion,
    GeneralMotion,
    Hyperbola,
    ParticleMotion,
    Quadric,
    SymmetricBody,
    TopMotion,
)
from atlas.bodies.display import Shown
from atlas.motions.register import FAMILIES
from atlas.notebook.pictures import scene_of, single_panel
from atlas.notebook.show import picture
from atlas.pictures import Curve, Plane, Scene, recipes

TOP = {"inertia": (1.0, 0.5), "coupling": (0.0, 0.0), "direction": (0.6, 0.8), "omega": (0.1, 0.2, 5.0), "linear": 3.0}
ONE: list[Any] = [
    Quadric(1.5, (1.0, 2.0)),
    Quadric.of_top((1.0, 0.5), (0.0, 0.0), (0.6, 0.8), 1.0),
    Hyperbola(1.5, (1.0, 2.0)),
    Hyperbola.of_top((1.0, 0.5), (1.0, 0.5), (0.6, 0.8)),
    ElementaryMotion(SymmetricBody.ring(1.0, 1.0), (1.0, 2.0), 0.7),
    GeneralMotion(1.5, (1.0, 2.0), (0.3, 0.7, 0.2)),
    GeneralMotion.in_laboratory(1.5, (0.0, 1.0, 2.0), [[1, 0, 0], [0, 1, 0], [0, 0, 1]], (0.3, 0.7, 0.2)),
    TopMotion(**TOP),
    EllipticMotion((0.8, 1.0, 1.3), (0.2, 1.0, 0.6), 1.7),
    AsymmetricMotion((0.8, 1.0, 1.3), (0.2, 1.0, 0.6), (0.3, 0.7, 0.2)),
    FreeMotion(1.5, (0.3, 0.7, 0.2)),
    BallMotion(1.0, 0.5, (0.3, -0.7)),
    ParticleMotion(1.0, (0.0, 0.5, 0.0), (0.0, 0.0, 1.0), (0.0, 0.0, 0.0), (1.0, 0.0, 0.0)),
    Flight(
        ParticleMotion(1.0, (0.0, 0.5, 0.0), (0.0, 2.0, 4.0), (0.0, 0.0, 0.0), (1.0, 0.0, 0.0)),
        ElementaryMotion(1.5, (1.0, 2.0), 0.7),
        (0.0, 0.3, 0.2),
    ),
    Field.si((0.0, 1.0, 2.0), mu=2.0),
    Field.si((0.0, 1.0, 2.0), mu=2.0).frame((0.0, 0.0, 1.0)),
    SymmetricBody.disk(1.0, 2.0),
]
STRAIGHT = ParticleMotion(1.0, (0.0, 0.5, 0.0), (0.0, 0.0, 0.0), (0.0, 0.0, 0.0), (1.0, 0.0, 0.0))
TABLED = [motion for motion in ONE if getattr(motion, "family", "") not in {"", "asymmetric"} and not motion.made_by]
"""Objects with a table in the register; the balls of a body with three moments take seconds."""


def name(instance: Any) -> str:
    """Return the name of a case."""
    return getattr(instance, "made_by", "") or type(instance).__name__


@pytest.mark.parametrize("instance", ONE, ids=name)
def test_a_repr_is_one_line_that_makes_the_same_again(instance: Any) -> None:
    """Typed in, it gives an object that says the same of itself."""
    text = repr(instance)
    again = eval(text, vars(atlas) | {public: getattr(atlas, public) for public in atlas.__all__})  # noqa: S307
    assert "\n" not in text
    assert type(again) is type(instance)
    assert repr(again) == text


@pytest.mark.slow
@pytest.mark.parametrize("instance", [*ONE, ONE[2].closed(2, 3)], ids=name)
def test_objects_can_be_copied_and_pickled(instance: Any) -> None:
    """A copy and its pickle are the same object, with the same matrices to the last bit."""
    for again in (copy.deepcopy(instance), pickle.loads(pickle.dumps(instance))):  # noqa: S301  our own bytes
        assert type(again) is type(instance)
        assert repr(again) == repr(instance)
        if hasattr(instance, "rotation"):
            assert np.array_equal(again.rotation(2.5), instance.rotation(2.5))


@pytest.mark.parametrize("instance", [instance for instance in ONE if isinstance(instance, Shown)], ids=name)
def test_inputs_of_an_object_cannot_be_changed(instance: Any) -> None:
    """Another value would stand beside numbers of the old one: it is refused, by the name that was typed."""
    text, argument = repr(instance), next(iter(instance.arguments))
    with pytest.raises(AttributeError, match=f"^{argument} of .* can't be changed"):
        setattr(instance, argument, 0.5)
    assert repr(instance) == text


def test_computed_values_of_an_object_cannot_be_changed() -> None:
    """It would be one number more, and none of the others would hang on it."""
    motion = ElementaryMotion(1.5, (1.0, 2.0), 0.7)
    k = motion.k
    with pytest.raises(AttributeError, match=r"^k of an? ElementaryMotion can't be changed"):
        motion.k = 3.0
    assert motion.k == k


@pytest.mark.parametrize(
    ("instance", "kind"),
    [
        (ONE[0], "two-sheet hyperboloid"),
        (ONE[4], "precession"),
        (ONE[5], "nutation, four real roots"),
        (ONE[12], "crossed fields, cycloid"),
        (Quadric([1.5, 1.0, 0.5, 0.5], (1, 2)), "shape (4,): 1 cone, 2 one-sheet hyperboloid, 1 two-sheet hyperboloid"),
        (ElementaryMotion(1.5, (1, 2), np.linspace(0, 1, 5000)), "shape (5000,)"),
    ],
    ids=lambda value: str(value)[:30],
)
def test_a_repr_ends_with_the_kind_of_motion(instance: Any, kind: str) -> None:
    """Behind a #, in the words of its attribute; of an array how many there are of each; of a large one its shape."""
    assert repr(instance).endswith(f"  # {kind}")


@pytest.mark.parametrize("instance", TABLED, ids=name)
def test_html_shows_all_registered_quantities(instance: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    """Each quantity that has a value stands in the table, by its name or those of its components."""
    monkeypatch.setattr("atlas.notebook.show.picture", lambda instance: f"<img {type(instance).__name__}>")
    html, table = instance._repr_html_(), instance._repr_latex_()
    for q in FAMILIES[instance.family].quantities:
        assert any(f"<code>{code}" in html for code in (q.name, *q.columns, *(x for x, _ in q.lines))), q.name
    assert f"<img {type(instance).__name__}>" in html
    assert "://" not in html
    assert table.count("{") == table.count("}")
    assert table.count(r"\\") + 1 >= len(FAMILIES[instance.family].quantities)


@pytest.mark.slow
def test_html_has_proven_digits() -> None:
    """The period of a precession by Machin's own pi: 2 pi/(omega2/B2hat), B2hat = B2/|B|, (79)."""
    with_precision = ctx.prec
    ctx.prec = 200
    period = 2 * arb.pi() * arb(1) / (arb("0.75") * arb(5).sqrt())
    digits = period.str(10, radius=False)
    ctx.prec = with_precision
    html = ElementaryMotion(1.5, (1.0, 2.0), 0.75)._repr_html_()
    (line,) = re.findall("<tr>(?:(?!</tr>).)*<code>period</code>.*?</tr>", html.replace("\xa0", " "))
    sides, cells = zip(*re.findall(r'<td style="text-align:(\w+)">(.*?)</td>', line), strict=True)
    assert cells[1:] == ("<code>period</code>", digits, "time", "", "10 digits")
    assert sides == ("left", "left", "right", "left", "left", "left")


@pytest.mark.parametrize(
    ("count", "columns", "size"), [(3, 2, (50.0, 40.0)), (1, 3, (100.0, 80.0)), (4, 1, (100.0, 20.0))]
)
def test_a_panel_alone_is_as_large_as_in_its_figure(count: int, columns: int, size: tuple[float, float]) -> None:
    """The figure is divided into its columns and as many rows as its panels fill."""
    panels = tuple(Plane((), f"x{k}", "y") for k in range(1, count + 1))
    scene = single_panel(Scene("t", "c", "a", panels, columns=columns, size=(100.0, 80.0)), count)
    assert (scene.size, scene.panels, scene.columns) == (size, panels[-1:], 1)


def pixels(html: str) -> tuple[int, int]:
    """Return width and height of the PNG in a piece of HTML."""
    (png,) = re.findall(r"data:image/png;base64,([\w+/=]+)", html)
    width, height = struct.unpack(">2I", b64decode(png)[16:24])
    return width, height


@pytest.mark.slow
def test_html_of_an_object_has_a_small_picture() -> None:
    """One panel, as a picture in the text, with twice the pixels of the width that it is shown in; none of an array."""
    assert picture(Quadric([1.5, 0.5], (1, 2))) == ""
    html = picture(Hyperbola(1.5, (1, 2)))
    assert re.match(r'<img width="300" alt="" src="data:image/png;base64,[\w+/=]+">$', html)
    assert pixels(html)[0] in {599, 600}


def test_arrays_and_objects_without_family_have_a_line() -> None:
    """The table is of one object of the register."""
    for instance in (Quadric([1.5, 0.5], (1, 2)), ONE[1], ONE[6]):
        assert "<table>" not in instance._repr_html_()
        assert instance._repr_latex_() is None


def test_a_figure_is_shown_at_half_its_pixels() -> None:
    """Its picture has twice the pixels of the size that it is shown in."""
    png, metadata = atlas.figure("hyperbola")._repr_png_()  # type: ignore[attr-defined]
    size = struct.unpack(">2I", png[16:24])
    assert np.abs(np.subtract(size, (2 * metadata["width"], 2 * metadata["height"]))).max() <= 2
    assert metadata["width"] > 200


@pytest.mark.slow
def test_a_plotter_shows_a_viewer_without_requests() -> None:
    """The frame is sandboxed, its policy lets nothing in, and it has still, scene and script in it."""
    from atlas.pictures.drawing.window import mimebundle  # it loads PyVista

    scene = recipes.load("quadric").scene()
    bundle = mimebundle(scene)
    assert scene.alt in bundle["text/plain"]
    frame = bundle["text/html"]
    assert re.match(r'<iframe [^>]*sandbox="allow-scripts"[^>]*srcdoc="[^"]*"></iframe>$', frame)
    assert "default-src &#x27;none&#x27;" in frame
    (size,) = re.findall(r'<iframe width="(\d+)" height="(\d+)"', frame)
    css = 96 / 25.4 * np.array(scene.size)
    assert np.abs(np.array(size, dtype=int) - css).max() <= 0.5
    assert np.abs(pixels(frame) - 2 * css).max() <= 1.0  # sharp on a fine screen
    assert "http://www.w3.org/2000/svg" in frame  # a name, and the only address
    assert not set(re.findall(r"https?://[^&;\"`]+", frame)) - {"http://www.w3.org/2000/svg"}
    assert "atlasViewer" in frame


@pytest.mark.parametrize(
    ("motion", "figure", "axis"),
    [
        (ONE[5], "general_motion", (0.0, 1.0, 2.0)),
        (ONE[7], "top_motion", (0.0, 0.6, 0.8)),
        (ONE[8], "elliptic_motion", (0.2, 1.0, 0.6)),
        (ONE[9], "asymmetric_motion", (0.2, 1.0, 0.6)),
        (ONE[10], "free_motion", (0.3, 0.7, 0.3)),
        (ONE[11], "ball_motion", (0.0, 0.0, 1.0)),
    ],
    ids=lambda value: value if isinstance(value, str) else "",
)
def test_the_picture_of_a_motion_is_the_trace_of_its_axis(motion: Any, figure: str, axis: tuple[float, ...]) -> None:
    """On the unit sphere; heights along the upright vector are those of R_3(t), and Omega(t) is the motion's own."""
    parameters = {p.name: motion.arguments[p.name] for p in FAMILIES[motion.family].parameters}
    parameters |= {"turns": 2.0} if figure == "asymmetric_motion" else {"periods": 0.5}
    sphere, course = recipes.load(figure).scene(**parameters).panels
    (trace,) = (layer.points for layer in sphere.layers if isinstance(layer, Curve) and layer.role == "trace")
    assert np.abs(np.linalg.norm(trace, axis=1) - 1.0).max() < 1e-14
    upright = np.array(axis) / np.linalg.norm(axis)
    assert abs(trace[0, 2] - upright[2]) < 1e-14
    lines = [layer.points for layer in course.layers if isinstance(layer, Curve) and layer.role != "guide"]
    times = lines[0][[len(lines[0]) // 3, -1], 0]
    Omega = motion.angular_velocity(times)
    for i, line in enumerate(lines):
        assert np.abs(line[[len(line) // 3, -1], 1] - Omega[:, i]).max() < 1e-6
    assert abs(trace[-1, 2] - motion.third_axis(course.x_limits[1]) @ upright) < 1e-6
    low, high = trace[:, 2].min() - 1e-4, trace[:, 2].max() + 1e-4
    heights = motion.third_axis(times) @ upright
    assert low < heights.min() <= heights.max() < high


def test_the_picture_of_a_particle_is_its_path() -> None:
    """From its own fields, whose names in the recipe are others."""
    fields = ((0.0, 0.5, 0.0), (0.0, 0.0, 2.0), (1.0, 2.0, 3.0), (0.4, 0.0, 0.1))
    particle = ParticleMotion(1.0, *fields)
    picture = particle.plot(turns=2.0)
    fields_named = dict(zip(("electric", "magnetic", "position", "velocity"), fields, strict=True))
    scene = recipes.load("particle_motion").scene(**fields_named, turns=2.0)
    assert picture.axes[1].get_xlim()[1] == pytest.approx(2.0 * particle.period)
    (path,) = (x.points for x in scene.panels[0].layers if isinstance(x, Curve) and x.role == "trajectory")
    y = particle.position(np.linspace(0.0, 2.0 * particle.period, 2000))
    span = np.ptp(y, axis=0)
    assert np.abs(np.ptp(path, axis=0) - span).max() < 1e-3 * span.max()
    assert np.abs((path[-1] - path[0]) - (y[-1] - y[0])).max() < 1e-4 * span.max()


@pytest.mark.slow
def test_the_picture_of_a_flight_is_the_path_of_its_point() -> None:
    """Of any motion of the body, in the user's axes: both paths, and the arm at its end as it is there."""
    field = Field((0.0, 1.0, 2.0), mu=1.0, E=(-1.0, 0.3, 0.0))
    frame = field.frame((0.2, 0.1, 1.0))
    particle = ParticleMotion.in_field(field, (1.0, 2.0, 3.0), (1.0, 0.5, 0.5))
    flight = Flight(particle, GeneralMotion(1.5, frame.field, (0.3, 0.7, 0.2)), (0.0, 0.3, 0.2), frame)
    scene = scene_of(flight, None, {"turns": 2.0})
    lines = {layer.role: layer.points for layer in scene.panels[0].layers if isinstance(layer, Curve)}
    assert scene.lasts == 2.0 * particle.period
    assert np.abs(lines["trajectory"][[0, -1]] - flight.position(np.array([0.0, scene.lasts]))).max() < 1e-12
    assert np.abs(lines["fourth"][[0, -1]] - particle.position(np.array([0.0, scene.lasts]))).max() < 1e-12
    R, s = scene.paths["arm"](np.array([1.3]))
    arm = particle.position(0.0), flight.position(0.0)
    assert (
        np.abs(R[0] @ np.transpose(arm) + s.T - np.transpose([particle.position(1.3), flight.position(1.3)])).max()
        < 1e-13
    )
    assert flight.plot(turns=2.0).axes[1].get_xlabel().startswith("along")
    assert "<img" in flight._repr_html_()


@pytest.mark.slow
def test_plot_draws_into_given_axes() -> None:
    """The panel asked for, into one of two axes; the figure that comes back is theirs."""
    figure = Figure((8, 4))
    axes_left, second = figure.subplots(1, 2)
    motion = ONE[5]
    assert motion.plot(ax=axes_left) is figure
    assert motion.plot(panel=2, ax=second, periods=2.0) is figure
    assert axes_left.get_title(loc="left") == "(a) third axis"
    assert second.get_xlim()[1] == pytest.approx(2.0 * motion.period)
    assert len(motion.plot().axes) == 2
    assert len(motion.plot(panel=2).axes) == 1


@pytest.mark.parametrize(
    ("refused_call", "says"),
    [
        (lambda: ONE[5].plot(ratio=2.0), "ratio is that of the GeneralMotion"),
        (lambda: ONE[5].plot("hyperbola"), "no figure 'hyperbola' of GeneralMotion"),
        (lambda: ONE[5].plot(panel=3), "panels 1 to 2"),
        (lambda: ONE[5].plot(panel="a"), "no panel 'a'"),
        (lambda: ONE[5].plot(ax=3), "must be axes of Matplotlib, not 3"),
        (lambda: ONE[5].animate([0.0, 1.0], fps=0), "fps must be positive"),
        (lambda: ONE[5].plot(ax=Figure().add_subplot(), target="aps"), "target is for a whole figure"),
        (lambda: ONE[5].plot(target="nature"), "nature"),
        (lambda: ONE[5].plot(ax=Figure().add_subplot(projection="3d")), "ordinary axes"),
        (lambda: type("Mine", (Shown,), {"arguments": {}})().plot(), "no picture of a Mine"),
        (lambda: ONE[5].trace(1e300), "more than 1000000 points"),
        (lambda: ONE[4].trace(stop=1e9), "more than 1000000 points"),
        (lambda: ONE[13].plot(point=2.0), "no parameter 'point' of a picture of a Flight"),
        (lambda: ONE[13].plot(stop=1e6), "more than 200 cannot be drawn"),
        (lambda: ONE[13].plot("motion"), "no figure 'motion' of Flight"),
        (lambda: Flight(ONE[12], BallMotion(1.0, 0.5, (0.3, [0.1, 0.2])), (0.0, 0.1, 0.0)).plot(), "one Flight"),
        (lambda: Flight(STRAIGHT, FreeMotion(1.5, (1, 2, 3)), (0.0, 0.1, 0.0)).plot(), "nothing turns the path"),
        (lambda: ElementaryMotion(1.5, (1, 2), [0.1, 0.2]).plot(), "one ElementaryMotion"),
        (lambda: ElementaryMotion(1.5, (1, 2), [0.1, 0.2]).trace(), "one ElementaryMotion"),
        (lambda: BallMotion(1.0, 0.5, (0.3, -0.7)).trace(), "say stop="),
        (lambda: ONE[5].trace(0), "periods must be positive"),
        (lambda: ONE[5].to_dataframe(quantities=["perod"]), "did you mean 'period'"),
        (lambda: ONE[5].to_dataframe([0.0], quantities=["R14"]), "no quantity 'R14'"),
        (lambda: ElementaryMotion(1.5, (1, 2), [0.1, 0.2]).to_dataframe([0.0]), "one ElementaryMotion"),
        (lambda: Quadric(1.5, (1, 2)).to_dataframe([0.0]), "nothing that depends on time"),
        (ONE[13].to_dataframe, "no table of a Flight"),
    ],
)
def test_objects_that_cannot_be_shown_give_a_reason(refused_call: Any, says: str) -> None:
    """In one line, with the remedy."""
    with pytest.raises(AtlasError, match=re.escape(says)) as refused:
        refused_call()
    assert "\n" not in str(refused.value)


@pytest.mark.parametrize("motion", [ONE[4], ONE[5], ONE[7]], ids=name)
def test_a_trace_is_the_path_of_the_axis(motion: Any) -> None:
    """From the start to the last period, its points those of R_3, each chord's middle within the tolerance."""
    t, axis = motion.trace(10, tolerance=1e-3)
    frame = motion.to_dataframe()
    assert t[0] == 0.0
    assert t[-1] == pytest.approx(10 * frame["period"][0], rel=1e-15, abs=0.0)
    assert np.array_equal(axis, motion.third_axis(t))
    way, chord = motion.third_axis((t[1:] + t[:-1]) / 2) - axis[:-1], axis[1:] - axis[:-1]
    share = np.sum(way * chord, axis=1, keepdims=True) / np.sum(chord * chord, axis=1, keepdims=True)
    assert np.linalg.norm(way - share * chord, axis=1).max() < 1e-3


def test_a_data_frame_has_a_row_for_each_motion() -> None:
    """Periods over many omega2 as the motions one by one have them; units stand beside."""
    omega2 = np.linspace(0.0, 3.0, 7)
    motions = ElementaryMotion(1.5, (1.0, 2.0), omega2)
    frame = motions.to_dataframe(quantities=["k", "period", "case"])
    assert [*frame.columns] == ["ratio", "B2", "B3", "omega2", "k", "period", "case"]
    assert frame["period"][0] == np.inf
    for i in (1, 6):
        assert frame["k"][i] == ElementaryMotion(1.5, (1.0, 2.0), omega2[i]).k
        assert frame["period"][i] == pytest.approx(2 * np.pi / frame["k"][i], rel=1e-15, abs=0.0)
    assert [*frame["case"][:2]] == ["at rest", "precession"]
    assert frame.attrs["units"]["period"] == "time"


def test_a_data_frame_has_a_row_for_each_time() -> None:
    """The entries of R and the components of Omega, K and m at these times."""
    times = [0.0, 1.0, 1e6]
    frame = ONE[5].to_dataframe(times)
    R = ONE[5].rotation(times)
    assert np.array_equal(frame[["R11", "R12", "R13"]].to_numpy(), R[:, 0])
    assert np.array_equal(frame[["Omega1", "Omega2", "Omega3"]].to_numpy(), ONE[5].angular_velocity(times))
    assert [*ONE[12].to_dataframe(times, quantities=["velocity2"]).columns] == ["t", "velocity2"]
    assert [*ONE[12].to_dataframe(times, quantities="velocity2").columns] == ["t", "velocity2"]
    assert ONE[5].to_dataframe([]).shape == (0, frame.shape[1])


@pytest.mark.slow
def test_a_closed_motion_is_not_taken_for_another() -> None:
    """It is made of p and q, which are no omega2 and omega3: its quantities are its own, and so is its picture."""
    closed = Hyperbola(1.5, (1.0, 2.0)).closed(1, 3)
    frame = closed.to_dataframe(quantities=["k", "phi"])
    assert [*frame.columns] == ["k", "phi"]
    assert frame["phi"][0] / frame["k"][0] == pytest.approx(1 / 3)
    assert "<table>" not in closed._repr_html_()
    assert closed.plot("motion", panel=2, turns=1.0).axes[0].get_xlim()[1] == pytest.approx(closed.period / 3)


def test_a_separatrix_has_an_empty_cell() -> None:
    """Where a quantity has no value, there is no number."""
    resting = TopMotion((1.0, 0.5), (0.0, 0.0), (0.0, 1.0), (0.0, 0.0, 0.0), 3.0)
    assert np.isnan(resting.to_dataframe()["precession_per_period"][0])


def test_without_pandas_one_line_names_the_extra(monkeypatch: pytest.MonkeyPatch) -> None:
    """The extra brings it."""
    monkeypatch.setitem(sys.modules, "pandas", None)
    with pytest.raises(AtlasError, match=r"pip install 'atlas-charged-body\[sweep\]'"):
        ONE[5].to_dataframe()


@pytest.mark.parametrize(
    "instance",
    [
        pytest.param(instance, id=name(instance), marks=[pytest.mark.slow] * (k % 3 > 0))
        for k, instance in enumerate([SymmetricBody.ring(1.0, 2.0), *TABLED])
    ],
)
def test_html_is_light_and_needs_no_tex(instance: Any) -> None:
    """A notebook shows each object within 40 kB, its picture among them, and no formula waits for MathJax."""
    html = instance._repr_html_()
    assert len(html) < 40_000
    words = re.sub('base64,[^"]*', "", html)
    assert "$" not in words
    assert "\\" not in words
    assert "<img" in words
