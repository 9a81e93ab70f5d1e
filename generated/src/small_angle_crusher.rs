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
//! | `prepare` | 39 | 9 | 2 | 0 | 0 | 50 |
//! | `mass_matrix` | 26 | 6 | 0 | 2 | 0 | 36 |
//! | `bias` | 85 | 62 | 0 | 3 | 0 | 153 |
//! | `applied` | 6 | 6 | 0 | 0 | 0 | 12 |
//! | `forces` | 91 | 68 | 0 | 3 | 0 | 165 |
//! | `accelerations` | 202 | 136 | 5 | 3 | 0 | 349 |
//! | `kinetic_energy` | 50 | 29 | 0 | 3 | 0 | 85 |
//! | `potential_energy` | 6 | 2 | 0 | 0 | 0 | 8 |
//! | `dissipation` | 6 | 2 | 0 | 0 | 0 | 8 |
//! | `work_rate` | 43 | 25 | 0 | 1 | 0 | 70 |
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
    /// Mass of the platform. Unit: `kg`. Default: 600.
    pub m: S,
    /// Mass of the debalance. Unit: `kg`. Default: 40.
    pub m0: S,
    /// `m1`. Unit: `kg`. Default: 180.
    pub m1: S,
    /// `m2`. Unit: `kg`. Default: 120.
    pub m2: S,
    /// `J`. Unit: `kg*m^2`. Default: 60.
    pub J: S,
    /// `J0`. Unit: `kg*m^2`. Default: 0.2.
    pub J0: S,
    /// `J1`. Unit: `kg*m^2`. Default: 9.225.
    pub J1: S,
    /// `J2`. Unit: `kg*m^2`. Default: 1.536.
    pub J2: S,
    /// Eccentricity of the debalance. Unit: `m`. Default: 0.1.
    pub e: S,
    /// `x0`. Unit: `m`. Default: 0.05.
    pub x0: S,
    /// `y0`. Unit: `m`. Default: 0.03.
    pub y0: S,
    /// `omega`. Unit: `rad/s`. Default: 50*pi.
    pub omega: S,
    /// `cx`. Unit: `N/m`. Default: 300000.
    pub cx: S,
    /// `cy`. Unit: `N/m`. Default: 300000.
    pub cy: S,
    /// `bx`. Unit: `N*s/m`. Default: 1500.
    pub bx: S,
    /// `by`. Unit: `N*s/m`. Default: 1500.
    pub by: S,
    /// `xc`. Unit: `m`. Default: 0.4.
    pub xc: S,
    /// `yc`. Unit: `m`. Default: 0.3.
    pub yc: S,
}

impl<S: ::lagrangian::emitted::Scalar> SmallAngleCrusher<S> {
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
        let k35 = -k14;
        let k36 = -self.m2;
        let k37 = S::ONE / k11;
        let k38 = S::ONE / k14;
        let pivots = [
            (5, self.J1, self.J1),
            (8, self.J2, self.J2),
            (2, k11, k11),
            (3, k14, k14),
        ];
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
            k37,
            k38,
            singular: PIVOTS.vanished(pivots),
        }
    }

    /// The start values of the description, at rest and `t = 0`.
    pub fn start(&self) -> ::lagrangian::emitted::State<Coordinates<S>> {
        let zero = S::ZERO;
        let s1 = S::from_ratio(1, 50);
        let s2 = S::from_ratio(3, 100);
        let q = [zero, zero, zero, s1, zero, zero, s2, S::from_f64(0.5), zero];
        let v = [S::ZERO; 9];
        ::lagrangian::emitted::State {
            t: 0.0,
            q: Coordinates::from_array(q),
            v: Coordinates::from_array(v),
        }
    }
}

/// The coordinates of [`SmallAngleCrusher`], or their rates, by name.
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
    /// `-(m1 + m2)`
    k35: S,
    /// `-m2`
    k36: S,
    /// `1/(J + m0*x0^2 + m0*y0^2)`
    k37: S,
    /// `1/(m1 + m2)`
    k38: S,
    /// Why these parameters leave the machine without accelerations, if they do.
    singular: Option<::lagrangian::emitted::Singular>,
}

/// A pivot of an elimination that is not above this share of its diagonal element may be rounding
/// errors alone.
const PIVOTS: ::lagrangian::emitted::Pivots = ::lagrangian::emitted::Pivots {
    coordinates: 9,
    tolerance: 7.993605777301127e-15,
};

/// Mass matrix `M`.
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
pub fn mass_matrix<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 9]) -> [[S; 9]; 9] {
    let theta = q[2];
    let s1 = q[3];
    let phi1 = q[4];
    let s2 = q[6];
    let phi2 = q[7];
    let (sin_phi1, cos_phi1) = phi1.sin_cos();
    let (sin_phi2, cos_phi2) = phi2.sin_cos();
    let t0 = s1 * p.m2;
    let t1 = p.k14 * s1;
    let t2 = p.m2 * s2;
    let t3 = cos_phi1 * sin_phi2;
    let t4 = sin_phi1 * cos_phi2;
    let t5 = cos_phi1 * cos_phi2 + sin_phi1 * sin_phi2;
    let zero = S::ZERO;
    let m31 = -(theta * p.k13 + p.k12);
    let m32 = p.k13 - theta * p.k12;
    let m41 = p.k14 * cos_phi1;
    let m42 = p.k14 * sin_phi1;
    let m51 = sin_phi1 * (s1 * p.k35);
    let m52 = cos_phi1 * t1;
    let m55 = s1 * t1;
    let m71 = cos_phi2 * p.m2;
    let m72 = sin_phi2 * p.m2;
    let m74 = p.m2 * t5;
    let m75 = (t3 - t4) * t0;
    let m81 = sin_phi2 * (s2 * p.k36);
    let m82 = cos_phi2 * t2;
    let m84 = t2 * (t4 - t3);
    let m85 = t5 * (t0 * s2);
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
pub fn bias<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    t: S,
    q: &[S; 9],
    v: &[S; 9],
) -> [S; 9] {
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
    let (sin_phi1, cos_phi1) = phi1.sin_cos();
    let (sin_phi2, cos_phi2) = phi2.sin_cos();
    let t0 = p.omega * t;
    let t1 = phi1_dot * s1;
    let t2 = phi2_dot * s2;
    let t3 = p.omega.product_error(t);
    let t4 = theta_dot * theta_dot;
    let (sin_t0, cos_t0) = t0.sin_cos();
    let t5 = sin_phi1 * s1_dot;
    let t6 = cos_phi1 * t1;
    let t7 = sin_phi2 * s2_dot;
    let t8 = cos_phi2 * t2;
    let t9 = cos_phi2 * s2_dot;
    let t10 = cos_phi1 * s1_dot;
    let t11 = sin_phi1 * t1;
    let t12 = sin_phi2 * t2;
    let t13 = t5 + t6;
    let t14 = t5 * phi1_dot;
    let t15 = t7 * phi2_dot;
    let t16 = t7 + t8;
    let t17 = phi2_dot * t9;
    let t18 = phi1_dot * t10;
    let t19 = t10 - t11;
    let t20 = cos_t0 - t3 * sin_t0;
    let t21 = y_dot + t13;
    let t22 = t9 - t12;
    let t23 = x_dot + t19;
    let t24 = sin_t0 + t3 * cos_t0;
    let t25 = t16 + t21;
    let t26 = t14 + (t14 + phi1_dot * t6);
    let t27 = t18 + (t18 - phi1_dot * t11);
    let t28 = t22 + t23;
    let t29 = p.m2 * t25 + p.m1 * t21;
    let t30 = t15 + (t15 + phi2_dot * t8) + t26;
    let t31 = t17 + (t17 - phi2_dot * t12) + t27;
    let t32 = (y_dot + t20 * p.k0) * (theta_dot * p.k12);
    let t33 = p.m2 * t28 + p.m1 * t23;
    let t34 = t25 * (cos_phi2 * phi2_dot);
    let t35 = t28 * (sin_phi2 * phi2_dot);
    let t36 = t30 * p.m2 + t26 * p.m1;
    let t37 = p.m2 * t31 + p.m1 * t27;
    let t38 = (x_dot - t24 * p.k0) * (theta_dot * p.k13);
    let t39 = t29 * (cos_phi1 * phi1_dot);
    let t40 = t33 * (sin_phi1 * phi1_dot);
    let t41 = sin_phi2 * (s2_dot * t28 + t2 * t25);
    let t42 = t32 - t24 * (p.k18 * theta) + (t24 * p.k19 - t20 * p.k18);
    let t43 = sin_phi1 * (s1_dot * t33 + t1 * t29);
    let t44 = t22 * t25 + t31 * (cos_phi2 * s2) - (t28 * t16 - t30 * (sin_phi2 * s2));
    let t45 = t19 * t29 + t37 * (cos_phi1 * s1) - (t33 * t13 - t36 * (sin_phi1 * s1));
    let h_x = -(t36 + (t4 * p.k13 + p.k17 * t20));
    let h_y = t37 - (t4 * p.k12 + p.k17 * t24);
    let h_theta = t38 + t32 - (t38 - t20 * (p.k19 * theta) + t42);
    let h_s1 = t39 + sin_phi1 * t37 - (t40 + cos_phi1 * t36) - (t39 - t40);
    let h_phi1 = t45 - (cos_phi1 * (s1_dot * t29 - t1 * t33) - t43);
    let zero = S::ZERO;
    let h_s2 = p.k36 * (t34 - t35 - (t34 + sin_phi2 * t31 - (t35 + cos_phi2 * t30)));
    let h_phi2 = p.k36 * (cos_phi2 * (s2_dot * t25 - t2 * t28) - t41 - t44);
    [h_x, h_y, h_theta, h_s1, h_phi1, zero, h_s2, h_phi2, zero]
}

/// Applied generalized forces `Q`.
///
/// ```text
/// Q[x] = -2*bx*der(x) - 2*cx*x
/// Q[y] = -2*by*der(y) - 2*cy*y
/// Q[theta] = -2*(bx*yc^2 + by*xc^2)*der(theta) - 2*(cx*yc^2 + cy*xc^2)*theta
/// ```
pub fn applied<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 9],
    v: &[S; 9],
) -> [S; 9] {
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
pub fn forces<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    t: S,
    q: &[S; 9],
    v: &[S; 9],
) -> [S; 9] {
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
    let (sin_phi1, cos_phi1) = phi1.sin_cos();
    let t0 = p.omega * t;
    let (sin_phi2, cos_phi2) = phi2.sin_cos();
    let t1 = phi1_dot * s1;
    let t2 = phi2_dot * s2;
    let t3 = p.omega.product_error(t);
    let (sin_t0, cos_t0) = t0.sin_cos();
    let t4 = theta_dot * theta_dot;
    let t5 = sin_phi1 * s1_dot;
    let t6 = cos_phi1 * t1;
    let t7 = sin_phi2 * s2_dot;
    let t8 = cos_phi1 * s1_dot;
    let t9 = cos_phi2 * t2;
    let t10 = cos_phi2 * s2_dot;
    let t11 = sin_phi1 * t1;
    let t12 = sin_phi2 * t2;
    let t13 = t5 + t6;
    let t14 = t5 * phi1_dot;
    let t15 = cos_t0 - t3 * sin_t0;
    let t16 = t7 * phi2_dot;
    let t17 = phi2_dot * t10;
    let t18 = phi1_dot * t8;
    let t19 = sin_t0 + t3 * cos_t0;
    let t20 = t7 + t9;
    let t21 = y_dot + t13;
    let t22 = t8 - t11;
    let t23 = t20 + t21;
    let t24 = (y_dot + t15 * p.k0) * (theta_dot * p.k12);
    let t25 = t10 - t12;
    let t26 = x_dot + t22;
    let t27 = t14 + (t14 + phi1_dot * t6);
    let t28 = t18 + (t18 - phi1_dot * t11);
    let t29 = (x_dot - t19 * p.k0) * (theta_dot * p.k13);
    let t30 = p.m2 * t23 + p.m1 * t21;
    let t31 = t25 + t26;
    let t32 = t16 + (t16 + phi2_dot * t9) + t27;
    let t33 = t17 + (t17 - phi2_dot * t12) + t28;
    let t34 = p.m2 * t31 + p.m1 * t26;
    let t35 = t23 * (cos_phi2 * phi2_dot);
    let t36 = t31 * (sin_phi2 * phi2_dot);
    let t37 = t32 * p.m2 + t27 * p.m1;
    let t38 = p.m2 * t33 + p.m1 * t28;
    let t39 = t24 - t19 * (theta * p.k18) + (t19 * p.k19 - t15 * p.k18);
    let t40 = t30 * (cos_phi1 * phi1_dot);
    let t41 = t34 * (sin_phi1 * phi1_dot);
    let t42 = sin_phi2 * (s2_dot * t31 + t2 * t23);
    let t43 = t29 + t24 - (t29 - t15 * (theta * p.k19) + t39);
    let t44 = sin_phi1 * (s1_dot * t34 + t1 * t30);
    let t45 = t25 * t23 + t33 * (cos_phi2 * s2) - (t31 * t20 - t32 * (sin_phi2 * s2));
    let t46 = t22 * t30 + t38 * (cos_phi1 * s1) - (t34 * t13 - t37 * (sin_phi1 * s1));
    let f_x = t37 + (t4 * p.k13 + p.k17 * t15) - (p.k21 * x_dot + p.k20 * x);
    let f_y = t4 * p.k12 + p.k17 * t19 - t38 - (p.k23 * y_dot + p.k22 * y);
    let f_theta = -(theta_dot * p.k25 + theta * p.k24 + t43);
    let f_s1 = t40 - t41 - (t40 + sin_phi1 * t38 - (t41 + cos_phi1 * t37));
    let f_phi1 = cos_phi1 * (s1_dot * t30 - t1 * t34) - t44 - t46;
    let zero = S::ZERO;
    let f_s2 = p.m2 * (t35 - t36 - (t35 + sin_phi2 * t33 - (t36 + cos_phi2 * t32)));
    let f_phi2 = p.m2 * (cos_phi2 * (s2_dot * t23 - t2 * t31) - t42 - t45);
    [f_x, f_y, f_theta, f_s1, f_phi1, zero, f_s2, f_phi2, zero]
}

/// Accelerations `a`, the solution of `M a = f` from the mass matrix, factored.
///
/// A pivot that vanishes is an error.
pub fn accelerations<S: ::lagrangian::emitted::Number>(
    p: &Prepared<S>,
    t: S,
    q: &[S; 9],
    v: &[S; 9],
) -> Result<[S; 9], ::lagrangian::emitted::Singular> {
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

impl<S: Copy> ::lagrangian::emitted::scalar::Kernel<S> for Accelerations<'_, S> {
    type Output = Result<[S; 9], ::lagrangian::emitted::Singular>;

    #[inline(always)]
    fn run<N: ::lagrangian::emitted::Scalar<Stored = S>>(self) -> Self::Output {
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
        let angles = [phi1, phi2, t0];
        let circular = N::sin_cos_all(angles);
        let (sin_phi1, cos_phi1) = circular[0];
        let (sin_phi2, cos_phi2) = circular[1];
        let (sin_t0, cos_t0) = circular[2];
        let t1 = n(p.k13).mul_add(theta, n(p.k12));
        let t2 = theta.neg_mul_add(n(p.k12), n(p.k13));
        let t3 = n(p.k14) * s1;
        let t4 = s1 * phi1_dot;
        let t5 = s2 * phi2_dot;
        let t6 = n(p.omega).product_error(n(t));
        let t7 = n(p.k37) * t1;
        let t8 = n(p.k37) * t2;
        let t9 = s1 * t3;
        let t10 = n(p.m2) * s2;
        let t11 = s1 * n(p.m2);
        let t12 = theta_dot * theta_dot;
        let t13 = s2 * t10;
        let t14 = n(p.k14) * cos_phi1;
        let t15 = n(p.k14) * sin_phi1;
        let t16 = sin_phi1 * t3;
        let t17 = sin_phi2 * s2_dot;
        let t18 = sin_phi1 * s1_dot;
        let t19 = cos_phi1 * t4;
        let t20 = cos_phi2 * s2_dot;
        let t21 = n(p.k38) * t14;
        let t22 = n(p.k38) * t15;
        let t23 = cos_phi1.mul_add(cos_phi2, sin_phi1 * sin_phi2);
        let t24 = cos_phi1 * s1_dot;
        let t25 = sin_phi1 * t4;
        let t26 = cos_phi2 * t5;
        let t27 = t18 + t19;
        let t28 = t14.neg_mul_add(t21, t1.neg_mul_add(t7, n(p.k15)));
        let t29 = t14.neg_mul_add(t22, t1 * t8);
        let t30 = n(p.m2) * t23;
        let t31 = phi2_dot * t20;
        let t32 = sin_phi2 * t5;
        let t33 = phi1_dot * t24;
        let t34 = t24 - t25;
        let t35 = N::ONE / t28;
        let t36 = phi2_dot * t17;
        let t37 = phi1_dot * t18;
        let t38 = t6.neg_mul_add(sin_t0, cos_t0);
        let t39 = n(p.k38) * t30;
        let t40 = t17 + t26;
        let t41 = y_dot + t27;
        let t42 = t20 - t32;
        let t43 = x_dot + t34;
        let t44 = t6.mul_add(cos_t0, sin_t0);
        let t45 = cos_phi1 * sin_phi2;
        let t46 = sin_phi1 * cos_phi2;
        let t47 = t14.neg_mul_add(t39, n(p.m2) * cos_phi2);
        let t48 = t40 + t41;
        let t49 = t33 + phi1_dot.neg_mul_add(t25, t33);
        let t50 = t42 + t43;
        let t51 = t37 + phi1_dot.mul_add(t19, t37);
        let t52 = t35 * t29;
        let t53 = t35 * t16;
        let t54 = t38.mul_add(n(p.k0), y_dot) * (n(p.k12) * theta_dot);
        let t55 = t15.neg_mul_add(t22, t2.neg_mul_add(t8, n(p.k15)));
        let t56 = t29.neg_mul_add(t52, t55);
        let t57 = t29.mul_add(t53, cos_phi1 * t3);
        let t58 = t35 * t47;
        let t59 = t31 + phi2_dot.neg_mul_add(t32, t31) + t49;
        let t60 = N::ONE / t56;
        let t61 = t36 + phi2_dot.mul_add(t26, t36) + t51;
        let t62 = n(p.m2).mul_add(t48, n(p.m1) * t41);
        let t63 = n(p.m2).mul_add(t50, t43 * n(p.m1));
        let t64 = t44.neg_mul_add(n(p.k0), x_dot) * (n(p.k13) * theta_dot);
        let t65 = t10 * (t46 - t45);
        let t66 = t15.neg_mul_add(t39, n(p.m2) * sin_phi2);
        let t67 = t29.neg_mul_add(t58, t66);
        let t68 = t48 * (cos_phi2 * phi2_dot);
        let t69 = t50 * (sin_phi2 * phi2_dot);
        let t70 = t62 * (cos_phi1 * phi1_dot);
        let t71 = n(p.m2).mul_add(t59, n(p.m1) * t49);
        let t72 = t63 * (sin_phi1 * phi1_dot);
        let t73 = n(p.m2).mul_add(t61, n(p.m1) * t51);
        let t74 = t44.neg_mul_add(theta * n(p.k18), t54);
        let t75 = n(p.k38) * t65;
        let t76 = t60 * t57;
        let t77 = t60 * t67;
        let t78 = t57.neg_mul_add(t76, t16.neg_mul_add(t53, t9));
        let t79 = t74 + n(p.k19).mul_sub(t44, t38 * n(p.k18));
        let t80 = t14.mul_add(t75, sin_phi2 * t10);
        let t81 = N::ONE / t78;
        let t82 = t57.neg_mul_add(t77, t16.mul_add(t58, (t45 - t46) * t11));
        let t83 = t35 * t80;
        let t84 = t81 * t82;
        let t85 = t47.neg_mul_add(t58, t30.neg_mul_add(t39, n(p.m2)));
        let t86 = sin_phi2.mul_add(t59, t68) - cos_phi2.mul_add(t61, t69);
        let t87 = sin_phi1.mul_add(t71, t70) - cos_phi1.mul_add(t73, t72);
        let t88 = t70 - t72 - t87;
        let t89 = t64 + t54 - (t38.neg_mul_add(theta * n(p.k19), t64) + t79);
        let t90 = theta_dot.mul_add(n(p.k25), theta * n(p.k24)) + t89;
        let t91 = t73 + t38.mul_add(n(p.k17), n(p.k13) * t12);
        let t92 = t44.mul_add(n(p.k17), n(p.k12) * t12) - t71;
        let t93 = t29.mul_add(t83, t15.neg_mul_add(t75, cos_phi2 * t10));
        let t94 = sin_phi2 * s2_dot.mul_add(t50, t5 * t48);
        let t95 = t61.neg_mul_add(sin_phi2 * s2, t50 * t40);
        let t96 = t82.neg_mul_add(t84, t67.neg_mul_add(t77, t85));
        let t97 = t91 - x_dot.mul_add(n(p.k21), n(p.k20) * x);
        let t98 = t92 - y_dot.mul_add(n(p.k23), n(p.k22) * y);
        let t99 = sin_phi1 * s1_dot.mul_add(t63, t4 * t62);
        let t100 = t73.neg_mul_add(sin_phi1 * s1, t63 * t27);
        let t101 = t60 * t93;
        let t102 = cos_phi2.mul_sub(s2_dot.mul_sub(t48, t5 * t50), t94);
        let t103 = N::ONE / t96;
        let t104 = t21.neg_mul_add(t88, t7.neg_mul_add(t90, t97));
        let t105 = cos_phi1.mul_sub(s1_dot.mul_sub(t62, t4 * t63), t99);
        let t106 = t16.neg_mul_add(t83, t23 * (t11 * s2));
        let t107 = t57.neg_mul_add(t101, t106);
        let t108 = t102 - (t59.mul_add(cos_phi2 * s2, t42 * t48) - t95);
        let t109 = t39.neg_mul_add(t88, n(p.m2) * (t68 - t69 - t86));
        let t110 = t22.neg_mul_add(t88, t8.mul_add(t90, t98));
        let t111 = t52.neg_mul_add(t104, t110);
        let t112 = t105 - (t71.mul_add(cos_phi1 * s1, t34 * t62) - t100);
        let t113 = t81 * t107;
        let t114 = t76.neg_mul_add(t111, t53.mul_add(t104, t112));
        let t115 = t67.mul_add(t101, t47.neg_mul_add(t83, t30 * t75));
        let t116 = t82.mul_add(t113, t115);
        let t117 = t83.mul_add(t104, n(p.m2).mul_sub(t108, t75 * t88));
        let t118 = t80.neg_mul_add(t83, t65.neg_mul_add(t75, t13));
        let t119 = t77.neg_mul_add(t111, t58.neg_mul_add(t104, t109));
        let t120 = t84.neg_mul_add(t114, t119);
        let t121 = t103 * t116;
        let t122 = t113.neg_mul_add(t114, t101.neg_mul_add(t111, t117));
        let t123 = t107.neg_mul_add(t113, t93.neg_mul_add(t101, t118));
        let t124 = t116.neg_mul_add(t121, t123);
        let phi2_ddot = t121.mul_add(t120, t122) / t124;
        let s2_ddot = t121.mul_add(phi2_ddot, t103 * t120);
        let t125 = t113.neg_mul_add(phi2_ddot, t81 * t114);
        let phi1_ddot = t84.neg_mul_add(s2_ddot, t125);
        let t126 = t83.mul_add(phi2_ddot, t35 * t104);
        let t127 = t101.neg_mul_add(phi2_ddot, t60 * t111);
        let t128 = t75.mul_sub(phi2_ddot, n(p.k38) * t88);
        let y_ddot = t76.neg_mul_add(phi1_ddot, t77.neg_mul_add(s2_ddot, t127));
        let t129 = t53.mul_add(phi1_ddot, t58.neg_mul_add(s2_ddot, t126));
        let x_ddot = t52.neg_mul_add(y_ddot, t129);
        let t130 = t22.mul_add(y_ddot, t39.mul_add(s2_ddot, t128));
        let theta_ddot = t7.mul_sub(x_ddot, t8.mul_add(y_ddot, n(p.k37) * t90));
        let s1_ddot = -t21.mul_add(x_ddot, t130);
        let zero = N::ZERO;
        let sound = PIVOTS.hold(t28, n(p.k15))
            & PIVOTS.hold(t56, n(p.k15))
            & PIVOTS.hold(t78, t9)
            & PIVOTS.hold(t96, n(p.m2))
            & PIVOTS.hold(t124, t13)
            & s1_ddot.is_finite();
        if !sound {
            let pivots = [
                (0, t28, n(p.k15)),
                (1, t56, n(p.k15)),
                (4, t78, t9),
                (6, t96, n(p.m2)),
                (7, t124, t13),
            ];
            PIVOTS.check(pivots)?;
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
/// T = …
/// ```
pub fn kinetic_energy<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    t: S,
    q: &[S; 9],
    v: &[S; 9],
) -> S {
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
    let t0 = p.omega * t;
    let (sin_phi1, cos_phi1) = phi1.sin_cos();
    let (sin_phi2, cos_phi2) = phi2.sin_cos();
    let t1 = phi1_dot * s1;
    let t2 = p.omega.product_error(t);
    let t3 = phi2_dot * s2;
    let (sin_t0, cos_t0) = t0.sin_cos();
    let t4 = theta_dot * theta;
    let t5 = theta_dot * theta_dot;
    let t6 = y_dot + p.k0 * (cos_t0 - t2 * sin_t0);
    let t7 = x_dot + (cos_phi1 * s1_dot - t1 * sin_phi1);
    let t8 = x_dot - p.k0 * (sin_t0 + t2 * cos_t0);
    let t9 = y_dot + (t1 * cos_phi1 + sin_phi1 * s1_dot);
    let t10 = cos_phi2 * s2_dot - t3 * sin_phi2 + t7;
    let t11 = t3 * cos_phi2 + sin_phi2 * s2_dot + t9;
    let t12 = p.k8 * (t5 * p.k7 - t6 * (t4 * p.k4) + (t5 * p.k6 - t8 * (t4 * p.k5)));
    let t13 = (t9 * t9 + t7 * t7) * p.m1 + theta1_dot * (theta1_dot * p.J1);
    let t14 = p.k3 * (y_dot * y_dot + x_dot * x_dot) + t5 * p.k2;
    let t15 = t12 - p.k8 * (t8 * (theta_dot * p.k4) - t6 * (theta_dot * p.k5));
    let t16 = (t11 * t11 + t10 * t10) * p.m2 + theta2_dot * (theta2_dot * p.J2);
    let t17 = S::from_f64(0.5) * ((t6 * t6 + t8 * t8) * p.m0 + p.k1) + t15;
    t17 + (S::from_f64(0.5) * t16 + (S::from_f64(0.5) * t13 + t14))
}

/// Potential energy `V`, in J.
///
/// ```text
/// V = cx*x^2 + cy*y^2 + (cx*yc^2 + cy*xc^2)*theta^2
/// ```
pub fn potential_energy<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 9]) -> S {
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
pub fn dissipation<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, v: &[S; 9]) -> S {
    let x_dot = v[0];
    let y_dot = v[1];
    let theta_dot = v[2];
    let t0 = y_dot * (y_dot * p.by) + x_dot * (x_dot * p.bx);
    theta_dot * (theta_dot * p.k10) + t0
}

/// Power `P` that drives, forces and inputs put in, in W.
///
/// ```text
/// P = …
/// ```
pub fn work_rate<S: ::lagrangian::emitted::Scalar>(
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
    let t1 = p.omega.product_error(t);
    let t2 = theta_ddot * theta;
    let (sin_t0, cos_t0) = t0.sin_cos();
    let t3 = sin_t0 + t1 * cos_t0;
    let t4 = cos_t0 - t1 * sin_t0;
    let t5 = t3 * p.k16;
    let t6 = t3 * p.k0;
    let t7 = t4 * p.k0;
    let t8 = t4 * p.k16;
    let t9 = t3 * theta_dot;
    let t10 = t4 * theta_dot;
    let t11 = x_dot - t6;
    let t12 = t7 + y_dot;
    let t13 = theta * t9;
    let t14 = theta * t10;
    let t15 = t3 * (theta_ddot * p.k33) + t10 * p.k26;
    let t16 = t13 * p.k26 - (t4 * (t2 * p.k33) + t10 * (p.k33 * theta_dot));
    let t17 = t5 * t12 - t7 * (y_ddot - t5) + (t6 * (x_ddot - t8) + t8 * t11);
    let t18 = t16 + (t14 * p.k27 + (t3 * (t2 * p.k34) + t9 * (theta_dot * p.k34)));
    let t19 = (t3 * t12 + t4 * t11) * p.k17 - (t10 * p.k28 - t9 * p.k29) * p.k8;
    let t20 = (t17 - (t15 - (t9 * p.k27 - t4 * (theta_ddot * p.k34))) - t18) * p.m0;
    t19 - p.k32 * (t13 * p.k31 + t14 * p.k30) - t20
}

/// Power `R` that dampers take out, in W.
///
/// ```text
/// R = 2*bx*der(x)^2 + 2*by*der(y)^2 + 2*(bx*yc^2 + by*xc^2)*der(theta)^2
/// ```
pub fn dissipation_rate<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, v: &[S; 9]) -> S {
    let x_dot = v[0];
    let y_dot = v[1];
    let theta_dot = v[2];
    let t0 = y_dot * (y_dot * p.k23) + x_dot * (x_dot * p.k21);
    theta_dot * (theta_dot * p.k25) + t0
}

/// By how much `s1 > 0` holds.
pub fn assumption_0<S: ::lagrangian::emitted::Scalar>(q: &[S; 9]) -> S {
    let s1 = q[3];
    s1
}

/// By how much `s2 > 0` holds.
pub fn assumption_1<S: ::lagrangian::emitted::Scalar>(q: &[S; 9]) -> S {
    let s2 = q[6];
    s2
}

::lagrangian::emitted::implement! {
    machine SmallAngleCrusher "SmallAngleCrusher" over S, R;
    parameters { m, m0, m1, m2, J, J0, J1, J2, e, x0, y0, omega, cx, cy, bx, by, xc, yc } [
        m: "m" "kg" = 600.0;
        m0: "m0" "kg" = 40.0;
        m1: "m1" "kg" = 180.0;
        m2: "m2" "kg" = 120.0;
        J: "J" "kg*m^2" = 60.0;
        J0: "J0" "kg*m^2" = 0.2;
        J1: "J1" "kg*m^2" = 9.225;
        J2: "J2" "kg*m^2" = 1.536;
        e: "e" "m" = 0.1;
        x0: "x0" "m" = 0.05;
        y0: "y0" "m" = 0.03;
        omega: "omega" "rad/s" = 157.07963267948966;
        cx: "cx" "N/m" = 300000.0;
        cy: "cy" "N/m" = 300000.0;
        bx: "bx" "N*s/m" = 1500.0;
        by: "by" "N*s/m" = 1500.0;
        xc: "xc" "m" = 0.4;
        yc: "yc" "m" = 0.3;
    ]
    coordinates 9 Coordinates { x, y, theta, s1, phi1, theta1, s2, phi2, theta2 } [
        x: "x" "m";
        y: "y" "m";
        theta: "theta" "rad";
        s1: "s1" "m";
        phi1: "phi1" "rad";
        theta1: "theta1" "rad";
        s2: "s2" "m";
        phi2: "phi2" "rad";
        theta2: "theta2" "rad";
    ]
    inputs Inputs {} []
    outputs Outputs {} []
    prepared Prepared {
        m0, m1, m2, J1, J2, omega, cx, cy, bx, by, k0, k1, k2, k3, k4, k5, k6, k7, k8, k9, k10, k11,
        k12, k13, k14, k15, k16, k17, k18, k19, k20, k21, k22, k23, k24, k25, k26, k27, k28, k29,
        k30, k31, k32, k33, k34, k35, k36, k37, k38,
    }
    singular singular
    accelerations { (p, t, q, v, u) Accelerations { p, t, q, v } }
    system {
        matrix mass_matrix(p, t, q) = mass_matrix(p, q);
        vector bias(p, t, q, v) = bias(p, t, q, v);
        vector applied(p, t, q, v, u) = applied(p, q, v);
        vector forces(p, t, q, v, u) = forces(p, t, q, v);
        number kinetic_energy(p, t, q, v) = kinetic_energy(p, t, q, v);
        number potential_energy(p, t, q, u) = potential_energy(p, q);
        number dissipation(p, t, q, v, u) = dissipation(p, v);
        number work_rate(p, t, q, v, a, u) = work_rate(p, t, q, v, a);
        number dissipation_rate(p, t, q, v, u) = dissipation_rate(p, v);
        outputs outputs(p, t, q, v, a, u) = Outputs {};
        facts assumptions(p, t, q, v, u) = [
            ("s1 > 0", true, assumption_0(q)),
            ("s2 > 0", true, assumption_1(q)),
        ];
    }
    absent [MAY_BE_CONSTRAINED MAY_SLIDE MAY_COLLIDE]
    intervals []
    lanes [N]
    numbers [yes]
}
