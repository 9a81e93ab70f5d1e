// @generated from machines/wedge_and_block.machine by `cargo xtask generate`; edits are lost.

//! A block slides down a wedge that slides on a table: the normal forces of both depend on both
//! accelerations.
//!
//! 2 coordinates, 6 parameters. Arithmetic of one call:
//!
//! | function | mul | add | div | sin cos | other | temporaries |
//! | --- | --: | --: | --: | --: | --: | --: |
//! | `prepare` | 20 | 11 | 2 | 1 | 0 | 35 |
//! | `kinetic_energy` | 7 | 3 | 0 | 0 | 0 | 10 |
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

/// A block slides down a wedge that slides on a table: the normal forces of both depend on both
/// accelerations.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WedgeAndBlock<S = f64> {
    /// Mass of the wedge. Unit: `kg`. Default: 3.
    pub M: S,
    /// Mass of the block. Unit: `kg`. Default: 1.
    pub m: S,
    /// Angle of the wedge. Unit: `rad`. Default: (1/6)*pi.
    pub alpha: S,
    /// Coefficient of friction between block and wedge. Unit: `1`. Default: 0.1.
    pub mu1: S,
    /// Coefficient of friction between wedge and table. Unit: `1`. Default: 0.02.
    pub mu2: S,
    /// Acceleration of gravity. Unit: `m/s^2`. Default: 9.81.
    pub g: S,
}

impl<S: ::lagrangian::emitted::Scalar> WedgeAndBlock<S> {
    /// Computes what depends on the parameters alone, once.
    pub fn prepare(&self) -> Prepared<S> {
        let (sin_self_alpha, cos_self_alpha) = self.alpha.sin_cos();
        let M_plus_m = self.m + self.M;
        let t0 = S::ONE / M_plus_m;
        let k3 = self.m * cos_self_alpha;
        let t1 = self.m * sin_self_alpha;
        let t2 = k3 * t0;
        let k2 = t1 * self.g;
        let pivot_1 = self.m - k3 * t2;
        let k6 = S::ONE / pivot_1;
        let t3 = t1 * k6;
        let t4 = t2 * k6;
        let k5 = self.g * t3;
        let k9 = t0 + t2 * t4;
        let k10 = t2 * t3;
        let t5 = t1 * k5;
        let k1 = sin_self_alpha * sin_self_alpha;
        let half_M = S::from_f64(0.5) * self.M;
        let half_m = self.m * S::from_f64(0.5);
        let k4 = -k2;
        let k7 = self.m * self.g + self.g * self.M - t5;
        let k8 = self.g * k3 - t2 * t5;
        let k11 = t1 * k9;
        let k12 = -(t2 * k5);
        let k13 = -t4;
        let k14 = -t3;
        let k15 = -k10;
        let pivots = [(0, M_plus_m, M_plus_m), (1, pivot_1, self.m)];
        Prepared {
            m: self.m,
            k0: cos_self_alpha,
            k1,
            k2,
            half_M,
            half_m,
            k3,
            M_plus_m,
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

/// The coordinates of [`WedgeAndBlock`], or their rates, by name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coordinates<S = f64> {
    /// How far the wedge has moved. Unit: `m`.
    pub x: S,
    /// How far the block has slid down the wedge. Unit: `m`.
    pub s: S,
}

/// The parameters of a [`WedgeAndBlock`], with the work done that depends on them alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prepared<S = f64> {
    /// `m`
    m: S,
    /// `cos(alpha)`
    k0: S,
    /// `sin(alpha)^2`
    k1: S,
    /// `m*g*sin(alpha)`
    k2: S,
    /// `0.5*M`
    half_M: S,
    /// `0.5*m`
    half_m: S,
    /// `m*cos(alpha)`
    k3: S,
    /// `M + m`
    M_plus_m: S,
    /// `-m*g*sin(alpha)`
    k4: S,
    /// `mu2`
    mu2: S,
    /// `mu1`
    mu1: S,
    /// `m*g*sin(alpha)/(m - m^2*cos(alpha)^2/(M + m))`
    k5: S,
    /// `1/(m - m^2*cos(alpha)^2/(M + m))`
    k6: S,
    /// `M*g + m*g - m^2*g*sin(alpha)^2/(m - m^2*cos(alpha)^2/(M + m))`
    k7: S,
    /// `m*g*cos(alpha) - m^3*g*cos(alpha)*sin(alpha)^2/(M + m)/(m - m^2*cos(alpha)^2/(M + m))`
    k8: S,
    /// `1/(M + m) + m^2*cos(alpha)^2/(M + m)^2/(m - m^2*cos(alpha)^2/(M + m))`
    k9: S,
    /// `m^2*cos(alpha)*sin(alpha)/(M + m)/(m - m^2*cos(alpha)^2/(M + m))`
    k10: S,
    /// `m*sin(alpha)*(1/(M + m) + m^2*cos(alpha)^2/(M + m)^2/(m - m^2*cos(alpha)^2/(M + m)))`
    k11: S,
    /// `-m^2*g*cos(alpha)*sin(alpha)/(M + m)/(m - m^2*cos(alpha)^2/(M + m))`
    k12: S,
    /// `-m*cos(alpha)/(M + m)/(m - m^2*cos(alpha)^2/(M + m))`
    k13: S,
    /// `-m*sin(alpha)/(m - m^2*cos(alpha)^2/(M + m))`
    k14: S,
    /// `-m^2*cos(alpha)*sin(alpha)/(M + m)/(m - m^2*cos(alpha)^2/(M + m))`
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
/// M[x, x] = M + m
/// M[s, x] = m*cos(alpha)
/// M[s, s] = m
/// ```
pub fn mass_matrix<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>) -> [[S; 2]; 2] {
    [[p.M_plus_m, p.k3], [p.k3, p.m]]
}

/// Applied generalized forces `Q`.
///
/// ```text
/// Q[s] = m*g*sin(alpha)
/// ```
pub fn applied<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>) -> [S; 2] {
    let zero = S::ZERO;
    [zero, p.k2]
}

/// Right-hand side `f = Q - h` of `M a = f`.
pub fn forces<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>) -> [S; 2] {
    let zero = S::ZERO;
    [zero, p.k2]
}

/// Slips `w` of the guided contacts, in m/s.
///
/// ```text
/// w[table] = der(x)
/// w[slope] = der(s)
/// ```
pub fn slips<S: ::lagrangian::emitted::Scalar>(v: &[S; 2]) -> [S; 2] {
    let x_dot = v[0];
    let s_dot = v[1];
    [x_dot, s_dot]
}

/// Slip matrix `tau`, the derivatives of the slips by the rates.
///
/// ```text
/// tau[table, x] = 1
/// tau[slope, s] = 1
/// ```
pub fn slip_matrix<S: ::lagrangian::emitted::Scalar>() -> [S; 4] {
    let one = S::ONE;
    let zero = S::ZERO;
    [one, zero, zero, one]
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
        n(p.k12).store(),
        n(p.k5).store(),
        n(p.k12).store(),
        n(p.k5).store(),
        n(p.k7).store(),
        n(p.k8).store(),
        n(p.k9).store(),
        n(p.k13).store(),
        n(p.k9).store(),
        n(p.k13).store(),
        n(p.k10).store(),
        n(p.k11).store(),
        n(p.k13).store(),
        n(p.k6).store(),
        n(p.k13).store(),
        n(p.k6).store(),
        n(p.k14).store(),
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
/// T = 1/2*(M + m)*der(x)^2 + m*cos(alpha)*der(x)*der(s) + 1/2*m*der(s)^2
/// ```
pub fn kinetic_energy<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, v: &[S; 2]) -> S {
    let x_dot = v[0];
    let s_dot = v[1];
    let t0 = s_dot * p.k0 + x_dot;
    let t1 = p.half_m * (s_dot * (s_dot * p.k1) + t0 * t0);
    t1 + x_dot * (x_dot * p.half_M)
}

/// Potential energy `V`, in J.
///
/// ```text
/// V = -m*g*sin(alpha)*s
/// ```
pub fn potential_energy<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 2]) -> S {
    let s = q[1];
    p.k4 * s
}

::lagrangian::emitted::implement! {
    machine WedgeAndBlock "WedgeAndBlock" over S, R;
    parameters { M, m, alpha, mu1, mu2, g } [
        M: "M" "kg" = 3.0;
        m: "m" "kg" = 1.0;
        alpha: "alpha" "rad" = 0.5235987755982989;
        mu1: "mu1" "1" = 0.1;
        mu2: "mu2" "1" = 0.02;
        g: "g" "m/s^2" = 9.81;
    ]
    coordinates 2 Coordinates { x, s } [
        x: "x" "m";
        s: "s" "m";
    ]
    inputs Inputs {} [], defined here
    outputs Outputs {} [], defined here
    prepared Prepared {
        m, k0, k1, k2, half_M, half_m, k3, M_plus_m, k4, mu2, mu1, k5, k6, k7, k8, k9, k10, k11,
        k12, k13, k14, k15,
    }
    singular singular
    accelerations friction
    system {
        matrix mass_matrix(p, t, q) = mass_matrix(p);
        vector bias(p, t, q, v);
        vector applied(p, t, q, v, u) = applied(p);
        vector forces(p, t, q, v, u) = forces(p);
        numbers slips(p, t, q, v) = slips(v);
        numbers slip_matrix(p, t, q) = slip_matrix();
        numbers slip_bias(p, t, q, v);
        number kinetic_energy(p, t, q, v) = kinetic_energy(p, v);
        number potential_energy(p, t, q, u) = potential_energy(p, q);
        number dissipation(p, t, q, v, u);
        number work_rate(p, t, q, v, a, u);
        number dissipation_rate(p, t, q, v, u);
        outputs outputs(p, t, q, v, a, u) = Outputs {};
        names contacts(p) = ["table", "slope"];
        ranges slip_ranges(v) = slips(v);
        solved friction(p, t, q, v, u) = friction(p);
        workspace with_workspace(p) = ::lagrangian::emitted::contact_workspace(2, 0, 2);
    }
    absent [MAY_BE_CONSTRAINED MAY_COLLIDE]
    intervals []
    lanes []
    numbers []
}
