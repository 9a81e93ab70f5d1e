/* What Siconos calls: gaps and slips of contacts, and the slider-crank's inertia. Matrices are stored by columns; the last
 * pair of arguments is for parameters of a relation and not used. */
#include <math.h>

#define Z unsigned int sizeZ, double *z

/* The lower corners of a block with coordinates x, y, theta. */
static void corner(const double *q, double across, double *y, double *G) {
    const double b = across * 0.25, h = -1.0, s = sin(q[2]), c = cos(q[2]);
    if (y) { y[0] = q[1] + s * b + c * h; y[1] = q[0] + c * b - s * h; }
    if (G) { G[0] = 0; G[1] = 1; G[2] = 1; G[3] = 0; G[4] = c * b - s * h; G[5] = -s * b - c * h; }
}
void left_y(unsigned int n, const double *q, unsigned int m, double *y, Z) { corner(q, -1, y, 0); }
void left_G(unsigned int n, const double *q, unsigned int m, double *G, Z) { corner(q, -1, 0, G); }
void right_y(unsigned int n, const double *q, unsigned int m, double *y, Z) { corner(q, 1, y, 0); }
void right_G(unsigned int n, const double *q, unsigned int m, double *G, Z) { corner(q, 1, 0, G); }

/* The slider-crank of truths.py, with the slider's angle third. */
enum { N = 3 };
static const double l1 = 0.153, l2 = 0.306, play = 0.001, a = 0.05, b = 0.025, g = 9.81;
static const double m1 = 0.038, m2 = 0.038, m3 = 0.076, J1 = 7.4e-5, J2 = 5.9e-4, J3 = 2.7e-6;
#define A12 ((m2 / 2 + m3) * l1 * l2)
void slider_mass(unsigned int n, const double *q, double *M, Z) {
    for (int i = 0; i < N * N; ++i) M[i] = 0;
    M[0] = J1 + m1 * l1 * l1 / 4 + (m2 + m3) * l1 * l1;
    M[1] = M[N] = A12 * cos(q[0] - q[1]);
    M[N + 1] = J2 + m2 * l2 * l2 / 4 + m3 * l2 * l2;
    M[2 * N + 2] = J3;
}
void slider_gyr(unsigned int n, const double *q, const double *v, double *f, Z) {
    const double s = A12 * sin(q[0] - q[1]);
    f[0] = s * v[1] * v[1] + (m1 / 2 + m2 + m3) * g * l1 * cos(q[0]);
    f[1] = -s * v[0] * v[0] + (m2 / 2 + m3) * g * l2 * cos(q[1]);
    f[2] = 0;
}
void slider_gyr_q(unsigned int n, const double *q, const double *v, double *J, Z) {
    const double c = A12 * cos(q[0] - q[1]);
    for (int i = 0; i < N * N; ++i) J[i] = 0;
    J[0] = c * v[1] * v[1] - (m1 / 2 + m2 + m3) * g * l1 * sin(q[0]);
    J[1] = -c * v[0] * v[0];
    J[N] = -c * v[1] * v[1];
    J[N + 1] = c * v[0] * v[0] - (m2 / 2 + m3) * g * l2 * sin(q[1]);
}
void slider_gyr_v(unsigned int n, const double *q, const double *v, double *J, Z) {
    const double s = A12 * sin(q[0] - q[1]);
    for (int i = 0; i < N * N; ++i) J[i] = 0;
    J[1] = -2 * s * v[0];
    J[N] = 2 * s * v[1];
}
/* A corner and the side of the guide that it may touch: `up` for the upper side. */
static void touch(const double *q, double x, double up, double *y, double *G) {
    const double at = up * b, s = sin(q[2]), c = cos(q[2]);
    if (y) {
        y[0] = b + play - up * (l1 * sin(q[0]) + l2 * sin(q[1]) + s * x + c * at);
        y[1] = l1 * cos(q[0]) + l2 * cos(q[1]) + c * x - s * at;
    }
    if (G) {
        G[0] = -up * l1 * cos(q[0]); G[1] = -l1 * sin(q[0]);
        G[2] = -up * l2 * cos(q[1]); G[3] = -l2 * sin(q[1]);
        G[4] = -up * (c * x - s * at); G[5] = -s * x - c * at;
    }
}
void touch0_y(unsigned int n, const double *q, unsigned int m, double *y, Z) { touch(q, -a, 1, y, 0); }
void touch0_G(unsigned int n, const double *q, unsigned int m, double *G, Z) { touch(q, -a, 1, 0, G); }
void touch1_y(unsigned int n, const double *q, unsigned int m, double *y, Z) { touch(q, a, 1, y, 0); }
void touch1_G(unsigned int n, const double *q, unsigned int m, double *G, Z) { touch(q, a, 1, 0, G); }
void touch2_y(unsigned int n, const double *q, unsigned int m, double *y, Z) { touch(q, -a, -1, y, 0); }
void touch2_G(unsigned int n, const double *q, unsigned int m, double *G, Z) { touch(q, -a, -1, 0, G); }
void touch3_y(unsigned int n, const double *q, unsigned int m, double *y, Z) { touch(q, a, -1, y, 0); }
void touch3_G(unsigned int n, const double *q, unsigned int m, double *G, Z) { touch(q, a, -1, 0, G); }

/* Discs of one radius, against each other and inside a bowl; the slip of a pair has the parts of both. */
static const double r = 0.05, R = 0.5;
void pair_y(unsigned int n, const double *q, unsigned int m, double *y, Z) {
    y[0] = hypot(q[0] - q[3], q[1] - q[4]) - 2 * r;
    y[1] = 0;
}
void pair_G(unsigned int n, const double *q, unsigned int m, double *G, Z) {
    const double d = hypot(q[0] - q[3], q[1] - q[4]), x = (q[0] - q[3]) / d, y = (q[1] - q[4]) / d;
    const double all[] = {x, -y, y, x, 0, -r, -x, y, -y, -x, 0, -r};
    for (int i = 0; i < 12; ++i) G[i] = all[i];
}
void wall_y(unsigned int n, const double *q, unsigned int m, double *y, Z) {
    y[0] = R - r - hypot(q[0], q[1]);
    y[1] = 0;
}
void wall_G(unsigned int n, const double *q, unsigned int m, double *G, Z) {
    const double d = fmax(hypot(q[0], q[1]), 1e-12), x = -q[0] / d, y = -q[1] / d;
    const double all[] = {x, -y, y, x, 0, -r};
    for (int i = 0; i < 6; ++i) G[i] = all[i];
}
