// @generated from machines/paper_crusher.machine by `cargo xtask generate`; edits are lost.

//! The crusher of «Dynamical simulation of a vibrating crush machine, part I», as the paper models
//! it, and every formula of its §3 as it is printed: `lagrangian check` tells which are wrong, and
//! docs/errata.md why.
//!
//! The suspension is the single pair that the paper prints: the springs act at (xc, yc) of the
//! platform, the dampers at (xb, yb). Two squares cannot hold three coordinates: the stiffness
//! matrix has the null vector (yc, -xc, 1), so that turning about the joint of the springs is free,
//! and the dampers leave turning about theirs. Shaken, the platform turns away, by a radian in the
//! first second, and the angle is no longer small: two pairs on opposite sides, as in
//! `frozen_crusher.machine`, hold it. In velocities the angle is frozen, as in the paper.
//!
//! 9 coordinates, 20 parameters. Arithmetic of one call:
//!
//! | function | mul | add | div | sin cos | other | temporaries |
//! | --- | --: | --: | --: | --: | --: | --: |
//! | `prepare` | 24 | 9 | 2 | 0 | 0 | 35 |
//! | `mass_matrix` | 23 | 4 | 0 | 2 | 0 | 31 |
//! | `bias` | 72 | 52 | 0 | 3 | 0 | 130 |
//! | `applied` | 12 | 11 | 0 | 0 | 0 | 23 |
//! | `forces` | 84 | 65 | 0 | 3 | 0 | 155 |
//! | `accelerations` | 188 | 130 | 5 | 3 | 0 | 329 |
//! | `kinetic_energy` | 37 | 25 | 0 | 3 | 0 | 68 |
//! | `potential_energy` | 6 | 3 | 0 | 0 | 0 | 9 |
//! | `dissipation` | 6 | 3 | 0 | 0 | 0 | 9 |
//! | `work_rate` | 20 | 15 | 0 | 1 | 0 | 37 |
//! | `dissipation_rate` | 6 | 3 | 0 | 0 | 0 | 9 |
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

/// The crusher of «Dynamical simulation of a vibrating crush machine, part I», as the paper models
/// it, and every formula of its §3 as it is printed: `lagrangian check` tells which are wrong, and
/// docs/errata.md why.
///
/// The suspension is the single pair that the paper prints: the springs act at (xc, yc) of the
/// platform, the dampers at (xb, yb). Two squares cannot hold three coordinates: the stiffness
/// matrix has the null vector (yc, -xc, 1), so that turning about the joint of the springs is free,
/// and the dampers leave turning about theirs. Shaken, the platform turns away, by a radian in the
/// first second, and the angle is no longer small: two pairs on opposite sides, as in
/// `frozen_crusher.machine`, hold it. In velocities the angle is frozen, as in the paper.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PaperCrusher<S = f64> {
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
    /// Stiffness and damping of the one pair, which carries what two pairs carry elsewhere. Unit:
    /// `N/m`. Default: 600000.
    pub cx: S,
    /// `cy`. Unit: `N/m`. Default: 600000.
    pub cy: S,
    /// `bx`. Unit: `N*s/m`. Default: 3000.
    pub bx: S,
    /// `by`. Unit: `N*s/m`. Default: 3000.
    pub by: S,
    /// Where the springs meet the platform. Unit: `m`. Default: 0.4.
    pub xc: S,
    /// `yc`. Unit: `m`. Default: 0.3.
    pub yc: S,
    /// Where the dampers meet the platform. Unit: `m`. Default: 0.4.
    pub xb: S,
    /// `yb`. Unit: `m`. Default: 0.3.
    pub yb: S,
}

impl<S: ::lagrangian::emitted::Scalar> PaperCrusher<S> {
    /// Computes what depends on the parameters alone, once.
    pub fn prepare(&self) -> Prepared<S> {
        let m0_x0 = self.m0 * self.x0;
        let t0 = self.m0 * self.y0;
        let m1_plus_m2 = self.m1 + self.m2;
        let e_omega = self.omega * self.e;
        let e_omega2 = self.omega * e_omega;
        let k0 = m1_plus_m2 + (self.m + self.m0);
        let k1 = self.y0 * t0 + (self.J + self.x0 * m0_x0);
        let k5 = S::ONE / k1;
        let k2 = t0 * k5;
        let k3 = m0_x0 * k5;
        let J0_omega2 = self.omega * (self.omega * self.J0);
        let cx_yc = self.cx * self.yc;
        let bx_yb = self.bx * self.yb;
        let cy_xc = self.cy * self.xc;
        let m0_e_omega2 = self.m0 * e_omega2;
        let half_cx = self.cx * S::from_f64(0.5);
        let half_cy = self.cy * S::from_f64(0.5);
        let half_bx = self.bx * S::from_f64(0.5);
        let half_by = self.by * S::from_f64(0.5);
        let m0_e_x0_omega2 = e_omega2 * m0_x0;
        let m0_e_y0_omega2 = e_omega2 * t0;
        let by_xb = self.by * self.xb;
        let minus_m0_y0 = -t0;
        let minus_m2 = -self.m2;
        let k4 = m0_x0 * k2;
        let k6 = S::ONE / m1_plus_m2;
        let k7 = k0 - t0 * k2;
        let k8 = k0 - m0_x0 * k3;
        let pivots = [
            (5, self.J1, self.J1),
            (8, self.J2, self.J2),
            (2, k1, k1),
            (3, m1_plus_m2, m1_plus_m2),
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
            xb: self.xb,
            yb: self.yb,
            e_omega,
            J0_omega2,
            m1_plus_m2,
            cx_yc,
            bx_yb,
            cy_xc,
            m0_e_omega2,
            half_cx,
            half_cy,
            half_bx,
            half_by,
            k0,
            m0_x0,
            k1,
            e_omega2,
            m0_e_x0_omega2,
            m0_e_y0_omega2,
            by_xb,
            minus_m0_y0,
            minus_m2,
            k2,
            k3,
            k4,
            k5,
            k6,
            k7,
            k8,
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

/// The coordinates of [`PaperCrusher`], or their rates, by name.
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

/// The parameters of a [`PaperCrusher`], with the work done that depends on them alone.
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
    /// `xb`
    xb: S,
    /// `yb`
    yb: S,
    /// `e*omega`
    e_omega: S,
    /// `J0*omega^2`
    J0_omega2: S,
    /// `m1 + m2`
    m1_plus_m2: S,
    /// `cx*yc`
    cx_yc: S,
    /// `bx*yb`
    bx_yb: S,
    /// `cy*xc`
    cy_xc: S,
    /// `m0*e*omega^2`
    m0_e_omega2: S,
    /// `0.5*cx`
    half_cx: S,
    /// `0.5*cy`
    half_cy: S,
    /// `0.5*bx`
    half_bx: S,
    /// `0.5*by`
    half_by: S,
    /// `m + m0 + m1 + m2`
    k0: S,
    /// `m0*x0`
    m0_x0: S,
    /// `J + m0*x0^2 + m0*y0^2`
    k1: S,
    /// `e*omega^2`
    e_omega2: S,
    /// `m0*e*x0*omega^2`
    m0_e_x0_omega2: S,
    /// `m0*e*y0*omega^2`
    m0_e_y0_omega2: S,
    /// `by*xb`
    by_xb: S,
    /// `-m0*y0`
    minus_m0_y0: S,
    /// `-m2`
    minus_m2: S,
    /// `m0*y0/(J + m0*x0^2 + m0*y0^2)`
    k2: S,
    /// `m0*x0/(J + m0*x0^2 + m0*y0^2)`
    k3: S,
    /// `m0^2*x0*y0/(J + m0*x0^2 + m0*y0^2)`
    k4: S,
    /// `1/(J + m0*x0^2 + m0*y0^2)`
    k5: S,
    /// `1/(m1 + m2)`
    k6: S,
    /// `m + m0 + m1 + m2 - m0^2*y0^2/(J + m0*x0^2 + m0*y0^2)`
    k7: S,
    /// `m + m0 + m1 + m2 - m0^2*x0^2/(J + m0*x0^2 + m0*y0^2)`
    k8: S,
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
pub fn mass_matrix<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 9]) -> [[S; 9]; 9] {
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
        [p.k0, zero, p.minus_m0_y0, m41, m51, zero, m71, m81, zero],
        [zero, p.k0, p.m0_x0, m42, m52, zero, m72, m82, zero],
        [
            p.minus_m0_y0,
            p.m0_x0,
            p.k1,
            zero,
            zero,
            zero,
            zero,
            zero,
            zero,
        ],
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
pub fn bias<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    t: S,
    q: &[S; 9],
    v: &[S; 9],
) -> [S; 9] {
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
    let (sin_phi1, cos_phi1) = phi1.sin_cos();
    let (sin_phi2, cos_phi2) = phi2.sin_cos();
    let t0 = p.omega * t;
    let t1 = phi1_dot * s1;
    let t2 = phi2_dot * s2;
    let t3 = p.omega.product_error(t);
    let (sin_t0, cos_t0) = t0.sin_cos();
    let t4 = sin_phi1 * s1_dot;
    let t5 = cos_phi1 * t1;
    let t6 = cos_phi1 * s1_dot;
    let t7 = sin_phi1 * t1;
    let t8 = sin_phi2 * s2_dot;
    let t9 = cos_phi2 * t2;
    let t10 = cos_phi2 * s2_dot;
    let t11 = sin_phi2 * t2;
    let t12 = t4 + t5;
    let t13 = t4 * phi1_dot;
    let t14 = t6 - t7;
    let t15 = phi1_dot * t6;
    let t16 = t8 * phi2_dot;
    let t17 = t8 + t9;
    let t18 = phi2_dot * t10;
    let t19 = t10 - t11;
    let t20 = t12 + y_dot;
    let t21 = t14 + x_dot;
    let t22 = t17 + t20;
    let t23 = t13 + (t13 + phi1_dot * t5);
    let t24 = t19 + t21;
    let t25 = t15 + (t15 - phi1_dot * t7);
    let t26 = p.m2 * t24 + p.m1 * t21;
    let t27 = t16 + (t16 + phi2_dot * t9) + t23;
    let t28 = t18 + (t18 - phi2_dot * t11) + t25;
    let t29 = p.m2 * t22 + p.m1 * t20;
    let t30 = t22 * (cos_phi2 * phi2_dot);
    let t31 = t24 * (sin_phi2 * phi2_dot);
    let t32 = t27 * p.m2 + t23 * p.m1;
    let t33 = p.m2 * t28 + p.m1 * t25;
    let t34 = t29 * (cos_phi1 * phi1_dot);
    let t35 = t26 * (sin_phi1 * phi1_dot);
    let t36 = cos_t0 - t3 * sin_t0;
    let t37 = sin_t0 + t3 * cos_t0;
    let t38 = sin_phi2 * (s2_dot * t24 + t2 * t22);
    let t39 = cos_phi1 * (s1_dot * t29 - t1 * t26);
    let t40 = t19 * t22 + t28 * (cos_phi2 * s2) - (t24 * t17 - t27 * (sin_phi2 * s2));
    let t41 = t14 * t29 + t33 * (cos_phi1 * s1) - (t26 * t12 - t32 * (sin_phi1 * s1));
    let t42 = t30 - t31 - (t30 + sin_phi2 * t28 - (t31 + cos_phi2 * t27));
    let h_x = -(p.m0_e_omega2 * t36 + t32);
    let h_y = t33 - p.m0_e_omega2 * t37;
    let h_theta = t36 * p.m0_e_y0_omega2 - t37 * p.m0_e_x0_omega2;
    let h_s1 = t34 + sin_phi1 * t33 - (t35 + cos_phi1 * t32) - (t34 - t35);
    let h_phi1 = t41 + (sin_phi1 * (s1_dot * t26 + t1 * t29) - t39);
    let zero = S::ZERO;
    let h_s2 = p.minus_m2 * t42;
    let h_phi2 = p.minus_m2 * (cos_phi2 * (s2_dot * t22 - t2 * t24) - t38 - t40);
    [h_x, h_y, h_theta, h_s1, h_phi1, zero, h_s2, h_phi2, zero]
}

/// Applied generalized forces `Q`.
///
/// ```text
/// Q[x] = bx*yb*der(theta) - bx*der(x) - cx*x + cx*yc*theta
/// Q[y] = -by*der(y) - by*xb*der(theta) - cy*y - cy*xc*theta
/// Q[theta] = bx*yb*(der(x) - yb*der(theta)) - by*xb*(der(y) + xb*der(theta))
///     + cx*yc*(x - yc*theta) - cy*xc*(y + xc*theta)
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
    let t0 = x - theta * p.yc;
    let t1 = theta_dot * p.xb + y_dot;
    let t2 = theta * p.xc + y;
    let t3 = x_dot - theta_dot * p.yb;
    let q_x = -(t3 * p.bx + t0 * p.cx);
    let q_y = -(t1 * p.by + t2 * p.cy);
    let q_theta = t3 * p.bx_yb - t1 * p.by_xb + (t0 * p.cx_yc - t2 * p.cy_xc);
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
    let (sin_phi2, cos_phi2) = phi2.sin_cos();
    let t0 = p.omega * t;
    let t1 = phi1_dot * s1;
    let t2 = phi2_dot * s2;
    let t3 = p.omega.product_error(t);
    let t4 = y_dot + theta_dot * p.xb;
    let t5 = theta * p.xc + y;
    let t6 = x_dot - theta_dot * p.yb;
    let t7 = x - theta * p.yc;
    let (sin_t0, cos_t0) = t0.sin_cos();
    let t8 = cos_phi1 * s1_dot;
    let t9 = sin_phi1 * t1;
    let t10 = sin_phi2 * s2_dot;
    let t11 = sin_phi1 * s1_dot;
    let t12 = cos_phi1 * t1;
    let t13 = cos_phi2 * s2_dot;
    let t14 = sin_phi2 * t2;
    let t15 = cos_phi2 * t2;
    let t16 = t8 - t9;
    let t17 = phi1_dot * t8;
    let t18 = t10 * phi2_dot;
    let t19 = t11 * phi1_dot;
    let t20 = phi2_dot * t13;
    let t21 = t11 + t12;
    let t22 = t13 - t14;
    let t23 = t10 + t15;
    let t24 = x_dot + t16;
    let t25 = y_dot + t21;
    let t26 = t22 + t24;
    let t27 = t19 + (t19 + phi1_dot * t12);
    let t28 = t17 + (t17 - phi1_dot * t9);
    let t29 = t23 + t25;
    let t30 = p.m2 * t26 + p.m1 * t24;
    let t31 = t18 + (t18 + phi2_dot * t15) + t27;
    let t32 = t20 + (t20 - phi2_dot * t14) + t28;
    let t33 = p.m2 * t29 + p.m1 * t25;
    let t34 = t31 * p.m2 + t27 * p.m1;
    let t35 = p.m2 * t32 + p.m1 * t28;
    let t36 = t29 * (cos_phi2 * phi2_dot);
    let t37 = t26 * (sin_phi2 * phi2_dot);
    let t38 = sin_t0 + t3 * cos_t0;
    let t39 = t33 * (cos_phi1 * phi1_dot);
    let t40 = t30 * (sin_phi1 * phi1_dot);
    let t41 = cos_t0 - t3 * sin_t0;
    let t42 = cos_phi1 * (s1_dot * t33 - t1 * t30);
    let t43 = sin_phi2 * (s2_dot * t26 + t2 * t29);
    let t44 = t16 * t33 + t35 * (cos_phi1 * s1) - (t30 * t21 - t34 * (sin_phi1 * s1));
    let t45 = t22 * t29 + t32 * (cos_phi2 * s2) - (t26 * t23 - t31 * (sin_phi2 * s2));
    let t46 = t6 * p.bx_yb - t4 * p.by_xb + (t7 * p.cx_yc - t5 * p.cy_xc);
    let f_x = p.m0_e_omega2 * t41 + t34 - (t6 * p.bx + t7 * p.cx);
    let f_y = -(t35 - p.m0_e_omega2 * t38 + (t4 * p.by + t5 * p.cy));
    let f_theta = t46 - (t41 * p.m0_e_y0_omega2 - t38 * p.m0_e_x0_omega2);
    let f_s1 = t39 - t40 - (t39 + sin_phi1 * t35 - (t40 + cos_phi1 * t34));
    let f_phi1 = -(t44 + (sin_phi1 * (s1_dot * t30 + t1 * t33) - t42));
    let zero = S::ZERO;
    let f_s2 = p.m2 * (t36 - t37 - (t36 + sin_phi2 * t32 - (t37 + cos_phi2 * t31)));
    let f_phi2 = p.m2 * (cos_phi2 * (s2_dot * t29 - t2 * t26) - t43 - t45);
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
    let t1 = n(p.m1_plus_m2) * s1;
    let t2 = s1 * phi1_dot;
    let t3 = s2 * phi2_dot;
    let t4 = s2 * n(p.m2);
    let t5 = s1 * n(p.m2);
    let t6 = n(p.omega).product_error(n(t));
    let t7 = theta_dot.mul_add(n(p.xb), y_dot);
    let t8 = s1 * t1;
    let t9 = theta.mul_add(n(p.xc), y);
    let t10 = theta_dot.neg_mul_add(n(p.yb), x_dot);
    let t11 = theta.neg_mul_add(n(p.yc), x);
    let t12 = s2 * t4;
    let t13 = t11.mul_sub(n(p.cx_yc), t9 * n(p.cy_xc));
    let t14 = cos_phi1 * n(p.m1_plus_m2);
    let t15 = sin_phi1 * n(p.m1_plus_m2);
    let t16 = sin_phi1 * t1;
    let t17 = sin_phi2 * s2_dot;
    let t18 = sin_phi1 * s1_dot;
    let t19 = cos_phi1 * t2;
    let t20 = cos_phi2 * s2_dot;
    // Eliminates s1 from row x: l[x, s1].
    let t21 = t14 * n(p.k6);
    // Eliminates s1 from row y: l[y, s1].
    let t22 = t15 * n(p.k6);
    let t23 = sin_phi1.mul_add(sin_phi2, cos_phi1 * cos_phi2);
    let t24 = cos_phi1 * s1_dot;
    let t25 = sin_phi1 * t2;
    let t26 = cos_phi2 * t3;
    let t27 = t18 + t19;
    let t28 = t14 * t21;
    let t29 = t14.neg_mul_add(t22, n(p.k4));
    let t30 = t15.mul_sub(t22, n(p.k8));
    let t31 = n(p.m2) * t23;
    let t32 = phi2_dot * t20;
    let t33 = sin_phi2 * t3;
    let t34 = phi1_dot * t24;
    let t35 = t24 - t25;
    let t36 = phi2_dot * t17;
    let t37 = phi1_dot * t18;
    // Eliminates s1 from row s2: l[s2, s1].
    let t38 = n(p.k6) * t31;
    let t39 = t17 + t26;
    let t40 = y_dot + t27;
    // Row x: pivot d[x].
    let t41 = N::ONE / (t28 - n(p.k7));
    let t42 = t20 - t33;
    let t43 = x_dot + t35;
    let t44 = t14.neg_mul_add(t38, cos_phi2 * n(p.m2));
    let t45 = t39 + t40;
    let t46 = t34 + phi1_dot.neg_mul_add(t25, t34);
    let t47 = t42 + t43;
    let t48 = t37 + phi1_dot.mul_add(t19, t37);
    let t49 = sin_phi1.mul_sub(cos_phi2, cos_phi1 * sin_phi2);
    let t50 = n(p.m2).mul_add(t45, t40 * n(p.m1));
    let t51 = t32 + phi2_dot.neg_mul_add(t33, t32) + t46;
    let t52 = n(p.m2).mul_add(t47, t43 * n(p.m1));
    // Eliminates x from row y: l[y, x].
    let t53 = t29 * t41;
    // Eliminates x from row phi1: l[phi1, x].
    let t54 = t16 * t41;
    // Eliminates x from row s2: l[s2, x].
    let t55 = t41 * t44;
    let t56 = t36 + phi2_dot.mul_add(t26, t36) + t48;
    let t57 = t29 * t53;
    let t58 = t29.neg_mul_add(t54, cos_phi1 * t1);
    let t59 = t4 * t49;
    let t60 = t29.mul_add(t55, t15.neg_mul_add(t38, sin_phi2 * n(p.m2)));
    let t61 = t50 * (cos_phi1 * phi1_dot);
    let t62 = n(p.m2).mul_add(t51, n(p.m1) * t46);
    let t63 = t52 * (sin_phi1 * phi1_dot);
    let t64 = n(p.m2).mul_add(t56, n(p.m1) * t48);
    let t65 = t6.mul_add(cos_t0, sin_t0);
    let t66 = t45 * (cos_phi2 * phi2_dot);
    let t67 = t47 * (sin_phi2 * phi2_dot);
    // Eliminates s1 from row phi2: l[phi2, s1].
    let t68 = n(p.k6) * t59;
    // Row y: pivot d[y].
    let t69 = N::ONE / (t30 - t57);
    let t70 = t6.neg_mul_add(sin_t0, cos_t0);
    let t71 = t14.mul_add(t68, sin_phi2 * t4);
    let t72 = t65 * n(p.m0_e_x0_omega2);
    // Eliminates y from row phi1: l[phi1, y].
    let t73 = t58 * t69;
    // Eliminates y from row s2: l[s2, y].
    let t74 = t60 * t69;
    // Row phi1: pivot d[phi1].
    let t75 = t58.mul_add(t73, t16.mul_add(t54, t8));
    let t76 = t58.mul_sub(t74, t16.mul_add(t55, t5 * t49));
    // Eliminates x from row phi2: l[phi2, x].
    let t77 = t41 * t71;
    let t78 = N::ONE / t75;
    let t79 = t44.mul_add(t55, t31.neg_mul_add(t38, n(p.m2)));
    let t80 = sin_phi1.mul_add(t62, t61) - cos_phi1.mul_add(t64, t63);
    let t81 = t61 - t63 - t80;
    let t82 = t10.mul_sub(n(p.bx_yb), t7 * n(p.by_xb)) + t13;
    let t83 = t70.mul_sub(n(p.m0_e_y0_omega2), t72) - t82;
    let t84 = t11.mul_add(n(p.cx), t10 * n(p.bx));
    let t85 = t65.neg_mul_add(n(p.m0_e_omega2), t62);
    let t86 = sin_phi2.mul_add(t51, t66) - cos_phi2.mul_add(t56, t67);
    let t87 = t29.neg_mul_add(t77, t15.neg_mul_add(t68, cos_phi2 * t4));
    let t88 = sin_phi2 * t3.mul_add(t45, s2_dot * t47);
    let t89 = t56.neg_mul_add(sin_phi2 * s2, t39 * t47);
    let t90 = t84 - t70.mul_add(n(p.m0_e_omega2), t64);
    let t91 = t9.mul_add(n(p.cy), t7 * n(p.by)) + t85;
    let t92 = t64.neg_mul_add(sin_phi1 * s1, t27 * t52);
    let t93 = cos_phi1 * s1_dot.mul_sub(t50, t2 * t52);
    // Eliminates y from row phi2: l[phi2, y].
    let t94 = t69 * t87;
    let t95 = cos_phi2.mul_sub(s2_dot.mul_sub(t45, t3 * t47), t88);
    // Eliminates phi1 from row s2: l[s2, phi1].
    let t96 = t76 * t78;
    // Row x: right-hand side z[x].
    let t97 = t21.mul_add(t81, t83.mul_add(n(p.k2), t90));
    let t98 = sin_phi1.mul_sub(t2.mul_add(t50, s1_dot * t52), t93);
    let t99 = t58.mul_add(t94, t16.mul_add(t77, s2 * t5 * t23));
    let t100 = t95 - (t51.mul_add(cos_phi2 * s2, t42 * t45) - t89);
    // Row s2: pivot d[s2].
    let t101 = t76.neg_mul_add(t96, t60.mul_add(t74, t79));
    let t102 = t22.mul_add(t81, t83.neg_mul_add(n(p.k3), t91));
    // Row y: right-hand side z[y].
    let t103 = t53.mul_add(t97, t102);
    let t104 = t62.mul_add(cos_phi1 * s1, t35 * t50) - t92 + t98;
    let t105 = t38.neg_mul_add(t81, n(p.m2) * (t66 - t67 - t86));
    // Eliminates phi1 from row phi2: l[phi2, phi1].
    let t106 = t78 * t99;
    let t107 = N::ONE / t101;
    // Row phi1: right-hand side z[phi1].
    let t108 = t73.mul_add(t103, t54.neg_mul_add(t97, t104));
    let t109 = t60.neg_mul_add(t94, t44.mul_add(t77, t31 * t68));
    let t110 = t76.mul_add(t106, t109);
    let t111 = t77.mul_add(t97, n(p.m2).mul_sub(t100, t68 * t81));
    let t112 = t71.mul_add(t77, t59.neg_mul_add(t68, t12));
    let t113 = t74.neg_mul_add(t103, t55.neg_mul_add(t97, t105));
    // Row s2: right-hand side z[s2].
    let t114 = t96.mul_add(t108, t113);
    // Eliminates s2 from row phi2: l[phi2, s2].
    let t115 = t107 * t110;
    let t116 = t106.mul_add(t108, t94.neg_mul_add(t103, t111));
    let t117 = t99.neg_mul_add(t106, t87.mul_add(t94, t112));
    // Row phi2: pivot d[phi2].
    let t118 = t110.neg_mul_add(t115, t117);
    // Row phi2: right-hand side z[phi2].
    let phi2_ddot = t114.mul_add(t115, t116) / t118;
    // Back substitution: a[s2].
    let s2_ddot = t115.mul_add(phi2_ddot, t107 * t114);
    // Back substitution: a[phi1].
    let t119 = t96.mul_add(s2_ddot, t106.mul_add(phi2_ddot, t78 * t108));
    let t120 = t77.neg_mul_add(phi2_ddot, t41 * t97);
    let t121 = t68.mul_sub(phi2_ddot, n(p.k6) * t81);
    let t122 = t74.mul_add(s2_ddot, t94.mul_add(phi2_ddot, t69 * t103));
    // Back substitution: a[y].
    let y_ddot = t73.neg_mul_add(t119, t122);
    let t123 = t54.mul_add(t119, t55.mul_add(s2_ddot, t120));
    // Back substitution: a[x].
    let x_ddot = t53.mul_add(y_ddot, t123);
    let t124 = t22.mul_add(y_ddot, t38.mul_add(s2_ddot, t121));
    let t125 = n(p.k3).mul_add(y_ddot, t83 * n(p.k5));
    let theta_ddot = n(p.k2).mul_sub(x_ddot, t125);
    // Back substitution: a[s1].
    let s1_ddot = -t21.mul_add(x_ddot, t124);
    let phi1_ddot = -t119;
    let zero = N::ZERO;
    let t126 = n(p.k7) - t28;
    let t127 = t57 - t30;
    let sound = PIVOTS.hold(t126, n(p.k0))
        & PIVOTS.hold(t127, n(p.k0))
        & PIVOTS.hold(t75, t8)
        & PIVOTS.hold(t101, n(p.m2))
        & PIVOTS.hold(t118, t12)
        & s1_ddot.is_finite();
    if !sound {
        let pivots = [
            (0, t126, n(p.k0)),
            (1, t127, n(p.k0)),
            (4, t75, t8),
            (6, t101, n(p.m2)),
            (7, t118, t12),
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
/// T = 1/2*m*der(x)^2 + 1/2*m*der(y)^2 + 1/2*J*der(theta)^2 + 1/2*J1*der(theta1)^2
///     + 1/2*J2*der(theta2)^2 + 1/2*m0*(((der(x) - y0*der(theta)) - e*omega*sin(omega*t))^2 +
///     ((der(y) + x0*der(theta)) + e*omega*cos(omega*t))^2) + 1/2*m1*((der(y) + (sin(phi1)*der(s1)
///     + s1*cos(phi1)*der(phi1)))^2 + (der(x) + (cos(phi1)*der(s1) - s1*sin(phi1)*der(phi1)))^2) +
///     1/2*m2*(((der(x) + (cos(phi1)*der(s1) - s1*sin(phi1)*der(phi1))) + (cos(phi2)*der(s2) -
///     s2*sin(phi2)*der(phi2)))^2 + ((der(y) + (sin(phi1)*der(s1) + s1*cos(phi1)*der(phi1))) +
///     (sin(phi2)*der(s2) + s2*cos(phi2)*der(phi2)))^2) + 1/2*J0*omega^2
/// ```
pub fn kinetic_energy<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    t: S,
    q: &[S; 9],
    v: &[S; 9],
) -> S {
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
    let t0 = p.omega * t;
    let t1 = phi1_dot * s1;
    let t2 = phi2_dot * s2;
    let t3 = p.omega.product_error(t);
    let (sin_t0, cos_t0) = t0.sin_cos();
    let t4 = x_dot + (cos_phi1 * s1_dot - t1 * sin_phi1);
    let t5 = y_dot + (t1 * cos_phi1 + sin_phi1 * s1_dot);
    let t6 = x_dot - theta_dot * p.y0 - p.e_omega * (sin_t0 + t3 * cos_t0);
    let t7 = p.e_omega * (cos_t0 - t3 * sin_t0) + (y_dot + theta_dot * p.x0);
    let t8 = cos_phi2 * s2_dot - t2 * sin_phi2 + t4;
    let t9 = t2 * cos_phi2 + sin_phi2 * s2_dot + t5;
    let t10 = theta_dot * (theta_dot * p.J) + (y_dot * y_dot + x_dot * x_dot) * p.m;
    let t11 = (t5 * t5 + t4 * t4) * p.m1 + theta1_dot * (theta1_dot * p.J1) + t10;
    let t12 = (t9 * t9 + t8 * t8) * p.m2 + theta2_dot * (theta2_dot * p.J2) + t11;
    ((t7 * t7 + t6 * t6) * p.m0 + p.J0_omega2 + t12) * S::from_f64(0.5)
}

/// Potential energy `V`, in J.
///
/// ```text
/// V = 1/2*cx*(x - yc*theta)^2 + 1/2*cy*(y + xc*theta)^2
/// ```
pub fn potential_energy<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 9]) -> S {
    let x = q[0];
    let y = q[1];
    let theta = q[2];
    let t0 = x - theta * p.yc;
    let t1 = theta * p.xc + y;
    t1 * (t1 * p.half_cy) + t0 * (t0 * p.half_cx)
}

/// Dissipation function `D`, in W.
///
/// ```text
/// D = 1/2*bx*(der(x) - yb*der(theta))^2 + 1/2*by*(der(y) + xb*der(theta))^2
/// ```
pub fn dissipation<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, v: &[S; 9]) -> S {
    let x_dot = v[0];
    let y_dot = v[1];
    let theta_dot = v[2];
    let t0 = x_dot - theta_dot * p.yb;
    let t1 = theta_dot * p.xb + y_dot;
    t1 * (t1 * p.half_by) + t0 * (t0 * p.half_bx)
}

/// Power `P` supplied by drives, forces and inputs, in W.
///
/// ```text
/// P = m0*e*omega*cos(omega*t)*der(der(y)) - m0*e*omega*sin(omega*t)*der(der(x))
///     + m0*e*x0*omega*cos(omega*t)*der(der(theta)) + m0*e*y0*omega*sin(omega*t)*der(der(theta))
/// ```
pub fn work_rate<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    t: S,
    v: &[S; 9],
    a: &[S; 9],
) -> S {
    let x_dot = v[0];
    let y_dot = v[1];
    let theta_dot = v[2];
    let x_ddot = a[0];
    let y_ddot = a[1];
    let theta_ddot = a[2];
    let t0 = p.omega * t;
    let t1 = p.omega.product_error(t);
    let (sin_t0, cos_t0) = t0.sin_cos();
    let t2 = sin_t0 + t1 * cos_t0;
    let t3 = cos_t0 - t1 * sin_t0;
    let t4 = t2 * p.e_omega2;
    let t5 = p.e_omega * t2;
    let t6 = p.e_omega * t3;
    let t7 = t3 * p.e_omega2;
    let t8 = x_dot - theta_dot * p.y0 - t5;
    let t9 = t6 + (p.x0 * theta_dot + y_dot);
    let t10 = t5 * (x_ddot - theta_ddot * p.y0 - t7) + t7 * t8;
    let t11 = (t4 * t9 - t6 * (theta_ddot * p.x0 + y_ddot - t4) + t10) * p.m0;
    (t2 * t9 + t3 * t8) * p.m0_e_omega2 - t11
}

/// Power `R` dissipated by dampers, in W.
///
/// ```text
/// R = bx*(der(x) - yb*der(theta))^2 + by*(der(y) + xb*der(theta))^2
/// ```
pub fn dissipation_rate<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, v: &[S; 9]) -> S {
    let x_dot = v[0];
    let y_dot = v[1];
    let theta_dot = v[2];
    let t0 = x_dot - theta_dot * p.yb;
    let t1 = theta_dot * p.xb + y_dot;
    t1 * (t1 * p.by) + t0 * (t0 * p.bx)
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
    machine PaperCrusher "PaperCrusher" over S, R;
    parameters { m, m0, m1, m2, J, J0, J1, J2, e, x0, y0, omega, cx, cy, bx, by, xc, yc, xb, yb } [
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
        cx: "cx" "N/m" = 600000.0;
        cy: "cy" "N/m" = 600000.0;
        bx: "bx" "N*s/m" = 3000.0;
        by: "by" "N*s/m" = 3000.0;
        xc: "xc" "m" = 0.4;
        yc: "yc" "m" = 0.3;
        xb: "xb" "m" = 0.4;
        yb: "yb" "m" = 0.3;
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
        m, m0, m1, m2, J, J1, J2, x0, y0, omega, cx, cy, bx, by, xc, yc, xb, yb, e_omega, J0_omega2,
        m1_plus_m2, cx_yc, bx_yb, cy_xc, m0_e_omega2, half_cx, half_cy, half_bx, half_by, k0, m0_x0,
        k1, e_omega2, m0_e_x0_omega2, m0_e_y0_omega2, by_xb, minus_m0_y0, minus_m2, k2, k3, k4, k5,
        k6, k7, k8,
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
        number work_rate(p, t, q, v, a, u) = work_rate(p, t, v, a);
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
