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
//! | `prepare` | 24 | 10 | 2 | 0 | 0 | 36 |
//! | `mass_matrix` | 24 | 3 | 0 | 2 | 0 | 31 |
//! | `bias` | 72 | 52 | 0 | 3 | 0 | 130 |
//! | `applied` | 12 | 23 | 0 | 0 | 0 | 35 |
//! | `forces` | 84 | 76 | 0 | 3 | 0 | 166 |
//! | `accelerations` | 188 | 143 | 5 | 3 | 0 | 342 |
//! | `kinetic_energy` | 37 | 25 | 0 | 3 | 0 | 68 |
//! | `potential_energy` | 8 | 7 | 0 | 0 | 0 | 15 |
//! | `dissipation` | 8 | 7 | 0 | 0 | 0 | 15 |
//! | `work_rate` | 20 | 15 | 0 | 1 | 0 | 37 |
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

impl<S: ::lagrangian::emitted::Scalar> FrozenCrusher<S> {
    /// Computes what depends on the parameters alone, once.
    pub fn prepare(&self) -> Prepared<S> {
        let k8 = self.m0 * self.x0;
        let t0 = self.m0 * self.y0;
        let k6 = self.m1 + self.m2;
        let k0 = self.omega * self.e;
        let k10 = self.omega * k0;
        let k7 = k6 + (self.m + self.m0);
        let k9 = self.y0 * t0 + (self.J + self.x0 * k8);
        let k24 = S::ONE / k9;
        let k21 = t0 * k24;
        let k22 = k8 * k24;
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
        let k19 = -k6;
        let k20 = -self.m2;
        let k23 = k8 * k21;
        let k25 = S::ONE / k6;
        let k26 = k7 - t0 * k21;
        let k27 = k7 - k8 * k22;
        let pivots = [
            (5, self.J1, self.J1),
            (8, self.J2, self.J2),
            (2, k9, k9),
            (3, k6, k6),
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

/// The coordinates of [`FrozenCrusher`], or their rates, by name.
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
    /// `-(m1 + m2)`
    k19: S,
    /// `-m2`
    k20: S,
    /// `m0*y0/(J + m0*x0^2 + m0*y0^2)`
    k21: S,
    /// `m0*x0/(J + m0*x0^2 + m0*y0^2)`
    k22: S,
    /// `m0^2*x0*y0/(J + m0*x0^2 + m0*y0^2)`
    k23: S,
    /// `1/(J + m0*x0^2 + m0*y0^2)`
    k24: S,
    /// `1/(m1 + m2)`
    k25: S,
    /// `m + m0 + m1 + m2 - m0^2*y0^2/(J + m0*x0^2 + m0*y0^2)`
    k26: S,
    /// `m + m0 + m1 + m2 - m0^2*x0^2/(J + m0*x0^2 + m0*y0^2)`
    k27: S,
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
    let t1 = p.k6 * s1;
    let t2 = p.m2 * s2;
    let t3 = cos_phi1 * sin_phi2;
    let t4 = sin_phi1 * cos_phi2;
    let t5 = cos_phi1 * cos_phi2 + sin_phi1 * sin_phi2;
    let zero = S::ZERO;
    let m41 = p.k6 * cos_phi1;
    let m42 = p.k6 * sin_phi1;
    let m51 = sin_phi1 * (s1 * p.k19);
    let m52 = cos_phi1 * t1;
    let m55 = s1 * t1;
    let m71 = cos_phi2 * p.m2;
    let m72 = sin_phi2 * p.m2;
    let m74 = p.m2 * t5;
    let m75 = (t3 - t4) * t0;
    let m81 = sin_phi2 * (s2 * p.k20);
    let m82 = cos_phi2 * t2;
    let m84 = t2 * (t4 - t3);
    let m85 = t5 * (t0 * s2);
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
    let t6 = sin_phi2 * s2_dot;
    let t7 = cos_phi2 * t2;
    let t8 = cos_phi2 * s2_dot;
    let t9 = cos_phi1 * s1_dot;
    let t10 = sin_phi1 * t1;
    let t11 = sin_phi2 * t2;
    let t12 = t4 + t5;
    let t13 = t4 * phi1_dot;
    let t14 = t6 * phi2_dot;
    let t15 = t6 + t7;
    let t16 = phi2_dot * t8;
    let t17 = phi1_dot * t9;
    let t18 = t9 - t10;
    let t19 = t8 - t11;
    let t20 = t12 + y_dot;
    let t21 = t18 + x_dot;
    let t22 = t15 + t20;
    let t23 = t13 + (t13 + phi1_dot * t5);
    let t24 = t17 + (t17 - phi1_dot * t10);
    let t25 = t19 + t21;
    let t26 = p.m2 * t22 + p.m1 * t20;
    let t27 = t14 + (t14 + phi2_dot * t7) + t23;
    let t28 = t16 + (t16 - phi2_dot * t11) + t24;
    let t29 = p.m2 * t25 + p.m1 * t21;
    let t30 = t22 * (cos_phi2 * phi2_dot);
    let t31 = t25 * (sin_phi2 * phi2_dot);
    let t32 = t27 * p.m2 + t23 * p.m1;
    let t33 = p.m2 * t28 + p.m1 * t24;
    let t34 = t26 * (cos_phi1 * phi1_dot);
    let t35 = t29 * (sin_phi1 * phi1_dot);
    let t36 = cos_t0 - t3 * sin_t0;
    let t37 = sin_t0 + t3 * cos_t0;
    let t38 = sin_phi2 * (s2_dot * t25 + t2 * t22);
    let t39 = sin_phi1 * (s1_dot * t29 + t1 * t26);
    let t40 = t19 * t22 + t28 * (cos_phi2 * s2) - (t25 * t15 - t27 * (sin_phi2 * s2));
    let t41 = t18 * t26 + t33 * (cos_phi1 * s1) - (t29 * t12 - t32 * (sin_phi1 * s1));
    let h_x = -(p.k11 * t36 + t32);
    let h_y = t33 - p.k11 * t37;
    let h_theta = t36 * p.k13 - t37 * p.k12;
    let h_s1 = t34 + sin_phi1 * t33 - (t35 + cos_phi1 * t32) - (t34 - t35);
    let h_phi1 = t41 - (cos_phi1 * (s1_dot * t26 - t1 * t29) - t39);
    let zero = S::ZERO;
    let h_s2 = p.k20 * (t30 - t31 - (t30 + sin_phi2 * t28 - (t31 + cos_phi2 * t27)));
    let h_phi2 = p.k20 * (cos_phi2 * (s2_dot * t22 - t2 * t25) - t38 - t40);
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
    let t0 = p.yc * theta;
    let t1 = theta_dot * p.xc;
    let t2 = theta * p.xc;
    let t3 = theta_dot * p.yc;
    let t4 = t0 + x;
    let t5 = x - t0;
    let t6 = t1 + y_dot;
    let t7 = y_dot - t1;
    let t8 = t2 + y;
    let t9 = y - t2;
    let t10 = t3 + x_dot;
    let t11 = x_dot - t3;
    let t12 = p.k17 * (t11 - t10) + p.k16 * (t7 - t6);
    let q_x = -((t10 + t11) * p.bx + (t4 + t5) * p.cx);
    let q_y = -((t6 + t7) * p.by + (t8 + t9) * p.cy);
    let q_theta = t12 + (p.k15 * (t5 - t4) + p.k14 * (t9 - t8));
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
    let t3 = theta_dot * p.xc;
    let t4 = theta * p.xc;
    let t5 = theta_dot * p.yc;
    let t6 = p.yc * theta;
    let t7 = p.omega.product_error(t);
    let (sin_t0, cos_t0) = t0.sin_cos();
    let t8 = t3 + y_dot;
    let t9 = y_dot - t3;
    let t10 = t4 + y;
    let t11 = y - t4;
    let t12 = t5 + x_dot;
    let t13 = x_dot - t5;
    let t14 = t6 + x;
    let t15 = x - t6;
    let t16 = p.k15 * (t15 - t14) + p.k14 * (t11 - t10);
    let t17 = sin_phi1 * s1_dot;
    let t18 = cos_phi1 * t1;
    let t19 = sin_phi2 * s2_dot;
    let t20 = cos_phi2 * t2;
    let t21 = cos_phi2 * s2_dot;
    let t22 = cos_phi1 * s1_dot;
    let t23 = sin_phi1 * t1;
    let t24 = sin_phi2 * t2;
    let t25 = t17 + t18;
    let t26 = t17 * phi1_dot;
    let t27 = t19 * phi2_dot;
    let t28 = t19 + t20;
    let t29 = phi2_dot * t21;
    let t30 = phi1_dot * t22;
    let t31 = t22 - t23;
    let t32 = t21 - t24;
    let t33 = y_dot + t25;
    let t34 = x_dot + t31;
    let t35 = t28 + t33;
    let t36 = t26 + (t26 + phi1_dot * t18);
    let t37 = t30 + (t30 - phi1_dot * t23);
    let t38 = t32 + t34;
    let t39 = p.m2 * t35 + p.m1 * t33;
    let t40 = t27 + (t27 + phi2_dot * t20) + t36;
    let t41 = t29 + (t29 - phi2_dot * t24) + t37;
    let t42 = p.m2 * t38 + p.m1 * t34;
    let t43 = t35 * (cos_phi2 * phi2_dot);
    let t44 = t38 * (sin_phi2 * phi2_dot);
    let t45 = t40 * p.m2 + t36 * p.m1;
    let t46 = p.m2 * t41 + p.m1 * t37;
    let t47 = sin_t0 + t7 * cos_t0;
    let t48 = t39 * (cos_phi1 * phi1_dot);
    let t49 = t42 * (sin_phi1 * phi1_dot);
    let t50 = cos_t0 - t7 * sin_t0;
    let t51 = sin_phi2 * (s2_dot * t38 + t2 * t35);
    let t52 = sin_phi1 * (s1_dot * t42 + t1 * t39);
    let t53 = t32 * t35 + t41 * (cos_phi2 * s2) - (t38 * t28 - t40 * (sin_phi2 * s2));
    let t54 = p.k17 * (t13 - t12) + p.k16 * (t9 - t8) + t16;
    let t55 = t31 * t39 + t46 * (cos_phi1 * s1) - (t42 * t25 - t45 * (sin_phi1 * s1));
    let f_x = p.k11 * t50 + t45 - ((t12 + t13) * p.bx + (t14 + t15) * p.cx);
    let f_y = -((t8 + t9) * p.by + (t10 + t11) * p.cy + (t46 - p.k11 * t47));
    let f_theta = t54 - (t50 * p.k13 - t47 * p.k12);
    let f_s1 = t48 - t49 - (t48 + sin_phi1 * t46 - (t49 + cos_phi1 * t45));
    let f_phi1 = cos_phi1 * (s1_dot * t39 - t1 * t42) - t52 - t55;
    let zero = S::ZERO;
    let f_s2 = p.m2 * (t43 - t44 - (t43 + sin_phi2 * t41 - (t44 + cos_phi2 * t40)));
    let f_phi2 = p.m2 * (cos_phi2 * (s2_dot * t35 - t2 * t38) - t51 - t53);
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
        let t1 = n(p.k6) * s1;
        let t2 = s1 * phi1_dot;
        let t3 = s2 * phi2_dot;
        let t4 = theta_dot * n(p.xc);
        let t5 = n(p.xc) * theta;
        let t6 = theta_dot * n(p.yc);
        let t7 = n(p.yc) * theta;
        let t8 = s1 * t1;
        let t9 = n(p.m2) * s2;
        let t10 = y_dot - t4;
        let t11 = t4 + y_dot;
        let t12 = y - t5;
        let t13 = t5 + y;
        let t14 = s1 * n(p.m2);
        let t15 = n(p.omega).product_error(n(t));
        let t16 = t6 + x_dot;
        let t17 = x_dot - t6;
        let t18 = t7 + x;
        let t19 = x - t7;
        let t20 = s2 * t9;
        let t21 = n(p.k15).mul_add(t19 - t18, n(p.k14) * (t12 - t13));
        let t22 = n(p.k6) * cos_phi1;
        let t23 = n(p.k6) * sin_phi1;
        let t24 = sin_phi1 * t1;
        let t25 = sin_phi2 * s2_dot;
        let t26 = sin_phi1 * s1_dot;
        let t27 = cos_phi1 * t2;
        let t28 = cos_phi2 * s2_dot;
        let t29 = n(p.k25) * t22;
        let t30 = n(p.k25) * t23;
        let t31 = cos_phi1.mul_add(cos_phi2, sin_phi1 * sin_phi2);
        let t32 = cos_phi1 * s1_dot;
        let t33 = sin_phi1 * t2;
        let t34 = phi2_dot * t25;
        let t35 = cos_phi2 * t3;
        let t36 = t22 * t29;
        let t37 = t22.neg_mul_add(t30, n(p.k23));
        let t38 = t23.mul_sub(t30, n(p.k27));
        let t39 = n(p.m2) * t31;
        let t40 = phi1_dot * t26;
        let t41 = t26 + t27;
        let t42 = phi2_dot * t28;
        let t43 = sin_phi2 * t3;
        let t44 = phi1_dot * t32;
        let t45 = t32 - t33;
        let t46 = n(p.k25) * t39;
        let t47 = t25 + t35;
        let t48 = N::ONE / (t36 - n(p.k26));
        let t49 = y_dot + t41;
        let t50 = t28 - t43;
        let t51 = x_dot + t45;
        let t52 = cos_phi1 * sin_phi2;
        let t53 = sin_phi1 * cos_phi2;
        let t54 = t22.neg_mul_add(t46, n(p.m2) * cos_phi2);
        let t55 = t40 + phi1_dot.mul_add(t27, t40);
        let t56 = t47 + t49;
        let t57 = t44 + phi1_dot.neg_mul_add(t33, t44);
        let t58 = t50 + t51;
        let t59 = t34 + phi2_dot.mul_add(t35, t34) + t55;
        let t60 = n(p.m2).mul_add(t56, n(p.m1) * t49);
        let t61 = t42 + phi2_dot.neg_mul_add(t43, t42) + t57;
        let t62 = t48 * t37;
        let t63 = t48 * t24;
        let t64 = t48 * t54;
        let t65 = n(p.m2).mul_add(t58, t51 * n(p.m1));
        let t66 = t37 * t62;
        let t67 = t37.neg_mul_add(t63, cos_phi1 * t1);
        let t68 = t9 * (t53 - t52);
        let t69 = t37.mul_add(t64, t23.neg_mul_add(t46, n(p.m2) * sin_phi2));
        let t70 = n(p.m2).mul_add(t59, n(p.m1) * t55);
        let t71 = t15.mul_add(cos_t0, sin_t0);
        let t72 = t60 * (cos_phi1 * phi1_dot);
        let t73 = n(p.m2).mul_add(t61, n(p.m1) * t57);
        let t74 = t65 * (sin_phi1 * phi1_dot);
        let t75 = t56 * (cos_phi2 * phi2_dot);
        let t76 = t58 * (sin_phi2 * phi2_dot);
        let t77 = n(p.k25) * t68;
        let t78 = N::ONE / (t38 - t66);
        let t79 = t15.neg_mul_add(sin_t0, cos_t0);
        let t80 = t22.mul_add(t77, sin_phi2 * t9);
        let t81 = t78 * t67;
        let t82 = t78 * t69;
        let t83 = t67.mul_add(t81, t24.mul_add(t63, t8));
        let t84 = t67.mul_add(t82, t24.neg_mul_add(t64, (t52 - t53) * t14));
        let t85 = t48 * t80;
        let t86 = N::ONE / t83;
        let t87 = t54.mul_add(t64, t39.neg_mul_add(t46, n(p.m2)));
        let t88 = (t16 + t17).mul_add(n(p.bx), (t18 + t19) * n(p.cx));
        let t89 = n(p.k17).mul_add(t17 - t16, n(p.k16) * (t10 - t11)) + t21;
        let t90 = t79.mul_sub(n(p.k13), t71 * n(p.k12)) - t89;
        let t91 = sin_phi1.mul_add(t73, t72) - cos_phi1.mul_add(t70, t74);
        let t92 = t72 - t74 - t91;
        let t93 = sin_phi2.mul_add(t61, t75) - cos_phi2.mul_add(t59, t76);
        let t94 = (t11 + t10).mul_add(n(p.by), (t13 + t12) * n(p.cy));
        let t95 = t37.neg_mul_add(t85, t23.neg_mul_add(t77, cos_phi2 * t9));
        let t96 = sin_phi2 * s2_dot.mul_add(t58, t3 * t56);
        let t97 = t59.neg_mul_add(sin_phi2 * s2, t58 * t47);
        let t98 = t79.mul_add(n(p.k11), t70) - t88;
        let t99 = t94 + t71.neg_mul_add(n(p.k11), t73);
        let t100 = sin_phi1 * s1_dot.mul_add(t65, t2 * t60);
        let t101 = t70.neg_mul_add(sin_phi1 * s1, t65 * t41);
        let t102 = t78 * t95;
        let t103 = cos_phi2.mul_sub(s2_dot.mul_sub(t56, t3 * t58), t96);
        let t104 = t86 * t84;
        let t105 = t29.neg_mul_add(t92, t90.neg_mul_add(n(p.k21), t98));
        let t106 = cos_phi1.mul_sub(s1_dot.mul_sub(t60, t2 * t65), t100);
        let t107 = t67.mul_add(t102, t24.mul_add(t85, t31 * (t14 * s2)));
        let t108 = t103 - (t61.mul_add(cos_phi2 * s2, t50 * t56) - t97);
        let t109 = t84.neg_mul_add(t104, t69.mul_add(t82, t87));
        let t110 = t46.neg_mul_add(t92, n(p.m2) * (t75 - t76 - t93));
        let t111 = t30.mul_add(t92, n(p.k22).neg_mul_add(t90, t99));
        let t112 = t62.neg_mul_add(t105, t111);
        let t113 = t106 - (t73.mul_add(cos_phi1 * s1, t45 * t60) - t101);
        let t114 = t86 * t107;
        let t115 = N::ONE / t109;
        let t116 = t81.neg_mul_add(t112, t63.neg_mul_add(t105, t113));
        let t117 = t69.neg_mul_add(t102, t54.mul_add(t85, t39 * t77));
        let t118 = t84.mul_add(t114, t117);
        let t119 = t85.neg_mul_add(t105, n(p.m2).mul_sub(t108, t77 * t92));
        let t120 = t80.mul_add(t85, t68.neg_mul_add(t77, t20));
        let t121 = t82.neg_mul_add(t112, t64.mul_add(t105, t110));
        let t122 = t104.neg_mul_add(t116, t121);
        let t123 = t115 * t118;
        let t124 = t114.neg_mul_add(t116, t102.neg_mul_add(t112, t119));
        let t125 = t107.neg_mul_add(t114, t95.mul_add(t102, t120));
        let t126 = t118.neg_mul_add(t123, t125);
        let phi2_ddot = t123.mul_add(t122, t124) / t126;
        let s2_ddot = t123.mul_add(phi2_ddot, t115 * t122);
        let t127 = t114.neg_mul_add(phi2_ddot, t86 * t116);
        let phi1_ddot = t104.neg_mul_add(s2_ddot, t127);
        let t128 = t85.mul_add(phi2_ddot, t48 * t105);
        let t129 = t77.neg_mul_add(phi2_ddot, n(p.k25) * t92);
        let t130 = t82.mul_add(s2_ddot, t102.mul_add(phi2_ddot, t78 * t112));
        let y_ddot = t81.mul_add(phi1_ddot, t130);
        let t131 = t63.mul_add(phi1_ddot, t64.neg_mul_add(s2_ddot, t128));
        let t132 = t62 * y_ddot;
        let t133 = t131 - t132;
        let t134 = n(p.k22).mul_add(y_ddot, t90 * n(p.k24));
        let t135 = t30.neg_mul_add(y_ddot, t46.neg_mul_add(s2_ddot, t129));
        let x_ddot = t132 - t131;
        let theta_ddot = -n(p.k21).mul_add(t133, t134);
        let s1_ddot = t29.mul_add(t133, t135);
        let zero = N::ZERO;
        let t136 = n(p.k26) - t36;
        let t137 = t66 - t38;
        let sound = PIVOTS.hold(t136, n(p.k7))
            & PIVOTS.hold(t137, n(p.k7))
            & PIVOTS.hold(t83, t8)
            & PIVOTS.hold(t109, n(p.m2))
            & PIVOTS.hold(t126, t20)
            & theta_ddot.is_finite();
        if !sound {
            let pivots = [
                (0, t136, n(p.k7)),
                (1, t137, n(p.k7)),
                (4, t83, t8),
                (6, t109, n(p.m2)),
                (7, t126, t20),
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
/// T = 1/2*m*der(x)^2 + 1/2*m*der(y)^2 + 1/2*J*der(theta)^2 + 1/2*J1*der(theta1)^2
///     + 1/2*J2*der(theta2)^2 + 1/2*m0*(((der(x) - y0*der(theta)) - e*omega*sin(omega*t))^2 +
///     ((der(y) + x0*der(theta)) + e*omega*cos(omega*t))^2) + 1/2*m1*((der(x) + (cos(phi1)*der(s1)
///     - s1*sin(phi1)*der(phi1)))^2 + (der(y) + (sin(phi1)*der(s1) + s1*cos(phi1)*der(phi1)))^2) +
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
    let t6 = x_dot - theta_dot * p.y0 - p.k0 * (sin_t0 + t3 * cos_t0);
    let t7 = p.k0 * (cos_t0 - t3 * sin_t0) + (y_dot + theta_dot * p.x0);
    let t8 = cos_phi2 * s2_dot - t2 * sin_phi2 + t4;
    let t9 = t2 * cos_phi2 + sin_phi2 * s2_dot + t5;
    let t10 = (y_dot * y_dot + x_dot * x_dot) * p.m + theta_dot * (theta_dot * p.J);
    let t11 = (t5 * t5 + t4 * t4) * p.m1 + theta1_dot * (theta1_dot * p.J1) + t10;
    let t12 = (t9 * t9 + t8 * t8) * p.m2 + theta2_dot * (theta2_dot * p.J2) + t11;
    ((t7 * t7 + t6 * t6) * p.m0 + p.k1 + t12) * S::from_f64(0.5)
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
    (t5 * t5 + t3 * t3) * p.k3 + (t4 * t4 + t2 * t2) * p.k2
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
    (t5 * t5 + t3 * t3) * p.k5 + (t4 * t4 + t2 * t2) * p.k4
}

/// Power `P` that drives, forces and inputs put in, in W.
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
    let t4 = t2 * p.k10;
    let t5 = p.k0 * t2;
    let t6 = p.k0 * t3;
    let t7 = t3 * p.k10;
    let t8 = x_dot - theta_dot * p.y0 - t5;
    let t9 = t6 + (p.x0 * theta_dot + y_dot);
    let t10 = t5 * (x_ddot - theta_ddot * p.y0 - t7) + t7 * t8;
    let t11 = (t4 * t9 - t6 * (theta_ddot * p.x0 + y_ddot - t4) + t10) * p.m0;
    (t2 * t9 + t3 * t8) * p.k11 - t11
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
    machine FrozenCrusher "FrozenCrusher" over S, R;
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
        m, m0, m1, m2, J, J1, J2, x0, y0, omega, cx, cy, bx, by, xc, yc, k0, k1, k2, k3, k4, k5, k6,
        k7, k8, k9, k10, k11, k12, k13, k14, k15, k16, k17, k18, k19, k20, k21, k22, k23, k24, k25,
        k26, k27,
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
