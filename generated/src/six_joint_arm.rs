// @generated from machines/six_joint_arm.machine by `cargo xtask generate`; edits are lost.

//! An industrial arm with six revolute joints: a turning column, shoulder and elbow in its plane,
//! and
//! a wrist of three axes. Masses and sizes are those of a desk-sized arm that carries 5 kg.
//!
//! 6 coordinates, 12 parameters, 6 inputs, 1 output. Arithmetic of one call:
//!
//! | function | mul | add | div | sin cos | other | temporaries |
//! | --- | --: | --: | --: | --: | --: | --: |
//! | `prepare` | 67 | 49 | 0 | 0 | 0 | 116 |
//! | `mass_matrix` | 147 | 102 | 0 | 5 | 0 | 259 |
//! | `bias` | 191 | 133 | 0 | 5 | 0 | 334 |
//! | `applied` | 39 | 29 | 0 | 5 | 0 | 78 |
//! | `forces` | 200 | 145 | 0 | 5 | 0 | 355 |
//! | `accelerations` | 424 | 311 | 6 | 5 | 0 | 751 |
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
        let k45 = S::from_ratio(3, 2500) * (self.m6 * t25);
        let k46 = self.a * k33;
        let k47 = self.c * k43;
        let k48 = self.g * k43;
        let k50 = k41 * t25;
        let k51 = k8 + k49;
        let k52 = self.a * k5;
        let k53 = self.b * k43;
        let k54 = self.a * k43;
        let k55 = self.b * S::from_f64(2.0);
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
    let (sin_q_5, cos_q_5) = q_5.sin_cos();
    let t0 = cos_q_6 * cos_q_5;
    let t1 = p.k43 * t0 + sin_q_5 * p.k5;
    let (sin_q_4, cos_q_4) = q_4.sin_cos();
    let t2 = p.k43 * sin_q_6;
    let t3 = cos_q_4 * t1 - t2 * sin_q_4;
    let t4 = t3 + p.k33;
    let (sin_q_2, cos_q_2) = q_2.sin_cos();
    let (sin_q_3, cos_q_3) = q_3.sin_cos();
    let t5 = cos_q_2 * cos_q_3 - sin_q_2 * sin_q_3;
    let t6 = p.k43 * cos_q_6;
    let t7 = cos_q_5 * p.k5 - sin_q_5 * t6;
    let t8 = cos_q_4 * t7;
    let t9 = sin_q_4 * sin_q_5;
    let t10 = sin_q_4 * cos_q_5;
    let t11 = p.k5 * t10 - t6 * t9;
    let t12 = cos_q_4 * t8 + sin_q_4 * t11;
    let t13 = p.k10 + t12;
    let t14 = cos_q_2 * sin_q_3 + sin_q_2 * cos_q_3;
    let t15 = sin_q_2 * p.a;
    let t16 = S::from_ratio(1, 500);
    let t17 = sin_q_6 * p.k4 + cos_q_6 * t16;
    let t18 = sin_q_6 * t17;
    let t19 = p.k4 - t18;
    let t20 = t0 * p.k50 + sin_q_5 * (t19 - p.k49);
    let t21 = sin_q_5 * t20;
    let m44 = t21 + p.k51;
    let t22 = S::from_ratio(1, 1000) - cos_q_6 * t17;
    let t23 = sin_q_6 * p.k45;
    let t24 = cos_q_6 * p.k45;
    let t25 = cos_q_5 * t20 - t24;
    let t26 = cos_q_4 * t25 + (t9 * t22 - t10 * t23) + t3 * p.b;
    let t27 = t26 + p.k36;
    let t28 = t5 * (t15 * t4 + (t5 * (m44 + p.k12) + t14 * t27));
    let t29 = t21 + p.k9 - t19;
    let t30 = cos_q_4 * t29;
    let t31 = t9 * t23 + t10 * t22;
    let m55 = t18 + p.k6;
    let t32 = sin_q_4 * sin_q_4;
    let t33 = t31 * (cos_q_4 * S::from_f64(2.0)) + t32 * m55;
    let t34 = t15 * t13 + (t5 * t27 + t14 * (t33 + (t12 * p.k55 - cos_q_4 * t30)));
    let t35 = t14 * t34 + p.k15 + (t15 * (t4 * t5 + t13 * t14) + t28);
    let t36 = cos_q_4 * sin_q_5;
    let t37 = cos_q_4 * cos_q_5;
    let t38 = t23 * t36 + t22 * t37;
    let t39 = cos_q_4 * m55;
    let t40 = sin_q_4 * t8;
    let t41 = t40 - cos_q_4 * t11;
    let t42 = cos_q_4 * t38 + sin_q_4 * t39 + (sin_q_4 * t30 - sin_q_4 * t31);
    let t43 = p.k5 * t37 - t6 * t36;
    let t44 = t40 - sin_q_4 * t43;
    let t45 = t42 - p.b * t41 - p.b * t44;
    let t46 = sin_q_3 * p.k52;
    let t47 = sin_q_3 * p.k54;
    let t48 = t0 * t47;
    let t49 = sin_q_6 * t47;
    let t50 = p.a * cos_q_3;
    let t51 = t2 * cos_q_4 + sin_q_4 * t1;
    let m43 = t22 * t36 - t23 * t37 - sin_q_4 * t25 - p.b * t51;
    let t52 = t16 + m43;
    let t53 = t50 * t51;
    let t54 = t14 * (t45 - t9 * t46 - (cos_q_4 * t49 + sin_q_4 * t48) - t50 * t41);
    let t55 = t15 * t44;
    let t56 = cos_q_4 * t43 + t7 * t32;
    let t57 = cos_q_4 * t39 + p.k11 + (p.k55 * t56 - t29 * t32);
    let m33 = t57 - t38 * (sin_q_4 * S::from_f64(2.0));
    let t58 = sin_q_3 * p.k46 - t50 * (p.k10 + t56);
    let t59 = m33 - t58;
    let t60 = cos_q_4 * t48 + t36 * t46 - sin_q_4 * t49;
    let m54 = sin_q_5 * t22 - cos_q_5 * t23;
    let t61 = sin_q_5 * t23 + cos_q_5 * t22;
    let t62 = sin_q_4 * t7;
    let t63 = t5 * m54 + t14 * (p.b * t62 + (cos_q_4 * t61 + sin_q_4 * m55));
    let m53 = t39 + t8 * p.b - sin_q_4 * t61;
    let t64 = sin_q_5 * p.k3 - t0 * p.k45;
    let t65 = cos_q_6 * cos_q_4 - sin_q_6 * t10;
    let m64 = sin_q_5 * t24 + cos_q_5 * p.k3;
    let t66 = t14 * (sin_q_4 * t23 + cos_q_4 * t64 - t65 * p.k53) - t5 * m64;
    let t67 = sin_q_6 * t37 + cos_q_6 * sin_q_4;
    let m63 = sin_q_4 * t64 - cos_q_4 * t23 - p.k53 * t67;
    let m11 = t35 - cos_q_2 * (cos_q_2 * p.k14);
    let m21 = t5 * (t52 - t53) + t54 - (t55 + cos_q_2 * p.k31);
    let m22 = t59 + p.k13 - (t58 + S::from_f64(2.0) * t60);
    let m31 = t5 * t52 + t14 * t45 - t55;
    let m32 = t59 - t60;
    let m41 = t15 * t3 + (t5 * m44 + t14 * t26);
    let m42 = m43 - t53;
    let m51 = t15 * t62 + t63;
    let m52 = t8 * t50 + m53 - (t48 + sin_q_5 * t46);
    let m61 = t65 * (sin_q_2 * p.k54) - t66;
    let m62 = sin_q_5 * t49 + m63 - t67 * (cos_q_3 * p.k54);
    let m65 = -t23;
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
    let t0 = cos_q_2 * q_1_dot;
    let (sin_q_3, cos_q_3) = q_3.sin_cos();
    let t1 = sin_q_2 * q_1_dot;
    let t2 = t0 * cos_q_3 - sin_q_3 * t1;
    let t3 = t2 + q_4_dot;
    let (sin_q_5, cos_q_5) = q_5.sin_cos();
    let t4 = t0 * sin_q_3 + cos_q_3 * t1;
    let (sin_q_4, cos_q_4) = q_4.sin_cos();
    let t5 = q_3_dot + q_2_dot;
    let t6 = cos_q_4 * t4 - t5 * sin_q_4;
    let t7 = sin_q_5 * t3 + t6 * cos_q_5;
    let (sin_q_6, cos_q_6) = q_6.sin_cos();
    let t8 = sin_q_4 * t4 + t5 * cos_q_4;
    let t9 = t8 + q_5_dot;
    let t10 = cos_q_6 * t7 - t9 * sin_q_6;
    let t11 = t10 * t10;
    let t12 = sin_q_6 * t7 + t9 * cos_q_6;
    let t13 = t12 * t12;
    let t14 = S::from_ratio(1, 1000);
    let t15 = cos_q_5 * t3 - t6 * sin_q_5;
    let t16 = t15 + q_6_dot;
    let t17 = t16 * t12;
    let t18 = q_2_dot * t0;
    let t19 = q_2_dot * t1;
    let t20 = q_3_dot * t2 + (cos_q_3 * t18 - sin_q_3 * t19);
    let t21 = cos_q_4 * t20 - q_4_dot * t8;
    let t22 = q_3_dot * t4 + (sin_q_3 * t18 + cos_q_3 * t19);
    let t23 = t15 * q_5_dot + (cos_q_5 * t21 - sin_q_5 * t22);
    let t24 = t6 * q_4_dot + sin_q_4 * t20;
    let t25 = cos_q_6 * t23 - sin_q_6 * t24 - q_6_dot * t12;
    let t26 = q_5_dot * t7 + (sin_q_5 * t21 + cos_q_5 * t22);
    let t27 = t10 * t12;
    let t28 = t26 * p.k3 - t27 * p.k4 - (t14 * (t11 - t13) + p.k41 * (t17 + t25));
    let t29 = t0 * t1;
    let t30 = q_2_dot * q_2_dot;
    let t31 = t30 + t1 * t1;
    let t32 = cos_q_3 * t29 - sin_q_3 * t31;
    let t33 = t4 * t2;
    let t34 = p.a * t32 + p.b * t33;
    let t35 = t5 * t2;
    let t36 = t20 + t35;
    let t37 = t36 * p.b + t18 * p.k29;
    let t38 = sin_q_4 * t34 + cos_q_4 * t37;
    let t39 = t15 * t9;
    let t40 = t23 + t39;
    let t41 = sin_q_3 * t29 + cos_q_3 * t31;
    let t42 = t4 * t4;
    let t43 = t5 * t5;
    let t44 = t43 + t42;
    let t45 = p.a * t41 + t44 * p.b;
    let t46 = sin_q_4 * t37 - cos_q_4 * t34;
    let t47 = sin_q_5 * t45 + cos_q_5 * t46;
    let t48 = t15 * t7;
    let t49 = t24 - t48;
    let t50 = p.k43 * (cos_q_6 * (t38 + t40 * p.c) - sin_q_6 * (t47 + t49 * p.c));
    let t51 = t26 * p.k7 - t9 * (t7 * p.k6) - (t28 - t50);
    let t52 = t16 * t10;
    let t53 = t52 + (q_6_dot * t10 + (sin_q_6 * t23 + cos_q_6 * t24));
    let t54 = t27 + t26;
    let t55 = t25 * p.k4 - t17 * p.k3 - (t53 * t14 + t54 * p.k41);
    let t56 = t16 * t16;
    let t57 = t13 + t56;
    let t58 = sin_q_6 * t57 + cos_q_6 * t54;
    let t59 = t9 * t9 + t7 * t7;
    let t60 = t52 * p.k42 - t14 * (t25 - t17) - p.k41 * (t56 - t11);
    let t61 = p.k43 * (cos_q_5 * t45 - sin_q_5 * t46 + t59 * p.c) + t60;
    let t62 = sin_q_6 * t61 + (p.k5 * t38 + t39 * p.k40);
    let t63 = t62 + (cos_q_6 * t55 - t58 * p.k47);
    let t64 = sin_q_5 * t51 + (t3 * (t8 * p.k8) + t21 * p.k9) - cos_q_5 * t63;
    let t65 = sin_q_6 * t54 - cos_q_6 * t57;
    let t66 = p.k43 * t65 + p.k5 * t49;
    let t67 = p.k43 * t53 + t59 * p.k5;
    let t68 = cos_q_5 * t66 - sin_q_5 * t67;
    let t69 = p.k5 * t40 - p.k43 * t58;
    let t70 = sin_q_4 * t68 + cos_q_4 * t69;
    let t71 = cos_q_6 * t61 + (p.k5 * t47 + (t24 * p.k6 - t48 * p.k7));
    let h_q_5 = t71 + (t65 * p.k47 - sin_q_6 * t55);
    let t72 = t3 * (t6 * p.k39) + h_q_5;
    let t73 = t5 * t4;
    let t74 = t22 + t73;
    let t75 = t2 * t2;
    let t76 = S::from_ratio(1, 500);
    let t77 = t18 * p.k37 + (t35 * p.k35 - t74 * p.k36 - t76 * (t43 - t75));
    let t78 = sin_q_4 * t72 + t77 + (t70 * p.b - cos_q_4 * t64);
    let t79 = t8 * (t6 * p.k9) + t22 * p.k8 - sin_q_5 * t63;
    let t80 = cos_q_5 * t51;
    let t81 = t33 * t76 + t22 * p.k12 + (t73 * p.k11 - t36 * p.k36) - t18 * p.k38;
    let t82 = t79 - t80 + t81;
    let t83 = sin_q_2 * (p.k31 * (t30 - t0 * t0) + t18 * p.k30);
    let t84 = t78 * (sin_q_2 * cos_q_3) + t78 * (cos_q_2 * sin_q_3);
    let t85 = (t70 + (t36 * p.k10 - p.k33 * t74)) * (sin_q_2 * p.a);
    let t86 = t85 + cos_q_2 * (t29 * p.k31 - t19 * p.k32) - t82 * (cos_q_2 * cos_q_3);
    let t87 = sin_q_4 * t69 - cos_q_4 * t68;
    let t88 = p.k36 * (t42 - t75) + t33 * p.k12 - t76 * (t22 - t73);
    let t89 = cos_q_4 * t72 + (t41 * p.k46 - t32 * p.k34 + t88);
    let h_q_3 = t89 + (sin_q_4 * t64 - p.b * t87);
    let t90 = p.a * sin_q_3;
    let t91 = (t87 + (p.k33 * (t43 + t75) + p.k10 * t33)) * (p.a * cos_q_3);
    let t92 = t66 * (sin_q_5 * t90) + t29 * p.k14 + (t91 + t67 * (cos_q_5 * t90));
    let h_q_1 = t84 + (t83 + t82 * (sin_q_2 * sin_q_3)) + t86;
    let h_q_2 = -(t90 * (p.k10 * t44 + p.k33 * t33) - h_q_3 + t92);
    let h_q_4 = t80 - t79;
    let h_q_6 = t50 - t28;
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
    let (sin_q_3, cos_q_3) = q_3.sin_cos();
    let (sin_q_2, cos_q_2) = q_2.sin_cos();
    let t0 = cos_q_3 * cos_q_2;
    let t1 = sin_q_3 * sin_q_2;
    let t2 = t0 - t1;
    let (sin_q_5, cos_q_5) = q_5.sin_cos();
    let t3 = sin_q_3 * cos_q_2;
    let t4 = cos_q_3 * sin_q_2;
    let t5 = t3 + t4;
    let (sin_q_4, cos_q_4) = q_4.sin_cos();
    let t6 = cos_q_4 * t5;
    let t7 = p.k48 * (cos_q_5 * t2 - sin_q_5 * t6);
    let (sin_q_6, cos_q_6) = q_6.sin_cos();
    let t8 = sin_q_5 * t2 + cos_q_5 * t6;
    let t9 = cos_q_6 * t7 + t8 * p.k28;
    let t10 = sin_q_4 * t5;
    let t11 = t10 * p.k28 - sin_q_6 * t7;
    let t12 = p.k48 * (sin_q_6 * t8 + cos_q_6 * t10);
    let t13 = cos_q_5 * t11 - sin_q_5 * t12;
    let t14 = sin_q_4 * t9 - cos_q_4 * t13;
    let t15 = cos_q_5 * t12 + sin_q_5 * t11;
    let t16 = t4 * t14 + t3 * t14 + (t1 * t15 - t0 * t15) - p.friction * q_1_dot;
    let t17 = sin_q_4 * t13 + (cos_q_4 * t9 + (t5 * p.k26 + t2 * p.k27));
    let q_q_1 = t16 + u.tau[0];
    let q_q_2 = t17 + sin_q_2 * p.k25 - p.friction * q_2_dot + u.tau[1];
    let q_q_3 = t17 - p.friction * q_3_dot + u.tau[2];
    let q_q_4 = u.tau[3] - (t15 + p.friction * q_4_dot);
    let q_q_5 = t9 - p.friction * q_5_dot + u.tau[4];
    let q_q_6 = u.tau[5] - (t12 + p.friction * q_6_dot);
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
    let t7 = t3 * sin_q_5 + cos_q_5 * t6;
    let (sin_q_6, cos_q_6) = q_6.sin_cos();
    let t8 = sin_q_4 * t4 + t5 * cos_q_4;
    let t9 = t8 + q_5_dot;
    let t10 = cos_q_6 * t7 - sin_q_6 * t9;
    let t11 = t10 * t10;
    let t12 = sin_q_6 * t7 + cos_q_6 * t9;
    let t13 = t12 * t12;
    let t14 = S::from_ratio(1, 1000);
    let t15 = t3 * cos_q_5 - sin_q_5 * t6;
    let t16 = t15 + q_6_dot;
    let t17 = t12 * t16;
    let t18 = t0 * q_2_dot;
    let t19 = t1 * q_2_dot;
    let t20 = t2 * q_3_dot + (cos_q_3 * t18 - sin_q_3 * t19);
    let t21 = cos_q_4 * t20 - q_4_dot * t8;
    let t22 = q_3_dot * t4 + (sin_q_3 * t18 + cos_q_3 * t19);
    let t23 = t15 * q_5_dot + (cos_q_5 * t21 - sin_q_5 * t22);
    let t24 = q_4_dot * t6 + sin_q_4 * t20;
    let t25 = cos_q_6 * t23 - sin_q_6 * t24 - t12 * q_6_dot;
    let t26 = t7 * q_5_dot + (sin_q_5 * t21 + cos_q_5 * t22);
    let t27 = t12 * t10;
    let t28 = q_2_dot * q_2_dot;
    let t29 = cos_q_2 * p.g - p.a * (t28 + t1 * t1);
    let t30 = t1 * t0;
    let t31 = t30 * p.a + sin_q_2 * p.g;
    let t32 = cos_q_3 * t29 - sin_q_3 * t31;
    let t33 = t4 * t4;
    let t34 = t5 * t5;
    let t35 = t34 + t33;
    let t36 = t32 - t35 * p.b;
    let t37 = t2 * t4;
    let t38 = sin_q_3 * t29 + cos_q_3 * t31;
    let t39 = p.b * t37 + t38;
    let t40 = t2 * t5;
    let t41 = t20 + t40;
    let t42 = p.b * t41 + t18 * p.k29;
    let t43 = cos_q_4 * t39 - sin_q_4 * t42;
    let t44 = sin_q_5 * t36 + cos_q_5 * t43;
    let t45 = t7 * t15;
    let t46 = t24 - t45;
    let t47 = t15 * t9;
    let t48 = t47 + t23;
    let t49 = sin_q_4 * t39 + cos_q_4 * t42;
    let t50 = p.k43 * (sin_q_6 * (t44 - t46 * p.c) + cos_q_6 * (p.c * t48 + t49));
    let t51 = t26 * p.k3 - t27 * p.k4 - (t14 * (t11 - t13) + p.k41 * (t17 + t25));
    let t52 = t51 - t50;
    let t53 = t26 * p.k7 - t9 * (t7 * p.k6) - t52;
    let t54 = t10 * t16;
    let t55 = t16 * t16;
    let t56 = t9 * t9 + t7 * t7;
    let t57 = t54 * p.k42 - t14 * (t25 - t17) - p.k41 * (t55 - t11);
    let t58 = t57 - p.k43 * (cos_q_5 * t36 - sin_q_5 * t43 - p.c * t56);
    let t59 = t13 + t55;
    let t60 = t27 + t26;
    let t61 = sin_q_6 * t59 + cos_q_6 * t60;
    let t62 = t54 + (t10 * q_6_dot + (sin_q_6 * t23 + cos_q_6 * t24));
    let t63 = t25 * p.k4 - t17 * p.k3 - (t14 * t62 + p.k41 * t60);
    let t64 = cos_q_6 * t63 + (t47 * p.k40 + t49 * p.k5);
    let t65 = t64 + (sin_q_6 * t58 - p.k47 * t61);
    let t66 = sin_q_5 * t53 + (t3 * (t8 * p.k8) + t21 * p.k9) - cos_q_5 * t65;
    let t67 = sin_q_6 * t60 - cos_q_6 * t59;
    let t68 = p.k47 * t67 + (t24 * p.k6 - t45 * p.k7 - t44 * p.k5);
    let t69 = t68 + (cos_q_6 * t58 - sin_q_6 * t63);
    let t70 = t69 + t3 * (t6 * p.k39);
    let t71 = p.k43 * t67 + t46 * p.k5;
    let t72 = p.k43 * t62 + t56 * p.k5;
    let t73 = cos_q_5 * t71 - sin_q_5 * t72;
    let t74 = t48 * p.k5 - p.k43 * t61;
    let t75 = sin_q_4 * t73 + cos_q_4 * t74;
    let t76 = t5 * t4;
    let t77 = t22 + t76;
    let t78 = t2 * t2;
    let t79 = S::from_ratio(1, 500);
    let t80 = t18 * p.k37 + (t40 * p.k35 - p.k36 * t77 - t79 * (t34 - t78));
    let t81 = p.b * t75 + t80 + (sin_q_4 * t70 - cos_q_4 * t66);
    let t82 = t8 * (t6 * p.k9) + t22 * p.k8 - sin_q_5 * t65 - cos_q_5 * t53;
    let t83 = t37 * t79 + t22 * p.k12 + (t76 * p.k11 - t41 * p.k36) - t18 * p.k38;
    let t84 = t82 + t83;
    let t85 = t84 * (sin_q_2 * sin_q_3) - t84 * (cos_q_2 * cos_q_3);
    let t86 = (t75 + (t41 * p.k10 - t77 * p.k33)) * (sin_q_2 * p.a);
    let t87 = sin_q_2 * (p.k31 * (t28 - t0 * t0) + t18 * p.k30);
    let t88 = cos_q_2 * (t30 * p.k31 - t19 * p.k32) + t87;
    let t89 = t81 * (sin_q_2 * cos_q_3) + t81 * (cos_q_2 * sin_q_3) + t85;
    let t90 = sin_q_4 * t74 - cos_q_4 * t73;
    let t91 = p.k36 * (t33 - t78) + t37 * p.k12 - t79 * (t22 - t76);
    let t92 = p.b * t90 + (t38 * p.k10 + t32 * p.k33 - t91);
    let t93 = t92 - (sin_q_4 * t66 + cos_q_4 * t70);
    let t94 = sin_q_3 * p.a;
    let t95 = (t90 + (p.k33 * (t34 + t78) + t37 * p.k10)) * (cos_q_3 * p.a);
    let t96 = t71 * (sin_q_5 * t94) + (t30 * p.k14 + sin_q_2 * p.k25);
    let t97 = t93 + t94 * (t35 * p.k10 + t37 * p.k33) - q_2_dot * p.friction;
    let f_q_1 = u.tau[0] - (t88 + (q_1_dot * p.friction + t86) + t89);
    let f_q_2 = t96 + (t95 + t72 * (cos_q_5 * t94)) + t97 + u.tau[1];
    let f_q_3 = u.tau[2] - (q_3_dot * p.friction - t93);
    let f_q_4 = u.tau[3] - (q_4_dot * p.friction - t82);
    let f_q_5 = u.tau[4] - (t69 + q_5_dot * p.friction);
    let f_q_6 = t52 - q_6_dot * p.friction + u.tau[5];
    [f_q_1, f_q_2, f_q_3, f_q_4, f_q_5, f_q_6]
}

/// Accelerations `a`, the solution of `M a = f`.
///
/// `M = L D Lᵀ` is eliminated without what is known to be zero; a pivot of `D` that vanishes is an
/// error.
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
        let angles = [q_2, q_3, q_5, q_4, q_6];
        let circular = N::sin_cos_all(angles);
        let (sin_q_2, cos_q_2) = circular[0];
        let (sin_q_3, cos_q_3) = circular[1];
        let (sin_q_5, cos_q_5) = circular[2];
        let (sin_q_4, cos_q_4) = circular[3];
        let (sin_q_6, cos_q_6) = circular[4];
        let t0 = cos_q_2 * q_1_dot;
        let t1 = sin_q_2 * q_1_dot;
        let t2 = cos_q_3.mul_sub(t0, sin_q_3 * t1);
        let t3 = t2 + q_4_dot;
        let t4 = sin_q_3.mul_add(t0, cos_q_3 * t1);
        let t5 = q_3_dot + q_2_dot;
        let t6 = cos_q_4.mul_sub(t4, sin_q_4 * t5);
        let t7 = sin_q_5.mul_add(t3, cos_q_5 * t6);
        let t8 = sin_q_4.mul_add(t4, cos_q_4 * t5);
        let t9 = t8 + q_5_dot;
        let t10 = cos_q_6.mul_sub(t7, sin_q_6 * t9);
        let t11 = t10 * t10;
        let t12 = sin_q_6.mul_add(t7, cos_q_6 * t9);
        let t13 = t12 * t12;
        let t14 = N::from_ratio(1, 1000);
        let t15 = cos_q_5.mul_sub(t3, sin_q_5 * t6);
        let t16 = t15 + q_6_dot;
        let t17 = t12 * t16;
        let t18 = t0 * q_2_dot;
        let t19 = t1 * q_2_dot;
        let t20 = t2.mul_add(q_3_dot, cos_q_3.mul_sub(t18, sin_q_3 * t19));
        let t21 = cos_q_4.mul_sub(t20, q_4_dot * t8);
        let t22 = q_3_dot.mul_add(t4, sin_q_3.mul_add(t18, cos_q_3 * t19));
        let t23 = t15.mul_add(q_5_dot, cos_q_5.mul_sub(t21, sin_q_5 * t22));
        let t24 = sin_q_4.mul_add(t20, q_4_dot * t6);
        let t25 = cos_q_6.mul_sub(t23, sin_q_6 * t24);
        let t26 = t12.neg_mul_add(q_6_dot, t25);
        let t27 = t7.mul_add(q_5_dot, sin_q_5.mul_add(t21, cos_q_5 * t22));
        let t28 = t12 * t10;
        let t29 = n(p.k41).mul_add(t17 + t26, t14 * (t11 - t13));
        let t30 = q_2_dot * q_2_dot;
        let t31 = n(p.a).neg_mul_add(t1.mul_add(t1, t30), cos_q_2 * n(p.g));
        let t32 = t1 * t0;
        let t33 = n(p.a).mul_add(t32, sin_q_2 * n(p.g));
        let t34 = cos_q_3.mul_sub(t31, sin_q_3 * t33);
        let t35 = t4 * t4;
        let t36 = t5 * t5;
        let t37 = t36 + t35;
        let t38 = n(p.b).neg_mul_add(t37, t34);
        let t39 = t2 * t4;
        let t40 = sin_q_3.mul_add(t31, cos_q_3 * t33);
        let t41 = n(p.b).mul_add(t39, t40);
        let t42 = t2 * t5;
        let t43 = t20 + t42;
        let t44 = n(p.b).mul_add(t43, t18 * n(p.k29));
        let t45 = sin_q_4.neg_mul_add(t44, cos_q_4 * t41);
        let t46 = cos_q_5.mul_add(t45, sin_q_5 * t38);
        let t47 = t7 * t15;
        let t48 = t24 - t47;
        let t49 = t15 * t9;
        let t50 = t49 + t23;
        let t51 = cos_q_4.mul_add(t44, sin_q_4 * t41);
        let t52 = cos_q_6 * n(p.c).mul_add(t50, t51);
        let t53 = sin_q_6.mul_add(t48.neg_mul_add(n(p.c), t46), t52);
        let t54 = n(p.k3).mul_sub(t27, n(p.k4) * t28) - t29;
        let t55 = n(p.k43).neg_mul_add(t53, t54);
        let t56 = t27.mul_sub(n(p.k7), t9 * (n(p.k6) * t7)) - t55;
        let t57 = n(p.k9).mul_add(t21, t3 * (t8 * n(p.k8)));
        let t58 = t10 * t16;
        let t59 = t16 * t16;
        let t60 = t14.neg_mul_add(t26 - t17, t58 * n(p.k42));
        let t61 = t7.mul_add(t7, t9 * t9);
        let t62 = sin_q_5.neg_mul_add(t45, cos_q_5 * t38);
        let t63 = n(p.k41).neg_mul_add(t59 - t11, t60);
        let t64 = n(p.k43).neg_mul_add(n(p.c).neg_mul_add(t61, t62), t63);
        let t65 = t13 + t59;
        let t66 = t28 + t27;
        let t67 = sin_q_6.mul_add(t65, cos_q_6 * t66);
        let t68 = t10.mul_add(q_6_dot, sin_q_6.mul_add(t23, cos_q_6 * t24));
        let t69 = t58 + t68;
        let t70 = n(p.k4).mul_sub(t26, n(p.k3) * t17);
        let t71 = t70 - t14.mul_add(t69, n(p.k41) * t66);
        let t72 = cos_q_6.mul_add(t71, n(p.k5).mul_add(t51, t49 * n(p.k40)));
        let t73 = t72 + sin_q_6.mul_sub(t64, n(p.k47) * t67);
        let t74 = cos_q_5.neg_mul_add(t73, sin_q_5.mul_add(t56, t57));
        let t75 = sin_q_6.mul_sub(t66, cos_q_6 * t65);
        let t76 = t47.neg_mul_add(n(p.k7), n(p.k6) * t24);
        let t77 = n(p.k47).mul_add(t75, n(p.k5).neg_mul_add(t46, t76));
        let t78 = t77 + cos_q_6.mul_sub(t64, sin_q_6 * t71);
        let t79 = t3.mul_add(t6 * n(p.k39), t78);
        let t80 = n(p.k43).mul_add(t75, n(p.k5) * t48);
        let t81 = n(p.k43).mul_add(t69, n(p.k5) * t61);
        let t82 = cos_q_5.mul_sub(t80, sin_q_5 * t81);
        let t83 = n(p.k43).neg_mul_add(t67, n(p.k5) * t50);
        let t84 = sin_q_4.mul_add(t82, cos_q_4 * t83);
        let t85 = t5 * t4;
        let t86 = t22 + t85;
        let t87 = t2 * t2;
        let t88 = N::from_ratio(1, 500);
        let t89 = n(p.k36).neg_mul_add(t86, t42 * n(p.k35));
        let t90 = t18.mul_add(n(p.k37), t88.neg_mul_add(t36 - t87, t89));
        let t91 = sin_q_4.mul_sub(t79, cos_q_4 * t74);
        let t92 = n(p.b).mul_add(t84, t90) + t91;
        let t93 = sin_q_2 * cos_q_3;
        let t94 = cos_q_2 * sin_q_3;
        let t95 = t8.mul_add(n(p.k9) * t6, t22 * n(p.k8));
        let t96 = cos_q_5.neg_mul_add(t56, sin_q_5.neg_mul_add(t73, t95));
        let t97 = n(p.k36).neg_mul_add(t43, n(p.k11) * t85);
        let t98 = n(p.k12).mul_add(t22, t88 * t39) + t97;
        let t99 = t96 + t18.neg_mul_add(n(p.k38), t98);
        let t100 = sin_q_2 * sin_q_3;
        let t101 = cos_q_2 * cos_q_3;
        let t102 = t100.mul_sub(t99, t101 * t99);
        let t103 = sin_q_2 * n(p.a);
        let t104 = t84 + n(p.k10).mul_sub(t43, n(p.k33) * t86);
        let t105 = n(p.k31).mul_add(t0.neg_mul_add(t0, t30), t18 * n(p.k30));
        let t106 = n(p.k31).mul_sub(t32, t19 * n(p.k32));
        let t107 = t103.mul_add(t104, q_1_dot * n(p.friction));
        let t108 = cos_q_2.mul_add(t106, sin_q_2 * t105) + t107;
        let t109 = t108 + (t93.mul_add(t92, t94 * t92) + t102);
        let t110 = n(u.tau[0]) - t109;
        let t111 = cos_q_6 * cos_q_5;
        let t112 = t111.mul_add(n(p.k43), sin_q_5 * n(p.k5));
        let t113 = sin_q_6 * n(p.k43);
        let t114 = cos_q_4.mul_sub(t112, sin_q_4 * t113);
        let t115 = t114 + n(p.k33);
        let t116 = t101 - t100;
        let t117 = cos_q_6 * sin_q_5;
        let t118 = t117 * n(p.k43);
        let t119 = cos_q_5.mul_sub(n(p.k5), t118);
        let t120 = cos_q_4 * t119;
        let t121 = cos_q_5 * sin_q_4;
        let t122 = t118.neg_mul_add(sin_q_4, n(p.k5) * t121);
        let t123 = cos_q_4.mul_add(t120, sin_q_4 * t122);
        let t124 = n(p.k10) + t123;
        let t125 = t94 + t93;
        let t126 = sin_q_6.mul_add(n(p.k4), cos_q_6 * t88);
        let t127 = sin_q_6 * t126;
        let t128 = n(p.k4) - t127;
        let t129 = sin_q_5.mul_add(t128 - n(p.k49), t111 * n(p.k50));
        let t130 = sin_q_5 * t129;
        let t131 = t130 + n(p.k51);
        let t132 = cos_q_6.neg_mul_add(t126, t14);
        let t133 = sin_q_5 * t132;
        let t134 = sin_q_6 * n(p.k45);
        let t135 = cos_q_5.mul_sub(t129, cos_q_6 * n(p.k45));
        let t136 = cos_q_4.mul_add(t135, sin_q_4.mul_sub(t133, t134 * t121));
        let t137 = t114.mul_add(n(p.b), t136);
        let t138 = t137 + n(p.k36);
        let t139 = t125.mul_add(t138, t116 * (t131 + n(p.k12)));
        let t140 = t103 * t124.mul_add(t125, t115 * t116);
        let t141 = t130 + n(p.k9) - t128;
        let t142 = cos_q_4 * t141;
        let t143 = sin_q_5 * t134;
        let t144 = t132.mul_add(t121, sin_q_4 * t143);
        let t145 = t127 + n(p.k6);
        let t146 = sin_q_4 * sin_q_4;
        let t147 = t144.mul_add(cos_q_4 * N::from_f64(2.0), t146 * t145);
        let t148 = t147 + cos_q_4.neg_mul_add(t142, n(p.k55) * t123);
        let t149 = t103.mul_add(t124, t125.mul_add(t148, t116 * t138));
        let t150 = t116.mul_add(t103.mul_add(t115, t139), t140);
        let t151 = t125.mul_add(t149, n(p.k15)) + t150;
        let t152 = cos_q_2.neg_mul_add(cos_q_2 * n(p.k14), t151);
        let t152 = checked(t152, t152, 5.329070518200751e-15, 0)?;
        let t153 = N::ONE / t152;
        let t154 = cos_q_5 * cos_q_4;
        let t155 = t154.mul_add(t132, cos_q_4 * t143);
        let t156 = cos_q_4 * t145;
        let t157 = sin_q_4.mul_sub(t142, sin_q_4 * t144);
        let t158 = sin_q_4 * t120;
        let t159 = cos_q_4.neg_mul_add(t122, t158);
        let t160 = sin_q_4.mul_add(t156, cos_q_4 * t155) + t157;
        let t161 = t118.neg_mul_add(cos_q_4, t154 * n(p.k5));
        let t162 = sin_q_4.neg_mul_add(t161, t158);
        let t163 = n(p.b).neg_mul_add(t162, n(p.b).neg_mul_add(t159, t160));
        let t164 = sin_q_5 * sin_q_3;
        let t165 = t164 * n(p.k52);
        let t166 = sin_q_3 * n(p.k54);
        let t167 = t111 * t166;
        let t168 = sin_q_6 * t166;
        let t169 = cos_q_4.mul_add(t168, sin_q_4 * t167);
        let t170 = n(p.a) * cos_q_3;
        let t171 = sin_q_4.neg_mul_add(t165, t163) - t169;
        let t172 = cos_q_4.mul_sub(t133, t154 * t134);
        let t173 = sin_q_4.mul_add(t112, cos_q_4 * t113);
        let t174 = n(p.b).neg_mul_add(t173, sin_q_4.neg_mul_add(t135, t172));
        let t175 = t88 + t174;
        let t176 = t170 * t173;
        let t177 = t170.neg_mul_add(t159, t171);
        let t178 = t103 * t162;
        let t179 = t125.mul_add(t177, t116 * (t175 - t176));
        let t180 = t179 - cos_q_2.mul_add(n(p.k31), t178);
        let t181 = t153 * t180;
        let t182 = cos_q_4.neg_mul_add(t82, sin_q_4 * t83);
        let t183 = n(p.k36).mul_add(t35 - t87, n(p.k12) * t39);
        let t184 = n(p.k10).mul_add(t40, n(p.k33) * t34);
        let t185 = t184 - t88.neg_mul_add(t22 - t85, t183);
        let t186 = sin_q_4.mul_add(t74, cos_q_4 * t79);
        let t187 = n(p.b).mul_add(t182, t185) - t186;
        let t188 = n(p.a) * sin_q_3;
        let t189 = t188.mul_add(n(p.k10).mul_add(t37, n(p.k33) * t39), t187);
        let t190 = t182 + n(p.k33).mul_add(t36 + t87, n(p.k10) * t39);
        let t191 = n(p.k14).mul_add(t32, sin_q_2 * n(p.k25));
        let t192 = t170.mul_add(t190, t81 * (cos_q_5 * t188));
        let t193 = q_2_dot.neg_mul_add(n(p.friction), t189);
        let t194 = t80.mul_add(n(p.a) * t164, t191) + t192 + t193;
        let t195 = t181.neg_mul_add(t110, t194 + n(u.tau[1]));
        let t196 = cos_q_4.mul_add(t161, t146 * t119);
        let t197 = t146.neg_mul_add(t141, n(p.k55) * t196);
        let t198 = cos_q_4.mul_add(t156, n(p.k11)) + t197;
        let t199 = t155.neg_mul_add(sin_q_4 * N::from_f64(2.0), t198);
        let t200 = t170.neg_mul_add(t196 + n(p.k10), sin_q_3 * n(p.k46));
        let t201 = t199 - t200;
        let t202 = cos_q_4.mul_add(t167, cos_q_4 * t165);
        let t203 = sin_q_4.neg_mul_add(t168, t202);
        let t204 = t201 + n(p.k13) - N::from_f64(2.0).mul_add(t203, t200);
        let t205 = t180.neg_mul_add(t181, t204);
        let t205 = checked(t205, t204, 5.329070518200751e-15, 1)?;
        let t206 = N::ONE / t205;
        let t207 = t125.mul_add(t163, t116 * t175) - t178;
        let t208 = t153 * t207;
        let t209 = t180.mul_add(t208, t203 - t201);
        let t210 = t206 * t209;
        let t211 = n(u.tau[2]) - q_3_dot.mul_sub(n(p.friction), t187);
        let t212 = t208.neg_mul_add(t110, t210.mul_add(t195, t211));
        let t213 = t209.neg_mul_add(t210, t207.neg_mul_add(t208, t199));
        let t213 = checked(t213, t199, 5.329070518200751e-15, 2)?;
        let t214 = N::ONE / t213;
        let t215 = cos_q_5.neg_mul_add(t134, t133);
        let t216 = cos_q_5.mul_add(t132, t143);
        let t217 = sin_q_4 * t119;
        let t218 = cos_q_4.mul_add(t216, sin_q_4 * t145);
        let t219 = t125.mul_add(n(p.b).mul_add(t217, t218), t116 * t215);
        let t220 = t103.mul_add(t217, t219);
        let t221 = t153 * t220;
        let t222 = sin_q_4.neg_mul_add(t216, t120.mul_add(n(p.b), t156));
        let t223 = t120.mul_add(t170, t222) - (t167 + t165);
        let t224 = t180.neg_mul_add(t221, t223);
        let t225 = t206 * t224;
        let t226 = t207.neg_mul_add(t221, t209.mul_add(t225, t222));
        let t227 = t214 * t226;
        let t228 = n(u.tau[4]) - q_5_dot.mul_add(n(p.friction), t78);
        let t229 = t227.mul_add(t212, t225 * t195);
        let t230 = t103.mul_add(t114, t125.mul_add(t137, t131 * t116));
        let t231 = t153 * t230;
        let t232 = t180.neg_mul_add(t231, t174 - t176);
        let t233 = t206 * t232;
        let t234 = t207.neg_mul_add(t231, t209.mul_add(t233, t174));
        let t235 = t214 * t234;
        let t236 = n(u.tau[3]) - q_4_dot.mul_sub(n(p.friction), t96);
        let t237 = t235.mul_add(t212, t233 * t195);
        let t238 = t231.neg_mul_add(t110, t236) - t237;
        let t239 = t234.mul_add(t235, t232 * t233);
        let t240 = t230.neg_mul_add(t231, t131) - t239;
        let t240 = checked(t240, t131, 5.329070518200751e-15, 3)?;
        let t241 = N::ONE / t240;
        let t242 = t234.mul_add(t227, t232 * t225);
        let t243 = t230.neg_mul_add(t221, t215) - t242;
        let t244 = t241 * t243;
        let t245 = t221.neg_mul_add(t110, t228) - t229;
        let t246 = t244.neg_mul_add(t238, t245);
        let t247 = t226.mul_add(t227, t224 * t225);
        let t248 = t220.neg_mul_add(t221, t145) - t247;
        let t249 = t243.neg_mul_add(t244, t248);
        let t249 = checked(t249, t145, 5.329070518200751e-15, 4)?;
        let t250 = N::ONE / t249;
        let t251 = t111.neg_mul_add(n(p.k45), sin_q_5 * n(p.k3));
        let t252 = sin_q_6.neg_mul_add(t121, cos_q_6 * cos_q_4);
        let t253 = cos_q_4.mul_add(t251, sin_q_4 * t134);
        let t254 = t117.mul_add(n(p.k45), cos_q_5 * n(p.k3));
        let t255 = n(p.k53).neg_mul_add(t252, t253);
        let t256 = t125.mul_sub(t255, t116 * t254);
        let t257 = t252.neg_mul_add(sin_q_2 * n(p.k54), t256);
        let t258 = t153 * t257;
        let t259 = sin_q_6.mul_add(t154, cos_q_6 * sin_q_4);
        let t260 = sin_q_4.mul_sub(t251, cos_q_4 * t134);
        let t261 = n(p.k53).neg_mul_add(t259, t260);
        let t262 = sin_q_5.mul_add(t168, t261);
        let t263 = t259.neg_mul_add(cos_q_3 * n(p.k54), t262);
        let t264 = t180.mul_add(t258, t263);
        let t265 = t206 * t264;
        let t266 = t209.mul_add(t265, t207.mul_add(t258, t261));
        let t267 = t214 * t266;
        let t268 = t230.mul_add(t258, t254) - t234.mul_add(t267, t232 * t265);
        let t269 = t241 * t268;
        let t270 = t224.mul_add(t265, t134) + t243.mul_add(t269, t226 * t267);
        let t271 = t220.neg_mul_add(t258, t270);
        let t272 = t250 * t271;
        let t273 = q_6_dot.neg_mul_add(n(p.friction), t55) + n(u.tau[5]);
        let t274 = t258.mul_add(t110, t273) + t272.mul_sub(t246, t265 * t195);
        let t275 = t266.mul_add(t267, t264 * t265);
        let t276 = t257.neg_mul_add(t258, n(p.k3)) - t275;
        let t277 = t276 - t271.mul_add(t272, t268 * t269);
        let t277 = checked(t277, n(p.k3), 5.329070518200751e-15, 5)?;
        let q_6_ddot = (t274 - t269.mul_add(t238, t267 * t212)) / t277;
        let q_5_ddot = t272.mul_add(q_6_ddot, t250 * t246);
        let t278 = t244.neg_mul_add(q_5_ddot, t241 * t238);
        let q_4_ddot = t269.neg_mul_add(q_6_ddot, t278);
        let t279 = t227.mul_add(q_5_ddot, t267 * q_6_ddot);
        let q_3_ddot = t235.neg_mul_add(q_4_ddot, t214 * t212) - t279;
        let t280 = t233.mul_add(q_4_ddot, t225 * q_5_ddot);
        let t281 = t210.mul_add(q_3_ddot, t206 * t195) - t280;
        let q_2_ddot = t265.neg_mul_add(q_6_ddot, t281);
        let t282 = t181.mul_add(q_2_ddot, t208 * q_3_ddot);
        let t283 = t258.mul_add(q_6_ddot, t153 * t110) - t282;
        let q_1_ddot = t283 - t231.mul_add(q_4_ddot, t221 * q_5_ddot);
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
    let t17 = q_2_dot * (cos_q_3 * p.a);
    let t18 = t17 + t5 * p.b;
    let t19 = cos_q_4 * t16 - sin_q_4 * t18;
    let t20 = t19 + t10 * p.c;
    let t21 = sin_q_4 * t16 + cos_q_4 * t18;
    let t22 = sin_q_3 * q_2_dot;
    let t23 = t22 * p.a;
    let t24 = cos_q_5 * t21 - sin_q_5 * t23;
    let t25 = t24 + t12 * p.c;
    let t26 = t9 * t8 + t13 * t14 + (cos_q_6 * t20 - sin_q_6 * t25);
    let t27 = t10 * sin_q_6 + cos_q_6 * t12;
    let t28 = t27 * t14 + (sin_q_6 * t20 + cos_q_6 * t25);
    let t29 = cos_q_5 * t23 + sin_q_5 * t21;
    let t30 = t29 - t27 * t9;
    let t31 = S::from_ratio(1, 100);
    let t32 = S::from_ratio(1, 50);
    let t33 = S::from_ratio(1, 1000);
    let t34 = t8 * (t8 * t31) + t13 * (t13 * t32 - t27 * t33);
    let t35 = (t30 * t30 + (t26 * t26 + t28 * t28)) * p.m6;
    let t36 = t19 + t10 * p.k2;
    let t37 = t24 + t12 * p.k2;
    let t38 = S::from_ratio(1, 500);
    let t39 = t7 * (t7 * t33) + (t12 * (t12 * t38) + t10 * (t10 * t38));
    let t40 = S::from_f64(0.5) * ((t29 * t29 + (t36 * t36 + t37 * t37)) * p.m5 + t39);
    let t41 = S::from_ratio(3, 1000);
    let t42 = t3 * (t3 * t38) + (t11 * (t11 * t41) + t6 * (t6 * t41));
    let t43 = (t22 * (t22 * p.k16) + (t19 * t19 + t21 * t21)) * p.m4 + t42;
    let t44 = t2 * t31;
    let t45 = t15 + (t44 + t4 * p.k1);
    let t46 = t17 + t5 * p.k1;
    let t47 = t23 - t5 * t31;
    let t48 = S::from_ratio(9, 100);
    let t49 = t4 * (t4 * t48) + (t2 * (t44 + t5 * t38) + t5 * (t5 * t48 + t2 * t38));
    let t50 = S::from_f64(0.5) * ((t47 * t47 + (t45 * t45 + t46 * t46)) * p.m3 + t49);
    let t51 = q_2_dot * p.k0 - t0 * t9;
    let t52 = t1 * t1;
    let t53 = S::from_ratio(13, 100);
    let t54 = t0 * (t0 * t32) + (t52 * t53 + q_2_dot * (q_2_dot * t53));
    let t55 = S::from_f64(0.5) * ((t52 * p.k17 + t51 * t51) * p.m2 + t54);
    let t56 = S::from_f64(0.5) * (t35 + (t34 - t27 * (t13 * t33 - t27 * t32))) + t40;
    let t57 = t55 + q_1_dot * (q_1_dot * p.k44) + (S::from_f64(0.5) * t43 + t50);
    t56 + t57
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
    let t6 = cos_q_6 * (sin_q_5 * t0 + cos_q_5 * t2) - sin_q_6 * (t1 * sin_q_4);
    let t7 = t3 * S::from_ratio(2, 25) + (t5 + t3 * p.c) - S::from_ratio(3, 100) * t6;
    let t8 = p.k19 * (t4 + t0 * p.k1 - t1 * S::from_ratio(1, 100));
    let t9 = t5 * p.k20 + p.k23 + (t8 + p.k18 * (p.h + cos_q_2 * p.k0));
    p.k22 * t7 + p.k21 * (t5 + t3 * p.k2) + t9
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
    let t1 = sin_q_5 * (cos_q_4 * (sin_q_3 * cos_q_2 + cos_q_3 * sin_q_2));
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
        *result = accelerations(self, q, v, u)?;
        Ok(())
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

    fn is_singular(&self) -> bool {
        false
    }

    fn accelerations_abreast(
        p: &Self::Several,
        _: ::lagrangian::Lanes<N>,
        q: &Self::Vectors,
        v: &Self::Vectors,
        u: &Self::SeveralInputs,
    ) -> Result<Self::Vectors, ::lagrangian::Singular> {
        accelerations(p, q, v, u)
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

/// A pivot of which elimination has left more than rounding errors of a diagonal element. Where
/// numbers have several lanes, it is undefined in those in which there is nothing left.
#[inline(always)]
fn checked<N: ::lagrangian::Scalar>(
    pivot: N,
    diagonal: N,
    share: f64,
    coordinate: usize,
) -> Result<N, ::lagrangian::Singular> {
    let bound = N::from_f64(share) * diagonal;
    match pivot.guarded(bound) {
        Some(pivot) => Ok(pivot),
        None => Err(singular(coordinate, pivot, diagonal)),
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
