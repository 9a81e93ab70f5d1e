// @generated from machines/stick_slip.machine by `cargo xtask generate`; edits are lost.

//! A block on a moving belt, held by a spring: the belt drags it along until the spring tears it
//! loose, it slips back, and is caught again.
//!
//! 1 coordinate, 6 parameters. Arithmetic of one call:
//!
//! | function | mul | add | div | sin cos | other | temporaries |
//! | --- | --: | --: | --: | --: | --: | --: |
//! | `prepare` | 3 | 1 | 1 | 0 | 0 | 5 |
//! | `applied` | 1 | 0 | 0 | 0 | 0 | 1 |
//! | `forces` | 1 | 0 | 0 | 0 | 0 | 1 |
//! | `slips` | 0 | 1 | 0 | 0 | 0 | 1 |
//! | `friction` | 2 | 0 | 0 | 0 | 0 | 2 |
//! | `kinetic_energy` | 2 | 0 | 0 | 0 | 0 | 2 |
//! | `potential_energy` | 2 | 0 | 0 | 0 | 0 | 2 |
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

/// A block on a moving belt, held by a spring: the belt drags it along until the spring tears it
/// loose, it slips back, and is caught again.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StickSlip<S = f64> {
    /// Mass of the block. Unit: `kg`. Default: 1.
    pub m: S,
    /// Stiffness of the spring. Unit: `N/m`. Default: 1.
    pub k: S,
    /// Speed of the belt. Unit: `m/s`. Default: 0.2.
    pub v_b: S,
    /// Coefficient of friction while the block slips. Unit: `1`. Default: 0.5.
    pub mu: S,
    /// Coefficient of friction while it sticks. Unit: `1`. Default: 1.
    pub mu0: S,
    /// Acceleration of gravity. Unit: `m/s^2`. Default: 1.
    pub g: S,
}

impl<S: ::lagrangian::emitted::Scalar> StickSlip<S> {
    /// Computes what depends on the parameters alone, once.
    pub fn prepare(&self) -> Prepared<S> {
        let half_m = self.m * S::from_f64(0.5);
        let half_k = self.k * S::from_f64(0.5);
        let minus_k = -self.k;
        let m_g = self.m * self.g;
        let inverse_m = S::ONE / self.m;
        let pivots = [(0, self.m, self.m)];
        Prepared {
            m: self.m,
            v_b: self.v_b,
            half_m,
            half_k,
            minus_k,
            mu: self.mu,
            mu0: self.mu0,
            m_g,
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

/// The coordinates of [`StickSlip`], or their rates, by name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coordinates<S = f64> {
    /// Stretch of the spring. Unit: `m`.
    pub x: S,
}

/// The parameters of a [`StickSlip`], with the work done that depends on them alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prepared<S = f64> {
    /// `m`
    m: S,
    /// `v_b`
    v_b: S,
    /// `0.5*m`
    half_m: S,
    /// `0.5*k`
    half_k: S,
    /// `-k`
    minus_k: S,
    /// `mu`
    mu: S,
    /// `mu0`
    mu0: S,
    /// `m*g`
    m_g: S,
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
/// M[x, x] = m
/// ```
pub fn mass_matrix<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>) -> [[S; 1]; 1] {
    [[p.m]]
}

/// Applied generalized forces `Q`.
///
/// ```text
/// Q[x] = -k*x
/// ```
pub fn applied<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 1]) -> [S; 1] {
    let x = q[0];
    let q_x = p.minus_k * x;
    [q_x]
}

/// Right-hand side `f = Q - h` of `M a = f`.
pub fn forces<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 1]) -> [S; 1] {
    let x = q[0];
    let f_x = p.minus_k * x;
    [f_x]
}

/// Slips `w` of the guided contacts, in m/s.
///
/// ```text
/// w[belt] = der(x) - v_b
/// ```
pub fn slips<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, v: &[S; 1]) -> [S; 1] {
    let x_dot = v[0];
    let w1 = x_dot - p.v_b;
    [w1]
}

/// Slip matrix `tau`, the derivatives of the slips by the rates.
///
/// ```text
/// tau[belt, x] = 1
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
    pub fn friction<'a, S>(Friction { p: &'a Prepared<S>, q: &'a [S; 1] })
        -> Result<[S; 8], ::lagrangian::emitted::Singular> = friction_in;
}

#[inline(always)]
fn friction_in<S: Copy, N: ::lagrangian::emitted::Scalar<Stored = S>>(
    call: Friction<'_, S>,
) -> Result<[S; 8], ::lagrangian::emitted::Singular> {
    let Friction { p, q } = call;
    let n = N::load;
    if let Some(singular) = p.singular {
        return Err(singular);
    }
    let x = n(q[0]);
    let r0 = x * n(p.minus_k) * n(p.inverse_m);
    let zero = N::ZERO;
    let friction = [
        r0.store(),
        r0.store(),
        n(p.m_g).store(),
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
/// T = 1/2*m*der(x)^2
/// ```
pub fn kinetic_energy<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, v: &[S; 1]) -> S {
    let x_dot = v[0];
    x_dot * (x_dot * p.half_m)
}

/// Potential energy `V`, in J.
///
/// ```text
/// V = 1/2*k*x^2
/// ```
pub fn potential_energy<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 1]) -> S {
    let x = q[0];
    x * (x * p.half_k)
}

::lagrangian::emitted::implement! {
    machine StickSlip "StickSlip" over S, R;
    parameters { m, k, v_b, mu, mu0, g } [
        m: "m" "kg" = 1.0;
        k: "k" "N/m" = 1.0;
        v_b: "v_b" "m/s" = 0.2;
        mu: "mu" "1" = 0.5;
        mu0: "mu0" "1" = 1.0;
        g: "g" "m/s^2" = 1.0;
    ]
    coordinates 1 Coordinates { x } [
        x: "x" "m";
    ]
    inputs Inputs {} [], defined here
    outputs Outputs {} [], defined here
    prepared Prepared { m, v_b, half_m, half_k, minus_k, mu, mu0, m_g, inverse_m }
    singular singular
    accelerations friction
    system {
        matrix mass_matrix(p, t, q) = mass_matrix(p);
        vector bias(p, t, q, v);
        vector applied(p, t, q, v, u) = applied(p, q);
        vector forces(p, t, q, v, u) = forces(p, q);
        numbers slips(p, t, q, v) = slips(p, v);
        numbers slip_matrix(p, t, q) = slip_matrix();
        numbers slip_bias(p, t, q, v);
        number kinetic_energy(p, t, q, v) = kinetic_energy(p, v);
        number potential_energy(p, t, q, u) = potential_energy(p, q);
        number dissipation(p, t, q, v, u);
        number work_rate(p, t, q, v, a, u);
        number dissipation_rate(p, t, q, v, u);
        outputs outputs(p, t, q, v, a, u) = Outputs {};
        names contacts(p) = ["belt"];
        ranges slip_ranges(p, v) = slips(p, v);
        solved friction(p, t, q, v, u) = friction(p, q);
        workspace with_workspace(p) = ::lagrangian::emitted::contact_workspace(1, 0, 1);
    }
    absent [MAY_BE_CONSTRAINED MAY_COLLIDE]
    intervals [yes]
    lanes []
    numbers []
}
