// @generated from machines/bricard.machine by `cargo xtask generate`; edits are lost.

//! Bricard's mechanism: five bars and the ground, all of one length, joined to a ring by six hinges
//! whose axes are those of a cube's edges. By the count of its hinges it could not move; one of the
//! constraints follows from the others, and it does.
//!
//! Library of computational benchmark problems of the IFToMM, problem A04.
//!
//! 5 coordinates, 4 parameters, 3 outputs. Arithmetic of one call:
//!
//! | function | mul | add | div | sin cos | other | temporaries |
//! | --- | --: | --: | --: | --: | --: | --: |
//! | `prepare` | 36 | 24 | 0 | 0 | 0 | 60 |
//! | `mass_matrix` | 115 | 78 | 0 | 4 | 0 | 201 |
//! | `bias` | 138 | 90 | 0 | 4 | 0 | 236 |
//! | `applied` | 23 | 11 | 0 | 4 | 0 | 42 |
//! | `forces` | 142 | 93 | 0 | 4 | 0 | 243 |
//! | `constraint_positions` | 32 | 25 | 0 | 5 | 0 | 67 |
//! | `constraint_rates` | 98 | 64 | 0 | 5 | 0 | 172 |
//! | `constraint_matrix` | 96 | 48 | 0 | 5 | 0 | 154 |
//! | `constraint_bias` | 205 | 185 | 0 | 5 | 0 | 400 |
//! | `accelerations` | 806 | 604 | 10 | 5 | 0 | 1430 |
//! | `multipliers` | 768 | 570 | 10 | 5 | 0 | 1358 |
//! | `kinetic_energy` | 86 | 48 | 0 | 4 | 0 | 142 |
//! | `potential_energy` | 16 | 11 | 0 | 4 | 0 | 35 |
//! | `output_x3` | 4 | 3 | 0 | 3 | 0 | 12 |
//! | `output_y3` | 2 | 1 | 0 | 2 | 0 | 5 |
//! | `output_z3` | 4 | 3 | 0 | 3 | 0 | 12 |
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

/// Bricard's mechanism: five bars and the ground, all of one length, joined to a ring by six hinges
/// whose axes are those of a cube's edges. By the count of its hinges it could not move; one of the
/// constraints follows from the others, and it does.
///
/// Library of computational benchmark problems of the IFToMM, problem A04.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bricard<S = f64> {
    /// Length, width and mass of a bar. Unit: `m`. Default: 1.
    pub l: S,
    /// `w`. Unit: `m`. Default: 0.1.
    pub w: S,
    /// `m`. Unit: `kg`. Default: 1.
    pub m: S,
    /// `g`. Unit: `m/s^2`. Default: 9.81.
    pub g: S,
}

impl<S: ::lagrangian::emitted::Scalar> Bricard<S> {
    /// Computes what depends on the parameters alone, once.
    pub fn prepare(&self) -> Prepared<S> {
        let k0 = self.l * self.l;
        let t0 = self.w * self.w;
        let t1 = self.l * self.m;
        let t2 = k0 + t0;
        let t3 = self.m * t0;
        let t4 = self.l * t1;
        let t5 = self.g * t1;
        let k2 = t2 * (self.m * S::from_ratio(1, 12));
        let k4 = t3 * S::from_ratio(1, 6);
        let t6 = t3 * S::from_ratio(1, 3);
        let t7 = t4 * S::from_f64(2.0);
        let t8 = S::from_f64(0.5) * t3;
        let t9 = t4 * S::from_f64(3.0);
        let t10 = t3 * S::from_ratio(2, 3);
        let k3 = k2 + t4 * S::from_f64(0.25);
        let k5 = k3 - k4;
        let k6 = k3 + (t4 + k4);
        let k8 = k3 + (t6 + t7);
        let k10 = k3 + (t8 + t9);
        let k7 = t4 + k3 - t6;
        let k9 = k3 + t7 - t8;
        let k11 = k3 + t9 - t10;
        let k1 = self.l * S::from_f64(0.5);
        let k12 = k3 + (t10 + t4 * S::from_f64(4.0));
        let k13 = k0 * S::from_f64(0.25);
        let k14 = self.m * self.g;
        let k15 = S::from_f64(0.5) * t5;
        let k16 = self.l * S::from_f64(2.0);
        let k17 = k10 + k11;
        let k18 = k10 - k11;
        let k19 = t1 * S::from_f64(3.5);
        let k20 = k8 - k9;
        let k21 = t1 * S::from_f64(2.5);
        let k22 = k6 - k7;
        let k23 = t1 * S::from_f64(1.5);
        let k24 = k3 - k5;
        let k25 = S::from_f64(0.5) * t1;
        let k26 = (t2 + k0 * S::from_f64(3.0)) * (self.m * S::from_ratio(1, 24));
        let k27 = t4 * S::from_f64(3.5);
        let k28 = S::from_f64(0.5) * t4;
        let k29 = t4 * S::from_f64(2.5);
        let k30 = t4 * S::from_f64(1.5);
        let k31 = t1 * S::from_f64(7.0);
        let k32 = t5 * S::from_f64(1.5);
        let k33 = t5 * S::from_f64(2.5);
        let k34 = t5 * S::from_f64(3.5);
        let k35 = -self.l;
        Prepared {
            l: self.l,
            m: self.m,
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
        }
    }

    /// The start values of the description, at rest and `t = 0`.
    pub fn start(&self) -> ::lagrangian::emitted::State<Coordinates<S>> {
        let zero = S::ZERO;
        let q = [zero, zero, zero, zero, zero];
        let v = [S::ZERO; 5];
        ::lagrangian::emitted::State {
            t: 0.0,
            q: Coordinates::from_array(q),
            v: Coordinates::from_array(v),
        }
    }
}

/// The coordinates of [`Bricard`], or their rates, by name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coordinates<S = f64> {
    /// `q`. Unit: `rad`. Members: `q[1]` to `q[5]`.
    pub q: [S; 5],
}

/// What can be set while a [`Bricard`] runs.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Inputs {}

/// What can be observed of a [`Bricard`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outputs<S = f64> {
    /// `x3`. Unit: `m`.
    pub x3: S,
    /// `y3`. Unit: `m`.
    pub y3: S,
    /// `z3`. Unit: `m`.
    pub z3: S,
}

/// The parameters of a [`Bricard`], with the work done that depends on them alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prepared<S = f64> {
    /// `l`
    l: S,
    /// `m`
    m: S,
    /// `g`
    g: S,
    /// `l^2`
    k0: S,
    /// `0.5*l`
    k1: S,
    /// `(1/12)*m*(w^2 + l^2)`
    k2: S,
    /// `(1/12)*m*(w^2 + l^2) + 0.25*l^2*m`
    k3: S,
    /// `(1/6)*w^2*m`
    k4: S,
    /// `(1/12)*m*(w^2 + l^2) + 0.25*l^2*m - (1/6)*w^2*m`
    k5: S,
    /// `(1/12)*m*(w^2 + l^2) + 0.25*l^2*m + l^2*m + (1/6)*w^2*m`
    k6: S,
    /// `l^2*m + (1/12)*m*(w^2 + l^2) + 0.25*l^2*m - (1/3)*w^2*m`
    k7: S,
    /// `(1/12)*m*(w^2 + l^2) + 0.25*l^2*m + (1/3)*w^2*m + 2*l^2*m`
    k8: S,
    /// `(1/12)*m*(w^2 + l^2) + 0.25*l^2*m + 2*l^2*m - 0.5*w^2*m`
    k9: S,
    /// `(1/12)*m*(w^2 + l^2) + 0.25*l^2*m + 0.5*w^2*m + 3*l^2*m`
    k10: S,
    /// `(1/12)*m*(w^2 + l^2) + 0.25*l^2*m + 3*l^2*m - (2/3)*w^2*m`
    k11: S,
    /// `(1/12)*m*(w^2 + l^2) + 0.25*l^2*m + (2/3)*w^2*m + 4*l^2*m`
    k12: S,
    /// `0.25*l^2`
    k13: S,
    /// `m*g`
    k14: S,
    /// `0.5*l*m*g`
    k15: S,
    /// `2*l`
    k16: S,
    /// `(1/12)*m*(w^2 + l^2) + 0.25*l^2*m + 0.5*w^2*m + 3*l^2*m + (1/12)*m*(w^2 + l^2) + 0.25*l^2*m
    /// + 3*l^2*…`
    k17: S,
    /// `(1/12)*m*(w^2 + l^2) + 0.25*l^2*m + 0.5*w^2*m + 3*l^2*m - ((1/12)*m*(w^2 + l^2) +
    /// 0.25*l^2*m + 3*l^2…`
    k18: S,
    /// `3.5*l*m`
    k19: S,
    /// `(1/12)*m*(w^2 + l^2) + 0.25*l^2*m + (1/3)*w^2*m + 2*l^2*m - ((1/12)*m*(w^2 + l^2) +
    /// 0.25*l^2*m + 2*l…`
    k20: S,
    /// `2.5*l*m`
    k21: S,
    /// `(1/12)*m*(w^2 + l^2) + 0.25*l^2*m + l^2*m + (1/6)*w^2*m - (l^2*m + (1/12)*m*(w^2 + l^2) +
    /// 0.25*l^2*m…`
    k22: S,
    /// `1.5*l*m`
    k23: S,
    /// `(1/12)*m*(w^2 + l^2) + 0.25*l^2*m - ((1/12)*m*(w^2 + l^2) + 0.25*l^2*m - (1/6)*w^2*m)`
    k24: S,
    /// `0.5*l*m`
    k25: S,
    /// `(1/24)*m*(w^2 + l^2 + 3*l^2)`
    k26: S,
    /// `3.5*l^2*m`
    k27: S,
    /// `0.5*l^2*m`
    k28: S,
    /// `2.5*l^2*m`
    k29: S,
    /// `1.5*l^2*m`
    k30: S,
    /// `7*l*m`
    k31: S,
    /// `1.5*l*m*g`
    k32: S,
    /// `2.5*l*m*g`
    k33: S,
    /// `3.5*l*m*g`
    k34: S,
    /// `-l`
    k35: S,
}

/// A pivot of an elimination that is not above this share of its diagonal element may be rounding
/// errors alone.
const PIVOTS: ::lagrangian::emitted::Pivots = ::lagrangian::emitted::Pivots {
    coordinates: 5,
    tolerance: 8.881784197001252e-15,
};

/// Mass matrix `M`.
///
/// ```text
/// M[q[1], q[1]] = …
/// M[q[2], q[1]] = …
/// M[q[2], q[2]] = …
/// M[q[3], q[1]] = …
/// M[q[3], q[2]] = …
/// M[q[3], q[3]] = l^2*m*sin(q[4])^2*sin(q[5]) - 1/12*(w^2 - 4*l^2)*m*cos(q[4])^2*cos(q[5])^2
///     - 1/6*(10*l^2 - w^2)*m*cos(q[4])^2 + l^2*m*sin(q[4])*sin(q[5]) + 3*l^2*m*sin(q[4]) + 4*l^2*m
///     + 1/4*w^2*m
/// M[q[4], q[1]] = l^2*m*cos(q[2])*cos(q[3])*sin(q[5])
///     - 1/12*(4*l^2 - w^2)*m*cos(q[2])*cos(q[3])*cos(q[5])^2
///     + 1/6*(10*l^2 + w^2)*m*cos(q[2])*cos(q[3])
///     + 1/12*(4*l^2 - w^2)*m*cos(q[2])*sin(q[3])*sin(q[4])*cos(q[5])*sin(q[5])
///     + 1/2*l^2*m*cos(q[2])*sin(q[3])*sin(q[4])*cos(q[5])
///     + 1/12*(4*l^2 - w^2)*m*sin(q[2])*cos(q[4])*cos(q[5])*sin(q[5])
///     + 1/2*l^2*m*sin(q[2])*cos(q[4])*cos(q[5]) - 1/2*l^2*m*cos(q[3])*cos(q[4])*sin(q[5])
///     - 3/2*l^2*m*cos(q[3])*cos(q[4]) + 1/2*l^2*m*cos(q[3])*sin(q[5])*sin(q[4] - q[2])
///     + 3/2*l^2*m*cos(q[3])*sin(q[4] - q[2])
/// M[q[4], q[2]] = 3/2*l^2*m*sin(q[3])*sin(q[4])
///     - 1/12*(4*l^2 - w^2)*m*cos(q[3])*sin(q[4])*cos(q[5])*sin(q[5])
///     - 1/12*(4*l^2 - w^2)*m*sin(q[3])*cos(q[5])^2 + l^2*m*sin(q[3])*sin(q[5])
///     + 1/6*(10*l^2 + w^2)*m*sin(q[3]) + 1/2*l^2*m*sin(q[4])*sin(q[5])
///     - 1/2*l^2*m*sin(q[4])*cos(q[3] + q[5]) + 3/2*l^2*m*sin(q[4])
/// M[q[4], q[3]] = 1/12*(4*l^2 - w^2)*m*cos(q[4])*cos(q[5])*sin(q[5])
///     + 1/2*l^2*m*cos(q[4])*cos(q[5])
/// M[q[4], q[4]] = 1/12*(w^2 - 4*l^2)*m*cos(q[5])^2 + l^2*m*sin(q[5]) + 5/3*l^2*m + 1/6*w^2*m
/// M[q[5], q[1]] = (1/4*l^2*m + 1/12*(l^2 + w^2)*m)*(sin(q[2])*sin(q[4]) -
///     cos(q[2])*sin(q[3])*cos(q[4])) - 1/2*l*m*(cos(q[5])*(l*cos(q[2])*cos(q[3])*cos(q[4]) -
///     cos(q[3])*sin(q[4])*(-l*sin(q[2]) - l)) + sin(q[5])*((sin(q[3])*(-l*sin(q[2]) - l) -
///     l*sin(q[2])) - l*(sin(q[2])*sin(q[4]) - cos(q[2])*sin(q[3])*cos(q[4]))))
/// M[q[5], q[2]] = 1/12*(4*l^2 + w^2)*m*cos(q[3])*cos(q[4]) - 1/2*l^2*m*cos(q[4])*cos(q[5])
///     + 1/2*l^2*m*cos(q[4])*sin(q[5] - q[3])
/// M[q[5], q[3]] = 1/12*(4*l^2 + w^2)*m*sin(q[4]) - 1/2*l*m*sin(q[5])*(-l*sin(q[4]) - l)
/// M[q[5], q[5]] = 1/3*l^2*m + 1/12*w^2*m
/// ```
pub fn mass_matrix<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 5]) -> [[S; 5]; 5] {
    let q_2 = q[1];
    let q_3 = q[2];
    let q_4 = q[3];
    let q_5 = q[4];
    let (sin_q_2, cos_q_2) = q_2.sin_cos();
    let (sin_q_3, cos_q_3) = q_3.sin_cos();
    let (sin_q_4, cos_q_4) = q_4.sin_cos();
    let (sin_q_5, cos_q_5) = q_5.sin_cos();
    let t0 = sin_q_2 * p.l;
    let t1 = cos_q_2 * p.l;
    let t2 = cos_q_2 * sin_q_3;
    let t3 = cos_q_2 * cos_q_3;
    let t4 = p.k25 * sin_q_5;
    let t5 = p.l + t0;
    let t6 = cos_q_4 * t2 - sin_q_2 * sin_q_4;
    let t7 = p.k23 + t4;
    let t8 = t0 + sin_q_3 * t5;
    let t9 = p.l * sin_q_3;
    let t10 = sin_q_5 * t3 + cos_q_5 * (sin_q_4 * t2 + sin_q_2 * cos_q_4);
    let t11 = cos_q_4 * cos_q_5;
    let t12 = cos_q_3 * (cos_q_4 * t5 - sin_q_4 * t1);
    let t13 = sin_q_3 * p.k21;
    let t14 = t6 * t7;
    let t15 = (cos_q_4 * t1 + sin_q_4 * t5) * (cos_q_3 * cos_q_5);
    let t16 = sin_q_5 * p.k28;
    let t17 = p.k25 * t6;
    let t18 = sin_q_4 * cos_q_5;
    let t19 = p.l + t9;
    let t20 = t10 * p.k5 - p.k25 * (t12 - p.l * t3);
    let t21 = p.k25 * (t15 - sin_q_5 * (t8 - p.l * t6)) + t6 * p.k3;
    let t22 = t3 * p.k23 + p.k25 * t10;
    let t23 = sin_q_4 * t19;
    let t24 = cos_q_3 * t18 - sin_q_3 * sin_q_5;
    let t25 = cos_q_3 * cos_q_4;
    let t26 = t21 + (t6 * t16 + (t6 * p.k7 - p.k23 * t8));
    let m41 = sin_q_5 * t20 + (t10 * p.k28 + (t3 * p.k6 - p.k23 * t12));
    let t27 = (cos_q_5 * t19 - sin_q_5 * (p.l * cos_q_3)) * (p.k25 * cos_q_4);
    let t28 = p.k3 * t25;
    let t29 = cos_q_3 * (cos_q_4 * t22 - t17 * t18);
    let t30 = t29 + sin_q_3 * (t14 - sin_q_2 * p.k21);
    let t31 = t17 * t11 + sin_q_4 * t22;
    let t32 = cos_q_4 * t26 + t18 * t20;
    let t33 = p.k25 * (t9 + t23) - p.k5 * t24;
    let t34 = sin_q_4 * (sin_q_3 * p.k23 - p.k25 * t24) - t25 * (p.k25 * t11);
    let t35 = p.l * sin_q_4;
    let m31 = t11 * t20 + (t5 * t13 + sin_q_2 * p.k8 - p.l * t14) - sin_q_4 * t26;
    let t36 = p.l * t31 + (t3 * p.k9 + m41);
    let m42 = sin_q_5 * t33 + (p.k23 * t23 + sin_q_3 * p.k6 - p.k28 * t24);
    let t37 = t27 - t28 - t25 * (t16 + p.k7);
    let m53 = t4 * (p.l + t35) + sin_q_4 * p.k3;
    let t38 = p.k28 + sin_q_5 * p.k5;
    let t39 = cos_q_2 * (cos_q_3 * t36 + sin_q_3 * t32);
    let t40 = sin_q_2 * (m31 + (sin_q_2 * p.k11 + p.k27) - p.l * t30);
    let t41 = p.l * (t13 + t34) + p.k10 - cos_q_3 * (cos_q_4 * t37 + t18 * t33);
    let t42 = sin_q_4 * (m53 + (sin_q_4 * t16 + (sin_q_4 * p.k7 + p.k30)));
    let m11 = t40 + (t39 + (p.k12 - p.l * (t30 - sin_q_2 * p.k19)));
    let m21 = sin_q_3 * t36 - (cos_q_3 * t32 - p.l * (t31 + t3 * p.k21));
    let m22 = sin_q_3 * (p.l * t34 + (m42 + (sin_q_3 * p.k9 + p.k29))) + t41;
    let m32 = t7 * (p.l * t25) + t11 * t33 - sin_q_4 * t37;
    let m33 = t42 + (t7 * t35 + (p.k8 + t11 * (t11 * p.k5)));
    let m43 = t11 * t38;
    let m44 = p.k6 + sin_q_5 * (p.k28 + t38);
    let m51 = -t21;
    let m52 = t28 - t27;
    let zero = S::ZERO;
    [
        [m11, m21, m31, m41, m51],
        [m21, m22, m32, m42, m52],
        [m31, m32, m33, m43, m53],
        [m41, m42, m43, m44, zero],
        [m51, m52, m53, zero, p.k3],
    ]
}

/// Bias `h`: velocity products and explicit time in the inertia forces.
///
/// ```text
/// h[q[1]] = …
/// h[q[2]] = …
/// h[q[3]] = …
/// h[q[4]] = …
/// h[q[5]] = …
/// ```
pub fn bias<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 5], v: &[S; 5]) -> [S; 5] {
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
    let (sin_q_4, cos_q_4) = q_4.sin_cos();
    let (sin_q_5, cos_q_5) = q_5.sin_cos();
    let t0 = q_2_dot * sin_q_3;
    let t1 = q_2_dot * cos_q_3;
    let t2 = cos_q_2 * q_1_dot;
    let t3 = sin_q_2 * q_1_dot;
    let t4 = t0 + t2 * cos_q_3;
    let t5 = t2 * q_2_dot;
    let t6 = t1 - t2 * sin_q_3;
    let t7 = t3 + q_3_dot;
    let t8 = t2 * t3;
    let t9 = t4 + q_4_dot;
    let t10 = t5 * p.k16;
    let t11 = t3 * t1 - q_3_dot * t6;
    let t12 = t7 * t6;
    let t13 = q_1_dot * t2;
    let t14 = p.l * (q_2_dot * q_2_dot + t3 * t3 + q_1_dot * t3);
    let t15 = t0 * t3 - t4 * q_3_dot;
    let t16 = t7 * cos_q_4 - t6 * sin_q_4;
    let t17 = t4 * t4 + t7 * t7;
    let t18 = t11 - t12;
    let t19 = t8 + t13;
    let t20 = t7 * sin_q_4 + t6 * cos_q_4;
    let t21 = sin_q_5 * t9 + t16 * cos_q_5;
    let t22 = sin_q_3 * t14 + cos_q_3 * t10 + p.l * t17;
    let t23 = t4 * t6;
    let t24 = t20 * t20 + t9 * t9;
    let t25 = cos_q_5 * t9 - t16 * sin_q_5;
    let t26 = t20 + q_5_dot;
    let t27 = p.l * (t19 + t18);
    let t28 = t16 * q_4_dot + (t5 * sin_q_4 + cos_q_4 * t15);
    let t29 = t16 * t9;
    let t30 = t5 - t23;
    let t31 = sin_q_3 * t10 - cos_q_3 * t14;
    let t32 = t25 * t21;
    let t33 = t26 * t26 + t21 * t21;
    let t34 = t16 * t20;
    let t35 = t25 * t26;
    let t36 = t28 + t29;
    let t37 = t31 + p.l * t30;
    let t38 = t28 - t32;
    let t39 = sin_q_4 * t27 + cos_q_4 * t22;
    let t40 = t11 + t34;
    let t41 = cos_q_5 * (t5 * cos_q_4 - sin_q_4 * t15 - q_4_dot * t20) - sin_q_5 * t11;
    let t42 = t25 * q_5_dot + t41;
    let t43 = sin_q_5 * t38 + cos_q_5 * t33;
    let t44 = t21 * (t26 * p.k24);
    let t45 = t35 + t42;
    let t46 = t33 * (sin_q_5 * p.k25) + p.k23 * t24 - t38 * (cos_q_5 * p.k25);
    let t47 = t35 * p.k3 + t42 * p.k5 - p.k25 * (t39 + p.l * t40);
    let t48 = t43 * p.k25 + p.k23 * t36;
    let t49 = p.k23 * t40 - p.k25 * t45;
    let t50 = cos_q_5 * (sin_q_4 * t22 - cos_q_4 * t27 + p.l * t24);
    let t51 = cos_q_5 * t44 + (p.k23 * t39 + (t34 * p.k7 + t11 * p.k6)) - t45 * p.k28;
    let t52 = sin_q_5 * t47;
    let t53 = t17 * (p.k21 * cos_q_3) + t46 * (cos_q_3 * sin_q_4);
    let h_q_5 = t28 * p.k3 - t32 * p.k5 - p.k25 * (t50 - sin_q_5 * (t37 + p.l * t36));
    let t54 = cos_q_5 * t47 + (sin_q_5 * t44 - t20 * (t9 * p.k22));
    let t55 = cos_q_4 * t46 - sin_q_4 * t49;
    let t56 = sin_q_3 * (p.k21 * t30 + t48) + (t49 * (cos_q_3 * cos_q_4) + t53);
    let t57 = h_q_5 + (t43 * p.k28 + (p.k23 * t37 + (t29 * p.k6 + t28 * p.k7)));
    let t58 = cos_q_4 * t54 + (p.l * t48 + (p.k21 * t31 + (t5 * p.k8 - t23 * p.k9)));
    let h_q_3 = sin_q_4 * t57 + t58;
    let t59 = t51 - t52 + (t19 * p.k29 + (t11 * p.k9 - t12 * p.k8)) - p.l * t55;
    let t60 = t4 * (t7 * p.k20) + sin_q_4 * t54 - cos_q_4 * t57;
    let t61 = p.l * (t5 * p.k31 + t56) - t59 * (cos_q_2 * cos_q_3);
    let t62 = t56 * (p.l * sin_q_2) - t5 * (sin_q_2 * p.k18);
    let t63 = sin_q_3 * t59 + (t13 * p.k27 + t8 * p.k11 - p.l * (t55 - p.k21 * t18));
    let h_q_1 = t60 * (cos_q_2 * sin_q_3) + t62 + (sin_q_2 * (t5 * p.k17 + h_q_3) + t61);
    let h_q_2 = -(cos_q_3 * t60 + t63);
    let h_q_4 = t52 - t51;
    [h_q_1, h_q_2, h_q_3, h_q_4, h_q_5]
}

/// Applied generalized forces `Q`.
///
/// ```text
/// Q[q[2]] = 1/2*l*m*g*cos(q[2])*cos(q[4])*sin(q[5]) + 3/2*l*m*g*cos(q[2])*cos(q[4])
///     + 1/2*l*m*g*sin(q[2])*cos(q[3])*cos(q[5])
///     - 1/2*l*m*g*sin(q[2])*sin(q[3])*sin(q[4])*sin(q[5])
///     - 3/2*l*m*g*sin(q[2])*sin(q[3])*sin(q[4]) - 5/2*l*m*g*sin(q[2])*sin(q[3])
///     - 7/2*l*m*g*sin(q[2])
/// Q[q[3]] = 1/2*l*m*g*cos(q[2])*cos(q[3])*sin(q[4])*sin(q[5])
///     + 3/2*l*m*g*cos(q[2])*cos(q[3])*sin(q[4]) + 5/2*l*m*g*cos(q[2])*cos(q[3])
///     + 1/2*l*m*g*cos(q[2])*sin(q[3])*cos(q[5])
/// Q[q[4]] = 1/2*l*m*sin(q[5])*(g*cos(q[2])*sin(q[3])*cos(q[4]) - g*sin(q[2])*sin(q[4]))
///     + 3/2*l*m*(g*cos(q[2])*sin(q[3])*cos(q[4]) - g*sin(q[2])*sin(q[4]))
/// Q[q[5]] = -1/2*l*m*(cos(q[5])*(-g*cos(q[2])*sin(q[3])*sin(q[4]) - g*sin(q[2])*cos(q[4])) -
///     g*cos(q[2])*cos(q[3])*sin(q[5]))
/// ```
pub fn applied<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 5]) -> [S; 5] {
    let q_2 = q[1];
    let q_3 = q[2];
    let q_4 = q[3];
    let q_5 = q[4];
    let (sin_q_2, cos_q_2) = q_2.sin_cos();
    let (sin_q_3, cos_q_3) = q_3.sin_cos();
    let (sin_q_4, cos_q_4) = q_4.sin_cos();
    let (sin_q_5, cos_q_5) = q_5.sin_cos();
    let t0 = cos_q_2 * sin_q_3;
    let t1 = cos_q_2 * cos_q_3;
    let t2 = cos_q_4 * t0 - sin_q_2 * sin_q_4;
    let t3 = p.k15 * t2;
    let q_q_5 = p.k15 * (sin_q_5 * t1 + cos_q_5 * (sin_q_4 * t0 + sin_q_2 * cos_q_4));
    let t4 = t3 * cos_q_5;
    let q_q_4 = t3 * sin_q_5 + t2 * p.k32;
    let t5 = p.k32 * t1 + q_q_5;
    let t6 = sin_q_3 * (q_q_4 - sin_q_2 * p.k33) - sin_q_2 * p.k34;
    let zero = S::ZERO;
    let q_q_2 = cos_q_3 * (cos_q_4 * t5 - sin_q_4 * t4) + t6;
    let q_q_3 = sin_q_4 * t5 + (cos_q_4 * t4 + p.k33 * t1);
    [zero, q_q_2, q_q_3, q_q_4, q_q_5]
}

/// Right-hand side `f = Q - h` of `M a = f`.
pub fn forces<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 5], v: &[S; 5]) -> [S; 5] {
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
    let (sin_q_5, cos_q_5) = q_5.sin_cos();
    let t0 = q_1_dot * p.l;
    let t1 = sin_q_2 * q_1_dot;
    let t2 = cos_q_2 * q_1_dot;
    let t3 = cos_q_3 * q_2_dot;
    let t4 = sin_q_3 * q_2_dot;
    let t5 = t2 * q_2_dot;
    let t6 = t3 - t2 * sin_q_3;
    let t7 = t4 + t2 * cos_q_3;
    let t8 = t1 + q_3_dot;
    let t9 = p.l * (q_2_dot * q_2_dot + t1 * t1) + (t1 * t0 + cos_q_2 * p.g);
    let t10 = sin_q_2 * p.g - t2 * t0;
    let t11 = t5 * p.k16;
    let t12 = t1 * t4 - q_3_dot * t7;
    let t13 = t2 * t1;
    let t14 = t3 * t1 - t6 * q_3_dot;
    let t15 = t6 * t8;
    let t16 = t6 * t7;
    let t17 = q_4_dot + t7;
    let t18 = cos_q_4 * t8 - t6 * sin_q_4;
    let t19 = t10 - p.l * t13;
    let t20 = t14 - t15;
    let t21 = cos_q_3 * t9 - sin_q_3 * t11;
    let t22 = t5 - t16;
    let t23 = t18 * q_4_dot + (sin_q_4 * t5 + cos_q_4 * t12);
    let t24 = t18 * t17;
    let t25 = t7 * t7 + t8 * t8;
    let t26 = t19 - p.l * t20;
    let t27 = sin_q_4 * t8 + t6 * cos_q_4;
    let t28 = t21 - p.l * t22;
    let t29 = t23 + t24;
    let t30 = p.l * t25 + (cos_q_3 * t11 + sin_q_3 * t9);
    let t31 = cos_q_5 * t17 - t18 * sin_q_5;
    let t32 = sin_q_5 * t17 + t18 * cos_q_5;
    let t33 = t27 + q_5_dot;
    let t34 = t18 * t27;
    let t35 = t27 * t27 + t17 * t17;
    let t36 = cos_q_4 * t30 - sin_q_4 * t26;
    let t37 = t31 * t33;
    let t38 = t31 * t32;
    let t39 = t33 * t33 + t32 * t32;
    let t40 = t14 + t34;
    let t41 = cos_q_5 * (cos_q_4 * t5 - sin_q_4 * t12 - q_4_dot * t27) - sin_q_5 * t14;
    let t42 = t31 * q_5_dot + t41;
    let t43 = t32 * (t33 * p.k24);
    let t44 = cos_q_5 * (p.l * t35 + (sin_q_4 * t30 + cos_q_4 * t26));
    let t45 = t23 - t38;
    let t46 = t37 + t42;
    let t47 = p.k25 * (sin_q_5 * (t28 - t29 * p.l) + t44);
    let t48 = t23 * p.k3 - t38 * p.k5;
    let t49 = sin_q_5 * t45 + cos_q_5 * t39;
    let t50 = p.k3 * t37 + p.k5 * t42 - p.k25 * (p.l * t40 + t36);
    let t51 = t39 * (sin_q_5 * p.k25) + t35 * p.k23 - t45 * (cos_q_5 * p.k25);
    let t52 = p.k23 * t40 - p.k25 * t46;
    let t53 = t49 * p.k25 + t29 * p.k23;
    let t54 = cos_q_5 * t43 + (p.k23 * t36 + (p.k7 * t34 + t14 * p.k6)) - p.k28 * t46;
    let f_q_4 = t54 - sin_q_5 * t50;
    let t55 = t48 - t47 + (t49 * p.k28 + (t24 * p.k6 + t23 * p.k7 - t28 * p.k23));
    let t56 = t27 * (t17 * p.k22) - sin_q_5 * t43 - cos_q_5 * t50;
    let t57 = cos_q_4 * t51 - sin_q_4 * t52;
    let t58 = t25 * (cos_q_3 * p.k21) + t51 * (cos_q_3 * sin_q_4);
    let t59 = sin_q_4 * t55 + (p.l * t53 + (t5 * p.k8 - t16 * p.k9 - t21 * p.k21));
    let t60 = cos_q_4 * t56;
    let t61 = f_q_4 + (t14 * p.k9 - t15 * p.k8 - t19 * p.k21) - p.l * t57;
    let t62 = sin_q_3 * (t53 + t22 * p.k21) + (t52 * (cos_q_3 * cos_q_4) + t58);
    let t63 = t7 * (t8 * p.k20) - sin_q_4 * t56 - cos_q_4 * t55;
    let t64 = t62 * (sin_q_2 * p.l) - t5 * (sin_q_2 * p.k18);
    let t65 = p.l * (t5 * p.k31 + t62) - t61 * (cos_q_2 * cos_q_3);
    let t66 = sin_q_2 * (t59 - t60 + t5 * p.k17) + t65;
    let t67 = p.l * (t57 - t20 * p.k21) + (t10 * p.k19 - t13 * p.k11) - sin_q_3 * t61;
    let f_q_1 = -(t63 * (cos_q_2 * sin_q_3) + t64 + t66);
    let f_q_2 = cos_q_3 * t63 - t67;
    let f_q_3 = t60 - t59;
    let f_q_5 = t47 - t48;
    [f_q_1, f_q_2, f_q_3, f_q_4, f_q_5]
}

/// Residuals `g` of the constraints of positions; 0 for those of velocities alone.
///
/// ```text
/// g[along] = l*cos(q[1])*sin(q[2])*sin(q[3]) + l*cos(q[1])*sin(q[2]) + l*cos(q[1])
///     + l*sin(q[1])*cos(q[3]) - l*(cos(q[1])*cos(q[2])*cos(q[4]) -
///     sin(q[4])*(cos(q[1])*sin(q[2])*sin(q[3]) + sin(q[1])*cos(q[3]))) +
///     l*(cos(q[5])*(sin(q[1])*sin(q[3]) - cos(q[1])*sin(q[2])*cos(q[3])) -
///     sin(q[5])*(cos(q[1])*cos(q[2])*cos(q[4]) - sin(q[4])*(cos(q[1])*sin(q[2])*sin(q[3]) +
///     sin(q[1])*cos(q[3]))))
/// g[up] = l*(cos(q[2])*cos(q[3])*cos(q[5]) - sin(q[5])*(cos(q[2])*sin(q[3])*sin(q[4]) +
///     sin(q[2])*cos(q[4]))) - l*cos(q[2])*sin(q[3])*sin(q[4]) - l*cos(q[2])*sin(q[3])
///     - l*cos(q[2]) - l*sin(q[2])*cos(q[4])
/// g[across] = l*cos(q[1])*cos(q[3]) - l*sin(q[1])*sin(q[2])*sin(q[3]) - l*sin(q[1])*sin(q[2])
///     - l*sin(q[1]) - l*(-sin(q[1])*cos(q[2])*cos(q[4]) - sin(q[4])*(cos(q[1])*cos(q[3]) -
///     sin(q[1])*sin(q[2])*sin(q[3]))) + l*(cos(q[5])*(cos(q[1])*sin(q[3]) +
///     sin(q[1])*sin(q[2])*cos(q[3])) - sin(q[5])*(-sin(q[1])*cos(q[2])*cos(q[4]) -
///     sin(q[4])*(cos(q[1])*cos(q[3]) - sin(q[1])*sin(q[2])*sin(q[3])))) - l
/// g[tips] = cos(q[2])*cos(q[3])*sin(q[5]) + cos(q[2])*sin(q[3])*sin(q[4])*cos(q[5])
///     + sin(q[2])*cos(q[4])*cos(q[5])
/// g[turns] = sin(q[5])*(cos(q[1])*sin(q[3]) + sin(q[1])*sin(q[2])*cos(q[3])) +
///     cos(q[5])*(-sin(q[1])*cos(q[2])*cos(q[4]) - sin(q[4])*(cos(q[1])*cos(q[3]) -
///     sin(q[1])*sin(q[2])*sin(q[3])))
/// ```
pub fn constraint_positions<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 5],
) -> [S; 5] {
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
    let t0 = sin_q_2 * sin_q_1;
    let t1 = sin_q_2 * cos_q_1;
    let t2 = cos_q_4 * cos_q_2;
    let t3 = cos_q_2 * sin_q_3;
    let t4 = cos_q_1 * cos_q_3 - sin_q_3 * t0;
    let t5 = cos_q_1 * sin_q_3 + cos_q_3 * t0;
    let t6 = t1 * sin_q_3 + sin_q_1 * cos_q_3;
    let t7 = cos_q_2 * cos_q_3;
    let t8 = sin_q_4 * t4 + sin_q_1 * t2;
    let t9 = cos_q_1 * t2 - sin_q_4 * t6;
    let t10 = sin_q_4 * t3 + cos_q_4 * sin_q_2;
    let t11 = sin_q_5 * t9 + cos_q_5 * (t1 * cos_q_3 - sin_q_1 * sin_q_3);
    let g1 = p.l * (t6 + (cos_q_1 + t1) - t9 - t11);
    let g2 = p.k35 * (t10 + (cos_q_2 + t3) - (cos_q_5 * t7 - sin_q_5 * t10));
    let g3 = -(p.l + p.l * (sin_q_1 + t0 - t4 - t8 - (sin_q_5 * t8 + cos_q_5 * t5)));
    let g4 = sin_q_5 * t7 + cos_q_5 * t10;
    let g5 = sin_q_5 * t5 - cos_q_5 * t8;
    [g1, g2, g3, g4, g5]
}

/// Residuals `phi = G v + dg/dt` of the constraints at the level of velocities.
///
/// ```text
/// phi[along] = …
/// phi[up] = l*sin(q[2])*sin(q[3])*der(q[2]) + l*sin(q[2])*der(q[2])
///     - l*cos(q[2])*cos(q[3])*der(q[3]) - l*((cos(q[2])*cos(q[4])*der(q[2]) -
///     sin(q[2])*sin(q[4])*der(q[4])) + (cos(q[2])*cos(q[3])*sin(q[4])*der(q[3]) -
///     sin(q[2])*sin(q[3])*sin(q[4])*der(q[2]) + cos(q[2])*sin(q[3])*cos(q[4])*der(q[4]))) +
///     l*((-sin(q[2])*cos(q[3])*cos(q[5])*der(q[2]) - cos(q[2])*sin(q[3])*cos(q[5])*der(q[3]) -
///     cos(q[2])*cos(q[3])*sin(q[5])*der(q[5])) - (cos(q[5])*(cos(q[2])*sin(q[3])*sin(q[4]) +
///     sin(q[2])*cos(q[4]))*der(q[5]) + sin(q[5])*((cos(q[2])*cos(q[4])*der(q[2]) -
///     sin(q[2])*sin(q[4])*der(q[4])) + (cos(q[2])*cos(q[3])*sin(q[4])*der(q[3]) -
///     sin(q[2])*sin(q[3])*sin(q[4])*der(q[2]) + cos(q[2])*sin(q[3])*cos(q[4])*der(q[4])))))
/// phi[across] = …
/// phi[tips] = cos(q[2])*cos(q[3])*cos(q[5])*der(q[5]) - sin(q[2])*cos(q[3])*sin(q[5])*der(q[2])
///     - cos(q[2])*sin(q[3])*sin(q[5])*der(q[3])
///     - sin(q[5])*(cos(q[2])*sin(q[3])*sin(q[4]) + sin(q[2])*cos(q[4]))*der(q[5]) +
///     cos(q[5])*((cos(q[2])*cos(q[4])*der(q[2]) - sin(q[2])*sin(q[4])*der(q[4])) +
///     (cos(q[2])*cos(q[3])*sin(q[4])*der(q[3]) - sin(q[2])*sin(q[3])*sin(q[4])*der(q[2]) +
///     cos(q[2])*sin(q[3])*cos(q[4])*der(q[4])))
/// phi[turns] = …
/// ```
pub fn constraint_rates<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 5],
    v: &[S; 5],
) -> [S; 5] {
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
    let (sin_q_1, cos_q_1) = q_1.sin_cos();
    let (sin_q_4, cos_q_4) = q_4.sin_cos();
    let (sin_q_5, cos_q_5) = q_5.sin_cos();
    let t0 = cos_q_2 * q_2_dot;
    let t1 = sin_q_3 * q_3_dot;
    let t2 = sin_q_3 * sin_q_2;
    let t3 = cos_q_3 * sin_q_2;
    let t4 = sin_q_1 * q_1_dot;
    let t5 = cos_q_1 * q_1_dot;
    let t6 = cos_q_4 * sin_q_2;
    let t7 = cos_q_3 * q_3_dot;
    let t8 = t2 * cos_q_1 + cos_q_3 * sin_q_1;
    let t9 = t3 * q_3_dot + sin_q_3 * t0;
    let t10 = cos_q_4 * q_4_dot;
    let t11 = sin_q_4 * cos_q_2;
    let t12 = cos_q_4 * cos_q_2;
    let t13 = t2 * q_3_dot;
    let t14 = cos_q_3 * t0;
    let t15 = t2 * q_2_dot;
    let t16 = cos_q_3 * cos_q_1 - t2 * sin_q_1;
    let t17 = cos_q_3 * t5 - sin_q_1 * t1 - (t2 * t4 - cos_q_1 * t9);
    let t18 = q_4_dot * t11 + q_2_dot * t6;
    let t19 = sin_q_1 * t9 + t2 * t5 + (cos_q_1 * t1 + cos_q_3 * t4);
    let t20 = cos_q_5 * q_5_dot;
    let t21 = sin_q_5 * q_5_dot;
    let t22 = t6 + sin_q_3 * t11;
    let t23 = t3 * q_2_dot;
    let t24 = sin_q_4 * t16 + sin_q_1 * t12;
    let t25 = sin_q_3 * cos_q_1 + sin_q_1 * t3;
    let t26 = t8 * t10 + sin_q_4 * t17 + (cos_q_1 * t18 + t12 * t4);
    let t27 = sin_q_4 * t15 - cos_q_2 * (sin_q_3 * t10 + sin_q_4 * t7);
    let t28 = cos_q_4 * t0 - sin_q_4 * (sin_q_2 * q_4_dot) - t27;
    let t29 = t12 * t5 - sin_q_1 * t18 - (sin_q_4 * t19 - t10 * t16);
    let t30 = sin_q_1 * (t14 - t13) + t3 * t5 - (sin_q_3 * t4 - cos_q_1 * t7);
    let t31 = sin_q_1 * t7 + sin_q_3 * t5 + (cos_q_1 * (t13 - t14) + t3 * t4);
    let t32 = t21 * (cos_q_1 * t3 - sin_q_3 * sin_q_1) + cos_q_5 * t31;
    let t33 = cos_q_2 * (cos_q_3 * t21 + cos_q_5 * t1) + cos_q_5 * t23;
    let t34 = sin_q_5 * t26 - t20 * (cos_q_1 * t12 - sin_q_4 * t8) + t32;
    let t35 = t15 - cos_q_2 * t7 + sin_q_2 * q_2_dot - t28;
    let t36 = t20 * t24 + sin_q_5 * t29 + (cos_q_5 * t30 - t21 * t25);
    let t37 = cos_q_2 * (sin_q_5 * t1 - t20 * cos_q_3) + sin_q_5 * t23;
    let phi1 = p.k35 * (t4 + (sin_q_2 * t4 - cos_q_1 * t0) - t17 - t26 - t34);
    let phi2 = (t35 - (t20 * t22 + sin_q_5 * t28 + t33)) * p.l;
    let phi3 = p.k35 * (t19 + (t5 + (sin_q_1 * t0 + sin_q_2 * t5)) - t29 - t36);
    let phi4 = cos_q_5 * t28 - t21 * t22 - t37;
    let phi5 = t20 * t25 + sin_q_5 * t30 - (cos_q_5 * t29 - t21 * t24);
    [phi1, phi2, phi3, phi4, phi5]
}

/// Constraint matrix `G`, the derivatives of `phi` by the rates.
///
/// ```text
/// G[along, q[1]] = cos(q[1])*(cos(q[3])*(l - sin(q[4])*(-l*sin(q[5]) - l)) +
///     l*sin(q[3])*cos(q[5])) - sin(q[1])*(cos(q[2])*cos(q[4])*(-l*sin(q[5]) - l) -
///     l*sin(q[2])*cos(q[3])*cos(q[5]) + sin(q[2])*sin(q[3])*(l - sin(q[4])*(-l*sin(q[5]) - l)) +
///     l*sin(q[2]) + l)
/// G[along, q[2]] = cos(q[2])*(cos(q[1])*sin(q[3])*(l - sin(q[4])*(-l*sin(q[5]) - l)) -
///     l*cos(q[1])*cos(q[3])*cos(q[5]) + l*cos(q[1]))
///     - cos(q[1])*sin(q[2])*cos(q[4])*(-l*sin(q[5]) - l)
/// G[along, q[3]] = cos(q[3])*(cos(q[1])*sin(q[2])*(l - sin(q[4])*(-l*sin(q[5]) - l)) +
///     l*sin(q[1])*cos(q[5]))
///     - sin(q[3])*(sin(q[1])*(l - sin(q[4])*(-l*sin(q[5]) - l)) - l*cos(q[1])*sin(q[2])*cos(q[5]))
/// G[along, q[4]] = -cos(q[1])*cos(q[2])*sin(q[4])*(-l*sin(q[5]) - l)
///     - cos(q[4])*(cos(q[1])*sin(q[2])*sin(q[3]) + sin(q[1])*cos(q[3]))*(-l*sin(q[5]) - l)
/// G[along, q[5]] = -l*sin(q[5])*(sin(q[1])*sin(q[3]) - cos(q[1])*sin(q[2])*cos(q[3])) -
///     l*cos(q[5])*(cos(q[1])*cos(q[2])*cos(q[4]) - sin(q[4])*(cos(q[1])*sin(q[2])*sin(q[3]) +
///     sin(q[1])*cos(q[3])))
/// G[up, q[2]] = cos(q[2])*cos(q[4])*(-l*sin(q[5]) - l) - sin(q[2])*(l*cos(q[3])*cos(q[5]) +
///     sin(q[3])*sin(q[4])*(-l*sin(q[5]) - l) - l*sin(q[3]) - l)
/// G[up, q[3]] = cos(q[3])*(cos(q[2])*sin(q[4])*(-l*sin(q[5]) - l) - l*cos(q[2]))
///     - l*cos(q[2])*sin(q[3])*cos(q[5])
/// G[up, q[4]] = cos(q[2])*sin(q[3])*cos(q[4])*(-l*sin(q[5]) - l)
///     - sin(q[2])*sin(q[4])*(-l*sin(q[5]) - l)
/// G[up, q[5]] = -l*cos(q[2])*cos(q[3])*sin(q[5])
///     - l*cos(q[5])*(cos(q[2])*sin(q[3])*sin(q[4]) + sin(q[2])*cos(q[4]))
/// G[across, q[1]] = cos(q[1])*(l*sin(q[2])*cos(q[3])*cos(q[5]) - cos(q[2])*cos(q[4])*(-l*sin(q[5])
///     - l) - sin(q[2])*sin(q[3])*(l - sin(q[4])*(-l*sin(q[5]) - l)) - l*sin(q[2]) - l)
///     - sin(q[1])*(cos(q[3])*(l - sin(q[4])*(-l*sin(q[5]) - l)) + l*sin(q[3])*cos(q[5]))
/// G[across, q[2]] = sin(q[1])*sin(q[2])*cos(q[4])*(-l*sin(q[5]) - l) +
///     cos(q[2])*(l*sin(q[1])*cos(q[3])*cos(q[5]) - sin(q[1])*sin(q[3])*(l -
///     sin(q[4])*(-l*sin(q[5]) - l)) - l*sin(q[1]))
/// G[across, q[3]] = cos(q[3])*(l*cos(q[1])*cos(q[5]) - sin(q[1])*sin(q[2])*(l -
///     sin(q[4])*(-l*sin(q[5]) - l)))
///     - sin(q[3])*(cos(q[1])*(l - sin(q[4])*(-l*sin(q[5]) - l)) + l*sin(q[1])*sin(q[2])*cos(q[5]))
/// G[across, q[4]] = sin(q[1])*cos(q[2])*sin(q[4])*(-l*sin(q[5]) - l)
///     - cos(q[4])*(cos(q[1])*cos(q[3]) - sin(q[1])*sin(q[2])*sin(q[3]))*(-l*sin(q[5]) - l)
/// G[across, q[5]] = -l*sin(q[5])*(cos(q[1])*sin(q[3]) + sin(q[1])*sin(q[2])*cos(q[3])) -
///     l*cos(q[5])*(-sin(q[1])*cos(q[2])*cos(q[4]) - sin(q[4])*(cos(q[1])*cos(q[3]) -
///     sin(q[1])*sin(q[2])*sin(q[3])))
/// G[tips, q[2]] = cos(q[2])*cos(q[4])*cos(q[5]) - sin(q[2])*cos(q[3])*sin(q[5])
///     - sin(q[2])*sin(q[3])*sin(q[4])*cos(q[5])
/// G[tips, q[3]] = cos(q[2])*cos(q[3])*sin(q[4])*cos(q[5]) - cos(q[2])*sin(q[3])*sin(q[5])
/// G[tips, q[4]] = cos(q[2])*sin(q[3])*cos(q[4])*cos(q[5]) - sin(q[2])*sin(q[4])*cos(q[5])
/// G[tips, q[5]] = cos(q[2])*cos(q[3])*cos(q[5]) - cos(q[2])*sin(q[3])*sin(q[4])*sin(q[5])
///     - sin(q[2])*cos(q[4])*sin(q[5])
/// G[turns, q[1]] = cos(q[1])*(sin(q[2])*cos(q[3])*sin(q[5]) - cos(q[2])*cos(q[4])*cos(q[5]) +
///     sin(q[2])*sin(q[3])*sin(q[4])*cos(q[5])) + sin(q[1])*cos(q[3])*sin(q[4])*cos(q[5])
///     - sin(q[1])*sin(q[3])*sin(q[5])
/// G[turns, q[2]] = sin(q[1])*cos(q[2])*cos(q[3])*sin(q[5])
///     + sin(q[1])*cos(q[2])*sin(q[3])*sin(q[4])*cos(q[5])
///     + sin(q[1])*sin(q[2])*cos(q[4])*cos(q[5])
/// G[turns, q[3]] = cos(q[1])*cos(q[3])*sin(q[5]) + cos(q[1])*sin(q[3])*sin(q[4])*cos(q[5])
///     + sin(q[1])*sin(q[2])*cos(q[3])*sin(q[4])*cos(q[5])
///     - sin(q[1])*sin(q[2])*sin(q[3])*sin(q[5])
/// G[turns, q[4]] = sin(q[1])*cos(q[2])*sin(q[4])*cos(q[5])
///     - cos(q[4])*cos(q[5])*(cos(q[1])*cos(q[3]) - sin(q[1])*sin(q[2])*sin(q[3]))
/// G[turns, q[5]] = cos(q[5])*(cos(q[1])*sin(q[3]) + sin(q[1])*sin(q[2])*cos(q[3])) -
///     sin(q[5])*(-sin(q[1])*cos(q[2])*cos(q[4]) - sin(q[4])*(cos(q[1])*cos(q[3]) -
///     sin(q[1])*sin(q[2])*sin(q[3])))
/// ```
pub fn constraint_matrix<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 5]) -> [S; 25] {
    let q_1 = q[0];
    let q_2 = q[1];
    let q_3 = q[2];
    let q_4 = q[3];
    let q_5 = q[4];
    let (sin_q_5, cos_q_5) = q_5.sin_cos();
    let (sin_q_4, cos_q_4) = q_4.sin_cos();
    let (sin_q_3, cos_q_3) = q_3.sin_cos();
    let (sin_q_2, cos_q_2) = q_2.sin_cos();
    let (sin_q_1, cos_q_1) = q_1.sin_cos();
    let t0 = p.l + p.l * sin_q_5;
    let t1 = p.l * cos_q_5;
    let t2 = sin_q_4 * cos_q_5;
    let t3 = cos_q_4 * cos_q_2;
    let t4 = sin_q_4 * cos_q_2;
    let t5 = cos_q_2 * cos_q_3;
    let t6 = p.l + sin_q_4 * t0;
    let t7 = t1 * sin_q_3;
    let t8 = sin_q_2 * cos_q_1;
    let t9 = t3 * t0;
    let t10 = sin_q_2 * sin_q_1;
    let t11 = sin_q_3 * t6 + (p.l - t1 * cos_q_3);
    let t12 = t7 + cos_q_3 * t6;
    let t13 = cos_q_4 * t0;
    let t14 = sin_q_2 * t11;
    let t15 = sin_q_3 * t8 + cos_q_3 * sin_q_1;
    let t16 = sin_q_5 * cos_q_3;
    let t17 = cos_q_3 * cos_q_1 - sin_q_3 * t10;
    let t18 = sin_q_3 * cos_q_1 + cos_q_3 * t10;
    let t19 = t14 + (p.l - t9);
    let t20 = t3 * sin_q_3 - sin_q_4 * sin_q_2;
    let t21 = sin_q_3 * t4 + cos_q_4 * sin_q_2;
    let t22 = cos_q_2 * sin_q_1;
    let t23 = cos_q_4 * t17 - sin_q_1 * t4;
    let t24 = sin_q_4 * t17 + t3 * sin_q_1;
    let t25 = t16 + sin_q_3 * t2;
    let t26 = cos_q_3 * t2 - sin_q_5 * sin_q_3;
    let t27 = sin_q_5 * (cos_q_3 * t8 - sin_q_3 * sin_q_1);
    let t28 = cos_q_3 * (t6 * t10 - t1 * cos_q_1);
    let g4_2 = t3 * cos_q_5 - sin_q_2 * t25;
    let t29 = cos_q_3 * (sin_q_5 * cos_q_1 + t10 * t2);
    let g1_1 = cos_q_1 * t12 - t19 * sin_q_1;
    let g1_2 = t13 * t8 + t11 * (cos_q_2 * cos_q_1);
    let g1_3 = cos_q_3 * (t1 * sin_q_1 + t6 * t8) - sin_q_3 * (t6 * sin_q_1 - t1 * t8);
    let g1_4 = t0 * (cos_q_1 * t4 + cos_q_4 * t15);
    let g1_5 = p.k35 * (cos_q_5 * (t3 * cos_q_1 - sin_q_4 * t15) - t27);
    let zero = S::ZERO;
    let g2_2 = t14 - t9;
    let g2_3 = -(cos_q_2 * t7 + t6 * t5);
    let g2_4 = -(t0 * t20);
    let g2_5 = p.k35 * (cos_q_2 * t16 + cos_q_5 * t21);
    let g3_1 = -(sin_q_1 * t12 + t19 * cos_q_1);
    let g3_2 = -(t13 * t10 + t11 * t22);
    let g3_3 = -(sin_q_3 * (t1 * t10 + t6 * cos_q_1) + t28);
    let g3_4 = t0 * t23;
    let g3_5 = p.l * (cos_q_5 * t24 - sin_q_5 * t18);
    let g4_3 = cos_q_2 * t26;
    let g4_4 = cos_q_5 * t20;
    let g4_5 = cos_q_5 * t5 - sin_q_5 * t21;
    let g5_1 = sin_q_1 * t26 - cos_q_1 * g4_2;
    let g5_2 = t10 * (cos_q_4 * cos_q_5) + t22 * t25;
    let g5_3 = sin_q_3 * (cos_q_1 * t2 - sin_q_5 * t10) + t29;
    let g5_4 = -(cos_q_5 * t23);
    let g5_5 = sin_q_5 * t24 + cos_q_5 * t18;
    [
        g1_1, g1_2, g1_3, g1_4, g1_5, zero, g2_2, g2_3, g2_4, g2_5, g3_1, g3_2, g3_3, g3_4, g3_5,
        zero, g4_2, g4_3, g4_4, g4_5, g5_1, g5_2, g5_3, g5_4, g5_5,
    ]
}

/// Right-hand side `gamma` of `G a = gamma`.
///
/// ```text
/// gamma[along] = …
/// gamma[up] = …
/// gamma[across] = …
/// gamma[tips] = …
/// gamma[turns] = …
/// ```
pub fn constraint_bias<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 5],
    v: &[S; 5],
) -> [S; 5] {
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
    let t0 = cos_q_2 * q_2_dot;
    let (sin_q_1, cos_q_1) = q_1.sin_cos();
    let t1 = sin_q_1 * q_1_dot;
    let t2 = t0 * t1;
    let (sin_q_3, cos_q_3) = q_3.sin_cos();
    let t3 = sin_q_3 * t2;
    let t4 = cos_q_3 * q_3_dot;
    let t5 = cos_q_1 * t0;
    let t6 = t4 * t5;
    let t7 = sin_q_2 * q_2_dot;
    let t8 = q_2_dot * t7;
    let t9 = cos_q_1 * t8;
    let t10 = sin_q_2 * sin_q_3;
    let t11 = cos_q_1 * q_1_dot;
    let t12 = q_1_dot * t11;
    let t13 = sin_q_2 * t1;
    let t14 = t4 * t13;
    let t15 = sin_q_2 * cos_q_1;
    let t16 = sin_q_3 * q_3_dot;
    let t17 = q_3_dot * t16;
    let t18 = sin_q_3 * t9 + (t3 - t6) + (t14 + (t3 + t10 * t12));
    let t19 = t16 * t11;
    let t20 = q_3_dot * t4;
    let t21 = q_1_dot * t1;
    let t22 = t19 + sin_q_1 * t20 + (t19 + cos_q_3 * t21);
    let t23 = t14 + t15 * t17 - t6 + t18 + t22;
    let (sin_q_4, cos_q_4) = q_4.sin_cos();
    let t24 = cos_q_3 * t11 - sin_q_1 * t16 - (t10 * t1 - t15 * t4 - sin_q_3 * t5);
    let t25 = cos_q_4 * q_4_dot;
    let t26 = t25 * t24;
    let t27 = t15 * sin_q_3 + sin_q_1 * cos_q_3;
    let t28 = sin_q_4 * q_4_dot;
    let t29 = q_4_dot * t28;
    let t30 = cos_q_4 * cos_q_2;
    let t31 = cos_q_4 * t7;
    let t32 = t1 * t31;
    let t33 = cos_q_2 * t28;
    let t34 = t1 * t33;
    let t35 = t28 * t7;
    let t36 = cos_q_1 * t35;
    let t37 = q_2_dot * t0;
    let t38 = cos_q_4 * t37;
    let t39 = q_4_dot * t30;
    let t40 = q_4_dot * t39;
    let t41 = t30 * t12 - t32 - t34 - (t36 + t32 - cos_q_1 * t38);
    let t42 = t26 - t27 * t29 + (t26 - sin_q_4 * t23);
    let t43 = t42 + (t41 - (t36 + t34 - cos_q_1 * t40));
    let (sin_q_5, cos_q_5) = q_5.sin_cos();
    let t44 = cos_q_5 * q_5_dot;
    let t45 = t25 * t27 + sin_q_4 * t24 + (cos_q_1 * t33 + (cos_q_1 * t31 + t1 * t30));
    let t46 = t44 * t45;
    let t47 = sin_q_5 * q_5_dot;
    let t48 = q_5_dot * t47;
    let t49 = t5 * t16;
    let t50 = cos_q_3 * t2;
    let t51 = sin_q_2 * cos_q_3;
    let t52 = t16 * t13;
    let t53 = cos_q_3 * t9 + (t49 + t50) + (t50 + t12 * t51 - t52);
    let t54 = t4 * t11;
    let t55 = sin_q_3 * t21 - t54 - (t54 - sin_q_1 * t17);
    let t56 = sin_q_1 * t4 + sin_q_3 * t11 + (t15 * t16 + t1 * t51 - cos_q_3 * t5);
    let t57 = t47 * t56;
    let t58 = q_5_dot * t44;
    let t59 = t57 - cos_q_5 * (t53 - (t52 - t49 - t15 * t20) - t55);
    let t60 = t46 + t48 * (cos_q_1 * t30 - sin_q_4 * t27) + (t46 + sin_q_5 * t43);
    let t61 = t57 - t58 * (t15 * cos_q_3 - sin_q_1 * sin_q_3) + t59 - t60;
    let t62 = t4 * t7;
    let t63 = sin_q_4 * t62;
    let t64 = sin_q_4 * cos_q_2;
    let t65 = t4 * t39;
    let t66 = sin_q_4 * sin_q_3;
    let t67 = t25 * (sin_q_3 * t7);
    let t68 = t63 + t17 * t64 - t65 + (t67 + (t63 + t37 * t66));
    let t69 = t0 * t28;
    let t70 = t69 + t25 * (q_4_dot * sin_q_2) + (t69 + cos_q_4 * t8);
    let t71 = t67 + t33 * (q_4_dot * sin_q_3) - t65 + t68 + t70;
    let t72 = cos_q_4 * t0 - sin_q_2 * t28 - (t7 * t66 - t4 * t64 - sin_q_3 * t39);
    let t73 = t44 * t72;
    let t74 = sin_q_3 * t64 + cos_q_4 * sin_q_2;
    let t75 = cos_q_3 * t7;
    let t76 = t47 * t75;
    let t77 = t16 * t7;
    let t78 = cos_q_5 * t77;
    let t79 = cos_q_3 * t37;
    let t80 = cos_q_2 * t16;
    let t81 = t47 * t80;
    let t82 = cos_q_2 * t20;
    let t83 = cos_q_2 * cos_q_3;
    let t84 = cos_q_5 * t79 - (t76 + t78) - (t81 + t78 - cos_q_5 * t82);
    let t85 = t73 - t48 * t74 + (t73 - sin_q_5 * t71);
    let t86 = t71 + (t37 + (t62 + cos_q_2 * t17 + (t62 + sin_q_3 * t37)));
    let t87 = t0 * t11;
    let t88 = sin_q_3 * t87;
    let t89 = sin_q_2 * t11;
    let t90 = t4 * t89;
    let t91 = sin_q_1 * t0;
    let t92 = t4 * t91;
    let t93 = sin_q_1 * t8;
    let t94 = sin_q_2 * sin_q_1;
    let t95 = t10 * t21 - t88 - t90 - (t92 + t88 - sin_q_3 * t93);
    let t96 = t1 * t16;
    let t97 = cos_q_3 * t12 - t96 - (t96 - cos_q_1 * t20);
    let t98 = t97 - (t95 - (t92 + t90 - t17 * t94));
    let t99 = sin_q_3 * t91 + (t4 * t94 + t10 * t11) + (cos_q_1 * t16 + cos_q_3 * t1);
    let t100 = t25 * t99;
    let t101 = cos_q_1 * cos_q_3 - sin_q_3 * t94;
    let t102 = t11 * t31;
    let t103 = sin_q_1 * t35;
    let t104 = t11 * t33;
    let t105 = sin_q_1 * t38 + (t102 - t103) + (t104 + (t102 + t30 * t21));
    let t106 = t100 + t29 * t101 + (t100 + sin_q_4 * t98);
    let t107 = t106 + (sin_q_1 * t40 + (t104 - t103) + t105);
    let t108 = t11 * t30 - sin_q_1 * t31 - sin_q_1 * t33 - (sin_q_4 * t99 - t25 * t101);
    let t109 = t44 * t108;
    let t110 = sin_q_4 * t101 + sin_q_1 * t30;
    let t111 = t16 * t91;
    let t112 = t16 * t89;
    let t113 = cos_q_3 * t87;
    let t114 = t20 * t94 + (t111 + t112) + (t112 + t21 * t51 - t113);
    let t115 = t4 * t1;
    let t116 = t115 + cos_q_1 * t17 + (t115 + sin_q_3 * t12);
    let t117 = t116 + (t114 - (t113 - t111 - cos_q_3 * t93));
    let t118 = cos_q_3 * t91 + (t11 * t51 - t16 * t94) - (sin_q_3 * t1 - cos_q_1 * t4);
    let t119 = t47 * t118;
    let t120 = cos_q_1 * sin_q_3 + cos_q_3 * t94;
    let t121 = t109 - t48 * t110 + (t109 - sin_q_5 * t107);
    let t122 = t21 + (sin_q_2 * t21 - t87 - (t87 - t93)) - t98 - t107;
    let t123 = t44 * t80;
    let t124 = t44 * t75;
    let t125 = sin_q_5 * t77;
    let t126 = t48 * t83 + (t123 + t124) + (sin_q_5 * t79 + (t124 - t125));
    let t127 = t47 * t72;
    let t128 = t127 + t58 * t74 + (t127 + cos_q_5 * t71);
    let t129 = t47 * t108;
    let t130 = t44 * t118;
    let t131 = t129 + t58 * t110 + (t129 + cos_q_5 * t107);
    let gamma1 = (t61 + (t23 + (t12 + (t2 + t9 + (t2 + sin_q_2 * t12))) - t43)) * p.l;
    let gamma2 = p.k35 * (t86 - (t85 + (t84 - (t81 + t76 - t58 * t83))));
    let gamma3 = p.k35 * (t122 - (t119 + t58 * t120 + (t119 + cos_q_5 * t117) - t121));
    let gamma4 = t126 - (t125 - t123 - sin_q_5 * t82) + t128;
    let gamma5 = -(t130 - t48 * t120 + (t130 - sin_q_5 * t117) + t131);
    [gamma1, gamma2, gamma3, gamma4, gamma5]
}

/// Accelerations `a`, the solution of `M a = f + G^T lambda`, `G a = gamma` from the mass matrix,
/// factored.
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
        let angles = [q_2, q_4, q_3, q_5, q_1];
        let circular = N::sin_cos_all(angles);
        let (sin_q_2, cos_q_2) = circular[0];
        let (sin_q_4, cos_q_4) = circular[1];
        let (sin_q_3, cos_q_3) = circular[2];
        let (sin_q_5, cos_q_5) = circular[3];
        let (sin_q_1, cos_q_1) = circular[4];
        let t0 = cos_q_2 * sin_q_4;
        let t1 = sin_q_3.mul_add(t0, sin_q_2 * cos_q_4);
        let t2 = cos_q_2 * cos_q_3;
        let t3 = cos_q_5.mul_add(t1, sin_q_5 * t2);
        let t4 = sin_q_2 * n(p.l);
        let t5 = n(p.l) + t4;
        let t6 = cos_q_3 * cos_q_4.mul_sub(t5, n(p.l) * t0);
        let t7 = n(p.l).neg_mul_add(t2, t6);
        let t8 = n(p.k25).neg_mul_add(t7, t3 * n(p.k5));
        let t9 = cos_q_4 * cos_q_5;
        let t10 = sin_q_3 * n(p.k21);
        let t11 = cos_q_2 * cos_q_4;
        let t12 = sin_q_3.mul_sub(t11, sin_q_2 * sin_q_4);
        let t13 = n(p.k25) * sin_q_5;
        let t14 = n(p.k23) + t13;
        let t15 = t12 * t14;
        let t16 = t5.mul_add(t10, sin_q_2 * n(p.k8));
        let t17 = sin_q_3.mul_add(t5, t4);
        let t18 = cos_q_3 * cos_q_5;
        let t19 = sin_q_4.mul_add(t5, n(p.l) * t11) * t18;
        let t20 = sin_q_5.neg_mul_add(n(p.l).neg_mul_add(t12, t17), t19);
        let t21 = n(p.k25).mul_add(t20, t12 * n(p.k3));
        let t22 = sin_q_5 * n(p.k28);
        let t23 = t12.mul_add(t22, n(p.k23).neg_mul_add(t17, t12 * n(p.k7)));
        let t24 = t21 + t23;
        let t25 = t9.mul_add(t8, n(p.l).neg_mul_add(t15, t16));
        let t26 = sin_q_4.neg_mul_add(t24, t25);
        let t27 = n(p.k25).mul_add(t3, t2 * n(p.k23));
        let t28 = n(p.k25) * t12;
        let t29 = sin_q_4 * cos_q_5;
        let t30 = sin_q_3 * sin_q_2.neg_mul_add(n(p.k21), t15);
        let t31 = cos_q_3.mul_add(cos_q_4.mul_sub(t27, t28 * t29), t30);
        let t32 = t26 + sin_q_2.mul_add(n(p.k11), n(p.k27));
        let t33 = n(p.k23).neg_mul_add(t6, t2 * n(p.k6));
        let t34 = sin_q_5.mul_add(t8, t3.mul_add(n(p.k28), t33));
        let t35 = sin_q_4.mul_add(t27, t28 * t9);
        let t36 = n(p.l).mul_add(t35, t2.mul_add(n(p.k9), t34));
        let t37 = cos_q_4.mul_add(t24, t29 * t8);
        let t38 = sin_q_2.neg_mul_add(n(p.k19), t31);
        let t39 = cos_q_3.mul_add(t36, sin_q_3 * t37);
        let t40 = cos_q_2.mul_add(t39, n(p.l).neg_mul_add(t38, n(p.k12)));
        let t41 = sin_q_2.mul_add(n(p.l).neg_mul_add(t31, t32), t40);
        let t42 = N::ONE / t41;
        let t43 = cos_q_3.mul_sub(t37, n(p.l) * t2.mul_add(n(p.k21), t35));
        let t44 = sin_q_3.neg_mul_add(t36, t43);
        let t45 = t42 * t44;
        let t46 = n(p.l) * sin_q_3;
        let t47 = n(p.l) + t46;
        let t48 = sin_q_4 * t47;
        let t49 = sin_q_4.mul_sub(t18, sin_q_3 * sin_q_5);
        let t50 = n(p.k25).mul_sub(t46 + t48, n(p.k5) * t49);
        let t51 = n(p.k23).mul_add(t48, sin_q_3 * n(p.k6));
        let t52 = sin_q_5.mul_add(t50, n(p.k28).neg_mul_add(t49, t51));
        let t53 = n(p.k25) * cos_q_4;
        let t54 = n(p.k25).neg_mul_add(t49, sin_q_3 * n(p.k23));
        let t55 = sin_q_4.mul_sub(t54, t53 * (cos_q_4 * t18));
        let t56 = t52 + sin_q_3.mul_add(n(p.k9), n(p.k29));
        let t57 = cos_q_3 * sin_q_5;
        let t58 = cos_q_3 * cos_q_4;
        let t59 = cos_q_5.mul_sub(t47, n(p.l) * t57);
        let t60 = t53.mul_sub(t59, n(p.k3) * t58);
        let t61 = t58.neg_mul_add(t22 + n(p.k7), t60);
        let t62 = n(p.l).mul_add(t10 + t55, n(p.k10));
        let t63 = cos_q_3.neg_mul_add(cos_q_4.mul_add(t61, t29 * t50), t62);
        let t64 = sin_q_3.mul_add(n(p.l).mul_add(t55, t56), t63);
        let t65 = t44.neg_mul_add(t45, t64);
        let t66 = N::ONE / t65;
        let t67 = t26 * t42;
        let t68 = t9.mul_add(t50, t14 * (n(p.l) * t58));
        let t69 = t44.mul_add(t67, sin_q_4.neg_mul_add(t61, t68));
        let t70 = t66 * t69;
        let t71 = n(p.l) * sin_q_4;
        let t72 = t13.mul_add(n(p.l) + t71, sin_q_4 * n(p.k3));
        let t73 = sin_q_4.mul_add(t22, sin_q_4.mul_add(n(p.k7), n(p.k30)));
        let t74 = t14.mul_add(t71, t9.mul_add(t9 * n(p.k5), n(p.k8)));
        let t75 = sin_q_4.mul_add(t72 + t73, t74);
        let t76 = t69.neg_mul_add(t70, t26.neg_mul_add(t67, t75));
        let t77 = N::ONE / t76;
        let t78 = t34 * t42;
        let t79 = t44.mul_add(t78, t52);
        let t80 = t66 * t79;
        let t81 = sin_q_5.mul_add(n(p.k5), n(p.k28));
        let t82 = t69.neg_mul_add(t80, t26.neg_mul_add(t78, t9 * t81));
        let t83 = t77 * t82;
        let t84 = sin_q_5.mul_add(n(p.k28) + t81, n(p.k6));
        let t85 = t79.neg_mul_add(t80, t34.neg_mul_add(t78, t84));
        let t86 = t82.neg_mul_add(t83, t85);
        let t87 = N::ONE / t86;
        let t88 = t21 * t42;
        let t89 = t44.mul_add(t88, t60);
        let t90 = t66 * t89;
        let t91 = t69.mul_add(t90, t26.mul_add(t88, t72));
        let t92 = t77 * t91;
        let t93 = t82.neg_mul_add(t92, t79.mul_add(t90, t34 * t88));
        let t94 = t87 * t93;
        let t95 = t89.neg_mul_add(t90, t21.neg_mul_add(t88, n(p.k3)));
        let t96 = t93.neg_mul_add(t94, t91.neg_mul_add(t92, t95));
        let t97 = N::ONE / t96;
        let t98 = n(p.l).mul_add(sin_q_5, n(p.l));
        let t99 = sin_q_4.mul_add(t98, n(p.l));
        let t100 = sin_q_3 * t99;
        let t101 = n(p.l) * t18;
        let t102 = t11 * t98;
        let t103 = sin_q_2.mul_add(t100 - t101, t5 - t102);
        let t104 = n(p.l) * cos_q_5;
        let t105 = sin_q_3 * t104;
        let t106 = cos_q_3.mul_add(t99, t105);
        let t107 = sin_q_1.neg_mul_add(t103, cos_q_1 * t106);
        let t108 = t42 * t107;
        let t109 = cos_q_4 * t98;
        let t110 = sin_q_2 * cos_q_1;
        let t111 = t100 + (n(p.l) - t101);
        let t112 = t111.mul_add(cos_q_2 * cos_q_1, t109 * t110);
        let t113 = t44.mul_add(t108, t112);
        let t114 = t66 * t113;
        let t115 = sin_q_3 * sin_q_1.mul_sub(t99, t104 * t110);
        let t116 = cos_q_3.mul_sub(t99.mul_add(t110, sin_q_1 * t104), t115);
        let t117 = t69.neg_mul_add(t114, t26.neg_mul_add(t108, t116));
        let t118 = t77 * t117;
        let t119 = sin_q_3.mul_add(t110, cos_q_3 * sin_q_1);
        let t120 = t98 * cos_q_4.mul_add(t119, t0 * cos_q_1);
        let t121 = t79.neg_mul_add(t114, t34.neg_mul_add(t108, t120));
        let t122 = t82.neg_mul_add(t118, t121);
        let t123 = t87 * t122;
        let t124 = sin_q_4.neg_mul_add(t119, t11 * cos_q_1);
        let t125 = cos_q_3.mul_sub(t110, sin_q_3 * sin_q_1);
        let t126 = n(p.l) * cos_q_5.mul_sub(t124, sin_q_5 * t125);
        let t127 = t89.neg_mul_add(t114, t21.neg_mul_add(t108, t126));
        let t128 = t93.mul_add(t123, t91.mul_add(t118, t127));
        let t129 = t97 * t128;
        let t130 = t117.mul_add(t118, t113.mul_add(t114, t107 * t108));
        let t131 = t128.mul_add(t129, t122.mul_add(t123, t130));
        let t132 = N::ONE / t131;
        let t133 = sin_q_3 * sin_q_4;
        let t134 = sin_q_2.neg_mul_add(t98.mul_add(t133, t47 - t101), t102);
        let t135 = t66 * t134;
        let t136 = t69.neg_mul_add(t135, cos_q_2.mul_add(t105, t2 * t99));
        let t137 = t77 * t136;
        let t138 = t82.neg_mul_add(t137, t79.neg_mul_add(t135, t12 * t98));
        let t139 = t87 * t138;
        let t140 = t91.neg_mul_add(t137, t89.mul_add(t135, n(p.l) * t3));
        let t141 = t93.neg_mul_add(t139, t140);
        let t142 = t97 * t141;
        let t143 = t139.mul_add(t122, t137.mul_add(t117, t135 * t113));
        let t144 = t142.neg_mul_add(t128, t143);
        let t145 = t132 * t144;
        let t146 = t136.mul_add(t137, t134 * t135);
        let t147 = t141.mul_add(t142, t138 * t139) + t146;
        let t148 = t144.neg_mul_add(t145, t147);
        let t149 = N::ONE / t148;
        let t150 = cos_q_1.mul_add(t103, sin_q_1 * t106);
        let t151 = t42 * t150;
        let t152 = sin_q_2 * sin_q_1;
        let t153 = cos_q_2 * sin_q_1;
        let t154 = t44.mul_add(t151, t153.mul_add(t111, t152 * t109));
        let t155 = t66 * t154;
        let t156 = cos_q_3 * t152.mul_sub(t99, cos_q_1 * t104);
        let t157 = sin_q_3.mul_add(cos_q_1.mul_add(t99, t152 * t104), t156);
        let t158 = t69.neg_mul_add(t155, t26.neg_mul_add(t151, t157));
        let t159 = t77 * t158;
        let t160 = sin_q_3.neg_mul_add(t152, cos_q_3 * cos_q_1);
        let t161 = cos_q_4.mul_sub(t160, t0 * sin_q_1);
        let t162 = t79.mul_add(t155, t34.mul_add(t151, t161 * t98));
        let t163 = t82.mul_add(t159, t162);
        let t164 = t87 * t163;
        let t165 = sin_q_4.mul_add(t160, t11 * sin_q_1);
        let t166 = cos_q_3.mul_add(t152, sin_q_3 * cos_q_1);
        let t167 = n(p.l) * cos_q_5.mul_sub(t165, sin_q_5 * t166);
        let t168 = t89.neg_mul_add(t155, t21.neg_mul_add(t151, t167));
        let t169 = t93.neg_mul_add(t164, t91.mul_add(t159, t168));
        let t170 = t97 * t169;
        let t171 = t159.mul_add(t117, t155.mul_add(t113, t151 * t107));
        let t172 = t170.mul_add(t128, t164.neg_mul_add(t122, t171));
        let t173 = t132 * t172;
        let t174 = t164.neg_mul_add(t138, t159.mul_add(t136, t155 * t134));
        let t175 = t144.neg_mul_add(t173, t170.neg_mul_add(t141, t174));
        let t176 = t149 * t175;
        let t177 = t169.mul_add(t170, t154.mul_add(t155, t150 * t151));
        let t178 = t177 + t163.mul_add(t164, t158 * t159);
        let t179 = t175.neg_mul_add(t176, t172.neg_mul_add(t173, t178));
        let t180 = N::ONE / t179;
        let t181 = sin_q_3.mul_add(t29, t57);
        let t182 = sin_q_2.neg_mul_add(t181, t11 * cos_q_5);
        let t183 = t66 * t182;
        let t184 = t69.neg_mul_add(t183, cos_q_2 * t49);
        let t185 = t77 * t184;
        let t186 = t79.neg_mul_add(t183, t12 * cos_q_5);
        let t187 = t82.neg_mul_add(t185, t186);
        let t188 = t87 * t187;
        let t189 = cos_q_2 * t18;
        let t190 = t89.mul_add(t183, sin_q_5.neg_mul_add(t1, t189));
        let t191 = t93.neg_mul_add(t188, t91.neg_mul_add(t185, t190));
        let t192 = t97 * t191;
        let t193 = t188.mul_add(t122, t185.mul_add(t117, t183 * t113));
        let t194 = t192.neg_mul_add(t128, t193);
        let t195 = t132 * t194;
        let t196 = t188.mul_add(t138, t185.mul_add(t136, t183 * t134));
        let t197 = t144.neg_mul_add(t195, t192.mul_add(t141, t196));
        let t198 = t149 * t197;
        let t199 = t188.neg_mul_add(t163, t185.mul_add(t158, t183 * t154));
        let t200 = t172.neg_mul_add(t195, t192.neg_mul_add(t169, t199));
        let t201 = t175.neg_mul_add(t198, t200);
        let t202 = t180 * t201;
        let t203 = t184.mul_add(t185, t182 * t183);
        let t204 = t191.mul_add(t192, t187 * t188) + t203;
        let t205 = t197.neg_mul_add(t198, t194.neg_mul_add(t195, t204));
        let t206 = t201.neg_mul_add(t202, t205);
        let t207 = N::ONE / t206;
        let t208 = cos_q_1.mul_sub(t182, t49 * sin_q_1);
        let t209 = t42 * t208;
        let t210 = t44.neg_mul_add(t209, t181.mul_add(t153, t9 * t152));
        let t211 = t66 * t210;
        let t212 = cos_q_3 * t29.mul_add(t152, sin_q_5 * cos_q_1);
        let t213 = t29.mul_sub(cos_q_1, sin_q_5 * t152);
        let t214 = t26.mul_add(t209, sin_q_3.mul_add(t213, t212));
        let t215 = t211.neg_mul_add(t69, t214);
        let t216 = t77 * t215;
        let t217 = t211.mul_add(t79, t34.neg_mul_add(t209, cos_q_5 * t161));
        let t218 = t82.mul_add(t216, t217);
        let t219 = t87 * t218;
        let t220 = sin_q_5.mul_add(t165, cos_q_5 * t166);
        let t221 = t211.mul_add(t89, t21.neg_mul_add(t209, t220));
        let t222 = t93.mul_add(t219, t91.neg_mul_add(t216, t221));
        let t223 = t97 * t222;
        let t224 = t211.neg_mul_add(t113, t209 * t107);
        let t225 = t219.mul_add(t122, t216.neg_mul_add(t117, t224));
        let t226 = t223.mul_add(t128, t225);
        let t227 = t132 * t226;
        let t228 = t219.neg_mul_add(t138, t216.mul_add(t136, t211 * t134));
        let t229 = t144.mul_add(t227, t223.mul_add(t141, t228));
        let t230 = t149 * t229;
        let t231 = t211.neg_mul_add(t154, t209 * t150);
        let t232 = t219.neg_mul_add(t163, t216.neg_mul_add(t158, t231));
        let t233 = t172.neg_mul_add(t227, t223.mul_add(t169, t232));
        let t234 = t175.mul_add(t230, t233);
        let t235 = t180 * t234;
        let t236 = t219.neg_mul_add(t187, t216.mul_add(t184, t182 * t211));
        let t237 = t194.mul_add(t227, t223.mul_add(t191, t236));
        let t238 = t201.mul_add(t235, t197.neg_mul_add(t230, t237));
        let t239 = t207 * t238;
        let t240 = sin_q_2 * q_1_dot;
        let t241 = n(p.l) * q_1_dot;
        let t242 = t240.mul_add(t240, q_2_dot * q_2_dot);
        let t243 = n(p.l).mul_add(t242, t240.mul_add(t241, cos_q_2 * n(p.g)));
        let t244 = cos_q_2 * q_2_dot;
        let t245 = q_1_dot * t244;
        let t246 = t245 * n(p.k16);
        let t247 = cos_q_3.mul_sub(t243, sin_q_3 * t246);
        let t248 = cos_q_2 * q_1_dot;
        let t249 = sin_q_3.neg_mul_add(t248, cos_q_3 * q_2_dot);
        let t250 = t2.mul_add(q_1_dot, sin_q_3 * q_2_dot);
        let t251 = t249 * t250;
        let t252 = t245 - t251;
        let t253 = n(p.l).neg_mul_add(t252, t247);
        let t254 = t240 + q_3_dot;
        let t255 = cos_q_4.mul_sub(t254, sin_q_4 * t249);
        let t256 = q_2_dot * t240;
        let t257 = sin_q_3.mul_sub(t256, q_3_dot * t250);
        let t258 = cos_q_4.mul_add(t257, sin_q_4 * t245);
        let t259 = t255.mul_add(q_4_dot, t258);
        let t260 = q_4_dot + t250;
        let t261 = t255 * t260;
        let t262 = t259 + t261;
        let t263 = t250.mul_add(t250, t254 * t254);
        let t264 = cos_q_3.mul_add(t246, sin_q_3 * t243);
        let t265 = n(p.l).mul_add(t263, t264);
        let t266 = t248.neg_mul_add(t241, sin_q_2 * n(p.g));
        let t267 = t248 * t240;
        let t268 = n(p.l).neg_mul_add(t267, t266);
        let t269 = cos_q_3.mul_sub(t256, t249 * q_3_dot);
        let t270 = t249 * t254;
        let t271 = t269 - t270;
        let t272 = n(p.l).neg_mul_add(t271, t268);
        let t273 = sin_q_4.mul_add(t254, cos_q_4 * t249);
        let t274 = t273.mul_add(t273, t260 * t260);
        let t275 = sin_q_4.mul_add(t265, cos_q_4 * t272);
        let t276 = sin_q_5 * n(p.l).neg_mul_add(t262, t253);
        let t277 = sin_q_5.neg_mul_add(t255, cos_q_5 * t260);
        let t278 = cos_q_5.mul_add(t255, sin_q_5 * t260);
        let t279 = t277 * t278;
        let t280 = cos_q_5.mul_add(n(p.l).mul_add(t274, t275), t276);
        let t281 = n(p.k3).mul_sub(t259, n(p.k5) * t279);
        let t282 = n(p.k25).neg_mul_add(t280, t281);
        let t283 = t259 - t279;
        let t284 = t273 + q_5_dot;
        let t285 = t284.mul_add(t284, t278 * t278);
        let t286 = sin_q_5.mul_add(t283, cos_q_5 * t285);
        let t287 = n(p.k7).mul_add(t259, n(p.k6) * t261);
        let t288 = n(p.k28).mul_add(t286, n(p.k23).neg_mul_add(t253, t287));
        let t289 = t282 + t288;
        let t290 = n(p.k25).mul_add(t286, n(p.k23) * t262);
        let t291 = n(p.k9).neg_mul_add(t251, n(p.k8) * t245);
        let t292 = n(p.l).mul_add(t290, n(p.k21).neg_mul_add(t247, t291));
        let t293 = cos_q_4.mul_sub(t265, sin_q_4 * t272);
        let t294 = t255 * t273;
        let t295 = t269 + t294;
        let t296 = sin_q_4.neg_mul_add(t257, cos_q_4 * t245);
        let t297 = q_4_dot.neg_mul_add(t273, t296);
        let t298 = cos_q_5.mul_sub(t297, sin_q_5 * t269);
        let t299 = t277.mul_add(q_5_dot, t298);
        let t300 = t277 * t284;
        let t301 = n(p.k5).mul_add(t299, n(p.k3) * t300);
        let t302 = n(p.k25).neg_mul_add(n(p.l).mul_add(t295, t293), t301);
        let t303 = t278 * (t284 * n(p.k24));
        let t304 = sin_q_5.neg_mul_add(t303, t273 * (t260 * n(p.k22)));
        let t305 = cos_q_5.neg_mul_add(t302, t304);
        let t306 = cos_q_4.neg_mul_add(t305, sin_q_4.mul_add(t289, t292));
        let t307 = sin_q_5.mul_sub(t285, cos_q_5 * t283);
        let t308 = n(p.k25).mul_add(t307, n(p.k23) * t274);
        let t309 = t300 + t299;
        let t310 = n(p.k25).neg_mul_add(t309, n(p.k23) * t295);
        let t311 = sin_q_4.mul_add(t308, n(p.k21) * t263);
        let t312 = sin_q_3 * n(p.k21).mul_add(t252, t290);
        let t313 = cos_q_3.mul_add(cos_q_4.mul_add(t310, t311), t312);
        let t314 = sin_q_4.neg_mul_add(t305, t250 * (t254 * n(p.k20)));
        let t315 = cos_q_4.neg_mul_add(t289, t314);
        let t316 = n(p.k7).mul_add(t294, n(p.k6) * t269);
        let t317 = cos_q_5.mul_add(t303, n(p.k23).mul_add(t293, t316));
        let t318 = n(p.k28).neg_mul_add(t309, t317);
        let t319 = sin_q_5.neg_mul_add(t302, t318);
        let t320 = n(p.k9).mul_sub(t269, n(p.k8) * t270);
        let t321 = cos_q_4.mul_sub(t308, sin_q_4 * t310);
        let t322 = t319 + n(p.k21).neg_mul_add(t268, t320);
        let t323 = n(p.l).neg_mul_add(t321, t322);
        let t324 = cos_q_3.mul_add(t323, t256 * n(p.k18));
        let t325 = n(p.l) * t245.mul_add(n(p.k31), t313);
        let t326 = cos_q_2.mul_add(sin_q_3.mul_sub(t315, t324), t325);
        let t327 = n(p.l).mul_add(t313, t245.mul_add(n(p.k17), t306));
        let t328 = sin_q_2.mul_add(t327, t326);
        let t329 = n(p.k19).mul_sub(t266, n(p.k11) * t267);
        let t330 = n(p.l).mul_add(n(p.k21).neg_mul_add(t271, t321), t329);
        let t331 = cos_q_3.neg_mul_add(t315, sin_q_3.neg_mul_add(t323, t330));
        let t332 = t45.mul_add(t328, t331);
        let t333 = t70.neg_mul_add(t332, t67.neg_mul_add(t328, t306));
        let t334 = t80.mul_add(t332, t78.mul_add(t328, t319));
        let t335 = t83.mul_add(t333, t334);
        let t336 = sin_q_1 * q_1_dot;
        let t337 = t240 * t336;
        let t338 = sin_q_3 * t244;
        let t339 = cos_q_1 * q_1_dot;
        let t340 = t338 * t339;
        let t341 = cos_q_3 * q_3_dot;
        let t342 = cos_q_1 * t240;
        let t343 = t341 * t342;
        let t344 = sin_q_1 * t244;
        let t345 = t341 * t344;
        let t346 = sin_q_2 * q_2_dot;
        let t347 = q_2_dot * t346;
        let t348 = sin_q_1 * t347;
        let t349 = sin_q_3.neg_mul_add(t348, t345 + t340);
        let t350 = sin_q_3 * q_3_dot;
        let t351 = q_3_dot * t350;
        let t352 = sin_q_3.mul_sub(t337, t340) - t343 - t349;
        let t353 = t350 * t336;
        let t354 = q_1_dot * t339;
        let t355 = q_3_dot * t341;
        let t356 = cos_q_1.neg_mul_add(t355, t353);
        let t357 = t352 - t152.neg_mul_add(t351, t345 + t343);
        let t358 = cos_q_3.mul_sub(t354, t353) - t356 - t357;
        let t359 = sin_q_2.mul_add(t341, t338);
        let t360 = cos_q_1.mul_add(t350, cos_q_3 * t336);
        let t361 = sin_q_1.mul_add(t359, sin_q_3 * t342) + t360;
        let t362 = cos_q_4 * q_4_dot;
        let t363 = t362 * t361;
        let t364 = sin_q_4 * q_4_dot;
        let t365 = q_4_dot * t364;
        let t366 = cos_q_4 * cos_q_1;
        let t367 = t256 * t366;
        let t368 = cos_q_4 * sin_q_1;
        let t369 = q_2_dot * t244;
        let t370 = t346 * t364;
        let t371 = sin_q_1 * t370;
        let t372 = q_1_dot * t336;
        let t373 = t0 * q_4_dot;
        let t374 = t339 * t373;
        let t375 = t368.mul_add(t369, t367) - t371;
        let t376 = t11 * q_4_dot;
        let t377 = q_4_dot * t376;
        let t378 = t375 + (t374 + t11.mul_add(t372, t367));
        let t379 = t160.mul_add(t365, t363) + sin_q_4.mul_add(t358, t363);
        let t380 = t379 + (sin_q_1.mul_add(t377, t374 - t371) + t378);
        let t381 = t244 * t339;
        let t382 = cos_q_4.mul_add(t346, t373);
        let t383 = sin_q_1.neg_mul_add(t382, t11 * t339);
        let t384 = t383 - sin_q_4.mul_sub(t361, t160 * t362);
        let t385 = cos_q_5 * q_5_dot;
        let t386 = t385 * t384;
        let t387 = sin_q_5 * q_5_dot;
        let t388 = q_5_dot * t387;
        let t389 = sin_q_5.neg_mul_add(t380, t386);
        let t390 = t350 * t344;
        let t391 = t350 * t342;
        let t392 = cos_q_3 * t244;
        let t393 = t339 * t392;
        let t394 = cos_q_3.mul_add(t337, t391) - t393;
        let t395 = cos_q_3.neg_mul_add(t348, t393 - t390);
        let t396 = t341 * t336;
        let t397 = cos_q_1.mul_add(t351, t396) + sin_q_3.mul_add(t354, t396);
        let t398 = t397 + (t152.mul_add(t355, t390 + t391) + t394 - t395);
        let t399 = sin_q_2 * t350;
        let t400 = sin_q_1.mul_add(t392 - t399, cos_q_3 * t342);
        let t401 = t400 - sin_q_3.mul_sub(t336, cos_q_1 * t341);
        let t402 = t387 * t401;
        let t403 = q_5_dot * t385;
        let t404 = t166.mul_add(t403, t402) + cos_q_5.mul_add(t398, t402);
        let t405 = t372 + (t337 - t381 - (t381 - t348)) - t358 - t380;
        let t406 = t405 - (t404 - (t165.neg_mul_add(t388, t386) + t389));
        let t407 = t155.mul_add(t332, t151.mul_add(t328, n(p.l) * t406));
        let t408 = t90.mul_add(t332, t88.mul_add(t328, t282));
        let t409 = t94.mul_add(t335, t92.neg_mul_add(t333, t408));
        let t410 = t164.mul_add(t335, t159.mul_add(t333, t407));
        let t411 = t338 * t336;
        let t412 = cos_q_1 * t244;
        let t413 = t341 * t412;
        let t414 = cos_q_1 * t347;
        let t415 = t240 * t339;
        let t416 = sin_q_1 * t240;
        let t417 = t341 * t416;
        let t418 = t417 + sin_q_3.mul_add(t415, t411);
        let t419 = sin_q_3.mul_add(t414, t411 - t413) + t418;
        let t420 = t350 * t339;
        let t421 = sin_q_1.mul_add(t355, t420) + cos_q_3.mul_add(t372, t420);
        let t422 = t110.mul_add(t351, t417) - t413 + t419 + t421;
        let t423 = cos_q_1.neg_mul_add(t359, sin_q_3 * t416);
        let t424 = cos_q_3.mul_sub(t339, sin_q_1 * t350) - t423;
        let t425 = t362 * t424;
        let t426 = sin_q_4.neg_mul_add(t422, t425);
        let t427 = t256 * t368;
        let t428 = t373 * t336;
        let t429 = cos_q_1 * t370;
        let t430 = t366.neg_mul_add(t369, t429 + t427);
        let t431 = cos_q_1.neg_mul_add(t377, t429 + t428);
        let t432 = t11.mul_sub(t354, t427) - t428 - t430 - t431;
        let t433 = t119.neg_mul_add(t365, t425) + t426 + t432;
        let t434 = sin_q_4.mul_add(t424, t119 * t362);
        let t435 = t385 * (t434 + cos_q_1.mul_add(t382, t11 * t336));
        let t436 = t350 * t412;
        let t437 = t336 * t392;
        let t438 = t416 * t350;
        let t439 = cos_q_3.mul_add(t415, t437) - t438;
        let t440 = cos_q_3.mul_add(t414, t436 + t437) + t439;
        let t441 = t341 * t339;
        let t442 = sin_q_1.neg_mul_add(t351, t441);
        let t443 = t440 - t110.neg_mul_add(t355, t438 - t436);
        let t444 = cos_q_1.mul_add(t399 - t392, cos_q_3 * t416);
        let t445 = t387 * (sin_q_1.mul_add(t341, sin_q_3 * t339) + t444);
        let t446 = t443 - (sin_q_3.mul_sub(t372, t441) - t442);
        let t447 = cos_q_5.neg_mul_add(t446, t445);
        let t448 = t124.mul_add(t388, t435) + sin_q_5.mul_add(t433, t435);
        let t449 = t244 * t336;
        let t450 = t422 + (t354 + (t414 + t449 + (t415 + t449))) - t433;
        let t451 = t125.neg_mul_add(t403, t445) + t447 - t448 + t450;
        let t452 = t114.mul_add(t332, t108.mul_add(t328, n(p.l) * t451));
        let t453 = t123.neg_mul_add(t335, t118.mul_add(t333, t452));
        let t454 = t129.neg_mul_add(t409, t453);
        let t455 = sin_q_4 * t341;
        let t456 = t346 * t455;
        let t457 = t341 * t376;
        let t458 = sin_q_3 * t362;
        let t459 = t346 * t458;
        let t460 = t459 + t133.mul_add(t369, t456);
        let t461 = t373.mul_add(sin_q_3 * q_4_dot, t459) - t457;
        let t462 = t244 * t364;
        let t463 = t362.mul_add(sin_q_2 * q_4_dot, t462);
        let t464 = t461 + (t0.mul_add(t351, t456) - t457 + t460);
        let t465 = t464 + (t463 + cos_q_4.mul_add(t347, t462));
        let t466 = cos_q_2.neg_mul_add(t458 + t455, t133 * t346);
        let t467 = cos_q_4.mul_sub(t244, sin_q_2 * t364) - t466;
        let t468 = t385 * t467;
        let t469 = sin_q_5.neg_mul_add(t465, t468);
        let t470 = t350 * t346;
        let t471 = cos_q_5 * t470;
        let t472 = t387 * (cos_q_3 * t346);
        let t473 = cos_q_2 * t350;
        let t474 = t387 * t473;
        let t475 = cos_q_2 * t355;
        let t476 = cos_q_5.neg_mul_add(t475, t474 + t471);
        let t477 = t189.neg_mul_add(q_5_dot * q_5_dot, t474 + t472);
        let t478 = t18.mul_sub(t369, t471) - t472 - t476 - t477;
        let t479 = t341 * t346;
        let t480 = cos_q_2.mul_add(t351, t479) + sin_q_3.mul_add(t369, t479);
        let t481 = t1.neg_mul_add(t388, t468) + t469 + t478;
        let t482 = t135.mul_add(t332, n(p.l) * (t465 + (t369 + t480) - t481));
        let t483 = t139.neg_mul_add(t335, t137.mul_add(t333, t482));
        let t484 = t145.neg_mul_add(t454, t142.mul_add(t409, t483));
        let t485 = t173.neg_mul_add(t454, t170.neg_mul_add(t409, t410));
        let t486 = t176.neg_mul_add(t484, t485);
        let t487 = t385 * t473;
        let t488 = t346 * (t18 * q_5_dot);
        let t489 = sin_q_5 * t470;
        let t490 = t57.mul_add(t369, t488) - t489;
        let t491 = sin_q_5.neg_mul_add(t475, t489 - t487);
        let t492 = t387 * t467;
        let t493 = t1.mul_add(t403, t492) + cos_q_5.mul_add(t465, t492);
        let t494 = t2.mul_add(t388, t487 + t488) + t490 - t491 + t493;
        let t495 = t185.mul_add(t333, t183.mul_add(t332, t494));
        let t496 = t192.mul_add(t409, t188.neg_mul_add(t335, t495));
        let t497 = t198.neg_mul_add(t484, t195.neg_mul_add(t454, t496));
        let t498 = t202.neg_mul_add(t486, t497);
        let t499 = t387 * t384;
        let t500 = t385 * t401;
        let t501 = sin_q_5.neg_mul_add(t398, t500);
        let t502 = t165.mul_add(t403, t499) + cos_q_5.mul_add(t380, t499);
        let t503 = t166.neg_mul_add(t388, t500) + t501 + t502;
        let t504 = t211.neg_mul_add(t332, t209.mul_add(t328, t503));
        let t505 = t219.neg_mul_add(t335, t216.neg_mul_add(t333, t504));
        let t506 = t227.neg_mul_add(t454, t223.neg_mul_add(t409, t505));
        let t507 = t235.neg_mul_add(t486, t230.mul_add(t484, t506));
        let t508 = t222.mul_add(t223, t210.mul_add(t211, t208 * t209));
        let t509 = t508 + t218.mul_add(t219, t215 * t216);
        let t510 = t229.neg_mul_add(t230, t226.neg_mul_add(t227, t509));
        let t511 = t238.neg_mul_add(t239, t234.neg_mul_add(t235, t510));
        let t512 = t239.mul_add(t498, t507) / t511;
        let t513 = t239.mul_add(t512, t207 * t498);
        let t514 = t227.neg_mul_add(t512, t132 * t454);
        let t515 = t235.neg_mul_add(t512, t180 * t486);
        let t516 = t202.neg_mul_add(t513, t515);
        let t517 = t198.neg_mul_add(t513, t230.mul_add(t512, t149 * t484));
        let t518 = t176.neg_mul_add(t516, t517);
        let t519 = t173.neg_mul_add(t516, t195.neg_mul_add(t513, t514));
        let t520 = t145.neg_mul_add(t518, t519);
        let t521 = t192.neg_mul_add(t513, t223.mul_add(t512, t97 * t409));
        let t522 = t142.neg_mul_add(t518, t170.mul_add(t516, t521));
        let t523 = t129.mul_add(t520, t522);
        let t524 = t188.mul_add(t513, t219.mul_add(t512, t87 * t335));
        let t525 = t139.mul_add(t518, t164.neg_mul_add(t516, t524));
        let q_4_ddot = t94.mul_add(t523, t123.mul_add(t520, t525));
        let t526 = t183.neg_mul_add(t513, t211.mul_add(t512, t66 * t332));
        let t527 = t135.neg_mul_add(t518, t155.neg_mul_add(t516, t526));
        let t528 = t90.mul_add(t523, t114.neg_mul_add(t520, t527));
        let t529 = t80.mul_add(q_4_ddot, t528);
        let t530 = t185.neg_mul_add(t513, t216.mul_add(t512, t77 * t333));
        let t531 = t137.neg_mul_add(t518, t159.neg_mul_add(t516, t530));
        let t532 = t92.neg_mul_add(t523, t118.neg_mul_add(t520, t531));
        let t533 = t83.mul_add(q_4_ddot, t532);
        let t534 = t70 * t533;
        let t535 = t151.neg_mul_add(t516, t209.neg_mul_add(t512, t42 * t328));
        let t536 = t88.mul_add(t523, t108.neg_mul_add(t520, t535));
        let t537 = t67.neg_mul_add(t533, t78.mul_add(q_4_ddot, t536));
        let q_1_ddot = -t45.mul_add(t529 - t534, t537);
        let q_2_ddot = t534 - t529;
        let q_3_ddot = -t533;
        let q_5_ddot = -t523;
        let sound = PIVOTS.hold(t41, t41)
            & PIVOTS.hold(t65, t64)
            & PIVOTS.hold(t76, t75)
            & PIVOTS.hold(t86, t84)
            & PIVOTS.hold(t96, n(p.k3))
            & PIVOTS.hold(t131, t131)
            & PIVOTS.hold(t148, t147)
            & PIVOTS.hold(t179, t178)
            & PIVOTS.hold(t206, t204)
            & PIVOTS.hold(t511, t509)
            & q_1_ddot.is_finite();
        if !sound {
            let pivots = [
                (0, t41, t41),
                (1, t65, t64),
                (2, t76, t75),
                (3, t86, t84),
                (4, t96, n(p.k3)),
                (5, t131, t131),
                (6, t148, t147),
                (7, t179, t178),
                (8, t206, t204),
                (9, t511, t509),
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
) -> Result<[S; 5], ::lagrangian::emitted::Singular> {
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
    type Output = Result<[S; 5], ::lagrangian::emitted::Singular>;

    #[inline(always)]
    fn run<N: ::lagrangian::emitted::Scalar<Stored = S>>(self) -> Self::Output {
        let Self { p, q, v } = self;
        let n = N::load;
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
        let angles = [q_2, q_4, q_3, q_5, q_1];
        let circular = N::sin_cos_all(angles);
        let (sin_q_2, cos_q_2) = circular[0];
        let (sin_q_4, cos_q_4) = circular[1];
        let (sin_q_3, cos_q_3) = circular[2];
        let (sin_q_5, cos_q_5) = circular[3];
        let (sin_q_1, cos_q_1) = circular[4];
        let t0 = cos_q_2 * sin_q_4;
        let t1 = sin_q_3.mul_add(t0, sin_q_2 * cos_q_4);
        let t2 = cos_q_2 * cos_q_3;
        let t3 = cos_q_5.mul_add(t1, sin_q_5 * t2);
        let t4 = sin_q_2 * n(p.l);
        let t5 = n(p.l) + t4;
        let t6 = cos_q_3 * cos_q_4.mul_sub(t5, n(p.l) * t0);
        let t7 = n(p.l).neg_mul_add(t2, t6);
        let t8 = n(p.k25).neg_mul_add(t7, t3 * n(p.k5));
        let t9 = cos_q_4 * cos_q_5;
        let t10 = sin_q_3 * n(p.k21);
        let t11 = cos_q_2 * cos_q_4;
        let t12 = sin_q_3.mul_sub(t11, sin_q_2 * sin_q_4);
        let t13 = n(p.k25) * sin_q_5;
        let t14 = n(p.k23) + t13;
        let t15 = t12 * t14;
        let t16 = t5.mul_add(t10, sin_q_2 * n(p.k8));
        let t17 = sin_q_3.mul_add(t5, t4);
        let t18 = cos_q_3 * cos_q_5;
        let t19 = sin_q_4.mul_add(t5, n(p.l) * t11) * t18;
        let t20 = sin_q_5.neg_mul_add(n(p.l).neg_mul_add(t12, t17), t19);
        let t21 = n(p.k25).mul_add(t20, t12 * n(p.k3));
        let t22 = sin_q_5 * n(p.k28);
        let t23 = t12.mul_add(t22, n(p.k23).neg_mul_add(t17, t12 * n(p.k7)));
        let t24 = t21 + t23;
        let t25 = t9.mul_add(t8, n(p.l).neg_mul_add(t15, t16));
        let t26 = sin_q_4.neg_mul_add(t24, t25);
        let t27 = n(p.k25).mul_add(t3, t2 * n(p.k23));
        let t28 = n(p.k25) * t12;
        let t29 = sin_q_4 * cos_q_5;
        let t30 = sin_q_3 * sin_q_2.neg_mul_add(n(p.k21), t15);
        let t31 = cos_q_3.mul_add(cos_q_4.mul_sub(t27, t28 * t29), t30);
        let t32 = t26 + sin_q_2.mul_add(n(p.k11), n(p.k27));
        let t33 = n(p.k23).neg_mul_add(t6, t2 * n(p.k6));
        let t34 = sin_q_5.mul_add(t8, t3.mul_add(n(p.k28), t33));
        let t35 = sin_q_4.mul_add(t27, t28 * t9);
        let t36 = n(p.l).mul_add(t35, t2.mul_add(n(p.k9), t34));
        let t37 = cos_q_4.mul_add(t24, t29 * t8);
        let t38 = sin_q_2.neg_mul_add(n(p.k19), t31);
        let t39 = cos_q_3.mul_add(t36, sin_q_3 * t37);
        let t40 = cos_q_2.mul_add(t39, n(p.l).neg_mul_add(t38, n(p.k12)));
        let t41 = sin_q_2.mul_add(n(p.l).neg_mul_add(t31, t32), t40);
        let t42 = N::ONE / t41;
        let t43 = cos_q_3.mul_sub(t37, n(p.l) * t2.mul_add(n(p.k21), t35));
        let t44 = sin_q_3.neg_mul_add(t36, t43);
        let t45 = t42 * t44;
        let t46 = n(p.l) * sin_q_3;
        let t47 = n(p.l) + t46;
        let t48 = sin_q_4 * t47;
        let t49 = sin_q_4.mul_sub(t18, sin_q_3 * sin_q_5);
        let t50 = n(p.k25).mul_sub(t46 + t48, n(p.k5) * t49);
        let t51 = n(p.k23).mul_add(t48, sin_q_3 * n(p.k6));
        let t52 = sin_q_5.mul_add(t50, n(p.k28).neg_mul_add(t49, t51));
        let t53 = n(p.k25) * cos_q_4;
        let t54 = n(p.k25).neg_mul_add(t49, sin_q_3 * n(p.k23));
        let t55 = sin_q_4.mul_sub(t54, t53 * (cos_q_4 * t18));
        let t56 = t52 + sin_q_3.mul_add(n(p.k9), n(p.k29));
        let t57 = cos_q_3 * sin_q_5;
        let t58 = cos_q_3 * cos_q_4;
        let t59 = cos_q_5.mul_sub(t47, n(p.l) * t57);
        let t60 = t53.mul_sub(t59, n(p.k3) * t58);
        let t61 = t58.neg_mul_add(t22 + n(p.k7), t60);
        let t62 = n(p.l).mul_add(t10 + t55, n(p.k10));
        let t63 = cos_q_3.neg_mul_add(cos_q_4.mul_add(t61, t29 * t50), t62);
        let t64 = sin_q_3.mul_add(n(p.l).mul_add(t55, t56), t63);
        let t65 = t44.neg_mul_add(t45, t64);
        let t66 = N::ONE / t65;
        let t67 = t26 * t42;
        let t68 = t9.mul_add(t50, t14 * (n(p.l) * t58));
        let t69 = t44.mul_add(t67, sin_q_4.neg_mul_add(t61, t68));
        let t70 = t66 * t69;
        let t71 = n(p.l) * sin_q_4;
        let t72 = t13.mul_add(n(p.l) + t71, sin_q_4 * n(p.k3));
        let t73 = sin_q_4.mul_add(t22, sin_q_4.mul_add(n(p.k7), n(p.k30)));
        let t74 = t14.mul_add(t71, t9.mul_add(t9 * n(p.k5), n(p.k8)));
        let t75 = sin_q_4.mul_add(t72 + t73, t74);
        let t76 = t69.neg_mul_add(t70, t26.neg_mul_add(t67, t75));
        let t77 = N::ONE / t76;
        let t78 = t34 * t42;
        let t79 = t44.mul_add(t78, t52);
        let t80 = t66 * t79;
        let t81 = sin_q_5.mul_add(n(p.k5), n(p.k28));
        let t82 = t69.neg_mul_add(t80, t26.neg_mul_add(t78, t9 * t81));
        let t83 = t77 * t82;
        let t84 = sin_q_5.mul_add(n(p.k28) + t81, n(p.k6));
        let t85 = t79.neg_mul_add(t80, t34.neg_mul_add(t78, t84));
        let t86 = t82.neg_mul_add(t83, t85);
        let t87 = N::ONE / t86;
        let t88 = t21 * t42;
        let t89 = t44.mul_add(t88, t60);
        let t90 = t66 * t89;
        let t91 = t69.mul_add(t90, t26.mul_add(t88, t72));
        let t92 = t77 * t91;
        let t93 = t82.neg_mul_add(t92, t79.mul_add(t90, t34 * t88));
        let t94 = t87 * t93;
        let t95 = t89.neg_mul_add(t90, t21.neg_mul_add(t88, n(p.k3)));
        let t96 = t93.neg_mul_add(t94, t91.neg_mul_add(t92, t95));
        let t97 = N::ONE / t96;
        let t98 = n(p.l).mul_add(sin_q_5, n(p.l));
        let t99 = sin_q_4.mul_add(t98, n(p.l));
        let t100 = sin_q_3 * t99;
        let t101 = n(p.l) * t18;
        let t102 = t11 * t98;
        let t103 = sin_q_2.mul_add(t100 - t101, t5 - t102);
        let t104 = n(p.l) * cos_q_5;
        let t105 = sin_q_3 * t104;
        let t106 = cos_q_3.mul_add(t99, t105);
        let t107 = sin_q_1.neg_mul_add(t103, cos_q_1 * t106);
        let t108 = t42 * t107;
        let t109 = cos_q_4 * t98;
        let t110 = sin_q_2 * cos_q_1;
        let t111 = t100 + (n(p.l) - t101);
        let t112 = t111.mul_add(cos_q_2 * cos_q_1, t109 * t110);
        let t113 = t44.mul_add(t108, t112);
        let t114 = t66 * t113;
        let t115 = sin_q_3 * sin_q_1.mul_sub(t99, t104 * t110);
        let t116 = cos_q_3.mul_sub(t99.mul_add(t110, sin_q_1 * t104), t115);
        let t117 = t69.neg_mul_add(t114, t26.neg_mul_add(t108, t116));
        let t118 = t77 * t117;
        let t119 = sin_q_3.mul_add(t110, cos_q_3 * sin_q_1);
        let t120 = t98 * cos_q_4.mul_add(t119, t0 * cos_q_1);
        let t121 = t79.neg_mul_add(t114, t34.neg_mul_add(t108, t120));
        let t122 = t82.neg_mul_add(t118, t121);
        let t123 = t87 * t122;
        let t124 = sin_q_4.neg_mul_add(t119, t11 * cos_q_1);
        let t125 = cos_q_3.mul_sub(t110, sin_q_3 * sin_q_1);
        let t126 = n(p.l) * cos_q_5.mul_sub(t124, sin_q_5 * t125);
        let t127 = t89.neg_mul_add(t114, t21.neg_mul_add(t108, t126));
        let t128 = t93.mul_add(t123, t91.mul_add(t118, t127));
        let t129 = t97 * t128;
        let t130 = t117.mul_add(t118, t113.mul_add(t114, t107 * t108));
        let t131 = t128.mul_add(t129, t122.mul_add(t123, t130));
        let t132 = N::ONE / t131;
        let t133 = sin_q_3 * sin_q_4;
        let t134 = sin_q_2.neg_mul_add(t98.mul_add(t133, t47 - t101), t102);
        let t135 = t66 * t134;
        let t136 = t69.neg_mul_add(t135, cos_q_2.mul_add(t105, t2 * t99));
        let t137 = t77 * t136;
        let t138 = t82.neg_mul_add(t137, t79.neg_mul_add(t135, t12 * t98));
        let t139 = t87 * t138;
        let t140 = t91.neg_mul_add(t137, t89.mul_add(t135, n(p.l) * t3));
        let t141 = t93.neg_mul_add(t139, t140);
        let t142 = t97 * t141;
        let t143 = t139.mul_add(t122, t137.mul_add(t117, t135 * t113));
        let t144 = t142.neg_mul_add(t128, t143);
        let t145 = t132 * t144;
        let t146 = t136.mul_add(t137, t134 * t135);
        let t147 = t141.mul_add(t142, t138 * t139) + t146;
        let t148 = t144.neg_mul_add(t145, t147);
        let t149 = N::ONE / t148;
        let t150 = cos_q_1.mul_add(t103, sin_q_1 * t106);
        let t151 = t42 * t150;
        let t152 = sin_q_2 * sin_q_1;
        let t153 = cos_q_2 * sin_q_1;
        let t154 = t44.mul_add(t151, t153.mul_add(t111, t152 * t109));
        let t155 = t66 * t154;
        let t156 = cos_q_3 * t152.mul_sub(t99, cos_q_1 * t104);
        let t157 = sin_q_3.mul_add(cos_q_1.mul_add(t99, t152 * t104), t156);
        let t158 = t69.neg_mul_add(t155, t26.neg_mul_add(t151, t157));
        let t159 = t77 * t158;
        let t160 = sin_q_3.neg_mul_add(t152, cos_q_3 * cos_q_1);
        let t161 = cos_q_4.mul_sub(t160, t0 * sin_q_1);
        let t162 = t79.mul_add(t155, t34.mul_add(t151, t161 * t98));
        let t163 = t82.mul_add(t159, t162);
        let t164 = t87 * t163;
        let t165 = sin_q_4.mul_add(t160, t11 * sin_q_1);
        let t166 = cos_q_3.mul_add(t152, sin_q_3 * cos_q_1);
        let t167 = n(p.l) * cos_q_5.mul_sub(t165, sin_q_5 * t166);
        let t168 = t89.neg_mul_add(t155, t21.neg_mul_add(t151, t167));
        let t169 = t93.neg_mul_add(t164, t91.mul_add(t159, t168));
        let t170 = t97 * t169;
        let t171 = t159.mul_add(t117, t155.mul_add(t113, t151 * t107));
        let t172 = t170.mul_add(t128, t164.neg_mul_add(t122, t171));
        let t173 = t132 * t172;
        let t174 = t164.neg_mul_add(t138, t159.mul_add(t136, t155 * t134));
        let t175 = t144.neg_mul_add(t173, t170.neg_mul_add(t141, t174));
        let t176 = t149 * t175;
        let t177 = t169.mul_add(t170, t154.mul_add(t155, t150 * t151));
        let t178 = t177 + t163.mul_add(t164, t158 * t159);
        let t179 = t175.neg_mul_add(t176, t172.neg_mul_add(t173, t178));
        let t180 = N::ONE / t179;
        let t181 = sin_q_3.mul_add(t29, t57);
        let t182 = sin_q_2.neg_mul_add(t181, t11 * cos_q_5);
        let t183 = t66 * t182;
        let t184 = t69.neg_mul_add(t183, cos_q_2 * t49);
        let t185 = t77 * t184;
        let t186 = t79.neg_mul_add(t183, t12 * cos_q_5);
        let t187 = t82.neg_mul_add(t185, t186);
        let t188 = t87 * t187;
        let t189 = cos_q_2 * t18;
        let t190 = t89.mul_add(t183, sin_q_5.neg_mul_add(t1, t189));
        let t191 = t93.neg_mul_add(t188, t91.neg_mul_add(t185, t190));
        let t192 = t97 * t191;
        let t193 = t188.mul_add(t122, t185.mul_add(t117, t183 * t113));
        let t194 = t192.neg_mul_add(t128, t193);
        let t195 = t132 * t194;
        let t196 = t188.mul_add(t138, t185.mul_add(t136, t183 * t134));
        let t197 = t144.neg_mul_add(t195, t192.mul_add(t141, t196));
        let t198 = t149 * t197;
        let t199 = t188.neg_mul_add(t163, t185.mul_add(t158, t183 * t154));
        let t200 = t172.neg_mul_add(t195, t192.neg_mul_add(t169, t199));
        let t201 = t175.neg_mul_add(t198, t200);
        let t202 = t180 * t201;
        let t203 = t184.mul_add(t185, t182 * t183);
        let t204 = t191.mul_add(t192, t187 * t188) + t203;
        let t205 = t197.neg_mul_add(t198, t194.neg_mul_add(t195, t204));
        let t206 = t201.neg_mul_add(t202, t205);
        let t207 = N::ONE / t206;
        let t208 = cos_q_1.mul_sub(t182, t49 * sin_q_1);
        let t209 = t42 * t208;
        let t210 = t44.neg_mul_add(t209, t181.mul_add(t153, t9 * t152));
        let t211 = t66 * t210;
        let t212 = cos_q_3 * t29.mul_add(t152, sin_q_5 * cos_q_1);
        let t213 = t29.mul_sub(cos_q_1, sin_q_5 * t152);
        let t214 = t26.mul_add(t209, sin_q_3.mul_add(t213, t212));
        let t215 = t211.neg_mul_add(t69, t214);
        let t216 = t77 * t215;
        let t217 = t211.mul_add(t79, t34.neg_mul_add(t209, cos_q_5 * t161));
        let t218 = t82.mul_add(t216, t217);
        let t219 = t87 * t218;
        let t220 = sin_q_5.mul_add(t165, cos_q_5 * t166);
        let t221 = t211.mul_add(t89, t21.neg_mul_add(t209, t220));
        let t222 = t93.mul_add(t219, t91.neg_mul_add(t216, t221));
        let t223 = t97 * t222;
        let t224 = t211.neg_mul_add(t113, t209 * t107);
        let t225 = t219.mul_add(t122, t216.neg_mul_add(t117, t224));
        let t226 = t223.mul_add(t128, t225);
        let t227 = t132 * t226;
        let t228 = t219.neg_mul_add(t138, t216.mul_add(t136, t211 * t134));
        let t229 = t144.mul_add(t227, t223.mul_add(t141, t228));
        let t230 = t149 * t229;
        let t231 = t211.neg_mul_add(t154, t209 * t150);
        let t232 = t219.neg_mul_add(t163, t216.neg_mul_add(t158, t231));
        let t233 = t172.neg_mul_add(t227, t223.mul_add(t169, t232));
        let t234 = t175.mul_add(t230, t233);
        let t235 = t180 * t234;
        let t236 = t219.neg_mul_add(t187, t216.mul_add(t184, t182 * t211));
        let t237 = t194.mul_add(t227, t223.mul_add(t191, t236));
        let t238 = t201.mul_add(t235, t197.neg_mul_add(t230, t237));
        let t239 = t207 * t238;
        let t240 = sin_q_2 * q_1_dot;
        let t241 = n(p.l) * q_1_dot;
        let t242 = t240.mul_add(t240, q_2_dot * q_2_dot);
        let t243 = n(p.l).mul_add(t242, t240.mul_add(t241, cos_q_2 * n(p.g)));
        let t244 = cos_q_2 * q_2_dot;
        let t245 = q_1_dot * t244;
        let t246 = t245 * n(p.k16);
        let t247 = cos_q_3.mul_sub(t243, sin_q_3 * t246);
        let t248 = cos_q_2 * q_1_dot;
        let t249 = sin_q_3.neg_mul_add(t248, cos_q_3 * q_2_dot);
        let t250 = t2.mul_add(q_1_dot, sin_q_3 * q_2_dot);
        let t251 = t249 * t250;
        let t252 = t245 - t251;
        let t253 = n(p.l).neg_mul_add(t252, t247);
        let t254 = t240 + q_3_dot;
        let t255 = cos_q_4.mul_sub(t254, sin_q_4 * t249);
        let t256 = q_2_dot * t240;
        let t257 = sin_q_3.mul_sub(t256, q_3_dot * t250);
        let t258 = cos_q_4.mul_add(t257, sin_q_4 * t245);
        let t259 = t255.mul_add(q_4_dot, t258);
        let t260 = q_4_dot + t250;
        let t261 = t255 * t260;
        let t262 = t259 + t261;
        let t263 = t250.mul_add(t250, t254 * t254);
        let t264 = cos_q_3.mul_add(t246, sin_q_3 * t243);
        let t265 = n(p.l).mul_add(t263, t264);
        let t266 = t248.neg_mul_add(t241, sin_q_2 * n(p.g));
        let t267 = t248 * t240;
        let t268 = n(p.l).neg_mul_add(t267, t266);
        let t269 = cos_q_3.mul_sub(t256, t249 * q_3_dot);
        let t270 = t249 * t254;
        let t271 = t269 - t270;
        let t272 = n(p.l).neg_mul_add(t271, t268);
        let t273 = sin_q_4.mul_add(t254, cos_q_4 * t249);
        let t274 = t273.mul_add(t273, t260 * t260);
        let t275 = sin_q_4.mul_add(t265, cos_q_4 * t272);
        let t276 = sin_q_5 * n(p.l).neg_mul_add(t262, t253);
        let t277 = sin_q_5.neg_mul_add(t255, cos_q_5 * t260);
        let t278 = cos_q_5.mul_add(t255, sin_q_5 * t260);
        let t279 = t277 * t278;
        let t280 = cos_q_5.mul_add(n(p.l).mul_add(t274, t275), t276);
        let t281 = n(p.k3).mul_sub(t259, n(p.k5) * t279);
        let t282 = n(p.k25).neg_mul_add(t280, t281);
        let t283 = t259 - t279;
        let t284 = t273 + q_5_dot;
        let t285 = t284.mul_add(t284, t278 * t278);
        let t286 = sin_q_5.mul_add(t283, cos_q_5 * t285);
        let t287 = n(p.k7).mul_add(t259, n(p.k6) * t261);
        let t288 = n(p.k28).mul_add(t286, n(p.k23).neg_mul_add(t253, t287));
        let t289 = t282 + t288;
        let t290 = n(p.k25).mul_add(t286, n(p.k23) * t262);
        let t291 = n(p.k9).neg_mul_add(t251, n(p.k8) * t245);
        let t292 = n(p.l).mul_add(t290, n(p.k21).neg_mul_add(t247, t291));
        let t293 = cos_q_4.mul_sub(t265, sin_q_4 * t272);
        let t294 = t255 * t273;
        let t295 = t269 + t294;
        let t296 = sin_q_4.neg_mul_add(t257, cos_q_4 * t245);
        let t297 = q_4_dot.neg_mul_add(t273, t296);
        let t298 = cos_q_5.mul_sub(t297, sin_q_5 * t269);
        let t299 = t277.mul_add(q_5_dot, t298);
        let t300 = t277 * t284;
        let t301 = n(p.k5).mul_add(t299, n(p.k3) * t300);
        let t302 = n(p.k25).neg_mul_add(n(p.l).mul_add(t295, t293), t301);
        let t303 = t278 * (t284 * n(p.k24));
        let t304 = sin_q_5.neg_mul_add(t303, t273 * (t260 * n(p.k22)));
        let t305 = cos_q_5.neg_mul_add(t302, t304);
        let t306 = cos_q_4.neg_mul_add(t305, sin_q_4.mul_add(t289, t292));
        let t307 = sin_q_5.mul_sub(t285, cos_q_5 * t283);
        let t308 = n(p.k25).mul_add(t307, n(p.k23) * t274);
        let t309 = t300 + t299;
        let t310 = n(p.k25).neg_mul_add(t309, n(p.k23) * t295);
        let t311 = sin_q_4.mul_add(t308, n(p.k21) * t263);
        let t312 = sin_q_3 * n(p.k21).mul_add(t252, t290);
        let t313 = cos_q_3.mul_add(cos_q_4.mul_add(t310, t311), t312);
        let t314 = sin_q_4.neg_mul_add(t305, t250 * (t254 * n(p.k20)));
        let t315 = cos_q_4.neg_mul_add(t289, t314);
        let t316 = n(p.k7).mul_add(t294, n(p.k6) * t269);
        let t317 = cos_q_5.mul_add(t303, n(p.k23).mul_add(t293, t316));
        let t318 = n(p.k28).neg_mul_add(t309, t317);
        let t319 = sin_q_5.neg_mul_add(t302, t318);
        let t320 = n(p.k9).mul_sub(t269, n(p.k8) * t270);
        let t321 = cos_q_4.mul_sub(t308, sin_q_4 * t310);
        let t322 = t319 + n(p.k21).neg_mul_add(t268, t320);
        let t323 = n(p.l).neg_mul_add(t321, t322);
        let t324 = cos_q_3.mul_add(t323, t256 * n(p.k18));
        let t325 = n(p.l) * t245.mul_add(n(p.k31), t313);
        let t326 = cos_q_2.mul_add(sin_q_3.mul_sub(t315, t324), t325);
        let t327 = n(p.l).mul_add(t313, t245.mul_add(n(p.k17), t306));
        let t328 = sin_q_2.mul_add(t327, t326);
        let t329 = n(p.k19).mul_sub(t266, n(p.k11) * t267);
        let t330 = n(p.l).mul_add(n(p.k21).neg_mul_add(t271, t321), t329);
        let t331 = cos_q_3.neg_mul_add(t315, sin_q_3.neg_mul_add(t323, t330));
        let t332 = t45.mul_add(t328, t331);
        let t333 = t70.neg_mul_add(t332, t67.neg_mul_add(t328, t306));
        let t334 = t80.mul_add(t332, t78.mul_add(t328, t319));
        let t335 = t83.mul_add(t333, t334);
        let t336 = sin_q_1 * q_1_dot;
        let t337 = t240 * t336;
        let t338 = sin_q_3 * t244;
        let t339 = cos_q_1 * q_1_dot;
        let t340 = t338 * t339;
        let t341 = cos_q_3 * q_3_dot;
        let t342 = cos_q_1 * t240;
        let t343 = t341 * t342;
        let t344 = sin_q_1 * t244;
        let t345 = t341 * t344;
        let t346 = sin_q_2 * q_2_dot;
        let t347 = q_2_dot * t346;
        let t348 = sin_q_1 * t347;
        let t349 = sin_q_3.neg_mul_add(t348, t345 + t340);
        let t350 = sin_q_3 * q_3_dot;
        let t351 = q_3_dot * t350;
        let t352 = sin_q_3.mul_sub(t337, t340) - t343 - t349;
        let t353 = t350 * t336;
        let t354 = q_1_dot * t339;
        let t355 = q_3_dot * t341;
        let t356 = cos_q_1.neg_mul_add(t355, t353);
        let t357 = t352 - t152.neg_mul_add(t351, t345 + t343);
        let t358 = cos_q_3.mul_sub(t354, t353) - t356 - t357;
        let t359 = sin_q_2.mul_add(t341, t338);
        let t360 = cos_q_1.mul_add(t350, cos_q_3 * t336);
        let t361 = sin_q_1.mul_add(t359, sin_q_3 * t342) + t360;
        let t362 = cos_q_4 * q_4_dot;
        let t363 = t362 * t361;
        let t364 = sin_q_4 * q_4_dot;
        let t365 = q_4_dot * t364;
        let t366 = cos_q_4 * cos_q_1;
        let t367 = t256 * t366;
        let t368 = cos_q_4 * sin_q_1;
        let t369 = q_2_dot * t244;
        let t370 = t346 * t364;
        let t371 = sin_q_1 * t370;
        let t372 = q_1_dot * t336;
        let t373 = t0 * q_4_dot;
        let t374 = t339 * t373;
        let t375 = t368.mul_add(t369, t367) - t371;
        let t376 = t11 * q_4_dot;
        let t377 = q_4_dot * t376;
        let t378 = t375 + (t374 + t11.mul_add(t372, t367));
        let t379 = t160.mul_add(t365, t363) + sin_q_4.mul_add(t358, t363);
        let t380 = t379 + (sin_q_1.mul_add(t377, t374 - t371) + t378);
        let t381 = t244 * t339;
        let t382 = cos_q_4.mul_add(t346, t373);
        let t383 = sin_q_1.neg_mul_add(t382, t11 * t339);
        let t384 = t383 - sin_q_4.mul_sub(t361, t160 * t362);
        let t385 = cos_q_5 * q_5_dot;
        let t386 = t385 * t384;
        let t387 = sin_q_5 * q_5_dot;
        let t388 = q_5_dot * t387;
        let t389 = sin_q_5.neg_mul_add(t380, t386);
        let t390 = t350 * t344;
        let t391 = t350 * t342;
        let t392 = cos_q_3 * t244;
        let t393 = t339 * t392;
        let t394 = cos_q_3.mul_add(t337, t391) - t393;
        let t395 = cos_q_3.neg_mul_add(t348, t393 - t390);
        let t396 = t341 * t336;
        let t397 = cos_q_1.mul_add(t351, t396) + sin_q_3.mul_add(t354, t396);
        let t398 = t397 + (t152.mul_add(t355, t390 + t391) + t394 - t395);
        let t399 = sin_q_2 * t350;
        let t400 = sin_q_1.mul_add(t392 - t399, cos_q_3 * t342);
        let t401 = t400 - sin_q_3.mul_sub(t336, cos_q_1 * t341);
        let t402 = t387 * t401;
        let t403 = q_5_dot * t385;
        let t404 = t166.mul_add(t403, t402) + cos_q_5.mul_add(t398, t402);
        let t405 = t372 + (t337 - t381 - (t381 - t348)) - t358 - t380;
        let t406 = t405 - (t404 - (t165.neg_mul_add(t388, t386) + t389));
        let t407 = t155.mul_add(t332, t151.mul_add(t328, n(p.l) * t406));
        let t408 = t90.mul_add(t332, t88.mul_add(t328, t282));
        let t409 = t94.mul_add(t335, t92.neg_mul_add(t333, t408));
        let t410 = t164.mul_add(t335, t159.mul_add(t333, t407));
        let t411 = t338 * t336;
        let t412 = cos_q_1 * t244;
        let t413 = t341 * t412;
        let t414 = cos_q_1 * t347;
        let t415 = t240 * t339;
        let t416 = sin_q_1 * t240;
        let t417 = t341 * t416;
        let t418 = t417 + sin_q_3.mul_add(t415, t411);
        let t419 = sin_q_3.mul_add(t414, t411 - t413) + t418;
        let t420 = t350 * t339;
        let t421 = sin_q_1.mul_add(t355, t420) + cos_q_3.mul_add(t372, t420);
        let t422 = t110.mul_add(t351, t417) - t413 + t419 + t421;
        let t423 = cos_q_1.neg_mul_add(t359, sin_q_3 * t416);
        let t424 = cos_q_3.mul_sub(t339, sin_q_1 * t350) - t423;
        let t425 = t362 * t424;
        let t426 = sin_q_4.neg_mul_add(t422, t425);
        let t427 = t256 * t368;
        let t428 = t373 * t336;
        let t429 = cos_q_1 * t370;
        let t430 = t366.neg_mul_add(t369, t429 + t427);
        let t431 = cos_q_1.neg_mul_add(t377, t429 + t428);
        let t432 = t11.mul_sub(t354, t427) - t428 - t430 - t431;
        let t433 = t119.neg_mul_add(t365, t425) + t426 + t432;
        let t434 = sin_q_4.mul_add(t424, t119 * t362);
        let t435 = t385 * (t434 + cos_q_1.mul_add(t382, t11 * t336));
        let t436 = t350 * t412;
        let t437 = t336 * t392;
        let t438 = t416 * t350;
        let t439 = cos_q_3.mul_add(t415, t437) - t438;
        let t440 = cos_q_3.mul_add(t414, t436 + t437) + t439;
        let t441 = t341 * t339;
        let t442 = sin_q_1.neg_mul_add(t351, t441);
        let t443 = t440 - t110.neg_mul_add(t355, t438 - t436);
        let t444 = cos_q_1.mul_add(t399 - t392, cos_q_3 * t416);
        let t445 = t387 * (sin_q_1.mul_add(t341, sin_q_3 * t339) + t444);
        let t446 = t443 - (sin_q_3.mul_sub(t372, t441) - t442);
        let t447 = cos_q_5.neg_mul_add(t446, t445);
        let t448 = t124.mul_add(t388, t435) + sin_q_5.mul_add(t433, t435);
        let t449 = t244 * t336;
        let t450 = t422 + (t354 + (t414 + t449 + (t415 + t449))) - t433;
        let t451 = t125.neg_mul_add(t403, t445) + t447 - t448 + t450;
        let t452 = t114.mul_add(t332, t108.mul_add(t328, n(p.l) * t451));
        let t453 = t123.neg_mul_add(t335, t118.mul_add(t333, t452));
        let t454 = t129.neg_mul_add(t409, t453);
        let t455 = sin_q_4 * t341;
        let t456 = t346 * t455;
        let t457 = t341 * t376;
        let t458 = sin_q_3 * t362;
        let t459 = t346 * t458;
        let t460 = t459 + t133.mul_add(t369, t456);
        let t461 = t373.mul_add(sin_q_3 * q_4_dot, t459) - t457;
        let t462 = t244 * t364;
        let t463 = t362.mul_add(sin_q_2 * q_4_dot, t462);
        let t464 = t461 + (t0.mul_add(t351, t456) - t457 + t460);
        let t465 = t464 + (t463 + cos_q_4.mul_add(t347, t462));
        let t466 = cos_q_2.neg_mul_add(t458 + t455, t133 * t346);
        let t467 = cos_q_4.mul_sub(t244, sin_q_2 * t364) - t466;
        let t468 = t385 * t467;
        let t469 = sin_q_5.neg_mul_add(t465, t468);
        let t470 = t350 * t346;
        let t471 = cos_q_5 * t470;
        let t472 = t387 * (cos_q_3 * t346);
        let t473 = cos_q_2 * t350;
        let t474 = t387 * t473;
        let t475 = cos_q_2 * t355;
        let t476 = cos_q_5.neg_mul_add(t475, t474 + t471);
        let t477 = t189.neg_mul_add(q_5_dot * q_5_dot, t474 + t472);
        let t478 = t18.mul_sub(t369, t471) - t472 - t476 - t477;
        let t479 = t341 * t346;
        let t480 = cos_q_2.mul_add(t351, t479) + sin_q_3.mul_add(t369, t479);
        let t481 = t1.neg_mul_add(t388, t468) + t469 + t478;
        let t482 = t135.mul_add(t332, n(p.l) * (t465 + (t369 + t480) - t481));
        let t483 = t139.neg_mul_add(t335, t137.mul_add(t333, t482));
        let t484 = t145.neg_mul_add(t454, t142.mul_add(t409, t483));
        let t485 = t173.neg_mul_add(t454, t170.neg_mul_add(t409, t410));
        let t486 = t176.neg_mul_add(t484, t485);
        let t487 = t385 * t473;
        let t488 = t346 * (t18 * q_5_dot);
        let t489 = sin_q_5 * t470;
        let t490 = t57.mul_add(t369, t488) - t489;
        let t491 = sin_q_5.neg_mul_add(t475, t489 - t487);
        let t492 = t387 * t467;
        let t493 = t1.mul_add(t403, t492) + cos_q_5.mul_add(t465, t492);
        let t494 = t2.mul_add(t388, t487 + t488) + t490 - t491 + t493;
        let t495 = t185.mul_add(t333, t183.mul_add(t332, t494));
        let t496 = t192.mul_add(t409, t188.neg_mul_add(t335, t495));
        let t497 = t198.neg_mul_add(t484, t195.neg_mul_add(t454, t496));
        let t498 = t202.neg_mul_add(t486, t497);
        let t499 = t387 * t384;
        let t500 = t385 * t401;
        let t501 = sin_q_5.neg_mul_add(t398, t500);
        let t502 = t165.mul_add(t403, t499) + cos_q_5.mul_add(t380, t499);
        let t503 = t166.neg_mul_add(t388, t500) + t501 + t502;
        let t504 = t211.neg_mul_add(t332, t209.mul_add(t328, t503));
        let t505 = t219.neg_mul_add(t335, t216.neg_mul_add(t333, t504));
        let t506 = t227.neg_mul_add(t454, t223.neg_mul_add(t409, t505));
        let t507 = t235.neg_mul_add(t486, t230.mul_add(t484, t506));
        let t508 = t222.mul_add(t223, t210.mul_add(t211, t208 * t209));
        let t509 = t508 + t218.mul_add(t219, t215 * t216);
        let t510 = t229.neg_mul_add(t230, t226.neg_mul_add(t227, t509));
        let t511 = t238.neg_mul_add(t239, t234.neg_mul_add(t235, t510));
        let t512 = t239.mul_add(t498, t507) / t511;
        let lambda4 = t239.mul_add(t512, t207 * t498);
        let t513 = t227.neg_mul_add(t512, t132 * t454);
        let t514 = t235.neg_mul_add(t512, t180 * t486);
        let t515 = t202 * lambda4;
        let t516 = t514 - t515;
        let t517 = t198.neg_mul_add(lambda4, t230.mul_add(t512, t149 * t484));
        let t518 = t176 * t516;
        let t519 = t173.neg_mul_add(t516, t195.neg_mul_add(lambda4, t513));
        let lambda1 = t145.neg_mul_add(t517 - t518, t519);
        let lambda2 = t518 - t517;
        let lambda3 = t515 - t514;
        let lambda5 = -t512;
        let sound = PIVOTS.hold(t41, t41)
            & PIVOTS.hold(t65, t64)
            & PIVOTS.hold(t76, t75)
            & PIVOTS.hold(t86, t84)
            & PIVOTS.hold(t96, n(p.k3))
            & PIVOTS.hold(t131, t131)
            & PIVOTS.hold(t148, t147)
            & PIVOTS.hold(t179, t178)
            & PIVOTS.hold(t206, t204)
            & PIVOTS.hold(t511, t509)
            & lambda1.is_finite();
        if !sound {
            let pivots = [
                (0, t41, t41),
                (1, t65, t64),
                (2, t76, t75),
                (3, t86, t84),
                (4, t96, n(p.k3)),
                (5, t131, t131),
                (6, t148, t147),
                (7, t179, t178),
                (8, t206, t204),
                (9, t511, t509),
            ];
            PIVOTS.check(pivots)?;
        }
        let multipliers = [
            lambda1.store(),
            lambda2.store(),
            lambda3.store(),
            lambda4.store(),
            lambda5.store(),
        ];
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
    let (sin_q_4, cos_q_4) = q_4.sin_cos();
    let (sin_q_5, cos_q_5) = q_5.sin_cos();
    let t0 = q_2_dot * q_2_dot;
    let t1 = cos_q_2 * q_1_dot;
    let t2 = sin_q_2 * q_1_dot;
    let t3 = sin_q_3 * q_2_dot + cos_q_3 * t1;
    let t4 = q_1_dot + t2;
    let t5 = cos_q_3 * q_2_dot - sin_q_3 * t1;
    let t6 = t2 + q_3_dot;
    let t7 = t2 * p.k1 + q_1_dot * p.l;
    let t8 = q_2_dot + t3;
    let t9 = t3 + q_4_dot;
    let t10 = t4 * sin_q_3;
    let t11 = t4 * cos_q_3;
    let t12 = t3 * p.k1 + q_2_dot * p.l;
    let t13 = cos_q_4 * t6 - sin_q_4 * t5;
    let t14 = sin_q_4 * t6 + cos_q_4 * t5;
    let t15 = t6 + t10;
    let t16 = t11 * cos_q_4 - sin_q_4 * t8;
    let t17 = sin_q_5 * t9 + cos_q_5 * t13;
    let t18 = t14 + t15;
    let t19 = t11 * sin_q_4 + cos_q_4 * t8;
    let t20 = t14 * p.k1 + t15 * p.l;
    let t21 = t14 + q_5_dot;
    let t22 = p.l * (t16 - t9) - t17 * p.k1;
    let t23 = t19 * sin_q_5 + cos_q_5 * t18;
    let t24 = t6 * p.k1 + t10 * p.l;
    let t25 = cos_q_5 * t9 - sin_q_5 * t13;
    let t26 = p.l * t16 - t9 * p.k1;
    let t27 = t1 * (t1 * p.k4) + (p.k2 * t0 + t2 * (t2 * p.k2));
    let t28 = p.l * (t19 * cos_q_5 - sin_q_5 * t18) - p.k1 * t21;
    let t29 = t5 * (t5 * p.k4) + (t3 * (t3 * p.k2) + t6 * (t6 * p.k2));
    let t30 = S::from_f64(0.5) * (p.m * (t0 * p.k13 + t7 * t7) + t27);
    let t31 = t14 * (t14 * p.k2) + (t9 * (t9 * p.k2) + t13 * (t13 * p.k4));
    let t32 = p.m * (t24 * t24 + (t11 * (t11 * p.k0) + t12 * t12)) + t29;
    let t33 = t25 * (t25 * p.k4) + (t21 * (t21 * p.k2) + t17 * (t17 * p.k2));
    let t34 = p.m * (t26 * t26 + (t19 * (t19 * p.k0) + t20 * t20)) + t31;
    let t35 = S::from_f64(0.5) * t32 + (t30 + q_1_dot * (q_1_dot * p.k26));
    let t36 = p.m * (t28 * t28 + (t23 * (t23 * p.k0) + t22 * t22)) + t33;
    S::from_f64(0.5) * t36 + (S::from_f64(0.5) * t34 + t35)
}

/// Potential energy `V`, in J.
///
/// ```text
/// V = 1/2*l*m*g*cos(q[2])*cos(q[3])*cos(q[5]) - 1/2*l*m*g*cos(q[2])*sin(q[3])*sin(q[4])*sin(q[5])
///     - 3/2*l*m*g*cos(q[2])*sin(q[3])*sin(q[4]) - 5/2*l*m*g*cos(q[2])*sin(q[3])
///     - 7/2*l*m*g*cos(q[2]) - 1/2*l*m*g*sin(q[2])*cos(q[4])*sin(q[5])
///     - 3/2*l*m*g*sin(q[2])*cos(q[4])
/// ```
pub fn potential_energy<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 5]) -> S {
    let q_2 = q[1];
    let q_3 = q[2];
    let q_4 = q[3];
    let q_5 = q[4];
    let (sin_q_3, cos_q_3) = q_3.sin_cos();
    let (sin_q_2, cos_q_2) = q_2.sin_cos();
    let (sin_q_4, cos_q_4) = q_4.sin_cos();
    let (sin_q_5, cos_q_5) = q_5.sin_cos();
    let t0 = sin_q_3 * cos_q_2;
    let t1 = cos_q_2 + t0;
    let t2 = t0 * sin_q_4 + sin_q_2 * cos_q_4;
    let t3 = p.k14 * (p.k1 * t0 + cos_q_2 * p.l) + cos_q_2 * p.k15;
    let t4 = p.l * (t2 + t1) - p.k1 * (cos_q_5 * (cos_q_3 * cos_q_2) - t2 * sin_q_5);
    -(p.k14 * t4 + (p.k14 * (p.k1 * t2 + p.l * t1) + t3))
}

/// `x3`. Unit: `m`.
///
/// ```text
/// x3 = l*cos(q[1])*sin(q[2])*sin(q[3]) + l*cos(q[1])*sin(q[2]) + l*cos(q[1])
///     + l*sin(q[1])*cos(q[3])
/// ```
pub fn output_x3<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 5]) -> S {
    let q_1 = q[0];
    let q_2 = q[1];
    let q_3 = q[2];
    let sin_q_2 = q_2.sin();
    let (sin_q_1, cos_q_1) = q_1.sin_cos();
    let (sin_q_3, cos_q_3) = q_3.sin_cos();
    let t0 = sin_q_2 * cos_q_1;
    (t0 * sin_q_3 + sin_q_1 * cos_q_3 + (cos_q_1 + t0)) * p.l
}

/// `y3`. Unit: `m`.
///
/// ```text
/// y3 = -l*cos(q[2])*sin(q[3]) - l*cos(q[2])
/// ```
pub fn output_y3<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 5]) -> S {
    let q_2 = q[1];
    let q_3 = q[2];
    let sin_q_3 = q_3.sin();
    let cos_q_2 = q_2.cos();
    p.k35 * (cos_q_2 + sin_q_3 * cos_q_2)
}

/// `z3`. Unit: `m`.
///
/// ```text
/// z3 = l*cos(q[1])*cos(q[3]) - l*sin(q[1])*sin(q[2])*sin(q[3]) - l*sin(q[1])*sin(q[2])
///     - l*sin(q[1])
/// ```
pub fn output_z3<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 5]) -> S {
    let q_1 = q[0];
    let q_2 = q[1];
    let q_3 = q[2];
    let (sin_q_1, cos_q_1) = q_1.sin_cos();
    let (sin_q_3, cos_q_3) = q_3.sin_cos();
    let sin_q_2 = q_2.sin();
    let t0 = sin_q_2 * sin_q_1;
    p.k35 * (sin_q_1 + t0 - (cos_q_1 * cos_q_3 - t0 * sin_q_3))
}

/// Everything that the description asks to observe.
pub fn outputs<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 5]) -> Outputs<S> {
    Outputs {
        x3: output_x3(p, q),
        y3: output_y3(p, q),
        z3: output_z3(p, q),
    }
}

::lagrangian::emitted::implement! {
    machine Bricard "Bricard" over S, R;
    parameters { l, w, m, g } [
        l: "l" "m" = 1.0;
        w: "w" "m" = 0.1;
        m: "m" "kg" = 1.0;
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
    outputs Outputs { x3, y3, z3 } [
        x3: "x3" "m";
        y3: "y3" "m";
        z3: "z3" "m";
    ]
    prepared Prepared {
        l, m, g, k0, k1, k2, k3, k4, k5, k6, k7, k8, k9, k10, k11, k12, k13, k14, k15, k16, k17,
        k18, k19, k20, k21, k22, k23, k24, k25, k26, k27, k28, k29, k30, k31, k32, k33, k34, k35,
    }
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
        outputs outputs(p, t, q, v, a, u) = outputs(p, q);
        constraints constraints(p) = [
            ("along", "m", "N", true),
            ("up", "m", "N", true),
            ("across", "m", "N", true),
            ("tips", "1", "N*m", true),
            ("turns", "1", "N*m", true),
        ];
        solved multipliers(p, t, q, v, u) = multipliers(p, q, v);
        workspace with_workspace(p) = ::lagrangian::emitted::constraint_workspace(5, 5);
    }
    absent [MAY_SLIDE MAY_COLLIDE]
    intervals []
    lanes [N]
    numbers []
}
