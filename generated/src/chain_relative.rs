// @generated from machines/chain_relative.machine by `cargo xtask generate`; edits are lost.

//! The chain with each angle measured from the previous bar: the same motion in other coordinates.
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

/// The chain with each angle measured from the previous bar: the same motion in other coordinates.
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
        let l_m = self.l * self.m;
        let t0 = self.l * self.l;
        let l_squared_m = self.l * l_m;
        let t1 = self.g * l_m;
        let half_l_m = S::from_f64(0.5) * l_m;
        let t2 = l_squared_m * S::from_f64(0.25);
        let half_l_m_g = S::from_f64(0.5) * t1;
        let k17 = self.J + l_squared_m * S::from_f64(1.25);
        let k1 = self.J + t2;
        let t3 = S::ONE / k1;
        let t4 = S::from_f64(0.25) * t3;
        let half_l = self.l * S::from_f64(0.5);
        let m_g = self.m * self.g;
        let k0 = S::from_f64(0.125) * (l_squared_m + self.J * S::from_f64(4.0));
        let half_m = self.m * S::from_f64(0.5);
        let quarter_l_m = l_m * S::from_f64(0.25);
        let k2 = t1 * S::from_f64(1.5);
        let k3 = t1 * S::from_f64(2.5);
        let k4 = t1 * S::from_f64(3.5);
        let k5 = t1 * S::from_f64(4.5);
        let k6 = t1 * S::from_f64(5.5);
        let k7 = t1 * S::from_f64(6.5);
        let k8 = t1 * S::from_f64(7.5);
        let half_l_squared_m = S::from_f64(0.5) * l_squared_m;
        let k9 = l_m * S::from_f64(1.5);
        let k10 = k1 + k17;
        let two_l_m = l_m * S::from_f64(2.0);
        let three_l_m = l_m * S::from_f64(3.0);
        let four_l_m = l_m * S::from_f64(4.0);
        let k11 = l_m * S::from_f64(5.0);
        let k12 = l_m * S::from_f64(6.0);
        let k13 = self.J + l_squared_m * S::from_f64(7.25);
        let minus_half_l_m_g = -half_l_m_g;
        let k14 = l_squared_m * t4;
        let k15 = self.J - t2;
        let k16 = t4 * t0;
        let half_l_squared = S::from_f64(0.5) * t0;
        let m_squared = self.m * self.m;
        let k18 = self.m * S::from_f64(1.5);
        let k19 = t4 * (l_m * l_m);
        let k20 = half_l_m * t3;
        let pivots = [(7, k1, k1)];
        Prepared {
            l: self.l,
            m: self.m,
            J: self.J,
            g: self.g,
            half_l,
            l_squared_m,
            m_g,
            half_l_m_g,
            l_m,
            k0,
            k1,
            half_l_m,
            half_m,
            quarter_l_m,
            k2,
            k3,
            k4,
            k5,
            k6,
            k7,
            k8,
            half_l_squared_m,
            k9,
            k10,
            two_l_m,
            three_l_m,
            four_l_m,
            k11,
            k12,
            k13,
            minus_half_l_m_g,
            k14,
            k15,
            k16,
            half_l_squared,
            m_squared,
            k17,
            k18,
            k19,
            k20,
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
    half_l: S,
    /// `l^2*m`
    l_squared_m: S,
    /// `m*g`
    m_g: S,
    /// `0.5*l*m*g`
    half_l_m_g: S,
    /// `l*m`
    l_m: S,
    /// `0.125*(l^2*m + 4*J)`
    k0: S,
    /// `J + 0.25*l^2*m`
    k1: S,
    /// `0.5*l*m`
    half_l_m: S,
    /// `0.5*m`
    half_m: S,
    /// `0.25*l*m`
    quarter_l_m: S,
    /// `1.5*l*m*g`
    k2: S,
    /// `2.5*l*m*g`
    k3: S,
    /// `3.5*l*m*g`
    k4: S,
    /// `4.5*l*m*g`
    k5: S,
    /// `5.5*l*m*g`
    k6: S,
    /// `6.5*l*m*g`
    k7: S,
    /// `7.5*l*m*g`
    k8: S,
    /// `0.5*l^2*m`
    half_l_squared_m: S,
    /// `1.5*l*m`
    k9: S,
    /// `J + J + 0.25*l^2*m + 1.25*l^2*m`
    k10: S,
    /// `2*l*m`
    two_l_m: S,
    /// `3*l*m`
    three_l_m: S,
    /// `4*l*m`
    four_l_m: S,
    /// `5*l*m`
    k11: S,
    /// `6*l*m`
    k12: S,
    /// `J + 7.25*l^2*m`
    k13: S,
    /// `-0.5*l*m*g`
    minus_half_l_m_g: S,
    /// `0.25*l^2*m/(J + 0.25*l^2*m)`
    k14: S,
    /// `J - 0.25*l^2*m`
    k15: S,
    /// `0.25*l^2/(J + 0.25*l^2*m)`
    k16: S,
    /// `0.5*l^2`
    half_l_squared: S,
    /// `m^2`
    m_squared: S,
    /// `J + 1.25*l^2*m`
    k17: S,
    /// `1.5*m`
    k18: S,
    /// `0.25*l^2*m^2/(J + 0.25*l^2*m)`
    k19: S,
    /// `0.5*l*m/(J + 0.25*l^2*m)`
    k20: S,
    /// Why these parameters leave the machine without accelerations, if they do.
    singular: Option<::lagrangian::emitted::Singular>,
}

/// A pivot of an elimination that is not above this share of its diagonal element may be rounding
/// errors alone.
const PIVOTS: ::lagrangian::emitted::Pivots = ::lagrangian::emitted::Pivots::new(8, 8);

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
    let t7 = p.half_l_m * sin_t6 + p.k9 * sin_t5;
    let t8 = p.half_l_m * cos_t6 + p.k9 * cos_t5;
    let t9 = cos_t6 * cos_t5 + sin_t6 * sin_t5;
    let t10 = sin_t4 * p.two_l_m + t7;
    let t11 = cos_t4 * p.two_l_m + t8;
    let m77 = t9 * p.l_squared_m + p.k10;
    let t12 = p.half_l_m * sin_t4 + t10;
    let t13 = p.half_l_m * cos_t4 + t11;
    let m87 = p.k1 + t9 * p.half_l_squared_m;
    let m76 = p.l * (cos_t4 * t8 + sin_t4 * t7) + m77;
    let t14 = sin_t3 * p.three_l_m + t12;
    let t15 = cos_t3 * p.three_l_m + t13;
    let m86 = p.half_l_squared_m * (cos_t4 * cos_t6 + sin_t4 * sin_t6) + m87;
    let t16 = p.half_l_m * sin_t3 + t14;
    let t17 = p.half_l_m * cos_t3 + t15;
    let m75 = m76 + p.l * (cos_t3 * t8 + sin_t3 * t7);
    let m66 = p.l * (cos_t4 * t11 + sin_t4 * t10) + (m76 + p.k1);
    let m85 = p.half_l_squared_m * (cos_t3 * cos_t6 + sin_t3 * sin_t6) + m86;
    let t18 = sin_t2 * p.four_l_m + t16;
    let t19 = cos_t2 * p.four_l_m + t17;
    let m65 = p.l * (cos_t3 * t13 + sin_t3 * t12) + m66;
    let t20 = p.half_l_m * sin_t2 + t18;
    let t21 = p.half_l_m * cos_t2 + t19;
    let m64 = m65 + p.l * (cos_t2 * t13 + sin_t2 * t12);
    let m55 = m65 + (p.k1 + p.l * (cos_t3 * t15 + sin_t3 * t14));
    let t22 = sin_t1 * p.k11 + t20;
    let t23 = cos_t1 * p.k11 + t21;
    let m74 = p.l * (cos_t2 * t8 + sin_t2 * t7) + m75;
    let m54 = p.l * (cos_t2 * t17 + sin_t2 * t16) + m55;
    let t24 = p.half_l_m * sin_t1 + t22;
    let t25 = p.half_l_m * cos_t1 + t23;
    let m44 = m54 + (p.k1 + p.l * (cos_t2 * t19 + sin_t2 * t18));
    let m84 = p.half_l_squared_m * (cos_t2 * cos_t6 + sin_t2 * sin_t6) + m85;
    let t26 = t24 + sin_t0 * p.k12;
    let t27 = t25 + cos_t0 * p.k12;
    let m43 = p.l * (cos_t1 * t21 + sin_t1 * t20) + m44;
    let m53 = m54 + p.l * (cos_t1 * t17 + sin_t1 * t16);
    let m33 = m43 + (p.k1 + p.l * (cos_t1 * t23 + sin_t1 * t22));
    let m63 = p.l * (cos_t1 * t13 + sin_t1 * t12) + m64;
    let m73 = p.l * (cos_t1 * t8 + sin_t1 * t7) + m74;
    let m32 = p.l * (t25 * cos_t0 + sin_t0 * t24) + m33;
    let m83 = p.half_l_squared_m * (cos_t1 * cos_t6 + sin_t1 * sin_t6) + m84;
    let t28 = sin_q_1 * (sin_t0 * p.half_l_squared_m + p.l * t26);
    let t29 = cos_q_1 * (cos_t0 * p.half_l_squared_m + p.l * t27) + t28;
    let m22 = m32 + (p.k1 + p.l * (cos_t0 * t27 + sin_t0 * t26));
    let m42 = m43 + p.l * (t21 * cos_t0 + sin_t0 * t20);
    let m52 = p.l * (t17 * cos_t0 + sin_t0 * t16) + m53;
    let m62 = p.l * (t13 * cos_t0 + sin_t0 * t12) + m63;
    let m72 = p.l * (t8 * cos_t0 + sin_t0 * t7) + m73;
    let m82 = p.half_l_squared_m * (cos_t6 * cos_t0 + sin_t6 * sin_t0) + m83;
    let m11 = t29 * S::from_f64(2.0) + (m22 + p.k13);
    let m21 = m22 + t29;
    let m31 = m32 + p.l * (t25 * cos_q_1 + t24 * sin_q_1);
    let m41 = p.l * (t21 * cos_q_1 + t20 * sin_q_1) + m42;
    let m51 = p.l * (t17 * cos_q_1 + t16 * sin_q_1) + m52;
    let m61 = p.l * (t13 * cos_q_1 + t12 * sin_q_1) + m62;
    let m71 = p.l * (t8 * cos_q_1 + t7 * sin_q_1) + m72;
    let m81 = p.half_l_squared_m * (cos_t6 * cos_q_1 + sin_t6 * sin_q_1) + m82;
    [
        [m11, m21, m31, m41, m51, m61, m71, m81],
        [m21, m22, m32, m42, m52, m62, m72, m82],
        [m31, m32, m33, m43, m53, m63, m73, m83],
        [m41, m42, m43, m44, m54, m64, m74, m84],
        [m51, m52, m53, m54, m55, m65, m75, m85],
        [m61, m62, m63, m64, m65, m66, m76, m86],
        [m71, m72, m73, m74, m75, m76, m77, m87],
        [m81, m82, m83, m84, m85, m86, m87, p.k1],
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
    let t21 = t19 * (t19 * p.half_l);
    let t22 = sin_q_1 * t2;
    let t23 = cos_q_1 * t2;
    let t24 = t5 * sin_t0;
    let t25 = t5 * cos_t0;
    let t26 = t8 * sin_t3;
    let t27 = t24 + t22;
    let t28 = t8 * cos_t3;
    let t29 = t25 + t23;
    let t30 = p.half_l * t24 + p.l * t22;
    let t31 = p.half_l * t25 + p.l * t23;
    let t32 = t26 + t27;
    let t33 = t11 * sin_t6;
    let t34 = t28 + t29;
    let t35 = t11 * cos_t6;
    let t36 = t33 + t32;
    let t37 = t14 * sin_t9;
    let t38 = t35 + t34;
    let t39 = t14 * cos_t9;
    let t40 = p.half_l * t26 + p.l * t27;
    let t41 = p.half_l * t28 + p.l * t29;
    let t42 = t37 + t36;
    let t43 = t17 * sin_t12;
    let t44 = t39 + t38;
    let t45 = t17 * cos_t12;
    let t46 = p.half_l * t33 + p.l * t32;
    let t47 = p.half_l * t35 + p.l * t34;
    let t48 = t43 + t42;
    let t49 = t20 * sin_t15;
    let t50 = t45 + t44;
    let t51 = t20 * cos_t15;
    let t52 = p.half_l * t37 + p.l * t36;
    let t53 = p.half_l * t39 + p.l * t38;
    let t54 = p.half_l * t43 + p.l * t42;
    let t55 = p.half_l * t45 + p.l * t44;
    let t56 = t21 * sin_t18 + p.l * (t49 + t48);
    let t57 = p.half_l * t49 + p.l * t48;
    let t58 = t21 * cos_t18 + p.l * (t51 + t50);
    let t59 = p.half_l * t51 + p.l * t50;
    let t60 = t56 + t57;
    let t61 = t58 + t59;
    let t62 = t60 + t54;
    let t63 = t61 + t55;
    let h_q_8 = (sin_t18 * t58 - cos_t18 * t56) * p.half_l_m;
    let t64 = t62 + t52;
    let t65 = t63 + t53;
    let t66 = cos_t15 * (p.m * t56 + t57 * p.half_m);
    let t67 = t64 + t46;
    let t68 = cos_t12 * (p.m * t60 + t54 * p.half_m);
    let t69 = t65 + t47;
    let h_q_7 = p.l * (sin_t15 * (p.m * t58 + t59 * p.half_m) - t66) + h_q_8;
    let t70 = cos_t9 * (p.m * t62 + t52 * p.half_m);
    let h_q_6 = p.l * (sin_t12 * (p.m * t61 + t55 * p.half_m) - t68) + h_q_7;
    let t71 = p.m * (t67 + t40);
    let t72 = cos_t6 * (p.m * t64 + t46 * p.half_m);
    let t73 = p.m * (t69 + t41);
    let h_q_5 = p.l * (sin_t9 * (p.m * t63 + t53 * p.half_m) - t70) + h_q_6;
    let t74 = cos_t3 * (p.m * t67 + t40 * p.half_m);
    let h_q_4 = p.l * (sin_t6 * (p.m * t65 + t47 * p.half_m) - t72) + h_q_5;
    let h_q_3 = p.l * (sin_t3 * (p.m * t69 + t41 * p.half_m) - t74) + h_q_4;
    let t75 = cos_q_1 * (t71 + (p.m * t30 + t22 * p.quarter_l_m));
    let t76 = sin_t0 * (t73 + t31 * p.half_m) - cos_t0 * (t71 + t30 * p.half_m);
    let h_q_2 = p.l * t76 + h_q_3;
    let t77 = p.l * (sin_q_1 * (t73 + (p.m * t31 + p.quarter_l_m * t23)) - t75);
    let h_q_1 = t77 + h_q_2;
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
    let t7 = sin_t6 * p.half_l_m_g + p.k2 * sin_t5;
    let t8 = p.k3 * sin_t4 + t7;
    let t9 = p.k4 * sin_t3 + t8;
    let t10 = p.k5 * sin_t2 + t9;
    let t11 = p.k6 * sin_t1 + t10;
    let t12 = p.k7 * sin_t0 + t11;
    let q_q_1 = -(p.k8 * sin_q_1 + t12);
    let q_q_2 = -t12;
    let q_q_3 = -t11;
    let q_q_4 = -t10;
    let q_q_5 = -t9;
    let q_q_6 = -t8;
    let q_q_7 = -t7;
    let q_q_8 = sin_t6 * p.minus_half_l_m_g;
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
    let t21 = t19 * (t19 * p.half_l);
    let t22 = sin_q_1 * t2;
    let t23 = cos_q_1 * t2;
    let t24 = t5 * sin_t0;
    let t25 = t5 * cos_t0;
    let t26 = t8 * sin_t3;
    let t27 = t24 + t22;
    let t28 = t8 * cos_t3;
    let t29 = t25 + t23;
    let t30 = p.half_l * t24 + p.l * t22;
    let t31 = t26 + t27;
    let t32 = t11 * sin_t6;
    let t33 = t28 + t29;
    let t34 = t11 * cos_t6;
    let t35 = p.g + (p.half_l * t25 + p.l * t23);
    let t36 = p.half_l * t26 + p.l * t27;
    let t37 = t32 + t31;
    let t38 = t14 * sin_t9;
    let t39 = t34 + t33;
    let t40 = t14 * cos_t9;
    let t41 = p.half_l * t32 + p.l * t31;
    let t42 = t38 + t37;
    let t43 = t17 * sin_t12;
    let t44 = t40 + t39;
    let t45 = t17 * cos_t12;
    let t46 = p.half_l * t38 + p.l * t37;
    let t47 = p.g + (p.half_l * t34 + p.l * t33);
    let t48 = t43 + t42;
    let t49 = t20 * sin_t15;
    let t50 = t45 + t44;
    let t51 = t20 * cos_t15;
    let t52 = p.half_l * t43 + p.l * t42;
    let t53 = p.g + (p.half_l * t40 + p.l * t39);
    let t54 = p.half_l * t49 + p.l * t48;
    let t55 = p.g + (p.half_l * t45 + p.l * t44);
    let t56 = t21 * sin_t18 + p.l * (t49 + t48);
    let t57 = p.g + (p.half_l * t28 + p.l * t29);
    let t58 = p.g + (p.half_l * t51 + p.l * t50);
    let t59 = t56 + t54;
    let t60 = p.g + (t21 * cos_t18 + p.l * (t51 + t50));
    let t61 = t59 + t52;
    let t62 = t60 + t58;
    let t63 = t61 + t46;
    let t64 = t62 + t55;
    let f_q_8 = (cos_t18 * t56 - sin_t18 * t60) * p.half_l_m;
    let t65 = sin_t15 * (p.m * t60 + t58 * p.half_m);
    let t66 = t63 + t41;
    let t67 = t64 + t53;
    let t68 = sin_t12 * (p.m * t62 + t55 * p.half_m);
    let f_q_7 = p.l * (cos_t15 * (p.m * t56 + p.half_m * t54) - t65) + f_q_8;
    let t69 = t67 + t47;
    let t70 = sin_t9 * (p.m * t64 + t53 * p.half_m);
    let f_q_6 = p.l * (cos_t12 * (p.m * t59 + p.half_m * t52) - t68) + f_q_7;
    let t71 = p.m * (t66 + t36);
    let t72 = sin_t6 * (p.m * t67 + t47 * p.half_m);
    let f_q_5 = p.l * (cos_t9 * (p.m * t61 + p.half_m * t46) - t70) + f_q_6;
    let t73 = p.m * (t69 + t57);
    let t74 = sin_t3 * (p.m * t69 + t57 * p.half_m);
    let f_q_4 = p.l * (cos_t6 * (p.m * t63 + p.half_m * t41) - t72) + f_q_5;
    let f_q_3 = p.l * (cos_t3 * (p.m * t66 + p.half_m * t36) - t74) + f_q_4;
    let t75 = sin_q_1 * (t73 + (p.m * t35 + p.half_m * (p.g + p.half_l * t23)));
    let t76 = cos_t0 * (t71 + p.half_m * t30) - sin_t0 * (t73 + t35 * p.half_m);
    let f_q_2 = p.l * t76 + f_q_3;
    let t77 = p.l * (cos_q_1 * (t71 + (p.m * t30 + t22 * p.quarter_l_m)) - t75);
    let f_q_1 = t77 + f_q_2;
    [f_q_1, f_q_2, f_q_3, f_q_4, f_q_5, f_q_6, f_q_7, f_q_8]
}

::lagrangian::emitted::fast_function! {
    /// Accelerations `a`, the solution of `M a = f` eliminated along the machine, pivots ahead.
    ///
    /// A pivot that vanishes is an error.
    ///
    /// Velocities are eliminated from the tips of the machine to the ground, with the inertia `G`
    /// and the loads `g` that remain on them. Comments name these numbers where they are computed,
    /// up to signs and factors that depend on parameters alone, for coordinate `i` or the velocity
    /// in its place; `k` are the velocities that follow:
    ///
    /// ```text
    /// d[i] = G[i, i], l[i] = G[i, k]/d[i], z[i] = g[i]/d[i]
    /// a[i] = z[i] - sum l[i]*a[k]
    /// ```
    pub fn accelerations<'a, S>(Accelerations { p: &'a Prepared<S>, q: &'a [S; 8], v: &'a [S; 8] })
        -> Result<[S; 8], ::lagrangian::emitted::Singular> = accelerations_in;
}

#[inline(always)]
fn accelerations_in<S: Copy, N: ::lagrangian::emitted::Scalar<Stored = S>>(
    call: Accelerations<'_, S>,
) -> Result<[S; 8], ::lagrangian::emitted::Singular> {
    let Accelerations { p, q, v } = call;
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
    let t21 = t19 * (n(p.half_l_m) * t19);
    let t22 = n(p.l) * cos_q_1;
    let t23 = n(p.l) * sin_q_1;
    let t24 = n(p.l) * cos_t0;
    let t25 = n(p.l) * sin_t0;
    let t26 = t23 * t8;
    let t27 = cos_t0 * t10;
    let t28 = n(p.l) * cos_t1;
    let t29 = n(p.l) * sin_t1;
    let t30 = sin_t0 * (sin_q_1 * n(p.half_l_squared));
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
    let t44 = sin_t0.mul_add(t10 * n(p.half_l), t26);
    let t45 = n(p.l) * cos_t4;
    let t46 = n(p.m) * t38;
    let t47 = n(p.l) * sin_t4;
    let t48 = n(p.m) * t40;
    let t49 = t40 * t16;
    let t50 = t38 * t16;
    let t51 = n(p.l).mul_add(cos_q_1.mul_add(t8, t27), n(p.g));
    let t52 = n(p.g) + n(p.half_l).mul_add(t27, t22 * t8);
    let t53 = n(p.l) * sin_t5;
    let t54 = n(p.l) * cos_t5;
    let t55 = t45 * t18;
    let t56 = t47 * t18;
    let t57 = t53 * n(p.k18);
    let t58 = t54 * n(p.k18);
    let t59 = sin_t6 * cos_t6;
    let t60 = sin_t6 * sin_t6;
    let t61 = cos_t6 * cos_t6;
    let t62 = t54.mul_add(cos_t6, sin_t6 * t53);
    let t63 = t59 * n(p.k14);
    let t64 = n(p.k14).neg_mul_add(t60, N::from_f64(2.5));
    let t65 = n(p.k14).neg_mul_add(t61, N::from_f64(2.5));
    let t66 = t54 * t20;
    let t67 = n(p.k19) * t59;
    let t68 = t62 * n(p.k19);
    let t69 = t62 * n(p.k14);
    let t70 = t54.mul_add(t58, t53.mul_add(t57, n(p.k15)));
    // Eliminates q[7]: inertia d[q[7]].
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
    let t81 = t74.mul_add(t47 * n(p.m), n(p.k15));
    let t82 = n(p.k19).neg_mul_add(t61, n(p.k18));
    let t83 = t78.mul_add(t82, t67.mul_add(t66, sin_t6 * t21));
    let t84 = sin_q_1 * n(p.half_l_m_g);
    let t85 = t44 * (cos_t0 * n(p.half_l_m));
    let t86 = n(p.k19).neg_mul_add(t60, n(p.k18));
    let t87 = t66.mul_add(t86, t67.mul_add(t78, cos_t6 * t21));
    let t88 = t44.neg_mul_add(cos_q_1 * n(p.l_m), t84);
    let t89 = t79 * t80;
    let t90 = t79 * t77;
    let t91 = t79.neg_mul_add(t76 * (n(p.m) * t76), N::ONE + t64);
    let t92 = t79 * t73;
    let t93 = t53.mul_sub(t87, t54 * t83);
    let t94 = t79 * t72;
    // Eliminates q[6]: inertia d[q[6]].
    let t95 = t80.neg_mul_add(t89, t75.mul_add(t45 * n(p.m), t81));
    let t96 = t89.neg_mul_add(t76, t74);
    let t97 = t90.mul_add(t76, t59 * n(p.k16));
    let t98 = t80.neg_mul_add(t90, t75);
    let t99 = t90.neg_mul_add(n(p.m) * t77, N::ONE + t65);
    let t100 = t72.mul_add(t92, t67);
    let t101 = N::ONE / t95;
    let t102 = t46.neg_mul_add(t97, t40 * t91);
    let t103 = t98.mul_add(t38, t96 * t40);
    let t104 = t38.mul_sub(t99, t48 * t97);
    let t105 = t55.mul_add(t100, t92.mul_add(t93, t83));
    let t106 = t56.neg_mul_add(t73.mul_sub(t92, n(p.m) * t65), t105);
    let t107 = t56.mul_add(t100, t93.neg_mul_add(t94, t87));
    let t108 = t55.neg_mul_add(t72.mul_sub(t94, n(p.m) * t64), t107);
    let t109 = t101 * n(p.m_squared);
    let t110 = n(p.m) * t101;
    let t111 = t101.mul_add(t98 * t96, t97);
    let t112 = t109 * t103;
    let t113 = t96 * t110;
    let t114 = t98 * t110;
    let t115 = t47.mul_sub(t108, t45 * t106);
    let t116 = n(p.m_squared) * t111;
    let t117 = t46.mul_add(t104, t48.mul_add(t102, n(p.k15)));
    // Eliminates q[5]: inertia d[q[5]].
    let t118 = t103.neg_mul_add(t112, t117);
    let t119 = t96.neg_mul_add(t113, N::ONE + t91);
    let t120 = t96.neg_mul_add(t112, n(p.m) * t102);
    let t121 = t98.neg_mul_add(t114, N::ONE + t99);
    let t122 = t98.neg_mul_add(t112, n(p.m) * t104);
    let t123 = t103.neg_mul_add(t113, t102);
    let t124 = N::ONE / t118;
    let t125 = t33.mul_sub(t119, t39 * t111);
    let t126 = t32.mul_sub(t121, t41 * t111);
    let t127 = t103.neg_mul_add(t114, t104);
    let t128 = t122.mul_add(t32, t120 * t33);
    let t129 = t49 * t109.neg_mul_add(t98 * t98, n(p.m) * t99);
    let t130 = t50 * t109.neg_mul_add(t96 * t96, n(p.m) * t91);
    let t131 = t114.mul_add(t115, t106) + t116.mul_add(t50, t129);
    let t132 = t113.neg_mul_add(t115, t108) + t116.mul_add(t49, t130);
    let t133 = t124 * t128;
    let t134 = t124 * t127;
    let t135 = t124.neg_mul_add(t123 * (n(p.m) * t123), N::ONE + t119);
    let t136 = t124 * t122;
    let t137 = t124 * t120;
    let t138 = t39.mul_add(t126, t41.mul_add(t125, n(p.k15)));
    // Eliminates q[4]: inertia d[q[4]].
    let t139 = t128.neg_mul_add(t133, t138);
    let t140 = t133.neg_mul_add(t123, t125);
    let t141 = t134.mul_add(t123, t111);
    let t142 = t128.neg_mul_add(t134, t126);
    let t143 = t134.neg_mul_add(n(p.m) * t127, N::ONE + t121);
    let t144 = t40.mul_sub(t132, t38 * t131);
    let t145 = t120.mul_add(t136, t116);
    let t146 = N::ONE / t139;
    let t147 = t35.neg_mul_add(t141, t29 * t135);
    let t148 = t142.mul_add(t28, t140 * t29);
    let t149 = t28.mul_sub(t143, t34 * t141);
    let t150 = t42.mul_add(t145, t136.mul_add(t144, t131));
    let t151 = t43.neg_mul_add(t122.mul_sub(t136, n(p.m) * t121), t150);
    let t152 = t43.mul_add(t145, t144.neg_mul_add(t137, t132));
    let t153 = t42.neg_mul_add(t120.mul_sub(t137, n(p.m) * t119), t152);
    let t154 = n(p.m_squared) * t146;
    let t155 = t146.mul_add(t142 * t140, t141);
    let t156 = n(p.m) * t146;
    let t157 = t154 * t148;
    let t158 = n(p.m) * t155;
    let t159 = t140 * t156;
    let t160 = t142 * t156;
    let t161 = n(p.m_squared) * t155;
    let t162 = t33.mul_sub(t153, t32 * t151);
    let t163 = t35.mul_add(t149, t34.mul_add(t147, n(p.k15)));
    // Eliminates q[3]: inertia d[q[3]].
    let t164 = t148.neg_mul_add(t157, t163);
    let t165 = t140.neg_mul_add(t157, n(p.m) * t147);
    let t166 = t140.neg_mul_add(t159, t135 + N::from_f64(0.5));
    let t167 = t142.neg_mul_add(t157, n(p.m) * t149);
    let t168 = t142.neg_mul_add(t160, t143 + N::from_f64(0.5));
    let t169 = N::ONE / t164;
    let t170 = t25.mul_sub(t166, t24 * t158);
    let t171 = t24.mul_sub(t168, t25 * t158);
    let t172 = t36 * t154.neg_mul_add(t142 * t142, n(p.m) * t143);
    let t173 = t167.mul_add(t24, t165 * t25);
    let t174 = cos_t0.mul_add(cos_q_1 * n(p.half_l_squared), t30);
    let t175 = t37 * t154.neg_mul_add(t140 * t140, n(p.m) * t135);
    let t176 = t160.mul_add(t162, t151) + t161.mul_add(t37, t172);
    let t177 = t167.mul_add(t22, t165 * t23);
    let t178 = t170.mul_add(n(p.m) * t25, n(p.k1));
    let t179 = t159.neg_mul_add(t162, t153) + t161.mul_add(t36, t175);
    let t180 = t171.mul_add(n(p.m) * t24, t178);
    // Eliminates q[2]: inertia d[q[2]].
    let t181 = t169.neg_mul_add(t173 * t173, t180);
    let t182 = t169 * t177;
    let t183 = t166.mul_sub(t23, t158 * t22);
    let t184 = t29.mul_sub(t179, t28 * t176);
    let t185 = t169 * t165;
    let t186 = t169 * t167;
    let t187 = N::ONE / t181;
    let t188 = n(p.m) * t171.mul_add(t22, t170.mul_add(t23, t174));
    let t189 = t173.mul_sub(t182, t188);
    let t190 = t183.mul_add(n(p.m) * t23, n(p.k17));
    let t191 = t165.mul_add(t186, t161);
    let t192 = t168.mul_sub(t22, t158 * t23).mul_add(n(p.m) * t22, t190);
    let t193 = t31.mul_add(t191, t184.neg_mul_add(t185, t179));
    let t194 = t51.neg_mul_add(t165.mul_sub(t185, n(p.m) * t166), t193);
    let t195 = t191.mul_add(t51, t186.mul_add(t184, t176));
    let t196 = t31.neg_mul_add(t167.mul_sub(t186, n(p.m) * t168), t195);
    let t197 = t187 * t189;
    let t198 = t52.mul_sub(sin_t0 * n(p.half_l_m), t85);
    // Eliminates q[1]: inertia d[q[1]].
    let t199 = t189.neg_mul_add(t197, t177.neg_mul_add(t182, t192));
    let t200 = t24.neg_mul_add(t196, t25.mul_add(t194, t198));
    let t201 = t23.mul_add(t194, t52.mul_add(sin_q_1 * n(p.l_m), t88));
    let t202 = t197.mul_add(t200, t22.neg_mul_add(t196, t201));
    let t203 = N::ONE / t199 * t202;
    // Eliminates q[2]: alone z[q[2]].
    let t204 = t197.mul_add(t203, t187 * t200);
    let t205 = t25.neg_mul_add(t204, t23.neg_mul_add(t203, t51));
    let t206 = t24.mul_add(t204, t22.mul_add(t203, t31));
    // Eliminates q[3]: alone z[q[3]].
    let t207 = t186.neg_mul_add(t206, t185.mul_add(t205, t169 * t184));
    let t208 = t29.neg_mul_add(t207, t37 + t205);
    let t209 = t28.mul_add(t207, t36 + t206);
    // Eliminates q[4]: alone z[q[4]].
    let t210 = t160.neg_mul_add(t209, t159.mul_add(t208, t146 * t162));
    let t211 = t33.neg_mul_add(t210, t42 + t208);
    let t212 = t32.mul_add(t210, t43 + t209);
    // Eliminates q[5]: alone z[q[5]].
    let t213 = t136.neg_mul_add(t212, t137.mul_add(t211, t124 * t144));
    let t214 = t40.neg_mul_add(t213, t50 + t211);
    let t215 = t38.mul_add(t213, t49 + t212);
    // Eliminates q[6]: alone z[q[6]].
    let t216 = t114.neg_mul_add(t215, t113.mul_add(t214, t101 * t115));
    let t217 = t47.neg_mul_add(t216, t55 + t214);
    let t218 = t45.mul_add(t216, t56 + t215);
    // Eliminates q[7]: alone z[q[7]].
    let t219 = t92.neg_mul_add(t218, t94.mul_add(t217, t79 * t93));
    let t220 = sin_t6 * t53.neg_mul_add(t219, t66 + t217);
    let t221 = cos_t6.mul_sub(t54.mul_add(t219, t78 + t218), t220);
    let q_1_ddot = -t203;
    let q_2_ddot = t203 - t204;
    let q_3_ddot = t204 - t207;
    let q_4_ddot = t207 - t210;
    let q_5_ddot = t210 - t213;
    let q_6_ddot = t213 - t216;
    let q_7_ddot = t216 - t219;
    let q_8_ddot = t221.mul_add(n(p.k20), t219);
    let sound = PIVOTS.hold(t71, t71)
        & PIVOTS.hold(t95, t95)
        & PIVOTS.hold(t118, t118)
        & PIVOTS.hold(t139, t139)
        & PIVOTS.hold(t164, t164)
        & PIVOTS.hold(t181, t181)
        & PIVOTS.hold(t199, t199)
        & q_8_ddot.is_finite();
    if !sound {
        let pivots = [
            (6, t71, t71),
            (5, t95, t95),
            (4, t118, t118),
            (3, t139, t139),
            (2, t164, t164),
            (1, t181, t181),
            (0, t199, t199),
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
    let t15 = t14 * p.half_l;
    let t16 = t1 * cos_t0;
    let t17 = t1 * sin_t0;
    let t18 = t4 * cos_t3;
    let t19 = t16 + q_1_dot * cos_q_1;
    let t20 = t4 * sin_t3;
    let t21 = t17 + q_1_dot * sin_q_1;
    let t22 = p.half_l * t16 + cos_q_1 * t2;
    let t23 = p.half_l * t17 + sin_q_1 * t2;
    let t24 = t18 + t19;
    let t25 = t6 * cos_t5;
    let t26 = t20 + t21;
    let t27 = t6 * sin_t5;
    let t28 = t25 + t24;
    let t29 = p.half_l * t18 + p.l * t19;
    let t30 = t8 * cos_t7;
    let t31 = p.half_l * t20 + p.l * t21;
    let t32 = t27 + t26;
    let t33 = p.half_l * t25 + p.l * t24;
    let t34 = t8 * sin_t7;
    let t35 = t30 + t28;
    let t36 = t10 * cos_t9;
    let t37 = p.half_l * t27 + p.l * t26;
    let t38 = p.half_l * t30 + p.l * t28;
    let t39 = t34 + t32;
    let t40 = t10 * sin_t9;
    let t41 = t36 + t35;
    let t42 = S::from_f64(0.5) * (p.m * (t23 * t23 + t22 * t22) + t1 * (t1 * p.J));
    let t43 = p.half_l * t34 + p.l * t32;
    let t44 = p.half_l * t36 + p.l * t35;
    let t45 = t40 + t39;
    let t46 = t12 * cos_t11;
    let t47 = S::from_f64(0.5) * (p.m * (t31 * t31 + t29 * t29) + t4 * (t4 * p.J));
    let t48 = p.half_l * t40 + p.l * t39;
    let t49 = t12 * sin_t11;
    let t50 = p.half_l * t46 + p.l * t41;
    let t51 = S::from_f64(0.5) * (p.m * (t37 * t37 + t33 * t33) + t6 * (t6 * p.J));
    let t52 = p.half_l * t49 + p.l * t45;
    let t53 = t15 * cos_t13 + p.l * (t46 + t41);
    let t54 = S::from_f64(0.5) * (p.m * (t43 * t43 + t38 * t38) + t8 * (t8 * p.J));
    let t55 = t15 * sin_t13 + p.l * (t49 + t45);
    let t56 = S::from_f64(0.5) * (p.m * (t48 * t48 + t44 * t44) + t10 * (t10 * p.J));
    let t57 = S::from_f64(0.5) * (p.m * (t52 * t52 + t50 * t50) + t12 * (t12 * p.J));
    let t58 = t57 + (t56 + (t54 + (t51 + (t47 + (t42 + q_1_dot * (q_1_dot * p.k0))))));
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
    let t10 = p.m_g * (p.half_l * cos_t0 + p.l * cos_q_1) + cos_q_1 * p.half_l_m_g;
    let t11 = cos_t3 + t9;
    let t12 = p.m_g * (p.half_l * cos_t1 + p.l * t7) + t10;
    let t13 = cos_t4 + t11;
    let t14 = p.m_g * (p.half_l * cos_t2 + p.l * t8) + t12;
    let t15 = p.m_g * (p.half_l * cos_t3 + p.l * t9) + t14;
    let t16 = p.m_g * (p.half_l * cos_t4 + p.l * t11) + t15;
    let t17 = p.m_g * (p.half_l * cos_t6 + p.l * (cos_t5 + t13));
    -(t17 + (p.m_g * (p.half_l * cos_t5 + p.l * t13) + t16))
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
    inputs Inputs {} [], defined here
    outputs Outputs {} [], defined here
    prepared Prepared {
        l, m, J, g, half_l, l_squared_m, m_g, half_l_m_g, l_m, k0, k1, half_l_m, half_m,
        quarter_l_m, k2, k3, k4, k5, k6, k7, k8, half_l_squared_m, k9, k10, two_l_m, three_l_m,
        four_l_m, k11, k12, k13, minus_half_l_m_g, k14, k15, k16, half_l_squared, m_squared, k17,
        k18, k19, k20,
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
