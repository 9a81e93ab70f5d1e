// @generated from machines/frozen_crusher.machine by `cargo xtask generate`; edits are lost.

//! The crusher as the paper treats its platform: «taking sin θ ≈ 0, cos θ ≈ 1» in the velocities.
//!
//! The axis of the debalance then moves as if the platform were not turned, so that all inertia of
//! the platform is constant: no products θ θ″ and θ′² are left in its equations, and without
//! contact they are those of a linear, forced oscillator of three coordinates. The suspension is
//! the two pairs of the exact machine. Turned by 0.04 rad at 0.9 rad/s, the platform's
//! accelerations
//! differ from the exact ones by 0.003 m/s² of 158, and by 0.7 rad/s² of 24.
//!
//! 9 coordinates, 18 parameters. Arithmetic of one call:
//!
//! | function | mul | add | div | sin cos | other | temporaries |
//! | --- | --: | --: | --: | --: | --: | --: |
//! | `prepare` | 24 | 8 | 2 | 0 | 0 | 34 |
//! | `mass_matrix` | 28 | 6 | 0 | 2 | 0 | 38 |
//! | `bias` | 76 | 58 | 0 | 3 | 0 | 140 |
//! | `applied` | 12 | 23 | 0 | 0 | 0 | 35 |
//! | `forces` | 88 | 80 | 0 | 3 | 0 | 174 |
//! | `accelerations` | 194 | 148 | 5 | 3 | 0 | 353 |
//! | `kinetic_energy` | 37 | 25 | 0 | 3 | 0 | 68 |
//! | `potential_energy` | 10 | 7 | 0 | 0 | 0 | 17 |
//! | `dissipation` | 10 | 7 | 0 | 0 | 0 | 17 |
//! | `work_rate` | 20 | 15 | 0 | 1 | 0 | 37 |
//! | `dissipation_rate` | 10 | 7 | 0 | 0 | 0 | 17 |
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

/// The crusher as the paper treats its platform: «taking sin θ ≈ 0, cos θ ≈ 1» in the velocities.
///
/// The axis of the debalance then moves as if the platform were not turned, so that all inertia of
/// the platform is constant: no products θ θ″ and θ′² are left in its equations, and without
/// contact they are those of a linear, forced oscillator of three coordinates. The suspension is
/// the two pairs of the exact machine. Turned by 0.04 rad at 0.9 rad/s, the platform's
/// accelerations
/// differ from the exact ones by 0.003 m/s² of 158, and by 0.7 rad/s² of 24.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrozenCrusher<S = f64> {
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

impl Default for FrozenCrusher {
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

impl<S> FrozenCrusher<S> {
    /// The same over other numbers.
    pub fn map<R>(self, f: impl Fn(S) -> R) -> FrozenCrusher<R> {
        FrozenCrusher {
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

impl<S: ::lagrangian::Scalar> FrozenCrusher<S> {
    /// Computes what depends on the parameters alone, once.
    pub fn prepare(&self) -> Prepared<S> {
        let k0 = self.omega * self.e;
        let k6 = self.m1 + self.m2;
        let k7 = k6 + (self.m + self.m0);
        let k8 = self.m0 * self.x0;
        let t0 = self.m0 * self.y0;
        let k9 = self.y0 * t0 + (self.J + self.x0 * k8);
        let k10 = self.omega * k0;
        let k22 = S::ONE / k9;
        let k19 = t0 * k22;
        let k20 = k8 * k22;
        let k1 = self.omega * (self.omega * self.J0);
        let k2 = self.cx * S::from_f64(0.5);
        let k3 = self.cy * S::from_f64(0.5);
        let k4 = self.bx * S::from_f64(0.5);
        let k5 = self.by * S::from_f64(0.5);
        let k11 = self.m0 * k10;
        let k12 = k8 * k10;
        let k13 = t0 * k10;
        let k14 = self.cy * self.xc;
        let k15 = self.cx * self.yc;
        let k16 = self.by * self.xc;
        let k17 = self.bx * self.yc;
        let k18 = -t0;
        let k21 = k8 * k19;
        let k23 = S::ONE / k6;
        let k24 = k7 - t0 * k19;
        let k25 = k7 - k8 * k20;
        let singular = if vanishes(self.J1, self.J1, 7.993605777301127e-15) {
            Some(singular(5, self.J1, self.J1))
        } else if vanishes(self.J2, self.J2, 7.993605777301127e-15) {
            Some(singular(8, self.J2, self.J2))
        } else if vanishes(k9, k9, 7.993605777301127e-15) {
            Some(singular(2, k9, k9))
        } else if vanishes(k6, k6, 7.993605777301127e-15) {
            Some(singular(3, k6, k6))
        } else {
            None
        };
        Prepared {
            m: self.m,
            m0: self.m0,
            m1: self.m1,
            m2: self.m2,
            J: self.J,
            J1: self.J1,
            J2: self.J2,
            x0: self.x0,
            y0: self.y0,
            omega: self.omega,
            cx: self.cx,
            cy: self.cy,
            bx: self.bx,
            by: self.by,
            xc: self.xc,
            yc: self.yc,
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

/// The coordinates of [`FrozenCrusher`], or their rates, by name.
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

/// What can be set while a [`FrozenCrusher`] runs.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Inputs {}

/// What can be observed of a [`FrozenCrusher`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Outputs {}

/// The parameters of a [`FrozenCrusher`], with the work done that depends on them alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prepared<S = f64> {
    /// `m`
    m: S,
    /// `m0`
    m0: S,
    /// `m1`
    m1: S,
    /// `m2`
    m2: S,
    /// `J`
    J: S,
    /// `J1`
    J1: S,
    /// `J2`
    J2: S,
    /// `x0`
    x0: S,
    /// `y0`
    y0: S,
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
    /// `xc`
    xc: S,
    /// `yc`
    yc: S,
    /// `e*omega`
    k0: S,
    /// `J0*omega^2`
    k1: S,
    /// `0.5*cx`
    k2: S,
    /// `0.5*cy`
    k3: S,
    /// `0.5*bx`
    k4: S,
    /// `0.5*by`
    k5: S,
    /// `m1 + m2`
    k6: S,
    /// `m + m0 + m1 + m2`
    k7: S,
    /// `m0*x0`
    k8: S,
    /// `J + m0*x0^2 + m0*y0^2`
    k9: S,
    /// `e*omega^2`
    k10: S,
    /// `m0*e*omega^2`
    k11: S,
    /// `m0*e*x0*omega^2`
    k12: S,
    /// `m0*e*y0*omega^2`
    k13: S,
    /// `cy*xc`
    k14: S,
    /// `cx*yc`
    k15: S,
    /// `by*xc`
    k16: S,
    /// `bx*yc`
    k17: S,
    /// `-m0*y0`
    k18: S,
    /// `m0*y0/(J + m0*x0^2 + m0*y0^2)`
    k19: S,
    /// `m0*x0/(J + m0*x0^2 + m0*y0^2)`
    k20: S,
    /// `m0^2*x0*y0/(J + m0*x0^2 + m0*y0^2)`
    k21: S,
    /// `1/(J + m0*x0^2 + m0*y0^2)`
    k22: S,
    /// `1/(m1 + m2)`
    k23: S,
    /// `m + m0 + m1 + m2 - m0^2*y0^2/(J + m0*x0^2 + m0*y0^2)`
    k24: S,
    /// `m + m0 + m1 + m2 - m0^2*x0^2/(J + m0*x0^2 + m0*y0^2)`
    k25: S,
    /// Why these parameters leave the machine without accelerations, if they do.
    singular: Option<::lagrangian::Singular>,
}

/// Mass matrix `M`, row by row.
///
/// ```text
/// M[x, x] = m + m0 + m1 + m2
/// M[y, y] = m + m0 + m1 + m2
/// M[theta, x] = -m0*y0
/// M[theta, y] = m0*x0
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
    let m41 = p.k6 * cos_phi1;
    let m42 = p.k6 * sin_phi1;
    let m51 = -(p.k6 * t0);
    let m52 = p.k6 * t1;
    let m55 = s1 * (p.k6 * s1);
    let m71 = cos_phi2 * p.m2;
    let m72 = sin_phi2 * p.m2;
    let m74 = p.m2 * (cos_phi1 * cos_phi2 + sin_phi1 * sin_phi2);
    let m75 = p.m2 * (t1 * sin_phi2 - t0 * cos_phi2);
    let m81 = -(sin_phi2 * t2);
    let m82 = cos_phi2 * t2;
    let m84 = p.m2 * (sin_phi1 * t3 - cos_phi1 * t4);
    let m85 = p.m2 * (t0 * t4 + t1 * t3);
    let m88 = s2 * t2;
    [
        [p.k7, zero, p.k18, m41, m51, zero, m71, m81, zero],
        [zero, p.k7, p.k8, m42, m52, zero, m72, m82, zero],
        [p.k18, p.k8, p.k9, zero, zero, zero, zero, zero, zero],
        [m41, m42, zero, p.k6, zero, zero, m74, m84, zero],
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
/// h[x] = -2*(m1 + m2)*sin(phi1)*der(s1)*der(phi1) - (m1 + m2)*s1*cos(phi1)*der(phi1)^2
///     - 2*m2*sin(phi2)*der(s2)*der(phi2) - m2*s2*cos(phi2)*der(phi2)^2 - m0*e*omega^2*cos(omega*t)
/// h[y] = 2*(m1 + m2)*cos(phi1)*der(s1)*der(phi1) - (m1 + m2)*s1*sin(phi1)*der(phi1)^2
///     + 2*m2*cos(phi2)*der(s2)*der(phi2) - m2*s2*sin(phi2)*der(phi2)^2 - m0*e*omega^2*sin(omega*t)
/// h[theta] = m0*e*y0*omega^2*cos(omega*t) - m0*e*x0*omega^2*sin(omega*t)
/// h[s1] = …
/// h[phi1] = …
/// h[s2] = …
/// h[phi2] = …
/// ```
pub fn bias<S: ::lagrangian::Scalar>(p: &Prepared<S>, t: S, q: &[S; 9], v: &[S; 9]) -> [S; 9] {
    let s1 = q[3];
    let phi1 = q[4];
    let s2 = q[6];
    let phi2 = q[7];
    let x_dot = v[0];
    let y_dot = v[1];
    let s1_dot = v[3];
    let phi1_dot = v[4];
    let s2_dot = v[6];
    let phi2_dot = v[7];
    let (sin_phi2, cos_phi2) = phi2.sin_cos();
    let t0 = sin_phi2 * s2_dot;
    let t1 = t0 * phi2_dot;
    let t2 = phi2_dot * s2;
    let t3 = cos_phi2 * t2;
    let (sin_phi1, cos_phi1) = phi1.sin_cos();
    let t4 = sin_phi1 * s1_dot;
    let t5 = t4 * phi1_dot;
    let t6 = phi1_dot * s1;
    let t7 = cos_phi1 * t6;
    let t8 = t5 + (t5 + phi1_dot * t7);
    let t9 = t1 + (t1 + phi2_dot * t3) + t8;
    let t10 = t9 * p.m2 + t8 * p.m1;
    let t11 = p.omega.product_error(t);
    let t12 = p.omega * t;
    let (sin_t12, cos_t12) = t12.sin_cos();
    let t13 = cos_t12 - t11 * sin_t12;
    let t14 = cos_phi2 * s2_dot;
    let t15 = phi2_dot * t14;
    let t16 = sin_phi2 * t2;
    let t17 = cos_phi1 * s1_dot;
    let t18 = phi1_dot * t17;
    let t19 = sin_phi1 * t6;
    let t20 = t18 + (t18 - phi1_dot * t19);
    let t21 = t15 + (t15 - phi2_dot * t16) + t20;
    let t22 = p.m2 * t21 + p.m1 * t20;
    let t23 = sin_t12 + t11 * cos_t12;
    let t24 = t4 + t7 + y_dot;
    let t25 = t0 + t3 + t24;
    let t26 = p.m2 * t25 + p.m1 * t24;
    let t27 = t26 * (cos_phi1 * phi1_dot);
    let t28 = t17 - t19 + x_dot;
    let t29 = t14 - t16 + t28;
    let t30 = p.m2 * t29 + p.m1 * t28;
    let t31 = t30 * (sin_phi1 * phi1_dot);
    let t32 = t22 * (cos_phi1 * s1) + t17 * t26 - t19 * t26;
    let t33 = sin_phi1 * (s1_dot * t30 + t6 * t26);
    let t34 = t32 - (t7 * t30 + t4 * t30 - t10 * (sin_phi1 * s1));
    let t35 = t25 * (cos_phi2 * phi2_dot);
    let t36 = t29 * (sin_phi2 * phi2_dot);
    let t37 = sin_phi2 * (s2_dot * t29 + t2 * t25);
    let t38 = t21 * (cos_phi2 * s2) + t14 * t25 - t16 * t25;
    let t39 = t38 - (t3 * t29 + t0 * t29 - t9 * (sin_phi2 * s2));
    let h_x = -(p.k11 * t13 + t10);
    let h_y = t22 - p.k11 * t23;
    let h_theta = t13 * p.k13 - t23 * p.k12;
    let h_s1 = t27 + sin_phi1 * t22 - (t31 + cos_phi1 * t10) - (t27 - t31);
    let h_phi1 = t34 - (cos_phi1 * (s1_dot * t26 - t6 * t30) - t33);
    let zero = S::ZERO;
    let h_s2 = -(p.m2 * (t35 - t36 - (t35 + sin_phi2 * t21 - (t36 + cos_phi2 * t9))));
    let h_phi2 = -(p.m2 * (cos_phi2 * (s2_dot * t25 - t2 * t29) - t37 - t39));
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
    let t0 = theta_dot * p.yc;
    let t1 = t0 + x_dot;
    let t2 = x_dot - t0;
    let t3 = p.yc * theta;
    let t4 = t3 + x;
    let t5 = x - t3;
    let t6 = theta_dot * p.xc;
    let t7 = t6 + y_dot;
    let t8 = y_dot - t6;
    let t9 = theta * p.xc;
    let t10 = t9 + y;
    let t11 = y - t9;
    let t12 = p.k15 * (t5 - t4) + p.k14 * (t11 - t10);
    let q_x = -((t1 + t2) * p.bx + (t4 + t5) * p.cx);
    let q_y = -((t7 + t8) * p.by + (t10 + t11) * p.cy);
    let q_theta = p.k17 * (t2 - t1) + p.k16 * (t8 - t7) + t12;
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
    let t3 = cos_phi2 * t2;
    let (sin_phi1, cos_phi1) = phi1.sin_cos();
    let t4 = sin_phi1 * s1_dot;
    let t5 = t4 * phi1_dot;
    let t6 = phi1_dot * s1;
    let t7 = cos_phi1 * t6;
    let t8 = t5 + (t5 + phi1_dot * t7);
    let t9 = t1 + (t1 + phi2_dot * t3) + t8;
    let t10 = t9 * p.m2 + t8 * p.m1;
    let t11 = p.omega.product_error(t);
    let t12 = p.omega * t;
    let (sin_t12, cos_t12) = t12.sin_cos();
    let t13 = cos_t12 - t11 * sin_t12;
    let t14 = theta_dot * p.yc;
    let t15 = t14 + x_dot;
    let t16 = x_dot - t14;
    let t17 = p.yc * theta;
    let t18 = t17 + x;
    let t19 = x - t17;
    let t20 = theta_dot * p.xc;
    let t21 = t20 + y_dot;
    let t22 = y_dot - t20;
    let t23 = theta * p.xc;
    let t24 = t23 + y;
    let t25 = y - t23;
    let t26 = cos_phi2 * s2_dot;
    let t27 = phi2_dot * t26;
    let t28 = sin_phi2 * t2;
    let t29 = cos_phi1 * s1_dot;
    let t30 = phi1_dot * t29;
    let t31 = sin_phi1 * t6;
    let t32 = t30 + (t30 - phi1_dot * t31);
    let t33 = t27 + (t27 - phi2_dot * t28) + t32;
    let t34 = p.m2 * t33 + p.m1 * t32;
    let t35 = sin_t12 + t11 * cos_t12;
    let t36 = p.k15 * (t19 - t18) + p.k14 * (t25 - t24);
    let t37 = p.k17 * (t16 - t15) + p.k16 * (t22 - t21) + t36;
    let t38 = y_dot + (t4 + t7);
    let t39 = t0 + t3 + t38;
    let t40 = p.m2 * t39 + p.m1 * t38;
    let t41 = t40 * (cos_phi1 * phi1_dot);
    let t42 = x_dot + (t29 - t31);
    let t43 = t26 - t28 + t42;
    let t44 = p.m2 * t43 + p.m1 * t42;
    let t45 = t44 * (sin_phi1 * phi1_dot);
    let t46 = sin_phi1 * (s1_dot * t44 + t6 * t40);
    let t47 = t34 * (cos_phi1 * s1) + t29 * t40 - t31 * t40;
    let t48 = t47 - (t7 * t44 + t4 * t44 - t10 * (sin_phi1 * s1));
    let t49 = t39 * (cos_phi2 * phi2_dot);
    let t50 = t43 * (sin_phi2 * phi2_dot);
    let t51 = sin_phi2 * (s2_dot * t43 + t2 * t39);
    let t52 = t33 * (cos_phi2 * s2) + t26 * t39 - t28 * t39;
    let t53 = t52 - (t3 * t43 + t0 * t43 - t9 * (sin_phi2 * s2));
    let f_x = p.k11 * t13 + t10 - ((t15 + t16) * p.bx + (t18 + t19) * p.cx);
    let f_y = -((t21 + t22) * p.by + (t24 + t25) * p.cy + (t34 - p.k11 * t35));
    let f_theta = t37 - (t13 * p.k13 - t35 * p.k12);
    let f_s1 = t41 - t45 - (t41 + sin_phi1 * t34 - (t45 + cos_phi1 * t10));
    let f_phi1 = cos_phi1 * (s1_dot * t40 - t6 * t44) - t46 - t48;
    let zero = S::ZERO;
    let f_s2 = p.m2 * (t49 - t50 - (t49 + sin_phi2 * t33 - (t50 + cos_phi2 * t9)));
    let f_phi2 = p.m2 * (cos_phi2 * (s2_dot * t39 - t2 * t43) - t51 - t53);
    [f_x, f_y, f_theta, f_s1, f_phi1, zero, f_s2, f_phi2, zero]
}

/// Accelerations `a`, the solution of `M a = f`.
///
/// `M = L D Lᵀ` is eliminated without what is known to be zero; a pivot of `D` that vanishes is an
/// error.
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
        let t0 = n(p.omega) * n(t);
        let angles = [phi2, phi1, t0];
        let circular = N::sin_cos_all(angles);
        let (sin_phi2, cos_phi2) = circular[0];
        let (sin_phi1, cos_phi1) = circular[1];
        let (sin_t0, cos_t0) = circular[2];
        let t1 = sin_phi2 * s2_dot;
        let t2 = s2 * phi2_dot;
        let t3 = cos_phi2 * t2;
        let t4 = sin_phi1 * s1_dot;
        let t5 = s1 * phi1_dot;
        let t6 = cos_phi1 * t5;
        let t7 = y_dot + (t4 + t6);
        let t8 = t1 + t3 + t7;
        let t9 = n(p.m2).mul_add(t8, n(p.m1) * t7);
        let t10 = t9 * (cos_phi1 * phi1_dot);
        let t11 = cos_phi2 * s2_dot;
        let t12 = phi2_dot * t11;
        let t13 = sin_phi2 * t2;
        let t14 = cos_phi1 * s1_dot;
        let t15 = phi1_dot * t14;
        let t16 = sin_phi1 * t5;
        let t17 = t15 + phi1_dot.neg_mul_add(t16, t15);
        let t18 = t12 + phi2_dot.neg_mul_add(t13, t12) + t17;
        let t19 = n(p.m2).mul_add(t18, n(p.m1) * t17);
        let t20 = x_dot + (t14 - t16);
        let t21 = t11 - t13 + t20;
        let t22 = n(p.m2).mul_add(t21, t20 * n(p.m1));
        let t23 = t22 * (sin_phi1 * phi1_dot);
        let t24 = phi2_dot * t1;
        let t25 = phi1_dot * t4;
        let t26 = t25 + phi1_dot.mul_add(t6, t25);
        let t27 = t24 + phi2_dot.mul_add(t3, t24) + t26;
        let t28 = n(p.m2).mul_add(t27, n(p.m1) * t26);
        let t29 = sin_phi1.mul_add(t19, t10) - cos_phi1.mul_add(t28, t23);
        let t30 = t10 - t23 - t29;
        let t31 = n(p.k6) * cos_phi1;
        let t32 = n(p.k23) * t31;
        let t33 = n(p.omega).product_error(n(t));
        let t34 = t33.neg_mul_add(sin_t0, cos_t0);
        let t35 = theta_dot * n(p.yc);
        let t36 = t35 + x_dot;
        let t37 = x_dot - t35;
        let t38 = n(p.yc) * theta;
        let t39 = t38 + x;
        let t40 = x - t38;
        let t41 = (t36 + t37).mul_add(n(p.bx), (t39 + t40) * n(p.cx));
        let t42 = theta_dot * n(p.xc);
        let t43 = y_dot - t42;
        let t44 = t42 + y_dot;
        let t45 = n(p.xc) * theta;
        let t46 = y - t45;
        let t47 = t45 + y;
        let t48 = n(p.k15).mul_add(t40 - t39, n(p.k14) * (t46 - t47));
        let t49 = t33.mul_add(cos_t0, sin_t0);
        let t50 = n(p.k17).mul_add(t37 - t36, n(p.k16) * (t43 - t44)) + t48;
        let t51 = t34.mul_sub(n(p.k13), t49 * n(p.k12)) - t50;
        let t52 = t32.neg_mul_add(t30, t34.mul_add(n(p.k11), t28) - t41);
        let t53 = t51.neg_mul_add(n(p.k19), t52);
        let t54 = t31 * t32;
        let t55 = N::ONE / (t54 - n(p.k24));
        let t56 = n(p.m2) * cos_phi1.mul_add(cos_phi2, sin_phi1 * sin_phi2);
        let t57 = n(p.k23) * t56;
        let t58 = t31.neg_mul_add(t57, n(p.m2) * cos_phi2);
        let t59 = t55 * t58;
        let t60 = t8 * (cos_phi2 * phi2_dot);
        let t61 = t21 * (sin_phi2 * phi2_dot);
        let t62 = sin_phi2.mul_add(t18, t60) - cos_phi2.mul_add(t27, t61);
        let t63 = n(p.k6) * sin_phi1;
        let t64 = n(p.k23) * t63;
        let t65 = (t44 + t43).mul_add(n(p.by), (t47 + t46) * n(p.cy));
        let t66 = t31.neg_mul_add(t64, n(p.k21));
        let t67 = t55 * t66;
        let t68 = t64.mul_add(t30, t65 + t49.neg_mul_add(n(p.k11), t19));
        let t69 = t68 - t67.mul_add(t53, n(p.k20) * t51);
        let t70 = t66 * t67;
        let t71 = t63.mul_sub(t64, n(p.k25));
        let t72 = N::ONE / (t71 - t70);
        let t73 = t63.neg_mul_add(t57, t66.mul_add(t59, n(p.m2) * sin_phi2));
        let t74 = t72 * t73;
        let t75 = t59.mul_add(t53, n(p.m2) * (t60 - t61 - t62));
        let t76 = sin_phi1 * s1_dot.mul_add(t22, t5 * t9);
        let t77 = cos_phi1 * s1;
        let t78 = sin_phi1 * s1;
        let t79 = t78.neg_mul_add(t28, t22.mul_add(t6, t22 * t4));
        let t80 = t16.neg_mul_add(t9, t77.mul_add(t19, t14 * t9)) - t79;
        let t81 = n(p.k6) * t78;
        let t82 = t55 * t81;
        let t83 = cos_phi1.mul_sub(s1_dot.mul_sub(t9, t5 * t22), t76) - t80;
        let t84 = t66.neg_mul_add(t82, n(p.k6) * t77);
        let t85 = t72 * t84;
        let t86 = t85.neg_mul_add(t69, t82.neg_mul_add(t53, t83));
        let t87 = s1 * (n(p.k6) * s1);
        let t88 = t84.mul_add(t85, t81.mul_add(t82, t87));
        let t89 = N::ONE / t88;
        let t90 = n(p.m2) * t77.mul_sub(sin_phi2, t78 * cos_phi2);
        let t91 = t81.neg_mul_add(t59, t84.mul_add(t74, t90));
        let t92 = t89 * t91;
        let t93 = t92.neg_mul_add(t86, t75 - t74.mul_add(t69, t57 * t30));
        let t94 = t58.mul_add(t59, n(p.m2)) + t73.mul_sub(t74, t56 * t57);
        let t95 = t91.neg_mul_add(t92, t94);
        let t96 = N::ONE / t95;
        let t97 = cos_phi2 * s2;
        let t98 = sin_phi2 * s2;
        let t99 = n(p.m2) * sin_phi1.mul_sub(t97, cos_phi1 * t98);
        let t100 = n(p.k23) * t99;
        let t101 = t31.mul_add(t100, n(p.m2) * t98);
        let t102 = t55 * t101;
        let t103 = t63.neg_mul_add(t100, n(p.m2) * t97);
        let t104 = t66.neg_mul_add(t102, t103);
        let t105 = t72 * t104;
        let t106 = t81.mul_add(t102, n(p.m2) * t78.mul_add(t98, t77 * t97));
        let t107 = t84.mul_add(t105, t106);
        let t108 = t89 * t107;
        let t109 = t91.mul_sub(t108, t73 * t105);
        let t110 = t58.mul_add(t102, t56 * t100) + t109;
        let t111 = t96 * t110;
        let t112 = sin_phi2 * s2_dot.mul_add(t21, t2 * t8);
        let t113 = t98.neg_mul_add(t27, t21.mul_add(t3, t21 * t1));
        let t114 = t13.neg_mul_add(t8, t97.mul_add(t18, t11 * t8)) - t113;
        let t115 = cos_phi2.mul_sub(s2_dot.mul_sub(t8, t2 * t21), t112);
        let t116 = t111.mul_add(t93, n(p.m2) * (t115 - t114));
        let t117 = t116 - t102.mul_add(t53, t100 * t30);
        let t118 = s2 * (n(p.m2) * s2);
        let t119 = t101.mul_add(t102, t118) + t104.mul_sub(t105, t99 * t100);
        let t120 = t119 - t110.mul_add(t111, t107 * t108);
        let phi2_ddot = (t117 - t108.mul_add(t86, t105 * t69)) / t120;
        let s2_ddot = t111.mul_add(phi2_ddot, t96 * t93);
        let t121 = t92.neg_mul_add(s2_ddot, t89 * t86);
        let phi1_ddot = t108.neg_mul_add(phi2_ddot, t121);
        let t122 = t74.mul_add(s2_ddot, t105 * phi2_ddot);
        let y_ddot = t85.mul_add(phi1_ddot, t72 * t69) + t122;
        let t123 = t67.neg_mul_add(y_ddot, t102 * phi2_ddot);
        let t124 = t82.mul_add(phi1_ddot, t55 * t53) + t123;
        let t125 = t59 * s2_ddot;
        let t126 = t124 - t125;
        let t127 = n(p.k20).mul_add(y_ddot, t51 * n(p.k22));
        let t128 = t64.mul_add(y_ddot, t57 * s2_ddot);
        let t129 = t32.mul_add(t126, n(p.k23) * t30) - t128;
        let t130 = n(p.k24) - t54;
        checked(t130, n(p.k7), 7.993605777301127e-15, 0)?;
        let t131 = t70 - t71;
        checked(t131, n(p.k7), 7.993605777301127e-15, 1)?;
        checked(t88, t87, 7.993605777301127e-15, 4)?;
        checked(t95, n(p.m2), 7.993605777301127e-15, 6)?;
        checked(t120, t118, 7.993605777301127e-15, 7)?;
        let x_ddot = t125 - t124;
        let theta_ddot = -n(p.k19).mul_add(t126, t127);
        let s1_ddot = t100.neg_mul_add(phi2_ddot, t129);
        let zero = N::ZERO;
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
///     + 1/2*J2*der(theta2)^2 + 1/2*m0*(((der(x) - y0*der(theta)) - e*omega*sin(omega*t))^2 +
///     ((der(y) + x0*der(theta)) + e*omega*cos(omega*t))^2) + 1/2*m1*((der(x) + (cos(phi1)*der(s1)
///     - s1*sin(phi1)*der(phi1)))^2 + (der(y) + (sin(phi1)*der(s1) + s1*cos(phi1)*der(phi1)))^2) +
///     1/2*m2*(((der(x) + (cos(phi1)*der(s1) - s1*sin(phi1)*der(phi1))) + (cos(phi2)*der(s2) -
///     s2*sin(phi2)*der(phi2)))^2 + ((der(y) + (sin(phi1)*der(s1) + s1*cos(phi1)*der(phi1))) +
///     (sin(phi2)*der(s2) + s2*cos(phi2)*der(phi2)))^2) + 1/2*J0*omega^2
/// ```
pub fn kinetic_energy<S: ::lagrangian::Scalar>(p: &Prepared<S>, t: S, q: &[S; 9], v: &[S; 9]) -> S {
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
    let t6 = (t2 * t2 + t4 * t4) * p.m1 + theta1_dot * (theta1_dot * p.J1);
    let t7 = p.omega.product_error(t);
    let t8 = p.omega * t;
    let (sin_t8, cos_t8) = t8.sin_cos();
    let t9 = p.k0 * (cos_t8 - t7 * sin_t8) + (y_dot + theta_dot * p.x0);
    let t10 = x_dot - theta_dot * p.y0 - p.k0 * (sin_t8 + t7 * cos_t8);
    let t11 = (y_dot * y_dot + x_dot * x_dot) * p.m + theta_dot * (theta_dot * p.J);
    let t12 = (t3 * t3 + t5 * t5) * p.m2 + theta2_dot * (theta2_dot * p.J2) + t6;
    ((t9 * t9 + t10 * t10) * p.m0 + p.k1 + t11 + t12) * S::from_f64(0.5)
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
    let t0 = theta * p.yc;
    let t1 = t0 + x;
    let t2 = x - t0;
    let t3 = theta * p.xc;
    let t4 = t3 + y;
    let t5 = y - t3;
    let t6 = t4 * (p.k3 * t4) + t5 * (p.k3 * t5);
    t1 * (p.k2 * t1) + t2 * (p.k2 * t2) + t6
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
    let t0 = theta_dot * p.yc;
    let t1 = t0 + x_dot;
    let t2 = x_dot - t0;
    let t3 = theta_dot * p.xc;
    let t4 = t3 + y_dot;
    let t5 = y_dot - t3;
    let t6 = t4 * (p.k5 * t4) + t5 * (p.k5 * t5);
    t1 * (p.k4 * t1) + t2 * (p.k4 * t2) + t6
}

/// Power that drives, forces and inputs put in, in W.
///
/// ```text
/// P = m0*e*omega*cos(omega*t)*der(der(y)) - m0*e*omega*sin(omega*t)*der(der(x))
///     + m0*e*x0*omega*cos(omega*t)*der(der(theta)) + m0*e*y0*omega*sin(omega*t)*der(der(theta))
/// ```
pub fn work_rate<S: ::lagrangian::Scalar>(p: &Prepared<S>, t: S, v: &[S; 9], a: &[S; 9]) -> S {
    let x_dot = v[0];
    let y_dot = v[1];
    let theta_dot = v[2];
    let x_ddot = a[0];
    let y_ddot = a[1];
    let theta_ddot = a[2];
    let t0 = p.omega.product_error(t);
    let t1 = p.omega * t;
    let (sin_t1, cos_t1) = t1.sin_cos();
    let t2 = sin_t1 + t0 * cos_t1;
    let t3 = t2 * p.k10;
    let t4 = cos_t1 - t0 * sin_t1;
    let t5 = p.k0 * t4;
    let t6 = t5 + (p.x0 * theta_dot + y_dot);
    let t7 = p.k0 * t2;
    let t8 = t4 * p.k10;
    let t9 = x_dot - theta_dot * p.y0 - t7;
    let t10 = t7 * (x_ddot - theta_ddot * p.y0 - t8) + t8 * t9;
    let t11 = (t3 * t6 - t5 * (theta_ddot * p.x0 + y_ddot - t3) + t10) * p.m0;
    (t2 * t6 + t4 * t9) * p.k11 - t11
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
    let t0 = theta_dot * p.yc;
    let t1 = t0 + x_dot;
    let t2 = x_dot - t0;
    let t3 = theta_dot * p.xc;
    let t4 = t3 + y_dot;
    let t5 = y_dot - t3;
    let t6 = t4 * (t4 * p.by) + t5 * (p.by * t5);
    t1 * (t1 * p.bx) + t2 * (p.bx * t2) + t6
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

impl ::lagrangian::Machine for FrozenCrusher {
    type System = Prepared;

    fn name(&self) -> &str {
        "FrozenCrusher"
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

    fn work_rate(&self, t: f64, _: &[f64; 9], v: &[f64; 9], a: &[f64; 9], _: &Inputs) -> f64 {
        work_rate(self, t, v, a)
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

impl<const N: usize> ::lagrangian::Abreast<N> for Prepared
where
    ::lagrangian::Lanes<N>: ::lagrangian::Number,
{
    type Several = Prepared<::lagrangian::Lanes<N>>;
    type Vectors = [::lagrangian::Lanes<N>; 9];
    type SeveralInputs = Inputs;

    fn abreast(systems: [&Self; N]) -> Self::Several {
        let lanes = |number: fn(&Self) -> f64| ::lagrangian::Lanes(systems.map(number));
        Prepared {
            m: lanes(|p| p.m),
            m0: lanes(|p| p.m0),
            m1: lanes(|p| p.m1),
            m2: lanes(|p| p.m2),
            J: lanes(|p| p.J),
            J1: lanes(|p| p.J1),
            J2: lanes(|p| p.J2),
            x0: lanes(|p| p.x0),
            y0: lanes(|p| p.y0),
            omega: lanes(|p| p.omega),
            cx: lanes(|p| p.cx),
            cy: lanes(|p| p.cy),
            bx: lanes(|p| p.bx),
            by: lanes(|p| p.by),
            xc: lanes(|p| p.xc),
            yc: lanes(|p| p.yc),
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
            singular: None,
        }
    }

    fn inputs_abreast(_: [&Inputs; N]) -> Self::SeveralInputs {
        Inputs {}
    }

    fn is_singular(&self) -> bool {
        self.singular.is_some()
    }

    fn accelerations_abreast(
        p: &Self::Several,
        t: ::lagrangian::Lanes<N>,
        q: &Self::Vectors,
        v: &Self::Vectors,
        _: &Self::SeveralInputs,
    ) -> Result<Self::Vectors, ::lagrangian::Singular> {
        accelerations(p, t, q, v)
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
