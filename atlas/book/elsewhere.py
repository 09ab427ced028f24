"""The numbers of a report elsewhere: at the shell, in Python, and in reports of neighbouring objects."""

import inspect
import shlex
from collections.abc import Iterator
from decimal import Decimal
from fractions import Fraction
from typing import Any

from atlas.book.digits import plain
from atlas.book.parts import ReportRequest, case_of
from atlas.errors import DomainError


def neighbours(request: ReportRequest) -> Iterator[tuple[str, ReportRequest]]:
    """Yield (words in Markdown, request) for neighbouring objects: other starts, other bodies, all motions of the body.

    Nothing is yielded without a body.
    """
    values, name = request.values, request.family.name
    if not request.body:
        return
    B2, B3 = case_of(request).components
    if "omega2" in values:
        w2 = values["omega2"]
        without_third = {"omega3": None} if "omega3" in values else {}
        starts = {
            r"the pair $-2\mathbf{B}'-\boldsymbol\omega$, @theorem-pair": opposite(B2, w2),
            "at rest": 0.0,
            r"$\phi=0$: it turns as a whole": -2 * B2,
        }
        for words, omega2 in starts.items():
            if B2 and omega2 not in {w2, -B2}:
                yield words, request.changed(name, omega2=omega2, **without_third)
    if "omega" in values:
        w1, w2, w3 = values["omega"]
        pair = (-w1, opposite(B2, w2), opposite(B3, w3))
        yield r"the pair $-2\mathbf{B}'-\boldsymbol\omega$, @theorem-pair", request.changed(name, omega=pair, spin=None)
        if B2 and w2 != -B2:
            steady = request.changed("elementary", omega2=w2, omega=None, spin=None)
            yield r"the motion without nutation with this $\omega_2$", steady
    yield from _of_other_bodies(request)
    if request.family.sampled:
        yield (
            "all motions of this body in this field",
            request.changed("quadric", omega2=None, omega3=None, omega=None, spin=None),
        )


def opposite(B: float, omega: float) -> float:
    """Return -2 B - omega, a component of the angular velocity of the paired start, theorem-pair, in the unit of both.

    `B` and `omega` are the components of B' and of the angular velocity along one axis. The result is computed from the
    shortest decimals of both and rounded to 15 digits.
    """
    return float(f"{-2 * Decimal(repr(float(B))) - Decimal(repr(float(omega))):.15g}")


def _of_other_bodies(request: ReportRequest) -> Iterator[tuple[str, ReportRequest]]:
    """Yield (words, request) of the same motion for a sphere (I = 1) and for a disk or loop (I = 2), unless it is one.

    Nothing is yielded for a body of point masses.
    """
    ratio = case_of(request).ratio
    shape: dict[str, Any] = dict.fromkeys(("inertia", "shape", "points", "radius", "height", "equatorial", "polar"))
    if request.body and "density" in request.options:
        shape |= {"density": None, "mass": request.body["mass"]}
    for border, words in ((1.0, "the same in a ball, $I=1$"), (2.0, "the same in a disk or loop, $I=2$")):
        if ratio != border and "points" not in request.options:
            yield words, request.changed(request.family.name, **shape, ratio=border)


def reproduced(request: ReportRequest, motion: Any) -> tuple[str, list[str]]:
    """Return the shell command, and the lines of Python, that print the numbers of this motion."""
    family = request.family
    kernels = family.kernels()
    values = zip(
        inspect.signature(kernels).parameters, (_python(request, p.name) for p in family.parameters), strict=True
    )
    arguments = ", ".join(f"{name}={value}" for name, value in values if value)
    lines = ["import atlas", "", f"it = atlas.{kernels.__name__}({arguments})"]
    lines += [f"print(it.{q.name})" for q in family.quantities if _is_printed(q, motion)]
    command = family.command.name if family.command else family.name
    digits = [] if request.deviations else ["--digits", str(request.digits)]
    return shlex.join(["atlas", command, *request.option_words, *digits]), lines


def _is_printed(quantity: Any, motion: Any) -> bool:
    """Return whether a quantity of the register is a readable attribute of the motion with digits to print.

    False for a quantity with a getter of its own, and where reading raises DomainError.
    """
    if quantity.get or not (quantity.certified or quantity.printed):
        return False
    try:
        getattr(motion, quantity.name)
    except DomainError:
        return False
    return True


def _python(request: ReportRequest, name: str) -> str:
    """Return the parameter `name` as Python source, such as "atlas.SymmetricBody(1.0, 1.5)"; "" if it is left out."""
    body, field = request.body or {}, request.field or {}
    if name == "ratio":
        if "shape" in body:
            sizes = ", ".join(f"{key}={plain(body[key])}" for key in body if key not in {"title", "shape", "charge"})
            return f"atlas.SymmetricBody.{body['shape']}({sizes})"
        return (
            plain(body["ratio"])
            if "ratio" in body
            else f"atlas.SymmetricBody{tuple(float(Fraction(x)) for x in body['inertia'])}"
        )
    if name == "field" and field:
        if "prime" in field:
            return str(tuple(float(Fraction(x)) for x in field["prime"]))
        mu = field.get("charge_to_mass", 0.0)
        mu = float(Fraction(mu)) if mu else f"{body['charge']!r} / {body['mass']!r}"
        return f"atlas.Field.{field['system'].lower()}(B={tuple(field['B'])}, mu={mu}).pair"
    value = request.values.get(name)
    return "" if value is None else repr(tuple(value) if isinstance(value, list | tuple) else value)
