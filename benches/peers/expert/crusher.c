// T1 as an expert would write it: Newton's law for each body in Cartesian components, so that mortar and pestle drop out
// of the platform's equations, and the accelerations of the polar coordinates are read off.
//
//     m2 (A + B + C) = F2 e2          A, B, C: accelerations of the platform, of the mortar on it, of the pestle on the mortar
//     m1 (A + B)     = F1 e1 - F2 e2  F1, F2: along the radii
//     (m + m0) A + m0 alpha b' = F - F1 e1 + m0 (omega^2 b + e w^2 u)    b: the debalance's axis, b' across it
//     (J + m0 b^2) alpha + m0 b'.A = Q + m0 e w^2 b'.u                   u = (cos wt, sin wt)
#include "lanes.h"
#include <immintrin.h>

static struct {
    double w, x0, y0, cx, cy, xc, yc, bx, by, xb, yb, k1, d1, r1, k2, d2, r2;
    double m0, unbalance;         // m0 e w^2
    double by_mass, by_inertia;   // 1/(m + m0), 1/(J + m0 b^2 m/(m + m0))
    double share, by_m1, by_m2;   // m0/(m + m0)
} k;

void eval_setup(const double *p) {
    const double m = p[0], J = p[1], m0 = p[2], e = p[3], x0 = p[4], y0 = p[5], w = p[6];
    k.m0 = m0, k.x0 = x0, k.y0 = y0, k.w = w;
    k.cx = p[11], k.cy = p[12], k.xc = p[13], k.yc = p[14], k.bx = p[15], k.by = p[16], k.xb = p[17], k.yb = p[18];
    k.k1 = p[19], k.d1 = p[20], k.r1 = p[21], k.k2 = p[22], k.d2 = p[23], k.r2 = p[24];
    k.unbalance = m0 * e * w * w;
    k.by_mass = 1 / (m + m0);
    k.share = m0 * k.by_mass;
    k.by_inertia = 1 / (J + (x0 * x0 + y0 * y0) * m * k.share);
    k.by_m1 = 1 / p[7], k.by_m2 = 1 / p[9];
}

// The algebra, for scalars and for each vector type; Y(i) and QDD(i) access component i of the state and of the result.
#define BODY(V)                                                                                                        \
    const V s1 = Y(3), s2 = Y(6), om = Y(11), vs1 = Y(12), vf1 = Y(13), vs2 = Y(15), vf2 = Y(16);                      \
    const V bx = k.x0 * ct - k.y0 * st, by = k.x0 * st + k.y0 * ct;                                                    \
    const V along = k.cx * (Y(0) - k.yc * Y(2)), across = k.cy * (Y(1) + k.xc * Y(2));                                 \
    const V damp_x = k.bx * (Y(9) - k.yb * om), damp_y = k.by * (Y(10) + k.xb * om);                                   \
    const V F1 = k.k1 * (k.r1 - s1) - k.d1 * vs1, F2 = k.k2 * (k.r2 - s2) - k.d2 * vs2;                                \
    const V f1x = F1 * c1, f1y = F1 * n1, f2x = F2 * c2, f2y = F2 * n2;                                                \
    const V ux = k.unbalance * cw, uy = k.unbalance * sw, spin = k.m0 * (om * om);                                     \
    const V gx = (ux + spin * bx) - (f1x + (along + damp_x)), gy = (uy + spin * by) - (f1y + (across + damp_y));       \
    const V torque = (k.yc * along - k.xc * across) + (k.yb * damp_x - k.xb * damp_y);                                 \
    const V ex = ux - k.share * gx, ey = uy - k.share * gy;                                                            \
    const V alpha = k.by_inertia * (torque + (bx * ey - by * ex));                                                     \
    const V turn = k.share * alpha;                                                                                    \
    const V ax = k.by_mass * gx + turn * by, ay = k.by_mass * gy - turn * bx;                                          \
    const V mx = k.by_m1 * (f1x - f2x), my = k.by_m1 * (f1y - f2y);                                                    \
    const V Bx = mx - ax, By = my - ay, Cx = k.by_m2 * f2x - mx, Cy = k.by_m2 * f2y - my;                              \
    const V by_s = 1.0 / (s1 * s2);                                                                                    \
    QDD(0) = ax;                                                                                                       \
    QDD(1) = ay;                                                                                                       \
    QDD(2) = alpha;                                                                                                    \
    QDD(3) = (Bx * c1 + By * n1) + s1 * (vf1 * vf1);                                                                   \
    QDD(4) = ((By * c1 - Bx * n1) - 2.0 * vs1 * vf1) * (s2 * by_s);                                                    \
    QDD(5) = (V){0};                                                                                                   \
    QDD(6) = (Cx * c2 + Cy * n2) + s2 * (vf2 * vf2);                                                                   \
    QDD(7) = ((Cy * c2 - Cx * n2) - 2.0 * vs2 * vf2) * (s1 * by_s);                                                    \
    QDD(8) = (V){0};

void eval(const double *y, double t, const double *p, double *qdd) {
    (void)p;
    const double phase = k.w * t;
    d4 sin, cos;
    sincos4((d4){y[2], y[4], y[7], phase}, (d4){0, 0, 0, __builtin_fma(k.w, t, -phase)}, &sin, &cos);
    const double st = sin[0], n1 = sin[1], n2 = sin[2], sw = sin[3], ct = cos[0], c1 = cos[1], c2 = cos[2], cw = cos[3];
#define Y(i) y[i]
#define QDD(i) qdd[i]
    BODY(double)
#undef Y
#undef QDD
}

#define LANES(NAME, V, SINCOS, TAKE)                                                                                       \
    void NAME(const double *y, const double *t, const double *p, double *qdd) {                                        \
        (void)p;                                                                                                       \
        V time, st, ct, n1, c1, n2, c2, sw, cw;                                                                        \
        memcpy(&time, t, sizeof time);                                                                                 \
        const V phase = k.w * time, zero = {0};                                                                        \
        SINCOS(Y(2), zero, &st, &ct);                                                                                  \
        SINCOS(Y(4), zero, &n1, &c1);                                                                                  \
        SINCOS(Y(7), zero, &n2, &c2);                                                                                  \
        SINCOS(phase, TAKE(zero + k.w, time, phase), &sw, &cw); /* with the rounding error of the phase, by a fused operation */         \
        BODY(V)                                                                                                        \
    }
#define Y(i) (((const VECTOR *)y)[i])
#define QDD(i) (((VECTOR *)qdd)[i])
typedef double u4 __attribute__((vector_size(32), aligned(8), may_alias));
typedef double u8 __attribute__((vector_size(64), aligned(8), may_alias));
#define VECTOR u4
LANES(eval4, d4, sincos4, _mm256_fmsub_pd)
#undef VECTOR
#define VECTOR u8
LANES(eval8, d8, sincos8, _mm512_fmsub_pd)
