// @generated from machines/block_on_incline.machine by `cargo xtask generate`; edits are lost.

//! A block on an incline whose angle may grow with time: it sticks until tan α exceeds the
//! coefficient of friction, and then slides.
//!
//! 1 coordinate, 6 parameters. Arithmetic of one call:
//!
//! | function | mul | add | div | sin cos | other | temporaries |
//! | --- | --: | --: | --: | --: | --: | --: |
//! | `prepare` | 7 | 2 | 1 | 0 | 0 | 10 |
//! | `bias` | 1 | 0 | 0 | 0 | 0 | 1 |
//! | `applied` | 4 | 9 | 0 | 1 | 0 | 10 |
//! | `forces` | 5 | 10 | 0 | 1 | 0 | 12 |
//! | `friction` | 16 | 16 | 0 | 1 | 0 | 29 |
//! | `kinetic_energy` | 12 | 13 | 0 | 1 | 0 | 22 |
//! | `potential_energy` | 5 | 9 | 0 | 1 | 0 | 11 |
//! | `work_rate` | 16 | 15 | 0 | 1 | 0 | 28 |
//!
//! Sine and cosine of one angle count once; subtractions and changes of sign are additions. A
//! function that is not here gives zeros.

// A program uses some of it.
#![allow(dead_code, unreachable_pub)]
// Names and numbers are those of the description.
#![allow(non_snake_case, non_camel_case_types)]
#![allow(clippy::approx_constant, clippy::upper_case_acronyms)]
// Formulas are written as derived.
#![allow(clippy::let_and_return, clippy::too_many_arguments)]
#![allow(clippy::just_underscores_and_digits, clippy::excessive_precision)]
#![allow(clippy::pedantic, clippy::nursery)]
// What the description says is no Markdown.
#![allow(rustdoc::all)]

/// A block on an incline whose angle may grow with time: it sticks until tan α exceeds the
/// coefficient of friction, and then slides.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BlockOnIncline<S = f64> {
    /// Mass of the block. Unit: `kg`. Default: 2.
    pub m: S,
    /// Angle of the incline at t = 0. Unit: `rad`. Default: 0.3.
    pub alpha: S,
    /// How fast the incline is raised. Unit: `rad/s`. Default: 0.
    pub rate: S,
    /// Coefficient of friction while it slides. Unit: `1`. Default: 0.4.
    pub mu: S,
    /// Coefficient of friction while it sticks. Unit: `1`. Default: 0.5.
    pub mu0: S,
    /// Acceleration of gravity. Unit: `m/s^2`. Default: 9.81.
    pub g: S,
}

impl<S: ::lagrangian::emitted::Scalar> BlockOnIncline<S> {
    /// Computes what depends on the parameters alone, once.
    pub fn prepare(&self) -> Prepared<S> {
        let m_rate = self.m * self.rate;
        let m_g = self.m * self.g;
        let half_m = self.m * S::from_f64(0.5);
        let rate2 = self.rate * self.rate;
        let two_rate = self.rate * S::from_f64(2.0);
        let m_rate_g = self.g * m_rate;
        let minus_m_rate2 = -(self.rate * m_rate);
        let minus_m_g = -m_g;
        let inverse_m = S::ONE / self.m;
        let pivots = [(0, self.m, self.m)];
        Prepared {
            m: self.m,
            alpha: self.alpha,
            rate: self.rate,
            g: self.g,
            half_m,
            m_g,
            rate2,
            two_rate,
            m_rate_g,
            m_rate,
            minus_m_rate2,
            minus_m_g,
            mu: self.mu,
            mu0: self.mu0,
            inverse_m,
            singular: PIVOTS.vanished(pivots),
        }
    }

    /// The start values of the description, at rest and `t = 0`.
    pub fn start(&self) -> ::lagrangian::emitted::State<Coordinates<S>> {
        let zero = S::ZERO;
        let q = [zero];
        let v = [S::ZERO; 1];
        ::lagrangian::emitted::State {
            t: 0.0,
            q: Coordinates::from_array(q),
            v: Coordinates::from_array(v),
        }
    }
}

/// The coordinates of [`BlockOnIncline`], or their rates, by name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coordinates<S = f64> {
    /// How far the block has slid down, along the incline. Unit: `m`.
    pub s: S,
}

/// The parameters of a [`BlockOnIncline`], with the work done that depends on them alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prepared<S = f64> {
    /// `m`
    m: S,
    /// `alpha`
    alpha: S,
    /// `rate`
    rate: S,
    /// `g`
    g: S,
    /// `0.5*m`
    half_m: S,
    /// `m*g`
    m_g: S,
    /// `rate^2`
    rate2: S,
    /// `2*rate`
    two_rate: S,
    /// `m*rate*g`
    m_rate_g: S,
    /// `m*rate`
    m_rate: S,
    /// `-m*rate^2`
    minus_m_rate2: S,
    /// `-m*g`
    minus_m_g: S,
    /// `mu`
    mu: S,
    /// `mu0`
    mu0: S,
    /// `1/m`
    inverse_m: S,
    /// Why these parameters leave the machine without accelerations, if they do.
    singular: Option<::lagrangian::emitted::Singular>,
}

/// A pivot of an elimination that is not above this share of its diagonal element may be rounding
/// errors alone.
const PIVOTS: ::lagrangian::emitted::Pivots = ::lagrangian::emitted::Pivots::new(1, 1);

/// Mass matrix `M`.
///
/// ```text
/// M[s, s] = m
/// ```
pub fn mass_matrix<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>) -> [[S; 1]; 1] {
    [[p.m]]
}

/// Bias `h`: velocity products and explicit time in the inertia forces.
///
/// ```text
/// h[s] = -m*rate^2*s
/// ```
pub fn bias<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 1]) -> [S; 1] {
    let s = q[0];
    let h_s = p.minus_m_rate2 * s;
    [h_s]
}

/// Applied generalized forces `Q`.
///
/// ```text
/// Q[s] = m*g*sin(rate*t + alpha)
/// ```
pub fn applied<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, t: S) -> [S; 1] {
    let t0 = p.rate * t;
    let t1 = t0 + p.alpha;
    let (sin_t1, cos_t1) = t1.sin_cos();
    let t2 = sin_t1 + (t0.sum_error(p.alpha) + p.rate.product_error(t)) * cos_t1;
    let q_s = p.m_g * t2;
    [q_s]
}

/// Right-hand side `f = Q - h` of `M a = f`.
pub fn forces<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, t: S, q: &[S; 1]) -> [S; 1] {
    let s = q[0];
    let t0 = p.rate * t;
    let t1 = t0 + p.alpha;
    let (sin_t1, cos_t1) = t1.sin_cos();
    let t2 = sin_t1 + cos_t1 * (p.rate.product_error(t) + t0.sum_error(p.alpha));
    let f_s = t2 * p.m_g - p.minus_m_rate2 * s;
    [f_s]
}

/// Slips `w` of the guided contacts, in m/s.
///
/// ```text
/// w[face] = der(s)
/// ```
pub fn slips<S: ::lagrangian::emitted::Scalar>(v: &[S; 1]) -> [S; 1] {
    let s_dot = v[0];
    [s_dot]
}

/// Slip matrix `tau`, the derivatives of the slips by the rates.
///
/// ```text
/// tau[face, s] = 1
/// ```
pub fn slip_matrix<S: ::lagrangian::emitted::Scalar>() -> [S; 1] {
    let one = S::ONE;
    [one]
}

::lagrangian::emitted::fast_function! {
    /// Accelerations, multipliers, `dw/dt` and the normal reaction of each contact without
    /// friction, and the change of each by a unit of each friction force; followed by the
    /// coefficients of friction. A machine with guided contacts has this in place of accelerations
    /// and multipliers.
    ///
    /// A pivot that vanishes is an error.
    pub fn friction<'a, S>(Friction { p: &'a Prepared<S>, t: S, q: &'a [S; 1], v: &'a [S; 1] })
        -> Result<[S; 8], ::lagrangian::emitted::Singular> = friction_in;
}

#[inline(always)]
fn friction_in<S: Copy, N: ::lagrangian::emitted::Scalar<Stored = S>>(
    call: Friction<'_, S>,
) -> Result<[S; 8], ::lagrangian::emitted::Singular> {
    let Friction { p, t, q, v } = call;
    let n = N::load;
    if let Some(singular) = p.singular {
        return Err(singular);
    }
    let s = n(q[0]);
    let s_dot = n(v[0]);
    let t0 = n(p.rate) * n(t);
    let t1 = s * n(p.rate2);
    let t2 = n(p.two_rate) * s_dot;
    let t3 = t0 + n(p.alpha);
    let (sin_t3, cos_t3) = t3.sin_cos();
    let t4 = n(p.rate).product_error(n(t)) + t0.sum_error(n(p.alpha));
    let t5 = cos_t3.mul_add(t4, sin_t3);
    let t6 = sin_t3.neg_mul_add(t4, cos_t3);
    let t7 = t5.mul_sub(n(p.m_g), s * n(p.minus_m_rate2));
    let r0 = t7 * n(p.inverse_m);
    let t8 = n(p.g) - t2.mul_sub(t6, t1 * t5);
    let t9 = t6.neg_mul_add(t8, t5 * t2.mul_add(t5, t1 * t6)) * n(p.m);
    let r2 = -t9;
    let zero = N::ZERO;
    let friction = [
        r0.store(),
        r0.store(),
        r2.store(),
        n(p.inverse_m).store(),
        n(p.inverse_m).store(),
        zero.store(),
        n(p.mu).store(),
        n(p.mu0).store(),
    ];
    Ok(friction)
}

/// Kinetic energy `T`, in J.
///
/// ```text
/// T = 1/2*m*der(s)^2 + 1/2*m*rate^2*s^2
/// ```
pub fn kinetic_energy<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    t: S,
    q: &[S; 1],
    v: &[S; 1],
) -> S {
    let s = q[0];
    let s_dot = v[0];
    let t0 = p.rate * t;
    let t1 = s * p.rate;
    let t2 = t0 + p.alpha;
    let (sin_t2, cos_t2) = t2.sin_cos();
    let t3 = t0.sum_error(p.alpha) + p.rate.product_error(t);
    let t4 = sin_t2 + t3 * cos_t2;
    let t5 = cos_t2 - t3 * sin_t2;
    let t6 = t5 * s_dot - t1 * t4;
    let t7 = t1 * t5 + t4 * s_dot;
    p.half_m * (t7 * t7 + t6 * t6)
}

/// Potential energy `V`, in J.
///
/// ```text
/// V = -m*g*sin(rate*t + alpha)*s
/// ```
pub fn potential_energy<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, t: S, q: &[S; 1]) -> S {
    let s = q[0];
    let t0 = p.rate * t;
    let t1 = t0 + p.alpha;
    let (sin_t1, cos_t1) = t1.sin_cos();
    let t2 = sin_t1 + (t0.sum_error(p.alpha) + p.rate.product_error(t)) * cos_t1;
    t2 * (p.minus_m_g * s)
}

/// Power `P` supplied by drives, forces and inputs, in W.
///
/// ```text
/// P = 2*m*rate^2*s*der(s) - m*rate*g*cos(rate*t + alpha)*s
/// ```
pub fn work_rate<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    t: S,
    q: &[S; 1],
    v: &[S; 1],
    a: &[S; 1],
) -> S {
    let s = q[0];
    let s_dot = v[0];
    let s_ddot = a[0];
    let t0 = p.rate * t;
    let t1 = p.two_rate * s_dot;
    let t2 = t0 + p.alpha;
    let t3 = s * p.rate2 - s_ddot;
    let (sin_t2, cos_t2) = t2.sin_cos();
    let t4 = p.rate.product_error(t) + t0.sum_error(p.alpha);
    let t5 = sin_t2 + cos_t2 * t4;
    let t6 = cos_t2 - sin_t2 * t4;
    let t7 = s * p.m_rate * (t5 * (t1 * t5 + t3 * t6) + t6 * (t1 * t6 - t3 * t5));
    t7 - s * p.m_rate_g * t6
}

::lagrangian::emitted::implement! {
    machine BlockOnIncline "BlockOnIncline" over S, R;
    parameters { m, alpha, rate, mu, mu0, g } [
        m: "m" "kg" = 2.0;
        alpha: "alpha" "rad" = 0.3;
        rate: "rate" "rad/s" = 0.0;
        mu: "mu" "1" = 0.4;
        mu0: "mu0" "1" = 0.5;
        g: "g" "m/s^2" = 9.81;
    ]
    coordinates 1 Coordinates { s } [
        s: "s" "m";
    ]
    inputs Inputs {} [], defined here
    outputs Outputs {} [], defined here
    prepared Prepared {
        m, alpha, rate, g, half_m, m_g, rate2, two_rate, m_rate_g, m_rate, minus_m_rate2, minus_m_g,
        mu, mu0, inverse_m,
    }
    singular singular
    accelerations friction
    system {
        matrix mass_matrix(p, t, q) = mass_matrix(p);
        vector bias(p, t, q, v) = bias(p, q);
        vector applied(p, t, q, v, u) = applied(p, t);
        vector forces(p, t, q, v, u) = forces(p, t, q);
        numbers slips(p, t, q, v) = slips(v);
        numbers slip_matrix(p, t, q) = slip_matrix();
        numbers slip_bias(p, t, q, v);
        number kinetic_energy(p, t, q, v) = kinetic_energy(p, t, q, v);
        number potential_energy(p, t, q, u) = potential_energy(p, t, q);
        number dissipation(p, t, q, v, u);
        number work_rate(p, t, q, v, a, u) = work_rate(p, t, q, v, a);
        number dissipation_rate(p, t, q, v, u);
        outputs outputs(p, t, q, v, a, u) = Outputs {};
        names contacts(p) = ["face"];
        ranges slip_ranges(v) = slips(v);
        solved friction(p, t, q, v, u) = friction(p, t, q, v);
        workspace with_workspace(p) = ::lagrangian::emitted::contact_workspace(1, 0, 1);
    }
    absent [MAY_BE_CONSTRAINED MAY_COLLIDE]
    intervals []
    lanes []
    numbers []
}
