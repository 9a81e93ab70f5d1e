//! Dense output: the motion within a step.

use crate::methods::{MAX_STAGES, Method};
use crate::scalar::Scalar;
use crate::stages::{stage_state, weigh_one};
use crate::step_error::StepError;
use crate::step_number::{Real, StepNumber};
use crate::{Vector, compensated::Sum};

/// The largest number of coefficients of a polynomial: four of the cubic, and those of the method.
const MAX_COEFFICIENTS: usize = 9;

/// The motion from one end of a step to the other, as polynomials in time.
///
/// With `θ = (t − t₀)/h` and `ϑ = 1 − θ`
///
/// ```text
/// y(θ) = c₀ + θ (c₁ + ϑ (c₂ + θ (c₃ + ϑ (c₄ + θ (c₅ + …)))))
/// ```
///
/// in steps of Runge–Kutta methods, where `c₀ … c₃` form the cubic through values and slopes at both ends, and the others,
/// `h Σⱼ dⱼ kⱼ`, depend on the method. E. Hairer, S. P. Nørsett, G. Wanner, *Solving Ordinary Differential Equations I*, 2nd ed.,
/// 1993, section II.6. In steps by Taylor series it is the polynomial of the step itself.
///
/// The numbers `N` are those of the step.
#[derive(Clone, Debug)]
pub struct Interpolant<V, N = f64> {
    start: Sum<N>,
    h: N,
    curve: Curve<V>,
}

/// The polynomials of a step.
#[derive(Clone, Debug)]
enum Curve<V> {
    /// The polynomials of a Runge–Kutta method.
    Stages(Stages<V>),
    /// The Taylor coefficients of the coordinates.
    #[cfg(feature = "std")]
    Series(std::vec::Vec<V>),
}

/// `c₀ …` of coordinates and rates.
#[derive(Clone, Debug)]
struct Stages<V> {
    length: usize,
    q: [V; MAX_COEFFICIENTS],
    v: [V; MAX_COEFFICIENTS],
}

/// The ends of a step: time at its beginning, length, states before and after.
pub(crate) struct Ends<'a, V, N = f64> {
    pub start: Sum<N>,
    pub h: N,
    pub q: [&'a V; 2],
    pub v: [&'a V; 2],
}

impl<N: StepNumber + Scalar<Stored = N>, V: Vector<N>> Interpolant<V, N> {
    /// The polynomials of a step of `method` with the accelerations `k`. Calls `accelerations(t, q, v, a)` for stages beyond those
    /// of the step and stores their accelerations in `k`.
    pub(crate) fn new(
        method: &Method,
        ends: &Ends<'_, V, N>,
        k: &mut [V; MAX_STAGES],
        mut accelerations: impl FnMut(N, &V, &V, &mut V) -> Result<(), StepError>,
    ) -> Result<Self, StepError> {
        let (tableau, scheme) = (&method.tableau, &method.scheme);
        let &Ends {
            start,
            h,
            q: [q0, q1],
            v: [v0, v1],
        } = ends;
        let n = q0.as_slice().len();
        let zeros = q0.zeros_like();
        let mut interpolant = Stages {
            length: 4 + scheme.dense_length,
            q: zeros.several_zeros_like(),
            v: zeros.several_zeros_like(),
        };

        for stage in tableau.stages + 1..scheme.length {
            let ch = h.weighted(tableau.c[stage], scheme.c_beyond[stage]);
            // The vectors of coefficients that are not yet set hold the state of the stage.
            let (q, v) = (&mut interpolant.q[0], &mut interpolant.v[0]);
            stage_state::<N, _>((&scheme.rows[stage], ch, h), [q0, v0], k, [q, v]);
            accelerations(start.high + (start.low + ch), q, v, &mut k[stage])?;
        }

        let (a0, a1) = (&k[0], &k[tableau.stages]);
        for i in 0..n {
            let at = |vector: &V| vector.as_slice()[i];
            let q = cubic([at(q0), at(q1)], [h * at(v0), h * at(v1)]);
            let v = cubic([at(v0), at(v1)], [h * at(a0), h * at(a1)]);
            for power in 0..4 {
                interpolant.q[power].as_mut_slice()[i] = q[power];
                interpolant.v[power].as_mut_slice()[i] = v[power];
            }
            for (row, power) in scheme.dense[..scheme.dense_length].iter().zip(4..) {
                let [position, velocity] = weigh_one(row, k, i);
                interpolant.q[power].as_mut_slice()[i] = h * h * position;
                interpolant.v[power].as_mut_slice()[i] = h * velocity;
            }
        }
        Ok(Self {
            start,
            h,
            curve: Curve::Stages(interpolant),
        })
    }
}

impl<V: Vector> Interpolant<V> {
    /// The quintic through both ends of a step, their rates and the accelerations `a`. The rates are its derivative.
    pub(crate) fn quintic(ends: &Ends<'_, V>, [a0, a1]: [&V; 2]) -> Self {
        let &Ends {
            start,
            h,
            q: [q0, q1],
            v: [v0, v1],
        } = ends;
        let zeros = q0.zeros_like();
        let mut curve = Stages {
            length: 6,
            q: zeros.several_zeros_like(),
            v: zeros.several_zeros_like(),
        };
        for i in 0..zeros.as_slice().len() {
            let at = |vector: &V| vector.as_slice()[i];
            let (slopes, bends) = ([h * at(v0), h * at(v1)], [h * at(a0), h * at(a1)]);
            let mut q = [0.0; 6];
            q[..4].copy_from_slice(&cubic([at(q0), at(q1)], slopes));
            let [_, rise, bend, twist, c4, c5] = &mut q;
            // Second derivatives of the cubic are −2 bend + 2 twist and −2 bend − 4 twist.
            *c4 = 0.5 * h * bends[0] + *bend - *twist;
            *c5 = 0.5 * h * bends[1] + *bend + 2.0 * *twist - *c4;
            // The integral of the rates is the rise. That of θ² (1 − θ)² is 1/30.
            let of_cubic = 0.5 * (slopes[0] + slopes[1]) + h * (bends[0] - bends[1]) / 12.0;
            let of_rate = 30.0 * (*rise - of_cubic) / h;
            let v = cubic([at(v0), at(v1)], bends);
            for (row, q) in curve.q.iter_mut().zip(q) {
                row.as_mut_slice()[i] = q;
            }
            for (row, v) in curve.v.iter_mut().zip(v) {
                row.as_mut_slice()[i] = v;
            }
            curve.v[4].as_mut_slice()[i] = of_rate;
        }
        Self {
            start,
            h,
            curve: Curve::Stages(curve),
        }
    }

    /// The motion in a step of length `h`, from its Taylor coefficients.
    #[cfg(feature = "std")]
    pub(crate) fn of_series(start: Sum, h: f64, coefficients: &[V]) -> Self {
        Self {
            start,
            h,
            curve: Curve::Series(coefficients.to_vec()),
        }
    }
}

impl<V> Stages<V> {
    /// Coordinates and rates at the fraction `theta` of the step.
    fn state_at<N: Real>(&self, theta: N, q: &mut V, v: &mut V)
    where
        V: Vector<N>,
    {
        evaluate(&self.q[..self.length], theta, q);
        evaluate(&self.v[..self.length], theta, v);
    }
}

impl<N: Real, V: Vector<N>> Interpolant<V, N> {
    /// Coordinates and rates at time `t`, which should be in the step.
    pub fn state(&self, t: N) -> (V, V) {
        self.state_at(((t - self.start.high) - self.start.low) / self.h)
    }

    /// Coordinates and rates at the fraction `theta` of the step.
    pub fn state_at(&self, theta: N) -> (V, V) {
        match &self.curve {
            Curve::Stages(stages) => {
                let zeros = || stages.q[0].zeros_like();
                let (mut q, mut v) = (zeros(), zeros());
                stages.state_at(theta, &mut q, &mut v);
                (q, v)
            }
            #[cfg(feature = "std")]
            Curve::Series(coefficients) => crate::taylor::state(coefficients, theta * self.h),
        }
    }

    /// [`state_at`](Self::state_at) into existing vectors.
    #[cfg(feature = "std")]
    pub(crate) fn state_into(&self, theta: N, [q, v]: [&mut V; 2]) {
        match &self.curve {
            Curve::Stages(stages) => stages.state_at(theta, q, v),
            #[cfg(feature = "std")]
            Curve::Series(_) => (*q, *v) = self.state_at(theta),
        }
    }

    /// Time at the fraction `theta` of the step, in s.
    pub fn time_at(&self, theta: N) -> N {
        self.start.high + (self.start.low + theta * self.h)
    }
}

/// `c₀ … c₃` for values and slopes (times `h`) at both ends.
#[inline(always)]
fn cubic<N: StepNumber>([y0, y1]: [N; 2], [slope0, slope1]: [N; 2]) -> [N; 4] {
    let rise = y1 - y0;
    let bend = slope0 - rise;
    [y0, rise, bend, rise - slope1 - bend]
}

fn evaluate<N: Real, V: Vector<N>>(coefficients: &[V], theta: N, y: &mut V) {
    y.as_mut_slice().fill(N::ZERO);
    for power in (1..coefficients.len()).rev() {
        let factor = if power % 2 == 1 {
            theta
        } else {
            N::ONE - theta
        };
        for (y, c) in y
            .as_mut_slice()
            .iter_mut()
            .zip(coefficients[power].as_slice())
        {
            *y = factor * (*c + *y);
        }
    }
    for (y, c) in y.as_mut_slice().iter_mut().zip(coefficients[0].as_slice()) {
        *y = *y + *c;
    }
}

/// Coordinates and rates at the fraction `theta` of a step of length `h`, from its ends alone: the quintic through positions,
/// velocities and accelerations. It costs no evaluation and is of order 5, which is accurate enough for the search for events.
pub(crate) fn hermite<N: Real, V: Vector<N>>(
    h: N,
    [q0, q1]: [&V; 2],
    [v0, v1]: [&V; 2],
    [a0, a1]: [&V; 2],
    theta: N,
) -> (V, V) {
    let (half, two, three) = (N::from_f64(0.5), N::from_f64(2.0), N::from_f64(3.0));
    let (mut q, mut v) = (q0.zeros_like(), v0.zeros_like());
    for i in 0..q0.as_slice().len() {
        let at = |vector: &V| vector.as_slice()[i];
        let (slope0, slope1) = (h * at(v0), h * at(v1));
        let (bend0, bend1) = (half * h * h * at(a0), half * h * h * at(a1));
        // Newton's divided differences over the nodes 0, 0, 0, 1, 1, 1.
        let rise = at(q1) - at(q0);
        let (d01, d11) = (rise - slope0, slope1 - rise);
        let (e001, e011, e111) = (d01 - bend0, d11 - d01, bend1 - d11);
        let (f0, f1) = (e011 - e001, e111 - e011);
        let g = f1 - f0;
        let s = theta - N::ONE;
        // q = q₀ + θ slope₀ + θ² bend₀ + θ³ (e₀ + s (f₀ + s g)), and its derivative
        let inner = e001 + s * (f0 + s * g);
        let inner_slope = f0 + two * s * g;
        q.as_mut_slice()[i] = at(q0) + theta * (slope0 + theta * (bend0 + theta * inner));
        v.as_mut_slice()[i] =
            (slope0 + theta * (two * bend0 + theta * (three * inner + theta * inner_slope))) / h;
    }
    (q, v)
}
