// @generated from machines/closed_pendulum.machine by `cargo xtask generate`; edits are lost.

//! Five equal uniform bars that hang in a row between two pins, d apart on one level. Angles are
//! absolute, from the line through the pins; two constraints leave three degrees of freedom.
//!
//! 5 coordinates, 4 parameters. Arithmetic of one call:
//!
//! | function | mul | add | div | sin cos | other | temporaries |
//! | --- | --: | --: | --: | --: | --: | --: |
//! | `prepare` | 35 | 7 | 2 | 0 | 0 | 44 |
//! | `start` | 2 | 2 | 0 | 0 | 0 | 4 |
//! | `mass_matrix` | 30 | 10 | 0 | 5 | 0 | 50 |
//! | `bias` | 42 | 27 | 0 | 5 | 0 | 79 |
//! | `applied` | 5 | 0 | 0 | 5 | 0 | 10 |
//! | `forces` | 44 | 38 | 0 | 5 | 0 | 92 |
//! | `constraint_positions` | 2 | 9 | 0 | 5 | 0 | 21 |
//! | `constraint_rates` | 12 | 8 | 0 | 5 | 0 | 30 |
//! | `constraint_matrix` | 10 | 0 | 0 | 5 | 0 | 20 |
//! | `constraint_bias` | 17 | 8 | 0 | 5 | 0 | 35 |
//! | `accelerations` | 258 | 179 | 6 | 5 | 0 | 453 |
//! | `multipliers` | 205 | 125 | 6 | 5 | 0 | 346 |
//! | `projection` | 185 | 123 | 6 | 5 | 0 | 324 |
//! | `kinetic_energy` | 52 | 26 | 0 | 5 | 0 | 88 |
//! | `potential_energy` | 10 | 11 | 0 | 5 | 0 | 26 |
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

/// Five equal uniform bars that hang in a row between two pins, d apart on one level. Angles are
/// absolute, from the line through the pins; two constraints leave three degrees of freedom.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClosedPendulum<S = f64> {
    /// Length and mass of a bar, inertia about its middle, distance of the pins. Unit: `m`.
    /// Default: 1.
    pub l: S,
    /// `m`. Unit: `kg`. Default: 1.
    pub m: S,
    /// `d`. Unit: `m`. Default: 2.
    pub d: S,
    /// `g`. Unit: `m/s^2`. Default: 9.81.
    pub g: S,
}

impl<S: ::lagrangian::emitted::Scalar> ClosedPendulum<S> {
    /// Computes what depends on the parameters alone, once.
    pub fn prepare(&self) -> Prepared<S> {
        let t0 = self.l * self.m;
        let t1 = self.l * t0;
        let t2 = self.g * t0;
        let t3 = S::from_ratio(1, 6);
        let t4 = S::from_ratio(4, 3);
        let t5 = S::from_ratio(1, 3);
        let k9 = t1 * t5;
        let t6 = self.l * self.l;
        let t7 = S::ONE / self.l;
        let inverse_m = S::ONE / self.m;
        let t8 = t7 * t7 * inverse_m;
        let half_l = self.l * S::from_f64(0.5);
        let k0 = t1 * S::from_ratio(1, 12);
        let m_g = self.m * self.g;
        let k1 = t1 * t3;
        let half_l_squared_m = S::from_f64(0.5) * t1;
        let k2 = t1 * S::from_f64(1.5);
        let k3 = t1 * S::from_f64(2.5);
        let k4 = t1 * S::from_f64(3.5);
        let k5 = t1 * S::from_ratio(13, 3);
        let k6 = t1 * S::from_ratio(10, 3);
        let k7 = t1 * S::from_ratio(7, 3);
        let k8 = t1 * t4;
        let half_m = self.m * S::from_f64(0.5);
        let quarter_l_m = t0 * S::from_f64(0.25);
        let half_l_m = S::from_f64(0.5) * t0;
        let minus_l = -self.l;
        let k10 = -(t2 * S::from_f64(4.5));
        let k11 = -(t2 * S::from_f64(3.5));
        let k12 = -(t2 * S::from_f64(2.5));
        let k13 = -(t2 * S::from_f64(1.5));
        let minus_half_l_m_g = -(S::from_f64(0.5) * t2);
        let k14 = t3 * t6;
        let half_l_squared = S::from_f64(0.5) * t6;
        let k15 = t5 * t6;
        let k16 = t4 * t6;
        let quarter_l_squared = S::from_f64(0.25) * t6;
        let k17 = S::from_f64(1.5) * t7;
        let k18 = t8 * S::from_f64(3.0);
        let minus_m = -self.m;
        let k19 = t8 * S::from_ratio(3, 13);
        let pivots = [(4, k9, k9)];
        Prepared {
            l: self.l,
            m: self.m,
            d: self.d,
            g: self.g,
            half_l,
            k0,
            m_g,
            k1,
            half_l_squared_m,
            k2,
            k3,
            k4,
            k5,
            k6,
            k7,
            k8,
            k9,
            half_m,
            quarter_l_m,
            half_l_m,
            minus_l,
            k10,
            k11,
            k12,
            k13,
            minus_half_l_m_g,
            k14,
            half_l_squared,
            k15,
            k16,
            quarter_l_squared,
            k17,
            k18,
            inverse_m,
            minus_m,
            k19,
            singular: PIVOTS.vanished(pivots),
        }
    }

    /// The start values of the description, at rest and `t = 0`.
    pub fn start(&self) -> ::lagrangian::emitted::State<Coordinates<S>> {
        let q_5 = S::pi() * S::from_f64(0.5);
        let q_4 = S::pi() * S::from_ratio(1, 3);
        let q_1 = -q_5;
        let zero = S::ZERO;
        let q_3 = -q_4;
        let q = [q_1, zero, q_3, q_4, q_5];
        let v = [S::ZERO; 5];
        ::lagrangian::emitted::State {
            t: 0.0,
            q: Coordinates::from_array(q),
            v: Coordinates::from_array(v),
        }
    }
}

/// The coordinates of [`ClosedPendulum`], or their rates, by name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coordinates<S = f64> {
    /// `q`. Unit: `rad`. Members: `q[1]` to `q[5]`.
    pub q: [S; 5],
}

/// The parameters of a [`ClosedPendulum`], with the work done that depends on them alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prepared<S = f64> {
    /// `l`
    l: S,
    /// `m`
    m: S,
    /// `d`
    d: S,
    /// `g`
    g: S,
    /// `0.5*l`
    half_l: S,
    /// `(1/12)*l^2*m`
    k0: S,
    /// `m*g`
    m_g: S,
    /// `(1/6)*l^2*m`
    k1: S,
    /// `0.5*l^2*m`
    half_l_squared_m: S,
    /// `1.5*l^2*m`
    k2: S,
    /// `2.5*l^2*m`
    k3: S,
    /// `3.5*l^2*m`
    k4: S,
    /// `(13/3)*l^2*m`
    k5: S,
    /// `(10/3)*l^2*m`
    k6: S,
    /// `(7/3)*l^2*m`
    k7: S,
    /// `(4/3)*l^2*m`
    k8: S,
    /// `(1/3)*l^2*m`
    k9: S,
    /// `0.5*m`
    half_m: S,
    /// `0.25*l*m`
    quarter_l_m: S,
    /// `0.5*l*m`
    half_l_m: S,
    /// `-l`
    minus_l: S,
    /// `-4.5*l*m*g`
    k10: S,
    /// `-3.5*l*m*g`
    k11: S,
    /// `-2.5*l*m*g`
    k12: S,
    /// `-1.5*l*m*g`
    k13: S,
    /// `-0.5*l*m*g`
    minus_half_l_m_g: S,
    /// `(1/6)*l^2`
    k14: S,
    /// `0.5*l^2`
    half_l_squared: S,
    /// `(1/3)*l^2`
    k15: S,
    /// `(4/3)*l^2`
    k16: S,
    /// `0.25*l^2`
    quarter_l_squared: S,
    /// `1.5/l`
    k17: S,
    /// `3/l^2/m`
    k18: S,
    /// `1/m`
    inverse_m: S,
    /// `-m`
    minus_m: S,
    /// `(3/13)/l^2/m`
    k19: S,
    /// Why these parameters leave the machine without accelerations, if they do.
    singular: Option<::lagrangian::emitted::Singular>,
}

/// A pivot of an elimination that is not above this share of its diagonal element may be rounding
/// errors alone.
const PIVOTS: ::lagrangian::emitted::Pivots = ::lagrangian::emitted::Pivots::new(5, 7);

/// Mass matrix `M`.
///
/// ```text
/// M[q[1], q[1]] = 13/3*l^2*m
/// M[q[2], q[1]] = 7/2*l^2*m*cos(q[2] - q[1])
/// M[q[2], q[2]] = 10/3*l^2*m
/// M[q[3], q[1]] = 5/2*l^2*m*cos(q[3] - q[1])
/// M[q[3], q[2]] = 5/2*l^2*m*cos(q[3] - q[2])
/// M[q[3], q[3]] = 7/3*l^2*m
/// M[q[4], q[1]] = 3/2*l^2*m*cos(q[4] - q[1])
/// M[q[4], q[2]] = 3/2*l^2*m*cos(q[4] - q[2])
/// M[q[4], q[3]] = 3/2*l^2*m*cos(q[4] - q[3])
/// M[q[4], q[4]] = 4/3*l^2*m
/// M[q[5], q[1]] = 1/2*l^2*m*cos(q[5] - q[1])
/// M[q[5], q[2]] = 1/2*l^2*m*cos(q[5] - q[2])
/// M[q[5], q[3]] = 1/2*l^2*m*cos(q[5] - q[3])
/// M[q[5], q[4]] = 1/2*l^2*m*cos(q[5] - q[4])
/// M[q[5], q[5]] = 1/3*l^2*m
/// ```
pub fn mass_matrix<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 5]) -> [[S; 5]; 5] {
    let q_1 = q[0];
    let q_2 = q[1];
    let q_3 = q[2];
    let q_4 = q[3];
    let q_5 = q[4];
    let (sin_q_2, cos_q_2) = q_2.sin_cos();
    let (sin_q_1, cos_q_1) = q_1.sin_cos();
    let (sin_q_3, cos_q_3) = q_3.sin_cos();
    let (sin_q_4, cos_q_4) = q_4.sin_cos();
    let (sin_q_5, cos_q_5) = q_5.sin_cos();
    let m21 = (sin_q_2 * sin_q_1 + cos_q_2 * cos_q_1) * p.k4;
    let m31 = p.k3 * (sin_q_1 * sin_q_3 + cos_q_1 * cos_q_3);
    let m32 = p.k3 * (sin_q_2 * sin_q_3 + cos_q_2 * cos_q_3);
    let m41 = p.k2 * (sin_q_1 * sin_q_4 + cos_q_1 * cos_q_4);
    let m42 = p.k2 * (sin_q_2 * sin_q_4 + cos_q_2 * cos_q_4);
    let m43 = p.k2 * (sin_q_3 * sin_q_4 + cos_q_3 * cos_q_4);
    let m51 = p.half_l_squared_m * (sin_q_1 * sin_q_5 + cos_q_1 * cos_q_5);
    let m52 = p.half_l_squared_m * (sin_q_2 * sin_q_5 + cos_q_2 * cos_q_5);
    let m53 = p.half_l_squared_m * (sin_q_3 * sin_q_5 + cos_q_3 * cos_q_5);
    let m54 = p.half_l_squared_m * (sin_q_4 * sin_q_5 + cos_q_4 * cos_q_5);
    [
        [p.k5, m21, m31, m41, m51],
        [m21, p.k6, m32, m42, m52],
        [m31, m32, p.k7, m43, m53],
        [m41, m42, m43, p.k8, m54],
        [m51, m52, m53, m54, p.k9],
    ]
}

/// Bias `h`: velocity products and explicit time in the inertia forces.
///
/// ```text
/// h[q[1]] = …
/// h[q[2]] = …
/// h[q[3]] = …
/// h[q[4]] = 3/2*l^2*m*sin(q[4] - q[1])*der(q[1])^2 + 3/2*l^2*m*sin(q[4] - q[2])*der(q[2])^2
///     + 3/2*l^2*m*sin(q[4] - q[3])*der(q[3])^2 - 1/2*l^2*m*sin(q[5] - q[4])*der(q[5])^2
/// h[q[5]] = 1/2*l^2*m*sin(q[5] - q[1])*der(q[1])^2 + 1/2*l^2*m*sin(q[5] - q[2])*der(q[2])^2
///     + 1/2*l^2*m*sin(q[5] - q[3])*der(q[3])^2 + 1/2*l^2*m*sin(q[5] - q[4])*der(q[4])^2
/// ```
pub fn bias<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 5], v: &[S; 5]) -> [S; 5] {
    let q_1 = q[0];
    let q_2 = q[1];
    let q_3 = q[2];
    let q_4 = q[3];
    let q_5 = q[4];
    let q_1_dot = v[0];
    let q_2_dot = v[1];
    let q_3_dot = v[2];
    let q_4_dot = v[3];
    let q_5_dot = v[4];
    let (sin_q_3, cos_q_3) = q_3.sin_cos();
    let (sin_q_2, cos_q_2) = q_2.sin_cos();
    let (sin_q_1, cos_q_1) = q_1.sin_cos();
    let (sin_q_4, cos_q_4) = q_4.sin_cos();
    let (sin_q_5, cos_q_5) = q_5.sin_cos();
    let t0 = q_4_dot * q_4_dot;
    let t1 = q_3_dot * q_3_dot;
    let t2 = q_2_dot * q_2_dot;
    let t3 = q_1_dot * q_1_dot;
    let t4 = t0 * p.k2;
    let t5 = q_5_dot * (q_5_dot * p.half_l_squared_m);
    let t6 = t1 * sin_q_3;
    let t7 = t2 * sin_q_2;
    let t8 = sin_q_1 * t3;
    let t9 = t1 * cos_q_3;
    let t10 = t2 * cos_q_2;
    let t11 = cos_q_1 * t3;
    let t12 = p.k3 * t6;
    let t13 = t7 + t8;
    let t14 = t9 * p.k3;
    let t15 = t5 * sin_q_5 + t4 * sin_q_4;
    let t16 = t10 + t11;
    let t17 = t5 * cos_q_5 + t4 * cos_q_4;
    let t18 = cos_q_5 * (t13 + (t6 + t0 * sin_q_4));
    let t19 = sin_q_1 * (t17 + (t14 + t10 * p.k4));
    let t20 = sin_q_2 * (t17 + (t14 + p.k4 * t11));
    let t21 = p.k2 * (sin_q_4 * (t9 + t16) - cos_q_4 * (t6 + t13));
    let h_q_1 = t19 - cos_q_1 * (t15 + (t12 + p.k4 * t7));
    let h_q_2 = t20 - cos_q_2 * (t15 + (t12 + p.k4 * t8));
    let h_q_3 = sin_q_3 * (t17 + p.k3 * t16) - cos_q_3 * (t15 + p.k3 * t13);
    let h_q_4 = t5 * (cos_q_5 * sin_q_4 - sin_q_5 * cos_q_4) + t21;
    let h_q_5 = p.half_l_squared_m * (sin_q_5 * (t16 + (t9 + t0 * cos_q_4)) - t18);
    [h_q_1, h_q_2, h_q_3, h_q_4, h_q_5]
}

/// Applied generalized forces `Q`.
///
/// ```text
/// Q[q[1]] = -9/2*l*m*g*cos(q[1])
/// Q[q[2]] = -7/2*l*m*g*cos(q[2])
/// Q[q[3]] = -5/2*l*m*g*cos(q[3])
/// Q[q[4]] = -3/2*l*m*g*cos(q[4])
/// Q[q[5]] = -1/2*l*m*g*cos(q[5])
/// ```
pub fn applied<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 5]) -> [S; 5] {
    let q_1 = q[0];
    let q_2 = q[1];
    let q_3 = q[2];
    let q_4 = q[3];
    let q_5 = q[4];
    let cos_q_1 = q_1.cos();
    let cos_q_2 = q_2.cos();
    let cos_q_3 = q_3.cos();
    let cos_q_4 = q_4.cos();
    let cos_q_5 = q_5.cos();
    let q_q_1 = p.k10 * cos_q_1;
    let q_q_2 = p.k11 * cos_q_2;
    let q_q_3 = p.k12 * cos_q_3;
    let q_q_4 = p.k13 * cos_q_4;
    let q_q_5 = p.minus_half_l_m_g * cos_q_5;
    [q_q_1, q_q_2, q_q_3, q_q_4, q_q_5]
}

/// Right-hand side `f = Q - h` of `M a = f`.
pub fn forces<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 5], v: &[S; 5]) -> [S; 5] {
    let q_1 = q[0];
    let q_2 = q[1];
    let q_3 = q[2];
    let q_4 = q[3];
    let q_5 = q[4];
    let q_1_dot = v[0];
    let q_2_dot = v[1];
    let q_3_dot = v[2];
    let q_4_dot = v[3];
    let q_5_dot = v[4];
    let (sin_q_2, cos_q_2) = q_2.sin_cos();
    let (sin_q_3, cos_q_3) = q_3.sin_cos();
    let (sin_q_4, cos_q_4) = q_4.sin_cos();
    let (sin_q_1, cos_q_1) = q_1.sin_cos();
    let (sin_q_5, cos_q_5) = q_5.sin_cos();
    let t0 = q_4_dot * q_4_dot;
    let t1 = q_2_dot * q_2_dot;
    let t2 = q_3_dot * q_3_dot;
    let t3 = q_1_dot * q_1_dot;
    let t4 = t0 * p.k2;
    let t5 = q_5_dot * (q_5_dot * p.half_l_squared_m);
    let t6 = sin_q_2 * t1;
    let t7 = sin_q_3 * t2;
    let t8 = sin_q_4 * t4;
    let t9 = sin_q_1 * t3;
    let t10 = sin_q_5 * t5;
    let t11 = cos_q_2 * t1;
    let t12 = cos_q_3 * t2;
    let t13 = t7 * p.k3;
    let t14 = cos_q_1 * t3;
    let t15 = t6 + t9;
    let t16 = cos_q_4 * t4 + cos_q_5 * t5;
    let t17 = t12 * p.k3;
    let t18 = t11 + t14;
    let t19 = sin_q_5 * (t18 + (t12 + cos_q_4 * t0));
    let t20 = cos_q_2 * (t10 + t9 * p.k4 + (t13 + (t8 + p.k11)));
    let t21 = cos_q_3 * (t10 + (t8 + p.k12) + p.k3 * t15);
    let t22 = t5 * (sin_q_4 * cos_q_5 - cos_q_4 * sin_q_5) - cos_q_4 * p.k13;
    let t23 = p.half_l_squared_m * (t19 - cos_q_5 * (t15 + (t7 + sin_q_4 * t0)));
    let t24 = cos_q_1 * (t10 + t6 * p.k4 + (t13 + (t8 + p.k10)));
    let f_q_1 = t24 - sin_q_1 * (t16 + (t17 + t11 * p.k4));
    let f_q_2 = -(sin_q_2 * (t16 + (t17 + t14 * p.k4)) - t20);
    let f_q_3 = -(sin_q_3 * (t16 + p.k3 * t18) - t21);
    let f_q_4 = -(t22 + p.k2 * (sin_q_4 * (t12 + t18) - cos_q_4 * (t7 + t15)));
    let f_q_5 = -(t23 - cos_q_5 * p.minus_half_l_m_g);
    [f_q_1, f_q_2, f_q_3, f_q_4, f_q_5]
}

/// Residuals `g` of the constraints of positions; 0 for those of velocities alone.
///
/// ```text
/// g[along] = l*cos(q[1]) + l*cos(q[2]) + l*cos(q[3]) + l*cos(q[4]) + l*cos(q[5]) - d
/// g[across] = l*sin(q[1]) + l*sin(q[2]) + l*sin(q[3]) + l*sin(q[4]) + l*sin(q[5])
/// ```
pub fn constraint_positions<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 5],
) -> [S; 2] {
    let q_1 = q[0];
    let q_2 = q[1];
    let q_3 = q[2];
    let q_4 = q[3];
    let q_5 = q[4];
    let (sin_q_2, cos_q_2) = q_2.sin_cos();
    let (sin_q_1, cos_q_1) = q_1.sin_cos();
    let (sin_q_3, cos_q_3) = q_3.sin_cos();
    let (sin_q_4, cos_q_4) = q_4.sin_cos();
    let (sin_q_5, cos_q_5) = q_5.sin_cos();
    let g1 = p.l * (cos_q_5 + (cos_q_4 + (cos_q_3 + (cos_q_2 + cos_q_1)))) - p.d;
    let g2 = p.l * (sin_q_5 + (sin_q_4 + (sin_q_3 + (sin_q_2 + sin_q_1))));
    [g1, g2]
}

/// Residuals `phi = G v + dg/dt` of the constraints at the level of velocities.
///
/// ```text
/// phi[along] = -l*sin(q[1])*der(q[1]) - l*sin(q[2])*der(q[2]) - l*sin(q[3])*der(q[3])
///     - l*sin(q[4])*der(q[4]) - l*sin(q[5])*der(q[5])
/// phi[across] = l*cos(q[1])*der(q[1]) + l*cos(q[2])*der(q[2]) + l*cos(q[3])*der(q[3])
///     + l*cos(q[4])*der(q[4]) + l*cos(q[5])*der(q[5])
/// ```
pub fn constraint_rates<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 5],
    v: &[S; 5],
) -> [S; 2] {
    let q_1 = q[0];
    let q_2 = q[1];
    let q_3 = q[2];
    let q_4 = q[3];
    let q_5 = q[4];
    let q_1_dot = v[0];
    let q_2_dot = v[1];
    let q_3_dot = v[2];
    let q_4_dot = v[3];
    let q_5_dot = v[4];
    let (sin_q_1, cos_q_1) = q_1.sin_cos();
    let (sin_q_2, cos_q_2) = q_2.sin_cos();
    let (sin_q_3, cos_q_3) = q_3.sin_cos();
    let (sin_q_4, cos_q_4) = q_4.sin_cos();
    let (sin_q_5, cos_q_5) = q_5.sin_cos();
    let t0 = q_3_dot * sin_q_3 + (q_2_dot * sin_q_2 + q_1_dot * sin_q_1);
    let t1 = q_3_dot * cos_q_3 + (q_2_dot * cos_q_2 + q_1_dot * cos_q_1);
    let phi1 = p.minus_l * (q_5_dot * sin_q_5 + (q_4_dot * sin_q_4 + t0));
    let phi2 = (q_5_dot * cos_q_5 + (q_4_dot * cos_q_4 + t1)) * p.l;
    [phi1, phi2]
}

/// Constraint matrix `G`, the derivatives of `phi` by the rates.
///
/// ```text
/// G[along, q[1]] = -l*sin(q[1])
/// G[along, q[2]] = -l*sin(q[2])
/// G[along, q[3]] = -l*sin(q[3])
/// G[along, q[4]] = -l*sin(q[4])
/// G[along, q[5]] = -l*sin(q[5])
/// G[across, q[1]] = l*cos(q[1])
/// G[across, q[2]] = l*cos(q[2])
/// G[across, q[3]] = l*cos(q[3])
/// G[across, q[4]] = l*cos(q[4])
/// G[across, q[5]] = l*cos(q[5])
/// ```
pub fn constraint_matrix<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 5]) -> [S; 10] {
    let q_1 = q[0];
    let q_2 = q[1];
    let q_3 = q[2];
    let q_4 = q[3];
    let q_5 = q[4];
    let (sin_q_1, cos_q_1) = q_1.sin_cos();
    let (sin_q_2, cos_q_2) = q_2.sin_cos();
    let (sin_q_3, cos_q_3) = q_3.sin_cos();
    let (sin_q_4, cos_q_4) = q_4.sin_cos();
    let (sin_q_5, cos_q_5) = q_5.sin_cos();
    let g1_1 = p.minus_l * sin_q_1;
    let g1_2 = p.minus_l * sin_q_2;
    let g1_3 = p.minus_l * sin_q_3;
    let g1_4 = p.minus_l * sin_q_4;
    let g1_5 = p.minus_l * sin_q_5;
    let g2_1 = cos_q_1 * p.l;
    let g2_2 = cos_q_2 * p.l;
    let g2_3 = cos_q_3 * p.l;
    let g2_4 = cos_q_4 * p.l;
    let g2_5 = cos_q_5 * p.l;
    [g1_1, g1_2, g1_3, g1_4, g1_5, g2_1, g2_2, g2_3, g2_4, g2_5]
}

/// Right-hand side `gamma` of `G a = gamma`.
///
/// ```text
/// gamma[along] = l*cos(q[1])*der(q[1])^2 + l*cos(q[2])*der(q[2])^2 + l*cos(q[3])*der(q[3])^2
///     + l*cos(q[4])*der(q[4])^2 + l*cos(q[5])*der(q[5])^2
/// gamma[across] = l*sin(q[1])*der(q[1])^2 + l*sin(q[2])*der(q[2])^2 + l*sin(q[3])*der(q[3])^2
///     + l*sin(q[4])*der(q[4])^2 + l*sin(q[5])*der(q[5])^2
/// ```
pub fn constraint_bias<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 5],
    v: &[S; 5],
) -> [S; 2] {
    let q_1 = q[0];
    let q_2 = q[1];
    let q_3 = q[2];
    let q_4 = q[3];
    let q_5 = q[4];
    let q_1_dot = v[0];
    let q_2_dot = v[1];
    let q_3_dot = v[2];
    let q_4_dot = v[3];
    let q_5_dot = v[4];
    let (sin_q_1, cos_q_1) = q_1.sin_cos();
    let (sin_q_2, cos_q_2) = q_2.sin_cos();
    let (sin_q_3, cos_q_3) = q_3.sin_cos();
    let (sin_q_4, cos_q_4) = q_4.sin_cos();
    let (sin_q_5, cos_q_5) = q_5.sin_cos();
    let t0 = q_1_dot * q_1_dot;
    let t1 = q_2_dot * q_2_dot;
    let t2 = q_3_dot * q_3_dot;
    let t3 = q_4_dot * q_4_dot;
    let t4 = q_5_dot * q_5_dot;
    let t5 = t3 * cos_q_4 + (t2 * cos_q_3 + (t1 * cos_q_2 + t0 * cos_q_1));
    let t6 = t3 * sin_q_4 + (t2 * sin_q_3 + (t1 * sin_q_2 + t0 * sin_q_1));
    let gamma1 = p.l * (t4 * cos_q_5 + t5);
    let gamma2 = p.l * (t4 * sin_q_5 + t6);
    [gamma1, gamma2]
}

::lagrangian::emitted::fast_function! {
    /// Accelerations `a`, the solution of `M a = f + G^T lambda`, `G a = gamma` eliminated along
    /// the machine.
    ///
    /// A pivot that vanishes is an error.
    ///
    /// Velocities are eliminated from the tips of the machine to the ground, with the inertia `G`
    /// and the loads `g` that remain on them. Comments name these numbers where they are computed,
    /// up to signs and factors that depend on parameters alone, for coordinate `i` or the velocity
    /// in its place; `k` are the velocities that follow:
    ///
    /// ```text
    /// d[i] = G[i, i], l[i] = G[i, k]/d[i], z[i] = g[i]/d[i]
    /// a[i] = z[i] - sum l[i]*a[k]
    /// ```
    ///
    /// So far these are the accelerations `a0` without constraint forces. The multipliers follow
    /// from `C lambda = gamma - G a0`, where now `G` are the rows of the constraints and `C = G
    /// M^-1 G^T`, row after row: `d`, `l` and `z` of constraints are those of `C = L D L^T`.
    pub fn accelerations<'a, S>(Accelerations { p: &'a Prepared<S>, q: &'a [S; 5], v: &'a [S; 5] })
        -> Result<[S; 5], ::lagrangian::emitted::Singular> = accelerations_in;
}

#[inline(always)]
fn accelerations_in<S: Copy, N: ::lagrangian::emitted::Scalar<Stored = S>>(
    call: Accelerations<'_, S>,
) -> Result<[S; 5], ::lagrangian::emitted::Singular> {
    let Accelerations { p, q, v } = call;
    let n = N::load;
    if let Some(singular) = p.singular {
        return Err(singular);
    }
    let q_1 = n(q[0]);
    let q_2 = n(q[1]);
    let q_3 = n(q[2]);
    let q_4 = n(q[3]);
    let q_5 = n(q[4]);
    let q_1_dot = n(v[0]);
    let q_2_dot = n(v[1]);
    let q_3_dot = n(v[2]);
    let q_4_dot = n(v[3]);
    let q_5_dot = n(v[4]);
    let angles = [q_5, q_4, q_3, q_2, q_1];
    let circular = N::sin_cos_all(angles);
    let (sin_q_5, cos_q_5) = circular[0];
    let (sin_q_4, cos_q_4) = circular[1];
    let (sin_q_3, cos_q_3) = circular[2];
    let (sin_q_2, cos_q_2) = circular[3];
    let (sin_q_1, cos_q_1) = circular[4];
    let t0 = q_5_dot * q_5_dot;
    let t1 = q_4_dot * q_4_dot;
    let t2 = q_3_dot * q_3_dot;
    let t3 = q_1_dot * q_1_dot;
    let t4 = q_2_dot * q_2_dot;
    let t5 = N::from_f64(0.75) * cos_q_5;
    let t6 = n(p.l) * sin_q_4;
    let t7 = n(p.l) * cos_q_4;
    let t8 = n(p.l) * sin_q_3;
    let t9 = n(p.l) * cos_q_3;
    let t10 = cos_q_5 * t0;
    let t11 = sin_q_5 * t0;
    let t12 = sin_q_5 * t5;
    let t13 = cos_q_5.neg_mul_add(t5, N::from_f64(1.5));
    let t14 = N::from_f64(0.75) * sin_q_5;
    let t15 = sin_q_5.neg_mul_add(t14, N::from_f64(1.5));
    let t16 = t6 * t1;
    let t17 = t7 * t1;
    let t18 = n(p.l) * sin_q_2;
    let t19 = n(p.l) * cos_q_2;
    let t20 = t8 * t2;
    let t21 = t7.mul_sub(t13, t12 * t6);
    let t22 = t15.mul_sub(t6, t12 * t7);
    let t23 = t9 * t2;
    let t24 = n(p.l) * sin_q_1;
    let t25 = t15.mul_add(t17, t12.mul_add(t16, n(p.half_l) * t10));
    let t26 = t13.mul_add(t16, t12.mul_add(t17, n(p.half_l) * t11));
    let t27 = n(p.l) * sin_q_5;
    let t28 = cos_q_5 * n(p.k17);
    let t29 = n(p.l) * cos_q_1;
    let t30 = sin_q_5 * n(p.k17);
    let t31 = sin_q_1 * t3;
    // Eliminates q[4]: inertia d[q[4]].
    let t32 = t6.mul_add(t22, t7.mul_sub(t21, n(p.k14)));
    let t33 = sin_q_2 * n(p.half_l);
    let t34 = cos_q_2 * (n(p.half_l_squared) * cos_q_1);
    let t35 = t27 * t28;
    let t36 = t30 * t27;
    let t37 = t7.mul_sub(t26, t6 * t25);
    let t38 = t29 * t3;
    let t39 = N::ONE / t32;
    let t40 = cos_q_2 * n(p.half_l);
    let t41 = t19.mul_add(t4, t38);
    let t42 = sin_q_2.mul_add(t4, t31);
    let t43 = t40.mul_add(t4, t38);
    let t44 = t6.neg_mul_add(t36, t7.neg_mul_add(t35, t6));
    let t45 = n(p.g) - t4.mul_add(t33, t24 * t3);
    let t46 = n(p.l) * cos_q_5;
    let t47 = t31.neg_mul_add(n(p.half_l), n(p.g));
    let t48 = n(p.l).neg_mul_add(t42, n(p.g));
    let t49 = t28 * t46;
    let t50 = t30 * t46;
    let t51 = t22 * t39;
    let t52 = t21 * t39;
    let t53 = t39 * n(p.inverse_m);
    let t54 = t24.mul_add(t43, t31 * (cos_q_1 * n(p.quarter_l_squared)));
    let t55 = t22.neg_mul_add(t51, t15 + N::ONE);
    let t56 = t22.mul_add(t52, t12);
    let t57 = t21.neg_mul_add(t52, t13 + N::ONE);
    let t58 = t52.mul_add(t44, t35);
    let t59 = t51.mul_add(t44, t36);
    let t60 = t6.neg_mul_add(t50, t7.neg_mul_add(t49, t7));
    let t61 = t52.mul_add(t60, t49);
    let t62 = t56.mul_sub(t9, t55 * t8);
    let t63 = t9.mul_sub(t57, t8 * t56);
    let t64 = t51.mul_add(t60, t50);
    let t65 = t55.mul_add(t23, t56.mul_add(t20, t51.mul_add(t37, t25)));
    let t66 = t57.mul_add(t20, t52.neg_mul_add(t37, t26));
    let t67 = t56.mul_add(t23, t66);
    let t68 = t8.neg_mul_add(t59, t9.neg_mul_add(t58, t8));
    let t69 = cos_q_3.mul_add(t2, cos_q_2.mul_add(t4, cos_q_1 * t3));
    let t70 = t8.neg_mul_add(t64, t9.neg_mul_add(t61, t9));
    // Eliminates q[3]: inertia d[q[3]].
    let t71 = t9.neg_mul_add(t63, t8.mul_add(t62, n(p.k14)));
    let t72 = t9.mul_sub(t67, t8 * t65);
    let t73 = N::ONE / t71;
    let t74 = t63 * t73;
    let t75 = t62 * t73;
    let t76 = t73 * n(p.inverse_m);
    let t77 = t62.mul_add(t74, t56);
    let t78 = t63.mul_add(t74, t57 + N::from_f64(0.5));
    let t79 = t62.mul_add(t75, t55 + N::from_f64(0.5));
    let t80 = t74.neg_mul_add(t68, t58);
    let t81 = t75.mul_add(t68, t59);
    let t82 = t74.neg_mul_add(t70, t61);
    let t83 = t19.mul_sub(t78, t18 * t77);
    let t84 = t77.mul_sub(t19, t79 * t18);
    let t85 = t77.mul_add(t41, t74.mul_add(t72, t67));
    let t86 = t78.neg_mul_add(t48, t85);
    let t87 = t79.mul_add(t41, t75.mul_add(t72, t65));
    let t88 = t77.neg_mul_add(t48, t87);
    let t89 = t18.neg_mul_add(t81, t19.neg_mul_add(t80, t18));
    let t90 = sin_q_2.mul_add(n(p.half_l_squared) * sin_q_1, t34);
    let t91 = t54 + t29.mul_add(t45, t47 * (cos_q_1 * n(p.half_l)));
    let t92 = t75.mul_add(t70, t64);
    // Eliminates q[2]: inertia d[q[2]].
    let t93 = t18.neg_mul_add(t84, t19.mul_add(t83, n(p.k15)));
    let t94 = t84.neg_mul_add(t24, t83.mul_add(t29, t90));
    let t95 = t29.mul_add(t78.mul_sub(t29, t77 * t24), n(p.k16));
    let t96 = t19.mul_sub(t86, t40.mul_add(t45, t43 * t33));
    let t97 = t18.neg_mul_add(t88, t96);
    let t98 = t18.neg_mul_add(t92, t19.neg_mul_add(t82, t19));
    let t99 = N::ONE / t93;
    let t100 = t99 * t94;
    let t101 = t99 * n(p.inverse_m);
    let t102 = t24.neg_mul_add(t77.mul_sub(t29, t79 * t24), t95);
    // Eliminates q[1]: inertia d[q[1]].
    let t103 = t94.neg_mul_add(t100, t102);
    let t104 = t24.neg_mul_add(t88, t29.mul_sub(t86, t91));
    let t105 = t24.neg_mul_add(t81, t29.neg_mul_add(t80, t24));
    let t106 = t24.neg_mul_add(t92, t29.neg_mul_add(t82, t29));
    let t107 = N::ONE / t103;
    let t108 = t107 * t100.neg_mul_add(t97, t104);
    let t109 = t107 * n(p.inverse_m);
    let t110 = t109 * t100.neg_mul_add(t89, t105);
    let t111 = t24 * t108;
    let t112 = t29 * t108;
    let t113 = t109 * t100.neg_mul_add(t98, t106);
    let t114 = t99 * t94.neg_mul_add(t108, t97);
    let t115 = t100.neg_mul_add(t110, t89 * t101);
    let t116 = t100.neg_mul_add(t113, t101 * t98);
    let t117 = t18 * t114;
    let t118 = t19 * t114;
    let t119 = t18.mul_add(t115, t24 * t110);
    let t120 = t19.mul_add(t115, t29 * t110);
    let t121 = t18.mul_add(t116, t24 * t113);
    let t122 = t117 + (t41 + t111);
    let t123 = t118 + (t48 + t112);
    let t124 = t19.mul_add(t116, t29 * t113);
    let t125 = t74.neg_mul_add(t120, t75.mul_add(t119, t68 * t76));
    let t126 = t11 + sin_q_4.mul_add(t1, sin_q_3.mul_add(t2, t42));
    let t127 = t74.neg_mul_add(t124, t75.mul_add(t121, t76 * t70));
    let t128 = t8.neg_mul_add(t125, t119);
    let t129 = t9.neg_mul_add(t125, t120);
    let t130 = sin_q_2.mul_add(t115, sin_q_1 * t110);
    let t131 = cos_q_2.mul_add(t115, cos_q_1 * t110);
    let t132 = t8.neg_mul_add(t127, t121);
    let t133 = t9.neg_mul_add(t127, t124);
    let t134 = t73 * t63.neg_mul_add(t123, t62.mul_add(t122, t72));
    let t135 = n(p.l).mul_add(t10 + cos_q_4.mul_add(t1, t69), t111);
    let t136 = cos_q_2.mul_add(t116, cos_q_1 * t113);
    let t137 = t9 * t134;
    let t138 = t8 * t134;
    let t139 = t52.neg_mul_add(t129, t51.neg_mul_add(t128, t44 * t53));
    let t140 = t52.neg_mul_add(t133, t51.neg_mul_add(t132, t53 * t60));
    let t141 = t137 + (t20 - t123);
    let t142 = t23 + t122 - t138;
    let t143 = t30.neg_mul_add(t6.mul_add(t139, t128), t27 * n(p.k18));
    let t144 = t28.neg_mul_add(t7.mul_add(t139, t129), t143);
    let t145 = t30.neg_mul_add(t6.mul_add(t140, t132), n(p.k18) * t46);
    let t146 = t28.neg_mul_add(t7.mul_add(t140, t133), t145);
    let t147 = t39 * t22.neg_mul_add(t142, t21.mul_add(t141, t37));
    let t148 = sin_q_4.mul_add(t139, sin_q_3.neg_mul_add(t125, t130));
    let t149 = cos_q_4.mul_add(t139, cos_q_3.neg_mul_add(t125, t131));
    let t150 = cos_q_4.mul_add(t140, cos_q_3.neg_mul_add(t127, t136));
    let t151 = t7 * t147;
    let t152 = t6 * t147;
    // Row along: pivot d[along].
    let t153 = n(p.l) * sin_q_5.mul_add(t144, t148);
    let t154 = n(p.l) * cos_q_5.mul_add(t144, t149);
    let t155 = n(p.l) * cos_q_5.mul_add(t146, t150);
    let t156 = N::ONE / t153;
    let t157 = cos_q_5 * (t16 + t141 - t151);
    let t158 = sin_q_5.mul_sub(t152 + (t17 + t142), t157);
    let t159 = N::from_f64(1.5) * t158;
    // Eliminates along from row across: l[across, along].
    let t160 = t156 * t154;
    let t161 = sin_q_5.neg_mul_add(t159, t152 + (t117 + t135 - t138));
    let t162 = t137 + (n(p.l).mul_sub(t126, t112) - t118) - t151;
    // Row across: pivot d[across].
    let t163 = t154.neg_mul_add(t160, t155);
    // Row across: right-hand side z[across].
    let t164 = t160.mul_add(t161, cos_q_5.mul_add(t159, t162)) / t163;
    // Back substitution: lambda[along].
    let t165 = t160.mul_add(t164, t156 * t161);
    let t166 = t146.neg_mul_add(t164, n(p.k17) * t158);
    let q_1_ddot = t110.neg_mul_add(t165, t113.mul_add(t164, t108));
    let q_2_ddot = t115.neg_mul_add(t165, t116.mul_add(t164, t114));
    let q_3_ddot = t125.mul_sub(t165, t127.mul_add(t164, t134));
    let q_4_ddot = t139.neg_mul_add(t165, t140.mul_add(t164, t147));
    let q_5_ddot = -t144.mul_add(t165, t166);
    let t167 = t32 * n(p.m);
    let t168 = t71 * n(p.minus_m);
    let t169 = t93 * n(p.m);
    let t170 = t103 * n(p.m);
    let sound = PIVOTS.hold(t167, n(p.k8))
        & PIVOTS.hold(t168, n(p.k7))
        & PIVOTS.hold(t169, n(p.k6))
        & PIVOTS.hold(t170, n(p.k5))
        & PIVOTS.hold(t153, t153)
        & PIVOTS.hold(t163, t155)
        & q_5_ddot.is_finite();
    if !sound {
        let pivots = [
            (3, t167, n(p.k8)),
            (2, t168, n(p.k7)),
            (1, t169, n(p.k6)),
            (0, t170, n(p.k5)),
            (5, t153, t153),
            (6, t163, t155),
        ];
        PIVOTS.check(pivots)?;
    }
    let accelerations = [
        q_1_ddot.store(),
        q_2_ddot.store(),
        q_3_ddot.store(),
        q_4_ddot.store(),
        q_5_ddot.store(),
    ];
    Ok(accelerations)
}

::lagrangian::emitted::fast_function! {
    /// Lagrange's multipliers `lambda` of `M a = f + G^T lambda`.
    ///
    /// A pivot that vanishes is an error.
    ///
    /// Row after row, an unknown is eliminated from the rows that follow. Comments name these
    /// numbers where they are computed, up to signs and factors that depend on parameters alone;
    /// sums are over the rows `k` before, in the last line over those after:
    ///
    /// ```text
    /// l[i, j] = (M[i, j] - sum l[i, k]*l[j, k]*d[k])/d[j]
    /// d[i] = M[i, i] - sum l[i, k]^2*d[k]
    /// z[i] = f[i] - sum l[i, k]*z[k]
    /// a[i] = z[i]/d[i] - sum l[k, i]*a[k]
    /// ```
    ///
    /// The rows of constraints are those of `G a = gamma`: there `M` stands for `G`, with zeros for
    /// two constraints, and `f` for `gamma`. Their unknowns are the multipliers.
    pub fn multipliers<'a, S>(Multipliers { p: &'a Prepared<S>, q: &'a [S; 5], v: &'a [S; 5] })
        -> Result<[S; 2], ::lagrangian::emitted::Singular> = multipliers_in;
}

#[inline(always)]
fn multipliers_in<S: Copy, N: ::lagrangian::emitted::Scalar<Stored = S>>(
    call: Multipliers<'_, S>,
) -> Result<[S; 2], ::lagrangian::emitted::Singular> {
    let Multipliers { p, q, v } = call;
    let n = N::load;
    if let Some(singular) = p.singular {
        return Err(singular);
    }
    let q_1 = n(q[0]);
    let q_2 = n(q[1]);
    let q_3 = n(q[2]);
    let q_4 = n(q[3]);
    let q_5 = n(q[4]);
    let q_1_dot = n(v[0]);
    let q_2_dot = n(v[1]);
    let q_3_dot = n(v[2]);
    let q_4_dot = n(v[3]);
    let q_5_dot = n(v[4]);
    let angles = [q_2, q_1, q_3, q_4, q_5];
    let circular = N::sin_cos_all(angles);
    let (sin_q_2, cos_q_2) = circular[0];
    let (sin_q_1, cos_q_1) = circular[1];
    let (sin_q_3, cos_q_3) = circular[2];
    let (sin_q_4, cos_q_4) = circular[3];
    let (sin_q_5, cos_q_5) = circular[4];
    let t0 = q_2_dot * q_2_dot;
    let t1 = q_1_dot * q_1_dot;
    let t2 = q_3_dot * q_3_dot;
    let t3 = q_4_dot * q_4_dot;
    let t4 = q_5_dot * q_5_dot;
    let t5 = cos_q_2 * t0;
    let t6 = sin_q_2 * t0;
    let t7 = sin_q_1 * t1;
    let t8 = sin_q_2.mul_add(sin_q_1, cos_q_2 * cos_q_1) * n(p.k4);
    let t9 = n(p.k3) * sin_q_1.mul_add(sin_q_3, cos_q_1 * cos_q_3);
    let t10 = n(p.k2) * sin_q_1.mul_add(sin_q_4, cos_q_1 * cos_q_4);
    // Eliminates q[1] from row q[2]: l[q[2], q[1]].
    let t11 = n(p.k19) * t8;
    let t12 = sin_q_1.mul_add(sin_q_5, cos_q_1 * cos_q_5);
    let t13 = n(p.half_l_squared_m) * t12;
    // Eliminates q[1] from row q[3]: l[q[3], q[1]].
    let t14 = n(p.k19) * t9;
    let t15 = sin_q_2.mul_add(sin_q_5, cos_q_2 * cos_q_5);
    // Eliminates q[1] from row q[4]: l[q[4], q[1]].
    let t16 = n(p.k19) * t10;
    // Row q[2]: pivot d[q[2]].
    let t17 = t8.neg_mul_add(t11, n(p.k6));
    let t18 = cos_q_1 * t1;
    // Eliminates q[1] from row q[5]: l[q[5], q[1]].
    let t19 = n(p.k19) * t13;
    let t20 = n(p.k3) * sin_q_2.mul_add(sin_q_3, cos_q_2 * cos_q_3);
    let t21 = t8.neg_mul_add(t14, t20);
    let t22 = n(p.k2) * sin_q_2.mul_add(sin_q_4, cos_q_2 * cos_q_4);
    let t23 = t8.neg_mul_add(t16, t22);
    let t24 = n(p.k2) * sin_q_3.mul_add(sin_q_4, cos_q_3 * cos_q_4);
    let t25 = N::ONE / t17;
    let t26 = t8.neg_mul_add(t19, n(p.half_l_squared_m) * t15);
    let t27 = sin_q_3.mul_add(sin_q_5, cos_q_3 * cos_q_5);
    let t28 = t6 + t7;
    let t29 = sin_q_3 * t2;
    let t30 = t5 + t18;
    let t31 = cos_q_3 * t2;
    let t32 = sin_q_1 * n(p.l);
    let t33 = sin_q_4 * t3;
    let t34 = sin_q_4.mul_add(sin_q_5, cos_q_4 * cos_q_5);
    let t35 = sin_q_5 * t4;
    let t36 = t29 + t28;
    let t37 = cos_q_4 * t3;
    let t38 = t31 + t30;
    let t39 = cos_q_5 * t4;
    // Eliminates q[1] from row along: l[along, q[1]].
    let t40 = n(p.k19) * t32;
    let t41 = t33 + t36;
    let t42 = t37 + t38;
    // Eliminates q[2] from row q[3]: l[q[3], q[2]].
    let t43 = t25 * t21;
    // Eliminates q[2] from row q[4]: l[q[4], q[2]].
    let t44 = t25 * t23;
    // Eliminates q[2] from row q[5]: l[q[5], q[2]].
    let t45 = t25 * t26;
    let t46 = t8.neg_mul_add(t40, sin_q_2 * n(p.l));
    // Row q[3]: pivot d[q[3]].
    let t47 = t21.neg_mul_add(t43, t9.neg_mul_add(t14, n(p.k7)));
    let t48 = t21.neg_mul_add(t44, t9.neg_mul_add(t16, t24));
    let t49 = t9.neg_mul_add(t19, n(p.half_l_squared_m) * t27);
    let t50 = t21.neg_mul_add(t45, t49);
    let t51 = t10.neg_mul_add(t19, n(p.half_l_squared_m) * t34);
    let t52 = n(p.l).mul_add(t42, n(p.half_l) * t39);
    let t53 = N::ONE / t47;
    let t54 = n(p.l).mul_add(t38, n(p.half_l) * t37);
    // Eliminates q[2] from row along: l[along, q[2]].
    let t55 = t25 * t46;
    let t56 = cos_q_1 * n(p.l);
    let t57 = n(p.g) - n(p.l).mul_add(t41, t35 * n(p.half_l));
    let t58 = n(p.g) - n(p.l).mul_add(t36, n(p.half_l) * t33);
    let t59 = t52 + t54;
    let t60 = n(p.l).mul_add(t30, n(p.half_l) * t31);
    let t61 = t9.neg_mul_add(t40, sin_q_3 * n(p.l));
    let t62 = t21.neg_mul_add(t55, t61);
    // Eliminates q[1] from row across: l[across, q[1]].
    let t63 = n(p.k19) * t56;
    let t64 = t57 + t58;
    let t65 = n(p.g) - n(p.l).mul_add(t28, n(p.half_l) * t29);
    let t66 = n(p.half_l).mul_add(t5, n(p.l) * t18);
    // Eliminates q[3] from row q[4]: l[q[4], q[3]].
    let t67 = t53 * t48;
    // Eliminates q[3] from row q[5]: l[q[5], q[3]].
    let t68 = t53 * t50;
    // Eliminates q[3] from row along: l[along, q[3]].
    let t69 = t53 * t62;
    let t70 = t10.neg_mul_add(t40, sin_q_4 * n(p.l));
    let t71 = t8.neg_mul_add(t63, cos_q_2 * n(p.l));
    let t72 = t23.neg_mul_add(t44, t10.neg_mul_add(t16, n(p.k8)));
    // Row q[4]: pivot d[q[4]].
    let t73 = t48.neg_mul_add(t67, t72);
    let t74 = t48.neg_mul_add(t68, t23.neg_mul_add(t45, t51));
    let t75 = t26.neg_mul_add(t45, t13.neg_mul_add(t19, n(p.k9)));
    let t76 = n(p.g) - n(p.half_l).mul_add(t6, n(p.l) * t7);
    let t77 = n(p.m) * (t59 + t60);
    let t78 = N::ONE / t73;
    let t79 = t48.neg_mul_add(t69, t23.neg_mul_add(t55, t70));
    let t80 = t13.neg_mul_add(t40, sin_q_5 * n(p.l));
    // Eliminates q[2] from row across: l[across, q[2]].
    let t81 = t25 * t71;
    let t82 = n(p.m) * (t64 + t65);
    let t83 = n(p.half_m) * n(p.half_l).neg_mul_add(t7, n(p.g));
    let t84 = t9.neg_mul_add(t63, cos_q_3 * n(p.l));
    let t85 = t21.neg_mul_add(t81, t84);
    let t86 = t77 + n(p.m).mul_add(t66, t18 * n(p.quarter_l_m));
    // Eliminates q[4] from row q[5]: l[q[5], q[4]].
    let t87 = t78 * t74;
    // Eliminates q[4] from row along: l[along, q[4]].
    let t88 = t78 * t79;
    // Row q[5]: pivot d[q[5]].
    let t89 = t74.neg_mul_add(t87, t50.neg_mul_add(t68, t75));
    let t90 = t50.neg_mul_add(t69, t26.neg_mul_add(t55, t80));
    let t91 = t74.neg_mul_add(t88, t90);
    // Eliminates q[3] from row across: l[across, q[3]].
    let t92 = t53 * t85;
    let t93 = t10.neg_mul_add(t63, cos_q_4 * n(p.l));
    let t94 = t82 + n(p.m).mul_add(t76, t83);
    let t95 = sin_q_4 * t52.mul_add(n(p.m), n(p.half_m) * t54);
    let t96 = t57.mul_add(n(p.m), n(p.half_m) * t58);
    let t97 = sin_q_2 * n(p.half_m).mul_add(t66, t77);
    let t98 = N::ONE / t89;
    let t99 = sin_q_3 * n(p.m).mul_add(t59, n(p.half_m) * t60);
    let t100 = n(p.m).mul_add(t64, n(p.half_m) * t65);
    let t101 = t62.mul_add(t69, t46.mul_add(t55, t32 * t40));
    let t102 = t48.neg_mul_add(t92, t23.neg_mul_add(t81, t93));
    let t103 = t13.neg_mul_add(t63, cos_q_5 * n(p.l));
    let t104 = n(p.l) * cos_q_1.mul_add(t94, sin_q_1 * t86);
    let t105 = cos_q_2.mul_add(n(p.half_m).mul_add(t76, t82), t97);
    // Eliminates q[4] from row across: l[across, q[4]].
    let t106 = t78 * t102;
    // Row q[2]: right-hand side z[q[2]].
    let t107 = t11.mul_sub(t104, n(p.l) * t105);
    let t108 = cos_q_5.mul_add(t57, sin_q_5 * t52) * n(p.half_l_m);
    let t109 = t50.neg_mul_add(t92, t26.neg_mul_add(t81, t103));
    let t110 = t74.neg_mul_add(t106, t109);
    // Eliminates q[5] from row along: l[along, q[5]].
    let t111 = t98 * t91;
    let t112 = t16.mul_sub(t104, n(p.l) * cos_q_4.mul_add(t96, t95));
    let t113 = t14.mul_sub(t104, n(p.l) * cos_q_3.mul_add(t100, t99));
    // Row q[3]: right-hand side z[q[3]].
    let t114 = t43.neg_mul_add(t107, t113);
    let t115 = t40.neg_mul_add(t104, n(p.l) * (t39 + t42));
    let t116 = t63.mul_add(t104, n(p.l) * (t35 + t41));
    // Row along: pivot d[along].
    let t117 = t91.mul_add(t111, t79.mul_add(t88, t101));
    // Eliminates q[5] from row across: l[across, q[5]].
    let t118 = t98 * t110;
    let t119 = t62.mul_add(t92, t46.mul_add(t81, t32 * t63));
    // Row q[4]: right-hand side z[q[4]].
    let t120 = t67.neg_mul_add(t114, t44.neg_mul_add(t107, t112));
    let t121 = t45.neg_mul_add(t107, t19.mul_sub(t104, t108));
    let t122 = N::ONE / t117;
    let t123 = t91.mul_add(t118, t79.mul_add(t106, t119));
    // Row q[5]: right-hand side z[q[5]].
    let t124 = t87.neg_mul_add(t120, t68.neg_mul_add(t114, t121));
    let t125 = t69.mul_add(t114, t55.mul_add(t107, t115));
    let t126 = t92.neg_mul_add(t114, t81.neg_mul_add(t107, t116));
    // Row along: right-hand side z[along].
    let t127 = t111.mul_add(t124, t88.mul_add(t120, t125));
    let t128 = t110.mul_add(t118, t71.mul_add(t81, t56 * t63));
    let t129 = t128 + t102.mul_add(t106, t85 * t92);
    // Eliminates along from row across: l[across, along].
    let t130 = t122 * t123;
    let t131 = t118.neg_mul_add(t124, t106.neg_mul_add(t120, t126));
    // Row across: pivot d[across].
    let t132 = t123.neg_mul_add(t130, t129);
    // Row across: right-hand side z[across].
    let lambda2 = t130.mul_add(t127, t131) / t132;
    // Back substitution: lambda[along].
    let lambda1 = t130.mul_add(lambda2, t122 * t127);
    let sound = PIVOTS.hold(n(p.k5), n(p.k5))
        & PIVOTS.hold(t17, n(p.k6))
        & PIVOTS.hold(t47, n(p.k7))
        & PIVOTS.hold(t73, n(p.k8))
        & PIVOTS.hold(t89, n(p.k9))
        & PIVOTS.hold(t117, t117)
        & PIVOTS.hold(t132, t129)
        & lambda1.is_finite();
    if !sound {
        let pivots = [
            (0, n(p.k5), n(p.k5)),
            (1, t17, n(p.k6)),
            (2, t47, n(p.k7)),
            (3, t73, n(p.k8)),
            (4, t89, n(p.k9)),
            (5, t117, t117),
            (6, t132, t129),
        ];
        PIVOTS.check(pivots)?;
    }
    let multipliers = [lambda1.store(), lambda2.store()];
    Ok(multipliers)
}

::lagrangian::emitted::fast_function! {
    /// Residuals of positions and rates, rows of `G`, the smallest displacements onto the
    /// constraints, and how independent these are. Only for machines whose constraints
    /// are independent.
    ///
    /// A pivot that vanishes is an error.
    pub fn projection<'a, S>(ProjectionCall { p: &'a Prepared<S>, q: &'a [S; 5], v: &'a [S; 5] })
        -> Result<[S; 37], ::lagrangian::emitted::Singular> = projection_in;
}

#[inline(always)]
fn projection_in<S: Copy, N: ::lagrangian::emitted::Scalar<Stored = S>>(
    call: ProjectionCall<'_, S>,
) -> Result<[S; 37], ::lagrangian::emitted::Singular> {
    let ProjectionCall { p, q, v } = call;
    let n = N::load;
    if let Some(singular) = p.singular {
        return Err(singular);
    }
    let q_1 = n(q[0]);
    let q_2 = n(q[1]);
    let q_3 = n(q[2]);
    let q_4 = n(q[3]);
    let q_5 = n(q[4]);
    let q_1_dot = n(v[0]);
    let q_2_dot = n(v[1]);
    let q_3_dot = n(v[2]);
    let q_4_dot = n(v[3]);
    let q_5_dot = n(v[4]);
    let angles = [q_2, q_1, q_3, q_4, q_5];
    let circular = N::sin_cos_all(angles);
    let (sin_q_2, cos_q_2) = circular[0];
    let (sin_q_1, cos_q_1) = circular[1];
    let (sin_q_3, cos_q_3) = circular[2];
    let (sin_q_4, cos_q_4) = circular[3];
    let (sin_q_5, cos_q_5) = circular[4];
    let r9 = n(p.l) * cos_q_1;
    let t0 = n(p.l) * sin_q_1;
    let t1 = sin_q_2.mul_add(sin_q_1, cos_q_2 * cos_q_1) * n(p.k4);
    let t2 = n(p.k3) * sin_q_3.mul_add(sin_q_1, cos_q_3 * cos_q_1);
    let t3 = n(p.k2) * sin_q_4.mul_add(sin_q_1, cos_q_4 * cos_q_1);
    let t4 = n(p.k19) * t1;
    let t5 = sin_q_5.mul_add(sin_q_1, cos_q_5 * cos_q_1);
    let t6 = n(p.half_l_squared_m) * t5;
    let t7 = n(p.k19) * t2;
    let t8 = sin_q_5.mul_add(sin_q_2, cos_q_5 * cos_q_2);
    let t9 = n(p.k19) * t3;
    let t10 = t1.neg_mul_add(t4, n(p.k6));
    let t11 = n(p.k19) * t0;
    let t12 = n(p.k19) * t6;
    let t13 = n(p.k3) * sin_q_3.mul_add(sin_q_2, cos_q_3 * cos_q_2);
    let t14 = t1.neg_mul_add(t7, t13);
    let t15 = n(p.k2) * sin_q_4.mul_add(sin_q_2, cos_q_4 * cos_q_2);
    let t16 = t1.neg_mul_add(t9, t15);
    let t17 = n(p.k2) * sin_q_4.mul_add(sin_q_3, cos_q_4 * cos_q_3);
    let t18 = N::ONE / t10;
    let t19 = t1.neg_mul_add(t12, n(p.half_l_squared_m) * t8);
    let t20 = sin_q_5.mul_add(sin_q_3, cos_q_5 * cos_q_3);
    let t21 = t1.neg_mul_add(t11, n(p.l) * sin_q_2);
    let r10 = n(p.l) * cos_q_2;
    let t22 = sin_q_5.mul_add(sin_q_4, cos_q_5 * cos_q_4);
    let t23 = r9 * n(p.k19);
    let r11 = n(p.l) * cos_q_3;
    let r12 = n(p.l) * cos_q_4;
    let t24 = t1.neg_mul_add(t23, r10);
    let r13 = n(p.l) * cos_q_5;
    let t25 = t18 * t14;
    let t26 = t18 * t16;
    let t27 = t18 * t19;
    let t28 = t18 * t21;
    let t29 = t18 * t24;
    let t30 = t14.neg_mul_add(t25, t2.neg_mul_add(t7, n(p.k7)));
    let t31 = t14.neg_mul_add(t26, t2.neg_mul_add(t9, t17));
    let t32 = t2.neg_mul_add(t12, n(p.half_l_squared_m) * t20);
    let t33 = t14.neg_mul_add(t27, t32);
    let t34 = t3.neg_mul_add(t12, n(p.half_l_squared_m) * t22);
    let t35 = t2.neg_mul_add(t11, n(p.l) * sin_q_3);
    let t36 = t14.neg_mul_add(t28, t35);
    let t37 = t3.neg_mul_add(t11, n(p.l) * sin_q_4);
    let t38 = N::ONE / t30;
    let t39 = t6.neg_mul_add(t11, n(p.l) * sin_q_5);
    let t40 = t14.neg_mul_add(t29, t2.neg_mul_add(t23, r11));
    let t41 = sin_q_2.mul_add(q_2_dot, sin_q_1 * q_1_dot);
    let t42 = cos_q_2.mul_add(q_2_dot, cos_q_1 * q_1_dot);
    let t43 = t38 * t31;
    let t44 = t38 * t33;
    let t45 = t38 * t36;
    let t46 = t38 * t40;
    let t47 = t16.neg_mul_add(t26, t3.neg_mul_add(t9, n(p.k8)));
    let t48 = t31.neg_mul_add(t43, t47);
    let t49 = t31.neg_mul_add(t44, t16.neg_mul_add(t27, t34));
    let t50 = t19.neg_mul_add(t27, t6.neg_mul_add(t12, n(p.k9)));
    let t51 = t31.neg_mul_add(t45, t16.neg_mul_add(t28, t37));
    let t52 = t16.neg_mul_add(t29, t3.neg_mul_add(t23, r12));
    let t53 = t31.neg_mul_add(t46, t52);
    let t54 = t19.neg_mul_add(t29, t6.neg_mul_add(t23, r13));
    let t55 = N::ONE / t48;
    let t56 = n(p.l) * (cos_q_5 + (cos_q_4 + (cos_q_3 + (cos_q_2 + cos_q_1))));
    let t57 = sin_q_4.mul_add(q_4_dot, sin_q_3.mul_add(q_3_dot, t41));
    let t58 = sin_q_5.mul_add(q_5_dot, t57);
    let t59 = cos_q_4.mul_add(q_4_dot, cos_q_3.mul_add(q_3_dot, t42));
    let t60 = n(p.d) - t56;
    let r1 = n(p.l) * (sin_q_5 + (sin_q_4 + (sin_q_3 + (sin_q_2 + sin_q_1))));
    let t61 = n(p.l) * t58;
    let r3 = n(p.l) * cos_q_5.mul_add(q_5_dot, t59);
    let t62 = t55 * t49;
    let t63 = t55 * t51;
    let t64 = t55 * t53;
    let t65 = t49.neg_mul_add(t62, t33.neg_mul_add(t44, t50));
    let t66 = t33.neg_mul_add(t45, t19.neg_mul_add(t28, t39));
    let t67 = t49.neg_mul_add(t63, t66);
    let t68 = t36.mul_add(t45, t21.mul_add(t28, t0 * t11));
    let t69 = t49.neg_mul_add(t64, t33.neg_mul_add(t46, t54));
    let t70 = t36.mul_add(t46, t21.mul_add(t29, t0 * t23));
    let t71 = N::ONE / t65;
    let t72 = t71 * t67;
    let t73 = t71 * t69;
    let r33 = t67.mul_add(t72, t51.mul_add(t63, t68));
    let t74 = t67.mul_add(t73, t51.mul_add(t64, t70));
    let t75 = N::ONE / r33;
    let t76 = t69.mul_add(t73, t24.mul_add(t29, r9 * t23));
    let r36 = t76 + t53.mul_add(t64, t40 * t46);
    let t77 = t75 * t74;
    let r34 = t74.neg_mul_add(t77, r36);
    let t78 = N::ONE / r34;
    let t79 = t60.neg_mul_add(t77, r1) * t78;
    let t80 = t78 * t77.neg_mul_add(t61, r3);
    let r29 = t77.neg_mul_add(t79, t60 * t75);
    let r31 = t77.neg_mul_add(t80, t75 * t61);
    let t81 = t72.mul_add(r29, t73 * t79);
    let t82 = t72.mul_add(r31, t73 * t80);
    let r22 = t62.mul_sub(t81, t63.mul_add(r29, t64 * t79));
    let r27 = t62.mul_sub(t82, t63.mul_add(r31, t64 * t80));
    let t83 = t44.neg_mul_add(t81, t45.mul_add(r29, t46 * t79));
    let t84 = t43.mul_add(r22, t83);
    let t85 = t27.mul_sub(t81, t28.mul_add(r29, t29 * t79));
    let t86 = t12.neg_mul_add(t81, t11.mul_add(r29, t23 * t79));
    let t87 = t44.neg_mul_add(t82, t45.mul_add(r31, t46 * t80));
    let t88 = t43.mul_add(r27, t87);
    let t89 = t27.mul_sub(t82, t28.mul_add(r31, t29 * t80));
    let t90 = t12.neg_mul_add(t82, t11.mul_add(r31, t23 * t80));
    let r20 = t25.mul_add(t84, t26.neg_mul_add(r22, t85));
    let r25 = t25.mul_add(t88, t26.neg_mul_add(r27, t89));
    let t91 = t4.mul_add(r20, t7.neg_mul_add(t84, t9.mul_add(r22, t86)));
    let t92 = t4.mul_add(r25, t7.neg_mul_add(t88, t9.mul_add(r27, t90)));
    let r0 = t56 - n(p.d);
    let r2 = n(p.minus_l) * t58;
    let r4 = sin_q_1 * n(p.minus_l);
    let r5 = sin_q_2 * n(p.minus_l);
    let r6 = sin_q_3 * n(p.minus_l);
    let r7 = sin_q_4 * n(p.minus_l);
    let r8 = sin_q_5 * n(p.minus_l);
    let r19 = -t91;
    let r21 = -t84;
    let r23 = -t81;
    let r24 = -t92;
    let r26 = -t88;
    let r28 = -t82;
    let r30 = -t79;
    let r32 = -t80;
    let sound = PIVOTS.hold(n(p.k5), n(p.k5))
        & PIVOTS.hold(t10, n(p.k6))
        & PIVOTS.hold(t30, n(p.k7))
        & PIVOTS.hold(t48, n(p.k8))
        & PIVOTS.hold(t65, n(p.k9))
        & PIVOTS.hold(r33, r33)
        & PIVOTS.hold(r34, r36)
        & r24.is_finite();
    if !sound {
        let pivots = [
            (0, n(p.k5), n(p.k5)),
            (1, t10, n(p.k6)),
            (2, t30, n(p.k7)),
            (3, t48, n(p.k8)),
            (4, t65, n(p.k9)),
            (5, r33, r33),
            (6, r34, r36),
        ];
        PIVOTS.check(pivots)?;
    }
    let projection = [
        r0.store(),
        r1.store(),
        r2.store(),
        r3.store(),
        r4.store(),
        r5.store(),
        r6.store(),
        r7.store(),
        r8.store(),
        r9.store(),
        r10.store(),
        r11.store(),
        r12.store(),
        r13.store(),
        n(p.k5).store(),
        n(p.k6).store(),
        n(p.k7).store(),
        n(p.k8).store(),
        n(p.k9).store(),
        r19.store(),
        r20.store(),
        r21.store(),
        r22.store(),
        r23.store(),
        r24.store(),
        r25.store(),
        r26.store(),
        r27.store(),
        r28.store(),
        r29.store(),
        r30.store(),
        r31.store(),
        r32.store(),
        r33.store(),
        r34.store(),
        r33.store(),
        r36.store(),
    ];
    Ok(projection)
}

/// Kinetic energy `T`, in J.
///
/// ```text
/// T = …
/// ```
pub fn kinetic_energy<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 5],
    v: &[S; 5],
) -> S {
    let q_1 = q[0];
    let q_2 = q[1];
    let q_3 = q[2];
    let q_4 = q[3];
    let q_5 = q[4];
    let q_1_dot = v[0];
    let q_2_dot = v[1];
    let q_3_dot = v[2];
    let q_4_dot = v[3];
    let q_5_dot = v[4];
    let (sin_q_2, cos_q_2) = q_2.sin_cos();
    let (sin_q_1, cos_q_1) = q_1.sin_cos();
    let (sin_q_3, cos_q_3) = q_3.sin_cos();
    let (sin_q_4, cos_q_4) = q_4.sin_cos();
    let (sin_q_5, cos_q_5) = q_5.sin_cos();
    let t0 = p.l * q_1_dot;
    let t1 = p.half_l * q_5_dot;
    let t2 = sin_q_2 * q_2_dot;
    let t3 = sin_q_3 * q_3_dot;
    let t4 = cos_q_2 * q_2_dot;
    let t5 = cos_q_3 * q_3_dot;
    let t6 = sin_q_4 * q_4_dot;
    let t7 = cos_q_4 * q_4_dot;
    let t8 = t2 + sin_q_1 * q_1_dot;
    let t9 = p.half_l * t2 + sin_q_1 * t0;
    let t10 = t4 + cos_q_1 * q_1_dot;
    let t11 = p.half_l * t4 + cos_q_1 * t0;
    let t12 = t3 + t8;
    let t13 = p.half_l * t3 + p.l * t8;
    let t14 = t5 + t10;
    let t15 = p.half_l * t5 + p.l * t10;
    let t16 = p.half_l * t6 + p.l * t12;
    let t17 = p.half_l * t7 + p.l * t14;
    let t18 = t1 * sin_q_5 + p.l * (t6 + t12);
    let t19 = t1 * cos_q_5 + p.l * (t7 + t14);
    let t20 = p.m * (t11 * t11 + t9 * t9) + q_2_dot * (q_2_dot * p.k0);
    let t21 = p.m * (t15 * t15 + t13 * t13) + q_3_dot * (q_3_dot * p.k0);
    let t22 = S::from_f64(0.5) * t20 + q_1_dot * (q_1_dot * p.k1);
    let t23 = p.m * (t17 * t17 + t16 * t16) + q_4_dot * (q_4_dot * p.k0);
    let t24 = p.m * (t19 * t19 + t18 * t18) + q_5_dot * (q_5_dot * p.k0);
    let t25 = S::from_f64(0.5) * t23 + (S::from_f64(0.5) * t21 + t22);
    S::from_f64(0.5) * t24 + t25
}

/// Potential energy `V`, in J.
///
/// ```text
/// V = 9/2*l*m*g*sin(q[1]) + 7/2*l*m*g*sin(q[2]) + 5/2*l*m*g*sin(q[3]) + 3/2*l*m*g*sin(q[4])
///     + 1/2*l*m*g*sin(q[5])
/// ```
pub fn potential_energy<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 5]) -> S {
    let q_1 = q[0];
    let q_2 = q[1];
    let q_3 = q[2];
    let q_4 = q[3];
    let q_5 = q[4];
    let sin_q_3 = q_3.sin();
    let sin_q_2 = q_2.sin();
    let sin_q_1 = q_1.sin();
    let sin_q_4 = q_4.sin();
    let sin_q_5 = q_5.sin();
    let t0 = sin_q_2 + sin_q_1;
    let t1 = sin_q_3 + t0;
    let t2 = sin_q_3 * p.half_l + t0 * p.l + (sin_q_1 * p.l + sin_q_2 * p.half_l);
    let t3 = sin_q_5 * p.half_l + p.l * (sin_q_4 + t1);
    let t4 = (t2 + (sin_q_4 * p.half_l + p.l * t1) + t3) * p.m_g;
    t4 - sin_q_1 * p.minus_half_l_m_g
}

::lagrangian::emitted::implement! {
    machine ClosedPendulum "ClosedPendulum" over S, R;
    parameters { l, m, d, g } [
        l: "l" "m" = 1.0;
        m: "m" "kg" = 1.0;
        d: "d" "m" = 2.0;
        g: "g" "m/s^2" = 9.81;
    ]
    coordinates 5 Coordinates { q: [q_1, q_2, q_3, q_4, q_5] } [
        q_1: "q[1]" "rad";
        q_2: "q[2]" "rad";
        q_3: "q[3]" "rad";
        q_4: "q[4]" "rad";
        q_5: "q[5]" "rad";
    ]
    inputs Inputs {} [], defined here
    outputs Outputs {} [], defined here
    prepared Prepared {
        l, m, d, g, half_l, k0, m_g, k1, half_l_squared_m, k2, k3, k4, k5, k6, k7, k8, k9, half_m,
        quarter_l_m, half_l_m, minus_l, k10, k11, k12, k13, minus_half_l_m_g, k14, half_l_squared,
        k15, k16, quarter_l_squared, k17, k18, inverse_m, minus_m, k19,
    }
    singular singular
    accelerations { (p, t, q, v, u) Accelerations { p, q, v } }
    system {
        matrix mass_matrix(p, t, q) = mass_matrix(p, q);
        vector bias(p, t, q, v) = bias(p, q, v);
        vector applied(p, t, q, v, u) = applied(p, q);
        vector forces(p, t, q, v, u) = forces(p, q, v);
        numbers constraint_positions(p, t, q) = constraint_positions(p, q);
        numbers constraint_rates(p, t, q, v) = constraint_rates(p, q, v);
        numbers constraint_matrix(p, t, q) = constraint_matrix(p, q);
        numbers constraint_bias(p, t, q, v) = constraint_bias(p, q, v);
        number kinetic_energy(p, t, q, v) = kinetic_energy(p, q, v);
        number potential_energy(p, t, q, u) = potential_energy(p, q);
        number dissipation(p, t, q, v, u);
        number work_rate(p, t, q, v, a, u);
        number dissipation_rate(p, t, q, v, u);
        outputs outputs(p, t, q, v, a, u) = Outputs {};
        constraints constraints(p) = [("along", "m", "N", true), ("across", "m", "N", true)];
        solved_in_place projection(p, t, q, v) = ProjectionCall { p, q, v };
        solved multipliers(p, t, q, v, u) = multipliers(p, q, v);
        workspace with_workspace(p) = ::lagrangian::emitted::constraint_workspace(5, 2);
    }
    absent [MAY_SLIDE MAY_COLLIDE]
    intervals []
    lanes [N]
    numbers []
}
