//! Steps by Taylor series.
//!
//! The motion through the beginning of a step is a polynomial `q(τ) = Σ cⱼ τʲ`, whose coefficients a machine computes
//! ([`System::series`]). A step evaluates it at its end, dense output and events between its ends, so neither costs
//! anything of the machine. Its length follows from the last two coefficients before it is taken, and none is rejected.
//!
//! State and time are compensated sums: what is added to the state is rounded once, and what rounding takes from it is kept
//! (N. J. Higham, *Accuracy and Stability of Numerical Algorithms*, 2nd ed., 2002, section 4.3).

use std::vec::Vec;

use crate::compensated::two_sum;
use crate::math::{rough_exp2, rough_log2};
use crate::stages::{Point, in_blocks};
use crate::tolerance::Tolerance;
use crate::{Real, Singular, System, Vector};

/// Coefficients of the accelerations for tolerances down to [`FINE`], and below.
const ORDERS: [usize; 2] = [12, 20];

/// Below this tolerance the higher order takes less time: products of series grow with the square of the order, the rest of a step
/// with the order itself, and steps of fine tolerances are longer by more than that.
const FINE: f64 = 1e-5;

/// The coefficients of the motion through the beginning of the last step and through its end.
#[derive(Clone, Debug)]
pub(crate) struct Taylor<V> {
    coefficients: [Vec<V>; 2],
    /// Which of them are of the beginning.
    beginning: usize,
    /// Whether a step was taken from there.
    is_taken: bool,
    /// The length of a step from now, once it was asked for.
    length: Option<f64>,
}

impl<V: Vector> Taylor<V> {
    /// Room for the series that a tolerance asks for.
    pub fn new(tolerance: &Tolerance<V>) -> Self {
        let zeros = tolerance.absolute.zeros_like();
        let absolute = tolerance.absolute.as_slice().iter();
        let least = absolute.fold(f64::INFINITY, |least, &x| least.min(x));
        let is_fine = least + tolerance.relative <= FINE;
        let order = ORDERS[usize::from(is_fine)];
        Self {
            coefficients: [(); 2].map(|()| std::vec![zeros.clone(); order + 2]),
            beginning: 0,
            is_taken: false,
            length: None,
        }
    }

    /// The coefficients of the last step; before the first, those of the start.
    pub fn of_step(&self) -> &[V] {
        &self.coefficients[self.beginning]
    }

    /// The coefficients of the motion through now.
    pub fn of_now_rows(&self) -> &[V] {
        &self.coefficients[self.of_now()]
    }

    fn of_now(&self) -> usize {
        match self.is_taken {
            true => 1 - self.beginning,
            false => self.beginning,
        }
    }

    /// Makes now the beginning of a step.
    pub fn begin(&mut self) {
        self.beginning = self.of_now();
        self.is_taken = false;
    }

    /// Makes the step just tried the last step.
    pub fn accept(&mut self) {
        self.is_taken = true;
        self.length = None;
    }

    /// Takes the last step back.
    pub fn retreat(&mut self) {
        self.is_taken = false;
        self.length = None;
    }

    /// Expands the motion through a state: the start, or, with `ahead`, the end of the step that is tried.
    pub fn expand<S: System<Vector = V>>(
        &mut self,
        system: &S,
        at: &Point<V>,
        u: &S::Inputs,
        ahead: bool,
    ) -> Result<(), Singular> {
        let which = match ahead {
            true => 1 - self.beginning,
            false => self.of_now(),
        };
        self.length = None;
        let t = [at.t, at.t_low];
        system.series(t, &at.q, &at.v, u, &mut self.coefficients[which])
    }

    /// The accelerations at the state that was expanded last: now, or with `ahead` the end of the step that is tried.
    pub fn accelerations(&self, ahead: bool, a: &mut V) {
        let which = match ahead {
            true => 1 - self.beginning,
            false => self.of_now(),
        };
        let second = &self.coefficients[which][2];
        for (a, c) in a.as_mut_slice().iter_mut().zip(second.as_slice()) {
            *a = 2.0 * c;
        }
    }

    /// The length of a step from now whose last two terms are tolerable; infinite where nothing moves.
    ///
    /// With two, since after a start at rest, and at turning points, every second coefficient vanishes. The truncation error
    /// is about `tolerable/(1 − h/R)`, with `R` the radius of convergence, near which steps of coarse tolerances
    /// come: these ask for a tenth. Tolerances at the rounding of `f64` ask for a hundredth, so that the truncation error stays
    /// below rounding, and errors of steps do not add up with the same sign.
    pub fn length(&mut self, tolerance: &Tolerance<V>) -> f64 {
        let length = match self.length {
            Some(known) => known,
            None => self.tolerable_length(tolerance),
        };
        self.length = Some(length);
        length
    }

    fn tolerable_length(&self, tolerance: &Tolerance<V>) -> f64 {
        let coefficients = &self.coefficients[self.of_now()];
        let last = coefficients.len() - 1;
        let powers = [last - 1, last];
        let mut worst = [0.0_f64; 2];
        let [q, v] = [0, 1].map(|k| coefficients[k].as_slice());
        let rows = powers.map(|j| coefficients[j].as_slice());
        for (i, absolute) in tolerance.absolute.as_slice().iter().enumerate() {
            let size = q[i].abs().max(v[i].abs());
            let tolerable = absolute + tolerance.relative * size;
            let bound = match 1.0 + size {
                whole if tolerable > 1e-8 * whole => 0.1 * tolerable,
                whole if tolerable < 1e-14 * whole => 0.01 * tolerable,
                _ => tolerable,
            };
            // v = Σ (j + 1) cⱼ₊₁ τʲ
            let over = 1.0 / bound;
            for (worst, (row, j)) in worst.iter_mut().zip(rows.iter().zip(powers)) {
                let ratio = match row[i] {
                    0.0 => 0.0,
                    c => (j as f64 * c.abs()) * over,
                };
                // What is no number must not pass for none.
                *worst = if ratio > *worst || ratio.is_nan() {
                    ratio
                } else {
                    *worst
                };
            }
        }
        // The logarithm of the length.
        let mut length = f64::INFINITY;
        for (worst, j) in worst.into_iter().zip(powers) {
            if worst == f64::INFINITY {
                return 0.0;
            } else if worst > 0.0 {
                length = length.min(rough_log2(worst) / (1.0 - j as f64));
            } else if worst.is_nan() {
                return f64::NAN;
            }
        }
        match length {
            f64::INFINITY => length,
            _ => rough_exp2(length),
        }
    }

    /// The state at the end of a step of length `h`, as compensated sums.
    pub fn advance(&self, h: f64, before: &Point<V>, now: &mut Point<V>) {
        let coefficients = self.of_step();
        in_blocks!(before.q.as_slice().len(), |start, B| {
            let [q, v] = rises::<B, _, V>(coefficients, start, h);
            for k in 0..B {
                let i = start + k;
                let low = before.v_low.as_slice()[i];
                let q_low = before.q_low.as_slice()[i] + h * low;
                (now.q.as_mut_slice()[i], now.q_low.as_mut_slice()[i]) =
                    two_sum(before.q.as_slice()[i], q_low + q[k]);
                (now.v.as_mut_slice()[i], now.v_low.as_mut_slice()[i]) =
                    two_sum(before.v.as_slice()[i], low + v[k]);
            }
        });
    }
}

/// By how much `B` coordinates from `start` on and their rates change in a time `tau`: side by side, so that the
/// processor has several sums to work at.
#[inline(always)]
fn rises<const B: usize, N: Real, V: Vector<N>>(
    coefficients: &[V],
    start: usize,
    tau: N,
) -> [[N; B]; 2] {
    // Terms of even and of odd powers by Horner's rule each, which do not wait for each other.
    let zeros = [N::ZERO; B];
    let (mut q, mut v) = ([zeros; 2], [zeros; 2]);
    let block = |j: usize| {
        let row = coefficients[j].as_slice().get(start..start + B);
        row.and_then(|row| row.first_chunk::<B>())
            .copied()
            .unwrap_or([N::from_f64(f64::NAN); B])
    };
    let square = tau * tau;
    let mut add = |j: usize, parity: usize| {
        let (row, power) = (block(j), N::from_f64(j as f64));
        for (k, c) in row.into_iter().enumerate() {
            q[parity][k] = q[parity][k] * square + c;
            v[parity][k] = v[parity][k] * square + power * c;
        }
    };
    let mut end = coefficients.len();
    if end % 2 == 1 {
        end -= 1;
        add(end, 0);
    }
    for j in (1..end / 2).rev() {
        add(2 * j + 1, 1);
        add(2 * j, 0);
    }
    let first = block(1);
    let (mut by_q, mut by_v) = (zeros, zeros);
    for k in 0..B {
        by_q[k] = (first[k] + (q[0][k] + q[1][k] * tau) * tau) * tau;
        by_v[k] = (v[0][k] + v[1][k] * tau) * tau;
    }
    [by_q, by_v]
}

/// Coordinates and rates at a time `tau` after the state that was expanded.
pub(crate) fn state<N: Real, V: Vector<N>>(coefficients: &[V], tau: N) -> (V, V) {
    let (mut q, mut v) = (coefficients[0].clone(), coefficients[1].clone());
    in_blocks!(q.as_slice().len(), |start, B| {
        let [by_q, by_v] = rises::<B, _, V>(coefficients, start, tau);
        for k in 0..B {
            let i = start + k;
            q.as_mut_slice()[i] = q.as_slice()[i] + by_q[k];
            v.as_mut_slice()[i] = v.as_slice()[i] + by_v[k];
        }
    });
    (q, v)
}

/// The accelerations there.
pub(crate) fn accelerations<V: Vector>(coefficients: &[V], tau: f64, a: &mut V) {
    for (i, a) in a.as_mut_slice().iter_mut().enumerate() {
        *a = 0.0;
        for j in (2..coefficients.len()).rev() {
            *a = *a * tau + (j * (j - 1)) as f64 * coefficients[j].as_slice()[i];
        }
    }
}
