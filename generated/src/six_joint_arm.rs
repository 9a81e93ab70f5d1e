// @generated from machines/six_joint_arm.machine by `cargo xtask generate`; edits are lost.

//! An industrial arm with six revolute joints: a turning column, shoulder and elbow in its plane,
//! and
//! a wrist of three axes. Masses and sizes are those of a desk-sized arm that carries 5 kg.
//!
//! 6 coordinates, 12 parameters, 6 inputs, 1 output. Arithmetic of one call:
//!
//! | function | mul | add | div | sin cos | other | temporaries |
//! | --- | --: | --: | --: | --: | --: | --: |
//! | `prepare` | 62 | 15 | 0 | 0 | 0 | 77 |
//! | `mass_matrix` | 265 | 195 | 0 | 5 | 0 | 470 |
//! | `bias` | 234 | 158 | 0 | 5 | 0 | 402 |
//! | `applied` | 77 | 51 | 0 | 5 | 0 | 138 |
//! | `forces` | 242 | 173 | 0 | 5 | 0 | 425 |
//! | `accelerations` | 583 | 430 | 6 | 5 | 0 | 1029 |
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
        let k3 = self.a * self.a;
        let t0 = S::from_ratio(1, 10000);
        let k6 = self.m3 * self.g;
        let k9 = self.m6 * self.g;
        let t1 = self.g * S::from_f64(0.5);
        let t2 = S::from_ratio(3, 100);
        let t3 = S::from_ratio(2, 25);
        let t4 = S::from_ratio(1, 100);
        let t5 = self.a * self.m2;
        let k19 = t5 * S::from_f64(0.25);
        let t6 = self.m2 * S::from_f64(9.0);
        let t7 = S::from_f64(2.0) + self.c * S::from_f64(25.0);
        let t8 = self.m6 * t7;
        let k31 = t8 * S::from_ratio(1, 25);
        let k32 = S::from_f64(0.25) * (self.c * self.m5);
        let t9 = self.m5 + self.m6;
        let t10 = self.a * self.g;
        let k0 = self.a * S::from_f64(0.5);
        let k1 = self.b * S::from_f64(0.5);
        let k2 = self.c * S::from_f64(0.5);
        let k4 = t0 * (S::from_f64(9.0) + k3 * S::from_f64(2500.0));
        let k5 = self.m2 * self.g;
        let k7 = self.m4 * self.g;
        let k8 = self.m5 * self.g;
        let k10 = t1 * (self.h * self.m1);
        let k11 = self.friction * S::from_f64(0.5);
        let k12 = self.a * S::from_f64(2.0);
        let k13 = S::from_ratio(1, 20000) * (self.m1 + S::from_f64(600.0));
        let k14 = self.m6 * t2;
        let k15 = self.m6 * t3;
        let k16 = self.m5 * S::from_f64(0.5);
        let k17 = self.m3 * S::from_f64(0.5);
        let k18 = self.m3 * t4;
        let k20 = t5 * S::from_ratio(3, 200);
        let k21 = t0 * (t6 + S::from_f64(1300.0));
        let k22 = t0 * (t6 + S::from_f64(200.0));
        let k23 = t0 * self.m1 + S::from_ratio(3, 50);
        let k24 = self.a * self.m4;
        let k25 = self.a * k19 + S::from_ratio(13, 100);
        let k26 = self.b * self.m4;
        let k27 = self.b * self.m5;
        let k28 = S::from_f64(0.25) * (self.b * self.m3);
        let k29 = self.m3 * t0 + S::from_ratio(9, 100);
        let k30 = (S::from_f64(9.0) + t7 * S::from_f64(32.0)) * (self.m6 * t0);
        let k33 = t8 * S::from_ratio(3, 2500);
        let k34 = t8 * S::from_ratio(2, 625);
        let k35 = self.c * (k31 + k32) + S::from_ratio(1, 500);
        let k36 = t4 + self.m6 * S::from_ratio(9, 10000);
        let k37 = self.m2 * S::from_f64(0.5);
        let k38 = self.m2 * t2;
        let k39 = S::from_f64(0.5) * t5;
        let k40 = k9 * t3;
        let k41 = k9 * t2;
        let k42 = self.m5 * t1;
        let k43 = self.g * t9;
        let k44 = t9 * t10;
        let k45 = self.g * (self.m4 + self.m5);
        let k46 = self.m3 * t1;
        let k47 = k6 * t4;
        let k48 = t10 * (self.m3 + self.m4);
        let k49 = t1 * t5;
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
    /// `a^2`
    k3: S,
    /// `0.0001*(9 + 2500*a^2)`
    k4: S,
    /// `m2*g`
    k5: S,
    /// `m3*g`
    k6: S,
    /// `m4*g`
    k7: S,
    /// `m5*g`
    k8: S,
    /// `m6*g`
    k9: S,
    /// `0.5*h*m1*g`
    k10: S,
    /// `0.5*friction`
    k11: S,
    /// `2*a`
    k12: S,
    /// `0.00005*(m1 + 600)`
    k13: S,
    /// `0.03*m6`
    k14: S,
    /// `0.08*m6`
    k15: S,
    /// `0.5*m5`
    k16: S,
    /// `0.5*m3`
    k17: S,
    /// `0.01*m3`
    k18: S,
    /// `0.25*a*m2`
    k19: S,
    /// `0.015*a*m2`
    k20: S,
    /// `0.0001*(1300 + 9*m2)`
    k21: S,
    /// `0.0001*(9*m2 + 200)`
    k22: S,
    /// `0.06 + 0.0001*m1`
    k23: S,
    /// `a*m4`
    k24: S,
    /// `0.13 + 0.25*a^2*m2`
    k25: S,
    /// `b*m4`
    k26: S,
    /// `b*m5`
    k27: S,
    /// `0.25*b*m3`
    k28: S,
    /// `0.09 + 0.0001*m3`
    k29: S,
    /// `0.0001*m6*(9 + 32*(2 + 25*c))`
    k30: S,
    /// `0.04*m6*(2 + 25*c)`
    k31: S,
    /// `0.25*c*m5`
    k32: S,
    /// `0.0012*m6*(2 + 25*c)`
    k33: S,
    /// `0.0032*m6*(2 + 25*c)`
    k34: S,
    /// `0.002 + c*(0.04*m6*(2 + 25*c) + 0.25*c*m5)`
    k35: S,
    /// `0.01 + 0.0009*m6`
    k36: S,
    /// `0.5*m2`
    k37: S,
    /// `0.03*m2`
    k38: S,
    /// `0.5*a*m2`
    k39: S,
    /// `0.08*m6*g`
    k40: S,
    /// `0.03*m6*g`
    k41: S,
    /// `0.5*m5*g`
    k42: S,
    /// `g*(m5 + m6)`
    k43: S,
    /// `a*g*(m5 + m6)`
    k44: S,
    /// `g*(m4 + m5)`
    k45: S,
    /// `0.5*m3*g`
    k46: S,
    /// `0.01*m3*g`
    k47: S,
    /// `a*g*(m3 + m4)`
    k48: S,
    /// `0.5*a*m2*g`
    k49: S,
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
    let (sin_q_2, cos_q_2) = q_2.sin_cos();
    let (sin_q_3, cos_q_3) = q_3.sin_cos();
    let t0 = cos_q_2 * cos_q_3;
    let t1 = sin_q_2 * sin_q_3;
    let t2 = t0 - t1;
    let (sin_q_5, cos_q_5) = q_5.sin_cos();
    let t3 = cos_q_2 * sin_q_3;
    let t4 = sin_q_2 * cos_q_3;
    let t5 = t3 + t4;
    let (sin_q_4, cos_q_4) = q_4.sin_cos();
    let t6 = cos_q_4 * cos_q_5;
    let t7 = sin_q_5 * t2 + t5 * t6;
    let (sin_q_6, cos_q_6) = q_6.sin_cos();
    let t8 = sin_q_4 * t5;
    let t9 = cos_q_6 * t7 - sin_q_6 * t8;
    let t10 = S::from_ratio(1, 1000);
    let t11 = sin_q_6 * t7 + cos_q_6 * t8;
    let t12 = S::from_ratio(1, 50);
    let t13 = S::from_ratio(3, 100);
    let t14 = sin_q_2 * p.a;
    let t15 = t14 + t5 * p.b;
    let t16 = sin_q_4 * sin_q_5;
    let t17 = t15 * t16;
    let t18 = t17 - t13 * t11;
    let t19 = cos_q_4 * t15;
    let t20 = t19 + t7 * p.c;
    let t21 = sin_q_4 * cos_q_5;
    let t22 = t15 * t21;
    let t23 = t22 + t8 * p.c;
    let t24 = S::from_ratio(2, 25);
    let t25 = t11 * t24 + (sin_q_6 * t20 + cos_q_6 * t23);
    let t26 = t18 * p.k14 + (t9 * t10 - t11 * t12) - t25 * p.k15;
    let t27 = cos_q_4 * sin_q_5;
    let t28 = cos_q_5 * t2 - t5 * t27;
    let t29 = t24 * t9 + t13 * t28 + (cos_q_6 * t20 - sin_q_6 * t23);
    let t30 = t29 * p.k15 + (t9 * t12 - t11 * t10);
    let t31 = p.m6 * (sin_q_6 * t25 + cos_q_6 * t29);
    let t32 = t19 + t7 * p.k2;
    let t33 = S::from_ratio(1, 500);
    let t34 = sin_q_6 * t26 - cos_q_6 * t30 - (p.c * (t31 + t32 * p.k16) + t7 * t33);
    let t35 = S::from_ratio(1, 100);
    let m61 = t29 * p.k14 + t28 * t35;
    let t36 = t28 * t10 + m61;
    let t37 = S::from_ratio(3, 1000);
    let t38 = cos_q_4 * t37;
    let t39 = sin_q_5 * t36 + cos_q_5 * t34 - t5 * t38;
    let t40 = sin_q_6 * t30 + cos_q_6 * t26;
    let t41 = p.m6 * (sin_q_6 * t29 - cos_q_6 * t25);
    let t42 = t22 + t8 * p.k2;
    let t43 = p.c * (t42 * p.k16 - t41) + t8 * t33;
    let t44 = t40 - t43 - t8 * t37;
    let t45 = cos_q_4 * p.m4;
    let t46 = p.m5 * t32 + (t31 + t15 * t45);
    let t47 = t41 - p.m5 * t42;
    let t48 = t18 * p.m6 + t17 * p.m5;
    let t49 = sin_q_4 * p.m4;
    let t50 = cos_q_5 * t47 - sin_q_5 * t48 - t49 * t15;
    let t51 = cos_q_4 * t46 - sin_q_4 * t50;
    let t52 = t2 * t35;
    let t53 = t14 + (t52 + t5 * p.k1);
    let t54 = S::from_ratio(9, 100);
    let t55 = cos_q_4 * t39 + sin_q_4 * t44 - (p.b * (t51 + t53 * p.k17) + t5 * t54);
    let t56 = sin_q_5 * t34 - cos_q_5 * t36;
    let t57 = t2 * t33;
    let t58 = t52 + t53 * p.k18 - (t56 - t57);
    let t59 = cos_q_2 * (cos_q_2 * p.k22) + sin_q_2 * (sin_q_2 * p.k21);
    let t60 = t14 * (t53 * p.m3 + (t51 + sin_q_2 * p.k19)) + t0 * t58 + t59;
    let t61 = cos_q_4 * t50 + sin_q_4 * t46;
    let m31 = t57 + sin_q_4 * t39 - (p.b * t61 + cos_q_4 * t44);
    let t62 = p.a * sin_q_3;
    let t63 = sin_q_5 * t62;
    let t64 = cos_q_5 * t62;
    let t65 = p.a * cos_q_3;
    let t66 = cos_q_4 * cos_q_6 - sin_q_6 * t21;
    let t67 = cos_q_4 * sin_q_6 + cos_q_6 * t21;
    let t68 = t10 * t66 + t12 * t67;
    let t69 = p.b + t65;
    let t70 = t6 * t69 - t63;
    let t71 = cos_q_4 * p.c;
    let t72 = t71 + t70;
    let t73 = p.c * t21;
    let t74 = sin_q_4 * t69;
    let t75 = t73 + t74;
    let t76 = t13 * t16 - t24 * t67;
    let t77 = sin_q_6 * t72 + cos_q_6 * t75 - t76;
    let t78 = t68 + p.k15 * t77;
    let t79 = t12 * t66 + t10 * t67;
    let t80 = t24 * t66;
    let t81 = t80 + (cos_q_6 * t72 - sin_q_6 * t75);
    let t82 = t64 + t27 * t69;
    let t83 = t13 * t66;
    let t84 = t82 - t83;
    let t85 = t79 + p.k15 * t81 - p.k14 * t84;
    let t86 = p.m6 * (cos_q_6 * t81 + sin_q_6 * t77);
    let t87 = cos_q_4 * p.k2;
    let t88 = t70 + t87;
    let t89 = cos_q_4 * t33;
    let m52 = sin_q_6 * t78 + cos_q_6 * t85 + (t89 + p.c * (t86 + p.k16 * t88));
    let t90 = t86 + p.m5 * t88;
    let t91 = p.m6 * t84 + p.m5 * t82;
    let t92 = p.m6 * (cos_q_6 * t77 - sin_q_6 * t81);
    let t93 = t21 * p.k2;
    let t94 = t74 + t93;
    let t95 = cos_q_4 * (t45 * t69 + (sin_q_5 * t91 + cos_q_5 * t90));
    let t96 = t95 + sin_q_4 * (p.m5 * t94 + (t92 + t49 * t69));
    let t97 = p.k1 + t65;
    let t98 = t35 - t62;
    let t99 = t21 * t33;
    let t100 = sin_q_6 * t85 - cos_q_6 * t78 - (t99 + p.c * (t92 + p.k16 * t94));
    let t101 = t16 * t35;
    let m62 = t101 - p.k14 * t77;
    let t102 = t16 * t10;
    let t103 = t102 + m62;
    let t104 = sin_q_4 * t37;
    let t105 = t54 + cos_q_4 * (t38 + m52) + (p.b * (t96 + p.k17 * t97) + p.k18 * t98);
    let m32 = t105 - sin_q_4 * (cos_q_5 * t100 - sin_q_5 * t103 - t104);
    let t106 = p.k25 + m32 + (t65 * (t96 + p.m3 * t97) + t64 * t91);
    let t107 = p.b * t6;
    let t108 = t71 + t107;
    let t109 = sin_q_4 * p.b;
    let t110 = t73 + t109;
    let t111 = t80 + (cos_q_6 * t108 - sin_q_6 * t110);
    let t112 = t76 - (sin_q_6 * t108 + cos_q_6 * t110);
    let t113 = p.m6 * (sin_q_6 * t111 + cos_q_6 * t112);
    let t114 = t93 + t109;
    let t115 = t83 - p.b * t27;
    let t116 = p.k14 * t115 + (t79 + p.k15 * t111);
    let t117 = t68 - p.k15 * t112;
    let t118 = t99 + cos_q_6 * t117 + (p.c * (p.k16 * t114 - t113) - sin_q_6 * t116);
    let m63 = t101 + p.k14 * t112;
    let t119 = t102 + m63;
    let t120 = p.m6 * (sin_q_6 * t112 - cos_q_6 * t111);
    let t121 = t87 + t107;
    let t122 = cos_q_5 * (t120 - p.m5 * t121) - sin_q_5 * (t27 * p.k27 - p.m6 * t115);
    let t123 = sin_q_4 * (t113 - sin_q_4 * p.k26 - p.m5 * t114);
    let t124 = p.b * (cos_q_4 * (t122 - cos_q_4 * p.k26) + t123 - p.k28);
    let m53 = t89 + cos_q_6 * t116 + (p.c * (p.k16 * t121 - t120) + sin_q_6 * t117);
    let t125 = sin_q_4 * (sin_q_5 * t119 + (t104 + cos_q_5 * t118)) - t124;
    let t126 = cos_q_6 * sin_q_5;
    let t127 = p.c * t126 + (t24 * t126 + t13 * cos_q_5);
    let t128 = sin_q_6 * sin_q_5;
    let t129 = p.k15 * t127 + (t12 * t126 - t10 * t128);
    let t130 = t10 * t126 - t12 * t128 - t128 * p.k30;
    let t131 = sin_q_6 * p.k31;
    let t132 = p.m6 * t127;
    let t133 = p.c * (sin_q_5 * p.k32 + (t131 * t128 + cos_q_6 * t132)) + sin_q_5 * t33;
    let m64 = p.k14 * t127 + cos_q_5 * t35;
    let t134 = sin_q_5 * (sin_q_6 * t130 - cos_q_6 * t129 - t133);
    let t135 = p.c * (sin_q_6 * t132 - t126 * t131) + (sin_q_6 * t129 + cos_q_6 * t130);
    let t136 = p.k35 + cos_q_6 * (cos_q_6 * p.k30 + (sin_q_6 * t10 + cos_q_6 * t12));
    let m11 = t60 - (t4 * t55 + t3 * t55 + (t1 * t58 - p.k23));
    let m21 = t47 * t63 + m31 + (t48 * t64 - cos_q_2 * p.k20) - t65 * t61;
    let m22 = t62 * (sin_q_3 * p.k24 - p.m3 * t98) - t63 * t90 + t106;
    let m33 = p.k29 + cos_q_4 * (t38 + m53) + t125;
    let m41 = t57 - t56;
    let m42 = cos_q_5 * t103 + sin_q_5 * t100;
    let m43 = cos_q_5 * t119 - sin_q_5 * t118;
    let m44 = t33 + cos_q_5 * (cos_q_5 * t10 + m64) - t134;
    let m51 = t43 - t40;
    let m54 = -t135;
    let m55 = sin_q_6 * (sin_q_6 * p.k34 + (sin_q_6 * t12 + cos_q_6 * t10)) + t136;
    let m65 = -(sin_q_6 * p.k33);
    [
        [m11, m21, m31, m41, m51, m61],
        [m21, m22, m32, m42, m52, m62],
        [m31, m32, m33, m43, m53, m63],
        [m41, m42, m43, m44, m54, m64],
        [m51, m52, m53, m54, m55, m65],
        [m61, m62, m63, m64, m65, p.k36],
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
    let t0 = sin_q_2 * q_1_dot;
    let t1 = cos_q_2 * q_1_dot;
    let t2 = t0 * t1;
    let (sin_q_3, cos_q_3) = q_3.sin_cos();
    let t3 = t0 * t0;
    let t4 = t3 + q_2_dot * q_2_dot;
    let t5 = p.a * (cos_q_3 * t2 - t4 * sin_q_3);
    let t6 = cos_q_3 * t1 - t0 * sin_q_3;
    let t7 = t6 * p.b;
    let t8 = sin_q_3 * t1 + t0 * cos_q_3;
    let t9 = t5 + t7 * t8;
    let (sin_q_4, cos_q_4) = q_4.sin_cos();
    let t10 = q_2_dot * t1;
    let t11 = t0 * q_2_dot;
    let t12 = t6 * q_3_dot + (cos_q_3 * t10 - sin_q_3 * t11);
    let t13 = t10 * p.k12;
    let t14 = q_2_dot + q_3_dot;
    let t15 = t7 * t14 + (t13 + p.b * t12);
    let t16 = t9 * sin_q_4 + cos_q_4 * t15;
    let t17 = t8 * sin_q_4 + cos_q_4 * t14;
    let t18 = cos_q_4 * t12 - t17 * q_4_dot;
    let (sin_q_5, cos_q_5) = q_5.sin_cos();
    let t19 = t8 * q_3_dot + (sin_q_3 * t10 + cos_q_3 * t11);
    let t20 = t6 + q_4_dot;
    let t21 = t8 * cos_q_4 - sin_q_4 * t14;
    let t22 = cos_q_5 * t20 - sin_q_5 * t21;
    let t23 = q_5_dot * t22 + (cos_q_5 * t18 - sin_q_5 * t19);
    let t24 = t17 + q_5_dot;
    let t25 = t24 * t22;
    let t26 = t16 + (p.c * t25 + p.c * t23);
    let (sin_q_6, cos_q_6) = q_6.sin_cos();
    let t27 = p.a * (sin_q_3 * t2 + t4 * cos_q_3);
    let t28 = t14 * t14;
    let t29 = t27 + p.b * (t28 + t8 * t8);
    let t30 = sin_q_4 * t15 - t9 * cos_q_4;
    let t31 = sin_q_5 * t29 + t30 * cos_q_5;
    let t32 = q_4_dot * t21 + sin_q_4 * t12;
    let t33 = sin_q_5 * t20 + cos_q_5 * t21;
    let t34 = t33 * t22;
    let t35 = t31 + p.c * t32 - p.c * t34;
    let t36 = t33 * sin_q_6 + t24 * cos_q_6;
    let t37 = S::from_ratio(2, 25);
    let t38 = t36 * t37;
    let t39 = q_6_dot + t22;
    let t40 = t33 * cos_q_6 - t24 * sin_q_6;
    let t41 = S::from_ratio(3, 100);
    let t42 = t41 * t36;
    let t43 = q_5_dot * t33 + (sin_q_5 * t18 + cos_q_5 * t19);
    let t44 = cos_q_6 * t23 - sin_q_6 * t32 - q_6_dot * t36;
    let t45 = cos_q_6 * t26 - sin_q_6 * t35 + (t38 * t39 - t40 * t42);
    let t46 = t45 - (t41 * t43 - t37 * t44);
    let t47 = t41 * t39 + t40 * t37;
    let t48 = t40 * q_6_dot + (sin_q_6 * t23 + cos_q_6 * t32);
    let t49 = t36 * t42 + t39 * t47 - t48 * t37 - (sin_q_6 * t26 + cos_q_6 * t35);
    let t50 = p.m6 * (cos_q_6 * t46 - sin_q_6 * t49);
    let t51 = t16 + (p.k2 * t25 + t23 * p.k2);
    let t52 = p.m5 * t51 + (t50 + p.m4 * t16);
    let t53 = p.m6 * (cos_q_6 * t49 + sin_q_6 * t46);
    let t54 = t31 + t32 * p.k2 - p.k2 * t34;
    let t55 = t53 - p.m5 * t54;
    let t56 = cos_q_5 * t29 - t30 * sin_q_5;
    let t57 = t24 * t24 + t33 * t33;
    let t58 = t56 + t57 * p.c + (t48 * t41 + (t36 * t38 + t40 * t47));
    let t59 = t58 * p.m6 + p.m5 * (t56 + t57 * p.k2);
    let t60 = sin_q_5 * t59 + cos_q_5 * t55 - t30 * p.m4;
    let t61 = cos_q_4 * t52 - sin_q_4 * t60;
    let t62 = S::from_ratio(1, 100);
    let t63 = t19 * t62;
    let t64 = t8 * t14;
    let t65 = t13 + (t14 * (t6 * p.k1) - t62 * t64) - (t63 - t12 * p.k1);
    let t66 = t39 * t62;
    let t67 = S::from_ratio(1, 1000);
    let t68 = S::from_ratio(1, 50);
    let t69 = t40 * t67 - t36 * t68;
    let t70 = t36 * t66 + t39 * t69 - (t44 * t68 - t48 * t67) - t46 * p.k15;
    let t71 = t40 * t68 - t36 * t67;
    let t72 = t49 * p.k15 + (t44 * t67 - t48 * t68 + (t39 * t71 - t40 * t66));
    let t73 = t72 - t58 * p.k14;
    let t74 = S::from_ratio(1, 500);
    let t75 = p.c * (t50 + t51 * p.k16) + (t25 * t67 + t23 * t74);
    let t76 = t75 - (cos_q_6 * t70 + sin_q_6 * t73);
    let t77 = t20 * t67;
    let t78 = S::from_ratio(3, 1000);
    let h_q_6 = t46 * p.k14 + (t36 * t71 + t40 * t69 - t43 * t62);
    let t79 = h_q_6 - t43 * t67;
    let t80 = cos_q_5 * t76 + (t17 * t77 + t18 * t78) - sin_q_5 * t79;
    let t81 = p.c * (t54 * p.k16 - t53) - cos_q_6 * t73;
    let h_q_5 = sin_q_6 * t70 + (t32 * t74 - t34 * t67) + t81;
    let t82 = h_q_5 + (t32 * t78 - t21 * t77);
    let t83 = S::from_ratio(9, 100);
    let t84 = t14 * t83 + t6 * t74;
    let t85 = t6 * t62;
    let t86 = t85 + t14 * t74;
    let t87 = t14 * t86 - t6 * t84 - t12 * t83 - sin_q_4 * t82;
    let t88 = t87 - (p.b * (t61 + t65 * p.k17) + cos_q_4 * t80);
    let t89 = t19 * t74;
    let t90 = t89 - sin_q_5 * t76;
    let t91 = cos_q_5 * t79;
    let t92 = t90 - t91 + (t63 + (t8 * t84 - t64 * t83)) - t65 * p.k18;
    let t93 = t11 * t41;
    let t94 = t93 - (t93 + t2 * p.k0);
    let t95 = cos_q_2 * (p.k38 * t94 + t11 * t68) + t92 * (cos_q_2 * cos_q_3);
    let t96 = q_2_dot * p.k0 - t1 * t41;
    let t97 = t65 * p.m3 + (t61 + p.k37 * (t10 * p.k0 + (t1 * t96 - t3 * t41)));
    let t98 = p.k38 * (t10 * t41 + (t3 * p.k0 + q_2_dot * t96));
    let t99 = sin_q_2 * (t98 + t10 * S::from_ratio(6, 25)) + t92 * (sin_q_2 * sin_q_3);
    let t100 = t88 * (sin_q_2 * cos_q_3) + t88 * (cos_q_2 * sin_q_3) + t95;
    let t101 = t85 + t8 * p.k1;
    let t102 = t27 + (t28 * p.k1 + t8 * t101);
    let t103 = cos_q_4 * t82 + (t8 * t86 - t8 * (t6 * t83) - t89);
    let t104 = cos_q_4 * t60 + sin_q_4 * t52;
    let t105 = t5 + (t28 * t62 + t6 * t101);
    let h_q_3 = t103 + (p.k18 * t102 - sin_q_4 * t80) - p.b * (t104 + p.k17 * t105);
    let t106 = p.a * sin_q_3;
    let t107 = t55 * (sin_q_5 * t106) - t2 * S::from_ratio(11, 100);
    let t108 = (t104 + p.m3 * t105) * (p.a * cos_q_3) + t59 * (cos_q_5 * t106);
    let h_q_1 = t97 * (sin_q_2 * p.a) + t99 - t100;
    let h_q_2 = t94 * p.k39 + h_q_3 + t107 - (t106 * (p.m3 * t102 + p.m4 * t29) + t108);
    let h_q_4 = t91 - t90;
    [h_q_1, h_q_2, h_q_3, h_q_4, h_q_5, h_q_6]
}

/// Applied generalized forces `Q`.
///
/// ```text
/// Q[q[1]] = …
/// Q[q[2]] = …
/// Q[q[3]] = …
/// Q[q[4]] = …
/// Q[q[5]] = …
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
    let t7 = sin_q_5 * t2 + t6 * cos_q_5;
    let (sin_q_6, cos_q_6) = q_6.sin_cos();
    let t8 = sin_q_4 * t5;
    let t9 = cos_q_6 * t7 - t8 * sin_q_6;
    let t10 = cos_q_5 * t2 - t6 * sin_q_5;
    let t11 = t9 * p.k40 + t10 * p.k41;
    let t12 = sin_q_6 * t7 + t8 * cos_q_6;
    let t13 = cos_q_6 * t12;
    let t14 = p.k9 * (t13 - sin_q_6 * t9);
    let t15 = sin_q_6 * t11 - t13 * p.k40 - p.c * (t14 + t8 * p.k42);
    let t16 = t12 * p.k41;
    let t17 = sin_q_5 * t16 + cos_q_5 * t15;
    let t18 = sin_q_6 * t12;
    let t19 = p.k9 * (cos_q_6 * t9 + t18);
    let t20 = p.c * (t19 + t7 * p.k42) + (t18 * p.k40 + cos_q_6 * t11);
    let t21 = t14 + t8 * p.k45;
    let t22 = t19 + t7 * p.k8;
    let t23 = t6 * p.k7 + cos_q_5 * t22 - t10 * (sin_q_5 * p.k43);
    let t24 = cos_q_4 * t21 - sin_q_4 * t23;
    let t25 = cos_q_4 * t17 + sin_q_4 * t20 - t24 * p.b;
    let t26 = sin_q_5 * t15 - cos_q_5 * t16;
    let t27 = t24 * (sin_q_2 * p.a) + p.friction * q_1_dot;
    let t28 = cos_q_4 * t23 + sin_q_4 * t21;
    let t29 = t2 * p.k47 + cos_q_4 * t20 + (p.b * (t28 + t5 * p.k46) - sin_q_4 * t17);
    let t30 = (t28 + t5 * p.k6) * (cos_q_3 * p.a) - sin_q_3 * p.a * (sin_q_5 * t22);
    let t31 = t2 * (sin_q_3 * p.k48) + sin_q_3 * p.k44 * (cos_q_5 * t10);
    let q_q_1 = t4 * t25 + t3 * t25 + (t0 * t26 - t1 * t26) - t27 + u.tau[0];
    let q_q_2 = t29 + sin_q_2 * p.k49 + t30 - (p.friction * q_2_dot + t31) + u.tau[1];
    let q_q_3 = t29 - p.friction * q_3_dot + u.tau[2];
    let q_q_4 = t26 - p.friction * q_4_dot + u.tau[3];
    let q_q_5 = t20 - p.friction * q_5_dot + u.tau[4];
    let q_q_6 = u.tau[5] - (t16 + p.friction * q_6_dot);
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
    let t0 = sin_q_2 * q_1_dot;
    let t1 = t0 * t0;
    let t2 = cos_q_2 * p.g;
    let t3 = t2 - p.a * (t1 + q_2_dot * q_2_dot);
    let (sin_q_3, cos_q_3) = q_3.sin_cos();
    let t4 = cos_q_2 * q_1_dot;
    let t5 = t4 * t0;
    let t6 = sin_q_2 * p.g;
    let t7 = t6 + p.a * t5;
    let t8 = cos_q_3 * t3 - sin_q_3 * t7;
    let t9 = t4 * sin_q_3 + t0 * cos_q_3;
    let t10 = q_2_dot + q_3_dot;
    let t11 = t10 * t10;
    let t12 = t8 - p.b * (t11 + t9 * t9);
    let (sin_q_5, cos_q_5) = q_5.sin_cos();
    let t13 = sin_q_3 * t3 + cos_q_3 * t7;
    let t14 = t4 * cos_q_3 - t0 * sin_q_3;
    let t15 = t14 * p.b;
    let t16 = t13 + t15 * t9;
    let (sin_q_4, cos_q_4) = q_4.sin_cos();
    let t17 = t4 * q_2_dot;
    let t18 = q_2_dot * t0;
    let t19 = t14 * q_3_dot + (t17 * cos_q_3 - sin_q_3 * t18);
    let t20 = t17 * p.k12;
    let t21 = t15 * t10 + (t20 + p.b * t19);
    let t22 = cos_q_4 * t16 - t21 * sin_q_4;
    let t23 = sin_q_5 * t12 + t22 * cos_q_5;
    let t24 = t14 + q_4_dot;
    let t25 = cos_q_4 * t9 - t10 * sin_q_4;
    let t26 = t24 * sin_q_5 + cos_q_5 * t25;
    let t27 = t24 * cos_q_5 - sin_q_5 * t25;
    let t28 = t26 * t27;
    let t29 = q_4_dot * t25 + t19 * sin_q_4;
    let t30 = t23 + p.c * t28 - t29 * p.c;
    let (sin_q_6, cos_q_6) = q_6.sin_cos();
    let t31 = sin_q_4 * t16 + t21 * cos_q_4;
    let t32 = sin_q_4 * t9 + t10 * cos_q_4;
    let t33 = t19 * cos_q_4 - t32 * q_4_dot;
    let t34 = q_3_dot * t9 + (t17 * sin_q_3 + cos_q_3 * t18);
    let t35 = q_5_dot * t27 + (cos_q_5 * t33 - sin_q_5 * t34);
    let t36 = t32 + q_5_dot;
    let t37 = t36 * t27;
    let t38 = p.c * t37 + (t31 + t35 * p.c);
    let t39 = sin_q_6 * t26 + t36 * cos_q_6;
    let t40 = S::from_ratio(2, 25);
    let t41 = t39 * t40;
    let t42 = q_6_dot + t27;
    let t43 = cos_q_6 * t26 - t36 * sin_q_6;
    let t44 = S::from_ratio(3, 100);
    let t45 = t44 * t39;
    let t46 = q_5_dot * t26 + (sin_q_5 * t33 + cos_q_5 * t34);
    let t47 = cos_q_6 * t35 - sin_q_6 * t29 - q_6_dot * t39;
    let t48 = t41 * t42 - t43 * t45 + (sin_q_6 * t30 + cos_q_6 * t38);
    let t49 = t48 - (t44 * t46 - t40 * t47);
    let t50 = t44 * t42 + t43 * t40;
    let t51 = t43 * q_6_dot + (sin_q_6 * t35 + cos_q_6 * t29);
    let t52 = t39 * t45 + t42 * t50 + (cos_q_6 * t30 - sin_q_6 * t38) - t51 * t40;
    let t53 = p.m6 * (cos_q_6 * t49 - sin_q_6 * t52);
    let t54 = p.k2 * t37 + (t31 + t35 * p.k2);
    let t55 = p.m5 * t54 + (t53 + p.m4 * t31);
    let t56 = p.m6 * (cos_q_6 * t52 + sin_q_6 * t49);
    let t57 = t23 + p.k2 * t28 - t29 * p.k2;
    let t58 = t56 + p.m5 * t57;
    let t59 = cos_q_5 * t12 - t22 * sin_q_5;
    let t60 = t36 * t36 + t26 * t26;
    let t61 = t59 - t60 * p.c - (t39 * t41 + t43 * t50) - t51 * t44;
    let t62 = t61 * p.m6 + p.m5 * (t59 - t60 * p.k2);
    let t63 = t22 * p.m4 + cos_q_5 * t58 - sin_q_5 * t62;
    let t64 = cos_q_4 * t55 - sin_q_4 * t63;
    let t65 = S::from_ratio(1, 100);
    let t66 = t34 * t65;
    let t67 = t10 * t9;
    let t68 = t20 + (t10 * (t14 * p.k1) - t65 * t67) - (t66 - t19 * p.k1);
    let t69 = t42 * t65;
    let t70 = S::from_ratio(1, 1000);
    let t71 = S::from_ratio(1, 50);
    let t72 = t43 * t70 - t39 * t71;
    let t73 = t39 * t69 + t42 * t72 - (t47 * t71 - t51 * t70) - t49 * p.k15;
    let t74 = t43 * t71 - t39 * t70;
    let t75 = t52 * p.k15 + (t47 * t70 - t51 * t71 + (t42 * t74 - t43 * t69));
    let t76 = t61 * p.k14 + t75;
    let t77 = S::from_ratio(1, 500);
    let t78 = p.c * (t53 + t54 * p.k16) + (t37 * t70 + t35 * t77);
    let t79 = t78 - (cos_q_6 * t73 + sin_q_6 * t76);
    let t80 = t24 * t70;
    let t81 = S::from_ratio(3, 1000);
    let t82 = t49 * p.k14 + (t39 * t74 + t43 * t72 - t46 * t65);
    let t83 = t46 * t70 - t82;
    let t84 = sin_q_5 * t83 + (cos_q_5 * t79 + (t32 * t80 + t33 * t81));
    let t85 = p.c * (t56 + t57 * p.k16) + cos_q_6 * t76;
    let t86 = sin_q_6 * t73 + (t29 * t77 - t28 * t70) - t85;
    let t87 = t86 + (t29 * t81 - t25 * t80);
    let t88 = S::from_ratio(9, 100);
    let t89 = t10 * t88 + t14 * t77;
    let t90 = t14 * t65;
    let t91 = t90 + t10 * t77;
    let t92 = t10 * t91 - t14 * t89 - t19 * t88 - sin_q_4 * t87;
    let t93 = t92 - (p.b * (t64 + t68 * p.k17) + cos_q_4 * t84);
    let t94 = t34 * t77;
    let t95 = t94 + cos_q_5 * t83 - sin_q_5 * t79;
    let t96 = t95 + (t66 + (t9 * t89 - t67 * t88)) - t68 * p.k18;
    let t97 = t18 * t44;
    let t98 = t6 + (t97 + t5 * p.k0) - t97;
    let t99 = cos_q_2 * (t18 * t71 - p.k38 * t98) + t96 * (cos_q_2 * cos_q_3);
    let t100 = q_2_dot * p.k0 - t4 * t44;
    let t101 = t64 + (t68 * p.m3 + p.k37 * (t17 * p.k0 + (t4 * t100 - t1 * t44)));
    let t102 = p.k38 * (t2 - (t1 * p.k0 + q_2_dot * t100) - t17 * t44);
    let t103 = t101 * (sin_q_2 * p.a) + sin_q_2 * (t17 * S::from_ratio(6, 25) - t102);
    let t104 = t93 * (sin_q_2 * cos_q_3) + t93 * (cos_q_2 * sin_q_3) + t99;
    let t105 = t96 * (sin_q_2 * sin_q_3) + q_1_dot * p.friction + t103 - t104;
    let t106 = t90 + t9 * p.k1;
    let t107 = t8 - (t11 * p.k1 + t9 * t106);
    let t108 = cos_q_4 * t87 + (t9 * t91 - t9 * (t14 * t88) - t94);
    let t109 = cos_q_4 * t63 + sin_q_4 * t55;
    let t110 = t13 + (t11 * t65 + t14 * t106);
    let t111 = t108 - (p.k18 * t107 + sin_q_4 * t84) - p.b * (t109 + p.k17 * t110);
    let t112 = p.a * sin_q_3;
    let t113 = t112 * (p.m3 * t107 + p.m4 * t12) + t62 * (cos_q_5 * t112);
    let t114 = (t109 + p.m3 * t110) * (p.a * cos_q_3) - q_2_dot * p.friction;
    let t115 = t98 * p.k39 + t5 * S::from_ratio(11, 100) + t114;
    let f_q_1 = u.tau[0] - t105;
    let f_q_2 = t115 - (t111 + t58 * (sin_q_5 * t112) + t113) + u.tau[1];
    let f_q_3 = u.tau[2] - (t111 + q_3_dot * p.friction);
    let f_q_4 = u.tau[3] - (q_4_dot * p.friction - t95);
    let f_q_5 = u.tau[4] - (t86 + q_5_dot * p.friction);
    let f_q_6 = u.tau[5] - (t82 + q_6_dot * p.friction);
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
        let t0 = cos_q_2 * cos_q_3;
        let t1 = sin_q_2 * sin_q_3;
        let t2 = t0 - t1;
        let t3 = cos_q_2 * sin_q_3;
        let t4 = sin_q_2 * cos_q_3;
        let t5 = t3 + t4;
        let t6 = cos_q_4 * cos_q_5;
        let t7 = sin_q_5.mul_add(t2, t5 * t6);
        let t8 = sin_q_4 * t5;
        let t9 = cos_q_6.mul_sub(t7, sin_q_6 * t8);
        let t10 = N::from_ratio(1, 1000);
        let t11 = sin_q_6.mul_add(t7, cos_q_6 * t8);
        let t12 = N::from_ratio(1, 50);
        let t13 = N::from_ratio(3, 100);
        let t14 = sin_q_2 * n(p.a);
        let t15 = t5.mul_add(n(p.b), t14);
        let t16 = sin_q_4 * sin_q_5;
        let t17 = t15 * t16;
        let t18 = t13.neg_mul_add(t11, t17);
        let t19 = cos_q_4 * t15;
        let t20 = t7.mul_add(n(p.c), t19);
        let t21 = sin_q_4 * cos_q_5;
        let t22 = t15 * t21;
        let t23 = t8.mul_add(n(p.c), t22);
        let t24 = N::from_ratio(2, 25);
        let t25 = t11.mul_add(t24, sin_q_6.mul_add(t20, cos_q_6 * t23));
        let t26 = t18.mul_add(n(p.k14), t9.mul_sub(t10, t11 * t12));
        let t27 = t25.neg_mul_add(n(p.k15), t26);
        let t28 = cos_q_4 * sin_q_5;
        let t29 = cos_q_5.mul_sub(t2, t5 * t28);
        let t30 = cos_q_6.mul_sub(t20, sin_q_6 * t23);
        let t31 = t24.mul_add(t9, t13 * t29) + t30;
        let t32 = t31.mul_add(n(p.k15), t9.mul_sub(t12, t11 * t10));
        let t33 = n(p.m6) * sin_q_6.mul_add(t25, cos_q_6 * t31);
        let t34 = t7.mul_add(n(p.k2), t19);
        let t35 = N::from_ratio(1, 500);
        let t36 = n(p.c).mul_add(t34.mul_add(n(p.k16), t33), t7 * t35);
        let t37 = sin_q_6.mul_sub(t27, cos_q_6 * t32) - t36;
        let t38 = N::from_ratio(1, 100);
        let t39 = t31.mul_add(n(p.k14), t29 * t38);
        let t40 = t29.mul_add(t10, t39);
        let t41 = N::from_ratio(3, 1000);
        let t42 = cos_q_4 * t41;
        let t43 = t5.neg_mul_add(t42, cos_q_5.mul_add(t37, sin_q_5 * t40));
        let t44 = n(p.m6) * sin_q_6.mul_sub(t31, cos_q_6 * t25);
        let t45 = t8.mul_add(n(p.k2), t22);
        let t46 = n(p.c).mul_add(t45.mul_sub(n(p.k16), t44), t8 * t35);
        let t47 = sin_q_6.mul_add(t32, cos_q_6 * t27) - t46;
        let t48 = t8.neg_mul_add(t41, t47);
        let t49 = cos_q_4 * n(p.m4);
        let t50 = n(p.m5).mul_add(t34, t15.mul_add(t49, t33));
        let t51 = n(p.m5).neg_mul_add(t45, t44);
        let t52 = t18.mul_add(n(p.m6), t17 * n(p.m5));
        let t53 = sin_q_4 * n(p.m4);
        let t54 = t53.neg_mul_add(t15, cos_q_5.mul_sub(t51, sin_q_5 * t52));
        let t55 = sin_q_4.neg_mul_add(t54, cos_q_4 * t50);
        let t56 = t2 * t38;
        let t57 = t14 + t5.mul_add(n(p.k1), t56);
        let t58 = N::from_ratio(9, 100);
        let t59 = n(p.b).mul_add(t57.mul_add(n(p.k17), t55), t5 * t58);
        let t60 = cos_q_4.mul_add(t43, sin_q_4 * t48) - t59;
        let t61 = t2 * t35;
        let t62 = sin_q_5.mul_sub(t37, cos_q_5 * t40) - t61;
        let t63 = t57.mul_add(n(p.k18), t56) - t62;
        let t64 = t4.mul_add(t60, t3 * t60) + t1.mul_sub(t63, n(p.k23));
        let t65 = t57.mul_add(n(p.m3), sin_q_2.mul_add(n(p.k19), t55));
        let t66 = sin_q_2 * (sin_q_2 * n(p.k21));
        let t67 = cos_q_2.mul_add(cos_q_2 * n(p.k22), t66);
        let t68 = t14.mul_add(t65, t0 * t63) + t67;
        let t69 = N::ONE / (t64 - t68);
        let t70 = cos_q_4.mul_add(t54, sin_q_4 * t50);
        let t71 = n(p.b).mul_add(t70, cos_q_4 * t48);
        let t72 = sin_q_4.mul_add(t43, t61) - t71;
        let t73 = n(p.a) * sin_q_3;
        let t74 = sin_q_5 * t73;
        let t75 = cos_q_5 * t73;
        let t76 = t52.mul_sub(t75, cos_q_2 * n(p.k20));
        let t77 = n(p.a) * cos_q_3;
        let t78 = t77.neg_mul_add(t70, t51.mul_add(t74, t72) + t76);
        let t79 = t69 * t78;
        let t80 = sin_q_6.neg_mul_add(t21, cos_q_4 * cos_q_6);
        let t81 = cos_q_6.mul_add(t21, cos_q_4 * sin_q_6);
        let t82 = t10.mul_add(t80, t12 * t81);
        let t83 = n(p.b) + t77;
        let t84 = t6.mul_sub(t83, t74);
        let t85 = cos_q_4 * n(p.c);
        let t86 = t85 + t84;
        let t87 = n(p.c) * t21;
        let t88 = sin_q_4 * t83;
        let t89 = t87 + t88;
        let t90 = t24.neg_mul_add(t81, t13 * t16);
        let t91 = sin_q_6.mul_add(t86, cos_q_6 * t89) - t90;
        let t92 = n(p.k15).mul_add(t91, t82);
        let t93 = t12.mul_add(t80, t10 * t81);
        let t94 = t24 * t80;
        let t95 = t94 + cos_q_6.mul_sub(t86, sin_q_6 * t89);
        let t96 = t28.mul_add(t83, t75);
        let t97 = t13 * t80;
        let t98 = t96 - t97;
        let t99 = n(p.k14).neg_mul_add(t98, n(p.k15).mul_add(t95, t93));
        let t100 = n(p.m6) * cos_q_6.mul_add(t95, sin_q_6 * t91);
        let t101 = cos_q_4 * n(p.k2);
        let t102 = t84 + t101;
        let t103 = cos_q_4 * t35;
        let t104 = n(p.c).mul_add(n(p.k16).mul_add(t102, t100), t103);
        let t105 = cos_q_6.mul_add(t99, sin_q_6 * t92) + t104;
        let t106 = n(p.m5).mul_add(t102, t100);
        let t107 = n(p.m6).mul_add(t98, n(p.m5) * t96);
        let t108 = n(p.m6) * cos_q_6.mul_sub(t91, sin_q_6 * t95);
        let t109 = t21 * n(p.k2);
        let t110 = t88 + t109;
        let t111 = sin_q_4 * n(p.m5).mul_add(t110, t53.mul_add(t83, t108));
        let t112 = t49.mul_add(t83, cos_q_5.mul_add(t106, sin_q_5 * t107));
        let t113 = cos_q_4.mul_add(t112, t111);
        let t114 = n(p.k1) + t77;
        let t115 = t38 - t73;
        let t116 = n(p.k17).mul_add(t114, t113);
        let t117 = n(p.b).mul_add(t116, n(p.k18) * t115);
        let t118 = t21 * t35;
        let t119 = n(p.c).mul_add(n(p.k16).mul_add(t110, t108), t118);
        let t120 = sin_q_6.mul_sub(t99, cos_q_6 * t92) - t119;
        let t121 = t16 * t38;
        let t122 = n(p.k14).neg_mul_add(t91, t121);
        let t123 = t16 * t10;
        let t124 = t123 + t122;
        let t125 = sin_q_4 * t41;
        let t126 = cos_q_5.mul_sub(t120, sin_q_5 * t124) - t125;
        let t127 = cos_q_4.mul_add(t42 + t105, t58) + t117;
        let t128 = sin_q_4.neg_mul_add(t126, t127);
        let t129 = t77.mul_add(n(p.m3).mul_add(t114, t113), t75 * t107);
        let t130 = t73 * n(p.m3).neg_mul_add(t115, sin_q_3 * n(p.k24));
        let t131 = t74.neg_mul_add(t106, t130) + (t128 + n(p.k25) + t129);
        let t132 = t78.mul_add(t79, t131);
        let t133 = N::ONE / t132;
        let t134 = t69 * t72;
        let t135 = t78.mul_add(t134, t128);
        let t136 = t133 * t135;
        let t137 = n(p.b) * t6;
        let t138 = t85 + t137;
        let t139 = sin_q_4 * n(p.b);
        let t140 = t87 + t139;
        let t141 = t94 + cos_q_6.mul_sub(t138, sin_q_6 * t140);
        let t142 = t90 - sin_q_6.mul_add(t138, cos_q_6 * t140);
        let t143 = n(p.m6) * sin_q_6.mul_add(t141, cos_q_6 * t142);
        let t144 = t109 + t139;
        let t145 = n(p.b).neg_mul_add(t28, t97);
        let t146 = n(p.k14).mul_add(t145, n(p.k15).mul_add(t141, t93));
        let t147 = n(p.k16).mul_sub(t144, t143);
        let t148 = n(p.k15).neg_mul_add(t142, t82);
        let t149 = n(p.c).mul_sub(t147, sin_q_6 * t146);
        let t150 = cos_q_6.mul_add(t148, t118) + t149;
        let t151 = n(p.k14).mul_add(t142, t121);
        let t152 = t123 + t151;
        let t153 = n(p.m6) * sin_q_6.mul_sub(t142, cos_q_6 * t141);
        let t154 = t101 + t137;
        let t155 = sin_q_5 * n(p.m6).neg_mul_add(t145, t28 * n(p.k27));
        let t156 = cos_q_5.mul_sub(n(p.m5).neg_mul_add(t154, t153), t155);
        let t157 = sin_q_4.neg_mul_add(n(p.k26), t143);
        let t158 = sin_q_4 * n(p.m5).neg_mul_add(t144, t157);
        let t159 = cos_q_4.mul_add(cos_q_4.neg_mul_add(n(p.k26), t156), t158);
        let t160 = sin_q_5.mul_add(t152, cos_q_5.mul_add(t150, t125));
        let t161 = n(p.k16).mul_sub(t154, t153);
        let t162 = n(p.c).mul_add(t161, sin_q_6 * t148);
        let t163 = cos_q_6.mul_add(t146, t103) + t162;
        let t164 = sin_q_4.mul_sub(t160, n(p.b) * (t159 - n(p.k28)));
        let t165 = cos_q_4.mul_add(t42 + t163, n(p.k29)) + t164;
        let t166 = t135.neg_mul_add(t136, t72.mul_add(t134, t165));
        let t167 = N::ONE / t166;
        let t168 = t62 * t69;
        let t169 = sin_q_5.mul_add(t120, cos_q_5 * t124);
        let t170 = t78.neg_mul_add(t168, t169);
        let t171 = t133 * t170;
        let t172 = t72.mul_add(t168, sin_q_5.mul_sub(t150, cos_q_5 * t152));
        let t173 = t135.mul_add(t171, t172);
        let t174 = t167 * t173;
        let t175 = cos_q_6 * sin_q_5;
        let t176 = n(p.c).mul_add(t175, t24.mul_add(t175, t13 * cos_q_5));
        let t177 = sin_q_6 * sin_q_5;
        let t178 = n(p.k15).mul_add(t176, t12.mul_sub(t175, t10 * t177));
        let t179 = t177.neg_mul_add(n(p.k30), t10.mul_sub(t175, t12 * t177));
        let t180 = sin_q_6 * n(p.k31);
        let t181 = n(p.m6) * t176;
        let t182 = cos_q_6.mul_add(t181, t180 * t177);
        let t183 = sin_q_5.mul_add(n(p.k32), t182);
        let t184 = sin_q_6.mul_sub(t179, cos_q_6 * t178);
        let t185 = n(p.k14).mul_add(t176, cos_q_5 * t38);
        let t186 = cos_q_5.mul_add(cos_q_5.mul_add(t10, t185), t35);
        let t187 = t184 - n(p.c).mul_add(t183, sin_q_5 * t35);
        let t188 = sin_q_5.neg_mul_add(t187, t186);
        let t189 = t62.mul_add(t168, t188) - t173.mul_add(t174, t170 * t171);
        let t190 = N::ONE / t189;
        let t191 = t47 * t69;
        let t192 = t78.neg_mul_add(t191, t105);
        let t193 = t133 * t192;
        let t194 = t135.neg_mul_add(t193, t72.neg_mul_add(t191, t163));
        let t195 = t167 * t194;
        let t196 = sin_q_6.mul_add(t178, cos_q_6 * t179);
        let t197 = n(p.c).mul_add(sin_q_6.mul_sub(t181, t175 * t180), t196);
        let t198 = t170.mul_add(t193, t197) - t173.mul_add(t195, t62 * t191);
        let t199 = t190 * t198;
        let t200 = sin_q_6.mul_add(t12, cos_q_6 * t10);
        let t201 = sin_q_6.mul_add(t10, cos_q_6 * t12);
        let t202 = cos_q_6.mul_add(cos_q_6.mul_add(n(p.k30), t201), n(p.k35));
        let t203 = sin_q_6.mul_add(sin_q_6.mul_add(n(p.k34), t200), t202);
        let t204 = t47.mul_add(t191, t203) - t194.mul_add(t195, t192 * t193);
        let t205 = t198.neg_mul_add(t199, t204);
        let t206 = N::ONE / t205;
        let t207 = t39 * t69;
        let t208 = t78.mul_add(t207, t122);
        let t209 = t133 * t208;
        let t210 = t135.neg_mul_add(t209, t72.mul_add(t207, t151));
        let t211 = t167 * t210;
        let t212 = t173.mul_add(t211, t185) - t170.mul_add(t209, t62 * t207);
        let t213 = t190 * t212;
        let t214 = t47.mul_add(t207, sin_q_6 * n(p.k33));
        let t215 = t214 + t194.mul_add(t211, t192 * t209);
        let t216 = t198.neg_mul_add(t213, t215);
        let t217 = t206 * t216;
        let t218 = sin_q_2 * q_1_dot;
        let t219 = t218 * t218;
        let t220 = cos_q_2 * n(p.g);
        let t221 = n(p.a).neg_mul_add(q_2_dot.mul_add(q_2_dot, t219), t220);
        let t222 = cos_q_2 * q_1_dot;
        let t223 = t222 * t218;
        let t224 = sin_q_2 * n(p.g);
        let t225 = n(p.a).mul_add(t223, t224);
        let t226 = cos_q_3.mul_sub(t221, sin_q_3 * t225);
        let t227 = sin_q_3.mul_add(t222, cos_q_3 * t218);
        let t228 = q_2_dot + q_3_dot;
        let t229 = t228 * t228;
        let t230 = n(p.b).neg_mul_add(t227.mul_add(t227, t229), t226);
        let t231 = sin_q_3.mul_add(t221, cos_q_3 * t225);
        let t232 = cos_q_3.mul_sub(t222, sin_q_3 * t218);
        let t233 = n(p.b) * t232;
        let t234 = t233.mul_add(t227, t231);
        let t235 = t222 * q_2_dot;
        let t236 = q_2_dot * t218;
        let t237 = cos_q_3.mul_sub(t235, sin_q_3 * t236);
        let t238 = t232.mul_add(q_3_dot, t237);
        let t239 = t235 * n(p.k12);
        let t240 = t233.mul_add(t228, n(p.b).mul_add(t238, t239));
        let t241 = sin_q_4.neg_mul_add(t240, cos_q_4 * t234);
        let t242 = cos_q_5.mul_add(t241, sin_q_5 * t230);
        let t243 = t232 + q_4_dot;
        let t244 = cos_q_4.mul_sub(t227, sin_q_4 * t228);
        let t245 = sin_q_5.mul_add(t243, cos_q_5 * t244);
        let t246 = cos_q_5.mul_sub(t243, sin_q_5 * t244);
        let t247 = t245 * t246;
        let t248 = sin_q_4.mul_add(t238, q_4_dot * t244);
        let t249 = n(p.c).neg_mul_add(t248, n(p.c).mul_add(t247, t242));
        let t250 = cos_q_4.mul_add(t240, sin_q_4 * t234);
        let t251 = sin_q_4.mul_add(t227, cos_q_4 * t228);
        let t252 = cos_q_4.mul_sub(t238, t251 * q_4_dot);
        let t253 = sin_q_3.mul_add(t235, cos_q_3 * t236);
        let t254 = q_3_dot.mul_add(t227, t253);
        let t255 = cos_q_5.mul_sub(t252, sin_q_5 * t254);
        let t256 = q_5_dot.mul_add(t246, t255);
        let t257 = t251 + q_5_dot;
        let t258 = t257 * t246;
        let t259 = n(p.c).mul_add(t258, n(p.c).mul_add(t256, t250));
        let t260 = sin_q_6.mul_add(t245, cos_q_6 * t257);
        let t261 = t24 * t260;
        let t262 = q_6_dot + t246;
        let t263 = cos_q_6.mul_sub(t245, sin_q_6 * t257);
        let t264 = t13 * t260;
        let t265 = sin_q_6.mul_add(t249, cos_q_6 * t259);
        let t266 = sin_q_5.mul_add(t252, cos_q_5 * t254);
        let t267 = q_5_dot.mul_add(t245, t266);
        let t268 = cos_q_6.mul_sub(t256, sin_q_6 * t248);
        let t269 = q_6_dot.neg_mul_add(t260, t268);
        let t270 = t261.mul_sub(t262, t263 * t264) + t265;
        let t271 = t270 - t24.neg_mul_add(t269, t13 * t267);
        let t272 = t13.mul_add(t262, t24 * t263);
        let t273 = cos_q_6.mul_sub(t249, sin_q_6 * t259);
        let t274 = sin_q_6.mul_add(t256, cos_q_6 * t248);
        let t275 = t263.mul_add(q_6_dot, t274);
        let t276 = t262.mul_add(t272, t260 * t264) + t273;
        let t277 = t24.neg_mul_add(t275, t276);
        let t278 = n(p.m6) * cos_q_6.mul_sub(t271, sin_q_6 * t277);
        let t279 = n(p.k2).mul_add(t258, n(p.k2).mul_add(t256, t250));
        let t280 = n(p.m5).mul_add(t279, n(p.m4).mul_add(t250, t278));
        let t281 = n(p.m6) * cos_q_6.mul_add(t277, sin_q_6 * t271);
        let t282 = n(p.k2).neg_mul_add(t248, n(p.k2).mul_add(t247, t242));
        let t283 = n(p.m5).mul_add(t282, t281);
        let t284 = sin_q_5.neg_mul_add(t241, cos_q_5 * t230);
        let t285 = t245.mul_add(t245, t257 * t257);
        let t286 = t263.mul_add(t272, t260 * t261);
        let t287 = n(p.c).neg_mul_add(t285, t284) - t286;
        let t288 = t13.neg_mul_add(t275, t287);
        let t289 = n(p.m5) * n(p.k2).neg_mul_add(t285, t284);
        let t290 = n(p.m6).mul_add(t288, t289);
        let t291 = cos_q_5.mul_add(t283, n(p.m4) * t241);
        let t292 = sin_q_5.neg_mul_add(t290, t291);
        let t293 = sin_q_4.neg_mul_add(t292, cos_q_4 * t280);
        let t294 = t38 * t254;
        let t295 = t228 * t227;
        let t296 = t239 + t228.mul_sub(n(p.k1) * t232, t38 * t295);
        let t297 = t296 - n(p.k1).neg_mul_add(t238, t294);
        let t298 = t38 * t262;
        let t299 = t10.mul_sub(t263, t12 * t260);
        let t300 = t262.mul_add(t299, t260 * t298);
        let t301 = t300 - t12.mul_sub(t269, t10 * t275);
        let t302 = n(p.k15).neg_mul_add(t271, t301);
        let t303 = t12.mul_sub(t263, t10 * t260);
        let t304 = t262.mul_sub(t303, t263 * t298);
        let t305 = t10.mul_sub(t269, t12 * t275) + t304;
        let t306 = n(p.k14).mul_add(t288, n(p.k15).mul_add(t277, t305));
        let t307 = t35.mul_add(t256, t10 * t258);
        let t308 = n(p.c).mul_add(n(p.k16).mul_add(t279, t278), t307);
        let t309 = t308 - sin_q_6.mul_add(t306, cos_q_6 * t302);
        let t310 = t10 * t243;
        let t311 = t38.neg_mul_add(t267, t260.mul_add(t303, t263 * t299));
        let t312 = n(p.k14).mul_add(t271, t311);
        let t313 = t10.mul_sub(t267, t312);
        let t314 = cos_q_5.mul_add(t309, t41.mul_add(t252, t251 * t310));
        let t315 = sin_q_5.mul_add(t313, t314);
        let t316 = n(p.k17).mul_add(t297, t293);
        let t317 = n(p.k16).mul_add(t282, t281);
        let t318 = sin_q_6.mul_add(t302, t10.neg_mul_add(t247, t35 * t248));
        let t319 = t318 - n(p.c).mul_add(t317, cos_q_6 * t306);
        let t320 = t319 + t41.mul_sub(t248, t244 * t310);
        let t321 = t35.mul_add(t232, t58 * t228);
        let t322 = t38 * t232;
        let t323 = t35.mul_add(t228, t322);
        let t324 = t58.neg_mul_add(t238, t228.mul_sub(t323, t232 * t321));
        let t325 = n(p.b).mul_add(t316, cos_q_4 * t315);
        let t326 = sin_q_4.neg_mul_add(t320, t324) - t325;
        let t327 = t35 * t254;
        let t328 = sin_q_5.neg_mul_add(t309, cos_q_5.mul_add(t313, t327));
        let t329 = t328 + (t294 + t227.mul_sub(t321, t58 * t295));
        let t330 = n(p.k18).neg_mul_add(t297, t329);
        let t331 = t13 * t236;
        let t332 = t224 + t223.mul_add(n(p.k0), t331) - t331;
        let t333 = cos_q_2 * n(p.k38).neg_mul_add(t332, t12 * t236);
        let t334 = t13.neg_mul_add(t222, q_2_dot * n(p.k0));
        let t335 = t235.mul_add(n(p.k0), t222.mul_sub(t334, t13 * t219));
        let t336 = t220 - t219.mul_add(n(p.k0), q_2_dot * t334);
        let t337 = t235 * N::from_ratio(6, 25);
        let t338 = n(p.k38).neg_mul_add(t13.neg_mul_add(t235, t336), t337);
        let t339 = t293 + n(p.m3).mul_add(t297, n(p.k37) * t335);
        let t340 = t1.mul_add(t330, q_1_dot * n(p.friction));
        let t341 = t4.mul_add(t326, t3 * t326) + t0.mul_add(t330, t333);
        let t342 = t340 + t14.mul_add(t339, sin_q_2 * t338) - t341;
        let t343 = n(u.tau[0]) - t342;
        let t344 = t227.mul_sub(t323, t227 * (t58 * t232)) - t327;
        let t345 = n(p.k1).mul_add(t227, t322);
        let t346 = t226 - t227.mul_add(t345, n(p.k1) * t229);
        let t347 = sin_q_4.mul_add(t315, n(p.k18) * t346);
        let t348 = cos_q_4.mul_add(t292, sin_q_4 * t280);
        let t349 = t231 + t232.mul_add(t345, t38 * t229);
        let t350 = cos_q_4.mul_add(t320, t344) - t347;
        let t351 = n(p.b).neg_mul_add(n(p.k17).mul_add(t349, t348), t350);
        let t352 = n(u.tau[2]) - q_3_dot.mul_add(n(p.friction), t351);
        let t353 = t73 * n(p.m3).mul_add(t346, n(p.m4) * t230);
        let t354 = n(p.m3).mul_add(t349, t348);
        let t355 = t332.mul_add(n(p.k39), t223 * N::from_ratio(11, 100));
        let t356 = t74.mul_add(t283, t351) + t75.mul_add(t290, t353);
        let t357 = t355 + t77.mul_sub(t354, q_2_dot * n(p.friction)) - t356;
        let t358 = t79.mul_add(t343, t357 + n(u.tau[1]));
        let t359 = t136.neg_mul_add(t358, t134.mul_add(t343, t352));
        let t360 = n(u.tau[3]) - q_4_dot.mul_sub(n(p.friction), t328);
        let t361 = t174.mul_add(t359, t360) - t171.mul_add(t358, t168 * t343);
        let t362 = n(u.tau[4]) - q_5_dot.mul_add(n(p.friction), t319);
        let t363 = t199.mul_add(t361, t362) - t193.mul_add(t358, t191 * t343);
        let t364 = t195.neg_mul_add(t359, t363);
        let t365 = n(u.tau[5]) - q_6_dot.mul_add(n(p.friction), t312);
        let t366 = t207.mul_add(t343, t365) + t217.mul_sub(t364, t209 * t358);
        let t367 = t210.mul_add(t211, t208 * t209);
        let t368 = t39.mul_add(t207, n(p.k36)) - t367;
        let t369 = t368 - t216.mul_add(t217, t212 * t213);
        let q_6_ddot = (t366 - t213.mul_add(t361, t211 * t359)) / t369;
        let q_5_ddot = t217.mul_add(q_6_ddot, t206 * t364);
        let t370 = t199.mul_add(q_5_ddot, t190 * t361);
        let q_4_ddot = t213.neg_mul_add(q_6_ddot, t370);
        let t371 = t195.mul_add(q_5_ddot, t211 * q_6_ddot);
        let q_3_ddot = t174.mul_add(q_4_ddot, t167 * t359) - t371;
        let t372 = t171.mul_add(q_4_ddot, t193 * q_5_ddot);
        let t373 = t136.neg_mul_add(q_3_ddot, t133 * t358) - t372;
        let q_2_ddot = t209.neg_mul_add(q_6_ddot, t373);
        let t374 = t79.neg_mul_add(q_2_ddot, t191 * q_5_ddot);
        let t375 = t168.mul_add(q_4_ddot, t69 * t343) + t374;
        let t376 = t68 - t64;
        checked(t376, t376, 5.329070518200751e-15, 0)?;
        checked(t132, t131, 5.329070518200751e-15, 1)?;
        checked(t166, t165, 5.329070518200751e-15, 2)?;
        checked(t189, t188, 5.329070518200751e-15, 3)?;
        checked(t205, t203, 5.329070518200751e-15, 4)?;
        checked(t369, n(p.k36), 5.329070518200751e-15, 5)?;
        let q_1_ddot = t134.mul_add(q_3_ddot, t207 * q_6_ddot) - t375;
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
    let t43 = (t22 * (t22 * p.k3) + (t19 * t19 + t21 * t21)) * p.m4 + t42;
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
    let t55 = S::from_f64(0.5) * ((t52 * p.k4 + t51 * t51) * p.m2 + t54);
    let t56 = S::from_f64(0.5) * (t35 + (t34 - t27 * (t13 * t33 - t27 * t32))) + t40;
    let t57 = t55 + q_1_dot * (q_1_dot * p.k13) + (S::from_f64(0.5) * t43 + t50);
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
    let t8 = p.k6 * (t4 + t0 * p.k1 - t1 * S::from_ratio(1, 100));
    let t9 = t5 * p.k7 + p.k10 + (t8 + p.k5 * (p.h + cos_q_2 * p.k0));
    p.k9 * t7 + p.k8 * (t5 + t3 * p.k2) + t9
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
    (q_6_dot * q_6_dot + q_5_dot * q_5_dot + t1) * p.k11
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
