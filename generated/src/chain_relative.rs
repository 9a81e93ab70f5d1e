// @generated from machines/chain_relative.machine by `cargo xtask generate`; edits are lost.

//! The chain once more, each angle measured from the bar before it. Same motion, other coordinates.
//!
//! 8 coordinates, 4 parameters. Arithmetic of one call:
//!
//! | function | mul | add | div | sin cos | other | temporaries |
//! | --- | --: | --: | --: | --: | --: | --: |
//! | `prepare` | 31 | 3 | 1 | 0 | 0 | 35 |
//! | `mass_matrix` | 259 | 301 | 0 | 8 | 0 | 576 |
//! | `bias` | 110 | 81 | 0 | 8 | 0 | 207 |
//! | `applied` | 8 | 22 | 0 | 8 | 0 | 38 |
//! | `forces` | 111 | 89 | 0 | 8 | 0 | 216 |
//! | `accelerations` | 319 | 222 | 7 | 8 | 0 | 564 |
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
        let t1 = k1 * S::from_f64(0.25);
        let k10 = self.J + t1;
        let t2 = S::ONE / k10;
        let k19 = t1 * t2;
        let k27 = k1 * S::from_f64(2.0);
        let k0 = self.l * S::from_f64(0.5);
        let k2 = self.m * self.g;
        let k3 = S::from_f64(0.5) * t0;
        let k5 = S::from_f64(0.125) * (k1 + self.J * S::from_f64(4.0));
        let k6 = S::from_f64(0.5) * k4;
        let k7 = self.m * S::from_f64(0.5);
        let k8 = k4 * S::from_f64(0.25);
        let k9 = self.J * S::from_f64(2.0);
        let k11 = t0 * S::from_f64(1.5);
        let k12 = t0 * S::from_f64(2.5);
        let k13 = t0 * S::from_f64(3.5);
        let k14 = t0 * S::from_f64(4.5);
        let k15 = t0 * S::from_f64(5.5);
        let k16 = t0 * S::from_f64(6.5);
        let k17 = t0 * S::from_f64(7.5);
        let k18 = S::from_f64(0.5) * k1;
        let k20 = k1 * k19;
        let k21 = self.J + k1 * S::from_f64(1.25);
        let k22 = self.g * S::from_f64(0.5);
        let k23 = S::from_f64(0.25) * t2;
        let k24 = self.l * k1;
        let k25 = k1 * k27;
        let k26 = self.l * S::from_f64(0.25);
        let k28 = k4 * t2;
        let singular = if vanishes(k10, k10, 7.105427357601002e-15) {
            Some(singular(7, k10, k10))
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
    /// `0.5*l*m`
    k6: S,
    /// `0.5*m`
    k7: S,
    /// `0.25*l*m`
    k8: S,
    /// `2*J`
    k9: S,
    /// `J + 0.25*l^2*m`
    k10: S,
    /// `1.5*l*m*g`
    k11: S,
    /// `2.5*l*m*g`
    k12: S,
    /// `3.5*l*m*g`
    k13: S,
    /// `4.5*l*m*g`
    k14: S,
    /// `5.5*l*m*g`
    k15: S,
    /// `6.5*l*m*g`
    k16: S,
    /// `7.5*l*m*g`
    k17: S,
    /// `0.5*l^2*m`
    k18: S,
    /// `0.25*l^2*m/(J + 0.25*l^2*m)`
    k19: S,
    /// `0.25*l^4*m^2/(J + 0.25*l^2*m)`
    k20: S,
    /// `J + 1.25*l^2*m`
    k21: S,
    /// `0.5*g`
    k22: S,
    /// `0.25/(J + 0.25*l^2*m)`
    k23: S,
    /// `l^3*m`
    k24: S,
    /// `2*l^4*m^2`
    k25: S,
    /// `0.25*l`
    k26: S,
    /// `2*l^2*m`
    k27: S,
    /// `l*m/(J + 0.25*l^2*m)`
    k28: S,
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
    let (sin_t1, cos_t1) = t1.sin_cos();
    let (sin_t0, cos_t0) = t0.sin_cos();
    let (sin_q_1, cos_q_1) = q_1.sin_cos();
    let t2 = cos_t0 + cos_q_1;
    let t3 = cos_t1 + t2;
    let t4 = t1 + q_4;
    let (sin_t4, cos_t4) = t4.sin_cos();
    let t5 = cos_t4 + t3;
    let t6 = t4 + q_5;
    let (sin_t6, cos_t6) = t6.sin_cos();
    let t7 = cos_t6 + t5;
    let t8 = t6 + q_6;
    let (sin_t8, cos_t8) = t8.sin_cos();
    let t9 = cos_t8 + t7;
    let t10 = t8 + q_7;
    let (sin_t10, cos_t10) = t10.sin_cos();
    let t11 = t10 + q_8;
    let (sin_t11, cos_t11) = t11.sin_cos();
    let t12 = p.k0 * cos_t11;
    let t13 = t12 + p.l * (cos_t10 + t9);
    let t14 = p.k0 * cos_t10;
    let t15 = t14 + p.l * t9;
    let t16 = p.l * cos_t10;
    let t17 = sin_t0 + sin_q_1;
    let t18 = sin_t1 + t17;
    let t19 = sin_t4 + t18;
    let t20 = sin_t6 + t19;
    let t21 = sin_t8 + t20;
    let t22 = p.k0 * sin_t11;
    let t23 = t22 + p.l * (sin_t10 + t21);
    let t24 = p.k0 * sin_t10;
    let t25 = t24 + p.l * t21;
    let t26 = p.l * sin_t10;
    let m81 = p.k6 * (cos_t11 * t13 + sin_t11 * t23) + p.J;
    let t27 = m81 + (t16 * (t13 * p.m + p.k7 * t15) + t26 * (t23 * p.m + p.k7 * t25));
    let m71 = p.J + t27;
    let t28 = t13 + t15;
    let t29 = p.k0 * cos_t8;
    let t30 = t29 + p.l * t7;
    let t31 = p.l * cos_t8;
    let t32 = t23 + t25;
    let t33 = p.k0 * sin_t8;
    let t34 = t33 + p.l * t20;
    let t35 = p.l * sin_t8;
    let t36 = m71 + (t31 * (p.m * t28 + p.k7 * t30) + t35 * (p.m * t32 + p.k7 * t34));
    let m61 = p.J + t36;
    let t37 = t28 + t30;
    let t38 = p.k0 * cos_t6;
    let t39 = t38 + p.l * t5;
    let t40 = p.l * cos_t6;
    let t41 = t32 + t34;
    let t42 = p.k0 * sin_t6;
    let t43 = t42 + p.l * t19;
    let t44 = p.l * sin_t6;
    let t45 = m61 + (t40 * (p.m * t37 + p.k7 * t39) + t44 * (p.m * t41 + p.k7 * t43));
    let m51 = p.J + t45;
    let t46 = t37 + t39;
    let t47 = p.k0 * cos_t4;
    let t48 = t47 + p.l * t3;
    let t49 = p.l * cos_t4;
    let t50 = t41 + t43;
    let t51 = p.k0 * sin_t4;
    let t52 = t51 + p.l * t18;
    let t53 = p.l * sin_t4;
    let t54 = m51 + (t49 * (p.m * t46 + p.k7 * t48) + t53 * (p.m * t50 + p.k7 * t52));
    let m41 = p.J + t54;
    let t55 = t46 + t48;
    let t56 = p.k0 * cos_t1;
    let t57 = t56 + p.l * t2;
    let t58 = p.l * cos_t1;
    let t59 = t50 + t52;
    let t60 = p.k0 * sin_t1;
    let t61 = t60 + p.l * t17;
    let t62 = p.l * sin_t1;
    let t63 = m41 + (t58 * (p.m * t55 + p.k7 * t57) + t62 * (p.m * t59 + p.k7 * t61));
    let m31 = p.J + t63;
    let t64 = p.m * (t55 + t57);
    let t65 = p.l * cos_q_1;
    let t66 = p.k0 * cos_t0 + t65;
    let t67 = p.l * cos_t0;
    let t68 = p.m * (t59 + t61);
    let t69 = p.l * sin_q_1;
    let t70 = p.k0 * sin_t0 + t69;
    let t71 = p.l * sin_t0;
    let t72 = m31 + (t67 * (t64 + p.k7 * t66) + t71 * (t68 + p.k7 * t70));
    let t73 = t69 * (p.m * t70 + (t68 + sin_q_1 * p.k8));
    let t74 = cos_t1 + cos_t0;
    let t75 = cos_t4 + t74;
    let t76 = cos_t6 + t75;
    let t77 = cos_t8 + t76;
    let t78 = t12 + p.l * (cos_t10 + t77);
    let t79 = t14 + p.l * t77;
    let t80 = sin_t1 + sin_t0;
    let t81 = sin_t4 + t80;
    let t82 = sin_t6 + t81;
    let t83 = sin_t8 + t82;
    let t84 = t22 + p.l * (sin_t10 + t83);
    let t85 = t24 + p.l * t83;
    let m82 = p.J + p.k6 * (cos_t11 * t78 + sin_t11 * t84);
    let t86 = m82 + (t16 * (p.m * t78 + p.k7 * t79) + t26 * (p.m * t84 + p.k7 * t85));
    let m72 = p.J + t86;
    let t87 = t78 + t79;
    let t88 = t29 + p.l * t76;
    let t89 = t84 + t85;
    let t90 = t33 + p.l * t82;
    let t91 = m72 + (t31 * (p.m * t87 + p.k7 * t88) + t35 * (p.m * t89 + p.k7 * t90));
    let m62 = p.J + t91;
    let t92 = t87 + t88;
    let t93 = t38 + p.l * t75;
    let t94 = t89 + t90;
    let t95 = t42 + p.l * t81;
    let t96 = m62 + (t40 * (p.m * t92 + p.k7 * t93) + t44 * (p.m * t94 + p.k7 * t95));
    let m52 = p.J + t96;
    let t97 = t92 + t93;
    let t98 = t47 + p.l * t74;
    let t99 = t94 + t95;
    let t100 = t51 + p.l * t80;
    let t101 = m52 + (t49 * (p.m * t97 + p.k7 * t98) + t53 * (p.m * t99 + p.k7 * t100));
    let m42 = p.J + t101;
    let t102 = t97 + t98;
    let t103 = t56 + t67;
    let t104 = t99 + t100;
    let t105 = t60 + t71;
    let t106 = t58 * (p.m * t102 + p.k7 * t103) + t62 * (p.m * t104 + p.k7 * t105);
    let m32 = p.J + (m42 + t106);
    let t107 = t71 * (p.m * (t104 + t105) + sin_t0 * p.k8);
    let t108 = cos_t4 + cos_t1;
    let t109 = cos_t6 + t108;
    let t110 = cos_t8 + t109;
    let t111 = t12 + p.l * (cos_t10 + t110);
    let t112 = t14 + p.l * t110;
    let t113 = sin_t4 + sin_t1;
    let t114 = sin_t6 + t113;
    let t115 = sin_t8 + t114;
    let t116 = t22 + p.l * (sin_t10 + t115);
    let t117 = t24 + p.l * t115;
    let m83 = p.J + p.k6 * (cos_t11 * t111 + sin_t11 * t116);
    let t118 = t16 * (p.m * t111 + p.k7 * t112) + t26 * (p.m * t116 + p.k7 * t117);
    let m73 = p.J + (m83 + t118);
    let t119 = t111 + t112;
    let t120 = t29 + p.l * t109;
    let t121 = t116 + t117;
    let t122 = t33 + p.l * t114;
    let t123 = t31 * (p.m * t119 + p.k7 * t120) + t35 * (p.m * t121 + p.k7 * t122);
    let m63 = p.J + (m73 + t123);
    let t124 = t119 + t120;
    let t125 = t38 + p.l * t108;
    let t126 = t121 + t122;
    let t127 = t42 + p.l * t113;
    let t128 = t40 * (p.m * t124 + p.k7 * t125) + t44 * (p.m * t126 + p.k7 * t127);
    let m53 = p.J + (m63 + t128);
    let t129 = t124 + t125;
    let t130 = t47 + t58;
    let t131 = t126 + t127;
    let t132 = t51 + t62;
    let t133 = t49 * (p.m * t129 + p.k7 * t130) + t53 * (p.m * t131 + p.k7 * t132);
    let m43 = p.J + (m53 + t133);
    let t134 = t62 * (p.m * (t131 + t132) + sin_t1 * p.k8);
    let t135 = cos_t6 + cos_t4;
    let t136 = cos_t8 + t135;
    let t137 = t12 + p.l * (cos_t10 + t136);
    let t138 = t14 + p.l * t136;
    let t139 = sin_t6 + sin_t4;
    let t140 = sin_t8 + t139;
    let t141 = t22 + p.l * (sin_t10 + t140);
    let t142 = t24 + p.l * t140;
    let m84 = p.J + p.k6 * (cos_t11 * t137 + sin_t11 * t141);
    let t143 = t16 * (p.m * t137 + p.k7 * t138) + t26 * (p.m * t141 + p.k7 * t142);
    let m74 = p.J + (m84 + t143);
    let t144 = t137 + t138;
    let t145 = t29 + p.l * t135;
    let t146 = t141 + t142;
    let t147 = t33 + p.l * t139;
    let t148 = t31 * (p.m * t144 + p.k7 * t145) + t35 * (p.m * t146 + p.k7 * t147);
    let m64 = p.J + (m74 + t148);
    let t149 = t144 + t145;
    let t150 = t38 + t49;
    let t151 = t146 + t147;
    let t152 = t42 + t53;
    let t153 = t40 * (p.m * t149 + p.k7 * t150) + t44 * (p.m * t151 + p.k7 * t152);
    let m54 = p.J + (m64 + t153);
    let t154 = t53 * (p.m * (t151 + t152) + sin_t4 * p.k8);
    let t155 = cos_t8 + cos_t6;
    let t156 = t12 + p.l * (cos_t10 + t155);
    let t157 = t14 + p.l * t155;
    let t158 = sin_t8 + sin_t6;
    let t159 = t22 + p.l * (sin_t10 + t158);
    let t160 = t24 + p.l * t158;
    let m85 = p.J + p.k6 * (cos_t11 * t156 + sin_t11 * t159);
    let t161 = t16 * (p.m * t156 + p.k7 * t157) + t26 * (p.m * t159 + p.k7 * t160);
    let m75 = p.J + (m85 + t161);
    let t162 = t156 + t157;
    let t163 = t29 + t40;
    let t164 = t159 + t160;
    let t165 = t33 + t44;
    let t166 = t31 * (p.m * t162 + p.k7 * t163) + t35 * (p.m * t164 + p.k7 * t165);
    let m65 = p.J + (m75 + t166);
    let t167 = t44 * (p.m * (t164 + t165) + sin_t6 * p.k8);
    let t168 = t12 + p.l * (cos_t10 + cos_t8);
    let t169 = t14 + t31;
    let t170 = t22 + p.l * (sin_t10 + sin_t8);
    let t171 = t24 + t35;
    let m86 = p.J + p.k6 * (cos_t11 * t168 + sin_t11 * t170);
    let t172 = t16 * (p.m * t168 + p.k7 * t169) + t26 * (p.m * t170 + p.k7 * t171);
    let m76 = p.J + (m86 + t172);
    let t173 = t35 * (p.m * (t170 + t171) + sin_t8 * p.k8);
    let t174 = t12 + t16;
    let t175 = t22 + t26;
    let m87 = p.J + p.k6 * (cos_t11 * t174 + sin_t11 * t175);
    let t176 = t26 * (p.m * t175 + sin_t10 * p.k8);
    let m11 = t72 + p.k9 + (t65 * (p.m * t66 + (t64 + cos_q_1 * p.k8)) + t73);
    let m21 = p.J + t72;
    let m22 = p.J + (m32 + (t67 * (p.m * (t102 + t103) + cos_t0 * p.k8) + t107));
    let m33 = p.J + (m43 + (t58 * (p.m * (t129 + t130) + cos_t1 * p.k8) + t134));
    let m44 = p.J + (m54 + (t49 * (p.m * (t149 + t150) + cos_t4 * p.k8) + t154));
    let m55 = p.J + (m65 + (t40 * (p.m * (t162 + t163) + cos_t6 * p.k8) + t167));
    let m66 = p.J + (m76 + (t31 * (p.m * (t168 + t169) + cos_t8 * p.k8) + t173));
    let m77 = p.J + (m87 + (t16 * (p.m * t174 + cos_t10 * p.k8) + t176));
    [
        [m11, m21, m31, m41, m51, m61, m71, m81],
        [m21, m22, m32, m42, m52, m62, m72, m82],
        [m31, m32, m33, m43, m53, m63, m73, m83],
        [m41, m42, m43, m44, m54, m64, m74, m84],
        [m51, m52, m53, m54, m55, m65, m75, m85],
        [m61, m62, m63, m64, m65, m66, m76, m86],
        [m71, m72, m73, m74, m75, m76, m77, m87],
        [m81, m82, m83, m84, m85, m86, m87, p.k10],
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
    let t36 = t2 * sin_t4;
    let t37 = t6 * sin_t3;
    let t38 = sin_q_1 * t8;
    let t39 = t37 + t38;
    let t40 = t36 + t39;
    let t41 = t13 * sin_t14;
    let t42 = t41 + t40;
    let t43 = t18 * sin_t19;
    let t44 = t43 + t42;
    let t45 = t23 * sin_t24;
    let t46 = t45 + t44;
    let t47 = t28 * sin_t29;
    let t48 = t32 * sin_t33 + p.l * (t47 + t46);
    let h_q_8 = (sin_t33 * t34 - cos_t33 * t48) * p.k6;
    let t49 = p.k0 * t47 + p.l * t46;
    let t50 = (p.m * t34 + t35 * p.k7) * (p.l * sin_t29) + h_q_8;
    let h_q_7 = t50 - (p.m * t48 + t49 * p.k7) * (p.l * cos_t29);
    let t51 = t34 + t35;
    let t52 = p.k0 * t25 + p.l * t21;
    let t53 = t48 + t49;
    let t54 = p.k0 * t45 + p.l * t44;
    let t55 = (p.m * t51 + t52 * p.k7) * (p.l * sin_t24) + h_q_7;
    let h_q_6 = t55 - (p.m * t53 + t54 * p.k7) * (p.l * cos_t24);
    let t56 = t51 + t52;
    let t57 = p.k0 * t20 + p.l * t16;
    let t58 = t53 + t54;
    let t59 = p.k0 * t43 + p.l * t42;
    let t60 = (p.m * t56 + t57 * p.k7) * (p.l * sin_t19) + h_q_6;
    let h_q_5 = t60 - (p.m * t58 + t59 * p.k7) * (p.l * cos_t19);
    let t61 = t56 + t57;
    let t62 = p.k0 * t15 + p.l * t11;
    let t63 = t58 + t59;
    let t64 = p.k0 * t41 + p.l * t40;
    let t65 = (p.m * t61 + t62 * p.k7) * (p.l * sin_t14) + h_q_5;
    let h_q_4 = t65 - (p.m * t63 + t64 * p.k7) * (p.l * cos_t14);
    let t66 = t61 + t62;
    let t67 = p.k0 * t5 + p.l * t10;
    let t68 = t63 + t64;
    let t69 = p.k0 * t36 + p.l * t39;
    let t70 = (p.m * t66 + t67 * p.k7) * (p.l * sin_t4) + h_q_4;
    let h_q_3 = t70 - (p.m * t68 + t69 * p.k7) * (p.l * cos_t4);
    let t71 = p.m * (t66 + t67);
    let t72 = p.k0 * t7 + p.l * t9;
    let t73 = p.m * (t68 + t69);
    let t74 = p.k0 * t37 + p.l * t38;
    let t75 = (t71 + t72 * p.k7) * (p.l * sin_t3) + h_q_3;
    let h_q_2 = t75 - (t73 + t74 * p.k7) * (p.l * cos_t3);
    let t76 = (p.m * t72 + (t71 + p.k8 * t9)) * (sin_q_1 * p.l) + h_q_2;
    let h_q_1 = t76 - (p.m * t74 + (t73 + t38 * p.k8)) * (cos_q_1 * p.l);
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
    let t7 = p.k3 * sin_t6;
    let sin_t5 = t5.sin();
    let t8 = t7 + p.k11 * sin_t5;
    let sin_t4 = t4.sin();
    let t9 = p.k12 * sin_t4 + t8;
    let sin_t3 = t3.sin();
    let t10 = p.k13 * sin_t3 + t9;
    let sin_t2 = t2.sin();
    let t11 = p.k14 * sin_t2 + t10;
    let sin_t1 = t1.sin();
    let t12 = p.k15 * sin_t1 + t11;
    let sin_t0 = t0.sin();
    let t13 = p.k16 * sin_t0 + t12;
    let sin_q_1 = q_1.sin();
    let q_q_1 = -(p.k17 * sin_q_1 + t13);
    let q_q_2 = -t13;
    let q_q_3 = -t12;
    let q_q_4 = -t11;
    let q_q_5 = -t10;
    let q_q_6 = -t9;
    let q_q_7 = -t8;
    let q_q_8 = -t7;
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
    let t35 = t2 * cos_t4;
    let t36 = t6 * cos_t3;
    let t37 = cos_q_1 * t8;
    let t38 = t36 + t37;
    let t39 = t35 + t38;
    let t40 = t13 * cos_t14;
    let t41 = t40 + t39;
    let t42 = t18 * cos_t19;
    let t43 = t42 + t41;
    let t44 = t23 * cos_t24;
    let t45 = t44 + t43;
    let t46 = t28 * cos_t29;
    let t47 = p.g + (t32 * cos_t33 + p.l * (t46 + t45));
    let f_q_8 = (cos_t33 * t34 - sin_t33 * t47) * p.k6;
    let t48 = p.k0 * t30 + p.l * t26;
    let t49 = p.g + (p.k0 * t46 + p.l * t45);
    let t50 = f_q_8 + (p.m * t34 + p.k7 * t48) * (p.l * cos_t29);
    let f_q_7 = t50 - (p.m * t47 + t49 * p.k7) * (p.l * sin_t29);
    let t51 = t34 + t48;
    let t52 = p.k0 * t25 + p.l * t21;
    let t53 = t47 + t49;
    let t54 = p.g + (p.k0 * t44 + p.l * t43);
    let t55 = f_q_7 + (p.m * t51 + p.k7 * t52) * (p.l * cos_t24);
    let f_q_6 = t55 - (p.m * t53 + t54 * p.k7) * (p.l * sin_t24);
    let t56 = t51 + t52;
    let t57 = p.k0 * t20 + p.l * t16;
    let t58 = t53 + t54;
    let t59 = p.g + (p.k0 * t42 + p.l * t41);
    let t60 = f_q_6 + (p.m * t56 + p.k7 * t57) * (p.l * cos_t19);
    let f_q_5 = t60 - (p.m * t58 + t59 * p.k7) * (p.l * sin_t19);
    let t61 = t56 + t57;
    let t62 = p.k0 * t15 + p.l * t11;
    let t63 = t58 + t59;
    let t64 = p.g + (p.k0 * t40 + p.l * t39);
    let t65 = f_q_5 + (p.m * t61 + p.k7 * t62) * (p.l * cos_t14);
    let f_q_4 = t65 - (p.m * t63 + t64 * p.k7) * (p.l * sin_t14);
    let t66 = t61 + t62;
    let t67 = p.k0 * t5 + p.l * t10;
    let t68 = t63 + t64;
    let t69 = p.g + (p.k0 * t35 + p.l * t38);
    let t70 = f_q_4 + (p.m * t66 + p.k7 * t67) * (p.l * cos_t4);
    let f_q_3 = t70 - (p.m * t68 + t69 * p.k7) * (p.l * sin_t4);
    let t71 = p.m * (t66 + t67);
    let t72 = p.k0 * t7 + p.l * t9;
    let t73 = p.m * (t68 + t69);
    let t74 = p.g + (p.k0 * t36 + p.l * t37);
    let t75 = f_q_3 + (t71 + p.k7 * t72) * (p.l * cos_t3);
    let f_q_2 = t75 - (t73 + t74 * p.k7) * (p.l * sin_t3);
    let t76 = (p.m * t74 + (t73 + p.k7 * (p.g + p.k0 * t37))) * (sin_q_1 * p.l);
    let f_q_1 = f_q_2 + (p.m * t72 + (t71 + t9 * p.k8)) * (cos_q_1 * p.l) - t76;
    [f_q_1, f_q_2, f_q_3, f_q_4, f_q_5, f_q_6, f_q_7, f_q_8]
}

/// Accelerations `a`, the solution of `M a = f`.
///
/// `M = L D Lᵀ` is eliminated without what is known to be zero; a pivot of `D` that vanishes is an
/// error.
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
        let t8 = t7.neg_mul_add(t7 * n(p.k20), n(p.k21));
        let t8 = checked(t8, t8, 7.105427357601002e-15, 6)?;
        let t9 = N::ONE / t8;
        let t10 = t9 * n(p.k1);
        let t11 = sin_t6 * n(p.k19);
        let t12 = t7 * t11;
        let t13 = sin_t5.mul_sub(N::from_f64(1.5), t12);
        let t14 = t13 * t10;
        let t15 = sin_t6.neg_mul_add(t11, N::from_f64(2.0));
        let t16 = t13.neg_mul_add(t14, t15);
        let t17 = q_2_dot + q_1_dot;
        let t18 = t17 + q_3_dot;
        let t19 = t18 + q_4_dot;
        let t20 = t19 + q_5_dot;
        let t21 = t20 + q_6_dot;
        let t22 = t21 * t21;
        let t23 = cos_t4 * t22;
        let t24 = n(p.l) * t23;
        let t25 = t21 + q_7_dot;
        let t26 = t25 * t25;
        let t27 = n(p.l) * t26;
        let t28 = t25 + q_8_dot;
        let t29 = t28 * (n(p.k0) * t28);
        let t30 = n(p.g) + cos_t6.mul_add(t29, cos_t5 * t27);
        let t31 = sin_t6.mul_add(t29, sin_t5 * t27);
        let t32 = sin_t6.mul_sub(t30, cos_t6 * t31);
        let t33 = n(p.k0) * t26;
        let t34 = t30 + cos_t5.mul_add(t33, n(p.g));
        let t35 = cos_t6 * n(p.k19);
        let t36 = t7 * t35;
        let t37 = sin_t5.mul_add(t30, sin_t5 * n(p.k22));
        let t38 = t12.neg_mul_add(t30, t37 + t36.mul_sub(t31, cos_t5 * t31));
        let t39 = t14.neg_mul_add(t38, t34 + t16.mul_sub(t24, t11 * t32));
        let t40 = n(p.k0).mul_add(t23, n(p.g));
        let t41 = sin_t4 * t16;
        let t42 = sin_t4 * N::from_f64(0.5);
        let t43 = cos_t5.mul_sub(N::from_f64(1.5), t36);
        let t44 = t9 * t43;
        let t45 = t44.mul_add(t13, cos_t6 * (sin_t6 * n(p.k23)));
        let t46 = cos_t4 * n(p.k1);
        let t47 = t45.neg_mul_add(t46, t41 + t42);
        let t48 = t43 * t10;
        let t49 = cos_t6.neg_mul_add(t35, N::from_f64(2.0));
        let t50 = t43.neg_mul_add(t48, t49);
        let t51 = cos_t4 * t50;
        let t52 = sin_t4 * n(p.k1);
        let t53 = t51.mul_sub(t46, n(p.k25) * sin_t4 * (t45 * cos_t4));
        let t54 = t41.mul_add(t52, n(p.k10)) + t53;
        let t54 = checked(t54, t54, 7.105427357601002e-15, 5)?;
        let t55 = N::ONE / t54;
        let t56 = n(p.k1) * t55;
        let t57 = t47 * t56;
        let t58 = t47.neg_mul_add(t57, N::ONE + t16);
        let t59 = t20 * t20;
        let t60 = cos_t3 * t59;
        let t61 = n(p.l) * t60;
        let t62 = t45 * n(p.k24);
        let t63 = sin_t4 * t22;
        let t64 = t63 * t62;
        let t65 = n(p.l) * t63;
        let t66 = sin_t5.mul_add(t33, t31) + t48.mul_add(t38, t35 * t32);
        let t67 = t50.mul_add(t65, t23 * t62) + t66;
        let t68 = cos_t4.neg_mul_add(t67, t42 * t40);
        let t69 = sin_t4.mul_add(t39, sin_t4 * t64) + t68;
        let t70 = t63.neg_mul_add(cos_t4 * n(p.k26), t69);
        let t71 = t57.neg_mul_add(t70, t40 + t39 + t58.mul_add(t61, t64));
        let t72 = n(p.k0).mul_add(t60, n(p.g));
        let t73 = sin_t3 * t58;
        let t74 = N::from_f64(0.5) * sin_t3;
        let t75 = cos_t4.mul_add(N::from_f64(0.5), t51);
        let t76 = t45.neg_mul_add(t52, t75);
        let t77 = t55 * t76;
        let t78 = t77.mul_add(t47, t45);
        let t79 = n(p.k1) * cos_t3;
        let t80 = t78.neg_mul_add(t79, t73 + t74);
        let t81 = t76 * t56;
        let t82 = t76.neg_mul_add(t81, N::ONE + t50);
        let t83 = cos_t3 * t82;
        let t84 = n(p.k1) * sin_t3;
        let t85 = t83.mul_sub(t79, n(p.k25) * sin_t3 * (t78 * cos_t3));
        let t86 = t73.mul_add(t84, n(p.k10)) + t85;
        let t86 = checked(t86, t86, 7.105427357601002e-15, 4)?;
        let t87 = N::ONE / t86;
        let t88 = n(p.k1) * t87;
        let t89 = t80 * t88;
        let t90 = t80.neg_mul_add(t89, N::ONE + t58);
        let t91 = t19 * t19;
        let t92 = cos_t2 * t91;
        let t93 = n(p.l) * t92;
        let t94 = t78 * n(p.k24);
        let t95 = sin_t3 * t59;
        let t96 = t95 * t94;
        let t97 = n(p.l) * t95;
        let t98 = n(p.k0).mul_add(t63, t67) + t60.mul_add(t94, t81 * t70);
        let t99 = t82.mul_add(t97, t98);
        let t100 = cos_t3.neg_mul_add(t99, t74 * t72);
        let t101 = sin_t3.mul_add(t71, sin_t3 * t96) + t100;
        let t102 = t95.neg_mul_add(cos_t3 * n(p.k26), t101);
        let t103 = t89.neg_mul_add(t102, t72 + t71 + t90.mul_add(t93, t96));
        let t104 = n(p.k0).mul_add(t92, n(p.g));
        let t105 = sin_t2 * t90;
        let t106 = N::from_f64(0.5) * sin_t2;
        let t107 = N::from_f64(0.5).mul_add(cos_t3, t83);
        let t108 = t78.neg_mul_add(t84, t107);
        let t109 = t87 * t108;
        let t110 = t109.mul_add(t80, t78);
        let t111 = n(p.k1) * cos_t2;
        let t112 = t110.neg_mul_add(t111, t105 + t106);
        let t113 = t108 * t88;
        let t114 = t108.neg_mul_add(t113, N::ONE + t82);
        let t115 = cos_t2 * t114;
        let t116 = n(p.k1) * sin_t2;
        let t117 = t115.mul_sub(t111, n(p.k25) * sin_t2 * (t110 * cos_t2));
        let t118 = t105.mul_add(t116, n(p.k10)) + t117;
        let t118 = checked(t118, t118, 7.105427357601002e-15, 3)?;
        let t119 = N::ONE / t118;
        let t120 = n(p.k1) * t119;
        let t121 = t112 * t120;
        let t122 = t112.neg_mul_add(t121, N::ONE + t90);
        let t123 = t18 * t18;
        let t124 = cos_t1 * t123;
        let t125 = n(p.l) * t124;
        let t126 = t110 * n(p.k24);
        let t127 = sin_t2 * t91;
        let t128 = t127 * t126;
        let t129 = n(p.l) * t127;
        let t130 = n(p.k0).mul_add(t95, t99) + t92.mul_add(t126, t113 * t102);
        let t131 = t114.mul_add(t129, t130);
        let t132 = cos_t2.neg_mul_add(t131, t106 * t104);
        let t133 = sin_t2.mul_add(t103, sin_t2 * t128) + t132;
        let t134 = t127.neg_mul_add(cos_t2 * n(p.k26), t133);
        let t135 = t104 + t103 + t122.mul_add(t125, t128);
        let t136 = t121.neg_mul_add(t134, t135);
        let t137 = n(p.k0).mul_add(t124, n(p.g));
        let t138 = sin_t1 * t122;
        let t139 = N::from_f64(0.5) * sin_t1;
        let t140 = N::from_f64(0.5).mul_add(cos_t2, t115);
        let t141 = t110.neg_mul_add(t116, t140);
        let t142 = t119 * t141;
        let t143 = t142.mul_add(t112, t110);
        let t144 = n(p.k1) * cos_t1;
        let t145 = t143.neg_mul_add(t144, t138 + t139);
        let t146 = t141 * t120;
        let t147 = t141.neg_mul_add(t146, N::ONE + t114);
        let t148 = cos_t1 * t147;
        let t149 = n(p.k1) * sin_t1;
        let t150 = t148.mul_sub(t144, n(p.k25) * sin_t1 * (t143 * cos_t1));
        let t151 = t138.mul_add(t149, n(p.k10)) + t150;
        let t151 = checked(t151, t151, 7.105427357601002e-15, 2)?;
        let t152 = N::ONE / t151;
        let t153 = n(p.k1) * t152;
        let t154 = t145 * t153;
        let t155 = t145.neg_mul_add(t154, N::ONE + t122);
        let t156 = t17 * t17;
        let t157 = cos_t0 * t156;
        let t158 = q_1_dot * q_1_dot;
        let t159 = cos_q_1 * t158;
        let t160 = t157 + t159;
        let t161 = n(p.l) * t160;
        let t162 = t143 * n(p.k24);
        let t163 = sin_t1 * t123;
        let t164 = t163 * t162;
        let t165 = t124.mul_add(t162, t146 * t134);
        let t166 = n(p.l) * t163;
        let t167 = t147.mul_add(t166, n(p.k0).mul_add(t127, t131) + t165);
        let t168 = cos_t1.neg_mul_add(t167, t139 * t137);
        let t169 = sin_t1.mul_add(t136, sin_t1 * t164) + t168;
        let t170 = t163.neg_mul_add(cos_t1 * n(p.k26), t169);
        let t171 = t137 + t136 + t155.mul_add(t161, t164);
        let t172 = t154.neg_mul_add(t170, t171);
        let t173 = N::from_f64(0.5).mul_add(cos_t1, t148);
        let t174 = t143.neg_mul_add(t149, t173);
        let t175 = t152 * t174;
        let t176 = t175.mul_add(t145, t143);
        let t177 = t176 * sin_t0;
        let t178 = sin_t0 * t156;
        let t179 = sin_q_1 * t158;
        let t180 = t178 + t179;
        let t181 = n(p.k24) * t180;
        let t182 = t174 * t153;
        let t183 = t160.mul_add(t176 * n(p.k24), t182 * t170);
        let t184 = t174.neg_mul_add(t182, N::ONE + t147);
        let t185 = n(p.l) * t180;
        let t186 = t184.mul_add(t185, n(p.k0).mul_add(t163, t167) + t183);
        let t187 = n(p.g) + n(p.k0).mul_add(t157, n(p.l) * t159);
        let t188 = t187 * (N::from_f64(0.5) * sin_t0);
        let t189 = sin_t0.mul_add(t172, t177 * t181);
        let t190 = t178.mul_add(n(p.k0), t179 * n(p.l));
        let t191 = t189 + cos_t0.neg_mul_add(t186, t188);
        let t192 = t190.neg_mul_add(N::from_f64(0.5) * cos_t0, t191);
        let t193 = t176 * sin_q_1;
        let t194 = t193.mul_add(t181, sin_q_1 * t187);
        let t195 = cos_t0 * cos_q_1;
        let t196 = sin_t0 * sin_q_1;
        let t197 = N::from_f64(0.5).mul_add(t195, N::from_f64(0.5) * t196);
        let t198 = n(p.k1) * sin_q_1;
        let t199 = n(p.k1) * cos_q_1;
        let t200 = t198.mul_add(t176 * cos_t0, t177 * t199);
        let t201 = t184.mul_add(t195, t155 * t196) + t197 - t200;
        let t202 = n(p.k1) * cos_t0;
        let t203 = n(p.k1) * sin_t0;
        let t204 = t202.mul_sub(cos_t0 * t184, t177 * (n(p.k25) * cos_t0));
        let t205 = t203.mul_add(sin_t0 * t155, n(p.k10)) + t204;
        let t205 = checked(t205, t205, 7.105427357601002e-15, 1)?;
        let t206 = n(p.k1).mul_add(t201, t205);
        let t207 = N::ONE / t205;
        let t208 = t207 * t206;
        let t209 = n(p.k0).mul_add(t159, n(p.g));
        let t210 = t209 * (N::from_f64(0.5) * sin_q_1);
        let t211 = t208.mul_add(t192, cos_q_1 * t190);
        let t212 = cos_q_1.neg_mul_add(t186, t210) - t211;
        let t213 = sin_q_1.mul_add(t172, t192) + t194 + t212;
        let t214 = t206.neg_mul_add(t208, t201 * n(p.k27));
        let t215 = t199.mul_add(t184 * cos_q_1, t198 * (t155 * sin_q_1));
        let t216 = t193.neg_mul_add(n(p.k25) * cos_q_1, t214);
        let t217 = n(p.k21) + t205 + t215 + t216;
        let t217 = checked(t217, t217, 7.105427357601002e-15, 0)?;
        let t218 = N::ONE / t217 * t159.neg_mul_add(sin_q_1 * n(p.k26), t213);
        let t219 = t207 * t206.neg_mul_add(t218, t192);
        let t220 = t218 + t219;
        let t221 = t202.mul_add(t220, t199.mul_add(t218, t185));
        let t222 = t203.neg_mul_add(t220, t198.neg_mul_add(t218, t161));
        let t223 = t222.mul_add(t152 * t145, t152 * t170);
        let t224 = t175.mul_add(t221, t220) - t223;
        let t225 = t220 - t224;
        let t226 = t144.mul_add(t225, t166 + t221);
        let t227 = t149.neg_mul_add(t225, t125 + t222);
        let t228 = t227.mul_add(t119 * t112, t119 * t134);
        let t229 = t142.mul_add(t226, t225) - t228;
        let t230 = t225 - t229;
        let t231 = t111.mul_add(t230, t129 + t226);
        let t232 = t116.neg_mul_add(t230, t93 + t227);
        let t233 = t232.mul_add(t87 * t80, t87 * t102);
        let t234 = t109.mul_add(t231, t230) - t233;
        let t235 = t230 - t234;
        let t236 = t79.mul_add(t235, t97 + t231);
        let t237 = t84.neg_mul_add(t235, t61 + t232);
        let t238 = t237.mul_add(t55 * t47, t55 * t70);
        let t239 = t77.mul_add(t236, t235) - t238;
        let t240 = t235 - t239;
        let t241 = t46.mul_add(t240, t65 + t236);
        let t242 = t52.neg_mul_add(t240, t24 + t237);
        let t243 = t44.mul_add(t241, t240) - t242.mul_add(t9 * t13, t9 * t38);
        let t244 = t241 * (cos_t6 * N::from_f64(0.5));
        let t245 = t7.mul_add(n(p.k18), n(p.k10));
        let t246 = sin_t6 * N::from_f64(0.5);
        let t247 = t242.mul_add(t246, N::from_f64(0.5) * t32);
        let q_1_ddot = -(t218 * n(p.k4));
        let q_2_ddot = -(n(p.k4) * t219);
        let q_3_ddot = n(p.k4) * t224;
        let q_4_ddot = n(p.k4) * t229;
        let q_5_ddot = n(p.k4) * t234;
        let q_6_ddot = n(p.k4) * t239;
        let q_7_ddot = n(p.k4) * t243;
        let q_8_ddot = n(p.k28) * ((t240 - t243).mul_add(t245, t244) - t247);
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
    let t11 = t10 + t7;
    let t12 = t8 + q_5_dot;
    let t13 = t9 + q_5;
    let (sin_t13, cos_t13) = t13.sin_cos();
    let t14 = t12 * sin_t13;
    let t15 = t14 + t11;
    let t16 = t12 + q_6_dot;
    let t17 = t13 + q_6;
    let (sin_t17, cos_t17) = t17.sin_cos();
    let t18 = t16 * sin_t17;
    let t19 = p.k0 * t18 + p.l * t15;
    let t20 = t1 * cos_t3;
    let t21 = t0 * cos_t2;
    let t22 = t21 + q_1_dot * cos_q_1;
    let t23 = t20 + t22;
    let t24 = t8 * cos_t9;
    let t25 = t24 + t23;
    let t26 = t12 * cos_t13;
    let t27 = t26 + t25;
    let t28 = t16 * cos_t17;
    let t29 = p.k0 * t28 + p.l * t27;
    let t30 = p.k0 * t14 + p.l * t11;
    let t31 = p.k0 * t26 + p.l * t25;
    let t32 = S::from_f64(0.5) * (p.m * (t30 * t30 + t31 * t31) + t12 * (t12 * p.J));
    let t33 = S::from_f64(0.5) * (p.m * (t19 * t19 + t29 * t29) + t16 * (t16 * p.J));
    let t34 = t18 + t15;
    let t35 = t16 + q_7_dot;
    let t36 = t17 + q_7;
    let (sin_t36, cos_t36) = t36.sin_cos();
    let t37 = t35 * sin_t36;
    let t38 = t35 + q_8_dot;
    let t39 = t38 * p.k0;
    let t40 = t36 + q_8;
    let (sin_t40, cos_t40) = t40.sin_cos();
    let t41 = t39 * sin_t40 + p.l * (t37 + t34);
    let t42 = t28 + t27;
    let t43 = t35 * cos_t36;
    let t44 = t39 * cos_t40 + p.l * (t43 + t42);
    let t45 = p.k0 * t37 + p.l * t34;
    let t46 = p.k0 * t43 + p.l * t42;
    let t47 = S::from_f64(0.5) * (p.m * (t45 * t45 + t46 * t46) + t35 * (t35 * p.J));
    let t48 = S::from_f64(0.5) * (p.m * (t41 * t41 + t44 * t44) + t38 * (t38 * p.J));
    let t49 = p.k0 * t10 + p.l * t7;
    let t50 = p.k0 * t24 + p.l * t23;
    let t51 = p.k0 * t4 + p.l * t6;
    let t52 = p.k0 * t20 + p.l * t22;
    let t53 = S::from_f64(0.5) * (p.m * (t51 * t51 + t52 * t52) + t1 * (t1 * p.J));
    let t54 = S::from_f64(0.5) * (p.m * (t49 * t49 + t50 * t50) + t8 * (t8 * p.J));
    let t55 = q_1_dot * p.l;
    let t56 = p.k0 * t5 + sin_q_1 * t55;
    let t57 = p.k0 * t21 + cos_q_1 * t55;
    let t58 = S::from_f64(0.5) * (p.m * (t56 * t56 + t57 * t57) + t0 * (t0 * p.J));
    let t59 = t58 + q_1_dot * (q_1_dot * p.k5) + (t54 + t53);
    t59 + (t33 + t32 + (t48 + t47))
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
    let t3 = cos_t1 + t2;
    let t4 = t1 + q_4;
    let cos_t4 = t4.cos();
    let t5 = cos_t4 + t3;
    let t6 = t4 + q_5;
    let cos_t6 = t6.cos();
    let t7 = cos_t6 + t5;
    let t8 = t6 + q_6;
    let cos_t8 = t8.cos();
    let t9 = cos_t8 + t7;
    let t10 = t8 + q_7;
    let cos_t10 = t10.cos();
    let t11 = t10 + q_8;
    let cos_t11 = t11.cos();
    let t12 = p.k2 * (p.k0 * cos_t11 + p.l * (cos_t10 + t9));
    let t13 = p.k2 * (p.k0 * cos_t8 + p.l * t7) + p.k2 * (p.k0 * cos_t6 + p.l * t5);
    let t14 = p.k2 * (p.k0 * cos_t4 + p.l * t3) + p.k2 * (p.k0 * cos_t1 + p.l * t2);
    let t15 = p.k2 * (p.k0 * cos_t0 + p.l * cos_q_1) + cos_q_1 * p.k3 + t14;
    -(t15 + (t13 + (t12 + p.k2 * (p.k0 * cos_t10 + p.l * t9))))
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
        *result = accelerations(self, q, v)?;
        Ok(())
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

/// Whether elimination has left nothing but rounding errors of a diagonal element; so too if it is
/// no number.
fn vanishes<S: ::lagrangian::Scalar>(pivot: S, diagonal: S, share: f64) -> bool {
    let bound = S::from_f64(share) * diagonal;
    pivot.guarded(bound).is_none()
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
