// @generated from machines/small_angle_crusher.machine by `cargo xtask generate`; edits are lost.

//! The crusher with its energies to second order in the platform's angle and angular rate together.
//!
//! The terms of the energies that are left out are of third order: with half the angle, the error
//! is an eighth. Unlike the frozen machine it includes the displacement of the axis of the
//! debalance by
//! the rotation of the platform, x0 cos θ ≈ x0 and y0 sin θ ≈ y0 θ, and thus products of angle
//! and rate.
//!
//! 9 coordinates, 18 parameters. Arithmetic of one call:
//!
//! | function | mul | add | div | sin cos | other | temporaries |
//! | --- | --: | --: | --: | --: | --: | --: |
//! | `prepare` | 39 | 8 | 2 | 0 | 0 | 49 |
//! | `mass_matrix` | 25 | 7 | 0 | 2 | 0 | 36 |
//! | `bias` | 85 | 62 | 0 | 3 | 0 | 153 |
//! | `applied` | 6 | 6 | 0 | 0 | 0 | 12 |
//! | `forces` | 91 | 68 | 0 | 3 | 0 | 165 |
//! | `accelerations` | 202 | 135 | 5 | 3 | 0 | 348 |
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
/// The terms of the energies that are left out are of third order: with half the angle, the error
/// is an eighth. Unlike the frozen machine it includes the displacement of the axis of the
/// debalance by
/// the rotation of the platform, x0 cos θ ≈ x0 and y0 sin θ ≈ y0 θ, and thus products of angle
/// and rate.
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
        let e_omega = self.omega * self.e;
        let t0 = self.xc * self.xc;
        let t1 = self.yc * self.yc;
        let cx_yc2_plus_cy_xc2 = self.cy * t0 + self.cx * t1;
        let bx_yc2_plus_by_xc2 = self.by * t0 + self.bx * t1;
        let m0_y0 = self.m0 * self.y0;
        let m0_x0 = self.m0 * self.x0;
        let k0 = self.y0 * m0_y0 + (self.J + self.x0 * m0_x0);
        let m1_plus_m2 = self.m1 + self.m2;
        let e_omega2 = self.omega * e_omega;
        let e_y0_omega2 = self.y0 * e_omega2;
        let e_x0_omega2 = self.x0 * e_omega2;
        let J0_omega2 = self.omega * (self.omega * self.J0);
        let half_J = S::from_f64(0.5) * self.J;
        let half_m = S::from_f64(0.5) * self.m;
        let two_y0 = S::from_f64(2.0) * self.y0;
        let two_x0 = S::from_f64(2.0) * self.x0;
        let y0_squared = self.y0 * self.y0;
        let x0_squared = self.x0 * self.x0;
        let half_m0 = self.m0 * S::from_f64(0.5);
        let k1 = m1_plus_m2 + (self.m0 + self.m);
        let m0_e_omega2 = self.m0 * e_omega2;
        let m0_e_y0_omega2 = self.m0 * e_y0_omega2;
        let m0_e_x0_omega2 = self.m0 * e_x0_omega2;
        let two_cx = self.cx * S::from_f64(2.0);
        let two_bx = self.bx * S::from_f64(2.0);
        let two_cy = self.cy * S::from_f64(2.0);
        let two_by = self.by * S::from_f64(2.0);
        let k2 = S::from_f64(2.0) * cx_yc2_plus_cy_xc2;
        let k3 = S::from_f64(2.0) * bx_yc2_plus_by_xc2;
        let two_e_y0_omega2 = S::from_f64(2.0) * e_y0_omega2;
        let two_e_x0_omega2 = S::from_f64(2.0) * e_x0_omega2;
        let four_e_x0_omega2 = e_x0_omega2 * S::from_f64(4.0);
        let four_e_y0_omega2 = e_y0_omega2 * S::from_f64(4.0);
        let quarter_m0 = self.m0 * S::from_f64(0.25);
        let e_y0_omega = e_omega * self.y0;
        let e_x0_omega = e_omega * self.x0;
        let minus_m2 = -self.m2;
        let k4 = S::ONE / k0;
        let k5 = S::ONE / m1_plus_m2;
        let pivots = [
            (5, self.J1, self.J1),
            (8, self.J2, self.J2),
            (2, k0, k0),
            (3, m1_plus_m2, m1_plus_m2),
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
            e_omega,
            J0_omega2,
            half_J,
            half_m,
            two_y0,
            two_x0,
            y0_squared,
            x0_squared,
            half_m0,
            cx_yc2_plus_cy_xc2,
            bx_yc2_plus_by_xc2,
            k0,
            m0_y0,
            m0_x0,
            m1_plus_m2,
            k1,
            e_omega2,
            m0_e_omega2,
            m0_e_y0_omega2,
            m0_e_x0_omega2,
            two_cx,
            two_bx,
            two_cy,
            two_by,
            k2,
            k3,
            e_y0_omega2,
            e_x0_omega2,
            two_e_y0_omega2,
            two_e_x0_omega2,
            four_e_x0_omega2,
            four_e_y0_omega2,
            quarter_m0,
            e_y0_omega,
            e_x0_omega,
            minus_m2,
            k4,
            k5,
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
    e_omega: S,
    /// `J0*omega^2`
    J0_omega2: S,
    /// `0.5*J`
    half_J: S,
    /// `0.5*m`
    half_m: S,
    /// `2*y0`
    two_y0: S,
    /// `2*x0`
    two_x0: S,
    /// `y0^2`
    y0_squared: S,
    /// `x0^2`
    x0_squared: S,
    /// `0.5*m0`
    half_m0: S,
    /// `cx*yc^2 + cy*xc^2`
    cx_yc2_plus_cy_xc2: S,
    /// `bx*yc^2 + by*xc^2`
    bx_yc2_plus_by_xc2: S,
    /// `J + m0*x0^2 + m0*y0^2`
    k0: S,
    /// `m0*y0`
    m0_y0: S,
    /// `m0*x0`
    m0_x0: S,
    /// `m1 + m2`
    m1_plus_m2: S,
    /// `m + m0 + m1 + m2`
    k1: S,
    /// `e*omega^2`
    e_omega2: S,
    /// `m0*e*omega^2`
    m0_e_omega2: S,
    /// `m0*e*y0*omega^2`
    m0_e_y0_omega2: S,
    /// `m0*e*x0*omega^2`
    m0_e_x0_omega2: S,
    /// `2*cx`
    two_cx: S,
    /// `2*bx`
    two_bx: S,
    /// `2*cy`
    two_cy: S,
    /// `2*by`
    two_by: S,
    /// `2*(cx*yc^2 + cy*xc^2)`
    k2: S,
    /// `2*(bx*yc^2 + by*xc^2)`
    k3: S,
    /// `e*y0*omega^2`
    e_y0_omega2: S,
    /// `e*x0*omega^2`
    e_x0_omega2: S,
    /// `2*e*y0*omega^2`
    two_e_y0_omega2: S,
    /// `2*e*x0*omega^2`
    two_e_x0_omega2: S,
    /// `4*e*x0*omega^2`
    four_e_x0_omega2: S,
    /// `4*e*y0*omega^2`
    four_e_y0_omega2: S,
    /// `0.25*m0`
    quarter_m0: S,
    /// `e*y0*omega`
    e_y0_omega: S,
    /// `e*x0*omega`
    e_x0_omega: S,
    /// `-m2`
    minus_m2: S,
    /// `1/(J + m0*x0^2 + m0*y0^2)`
    k4: S,
    /// `1/(m1 + m2)`
    k5: S,
    /// Why these parameters leave the machine without accelerations, if they do.
    singular: Option<::lagrangian::emitted::Singular>,
}

/// A pivot of an elimination that is not above this share of its diagonal element may be rounding
/// errors alone.
const PIVOTS: ::lagrangian::emitted::Pivots = ::lagrangian::emitted::Pivots::new(9, 9);

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
    let t1 = s1 * p.m1_plus_m2;
    let t2 = p.m2 * s2;
    let t3 = cos_phi1 * sin_phi2;
    let t4 = sin_phi1 * cos_phi2;
    let t5 = sin_phi1 * sin_phi2 + cos_phi1 * cos_phi2;
    let zero = S::ZERO;
    let m31 = -(theta * p.m0_x0 + p.m0_y0);
    let m32 = p.m0_x0 - theta * p.m0_y0;
    let m41 = cos_phi1 * p.m1_plus_m2;
    let m42 = sin_phi1 * p.m1_plus_m2;
    let m51 = -(sin_phi1 * t1);
    let m52 = cos_phi1 * t1;
    let m55 = s1 * t1;
    let m71 = cos_phi2 * p.m2;
    let m72 = sin_phi2 * p.m2;
    let m74 = p.m2 * t5;
    let m75 = t0 * (t3 - t4);
    let m81 = sin_phi2 * (s2 * p.minus_m2);
    let m82 = cos_phi2 * t2;
    let m84 = t2 * (t4 - t3);
    let m85 = t0 * s2 * t5;
    let m88 = s2 * t2;
    [
        [p.k1, zero, m31, m41, m51, zero, m71, m81, zero],
        [zero, p.k1, m32, m42, m52, zero, m72, m82, zero],
        [m31, m32, p.k0, zero, zero, zero, zero, zero, zero],
        [m41, m42, zero, p.m1_plus_m2, zero, zero, m74, m84, zero],
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
    let t32 = (y_dot + t20 * p.e_omega) * (theta_dot * p.m0_y0);
    let t33 = p.m2 * t28 + p.m1 * t23;
    let t34 = t25 * (cos_phi2 * phi2_dot);
    let t35 = t28 * (sin_phi2 * phi2_dot);
    let t36 = t30 * p.m2 + t26 * p.m1;
    let t37 = p.m2 * t31 + p.m1 * t27;
    let t38 = (x_dot - t24 * p.e_omega) * (theta_dot * p.m0_x0);
    let t39 = t29 * (cos_phi1 * phi1_dot);
    let t40 = t33 * (sin_phi1 * phi1_dot);
    let t41 = t24 * p.m0_e_x0_omega2 - t20 * p.m0_e_y0_omega2;
    let t42 = sin_phi2 * (s2_dot * t28 + t2 * t25);
    let t43 = t32 - t24 * (p.m0_e_y0_omega2 * theta) + t41;
    let t44 = sin_phi1 * (s1_dot * t33 + t1 * t29);
    let t45 = t22 * t25 + t31 * (cos_phi2 * s2) - (t28 * t16 - t30 * (sin_phi2 * s2));
    let t46 = t19 * t29 + t37 * (cos_phi1 * s1) - (t33 * t13 - t36 * (sin_phi1 * s1));
    let t47 = t34 - t35 - (t34 + sin_phi2 * t31 - (t35 + cos_phi2 * t30));
    let h_x = -(t36 + (t4 * p.m0_x0 + p.m0_e_omega2 * t20));
    let h_y = t37 - (t4 * p.m0_y0 + p.m0_e_omega2 * t24);
    let h_theta = t38 + t32 - (t38 - t20 * (p.m0_e_x0_omega2 * theta) + t43);
    let h_s1 = t39 + sin_phi1 * t37 - (t40 + cos_phi1 * t36) - (t39 - t40);
    let h_phi1 = t46 - (cos_phi1 * (s1_dot * t29 - t1 * t33) - t44);
    let zero = S::ZERO;
    let h_s2 = p.minus_m2 * t47;
    let h_phi2 = p.minus_m2 * (cos_phi2 * (s2_dot * t25 - t2 * t28) - t42 - t45);
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
    let q_x = -(p.two_bx * x_dot + p.two_cx * x);
    let q_y = -(p.two_by * y_dot + p.two_cy * y);
    let q_theta = -(p.k3 * theta_dot + p.k2 * theta);
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
    let t24 = (y_dot + t15 * p.e_omega) * (theta_dot * p.m0_y0);
    let t25 = t10 - t12;
    let t26 = x_dot + t22;
    let t27 = t14 + (t14 + phi1_dot * t6);
    let t28 = t18 + (t18 - phi1_dot * t11);
    let t29 = (x_dot - t19 * p.e_omega) * (theta_dot * p.m0_x0);
    let t30 = p.m2 * t23 + p.m1 * t21;
    let t31 = t25 + t26;
    let t32 = t16 + (t16 + phi2_dot * t9) + t27;
    let t33 = t17 + (t17 - phi2_dot * t12) + t28;
    let t34 = t19 * p.m0_e_x0_omega2 - t15 * p.m0_e_y0_omega2;
    let t35 = p.m2 * t31 + p.m1 * t26;
    let t36 = t23 * (cos_phi2 * phi2_dot);
    let t37 = t31 * (sin_phi2 * phi2_dot);
    let t38 = t32 * p.m2 + t27 * p.m1;
    let t39 = p.m2 * t33 + p.m1 * t28;
    let t40 = t24 - t19 * (theta * p.m0_e_y0_omega2) + t34;
    let t41 = t30 * (cos_phi1 * phi1_dot);
    let t42 = t35 * (sin_phi1 * phi1_dot);
    let t43 = sin_phi2 * (s2_dot * t31 + t2 * t23);
    let t44 = t29 + t24 - (t29 - t15 * (theta * p.m0_e_x0_omega2) + t40);
    let t45 = sin_phi1 * (s1_dot * t35 + t1 * t30);
    let t46 = t25 * t23 + t33 * (cos_phi2 * s2) - (t31 * t20 - t32 * (sin_phi2 * s2));
    let t47 = t38 + (t4 * p.m0_x0 + p.m0_e_omega2 * t15);
    let t48 = t4 * p.m0_y0 + p.m0_e_omega2 * t19 - t39;
    let t49 = t22 * t30 + t39 * (cos_phi1 * s1) - (t35 * t13 - t38 * (sin_phi1 * s1));
    let f_x = t47 - (p.two_bx * x_dot + p.two_cx * x);
    let f_y = t48 - (p.two_by * y_dot + p.two_cy * y);
    let f_theta = -(theta_dot * p.k3 + theta * p.k2 + t44);
    let f_s1 = t41 - t42 - (t41 + sin_phi1 * t39 - (t42 + cos_phi1 * t38));
    let f_phi1 = cos_phi1 * (s1_dot * t30 - t1 * t35) - t45 - t49;
    let zero = S::ZERO;
    let f_s2 = p.m2 * (t36 - t37 - (t36 + sin_phi2 * t33 - (t37 + cos_phi2 * t32)));
    let f_phi2 = p.m2 * (cos_phi2 * (s2_dot * t23 - t2 * t31) - t43 - t46);
    [f_x, f_y, f_theta, f_s1, f_phi1, zero, f_s2, f_phi2, zero]
}

::lagrangian::emitted::fast_function! {
    /// Accelerations `a`, the solution of `M a = f` from the mass matrix, factored.
    ///
    /// A pivot that vanishes is an error.
    ///
    /// Row after row, an unknown is eliminated from the rows that follow. Comments name these
    /// numbers where they are computed, up to signs and factors that depend on parameters alone;
    /// sums are over the rows `k` before, in the last line over those after:
    ///
    /// ```text
    /// l[i, j] = (M[i, j] - sum l[i, k]*l[j, k]*d[k])/d[j]
    /// d[i] = M[i, i] - sum l[i, k]^2*d[k]
    /// z[i] = f[i] - sum l[i, k]*z[k]
    /// a[i] = z[i]/d[i] - sum l[k, i]*a[k]
    /// ```
    pub fn accelerations<'a, S>(Accelerations {
        p: &'a Prepared<S>,
        t: S,
        q: &'a [S; 9],
        v: &'a [S; 9],
    }) -> Result<[S; 9], ::lagrangian::emitted::Singular> = accelerations_in;
}

#[inline(always)]
fn accelerations_in<S: Copy, N: ::lagrangian::emitted::Scalar<Stored = S>>(
    call: Accelerations<'_, S>,
) -> Result<[S; 9], ::lagrangian::emitted::Singular> {
    let Accelerations { p, t, q, v } = call;
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
    let t1 = n(p.m0_x0).mul_add(theta, n(p.m0_y0));
    let t2 = theta.neg_mul_add(n(p.m0_y0), n(p.m0_x0));
    let t3 = n(p.m1_plus_m2) * s1;
    let t4 = s1 * phi1_dot;
    let t5 = s2 * phi2_dot;
    let t6 = n(p.omega).product_error(n(t));
    // Eliminates theta from row x: l[x, theta].
    let t7 = t1 * n(p.k4);
    // Eliminates theta from row y: l[y, theta].
    let t8 = t2 * n(p.k4);
    let t9 = s1 * t3;
    let t10 = s2 * n(p.m2);
    let t11 = s1 * n(p.m2);
    let t12 = theta_dot * theta_dot;
    let t13 = s2 * t10;
    let t14 = cos_phi1 * n(p.m1_plus_m2);
    let t15 = sin_phi1 * n(p.m1_plus_m2);
    let t16 = sin_phi1 * t3;
    let t17 = sin_phi2 * s2_dot;
    let t18 = sin_phi1 * s1_dot;
    let t19 = cos_phi1 * t4;
    let t20 = cos_phi2 * s2_dot;
    // Eliminates s1 from row x: l[x, s1].
    let t21 = t14 * n(p.k5);
    // Eliminates s1 from row y: l[y, s1].
    let t22 = t15 * n(p.k5);
    let t23 = sin_phi1.mul_add(sin_phi2, cos_phi1 * cos_phi2);
    let t24 = cos_phi1 * s1_dot;
    let t25 = sin_phi1 * t4;
    let t26 = cos_phi2 * t5;
    let t27 = t18 + t19;
    // Row x: pivot d[x].
    let t28 = t14.neg_mul_add(t21, t1.neg_mul_add(t7, n(p.k1)));
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
    // Eliminates s1 from row s2: l[s2, s1].
    let t39 = n(p.k5) * t30;
    let t40 = t17 + t26;
    let t41 = y_dot + t27;
    let t42 = t20 - t32;
    let t43 = x_dot + t34;
    let t44 = t6.mul_add(cos_t0, sin_t0);
    let t45 = t14.neg_mul_add(t39, cos_phi2 * n(p.m2));
    let t46 = t40 + t41;
    let t47 = t33 + phi1_dot.neg_mul_add(t25, t33);
    let t48 = t42 + t43;
    let t49 = t37 + phi1_dot.mul_add(t19, t37);
    // Eliminates x from row y: l[y, x].
    let t50 = t29 * t35;
    // Eliminates x from row phi1: l[phi1, x].
    let t51 = t16 * t35;
    let t52 = n(p.m0_y0) * theta_dot * t38.mul_add(n(p.e_omega), y_dot);
    let t53 = sin_phi1.mul_sub(cos_phi2, cos_phi1 * sin_phi2);
    let t54 = t15.neg_mul_add(t22, t2.neg_mul_add(t8, n(p.k1)));
    // Row y: pivot d[y].
    let t55 = t29.neg_mul_add(t50, t54);
    let t56 = t29.mul_add(t51, cos_phi1 * t3);
    // Eliminates x from row s2: l[s2, x].
    let t57 = t35 * t45;
    let t58 = t31 + phi2_dot.neg_mul_add(t32, t31) + t47;
    let t59 = N::ONE / t55;
    let t60 = t36 + phi2_dot.mul_add(t26, t36) + t49;
    let t61 = n(p.m2).mul_add(t46, t41 * n(p.m1));
    let t62 = n(p.m2).mul_add(t48, t43 * n(p.m1));
    let t63 = n(p.m0_e_y0_omega2) * t38;
    let t64 = n(p.e_omega).neg_mul_add(t44, x_dot);
    let t65 = n(p.m0_x0) * theta_dot * t64;
    let t66 = t10 * t53;
    let t67 = t15.neg_mul_add(t39, sin_phi2 * n(p.m2));
    let t68 = t29.neg_mul_add(t57, t67);
    let t69 = t46 * (cos_phi2 * phi2_dot);
    let t70 = t48 * (sin_phi2 * phi2_dot);
    let t71 = t61 * (cos_phi1 * phi1_dot);
    let t72 = n(p.m2).mul_add(t58, t47 * n(p.m1));
    let t73 = t62 * (sin_phi1 * phi1_dot);
    let t74 = n(p.m2).mul_add(t60, t49 * n(p.m1));
    let t75 = (theta * n(p.m0_e_y0_omega2)).neg_mul_add(t44, t52);
    // Eliminates s1 from row phi2: l[phi2, s1].
    let t76 = n(p.k5) * t66;
    // Eliminates y from row phi1: l[phi1, y].
    let t77 = t56 * t59;
    // Eliminates y from row s2: l[s2, y].
    let t78 = t59 * t68;
    // Row phi1: pivot d[phi1].
    let t79 = t56.neg_mul_add(t77, t16.neg_mul_add(t51, t9));
    let t80 = (theta * n(p.m0_e_x0_omega2)).neg_mul_add(t38, t65);
    let t81 = t14.mul_add(t76, sin_phi2 * t10);
    let t82 = N::ONE / t79;
    let t83 = t56.neg_mul_add(t78, t16.mul_sub(t57, t11 * t53));
    let t84 = t75 + n(p.m0_e_x0_omega2).mul_sub(t44, t63) + t80;
    // Eliminates x from row phi2: l[phi2, x].
    let t85 = t35 * t81;
    // Eliminates phi1 from row s2: l[s2, phi1].
    let t86 = t82 * t83;
    let t87 = t45.neg_mul_add(t57, t30.neg_mul_add(t39, n(p.m2)));
    let t88 = sin_phi2.mul_add(t58, t69) - cos_phi2.mul_add(t60, t70);
    let t89 = sin_phi1.mul_add(t72, t71) - cos_phi1.mul_add(t74, t73);
    let t90 = t71 - t73 - t89;
    let t91 = theta.mul_add(n(p.k2), theta_dot * n(p.k3));
    let t92 = t91 + (t52 + t65 - t84);
    let t93 = t74 + t38.mul_add(n(p.m0_e_omega2), n(p.m0_x0) * t12);
    let t94 = t44.mul_add(n(p.m0_e_omega2), n(p.m0_y0) * t12) - t72;
    let t95 = t29.mul_add(t85, t15.neg_mul_add(t76, cos_phi2 * t10));
    let t96 = sin_phi2 * t5.mul_add(t46, s2_dot * t48);
    let t97 = t60.neg_mul_add(sin_phi2 * s2, t40 * t48);
    // Row s2: pivot d[s2].
    let t98 = t83.neg_mul_add(t86, t68.neg_mul_add(t78, t87));
    let t99 = t93 - n(p.two_cx).mul_add(x, x_dot * n(p.two_bx));
    let t100 = t94 - n(p.two_cy).mul_add(y, y_dot * n(p.two_by));
    let t101 = sin_phi1 * t4.mul_add(t61, s1_dot * t62);
    let t102 = t74.neg_mul_add(sin_phi1 * s1, t27 * t62);
    // Eliminates y from row phi2: l[phi2, y].
    let t103 = t59 * t95;
    let t104 = cos_phi2.mul_sub(s2_dot.mul_sub(t46, t5 * t48), t96);
    let t105 = N::ONE / t98;
    // Row x: right-hand side z[x].
    let t106 = t21.neg_mul_add(t90, t7.neg_mul_add(t92, t99));
    let t107 = cos_phi1.mul_sub(s1_dot.mul_sub(t61, t4 * t62), t101);
    let t108 = t16.neg_mul_add(t85, s2 * t11 * t23);
    let t109 = t56.neg_mul_add(t103, t108);
    let t110 = t104 - (t58.mul_add(cos_phi2 * s2, t42 * t46) - t97);
    let t111 = t39.neg_mul_add(t90, n(p.m2) * (t69 - t70 - t88));
    let t112 = t22.neg_mul_add(t90, t8.mul_add(t92, t100));
    // Row y: right-hand side z[y].
    let t113 = t50.neg_mul_add(t106, t112);
    let t114 = t107 - (t72.mul_add(cos_phi1 * s1, t34 * t61) - t102);
    // Eliminates phi1 from row phi2: l[phi2, phi1].
    let t115 = t82 * t109;
    // Row phi1: right-hand side z[phi1].
    let t116 = t77.neg_mul_add(t113, t51.mul_add(t106, t114));
    let t117 = t68.mul_add(t103, t45.neg_mul_add(t85, t30 * t76));
    let t118 = t83.mul_add(t115, t117);
    let t119 = t85.mul_add(t106, n(p.m2).mul_sub(t110, t76 * t90));
    let t120 = t81.neg_mul_add(t85, t66.neg_mul_add(t76, t13));
    let t121 = t78.neg_mul_add(t113, t57.neg_mul_add(t106, t111));
    // Row s2: right-hand side z[s2].
    let t122 = t86.neg_mul_add(t116, t121);
    // Eliminates s2 from row phi2: l[phi2, s2].
    let t123 = t105 * t118;
    let t124 = t115.neg_mul_add(t116, t103.neg_mul_add(t113, t119));
    let t125 = t109.neg_mul_add(t115, t95.neg_mul_add(t103, t120));
    // Row phi2: pivot d[phi2].
    let t126 = t118.neg_mul_add(t123, t125);
    // Row phi2: right-hand side z[phi2].
    let phi2_ddot = t122.mul_add(t123, t124) / t126;
    // Back substitution: a[s2].
    let s2_ddot = t123.mul_add(phi2_ddot, t105 * t122);
    let t127 = t115.neg_mul_add(phi2_ddot, t82 * t116);
    // Back substitution: a[phi1].
    let phi1_ddot = t86.neg_mul_add(s2_ddot, t127);
    let t128 = t85.mul_add(phi2_ddot, t35 * t106);
    let t129 = t103.neg_mul_add(phi2_ddot, t59 * t113);
    let t130 = t76.mul_sub(phi2_ddot, n(p.k5) * t90);
    // Back substitution: a[y].
    let y_ddot = t77.neg_mul_add(phi1_ddot, t78.neg_mul_add(s2_ddot, t129));
    let t131 = t51.mul_add(phi1_ddot, t57.neg_mul_add(s2_ddot, t128));
    // Back substitution: a[x].
    let x_ddot = t50.neg_mul_add(y_ddot, t131);
    let t132 = t22.mul_add(y_ddot, t39.mul_add(s2_ddot, t130));
    // Back substitution: a[theta].
    let theta_ddot = t7.mul_sub(x_ddot, t8.mul_add(y_ddot, n(p.k4) * t92));
    // Back substitution: a[s1].
    let s1_ddot = -t21.mul_add(x_ddot, t132);
    let zero = N::ZERO;
    let sound = PIVOTS.hold(t28, n(p.k1))
        & PIVOTS.hold(t55, n(p.k1))
        & PIVOTS.hold(t79, t9)
        & PIVOTS.hold(t98, n(p.m2))
        & PIVOTS.hold(t126, t13)
        & s1_ddot.is_finite();
    if !sound {
        let pivots = [
            (0, t28, n(p.k1)),
            (1, t55, n(p.k1)),
            (4, t79, t9),
            (6, t98, n(p.m2)),
            (7, t126, t13),
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
    let t6 = y_dot + p.e_omega * (cos_t0 - t2 * sin_t0);
    let t7 = x_dot + (cos_phi1 * s1_dot - t1 * sin_phi1);
    let t8 = x_dot - p.e_omega * (sin_t0 + t2 * cos_t0);
    let t9 = y_dot + (t1 * cos_phi1 + sin_phi1 * s1_dot);
    let t10 = cos_phi2 * s2_dot - t3 * sin_phi2 + t7;
    let t11 = t3 * cos_phi2 + sin_phi2 * s2_dot + t9;
    let t12 = t5 * p.y0_squared - t8 * (t4 * p.two_x0);
    let t13 = p.half_m0 * (t8 * (theta_dot * p.two_y0) - t6 * (theta_dot * p.two_x0));
    let t14 = (t9 * t9 + t7 * t7) * p.m1 + theta1_dot * (theta1_dot * p.J1);
    let t15 = p.half_m * (y_dot * y_dot + x_dot * x_dot) + t5 * p.half_J;
    let t16 = p.half_m0 * (t5 * p.x0_squared - t6 * (t4 * p.two_y0) + t12) - t13;
    let t17 = (t11 * t11 + t10 * t10) * p.m2 + theta2_dot * (theta2_dot * p.J2);
    let t18 = S::from_f64(0.5) * ((t6 * t6 + t8 * t8) * p.m0 + p.J0_omega2) + t16;
    t18 + (S::from_f64(0.5) * t17 + (S::from_f64(0.5) * t14 + t15))
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
    let t0 = theta * (theta * p.cx_yc2_plus_cy_xc2);
    t0 + (y * (y * p.cy) + x * (x * p.cx))
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
    theta_dot * (theta_dot * p.bx_yc2_plus_by_xc2) + t0
}

/// Power `P` supplied by drives, forces and inputs, in W.
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
    let t5 = t3 * p.e_omega2;
    let t6 = t3 * p.e_omega;
    let t7 = t4 * p.e_omega;
    let t8 = t4 * p.e_omega2;
    let t9 = t3 * theta_dot;
    let t10 = t4 * theta_dot;
    let t11 = x_dot - t6;
    let t12 = t7 + y_dot;
    let t13 = theta * t9;
    let t14 = theta * t10;
    let t15 = t3 * (theta_ddot * p.e_y0_omega) + t10 * p.e_y0_omega2;
    let t16 = t4 * (t2 * p.e_y0_omega) + t10 * (p.e_y0_omega * theta_dot);
    let t17 = t3 * (t2 * p.e_x0_omega) + t9 * (theta_dot * p.e_x0_omega);
    let t18 = t5 * t12 - t7 * (y_ddot - t5) + (t6 * (x_ddot - t8) + t8 * t11);
    let t19 = (t10 * p.two_e_y0_omega2 - t9 * p.two_e_x0_omega2) * p.half_m0;
    let t20 = t18 - (t15 - (t9 * p.e_x0_omega2 - t4 * (theta_ddot * p.e_x0_omega)));
    let t21 = p.quarter_m0 * (t13 * p.four_e_y0_omega2 + t14 * p.four_e_x0_omega2);
    let t22 = (t20 - (t13 * p.e_y0_omega2 - t16 + (t14 * p.e_x0_omega2 + t17))) * p.m0;
    (t3 * t12 + t4 * t11) * p.m0_e_omega2 - t19 - t21 - t22
}

/// Power `R` dissipated by dampers, in W.
///
/// ```text
/// R = 2*bx*der(x)^2 + 2*by*der(y)^2 + 2*(bx*yc^2 + by*xc^2)*der(theta)^2
/// ```
pub fn dissipation_rate<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, v: &[S; 9]) -> S {
    let x_dot = v[0];
    let y_dot = v[1];
    let theta_dot = v[2];
    let t0 = y_dot * (y_dot * p.two_by) + x_dot * (x_dot * p.two_bx);
    theta_dot * (theta_dot * p.k3) + t0
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
    inputs Inputs {} [], defined here
    outputs Outputs {} [], defined here
    prepared Prepared {
        m0, m1, m2, J1, J2, omega, cx, cy, bx, by, e_omega, J0_omega2, half_J, half_m, two_y0,
        two_x0, y0_squared, x0_squared, half_m0, cx_yc2_plus_cy_xc2, bx_yc2_plus_by_xc2, k0, m0_y0,
        m0_x0, m1_plus_m2, k1, e_omega2, m0_e_omega2, m0_e_y0_omega2, m0_e_x0_omega2, two_cx,
        two_bx, two_cy, two_by, k2, k3, e_y0_omega2, e_x0_omega2, two_e_y0_omega2, two_e_x0_omega2,
        four_e_x0_omega2, four_e_y0_omega2, quarter_m0, e_y0_omega, e_x0_omega, minus_m2, k4, k5,
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
