/* DOP853 with its usual control of the step (E. Hairer, S. P. Nørsett, G. Wanner, Solving Ordinary Differential Equations I), without
 * dense output. COEFFICIENTS and RATES are files that dop853.py writes: the method's tables, and the machine's right-hand side. */
#include <math.h>
#include <string.h>

#include COEFFICIENTS
#include RATES

enum { STAGES = 12 };

static double norm(const double *x, const double *scale) {
    double sum = 0;
    for (int i = 0; i < SIZE; ++i) sum += x[i] / scale[i] * (x[i] / scale[i]);
    return sqrt(sum / SIZE);
}

static double first_step(double t, const double *y, const double *f, double tolerance) {
    double scale[SIZE], next[SIZE], then[SIZE];
    for (int i = 0; i < SIZE; ++i) scale[i] = tolerance + tolerance * fabs(y[i]);
    const double d0 = norm(y, scale), d1 = norm(f, scale);
    const double h = d0 < 1e-5 || d1 < 1e-5 ? 1e-6 : 0.01 * d0 / d1;
    for (int i = 0; i < SIZE; ++i) next[i] = y[i] + h * f[i];
    rates(t + h, next, then);
    for (int i = 0; i < SIZE; ++i) then[i] -= f[i];
    const double d2 = norm(then, scale) / h, greatest = fmax(d1, d2);
    const double other = greatest <= 1e-15 ? fmax(1e-6, h * 1e-3) : pow(0.01 / greatest, 1.0 / 8);
    return fmin(100 * h, other);
}

/* Integrates y from 0 to `until`; the number of attempts comes back, or -1 if the step is too small. */
long integrate(double *y, double until, double tolerance) {
    double k[STAGES + 1][SIZE], next[SIZE], t = 0;
    rates(t, y, k[0]);
    double h = first_step(t, y, k[0], tolerance);
    int was_rejected = 0;
    for (long attempts = 1;; ++attempts) {
        const int is_last = t + 1.01 * h >= until;
        if (is_last) h = until - t;
        if (!(h > 1e-15 * t)) return -1;
        for (int s = 1; s < STAGES; ++s) {
            for (int i = 0; i < SIZE; ++i) {
                double sum = 0;
                for (int j = 0; j < s; ++j) sum += A[s][j] * k[j][i];
                next[i] = y[i] + h * sum;
            }
            rates(t + C[s] * h, next, k[s]);
        }
        double five = 0, three = 0;
        for (int i = 0; i < SIZE; ++i) {
            double sum = 0, e5 = 0, e3 = 0;
            for (int j = 0; j < STAGES; ++j) {
                sum += B[j] * k[j][i];
                e5 += E5[j] * k[j][i];
                e3 += E3[j] * k[j][i];
            }
            next[i] = y[i] + h * sum;
            const double scale = tolerance + tolerance * fmax(fabs(y[i]), fabs(next[i]));
            five += e5 / scale * (e5 / scale);
            three += e3 / scale * (e3 / scale);
        }
        const double below = five + 0.01 * three;
        const double error = below > 0 ? fabs(h) * five / sqrt(below * SIZE) : 0;
        const double factor = fmin(6, fmax(1.0 / 3, 0.9 * pow(fmax(error, 1e-30), -1.0 / 8)));
        if (error <= 1) {
            t += h;
            memcpy(y, next, sizeof next);
            if (is_last) return attempts;
            rates(t, y, k[0]);
            h *= was_rejected ? fmin(1, factor) : factor;
            was_rejected = 0;
        } else {
            h *= fmin(1, factor);
            was_rejected = 1;
        }
    }
}
