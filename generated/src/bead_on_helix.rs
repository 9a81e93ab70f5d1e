// @generated from machines/bead_on_helix.machine by `cargo xtask generate`; edits are lost.

//! A bead on a rough helix about a vertical axis, under gravity. The wire holds it in two
//! directions: against the centrifugal
//! force, which grows with the speed, and against its weight. Therefore the bead approaches a speed
//! at which friction balances gravity.
//!
//! 1 coordinate, 6 parameters. Arithmetic of one call:
//!
//! | function | mul | add | div | sin cos | other | temporaries |
//! | --- | --: | --: | --: | --: | --: | --: |
//! | `prepare` | 20 | 8 | 2 | 0 | 1 | 31 |
//! | `slips` | 1 | 0 | 0 | 0 | 0 | 1 |
//! | `friction` | 10 | 4 | 0 | 1 | 0 | 16 |
//! | `kinetic_energy` | 2 | 0 | 0 | 0 | 0 | 2 |
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

/// A bead on a rough helix about a vertical axis, under gravity. The wire holds it in two
/// directions: against the centrifugal
/// force, which grows with the speed, and against its weight. Therefore the bead approaches a speed
/// at which friction balances gravity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BeadOnHelix<S = f64> {
    /// Mass of the bead. Unit: `kg`. Default: 0.01.
    pub m: S,
    /// Radius of the helix. Unit: `m`. Default: 0.2.
    pub r: S,
    /// How far the helix goes down for each radian. Unit: `m`. Default: 0.1.
    pub h: S,
    /// Coefficient of friction while it slides. Unit: `1`. Default: 0.3.
    pub mu: S,
    /// Coefficient of friction while it sticks. Unit: `1`. Default: 0.4.
    pub mu0: S,
    /// Acceleration of gravity. Unit: `m/s^2`. Default: 9.81.
    pub g: S,
}

impl<S: ::lagrangian::emitted::Scalar> BeadOnHelix<S> {
    /// Computes what depends on the parameters alone, once.
    pub fn prepare(&self) -> Prepared<S> {
        let t0 = self.m * self.h;
        let m_r = self.m * self.r;
        let t1 = self.r * self.r + self.h * self.h;
        let m_h_g = t0 * self.g;
        let k2 = t1.sqrt();
        let k1 = self.r * m_r + self.h * t0;
        let t2 = S::ONE / k1;
        let k4 = m_h_g * t2;
        let t3 = S::ONE / k2;
        let k8 = k2 * t2;
        let k3 = self.r * t3;
        let t4 = self.h * t3;
        let k0 = t1 * (self.m * S::from_f64(0.5));
        let minus_m_h_g = -m_h_g;
        let k5 = m_h_g * k8;
        let k6 = m_r * k4;
        let k7 = self.m * self.g - t0 * k4;
        let k9 = k2 * k8;
        let k10 = k3 - m_r * k8;
        let k11 = t4 - t0 * k8;
        let k12 = -k3;
        let k13 = -t4;
        let pivots = [(0, k1, k1)];
        Prepared {
            k0,
            m_h_g,
            k1,
            k2,
            minus_m_h_g,
            k3,
            mu: self.mu,
            mu0: self.mu0,
            m_r,
            k4,
            k5,
            k6,
            k7,
            k8,
            k9,
            k10,
            k11,
            k12,
            k13,
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

/// The coordinates of [`BeadOnHelix`], or their rates, by name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coordinates<S = f64> {
    /// How far the bead has gone around. Unit: `rad`.
    pub theta: S,
}

/// The parameters of a [`BeadOnHelix`], with the work done that depends on them alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prepared<S = f64> {
    /// `0.5*m*(h^2 + r^2)`
    k0: S,
    /// `m*h*g`
    m_h_g: S,
    /// `m*h^2 + m*r^2`
    k1: S,
    /// `sqrt(h^2 + r^2)`
    k2: S,
    /// `-m*h*g`
    minus_m_h_g: S,
    /// `r/sqrt(h^2 + r^2)`
    k3: S,
    /// `mu`
    mu: S,
    /// `mu0`
    mu0: S,
    /// `m*r`
    m_r: S,
    /// `m*h*g/(m*h^2 + m*r^2)`
    k4: S,
    /// `m*h*g*sqrt(h^2 + r^2)/(m*h^2 + m*r^2)`
    k5: S,
    /// `m^2*r*h*g/(m*h^2 + m*r^2)`
    k6: S,
    /// `m*g - m^2*h^2*g/(m*h^2 + m*r^2)`
    k7: S,
    /// `sqrt(h^2 + r^2)/(m*h^2 + m*r^2)`
    k8: S,
    /// `sqrt(h^2 + r^2)^2/(m*h^2 + m*r^2)`
    k9: S,
    /// `r/sqrt(h^2 + r^2) - m*r*sqrt(h^2 + r^2)/(m*h^2 + m*r^2)`
    k10: S,
    /// `h/sqrt(h^2 + r^2) - m*h*sqrt(h^2 + r^2)/(m*h^2 + m*r^2)`
    k11: S,
    /// `-r/sqrt(h^2 + r^2)`
    k12: S,
    /// `-h/sqrt(h^2 + r^2)`
    k13: S,
    /// Why these parameters leave the machine without accelerations, if they do.
    singular: Option<::lagrangian::emitted::Singular>,
}

/// A pivot of an elimination that is not above this share of its diagonal element may be rounding
/// errors alone.
const PIVOTS: ::lagrangian::emitted::Pivots = ::lagrangian::emitted::Pivots::new(1, 1);

/// Mass matrix `M`.
///
/// ```text
/// M[theta, theta] = m*r^2 + m*h^2
/// ```
pub fn mass_matrix<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>) -> [[S; 1]; 1] {
    [[p.k1]]
}

/// Applied generalized forces `Q`.
///
/// ```text
/// Q[theta] = m*h*g
/// ```
pub fn applied<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>) -> [S; 1] {
    [p.m_h_g]
}

/// Right-hand side `f = Q - h` of `M a = f`.
pub fn forces<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>) -> [S; 1] {
    [p.m_h_g]
}

/// Slips `w` of the guided contacts, in m/s.
///
/// ```text
/// w[wire] = sqrt(r^2 + h^2)*der(theta)
/// ```
pub fn slips<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, v: &[S; 1]) -> [S; 1] {
    let theta_dot = v[0];
    let w1 = p.k2 * theta_dot;
    [w1]
}

/// Slip matrix `tau`, the derivatives of the slips by the rates.
///
/// ```text
/// tau[wire, theta] = sqrt(r^2 + h^2)
/// ```
pub fn slip_matrix<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>) -> [S; 1] {
    [p.k2]
}

::lagrangian::emitted::fast_function! {
    /// Accelerations, multipliers, `dw/dt` and the normal reaction of each contact without
    /// friction, and the change of each by a unit of each friction force; followed by the
    /// coefficients of friction. A machine with guided contacts has this in place of accelerations
    /// and multipliers.
    ///
    /// A pivot that vanishes is an error.
    pub fn friction<'a, S>(Friction { p: &'a Prepared<S>, q: &'a [S; 1], v: &'a [S; 1] })
        -> Result<[S; 15], ::lagrangian::emitted::Singular> = friction_in;
}

#[inline(always)]
fn friction_in<S: Copy, N: ::lagrangian::emitted::Scalar<Stored = S>>(
    call: Friction<'_, S>,
) -> Result<[S; 15], ::lagrangian::emitted::Singular> {
    let Friction { p, q, v } = call;
    let n = N::load;
    if let Some(singular) = p.singular {
        return Err(singular);
    }
    let theta = n(q[0]);
    let theta_dot = n(v[0]);
    let (sin_theta, cos_theta) = theta.sin_cos();
    let t0 = theta_dot * (theta_dot * n(p.m_r));
    let r2 = -t0.mul_add(cos_theta, sin_theta * n(p.k6));
    let r3 = cos_theta.mul_sub(n(p.k6), t0 * sin_theta);
    let r7 = sin_theta * n(p.k10);
    let r8 = -(cos_theta * n(p.k10));
    let r12 = sin_theta * n(p.k12);
    let r13 = cos_theta * n(p.k3);
    let friction = [
        n(p.k4).store(),
        n(p.k5).store(),
        r2.store(),
        r3.store(),
        n(p.k7).store(),
        n(p.k8).store(),
        n(p.k9).store(),
        r7.store(),
        r8.store(),
        n(p.k11).store(),
        n(p.mu).store(),
        n(p.mu0).store(),
        r12.store(),
        r13.store(),
        n(p.k13).store(),
    ];
    Ok(friction)
}

/// Kinetic energy `T`, in J.
///
/// ```text
/// T = 1/2*(r^2 + h^2)*m*der(theta)^2
/// ```
pub fn kinetic_energy<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, v: &[S; 1]) -> S {
    let theta_dot = v[0];
    theta_dot * (theta_dot * p.k0)
}

/// Potential energy `V`, in J.
///
/// ```text
/// V = -m*h*g*theta
/// ```
pub fn potential_energy<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 1]) -> S {
    let theta = q[0];
    p.minus_m_h_g * theta
}

::lagrangian::emitted::implement! {
    machine BeadOnHelix "BeadOnHelix" over S, R;
    parameters { m, r, h, mu, mu0, g } [
        m: "m" "kg" = 0.01;
        r: "r" "m" = 0.2;
        h: "h" "m" = 0.1;
        mu: "mu" "1" = 0.3;
        mu0: "mu0" "1" = 0.4;
        g: "g" "m/s^2" = 9.81;
    ]
    coordinates 1 Coordinates { theta } [
        theta: "theta" "rad";
    ]
    inputs Inputs {} [], defined here
    outputs Outputs {} [], defined here
    prepared Prepared {
        k0, m_h_g, k1, k2, minus_m_h_g, k3, mu, mu0, m_r, k4, k5, k6, k7, k8, k9, k10, k11, k12,
        k13,
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
        names contacts(p) = ["wire"];
        count reaction_axes(p) = 3;
        ranges slip_ranges(p, v) = slips(p, v);
        solved friction(p, t, q, v, u) = friction(p, q, v);
        workspace with_workspace(p) = ::lagrangian::emitted::contact_workspace_in_space(1, 0, 1);
    }
    absent [MAY_BE_CONSTRAINED MAY_COLLIDE]
    intervals [yes]
    lanes []
    numbers []
}
