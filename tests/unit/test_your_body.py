"""The report of a body of the reader's own: its card, names, inputs, prose, and the whole build."""

import json
import re
import tomllib
from dataclasses import replace
from fractions import Fraction
from math import hypot, inf, pi, sqrt
from pathlib import Path

import numpy as np
import pytest
from lxml import html
from scipy.spatial.transform import Rotation
from syrupy.assertion import SnapshotAssertion

from atlas.bodies.laboratory import Spinning, anisotropy, demagnetization, disturbances
from atlas.book.card import ONE_PERIOD, card, object_of
from atlas.book.load import load
from atlas.book.markdown import fenced, read
from atlas.book.parts import ReportRequest
from atlas.book.verdict import shape_words, spins_on, verdict
from atlas.book.your_body import explorer_of, files_of, name_of, sign_of, template_values, title_of
from atlas.cli.app import main
from atlas.cli.your_body import request_of as words_to_request
from atlas.errors import AtlasError, FaultsError

SHELL = (
    "--shape cylindrical-shell --radius 1um --height 0.9um --mass 1.5e-15kg --charge 2e-15C --magnetic 0.8T "
    "--angle 30deg --spin 2Hz"
)
CASES = {
    "short in SI": SHELL,
    "negative disk": "--shape disk --radius 1e-6 --mass 1e-15 --charge -2e-15 --magnetic 0.75 1.3 --omega 0.3 0.7 0.2",
    "long on the curve": "--ratio 0.4 --field 1 2 --omega2 0.7",
    "ball": "--ratio 1 --field 1 2 --omega 0.3 0.7 0.2",
    "at rest": "--ratio 1.5 --field 1 2 --omega2 0",
    "free": "--ratio 1.5 --omega 0.3 0.7 0.2",
    "heavy top": "top --inertia 1 0.5 --direction 0.6 0.8 --omega 0.1 0.2 5 --linear 3",
    "asteroid": "--inertia 1 3.0836 3.235 --omega 0.02 0 0.1",
    "no start": "--ratio 0.7 --field 2 0",
    "nearly a ball": "--ratio 1.001 --field 1 2 --omega 0.3 0.7 0.2",
    "rod": "--ratio 0.001 --field 1 2 --omega 0.3 0.7 2",
    "field along the axis": "--ratio 1.6 --field 0 2 --omega 0 0 3",
    "on the band": "--ratio 0.7 --field 2 0 --omega 0 -1 0",
    "near a separatrix": "--ratio 0.7 --field 2 0.1 --omega 0.001 -1 0",
    "magnetised top": "top --inertia 1 0.5 --direction 0.6 0.8 --omega 0.1 0.2 5 --quadratic 2",
    "three moments in a field": "--inertia 1 1.5 2.2 --field 0.2 1 0.6 --omega 0.3 0.7 0.2",
    "Gaussian": "--shape disk --radius 1e-4 --mass 1e-12 --charge -2e-2 --magnetic 750 1300 --units gaussian "
    "--omega 0.3 0.7 0.2",
    "point charge": "particle --mu -1 --electric 0 0.5 0 --magnetic 0 0 1 --velocity 1 0 0",
}


def request_of(words: str | list[str]) -> ReportRequest:
    """Return the request that the options of a command are."""
    return words_to_request(words.split() if isinstance(words, str) else words)[0]


@pytest.mark.parametrize("name", CASES)
def test_the_numbers_of_cards_are_unchanged(name: str, snapshot: SnapshotAssertion) -> None:
    """Digits, proven digits, units and reasons of each case, and its title."""
    request = request_of(CASES[name])
    result = card(request)
    title = title_of(request, result, verdict(object_of(request)))
    keys = ("digits", "proven_digits", "unit", "reason")
    assert {"title": title} | {key: [entry[k] for k in keys] for key, entry in result.items()} == snapshot


def test_numbers_of_the_card_agree_with_plain_formulas() -> None:
    """I of a shell and its field in SI; k = omega2 |B'|/B2, eq. (79); the needle's cone of a free body, eq. (87)."""
    shell = card(request_of(SHELL))
    assert shell["ratio"]["value"] == pytest.approx(1 / (1 / 2 + 0.9**2 / 12))
    assert shell["larmor"]["value"] == pytest.approx(2e-15 / 1.5e-15 * 0.8 / 2)
    assert shell["tilt"]["value"] == pytest.approx(pi / 6)
    steady = card(request_of("--ratio 0.4 --field 1 2 --omega2 0.7"))
    assert steady["turn"]["value"] == pytest.approx(2 * pi / (0.7 * sqrt(5)))
    result_free = card(request_of("--ratio 1.5 --omega 0.3 0.7 0.2"))
    assert result_free["turn"]["value"] == pytest.approx(2 * pi / hypot(0.3, 0.7, 1.5 * 0.2))
    assert result_free["spin"]["value"] == pytest.approx((1 - 1.5) * 0.2)
    toutatis = card(request_of("--inertia 1 3.0836 3.235 --omega -1.71914931 0.25307274 0.58817596"))  # rad a day
    assert [round(toutatis[key]["value"], 2) for key in ("nutation", "turn")] == [5.38, 7.40]
    assert toutatis["spin"]["says"] == "rate about the body's long axis"


def test_a_field_along_the_axes_of_the_laboratory_is_turned_into_the_body() -> None:
    """R(0) tilts the axis: its angle with the field is that of R(0) e3 with B'."""
    R = Rotation.from_quat([0.6, 0, 0, 0.8]).as_matrix()
    words = "--inertia 2 2 3 --attitude 0.6 0 0 0.8 --field 1 2 3 --omega 1 2 3"
    assert card(request_of(words))["tilt"]["value"] == pytest.approx(np.arccos(R[:, 2] @ (1, 2, 3) / sqrt(14)))


def test_a_turn_through_the_pole_is_marked_as_a_mean() -> None:
    """Its rate is the mean of the limits, of fields a little to one side and to the other."""
    turns = [card(request_of(f"--ratio 1.6 --field {x} 2 --omega 0.3 0.7 0.2"))["turn"] for x in ("1e-7", "0", "-1e-7")]
    before, turn_pole, after = (2 * pi / entry["value"] for entry in turns)
    assert turn_pole == pytest.approx(abs(before - after) / 2, rel=1e-5), (
        "before and after it goes round in opposite ways"
    )
    assert ["pole" in entry["says"] for entry in turns] == [False, True, False]
    for words in ("--ratio 1.6 --omega 0.3 0.7 0.2", "--ratio 1.6 --field 0 2 --spin 0.2"):
        assert "pole" not in card(request_of(words))["turn"]["says"]


@pytest.mark.parametrize("scale", ["1e-300", "1e300"])
def test_cards_of_tiny_and_huge_rates_agree_with_one(scale: str) -> None:
    """Rates are proportional to their unit, also where their squares are no doubles."""
    of_one, scaled = (card(request_of(f"--ratio 0.7 --field {x} {x} --omega2 {x}")) for x in ("1", scale))
    powers = {"ratio": 0, "tilt": 0, "larmor": 1, "spin": 1, "turn": -1, "nutation": -1}
    for key, power in powers.items():
        assert scaled[key]["value"] == pytest.approx(of_one[key]["value"] * float(scale) ** power, rel=1e-9)
        assert scaled[key]["proven_digits"] == of_one[key]["proven_digits"]


def test_a_negative_charge_turns_the_arrow_of_the_field() -> None:
    """A sentence says that B' points against B; other reports have none."""
    assert (
        "The charge is negative" in files_of(negative := request_of(CASES["negative disk"]))[f"{name_of(negative)}.md"]
    )
    for name in ("short in SI", "long on the curve", "free", "heavy top"):
        assert sign_of(request_of(CASES[name])) == ""


def test_an_error_without_a_deviation_is_reported() -> None:
    """Where errors of the inputs leave the domain, no number is called proven, and the last page says why."""
    request = replace(request_of(SHELL), sigma={"ratio": inf, "larmor": 0.1})
    result = card(request)
    assert (result["ratio"]["sigma"], result["ratio"]["proven_digits"]) == (None, 0)
    text = files_of(request)[f"{name_of(request)}.md"]
    assert f"{result['ratio']['value']:.10g}(?)" in text
    assert result["ratio"]["reason"] in text
    assert "0.53(10)" in text  # |B'| = mu B/2, with its standard deviation in the last digits


def test_every_card_has_the_same_keys_and_a_reason_for_each_gap() -> None:
    """A number that is not there has the value null and a reason, and one that is there has none."""
    cards = [card(request_of(words)) for words in CASES.values()]
    assert len({tuple(result) for result in cards}) == 1
    assert all((entry["value"] is None) == bool(entry["reason"]) for result in cards for entry in result.values())
    assert {json.dumps(sorted(entry)) for result in cards for entry in result.values()} == {
        json.dumps(sorted(cards[0]["turn"]))
    }


def test_equal_inputs_have_one_name() -> None:
    """1200nm is 1.2um; another body, start or error has another name."""
    request, same, request_other = (request_of(SHELL.replace("0.9um", text)) for text in ("1.2um", "1200nm", "1.3um"))
    assert name_of(request) == name_of(same) != name_of(request_other)
    assert name_of(replace(request, sigma={"ratio": 0.1})) != name_of(request)


@pytest.mark.parametrize(
    "name", ["negative disk", "at rest", "free", "heavy top", "asteroid", "no start", "point charge"]
)
def test_every_branch_of_the_prose_is_a_report(name: str, tmp_path: Path) -> None:
    """The report file loads, names its body, and its last page has a line for each number that is not there."""
    request = request_of(CASES[name])
    files = files_of(request)
    for file, content in files.items():
        (tmp_path / file).write_text(content, encoding="utf-8")
    report = load(tmp_path / f"{name_of(request)}.md")
    texts = "".join(getattr(block, "text", "") for block in report.pages[-1].blocks)
    headings = (
        "## Card",
        "## The body",
        "## The motion",
        "## The same numbers elsewhere",
        place := "## What is left out",
    )
    places_found = [texts.index(heading) for heading in headings if heading in texts]
    assert places_found == sorted(places_found)
    assert place in texts
    for entry in card(request).values():
        assert entry["reason"] in {None, ONE_PERIOD} or entry["reason"].lower() in texts[texts.index(place) :].lower()
    again = request_of(["--from", str(tmp_path / f"{name_of(request)}.inputs.toml")])
    assert files_of(again) == files


@pytest.mark.parametrize(
    ("words", "recipe", "is_drawn"),
    [
        ("--ratio 2 --field 0 1 --omega 0 0 0", "general_motion", False),
        ("--ratio 2 --field 1 1 --omega 0 0 0", "general_motion", False),
        ("--ratio 2 --field 1 1 --omega 0 0 1", "general_motion", True),
        ("--ratio 1.5 --field 0 0 --omega 0 0 1", "spectrum", False),
        ("--ratio 1.5 --field 0 0 --omega 1 0 0", "general_motion", True),
        ("--ratio 1.5 --field 0 0 --omega 1 0 0", "pseudo_oscillator", False),
        ("--ratio 1.5 --field 0 0 --omega 1 0 0", "quadric", False),
        ("--inertia 0.8 1 1.3 --omega 0 0 1", "asymmetric_motion", False),
        ("--inertia 0.8 1 1.3 --omega 0 1 0", "asymmetric_motion", True),
    ],
)
def test_figures_without_change_are_replaced_by_a_reason(words: str, recipe: str, is_drawn: bool) -> None:
    """A body at rest has no trace, a free one no quadric; the axis of a steady motion still goes round."""
    request = request_of(words)
    values = template_values(request, card(request))
    assert (f'recipe = "{recipe}"' in str(values["figures"])) == is_drawn
    assert is_drawn or any("constant" in line or "Quadric" in line for line in values["left_out"])


def test_a_free_spin_about_an_axis_has_the_rate_of_its_start() -> None:
    """No turn about the momentum: in the limit of small nutations it would take 2 pi/(I omega3)."""
    for words in ("--ratio 1.5 --field 0 0 --omega 0 0 0.5", "--inertia 0.8 1 1.3 --omega 0 0 0.5"):
        made = card(request_of(words))
        assert made["spin"]["value"] == 0.5
        assert made["turn"]["reason"] == "the axis does not go round"


def test_inputs_are_as_typed_and_as_evaluated() -> None:
    """The file of inputs has both, the defaults by name, and no time of day."""
    request = request_of(CASES["heavy top"])
    record = tomllib.loads(files_of(request)[f"{name_of(request)}.inputs.toml"])
    assert record["typed"][:4] == ["top", "--inertia", "1", "0.5"]
    assert record["evaluated"]["values"]["linear"] == 3.0
    assert record["defaults"] == ["coupling", "quadratic"]


@pytest.mark.parametrize(
    ("ratio", "words"),
    [(0.01, "needle"), (0.5, "longer"), (0.999, "nearly a ball"), (1.0, "a ball:"), (1.5, "flatter"), (2.0, "a disk")],
)
def test_a_ratio_has_a_place_between_needle_and_disk(ratio: float, words: str) -> None:
    """One function says where I stands."""
    assert words in shape_words(ratio)


@pytest.mark.parametrize("text", ["typed = 5", "x = 1", "[", ""])
def test_another_file_than_that_of_the_inputs_is_refused(text: str, tmp_path: Path) -> None:
    """It is named, in one line."""
    file = tmp_path / "other.toml"
    file.write_text(text, encoding="utf-8")
    with pytest.raises(AtlasError, match=r"--from takes a file NAME\.inputs\.toml that your_body wrote"):
        request_of(["--from", str(file)])


@pytest.mark.parametrize(
    ("words", "reason"),
    [
        ("", "your_body takes a body, a field and a start"),
        ("--from nosuch.toml", "--from takes a file NAME.inputs.toml that your_body wrote, not 'nosuch.toml'"),
        ("--shape thin-rod --length 1e-6 --field 1 2 --omega 1 2 3", "a thin rod has I3 = 0"),
        ("--each one.csv --against two.inputs.toml", "do not go together"),
        ("--ratio 1 --spin 1 --filed 1 2", "See `atlas report your_body --help`"),
        ("--title \a --ratio 0.7 --field 1 2", "--title is a text of one line"),
        ("--only card,moton --ratio 0.7 --field 1 2", "no part 'moton' of the report (did you mean 'motion'?)"),
        ("--ratio 3 --field 1 2 --omega2 1", "3"),
    ],
)
def test_a_body_without_a_report_is_refused_in_one_line(
    words: str, reason: str, tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Status 2, a line, no file."""
    monkeypatch.chdir(tmp_path)
    with pytest.raises(SystemExit) as end:
        main(["report", "your_body", *words.split()])
    assert end.value.code == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert reason in line
    assert not [*tmp_path.iterdir()]


@pytest.mark.parametrize(
    ("words", "says"),
    [
        ("--ratoi 0.7 --field 1 2 --omega2 x --digts 3", ["'--ratoi'. (Did you mean", "'--digts'", "'--omega2': 'x'"]),
        (
            "--ratio 3 --field 1x 2 --omega2 1 --digits 0",
            ["'--field': there is no unit 'x'", "'--digits': 0", "I3/I2 = 3.0"],
        ),
        ("--ratio 3 --magnetic 0.8T 0T --omega 1 2 3 --spin 2", ["I3/I2 = 3.0", "needs --mass and --charge", "twice"]),
        ("--shape disk --radius 1um --height 2um --mass 1 --magnetic 0.8T --angle x --spin 2", ["'--angle'", "disk"]),
        (
            "top --inertia 1 9 --direction 0 0 --omega 1 2 x --linear y",
            ["'--omega'", "'--linear'", "--direction: The", "I2 = 1.0, I3 = 9.0"],
        ),
        (
            "top --inertia 1 9 --heavy 9.8 1 --mass 1 --direction 0 0 --omega 1 2",
            ["--omega takes 3", "--direction: The", "I2 = 1.0, I3 = 9.0"],
        ),
        ("--inertia 1 2 9 --omega 1 2 --digits 0", ["--omega takes 3", "'--digits'", "9 exceeds 2 + 1 by 6"]),
        ("--tensor 1 2 9 0 0 0 --field 1 2 --spin 1", ["--field takes 3", "9 exceeds 2 + 1 by 6"]),
    ],
)
def test_all_faults_of_the_options_are_reported_at_once(words: str, says: list[str], tmp_path: Path) -> None:
    """A sentence for each option at fault and no other, also for words from a file, which is named."""
    with pytest.raises(FaultsError) as refused:
        request_of(words)
    assert [x in sentence for x, sentence in zip(says, refused.value.sentences, strict=True)] == [True] * len(says)
    file, typed = tmp_path / "one.inputs.toml", words.split()
    file.write_text("# words\ntyped = [\n" + ",\n".join(map(json.dumps, typed)) + "]", encoding="utf-8")
    with pytest.raises(FaultsError) as of_file:
        request_of([f"--from={file}", "--name", "other"])
    for said, one in zip(of_file.value.sentences, refused.value.sentences, strict=True):
        option = next((name for name in re.findall(r"--[\w-]+", one) if name in typed), "")
        line = typed.index(option) + 3 if option else 2
        assert said == f"{file}, line {line}: {one}"


@pytest.mark.slow
def test_a_report_is_built_whole(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Pages, PDF, card with errors and inputs; all figures are there, and the inputs build the same bytes."""
    words = "--inertia 1 0.5 --direction 0.6 0.8 --omega 0.1 0.2 5.0(1) --linear 3"
    with pytest.raises(SystemExit) as end:
        main(["report", "your_body", "top", *words.split(), "--out", str(tmp_path / "one")])
    assert end.value.code == 0
    index, pdf, numbers, inputs = map(Path, capsys.readouterr().out.split())
    page = html.parse(str(index)).getroot()
    assert len(page.findall(".//h1")) == 1
    assert "turns about the vertical once in" in page.text_content()
    result_high, less = (
        card(request_of(f"top {words}".replace("5.0(1)", x)))["spin"]["value"] for x in ("5.05", "4.95")
    )
    assert json.loads(numbers.read_text())["spin"]["sigma"] == pytest.approx(result_high - less, rel=1e-3)
    with pytest.raises(SystemExit):
        main(["report", "your_body", "--from", str(inputs), "--out", str(tmp_path / "two")])
    assert (tmp_path / "two" / pdf.name).read_bytes() == pdf.read_bytes()


@pytest.mark.parametrize(
    ("words", "says"),
    [
        ("--ratio 1.6 --field 0 2 --omega 0 0 -2.2", "unstable"),
        ("--ratio 1.6 --field 0 2 --omega 0 0 3", "stable"),
        ("--inertia 1 2 3 --omega 0 1 0", "unstable"),
        ("--inertia 1 2 3 --omega 0 0 1", "stable"),
        ("--ratio 0.7 --field 2 0 --omega 0 -1 0", "unstable"),
    ],
)
def test_a_steady_motion_says_whether_it_is_stable(words: str, says: str) -> None:
    """A disk near Larmor's turn, the middle axis, a start in the unstable band; and their stable neighbours."""
    assert f", {says} against small nutations" in verdict(object_of(request_of(words)))


def test_a_spin_is_stable_where_no_eigenvalue_grows() -> None:
    """The verdict on a spin about a principal axis is that of eigenvalues of the equations, by differences."""
    rng, verdicts = np.random.default_rng(5), list[bool]()
    for _ in range(100):
        moments, axis = 1 + rng.random(3), int(rng.integers(3))
        field, omega = np.zeros(3), np.zeros(3)
        field[axis], omega[axis] = rng.uniform(-2, 2) * (rng.random() < 0.8), rng.uniform(-3, 3)

        def changes(state: np.ndarray, moments: np.ndarray = moments) -> np.ndarray:
            W, K = state[:3], state[3:]
            torque: np.ndarray = np.cross(moments * W, W) - np.cross(moments * K, K)
            return np.concatenate([torque / moments, np.cross(K, W)])

        spin, indices = np.r_[omega + field, field], [i for i in range(6) if i % 3 != axis]
        if not field.any():
            indices = indices[:2]
        pushes = 1e-5 * np.eye(6)[indices]
        linear = np.array([changes(spin + p)[indices] - changes(spin - p)[indices] for p in pushes]).T / 2e-5
        grows = bool(max(np.linalg.eigvals(linear).real) > 1e-6)
        verdicts.append(not grows)
        assert spins_on(*([Fraction(float(x)) for x in v] for v in (moments, field, omega))) is not grows
    assert {*verdicts} == {True, False}


def test_magnetism_at_the_stated_susceptibility_equals_the_charge() -> None:
    """The susceptibility told makes the energy of a spheroid that of its charge, to first order in chi."""
    body = Spinning("spheroid", {"equatorial": 1e-6, "polar": 2e-6}, 1e-14, 0.1, (2e-26, 8e-27), 0.5, 0.0, 0.01)
    chi = next(disturbances(body)).value
    energy = anisotropy(chi, 4 / 3 * pi * 2e-18, demagnetization(2.0)) * 0.5**2
    assert abs(energy) == pytest.approx(body.potential, rel=1e-3)


def test_an_unstable_precession_has_the_same_turn_by_all_three_rates() -> None:
    """The start (0, omega2, omega3) on the curve is that of omega2 alone, also where there is no period."""
    body = ["--ratio", "0.5", "--field", "1", "0.125"]
    by_all, by_one = (
        card(request_of([*body, *start])) for start in (["--omega", "0", "-0.5", "-0.25"], ["--omega2", "-0.5"])
    )
    assert by_one["turn"]["proven_digits"] == 10
    assert all(by_all[key]["digits"] == by_one[key]["digits"] for key in ("turn", "spin"))


def test_an_explorer_starts_from_the_body_in_its_field() -> None:
    """Fails where its values are written as its text, so that it shows another field and its own source."""
    words = "--shape disk --radius 5um --mass 3e-13kg --charge 2.2e-13C --magnetic 0.9 1.6 --omega 0.2 -0.5 0.35"
    (block,) = explorer_of(words_to_request(words.split())[0], [])
    pages = read(f"+++\nname = 'mine'\n+++\n\n# A page\n\n{fenced(block)}")[0]["pages"]
    assert pages[0]["blocks"] == [block]
    assert hypot(*block["at"]) == pytest.approx(1)
    assert block["at"][1] / block["at"][0] == pytest.approx(1.6 / 0.9)
