"""The report of a fit: parameters with errors, undetermined ones, residuals, the motion, and how to repeat it."""

import re
import shlex
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from hashlib import sha256
from pathlib import PurePath
from pprint import pformat
from typing import Any

import numpy as np

from atlas.book.digits import MINUS
from atlas.book.markdown import written
from atlas.book.parts import Asked, figures_of, headed

MAX_NAME_LENGTH = 48
"""Largest length of the name of a page; longer names end with a digest."""

MIN_CORRELATION = 0.5
"""Correlations that are told."""

AHEAD = {1: "that of a measurement", 10: "ten times that of a measurement"}
"""Errors of a prediction, in those of a measurement, for which it is said how long it is that good."""

NBSP = "\N{NO-BREAK SPACE}"

MEANINGS = {
    "ratio": (r"$I_3/I_2$", ""), "I1": (r"$I_1/I_2$", ""), "I3": (r"$I_3/I_2$", ""),
    "B": (r"the field $\mathbf{B}'$ in the laboratory", "1/time"), "b": (r"$|\mathbf{B}'|$", "1/time"),
    "omega": (r"$\boldsymbol\Omega$ in the body at the epoch", "1/time"),
    "a": ("attitude at the epoch, a rotation vector", "rad"), "n": ("direction of the field", ""),
    "k": ("coupling to the field, over $I_2$", "1/time"),
    "linear": (r"linear part of the potential, over $I_2$", "1/time^2^"),
    "quadratic": (r"quadratic part of the potential, over $I_2$", "1/time^2^"), "z": ("the elliptic motion", ""),
    "branch": ("sign of $v$", ""),
}  # fmt: skip
"""Meaning and unit of parameters, by their names with or without the number; moments are in units of I2."""


ENDS = {float("inf"): "any time", -float("inf"): "nowhere"}
"""Words for a horizon without an end, or without a beginning."""


@dataclass(frozen=True)
class Fitted:
    """A page of a fit.

    fit       an `atlas.fit`, of the data in `file`, a path from the folder of the page; `digest` that of its content
    options   the options of the command that makes the page, each with the typed words, by name
    given     arguments of `fit_file` by which it is made, from values that were found before
    motion    request of a page of the fitted motion
    ahead     lines on the predictions that were asked for
    """

    fit: Any
    file: str
    digest: str
    options: Mapping[str, tuple[str, ...]]
    given: Mapping[str, Any]
    motion: Asked
    ahead: tuple[str, ...] = ()
    title: str = ""
    called: str = ""

    @property
    def words(self) -> list[str]:
        """Options of the command, as typed words."""
        return [word for name, texts in self.options.items() for word in (f"--{name}", *texts)]

    @property
    def command(self) -> str:
        """The command that makes the page."""
        return shlex.join(["atlas", "page", *self.words, *(["--name", self.called] if self.called else [])])

    @property
    def name(self) -> str:
        """Name of its files, from the typed words, with a digest if it is long."""
        words = ["fit", PurePath(self.words[1]).stem, *self.words[2:]]
        name = "-".join(re.sub(r"[^\w.+-]+", "_", word.removeprefix("--"), flags=re.ASCII) for word in words)
        short = f"{name[:MAX_NAME_LENGTH]}-{sha256(name.encode()).hexdigest()[:8]}"
        return self.called or (name if len(name) <= MAX_NAME_LENGTH else short)

    @property
    def _file(self) -> str:
        """Name of the data file, without characters of Markdown."""
        return re.sub(r"[^\w. +-]", "_", PurePath(self.words[1]).name)

    def sources(self) -> dict[str, str]:
        """Return the texts of the report file and of its picture's recipe, by file name."""
        return {
            f"{self.name}.md": headed(self.name, written(self.definition()), self.command),
            f"{self.name}.py": headed(self.name, self._recipe(), self.command),
        }

    def definition(self) -> dict[str, Any]:
        """Return the report as a dict of values for its file."""
        left_out, motion = list[str](), self.motion
        blocks = [
            _prose(self._verdict()),
            self._parameters(),
            {"kind": "figure", "recipe": f"./{self.name}.py", "id": "data"},
            *self._correlations(),
            *([] if self.fit.warnings else [self._horizons()]),
            *([_prose("What was asked of the time to come:", "", "```", *self.ahead, "```")] if self.ahead else []),
            *self._motion(left_out),
            _prose(
                "## The same again", "", "This page, and its numbers with all covariances:", "", "```console",
                f"$ {self.command}", f"$ {shlex.join(['atlas', 'fit', *self.words[1:], '--json'])}", "```",
            ),
            *([_prose("\n- ".join(["## Left out\n", *left_out]))] if left_out else []),
        ]  # fmt: skip
        records = (("bodies", "body", motion.body), ("fields", "field", motion.field))
        return {
            "name": self.name,
            "title": self.title or f"The motion in {self._file}",
            "subtitle": f"{self.fit.family} motion, {self.fit.t.size} times of {self.fit.kind.replace('_', ' ')}",
            "abstract": "Errors are standard errors, of first order. The numbers of a fit are estimates: no digit is "
            f"proven. Times are in {'s' if self.fit.time_unit == 's' else 'the unit of the file'}, moments of inertia "
            "in that of $I_2$.",
            "parameters": {kind: {name: record} for kind, name, record in records if record},
            "pages": [{"slug": "index", "title": "Fit", "blocks": blocks}],
        }  # fmt: skip

    def _verdict(self) -> str:
        """Return sentences on the quality of the fit, on undetermined parameters, and the warnings."""
        fit = self.fit
        expected = f"where 1 ± {(2 / fit.nfree) ** 0.5:.2g} is expected"
        lines = [
            f"The reduced chi square is {fit.redchi:.4g}, {expected}. The standard error of a measurement was given, "
            f"{fit.noise}."
            if fit.known
            else f"The standard error of a measurement, which makes the reduced chi square 1, is {fit.noise}."
        ]
        lines += [] if fit.warnings else ["Nothing in the residuals speaks against this motion."]
        for head, sentences in (
            ("What speaks against this motion:", fit.warnings),
            ("What the data do not determine:", fit.undetermined),
            ("Alternatives:", fit.others),
            ("Left out of the file:", fit.notes),
        ):
            lines += ["", head, "", *(f"- {_marked(sentence)}" for sentence in sentences)] if sentences else []
        return "\n".join(lines)

    def _parameters(self) -> dict[str, Any]:
        rows = []
        for name, value, error, note in self.fit.rows()[1]:
            meaning, unit = MEANINGS.get(name) or MEANINGS[name.rstrip("123")]
            number = (
                f"{value}{NBSP}±{NBSP}{error}"
                if error != "-"
                else f"{value}, fixed"
                if note == "fixed"
                else "not determined"
            )
            rows.append([f"`{name}`", meaning, number.replace("-", MINUS), unit.replace("time", self.fit.time_unit)])
        return {
            "kind": "listing", "id": "parameters", "rows": rows, "columns": ["Name", "What it is", "Value", "Unit"],
            "caption": f"Parameters at the time {self.fit.epoch:g}, with their standard errors.",
        }  # fmt: skip

    def _correlations(self) -> Iterator[dict[str, Any]]:
        """Yield the block of strong correlations, or a sentence that there are none."""
        pairs = {
            frozenset((name, partner)): size
            for name, p in self.fit.parameters.items()
            for partner, size in (p.correl or {}).items()
            if abs(size) >= MIN_CORRELATION
        }
        if pairs:
            rows = [
                [", ".join(f"`{name}`" for name in self.fit.names if name in pair), f"{size:.3f}".replace("-", MINUS)]
                for pair, size in sorted(pairs.items(), key=lambda item: -abs(item[1]))
            ]
            yield {
                "kind": "listing", "id": "correlations", "columns": ["Parameters", "Correlation"], "rows": rows,
                "caption": f"Correlations of errors, from {MIN_CORRELATION:g} on: what one gains the other one pays.",
            }  # fmt: skip

    def _horizons(self) -> dict[str, Any]:
        """Return the table of times up to which predictions are good."""
        fit = self.fit
        unit, size = " rad" * (fit.kind in ("rotation", "axis")), float(np.max(fit.sigma))
        rows = [
            [f"{factor * size:.3g}{unit}", words, ENDS.get(until, f"{until:.6g}")]
            for factor, words in AHEAD.items()
            for until in [fit.horizon(factor * size)]
        ]
        return {
            "kind": "listing", "id": "horizon", "rows": rows, "columns": ["Error", "", "Until"],
            "caption": "How far ahead a prediction of what was measured is good: the time until which its largest "
            f"standard error is smaller. The data end at {fit.t.max():.6g}.",
        }  # fmt: skip

    def _motion(self, left_out: list[str]) -> Iterator[dict[str, Any]]:
        """Yield the blocks of the motion's figures, below the command of its own report."""
        command = self.motion.command
        yield _prose("## The motion", "", f"With these values and R(0) = 1; `{command}` makes its own report.")
        yield from figures_of(self.motion, {key: dict[str, Any]() for key in self.motion.family.figures}, left_out)

    def _recipe(self) -> str:
        """Return the recipe that draws data, curve and residuals."""
        return "\n".join(
            [
                f'"""Data, fitted motion and residuals, of data with the digest {self.digest}."""', "",
                "from pathlib import Path", "", "from atlas.fitting import fit_file", "",
                f"FILE = Path(__file__).parent / {self.file!r}",
                f"OPTIONS = {pformat(dict(self.given), sort_dicts=False)}", "", "",
                "def scene():", '    """Fit again, from what was found, and draw."""',
                "    return fit_file(FILE, **OPTIONS).scene()", "",
            ]
        )  # fmt: skip


def _marked(sentence: str) -> str:
    """Return a sentence for the terminal as Markdown."""
    return re.sub(r"(--\w+)", r"`\1`", sentence).replace("+-", "±")


def _prose(*lines: str) -> dict[str, Any]:
    return {"kind": "prose", "text": "\n".join(lines)}
