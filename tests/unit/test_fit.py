"""From made-up measurements, integrated by SciPy, back to the body and the field."""

import json
import pickle
from concurrent.futures import ProcessPoolExecutor
from contextlib import nullcontext
from copy import copy, deepcopy
from dataclasses import replace
from multiprocessing import get_context
from pathlib import Path
from typing import Any, get_args

import numpy as np
import pytest
from click.testing import CliRunner
from matplotlib.figure import Figure
from scipy.spatial.transform import Rotation
from stress.fits import KINDS

import atlas
from atlas.cli.app import atlas as command
from atlas.cli.app import main
from atlas.errors import AtlasError
from atlas.fitting.data import Data, left_jacobian, of_arrays, of_file
from atlas.fitting.models import MODELS, model_of
from atlas.fitting.parameters import Parameter, Parameters, parameters_of
from atlas.fitting.problem import Problem
from atlas.fitting.result import Fit

RATIO, FIELD, OMEGA = 1.3, (0.2, -0.4, 1.1), (1.2, 0.3, 0.7)
ATTITUDE = Rotation.from_rotvec([0.3, -0.2, 0.4])
NOISE = 0.01


def measured(kind: str, count: int = 150, span: float = 30.0, seed: int = 1) -> tuple[Any, Any]:
    """Return times and noisy values of one motion."""
    rng = np.random.default_rng(seed)
    t = np.sort(rng.uniform(0, span, count))
    steps = atlas.simulate(RATIO, ATTITUDE.inv().apply(FIELD), OMEGA, t, rtol=1e-11)
    R = ATTITUDE.as_matrix() @ steps.R
    if kind in ("rotation", "quaternion"):
        noisy = Rotation.from_rotvec(rng.normal(0, NOISE, (count, 3))) * Rotation.from_matrix(R)
        return t, noisy.as_matrix() if kind == "rotation" else noisy.as_quat()
    values = {"axis": R[:, :, 2], "angular_velocity": steps.Omega, "field_in_body": np.vecmat(FIELD, R)}[kind]
    return t, values + rng.normal(0, NOISE, values.shape)


@pytest.fixture(scope="module")
def attitudes() -> Any:
    """Return a fit of attitudes."""
    t, R = measured("rotation")
    return atlas.fit(t, rotation=R, sigma=NOISE)


@pytest.mark.parametrize(
    "kind", ["quaternion", pytest.param("axis", marks=pytest.mark.slow), "angular_velocity", "field_in_body"]
)
def test_ratio_and_field_are_found_without_a_start(kind: str) -> None:
    """From each kind of data, within five standard errors; an axis tells little of a fast spin's ratio."""
    t, values = measured(kind, *((300, 60.0) if kind == "axis" else (100, 20.0)))
    fit = atlas.fit(t, **{kind: values}, sigma=NOISE)
    for name, truth in {"ratio": RATIO, "b": float(np.linalg.norm(FIELD)), "omega3": OMEGA[2]}.items():
        assert abs(fit.params[name].value - truth) < 5 * fit.params[name].stderr, name
    assert fit.params["b"].stderr < 0.02
    assert abs(fit.redchi - 1) < 0.3
    assert not fit.warnings


def test_all_ten_parameters_of_attitudes_lie_within_their_covariance(attitudes: Any) -> None:
    """Together within their covariance: the squared distance is that of ten degrees of freedom."""
    truth = {"ratio": RATIO}
    for letter, vector in (("B", FIELD), ("omega", OMEGA), ("a", ATTITUDE.as_rotvec())):
        truth |= {f"{letter}{i}": float(x) for i, x in enumerate(vector, 1)}
    off = np.array([attitudes.params[name].value - truth[name] for name in attitudes.names])
    assert off @ np.linalg.solve(attitudes.covariance, off) < 35
    assert attitudes.undetermined == ()


def test_the_error_of_a_prediction_is_within_its_band(attitudes: Any) -> None:
    """Against an integration, long after the data, and so does its horizon."""
    t = np.linspace(60.0, 120.0, 7)
    steps = atlas.simulate(RATIO, ATTITUDE.inv().apply(FIELD), OMEGA, t, rtol=1e-12)
    value, sigma = attitudes.predict(t)
    off = Rotation.from_matrix(value @ (ATTITUDE.as_matrix() @ steps.R).swapaxes(1, 2)).as_rotvec()
    assert (abs(off) < 5 * sigma).all()
    assert (sigma < 0.1).all()
    until = attitudes.horizon(0.05)
    assert (
        attitudes.predict(until - 5).sigma.max() <= 0.05 < attitudes.predict(until + np.linspace(0, 20, 50)).sigma.max()
    )


@pytest.mark.parametrize("family", ["general", "elementary"])
@pytest.mark.parametrize("kind", ["rotation", "axis", "angular_velocity", "field_in_body", "signal"])
def test_derivatives_agree_with_differences_of_residuals(kind: str, family: str) -> None:
    """By central differences, of residuals that are small, as they are where least squares end."""
    t = np.linspace(0.1, 5, 9)
    values = {"ratio": RATIO} | dict(
        zip([f"{x}{i}" for x in ("B", "omega", "a") for i in "123"], [*FIELD, *OMEGA, 0.3, -0.2, 0.4], strict=True)
    )
    if family == "elementary":
        values = {name: value for name, value in values.items() if "omega" not in name} | {"omega2": 0.7}
    model = model_of(family)
    params = Parameters({name: Parameter(value) for name, value in values.items()})
    motion = model.make(values)
    function = lambda R: R[:, 0, 1] ** 2 + R[:, 2, 2]  # noqa: E731
    data = Data(kind, t, np.zeros((9, 1)), np.ones((9, 1)), function)
    seen = data.of(motion, t)
    data = Data(kind, t, seen[:, :, 2] if kind == "axis" else seen, np.ones((9, 1)), function)
    problem = Problem(model, data, params, "linear", 2.0)
    x, h = np.array(list(values.values())), 1e-6
    expected = [(problem.residuals(x + h * e) - problem.residuals(x - h * e)) / (2 * h) for e in np.eye(len(x))]
    np.testing.assert_allclose(problem.jacobian(x), np.transpose(expected), atol=1e-7)


@pytest.mark.slow
def test_an_elementary_motion_does_not_tell_ratio_and_field_apart() -> None:
    """It is said in words, with the combination, which leaves the motion as it is; and other parameters are found."""
    rng = np.random.default_rng(2)
    t = np.linspace(0, 30, 150)
    exact = atlas.ElementaryMotion(1.5, (1.0, 2.0), 0.7).rotation(t)
    R = Rotation.from_rotvec(rng.normal(0, NOISE, (150, 3))).as_matrix() @ exact
    fit = atlas.fit(t, rotation=R, sigma=NOISE)
    assert any("ratio" in words and "not determined apart" in words for words in fit.undetermined)
    assert fit.params["ratio"].stderr is None
    assert fit.params["b"].stderr is None
    assert "not determined" in fit.report()
    assert (fit.predict(t).sigma < NOISE).all()
    fit_fixed = atlas.fit(t, rotation=R, sigma=NOISE, params={"ratio": {"value": 1.5, "vary": False}})
    assert abs(fit_fixed.params["b"].value - np.sqrt(5)) < 5 * fit_fixed.params["b"].stderr < 0.1


@pytest.mark.slow
def test_the_axis_of_an_elementary_motion_tells_no_more_than_the_direction_of_the_field() -> None:
    """The axis turns about the field at omega2 / sin(angle), whatever the ratio and the size of the field.

    Both reversed, omega2 and field, turn the axis alike: the fit finds one of the two and names the other.
    """
    rng = np.random.default_rng(1)
    t = np.linspace(0, 20, 200)
    n = atlas.ElementaryMotion(1.5, (1.0, 2.0), 0.7).rotation(t)[:, :, 2] + rng.normal(0, 1e-3, (200, 3))
    fit = atlas.fit(t, "elementary", axis=n / np.linalg.norm(n, axis=1, keepdims=True), sigma=1e-3)
    assert [name for name in ("ratio", "B2", "B3", "b") if fit.params[name].stderr] == []
    assert abs(abs(fit.params["omega2"].value) - 0.7) < 5 * fit.params["omega2"].stderr < 1e-3
    reversed_both = ("B1", "B2", "B3", "omega2")
    (solution,) = (alternative.values for alternative in fit.alternatives if alternative.equal)
    assert [solution[name] for name in reversed_both] == [-fit.params[name].value for name in reversed_both]
    field = np.array([fit.params[name].value for name in reversed_both[:3]]) * np.sign(fit.params["omega2"].value)
    assert np.linalg.norm(field / np.linalg.norm(field) - np.array([0, 1, 2]) / np.sqrt(5)) < 1e-3
    assert "ratio is not determined by these data." in fit.undetermined


@pytest.mark.slow
def test_noise_is_estimated_and_outliers_are_resisted() -> None:
    """Without sigma the scatter tells it; with a robust loss one attitude in fifteen may be anything."""
    t, R = measured("rotation")
    found = atlas.fit(t, rotation=R)
    assert abs(found.sigma / NOISE - 1) < 0.2
    assert found.redchi == pytest.approx(1)
    R[::15] = Rotation.random(10, random_state=3).as_matrix()
    robust = atlas.fit(t, rotation=R, loss="soft_l1")
    assert abs(robust.sigma / NOISE - 1) < 0.3
    assert abs(robust.params["ratio"].value - RATIO) < 5 * robust.params["ratio"].stderr < 0.05
    warned = [
        [words for words in fit.warnings if "soft_l1" in words] for fit in (found, robust, atlas.fit(t, rotation=R))
    ]
    assert [len(words) for words in warned] == [0, 0, 1]


def test_one_outlier_of_few_attitudes_is_reported() -> None:
    """Of eighteen attitudes of a free body one is off by thirty times the noise."""
    rng, t = np.random.default_rng(1), np.linspace(0, 6, 18)
    turns = rng.normal(0, 1e-3, (18, 3))
    turns[9, 0] += 0.03
    R = atlas.FreeMotion(1.5, (0.3, 0.7, 0.2)).rotation(t) @ Rotation.from_rotvec(turns).as_matrix()
    assert any("soft_l1" in words for words in atlas.fit(t, "free", rotation=R).warnings)


@pytest.mark.slow
def test_rounding_errors_determine_no_parameter() -> None:
    """Exact data of a body at rest, and of a spin about its axis, say nothing of ratio and field."""
    t = np.arange(20.0)
    for turns in (0.0 * t, 0.3 * t):
        R = Rotation.from_rotvec(np.outer(turns, [0.0, 0.0, 1.0])).as_matrix()
        fit = atlas.fit(t, rotation=R)
        assert fit.params["ratio"].stderr is fit.params["b"].stderr is None
        assert any("ratio" in words for words in fit.undetermined)


@pytest.mark.slow
def test_drag_is_reported() -> None:
    """A spin that dies away by two percent is no motion of the family: chi square and correlations say so."""
    t, _ = measured("rotation", 60, 15.0)
    slowed = t - 0.02 * t * t / (2 * t[-1])
    steps = atlas.simulate(RATIO, FIELD, OMEGA, slowed, rtol=1e-11)
    fit = atlas.fit(t, rotation=steps.R, sigma=1e-4, family="general")
    assert any("chi square" in words for words in fit.warnings)
    assert "drag" in str(fit)


@pytest.mark.slow
def test_the_family_that_explains_the_data_better_is_named() -> None:
    """Of a body with three moments, fitted as a symmetric one, the family that has it is named."""
    t, _ = measured("rotation", 60, 15.0)
    R = atlas.AsymmetricMotion((0.8, 1.0, 1.3), FIELD, OMEGA).rotation(t)
    fit = atlas.fit(t, rotation=R, sigma=1e-3)
    assert any("asymmetric" in words for words in fit.warnings)
    assert not atlas.fit(t, "asymmetric", rotation=R, sigma=1e-3).undetermined


@pytest.mark.slow
@pytest.mark.parametrize("seed", [2, 6])
def test_the_small_nutation_of_a_fast_spin_is_found_in_axes(seed: int) -> None:
    """A spin of 30 that nutates by a hundredth: chi square is that of noise, statements about the body are right."""
    rng = np.random.default_rng(seed)
    t = np.arange(400) * 1e-2
    true = atlas.GeneralMotion(1.8, (0.6, 0.8), omega=(0.2, 0.5, 30.0))
    n = true.third_axis(t) + rng.normal(0, NOISE, (t.size, 3))
    fit = atlas.fit(t, axis=n, sigma=NOISE)
    assert abs(fit.redchi - 1) < 0.3
    for name, truth in {"ratio": 1.8, "B2": 0.6, "B3": 0.8, "omega3": 30.0}.items():
        error = fit.params[name].stderr
        assert error is None or abs(fit.params[name].value - truth) < 5 * error, name
    K3 = float(fit.motion.field_in_body(0.0)[2])
    assert fit.params["ratio"].value * (fit.params["omega3"].value + K3) == pytest.approx(1.8 * 30.8, rel=0.1)


@pytest.mark.slow
def test_noisy_rates_with_the_expected_chi_square_raise_no_doubt() -> None:
    """Noise as large as the changes of the rates is no doubt where chi square is as expected."""
    rng, t = np.random.default_rng(0), np.linspace(0.0, 40.0, 400)
    true = atlas.GeneralMotion(RATIO, FIELD[1:], omega=OMEGA).angular_velocity(t)
    sigma = 0.3 * float(true.std(0).max())
    fit = atlas.fit(t, angular_velocity=true + rng.normal(0, sigma, true.shape), sigma=sigma)
    assert abs(fit.redchi - 1) < 0.2
    assert not fit.warnings


@pytest.mark.slow
def test_bounds_and_expressions_are_kept() -> None:
    """As lmfit has them: tied parameters follow, and are none of the varied ones."""
    t, R = measured("rotation", 80, 15.0)
    fit = atlas.fit(t, rotation=R, sigma=NOISE, params={"ratio": {"value": 1.2, "max": 1.4}, "B2": {"expr": "-2*B1"}})
    assert abs(fit.params["ratio"].value - RATIO) < 5 * fit.params["ratio"].stderr
    assert fit.params["B2"].value == pytest.approx(-2 * fit.params["B1"].value)
    assert "B2" not in fit.names


def test_times_may_come_in_any_order() -> None:
    """The data are sorted, with their errors."""
    t, sigma = np.array([3.0, 1.0, 2.0, 0.0, 4.0]), np.arange(1.0, 6.0)
    data = of_arrays(t, {"angular_velocity": t[:, None] * np.ones(3)}, sigma, 0.0, scalar_first=False)
    assert data.t.tolist() == data.values[:, 0].tolist() == [0, 1, 2, 3, 4]
    assert data.sigma[:, 0].tolist() == [4, 2, 3, 1, 5]


@pytest.mark.slow
def test_a_fit_is_shown_as_text_html_figure_and_data(attitudes: Any) -> None:
    """As text, in a notebook, as a figure of two panels, and as plain data."""
    assert "reduced chi square" in str(attitudes)
    assert "<table>" in attitudes._repr_html_()
    figure = attitudes.plot()
    assert isinstance(figure, Figure)
    assert len(figure.axes) == 2
    assert json.loads(json.dumps(attitudes.record()))["params"]["ratio"]["stderr"] > 0


def quotient(R: Any) -> Any:
    """Return a signal of one number."""
    return R[:, 0, 0] / (2 + R[:, 1, 2])


def fitted_signal(start: Any) -> Any:
    """Return a fit that another process can make."""
    t = np.linspace(0, 10, 60)
    motion = atlas.GeneralMotion.in_laboratory(RATIO, FIELD, np.eye(3), OMEGA)
    return atlas.fit(t, signal=(quotient(motion.rotation(t)), quotient), sigma=NOISE, params=start)


@pytest.mark.slow
def test_a_fit_survives_copying_and_pickling(attitudes: Any) -> None:
    """With its parameters, its motion and its predictions, all equal; and so do copies and pickles."""
    start = {"ratio": RATIO, **{f"B{i}": x for i, x in enumerate(FIELD, 1)}}
    start |= {f"omega{i}": x for i, x in enumerate(OMEGA, 1)} | {"a1": 0.0, "a2": 0.0, "a3": 0.0}
    with ProcessPoolExecutor(1, get_context("spawn")) as pool:
        fit_there = pool.submit(fitted_signal, start).result()
    fits = [(attitudes, f(attitudes)) for f in (copy, deepcopy, lambda fit: pickle.loads(pickle.dumps(fit)))]  # noqa: S301  our own
    for here, fit_other in [(fitted_signal(start), fit_there), *fits]:
        assert fit_other.record() == here.record()
        assert {name: p.stderr for name, p in fit_other.params.items()} == {n: p.stderr for n, p in here.params.items()}
        for prediction, second in zip(here.predict([1.0, 20.0]), fit_other.predict([1.0, 20.0]), strict=True):
            assert np.array_equal(prediction, second)
    assert fits[0][1].conf_interval(p_names=["ratio"], sigmas=[1])


def test_errors_for_former_names_name_the_new_names(attitudes: Any) -> None:
    """And a name that a fit never had is only said to be none."""
    for old, new in {"doubts": "warnings", "rivals": "alternatives"}.items():
        with pytest.raises(AttributeError, match=f"{old}.*{new}"):
            getattr(attitudes, old)
    with pytest.raises(AttributeError, match="no attribute 'nothing'"):
        _ = attitudes.nothing


def test_a_fit_is_one_line_in_a_list(attitudes: Any) -> None:
    """As `repr` shows it."""
    assert len(repr([attitudes])) < 160
    assert "\n" not in repr(attitudes)


def test_known_parameters_are_fixed_by_name() -> None:
    """As `--fix` does it; where `params` has the name too, it is refused."""
    t, R = measured("rotation", 60, 10.0)
    fit = atlas.fit(t, rotation=R, sigma=NOISE, fix={"ratio": RATIO}, params={"B1": 0.1})
    assert "ratio" not in fit.names
    assert fit.params["ratio"].value == RATIO
    for fix, says in [
        ({"ratio": 3.0}, "ratio must be in"),
        ({"B1": 0.1}, "B1 is in both"),
        ({"k9": 1.0}, "have no 'k9'"),
    ]:
        with pytest.raises(AtlasError, match=says):
            atlas.fit(t, rotation=R, fix=fix, params={"B1": 0.1})


def diagonal(R: Any) -> Any:
    """Return the signals R11, R22, R33."""
    return R[:, [0, 1, 2], [0, 1, 2]]


def squares(R: Any) -> Any:
    """Return squares, which no reversal of an axis changes, and which order the axes of the laboratory."""
    return np.column_stack([R[:, 0, 0] ** 2, R[:, 1, 2] ** 2 + R[:, 0, 1], R[:, 2, 2] ** 2])


def exchanged(R: Any) -> Any:
    """Return data that distinguish neither the axes 1 and 2 of the laboratory nor the direction of the third."""
    return np.column_stack([R[:, 0, 2] + R[:, 1, 2], R[:, 0, 2] * R[:, 1, 2], R[:, 2, 0] ** 2 - R[:, 2, 1]])


def four(R: Any) -> Any:
    """Return entries of R that change their signs together for no pair of reversals."""
    return R[:, [0, 1, 2, 2], [0, 2, 0, 2]]


def of_start(family: str, signal: Any, truth: dict[str, float], noise: float = 1e-3) -> tuple[Any, Any]:
    """Return a fit of a noisy signal from the true values, and the times."""
    t = np.linspace(0, 20, 200)
    values = signal(model_of(family).make(truth).rotation(t))
    noisy = values + np.random.default_rng(0).normal(0, noise, values.shape)
    start = {name: x for name, x in truth.items() if name not in model_of(family).fixed}
    return atlas.fit(t, family, signal=(noisy, signal), sigma=noise, params=start), t


TRUTH = {
    "ratio": 1.4, "B1": 0.4, "B2": -0.9, "B3": 1.2, "omega1": 0.5, "omega2": 0.3, "omega3": -1.1, "a1": 0.1, "a2": -0.2,
    "a3": 0.3,
}  # fmt: skip
OF_THREE = {name: x for name, x in TRUTH.items() if name != "ratio"} | {"I1": 0.8, "I3": 1.4}
OF_TOP = {n: x for n, x in TRUTH.items() if n[0] in "oa"} | {
    "I3": 0.7, "k2": 0.3, "k3": 0.4, "linear": 1.5, "quadratic": 0.6, "n1": 0.0, "n2": 0.0, "n3": 1.0,
}  # fmt: skip


@pytest.mark.slow
@pytest.mark.parametrize(
    ("family", "signal", "truth", "count"),
    [
        ("general", diagonal, TRUTH, 3),
        ("general", squares, TRUTH, None),
        ("general", exchanged, TRUTH, None),
        ("general", quotient, TRUTH, 3),
        ("general", four, TRUTH, 0),
        ("asymmetric", diagonal, OF_THREE, 3),
        ("top", squares, OF_TOP, None),
    ],
)
def test_solutions_that_are_equal_by_symmetry_are_listed(family: str, signal: Any, truth: Any, count: Any) -> None:
    """Each gives the same data, made by itself, at other values; R11, R22, R33 have four solutions."""
    fit, t = of_start(family, signal, truth)
    equal = [alternative for alternative in fit.alternatives if alternative.equal]
    assert (len(equal) == count) if count is not None else equal
    assert any("by symmetry" in words for words in fit.warnings) == bool(equal)
    values_own = signal(fit.motion.rotation(t))
    solutions = [fit.record()["params"][name]["value"] for name in model_of(family).names]
    solutions = [solutions, *([solution.values[name] for name in model_of(family).names] for solution in equal)]
    for i, solution in enumerate(equal):
        assert signal(model_of(family).make(solution.values).rotation(t)) == pytest.approx(values_own, abs=1e-9)
        assert min(np.abs(np.subtract(solutions[i + 1], x)).max() for x in solutions[: i + 1]) > 1e-3


@pytest.mark.parametrize("fixed", [(), ("B1", "B2"), ("B1", "B2", "B3")])
@pytest.mark.parametrize("family", ["general", "asymmetric", "elliptic"])
def test_derivatives_in_the_attitude_agree_with_neighbouring_motions(family: str, fixed: tuple[str, ...]) -> None:
    """Whether the field is free, partly free or zero: a rotation of the laboratory turns the field."""
    t = np.linspace(0, 3, 30)
    data = of_arrays(t, {"signal": (np.ones((30, 3)), diagonal)}, 1.0, 0.0, scalar_first=False)
    params, _ = parameters_of(model_of(family), data, None, dict.fromkeys(fixed, 0.0))
    problem = Problem(model_of(family), data, params, "linear", 1.0)
    problem.error = 1e-11
    values = {**OF_THREE, "ratio": 1.4, "z": 2.0}
    x, h = np.array([values[name] for name in problem.names]), 1e-4
    _, J = problem.residuals_and_slopes(x[None])
    for name in ("a1", "a2", "a3"):
        i = problem.names.index(name)
        up, down = problem.residuals_of_all(x + h * np.array([[1.0], [-1.0]]) * np.eye(x.size)[i])
        assert J[0, i] == pytest.approx((up - down) / (2 * h), abs=3e-5)


@pytest.mark.slow
def test_a_signal_found_without_a_start_has_the_truth_among_its_solutions() -> None:
    """Where the fit has another one, that of the truth is listed."""
    motion, t = atlas.motion(1.4, (0.4, -0.9, 1.2), (0.5, 0.3, -1.1)), np.linspace(0, 20, 200)
    values = diagonal(motion.rotation(t)) + np.random.default_rng(0).normal(0, 1e-3, (200, 3))
    fit = atlas.fit(t, signal=(values, diagonal), sigma=1e-3)
    solutions = [fit.record()["params"]] + [alternative.values for alternative in fit.alternatives if alternative.equal]
    fields = [[p["value"] if isinstance(p, dict) else p for p in map(x.get, ("B1", "B2", "B3"))] for x in solutions]
    assert min(np.abs(np.subtract(field, (0.4, -0.9, 1.2))).max() for field in fields) < 1e-3


@pytest.mark.slow
def test_bounds_choose_one_of_equal_solutions() -> None:
    """With the signs of two components known there is one only."""
    t = np.linspace(0, 20, 200)
    values = diagonal(model_of("general").make(TRUTH).rotation(t))
    noisy = values + np.random.default_rng(0).normal(0, 1e-3, values.shape)
    params = TRUTH | {"B2": {"value": -0.9, "max": 0.0}, "B3": {"value": 1.2, "min": 0.0}}
    fit = atlas.fit(t, signal=(noisy, diagonal), sigma=1e-3, params=params)
    assert not [alternative for alternative in fit.alternatives if alternative.equal]
    assert not fit.warnings


@pytest.mark.slow
def test_other_kinds_of_data_have_their_equal_solutions() -> None:
    """The axis of three moments does not tell a half turn about it; attitudes and the axis of a symmetric body do."""
    t, rng = np.linspace(0, 15, 100), np.random.default_rng(1)
    for family, truth in (("general", TRUTH), ("asymmetric", OF_THREE)):
        R = Rotation.from_rotvec(rng.normal(0, 1e-3, (100, 3))).as_matrix() @ model_of(family).make(truth).rotation(t)
        for kind, values in (("rotation", R), ("axis", R[:, :, 2])):
            start = {name: x for name, x in truth.items() if (family, kind, name) != ("general", "axis", "a3")}
            fit = atlas.fit(t, family, **{kind: values}, sigma=1e-3, params=start)
            equal = [alternative for alternative in fit.alternatives if alternative.equal]
            assert bool(equal) == ((family, kind) == ("asymmetric", "axis"))
            for solution in equal:
                axes = model_of(family).make(solution.values).rotation(t)[:, :, 2]
                assert axes == pytest.approx(fit.motion.rotation(t)[:, :, 2], abs=1e-9)


@pytest.mark.slow
def test_a_dipole_that_biases_the_field_is_named() -> None:
    """Unseen in a second the family top fits as well, with other values; where it is seen, that is a warning."""
    t, b = np.linspace(0, 1, 300), float(np.linalg.norm((0.3, 0.5, 1.1)))
    noise = Rotation.from_rotvec(np.random.default_rng(1).normal(0, 1e-3, (300, 3))).as_matrix()
    warned = []
    for dipole in (0.02, 0.1):
        top = atlas.TopMotion.in_laboratory(
            (1.0, 1.3), np.array((0.3, 0.5, 1.1)) / b, np.eye(3), OMEGA, coupling=(b, 1.3 * b), linear=dipole
        )
        fit = atlas.fit(t, rotation=noise @ top.rotation(t), sigma=1e-3)
        alternative = next(candidate for candidate in fit.alternatives if candidate.family == "top")
        off = [
            abs(alternative.values[n] - fit.params[n].value) / fit.params[n].stderr for n in ("ratio", "B1", "B2", "B3")
        ]
        assert max(off) > 5
        assert abs(alternative.redchi - 1) < 0.2
        assert "wider family top" in fit.report()
        warned.append(any("wider family top" in words for words in fit.warnings))
    assert warned == [False, True]


def data_file(path: Path, count: int = 80) -> Path:
    """Write attitudes into a file."""
    t, R = measured("rotation", count, 15.0)
    names = ",".join(f"R{i}{j}" for i in "123" for j in "123")
    table = np.column_stack([t, R.reshape(-1, 9)])
    np.savetxt(path, table, delimiter=",", header=f"# sigma = {NOISE}\nt,{names}", comments="")
    return path


@pytest.mark.slow
def test_the_command_fits_a_file(tmp_path: Path) -> None:
    """With sigma from its head, predictions, a figure, and JSON that holds the same numbers."""
    file = data_file(tmp_path / "mine.csv")
    picture = str(tmp_path / "mine.svg")
    words = ["fit", str(file), "--predict", "20s", "20000ms", "--horizon", "0.1", "--figure", picture, "--json"]
    result = CliRunner().invoke(command, words, catch_exceptions=False)
    record = json.loads(result.stdout)
    assert abs(record["params"]["ratio"]["value"] - RATIO) < 5 * record["params"]["ratio"]["stderr"]
    prediction, second = record["predictions"]
    assert np.shape(prediction["value"]) == (3, 3)
    assert prediction == second
    assert record["horizon"] > 15
    assert (tmp_path / "mine.svg").stat().st_size > 1000
    assert record["sigma"] == NOISE


def test_the_command_has_status_one_where_several_solutions_are_equal(tmp_path: Path) -> None:
    """Of a file with R11, R22, R33, from a start so that none is sought."""
    t = np.linspace(0, 20, 200)
    values = diagonal(model_of("general").make(TRUTH).rotation(t))
    noisy = values + np.random.default_rng(0).normal(0, 1e-3, values.shape)
    np.savetxt(tmp_path / "s.csv", np.column_stack([t, noisy]), delimiter=",", header="t,R11,R22,R33", comments="")
    start = [f"{name}={x}" for name, x in TRUTH.items()]
    words = ["fit", str(tmp_path / "s.csv"), "--sigma", "1e-3", "--start", *start, "--json"]
    result = CliRunner().invoke(command, words, standalone_mode=False)
    record = json.loads(result.stdout)
    assert result.return_value == 1
    assert sum(alternative["equal"] for alternative in record["alternatives"]) == 3


def test_the_command_lists_the_families_of_the_fit() -> None:
    """Its names, which it lists without loading them, are those of the fit."""
    from atlas.cli import fit
    from atlas.fitting import FittedFamily, Loss
    from atlas.fitting.data import KINDS

    assert set(fit.FAMILIES) == set(MODELS) == {*get_args(FittedFamily)}
    assert set(fit.KINDS) == {*KINDS, "signal"}
    assert get_args(Loss) == fit.LOSSES


@pytest.mark.slow
def test_a_free_body_and_a_heavy_top_are_fitted() -> None:
    """A free body, and a heavy top in a known direction."""
    rng = np.random.default_rng(3)
    t = np.linspace(0, 20, 120)
    noise = Rotation.from_rotvec(rng.normal(0, NOISE, (120, 3))).as_matrix()
    fit_free = atlas.fit(t, "free", sigma=NOISE, rotation=noise @ atlas.FreeMotion(1.4, (0.5, 0.3, 1.7)).rotation(t))
    assert abs(fit_free.params["ratio"].value - 1.4) < 5 * fit_free.params["ratio"].stderr < 0.05
    top = atlas.TopMotion((1.0, 0.6), (0.0, 0.0), direction=(0.6, 0.8), omega=(0.1, 0.2, 3.0), linear=2.0)
    upright = Rotation.align_vectors([[0, 0, 1]], [[0, 0.6, 0.8]])[0].as_matrix()
    params = {name: {"value": 0.0, "vary": False} for name in ("k2", "k3", "quadratic")}
    fit = atlas.fit(t, "top", sigma=NOISE, rotation=noise @ upright @ top.rotation(t), params=params)
    for name, truth in {"I3": 0.6, "linear": 2.0, "omega3": 3.0}.items():
        assert abs(fit.params[name].value - truth) < 5 * fit.params[name].stderr < 0.1, name
    assert fit.covariance.shape == (8, 8)


@pytest.mark.slow
def test_a_body_with_three_moments_is_fitted_without_a_start() -> None:
    """From attitudes without a start, in steps of an integration, with errors and predictions of the closed form."""
    rng = np.random.default_rng(4)
    t = np.sort(rng.uniform(0, 15, 60))
    steps = atlas.simulate((0.7, 1.0, 1.2), ATTITUDE.inv().apply(FIELD), OMEGA, t, rtol=1e-11)
    R = Rotation.from_rotvec(rng.normal(0, NOISE, (60, 3))).as_matrix() @ ATTITUDE.as_matrix() @ steps.R
    fit = atlas.fit(t, "asymmetric", rotation=R, sigma=NOISE)
    for name, truth in {"I1": 0.7, "I3": 1.2, "B1": FIELD[0], "omega2": OMEGA[1]}.items():
        assert abs(fit.params[name].value - truth) < 5 * fit.params[name].stderr < 0.2, name
    assert isinstance(fit.motion, atlas.AsymmetricMotion)
    assert (fit.predict(20.0).sigma < 0.1).all()
    rates = atlas.fit(t, "asymmetric", angular_velocity=steps.Omega + rng.normal(0, NOISE, (60, 3)), sigma=NOISE)
    assert abs(rates.params["I1"].value - 0.7) < 5 * rates.params["I1"].stderr < 0.1


def test_an_elliptic_motion_names_its_undetermined_parameters() -> None:
    """Its field turns in the body as a free body's momentum does, which many bodies share."""
    rng = np.random.default_rng(5)
    t = np.sort(rng.uniform(0, 20, 60))
    exact = atlas.EllipticMotion((0.8, 1.0, 1.3), (0.2, 1.0, 0.6), z=1.7).rotation(t)
    fit = atlas.fit(
        t, "elliptic", rotation=Rotation.from_rotvec(rng.normal(0, NOISE, (60, 3))).as_matrix() @ exact, sigma=NOISE
    )
    assert abs(fit.redchi - 1) < 0.4
    assert any("I1" in words and "not determined apart" in words for words in fit.undetermined)


@pytest.mark.slow
def test_tops_are_fitted_to_rates() -> None:
    """The direction of the field in the body is sought; the turn about it is not seen."""
    rng = np.random.default_rng(6)
    t = np.linspace(0, 15, 80)
    top = atlas.TopMotion((1.0, 0.6), (0.0, 0.0), direction=(0.6, 0.8), omega=(0.1, 0.2, 3.0), linear=2.0)
    params = {name: {"value": 0.0, "vary": False} for name in ("k2", "k3", "quadratic")}
    velocities = top.angular_velocity(t) + rng.normal(0, NOISE, (80, 3))
    fit = atlas.fit(t, "top", angular_velocity=velocities, sigma=NOISE, params=params)
    for name, truth in {"I3": 0.6, "linear": 2.0, "omega3": 3.0}.items():
        assert abs(abs(fit.params[name].value) - truth) < 5 * fit.params[name].stderr < 0.2, name
    assert any("about the field" in words for words in fit.undetermined)


@pytest.mark.parametrize(
    "quantity",
    [
        pytest.param(lambda R: np.stack([R[:, 0, 0], R[:, 1, 2]], -1), id="two"),
        pytest.param(lambda R: R[:, 0, 0] / 2 + R[:, 1, 2], id="one", marks=pytest.mark.slow),
    ],
)
def test_a_signal_of_one_or_two_numbers_determines_ratio_and_field(quantity: Any) -> None:
    """Two numbers, or a single one, that a function makes of R tell the ratio and the size of the field."""
    rng = np.random.default_rng(7)
    t = np.sort(rng.uniform(0, 20, 150))
    values = quantity(atlas.simulate(RATIO, FIELD, OMEGA, t, rtol=1e-11).R)
    fit = atlas.fit(t, signal=(values + rng.normal(0, NOISE, values.shape), quantity), sigma=NOISE)
    assert abs(fit.redchi - 1) < 0.4
    assert abs(fit.params["ratio"].value - RATIO) < 5 * fit.params["ratio"].stderr < 0.1
    assert [words for words in fit.warnings if "by symmetry" not in words] == []


@pytest.mark.slow
def test_a_free_body_is_not_taken_for_one_of_those_in_a_field_that_turn_alike() -> None:
    """For s > 0, and some s < 0, these have moments J_i (J_j + J_k + s), but for a factor, in the field M/s along M."""
    J, omega = np.array([0.8, 1.0, 1.3]), np.array([1.3, 1.2, 0.9])
    t = np.sort(np.random.default_rng(1).uniform(0, 40, 120))
    R = atlas.AsymmetricMotion(J, np.zeros(3), omega).rotation(t)
    for s in (1.0, -4.0):
        motion_alike = atlas.AsymmetricMotion(abs(J * (J.sum() - J + s)), J * omega / s, omega)
        assert motion_alike.rotation(t[::40]) == pytest.approx(R[::40], abs=1e-12)
    noise = Rotation.from_rotvec(np.random.default_rng(2).normal(0, NOISE, (t.size, 3)))
    fit = atlas.fit(t, "asymmetric", rotation=(noise * Rotation.from_matrix(R)).as_matrix(), sigma=NOISE)
    assert [fit.params[name].value for name in ("I1", "I3", "b")] == pytest.approx([0.8, 1.3, 0.0], abs=0.01)
    assert "free body of moments J" in fit.undetermined[0]
    assert {"I1", "I3"} <= set(fit.undetermined[1].split(" are not")[0].replace(" and", ",").split(", "))


def test_bodies_that_turn_like_a_free_body_exist_for_the_stated_fields() -> None:
    """Moments J_i (J_j + J_k + s) are those of a body for s > 0, and where the two conditions on s < 0 hold."""
    rng, kinds = np.random.default_rng(4), set()
    for s in rng.uniform(-5, 1, 300):
        J = np.sort(rng.uniform(0.3, 1, 3))
        J[2] = rng.uniform(J[1], J[0] + J[1])
        pairs, room = J.sum() - J, J.sum() - 2 * J
        is_near = -pairs.min() < s < 0 and (-s * room <= 2 * J.prod() / J).all()
        is_far = s < -pairs.max() and (-s * room >= 2 * J.prod() / J).all()
        kinds.add((bool(s > 0), bool(is_near), bool(is_far)))
        moments = J * (pairs + s) * (1 if s > -pairs.max() else -1)
        is_possible = bool(s > 0 or is_near or is_far)
        with nullcontext() if is_possible else pytest.raises(atlas.AtlasError):
            atlas.AsymmetricMotion(moments, (0.1, 0.2, 0.3), (0.3, 0.1, 0.2))
    assert len(kinds) == 4


@pytest.mark.slow
def test_confidence_intervals_agree_with_lmfit(attitudes: Any) -> None:
    """Where errors are small the ends at one sigma are one standard error away; none where nothing is determined."""
    interval = attitudes.conf_interval(p_names=["ratio"], sigmas=[1])["ratio"]
    low, best, high = (value for _, value in interval)
    assert best == pytest.approx(attitudes.params["ratio"].value)
    assert [best - low, high - best] == pytest.approx([attitudes.params["ratio"].stderr] * 2, rel=0.1)


@pytest.mark.slow
def test_given_start_values_begin_the_fit() -> None:
    """A value that is given is where all motions start, at the epoch; distant starts are left."""
    t, w = measured("angular_velocity", 60, 10.0)
    fit = atlas.fit(t, angular_velocity=w, sigma=NOISE, params={"ratio": 1.2, "omega1": 1.0})
    assert abs(fit.params["ratio"].value - RATIO) < 5 * fit.params["ratio"].stderr
    hard = KINDS["ball, attitudes"](np.random.default_rng([0, 27]))  # chi square has many minima in b
    start = {f"{name}{i}": hard.truth[f"{name}{i}"] for name in ("omega", "a", "B") for i in (1, 2, 3)}
    assert abs(atlas.fit(hard.t, **hard.given, params=start).redchi - 1) < 0.1


@pytest.mark.slow
def test_a_slow_ball_in_a_strong_field_is_fitted() -> None:
    """Of a ball in a strong field, whose body turns slowly: within five standard errors."""
    fast = KINDS["ball, attitudes"](np.random.default_rng([0, 25]))
    b = atlas.fit(fast.t, **fast.given).params["b"]
    assert abs(b.value - fast.truth["b"]) < 5 * b.stderr


@pytest.mark.parametrize("size", [pytest.param(0.0, marks=pytest.mark.slow), 0.0009, 0.01])
def test_a_small_nutation_is_never_silent(size: float) -> None:
    """None is an elementary motion, which names its undetermined parameters; one of 3 sigma is told with its size."""
    rng = np.random.default_rng(8)
    t = np.linspace(0, 40, 200)
    steady = atlas.ElementaryMotion(1.5, (1.0, 2.0), 0.7)
    exact = atlas.motion(1.5, (0.0, 1.0, 2.0), (size * 3, 0.7, steady.omega3)).rotation(t)
    fit = atlas.fit(t, rotation=Rotation.from_rotvec(rng.normal(0, NOISE, (200, 3))).as_matrix() @ exact, sigma=NOISE)
    is_reported = any("ratio" in words and "not determined apart" in words for words in fit.undetermined)
    assert is_reported == (size < 0.01)
    assert is_reported == any("No nutation is seen beyond noise: one of" in words for words in fit.undetermined)
    if not is_reported:
        assert abs(fit.params["ratio"].value - 1.5) < 5 * fit.params["ratio"].stderr


@pytest.mark.slow
def test_a_small_nutation_is_found_or_reported_as_undetermined() -> None:
    """A nutation of a fourteenth of the noise at 500 times is found by its frequency, among thousands."""
    rng = np.random.default_rng(9)
    t = np.sort(rng.uniform(0, 200, 500))
    steady = atlas.ElementaryMotion(1.5, (1.0, 2.0), 0.7)
    exact = atlas.motion(1.5, (0.0, 1.0, 2.0), (0.008, 0.7, steady.omega3)).rotation(t)
    fit = atlas.fit(t, rotation=Rotation.from_rotvec(rng.normal(0, NOISE, (500, 3))).as_matrix() @ exact, sigma=NOISE)
    assert abs(fit.params["ratio"].value - 1.5) < 5 * fit.params["ratio"].stderr < 0.05
    assert abs(fit.redchi - 1) < 0.2


@pytest.mark.slow
@pytest.mark.parametrize("loss", ["linear", "soft_l1"])
def test_standard_errors_agree_with_many_measurements(loss: str) -> None:
    """Squared distances from the truth, by the covariance, are those of ten degrees of freedom each; with outliers too.

    Of 40 measurements of small noise; the mean of so many squares of normal numbers scatters by a fourteenth.
    """
    noise = 1e-4
    values = {"ratio": RATIO} | dict(
        zip([f"{x}{i}" for x in ("B", "omega", "a") for i in "123"], [*FIELD, *OMEGA, 0.3, -0.2, 0.4], strict=True)
    )
    model, t = model_of("general"), np.linspace(0, 20, 80)
    R, truth = model.make(values).rotation(t), np.array([*values.values()])
    params, _ = parameters_of(model, Data("rotation", t, R, np.ones((80, 1))), {})
    squares = []
    for seed in range(40):
        rng = np.random.default_rng(seed)
        turns = rng.normal(0, noise, (80, 3))
        if loss != "linear":
            turns[:4] = rng.normal(size=(4, 3))
        data = Data("rotation", t, Rotation.from_rotvec(turns).as_matrix() @ R, np.full((80, 1), noise))
        problem = Problem(model, data, params, loss, 2.0)
        fit = Fit.of(problem, [(problem.chi_square(truth), truth)], 0.0)
        off = np.array([fit.params[name].value for name in fit.names]) - truth
        squares.append(off @ np.linalg.solve(fit.covariance, off))
    assert abs(np.mean(squares) / 10 - 1) < 4 * np.sqrt(2 / 400)


def test_a_rotation_vector_follows_a_small_turn() -> None:
    """The derivative of log(D exp(-[v]x)) in v is that of SciPy's rotation vectors, for differences of any size."""
    rho, h = np.array([[0.9, -0.4, 0.7], [-1e-4, 2e-4, 3e-4]]), 1e-5
    for vector, J in zip(rho, np.linalg.inv(left_jacobian(rho).swapaxes(1, 2)), strict=True):
        D = Rotation.from_rotvec(vector)
        ends = [[(D * Rotation.from_rotvec(-s * h * e)).as_rotvec() for e in np.eye(3)] for s in (1, -1)]
        assert np.abs((np.subtract(*ends) / (2 * h)).T + J).max() <= 1e-8


def test_a_top_that_starts_from_rest_is_determined() -> None:
    """Undetermined parameters are measured by how fast the data change, not by the rate at the start, which is none."""
    tilted = [0.0, float(np.sin(0.3)), float(np.cos(0.3))]
    t = np.linspace(0.0, 20.0, 200)
    top = atlas.TopMotion((1.0, 1.0), (0.0, 0.0), tilted[1:], (0.0, 0.0, 0.0), linear=-900.0)
    axes = top.column(3, t) + np.random.default_rng(1).normal(0.0, 0.01, (200, 3))
    values_fixed = dict.fromkeys(["k2", "k3", "quadratic", "a1", "a2"], 0.0) | {
        "I3": 1.0,
        "n2": tilted[1],
        "n3": tilted[2],
    }
    params = {name: {"value": value, "vary": False} for name, value in values_fixed.items()}
    start = {"linear": {"value": -900.0}, **{f"omega{i}": {"value": 0.0} for i in "123"}}
    fit = atlas.fit(t, "top", axis=axes, sigma=0.01, params=params | start)
    assert abs(fit.params["linear"].value + 900) < 5 * fit.params["linear"].stderr < 1


@pytest.mark.parametrize(
    ("words", "says"),
    [
        ("--fix ratio=2.5", "ratio must be in (0, 2] and finite, not 2.5."),
        ("--fix ratio=-1", "ratio must be in (0, 2] and finite, not -1."),
        ("--fix ratio=0", "ratio must be in (0, 2] and finite, not 0."),
        ("--fix ratio=nan", "ratio must be in (0, 2] and finite, not nan."),
        ("--start B1=nan", "B1 must be finite, not nan."),
        ("--fix ratio=1.3 --start ratio=1.2", "ratio is given twice"),
        ("--fix ratio=1.4 ratio=1.5", "ratio is given twice"),
    ],
)
def test_an_impossible_value_is_refused_by_name(
    words: str, says: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """It is neither moved to a bound nor dropped."""
    with pytest.raises(SystemExit) as ended:
        main(["fit", str(data_file(tmp_path / "mine.csv", 10)), *words.split()])
    assert ended.value.code == 2
    assert says in capsys.readouterr().err


def test_a_held_value_is_within_its_own_bounds() -> None:
    """Also where lmfit has moved it already; varied parameters may begin anywhere, and tied ones follow."""
    import lmfit

    attitudes = Data("rotation", np.arange(9.0), np.tile(np.eye(3), (9, 1, 1)), np.ones((9, 1)))

    def variables_of(**params: Any) -> Any:
        plain = parameters_of(model_of("general"), attitudes, params)
        assert plain[1] == parameters_of(model_of("general"), attitudes, lmfit.create_params(**params))[1]
        return plain

    for params in (
        {"ratio": {"value": 1.8, "max": 1.5, "vary": False}},
        {"B1": {"value": -3, "min": -2, "vary": False}},
    ):
        for form in (params, lmfit.create_params(**params)):
            with pytest.raises(AtlasError, match="must be in"):
                parameters_of(model_of("general"), attitudes, form)
    variables, start = variables_of(ratio=2.5, B1={"min": 1.0}, B2={"expr": "2*B1"})
    assert start == {"ratio": 2.5}
    assert variables.values_with({"B1": 3.0})["B2"] == 6.0
    assert variables_of(ratio={"value": 2.0, "max": 2.0, "vary": False})[0]["ratio"].value == 2.0


@pytest.mark.slow
def test_a_bound_below_all_errors_has_no_horizon(attitudes: Any, tmp_path: Path) -> None:
    """The horizon is then nowhere, in words and in JSON, and a time of the data where only some are that good."""
    sigma = attitudes.predict(attitudes.t).sigma.max(-1)
    assert attitudes.horizon(sigma.min() / 2) == -np.inf
    horizon = attitudes.horizon(float(np.median(sigma)))
    assert horizon in attitudes.t[sigma <= np.median(sigma)]
    words = ["fit", str(data_file(tmp_path / "mine.csv")), "--horizon", "1e-9"]
    assert "good within 1e-09 nowhere" in CliRunner().invoke(command, words, catch_exceptions=False).stdout
    record = json.loads(CliRunner().invoke(command, [*words, "--json"], catch_exceptions=False).stdout)
    assert record["horizon"] is None
    assert record["missing"]["horizon"] == "a prediction is that good nowhere"


@pytest.mark.parametrize("epoch", [np.nan, np.inf])
def test_an_epoch_that_is_no_number_is_refused_by_name(epoch: float) -> None:
    """It is named where it is none."""
    t, R = measured("rotation", 10)
    with pytest.raises(AtlasError, match="epoch"):
        atlas.fit(t, rotation=R, epoch=epoch)


def test_a_faulty_cell_is_named_by_its_column(tmp_path: Path) -> None:
    """By the name of the column that is written."""
    (tmp_path / "q.csv").write_text("time,w,X,y,z\n0,1,0,0,0\n1,1,inf,0,0\n", encoding="utf-8")
    with pytest.raises(AtlasError, match="line 3, column X: the cell is inf"):
        of_file(tmp_path / "q.csv", None)


@pytest.mark.slow
def test_few_axes_of_unknown_noise_are_followed_by_the_least_squares() -> None:
    """Of 20 axes another motion leaves residuals nearly three times as large, which without sigma might be noise."""
    rng = np.random.default_rng(612)
    ratio, B, omega, a = rng.uniform(0.3, 1.9), rng.normal(size=3), rng.normal(size=3) * 1.5, rng.normal(size=3) * 0.8
    t = np.sort(rng.uniform(0, 6, 20))
    n = atlas.motion(ratio, B, omega, Rotation.from_rotvec(a)).third_axis(t)
    n = Rotation.from_rotvec(np.cross(n, 0.003 * rng.standard_normal((20, 3)))).apply(n)
    fit = atlas.fit(t, axis=n)
    for name, truth in zip(("B1", "B2", "B3"), B, strict=True):
        assert abs(fit.params[name].value - truth) < 4 * fit.params[name].stderr
    assert fit.alternatives


@pytest.mark.slow
def test_the_sign_of_an_elementary_field_is_not_seen_on_the_axis() -> None:
    """In the opposite field, with the opposite omega2, the axis goes the same way: both are named as equal."""
    t, rng = np.linspace(0, 20, 200), np.random.default_rng(3)
    axis = atlas.ElementaryMotion(1.4, (0.9, 1.2), 0.5).third_axis(t) + 1e-3 * rng.normal(size=(200, 3))
    fit = atlas.fit(t, family="elementary", sigma=1e-3, axis=axis)
    (solution,) = (alternative for alternative in fit.alternatives if alternative.equal)
    for name in ("B2", "B3", "omega2"):
        assert solution.values[name] == -fit.params[name].value
    assert any("omega2" in warning for warning in fit.warnings)


def test_fits_of_tops_have_exact_derivatives(monkeypatch: pytest.MonkeyPatch) -> None:
    """Derivatives in all parameters of a top, a direction of any length among them, are those of differences."""
    values = {
        "I3": 1.3, "k2": 0.5, "k3": 0.3, "linear": 0.2, "quadratic": 0.1, "n1": 0.3, "n2": 0.2, "n3": 0.8,
        "omega1": 0.3, "omega2": 0.4, "omega3": 1.2, "a1": 0.3, "a2": 0.2, "a3": -0.5,
    }  # fmt: skip
    top, t = model_of("top"), np.linspace(0.0, 20.0, 30)
    motion = top.make(values)
    v = replace(top, exact=False).vectors(values, top.names, t, dict.fromkeys(values, 1.0), motion)
    monkeypatch.setattr(type(top), "_near_motion", None)  # which differences need
    assert top.vectors(values, top.names, t, {}, motion) == pytest.approx(v, abs=1e-7 * abs(v).max())


@pytest.mark.slow
def test_data_are_named_in_the_plural_as_in_check() -> None:
    """Plural names of the data give the same fit as singular ones; both together, or another name, are refused."""
    t, R = measured("rotation", 30, 5.0)
    options = {"sigma": NOISE, "family": "general"}
    assert atlas.fit(t, rotations=R, **options).redchi == atlas.fit(t, rotation=R, **options).redchi
    with pytest.raises(AtlasError, match="rotation and rotations are the same data"):
        atlas.fit(t, rotation=R, rotations=R)
    with pytest.raises(TypeError, match="'rotatons'"):
        atlas.fit(t, rotatons=R)
