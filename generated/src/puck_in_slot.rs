// @generated from machines/puck_in_slot.machine by `cargo xtask generate`; edits are lost.

//! A puck in a slot between two planes that lie on a slope and hold it from both sides; it is
//! thrown across the slope. Friction is
//! opposite to its slip, which turns towards the fall line.
//!
//! With κ = μ/tan α, speed v and angle φ from the fall line, v (cos φ + κ) changes at the rate g
//! sin α (1 − κ²). For κ = 1 it
//! is constant, and the speed of a puck that starts along a level line with v approaches v/2 down
//! the slope.
//!
//! 2 coordinates, 7 parameters. Arithmetic of one call:
//!
//! | function | mul | add | div | sin cos | other | temporaries |
//! | --- | --: | --: | --: | --: | --: | --: |
//! | `prepare` | 16 | 10 | 2 | 1 | 2 | 32 |
//! | `start` | 2 | 0 | 0 | 1 | 0 | 4 |
//! | `slips` | 2 | 0 | 0 | 0 | 0 | 2 |
//! | `kinetic_energy` | 3 | 1 | 0 | 0 | 0 | 4 |
//! | `potential_energy` | 1 | 0 | 0 | 0 | 0 | 1 |
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

/// A puck in a slot between two planes that lie on a slope and hold it from both sides; it is
/// thrown across the slope. Friction is
/// opposite to its slip, which turns towards the fall line.
///
/// With κ = μ/tan α, speed v and angle φ from the fall line, v (cos φ + κ) changes at the rate g
/// sin α (1 − κ²). For κ = 1 it
/// is constant, and the speed of a puck that starts along a level line with v approaches v/2 down
/// the slope.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PuckInSlot<S = f64> {
    /// Mass of the puck. Unit: `kg`. Default: 0.16.
    pub m: S,
    /// Slope, speed, and direction from the fall line. Unit: `rad`. Default: 0.4.
    pub alpha: S,
    /// `v`. Unit: `m/s`. Default: 3.
    pub v: S,
    /// `phi`. Unit: `rad`. Default: 2.
    pub phi: S,
    /// Coefficient of friction while it slides. Unit: `1`. Default: 0.6.
    pub mu: S,
    /// Coefficient of friction while it sticks. Unit: `1`. Default: 0.6.
    pub mu0: S,
    /// Acceleration of gravity. Unit: `m/s^2`. Default: 9.81.
    pub g: S,
}

impl<S: ::lagrangian::emitted::Scalar> PuckInSlot<S> {
    /// Computes what depends on the parameters alone, once.
    pub fn prepare(&self) -> Prepared<S> {
        let (sin_self_alpha, cos_self_alpha) = self.alpha.sin_cos();
        let t0 = S::ONE / self.m;
        let k6 = sin_self_alpha * self.g;
        let t1 = (cos_self_alpha + S::from_f64(0.3125)).sign();
        let k3 = self.m * k6;
        let k2 = t1 + S::ONE - t1.abs();
        let t2 = sin_self_alpha * k2;
        let k13 = k2 * t0;
        let t3 = sin_self_alpha * t2;
        let t4 = S::ONE - t3 / (cos_self_alpha + k2);
        let k4 = t3 + cos_self_alpha * t4;
        let k10 = k4 * t0;
        let half_m = self.m * S::from_f64(0.5);
        let k5 = -k3;
        let k7 = k6 * k4;
        let k8 = cos_self_alpha * k3;
        let k9 = self.m * self.g - sin_self_alpha * k3;
        let k11 = k4 * k10;
        let k12 = t2 - sin_self_alpha * k4;
        let k14 = k2 * k13;
        let k15 = cos_self_alpha * k4 - t4;
        let pivots = [(0, self.m, self.m), (1, self.m, self.m)];
        Prepared {
            m: self.m,
            k0: cos_self_alpha,
            k1: sin_self_alpha,
            k2,
            half_m,
            k3,
            k4,
            k5,
            mu: self.mu,
            mu0: self.mu0,
            k6,
            k7,
            k8,
            k9,
            k10,
            k11,
            k12,
            k13,
            k14,
            k15,
            singular: PIVOTS.vanished(pivots),
        }
    }

    /// The start values of the description, at `t = 0`.
    pub fn start(&self) -> ::lagrangian::emitted::State<Coordinates<S>> {
        let (sin_self_phi, cos_self_phi) = self.phi.sin_cos();
        let zero = S::ZERO;
        let x_rate = self.v * cos_self_phi;
        let y_rate = self.v * sin_self_phi;
        let q = [zero, zero];
        let v = [x_rate, y_rate];
        ::lagrangian::emitted::State {
            t: 0.0,
            q: Coordinates::from_array(q),
            v: Coordinates::from_array(v),
        }
    }
}

/// The coordinates of [`PuckInSlot`], or their rates, by name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coordinates<S = f64> {
    /// Down the slope and across it. Unit: `m`.
    pub x: S,
    /// `y`. Unit: `m`.
    pub y: S,
}

/// The parameters of a [`PuckInSlot`], with the work done that depends on them alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prepared<S = f64> {
    /// `m`
    m: S,
    /// `cos(alpha)`
    k0: S,
    /// `sin(alpha)`
    k1: S,
    /// `1 + sign(cos(alpha) + 0.3125) - abs(sign(cos(alpha) + 0.3125))`
    k2: S,
    /// `0.5*m`
    half_m: S,
    /// `m*g*sin(alpha)`
    k3: S,
    /// `sin(alpha)^2*(1 + sign(cos(alpha) + 0.3125) - abs(sign(cos(alpha) + 0.3125))) +
    /// cos(alpha)*(1 - sin(…`
    k4: S,
    /// `-m*g*sin(alpha)`
    k5: S,
    /// `mu`
    mu: S,
    /// `mu0`
    mu0: S,
    /// `g*sin(alpha)`
    k6: S,
    /// `g*sin(alpha)*(sin(alpha)^2*(1 + sign(cos(alpha) + 0.3125) - abs(sign(cos(alpha) + 0.3125)))
    /// + cos(al…`
    k7: S,
    /// `m*g*cos(alpha)*sin(alpha)`
    k8: S,
    /// `m*g - m*g*sin(alpha)^2`
    k9: S,
    /// `(sin(alpha)^2*(1 + sign(cos(alpha) + 0.3125) - abs(sign(cos(alpha) + 0.3125))) +
    /// cos(alpha)*(1 - sin…`
    k10: S,
    /// `(sin(alpha)^2*(1 + sign(cos(alpha) + 0.3125) - abs(sign(cos(alpha) + 0.3125))) +
    /// cos(alpha)*(1 - sin…`
    k11: S,
    /// `sin(alpha)*(1 + sign(cos(alpha) + 0.3125) - abs(sign(cos(alpha) + 0.3125)))
    /// - sin(alpha)*(sin(alpha)…`
    k12: S,
    /// `(1 + sign(cos(alpha) + 0.3125) - abs(sign(cos(alpha) + 0.3125)))/m`
    k13: S,
    /// `(1 + sign(cos(alpha) + 0.3125) - abs(sign(cos(alpha) + 0.3125)))^2/m`
    k14: S,
    /// `-(1 - sin(alpha)^2*(1 + sign(cos(alpha) + 0.3125) - abs(sign(cos(alpha) +
    /// 0.3125)))/(cos(alpha) + 1 …`
    k15: S,
    /// Why these parameters leave the machine without accelerations, if they do.
    singular: Option<::lagrangian::emitted::Singular>,
}

/// A pivot of an elimination that is not above this share of its diagonal element may be rounding
/// errors alone.
const PIVOTS: ::lagrangian::emitted::Pivots = ::lagrangian::emitted::Pivots::new(2, 2);

/// Mass matrix `M`.
///
/// ```text
/// M[x, x] = m
/// M[y, y] = m
/// ```
pub fn mass_matrix<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>) -> [[S; 2]; 2] {
    let zero = S::ZERO;
    [[p.m, zero], [zero, p.m]]
}

/// Applied generalized forces `Q`.
///
/// ```text
/// Q[x] = m*g*sin(alpha)
/// ```
pub fn applied<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>) -> [S; 2] {
    let zero = S::ZERO;
    [p.k3, zero]
}

/// Right-hand side `f = Q - h` of `M a = f`.
pub fn forces<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>) -> [S; 2] {
    let zero = S::ZERO;
    [p.k3, zero]
}

/// Slips `w` of the guided contacts, in m/s.
///
/// ```text
/// w[slot] = ((1 - ((sign(cos(alpha) + 5/16) + 1) - abs(sign(cos(alpha) +
///     5/16)))*sin(alpha)^2/(cos(alpha) + ((sign(cos(alpha) + 5/16) + 1) - abs(sign(cos(alpha) +
///     5/16)))))*cos(alpha) + ((sign(cos(alpha) + 5/16) + 1) - abs(sign(cos(alpha) +
///     5/16)))*sin(alpha)^2)*der(x)
/// w[slot.across] = (sign(cos(alpha) + 5/16) - abs(sign(cos(alpha) + 5/16)) + 1)*der(y)
/// ```
pub fn slips<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, v: &[S; 2]) -> [S; 2] {
    let x_dot = v[0];
    let y_dot = v[1];
    let w1 = p.k4 * x_dot;
    let w2 = p.k2 * y_dot;
    [w1, w2]
}

/// Slip matrix `tau`, the derivatives of the slips by the rates.
///
/// ```text
/// tau[slot, x] = (1 - ((sign(cos(alpha) + 5/16) + 1) - abs(sign(cos(alpha) +
///     5/16)))*sin(alpha)^2/(cos(alpha) + ((sign(cos(alpha) + 5/16) + 1) - abs(sign(cos(alpha) +
///     5/16)))))*cos(alpha)
///     + ((sign(cos(alpha) + 5/16) + 1) - abs(sign(cos(alpha) + 5/16)))*sin(alpha)^2
/// tau[slot.across, y] = sign(cos(alpha) + 5/16) - abs(sign(cos(alpha) + 5/16)) + 1
/// ```
pub fn slip_matrix<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>) -> [S; 4] {
    let zero = S::ZERO;
    [p.k4, zero, zero, p.k2]
}

::lagrangian::emitted::fast_function! {
    /// Accelerations, multipliers, `dw/dt` and the normal reaction of each contact without
    /// friction, and the change of each by a unit of each friction force; followed by the
    /// coefficients of friction. A machine with guided contacts has this in place of accelerations
    /// and multipliers.
    ///
    /// A pivot that vanishes is an error.
    pub fn friction<'a, S>(Friction { p: &'a Prepared<S> })
        -> Result<[S; 40], ::lagrangian::emitted::Singular> = friction_in;
}

#[inline(always)]
fn friction_in<S: Copy, N: ::lagrangian::emitted::Scalar<Stored = S>>(
    call: Friction<'_, S>,
) -> Result<[S; 40], ::lagrangian::emitted::Singular> {
    let Friction { p } = call;
    let n = N::load;
    if let Some(singular) = p.singular {
        return Err(singular);
    }
    let zero = N::ZERO;
    let friction = [
        n(p.k6).store(),
        zero.store(),
        n(p.k7).store(),
        zero.store(),
        n(p.k8).store(),
        zero.store(),
        n(p.k9).store(),
        n(p.k8).store(),
        zero.store(),
        n(p.k9).store(),
        n(p.k10).store(),
        zero.store(),
        n(p.k11).store(),
        zero.store(),
        n(p.k15).store(),
        zero.store(),
        n(p.k12).store(),
        n(p.k15).store(),
        zero.store(),
        n(p.k12).store(),
        zero.store(),
        n(p.k13).store(),
        zero.store(),
        n(p.k14).store(),
        zero.store(),
        zero.store(),
        zero.store(),
        zero.store(),
        zero.store(),
        zero.store(),
        n(p.mu).store(),
        n(p.mu).store(),
        n(p.mu0).store(),
        n(p.mu0).store(),
        n(p.k1).store(),
        zero.store(),
        n(p.k0).store(),
        n(p.k1).store(),
        zero.store(),
        n(p.k0).store(),
    ];
    Ok(friction)
}

/// Kinetic energy `T`, in J.
///
/// ```text
/// T = 1/2*m*der(x)^2 + 1/2*m*der(y)^2
/// ```
pub fn kinetic_energy<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, v: &[S; 2]) -> S {
    let x_dot = v[0];
    let y_dot = v[1];
    p.half_m * (y_dot * y_dot + x_dot * x_dot)
}

/// Potential energy `V`, in J.
///
/// ```text
/// V = -m*g*sin(alpha)*x
/// ```
pub fn potential_energy<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 2]) -> S {
    let x = q[0];
    p.k5 * x
}

::lagrangian::emitted::implement! {
    machine PuckInSlot "PuckInSlot" over S, R;
    parameters { m, alpha, v, phi, mu, mu0, g } [
        m: "m" "kg" = 0.16;
        alpha: "alpha" "rad" = 0.4;
        v: "v" "m/s" = 3.0;
        phi: "phi" "rad" = 2.0;
        mu: "mu" "1" = 0.6;
        mu0: "mu0" "1" = 0.6;
        g: "g" "m/s^2" = 9.81;
    ]
    coordinates 2 Coordinates { x, y } [
        x: "x" "m";
        y: "y" "m";
    ]
    inputs Inputs {} [], defined here
    outputs Outputs {} [], defined here
    prepared Prepared {
        m, k0, k1, k2, half_m, k3, k4, k5, mu, mu0, k6, k7, k8, k9, k10, k11, k12, k13, k14, k15,
    }
    singular singular
    accelerations friction
    system {
        matrix mass_matrix(p, t, q) = mass_matrix(p);
        vector bias(p, t, q, v);
        vector applied(p, t, q, v, u) = applied(p);
        vector forces(p, t, q, v, u) = forces(p);
        numbers slips(p, t, q, v) = slips(p, v);
        numbers slip_matrix(p, t, q) = slip_matrix(p);
        numbers slip_bias(p, t, q, v);
        number kinetic_energy(p, t, q, v) = kinetic_energy(p, v);
        number potential_energy(p, t, q, u) = potential_energy(p, q);
        number dissipation(p, t, q, v, u);
        number work_rate(p, t, q, v, a, u);
        number dissipation_rate(p, t, q, v, u);
        outputs outputs(p, t, q, v, a, u) = Outputs {};
        names contacts(p) = ["slot", "slot.across"];
        count reaction_axes(p) = 3;
        bits second_tangents(p) = 2;
        ranges slip_ranges(p, v) = slips(p, v);
        solved friction(p, t, q, v, u) = friction(p);
        workspace with_workspace(p) = ::lagrangian::emitted::contact_workspace_in_space(2, 0, 2);
    }
    absent [MAY_BE_CONSTRAINED MAY_COLLIDE]
    intervals [yes]
    lanes []
    numbers []
}
