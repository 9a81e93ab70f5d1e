// @generated from machines/chain.machine by `cargo xtask generate`; edits are lost.

//! A chain of N uniform bars hanging from a hinge. Angles are absolute, from the downward vertical.
//!
//! 8 coordinates, 4 parameters, 1 output. Arithmetic of one call:
//!
//! | function | mul | add | div | sin cos | other | temporaries |
//! | --- | --: | --: | --: | --: | --: | --: |
//! | `prepare` | 33 | 18 | 1 | 0 | 0 | 52 |
//! | `mass_matrix` | 84 | 28 | 0 | 8 | 0 | 128 |
//! | `bias` | 103 | 60 | 0 | 8 | 0 | 179 |
//! | `applied` | 8 | 0 | 0 | 8 | 0 | 16 |
//! | `forces` | 104 | 68 | 0 | 8 | 0 | 188 |
//! | `accelerations` | 363 | 237 | 7 | 8 | 0 | 623 |
//! | `kinetic_energy` | 88 | 47 | 0 | 8 | 0 | 151 |
//! | `potential_energy` | 16 | 21 | 0 | 8 | 0 | 45 |
//! | `output_end` | 1 | 7 | 0 | 8 | 0 | 16 |
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

/// A chain of N uniform bars hanging from a hinge. Angles are absolute, from the downward vertical.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Chain<S = f64> {
    /// Length, mass and inertia (about its middle) of a bar. Unit: m. Default: 0.2.
    pub l: S,
    /// `m`. Unit: kg. Default: 0.5.
    pub m: S,
    /// `J`. Unit: kg*m^2. Default: 1/600.
    pub J: S,
    /// `g`. Unit: m/s^2. Default: 9.81.
    pub g: S,
}

impl Default for Chain {
    fn default() -> Self {
        Self {
            l: 0.2,
            m: 0.5,
            J: 0.0016666666666666668,
            g: 9.81,
        }
    }
}

impl<S> Chain<S> {
    /// The same over other numbers.
    pub fn map<R>(self, f: impl Fn(S) -> R) -> Chain<R> {
        Chain {
            l: f(self.l),
            m: f(self.m),
            J: f(self.J),
            g: f(self.g),
        }
    }
}

impl<S: ::lagrangian::Scalar> Chain<S> {
    /// Computes what depends on the parameters alone, once.
    pub fn prepare(&self) -> Prepared<S> {
        let t0 = self.l * self.m;
        let t1 = self.g * t0;
        let k2 = S::from_f64(0.5) * t1;
        let t2 = self.l * t0;
        let k11 = self.J + t2 * S::from_f64(7.25);
        let k0 = self.l * S::from_f64(0.5);
        let k1 = self.m * self.g;
        let k3 = S::from_f64(0.125) * (self.J * S::from_f64(4.0) + t2);
        let k4 = S::from_f64(0.5) * t2;
        let k5 = t2 * S::from_f64(1.5);
        let k6 = t2 * S::from_f64(2.5);
        let k7 = t2 * S::from_f64(3.5);
        let k8 = t2 * S::from_f64(4.5);
        let k9 = t2 * S::from_f64(5.5);
        let k10 = t2 * S::from_f64(6.5);
        let k12 = self.J + t2 * S::from_f64(6.25);
        let k13 = self.J + t2 * S::from_f64(5.25);
        let k14 = self.J + t2 * S::from_f64(4.25);
        let k15 = self.J + t2 * S::from_f64(3.25);
        let k16 = self.J + t2 * S::from_f64(2.25);
        let k17 = self.J + t2 * S::from_f64(1.25);
        let k18 = self.J + t2 * S::from_f64(0.25);
        let k19 = self.m * S::from_f64(0.5);
        let k20 = t0 * S::from_f64(0.25);
        let k21 = S::from_f64(0.5) * t0;
        let k22 = -(t1 * S::from_f64(7.5));
        let k23 = -(t1 * S::from_f64(6.5));
        let k24 = -(t1 * S::from_f64(5.5));
        let k25 = -(t1 * S::from_f64(4.5));
        let k26 = -(t1 * S::from_f64(3.5));
        let k27 = -(t1 * S::from_f64(2.5));
        let k28 = -(t1 * S::from_f64(1.5));
        let k29 = -k2;
        let k30 = -self.l;
        let k31 = S::ONE / k11;
        let singular = if vanishes(k11, k11, 7.105427357601002e-15) {
            Some(singular(0, k11, k11))
        } else {
            None
        };
        Prepared {
            l: self.l,
            m: self.m,
            J: self.J,
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
            singular,
        }
    }

    /// The start values of the description, at rest and `t = 0`.
    pub fn start(&self) -> ::lagrangian::State<Coordinates<S>> {
        let q_1 = S::from_ratio(3, 10);
        let q = [q_1, q_1, q_1, q_1, q_1, q_1, q_1, q_1];
        let v = [S::ZERO; 8];
        ::lagrangian::State {
            t: 0.0,
            q: Coordinates::from_array(q),
            v: Coordinates::from_array(v),
        }
    }
}

/// The coordinates of [`Chain`], or their rates, by name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coordinates<S = f64> {
    /// `q`. Unit: rad. Members: `q[1]` to `q[8]`.
    pub q: [S; 8],
}

impl<S: Copy> Coordinates<S> {
    /// The numbers in the order of the description: the order of `q` in every function here.
    pub fn to_array(self) -> [S; 8] {
        [
            self.q[0], self.q[1], self.q[2], self.q[3], self.q[4], self.q[5], self.q[6], self.q[7],
        ]
    }

    /// Names for numbers in the order of the description.
    pub fn from_array(q: [S; 8]) -> Self {
        Self {
            q: [q[0], q[1], q[2], q[3], q[4], q[5], q[6], q[7]],
        }
    }

    /// The same over other numbers.
    pub fn map<R>(self, f: impl Fn(S) -> R) -> Coordinates<R> {
        Coordinates { q: self.q.map(&f) }
    }
}

/// What can be set while a [`Chain`] runs.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Inputs {}

/// What can be observed of a [`Chain`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outputs<S = f64> {
    /// Height of the chain's end above the hinge. Unit: m.
    pub end: S,
}

/// The parameters of a [`Chain`], with the work done that depends on them alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prepared<S = f64> {
    /// `l`
    l: S,
    /// `m`
    m: S,
    /// `J`
    J: S,
    /// `g`
    g: S,
    /// `0.5*l`
    k0: S,
    /// `m*g`
    k1: S,
    /// `0.5*l*m*g`
    k2: S,
    /// `0.125*(l^2*m + 4*J)`
    k3: S,
    /// `0.5*l^2*m`
    k4: S,
    /// `1.5*l^2*m`
    k5: S,
    /// `2.5*l^2*m`
    k6: S,
    /// `3.5*l^2*m`
    k7: S,
    /// `4.5*l^2*m`
    k8: S,
    /// `5.5*l^2*m`
    k9: S,
    /// `6.5*l^2*m`
    k10: S,
    /// `J + 7.25*l^2*m`
    k11: S,
    /// `J + 6.25*l^2*m`
    k12: S,
    /// `J + 5.25*l^2*m`
    k13: S,
    /// `J + 4.25*l^2*m`
    k14: S,
    /// `J + 3.25*l^2*m`
    k15: S,
    /// `J + 2.25*l^2*m`
    k16: S,
    /// `J + 1.25*l^2*m`
    k17: S,
    /// `J + 0.25*l^2*m`
    k18: S,
    /// `0.5*m`
    k19: S,
    /// `0.25*l*m`
    k20: S,
    /// `0.5*l*m`
    k21: S,
    /// `-7.5*l*m*g`
    k22: S,
    /// `-6.5*l*m*g`
    k23: S,
    /// `-5.5*l*m*g`
    k24: S,
    /// `-4.5*l*m*g`
    k25: S,
    /// `-3.5*l*m*g`
    k26: S,
    /// `-2.5*l*m*g`
    k27: S,
    /// `-1.5*l*m*g`
    k28: S,
    /// `-0.5*l*m*g`
    k29: S,
    /// `-l`
    k30: S,
    /// `1/(J + 7.25*l^2*m)`
    k31: S,
    /// Why these parameters leave the machine without accelerations, if they do.
    singular: Option<::lagrangian::Singular>,
}

/// Mass matrix `M`, row by row.
///
/// ```text
/// M[q[1], q[1]] = 29/4*l^2*m + J
/// M[q[2], q[1]] = 13/2*l^2*m*cos(q[2] - q[1])
/// M[q[2], q[2]] = 25/4*l^2*m + J
/// M[q[3], q[1]] = 11/2*l^2*m*cos(q[3] - q[1])
/// M[q[3], q[2]] = 11/2*l^2*m*cos(q[3] - q[2])
/// M[q[3], q[3]] = 21/4*l^2*m + J
/// M[q[4], q[1]] = 9/2*l^2*m*cos(q[4] - q[1])
/// M[q[4], q[2]] = 9/2*l^2*m*cos(q[4] - q[2])
/// M[q[4], q[3]] = 9/2*l^2*m*cos(q[4] - q[3])
/// M[q[4], q[4]] = 17/4*l^2*m + J
/// M[q[5], q[1]] = 7/2*l^2*m*cos(q[5] - q[1])
/// M[q[5], q[2]] = 7/2*l^2*m*cos(q[5] - q[2])
/// M[q[5], q[3]] = 7/2*l^2*m*cos(q[5] - q[3])
/// M[q[5], q[4]] = 7/2*l^2*m*cos(q[5] - q[4])
/// M[q[5], q[5]] = 13/4*l^2*m + J
/// M[q[6], q[1]] = 5/2*l^2*m*cos(q[6] - q[1])
/// M[q[6], q[2]] = 5/2*l^2*m*cos(q[6] - q[2])
/// M[q[6], q[3]] = 5/2*l^2*m*cos(q[6] - q[3])
/// M[q[6], q[4]] = 5/2*l^2*m*cos(q[6] - q[4])
/// M[q[6], q[5]] = 5/2*l^2*m*cos(q[6] - q[5])
/// M[q[6], q[6]] = 9/4*l^2*m + J
/// M[q[7], q[1]] = 3/2*l^2*m*cos(q[7] - q[1])
/// M[q[7], q[2]] = 3/2*l^2*m*cos(q[7] - q[2])
/// M[q[7], q[3]] = 3/2*l^2*m*cos(q[7] - q[3])
/// M[q[7], q[4]] = 3/2*l^2*m*cos(q[7] - q[4])
/// M[q[7], q[5]] = 3/2*l^2*m*cos(q[7] - q[5])
/// M[q[7], q[6]] = 3/2*l^2*m*cos(q[7] - q[6])
/// M[q[7], q[7]] = 5/4*l^2*m + J
/// M[q[8], q[1]] = 1/2*l^2*m*cos(q[8] - q[1])
/// M[q[8], q[2]] = 1/2*l^2*m*cos(q[8] - q[2])
/// M[q[8], q[3]] = 1/2*l^2*m*cos(q[8] - q[3])
/// M[q[8], q[4]] = 1/2*l^2*m*cos(q[8] - q[4])
/// M[q[8], q[5]] = 1/2*l^2*m*cos(q[8] - q[5])
/// M[q[8], q[6]] = 1/2*l^2*m*cos(q[8] - q[6])
/// M[q[8], q[7]] = 1/2*l^2*m*cos(q[8] - q[7])
/// M[q[8], q[8]] = 1/4*l^2*m + J
/// ```
pub fn mass_matrix<S: ::lagrangian::Scalar>(p: &Prepared<S>, q: &[S; 8]) -> [[S; 8]; 8] {
    let q_1 = q[0];
    let q_2 = q[1];
    let q_3 = q[2];
    let q_4 = q[3];
    let q_5 = q[4];
    let q_6 = q[5];
    let q_7 = q[6];
    let q_8 = q[7];
    let (sin_q_2, cos_q_2) = q_2.sin_cos();
    let (sin_q_1, cos_q_1) = q_1.sin_cos();
    let (sin_q_3, cos_q_3) = q_3.sin_cos();
    let (sin_q_4, cos_q_4) = q_4.sin_cos();
    let (sin_q_5, cos_q_5) = q_5.sin_cos();
    let (sin_q_6, cos_q_6) = q_6.sin_cos();
    let (sin_q_7, cos_q_7) = q_7.sin_cos();
    let (sin_q_8, cos_q_8) = q_8.sin_cos();
    let m21 = (cos_q_2 * cos_q_1 + sin_q_2 * sin_q_1) * p.k10;
    let m31 = p.k9 * (cos_q_1 * cos_q_3 + sin_q_1 * sin_q_3);
    let m32 = p.k9 * (cos_q_2 * cos_q_3 + sin_q_2 * sin_q_3);
    let m41 = p.k8 * (cos_q_1 * cos_q_4 + sin_q_1 * sin_q_4);
    let m42 = p.k8 * (cos_q_2 * cos_q_4 + sin_q_2 * sin_q_4);
    let m43 = p.k8 * (cos_q_3 * cos_q_4 + sin_q_3 * sin_q_4);
    let m51 = p.k7 * (cos_q_1 * cos_q_5 + sin_q_1 * sin_q_5);
    let m52 = p.k7 * (cos_q_2 * cos_q_5 + sin_q_2 * sin_q_5);
    let m53 = p.k7 * (cos_q_3 * cos_q_5 + sin_q_3 * sin_q_5);
    let m54 = p.k7 * (cos_q_4 * cos_q_5 + sin_q_4 * sin_q_5);
    let m61 = p.k6 * (cos_q_1 * cos_q_6 + sin_q_1 * sin_q_6);
    let m62 = p.k6 * (cos_q_2 * cos_q_6 + sin_q_2 * sin_q_6);
    let m63 = p.k6 * (cos_q_3 * cos_q_6 + sin_q_3 * sin_q_6);
    let m64 = p.k6 * (cos_q_4 * cos_q_6 + sin_q_4 * sin_q_6);
    let m65 = p.k6 * (cos_q_5 * cos_q_6 + sin_q_5 * sin_q_6);
    let m71 = p.k5 * (cos_q_1 * cos_q_7 + sin_q_1 * sin_q_7);
    let m72 = p.k5 * (cos_q_2 * cos_q_7 + sin_q_2 * sin_q_7);
    let m73 = p.k5 * (cos_q_3 * cos_q_7 + sin_q_3 * sin_q_7);
    let m74 = p.k5 * (cos_q_4 * cos_q_7 + sin_q_4 * sin_q_7);
    let m75 = p.k5 * (cos_q_5 * cos_q_7 + sin_q_5 * sin_q_7);
    let m76 = p.k5 * (cos_q_6 * cos_q_7 + sin_q_6 * sin_q_7);
    let m81 = p.k4 * (cos_q_1 * cos_q_8 + sin_q_1 * sin_q_8);
    let m82 = p.k4 * (cos_q_2 * cos_q_8 + sin_q_2 * sin_q_8);
    let m83 = p.k4 * (cos_q_3 * cos_q_8 + sin_q_3 * sin_q_8);
    let m84 = p.k4 * (cos_q_4 * cos_q_8 + sin_q_4 * sin_q_8);
    let m85 = p.k4 * (cos_q_5 * cos_q_8 + sin_q_5 * sin_q_8);
    let m86 = p.k4 * (cos_q_6 * cos_q_8 + sin_q_6 * sin_q_8);
    let m87 = p.k4 * (cos_q_7 * cos_q_8 + sin_q_7 * sin_q_8);
    [
        [p.k11, m21, m31, m41, m51, m61, m71, m81],
        [m21, p.k12, m32, m42, m52, m62, m72, m82],
        [m31, m32, p.k13, m43, m53, m63, m73, m83],
        [m41, m42, m43, p.k14, m54, m64, m74, m84],
        [m51, m52, m53, m54, p.k15, m65, m75, m85],
        [m61, m62, m63, m64, m65, p.k16, m76, m86],
        [m71, m72, m73, m74, m75, m76, p.k17, m87],
        [m81, m82, m83, m84, m85, m86, m87, p.k18],
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
/// h[q[7]] = …
/// h[q[8]] = 1/2*l^2*m*sin(q[8] - q[1])*der(q[1])^2 + 1/2*l^2*m*sin(q[8] - q[2])*der(q[2])^2
///     + 1/2*l^2*m*sin(q[8] - q[3])*der(q[3])^2 + 1/2*l^2*m*sin(q[8] - q[4])*der(q[4])^2
///     + 1/2*l^2*m*sin(q[8] - q[5])*der(q[5])^2 + 1/2*l^2*m*sin(q[8] - q[6])*der(q[6])^2
///     + 1/2*l^2*m*sin(q[8] - q[7])*der(q[7])^2
/// ```
pub fn bias<S: ::lagrangian::Scalar>(p: &Prepared<S>, q: &[S; 8], v: &[S; 8]) -> [S; 8] {
    let q_1 = q[0];
    let q_2 = q[1];
    let q_3 = q[2];
    let q_4 = q[3];
    let q_5 = q[4];
    let q_6 = q[5];
    let q_7 = q[6];
    let q_8 = q[7];
    let q_1_dot = v[0];
    let q_2_dot = v[1];
    let q_3_dot = v[2];
    let q_4_dot = v[3];
    let q_5_dot = v[4];
    let q_6_dot = v[5];
    let q_7_dot = v[6];
    let q_8_dot = v[7];
    let t0 = q_2_dot * q_2_dot;
    let (sin_q_2, cos_q_2) = q_2.sin_cos();
    let t1 = t0 * cos_q_2;
    let t2 = q_1_dot * q_1_dot;
    let (sin_q_1, cos_q_1) = q_1.sin_cos();
    let t3 = cos_q_1 * t2;
    let t4 = t1 + t3;
    let t5 = q_3_dot * q_3_dot;
    let (sin_q_3, cos_q_3) = q_3.sin_cos();
    let t6 = t5 * cos_q_3;
    let t7 = t6 + t4;
    let t8 = q_4_dot * q_4_dot;
    let (sin_q_4, cos_q_4) = q_4.sin_cos();
    let t9 = t8 * cos_q_4;
    let t10 = t9 + t7;
    let t11 = q_5_dot * q_5_dot;
    let (sin_q_5, cos_q_5) = q_5.sin_cos();
    let t12 = t11 * cos_q_5;
    let t13 = t12 + t10;
    let t14 = q_6_dot * q_6_dot;
    let (sin_q_6, cos_q_6) = q_6.sin_cos();
    let t15 = t14 * cos_q_6;
    let t16 = t15 + t13;
    let t17 = q_7_dot * q_7_dot;
    let (sin_q_7, cos_q_7) = q_7.sin_cos();
    let t18 = t17 * cos_q_7;
    let t19 = q_8_dot * (q_8_dot * p.k0);
    let (sin_q_8, cos_q_8) = q_8.sin_cos();
    let t20 = t19 * cos_q_8 + p.l * (t18 + t16);
    let t21 = p.k0 * t18 + p.l * t16;
    let t22 = t20 + t21;
    let t23 = p.k0 * t15 + p.l * t13;
    let t24 = t22 + t23;
    let t25 = p.k0 * t12 + p.l * t10;
    let t26 = t24 + t25;
    let t27 = p.k0 * t9 + p.l * t7;
    let t28 = t26 + t27;
    let t29 = p.k0 * t6 + p.l * t4;
    let t30 = p.m * (t28 + t29);
    let t31 = p.k0 * t1 + p.l * t3;
    let t32 = t0 * sin_q_2;
    let t33 = sin_q_1 * t2;
    let t34 = t32 + t33;
    let t35 = t5 * sin_q_3;
    let t36 = t35 + t34;
    let t37 = t8 * sin_q_4;
    let t38 = t37 + t36;
    let t39 = t11 * sin_q_5;
    let t40 = t39 + t38;
    let t41 = t14 * sin_q_6;
    let t42 = t41 + t40;
    let t43 = t17 * sin_q_7;
    let t44 = t19 * sin_q_8 + p.l * (t43 + t42);
    let t45 = p.k0 * t43 + p.l * t42;
    let t46 = t44 + t45;
    let t47 = p.k0 * t41 + p.l * t40;
    let t48 = t46 + t47;
    let t49 = p.k0 * t39 + p.l * t38;
    let t50 = t48 + t49;
    let t51 = p.k0 * t37 + p.l * t36;
    let t52 = t50 + t51;
    let t53 = p.k0 * t35 + p.l * t34;
    let t54 = p.m * (t52 + t53);
    let t55 = p.k0 * t32 + p.l * t33;
    let t56 = cos_q_1 * (t54 + (p.m * t55 + t33 * p.k20));
    let t57 = cos_q_3 * (p.m * t52 + t53 * p.k19);
    let t58 = cos_q_4 * (p.m * t50 + t51 * p.k19);
    let t59 = cos_q_5 * (p.m * t48 + t49 * p.k19);
    let t60 = cos_q_6 * (p.m * t46 + t47 * p.k19);
    let t61 = cos_q_7 * (p.m * t44 + t45 * p.k19);
    let h_q_1 = p.l * (sin_q_1 * (t30 + (p.m * t31 + p.k20 * t3)) - t56);
    let h_q_2 = p.l * (sin_q_2 * (t30 + t31 * p.k19) - cos_q_2 * (t54 + t55 * p.k19));
    let h_q_3 = p.l * (sin_q_3 * (p.m * t28 + t29 * p.k19) - t57);
    let h_q_4 = p.l * (sin_q_4 * (p.m * t26 + t27 * p.k19) - t58);
    let h_q_5 = p.l * (sin_q_5 * (p.m * t24 + t25 * p.k19) - t59);
    let h_q_6 = p.l * (sin_q_6 * (p.m * t22 + t23 * p.k19) - t60);
    let h_q_7 = p.l * (sin_q_7 * (p.m * t20 + t21 * p.k19) - t61);
    let h_q_8 = (sin_q_8 * t20 - cos_q_8 * t44) * p.k21;
    [h_q_1, h_q_2, h_q_3, h_q_4, h_q_5, h_q_6, h_q_7, h_q_8]
}

/// Applied generalized forces `Q`.
///
/// ```text
/// Q[q[1]] = -15/2*l*m*g*sin(q[1])
/// Q[q[2]] = -13/2*l*m*g*sin(q[2])
/// Q[q[3]] = -11/2*l*m*g*sin(q[3])
/// Q[q[4]] = -9/2*l*m*g*sin(q[4])
/// Q[q[5]] = -7/2*l*m*g*sin(q[5])
/// Q[q[6]] = -5/2*l*m*g*sin(q[6])
/// Q[q[7]] = -3/2*l*m*g*sin(q[7])
/// Q[q[8]] = -1/2*l*m*g*sin(q[8])
/// ```
pub fn applied<S: ::lagrangian::Scalar>(p: &Prepared<S>, q: &[S; 8]) -> [S; 8] {
    let q_1 = q[0];
    let q_2 = q[1];
    let q_3 = q[2];
    let q_4 = q[3];
    let q_5 = q[4];
    let q_6 = q[5];
    let q_7 = q[6];
    let q_8 = q[7];
    let sin_q_1 = q_1.sin();
    let sin_q_2 = q_2.sin();
    let sin_q_3 = q_3.sin();
    let sin_q_4 = q_4.sin();
    let sin_q_5 = q_5.sin();
    let sin_q_6 = q_6.sin();
    let sin_q_7 = q_7.sin();
    let sin_q_8 = q_8.sin();
    let q_q_1 = p.k22 * sin_q_1;
    let q_q_2 = p.k23 * sin_q_2;
    let q_q_3 = p.k24 * sin_q_3;
    let q_q_4 = p.k25 * sin_q_4;
    let q_q_5 = p.k26 * sin_q_5;
    let q_q_6 = p.k27 * sin_q_6;
    let q_q_7 = p.k28 * sin_q_7;
    let q_q_8 = p.k29 * sin_q_8;
    [q_q_1, q_q_2, q_q_3, q_q_4, q_q_5, q_q_6, q_q_7, q_q_8]
}

/// Right-hand side `f = Q - h` of `M a = f`.
pub fn forces<S: ::lagrangian::Scalar>(p: &Prepared<S>, q: &[S; 8], v: &[S; 8]) -> [S; 8] {
    let q_1 = q[0];
    let q_2 = q[1];
    let q_3 = q[2];
    let q_4 = q[3];
    let q_5 = q[4];
    let q_6 = q[5];
    let q_7 = q[6];
    let q_8 = q[7];
    let q_1_dot = v[0];
    let q_2_dot = v[1];
    let q_3_dot = v[2];
    let q_4_dot = v[3];
    let q_5_dot = v[4];
    let q_6_dot = v[5];
    let q_7_dot = v[6];
    let q_8_dot = v[7];
    let t0 = q_2_dot * q_2_dot;
    let (sin_q_2, cos_q_2) = q_2.sin_cos();
    let t1 = t0 * sin_q_2;
    let t2 = q_1_dot * q_1_dot;
    let (sin_q_1, cos_q_1) = q_1.sin_cos();
    let t3 = sin_q_1 * t2;
    let t4 = t1 + t3;
    let t5 = q_3_dot * q_3_dot;
    let (sin_q_3, cos_q_3) = q_3.sin_cos();
    let t6 = t5 * sin_q_3;
    let t7 = t6 + t4;
    let t8 = q_4_dot * q_4_dot;
    let (sin_q_4, cos_q_4) = q_4.sin_cos();
    let t9 = t8 * sin_q_4;
    let t10 = t9 + t7;
    let t11 = q_5_dot * q_5_dot;
    let (sin_q_5, cos_q_5) = q_5.sin_cos();
    let t12 = t11 * sin_q_5;
    let t13 = t12 + t10;
    let t14 = q_6_dot * q_6_dot;
    let (sin_q_6, cos_q_6) = q_6.sin_cos();
    let t15 = t14 * sin_q_6;
    let t16 = t15 + t13;
    let t17 = q_7_dot * q_7_dot;
    let (sin_q_7, cos_q_7) = q_7.sin_cos();
    let t18 = t17 * sin_q_7;
    let t19 = q_8_dot * (q_8_dot * p.k0);
    let (sin_q_8, cos_q_8) = q_8.sin_cos();
    let t20 = t19 * sin_q_8 + p.l * (t18 + t16);
    let t21 = p.k0 * t18 + p.l * t16;
    let t22 = t20 + t21;
    let t23 = p.k0 * t15 + p.l * t13;
    let t24 = t22 + t23;
    let t25 = p.k0 * t12 + p.l * t10;
    let t26 = t24 + t25;
    let t27 = p.k0 * t9 + p.l * t7;
    let t28 = t26 + t27;
    let t29 = p.k0 * t6 + p.l * t4;
    let t30 = p.m * (t28 + t29);
    let t31 = p.k0 * t1 + p.l * t3;
    let t32 = t0 * cos_q_2;
    let t33 = cos_q_1 * t2;
    let t34 = t32 + t33;
    let t35 = t5 * cos_q_3;
    let t36 = t35 + t34;
    let t37 = t8 * cos_q_4;
    let t38 = t37 + t36;
    let t39 = t11 * cos_q_5;
    let t40 = t39 + t38;
    let t41 = t14 * cos_q_6;
    let t42 = t41 + t40;
    let t43 = t17 * cos_q_7;
    let t44 = p.g + (t19 * cos_q_8 + p.l * (t43 + t42));
    let t45 = p.g + (p.k0 * t43 + p.l * t42);
    let t46 = t44 + t45;
    let t47 = p.g + (p.k0 * t41 + p.l * t40);
    let t48 = t46 + t47;
    let t49 = p.g + (p.k0 * t39 + p.l * t38);
    let t50 = t48 + t49;
    let t51 = p.g + (p.k0 * t37 + p.l * t36);
    let t52 = t50 + t51;
    let t53 = p.g + (p.k0 * t35 + p.l * t34);
    let t54 = p.m * (t52 + t53);
    let t55 = p.g + (p.k0 * t32 + p.l * t33);
    let t56 = sin_q_1 * (t54 + (p.m * t55 + p.k19 * (p.g + p.k0 * t33)));
    let t57 = sin_q_3 * (p.m * t52 + t53 * p.k19);
    let t58 = sin_q_4 * (p.m * t50 + t51 * p.k19);
    let t59 = sin_q_5 * (p.m * t48 + t49 * p.k19);
    let t60 = sin_q_6 * (p.m * t46 + t47 * p.k19);
    let t61 = sin_q_7 * (p.m * t44 + t45 * p.k19);
    let f_q_1 = p.l * (cos_q_1 * (t30 + (p.m * t31 + t3 * p.k20)) - t56);
    let f_q_2 = p.l * (cos_q_2 * (t30 + p.k19 * t31) - sin_q_2 * (t54 + t55 * p.k19));
    let f_q_3 = p.l * (cos_q_3 * (p.m * t28 + p.k19 * t29) - t57);
    let f_q_4 = p.l * (cos_q_4 * (p.m * t26 + p.k19 * t27) - t58);
    let f_q_5 = p.l * (cos_q_5 * (p.m * t24 + p.k19 * t25) - t59);
    let f_q_6 = p.l * (cos_q_6 * (p.m * t22 + p.k19 * t23) - t60);
    let f_q_7 = p.l * (cos_q_7 * (p.m * t20 + p.k19 * t21) - t61);
    let f_q_8 = (cos_q_8 * t20 - sin_q_8 * t44) * p.k21;
    [f_q_1, f_q_2, f_q_3, f_q_4, f_q_5, f_q_6, f_q_7, f_q_8]
}

/// Accelerations `a`, the solution of `M a = f` from the mass matrix.
///
/// What is known to be zero is not computed; a pivot that vanishes is an error.
pub fn accelerations<S: ::lagrangian::Number>(
    p: &Prepared<S>,
    q: &[S; 8],
    v: &[S; 8],
) -> Result<[S; 8], ::lagrangian::Singular> {
    S::run(Accelerations { p, q, v })
}

/// A call of [`accelerations`], to be run with whatever instructions the processor has.
pub struct Accelerations<'a, S> {
    /// As `accelerations` takes it.
    pub p: &'a Prepared<S>,
    /// As `accelerations` takes it.
    pub q: &'a [S; 8],
    /// As `accelerations` takes it.
    pub v: &'a [S; 8],
}

impl<S: Copy> ::lagrangian::scalar::Kernel<S> for Accelerations<'_, S> {
    type Output = Result<[S; 8], ::lagrangian::Singular>;

    #[inline(always)]
    fn run<N: ::lagrangian::Scalar<Stored = S>>(self) -> Self::Output {
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
        let q_6 = n(q[5]);
        let q_7 = n(q[6]);
        let q_8 = n(q[7]);
        let q_1_dot = n(v[0]);
        let q_2_dot = n(v[1]);
        let q_3_dot = n(v[2]);
        let q_4_dot = n(v[3]);
        let q_5_dot = n(v[4]);
        let q_6_dot = n(v[5]);
        let q_7_dot = n(v[6]);
        let q_8_dot = n(v[7]);
        let angles = [q_2, q_1, q_3, q_4, q_5, q_6, q_7, q_8];
        let circular = N::sin_cos_all(angles);
        let (sin_q_2, cos_q_2) = circular[0];
        let (sin_q_1, cos_q_1) = circular[1];
        let (sin_q_3, cos_q_3) = circular[2];
        let (sin_q_4, cos_q_4) = circular[3];
        let (sin_q_5, cos_q_5) = circular[4];
        let (sin_q_6, cos_q_6) = circular[5];
        let (sin_q_7, cos_q_7) = circular[6];
        let (sin_q_8, cos_q_8) = circular[7];
        let t0 = q_2_dot * q_2_dot;
        let t1 = t0 * sin_q_2;
        let t2 = q_1_dot * q_1_dot;
        let t3 = sin_q_1 * t2;
        let t4 = t1 + t3;
        let t5 = q_3_dot * q_3_dot;
        let t6 = t5 * sin_q_3;
        let t7 = t6 + t4;
        let t8 = q_4_dot * q_4_dot;
        let t9 = t8 * sin_q_4;
        let t10 = t9 + t7;
        let t11 = q_5_dot * q_5_dot;
        let t12 = t11 * sin_q_5;
        let t13 = t12 + t10;
        let t14 = q_6_dot * q_6_dot;
        let t15 = t14 * sin_q_6;
        let t16 = t15 + t13;
        let t17 = q_7_dot * q_7_dot;
        let t18 = t17 * sin_q_7;
        let t19 = q_8_dot * (q_8_dot * n(p.k0));
        let t20 = n(p.l).mul_add(t18 + t16, t19 * sin_q_8);
        let t21 = n(p.l).mul_add(t16, n(p.k0) * t18);
        let t22 = t0 * cos_q_2;
        let t23 = cos_q_1 * t2;
        let t24 = t22 + t23;
        let t25 = t5 * cos_q_3;
        let t26 = t25 + t24;
        let t27 = t8 * cos_q_4;
        let t28 = t27 + t26;
        let t29 = t11 * cos_q_5;
        let t30 = t29 + t28;
        let t31 = t14 * cos_q_6;
        let t32 = t31 + t30;
        let t33 = t17 * cos_q_7;
        let t34 = n(p.g) + n(p.l).mul_add(t33 + t32, t19 * cos_q_8);
        let t35 = n(p.g) + n(p.l).mul_add(t32, n(p.k0) * t33);
        let t36 = cos_q_7 * n(p.m).mul_add(t20, n(p.k19) * t21);
        let t37 = n(p.m).mul_add(t34, t35 * n(p.k19));
        let t38 = t20 + t21;
        let t39 = n(p.l).mul_add(t13, n(p.k0) * t15);
        let t40 = t38 + t39;
        let t41 = n(p.l).mul_add(t10, n(p.k0) * t12);
        let t42 = t40 + t41;
        let t43 = n(p.l).mul_add(t7, n(p.k0) * t9);
        let t44 = t42 + t43;
        let t45 = n(p.l).mul_add(t4, n(p.k0) * t6);
        let t46 = n(p.m) * (t44 + t45);
        let t47 = n(p.k0).mul_add(t1, n(p.l) * t3);
        let t48 = t34 + t35;
        let t49 = n(p.g) + n(p.l).mul_add(t30, n(p.k0) * t31);
        let t50 = t48 + t49;
        let t51 = n(p.g) + n(p.l).mul_add(t28, n(p.k0) * t29);
        let t52 = t50 + t51;
        let t53 = n(p.g) + n(p.l).mul_add(t26, n(p.k0) * t27);
        let t54 = t52 + t53;
        let t55 = n(p.g) + n(p.l).mul_add(t24, n(p.k0) * t25);
        let t56 = n(p.m) * (t54 + t55);
        let t57 = n(p.g) + n(p.k0).mul_add(t22, n(p.l) * t23);
        let t58 = n(p.k19) * n(p.k0).mul_add(t23, n(p.g));
        let t59 = cos_q_1 * (t46 + n(p.m).mul_add(t47, t3 * n(p.k20)));
        let t60 = sin_q_1.neg_mul_add(t56 + n(p.m).mul_add(t57, t58), t59);
        let t61 = n(p.l) * t60;
        let t62 = n(p.k5) * cos_q_1.mul_add(cos_q_7, sin_q_1 * sin_q_7);
        let t63 = n(p.k31) * t62;
        let t64 = n(p.l) * sin_q_7.neg_mul_add(t37, t36);
        let t65 = cos_q_2 * n(p.k19).mul_add(t47, t46);
        let t66 = sin_q_2.neg_mul_add(t57.mul_add(n(p.k19), t56), t65);
        let t67 = cos_q_1.mul_add(cos_q_2, sin_q_1 * sin_q_2) * n(p.k10);
        let t68 = n(p.k31) * t67;
        let t69 = t61.neg_mul_add(t68, n(p.l) * t66);
        let t70 = t67.neg_mul_add(t68, n(p.k12));
        check(t70, n(p.k12), 7.105427357601002e-15, 1)?;
        let t71 = N::ONE / t70;
        let t72 = n(p.k5) * cos_q_7.mul_add(cos_q_2, sin_q_7 * sin_q_2);
        let t73 = t67.neg_mul_add(t63, t72);
        let t74 = t71 * t73;
        let t75 = cos_q_3 * n(p.m).mul_add(t44, n(p.k19) * t45);
        let t76 = n(p.m).mul_add(t54, t55 * n(p.k19));
        let t77 = n(p.k9) * cos_q_1.mul_add(cos_q_3, sin_q_1 * sin_q_3);
        let t78 = n(p.k31) * t77;
        let t79 = n(p.l) * sin_q_3.neg_mul_add(t76, t75);
        let t80 = n(p.k9) * cos_q_3.mul_add(cos_q_2, sin_q_3 * sin_q_2);
        let t81 = t67.neg_mul_add(t78, t80);
        let t82 = t71 * t81;
        let t83 = t82.neg_mul_add(t69, t61.neg_mul_add(t78, t79));
        let t84 = t81.neg_mul_add(t82, t77.neg_mul_add(t78, n(p.k13)));
        check(t84, n(p.k13), 7.105427357601002e-15, 2)?;
        let t85 = N::ONE / t84;
        let t86 = n(p.k5) * cos_q_7.mul_add(cos_q_3, sin_q_7 * sin_q_3);
        let t87 = t81.neg_mul_add(t74, t77.neg_mul_add(t63, t86));
        let t88 = t85 * t87;
        let t89 = t74.neg_mul_add(t69, t61.neg_mul_add(t63, t64));
        let t90 = cos_q_4 * n(p.m).mul_add(t42, n(p.k19) * t43);
        let t91 = n(p.m).mul_add(t52, t53 * n(p.k19));
        let t92 = n(p.k8) * cos_q_1.mul_add(cos_q_4, sin_q_1 * sin_q_4);
        let t93 = n(p.k31) * t92;
        let t94 = n(p.l) * sin_q_4.neg_mul_add(t91, t90);
        let t95 = n(p.k8) * cos_q_4.mul_add(cos_q_2, sin_q_4 * sin_q_2);
        let t96 = t67.neg_mul_add(t93, t95);
        let t97 = t71 * t96;
        let t98 = n(p.k8) * cos_q_4.mul_add(cos_q_3, sin_q_4 * sin_q_3);
        let t99 = t81.neg_mul_add(t97, t77.neg_mul_add(t93, t98));
        let t100 = t85 * t99;
        let t101 = t97.neg_mul_add(t69, t61.neg_mul_add(t93, t94));
        let t102 = t100.neg_mul_add(t83, t101);
        let t103 = t96.neg_mul_add(t97, t92.neg_mul_add(t93, n(p.k14)));
        let t104 = t99.neg_mul_add(t100, t103);
        check(t104, n(p.k14), 7.105427357601002e-15, 3)?;
        let t105 = N::ONE / t104;
        let t106 = n(p.k5) * cos_q_7.mul_add(cos_q_4, sin_q_7 * sin_q_4);
        let t107 = t96.neg_mul_add(t74, t92.neg_mul_add(t63, t106));
        let t108 = t99.neg_mul_add(t88, t107);
        let t109 = t105 * t108;
        let t110 = cos_q_5 * n(p.m).mul_add(t40, n(p.k19) * t41);
        let t111 = n(p.m).mul_add(t50, t51 * n(p.k19));
        let t112 = n(p.k7) * cos_q_1.mul_add(cos_q_5, sin_q_1 * sin_q_5);
        let t113 = n(p.k31) * t112;
        let t114 = n(p.l) * sin_q_5.neg_mul_add(t111, t110);
        let t115 = n(p.k7) * cos_q_5.mul_add(cos_q_2, sin_q_5 * sin_q_2);
        let t116 = t67.neg_mul_add(t113, t115);
        let t117 = t71 * t116;
        let t118 = n(p.k7) * cos_q_5.mul_add(cos_q_3, sin_q_5 * sin_q_3);
        let t119 = t81.neg_mul_add(t117, t77.neg_mul_add(t113, t118));
        let t120 = t85 * t119;
        let t121 = t117.neg_mul_add(t69, t61.neg_mul_add(t113, t114));
        let t122 = n(p.k7) * cos_q_5.mul_add(cos_q_4, sin_q_5 * sin_q_4);
        let t123 = t96.neg_mul_add(t117, t92.neg_mul_add(t113, t122));
        let t124 = t99.neg_mul_add(t120, t123);
        let t125 = t105 * t124;
        let t126 = t125.neg_mul_add(t102, t120.neg_mul_add(t83, t121));
        let t127 = t116.neg_mul_add(t117, t112.neg_mul_add(t113, n(p.k15)));
        let t128 = t124.neg_mul_add(t125, t119.neg_mul_add(t120, t127));
        check(t128, n(p.k15), 7.105427357601002e-15, 4)?;
        let t129 = N::ONE / t128;
        let t130 = n(p.k5) * cos_q_7.mul_add(cos_q_5, sin_q_7 * sin_q_5);
        let t131 = t116.neg_mul_add(t74, t112.neg_mul_add(t63, t130));
        let t132 = t124.neg_mul_add(t109, t119.neg_mul_add(t88, t131));
        let t133 = t129 * t132;
        let t134 = t109.neg_mul_add(t102, t88.neg_mul_add(t83, t89));
        let t135 = cos_q_6 * n(p.m).mul_add(t38, n(p.k19) * t39);
        let t136 = n(p.m).mul_add(t48, t49 * n(p.k19));
        let t137 = n(p.k6) * cos_q_1.mul_add(cos_q_6, sin_q_1 * sin_q_6);
        let t138 = n(p.k31) * t137;
        let t139 = n(p.l) * sin_q_6.neg_mul_add(t136, t135);
        let t140 = n(p.k6) * cos_q_6.mul_add(cos_q_2, sin_q_6 * sin_q_2);
        let t141 = t67.neg_mul_add(t138, t140);
        let t142 = t71 * t141;
        let t143 = n(p.k6) * cos_q_6.mul_add(cos_q_3, sin_q_6 * sin_q_3);
        let t144 = t81.neg_mul_add(t142, t77.neg_mul_add(t138, t143));
        let t145 = t85 * t144;
        let t146 = t142.neg_mul_add(t69, t61.neg_mul_add(t138, t139));
        let t147 = n(p.k6) * cos_q_6.mul_add(cos_q_4, sin_q_6 * sin_q_4);
        let t148 = t96.neg_mul_add(t142, t92.neg_mul_add(t138, t147));
        let t149 = t99.neg_mul_add(t145, t148);
        let t150 = t105 * t149;
        let t151 = n(p.k6) * cos_q_6.mul_add(cos_q_5, sin_q_6 * sin_q_5);
        let t152 = t116.neg_mul_add(t142, t112.neg_mul_add(t138, t151));
        let t153 = t124.neg_mul_add(t150, t119.neg_mul_add(t145, t152));
        let t154 = t129 * t153;
        let t155 = t150.neg_mul_add(t102, t145.neg_mul_add(t83, t146));
        let t156 = t154.neg_mul_add(t126, t155);
        let t157 = t141.neg_mul_add(t142, t137.neg_mul_add(t138, n(p.k16)));
        let t158 = t149.neg_mul_add(t150, t144.neg_mul_add(t145, t157));
        let t159 = t153.neg_mul_add(t154, t158);
        check(t159, n(p.k16), 7.105427357601002e-15, 5)?;
        let t160 = N::ONE / t159;
        let t161 = n(p.k5) * cos_q_7.mul_add(cos_q_6, sin_q_7 * sin_q_6);
        let t162 = t141.neg_mul_add(t74, t137.neg_mul_add(t63, t161));
        let t163 = t149.neg_mul_add(t109, t144.neg_mul_add(t88, t162));
        let t164 = t153.neg_mul_add(t133, t163);
        let t165 = t160 * t164;
        let t166 = t165.neg_mul_add(t156, t133.neg_mul_add(t126, t134));
        let t167 = t73.neg_mul_add(t74, t62.neg_mul_add(t63, n(p.k17)));
        let t168 = t108.neg_mul_add(t109, t87.neg_mul_add(t88, t167));
        let t169 = t164.neg_mul_add(t165, t132.neg_mul_add(t133, t168));
        check(t169, n(p.k17), 7.105427357601002e-15, 6)?;
        let t170 = N::ONE / t169;
        let t171 = n(p.k4) * cos_q_1.mul_add(cos_q_8, sin_q_1 * sin_q_8);
        let t172 = n(p.k31) * t171;
        let t173 = n(p.k4) * cos_q_8.mul_add(cos_q_2, sin_q_8 * sin_q_2);
        let t174 = t67.neg_mul_add(t172, t173);
        let t175 = t71 * t174;
        let t176 = n(p.k4) * cos_q_8.mul_add(cos_q_3, sin_q_8 * sin_q_3);
        let t177 = t81.neg_mul_add(t175, t77.neg_mul_add(t172, t176));
        let t178 = t85 * t177;
        let t179 = n(p.k4) * cos_q_8.mul_add(cos_q_4, sin_q_8 * sin_q_4);
        let t180 = t96.neg_mul_add(t175, t92.neg_mul_add(t172, t179));
        let t181 = t99.neg_mul_add(t178, t180);
        let t182 = t105 * t181;
        let t183 = n(p.k4) * cos_q_8.mul_add(cos_q_5, sin_q_8 * sin_q_5);
        let t184 = t116.neg_mul_add(t175, t112.neg_mul_add(t172, t183));
        let t185 = t124.neg_mul_add(t182, t119.neg_mul_add(t178, t184));
        let t186 = t129 * t185;
        let t187 = n(p.k4) * cos_q_8.mul_add(cos_q_6, sin_q_8 * sin_q_6);
        let t188 = t141.neg_mul_add(t175, t137.neg_mul_add(t172, t187));
        let t189 = t149.neg_mul_add(t182, t144.neg_mul_add(t178, t188));
        let t190 = t153.neg_mul_add(t186, t189);
        let t191 = t160 * t190;
        let t192 = n(p.k4) * cos_q_8.mul_add(cos_q_7, sin_q_8 * sin_q_7);
        let t193 = t73.neg_mul_add(t175, t62.neg_mul_add(t172, t192));
        let t194 = t108.neg_mul_add(t182, t87.neg_mul_add(t178, t193));
        let t195 = t164.neg_mul_add(t191, t132.neg_mul_add(t186, t194));
        let t196 = t170 * t195;
        let t197 = sin_q_8.neg_mul_add(t34, cos_q_8 * t20) * n(p.k21);
        let t198 = t175.neg_mul_add(t69, t61.neg_mul_add(t172, t197));
        let t199 = t182.neg_mul_add(t102, t178.neg_mul_add(t83, t198));
        let t200 = t191.neg_mul_add(t156, t186.neg_mul_add(t126, t199));
        let t201 = t174.neg_mul_add(t175, t171.neg_mul_add(t172, n(p.k18)));
        let t202 = t181.neg_mul_add(t182, t177.neg_mul_add(t178, t201));
        let t203 = t190.neg_mul_add(t191, t185.neg_mul_add(t186, t202));
        let t204 = t195.neg_mul_add(t196, t203);
        check(t204, n(p.k18), 7.105427357601002e-15, 7)?;
        let q_8_ddot = t196.neg_mul_add(t166, t200) / t204;
        let q_7_ddot = t196.neg_mul_add(q_8_ddot, t170 * t166);
        let t205 = t175.neg_mul_add(q_8_ddot, t71 * t69);
        let t206 = t191.neg_mul_add(q_8_ddot, t160 * t156);
        let q_6_ddot = t165.neg_mul_add(q_7_ddot, t206);
        let t207 = t74.neg_mul_add(q_7_ddot, t205);
        let t208 = t186.neg_mul_add(q_8_ddot, t129 * t126);
        let t209 = t133.neg_mul_add(q_7_ddot, t208);
        let q_5_ddot = t154.neg_mul_add(q_6_ddot, t209);
        let t210 = t142.neg_mul_add(q_6_ddot, t207);
        let t211 = t182.neg_mul_add(q_8_ddot, t105 * t102);
        let t212 = t109.neg_mul_add(q_7_ddot, t211);
        let t213 = t150.neg_mul_add(q_6_ddot, t212);
        let q_4_ddot = t125.neg_mul_add(q_5_ddot, t213);
        let t214 = t117.neg_mul_add(q_5_ddot, t210);
        let t215 = t178.neg_mul_add(q_8_ddot, t85 * t83);
        let t216 = t88.neg_mul_add(q_7_ddot, t215);
        let t217 = t145.neg_mul_add(q_6_ddot, t216);
        let t218 = t120.neg_mul_add(q_5_ddot, t217);
        let q_3_ddot = t100.neg_mul_add(q_4_ddot, t218);
        let q_2_ddot = t82.neg_mul_add(q_3_ddot, t97.neg_mul_add(q_4_ddot, t214));
        let t219 = t172.mul_sub(q_8_ddot, n(p.k31) * t61);
        let t220 = t138.mul_add(q_6_ddot, t63.mul_add(q_7_ddot, t219));
        let t221 = t93.mul_add(q_4_ddot, t113.mul_add(q_5_ddot, t220));
        let q_1_ddot = -t68.mul_add(q_2_ddot, t78.mul_add(q_3_ddot, t221));
        let accelerations = [
            q_1_ddot.store(),
            q_2_ddot.store(),
            q_3_ddot.store(),
            q_4_ddot.store(),
            q_5_ddot.store(),
            q_6_ddot.store(),
            q_7_ddot.store(),
            q_8_ddot.store(),
        ];
        Ok(accelerations)
    }
}

/// Kinetic energy `T`, in J.
///
/// ```text
/// T = …
/// ```
pub fn kinetic_energy<S: ::lagrangian::Scalar>(p: &Prepared<S>, q: &[S; 8], v: &[S; 8]) -> S {
    let q_1 = q[0];
    let q_2 = q[1];
    let q_3 = q[2];
    let q_4 = q[3];
    let q_5 = q[4];
    let q_6 = q[5];
    let q_7 = q[6];
    let q_8 = q[7];
    let q_1_dot = v[0];
    let q_2_dot = v[1];
    let q_3_dot = v[2];
    let q_4_dot = v[3];
    let q_5_dot = v[4];
    let q_6_dot = v[5];
    let q_7_dot = v[6];
    let q_8_dot = v[7];
    let (sin_q_2, cos_q_2) = q_2.sin_cos();
    let t0 = sin_q_2 * q_2_dot;
    let (sin_q_1, cos_q_1) = q_1.sin_cos();
    let t1 = t0 + sin_q_1 * q_1_dot;
    let (sin_q_3, cos_q_3) = q_3.sin_cos();
    let t2 = sin_q_3 * q_3_dot;
    let t3 = p.k0 * t2 + p.l * t1;
    let t4 = cos_q_2 * q_2_dot;
    let t5 = t4 + cos_q_1 * q_1_dot;
    let t6 = cos_q_3 * q_3_dot;
    let t7 = p.k0 * t6 + p.l * t5;
    let t8 = p.m * (t3 * t3 + t7 * t7) + q_3_dot * (q_3_dot * p.J);
    let t9 = p.l * q_1_dot;
    let t10 = p.k0 * t0 + sin_q_1 * t9;
    let t11 = p.k0 * t4 + cos_q_1 * t9;
    let t12 = p.m * (t10 * t10 + t11 * t11) + q_2_dot * (q_2_dot * p.J);
    let t13 = S::from_f64(0.5) * t12 + q_1_dot * (q_1_dot * p.k3);
    let t14 = t2 + t1;
    let (sin_q_4, cos_q_4) = q_4.sin_cos();
    let t15 = sin_q_4 * q_4_dot;
    let t16 = p.k0 * t15 + p.l * t14;
    let t17 = t6 + t5;
    let t18 = cos_q_4 * q_4_dot;
    let t19 = p.k0 * t18 + p.l * t17;
    let t20 = p.m * (t16 * t16 + t19 * t19) + q_4_dot * (q_4_dot * p.J);
    let t21 = t15 + t14;
    let (sin_q_5, cos_q_5) = q_5.sin_cos();
    let t22 = sin_q_5 * q_5_dot;
    let t23 = p.k0 * t22 + p.l * t21;
    let t24 = t18 + t17;
    let t25 = cos_q_5 * q_5_dot;
    let t26 = p.k0 * t25 + p.l * t24;
    let t27 = p.m * (t23 * t23 + t26 * t26) + q_5_dot * (q_5_dot * p.J);
    let t28 = S::from_f64(0.5) * t20 + (S::from_f64(0.5) * t8 + t13);
    let t29 = t22 + t21;
    let (sin_q_6, cos_q_6) = q_6.sin_cos();
    let t30 = sin_q_6 * q_6_dot;
    let t31 = p.k0 * t30 + p.l * t29;
    let t32 = t25 + t24;
    let t33 = cos_q_6 * q_6_dot;
    let t34 = p.k0 * t33 + p.l * t32;
    let t35 = p.m * (t31 * t31 + t34 * t34) + q_6_dot * (q_6_dot * p.J);
    let t36 = t30 + t29;
    let (sin_q_7, cos_q_7) = q_7.sin_cos();
    let t37 = sin_q_7 * q_7_dot;
    let t38 = p.k0 * t37 + p.l * t36;
    let t39 = t33 + t32;
    let t40 = cos_q_7 * q_7_dot;
    let t41 = p.k0 * t40 + p.l * t39;
    let t42 = p.m * (t38 * t38 + t41 * t41) + q_7_dot * (q_7_dot * p.J);
    let t43 = S::from_f64(0.5) * t35 + (S::from_f64(0.5) * t27 + t28);
    let t44 = p.k0 * q_8_dot;
    let (sin_q_8, cos_q_8) = q_8.sin_cos();
    let t45 = t44 * sin_q_8 + p.l * (t37 + t36);
    let t46 = t44 * cos_q_8 + p.l * (t40 + t39);
    let t47 = p.m * (t45 * t45 + t46 * t46) + q_8_dot * (q_8_dot * p.J);
    S::from_f64(0.5) * t47 + (S::from_f64(0.5) * t42 + t43)
}

/// Potential energy `V`, in J.
///
/// ```text
/// V = …
/// ```
pub fn potential_energy<S: ::lagrangian::Scalar>(p: &Prepared<S>, q: &[S; 8]) -> S {
    let q_1 = q[0];
    let q_2 = q[1];
    let q_3 = q[2];
    let q_4 = q[3];
    let q_5 = q[4];
    let q_6 = q[5];
    let q_7 = q[6];
    let q_8 = q[7];
    let cos_q_3 = q_3.cos();
    let cos_q_2 = q_2.cos();
    let cos_q_1 = q_1.cos();
    let t0 = cos_q_2 + cos_q_1;
    let cos_q_4 = q_4.cos();
    let t1 = cos_q_3 + t0;
    let t2 = p.k0 * cos_q_3 + p.l * t0 + (p.k0 * cos_q_2 + p.l * cos_q_1);
    let cos_q_5 = q_5.cos();
    let t3 = cos_q_4 + t1;
    let cos_q_6 = q_6.cos();
    let t4 = cos_q_5 + t3;
    let t5 = p.k0 * cos_q_5 + p.l * t3 + (p.k0 * cos_q_4 + p.l * t1 + t2);
    let cos_q_7 = q_7.cos();
    let t6 = cos_q_6 + t4;
    let cos_q_8 = q_8.cos();
    let t7 = p.k0 * cos_q_7 + p.l * t6 + (p.k0 * cos_q_6 + p.l * t4 + t5);
    -((p.k0 * cos_q_8 + p.l * (cos_q_7 + t6) + t7) * p.k1 + cos_q_1 * p.k2)
}

/// Height of the chain's end above the hinge. Unit: m.
///
/// ```text
/// end = -l*cos(q[1]) - l*cos(q[2]) - l*cos(q[3]) - l*cos(q[4]) - l*cos(q[5]) - l*cos(q[6])
///     - l*cos(q[7]) - l*cos(q[8])
/// ```
pub fn output_end<S: ::lagrangian::Scalar>(p: &Prepared<S>, q: &[S; 8]) -> S {
    let q_1 = q[0];
    let q_2 = q[1];
    let q_3 = q[2];
    let q_4 = q[3];
    let q_5 = q[4];
    let q_6 = q[5];
    let q_7 = q[6];
    let q_8 = q[7];
    let cos_q_2 = q_2.cos();
    let cos_q_1 = q_1.cos();
    let cos_q_3 = q_3.cos();
    let cos_q_4 = q_4.cos();
    let cos_q_5 = q_5.cos();
    let cos_q_6 = q_6.cos();
    let cos_q_7 = q_7.cos();
    let t0 = cos_q_6 + (cos_q_5 + (cos_q_4 + (cos_q_3 + (cos_q_2 + cos_q_1))));
    let cos_q_8 = q_8.cos();
    p.k30 * (cos_q_8 + (cos_q_7 + t0))
}

/// Everything that the description asks to observe.
pub fn outputs<S: ::lagrangian::Scalar>(p: &Prepared<S>, q: &[S; 8]) -> Outputs<S> {
    Outputs {
        end: output_end(p, q),
    }
}

/// Names and units.
const PARAMETERS: [(&str, &str); 4] = [("l", "m"), ("m", "kg"), ("J", "kg*m^2"), ("g", "m/s^2")];

/// Names and units.
const COORDINATES: [(&str, &str); 8] = [
    ("q[1]", "rad"),
    ("q[2]", "rad"),
    ("q[3]", "rad"),
    ("q[4]", "rad"),
    ("q[5]", "rad"),
    ("q[6]", "rad"),
    ("q[7]", "rad"),
    ("q[8]", "rad"),
];

/// Names and units.
const INPUTS: [(&str, &str); 0] = [];

/// Names and units.
const OUTPUTS: [(&str, &str); 1] = [("end", "m")];

impl ::lagrangian::Machine for Chain {
    type System = Prepared;

    fn name(&self) -> &str {
        "Chain"
    }

    fn parameters(&self) -> impl ExactSizeIterator<Item = (::lagrangian::Quantity<'_>, f64)> {
        let values = [self.l, self.m, self.J, self.g];
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
    type Vector = [f64; 8];
    type Matrix = [f64; 64];
    type Coordinates = Coordinates;
    type Inputs = Inputs;
    type Outputs = Outputs;

    fn coordinates(&self) -> impl ExactSizeIterator<Item = ::lagrangian::Quantity<'_>> {
        COORDINATES.iter().map(quantity)
    }

    fn to_coordinates(&self, vector: &[f64; 8]) -> Coordinates {
        Coordinates::from_array(*vector)
    }

    fn to_vector(&self, coordinates: &Coordinates) -> [f64; 8] {
        coordinates.to_array()
    }

    fn accelerations(
        &self,
        _: f64,
        q: &[f64; 8],
        v: &[f64; 8],
        _: &Inputs,
        result: &mut [f64; 8],
    ) -> Result<(), ::lagrangian::Singular> {
        <f64 as ::lagrangian::Number>::run_in_place(Accelerations { p: self, q, v }, result)
    }

    fn mass_matrix(&self, _: f64, q: &[f64; 8], matrix: &mut [f64; 64]) {
        let rows = mass_matrix(self, q);
        for (to, from) in matrix.iter_mut().zip(rows.as_flattened()) {
            *to = *from;
        }
    }

    fn bias(&self, _: f64, q: &[f64; 8], v: &[f64; 8], result: &mut [f64; 8]) {
        *result = bias(self, q, v);
    }

    fn applied(&self, _: f64, q: &[f64; 8], _: &[f64; 8], _: &Inputs, result: &mut [f64; 8]) {
        *result = applied(self, q);
    }

    fn forces(&self, _: f64, q: &[f64; 8], v: &[f64; 8], _: &Inputs, result: &mut [f64; 8]) {
        *result = forces(self, q, v);
    }

    fn kinetic_energy(&self, _: f64, q: &[f64; 8], v: &[f64; 8]) -> f64 {
        kinetic_energy(self, q, v)
    }

    fn potential_energy(&self, _: f64, q: &[f64; 8], _: &Inputs) -> f64 {
        potential_energy(self, q)
    }

    fn dissipation(&self, _: f64, _: &[f64; 8], _: &[f64; 8], _: &Inputs) -> f64 {
        0.0
    }

    fn work_rate(&self, _: f64, _: &[f64; 8], _: &[f64; 8], _: &[f64; 8], _: &Inputs) -> f64 {
        0.0
    }

    fn dissipation_rate(&self, _: f64, _: &[f64; 8], _: &[f64; 8], _: &Inputs) -> f64 {
        0.0
    }

    fn default_inputs(&self) -> Inputs {
        Inputs::default()
    }

    fn input_values(
        &self,
        _: &Inputs,
    ) -> impl ExactSizeIterator<Item = (::lagrangian::Quantity<'_>, f64)> {
        let values = [];
        quantities(&INPUTS, values)
    }

    fn output_values(
        &self,
        outputs: &Outputs,
    ) -> impl ExactSizeIterator<Item = (::lagrangian::Quantity<'_>, f64)> {
        let values = [outputs.end];
        quantities(&OUTPUTS, values)
    }

    fn outputs(&self, _: f64, q: &[f64; 8], _: &[f64; 8], _: &[f64; 8], _: &Inputs) -> Outputs {
        outputs(self, q)
    }

    fn assumptions(
        &self,
        _: f64,
        _: &[f64; 8],
        _: &[f64; 8],
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
    type Vectors = [::lagrangian::Lanes<N>; 8];
    type SeveralInputs = Inputs;

    fn abreast(systems: [&Self; N]) -> Self::Several {
        let lanes = |number: fn(&Self) -> f64| ::lagrangian::Lanes(systems.map(number));
        Prepared {
            l: lanes(|p| p.l),
            m: lanes(|p| p.m),
            J: lanes(|p| p.J),
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
            singular: None,
        }
    }

    fn inputs_abreast(_: [&Inputs; N]) -> Self::SeveralInputs {
        Inputs {}
    }

    fn inputs_of_lane(_: &Self::SeveralInputs, _: usize) -> Inputs {
        Inputs {}
    }

    fn is_singular(&self) -> bool {
        self.singular.is_some()
    }

    fn accelerations_abreast(
        p: &Self::Several,
        _: ::lagrangian::Lanes<N>,
        q: &Self::Vectors,
        v: &Self::Vectors,
        _: &Self::SeveralInputs,
        result: &mut Self::Vectors,
    ) -> Result<(), ::lagrangian::Singular> {
        <::lagrangian::Lanes<N> as ::lagrangian::Number>::run_in_place(
            Accelerations { p, q, v },
            result,
        )
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

/// Whether elimination has left nothing but rounding errors of a diagonal element; so too if it is
/// no number.
fn vanishes<S: ::lagrangian::Scalar>(pivot: S, diagonal: S, share: f64) -> bool {
    let bound = S::from_f64(share) * diagonal;
    !pivot.exceeds(bound)
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
