// @generated from machines/crusher9.machine by `cargo xtask generate`; edits are lost.

//! The crusher as benchmarks run it: one spring and damper pair for each direction, and radial
//! spring-dampers that keep the polar coordinates away from s = 0.
//!
//! 9 coordinates, 25 parameters. Arithmetic of one call:
//!
//! | function | mul | add | div | sin cos | other | temporaries |
//! | --- | --: | --: | --: | --: | --: | --: |
//! | `prepare` | 26 | 10 | 4 | 0 | 0 | 40 |
//! | `mass_matrix` | 28 | 6 | 0 | 3 | 0 | 40 |
//! | `bias` | 53 | 26 | 0 | 4 | 0 | 87 |
//! | `applied` | 16 | 15 | 0 | 0 | 0 | 31 |
//! | `forces` | 68 | 42 | 0 | 4 | 0 | 118 |
//! | `accelerations` | 89 | 55 | 2 | 4 | 0 | 154 |
//! | `kinetic_energy` | 41 | 26 | 0 | 4 | 0 | 75 |
//! | `potential_energy` | 10 | 7 | 0 | 0 | 0 | 17 |
//! | `dissipation` | 10 | 5 | 0 | 0 | 0 | 15 |
//! | `work_rate` | 18 | 11 | 0 | 2 | 0 | 33 |
//! | `dissipation_rate` | 10 | 5 | 0 | 0 | 0 | 15 |
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

/// The crusher as benchmarks run it: one spring and damper pair for each direction, and radial
/// spring-dampers that keep the polar coordinates away from s = 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crusher9<S = f64> {
    /// Mass and inertia of the platform. Unit: `kg`. Default: 450.
    pub m: S,
    /// `J`. Unit: `kg*m^2`. Default: 60.
    pub J: S,
    /// Mass of the debalance, its eccentricity, its axis on the platform, its speed. Unit: `kg`.
    /// Default: 25.
    pub m0: S,
    /// `e`. Unit: `m`. Default: 0.04.
    pub e: S,
    /// `x0`. Unit: `m`. Default: 0.1.
    pub x0: S,
    /// `y0`. Unit: `m`. Default: -0.25.
    pub y0: S,
    /// `w`. Unit: `rad/s`. Default: 100.
    pub w: S,
    /// Mass and inertia of the mortar, and of the pestle. Unit: `kg`. Default: 120.
    pub m1: S,
    /// `J1`. Unit: `kg*m^2`. Default: 2.4.
    pub J1: S,
    /// `m2`. Unit: `kg`. Default: 60.
    pub m2: S,
    /// `J2`. Unit: `kg*m^2`. Default: 0.5.
    pub J2: S,
    /// Springs of the platform and where they act. Unit: `N/m`. Default: 200000.
    pub cx: S,
    /// `cy`. Unit: `N/m`. Default: 160000.
    pub cy: S,
    /// `xc`. Unit: `m`. Default: 0.35.
    pub xc: S,
    /// `yc`. Unit: `m`. Default: -0.05.
    pub yc: S,
    /// Dampers of the platform and where they act. Unit: `N*s/m`. Default: 400.
    pub bx: S,
    /// `by`. Unit: `N*s/m`. Default: 350.
    pub by: S,
    /// `xb`. Unit: `m`. Default: 0.35.
    pub xb: S,
    /// `yb`. Unit: `m`. Default: 0.04.
    pub yb: S,
    /// Radial stiffness, damping and free distance of the mortar, and of the pestle. Unit: `N/m`.
    /// Default: 50000.
    pub k1: S,
    /// `d1`. Unit: `N*s/m`. Default: 60.
    pub d1: S,
    /// `r1`. Unit: `m`. Default: 0.15.
    pub r1: S,
    /// `k2`. Unit: `N/m`. Default: 20000.
    pub k2: S,
    /// `d2`. Unit: `N*s/m`. Default: 30.
    pub d2: S,
    /// `r2`. Unit: `m`. Default: 0.1.
    pub r2: S,
}

impl Default for Crusher9 {
    fn default() -> Self {
        Self {
            m: 450.0,
            J: 60.0,
            m0: 25.0,
            e: 0.04,
            x0: 0.1,
            y0: -0.25,
            w: 100.0,
            m1: 120.0,
            J1: 2.4,
            m2: 60.0,
            J2: 0.5,
            cx: 200000.0,
            cy: 160000.0,
            xc: 0.35,
            yc: -0.05,
            bx: 400.0,
            by: 350.0,
            xb: 0.35,
            yb: 0.04,
            k1: 50000.0,
            d1: 60.0,
            r1: 0.15,
            k2: 20000.0,
            d2: 30.0,
            r2: 0.1,
        }
    }
}

impl<S> Crusher9<S> {
    /// These values as other numbers.
    pub fn map<R>(self, f: impl Fn(S) -> R) -> Crusher9<R> {
        Crusher9 {
            m: f(self.m),
            J: f(self.J),
            m0: f(self.m0),
            e: f(self.e),
            x0: f(self.x0),
            y0: f(self.y0),
            w: f(self.w),
            m1: f(self.m1),
            J1: f(self.J1),
            m2: f(self.m2),
            J2: f(self.J2),
            cx: f(self.cx),
            cy: f(self.cy),
            xc: f(self.xc),
            yc: f(self.yc),
            bx: f(self.bx),
            by: f(self.by),
            xb: f(self.xb),
            yb: f(self.yb),
            k1: f(self.k1),
            d1: f(self.d1),
            r1: f(self.r1),
            k2: f(self.k2),
            d2: f(self.d2),
            r2: f(self.r2),
        }
    }
}

impl<S: ::lagrangian::Scalar> Crusher9<S> {
    /// Computes what depends on the parameters alone, once.
    pub fn prepare(&self) -> Prepared<S> {
        let pivot_1 = self.m + self.m0;
        let k13 = self.m0 * self.x0;
        let k12 = self.m0 * self.y0;
        let k0 = self.w * self.e;
        let k11 = self.m1 + self.m2;
        let k28 = S::ONE / pivot_1;
        let k14 = k11 + pivot_1;
        let k20 = self.J + (self.y0 * k12 + self.x0 * k13);
        let pivot_2 = k20 - k28 * (k12 * k12) - k28 * (k13 * k13);
        let k26 = S::ONE / pivot_2;
        let k1_ = self.cx * S::from_f64(0.5);
        let k2_ = self.cy * S::from_f64(0.5);
        let k3 = self.k1 * S::from_f64(0.5);
        let k4 = self.k2 * S::from_f64(0.5);
        let k5 = self.bx * S::from_f64(0.5);
        let k6 = self.by * S::from_f64(0.5);
        let k7 = self.d1 * S::from_f64(0.5);
        let k8 = self.d2 * S::from_f64(0.5);
        let k9 = self.w * k0;
        let k10 = self.m0 * S::from_f64(0.5);
        let k15 = self.by * self.xb;
        let k16 = self.bx * self.yb;
        let k17 = self.cy * self.xc;
        let k18 = self.cx * self.yc;
        let k19 = self.m0 * k0;
        let k21 = -k11;
        let k22 = -self.m2;
        let k23 = S::ONE / self.m2;
        let k24 = S::ONE / self.m1;
        let k25 = self.m0 * k28;
        let k27 = self.m0 * k26;
        let k29 = -k28;
        let singular = if vanishes(self.J1, self.J1, 7.993605777301127e-15) {
            Some(singular(5, self.J1, self.J1))
        } else if vanishes(self.J2, self.J2, 7.993605777301127e-15) {
            Some(singular(8, self.J2, self.J2))
        } else if vanishes(self.m2, self.m2, 7.993605777301127e-15) {
            Some(singular(6, self.m2, self.m2))
        } else if vanishes(self.m1, k11, 7.993605777301127e-15) {
            Some(singular(3, self.m1, k11))
        } else if vanishes(pivot_1, k14, 7.993605777301127e-15) {
            Some(singular(1, pivot_1, k14))
        } else if vanishes(pivot_1, k14, 7.993605777301127e-15) {
            Some(singular(0, pivot_1, k14))
        } else if vanishes(pivot_2, k20, 7.993605777301127e-15) {
            Some(singular(2, pivot_2, k20))
        } else {
            None
        };
        Prepared {
            m: self.m,
            J: self.J,
            m0: self.m0,
            x0: self.x0,
            y0: self.y0,
            w: self.w,
            m1: self.m1,
            J1: self.J1,
            m2: self.m2,
            J2: self.J2,
            cx: self.cx,
            cy: self.cy,
            xc: self.xc,
            yc: self.yc,
            bx: self.bx,
            by: self.by,
            xb: self.xb,
            yb: self.yb,
            k1: self.k1,
            d1: self.d1,
            r1: self.r1,
            k2: self.k2,
            d2: self.d2,
            r2: self.r2,
            k0,
            k1_,
            k2_,
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
            singular,
        }
    }

    /// The start values of the description, at rest and `t = 0`.
    pub fn start(&self) -> ::lagrangian::State<Coordinates<S>> {
        let zero = S::ZERO;
        let theta = S::from_ratio(1, 100);
        let s1 = S::from_ratio(4, 25);
        let phi1 = S::from_ratio(2, 5);
        let s2 = S::from_ratio(11, 100);
        let phi2 = S::from_ratio(13, 10);
        let q = [zero, zero, theta, s1, phi1, zero, s2, phi2, zero];
        let v = [S::ZERO; 9];
        ::lagrangian::State {
            t: 0.0,
            q: Coordinates::from_array(q),
            v: Coordinates::from_array(v),
        }
    }
}

/// The coordinates of [`Crusher9`], or their rates, by name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coordinates<S = f64> {
    /// `x`. Unit: `m`.
    pub x: S,
    /// `y`. Unit: `m`.
    pub y: S,
    /// `theta`. Unit: `rad`.
    pub theta: S,
    /// `s1`. Unit: `m`.
    pub s1: S,
    /// `phi1`. Unit: `rad`.
    pub phi1: S,
    /// `theta1`. Unit: `rad`.
    pub theta1: S,
    /// `s2`. Unit: `m`.
    pub s2: S,
    /// `phi2`. Unit: `rad`.
    pub phi2: S,
    /// `theta2`. Unit: `rad`.
    pub theta2: S,
}

impl<S: Copy> Coordinates<S> {
    /// The numbers in the order of the description: the order of `q` in every function here.
    pub fn to_array(self) -> [S; 9] {
        [
            self.x,
            self.y,
            self.theta,
            self.s1,
            self.phi1,
            self.theta1,
            self.s2,
            self.phi2,
            self.theta2,
        ]
    }

    /// Names for numbers in the order of the description.
    pub fn from_array(q: [S; 9]) -> Self {
        Self {
            x: q[0],
            y: q[1],
            theta: q[2],
            s1: q[3],
            phi1: q[4],
            theta1: q[5],
            s2: q[6],
            phi2: q[7],
            theta2: q[8],
        }
    }

    /// These values as other numbers.
    pub fn map<R>(self, f: impl Fn(S) -> R) -> Coordinates<R> {
        Coordinates {
            x: f(self.x),
            y: f(self.y),
            theta: f(self.theta),
            s1: f(self.s1),
            phi1: f(self.phi1),
            theta1: f(self.theta1),
            s2: f(self.s2),
            phi2: f(self.phi2),
            theta2: f(self.theta2),
        }
    }
}

/// What can be set while a [`Crusher9`] runs.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Inputs {}

/// What can be observed of a [`Crusher9`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Outputs {}

/// The parameters of a [`Crusher9`], with the work done that depends on them alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prepared<S = f64> {
    /// `m`
    m: S,
    /// `J`
    J: S,
    /// `m0`
    m0: S,
    /// `x0`
    x0: S,
    /// `y0`
    y0: S,
    /// `w`
    w: S,
    /// `m1`
    m1: S,
    /// `J1`
    J1: S,
    /// `m2`
    m2: S,
    /// `J2`
    J2: S,
    /// `cx`
    cx: S,
    /// `cy`
    cy: S,
    /// `xc`
    xc: S,
    /// `yc`
    yc: S,
    /// `bx`
    bx: S,
    /// `by`
    by: S,
    /// `xb`
    xb: S,
    /// `yb`
    yb: S,
    /// `k1`
    k1: S,
    /// `d1`
    d1: S,
    /// `r1`
    r1: S,
    /// `k2`
    k2: S,
    /// `d2`
    d2: S,
    /// `r2`
    r2: S,
    /// `e*w`
    k0: S,
    /// `0.5*cx`
    k1_: S,
    /// `0.5*cy`
    k2_: S,
    /// `0.5*k1`
    k3: S,
    /// `0.5*k2`
    k4: S,
    /// `0.5*bx`
    k5: S,
    /// `0.5*by`
    k6: S,
    /// `0.5*d1`
    k7: S,
    /// `0.5*d2`
    k8: S,
    /// `e*w^2`
    k9: S,
    /// `0.5*m0`
    k10: S,
    /// `m1 + m2`
    k11: S,
    /// `m0*y0`
    k12: S,
    /// `m0*x0`
    k13: S,
    /// `m + m0 + m1 + m2`
    k14: S,
    /// `by*xb`
    k15: S,
    /// `bx*yb`
    k16: S,
    /// `cy*xc`
    k17: S,
    /// `cx*yc`
    k18: S,
    /// `m0*e*w`
    k19: S,
    /// `J + m0*x0^2 + m0*y0^2`
    k20: S,
    /// `-(m1 + m2)`
    k21: S,
    /// `-m2`
    k22: S,
    /// `1/m2`
    k23: S,
    /// `1/m1`
    k24: S,
    /// `m0/(m + m0)`
    k25: S,
    /// `1/(J + m0*x0^2 + m0*y0^2 - m0^2*y0^2/(m + m0) - m0^2*x0^2/(m + m0))`
    k26: S,
    /// `m0/(J + m0*x0^2 + m0*y0^2 - m0^2*y0^2/(m + m0) - m0^2*x0^2/(m + m0))`
    k27: S,
    /// `1/(m + m0)`
    k28: S,
    /// `-1/(m + m0)`
    k29: S,
    /// Why these parameters leave the machine without accelerations, if they do.
    singular: Option<::lagrangian::Singular>,
}

/// Mass matrix `M`.
///
/// ```text
/// M[x, x] = m + m0 + m1 + m2
/// M[y, y] = m + m0 + m1 + m2
/// M[theta, x] = -m0*y0*cos(theta) - m0*x0*sin(theta)
/// M[theta, y] = m0*x0*cos(theta) - m0*y0*sin(theta)
/// M[theta, theta] = J + m0*x0^2 + m0*y0^2
/// M[s1, x] = (m1 + m2)*cos(phi1)
/// M[s1, y] = (m1 + m2)*sin(phi1)
/// M[s1, s1] = m1 + m2
/// M[phi1, x] = -(m1 + m2)*s1*sin(phi1)
/// M[phi1, y] = (m1 + m2)*s1*cos(phi1)
/// M[phi1, phi1] = (m1 + m2)*s1^2
/// M[theta1, theta1] = J1
/// M[s2, x] = m2*cos(phi2)
/// M[s2, y] = m2*sin(phi2)
/// M[s2, s1] = m2*cos(phi2 - phi1)
/// M[s2, phi1] = m2*s1*sin(phi2 - phi1)
/// M[s2, s2] = m2
/// M[phi2, x] = -m2*s2*sin(phi2)
/// M[phi2, y] = m2*s2*cos(phi2)
/// M[phi2, s1] = -m2*s2*sin(phi2 - phi1)
/// M[phi2, phi1] = m2*s1*s2*cos(phi2 - phi1)
/// M[phi2, phi2] = m2*s2^2
/// M[theta2, theta2] = J2
/// ```
pub fn mass_matrix<S: ::lagrangian::Scalar>(p: &Prepared<S>, q: &[S; 9]) -> [[S; 9]; 9] {
    let theta = q[2];
    let s1 = q[3];
    let phi1 = q[4];
    let s2 = q[6];
    let phi2 = q[7];
    let (sin_theta, cos_theta) = theta.sin_cos();
    let (sin_phi1, cos_phi1) = phi1.sin_cos();
    let (sin_phi2, cos_phi2) = phi2.sin_cos();
    let t0 = s1 * p.m2;
    let t1 = p.k11 * s1;
    let t2 = p.m2 * s2;
    let t3 = sin_phi1 * cos_phi2;
    let t4 = cos_phi1 * sin_phi2;
    let t5 = cos_phi1 * cos_phi2 + sin_phi1 * sin_phi2;
    let zero = S::ZERO;
    let m31 = -(p.k13 * sin_theta + cos_theta * p.k12);
    let m32 = p.k13 * cos_theta - sin_theta * p.k12;
    let m41 = p.k11 * cos_phi1;
    let m42 = p.k11 * sin_phi1;
    let m51 = sin_phi1 * (s1 * p.k21);
    let m52 = cos_phi1 * t1;
    let m55 = s1 * t1;
    let m71 = cos_phi2 * p.m2;
    let m72 = sin_phi2 * p.m2;
    let m74 = p.m2 * t5;
    let m75 = (t4 - t3) * t0;
    let m81 = sin_phi2 * (s2 * p.k22);
    let m82 = cos_phi2 * t2;
    let m84 = t2 * (t3 - t4);
    let m85 = t5 * (t0 * s2);
    let m88 = s2 * t2;
    [
        [p.k14, zero, m31, m41, m51, zero, m71, m81, zero],
        [zero, p.k14, m32, m42, m52, zero, m72, m82, zero],
        [m31, m32, p.k20, zero, zero, zero, zero, zero, zero],
        [m41, m42, zero, p.k11, zero, zero, m74, m84, zero],
        [m51, m52, zero, zero, m55, zero, m75, m85, zero],
        [zero, zero, zero, zero, zero, p.J1, zero, zero, zero],
        [m71, m72, zero, m74, m75, zero, p.m2, zero, zero],
        [m81, m82, zero, m84, m85, zero, zero, m88, zero],
        [zero, zero, zero, zero, zero, zero, zero, zero, p.J2],
    ]
}

/// Bias `h`: velocity products and explicit time in the inertia forces.
///
/// ```text
/// h[x] = m0*y0*sin(theta)*der(theta)^2 - m0*x0*cos(theta)*der(theta)^2
///     - 2*(m1 + m2)*sin(phi1)*der(s1)*der(phi1) - (m1 + m2)*s1*cos(phi1)*der(phi1)^2
///     - 2*m2*sin(phi2)*der(s2)*der(phi2) - m2*s2*cos(phi2)*der(phi2)^2 - m0*e*w^2*cos(w*t)
/// h[y] = 2*(m1 + m2)*cos(phi1)*der(s1)*der(phi1) - m0*y0*cos(theta)*der(theta)^2
///     - m0*x0*sin(theta)*der(theta)^2 - (m1 + m2)*s1*sin(phi1)*der(phi1)^2
///     + 2*m2*cos(phi2)*der(s2)*der(phi2) - m2*s2*sin(phi2)*der(phi2)^2 - m0*e*w^2*sin(w*t)
/// h[theta] = m0*e*y0*w^2*cos(w*t - theta) - m0*e*x0*w^2*sin(w*t - theta)
/// h[s1] = -(m1 + m2)*s1*der(phi1)^2 - 2*m2*sin(phi2 - phi1)*der(s2)*der(phi2)
///     - m2*s2*cos(phi2 - phi1)*der(phi2)^2
/// h[phi1] = 2*(m1 + m2)*s1*der(s1)*der(phi1) + 2*m2*s1*cos(phi2 - phi1)*der(s2)*der(phi2)
///     - m2*s1*s2*sin(phi2 - phi1)*der(phi2)^2
/// h[s2] = 2*m2*sin(phi2 - phi1)*der(s1)*der(phi1) - m2*s1*cos(phi2 - phi1)*der(phi1)^2
///     - m2*s2*der(phi2)^2
/// h[phi2] = 2*m2*s2*cos(phi2 - phi1)*der(s1)*der(phi1) + m2*s1*s2*sin(phi2 - phi1)*der(phi1)^2
///     + 2*m2*s2*der(s2)*der(phi2)
/// ```
pub fn bias<S: ::lagrangian::Scalar>(p: &Prepared<S>, t: S, q: &[S; 9], v: &[S; 9]) -> [S; 9] {
    let theta = q[2];
    let s1 = q[3];
    let phi1 = q[4];
    let s2 = q[6];
    let phi2 = q[7];
    let theta_dot = v[2];
    let s1_dot = v[3];
    let phi1_dot = v[4];
    let s2_dot = v[6];
    let phi2_dot = v[7];
    let t0 = p.w * t;
    let (sin_theta, cos_theta) = theta.sin_cos();
    let (sin_phi2, cos_phi2) = phi2.sin_cos();
    let (sin_phi1, cos_phi1) = phi1.sin_cos();
    let t1 = theta_dot * theta_dot;
    let (sin_t0, cos_t0) = t0.sin_cos();
    let t2 = p.w.product_error(t);
    let t3 = phi2_dot * phi2_dot;
    let t4 = t1 * p.y0;
    let t5 = t1 * p.x0;
    let t6 = phi1_dot * phi1_dot;
    let t7 = phi2_dot * (s2_dot * S::from_f64(2.0));
    let t8 = phi1_dot * (S::from_f64(2.0) * s1_dot);
    let t9 = sin_phi2 * s2;
    let t10 = sin_phi1 * s1;
    let t11 = cos_phi2 * s2;
    let t12 = cos_phi1 * s1;
    let t13 = t6 * t10 - t8 * cos_phi1;
    let t14 = t8 * sin_phi1 + t6 * t12;
    let t15 = p.k9 * (sin_t0 + t2 * cos_t0) + (sin_theta * t5 + t4 * cos_theta);
    let t16 = t3 * t9 - t7 * cos_phi2 + t13;
    let t17 = p.k9 * (cos_t0 - t2 * sin_t0) + (cos_theta * t5 - t4 * sin_theta);
    let t18 = t7 * sin_phi2 + t3 * t11 + t14;
    let t19 = p.m2 * t16 + p.m1 * t13;
    let t20 = t18 * p.m2 + t14 * p.m1;
    let t21 = cos_theta * (t17 * p.k12 - t15 * p.k13);
    let h_x = -(t17 * p.m0 + t20);
    let h_y = -(p.m0 * t15 + t19);
    let h_theta = sin_theta * (t15 * p.k12 + t17 * p.k13) + t21;
    let h_s1 = -(cos_phi1 * t20 + sin_phi1 * t19);
    let h_phi1 = t20 * t10 - t12 * t19;
    let zero = S::ZERO;
    let h_s2 = p.k22 * (cos_phi2 * t18 + sin_phi2 * t16);
    let h_phi2 = p.k22 * (t11 * t16 - t18 * t9);
    [h_x, h_y, h_theta, h_s1, h_phi1, zero, h_s2, h_phi2, zero]
}

/// Applied generalized forces `Q`.
///
/// ```text
/// Q[x] = bx*yb*der(theta) - bx*der(x) - cx*x + cx*yc*theta
/// Q[y] = -by*der(y) - by*xb*der(theta) - cy*y - cy*xc*theta
/// Q[theta] = bx*yb*(der(x) - yb*der(theta)) - by*xb*(der(y) + xb*der(theta))
///     + cx*yc*(x - yc*theta) - cy*xc*(y + xc*theta)
/// Q[s1] = -d1*der(s1) - k1*(s1 - r1)
/// Q[s2] = -d2*der(s2) - k2*(s2 - r2)
/// ```
pub fn applied<S: ::lagrangian::Scalar>(p: &Prepared<S>, q: &[S; 9], v: &[S; 9]) -> [S; 9] {
    let x = q[0];
    let y = q[1];
    let theta = q[2];
    let s1 = q[3];
    let s2 = q[6];
    let x_dot = v[0];
    let y_dot = v[1];
    let theta_dot = v[2];
    let s1_dot = v[3];
    let s2_dot = v[6];
    let t0 = x - theta * p.yc;
    let t1 = theta * p.xc + y;
    let t2 = x_dot - theta_dot * p.yb;
    let t3 = theta_dot * p.xb + y_dot;
    let q_x = -(t2 * p.bx + t0 * p.cx);
    let q_y = -(t3 * p.by + t1 * p.cy);
    let q_theta = t2 * p.k16 + t0 * p.k18 - (t3 * p.k15 + t1 * p.k17);
    let q_s1 = (p.r1 - s1) * p.k1 - s1_dot * p.d1;
    let zero = S::ZERO;
    let q_s2 = (p.r2 - s2) * p.k2 - s2_dot * p.d2;
    [q_x, q_y, q_theta, q_s1, zero, zero, q_s2, zero, zero]
}

/// Right-hand side `f = Q - h` of `M a = f`.
pub fn forces<S: ::lagrangian::Scalar>(p: &Prepared<S>, t: S, q: &[S; 9], v: &[S; 9]) -> [S; 9] {
    let x = q[0];
    let y = q[1];
    let theta = q[2];
    let s1 = q[3];
    let phi1 = q[4];
    let s2 = q[6];
    let phi2 = q[7];
    let x_dot = v[0];
    let y_dot = v[1];
    let theta_dot = v[2];
    let s1_dot = v[3];
    let phi1_dot = v[4];
    let s2_dot = v[6];
    let phi2_dot = v[7];
    let t0 = p.w * t;
    let (sin_theta, cos_theta) = theta.sin_cos();
    let (sin_phi2, cos_phi2) = phi2.sin_cos();
    let (sin_phi1, cos_phi1) = phi1.sin_cos();
    let t1 = theta_dot * theta_dot;
    let (sin_t0, cos_t0) = t0.sin_cos();
    let t2 = p.w.product_error(t);
    let t3 = phi2_dot * phi2_dot;
    let t4 = t1 * p.y0;
    let t5 = t1 * p.x0;
    let t6 = phi1_dot * phi1_dot;
    let t7 = x - theta * p.yc;
    let t8 = phi2_dot * (s2_dot * S::from_f64(2.0));
    let t9 = phi1_dot * (S::from_f64(2.0) * s1_dot);
    let t10 = theta * p.xc + y;
    let t11 = x_dot - theta_dot * p.yb;
    let t12 = theta_dot * p.xb + y_dot;
    let t13 = cos_phi2 * s2;
    let t14 = cos_phi1 * s1;
    let t15 = sin_phi2 * s2;
    let t16 = sin_phi1 * s1;
    let t17 = t9 * sin_phi1 + t6 * t14;
    let t18 = p.k9 * (sin_t0 + t2 * cos_t0) + (sin_theta * t5 + t4 * cos_theta);
    let t19 = t6 * t16 - t9 * cos_phi1;
    let t20 = p.k9 * (cos_t0 - t2 * sin_t0) + (cos_theta * t5 - t4 * sin_theta);
    let t21 = t8 * sin_phi2 + t3 * t13 + t17;
    let t22 = t3 * t15 - t8 * cos_phi2 + t19;
    let t23 = t21 * p.m2;
    let t24 = p.m2 * t22;
    let t25 = t23 + t17 * p.m1;
    let t26 = t12 * p.k15 + t10 * p.k17 - (t11 * p.k16 + t7 * p.k18);
    let t27 = t24 + p.m1 * t19;
    let t28 = cos_theta * (t20 * p.k12 - t18 * p.k13) + t26;
    let f_x = t20 * p.m0 + (t25 - (t11 * p.bx + t7 * p.cx));
    let f_y = p.m0 * t18 + (t27 - (t12 * p.by + t10 * p.cy));
    let f_theta = -(sin_theta * (t18 * p.k12 + t20 * p.k13) + t28);
    let f_s1 = cos_phi1 * t25 + (sin_phi1 * t27 + ((p.r1 - s1) * p.k1 - s1_dot * p.d1));
    let f_phi1 = t14 * t27 - t25 * t16;
    let zero = S::ZERO;
    let f_s2 = cos_phi2 * t23 - (s2_dot * p.d2 - (p.r2 - s2) * p.k2 - sin_phi2 * t24);
    let f_phi2 = p.m2 * (t13 * t22 - t21 * t15);
    [f_x, f_y, f_theta, f_s1, f_phi1, zero, f_s2, f_phi2, zero]
}

/// Accelerations `a`, the solution of `M a = f` eliminated along the machine.
///
/// A pivot that vanishes is an error.
pub fn accelerations<S: ::lagrangian::Number>(
    p: &Prepared<S>,
    t: S,
    q: &[S; 9],
    v: &[S; 9],
) -> Result<[S; 9], ::lagrangian::Singular> {
    S::run(Accelerations { p, t, q, v })
}

/// A call of [`accelerations`], to be run with whatever instructions the processor has.
pub struct Accelerations<'a, S> {
    /// As `accelerations` takes it.
    pub p: &'a Prepared<S>,
    /// As `accelerations` takes it.
    pub t: S,
    /// As `accelerations` takes it.
    pub q: &'a [S; 9],
    /// As `accelerations` takes it.
    pub v: &'a [S; 9],
}

impl<S: Copy> ::lagrangian::scalar::Kernel<S> for Accelerations<'_, S> {
    type Output = Result<[S; 9], ::lagrangian::Singular>;

    #[inline(always)]
    fn run<N: ::lagrangian::Scalar<Stored = S>>(self) -> Self::Output {
        let Self { p, t, q, v } = self;
        let n = N::load;
        if let Some(singular) = p.singular {
            return Err(singular);
        }
        let x = n(q[0]);
        let y = n(q[1]);
        let theta = n(q[2]);
        let s1 = n(q[3]);
        let phi1 = n(q[4]);
        let s2 = n(q[6]);
        let phi2 = n(q[7]);
        let x_dot = n(v[0]);
        let y_dot = n(v[1]);
        let theta_dot = n(v[2]);
        let s1_dot = n(v[3]);
        let phi1_dot = n(v[4]);
        let s2_dot = n(v[6]);
        let phi2_dot = n(v[7]);
        let t0 = n(p.w) * n(t);
        let angles = [theta, phi1, phi2, t0];
        let circular = N::sin_cos_all(angles);
        let (sin_theta, cos_theta) = circular[0];
        let (sin_phi1, cos_phi1) = circular[1];
        let (sin_phi2, cos_phi2) = circular[2];
        let (sin_t0, cos_t0) = circular[3];
        let t1 = theta_dot * theta_dot;
        let t2 = n(p.w).product_error(n(t));
        let t3 = theta.neg_mul_add(n(p.yc), x);
        let t4 = theta.mul_add(n(p.xc), y);
        let t5 = theta_dot.neg_mul_add(n(p.yb), x_dot);
        let t6 = theta_dot.mul_add(n(p.xb), y_dot);
        let t7 = (n(p.r1) - s1).neg_mul_add(n(p.k1), s1_dot * n(p.d1));
        let t8 = phi1_dot * (s1_dot * N::from_f64(2.0));
        let t9 = (n(p.r2) - s2).neg_mul_add(n(p.k2), s2_dot * n(p.d2));
        let t10 = s2 * n(p.m2);
        let t11 = phi1_dot * (s1 * phi1_dot);
        let t12 = t6.mul_add(n(p.k15), t4 * n(p.k17));
        let t13 = s1 * s1;
        let t14 = s2 * t10;
        let t15 = cos_theta * n(p.y0);
        let t16 = sin_theta * n(p.y0);
        let t17 = sin_theta * n(p.x0);
        let t18 = cos_theta * n(p.x0);
        let t19 = t5.mul_add(n(p.bx), t3 * n(p.cx));
        let t20 = t6.mul_add(n(p.by), t4 * n(p.cy));
        let t21 = t18 - t16;
        let t22 = t17 + t15;
        let t23 = sin_phi1.mul_sub(t11, cos_phi1 * t8);
        let t24 = n(p.m1).mul_add(t23, t9 * sin_phi2);
        let t25 = sin_phi1.mul_add(t8, cos_phi1 * t11);
        let t26 = t2.mul_add(cos_t0, sin_t0);
        let t27 = t2.neg_mul_add(sin_t0, cos_t0);
        let t28 = n(p.m1).mul_add(t25, t9 * cos_phi2);
        let t29 = n(p.m0) * n(p.k9).mul_add(t26, t17.mul_add(t1, t15 * t1));
        let t30 = n(p.k9).mul_add(t27, t1.mul_sub(t18, t16 * t1)) * n(p.m0);
        let t31 = t5.mul_add(n(p.k16), t3 * n(p.k18)) - t12;
        let t32 = t7.neg_mul_add(cos_phi1, t19) - t30;
        let t33 = t7.neg_mul_add(sin_phi1, t20) - t29;
        let t34 = cos_phi1.neg_mul_add(t28, sin_phi1.neg_mul_add(t24, t7));
        let t35 = t32.neg_mul_add(n(p.k25) * t22, t21.mul_add(t29, t31));
        let t36 = t33.mul_sub(n(p.k25) * t21, t22 * t30) + t35;
        let t37 = n(p.k27) * t36;
        let t38 = t22.neg_mul_add(t37, t32);
        let t39 = t21.mul_add(t37, t33);
        let t40 = t39 * n(p.k28);
        let t41 = t38 * n(p.k28);
        let t42 = sin_phi1 * t40;
        let t43 = cos_phi1.neg_mul_add(t41, n(p.k24) * t34);
        let t44 = n(p.k24) * cos_phi1.mul_sub(t24, sin_phi1 * t28);
        let t45 = t43 - t42;
        let t46 = sin_phi1.neg_mul_add(t41, cos_phi1.mul_add(t40, t44));
        let t47 = sin_phi1.mul_add(t46, cos_phi1.mul_add(t45, t41 + t25));
        let t48 = sin_phi1.mul_add(t45, t40 + t23);
        let t49 = cos_phi1.neg_mul_add(t46, t48);
        let t50 = phi2_dot * (s2_dot * N::from_f64(2.0));
        let t51 = n(p.k23) * t10.neg_mul_add(phi2_dot * phi2_dot, t9);
        let t52 = cos_phi2.neg_mul_add(t49, sin_phi2.mul_add(t47, t50)) / s2;
        let x_ddot = n(p.k29) * t38;
        let y_ddot = n(p.k29) * t39;
        let theta_ddot = t36 * n(p.k26);
        let s1_ddot = t42 - t43;
        let phi1_ddot = t46 / s1;
        let zero = N::ZERO;
        let s2_ddot = sin_phi2.mul_add(t49, cos_phi2.mul_sub(t47, t51));
        let phi2_ddot = -t52;
        let t53 = n(p.m1) * t13;
        let t54 = t13 * n(p.k11);
        let sound = t14.exceeds(N::from_f64(7.993605777301127e-15) * t14)
            & t53.exceeds(N::from_f64(7.993605777301127e-15) * t54)
            & phi2_ddot.is_finite();
        if !sound {
            check(t14, t14, 7.993605777301127e-15, 7)?;
            check(t53, t54, 7.993605777301127e-15, 4)?;
        }
        let accelerations = [
            x_ddot.store(),
            y_ddot.store(),
            theta_ddot.store(),
            s1_ddot.store(),
            phi1_ddot.store(),
            zero.store(),
            s2_ddot.store(),
            phi2_ddot.store(),
            zero.store(),
        ];
        Ok(accelerations)
    }
}

/// Kinetic energy `T`, in J.
///
/// ```text
/// T = 1/2*m*der(x)^2 + 1/2*m*der(y)^2 + 1/2*J*der(theta)^2 + 1/2*J1*der(theta1)^2
///     + 1/2*J2*der(theta2)^2 + 1/2*m0*(((der(x) - y0*cos(theta)*der(theta) -
///     x0*sin(theta)*der(theta)) - e*w*sin(w*t))^2 + ((der(y) + x0*cos(theta)*der(theta) -
///     y0*sin(theta)*der(theta)) + e*w*cos(w*t))^2) + 1/2*m1*((der(x) + (cos(phi1)*der(s1) -
///     s1*sin(phi1)*der(phi1)))^2 + (der(y) + (sin(phi1)*der(s1) + s1*cos(phi1)*der(phi1)))^2) +
///     1/2*m2*(((der(x) + (cos(phi1)*der(s1) - s1*sin(phi1)*der(phi1))) + (cos(phi2)*der(s2) -
///     s2*sin(phi2)*der(phi2)))^2 + ((der(y) + (sin(phi1)*der(s1) + s1*cos(phi1)*der(phi1))) +
///     (sin(phi2)*der(s2) + s2*cos(phi2)*der(phi2)))^2)
/// ```
pub fn kinetic_energy<S: ::lagrangian::Scalar>(p: &Prepared<S>, t: S, q: &[S; 9], v: &[S; 9]) -> S {
    let theta = q[2];
    let s1 = q[3];
    let phi1 = q[4];
    let s2 = q[6];
    let phi2 = q[7];
    let x_dot = v[0];
    let y_dot = v[1];
    let theta_dot = v[2];
    let s1_dot = v[3];
    let phi1_dot = v[4];
    let theta1_dot = v[5];
    let s2_dot = v[6];
    let phi2_dot = v[7];
    let theta2_dot = v[8];
    let (sin_phi1, cos_phi1) = phi1.sin_cos();
    let (sin_phi2, cos_phi2) = phi2.sin_cos();
    let (sin_theta, cos_theta) = theta.sin_cos();
    let t0 = p.w * t;
    let t1 = phi1_dot * s1;
    let t2 = phi2_dot * s2;
    let t3 = p.w.product_error(t);
    let (sin_t0, cos_t0) = t0.sin_cos();
    let t4 = x_dot + (cos_phi1 * s1_dot - t1 * sin_phi1);
    let t5 = y_dot + (t1 * cos_phi1 + sin_phi1 * s1_dot);
    let t6 = cos_phi2 * s2_dot - t2 * sin_phi2 + t4;
    let t7 = t2 * cos_phi2 + sin_phi2 * s2_dot + t5;
    let t8 = x_dot - theta_dot * (cos_theta * p.y0 + sin_theta * p.x0);
    let t9 = t8 - p.k0 * (sin_t0 + t3 * cos_t0);
    let t10 = y_dot + theta_dot * (cos_theta * p.x0 - sin_theta * p.y0);
    let t11 = p.k0 * (cos_t0 - t3 * sin_t0) + t10;
    let t12 = (y_dot * y_dot + x_dot * x_dot) * p.m + theta_dot * (theta_dot * p.J);
    let t13 = (t5 * t5 + t4 * t4) * p.m1 + theta1_dot * (theta1_dot * p.J1) + t12;
    let t14 = (t7 * t7 + t6 * t6) * p.m2 + theta2_dot * (theta2_dot * p.J2) + t13;
    t14 * S::from_f64(0.5) + p.k10 * (t11 * t11 + t9 * t9)
}

/// Potential energy `V`, in J.
///
/// ```text
/// V = 1/2*cx*(x - yc*theta)^2 + 1/2*cy*(y + xc*theta)^2 + 1/2*k1*(s1 - r1)^2 + 1/2*k2*(s2 - r2)^2
/// ```
pub fn potential_energy<S: ::lagrangian::Scalar>(p: &Prepared<S>, q: &[S; 9]) -> S {
    let x = q[0];
    let y = q[1];
    let theta = q[2];
    let s1 = q[3];
    let s2 = q[6];
    let t0 = p.r1 - s1;
    let t1 = x - theta * p.yc;
    let t2 = p.r2 - s2;
    let t3 = theta * p.xc + y;
    let t4 = t3 * (t3 * p.k2_) + t1 * (t1 * p.k1_);
    t2 * (t2 * p.k4) + t0 * (t0 * p.k3) + t4
}

/// Dissipation function `D`, in W.
///
/// ```text
/// D = 1/2*d1*der(s1)^2 + 1/2*d2*der(s2)^2 + 1/2*bx*(der(x) - yb*der(theta))^2
///     + 1/2*by*(der(y) + xb*der(theta))^2
/// ```
pub fn dissipation<S: ::lagrangian::Scalar>(p: &Prepared<S>, v: &[S; 9]) -> S {
    let x_dot = v[0];
    let y_dot = v[1];
    let theta_dot = v[2];
    let s1_dot = v[3];
    let s2_dot = v[6];
    let t0 = x_dot - theta_dot * p.yb;
    let t1 = theta_dot * p.xb + y_dot;
    let t2 = t0 * (t0 * p.k5) + (s2_dot * (s2_dot * p.k8) + s1_dot * (s1_dot * p.k7));
    t1 * (t1 * p.k6) + t2
}

/// Power `P` that drives, forces and inputs put in, in W.
///
/// ```text
/// P = m0*e*w*cos(w*t)*der(der(y)) - m0*e*w*sin(w*t)*der(der(x))
///     + m0*e*y0*w*sin(w*t - theta)*der(der(theta)) + m0*e*x0*w*cos(w*t - theta)*der(der(theta))
///     + m0*e*x0*w*sin(w*t - theta)*der(theta)^2 - m0*e*y0*w*cos(w*t - theta)*der(theta)^2
/// ```
pub fn work_rate<S: ::lagrangian::Scalar>(
    p: &Prepared<S>,
    t: S,
    q: &[S; 9],
    v: &[S; 9],
    a: &[S; 9],
) -> S {
    let theta = q[2];
    let theta_dot = v[2];
    let x_ddot = a[0];
    let y_ddot = a[1];
    let theta_ddot = a[2];
    let (sin_theta, cos_theta) = theta.sin_cos();
    let t0 = p.w * t;
    let t1 = theta_dot * theta_dot;
    let t2 = p.w.product_error(t);
    let (sin_t0, cos_t0) = t0.sin_cos();
    let t3 = sin_theta * theta_ddot + cos_theta * t1;
    let t4 = sin_theta * t1 - cos_theta * theta_ddot;
    let t5 = sin_t0 + t2 * cos_t0;
    let t6 = cos_t0 - t2 * sin_t0;
    let t7 = t6 * (t5 * p.k9 - (y_ddot - t3 * p.y0 - t4 * p.x0));
    (t5 * (t6 * p.k9 - (t4 * p.y0 + x_ddot - p.x0 * t3)) - t7) * p.k19
}

/// Power `R` that dampers take out, in W.
///
/// ```text
/// R = d1*der(s1)^2 + d2*der(s2)^2 + bx*(der(x) - yb*der(theta))^2 + by*(der(y) + xb*der(theta))^2
/// ```
pub fn dissipation_rate<S: ::lagrangian::Scalar>(p: &Prepared<S>, v: &[S; 9]) -> S {
    let x_dot = v[0];
    let y_dot = v[1];
    let theta_dot = v[2];
    let s1_dot = v[3];
    let s2_dot = v[6];
    let t0 = x_dot - theta_dot * p.yb;
    let t1 = theta_dot * p.xb + y_dot;
    let t2 = t0 * (t0 * p.bx) + (s2_dot * (s2_dot * p.d2) + s1_dot * (s1_dot * p.d1));
    t1 * (t1 * p.by) + t2
}

/// By how much `s1 > 0` holds.
pub fn assumption_0<S: ::lagrangian::Scalar>(q: &[S; 9]) -> S {
    let s1 = q[3];
    s1
}

/// By how much `s2 > 0` holds.
pub fn assumption_1<S: ::lagrangian::Scalar>(q: &[S; 9]) -> S {
    let s2 = q[6];
    s2
}

/// Names and units.
const PARAMETERS: [(&str, &str); 25] = [
    ("m", "kg"),
    ("J", "kg*m^2"),
    ("m0", "kg"),
    ("e", "m"),
    ("x0", "m"),
    ("y0", "m"),
    ("w", "rad/s"),
    ("m1", "kg"),
    ("J1", "kg*m^2"),
    ("m2", "kg"),
    ("J2", "kg*m^2"),
    ("cx", "N/m"),
    ("cy", "N/m"),
    ("xc", "m"),
    ("yc", "m"),
    ("bx", "N*s/m"),
    ("by", "N*s/m"),
    ("xb", "m"),
    ("yb", "m"),
    ("k1", "N/m"),
    ("d1", "N*s/m"),
    ("r1", "m"),
    ("k2", "N/m"),
    ("d2", "N*s/m"),
    ("r2", "m"),
];

/// Names and units.
const COORDINATES: [(&str, &str); 9] = [
    ("x", "m"),
    ("y", "m"),
    ("theta", "rad"),
    ("s1", "m"),
    ("phi1", "rad"),
    ("theta1", "rad"),
    ("s2", "m"),
    ("phi2", "rad"),
    ("theta2", "rad"),
];

/// Names and units.
const INPUTS: [(&str, &str); 0] = [];

/// Names and units.
const OUTPUTS: [(&str, &str); 0] = [];

impl ::lagrangian::Machine for Crusher9 {
    type System = Prepared;

    fn name(&self) -> &str {
        "Crusher9"
    }

    fn parameters(&self) -> impl ExactSizeIterator<Item = (::lagrangian::Quantity<'_>, f64)> {
        let values = [
            self.m, self.J, self.m0, self.e, self.x0, self.y0, self.w, self.m1, self.J1, self.m2,
            self.J2, self.cx, self.cy, self.xc, self.yc, self.bx, self.by, self.xb, self.yb,
            self.k1, self.d1, self.r1, self.k2, self.d2, self.r2,
        ];
        quantities(&PARAMETERS, values)
    }

    fn parameter_mut(&mut self, index: usize) -> Option<&mut f64> {
        match index {
            0 => Some(&mut self.m),
            1 => Some(&mut self.J),
            2 => Some(&mut self.m0),
            3 => Some(&mut self.e),
            4 => Some(&mut self.x0),
            5 => Some(&mut self.y0),
            6 => Some(&mut self.w),
            7 => Some(&mut self.m1),
            8 => Some(&mut self.J1),
            9 => Some(&mut self.m2),
            10 => Some(&mut self.J2),
            11 => Some(&mut self.cx),
            12 => Some(&mut self.cy),
            13 => Some(&mut self.xc),
            14 => Some(&mut self.yc),
            15 => Some(&mut self.bx),
            16 => Some(&mut self.by),
            17 => Some(&mut self.xb),
            18 => Some(&mut self.yb),
            19 => Some(&mut self.k1),
            20 => Some(&mut self.d1),
            21 => Some(&mut self.r1),
            22 => Some(&mut self.k2),
            23 => Some(&mut self.d2),
            24 => Some(&mut self.r2),
            _ => None,
        }
    }

    fn prepare(&self) -> Prepared {
        Self::prepare(self)
    }

    fn start(&self) -> ::lagrangian::State<Coordinates> {
        Self::start(self)
    }
}

impl ::lagrangian::System for Prepared {
    type Vector = [f64; 9];
    type Matrix = [f64; 81];
    type Coordinates = Coordinates;
    type Inputs = Inputs;
    type Outputs = Outputs;

    fn coordinates(&self) -> impl ExactSizeIterator<Item = ::lagrangian::Quantity<'_>> {
        COORDINATES.iter().map(quantity)
    }

    fn to_coordinates(&self, vector: &[f64; 9]) -> Coordinates {
        Coordinates::from_array(*vector)
    }

    fn to_vector(&self, coordinates: &Coordinates) -> [f64; 9] {
        coordinates.to_array()
    }

    fn accelerations(
        &self,
        t: f64,
        q: &[f64; 9],
        v: &[f64; 9],
        _: &Inputs,
        result: &mut [f64; 9],
    ) -> Result<(), ::lagrangian::Singular> {
        <f64 as ::lagrangian::Number>::run_in_place(Accelerations { p: self, t, q, v }, result)
    }

    fn mass_matrix(&self, _: f64, q: &[f64; 9], matrix: &mut [f64; 81]) {
        let rows = mass_matrix(self, q);
        for (to, from) in matrix.iter_mut().zip(rows.as_flattened()) {
            *to = *from;
        }
    }

    fn bias(&self, t: f64, q: &[f64; 9], v: &[f64; 9], result: &mut [f64; 9]) {
        *result = bias(self, t, q, v);
    }

    fn applied(&self, _: f64, q: &[f64; 9], v: &[f64; 9], _: &Inputs, result: &mut [f64; 9]) {
        *result = applied(self, q, v);
    }

    fn forces(&self, t: f64, q: &[f64; 9], v: &[f64; 9], _: &Inputs, result: &mut [f64; 9]) {
        *result = forces(self, t, q, v);
    }

    fn kinetic_energy(&self, t: f64, q: &[f64; 9], v: &[f64; 9]) -> f64 {
        kinetic_energy(self, t, q, v)
    }

    fn potential_energy(&self, _: f64, q: &[f64; 9], _: &Inputs) -> f64 {
        potential_energy(self, q)
    }

    fn dissipation(&self, _: f64, _: &[f64; 9], v: &[f64; 9], _: &Inputs) -> f64 {
        dissipation(self, v)
    }

    fn work_rate(&self, t: f64, q: &[f64; 9], v: &[f64; 9], a: &[f64; 9], _: &Inputs) -> f64 {
        work_rate(self, t, q, v, a)
    }

    fn dissipation_rate(&self, _: f64, _: &[f64; 9], v: &[f64; 9], _: &Inputs) -> f64 {
        dissipation_rate(self, v)
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

    fn outputs(&self, _: f64, _: &[f64; 9], _: &[f64; 9], _: &[f64; 9], _: &Inputs) -> Outputs {
        Outputs {}
    }

    fn assumptions(
        &self,
        _: f64,
        q: &[f64; 9],
        _: &[f64; 9],
        _: &Inputs,
    ) -> impl ExactSizeIterator<Item = ::lagrangian::Assumption<'_>> {
        let facts = [
            assumption("s1 > 0", true, assumption_0(q)),
            assumption("s2 > 0", true, assumption_1(q)),
        ];
        facts.into_iter()
    }
}

impl<const N: usize> ::lagrangian::Batched<N> for Prepared
where
    ::lagrangian::Lanes<N>: ::lagrangian::Number,
{
    type Batch = Prepared<::lagrangian::Lanes<N>>;
    type Vectors = [::lagrangian::Lanes<N>; 9];
    type BatchInputs = Inputs;

    fn batch(systems: [&Self; N]) -> Self::Batch {
        let lanes = |number: fn(&Self) -> f64| ::lagrangian::Lanes(systems.map(number));
        Prepared {
            m: lanes(|p| p.m),
            J: lanes(|p| p.J),
            m0: lanes(|p| p.m0),
            x0: lanes(|p| p.x0),
            y0: lanes(|p| p.y0),
            w: lanes(|p| p.w),
            m1: lanes(|p| p.m1),
            J1: lanes(|p| p.J1),
            m2: lanes(|p| p.m2),
            J2: lanes(|p| p.J2),
            cx: lanes(|p| p.cx),
            cy: lanes(|p| p.cy),
            xc: lanes(|p| p.xc),
            yc: lanes(|p| p.yc),
            bx: lanes(|p| p.bx),
            by: lanes(|p| p.by),
            xb: lanes(|p| p.xb),
            yb: lanes(|p| p.yb),
            k1: lanes(|p| p.k1),
            d1: lanes(|p| p.d1),
            r1: lanes(|p| p.r1),
            k2: lanes(|p| p.k2),
            d2: lanes(|p| p.d2),
            r2: lanes(|p| p.r2),
            k0: lanes(|p| p.k0),
            k1_: lanes(|p| p.k1_),
            k2_: lanes(|p| p.k2_),
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
        t: ::lagrangian::Lanes<N>,
        q: &Self::Vectors,
        v: &Self::Vectors,
        _: &Self::BatchInputs,
        result: &mut Self::Vectors,
    ) -> Result<(), ::lagrangian::Singular> {
        <::lagrangian::Lanes<N> as ::lagrangian::Number>::run_in_place(
            Accelerations { p, t, q, v },
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

/// A fact and by how much it holds.
fn assumption(text: &str, strict: bool, margin: f64) -> ::lagrangian::Assumption<'_> {
    ::lagrangian::Assumption {
        text,
        margin,
        strict,
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

/// The share of a pivot that is no rounding, for the message.
#[cold]
fn singular<S: ::lagrangian::Scalar>(
    coordinate: usize,
    pivot: S,
    diagonal: S,
) -> ::lagrangian::Singular {
    ::lagrangian::Singular::new(coordinate, pivot.to_f64(), diagonal.to_f64())
}
