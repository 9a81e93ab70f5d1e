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
        let k3 = S::from_f64(0.5) * t2;
        let t3 = S::from_ratio(1, 6);
        let t4 = S::from_ratio(4, 3);
        let t5 = S::from_ratio(1, 3);
        let k13 = t1 * t5;
        let k17 = t2 * S::from_f64(1.5);
        let k18 = t2 * S::from_f64(2.5);
        let k19 = t2 * S::from_f64(3.5);
        let k20 = t2 * S::from_f64(4.5);
        let t6 = self.l * self.l;
        let t7 = S::ONE / self.l;
        let k34 = S::ONE / self.m;
        let t8 = t7 * t7 * k34;
        let k0 = self.l * S::from_f64(0.5);
        let k1 = t1 * S::from_ratio(1, 12);
        let k2 = self.m * self.g;
        let k4 = t1 * t3;
        let k5 = S::from_f64(0.5) * t1;
        let k6 = t1 * S::from_f64(1.5);
        let k7 = t1 * S::from_f64(2.5);
        let k8 = t1 * S::from_f64(3.5);
        let k9 = t1 * S::from_ratio(13, 3);
        let k10 = t1 * S::from_ratio(10, 3);
        let k11 = t1 * S::from_ratio(7, 3);
        let k12 = t1 * t4;
        let k14 = self.m * S::from_f64(0.5);
        let k15 = t0 * S::from_f64(0.25);
        let k16 = S::from_f64(0.5) * t0;
        let k21 = -self.l;
        let k22 = -k20;
        let k23 = -k19;
        let k24 = -k18;
        let k25 = -k17;
        let k26 = -k3;
        let k27 = t3 * t6;
        let k28 = S::from_f64(0.5) * t6;
        let k29 = t5 * t6;
        let k30 = t4 * t6;
        let k31 = S::from_f64(0.25) * t6;
        let k32 = S::from_f64(1.5) * t7;
        let k33 = t8 * S::from_f64(3.0);
        let k35 = -self.m;
        let k36 = t8 * S::from_ratio(3, 13);
        let pivots = [(4, k13, k13)];
        Prepared {
            l: self.l,
            m: self.m,
            d: self.d,
            g: self.g,
            k0,
            k1,
            k2,
            k3,
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
            k14,
            k15,
            k16,
            k17,
            k18,
            k19,
            k20,
            k21,
            k22,
            k23,
            k24,
            k25,
            k26,
            k27,
            k28,
            k29,
            k30,
            k31,
            k32,
            k33,
            k34,
            k35,
            k36,
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

/// What can be set while a [`ClosedPendulum`] runs.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Inputs {}

/// What can be observed of a [`ClosedPendulum`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Outputs {}

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
    k0: S,
    /// `(1/12)*l^2*m`
    k1: S,
    /// `m*g`
    k2: S,
    /// `0.5*l*m*g`
    k3: S,
    /// `(1/6)*l^2*m`
    k4: S,
    /// `0.5*l^2*m`
    k5: S,
    /// `1.5*l^2*m`
    k6: S,
    /// `2.5*l^2*m`
    k7: S,
    /// `3.5*l^2*m`
    k8: S,
    /// `(13/3)*l^2*m`
    k9: S,
    /// `(10/3)*l^2*m`
    k10: S,
    /// `(7/3)*l^2*m`
    k11: S,
    /// `(4/3)*l^2*m`
    k12: S,
    /// `(1/3)*l^2*m`
    k13: S,
    /// `0.5*m`
    k14: S,
    /// `0.25*l*m`
    k15: S,
    /// `0.5*l*m`
    k16: S,
    /// `1.5*l*m*g`
    k17: S,
    /// `2.5*l*m*g`
    k18: S,
    /// `3.5*l*m*g`
    k19: S,
    /// `4.5*l*m*g`
    k20: S,
    /// `-l`
    k21: S,
    /// `-4.5*l*m*g`
    k22: S,
    /// `-3.5*l*m*g`
    k23: S,
    /// `-2.5*l*m*g`
    k24: S,
    /// `-1.5*l*m*g`
    k25: S,
    /// `-0.5*l*m*g`
    k26: S,
    /// `(1/6)*l^2`
    k27: S,
    /// `0.5*l^2`
    k28: S,
    /// `(1/3)*l^2`
    k29: S,
    /// `(4/3)*l^2`
    k30: S,
    /// `0.25*l^2`
    k31: S,
    /// `1.5/l`
    k32: S,
    /// `3/l^2/m`
    k33: S,
    /// `1/m`
    k34: S,
    /// `-m`
    k35: S,
    /// `(3/13)/l^2/m`
    k36: S,
    /// Why these parameters leave the machine without accelerations, if they do.
    singular: Option<::lagrangian::emitted::Singular>,
}

/// A pivot of an elimination that is not above this share of its diagonal element may be rounding
/// errors alone.
const PIVOTS: ::lagrangian::emitted::Pivots = ::lagrangian::emitted::Pivots {
    coordinates: 5,
    tolerance: 6.217248937900877e-15,
};

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
    let m21 = (sin_q_2 * sin_q_1 + cos_q_2 * cos_q_1) * p.k8;
    let m31 = p.k7 * (sin_q_1 * sin_q_3 + cos_q_1 * cos_q_3);
    let m32 = p.k7 * (sin_q_2 * sin_q_3 + cos_q_2 * cos_q_3);
    let m41 = p.k6 * (sin_q_1 * sin_q_4 + cos_q_1 * cos_q_4);
    let m42 = p.k6 * (sin_q_2 * sin_q_4 + cos_q_2 * cos_q_4);
    let m43 = p.k6 * (sin_q_3 * sin_q_4 + cos_q_3 * cos_q_4);
    let m51 = p.k5 * (sin_q_1 * sin_q_5 + cos_q_1 * cos_q_5);
    let m52 = p.k5 * (sin_q_2 * sin_q_5 + cos_q_2 * cos_q_5);
    let m53 = p.k5 * (sin_q_3 * sin_q_5 + cos_q_3 * cos_q_5);
    let m54 = p.k5 * (sin_q_4 * sin_q_5 + cos_q_4 * cos_q_5);
    [
        [p.k9, m21, m31, m41, m51],
        [m21, p.k10, m32, m42, m52],
        [m31, m32, p.k11, m43, m53],
        [m41, m42, m43, p.k12, m54],
        [m51, m52, m53, m54, p.k13],
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
    let t4 = t0 * p.k6;
    let t5 = q_5_dot * (q_5_dot * p.k5);
    let t6 = t1 * sin_q_3;
    let t7 = t2 * sin_q_2;
    let t8 = sin_q_1 * t3;
    let t9 = t1 * cos_q_3;
    let t10 = t2 * cos_q_2;
    let t11 = cos_q_1 * t3;
    let t12 = p.k7 * t6;
    let t13 = t7 + t8;
    let t14 = t9 * p.k7;
    let t15 = t5 * sin_q_5 + t4 * sin_q_4;
    let t16 = t10 + t11;
    let t17 = t5 * cos_q_5 + t4 * cos_q_4;
    let t18 = cos_q_5 * (t13 + (t6 + t0 * sin_q_4));
    let t19 = sin_q_1 * (t17 + (t14 + t10 * p.k8));
    let t20 = sin_q_2 * (t17 + (t14 + p.k8 * t11));
    let t21 = p.k6 * (sin_q_4 * (t9 + t16) - cos_q_4 * (t6 + t13));
    let h_q_1 = t19 - cos_q_1 * (t15 + (t12 + p.k8 * t7));
    let h_q_2 = t20 - cos_q_2 * (t15 + (t12 + p.k8 * t8));
    let h_q_3 = sin_q_3 * (t17 + p.k7 * t16) - cos_q_3 * (t15 + p.k7 * t13);
    let h_q_4 = t5 * (cos_q_5 * sin_q_4 - sin_q_5 * cos_q_4) + t21;
    let h_q_5 = p.k5 * (sin_q_5 * (t16 + (t9 + t0 * cos_q_4)) - t18);
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
    let q_q_1 = p.k22 * cos_q_1;
    let q_q_2 = p.k23 * cos_q_2;
    let q_q_3 = p.k24 * cos_q_3;
    let q_q_4 = p.k25 * cos_q_4;
    let q_q_5 = p.k26 * cos_q_5;
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
    let t4 = t0 * p.k6;
    let t5 = q_5_dot * (q_5_dot * p.k5);
    let t6 = t1 * sin_q_2;
    let t7 = t2 * sin_q_3;
    let t8 = t4 * sin_q_4;
    let t9 = sin_q_1 * t3;
    let t10 = t5 * sin_q_5;
    let t11 = t1 * cos_q_2;
    let t12 = t2 * cos_q_3;
    let t13 = p.k7 * t7;
    let t14 = cos_q_1 * t3;
    let t15 = t6 + t9;
    let t16 = t5 * cos_q_5 + t4 * cos_q_4;
    let t17 = t12 * p.k7;
    let t18 = t11 + t14;
    let t19 = sin_q_5 * (t18 + (t12 + t0 * cos_q_4));
    let t20 = cos_q_2 * (p.k19 - t8 - t13 - (t10 + p.k8 * t9));
    let t21 = t5 * (cos_q_5 * sin_q_4 - sin_q_5 * cos_q_4) + cos_q_4 * p.k17;
    let t22 = cos_q_1 * (t10 + p.k8 * t6 + (t13 + (t8 - p.k20)));
    let t23 = sin_q_3 * (t16 + p.k7 * t18) + cos_q_3 * (p.k18 - t8 - t10 - p.k7 * t15);
    let f_q_1 = t22 - sin_q_1 * (t16 + (t17 + t11 * p.k8));
    let f_q_2 = -(sin_q_2 * (t16 + (t17 + p.k8 * t14)) + t20);
    let f_q_3 = -t23;
    let f_q_4 = -(p.k6 * (sin_q_4 * (t12 + t18) - cos_q_4 * (t7 + t15)) + t21);
    let f_q_5 = -(p.k5 * (t19 - cos_q_5 * (t15 + (t7 + t0 * sin_q_4))) + cos_q_5 * p.k3);
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
    let phi1 = p.k21 * (q_5_dot * sin_q_5 + (q_4_dot * sin_q_4 + t0));
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
    let g1_1 = p.k21 * sin_q_1;
    let g1_2 = p.k21 * sin_q_2;
    let g1_3 = p.k21 * sin_q_3;
    let g1_4 = p.k21 * sin_q_4;
    let g1_5 = p.k21 * sin_q_5;
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

/// Accelerations `a`, the solution of `M a = f + G^T lambda`, `G a = gamma` eliminated along the
/// machine.
///
/// A pivot that vanishes is an error.
pub fn accelerations<S: ::lagrangian::emitted::Number>(
    p: &Prepared<S>,
    q: &[S; 5],
    v: &[S; 5],
) -> Result<[S; 5], ::lagrangian::emitted::Singular> {
    S::run(Accelerations { p, q, v })
}

/// A call of [`accelerations`], to be run with whatever instructions the processor has.
pub struct Accelerations<'a, S> {
    /// As `accelerations` takes it.
    pub p: &'a Prepared<S>,
    /// As `accelerations` takes it.
    pub q: &'a [S; 5],
    /// As `accelerations` takes it.
    pub v: &'a [S; 5],
}

impl<S: Copy> ::lagrangian::emitted::scalar::Kernel<S> for Accelerations<'_, S> {
    type Output = Result<[S; 5], ::lagrangian::emitted::Singular>;

    #[inline(always)]
    fn run<N: ::lagrangian::emitted::Scalar<Stored = S>>(self) -> Self::Output {
        let Self { p, q, v } = self;
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
        let t25 = t15.mul_add(t17, t12.mul_add(t16, n(p.k0) * t10));
        let t26 = t13.mul_add(t16, t12.mul_add(t17, n(p.k0) * t11));
        let t27 = n(p.l) * sin_q_5;
        let t28 = cos_q_5 * n(p.k32);
        let t29 = n(p.l) * cos_q_1;
        let t30 = sin_q_5 * n(p.k32);
        let t31 = sin_q_1 * t3;
        let t32 = t6.mul_add(t22, t7.mul_sub(t21, n(p.k27)));
        let t33 = sin_q_2 * n(p.k0);
        let t34 = cos_q_2 * (n(p.k28) * cos_q_1);
        let t35 = t27 * t28;
        let t36 = t30 * t27;
        let t37 = t7.mul_sub(t26, t6 * t25);
        let t38 = t29 * t3;
        let t39 = N::ONE / t32;
        let t40 = cos_q_2 * n(p.k0);
        let t41 = t19.mul_add(t4, t38);
        let t42 = sin_q_2.mul_add(t4, t31);
        let t43 = t40.mul_add(t4, t38);
        let t44 = t6.neg_mul_add(t36, t7.neg_mul_add(t35, t6));
        let t45 = n(p.g) - t4.mul_add(t33, t24 * t3);
        let t46 = n(p.l) * cos_q_5;
        let t47 = n(p.l).neg_mul_add(t42, n(p.g));
        let t48 = t28 * t46;
        let t49 = t30 * t46;
        let t50 = t31.neg_mul_add(n(p.k0), n(p.g)) * (cos_q_1 * n(p.k0));
        let t51 = t22 * t39;
        let t52 = t21 * t39;
        let t53 = t39 * n(p.k34);
        let t54 = t24.mul_add(t43, t31 * (cos_q_1 * n(p.k31)));
        let t55 = t22.neg_mul_add(t51, t15 + N::ONE);
        let t56 = t22.mul_add(t52, t12);
        let t57 = t21.neg_mul_add(t52, t13 + N::ONE);
        let t58 = t52.mul_add(t44, t35);
        let t59 = t51.mul_add(t44, t36);
        let t60 = t6.neg_mul_add(t49, t7.neg_mul_add(t48, t7));
        let t61 = t52.mul_add(t60, t48);
        let t62 = t56.mul_sub(t9, t55 * t8);
        let t63 = t9.mul_sub(t57, t8 * t56);
        let t64 = t51.mul_add(t60, t49);
        let t65 = t55.mul_add(t23, t56.mul_add(t20, t51.mul_add(t37, t25)));
        let t66 = t57.mul_add(t20, t52.neg_mul_add(t37, t26));
        let t67 = t56.mul_add(t23, t66);
        let t68 = t8.neg_mul_add(t59, t9.neg_mul_add(t58, t8));
        let t69 = cos_q_3.mul_add(t2, cos_q_2.mul_add(t4, cos_q_1 * t3));
        let t70 = t8.neg_mul_add(t64, t9.neg_mul_add(t61, t9));
        let t71 = t9.neg_mul_add(t63, t8.mul_add(t62, n(p.k27)));
        let t72 = t9.mul_sub(t67, t8 * t65);
        let t73 = N::ONE / t71;
        let t74 = t63 * t73;
        let t75 = t62 * t73;
        let t76 = t73 * n(p.k34);
        let t77 = t62.mul_add(t74, t56);
        let t78 = t63.mul_add(t74, t57 + N::from_f64(0.5));
        let t79 = t62.mul_add(t75, t55 + N::from_f64(0.5));
        let t80 = t74.neg_mul_add(t68, t58);
        let t81 = t75.mul_add(t68, t59);
        let t82 = t74.neg_mul_add(t70, t61);
        let t83 = t19.mul_sub(t78, t18 * t77);
        let t84 = t77.mul_sub(t19, t79 * t18);
        let t85 = t77.mul_add(t41, t74.mul_add(t72, t67));
        let t86 = t78.neg_mul_add(t47, t85);
        let t87 = t79.mul_add(t41, t75.mul_add(t72, t65));
        let t88 = t77.neg_mul_add(t47, t87);
        let t89 = t18.neg_mul_add(t81, t19.neg_mul_add(t80, t18));
        let t90 = t75.mul_add(t70, t64);
        let t91 = t18.neg_mul_add(t84, t19.mul_add(t83, n(p.k29)));
        let t92 = t83.mul_add(t29, sin_q_2.mul_add(n(p.k28) * sin_q_1, t34));
        let t93 = t84.neg_mul_add(t24, t92);
        let t94 = t29.mul_add(t78.mul_sub(t29, t77 * t24), n(p.k30));
        let t95 = t19.mul_sub(t86, t40.mul_add(t45, t43 * t33));
        let t96 = t18.neg_mul_add(t88, t95);
        let t97 = t29.mul_sub(t86, t54 + t29.mul_add(t45, t50));
        let t98 = t18.neg_mul_add(t90, t19.neg_mul_add(t82, t19));
        let t99 = N::ONE / t91;
        let t100 = t99 * t93;
        let t101 = t99 * n(p.k34);
        let t102 = t24.neg_mul_add(t77.mul_sub(t29, t79 * t24), t94);
        let t103 = t93.neg_mul_add(t100, t102);
        let t104 = t24.neg_mul_add(t81, t29.neg_mul_add(t80, t24));
        let t105 = t24.neg_mul_add(t90, t29.neg_mul_add(t82, t29));
        let t106 = N::ONE / t103;
        let t107 = t106 * t100.neg_mul_add(t96, t24.neg_mul_add(t88, t97));
        let t108 = t106 * n(p.k34);
        let t109 = t108 * t100.neg_mul_add(t89, t104);
        let t110 = t24 * t107;
        let t111 = t29 * t107;
        let t112 = t108 * t100.neg_mul_add(t98, t105);
        let t113 = t99 * t93.neg_mul_add(t107, t96);
        let t114 = t100.neg_mul_add(t109, t89 * t101);
        let t115 = t100.neg_mul_add(t112, t101 * t98);
        let t116 = t18 * t113;
        let t117 = t19 * t113;
        let t118 = t18.mul_add(t114, t24 * t109);
        let t119 = t19.mul_add(t114, t29 * t109);
        let t120 = t18.mul_add(t115, t24 * t112);
        let t121 = t116 + (t41 + t110);
        let t122 = t117 + (t47 + t111);
        let t123 = t19.mul_add(t115, t29 * t112);
        let t124 = t74.neg_mul_add(t119, t75.mul_add(t118, t68 * t76));
        let t125 = t11 + sin_q_4.mul_add(t1, sin_q_3.mul_add(t2, t42));
        let t126 = t74.neg_mul_add(t123, t75.mul_add(t120, t76 * t70));
        let t127 = t8.neg_mul_add(t124, t118);
        let t128 = t9.neg_mul_add(t124, t119);
        let t129 = sin_q_2.mul_add(t114, sin_q_1 * t109);
        let t130 = cos_q_2.mul_add(t114, cos_q_1 * t109);
        let t131 = t8.neg_mul_add(t126, t120);
        let t132 = t9.neg_mul_add(t126, t123);
        let t133 = t73 * t63.neg_mul_add(t122, t62.mul_add(t121, t72));
        let t134 = n(p.l).mul_add(t10 + cos_q_4.mul_add(t1, t69), t110);
        let t135 = cos_q_2.mul_add(t115, cos_q_1 * t112);
        let t136 = t9 * t133;
        let t137 = t8 * t133;
        let t138 = t52.neg_mul_add(t128, t51.neg_mul_add(t127, t44 * t53));
        let t139 = t52.neg_mul_add(t132, t51.neg_mul_add(t131, t53 * t60));
        let t140 = t136 + (t20 - t122);
        let t141 = t23 + t121 - t137;
        let t142 = t30.neg_mul_add(t6.mul_add(t138, t127), t27 * n(p.k33));
        let t143 = t28.neg_mul_add(t7.mul_add(t138, t128), t142);
        let t144 = t30.neg_mul_add(t6.mul_add(t139, t131), n(p.k33) * t46);
        let t145 = t28.neg_mul_add(t7.mul_add(t139, t132), t144);
        let t146 = t39 * t22.neg_mul_add(t141, t21.mul_add(t140, t37));
        let t147 = sin_q_4.mul_add(t138, sin_q_3.neg_mul_add(t124, t129));
        let t148 = cos_q_4.mul_add(t138, cos_q_3.neg_mul_add(t124, t130));
        let t149 = cos_q_4.mul_add(t139, cos_q_3.neg_mul_add(t126, t135));
        let t150 = t7 * t146;
        let t151 = t6 * t146;
        let t152 = n(p.l) * sin_q_5.mul_add(t143, t147);
        let t153 = n(p.l) * cos_q_5.mul_add(t143, t148);
        let t154 = n(p.l) * cos_q_5.mul_add(t145, t149);
        let t155 = N::ONE / t152;
        let t156 = cos_q_5 * (t16 + t140 - t150);
        let t157 = sin_q_5.mul_sub(t151 + (t17 + t141), t156);
        let t158 = N::from_f64(1.5) * t157;
        let t159 = t155 * t153;
        let t160 = sin_q_5.neg_mul_add(t158, t151 + (t116 + t134 - t137));
        let t161 = t136 + (n(p.l).mul_sub(t125, t111) - t117) - t150;
        let t162 = t153.neg_mul_add(t159, t154);
        let t163 = t159.mul_add(t160, cos_q_5.mul_add(t158, t161)) / t162;
        let t164 = t159.mul_add(t163, t155 * t160);
        let t165 = t145.neg_mul_add(t163, n(p.k32) * t157);
        let q_1_ddot = t109.neg_mul_add(t164, t112.mul_add(t163, t107));
        let q_2_ddot = t114.neg_mul_add(t164, t115.mul_add(t163, t113));
        let q_3_ddot = t124.mul_sub(t164, t126.mul_add(t163, t133));
        let q_4_ddot = t138.neg_mul_add(t164, t139.mul_add(t163, t146));
        let q_5_ddot = -t143.mul_add(t164, t165);
        let t166 = t32 * n(p.m);
        let t167 = t71 * n(p.k35);
        let t168 = t91 * n(p.m);
        let t169 = t103 * n(p.m);
        let sound = PIVOTS.hold(t166, n(p.k12))
            & PIVOTS.hold(t167, n(p.k11))
            & PIVOTS.hold(t168, n(p.k10))
            & PIVOTS.hold(t169, n(p.k9))
            & PIVOTS.hold(t152, t152)
            & PIVOTS.hold(t162, t154)
            & q_5_ddot.is_finite();
        if !sound {
            let pivots = [
                (3, t166, n(p.k12)),
                (2, t167, n(p.k11)),
                (1, t168, n(p.k10)),
                (0, t169, n(p.k9)),
                (5, t152, t152),
                (6, t162, t154),
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
}

/// Lagrange's multipliers `lambda` of `M a = f + G^T lambda`.
///
/// A pivot that vanishes is an error.
pub fn multipliers<S: ::lagrangian::emitted::Number>(
    p: &Prepared<S>,
    q: &[S; 5],
    v: &[S; 5],
) -> Result<[S; 2], ::lagrangian::emitted::Singular> {
    S::run(Multipliers { p, q, v })
}

/// A call of [`multipliers`], to be run with whatever instructions the processor has.
pub struct Multipliers<'a, S> {
    /// As `multipliers` takes it.
    pub p: &'a Prepared<S>,
    /// As `multipliers` takes it.
    pub q: &'a [S; 5],
    /// As `multipliers` takes it.
    pub v: &'a [S; 5],
}

impl<S: Copy> ::lagrangian::emitted::scalar::Kernel<S> for Multipliers<'_, S> {
    type Output = Result<[S; 2], ::lagrangian::emitted::Singular>;

    #[inline(always)]
    fn run<N: ::lagrangian::emitted::Scalar<Stored = S>>(self) -> Self::Output {
        let Self { p, q, v } = self;
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
        let t8 = sin_q_2.mul_add(sin_q_1, cos_q_2 * cos_q_1) * n(p.k8);
        let t9 = n(p.k7) * sin_q_1.mul_add(sin_q_3, cos_q_1 * cos_q_3);
        let t10 = n(p.k6) * sin_q_1.mul_add(sin_q_4, cos_q_1 * cos_q_4);
        let t11 = n(p.k36) * t8;
        let t12 = n(p.k5) * sin_q_1.mul_add(sin_q_5, cos_q_1 * cos_q_5);
        let t13 = n(p.k36) * t9;
        let t14 = n(p.k36) * t10;
        let t15 = t8.neg_mul_add(t11, n(p.k10));
        let t16 = cos_q_1 * t1;
        let t17 = n(p.k36) * t12;
        let t18 = n(p.k7) * sin_q_2.mul_add(sin_q_3, cos_q_2 * cos_q_3);
        let t19 = t8.neg_mul_add(t13, t18);
        let t20 = n(p.k6) * sin_q_2.mul_add(sin_q_4, cos_q_2 * cos_q_4);
        let t21 = t8.neg_mul_add(t14, t20);
        let t22 = n(p.k6) * sin_q_3.mul_add(sin_q_4, cos_q_3 * cos_q_4);
        let t23 = N::ONE / t15;
        let t24 = n(p.k5) * sin_q_2.mul_add(sin_q_5, cos_q_2 * cos_q_5);
        let t25 = t8.neg_mul_add(t17, t24);
        let t26 = t6 + t7;
        let t27 = sin_q_3 * t2;
        let t28 = t5 + t16;
        let t29 = cos_q_3 * t2;
        let t30 = sin_q_1 * n(p.l);
        let t31 = n(p.k5) * sin_q_3.mul_add(sin_q_5, cos_q_3 * cos_q_5);
        let t32 = sin_q_4 * t3;
        let t33 = sin_q_5 * t4;
        let t34 = t27 + t26;
        let t35 = cos_q_4 * t3;
        let t36 = t29 + t28;
        let t37 = cos_q_5 * t4;
        let t38 = n(p.k36) * t30;
        let t39 = n(p.k5) * sin_q_4.mul_add(sin_q_5, cos_q_4 * cos_q_5);
        let t40 = t32 + t34;
        let t41 = t35 + t36;
        let t42 = t23 * t19;
        let t43 = t23 * t21;
        let t44 = t23 * t25;
        let t45 = t8.neg_mul_add(t38, sin_q_2 * n(p.l));
        let t46 = t19.neg_mul_add(t42, t9.neg_mul_add(t13, n(p.k11)));
        let t47 = t19.neg_mul_add(t43, t9.neg_mul_add(t14, t22));
        let t48 = t19.neg_mul_add(t44, t9.neg_mul_add(t17, t31));
        let t49 = n(p.l).mul_add(t41, n(p.k0) * t37);
        let t50 = N::ONE / t46;
        let t51 = n(p.l).mul_add(t36, n(p.k0) * t35);
        let t52 = t23 * t45;
        let t53 = cos_q_1 * n(p.l);
        let t54 = n(p.g) - n(p.l).mul_add(t40, t33 * n(p.k0));
        let t55 = n(p.g) - n(p.l).mul_add(t34, n(p.k0) * t32);
        let t56 = t49 + t51;
        let t57 = n(p.l).mul_add(t28, n(p.k0) * t29);
        let t58 = t9.neg_mul_add(t38, sin_q_3 * n(p.l));
        let t59 = t19.neg_mul_add(t52, t58);
        let t60 = n(p.k36) * t53;
        let t61 = t54 + t55;
        let t62 = n(p.g) - n(p.l).mul_add(t26, n(p.k0) * t27);
        let t63 = n(p.k0).mul_add(t5, n(p.l) * t16);
        let t64 = t50 * t47;
        let t65 = t50 * t48;
        let t66 = t50 * t59;
        let t67 = t10.neg_mul_add(t38, sin_q_4 * n(p.l));
        let t68 = t8.neg_mul_add(t60, cos_q_2 * n(p.l));
        let t69 = t21.neg_mul_add(t43, t10.neg_mul_add(t14, n(p.k12)));
        let t70 = t47.neg_mul_add(t64, t69);
        let t71 = t21.neg_mul_add(t44, t10.neg_mul_add(t17, t39));
        let t72 = t47.neg_mul_add(t65, t71);
        let t73 = t25.neg_mul_add(t44, t12.neg_mul_add(t17, n(p.k13)));
        let t74 = n(p.g) - n(p.k0).mul_add(t6, n(p.l) * t7);
        let t75 = n(p.m) * (t56 + t57);
        let t76 = N::ONE / t70;
        let t77 = t47.neg_mul_add(t66, t21.neg_mul_add(t52, t67));
        let t78 = t12.neg_mul_add(t38, sin_q_5 * n(p.l));
        let t79 = t23 * t68;
        let t80 = n(p.m) * (t61 + t62);
        let t81 = n(p.k14) * n(p.k0).neg_mul_add(t7, n(p.g));
        let t82 = t9.neg_mul_add(t60, cos_q_3 * n(p.l));
        let t83 = t19.neg_mul_add(t79, t82);
        let t84 = t76 * t72;
        let t85 = t76 * t77;
        let t86 = t72.neg_mul_add(t84, t48.neg_mul_add(t65, t73));
        let t87 = t48.neg_mul_add(t66, t25.neg_mul_add(t52, t78));
        let t88 = t72.neg_mul_add(t85, t87);
        let t89 = t50 * t83;
        let t90 = t10.neg_mul_add(t60, cos_q_4 * n(p.l));
        let t91 = sin_q_1 * (t75 + n(p.m).mul_add(t63, t16 * n(p.k15)));
        let t92 = sin_q_4 * t49.mul_add(n(p.m), n(p.k14) * t51);
        let t93 = sin_q_2 * n(p.k14).mul_add(t63, t75);
        let t94 = N::ONE / t86;
        let t95 = sin_q_3 * n(p.m).mul_add(t56, n(p.k14) * t57);
        let t96 = t59.mul_add(t66, t45.mul_add(t52, t30 * t38));
        let t97 = t47.neg_mul_add(t89, t21.neg_mul_add(t79, t90));
        let t98 = t12.neg_mul_add(t60, cos_q_5 * n(p.l));
        let t99 = cos_q_1.mul_add(t80 + n(p.m).mul_add(t74, t81), t91);
        let t100 = n(p.l) * t99;
        let t101 = cos_q_4.mul_add(t54.mul_add(n(p.m), n(p.k14) * t55), t92);
        let t102 = cos_q_3.mul_add(n(p.m).mul_add(t61, n(p.k14) * t62), t95);
        let t103 = t76 * t97;
        let t104 = n(p.l) * cos_q_2.mul_add(n(p.k14).mul_add(t74, t80), t93);
        let t105 = t11.mul_sub(t100, t104);
        let t106 = cos_q_5.mul_add(t54, sin_q_5 * t49) * n(p.k16);
        let t107 = t48.neg_mul_add(t89, t25.neg_mul_add(t79, t98));
        let t108 = t72.neg_mul_add(t103, t107);
        let t109 = t94 * t88;
        let t110 = t42.neg_mul_add(t105, t13.mul_sub(t100, n(p.l) * t102));
        let t111 = t38.neg_mul_add(t100, n(p.l) * (t37 + t41));
        let t112 = t60.mul_add(t100, n(p.l) * (t33 + t40));
        let t113 = t88.mul_add(t109, t77.mul_add(t85, t96));
        let t114 = t94 * t108;
        let t115 = t59.mul_add(t89, t45.mul_add(t79, t30 * t60));
        let t116 = t43.neg_mul_add(t105, t14.mul_sub(t100, n(p.l) * t101));
        let t117 = t64.neg_mul_add(t110, t116);
        let t118 = t44.neg_mul_add(t105, t17.mul_sub(t100, t106));
        let t119 = N::ONE / t113;
        let t120 = t88.mul_add(t114, t77.mul_add(t103, t115));
        let t121 = t84.neg_mul_add(t117, t65.neg_mul_add(t110, t118));
        let t122 = t66.mul_add(t110, t52.mul_add(t105, t111));
        let t123 = t89.neg_mul_add(t110, t79.neg_mul_add(t105, t112));
        let t124 = t109.mul_add(t121, t85.mul_add(t117, t122));
        let t125 = t108.mul_add(t114, t68.mul_add(t79, t53 * t60));
        let t126 = t125 + t97.mul_add(t103, t83 * t89);
        let t127 = t119 * t120;
        let t128 = t114.neg_mul_add(t121, t103.neg_mul_add(t117, t123));
        let t129 = t120.neg_mul_add(t127, t126);
        let lambda2 = t127.mul_add(t124, t128) / t129;
        let lambda1 = t127.mul_add(lambda2, t119 * t124);
        let sound = PIVOTS.hold(n(p.k9), n(p.k9))
            & PIVOTS.hold(t15, n(p.k10))
            & PIVOTS.hold(t46, n(p.k11))
            & PIVOTS.hold(t70, n(p.k12))
            & PIVOTS.hold(t86, n(p.k13))
            & PIVOTS.hold(t113, t113)
            & PIVOTS.hold(t129, t126)
            & lambda1.is_finite();
        if !sound {
            let pivots = [
                (0, n(p.k9), n(p.k9)),
                (1, t15, n(p.k10)),
                (2, t46, n(p.k11)),
                (3, t70, n(p.k12)),
                (4, t86, n(p.k13)),
                (5, t113, t113),
                (6, t129, t126),
            ];
            PIVOTS.check(pivots)?;
        }
        let multipliers = [lambda1.store(), lambda2.store()];
        Ok(multipliers)
    }
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
    let t1 = p.k0 * q_5_dot;
    let t2 = sin_q_2 * q_2_dot;
    let t3 = sin_q_3 * q_3_dot;
    let t4 = cos_q_2 * q_2_dot;
    let t5 = cos_q_3 * q_3_dot;
    let t6 = sin_q_4 * q_4_dot;
    let t7 = cos_q_4 * q_4_dot;
    let t8 = t2 + sin_q_1 * q_1_dot;
    let t9 = p.k0 * t2 + sin_q_1 * t0;
    let t10 = t4 + cos_q_1 * q_1_dot;
    let t11 = p.k0 * t4 + cos_q_1 * t0;
    let t12 = t3 + t8;
    let t13 = p.k0 * t3 + p.l * t8;
    let t14 = t5 + t10;
    let t15 = p.k0 * t5 + p.l * t10;
    let t16 = p.k0 * t6 + p.l * t12;
    let t17 = p.k0 * t7 + p.l * t14;
    let t18 = t1 * sin_q_5 + p.l * (t6 + t12);
    let t19 = t1 * cos_q_5 + p.l * (t7 + t14);
    let t20 = p.m * (t11 * t11 + t9 * t9) + q_2_dot * (q_2_dot * p.k1);
    let t21 = p.m * (t15 * t15 + t13 * t13) + q_3_dot * (q_3_dot * p.k1);
    let t22 = S::from_f64(0.5) * t20 + q_1_dot * (q_1_dot * p.k4);
    let t23 = p.m * (t17 * t17 + t16 * t16) + q_4_dot * (q_4_dot * p.k1);
    let t24 = p.m * (t19 * t19 + t18 * t18) + q_5_dot * (q_5_dot * p.k1);
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
    let t2 = p.k0 * sin_q_3 + p.l * t0 + (p.k0 * sin_q_2 + p.l * sin_q_1);
    let t3 = p.k0 * sin_q_5 + p.l * (sin_q_4 + t1) + (p.k0 * sin_q_4 + p.l * t1 + t2);
    t3 * p.k2 + sin_q_1 * p.k3
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
    inputs Inputs {} []
    outputs Outputs {} []
    prepared Prepared {
        l, m, d, g, k0, k1, k2, k3, k4, k5, k6, k7, k8, k9, k10, k11, k12, k13, k14, k15, k16, k17,
        k18, k19, k20, k21, k22, k23, k24, k25, k26, k27, k28, k29, k30, k31, k32, k33, k34, k35,
        k36,
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
        solved multipliers(p, t, q, v, u) = multipliers(p, q, v);
        workspace with_workspace(p) = ::lagrangian::emitted::constraint_workspace(5, 2);
    }
    absent [MAY_SLIDE MAY_COLLIDE]
    intervals []
    lanes [N]
    numbers []
}
