// @generated from machines/chain.machine by `cargo xtask generate`; edits are lost.

//! A chain of N uniform bars hanging from a hinge. Angles are absolute, from the downward vertical.
//!
//! 8 coordinates, 4 parameters, 1 output. Arithmetic of one call:
//!
//! | function | mul | add | div | sin cos | other | temporaries |
//! | --- | --: | --: | --: | --: | --: | --: |
//! | `prepare` | 41 | 20 | 1 | 0 | 0 | 62 |
//! | `mass_matrix` | 84 | 28 | 0 | 8 | 0 | 128 |
//! | `bias` | 103 | 60 | 0 | 8 | 0 | 179 |
//! | `applied` | 8 | 0 | 0 | 8 | 0 | 16 |
//! | `forces` | 104 | 68 | 0 | 8 | 0 | 188 |
//! | `accelerations` | 293 | 176 | 7 | 8 | 0 | 492 |
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
        let k1 = self.l * t0;
        let t1 = self.g * t0;
        let k3 = S::from_f64(0.5) * t1;
        let t2 = k1 * S::from_f64(0.25);
        let k19 = self.J + t2;
        let t3 = S::ONE / k19;
        let k33 = t2 * t3;
        let k0 = self.l * S::from_f64(0.5);
        let k2 = self.m * self.g;
        let k4 = S::from_f64(0.125) * (k1 + self.J * S::from_f64(4.0));
        let k5 = S::from_f64(0.5) * k1;
        let k6 = k1 * S::from_f64(1.5);
        let k7 = k1 * S::from_f64(2.5);
        let k8 = k1 * S::from_f64(3.5);
        let k9 = k1 * S::from_f64(4.5);
        let k10 = k1 * S::from_f64(5.5);
        let k11 = k1 * S::from_f64(6.5);
        let k12 = self.J + k1 * S::from_f64(7.25);
        let k13 = self.J + k1 * S::from_f64(6.25);
        let k14 = self.J + k1 * S::from_f64(5.25);
        let k15 = self.J + k1 * S::from_f64(4.25);
        let k16 = self.J + k1 * S::from_f64(3.25);
        let k17 = self.J + k1 * S::from_f64(2.25);
        let k18 = self.J + k1 * S::from_f64(1.25);
        let k20 = self.m * S::from_f64(0.5);
        let k21 = t0 * S::from_f64(0.25);
        let k22 = S::from_f64(0.5) * t0;
        let k23 = -(t1 * S::from_f64(7.5));
        let k24 = -(t1 * S::from_f64(6.5));
        let k25 = -(t1 * S::from_f64(5.5));
        let k26 = -(t1 * S::from_f64(4.5));
        let k27 = -(t1 * S::from_f64(3.5));
        let k28 = -(t1 * S::from_f64(2.5));
        let k29 = -(t1 * S::from_f64(1.5));
        let k30 = -k3;
        let k31 = -self.l;
        let k32 = k1 * k33;
        let k34 = self.g * S::from_f64(0.5);
        let k35 = S::from_f64(0.25) * t3;
        let k36 = self.l * k1;
        let k37 = k1 * k1;
        let k38 = self.l * S::from_f64(0.25);
        let k39 = -t0;
        let k40 = -(t0 * t3);
        let singular = if vanishes(k19, k19, 7.105427357601002e-15) {
            Some(singular(7, k19, k19))
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
            k32,
            k33,
            k34,
            k35,
            k36,
            k37,
            k38,
            k39,
            k40,
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
    /// `l^2*m`
    k1: S,
    /// `m*g`
    k2: S,
    /// `0.5*l*m*g`
    k3: S,
    /// `0.125*(l^2*m + 4*J)`
    k4: S,
    /// `0.5*l^2*m`
    k5: S,
    /// `1.5*l^2*m`
    k6: S,
    /// `2.5*l^2*m`
    k7: S,
    /// `3.5*l^2*m`
    k8: S,
    /// `4.5*l^2*m`
    k9: S,
    /// `5.5*l^2*m`
    k10: S,
    /// `6.5*l^2*m`
    k11: S,
    /// `J + 7.25*l^2*m`
    k12: S,
    /// `J + 6.25*l^2*m`
    k13: S,
    /// `J + 5.25*l^2*m`
    k14: S,
    /// `J + 4.25*l^2*m`
    k15: S,
    /// `J + 3.25*l^2*m`
    k16: S,
    /// `J + 2.25*l^2*m`
    k17: S,
    /// `J + 1.25*l^2*m`
    k18: S,
    /// `J + 0.25*l^2*m`
    k19: S,
    /// `0.5*m`
    k20: S,
    /// `0.25*l*m`
    k21: S,
    /// `0.5*l*m`
    k22: S,
    /// `-7.5*l*m*g`
    k23: S,
    /// `-6.5*l*m*g`
    k24: S,
    /// `-5.5*l*m*g`
    k25: S,
    /// `-4.5*l*m*g`
    k26: S,
    /// `-3.5*l*m*g`
    k27: S,
    /// `-2.5*l*m*g`
    k28: S,
    /// `-1.5*l*m*g`
    k29: S,
    /// `-0.5*l*m*g`
    k30: S,
    /// `-l`
    k31: S,
    /// `0.25*l^4*m^2/(J + 0.25*l^2*m)`
    k32: S,
    /// `0.25*l^2*m/(J + 0.25*l^2*m)`
    k33: S,
    /// `0.5*g`
    k34: S,
    /// `0.25/(J + 0.25*l^2*m)`
    k35: S,
    /// `l^3*m`
    k36: S,
    /// `l^4*m^2`
    k37: S,
    /// `0.25*l`
    k38: S,
    /// `-l*m`
    k39: S,
    /// `-l*m/(J + 0.25*l^2*m)`
    k40: S,
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
    let m21 = (cos_q_2 * cos_q_1 + sin_q_2 * sin_q_1) * p.k11;
    let m31 = p.k10 * (cos_q_1 * cos_q_3 + sin_q_1 * sin_q_3);
    let m32 = p.k10 * (cos_q_2 * cos_q_3 + sin_q_2 * sin_q_3);
    let m41 = p.k9 * (cos_q_1 * cos_q_4 + sin_q_1 * sin_q_4);
    let m42 = p.k9 * (cos_q_2 * cos_q_4 + sin_q_2 * sin_q_4);
    let m43 = p.k9 * (cos_q_3 * cos_q_4 + sin_q_3 * sin_q_4);
    let m51 = p.k8 * (cos_q_1 * cos_q_5 + sin_q_1 * sin_q_5);
    let m52 = p.k8 * (cos_q_2 * cos_q_5 + sin_q_2 * sin_q_5);
    let m53 = p.k8 * (cos_q_3 * cos_q_5 + sin_q_3 * sin_q_5);
    let m54 = p.k8 * (cos_q_4 * cos_q_5 + sin_q_4 * sin_q_5);
    let m61 = p.k7 * (cos_q_1 * cos_q_6 + sin_q_1 * sin_q_6);
    let m62 = p.k7 * (cos_q_2 * cos_q_6 + sin_q_2 * sin_q_6);
    let m63 = p.k7 * (cos_q_3 * cos_q_6 + sin_q_3 * sin_q_6);
    let m64 = p.k7 * (cos_q_4 * cos_q_6 + sin_q_4 * sin_q_6);
    let m65 = p.k7 * (cos_q_5 * cos_q_6 + sin_q_5 * sin_q_6);
    let m71 = p.k6 * (cos_q_1 * cos_q_7 + sin_q_1 * sin_q_7);
    let m72 = p.k6 * (cos_q_2 * cos_q_7 + sin_q_2 * sin_q_7);
    let m73 = p.k6 * (cos_q_3 * cos_q_7 + sin_q_3 * sin_q_7);
    let m74 = p.k6 * (cos_q_4 * cos_q_7 + sin_q_4 * sin_q_7);
    let m75 = p.k6 * (cos_q_5 * cos_q_7 + sin_q_5 * sin_q_7);
    let m76 = p.k6 * (cos_q_6 * cos_q_7 + sin_q_6 * sin_q_7);
    let m81 = p.k5 * (cos_q_1 * cos_q_8 + sin_q_1 * sin_q_8);
    let m82 = p.k5 * (cos_q_2 * cos_q_8 + sin_q_2 * sin_q_8);
    let m83 = p.k5 * (cos_q_3 * cos_q_8 + sin_q_3 * sin_q_8);
    let m84 = p.k5 * (cos_q_4 * cos_q_8 + sin_q_4 * sin_q_8);
    let m85 = p.k5 * (cos_q_5 * cos_q_8 + sin_q_5 * sin_q_8);
    let m86 = p.k5 * (cos_q_6 * cos_q_8 + sin_q_6 * sin_q_8);
    let m87 = p.k5 * (cos_q_7 * cos_q_8 + sin_q_7 * sin_q_8);
    [
        [p.k12, m21, m31, m41, m51, m61, m71, m81],
        [m21, p.k13, m32, m42, m52, m62, m72, m82],
        [m31, m32, p.k14, m43, m53, m63, m73, m83],
        [m41, m42, m43, p.k15, m54, m64, m74, m84],
        [m51, m52, m53, m54, p.k16, m65, m75, m85],
        [m61, m62, m63, m64, m65, p.k17, m76, m86],
        [m71, m72, m73, m74, m75, m76, p.k18, m87],
        [m81, m82, m83, m84, m85, m86, m87, p.k19],
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
    let t56 = cos_q_1 * (t54 + (p.m * t55 + t33 * p.k21));
    let t57 = cos_q_3 * (p.m * t52 + t53 * p.k20);
    let t58 = cos_q_4 * (p.m * t50 + t51 * p.k20);
    let t59 = cos_q_5 * (p.m * t48 + t49 * p.k20);
    let t60 = cos_q_6 * (p.m * t46 + t47 * p.k20);
    let t61 = cos_q_7 * (p.m * t44 + t45 * p.k20);
    let h_q_1 = p.l * (sin_q_1 * (t30 + (p.m * t31 + p.k21 * t3)) - t56);
    let h_q_2 = p.l * (sin_q_2 * (t30 + t31 * p.k20) - cos_q_2 * (t54 + t55 * p.k20));
    let h_q_3 = p.l * (sin_q_3 * (p.m * t28 + t29 * p.k20) - t57);
    let h_q_4 = p.l * (sin_q_4 * (p.m * t26 + t27 * p.k20) - t58);
    let h_q_5 = p.l * (sin_q_5 * (p.m * t24 + t25 * p.k20) - t59);
    let h_q_6 = p.l * (sin_q_6 * (p.m * t22 + t23 * p.k20) - t60);
    let h_q_7 = p.l * (sin_q_7 * (p.m * t20 + t21 * p.k20) - t61);
    let h_q_8 = (sin_q_8 * t20 - cos_q_8 * t44) * p.k22;
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
    let q_q_1 = p.k23 * sin_q_1;
    let q_q_2 = p.k24 * sin_q_2;
    let q_q_3 = p.k25 * sin_q_3;
    let q_q_4 = p.k26 * sin_q_4;
    let q_q_5 = p.k27 * sin_q_5;
    let q_q_6 = p.k28 * sin_q_6;
    let q_q_7 = p.k29 * sin_q_7;
    let q_q_8 = p.k30 * sin_q_8;
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
    let t56 = sin_q_1 * (t54 + (p.m * t55 + p.k20 * (p.g + p.k0 * t33)));
    let t57 = sin_q_3 * (p.m * t52 + t53 * p.k20);
    let t58 = sin_q_4 * (p.m * t50 + t51 * p.k20);
    let t59 = sin_q_5 * (p.m * t48 + t49 * p.k20);
    let t60 = sin_q_6 * (p.m * t46 + t47 * p.k20);
    let t61 = sin_q_7 * (p.m * t44 + t45 * p.k20);
    let f_q_1 = p.l * (cos_q_1 * (t30 + (p.m * t31 + t3 * p.k21)) - t56);
    let f_q_2 = p.l * (cos_q_2 * (t30 + p.k20 * t31) - sin_q_2 * (t54 + t55 * p.k20));
    let f_q_3 = p.l * (cos_q_3 * (p.m * t28 + p.k20 * t29) - t57);
    let f_q_4 = p.l * (cos_q_4 * (p.m * t26 + p.k20 * t27) - t58);
    let f_q_5 = p.l * (cos_q_5 * (p.m * t24 + p.k20 * t25) - t59);
    let f_q_6 = p.l * (cos_q_6 * (p.m * t22 + p.k20 * t23) - t60);
    let f_q_7 = p.l * (cos_q_7 * (p.m * t20 + p.k20 * t21) - t61);
    let f_q_8 = (cos_q_8 * t20 - sin_q_8 * t44) * p.k22;
    [f_q_1, f_q_2, f_q_3, f_q_4, f_q_5, f_q_6, f_q_7, f_q_8]
}

/// Accelerations `a`, the solution of `M a = f` eliminated along the machine.
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
        let angles = [q_8, q_7, q_6, q_5, q_4, q_3, q_2, q_1];
        let circular = N::sin_cos_all(angles);
        let (sin_q_8, cos_q_8) = circular[0];
        let (sin_q_7, cos_q_7) = circular[1];
        let (sin_q_6, cos_q_6) = circular[2];
        let (sin_q_5, cos_q_5) = circular[3];
        let (sin_q_4, cos_q_4) = circular[4];
        let (sin_q_3, cos_q_3) = circular[5];
        let (sin_q_2, cos_q_2) = circular[6];
        let (sin_q_1, cos_q_1) = circular[7];
        let t0 = cos_q_8.mul_add(cos_q_7, sin_q_8 * sin_q_7);
        let t1 = t0.neg_mul_add(t0 * n(p.k32), n(p.k18));
        check(t1, n(p.k18), 7.105427357601002e-15, 6)?;
        let t2 = N::ONE / t1;
        let t3 = sin_q_8 * n(p.k33);
        let t4 = t0.neg_mul_add(t3, sin_q_7 * N::from_f64(1.5));
        let t5 = cos_q_8 * n(p.k33);
        let t6 = t0.neg_mul_add(t5, cos_q_7 * N::from_f64(1.5));
        let t7 = t2.mul_add(t4 * t6, cos_q_8 * (sin_q_8 * n(p.k35)));
        let t8 = n(p.k1) * sin_q_6;
        let t9 = n(p.k1) * t2;
        let t10 = t6 * t9;
        let t11 = cos_q_8.neg_mul_add(t5, N::from_f64(2.0));
        let t12 = t6.neg_mul_add(t10, t11);
        let t13 = cos_q_6.mul_sub(t12, t8 * t7);
        let t14 = n(p.k1) * cos_q_6;
        let t15 = t4 * t9;
        let t16 = sin_q_8.neg_mul_add(t3, N::from_f64(2.0));
        let t17 = t4.neg_mul_add(t15, t16);
        let t18 = sin_q_6.mul_sub(t17, t14 * t7);
        let t19 = t14.mul_add(t13, t8.mul_add(t18, n(p.k19)));
        check(t19, n(p.k17), 7.105427357601002e-15, 5)?;
        let t20 = N::ONE / t19;
        let t21 = sin_q_6.mul_add(N::from_f64(0.5), t18);
        let t22 = cos_q_6.mul_add(N::from_f64(0.5), t13);
        let t23 = t20.mul_add(t21 * t22, t7);
        let t24 = n(p.k1) * sin_q_5;
        let t25 = n(p.k1) * t20;
        let t26 = t22 * t25;
        let t27 = t22.neg_mul_add(t26, N::ONE + t12);
        let t28 = cos_q_5.mul_sub(t27, t24 * t23);
        let t29 = n(p.k1) * cos_q_5;
        let t30 = t21 * t25;
        let t31 = t21.neg_mul_add(t30, N::ONE + t17);
        let t32 = sin_q_5.mul_sub(t31, t29 * t23);
        let t33 = t29.mul_add(t28, t24.mul_add(t32, n(p.k19)));
        check(t33, n(p.k16), 7.105427357601002e-15, 4)?;
        let t34 = N::ONE / t33;
        let t35 = sin_q_5.mul_add(N::from_f64(0.5), t32);
        let t36 = cos_q_5.mul_add(N::from_f64(0.5), t28);
        let t37 = t34.mul_add(t35 * t36, t23);
        let t38 = n(p.k1) * sin_q_4;
        let t39 = n(p.k1) * t34;
        let t40 = t36 * t39;
        let t41 = t36.neg_mul_add(t40, N::ONE + t27);
        let t42 = cos_q_4.mul_sub(t41, t38 * t37);
        let t43 = n(p.k1) * cos_q_4;
        let t44 = t35 * t39;
        let t45 = t35.neg_mul_add(t44, N::ONE + t31);
        let t46 = sin_q_4.mul_sub(t45, t43 * t37);
        let t47 = t43.mul_add(t42, t38.mul_add(t46, n(p.k19)));
        check(t47, n(p.k15), 7.105427357601002e-15, 3)?;
        let t48 = N::ONE / t47;
        let t49 = sin_q_4.mul_add(N::from_f64(0.5), t46);
        let t50 = cos_q_4.mul_add(N::from_f64(0.5), t42);
        let t51 = t48.mul_add(t49 * t50, t37);
        let t52 = n(p.k1) * sin_q_3;
        let t53 = n(p.k1) * t48;
        let t54 = t50 * t53;
        let t55 = t50.neg_mul_add(t54, N::ONE + t41);
        let t56 = cos_q_3.mul_sub(t55, t52 * t51);
        let t57 = n(p.k1) * cos_q_3;
        let t58 = t49 * t53;
        let t59 = t49.neg_mul_add(t58, N::ONE + t45);
        let t60 = sin_q_3.mul_sub(t59, t57 * t51);
        let t61 = t57.mul_add(t56, t52.mul_add(t60, n(p.k19)));
        check(t61, n(p.k14), 7.105427357601002e-15, 2)?;
        let t62 = N::ONE / t61;
        let t63 = sin_q_3.mul_add(N::from_f64(0.5), t60);
        let t64 = cos_q_3.mul_add(N::from_f64(0.5), t56);
        let t65 = t62.mul_add(t63 * t64, t51);
        let t66 = t65 * n(p.k36);
        let t67 = q_2_dot * q_2_dot;
        let t68 = sin_q_2 * t67;
        let t69 = q_1_dot * q_1_dot;
        let t70 = sin_q_1 * t69;
        let t71 = t68 + t70;
        let t72 = t51 * n(p.k36);
        let t73 = q_3_dot * q_3_dot;
        let t74 = sin_q_3 * t73;
        let t75 = t37 * n(p.k36);
        let t76 = q_4_dot * q_4_dot;
        let t77 = sin_q_4 * t76;
        let t78 = t23 * n(p.k36);
        let t79 = q_5_dot * q_5_dot;
        let t80 = sin_q_5 * t79;
        let t81 = t7 * n(p.k36);
        let t82 = q_6_dot * q_6_dot;
        let t83 = sin_q_6 * t82;
        let t84 = q_7_dot * q_7_dot;
        let t85 = n(p.l) * t84;
        let t86 = q_8_dot * (n(p.k0) * q_8_dot);
        let t87 = n(p.g) + cos_q_7.mul_add(t85, cos_q_8 * t86);
        let t88 = sin_q_7.mul_add(t85, sin_q_8 * t86);
        let t89 = cos_q_7.neg_mul_add(t88, sin_q_7 * n(p.k34));
        let t90 = sin_q_8.mul_sub(t87, cos_q_8 * t88);
        let t91 = t90.neg_mul_add(t0 * n(p.k33), sin_q_7.mul_add(t87, t89));
        let t92 = n(p.k0) * t84;
        let t93 = t3.neg_mul_add(t90, t87 + cos_q_7.mul_add(t92, n(p.g)));
        let t94 = n(p.l) * t82;
        let t95 = cos_q_6 * t94;
        let t96 = t81.mul_add(t83, t15.neg_mul_add(t91, t93));
        let t97 = t17.mul_add(t95, t96);
        let t98 = cos_q_6 * t82;
        let t99 = t5.mul_add(t90, sin_q_7.mul_add(t92, t88));
        let t100 = sin_q_6 * t94;
        let t101 = t12.mul_add(t100, t98.mul_add(t81, t10.mul_add(t91, t99)));
        let t102 = sin_q_6.mul_add(t97, sin_q_6 * n(p.k34));
        let t103 = cos_q_6.neg_mul_add(t101, t102);
        let t104 = t30.neg_mul_add(t103, t97 + n(p.k0).mul_add(t98, n(p.g)));
        let t105 = n(p.l) * t79;
        let t106 = cos_q_5 * t105;
        let t107 = t31.mul_add(t106, t78.mul_add(t80, t104));
        let t108 = cos_q_5 * t79;
        let t109 = t26.mul_add(t103, n(p.k0).mul_add(t83, t101));
        let t110 = sin_q_5 * t105;
        let t111 = t27.mul_add(t110, t108.mul_add(t78, t109));
        let t112 = sin_q_5.mul_add(t107, sin_q_5 * n(p.k34));
        let t113 = cos_q_5.neg_mul_add(t111, t112);
        let t114 = t107 + n(p.k0).mul_add(t108, n(p.g));
        let t115 = n(p.l) * t76;
        let t116 = cos_q_4 * t115;
        let t117 = t75.mul_add(t77, t44.neg_mul_add(t113, t114));
        let t118 = t45.mul_add(t116, t117);
        let t119 = cos_q_4 * t76;
        let t120 = t40.mul_add(t113, n(p.k0).mul_add(t80, t111));
        let t121 = sin_q_4 * t115;
        let t122 = t41.mul_add(t121, t119.mul_add(t75, t120));
        let t123 = sin_q_4.mul_add(t118, sin_q_4 * n(p.k34));
        let t124 = cos_q_4.neg_mul_add(t122, t123);
        let t125 = t118 + n(p.k0).mul_add(t119, n(p.g));
        let t126 = n(p.l) * t73;
        let t127 = cos_q_3 * t126;
        let t128 = t72.mul_add(t74, t58.neg_mul_add(t124, t125));
        let t129 = t59.mul_add(t127, t128);
        let t130 = cos_q_3 * t73;
        let t131 = t54.mul_add(t124, n(p.k0).mul_add(t77, t122));
        let t132 = sin_q_3 * t126;
        let t133 = t55.mul_add(t132, t130.mul_add(t72, t131));
        let t134 = sin_q_3.mul_add(t129, sin_q_3 * n(p.k34));
        let t135 = cos_q_3.neg_mul_add(t133, t134);
        let t136 = n(p.k1) * t62;
        let t137 = t63 * t136;
        let t138 = t129 + n(p.k0).mul_add(t130, n(p.g));
        let t139 = t63.neg_mul_add(t137, N::ONE + t59);
        let t140 = cos_q_1 * t69;
        let t141 = cos_q_2 * t67;
        let t142 = t140 + t141;
        let t143 = n(p.l) * t142;
        let t144 = t71.mul_add(t66, t137.neg_mul_add(t135, t138));
        let t145 = t139.mul_add(t143, t144);
        let t146 = N::from_f64(0.5) * sin_q_1;
        let t147 = t140.mul_add(n(p.k0), n(p.g));
        let t148 = n(p.g) + n(p.k0).mul_add(t141, t140 * n(p.l));
        let t149 = n(p.k0).mul_add(t68, t70 * n(p.l));
        let t150 = t146.mul_sub(t147, t140 * (sin_q_1 * n(p.k38)));
        let t151 = t150 + sin_q_1.mul_sub(t148, cos_q_1 * t149);
        let t152 = t64 * t136;
        let t153 = t152.mul_add(t135, n(p.k0).mul_add(t74, t133));
        let t154 = t64.neg_mul_add(t152, N::ONE + t55);
        let t155 = n(p.l) * t71;
        let t156 = t154.mul_add(t155, t66.mul_add(t142, t153));
        let t157 = N::from_f64(0.5) * cos_q_2;
        let t158 = t148.mul_sub(N::from_f64(0.5) * sin_q_2, t157 * t149);
        let t159 = cos_q_2.neg_mul_add(t156, sin_q_2.mul_add(t145, t158));
        let t160 = n(p.k1) * t65;
        let t161 = cos_q_2.mul_sub(t154, t160 * sin_q_2);
        let t162 = sin_q_2.mul_sub(t139, t160 * cos_q_2);
        let t163 = t157.mul_add(cos_q_1, sin_q_2 * t146);
        let t164 = t161.mul_add(cos_q_1, t162.mul_add(sin_q_1, t163));
        let t165 = t162.mul_add(n(p.k1) * sin_q_2, n(p.k19));
        let t166 = t161.mul_add(n(p.k1) * cos_q_2, t165);
        check(t166, n(p.k13), 7.105427357601002e-15, 1)?;
        let t167 = N::ONE / t166;
        let t168 = n(p.k1) * t167;
        let t169 = cos_q_1.neg_mul_add(t156, sin_q_1.mul_add(t145, t151));
        let t170 = t139.mul_sub(sin_q_1, t160 * cos_q_1);
        let t171 = t170.mul_add(n(p.k1) * sin_q_1, n(p.k18));
        let t172 = t154.mul_sub(cos_q_1, t160 * sin_q_1);
        let t173 = t172.mul_add(n(p.k1) * cos_q_1, t171);
        let t174 = t167.neg_mul_add(t164 * (t164 * n(p.k37)), t173);
        check(t174, n(p.k12), 7.105427357601002e-15, 0)?;
        let t175 = N::ONE / t174 * t168.neg_mul_add(t164 * t159, t169);
        let t176 = n(p.k1) * t175;
        let t177 = t164.neg_mul_add(t176, t159);
        let t178 = t168 * t177;
        let t179 = sin_q_2.neg_mul_add(t178, sin_q_1.neg_mul_add(t176, t143));
        let t180 = cos_q_2.mul_add(t178, cos_q_1.mul_add(t176, t155));
        let t181 = t64.neg_mul_add(t180, t63.mul_add(t179, t135));
        let t182 = t136 * t181;
        let t183 = sin_q_3.neg_mul_add(t182, t127 + t179);
        let t184 = cos_q_3.mul_add(t182, t132 + t180);
        let t185 = t50.neg_mul_add(t184, t49.mul_add(t183, t124));
        let t186 = t53 * t185;
        let t187 = sin_q_4.neg_mul_add(t186, t116 + t183);
        let t188 = cos_q_4.mul_add(t186, t121 + t184);
        let t189 = t36.neg_mul_add(t188, t35.mul_add(t187, t113));
        let t190 = t39 * t189;
        let t191 = sin_q_5.neg_mul_add(t190, t106 + t187);
        let t192 = cos_q_5.mul_add(t190, t110 + t188);
        let t193 = t22.neg_mul_add(t192, t21.mul_add(t191, t103));
        let t194 = t25 * t193;
        let t195 = sin_q_6.neg_mul_add(t194, t95 + t191);
        let t196 = cos_q_6.mul_add(t194, t100 + t192);
        let t197 = t2 * t6.neg_mul_add(t196, t4.mul_add(t195, t91));
        let t198 = sin_q_8 * N::from_f64(0.5);
        let t199 = t195.mul_add(t198, N::from_f64(0.5) * t90);
        let t200 = t196.neg_mul_add(cos_q_8 * N::from_f64(0.5), t199);
        let q_1_ddot = t175 * n(p.k39);
        let q_2_ddot = t177 * (t167 * n(p.k39));
        let q_3_ddot = t181 * (t62 * n(p.k39));
        let q_4_ddot = t185 * (t48 * n(p.k39));
        let q_5_ddot = t189 * (t34 * n(p.k39));
        let q_6_ddot = t193 * (t20 * n(p.k39));
        let q_7_ddot = n(p.k39) * t197;
        let q_8_ddot = n(p.k40) * t197.neg_mul_add(t0 * n(p.k5), t200);
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
    let t13 = S::from_f64(0.5) * t12 + q_1_dot * (q_1_dot * p.k4);
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
    -((p.k0 * cos_q_8 + p.l * (cos_q_7 + t6) + t7) * p.k2 + cos_q_1 * p.k3)
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
    p.k31 * (cos_q_8 + (cos_q_7 + t0))
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
            k32: lanes(|p| p.k32),
            k33: lanes(|p| p.k33),
            k34: lanes(|p| p.k34),
            k35: lanes(|p| p.k35),
            k36: lanes(|p| p.k36),
            k37: lanes(|p| p.k37),
            k38: lanes(|p| p.k38),
            k39: lanes(|p| p.k39),
            k40: lanes(|p| p.k40),
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
        <::lagrangian::Lanes<N> as ::lagrangian::Number>::run_in_place(Accelerations { p, q, v }, result)
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
