"""The two commuting flows of a body with three moments by SciPy's DOP853, for figures: a peer, never the answer.

Along a H + g F/2, theorem-lie-poisson and theorem-involution, with M = II W and V = (a + g II) W,

    M' = [M, a W + g M] + [K, a II K - g D II^-1 K],     K' = [K, V].
"""

import numpy as np

from atlas.core.inputs import FloatArray

TOLERANCE = 1e-11


def flow(
    inertia: FloatArray, W: FloatArray, K: FloatArray, a: float, g: float, times: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Return W and K, shape (N, 3), after so many `times` (N,), ascending from 0, of the flow of a H + g F/2."""
    from scipy.integrate import solve_ivp

    I, J, L = (float(x) for x in inertia)
    D = I * J * L
    turns = a + g * I, a + g * J, a + g * L
    pulls = a * I - g * D / I, a * J - g * D / J, a * L - g * D / L

    def rates(_: float, state: FloatArray) -> tuple[float, ...]:  # in plain numbers: arrays of three are slow
        w1, w2, w3, k1, k2, k3 = state.tolist()
        v1, v2, v3 = turns[0] * w1, turns[1] * w2, turns[2] * w3
        return (
            (J * w2 * v3 - L * w3 * v2 + (pulls[2] - pulls[1]) * k2 * k3) / I,
            (L * w3 * v1 - I * w1 * v3 + (pulls[0] - pulls[2]) * k3 * k1) / J,
            (I * w1 * v2 - J * w2 * v1 + (pulls[1] - pulls[0]) * k1 * k2) / L,
            k2 * v3 - k3 * v2,
            k3 * v1 - k1 * v3,
            k1 * v2 - k2 * v1,
        )

    found = solve_ivp(
        rates, (0.0, float(times[-1])), np.concatenate([W, K]), "DOP853", times, rtol=TOLERANCE, atol=TOLERANCE
    )
    return found.y[:3].T, found.y[3:].T
