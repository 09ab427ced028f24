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
from atlas.book.markdown import fenced
from atlas.book.parts import ReportRequest, figures_of, headed, records_of, templated
from atlas.places import folder

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
    arguments arguments of `fit_file` that repeat the fit from the values found before, by name
    motion    request of a page of the fitted motion
    ahead     lines on the predictions that were asked for
    title, file_name title and file name that were asked for, or ""
    """

    fit: Any
    file: str
    digest: str
    options: Mapping[str, tuple[str, ...]]
    arguments: Mapping[str, Any]
    motion: ReportRequest
    ahead: tuple[str, ...] = ()
    title: str = ""
    file_name: str = ""

    @property
    def words(self) -> list[str]:
        """Options of the command as a list of words, as they were typed."""
        return [word for name, texts in self.options.items() for word in (f"--{name}", *texts)]

    @property
    def command(self) -> str:
        """The shell command that makes the page, "atlas page --fit ...", quoted."""
        return shlex.join(["atlas", "page", *self.words, *(["--name", self.file_name] if self.file_name else [])])

    @property
    def name(self) -> str:
        """Name of the page's files: the given name, else "fit-" and the typed words, cut and with a digest if long."""
        words = ["fit", PurePath(self.words[1]).stem, *self.words[2:]]
        name = "-".join(re.sub(r"[^\w.+-]+", "_", word.removeprefix("--"), flags=re.ASCII) for word in words)
        short = f"{name[:MAX_NAME_LENGTH]}-{sha256(name.encode()).hexdigest()[:8]}"
        return self.file_name or (name if len(name) <= MAX_NAME_LENGTH else short)

    @property
    def _file(self) -> str:
        """Name of the data file, without folders; characters that Markdown would read are replaced by _."""
        return re.sub(r"[^\w. +-]", "_", PurePath(self.words[1]).name)

    def sources(self) -> dict[str, str]:
        """Return the texts of the report file NAME.md and of its picture's recipe NAME.py, by file name.

        NAME is the page's `name`; nothing is written.
        """
        return {
            f"{self.name}.md": templated(self.name, "fit.md", self.head(), self.values(), self.command),
            f"{self.name}.py": headed(self.name, self._recipe(), self.command),
        }

    def head(self) -> dict[str, Any]:
        """Return the keys of the report's head by name: title, subtitle, and the records of body and field."""
        return {
            "title": self.title or f"The motion in {self._file}",
            "subtitle": f"{self.fit.family} motion, {self.fit.t.size} times of {self.fit.kind.replace('_', ' ')}",
        } | records_of(self.motion)

    def values(self) -> dict[str, Any]:
        """Return the values that the template sees, by name: words, rows of tables, and figures in their fences."""
        fit, left_out, recipes = self.fit, list[str](), {name: dict[str, Any]() for name in self.motion.family.figures}
        remarks = (
            ("What speaks against this motion:", fit.warnings), ("What the data do not determine:", fit.undetermined),
            ("Alternatives:", fit.others), ("Left out of the file:", fit.notes),
        )  # fmt: skip
        return {
            "name": self.name, "unit": "s" if fit.time_unit == "s" else "the unit of the file",
            "quality": self._quality(), "remarks": [(head, [*map(_marked, lines)]) for head, lines in remarks],
            "parameters": self._parameters(), "epoch": f"{fit.epoch:g}", "correlations": [*self._correlations()],
            "least": f"{MIN_CORRELATION:g}", "horizons": [] if fit.warnings else self._horizons(),
            "end": f"{fit.t.max():.6g}", "ahead": self.ahead, "report": self.motion.command, "command": self.command,
            "figures": [*map(fenced, figures_of(self.motion, recipes, left_out))], "left_out": left_out,
            "numbers": shlex.join(["atlas", "fit", *self.words[1:], "--json"]),
        }  # fmt: skip

    def _quality(self) -> str:
        """Return sentences on reduced chi square and the standard error of a measurement, as one text.

        Without warnings a second line says that nothing in the residuals speaks against the motion.
        """
        fit = self.fit
        expected = f"where 1 ± {(2 / fit.nfree) ** 0.5:.2g} is expected"
        says = (
            f"The reduced chi square is {fit.redchi:.4g}, {expected}. The standard error of a measurement was given, "
            f"{fit.noise}."
            if fit.known
            else f"The standard error of a measurement, which makes the reduced chi square 1, is {fit.noise}."
        )
        return says if fit.warnings else f"{says}\nNothing in the residuals speaks against this motion."

    def _parameters(self) -> list[list[str]]:
        """Return four texts for each parameter: name, meaning, value with its standard error or a remark, unit."""
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
        return rows

    def _correlations(self) -> Iterator[list[str]]:
        """Yield [names, correlation] as texts for pairs of parameters correlated by 0.5 or more, strongest first."""
        pairs = {
            frozenset((name, partner)): size
            for name, p in self.fit.parameters.items()
            for partner, size in (p.correl or {}).items()
            if abs(size) >= MIN_CORRELATION
        }
        for pair, size in sorted(pairs.items(), key=lambda item: -abs(item[1])):
            yield [", ".join(f"`{name}`" for name in self.fit.names if name in pair), f"{size:.3f}".replace("-", MINUS)]

    def _horizons(self) -> list[list[str]]:
        """Return rows of three texts: an error of a prediction, its meaning, the time until which errors are smaller.

        The time is in the file's unit, "any time" without an end, "nowhere" where the error is larger from the start.
        """
        fit = self.fit
        unit, size = " rad" * (fit.kind in ("rotation", "axis")), float(np.max(fit.sigma))
        return [
            [f"{factor * size:.3g}{unit}", words, ENDS.get(until, f"{until:.6g}")]
            for factor, words in AHEAD.items()
            for until in [fit.horizon(factor * size)]
        ]

    def _recipe(self) -> str:
        """Return the Python source of a recipe that fits the data again and draws data, curve and residuals."""
        options = pformat(dict(self.arguments), sort_dicts=False)
        source = (folder("templates") / "report" / "fit.py.txt").read_text(encoding="utf-8")
        return source.format(digest=self.digest, file=self.file, options=options)


def _marked(sentence: str) -> str:
    """Return a sentence of the terminal as Markdown: options as code, and ± for +-."""
    return re.sub(r"(--\w+)", r"`\1`", sentence).replace("+-", "±")
