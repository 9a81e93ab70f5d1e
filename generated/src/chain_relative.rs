// @generated from machines/chain_relative.machine by `cargo xtask generate`; edits are lost.

//! The chain once more, each angle measured from the bar before it. Same motion, other coordinates.
//!
//! 8 coordinates, 4 parameters. Arithmetic of one call:
//!
//! | function | mul | add | div | sin cos | other | temporaries |
//! | --- | --: | --: | --: | --: | --: | --: |
//! | `prepare` | 35 | 7 | 1 | 0 | 0 | 43 |
//! | `mass_matrix` | 126 | 103 | 0 | 8 | 0 | 245 |
//! | `bias` | 103 | 81 | 0 | 8 | 0 | 200 |
//! | `applied` | 9 | 21 | 0 | 8 | 0 | 38 |
//! | `forces` | 104 | 89 | 0 | 8 | 0 | 209 |
//! | `accelerations` | 294 | 197 | 7 | 8 | 0 | 514 |
//! | `kinetic_energy` | 88 | 61 | 0 | 8 | 0 | 165 |
//! | `potential_energy` | 22 | 28 | 0 | 8 | 0 | 58 |
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

/// The chain once more, each angle measured from the bar before it. Same motion, other coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ChainRelative<S = f64> {
    /// Length, mass and inertia (about its middle) of a bar. Unit: m. Default: 0.2.
    pub l: S,
    /// `m`. Unit: kg. Default: 0.5.
    pub m: S,
    /// `J`. Unit: kg*m^2. Default: 1/600.
    pub J: S,
    /// `g`. Unit: m/s^2. Default: 9.81.
    pub g: S,
}

impl Default for ChainRelative {
    fn default() -> Self {
        Self {
            l: 0.2,
            m: 0.5,
            J: 0.0016666666666666668,
            g: 9.81,
        }
    }
}

impl<S> ChainRelative<S> {
    /// The same over other numbers.
    pub fn map<R>(self, f: impl Fn(S) -> R) -> ChainRelative<R> {
        ChainRelative {
            l: f(self.l),
            m: f(self.m),
            J: f(self.J),
            g: f(self.g),
        }
    }
}

impl<S: ::lagrangian::Scalar> ChainRelative<S> {
    /// Computes what depends on the parameters alone, once.
    pub fn prepare(&self) -> Prepared<S> {
        let k4 = self.l * self.m;
        let k1 = self.l * k4;
        let t0 = self.g * k4;
        let k3 = S::from_f64(0.5) * t0;
        let t1 = k1 * S::from_f64(0.25);
        let k6 = self.J + t1;
        let k29 = self.J + k1 * S::from_f64(1.25);
        let k31 = S::ONE / k6;
        let k28 = t1 * k31;
        let k0 = self.l * S::from_f64(0.5);
        let k2 = self.m * self.g;
        let k5 = S::from_f64(0.125) * (k1 + self.J * S::from_f64(4.0));
        let k7 = S::from_f64(0.5) * k4;
        let k8 = self.m * S::from_f64(0.5);
        let k9 = k4 * S::from_f64(0.25);
        let k10 = t0 * S::from_f64(1.5);
        let k11 = t0 * S::from_f64(2.5);
        let k12 = t0 * S::from_f64(3.5);
        let k13 = t0 * S::from_f64(4.5);
        let k14 = t0 * S::from_f64(5.5);
        let k15 = t0 * S::from_f64(6.5);
        let k16 = t0 * S::from_f64(7.5);
        let k17 = S::from_f64(0.5) * k1;
        let k18 = k4 * S::from_f64(1.5);
        let k19 = k6 + k29;
        let k20 = k4 * S::from_f64(2.0);
        let k21 = k4 * S::from_f64(3.0);
        let k22 = k4 * S::from_f64(4.0);
        let k23 = k4 * S::from_f64(5.0);
        let k24 = k4 * S::from_f64(6.0);
        let k25 = self.J + k1 * S::from_f64(7.25);
        let k26 = -k3;
        let k27 = k1 * k28;
        let k30 = self.g * S::from_f64(0.5);
        let k32 = S::from_f64(0.25) * k31;
        let k33 = self.l * k1;
        let k34 = k1 * k1;
        let k35 = self.l * S::from_f64(0.25);
        let k36 = -k4;
        let singular = if vanishes(k6, k6, 7.105427357601002e-15) {
            Some(singular(7, k6, k6))
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
            singular,
        }
    }

    /// The start values of the description, at rest and `t = 0`.
    pub fn start(&self) -> ::lagrangian::State<Coordinates<S>> {
        let q_1 = S::from_ratio(1, 10);
        let q = [q_1, q_1, q_1, q_1, q_1, q_1, q_1, q_1];
        let v = [S::ZERO; 8];
        ::lagrangian::State {
            t: 0.0,
            q: Coordinates::from_array(q),
            v: Coordinates::from_array(v),
        }
    }
}

/// The coordinates of [`ChainRelative`], or their rates, by name.
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

/// What can be set while a [`ChainRelative`] runs.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Inputs {}

/// What can be observed of a [`ChainRelative`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Outputs {}

/// The parameters of a [`ChainRelative`], with the work done that depends on them alone.
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
    /// `l*m`
    k4: S,
    /// `0.125*(l^2*m + 4*J)`
    k5: S,
    /// `J + 0.25*l^2*m`
    k6: S,
    /// `0.5*l*m`
    k7: S,
    /// `0.5*m`
    k8: S,
    /// `0.25*l*m`
    k9: S,
    /// `1.5*l*m*g`
    k10: S,
    /// `2.5*l*m*g`
    k11: S,
    /// `3.5*l*m*g`
    k12: S,
    /// `4.5*l*m*g`
    k13: S,
    /// `5.5*l*m*g`
    k14: S,
    /// `6.5*l*m*g`
    k15: S,
    /// `7.5*l*m*g`
    k16: S,
    /// `0.5*l^2*m`
    k17: S,
    /// `1.5*l*m`
    k18: S,
    /// `J + J + 0.25*l^2*m + 1.25*l^2*m`
    k19: S,
    /// `2*l*m`
    k20: S,
    /// `3*l*m`
    k21: S,
    /// `4*l*m`
    k22: S,
    /// `5*l*m`
    k23: S,
    /// `6*l*m`
    k24: S,
    /// `J + 7.25*l^2*m`
    k25: S,
    /// `-0.5*l*m*g`
    k26: S,
    /// `0.25*l^4*m^2/(J + 0.25*l^2*m)`
    k27: S,
    /// `0.25*l^2*m/(J + 0.25*l^2*m)`
    k28: S,
    /// `J + 1.25*l^2*m`
    k29: S,
    /// `0.5*g`
    k30: S,
    /// `1/(J + 0.25*l^2*m)`
    k31: S,
    /// `0.25/(J + 0.25*l^2*m)`
    k32: S,
    /// `l^3*m`
    k33: S,
    /// `l^4*m^2`
    k34: S,
    /// `0.25*l`
    k35: S,
    /// `-l*m`
    k36: S,
    /// Why these parameters leave the machine without accelerations, if they do.
    singular: Option<::lagrangian::Singular>,
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
/// M[q[4], q[4]] = …
/// …
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
    let t0 = q_2 + q_1;
    let t1 = t0 + q_3;
    let t2 = t1 + q_4;
    let t3 = t2 + q_5;
    let t4 = t3 + q_6;
    let t5 = t4 + q_7;
    let t6 = t5 + q_8;
    let (sin_t6, cos_t6) = t6.sin_cos();
    let (sin_t5, cos_t5) = t5.sin_cos();
    let t7 = p.k7 * cos_t6 + p.k18 * cos_t5;
    let (sin_t4, cos_t4) = t4.sin_cos();
    let t8 = p.k7 * sin_t6 + p.k18 * sin_t5;
    let t9 = cos_t6 * cos_t5 + sin_t6 * sin_t5;
    let m77 = t9 * p.k1 + p.k19;
    let m76 = p.l * (cos_t4 * t7 + sin_t4 * t8) + m77;
    let t10 = cos_t4 * p.k20 + t7;
    let t11 = sin_t4 * p.k20 + t8;
    let m66 = p.l * (cos_t4 * t10 + sin_t4 * t11) + (m76 + p.k6);
    let t12 = p.k7 * cos_t4 + t10;
    let (sin_t3, cos_t3) = t3.sin_cos();
    let t13 = p.k7 * sin_t4 + t11;
    let m65 = p.l * (cos_t3 * t12 + sin_t3 * t13) + m66;
    let t14 = cos_t3 * p.k21 + t12;
    let t15 = sin_t3 * p.k21 + t13;
    let m55 = m65 + (p.k6 + p.l * (cos_t3 * t14 + sin_t3 * t15));
    let t16 = p.k7 * cos_t3 + t14;
    let (sin_t2, cos_t2) = t2.sin_cos();
    let t17 = p.k7 * sin_t3 + t15;
    let m54 = p.l * (cos_t2 * t16 + sin_t2 * t17) + m55;
    let t18 = cos_t2 * p.k22 + t16;
    let t19 = sin_t2 * p.k22 + t17;
    let m44 = m54 + (p.k6 + p.l * (cos_t2 * t18 + sin_t2 * t19));
    let t20 = p.k7 * cos_t2 + t18;
    let (sin_t1, cos_t1) = t1.sin_cos();
    let t21 = p.k7 * sin_t2 + t19;
    let m43 = p.l * (cos_t1 * t20 + sin_t1 * t21) + m44;
    let t22 = cos_t1 * p.k23 + t20;
    let t23 = sin_t1 * p.k23 + t21;
    let m33 = m43 + (p.k6 + p.l * (cos_t1 * t22 + sin_t1 * t23));
    let t24 = p.k7 * cos_t1 + t22;
    let (sin_t0, cos_t0) = t0.sin_cos();
    let t25 = p.k7 * sin_t1 + t23;
    let m32 = p.l * (t24 * cos_t0 + sin_t0 * t25) + m33;
    let t26 = t24 + cos_t0 * p.k24;
    let t27 = t25 + sin_t0 * p.k24;
    let m22 = m32 + (p.k6 + p.l * (cos_t0 * t26 + sin_t0 * t27));
    let (sin_q_1, cos_q_1) = q_1.sin_cos();
    let t28 = sin_q_1 * (sin_t0 * p.k17 + p.l * t27);
    let t29 = cos_q_1 * (cos_t0 * p.k17 + p.l * t26) + t28;
    let m42 = m43 + p.l * (t20 * cos_t0 + sin_t0 * t21);
    let m53 = m54 + p.l * (cos_t1 * t16 + sin_t1 * t17);
    let m52 = p.l * (t16 * cos_t0 + sin_t0 * t17) + m53;
    let m64 = m65 + p.l * (cos_t2 * t12 + sin_t2 * t13);
    let m63 = p.l * (cos_t1 * t12 + sin_t1 * t13) + m64;
    let m62 = p.l * (t12 * cos_t0 + sin_t0 * t13) + m63;
    let m75 = m76 + p.l * (cos_t3 * t7 + sin_t3 * t8);
    let m74 = p.l * (cos_t2 * t7 + sin_t2 * t8) + m75;
    let m73 = p.l * (cos_t1 * t7 + sin_t1 * t8) + m74;
    let m72 = p.l * (t7 * cos_t0 + sin_t0 * t8) + m73;
    let m87 = p.k6 + t9 * p.k17;
    let m86 = p.k17 * (cos_t4 * cos_t6 + sin_t4 * sin_t6) + m87;
    let m85 = p.k17 * (cos_t3 * cos_t6 + sin_t3 * sin_t6) + m86;
    let m84 = p.k17 * (cos_t2 * cos_t6 + sin_t2 * sin_t6) + m85;
    let m83 = p.k17 * (cos_t1 * cos_t6 + sin_t1 * sin_t6) + m84;
    let m82 = p.k17 * (cos_t6 * cos_t0 + sin_t6 * sin_t0) + m83;
    let m11 = t29 * S::from_f64(2.0) + (m22 + p.k25);
    let m21 = m22 + t29;
    let m31 = m32 + p.l * (t24 * cos_q_1 + t25 * sin_q_1);
    let m41 = p.l * (t20 * cos_q_1 + t21 * sin_q_1) + m42;
    let m51 = p.l * (t16 * cos_q_1 + t17 * sin_q_1) + m52;
    let m61 = p.l * (t12 * cos_q_1 + t13 * sin_q_1) + m62;
    let m71 = p.l * (t7 * cos_q_1 + t8 * sin_q_1) + m72;
    let m81 = p.k17 * (cos_t6 * cos_q_1 + sin_t6 * sin_q_1) + m82;
    [
        [m11, m21, m31, m41, m51, m61, m71, m81],
        [m21, m22, m32, m42, m52, m62, m72, m82],
        [m31, m32, m33, m43, m53, m63, m73, m83],
        [m41, m42, m43, m44, m54, m64, m74, m84],
        [m51, m52, m53, m54, m55, m65, m75, m85],
        [m61, m62, m63, m64, m65, m66, m76, m86],
        [m71, m72, m73, m74, m75, m76, m77, m87],
        [m81, m82, m83, m84, m85, m86, m87, p.k6],
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
/// h[q[8]] = …
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
    let t0 = q_2_dot + q_1_dot;
    let t1 = t0 + q_3_dot;
    let t2 = t1 * t1;
    let t3 = q_1 + q_2;
    let t4 = t3 + q_3;
    let (sin_t4, cos_t4) = t4.sin_cos();
    let t5 = t2 * cos_t4;
    let t6 = t0 * t0;
    let (sin_t3, cos_t3) = t3.sin_cos();
    let t7 = t6 * cos_t3;
    let t8 = q_1_dot * q_1_dot;
    let (sin_q_1, cos_q_1) = q_1.sin_cos();
    let t9 = cos_q_1 * t8;
    let t10 = t7 + t9;
    let t11 = t5 + t10;
    let t12 = t1 + q_4_dot;
    let t13 = t12 * t12;
    let t14 = t4 + q_4;
    let (sin_t14, cos_t14) = t14.sin_cos();
    let t15 = t13 * cos_t14;
    let t16 = t15 + t11;
    let t17 = t12 + q_5_dot;
    let t18 = t17 * t17;
    let t19 = t14 + q_5;
    let (sin_t19, cos_t19) = t19.sin_cos();
    let t20 = t18 * cos_t19;
    let t21 = t20 + t16;
    let t22 = t17 + q_6_dot;
    let t23 = t22 * t22;
    let t24 = t19 + q_6;
    let (sin_t24, cos_t24) = t24.sin_cos();
    let t25 = t23 * cos_t24;
    let t26 = t25 + t21;
    let t27 = t22 + q_7_dot;
    let t28 = t27 * t27;
    let t29 = t24 + q_7;
    let (sin_t29, cos_t29) = t29.sin_cos();
    let t30 = t28 * cos_t29;
    let t31 = t27 + q_8_dot;
    let t32 = t31 * (t31 * p.k0);
    let t33 = t29 + q_8;
    let (sin_t33, cos_t33) = t33.sin_cos();
    let t34 = t32 * cos_t33 + p.l * (t30 + t26);
    let t35 = p.k0 * t30 + p.l * t26;
    let t36 = t34 + t35;
    let t37 = p.k0 * t25 + p.l * t21;
    let t38 = t2 * sin_t4;
    let t39 = t6 * sin_t3;
    let t40 = sin_q_1 * t8;
    let t41 = t39 + t40;
    let t42 = t38 + t41;
    let t43 = t13 * sin_t14;
    let t44 = t43 + t42;
    let t45 = t18 * sin_t19;
    let t46 = t45 + t44;
    let t47 = t23 * sin_t24;
    let t48 = t47 + t46;
    let t49 = t28 * sin_t29;
    let t50 = t32 * sin_t33 + p.l * (t49 + t48);
    let t51 = p.k0 * t49 + p.l * t48;
    let t52 = t50 + t51;
    let t53 = p.k0 * t47 + p.l * t46;
    let t54 = sin_t24 * (p.m * t36 + t37 * p.k8) - cos_t24 * (p.m * t52 + t53 * p.k8);
    let t55 = sin_t29 * (p.m * t34 + t35 * p.k8) - cos_t29 * (p.m * t50 + t51 * p.k8);
    let h_q_8 = (sin_t33 * t34 - cos_t33 * t50) * p.k7;
    let h_q_7 = p.l * t55 + h_q_8;
    let h_q_6 = p.l * t54 + h_q_7;
    let t56 = t36 + t37;
    let t57 = p.k0 * t20 + p.l * t16;
    let t58 = t52 + t53;
    let t59 = p.k0 * t45 + p.l * t44;
    let t60 = sin_t19 * (p.m * t56 + t57 * p.k8) - cos_t19 * (p.m * t58 + t59 * p.k8);
    let h_q_5 = p.l * t60 + h_q_6;
    let t61 = t56 + t57;
    let t62 = p.k0 * t15 + p.l * t11;
    let t63 = t58 + t59;
    let t64 = p.k0 * t43 + p.l * t42;
    let t65 = sin_t14 * (p.m * t61 + t62 * p.k8) - cos_t14 * (p.m * t63 + t64 * p.k8);
    let h_q_4 = p.l * t65 + h_q_5;
    let t66 = t61 + t62;
    let t67 = p.k0 * t5 + p.l * t10;
    let t68 = t63 + t64;
    let t69 = p.k0 * t38 + p.l * t41;
    let t70 = sin_t4 * (p.m * t66 + t67 * p.k8) - cos_t4 * (p.m * t68 + t69 * p.k8);
    let h_q_3 = p.l * t70 + h_q_4;
    let t71 = p.m * (t66 + t67);
    let t72 = p.k0 * t7 + p.l * t9;
    let t73 = p.m * (t68 + t69);
    let t74 = p.k0 * t39 + p.l * t40;
    let t75 = p.l * (sin_t3 * (t71 + t72 * p.k8) - cos_t3 * (t73 + t74 * p.k8));
    let h_q_2 = t75 + h_q_3;
    let t76 = cos_q_1 * (t73 + (p.m * t74 + t40 * p.k9));
    let h_q_1 = p.l * (sin_q_1 * (t71 + (p.m * t72 + p.k9 * t9)) - t76) + h_q_2;
    [h_q_1, h_q_2, h_q_3, h_q_4, h_q_5, h_q_6, h_q_7, h_q_8]
}

/// Applied generalized forces `Q`.
///
/// ```text
/// Q[q[1]] = -15/2*l*m*g*sin(q[1]) - 13/2*l*m*g*sin(q[1] + q[2])
///     - 9/2*l*m*g*sin(q[4] + (q[3] + (q[1] + q[2])))
///     - 7/2*l*m*g*sin(q[5] + (q[4] + (q[3] + (q[1] + q[2]))))
///     - 5/2*l*m*g*sin(q[6] + (q[5] + (q[4] + (q[3] + (q[1] + q[2])))))
///     - 3/2*l*m*g*sin(q[7] + (q[6] + (q[5] + (q[4] + (q[3] + (q[1] + q[2]))))))
///     - 1/2*l*m*g*sin(q[8] + (q[7] + (q[6] + (q[5] + (q[4] + (q[3] + (q[1] + q[2])))))))
///     - 11/2*l*m*g*sin(q[1] + q[2] + q[3])
/// Q[q[2]] = -13/2*l*m*g*sin(q[1] + q[2]) - 9/2*l*m*g*sin(q[4] + (q[3] + (q[1] + q[2])))
///     - 7/2*l*m*g*sin(q[5] + (q[4] + (q[3] + (q[1] + q[2]))))
///     - 5/2*l*m*g*sin(q[6] + (q[5] + (q[4] + (q[3] + (q[1] + q[2])))))
///     - 3/2*l*m*g*sin(q[7] + (q[6] + (q[5] + (q[4] + (q[3] + (q[1] + q[2]))))))
///     - 1/2*l*m*g*sin(q[8] + (q[7] + (q[6] + (q[5] + (q[4] + (q[3] + (q[1] + q[2])))))))
///     - 11/2*l*m*g*sin(q[1] + q[2] + q[3])
/// Q[q[3]] = -9/2*l*m*g*sin(q[4] + (q[3] + (q[1] + q[2])))
///     - 7/2*l*m*g*sin(q[5] + (q[4] + (q[3] + (q[1] + q[2]))))
///     - 5/2*l*m*g*sin(q[6] + (q[5] + (q[4] + (q[3] + (q[1] + q[2])))))
///     - 3/2*l*m*g*sin(q[7] + (q[6] + (q[5] + (q[4] + (q[3] + (q[1] + q[2]))))))
///     - 1/2*l*m*g*sin(q[8] + (q[7] + (q[6] + (q[5] + (q[4] + (q[3] + (q[1] + q[2])))))))
///     - 11/2*l*m*g*sin(q[1] + q[2] + q[3])
/// Q[q[4]] = -9/2*l*m*g*sin(q[4] + (q[3] + (q[1] + q[2])))
///     - 7/2*l*m*g*sin(q[5] + (q[4] + (q[3] + (q[1] + q[2]))))
///     - 5/2*l*m*g*sin(q[6] + (q[5] + (q[4] + (q[3] + (q[1] + q[2])))))
///     - 3/2*l*m*g*sin(q[7] + (q[6] + (q[5] + (q[4] + (q[3] + (q[1] + q[2]))))))
///     - 1/2*l*m*g*sin(q[8] + (q[7] + (q[6] + (q[5] + (q[4] + (q[3] + (q[1] + q[2])))))))
/// Q[q[5]] = -7/2*l*m*g*sin(q[5] + (q[4] + (q[3] + (q[1] + q[2]))))
///     - 5/2*l*m*g*sin(q[6] + (q[5] + (q[4] + (q[3] + (q[1] + q[2])))))
///     - 3/2*l*m*g*sin(q[7] + (q[6] + (q[5] + (q[4] + (q[3] + (q[1] + q[2]))))))
///     - 1/2*l*m*g*sin(q[8] + (q[7] + (q[6] + (q[5] + (q[4] + (q[3] + (q[1] + q[2])))))))
/// Q[q[6]] = -5/2*l*m*g*sin(q[6] + (q[5] + (q[4] + (q[3] + (q[1] + q[2])))))
///     - 3/2*l*m*g*sin(q[7] + (q[6] + (q[5] + (q[4] + (q[3] + (q[1] + q[2]))))))
///     - 1/2*l*m*g*sin(q[8] + (q[7] + (q[6] + (q[5] + (q[4] + (q[3] + (q[1] + q[2])))))))
/// Q[q[7]] = -3/2*l*m*g*sin(q[7] + (q[6] + (q[5] + (q[4] + (q[3] + (q[1] + q[2]))))))
///     - 1/2*l*m*g*sin(q[8] + (q[7] + (q[6] + (q[5] + (q[4] + (q[3] + (q[1] + q[2])))))))
/// Q[q[8]] = -1/2*l*m*g*sin(q[8] + (q[7] + (q[6] + (q[5] + (q[4] + (q[3] + (q[1] + q[2])))))))
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
    let t0 = q_1 + q_2;
    let t1 = t0 + q_3;
    let t2 = t1 + q_4;
    let t3 = t2 + q_5;
    let t4 = t3 + q_6;
    let t5 = t4 + q_7;
    let t6 = t5 + q_8;
    let sin_t6 = t6.sin();
    let sin_t5 = t5.sin();
    let t7 = sin_t6 * p.k3 + p.k10 * sin_t5;
    let sin_t4 = t4.sin();
    let t8 = p.k11 * sin_t4 + t7;
    let sin_t3 = t3.sin();
    let t9 = p.k12 * sin_t3 + t8;
    let sin_t2 = t2.sin();
    let t10 = p.k13 * sin_t2 + t9;
    let sin_t1 = t1.sin();
    let t11 = p.k14 * sin_t1 + t10;
    let sin_t0 = t0.sin();
    let t12 = p.k15 * sin_t0 + t11;
    let sin_q_1 = q_1.sin();
    let q_q_1 = -(p.k16 * sin_q_1 + t12);
    let q_q_2 = -t12;
    let q_q_3 = -t11;
    let q_q_4 = -t10;
    let q_q_5 = -t9;
    let q_q_6 = -t8;
    let q_q_7 = -t7;
    let q_q_8 = sin_t6 * p.k26;
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
    let t0 = q_2_dot + q_1_dot;
    let t1 = t0 + q_3_dot;
    let t2 = t1 * t1;
    let t3 = q_1 + q_2;
    let t4 = t3 + q_3;
    let (sin_t4, cos_t4) = t4.sin_cos();
    let t5 = t2 * sin_t4;
    let t6 = t0 * t0;
    let (sin_t3, cos_t3) = t3.sin_cos();
    let t7 = t6 * sin_t3;
    let t8 = q_1_dot * q_1_dot;
    let (sin_q_1, cos_q_1) = q_1.sin_cos();
    let t9 = sin_q_1 * t8;
    let t10 = t7 + t9;
    let t11 = t5 + t10;
    let t12 = t1 + q_4_dot;
    let t13 = t12 * t12;
    let t14 = t4 + q_4;
    let (sin_t14, cos_t14) = t14.sin_cos();
    let t15 = t13 * sin_t14;
    let t16 = t15 + t11;
    let t17 = t12 + q_5_dot;
    let t18 = t17 * t17;
    let t19 = t14 + q_5;
    let (sin_t19, cos_t19) = t19.sin_cos();
    let t20 = t18 * sin_t19;
    let t21 = t20 + t16;
    let t22 = t17 + q_6_dot;
    let t23 = t22 * t22;
    let t24 = t19 + q_6;
    let (sin_t24, cos_t24) = t24.sin_cos();
    let t25 = t23 * sin_t24;
    let t26 = t25 + t21;
    let t27 = t22 + q_7_dot;
    let t28 = t27 * t27;
    let t29 = t24 + q_7;
    let (sin_t29, cos_t29) = t29.sin_cos();
    let t30 = t28 * sin_t29;
    let t31 = t27 + q_8_dot;
    let t32 = t31 * (t31 * p.k0);
    let t33 = t29 + q_8;
    let (sin_t33, cos_t33) = t33.sin_cos();
    let t34 = t32 * sin_t33 + p.l * (t30 + t26);
    let t35 = p.k0 * t30 + p.l * t26;
    let t36 = t34 + t35;
    let t37 = p.k0 * t25 + p.l * t21;
    let t38 = t2 * cos_t4;
    let t39 = t6 * cos_t3;
    let t40 = cos_q_1 * t8;
    let t41 = t39 + t40;
    let t42 = t38 + t41;
    let t43 = t13 * cos_t14;
    let t44 = t43 + t42;
    let t45 = t18 * cos_t19;
    let t46 = t45 + t44;
    let t47 = t23 * cos_t24;
    let t48 = t47 + t46;
    let t49 = t28 * cos_t29;
    let t50 = p.g + (t32 * cos_t33 + p.l * (t49 + t48));
    let t51 = p.g + (p.k0 * t49 + p.l * t48);
    let t52 = t50 + t51;
    let t53 = p.g + (p.k0 * t47 + p.l * t46);
    let t54 = cos_t24 * (p.m * t36 + p.k8 * t37) - sin_t24 * (p.m * t52 + t53 * p.k8);
    let t55 = cos_t29 * (p.m * t34 + p.k8 * t35) - sin_t29 * (p.m * t50 + t51 * p.k8);
    let f_q_8 = (cos_t33 * t34 - sin_t33 * t50) * p.k7;
    let f_q_7 = p.l * t55 + f_q_8;
    let f_q_6 = p.l * t54 + f_q_7;
    let t56 = t36 + t37;
    let t57 = p.k0 * t20 + p.l * t16;
    let t58 = t52 + t53;
    let t59 = p.g + (p.k0 * t45 + p.l * t44);
    let t60 = cos_t19 * (p.m * t56 + p.k8 * t57) - sin_t19 * (p.m * t58 + t59 * p.k8);
    let f_q_5 = p.l * t60 + f_q_6;
    let t61 = t56 + t57;
    let t62 = p.k0 * t15 + p.l * t11;
    let t63 = t58 + t59;
    let t64 = p.g + (p.k0 * t43 + p.l * t42);
    let t65 = cos_t14 * (p.m * t61 + p.k8 * t62) - sin_t14 * (p.m * t63 + t64 * p.k8);
    let f_q_4 = p.l * t65 + f_q_5;
    let t66 = t61 + t62;
    let t67 = p.k0 * t5 + p.l * t10;
    let t68 = t63 + t64;
    let t69 = p.g + (p.k0 * t38 + p.l * t41);
    let t70 = cos_t4 * (p.m * t66 + p.k8 * t67) - sin_t4 * (p.m * t68 + t69 * p.k8);
    let f_q_3 = p.l * t70 + f_q_4;
    let t71 = p.m * (t66 + t67);
    let t72 = p.k0 * t7 + p.l * t9;
    let t73 = p.m * (t68 + t69);
    let t74 = p.g + (p.k0 * t39 + p.l * t40);
    let t75 = p.l * (cos_t3 * (t71 + p.k8 * t72) - sin_t3 * (t73 + t74 * p.k8));
    let f_q_2 = t75 + f_q_3;
    let t76 = sin_q_1 * (t73 + (p.m * t74 + p.k8 * (p.g + p.k0 * t40)));
    let f_q_1 = p.l * (cos_q_1 * (t71 + (p.m * t72 + t9 * p.k9)) - t76) + f_q_2;
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
        let t0 = q_2 + q_1;
        let t1 = t0 + q_3;
        let t2 = t1 + q_4;
        let t3 = t2 + q_5;
        let t4 = t3 + q_6;
        let t5 = t4 + q_7;
        let t6 = t5 + q_8;
        let angles = [t6, t5, t4, t3, t2, t1, t0, q_1];
        let circular = N::sin_cos_all(angles);
        let (sin_t6, cos_t6) = circular[0];
        let (sin_t5, cos_t5) = circular[1];
        let (sin_t4, cos_t4) = circular[2];
        let (sin_t3, cos_t3) = circular[3];
        let (sin_t2, cos_t2) = circular[4];
        let (sin_t1, cos_t1) = circular[5];
        let (sin_t0, cos_t0) = circular[6];
        let (sin_q_1, cos_q_1) = circular[7];
        let t7 = cos_t6.mul_add(cos_t5, sin_t6 * sin_t5);
        let t8 = t7.neg_mul_add(t7 * n(p.k27), n(p.k29));
        check(t8, t8, 7.105427357601002e-15, 6)?;
        let t9 = N::ONE / t8;
        let t10 = sin_t6 * n(p.k28);
        let t11 = t7.neg_mul_add(t10, sin_t5 * N::from_f64(1.5));
        let t12 = cos_t6 * n(p.k28);
        let t13 = t7.neg_mul_add(t12, cos_t5 * N::from_f64(1.5));
        let t14 = t9.mul_add(t11 * t13, cos_t6 * (sin_t6 * n(p.k32)));
        let t15 = n(p.k1) * sin_t4;
        let t16 = n(p.k1) * t9;
        let t17 = t13 * t16;
        let t18 = cos_t6.neg_mul_add(t12, N::from_f64(2.0));
        let t19 = t13.neg_mul_add(t17, t18);
        let t20 = cos_t4.mul_sub(t19, t15 * t14);
        let t21 = n(p.k1) * cos_t4;
        let t22 = t11 * t16;
        let t23 = sin_t6.neg_mul_add(t10, N::from_f64(2.0));
        let t24 = t11.neg_mul_add(t22, t23);
        let t25 = sin_t4.mul_sub(t24, t21 * t14);
        let t26 = t21.mul_add(t20, t15.mul_add(t25, n(p.k6)));
        check(t26, t26, 7.105427357601002e-15, 5)?;
        let t27 = N::ONE / t26;
        let t28 = sin_t4.mul_add(N::from_f64(0.5), t25);
        let t29 = cos_t4.mul_add(N::from_f64(0.5), t20);
        let t30 = t27.mul_add(t28 * t29, t14);
        let t31 = n(p.k1) * sin_t3;
        let t32 = n(p.k1) * t27;
        let t33 = t29 * t32;
        let t34 = t29.neg_mul_add(t33, N::ONE + t19);
        let t35 = cos_t3.mul_sub(t34, t31 * t30);
        let t36 = n(p.k1) * cos_t3;
        let t37 = t28 * t32;
        let t38 = t28.neg_mul_add(t37, N::ONE + t24);
        let t39 = sin_t3.mul_sub(t38, t36 * t30);
        let t40 = t36.mul_add(t35, t31.mul_add(t39, n(p.k6)));
        check(t40, t40, 7.105427357601002e-15, 4)?;
        let t41 = N::ONE / t40;
        let t42 = sin_t3.mul_add(N::from_f64(0.5), t39);
        let t43 = cos_t3.mul_add(N::from_f64(0.5), t35);
        let t44 = t41.mul_add(t42 * t43, t30);
        let t45 = n(p.k1) * sin_t2;
        let t46 = n(p.k1) * t41;
        let t47 = t43 * t46;
        let t48 = t43.neg_mul_add(t47, N::ONE + t34);
        let t49 = cos_t2.mul_sub(t48, t45 * t44);
        let t50 = n(p.k1) * cos_t2;
        let t51 = t42 * t46;
        let t52 = t42.neg_mul_add(t51, N::ONE + t38);
        let t53 = sin_t2.mul_sub(t52, t50 * t44);
        let t54 = t50.mul_add(t49, t45.mul_add(t53, n(p.k6)));
        check(t54, t54, 7.105427357601002e-15, 3)?;
        let t55 = N::ONE / t54;
        let t56 = sin_t2.mul_add(N::from_f64(0.5), t53);
        let t57 = cos_t2.mul_add(N::from_f64(0.5), t49);
        let t58 = t55.mul_add(t56 * t57, t44);
        let t59 = n(p.k1) * sin_t1;
        let t60 = n(p.k1) * t55;
        let t61 = t57 * t60;
        let t62 = t57.neg_mul_add(t61, N::ONE + t48);
        let t63 = cos_t1.mul_sub(t62, t59 * t58);
        let t64 = n(p.k1) * cos_t1;
        let t65 = t56 * t60;
        let t66 = t56.neg_mul_add(t65, N::ONE + t52);
        let t67 = sin_t1.mul_sub(t66, t64 * t58);
        let t68 = t64.mul_add(t63, t59.mul_add(t67, n(p.k6)));
        check(t68, t68, 7.105427357601002e-15, 2)?;
        let t69 = N::ONE / t68;
        let t70 = sin_t1.mul_add(N::from_f64(0.5), t67);
        let t71 = cos_t1.mul_add(N::from_f64(0.5), t63);
        let t72 = t69.mul_add(t70 * t71, t58);
        let t73 = t72 * n(p.k33);
        let t74 = q_1_dot + q_2_dot;
        let t75 = t74 * t74;
        let t76 = sin_t0 * t75;
        let t77 = q_1_dot * q_1_dot;
        let t78 = sin_q_1 * t77;
        let t79 = t76 + t78;
        let t80 = t58 * n(p.k33);
        let t81 = t74 + q_3_dot;
        let t82 = t81 * t81;
        let t83 = sin_t1 * t82;
        let t84 = t44 * n(p.k33);
        let t85 = t81 + q_4_dot;
        let t86 = t85 * t85;
        let t87 = sin_t2 * t86;
        let t88 = t30 * n(p.k33);
        let t89 = t85 + q_5_dot;
        let t90 = t89 * t89;
        let t91 = sin_t3 * t90;
        let t92 = t14 * n(p.k33);
        let t93 = t89 + q_6_dot;
        let t94 = t93 * t93;
        let t95 = sin_t4 * t94;
        let t96 = t93 + q_7_dot;
        let t97 = t96 * t96;
        let t98 = n(p.l) * t97;
        let t99 = t96 + q_8_dot;
        let t100 = t99 * (n(p.k0) * t99);
        let t101 = n(p.g) + cos_t6.mul_add(t100, cos_t5 * t98);
        let t102 = sin_t6.mul_add(t100, sin_t5 * t98);
        let t103 = cos_t5.neg_mul_add(t102, sin_t5 * n(p.k30));
        let t104 = sin_t6.mul_sub(t101, cos_t6 * t102);
        let t105 = sin_t5.mul_add(t101, t103);
        let t106 = t104.neg_mul_add(t7 * n(p.k28), t105);
        let t107 = n(p.k0) * t97;
        let t108 = t10.neg_mul_add(t104, t101 + cos_t5.mul_add(t107, n(p.g)));
        let t109 = n(p.l) * t94;
        let t110 = cos_t4 * t109;
        let t111 = t92.mul_add(t95, t22.neg_mul_add(t106, t108));
        let t112 = t24.mul_add(t110, t111);
        let t113 = cos_t4 * t94;
        let t114 = t12.mul_add(t104, sin_t5.mul_add(t107, t102));
        let t115 = sin_t4 * t109;
        let t116 = t113.mul_add(t92, t17.mul_add(t106, t114));
        let t117 = t19.mul_add(t115, t116);
        let t118 = sin_t4.mul_add(t112, sin_t4 * n(p.k30));
        let t119 = cos_t4.neg_mul_add(t117, t118);
        let t120 = t112 + n(p.k0).mul_add(t113, n(p.g));
        let t121 = n(p.l) * t90;
        let t122 = cos_t3 * t121;
        let t123 = t88.mul_add(t91, t37.neg_mul_add(t119, t120));
        let t124 = t38.mul_add(t122, t123);
        let t125 = cos_t3 * t90;
        let t126 = t33.mul_add(t119, n(p.k0).mul_add(t95, t117));
        let t127 = sin_t3 * t121;
        let t128 = t34.mul_add(t127, t125.mul_add(t88, t126));
        let t129 = sin_t3.mul_add(t124, sin_t3 * n(p.k30));
        let t130 = cos_t3.neg_mul_add(t128, t129);
        let t131 = t124 + n(p.k0).mul_add(t125, n(p.g));
        let t132 = n(p.l) * t86;
        let t133 = cos_t2 * t132;
        let t134 = t84.mul_add(t87, t51.neg_mul_add(t130, t131));
        let t135 = t52.mul_add(t133, t134);
        let t136 = cos_t2 * t86;
        let t137 = t47.mul_add(t130, n(p.k0).mul_add(t91, t128));
        let t138 = sin_t2 * t132;
        let t139 = t48.mul_add(t138, t136.mul_add(t84, t137));
        let t140 = sin_t2.mul_add(t135, sin_t2 * n(p.k30));
        let t141 = cos_t2.neg_mul_add(t139, t140);
        let t142 = t135 + n(p.k0).mul_add(t136, n(p.g));
        let t143 = n(p.l) * t82;
        let t144 = cos_t1 * t143;
        let t145 = t80.mul_add(t83, t65.neg_mul_add(t141, t142));
        let t146 = t66.mul_add(t144, t145);
        let t147 = cos_t1 * t82;
        let t148 = t61.mul_add(t141, n(p.k0).mul_add(t87, t139));
        let t149 = sin_t1 * t143;
        let t150 = t62.mul_add(t149, t147.mul_add(t80, t148));
        let t151 = sin_t1.mul_add(t146, sin_t1 * n(p.k30));
        let t152 = cos_t1.neg_mul_add(t150, t151);
        let t153 = n(p.k1) * t69;
        let t154 = t70 * t153;
        let t155 = t146 + n(p.k0).mul_add(t147, n(p.g));
        let t156 = t70.neg_mul_add(t154, N::ONE + t66);
        let t157 = cos_t0 * t75;
        let t158 = cos_q_1 * t77;
        let t159 = t158 + t157;
        let t160 = n(p.l) * t159;
        let t161 = t79.mul_add(t73, t154.neg_mul_add(t152, t155));
        let t162 = t156.mul_add(t160, t161);
        let t163 = N::from_f64(0.5) * sin_q_1;
        let t164 = t158.mul_add(n(p.k0), n(p.g));
        let t165 = n(p.k0).mul_add(t76, t78 * n(p.l));
        let t166 = t163.mul_sub(t164, t158 * (sin_q_1 * n(p.k35)));
        let t167 = n(p.g) + n(p.k0).mul_add(t157, t158 * n(p.l));
        let t168 = sin_q_1.mul_add(t167, cos_q_1.neg_mul_add(t165, t166));
        let t169 = t71 * t153;
        let t170 = t169.mul_add(t152, n(p.k0).mul_add(t83, t150));
        let t171 = t71.neg_mul_add(t169, N::ONE + t62);
        let t172 = n(p.l) * t79;
        let t173 = t171.mul_add(t172, t73.mul_add(t159, t170));
        let t174 = N::from_f64(0.5) * cos_t0;
        let t175 = t167.mul_sub(N::from_f64(0.5) * sin_t0, t174 * t165);
        let t176 = cos_t0.neg_mul_add(t173, sin_t0.mul_add(t162, t175));
        let t177 = n(p.k1) * t72;
        let t178 = cos_t0.mul_sub(t171, t177 * sin_t0);
        let t179 = sin_t0.mul_sub(t156, t177 * cos_t0);
        let t180 = t174.mul_add(cos_q_1, sin_t0 * t163);
        let t181 = t178.mul_add(cos_q_1, t179.mul_add(sin_q_1, t180));
        let t182 = t179.mul_add(n(p.k1) * sin_t0, n(p.k6));
        let t183 = t178.mul_add(n(p.k1) * cos_t0, t182);
        check(t183, t183, 7.105427357601002e-15, 1)?;
        let t184 = N::ONE / t183;
        let t185 = n(p.k1) * t184;
        let t186 = cos_q_1.neg_mul_add(t173, sin_q_1.mul_add(t162, t168));
        let t187 = t156.mul_sub(sin_q_1, t177 * cos_q_1);
        let t188 = t187.mul_add(n(p.k1) * sin_q_1, n(p.k29));
        let t189 = t171.mul_sub(cos_q_1, t177 * sin_q_1);
        let t190 = t189.mul_add(n(p.k1) * cos_q_1, t188);
        let t191 = t184.neg_mul_add(t181 * (t181 * n(p.k34)), t190);
        check(t191, t191, 7.105427357601002e-15, 0)?;
        let t192 = N::ONE / t191 * t185.neg_mul_add(t181 * t176, t186);
        let t193 = n(p.k1) * t192;
        let t194 = t181.neg_mul_add(t193, t176);
        let t195 = t184 * t194;
        let t196 = t185 * t194;
        let t197 = sin_t0.neg_mul_add(t196, sin_q_1.neg_mul_add(t193, t160));
        let t198 = cos_t0.mul_add(t196, cos_q_1.mul_add(t193, t172));
        let t199 = t71.neg_mul_add(t198, t70.mul_add(t197, t152));
        let t200 = t69 * t199;
        let t201 = t153 * t199;
        let t202 = sin_t1.neg_mul_add(t201, t144 + t197);
        let t203 = cos_t1.mul_add(t201, t149 + t198);
        let t204 = t57.neg_mul_add(t203, t56.mul_add(t202, t141));
        let t205 = t55 * t204;
        let t206 = t60 * t204;
        let t207 = sin_t2.neg_mul_add(t206, t133 + t202);
        let t208 = cos_t2.mul_add(t206, t138 + t203);
        let t209 = t43.neg_mul_add(t208, t42.mul_add(t207, t130));
        let t210 = t41 * t209;
        let t211 = t46 * t209;
        let t212 = sin_t3.neg_mul_add(t211, t122 + t207);
        let t213 = cos_t3.mul_add(t211, t127 + t208);
        let t214 = t29.neg_mul_add(t213, t28.mul_add(t212, t119));
        let t215 = t27 * t214;
        let t216 = t32 * t214;
        let t217 = sin_t4.neg_mul_add(t216, t110 + t212);
        let t218 = cos_t4.mul_add(t216, t115 + t213);
        let t219 = t9 * t13.neg_mul_add(t218, t11.mul_add(t217, t106));
        let t220 = sin_t6 * N::from_f64(0.5);
        let t221 = t217.mul_add(t220, N::from_f64(0.5) * t104);
        let t222 = t218.neg_mul_add(cos_t6 * N::from_f64(0.5), t221);
        let t223 = t219.neg_mul_add(t7 * n(p.k17), t222);
        let q_1_ddot = t192 * n(p.k36);
        let q_2_ddot = n(p.k4) * (t192 - t195);
        let q_3_ddot = n(p.k36) * (t200 - t195);
        let q_4_ddot = n(p.k36) * (t205 - t200);
        let q_5_ddot = n(p.k36) * (t210 - t205);
        let q_6_ddot = n(p.k36) * (t215 - t210);
        let q_7_ddot = n(p.k36) * (t219 - t215);
        let q_8_ddot = n(p.k4) * t223.neg_mul_add(n(p.k31), t219);
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
    let t0 = q_2_dot + q_1_dot;
    let t1 = t0 + q_3_dot;
    let t2 = q_2 + q_1;
    let t3 = t2 + q_3;
    let (sin_t3, cos_t3) = t3.sin_cos();
    let t4 = t1 * sin_t3;
    let (sin_t2, cos_t2) = t2.sin_cos();
    let t5 = t0 * sin_t2;
    let (sin_q_1, cos_q_1) = q_1.sin_cos();
    let t6 = t5 + q_1_dot * sin_q_1;
    let t7 = t4 + t6;
    let t8 = t1 + q_4_dot;
    let t9 = t3 + q_4;
    let (sin_t9, cos_t9) = t9.sin_cos();
    let t10 = t8 * sin_t9;
    let t11 = p.k0 * t10 + p.l * t7;
    let t12 = t1 * cos_t3;
    let t13 = t0 * cos_t2;
    let t14 = t13 + q_1_dot * cos_q_1;
    let t15 = t12 + t14;
    let t16 = t8 * cos_t9;
    let t17 = p.k0 * t16 + p.l * t15;
    let t18 = p.k0 * t4 + p.l * t6;
    let t19 = p.k0 * t12 + p.l * t14;
    let t20 = q_1_dot * p.l;
    let t21 = p.k0 * t5 + sin_q_1 * t20;
    let t22 = p.k0 * t13 + cos_q_1 * t20;
    let t23 = S::from_f64(0.5) * (p.m * (t21 * t21 + t22 * t22) + t0 * (t0 * p.J));
    let t24 = S::from_f64(0.5) * (p.m * (t18 * t18 + t19 * t19) + t1 * (t1 * p.J));
    let t25 = S::from_f64(0.5) * (p.m * (t11 * t11 + t17 * t17) + t8 * (t8 * p.J));
    let t26 = t10 + t7;
    let t27 = t8 + q_5_dot;
    let t28 = t9 + q_5;
    let (sin_t28, cos_t28) = t28.sin_cos();
    let t29 = t27 * sin_t28;
    let t30 = p.k0 * t29 + p.l * t26;
    let t31 = t16 + t15;
    let t32 = t27 * cos_t28;
    let t33 = p.k0 * t32 + p.l * t31;
    let t34 = S::from_f64(0.5) * (p.m * (t30 * t30 + t33 * t33) + t27 * (t27 * p.J));
    let t35 = t29 + t26;
    let t36 = t27 + q_6_dot;
    let t37 = t28 + q_6;
    let (sin_t37, cos_t37) = t37.sin_cos();
    let t38 = t36 * sin_t37;
    let t39 = p.k0 * t38 + p.l * t35;
    let t40 = t32 + t31;
    let t41 = t36 * cos_t37;
    let t42 = p.k0 * t41 + p.l * t40;
    let t43 = S::from_f64(0.5) * (p.m * (t39 * t39 + t42 * t42) + t36 * (t36 * p.J));
    let t44 = t38 + t35;
    let t45 = t36 + q_7_dot;
    let t46 = t37 + q_7;
    let (sin_t46, cos_t46) = t46.sin_cos();
    let t47 = t45 * sin_t46;
    let t48 = p.k0 * t47 + p.l * t44;
    let t49 = t41 + t40;
    let t50 = t45 * cos_t46;
    let t51 = p.k0 * t50 + p.l * t49;
    let t52 = S::from_f64(0.5) * (p.m * (t48 * t48 + t51 * t51) + t45 * (t45 * p.J));
    let t53 = t45 + q_8_dot;
    let t54 = t53 * p.k0;
    let t55 = t46 + q_8;
    let (sin_t55, cos_t55) = t55.sin_cos();
    let t56 = t54 * sin_t55 + p.l * (t47 + t44);
    let t57 = t54 * cos_t55 + p.l * (t50 + t49);
    let t58 = t52 + (t43 + (t34 + (t25 + (t24 + (t23 + q_1_dot * (q_1_dot * p.k5))))));
    let t59 = S::from_f64(0.5) * (p.m * (t56 * t56 + t57 * t57) + t53 * (t53 * p.J));
    t59 + t58
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
    let t0 = q_2 + q_1;
    let t1 = t0 + q_3;
    let cos_t1 = t1.cos();
    let cos_t0 = t0.cos();
    let cos_q_1 = q_1.cos();
    let t2 = cos_t0 + cos_q_1;
    let t3 = p.k2 * (p.k0 * cos_t0 + p.l * cos_q_1) + cos_q_1 * p.k3;
    let t4 = cos_t1 + t2;
    let t5 = t1 + q_4;
    let cos_t5 = t5.cos();
    let t6 = p.k2 * (p.k0 * cos_t1 + p.l * t2) + t3;
    let t7 = cos_t5 + t4;
    let t8 = t5 + q_5;
    let cos_t8 = t8.cos();
    let t9 = p.k2 * (p.k0 * cos_t5 + p.l * t4) + t6;
    let t10 = cos_t8 + t7;
    let t11 = t8 + q_6;
    let cos_t11 = t11.cos();
    let t12 = p.k2 * (p.k0 * cos_t8 + p.l * t7) + t9;
    let t13 = cos_t11 + t10;
    let t14 = t11 + q_7;
    let cos_t14 = t14.cos();
    let t15 = p.k2 * (p.k0 * cos_t11 + p.l * t10) + t12;
    let t16 = t14 + q_8;
    let cos_t16 = t16.cos();
    let t17 = p.k2 * (p.k0 * cos_t16 + p.l * (cos_t14 + t13));
    -(t17 + (p.k2 * (p.k0 * cos_t14 + p.l * t13) + t15))
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
const OUTPUTS: [(&str, &str); 0] = [];

impl ::lagrangian::Machine for ChainRelative {
    type System = Prepared;

    fn name(&self) -> &str {
        "ChainRelative"
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
        _: &Outputs,
    ) -> impl ExactSizeIterator<Item = (::lagrangian::Quantity<'_>, f64)> {
        let values = [];
        quantities(&OUTPUTS, values)
    }

    fn outputs(&self, _: f64, _: &[f64; 8], _: &[f64; 8], _: &[f64; 8], _: &Inputs) -> Outputs {
        Outputs {}
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
