/* The leapfrog (velocity Störmer–Verlet; E. Hairer, C. Lubich, G. Wanner, Geometric Numerical Integration, 2nd ed., 2006, I.1.4) for a mass on a
 * spring in a vertical plane, in Cartesian coordinates.
 *
 *     leapfrog STEP M K L0 G X Y COUNT [COUNT ...]
 *
 * begins at rest at (X, Y), y upward, and prints x, y and their rates after each of the increasing numbers of steps. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

int main(int argc, char **argv) {
    if (argc < 9)
        return 2;
    double h = atof(argv[1]), m = atof(argv[2]), k = atof(argv[3]), l0 = atof(argv[4]), g = atof(argv[5]);
    double x = atof(argv[6]), y = atof(argv[7]), u = 0.0, v = 0.0;
    double pull = -(k / m) * (1.0 - l0 / sqrt(x * x + y * y));
    double ax = pull * x, ay = pull * y - g;
    long done = 0;
    for (int i = 8; i < argc; i++) {
        for (long count = atol(argv[i]); done < count; done++) {
            u += 0.5 * h * ax;
            v += 0.5 * h * ay;
            x += h * u;
            y += h * v;
            pull = -(k / m) * (1.0 - l0 / sqrt(x * x + y * y));
            ax = pull * x;
            ay = pull * y - g;
            u += 0.5 * h * ax;
            v += 0.5 * h * ay;
        }
        printf("%.17g %.17g %.17g %.17g\n", x, y, u, v);
    }
    return 0;
}
