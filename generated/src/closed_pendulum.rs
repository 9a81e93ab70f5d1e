// @generated from machines/closed_pendulum.machine by `cargo xtask generate`; edits are lost.

//! Five equal uniform bars that hang in a row between two pins, d apart on one level. Angles are
//! absolute, from the line through the pins; two constraints leave three degrees of freedom.
//!
//! 5 coordinates, 5 parameters. Arithmetic of one call:
//!
//! | function | mul | add | div | sin cos | other | temporaries |
//! | --- | --: | --: | --: | --: | --: | --: |
//! | `prepare` | 24 | 12 | 1 | 0 | 0 | 37 |
//! | `start` | 2 | 2 | 0 | 0 | 0 | 4 |
//! | `mass_matrix` | 30 | 10 | 0 | 5 | 0 | 50 |
//! | `bias` | 42 | 27 | 0 | 5 | 0 | 79 |
//! | `applied` | 5 | 0 | 0 | 5 | 0 | 10 |
//! | `forces` | 44 | 38 | 0 | 5 | 0 | 92 |
//! | `constraint_positions` | 2 | 9 | 0 | 5 | 0 | 21 |
//! | `constraint_rates` | 12 | 8 | 0 | 5 | 0 | 30 |
//! | `constraint_matrix` | 10 | 0 | 0 | 5 | 0 | 20 |
//! | `constraint_drift` | 17 | 8 | 0 | 5 | 0 | 35 |
//! | `accelerations` | 230 | 146 | 6 | 5 | 0 | 392 |
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
    /// Length and mass of a bar, inertia about its middle, distance of the pins. Unit: m. Default:
    /// 1.
    pub l: S,
    /// `m`. Unit: kg. Default: 1.
    pub m: S,
    /// `J`. Unit: kg*m^2. Default: 1/12.
    pub J: S,
    /// `d`. Unit: m. Default: 2.
    pub d: S,
    /// `g`. Unit: m/s^2. Default: 9.81.
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
    /// The same over other numbers.
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

impl<S: ::lagrangian::Scalar> ClosedPendulum<S> {
    /// Computes what depends on the parameters alone, once.
    pub fn prepare(&self) -> Prepared<S> {
        let t0 = self.l * self.m;
        let t1 = self.l * t0;
        let t2 = self.g * t0;
        let k8 = self.J + t1 * S::from_f64(4.25);
        let k2 = S::from_f64(0.5) * t2;
        let k16 = t2 * S::from_f64(1.5);
        let k17 = t2 * S::from_f64(2.5);
        let k18 = t2 * S::from_f64(3.5);
        let k19 = t2 * S::from_f64(4.5);
        let k0 = self.l * S::from_f64(0.5);
        let k1 = self.m * self.g;
        let k3 = S::from_f64(0.125) * (self.J * S::from_f64(4.0) + t1);
        let k4 = S::from_f64(0.5) * t1;
        let k5 = t1 * S::from_f64(1.5);
        let k6 = t1 * S::from_f64(2.5);
        let k7 = t1 * S::from_f64(3.5);
        let k9 = self.J + t1 * S::from_f64(3.25);
        let k10 = self.J + t1 * S::from_f64(2.25);
        let k11 = self.J + t1 * S::from_f64(1.25);
        let k12 = self.J + t1 * S::from_f64(0.25);
        let k13 = self.m * S::from_f64(0.5);
        let k14 = t0 * S::from_f64(0.25);
        let k15 = S::from_f64(0.5) * t0;
        let k20 = -self.l;
        let k21 = -k19;
        let k22 = -k18;
        let k23 = -k17;
        let k24 = -k16;
        let k25 = -k2;
        let k26 = S::ONE / k8;
        let singular = if vanishes(k8, k8, 6.217248937900877e-15) {
            Some(singular(0, k8, k8))
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
            singular,
        }
    }

    /// The start values of the description, at rest and `t = 0`.
    pub fn start(&self) -> ::lagrangian::State<Coordinates<S>> {
        let q_5 = S::pi() * S::from_f64(0.5);
        let q_4 = S::pi() * S::from_ratio(1, 3);
        let q_1 = -q_5;
        let zero = S::ZERO;
        let q_3 = -q_4;
        let q = [q_1, zero, q_3, q_4, q_5];
        let v = [S::ZERO; 5];
        ::lagrangian::State {
            t: 0.0,
            q: Coordinates::from_array(q),
            v: Coordinates::from_array(v),
        }
    }
}

/// The coordinates of [`ClosedPendulum`], or their rates, by name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coordinates<S = f64> {
    /// `q`. Unit: rad. Members: `q[1]` to `q[5]`.
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

    /// The same over other numbers.
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
    /// `J + 4.25*l^2*m`
    k8: S,
    /// `J + 3.25*l^2*m`
    k9: S,
    /// `J + 2.25*l^2*m`
    k10: S,
    /// `J + 1.25*l^2*m`
    k11: S,
    /// `J + 0.25*l^2*m`
    k12: S,
    /// `0.5*m`
    k13: S,
    /// `0.25*l*m`
    k14: S,
    /// `0.5*l*m`
    k15: S,
    /// `1.5*l*m*g`
    k16: S,
    /// `2.5*l*m*g`
    k17: S,
    /// `3.5*l*m*g`
    k18: S,
    /// `4.5*l*m*g`
    k19: S,
    /// `-l`
    k20: S,
    /// `-4.5*l*m*g`
    k21: S,
    /// `-3.5*l*m*g`
    k22: S,
    /// `-2.5*l*m*g`
    k23: S,
    /// `-1.5*l*m*g`
    k24: S,
    /// `-0.5*l*m*g`
    k25: S,
    /// `1/(J + 4.25*l^2*m)`
    k26: S,
    /// Why these parameters leave the machine without accelerations, if they do.
    singular: Option<::lagrangian::Singular>,
}

/// Mass matrix `M`, row by row.
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
pub fn mass_matrix<S: ::lagrangian::Scalar>(p: &Prepared<S>, q: &[S; 5]) -> [[S; 5]; 5] {
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
    let m21 = (sin_q_2 * sin_q_1 + cos_q_2 * cos_q_1) * p.k7;
    let m31 = p.k6 * (sin_q_1 * sin_q_3 + cos_q_1 * cos_q_3);
    let m32 = p.k6 * (sin_q_2 * sin_q_3 + cos_q_2 * cos_q_3);
    let m41 = p.k5 * (sin_q_1 * sin_q_4 + cos_q_1 * cos_q_4);
    let m42 = p.k5 * (sin_q_2 * sin_q_4 + cos_q_2 * cos_q_4);
    let m43 = p.k5 * (sin_q_3 * sin_q_4 + cos_q_3 * cos_q_4);
    let m51 = p.k4 * (sin_q_1 * sin_q_5 + cos_q_1 * cos_q_5);
    let m52 = p.k4 * (sin_q_2 * sin_q_5 + cos_q_2 * cos_q_5);
    let m53 = p.k4 * (sin_q_3 * sin_q_5 + cos_q_3 * cos_q_5);
    let m54 = p.k4 * (sin_q_4 * sin_q_5 + cos_q_4 * cos_q_5);
    [
        [p.k8, m21, m31, m41, m51],
        [m21, p.k9, m32, m42, m52],
        [m31, m32, p.k10, m43, m53],
        [m41, m42, m43, p.k11, m54],
        [m51, m52, m53, m54, p.k12],
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
pub fn bias<S: ::lagrangian::Scalar>(p: &Prepared<S>, q: &[S; 5], v: &[S; 5]) -> [S; 5] {
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
    let t4 = t0 * p.k5;
    let t5 = q_5_dot * (q_5_dot * p.k4);
    let t6 = t1 * sin_q_3;
    let t7 = t2 * sin_q_2;
    let t8 = sin_q_1 * t3;
    let t9 = t1 * cos_q_3;
    let t10 = t2 * cos_q_2;
    let t11 = cos_q_1 * t3;
    let t12 = p.k6 * t6;
    let t13 = t7 + t8;
    let t14 = t9 * p.k6;
    let t15 = t5 * sin_q_5 + t4 * sin_q_4;
    let t16 = t10 + t11;
    let t17 = t5 * cos_q_5 + t4 * cos_q_4;
    let t18 = cos_q_5 * (t13 + (t6 + t0 * sin_q_4));
    let t19 = sin_q_1 * (t17 + (t14 + t10 * p.k7));
    let t20 = sin_q_2 * (t17 + (t14 + p.k7 * t11));
    let t21 = p.k5 * (sin_q_4 * (t9 + t16) - cos_q_4 * (t6 + t13));
    let h_q_1 = t19 - cos_q_1 * (t15 + (t12 + p.k7 * t7));
    let h_q_2 = t20 - cos_q_2 * (t15 + (t12 + p.k7 * t8));
    let h_q_3 = sin_q_3 * (t17 + p.k6 * t16) - cos_q_3 * (t15 + p.k6 * t13);
    let h_q_4 = t5 * (cos_q_5 * sin_q_4 - sin_q_5 * cos_q_4) + t21;
    let h_q_5 = p.k4 * (sin_q_5 * (t16 + (t9 + t0 * cos_q_4)) - t18);
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
pub fn applied<S: ::lagrangian::Scalar>(p: &Prepared<S>, q: &[S; 5]) -> [S; 5] {
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
    let q_q_1 = p.k21 * cos_q_1;
    let q_q_2 = p.k22 * cos_q_2;
    let q_q_3 = p.k23 * cos_q_3;
    let q_q_4 = p.k24 * cos_q_4;
    let q_q_5 = p.k25 * cos_q_5;
    [q_q_1, q_q_2, q_q_3, q_q_4, q_q_5]
}

/// Right-hand side `f = Q - h` of `M a = f`.
pub fn forces<S: ::lagrangian::Scalar>(p: &Prepared<S>, q: &[S; 5], v: &[S; 5]) -> [S; 5] {
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
    let t4 = t0 * p.k5;
    let t5 = q_5_dot * (q_5_dot * p.k4);
    let t6 = t1 * sin_q_2;
    let t7 = t2 * sin_q_3;
    let t8 = t4 * sin_q_4;
    let t9 = sin_q_1 * t3;
    let t10 = t5 * sin_q_5;
    let t11 = t1 * cos_q_2;
    let t12 = t2 * cos_q_3;
    let t13 = p.k6 * t7;
    let t14 = cos_q_1 * t3;
    let t15 = t6 + t9;
    let t16 = t5 * cos_q_5 + t4 * cos_q_4;
    let t17 = t12 * p.k6;
    let t18 = t11 + t14;
    let t19 = sin_q_5 * (t18 + (t12 + t0 * cos_q_4));
    let t20 = cos_q_2 * (p.k18 - t8 - t13 - (t10 + p.k7 * t9));
    let t21 = t5 * (cos_q_5 * sin_q_4 - sin_q_5 * cos_q_4) + cos_q_4 * p.k16;
    let t22 = cos_q_1 * (t10 + p.k7 * t6 + (t13 + (t8 - p.k19)));
    let t23 = sin_q_3 * (t16 + p.k6 * t18) + cos_q_3 * (p.k17 - t8 - t10 - p.k6 * t15);
    let f_q_1 = t22 - sin_q_1 * (t16 + (t17 + t11 * p.k7));
    let f_q_2 = -(sin_q_2 * (t16 + (t17 + p.k7 * t14)) + t20);
    let f_q_3 = -t23;
    let f_q_4 = -(p.k5 * (sin_q_4 * (t12 + t18) - cos_q_4 * (t7 + t15)) + t21);
    let f_q_5 = -(p.k4 * (t19 - cos_q_5 * (t15 + (t7 + t0 * sin_q_4))) + cos_q_5 * p.k2);
    [f_q_1, f_q_2, f_q_3, f_q_4, f_q_5]
}

/// What is left of the constraints of positions, `g`; 0 for the others.
///
/// ```text
/// g[along] = l*cos(q[1]) + l*cos(q[2]) + l*cos(q[3]) + l*cos(q[4]) + l*cos(q[5]) - d
/// g[across] = l*sin(q[1]) + l*sin(q[2]) + l*sin(q[3]) + l*sin(q[4]) + l*sin(q[5])
/// ```
pub fn constraint_positions<S: ::lagrangian::Scalar>(p: &Prepared<S>, q: &[S; 5]) -> [S; 2] {
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

/// What is left of the constraints at the level of velocities, `G v + dg/dt`.
///
/// ```text
/// phi[along] = -l*sin(q[1])*der(q[1]) - l*sin(q[2])*der(q[2]) - l*sin(q[3])*der(q[3])
///     - l*sin(q[4])*der(q[4]) - l*sin(q[5])*der(q[5])
/// phi[across] = l*cos(q[1])*der(q[1]) + l*cos(q[2])*der(q[2]) + l*cos(q[3])*der(q[3])
///     + l*cos(q[4])*der(q[4]) + l*cos(q[5])*der(q[5])
/// ```
pub fn constraint_rates<S: ::lagrangian::Scalar>(
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
    let phi1 = p.k20 * (q_5_dot * sin_q_5 + (q_4_dot * sin_q_4 + t0));
    let phi2 = (q_5_dot * cos_q_5 + (q_4_dot * cos_q_4 + t1)) * p.l;
    [phi1, phi2]
}

/// The matrix `G` of the constraints, row after row.
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
pub fn constraint_matrix<S: ::lagrangian::Scalar>(p: &Prepared<S>, q: &[S; 5]) -> [S; 10] {
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
    let g1_1 = p.k20 * sin_q_1;
    let g1_2 = p.k20 * sin_q_2;
    let g1_3 = p.k20 * sin_q_3;
    let g1_4 = p.k20 * sin_q_4;
    let g1_5 = p.k20 * sin_q_5;
    let g2_1 = cos_q_1 * p.l;
    let g2_2 = cos_q_2 * p.l;
    let g2_3 = cos_q_3 * p.l;
    let g2_4 = cos_q_4 * p.l;
    let g2_5 = cos_q_5 * p.l;
    [g1_1, g1_2, g1_3, g1_4, g1_5, g2_1, g2_2, g2_3, g2_4, g2_5]
}

/// `gamma` of `G a = gamma`.
///
/// ```text
/// gamma[along] = l*cos(q[1])*der(q[1])^2 + l*cos(q[2])*der(q[2])^2 + l*cos(q[3])*der(q[3])^2
///     + l*cos(q[4])*der(q[4])^2 + l*cos(q[5])*der(q[5])^2
/// gamma[across] = l*sin(q[1])*der(q[1])^2 + l*sin(q[2])*der(q[2])^2 + l*sin(q[3])*der(q[3])^2
///     + l*sin(q[4])*der(q[4])^2 + l*sin(q[5])*der(q[5])^2
/// ```
pub fn constraint_drift<S: ::lagrangian::Scalar>(
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

/// Accelerations `a`, the solution of `M a = f + G^T lambda`, `G a = gamma` from the mass matrix.
///
/// What is known to be zero is not computed; a pivot that vanishes is an error.
pub fn accelerations<S: ::lagrangian::Number>(
    p: &Prepared<S>,
    q: &[S; 5],
    v: &[S; 5],
) -> Result<[S; 5], ::lagrangian::Singular> {
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

impl<S: Copy> ::lagrangian::scalar::Kernel<S> for Accelerations<'_, S> {
    type Output = Result<[S; 5], ::lagrangian::Singular>;

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
        let q_1_dot = n(v[0]);
        let q_2_dot = n(v[1]);
        let q_3_dot = n(v[2]);
        let q_4_dot = n(v[3]);
        let q_5_dot = n(v[4]);
        let angles = [q_1, q_2, q_3, q_4, q_5];
        let circular = N::sin_cos_all(angles);
        let (sin_q_1, cos_q_1) = circular[0];
        let (sin_q_2, cos_q_2) = circular[1];
        let (sin_q_3, cos_q_3) = circular[2];
        let (sin_q_4, cos_q_4) = circular[3];
        let (sin_q_5, cos_q_5) = circular[4];
        let t0 = q_2_dot * q_2_dot;
        let t1 = q_1_dot * q_1_dot;
        let t2 = q_3_dot * q_3_dot;
        let t3 = q_4_dot * q_4_dot;
        let t4 = q_5_dot * q_5_dot;
        let t5 = t0 * cos_q_2;
        let t6 = t0 * sin_q_2;
        let t7 = sin_q_1 * t1;
        let t8 = sin_q_1.mul_add(sin_q_2, cos_q_1 * cos_q_2) * n(p.k7);
        let t9 = n(p.k6) * sin_q_1.mul_add(sin_q_3, cos_q_1 * cos_q_3);
        let t10 = n(p.k5) * sin_q_1.mul_add(sin_q_4, cos_q_1 * cos_q_4);
        let t11 = n(p.k26) * t8;
        let t12 = n(p.k4) * sin_q_1.mul_add(sin_q_5, cos_q_1 * cos_q_5);
        let t13 = n(p.k26) * t9;
        let t14 = n(p.k26) * t10;
        let t15 = t8.neg_mul_add(t11, n(p.k9));
        let t16 = cos_q_1 * t1;
        let t17 = n(p.k26) * t12;
        let t18 = n(p.k6) * sin_q_3.mul_add(sin_q_2, cos_q_3 * cos_q_2);
        let t19 = t8.neg_mul_add(t13, t18);
        let t20 = n(p.k5) * sin_q_4.mul_add(sin_q_2, cos_q_4 * cos_q_2);
        let t21 = t8.neg_mul_add(t14, t20);
        let t22 = n(p.k5) * sin_q_4.mul_add(sin_q_3, cos_q_4 * cos_q_3);
        let t23 = N::ONE / t15;
        let t24 = n(p.k4) * sin_q_5.mul_add(sin_q_2, cos_q_5 * cos_q_2);
        let t25 = t8.neg_mul_add(t17, t24);
        let t26 = t6 + t7;
        let t27 = t2 * sin_q_3;
        let t28 = t5 + t16;
        let t29 = t2 * cos_q_3;
        let t30 = n(p.l) * sin_q_1;
        let t31 = n(p.k4) * sin_q_5.mul_add(sin_q_3, cos_q_5 * cos_q_3);
        let t32 = t3 * sin_q_4;
        let t33 = t4 * sin_q_5;
        let t34 = t27 + t26;
        let t35 = t3 * cos_q_4;
        let t36 = t29 + t28;
        let t37 = t4 * cos_q_5;
        let t38 = n(p.k26) * t30;
        let t39 = n(p.k4) * sin_q_5.mul_add(sin_q_4, cos_q_5 * cos_q_4);
        let t40 = t32 + t34;
        let t41 = t35 + t36;
        let t42 = t23 * t19;
        let t43 = t23 * t21;
        let t44 = t23 * t25;
        let t45 = t8.mul_sub(t38, n(p.l) * sin_q_2);
        let t46 = t19.neg_mul_add(t42, t9.neg_mul_add(t13, n(p.k10)));
        let t47 = t19.neg_mul_add(t43, t9.neg_mul_add(t14, t22));
        let t48 = t19.neg_mul_add(t44, t9.neg_mul_add(t17, t31));
        let t49 = n(p.l).mul_add(t41, n(p.k0) * t37);
        let t50 = N::ONE / t46;
        let t51 = n(p.l).mul_add(t36, n(p.k0) * t35);
        let t52 = t23 * t45;
        let t53 = n(p.l) * cos_q_1;
        let t54 = n(p.g) - n(p.l).mul_add(t40, t33 * n(p.k0));
        let t55 = n(p.g) - n(p.l).mul_add(t34, n(p.k0) * t32);
        let t56 = t49 + t51;
        let t57 = n(p.l).mul_add(t28, n(p.k0) * t29);
        let t58 = t19.neg_mul_add(t52, t9.mul_sub(t38, n(p.l) * sin_q_3));
        let t59 = n(p.k26) * t53;
        let t60 = t54 + t55;
        let t61 = n(p.g) - n(p.l).mul_add(t26, n(p.k0) * t27);
        let t62 = n(p.k0).mul_add(t5, n(p.l) * t16);
        let t63 = t50 * t47;
        let t64 = t50 * t48;
        let t65 = t50 * t58;
        let t66 = t8.neg_mul_add(t59, n(p.l) * cos_q_2);
        let t67 = t21.neg_mul_add(t43, t10.neg_mul_add(t14, n(p.k11)));
        let t68 = t47.neg_mul_add(t63, t67);
        let t69 = t21.neg_mul_add(t44, t10.neg_mul_add(t17, t39));
        let t70 = t47.neg_mul_add(t64, t69);
        let t71 = t25.neg_mul_add(t44, t12.neg_mul_add(t17, n(p.k12)));
        let t72 = n(p.g) - n(p.k0).mul_add(t6, n(p.l) * t7);
        let t73 = n(p.m) * (t56 + t57);
        let t74 = N::ONE / t68;
        let t75 = t21.neg_mul_add(t52, t10.mul_sub(t38, n(p.l) * sin_q_4));
        let t76 = t47.neg_mul_add(t65, t75);
        let t77 = t23 * t66;
        let t78 = n(p.m) * (t60 + t61);
        let t79 = n(p.k13) * n(p.k0).neg_mul_add(t7, n(p.g));
        let t80 = t25.neg_mul_add(t52, t12.mul_sub(t38, n(p.l) * sin_q_5));
        let t81 = t59.neg_mul_add(t9, n(p.l) * cos_q_3);
        let t82 = t77.neg_mul_add(t19, t81);
        let t83 = t74 * t70;
        let t84 = t74 * t76;
        let t85 = t70.neg_mul_add(t83, t48.neg_mul_add(t64, t71));
        let t86 = t70.neg_mul_add(t84, t48.neg_mul_add(t65, t80));
        let t87 = t50 * t82;
        let t88 = t59.neg_mul_add(t10, n(p.l) * cos_q_4);
        let t89 = sin_q_1 * (t73 + n(p.m).mul_add(t62, t16 * n(p.k14)));
        let t90 = sin_q_4 * n(p.m).mul_add(t49, n(p.k13) * t51);
        let t91 = sin_q_2 * n(p.k13).mul_add(t62, t73);
        let t92 = N::ONE / t85;
        let t93 = sin_q_3 * n(p.m).mul_add(t56, n(p.k13) * t57);
        let t94 = t58.mul_add(t65, t45.mul_add(t52, t30 * t38));
        let t95 = t47.neg_mul_add(t87, t77.neg_mul_add(t21, t88));
        let t96 = t59.neg_mul_add(t12, n(p.l) * cos_q_5);
        let t97 = cos_q_1.mul_add(t78 + n(p.m).mul_add(t72, t79), t89);
        let t98 = n(p.l) * t97;
        let t99 = cos_q_4.mul_add(n(p.m).mul_add(t54, t55 * n(p.k13)), t90);
        let t100 = cos_q_3.mul_add(n(p.m).mul_add(t60, t61 * n(p.k13)), t93);
        let t101 = t74 * t95;
        let t102 = n(p.l) * cos_q_2.mul_add(t72.mul_add(n(p.k13), t78), t91);
        let t103 = t98.mul_sub(t11, t102);
        let t104 = cos_q_5.mul_add(t54, sin_q_5 * t49) * n(p.k15);
        let t105 = t48.neg_mul_add(t87, t77.neg_mul_add(t25, t96));
        let t106 = t70.neg_mul_add(t101, t105);
        let t107 = t92 * t86;
        let t108 = t42.neg_mul_add(t103, t98.mul_sub(t13, n(p.l) * t100));
        let t109 = t98.neg_mul_add(t38, n(p.l) * (t37 + t41));
        let t110 = t98.mul_add(t59, n(p.l) * (t33 + t40));
        let t111 = t86.mul_add(t107, t76.mul_add(t84, t94));
        let t112 = t92 * t106;
        let t113 = t87.neg_mul_add(t58, t77.neg_mul_add(t45, t59 * t30));
        let t114 = t43.neg_mul_add(t103, t98.mul_sub(t14, n(p.l) * t99));
        let t115 = t63.neg_mul_add(t108, t114);
        let t116 = t44.neg_mul_add(t103, t98.mul_sub(t17, t104));
        let t117 = N::ONE / t111;
        let t118 = t112.neg_mul_add(t86, t101.neg_mul_add(t76, t113));
        let t119 = t83.neg_mul_add(t115, t64.neg_mul_add(t108, t116));
        let t120 = t65.neg_mul_add(t108, t52.neg_mul_add(t103, t109));
        let t121 = t87.neg_mul_add(t108, t77.neg_mul_add(t103, t110));
        let t122 = t107.neg_mul_add(t119, t84.neg_mul_add(t115, t120));
        let t123 = t106.mul_add(t112, t66.mul_add(t77, t53 * t59));
        let t124 = t123 + t95.mul_add(t101, t82 * t87);
        let t125 = t117 * t118;
        let t126 = t112.neg_mul_add(t119, t101.neg_mul_add(t115, t121));
        let t127 = t118.neg_mul_add(t125, t124);
        let t128 = t125.mul_add(t122, t126) / t127;
        let t129 = t125.mul_add(t128, t117 * t122);
        let q_5_ddot = t107.mul_add(t129, t112.mul_add(t128, t92 * t119));
        let t130 = t52.mul_add(t129, t77.mul_add(t128, t23 * t103));
        let t131 = t84.mul_add(t129, t101.mul_add(t128, t74 * t115));
        let q_4_ddot = t83.neg_mul_add(q_5_ddot, t131);
        let t132 = t65.mul_add(t129, t87.mul_add(t128, t50 * t108));
        let t133 = t38.mul_add(t129, t59.neg_mul_add(t128, t98 * n(p.k26)));
        let q_3_ddot = t63.neg_mul_add(q_4_ddot, t64.neg_mul_add(q_5_ddot, t132));
        let t134 = t43.neg_mul_add(q_4_ddot, t44.neg_mul_add(q_5_ddot, t130));
        let q_2_ddot = t42.neg_mul_add(q_3_ddot, t134);
        let t135 = t14.mul_add(q_4_ddot, t17.mul_add(q_5_ddot, t133));
        let q_1_ddot = -t11.mul_add(q_2_ddot, t13.mul_add(q_3_ddot, t135));
        let sound = t15.exceeds(N::from_f64(6.217248937900877e-15) * n(p.k9))
            & t46.exceeds(N::from_f64(6.217248937900877e-15) * n(p.k10))
            & t68.exceeds(N::from_f64(6.217248937900877e-15) * n(p.k11))
            & t85.exceeds(N::from_f64(6.217248937900877e-15) * n(p.k12))
            & t111.exceeds(N::from_f64(6.217248937900877e-15) * t111)
            & t127.exceeds(N::from_f64(6.217248937900877e-15) * t124)
            & q_1_ddot.is_finite();
        if !sound {
            check(t15, n(p.k9), 6.217248937900877e-15, 1)?;
            check(t46, n(p.k10), 6.217248937900877e-15, 2)?;
            check(t68, n(p.k11), 6.217248937900877e-15, 3)?;
            check(t85, n(p.k12), 6.217248937900877e-15, 4)?;
            check(t111, t111, 6.217248937900877e-15, 5)?;
            check(t127, t124, 6.217248937900877e-15, 6)?;
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
pub fn multipliers<S: ::lagrangian::Number>(
    p: &Prepared<S>,
    q: &[S; 5],
    v: &[S; 5],
) -> Result<[S; 2], ::lagrangian::Singular> {
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

impl<S: Copy> ::lagrangian::scalar::Kernel<S> for Multipliers<'_, S> {
    type Output = Result<[S; 2], ::lagrangian::Singular>;

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
        let t8 = sin_q_2.mul_add(sin_q_1, cos_q_2 * cos_q_1) * n(p.k7);
        let t9 = n(p.k6) * sin_q_1.mul_add(sin_q_3, cos_q_1 * cos_q_3);
        let t10 = n(p.k5) * sin_q_1.mul_add(sin_q_4, cos_q_1 * cos_q_4);
        let t11 = n(p.k26) * t8;
        let t12 = n(p.k4) * sin_q_1.mul_add(sin_q_5, cos_q_1 * cos_q_5);
        let t13 = n(p.k26) * t9;
        let t14 = n(p.k26) * t10;
        let t15 = t8.neg_mul_add(t11, n(p.k9));
        let t16 = cos_q_1 * t1;
        let t17 = n(p.k26) * t12;
        let t18 = n(p.k6) * sin_q_2.mul_add(sin_q_3, cos_q_2 * cos_q_3);
        let t19 = t8.neg_mul_add(t13, t18);
        let t20 = n(p.k5) * sin_q_2.mul_add(sin_q_4, cos_q_2 * cos_q_4);
        let t21 = t8.neg_mul_add(t14, t20);
        let t22 = n(p.k5) * sin_q_3.mul_add(sin_q_4, cos_q_3 * cos_q_4);
        let t23 = N::ONE / t15;
        let t24 = n(p.k4) * sin_q_2.mul_add(sin_q_5, cos_q_2 * cos_q_5);
        let t25 = t8.neg_mul_add(t17, t24);
        let t26 = t6 + t7;
        let t27 = sin_q_3 * t2;
        let t28 = t5 + t16;
        let t29 = cos_q_3 * t2;
        let t30 = sin_q_1 * n(p.l);
        let t31 = n(p.k4) * sin_q_3.mul_add(sin_q_5, cos_q_3 * cos_q_5);
        let t32 = sin_q_4 * t3;
        let t33 = sin_q_5 * t4;
        let t34 = t27 + t26;
        let t35 = cos_q_4 * t3;
        let t36 = t29 + t28;
        let t37 = cos_q_5 * t4;
        let t38 = n(p.k26) * t30;
        let t39 = n(p.k4) * sin_q_4.mul_add(sin_q_5, cos_q_4 * cos_q_5);
        let t40 = t32 + t34;
        let t41 = t35 + t36;
        let t42 = t23 * t19;
        let t43 = t23 * t21;
        let t44 = t23 * t25;
        let t45 = t8.mul_sub(t38, sin_q_2 * n(p.l));
        let t46 = t19.neg_mul_add(t42, t9.neg_mul_add(t13, n(p.k10)));
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
        let t58 = t19.neg_mul_add(t52, t9.mul_sub(t38, sin_q_3 * n(p.l)));
        let t59 = n(p.k26) * t53;
        let t60 = t54 + t55;
        let t61 = n(p.g) - n(p.l).mul_add(t26, n(p.k0) * t27);
        let t62 = n(p.k0).mul_add(t5, n(p.l) * t16);
        let t63 = t50 * t47;
        let t64 = t50 * t48;
        let t65 = t50 * t58;
        let t66 = t8.neg_mul_add(t59, cos_q_2 * n(p.l));
        let t67 = t21.neg_mul_add(t43, t10.neg_mul_add(t14, n(p.k11)));
        let t68 = t47.neg_mul_add(t63, t67);
        let t69 = t21.neg_mul_add(t44, t10.neg_mul_add(t17, t39));
        let t70 = t47.neg_mul_add(t64, t69);
        let t71 = t25.neg_mul_add(t44, t12.neg_mul_add(t17, n(p.k12)));
        let t72 = n(p.g) - n(p.k0).mul_add(t6, n(p.l) * t7);
        let t73 = n(p.m) * (t56 + t57);
        let t74 = N::ONE / t68;
        let t75 = t21.neg_mul_add(t52, t10.mul_sub(t38, sin_q_4 * n(p.l)));
        let t76 = t47.neg_mul_add(t65, t75);
        let t77 = t23 * t66;
        let t78 = n(p.m) * (t60 + t61);
        let t79 = n(p.k13) * n(p.k0).neg_mul_add(t7, n(p.g));
        let t80 = t25.neg_mul_add(t52, t12.mul_sub(t38, sin_q_5 * n(p.l)));
        let t81 = t9.neg_mul_add(t59, cos_q_3 * n(p.l));
        let t82 = t19.neg_mul_add(t77, t81);
        let t83 = t74 * t70;
        let t84 = t74 * t76;
        let t85 = t70.neg_mul_add(t83, t48.neg_mul_add(t64, t71));
        let t86 = t70.neg_mul_add(t84, t48.neg_mul_add(t65, t80));
        let t87 = t50 * t82;
        let t88 = t10.neg_mul_add(t59, cos_q_4 * n(p.l));
        let t89 = sin_q_1 * (t73 + n(p.m).mul_add(t62, t16 * n(p.k14)));
        let t90 = sin_q_4 * t49.mul_add(n(p.m), n(p.k13) * t51);
        let t91 = sin_q_2 * n(p.k13).mul_add(t62, t73);
        let t92 = N::ONE / t85;
        let t93 = sin_q_3 * n(p.m).mul_add(t56, n(p.k13) * t57);
        let t94 = t58.mul_add(t65, t45.mul_add(t52, t30 * t38));
        let t95 = t47.neg_mul_add(t87, t21.neg_mul_add(t77, t88));
        let t96 = t12.neg_mul_add(t59, cos_q_5 * n(p.l));
        let t97 = cos_q_1.mul_add(t78 + n(p.m).mul_add(t72, t79), t89);
        let t98 = n(p.l) * t97;
        let t99 = cos_q_4.mul_add(t54.mul_add(n(p.m), n(p.k13) * t55), t90);
        let t100 = cos_q_3.mul_add(n(p.m).mul_add(t60, n(p.k13) * t61), t93);
        let t101 = t74 * t95;
        let t102 = n(p.l) * cos_q_2.mul_add(n(p.k13).mul_add(t72, t78), t91);
        let t103 = t11.mul_sub(t98, t102);
        let t104 = cos_q_5.mul_add(t54, sin_q_5 * t49) * n(p.k15);
        let t105 = t48.neg_mul_add(t87, t25.neg_mul_add(t77, t96));
        let t106 = t70.neg_mul_add(t101, t105);
        let t107 = t92 * t86;
        let t108 = t42.neg_mul_add(t103, t13.mul_sub(t98, n(p.l) * t100));
        let t109 = t38.neg_mul_add(t98, n(p.l) * (t37 + t41));
        let t110 = t59.mul_add(t98, n(p.l) * (t33 + t40));
        let t111 = t86.mul_add(t107, t76.mul_add(t84, t94));
        let t112 = t92 * t106;
        let t113 = t58.neg_mul_add(t87, t45.neg_mul_add(t77, t30 * t59));
        let t114 = t43.neg_mul_add(t103, t14.mul_sub(t98, n(p.l) * t99));
        let t115 = t63.neg_mul_add(t108, t114);
        let t116 = t44.neg_mul_add(t103, t17.mul_sub(t98, t104));
        let t117 = N::ONE / t111;
        let t118 = t86.neg_mul_add(t112, t76.neg_mul_add(t101, t113));
        let t119 = t83.neg_mul_add(t115, t64.neg_mul_add(t108, t116));
        let t120 = t65.neg_mul_add(t108, t52.neg_mul_add(t103, t109));
        let t121 = t87.neg_mul_add(t108, t77.neg_mul_add(t103, t110));
        let t122 = t107.neg_mul_add(t119, t84.neg_mul_add(t115, t120));
        let t123 = t106.mul_add(t112, t66.mul_add(t77, t53 * t59));
        let t124 = t123 + t95.mul_add(t101, t82 * t87);
        let t125 = t117 * t118;
        let t126 = t112.neg_mul_add(t119, t101.neg_mul_add(t115, t121));
        let t127 = t118.neg_mul_add(t125, t124);
        let lambda2 = t125.mul_add(t122, t126) / t127;
        let lambda1 = t125.mul_add(lambda2, t117 * t122);
        let sound = t15.exceeds(N::from_f64(6.217248937900877e-15) * n(p.k9))
            & t46.exceeds(N::from_f64(6.217248937900877e-15) * n(p.k10))
            & t68.exceeds(N::from_f64(6.217248937900877e-15) * n(p.k11))
            & t85.exceeds(N::from_f64(6.217248937900877e-15) * n(p.k12))
            & t111.exceeds(N::from_f64(6.217248937900877e-15) * t111)
            & t127.exceeds(N::from_f64(6.217248937900877e-15) * t124)
            & lambda1.is_finite();
        if !sound {
            check(t15, n(p.k9), 6.217248937900877e-15, 1)?;
            check(t46, n(p.k10), 6.217248937900877e-15, 2)?;
            check(t68, n(p.k11), 6.217248937900877e-15, 3)?;
            check(t85, n(p.k12), 6.217248937900877e-15, 4)?;
            check(t111, t111, 6.217248937900877e-15, 5)?;
            check(t127, t124, 6.217248937900877e-15, 6)?;
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
pub fn kinetic_energy<S: ::lagrangian::Scalar>(p: &Prepared<S>, q: &[S; 5], v: &[S; 5]) -> S {
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
    let t22 = S::from_f64(0.5) * t20 + q_1_dot * (q_1_dot * p.k3);
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
pub fn potential_energy<S: ::lagrangian::Scalar>(p: &Prepared<S>, q: &[S; 5]) -> S {
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

impl ::lagrangian::Machine for ClosedPendulum {
    type System = Prepared;

    fn name(&self) -> &str {
        "ClosedPendulum"
    }

    fn parameters(&self) -> impl ExactSizeIterator<Item = (::lagrangian::Quantity<'_>, f64)> {
        let values = [self.l, self.m, self.J, self.d, self.g];
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
    type Vector = [f64; 5];
    type Matrix = [f64; 25];
    type Coordinates = Coordinates;
    type Inputs = Inputs;
    type Outputs = Outputs;

    fn coordinates(&self) -> impl ExactSizeIterator<Item = ::lagrangian::Quantity<'_>> {
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
    ) -> Result<(), ::lagrangian::Singular> {
        <f64 as ::lagrangian::Number>::run_in_place(Accelerations { p: self, q, v }, result)
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

    fn outputs(&self, _: f64, _: &[f64; 5], _: &[f64; 5], _: &[f64; 5], _: &Inputs) -> Outputs {
        Outputs {}
    }

    fn assumptions(
        &self,
        _: f64,
        _: &[f64; 5],
        _: &[f64; 5],
        _: &Inputs,
    ) -> impl ExactSizeIterator<Item = ::lagrangian::Assumption<'_>> {
        ::core::iter::empty()
    }

    fn constraints(&self) -> impl ExactSizeIterator<Item = ::lagrangian::Constraint<'_>> {
        CONSTRAINTS.iter().map(constraint)
    }

    fn residuals(
        &self,
        _: f64,
        q: &[f64; 5],
        v: &[f64; 5],
        positions: &mut [f64],
        rates: &mut [f64],
    ) {
        fill(positions, &constraint_positions(self, q));
        fill(rates, &constraint_rates(self, q, v));
    }

    fn constraint_matrix(&self, _: f64, q: &[f64; 5], rows: &mut [f64]) {
        fill(rows, &constraint_matrix(self, q));
    }

    fn constraint_drift(&self, _: f64, q: &[f64; 5], v: &[f64; 5], drift: &mut [f64]) {
        fill(drift, &constraint_drift(self, q, v));
    }

    fn multipliers(
        &self,
        _: f64,
        q: &[f64; 5],
        v: &[f64; 5],
        _: &Inputs,
        lambda: &mut [f64],
    ) -> Result<(), ::lagrangian::Singular> {
        fill(lambda, &multipliers(self, q, v)?);
        Ok(())
    }

    fn lend<R>(&self, length: usize, work: impl FnOnce(Option<&mut [f64]>) -> R) -> R {
        let mut room = [0.0; ::lagrangian::constraint_room(5, 2)];
        work(room.get_mut(..length))
    }
}

impl<const N: usize> ::lagrangian::Abreast<N> for Prepared
where
    ::lagrangian::Lanes<N>: ::lagrangian::Number,
{
    type Several = Prepared<::lagrangian::Lanes<N>>;
    type Vectors = [::lagrangian::Lanes<N>; 5];
    type SeveralInputs = Inputs;

    fn abreast(systems: [&Self; N]) -> Self::Several {
        let lanes = |number: fn(&Self) -> f64| ::lagrangian::Lanes(systems.map(number));
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

/// A constraint, as it is called.
fn constraint<'a>(
    &(name, unit, multiplier_unit, holonomic): &'a (&'a str, &'a str, &'a str, bool),
) -> ::lagrangian::Constraint<'a> {
    ::lagrangian::Constraint {
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
    if let Some(constraint) = coordinate.checked_sub(5) {
        return ::lagrangian::Singular::constraint(constraint, pivot.to_f64(), diagonal.to_f64());
    }
    ::lagrangian::Singular::new(coordinate, pivot.to_f64(), diagonal.to_f64())
}
