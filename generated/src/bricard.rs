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
//! | `constraint_rates` | 98 | 63 | 0 | 5 | 0 | 171 |
//! | `constraint_matrix` | 96 | 48 | 0 | 5 | 0 | 154 |
//! | `constraint_bias` | 205 | 185 | 0 | 5 | 0 | 400 |
//! | `accelerations` | 806 | 603 | 10 | 5 | 0 | 1429 |
//! | `multipliers` | 768 | 569 | 10 | 5 | 0 | 1357 |
//! | `projection` | 595 | 432 | 10 | 5 | 0 | 1047 |
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
        let l_squared = self.l * self.l;
        let t0 = self.w * self.w;
        let t1 = self.l * self.m;
        let t2 = l_squared + t0;
        let t3 = self.m * t0;
        let t4 = self.l * t1;
        let t5 = self.g * t1;
        let k0 = t2 * (self.m * S::from_ratio(1, 12));
        let k2 = t3 * S::from_ratio(1, 6);
        let t6 = t3 * S::from_ratio(1, 3);
        let t7 = t4 * S::from_f64(2.0);
        let t8 = S::from_f64(0.5) * t3;
        let t9 = t4 * S::from_f64(3.0);
        let t10 = t3 * S::from_ratio(2, 3);
        let k1 = k0 + t4 * S::from_f64(0.25);
        let k3 = k1 - k2;
        let k4 = k1 + (t4 + k2);
        let k6 = k1 + (t6 + t7);
        let k8 = k1 + (t8 + t9);
        let k5 = t4 + k1 - t6;
        let k7 = k1 + t7 - t8;
        let k9 = k1 + t9 - t10;
        let half_l = self.l * S::from_f64(0.5);
        let k10 = k1 + (t10 + t4 * S::from_f64(4.0));
        let quarter_l_squared = l_squared * S::from_f64(0.25);
        let m_g = self.m * self.g;
        let half_l_m_g = S::from_f64(0.5) * t5;
        let two_l = self.l * S::from_f64(2.0);
        let k11 = k8 + k9;
        let k12 = k8 - k9;
        let k13 = t1 * S::from_f64(3.5);
        let k14 = k6 - k7;
        let k15 = t1 * S::from_f64(2.5);
        let k16 = k4 - k5;
        let k17 = t1 * S::from_f64(1.5);
        let k18 = k1 - k3;
        let half_l_m = S::from_f64(0.5) * t1;
        let k19 = (t2 + l_squared * S::from_f64(3.0)) * (self.m * S::from_ratio(1, 24));
        let k20 = t4 * S::from_f64(3.5);
        let half_l_squared_m = S::from_f64(0.5) * t4;
        let k21 = t4 * S::from_f64(2.5);
        let k22 = t4 * S::from_f64(1.5);
        let k23 = t1 * S::from_f64(7.0);
        let k24 = t5 * S::from_f64(1.5);
        let k25 = t5 * S::from_f64(2.5);
        let k26 = t5 * S::from_f64(3.5);
        let minus_l = -self.l;
        Prepared {
            l: self.l,
            m: self.m,
            g: self.g,
            l_squared,
            half_l,
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
            quarter_l_squared,
            m_g,
            half_l_m_g,
            two_l,
            k11,
            k12,
            k13,
            k14,
            k15,
            k16,
            k17,
            k18,
            half_l_m,
            k19,
            k20,
            half_l_squared_m,
            k21,
            k22,
            k23,
            k24,
            k25,
            k26,
            minus_l,
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
    l_squared: S,
    /// `0.5*l`
    half_l: S,
    /// `(1/12)*m*(w^2 + l^2)`
    k0: S,
    /// `(1/12)*m*(w^2 + l^2) + 0.25*l^2*m`
    k1: S,
    /// `(1/6)*w^2*m`
    k2: S,
    /// `(1/12)*m*(w^2 + l^2) + 0.25*l^2*m - (1/6)*w^2*m`
    k3: S,
    /// `(1/12)*m*(w^2 + l^2) + 0.25*l^2*m + l^2*m + (1/6)*w^2*m`
    k4: S,
    /// `l^2*m + (1/12)*m*(w^2 + l^2) + 0.25*l^2*m - (1/3)*w^2*m`
    k5: S,
    /// `(1/12)*m*(w^2 + l^2) + 0.25*l^2*m + (1/3)*w^2*m + 2*l^2*m`
    k6: S,
    /// `(1/12)*m*(w^2 + l^2) + 0.25*l^2*m + 2*l^2*m - 0.5*w^2*m`
    k7: S,
    /// `(1/12)*m*(w^2 + l^2) + 0.25*l^2*m + 0.5*w^2*m + 3*l^2*m`
    k8: S,
    /// `(1/12)*m*(w^2 + l^2) + 0.25*l^2*m + 3*l^2*m - (2/3)*w^2*m`
    k9: S,
    /// `(1/12)*m*(w^2 + l^2) + 0.25*l^2*m + (2/3)*w^2*m + 4*l^2*m`
    k10: S,
    /// `0.25*l^2`
    quarter_l_squared: S,
    /// `m*g`
    m_g: S,
    /// `0.5*l*m*g`
    half_l_m_g: S,
    /// `2*l`
    two_l: S,
    /// `(1/12)*m*(w^2 + l^2) + 0.25*l^2*m + 0.5*w^2*m + 3*l^2*m + (1/12)*m*(w^2 + l^2) + 0.25*l^2*m
    /// + 3*l^2*…`
    k11: S,
    /// `(1/12)*m*(w^2 + l^2) + 0.25*l^2*m + 0.5*w^2*m + 3*l^2*m - ((1/12)*m*(w^2 + l^2) +
    /// 0.25*l^2*m + 3*l^2…`
    k12: S,
    /// `3.5*l*m`
    k13: S,
    /// `(1/12)*m*(w^2 + l^2) + 0.25*l^2*m + (1/3)*w^2*m + 2*l^2*m - ((1/12)*m*(w^2 + l^2) +
    /// 0.25*l^2*m + 2*l…`
    k14: S,
    /// `2.5*l*m`
    k15: S,
    /// `(1/12)*m*(w^2 + l^2) + 0.25*l^2*m + l^2*m + (1/6)*w^2*m - (l^2*m + (1/12)*m*(w^2 + l^2)
    /// + 0.25*l^2*m…`
    k16: S,
    /// `1.5*l*m`
    k17: S,
    /// `(1/12)*m*(w^2 + l^2) + 0.25*l^2*m - ((1/12)*m*(w^2 + l^2) + 0.25*l^2*m - (1/6)*w^2*m)`
    k18: S,
    /// `0.5*l*m`
    half_l_m: S,
    /// `(1/24)*m*(w^2 + l^2 + 3*l^2)`
    k19: S,
    /// `3.5*l^2*m`
    k20: S,
    /// `0.5*l^2*m`
    half_l_squared_m: S,
    /// `2.5*l^2*m`
    k21: S,
    /// `1.5*l^2*m`
    k22: S,
    /// `7*l*m`
    k23: S,
    /// `1.5*l*m*g`
    k24: S,
    /// `2.5*l*m*g`
    k25: S,
    /// `3.5*l*m*g`
    k26: S,
    /// `-l`
    minus_l: S,
}

/// A pivot of an elimination that is not above this share of its diagonal element may be rounding
/// errors alone.
const PIVOTS: ::lagrangian::emitted::Pivots = ::lagrangian::emitted::Pivots::new(5, 10);

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
    let t4 = p.half_l_m * sin_q_5;
    let t5 = p.l + t0;
    let t6 = cos_q_4 * t2 - sin_q_2 * sin_q_4;
    let t7 = p.k17 + t4;
    let t8 = t0 + sin_q_3 * t5;
    let t9 = p.l * sin_q_3;
    let t10 = sin_q_5 * t3 + cos_q_5 * (sin_q_4 * t2 + sin_q_2 * cos_q_4);
    let t11 = cos_q_4 * cos_q_5;
    let t12 = cos_q_3 * (cos_q_4 * t5 - sin_q_4 * t1);
    let t13 = sin_q_3 * p.k15;
    let t14 = t6 * t7;
    let t15 = (cos_q_4 * t1 + sin_q_4 * t5) * (cos_q_3 * cos_q_5);
    let t16 = sin_q_5 * p.half_l_squared_m;
    let t17 = p.half_l_m * t6;
    let t18 = sin_q_4 * cos_q_5;
    let t19 = p.l + t9;
    let t20 = t10 * p.k3 - p.half_l_m * (t12 - p.l * t3);
    let t21 = p.half_l_m * (t15 - sin_q_5 * (t8 - p.l * t6)) + t6 * p.k1;
    let t22 = t3 * p.k17 + p.half_l_m * t10;
    let t23 = sin_q_4 * t19;
    let t24 = cos_q_3 * t18 - sin_q_3 * sin_q_5;
    let t25 = cos_q_3 * cos_q_4;
    let t26 = t21 + (t6 * t16 + (t6 * p.k5 - p.k17 * t8));
    let m41 = sin_q_5 * t20 + (t10 * p.half_l_squared_m + (t3 * p.k4 - p.k17 * t12));
    let t27 = (cos_q_5 * t19 - sin_q_5 * (p.l * cos_q_3)) * (p.half_l_m * cos_q_4);
    let t28 = p.k1 * t25;
    let t29 = cos_q_3 * (cos_q_4 * t22 - t17 * t18);
    let t30 = t29 + sin_q_3 * (t14 - sin_q_2 * p.k15);
    let t31 = t17 * t11 + sin_q_4 * t22;
    let t32 = cos_q_4 * t26 + t18 * t20;
    let t33 = p.half_l_m * (t9 + t23) - p.k3 * t24;
    let t34 = sin_q_4 * (sin_q_3 * p.k17 - p.half_l_m * t24);
    let t35 = t34 - t25 * (p.half_l_m * t11);
    let t36 = p.l * sin_q_4;
    let m31 = t11 * t20 + (t5 * t13 + sin_q_2 * p.k6 - p.l * t14) - sin_q_4 * t26;
    let t37 = p.l * t31 + (t3 * p.k7 + m41);
    let t38 = p.k17 * t23 + sin_q_3 * p.k4 - p.half_l_squared_m * t24;
    let m42 = sin_q_5 * t33 + t38;
    let t39 = t27 - t28 - t25 * (t16 + p.k5);
    let m53 = t4 * (p.l + t36) + sin_q_4 * p.k1;
    let t40 = p.half_l_squared_m + sin_q_5 * p.k3;
    let t41 = cos_q_2 * (cos_q_3 * t37 + sin_q_3 * t32);
    let t42 = sin_q_2 * (m31 + (sin_q_2 * p.k9 + p.k20) - p.l * t30);
    let t43 = p.l * (t13 + t35) + p.k8 - cos_q_3 * (cos_q_4 * t39 + t18 * t33);
    let t44 = sin_q_4 * (m53 + (sin_q_4 * t16 + (sin_q_4 * p.k5 + p.k22)));
    let m11 = t42 + (t41 + (p.k10 - p.l * (t30 - sin_q_2 * p.k13)));
    let m21 = sin_q_3 * t37 - (cos_q_3 * t32 - p.l * (t31 + t3 * p.k15));
    let m22 = sin_q_3 * (p.l * t35 + (m42 + (sin_q_3 * p.k7 + p.k21))) + t43;
    let m32 = t7 * (p.l * t25) + t11 * t33 - sin_q_4 * t39;
    let m33 = t44 + (t7 * t36 + (p.k6 + t11 * (t11 * p.k3)));
    let m43 = t11 * t40;
    let m44 = p.k4 + sin_q_5 * (p.half_l_squared_m + t40);
    let m51 = -t21;
    let m52 = t28 - t27;
    let zero = S::ZERO;
    [
        [m11, m21, m31, m41, m51],
        [m21, m22, m32, m42, m52],
        [m31, m32, m33, m43, m53],
        [m41, m42, m43, m44, zero],
        [m51, m52, m53, zero, p.k1],
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
    let t10 = t5 * p.two_l;
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
    let t44 = t21 * (t26 * p.k18);
    let t45 = t35 + t42;
    let t46 = t33 * (sin_q_5 * p.half_l_m) + p.k17 * t24;
    let t47 = t46 - t38 * (cos_q_5 * p.half_l_m);
    let t48 = t35 * p.k1 + t42 * p.k3 - p.half_l_m * (t39 + p.l * t40);
    let t49 = t43 * p.half_l_m + p.k17 * t36;
    let t50 = p.k17 * t40 - p.half_l_m * t45;
    let t51 = cos_q_5 * (sin_q_4 * t22 - cos_q_4 * t27 + p.l * t24);
    let t52 = cos_q_5 * t44 + (p.k17 * t39 + (t34 * p.k5 + t11 * p.k4));
    let t53 = t52 - t45 * p.half_l_squared_m;
    let t54 = sin_q_5 * t48;
    let t55 = t17 * (p.k15 * cos_q_3) + t47 * (cos_q_3 * sin_q_4);
    let t56 = p.half_l_m * (t51 - sin_q_5 * (t37 + p.l * t36));
    let h_q_5 = t28 * p.k1 - t32 * p.k3 - t56;
    let t57 = cos_q_5 * t48 + (sin_q_5 * t44 - t20 * (t9 * p.k16));
    let t58 = cos_q_4 * t47 - sin_q_4 * t50;
    let t59 = sin_q_3 * (p.k15 * t30 + t49) + (t50 * (cos_q_3 * cos_q_4) + t55);
    let t60 = t43 * p.half_l_squared_m + (p.k17 * t37 + (t29 * p.k4 + t28 * p.k5));
    let t61 = h_q_5 + t60;
    let t62 = cos_q_4 * t57 + (p.l * t49 + (p.k15 * t31 + (t5 * p.k6 - t23 * p.k7)));
    let h_q_3 = sin_q_4 * t61 + t62;
    let t63 = t53 - t54 + (t19 * p.k21 + (t11 * p.k7 - t12 * p.k6)) - p.l * t58;
    let t64 = t4 * (t7 * p.k14) + sin_q_4 * t57 - cos_q_4 * t61;
    let t65 = p.l * (t5 * p.k23 + t59) - t63 * (cos_q_2 * cos_q_3);
    let t66 = t59 * (p.l * sin_q_2) - t5 * (sin_q_2 * p.k12);
    let t67 = sin_q_3 * t63 + (t13 * p.k20 + t8 * p.k9 - p.l * (t58 - p.k15 * t18));
    let h_q_1 = t64 * (cos_q_2 * sin_q_3) + t66 + (sin_q_2 * (t5 * p.k11 + h_q_3) + t65);
    let h_q_2 = -(cos_q_3 * t64 + t67);
    let h_q_4 = t54 - t53;
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
    let t3 = p.half_l_m_g * t2;
    let t4 = sin_q_5 * t1 + cos_q_5 * (sin_q_4 * t0 + sin_q_2 * cos_q_4);
    let q_q_5 = p.half_l_m_g * t4;
    let t5 = t3 * cos_q_5;
    let q_q_4 = t3 * sin_q_5 + t2 * p.k24;
    let t6 = p.k24 * t1 + q_q_5;
    let t7 = sin_q_3 * (q_q_4 - sin_q_2 * p.k25) - sin_q_2 * p.k26;
    let zero = S::ZERO;
    let q_q_2 = cos_q_3 * (cos_q_4 * t6 - sin_q_4 * t5) + t7;
    let q_q_3 = sin_q_4 * t6 + (cos_q_4 * t5 + p.k25 * t1);
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
    let t11 = t5 * p.two_l;
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
    let t43 = t32 * (t33 * p.k18);
    let t44 = cos_q_5 * (p.l * t35 + (sin_q_4 * t30 + cos_q_4 * t26));
    let t45 = t23 - t38;
    let t46 = t37 + t42;
    let t47 = p.half_l_m * (sin_q_5 * (t28 - t29 * p.l) + t44);
    let t48 = t23 * p.k1 - t38 * p.k3;
    let t49 = sin_q_5 * t45 + cos_q_5 * t39;
    let t50 = p.k1 * t37 + p.k3 * t42 - p.half_l_m * (p.l * t40 + t36);
    let t51 = cos_q_5 * t43 + (p.k17 * t36 + (p.k5 * t34 + t14 * p.k4));
    let t52 = t39 * (sin_q_5 * p.half_l_m) + t35 * p.k17;
    let t53 = t52 - t45 * (cos_q_5 * p.half_l_m);
    let t54 = p.k17 * t40 - p.half_l_m * t46;
    let t55 = t49 * p.half_l_m + t29 * p.k17;
    let f_q_4 = t51 - p.half_l_squared_m * t46 - sin_q_5 * t50;
    let t56 = t49 * p.half_l_squared_m + (t24 * p.k4 + t23 * p.k5 - t28 * p.k17);
    let t57 = t48 - t47 + t56;
    let t58 = t27 * (t17 * p.k16) - sin_q_5 * t43 - cos_q_5 * t50;
    let t59 = cos_q_4 * t53 - sin_q_4 * t54;
    let t60 = t25 * (cos_q_3 * p.k15) + t53 * (cos_q_3 * sin_q_4);
    let t61 = sin_q_4 * t57 + (p.l * t55 + (t5 * p.k6 - t16 * p.k7 - t21 * p.k15));
    let t62 = cos_q_4 * t58;
    let t63 = f_q_4 + (t14 * p.k7 - t15 * p.k6 - t19 * p.k15) - p.l * t59;
    let t64 = sin_q_3 * (t55 + t22 * p.k15) + (t54 * (cos_q_3 * cos_q_4) + t60);
    let t65 = t7 * (t8 * p.k14) - sin_q_4 * t58 - cos_q_4 * t57;
    let t66 = t64 * (sin_q_2 * p.l) - t5 * (sin_q_2 * p.k12);
    let t67 = p.l * (t5 * p.k23 + t64) - t63 * (cos_q_2 * cos_q_3);
    let t68 = sin_q_2 * (t61 - t62 + t5 * p.k11) + t67;
    let t69 = p.l * (t59 - t20 * p.k15) + (t10 * p.k13 - t13 * p.k9) - sin_q_3 * t63;
    let f_q_1 = -(t65 * (cos_q_2 * sin_q_3) + t66 + t68);
    let f_q_2 = cos_q_3 * t65 - t69;
    let f_q_3 = t62 - t61;
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
    let g2 = p.minus_l * (t10 + (cos_q_2 + t3) - (cos_q_5 * t7 - sin_q_5 * t10));
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
    let t2 = sin_q_2 * sin_q_3;
    let t3 = sin_q_2 * cos_q_3;
    let t4 = sin_q_1 * q_1_dot;
    let t5 = cos_q_1 * q_1_dot;
    let t6 = sin_q_2 * cos_q_4;
    let t7 = cos_q_3 * q_3_dot;
    let t8 = cos_q_3 * sin_q_1 + cos_q_1 * t2;
    let t9 = sin_q_3 * t0 + q_3_dot * t3;
    let t10 = cos_q_4 * q_4_dot;
    let t11 = cos_q_2 * sin_q_4;
    let t12 = cos_q_2 * cos_q_4;
    let t13 = q_2_dot * t2;
    let t14 = cos_q_3 * cos_q_1 - sin_q_1 * t2;
    let t15 = cos_q_3 * t5 - sin_q_1 * t1 - (t2 * t4 - cos_q_1 * t9);
    let t16 = q_2_dot * t6 + q_4_dot * t11;
    let t17 = q_3_dot * t2 - cos_q_3 * t0;
    let t18 = t2 * t5 + sin_q_1 * t9 + (cos_q_3 * t4 + cos_q_1 * t1);
    let t19 = cos_q_5 * q_5_dot;
    let t20 = sin_q_5 * q_5_dot;
    let t21 = t6 + sin_q_3 * t11;
    let t22 = q_2_dot * t3;
    let t23 = sin_q_1 * t12 + sin_q_4 * t14;
    let t24 = sin_q_3 * cos_q_1 + sin_q_1 * t3;
    let t25 = t8 * t10 + sin_q_4 * t15 + (t4 * t12 + cos_q_1 * t16);
    let t26 = sin_q_4 * t13 - cos_q_2 * (sin_q_4 * t7 + sin_q_3 * t10);
    let t27 = cos_q_4 * t0 - sin_q_4 * (sin_q_2 * q_4_dot) - t26;
    let t28 = t5 * t12 - sin_q_1 * t16 - (sin_q_4 * t18 - t10 * t14);
    let t29 = t3 * t5 - sin_q_1 * t17 - (sin_q_3 * t4 - cos_q_1 * t7);
    let t30 = cos_q_5 * (t3 * t4 + cos_q_1 * t17 + (sin_q_3 * t5 + sin_q_1 * t7));
    let t31 = sin_q_5 * t25 - (cos_q_1 * t12 - sin_q_4 * t8) * t19;
    let t32 = cos_q_5 * t22 + cos_q_2 * (cos_q_5 * t1 + cos_q_3 * t20);
    let t33 = t31 + ((cos_q_1 * t3 - sin_q_3 * sin_q_1) * t20 + t30);
    let t34 = t13 - cos_q_2 * t7 + sin_q_2 * q_2_dot - t27;
    let t35 = t19 * t23 + sin_q_5 * t28 + (cos_q_5 * t29 - t20 * t24);
    let t36 = sin_q_5 * t22 + cos_q_2 * (sin_q_5 * t1 - cos_q_3 * t19);
    let phi1 = (t4 + (sin_q_2 * t4 - cos_q_1 * t0) - t15 - t25 - t33) * p.minus_l;
    let phi2 = (t34 - (t19 * t21 + sin_q_5 * t27 + t32)) * p.l;
    let phi3 = (t18 + (t5 + (sin_q_2 * t5 + sin_q_1 * t0)) - t28 - t35) * p.minus_l;
    let phi4 = cos_q_5 * t27 - t20 * t21 - t36;
    let phi5 = t19 * t24 + sin_q_5 * t29 - (cos_q_5 * t28 - t20 * t23);
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
    let g1_5 = p.minus_l * (cos_q_5 * (t3 * cos_q_1 - sin_q_4 * t15) - t27);
    let zero = S::ZERO;
    let g2_2 = t14 - t9;
    let g2_3 = -(cos_q_2 * t7 + t6 * t5);
    let g2_4 = -(t0 * t20);
    let g2_5 = p.minus_l * (cos_q_2 * t16 + cos_q_5 * t21);
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
    let t123 = t122 - (t119 + t58 * t120 + (t119 + cos_q_5 * t117) - t121);
    let t124 = t44 * t80;
    let t125 = t44 * t75;
    let t126 = sin_q_5 * t77;
    let t127 = t48 * t83 + (t124 + t125) + (sin_q_5 * t79 + (t125 - t126));
    let t128 = t47 * t72;
    let t129 = t128 + t58 * t74 + (t128 + cos_q_5 * t71);
    let t130 = t47 * t108;
    let t131 = t44 * t118;
    let t132 = t130 + t58 * t110 + (t130 + cos_q_5 * t107);
    let gamma1 = (t61 + (t23 + (t12 + (t2 + t9 + (t2 + sin_q_2 * t12))) - t43)) * p.l;
    let gamma2 = p.minus_l * (t86 - (t85 + (t84 - (t81 + t76 - t58 * t83))));
    let gamma3 = p.minus_l * t123;
    let gamma4 = t127 - (t126 - t124 - sin_q_5 * t82) + t129;
    let gamma5 = -(t131 - t48 * t120 + (t131 - sin_q_5 * t117) + t132);
    [gamma1, gamma2, gamma3, gamma4, gamma5]
}

::lagrangian::emitted::fast_function! {
    /// Accelerations `a`, the solution of `M a = f + G^T lambda`, `G a = gamma` from the mass
    /// matrix, factored.
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
    pub fn accelerations<'a, S>(Accelerations { p: &'a Prepared<S>, q: &'a [S; 5], v: &'a [S; 5] })
        -> Result<[S; 5], ::lagrangian::emitted::Singular> = accelerations_in;
}

#[inline(always)]
fn accelerations_in<S: Copy, N: ::lagrangian::emitted::Scalar<Stored = S>>(
    call: Accelerations<'_, S>,
) -> Result<[S; 5], ::lagrangian::emitted::Singular> {
    let Accelerations { p, q, v } = call;
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
    let t1 = t0.mul_add(sin_q_3, sin_q_2 * cos_q_4);
    let t2 = cos_q_2 * cos_q_3;
    let t3 = t1.mul_add(cos_q_5, sin_q_5 * t2);
    let t4 = sin_q_2 * n(p.l);
    let t5 = n(p.l) + t4;
    let t6 = cos_q_3 * cos_q_4.mul_sub(t5, t0 * n(p.l));
    let t7 = t2.neg_mul_add(n(p.l), t6);
    let t8 = t7.neg_mul_add(n(p.half_l_m), t3 * n(p.k3));
    let t9 = cos_q_4 * cos_q_5;
    let t10 = sin_q_3 * n(p.k15);
    let t11 = cos_q_2 * cos_q_4;
    let t12 = sin_q_3.mul_sub(t11, sin_q_2 * sin_q_4);
    let t13 = sin_q_5 * n(p.half_l_m);
    let t14 = t13 + n(p.k17);
    let t15 = t12 * t14;
    let t16 = t5.mul_add(t10, sin_q_2 * n(p.k6));
    let t17 = sin_q_3.mul_add(t5, t4);
    let t18 = cos_q_3 * cos_q_5;
    let t19 = sin_q_4.mul_add(t5, n(p.l) * t11) * t18;
    let t20 = sin_q_5.neg_mul_add(n(p.l).neg_mul_add(t12, t17), t19);
    let t21 = n(p.half_l_m).mul_add(t20, t12 * n(p.k1));
    let t22 = sin_q_5 * n(p.half_l_squared_m);
    let t23 = t12.mul_add(t22, n(p.k17).neg_mul_add(t17, t12 * n(p.k5)));
    let t24 = t21 + t23;
    let t25 = t8.mul_add(t9, n(p.l).neg_mul_add(t15, t16));
    let t26 = sin_q_4.neg_mul_add(t24, t25);
    let t27 = t3.mul_add(n(p.half_l_m), t2 * n(p.k17));
    let t28 = n(p.half_l_m) * t12;
    let t29 = sin_q_4 * cos_q_5;
    let t30 = sin_q_3 * sin_q_2.neg_mul_add(n(p.k15), t15);
    let t31 = cos_q_3.mul_add(cos_q_4.mul_sub(t27, t28 * t29), t30);
    let t32 = t26 + sin_q_2.mul_add(n(p.k9), n(p.k20));
    let t33 = t6.neg_mul_add(n(p.k17), t2 * n(p.k4));
    let t34 = t3.mul_add(n(p.half_l_squared_m), t33);
    let t35 = sin_q_5.mul_add(t8, t34);
    let t36 = sin_q_4.mul_add(t27, t9 * t28);
    let t37 = n(p.l).mul_add(t36, t2.mul_add(n(p.k7), t35));
    let t38 = cos_q_4.mul_add(t24, t8 * t29);
    let t39 = sin_q_2.neg_mul_add(n(p.k13), t31);
    let t40 = cos_q_3.mul_add(t37, sin_q_3 * t38);
    let t41 = cos_q_2.mul_add(t40, n(p.l).neg_mul_add(t39, n(p.k10)));
    // Row q[1]: pivot d[q[1]].
    let t42 = sin_q_2.mul_add(n(p.l).neg_mul_add(t31, t32), t41);
    let t43 = N::ONE / t42;
    let t44 = cos_q_3.mul_sub(t38, n(p.l) * t2.mul_add(n(p.k15), t36));
    let t45 = sin_q_3.neg_mul_add(t37, t44);
    // Eliminates q[1] from row q[2]: l[q[2], q[1]].
    let t46 = t43 * t45;
    let t47 = sin_q_3 * n(p.l);
    let t48 = n(p.l) + t47;
    let t49 = sin_q_4 * t48;
    let t50 = sin_q_4.mul_sub(t18, sin_q_3 * sin_q_5);
    let t51 = n(p.half_l_m).mul_sub(t47 + t49, n(p.k3) * t50);
    let t52 = n(p.k17).mul_add(t49, sin_q_3 * n(p.k4));
    let t53 = n(p.half_l_squared_m).neg_mul_add(t50, t52);
    let t54 = sin_q_5.mul_add(t51, t53);
    let t55 = cos_q_4 * n(p.half_l_m);
    let t56 = n(p.half_l_m).neg_mul_add(t50, sin_q_3 * n(p.k17));
    let t57 = sin_q_4.mul_sub(t56, t55 * (cos_q_4 * t18));
    let t58 = t54 + sin_q_3.mul_add(n(p.k7), n(p.k21));
    let t59 = cos_q_3 * sin_q_5;
    let t60 = cos_q_4 * cos_q_3;
    let t61 = cos_q_5.mul_sub(t48, n(p.l) * t59);
    let t62 = t55.mul_sub(t61, n(p.k1) * t60);
    let t63 = t60.neg_mul_add(n(p.k5) + t22, t62);
    let t64 = n(p.l).mul_add(t10 + t57, n(p.k8));
    let t65 = cos_q_3.neg_mul_add(cos_q_4.mul_add(t63, t29 * t51), t64);
    let t66 = sin_q_3.mul_add(n(p.l).mul_add(t57, t58), t65);
    // Row q[2]: pivot d[q[2]].
    let t67 = t45.neg_mul_add(t46, t66);
    let t68 = N::ONE / t67;
    // Eliminates q[1] from row q[3]: l[q[3], q[1]].
    let t69 = t26 * t43;
    let t70 = t9.mul_add(t51, t14 * (n(p.l) * t60));
    let t71 = t45.mul_add(t69, sin_q_4.neg_mul_add(t63, t70));
    // Eliminates q[2] from row q[3]: l[q[3], q[2]].
    let t72 = t68 * t71;
    let t73 = sin_q_4 * n(p.l);
    let t74 = t13.mul_add(n(p.l) + t73, sin_q_4 * n(p.k1));
    let t75 = sin_q_4.mul_add(t22, sin_q_4.mul_add(n(p.k5), n(p.k22)));
    let t76 = t14.mul_add(t73, t9.mul_add(n(p.k3) * t9, n(p.k6)));
    let t77 = sin_q_4.mul_add(t74 + t75, t76);
    // Row q[3]: pivot d[q[3]].
    let t78 = t71.neg_mul_add(t72, t26.neg_mul_add(t69, t77));
    let t79 = N::ONE / t78;
    // Eliminates q[1] from row q[4]: l[q[4], q[1]].
    let t80 = t35 * t43;
    let t81 = t45.mul_add(t80, t54);
    // Eliminates q[2] from row q[4]: l[q[4], q[2]].
    let t82 = t68 * t81;
    let t83 = sin_q_5.mul_add(n(p.k3), n(p.half_l_squared_m));
    let t84 = t71.neg_mul_add(t82, t26.neg_mul_add(t80, t9 * t83));
    // Eliminates q[3] from row q[4]: l[q[4], q[3]].
    let t85 = t79 * t84;
    let t86 = sin_q_5.mul_add(n(p.half_l_squared_m) + t83, n(p.k4));
    let t87 = t81.neg_mul_add(t82, t35.neg_mul_add(t80, t86));
    // Row q[4]: pivot d[q[4]].
    let t88 = t84.neg_mul_add(t85, t87);
    let t89 = N::ONE / t88;
    // Eliminates q[1] from row q[5]: l[q[5], q[1]].
    let t90 = t21 * t43;
    let t91 = t45.mul_add(t90, t62);
    // Eliminates q[2] from row q[5]: l[q[5], q[2]].
    let t92 = t68 * t91;
    let t93 = t71.mul_add(t92, t26.mul_add(t90, t74));
    // Eliminates q[3] from row q[5]: l[q[5], q[3]].
    let t94 = t79 * t93;
    let t95 = t84.neg_mul_add(t94, t81.mul_add(t92, t35 * t90));
    // Eliminates q[4] from row q[5]: l[q[5], q[4]].
    let t96 = t89 * t95;
    let t97 = t91.neg_mul_add(t92, t21.neg_mul_add(t90, n(p.k1)));
    // Row q[5]: pivot d[q[5]].
    let t98 = t95.neg_mul_add(t96, t93.neg_mul_add(t94, t97));
    let t99 = N::ONE / t98;
    let t100 = sin_q_5.mul_add(n(p.l), n(p.l));
    let t101 = sin_q_4.mul_add(t100, n(p.l));
    let t102 = sin_q_3 * t101;
    let t103 = n(p.l) * t18;
    let t104 = t11 * t100;
    let t105 = sin_q_2.mul_add(t102 - t103, t5 - t104);
    let t106 = cos_q_5 * n(p.l);
    let t107 = sin_q_3 * t106;
    let t108 = cos_q_3.mul_add(t101, t107);
    let t109 = t105.neg_mul_add(sin_q_1, cos_q_1 * t108);
    // Eliminates q[1] from row along: l[along, q[1]].
    let t110 = t43 * t109;
    let t111 = cos_q_4 * t100;
    let t112 = sin_q_2 * cos_q_1;
    let t113 = t102 + (n(p.l) - t103);
    let t114 = t113.mul_add(cos_q_2 * cos_q_1, t111 * t112);
    let t115 = t45.mul_add(t110, t114);
    // Eliminates q[2] from row along: l[along, q[2]].
    let t116 = t68 * t115;
    let t117 = sin_q_3 * t101.mul_sub(sin_q_1, t106 * t112);
    let t118 = cos_q_3.mul_sub(t101.mul_add(t112, sin_q_1 * t106), t117);
    let t119 = t71.neg_mul_add(t116, t26.neg_mul_add(t110, t118));
    // Eliminates q[3] from row along: l[along, q[3]].
    let t120 = t79 * t119;
    let t121 = sin_q_3.mul_add(t112, cos_q_3 * sin_q_1);
    let t122 = t100 * cos_q_4.mul_add(t121, t0 * cos_q_1);
    let t123 = t81.neg_mul_add(t116, t35.neg_mul_add(t110, t122));
    let t124 = t84.neg_mul_add(t120, t123);
    // Eliminates q[4] from row along: l[along, q[4]].
    let t125 = t89 * t124;
    let t126 = sin_q_4.neg_mul_add(t121, t11 * cos_q_1);
    let t127 = cos_q_3.mul_sub(t112, sin_q_3 * sin_q_1);
    let t128 = n(p.l) * cos_q_5.mul_sub(t126, sin_q_5 * t127);
    let t129 = t91.neg_mul_add(t116, t21.neg_mul_add(t110, t128));
    let t130 = t95.mul_add(t125, t93.mul_add(t120, t129));
    // Eliminates q[5] from row along: l[along, q[5]].
    let t131 = t99 * t130;
    let t132 = t119.mul_add(t120, t115.mul_add(t116, t109 * t110));
    // Row along: pivot d[along].
    let t133 = t130.mul_add(t131, t124.mul_add(t125, t132));
    let t134 = N::ONE / t133;
    let t135 = sin_q_4 * sin_q_3;
    let t136 = sin_q_2.neg_mul_add(t100.mul_add(t135, t48 - t103), t104);
    // Eliminates q[2] from row up: l[up, q[2]].
    let t137 = t68 * t136;
    let t138 = t71.neg_mul_add(t137, t2.mul_add(t101, cos_q_2 * t107));
    // Eliminates q[3] from row up: l[up, q[3]].
    let t139 = t79 * t138;
    let t140 = t84.neg_mul_add(t139, t81.neg_mul_add(t137, t12 * t100));
    // Eliminates q[4] from row up: l[up, q[4]].
    let t141 = t89 * t140;
    let t142 = t93.neg_mul_add(t139, t91.mul_add(t137, t3 * n(p.l)));
    let t143 = t95.neg_mul_add(t141, t142);
    // Eliminates q[5] from row up: l[up, q[5]].
    let t144 = t99 * t143;
    let t145 = t124.mul_add(t141, t119.mul_add(t139, t115 * t137));
    let t146 = t130.neg_mul_add(t144, t145);
    // Eliminates along from row up: l[up, along].
    let t147 = t134 * t146;
    let t148 = t138.mul_add(t139, t136 * t137);
    let t149 = t143.mul_add(t144, t140 * t141) + t148;
    // Row up: pivot d[up].
    let t150 = t146.neg_mul_add(t147, t149);
    let t151 = N::ONE / t150;
    let t152 = t105.mul_add(cos_q_1, sin_q_1 * t108);
    // Eliminates q[1] from row across: l[across, q[1]].
    let t153 = t43 * t152;
    let t154 = sin_q_2 * sin_q_1;
    let t155 = cos_q_2 * sin_q_1;
    let t156 = t45.mul_add(t153, t113.mul_add(t155, t111 * t154));
    // Eliminates q[2] from row across: l[across, q[2]].
    let t157 = t68 * t156;
    let t158 = cos_q_3 * t101.mul_sub(t154, cos_q_1 * t106);
    let t159 = sin_q_3.mul_add(t101.mul_add(cos_q_1, t106 * t154), t158);
    let t160 = t71.neg_mul_add(t157, t26.neg_mul_add(t153, t159));
    // Eliminates q[3] from row across: l[across, q[3]].
    let t161 = t79 * t160;
    let t162 = sin_q_3.neg_mul_add(t154, cos_q_3 * cos_q_1);
    let t163 = cos_q_4.mul_sub(t162, t0 * sin_q_1);
    let t164 = t81.mul_add(t157, t35.mul_add(t153, t100 * t163));
    let t165 = t84.mul_add(t161, t164);
    // Eliminates q[4] from row across: l[across, q[4]].
    let t166 = t89 * t165;
    let t167 = sin_q_4.mul_add(t162, t11 * sin_q_1);
    let t168 = cos_q_3.mul_add(t154, sin_q_3 * cos_q_1);
    let t169 = n(p.l) * cos_q_5.mul_sub(t167, sin_q_5 * t168);
    let t170 = t91.neg_mul_add(t157, t21.neg_mul_add(t153, t169));
    let t171 = t95.neg_mul_add(t166, t93.mul_add(t161, t170));
    // Eliminates q[5] from row across: l[across, q[5]].
    let t172 = t99 * t171;
    let t173 = t119.mul_add(t161, t115.mul_add(t157, t109 * t153));
    let t174 = t130.mul_add(t172, t124.neg_mul_add(t166, t173));
    // Eliminates along from row across: l[across, along].
    let t175 = t134 * t174;
    let t176 = t140.neg_mul_add(t166, t138.mul_add(t161, t136 * t157));
    let t177 = t146.neg_mul_add(t175, t143.neg_mul_add(t172, t176));
    // Eliminates up from row across: l[across, up].
    let t178 = t151 * t177;
    let t179 = t171.mul_add(t172, t156.mul_add(t157, t152 * t153));
    let t180 = t179 + t165.mul_add(t166, t160 * t161);
    // Row across: pivot d[across].
    let t181 = t177.neg_mul_add(t178, t174.neg_mul_add(t175, t180));
    let t182 = N::ONE / t181;
    let t183 = sin_q_3.mul_add(t29, t59);
    let t184 = sin_q_2.neg_mul_add(t183, cos_q_5 * t11);
    // Eliminates q[2] from row tips: l[tips, q[2]].
    let t185 = t68 * t184;
    let t186 = t71.neg_mul_add(t185, cos_q_2 * t50);
    // Eliminates q[3] from row tips: l[tips, q[3]].
    let t187 = t79 * t186;
    let t188 = t81.neg_mul_add(t185, cos_q_5 * t12);
    let t189 = t84.neg_mul_add(t187, t188);
    // Eliminates q[4] from row tips: l[tips, q[4]].
    let t190 = t89 * t189;
    let t191 = cos_q_2 * t18;
    let t192 = t91.mul_add(t185, t1.neg_mul_add(sin_q_5, t191));
    let t193 = t95.neg_mul_add(t190, t93.neg_mul_add(t187, t192));
    // Eliminates q[5] from row tips: l[tips, q[5]].
    let t194 = t99 * t193;
    let t195 = t124.mul_add(t190, t119.mul_add(t187, t115 * t185));
    let t196 = t130.neg_mul_add(t194, t195);
    // Eliminates along from row tips: l[tips, along].
    let t197 = t134 * t196;
    let t198 = t140.mul_add(t190, t138.mul_add(t187, t136 * t185));
    let t199 = t146.neg_mul_add(t197, t143.mul_add(t194, t198));
    // Eliminates up from row tips: l[tips, up].
    let t200 = t151 * t199;
    let t201 = t165.neg_mul_add(t190, t160.mul_add(t187, t156 * t185));
    let t202 = t174.neg_mul_add(t197, t171.neg_mul_add(t194, t201));
    let t203 = t177.neg_mul_add(t200, t202);
    // Eliminates across from row tips: l[tips, across].
    let t204 = t182 * t203;
    let t205 = t186.mul_add(t187, t184 * t185);
    let t206 = t193.mul_add(t194, t189 * t190) + t205;
    let t207 = t199.neg_mul_add(t200, t196.neg_mul_add(t197, t206));
    // Row tips: pivot d[tips].
    let t208 = t203.neg_mul_add(t204, t207);
    let t209 = N::ONE / t208;
    let t210 = cos_q_1.mul_sub(t184, t50 * sin_q_1);
    // Eliminates q[1] from row turns: l[turns, q[1]].
    let t211 = t43 * t210;
    let t212 = t45.neg_mul_add(t211, t155.mul_add(t183, t9 * t154));
    // Eliminates q[2] from row turns: l[turns, q[2]].
    let t213 = t68 * t212;
    let t214 = cos_q_3 * t29.mul_add(t154, sin_q_5 * cos_q_1);
    let t215 = t29.mul_sub(cos_q_1, sin_q_5 * t154);
    let t216 = t26.mul_add(t211, sin_q_3.mul_add(t215, t214));
    let t217 = t71.neg_mul_add(t213, t216);
    // Eliminates q[3] from row turns: l[turns, q[3]].
    let t218 = t79 * t217;
    let t219 = t81.mul_add(t213, t35.neg_mul_add(t211, cos_q_5 * t163));
    let t220 = t84.mul_add(t218, t219);
    // Eliminates q[4] from row turns: l[turns, q[4]].
    let t221 = t89 * t220;
    let t222 = sin_q_5.mul_add(t167, cos_q_5 * t168);
    let t223 = t91.mul_add(t213, t21.neg_mul_add(t211, t222));
    let t224 = t95.mul_add(t221, t93.neg_mul_add(t218, t223));
    // Eliminates q[5] from row turns: l[turns, q[5]].
    let t225 = t99 * t224;
    let t226 = t115.neg_mul_add(t213, t109 * t211);
    let t227 = t124.mul_add(t221, t119.neg_mul_add(t218, t226));
    let t228 = t130.mul_add(t225, t227);
    // Eliminates along from row turns: l[turns, along].
    let t229 = t134 * t228;
    let t230 = t140.neg_mul_add(t221, t138.mul_add(t218, t136 * t213));
    let t231 = t146.mul_add(t229, t143.mul_add(t225, t230));
    // Eliminates up from row turns: l[turns, up].
    let t232 = t151 * t231;
    let t233 = t156.neg_mul_add(t213, t152 * t211);
    let t234 = t165.neg_mul_add(t221, t160.neg_mul_add(t218, t233));
    let t235 = t174.neg_mul_add(t229, t171.mul_add(t225, t234));
    let t236 = t177.mul_add(t232, t235);
    // Eliminates across from row turns: l[turns, across].
    let t237 = t182 * t236;
    let t238 = t189.neg_mul_add(t221, t186.mul_add(t218, t184 * t213));
    let t239 = t196.mul_add(t229, t193.mul_add(t225, t238));
    let t240 = t203.mul_add(t237, t199.neg_mul_add(t232, t239));
    // Eliminates tips from row turns: l[turns, tips].
    let t241 = t209 * t240;
    let t242 = sin_q_2 * q_1_dot;
    let t243 = n(p.l) * q_1_dot;
    let t244 = t242.mul_add(t242, q_2_dot * q_2_dot);
    let t245 = n(p.l).mul_add(t244, t242.mul_add(t243, cos_q_2 * n(p.g)));
    let t246 = cos_q_2 * q_2_dot;
    let t247 = q_1_dot * t246;
    let t248 = t247 * n(p.two_l);
    let t249 = cos_q_3.mul_sub(t245, sin_q_3 * t248);
    let t250 = cos_q_2 * q_1_dot;
    let t251 = sin_q_3.neg_mul_add(t250, cos_q_3 * q_2_dot);
    let t252 = t2.mul_add(q_1_dot, sin_q_3 * q_2_dot);
    let t253 = t251 * t252;
    let t254 = t247 - t253;
    let t255 = n(p.l).neg_mul_add(t254, t249);
    let t256 = t242 + q_3_dot;
    let t257 = cos_q_4.mul_sub(t256, sin_q_4 * t251);
    let t258 = t242 * q_2_dot;
    let t259 = sin_q_3.mul_sub(t258, t252 * q_3_dot);
    let t260 = cos_q_4.mul_add(t259, sin_q_4 * t247);
    let t261 = t257.mul_add(q_4_dot, t260);
    let t262 = t252 + q_4_dot;
    let t263 = t257 * t262;
    let t264 = t261 + t263;
    let t265 = t252.mul_add(t252, t256 * t256);
    let t266 = sin_q_3.mul_add(t245, cos_q_3 * t248);
    let t267 = n(p.l).mul_add(t265, t266);
    let t268 = t243.neg_mul_add(t250, sin_q_2 * n(p.g));
    let t269 = t242 * t250;
    let t270 = n(p.l).neg_mul_add(t269, t268);
    let t271 = cos_q_3.mul_sub(t258, t251 * q_3_dot);
    let t272 = t251 * t256;
    let t273 = t271 - t272;
    let t274 = n(p.l).neg_mul_add(t273, t270);
    let t275 = cos_q_4.mul_add(t251, sin_q_4 * t256);
    let t276 = t275.mul_add(t275, t262 * t262);
    let t277 = sin_q_4.mul_add(t267, cos_q_4 * t274);
    let t278 = sin_q_5 * n(p.l).neg_mul_add(t264, t255);
    let t279 = sin_q_5.neg_mul_add(t257, cos_q_5 * t262);
    let t280 = cos_q_5.mul_add(t257, sin_q_5 * t262);
    let t281 = t279 * t280;
    let t282 = cos_q_5.mul_add(n(p.l).mul_add(t276, t277), t278);
    let t283 = n(p.k1).mul_sub(t261, n(p.k3) * t281);
    let t284 = n(p.half_l_m).neg_mul_add(t282, t283);
    let t285 = t261 - t281;
    let t286 = t275 + q_5_dot;
    let t287 = t280.mul_add(t280, t286 * t286);
    let t288 = sin_q_5.mul_add(t285, cos_q_5 * t287);
    let t289 = n(p.k5).mul_add(t261, n(p.k4) * t263);
    let t290 = n(p.k17).neg_mul_add(t255, t289);
    let t291 = t284 + n(p.half_l_squared_m).mul_add(t288, t290);
    let t292 = n(p.half_l_m).mul_add(t288, n(p.k17) * t264);
    let t293 = n(p.k7).neg_mul_add(t253, n(p.k6) * t247);
    let t294 = n(p.l).mul_add(t292, n(p.k15).neg_mul_add(t249, t293));
    let t295 = cos_q_4.mul_sub(t267, sin_q_4 * t274);
    let t296 = t257 * t275;
    let t297 = t271 + t296;
    let t298 = sin_q_4.neg_mul_add(t259, cos_q_4 * t247);
    let t299 = q_4_dot.neg_mul_add(t275, t298);
    let t300 = cos_q_5.mul_sub(t299, sin_q_5 * t271);
    let t301 = t279.mul_add(q_5_dot, t300);
    let t302 = t279 * t286;
    let t303 = n(p.k3).mul_add(t301, n(p.k1) * t302);
    let t304 = n(p.l).mul_add(t297, t295);
    let t305 = n(p.half_l_m).neg_mul_add(t304, t303);
    let t306 = t280 * (t286 * n(p.k18));
    let t307 = sin_q_5.neg_mul_add(t306, t275 * (t262 * n(p.k16)));
    let t308 = cos_q_5.neg_mul_add(t305, t307);
    let t309 = cos_q_4.neg_mul_add(t308, sin_q_4.mul_add(t291, t294));
    let t310 = sin_q_5.mul_sub(t287, cos_q_5 * t285);
    let t311 = n(p.half_l_m).mul_add(t310, n(p.k17) * t276);
    let t312 = t301 + t302;
    let t313 = n(p.half_l_m).neg_mul_add(t312, n(p.k17) * t297);
    let t314 = sin_q_4.mul_add(t311, n(p.k15) * t265);
    let t315 = sin_q_3 * n(p.k15).mul_add(t254, t292);
    let t316 = cos_q_3.mul_add(cos_q_4.mul_add(t313, t314), t315);
    let t317 = sin_q_4.neg_mul_add(t308, t252 * (t256 * n(p.k14)));
    let t318 = cos_q_4.neg_mul_add(t291, t317);
    let t319 = n(p.k5).mul_add(t296, n(p.k4) * t271);
    let t320 = cos_q_5.mul_add(t306, n(p.k17).mul_add(t295, t319));
    let t321 = n(p.half_l_squared_m).neg_mul_add(t312, t320);
    let t322 = sin_q_5.neg_mul_add(t305, t321);
    let t323 = n(p.k7).mul_sub(t271, n(p.k6) * t272);
    let t324 = cos_q_4.mul_sub(t311, sin_q_4 * t313);
    let t325 = t322 + n(p.k15).neg_mul_add(t270, t323);
    let t326 = n(p.l).neg_mul_add(t324, t325);
    let t327 = cos_q_3.mul_add(t326, t258 * n(p.k12));
    let t328 = n(p.l) * t247.mul_add(n(p.k23), t316);
    let t329 = cos_q_2.mul_add(sin_q_3.mul_sub(t318, t327), t328);
    let t330 = n(p.l).mul_add(t316, t247.mul_add(n(p.k11), t309));
    let t331 = sin_q_2.mul_add(t330, t329);
    let t332 = n(p.k13).mul_sub(t268, n(p.k9) * t269);
    let t333 = n(p.l).mul_add(n(p.k15).neg_mul_add(t273, t324), t332);
    let t334 = cos_q_3.neg_mul_add(t318, sin_q_3.neg_mul_add(t326, t333));
    // Row q[2]: right-hand side z[q[2]].
    let t335 = t46.mul_add(t331, t334);
    // Row q[3]: right-hand side z[q[3]].
    let t336 = t72.neg_mul_add(t335, t69.neg_mul_add(t331, t309));
    let t337 = t82.mul_add(t335, t80.mul_add(t331, t322));
    // Row q[4]: right-hand side z[q[4]].
    let t338 = t85.mul_add(t336, t337);
    let t339 = sin_q_1 * q_1_dot;
    let t340 = t242 * t339;
    let t341 = sin_q_3 * t246;
    let t342 = cos_q_1 * q_1_dot;
    let t343 = t341 * t342;
    let t344 = cos_q_3 * q_3_dot;
    let t345 = cos_q_1 * t242;
    let t346 = t344 * t345;
    let t347 = sin_q_1 * t246;
    let t348 = t344 * t347;
    let t349 = sin_q_2 * q_2_dot;
    let t350 = q_2_dot * t349;
    let t351 = sin_q_1 * t350;
    let t352 = sin_q_3.neg_mul_add(t351, t343 + t348);
    let t353 = sin_q_3 * q_3_dot;
    let t354 = q_3_dot * t353;
    let t355 = sin_q_3.mul_sub(t340, t343) - t346 - t352;
    let t356 = t339 * t353;
    let t357 = q_1_dot * t342;
    let t358 = q_3_dot * t344;
    let t359 = cos_q_1.neg_mul_add(t358, t356);
    let t360 = t355 - t154.neg_mul_add(t354, t346 + t348);
    let t361 = cos_q_3.mul_sub(t357, t356) - t359 - t360;
    let t362 = sin_q_2.mul_add(t344, t341);
    let t363 = cos_q_1.mul_add(t353, cos_q_3 * t339);
    let t364 = sin_q_1.mul_add(t362, sin_q_3 * t345) + t363;
    let t365 = cos_q_4 * q_4_dot;
    let t366 = t364 * t365;
    let t367 = sin_q_4 * q_4_dot;
    let t368 = q_4_dot * t367;
    let t369 = cos_q_4 * cos_q_1;
    let t370 = t258 * t369;
    let t371 = cos_q_4 * sin_q_1;
    let t372 = q_2_dot * t246;
    let t373 = t349 * t367;
    let t374 = sin_q_1 * t373;
    let t375 = q_1_dot * t339;
    let t376 = t0 * q_4_dot;
    let t377 = t342 * t376;
    let t378 = t371.mul_add(t372, t370) - t374;
    let t379 = t11 * q_4_dot;
    let t380 = q_4_dot * t379;
    let t381 = t378 + (t11.mul_add(t375, t370) + t377);
    let t382 = sin_q_4.mul_add(t361, t366) + t162.mul_add(t368, t366);
    let t383 = t382 + (t381 + sin_q_1.mul_add(t380, t377 - t374));
    let t384 = t246 * t342;
    let t385 = cos_q_4.mul_add(t349, t376);
    let t386 = sin_q_1.neg_mul_add(t385, t11 * t342);
    let t387 = t386 - sin_q_4.mul_sub(t364, t162 * t365);
    let t388 = cos_q_5 * q_5_dot;
    let t389 = t387 * t388;
    let t390 = sin_q_5 * q_5_dot;
    let t391 = q_5_dot * t390;
    let t392 = sin_q_5.neg_mul_add(t383, t389);
    let t393 = t347 * t353;
    let t394 = t345 * t353;
    let t395 = cos_q_3 * t246;
    let t396 = t342 * t395;
    let t397 = cos_q_3.mul_add(t340, t394) - t396;
    let t398 = cos_q_3.neg_mul_add(t351, t396 - t393);
    let t399 = t339 * t344;
    let t400 = cos_q_1.mul_add(t354, t399) + sin_q_3.mul_add(t357, t399);
    let t401 = t154.mul_add(t358, t393 + t394) + t397 - t398 + t400;
    let t402 = sin_q_2.neg_mul_add(t353, t395);
    let t403 = sin_q_3.mul_sub(t339, cos_q_1 * t344);
    let t404 = sin_q_1.mul_add(t402, cos_q_3 * t345) - t403;
    let t405 = t390 * t404;
    let t406 = q_5_dot * t388;
    let t407 = cos_q_5.mul_add(t401, t405) + t168.mul_add(t406, t405);
    let t408 = t375 + (t340 - t384 - (t384 - t351)) - t361 - t383;
    let t409 = t408 - (t407 - (t392 + t167.neg_mul_add(t391, t389)));
    let t410 = t157.mul_add(t335, t153.mul_add(t331, n(p.l) * t409));
    let t411 = t92.mul_add(t335, t90.mul_add(t331, t284));
    // Row q[5]: right-hand side z[q[5]].
    let t412 = t96.mul_add(t338, t94.neg_mul_add(t336, t411));
    let t413 = t166.mul_add(t338, t161.mul_add(t336, t410));
    let t414 = t339 * t341;
    let t415 = cos_q_1 * t246;
    let t416 = t344 * t415;
    let t417 = cos_q_1 * t350;
    let t418 = t242 * t342;
    let t419 = sin_q_1 * t242;
    let t420 = t344 * t419;
    let t421 = sin_q_3.mul_add(t418, t414) + t420;
    let t422 = sin_q_3.mul_add(t417, t414 - t416) + t421;
    let t423 = t342 * t353;
    let t424 = sin_q_1.mul_add(t358, t423) + cos_q_3.mul_add(t375, t423);
    let t425 = t422 + (t112.mul_add(t354, t420) - t416) + t424;
    let t426 = cos_q_1.neg_mul_add(t362, sin_q_3 * t419);
    let t427 = cos_q_3.mul_sub(t342, sin_q_1 * t353) - t426;
    let t428 = t365 * t427;
    let t429 = sin_q_4.neg_mul_add(t425, t428);
    let t430 = t258 * t371;
    let t431 = t339 * t376;
    let t432 = cos_q_1 * t373;
    let t433 = t369.neg_mul_add(t372, t430 + t432);
    let t434 = cos_q_1.neg_mul_add(t380, t431 + t432);
    let t435 = t11.mul_sub(t357, t430) - t431 - t433 - t434;
    let t436 = t429 + t121.neg_mul_add(t368, t428) + t435;
    let t437 = sin_q_4.mul_add(t427, t121 * t365);
    let t438 = t388 * (t437 + cos_q_1.mul_add(t385, t11 * t339));
    let t439 = t353 * t415;
    let t440 = t339 * t395;
    let t441 = t353 * t419;
    let t442 = cos_q_3.mul_add(t418, t440) - t441;
    let t443 = cos_q_3.mul_add(t417, t439 + t440) + t442;
    let t444 = t342 * t344;
    let t445 = sin_q_1.neg_mul_add(t354, t444);
    let t446 = t443 - t112.neg_mul_add(t358, t441 - t439);
    let t447 = cos_q_1.neg_mul_add(t402, cos_q_3 * t419);
    let t448 = t390 * (sin_q_1.mul_add(t344, sin_q_3 * t342) + t447);
    let t449 = t446 - (sin_q_3.mul_sub(t375, t444) - t445);
    let t450 = cos_q_5.neg_mul_add(t449, t448);
    let t451 = sin_q_5.mul_add(t436, t438) + t126.mul_add(t391, t438);
    let t452 = t246 * t339;
    let t453 = t425 + (t357 + (t418 + t452 + (t417 + t452))) - t436;
    let t454 = t450 + t127.neg_mul_add(t406, t448) - t451 + t453;
    let t455 = t116.mul_add(t335, t110.mul_add(t331, n(p.l) * t454));
    let t456 = t125.neg_mul_add(t338, t120.mul_add(t336, t455));
    // Row along: right-hand side z[along].
    let t457 = t131.neg_mul_add(t412, t456);
    let t458 = sin_q_4 * t344;
    let t459 = t349 * t458;
    let t460 = t344 * t379;
    let t461 = sin_q_3 * t365;
    let t462 = t349 * t461;
    let t463 = t135.mul_add(t372, t459) + t462;
    let t464 = t376.mul_add(sin_q_3 * q_4_dot, t462) - t460;
    let t465 = t246 * t367;
    let t466 = t365.mul_add(sin_q_2 * q_4_dot, t465);
    let t467 = t0.mul_add(t354, t459) - t460 + t463 + t464;
    let t468 = t467 + (t466 + cos_q_4.mul_add(t350, t465));
    let t469 = cos_q_2.neg_mul_add(t458 + t461, t135 * t349);
    let t470 = cos_q_4.mul_sub(t246, sin_q_2 * t367) - t469;
    let t471 = t388 * t470;
    let t472 = sin_q_5.neg_mul_add(t468, t471);
    let t473 = t349 * t353;
    let t474 = cos_q_5 * t473;
    let t475 = t390 * (cos_q_3 * t349);
    let t476 = cos_q_2 * t353;
    let t477 = t390 * t476;
    let t478 = cos_q_2 * t358;
    let t479 = cos_q_5.neg_mul_add(t478, t474 + t477);
    let t480 = t191.neg_mul_add(q_5_dot * q_5_dot, t475 + t477);
    let t481 = t18.mul_sub(t372, t474) - t475 - t479 - t480;
    let t482 = t344 * t349;
    let t483 = cos_q_2.mul_add(t354, t482) + sin_q_3.mul_add(t372, t482);
    let t484 = t472 + t1.neg_mul_add(t391, t471) + t481;
    let t485 = t137.mul_add(t335, n(p.l) * (t468 + (t372 + t483) - t484));
    let t486 = t141.neg_mul_add(t338, t139.mul_add(t336, t485));
    // Row up: right-hand side z[up].
    let t487 = t147.neg_mul_add(t457, t144.mul_add(t412, t486));
    let t488 = t175.neg_mul_add(t457, t172.neg_mul_add(t412, t413));
    // Row across: right-hand side z[across].
    let t489 = t178.neg_mul_add(t487, t488);
    let t490 = t388 * t476;
    let t491 = t349 * (t18 * q_5_dot);
    let t492 = sin_q_5 * t473;
    let t493 = t59.mul_add(t372, t491) - t492;
    let t494 = sin_q_5.neg_mul_add(t478, t492 - t490);
    let t495 = t390 * t470;
    let t496 = cos_q_5.mul_add(t468, t495) + t1.mul_add(t406, t495);
    let t497 = t2.mul_add(t391, t490 + t491) + t493 - t494 + t496;
    let t498 = t187.mul_add(t336, t185.mul_add(t335, t497));
    let t499 = t194.mul_add(t412, t190.neg_mul_add(t338, t498));
    let t500 = t200.neg_mul_add(t487, t197.neg_mul_add(t457, t499));
    // Row tips: right-hand side z[tips].
    let t501 = t204.neg_mul_add(t489, t500);
    let t502 = t387 * t390;
    let t503 = t388 * t404;
    let t504 = sin_q_5.neg_mul_add(t401, t503);
    let t505 = cos_q_5.mul_add(t383, t502) + t167.mul_add(t406, t502);
    let t506 = t505 + (t504 + t168.neg_mul_add(t391, t503));
    let t507 = t213.neg_mul_add(t335, t211.mul_add(t331, t506));
    let t508 = t221.neg_mul_add(t338, t218.neg_mul_add(t336, t507));
    let t509 = t229.neg_mul_add(t457, t225.neg_mul_add(t412, t508));
    let t510 = t237.neg_mul_add(t489, t232.mul_add(t487, t509));
    let t511 = t224.mul_add(t225, t212.mul_add(t213, t210 * t211));
    let t512 = t511 + t220.mul_add(t221, t217 * t218);
    let t513 = t231.neg_mul_add(t232, t228.neg_mul_add(t229, t512));
    // Row turns: pivot d[turns].
    let t514 = t240.neg_mul_add(t241, t236.neg_mul_add(t237, t513));
    // Row turns: right-hand side z[turns].
    let t515 = t241.mul_add(t501, t510) / t514;
    // Back substitution: lambda[tips].
    let t516 = t241.mul_add(t515, t209 * t501);
    let t517 = t229.neg_mul_add(t515, t134 * t457);
    let t518 = t237.neg_mul_add(t515, t182 * t489);
    // Back substitution: lambda[across].
    let t519 = t204.neg_mul_add(t516, t518);
    let t520 = t200.neg_mul_add(t516, t232.mul_add(t515, t151 * t487));
    // Back substitution: lambda[up].
    let t521 = t178.neg_mul_add(t519, t520);
    let t522 = t175.neg_mul_add(t519, t197.neg_mul_add(t516, t517));
    // Back substitution: lambda[along].
    let t523 = t147.neg_mul_add(t521, t522);
    let t524 = t194.neg_mul_add(t516, t225.mul_add(t515, t99 * t412));
    let t525 = t144.neg_mul_add(t521, t172.mul_add(t519, t524));
    // Back substitution: a[q[5]].
    let t526 = t131.mul_add(t523, t525);
    let t527 = t190.mul_add(t516, t221.mul_add(t515, t89 * t338));
    let t528 = t141.mul_add(t521, t166.neg_mul_add(t519, t527));
    // Back substitution: a[q[4]].
    let q_4_ddot = t96.mul_add(t526, t125.mul_add(t523, t528));
    let t529 = t185.neg_mul_add(t516, t213.mul_add(t515, t68 * t335));
    let t530 = t137.neg_mul_add(t521, t157.neg_mul_add(t519, t529));
    let t531 = t92.mul_add(t526, t116.neg_mul_add(t523, t530));
    let t532 = t82.mul_add(q_4_ddot, t531);
    let t533 = t187.neg_mul_add(t516, t218.mul_add(t515, t79 * t336));
    let t534 = t139.neg_mul_add(t521, t161.neg_mul_add(t519, t533));
    let t535 = t94.neg_mul_add(t526, t120.neg_mul_add(t523, t534));
    // Back substitution: a[q[3]].
    let t536 = t85.mul_add(q_4_ddot, t535);
    let t537 = t72 * t536;
    let t538 = t153.neg_mul_add(t519, t211.neg_mul_add(t515, t43 * t331));
    let t539 = t90.mul_add(t526, t110.neg_mul_add(t523, t538));
    let t540 = t69.neg_mul_add(t536, t80.mul_add(q_4_ddot, t539));
    // Back substitution: a[q[2]]; Back substitution: a[q[1]].
    let q_1_ddot = -t46.mul_add(t532 - t537, t540);
    let q_2_ddot = t537 - t532;
    let q_3_ddot = -t536;
    let q_5_ddot = -t526;
    let sound = PIVOTS.hold(t42, t42)
        & PIVOTS.hold(t67, t66)
        & PIVOTS.hold(t78, t77)
        & PIVOTS.hold(t88, t86)
        & PIVOTS.hold(t98, n(p.k1))
        & PIVOTS.hold(t133, t133)
        & PIVOTS.hold(t150, t149)
        & PIVOTS.hold(t181, t180)
        & PIVOTS.hold(t208, t206)
        & PIVOTS.hold(t514, t512)
        & q_1_ddot.is_finite();
    if !sound {
        let pivots = [
            (0, t42, t42),
            (1, t67, t66),
            (2, t78, t77),
            (3, t88, t86),
            (4, t98, n(p.k1)),
            (5, t133, t133),
            (6, t150, t149),
            (7, t181, t180),
            (8, t208, t206),
            (9, t514, t512),
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
        -> Result<[S; 5], ::lagrangian::emitted::Singular> = multipliers_in;
}

#[inline(always)]
fn multipliers_in<S: Copy, N: ::lagrangian::emitted::Scalar<Stored = S>>(
    call: Multipliers<'_, S>,
) -> Result<[S; 5], ::lagrangian::emitted::Singular> {
    let Multipliers { p, q, v } = call;
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
    let t1 = t0.mul_add(sin_q_3, sin_q_2 * cos_q_4);
    let t2 = cos_q_2 * cos_q_3;
    let t3 = t1.mul_add(cos_q_5, sin_q_5 * t2);
    let t4 = sin_q_2 * n(p.l);
    let t5 = n(p.l) + t4;
    let t6 = cos_q_3 * cos_q_4.mul_sub(t5, t0 * n(p.l));
    let t7 = t2.neg_mul_add(n(p.l), t6);
    let t8 = t7.neg_mul_add(n(p.half_l_m), t3 * n(p.k3));
    let t9 = cos_q_4 * cos_q_5;
    let t10 = sin_q_3 * n(p.k15);
    let t11 = cos_q_2 * cos_q_4;
    let t12 = sin_q_3.mul_sub(t11, sin_q_2 * sin_q_4);
    let t13 = sin_q_5 * n(p.half_l_m);
    let t14 = t13 + n(p.k17);
    let t15 = t12 * t14;
    let t16 = t5.mul_add(t10, sin_q_2 * n(p.k6));
    let t17 = sin_q_3.mul_add(t5, t4);
    let t18 = cos_q_3 * cos_q_5;
    let t19 = sin_q_4.mul_add(t5, n(p.l) * t11) * t18;
    let t20 = sin_q_5.neg_mul_add(n(p.l).neg_mul_add(t12, t17), t19);
    let t21 = n(p.half_l_m).mul_add(t20, t12 * n(p.k1));
    let t22 = sin_q_5 * n(p.half_l_squared_m);
    let t23 = t12.mul_add(t22, n(p.k17).neg_mul_add(t17, t12 * n(p.k5)));
    let t24 = t21 + t23;
    let t25 = t8.mul_add(t9, n(p.l).neg_mul_add(t15, t16));
    let t26 = sin_q_4.neg_mul_add(t24, t25);
    let t27 = t3.mul_add(n(p.half_l_m), t2 * n(p.k17));
    let t28 = n(p.half_l_m) * t12;
    let t29 = sin_q_4 * cos_q_5;
    let t30 = sin_q_3 * sin_q_2.neg_mul_add(n(p.k15), t15);
    let t31 = cos_q_3.mul_add(cos_q_4.mul_sub(t27, t28 * t29), t30);
    let t32 = t26 + sin_q_2.mul_add(n(p.k9), n(p.k20));
    let t33 = t6.neg_mul_add(n(p.k17), t2 * n(p.k4));
    let t34 = t3.mul_add(n(p.half_l_squared_m), t33);
    let t35 = sin_q_5.mul_add(t8, t34);
    let t36 = sin_q_4.mul_add(t27, t9 * t28);
    let t37 = n(p.l).mul_add(t36, t2.mul_add(n(p.k7), t35));
    let t38 = cos_q_4.mul_add(t24, t8 * t29);
    let t39 = sin_q_2.neg_mul_add(n(p.k13), t31);
    let t40 = cos_q_3.mul_add(t37, sin_q_3 * t38);
    let t41 = cos_q_2.mul_add(t40, n(p.l).neg_mul_add(t39, n(p.k10)));
    // Row q[1]: pivot d[q[1]].
    let t42 = sin_q_2.mul_add(n(p.l).neg_mul_add(t31, t32), t41);
    let t43 = N::ONE / t42;
    let t44 = cos_q_3.mul_sub(t38, n(p.l) * t2.mul_add(n(p.k15), t36));
    let t45 = sin_q_3.neg_mul_add(t37, t44);
    // Eliminates q[1] from row q[2]: l[q[2], q[1]].
    let t46 = t43 * t45;
    let t47 = sin_q_3 * n(p.l);
    let t48 = n(p.l) + t47;
    let t49 = sin_q_4 * t48;
    let t50 = sin_q_4.mul_sub(t18, sin_q_3 * sin_q_5);
    let t51 = n(p.half_l_m).mul_sub(t47 + t49, n(p.k3) * t50);
    let t52 = n(p.k17).mul_add(t49, sin_q_3 * n(p.k4));
    let t53 = n(p.half_l_squared_m).neg_mul_add(t50, t52);
    let t54 = sin_q_5.mul_add(t51, t53);
    let t55 = cos_q_4 * n(p.half_l_m);
    let t56 = n(p.half_l_m).neg_mul_add(t50, sin_q_3 * n(p.k17));
    let t57 = sin_q_4.mul_sub(t56, t55 * (cos_q_4 * t18));
    let t58 = t54 + sin_q_3.mul_add(n(p.k7), n(p.k21));
    let t59 = cos_q_3 * sin_q_5;
    let t60 = cos_q_4 * cos_q_3;
    let t61 = cos_q_5.mul_sub(t48, n(p.l) * t59);
    let t62 = t55.mul_sub(t61, n(p.k1) * t60);
    let t63 = t60.neg_mul_add(n(p.k5) + t22, t62);
    let t64 = n(p.l).mul_add(t10 + t57, n(p.k8));
    let t65 = cos_q_3.neg_mul_add(cos_q_4.mul_add(t63, t29 * t51), t64);
    let t66 = sin_q_3.mul_add(n(p.l).mul_add(t57, t58), t65);
    // Row q[2]: pivot d[q[2]].
    let t67 = t45.neg_mul_add(t46, t66);
    let t68 = N::ONE / t67;
    // Eliminates q[1] from row q[3]: l[q[3], q[1]].
    let t69 = t26 * t43;
    let t70 = t9.mul_add(t51, t14 * (n(p.l) * t60));
    let t71 = t45.mul_add(t69, sin_q_4.neg_mul_add(t63, t70));
    // Eliminates q[2] from row q[3]: l[q[3], q[2]].
    let t72 = t68 * t71;
    let t73 = sin_q_4 * n(p.l);
    let t74 = t13.mul_add(n(p.l) + t73, sin_q_4 * n(p.k1));
    let t75 = sin_q_4.mul_add(t22, sin_q_4.mul_add(n(p.k5), n(p.k22)));
    let t76 = t14.mul_add(t73, t9.mul_add(n(p.k3) * t9, n(p.k6)));
    let t77 = sin_q_4.mul_add(t74 + t75, t76);
    // Row q[3]: pivot d[q[3]].
    let t78 = t71.neg_mul_add(t72, t26.neg_mul_add(t69, t77));
    let t79 = N::ONE / t78;
    // Eliminates q[1] from row q[4]: l[q[4], q[1]].
    let t80 = t35 * t43;
    let t81 = t45.mul_add(t80, t54);
    // Eliminates q[2] from row q[4]: l[q[4], q[2]].
    let t82 = t68 * t81;
    let t83 = sin_q_5.mul_add(n(p.k3), n(p.half_l_squared_m));
    let t84 = t71.neg_mul_add(t82, t26.neg_mul_add(t80, t9 * t83));
    // Eliminates q[3] from row q[4]: l[q[4], q[3]].
    let t85 = t79 * t84;
    let t86 = sin_q_5.mul_add(n(p.half_l_squared_m) + t83, n(p.k4));
    let t87 = t81.neg_mul_add(t82, t35.neg_mul_add(t80, t86));
    // Row q[4]: pivot d[q[4]].
    let t88 = t84.neg_mul_add(t85, t87);
    let t89 = N::ONE / t88;
    // Eliminates q[1] from row q[5]: l[q[5], q[1]].
    let t90 = t21 * t43;
    let t91 = t45.mul_add(t90, t62);
    // Eliminates q[2] from row q[5]: l[q[5], q[2]].
    let t92 = t68 * t91;
    let t93 = t71.mul_add(t92, t26.mul_add(t90, t74));
    // Eliminates q[3] from row q[5]: l[q[5], q[3]].
    let t94 = t79 * t93;
    let t95 = t84.neg_mul_add(t94, t81.mul_add(t92, t35 * t90));
    // Eliminates q[4] from row q[5]: l[q[5], q[4]].
    let t96 = t89 * t95;
    let t97 = t91.neg_mul_add(t92, t21.neg_mul_add(t90, n(p.k1)));
    // Row q[5]: pivot d[q[5]].
    let t98 = t95.neg_mul_add(t96, t93.neg_mul_add(t94, t97));
    let t99 = N::ONE / t98;
    let t100 = sin_q_5.mul_add(n(p.l), n(p.l));
    let t101 = sin_q_4.mul_add(t100, n(p.l));
    let t102 = sin_q_3 * t101;
    let t103 = n(p.l) * t18;
    let t104 = t11 * t100;
    let t105 = sin_q_2.mul_add(t102 - t103, t5 - t104);
    let t106 = cos_q_5 * n(p.l);
    let t107 = sin_q_3 * t106;
    let t108 = cos_q_3.mul_add(t101, t107);
    let t109 = t105.neg_mul_add(sin_q_1, cos_q_1 * t108);
    // Eliminates q[1] from row along: l[along, q[1]].
    let t110 = t43 * t109;
    let t111 = cos_q_4 * t100;
    let t112 = sin_q_2 * cos_q_1;
    let t113 = t102 + (n(p.l) - t103);
    let t114 = t113.mul_add(cos_q_2 * cos_q_1, t111 * t112);
    let t115 = t45.mul_add(t110, t114);
    // Eliminates q[2] from row along: l[along, q[2]].
    let t116 = t68 * t115;
    let t117 = sin_q_3 * t101.mul_sub(sin_q_1, t106 * t112);
    let t118 = cos_q_3.mul_sub(t101.mul_add(t112, sin_q_1 * t106), t117);
    let t119 = t71.neg_mul_add(t116, t26.neg_mul_add(t110, t118));
    // Eliminates q[3] from row along: l[along, q[3]].
    let t120 = t79 * t119;
    let t121 = sin_q_3.mul_add(t112, cos_q_3 * sin_q_1);
    let t122 = t100 * cos_q_4.mul_add(t121, t0 * cos_q_1);
    let t123 = t81.neg_mul_add(t116, t35.neg_mul_add(t110, t122));
    let t124 = t84.neg_mul_add(t120, t123);
    // Eliminates q[4] from row along: l[along, q[4]].
    let t125 = t89 * t124;
    let t126 = sin_q_4.neg_mul_add(t121, t11 * cos_q_1);
    let t127 = cos_q_3.mul_sub(t112, sin_q_3 * sin_q_1);
    let t128 = n(p.l) * cos_q_5.mul_sub(t126, sin_q_5 * t127);
    let t129 = t91.neg_mul_add(t116, t21.neg_mul_add(t110, t128));
    let t130 = t95.mul_add(t125, t93.mul_add(t120, t129));
    // Eliminates q[5] from row along: l[along, q[5]].
    let t131 = t99 * t130;
    let t132 = t119.mul_add(t120, t115.mul_add(t116, t109 * t110));
    // Row along: pivot d[along].
    let t133 = t130.mul_add(t131, t124.mul_add(t125, t132));
    let t134 = N::ONE / t133;
    let t135 = sin_q_4 * sin_q_3;
    let t136 = sin_q_2.neg_mul_add(t100.mul_add(t135, t48 - t103), t104);
    // Eliminates q[2] from row up: l[up, q[2]].
    let t137 = t68 * t136;
    let t138 = t71.neg_mul_add(t137, t2.mul_add(t101, cos_q_2 * t107));
    // Eliminates q[3] from row up: l[up, q[3]].
    let t139 = t79 * t138;
    let t140 = t84.neg_mul_add(t139, t81.neg_mul_add(t137, t12 * t100));
    // Eliminates q[4] from row up: l[up, q[4]].
    let t141 = t89 * t140;
    let t142 = t93.neg_mul_add(t139, t91.mul_add(t137, t3 * n(p.l)));
    let t143 = t95.neg_mul_add(t141, t142);
    // Eliminates q[5] from row up: l[up, q[5]].
    let t144 = t99 * t143;
    let t145 = t124.mul_add(t141, t119.mul_add(t139, t115 * t137));
    let t146 = t130.neg_mul_add(t144, t145);
    // Eliminates along from row up: l[up, along].
    let t147 = t134 * t146;
    let t148 = t138.mul_add(t139, t136 * t137);
    let t149 = t143.mul_add(t144, t140 * t141) + t148;
    // Row up: pivot d[up].
    let t150 = t146.neg_mul_add(t147, t149);
    let t151 = N::ONE / t150;
    let t152 = t105.mul_add(cos_q_1, sin_q_1 * t108);
    // Eliminates q[1] from row across: l[across, q[1]].
    let t153 = t43 * t152;
    let t154 = sin_q_2 * sin_q_1;
    let t155 = cos_q_2 * sin_q_1;
    let t156 = t45.mul_add(t153, t113.mul_add(t155, t111 * t154));
    // Eliminates q[2] from row across: l[across, q[2]].
    let t157 = t68 * t156;
    let t158 = cos_q_3 * t101.mul_sub(t154, cos_q_1 * t106);
    let t159 = sin_q_3.mul_add(t101.mul_add(cos_q_1, t106 * t154), t158);
    let t160 = t71.neg_mul_add(t157, t26.neg_mul_add(t153, t159));
    // Eliminates q[3] from row across: l[across, q[3]].
    let t161 = t79 * t160;
    let t162 = sin_q_3.neg_mul_add(t154, cos_q_3 * cos_q_1);
    let t163 = cos_q_4.mul_sub(t162, t0 * sin_q_1);
    let t164 = t81.mul_add(t157, t35.mul_add(t153, t100 * t163));
    let t165 = t84.mul_add(t161, t164);
    // Eliminates q[4] from row across: l[across, q[4]].
    let t166 = t89 * t165;
    let t167 = sin_q_4.mul_add(t162, t11 * sin_q_1);
    let t168 = cos_q_3.mul_add(t154, sin_q_3 * cos_q_1);
    let t169 = n(p.l) * cos_q_5.mul_sub(t167, sin_q_5 * t168);
    let t170 = t91.neg_mul_add(t157, t21.neg_mul_add(t153, t169));
    let t171 = t95.neg_mul_add(t166, t93.mul_add(t161, t170));
    // Eliminates q[5] from row across: l[across, q[5]].
    let t172 = t99 * t171;
    let t173 = t119.mul_add(t161, t115.mul_add(t157, t109 * t153));
    let t174 = t130.mul_add(t172, t124.neg_mul_add(t166, t173));
    // Eliminates along from row across: l[across, along].
    let t175 = t134 * t174;
    let t176 = t140.neg_mul_add(t166, t138.mul_add(t161, t136 * t157));
    let t177 = t146.neg_mul_add(t175, t143.neg_mul_add(t172, t176));
    // Eliminates up from row across: l[across, up].
    let t178 = t151 * t177;
    let t179 = t171.mul_add(t172, t156.mul_add(t157, t152 * t153));
    let t180 = t179 + t165.mul_add(t166, t160 * t161);
    // Row across: pivot d[across].
    let t181 = t177.neg_mul_add(t178, t174.neg_mul_add(t175, t180));
    let t182 = N::ONE / t181;
    let t183 = sin_q_3.mul_add(t29, t59);
    let t184 = sin_q_2.neg_mul_add(t183, cos_q_5 * t11);
    // Eliminates q[2] from row tips: l[tips, q[2]].
    let t185 = t68 * t184;
    let t186 = t71.neg_mul_add(t185, cos_q_2 * t50);
    // Eliminates q[3] from row tips: l[tips, q[3]].
    let t187 = t79 * t186;
    let t188 = t81.neg_mul_add(t185, cos_q_5 * t12);
    let t189 = t84.neg_mul_add(t187, t188);
    // Eliminates q[4] from row tips: l[tips, q[4]].
    let t190 = t89 * t189;
    let t191 = cos_q_2 * t18;
    let t192 = t91.mul_add(t185, t1.neg_mul_add(sin_q_5, t191));
    let t193 = t95.neg_mul_add(t190, t93.neg_mul_add(t187, t192));
    // Eliminates q[5] from row tips: l[tips, q[5]].
    let t194 = t99 * t193;
    let t195 = t124.mul_add(t190, t119.mul_add(t187, t115 * t185));
    let t196 = t130.neg_mul_add(t194, t195);
    // Eliminates along from row tips: l[tips, along].
    let t197 = t134 * t196;
    let t198 = t140.mul_add(t190, t138.mul_add(t187, t136 * t185));
    let t199 = t146.neg_mul_add(t197, t143.mul_add(t194, t198));
    // Eliminates up from row tips: l[tips, up].
    let t200 = t151 * t199;
    let t201 = t165.neg_mul_add(t190, t160.mul_add(t187, t156 * t185));
    let t202 = t174.neg_mul_add(t197, t171.neg_mul_add(t194, t201));
    let t203 = t177.neg_mul_add(t200, t202);
    // Eliminates across from row tips: l[tips, across].
    let t204 = t182 * t203;
    let t205 = t186.mul_add(t187, t184 * t185);
    let t206 = t193.mul_add(t194, t189 * t190) + t205;
    let t207 = t199.neg_mul_add(t200, t196.neg_mul_add(t197, t206));
    // Row tips: pivot d[tips].
    let t208 = t203.neg_mul_add(t204, t207);
    let t209 = N::ONE / t208;
    let t210 = cos_q_1.mul_sub(t184, t50 * sin_q_1);
    // Eliminates q[1] from row turns: l[turns, q[1]].
    let t211 = t43 * t210;
    let t212 = t45.neg_mul_add(t211, t155.mul_add(t183, t9 * t154));
    // Eliminates q[2] from row turns: l[turns, q[2]].
    let t213 = t68 * t212;
    let t214 = cos_q_3 * t29.mul_add(t154, sin_q_5 * cos_q_1);
    let t215 = t29.mul_sub(cos_q_1, sin_q_5 * t154);
    let t216 = t26.mul_add(t211, sin_q_3.mul_add(t215, t214));
    let t217 = t71.neg_mul_add(t213, t216);
    // Eliminates q[3] from row turns: l[turns, q[3]].
    let t218 = t79 * t217;
    let t219 = t81.mul_add(t213, t35.neg_mul_add(t211, cos_q_5 * t163));
    let t220 = t84.mul_add(t218, t219);
    // Eliminates q[4] from row turns: l[turns, q[4]].
    let t221 = t89 * t220;
    let t222 = sin_q_5.mul_add(t167, cos_q_5 * t168);
    let t223 = t91.mul_add(t213, t21.neg_mul_add(t211, t222));
    let t224 = t95.mul_add(t221, t93.neg_mul_add(t218, t223));
    // Eliminates q[5] from row turns: l[turns, q[5]].
    let t225 = t99 * t224;
    let t226 = t115.neg_mul_add(t213, t109 * t211);
    let t227 = t124.mul_add(t221, t119.neg_mul_add(t218, t226));
    let t228 = t130.mul_add(t225, t227);
    // Eliminates along from row turns: l[turns, along].
    let t229 = t134 * t228;
    let t230 = t140.neg_mul_add(t221, t138.mul_add(t218, t136 * t213));
    let t231 = t146.mul_add(t229, t143.mul_add(t225, t230));
    // Eliminates up from row turns: l[turns, up].
    let t232 = t151 * t231;
    let t233 = t156.neg_mul_add(t213, t152 * t211);
    let t234 = t165.neg_mul_add(t221, t160.neg_mul_add(t218, t233));
    let t235 = t174.neg_mul_add(t229, t171.mul_add(t225, t234));
    let t236 = t177.mul_add(t232, t235);
    // Eliminates across from row turns: l[turns, across].
    let t237 = t182 * t236;
    let t238 = t189.neg_mul_add(t221, t186.mul_add(t218, t184 * t213));
    let t239 = t196.mul_add(t229, t193.mul_add(t225, t238));
    let t240 = t203.mul_add(t237, t199.neg_mul_add(t232, t239));
    // Eliminates tips from row turns: l[turns, tips].
    let t241 = t209 * t240;
    let t242 = sin_q_2 * q_1_dot;
    let t243 = n(p.l) * q_1_dot;
    let t244 = t242.mul_add(t242, q_2_dot * q_2_dot);
    let t245 = n(p.l).mul_add(t244, t242.mul_add(t243, cos_q_2 * n(p.g)));
    let t246 = cos_q_2 * q_2_dot;
    let t247 = q_1_dot * t246;
    let t248 = t247 * n(p.two_l);
    let t249 = cos_q_3.mul_sub(t245, sin_q_3 * t248);
    let t250 = cos_q_2 * q_1_dot;
    let t251 = sin_q_3.neg_mul_add(t250, cos_q_3 * q_2_dot);
    let t252 = t2.mul_add(q_1_dot, sin_q_3 * q_2_dot);
    let t253 = t251 * t252;
    let t254 = t247 - t253;
    let t255 = n(p.l).neg_mul_add(t254, t249);
    let t256 = t242 + q_3_dot;
    let t257 = cos_q_4.mul_sub(t256, sin_q_4 * t251);
    let t258 = t242 * q_2_dot;
    let t259 = sin_q_3.mul_sub(t258, t252 * q_3_dot);
    let t260 = cos_q_4.mul_add(t259, sin_q_4 * t247);
    let t261 = t257.mul_add(q_4_dot, t260);
    let t262 = t252 + q_4_dot;
    let t263 = t257 * t262;
    let t264 = t261 + t263;
    let t265 = t252.mul_add(t252, t256 * t256);
    let t266 = sin_q_3.mul_add(t245, cos_q_3 * t248);
    let t267 = n(p.l).mul_add(t265, t266);
    let t268 = t243.neg_mul_add(t250, sin_q_2 * n(p.g));
    let t269 = t242 * t250;
    let t270 = n(p.l).neg_mul_add(t269, t268);
    let t271 = cos_q_3.mul_sub(t258, t251 * q_3_dot);
    let t272 = t251 * t256;
    let t273 = t271 - t272;
    let t274 = n(p.l).neg_mul_add(t273, t270);
    let t275 = cos_q_4.mul_add(t251, sin_q_4 * t256);
    let t276 = t275.mul_add(t275, t262 * t262);
    let t277 = sin_q_4.mul_add(t267, cos_q_4 * t274);
    let t278 = sin_q_5 * n(p.l).neg_mul_add(t264, t255);
    let t279 = sin_q_5.neg_mul_add(t257, cos_q_5 * t262);
    let t280 = cos_q_5.mul_add(t257, sin_q_5 * t262);
    let t281 = t279 * t280;
    let t282 = cos_q_5.mul_add(n(p.l).mul_add(t276, t277), t278);
    let t283 = n(p.k1).mul_sub(t261, n(p.k3) * t281);
    let t284 = n(p.half_l_m).neg_mul_add(t282, t283);
    let t285 = t261 - t281;
    let t286 = t275 + q_5_dot;
    let t287 = t280.mul_add(t280, t286 * t286);
    let t288 = sin_q_5.mul_add(t285, cos_q_5 * t287);
    let t289 = n(p.k5).mul_add(t261, n(p.k4) * t263);
    let t290 = n(p.k17).neg_mul_add(t255, t289);
    let t291 = t284 + n(p.half_l_squared_m).mul_add(t288, t290);
    let t292 = n(p.half_l_m).mul_add(t288, n(p.k17) * t264);
    let t293 = n(p.k7).neg_mul_add(t253, n(p.k6) * t247);
    let t294 = n(p.l).mul_add(t292, n(p.k15).neg_mul_add(t249, t293));
    let t295 = cos_q_4.mul_sub(t267, sin_q_4 * t274);
    let t296 = t257 * t275;
    let t297 = t271 + t296;
    let t298 = sin_q_4.neg_mul_add(t259, cos_q_4 * t247);
    let t299 = q_4_dot.neg_mul_add(t275, t298);
    let t300 = cos_q_5.mul_sub(t299, sin_q_5 * t271);
    let t301 = t279.mul_add(q_5_dot, t300);
    let t302 = t279 * t286;
    let t303 = n(p.k3).mul_add(t301, n(p.k1) * t302);
    let t304 = n(p.l).mul_add(t297, t295);
    let t305 = n(p.half_l_m).neg_mul_add(t304, t303);
    let t306 = t280 * (t286 * n(p.k18));
    let t307 = sin_q_5.neg_mul_add(t306, t275 * (t262 * n(p.k16)));
    let t308 = cos_q_5.neg_mul_add(t305, t307);
    let t309 = cos_q_4.neg_mul_add(t308, sin_q_4.mul_add(t291, t294));
    let t310 = sin_q_5.mul_sub(t287, cos_q_5 * t285);
    let t311 = n(p.half_l_m).mul_add(t310, n(p.k17) * t276);
    let t312 = t301 + t302;
    let t313 = n(p.half_l_m).neg_mul_add(t312, n(p.k17) * t297);
    let t314 = sin_q_4.mul_add(t311, n(p.k15) * t265);
    let t315 = sin_q_3 * n(p.k15).mul_add(t254, t292);
    let t316 = cos_q_3.mul_add(cos_q_4.mul_add(t313, t314), t315);
    let t317 = sin_q_4.neg_mul_add(t308, t252 * (t256 * n(p.k14)));
    let t318 = cos_q_4.neg_mul_add(t291, t317);
    let t319 = n(p.k5).mul_add(t296, n(p.k4) * t271);
    let t320 = cos_q_5.mul_add(t306, n(p.k17).mul_add(t295, t319));
    let t321 = n(p.half_l_squared_m).neg_mul_add(t312, t320);
    let t322 = sin_q_5.neg_mul_add(t305, t321);
    let t323 = n(p.k7).mul_sub(t271, n(p.k6) * t272);
    let t324 = cos_q_4.mul_sub(t311, sin_q_4 * t313);
    let t325 = t322 + n(p.k15).neg_mul_add(t270, t323);
    let t326 = n(p.l).neg_mul_add(t324, t325);
    let t327 = cos_q_3.mul_add(t326, t258 * n(p.k12));
    let t328 = n(p.l) * t247.mul_add(n(p.k23), t316);
    let t329 = cos_q_2.mul_add(sin_q_3.mul_sub(t318, t327), t328);
    let t330 = n(p.l).mul_add(t316, t247.mul_add(n(p.k11), t309));
    let t331 = sin_q_2.mul_add(t330, t329);
    let t332 = n(p.k13).mul_sub(t268, n(p.k9) * t269);
    let t333 = n(p.l).mul_add(n(p.k15).neg_mul_add(t273, t324), t332);
    let t334 = cos_q_3.neg_mul_add(t318, sin_q_3.neg_mul_add(t326, t333));
    // Row q[2]: right-hand side z[q[2]].
    let t335 = t46.mul_add(t331, t334);
    // Row q[3]: right-hand side z[q[3]].
    let t336 = t72.neg_mul_add(t335, t69.neg_mul_add(t331, t309));
    let t337 = t82.mul_add(t335, t80.mul_add(t331, t322));
    // Row q[4]: right-hand side z[q[4]].
    let t338 = t85.mul_add(t336, t337);
    let t339 = sin_q_1 * q_1_dot;
    let t340 = t242 * t339;
    let t341 = sin_q_3 * t246;
    let t342 = cos_q_1 * q_1_dot;
    let t343 = t341 * t342;
    let t344 = cos_q_3 * q_3_dot;
    let t345 = cos_q_1 * t242;
    let t346 = t344 * t345;
    let t347 = sin_q_1 * t246;
    let t348 = t344 * t347;
    let t349 = sin_q_2 * q_2_dot;
    let t350 = q_2_dot * t349;
    let t351 = sin_q_1 * t350;
    let t352 = sin_q_3.neg_mul_add(t351, t343 + t348);
    let t353 = sin_q_3 * q_3_dot;
    let t354 = q_3_dot * t353;
    let t355 = sin_q_3.mul_sub(t340, t343) - t346 - t352;
    let t356 = t339 * t353;
    let t357 = q_1_dot * t342;
    let t358 = q_3_dot * t344;
    let t359 = cos_q_1.neg_mul_add(t358, t356);
    let t360 = t355 - t154.neg_mul_add(t354, t346 + t348);
    let t361 = cos_q_3.mul_sub(t357, t356) - t359 - t360;
    let t362 = sin_q_2.mul_add(t344, t341);
    let t363 = cos_q_1.mul_add(t353, cos_q_3 * t339);
    let t364 = sin_q_1.mul_add(t362, sin_q_3 * t345) + t363;
    let t365 = cos_q_4 * q_4_dot;
    let t366 = t364 * t365;
    let t367 = sin_q_4 * q_4_dot;
    let t368 = q_4_dot * t367;
    let t369 = cos_q_4 * cos_q_1;
    let t370 = t258 * t369;
    let t371 = cos_q_4 * sin_q_1;
    let t372 = q_2_dot * t246;
    let t373 = t349 * t367;
    let t374 = sin_q_1 * t373;
    let t375 = q_1_dot * t339;
    let t376 = t0 * q_4_dot;
    let t377 = t342 * t376;
    let t378 = t371.mul_add(t372, t370) - t374;
    let t379 = t11 * q_4_dot;
    let t380 = q_4_dot * t379;
    let t381 = t378 + (t11.mul_add(t375, t370) + t377);
    let t382 = sin_q_4.mul_add(t361, t366) + t162.mul_add(t368, t366);
    let t383 = t382 + (t381 + sin_q_1.mul_add(t380, t377 - t374));
    let t384 = t246 * t342;
    let t385 = cos_q_4.mul_add(t349, t376);
    let t386 = sin_q_1.neg_mul_add(t385, t11 * t342);
    let t387 = t386 - sin_q_4.mul_sub(t364, t162 * t365);
    let t388 = cos_q_5 * q_5_dot;
    let t389 = t387 * t388;
    let t390 = sin_q_5 * q_5_dot;
    let t391 = q_5_dot * t390;
    let t392 = sin_q_5.neg_mul_add(t383, t389);
    let t393 = t347 * t353;
    let t394 = t345 * t353;
    let t395 = cos_q_3 * t246;
    let t396 = t342 * t395;
    let t397 = cos_q_3.mul_add(t340, t394) - t396;
    let t398 = cos_q_3.neg_mul_add(t351, t396 - t393);
    let t399 = t339 * t344;
    let t400 = cos_q_1.mul_add(t354, t399) + sin_q_3.mul_add(t357, t399);
    let t401 = t154.mul_add(t358, t393 + t394) + t397 - t398 + t400;
    let t402 = sin_q_2.neg_mul_add(t353, t395);
    let t403 = sin_q_3.mul_sub(t339, cos_q_1 * t344);
    let t404 = sin_q_1.mul_add(t402, cos_q_3 * t345) - t403;
    let t405 = t390 * t404;
    let t406 = q_5_dot * t388;
    let t407 = cos_q_5.mul_add(t401, t405) + t168.mul_add(t406, t405);
    let t408 = t375 + (t340 - t384 - (t384 - t351)) - t361 - t383;
    let t409 = t408 - (t407 - (t392 + t167.neg_mul_add(t391, t389)));
    let t410 = t157.mul_add(t335, t153.mul_add(t331, n(p.l) * t409));
    let t411 = t92.mul_add(t335, t90.mul_add(t331, t284));
    // Row q[5]: right-hand side z[q[5]].
    let t412 = t96.mul_add(t338, t94.neg_mul_add(t336, t411));
    let t413 = t166.mul_add(t338, t161.mul_add(t336, t410));
    let t414 = t339 * t341;
    let t415 = cos_q_1 * t246;
    let t416 = t344 * t415;
    let t417 = cos_q_1 * t350;
    let t418 = t242 * t342;
    let t419 = sin_q_1 * t242;
    let t420 = t344 * t419;
    let t421 = sin_q_3.mul_add(t418, t414) + t420;
    let t422 = sin_q_3.mul_add(t417, t414 - t416) + t421;
    let t423 = t342 * t353;
    let t424 = sin_q_1.mul_add(t358, t423) + cos_q_3.mul_add(t375, t423);
    let t425 = t422 + (t112.mul_add(t354, t420) - t416) + t424;
    let t426 = cos_q_1.neg_mul_add(t362, sin_q_3 * t419);
    let t427 = cos_q_3.mul_sub(t342, sin_q_1 * t353) - t426;
    let t428 = t365 * t427;
    let t429 = sin_q_4.neg_mul_add(t425, t428);
    let t430 = t258 * t371;
    let t431 = t339 * t376;
    let t432 = cos_q_1 * t373;
    let t433 = t369.neg_mul_add(t372, t430 + t432);
    let t434 = cos_q_1.neg_mul_add(t380, t431 + t432);
    let t435 = t11.mul_sub(t357, t430) - t431 - t433 - t434;
    let t436 = t429 + t121.neg_mul_add(t368, t428) + t435;
    let t437 = sin_q_4.mul_add(t427, t121 * t365);
    let t438 = t388 * (t437 + cos_q_1.mul_add(t385, t11 * t339));
    let t439 = t353 * t415;
    let t440 = t339 * t395;
    let t441 = t353 * t419;
    let t442 = cos_q_3.mul_add(t418, t440) - t441;
    let t443 = cos_q_3.mul_add(t417, t439 + t440) + t442;
    let t444 = t342 * t344;
    let t445 = sin_q_1.neg_mul_add(t354, t444);
    let t446 = t443 - t112.neg_mul_add(t358, t441 - t439);
    let t447 = cos_q_1.neg_mul_add(t402, cos_q_3 * t419);
    let t448 = t390 * (sin_q_1.mul_add(t344, sin_q_3 * t342) + t447);
    let t449 = t446 - (sin_q_3.mul_sub(t375, t444) - t445);
    let t450 = cos_q_5.neg_mul_add(t449, t448);
    let t451 = sin_q_5.mul_add(t436, t438) + t126.mul_add(t391, t438);
    let t452 = t246 * t339;
    let t453 = t425 + (t357 + (t418 + t452 + (t417 + t452))) - t436;
    let t454 = t450 + t127.neg_mul_add(t406, t448) - t451 + t453;
    let t455 = t116.mul_add(t335, t110.mul_add(t331, n(p.l) * t454));
    let t456 = t125.neg_mul_add(t338, t120.mul_add(t336, t455));
    // Row along: right-hand side z[along].
    let t457 = t131.neg_mul_add(t412, t456);
    let t458 = sin_q_4 * t344;
    let t459 = t349 * t458;
    let t460 = t344 * t379;
    let t461 = sin_q_3 * t365;
    let t462 = t349 * t461;
    let t463 = t135.mul_add(t372, t459) + t462;
    let t464 = t376.mul_add(sin_q_3 * q_4_dot, t462) - t460;
    let t465 = t246 * t367;
    let t466 = t365.mul_add(sin_q_2 * q_4_dot, t465);
    let t467 = t0.mul_add(t354, t459) - t460 + t463 + t464;
    let t468 = t467 + (t466 + cos_q_4.mul_add(t350, t465));
    let t469 = cos_q_2.neg_mul_add(t458 + t461, t135 * t349);
    let t470 = cos_q_4.mul_sub(t246, sin_q_2 * t367) - t469;
    let t471 = t388 * t470;
    let t472 = sin_q_5.neg_mul_add(t468, t471);
    let t473 = t349 * t353;
    let t474 = cos_q_5 * t473;
    let t475 = t390 * (cos_q_3 * t349);
    let t476 = cos_q_2 * t353;
    let t477 = t390 * t476;
    let t478 = cos_q_2 * t358;
    let t479 = cos_q_5.neg_mul_add(t478, t474 + t477);
    let t480 = t191.neg_mul_add(q_5_dot * q_5_dot, t475 + t477);
    let t481 = t18.mul_sub(t372, t474) - t475 - t479 - t480;
    let t482 = t344 * t349;
    let t483 = cos_q_2.mul_add(t354, t482) + sin_q_3.mul_add(t372, t482);
    let t484 = t472 + t1.neg_mul_add(t391, t471) + t481;
    let t485 = t137.mul_add(t335, n(p.l) * (t468 + (t372 + t483) - t484));
    let t486 = t141.neg_mul_add(t338, t139.mul_add(t336, t485));
    // Row up: right-hand side z[up].
    let t487 = t147.neg_mul_add(t457, t144.mul_add(t412, t486));
    let t488 = t175.neg_mul_add(t457, t172.neg_mul_add(t412, t413));
    // Row across: right-hand side z[across].
    let t489 = t178.neg_mul_add(t487, t488);
    let t490 = t388 * t476;
    let t491 = t349 * (t18 * q_5_dot);
    let t492 = sin_q_5 * t473;
    let t493 = t59.mul_add(t372, t491) - t492;
    let t494 = sin_q_5.neg_mul_add(t478, t492 - t490);
    let t495 = t390 * t470;
    let t496 = cos_q_5.mul_add(t468, t495) + t1.mul_add(t406, t495);
    let t497 = t2.mul_add(t391, t490 + t491) + t493 - t494 + t496;
    let t498 = t187.mul_add(t336, t185.mul_add(t335, t497));
    let t499 = t194.mul_add(t412, t190.neg_mul_add(t338, t498));
    let t500 = t200.neg_mul_add(t487, t197.neg_mul_add(t457, t499));
    // Row tips: right-hand side z[tips].
    let t501 = t204.neg_mul_add(t489, t500);
    let t502 = t387 * t390;
    let t503 = t388 * t404;
    let t504 = sin_q_5.neg_mul_add(t401, t503);
    let t505 = cos_q_5.mul_add(t383, t502) + t167.mul_add(t406, t502);
    let t506 = t505 + (t504 + t168.neg_mul_add(t391, t503));
    let t507 = t213.neg_mul_add(t335, t211.mul_add(t331, t506));
    let t508 = t221.neg_mul_add(t338, t218.neg_mul_add(t336, t507));
    let t509 = t229.neg_mul_add(t457, t225.neg_mul_add(t412, t508));
    let t510 = t237.neg_mul_add(t489, t232.mul_add(t487, t509));
    let t511 = t224.mul_add(t225, t212.mul_add(t213, t210 * t211));
    let t512 = t511 + t220.mul_add(t221, t217 * t218);
    let t513 = t231.neg_mul_add(t232, t228.neg_mul_add(t229, t512));
    // Row turns: pivot d[turns].
    let t514 = t240.neg_mul_add(t241, t236.neg_mul_add(t237, t513));
    // Row turns: right-hand side z[turns].
    let t515 = t241.mul_add(t501, t510) / t514;
    // Back substitution: lambda[tips].
    let lambda4 = t241.mul_add(t515, t209 * t501);
    let t516 = t229.neg_mul_add(t515, t134 * t457);
    let t517 = t237.neg_mul_add(t515, t182 * t489);
    let t518 = t204 * lambda4;
    // Back substitution: lambda[across].
    let t519 = t517 - t518;
    let t520 = t200.neg_mul_add(lambda4, t232.mul_add(t515, t151 * t487));
    let t521 = t178 * t519;
    let t522 = t175.neg_mul_add(t519, t197.neg_mul_add(lambda4, t516));
    // Back substitution: lambda[up]; Back substitution: lambda[along].
    let lambda1 = t147.neg_mul_add(t520 - t521, t522);
    let lambda2 = t521 - t520;
    let lambda3 = t518 - t517;
    let lambda5 = -t515;
    let sound = PIVOTS.hold(t42, t42)
        & PIVOTS.hold(t67, t66)
        & PIVOTS.hold(t78, t77)
        & PIVOTS.hold(t88, t86)
        & PIVOTS.hold(t98, n(p.k1))
        & PIVOTS.hold(t133, t133)
        & PIVOTS.hold(t150, t149)
        & PIVOTS.hold(t181, t180)
        & PIVOTS.hold(t208, t206)
        & PIVOTS.hold(t514, t512)
        & lambda1.is_finite();
    if !sound {
        let pivots = [
            (0, t42, t42),
            (1, t67, t66),
            (2, t78, t77),
            (3, t88, t86),
            (4, t98, n(p.k1)),
            (5, t133, t133),
            (6, t150, t149),
            (7, t181, t180),
            (8, t208, t206),
            (9, t514, t512),
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

::lagrangian::emitted::fast_function! {
    /// Residuals of positions and rates, rows of `G`, the smallest displacements onto the
    /// constraints, and how independent these are. Only for machines whose constraints
    /// are independent.
    ///
    /// A pivot that vanishes is an error.
    pub fn projection<'a, S>(ProjectionCall { p: &'a Prepared<S>, q: &'a [S; 5], v: &'a [S; 5] })
        -> Result<[S; 70], ::lagrangian::emitted::Singular> = projection_in;
}

#[inline(always)]
fn projection_in<S: Copy, N: ::lagrangian::emitted::Scalar<Stored = S>>(
    call: ProjectionCall<'_, S>,
) -> Result<[S; 70], ::lagrangian::emitted::Singular> {
    let ProjectionCall { p, q, v } = call;
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
    let angles = [q_2, q_1, q_3, q_4, q_5];
    let circular = N::sin_cos_all(angles);
    let (sin_q_2, cos_q_2) = circular[0];
    let (sin_q_1, cos_q_1) = circular[1];
    let (sin_q_3, cos_q_3) = circular[2];
    let (sin_q_4, cos_q_4) = circular[3];
    let (sin_q_5, cos_q_5) = circular[4];
    let t0 = sin_q_2 * cos_q_1;
    let t1 = t0.mul_add(sin_q_3, sin_q_1 * cos_q_3);
    let t2 = cos_q_2 * cos_q_4;
    let t3 = t1.neg_mul_add(sin_q_4, cos_q_1 * t2);
    let t4 = t0.mul_sub(cos_q_3, sin_q_1 * sin_q_3);
    let t5 = t3.mul_add(sin_q_5, cos_q_5 * t4);
    let r0 = (t1 + (cos_q_1 + t0) - t3 - t5) * n(p.l);
    let t6 = cos_q_2 * sin_q_4;
    let t7 = sin_q_3.mul_add(t6, sin_q_2 * cos_q_4);
    let t8 = cos_q_2 * sin_q_3;
    let t9 = cos_q_2 * cos_q_3;
    let r29 = sin_q_5.neg_mul_add(t7, cos_q_5 * t9);
    let t10 = t7 + (cos_q_2 + t8) - r29;
    let t11 = sin_q_2 * sin_q_1;
    let t12 = sin_q_3.neg_mul_add(t11, cos_q_1 * cos_q_3);
    let t13 = sin_q_4.mul_add(t12, sin_q_1 * t2);
    let t14 = cos_q_3.mul_add(t11, cos_q_1 * sin_q_3);
    let r34 = sin_q_5.mul_add(t13, cos_q_5 * t14);
    let t15 = n(p.l).mul_add(sin_q_1 + t11 - t12 - t13 - r34, n(p.l));
    let r3 = cos_q_5.mul_add(t7, sin_q_5 * t9);
    let t16 = sin_q_5 * t14;
    let t17 = cos_q_5 * t13;
    let t18 = cos_q_1 * q_1_dot;
    let t19 = sin_q_3 * q_3_dot;
    let t20 = cos_q_3 * q_3_dot;
    let t21 = sin_q_2.mul_add(t20, t8 * q_2_dot);
    let t22 = t11 * q_1_dot;
    let t23 = cos_q_1.neg_mul_add(t21, sin_q_3 * t22);
    let t24 = cos_q_3.mul_sub(t18, sin_q_1 * t19) - t23;
    let t25 = t1 * cos_q_4;
    let t26 = sin_q_2 * q_2_dot;
    let t27 = t6.mul_add(q_4_dot, cos_q_4 * t26);
    let t28 = sin_q_1 * q_1_dot;
    let t29 = sin_q_4.mul_add(t24, t25 * q_4_dot);
    let t30 = t29 + cos_q_1.mul_add(t27, t2 * t28);
    let t31 = cos_q_2 * q_2_dot;
    let t32 = cos_q_5 * q_5_dot;
    let t33 = sin_q_2.mul_sub(t19, t9 * q_2_dot);
    let t34 = cos_q_1.mul_add(t33, cos_q_3 * t22);
    let t35 = sin_q_5 * q_5_dot;
    let t36 = sin_q_1.mul_add(t20, sin_q_3 * t18) + t34;
    let t37 = cos_q_5.mul_add(t36, t4 * t35);
    let t38 = t28 + cos_q_1.neg_mul_add(t31, t22) - t24 - t30;
    let t39 = t38 - (sin_q_5.mul_sub(t30, t3 * t32) + t37);
    let t40 = sin_q_2 * sin_q_4;
    let t41 = sin_q_3 * t26;
    let t42 = cos_q_4.mul_add(sin_q_3 * q_4_dot, sin_q_4 * t20);
    let t43 = cos_q_2.neg_mul_add(t42, sin_q_4 * t41);
    let t44 = t2.mul_sub(q_2_dot, q_4_dot * t40) - t43;
    let t45 = cos_q_3 * sin_q_5;
    let t46 = cos_q_3 * cos_q_5;
    let t47 = q_5_dot.mul_add(t45, cos_q_5 * t19);
    let t48 = cos_q_2.mul_add(t47, t26 * t46);
    let t49 = t26 + t9.neg_mul_add(q_3_dot, t41) - t44;
    let r6 = n(p.l) * (t49 - (sin_q_5.mul_add(t44, t7 * t32) + t48));
    let t50 = t0 * q_1_dot;
    let t51 = cos_q_1.mul_add(t19, cos_q_3 * t28);
    let t52 = sin_q_1.mul_add(t21, sin_q_3 * t50) + t51;
    let t53 = cos_q_4 * t12;
    let t54 = sin_q_4.mul_sub(t52, q_4_dot * t53);
    let t55 = sin_q_1.neg_mul_add(t27, t2 * t18) - t54;
    let t56 = sin_q_1.neg_mul_add(t33, cos_q_3 * t50);
    let t57 = t56 - sin_q_3.mul_sub(t28, cos_q_1 * t20);
    let t58 = cos_q_5.mul_sub(t57, t14 * t35);
    let t59 = t52 + (t18 + sin_q_1.mul_add(t31, t50)) - t55;
    let t60 = t59 - (sin_q_5.mul_add(t55, t13 * t32) + t58);
    let t61 = sin_q_5.mul_sub(t19, cos_q_3 * t32);
    let t62 = cos_q_2.mul_add(t61, t26 * t45);
    let r8 = cos_q_5.mul_sub(t44, t7 * t35) - t62;
    let t63 = cos_q_5.mul_sub(t55, t13 * t35);
    let r9 = sin_q_5.mul_add(t57, t14 * t32) - t63;
    let t64 = sin_q_5.mul_add(n(p.l), n(p.l));
    let t65 = sin_q_4 * t64;
    let t66 = n(p.l) + t65;
    let t67 = sin_q_3 * t66;
    let t68 = cos_q_5 * n(p.l);
    let t69 = cos_q_3 * t68;
    let t70 = t2 * t64;
    let t71 = sin_q_2 * n(p.l);
    let t72 = n(p.l) + t71;
    let t73 = sin_q_2.mul_add(t67 - t69, t72 - t70);
    let t74 = cos_q_3.mul_add(t66, sin_q_3 * t68);
    let r10 = sin_q_1.neg_mul_add(t73, cos_q_1 * t74);
    let t75 = cos_q_4 * t64;
    let t76 = t67 + (n(p.l) - t69);
    let r11 = t76.mul_add(cos_q_2 * cos_q_1, t0 * t75);
    let t77 = sin_q_3 * sin_q_1.mul_sub(t66, t0 * t68);
    let r12 = cos_q_3.mul_sub(t0.mul_add(t66, sin_q_1 * t68), t77);
    let r13 = t64 * cos_q_1.mul_add(t6, t25);
    let t78 = t3.mul_sub(cos_q_5, sin_q_5 * t4);
    let t79 = sin_q_3 * n(p.l);
    let t80 = n(p.l) + t79;
    let r16 = sin_q_2.mul_sub(sin_q_3.mul_add(t65, t80 - t69), t70);
    let t81 = t9.mul_add(t66, t8 * t68);
    let t82 = sin_q_3.mul_sub(t2, t40);
    let t83 = t64 * t82;
    let t84 = cos_q_1.mul_add(t73, sin_q_1 * t74);
    let t85 = cos_q_2 * sin_q_1;
    let t86 = t76.mul_add(t85, t11 * t75);
    let t87 = cos_q_3 * t11.mul_sub(t66, cos_q_1 * t68);
    let t88 = sin_q_3.mul_add(cos_q_1.mul_add(t66, t11 * t68), t87);
    let t89 = sin_q_1.neg_mul_add(t6, t53);
    let r23 = t64 * t89;
    let t90 = t17 - t16;
    let r24 = n(p.l) * t90;
    let t91 = sin_q_4 * cos_q_5;
    let t92 = sin_q_3.mul_add(t91, t45);
    let r26 = sin_q_2.neg_mul_add(t92, t2 * cos_q_5);
    let t93 = cos_q_3.mul_sub(t91, sin_q_3 * sin_q_5);
    let r27 = cos_q_2 * t93;
    let r28 = cos_q_5 * t82;
    let r30 = cos_q_1.neg_mul_add(r26, sin_q_1 * t93);
    let t94 = cos_q_4 * cos_q_5;
    let r31 = t85.mul_add(t92, t11 * t94);
    let t95 = cos_q_3 * t11.mul_add(t91, cos_q_1 * sin_q_5);
    let r32 = sin_q_3.mul_add(cos_q_1.mul_sub(t91, sin_q_5 * t11), t95);
    let t96 = cos_q_5 * t89;
    let t97 = cos_q_3 * cos_q_4.mul_sub(t72, n(p.l) * t6);
    let t98 = n(p.l).neg_mul_add(t9, t97);
    let t99 = t98.neg_mul_add(n(p.half_l_m), r3 * n(p.k3));
    let t100 = sin_q_3 * n(p.k15);
    let t101 = sin_q_5 * n(p.half_l_m);
    let t102 = t101 + n(p.k17);
    let t103 = t82 * t102;
    let t104 = t72.mul_add(t100, sin_q_2 * n(p.k6));
    let t105 = sin_q_3.mul_add(t72, t71);
    let t106 = t46 * sin_q_4.mul_add(t72, t2 * n(p.l));
    let t107 = sin_q_5.neg_mul_add(n(p.l).neg_mul_add(t82, t105), t106);
    let t108 = n(p.half_l_m).mul_add(t107, t82 * n(p.k1));
    let t109 = sin_q_5 * n(p.half_l_squared_m);
    let t110 = n(p.k17).neg_mul_add(t105, t82 * n(p.k5));
    let t111 = t108 + t82.mul_add(t109, t110);
    let t112 = t94.mul_add(t99, n(p.l).neg_mul_add(t103, t104));
    let t113 = sin_q_4.neg_mul_add(t111, t112);
    let t114 = r3.mul_add(n(p.half_l_m), t9 * n(p.k17));
    let t115 = t82 * n(p.half_l_m);
    let t116 = sin_q_3 * sin_q_2.neg_mul_add(n(p.k15), t103);
    let t117 = cos_q_3.mul_add(cos_q_4.mul_sub(t114, t91 * t115), t116);
    let t118 = t113 + sin_q_2.mul_add(n(p.k9), n(p.k20));
    let t119 = t97.neg_mul_add(n(p.k17), t9 * n(p.k4));
    let t120 = r3.mul_add(n(p.half_l_squared_m), t119);
    let t121 = sin_q_5.mul_add(t99, t120);
    let t122 = sin_q_4.mul_add(t114, t94 * t115);
    let t123 = n(p.l).mul_add(t122, t9.mul_add(n(p.k7), t121));
    let t124 = cos_q_4.mul_add(t111, t91 * t99);
    let t125 = sin_q_2.neg_mul_add(n(p.k13), t117);
    let t126 = cos_q_3.mul_add(t123, sin_q_3 * t124);
    let t127 = cos_q_2.mul_add(t126, n(p.l).neg_mul_add(t125, n(p.k10)));
    let r35 = sin_q_2.mul_add(n(p.l).neg_mul_add(t117, t118), t127);
    let t128 = sin_q_4 * t80;
    let t129 = n(p.half_l_m).mul_sub(t79 + t128, t93 * n(p.k3));
    let t130 = n(p.k17).mul_add(t128, sin_q_3 * n(p.k4));
    let t131 = t93.neg_mul_add(n(p.half_l_squared_m), t130);
    let t132 = sin_q_5.mul_add(t129, t131);
    let t133 = cos_q_3 * cos_q_4;
    let t134 = t93.neg_mul_add(n(p.half_l_m), sin_q_3 * n(p.k17));
    let t135 = sin_q_4.mul_sub(t134, t133 * (t94 * n(p.half_l_m)));
    let t136 = t132 + sin_q_3.mul_add(n(p.k7), n(p.k21));
    let t137 = cos_q_5.mul_sub(t80, n(p.l) * t45);
    let t138 = t137.mul_sub(cos_q_4 * n(p.half_l_m), n(p.k1) * t133);
    let t139 = t133.neg_mul_add(n(p.k5) + t109, t138);
    let t140 = n(p.l).mul_add(t100 + t135, n(p.k8));
    let t141 = cos_q_4.mul_add(t139, t91 * t129);
    let t142 = cos_q_3.neg_mul_add(t141, t140);
    let r36 = sin_q_3.mul_add(n(p.l).mul_add(t135, t136), t142);
    let t143 = sin_q_4 * n(p.l);
    let t144 = t101.mul_add(n(p.l) + t143, sin_q_4 * n(p.k1));
    let t145 = sin_q_4.mul_add(t109, sin_q_4.mul_add(n(p.k5), n(p.k22)));
    let t146 = t102.mul_add(t143, t94.mul_add(t94 * n(p.k3), n(p.k6)));
    let r37 = sin_q_4.mul_add(t144 + t145, t146);
    let t147 = sin_q_5.mul_add(n(p.k3), n(p.half_l_squared_m));
    let r38 = sin_q_5.mul_add(n(p.half_l_squared_m) + t147, n(p.k4));
    let t148 = N::ONE / r35;
    let t149 = cos_q_3.mul_sub(t124, n(p.l) * t9.mul_add(n(p.k15), t122));
    let t150 = sin_q_3.neg_mul_add(t123, t149);
    let t151 = t148 * t150;
    let t152 = t150.neg_mul_add(t151, r36);
    let t153 = N::ONE / t152;
    let t154 = t113 * t148;
    let t155 = t94.mul_add(t129, t102 * (n(p.l) * t133));
    let t156 = t150.mul_add(t154, sin_q_4.neg_mul_add(t139, t155));
    let t157 = t153 * t156;
    let t158 = t156.neg_mul_add(t157, t113.neg_mul_add(t154, r37));
    let t159 = N::ONE / t158;
    let t160 = t121 * t148;
    let t161 = t150.mul_add(t160, t132);
    let t162 = t153 * t161;
    let t163 = t156.neg_mul_add(t162, t113.neg_mul_add(t160, t94 * t147));
    let t164 = t159 * t163;
    let t165 = t161.neg_mul_add(t162, t121.neg_mul_add(t160, r38));
    let t166 = t163.neg_mul_add(t164, t165);
    let t167 = N::ONE / t166;
    let t168 = t108 * t148;
    let t169 = t150.mul_add(t168, t138);
    let t170 = t153 * t169;
    let t171 = t156.mul_add(t170, t113.mul_add(t168, t144));
    let t172 = t159 * t171;
    let t173 = t163.neg_mul_add(t172, t161.mul_add(t170, t121 * t168));
    let t174 = t167 * t173;
    let t175 = t169.neg_mul_add(t170, t108.neg_mul_add(t168, n(p.k1)));
    let t176 = t173.neg_mul_add(t174, t171.neg_mul_add(t172, t175));
    let t177 = N::ONE / t176;
    let t178 = r10 * t148;
    let t179 = t150.mul_add(t178, r11);
    let t180 = t153 * t179;
    let t181 = t156.neg_mul_add(t180, t113.neg_mul_add(t178, r12));
    let t182 = t159 * t181;
    let t183 = t161.neg_mul_add(t180, t121.neg_mul_add(t178, r13));
    let t184 = t163.neg_mul_add(t182, t183);
    let t185 = t167 * t184;
    let t186 = t108.neg_mul_add(t178, n(p.l) * t78);
    let t187 = t171.mul_add(t182, t169.neg_mul_add(t180, t186));
    let t188 = t173.mul_add(t185, t187);
    let t189 = t177 * t188;
    let t190 = t181.mul_add(t182, t179.mul_add(t180, r10 * t178));
    let r60 = t188.mul_add(t189, t184.mul_add(t185, t190));
    let t191 = N::ONE / r60;
    let t192 = r16 * t153;
    let t193 = t156.mul_add(t192, t81);
    let t194 = t159 * t193;
    let t195 = t163.neg_mul_add(t194, t161.mul_add(t192, t83));
    let t196 = t167 * t195;
    let t197 = t169.neg_mul_add(t192, n(p.l) * r3);
    let t198 = t173.neg_mul_add(t196, t171.neg_mul_add(t194, t197));
    let t199 = t177 * t198;
    let t200 = t184.mul_add(t196, t181.mul_sub(t194, t179 * t192));
    let t201 = t188.neg_mul_add(t199, t200);
    let t202 = t191 * t201;
    let t203 = t198.mul_add(t199, t195 * t196);
    let r66 = t203 + t193.mul_add(t194, r16 * t192);
    let r61 = t201.neg_mul_add(t202, r66);
    let t204 = N::ONE / r61;
    let t205 = t84 * t148;
    let t206 = t150.mul_add(t205, t86);
    let t207 = t153 * t206;
    let t208 = t156.neg_mul_add(t207, t113.neg_mul_add(t205, t88));
    let t209 = t159 * t208;
    let t210 = t161.mul_add(t207, t121.mul_add(t205, r23));
    let t211 = t163.mul_add(t209, t210);
    let t212 = t167 * t211;
    let t213 = t169.neg_mul_add(t207, t108.neg_mul_add(t205, r24));
    let t214 = t173.neg_mul_add(t212, t171.mul_add(t209, t213));
    let t215 = t177 * t214;
    let t216 = t181.mul_add(t209, t179.mul_add(t207, r10 * t205));
    let t217 = t188.mul_add(t215, t184.neg_mul_add(t212, t216));
    let t218 = t191 * t217;
    let t219 = t195.neg_mul_add(t212, t193.mul_sub(t209, r16 * t207));
    let t220 = t201.neg_mul_add(t218, t198.neg_mul_add(t215, t219));
    let t221 = t204 * t220;
    let t222 = t214.mul_add(t215, t206.mul_add(t207, t84 * t205));
    let r67 = t222 + t211.mul_add(t212, t208 * t209);
    let r62 = t220.neg_mul_add(t221, t217.neg_mul_add(t218, r67));
    let t223 = N::ONE / r62;
    let t224 = r26 * t153;
    let t225 = t156.neg_mul_add(t224, r27);
    let t226 = t159 * t225;
    let t227 = t163.neg_mul_add(t226, t161.neg_mul_add(t224, r28));
    let t228 = t167 * t227;
    let t229 = t171.neg_mul_add(t226, t169.mul_add(t224, r29));
    let t230 = t173.neg_mul_add(t228, t229);
    let t231 = t177 * t230;
    let t232 = t184.mul_add(t228, t181.mul_add(t226, t179 * t224));
    let t233 = t188.neg_mul_add(t231, t232);
    let t234 = t191 * t233;
    let t235 = t195.mul_add(t228, t193.mul_sub(t226, r16 * t224));
    let t236 = t201.neg_mul_add(t234, t198.mul_add(t231, t235));
    let t237 = t204 * t236;
    let t238 = t211.neg_mul_add(t228, t208.mul_add(t226, t206 * t224));
    let t239 = t217.neg_mul_add(t234, t214.neg_mul_add(t231, t238));
    let t240 = t220.neg_mul_add(t237, t239);
    let t241 = t223 * t240;
    let t242 = t230.mul_add(t231, t227 * t228);
    let r68 = t242 + t225.mul_add(t226, r26 * t224);
    let t243 = t236.neg_mul_add(t237, t233.neg_mul_add(t234, r68));
    let r63 = t240.neg_mul_add(t241, t243);
    let t244 = N::ONE / r63;
    let t245 = r30 * t148;
    let t246 = t150.mul_add(t245, r31);
    let t247 = t153 * t246;
    let t248 = t156.neg_mul_add(t247, t113.neg_mul_add(t245, r32));
    let t249 = t159 * t248;
    let t250 = t161.mul_add(t247, t121.mul_add(t245, t96));
    let t251 = t163.mul_add(t249, t250);
    let t252 = t167 * t251;
    let t253 = t169.mul_add(t247, t108.mul_add(t245, r34));
    let t254 = t173.mul_add(t252, t171.neg_mul_add(t249, t253));
    let t255 = t177 * t254;
    let t256 = t181.mul_add(t249, t179.mul_add(t247, r10 * t245));
    let t257 = t188.mul_add(t255, t184.mul_sub(t252, t256));
    let t258 = t191 * t257;
    let t259 = t195.neg_mul_add(t252, t193.mul_sub(t249, r16 * t247));
    let t260 = t201.mul_add(t258, t198.mul_add(t255, t259));
    let t261 = t204 * t260;
    let t262 = t208.mul_add(t249, t206.mul_add(t247, t84 * t245));
    let t263 = t214.mul_sub(t255, t211.mul_add(t252, t262));
    let t264 = t220.mul_add(t261, t217.neg_mul_add(t258, t263));
    let t265 = t223 * t264;
    let t266 = t227.neg_mul_add(t252, t225.mul_add(t249, r26 * t247));
    let t267 = t233.mul_add(t258, t230.mul_add(t255, t266));
    let t268 = t240.mul_add(t265, t236.neg_mul_add(t261, t267));
    let t269 = t244 * t268;
    let t270 = r0.mul_sub(t202, n(p.l) * t10);
    let t271 = t221.mul_add(t270, r0.neg_mul_add(t218, t15));
    let t272 = t237.mul_add(t270, r0.neg_mul_add(t234, r3));
    let t273 = t241.neg_mul_add(t271, t272);
    let t274 = t261.neg_mul_add(t270, r0.neg_mul_add(t258, t90));
    let t275 = t254.mul_add(t255, t246.mul_add(t247, r30 * t245));
    let r69 = t275 + t251.mul_add(t252, t248 * t249);
    let t276 = t260.neg_mul_add(t261, t257.neg_mul_add(t258, r69));
    let r64 = t268.neg_mul_add(t269, t264.neg_mul_add(t265, t276));
    let t277 = N::ONE / r64;
    let r54 = t269.mul_add(t273, t265.neg_mul_add(t271, t274)) * t277;
    let t278 = t269.mul_add(r54, t244 * t273);
    let r52 = t241.neg_mul_add(t278, t265.neg_mul_add(r54, t223 * t271));
    let t279 = t237.mul_add(t278, t261.neg_mul_add(r54, t204 * t270));
    let t280 = t221.mul_add(r52, t279);
    let t281 = t234.neg_mul_add(t278, t258.neg_mul_add(r54, r0 * t191));
    let t282 = t202.mul_add(t280, t218.neg_mul_add(r52, t281));
    let t283 = t215.mul_add(r52, t231.neg_mul_add(t278, t255 * r54));
    let r44 = t189.mul_add(t282, t199.mul_add(t280, t283));
    let t284 = t212.neg_mul_add(r52, t228.mul_add(t278, t252 * r54));
    let t285 = t185.mul_add(t282, t196.neg_mul_add(t280, t284));
    let t286 = t174.mul_add(r44, t285);
    let t287 = t209.neg_mul_add(r52, t226.neg_mul_add(t278, t249 * r54));
    let t288 = t182.neg_mul_add(t282, t194.mul_add(t280, t287));
    let r42 = t164.mul_add(t286, t172.neg_mul_add(r44, t288));
    let t289 = t207.mul_add(r52, t224.mul_sub(t278, t247 * r54));
    let t290 = t180.mul_add(t282, t192.mul_add(t280, t289));
    let t291 = t162.neg_mul_add(t286, t170.neg_mul_add(r44, t290));
    let t292 = t157.mul_add(r42, t291);
    let t293 = t178.mul_add(t282, t205.mul_sub(r52, t245 * r54));
    let t294 = t160.neg_mul_add(t286, t168.neg_mul_add(r44, t293));
    let t295 = n(p.l) * t39;
    let t296 = t202.neg_mul_add(t295, r6);
    let t297 = t221.mul_add(t296, t218.mul_add(t295, n(p.l) * t60));
    let t298 = t237.mul_add(t296, t234.mul_add(t295, r8));
    let t299 = t241.neg_mul_add(t297, t298);
    let t300 = t261.neg_mul_add(t296, t258.mul_sub(t295, r9));
    let r59 = t277 * t269.mul_add(t299, t265.neg_mul_add(t297, t300));
    let t301 = t269.mul_add(r59, t244 * t299);
    let r57 = t241.neg_mul_add(t301, t265.neg_mul_add(r59, t223 * t297));
    let t302 = t234.mul_add(t301, t258.mul_add(r59, t191 * t295));
    let t303 = t237.mul_add(t301, t261.neg_mul_add(r59, t204 * t296));
    let t304 = t221.mul_add(r57, t303);
    let r55 = t202.neg_mul_add(t304, t218.mul_add(r57, t302));
    let t305 = t215.neg_mul_add(r57, t231.mul_sub(t301, t255 * r59));
    let t306 = t189.mul_add(r55, t199.neg_mul_add(t304, t305));
    let t307 = t212.mul_sub(r57, t228.mul_add(t301, t252 * r59));
    let t308 = t185.mul_add(r55, t196.mul_add(t304, t307));
    let r48 = t174.mul_add(t306, t308);
    let t309 = t209.mul_add(r57, t226.mul_sub(t301, t249 * r59));
    let t310 = t182.neg_mul_add(r55, t194.neg_mul_add(t304, t309));
    let t311 = t164.mul_add(r48, t172.neg_mul_add(t306, t310));
    let t312 = t207.neg_mul_add(r57, t224.neg_mul_add(t301, t247 * r59));
    let t313 = t180.mul_add(r55, t192.neg_mul_add(t304, t312));
    let t314 = t162.neg_mul_add(r48, t170.neg_mul_add(t306, t313));
    let r46 = t157.mul_add(t311, t314);
    let t315 = t178.mul_sub(r55, t205.mul_sub(r57, t245 * r59));
    let t316 = t160.neg_mul_add(r48, t168.neg_mul_add(t306, t315));
    let r1 = t10 * n(p.minus_l);
    let r2 = -t15;
    let r4 = t16 - t17;
    let r5 = n(p.minus_l) * t39;
    let r7 = n(p.minus_l) * t60;
    let r14 = n(p.minus_l) * t78;
    let zero = N::ZERO;
    let r17 = -t81;
    let r18 = -t83;
    let r19 = n(p.minus_l) * r3;
    let r20 = -t84;
    let r21 = -t86;
    let r22 = -t88;
    let r33 = -t96;
    let r40 = -t151.mul_add(t292, t154.mul_add(r42, t294));
    let r41 = -t292;
    let r43 = -t286;
    let r45 = t151.mul_add(r46, t154.mul_add(t311, t316));
    let r47 = -t311;
    let r49 = -t306;
    let r50 = -t282;
    let r51 = -t280;
    let r53 = -t278;
    let r56 = -t304;
    let r58 = -t301;
    let sound = PIVOTS.hold(r35, r35)
        & PIVOTS.hold(t152, r36)
        & PIVOTS.hold(t158, r37)
        & PIVOTS.hold(t166, r38)
        & PIVOTS.hold(t176, n(p.k1))
        & PIVOTS.hold(r60, r60)
        & PIVOTS.hold(r61, r66)
        & PIVOTS.hold(r62, r67)
        & PIVOTS.hold(r63, r68)
        & PIVOTS.hold(r64, r69)
        & r40.is_finite();
    if !sound {
        let pivots = [
            (0, r35, r35),
            (1, t152, r36),
            (2, t158, r37),
            (3, t166, r38),
            (4, t176, n(p.k1)),
            (5, r60, r60),
            (6, r61, r66),
            (7, r62, r67),
            (8, r63, r68),
            (9, r64, r69),
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
        r14.store(),
        zero.store(),
        r16.store(),
        r17.store(),
        r18.store(),
        r19.store(),
        r20.store(),
        r21.store(),
        r22.store(),
        r23.store(),
        r24.store(),
        zero.store(),
        r26.store(),
        r27.store(),
        r28.store(),
        r29.store(),
        r30.store(),
        r31.store(),
        r32.store(),
        r33.store(),
        r34.store(),
        r35.store(),
        r36.store(),
        r37.store(),
        r38.store(),
        n(p.k1).store(),
        r40.store(),
        r41.store(),
        r42.store(),
        r43.store(),
        r44.store(),
        r45.store(),
        r46.store(),
        r47.store(),
        r48.store(),
        r49.store(),
        r50.store(),
        r51.store(),
        r52.store(),
        r53.store(),
        r54.store(),
        r55.store(),
        r56.store(),
        r57.store(),
        r58.store(),
        r59.store(),
        r60.store(),
        r61.store(),
        r62.store(),
        r63.store(),
        r64.store(),
        r60.store(),
        r66.store(),
        r67.store(),
        r68.store(),
        r69.store(),
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
    let t7 = t2 * p.half_l + q_1_dot * p.l;
    let t8 = q_2_dot + t3;
    let t9 = t3 + q_4_dot;
    let t10 = t4 * sin_q_3;
    let t11 = t4 * cos_q_3;
    let t12 = t3 * p.half_l + q_2_dot * p.l;
    let t13 = cos_q_4 * t6 - sin_q_4 * t5;
    let t14 = sin_q_4 * t6 + cos_q_4 * t5;
    let t15 = t6 + t10;
    let t16 = t11 * cos_q_4 - sin_q_4 * t8;
    let t17 = sin_q_5 * t9 + cos_q_5 * t13;
    let t18 = t14 + t15;
    let t19 = t11 * sin_q_4 + cos_q_4 * t8;
    let t20 = t14 * p.half_l + t15 * p.l;
    let t21 = t14 + q_5_dot;
    let t22 = p.l * (t16 - t9) - t17 * p.half_l;
    let t23 = t19 * sin_q_5 + cos_q_5 * t18;
    let t24 = t6 * p.half_l + t10 * p.l;
    let t25 = cos_q_5 * t9 - sin_q_5 * t13;
    let t26 = p.l * t16 - t9 * p.half_l;
    let t27 = t1 * (t1 * p.k2) + (p.k0 * t0 + t2 * (t2 * p.k0));
    let t28 = p.l * (t19 * cos_q_5 - sin_q_5 * t18) - p.half_l * t21;
    let t29 = p.m * (t24 * t24 + (t11 * (t11 * p.l_squared) + t12 * t12));
    let t30 = S::from_f64(0.5) * (p.m * (t0 * p.quarter_l_squared + t7 * t7) + t27);
    let t31 = t14 * (t14 * p.k0) + (t9 * (t9 * p.k0) + t13 * (t13 * p.k2));
    let t32 = t29 + (t5 * (t5 * p.k2) + (t3 * (t3 * p.k0) + t6 * (t6 * p.k0)));
    let t33 = t25 * (t25 * p.k2) + (t21 * (t21 * p.k0) + t17 * (t17 * p.k0));
    let t34 = p.m * (t26 * t26 + (t19 * (t19 * p.l_squared) + t20 * t20)) + t31;
    let t35 = S::from_f64(0.5) * t32 + (t30 + q_1_dot * (q_1_dot * p.k19));
    let t36 = p.m * (t28 * t28 + (t23 * (t23 * p.l_squared) + t22 * t22)) + t33;
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
    let t3 = p.m_g * (p.half_l * t0 + cos_q_2 * p.l) + cos_q_2 * p.half_l_m_g;
    let t4 = p.half_l * (cos_q_5 * (cos_q_3 * cos_q_2) - t2 * sin_q_5);
    let t5 = p.m_g * (p.half_l * t2 + p.l * t1) + t3;
    -(p.m_g * (p.l * (t2 + t1) - t4) + t5)
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
    p.minus_l * (cos_q_2 + sin_q_3 * cos_q_2)
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
    p.minus_l * (sin_q_1 + t0 - (cos_q_1 * cos_q_3 - t0 * sin_q_3))
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
    inputs Inputs {} [], defined here
    outputs Outputs { x3, y3, z3 } [
        x3: "x3" "m";
        y3: "y3" "m";
        z3: "z3" "m";
    ]
    prepared Prepared {
        l, m, g, l_squared, half_l, k0, k1, k2, k3, k4, k5, k6, k7, k8, k9, k10, quarter_l_squared,
        m_g, half_l_m_g, two_l, k11, k12, k13, k14, k15, k16, k17, k18, half_l_m, k19, k20,
        half_l_squared_m, k21, k22, k23, k24, k25, k26, minus_l,
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
        solved_in_place projection(p, t, q, v) = ProjectionCall { p, q, v };
        solved multipliers(p, t, q, v, u) = multipliers(p, q, v);
        workspace with_workspace(p) = ::lagrangian::emitted::constraint_workspace(5, 5);
    }
    absent [MAY_SLIDE MAY_COLLIDE]
    intervals []
    lanes [N]
    numbers []
}
