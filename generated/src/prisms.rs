// @generated from machines/prisms.machine by `cargo xtask generate`; edits are lost.

//! Two prisms with Coulomb friction: one slides down on the other, which slides on the floor
//! (D. Đurić,
//! *On Brachistochronic Motion of a Multibody System with Real Constraints*, figure 1).
//!
//! The defaults are those of the paper's example, with 9.81 m/s² for the gravity that it does
//! not give.
//!
//! 2 coordinates, 6 parameters. Arithmetic of one call:
//!
//! | function | mul | add | div | sin cos | other | temporaries |
//! | --- | --: | --: | --: | --: | --: | --: |
//! | `prepare` | 28 | 11 | 3 | 1 | 0 | 44 |
//! | `slips` | 1 | 0 | 0 | 0 | 0 | 1 |
//! | `kinetic_energy` | 6 | 3 | 0 | 0 | 0 | 9 |
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

/// Two prisms with Coulomb friction: one slides down on the other, which slides on the floor
/// (D. Đurić,
/// *On Brachistochronic Motion of a Multibody System with Real Constraints*, figure 1).
///
/// The defaults are those of the paper's example, with 9.81 m/s² for the gravity that it does
/// not give.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prisms<S = f64> {
    /// Mass of the prism that slides down. Unit: `kg`. Default: 32/13.
    pub m: S,
    /// Mass of the prism on the floor. Unit: `kg`. Default: 20/13.
    pub M: S,
    /// Angle of the rough side to the horizontal. Unit: `rad`. Default: 0.25*pi.
    pub alpha: S,
    /// Coefficient of friction between the prisms. Unit: `1`. Default: 0.1.
    pub mu1: S,
    /// Coefficient of friction on the floor. Unit: `1`. Default: 0.02.
    pub mu2: S,
    /// Acceleration of gravity. Unit: `m/s^2`. Default: 9.81.
    pub g: S,
}

impl<S: ::lagrangian::emitted::Scalar> Prisms<S> {
    /// Computes what depends on the parameters alone, once.
    pub fn prepare(&self) -> Prepared<S> {
        let (sin_self_alpha, cos_self_alpha) = self.alpha.sin_cos();
        let m_plus_M = self.m + self.M;
        let t0 = self.m * self.g;
        let t1 = S::ONE / m_plus_M;
        let t2 = self.m * t1;
        let k3 = S::ONE / cos_self_alpha;
        let t3 = sin_self_alpha * self.m;
        let k0 = k3 * (t3 * self.g);
        let t4 = sin_self_alpha * k3;
        let k2 = k3 * (self.m * k3);
        let pivot_1 = k2 - self.m * t2;
        let t5 = S::ONE / pivot_1;
        let k13 = k3 * t5;
        let k10 = t2 * t5;
        let t6 = t3 * k13;
        let k11 = t1 + t2 * k10;
        let k5 = self.g * t6;
        let k6 = t2 * k5;
        let k7 = k3 * k5;
        let k1 = t4 * t4;
        let half_M = self.M * S::from_f64(0.5);
        let half_m = self.m * S::from_f64(0.5);
        let minus_m = -self.m;
        let k4 = -k0;
        let k8 = t0 + self.g * self.M - t3 * k7;
        let k9 = cos_self_alpha * t0 - t3 * k6;
        let k12 = t2 * k13;
        let k14 = k3 * k13;
        let k15 = -(t2 * t6);
        let k16 = -(t3 * k11);
        let k17 = -(k3 * t6);
        let pivots = [(0, m_plus_M, m_plus_M), (1, pivot_1, k2)];
        Prepared {
            k0,
            m_plus_M,
            k1,
            half_M,
            half_m,
            k2,
            k3,
            minus_m,
            k4,
            mu2: self.mu2,
            mu1: self.mu1,
            k5,
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
            k16,
            k17,
            singular: PIVOTS.vanished(pivots),
        }
    }

    /// The start values of the description, at rest and `t = 0`.
    pub fn start(&self) -> ::lagrangian::emitted::State<Coordinates<S>> {
        let zero = S::ZERO;
        let q = [zero, zero];
        let v = [S::ZERO; 2];
        ::lagrangian::emitted::State {
            t: 0.0,
            q: Coordinates::from_array(q),
            v: Coordinates::from_array(v),
        }
    }
}

/// The coordinates of [`Prisms`], or their rates, by name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coordinates<S = f64> {
    /// How far the prism on the floor has moved. Unit: `m`.
    pub q1: S,
    /// How far the other has moved on it, horizontally and to the other side. Unit: `m`.
    pub q2: S,
}

/// The parameters of a [`Prisms`], with the work done that depends on them alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prepared<S = f64> {
    /// `m*g*sin(alpha)/cos(alpha)`
    k0: S,
    /// `m + M`
    m_plus_M: S,
    /// `sin(alpha)^2/cos(alpha)^2`
    k1: S,
    /// `0.5*M`
    half_M: S,
    /// `0.5*m`
    half_m: S,
    /// `m/cos(alpha)^2`
    k2: S,
    /// `1/cos(alpha)`
    k3: S,
    /// `-m`
    minus_m: S,
    /// `-m*g*sin(alpha)/cos(alpha)`
    k4: S,
    /// `mu2`
    mu2: S,
    /// `mu1`
    mu1: S,
    /// `m*g*sin(alpha)/cos(alpha)/(m/cos(alpha)^2 - m^2/(m + M))`
    k5: S,
    /// `m^2*g*sin(alpha)/cos(alpha)/(m + M)/(m/cos(alpha)^2 - m^2/(m + M))`
    k6: S,
    /// `m*g*sin(alpha)/cos(alpha)^2/(m/cos(alpha)^2 - m^2/(m + M))`
    k7: S,
    /// `M*g + m*g - m^2*g*sin(alpha)^2/cos(alpha)^2/(m/cos(alpha)^2 - m^2/(m + M))`
    k8: S,
    /// `m*g*cos(alpha) - m^3*g*sin(alpha)^2/cos(alpha)/(m + M)/(m/cos(alpha)^2 - m^2/(m + M))`
    k9: S,
    /// `m/(m + M)/(m/cos(alpha)^2 - m^2/(m + M))`
    k10: S,
    /// `1/(m + M) + m^2/(m + M)^2/(m/cos(alpha)^2 - m^2/(m + M))`
    k11: S,
    /// `m/cos(alpha)/(m + M)/(m/cos(alpha)^2 - m^2/(m + M))`
    k12: S,
    /// `1/cos(alpha)/(m/cos(alpha)^2 - m^2/(m + M))`
    k13: S,
    /// `1/cos(alpha)^2/(m/cos(alpha)^2 - m^2/(m + M))`
    k14: S,
    /// `-m^2*sin(alpha)/cos(alpha)/(m + M)/(m/cos(alpha)^2 - m^2/(m + M))`
    k15: S,
    /// `-m*sin(alpha)*(1/(m + M) + m^2/(m + M)^2/(m/cos(alpha)^2 - m^2/(m + M)))`
    k16: S,
    /// `-m*sin(alpha)/cos(alpha)^2/(m/cos(alpha)^2 - m^2/(m + M))`
    k17: S,
    /// Why these parameters leave the machine without accelerations, if they do.
    singular: Option<::lagrangian::emitted::Singular>,
}

/// A pivot of an elimination that is not above this share of its diagonal element may be rounding
/// errors alone.
const PIVOTS: ::lagrangian::emitted::Pivots = ::lagrangian::emitted::Pivots::new(2, 2);

/// Mass matrix `M`.
///
/// ```text
/// M[q1, q1] = m + M
/// M[q2, q1] = -m
/// M[q2, q2] = m/cos(alpha)^2
/// ```
pub fn mass_matrix<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>) -> [[S; 2]; 2] {
    [[p.m_plus_M, p.minus_m], [p.minus_m, p.k2]]
}

/// Applied generalized forces `Q`.
///
/// ```text
/// Q[q2] = m*g*sin(alpha)/cos(alpha)
/// ```
pub fn applied<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>) -> [S; 2] {
    let zero = S::ZERO;
    [zero, p.k0]
}

/// Right-hand side `f = Q - h` of `M a = f`.
pub fn forces<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>) -> [S; 2] {
    let zero = S::ZERO;
    [zero, p.k0]
}

/// Slips `w` of the guided contacts, in m/s.
///
/// ```text
/// w[floor] = der(q1)
/// w[incline] = der(q2)/cos(alpha)
/// ```
pub fn slips<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, v: &[S; 2]) -> [S; 2] {
    let q1_dot = v[0];
    let q2_dot = v[1];
    let w2 = p.k3 * q2_dot;
    [q1_dot, w2]
}

/// Slip matrix `tau`, the derivatives of the slips by the rates.
///
/// ```text
/// tau[floor, q1] = 1
/// tau[incline, q2] = 1/cos(alpha)
/// ```
pub fn slip_matrix<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>) -> [S; 4] {
    let one = S::ONE;
    let zero = S::ZERO;
    [one, zero, zero, p.k3]
}

::lagrangian::emitted::fast_function! {
    /// Accelerations, multipliers, `dw/dt` and the normal reaction of each contact without
    /// friction, and the change of each by a unit of each friction force; followed by the
    /// coefficients of friction. A machine with guided contacts has this in place of accelerations
    /// and multipliers.
    ///
    /// A pivot that vanishes is an error.
    pub fn friction<'a, S>(Friction { p: &'a Prepared<S> })
        -> Result<[S; 22], ::lagrangian::emitted::Singular> = friction_in;
}

#[inline(always)]
fn friction_in<S: Copy, N: ::lagrangian::emitted::Scalar<Stored = S>>(
    call: Friction<'_, S>,
) -> Result<[S; 22], ::lagrangian::emitted::Singular> {
    let Friction { p } = call;
    let n = N::load;
    if let Some(singular) = p.singular {
        return Err(singular);
    }
    let friction = [
        n(p.k6).store(),
        n(p.k5).store(),
        n(p.k6).store(),
        n(p.k7).store(),
        n(p.k8).store(),
        n(p.k9).store(),
        n(p.k11).store(),
        n(p.k10).store(),
        n(p.k11).store(),
        n(p.k12).store(),
        n(p.k15).store(),
        n(p.k16).store(),
        n(p.k12).store(),
        n(p.k13).store(),
        n(p.k12).store(),
        n(p.k14).store(),
        n(p.k17).store(),
        n(p.k15).store(),
        n(p.mu2).store(),
        n(p.mu1).store(),
        n(p.mu2).store(),
        n(p.mu1).store(),
    ];
    Ok(friction)
}

/// Kinetic energy `T`, in J.
///
/// ```text
/// T = 1/2*(m + M)*der(q1)^2 - m*der(q1)*der(q2) + 1/2*m*der(q2)^2/cos(alpha)^2
/// ```
pub fn kinetic_energy<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, v: &[S; 2]) -> S {
    let q1_dot = v[0];
    let q2_dot = v[1];
    let t0 = q1_dot - q2_dot;
    let t1 = p.half_m * (q2_dot * (q2_dot * p.k1) + t0 * t0);
    t1 + q1_dot * (q1_dot * p.half_M)
}

/// Potential energy `V`, in J.
///
/// ```text
/// V = -m*g*sin(alpha)*q2/cos(alpha)
/// ```
pub fn potential_energy<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 2]) -> S {
    let q2 = q[1];
    p.k4 * q2
}

::lagrangian::emitted::implement! {
    machine Prisms "Prisms" over S, R;
    parameters { m, M, alpha, mu1, mu2, g } [
        m: "m" "kg" = 2.4615384615384617;
        M: "M" "kg" = 1.5384615384615385;
        alpha: "alpha" "rad" = 0.7853981633974483;
        mu1: "mu1" "1" = 0.1;
        mu2: "mu2" "1" = 0.02;
        g: "g" "m/s^2" = 9.81;
    ]
    coordinates 2 Coordinates { q1, q2 } [
        q1: "q1" "m";
        q2: "q2" "m";
    ]
    inputs Inputs {} [], defined here
    outputs Outputs {} [], defined here
    prepared Prepared {
        k0, m_plus_M, k1, half_M, half_m, k2, k3, minus_m, k4, mu2, mu1, k5, k6, k7, k8, k9, k10,
        k11, k12, k13, k14, k15, k16, k17,
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
        names contacts(p) = ["floor", "incline"];
        ranges slip_ranges(p, v) = slips(p, v);
        solved friction(p, t, q, v, u) = friction(p);
        workspace with_workspace(p) = ::lagrangian::emitted::contact_workspace(2, 0, 2);
    }
    absent [MAY_BE_CONSTRAINED MAY_COLLIDE]
    intervals [yes]
    lanes []
    numbers []
}
