// @generated from machines/chain.machine by `cargo xtask generate`; edits are lost.

//! A chain of N uniform bars hanging from a hinge. Angles are absolute, from the downward vertical.
//!
//! 8 coordinates, 4 parameters, 1 output. Arithmetic of one call:
//!
//! | function | mul | add | div | sin cos | other | temporaries |
//! | --- | --: | --: | --: | --: | --: | --: |
//! | `prepare` | 43 | 19 | 1 | 0 | 0 | 63 |
//! | `mass_matrix` | 84 | 28 | 0 | 8 | 0 | 128 |
//! | `bias` | 103 | 60 | 0 | 8 | 0 | 179 |
//! | `applied` | 8 | 0 | 0 | 8 | 0 | 16 |
//! | `forces` | 104 | 68 | 0 | 8 | 0 | 188 |
//! | `accelerations` | 324 | 192 | 7 | 8 | 0 | 539 |
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
    /// Length, mass and inertia (about its middle) of a bar. Unit: `m`. Default: 0.2.
    pub l: S,
    /// `m`. Unit: `kg`. Default: 0.5.
    pub m: S,
    /// `J`. Unit: `kg*m^2`. Default: 1/600.
    pub J: S,
    /// `g`. Unit: `m/s^2`. Default: 9.81.
    pub g: S,
}

impl<S: ::lagrangian::emitted::Scalar> Chain<S> {
    /// Computes what depends on the parameters alone, once.
    pub fn prepare(&self) -> Prepared<S> {
        let l_m = self.l * self.m;
        let t0 = self.l * self.l;
        let t1 = self.l * l_m;
        let t2 = self.g * l_m;
        let half_l_m = S::from_f64(0.5) * l_m;
        let t3 = t1 * S::from_f64(0.25);
        let k14 = self.J + t3;
        let t4 = S::ONE / k14;
        let t5 = S::from_f64(0.25) * t4;
        let half_l = self.l * S::from_f64(0.5);
        let m_g = self.m * self.g;
        let k0 = S::from_f64(0.125) * (self.J * S::from_f64(4.0) + t1);
        let half_l_squared_m = S::from_f64(0.5) * t1;
        let k1 = t1 * S::from_f64(1.5);
        let k2 = t1 * S::from_f64(2.5);
        let k3 = t1 * S::from_f64(3.5);
        let k4 = t1 * S::from_f64(4.5);
        let k5 = t1 * S::from_f64(5.5);
        let k6 = t1 * S::from_f64(6.5);
        let k7 = self.J + t1 * S::from_f64(7.25);
        let k8 = self.J + t1 * S::from_f64(6.25);
        let k9 = self.J + t1 * S::from_f64(5.25);
        let k10 = self.J + t1 * S::from_f64(4.25);
        let k11 = self.J + t1 * S::from_f64(3.25);
        let k12 = self.J + t1 * S::from_f64(2.25);
        let k13 = self.J + t1 * S::from_f64(1.25);
        let half_m = self.m * S::from_f64(0.5);
        let quarter_l_m = l_m * S::from_f64(0.25);
        let k15 = -(t2 * S::from_f64(7.5));
        let k16 = -(t2 * S::from_f64(6.5));
        let k17 = -(t2 * S::from_f64(5.5));
        let k18 = -(t2 * S::from_f64(4.5));
        let k19 = -(t2 * S::from_f64(3.5));
        let k20 = -(t2 * S::from_f64(2.5));
        let k21 = -(t2 * S::from_f64(1.5));
        let minus_half_l_m_g = -(S::from_f64(0.5) * t2);
        let minus_l = -self.l;
        let k22 = t1 * t5;
        let k23 = self.J - t3;
        let k24 = t5 * t0;
        let half_l_squared = S::from_f64(0.5) * t0;
        let m_squared = self.m * self.m;
        let k25 = half_l_m * t4;
        let k26 = self.m * S::from_f64(1.5);
        let k27 = t5 * (l_m * l_m);
        let pivots = [(7, k14, k14)];
        Prepared {
            l: self.l,
            m: self.m,
            J: self.J,
            g: self.g,
            half_l,
            m_g,
            l_m,
            k0,
            half_l_squared_m,
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
            half_m,
            quarter_l_m,
            half_l_m,
            k15,
            k16,
            k17,
            k18,
            k19,
            k20,
            k21,
            minus_half_l_m_g,
            minus_l,
            k22,
            k23,
            k24,
            half_l_squared,
            m_squared,
            k25,
            k26,
            k27,
            singular: PIVOTS.vanished(pivots),
        }
    }

    /// The start values of the description, at rest and `t = 0`.
    pub fn start(&self) -> ::lagrangian::emitted::State<Coordinates<S>> {
        let q_1 = S::from_ratio(3, 10);
        let q = [q_1, q_1, q_1, q_1, q_1, q_1, q_1, q_1];
        let v = [S::ZERO; 8];
        ::lagrangian::emitted::State {
            t: 0.0,
            q: Coordinates::from_array(q),
            v: Coordinates::from_array(v),
        }
    }
}

/// The coordinates of [`Chain`], or their rates, by name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coordinates<S = f64> {
    /// `q`. Unit: `rad`. Members: `q[1]` to `q[8]`.
    pub q: [S; 8],
}

/// What can be observed of a [`Chain`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outputs<S = f64> {
    /// Height of the chain's end above the hinge. Unit: `m`.
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
    half_l: S,
    /// `m*g`
    m_g: S,
    /// `l*m`
    l_m: S,
    /// `0.125*(l^2*m + 4*J)`
    k0: S,
    /// `0.5*l^2*m`
    half_l_squared_m: S,
    /// `1.5*l^2*m`
    k1: S,
    /// `2.5*l^2*m`
    k2: S,
    /// `3.5*l^2*m`
    k3: S,
    /// `4.5*l^2*m`
    k4: S,
    /// `5.5*l^2*m`
    k5: S,
    /// `6.5*l^2*m`
    k6: S,
    /// `J + 7.25*l^2*m`
    k7: S,
    /// `J + 6.25*l^2*m`
    k8: S,
    /// `J + 5.25*l^2*m`
    k9: S,
    /// `J + 4.25*l^2*m`
    k10: S,
    /// `J + 3.25*l^2*m`
    k11: S,
    /// `J + 2.25*l^2*m`
    k12: S,
    /// `J + 1.25*l^2*m`
    k13: S,
    /// `J + 0.25*l^2*m`
    k14: S,
    /// `0.5*m`
    half_m: S,
    /// `0.25*l*m`
    quarter_l_m: S,
    /// `0.5*l*m`
    half_l_m: S,
    /// `-7.5*l*m*g`
    k15: S,
    /// `-6.5*l*m*g`
    k16: S,
    /// `-5.5*l*m*g`
    k17: S,
    /// `-4.5*l*m*g`
    k18: S,
    /// `-3.5*l*m*g`
    k19: S,
    /// `-2.5*l*m*g`
    k20: S,
    /// `-1.5*l*m*g`
    k21: S,
    /// `-0.5*l*m*g`
    minus_half_l_m_g: S,
    /// `-l`
    minus_l: S,
    /// `0.25*l^2*m/(J + 0.25*l^2*m)`
    k22: S,
    /// `J - 0.25*l^2*m`
    k23: S,
    /// `0.25*l^2/(J + 0.25*l^2*m)`
    k24: S,
    /// `0.5*l^2`
    half_l_squared: S,
    /// `m^2`
    m_squared: S,
    /// `0.5*l*m/(J + 0.25*l^2*m)`
    k25: S,
    /// `1.5*m`
    k26: S,
    /// `0.25*l^2*m^2/(J + 0.25*l^2*m)`
    k27: S,
    /// Why these parameters leave the machine without accelerations, if they do.
    singular: Option<::lagrangian::emitted::Singular>,
}

/// A pivot of an elimination that is not above this share of its diagonal element may be rounding
/// errors alone.
const PIVOTS: ::lagrangian::emitted::Pivots = ::lagrangian::emitted::Pivots::new(8, 8);

/// Mass matrix `M`.
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
pub fn mass_matrix<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 8]) -> [[S; 8]; 8] {
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
    let m21 = (cos_q_2 * cos_q_1 + sin_q_2 * sin_q_1) * p.k6;
    let m31 = p.k5 * (cos_q_1 * cos_q_3 + sin_q_1 * sin_q_3);
    let m32 = p.k5 * (cos_q_2 * cos_q_3 + sin_q_2 * sin_q_3);
    let m41 = p.k4 * (cos_q_1 * cos_q_4 + sin_q_1 * sin_q_4);
    let m42 = p.k4 * (cos_q_2 * cos_q_4 + sin_q_2 * sin_q_4);
    let m43 = p.k4 * (cos_q_3 * cos_q_4 + sin_q_3 * sin_q_4);
    let m51 = p.k3 * (cos_q_1 * cos_q_5 + sin_q_1 * sin_q_5);
    let m52 = p.k3 * (cos_q_2 * cos_q_5 + sin_q_2 * sin_q_5);
    let m53 = p.k3 * (cos_q_3 * cos_q_5 + sin_q_3 * sin_q_5);
    let m54 = p.k3 * (cos_q_4 * cos_q_5 + sin_q_4 * sin_q_5);
    let m61 = p.k2 * (cos_q_1 * cos_q_6 + sin_q_1 * sin_q_6);
    let m62 = p.k2 * (cos_q_2 * cos_q_6 + sin_q_2 * sin_q_6);
    let m63 = p.k2 * (cos_q_3 * cos_q_6 + sin_q_3 * sin_q_6);
    let m64 = p.k2 * (cos_q_4 * cos_q_6 + sin_q_4 * sin_q_6);
    let m65 = p.k2 * (cos_q_5 * cos_q_6 + sin_q_5 * sin_q_6);
    let m71 = p.k1 * (cos_q_1 * cos_q_7 + sin_q_1 * sin_q_7);
    let m72 = p.k1 * (cos_q_2 * cos_q_7 + sin_q_2 * sin_q_7);
    let m73 = p.k1 * (cos_q_3 * cos_q_7 + sin_q_3 * sin_q_7);
    let m74 = p.k1 * (cos_q_4 * cos_q_7 + sin_q_4 * sin_q_7);
    let m75 = p.k1 * (cos_q_5 * cos_q_7 + sin_q_5 * sin_q_7);
    let m76 = p.k1 * (cos_q_6 * cos_q_7 + sin_q_6 * sin_q_7);
    let m81 = p.half_l_squared_m * (cos_q_1 * cos_q_8 + sin_q_1 * sin_q_8);
    let m82 = p.half_l_squared_m * (cos_q_2 * cos_q_8 + sin_q_2 * sin_q_8);
    let m83 = p.half_l_squared_m * (cos_q_3 * cos_q_8 + sin_q_3 * sin_q_8);
    let m84 = p.half_l_squared_m * (cos_q_4 * cos_q_8 + sin_q_4 * sin_q_8);
    let m85 = p.half_l_squared_m * (cos_q_5 * cos_q_8 + sin_q_5 * sin_q_8);
    let m86 = p.half_l_squared_m * (cos_q_6 * cos_q_8 + sin_q_6 * sin_q_8);
    let m87 = p.half_l_squared_m * (cos_q_7 * cos_q_8 + sin_q_7 * sin_q_8);
    [
        [p.k7, m21, m31, m41, m51, m61, m71, m81],
        [m21, p.k8, m32, m42, m52, m62, m72, m82],
        [m31, m32, p.k9, m43, m53, m63, m73, m83],
        [m41, m42, m43, p.k10, m54, m64, m74, m84],
        [m51, m52, m53, m54, p.k11, m65, m75, m85],
        [m61, m62, m63, m64, m65, p.k12, m76, m86],
        [m71, m72, m73, m74, m75, m76, p.k13, m87],
        [m81, m82, m83, m84, m85, m86, m87, p.k14],
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
    let (sin_q_2, cos_q_2) = q_2.sin_cos();
    let (sin_q_1, cos_q_1) = q_1.sin_cos();
    let (sin_q_3, cos_q_3) = q_3.sin_cos();
    let (sin_q_4, cos_q_4) = q_4.sin_cos();
    let (sin_q_5, cos_q_5) = q_5.sin_cos();
    let (sin_q_6, cos_q_6) = q_6.sin_cos();
    let (sin_q_7, cos_q_7) = q_7.sin_cos();
    let (sin_q_8, cos_q_8) = q_8.sin_cos();
    let t0 = q_2_dot * q_2_dot;
    let t1 = q_1_dot * q_1_dot;
    let t2 = q_3_dot * q_3_dot;
    let t3 = q_4_dot * q_4_dot;
    let t4 = q_5_dot * q_5_dot;
    let t5 = q_6_dot * q_6_dot;
    let t6 = q_7_dot * q_7_dot;
    let t7 = q_8_dot * (q_8_dot * p.half_l);
    let t8 = t0 * sin_q_2;
    let t9 = sin_q_1 * t1;
    let t10 = t0 * cos_q_2;
    let t11 = cos_q_1 * t1;
    let t12 = t2 * sin_q_3;
    let t13 = t2 * cos_q_3;
    let t14 = t3 * sin_q_4;
    let t15 = t3 * cos_q_4;
    let t16 = t8 + t9;
    let t17 = t4 * sin_q_5;
    let t18 = t10 + t11;
    let t19 = t4 * cos_q_5;
    let t20 = t5 * sin_q_6;
    let t21 = t5 * cos_q_6;
    let t22 = t6 * sin_q_7;
    let t23 = t6 * cos_q_7;
    let t24 = t12 + t16;
    let t25 = t13 + t18;
    let t26 = t14 + t24;
    let t27 = t15 + t25;
    let t28 = t17 + t26;
    let t29 = p.half_l * t17 + p.l * t26;
    let t30 = t19 + t27;
    let t31 = p.half_l * t19 + p.l * t27;
    let t32 = p.half_l * t14 + p.l * t24;
    let t33 = p.half_l * t15 + p.l * t25;
    let t34 = p.half_l * t12 + p.l * t16;
    let t35 = t20 + t28;
    let t36 = p.half_l * t20 + p.l * t28;
    let t37 = t21 + t30;
    let t38 = p.half_l * t21 + p.l * t30;
    let t39 = p.half_l * t13 + p.l * t18;
    let t40 = p.half_l * t8 + p.l * t9;
    let t41 = p.half_l * t22 + p.l * t35;
    let t42 = p.half_l * t23 + p.l * t37;
    let t43 = p.half_l * t10 + p.l * t11;
    let t44 = t7 * sin_q_8 + p.l * (t22 + t35);
    let t45 = t7 * cos_q_8 + p.l * (t23 + t37);
    let t46 = t44 + t41;
    let t47 = t45 + t42;
    let t48 = t46 + t36;
    let t49 = t47 + t38;
    let t50 = t48 + t29;
    let t51 = t49 + t31;
    let t52 = cos_q_7 * (p.m * t44 + t41 * p.half_m);
    let t53 = t50 + t32;
    let t54 = t51 + t33;
    let t55 = cos_q_6 * (p.m * t46 + t36 * p.half_m);
    let t56 = cos_q_5 * (p.m * t48 + t29 * p.half_m);
    let t57 = p.m * (t53 + t34);
    let t58 = p.m * (t54 + t39);
    let t59 = cos_q_4 * (p.m * t50 + t32 * p.half_m);
    let t60 = cos_q_3 * (p.m * t53 + t34 * p.half_m);
    let t61 = sin_q_1 * (t58 + (p.m * t43 + p.quarter_l_m * t11));
    let t62 = sin_q_2 * (t58 + t43 * p.half_m) - cos_q_2 * (t57 + t40 * p.half_m);
    let h_q_1 = p.l * (t61 - cos_q_1 * (t57 + (p.m * t40 + t9 * p.quarter_l_m)));
    let h_q_2 = p.l * t62;
    let h_q_3 = p.l * (sin_q_3 * (p.m * t54 + t39 * p.half_m) - t60);
    let h_q_4 = p.l * (sin_q_4 * (p.m * t51 + t33 * p.half_m) - t59);
    let h_q_5 = p.l * (sin_q_5 * (p.m * t49 + t31 * p.half_m) - t56);
    let h_q_6 = p.l * (sin_q_6 * (p.m * t47 + t38 * p.half_m) - t55);
    let h_q_7 = p.l * (sin_q_7 * (p.m * t45 + t42 * p.half_m) - t52);
    let h_q_8 = (sin_q_8 * t45 - cos_q_8 * t44) * p.half_l_m;
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
pub fn applied<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 8]) -> [S; 8] {
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
    let q_q_1 = p.k15 * sin_q_1;
    let q_q_2 = p.k16 * sin_q_2;
    let q_q_3 = p.k17 * sin_q_3;
    let q_q_4 = p.k18 * sin_q_4;
    let q_q_5 = p.k19 * sin_q_5;
    let q_q_6 = p.k20 * sin_q_6;
    let q_q_7 = p.k21 * sin_q_7;
    let q_q_8 = p.minus_half_l_m_g * sin_q_8;
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
    let (sin_q_2, cos_q_2) = q_2.sin_cos();
    let (sin_q_1, cos_q_1) = q_1.sin_cos();
    let (sin_q_3, cos_q_3) = q_3.sin_cos();
    let (sin_q_4, cos_q_4) = q_4.sin_cos();
    let (sin_q_5, cos_q_5) = q_5.sin_cos();
    let (sin_q_6, cos_q_6) = q_6.sin_cos();
    let (sin_q_7, cos_q_7) = q_7.sin_cos();
    let (sin_q_8, cos_q_8) = q_8.sin_cos();
    let t0 = q_2_dot * q_2_dot;
    let t1 = q_1_dot * q_1_dot;
    let t2 = q_3_dot * q_3_dot;
    let t3 = q_4_dot * q_4_dot;
    let t4 = q_5_dot * q_5_dot;
    let t5 = q_6_dot * q_6_dot;
    let t6 = q_7_dot * q_7_dot;
    let t7 = q_8_dot * (q_8_dot * p.half_l);
    let t8 = t0 * sin_q_2;
    let t9 = t0 * cos_q_2;
    let t10 = sin_q_1 * t1;
    let t11 = cos_q_1 * t1;
    let t12 = t2 * sin_q_3;
    let t13 = t2 * cos_q_3;
    let t14 = t3 * sin_q_4;
    let t15 = t3 * cos_q_4;
    let t16 = t4 * sin_q_5;
    let t17 = t4 * cos_q_5;
    let t18 = t8 + t10;
    let t19 = t9 + t11;
    let t20 = t5 * sin_q_6;
    let t21 = t5 * cos_q_6;
    let t22 = t6 * sin_q_7;
    let t23 = t6 * cos_q_7;
    let t24 = t12 + t18;
    let t25 = t13 + t19;
    let t26 = t14 + t24;
    let t27 = t15 + t25;
    let t28 = t16 + t26;
    let t29 = t17 + t27;
    let t30 = p.half_l * t16 + p.l * t26;
    let t31 = p.half_l * t14 + p.l * t24;
    let t32 = p.half_l * t12 + p.l * t18;
    let t33 = t20 + t28;
    let t34 = t21 + t29;
    let t35 = p.half_l * t20 + p.l * t28;
    let t36 = p.g + (p.half_l * t17 + p.l * t27);
    let t37 = p.g + (p.half_l * t15 + p.l * t25);
    let t38 = p.half_l * t8 + p.l * t10;
    let t39 = p.half_l * t22 + p.l * t33;
    let t40 = p.g + (p.half_l * t21 + p.l * t29);
    let t41 = p.g + (p.half_l * t13 + p.l * t19);
    let t42 = t7 * sin_q_8 + p.l * (t22 + t33);
    let t43 = p.g + (p.half_l * t23 + p.l * t34);
    let t44 = p.g + (p.half_l * t9 + p.l * t11);
    let t45 = t42 + t39;
    let t46 = p.g + (t7 * cos_q_8 + p.l * (t23 + t34));
    let t47 = t45 + t35;
    let t48 = t46 + t43;
    let t49 = t47 + t30;
    let t50 = t48 + t40;
    let t51 = t49 + t31;
    let t52 = t50 + t36;
    let t53 = sin_q_6 * (p.m * t48 + t40 * p.half_m);
    let t54 = sin_q_7 * (p.m * t46 + t43 * p.half_m);
    let t55 = t52 + t37;
    let t56 = sin_q_5 * (p.m * t50 + t36 * p.half_m);
    let t57 = p.m * (t51 + t32);
    let t58 = sin_q_4 * (p.m * t52 + t37 * p.half_m);
    let t59 = p.m * (t55 + t41);
    let t60 = sin_q_3 * (p.m * t55 + t41 * p.half_m);
    let t61 = sin_q_1 * (t59 + (p.m * t44 + p.half_m * (p.g + p.half_l * t11)));
    let t62 = cos_q_2 * (t57 + p.half_m * t38) - sin_q_2 * (t59 + t44 * p.half_m);
    let f_q_1 = p.l * (cos_q_1 * (t57 + (p.m * t38 + t10 * p.quarter_l_m)) - t61);
    let f_q_2 = p.l * t62;
    let f_q_3 = p.l * (cos_q_3 * (p.m * t51 + p.half_m * t32) - t60);
    let f_q_4 = p.l * (cos_q_4 * (p.m * t49 + p.half_m * t31) - t58);
    let f_q_5 = p.l * (cos_q_5 * (p.m * t47 + p.half_m * t30) - t56);
    let f_q_6 = p.l * (cos_q_6 * (p.m * t45 + p.half_m * t35) - t53);
    let f_q_7 = p.l * (cos_q_7 * (p.m * t42 + p.half_m * t39) - t54);
    let f_q_8 = (cos_q_8 * t42 - sin_q_8 * t46) * p.half_l_m;
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
    let angles = [q_7, q_8, q_6, q_5, q_4, q_3, q_2, q_1];
    let circular = N::sin_cos_all(angles);
    let (sin_q_7, cos_q_7) = circular[0];
    let (sin_q_8, cos_q_8) = circular[1];
    let (sin_q_6, cos_q_6) = circular[2];
    let (sin_q_5, cos_q_5) = circular[3];
    let (sin_q_4, cos_q_4) = circular[4];
    let (sin_q_3, cos_q_3) = circular[5];
    let (sin_q_2, cos_q_2) = circular[6];
    let (sin_q_1, cos_q_1) = circular[7];
    let t0 = q_7_dot * q_7_dot;
    let t1 = q_6_dot * q_6_dot;
    let t2 = q_8_dot * (n(p.half_l_m) * q_8_dot);
    let t3 = q_5_dot * q_5_dot;
    let t4 = q_4_dot * q_4_dot;
    let t5 = q_3_dot * q_3_dot;
    let t6 = q_1_dot * q_1_dot;
    let t7 = q_2_dot * q_2_dot;
    let t8 = sin_q_7 * n(p.l);
    let t9 = cos_q_7 * n(p.l);
    let t10 = sin_q_8 * cos_q_8;
    let t11 = sin_q_8 * sin_q_8;
    let t12 = cos_q_6 * n(p.l);
    let t13 = cos_q_8 * cos_q_8;
    let t14 = sin_q_6 * n(p.l);
    let t15 = cos_q_5 * n(p.l);
    let t16 = t8 * n(p.k26);
    let t17 = t9 * n(p.k26);
    let t18 = t10 * n(p.k22);
    let t19 = t11.neg_mul_add(n(p.k22), N::from_f64(2.5));
    let t20 = t13.neg_mul_add(n(p.k22), N::from_f64(2.5));
    let t21 = sin_q_8.mul_add(t8, cos_q_8 * t9);
    let t22 = sin_q_5 * n(p.l);
    let t23 = t21 * n(p.k27);
    let t24 = t14.mul_sub(t19, t12 * t18);
    let t25 = t12.mul_sub(t20, t14 * t18);
    let t26 = n(p.k22) * t21;
    let t27 = t15 * n(p.m);
    let t28 = t9.mul_add(t17, t8.mul_add(t16, n(p.k23)));
    // Eliminates q[7]: inertia d[q[7]].
    let t29 = t21.neg_mul_add(t23, t28);
    let t30 = sin_q_8.neg_mul_add(t23, t16);
    let t31 = cos_q_8.neg_mul_add(t23, t17);
    let t32 = cos_q_8.neg_mul_add(t26, t9 * N::from_f64(1.5));
    let t33 = sin_q_8.neg_mul_add(t26, t8 * N::from_f64(1.5));
    let t34 = n(p.m) * t22;
    let t35 = t0 * t9;
    let t36 = N::ONE / t29;
    let t37 = (t14 * n(p.m)).mul_add(t24, n(p.k23));
    let t38 = t10 * n(p.k27);
    let t39 = t14.mul_add(t30, t12 * t31);
    let t40 = t0 * t8;
    let t41 = cos_q_4 * n(p.l);
    let t42 = sin_q_4 * n(p.l);
    let t43 = t1 * t12;
    let t44 = t1 * t14;
    let t45 = n(p.m) * t41;
    let t46 = t13.neg_mul_add(n(p.k27), n(p.k26));
    let t47 = t40.mul_add(t46, t35.mul_add(t38, sin_q_8 * t2));
    let t48 = n(p.m) * t42;
    let t49 = t3 * t22;
    let t50 = t3 * t15;
    let t51 = t36 * t39;
    let t52 = n(p.m) * t36;
    let t53 = t36.mul_add(t32 * t33, t10 * n(p.k24));
    let t54 = t11.neg_mul_add(n(p.k27), n(p.k26));
    let t55 = t35.mul_add(t54, t38.mul_add(t40, cos_q_8 * t2));
    let t56 = t31 * t36;
    let t57 = t30 * t36;
    let t58 = cos_q_3 * n(p.l);
    // Eliminates q[6]: inertia d[q[6]].
    let t59 = t39.neg_mul_add(t51, (t12 * n(p.m)).mul_add(t25, t37));
    let t60 = (t33 * t33).neg_mul_add(t52, t19 + N::ONE);
    let t61 = t33.neg_mul_add(t51, t24);
    let t62 = (t32 * t32).neg_mul_add(t52, t20 + N::ONE);
    let t63 = t32.neg_mul_add(t51, t25);
    let t64 = t8.mul_sub(t55, t9 * t47);
    let t65 = N::ONE / t59;
    let t66 = t22.mul_sub(t60, t27 * t53);
    let t67 = t15.mul_sub(t62, t34 * t53);
    let t68 = t30.mul_add(t56, t38);
    let t69 = t22.mul_add(t61, t15 * t63);
    let t70 = sin_q_3 * n(p.l);
    let t71 = t43.mul_add(t68, t56.mul_add(t64, t47));
    let t72 = t44.neg_mul_add(t31.mul_sub(t56, t20 * n(p.m)), t71);
    let t73 = t44.mul_add(t68, t57.neg_mul_add(t64, t55));
    let t74 = t43.neg_mul_add(t30.mul_sub(t57, t19 * n(p.m)), t73);
    let t75 = t65 * n(p.m_squared);
    let t76 = n(p.m) * t65;
    let t77 = t65.mul_add(t61 * t63, t53);
    let t78 = n(p.m) * t58;
    let t79 = n(p.m) * t70;
    let t80 = t4 * t41;
    let t81 = cos_q_2 * n(p.l);
    let t82 = t69 * t75;
    let t83 = t61 * t76;
    let t84 = t63 * t76;
    let t85 = n(p.m_squared) * t77;
    let t86 = t27.mul_add(t67, t34.mul_add(t66, n(p.k23)));
    // Eliminates q[5]: inertia d[q[5]].
    let t87 = t69.neg_mul_add(t82, t86);
    let t88 = t61.neg_mul_add(t82, n(p.m) * t66);
    let t89 = t61.neg_mul_add(t83, N::ONE + t60);
    let t90 = t63.neg_mul_add(t84, N::ONE + t62);
    let t91 = t63.neg_mul_add(t82, n(p.m) * t67);
    let t92 = t69.neg_mul_add(t84, t67);
    let t93 = t69.neg_mul_add(t83, t66);
    let t94 = t14.mul_sub(t74, t12 * t72);
    let t95 = N::ONE / t87;
    let t96 = t42.mul_sub(t89, t45 * t77);
    let t97 = t41.mul_sub(t90, t48 * t77);
    let t98 = t42.mul_add(t88, t41 * t91);
    let t99 = (t63 * t63).neg_mul_add(t75, n(p.m) * t62);
    let t100 = (t61 * t61).neg_mul_add(t75, n(p.m) * t60);
    let t101 = t4 * t42;
    let t102 = t84.mul_add(t94, t72) + t49.mul_add(t99, t50 * t85);
    let t103 = t50.mul_add(t100, t49 * t85) + t83.neg_mul_add(t94, t74);
    let t104 = sin_q_2 * n(p.l);
    let t105 = t5 * t70;
    let t106 = t95 * t98;
    let t107 = n(p.m) * t95;
    let t108 = t95.mul_add(t92 * t93, t77);
    let t109 = t91 * t95;
    let t110 = t88 * t95;
    let t111 = t45.mul_add(t97, t48.mul_add(t96, n(p.k23)));
    // Eliminates q[4]: inertia d[q[4]].
    let t112 = t98.neg_mul_add(t106, t111);
    let t113 = t93.neg_mul_add(t106, t96);
    let t114 = (t93 * t93).neg_mul_add(t107, N::ONE + t89);
    let t115 = t92.neg_mul_add(t106, t97);
    let t116 = (t92 * t92).neg_mul_add(t107, N::ONE + t90);
    let t117 = t22.mul_sub(t103, t15 * t102);
    let t118 = N::ONE / t112;
    let t119 = t70.mul_sub(t114, t78 * t108);
    let t120 = t88.mul_add(t109, t85);
    let t121 = t58.mul_sub(t116, t79 * t108);
    let t122 = t70.mul_add(t113, t58 * t115);
    let t123 = t80.mul_add(t120, t109.mul_add(t117, t102));
    let t124 = t101.neg_mul_add(t91.mul_sub(t109, n(p.m) * t90), t123);
    let t125 = t101.mul_add(t120, t110.neg_mul_add(t117, t103));
    let t126 = t80.neg_mul_add(t88.mul_sub(t110, n(p.m) * t89), t125);
    let t127 = n(p.m_squared) * t118;
    let t128 = n(p.m) * t118;
    let t129 = t118.mul_add(t113 * t115, t108);
    let t130 = t5 * t58;
    let t131 = cos_q_1 * n(p.l);
    let t132 = sin_q_1 * n(p.l);
    let t133 = t122 * t127;
    let t134 = t113 * t128;
    let t135 = n(p.m) * t129;
    let t136 = t115 * t128;
    let t137 = t42.mul_sub(t126, t41 * t124);
    let t138 = n(p.m_squared) * t129;
    let t139 = t78.mul_add(t121, t79.mul_add(t119, n(p.k23)));
    // Eliminates q[3]: inertia d[q[3]].
    let t140 = t122.neg_mul_add(t133, t139);
    let t141 = t113.neg_mul_add(t133, n(p.m) * t119);
    let t142 = t113.neg_mul_add(t134, t114 + N::from_f64(0.5));
    let t143 = t115.neg_mul_add(t133, n(p.m) * t121);
    let t144 = t115.neg_mul_add(t136, t116 + N::from_f64(0.5));
    let t145 = N::ONE / t140;
    let t146 = t104.mul_sub(t142, t81 * t135);
    let t147 = cos_q_2 * (cos_q_1 * n(p.half_l_squared));
    let t148 = t81.mul_sub(t144, t104 * t135);
    let t149 = (t115 * t115).neg_mul_add(t127, n(p.m) * t116);
    let t150 = t104.mul_add(t141, t81 * t143);
    let t151 = sin_q_2.mul_add(sin_q_1 * n(p.half_l_squared), t147);
    let t152 = (t113 * t113).neg_mul_add(t127, n(p.m) * t114);
    let t153 = t136.mul_add(t137, t124) + t105.mul_add(t149, t130 * t138);
    let t154 = t132.mul_add(t141, t131 * t143);
    let t155 = (n(p.m) * t104).mul_add(t146, n(p.k14));
    let t156 = t130.mul_add(t152, t105 * t138);
    let t157 = t134.neg_mul_add(t137, t126) + t156;
    let t158 = (n(p.m) * t81).mul_add(t148, t155);
    // Eliminates q[2]: inertia d[q[2]].
    let t159 = t145.neg_mul_add(t150 * t150, t158);
    let t160 = t145 * t154;
    let t161 = t132.mul_sub(t142, t131 * t135);
    let t162 = t141 * t145;
    let t163 = t70.mul_sub(t157, t58 * t153);
    let t164 = t143 * t145;
    let t165 = N::ONE / t159;
    let t166 = t6 * t132;
    let t167 = cos_q_2 * t7;
    let t168 = n(p.m) * t131.mul_add(t148, t132.mul_add(t146, t151));
    let t169 = t150.mul_sub(t160, t168);
    let t170 = t161.mul_add(n(p.m) * t132, n(p.k13));
    let t171 = t131.mul_sub(t144, t132 * t135);
    let t172 = t141.mul_add(t164, t138);
    let t173 = t7.mul_add(t104, t166);
    let t174 = sin_q_2.mul_add(t7 * n(p.half_l), t166);
    let t175 = (n(p.m) * t131).mul_add(t171, t170);
    let t176 = n(p.l).mul_add(cos_q_1.mul_add(t6, t167), n(p.g));
    let t177 = t6.mul_add(t131, n(p.half_l) * t167) + n(p.g);
    let t178 = t165 * t169;
    let t179 = sin_q_1 * n(p.minus_half_l_m_g);
    let t180 = t172.mul_add(t173, t162.neg_mul_add(t163, t157));
    let t181 = t141.mul_sub(t162, n(p.m) * t142).neg_mul_add(t176, t180);
    let t182 = t174 * (n(p.half_l_m) * cos_q_2);
    // Eliminates q[1]: inertia d[q[1]].
    let t183 = t169.neg_mul_add(t178, t154.neg_mul_add(t160, t175));
    let t184 = t174.mul_add(cos_q_1 * n(p.l_m), t179);
    let t185 = t177.mul_sub(n(p.half_l_m) * sin_q_2, t182);
    let t186 = t172.mul_add(t176, t163.mul_add(t164, t153));
    let t187 = t173.neg_mul_add(t143.mul_sub(t164, n(p.m) * t144), t186);
    let t188 = t81.neg_mul_add(t187, t104.mul_add(t181, t185));
    let t189 = t132.mul_add(t181, t177.mul_sub(sin_q_1 * n(p.l_m), t184));
    let t190 = t178.mul_add(t188, t131.neg_mul_add(t187, t189));
    let t191 = N::ONE / t183 * t190;
    // Eliminates q[2]: alone z[q[2]]; Back substitution: a[q[2]].
    let t192 = t178.mul_add(t191, t165 * t188);
    let t193 = t81.mul_add(t192, t131.mul_add(t191, t173));
    let t194 = t104.neg_mul_add(t192, t132.neg_mul_add(t191, t176));
    let t195 = t164 * t193;
    // Eliminates q[3]: alone z[q[3]].
    let t196 = t162.mul_add(t194, t145 * t163);
    // Back substitution: a[q[3]].
    let t197 = t196 - t195;
    let t198 = t58.mul_add(t197, t105 + t193);
    let t199 = t70.neg_mul_add(t197, t130 + t194);
    let t200 = t136 * t198;
    // Eliminates q[4]: alone z[q[4]].
    let t201 = t134.mul_add(t199, t118 * t137);
    // Back substitution: a[q[4]].
    let t202 = t201 - t200;
    let t203 = t41.mul_add(t202, t101 + t198);
    let t204 = t42.neg_mul_add(t202, t80 + t199);
    let t205 = t109 * t203;
    // Eliminates q[5]: alone z[q[5]].
    let t206 = t110.mul_add(t204, t95 * t117);
    // Back substitution: a[q[5]].
    let t207 = t206 - t205;
    let t208 = t15.mul_add(t207, t49 + t203);
    let t209 = t22.neg_mul_add(t207, t50 + t204);
    let t210 = t84 * t208;
    // Eliminates q[6]: alone z[q[6]].
    let t211 = t83.mul_add(t209, t65 * t94);
    // Back substitution: a[q[6]].
    let t212 = t211 - t210;
    let t213 = t12.mul_add(t212, t44 + t208);
    let t214 = t14.neg_mul_add(t212, t43 + t209);
    let t215 = t56 * t213;
    // Eliminates q[7]: alone z[q[7]].
    let t216 = t57.mul_add(t214, t36 * t64);
    // Back substitution: a[q[7]].
    let t217 = t216 - t215;
    let t218 = sin_q_8 * t8.neg_mul_add(t217, t35 + t214);
    // Back substitution: a[q[8]].
    let t219 = cos_q_8.mul_sub(t9.mul_add(t217, t40 + t213), t218);
    let q_1_ddot = -t191;
    let q_2_ddot = -t192;
    let q_3_ddot = t195 - t196;
    let q_4_ddot = t200 - t201;
    let q_5_ddot = t205 - t206;
    let q_6_ddot = t210 - t211;
    let q_7_ddot = t215 - t216;
    let q_8_ddot = t219 * n(p.k25);
    let sound = PIVOTS.hold(t29, n(p.k13))
        & PIVOTS.hold(t59, n(p.k12))
        & PIVOTS.hold(t87, n(p.k11))
        & PIVOTS.hold(t112, n(p.k10))
        & PIVOTS.hold(t140, n(p.k9))
        & PIVOTS.hold(t159, n(p.k8))
        & PIVOTS.hold(t183, n(p.k7))
        & q_8_ddot.is_finite();
    if !sound {
        let pivots = [
            (6, t29, n(p.k13)),
            (5, t59, n(p.k12)),
            (4, t87, n(p.k11)),
            (3, t112, n(p.k10)),
            (2, t140, n(p.k9)),
            (1, t159, n(p.k8)),
            (0, t183, n(p.k7)),
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
    let (sin_q_2, cos_q_2) = q_2.sin_cos();
    let (sin_q_1, cos_q_1) = q_1.sin_cos();
    let (sin_q_3, cos_q_3) = q_3.sin_cos();
    let (sin_q_4, cos_q_4) = q_4.sin_cos();
    let (sin_q_5, cos_q_5) = q_5.sin_cos();
    let (sin_q_6, cos_q_6) = q_6.sin_cos();
    let (sin_q_7, cos_q_7) = q_7.sin_cos();
    let (sin_q_8, cos_q_8) = q_8.sin_cos();
    let t0 = p.l * q_1_dot;
    let t1 = p.half_l * q_8_dot;
    let t2 = cos_q_2 * q_2_dot;
    let t3 = cos_q_3 * q_3_dot;
    let t4 = sin_q_2 * q_2_dot;
    let t5 = sin_q_3 * q_3_dot;
    let t6 = cos_q_4 * q_4_dot;
    let t7 = sin_q_4 * q_4_dot;
    let t8 = t2 + cos_q_1 * q_1_dot;
    let t9 = p.half_l * t2 + cos_q_1 * t0;
    let t10 = t4 + sin_q_1 * q_1_dot;
    let t11 = p.half_l * t4 + sin_q_1 * t0;
    let t12 = cos_q_5 * q_5_dot;
    let t13 = t3 + t8;
    let t14 = p.half_l * t3 + p.l * t8;
    let t15 = t5 + t10;
    let t16 = p.half_l * t5 + p.l * t10;
    let t17 = sin_q_5 * q_5_dot;
    let t18 = p.half_l * t6 + p.l * t13;
    let t19 = t6 + t13;
    let t20 = cos_q_6 * q_6_dot;
    let t21 = p.half_l * t7 + p.l * t15;
    let t22 = t7 + t15;
    let t23 = p.half_l * t12 + p.l * t19;
    let t24 = sin_q_6 * q_6_dot;
    let t25 = t12 + t19;
    let t26 = cos_q_7 * q_7_dot;
    let t27 = p.m * (t11 * t11 + t9 * t9) + q_2_dot * (q_2_dot * p.J);
    let t28 = p.half_l * t17 + p.l * t22;
    let t29 = t17 + t22;
    let t30 = p.half_l * t20 + p.l * t25;
    let t31 = sin_q_7 * q_7_dot;
    let t32 = t20 + t25;
    let t33 = p.m * (t16 * t16 + t14 * t14) + q_3_dot * (q_3_dot * p.J);
    let t34 = S::from_f64(0.5) * t27 + q_1_dot * (q_1_dot * p.k0);
    let t35 = p.half_l * t24 + p.l * t29;
    let t36 = t24 + t29;
    let t37 = p.half_l * t26 + p.l * t32;
    let t38 = p.m * (t21 * t21 + t18 * t18) + q_4_dot * (q_4_dot * p.J);
    let t39 = p.half_l * t31 + p.l * t36;
    let t40 = t1 * cos_q_8 + p.l * (t26 + t32);
    let t41 = p.m * (t28 * t28 + t23 * t23) + q_5_dot * (q_5_dot * p.J);
    let t42 = S::from_f64(0.5) * t38 + (S::from_f64(0.5) * t33 + t34);
    let t43 = t1 * sin_q_8 + p.l * (t31 + t36);
    let t44 = p.m * (t35 * t35 + t30 * t30) + q_6_dot * (q_6_dot * p.J);
    let t45 = p.m * (t39 * t39 + t37 * t37) + q_7_dot * (q_7_dot * p.J);
    let t46 = S::from_f64(0.5) * t44 + (S::from_f64(0.5) * t41 + t42);
    let t47 = p.m * (t43 * t43 + t40 * t40) + q_8_dot * (q_8_dot * p.J);
    S::from_f64(0.5) * t47 + (S::from_f64(0.5) * t45 + t46)
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
    let cos_q_3 = q_3.cos();
    let cos_q_2 = q_2.cos();
    let cos_q_1 = q_1.cos();
    let cos_q_4 = q_4.cos();
    let cos_q_5 = q_5.cos();
    let cos_q_6 = q_6.cos();
    let cos_q_7 = q_7.cos();
    let cos_q_8 = q_8.cos();
    let t0 = cos_q_2 + cos_q_1;
    let t1 = cos_q_3 + t0;
    let t2 = cos_q_4 + t1;
    let t3 = cos_q_3 * p.half_l + t0 * p.l + (cos_q_1 * p.l + cos_q_2 * p.half_l);
    let t4 = cos_q_5 + t2;
    let t5 = cos_q_6 + t4;
    let t6 = t3 + (cos_q_4 * p.half_l + p.l * t1) + (cos_q_5 * p.half_l + p.l * t2);
    let t7 = t6 + (cos_q_6 * p.half_l + p.l * t4) + (cos_q_7 * p.half_l + p.l * t5);
    let t8 = (t7 + (cos_q_8 * p.half_l + p.l * (cos_q_7 + t5))) * p.m_g;
    -(t8 - cos_q_1 * p.minus_half_l_m_g)
}

/// Height of the chain's end above the hinge. Unit: `m`.
///
/// ```text
/// end = -l*cos(q[1]) - l*cos(q[2]) - l*cos(q[3]) - l*cos(q[4]) - l*cos(q[5]) - l*cos(q[6])
///     - l*cos(q[7]) - l*cos(q[8])
/// ```
pub fn output_end<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 8]) -> S {
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
    let cos_q_8 = q_8.cos();
    let t0 = cos_q_6 + (cos_q_5 + (cos_q_4 + (cos_q_3 + (cos_q_2 + cos_q_1))));
    p.minus_l * (cos_q_8 + (cos_q_7 + t0))
}

/// Everything that the description asks to observe.
pub fn outputs<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 8]) -> Outputs<S> {
    Outputs {
        end: output_end(p, q),
    }
}

::lagrangian::emitted::implement! {
    machine Chain "Chain" over S, R;
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
    outputs Outputs { end } [
        end: "end" "m";
    ]
    prepared Prepared {
        l, m, J, g, half_l, m_g, l_m, k0, half_l_squared_m, k1, k2, k3, k4, k5, k6, k7, k8, k9, k10,
        k11, k12, k13, k14, half_m, quarter_l_m, half_l_m, k15, k16, k17, k18, k19, k20, k21,
        minus_half_l_m_g, minus_l, k22, k23, k24, half_l_squared, m_squared, k25, k26, k27,
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
        outputs outputs(p, t, q, v, a, u) = outputs(p, q);
    }
    absent [MAY_BE_CONSTRAINED MAY_SLIDE MAY_COLLIDE]
    intervals []
    lanes [N]
    numbers [yes]
}
