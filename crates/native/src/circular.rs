//! Sines and cosines of several angles at once: polynomials for angles within [`MOST`], the scalar library for the others.

use crate::sincos::{MOST, is_near, sin_cos_near};
use crate::vector::{Register, Vector};
use crate::{Lanes, Scalar};

/// Sines and cosines of several angles.
pub type Circular<V, const K: usize> = [(Register<V>, Register<V>); K];

/// Vectors that can compute sines and cosines.
pub trait Sines: Vector {
    /// Replaces the sine and cosine of angles that are above [`MOST`] or NaN by those of the scalar library; the
    /// others are returned as given.
    fn sin_cos_beyond(angle: Self, sin: Self, cos: Self) -> (Self, Self);

    /// Sines and cosines of several angles.
    #[inline(always)]
    fn sin_cos_all<const K: usize>(angles: [Register<Self>; K]) -> Circular<Self, K> {
        // One test for all angles: the compiler cannot move code across several tests.
        let (mut all, are_near) = Self::sin_cos_all_near(angles);
        if !are_near {
            for (pair, angle) in all.iter_mut().zip(angles) {
                let (sin, cos) = Self::sin_cos_beyond(angle.0, pair.0.0, pair.1.0);
                *pair = (Register(sin), Register(cos));
            }
        }
        all
    }
    /// Sines and cosines of several angles, and whether all are within [`MOST`]. The results for angles beyond it and
    /// for NaN are arbitrary.
    #[inline(always)]
    fn sin_cos_all_near<const K: usize>(angles: [Register<Self>; K]) -> (Circular<Self, K>, bool) {
        // A loop instead of `map`, which would not be inlined; a function that is not inlined is compiled without
        // the target features.
        let mut all = [(Register(Self::ZERO), Register(Self::ONE)); K];
        let Some(first) = angles.first() else {
            return (all, true);
        };
        let mut are_near = is_near(first.0);
        for (pair, angle) in all.iter_mut().zip(angles) {
            let (sin, cos) = sin_cos_near(angle.0);
            *pair = (Register(sin), Register(cos));
            are_near = Self::mask_and(are_near, is_near(angle.0));
        }
        (all, Self::all(are_near))
    }

    /// [`Scalar::store_all`](lagrangian_scalar::Scalar::store_all).
    #[inline(always)]
    fn store_all<const P: usize>(row: &mut [Self::Stored; P], numbers: [Self::Stored; P]) {
        *row = numbers;
    }

    /// [`Scalar::convolve_all`](lagrangian_scalar::Scalar::convolve_all).
    #[inline(always)]
    fn convolve_all<const P: usize>(
        a: &[[Self::Stored; P]],
        b: &[[Self::Stored; P]],
    ) -> [Register<Self>; P] {
        crate::series::convolve_all(a, b)
    }
}

/// [`Sines::sin_cos_beyond`] of one number.
#[cold]
#[inline(never)]
pub fn sin_cos_beyond(angle: f64, sin: f64, cos: f64) -> (f64, f64) {
    // Not `>`, because NaN must count as beyond.
    if angle.abs() <= MOST {
        (sin, cos)
    } else {
        Scalar::sin_cos(angle)
    }
}

/// [`Sines::sin_cos_beyond`] of several.
#[cold]
#[inline(never)]
pub fn sin_cos_beyond_each<const N: usize>(
    angles: Lanes<N>,
    mut sin: Lanes<N>,
    mut cos: Lanes<N>,
) -> (Lanes<N>, Lanes<N>) {
    for lane in 0..N {
        (sin[lane], cos[lane]) = sin_cos_beyond(angles[lane], sin[lane], cos[lane]);
    }
    (sin, cos)
}

impl Sines for f64 {
    #[inline(always)]
    fn sin_cos_beyond(angle: Self, sin: Self, cos: Self) -> (Self, Self) {
        sin_cos_beyond(angle, sin, cos)
    }
}

impl<const N: usize> Sines for [f64; N] {
    #[inline(always)]
    fn sin_cos_beyond(angle: Self, sin: Self, cos: Self) -> (Self, Self) {
        let (sin, cos) = sin_cos_beyond_each(Lanes(angle), Lanes(sin), Lanes(cos));
        (sin.0, cos.0)
    }
}
