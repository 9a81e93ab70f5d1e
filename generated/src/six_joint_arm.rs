// @generated from machines/six_joint_arm.machine by `cargo xtask generate`; edits are lost.

//! An industrial arm with six revolute joints: a turning column, shoulder and elbow in its plane,
//! and
//! a wrist of three axes. Masses and sizes are those of a desk-sized arm that carries 5 kg.
//!
//! 6 coordinates, 12 parameters, 6 inputs, 1 output. Arithmetic of one call:
//!
//! | function | mul | add | div | sin cos | other | temporaries |
//! | --- | --: | --: | --: | --: | --: | --: |
//! | `prepare` | 67 | 50 | 0 | 0 | 0 | 117 |
//! | `mass_matrix` | 129 | 88 | 0 | 5 | 0 | 227 |
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

/// An industrial arm with six revolute joints: a turning column, shoulder and elbow in its plane,
/// and
/// a wrist of three axes. Masses and sizes are those of a desk-sized arm that carries 5 kg.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SixJointArm<S = f64> {
    /// Heights and lengths: column, upper arm, forearm, wrist to flange. Unit: m. Default: 0.35.
    pub h: S,
    /// `a`. Unit: m. Default: 0.4.
    pub a: S,
    /// `b`. Unit: m. Default: 0.42.
    pub b: S,
    /// `c`. Unit: m. Default: 0.1.
    pub c: S,
    /// Masses: column, upper arm, forearm, wrist, hand, flange with its load. Unit: kg. Default:
    /// 12.
    pub m1: S,
    /// `m2`. Unit: kg. Default: 9.
    pub m2: S,
    /// `m3`. Unit: kg. Default: 6.
    pub m3: S,
    /// `m4`. Unit: kg. Default: 1.5.
    pub m4: S,
    /// `m5`. Unit: kg. Default: 1.
    pub m5: S,
    /// `m6`. Unit: kg. Default: 5.2.
    pub m6: S,
    /// Viscous friction in each joint. Unit: N*m*s. Default: 0.4.
    pub friction: S,
    /// `g`. Unit: m/s^2. Default: 9.81.
    pub g: S,
}

impl Default for SixJointArm {
    fn default() -> Self {
        Self {
            h: 0.35,
            a: 0.4,
            b: 0.42,
            c: 0.1,
            m1: 12.0,
            m2: 9.0,
            m3: 6.0,
            m4: 1.5,
            m5: 1.0,
            m6: 5.2,
            friction: 0.4,
            g: 9.81,
        }
    }
}

impl<S> SixJointArm<S> {
    /// The same over other numbers.
    pub fn map<R>(self, f: impl Fn(S) -> R) -> SixJointArm<R> {
        SixJointArm {
            h: f(self.h),
            a: f(self.a),
            b: f(self.b),
            c: f(self.c),
            m1: f(self.m1),
            m2: f(self.m2),
            m3: f(self.m3),
            m4: f(self.m4),
            m5: f(self.m5),
            m6: f(self.m6),
            friction: f(self.friction),
            g: f(self.g),
        }
    }
}

impl<S: ::lagrangian::Scalar> SixJointArm<S> {
    /// Computes what depends on the parameters alone, once.
    pub fn prepare(&self) -> Prepared<S> {
        let t0 = S::from_ratio(9, 10000);
        let t1 = S::from_ratio(1, 100);
        let k3 = t1 + self.m6 * t0;
        let t2 = S::from_ratio(1, 50);
        let t3 = t2 + self.m6 * S::from_ratio(73, 10000);
        let k4 = t2 + self.m6 * S::from_ratio(4, 625) - t3;
        let t4 = self.c * self.m6;
        let t5 = self.c * self.m5;
        let k5 = S::from_f64(0.5) * t5 + (self.m6 * S::from_ratio(2, 25) + t4);
        let t6 = S::from_ratio(1, 500);
        let t7 = t3 + (t4 * S::from_ratio(4, 25) + self.c * t4);
        let k6 = t7 + (t6 + t5 * (self.c * S::from_f64(0.25)));
        let k7 = k6 - S::from_ratio(1, 1000);
        let k8 = t6 + k6;
        let t8 = S::from_ratio(3, 1000);
        let k9 = t8 - (k6 + t8);
        let t9 = self.b * self.m3;
        let t10 = self.m4 + (self.m5 + self.m6);
        let t11 = self.b * t10;
        let k10 = S::from_f64(0.5) * t9 + t11;
        let t12 = t9 * (self.b * S::from_f64(0.25));
        let t13 = S::from_ratio(1, 10000);
        let t14 = self.m3 * t13;
        let t15 = S::from_ratio(9, 100);
        let t16 = t8 + self.b * t11;
        let k11 = t16 + (t15 + (t12 + t14));
        let t17 = t16 + (t15 + t12);
        let k12 = t1 + t14 - t17;
        let k16 = self.a * self.a;
        let t18 = self.m3 + t10;
        let t19 = k16 * t18;
        let t20 = k16 * (self.m2 * S::from_f64(0.25));
        let t21 = S::from_ratio(13, 100);
        let k13 = t19 + (t21 + t20);
        let t22 = self.m2 * t0;
        let t23 = t17 + t19 + (t21 + (t20 + t22));
        let k14 = t23 - (t17 + (t2 + t22));
        let t24 = self.a * self.m2;
        let k33 = self.m3 * t1;
        let k34 = self.a * k10;
        let k41 = self.m6 * S::from_ratio(3, 1250);
        let k43 = self.m6 * S::from_ratio(3, 100);
        let t25 = S::from_f64(2.0) + self.c * S::from_f64(25.0);
        let k45 = t25 * (self.m6 * S::from_ratio(3, 2500));
        let k49 = k3 - k7;
        let k0 = self.a * S::from_f64(0.5);
        let k1 = self.b * S::from_f64(0.5);
        let k2 = self.c * S::from_f64(0.5);
        let k15 = t23 + (t13 * self.m1 + S::from_ratio(3, 50));
        let k17 = t13 * (k16 * S::from_f64(2500.0) + S::from_f64(9.0));
        let k18 = self.m2 * self.g;
        let k19 = self.m3 * self.g;
        let k20 = self.m4 * self.g;
        let k21 = self.m5 * self.g;
        let k22 = self.m6 * self.g;
        let k23 = self.h * self.m1 * (self.g * S::from_f64(0.5));
        let k24 = self.friction * S::from_f64(0.5);
        let k25 = self.g * (S::from_f64(0.5) * t24 + self.a * t18);
        let k26 = self.g * k10;
        let k27 = self.g * k33;
        let k28 = self.g * k5;
        let k29 = self.a * S::from_f64(2.0);
        let k30 = k13 + k14;
        let k31 = t24 * S::from_ratio(3, 200);
        let k32 = k13 - k14;
        let k35 = k11 - k12;
        let k36 = t9 * S::from_ratio(1, 200);
        let k37 = S::from_f64(2.0) * k34;
        let k38 = t2 * (self.a * self.m3);
        let k39 = k8 + k9;
        let k40 = k6 + k7;
        let k42 = k3 - k4;
        let k44 = S::from_ratio(1, 20000) * (self.m1 + S::from_f64(600.0));
        let k46 = self.a * k33;
        let k47 = self.c * k43;
        let k48 = self.g * k43;
        let k50 = k41 * t25;
        let k51 = k8 + k49;
        let k52 = self.a * k5;
        let k53 = self.b * k43;
        let k54 = self.a * k43;
        let k55 = self.b * S::from_f64(2.0);
        let k56 = -k45;
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
            k37,
            k38,
            k39,
            k40,
            k41,
            k42,
            k43,
            k44,
            k45,
            k46,
            k47,
            k48,
            k49,
            k50,
            k51,
            k52,
            k53,
            k54,
            k55,
            k56,
        }
    }

    /// The start values of the description, at rest and `t = 0`.
    pub fn start(&self) -> ::lagrangian::State<Coordinates<S>> {
        let q_1 = S::from_ratio(1, 5);
        let q = [q_1, q_1, q_1, q_1, q_1, q_1];
        let v = [S::ZERO; 6];
        ::lagrangian::State {
            t: 0.0,
            q: Coordinates::from_array(q),
            v: Coordinates::from_array(v),
        }
    }
}

/// The coordinates of [`SixJointArm`], or their rates, by name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coordinates<S = f64> {
    /// `q`. Unit: rad. Members: `q[1]` to `q[6]`.
    pub q: [S; 6],
}

impl<S: Copy> Coordinates<S> {
    /// The numbers in the order of the description: the order of `q` in every function here.
    pub fn to_array(self) -> [S; 6] {
        [
            self.q[0], self.q[1], self.q[2], self.q[3], self.q[4], self.q[5],
        ]
    }

    /// Names for numbers in the order of the description.
    pub fn from_array(q: [S; 6]) -> Self {
        Self {
            q: [q[0], q[1], q[2], q[3], q[4], q[5]],
        }
    }

    /// The same over other numbers.
    pub fn map<R>(self, f: impl Fn(S) -> R) -> Coordinates<R> {
        Coordinates { q: self.q.map(&f) }
    }
}

/// What can be set while a [`SixJointArm`] runs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Inputs<S = f64> {
    /// Torques of the motors. Unit: N*m. Members: `tau[1]` to `tau[6]`.
    pub tau: [S; 6],
}

impl Default for Inputs {
    fn default() -> Self {
        Self {
            tau: [0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
        }
    }
}

impl<S> Inputs<S> {
    /// The same over other numbers.
    pub fn map<R>(self, f: impl Fn(S) -> R) -> Inputs<R> {
        Inputs {
            tau: self.tau.map(&f),
        }
    }
}

/// What can be observed of a [`SixJointArm`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outputs<S = f64> {
    /// Height of the flange above the floor. Unit: m.
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
    k0: S,
    /// `0.5*b`
    k1: S,
    /// `0.5*c`
    k2: S,
    /// `0.01 + 0.0009*m6`
    k3: S,
    /// `0.02 + 0.0064*m6 - (0.02 + 0.0073*m6)`
    k4: S,
    /// `c*m6 + 0.08*m6 + 0.5*c*m5`
    k5: S,
    /// `0.002 + 0.25*c^2*m5 + 0.02 + 0.0073*m6 + c^2*m6 + 0.16*c*m6`
    k6: S,
    /// `0.002 + 0.25*c^2*m5 + 0.02 + 0.0073*m6 + c^2*m6 + 0.16*c*m6 - 0.001`
    k7: S,
    /// `0.002 + 0.002 + 0.25*c^2*m5 + 0.02 + 0.0073*m6 + c^2*m6 + 0.16*c*m6`
    k8: S,
    /// `0.003 - (0.002 + 0.25*c^2*m5 + 0.02 + 0.0073*m6 + c^2*m6 + 0.16*c*m6 + 0.003)`
    k9: S,
    /// `b*(m4 + m5 + m6) + 0.5*b*m3`
    k10: S,
    /// `0.0001*m3 + 0.25*b^2*m3 + 0.09 + 0.003 + b^2*(m4 + m5 + m6)`
    k11: S,
    /// `0.01 + 0.0001*m3 - (0.25*b^2*m3 + 0.09 + 0.003 + b^2*(m4 + m5 + m6))`
    k12: S,
    /// `0.25*a^2*m2 + 0.13 + a^2*(m3 + m4 + m5 + m6)`
    k13: S,
    /// `0.0009*m2 + 0.25*a^2*m2 + 0.13 + 0.25*b^2*m3 + 0.09 + 0.003 + b^2*(m4 + m5 + m6) + a^2*(m3
    /// + m4 + m5…`
    k14: S,
    /// `0.06 + 0.0001*m1 + 0.0009*m2 + 0.25*a^2*m2 + 0.13 + 0.25*b^2*m3 + 0.09 + 0.003 + b^2*(m4 +
    /// m5 + m6) …`
    k15: S,
    /// `a^2`
    k16: S,
    /// `0.0001*(9 + 2500*a^2)`
    k17: S,
    /// `m2*g`
    k18: S,
    /// `m3*g`
    k19: S,
    /// `m4*g`
    k20: S,
    /// `m5*g`
    k21: S,
    /// `m6*g`
    k22: S,
    /// `0.5*h*m1*g`
    k23: S,
    /// `0.5*friction`
    k24: S,
    /// `g*(a*(m3 + m4 + m5 + m6) + 0.5*a*m2)`
    k25: S,
    /// `g*(b*(m4 + m5 + m6) + 0.5*b*m3)`
    k26: S,
    /// `0.01*m3*g`
    k27: S,
    /// `g*(c*m6 + 0.08*m6 + 0.5*c*m5)`
    k28: S,
    /// `2*a`
    k29: S,
    /// `0.25*a^2*m2 + 0.13 + a^2*(m3 + m4 + m5 + m6) + 0.0009*m2 + 0.25*a^2*m2 + 0.13 + 0.25*b^2*m3
    /// + 0.09 +…`
    k30: S,
    /// `0.015*a*m2`
    k31: S,
    /// `0.25*a^2*m2 + 0.13 + a^2*(m3 + m4 + m5 + m6) - (0.0009*m2 + 0.25*a^2*m2 + 0.13 +
    /// 0.25*b^2*m3 + 0.09 …`
    k32: S,
    /// `0.01*m3`
    k33: S,
    /// `a*(b*(m4 + m5 + m6) + 0.5*b*m3)`
    k34: S,
    /// `0.0001*m3 + 0.25*b^2*m3 + 0.09 + 0.003 + b^2*(m4 + m5 + m6) - (0.01 + 0.0001*m3 -
    /// (0.25*b^2*m3 + 0.0…`
    k35: S,
    /// `0.005*b*m3`
    k36: S,
    /// `2*a*(b*(m4 + m5 + m6) + 0.5*b*m3)`
    k37: S,
    /// `0.02*a*m3`
    k38: S,
    /// `0.002 + 0.002 + 0.25*c^2*m5 + 0.02 + 0.0073*m6 + c^2*m6 + 0.16*c*m6 + 0.003 - (0.002 +
    /// 0.25*c^2*m5 +…`
    k39: S,
    /// `0.002 + 0.25*c^2*m5 + 0.02 + 0.0073*m6 + c^2*m6 + 0.16*c*m6 + 0.002 + 0.25*c^2*m5 + 0.02 +
    /// 0.0073*m6…`
    k40: S,
    /// `0.0024*m6`
    k41: S,
    /// `0.01 + 0.0009*m6 - (0.02 + 0.0064*m6 - (0.02 + 0.0073*m6))`
    k42: S,
    /// `0.03*m6`
    k43: S,
    /// `0.00005*(m1 + 600)`
    k44: S,
    /// `0.0012*m6*(2 + 25*c)`
    k45: S,
    /// `0.01*a*m3`
    k46: S,
    /// `0.03*c*m6`
    k47: S,
    /// `0.03*m6*g`
    k48: S,
    /// `0.01 + 0.0009*m6 - (0.002 + 0.25*c^2*m5 + 0.02 + 0.0073*m6 + c^2*m6 + 0.16*c*m6 - 0.001)`
    k49: S,
    /// `0.0024*m6*(2 + 25*c)`
    k50: S,
    /// `0.002 + 0.002 + 0.25*c^2*m5 + 0.02 + 0.0073*m6 + c^2*m6 + 0.16*c*m6 + 0.01 + 0.0009*m6 -
    /// (0.002 + 0.…`
    k51: S,
    /// `a*(c*m6 + 0.08*m6 + 0.5*c*m5)`
    k52: S,
    /// `0.03*b*m6`
    k53: S,
    /// `0.03*a*m6`
    k54: S,
    /// `2*b`
    k55: S,
    /// `-0.0012*m6*(2 + 25*c)`
    k56: S,
}

/// Mass matrix `M`, row by row.
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
pub fn mass_matrix<S: ::lagrangian::Scalar>(p: &Prepared<S>, q: &[S; 6]) -> [[S; 6]; 6] {
    let q_2 = q[1];
    let q_3 = q[2];
    let q_4 = q[3];
    let q_5 = q[4];
    let q_6 = q[5];
    let (sin_q_6, cos_q_6) = q_6.sin_cos();
    let t0 = S::from_ratio(1, 500);
    let t1 = sin_q_6 * p.k4 + cos_q_6 * t0;
    let t2 = sin_q_6 * t1;
    let t3 = p.k4 - t2;
    let (sin_q_5, cos_q_5) = q_5.sin_cos();
    let t4 = cos_q_6 * cos_q_5;
    let t5 = t4 * p.k50 + sin_q_5 * (t3 - p.k49);
    let t6 = cos_q_5 * t5 - cos_q_6 * p.k45;
    let (sin_q_4, cos_q_4) = q_4.sin_cos();
    let t7 = S::from_ratio(1, 1000) - cos_q_6 * t1;
    let t8 = sin_q_6 * p.k45;
    let m54 = sin_q_5 * t7 - cos_q_5 * t8;
    let t9 = p.k43 * t4 + sin_q_5 * p.k5;
    let t10 = sin_q_6 * sin_q_4;
    let t11 = cos_q_4 * t9 - t10 * p.k43;
    let t12 = cos_q_4 * t6 + sin_q_4 * m54 + t11 * p.b;
    let t13 = t12 + p.k36;
    let (sin_q_2, cos_q_2) = q_2.sin_cos();
    let (sin_q_3, cos_q_3) = q_3.sin_cos();
    let t14 = cos_q_2 * sin_q_3 + sin_q_2 * cos_q_3;
    let t15 = cos_q_2 * cos_q_3 - sin_q_2 * sin_q_3;
    let t16 = sin_q_5 * t5;
    let m44 = t16 + p.k51;
    let t17 = t11 + p.k33;
    let t18 = sin_q_2 * p.a;
    let t19 = cos_q_6 * sin_q_5;
    let t20 = cos_q_5 * p.k5 - p.k43 * t19;
    let t21 = cos_q_4 * t20;
    let t22 = cos_q_4 * t21;
    let t23 = sin_q_4 * t20;
    let t24 = t22 + sin_q_4 * t23;
    let t25 = p.k10 + t24;
    let t26 = t18 * (t17 * t15 + t25 * t14) + (p.k15 - cos_q_2 * (cos_q_2 * p.k14));
    let t27 = t16 + (p.k9 - t3);
    let t28 = sin_q_5 * t8 + cos_q_5 * t7;
    let t29 = sin_q_4 * t28;
    let m55 = t2 + p.k6;
    let t30 = sin_q_4 * sin_q_4;
    let t31 = cos_q_4 * (t29 * S::from_f64(2.0) - cos_q_4 * t27);
    let t32 = t15 * t13 + (t18 * t25 + t14 * (t31 + (t24 * p.k55 + t30 * m55)));
    let t33 = t15 * (t14 * t13 + (t18 * t17 + t15 * (m44 + p.k12))) + t26;
    let t34 = cos_q_4 * t28;
    let t35 = sin_q_4 * t21 - cos_q_4 * t23;
    let t36 = cos_q_4 * (sin_q_4 * (t27 + m55) + t34) - (p.b * t35 + sin_q_4 * t29);
    let t37 = p.a * cos_q_3;
    let t38 = t4 * p.k54 + sin_q_5 * p.k52;
    let t39 = sin_q_6 * cos_q_4;
    let t40 = p.k43 * t39 + sin_q_4 * t9;
    let m43 = cos_q_4 * m54 - sin_q_4 * t6 - p.b * t40;
    let t41 = t0 + m43;
    let t42 = t37 * t40;
    let t43 = t14 * (t36 - (sin_q_3 * (sin_q_4 * t38 + t39 * p.k54) + t37 * t35));
    let t44 = t22 + t20 * t30;
    let t45 = sin_q_4 * (S::from_f64(2.0) * t34 + sin_q_4 * t27);
    let m33 = p.k55 * t44 + (m55 * (cos_q_4 * cos_q_4) + p.k11) - t45;
    let t46 = sin_q_3 * p.k46 - t37 * (p.k10 + t44);
    let t47 = m33 - t46;
    let t48 = sin_q_3 * (cos_q_4 * t38 - t10 * p.k54);
    let t49 = m55 + t20 * p.b;
    let m53 = cos_q_4 * t49 - t29;
    let m64 = t19 * p.k45 + cos_q_5 * p.k3;
    let t50 = cos_q_6 * cos_q_4 - t10 * cos_q_5;
    let t51 = sin_q_5 * p.k3 - t4 * p.k45;
    let t52 = t14 * (sin_q_4 * t8 + cos_q_4 * t51 - t50 * p.k53);
    let t53 = cos_q_5 * t39 + cos_q_6 * sin_q_4;
    let m63 = sin_q_4 * t51 - cos_q_4 * t8 - p.k53 * t53;
    let m11 = t14 * t32 + t33;
    let m21 = t43 + (t15 * (t41 - t42) - cos_q_2 * p.k31);
    let m22 = t47 + (p.k13 - S::from_f64(2.0) * t48 - t46);
    let m31 = t15 * t41 + t14 * t36;
    let m32 = t47 - t48;
    let m41 = t14 * t12 + (t18 * t11 + t15 * m44);
    let m42 = m43 - t42;
    let m51 = t14 * (t34 + sin_q_4 * t49) + (t20 * (t18 * sin_q_4) + t15 * m54);
    let m52 = m53 + (t21 * t37 - sin_q_3 * t38);
    let m61 = t50 * (sin_q_2 * p.k54) + t15 * m64 - t52;
    let m62 = p.k54 * (sin_q_6 * (sin_q_5 * sin_q_3) - cos_q_3 * t53) + m63;
    let m65 = sin_q_6 * p.k56;
    [
        [m11, m21, m31, m41, m51, m61],
        [m21, m22, m32, m42, m52, m62],
        [m31, m32, m33, m43, m53, m63],
        [m41, m42, m43, m44, m54, m64],
        [m51, m52, m53, m54, m55, m65],
        [m61, m62, m63, m64, m65, p.k3],
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
pub fn bias<S: ::lagrangian::Scalar>(p: &Prepared<S>, q: &[S; 6], v: &[S; 6]) -> [S; 6] {
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
    let t0 = cos_q_2 * cos_q_3 - sin_q_2 * sin_q_3;
    let t1 = q_1_dot * t0;
    let t2 = q_1_dot * q_2_dot;
    let t3 = q_3_dot * t1 + t0 * t2;
    let (sin_q_4, cos_q_4) = q_4.sin_cos();
    let t4 = cos_q_2 * sin_q_3 + sin_q_2 * cos_q_3;
    let t5 = q_1_dot * t4;
    let t6 = q_2_dot + q_3_dot;
    let t7 = t5 * sin_q_4 + t6 * cos_q_4;
    let t8 = cos_q_4 * t3 - q_4_dot * t7;
    let (sin_q_5, cos_q_5) = q_5.sin_cos();
    let t9 = q_3_dot * t5 + t4 * t2;
    let t10 = t1 + q_4_dot;
    let t11 = t5 * cos_q_4 - t6 * sin_q_4;
    let t12 = sin_q_5 * t10 + cos_q_5 * t11;
    let t13 = t12 * q_5_dot + (sin_q_5 * t8 + cos_q_5 * t9);
    let (sin_q_6, cos_q_6) = q_6.sin_cos();
    let t14 = t7 + q_5_dot;
    let t15 = sin_q_6 * t12 + cos_q_6 * t14;
    let t16 = cos_q_6 * t12 - sin_q_6 * t14;
    let t17 = t15 * t16;
    let t18 = t16 * t16;
    let t19 = t15 * t15;
    let t20 = S::from_ratio(1, 1000);
    let t21 = cos_q_5 * t10 - sin_q_5 * t11;
    let t22 = t21 + q_6_dot;
    let t23 = t15 * t22;
    let t24 = t21 * q_5_dot + (cos_q_5 * t8 - sin_q_5 * t9);
    let t25 = q_4_dot * t11 + sin_q_4 * t3;
    let t26 = cos_q_6 * t24 - sin_q_6 * t25 - t15 * q_6_dot;
    let t27 = t13 * p.k3 - t17 * p.k4 - t20 * (t18 - t19) - p.k41 * (t23 + t26);
    let t28 = sin_q_2 * q_1_dot;
    let t29 = cos_q_2 * q_1_dot;
    let t30 = t28 * t29;
    let t31 = q_2_dot * q_2_dot;
    let t32 = t31 + t28 * t28;
    let t33 = t30 * cos_q_3 - sin_q_3 * t32;
    let t34 = t5 * t1;
    let t35 = p.a * t33 + p.b * t34;
    let t36 = t6 * t1;
    let t37 = t36 + t3;
    let t38 = q_2_dot * t29;
    let t39 = p.b * t37 + t38 * p.k29;
    let t40 = t35 * sin_q_4 + cos_q_4 * t39;
    let t41 = t21 * t14;
    let t42 = t41 + t24;
    let t43 = t30 * sin_q_3 + cos_q_3 * t32;
    let t44 = t5 * t5;
    let t45 = t6 * t6;
    let t46 = t45 + t44;
    let t47 = t43 * p.a + t46 * p.b;
    let t48 = sin_q_4 * t39 - t35 * cos_q_4;
    let t49 = t47 * sin_q_5 + cos_q_5 * t48;
    let t50 = t12 * t21;
    let t51 = t25 - t50;
    let t52 = p.k43 * (cos_q_6 * (t40 + p.c * t42) - sin_q_6 * (t49 + t51 * p.c));
    let t53 = t13 * p.k7 - t12 * (t14 * p.k6) - (t27 - t52);
    let t54 = t17 + t13;
    let t55 = t16 * t22;
    let t56 = t55 + (t16 * q_6_dot + (sin_q_6 * t24 + cos_q_6 * t25));
    let t57 = t26 * p.k4 - (p.k41 * t54 + t23 * p.k3) - t20 * t56;
    let t58 = t22 * t22;
    let t59 = t19 + t58;
    let t60 = sin_q_6 * t59 + cos_q_6 * t54;
    let t61 = t14 * t14 + t12 * t12;
    let t62 = t55 * p.k42 - p.k41 * (t58 - t18) - t20 * (t26 - t23);
    let t63 = p.k43 * (t47 * cos_q_5 - sin_q_5 * t48 + p.c * t61) + t62;
    let t64 = cos_q_6 * t57 + (t40 * p.k5 + t41 * p.k40 - p.k47 * t60);
    let t65 = sin_q_6 * t63 + t64;
    let t66 = sin_q_5 * t53 + (t7 * (t10 * p.k8) + t8 * p.k9) - cos_q_5 * t65;
    let t67 = sin_q_6 * t54 - cos_q_6 * t59;
    let t68 = p.k43 * t67 + t51 * p.k5;
    let t69 = p.k43 * t56 + t61 * p.k5;
    let t70 = cos_q_5 * t68 - sin_q_5 * t69;
    let t71 = t42 * p.k5 - p.k43 * t60;
    let t72 = sin_q_4 * t70 + cos_q_4 * t71;
    let t73 = p.k47 * t67 + (t49 * p.k5 + (t25 * p.k6 - t50 * p.k7)) - sin_q_6 * t57;
    let h_q_5 = cos_q_6 * t63 + t73;
    let t74 = t11 * (t10 * p.k39) + h_q_5;
    let t75 = t1 * t1;
    let t76 = S::from_ratio(1, 500);
    let t77 = t6 * t5;
    let t78 = t9 + t77;
    let t79 = t38 * p.k37 + (t36 * p.k35 - t76 * (t45 - t75) - p.k36 * t78);
    let t80 = sin_q_4 * t74 + t79 + (p.b * t72 - cos_q_4 * t66);
    let t81 = t7 * (t11 * p.k9) + t9 * p.k8 - cos_q_5 * t53;
    let t82 = sin_q_5 * t65;
    let t83 = t5 * (t6 * p.k11 + t1 * t76) + t9 * p.k12 - t37 * p.k36 - t38 * p.k38;
    let t84 = t81 - t82 + t83;
    let t85 = sin_q_3 * t80 + (t28 * (t29 * p.k31 - q_2_dot * p.k32) - cos_q_3 * t84);
    let t86 = p.a * (t72 + (t37 * p.k10 - t78 * p.k33));
    let t87 = sin_q_3 * t84 + (t86 + (p.k31 * (t31 - t29 * t29) + t38 * p.k30));
    let t88 = sin_q_4 * t71 - cos_q_4 * t70;
    let t89 = p.k36 * (t44 - t75) + t34 * p.k12 - t76 * (t9 - t77);
    let t90 = cos_q_4 * t74 + (t43 * p.k46 - t33 * p.k34 + t89);
    let h_q_3 = t90 + (sin_q_4 * t66 - p.b * t88);
    let t91 = sin_q_3 * (cos_q_5 * t69 + (t46 * p.k10 + t34 * p.k33 + sin_q_5 * t68));
    let t92 = p.a * (t91 + cos_q_3 * (t88 + (p.k33 * (t45 + t75) + t34 * p.k10)));
    let h_q_1 = cos_q_2 * t85 + sin_q_2 * (cos_q_3 * t80 + t87);
    let h_q_2 = h_q_3 - (t92 + t30 * p.k14);
    let h_q_4 = t82 - t81;
    let h_q_6 = t52 - t27;
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
pub fn applied<S: ::lagrangian::Scalar>(
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
    let t0 = cos_q_2 * cos_q_3 - sin_q_2 * sin_q_3;
    let (sin_q_5, cos_q_5) = q_5.sin_cos();
    let t1 = cos_q_2 * sin_q_3 + sin_q_2 * cos_q_3;
    let (sin_q_4, cos_q_4) = q_4.sin_cos();
    let t2 = cos_q_4 * t1;
    let t3 = p.k48 * (cos_q_5 * t0 - sin_q_5 * t2);
    let (sin_q_6, cos_q_6) = q_6.sin_cos();
    let t4 = sin_q_5 * t0 + cos_q_5 * t2;
    let t5 = cos_q_6 * t3 + t4 * p.k28;
    let t6 = sin_q_4 * t1;
    let t7 = t6 * p.k28 - sin_q_6 * t3;
    let t8 = p.k48 * (sin_q_6 * t4 + cos_q_6 * t6);
    let t9 = cos_q_5 * t7 - sin_q_5 * t8;
    let t10 = sin_q_4 * t5 - cos_q_4 * t9;
    let t11 = cos_q_5 * t8 + sin_q_5 * t7;
    let t12 = cos_q_2 * (sin_q_3 * t10 - cos_q_3 * t11) - p.friction * q_1_dot;
    let t13 = sin_q_4 * t9 + (cos_q_4 * t5 + (t1 * p.k26 + t0 * p.k27));
    let q_q_1 = sin_q_2 * (sin_q_3 * t11 + cos_q_3 * t10) + t12 + u.tau[0];
    let q_q_2 = t13 + (sin_q_2 * p.k25 - p.friction * q_2_dot) + u.tau[1];
    let q_q_3 = t13 - p.friction * q_3_dot + u.tau[2];
    let q_q_4 = u.tau[3] - (t11 + p.friction * q_4_dot);
    let q_q_5 = t5 - p.friction * q_5_dot + u.tau[4];
    let q_q_6 = u.tau[5] - (t8 + p.friction * q_6_dot);
    [q_q_1, q_q_2, q_q_3, q_q_4, q_q_5, q_q_6]
}

/// Right-hand side `f = Q - h` of `M a = f`.
pub fn forces<S: ::lagrangian::Scalar>(
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
    let t0 = cos_q_2 * cos_q_3 - sin_q_2 * sin_q_3;
    let t1 = q_1_dot * t0;
    let t2 = q_1_dot * q_2_dot;
    let t3 = t1 * q_3_dot + t0 * t2;
    let (sin_q_4, cos_q_4) = q_4.sin_cos();
    let t4 = cos_q_2 * sin_q_3 + sin_q_2 * cos_q_3;
    let t5 = q_1_dot * t4;
    let t6 = q_3_dot + q_2_dot;
    let t7 = sin_q_4 * t5 + t6 * cos_q_4;
    let t8 = cos_q_4 * t3 - q_4_dot * t7;
    let (sin_q_5, cos_q_5) = q_5.sin_cos();
    let t9 = q_3_dot * t5 + t4 * t2;
    let t10 = t1 + q_4_dot;
    let t11 = cos_q_4 * t5 - t6 * sin_q_4;
    let t12 = t10 * sin_q_5 + cos_q_5 * t11;
    let t13 = t12 * q_5_dot + (sin_q_5 * t8 + cos_q_5 * t9);
    let (sin_q_6, cos_q_6) = q_6.sin_cos();
    let t14 = t7 + q_5_dot;
    let t15 = sin_q_6 * t12 + cos_q_6 * t14;
    let t16 = cos_q_6 * t12 - sin_q_6 * t14;
    let t17 = t15 * t16;
    let t18 = t16 * t16;
    let t19 = t15 * t15;
    let t20 = S::from_ratio(1, 1000);
    let t21 = t10 * cos_q_5 - sin_q_5 * t11;
    let t22 = t21 + q_6_dot;
    let t23 = t15 * t22;
    let t24 = t21 * q_5_dot + (cos_q_5 * t8 - sin_q_5 * t9);
    let t25 = q_4_dot * t11 + sin_q_4 * t3;
    let t26 = cos_q_6 * t24 - sin_q_6 * t25 - t15 * q_6_dot;
    let t27 = t1 * t5;
    let t28 = sin_q_2 * q_1_dot;
    let t29 = q_2_dot * q_2_dot;
    let t30 = cos_q_2 * p.g - p.a * (t29 + t28 * t28);
    let t31 = cos_q_2 * q_1_dot;
    let t32 = q_1_dot * t31;
    let t33 = sin_q_2 * (t32 * p.a + p.g);
    let t34 = sin_q_3 * t30 + cos_q_3 * t33;
    let t35 = p.b * t27 + t34;
    let t36 = t1 * t6;
    let t37 = t3 + t36;
    let t38 = q_2_dot * t31;
    let t39 = p.b * t37 + t38 * p.k29;
    let t40 = cos_q_4 * t35 - sin_q_4 * t39;
    let t41 = t5 * t5;
    let t42 = t6 * t6;
    let t43 = t42 + t41;
    let t44 = cos_q_3 * t30 - sin_q_3 * t33;
    let t45 = t44 - t43 * p.b;
    let t46 = sin_q_5 * t45 + cos_q_5 * t40;
    let t47 = t12 * t21;
    let t48 = t25 - t47;
    let t49 = t21 * t14;
    let t50 = t49 + t24;
    let t51 = sin_q_4 * t35 + cos_q_4 * t39;
    let t52 = p.k43 * (sin_q_6 * (t46 - t48 * p.c) + cos_q_6 * (p.c * t50 + t51));
    let t53 = t13 * p.k3 - t17 * p.k4 - t20 * (t18 - t19) - p.k41 * (t23 + t26) - t52;
    let t54 = t13 * p.k7 - t12 * (t14 * p.k6) - t53;
    let t55 = t17 + t13;
    let t56 = t16 * t22;
    let t57 = t56 + (t16 * q_6_dot + (sin_q_6 * t24 + cos_q_6 * t25));
    let t58 = t26 * p.k4 - (p.k41 * t55 + t23 * p.k3) - t20 * t57;
    let t59 = t22 * t22;
    let t60 = t19 + t59;
    let t61 = sin_q_6 * t60 + cos_q_6 * t55;
    let t62 = t14 * t14 + t12 * t12;
    let t63 = t56 * p.k42 - p.k41 * (t59 - t18) - t20 * (t26 - t23);
    let t64 = t63 - p.k43 * (cos_q_5 * t45 - sin_q_5 * t40 - p.c * t62);
    let t65 = cos_q_6 * t58 + (t49 * p.k40 + t51 * p.k5 - p.k47 * t61);
    let t66 = sin_q_6 * t64 + t65;
    let t67 = sin_q_5 * t54 + (t7 * (t10 * p.k8) + t8 * p.k9) - cos_q_5 * t66;
    let t68 = sin_q_6 * t55 - cos_q_6 * t60;
    let t69 = p.k47 * t68 + (t25 * p.k6 - t47 * p.k7 - t46 * p.k5) - sin_q_6 * t58;
    let t70 = cos_q_6 * t64 + t69;
    let t71 = t70 + t11 * (t10 * p.k39);
    let t72 = p.k43 * t68 + t48 * p.k5;
    let t73 = p.k43 * t57 + t62 * p.k5;
    let t74 = cos_q_5 * t72 - sin_q_5 * t73;
    let t75 = t50 * p.k5 - p.k43 * t61;
    let t76 = sin_q_4 * t74 + cos_q_4 * t75;
    let t77 = t1 * t1;
    let t78 = S::from_ratio(1, 500);
    let t79 = t6 * t5;
    let t80 = t9 + t79;
    let t81 = t38 * p.k37 + (t36 * p.k35 - t78 * (t42 - t77) - p.k36 * t80);
    let t82 = p.b * t76 + t81 + (sin_q_4 * t71 - cos_q_4 * t67);
    let t83 = t7 * (t11 * p.k9) + t9 * p.k8 - cos_q_5 * t54 - sin_q_5 * t66;
    let t84 = t5 * (t6 * p.k11 + t1 * t78) + t9 * p.k12 - t37 * p.k36 - t38 * p.k38;
    let t85 = t83 + t84;
    let t86 = sin_q_3 * t82 + (t28 * (t31 * p.k31 - q_2_dot * p.k32) - cos_q_3 * t85);
    let t87 = p.a * (t76 + (t37 * p.k10 - t80 * p.k33));
    let t88 = sin_q_3 * t85 + (t87 + (p.k31 * (t29 - t31 * t31) + t38 * p.k30));
    let t89 = cos_q_2 * t86 + (sin_q_2 * (cos_q_3 * t82 + t88) + q_1_dot * p.friction);
    let t90 = sin_q_4 * t75 - cos_q_4 * t74;
    let t91 = p.k36 * (t41 - t77) + t27 * p.k12 - t78 * (t9 - t79);
    let t92 = p.b * t90 + (t34 * p.k10 + t44 * p.k33 - t91);
    let t93 = t92 - (sin_q_4 * t67 + cos_q_4 * t71);
    let t94 = sin_q_3 * (cos_q_5 * t73 + (t43 * p.k10 + t27 * p.k33 + sin_q_5 * t72));
    let t95 = p.a * (t94 + cos_q_3 * (t90 + (p.k33 * (t42 + t77) + t27 * p.k10)));
    let t96 = t95 + (t93 + (sin_q_2 * (t32 * p.k14 + p.k25) - q_2_dot * p.friction));
    let f_q_1 = u.tau[0] - t89;
    let f_q_2 = t96 + u.tau[1];
    let f_q_3 = u.tau[2] - (q_3_dot * p.friction - t93);
    let f_q_4 = u.tau[3] - (q_4_dot * p.friction - t83);
    let f_q_5 = u.tau[4] - (t70 + q_5_dot * p.friction);
    let f_q_6 = t53 - q_6_dot * p.friction + u.tau[5];
    [f_q_1, f_q_2, f_q_3, f_q_4, f_q_5, f_q_6]
}

/// Accelerations `a`, the solution of `M a = f` from the mass matrix, factored.
///
/// What is known to be zero is not computed; a pivot that vanishes is an error.
pub fn accelerations<S: ::lagrangian::Number>(
    p: &Prepared<S>,
    q: &[S; 6],
    v: &[S; 6],
    u: &Inputs<S>,
) -> Result<[S; 6], ::lagrangian::Singular> {
    S::run(Accelerations { p, q, v, u })
}

/// A call of [`accelerations`], to be run with whatever instructions the processor has.
pub struct Accelerations<'a, S> {
    /// As `accelerations` takes it.
    pub p: &'a Prepared<S>,
    /// As `accelerations` takes it.
    pub q: &'a [S; 6],
    /// As `accelerations` takes it.
    pub v: &'a [S; 6],
    /// As `accelerations` takes it.
    pub u: &'a Inputs<S>,
}

impl<S: Copy> ::lagrangian::scalar::Kernel<S> for Accelerations<'_, S> {
    type Output = Result<[S; 6], ::lagrangian::Singular>;

    #[inline(always)]
    fn run<N: ::lagrangian::Scalar<Stored = S>>(self) -> Self::Output {
        let Self { p, q, v, u } = self;
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
        let angles = [q_2, q_3, q_4, q_5, q_6];
        let circular = N::sin_cos_all(angles);
        let (sin_q_2, cos_q_2) = circular[0];
        let (sin_q_3, cos_q_3) = circular[1];
        let (sin_q_4, cos_q_4) = circular[2];
        let (sin_q_5, cos_q_5) = circular[3];
        let (sin_q_6, cos_q_6) = circular[4];
        let t0 = cos_q_2.mul_sub(cos_q_3, sin_q_2 * sin_q_3);
        let t1 = t0 * q_1_dot;
        let t2 = q_1_dot * q_2_dot;
        let t3 = t1.mul_add(q_3_dot, t0 * t2);
        let t4 = cos_q_2.mul_add(sin_q_3, sin_q_2 * cos_q_3);
        let t5 = t4 * q_1_dot;
        let t6 = q_3_dot + q_2_dot;
        let t7 = sin_q_4.mul_add(t5, cos_q_4 * t6);
        let t8 = cos_q_4.mul_sub(t3, q_4_dot * t7);
        let t9 = q_3_dot.mul_add(t5, t4 * t2);
        let t10 = t1 + q_4_dot;
        let t11 = cos_q_4.mul_sub(t5, sin_q_4 * t6);
        let t12 = sin_q_5.mul_add(t10, cos_q_5 * t11);
        let t13 = t12.mul_add(q_5_dot, sin_q_5.mul_add(t8, cos_q_5 * t9));
        let t14 = t7 + q_5_dot;
        let t15 = sin_q_6.mul_add(t12, cos_q_6 * t14);
        let t16 = cos_q_6.mul_sub(t12, sin_q_6 * t14);
        let t17 = t15 * t16;
        let t18 = t16 * t16;
        let t19 = t15 * t15;
        let t20 = N::from_ratio(1, 1000);
        let t21 = n(p.k3).mul_sub(t13, n(p.k4) * t17);
        let t22 = cos_q_5.mul_sub(t10, sin_q_5 * t11);
        let t23 = t22 + q_6_dot;
        let t24 = t15 * t23;
        let t25 = t22.mul_add(q_5_dot, cos_q_5.mul_sub(t8, sin_q_5 * t9));
        let t26 = q_4_dot.mul_add(t11, sin_q_4 * t3);
        let t27 = cos_q_6.mul_sub(t25, sin_q_6 * t26);
        let t28 = t15.neg_mul_add(q_6_dot, t27);
        let t29 = t20.neg_mul_add(t18 - t19, t21);
        let t30 = t1 * t5;
        let t31 = sin_q_2 * q_1_dot;
        let t32 = q_2_dot * q_2_dot;
        let t33 = t31.mul_add(t31, t32);
        let t34 = n(p.a).neg_mul_add(t33, cos_q_2 * n(p.g));
        let t35 = cos_q_2 * q_1_dot;
        let t36 = q_1_dot * t35;
        let t37 = sin_q_2 * n(p.a).mul_add(t36, n(p.g));
        let t38 = cos_q_3.mul_add(t37, sin_q_3 * t34);
        let t39 = n(p.b).mul_add(t30, t38);
        let t40 = t1 * t6;
        let t41 = t3 + t40;
        let t42 = q_2_dot * t35;
        let t43 = n(p.b).mul_add(t41, t42 * n(p.k29));
        let t44 = cos_q_4.mul_sub(t39, sin_q_4 * t43);
        let t45 = t5 * t5;
        let t46 = t6 * t6;
        let t47 = t46 + t45;
        let t48 = sin_q_3.neg_mul_add(t37, cos_q_3 * t34);
        let t49 = n(p.b).neg_mul_add(t47, t48);
        let t50 = cos_q_5.mul_add(t44, sin_q_5 * t49);
        let t51 = t12 * t22;
        let t52 = t26 - t51;
        let t53 = t22 * t14;
        let t54 = t53 + t25;
        let t55 = sin_q_4.mul_add(t39, cos_q_4 * t43);
        let t56 = cos_q_6 * n(p.c).mul_add(t54, t55);
        let t57 = sin_q_6.mul_add(t52.neg_mul_add(n(p.c), t50), t56);
        let t58 = n(p.k41).neg_mul_add(t24 + t28, t29);
        let t59 = n(p.k43).neg_mul_add(t57, t58);
        let t60 = t13.mul_sub(n(p.k7), t12 * (n(p.k6) * t14)) - t59;
        let t61 = n(p.k9).mul_add(t8, t7 * (t10 * n(p.k8)));
        let t62 = t17 + t13;
        let t63 = t16 * t23;
        let t64 = t16.mul_add(q_6_dot, sin_q_6.mul_add(t25, cos_q_6 * t26));
        let t65 = t63 + t64;
        let t66 = n(p.k4).mul_sub(t28, n(p.k41).mul_add(t62, n(p.k3) * t24));
        let t67 = t20.neg_mul_add(t65, t66);
        let t68 = t23 * t23;
        let t69 = t19 + t68;
        let t70 = sin_q_6.mul_add(t69, cos_q_6 * t62);
        let t71 = n(p.k5).mul_add(t55, t53 * n(p.k40));
        let t72 = n(p.k41).neg_mul_add(t68 - t18, t63 * n(p.k42));
        let t73 = t12.mul_add(t12, t14 * t14);
        let t74 = sin_q_5.neg_mul_add(t44, cos_q_5 * t49);
        let t75 = t20.neg_mul_add(t28 - t24, t72);
        let t76 = n(p.k43).neg_mul_add(n(p.c).neg_mul_add(t73, t74), t75);
        let t77 = cos_q_6.mul_add(t67, n(p.k47).neg_mul_add(t70, t71));
        let t78 = sin_q_6.mul_add(t76, t77);
        let t79 = cos_q_5.neg_mul_add(t78, sin_q_5.mul_add(t60, t61));
        let t80 = sin_q_6.mul_sub(t62, cos_q_6 * t69);
        let t81 = t51.neg_mul_add(n(p.k7), n(p.k6) * t26);
        let t82 = n(p.k47).mul_add(t80, n(p.k5).neg_mul_add(t50, t81));
        let t83 = cos_q_6.mul_add(t76, sin_q_6.neg_mul_add(t67, t82));
        let t84 = t11.mul_add(t10 * n(p.k39), t83);
        let t85 = n(p.k43).mul_add(t80, n(p.k5) * t52);
        let t86 = n(p.k43).mul_add(t65, n(p.k5) * t73);
        let t87 = cos_q_5.mul_sub(t85, sin_q_5 * t86);
        let t88 = n(p.k43).neg_mul_add(t70, n(p.k5) * t54);
        let t89 = sin_q_4.mul_add(t87, cos_q_4 * t88);
        let t90 = t1 * t1;
        let t91 = N::from_ratio(1, 500);
        let t92 = t6 * t5;
        let t93 = t9 + t92;
        let t94 = t91.neg_mul_add(t46 - t90, t40 * n(p.k35));
        let t95 = t42.mul_add(n(p.k37), n(p.k36).neg_mul_add(t93, t94));
        let t96 = cos_q_4.neg_mul_add(t79, sin_q_4 * t84);
        let t97 = n(p.b).mul_add(t89, t95) + t96;
        let t98 = t7.mul_add(n(p.k9) * t11, t9 * n(p.k8));
        let t99 = sin_q_5.neg_mul_add(t78, cos_q_5.neg_mul_add(t60, t98));
        let t100 = t5.mul_add(t91.mul_add(t1, n(p.k11) * t6), n(p.k12) * t9);
        let t101 = t42.neg_mul_add(n(p.k38), n(p.k36).neg_mul_add(t41, t100));
        let t102 = t99 + t101;
        let t103 = t31 * n(p.k31).mul_sub(t35, q_2_dot * n(p.k32));
        let t104 = t35.neg_mul_add(t35, t32);
        let t105 = t89 + n(p.k10).mul_sub(t41, n(p.k33) * t93);
        let t106 = n(p.k31).mul_add(t104, t42 * n(p.k30));
        let t107 = sin_q_3.mul_add(t102, n(p.a).mul_add(t105, t106));
        let t108 = cos_q_3.mul_add(t97, t107);
        let t109 = sin_q_3.mul_add(t97, cos_q_3.neg_mul_add(t102, t103));
        let t110 = sin_q_2.mul_add(t108, q_1_dot * n(p.friction));
        let t111 = n(u.tau[0]) - cos_q_2.mul_add(t109, t110);
        let t112 = n(p.k4).mul_add(sin_q_6, cos_q_6 * t91);
        let t113 = sin_q_6 * t112;
        let t114 = n(p.k4) - t113;
        let t115 = cos_q_6 * cos_q_5;
        let t116 = sin_q_5.mul_add(t114 - n(p.k49), t115 * n(p.k50));
        let t117 = cos_q_5.mul_sub(t116, cos_q_6 * n(p.k45));
        let t118 = cos_q_6.neg_mul_add(t112, t20);
        let t119 = sin_q_6 * n(p.k45);
        let t120 = sin_q_5.mul_sub(t118, cos_q_5 * t119);
        let t121 = t115.mul_add(n(p.k43), sin_q_5 * n(p.k5));
        let t122 = sin_q_6 * sin_q_4;
        let t123 = cos_q_4.mul_sub(t121, n(p.k43) * t122);
        let t124 = cos_q_4.mul_add(t117, sin_q_4 * t120);
        let t125 = t123.mul_add(n(p.b), t124);
        let t126 = t125 + n(p.k36);
        let t127 = sin_q_5 * t116;
        let t128 = t127 + n(p.k51);
        let t129 = t123 + n(p.k33);
        let t130 = sin_q_2 * n(p.a);
        let t131 = cos_q_6 * sin_q_5;
        let t132 = t131.neg_mul_add(n(p.k43), cos_q_5 * n(p.k5));
        let t133 = cos_q_4 * t132;
        let t134 = cos_q_4 * t133;
        let t135 = sin_q_4 * t132;
        let t136 = sin_q_4.mul_add(t135, t134);
        let t137 = n(p.k10) + t136;
        let t138 = cos_q_2.neg_mul_add(cos_q_2 * n(p.k14), n(p.k15));
        let t139 = t4.mul_add(t126, t0.mul_add(t128 + n(p.k12), t130 * t129));
        let t140 = t130.mul_add(t137.mul_add(t4, t129 * t0), t138);
        let t141 = t127 + (n(p.k9) - t114);
        let t142 = cos_q_5.mul_add(t118, sin_q_5 * t119);
        let t143 = sin_q_4 * t142;
        let t144 = t113 + n(p.k6);
        let t145 = sin_q_4 * sin_q_4;
        let t146 = cos_q_4.neg_mul_add(t141, N::from_f64(2.0) * t143);
        let t147 = cos_q_4.mul_add(t146, n(p.k55).mul_add(t136, t144 * t145));
        let t148 = t0.mul_add(t126, t4.mul_add(t147, t130 * t137));
        let t149 = t4.mul_add(t148, t0.mul_add(t139, t140));
        check(t149, t149, 5.329070518200751e-15, 0)?;
        let t150 = N::ONE / t149;
        let t151 = t115.neg_mul_add(n(p.k45), sin_q_5 * n(p.k3));
        let t152 = cos_q_5.neg_mul_add(t122, cos_q_6 * cos_q_4);
        let t153 = cos_q_4.mul_add(t151, sin_q_4 * t119);
        let t154 = n(p.k45).mul_add(t131, cos_q_5 * n(p.k3));
        let t155 = t152.mul_add(sin_q_2 * n(p.k54), t0 * t154);
        let t156 = t4.mul_sub(n(p.k53).neg_mul_add(t152, t153), t155);
        let t157 = t150 * t156;
        let t158 = q_6_dot.neg_mul_add(n(p.friction), t59) + n(u.tau[5]);
        let t159 = cos_q_4 * t142;
        let t160 = sin_q_4.mul_sub(t133, cos_q_4 * t135);
        let t161 = n(p.b).mul_add(t160, sin_q_4 * t143);
        let t162 = cos_q_4.mul_sub(sin_q_4.mul_add(t144 + t141, t159), t161);
        let t163 = n(p.a) * cos_q_3;
        let t164 = t115.mul_add(n(p.k54), sin_q_5 * n(p.k52));
        let t165 = sin_q_6 * cos_q_4;
        let t166 = sin_q_3 * sin_q_4.mul_add(t164, t165 * n(p.k54));
        let t167 = sin_q_4.mul_add(t121, n(p.k43) * t165);
        let t168 = sin_q_4.neg_mul_add(t117, cos_q_4 * t120);
        let t169 = n(p.b).neg_mul_add(t167, t168);
        let t170 = t91 + t169;
        let t171 = t163 * t167;
        let t172 = t0.mul_sub(t170 - t171, cos_q_2 * n(p.k31));
        let t173 = t4.mul_add(t162 - t163.mul_add(t160, t166), t172);
        let t174 = t150 * t173;
        let t175 = cos_q_4.neg_mul_add(t87, sin_q_4 * t88);
        let t176 = n(p.k36).mul_add(t45 - t90, n(p.k12) * t30);
        let t177 = n(p.k10).mul_add(t38, n(p.k33) * t48);
        let t178 = t177 - t91.neg_mul_add(t9 - t92, t176);
        let t179 = sin_q_4.mul_add(t79, cos_q_4 * t84);
        let t180 = n(p.b).mul_add(t175, t178) - t179;
        let t181 = n(p.k14).mul_add(t36, n(p.k25));
        let t182 = n(p.k10).mul_add(t47, n(p.k33) * t30);
        let t183 = sin_q_3 * cos_q_5.mul_add(t86, sin_q_5.mul_add(t85, t182));
        let t184 = t175 + n(p.k33).mul_add(t46 + t90, n(p.k10) * t30);
        let t185 = t180 + sin_q_2.mul_sub(t181, q_2_dot * n(p.friction));
        let t186 = n(p.a).mul_add(cos_q_3.mul_add(t184, t183), t185);
        let t187 = t174.neg_mul_add(t111, t186 + n(u.tau[1]));
        let t188 = t132.mul_add(t145, t134);
        let t189 = t144.mul_add(cos_q_4 * cos_q_4, n(p.k11));
        let t190 = sin_q_4.mul_add(t141, N::from_f64(2.0) * t159);
        let t191 = sin_q_4.neg_mul_add(t190, n(p.k55).mul_add(t188, t189));
        let t192 = t163.neg_mul_add(t188 + n(p.k10), sin_q_3 * n(p.k46));
        let t193 = t191 - t192;
        let t194 = sin_q_3 * cos_q_4.mul_sub(t164, t122 * n(p.k54));
        let t195 = N::from_f64(2.0).neg_mul_add(t194, n(p.k13)) - t192;
        let t196 = t193 + t195;
        let t197 = t173.neg_mul_add(t174, t196);
        check(t197, t196, 5.329070518200751e-15, 1)?;
        let t198 = N::ONE / t197;
        let t199 = cos_q_5.mul_add(t165, cos_q_6 * sin_q_4);
        let t200 = sin_q_4.mul_sub(t151, cos_q_4 * t119);
        let t201 = n(p.k53).neg_mul_add(t199, t200);
        let t202 = cos_q_3.neg_mul_add(t199, sin_q_6 * (sin_q_5 * sin_q_3));
        let t203 = t173.mul_add(t157, n(p.k54).mul_add(t202, t201));
        let t204 = t198 * t203;
        let t205 = t4.mul_add(t162, t0 * t170);
        let t206 = t150 * t205;
        let t207 = t173.mul_add(t206, t194 - t193);
        let t208 = t198 * t207;
        let t209 = n(u.tau[2]) - q_3_dot.mul_sub(n(p.friction), t180);
        let t210 = t208.mul_add(t187, t206.neg_mul_add(t111, t209));
        let t211 = t207.neg_mul_add(t208, t205.neg_mul_add(t206, t191));
        check(t211, t191, 5.329070518200751e-15, 2)?;
        let t212 = N::ONE / t211;
        let t213 = t207.mul_add(t204, t205.mul_add(t157, t201));
        let t214 = t212 * t213;
        let t215 = t204.neg_mul_add(t187, t157.mul_add(t111, t158));
        let t216 = t4.mul_add(t125, t128.mul_add(t0, t130 * t123));
        let t217 = t150 * t216;
        let t218 = n(u.tau[3]) - q_4_dot.mul_sub(n(p.friction), t99);
        let t219 = t173.neg_mul_add(t217, t169 - t171);
        let t220 = t198 * t219;
        let t221 = t207.mul_add(t220, t205.neg_mul_add(t217, t169));
        let t222 = t212 * t221;
        let t223 = t220.neg_mul_add(t187, t217.neg_mul_add(t111, t218));
        let t224 = t222.neg_mul_add(t210, t223);
        let t225 = t219.neg_mul_add(t220, t216.neg_mul_add(t217, t128));
        let t226 = t221.neg_mul_add(t222, t225);
        check(t226, t128, 5.329070518200751e-15, 3)?;
        let t227 = N::ONE / t226;
        let t228 = t219.neg_mul_add(t204, t216.mul_add(t157, t154));
        let t229 = t221.neg_mul_add(t214, t228);
        let t230 = t227 * t229;
        let t231 = t132.mul_add(n(p.b), t144);
        let t232 = t0.mul_add(t120, t132 * (sin_q_4 * t130));
        let t233 = t4.mul_add(sin_q_4.mul_add(t231, t159), t232);
        let t234 = t150 * t233;
        let t235 = n(u.tau[4]) - q_5_dot.mul_add(n(p.friction), t83);
        let t236 = cos_q_4.mul_sub(t231, t143);
        let t237 = t236 + t133.mul_sub(t163, sin_q_3 * t164);
        let t238 = t173.neg_mul_add(t234, t237);
        let t239 = t198 * t238;
        let t240 = t207.mul_add(t239, t205.neg_mul_add(t234, t236));
        let t241 = t212 * t240;
        let t242 = t239.neg_mul_add(t187, t234.neg_mul_add(t111, t235));
        let t243 = t219.neg_mul_add(t239, t216.neg_mul_add(t234, t120));
        let t244 = t221.neg_mul_add(t241, t243);
        let t245 = t227 * t244;
        let t246 = t245.neg_mul_add(t224, t241.neg_mul_add(t210, t242));
        let t247 = t238.neg_mul_add(t239, t233.neg_mul_add(t234, t144));
        let t248 = t244.neg_mul_add(t245, t240.neg_mul_add(t241, t247));
        check(t248, t144, 5.329070518200751e-15, 4)?;
        let t249 = N::ONE / t248;
        let t250 = t238.neg_mul_add(t204, t233.mul_sub(t157, t119));
        let t251 = t244.neg_mul_add(t230, t240.neg_mul_add(t214, t250));
        let t252 = t249 * t251;
        let t253 = t230.neg_mul_add(t224, t214.neg_mul_add(t210, t215));
        let t254 = t203.neg_mul_add(t204, t156.neg_mul_add(t157, n(p.k3)));
        let t255 = t229.neg_mul_add(t230, t213.neg_mul_add(t214, t254));
        let t256 = t251.neg_mul_add(t252, t255);
        check(t256, n(p.k3), 5.329070518200751e-15, 5)?;
        let q_6_ddot = t252.neg_mul_add(t246, t253) / t256;
        let q_5_ddot = t252.neg_mul_add(q_6_ddot, t249 * t246);
        let t257 = t157.mul_add(q_6_ddot, t150 * t111);
        let t258 = t230.neg_mul_add(q_6_ddot, t227 * t224);
        let q_4_ddot = t245.neg_mul_add(q_5_ddot, t258);
        let t259 = t234.neg_mul_add(q_5_ddot, t257);
        let t260 = t214.neg_mul_add(q_6_ddot, t212 * t210);
        let t261 = t241.neg_mul_add(q_5_ddot, t260);
        let q_3_ddot = t222.neg_mul_add(q_4_ddot, t261);
        let t262 = t217.neg_mul_add(q_4_ddot, t259);
        let t263 = t204.neg_mul_add(q_6_ddot, t198 * t187);
        let t264 = t239.neg_mul_add(q_5_ddot, t263);
        let q_2_ddot = t208.mul_add(q_3_ddot, t220.neg_mul_add(q_4_ddot, t264));
        let t265 = t206.neg_mul_add(q_3_ddot, t262);
        let q_1_ddot = t174.neg_mul_add(q_2_ddot, t265);
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
}

/// Kinetic energy `T`, in J.
///
/// ```text
/// T = …
/// ```
pub fn kinetic_energy<S: ::lagrangian::Scalar>(p: &Prepared<S>, q: &[S; 6], v: &[S; 6]) -> S {
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
    let t0 = cos_q_2 * q_1_dot;
    let (sin_q_3, cos_q_3) = q_3.sin_cos();
    let t1 = sin_q_2 * q_1_dot;
    let t2 = cos_q_3 * t0 - t1 * sin_q_3;
    let t3 = t2 + q_4_dot;
    let (sin_q_5, cos_q_5) = q_5.sin_cos();
    let t4 = sin_q_3 * t0 + t1 * cos_q_3;
    let (sin_q_4, cos_q_4) = q_4.sin_cos();
    let t5 = q_3_dot + q_2_dot;
    let t6 = cos_q_4 * t4 - t5 * sin_q_4;
    let t7 = t3 * cos_q_5 - sin_q_5 * t6;
    let t8 = t7 + q_6_dot;
    let t9 = S::from_ratio(3, 100);
    let t10 = t3 * sin_q_5 + cos_q_5 * t6;
    let (sin_q_6, cos_q_6) = q_6.sin_cos();
    let t11 = sin_q_4 * t4 + t5 * cos_q_4;
    let t12 = t11 + q_5_dot;
    let t13 = t10 * cos_q_6 - sin_q_6 * t12;
    let t14 = S::from_ratio(2, 25);
    let t15 = t1 * p.a;
    let t16 = t15 + t4 * p.b;
    let t17 = cos_q_3 * (q_2_dot * p.a);
    let t18 = t17 + t5 * p.b;
    let t19 = cos_q_4 * t16 - sin_q_4 * t18;
    let t20 = t19 + t10 * p.c;
    let t21 = sin_q_4 * t16 + cos_q_4 * t18;
    let t22 = sin_q_3 * q_2_dot;
    let t23 = t22 * p.a;
    let t24 = cos_q_5 * t21 - sin_q_5 * t23;
    let t25 = t24 + t12 * p.c;
    let t26 = t9 * t8 + t13 * t14 + (cos_q_6 * t20 - sin_q_6 * t25);
    let t27 = cos_q_5 * t23 + sin_q_5 * t21;
    let t28 = t10 * sin_q_6 + cos_q_6 * t12;
    let t29 = t27 - t28 * t9;
    let t30 = t28 * t14 + (sin_q_6 * t20 + cos_q_6 * t25);
    let t31 = S::from_ratio(1, 100);
    let t32 = S::from_ratio(1, 50);
    let t33 = S::from_ratio(1, 1000);
    let t34 = t8 * (t8 * t31) + t13 * (t13 * t32 - t28 * t33);
    let t35 = (t26 * t26 + (t29 * t29 + t30 * t30)) * p.m6;
    let t36 = t19 + t10 * p.k2;
    let t37 = t24 + t12 * p.k2;
    let t38 = S::from_ratio(1, 500);
    let t39 = t7 * (t7 * t33) + (t12 * (t12 * t38) + t10 * (t10 * t38));
    let t40 = S::from_ratio(3, 1000);
    let t41 = t11 * (t11 * t40) + (t3 * (t3 * t38) + t6 * (t6 * t40));
    let t42 = (t19 * t19 + (t22 * (t22 * p.k16) + t21 * t21)) * p.m4 + t41;
    let t43 = t2 * t31;
    let t44 = t15 + (t43 + t4 * p.k1);
    let t45 = t23 - t5 * t31;
    let t46 = t17 + t5 * p.k1;
    let t47 = S::from_ratio(9, 100);
    let t48 = t2 * (t43 + t5 * t38) + (t4 * (t4 * t47) + t5 * (t5 * t47 + t2 * t38));
    let t49 = q_2_dot * p.k0 - t0 * t9;
    let t50 = t1 * t1;
    let t51 = S::from_ratio(13, 100);
    let t52 = t0 * (t0 * t32) + (t50 * t51 + q_2_dot * (q_2_dot * t51));
    let t53 = S::from_f64(0.5) * ((t50 * p.k17 + t49 * t49) * p.m2 + t52);
    let t54 = S::from_f64(0.5) * ((t44 * t44 + (t45 * t45 + t46 * t46)) * p.m3 + t48);
    let t55 = S::from_f64(0.5) * ((t37 * t37 + (t27 * t27 + t36 * t36)) * p.m5 + t39);
    let t56 = S::from_f64(0.5) * t42 + (t54 + (t53 + q_1_dot * (q_1_dot * p.k44)));
    let t57 = S::from_f64(0.5) * (t35 + (t34 - t28 * (t13 * t33 - t28 * t32)));
    t57 + (t55 + t56)
}

/// Potential energy `V`, in J.
///
/// ```text
/// V = …
/// ```
pub fn potential_energy<S: ::lagrangian::Scalar>(p: &Prepared<S>, q: &[S; 6]) -> S {
    let q_2 = q[1];
    let q_3 = q[2];
    let q_4 = q[3];
    let q_5 = q[4];
    let q_6 = q[5];
    let (sin_q_3, cos_q_3) = q_3.sin_cos();
    let (sin_q_2, cos_q_2) = q_2.sin_cos();
    let t0 = cos_q_3 * cos_q_2 - sin_q_3 * sin_q_2;
    let (sin_q_5, cos_q_5) = q_5.sin_cos();
    let t1 = sin_q_3 * cos_q_2 + cos_q_3 * sin_q_2;
    let (sin_q_4, cos_q_4) = q_4.sin_cos();
    let t2 = t1 * cos_q_4;
    let t3 = cos_q_5 * t0 - sin_q_5 * t2;
    let t4 = p.h + cos_q_2 * p.a;
    let t5 = t4 + t0 * p.b;
    let (sin_q_6, cos_q_6) = q_6.sin_cos();
    let t6 = cos_q_6 * (sin_q_5 * t0 + cos_q_5 * t2) - t1 * (sin_q_6 * sin_q_4);
    let t7 = t3 * S::from_ratio(2, 25) + (t5 + t3 * p.c) - S::from_ratio(3, 100) * t6;
    let t8 = t5 * p.k20 + (p.k18 * (p.h + cos_q_2 * p.k0) + p.k23);
    let t9 = p.k19 * (t4 + t0 * p.k1 - t1 * S::from_ratio(1, 100)) + t8;
    p.k22 * t7 + (p.k21 * (t5 + t3 * p.k2) + t9)
}

/// Dissipation function `D`, in W.
///
/// ```text
/// D = 1/2*friction*der(q[1])^2 + 1/2*friction*der(q[2])^2 + 1/2*friction*der(q[3])^2
///     + 1/2*friction*der(q[4])^2 + 1/2*friction*der(q[5])^2 + 1/2*friction*der(q[6])^2
/// ```
pub fn dissipation<S: ::lagrangian::Scalar>(p: &Prepared<S>, v: &[S; 6]) -> S {
    let q_1_dot = v[0];
    let q_2_dot = v[1];
    let q_3_dot = v[2];
    let q_4_dot = v[3];
    let q_5_dot = v[4];
    let q_6_dot = v[5];
    let t0 = q_4_dot * q_4_dot + q_3_dot * q_3_dot;
    let t1 = q_2_dot * q_2_dot + q_1_dot * q_1_dot + t0;
    (q_6_dot * q_6_dot + q_5_dot * q_5_dot + t1) * p.k24
}

/// Power that drives, forces and inputs put in, in W.
///
/// ```text
/// P = der(q[1])*tau[1] + der(q[2])*tau[2] + der(q[3])*tau[3] + der(q[4])*tau[4] + der(q[5])*tau[5]
///     + der(q[6])*tau[6]
/// ```
pub fn work_rate<S: ::lagrangian::Scalar>(v: &[S; 6], u: &Inputs<S>) -> S {
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

/// Power that dampers take out, in W.
///
/// ```text
/// P = friction*der(q[1])^2 + friction*der(q[2])^2 + friction*der(q[3])^2 + friction*der(q[4])^2
///     + friction*der(q[5])^2 + friction*der(q[6])^2
/// ```
pub fn dissipation_rate<S: ::lagrangian::Scalar>(p: &Prepared<S>, v: &[S; 6]) -> S {
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

/// Height of the flange above the floor. Unit: m.
///
/// ```text
/// height = a*cos(q[2]) - c*cos(q[4])*sin(q[5])*sin(q[2] + q[3]) + c*cos(q[5])*cos(q[2] + q[3])
///     + b*cos(q[2] + q[3]) + h
/// ```
pub fn output_height<S: ::lagrangian::Scalar>(p: &Prepared<S>, q: &[S; 6]) -> S {
    let q_2 = q[1];
    let q_3 = q[2];
    let q_4 = q[3];
    let q_5 = q[4];
    let (sin_q_3, cos_q_3) = q_3.sin_cos();
    let (sin_q_2, cos_q_2) = q_2.sin_cos();
    let t0 = cos_q_3 * cos_q_2 - sin_q_3 * sin_q_2;
    let (sin_q_5, cos_q_5) = q_5.sin_cos();
    let cos_q_4 = q_4.cos();
    let t1 = (sin_q_3 * cos_q_2 + cos_q_3 * sin_q_2) * (sin_q_5 * cos_q_4);
    (cos_q_5 * t0 - t1) * p.c + (t0 * p.b + (cos_q_2 * p.a + p.h))
}

/// Everything that the description asks to observe.
pub fn outputs<S: ::lagrangian::Scalar>(p: &Prepared<S>, q: &[S; 6]) -> Outputs<S> {
    Outputs {
        height: output_height(p, q),
    }
}

/// Names and units.
const PARAMETERS: [(&str, &str); 12] = [
    ("h", "m"),
    ("a", "m"),
    ("b", "m"),
    ("c", "m"),
    ("m1", "kg"),
    ("m2", "kg"),
    ("m3", "kg"),
    ("m4", "kg"),
    ("m5", "kg"),
    ("m6", "kg"),
    ("friction", "N*m*s"),
    ("g", "m/s^2"),
];

/// Names and units.
const COORDINATES: [(&str, &str); 6] = [
    ("q[1]", "rad"),
    ("q[2]", "rad"),
    ("q[3]", "rad"),
    ("q[4]", "rad"),
    ("q[5]", "rad"),
    ("q[6]", "rad"),
];

/// Names and units.
const INPUTS: [(&str, &str); 6] = [
    ("tau[1]", "N*m"),
    ("tau[2]", "N*m"),
    ("tau[3]", "N*m"),
    ("tau[4]", "N*m"),
    ("tau[5]", "N*m"),
    ("tau[6]", "N*m"),
];

/// Names and units.
const OUTPUTS: [(&str, &str); 1] = [("height", "m")];

impl ::lagrangian::Machine for SixJointArm {
    type System = Prepared;

    fn name(&self) -> &str {
        "SixJointArm"
    }

    fn parameters(&self) -> impl ExactSizeIterator<Item = (::lagrangian::Quantity<'_>, f64)> {
        let values = [
            self.h,
            self.a,
            self.b,
            self.c,
            self.m1,
            self.m2,
            self.m3,
            self.m4,
            self.m5,
            self.m6,
            self.friction,
            self.g,
        ];
        quantities(&PARAMETERS, values)
    }

    fn prepare(&self) -> Prepared {
        Self::prepare(self)
    }

    fn start(&self) -> ::lagrangian::State<Coordinates> {
        Self::start(self)
    }
}

impl ::lagrangian::System for Prepared {
    type Vector = [f64; 6];
    type Matrix = [f64; 36];
    type Coordinates = Coordinates;
    type Inputs = Inputs;
    type Outputs = Outputs;

    fn coordinates(&self) -> impl ExactSizeIterator<Item = ::lagrangian::Quantity<'_>> {
        COORDINATES.iter().map(quantity)
    }

    fn to_coordinates(&self, vector: &[f64; 6]) -> Coordinates {
        Coordinates::from_array(*vector)
    }

    fn to_vector(&self, coordinates: &Coordinates) -> [f64; 6] {
        coordinates.to_array()
    }

    fn accelerations(
        &self,
        _: f64,
        q: &[f64; 6],
        v: &[f64; 6],
        u: &Inputs,
        result: &mut [f64; 6],
    ) -> Result<(), ::lagrangian::Singular> {
        <f64 as ::lagrangian::Number>::run_in_place(Accelerations { p: self, q, v, u }, result)
    }

    fn mass_matrix(&self, _: f64, q: &[f64; 6], matrix: &mut [f64; 36]) {
        let rows = mass_matrix(self, q);
        for (to, from) in matrix.iter_mut().zip(rows.as_flattened()) {
            *to = *from;
        }
    }

    fn bias(&self, _: f64, q: &[f64; 6], v: &[f64; 6], result: &mut [f64; 6]) {
        *result = bias(self, q, v);
    }

    fn applied(&self, _: f64, q: &[f64; 6], v: &[f64; 6], u: &Inputs, result: &mut [f64; 6]) {
        *result = applied(self, q, v, u);
    }

    fn forces(&self, _: f64, q: &[f64; 6], v: &[f64; 6], u: &Inputs, result: &mut [f64; 6]) {
        *result = forces(self, q, v, u);
    }

    fn kinetic_energy(&self, _: f64, q: &[f64; 6], v: &[f64; 6]) -> f64 {
        kinetic_energy(self, q, v)
    }

    fn potential_energy(&self, _: f64, q: &[f64; 6], _: &Inputs) -> f64 {
        potential_energy(self, q)
    }

    fn dissipation(&self, _: f64, _: &[f64; 6], v: &[f64; 6], _: &Inputs) -> f64 {
        dissipation(self, v)
    }

    fn work_rate(&self, _: f64, _: &[f64; 6], v: &[f64; 6], _: &[f64; 6], u: &Inputs) -> f64 {
        work_rate(v, u)
    }

    fn dissipation_rate(&self, _: f64, _: &[f64; 6], v: &[f64; 6], _: &Inputs) -> f64 {
        dissipation_rate(self, v)
    }

    fn default_inputs(&self) -> Inputs {
        Inputs::default()
    }

    fn input_values(
        &self,
        inputs: &Inputs,
    ) -> impl ExactSizeIterator<Item = (::lagrangian::Quantity<'_>, f64)> {
        let values = [
            inputs.tau[0],
            inputs.tau[1],
            inputs.tau[2],
            inputs.tau[3],
            inputs.tau[4],
            inputs.tau[5],
        ];
        quantities(&INPUTS, values)
    }

    fn output_values(
        &self,
        outputs: &Outputs,
    ) -> impl ExactSizeIterator<Item = (::lagrangian::Quantity<'_>, f64)> {
        let values = [outputs.height];
        quantities(&OUTPUTS, values)
    }

    fn outputs(&self, _: f64, q: &[f64; 6], _: &[f64; 6], _: &[f64; 6], _: &Inputs) -> Outputs {
        outputs(self, q)
    }

    fn assumptions(
        &self,
        _: f64,
        _: &[f64; 6],
        _: &[f64; 6],
        _: &Inputs,
    ) -> impl ExactSizeIterator<Item = ::lagrangian::Assumption<'_>> {
        ::core::iter::empty()
    }
}

impl<const N: usize> ::lagrangian::Abreast<N> for Prepared
where
    ::lagrangian::Lanes<N>: ::lagrangian::Number,
{
    type Several = Prepared<::lagrangian::Lanes<N>>;
    type Vectors = [::lagrangian::Lanes<N>; 6];
    type SeveralInputs = Inputs<::lagrangian::Lanes<N>>;

    fn abreast(systems: [&Self; N]) -> Self::Several {
        let lanes = |number: fn(&Self) -> f64| ::lagrangian::Lanes(systems.map(number));
        Prepared {
            h: lanes(|p| p.h),
            a: lanes(|p| p.a),
            b: lanes(|p| p.b),
            c: lanes(|p| p.c),
            m2: lanes(|p| p.m2),
            m3: lanes(|p| p.m3),
            m4: lanes(|p| p.m4),
            m5: lanes(|p| p.m5),
            m6: lanes(|p| p.m6),
            friction: lanes(|p| p.friction),
            g: lanes(|p| p.g),
            k0: lanes(|p| p.k0),
            k1: lanes(|p| p.k1),
            k2: lanes(|p| p.k2),
            k3: lanes(|p| p.k3),
            k4: lanes(|p| p.k4),
            k5: lanes(|p| p.k5),
            k6: lanes(|p| p.k6),
            k7: lanes(|p| p.k7),
            k8: lanes(|p| p.k8),
            k9: lanes(|p| p.k9),
            k10: lanes(|p| p.k10),
            k11: lanes(|p| p.k11),
            k12: lanes(|p| p.k12),
            k13: lanes(|p| p.k13),
            k14: lanes(|p| p.k14),
            k15: lanes(|p| p.k15),
            k16: lanes(|p| p.k16),
            k17: lanes(|p| p.k17),
            k18: lanes(|p| p.k18),
            k19: lanes(|p| p.k19),
            k20: lanes(|p| p.k20),
            k21: lanes(|p| p.k21),
            k22: lanes(|p| p.k22),
            k23: lanes(|p| p.k23),
            k24: lanes(|p| p.k24),
            k25: lanes(|p| p.k25),
            k26: lanes(|p| p.k26),
            k27: lanes(|p| p.k27),
            k28: lanes(|p| p.k28),
            k29: lanes(|p| p.k29),
            k30: lanes(|p| p.k30),
            k31: lanes(|p| p.k31),
            k32: lanes(|p| p.k32),
            k33: lanes(|p| p.k33),
            k34: lanes(|p| p.k34),
            k35: lanes(|p| p.k35),
            k36: lanes(|p| p.k36),
            k37: lanes(|p| p.k37),
            k38: lanes(|p| p.k38),
            k39: lanes(|p| p.k39),
            k40: lanes(|p| p.k40),
            k41: lanes(|p| p.k41),
            k42: lanes(|p| p.k42),
            k43: lanes(|p| p.k43),
            k44: lanes(|p| p.k44),
            k45: lanes(|p| p.k45),
            k46: lanes(|p| p.k46),
            k47: lanes(|p| p.k47),
            k48: lanes(|p| p.k48),
            k49: lanes(|p| p.k49),
            k50: lanes(|p| p.k50),
            k51: lanes(|p| p.k51),
            k52: lanes(|p| p.k52),
            k53: lanes(|p| p.k53),
            k54: lanes(|p| p.k54),
            k55: lanes(|p| p.k55),
            k56: lanes(|p| p.k56),
        }
    }

    fn inputs_abreast(inputs: [&Inputs; N]) -> Self::SeveralInputs {
        let lanes = |number: fn(&Inputs) -> f64| ::lagrangian::Lanes(inputs.map(number));
        Inputs {
            tau: [
                lanes(|u| u.tau[0]),
                lanes(|u| u.tau[1]),
                lanes(|u| u.tau[2]),
                lanes(|u| u.tau[3]),
                lanes(|u| u.tau[4]),
                lanes(|u| u.tau[5]),
            ],
        }
    }

    fn inputs_of_lane(inputs: &Self::SeveralInputs, lane: usize) -> Inputs {
        Inputs {
            tau: [
                inputs.tau[0][lane],
                inputs.tau[1][lane],
                inputs.tau[2][lane],
                inputs.tau[3][lane],
                inputs.tau[4][lane],
                inputs.tau[5][lane],
            ],
        }
    }

    fn is_singular(&self) -> bool {
        false
    }

    fn accelerations_abreast(
        p: &Self::Several,
        _: ::lagrangian::Lanes<N>,
        q: &Self::Vectors,
        v: &Self::Vectors,
        u: &Self::SeveralInputs,
        result: &mut Self::Vectors,
    ) -> Result<(), ::lagrangian::Singular> {
        <::lagrangian::Lanes<N> as ::lagrangian::Number>::run_in_place(Accelerations { p, q, v, u }, result)
    }
}

/// A name with its unit.
fn quantity<'a>(&(name, unit): &'a (&'a str, &'a str)) -> ::lagrangian::Quantity<'a> {
    ::lagrangian::Quantity { name, unit }
}

/// Names and units beside values.
fn quantities<'a, const N: usize>(
    names: &'a [(&'a str, &'a str); N],
    values: [f64; N],
) -> impl ExactSizeIterator<Item = (::lagrangian::Quantity<'a>, f64)> {
    names.iter().map(quantity).zip(values)
}

/// Refuses a pivot of which elimination has left nothing but rounding errors of a diagonal element,
/// in any of several lanes.
#[inline(always)]
fn check<N: ::lagrangian::Scalar>(
    pivot: N,
    diagonal: N,
    share: f64,
    coordinate: usize,
) -> Result<(), ::lagrangian::Singular> {
    let bound = N::from_f64(share) * diagonal;
    match pivot.exceeds(bound) {
        true => Ok(()),
        false => Err(singular(coordinate, pivot, diagonal)),
    }
}

/// What is left of a pivot, for the message.
#[cold]
fn singular<S: ::lagrangian::Scalar>(
    coordinate: usize,
    pivot: S,
    diagonal: S,
) -> ::lagrangian::Singular {
    ::lagrangian::Singular::new(coordinate, pivot.to_f64(), diagonal.to_f64())
}
