// @generated from machines/motor_crusher.machine by `cargo xtask generate`; edits are lost.

//! A crusher whose debalance is driven by a motor of limited torque: its angle psi is a
//! coordinate. The motor, an induction machine on the foundation, turns it by a cardan shaft, with
//! the torque that M. Kloss gave in 1909 for a slip s = (ω − ψ′)/ω,
//!
//! torque = 2 Mk / (s/sk + sk/s),
//!
//! written below without a division by s: it is greatest, Mk, at the slip sk, and zero at the
//! synchronous speed ω.
//!
//! The faster the debalance turns, the more the dampers of the shaken platform dissipate. In steady
//! motion the mean power of the motor equals the mean power dissipated. With the debalance's
//! axis at
//! the centre of the platform, on springs and dampers that are in total c and b along both axes,
//! the centre moves on a circle of radius X, and speed and torque are constant:
//!
//! torque = b ψ′ X², X = m0 e ψ′² / √((c − (m + m0) ψ′²)² + (b ψ′)²)
//!
//! This load has a peak at resonance, (m + m0) ψ′² ≈ c. A motor too weak to pass it is caught
//! there, and shakes the platform harder instead of turning faster: the Sommerfeld effect (here for
//! Mk below some 165 N·m). With a large Mk the slip vanishes, and the motion is that of
//! `vibrating_crusher.machine`.
//!
//! 10 coordinates, 24 parameters, 4 outputs. Arithmetic of one call:
//!
//! | function | mul | add | div | sin cos | other | temporaries |
//! | --- | --: | --: | --: | --: | --: | --: |
//! | `prepare` | 20 | 8 | 2 | 0 | 0 | 30 |
//! | `mass_matrix` | 36 | 10 | 0 | 4 | 0 | 54 |
//! | `bias` | 54 | 25 | 0 | 4 | 0 | 87 |
//! | `applied` | 17 | 22 | 1 | 0 | 0 | 40 |
//! | `forces` | 71 | 46 | 1 | 4 | 0 | 126 |
//! | `accelerations` | 107 | 63 | 6 | 3 | 0 | 182 |
//! | `kinetic_energy` | 40 | 25 | 0 | 4 | 0 | 73 |
//! | `potential_energy` | 8 | 7 | 0 | 0 | 0 | 15 |
//! | `dissipation` | 8 | 7 | 0 | 0 | 0 | 15 |
//! | `work_rate` | 4 | 2 | 1 | 0 | 0 | 7 |
//! | `dissipation_rate` | 8 | 7 | 0 | 0 | 0 | 15 |
//! | `output_motor_torque` | 3 | 2 | 1 | 0 | 0 | 6 |
//! | `output_motor_power` | 4 | 2 | 1 | 0 | 0 | 7 |
//! | `output_amplitude` | 2 | 1 | 0 | 0 | 1 | 4 |
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

/// A crusher whose debalance is driven by a motor of limited torque: its angle psi is a
/// coordinate. The motor, an induction machine on the foundation, turns it by a cardan shaft, with
/// the torque that M. Kloss gave in 1909 for a slip s = (ω − ψ′)/ω,
///
/// torque = 2 Mk / (s/sk + sk/s),
///
/// written below without a division by s: it is greatest, Mk, at the slip sk, and zero at the
/// synchronous speed ω.
///
/// The faster the debalance turns, the more the dampers of the shaken platform dissipate. In steady
/// motion the mean power of the motor equals the mean power dissipated. With the debalance's
/// axis at
/// the centre of the platform, on springs and dampers that are in total c and b along both axes,
/// the centre moves on a circle of radius X, and speed and torque are constant:
///
/// torque = b ψ′ X², X = m0 e ψ′² / √((c − (m + m0) ψ′²)² + (b ψ′)²)
///
/// This load has a peak at resonance, (m + m0) ψ′² ≈ c. A motor too weak to pass it is caught
/// there, and shakes the platform harder instead of turning faster: the Sommerfeld effect (here for
/// Mk below some 165 N·m). With a large Mk the slip vanishes, and the motion is that of
/// `vibrating_crusher.machine`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MotorCrusher<S = f64> {
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
    /// Synchronous speed of the motor. Unit: `rad/s`. Default: 50*pi.
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
    /// Breakdown torque of the motor. Unit: `N*m`. Default: 400.
    pub Mk: S,
    /// Slip at which it breaks down. Unit: `1`. Default: 0.2.
    pub sk: S,
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

impl<S: ::lagrangian::emitted::Scalar> MotorCrusher<S> {
    /// Computes what depends on the parameters alone, once.
    pub fn prepare(&self) -> Prepared<S> {
        let m0_e = self.m0 * self.e;
        let t0 = S::ONE / self.omega;
        let m0_x0 = self.m0 * self.x0;
        let m0_y0 = self.m0 * self.y0;
        let m1_plus_m2 = self.m1 + self.m2;
        let m_plus_m0 = self.m + self.m0;
        let J0_plus_m0_e_squared = self.J0 + self.e * m0_e;
        let k6 = S::ONE / J0_plus_m0_e_squared;
        let k2 = m0_e * k6;
        let k3 = m0_e * k2;
        let inverse_omega2 = t0 * t0;
        let sk2 = self.sk * self.sk;
        let two_Mk_sk_over_omega = t0 * (S::from_f64(2.0) * (self.sk * self.Mk));
        let half_cx = self.cx * S::from_f64(0.5);
        let half_cy = self.cy * S::from_f64(0.5);
        let half_bx = self.bx * S::from_f64(0.5);
        let half_by = self.by * S::from_f64(0.5);
        let k0 = m1_plus_m2 + m_plus_m0;
        let k1 = self.J + (self.y0 * m0_y0 + self.x0 * m0_x0);
        let minus_m2 = -self.m2;
        let minus_m0_e = -m0_e;
        let k4 = self.e * k2;
        let k5 = k3 * k3;
        let m0_squared = self.m0 * self.m0;
        let pivots = [
            (5, self.J1, self.J1),
            (8, self.J2, self.J2),
            (9, J0_plus_m0_e_squared, J0_plus_m0_e_squared),
            (6, self.m2, self.m2),
            (3, self.m1, m1_plus_m2),
        ];
        Prepared {
            m: self.m,
            m0: self.m0,
            m1: self.m1,
            m2: self.m2,
            J: self.J,
            J0: self.J0,
            J1: self.J1,
            J2: self.J2,
            e: self.e,
            x0: self.x0,
            y0: self.y0,
            omega: self.omega,
            cx: self.cx,
            cy: self.cy,
            bx: self.bx,
            by: self.by,
            xc: self.xc,
            yc: self.yc,
            inverse_omega2,
            sk2,
            two_Mk_sk_over_omega,
            half_cx,
            half_cy,
            half_bx,
            half_by,
            m1_plus_m2,
            m0_e,
            m0_y0,
            m0_x0,
            k0,
            J0_plus_m0_e_squared,
            k1,
            minus_m2,
            minus_m0_e,
            k2,
            k3,
            m_plus_m0,
            k4,
            k5,
            m0_squared,
            k6,
            singular: PIVOTS.vanished(pivots),
        }
    }

    /// The start values of the description, at rest and `t = 0`.
    pub fn start(&self) -> ::lagrangian::emitted::State<Coordinates<S>> {
        let zero = S::ZERO;
        let s1 = S::from_ratio(1, 50);
        let s2 = S::from_ratio(3, 100);
        let q = [
            zero,
            zero,
            zero,
            s1,
            zero,
            zero,
            s2,
            S::from_f64(0.5),
            zero,
            zero,
        ];
        let v = [S::ZERO; 10];
        ::lagrangian::emitted::State {
            t: 0.0,
            q: Coordinates::from_array(q),
            v: Coordinates::from_array(v),
        }
    }
}

/// The coordinates of [`MotorCrusher`], or their rates, by name.
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
    /// Angle of the debalance against the ground. Unit: `rad`.
    pub psi: S,
}

/// What can be observed of a [`MotorCrusher`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outputs<S = f64> {
    /// Speed of the debalance. Unit: `rad/s`.
    pub speed: S,
    /// Torque of the motor. Unit: `N*m`.
    pub motor_torque: S,
    /// Power of the motor. Unit: `W`.
    pub motor_power: S,
    /// Distance of the platform's centre from where it rests. Unit: `m`.
    pub amplitude: S,
}

/// The parameters of a [`MotorCrusher`], with the work done that depends on them alone.
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
    /// `J0`
    J0: S,
    /// `J1`
    J1: S,
    /// `J2`
    J2: S,
    /// `e`
    e: S,
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
    /// `1/omega^2`
    inverse_omega2: S,
    /// `sk^2`
    sk2: S,
    /// `2*Mk*sk/omega`
    two_Mk_sk_over_omega: S,
    /// `0.5*cx`
    half_cx: S,
    /// `0.5*cy`
    half_cy: S,
    /// `0.5*bx`
    half_bx: S,
    /// `0.5*by`
    half_by: S,
    /// `m1 + m2`
    m1_plus_m2: S,
    /// `m0*e`
    m0_e: S,
    /// `m0*y0`
    m0_y0: S,
    /// `m0*x0`
    m0_x0: S,
    /// `m + m0 + m1 + m2`
    k0: S,
    /// `J0 + m0*e^2`
    J0_plus_m0_e_squared: S,
    /// `J + m0*x0^2 + m0*y0^2`
    k1: S,
    /// `-m2`
    minus_m2: S,
    /// `-m0*e`
    minus_m0_e: S,
    /// `m0*e/(J0 + m0*e^2)`
    k2: S,
    /// `m0^2*e^2/(J0 + m0*e^2)`
    k3: S,
    /// `m + m0`
    m_plus_m0: S,
    /// `m0*e^2/(J0 + m0*e^2)`
    k4: S,
    /// `m0^4*e^4/(J0 + m0*e^2)^2`
    k5: S,
    /// `m0^2`
    m0_squared: S,
    /// `1/(J0 + m0*e^2)`
    k6: S,
    /// Why these parameters leave the machine without accelerations, if they do.
    singular: Option<::lagrangian::emitted::Singular>,
}

/// A pivot of an elimination that is not above this share of its diagonal element may be rounding
/// errors alone.
const PIVOTS: ::lagrangian::emitted::Pivots = ::lagrangian::emitted::Pivots::new(10, 10);

/// Mass matrix `M`.
///
/// ```text
/// M[x, x] = m + m0 + m1 + m2
/// M[y, y] = m + m0 + m1 + m2
/// M[theta, x] = -m0*y0*cos(theta) - m0*x0*sin(theta)
/// M[theta, y] = m0*x0*cos(theta) - m0*y0*sin(theta)
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
/// M[psi, x] = -m0*e*sin(psi)
/// M[psi, y] = m0*e*cos(psi)
/// M[psi, theta] = m0*e*x0*cos(psi - theta) + m0*e*y0*sin(psi - theta)
/// M[psi, psi] = m0*e^2 + J0
/// ```
pub fn mass_matrix<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 10],
) -> [[S; 10]; 10] {
    let theta = q[2];
    let s1 = q[3];
    let phi1 = q[4];
    let s2 = q[6];
    let phi2 = q[7];
    let psi = q[9];
    let (sin_theta, cos_theta) = theta.sin_cos();
    let (sin_phi1, cos_phi1) = phi1.sin_cos();
    let (sin_phi2, cos_phi2) = phi2.sin_cos();
    let (sin_psi, cos_psi) = psi.sin_cos();
    let t0 = s1 * p.m2;
    let t1 = s1 * p.m1_plus_m2;
    let t2 = p.m2 * s2;
    let t3 = cos_phi1 * sin_phi2;
    let t4 = sin_phi1 * cos_phi2;
    let t5 = sin_phi1 * sin_phi2 + cos_phi1 * cos_phi2;
    let t6 = sin_psi * (cos_theta * p.y0 + sin_theta * p.x0);
    let zero = S::ZERO;
    let m3_1 = -(cos_theta * p.m0_y0 + sin_theta * p.m0_x0);
    let m3_2 = cos_theta * p.m0_x0 - sin_theta * p.m0_y0;
    let m4_1 = cos_phi1 * p.m1_plus_m2;
    let m4_2 = sin_phi1 * p.m1_plus_m2;
    let m5_1 = -(sin_phi1 * t1);
    let m5_2 = cos_phi1 * t1;
    let m5_5 = s1 * t1;
    let m7_1 = cos_phi2 * p.m2;
    let m7_2 = sin_phi2 * p.m2;
    let m7_4 = p.m2 * t5;
    let m7_5 = t0 * (t3 - t4);
    let m8_1 = sin_phi2 * (s2 * p.minus_m2);
    let m8_2 = cos_phi2 * t2;
    let m8_4 = t2 * (t4 - t3);
    let m8_5 = t0 * s2 * t5;
    let m8_8 = s2 * t2;
    let m10_1 = sin_psi * p.minus_m0_e;
    let m10_2 = cos_psi * p.m0_e;
    let m10_3 = (cos_psi * (cos_theta * p.x0 - sin_theta * p.y0) + t6) * p.m0_e;
    [
        [p.k0, zero, m3_1, m4_1, m5_1, zero, m7_1, m8_1, zero, m10_1],
        [zero, p.k0, m3_2, m4_2, m5_2, zero, m7_2, m8_2, zero, m10_2],
        [m3_1, m3_2, p.k1, zero, zero, zero, zero, zero, zero, m10_3],
        [
            m4_1,
            m4_2,
            zero,
            p.m1_plus_m2,
            zero,
            zero,
            m7_4,
            m8_4,
            zero,
            zero,
        ],
        [m5_1, m5_2, zero, zero, m5_5, zero, m7_5, m8_5, zero, zero],
        [zero, zero, zero, zero, zero, p.J1, zero, zero, zero, zero],
        [m7_1, m7_2, zero, m7_4, m7_5, zero, p.m2, zero, zero, zero],
        [m8_1, m8_2, zero, m8_4, m8_5, zero, zero, m8_8, zero, zero],
        [zero, zero, zero, zero, zero, zero, zero, zero, p.J2, zero],
        [
            m10_1,
            m10_2,
            m10_3,
            zero,
            zero,
            zero,
            zero,
            zero,
            zero,
            p.J0_plus_m0_e_squared,
        ],
    ]
}

/// Bias `h`: velocity products and explicit time in the inertia forces.
///
/// ```text
/// h[x] = m0*y0*sin(theta)*der(theta)^2 - m0*x0*cos(theta)*der(theta)^2
///     - 2*(m1 + m2)*sin(phi1)*der(s1)*der(phi1) - (m1 + m2)*s1*cos(phi1)*der(phi1)^2
///     - 2*m2*sin(phi2)*der(s2)*der(phi2) - m2*s2*cos(phi2)*der(phi2)^2 - m0*e*cos(psi)*der(psi)^2
/// h[y] = 2*(m1 + m2)*cos(phi1)*der(s1)*der(phi1) - m0*y0*cos(theta)*der(theta)^2
///     - m0*x0*sin(theta)*der(theta)^2 - (m1 + m2)*s1*sin(phi1)*der(phi1)^2
///     + 2*m2*cos(phi2)*der(s2)*der(phi2) - m2*s2*sin(phi2)*der(phi2)^2 - m0*e*sin(psi)*der(psi)^2
/// h[theta] = m0*e*y0*cos(psi - theta)*der(psi)^2 - m0*e*x0*sin(psi - theta)*der(psi)^2
/// h[s1] = -(m1 + m2)*s1*der(phi1)^2 - 2*m2*sin(phi2 - phi1)*der(s2)*der(phi2)
///     - m2*s2*cos(phi2 - phi1)*der(phi2)^2
/// h[phi1] = 2*(m1 + m2)*s1*der(s1)*der(phi1) + 2*m2*s1*cos(phi2 - phi1)*der(s2)*der(phi2)
///     - m2*s1*s2*sin(phi2 - phi1)*der(phi2)^2
/// h[s2] = 2*m2*sin(phi2 - phi1)*der(s1)*der(phi1) - m2*s1*cos(phi2 - phi1)*der(phi1)^2
///     - m2*s2*der(phi2)^2
/// h[phi2] = 2*m2*s2*cos(phi2 - phi1)*der(s1)*der(phi1) + m2*s1*s2*sin(phi2 - phi1)*der(phi1)^2
///     + 2*m2*s2*der(s2)*der(phi2)
/// h[psi] = m0*e*x0*sin(psi - theta)*der(theta)^2 - m0*e*y0*cos(psi - theta)*der(theta)^2
/// ```
pub fn bias<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 10],
    v: &[S; 10],
) -> [S; 10] {
    let theta = q[2];
    let s1 = q[3];
    let phi1 = q[4];
    let s2 = q[6];
    let phi2 = q[7];
    let psi = q[9];
    let theta_dot = v[2];
    let s1_dot = v[3];
    let phi1_dot = v[4];
    let s2_dot = v[6];
    let phi2_dot = v[7];
    let psi_dot = v[9];
    let (sin_phi2, cos_phi2) = phi2.sin_cos();
    let (sin_phi1, cos_phi1) = phi1.sin_cos();
    let (sin_theta, cos_theta) = theta.sin_cos();
    let (sin_psi, cos_psi) = psi.sin_cos();
    let t0 = theta_dot * theta_dot;
    let t1 = phi2_dot * phi2_dot;
    let t2 = phi1_dot * phi1_dot;
    let t3 = phi2_dot * (s2_dot * S::from_f64(2.0));
    let t4 = phi1_dot * (S::from_f64(2.0) * s1_dot);
    let t5 = t0 * p.y0;
    let t6 = t0 * p.x0;
    let t7 = psi_dot * (psi_dot * p.e);
    let t8 = sin_phi2 * s2;
    let t9 = sin_phi1 * s1;
    let t10 = cos_phi2 * s2;
    let t11 = cos_phi1 * s1;
    let t12 = t2 * t9 - t4 * cos_phi1;
    let t13 = t4 * sin_phi1 + t2 * t11;
    let t14 = t1 * t8 - t3 * cos_phi2 + t12;
    let t15 = t7 * sin_psi + (sin_theta * t6 + t5 * cos_theta);
    let t16 = t3 * sin_phi2 + t1 * t10 + t13;
    let t17 = t7 * cos_psi + (cos_theta * t6 - t5 * sin_theta);
    let t18 = p.m2 * t14 + p.m1 * t12;
    let t19 = t16 * p.m2 + t13 * p.m1;
    let t20 = cos_theta * (t17 * p.m0_y0 - t15 * p.m0_x0);
    let h_x = -(t17 * p.m0 + t19);
    let h_y = -(p.m0 * t15 + t18);
    let h_theta = sin_theta * (t15 * p.m0_y0 + t17 * p.m0_x0) + t20;
    let h_s1 = -(cos_phi1 * t19 + sin_phi1 * t18);
    let h_phi1 = t19 * t9 - t11 * t18;
    let zero = S::ZERO;
    let h_s2 = p.minus_m2 * (cos_phi2 * t16 + sin_phi2 * t14);
    let h_phi2 = p.minus_m2 * (t10 * t14 - t16 * t8);
    let h_psi = p.minus_m0_e * (cos_psi * t15 - sin_psi * t17);
    [
        h_x, h_y, h_theta, h_s1, h_phi1, zero, h_s2, h_phi2, zero, h_psi,
    ]
}

/// Applied generalized forces `Q`.
///
/// ```text
/// Q[x] = -2*bx*der(x) - 2*cx*x
/// Q[y] = -2*by*der(y) - 2*cy*y
/// Q[theta] = -2*(bx*yc^2 + by*xc^2)*der(theta) - 2*(cx*yc^2 + cy*xc^2)*theta
/// Q[psi] = 2*Mk*sk*(omega - der(psi))/(omega*((omega - der(psi))^2/omega^2 + sk^2))
/// ```
pub fn applied<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 10],
    v: &[S; 10],
) -> [S; 10] {
    let x = q[0];
    let y = q[1];
    let theta = q[2];
    let x_dot = v[0];
    let y_dot = v[1];
    let theta_dot = v[2];
    let psi_dot = v[9];
    let t0 = theta * p.xc;
    let t1 = p.yc * theta;
    let t2 = theta_dot * p.xc;
    let t3 = p.omega - psi_dot;
    let t4 = theta_dot * p.yc;
    let t5 = p.by * (y_dot - t2) + p.cy * (y - t0);
    let t6 = p.by * (t2 + y_dot) + p.cy * (t0 + y);
    let t7 = p.bx * (x_dot - t4) + p.cx * (x - t1);
    let t8 = p.bx * (t4 + x_dot) + p.cx * (t1 + x);
    let q_x = -(t7 + t8);
    let q_y = -(t5 + t6);
    let q_theta = -(p.yc * (t8 - t7) + p.xc * (t6 - t5));
    let zero = S::ZERO;
    let q_psi = t3 * p.two_Mk_sk_over_omega / (t3 * (t3 * p.inverse_omega2) + p.sk2);
    [q_x, q_y, q_theta, zero, zero, zero, zero, zero, zero, q_psi]
}

/// Right-hand side `f = Q - h` of `M a = f`.
pub fn forces<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 10],
    v: &[S; 10],
) -> [S; 10] {
    let x = q[0];
    let y = q[1];
    let theta = q[2];
    let s1 = q[3];
    let phi1 = q[4];
    let s2 = q[6];
    let phi2 = q[7];
    let psi = q[9];
    let x_dot = v[0];
    let y_dot = v[1];
    let theta_dot = v[2];
    let s1_dot = v[3];
    let phi1_dot = v[4];
    let s2_dot = v[6];
    let phi2_dot = v[7];
    let psi_dot = v[9];
    let (sin_phi1, cos_phi1) = phi1.sin_cos();
    let (sin_theta, cos_theta) = theta.sin_cos();
    let (sin_phi2, cos_phi2) = phi2.sin_cos();
    let (sin_psi, cos_psi) = psi.sin_cos();
    let t0 = theta * p.xc;
    let t1 = phi1_dot * s1;
    let t2 = p.yc * theta;
    let t3 = theta_dot * p.xc;
    let t4 = phi2_dot * s2;
    let t5 = S::from_f64(2.0) * s1_dot;
    let t6 = theta_dot * p.yc;
    let t7 = psi_dot * (psi_dot * p.e);
    let t8 = p.omega - psi_dot;
    let t9 = S::from_f64(2.0) * s2_dot;
    let t10 = theta_dot * theta_dot;
    let t11 = p.by * (y_dot - t3) + p.cy * (y - t0);
    let t12 = p.by * (t3 + y_dot) + p.cy * (t0 + y);
    let t13 = p.bx * (x_dot - t6) + p.cx * (x - t2);
    let t14 = p.bx * (t6 + x_dot) + p.cx * (t2 + x);
    let t15 = phi1_dot * (t5 * sin_phi1 + cos_phi1 * t1);
    let t16 = t7 * sin_psi + t10 * (sin_theta * p.x0 + cos_theta * p.y0);
    let t17 = phi1_dot * (sin_phi1 * t1 - t5 * cos_phi1);
    let t18 = t7 * cos_psi + t10 * (cos_theta * p.x0 - sin_theta * p.y0);
    let t19 = phi2_dot * (t9 * sin_phi2 + cos_phi2 * t4) + t15;
    let t20 = phi2_dot * (sin_phi2 * t4 - t9 * cos_phi2) + t17;
    let t21 = t19 * p.m2 + t15 * p.m1;
    let t22 = p.m2 * t20 + p.m1 * t17;
    let t23 = cos_theta * (t18 * p.m0_y0 - t16 * p.m0_x0);
    let t24 = t8 * p.two_Mk_sk_over_omega / (t8 * (t8 * p.inverse_omega2) + p.sk2);
    let t25 = t23 + (p.yc * (t14 - t13) + p.xc * (t12 - t11));
    let f_x = t21 + (t18 * p.m0 - (t13 + t14));
    let f_y = t22 + (p.m0 * t16 - (t11 + t12));
    let f_theta = -(sin_theta * (t16 * p.m0_y0 + t18 * p.m0_x0) + t25);
    let f_s1 = cos_phi1 * t21 + sin_phi1 * t22;
    let f_phi1 = s1 * (cos_phi1 * t22 - sin_phi1 * t21);
    let zero = S::ZERO;
    let f_s2 = p.m2 * (cos_phi2 * t19 + sin_phi2 * t20);
    let f_phi2 = (cos_phi2 * t20 - sin_phi2 * t19) * (s2 * p.m2);
    let f_psi = (cos_psi * t16 - sin_psi * t18) * p.m0_e + t24;
    [
        f_x, f_y, f_theta, f_s1, f_phi1, zero, f_s2, f_phi2, zero, f_psi,
    ]
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
        q: &'a [S; 10],
        v: &'a [S; 10],
    }) -> Result<[S; 10], ::lagrangian::emitted::Singular> = accelerations_in;
}

#[inline(always)]
fn accelerations_in<S: Copy, N: ::lagrangian::emitted::Scalar<Stored = S>>(
    call: Accelerations<'_, S>,
) -> Result<[S; 10], ::lagrangian::emitted::Singular> {
    let Accelerations { p, q, v } = call;
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
    let psi = n(q[9]);
    let x_dot = n(v[0]);
    let y_dot = n(v[1]);
    let theta_dot = n(v[2]);
    let s1_dot = n(v[3]);
    let phi1_dot = n(v[4]);
    let s2_dot = n(v[6]);
    let phi2_dot = n(v[7]);
    let psi_dot = n(v[9]);
    let angles = [theta, psi, phi1];
    let circular = N::sin_cos_all(angles);
    let (sin_theta, cos_theta) = circular[0];
    let (sin_psi, cos_psi) = circular[1];
    let (sin_phi1, cos_phi1) = circular[2];
    let t0 = n(p.omega) - psi_dot;
    let t1 = theta * n(p.xc);
    let t2 = theta * n(p.yc);
    let t3 = theta_dot * n(p.xc);
    let t4 = theta_dot * n(p.yc);
    let t5 = theta_dot * theta_dot;
    let t6 = psi_dot * (psi_dot * n(p.e));
    let t7 = t0.mul_add(t0 * n(p.inverse_omega2), n(p.sk2));
    let t8 = n(p.by).mul_add(y_dot - t3, n(p.cy) * (y - t1));
    let t9 = n(p.by).mul_add(t3 + y_dot, n(p.cy) * (t1 + y));
    let t10 = n(p.bx).mul_add(x_dot - t4, n(p.cx) * (x - t2));
    let t11 = n(p.bx).mul_add(t4 + x_dot, n(p.cx) * (t2 + x));
    let t12 = s1 * s1;
    let t13 = n(p.yc).mul_add(t10, n(p.xc) * t8);
    let t14 = s2 * (s2 * n(p.m2));
    let t15 = cos_theta * n(p.x0);
    let t16 = sin_theta * n(p.y0);
    let t17 = sin_theta * n(p.x0);
    let t18 = cos_theta * n(p.y0);
    let t19 = sin_psi * cos_psi;
    let t20 = t15 - t16;
    // Eliminates y: inertia d[y].
    let t21 = cos_psi.neg_mul_add(cos_psi * n(p.k3), n(p.m_plus_m0));
    let t22 = cos_psi * n(p.m0_e);
    let t23 = t17 + t18;
    let t24 = t19 * n(p.k3);
    let t25 = t20 * n(p.m0);
    let t26 = N::ONE / t21;
    let t27 = t23 * n(p.m0);
    let t28 = sin_psi * n(p.m0_e);
    let t29 = sin_psi.mul_add(t23, cos_psi * t20);
    let t30 = t17.mul_add(t5, t18.mul_add(t5, sin_psi * t6));
    let t31 = t16.neg_mul_add(t5, t15.mul_add(t5, cos_psi * t6));
    let t32 = n(p.k4) * t29;
    let t33 = cos_psi.neg_mul_add(t32, t20);
    let t34 = t23.mul_add(t27, t20.mul_add(t25, n(p.J)));
    let t35 = t22.mul_add(t30, t0 * n(p.two_Mk_sk_over_omega) / t7);
    let t36 = t28.neg_mul_add(t31, t35);
    let t37 = sin_psi.neg_mul_add(sin_psi * n(p.k3), n(p.m_plus_m0));
    // Eliminates x: inertia d[x].
    let t38 = t26.neg_mul_add(t19 * (t19 * n(p.k5)), t37);
    let t39 = t27.mul_add(t31, n(p.yc).mul_add(t11, n(p.xc) * t9) - t13);
    let t40 = t26 * t33;
    let t41 = n(p.k2) * t36;
    let t42 = N::ONE / t38;
    let t43 = t40.mul_add(t24, sin_psi.neg_mul_add(t32, t23));
    let t44 = t29.neg_mul_add(n(p.k3) * t29, t34);
    let t45 = n(p.m0).neg_mul_add(t31, t10 + t11);
    let t46 = cos_psi.mul_add(t41, n(p.m0).neg_mul_add(t30, t8 + t9));
    let t47 = t43 * n(p.m0);
    let t48 = t46.neg_mul_add(t26 * t24, sin_psi.neg_mul_add(t41, t45));
    let t49 = t29.mul_add(t41, t25.neg_mul_add(t30, t39));
    let t50 = t40.neg_mul_add(t33 * n(p.m0_squared), t44);
    // Eliminates theta: inertia d[theta].
    let t51 = t42.neg_mul_add(t43 * (t43 * n(p.m0_squared)), t50);
    let t52 = t46.neg_mul_add(t40 * n(p.m0), t49);
    let t53 = N::ONE / t51 * t48.mul_add(t42 * t47, t52);
    // Back substitution: a[x].
    let t54 = t42 * t47.mul_add(t53, t48);
    let t55 = phi1_dot * (N::from_f64(2.0) * s1_dot);
    let t56 = t24.neg_mul_add(t54, t53.neg_mul_add(t33 * n(p.m0), t46));
    // Back substitution: a[y].
    let t57 = t26 * t56;
    let t58 = t28.neg_mul_add(t54, t53.mul_add(t29 * n(p.m0_e), t36));
    // Eliminates s1: alone z[s1].
    let t59 = t54.mul_add(cos_phi1, phi1_dot * (phi1_dot * s1));
    // Back substitution: a[phi1].
    let t60 = t57.neg_mul_add(cos_phi1, t54.mul_add(sin_phi1, t55)) / s1;
    let x_ddot = -t54;
    let y_ddot = -t57;
    let theta_ddot = -t53;
    // Back substitution: a[s1].
    let s1_ddot = t57.mul_add(sin_phi1, t59);
    let phi1_ddot = -t60;
    let zero = N::ZERO;
    // Eliminates s2: alone z[s2]; Back substitution: a[s2].
    let s2_ddot = phi2_dot * (phi2_dot * s2);
    let phi2_ddot = phi2_dot * (N::from_f64(-2.0) * s2_dot) / s2;
    // Back substitution: a[psi].
    let psi_ddot = n(p.k6) * t22.mul_add(t57, t58);
    let t61 = t12 * n(p.m1);
    let t62 = t12 * n(p.m1_plus_m2);
    let sound = PIVOTS.hold(t14, t14)
        & PIVOTS.hold(t61, t62)
        & PIVOTS.hold(t21, n(p.k0))
        & PIVOTS.hold(t38, n(p.k0))
        & PIVOTS.hold(t51, n(p.k1))
        & phi1_ddot.is_finite();
    if !sound {
        let pivots = [
            (7, t14, t14),
            (4, t61, t62),
            (1, t21, n(p.k0)),
            (0, t38, n(p.k0)),
            (2, t51, n(p.k1)),
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
        psi_ddot.store(),
    ];
    Ok(accelerations)
}

/// Kinetic energy `T`, in J.
///
/// ```text
/// T = 1/2*m*der(x)^2 + 1/2*m*der(y)^2 + 1/2*J*der(theta)^2 + 1/2*J1*der(theta1)^2
///     + 1/2*J2*der(theta2)^2 + 1/2*J0*der(psi)^2 + 1/2*m0*(((der(x) - y0*cos(theta)*der(theta) -
///     x0*sin(theta)*der(theta)) - e*sin(psi)*der(psi))^2 + (e*cos(psi)*der(psi) + (der(y) +
///     x0*cos(theta)*der(theta) - y0*sin(theta)*der(theta)))^2) + 1/2*m1*((der(x) +
///     (cos(phi1)*der(s1) - s1*sin(phi1)*der(phi1)))^2 + (der(y) + (sin(phi1)*der(s1) +
///     s1*cos(phi1)*der(phi1)))^2) + 1/2*m2*(((der(x) + (cos(phi1)*der(s1) -
///     s1*sin(phi1)*der(phi1))) + (cos(phi2)*der(s2) - s2*sin(phi2)*der(phi2)))^2 + ((der(y) +
///     (sin(phi1)*der(s1) + s1*cos(phi1)*der(phi1))) + (sin(phi2)*der(s2) +
///     s2*cos(phi2)*der(phi2)))^2)
/// ```
pub fn kinetic_energy<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 10],
    v: &[S; 10],
) -> S {
    let theta = q[2];
    let s1 = q[3];
    let phi1 = q[4];
    let s2 = q[6];
    let phi2 = q[7];
    let psi = q[9];
    let x_dot = v[0];
    let y_dot = v[1];
    let theta_dot = v[2];
    let s1_dot = v[3];
    let phi1_dot = v[4];
    let theta1_dot = v[5];
    let s2_dot = v[6];
    let phi2_dot = v[7];
    let theta2_dot = v[8];
    let psi_dot = v[9];
    let (sin_phi1, cos_phi1) = phi1.sin_cos();
    let (sin_phi2, cos_phi2) = phi2.sin_cos();
    let (sin_theta, cos_theta) = theta.sin_cos();
    let (sin_psi, cos_psi) = psi.sin_cos();
    let t0 = phi1_dot * s1;
    let t1 = phi2_dot * s2;
    let t2 = theta_dot * p.x0;
    let t3 = theta_dot * p.y0;
    let t4 = psi_dot * p.e;
    let t5 = x_dot + (cos_phi1 * s1_dot - t0 * sin_phi1);
    let t6 = y_dot + (t0 * cos_phi1 + sin_phi1 * s1_dot);
    let t7 = x_dot - t2 * sin_theta - cos_theta * t3 - t4 * sin_psi;
    let t8 = t4 * cos_psi + (y_dot + t2 * cos_theta - sin_theta * t3);
    let t9 = cos_phi2 * s2_dot - t1 * sin_phi2 + t5;
    let t10 = t1 * cos_phi2 + sin_phi2 * s2_dot + t6;
    let t11 = (y_dot * y_dot + x_dot * x_dot) * p.m + theta_dot * (theta_dot * p.J);
    let t12 = (t10 * t10 + t9 * t9) * p.m2 + theta2_dot * (theta2_dot * p.J2);
    let t13 = (t6 * t6 + t5 * t5) * p.m1 + theta1_dot * (theta1_dot * p.J1) + t11;
    let t14 = t13 + (t12 + ((t8 * t8 + t7 * t7) * p.m0 + psi_dot * (psi_dot * p.J0)));
    t14 * S::from_f64(0.5)
}

/// Potential energy `V`, in J.
///
/// ```text
/// V = cx*x^2 + cy*y^2 + (cx*yc^2 + cy*xc^2)*theta^2
/// ```
pub fn potential_energy<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 10]) -> S {
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
pub fn dissipation<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, v: &[S; 10]) -> S {
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
/// P = 2*Mk*sk*der(psi)*(omega - der(psi))/(omega*((omega - der(psi))^2/omega^2 + sk^2))
/// ```
pub fn work_rate<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, v: &[S; 10]) -> S {
    let psi_dot = v[9];
    let t0 = p.omega - psi_dot;
    let t1 = t0 * (psi_dot * p.two_Mk_sk_over_omega);
    t1 / (t0 * (t0 * p.inverse_omega2) + p.sk2)
}

/// Power `R` dissipated by dampers, in W.
///
/// ```text
/// R = 2*bx*der(x)^2 + 2*by*der(y)^2 + 2*(bx*yc^2 + by*xc^2)*der(theta)^2
/// ```
pub fn dissipation_rate<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, v: &[S; 10]) -> S {
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

/// Speed of the debalance. Unit: `rad/s`.
///
/// ```text
/// speed = der(psi)
/// ```
pub fn output_speed<S: ::lagrangian::emitted::Scalar>(v: &[S; 10]) -> S {
    let psi_dot = v[9];
    psi_dot
}

/// Torque of the motor. Unit: `N*m`.
///
/// ```text
/// motor_torque = 2*Mk*sk*(omega - der(psi))/(omega*((omega - der(psi))^2/omega^2 + sk^2))
/// ```
pub fn output_motor_torque<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, v: &[S; 10]) -> S {
    let psi_dot = v[9];
    let t0 = p.omega - psi_dot;
    t0 * p.two_Mk_sk_over_omega / (t0 * (t0 * p.inverse_omega2) + p.sk2)
}

/// Power of the motor. Unit: `W`.
///
/// ```text
/// motor_power = 2*Mk*sk*der(psi)*(omega - der(psi))/(omega*((omega - der(psi))^2/omega^2 + sk^2))
/// ```
pub fn output_motor_power<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, v: &[S; 10]) -> S {
    let psi_dot = v[9];
    let t0 = p.omega - psi_dot;
    let t1 = t0 * (psi_dot * p.two_Mk_sk_over_omega);
    t1 / (t0 * (t0 * p.inverse_omega2) + p.sk2)
}

/// Distance of the platform's centre from where it rests. Unit: `m`.
///
/// ```text
/// amplitude = sqrt(x^2 + y^2)
/// ```
pub fn output_amplitude<S: ::lagrangian::emitted::Scalar>(q: &[S; 10]) -> S {
    let x = q[0];
    let y = q[1];
    (y * y + x * x).sqrt()
}

/// By how much `s1 > 0` holds.
pub fn assumption_0<S: ::lagrangian::emitted::Scalar>(q: &[S; 10]) -> S {
    let s1 = q[3];
    s1
}

/// By how much `s2 > 0` holds.
pub fn assumption_1<S: ::lagrangian::emitted::Scalar>(q: &[S; 10]) -> S {
    let s2 = q[6];
    s2
}

/// Everything that the description asks to observe.
pub fn outputs<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 10],
    v: &[S; 10],
) -> Outputs<S> {
    Outputs {
        speed: output_speed(v),
        motor_torque: output_motor_torque(p, v),
        motor_power: output_motor_power(p, v),
        amplitude: output_amplitude(q),
    }
}

::lagrangian::emitted::implement! {
    machine MotorCrusher "MotorCrusher" over S, R;
    parameters {
        m, m0, m1, m2, J, J0, J1, J2, e, x0, y0, omega, cx, cy, bx, by, xc, yc, Mk, sk, R, r1, rho,
        r2,
    } [
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
        Mk: "Mk" "N*m" = 400.0;
        sk: "sk" "1" = 0.2;
        R: "R" "m" = 0.27;
        r1: "r1" "m" = 0.25;
        rho: "rho" "m" = 0.2;
        r2: "r2" "m" = 0.17;
    ]
    coordinates 10 Coordinates { x, y, theta, s1, phi1, theta1, s2, phi2, theta2, psi } [
        x: "x" "m";
        y: "y" "m";
        theta: "theta" "rad";
        s1: "s1" "m";
        phi1: "phi1" "rad";
        theta1: "theta1" "rad";
        s2: "s2" "m";
        phi2: "phi2" "rad";
        theta2: "theta2" "rad";
        psi: "psi" "rad";
    ]
    inputs Inputs {} [], defined here
    outputs Outputs { speed, motor_torque, motor_power, amplitude } [
        speed: "speed" "rad/s";
        motor_torque: "motor_torque" "N*m";
        motor_power: "motor_power" "W";
        amplitude: "amplitude" "m";
    ]
    prepared Prepared {
        m, m0, m1, m2, J, J0, J1, J2, e, x0, y0, omega, cx, cy, bx, by, xc, yc, inverse_omega2, sk2,
        two_Mk_sk_over_omega, half_cx, half_cy, half_bx, half_by, m1_plus_m2, m0_e, m0_y0, m0_x0,
        k0, J0_plus_m0_e_squared, k1, minus_m2, minus_m0_e, k2, k3, m_plus_m0, k4, k5, m0_squared,
        k6,
    }
    singular singular
    accelerations { (p, t, q, v, u) Accelerations { p, q, v } }
    system {
        matrix mass_matrix(p, t, q) = mass_matrix(p, q);
        vector bias(p, t, q, v) = bias(p, q, v);
        vector applied(p, t, q, v, u) = applied(p, q, v);
        vector forces(p, t, q, v, u) = forces(p, q, v);
        number kinetic_energy(p, t, q, v) = kinetic_energy(p, q, v);
        number potential_energy(p, t, q, u) = potential_energy(p, q);
        number dissipation(p, t, q, v, u) = dissipation(p, v);
        number work_rate(p, t, q, v, a, u) = work_rate(p, v);
        number dissipation_rate(p, t, q, v, u) = dissipation_rate(p, v);
        outputs outputs(p, t, q, v, a, u) = outputs(p, q, v);
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
