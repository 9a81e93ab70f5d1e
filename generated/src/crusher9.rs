// @generated from machines/crusher9.machine by `cargo xtask generate`; edits are lost.

//! The crusher as benchmarks run it: one spring and damper pair for each direction, and radial
//! spring-dampers that keep the polar coordinates away from s = 0.
//!
//! 9 coordinates, 25 parameters. Arithmetic of one call:
//!
//! | function | mul | add | div | sin cos | other | temporaries |
//! | --- | --: | --: | --: | --: | --: | --: |
//! | `prepare` | 26 | 8 | 4 | 0 | 0 | 38 |
//! | `mass_matrix` | 27 | 7 | 0 | 3 | 0 | 40 |
//! | `bias` | 53 | 26 | 0 | 4 | 0 | 87 |
//! | `applied` | 16 | 15 | 0 | 0 | 0 | 31 |
//! | `forces` | 68 | 42 | 0 | 4 | 0 | 118 |
//! | `accelerations` | 87 | 57 | 2 | 4 | 0 | 154 |
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

impl<S: ::lagrangian::emitted::Scalar> Crusher9<S> {
    /// Computes what depends on the parameters alone, once.
    pub fn prepare(&self) -> Prepared<S> {
        let pivot_1 = self.m + self.m0;
        let m0_x0 = self.m0 * self.x0;
        let m0_y0 = self.m0 * self.y0;
        let e_w = self.w * self.e;
        let m1_plus_m2 = self.m1 + self.m2;
        let k5 = S::ONE / pivot_1;
        let k0 = m1_plus_m2 + pivot_1;
        let k1_ = self.J + (self.y0 * m0_y0 + self.x0 * m0_x0);
        let pivot_2 = k1_ - k5 * (m0_y0 * m0_y0) - k5 * (m0_x0 * m0_x0);
        let k3 = S::ONE / pivot_2;
        let half_cx = self.cx * S::from_f64(0.5);
        let half_cy = self.cy * S::from_f64(0.5);
        let half_k1 = self.k1 * S::from_f64(0.5);
        let half_k2 = self.k2 * S::from_f64(0.5);
        let half_bx = self.bx * S::from_f64(0.5);
        let half_by = self.by * S::from_f64(0.5);
        let half_d1 = self.d1 * S::from_f64(0.5);
        let half_d2 = self.d2 * S::from_f64(0.5);
        let e_w_squared = self.w * e_w;
        let half_m0 = self.m0 * S::from_f64(0.5);
        let by_xb = self.by * self.xb;
        let bx_yb = self.bx * self.yb;
        let cy_xc = self.cy * self.xc;
        let cx_yc = self.cx * self.yc;
        let m0_e_w = self.m0 * e_w;
        let minus_m2 = -self.m2;
        let inverse_m2 = S::ONE / self.m2;
        let inverse_m1 = S::ONE / self.m1;
        let k2_ = self.m0 * k5;
        let k4 = self.m0 * k3;
        let c0 = self.yc;
        let c1 = -c0;
        let c2 = self.w;
        let c3 = self.xc;
        let c4 = self.r1;
        let c5 = self.r2;
        let c6 = self.yb;
        let c7 = -c6;
        let c8 = self.xb;
        let c9 = self.y0;
        let c10 = -c9;
        let c11 = self.x0;
        let c12 = self.e;
        let c13 = self.m1;
        let c14 = self.m2;
        let c15 = self.cx;
        let c16 = self.bx;
        let c17 = self.m;
        let c18 = self.m0;
        let c19 = self.cy;
        let c20 = self.by;
        let c21 = c18 * c11;
        let c22 = c18 * c9;
        let c23 = -c22;
        let c24 = c15 * c0;
        let c25 = -c24;
        let c26 = c19 * c3;
        let c27 = c16 * c6;
        let c28 = -c27;
        let c29 = c20 * c8;
        let c30 = self.J;
        let c31 = self.k1;
        let c32 = self.d1;
        let c33 = self.J1;
        let c34 = self.k2;
        let c35 = self.d2;
        let c36 = -c14;
        let c37 = self.J2;
        let pivots = [
            (5, self.J1, self.J1),
            (8, self.J2, self.J2),
            (6, self.m2, self.m2),
            (3, self.m1, m1_plus_m2),
            (1, pivot_1, k0),
            (0, pivot_1, k0),
            (2, pivot_2, k1_),
        ];
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
            e_w,
            half_cx,
            half_cy,
            half_k1,
            half_k2,
            half_bx,
            half_by,
            half_d1,
            half_d2,
            e_w_squared,
            half_m0,
            m1_plus_m2,
            m0_y0,
            m0_x0,
            k0,
            by_xb,
            bx_yb,
            cy_xc,
            cx_yc,
            m0_e_w,
            k1_,
            minus_m2,
            inverse_m2,
            inverse_m1,
            k2_,
            k3,
            k4,
            k5,
            singular: PIVOTS.vanished(pivots),
            series: [
                c1, c2, c3, c4, c5, c7, c8, c10, c11, c12, c13, c14, c15, c16, c17, c18, c9, c19,
                c20, c21, c23, c22, c25, c26, c28, c29, c30, c31, c32, c33, c34, c35, c36, c37,
            ],
        }
    }

    /// The start values of the description, at rest and `t = 0`.
    pub fn start(&self) -> ::lagrangian::emitted::State<Coordinates<S>> {
        let zero = S::ZERO;
        let theta = S::from_ratio(1, 100);
        let s1 = S::from_ratio(4, 25);
        let phi1 = S::from_ratio(2, 5);
        let s2 = S::from_ratio(11, 100);
        let phi2 = S::from_ratio(13, 10);
        let q = [zero, zero, theta, s1, phi1, zero, s2, phi2, zero];
        let v = [S::ZERO; 9];
        ::lagrangian::emitted::State {
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
    e_w: S,
    /// `0.5*cx`
    half_cx: S,
    /// `0.5*cy`
    half_cy: S,
    /// `0.5*k1`
    half_k1: S,
    /// `0.5*k2`
    half_k2: S,
    /// `0.5*bx`
    half_bx: S,
    /// `0.5*by`
    half_by: S,
    /// `0.5*d1`
    half_d1: S,
    /// `0.5*d2`
    half_d2: S,
    /// `e*w^2`
    e_w_squared: S,
    /// `0.5*m0`
    half_m0: S,
    /// `m1 + m2`
    m1_plus_m2: S,
    /// `m0*y0`
    m0_y0: S,
    /// `m0*x0`
    m0_x0: S,
    /// `m + m0 + m1 + m2`
    k0: S,
    /// `by*xb`
    by_xb: S,
    /// `bx*yb`
    bx_yb: S,
    /// `cy*xc`
    cy_xc: S,
    /// `cx*yc`
    cx_yc: S,
    /// `m0*e*w`
    m0_e_w: S,
    /// `J + m0*x0^2 + m0*y0^2`
    k1_: S,
    /// `-m2`
    minus_m2: S,
    /// `1/m2`
    inverse_m2: S,
    /// `1/m1`
    inverse_m1: S,
    /// `m0/(m + m0)`
    k2_: S,
    /// `1/(J + m0*x0^2 + m0*y0^2 - m0^2*y0^2/(m + m0) - m0^2*x0^2/(m + m0))`
    k3: S,
    /// `m0/(J + m0*x0^2 + m0*y0^2 - m0^2*y0^2/(m + m0) - m0^2*x0^2/(m + m0))`
    k4: S,
    /// `1/(m + m0)`
    k5: S,
    /// What the Taylor series takes from the parameters.
    series: [S; 34],
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
pub fn mass_matrix<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 9]) -> [[S; 9]; 9] {
    let theta = q[2];
    let s1 = q[3];
    let phi1 = q[4];
    let s2 = q[6];
    let phi2 = q[7];
    let (sin_theta, cos_theta) = theta.sin_cos();
    let (sin_phi1, cos_phi1) = phi1.sin_cos();
    let (sin_phi2, cos_phi2) = phi2.sin_cos();
    let t0 = s1 * p.m2;
    let t1 = s1 * p.m1_plus_m2;
    let t2 = p.m2 * s2;
    let t3 = sin_phi1 * cos_phi2;
    let t4 = cos_phi1 * sin_phi2;
    let t5 = sin_phi1 * sin_phi2 + cos_phi1 * cos_phi2;
    let zero = S::ZERO;
    let m31 = -(cos_theta * p.m0_y0 + sin_theta * p.m0_x0);
    let m32 = cos_theta * p.m0_x0 - sin_theta * p.m0_y0;
    let m41 = cos_phi1 * p.m1_plus_m2;
    let m42 = sin_phi1 * p.m1_plus_m2;
    let m51 = -(sin_phi1 * t1);
    let m52 = cos_phi1 * t1;
    let m55 = s1 * t1;
    let m71 = cos_phi2 * p.m2;
    let m72 = sin_phi2 * p.m2;
    let m74 = p.m2 * t5;
    let m75 = t0 * (t4 - t3);
    let m81 = sin_phi2 * (s2 * p.minus_m2);
    let m82 = cos_phi2 * t2;
    let m84 = t2 * (t3 - t4);
    let m85 = t0 * s2 * t5;
    let m88 = s2 * t2;
    [
        [p.k0, zero, m31, m41, m51, zero, m71, m81, zero],
        [zero, p.k0, m32, m42, m52, zero, m72, m82, zero],
        [m31, m32, p.k1_, zero, zero, zero, zero, zero, zero],
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
    let t15 = p.e_w_squared * (sin_t0 + t2 * cos_t0);
    let t16 = t15 + (sin_theta * t5 + t4 * cos_theta);
    let t17 = t3 * t9 - t7 * cos_phi2 + t13;
    let t18 = p.e_w_squared * (cos_t0 - t2 * sin_t0);
    let t19 = t18 + (cos_theta * t5 - t4 * sin_theta);
    let t20 = t7 * sin_phi2 + t3 * t11 + t14;
    let t21 = p.m2 * t17 + p.m1 * t13;
    let t22 = t20 * p.m2 + t14 * p.m1;
    let t23 = cos_theta * (t19 * p.m0_y0 - t16 * p.m0_x0);
    let h_x = -(t19 * p.m0 + t22);
    let h_y = -(p.m0 * t16 + t21);
    let h_theta = sin_theta * (t16 * p.m0_y0 + t19 * p.m0_x0) + t23;
    let h_s1 = -(cos_phi1 * t22 + sin_phi1 * t21);
    let h_phi1 = t22 * t10 - t12 * t21;
    let zero = S::ZERO;
    let h_s2 = p.minus_m2 * (cos_phi2 * t20 + sin_phi2 * t17);
    let h_phi2 = p.minus_m2 * (t11 * t17 - t20 * t9);
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
pub fn applied<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 9],
    v: &[S; 9],
) -> [S; 9] {
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
    let q_theta = t2 * p.bx_yb + t0 * p.cx_yc - (t3 * p.by_xb + t1 * p.cy_xc);
    let q_s1 = (p.r1 - s1) * p.k1 - s1_dot * p.d1;
    let zero = S::ZERO;
    let q_s2 = (p.r2 - s2) * p.k2 - s2_dot * p.d2;
    [q_x, q_y, q_theta, q_s1, zero, zero, q_s2, zero, zero]
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
    let t18 = p.e_w_squared * (sin_t0 + t2 * cos_t0);
    let t19 = t18 + (sin_theta * t5 + t4 * cos_theta);
    let t20 = t6 * t16 - t9 * cos_phi1;
    let t21 = p.e_w_squared * (cos_t0 - t2 * sin_t0);
    let t22 = t21 + (cos_theta * t5 - t4 * sin_theta);
    let t23 = t8 * sin_phi2 + t3 * t13 + t17;
    let t24 = t3 * t15 - t8 * cos_phi2 + t20;
    let t25 = t23 * p.m2;
    let t26 = p.m2 * t24;
    let t27 = t25 + t17 * p.m1;
    let t28 = t12 * p.by_xb + t10 * p.cy_xc - (t11 * p.bx_yb + t7 * p.cx_yc);
    let t29 = t26 + p.m1 * t20;
    let t30 = cos_theta * (t22 * p.m0_y0 - t19 * p.m0_x0) + t28;
    let f_x = t22 * p.m0 + (t27 - (t11 * p.bx + t7 * p.cx));
    let f_y = p.m0 * t19 + (t29 - (t12 * p.by + t10 * p.cy));
    let f_theta = -(sin_theta * (t19 * p.m0_y0 + t22 * p.m0_x0) + t30);
    let f_s1 = cos_phi1 * t27 + (sin_phi1 * t29 + ((p.r1 - s1) * p.k1 - s1_dot * p.d1));
    let f_phi1 = t14 * t29 - t27 * t16;
    let zero = S::ZERO;
    let f_s2 = cos_phi2 * t25 - (s2_dot * p.d2 - (p.r2 - s2) * p.k2 - sin_phi2 * t26);
    let f_phi2 = p.m2 * (t13 * t24 - t23 * t15);
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
    let t8 = s1_dot * N::from_f64(2.0) * phi1_dot;
    let t9 = (n(p.r2) - s2).neg_mul_add(n(p.k2), s2_dot * n(p.d2));
    let t10 = s2 * n(p.m2);
    let t11 = phi1_dot * (s1 * phi1_dot);
    let t12 = t4.mul_add(n(p.cy_xc), t6 * n(p.by_xb));
    let t13 = s1 * s1;
    let t14 = s2 * t10;
    let t15 = cos_theta * n(p.y0);
    let t16 = sin_theta * n(p.y0);
    let t17 = sin_theta * n(p.x0);
    let t18 = cos_theta * n(p.x0);
    let t19 = t3.mul_add(n(p.cx), t5 * n(p.bx));
    let t20 = t4.mul_add(n(p.cy), t6 * n(p.by));
    let t21 = t18 - t16;
    let t22 = t15 + t17;
    let t23 = sin_phi1.mul_sub(t11, cos_phi1 * t8);
    let t24 = n(p.m1).mul_add(t23, sin_phi2 * t9);
    let t25 = cos_phi1.mul_add(t11, sin_phi1 * t8);
    let t26 = t2.mul_add(cos_t0, sin_t0);
    let t27 = t2.neg_mul_add(sin_t0, cos_t0);
    let t28 = n(p.m1).mul_add(t25, cos_phi2 * t9);
    let t29 = t26.mul_add(n(p.e_w_squared), t1.mul_add(t15, t1 * t17));
    let t30 = t29 * n(p.m0);
    let t31 = t27.mul_add(n(p.e_w_squared), t1.mul_sub(t18, t1 * t16));
    let t32 = t31 * n(p.m0);
    let t33 = t3.mul_add(n(p.cx_yc), t5 * n(p.bx_yb)) - t12;
    let t34 = cos_phi1.neg_mul_add(t7, t19) - t32;
    let t35 = sin_phi1.neg_mul_add(t7, t20) - t30;
    // Eliminates s1: alone z[s1].
    let t36 = cos_phi1.neg_mul_add(t28, sin_phi1.neg_mul_add(t24, t7));
    let t37 = (t22 * n(p.k2_)).neg_mul_add(t34, t21.mul_add(t30, t33));
    let t38 = t37 + (t21 * n(p.k2_)).mul_sub(t35, t22 * t32);
    let t39 = t38 * n(p.k4);
    // Back substitution: a[y].
    let t40 = t21.mul_add(t39, t35) * n(p.k5);
    // Back substitution: a[x].
    let t41 = t22.neg_mul_add(t39, t34) * n(p.k5);
    let t42 = sin_phi1 * t40;
    let t43 = cos_phi1.neg_mul_add(t41, t36 * n(p.inverse_m1));
    let t44 = n(p.inverse_m1) * cos_phi1.mul_sub(t24, sin_phi1 * t28);
    // Back substitution: a[s1].
    let t45 = t43 - t42;
    let t46 = sin_phi1.neg_mul_add(t41, cos_phi1.mul_add(t40, t44));
    let t47 = sin_phi1.mul_add(t46, cos_phi1.mul_add(t45, t25 + t41));
    let t48 = sin_phi1.mul_add(t45, t23 + t40);
    let t49 = cos_phi1.neg_mul_add(t46, t48);
    let t50 = N::from_f64(2.0) * s2_dot * phi2_dot;
    // Eliminates s2: alone z[s2].
    let t51 = t10.neg_mul_add(phi2_dot * phi2_dot, t9) * n(p.inverse_m2);
    // Back substitution: a[phi2].
    let t52 = cos_phi2.neg_mul_add(t49, sin_phi2.mul_add(t47, t50)) / s2;
    let x_ddot = -t41;
    let y_ddot = -t40;
    let theta_ddot = t38 * n(p.k3);
    let s1_ddot = t42 - t43;
    // Back substitution: a[phi1].
    let phi1_ddot = t46 / s1;
    let zero = N::ZERO;
    // Back substitution: a[s2].
    let s2_ddot = sin_phi2.mul_add(t49, cos_phi2.mul_sub(t47, t51));
    let phi2_ddot = -t52;
    let t53 = t13 * n(p.m1);
    let t54 = t13 * n(p.m1_plus_m2);
    let sound = PIVOTS.hold(t14, t14) & PIVOTS.hold(t53, t54) & phi2_ddot.is_finite();
    if !sound {
        let pivots = [(7, t14, t14), (4, t53, t54)];
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
///     + 1/2*J2*der(theta2)^2 + 1/2*m0*(((der(x) - y0*cos(theta)*der(theta) -
///     x0*sin(theta)*der(theta)) - e*w*sin(w*t))^2 + ((der(y) + x0*cos(theta)*der(theta) -
///     y0*sin(theta)*der(theta)) + e*w*cos(w*t))^2) + 1/2*m1*((der(x) + (cos(phi1)*der(s1) -
///     s1*sin(phi1)*der(phi1)))^2 + (der(y) + (sin(phi1)*der(s1) + s1*cos(phi1)*der(phi1)))^2) +
///     1/2*m2*(((der(x) + (cos(phi1)*der(s1) - s1*sin(phi1)*der(phi1))) + (cos(phi2)*der(s2) -
///     s2*sin(phi2)*der(phi2)))^2 + ((der(y) + (sin(phi1)*der(s1) + s1*cos(phi1)*der(phi1))) +
///     (sin(phi2)*der(s2) + s2*cos(phi2)*der(phi2)))^2)
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
    let t9 = t8 - p.e_w * (sin_t0 + t3 * cos_t0);
    let t10 = y_dot + theta_dot * (cos_theta * p.x0 - sin_theta * p.y0);
    let t11 = p.e_w * (cos_t0 - t3 * sin_t0) + t10;
    let t12 = (y_dot * y_dot + x_dot * x_dot) * p.m + theta_dot * (theta_dot * p.J);
    let t13 = (t5 * t5 + t4 * t4) * p.m1 + theta1_dot * (theta1_dot * p.J1) + t12;
    let t14 = (t7 * t7 + t6 * t6) * p.m2 + theta2_dot * (theta2_dot * p.J2) + t13;
    t14 * S::from_f64(0.5) + p.half_m0 * (t11 * t11 + t9 * t9)
}

/// Potential energy `V`, in J.
///
/// ```text
/// V = 1/2*cx*(x - yc*theta)^2 + 1/2*cy*(y + xc*theta)^2 + 1/2*k1*(s1 - r1)^2 + 1/2*k2*(s2 - r2)^2
/// ```
pub fn potential_energy<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 9]) -> S {
    let x = q[0];
    let y = q[1];
    let theta = q[2];
    let s1 = q[3];
    let s2 = q[6];
    let t0 = p.r1 - s1;
    let t1 = x - theta * p.yc;
    let t2 = p.r2 - s2;
    let t3 = theta * p.xc + y;
    let t4 = t3 * (t3 * p.half_cy) + t1 * (t1 * p.half_cx);
    t2 * (t2 * p.half_k2) + t0 * (t0 * p.half_k1) + t4
}

/// Dissipation function `D`, in W.
///
/// ```text
/// D = 1/2*d1*der(s1)^2 + 1/2*d2*der(s2)^2 + 1/2*bx*(der(x) - yb*der(theta))^2
///     + 1/2*by*(der(y) + xb*der(theta))^2
/// ```
pub fn dissipation<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, v: &[S; 9]) -> S {
    let x_dot = v[0];
    let y_dot = v[1];
    let theta_dot = v[2];
    let s1_dot = v[3];
    let s2_dot = v[6];
    let t0 = x_dot - theta_dot * p.yb;
    let t1 = theta_dot * p.xb + y_dot;
    let t2 = s2_dot * (s2_dot * p.half_d2) + s1_dot * (s1_dot * p.half_d1);
    t1 * (t1 * p.half_by) + (t0 * (t0 * p.half_bx) + t2)
}

/// Power `P` supplied by drives, forces and inputs, in W.
///
/// ```text
/// P = m0*e*w*cos(w*t)*der(der(y)) - m0*e*w*sin(w*t)*der(der(x))
///     + m0*e*y0*w*sin(w*t - theta)*der(der(theta)) + m0*e*x0*w*cos(w*t - theta)*der(der(theta))
///     + m0*e*x0*w*sin(w*t - theta)*der(theta)^2 - m0*e*y0*w*cos(w*t - theta)*der(theta)^2
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
    let t0 = p.w * t;
    let t1 = theta_dot * theta_dot;
    let t2 = p.w.product_error(t);
    let (sin_t0, cos_t0) = t0.sin_cos();
    let t3 = sin_theta * theta_ddot + cos_theta * t1;
    let t4 = sin_theta * t1 - cos_theta * theta_ddot;
    let t5 = sin_t0 + t2 * cos_t0;
    let t6 = cos_t0 - t2 * sin_t0;
    let t7 = t6 * (t5 * p.e_w_squared - (y_ddot - t3 * p.y0 - t4 * p.x0));
    let t8 = t5 * (t6 * p.e_w_squared - (t4 * p.y0 + x_ddot - p.x0 * t3)) - t7;
    t8 * p.m0_e_w
}

/// Power `R` dissipated by dampers, in W.
///
/// ```text
/// R = d1*der(s1)^2 + d2*der(s2)^2 + bx*(der(x) - yb*der(theta))^2 + by*(der(y) + xb*der(theta))^2
/// ```
pub fn dissipation_rate<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, v: &[S; 9]) -> S {
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
pub fn assumption_0<S: ::lagrangian::emitted::Scalar>(q: &[S; 9]) -> S {
    let s1 = q[3];
    s1
}

/// By how much `s2 > 0` holds.
pub fn assumption_1<S: ::lagrangian::emitted::Scalar>(q: &[S; 9]) -> S {
    let s2 = q[6];
    s2
}

/// The coefficients of which products are made, order by order, while the Taylor series is
/// computed. What they hold before that does not matter.
pub struct Lists<S> {
    a0: ::lagrangian::emitted::series::Pack<S, 20>,
    b0: ::lagrangian::emitted::series::Pack<S, 20>,
}

impl<S: Copy + Default> Default for Lists<S> {
    fn default() -> Self {
        Self {
            a0: Default::default(),
            b0: Default::default(),
        }
    }
}

::lagrangian::emitted::fast_function! {
    /// The Taylor series of the motion through a state: row `j` of `coefficients` becomes
    /// `q⁽ʲ⁾/j!`. The time is the sum of two numbers.
    pub struct Series<'a, S> {
        p: &'a Prepared<S>,
        t: [S; 2],
        q: &'a [S; 9],
        v: &'a [S; 9],
        lists: &'a mut Lists<S>,
        coefficients: &'a mut [[S; 9]],
    } -> Result<(), ::lagrangian::emitted::Singular> = series_in;
}

#[inline(always)]
fn series_in<S: Copy, N: ::lagrangian::emitted::Scalar<Stored = S>>(
    call: Series<'_, S>,
) -> Result<(), ::lagrangian::emitted::Singular> {
    let Series {
        p,
        t,
        q,
        v,
        lists,
        coefficients,
    } = call;
    let n = N::load;
    let x0 = n(q[0]);
    let x1 = n(q[2]);
    let x2 = n(p.series[0]);
    let x3 = x2.mul_add(x1, x0);
    let x4 = n(t[1]);
    let x5 = n(t[0]);
    let x6 = n(p.series[1]);
    let x7 = x6.product_error(x5);
    let x8 = x6.mul_add(x4, x7);
    let x9 = x6 * x5;
    let x10 = n(q[3]);
    let x11 = n(q[4]);
    let x12 = n(q[6]);
    let x13 = n(q[7]);
    let x14 = n(q[1]);
    let x15 = n(p.series[2]);
    let x16 = x15 * x1;
    let x17 = x16 + x14;
    let x18 = n(p.series[3]);
    let x19 = -x18;
    let x20 = x19 + x10;
    let x21 = n(p.series[4]);
    let x22 = -x21;
    let x23 = x22 + x12;
    let angles24 = [x9, x1, x11, x13];
    let x24 = N::sin_cos_all(angles24);
    let x25 = x24[0].0;
    let x26 = x24[0].1;
    let x27 = x8.mul_add(x26, x25);
    let x28 = x8.neg_mul_add(x25, x26);
    let x29 = x24[1].0;
    let x30 = x24[1].1;
    let x31 = x24[2].0;
    let x32 = x24[2].1;
    let x33 = x24[3].0;
    let x34 = x24[3].1;
    let x35 = x10 * x32;
    let x36 = x12 * x34;
    let x37 = x10 * x31;
    let x38 = x12 * x33;
    let x39 = n(v[0]);
    let x40 = n(v[2]);
    let x41 = x2.mul_add(x40, x39);
    let x42 = x6 * x28;
    let x43 = x6 * x27;
    let x44 = -x43;
    let x45 = x40 * x30;
    let x46 = x40 * x29;
    let x47 = -x46;
    let x48 = n(v[3]);
    let x49 = n(v[4]);
    let x50 = x49 * x32;
    let x51 = x49 * x31;
    let x52 = -x51;
    let x53 = x48 * x32;
    let x54 = x10.mul_add(x52, x53);
    let x55 = n(v[6]);
    let x56 = n(v[7]);
    let x57 = x56 * x34;
    let x58 = x56 * x33;
    let x59 = -x58;
    let x60 = x55 * x34;
    let x61 = x12.mul_add(x59, x60);
    let x62 = n(v[1]);
    let x63 = x15 * x40;
    let x64 = x63 + x62;
    let x65 = x48 * x31;
    let x66 = x10.mul_add(x50, x65);
    let x67 = x55 * x33;
    let x68 = x12.mul_add(x57, x67);
    let x69 = x6 * x44;
    let x70 = N::from_f64(0.5);
    let x71 = x70 * x69;
    let x72 = x6 * x42;
    let x73 = -x72;
    let x74 = x70 * x73;
    let x75 = x40 * x47;
    let x76 = N::from_f64(2.0);
    let x77 = x70 * x75;
    let x78 = x40 * x45;
    let x79 = -x78;
    let x80 = x70 * x79;
    let x81 = x49 * x52;
    let x82 = x70 * x81;
    let x83 = x49 * x50;
    let x84 = -x83;
    let x85 = x70 * x84;
    let x86 = x48 * x52;
    let x87 = x10.mul_add(x85, x86);
    let x88 = x56 * x59;
    let x89 = x70 * x88;
    let x90 = x56 * x57;
    let x91 = -x90;
    let x92 = x70 * x91;
    let x93 = x55 * x59;
    let x94 = x12.mul_add(x92, x93);
    let x95 = x48 * x50;
    let x96 = x10.mul_add(x82, x95);
    let x97 = x55 * x57;
    let x98 = x12.mul_add(x89, x97);
    let x99 = n(p.series[5]);
    let x100 = x99.mul_add(x40, x39);
    let x101 = n(p.series[6]);
    let x102 = x101 * x40;
    let x103 = x102 + x62;
    let x104 = n(p.series[7]);
    let x105 = x104 * x75;
    let x106 = n(p.series[8]);
    let x107 = x106.mul_add(x79, x105);
    let x108 = n(p.series[9]);
    let x109 = x108.mul_add(x73, x107);
    let x110 = x76 * x87;
    let x111 = x76 * x94;
    let x112 = x110 + x111;
    let x113 = n(p.series[10]);
    let x114 = x113 * x110;
    let x115 = n(p.series[11]);
    let x116 = x115.mul_add(x112, x114);
    let x117 = n(p.series[12]);
    let x118 = x117 * x3;
    let x119 = n(p.series[13]);
    let x120 = x119.mul_add(x100, x118);
    let x121 = n(p.series[14]);
    let x122 = n(p.series[15]);
    let x123 = x122.mul_add(x109, x120);
    let x124 = x123 + x116;
    let x125 = x106 * x75;
    let x126 = n(p.series[16]);
    let x127 = x126.mul_add(x79, x125);
    let x128 = x108.mul_add(x69, x127);
    let x129 = x76 * x96;
    let x130 = x76 * x98;
    let x131 = x129 + x130;
    let x132 = x113 * x129;
    let x133 = x115.mul_add(x131, x132);
    let x134 = n(p.series[17]);
    let x135 = x134 * x17;
    let x136 = n(p.series[18]);
    let x137 = x136.mul_add(x103, x135);
    let x138 = x122.mul_add(x128, x137);
    let x139 = x138 + x133;
    let x140 = n(p.series[19]);
    let x141 = x140 * x128;
    let x142 = n(p.series[20]);
    let x143 = x142.mul_add(x109, x141);
    let x144 = x30 * x143;
    let x145 = n(p.series[21]);
    let x146 = x145 * x128;
    let x147 = x140.mul_add(x109, x146);
    let x148 = x29 * x147;
    let x149 = n(p.series[22]);
    let x150 = x149 * x3;
    let x151 = n(p.series[23]);
    let x152 = x151.mul_add(x17, x150);
    let x153 = n(p.series[24]);
    let x154 = x153.mul_add(x100, x152);
    let x155 = n(p.series[25]);
    let x156 = x155.mul_add(x103, x154);
    let x157 = n(p.series[26]);
    let x158 = x156 + x144;
    let x159 = x158 - x148;
    let x160 = x31 * x133;
    let x161 = x32 * x116;
    let x162 = n(p.series[27]);
    let x163 = x162 * x20;
    let x164 = n(p.series[28]);
    let x165 = x164.mul_add(x48, x163);
    let x166 = x165 + x160;
    let x167 = x166 + x161;
    let x168 = x35 * x133;
    let x169 = x37 * x116;
    let x170 = x168 - x169;
    let x172 = x33 * x131;
    let x173 = x34 * x112;
    let x174 = n(p.series[30]);
    let x175 = x174 * x23;
    let x176 = n(p.series[31]);
    let x177 = x176.mul_add(x55, x175);
    let x178 = x115.mul_add(x172, x177);
    let x179 = x115.mul_add(x173, x178);
    let x180 = x36 * x131;
    let x181 = x38 * x112;
    let x182 = x115 * x180;
    let x183 = n(p.series[32]);
    let x184 = x183.mul_add(x181, x182);
    let x186 = -x29;
    let x187 = x104 * x30;
    let x188 = x106.mul_add(x186, x187);
    let x189 = -x31;
    let x190 = x10 * x189;
    let x191 = -x33;
    let x192 = x12 * x191;
    let x193 = x113 * x32;
    let x194 = x113 * x190;
    let x195 = x115 + x113;
    let x196 = x115.mul_add(x32, x193);
    let x197 = x115.mul_add(x190, x194);
    let x198 = x115 * x34;
    let x199 = x115 * x192;
    let x200 = x122 + x121;
    let x201 = x122 * x188;
    let x202 = x195 + x200;
    let x203 = x106 * x30;
    let x204 = x126.mul_add(x186, x203);
    let x205 = x113 * x31;
    let x206 = x113 * x35;
    let x207 = x115.mul_add(x31, x205);
    let x208 = x115.mul_add(x35, x206);
    let x209 = x115 * x33;
    let x210 = x115 * x36;
    let x211 = x122 * x204;
    let x212 = x140 * x204;
    let x213 = x142.mul_add(x188, x212);
    let x214 = x30 * x142;
    let x215 = x30 * x140;
    let x216 = x30 * x213;
    let x217 = x145 * x204;
    let x218 = x140.mul_add(x188, x217);
    let x219 = x29 * x140;
    let x220 = x29 * x145;
    let x221 = x29 * x218;
    let x222 = x216 + x157;
    let x223 = x214 - x219;
    let x224 = x215 - x220;
    let x225 = x222 - x221;
    let x226 = x31 * x195;
    let x227 = x31 * x207;
    let x228 = x31 * x208;
    let x229 = x31 * x209;
    let x230 = x31 * x210;
    let x231 = x32 * x195;
    let x232 = x32 * x196;
    let x233 = x32 * x197;
    let x234 = x32 * x198;
    let x235 = x32 * x199;
    let x236 = x232 + x227;
    let x237 = x233 + x228;
    let x238 = x234 + x229;
    let x239 = x235 + x230;
    let x240 = x35 * x195;
    let x241 = x35 * x207;
    let x242 = x35 * x208;
    let x243 = x35 * x209;
    let x244 = x35 * x210;
    let x245 = x37 * x195;
    let x246 = x37 * x196;
    let x247 = x37 * x197;
    let x248 = x37 * x198;
    let x249 = x37 * x199;
    let x250 = -x245;
    let x251 = x241 - x246;
    let x252 = x242 - x247;
    let x253 = x243 - x248;
    let x254 = x244 - x249;
    let x255 = x33 * x31;
    let x256 = x33 * x35;
    let x257 = x33 * x33;
    let x258 = x33 * x36;
    let x259 = x34 * x32;
    let x260 = x34 * x190;
    let x261 = x34 * x34;
    let x262 = x34 * x192;
    let x263 = x115 * x255;
    let x264 = x115 * x256;
    let x265 = x115 * x257;
    let x266 = x115 * x258;
    let x267 = x115.mul_add(x259, x263);
    let x268 = x115.mul_add(x260, x264);
    let x269 = x115.mul_add(x261, x265);
    let x270 = x115.mul_add(x262, x266);
    let x271 = x36 * x31;
    let x272 = x36 * x35;
    let x273 = x36 * x33;
    let x274 = x36 * x36;
    let x275 = x38 * x32;
    let x276 = x38 * x190;
    let x277 = x38 * x34;
    let x278 = x38 * x192;
    let x279 = x115 * x271;
    let x280 = x115 * x272;
    let x281 = x115 * x273;
    let x282 = x115 * x274;
    let x283 = x183 * x38;
    let x284 = x183.mul_add(x275, x279);
    let x285 = x183.mul_add(x276, x280);
    let x286 = x183.mul_add(x277, x281);
    let x287 = x183.mul_add(x278, x282);
    let mut x288 = [
        x202.store(),
        N::ZERO.store(),
        x201.store(),
        x196.store(),
        x197.store(),
        x198.store(),
        x199.store(),
        N::ZERO.store(),
        x202.store(),
        x211.store(),
        x207.store(),
        x208.store(),
        x209.store(),
        x210.store(),
        x223.store(),
        x224.store(),
        x225.store(),
        N::ZERO.store(),
        N::ZERO.store(),
        N::ZERO.store(),
        N::ZERO.store(),
        x231.store(),
        x226.store(),
        N::ZERO.store(),
        x236.store(),
        x237.store(),
        x238.store(),
        x239.store(),
        x250.store(),
        x240.store(),
        N::ZERO.store(),
        x251.store(),
        x252.store(),
        x253.store(),
        x254.store(),
        x198.store(),
        x209.store(),
        N::ZERO.store(),
        x267.store(),
        x268.store(),
        x269.store(),
        x270.store(),
        x283.store(),
        x210.store(),
        N::ZERO.store(),
        x284.store(),
        x285.store(),
        x286.store(),
        x287.store(),
    ];
    let members288 = [0, 1, 2, 3, 4, 6, 7];
    let factored = ::lagrangian::emitted::series::factor::<N>(7, 7, &mut x288);
    if let Err(vanished) = factored {
        let singular = ::lagrangian::emitted::series::singular(vanished, &members288, 9);
        return Err(singular);
    }
    let x297 = -x124;
    let x298 = -x139;
    let x299 = -x159;
    let x300 = -x167;
    let x301 = -x170;
    let x302 = -x179;
    let x303 = -x184;
    let x304 = ::lagrangian::emitted::series::solved::<N, 7>(
        &x288,
        [x297, x298, x299, x300, x301, x302, x303],
    );
    let x305 = x304[0];
    let x306 = x304[1];
    let x307 = x304[2];
    let x308 = x304[3];
    let x309 = x304[4];
    let x310 = x304[5];
    let x311 = x304[6];
    let x312 = x305 * x70;
    let x313 = x306 * x70;
    let x314 = x307 * x70;
    let x315 = x308 * x70;
    let x316 = x309 * x70;
    let x317 = x310 * x70;
    let x318 = x311 * x70;
    let x319 = x32.mul_add(x308, x305);
    let x320 = x190.mul_add(x309, x319);
    let x321 = x34.mul_add(x310, x320);
    let x322 = x192.mul_add(x311, x321);
    let x323 = x112 + x322;
    let x324 = x195 * x305;
    let x325 = x196.mul_add(x308, x324);
    let x326 = x197.mul_add(x309, x325);
    let x327 = x198.mul_add(x310, x326);
    let x328 = x199.mul_add(x311, x327);
    let x329 = x116 + x328;
    let x330 = x31.mul_add(x308, x306);
    let x331 = x35.mul_add(x309, x330);
    let x332 = x33.mul_add(x310, x331);
    let x333 = x36.mul_add(x311, x332);
    let x334 = x131 + x333;
    let x335 = x195 * x306;
    let x336 = x207.mul_add(x308, x335);
    let x337 = x208.mul_add(x309, x336);
    let x338 = x209.mul_add(x310, x337);
    let x339 = x210.mul_add(x311, x338);
    let x340 = x133 + x339;
    let x341 = x142 * x305;
    let x342 = x140.mul_add(x306, x341);
    let x343 = x213.mul_add(x307, x342);
    let x344 = x143 + x343;
    let x345 = x140 * x305;
    let x346 = x145.mul_add(x306, x345);
    let x347 = x218.mul_add(x307, x346);
    let x348 = x147 + x347;
    let x349 = x2.mul_add(x307, x305);
    let x350 = x70 * x349;
    let x351 = x30 * x70;
    let x352 = x351.mul_add(x307, x77);
    let x353 = x186 * x70;
    let x354 = x353.mul_add(x307, x80);
    let x355 = x32 * x70;
    let x356 = x355.mul_add(x309, x82);
    let x357 = x189 * x70;
    let x358 = x357.mul_add(x309, x85);
    let x359 = x32 * x308;
    let x360 = x190.mul_add(x309, x359);
    let x361 = x70.mul_add(x360, x87);
    let x362 = x34 * x70;
    let x363 = x362.mul_add(x311, x89);
    let x364 = x191 * x70;
    let x365 = x364.mul_add(x311, x92);
    let x366 = x34 * x310;
    let x367 = x192.mul_add(x311, x366);
    let x368 = x70.mul_add(x367, x94);
    let x369 = x15.mul_add(x307, x306);
    let x370 = x70 * x369;
    let x371 = x31 * x308;
    let x372 = x35.mul_add(x309, x371);
    let x373 = x70.mul_add(x372, x96);
    let x374 = x33 * x310;
    let x375 = x36.mul_add(x311, x374);
    let x376 = x70.mul_add(x375, x98);
    let x377 = x70 * x308;
    let x378 = x70 * x310;
    let second = [
        x312.store(),
        x313.store(),
        x314.store(),
        x315.store(),
        x316.store(),
        N::ZERO.store(),
        x317.store(),
        x318.store(),
        N::ZERO.store(),
    ];
    for (row, x) in coefficients.iter_mut().zip([*q, *v, second]) {
        *row = x;
    }
    const A0: [usize; 20] = [0, 0, 1, 1, 2, 3, 3, 4, 2, 4, 5, 6, 7, 8, 7, 8, 9, 10, 9, 10];
    const B0: [usize; 20] = [0, 1, 2, 3, 2, 4, 5, 4, 3, 5, 0, 1, 3, 2, 6, 7, 5, 4, 8, 9];
    ::lagrangian::emitted::series::keep::<N, 20, 20>(
        &mut lists.a0.0,
        2,
        [
            x307.store(),
            x307.store(),
            x309.store(),
            x309.store(),
            x315.store(),
            x311.store(),
            x311.store(),
            x317.store(),
            x315.store(),
            x317.store(),
            x344.store(),
            x348.store(),
            x340.store(),
            x329.store(),
            x340.store(),
            x329.store(),
            x334.store(),
            x323.store(),
            x334.store(),
            x323.store(),
        ],
        &A0,
    );
    ::lagrangian::emitted::series::keep::<N, 20, 20>(
        &mut lists.b0.0,
        2,
        [
            x354.store(),
            x352.store(),
            x358.store(),
            x356.store(),
            x358.store(),
            x365.store(),
            x363.store(),
            x365.store(),
            x356.store(),
            x363.store(),
            x354.store(),
            x352.store(),
            x356.store(),
            x358.store(),
            x361.store(),
            x373.store(),
            x363.store(),
            x365.store(),
            x368.store(),
            x376.store(),
        ],
        &B0,
    );
    let mut y18 = x350;
    let mut y24 = x71;
    let mut y25 = x74;
    let mut y27 = x352;
    let mut y28 = x354;
    let mut y33 = x315;
    let mut y35 = x356;
    let mut y36 = x358;
    let mut y40 = x317;
    let mut y42 = x363;
    let mut y43 = x365;
    let mut y46 = x323;
    let mut y47 = x329;
    let mut y56 = x370;
    let mut y65 = x334;
    let mut y66 = x340;
    let mut y77 = x344;
    let mut y79 = x348;
    let mut y88 = x377;
    let mut y102 = x378;
    let mut older_y18 = x41;
    let mut older_y56 = x64;
    let mut older_y88 = x48;
    let mut older_y102 = x55;
    let mut acceleration0 = x305;
    let mut acceleration1 = x306;
    let mut acceleration2 = x307;
    let mut acceleration3 = x308;
    let mut acceleration4 = x309;
    let mut acceleration6 = x310;
    let mut acceleration7 = x311;
    let count = coefficients.len().min(::lagrangian::emitted::series::ROWS);
    for order in 3..count {
        let w0 = ::lagrangian::emitted::series::sweep::<N, 20, 20>(
            [&lists.a0.0, &lists.b0.0],
            order - 2,
            [&A0, &B0],
        );
        let x379 = y25;
        let x380 = x6 * x379;
        let x381 = N::from_ratio(1, order as i64);
        let x382 = x381 * x380;
        let x383 = y24;
        let x384 = x6 * x383;
        let x385 = -x384;
        let x386 = x381 * x385;
        let x387 = w0[0];
        let x388 = acceleration2;
        let x389 = N::from_ratio(1, order as i64 - 2);
        let x390 = x388 * x389;
        let x391 = x390.mul_add(x47, x387);
        let x392 = y28;
        let x393 = x40.mul_add(x392, x391);
        let x394 = N::from_f64(order as f64);
        let x395 = x381 * x393;
        let x396 = w0[1];
        let x397 = x390.mul_add(x45, x396);
        let x398 = y27;
        let x399 = x40.mul_add(x398, x397);
        let x400 = -x399;
        let x401 = x381 * x400;
        let x402 = w0[2];
        let x403 = acceleration4;
        let x404 = x403 * x389;
        let x405 = x404.mul_add(x52, x402);
        let x406 = y36;
        let x407 = x49.mul_add(x406, x405);
        let x408 = x381 * x407;
        let x409 = w0[3];
        let x410 = x404.mul_add(x50, x409);
        let x411 = y35;
        let x412 = x49.mul_add(x411, x410);
        let x413 = -x412;
        let x414 = x381 * x413;
        let x415 = w0[4];
        let x416 = y33;
        let x417 = x416.mul_add(x52, x415);
        let x418 = x48.mul_add(x406, x417);
        let x419 = x10.mul_add(x414, x418);
        let x420 = w0[5];
        let x421 = acceleration7;
        let x422 = x421 * x389;
        let x423 = x422.mul_add(x59, x420);
        let x424 = y43;
        let x425 = x56.mul_add(x424, x423);
        let x426 = x381 * x425;
        let x427 = w0[6];
        let x428 = x422.mul_add(x57, x427);
        let x429 = y42;
        let x430 = x56.mul_add(x429, x428);
        let x431 = -x430;
        let x432 = x381 * x431;
        let x433 = w0[7];
        let x434 = y40;
        let x435 = x434.mul_add(x59, x433);
        let x436 = x55.mul_add(x424, x435);
        let x437 = x12.mul_add(x432, x436);
        let x438 = w0[8];
        let x439 = x416.mul_add(x50, x438);
        let x440 = x48.mul_add(x411, x439);
        let x441 = x10.mul_add(x408, x440);
        let x442 = w0[9];
        let x443 = x434.mul_add(x57, x442);
        let x444 = x55.mul_add(x429, x443);
        let x445 = x12.mul_add(x426, x444);
        let x446 = acceleration0;
        let x447 = x446 * x389;
        let x448 = x99.mul_add(x390, x447);
        let x449 = acceleration1;
        let x450 = x449 * x389;
        let x451 = x101 * x390;
        let x452 = x451 + x450;
        let x453 = acceleration3;
        let x454 = x453 * x389;
        let x455 = acceleration6;
        let x456 = x455 * x389;
        let x457 = N::from_f64((order - 1) as f64);
        let x461 = x104 * x457;
        let x462 = x461 * x393;
        let x463 = x106 * x457;
        let x464 = x463.mul_add(x400, x462);
        let x465 = x108 * x457;
        let x466 = x465.mul_add(x385, x464);
        let x469 = x457 * x394;
        let x470 = x469 * x419;
        let x473 = x469.mul_add(x437, x470);
        let x474 = x113 * x470;
        let x475 = x115.mul_add(x473, x474);
        let x476 = older_y18;
        let x477 = x117 * x476;
        let x478 = x119.mul_add(x448, x477);
        let x479 = x122.mul_add(x466, x478);
        let x480 = x479 + x475;
        let x482 = x463 * x393;
        let x483 = x126 * x457;
        let x484 = x483.mul_add(x400, x482);
        let x485 = x465.mul_add(x380, x484);
        let x488 = x469 * x441;
        let x491 = x469.mul_add(x445, x488);
        let x492 = x113 * x488;
        let x493 = x115.mul_add(x491, x492);
        let x494 = older_y56;
        let x495 = x134 * x494;
        let x496 = x136.mul_add(x452, x495);
        let x497 = x122.mul_add(x485, x496);
        let x498 = x497 + x493;
        let x499 = x140 * x485;
        let x500 = x142.mul_add(x466, x499);
        let x501 = w0[10];
        let x502 = y77;
        let x503 = x502.mul_add(x47, x501);
        let x504 = x500.mul_add(x30, x503);
        let x505 = x145 * x485;
        let x506 = x140.mul_add(x466, x505);
        let x507 = w0[11];
        let x508 = y79;
        let x509 = x508.mul_add(x45, x507);
        let x510 = x506.mul_add(x29, x509);
        let x511 = x149 * x476;
        let x512 = x151.mul_add(x494, x511);
        let x513 = x153.mul_add(x448, x512);
        let x514 = x155.mul_add(x452, x513);
        let x515 = x514 + x504;
        let x516 = x515 - x510;
        let x517 = w0[12];
        let x518 = y66;
        let x519 = x518.mul_add(x50, x517);
        let x520 = x493.mul_add(x31, x519);
        let x521 = w0[13];
        let x522 = y47;
        let x523 = x522.mul_add(x52, x521);
        let x524 = x475.mul_add(x32, x523);
        let x525 = older_y88;
        let x526 = x162 * x525;
        let x527 = x164.mul_add(x454, x526);
        let x528 = x527 + x520;
        let x529 = x528 + x524;
        let x530 = w0[14];
        let x531 = x518.mul_add(x54, x530);
        let x532 = x493.mul_add(x35, x531);
        let x533 = w0[15];
        let x534 = x522.mul_add(x66, x533);
        let x535 = x475.mul_add(x37, x534);
        let x536 = x532 - x535;
        let x537 = w0[16];
        let x538 = y65;
        let x539 = x538.mul_add(x57, x537);
        let x540 = x491.mul_add(x33, x539);
        let x541 = w0[17];
        let x542 = y46;
        let x543 = x542.mul_add(x59, x541);
        let x544 = x473.mul_add(x34, x543);
        let x545 = older_y102;
        let x546 = x174 * x545;
        let x547 = x176.mul_add(x456, x546);
        let x548 = x115.mul_add(x540, x547);
        let x549 = x115.mul_add(x544, x548);
        let x550 = w0[18];
        let x551 = x538.mul_add(x61, x550);
        let x552 = x491.mul_add(x36, x551);
        let x553 = w0[19];
        let x554 = x542.mul_add(x68, x553);
        let x555 = x473.mul_add(x38, x554);
        let x556 = x115 * x552;
        let x557 = x183.mul_add(x555, x556);
        let x558 = -x480;
        let x559 = -x498;
        let x560 = -x516;
        let x561 = -x529;
        let x562 = -x536;
        let x563 = -x549;
        let x564 = -x557;
        let x565 = ::lagrangian::emitted::series::solved::<N, 7>(
            &x288,
            [x558, x559, x560, x561, x562, x563, x564],
        );
        let x566 = x565[0];
        let x567 = x565[1];
        let x568 = x565[2];
        let x569 = x565[3];
        let x570 = x565[4];
        let x571 = x565[5];
        let x572 = x565[6];
        let x573 = N::from_ratio(1, order as i64 - 1);
        let x574 = N::divisor(order as i64 * (order as i64 - 1));
        let x576 = x566.over(x574);
        let x578 = x567.over(x574);
        let x579 = x568 * x573;
        let x580 = x568.over(x574);
        let x582 = x569.over(x574);
        let x583 = x570 * x573;
        let x584 = x570.over(x574);
        let x586 = x571.over(x574);
        let x587 = x572 * x573;
        let x588 = x572.over(x574);
        let x589 = x573 * x381;
        let x590 = x32.mul_add(x569, x566);
        let x591 = x190.mul_add(x570, x590);
        let x592 = x34.mul_add(x571, x591);
        let x593 = x192.mul_add(x572, x592);
        let x594 = x473 + x593;
        let x595 = x195 * x566;
        let x596 = x196.mul_add(x569, x595);
        let x597 = x197.mul_add(x570, x596);
        let x598 = x198.mul_add(x571, x597);
        let x599 = x199.mul_add(x572, x598);
        let x600 = x475 + x599;
        let x601 = x31.mul_add(x569, x567);
        let x602 = x35.mul_add(x570, x601);
        let x603 = x33.mul_add(x571, x602);
        let x604 = x36.mul_add(x572, x603);
        let x605 = x491 + x604;
        let x606 = x195 * x567;
        let x607 = x207.mul_add(x569, x606);
        let x608 = x208.mul_add(x570, x607);
        let x609 = x209.mul_add(x571, x608);
        let x610 = x210.mul_add(x572, x609);
        let x611 = x493 + x610;
        let x612 = x142 * x566;
        let x613 = x140.mul_add(x567, x612);
        let x614 = x213.mul_add(x568, x613);
        let x615 = x500 + x614;
        let x616 = x140 * x566;
        let x617 = x145.mul_add(x567, x616);
        let x618 = x218.mul_add(x568, x617);
        let x619 = x506 + x618;
        let x620 = x2.mul_add(x568, x566);
        let x621 = x589 * x620;
        let x622 = x30 * x589;
        let x623 = x622.mul_add(x568, x395);
        let x624 = x186 * x589;
        let x625 = x624.mul_add(x568, x401);
        let x626 = x32 * x589;
        let x627 = x626.mul_add(x570, x408);
        let x628 = x189 * x589;
        let x629 = x628.mul_add(x570, x414);
        let x630 = x32 * x569;
        let x631 = x190.mul_add(x570, x630);
        let x632 = x589.mul_add(x631, x419);
        let x633 = x34 * x589;
        let x634 = x633.mul_add(x572, x426);
        let x635 = x191 * x589;
        let x636 = x635.mul_add(x572, x432);
        let x637 = x34 * x571;
        let x638 = x192.mul_add(x572, x637);
        let x639 = x589.mul_add(x638, x437);
        let x640 = x15.mul_add(x568, x567);
        let x641 = x589 * x640;
        let x642 = x31 * x569;
        let x643 = x35.mul_add(x570, x642);
        let x644 = x589.mul_add(x643, x441);
        let x645 = x33 * x571;
        let x646 = x36.mul_add(x572, x645);
        let x647 = x589.mul_add(x646, x445);
        let x648 = x589 * x569;
        let x649 = x589 * x571;
        let x650 = y18;
        let x651 = y56;
        let x652 = y88;
        let x653 = y102;
        if let Some(row) = coefficients.get_mut(order) {
            *row = [
                x576.store(),
                x578.store(),
                x580.store(),
                x582.store(),
                x584.store(),
                N::ZERO.store(),
                x586.store(),
                x588.store(),
                N::ZERO.store(),
            ];
        }
        ::lagrangian::emitted::series::keep::<N, 20, 20>(
            &mut lists.a0.0,
            order,
            [
                x579.store(),
                x579.store(),
                x583.store(),
                x583.store(),
                x582.store(),
                x587.store(),
                x587.store(),
                x586.store(),
                x582.store(),
                x586.store(),
                x615.store(),
                x619.store(),
                x611.store(),
                x600.store(),
                x611.store(),
                x600.store(),
                x605.store(),
                x594.store(),
                x605.store(),
                x594.store(),
            ],
            &A0,
        );
        ::lagrangian::emitted::series::keep::<N, 20, 20>(
            &mut lists.b0.0,
            order,
            [
                x625.store(),
                x623.store(),
                x629.store(),
                x627.store(),
                x629.store(),
                x636.store(),
                x634.store(),
                x636.store(),
                x627.store(),
                x634.store(),
                x625.store(),
                x623.store(),
                x627.store(),
                x629.store(),
                x632.store(),
                x644.store(),
                x634.store(),
                x636.store(),
                x639.store(),
                x647.store(),
            ],
            &B0,
        );
        y18 = x621;
        y24 = x382;
        y25 = x386;
        y27 = x623;
        y28 = x625;
        y33 = x582;
        y35 = x627;
        y36 = x629;
        y40 = x586;
        y42 = x634;
        y43 = x636;
        y46 = x594;
        y47 = x600;
        y56 = x641;
        y65 = x605;
        y66 = x611;
        y77 = x615;
        y79 = x619;
        y88 = x648;
        y102 = x649;
        older_y18 = x650;
        older_y56 = x651;
        older_y88 = x652;
        older_y102 = x653;
        acceleration0 = x566;
        acceleration1 = x567;
        acceleration2 = x568;
        acceleration3 = x569;
        acceleration4 = x570;
        acceleration6 = x571;
        acceleration7 = x572;
    }
    Ok(())
}

::lagrangian::emitted::implement! {
    machine Crusher9 "Crusher9" over S, R;
    parameters {
        m, J, m0, e, x0, y0, w, m1, J1, m2, J2, cx, cy, xc, yc, bx, by, xb, yb, k1, d1, r1, k2, d2,
        r2,
    } [
        m: "m" "kg" = 450.0;
        J: "J" "kg*m^2" = 60.0;
        m0: "m0" "kg" = 25.0;
        e: "e" "m" = 0.04;
        x0: "x0" "m" = 0.1;
        y0: "y0" "m" = -0.25;
        w: "w" "rad/s" = 100.0;
        m1: "m1" "kg" = 120.0;
        J1: "J1" "kg*m^2" = 2.4;
        m2: "m2" "kg" = 60.0;
        J2: "J2" "kg*m^2" = 0.5;
        cx: "cx" "N/m" = 200000.0;
        cy: "cy" "N/m" = 160000.0;
        xc: "xc" "m" = 0.35;
        yc: "yc" "m" = -0.05;
        bx: "bx" "N*s/m" = 400.0;
        by: "by" "N*s/m" = 350.0;
        xb: "xb" "m" = 0.35;
        yb: "yb" "m" = 0.04;
        k1: "k1" "N/m" = 50000.0;
        d1: "d1" "N*s/m" = 60.0;
        r1: "r1" "m" = 0.15;
        k2: "k2" "N/m" = 20000.0;
        d2: "d2" "N*s/m" = 30.0;
        r2: "r2" "m" = 0.1;
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
        m, J, m0, x0, y0, w, m1, J1, m2, J2, cx, cy, xc, yc, bx, by, xb, yb, k1, d1, r1, k2, d2, r2,
        e_w, half_cx, half_cy, half_k1, half_k2, half_bx, half_by, half_d1, half_d2, e_w_squared,
        half_m0, m1_plus_m2, m0_y0, m0_x0, k0, by_xb, bx_yb, cy_xc, cx_yc, m0_e_w, k1_, minus_m2,
        inverse_m2, inverse_m1, k2_, k3, k4, k5,
    }
    series series
    singular singular
    accelerations { (p, t, q, v, u) Accelerations { p, t, q, v } }
    system {
        series_in_lists series(p, t, q, v, u, lists, coefficients) = Series {
            p,
            t,
            q,
            v,
            lists,
            coefficients,
        };
        costs series_cost(p) = [8.8, 13.7];
        more powers_cost(p) = [0.4, 13.2, 15.4];
        boolean has_linear_assumptions(p) = true;
        boolean series_may_branch(p) = false;
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
    batch_series {
        Lists<::lagrangian::emitted::Lanes<N>>;
        (p, t, q, v, u, lists, coefficients) Series {
            p,
            t,
            q,
            v,
            lists,
            coefficients,
        }
    }
    lanes [N]
    numbers [yes]
}
