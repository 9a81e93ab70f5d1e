// Vectors of four and eight numbers, and the sine and cosine of all their lanes.
#pragma once
#include <string.h>

typedef double d4 __attribute__((vector_size(32)));
typedef long long i4 __attribute__((vector_size(32)));
typedef double d8 __attribute__((vector_size(64)));
typedef long long i8 __attribute__((vector_size(64)));

// Both are polynomials in z = r^2 through the Chebyshev nodes of [0, (pi/4)^2]: sin r = r + r z S(z) with a relative
// error of 2e-17, cos r = 1 - z/2 + z^2 C(z) with an error of 9e-19 (computed with 60 digits).
#define S0 -0x1.5555555555555p-3
#define S1 0x1.1111111110bb1p-7
#define S2 -0x1.a01a019e8357dp-13
#define S3 0x1.71de37961e4c6p-19
#define S4 -0x1.ae600a926c89ap-26
#define S5 0x1.5e0af186af739p-33
#define C0 0x1.5555555555555p-5
#define C1 -0x1.6c16c16c16966p-10
#define C2 0x1.a01a019f4e867p-16
#define C3 -0x1.27e4fa17a41b4p-22
#define C4 0x1.1eeb68b109173p-29
#define C5 -0x1.907d7aebd5e3dp-37
// pi/2 in two parts.
#define HALF_PI 0x1.921fb54442d18p+0
#define HALF_PI_LOW 0x1.1a62633145c07p-54
#define TWO_BY_PI 0x1.45f306dc9c883p-1
// Adding 1.5 * 2^52 rounds to an integer and leaves it in the low bits.
#define ROUNDER 6755399441055744.0

// `low` is the rounding error of the angle. Valid for |x| < 1e5.
#define SINCOS(NAME, V, I)                                                                                             \
    static inline __attribute__((always_inline)) void NAME(V x, V low, V *sin, V *cos) {                               \
        const V shifted = x * TWO_BY_PI + ROUNDER, k = shifted - ROUNDER;                                              \
        const V head = x - k * HALF_PI; /* exact, because it is fused and the operands are close */                                      \
        const V r = head - k * HALF_PI_LOW;                                                                            \
        const V rest = (head - r) - k * HALF_PI_LOW + low;                                                             \
        const V z = r * r, z2 = z * z;                                                                                 \
        const V s = (S0 + z * S1) + z2 * ((S2 + z * S3) + z2 * (S4 + z * S5));                                         \
        const V c = (C0 + z * C1) + z2 * ((C2 + z * C3) + z2 * (C4 + z * C5));                                         \
        const V sine = r + (r * z * s + rest);                                                                         \
        const V w = 1.0 - 0.5 * z;                                                                                     \
        const V cosine = w + (((1.0 - w) - 0.5 * z) + (z2 * c - r * rest));                                            \
        const I turns = (I)shifted, odd = -(turns & 1);                                                                \
        const I a = (I)sine, b = (I)cosine;                                                                            \
        *sin = (V)(((a & ~odd) | (b & odd)) ^ ((turns & 2) << 62));                                                    \
        *cos = (V)(((b & ~odd) | (a & odd)) ^ (((turns + 1) & 2) << 62));                                              \
    }

SINCOS(sincos4, d4, i4)
SINCOS(sincos8, d8, i8)
