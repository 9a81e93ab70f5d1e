// @generated from machines/small_angle_crusher.machine by `cargo xtask generate`; edits are lost.

//! The crusher with its energies to second order in the platform's angle and angular rate together.
//!
//! What is left out of the energies is of third order: half the angle, an eighth of the error.
//! Unlike the frozen machine it keeps how the turn of the platform displaces the axis of the
//! debalance, x0 cos θ ≈ x0 and y0 sin θ ≈ y0 θ, and with it the product of angle and rate.
//!
//! 9 coordinates, 18 parameters. Arithmetic of one call:
//!
//! | function | mul | add | div | sin cos | other | temporaries |
//! | --- | --: | --: | --: | --: | --: | --: |
//! | `prepare` | 39 | 7 | 2 | 0 | 0 | 48 |
//! | `mass_matrix` | 30 | 9 | 0 | 2 | 0 | 43 |
//! | `bias` | 86 | 66 | 0 | 3 | 0 | 158 |
//! | `applied` | 6 | 6 | 0 | 0 | 0 | 12 |
//! | `forces` | 92 | 70 | 0 | 3 | 0 | 168 |
//! | `accelerations` | 205 | 138 | 5 | 3 | 0 | 354 |
//! | `kinetic_energy` | 47 | 27 | 0 | 3 | 0 | 80 |
//! | `potential_energy` | 6 | 2 | 0 | 0 | 0 | 8 |
//! | `dissipation` | 6 | 2 | 0 | 0 | 0 | 8 |
//! | `work_rate` | 40 | 23 | 0 | 1 | 0 | 65 |
//! | `dissipation_rate` | 6 | 2 | 0 | 0 | 0 | 8 |
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

/// The crusher with its energies to second order in the platform's angle and angular rate together.
///
/// What is left out of the energies is of third order: half the angle, an eighth of the error.
/// Unlike the frozen machine it keeps how the turn of the platform displaces the axis of the
/// debalance, x0 cos θ ≈ x0 and y0 sin θ ≈ y0 θ, and with it the product of angle and rate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SmallAngleCrusher<S = f64> {
    /// Mass of the platform. Unit: kg. Default: 600.
    pub m: S,
    /// Mass of the debalance. Unit: kg. Default: 40.
    pub m0: S,
    /// `m1`. Unit: kg. Default: 180.
    pub m1: S,
    /// `m2`. Unit: kg. Default: 120.
    pub m2: S,
    /// `J`. Unit: kg*m^2. Default: 60.
    pub J: S,
    /// `J0`. Unit: kg*m^2. Default: 0.2.
    pub J0: S,
    /// `J1`. Unit: kg*m^2. Default: 9.225.
    pub J1: S,
    /// `J2`. Unit: kg*m^2. Default: 1.536.
    pub J2: S,
    /// Eccentricity of the debalance. Unit: m. Default: 0.1.
    pub e: S,
    /// `x0`. Unit: m. Default: 0.05.
    pub x0: S,
    /// `y0`. Unit: m. Default: 0.03.
    pub y0: S,
    /// `omega`. Unit: rad/s. Default: 50*pi.
    pub omega: S,
    /// `cx`. Unit: N/m. Default: 300000.
    pub cx: S,
    /// `cy`. Unit: N/m. Default: 300000.
    pub cy: S,
    /// `bx`. Unit: N*s/m. Default: 1500.
    pub bx: S,
    /// `by`. Unit: N*s/m. Default: 1500.
    pub by: S,
    /// `xc`. Unit: m. Default: 0.4.
    pub xc: S,
    /// `yc`. Unit: m. Default: 0.3.
    pub yc: S,
}

impl Default for SmallAngleCrusher {
    fn default() -> Self {
        Self {
            m: 600.0,
            m0: 40.0,
            m1: 180.0,
            m2: 120.0,
            J: 60.0,
            J0: 0.2,
            J1: 9.225,
            J2: 1.536,
            e: 0.1,
            x0: 0.05,
            y0: 0.03,
            omega: 157.07963267948966,
            cx: 300000.0,
            cy: 300000.0,
            bx: 1500.0,
            by: 1500.0,
            xc: 0.4,
            yc: 0.3,
        }
    }
}

impl<S> SmallAngleCrusher<S> {
    /// The same over other numbers.
    pub fn map<R>(self, f: impl Fn(S) -> R) -> SmallAngleCrusher<R> {
        SmallAngleCrusher {
            m: f(self.m),
            m0: f(self.m0),
            m1: f(self.m1),
            m2: f(self.m2),
            J: f(self.J),
            J0: f(self.J0),
            J1: f(self.J1),
            J2: f(self.J2),
            e: f(self.e),
            x0: f(self.x0),
            y0: f(self.y0),
            omega: f(self.omega),
            cx: f(self.cx),
            cy: f(self.cy),
            bx: f(self.bx),
            by: f(self.by),
            xc: f(self.xc),
            yc: f(self.yc),
        }
    }
}

impl<S: ::lagrangian::Scalar> SmallAngleCrusher<S> {
    /// Computes what depends on the parameters alone, once.
    pub fn prepare(&self) -> Prepared<S> {
        let k0 = self.omega * self.e;
        let t0 = self.xc * self.xc;
        let t1 = self.yc * self.yc;
        let k9 = self.cy * t0 + self.cx * t1;
        let k10 = self.by * t0 + self.bx * t1;
        let k12 = self.m0 * self.y0;
        let k13 = self.m0 * self.x0;
        let k11 = self.y0 * k12 + (self.J + self.x0 * k13);
        let k14 = self.m1 + self.m2;
        let k16 = self.omega * k0;
        let k26 = self.y0 * k16;
        let k27 = self.x0 * k16;
        let k1 = self.omega * (self.omega * self.J0);
        let k2 = S::from_f64(0.5) * self.J;
        let k3 = S::from_f64(0.5) * self.m;
        let k4 = S::from_f64(2.0) * self.y0;
        let k5 = S::from_f64(2.0) * self.x0;
        let k6 = self.y0 * self.y0;
        let k7 = self.x0 * self.x0;
        let k8 = self.m0 * S::from_f64(0.5);
        let k15 = k14 + (self.m0 + self.m);
        let k17 = self.m0 * k16;
        let k18 = self.m0 * k26;
        let k19 = self.m0 * k27;
        let k20 = self.cx * S::from_f64(2.0);
        let k21 = self.bx * S::from_f64(2.0);
        let k22 = self.cy * S::from_f64(2.0);
        let k23 = self.by * S::from_f64(2.0);
        let k24 = S::from_f64(2.0) * k9;
        let k25 = S::from_f64(2.0) * k10;
        let k28 = S::from_f64(2.0) * k26;
        let k29 = S::from_f64(2.0) * k27;
        let k30 = k27 * S::from_f64(4.0);
        let k31 = k26 * S::from_f64(4.0);
        let k32 = self.m0 * S::from_f64(0.25);
        let k33 = k0 * self.y0;
        let k34 = k0 * self.x0;
        let k35 = S::ONE / k11;
        let k36 = S::ONE / k14;
        let singular = if vanishes(self.J1, self.J1, 7.993605777301127e-15) {
            Some(singular(5, self.J1, self.J1))
        } else if vanishes(self.J2, self.J2, 7.993605777301127e-15) {
            Some(singular(8, self.J2, self.J2))
        } else if vanishes(k11, k11, 7.993605777301127e-15) {
            Some(singular(2, k11, k11))
        } else if vanishes(k14, k14, 7.993605777301127e-15) {
            Some(singular(3, k14, k14))
        } else {
            None
        };
        Prepared {
            m0: self.m0,
            m1: self.m1,
            m2: self.m2,
            J1: self.J1,
            J2: self.J2,
            omega: self.omega,
            cx: self.cx,
            cy: self.cy,
            bx: self.bx,
            by: self.by,
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
        let zero = S::ZERO;
        let s1 = S::from_ratio(1, 50);
        let s2 = S::from_ratio(3, 100);
        let q = [zero, zero, zero, s1, zero, zero, s2, S::from_f64(0.5), zero];
        let v = [S::ZERO; 9];
        ::lagrangian::State {
            t: 0.0,
            q: Coordinates::from_array(q),
            v: Coordinates::from_array(v),
        }
    }
}

/// The coordinates of [`SmallAngleCrusher`], or their rates, by name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coordinates<S = f64> {
    /// `x`. Unit: m.
    pub x: S,
    /// `y`. Unit: m.
    pub y: S,
    /// `theta`. Unit: rad.
    pub theta: S,
    /// `s1`. Unit: m.
    pub s1: S,
    /// `phi1`. Unit: rad.
    pub phi1: S,
    /// `theta1`. Unit: rad.
    pub theta1: S,
    /// `s2`. Unit: m.
    pub s2: S,
    /// `phi2`. Unit: rad.
    pub phi2: S,
    /// `theta2`. Unit: rad.
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

    /// The same over other numbers.
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

/// What can be set while a [`SmallAngleCrusher`] runs.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Inputs {}

/// What can be observed of a [`SmallAngleCrusher`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Outputs {}

/// The parameters of a [`SmallAngleCrusher`], with the work done that depends on them alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prepared<S = f64> {
    /// `m0`
    m0: S,
    /// `m1`
    m1: S,
    /// `m2`
    m2: S,
    /// `J1`
    J1: S,
    /// `J2`
    J2: S,
    /// `omega`
    omega: S,
    /// `cx`
    cx: S,
    /// `cy`
    cy: S,
    /// `bx`
    bx: S,
    /// `by`
    by: S,
    /// `e*omega`
    k0: S,
    /// `J0*omega^2`
    k1: S,
    /// `0.5*J`
    k2: S,
    /// `0.5*m`
    k3: S,
    /// `2*y0`
    k4: S,
    /// `2*x0`
    k5: S,
    /// `y0^2`
    k6: S,
    /// `x0^2`
    k7: S,
    /// `0.5*m0`
    k8: S,
    /// `cx*yc^2 + cy*xc^2`
    k9: S,
    /// `bx*yc^2 + by*xc^2`
    k10: S,
    /// `J + m0*x0^2 + m0*y0^2`
    k11: S,
    /// `m0*y0`
    k12: S,
    /// `m0*x0`
    k13: S,
    /// `m1 + m2`
    k14: S,
    /// `m + m0 + m1 + m2`
    k15: S,
    /// `e*omega^2`
    k16: S,
    /// `m0*e*omega^2`
    k17: S,
    /// `m0*e*y0*omega^2`
    k18: S,
    /// `m0*e*x0*omega^2`
    k19: S,
    /// `2*cx`
    k20: S,
    /// `2*bx`
    k21: S,
    /// `2*cy`
    k22: S,
    /// `2*by`
    k23: S,
    /// `2*(cx*yc^2 + cy*xc^2)`
    k24: S,
    /// `2*(bx*yc^2 + by*xc^2)`
    k25: S,
    /// `e*y0*omega^2`
    k26: S,
    /// `e*x0*omega^2`
    k27: S,
    /// `2*e*y0*omega^2`
    k28: S,
    /// `2*e*x0*omega^2`
    k29: S,
    /// `4*e*x0*omega^2`
    k30: S,
    /// `4*e*y0*omega^2`
    k31: S,
    /// `0.25*m0`
    k32: S,
    /// `e*y0*omega`
    k33: S,
    /// `e*x0*omega`
    k34: S,
    /// `1/(J + m0*x0^2 + m0*y0^2)`
    k35: S,
    /// `1/(m1 + m2)`
    k36: S,
    /// Why these parameters leave the machine without accelerations, if they do.
    singular: Option<::lagrangian::Singular>,
}

/// Mass matrix `M`, row by row.
///
/// ```text
/// M[x, x] = m + m0 + m1 + m2
/// M[y, y] = m + m0 + m1 + m2
/// M[theta, x] = -m0*x0*theta - m0*y0
/// M[theta, y] = m0*x0 - m0*y0*theta
/// M[theta, theta] = m0*x0^2 + m0*y0^2 + J
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
    let (sin_phi1, cos_phi1) = phi1.sin_cos();
    let t0 = sin_phi1 * s1;
    let t1 = cos_phi1 * s1;
    let (sin_phi2, cos_phi2) = phi2.sin_cos();
    let t2 = p.m2 * s2;
    let t3 = cos_phi2 * s2;
    let t4 = sin_phi2 * s2;
    let zero = S::ZERO;
    let m31 = -(theta * p.k13 + p.k12);
    let m32 = p.k13 - theta * p.k12;
    let m41 = p.k14 * cos_phi1;
    let m42 = p.k14 * sin_phi1;
    let m51 = -(p.k14 * t0);
    let m52 = p.k14 * t1;
    let m55 = s1 * (p.k14 * s1);
    let m71 = cos_phi2 * p.m2;
    let m72 = p.m2 * sin_phi2;
    let m74 = p.m2 * (cos_phi1 * cos_phi2 + sin_phi1 * sin_phi2);
    let m75 = p.m2 * (t1 * sin_phi2 - t0 * cos_phi2);
    let m81 = -(sin_phi2 * t2);
    let m82 = cos_phi2 * t2;
    let m84 = p.m2 * (sin_phi1 * t3 - cos_phi1 * t4);
    let m85 = p.m2 * (t0 * t4 + t1 * t3);
    let m88 = s2 * t2;
    [
        [p.k15, zero, m31, m41, m51, zero, m71, m81, zero],
        [zero, p.k15, m32, m42, m52, zero, m72, m82, zero],
        [m31, m32, p.k11, zero, zero, zero, zero, zero, zero],
        [m41, m42, zero, p.k14, zero, zero, m74, m84, zero],
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
/// h[x] = -m0*x0*der(theta)^2 - 2*(m1 + m2)*sin(phi1)*der(s1)*der(phi1)
///     - (m1 + m2)*s1*cos(phi1)*der(phi1)^2 - 2*m2*sin(phi2)*der(s2)*der(phi2)
///     - m2*s2*cos(phi2)*der(phi2)^2 - m0*e*omega^2*cos(omega*t)
/// h[y] = 2*(m1 + m2)*cos(phi1)*der(s1)*der(phi1) - m0*y0*der(theta)^2
///     - (m1 + m2)*s1*sin(phi1)*der(phi1)^2 + 2*m2*cos(phi2)*der(s2)*der(phi2)
///     - m2*s2*sin(phi2)*der(phi2)^2 - m0*e*omega^2*sin(omega*t)
/// h[theta] = m0*e*x0*omega^2*cos(omega*t)*theta + m0*e*y0*omega^2*sin(omega*t)*theta
///     + m0*e*y0*omega^2*cos(omega*t) - m0*e*x0*omega^2*sin(omega*t)
/// h[s1] = …
/// h[phi1] = …
/// h[s2] = …
/// h[phi2] = …
/// ```
pub fn bias<S: ::lagrangian::Scalar>(p: &Prepared<S>, t: S, q: &[S; 9], v: &[S; 9]) -> [S; 9] {
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
    let (sin_phi2, cos_phi2) = phi2.sin_cos();
    let t0 = sin_phi2 * s2_dot;
    let t1 = t0 * phi2_dot;
    let t2 = phi2_dot * s2;
    let t3 = t2 * cos_phi2;
    let (sin_phi1, cos_phi1) = phi1.sin_cos();
    let t4 = sin_phi1 * s1_dot;
    let t5 = t4 * phi1_dot;
    let t6 = phi1_dot * s1;
    let t7 = t6 * cos_phi1;
    let t8 = t5 + (t5 + phi1_dot * t7);
    let t9 = t1 + (t1 + phi2_dot * t3) + t8;
    let t10 = t9 * p.m2 + t8 * p.m1;
    let t11 = theta_dot * theta_dot;
    let t12 = p.omega * t;
    let (sin_t12, cos_t12) = t12.sin_cos();
    let t13 = s2_dot * cos_phi2;
    let t14 = phi2_dot * t13;
    let t15 = sin_phi2 * t2;
    let t16 = s1_dot * cos_phi1;
    let t17 = phi1_dot * t16;
    let t18 = sin_phi1 * t6;
    let t19 = t17 + (t17 - phi1_dot * t18);
    let t20 = t14 + (t14 - phi2_dot * t15) + t19;
    let t21 = p.m2 * t20 + p.m1 * t19;
    let t22 = (x_dot - sin_t12 * p.k0) * (theta_dot * p.k13);
    let t23 = (y_dot + cos_t12 * p.k0) * (theta_dot * p.k12);
    let t24 = sin_t12 * p.k19 + (t23 - theta * (sin_t12 * p.k18));
    let t25 = y_dot + (t4 + t7);
    let t26 = t0 + t3 + t25;
    let t27 = p.m2 * t26 + p.m1 * t25;
    let t28 = t27 * (phi1_dot * cos_phi1);
    let t29 = x_dot + (t16 - t18);
    let t30 = t13 - t15 + t29;
    let t31 = p.m2 * t30 + p.m1 * t29;
    let t32 = t31 * (sin_phi1 * phi1_dot);
    let t33 = t21 * (s1 * cos_phi1) + t16 * t27 - t18 * t27;
    let t34 = sin_phi1 * (s1_dot * t31 + t6 * t27);
    let t35 = t33 - (t7 * t31 + t4 * t31 - t10 * (sin_phi1 * s1));
    let t36 = t26 * (phi2_dot * cos_phi2);
    let t37 = t30 * (sin_phi2 * phi2_dot);
    let t38 = sin_phi2 * (s2_dot * t30 + t2 * t26);
    let t39 = t20 * (s2 * cos_phi2) + t13 * t26 - t15 * t26;
    let t40 = t39 - (t3 * t30 + t0 * t30 - t9 * (sin_phi2 * s2));
    let h_x = -(t10 + (t11 * p.k13 + p.k17 * cos_t12));
    let h_y = t21 - (t11 * p.k12 + p.k17 * sin_t12);
    let h_theta = t22 + t23 - (t24 + (t22 - theta * (cos_t12 * p.k19) - cos_t12 * p.k18));
    let h_s1 = t28 + sin_phi1 * t21 - (t32 + cos_phi1 * t10) - (t28 - t32);
    let h_phi1 = t35 - (cos_phi1 * (s1_dot * t27 - t6 * t31) - t34);
    let zero = S::ZERO;
    let h_s2 = -(p.m2 * (t36 - t37 - (t36 + sin_phi2 * t20 - (t37 + cos_phi2 * t9))));
    let h_phi2 = -(p.m2 * (cos_phi2 * (s2_dot * t26 - t2 * t30) - t38 - t40));
    [h_x, h_y, h_theta, h_s1, h_phi1, zero, h_s2, h_phi2, zero]
}

/// Applied generalized forces `Q`.
///
/// ```text
/// Q[x] = -2*bx*der(x) - 2*cx*x
/// Q[y] = -2*by*der(y) - 2*cy*y
/// Q[theta] = -2*(bx*yc^2 + by*xc^2)*der(theta) - 2*(cx*yc^2 + cy*xc^2)*theta
/// ```
pub fn applied<S: ::lagrangian::Scalar>(p: &Prepared<S>, q: &[S; 9], v: &[S; 9]) -> [S; 9] {
    let x = q[0];
    let y = q[1];
    let theta = q[2];
    let x_dot = v[0];
    let y_dot = v[1];
    let theta_dot = v[2];
    let q_x = -(p.k21 * x_dot + p.k20 * x);
    let q_y = -(p.k23 * y_dot + p.k22 * y);
    let q_theta = -(p.k25 * theta_dot + p.k24 * theta);
    let zero = S::ZERO;
    [q_x, q_y, q_theta, zero, zero, zero, zero, zero, zero]
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
    let (sin_phi2, cos_phi2) = phi2.sin_cos();
    let t0 = sin_phi2 * s2_dot;
    let t1 = t0 * phi2_dot;
    let t2 = phi2_dot * s2;
    let t3 = t2 * cos_phi2;
    let (sin_phi1, cos_phi1) = phi1.sin_cos();
    let t4 = sin_phi1 * s1_dot;
    let t5 = t4 * phi1_dot;
    let t6 = phi1_dot * s1;
    let t7 = t6 * cos_phi1;
    let t8 = t5 + (t5 + phi1_dot * t7);
    let t9 = t1 + (t1 + phi2_dot * t3) + t8;
    let t10 = t9 * p.m2 + t8 * p.m1;
    let t11 = theta_dot * theta_dot;
    let t12 = p.omega * t;
    let (sin_t12, cos_t12) = t12.sin_cos();
    let t13 = s2_dot * cos_phi2;
    let t14 = phi2_dot * t13;
    let t15 = sin_phi2 * t2;
    let t16 = s1_dot * cos_phi1;
    let t17 = phi1_dot * t16;
    let t18 = sin_phi1 * t6;
    let t19 = t17 + (t17 - phi1_dot * t18);
    let t20 = t14 + (t14 - phi2_dot * t15) + t19;
    let t21 = p.m2 * t20 + p.m1 * t19;
    let t22 = (x_dot - sin_t12 * p.k0) * (theta_dot * p.k13);
    let t23 = (y_dot + cos_t12 * p.k0) * (theta_dot * p.k12);
    let t24 = sin_t12 * p.k19 + (t23 - theta * (sin_t12 * p.k18));
    let t25 = t22 + t23 - (t24 + (t22 - theta * (cos_t12 * p.k19) - cos_t12 * p.k18));
    let t26 = y_dot + (t4 + t7);
    let t27 = t0 + t3 + t26;
    let t28 = p.m2 * t27 + p.m1 * t26;
    let t29 = t28 * (phi1_dot * cos_phi1);
    let t30 = x_dot + (t16 - t18);
    let t31 = t13 - t15 + t30;
    let t32 = p.m2 * t31 + p.m1 * t30;
    let t33 = t32 * (sin_phi1 * phi1_dot);
    let t34 = sin_phi1 * (s1_dot * t32 + t6 * t28);
    let t35 = t21 * (s1 * cos_phi1) + t16 * t28 - t18 * t28;
    let t36 = t35 - (t7 * t32 + t4 * t32 - t10 * (sin_phi1 * s1));
    let t37 = t27 * (phi2_dot * cos_phi2);
    let t38 = t31 * (sin_phi2 * phi2_dot);
    let t39 = sin_phi2 * (s2_dot * t31 + t2 * t27);
    let t40 = t20 * (s2 * cos_phi2) + t13 * t27 - t15 * t27;
    let t41 = t40 - (t3 * t31 + t0 * t31 - t9 * (sin_phi2 * s2));
    let f_x = t10 + (t11 * p.k13 + p.k17 * cos_t12) - (p.k21 * x_dot + p.k20 * x);
    let f_y = t11 * p.k12 + p.k17 * sin_t12 - t21 - (p.k23 * y_dot + p.k22 * y);
    let f_theta = -(theta_dot * p.k25 + theta * p.k24 + t25);
    let f_s1 = t29 - t33 - (t29 + sin_phi1 * t21 - (t33 + cos_phi1 * t10));
    let f_phi1 = cos_phi1 * (s1_dot * t28 - t6 * t32) - t34 - t36;
    let zero = S::ZERO;
    let f_s2 = p.m2 * (t37 - t38 - (t37 + sin_phi2 * t20 - (t38 + cos_phi2 * t9)));
    let f_phi2 = p.m2 * (cos_phi2 * (s2_dot * t27 - t2 * t31) - t39 - t41);
    [f_x, f_y, f_theta, f_s1, f_phi1, zero, f_s2, f_phi2, zero]
}

/// Accelerations `a`, the solution of `M a = f`.
///
/// `M = L D Lᵀ` is eliminated without what is known to be zero; a pivot of `D` that vanishes is an
/// error.
pub fn accelerations<S: ::lagrangian::Scalar>(
    p: &Prepared<S>,
    t: S,
    q: &[S; 9],
    v: &[S; 9],
) -> Result<[S; 9], ::lagrangian::Singular> {
    if let Some(singular) = p.singular {
        return Err(singular);
    }
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
    let (sin_phi2, cos_phi2) = phi2.sin_cos();
    let t0 = sin_phi2 * s2_dot;
    let t1 = s2 * phi2_dot;
    let t2 = cos_phi2 * t1;
    let (sin_phi1, cos_phi1) = phi1.sin_cos();
    let t3 = sin_phi1 * s1_dot;
    let t4 = s1 * phi1_dot;
    let t5 = cos_phi1 * t4;
    let t6 = y_dot + (t3 + t5);
    let t7 = t0 + t2 + t6;
    let t8 = t7 * (cos_phi2 * phi2_dot);
    let t9 = cos_phi2 * s2_dot;
    let t10 = phi2_dot * t9;
    let t11 = sin_phi2 * t1;
    let t12 = cos_phi1 * s1_dot;
    let t13 = phi1_dot * t12;
    let t14 = sin_phi1 * t4;
    let t15 = t13 + (t13 - phi1_dot * t14);
    let t16 = t10 + (t10 - phi2_dot * t11) + t15;
    let t17 = x_dot + (t12 - t14);
    let t18 = t9 - t11 + t17;
    let t19 = t18 * (sin_phi2 * phi2_dot);
    let t20 = phi2_dot * t0;
    let t21 = phi1_dot * t3;
    let t22 = t21 + (t21 + phi1_dot * t5);
    let t23 = t20 + (t20 + phi2_dot * t2) + t22;
    let t24 = p.m2 * t7 + p.m1 * t6;
    let t25 = t24 * (cos_phi1 * phi1_dot);
    let t26 = p.m2 * t16 + p.m1 * t15;
    let t27 = p.m2 * t18 + t17 * p.m1;
    let t28 = t27 * (sin_phi1 * phi1_dot);
    let t29 = p.m2 * t23 + p.m1 * t22;
    let t30 = t25 - t28 - (t25 + sin_phi1 * t26 - (t28 + cos_phi1 * t29));
    let t31 = p.m2 * (cos_phi1 * cos_phi2 + sin_phi1 * sin_phi2);
    let t32 = p.k36 * t31;
    let t33 = p.m2 * (t8 - t19 - (t8 + sin_phi2 * t16 - (t19 + cos_phi2 * t23)));
    let t34 = p.k14 * cos_phi1;
    let t35 = p.k36 * t34;
    let t36 = p.omega * t;
    let (sin_t36, cos_t36) = t36.sin_cos();
    let t37 = (x_dot - sin_t36 * p.k0) * (p.k13 * theta_dot);
    let t38 = (y_dot + cos_t36 * p.k0) * (p.k12 * theta_dot);
    let t39 = p.k19 * sin_t36 + (t38 - theta * (sin_t36 * p.k18));
    let t40 = t37 + t38 - (t39 + (t37 - theta * (p.k19 * cos_t36) - p.k18 * cos_t36));
    let t41 = theta_dot * p.k25 + theta * p.k24 + t40;
    let t42 = p.k13 * theta + p.k12;
    let t43 = p.k35 * t42;
    let t44 = theta_dot * theta_dot;
    let t45 = t29 + (p.k13 * t44 + cos_t36 * p.k17) - (x_dot * p.k21 + p.k20 * x);
    let t46 = t45 - t43 * t41 - t35 * t30;
    let t47 = p.k15 - t42 * t43 - t34 * t35;
    if vanishes(t47, p.k15, 7.993605777301127e-15) {
        return Err(singular(0, t47, p.k15));
    }
    let t48 = S::ONE / t47;
    let t49 = p.k13 - theta * p.k12;
    let t50 = p.k35 * t49;
    let t51 = p.k14 * sin_phi1;
    let t52 = p.k36 * t51;
    let t53 = t42 * t50 - t34 * t52;
    let t54 = t48 * t53;
    let t55 = p.k12 * t44 + sin_t36 * p.k17 - t26 - (y_dot * p.k23 + p.k22 * y);
    let t56 = t50 * t41 + t55 - (t54 * t46 + t52 * t30);
    let t57 = p.k15 - t49 * t50 - (t53 * t54 + t51 * t52);
    if vanishes(t57, p.k15, 7.993605777301127e-15) {
        return Err(singular(1, t57, p.k15));
    }
    let t58 = S::ONE / t57;
    let t59 = p.m2 * cos_phi2 - t34 * t32;
    let t60 = t48 * t59;
    let t61 = p.m2 * sin_phi2 - t51 * t32 - t53 * t60;
    let t62 = t58 * t61;
    let t63 = sin_phi1 * (s1_dot * t27 + t4 * t24);
    let t64 = cos_phi1 * s1;
    let t65 = sin_phi1 * s1;
    let t66 = t64 * t26 + t12 * t24 - t14 * t24 - (t27 * t5 + t27 * t3 - t65 * t29);
    let t67 = p.k14 * t65;
    let t68 = t48 * t67;
    let t69 = t53 * t68 + p.k14 * t64;
    let t70 = t58 * t69;
    let t71 = t68 * t46 + (cos_phi1 * (s1_dot * t24 - t4 * t27) - t63 - t66);
    let t72 = t71 - t70 * t56;
    let t73 = s1 * (p.k14 * s1);
    let t74 = t73 - t67 * t68 - t69 * t70;
    if vanishes(t74, t73, 7.993605777301127e-15) {
        return Err(singular(4, t74, t73));
    }
    let t75 = S::ONE / t74;
    let t76 = t67 * t60 + p.m2 * (t64 * sin_phi2 - t65 * cos_phi2) - t69 * t62;
    let t77 = t75 * t76;
    let t78 = t33 - t32 * t30 - (t62 * t56 + t60 * t46) - t77 * t72;
    let t79 = p.m2 - t31 * t32 - (t61 * t62 + t59 * t60) - t76 * t77;
    if vanishes(t79, p.m2, 7.993605777301127e-15) {
        return Err(singular(6, t79, p.m2));
    }
    let t80 = S::ONE / t79;
    let t81 = cos_phi2 * s2;
    let t82 = sin_phi2 * s2;
    let t83 = p.m2 * (sin_phi1 * t81 - cos_phi1 * t82);
    let t84 = p.k36 * t83;
    let t85 = t34 * t84 + p.m2 * t82;
    let t86 = t48 * t85;
    let t87 = t53 * t86 + p.m2 * t81 - t51 * t84;
    let t88 = t58 * t87;
    let t89 = p.m2 * (t65 * t82 + t64 * t81) - t67 * t86 - t69 * t88;
    let t90 = t75 * t89;
    let t91 = t61 * t88 + t31 * t84 + (t76 * t90 - t59 * t86);
    let t92 = t80 * t91;
    let t93 = sin_phi2 * (s2_dot * t18 + t1 * t7);
    let t94 = t81 * t16 + t9 * t7 - t11 * t7 - (t18 * t2 + t18 * t0 - t82 * t23);
    let t95 = t86 * t46 + p.m2 * (cos_phi2 * (s2_dot * t7 - t1 * t18) - t93 - t94);
    let t96 = s2 * (p.m2 * s2);
    let t97 = t96 - t83 * t84 - (t87 * t88 + t85 * t86) - (t91 * t92 + t89 * t90);
    if vanishes(t97, t96, 7.993605777301127e-15) {
        return Err(singular(7, t97, t96));
    }
    let phi2_ddot = (t95 + (t92 * t78 - t84 * t30) - (t90 * t72 + t88 * t56)) / t97;
    let s2_ddot = t92 * phi2_ddot + t80 * t78;
    let phi1_ddot = t75 * t72 - t77 * s2_ddot - t90 * phi2_ddot;
    let y_ddot = t58 * t56 - t70 * phi1_ddot - (t88 * phi2_ddot + t62 * s2_ddot);
    let t98 = t68 * phi1_ddot + t48 * t46 + (t86 * phi2_ddot - t54 * y_ddot);
    let x_ddot = t98 - t60 * s2_ddot;
    let t99 = t52 * y_ddot + t35 * x_ddot + (t84 * phi2_ddot + t32 * s2_ddot);
    let theta_ddot = t43 * x_ddot - t50 * y_ddot - p.k35 * t41;
    let s1_ddot = p.k36 * t30 - t99;
    let zero = S::ZERO;
    let accelerations = [
        x_ddot, y_ddot, theta_ddot, s1_ddot, phi1_ddot, zero, s2_ddot, phi2_ddot, zero,
    ];
    Ok(accelerations)
}

/// Kinetic energy `T`, in J.
///
/// ```text
/// T = …
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
    let t0 = phi2_dot * s2;
    let (sin_phi2, cos_phi2) = phi2.sin_cos();
    let t1 = phi1_dot * s1;
    let (sin_phi1, cos_phi1) = phi1.sin_cos();
    let t2 = y_dot + (t1 * cos_phi1 + sin_phi1 * s1_dot);
    let t3 = t0 * cos_phi2 + sin_phi2 * s2_dot + t2;
    let t4 = x_dot + (cos_phi1 * s1_dot - t1 * sin_phi1);
    let t5 = cos_phi2 * s2_dot - t0 * sin_phi2 + t4;
    let t6 = (t3 * t3 + t5 * t5) * p.m2 + theta2_dot * (theta2_dot * p.J2);
    let t7 = (t2 * t2 + t4 * t4) * p.m1 + theta1_dot * (theta1_dot * p.J1);
    let t8 = theta_dot * theta;
    let t9 = p.omega * t;
    let (sin_t9, cos_t9) = t9.sin_cos();
    let t10 = y_dot + p.k0 * cos_t9;
    let t11 = theta_dot * theta_dot;
    let t12 = x_dot - p.k0 * sin_t9;
    let t13 = t11 * p.k7 - t8 * (p.k4 * t10) + (t11 * p.k6 - t8 * (p.k5 * t12));
    let t14 = p.k8 * t13 + S::from_f64(0.5) * ((t10 * t10 + t12 * t12) * p.m0 + p.k1);
    let t15 = t14 - p.k8 * (t12 * (theta_dot * p.k4) - t10 * (theta_dot * p.k5));
    let t16 = t15 + (p.k3 * (y_dot * y_dot + x_dot * x_dot) + t11 * p.k2);
    t16 + (S::from_f64(0.5) * t6 + S::from_f64(0.5) * t7)
}

/// Potential energy `V`, in J.
///
/// ```text
/// V = cx*x^2 + cy*y^2 + (cx*yc^2 + cy*xc^2)*theta^2
/// ```
pub fn potential_energy<S: ::lagrangian::Scalar>(p: &Prepared<S>, q: &[S; 9]) -> S {
    let x = q[0];
    let y = q[1];
    let theta = q[2];
    theta * (theta * p.k9) + (y * (y * p.cy) + x * (x * p.cx))
}

/// Dissipation function `D`, in W.
///
/// ```text
/// D = bx*der(x)^2 + by*der(y)^2 + (bx*yc^2 + by*xc^2)*der(theta)^2
/// ```
pub fn dissipation<S: ::lagrangian::Scalar>(p: &Prepared<S>, v: &[S; 9]) -> S {
    let x_dot = v[0];
    let y_dot = v[1];
    let theta_dot = v[2];
    let t0 = y_dot * (y_dot * p.by) + x_dot * (x_dot * p.bx);
    theta_dot * (theta_dot * p.k10) + t0
}

/// Power that drives, forces and inputs put in, in W.
///
/// ```text
/// P = …
/// ```
pub fn work_rate<S: ::lagrangian::Scalar>(
    p: &Prepared<S>,
    t: S,
    q: &[S; 9],
    v: &[S; 9],
    a: &[S; 9],
) -> S {
    let theta = q[2];
    let x_dot = v[0];
    let y_dot = v[1];
    let theta_dot = v[2];
    let x_ddot = a[0];
    let y_ddot = a[1];
    let theta_ddot = a[2];
    let t0 = p.omega * t;
    let (sin_t0, cos_t0) = t0.sin_cos();
    let t1 = sin_t0 * p.k16;
    let t2 = cos_t0 * p.k0;
    let t3 = t2 + y_dot;
    let t4 = sin_t0 * p.k0;
    let t5 = cos_t0 * p.k16;
    let t6 = x_dot - t4;
    let t7 = cos_t0 * theta_dot;
    let t8 = theta_dot * sin_t0;
    let t9 = t8 * p.k27 - theta_ddot * (cos_t0 * p.k34);
    let t10 = t1 * t3 - t2 * (y_ddot - t1) + (t4 * (x_ddot - t5) + t5 * t6);
    let t11 = theta * t8;
    let t12 = theta_ddot * theta;
    let t13 = theta * t7;
    let t14 = t12 * (sin_t0 * p.k34) + (t8 * (theta_dot * p.k34) + t13 * p.k27);
    let t15 = t11 * p.k26 - t7 * (p.k33 * theta_dot) - t12 * (p.k33 * cos_t0) + t14;
    let t16 = (sin_t0 * t3 + cos_t0 * t6) * p.k17 - (t7 * p.k28 - t8 * p.k29) * p.k8;
    let t17 = (t10 - (theta_ddot * (p.k33 * sin_t0) + t7 * p.k26 - t9) - t15) * p.m0;
    t16 - p.k32 * (t11 * p.k31 + t13 * p.k30) - t17
}

/// Power that dampers take out, in W.
///
/// ```text
/// P = 2*bx*der(x)^2 + 2*by*der(y)^2 + 2*(bx*yc^2 + by*xc^2)*der(theta)^2
/// ```
pub fn dissipation_rate<S: ::lagrangian::Scalar>(p: &Prepared<S>, v: &[S; 9]) -> S {
    let x_dot = v[0];
    let y_dot = v[1];
    let theta_dot = v[2];
    let t0 = y_dot * (y_dot * p.k23) + x_dot * (x_dot * p.k21);
    theta_dot * (theta_dot * p.k25) + t0
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
const PARAMETERS: [(&str, &str); 18] = [
    ("m", "kg"),
    ("m0", "kg"),
    ("m1", "kg"),
    ("m2", "kg"),
    ("J", "kg*m^2"),
    ("J0", "kg*m^2"),
    ("J1", "kg*m^2"),
    ("J2", "kg*m^2"),
    ("e", "m"),
    ("x0", "m"),
    ("y0", "m"),
    ("omega", "rad/s"),
    ("cx", "N/m"),
    ("cy", "N/m"),
    ("bx", "N*s/m"),
    ("by", "N*s/m"),
    ("xc", "m"),
    ("yc", "m"),
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

impl ::lagrangian::Machine for SmallAngleCrusher {
    type System = Prepared;

    fn name(&self) -> &str {
        "SmallAngleCrusher"
    }

    fn parameters(&self) -> impl ExactSizeIterator<Item = (::lagrangian::Quantity<'_>, f64)> {
        let values = [
            self.m, self.m0, self.m1, self.m2, self.J, self.J0, self.J1, self.J2, self.e, self.x0,
            self.y0, self.omega, self.cx, self.cy, self.bx, self.by, self.xc, self.yc,
        ];
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
        *result = accelerations(self, t, q, v)?;
        Ok(())
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

/// Whether elimination has left nothing but rounding errors of a diagonal element; so too if it is
/// no number.
fn vanishes<S: ::lagrangian::Scalar>(pivot: S, diagonal: S, share: f64) -> bool {
    !pivot.exceeds(S::from_f64(share) * diagonal)
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
