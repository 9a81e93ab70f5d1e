// @generated from machines/closed_pendulum.machine by `cargo xtask generate`; edits are lost.

//! Five equal uniform bars that hang in a row between two pins, d apart on one level. Angles are
//! absolute, from the line through the pins; two constraints leave three degrees of freedom.
//!
//! 5 coordinates, 5 parameters. Arithmetic of one call:
//!
//! | function | mul | add | div | sin cos | other | temporaries |
//! | --- | --: | --: | --: | --: | --: | --: |
//! | `prepare` | 32 | 13 | 2 | 0 | 0 | 47 |
//! | `start` | 2 | 2 | 0 | 0 | 0 | 4 |
//! | `mass_matrix` | 30 | 10 | 0 | 5 | 0 | 50 |
//! | `bias` | 42 | 27 | 0 | 5 | 0 | 79 |
//! | `applied` | 5 | 0 | 0 | 5 | 0 | 10 |
//! | `forces` | 44 | 38 | 0 | 5 | 0 | 92 |
//! | `constraint_positions` | 2 | 9 | 0 | 5 | 0 | 21 |
//! | `constraint_rates` | 12 | 8 | 0 | 5 | 0 | 30 |
//! | `constraint_matrix` | 10 | 0 | 0 | 5 | 0 | 20 |
//! | `constraint_drift` | 17 | 8 | 0 | 5 | 0 | 35 |
//! | `accelerations` | 285 | 179 | 6 | 5 | 0 | 480 |
//! | `multipliers` | 205 | 125 | 6 | 5 | 0 | 346 |
//! | `kinetic_energy` | 52 | 26 | 0 | 5 | 0 | 88 |
//! | `potential_energy` | 10 | 11 | 0 | 5 | 0 | 26 |
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

/// Five equal uniform bars that hang in a row between two pins, d apart on one level. Angles are
/// absolute, from the line through the pins; two constraints leave three degrees of freedom.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClosedPendulum<S = f64> {
    /// Length and mass of a bar, inertia about its middle, distance of the pins. Unit: `m`.
    /// Default: 1.
    pub l: S,
    /// `m`. Unit: `kg`. Default: 1.
    pub m: S,
    /// `J`. Unit: `kg*m^2`. Default: 1/12.
    pub J: S,
    /// `d`. Unit: `m`. Default: 2.
    pub d: S,
    /// `g`. Unit: `m/s^2`. Default: 9.81.
    pub g: S,
}

impl Default for ClosedPendulum {
    fn default() -> Self {
        Self {
            l: 1.0,
            m: 1.0,
            J: 0.08333333333333333,
            d: 2.0,
            g: 9.81,
        }
    }
}

impl<S> ClosedPendulum<S> {
    /// These values as other numbers.
    pub fn map<R>(self, f: impl Fn(S) -> R) -> ClosedPendulum<R> {
        ClosedPendulum {
            l: f(self.l),
            m: f(self.m),
            J: f(self.J),
            d: f(self.d),
            g: f(self.g),
        }
    }
}

impl<S: ::lagrangian::emitted::Scalar> ClosedPendulum<S> {
    /// Computes what depends on the parameters alone, once.
    pub fn prepare(&self) -> Prepared<S> {
        let k3 = self.l * self.m;
        let t0 = self.l * self.l;
        let t1 = self.l * k3;
        let t2 = self.g * k3;
        let k16 = S::from_f64(0.5) * k3;
        let k32 = S::from_f64(0.25) * t0;
        let t3 = t1 * S::from_f64(0.25);
        let k9 = self.J + t1 * S::from_f64(4.25);
        let k2 = S::from_f64(0.5) * t2;
        let k5 = S::from_f64(0.5) * t1;
        let k17 = t2 * S::from_f64(1.5);
        let k18 = t2 * S::from_f64(2.5);
        let k19 = t2 * S::from_f64(3.5);
        let k13 = self.J + t3;
        let k20 = t2 * S::from_f64(4.5);
        let k34 = S::ONE / k13;
        let k0 = self.l * S::from_f64(0.5);
        let k1 = self.m * self.g;
        let k4 = S::from_f64(0.125) * (self.J * S::from_f64(4.0) + t1);
        let k6 = t1 * S::from_f64(1.5);
        let k7 = t1 * S::from_f64(2.5);
        let k8 = t1 * S::from_f64(3.5);
        let k10 = self.J + t1 * S::from_f64(3.25);
        let k11 = self.J + t1 * S::from_f64(2.25);
        let k12 = self.J + t1 * S::from_f64(1.25);
        let k14 = self.m * S::from_f64(0.5);
        let k15 = k3 * S::from_f64(0.25);
        let k21 = -self.l;
        let k22 = -k20;
        let k23 = -k19;
        let k24 = -k18;
        let k25 = -k17;
        let k26 = -k2;
        let k27 = t3 * k34;
        let k28 = self.J - t3;
        let k29 = k34 * k32;
        let k30 = S::from_f64(0.5) * t0;
        let k31 = self.m * self.m;
        let k33 = k16 * k34;
        let k35 = k5 * k34;
        let k36 = S::ONE / k9;
        let singular = if vanishes(k13, k13, 6.217248937900877e-15) {
            Some(singular(4, k13, k13))
        } else {
            None
        };
        Prepared {
            l: self.l,
            m: self.m,
            J: self.J,
            d: self.d,
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
    pub fn start(&self) -> ::lagrangian::emitted::State<Coordinates<S>> {
        let q_5 = S::pi() * S::from_f64(0.5);
        let q_4 = S::pi() * S::from_ratio(1, 3);
        let q_1 = -q_5;
        let zero = S::ZERO;
        let q_3 = -q_4;
        let q = [q_1, zero, q_3, q_4, q_5];
        let v = [S::ZERO; 5];
        ::lagrangian::emitted::State {
            t: 0.0,
            q: Coordinates::from_array(q),
            v: Coordinates::from_array(v),
        }
    }
}

/// The coordinates of [`ClosedPendulum`], or their rates, by name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coordinates<S = f64> {
    /// `q`. Unit: `rad`. Members: `q[1]` to `q[5]`.
    pub q: [S; 5],
}

impl<S: Copy> Coordinates<S> {
    /// The numbers in the order of the description: the order of `q` in every function here.
    pub fn to_array(self) -> [S; 5] {
        [self.q[0], self.q[1], self.q[2], self.q[3], self.q[4]]
    }

    /// Names for numbers in the order of the description.
    pub fn from_array(q: [S; 5]) -> Self {
        Self {
            q: [q[0], q[1], q[2], q[3], q[4]],
        }
    }

    /// These values as other numbers.
    pub fn map<R>(self, f: impl Fn(S) -> R) -> Coordinates<R> {
        Coordinates { q: self.q.map(&f) }
    }
}

/// What can be set while a [`ClosedPendulum`] runs.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Inputs {}

/// What can be observed of a [`ClosedPendulum`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Outputs {}

/// The parameters of a [`ClosedPendulum`], with the work done that depends on them alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prepared<S = f64> {
    /// `l`
    l: S,
    /// `m`
    m: S,
    /// `J`
    J: S,
    /// `d`
    d: S,
    /// `g`
    g: S,
    /// `0.5*l`
    k0: S,
    /// `m*g`
    k1: S,
    /// `0.5*l*m*g`
    k2: S,
    /// `l*m`
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
    /// `J + 4.25*l^2*m`
    k9: S,
    /// `J + 3.25*l^2*m`
    k10: S,
    /// `J + 2.25*l^2*m`
    k11: S,
    /// `J + 1.25*l^2*m`
    k12: S,
    /// `J + 0.25*l^2*m`
    k13: S,
    /// `0.5*m`
    k14: S,
    /// `0.25*l*m`
    k15: S,
    /// `0.5*l*m`
    k16: S,
    /// `1.5*l*m*g`
    k17: S,
    /// `2.5*l*m*g`
    k18: S,
    /// `3.5*l*m*g`
    k19: S,
    /// `4.5*l*m*g`
    k20: S,
    /// `-l`
    k21: S,
    /// `-4.5*l*m*g`
    k22: S,
    /// `-3.5*l*m*g`
    k23: S,
    /// `-2.5*l*m*g`
    k24: S,
    /// `-1.5*l*m*g`
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
    /// `0.25*l^2`
    k32: S,
    /// `0.5*l*m/(J + 0.25*l^2*m)`
    k33: S,
    /// `1/(J + 0.25*l^2*m)`
    k34: S,
    /// `0.5*l^2*m/(J + 0.25*l^2*m)`
    k35: S,
    /// `1/(J + 4.25*l^2*m)`
    k36: S,
    /// Why these parameters leave the machine without accelerations, if they do.
    singular: Option<::lagrangian::emitted::Singular>,
}

/// Mass matrix `M`.
///
/// ```text
/// M[q[1], q[1]] = 17/4*l^2*m + J
/// M[q[2], q[1]] = 7/2*l^2*m*cos(q[2] - q[1])
/// M[q[2], q[2]] = 13/4*l^2*m + J
/// M[q[3], q[1]] = 5/2*l^2*m*cos(q[3] - q[1])
/// M[q[3], q[2]] = 5/2*l^2*m*cos(q[3] - q[2])
/// M[q[3], q[3]] = 9/4*l^2*m + J
/// M[q[4], q[1]] = 3/2*l^2*m*cos(q[4] - q[1])
/// M[q[4], q[2]] = 3/2*l^2*m*cos(q[4] - q[2])
/// M[q[4], q[3]] = 3/2*l^2*m*cos(q[4] - q[3])
/// M[q[4], q[4]] = 5/4*l^2*m + J
/// M[q[5], q[1]] = 1/2*l^2*m*cos(q[5] - q[1])
/// M[q[5], q[2]] = 1/2*l^2*m*cos(q[5] - q[2])
/// M[q[5], q[3]] = 1/2*l^2*m*cos(q[5] - q[3])
/// M[q[5], q[4]] = 1/2*l^2*m*cos(q[5] - q[4])
/// M[q[5], q[5]] = 1/4*l^2*m + J
/// ```
pub fn mass_matrix<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 5]) -> [[S; 5]; 5] {
    let q_1 = q[0];
    let q_2 = q[1];
    let q_3 = q[2];
    let q_4 = q[3];
    let q_5 = q[4];
    let (sin_q_2, cos_q_2) = q_2.sin_cos();
    let (sin_q_1, cos_q_1) = q_1.sin_cos();
    let (sin_q_3, cos_q_3) = q_3.sin_cos();
    let (sin_q_4, cos_q_4) = q_4.sin_cos();
    let (sin_q_5, cos_q_5) = q_5.sin_cos();
    let m21 = (sin_q_2 * sin_q_1 + cos_q_2 * cos_q_1) * p.k8;
    let m31 = p.k7 * (sin_q_1 * sin_q_3 + cos_q_1 * cos_q_3);
    let m32 = p.k7 * (sin_q_2 * sin_q_3 + cos_q_2 * cos_q_3);
    let m41 = p.k6 * (sin_q_1 * sin_q_4 + cos_q_1 * cos_q_4);
    let m42 = p.k6 * (sin_q_2 * sin_q_4 + cos_q_2 * cos_q_4);
    let m43 = p.k6 * (sin_q_3 * sin_q_4 + cos_q_3 * cos_q_4);
    let m51 = p.k5 * (sin_q_1 * sin_q_5 + cos_q_1 * cos_q_5);
    let m52 = p.k5 * (sin_q_2 * sin_q_5 + cos_q_2 * cos_q_5);
    let m53 = p.k5 * (sin_q_3 * sin_q_5 + cos_q_3 * cos_q_5);
    let m54 = p.k5 * (sin_q_4 * sin_q_5 + cos_q_4 * cos_q_5);
    [
        [p.k9, m21, m31, m41, m51],
        [m21, p.k10, m32, m42, m52],
        [m31, m32, p.k11, m43, m53],
        [m41, m42, m43, p.k12, m54],
        [m51, m52, m53, m54, p.k13],
    ]
}

/// Bias `h`: velocity products and explicit time in the inertia forces.
///
/// ```text
/// h[q[1]] = …
/// h[q[2]] = …
/// h[q[3]] = …
/// h[q[4]] = 3/2*l^2*m*sin(q[4] - q[1])*der(q[1])^2 + 3/2*l^2*m*sin(q[4] - q[2])*der(q[2])^2
///     + 3/2*l^2*m*sin(q[4] - q[3])*der(q[3])^2 - 1/2*l^2*m*sin(q[5] - q[4])*der(q[5])^2
/// h[q[5]] = 1/2*l^2*m*sin(q[5] - q[1])*der(q[1])^2 + 1/2*l^2*m*sin(q[5] - q[2])*der(q[2])^2
///     + 1/2*l^2*m*sin(q[5] - q[3])*der(q[3])^2 + 1/2*l^2*m*sin(q[5] - q[4])*der(q[4])^2
/// ```
pub fn bias<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 5], v: &[S; 5]) -> [S; 5] {
    let q_1 = q[0];
    let q_2 = q[1];
    let q_3 = q[2];
    let q_4 = q[3];
    let q_5 = q[4];
    let q_1_dot = v[0];
    let q_2_dot = v[1];
    let q_3_dot = v[2];
    let q_4_dot = v[3];
    let q_5_dot = v[4];
    let (sin_q_3, cos_q_3) = q_3.sin_cos();
    let (sin_q_2, cos_q_2) = q_2.sin_cos();
    let (sin_q_1, cos_q_1) = q_1.sin_cos();
    let (sin_q_4, cos_q_4) = q_4.sin_cos();
    let (sin_q_5, cos_q_5) = q_5.sin_cos();
    let t0 = q_4_dot * q_4_dot;
    let t1 = q_3_dot * q_3_dot;
    let t2 = q_2_dot * q_2_dot;
    let t3 = q_1_dot * q_1_dot;
    let t4 = t0 * p.k6;
    let t5 = q_5_dot * (q_5_dot * p.k5);
    let t6 = t1 * sin_q_3;
    let t7 = t2 * sin_q_2;
    let t8 = sin_q_1 * t3;
    let t9 = t1 * cos_q_3;
    let t10 = t2 * cos_q_2;
    let t11 = cos_q_1 * t3;
    let t12 = p.k7 * t6;
    let t13 = t7 + t8;
    let t14 = t9 * p.k7;
    let t15 = t5 * sin_q_5 + t4 * sin_q_4;
    let t16 = t10 + t11;
    let t17 = t5 * cos_q_5 + t4 * cos_q_4;
    let t18 = cos_q_5 * (t13 + (t6 + t0 * sin_q_4));
    let t19 = sin_q_1 * (t17 + (t14 + t10 * p.k8));
    let t20 = sin_q_2 * (t17 + (t14 + p.k8 * t11));
    let t21 = p.k6 * (sin_q_4 * (t9 + t16) - cos_q_4 * (t6 + t13));
    let h_q_1 = t19 - cos_q_1 * (t15 + (t12 + p.k8 * t7));
    let h_q_2 = t20 - cos_q_2 * (t15 + (t12 + p.k8 * t8));
    let h_q_3 = sin_q_3 * (t17 + p.k7 * t16) - cos_q_3 * (t15 + p.k7 * t13);
    let h_q_4 = t5 * (cos_q_5 * sin_q_4 - sin_q_5 * cos_q_4) + t21;
    let h_q_5 = p.k5 * (sin_q_5 * (t16 + (t9 + t0 * cos_q_4)) - t18);
    [h_q_1, h_q_2, h_q_3, h_q_4, h_q_5]
}

/// Applied generalized forces `Q`.
///
/// ```text
/// Q[q[1]] = -9/2*l*m*g*cos(q[1])
/// Q[q[2]] = -7/2*l*m*g*cos(q[2])
/// Q[q[3]] = -5/2*l*m*g*cos(q[3])
/// Q[q[4]] = -3/2*l*m*g*cos(q[4])
/// Q[q[5]] = -1/2*l*m*g*cos(q[5])
/// ```
pub fn applied<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 5]) -> [S; 5] {
    let q_1 = q[0];
    let q_2 = q[1];
    let q_3 = q[2];
    let q_4 = q[3];
    let q_5 = q[4];
    let cos_q_1 = q_1.cos();
    let cos_q_2 = q_2.cos();
    let cos_q_3 = q_3.cos();
    let cos_q_4 = q_4.cos();
    let cos_q_5 = q_5.cos();
    let q_q_1 = p.k22 * cos_q_1;
    let q_q_2 = p.k23 * cos_q_2;
    let q_q_3 = p.k24 * cos_q_3;
    let q_q_4 = p.k25 * cos_q_4;
    let q_q_5 = p.k26 * cos_q_5;
    [q_q_1, q_q_2, q_q_3, q_q_4, q_q_5]
}

/// Right-hand side `f = Q - h` of `M a = f`.
pub fn forces<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 5], v: &[S; 5]) -> [S; 5] {
    let q_1 = q[0];
    let q_2 = q[1];
    let q_3 = q[2];
    let q_4 = q[3];
    let q_5 = q[4];
    let q_1_dot = v[0];
    let q_2_dot = v[1];
    let q_3_dot = v[2];
    let q_4_dot = v[3];
    let q_5_dot = v[4];
    let (sin_q_2, cos_q_2) = q_2.sin_cos();
    let (sin_q_3, cos_q_3) = q_3.sin_cos();
    let (sin_q_4, cos_q_4) = q_4.sin_cos();
    let (sin_q_1, cos_q_1) = q_1.sin_cos();
    let (sin_q_5, cos_q_5) = q_5.sin_cos();
    let t0 = q_4_dot * q_4_dot;
    let t1 = q_2_dot * q_2_dot;
    let t2 = q_3_dot * q_3_dot;
    let t3 = q_1_dot * q_1_dot;
    let t4 = t0 * p.k6;
    let t5 = q_5_dot * (q_5_dot * p.k5);
    let t6 = t1 * sin_q_2;
    let t7 = t2 * sin_q_3;
    let t8 = t4 * sin_q_4;
    let t9 = sin_q_1 * t3;
    let t10 = t5 * sin_q_5;
    let t11 = t1 * cos_q_2;
    let t12 = t2 * cos_q_3;
    let t13 = p.k7 * t7;
    let t14 = cos_q_1 * t3;
    let t15 = t6 + t9;
    let t16 = t5 * cos_q_5 + t4 * cos_q_4;
    let t17 = t12 * p.k7;
    let t18 = t11 + t14;
    let t19 = sin_q_5 * (t18 + (t12 + t0 * cos_q_4));
    let t20 = cos_q_2 * (p.k19 - t8 - t13 - (t10 + p.k8 * t9));
    let t21 = t5 * (cos_q_5 * sin_q_4 - sin_q_5 * cos_q_4) + cos_q_4 * p.k17;
    let t22 = cos_q_1 * (t10 + p.k8 * t6 + (t13 + (t8 - p.k20)));
    let t23 = sin_q_3 * (t16 + p.k7 * t18) + cos_q_3 * (p.k18 - t8 - t10 - p.k7 * t15);
    let f_q_1 = t22 - sin_q_1 * (t16 + (t17 + t11 * p.k8));
    let f_q_2 = -(sin_q_2 * (t16 + (t17 + p.k8 * t14)) + t20);
    let f_q_3 = -t23;
    let f_q_4 = -(p.k6 * (sin_q_4 * (t12 + t18) - cos_q_4 * (t7 + t15)) + t21);
    let f_q_5 = -(p.k5 * (t19 - cos_q_5 * (t15 + (t7 + t0 * sin_q_4))) + cos_q_5 * p.k2);
    [f_q_1, f_q_2, f_q_3, f_q_4, f_q_5]
}

/// Residuals `g` of the constraints of positions; 0 for those of velocities alone.
///
/// ```text
/// g[along] = l*cos(q[1]) + l*cos(q[2]) + l*cos(q[3]) + l*cos(q[4]) + l*cos(q[5]) - d
/// g[across] = l*sin(q[1]) + l*sin(q[2]) + l*sin(q[3]) + l*sin(q[4]) + l*sin(q[5])
/// ```
pub fn constraint_positions<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 5],
) -> [S; 2] {
    let q_1 = q[0];
    let q_2 = q[1];
    let q_3 = q[2];
    let q_4 = q[3];
    let q_5 = q[4];
    let (sin_q_2, cos_q_2) = q_2.sin_cos();
    let (sin_q_1, cos_q_1) = q_1.sin_cos();
    let (sin_q_3, cos_q_3) = q_3.sin_cos();
    let (sin_q_4, cos_q_4) = q_4.sin_cos();
    let (sin_q_5, cos_q_5) = q_5.sin_cos();
    let g1 = p.l * (cos_q_5 + (cos_q_4 + (cos_q_3 + (cos_q_2 + cos_q_1)))) - p.d;
    let g2 = p.l * (sin_q_5 + (sin_q_4 + (sin_q_3 + (sin_q_2 + sin_q_1))));
    [g1, g2]
}

/// Residuals `phi = G v + dg/dt` of the constraints at the level of velocities.
///
/// ```text
/// phi[along] = -l*sin(q[1])*der(q[1]) - l*sin(q[2])*der(q[2]) - l*sin(q[3])*der(q[3])
///     - l*sin(q[4])*der(q[4]) - l*sin(q[5])*der(q[5])
/// phi[across] = l*cos(q[1])*der(q[1]) + l*cos(q[2])*der(q[2]) + l*cos(q[3])*der(q[3])
///     + l*cos(q[4])*der(q[4]) + l*cos(q[5])*der(q[5])
/// ```
pub fn constraint_rates<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 5],
    v: &[S; 5],
) -> [S; 2] {
    let q_1 = q[0];
    let q_2 = q[1];
    let q_3 = q[2];
    let q_4 = q[3];
    let q_5 = q[4];
    let q_1_dot = v[0];
    let q_2_dot = v[1];
    let q_3_dot = v[2];
    let q_4_dot = v[3];
    let q_5_dot = v[4];
    let (sin_q_1, cos_q_1) = q_1.sin_cos();
    let (sin_q_2, cos_q_2) = q_2.sin_cos();
    let (sin_q_3, cos_q_3) = q_3.sin_cos();
    let (sin_q_4, cos_q_4) = q_4.sin_cos();
    let (sin_q_5, cos_q_5) = q_5.sin_cos();
    let t0 = q_3_dot * sin_q_3 + (q_2_dot * sin_q_2 + q_1_dot * sin_q_1);
    let t1 = q_3_dot * cos_q_3 + (q_2_dot * cos_q_2 + q_1_dot * cos_q_1);
    let phi1 = p.k21 * (q_5_dot * sin_q_5 + (q_4_dot * sin_q_4 + t0));
    let phi2 = (q_5_dot * cos_q_5 + (q_4_dot * cos_q_4 + t1)) * p.l;
    [phi1, phi2]
}

/// Constraint matrix `G`, the derivatives of `phi` by the rates.
///
/// ```text
/// G[along, q[1]] = -l*sin(q[1])
/// G[along, q[2]] = -l*sin(q[2])
/// G[along, q[3]] = -l*sin(q[3])
/// G[along, q[4]] = -l*sin(q[4])
/// G[along, q[5]] = -l*sin(q[5])
/// G[across, q[1]] = l*cos(q[1])
/// G[across, q[2]] = l*cos(q[2])
/// G[across, q[3]] = l*cos(q[3])
/// G[across, q[4]] = l*cos(q[4])
/// G[across, q[5]] = l*cos(q[5])
/// ```
pub fn constraint_matrix<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 5]) -> [S; 10] {
    let q_1 = q[0];
    let q_2 = q[1];
    let q_3 = q[2];
    let q_4 = q[3];
    let q_5 = q[4];
    let (sin_q_1, cos_q_1) = q_1.sin_cos();
    let (sin_q_2, cos_q_2) = q_2.sin_cos();
    let (sin_q_3, cos_q_3) = q_3.sin_cos();
    let (sin_q_4, cos_q_4) = q_4.sin_cos();
    let (sin_q_5, cos_q_5) = q_5.sin_cos();
    let g1_1 = p.k21 * sin_q_1;
    let g1_2 = p.k21 * sin_q_2;
    let g1_3 = p.k21 * sin_q_3;
    let g1_4 = p.k21 * sin_q_4;
    let g1_5 = p.k21 * sin_q_5;
    let g2_1 = cos_q_1 * p.l;
    let g2_2 = cos_q_2 * p.l;
    let g2_3 = cos_q_3 * p.l;
    let g2_4 = cos_q_4 * p.l;
    let g2_5 = cos_q_5 * p.l;
    [g1_1, g1_2, g1_3, g1_4, g1_5, g2_1, g2_2, g2_3, g2_4, g2_5]
}

/// Right-hand side `gamma` of `G a = gamma`.
///
/// ```text
/// gamma[along] = l*cos(q[1])*der(q[1])^2 + l*cos(q[2])*der(q[2])^2 + l*cos(q[3])*der(q[3])^2
///     + l*cos(q[4])*der(q[4])^2 + l*cos(q[5])*der(q[5])^2
/// gamma[across] = l*sin(q[1])*der(q[1])^2 + l*sin(q[2])*der(q[2])^2 + l*sin(q[3])*der(q[3])^2
///     + l*sin(q[4])*der(q[4])^2 + l*sin(q[5])*der(q[5])^2
/// ```
pub fn constraint_drift<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 5],
    v: &[S; 5],
) -> [S; 2] {
    let q_1 = q[0];
    let q_2 = q[1];
    let q_3 = q[2];
    let q_4 = q[3];
    let q_5 = q[4];
    let q_1_dot = v[0];
    let q_2_dot = v[1];
    let q_3_dot = v[2];
    let q_4_dot = v[3];
    let q_5_dot = v[4];
    let (sin_q_1, cos_q_1) = q_1.sin_cos();
    let (sin_q_2, cos_q_2) = q_2.sin_cos();
    let (sin_q_3, cos_q_3) = q_3.sin_cos();
    let (sin_q_4, cos_q_4) = q_4.sin_cos();
    let (sin_q_5, cos_q_5) = q_5.sin_cos();
    let t0 = q_1_dot * q_1_dot;
    let t1 = q_2_dot * q_2_dot;
    let t2 = q_3_dot * q_3_dot;
    let t3 = q_4_dot * q_4_dot;
    let t4 = q_5_dot * q_5_dot;
    let t5 = t3 * cos_q_4 + (t2 * cos_q_3 + (t1 * cos_q_2 + t0 * cos_q_1));
    let t6 = t3 * sin_q_4 + (t2 * sin_q_3 + (t1 * sin_q_2 + t0 * sin_q_1));
    let gamma1 = p.l * (t4 * cos_q_5 + t5);
    let gamma2 = p.l * (t4 * sin_q_5 + t6);
    [gamma1, gamma2]
}

/// Accelerations `a`, the solution of `M a = f + G^T lambda`, `G a = gamma` eliminated along the
/// machine.
///
/// A pivot that vanishes is an error.
pub fn accelerations<S: ::lagrangian::emitted::Number>(
    p: &Prepared<S>,
    q: &[S; 5],
    v: &[S; 5],
) -> Result<[S; 5], ::lagrangian::emitted::Singular> {
    S::run(Accelerations { p, q, v })
}

/// A call of [`accelerations`], to be run with whatever instructions the processor has.
pub struct Accelerations<'a, S> {
    /// As `accelerations` takes it.
    pub p: &'a Prepared<S>,
    /// As `accelerations` takes it.
    pub q: &'a [S; 5],
    /// As `accelerations` takes it.
    pub v: &'a [S; 5],
}

impl<S: Copy> ::lagrangian::emitted::scalar::Kernel<S> for Accelerations<'_, S> {
    type Output = Result<[S; 5], ::lagrangian::emitted::Singular>;

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
        let q_1_dot = n(v[0]);
        let q_2_dot = n(v[1]);
        let q_3_dot = n(v[2]);
        let q_4_dot = n(v[3]);
        let q_5_dot = n(v[4]);
        let angles = [q_5, q_4, q_3, q_2, q_1];
        let circular = N::sin_cos_all(angles);
        let (sin_q_5, cos_q_5) = circular[0];
        let (sin_q_4, cos_q_4) = circular[1];
        let (sin_q_3, cos_q_3) = circular[2];
        let (sin_q_2, cos_q_2) = circular[3];
        let (sin_q_1, cos_q_1) = circular[4];
        let t0 = q_5_dot * q_5_dot;
        let t1 = q_4_dot * q_4_dot;
        let t2 = q_3_dot * q_3_dot;
        let t3 = q_1_dot * q_1_dot;
        let t4 = q_2_dot * q_2_dot;
        let t5 = sin_q_5 * cos_q_5;
        let t6 = sin_q_4 * n(p.l);
        let t7 = cos_q_4 * n(p.l);
        let t8 = n(p.l) * sin_q_3;
        let t9 = n(p.l) * cos_q_3;
        let t10 = cos_q_5 * t0;
        let t11 = t5 * n(p.k27);
        let t12 = cos_q_5.neg_mul_add(cos_q_5 * n(p.k27), N::from_f64(1.5));
        let t13 = sin_q_5.neg_mul_add(sin_q_5 * n(p.k27), N::from_f64(1.5));
        let t14 = t6 * t1;
        let t15 = sin_q_5 * t0;
        let t16 = t7 * t1;
        let t17 = t7.mul_sub(t12, t11 * t6);
        let t18 = t13.mul_sub(t6, t11 * t7);
        let t19 = n(p.l) * sin_q_2;
        let t20 = n(p.l) * cos_q_2;
        let t21 = sin_q_5 * n(p.l);
        let t22 = cos_q_5 * n(p.k33);
        let t23 = t8 * t2;
        let t24 = t13.mul_add(t16, t11.mul_add(t14, n(p.k0) * t10));
        let t25 = t17.mul_add(t7 * n(p.m), n(p.k28));
        let t26 = t18.mul_add(t6 * n(p.m), t25);
        let t27 = t21 * t22;
        let t28 = sin_q_5 * n(p.k33);
        let t29 = t12.mul_add(t14, t11.mul_add(t16, n(p.k0) * t15));
        let t30 = t9 * t2;
        let t31 = N::ONE / t26;
        let t32 = n(p.l) * sin_q_1;
        let t33 = n(p.l) * cos_q_1;
        let t34 = cos_q_2 * (n(p.k30) * cos_q_1);
        let t35 = t28 * t21;
        let t36 = t7.mul_sub(t29, t6 * t24);
        let t37 = sin_q_1 * t3;
        let t38 = sin_q_2 * n(p.k0);
        let t39 = cos_q_2 * n(p.k0);
        let t40 = t33 * t3;
        let t41 = t6.neg_mul_add(t35, t7.neg_mul_add(t27, t6));
        let t42 = cos_q_5 * n(p.l);
        let t43 = t20.mul_add(t4, t40);
        let t44 = sin_q_2.mul_add(t4, t37);
        let t45 = t39.mul_add(t4, t40);
        let t46 = t22 * t42;
        let t47 = t31.mul_add(t18 * t17, t5 * n(p.k29));
        let t48 = n(p.m) * t31;
        let t49 = n(p.l).neg_mul_add(t44, n(p.g));
        let t50 = n(p.g) - t38.mul_add(t4, n(p.l) * t37);
        let t51 = t28 * t42;
        let t52 = n(p.m) * t47;
        let t53 = t17 * t48;
        let t54 = t18 * t48;
        let t55 = t37.neg_mul_add(n(p.k0), n(p.g)) * (cos_q_1 * n(p.k0));
        let t56 = t6.neg_mul_add(t51, t7.neg_mul_add(t46, t7));
        let t57 = t17.neg_mul_add(t53, t12 + N::ONE);
        let t58 = t18.neg_mul_add(t54, t13 + N::ONE);
        let t59 = t53.mul_add(t41, t27);
        let t60 = t54.mul_add(t41, t35);
        let t61 = t9.mul_sub(t57, t52 * t8);
        let t62 = t58.mul_sub(t8, t52 * t9);
        let t63 = t32.mul_add(t45, t37 * (cos_q_1 * n(p.k32)));
        let t64 = t53.mul_add(t56, t46);
        let t65 = t54.mul_add(t56, t51);
        let t66 = t58.mul_add(t30, t52.mul_add(t23, t54.mul_add(t36, t24)));
        let t67 = t52.mul_add(t30, t53.neg_mul_add(t36, t29));
        let t68 = t57.mul_add(t23, t67);
        let t69 = t8.neg_mul_add(t60, t9.neg_mul_add(t59, t8));
        let t70 = t61.mul_add(n(p.m) * t9, n(p.k28));
        let t71 = t62.mul_add(n(p.m) * t8, t70);
        let t72 = N::ONE / t71;
        let t73 = t8.neg_mul_add(t65, t9.neg_mul_add(t64, t9));
        let t74 = t9.mul_sub(t68, t8 * t66);
        let t75 = cos_q_3.mul_add(t2, cos_q_2.mul_add(t4, cos_q_1 * t3));
        let t76 = t15 + sin_q_4.mul_add(t1, sin_q_3.mul_add(t2, t44));
        let t77 = n(p.m) * t72;
        let t78 = n(p.m) * t72.mul_add(t62 * t61, t47);
        let t79 = t61 * t77;
        let t80 = t62 * t77;
        let t81 = t61.neg_mul_add(t79, t57 + N::from_f64(0.5));
        let t82 = t62.neg_mul_add(t80, t58 + N::from_f64(0.5));
        let t83 = t20.mul_sub(t81, t78 * t19);
        let t84 = t79.mul_add(t69, t59);
        let t85 = t82.mul_sub(t19, t78 * t20);
        let t86 = t80.mul_add(t69, t60);
        let t87 = t81.mul_sub(t33, t78 * t32);
        let t88 = t79.mul_add(t73, t64);
        let t89 = t78.mul_add(t43, t79.neg_mul_add(t74, t68));
        let t90 = t81.neg_mul_add(t49, t89);
        let t91 = t78.neg_mul_add(t49, t80.mul_add(t74, t66));
        let t92 = t82.mul_add(t43, t91);
        let t93 = t83.mul_add(n(p.m) * t20, n(p.k13));
        let t94 = t85.mul_add(n(p.m) * t19, t93);
        let t95 = t83.mul_add(t33, sin_q_2.mul_add(n(p.k30) * sin_q_1, t34));
        let t96 = t85.mul_add(t32, t95);
        let t97 = t19.neg_mul_add(t86, t20.neg_mul_add(t84, t19));
        let t98 = t87.mul_add(n(p.m) * t33, n(p.k12));
        let t99 = N::ONE / t94;
        let t100 = t80.mul_add(t73, t65);
        let t101 = t20.mul_sub(t90, t39.mul_add(t50, t38 * t45));
        let t102 = t19.neg_mul_add(t92, t101);
        let t103 = t33.mul_sub(t90, t63 + t33.mul_add(t50, t55));
        let t104 = t19.neg_mul_add(t100, t20.neg_mul_add(t88, t20));
        let t105 = t82.mul_sub(t32, t78 * t33).mul_add(n(p.m) * t32, t98);
        let t106 = t99.neg_mul_add(t96 * (t96 * n(p.k31)), t105);
        let t107 = n(p.m) * t99;
        let t108 = N::ONE / t106;
        let t109 = t96 * t107;
        let t110 = t32.neg_mul_add(t86, t33.neg_mul_add(t84, t32));
        let t111 = t32.neg_mul_add(t100, t33.neg_mul_add(t88, t33));
        let t112 = t108 * t109.neg_mul_add(t97, t110);
        let t113 = t108 * t109.neg_mul_add(t102, t32.neg_mul_add(t92, t103));
        let t114 = t108 * t109.neg_mul_add(t104, t111);
        let t115 = t109.neg_mul_add(t112, t99 * t97);
        let t116 = n(p.m) * t113;
        let t117 = t109.neg_mul_add(t114, t99 * t104);
        let t118 = t19.mul_add(t115, t32 * t112);
        let t119 = t96.neg_mul_add(t116, t102);
        let t120 = t20.mul_add(t115, t33 * t112);
        let t121 = t19.mul_add(t117, t32 * t114);
        let t122 = t20.mul_add(t117, t33 * t114);
        let t123 = t107 * t119;
        let t124 = t113 * n(p.k3);
        let t125 = t119 * (t99 * n(p.k3));
        let t126 = t79.neg_mul_add(t120, t80.neg_mul_add(t118, t72 * t69));
        let t127 = t19.mul_add(t123, t32.mul_add(t116, t43));
        let t128 = t20.mul_add(t123, t33.mul_add(t116, t49));
        let t129 = n(p.l) * (t10 + cos_q_4.mul_add(t1, t75));
        let t130 = t79.neg_mul_add(t122, t80.neg_mul_add(t121, t72 * t73));
        let t131 = t8.mul_add(t126, t118);
        let t132 = t9.mul_add(t126, t120);
        let t133 = sin_q_2.mul_add(t115, sin_q_1 * t112);
        let t134 = t8.mul_add(t130, t121);
        let t135 = t9.mul_add(t130, t122);
        let t136 = cos_q_2.mul_add(t115, cos_q_1 * t112);
        let t137 = t61.neg_mul_add(t128, t62.neg_mul_add(t127, t74));
        let t138 = cos_q_1.neg_mul_add(t124, n(p.l) * t76);
        let t139 = cos_q_2.mul_add(t117, cos_q_1 * t114);
        let t140 = t53.neg_mul_add(t132, t54.neg_mul_add(t131, t31 * t41));
        let t141 = t77 * t137;
        let t142 = t137 * (t72 * n(p.k3));
        let t143 = t53.neg_mul_add(t135, t54.neg_mul_add(t134, t31 * t56));
        let t144 = t9.neg_mul_add(t141, t23 - t128);
        let t145 = t8.mul_add(t141, t30 + t127);
        let t146 = sin_q_2.mul_add(t125, sin_q_1.mul_add(t124, t129));
        let t147 = t28.neg_mul_add(t6.mul_add(t140, t131), t21 * n(p.k34));
        let t148 = t22.neg_mul_add(t7.mul_add(t140, t132), t147);
        let t149 = t18.neg_mul_add(t145, t17.mul_add(t144, t36));
        let t150 = t28.neg_mul_add(t6.mul_add(t143, t134), n(p.k34) * t42);
        let t151 = t22.neg_mul_add(t7.mul_add(t143, t135), t150);
        let t152 = sin_q_4.mul_add(t140, sin_q_3.mul_add(t126, t133));
        let t153 = cos_q_4.mul_add(t140, cos_q_3.mul_add(t126, t136));
        let t154 = t48 * t149;
        let t155 = t149 * (t31 * n(p.k3));
        let t156 = cos_q_4.mul_add(t143, cos_q_3.mul_add(t130, t139));
        let t157 = n(p.l) * sin_q_5.mul_add(t148, t152);
        let t158 = n(p.l) * cos_q_5.mul_add(t148, t153);
        let t159 = cos_q_3.neg_mul_add(t142, cos_q_2.neg_mul_add(t125, t138));
        let t160 = n(p.l) * cos_q_5.mul_add(t151, t156);
        let t161 = N::ONE / t157;
        let t162 = cos_q_5 * t7.neg_mul_add(t154, t14 + t144);
        let t163 = sin_q_5.mul_sub(t6.mul_add(t154, t16 + t145), t162);
        let t164 = n(p.k35) * t163;
        let t165 = t161 * t158;
        let t166 = sin_q_4.mul_add(t155, sin_q_3.mul_add(t142, t146));
        let t167 = sin_q_5.neg_mul_add(t164, t166);
        let t168 = t158.neg_mul_add(t165, t160);
        let t169 = cos_q_5.mul_add(t164, cos_q_4.neg_mul_add(t155, t159));
        let t170 = t165.mul_add(t167, t169) / t168;
        let t171 = t165.mul_add(t170, t161 * t167);
        let t172 = t151.neg_mul_add(t170, n(p.k33) * t163);
        let q_1_ddot = t112.neg_mul_add(t171, t114.mul_add(t170, t116));
        let q_2_ddot = t115.neg_mul_add(t171, t117.mul_add(t170, t123));
        let q_3_ddot = t126.neg_mul_add(t171, t130.mul_add(t170, t141));
        let q_4_ddot = t140.neg_mul_add(t171, t143.mul_add(t170, t154));
        let q_5_ddot = -t148.mul_add(t171, t172);
        let sound = t26.exceeds(N::from_f64(6.217248937900877e-15) * n(p.k12))
            & t71.exceeds(N::from_f64(6.217248937900877e-15) * n(p.k11))
            & t94.exceeds(N::from_f64(6.217248937900877e-15) * n(p.k10))
            & t106.exceeds(N::from_f64(6.217248937900877e-15) * n(p.k9))
            & t157.exceeds(N::from_f64(6.217248937900877e-15) * t157)
            & t168.exceeds(N::from_f64(6.217248937900877e-15) * t160)
            & q_5_ddot.is_finite();
        if !sound {
            check(t26, n(p.k12), 6.217248937900877e-15, 3)?;
            check(t71, n(p.k11), 6.217248937900877e-15, 2)?;
            check(t94, n(p.k10), 6.217248937900877e-15, 1)?;
            check(t106, n(p.k9), 6.217248937900877e-15, 0)?;
            check(t157, t157, 6.217248937900877e-15, 5)?;
            check(t168, t160, 6.217248937900877e-15, 6)?;
        }
        let accelerations = [
            q_1_ddot.store(),
            q_2_ddot.store(),
            q_3_ddot.store(),
            q_4_ddot.store(),
            q_5_ddot.store(),
        ];
        Ok(accelerations)
    }
}

/// Lagrange's multipliers `lambda` of `M a = f + G^T lambda`.
///
/// A pivot that vanishes is an error.
pub fn multipliers<S: ::lagrangian::emitted::Number>(
    p: &Prepared<S>,
    q: &[S; 5],
    v: &[S; 5],
) -> Result<[S; 2], ::lagrangian::emitted::Singular> {
    S::run(Multipliers { p, q, v })
}

/// A call of [`multipliers`], to be run with whatever instructions the processor has.
pub struct Multipliers<'a, S> {
    /// As `multipliers` takes it.
    pub p: &'a Prepared<S>,
    /// As `multipliers` takes it.
    pub q: &'a [S; 5],
    /// As `multipliers` takes it.
    pub v: &'a [S; 5],
}

impl<S: Copy> ::lagrangian::emitted::scalar::Kernel<S> for Multipliers<'_, S> {
    type Output = Result<[S; 2], ::lagrangian::emitted::Singular>;

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
        let q_1_dot = n(v[0]);
        let q_2_dot = n(v[1]);
        let q_3_dot = n(v[2]);
        let q_4_dot = n(v[3]);
        let q_5_dot = n(v[4]);
        let angles = [q_2, q_1, q_3, q_4, q_5];
        let circular = N::sin_cos_all(angles);
        let (sin_q_2, cos_q_2) = circular[0];
        let (sin_q_1, cos_q_1) = circular[1];
        let (sin_q_3, cos_q_3) = circular[2];
        let (sin_q_4, cos_q_4) = circular[3];
        let (sin_q_5, cos_q_5) = circular[4];
        let t0 = q_2_dot * q_2_dot;
        let t1 = q_1_dot * q_1_dot;
        let t2 = q_3_dot * q_3_dot;
        let t3 = q_4_dot * q_4_dot;
        let t4 = q_5_dot * q_5_dot;
        let t5 = cos_q_2 * t0;
        let t6 = sin_q_2 * t0;
        let t7 = sin_q_1 * t1;
        let t8 = sin_q_2.mul_add(sin_q_1, cos_q_2 * cos_q_1) * n(p.k8);
        let t9 = n(p.k7) * sin_q_1.mul_add(sin_q_3, cos_q_1 * cos_q_3);
        let t10 = n(p.k6) * sin_q_1.mul_add(sin_q_4, cos_q_1 * cos_q_4);
        let t11 = n(p.k36) * t8;
        let t12 = n(p.k5) * sin_q_1.mul_add(sin_q_5, cos_q_1 * cos_q_5);
        let t13 = n(p.k36) * t9;
        let t14 = n(p.k36) * t10;
        let t15 = t8.neg_mul_add(t11, n(p.k10));
        let t16 = cos_q_1 * t1;
        let t17 = n(p.k36) * t12;
        let t18 = n(p.k7) * sin_q_2.mul_add(sin_q_3, cos_q_2 * cos_q_3);
        let t19 = t8.neg_mul_add(t13, t18);
        let t20 = n(p.k6) * sin_q_2.mul_add(sin_q_4, cos_q_2 * cos_q_4);
        let t21 = t8.neg_mul_add(t14, t20);
        let t22 = n(p.k6) * sin_q_3.mul_add(sin_q_4, cos_q_3 * cos_q_4);
        let t23 = N::ONE / t15;
        let t24 = n(p.k5) * sin_q_2.mul_add(sin_q_5, cos_q_2 * cos_q_5);
        let t25 = t8.neg_mul_add(t17, t24);
        let t26 = t6 + t7;
        let t27 = sin_q_3 * t2;
        let t28 = t5 + t16;
        let t29 = cos_q_3 * t2;
        let t30 = sin_q_1 * n(p.l);
        let t31 = n(p.k5) * sin_q_3.mul_add(sin_q_5, cos_q_3 * cos_q_5);
        let t32 = sin_q_4 * t3;
        let t33 = sin_q_5 * t4;
        let t34 = t27 + t26;
        let t35 = cos_q_4 * t3;
        let t36 = t29 + t28;
        let t37 = cos_q_5 * t4;
        let t38 = n(p.k36) * t30;
        let t39 = n(p.k5) * sin_q_4.mul_add(sin_q_5, cos_q_4 * cos_q_5);
        let t40 = t32 + t34;
        let t41 = t35 + t36;
        let t42 = t23 * t19;
        let t43 = t23 * t21;
        let t44 = t23 * t25;
        let t45 = t8.neg_mul_add(t38, sin_q_2 * n(p.l));
        let t46 = t19.neg_mul_add(t42, t9.neg_mul_add(t13, n(p.k11)));
        let t47 = t19.neg_mul_add(t43, t9.neg_mul_add(t14, t22));
        let t48 = t19.neg_mul_add(t44, t9.neg_mul_add(t17, t31));
        let t49 = n(p.l).mul_add(t41, n(p.k0) * t37);
        let t50 = N::ONE / t46;
        let t51 = n(p.l).mul_add(t36, n(p.k0) * t35);
        let t52 = t23 * t45;
        let t53 = cos_q_1 * n(p.l);
        let t54 = n(p.g) - n(p.l).mul_add(t40, t33 * n(p.k0));
        let t55 = n(p.g) - n(p.l).mul_add(t34, n(p.k0) * t32);
        let t56 = t49 + t51;
        let t57 = n(p.l).mul_add(t28, n(p.k0) * t29);
        let t58 = t9.neg_mul_add(t38, sin_q_3 * n(p.l));
        let t59 = t19.neg_mul_add(t52, t58);
        let t60 = n(p.k36) * t53;
        let t61 = t54 + t55;
        let t62 = n(p.g) - n(p.l).mul_add(t26, n(p.k0) * t27);
        let t63 = n(p.k0).mul_add(t5, n(p.l) * t16);
        let t64 = t50 * t47;
        let t65 = t50 * t48;
        let t66 = t50 * t59;
        let t67 = t10.neg_mul_add(t38, sin_q_4 * n(p.l));
        let t68 = t8.neg_mul_add(t60, cos_q_2 * n(p.l));
        let t69 = t21.neg_mul_add(t43, t10.neg_mul_add(t14, n(p.k12)));
        let t70 = t47.neg_mul_add(t64, t69);
        let t71 = t21.neg_mul_add(t44, t10.neg_mul_add(t17, t39));
        let t72 = t47.neg_mul_add(t65, t71);
        let t73 = t25.neg_mul_add(t44, t12.neg_mul_add(t17, n(p.k13)));
        let t74 = n(p.g) - n(p.k0).mul_add(t6, n(p.l) * t7);
        let t75 = n(p.m) * (t56 + t57);
        let t76 = N::ONE / t70;
        let t77 = t47.neg_mul_add(t66, t21.neg_mul_add(t52, t67));
        let t78 = t12.neg_mul_add(t38, sin_q_5 * n(p.l));
        let t79 = t23 * t68;
        let t80 = n(p.m) * (t61 + t62);
        let t81 = n(p.k14) * n(p.k0).neg_mul_add(t7, n(p.g));
        let t82 = t9.neg_mul_add(t60, cos_q_3 * n(p.l));
        let t83 = t19.neg_mul_add(t79, t82);
        let t84 = t76 * t72;
        let t85 = t76 * t77;
        let t86 = t72.neg_mul_add(t84, t48.neg_mul_add(t65, t73));
        let t87 = t48.neg_mul_add(t66, t25.neg_mul_add(t52, t78));
        let t88 = t72.neg_mul_add(t85, t87);
        let t89 = t50 * t83;
        let t90 = t10.neg_mul_add(t60, cos_q_4 * n(p.l));
        let t91 = sin_q_1 * (t75 + n(p.m).mul_add(t63, t16 * n(p.k15)));
        let t92 = sin_q_4 * t49.mul_add(n(p.m), n(p.k14) * t51);
        let t93 = sin_q_2 * n(p.k14).mul_add(t63, t75);
        let t94 = N::ONE / t86;
        let t95 = sin_q_3 * n(p.m).mul_add(t56, n(p.k14) * t57);
        let t96 = t59.mul_add(t66, t45.mul_add(t52, t30 * t38));
        let t97 = t47.neg_mul_add(t89, t21.neg_mul_add(t79, t90));
        let t98 = t12.neg_mul_add(t60, cos_q_5 * n(p.l));
        let t99 = cos_q_1.mul_add(t80 + n(p.m).mul_add(t74, t81), t91);
        let t100 = n(p.l) * t99;
        let t101 = cos_q_4.mul_add(t54.mul_add(n(p.m), n(p.k14) * t55), t92);
        let t102 = cos_q_3.mul_add(n(p.m).mul_add(t61, n(p.k14) * t62), t95);
        let t103 = t76 * t97;
        let t104 = n(p.l) * cos_q_2.mul_add(n(p.k14).mul_add(t74, t80), t93);
        let t105 = t11.mul_sub(t100, t104);
        let t106 = cos_q_5.mul_add(t54, sin_q_5 * t49) * n(p.k16);
        let t107 = t48.neg_mul_add(t89, t25.neg_mul_add(t79, t98));
        let t108 = t72.neg_mul_add(t103, t107);
        let t109 = t94 * t88;
        let t110 = t42.neg_mul_add(t105, t13.mul_sub(t100, n(p.l) * t102));
        let t111 = t38.neg_mul_add(t100, n(p.l) * (t37 + t41));
        let t112 = t60.mul_add(t100, n(p.l) * (t33 + t40));
        let t113 = t88.mul_add(t109, t77.mul_add(t85, t96));
        let t114 = t94 * t108;
        let t115 = t59.mul_add(t89, t45.mul_add(t79, t30 * t60));
        let t116 = t43.neg_mul_add(t105, t14.mul_sub(t100, n(p.l) * t101));
        let t117 = t64.neg_mul_add(t110, t116);
        let t118 = t44.neg_mul_add(t105, t17.mul_sub(t100, t106));
        let t119 = N::ONE / t113;
        let t120 = t88.mul_add(t114, t77.mul_add(t103, t115));
        let t121 = t84.neg_mul_add(t117, t65.neg_mul_add(t110, t118));
        let t122 = t66.mul_add(t110, t52.mul_add(t105, t111));
        let t123 = t89.neg_mul_add(t110, t79.neg_mul_add(t105, t112));
        let t124 = t109.mul_add(t121, t85.mul_add(t117, t122));
        let t125 = t108.mul_add(t114, t68.mul_add(t79, t53 * t60));
        let t126 = t125 + t97.mul_add(t103, t83 * t89);
        let t127 = t119 * t120;
        let t128 = t114.neg_mul_add(t121, t103.neg_mul_add(t117, t123));
        let t129 = t120.neg_mul_add(t127, t126);
        let lambda2 = t127.mul_add(t124, t128) / t129;
        let lambda1 = t127.mul_add(lambda2, t119 * t124);
        let sound = n(p.k9).exceeds(N::from_f64(6.217248937900877e-15) * n(p.k9))
            & t15.exceeds(N::from_f64(6.217248937900877e-15) * n(p.k10))
            & t46.exceeds(N::from_f64(6.217248937900877e-15) * n(p.k11))
            & t70.exceeds(N::from_f64(6.217248937900877e-15) * n(p.k12))
            & t86.exceeds(N::from_f64(6.217248937900877e-15) * n(p.k13))
            & t113.exceeds(N::from_f64(6.217248937900877e-15) * t113)
            & t129.exceeds(N::from_f64(6.217248937900877e-15) * t126)
            & lambda1.is_finite();
        if !sound {
            check(n(p.k9), n(p.k9), 6.217248937900877e-15, 0)?;
            check(t15, n(p.k10), 6.217248937900877e-15, 1)?;
            check(t46, n(p.k11), 6.217248937900877e-15, 2)?;
            check(t70, n(p.k12), 6.217248937900877e-15, 3)?;
            check(t86, n(p.k13), 6.217248937900877e-15, 4)?;
            check(t113, t113, 6.217248937900877e-15, 5)?;
            check(t129, t126, 6.217248937900877e-15, 6)?;
        }
        let multipliers = [lambda1.store(), lambda2.store()];
        Ok(multipliers)
    }
}

/// Kinetic energy `T`, in J.
///
/// ```text
/// T = …
/// ```
pub fn kinetic_energy<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 5],
    v: &[S; 5],
) -> S {
    let q_1 = q[0];
    let q_2 = q[1];
    let q_3 = q[2];
    let q_4 = q[3];
    let q_5 = q[4];
    let q_1_dot = v[0];
    let q_2_dot = v[1];
    let q_3_dot = v[2];
    let q_4_dot = v[3];
    let q_5_dot = v[4];
    let (sin_q_2, cos_q_2) = q_2.sin_cos();
    let (sin_q_1, cos_q_1) = q_1.sin_cos();
    let (sin_q_3, cos_q_3) = q_3.sin_cos();
    let (sin_q_4, cos_q_4) = q_4.sin_cos();
    let (sin_q_5, cos_q_5) = q_5.sin_cos();
    let t0 = p.l * q_1_dot;
    let t1 = p.k0 * q_5_dot;
    let t2 = sin_q_2 * q_2_dot;
    let t3 = sin_q_3 * q_3_dot;
    let t4 = cos_q_2 * q_2_dot;
    let t5 = cos_q_3 * q_3_dot;
    let t6 = sin_q_4 * q_4_dot;
    let t7 = cos_q_4 * q_4_dot;
    let t8 = t2 + sin_q_1 * q_1_dot;
    let t9 = p.k0 * t2 + sin_q_1 * t0;
    let t10 = t4 + cos_q_1 * q_1_dot;
    let t11 = p.k0 * t4 + cos_q_1 * t0;
    let t12 = t3 + t8;
    let t13 = p.k0 * t3 + p.l * t8;
    let t14 = t5 + t10;
    let t15 = p.k0 * t5 + p.l * t10;
    let t16 = p.k0 * t6 + p.l * t12;
    let t17 = p.k0 * t7 + p.l * t14;
    let t18 = t1 * sin_q_5 + p.l * (t6 + t12);
    let t19 = t1 * cos_q_5 + p.l * (t7 + t14);
    let t20 = p.m * (t11 * t11 + t9 * t9) + q_2_dot * (q_2_dot * p.J);
    let t21 = p.m * (t15 * t15 + t13 * t13) + q_3_dot * (q_3_dot * p.J);
    let t22 = S::from_f64(0.5) * t20 + q_1_dot * (q_1_dot * p.k4);
    let t23 = p.m * (t17 * t17 + t16 * t16) + q_4_dot * (q_4_dot * p.J);
    let t24 = p.m * (t19 * t19 + t18 * t18) + q_5_dot * (q_5_dot * p.J);
    let t25 = S::from_f64(0.5) * t23 + (S::from_f64(0.5) * t21 + t22);
    S::from_f64(0.5) * t24 + t25
}

/// Potential energy `V`, in J.
///
/// ```text
/// V = 9/2*l*m*g*sin(q[1]) + 7/2*l*m*g*sin(q[2]) + 5/2*l*m*g*sin(q[3]) + 3/2*l*m*g*sin(q[4])
///     + 1/2*l*m*g*sin(q[5])
/// ```
pub fn potential_energy<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 5]) -> S {
    let q_1 = q[0];
    let q_2 = q[1];
    let q_3 = q[2];
    let q_4 = q[3];
    let q_5 = q[4];
    let sin_q_3 = q_3.sin();
    let sin_q_2 = q_2.sin();
    let sin_q_1 = q_1.sin();
    let sin_q_4 = q_4.sin();
    let sin_q_5 = q_5.sin();
    let t0 = sin_q_2 + sin_q_1;
    let t1 = sin_q_3 + t0;
    let t2 = p.k0 * sin_q_3 + p.l * t0 + (p.k0 * sin_q_2 + p.l * sin_q_1);
    let t3 = p.k0 * sin_q_5 + p.l * (sin_q_4 + t1) + (p.k0 * sin_q_4 + p.l * t1 + t2);
    t3 * p.k1 + sin_q_1 * p.k2
}

/// Names and units.
const PARAMETERS: [(&str, &str); 5] = [
    ("l", "m"),
    ("m", "kg"),
    ("J", "kg*m^2"),
    ("d", "m"),
    ("g", "m/s^2"),
];

/// Names and units.
const COORDINATES: [(&str, &str); 5] = [
    ("q[1]", "rad"),
    ("q[2]", "rad"),
    ("q[3]", "rad"),
    ("q[4]", "rad"),
    ("q[5]", "rad"),
];

/// Names and units.
const INPUTS: [(&str, &str); 0] = [];

/// Names and units.
const OUTPUTS: [(&str, &str); 0] = [];

/// Names, units, units of multipliers, whether positions are constrained.
const CONSTRAINTS: [(&str, &str, &str, bool); 2] =
    [("along", "m", "N", true), ("across", "m", "N", true)];

impl ::lagrangian::emitted::Machine for ClosedPendulum {
    type System = Prepared;

    fn name(&self) -> &str {
        "ClosedPendulum"
    }

    fn parameters(
        &self,
    ) -> impl ExactSizeIterator<Item = (::lagrangian::emitted::Quantity<'_>, f64)> {
        let values = [self.l, self.m, self.J, self.d, self.g];
        quantities(&PARAMETERS, values)
    }

    fn parameter_mut(&mut self, index: usize) -> Option<&mut f64> {
        match index {
            0 => Some(&mut self.l),
            1 => Some(&mut self.m),
            2 => Some(&mut self.J),
            3 => Some(&mut self.d),
            4 => Some(&mut self.g),
            _ => None,
        }
    }

    fn prepare(&self) -> Prepared {
        Self::prepare(self)
    }

    fn start(&self) -> ::lagrangian::emitted::State<Coordinates> {
        Self::start(self)
    }
}

impl ::lagrangian::emitted::System for Prepared {
    type Vector = [f64; 5];
    type Matrix = [f64; 25];
    type Coordinates = Coordinates;
    type Inputs = Inputs;
    type Outputs = Outputs;
    const MAY_SLIDE: bool = false;
    const MAY_COLLIDE: bool = false;

    fn coordinates(&self) -> impl ExactSizeIterator<Item = ::lagrangian::emitted::Quantity<'_>> {
        COORDINATES.iter().map(quantity)
    }

    fn to_coordinates(&self, vector: &[f64; 5]) -> Coordinates {
        Coordinates::from_array(*vector)
    }

    fn to_vector(&self, coordinates: &Coordinates) -> [f64; 5] {
        coordinates.to_array()
    }

    fn accelerations(
        &self,
        _: f64,
        q: &[f64; 5],
        v: &[f64; 5],
        _: &Inputs,
        result: &mut [f64; 5],
    ) -> Result<(), ::lagrangian::emitted::Singular> {
        <f64 as ::lagrangian::emitted::Number>::run_in_place(
            Accelerations { p: self, q, v },
            result,
        )
    }

    fn mass_matrix(&self, _: f64, q: &[f64; 5], matrix: &mut [f64; 25]) {
        let rows = mass_matrix(self, q);
        for (to, from) in matrix.iter_mut().zip(rows.as_flattened()) {
            *to = *from;
        }
    }

    fn bias(&self, _: f64, q: &[f64; 5], v: &[f64; 5], result: &mut [f64; 5]) {
        *result = bias(self, q, v);
    }

    fn applied(&self, _: f64, q: &[f64; 5], _: &[f64; 5], _: &Inputs, result: &mut [f64; 5]) {
        *result = applied(self, q);
    }

    fn forces(&self, _: f64, q: &[f64; 5], v: &[f64; 5], _: &Inputs, result: &mut [f64; 5]) {
        *result = forces(self, q, v);
    }

    fn constraint_positions(&self, _: f64, q: &[f64; 5], to: &mut [f64]) {
        fill(to, &constraint_positions(self, q));
    }

    fn constraint_rates(&self, _: f64, q: &[f64; 5], v: &[f64; 5], to: &mut [f64]) {
        fill(to, &constraint_rates(self, q, v));
    }

    fn constraint_matrix(&self, _: f64, q: &[f64; 5], to: &mut [f64]) {
        fill(to, &constraint_matrix(self, q));
    }

    fn constraint_drift(&self, _: f64, q: &[f64; 5], v: &[f64; 5], to: &mut [f64]) {
        fill(to, &constraint_drift(self, q, v));
    }

    fn kinetic_energy(&self, _: f64, q: &[f64; 5], v: &[f64; 5]) -> f64 {
        kinetic_energy(self, q, v)
    }

    fn potential_energy(&self, _: f64, q: &[f64; 5], _: &Inputs) -> f64 {
        potential_energy(self, q)
    }

    fn dissipation(&self, _: f64, _: &[f64; 5], _: &[f64; 5], _: &Inputs) -> f64 {
        0.0
    }

    fn work_rate(&self, _: f64, _: &[f64; 5], _: &[f64; 5], _: &[f64; 5], _: &Inputs) -> f64 {
        0.0
    }

    fn dissipation_rate(&self, _: f64, _: &[f64; 5], _: &[f64; 5], _: &Inputs) -> f64 {
        0.0
    }

    fn default_inputs(&self) -> Inputs {
        Inputs::default()
    }

    fn input_values(
        &self,
        _: &Inputs,
    ) -> impl ExactSizeIterator<Item = (::lagrangian::emitted::Quantity<'_>, f64)> {
        let values = [];
        quantities(&INPUTS, values)
    }

    fn output_values(
        &self,
        _: &Outputs,
    ) -> impl ExactSizeIterator<Item = (::lagrangian::emitted::Quantity<'_>, f64)> {
        let values = [];
        quantities(&OUTPUTS, values)
    }

    fn outputs(&self, _: f64, _: &[f64; 5], _: &[f64; 5], _: &[f64; 5], _: &Inputs) -> Outputs {
        Outputs {}
    }

    fn assumptions(
        &self,
        _: f64,
        _: &[f64; 5],
        _: &[f64; 5],
        _: &Inputs,
    ) -> impl ExactSizeIterator<Item = ::lagrangian::emitted::Assumption<'_>> {
        ::core::iter::empty()
    }

    fn constraints(&self) -> impl ExactSizeIterator<Item = ::lagrangian::emitted::Constraint<'_>> {
        CONSTRAINTS.iter().map(constraint)
    }

    fn multipliers(
        &self,
        _: f64,
        q: &[f64; 5],
        v: &[f64; 5],
        _: &Inputs,
        to: &mut [f64],
    ) -> Result<(), ::lagrangian::emitted::Singular> {
        fill(to, &multipliers(self, q, v)?);
        Ok(())
    }

    fn with_workspace<R>(&self, length: usize, work: impl FnOnce(Option<&mut [f64]>) -> R) -> R {
        let mut room = [0.0; ::lagrangian::emitted::constraint_workspace(5, 2)];
        work(room.get_mut(..length))
    }
}

impl<const N: usize> ::lagrangian::emitted::Batched<N> for Prepared
where
    ::lagrangian::emitted::Lanes<N>: ::lagrangian::emitted::Number,
{
    type Batch = Prepared<::lagrangian::emitted::Lanes<N>>;
    type Vectors = [::lagrangian::emitted::Lanes<N>; 5];
    type BatchInputs = Inputs;

    fn batch(systems: [&Self; N]) -> Self::Batch {
        let lanes = |number: fn(&Self) -> f64| ::lagrangian::emitted::Lanes(systems.map(number));
        Prepared {
            l: lanes(|p| p.l),
            m: lanes(|p| p.m),
            J: lanes(|p| p.J),
            d: lanes(|p| p.d),
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

    fn batch_inputs(_: [&Inputs; N]) -> Self::BatchInputs {
        Inputs {}
    }

    fn inputs_of_lane(_: &Self::BatchInputs, _: usize) -> Inputs {
        Inputs {}
    }

    fn is_singular(&self) -> bool {
        self.singular.is_some()
    }

    fn batch_accelerations(
        p: &Self::Batch,
        _: ::lagrangian::emitted::Lanes<N>,
        q: &Self::Vectors,
        v: &Self::Vectors,
        _: &Self::BatchInputs,
        result: &mut Self::Vectors,
    ) -> Result<(), ::lagrangian::emitted::Singular> {
        <::lagrangian::emitted::Lanes<N> as ::lagrangian::emitted::Number>::run_in_place(
            Accelerations { p, q, v },
            result,
        )
    }
}

/// A name with its unit.
fn quantity<'a>(&(name, unit): &'a (&'a str, &'a str)) -> ::lagrangian::emitted::Quantity<'a> {
    ::lagrangian::emitted::Quantity { name, unit }
}

/// Names and units beside values.
fn quantities<'a, const N: usize>(
    names: &'a [(&'a str, &'a str); N],
    values: [f64; N],
) -> impl ExactSizeIterator<Item = (::lagrangian::emitted::Quantity<'a>, f64)> {
    names.iter().map(quantity).zip(values)
}

/// A constraint, as it is called.
fn constraint<'a>(
    &(name, unit, multiplier_unit, holonomic): &'a (&'a str, &'a str, &'a str, bool),
) -> ::lagrangian::emitted::Constraint<'a> {
    ::lagrangian::emitted::Constraint {
        name,
        unit,
        multiplier_unit,
        holonomic,
    }
}

/// Writes numbers where there is room for them.
fn fill(to: &mut [f64], from: &[f64]) {
    for (to, from) in to.iter_mut().zip(from) {
        *to = *from;
    }
}

/// Refuses a pivot of which elimination has left nothing but rounding errors of a diagonal element,
/// in any of several lanes.
#[inline(always)]
fn check<N: ::lagrangian::emitted::Scalar>(
    pivot: N,
    diagonal: N,
    share: f64,
    coordinate: usize,
) -> Result<(), ::lagrangian::emitted::Singular> {
    let bound = N::from_f64(share) * diagonal;
    match pivot.exceeds(bound) {
        true => Ok(()),
        false => Err(singular(coordinate, pivot, diagonal)),
    }
}

/// Whether elimination has left nothing but rounding errors of a diagonal element; so too if it is
/// no number.
fn vanishes<S: ::lagrangian::emitted::Scalar>(pivot: S, diagonal: S, share: f64) -> bool {
    let bound = S::from_f64(share) * diagonal;
    !pivot.exceeds(bound)
}

/// The share of a pivot that is no rounding, for the message.
#[cold]
fn singular<S: ::lagrangian::emitted::Scalar>(
    coordinate: usize,
    pivot: S,
    diagonal: S,
) -> ::lagrangian::emitted::Singular {
    let [pivot, diagonal] = [pivot, diagonal].map(|x| x.to_f64());
    if let Some(constraint) = coordinate.checked_sub(5) {
        return ::lagrangian::emitted::Singular::constraint(constraint, pivot, diagonal);
    }
    ::lagrangian::emitted::Singular::new(coordinate, pivot, diagonal)
}
