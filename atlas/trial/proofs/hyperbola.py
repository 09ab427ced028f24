"""Section V, first half, on trial: motions with a constant Omega3, (58) to (72)."""

import sympy

from atlas.trial.proofs.model import Model, Value, cross, require, turn
from atlas.trial.proofs.notation import conserved, sides
from atlas.trial.proofs.pseudo_oscillator import I2, I3, mass, ratio, tensor
from atlas.trial.proofs.quadric import (
    AXES,
    B2,
    B3,
    LETTERS,
    I,
    at_start,
    canonical_model,
    cd,
    condition_model,
    constant_omega3,
    free_model,
    omega1,
    omega2,
    omega3,
    sd,
)
from atlas.trial.proofs.quadric import SIGNS as QUADRIC_SIGNS
from atlas.trial.proofs.quadric import p as tangent
from atlas.trial.proofs.trial import Part, Trial, read

Omega1, Omega2, K1, K2 = sympy.symbols("Omega1 Omega2 K1 K2", real=True)
SIGNS = (
    QUADRIC_SIGNS | {rf"\dot\Omega_{n}": f"dOmega{n}" for n in (1, 2, 3)} | {rf"\dot K_{n}": f"dK{n}" for n in (1, 2)}
)
kappa, p, s = sympy.symbols("kappa p s", real=True)
_STATE = {"Omega1": Omega1, "Omega2": Omega2, "K1": K1, "K2": K2, "I": ratio, "B2": B2, "B3": B3}
_STATE |= {"omega1": omega1, "omega2": omega2, "omega3": omega3, "Bp": sympy.Matrix([0, B2, B3])}


def _rates() -> tuple[Value, Value]:
    """Return (dOmega/dt, dK/dt), (3, 1) each, by (34), (35) at Omega3 = omega3 and K3 = c3 - omega3 = B3."""
    Omega, K = sympy.Matrix([Omega1, Omega2, omega3]), sympy.Matrix([K1, K2, B3])
    return tensor.inv() * (cross(tensor * Omega, Omega) - 2 * cross(mass * K, Omega)), -cross(Omega, K)


def constant_model() -> Model:
    """Return the model of any Omega1, Omega2, K1, K2 with Omega3 = omega3 and K3 = B3 by (40), for (58) to (60).

    dOmega and dK are the rates (3, 1) by (34), (35).
    """
    dOmega, dK = _rates()
    letters = {"dOmega": dOmega, "dK": dK}
    letters |= {"K3": (omega3 + B3) - omega3, "Omega": sympy.Matrix([Omega1, Omega2, omega3])}
    start = {Omega1: omega1, Omega2: omega2}
    return Model({**_STATE, **letters}, flow={omega3: sympy.Integer(0)}, start=start)


def proportional_model() -> Model:
    """Return the model of (61): (Omega1, Omega2) = s l and (K1, K2) = kappa l along a vector l; s, kappa may be 0."""
    dOmega, dK = _rates()
    flow = {Omega1: dOmega[0], Omega2: dOmega[1], K1: dK[0], K2: dK[1]}
    start = {Omega1: omega1, Omega2: omega2, K1: sympy.Integer(0), K2: B2}
    line = (sympy.Symbol("along1", real=True), sympy.Symbol("along2", real=True))
    bindings = [
        (factor, size * way)
        for pair, size in (((Omega1, Omega2), s), ((K1, K2), kappa))
        for factor, way in zip(pair, line, strict=True)
    ]
    return Model(_STATE, bindings, flow, start, laws="Omega by (34), K by (35)")


def circle_model() -> Model:
    """Return the model of (62): (Omega1, Omega2) is any rotation of (omega1, omega2), and K along it as in (61)."""
    cosine, sine = turn(p)
    bindings = [(Omega1, cosine * omega1 + sine * omega2), (Omega2, cosine * omega2 - sine * omega1)]
    bindings += [(B2, kappa * (omega1**2 + omega2**2) / omega2), (K1, kappa * Omega1), (K2, kappa * Omega2)]
    return Model(_STATE, bindings)


def precession_model() -> Model:
    """Return the model of (63), (64), with K of (62): `phip` by the Euler equations (34), `phi` by the rate (35).

    Both are angular velocities of the vector (Omega1, Omega2) in the body; nu1, nu2 are its rates by (35).
    """
    factor = omega2 * B2 / (omega1**2 + omega2**2)
    swap = {K1: factor * Omega1, K2: factor * Omega2}
    euler, field = (rates.xreplace(swap) for rates in _rates())
    letters = {"dOmega1": euler[0], "dOmega2": euler[1], "nu1": field[0] / factor, "nu2": field[1] / factor}
    letters |= {"phip": sympy.cancel(euler[0] / Omega2), "phi": sympy.cancel(field[0] / factor / Omega2)}
    return Model({**_STATE, **letters})


def agreement_model() -> Model:
    """Return the model of (65): omega3 has the value for which phip and phi of `precession_model` are equal."""
    letters = precession_model().letters
    condition = sympy.Poly(sympy.numer(sympy.together((letters["phip"] - letters["phi"]).subs(I3, I * I2))), omega3)
    slope, remainder = condition.all_coeffs()
    return Model(LETTERS, [(omega3, sympy.cancel(-remainder / slope))])


def motion_model() -> tuple[Model, Model]:
    """Return two models of (67), omega1 = 0: omega3 by (66), and the line omega2 = -B2 with I = 1 and any omega3."""
    zero = (omega1, sympy.Integer(0))
    ball = [zero, (omega2, -B2), (I, sympy.Integer(1))]
    return Model(LETTERS, [(omega3, constant_omega3()), zero]), Model(LETTERS, ball)


def both_conditions_model() -> tuple[Model, Model]:
    """Return two models that hold all solutions of (65) and (66): omega1 = 0 with (66), and omega3 = 0 on a circle.

    The circle is omega1^2 + omega2^2 + (2 - I) B2 omega2 = 0. Raises ArithmeticError unless the difference of both
    conditions is a multiple of omega1^2 omega3.
    """
    square = omega1**2 + omega2**2
    difference = I * B2**2 * omega3 - I * B2**2 * omega2**2 * omega3 / square
    require(sympy.cancel(difference - I * B2**2 * omega3 * omega1**2 / square) == 0)
    circle = [(omega3, sympy.Integer(0)), (omega2, -(2 - I) * B2 / (1 + s**2)), (omega1, s * omega2)]
    return Model(LETTERS, [(omega3, constant_omega3()), (omega1, sympy.Integer(0))]), Model(LETTERS, circle)


def degenerate_model() -> list[Model]:
    """Return two models of (70), of sign 1 and -1, of the lines to which the hyperbola degenerates for I = 1.

    The lines are omega2 = -B2 with any omega3, and omega3 of (66).
    """
    basis = canonical_model("one", plane=True)
    root = sympy.Symbol("root", positive=True)
    slope = sd / cd  # a2/a3 of this line, since a2^2/a3^2 = (1 + sin(beta))/(1 - sin(beta)) = tan(beta/2 + pi/4)^2

    def square_root(value: Value) -> Value:
        """Return the root of a3, or of (a2/a3)^2 a3, as a multiple of the letter `root`, else SymPy's root."""
        for factor in (sympy.Integer(1), slope):
            quotient = value / (factor**2 * basis.letters["a3"])
            if sympy.cancel(quotient.subs({cd: turn(tangent)[0], sd: turn(tangent)[1]})) == 1:
                return factor * root
        return sympy.sqrt(value)

    lines = []
    for sign, entry in ((1, (omega2, -B2)), (-1, (omega3, constant_omega3()))):
        bindings = [entry, *(pair for pair in basis.bindings if pair[0] not in {omega2, omega3})]
        bindings.append((root, sympy.sqrt(basis.letters["a3"])))
        letters = {**basis.letters, "sign": sympy.Integer(sign), "sqrt": square_root}
        lines.append(Model(letters, bindings, phases=basis.phases, domains=basis.domains))
    return lines


def frequency_model() -> Model:
    """Return the model of (72): phi, the rate Phi' of (63) at omega1 = 0, on the hyperbola (66)."""
    phi = precession_model().letters["phip"].subs(I3, I * I2)
    bindings = [(omega3, constant_omega3()), (omega1, sympy.Integer(0))]
    return Model({**LETTERS, "phi": phi}, bindings)


_EQUATION_67, _EQUATION_71 = read("(67)", SIGNS), read("(71)", SIGNS)


TRIALS = {
    "(58)": Trial(
        model=constant_model,
        also=("d(omega3) = 0",),
        signs={r"\omega_3=\text{const}": "omega3", r"\Omega_3": "Omega3"},
        definition=True,
    ),
    "(59)": Trial(model=constant_model, signs={r"\Omega_1K_2-\Omega_2K_1=0": "dOmega3 = Omega1*K2 - Omega2*K1"}),
    "(60)": Trial(model=constant_model),
    "(61)": Trial(model=proportional_model, form=conserved),
    "(62)": Trial(model=circle_model),
    "(63)": Trial(model=precession_model, defines=("phip",), corrected_defines=()),
    "(64)": Trial(
        model=precession_model,
        signs={r"\dot\Omega_1": "nu1", r"\dot\Omega_2": "nu2"},
        defines=("phi",),
        corrected_defines=(),
    ),
    "(65)": Trial(model=agreement_model),
    "(66)": Trial(model=condition_model),
    "(67)": Trial(model=motion_model),
    "text-combining": Trial(
        model=both_conditions_model,
        signs={r"\text{(65), (66)}\implies": ""},
        corrected_signs={
            r"\omega_1=0\quad\text{or}\quad\omega_3=0,\ \omega_1^2+\omega_2^2+(2-I)B'_2\omega_2=0": (
                "omega1*omega3 = 0; omega1*(omega1^2 + omega2^2 + (2 - I)*B2*omega2) = 0"
            )
        },
    ),
    "(68)": Trial(model=lambda: canonical_model("above", plane=True), defines=AXES),
    "(69)": Trial(model=lambda: canonical_model("below", plane=True), defines=AXES),
    "(70)": Trial(model=degenerate_model, defines=("a2", "a3")),
    "(71)": Trial(
        model=lambda: motion_model()[0],
        corrected_also=(
            Part(line=f"omega2 = -B2; I = 1; {_EQUATION_67}", model=lambda: motion_model()[1]),
            Part(
                line=f"{sides(_EQUATION_67)[0]} = I*B2*(omega2 + B2)*({sides(_EQUATION_71)[-1]} - omega3)",
                model=free_model,
            ),
            Part(
                line="(1 - I)*B2^2*B3 = -condition",
                model=lambda: Model(
                    {**LETTERS, "condition": at_start(omega3)}, [(omega2, -B2), (omega1, sympy.Integer(0))]
                ),
            ),
        ),
        corrected_signs={r"\text{or}\quad\omega_2=-B'_2,\quad\omega_3\in\mathbb{R}\quad\text{if}\quad I=1": ""},
    ),
    "(72)": Trial(model=frequency_model),
}
