// @generated from machines/six_joint_arm.machine by `cargo xtask generate`; edits are lost.

//! An industrial arm with six revolute joints: a turning column, shoulder and elbow in its
//! plane, and
//! a wrist of three axes. Masses and sizes are those of a desk-sized arm that carries 5 kg.
//!
//! 6 coordinates, 12 parameters, 6 inputs, 1 output. Arithmetic of one call:
//!
//! | function | mul | add | div | sin cos | other | temporaries |
//! | --- | --: | --: | --: | --: | --: | --: |
//! | `prepare` | 67 | 49 | 0 | 0 | 0 | 116 |
//! | `mass_matrix` | 128 | 89 | 0 | 5 | 0 | 227 |
//! | `bias` | 185 | 130 | 0 | 5 | 0 | 325 |
//! | `applied` | 41 | 29 | 0 | 5 | 0 | 80 |
//! | `forces` | 194 | 143 | 0 | 5 | 0 | 347 |
//! | `accelerations` | 403 | 294 | 6 | 5 | 0 | 713 |
//! | `kinetic_energy` | 111 | 66 | 0 | 5 | 0 | 187 |
//! | `potential_energy` | 26 | 19 | 0 | 5 | 0 | 55 |
//! | `dissipation` | 7 | 5 | 0 | 0 | 0 | 12 |
//! | `work_rate` | 6 | 5 | 0 | 0 | 0 | 11 |
//! | `dissipation_rate` | 7 | 5 | 0 | 0 | 0 | 12 |
//! | `output_height` | 10 | 6 | 0 | 4 | 0 | 23 |
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

/// An industrial arm with six revolute joints: a turning column, shoulder and elbow in its
/// plane, and
/// a wrist of three axes. Masses and sizes are those of a desk-sized arm that carries 5 kg.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SixJointArm<S = f64> {
    /// Heights and lengths: column, upper arm, forearm, wrist to flange. Unit: `m`. Default: 0.35.
    pub h: S,
    /// `a`. Unit: `m`. Default: 0.4.
    pub a: S,
    /// `b`. Unit: `m`. Default: 0.42.
    pub b: S,
    /// `c`. Unit: `m`. Default: 0.1.
    pub c: S,
    /// Masses: column, upper arm, forearm, wrist, hand, flange with its load. Unit: `kg`.
    /// Default: 12.
    pub m1: S,
    /// `m2`. Unit: `kg`. Default: 9.
    pub m2: S,
    /// `m3`. Unit: `kg`. Default: 6.
    pub m3: S,
    /// `m4`. Unit: `kg`. Default: 1.5.
    pub m4: S,
    /// `m5`. Unit: `kg`. Default: 1.
    pub m5: S,
    /// `m6`. Unit: `kg`. Default: 5.2.
    pub m6: S,
    /// Viscous friction in each joint. Unit: `N*m*s`. Default: 0.4.
    pub friction: S,
    /// `g`. Unit: `m/s^2`. Default: 9.81.
    pub g: S,
}

impl<S: ::lagrangian::emitted::Scalar> SixJointArm<S> {
    /// Computes what depends on the parameters alone, once.
    pub fn prepare(&self) -> Prepared<S> {
        let t0 = S::from_ratio(9, 10000);
        let t1 = S::from_ratio(1, 100);
        let k0 = t1 + self.m6 * t0;
        let t2 = S::from_ratio(1, 50);
        let t3 = t2 + self.m6 * S::from_ratio(73, 10000);
        let k1 = t2 + self.m6 * S::from_ratio(4, 625) - t3;
        let t4 = self.c * self.m6;
        let t5 = self.c * self.m5;
        let k2 = S::from_f64(0.5) * t5 + (self.m6 * S::from_ratio(2, 25) + t4);
        let t6 = S::from_ratio(1, 500);
        let t7 = t3 + (t4 * S::from_ratio(4, 25) + self.c * t4);
        let k3 = t7 + (t6 + t5 * (self.c * S::from_f64(0.25)));
        let k4 = k3 - S::from_ratio(1, 1000);
        let k5 = t6 + k3;
        let t8 = S::from_ratio(3, 1000);
        let k6 = t8 - (k3 + t8);
        let t9 = self.b * self.m3;
        let t10 = self.m4 + (self.m5 + self.m6);
        let t11 = self.b * t10;
        let k7 = S::from_f64(0.5) * t9 + t11;
        let t12 = t9 * (self.b * S::from_f64(0.25));
        let t13 = S::from_ratio(1, 10000);
        let t14 = self.m3 * t13;
        let t15 = S::from_ratio(9, 100);
        let t16 = t8 + self.b * t11;
        let k8 = t16 + (t15 + (t12 + t14));
        let t17 = t16 + (t15 + t12);
        let k9 = t1 + t14 - t17;
        let a_squared = self.a * self.a;
        let t18 = self.m3 + t10;
        let t19 = a_squared * t18;
        let t20 = a_squared * (self.m2 * S::from_f64(0.25));
        let t21 = S::from_ratio(13, 100);
        let k10 = t19 + (t21 + t20);
        let t22 = self.m2 * t0;
        let t23 = t17 + t19 + (t21 + (t20 + t22));
        let k11 = t23 - (t17 + (t2 + t22));
        let t24 = self.a * self.m2;
        let k21 = self.m3 * t1;
        let k22 = self.a * k7;
        let k29 = self.m6 * S::from_ratio(3, 1250);
        let k31 = self.m6 * S::from_ratio(3, 100);
        let t25 = S::from_f64(2.0) + self.c * S::from_f64(25.0);
        let k37 = k0 - k4;
        let half_a = self.a * S::from_f64(0.5);
        let half_b = self.b * S::from_f64(0.5);
        let half_c = self.c * S::from_f64(0.5);
        let k12 = t23 + (t13 * self.m1 + S::from_ratio(3, 50));
        let k13 = t13 * (a_squared * S::from_f64(2500.0) + S::from_f64(9.0));
        let m2_g = self.m2 * self.g;
        let m3_g = self.m3 * self.g;
        let m4_g = self.m4 * self.g;
        let m5_g = self.m5 * self.g;
        let m6_g = self.m6 * self.g;
        let half_h_m1_g = self.h * self.m1 * (self.g * S::from_f64(0.5));
        let half_friction = self.friction * S::from_f64(0.5);
        let k14 = self.g * (S::from_f64(0.5) * t24 + self.a * t18);
        let k15 = self.g * k7;
        let k16 = self.g * k21;
        let k17 = self.g * k2;
        let two_a = self.a * S::from_f64(2.0);
        let k18 = k10 + k11;
        let k19 = t24 * S::from_ratio(3, 200);
        let k20 = k10 - k11;
        let k23 = k8 - k9;
        let k24 = t9 * S::from_ratio(1, 200);
        let k25 = S::from_f64(2.0) * k22;
        let k26 = t2 * (self.a * self.m3);
        let k27 = k5 + k6;
        let k28 = k3 + k4;
        let k30 = k0 - k1;
        let k32 = S::from_ratio(1, 20000) * (self.m1 + S::from_f64(600.0));
        let k33 = t25 * (self.m6 * S::from_ratio(3, 2500));
        let k34 = self.a * k21;
        let k35 = self.c * k31;
        let k36 = self.g * k31;
        let k38 = k29 * t25;
        let k39 = k5 + k37;
        let k40 = self.a * k2;
        let k41 = self.b * k31;
        let k42 = self.a * k31;
        let two_b = self.b * S::from_f64(2.0);
        Prepared {
            h: self.h,
            a: self.a,
            b: self.b,
            c: self.c,
            m2: self.m2,
            m3: self.m3,
            m4: self.m4,
            m5: self.m5,
            m6: self.m6,
            friction: self.friction,
            g: self.g,
            half_a,
            half_b,
            half_c,
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
            a_squared,
            k13,
            m2_g,
            m3_g,
            m4_g,
            m5_g,
            m6_g,
            half_h_m1_g,
            half_friction,
            k14,
            k15,
            k16,
            k17,
            two_a,
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
            k37,
            k38,
            k39,
            k40,
            k41,
            k42,
            two_b,
        }
    }

    /// The start values of the description, at rest and `t = 0`.
    pub fn start(&self) -> ::lagrangian::emitted::State<Coordinates<S>> {
        let q_1 = S::from_ratio(1, 5);
        let q = [q_1, q_1, q_1, q_1, q_1, q_1];
        let v = [S::ZERO; 6];
        ::lagrangian::emitted::State {
            t: 0.0,
            q: Coordinates::from_array(q),
            v: Coordinates::from_array(v),
        }
    }
}

/// The coordinates of [`SixJointArm`], or their rates, by name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coordinates<S = f64> {
    /// `q`. Unit: `rad`. Members: `q[1]` to `q[6]`.
    pub q: [S; 6],
}

/// What can be set while a [`SixJointArm`] runs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Inputs<S = f64> {
    /// Torques of the motors. Unit: `N*m`. Members: `tau[1]` to `tau[6]`.
    pub tau: [S; 6],
}

/// What can be observed of a [`SixJointArm`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outputs<S = f64> {
    /// Height of the flange above the floor. Unit: `m`.
    pub height: S,
}

/// The parameters of a [`SixJointArm`], with the work done that depends on them alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prepared<S = f64> {
    /// `h`
    h: S,
    /// `a`
    a: S,
    /// `b`
    b: S,
    /// `c`
    c: S,
    /// `m2`
    m2: S,
    /// `m3`
    m3: S,
    /// `m4`
    m4: S,
    /// `m5`
    m5: S,
    /// `m6`
    m6: S,
    /// `friction`
    friction: S,
    /// `g`
    g: S,
    /// `0.5*a`
    half_a: S,
    /// `0.5*b`
    half_b: S,
    /// `0.5*c`
    half_c: S,
    /// `0.01 + 0.0009*m6`
    k0: S,
    /// `0.02 + 0.0064*m6 - (0.02 + 0.0073*m6)`
    k1: S,
    /// `c*m6 + 0.08*m6 + 0.5*c*m5`
    k2: S,
    /// `0.002 + 0.25*c^2*m5 + 0.02 + 0.0073*m6 + c^2*m6 + 0.16*c*m6`
    k3: S,
    /// `0.002 + 0.25*c^2*m5 + 0.02 + 0.0073*m6 + c^2*m6 + 0.16*c*m6 - 0.001`
    k4: S,
    /// `0.002 + 0.002 + 0.25*c^2*m5 + 0.02 + 0.0073*m6 + c^2*m6 + 0.16*c*m6`
    k5: S,
    /// `0.003 - (0.002 + 0.25*c^2*m5 + 0.02 + 0.0073*m6 + c^2*m6 + 0.16*c*m6 + 0.003)`
    k6: S,
    /// `b*(m4 + m5 + m6) + 0.5*b*m3`
    k7: S,
    /// `0.0001*m3 + 0.25*b^2*m3 + 0.09 + 0.003 + b^2*(m4 + m5 + m6)`
    k8: S,
    /// `0.01 + 0.0001*m3 - (0.25*b^2*m3 + 0.09 + 0.003 + b^2*(m4 + m5 + m6))`
    k9: S,
    /// `0.25*a^2*m2 + 0.13 + a^2*(m3 + m4 + m5 + m6)`
    k10: S,
    /// `0.0009*m2 + 0.25*a^2*m2 + 0.13 + 0.25*b^2*m3 + 0.09 + 0.003 + b^2*(m4 + m5 + m6) + a^2*(m3
    /// + m4 + m5…`
    k11: S,
    /// `0.06 + 0.0001*m1 + 0.0009*m2 + 0.25*a^2*m2 + 0.13 + 0.25*b^2*m3 + 0.09 + 0.003 + b^2*(m4 +
    /// m5 + m6) …`
    k12: S,
    /// `a^2`
    a_squared: S,
    /// `0.0001*(9 + 2500*a^2)`
    k13: S,
    /// `m2*g`
    m2_g: S,
    /// `m3*g`
    m3_g: S,
    /// `m4*g`
    m4_g: S,
    /// `m5*g`
    m5_g: S,
    /// `m6*g`
    m6_g: S,
    /// `0.5*h*m1*g`
    half_h_m1_g: S,
    /// `0.5*friction`
    half_friction: S,
    /// `g*(a*(m3 + m4 + m5 + m6) + 0.5*a*m2)`
    k14: S,
    /// `g*(b*(m4 + m5 + m6) + 0.5*b*m3)`
    k15: S,
    /// `0.01*m3*g`
    k16: S,
    /// `g*(c*m6 + 0.08*m6 + 0.5*c*m5)`
    k17: S,
    /// `2*a`
    two_a: S,
    /// `0.25*a^2*m2 + 0.13 + a^2*(m3 + m4 + m5 + m6) + 0.0009*m2 + 0.25*a^2*m2 + 0.13 + 0.25*b^2*m3
    /// + 0.09 +…`
    k18: S,
    /// `0.015*a*m2`
    k19: S,
    /// `0.25*a^2*m2 + 0.13 + a^2*(m3 + m4 + m5 + m6) - (0.0009*m2 + 0.25*a^2*m2 + 0.13 +
    /// 0.25*b^2*m3 + 0.09 …`
    k20: S,
    /// `0.01*m3`
    k21: S,
    /// `a*(b*(m4 + m5 + m6) + 0.5*b*m3)`
    k22: S,
    /// `0.0001*m3 + 0.25*b^2*m3 + 0.09 + 0.003 + b^2*(m4 + m5 + m6) - (0.01 + 0.0001*m3 -
    /// (0.25*b^2*m3 + 0.0…`
    k23: S,
    /// `0.005*b*m3`
    k24: S,
    /// `2*a*(b*(m4 + m5 + m6) + 0.5*b*m3)`
    k25: S,
    /// `0.02*a*m3`
    k26: S,
    /// `0.002 + 0.002 + 0.25*c^2*m5 + 0.02 + 0.0073*m6 + c^2*m6 + 0.16*c*m6 + 0.003 - (0.002 +
    /// 0.25*c^2*m5 +…`
    k27: S,
    /// `0.002 + 0.25*c^2*m5 + 0.02 + 0.0073*m6 + c^2*m6 + 0.16*c*m6 + 0.002 + 0.25*c^2*m5 + 0.02
    /// + 0.0073*m6…`
    k28: S,
    /// `0.0024*m6`
    k29: S,
    /// `0.01 + 0.0009*m6 - (0.02 + 0.0064*m6 - (0.02 + 0.0073*m6))`
    k30: S,
    /// `0.03*m6`
    k31: S,
    /// `0.00005*(m1 + 600)`
    k32: S,
    /// `0.0012*m6*(2 + 25*c)`
    k33: S,
    /// `0.01*a*m3`
    k34: S,
    /// `0.03*c*m6`
    k35: S,
    /// `0.03*m6*g`
    k36: S,
    /// `0.01 + 0.0009*m6 - (0.002 + 0.25*c^2*m5 + 0.02 + 0.0073*m6 + c^2*m6 + 0.16*c*m6 - 0.001)`
    k37: S,
    /// `0.0024*m6*(2 + 25*c)`
    k38: S,
    /// `0.002 + 0.002 + 0.25*c^2*m5 + 0.02 + 0.0073*m6 + c^2*m6 + 0.16*c*m6 + 0.01 + 0.0009*m6 -
    /// (0.002 + 0.…`
    k39: S,
    /// `a*(c*m6 + 0.08*m6 + 0.5*c*m5)`
    k40: S,
    /// `0.03*b*m6`
    k41: S,
    /// `0.03*a*m6`
    k42: S,
    /// `2*b`
    two_b: S,
}

/// A pivot of an elimination that is not above this share of its diagonal element may be rounding
/// errors alone.
const PIVOTS: ::lagrangian::emitted::Pivots = ::lagrangian::emitted::Pivots::new(6, 6);

/// Mass matrix `M`.
///
/// ```text
/// M[q[1], q[1]] = …
/// M[q[2], q[1]] = …
/// M[q[2], q[2]] = …
/// M[q[3], q[1]] = …
/// M[q[3], q[2]] = …
/// M[q[3], q[3]] = …
/// M[q[4], q[1]] = …
/// M[q[4], q[2]] = …
/// M[q[4], q[3]] = …
/// M[q[4], q[4]] = 0.0024*(25*c + 2)*m6*cos(q[5])*sin(q[5])*cos(q[6])
///     - 2e-4*(32*m6 + 55)*cos(q[5])^2 - 9e-4*m6*sin(q[5])^2*cos(q[6])^2
///     - 0.002*sin(q[5])^2*cos(q[6])*sin(q[6]) + 0.01*(25*c*m5 + 100*c*m6 + 16*m6)*c*sin(q[5])^2
///     + 0.0073*m6 + 0.024
/// …
/// ```
pub fn mass_matrix<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 6]) -> [[S; 6]; 6] {
    let q_2 = q[1];
    let q_3 = q[2];
    let q_4 = q[3];
    let q_5 = q[4];
    let q_6 = q[5];
    let (sin_q_6, cos_q_6) = q_6.sin_cos();
    let (sin_q_5, cos_q_5) = q_5.sin_cos();
    let (sin_q_4, cos_q_4) = q_4.sin_cos();
    let (sin_q_2, cos_q_2) = q_2.sin_cos();
    let (sin_q_3, cos_q_3) = q_3.sin_cos();
    let t0 = S::from_ratio(1, 500);
    let t1 = sin_q_6 * p.k33;
    let t2 = cos_q_6 * cos_q_5;
    let t3 = cos_q_6 * sin_q_5;
    let t4 = sin_q_6 * sin_q_4;
    let t5 = cos_q_6 * t0 + sin_q_6 * p.k1;
    let t6 = cos_q_5 * p.k2 - t3 * p.k31;
    let t7 = sin_q_5 * p.k2 + t2 * p.k31;
    let t8 = sin_q_6 * cos_q_4;
    let t9 = sin_q_6 * t5;
    let t10 = S::from_ratio(1, 1000) - cos_q_6 * t5;
    let t11 = sin_q_4 * sin_q_4;
    let t12 = cos_q_4 * t6;
    let t13 = sin_q_4 * t6;
    let t14 = cos_q_4 * t7 - t4 * p.k31;
    let t15 = p.k1 - t9;
    let m54 = sin_q_5 * t10 - cos_q_5 * t1;
    let t16 = sin_q_5 * t1 + cos_q_5 * t10;
    let m55 = t9 + p.k3;
    let t17 = cos_q_4 * t12;
    let t18 = cos_q_2 * cos_q_3 - sin_q_2 * sin_q_3;
    let t19 = sin_q_4 * t16;
    let t20 = t14 + p.k21;
    let t21 = sin_q_2 * p.a;
    let t22 = t17 + sin_q_4 * t13;
    let t23 = t2 * p.k38 + sin_q_5 * (t15 - p.k37);
    let t24 = cos_q_4 * t16;
    let t25 = sin_q_5 * p.k40 + t2 * p.k42;
    let t26 = p.k31 * t8 + sin_q_4 * t7;
    let t27 = cos_q_5 * t23 - cos_q_6 * p.k33;
    let t28 = sin_q_5 * t23;
    let t29 = sin_q_2 * cos_q_3 + cos_q_2 * sin_q_3;
    let t30 = t22 + p.k7;
    let m44 = t28 + p.k39;
    let t31 = p.k6 - t15 + t28;
    let t32 = sin_q_4 * t12 - cos_q_4 * t13;
    let t33 = sin_q_4 * m54 + cos_q_4 * t27 + t14 * p.b;
    let t34 = cos_q_3 * p.a;
    let m43 = cos_q_4 * m54 - sin_q_4 * t27 - t26 * p.b;
    let t35 = t17 + t6 * t11;
    let t36 = t33 + p.k24;
    let t37 = cos_q_4 * (t19 * S::from_f64(2.0) - cos_q_4 * t31);
    let t38 = t0 + m43;
    let t39 = t26 * t34;
    let t40 = sin_q_3 * (cos_q_4 * t25 - t4 * p.k42);
    let m64 = cos_q_5 * p.k0 + p.k33 * t3;
    let t41 = sin_q_5 * p.k0 - p.k33 * t2;
    let t42 = cos_q_4 * (t24 + sin_q_4 * (m55 + t31)) - (sin_q_4 * t19 + t32 * p.b);
    let t43 = sin_q_4 * (S::from_f64(2.0) * t24 + sin_q_4 * t31);
    let m33 = m55 * (cos_q_4 * cos_q_4) + p.k8 + p.two_b * t35 - t43;
    let t44 = sin_q_3 * p.k34 - t34 * (p.k7 + t35);
    let t45 = m55 + t6 * p.b;
    let t46 = cos_q_6 * cos_q_4 - cos_q_5 * t4;
    let t47 = cos_q_6 * sin_q_4 + cos_q_5 * t8;
    let t48 = p.k12 - cos_q_2 * (cos_q_2 * p.k11) + t21 * (t18 * t20 + t29 * t30);
    let t49 = m33 - t44;
    let m53 = cos_q_4 * t45 - t19;
    let m63 = sin_q_4 * t41 - cos_q_4 * t1 - t47 * p.k41;
    let t50 = t29 * (t21 * t30 + t29 * (t11 * m55 + t22 * p.two_b + t37) + t18 * t36);
    let t51 = t29 * (t42 - (sin_q_3 * (t8 * p.k42 + sin_q_4 * t25) + t32 * t34));
    let t52 = t29 * (sin_q_4 * t1 + cos_q_4 * t41 - t46 * p.k41);
    let m11 = t48 + t18 * (t20 * t21 + t18 * (m44 + p.k9) + t29 * t36) + t50;
    let m21 = t18 * (t38 - t39) - cos_q_2 * p.k19 + t51;
    let m22 = t49 + (p.k10 - S::from_f64(2.0) * t40 - t44);
    let m31 = t18 * t38 + t29 * t42;
    let m32 = t49 - t40;
    let m41 = t14 * t21 + t18 * m44 + t29 * t33;
    let m42 = m43 - t39;
    let m51 = t6 * (sin_q_4 * t21) + m54 * t18 + t29 * (t24 + sin_q_4 * t45);
    let m52 = m53 + (t12 * t34 - sin_q_3 * t25);
    let m61 = t18 * m64 + t46 * (sin_q_2 * p.k42) - t52;
    let m62 = m63 + p.k42 * (sin_q_6 * (sin_q_5 * sin_q_3) - cos_q_3 * t47);
    let m65 = -t1;
    [
        [m11, m21, m31, m41, m51, m61],
        [m21, m22, m32, m42, m52, m62],
        [m31, m32, m33, m43, m53, m63],
        [m41, m42, m43, m44, m54, m64],
        [m51, m52, m53, m54, m55, m65],
        [m61, m62, m63, m64, m65, p.k0],
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
/// h[q[6]] = …
/// ```
pub fn bias<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 6], v: &[S; 6]) -> [S; 6] {
    let q_2 = q[1];
    let q_3 = q[2];
    let q_4 = q[3];
    let q_5 = q[4];
    let q_6 = q[5];
    let q_1_dot = v[0];
    let q_2_dot = v[1];
    let q_3_dot = v[2];
    let q_4_dot = v[3];
    let q_5_dot = v[4];
    let q_6_dot = v[5];
    let (sin_q_2, cos_q_2) = q_2.sin_cos();
    let (sin_q_3, cos_q_3) = q_3.sin_cos();
    let (sin_q_4, cos_q_4) = q_4.sin_cos();
    let (sin_q_5, cos_q_5) = q_5.sin_cos();
    let (sin_q_6, cos_q_6) = q_6.sin_cos();
    let t0 = q_2_dot * q_2_dot;
    let t1 = q_1_dot * q_2_dot;
    let t2 = q_2_dot + q_3_dot;
    let t3 = t2 * t2;
    let t4 = sin_q_2 * q_1_dot;
    let t5 = cos_q_2 * q_1_dot;
    let t6 = cos_q_2 * sin_q_3 + sin_q_2 * cos_q_3;
    let t7 = t0 + t4 * t4;
    let t8 = cos_q_2 * cos_q_3 - sin_q_2 * sin_q_3;
    let t9 = t4 * t5;
    let t10 = q_2_dot * t5;
    let t11 = q_1_dot * t6;
    let t12 = q_1_dot * t8;
    let t13 = t11 * sin_q_4 + t2 * cos_q_4;
    let t14 = t11 * cos_q_4 - t2 * sin_q_4;
    let t15 = t11 * t12;
    let t16 = q_3_dot * t12 + t8 * t1;
    let t17 = t9 * cos_q_3 - sin_q_3 * t7;
    let t18 = t2 * t12;
    let t19 = t9 * sin_q_3 + cos_q_3 * t7;
    let t20 = t11 * t11;
    let t21 = q_3_dot * t11 + t6 * t1;
    let t22 = t12 + q_4_dot;
    let t23 = t13 + q_5_dot;
    let t24 = t18 + t16;
    let t25 = t3 + t20;
    let t26 = p.a * t17 + p.b * t15;
    let t27 = cos_q_4 * t16 - q_4_dot * t13;
    let t28 = sin_q_5 * t22 + cos_q_5 * t14;
    let t29 = cos_q_5 * t22 - sin_q_5 * t14;
    let t30 = p.b * t24 + t10 * p.two_a;
    let t31 = t19 * p.a + t25 * p.b;
    let t32 = sin_q_6 * t28 + cos_q_6 * t23;
    let t33 = cos_q_6 * t28 - sin_q_6 * t23;
    let t34 = t29 + q_6_dot;
    let t35 = q_4_dot * t14 + sin_q_4 * t16;
    let t36 = sin_q_4 * t30 - t26 * cos_q_4;
    let t37 = t28 * t29;
    let t38 = t28 * q_5_dot + (sin_q_5 * t27 + cos_q_5 * t21);
    let t39 = t32 * t33;
    let t40 = t32 * t34;
    let t41 = t29 * q_5_dot + (cos_q_5 * t27 - sin_q_5 * t21);
    let t42 = t29 * t23;
    let t43 = t31 * sin_q_5 + cos_q_5 * t36;
    let t44 = t35 - t37;
    let t45 = t33 * t33;
    let t46 = t32 * t32;
    let t47 = t26 * sin_q_4 + cos_q_4 * t30;
    let t48 = t42 + t41;
    let t49 = t39 + t38;
    let t50 = t33 * t34;
    let t51 = t34 * t34;
    let t52 = cos_q_6 * t41 - sin_q_6 * t35 - t32 * q_6_dot;
    let t53 = t46 + t51;
    let t54 = t23 * t23 + t28 * t28;
    let t55 = S::from_ratio(1, 1000);
    let t56 = t50 + (t33 * q_6_dot + (sin_q_6 * t41 + cos_q_6 * t35));
    let t57 = sin_q_6 * t53 + cos_q_6 * t49;
    let t58 = t38 * p.k0 - t39 * p.k1 - t55 * (t45 - t46) - p.k29 * (t40 + t52);
    let t59 = p.k31 * (cos_q_6 * (t47 + p.c * t48) - sin_q_6 * (t43 + t44 * p.c));
    let t60 = t52 * p.k1 - (p.k29 * t49 + t40 * p.k0) - t55 * t56;
    let t61 = sin_q_6 * t49 - cos_q_6 * t53;
    let t62 = p.k31 * t56 + t54 * p.k2;
    let t63 = t12 * t12;
    let t64 = t2 * t11;
    let t65 = t50 * p.k30 - p.k29 * (t51 - t45) - t55 * (t52 - t40);
    let t66 = p.k31 * (t31 * cos_q_5 - sin_q_5 * t36 + p.c * t54) + t65;
    let t67 = p.k31 * t61 + t44 * p.k2;
    let t68 = t48 * p.k2 - p.k31 * t57;
    let t69 = t21 + t64;
    let t70 = S::from_ratio(1, 500);
    let t71 = t38 * p.k4 - t28 * (t23 * p.k3) - (t58 - t59);
    let t72 = cos_q_6 * t60 + (t47 * p.k2 + t42 * p.k28 - p.k35 * t57);
    let t73 = sin_q_6 * t66 + t72;
    let t74 = cos_q_5 * t67 - sin_q_5 * t62;
    let t75 = sin_q_4 * t74 + cos_q_4 * t68;
    let t76 = p.k35 * t61 + (t43 * p.k2 + (t35 * p.k3 - t37 * p.k4)) - sin_q_6 * t60;
    let h_q_5 = cos_q_6 * t66 + t76;
    let t77 = t13 * (t14 * p.k6) + t21 * p.k5 - cos_q_5 * t71;
    let t78 = sin_q_5 * t73;
    let t79 = sin_q_5 * t71 + (t13 * (t22 * p.k5) + t27 * p.k6) - cos_q_5 * t73;
    let t80 = t14 * (t22 * p.k27) + h_q_5;
    let t81 = t10 * p.k25 + (t18 * p.k23 - t70 * (t3 - t63) - p.k24 * t69);
    let t82 = t11 * (t2 * p.k8 + t12 * t70) + t21 * p.k9 - t24 * p.k24 - t10 * p.k26;
    let t83 = t77 - t78 + t82;
    let t84 = p.a * (t75 + (t24 * p.k7 - t69 * p.k21));
    let t85 = sin_q_4 * t68 - cos_q_4 * t74;
    let t86 = sin_q_4 * t80 + t81 + (p.b * t75 - cos_q_4 * t79);
    let t87 = p.k24 * (t20 - t63) + t15 * p.k9 - t70 * (t21 - t64);
    let t88 = sin_q_3 * t83 + (t84 + (p.k19 * (t0 - t5 * t5) + t10 * p.k18));
    let t89 = sin_q_3 * (cos_q_5 * t62 + (t25 * p.k7 + t15 * p.k21 + sin_q_5 * t67));
    let t90 = cos_q_4 * t80 + (t19 * p.k34 - t17 * p.k22 + t87);
    let h_q_3 = t90 + (sin_q_4 * t79 - p.b * t85);
    let t91 = p.a * (t89 + cos_q_3 * (t85 + (p.k21 * (t3 + t63) + t15 * p.k7)));
    let t92 = sin_q_3 * t86 + (t4 * (t5 * p.k19 - q_2_dot * p.k20) - cos_q_3 * t83);
    let h_q_1 = cos_q_2 * t92 + sin_q_2 * (cos_q_3 * t86 + t88);
    let h_q_2 = h_q_3 - (t91 + t9 * p.k11);
    let h_q_4 = t78 - t77;
    let h_q_6 = t59 - t58;
    [h_q_1, h_q_2, h_q_3, h_q_4, h_q_5, h_q_6]
}

/// Applied generalized forces `Q`.
///
/// ```text
/// Q[q[1]] = …
/// Q[q[2]] = …
/// Q[q[3]] = …
/// Q[q[4]] = tau[4] - friction*der(q[4]) - 0.03*m6*g*cos(q[4])*sin(q[6])*sin(q[2] + q[3])
///     - 0.03*m6*g*sin(q[4])*cos(q[5])*cos(q[6])*sin(q[2] + q[3])
///     - 0.02*(25*c*m5 + 50*c*m6 + 4*m6)*g*sin(q[4])*sin(q[5])*sin(q[2] + q[3])
/// Q[q[5]] = tau[5] - friction*der(q[5])
///     + 0.02*(25*c*m5 + 50*c*m6 + 4*m6)*g*cos(q[4])*cos(q[5])*sin(q[2] + q[3])
///     - 0.03*m6*g*cos(q[4])*sin(q[5])*cos(q[6])*sin(q[2] + q[3])
///     + 0.03*m6*g*cos(q[5])*cos(q[6])*cos(q[2] + q[3])
///     + 0.02*(25*c*m5 + 50*c*m6 + 4*m6)*g*sin(q[5])*cos(q[2] + q[3])
/// Q[q[6]] = tau[6] - friction*der(q[6]) - 0.03*m6*g*cos(q[4])*cos(q[5])*sin(q[6])*sin(q[2] + q[3])
///     - 0.03*m6*g*sin(q[4])*cos(q[6])*sin(q[2] + q[3])
///     - 0.03*m6*g*sin(q[5])*sin(q[6])*cos(q[2] + q[3])
/// ```
pub fn applied<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 6],
    v: &[S; 6],
    u: &Inputs<S>,
) -> [S; 6] {
    let q_2 = q[1];
    let q_3 = q[2];
    let q_4 = q[3];
    let q_5 = q[4];
    let q_6 = q[5];
    let q_1_dot = v[0];
    let q_2_dot = v[1];
    let q_3_dot = v[2];
    let q_4_dot = v[3];
    let q_5_dot = v[4];
    let q_6_dot = v[5];
    let (sin_q_2, cos_q_2) = q_2.sin_cos();
    let (sin_q_3, cos_q_3) = q_3.sin_cos();
    let (sin_q_5, cos_q_5) = q_5.sin_cos();
    let (sin_q_4, cos_q_4) = q_4.sin_cos();
    let (sin_q_6, cos_q_6) = q_6.sin_cos();
    let t0 = cos_q_2 * sin_q_3 + sin_q_2 * cos_q_3;
    let t1 = cos_q_2 * cos_q_3 - sin_q_2 * sin_q_3;
    let t2 = cos_q_4 * t0;
    let t3 = sin_q_4 * t0;
    let t4 = sin_q_5 * t1 + cos_q_5 * t2;
    let t5 = p.k36 * (cos_q_5 * t1 - sin_q_5 * t2);
    let t6 = t3 * p.k17 - sin_q_6 * t5;
    let t7 = p.k36 * (sin_q_6 * t4 + cos_q_6 * t3);
    let t8 = cos_q_6 * t5 + t4 * p.k17;
    let t9 = cos_q_5 * t6 - sin_q_5 * t7;
    let t10 = cos_q_5 * t7 + sin_q_5 * t6;
    let t11 = sin_q_4 * t8 - cos_q_4 * t9;
    let t12 = sin_q_4 * t9 + (cos_q_4 * t8 + (t0 * p.k15 + t1 * p.k16));
    let t13 = cos_q_2 * (sin_q_3 * t11 - cos_q_3 * t10) - p.friction * q_1_dot;
    let q_q_1 = sin_q_2 * (sin_q_3 * t10 + cos_q_3 * t11) + t13 + u.tau[0];
    let q_q_2 = t12 + (sin_q_2 * p.k14 - p.friction * q_2_dot) + u.tau[1];
    let q_q_3 = t12 - p.friction * q_3_dot + u.tau[2];
    let q_q_4 = u.tau[3] - (t10 + p.friction * q_4_dot);
    let q_q_5 = t8 - p.friction * q_5_dot + u.tau[4];
    let q_q_6 = u.tau[5] - (t7 + p.friction * q_6_dot);
    [q_q_1, q_q_2, q_q_3, q_q_4, q_q_5, q_q_6]
}

/// Right-hand side `f = Q - h` of `M a = f`.
pub fn forces<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 6],
    v: &[S; 6],
    u: &Inputs<S>,
) -> [S; 6] {
    let q_2 = q[1];
    let q_3 = q[2];
    let q_4 = q[3];
    let q_5 = q[4];
    let q_6 = q[5];
    let q_1_dot = v[0];
    let q_2_dot = v[1];
    let q_3_dot = v[2];
    let q_4_dot = v[3];
    let q_5_dot = v[4];
    let q_6_dot = v[5];
    let (sin_q_2, cos_q_2) = q_2.sin_cos();
    let (sin_q_3, cos_q_3) = q_3.sin_cos();
    let (sin_q_4, cos_q_4) = q_4.sin_cos();
    let (sin_q_5, cos_q_5) = q_5.sin_cos();
    let (sin_q_6, cos_q_6) = q_6.sin_cos();
    let t0 = q_3_dot + q_2_dot;
    let t1 = q_1_dot * q_2_dot;
    let t2 = q_2_dot * q_2_dot;
    let t3 = t0 * t0;
    let t4 = sin_q_2 * q_1_dot;
    let t5 = cos_q_2 * q_1_dot;
    let t6 = cos_q_2 * sin_q_3 + sin_q_2 * cos_q_3;
    let t7 = cos_q_2 * cos_q_3 - sin_q_2 * sin_q_3;
    let t8 = q_1_dot * t5;
    let t9 = q_2_dot * t5;
    let t10 = q_1_dot * t6;
    let t11 = q_1_dot * t7;
    let t12 = cos_q_2 * p.g - p.a * (t2 + t4 * t4);
    let t13 = sin_q_4 * t10 + t0 * cos_q_4;
    let t14 = cos_q_4 * t10 - t0 * sin_q_4;
    let t15 = t11 * q_3_dot + t7 * t1;
    let t16 = q_3_dot * t10 + t6 * t1;
    let t17 = t11 + q_4_dot;
    let t18 = t11 * t0;
    let t19 = sin_q_2 * (t8 * p.a + p.g);
    let t20 = t13 + q_5_dot;
    let t21 = t15 + t18;
    let t22 = cos_q_4 * t15 - q_4_dot * t13;
    let t23 = t17 * sin_q_5 + cos_q_5 * t14;
    let t24 = t17 * cos_q_5 - sin_q_5 * t14;
    let t25 = t10 * t10;
    let t26 = q_4_dot * t14 + sin_q_4 * t15;
    let t27 = sin_q_6 * t23 + cos_q_6 * t20;
    let t28 = cos_q_6 * t23 - sin_q_6 * t20;
    let t29 = t24 + q_6_dot;
    let t30 = t11 * t10;
    let t31 = sin_q_3 * t12 + cos_q_3 * t19;
    let t32 = p.b * t21 + t9 * p.two_a;
    let t33 = t3 + t25;
    let t34 = cos_q_3 * t12 - sin_q_3 * t19;
    let t35 = t23 * q_5_dot + (sin_q_5 * t22 + cos_q_5 * t16);
    let t36 = t27 * t28;
    let t37 = t27 * t27;
    let t38 = t27 * t29;
    let t39 = t24 * q_5_dot + (cos_q_5 * t22 - sin_q_5 * t16);
    let t40 = p.b * t30 + t31;
    let t41 = t34 - t33 * p.b;
    let t42 = t24 * t20;
    let t43 = t29 * t29;
    let t44 = t28 * t28;
    let t45 = cos_q_4 * t40 - sin_q_4 * t32;
    let t46 = t23 * t24;
    let t47 = t42 + t39;
    let t48 = sin_q_4 * t40 + cos_q_4 * t32;
    let t49 = t36 + t35;
    let t50 = t28 * t29;
    let t51 = t37 + t43;
    let t52 = cos_q_6 * t39 - sin_q_6 * t26 - t27 * q_6_dot;
    let t53 = sin_q_5 * t41 + cos_q_5 * t45;
    let t54 = t26 - t46;
    let t55 = t20 * t20 + t23 * t23;
    let t56 = S::from_ratio(1, 1000);
    let t57 = t50 + (t28 * q_6_dot + (sin_q_6 * t39 + cos_q_6 * t26));
    let t58 = sin_q_6 * t49 - cos_q_6 * t51;
    let t59 = t52 * p.k1 - (p.k29 * t49 + t38 * p.k0) - t56 * t57;
    let t60 = sin_q_6 * t51 + cos_q_6 * t49;
    let t61 = p.k31 * t57 + t55 * p.k2;
    let t62 = t11 * t11;
    let t63 = t0 * t10;
    let t64 = p.k31 * (sin_q_6 * (t53 - t54 * p.c) + cos_q_6 * (p.c * t47 + t48));
    let t65 = t35 * p.k0 - t36 * p.k1 - t56 * (t44 - t37) - p.k29 * (t38 + t52) - t64;
    let t66 = t50 * p.k30 - p.k29 * (t43 - t44) - t56 * (t52 - t38);
    let t67 = t66 - p.k31 * (cos_q_5 * t41 - sin_q_5 * t45 - p.c * t55);
    let t68 = p.k31 * t58 + t54 * p.k2;
    let t69 = t47 * p.k2 - p.k31 * t60;
    let t70 = t16 + t63;
    let t71 = S::from_ratio(1, 500);
    let t72 = t35 * p.k4 - t23 * (t20 * p.k3) - t65;
    let t73 = p.k35 * t58 + (t26 * p.k3 - t46 * p.k4 - t53 * p.k2) - sin_q_6 * t59;
    let t74 = cos_q_6 * t67 + t73;
    let t75 = cos_q_5 * t68 - sin_q_5 * t61;
    let t76 = cos_q_6 * t59 + (t42 * p.k28 + t48 * p.k2 - p.k35 * t60);
    let t77 = sin_q_6 * t67 + t76;
    let t78 = t74 + t14 * (t17 * p.k27);
    let t79 = sin_q_4 * t75 + cos_q_4 * t69;
    let t80 = sin_q_5 * t72 + (t13 * (t17 * p.k5) + t22 * p.k6) - cos_q_5 * t77;
    let t81 = t13 * (t14 * p.k6) + t16 * p.k5 - cos_q_5 * t72 - sin_q_5 * t77;
    let t82 = t9 * p.k25 + (t18 * p.k23 - t71 * (t3 - t62) - p.k24 * t70);
    let t83 = t10 * (t0 * p.k8 + t11 * t71) + t16 * p.k9 - t21 * p.k24 - t9 * p.k26;
    let t84 = t81 + t83;
    let t85 = p.a * (t79 + (t21 * p.k7 - t70 * p.k21));
    let t86 = sin_q_4 * t69 - cos_q_4 * t75;
    let t87 = p.k24 * (t25 - t62) + t30 * p.k9 - t71 * (t16 - t63);
    let t88 = p.b * t79 + t82 + (sin_q_4 * t78 - cos_q_4 * t80);
    let t89 = sin_q_3 * t84 + (t85 + (p.k19 * (t2 - t5 * t5) + t9 * p.k18));
    let t90 = p.b * t86 + (t31 * p.k7 + t34 * p.k21 - t87);
    let t91 = t90 - (sin_q_4 * t80 + cos_q_4 * t78);
    let t92 = sin_q_3 * (cos_q_5 * t61 + (t33 * p.k7 + t30 * p.k21 + sin_q_5 * t68));
    let t93 = sin_q_3 * t88 + (t4 * (t5 * p.k19 - q_2_dot * p.k20) - cos_q_3 * t84);
    let t94 = p.a * (t92 + cos_q_3 * (t86 + (p.k21 * (t3 + t62) + t30 * p.k7)));
    let t95 = cos_q_2 * t93 + (sin_q_2 * (cos_q_3 * t88 + t89) + q_1_dot * p.friction);
    let t96 = t94 + (t91 + (sin_q_2 * (t8 * p.k11 + p.k14) - q_2_dot * p.friction));
    let f_q_1 = u.tau[0] - t95;
    let f_q_2 = t96 + u.tau[1];
    let f_q_3 = u.tau[2] - (q_3_dot * p.friction - t91);
    let f_q_4 = u.tau[3] - (q_4_dot * p.friction - t81);
    let f_q_5 = u.tau[4] - (t74 + q_5_dot * p.friction);
    let f_q_6 = t65 - q_6_dot * p.friction + u.tau[5];
    [f_q_1, f_q_2, f_q_3, f_q_4, f_q_5, f_q_6]
}

::lagrangian::emitted::fast_function! {
    /// Accelerations `a`, the solution of `M a = f` from the mass matrix, factored.
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
    pub fn accelerations<'a, S>(Accelerations {
        p: &'a Prepared<S>,
        q: &'a [S; 6],
        v: &'a [S; 6],
        u: &'a Inputs<S>,
    }) -> Result<[S; 6], ::lagrangian::emitted::Singular> = accelerations_in;
}

#[inline(always)]
fn accelerations_in<S: Copy, N: ::lagrangian::emitted::Scalar<Stored = S>>(
    call: Accelerations<'_, S>,
) -> Result<[S; 6], ::lagrangian::emitted::Singular> {
    let Accelerations { p, q, v, u } = call;
    let n = N::load;
    let q_2 = n(q[1]);
    let q_3 = n(q[2]);
    let q_4 = n(q[3]);
    let q_5 = n(q[4]);
    let q_6 = n(q[5]);
    let q_1_dot = n(v[0]);
    let q_2_dot = n(v[1]);
    let q_3_dot = n(v[2]);
    let q_4_dot = n(v[3]);
    let q_5_dot = n(v[4]);
    let q_6_dot = n(v[5]);
    let angles = [q_6, q_5, q_4, q_2, q_3];
    let circular = N::sin_cos_all(angles);
    let (sin_q_6, cos_q_6) = circular[0];
    let (sin_q_5, cos_q_5) = circular[1];
    let (sin_q_4, cos_q_4) = circular[2];
    let (sin_q_2, cos_q_2) = circular[3];
    let (sin_q_3, cos_q_3) = circular[4];
    let t0 = q_3_dot + q_2_dot;
    let t1 = q_1_dot * q_2_dot;
    let t2 = q_2_dot * q_2_dot;
    let t3 = t0 * t0;
    let t4 = N::from_ratio(1, 500);
    let t5 = sin_q_6 * n(p.k33);
    let t6 = cos_q_6 * cos_q_5;
    let t7 = cos_q_6 * sin_q_5;
    let t8 = sin_q_6 * sin_q_4;
    let t9 = n(p.k1).mul_add(sin_q_6, cos_q_6 * t4);
    let t10 = t7.neg_mul_add(n(p.k31), cos_q_5 * n(p.k2));
    let t11 = t6.mul_add(n(p.k31), sin_q_5 * n(p.k2));
    let t12 = sin_q_6 * t9;
    let t13 = N::from_ratio(1, 1000);
    let t14 = cos_q_6.neg_mul_add(t9, t13);
    let t15 = sin_q_4 * sin_q_4;
    let t16 = cos_q_4 * t10;
    let t17 = sin_q_4 * t10;
    let t18 = cos_q_4.mul_sub(t11, n(p.k31) * t8);
    let t19 = cos_q_2.mul_sub(cos_q_3, sin_q_2 * sin_q_3);
    let t20 = n(p.k1) - t12;
    let t21 = sin_q_5.mul_sub(t14, cos_q_5 * t5);
    let t22 = cos_q_5.mul_add(t14, sin_q_5 * t5);
    let t23 = t12 + n(p.k3);
    let t24 = cos_q_4 * t16;
    let t25 = sin_q_2 * n(p.a);
    let t26 = t18 + n(p.k21);
    let t27 = cos_q_2.mul_add(sin_q_3, sin_q_2 * cos_q_3);
    let t28 = sin_q_4 * t22;
    let t29 = sin_q_4.mul_add(t17, t24);
    let t30 = sin_q_5.mul_add(t20 - n(p.k37), t6 * n(p.k38));
    let t31 = sin_q_6 * cos_q_4;
    let t32 = n(p.k7) + t29;
    let t33 = cos_q_5.mul_sub(t30, cos_q_6 * n(p.k33));
    let t34 = sin_q_5 * t30;
    let t35 = t6.mul_add(n(p.k42), sin_q_5 * n(p.k40));
    let t36 = t34 + n(p.k39);
    let t37 = t34 + (n(p.k6) - t20);
    let t38 = cos_q_2.neg_mul_add(cos_q_2 * n(p.k11), n(p.k12));
    let t39 = sin_q_4.mul_add(t11, n(p.k31) * t31);
    let t40 = cos_q_4 * t22;
    let t41 = t18.mul_add(n(p.b), cos_q_4.mul_add(t33, sin_q_4 * t21));
    let t42 = sin_q_4.mul_sub(t16, cos_q_4 * t17);
    let t43 = n(p.a) * cos_q_3;
    let t44 = t41 + n(p.k24);
    let t45 = cos_q_4.neg_mul_add(t37, N::from_f64(2.0) * t28);
    let t46 = sin_q_4.neg_mul_add(t33, cos_q_4 * t21);
    let t47 = n(p.b).neg_mul_add(t39, t46);
    let t48 = cos_q_4.mul_add(t45, n(p.two_b).mul_add(t29, t23 * t15));
    let t49 = t4 + t47;
    let t50 = t43 * t39;
    let t51 = t10.mul_add(t15, t24);
    let t52 = t27.mul_add(t44, t19.mul_add(t36 + n(p.k9), t25 * t26));
    let t53 = t25.mul_add(t32.mul_add(t27, t26 * t19), t38);
    let t54 = n(p.b).mul_add(t42, sin_q_4 * t28);
    let t55 = cos_q_4.mul_sub(sin_q_4.mul_add(t23 + t37, t40), t54);
    let t56 = sin_q_3 * sin_q_4.mul_add(t35, t31 * n(p.k42));
    let t57 = t23.mul_add(cos_q_4 * cos_q_4, n(p.k8));
    let t58 = t19.mul_add(t44, t27.mul_add(t48, t25 * t32));
    // Row q[1]: pivot d[q[1]].
    let t59 = t27.mul_add(t58, t19.mul_add(t52, t53));
    let t60 = sin_q_3 * cos_q_4.mul_sub(t35, t8 * n(p.k42));
    let t61 = t27 * q_1_dot;
    let t62 = sin_q_2 * q_1_dot;
    let t63 = cos_q_2 * q_1_dot;
    let t64 = N::ONE / t59;
    let t65 = sin_q_4.mul_add(t37, N::from_f64(2.0) * t40);
    let t66 = sin_q_4.neg_mul_add(t65, n(p.two_b).mul_add(t51, t57));
    let t67 = t43.neg_mul_add(t51 + n(p.k7), sin_q_3 * n(p.k34));
    let t68 = t19 * q_1_dot;
    let t69 = sin_q_4.mul_add(t61, cos_q_4 * t0);
    let t70 = cos_q_4.mul_sub(t61, sin_q_4 * t0);
    let t71 = q_1_dot * t63;
    let t72 = t19.mul_sub(t49 - t50, cos_q_2 * n(p.k19));
    let t73 = t27.mul_add(t55 - t43.mul_add(t42, t56), t72);
    let t74 = t66 - t67;
    let t75 = t68.mul_add(q_3_dot, t19 * t1);
    let t76 = q_3_dot.mul_add(t61, t27 * t1);
    let t77 = t68 + q_4_dot;
    let t78 = t69 + q_5_dot;
    let t79 = n(p.a).neg_mul_add(t62.mul_add(t62, t2), cos_q_2 * n(p.g));
    let t80 = t68 * t0;
    let t81 = q_2_dot * t63;
    // Eliminates q[1] from row q[2]: l[q[2], q[1]].
    let t82 = t64 * t73;
    let t83 = t74 + (N::from_f64(2.0).neg_mul_add(t60, n(p.k10)) - t67);
    let t84 = cos_q_4.mul_sub(t75, q_4_dot * t69);
    let t85 = sin_q_5.mul_add(t77, cos_q_5 * t70);
    let t86 = cos_q_5.mul_sub(t77, sin_q_5 * t70);
    let t87 = sin_q_2 * n(p.a).mul_add(t71, n(p.g));
    let t88 = t75 + t80;
    let t89 = t61 * t61;
    // Row q[2]: pivot d[q[2]].
    let t90 = t73.neg_mul_add(t82, t83);
    let t91 = sin_q_6.mul_add(t85, cos_q_6 * t78);
    let t92 = cos_q_6.mul_sub(t85, sin_q_6 * t78);
    let t93 = t86 + q_6_dot;
    let t94 = q_4_dot.mul_add(t70, sin_q_4 * t75);
    let t95 = t68 * t61;
    let t96 = cos_q_3.mul_add(t87, sin_q_3 * t79);
    let t97 = n(p.b).mul_add(t88, t81 * n(p.two_a));
    let t98 = t3 + t89;
    let t99 = sin_q_3.neg_mul_add(t87, cos_q_3 * t79);
    let t100 = N::ONE / t90;
    let t101 = t27.mul_add(t55, t19 * t49);
    let t102 = t85.mul_add(q_5_dot, sin_q_5.mul_add(t84, cos_q_5 * t76));
    let t103 = t91 * t92;
    let t104 = t91 * t91;
    let t105 = t91 * t93;
    let t106 = t86.mul_add(q_5_dot, cos_q_5.mul_sub(t84, sin_q_5 * t76));
    let t107 = n(p.b).mul_add(t95, t96);
    let t108 = n(p.b).neg_mul_add(t98, t99);
    let t109 = t86 * t78;
    let t110 = t93 * t93;
    // Eliminates q[1] from row q[3]: l[q[3], q[1]].
    let t111 = t64 * t101;
    let t112 = t92 * t92;
    let t113 = cos_q_4.mul_sub(t107, sin_q_4 * t97);
    let t114 = t85 * t86;
    let t115 = t109 + t106;
    let t116 = sin_q_4.mul_add(t107, cos_q_4 * t97);
    let t117 = t103 + t102;
    let t118 = t92 * t93;
    let t119 = t104 + t110;
    let t120 = t73.mul_add(t111, t60 - t74);
    let t121 = cos_q_6.mul_sub(t106, sin_q_6 * t94);
    let t122 = t91.neg_mul_add(q_6_dot, t121);
    let t123 = cos_q_5.mul_add(t113, sin_q_5 * t108);
    let t124 = t94 - t114;
    let t125 = t85.mul_add(t85, t78 * t78);
    // Eliminates q[2] from row q[3]: l[q[3], q[2]].
    let t126 = t100 * t120;
    let t127 = t27.mul_add(t41, t36.mul_add(t19, t25 * t18));
    let t128 = n(p.k0).mul_sub(t102, n(p.k1) * t103);
    let t129 = n(p.k29).mul_add(t117, n(p.k0) * t105);
    let t130 = t92.mul_add(q_6_dot, sin_q_6.mul_add(t106, cos_q_6 * t94));
    let t131 = t118 + t130;
    let t132 = sin_q_6.mul_sub(t117, cos_q_6 * t119);
    let t133 = t114.neg_mul_add(n(p.k4), n(p.k3) * t94);
    // Row q[3]: pivot d[q[3]].
    let t134 = t120.neg_mul_add(t126, t101.neg_mul_add(t111, t66));
    // Eliminates q[1] from row q[4]: l[q[4], q[1]].
    let t135 = t64 * t127;
    let t136 = t10.mul_add(n(p.b), t23);
    let t137 = t13.neg_mul_add(t112 - t104, t128);
    let t138 = cos_q_6 * n(p.c).mul_add(t115, t116);
    let t139 = t13.neg_mul_add(t131, n(p.k1).mul_sub(t122, t129));
    let t140 = sin_q_6.mul_add(t119, cos_q_6 * t117);
    let t141 = n(p.k29).neg_mul_add(t110 - t112, t118 * n(p.k30));
    let t142 = sin_q_5.neg_mul_add(t113, cos_q_5 * t108);
    let t143 = n(p.k31).mul_add(t131, n(p.k2) * t125);
    let t144 = t68 * t68;
    let t145 = t0 * t61;
    let t146 = N::ONE / t134;
    let t147 = t73.neg_mul_add(t135, t47 - t50);
    let t148 = sin_q_6.mul_add(t124.neg_mul_add(n(p.c), t123), t138);
    let t149 = n(p.k29).neg_mul_add(t105 + t122, t137);
    let t150 = n(p.k31).neg_mul_add(t148, t149);
    let t151 = n(p.k2).mul_add(t116, t109 * n(p.k28));
    let t152 = t13.neg_mul_add(t122 - t105, t141);
    let t153 = n(p.k31).neg_mul_add(n(p.c).neg_mul_add(t125, t142), t152);
    let t154 = n(p.k35).mul_add(t132, n(p.k2).neg_mul_add(t123, t133));
    let t155 = n(p.k31).mul_add(t132, n(p.k2) * t124);
    let t156 = n(p.k31).neg_mul_add(t140, n(p.k2) * t115);
    let t157 = t76 + t145;
    // Eliminates q[2] from row q[4]: l[q[4], q[2]].
    let t158 = t100 * t147;
    let t159 = t19.mul_add(t21, t10 * (sin_q_4 * t25));
    let t160 = t27.mul_add(sin_q_4.mul_add(t136, t40), t159);
    let t161 = cos_q_4.mul_sub(t136, t28);
    let t162 = t102.mul_sub(n(p.k4), t85 * (n(p.k3) * t78)) - t150;
    let t163 = cos_q_6.mul_add(t153, sin_q_6.neg_mul_add(t139, t154));
    let t164 = cos_q_5.mul_sub(t155, sin_q_5 * t143);
    let t165 = t6.neg_mul_add(n(p.k33), sin_q_5 * n(p.k0));
    let t166 = n(p.k33).mul_add(t7, cos_q_5 * n(p.k0));
    let t167 = t120.mul_add(t158, t101.neg_mul_add(t135, t47));
    // Eliminates q[1] from row q[5]: l[q[5], q[1]].
    let t168 = t64 * t160;
    let t169 = n(p.k6).mul_add(t84, t69 * (t77 * n(p.k5)));
    let t170 = cos_q_6.mul_add(t139, n(p.k35).neg_mul_add(t140, t151));
    let t171 = sin_q_6.mul_add(t153, t170);
    let t172 = t70.mul_add(t77 * n(p.k27), t163);
    let t173 = sin_q_4.mul_add(t164, cos_q_4 * t156);
    let t174 = t4.neg_mul_add(t3 - t144, t80 * n(p.k23));
    let t175 = t69.mul_add(n(p.k6) * t70, t76 * n(p.k5));
    let t176 = t61.mul_add(t4.mul_add(t68, n(p.k8) * t0), n(p.k9) * t76);
    let t177 = cos_q_5.neg_mul_add(t8, cos_q_6 * cos_q_4);
    // Eliminates q[3] from row q[4]: l[q[4], q[3]].
    let t178 = t146 * t167;
    let t179 = t161 + t16.mul_sub(t43, sin_q_3 * t35);
    let t180 = t73.neg_mul_add(t168, t179);
    let t181 = cos_q_5.neg_mul_add(t171, sin_q_5.mul_add(t162, t169));
    let t182 = sin_q_5.neg_mul_add(t171, cos_q_5.neg_mul_add(t162, t175));
    let t183 = cos_q_4.mul_add(t165, sin_q_4 * t5);
    let t184 = n(p.k24).mul_add(t89 - t144, n(p.k9) * t95);
    let t185 = cos_q_5.mul_add(t31, cos_q_6 * sin_q_4);
    let t186 = t147.neg_mul_add(t158, t127.neg_mul_add(t135, t36));
    // Row q[4]: pivot d[q[4]].
    let t187 = t167.neg_mul_add(t178, t186);
    // Eliminates q[2] from row q[5]: l[q[5], q[2]].
    let t188 = t100 * t180;
    let t189 = t81.mul_add(n(p.k25), n(p.k24).neg_mul_add(t157, t174));
    let t190 = t81.neg_mul_add(n(p.k26), n(p.k24).neg_mul_add(t88, t176));
    let t191 = t182 + t190;
    let t192 = n(p.k19).mul_add(t63.neg_mul_add(t63, t2), t81 * n(p.k18));
    let t193 = t173 + n(p.k7).mul_sub(t88, n(p.k21) * t157);
    let t194 = t177.mul_add(sin_q_2 * n(p.k42), t19 * t166);
    let t195 = t27.mul_sub(n(p.k41).neg_mul_add(t177, t183), t194);
    let t196 = cos_q_4.neg_mul_add(t164, sin_q_4 * t156);
    let t197 = n(p.k7).mul_add(t96, n(p.k21) * t99);
    let t198 = n(p.k7).mul_add(t98, n(p.k21) * t95);
    let t199 = sin_q_4.mul_sub(t165, cos_q_4 * t5);
    let t200 = n(p.k41).neg_mul_add(t185, t199);
    let t201 = N::ONE / t187;
    let t202 = t120.mul_add(t188, t101.neg_mul_add(t168, t161));
    let t203 = cos_q_4.neg_mul_add(t181, sin_q_4 * t172);
    let t204 = n(p.b).mul_add(t173, t189) + t203;
    // Eliminates q[1] from row q[6]: l[q[6], q[1]].
    let t205 = t64 * t195;
    let t206 = t197 - t4.neg_mul_add(t76 - t145, t184);
    let t207 = cos_q_3.neg_mul_add(t185, sin_q_6 * (sin_q_5 * sin_q_3));
    // Eliminates q[3] from row q[5]: l[q[5], q[3]].
    let t208 = t146 * t202;
    let t209 = t62 * n(p.k19).mul_sub(t63, q_2_dot * n(p.k20));
    let t210 = sin_q_3.mul_add(t191, n(p.a).mul_add(t193, t192));
    let t211 = sin_q_4.mul_add(t181, cos_q_4 * t172);
    let t212 = n(p.b).mul_add(t196, t206) - t211;
    let t213 = n(p.k11).mul_add(t71, n(p.k14));
    let t214 = cos_q_5.mul_add(t143, sin_q_5.mul_add(t155, t198));
    let t215 = t73.mul_add(t205, n(p.k42).mul_add(t207, t200));
    let t216 = t147.neg_mul_add(t188, t127.neg_mul_add(t168, t21));
    let t217 = t167.neg_mul_add(t208, t216);
    let t218 = cos_q_3.mul_add(t204, t210);
    let t219 = t196 + n(p.k21).mul_add(t3 + t144, n(p.k7) * t95);
    // Eliminates q[2] from row q[6]: l[q[6], q[2]].
    let t220 = t100 * t215;
    // Eliminates q[4] from row q[5]: l[q[5], q[4]].
    let t221 = t201 * t217;
    let t222 = t180.neg_mul_add(t188, t160.neg_mul_add(t168, t23));
    let t223 = sin_q_3.mul_add(t204, cos_q_3.neg_mul_add(t191, t209));
    let t224 = sin_q_2.mul_add(t218, q_1_dot * n(p.friction));
    let t225 = t212 + sin_q_2.mul_sub(t213, q_2_dot * n(p.friction));
    let t226 = cos_q_3.mul_add(t219, sin_q_3 * t214);
    let t227 = t120.mul_add(t220, t101.mul_add(t205, t200));
    // Row q[5]: pivot d[q[5]].
    let t228 = t217.neg_mul_add(t221, t202.neg_mul_add(t208, t222));
    let t229 = n(u.tau[0]) - cos_q_2.mul_add(t223, t224);
    // Eliminates q[3] from row q[6]: l[q[6], q[3]].
    let t230 = t146 * t227;
    let t231 = N::ONE / t228;
    let t232 = q_6_dot.neg_mul_add(n(p.friction), t150) + n(u.tau[5]);
    let t233 = n(p.a).mul_add(t226, t225) + n(u.tau[1]);
    // Row q[2]: right-hand side z[q[2]].
    let t234 = t82.neg_mul_add(t229, t233);
    let t235 = n(u.tau[2]) - q_3_dot.mul_sub(n(p.friction), t212);
    let t236 = n(u.tau[3]) - q_4_dot.mul_sub(n(p.friction), t182);
    let t237 = t147.neg_mul_add(t220, t127.mul_add(t205, t166));
    let t238 = t167.neg_mul_add(t230, t237);
    let t239 = n(u.tau[4]) - q_5_dot.mul_add(n(p.friction), t163);
    // Row q[3]: right-hand side z[q[3]].
    let t240 = t126.mul_add(t234, t111.neg_mul_add(t229, t235));
    // Eliminates q[4] from row q[6]: l[q[6], q[4]].
    let t241 = t201 * t238;
    let t242 = t180.neg_mul_add(t220, t160.mul_sub(t205, t5));
    let t243 = t220.neg_mul_add(t234, t205.mul_add(t229, t232));
    let t244 = t158.neg_mul_add(t234, t135.neg_mul_add(t229, t236));
    // Row q[4]: right-hand side z[q[4]].
    let t245 = t178.neg_mul_add(t240, t244);
    let t246 = t188.neg_mul_add(t234, t168.neg_mul_add(t229, t239));
    let t247 = t217.neg_mul_add(t241, t202.neg_mul_add(t230, t242));
    let t248 = t215.neg_mul_add(t220, t195.neg_mul_add(t205, n(p.k0)));
    // Row q[5]: right-hand side z[q[5]].
    let t249 = t221.neg_mul_add(t245, t208.neg_mul_add(t240, t246));
    // Eliminates q[5] from row q[6]: l[q[6], q[5]].
    let t250 = t231 * t247;
    let t251 = t241.neg_mul_add(t245, t230.neg_mul_add(t240, t243));
    let t252 = t238.neg_mul_add(t241, t227.neg_mul_add(t230, t248));
    // Row q[6]: pivot d[q[6]].
    let t253 = t247.neg_mul_add(t250, t252);
    // Row q[6]: right-hand side z[q[6]].
    let q_6_ddot = t250.neg_mul_add(t249, t251) / t253;
    // Back substitution: a[q[5]].
    let q_5_ddot = t250.neg_mul_add(q_6_ddot, t231 * t249);
    let t254 = t205.mul_add(q_6_ddot, t64 * t229);
    let t255 = t241.neg_mul_add(q_6_ddot, t201 * t245);
    // Back substitution: a[q[4]].
    let q_4_ddot = t221.neg_mul_add(q_5_ddot, t255);
    let t256 = t230.neg_mul_add(q_6_ddot, t146 * t240);
    let t257 = t220.neg_mul_add(q_6_ddot, t100 * t234);
    let t258 = t168.neg_mul_add(q_5_ddot, t254);
    let t259 = t208.neg_mul_add(q_5_ddot, t256);
    // Back substitution: a[q[3]].
    let q_3_ddot = t178.neg_mul_add(q_4_ddot, t259);
    let t260 = t188.neg_mul_add(q_5_ddot, t257);
    let t261 = t135.neg_mul_add(q_4_ddot, t258);
    // Back substitution: a[q[2]].
    let q_2_ddot = t126.mul_add(q_3_ddot, t158.neg_mul_add(q_4_ddot, t260));
    let t262 = t111.neg_mul_add(q_3_ddot, t261);
    // Back substitution: a[q[1]].
    let q_1_ddot = t82.neg_mul_add(q_2_ddot, t262);
    let sound = PIVOTS.hold(t59, t59)
        & PIVOTS.hold(t90, t83)
        & PIVOTS.hold(t134, t66)
        & PIVOTS.hold(t187, t36)
        & PIVOTS.hold(t228, t23)
        & PIVOTS.hold(t253, n(p.k0))
        & q_1_ddot.is_finite();
    if !sound {
        let pivots = [
            (0, t59, t59),
            (1, t90, t83),
            (2, t134, t66),
            (3, t187, t36),
            (4, t228, t23),
            (5, t253, n(p.k0)),
        ];
        PIVOTS.check(pivots)?;
    }
    let accelerations = [
        q_1_ddot.store(),
        q_2_ddot.store(),
        q_3_ddot.store(),
        q_4_ddot.store(),
        q_5_ddot.store(),
        q_6_ddot.store(),
    ];
    Ok(accelerations)
}

/// Kinetic energy `T`, in J.
///
/// ```text
/// T = …
/// ```
pub fn kinetic_energy<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 6],
    v: &[S; 6],
) -> S {
    let q_2 = q[1];
    let q_3 = q[2];
    let q_4 = q[3];
    let q_5 = q[4];
    let q_6 = q[5];
    let q_1_dot = v[0];
    let q_2_dot = v[1];
    let q_3_dot = v[2];
    let q_4_dot = v[3];
    let q_5_dot = v[4];
    let q_6_dot = v[5];
    let (sin_q_2, cos_q_2) = q_2.sin_cos();
    let (sin_q_3, cos_q_3) = q_3.sin_cos();
    let (sin_q_4, cos_q_4) = q_4.sin_cos();
    let (sin_q_5, cos_q_5) = q_5.sin_cos();
    let (sin_q_6, cos_q_6) = q_6.sin_cos();
    let t0 = q_3_dot + q_2_dot;
    let t1 = S::from_ratio(13, 100);
    let t2 = S::from_ratio(9, 100);
    let t3 = sin_q_2 * q_1_dot;
    let t4 = cos_q_2 * q_1_dot;
    let t5 = cos_q_3 * (q_2_dot * p.a);
    let t6 = sin_q_3 * q_2_dot;
    let t7 = t3 * p.a;
    let t8 = t5 + t0 * p.b;
    let t9 = t6 * p.a;
    let t10 = t5 + t0 * p.half_b;
    let t11 = S::from_ratio(3, 100);
    let t12 = q_2_dot * p.half_a - t4 * t11;
    let t13 = t3 * t3;
    let t14 = sin_q_3 * t4 + t3 * cos_q_3;
    let t15 = cos_q_3 * t4 - t3 * sin_q_3;
    let t16 = S::from_ratio(1, 100);
    let t17 = t9 - t0 * t16;
    let t18 = t7 + t14 * p.b;
    let t19 = cos_q_4 * t14 - t0 * sin_q_4;
    let t20 = sin_q_4 * t14 + t0 * cos_q_4;
    let t21 = t15 + q_4_dot;
    let t22 = t15 * t16;
    let t23 = S::from_ratio(1, 500);
    let t24 = sin_q_4 * t18 + cos_q_4 * t8;
    let t25 = t20 + q_5_dot;
    let t26 = cos_q_4 * t18 - sin_q_4 * t8;
    let t27 = S::from_ratio(3, 1000);
    let t28 = cos_q_5 * t24 - sin_q_5 * t9;
    let t29 = t21 * cos_q_5 - sin_q_5 * t19;
    let t30 = t21 * sin_q_5 + cos_q_5 * t19;
    let t31 = S::from_ratio(1, 50);
    let t32 = t28 + t25 * p.c;
    let t33 = t29 + q_6_dot;
    let t34 = t30 * cos_q_6 - sin_q_6 * t25;
    let t35 = t26 + t30 * p.c;
    let t36 = cos_q_5 * t9 + sin_q_5 * t24;
    let t37 = t30 * sin_q_6 + cos_q_6 * t25;
    let t38 = t7 + (t22 + t14 * p.half_b);
    let t39 = S::from_ratio(2, 25);
    let t40 = t36 - t37 * t11;
    let t41 = S::from_ratio(1, 1000);
    let t42 = t26 + t30 * p.half_c;
    let t43 = t4 * (t4 * t31) + (t13 * t1 + q_2_dot * (q_2_dot * t1));
    let t44 = t37 * t39 + (sin_q_6 * t35 + cos_q_6 * t32);
    let t45 = t28 + t25 * p.half_c;
    let t46 = t15 * (t22 + t0 * t23) + (t14 * (t14 * t2) + t0 * (t0 * t2 + t15 * t23));
    let t47 = S::from_f64(0.5) * ((t13 * p.k13 + t12 * t12) * p.m2 + t43);
    let t48 = t11 * t33 + t34 * t39 + (cos_q_6 * t35 - sin_q_6 * t32);
    let t49 = t20 * (t20 * t27) + (t21 * (t21 * t23) + t19 * (t19 * t27));
    let t50 = S::from_f64(0.5) * ((t38 * t38 + (t17 * t17 + t10 * t10)) * p.m3 + t46);
    let t51 = t33 * (t33 * t16) + t34 * (t34 * t31 - t37 * t41);
    let t52 = t29 * (t29 * t41) + (t25 * (t25 * t23) + t30 * (t30 * t23));
    let t53 = (t26 * t26 + (t6 * (t6 * p.a_squared) + t24 * t24)) * p.m4 + t49;
    let t54 = (t48 * t48 + (t40 * t40 + t44 * t44)) * p.m6;
    let t55 = S::from_f64(0.5) * ((t45 * t45 + (t36 * t36 + t42 * t42)) * p.m5 + t52);
    let t56 = S::from_f64(0.5) * t53 + (t50 + (t47 + q_1_dot * (q_1_dot * p.k32)));
    let t57 = S::from_f64(0.5) * (t54 + (t51 - t37 * (t34 * t41 - t37 * t31)));
    t57 + (t55 + t56)
}

/// Potential energy `V`, in J.
///
/// ```text
/// V = …
/// ```
pub fn potential_energy<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 6]) -> S {
    let q_2 = q[1];
    let q_3 = q[2];
    let q_4 = q[3];
    let q_5 = q[4];
    let q_6 = q[5];
    let (sin_q_3, cos_q_3) = q_3.sin_cos();
    let (sin_q_2, cos_q_2) = q_2.sin_cos();
    let (sin_q_5, cos_q_5) = q_5.sin_cos();
    let (sin_q_4, cos_q_4) = q_4.sin_cos();
    let (sin_q_6, cos_q_6) = q_6.sin_cos();
    let t0 = p.h + cos_q_2 * p.a;
    let t1 = cos_q_3 * cos_q_2 - sin_q_3 * sin_q_2;
    let t2 = sin_q_3 * cos_q_2 + cos_q_3 * sin_q_2;
    let t3 = t2 * cos_q_4;
    let t4 = t0 + t1 * p.b;
    let t5 = cos_q_5 * t1 - sin_q_5 * t3;
    let t6 = t4 * p.m4_g + (p.m2_g * (p.h + cos_q_2 * p.half_a) + p.half_h_m1_g);
    let t7 = p.m3_g * (t0 + t1 * p.half_b - t2 * S::from_ratio(1, 100)) + t6;
    let t8 = cos_q_6 * (sin_q_5 * t1 + cos_q_5 * t3) - t2 * (sin_q_6 * sin_q_4);
    let t9 = t5 * S::from_ratio(2, 25) + (t4 + t5 * p.c) - S::from_ratio(3, 100) * t8;
    p.m6_g * t9 + (p.m5_g * (t4 + t5 * p.half_c) + t7)
}

/// Dissipation function `D`, in W.
///
/// ```text
/// D = 1/2*friction*der(q[1])^2 + 1/2*friction*der(q[2])^2 + 1/2*friction*der(q[3])^2
///     + 1/2*friction*der(q[4])^2 + 1/2*friction*der(q[5])^2 + 1/2*friction*der(q[6])^2
/// ```
pub fn dissipation<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, v: &[S; 6]) -> S {
    let q_1_dot = v[0];
    let q_2_dot = v[1];
    let q_3_dot = v[2];
    let q_4_dot = v[3];
    let q_5_dot = v[4];
    let q_6_dot = v[5];
    let t0 = q_4_dot * q_4_dot + q_3_dot * q_3_dot;
    let t1 = q_2_dot * q_2_dot + q_1_dot * q_1_dot + t0;
    (q_6_dot * q_6_dot + q_5_dot * q_5_dot + t1) * p.half_friction
}

/// Power `P` supplied by drives, forces and inputs, in W.
///
/// ```text
/// P = der(q[1])*tau[1] + der(q[2])*tau[2] + der(q[3])*tau[3] + der(q[4])*tau[4] + der(q[5])*tau[5]
///     + der(q[6])*tau[6]
/// ```
pub fn work_rate<S: ::lagrangian::emitted::Scalar>(v: &[S; 6], u: &Inputs<S>) -> S {
    let q_1_dot = v[0];
    let q_2_dot = v[1];
    let q_3_dot = v[2];
    let q_4_dot = v[3];
    let q_5_dot = v[4];
    let q_6_dot = v[5];
    let t0 = u.tau[3] * q_4_dot + u.tau[2] * q_3_dot;
    let t1 = u.tau[1] * q_2_dot + u.tau[0] * q_1_dot + t0;
    u.tau[5] * q_6_dot + u.tau[4] * q_5_dot + t1
}

/// Power `R` dissipated by dampers, in W.
///
/// ```text
/// R = friction*der(q[1])^2 + friction*der(q[2])^2 + friction*der(q[3])^2 + friction*der(q[4])^2
///     + friction*der(q[5])^2 + friction*der(q[6])^2
/// ```
pub fn dissipation_rate<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, v: &[S; 6]) -> S {
    let q_1_dot = v[0];
    let q_2_dot = v[1];
    let q_3_dot = v[2];
    let q_4_dot = v[3];
    let q_5_dot = v[4];
    let q_6_dot = v[5];
    let t0 = q_4_dot * q_4_dot + q_3_dot * q_3_dot;
    let t1 = q_2_dot * q_2_dot + q_1_dot * q_1_dot + t0;
    (q_6_dot * q_6_dot + q_5_dot * q_5_dot + t1) * p.friction
}

/// Height of the flange above the floor. Unit: `m`.
///
/// ```text
/// height = a*cos(q[2]) - c*cos(q[4])*sin(q[5])*sin(q[2] + q[3]) + c*cos(q[5])*cos(q[2] + q[3])
///     + b*cos(q[2] + q[3]) + h
/// ```
pub fn output_height<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 6]) -> S {
    let q_2 = q[1];
    let q_3 = q[2];
    let q_4 = q[3];
    let q_5 = q[4];
    let (sin_q_3, cos_q_3) = q_3.sin_cos();
    let (sin_q_2, cos_q_2) = q_2.sin_cos();
    let (sin_q_5, cos_q_5) = q_5.sin_cos();
    let cos_q_4 = q_4.cos();
    let t0 = cos_q_3 * cos_q_2 - sin_q_3 * sin_q_2;
    let t1 = (sin_q_3 * cos_q_2 + cos_q_3 * sin_q_2) * (sin_q_5 * cos_q_4);
    (cos_q_5 * t0 - t1) * p.c + (t0 * p.b + (cos_q_2 * p.a + p.h))
}

/// Everything that the description asks to observe.
pub fn outputs<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 6]) -> Outputs<S> {
    Outputs {
        height: output_height(p, q),
    }
}

::lagrangian::emitted::implement! {
    machine SixJointArm "SixJointArm" over S, R;
    parameters { h, a, b, c, m1, m2, m3, m4, m5, m6, friction, g } [
        h: "h" "m" = 0.35;
        a: "a" "m" = 0.4;
        b: "b" "m" = 0.42;
        c: "c" "m" = 0.1;
        m1: "m1" "kg" = 12.0;
        m2: "m2" "kg" = 9.0;
        m3: "m3" "kg" = 6.0;
        m4: "m4" "kg" = 1.5;
        m5: "m5" "kg" = 1.0;
        m6: "m6" "kg" = 5.2;
        friction: "friction" "N*m*s" = 0.4;
        g: "g" "m/s^2" = 9.81;
    ]
    coordinates 6 Coordinates { q: [q_1, q_2, q_3, q_4, q_5, q_6] } [
        q_1: "q[1]" "rad";
        q_2: "q[2]" "rad";
        q_3: "q[3]" "rad";
        q_4: "q[4]" "rad";
        q_5: "q[5]" "rad";
        q_6: "q[6]" "rad";
    ]
    inputs Inputs { tau: [tau_1, tau_2, tau_3, tau_4, tau_5, tau_6] } [
        tau_1: "tau[1]" "N*m" = 0.0;
        tau_2: "tau[2]" "N*m" = 0.0;
        tau_3: "tau[3]" "N*m" = 0.0;
        tau_4: "tau[4]" "N*m" = 0.0;
        tau_5: "tau[5]" "N*m" = 0.0;
        tau_6: "tau[6]" "N*m" = 0.0;
    ] over S
    outputs Outputs { height } [
        height: "height" "m";
    ]
    prepared Prepared {
        h, a, b, c, m2, m3, m4, m5, m6, friction, g, half_a, half_b, half_c, k0, k1, k2, k3, k4, k5,
        k6, k7, k8, k9, k10, k11, k12, a_squared, k13, m2_g, m3_g, m4_g, m5_g, m6_g, half_h_m1_g,
        half_friction, k14, k15, k16, k17, two_a, k18, k19, k20, k21, k22, k23, k24, k25, k26, k27,
        k28, k29, k30, k31, k32, k33, k34, k35, k36, k37, k38, k39, k40, k41, k42, two_b,
    }
    accelerations { (p, t, q, v, u) Accelerations { p, q, v, u } }
    system {
        matrix mass_matrix(p, t, q) = mass_matrix(p, q);
        vector bias(p, t, q, v) = bias(p, q, v);
        vector applied(p, t, q, v, u) = applied(p, q, v, u);
        vector forces(p, t, q, v, u) = forces(p, q, v, u);
        number kinetic_energy(p, t, q, v) = kinetic_energy(p, q, v);
        number potential_energy(p, t, q, u) = potential_energy(p, q);
        number dissipation(p, t, q, v, u) = dissipation(p, v);
        number work_rate(p, t, q, v, a, u) = work_rate(v, u);
        number dissipation_rate(p, t, q, v, u) = dissipation_rate(p, v);
        outputs outputs(p, t, q, v, a, u) = outputs(p, q);
    }
    absent [MAY_BE_CONSTRAINED MAY_SLIDE MAY_COLLIDE]
    intervals []
    lanes [N]
    numbers [yes]
}
