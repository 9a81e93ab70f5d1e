//! Bounds on the motion within a step by series.

use super::motion::{Block, in_registers};
use crate::Vector;
use crate::scalar::{Kernel, Scalar};

/// The lowest and the highest coordinates and rates within a step.
#[derive(Clone, Debug)]
pub(crate) struct MotionBounds<V> {
    pub q: [V; 2],
    pub v: [V; 2],
}

impl<V: Vector> MotionBounds<V> {
    /// Room for as many numbers as a vector has.
    pub fn like(vector: &V) -> Self {
        Self {
            q: [(); 2].map(|()| vector.zeros_like()),
            v: [(); 2].map(|()| vector.zeros_like()),
        }
    }

    /// Computes the bounds for a step of length `h` from a state through which the motion has these coefficients; those of rates only with
    /// `RATES`. Returns whether they are finite.
    ///
    /// The motion is `Σ cⱼ θʲ` with `1 ≥ θ ≥ θ² ≥ …`, which is a convex combination of the partial sums `Σ cⱼ` over `j ≤ k`: it lies between
    /// the lowest and the highest of them.
    pub fn of_step<const RATES: bool>(
        &mut self,
        coefficients: &[V],
        h: f64,
        state: [&V; 2],
    ) -> bool {
        let bounds = self;
        in_registers!(state[0].as_slice().len(), |start, end| Bound::<V, RATES> {
            coefficients,
            h,
            state,
            bounds: &mut *bounds,
            range: [start, end],
        })
    }
}

impl<V: Vector> MotionBounds<V> {
    /// Whether they contain the motion within a step of length `h` from a state through which the motion has these coefficients, by the sum of the sizes of
    /// its terms: sufficient, and half of the work of [`of_step`](Self::of_step). Those of rates count only with `RATES`.
    pub fn contain<const RATES: bool>(&self, coefficients: &[V], h: f64, state: [&V; 2]) -> bool {
        in_registers!(
            state[0].as_slice().len(),
            |start, end| Contains::<V, RATES> {
                bounds: self,
                coefficients,
                h: h.abs(),
                state,
                range: [start, end],
            }
        )
    }
}

/// [`MotionBounds::contain`] for a range of coordinates whose number is a multiple of that of a block, as a kernel.
struct Contains<'a, V, const RATES: bool> {
    bounds: &'a MotionBounds<V>,
    coefficients: &'a [V],
    h: f64,
    state: [&'a V; 2],
    range: [usize; 2],
}

impl<T: Block, V: Vector, const RATES: bool> Kernel<T> for Contains<'_, V, RATES> {
    type Output = bool;

    #[inline(always)]
    fn run<N: Scalar<Stored = T>>(self) -> bool {
        let Self {
            bounds,
            coefficients,
            state,
            range: [mut start, end],
            ..
        } = self;
        let h = N::load(T::each(self.h));
        let mut are_within = true;
        while start < end {
            let (mut of_q, mut of_v) = (N::ZERO, N::ZERO);
            for (k, row) in coefficients.iter().enumerate().skip(1).rev() {
                let size = read::<T, N, V>(row, start).abs();
                of_q = of_q.mul_add(h, size);
                if RATES && k > 1 {
                    of_v = of_v.mul_add(h, size * N::from_f64(k as f64));
                }
            }
            are_within &= is_within([state[0], &bounds.q[0], &bounds.q[1]], of_q * h, start);
            if RATES {
                are_within &= is_within([state[1], &bounds.v[0], &bounds.v[1]], of_v * h, start);
            }
            start += T::COUNT;
        }
        are_within
    }
}

/// Whether numbers from an index on stay between others, if they move by no more than `reach`. Not where anything is not a number.
#[inline(always)]
fn is_within<T: Block, N: Scalar<Stored = T>, V: Vector>(
    [at, low, high]: [&V; 3],
    reach: N,
    start: usize,
) -> bool {
    let at = read::<T, N, V>(at, start);
    let down = (at - reach) - read::<T, N, V>(low, start);
    let up = read::<T, N, V>(high, start) - (at + reach);
    down.min(up).store().are_not_negative()
}

/// [`MotionBounds::of_step`] for a range of coordinates whose number is a multiple of that of a block, as a kernel.
struct Bound<'a, V, const RATES: bool> {
    coefficients: &'a [V],
    h: f64,
    state: [&'a V; 2],
    bounds: &'a mut MotionBounds<V>,
    range: [usize; 2],
}

/// The numbers of a vector from an index on.
#[inline(always)]
fn read<T: Block, N: Scalar<Stored = T>, V: Vector>(from: &V, start: usize) -> N {
    N::load(T::read(from.as_slice(), start))
}

/// Writes bounds to the numbers of two vectors from an index on.
#[inline(always)]
fn write<T: Block, N: Scalar<Stored = T>, V: Vector>(
    [low, high]: [N; 2],
    to: &mut [V; 2],
    start: usize,
) {
    let [to_low, to_high] = to;
    low.store().write(to_low.as_mut_slice(), start);
    high.store().write(to_high.as_mut_slice(), start);
}

/// Bounds that contain another number as well.
#[inline(always)]
fn with<N: Scalar>([low, high]: [N; 2], x: N) -> [N; 2] {
    [low.min(x), high.max(x)]
}

impl<T: Block, V: Vector, const RATES: bool> Kernel<T> for Bound<'_, V, RATES> {
    type Output = bool;

    #[inline(always)]
    fn run<N: Scalar<Stored = T>>(self) -> bool {
        let Self {
            coefficients,
            state,
            bounds,
            range: [mut start, end],
            ..
        } = self;
        let h = N::load(T::each(self.h));
        let mut are_finite = true;
        while start < end {
            let [mut q, mut v]: [N; 2] = [read(state[0], start), read(state[1], start)];
            let (mut of_q, mut of_v) = ([q; 2], [v; 2]);
            let (mut power, mut order) = (h, N::ONE);
            for (k, row) in coefficients.iter().enumerate().skip(1) {
                q = read::<T, N, V>(row, start).mul_add(power, q);
                of_q = with(of_q, q);
                if RATES && let Some(next) = coefficients.get(k + 1) {
                    order = order + N::ONE;
                    v = (order * read::<T, N, V>(next, start)).mul_add(power, v);
                    of_v = with(of_v, v);
                }
                power = power * h;
            }
            // A sum that is not finite makes all later ones so.
            are_finite &= q.store().are_finite();
            write(of_q, &mut bounds.q, start);
            if RATES {
                are_finite &= v.store().are_finite();
                write(of_v, &mut bounds.v, start);
            }
            start += T::COUNT;
        }
        are_finite
    }
}

#[cfg(test)]
mod tests {
    use std::vec::Vec;

    use super::MotionBounds;
    use crate::taylor::state;

    #[test]
    fn the_motion_within_a_step_is_within_its_bounds() {
        // Blocks of four, of two and of one coordinate.
        motion_is_within_bounds::<3>();
        motion_is_within_bounds::<5>();
        motion_is_within_bounds::<6>();
        motion_is_within_bounds::<7>();
    }

    fn motion_is_within_bounds<const N: usize>() {
        for rows in 3..=24 {
            let number = |j: usize, i: usize| (1.0 + (j * N + i) as f64 * 0.618).sin();
            let coefficients: Vec<[f64; N]> = (0..rows)
                .map(|j| std::array::from_fn(|i| number(j, i)))
                .collect();
            for h in [0.8, -0.3] {
                let mut bounds = MotionBounds::like(&coefficients[0]);
                let from = [&coefficients[0], &coefficients[1]];
                assert!(bounds.of_step::<true>(&coefficients, h, from));
                let mut of_coordinates = MotionBounds::like(&coefficients[0]);
                assert!(of_coordinates.of_step::<false>(&coefficients, h, from));
                assert_eq!(of_coordinates.q, bounds.q);
                let mut reached = [[f64::INFINITY, f64::NEG_INFINITY]; N];
                for part in 0..=100 {
                    let (q, v) = state(&coefficients, h * f64::from(part) / 100.0);
                    for (i, (q, v)) in q.into_iter().zip(v).enumerate() {
                        for (x, of) in [(q, &bounds.q), (v, &bounds.v)] {
                            let rounding = 1e-12 * (1.0 + x.abs());
                            assert!(of[0][i] - rounding <= x && x <= of[1][i] + rounding);
                        }
                        let [low, high] = reached[i];
                        reached[i] = [low.min(q), high.max(q)];
                    }
                }
                // They are no wider than the sum of the sizes of all terms on either side.
                for (i, [low, high]) in reached.into_iter().enumerate() {
                    let terms = (1..rows).map(|j| (coefficients[j][i] * h.powi(j as i32)).abs());
                    let size: f64 = terms.sum();
                    assert!(low - bounds.q[0][i] <= size && bounds.q[1][i] - high <= size);
                }
            }
            // Not finite in one coordinate alone.
            for i in 0..N {
                let mut broken = coefficients.clone();
                broken[rows - 1][i] = f64::INFINITY;
                let mut bounds = MotionBounds::like(&broken[0]);
                let from = [&broken[0], &broken[1]];
                assert!(!bounds.of_step::<true>(&broken, 0.5, from));
                assert!(!bounds.of_step::<false>(&broken, 0.5, from));
            }
        }
    }
}
