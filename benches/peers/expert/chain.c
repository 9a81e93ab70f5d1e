// T2 as an expert would write it: the chain seen from its end. If a hinge has the acceleration a, the links below it exert the
// force P a + r on it; the rotation of each link is eliminated from that, hinge by hinge (Featherstone's articulated bodies, in the
// absolute angles of the task). N is defined on the compiler's command line.
//
//     D = I + m c^2 + l^2 n.P'n,  k = m c n + l P'n,  tau = l n.(r' - l w^2 P'e)     e along the link, n across
//     P = P' + m - k k'/D,        r = r' - w^2 (m c e + l P'e) - k tau/D,   theta'' = -(k.a + tau)/D
//
// Gravity is an upward acceleration of the first hinge.
#include "lanes.h"

#if N != 2 && N % 4
#error "N is 2 or a multiple of 4"
#endif

static double last; // the reciprocal of the last link's inertia about its hinge
static double g, l[N], m[N], mc[N], inertia[N];

void eval_setup(const double *p) {
    g = p[0];
    for (int i = 0; i < N; ++i) {
        const double *link = p + 1 + 4 * i, c = link[2];
        l[i] = link[0], m[i] = link[1], mc[i] = link[1] * c, inertia[i] = link[3] + link[1] * c * c;
    }
    last = 1 / inertia[N - 1];
}

typedef double d1;
#define CHAIN(V)                                                                                                       \
    V kx[N], ky[N], tau[N], by[N];                                                                                     \
    V pxx, pxy, pyy, rx, ry;                                                                                           \
    { /* the last link has no links below it */                                                                       \
        const int i = N - 1;                                                                                           \
        const V s = SIN(i), c = COS(i), w2 = RATE(i) * RATE(i);                                                        \
        const V bx = mc[i] * c, by_ = mc[i] * s;                                                                       \
        kx[i] = bx, ky[i] = by_, tau[i] = (V){0}, by[i] = (V){0} + last;                                               \
        const V x = bx * last, y_ = by_ * last;                                                                        \
        pxx = m[i] - bx * x, pxy = -bx * y_, pyy = m[i] - by_ * y_;                                                    \
        rx = -w2 * by_, ry = w2 * bx;                                                                                  \
    }                                                                                                                  \
    for (int i = N - 2; i >= 0; --i) {                                                                                 \
        /* n = (cos, sin), e = (sin, -cos) */                                                                          \
        const V s = SIN(i), c = COS(i), w2 = RATE(i) * RATE(i);                                                        \
        const V nx = l[i] * c, ny = l[i] * s; /* l n; l e = (ny, -nx) */                                               \
        const V hx = pxx * nx + pxy * ny, hy = pxy * nx + pyy * ny;                                                    \
        const V fx = pxx * ny - pxy * nx, fy = pxy * ny - pyy * nx;                                                    \
        const V D = inertia[i] + (nx * hx + ny * hy);                                                                  \
        const V px = rx - w2 * fx, py = ry - w2 * fy;                                                                  \
        const V bx = mc[i] * c, by_ = mc[i] * s;                                                                       \
        kx[i] = bx + hx, ky[i] = by_ + hy;                                                                             \
        by[i] = 1.0 / D;                                                                                               \
        tau[i] = nx * px + ny * py;                                                                                    \
        const V x = kx[i] * by[i], y_ = ky[i] * by[i];                                                                 \
        pxx = (pxx + m[i]) - kx[i] * x, pxy = pxy - kx[i] * y_, pyy = (pyy + m[i]) - ky[i] * y_;                       \
        rx = (px - w2 * by_) - tau[i] * x, ry = (py + w2 * bx) - tau[i] * y_;                                          \
    }                                                                                                                  \
    V ax = (V){0}, ay = (V){0} + g;                                                                                    \
    for (int i = 0; i < N; ++i) {                                                                                      \
        const V a = -by[i] * ((kx[i] * ax + ky[i] * ay) + tau[i]), w2 = RATE(i) * RATE(i);                             \
        ax += l[i] * (a * COS(i) - w2 * SIN(i)), ay += l[i] * (a * SIN(i) + w2 * COS(i));                              \
        QDD(i) = a;                                                                                                    \
    }

// Angles are loaded directly from the state: a wide load after narrow stores would stall.
#if N % 8 == 0
#define WIDTH 8
#define SINCOS_OF_ONE sincos8
typedef d8 wide;
#else
#define WIDTH 4
#define SINCOS_OF_ONE sincos4
typedef d4 wide;
#endif

void eval(const double *y, double t, const double *p, double *qdd) {
    (void)t, (void)p;
    double sin[N + WIDTH], cos[N + WIDTH];
    for (int i = 0; i < N; i += WIDTH) {
        wide x, s, c;
#if N < 4
        x = (wide){y[0], y[1]};
#else
        memcpy(&x, y + i, sizeof x);
#endif
        SINCOS_OF_ONE(x, (wide){0}, &s, &c);
        memcpy(sin + i, &s, sizeof s);
        memcpy(cos + i, &c, sizeof c);
    }
#define SIN(i) sin[i]
#define COS(i) cos[i]
#define RATE(i) y[N + i]
#define QDD(i) qdd[i]
    CHAIN(d1)
#undef SIN
#undef COS
#undef RATE
#undef QDD
}

#define SIN(i) sin[i]
#define COS(i) cos[i]
#define RATE(i) (((const VECTOR *)y)[N + i])
#define QDD(i) (((VECTOR *)qdd)[i])
#define LANES(NAME, V, SINCOS)                                                                                         \
    void NAME(const double *y, const double *t, const double *p, double *qdd) {                                        \
        (void)t, (void)p;                                                                                              \
        V sin[N], cos[N];                                                                                              \
        for (int i = 0; i < N; ++i) SINCOS(((const VECTOR *)y)[i], (V){0}, &sin[i], &cos[i]);                          \
        CHAIN(V)                                                                                                       \
    }
typedef double u4 __attribute__((vector_size(32), aligned(8), may_alias));
typedef double u8 __attribute__((vector_size(64), aligned(8), may_alias));
#define VECTOR u4
LANES(eval4, d4, sincos4)
#undef VECTOR
#define VECTOR u8
LANES(eval8, d8, sincos8)
