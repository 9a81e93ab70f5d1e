// @generated from machines/chain_relative.machine by `cargo xtask generate`; edits are lost.

//! The chain once more, each angle measured from the bar before it. Same motion, other coordinates.
//!
//! 8 coordinates, 4 parameters. Arithmetic of one call:
//!
//! | function | mul | add | div | sin cos | other | temporaries |
//! | --- | --: | --: | --: | --: | --: | --: |
//! | `prepare` | 38 | 7 | 1 | 0 | 0 | 46 |
//! | `mass_matrix` | 126 | 103 | 0 | 8 | 0 | 245 |
//! | `bias` | 103 | 81 | 0 | 8 | 0 | 200 |
//! | `applied` | 9 | 21 | 0 | 8 | 0 | 38 |
//! | `forces` | 104 | 89 | 0 | 8 | 0 | 209 |
//! | `accelerations` | 324 | 207 | 7 | 8 | 0 | 554 |
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
    /// Length, mass and inertia (about its middle) of a bar. Unit: `m`. Default: 0.2.
    pub l: S,
    /// `m`. Unit: `kg`. Default: 0.5.
    pub m: S,
    /// `J`. Unit: `kg*m^2`. Default: 1/600.
    pub J: S,
    /// `g`. Unit: `m/s^2`. Default: 9.81.
    pub g: S,
}

impl<S: ::lagrangian::emitted::Scalar> ChainRelative<S> {
    /// Computes what depends on the parameters alone, once.
    pub fn prepare(&self) -> Prepared<S> {
        let k4 = self.l * self.m;
        let t0 = self.l * self.l;
        let k1 = self.l * k4;
        let t1 = self.g * k4;
        let k7 = S::from_f64(0.5) * k4;
        let t2 = k1 * S::from_f64(0.25);
        let k3 = S::from_f64(0.5) * t1;
        let k32 = self.J + k1 * S::from_f64(1.25);
        let k6 = self.J + t2;
        let t3 = S::ONE / k6;
        let t4 = S::from_f64(0.25) * t3;
        let k0 = self.l * S::from_f64(0.5);
        let k2 = self.m * self.g;
        let k5 = S::from_f64(0.125) * (k1 + self.J * S::from_f64(4.0));
        let k8 = self.m * S::from_f64(0.5);
        let k9 = k4 * S::from_f64(0.25);
        let k10 = t1 * S::from_f64(1.5);
        let k11 = t1 * S::from_f64(2.5);
        let k12 = t1 * S::from_f64(3.5);
        let k13 = t1 * S::from_f64(4.5);
        let k14 = t1 * S::from_f64(5.5);
        let k15 = t1 * S::from_f64(6.5);
        let k16 = t1 * S::from_f64(7.5);
        let k17 = S::from_f64(0.5) * k1;
        let k18 = k4 * S::from_f64(1.5);
        let k19 = k6 + k32;
        let k20 = k4 * S::from_f64(2.0);
        let k21 = k4 * S::from_f64(3.0);
        let k22 = k4 * S::from_f64(4.0);
        let k23 = k4 * S::from_f64(5.0);
        let k24 = k4 * S::from_f64(6.0);
        let k25 = self.J + k1 * S::from_f64(7.25);
        let k26 = -k3;
        let k27 = k1 * t4;
        let k28 = self.J - t2;
        let k29 = t4 * t0;
        let k30 = S::from_f64(0.5) * t0;
        let k31 = self.m * self.m;
        let k33 = self.m * S::from_f64(1.5);
        let k34 = t4 * (k4 * k4);
        let k35 = k7 * t3;
        let pivots = [(7, k6, k6)];
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
            singular: PIVOTS.vanished(pivots),
        }
    }

    /// The start values of the description, at rest and `t = 0`.
    pub fn start(&self) -> ::lagrangian::emitted::State<Coordinates<S>> {
        let q_1 = S::from_ratio(1, 10);
        let q = [q_1, q_1, q_1, q_1, q_1, q_1, q_1, q_1];
        let v = [S::ZERO; 8];
        ::lagrangian::emitted::State {
            t: 0.0,
            q: Coordinates::from_array(q),
            v: Coordinates::from_array(v),
        }
    }
}

/// The coordinates of [`ChainRelative`], or their rates, by name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coordinates<S = f64> {
    /// `q`. Unit: `rad`. Members: `q[1]` to `q[8]`.
    pub q: [S; 8],
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
    /// `0.25*l^2*m/(J + 0.25*l^2*m)`
    k27: S,
    /// `J - 0.25*l^2*m`
    k28: S,
    /// `0.25*l^2/(J + 0.25*l^2*m)`
    k29: S,
    /// `0.5*l^2`
    k30: S,
    /// `m^2`
    k31: S,
    /// `J + 1.25*l^2*m`
    k32: S,
    /// `1.5*m`
    k33: S,
    /// `0.25*l^2*m^2/(J + 0.25*l^2*m)`
    k34: S,
    /// `0.5*l*m/(J + 0.25*l^2*m)`
    k35: S,
    /// Why these parameters leave the machine without accelerations, if they do.
    singular: Option<::lagrangian::emitted::Singular>,
}

/// A pivot of an elimination that is not above this share of its diagonal element may be rounding
/// errors alone.
const PIVOTS: ::lagrangian::emitted::Pivots = ::lagrangian::emitted::Pivots {
    coordinates: 8,
    tolerance: 7.105427357601002e-15,
};

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
/// M[q[4], q[4]] = …
/// …
/// ```
pub fn mass_matrix<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 8]) -> [[S; 8]; 8] {
    let q_1 = q[0];
    let q_2 = q[1];
    let q_3 = q[2];
    let q_4 = q[3];
    let q_5 = q[4];
    let q_6 = q[5];
    let q_7 = q[6];
    let q_8 = q[7];
    let t0 = q_2 + q_1;
    let (sin_q_1, cos_q_1) = q_1.sin_cos();
    let t1 = t0 + q_3;
    let (sin_t0, cos_t0) = t0.sin_cos();
    let t2 = t1 + q_4;
    let (sin_t1, cos_t1) = t1.sin_cos();
    let t3 = t2 + q_5;
    let (sin_t2, cos_t2) = t2.sin_cos();
    let t4 = t3 + q_6;
    let (sin_t3, cos_t3) = t3.sin_cos();
    let t5 = t4 + q_7;
    let (sin_t4, cos_t4) = t4.sin_cos();
    let t6 = t5 + q_8;
    let (sin_t5, cos_t5) = t5.sin_cos();
    let (sin_t6, cos_t6) = t6.sin_cos();
    let t7 = p.k7 * sin_t6 + p.k18 * sin_t5;
    let t8 = p.k7 * cos_t6 + p.k18 * cos_t5;
    let t9 = cos_t6 * cos_t5 + sin_t6 * sin_t5;
    let t10 = sin_t4 * p.k20 + t7;
    let t11 = cos_t4 * p.k20 + t8;
    let m77 = t9 * p.k1 + p.k19;
    let t12 = p.k7 * sin_t4 + t10;
    let t13 = p.k7 * cos_t4 + t11;
    let m87 = p.k6 + t9 * p.k17;
    let m76 = p.l * (cos_t4 * t8 + sin_t4 * t7) + m77;
    let t14 = sin_t3 * p.k21 + t12;
    let t15 = cos_t3 * p.k21 + t13;
    let m86 = p.k17 * (cos_t4 * cos_t6 + sin_t4 * sin_t6) + m87;
    let t16 = p.k7 * sin_t3 + t14;
    let t17 = p.k7 * cos_t3 + t15;
    let m75 = m76 + p.l * (cos_t3 * t8 + sin_t3 * t7);
    let m66 = p.l * (cos_t4 * t11 + sin_t4 * t10) + (m76 + p.k6);
    let m85 = p.k17 * (cos_t3 * cos_t6 + sin_t3 * sin_t6) + m86;
    let t18 = sin_t2 * p.k22 + t16;
    let t19 = cos_t2 * p.k22 + t17;
    let m65 = p.l * (cos_t3 * t13 + sin_t3 * t12) + m66;
    let t20 = p.k7 * sin_t2 + t18;
    let t21 = p.k7 * cos_t2 + t19;
    let m64 = m65 + p.l * (cos_t2 * t13 + sin_t2 * t12);
    let m55 = m65 + (p.k6 + p.l * (cos_t3 * t15 + sin_t3 * t14));
    let t22 = sin_t1 * p.k23 + t20;
    let t23 = cos_t1 * p.k23 + t21;
    let m74 = p.l * (cos_t2 * t8 + sin_t2 * t7) + m75;
    let m54 = p.l * (cos_t2 * t17 + sin_t2 * t16) + m55;
    let t24 = p.k7 * sin_t1 + t22;
    let t25 = p.k7 * cos_t1 + t23;
    let m44 = m54 + (p.k6 + p.l * (cos_t2 * t19 + sin_t2 * t18));
    let m84 = p.k17 * (cos_t2 * cos_t6 + sin_t2 * sin_t6) + m85;
    let t26 = t24 + sin_t0 * p.k24;
    let t27 = t25 + cos_t0 * p.k24;
    let m43 = p.l * (cos_t1 * t21 + sin_t1 * t20) + m44;
    let m53 = m54 + p.l * (cos_t1 * t17 + sin_t1 * t16);
    let m33 = m43 + (p.k6 + p.l * (cos_t1 * t23 + sin_t1 * t22));
    let m63 = p.l * (cos_t1 * t13 + sin_t1 * t12) + m64;
    let m73 = p.l * (cos_t1 * t8 + sin_t1 * t7) + m74;
    let m32 = p.l * (t25 * cos_t0 + sin_t0 * t24) + m33;
    let m83 = p.k17 * (cos_t1 * cos_t6 + sin_t1 * sin_t6) + m84;
    let t28 = sin_q_1 * (sin_t0 * p.k17 + p.l * t26);
    let t29 = cos_q_1 * (cos_t0 * p.k17 + p.l * t27) + t28;
    let m22 = m32 + (p.k6 + p.l * (cos_t0 * t27 + sin_t0 * t26));
    let m42 = m43 + p.l * (t21 * cos_t0 + sin_t0 * t20);
    let m52 = p.l * (t17 * cos_t0 + sin_t0 * t16) + m53;
    let m62 = p.l * (t13 * cos_t0 + sin_t0 * t12) + m63;
    let m72 = p.l * (t8 * cos_t0 + sin_t0 * t7) + m73;
    let m82 = p.k17 * (cos_t6 * cos_t0 + sin_t6 * sin_t0) + m83;
    let m11 = t29 * S::from_f64(2.0) + (m22 + p.k25);
    let m21 = m22 + t29;
    let m31 = m32 + p.l * (t25 * cos_q_1 + t24 * sin_q_1);
    let m41 = p.l * (t21 * cos_q_1 + t20 * sin_q_1) + m42;
    let m51 = p.l * (t17 * cos_q_1 + t16 * sin_q_1) + m52;
    let m61 = p.l * (t13 * cos_q_1 + t12 * sin_q_1) + m62;
    let m71 = p.l * (t8 * cos_q_1 + t7 * sin_q_1) + m72;
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
pub fn bias<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 8], v: &[S; 8]) -> [S; 8] {
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
    let t0 = q_1 + q_2;
    let (sin_q_1, cos_q_1) = q_1.sin_cos();
    let t1 = q_2_dot + q_1_dot;
    let t2 = q_1_dot * q_1_dot;
    let t3 = t0 + q_3;
    let (sin_t0, cos_t0) = t0.sin_cos();
    let t4 = t1 + q_3_dot;
    let t5 = t1 * t1;
    let (sin_t3, cos_t3) = t3.sin_cos();
    let t6 = t3 + q_4;
    let t7 = t4 + q_4_dot;
    let t8 = t4 * t4;
    let (sin_t6, cos_t6) = t6.sin_cos();
    let t9 = t6 + q_5;
    let t10 = t7 + q_5_dot;
    let t11 = t7 * t7;
    let (sin_t9, cos_t9) = t9.sin_cos();
    let t12 = t9 + q_6;
    let t13 = t10 + q_6_dot;
    let t14 = t10 * t10;
    let (sin_t12, cos_t12) = t12.sin_cos();
    let t15 = t12 + q_7;
    let t16 = t13 + q_7_dot;
    let t17 = t13 * t13;
    let (sin_t15, cos_t15) = t15.sin_cos();
    let t18 = t15 + q_8;
    let t19 = t16 + q_8_dot;
    let t20 = t16 * t16;
    let (sin_t18, cos_t18) = t18.sin_cos();
    let t21 = t19 * (t19 * p.k0);
    let t22 = sin_q_1 * t2;
    let t23 = cos_q_1 * t2;
    let t24 = t5 * sin_t0;
    let t25 = t5 * cos_t0;
    let t26 = t8 * sin_t3;
    let t27 = t24 + t22;
    let t28 = t8 * cos_t3;
    let t29 = t25 + t23;
    let t30 = p.k0 * t24 + p.l * t22;
    let t31 = p.k0 * t25 + p.l * t23;
    let t32 = t26 + t27;
    let t33 = t11 * sin_t6;
    let t34 = t28 + t29;
    let t35 = t11 * cos_t6;
    let t36 = t33 + t32;
    let t37 = t14 * sin_t9;
    let t38 = t35 + t34;
    let t39 = t14 * cos_t9;
    let t40 = p.k0 * t26 + p.l * t27;
    let t41 = p.k0 * t28 + p.l * t29;
    let t42 = t37 + t36;
    let t43 = t17 * sin_t12;
    let t44 = t39 + t38;
    let t45 = t17 * cos_t12;
    let t46 = p.k0 * t33 + p.l * t32;
    let t47 = p.k0 * t35 + p.l * t34;
    let t48 = t43 + t42;
    let t49 = t20 * sin_t15;
    let t50 = t45 + t44;
    let t51 = t20 * cos_t15;
    let t52 = p.k0 * t37 + p.l * t36;
    let t53 = p.k0 * t39 + p.l * t38;
    let t54 = p.k0 * t43 + p.l * t42;
    let t55 = p.k0 * t45 + p.l * t44;
    let t56 = t21 * sin_t18 + p.l * (t49 + t48);
    let t57 = p.k0 * t49 + p.l * t48;
    let t58 = t21 * cos_t18 + p.l * (t51 + t50);
    let t59 = p.k0 * t51 + p.l * t50;
    let t60 = t56 + t57;
    let t61 = t58 + t59;
    let t62 = t60 + t54;
    let t63 = t61 + t55;
    let h_q_8 = (sin_t18 * t58 - cos_t18 * t56) * p.k7;
    let t64 = t62 + t52;
    let t65 = t63 + t53;
    let t66 = t64 + t46;
    let t67 = t65 + t47;
    let t68 = sin_t15 * (p.m * t58 + t59 * p.k8) - cos_t15 * (p.m * t56 + t57 * p.k8);
    let h_q_7 = p.l * t68 + h_q_8;
    let t69 = sin_t12 * (p.m * t61 + t55 * p.k8) - cos_t12 * (p.m * t60 + t54 * p.k8);
    let h_q_6 = p.l * t69 + h_q_7;
    let t70 = p.m * (t66 + t40);
    let t71 = p.m * (t67 + t41);
    let t72 = sin_t9 * (p.m * t63 + t53 * p.k8) - cos_t9 * (p.m * t62 + t52 * p.k8);
    let h_q_5 = p.l * t72 + h_q_6;
    let t73 = sin_t6 * (p.m * t65 + t47 * p.k8) - cos_t6 * (p.m * t64 + t46 * p.k8);
    let h_q_4 = p.l * t73 + h_q_5;
    let t74 = sin_t3 * (p.m * t67 + t41 * p.k8) - cos_t3 * (p.m * t66 + t40 * p.k8);
    let h_q_3 = p.l * t74 + h_q_4;
    let t75 = cos_q_1 * (t70 + (p.m * t30 + t22 * p.k9));
    let t76 = p.l * (sin_t0 * (t71 + t31 * p.k8) - cos_t0 * (t70 + t30 * p.k8));
    let h_q_2 = t76 + h_q_3;
    let h_q_1 = p.l * (sin_q_1 * (t71 + (p.m * t31 + p.k9 * t23)) - t75) + h_q_2;
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
pub fn applied<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 8]) -> [S; 8] {
    let q_1 = q[0];
    let q_2 = q[1];
    let q_3 = q[2];
    let q_4 = q[3];
    let q_5 = q[4];
    let q_6 = q[5];
    let q_7 = q[6];
    let q_8 = q[7];
    let t0 = q_1 + q_2;
    let sin_q_1 = q_1.sin();
    let t1 = t0 + q_3;
    let sin_t0 = t0.sin();
    let t2 = t1 + q_4;
    let sin_t1 = t1.sin();
    let t3 = t2 + q_5;
    let sin_t2 = t2.sin();
    let t4 = t3 + q_6;
    let sin_t3 = t3.sin();
    let t5 = t4 + q_7;
    let sin_t4 = t4.sin();
    let sin_t5 = t5.sin();
    let t6 = t5 + q_8;
    let sin_t6 = t6.sin();
    let t7 = sin_t6 * p.k3 + p.k10 * sin_t5;
    let t8 = p.k11 * sin_t4 + t7;
    let t9 = p.k12 * sin_t3 + t8;
    let t10 = p.k13 * sin_t2 + t9;
    let t11 = p.k14 * sin_t1 + t10;
    let t12 = p.k15 * sin_t0 + t11;
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
pub fn forces<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 8], v: &[S; 8]) -> [S; 8] {
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
    let t0 = q_1 + q_2;
    let (sin_q_1, cos_q_1) = q_1.sin_cos();
    let t1 = q_2_dot + q_1_dot;
    let t2 = q_1_dot * q_1_dot;
    let t3 = t0 + q_3;
    let (sin_t0, cos_t0) = t0.sin_cos();
    let t4 = t1 + q_3_dot;
    let t5 = t1 * t1;
    let (sin_t3, cos_t3) = t3.sin_cos();
    let t6 = t3 + q_4;
    let t7 = t4 + q_4_dot;
    let t8 = t4 * t4;
    let (sin_t6, cos_t6) = t6.sin_cos();
    let t9 = t6 + q_5;
    let t10 = t7 + q_5_dot;
    let t11 = t7 * t7;
    let (sin_t9, cos_t9) = t9.sin_cos();
    let t12 = t9 + q_6;
    let t13 = t10 + q_6_dot;
    let t14 = t10 * t10;
    let (sin_t12, cos_t12) = t12.sin_cos();
    let t15 = t12 + q_7;
    let t16 = t13 + q_7_dot;
    let t17 = t13 * t13;
    let (sin_t15, cos_t15) = t15.sin_cos();
    let t18 = t15 + q_8;
    let t19 = t16 + q_8_dot;
    let t20 = t16 * t16;
    let (sin_t18, cos_t18) = t18.sin_cos();
    let t21 = t19 * (t19 * p.k0);
    let t22 = sin_q_1 * t2;
    let t23 = cos_q_1 * t2;
    let t24 = t5 * sin_t0;
    let t25 = t5 * cos_t0;
    let t26 = t8 * sin_t3;
    let t27 = t24 + t22;
    let t28 = t8 * cos_t3;
    let t29 = t25 + t23;
    let t30 = p.k0 * t24 + p.l * t22;
    let t31 = t26 + t27;
    let t32 = t11 * sin_t6;
    let t33 = t28 + t29;
    let t34 = t11 * cos_t6;
    let t35 = p.g + (p.k0 * t25 + p.l * t23);
    let t36 = p.k0 * t26 + p.l * t27;
    let t37 = t32 + t31;
    let t38 = t14 * sin_t9;
    let t39 = t34 + t33;
    let t40 = t14 * cos_t9;
    let t41 = p.k0 * t32 + p.l * t31;
    let t42 = t38 + t37;
    let t43 = t17 * sin_t12;
    let t44 = t40 + t39;
    let t45 = t17 * cos_t12;
    let t46 = p.k0 * t38 + p.l * t37;
    let t47 = p.g + (p.k0 * t34 + p.l * t33);
    let t48 = t43 + t42;
    let t49 = t20 * sin_t15;
    let t50 = t45 + t44;
    let t51 = t20 * cos_t15;
    let t52 = p.k0 * t43 + p.l * t42;
    let t53 = p.g + (p.k0 * t40 + p.l * t39);
    let t54 = p.k0 * t49 + p.l * t48;
    let t55 = p.g + (p.k0 * t45 + p.l * t44);
    let t56 = t21 * sin_t18 + p.l * (t49 + t48);
    let t57 = p.g + (p.k0 * t28 + p.l * t29);
    let t58 = p.g + (p.k0 * t51 + p.l * t50);
    let t59 = t56 + t54;
    let t60 = p.g + (t21 * cos_t18 + p.l * (t51 + t50));
    let t61 = t59 + t52;
    let t62 = t60 + t58;
    let t63 = t61 + t46;
    let t64 = t62 + t55;
    let f_q_8 = (cos_t18 * t56 - sin_t18 * t60) * p.k7;
    let t65 = t63 + t41;
    let t66 = t64 + t53;
    let t67 = cos_t15 * (p.m * t56 + p.k8 * t54) - sin_t15 * (p.m * t60 + t58 * p.k8);
    let f_q_7 = p.l * t67 + f_q_8;
    let t68 = t66 + t47;
    let t69 = cos_t12 * (p.m * t59 + p.k8 * t52) - sin_t12 * (p.m * t62 + t55 * p.k8);
    let f_q_6 = p.l * t69 + f_q_7;
    let t70 = p.m * (t65 + t36);
    let t71 = cos_t9 * (p.m * t61 + p.k8 * t46) - sin_t9 * (p.m * t64 + t53 * p.k8);
    let f_q_5 = p.l * t71 + f_q_6;
    let t72 = p.m * (t68 + t57);
    let t73 = cos_t6 * (p.m * t63 + p.k8 * t41) - sin_t6 * (p.m * t66 + t47 * p.k8);
    let f_q_4 = p.l * t73 + f_q_5;
    let t74 = cos_t3 * (p.m * t65 + p.k8 * t36) - sin_t3 * (p.m * t68 + t57 * p.k8);
    let f_q_3 = p.l * t74 + f_q_4;
    let t75 = sin_q_1 * (t72 + (p.m * t35 + p.k8 * (p.g + p.k0 * t23)));
    let t76 = p.l * (cos_t0 * (t70 + p.k8 * t30) - sin_t0 * (t72 + t35 * p.k8));
    let f_q_2 = t76 + f_q_3;
    let f_q_1 = p.l * (cos_q_1 * (t70 + (p.m * t30 + t22 * p.k9)) - t75) + f_q_2;
    [f_q_1, f_q_2, f_q_3, f_q_4, f_q_5, f_q_6, f_q_7, f_q_8]
}

/// Accelerations `a`, the solution of `M a = f` eliminated along the machine, pivots ahead.
///
/// A pivot that vanishes is an error.
pub fn accelerations<S: ::lagrangian::emitted::Number>(
    p: &Prepared<S>,
    q: &[S; 8],
    v: &[S; 8],
) -> Result<[S; 8], ::lagrangian::emitted::Singular> {
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

impl<S: Copy> ::lagrangian::emitted::scalar::Kernel<S> for Accelerations<'_, S> {
    type Output = Result<[S; 8], ::lagrangian::emitted::Singular>;

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
        let angles = [q_1, t0, t1, t2, t3, t4, t5, t6];
        let circular = N::sin_cos_all(angles);
        let (sin_q_1, cos_q_1) = circular[0];
        let (sin_t0, cos_t0) = circular[1];
        let (sin_t1, cos_t1) = circular[2];
        let (sin_t2, cos_t2) = circular[3];
        let (sin_t3, cos_t3) = circular[4];
        let (sin_t4, cos_t4) = circular[5];
        let (sin_t5, cos_t5) = circular[6];
        let (sin_t6, cos_t6) = circular[7];
        let t7 = q_2_dot + q_1_dot;
        let t8 = q_1_dot * q_1_dot;
        let t9 = t7 + q_3_dot;
        let t10 = t7 * t7;
        let t11 = t9 + q_4_dot;
        let t12 = t9 * t9;
        let t13 = t11 + q_5_dot;
        let t14 = t11 * t11;
        let t15 = t13 + q_6_dot;
        let t16 = t13 * t13;
        let t17 = t15 + q_7_dot;
        let t18 = t15 * t15;
        let t19 = t17 + q_8_dot;
        let t20 = t17 * t17;
        let t21 = t19 * (n(p.k7) * t19);
        let t22 = n(p.l) * cos_q_1;
        let t23 = n(p.l) * sin_q_1;
        let t24 = n(p.l) * cos_t0;
        let t25 = n(p.l) * sin_t0;
        let t26 = t23 * t8;
        let t27 = cos_t0 * t10;
        let t28 = n(p.l) * cos_t1;
        let t29 = n(p.l) * sin_t1;
        let t30 = sin_t0 * (sin_q_1 * n(p.k30));
        let t31 = t25.mul_add(t10, t26);
        let t32 = n(p.l) * cos_t2;
        let t33 = n(p.l) * sin_t2;
        let t34 = n(p.m) * t29;
        let t35 = n(p.m) * t28;
        let t36 = t29 * t12;
        let t37 = t28 * t12;
        let t38 = n(p.l) * cos_t3;
        let t39 = n(p.m) * t32;
        let t40 = n(p.l) * sin_t3;
        let t41 = n(p.m) * t33;
        let t42 = t32 * t14;
        let t43 = t33 * t14;
        let t44 = sin_t0.mul_add(t10 * n(p.k0), t26);
        let t45 = n(p.l) * cos_t4;
        let t46 = n(p.m) * t38;
        let t47 = n(p.l) * sin_t4;
        let t48 = n(p.m) * t40;
        let t49 = t40 * t16;
        let t50 = t38 * t16;
        let t51 = n(p.l).mul_add(cos_q_1.mul_add(t8, t27), n(p.g));
        let t52 = n(p.g) + n(p.k0).mul_add(t27, t22 * t8);
        let t53 = n(p.l) * sin_t5;
        let t54 = n(p.l) * cos_t5;
        let t55 = t45 * t18;
        let t56 = t47 * t18;
        let t57 = t53 * n(p.k33);
        let t58 = t54 * n(p.k33);
        let t59 = sin_t6 * cos_t6;
        let t60 = sin_t6 * sin_t6;
        let t61 = cos_t6 * cos_t6;
        let t62 = t54.mul_add(cos_t6, sin_t6 * t53);
        let t63 = t59 * n(p.k27);
        let t64 = n(p.k27).neg_mul_add(t60, N::from_f64(2.5));
        let t65 = n(p.k27).neg_mul_add(t61, N::from_f64(2.5));
        let t66 = t54 * t20;
        let t67 = n(p.k34) * t59;
        let t68 = t62 * n(p.k34);
        let t69 = t62 * n(p.k27);
        let t70 = t54.mul_add(t58, t53.mul_add(t57, n(p.k28)));
        let t71 = t62.neg_mul_add(t68, t70);
        let t72 = sin_t6.neg_mul_add(t68, t57);
        let t73 = cos_t6.neg_mul_add(t68, t58);
        let t74 = t47.mul_sub(t64, t45 * t63);
        let t75 = t45.mul_sub(t65, t47 * t63);
        let t76 = sin_t6.neg_mul_add(t69, t53 * N::from_f64(1.5));
        let t77 = cos_t6.neg_mul_add(t69, t54 * N::from_f64(1.5));
        let t78 = t53 * t20;
        let t79 = N::ONE / t71;
        let t80 = t73.mul_add(t45, t72 * t47);
        let t81 = t74.mul_add(t47 * n(p.m), n(p.k28));
        let t82 = n(p.k34).neg_mul_add(t61, n(p.k33));
        let t83 = t78.mul_add(t82, t67.mul_add(t66, sin_t6 * t21));
        let t84 = n(p.k34).neg_mul_add(t60, n(p.k33));
        let t85 = t66.mul_add(t84, t67.mul_add(t78, cos_t6 * t21));
        let t86 = t44.neg_mul_add(cos_q_1 * n(p.k4), sin_q_1 * n(p.k3));
        let t87 = t79 * t80;
        let t88 = t79 * t77;
        let t89 = t79.neg_mul_add(t76 * (n(p.m) * t76), N::ONE + t64);
        let t90 = t79 * t73;
        let t91 = t53.mul_sub(t85, t54 * t83);
        let t92 = t79 * t72;
        let t93 = t80.neg_mul_add(t87, t75.mul_add(t45 * n(p.m), t81));
        let t94 = t87.neg_mul_add(t76, t74);
        let t95 = t88.mul_add(t76, t59 * n(p.k29));
        let t96 = t80.neg_mul_add(t88, t75);
        let t97 = t88.neg_mul_add(n(p.m) * t77, N::ONE + t65);
        let t98 = t72.mul_add(t90, t67);
        let t99 = N::ONE / t93;
        let t100 = t46.neg_mul_add(t95, t40 * t89);
        let t101 = t96.mul_add(t38, t94 * t40);
        let t102 = t38.mul_sub(t97, t48 * t95);
        let t103 = t55.mul_add(t98, t90.mul_add(t91, t83));
        let t104 = t56.neg_mul_add(t73.mul_sub(t90, n(p.m) * t65), t103);
        let t105 = t56.mul_add(t98, t91.neg_mul_add(t92, t85));
        let t106 = t55.neg_mul_add(t72.mul_sub(t92, n(p.m) * t64), t105);
        let t107 = t99 * n(p.k31);
        let t108 = n(p.m) * t99;
        let t109 = t99.mul_add(t96 * t94, t95);
        let t110 = t107 * t101;
        let t111 = t94 * t108;
        let t112 = t96 * t108;
        let t113 = t47.mul_sub(t106, t45 * t104);
        let t114 = n(p.k31) * t109;
        let t115 = t46.mul_add(t102, t48.mul_add(t100, n(p.k28)));
        let t116 = t101.neg_mul_add(t110, t115);
        let t117 = t94.neg_mul_add(t111, N::ONE + t89);
        let t118 = t94.neg_mul_add(t110, n(p.m) * t100);
        let t119 = t96.neg_mul_add(t112, N::ONE + t97);
        let t120 = t96.neg_mul_add(t110, n(p.m) * t102);
        let t121 = t101.neg_mul_add(t111, t100);
        let t122 = N::ONE / t116;
        let t123 = t33.mul_sub(t117, t39 * t109);
        let t124 = t32.mul_sub(t119, t41 * t109);
        let t125 = t101.neg_mul_add(t112, t102);
        let t126 = t120.mul_add(t32, t118 * t33);
        let t127 = t49 * t107.neg_mul_add(t96 * t96, n(p.m) * t97);
        let t128 = t50 * t107.neg_mul_add(t94 * t94, n(p.m) * t89);
        let t129 = t112.mul_add(t113, t104) + t114.mul_add(t50, t127);
        let t130 = t111.neg_mul_add(t113, t106) + t114.mul_add(t49, t128);
        let t131 = t122 * t126;
        let t132 = t122 * t125;
        let t133 = t122.neg_mul_add(t121 * (n(p.m) * t121), N::ONE + t117);
        let t134 = t122 * t120;
        let t135 = t122 * t118;
        let t136 = t39.mul_add(t124, t41.mul_add(t123, n(p.k28)));
        let t137 = t126.neg_mul_add(t131, t136);
        let t138 = t131.neg_mul_add(t121, t123);
        let t139 = t132.mul_add(t121, t109);
        let t140 = t126.neg_mul_add(t132, t124);
        let t141 = t132.neg_mul_add(n(p.m) * t125, N::ONE + t119);
        let t142 = t40.mul_sub(t130, t38 * t129);
        let t143 = t118.mul_add(t134, t114);
        let t144 = N::ONE / t137;
        let t145 = t35.neg_mul_add(t139, t29 * t133);
        let t146 = t140.mul_add(t28, t138 * t29);
        let t147 = t28.mul_sub(t141, t34 * t139);
        let t148 = t42.mul_add(t143, t134.mul_add(t142, t129));
        let t149 = t43.neg_mul_add(t120.mul_sub(t134, n(p.m) * t119), t148);
        let t150 = t43.mul_add(t143, t142.neg_mul_add(t135, t130));
        let t151 = t42.neg_mul_add(t118.mul_sub(t135, n(p.m) * t117), t150);
        let t152 = n(p.k31) * t144;
        let t153 = t144.mul_add(t140 * t138, t139);
        let t154 = n(p.m) * t144;
        let t155 = t152 * t146;
        let t156 = n(p.m) * t153;
        let t157 = t138 * t154;
        let t158 = t140 * t154;
        let t159 = n(p.k31) * t153;
        let t160 = t33.mul_sub(t151, t32 * t149);
        let t161 = t35.mul_add(t147, t34.mul_add(t145, n(p.k28)));
        let t162 = t146.neg_mul_add(t155, t161);
        let t163 = t138.neg_mul_add(t155, n(p.m) * t145);
        let t164 = t138.neg_mul_add(t157, t133 + N::from_f64(0.5));
        let t165 = t140.neg_mul_add(t155, n(p.m) * t147);
        let t166 = t140.neg_mul_add(t158, t141 + N::from_f64(0.5));
        let t167 = N::ONE / t162;
        let t168 = t25.mul_sub(t164, t24 * t156);
        let t169 = t24.mul_sub(t166, t25 * t156);
        let t170 = t36 * t152.neg_mul_add(t140 * t140, n(p.m) * t141);
        let t171 = t165.mul_add(t24, t163 * t25);
        let t172 = t37 * t152.neg_mul_add(t138 * t138, n(p.m) * t133);
        let t173 = t158.mul_add(t160, t149) + t159.mul_add(t37, t170);
        let t174 = t165.mul_add(t22, t163 * t23);
        let t175 = t168.mul_add(n(p.m) * t25, n(p.k6));
        let t176 = t168.mul_add(t23, cos_t0.mul_add(cos_q_1 * n(p.k30), t30));
        let t177 = t157.neg_mul_add(t160, t151) + t159.mul_add(t36, t172);
        let t178 = t169.mul_add(n(p.m) * t24, t175);
        let t179 = t167.neg_mul_add(t171 * t171, t178);
        let t180 = t167 * t174;
        let t181 = t164.mul_sub(t23, t156 * t22);
        let t182 = t29.mul_sub(t177, t28 * t173);
        let t183 = t167 * t163;
        let t184 = t167 * t165;
        let t185 = N::ONE / t179;
        let t186 = t171.mul_sub(t180, n(p.m) * t169.mul_add(t22, t176));
        let t187 = t181.mul_add(n(p.m) * t23, n(p.k32));
        let t188 = t163.mul_add(t184, t159);
        let t189 = t166.mul_sub(t22, t156 * t23).mul_add(n(p.m) * t22, t187);
        let t190 = t31.mul_add(t188, t182.neg_mul_add(t183, t177));
        let t191 = t51.neg_mul_add(t163.mul_sub(t183, n(p.m) * t164), t190);
        let t192 = t188.mul_add(t51, t184.mul_add(t182, t173));
        let t193 = t31.neg_mul_add(t165.mul_sub(t184, n(p.m) * t166), t192);
        let t194 = t185 * t186;
        let t195 = t52.mul_sub(sin_t0 * n(p.k7), t44 * (cos_t0 * n(p.k7)));
        let t196 = t186.neg_mul_add(t194, t174.neg_mul_add(t180, t189));
        let t197 = t24.neg_mul_add(t193, t25.mul_add(t191, t195));
        let t198 = t23.mul_add(t191, t52.mul_add(sin_q_1 * n(p.k4), t86));
        let t199 = t194.mul_add(t197, t22.neg_mul_add(t193, t198));
        let t200 = N::ONE / t196 * t199;
        let t201 = t194.mul_add(t200, t185 * t197);
        let t202 = t25.neg_mul_add(t201, t23.neg_mul_add(t200, t51));
        let t203 = t24.mul_add(t201, t22.mul_add(t200, t31));
        let t204 = t184.neg_mul_add(t203, t183.mul_add(t202, t167 * t182));
        let t205 = t29.neg_mul_add(t204, t37 + t202);
        let t206 = t28.mul_add(t204, t36 + t203);
        let t207 = t158.neg_mul_add(t206, t157.mul_add(t205, t144 * t160));
        let t208 = t33.neg_mul_add(t207, t42 + t205);
        let t209 = t32.mul_add(t207, t43 + t206);
        let t210 = t134.neg_mul_add(t209, t135.mul_add(t208, t122 * t142));
        let t211 = t40.neg_mul_add(t210, t50 + t208);
        let t212 = t38.mul_add(t210, t49 + t209);
        let t213 = t112.neg_mul_add(t212, t111.mul_add(t211, t99 * t113));
        let t214 = t47.neg_mul_add(t213, t55 + t211);
        let t215 = t45.mul_add(t213, t56 + t212);
        let t216 = t90.neg_mul_add(t215, t92.mul_add(t214, t79 * t91));
        let t217 = sin_t6 * t53.neg_mul_add(t216, t66 + t214);
        let t218 = cos_t6.mul_sub(t54.mul_add(t216, t78 + t215), t217);
        let q_1_ddot = -t200;
        let q_2_ddot = t200 - t201;
        let q_3_ddot = t201 - t204;
        let q_4_ddot = t204 - t207;
        let q_5_ddot = t207 - t210;
        let q_6_ddot = t210 - t213;
        let q_7_ddot = t213 - t216;
        let q_8_ddot = t218.mul_add(n(p.k35), t216);
        let sound = PIVOTS.hold(t71, t71)
            & PIVOTS.hold(t93, t93)
            & PIVOTS.hold(t116, t116)
            & PIVOTS.hold(t137, t137)
            & PIVOTS.hold(t162, t162)
            & PIVOTS.hold(t179, t179)
            & PIVOTS.hold(t196, t196)
            & q_8_ddot.is_finite();
        if !sound {
            let pivots = [
                (6, t71, t71),
                (5, t93, t93),
                (4, t116, t116),
                (3, t137, t137),
                (2, t162, t162),
                (1, t179, t179),
                (0, t196, t196),
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
pub fn kinetic_energy<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 8],
    v: &[S; 8],
) -> S {
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
    let t0 = q_2 + q_1;
    let (sin_q_1, cos_q_1) = q_1.sin_cos();
    let t1 = q_2_dot + q_1_dot;
    let t2 = q_1_dot * p.l;
    let t3 = t0 + q_3;
    let (sin_t0, cos_t0) = t0.sin_cos();
    let t4 = t1 + q_3_dot;
    let (sin_t3, cos_t3) = t3.sin_cos();
    let t5 = t3 + q_4;
    let t6 = t4 + q_4_dot;
    let (sin_t5, cos_t5) = t5.sin_cos();
    let t7 = t5 + q_5;
    let t8 = t6 + q_5_dot;
    let (sin_t7, cos_t7) = t7.sin_cos();
    let t9 = t7 + q_6;
    let t10 = t8 + q_6_dot;
    let (sin_t9, cos_t9) = t9.sin_cos();
    let t11 = t9 + q_7;
    let t12 = t10 + q_7_dot;
    let (sin_t11, cos_t11) = t11.sin_cos();
    let t13 = t11 + q_8;
    let t14 = t12 + q_8_dot;
    let (sin_t13, cos_t13) = t13.sin_cos();
    let t15 = t14 * p.k0;
    let t16 = t1 * cos_t0;
    let t17 = t1 * sin_t0;
    let t18 = t4 * cos_t3;
    let t19 = t16 + q_1_dot * cos_q_1;
    let t20 = t4 * sin_t3;
    let t21 = t17 + q_1_dot * sin_q_1;
    let t22 = p.k0 * t16 + cos_q_1 * t2;
    let t23 = p.k0 * t17 + sin_q_1 * t2;
    let t24 = t18 + t19;
    let t25 = t6 * cos_t5;
    let t26 = t20 + t21;
    let t27 = t6 * sin_t5;
    let t28 = t25 + t24;
    let t29 = p.k0 * t18 + p.l * t19;
    let t30 = t8 * cos_t7;
    let t31 = p.k0 * t20 + p.l * t21;
    let t32 = t27 + t26;
    let t33 = p.k0 * t25 + p.l * t24;
    let t34 = t8 * sin_t7;
    let t35 = t30 + t28;
    let t36 = t10 * cos_t9;
    let t37 = p.k0 * t27 + p.l * t26;
    let t38 = p.k0 * t30 + p.l * t28;
    let t39 = t34 + t32;
    let t40 = t10 * sin_t9;
    let t41 = t36 + t35;
    let t42 = S::from_f64(0.5) * (p.m * (t23 * t23 + t22 * t22) + t1 * (t1 * p.J));
    let t43 = p.k0 * t34 + p.l * t32;
    let t44 = p.k0 * t36 + p.l * t35;
    let t45 = t40 + t39;
    let t46 = t12 * cos_t11;
    let t47 = S::from_f64(0.5) * (p.m * (t31 * t31 + t29 * t29) + t4 * (t4 * p.J));
    let t48 = p.k0 * t40 + p.l * t39;
    let t49 = t12 * sin_t11;
    let t50 = p.k0 * t46 + p.l * t41;
    let t51 = S::from_f64(0.5) * (p.m * (t37 * t37 + t33 * t33) + t6 * (t6 * p.J));
    let t52 = p.k0 * t49 + p.l * t45;
    let t53 = t15 * cos_t13 + p.l * (t46 + t41);
    let t54 = S::from_f64(0.5) * (p.m * (t43 * t43 + t38 * t38) + t8 * (t8 * p.J));
    let t55 = t15 * sin_t13 + p.l * (t49 + t45);
    let t56 = S::from_f64(0.5) * (p.m * (t48 * t48 + t44 * t44) + t10 * (t10 * p.J));
    let t57 = S::from_f64(0.5) * (p.m * (t52 * t52 + t50 * t50) + t12 * (t12 * p.J));
    let t58 = t57 + (t56 + (t54 + (t51 + (t47 + (t42 + q_1_dot * (q_1_dot * p.k5))))));
    let t59 = S::from_f64(0.5) * (p.m * (t55 * t55 + t53 * t53) + t14 * (t14 * p.J));
    t59 + t58
}

/// Potential energy `V`, in J.
///
/// ```text
/// V = …
/// ```
pub fn potential_energy<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 8]) -> S {
    let q_1 = q[0];
    let q_2 = q[1];
    let q_3 = q[2];
    let q_4 = q[3];
    let q_5 = q[4];
    let q_6 = q[5];
    let q_7 = q[6];
    let q_8 = q[7];
    let t0 = q_2 + q_1;
    let cos_q_1 = q_1.cos();
    let t1 = t0 + q_3;
    let cos_t0 = t0.cos();
    let cos_t1 = t1.cos();
    let t2 = t1 + q_4;
    let cos_t2 = t2.cos();
    let t3 = t2 + q_5;
    let cos_t3 = t3.cos();
    let t4 = t3 + q_6;
    let cos_t4 = t4.cos();
    let t5 = t4 + q_7;
    let cos_t5 = t5.cos();
    let t6 = t5 + q_8;
    let cos_t6 = t6.cos();
    let t7 = cos_t0 + cos_q_1;
    let t8 = cos_t1 + t7;
    let t9 = cos_t2 + t8;
    let t10 = p.k2 * (p.k0 * cos_t0 + p.l * cos_q_1) + cos_q_1 * p.k3;
    let t11 = cos_t3 + t9;
    let t12 = p.k2 * (p.k0 * cos_t1 + p.l * t7) + t10;
    let t13 = cos_t4 + t11;
    let t14 = p.k2 * (p.k0 * cos_t2 + p.l * t8) + t12;
    let t15 = p.k2 * (p.k0 * cos_t3 + p.l * t9) + t14;
    let t16 = p.k2 * (p.k0 * cos_t4 + p.l * t11) + t15;
    let t17 = p.k2 * (p.k0 * cos_t6 + p.l * (cos_t5 + t13));
    -(t17 + (p.k2 * (p.k0 * cos_t5 + p.l * t13) + t16))
}

::lagrangian::emitted::implement! {
    machine ChainRelative "ChainRelative" over S, R;
    parameters { l, m, J, g } [
        l: "l" "m" = 0.2;
        m: "m" "kg" = 0.5;
        J: "J" "kg*m^2" = 0.0016666666666666668;
        g: "g" "m/s^2" = 9.81;
    ]
    coordinates 8 Coordinates { q: [q_1, q_2, q_3, q_4, q_5, q_6, q_7, q_8] } [
        q_1: "q[1]" "rad";
        q_2: "q[2]" "rad";
        q_3: "q[3]" "rad";
        q_4: "q[4]" "rad";
        q_5: "q[5]" "rad";
        q_6: "q[6]" "rad";
        q_7: "q[7]" "rad";
        q_8: "q[8]" "rad";
    ]
    inputs Inputs {} []
    outputs Outputs {} []
    prepared Prepared {
        l, m, J, g, k0, k1, k2, k3, k4, k5, k6, k7, k8, k9, k10, k11, k12, k13, k14, k15, k16, k17,
        k18, k19, k20, k21, k22, k23, k24, k25, k26, k27, k28, k29, k30, k31, k32, k33, k34, k35,
    }
    singular singular
    accelerations { (p, t, q, v, u) Accelerations { p, q, v } }
    system {
        matrix mass_matrix(p, t, q) = mass_matrix(p, q);
        vector bias(p, t, q, v) = bias(p, q, v);
        vector applied(p, t, q, v, u) = applied(p, q);
        vector forces(p, t, q, v, u) = forces(p, q, v);
        number kinetic_energy(p, t, q, v) = kinetic_energy(p, q, v);
        number potential_energy(p, t, q, u) = potential_energy(p, q);
        number dissipation(p, t, q, v, u);
        number work_rate(p, t, q, v, a, u);
        number dissipation_rate(p, t, q, v, u);
        outputs outputs(p, t, q, v, a, u) = Outputs {};
    }
    absent [MAY_BE_CONSTRAINED MAY_SLIDE MAY_COLLIDE]
    intervals []
    lanes [N]
    numbers [yes]
}
