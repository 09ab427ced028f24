/* R(t) = R_B(k t) R_z(phi t), (84), as a compiled kernel: phases in two words, reduced by pi/2 in three, and sine and
   cosine by the polynomials of fdlibm, without branches, so that the compiler makes vectors of blocks. `c` holds k and
   phi in two words each, and the unit vector (0, c[4], c[5]). Phases below 2^40. */
#include <math.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

enum { BLOCK = 256 };

static inline void turn(double high, double low, double t, double *sine, double *cosine)
{
    const double P1 = 1.5707963267948966, P2 = 6.123233995736766e-17, P3 = -1.4973849048591833e-33;
    double p = high * t, rest = fma(high, t, -p) + low * t;
    double shifted = p / P1 + 6755399441055744.0, n = shifted - 6755399441055744.0; /* the nearest integer */
    double a = fma(-n, P1, p), q = n * P2, w = rest - q - fma(n, P2, -q) - n * P3;
    double x = a + w, tail = w - (x - a), z = x * x, half = 0.5 * z, one = 1 - half;
    double S = -1.66666666666666324348e-01 + z * (8.33333333332248946124e-03 + z * (-1.98412698298579493134e-04
        + z * (2.75573137070700676789e-06 + z * (-2.50507602534068634195e-08 + z * 1.58969099521155010221e-10))));
    double C = 4.16666666666666019037e-02 + z * (-1.38888888888741095749e-03 + z * (2.48015872894767294178e-05
        + z * (-2.75573143513906633035e-07 + z * (2.08757232129817482790e-09 + z * -1.13596475577881948265e-11))));
    double s = x + (z * x * S + tail * one), c = one + (((1 - one) - half) + (z * z * C - x * tail));
    int64_t quadrant; /* n in the last bits of `shifted`: AVX2 has no conversion to integers of 64 bits */
    memcpy(&quadrant, &shifted, sizeof quadrant);
    double first = quadrant & 1 ? c : s, second = quadrant & 1 ? s : c;
    *sine = quadrant & 2 ? -first : first;
    *cosine = (quadrant + 1) & 2 ? -second : second;
}

void rotations(const double *t, size_t count, const double *c, double *out)
{
    double s[BLOCK], k[BLOCK], S[BLOCK], K[BLOCK], rows[9][BLOCK], y = c[4], z = c[5];
    for (size_t start = 0; start < count; start += BLOCK) {
        size_t size = count - start < BLOCK ? count - start : BLOCK;
        for (size_t i = 0; i < size; i++) {
            turn(c[0], c[1], t[start + i], s + i, k + i);
            turn(c[2], c[3], t[start + i], S + i, K + i);
        }
        for (size_t i = 0; i < size; i++) {
            double v = 1 - k[i];
            double m[9] = {k[i], -z * s[i], y * s[i], z * s[i], k[i] + y * y * v, y * z * v, -y * s[i], y * z * v, k[i] + z * z * v};
            for (int j = 0; j < 9; j += 3) {
                rows[j][i] = m[j] * K[i] + m[j + 1] * S[i];
                rows[j + 1][i] = -m[j] * S[i] + m[j + 1] * K[i];
                rows[j + 2][i] = m[j + 2];
            }
        }
        for (size_t i = 0; i < size; i++)
            for (int j = 0; j < 9; j++) out[9 * (start + i) + j] = rows[j][i];
    }
}
