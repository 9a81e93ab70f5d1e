// @generated from machines/two_debalance_crusher.machine by `cargo xtask generate`; edits are lost.

//! A crusher that shakes along a line: two equal debalances turn against each other, with their
//! axes on opposite sides of the line, the x axis of the platform.
//!
//! Across the line their centrifugal forces cancel, along it they add up to 2 m0 e ω² cos ωt, and
//! their moments about the platform's centre are opposite. Platform, suspension, mortar and pestle
//! lie as mirrored in the line, so whatever starts on the line stays on it: y, theta, phi1 and phi2
//! remain zero, exactly. Without contact the platform is then one oscillator, whose closed form a
//! test holds it against:
//!
//! (m + 2 m0) x″ + 2 bx x′ + 2 cx x = 2 m0 e ω² cos ωt
//!
//! 9 coordinates, 22 parameters. Arithmetic of one call:
//!
//! | function | mul | add | div | sin cos | other | temporaries |
//! | --- | --: | --: | --: | --: | --: | --: |
//! | `prepare` | 22 | 10 | 2 | 0 | 0 | 34 |
//! | `mass_matrix` | 25 | 4 | 0 | 3 | 0 | 35 |
//! | `bias` | 53 | 35 | 0 | 4 | 0 | 96 |
//! | `applied` | 14 | 20 | 0 | 0 | 0 | 34 |
//! | `forces` | 67 | 51 | 0 | 4 | 0 | 126 |
//! | `accelerations` | 73 | 45 | 2 | 3 | 0 | 126 |
//! | `kinetic_energy` | 44 | 34 | 0 | 4 | 0 | 86 |
//! | `potential_energy` | 8 | 7 | 0 | 0 | 0 | 15 |
//! | `dissipation` | 8 | 7 | 0 | 0 | 0 | 15 |
//! | `work_rate` | 18 | 17 | 0 | 2 | 0 | 39 |
//! | `dissipation_rate` | 8 | 7 | 0 | 0 | 0 | 15 |
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

/// A crusher that shakes along a line: two equal debalances turn against each other, with their
/// axes on opposite sides of the line, the x axis of the platform.
///
/// Across the line their centrifugal forces cancel, along it they add up to 2 m0 e ω² cos ωt, and
/// their moments about the platform's centre are opposite. Platform, suspension, mortar and pestle
/// lie as mirrored in the line, so whatever starts on the line stays on it: y, theta, phi1 and phi2
/// remain zero, exactly. Without contact the platform is then one oscillator, whose closed form a
/// test holds it against:
///
/// (m + 2 m0) x″ + 2 bx x′ + 2 cx x = 2 m0 e ω² cos ωt
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TwoDebalanceCrusher<S = f64> {
    /// Mass of the platform. Unit: `kg`. Default: 600.
    pub m: S,
    /// Mass of each debalance: half of the one that it takes the place of. Unit: `kg`. Default: 20.
    pub m0: S,
    /// `m1`. Unit: `kg`. Default: 180.
    pub m1: S,
    /// `m2`. Unit: `kg`. Default: 120.
    pub m2: S,
    /// `J`. Unit: `kg*m^2`. Default: 60.
    pub J: S,
    /// `J0`. Unit: `kg*m^2`. Default: 0.1.
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
    /// Inner radius of the cylinder, outer and inner radius of the mortar, radius of pestle. Unit:
    /// `m`. Default: 0.27.
    pub R: S,
    /// `r1`. Unit: `m`. Default: 0.25.
    pub r1: S,
    /// `rho`. Unit: `m`. Default: 0.2.
    pub rho: S,
    /// `r2`. Unit: `m`. Default: 0.17.
    pub r2: S,
}

impl<S: ::lagrangian::emitted::Scalar> TwoDebalanceCrusher<S> {
    /// Computes what depends on the parameters alone, once.
    pub fn prepare(&self) -> Prepared<S> {
        let t0 = self.m0 * S::from_f64(2.0);
        let m0_x0 = self.m0 * self.x0;
        let e_omega = self.omega * self.e;
        let m1_plus_m2 = self.m1 + self.m2;
        let pivot_1 = self.m + t0;
        let two_m0_x0 = m0_x0 * S::from_f64(2.0);
        let e_omega2 = self.omega * e_omega;
        let t1 = S::ONE / pivot_1;
        let k0 = m1_plus_m2 + pivot_1;
        let k1 = self.J + (t0 * (self.y0 * self.y0) + self.x0 * two_m0_x0);
        let pivot_2 = k1 - t1 * (m0_x0 * (m0_x0 * S::from_f64(4.0)));
        let t2 = S::ONE / pivot_2;
        let J0_omega2 = self.omega * (self.omega * self.J0);
        let half_cx = self.cx * S::from_f64(0.5);
        let half_cy = self.cy * S::from_f64(0.5);
        let half_bx = self.bx * S::from_f64(0.5);
        let half_by = self.by * S::from_f64(0.5);
        let m0_y0 = self.m0 * self.y0;
        let m0_e_omega = self.m0 * e_omega;
        let minus_two_m0_x0 = -two_m0_x0;
        let minus_m2 = -self.m2;
        let two_m0_e_omega2 = e_omega2 * t0;
        let k2 = two_m0_x0 * t1;
        let k3 = two_m0_x0 * t2;
        let k4 = -t1;
        let k5 = -t2;
        let pivots = [
            (5, self.J1, self.J1),
            (8, self.J2, self.J2),
            (6, self.m2, self.m2),
            (3, self.m1, m1_plus_m2),
            (1, pivot_1, k0),
            (0, pivot_1, k0),
            (2, pivot_2, k1),
        ];
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
            e_omega,
            J0_omega2,
            half_cx,
            half_cy,
            half_bx,
            half_by,
            e_omega2,
            m1_plus_m2,
            m0_x0,
            two_m0_x0,
            k0,
            m0_y0,
            m0_e_omega,
            k1,
            minus_two_m0_x0,
            minus_m2,
            two_m0_e_omega2,
            k2,
            k3,
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
        let q = [zero, zero, zero, s1, zero, zero, s2, zero, zero];
        let v = [S::ZERO; 9];
        ::lagrangian::emitted::State {
            t: 0.0,
            q: Coordinates::from_array(q),
            v: Coordinates::from_array(v),
        }
    }
}

/// The coordinates of [`TwoDebalanceCrusher`], or their rates, by name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coordinates<S = f64> {
    /// `x`. Unit: `m`.
    pub x: S,
    /// `y`. Unit: `m`.
    pub y: S,
    /// `theta`. Unit: `rad`.
    pub theta: S,
    /// On the line, where the platform does not reach it: |x| stays below s1. Unit: `m`.
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

/// The parameters of a [`TwoDebalanceCrusher`], with the work done that depends on them alone.
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
    e_omega: S,
    /// `J0*omega^2`
    J0_omega2: S,
    /// `0.5*cx`
    half_cx: S,
    /// `0.5*cy`
    half_cy: S,
    /// `0.5*bx`
    half_bx: S,
    /// `0.5*by`
    half_by: S,
    /// `e*omega^2`
    e_omega2: S,
    /// `m1 + m2`
    m1_plus_m2: S,
    /// `m0*x0`
    m0_x0: S,
    /// `2*m0*x0`
    two_m0_x0: S,
    /// `m + m1 + m2 + 2*m0`
    k0: S,
    /// `m0*y0`
    m0_y0: S,
    /// `m0*e*omega`
    m0_e_omega: S,
    /// `J + 2*m0*x0^2 + 2*m0*y0^2`
    k1: S,
    /// `-2*m0*x0`
    minus_two_m0_x0: S,
    /// `-m2`
    minus_m2: S,
    /// `2*m0*e*omega^2`
    two_m0_e_omega2: S,
    /// `2*m0*x0/(m + 2*m0)`
    k2: S,
    /// `2*m0*x0/(J + 2*m0*x0^2 + 2*m0*y0^2 - 4*m0^2*x0^2/(m + 2*m0))`
    k3: S,
    /// `-1/(m + 2*m0)`
    k4: S,
    /// `-1/(J + 2*m0*x0^2 + 2*m0*y0^2 - 4*m0^2*x0^2/(m + 2*m0))`
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
/// M[x, x] = m + 2*m0 + m1 + m2
/// M[y, y] = m + 2*m0 + m1 + m2
/// M[theta, x] = -2*m0*x0*sin(theta)
/// M[theta, y] = 2*m0*x0*cos(theta)
/// M[theta, theta] = 2*m0*x0^2 + 2*m0*y0^2 + J
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
    let (sin_theta, cos_theta) = theta.sin_cos();
    let t0 = s1 * p.m2;
    let t1 = s1 * p.m1_plus_m2;
    let t2 = p.m2 * s2;
    let t3 = cos_phi1 * sin_phi2;
    let t4 = sin_phi1 * cos_phi2;
    let t5 = sin_phi1 * sin_phi2 + cos_phi1 * cos_phi2;
    let zero = S::ZERO;
    let m31 = sin_theta * p.minus_two_m0_x0;
    let m32 = cos_theta * p.two_m0_x0;
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
        [p.k0, zero, m31, m41, m51, zero, m71, m81, zero],
        [zero, p.k0, m32, m42, m52, zero, m72, m82, zero],
        [m31, m32, p.k1, zero, zero, zero, zero, zero, zero],
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
/// h[x] = -2*m0*x0*cos(theta)*der(theta)^2 - 2*(m1 + m2)*sin(phi1)*der(s1)*der(phi1)
///     - (m1 + m2)*s1*cos(phi1)*der(phi1)^2 - 2*m2*sin(phi2)*der(s2)*der(phi2)
///     - m2*s2*cos(phi2)*der(phi2)^2 - 2*m0*e*omega^2*cos(omega*t)
/// h[y] = 2*(m1 + m2)*cos(phi1)*der(s1)*der(phi1) - 2*m0*x0*sin(theta)*der(theta)^2
///     - (m1 + m2)*s1*sin(phi1)*der(phi1)^2 + 2*m2*cos(phi2)*der(s2)*der(phi2)
///     - m2*s2*sin(phi2)*der(phi2)^2
/// h[theta] = …
/// h[s1] = -(m1 + m2)*s1*der(phi1)^2 - 2*m2*sin(phi2 - phi1)*der(s2)*der(phi2)
///     - m2*s2*cos(phi2 - phi1)*der(phi2)^2
/// h[phi1] = 2*(m1 + m2)*s1*der(s1)*der(phi1) + 2*m2*s1*cos(phi2 - phi1)*der(s2)*der(phi2)
///     - m2*s1*s2*sin(phi2 - phi1)*der(phi2)^2
/// h[s2] = 2*m2*sin(phi2 - phi1)*der(s1)*der(phi1) - m2*s1*cos(phi2 - phi1)*der(phi1)^2
///     - m2*s2*der(phi2)^2
/// h[phi2] = 2*m2*s2*cos(phi2 - phi1)*der(s1)*der(phi1) + m2*s1*s2*sin(phi2 - phi1)*der(phi1)^2
///     + 2*m2*s2*der(s2)*der(phi2)
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
    let theta_dot = v[2];
    let s1_dot = v[3];
    let phi1_dot = v[4];
    let s2_dot = v[6];
    let phi2_dot = v[7];
    let t0 = p.omega * t;
    let (sin_phi1, cos_phi1) = phi1.sin_cos();
    let (sin_theta, cos_theta) = theta.sin_cos();
    let (sin_phi2, cos_phi2) = phi2.sin_cos();
    let t1 = theta_dot * theta_dot;
    let (sin_t0, cos_t0) = t0.sin_cos();
    let t2 = phi1_dot * s1;
    let t3 = p.omega.product_error(t);
    let t4 = phi2_dot * s2;
    let t5 = S::from_f64(2.0) * s1_dot;
    let t6 = t1 * p.y0;
    let t7 = t1 * p.x0;
    let t8 = S::from_f64(2.0) * s2_dot;
    let t9 = t6 * sin_theta;
    let t10 = cos_theta * t7;
    let t11 = sin_theta * t7;
    let t12 = t6 * cos_theta;
    let t13 = p.e_omega2 * (cos_t0 - t3 * sin_t0);
    let t14 = phi1_dot * (t5 * sin_phi1 + cos_phi1 * t2);
    let t15 = p.e_omega2 * (sin_t0 + t3 * cos_t0);
    let t16 = phi1_dot * (sin_phi1 * t2 - t5 * cos_phi1);
    let t17 = t13 + (t9 + t10);
    let t18 = t13 + (t10 - t9);
    let t19 = phi2_dot * (t8 * sin_phi2 + cos_phi2 * t4) + t14;
    let t20 = t15 + (t11 + t12);
    let t21 = t15 + (t12 - t11);
    let t22 = phi2_dot * (sin_phi2 * t4 - t8 * cos_phi2) + t16;
    let t23 = t17 + t18;
    let t24 = t19 * p.m2 + t14 * p.m1;
    let t25 = t20 - t21;
    let t26 = p.m2 * t22 + p.m1 * t16;
    let t27 = cos_theta * (t25 * p.m0_x0 - p.m0_y0 * (t18 - t17));
    let h_x = -(p.m0 * t23 + t24);
    let h_y = -(p.m0 * t25 + t26);
    let h_theta = sin_theta * (t23 * p.m0_x0 + p.m0_y0 * (t21 + t20)) - t27;
    let h_s1 = -(cos_phi1 * t24 + sin_phi1 * t26);
    let h_phi1 = -(s1 * (cos_phi1 * t26 - sin_phi1 * t24));
    let zero = S::ZERO;
    let h_s2 = p.minus_m2 * (cos_phi2 * t19 + sin_phi2 * t22);
    let h_phi2 = (cos_phi2 * t22 - sin_phi2 * t19) * (s2 * p.minus_m2);
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
    let t0 = theta * p.xc;
    let t1 = p.yc * theta;
    let t2 = theta_dot * p.xc;
    let t3 = theta_dot * p.yc;
    let t4 = p.by * (y_dot - t2) + p.cy * (y - t0);
    let t5 = p.by * (t2 + y_dot) + p.cy * (t0 + y);
    let t6 = p.bx * (x_dot - t3) + p.cx * (x - t1);
    let t7 = p.bx * (t3 + x_dot) + p.cx * (t1 + x);
    let q_x = -(t6 + t7);
    let q_y = -(t4 + t5);
    let q_theta = -(p.yc * (t7 - t6) + p.xc * (t5 - t4));
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
    let t0 = p.omega * t;
    let (sin_theta, cos_theta) = theta.sin_cos();
    let (sin_phi1, cos_phi1) = phi1.sin_cos();
    let (sin_phi2, cos_phi2) = phi2.sin_cos();
    let t1 = theta_dot * theta_dot;
    let (sin_t0, cos_t0) = t0.sin_cos();
    let t2 = p.omega.product_error(t);
    let t3 = phi1_dot * s1;
    let t4 = theta * p.xc;
    let t5 = phi2_dot * s2;
    let t6 = t1 * p.y0;
    let t7 = t1 * p.x0;
    let t8 = S::from_f64(2.0) * s1_dot;
    let t9 = p.yc * theta;
    let t10 = theta_dot * p.xc;
    let t11 = S::from_f64(2.0) * s2_dot;
    let t12 = theta_dot * p.yc;
    let t13 = p.by * (y_dot - t10) + p.cy * (y - t4);
    let t14 = p.by * (t10 + y_dot) + p.cy * (t4 + y);
    let t15 = p.bx * (x_dot - t12) + p.cx * (x - t9);
    let t16 = p.bx * (t12 + x_dot) + p.cx * (t9 + x);
    let t17 = t6 * sin_theta;
    let t18 = sin_theta * t7;
    let t19 = cos_theta * t7;
    let t20 = t6 * cos_theta;
    let t21 = p.e_omega2 * (cos_t0 - t2 * sin_t0);
    let t22 = p.e_omega2 * (sin_t0 + t2 * cos_t0);
    let t23 = phi1_dot * (t8 * sin_phi1 + cos_phi1 * t3);
    let t24 = t21 + (t17 + t19);
    let t25 = t21 + (t19 - t17);
    let t26 = t22 + (t18 + t20);
    let t27 = t22 + (t20 - t18);
    let t28 = phi2_dot * (t11 * sin_phi2 + cos_phi2 * t5) + t23;
    let t29 = phi1_dot * (sin_phi1 * t3 - t8 * cos_phi1);
    let t30 = t24 + t25;
    let t31 = t26 - t27;
    let t32 = t28 * p.m2 + t23 * p.m1;
    let t33 = phi2_dot * (sin_phi2 * t5 - t11 * cos_phi2) + t29;
    let t34 = p.m2 * t33 + p.m1 * t29;
    let t35 = cos_theta * (t31 * p.m0_x0 - p.m0_y0 * (t25 - t24));
    let t36 = sin_theta * (t30 * p.m0_x0 + p.m0_y0 * (t27 + t26));
    let f_x = p.m0 * t30 + (t32 - (t15 + t16));
    let f_y = p.m0 * t31 + (t34 - (t13 + t14));
    let f_theta = t35 - (p.yc * (t16 - t15) + p.xc * (t14 - t13)) - t36;
    let f_s1 = cos_phi1 * t32 + sin_phi1 * t34;
    let f_phi1 = s1 * (cos_phi1 * t34 - sin_phi1 * t32);
    let zero = S::ZERO;
    let f_s2 = p.m2 * (cos_phi2 * t28 + sin_phi2 * t33);
    let f_phi2 = (cos_phi2 * t33 - sin_phi2 * t28) * (s2 * p.m2);
    [f_x, f_y, f_theta, f_s1, f_phi1, zero, f_s2, f_phi2, zero]
}

::lagrangian::emitted::fast_function! {
    /// Accelerations `a`, the solution of `M a = f` eliminated along the machine.
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
    let x_dot = n(v[0]);
    let y_dot = n(v[1]);
    let theta_dot = n(v[2]);
    let s1_dot = n(v[3]);
    let phi1_dot = n(v[4]);
    let s2_dot = n(v[6]);
    let phi2_dot = n(v[7]);
    let t0 = n(p.omega) * n(t);
    let angles = [theta, phi1, t0];
    let circular = N::sin_cos_all(angles);
    let (sin_theta, cos_theta) = circular[0];
    let (sin_phi1, cos_phi1) = circular[1];
    let (sin_t0, cos_t0) = circular[2];
    let t1 = theta * n(p.xc);
    let t2 = theta * n(p.yc);
    let t3 = n(p.xc) * theta_dot;
    let t4 = n(p.yc) * theta_dot;
    let t5 = theta_dot * theta_dot;
    let t6 = n(p.omega).product_error(n(t));
    let t7 = (t1 + y).mul_add(n(p.cy), (t3 + y_dot) * n(p.by));
    let t8 = (y - t1).mul_add(n(p.cy), (y_dot - t3) * n(p.by));
    let t9 = (t2 + x).mul_add(n(p.cx), (t4 + x_dot) * n(p.bx));
    let t10 = (x - t2).mul_add(n(p.cx), (x_dot - t4) * n(p.bx));
    let t11 = s1 * s1;
    let t12 = s2 * (s2 * n(p.m2));
    let t13 = n(p.xc).mul_add(t8, n(p.yc) * t10);
    let t14 = cos_theta * t5;
    let t15 = cos_theta * n(p.x0);
    let t16 = sin_theta * t5;
    let t17 = sin_theta * n(p.y0);
    let t18 = sin_theta * n(p.x0);
    let t19 = cos_theta * n(p.y0);
    let t20 = sin_t0.neg_mul_add(t6, cos_t0);
    let t21 = n(p.x0) * t16;
    let t22 = t16.neg_mul_add(n(p.two_m0_x0), t7 + t8);
    let t23 = cos_t0.mul_add(t6, sin_t0);
    let t24 = t23.mul_add(n(p.e_omega2), t14 * n(p.y0));
    let t25 = t16 * n(p.y0);
    let t26 = t20.mul_add(n(p.e_omega2), t14 * n(p.x0));
    let t27 = n(p.xc).mul_add(t7, n(p.yc) * t9) - t13;
    let t28 = t14.neg_mul_add(n(p.two_m0_x0), t9 + t10);
    let t29 = t20.neg_mul_add(n(p.two_m0_e_omega2), t28);
    let t30 = (cos_theta * n(p.k2)).neg_mul_add(t22, t27);
    let t31 = sin_phi1 * n(p.k4);
    let t32 = cos_phi1 * n(p.k4);
    let t33 = (t26 - t25) * ((t18 + t19) * n(p.m0));
    let t34 = (t25 + t26) * (n(p.m0) * (t19 - t18));
    let t35 = ((t15 + t17) * n(p.m0)).mul_add(t24 - t21, t33);
    let t36 = (t21 + t24).mul_add(n(p.m0) * (t15 - t17), t34);
    let t37 = (sin_theta * n(p.k2)).mul_add(t29, t30) + t35 - t36;
    let t38 = t37 * n(p.k3);
    // Back substitution: a[x].
    let t39 = sin_theta.mul_add(t38, t29);
    // Back substitution: a[y].
    let t40 = cos_theta.neg_mul_add(t38, t22);
    let t41 = t31.neg_mul_add(t39, N::from_f64(2.0) * s1_dot * phi1_dot);
    // Eliminates s1: alone z[s1].
    let t42 = t32.neg_mul_add(t39, phi1_dot * (phi1_dot * s1));
    let x_ddot = n(p.k4) * t39;
    let y_ddot = n(p.k4) * t40;
    let theta_ddot = t37 * n(p.k5);
    // Back substitution: a[s1].
    let s1_ddot = t31.neg_mul_add(t40, t42);
    // Back substitution: a[phi1].
    let phi1_ddot = -(t32.mul_add(t40, t41) / s1);
    let zero = N::ZERO;
    // Eliminates s2: alone z[s2]; Back substitution: a[s2].
    let s2_ddot = phi2_dot * (phi2_dot * s2);
    let phi2_ddot = N::from_f64(-2.0) * s2_dot * phi2_dot / s2;
    let t43 = t11 * n(p.m1);
    let t44 = t11 * n(p.m1_plus_m2);
    let sound = PIVOTS.hold(t12, t12) & PIVOTS.hold(t43, t44) & phi1_ddot.is_finite();
    if !sound {
        let pivots = [(7, t12, t12), (4, t43, t44)];
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
    let (sin_theta, cos_theta) = theta.sin_cos();
    let (sin_phi2, cos_phi2) = phi2.sin_cos();
    let t1 = phi1_dot * s1;
    let (sin_t0, cos_t0) = t0.sin_cos();
    let t2 = p.omega.product_error(t);
    let t3 = theta_dot * p.x0;
    let t4 = theta_dot * p.y0;
    let t5 = phi2_dot * s2;
    let t6 = x_dot - t3 * sin_theta;
    let t7 = cos_theta * t4;
    let t8 = t3 * cos_theta + y_dot;
    let t9 = sin_theta * t4;
    let t10 = p.e_omega * (sin_t0 + t2 * cos_t0);
    let t11 = x_dot + (cos_phi1 * s1_dot - t1 * sin_phi1);
    let t12 = p.e_omega * (cos_t0 - t2 * sin_t0);
    let t13 = y_dot + (t1 * cos_phi1 + sin_phi1 * s1_dot);
    let t14 = t10 - (t6 + t7);
    let t15 = t6 - t7 - t10;
    let t16 = cos_phi2 * s2_dot - t5 * sin_phi2 + t11;
    let t17 = t12 - (t8 + t9);
    let t18 = t12 + (t8 - t9);
    let t19 = t5 * cos_phi2 + sin_phi2 * s2_dot + t13;
    let t20 = (y_dot * y_dot + x_dot * x_dot) * p.m + theta_dot * (theta_dot * p.J);
    let t21 = p.J0_omega2 + p.m0 * (t18 * t18 + t15 * t15);
    let t22 = (t13 * t13 + t11 * t11) * p.m1 + theta1_dot * (theta1_dot * p.J1) + t20;
    let t23 = (t19 * t19 + t16 * t16) * p.m2 + theta2_dot * (theta2_dot * p.J2) + t22;
    let t24 = t23 + (p.J0_omega2 + p.m0 * (t17 * t17 + t14 * t14) + t21);
    t24 * S::from_f64(0.5)
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
    let t0 = theta * p.yc;
    let t1 = theta * p.xc;
    let t2 = x - t0;
    let t3 = y - t1;
    let t4 = t0 + x;
    let t5 = t1 + y;
    (t5 * t5 + t3 * t3) * p.half_cy + (t4 * t4 + t2 * t2) * p.half_cx
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
    let t0 = theta_dot * p.yc;
    let t1 = theta_dot * p.xc;
    let t2 = x_dot - t0;
    let t3 = y_dot - t1;
    let t4 = t0 + x_dot;
    let t5 = t1 + y_dot;
    (t5 * t5 + t3 * t3) * p.half_by + (t4 * t4 + t2 * t2) * p.half_bx
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
    let theta_dot = v[2];
    let x_ddot = a[0];
    let y_ddot = a[1];
    let theta_ddot = a[2];
    let (sin_theta, cos_theta) = theta.sin_cos();
    let t0 = p.omega * t;
    let t1 = theta_dot * theta_dot;
    let t2 = p.omega.product_error(t);
    let (sin_t0, cos_t0) = t0.sin_cos();
    let t3 = sin_theta * theta_ddot + cos_theta * t1;
    let t4 = sin_theta * t1 - cos_theta * theta_ddot;
    let t5 = sin_t0 + t2 * cos_t0;
    let t6 = cos_t0 - t2 * sin_t0;
    let t7 = y_ddot - p.x0 * t4;
    let t8 = t3 * p.y0;
    let t9 = x_ddot - t3 * p.x0;
    let t10 = t4 * p.y0;
    let t11 = t5 * p.e_omega2;
    let t12 = t6 * p.e_omega2;
    let t13 = t5 * (t12 - (t9 - t10) + (t12 - (t9 + t10)));
    (t13 - t6 * (t11 + (t7 + t8) + (t11 - (t7 - t8)))) * p.m0_e_omega
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
    let t0 = theta_dot * p.yc;
    let t1 = theta_dot * p.xc;
    let t2 = x_dot - t0;
    let t3 = y_dot - t1;
    let t4 = t0 + x_dot;
    let t5 = t1 + y_dot;
    (t5 * t5 + t3 * t3) * p.by + (t4 * t4 + t2 * t2) * p.bx
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
    machine TwoDebalanceCrusher "TwoDebalanceCrusher" over S, R;
    parameters {
        m, m0, m1, m2, J, J0, J1, J2, e, x0, y0, omega, cx, cy, bx, by, xc, yc, R, r1, rho, r2,
    } [
        m: "m" "kg" = 600.0;
        m0: "m0" "kg" = 20.0;
        m1: "m1" "kg" = 180.0;
        m2: "m2" "kg" = 120.0;
        J: "J" "kg*m^2" = 60.0;
        J0: "J0" "kg*m^2" = 0.1;
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
        R: "R" "m" = 0.27;
        r1: "r1" "m" = 0.25;
        rho: "rho" "m" = 0.2;
        r2: "r2" "m" = 0.17;
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
        m, m0, m1, m2, J, J1, J2, x0, y0, omega, cx, cy, bx, by, xc, yc, e_omega, J0_omega2,
        half_cx, half_cy, half_bx, half_by, e_omega2, m1_plus_m2, m0_x0, two_m0_x0, k0, m0_y0,
        m0_e_omega, k1, minus_two_m0_x0, minus_m2, two_m0_e_omega2, k2, k3, k4, k5,
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
