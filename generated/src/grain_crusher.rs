// @generated from machines/grain_crusher.machine by `cargo xtask generate`; edits are lost.

//! The crush process with grains that roll on mortar and pestle both, as rollers of diameter delta
//! without mass: the pestle turns the other way than on a bed, by the relation of R. Willis. The
//! multiplier of `grain` is the friction on the pestle, and on the mortar, along the
//! same direction.
//!
//! 9 coordinates, 25 parameters, 1 output. Arithmetic of one call:
//!
//! | function | mul | add | div | sin cos | other | temporaries |
//! | --- | --: | --: | --: | --: | --: | --: |
//! | `prepare` | 52 | 20 | 10 | 0 | 0 | 82 |
//! | `start` | 4 | 6 | 2 | 0 | 0 | 12 |
//! | `mass_matrix` | 27 | 7 | 0 | 3 | 0 | 40 |
//! | `bias` | 53 | 26 | 0 | 4 | 0 | 87 |
//! | `applied` | 14 | 20 | 0 | 0 | 0 | 34 |
//! | `forces` | 67 | 44 | 0 | 4 | 0 | 119 |
//! | `constraint_positions` | 0 | 2 | 0 | 0 | 0 | 2 |
//! | `constraint_rates` | 5 | 7 | 0 | 0 | 0 | 12 |
//! | `constraint_bias` | 1 | 1 | 0 | 0 | 0 | 2 |
//! | `accelerations` | 116 | 79 | 3 | 4 | 0 | 206 |
//! | `multipliers` | 192 | 121 | 6 | 4 | 0 | 327 |
//! | `kinetic_energy` | 41 | 27 | 0 | 4 | 0 | 76 |
//! | `potential_energy` | 8 | 7 | 0 | 0 | 0 | 15 |
//! | `dissipation` | 8 | 7 | 0 | 0 | 0 | 15 |
//! | `work_rate` | 18 | 11 | 0 | 2 | 0 | 33 |
//! | `dissipation_rate` | 8 | 7 | 0 | 0 | 0 | 15 |
//! | `output_grain_spin` | 1 | 2 | 0 | 0 | 0 | 3 |
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

/// The crush process with grains that roll on mortar and pestle both, as rollers of diameter delta
/// without mass: the pestle turns the other way than on a bed, by the relation of R. Willis. The
/// multiplier of `grain` is the friction on the pestle, and on the mortar, along the
/// same direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GrainCrusher<S = f64> {
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
    /// Radius of the platform's cylinder. Unit: `m`. Default: 0.27.
    pub R: S,
    /// Radii of the mortar, outside and inside. Unit: `m`. Default: 0.25.
    pub r1: S,
    /// `rho`. Unit: `m`. Default: 0.2.
    pub rho: S,
    /// Radius of the pestle. Unit: `m`. Default: 0.16.
    pub r2: S,
    /// Thickness of the bed. Unit: `m`. Default: 0.01.
    pub delta: S,
    /// Rates at which mortar and pestle go about when the run starts. Unit: `rad/s`. Default: 40.
    pub whirl1: S,
    /// `whirl2`. Unit: `rad/s`. Default: 25.
    pub whirl2: S,
}

impl<S: ::lagrangian::emitted::Scalar> GrainCrusher<S> {
    /// Computes what depends on the parameters alone, once.
    pub fn prepare(&self) -> Prepared<S> {
        let R_minus_r1 = self.R - self.r1;
        let rho_minus_r2_minus_delta = self.rho - self.r2 - self.delta;
        let t0 = self.rho + self.r2;
        let e_omega = self.omega * self.e;
        let m1_plus_m2 = self.m1 + self.m2;
        let m0_y0 = self.m0 * self.y0;
        let m0_x0 = self.m0 * self.x0;
        let m_plus_m0 = self.m + self.m0;
        let k0 = m1_plus_m2 + m_plus_m0;
        let k1 = self.J + (self.y0 * m0_y0 + self.x0 * m0_x0);
        let k7 = S::ONE / m_plus_m0;
        let k4 = k1 - k7 * (m0_y0 * m0_y0) - k7 * (m0_x0 * m0_x0);
        let k5 = S::ONE / k4;
        let pivot_10 = self.r2 * self.r2;
        let t1 = S::ONE / self.J1;
        let t2 = self.rho * t1;
        let pivot_12 = self.r1 * self.r1;
        let t3 = S::ONE / self.r2;
        let rho_over_r2 = self.rho * t3;
        let k11 = t0 * t3;
        let t4 = S::ONE / self.r1;
        let R_over_r1 = self.R * t4;
        let k12 = R_minus_r1 * t4;
        let k14 = self.m2 * rho_minus_r2_minus_delta;
        let k15 = R_minus_r1 * m1_plus_m2;
        let t5 = self.J2 * rho_over_r2;
        let t6 = rho_over_r2 * t5;
        let t7 = R_over_r1 * t6 + self.J1 * R_over_r1;
        let t8 = k11 * t5;
        let two_rho_over_delta = self.rho * S::from_f64(2.0) / self.delta;
        let J0_omega2 = self.omega * (self.omega * self.J0);
        let half_cx = self.cx * S::from_f64(0.5);
        let half_cy = self.cy * S::from_f64(0.5);
        let half_bx = self.bx * S::from_f64(0.5);
        let half_by = self.by * S::from_f64(0.5);
        let e_omega2 = self.omega * e_omega;
        let m0_e_omega = self.m0 * e_omega;
        let minus_m2 = -self.m2;
        let k2 = -t0;
        let minus_R = -self.R;
        let k3 = self.m0 * k7;
        let k6 = self.m0 * k5;
        let inverse_m2 = S::ONE / self.m2;
        let inverse_m1 = S::ONE / self.m1;
        let k8 = pivot_10 / self.J2 + self.rho * t2;
        let k9 = t0 * S::from_f64(2.0);
        let r1_rho_over_J1 = self.r1 * t2;
        let r1_squared_over_J1 = t1 * pivot_12;
        let k10 = self.R * k5;
        let k13 = self.m1 * R_minus_r1;
        let k16 = k12 * t7;
        let k17 = R_over_r1 * t8;
        let k18 = k12 * t8;
        let k19 = R_minus_r1 * k14;
        let k20 = R_minus_r1 * k15 + k12 * (k12 * t6 + self.J1 * k12);
        let k21 = rho_minus_r2_minus_delta * k14 + k11 * (self.J2 * k11);
        let k22 = k1 + R_over_r1 * t7;
        let k23 = S::ONE / k0;
        let one = S::ONE;
        let pivots = [
            (0, k0, k0),
            (1, k0, k0),
            (9, one, one),
            (10, pivot_10, pivot_10),
            (11, one, one),
            (12, pivot_12, pivot_12),
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
            r1: self.r1,
            rho: self.rho,
            r2: self.r2,
            R_minus_r1,
            rho_minus_r2_minus_delta,
            two_rho_over_delta,
            e_omega,
            J0_omega2,
            half_cx,
            half_cy,
            half_bx,
            half_by,
            e_omega2,
            m1_plus_m2,
            m0_y0,
            m0_x0,
            k0,
            m0_e_omega,
            k1,
            minus_m2,
            k2,
            minus_R,
            m_plus_m0,
            k3,
            k4,
            k5,
            k6,
            k7,
            inverse_m2,
            inverse_m1,
            k8,
            k9,
            r1_rho_over_J1,
            r1_squared_over_J1,
            k10,
            rho_over_r2,
            k11,
            R_over_r1,
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
            singular: PIVOTS.vanished(pivots),
        }
    }

    /// The start values of the description, at `t = 0`.
    pub fn start(&self) -> ::lagrangian::emitted::State<Coordinates<S>> {
        let s1 = self.R - self.r1;
        let t0 = s1 * self.whirl1 * (S::ONE / self.r1);
        let zero = S::ZERO;
        let phi1 = S::from_ratio(3, 10);
        let s2 = self.rho - self.r2 - self.delta;
        let theta1_rate = -t0;
        let theta2_rate = (self.rho * t0 + self.whirl2 * (self.r2 + self.rho)) / self.r2;
        let q = [
            zero,
            zero,
            zero,
            s1,
            phi1,
            zero,
            s2,
            S::from_f64(-0.5),
            zero,
        ];
        let v = [
            zero,
            zero,
            zero,
            zero,
            self.whirl1,
            theta1_rate,
            zero,
            self.whirl2,
            theta2_rate,
        ];
        ::lagrangian::emitted::State {
            t: 0.0,
            q: Coordinates::from_array(q),
            v: Coordinates::from_array(v),
        }
    }
}

/// The coordinates of [`GrainCrusher`], or their rates, by name.
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

/// What can be observed of a [`GrainCrusher`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outputs<S = f64> {
    /// Spin of a grain. Unit: `rad/s`.
    pub grain_spin: S,
}

/// The parameters of a [`GrainCrusher`], with the work done that depends on them alone.
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
    /// `r1`
    r1: S,
    /// `rho`
    rho: S,
    /// `r2`
    r2: S,
    /// `R - r1`
    R_minus_r1: S,
    /// `rho - r2 - delta`
    rho_minus_r2_minus_delta: S,
    /// `2*rho/delta`
    two_rho_over_delta: S,
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
    /// `m0*y0`
    m0_y0: S,
    /// `m0*x0`
    m0_x0: S,
    /// `m + m0 + m1 + m2`
    k0: S,
    /// `m0*e*omega`
    m0_e_omega: S,
    /// `J + m0*x0^2 + m0*y0^2`
    k1: S,
    /// `-m2`
    minus_m2: S,
    /// `-(rho + r2)`
    k2: S,
    /// `-R`
    minus_R: S,
    /// `m + m0`
    m_plus_m0: S,
    /// `m0/(m + m0)`
    k3: S,
    /// `J + m0*x0^2 + m0*y0^2 - m0^2*y0^2/(m + m0) - m0^2*x0^2/(m + m0)`
    k4: S,
    /// `1/(J + m0*x0^2 + m0*y0^2 - m0^2*y0^2/(m + m0) - m0^2*x0^2/(m + m0))`
    k5: S,
    /// `m0/(J + m0*x0^2 + m0*y0^2 - m0^2*y0^2/(m + m0) - m0^2*x0^2/(m + m0))`
    k6: S,
    /// `1/(m + m0)`
    k7: S,
    /// `1/m2`
    inverse_m2: S,
    /// `1/m1`
    inverse_m1: S,
    /// `rho^2/J1 + r2^2/J2`
    k8: S,
    /// `2*(rho + r2)`
    k9: S,
    /// `r1*rho/J1`
    r1_rho_over_J1: S,
    /// `r1^2/J1`
    r1_squared_over_J1: S,
    /// `R/(J + m0*x0^2 + m0*y0^2 - m0^2*y0^2/(m + m0) - m0^2*x0^2/(m + m0))`
    k10: S,
    /// `rho/r2`
    rho_over_r2: S,
    /// `(rho + r2)/r2`
    k11: S,
    /// `R/r1`
    R_over_r1: S,
    /// `(R - r1)/r1`
    k12: S,
    /// `m1*(R - r1)`
    k13: S,
    /// `m2*(rho - r2 - delta)`
    k14: S,
    /// `(R - r1)*(m1 + m2)`
    k15: S,
    /// `(R - r1)*(J1*R/r1 + J2*R*rho^2/r1/r2^2)/r1`
    k16: S,
    /// `J2*R*rho*(rho + r2)/r1/r2^2`
    k17: S,
    /// `J2*rho*(R - r1)*(rho + r2)/r1/r2^2`
    k18: S,
    /// `m2*(R - r1)*(rho - r2 - delta)`
    k19: S,
    /// `(R - r1)*(J1*(R - r1)/r1 + J2*rho^2*(R - r1)/r1/r2^2)/r1 + (R - r1)^2*(m1 + m2)`
    k20: S,
    /// `J2*(rho + r2)^2/r2^2 + m2*(rho - r2 - delta)^2`
    k21: S,
    /// `J + m0*x0^2 + m0*y0^2 + R*(J1*R/r1 + J2*R*rho^2/r1/r2^2)/r1`
    k22: S,
    /// `1/(m + m0 + m1 + m2)`
    k23: S,
    /// Why these parameters leave the machine without accelerations, if they do.
    singular: Option<::lagrangian::emitted::Singular>,
}

/// A pivot of an elimination that is not above this share of its diagonal element may be rounding
/// errors alone.
const PIVOTS: ::lagrangian::emitted::Pivots = ::lagrangian::emitted::Pivots::new(9, 13);

/// A pivot of an elimination that is not above this share of its diagonal element may be rounding
/// errors alone.
const PIVOTS_1: ::lagrangian::emitted::Pivots = ::lagrangian::emitted::Pivots::new(9, 9);

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
/// h[x] = m0*y0*sin(theta)*der(theta)^2 - m0*x0*cos(theta)*der(theta)^2
///     - 2*(m1 + m2)*sin(phi1)*der(s1)*der(phi1) - (m1 + m2)*s1*cos(phi1)*der(phi1)^2
///     - 2*m2*sin(phi2)*der(s2)*der(phi2) - m2*s2*cos(phi2)*der(phi2)^2 - m0*e*omega^2*cos(omega*t)
/// h[y] = 2*(m1 + m2)*cos(phi1)*der(s1)*der(phi1) - m0*y0*cos(theta)*der(theta)^2
///     - m0*x0*sin(theta)*der(theta)^2 - (m1 + m2)*s1*sin(phi1)*der(phi1)^2
///     + 2*m2*cos(phi2)*der(s2)*der(phi2) - m2*s2*sin(phi2)*der(phi2)^2 - m0*e*omega^2*sin(omega*t)
/// h[theta] = m0*e*y0*omega^2*cos(omega*t - theta) - m0*e*x0*omega^2*sin(omega*t - theta)
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
    let (sin_theta, cos_theta) = theta.sin_cos();
    let (sin_phi2, cos_phi2) = phi2.sin_cos();
    let (sin_phi1, cos_phi1) = phi1.sin_cos();
    let t1 = theta_dot * theta_dot;
    let (sin_t0, cos_t0) = t0.sin_cos();
    let t2 = p.omega.product_error(t);
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
    let t15 = p.e_omega2 * (sin_t0 + t2 * cos_t0) + (sin_theta * t5 + t4 * cos_theta);
    let t16 = t3 * t9 - t7 * cos_phi2 + t13;
    let t17 = p.e_omega2 * (cos_t0 - t2 * sin_t0) + (cos_theta * t5 - t4 * sin_theta);
    let t18 = t7 * sin_phi2 + t3 * t11 + t14;
    let t19 = p.m2 * t16 + p.m1 * t13;
    let t20 = t18 * p.m2 + t14 * p.m1;
    let t21 = cos_theta * (t17 * p.m0_y0 - t15 * p.m0_x0);
    let h_x = -(t17 * p.m0 + t20);
    let h_y = -(p.m0 * t15 + t19);
    let h_theta = sin_theta * (t15 * p.m0_y0 + t17 * p.m0_x0) + t21;
    let h_s1 = -(cos_phi1 * t20 + sin_phi1 * t19);
    let h_phi1 = t20 * t10 - t12 * t19;
    let zero = S::ZERO;
    let h_s2 = p.minus_m2 * (cos_phi2 * t18 + sin_phi2 * t16);
    let h_phi2 = p.minus_m2 * (t11 * t16 - t18 * t9);
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
    let (sin_phi2, cos_phi2) = phi2.sin_cos();
    let (sin_phi1, cos_phi1) = phi1.sin_cos();
    let t1 = theta_dot * theta_dot;
    let (sin_t0, cos_t0) = t0.sin_cos();
    let t2 = theta * p.xc;
    let t3 = p.yc * theta;
    let t4 = theta_dot * p.xc;
    let t5 = t1 * p.y0;
    let t6 = theta_dot * p.yc;
    let t7 = p.omega.product_error(t);
    let t8 = t1 * p.x0;
    let t9 = phi2_dot * (s2_dot * S::from_f64(2.0));
    let t10 = phi1_dot * (S::from_f64(2.0) * s1_dot);
    let t11 = phi2_dot * phi2_dot;
    let t12 = p.by * (y_dot - t4) + p.cy * (y - t2);
    let t13 = p.by * (t4 + y_dot) + p.cy * (t2 + y);
    let t14 = phi1_dot * phi1_dot;
    let t15 = p.bx * (x_dot - t6) + p.cx * (x - t3);
    let t16 = p.bx * (t6 + x_dot) + p.cx * (t3 + x);
    let t17 = cos_phi2 * s2;
    let t18 = cos_phi1 * s1;
    let t19 = sin_phi2 * s2;
    let t20 = sin_phi1 * s1;
    let t21 = p.e_omega2 * (sin_t0 + t7 * cos_t0) + (sin_theta * t8 + t5 * cos_theta);
    let t22 = t10 * sin_phi1 + t14 * t18;
    let t23 = p.e_omega2 * (cos_t0 - t7 * sin_t0) + (cos_theta * t8 - t5 * sin_theta);
    let t24 = t14 * t20 - t10 * cos_phi1;
    let t25 = t9 * sin_phi2 + t11 * t17 + t22;
    let t26 = t11 * t19 - t9 * cos_phi2 + t24;
    let t27 = t25 * p.m2 + t22 * p.m1;
    let t28 = p.m2 * t26 + p.m1 * t24;
    let t29 = cos_theta * (t23 * p.m0_y0 - t21 * p.m0_x0);
    let t30 = t29 + (p.yc * (t16 - t15) + p.xc * (t13 - t12));
    let f_x = t23 * p.m0 + (t27 - (t15 + t16));
    let f_y = p.m0 * t21 + (t28 - (t12 + t13));
    let f_theta = -(sin_theta * (t21 * p.m0_y0 + t23 * p.m0_x0) + t30);
    let f_s1 = cos_phi1 * t27 + sin_phi1 * t28;
    let f_phi1 = t18 * t28 - t27 * t20;
    let zero = S::ZERO;
    let f_s2 = p.m2 * (cos_phi2 * t25 + sin_phi2 * t26);
    let f_phi2 = p.m2 * (t17 * t26 - t25 * t19);
    [f_x, f_y, f_theta, f_s1, f_phi1, zero, f_s2, f_phi2, zero]
}

/// Residuals `g` of the constraints of positions; 0 for those of velocities alone.
///
/// ```text
/// g[bed] = rho - s2 - r2 - delta
/// g[mortar_in_cylinder.gap] = R - s1 - r1
/// ```
pub fn constraint_positions<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 9],
) -> [S; 4] {
    let s1 = q[3];
    let s2 = q[6];
    let g1 = p.rho_minus_r2_minus_delta - s2;
    let zero = S::ZERO;
    let g3 = p.R_minus_r1 - s1;
    [g1, zero, g3, zero]
}

/// Residuals `phi = G v + dg/dt` of the constraints at the level of velocities.
///
/// ```text
/// phi[bed] = -der(s2)
/// phi[grain] = r2*(der(theta2) - der(phi2)) + rho*(der(theta1) - der(phi2))
/// phi[mortar_in_cylinder.gap] = -der(s1)
/// phi[mortar_in_cylinder.slip] = s1*der(phi1) - R*der(theta) + r1*der(theta1)
/// ```
pub fn constraint_rates<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 9],
    v: &[S; 9],
) -> [S; 4] {
    let s1 = q[3];
    let theta_dot = v[2];
    let s1_dot = v[3];
    let phi1_dot = v[4];
    let theta1_dot = v[5];
    let s2_dot = v[6];
    let phi2_dot = v[7];
    let theta2_dot = v[8];
    let phi1 = -s2_dot;
    let phi2 = (theta1_dot - phi2_dot) * p.rho - (phi2_dot - theta2_dot) * p.r2;
    let phi3 = -s1_dot;
    let phi4 = phi1_dot * s1 + theta1_dot * p.r1 + p.minus_R * theta_dot;
    [phi1, phi2, phi3, phi4]
}

/// Constraint matrix `G`, the derivatives of `phi` by the rates.
///
/// ```text
/// G[bed, s2] = -1
/// G[grain, theta1] = rho
/// G[grain, phi2] = -rho - r2
/// G[grain, theta2] = r2
/// G[mortar_in_cylinder.gap, s1] = -1
/// G[mortar_in_cylinder.slip, theta] = -R
/// G[mortar_in_cylinder.slip, phi1] = s1
/// G[mortar_in_cylinder.slip, theta1] = r1
/// ```
pub fn constraint_matrix<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 9]) -> [S; 36] {
    let s1 = q[3];
    let zero = S::ZERO;
    [
        zero,
        zero,
        zero,
        zero,
        zero,
        zero,
        S::from_f64(-1.0),
        zero,
        zero,
        zero,
        zero,
        zero,
        zero,
        zero,
        p.rho,
        zero,
        p.k2,
        p.r2,
        zero,
        zero,
        zero,
        S::from_f64(-1.0),
        zero,
        zero,
        zero,
        zero,
        zero,
        zero,
        zero,
        p.minus_R,
        zero,
        s1,
        p.r1,
        zero,
        zero,
        zero,
    ]
}

/// Right-hand side `gamma` of `G a = gamma`.
///
/// ```text
/// gamma[mortar_in_cylinder.slip] = -der(s1)*der(phi1)
/// ```
pub fn constraint_bias<S: ::lagrangian::emitted::Scalar>(v: &[S; 9]) -> [S; 4] {
    let s1_dot = v[3];
    let phi1_dot = v[4];
    let zero = S::ZERO;
    let gamma4 = -(phi1_dot * s1_dot);
    [zero, zero, zero, gamma4]
}

::lagrangian::emitted::fast_function! {
    /// Accelerations `a`, the solution of `M a = f + G^T lambda`, `G a = gamma` from the mass
    /// matrix, without the coordinates that constraints settle, factored.
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
    let phi1 = n(q[4]);
    let phi2 = n(q[7]);
    let x_dot = n(v[0]);
    let y_dot = n(v[1]);
    let theta_dot = n(v[2]);
    let phi1_dot = n(v[4]);
    let phi2_dot = n(v[7]);
    let t0 = n(p.omega) * n(t);
    let angles = [theta, phi1, phi2, t0];
    let circular = N::sin_cos_all(angles);
    let (sin_theta, cos_theta) = circular[0];
    let (sin_phi1, cos_phi1) = circular[1];
    let (sin_phi2, cos_phi2) = circular[2];
    let (sin_t0, cos_t0) = circular[3];
    let t1 = n(p.yc) * theta;
    let t2 = theta * n(p.xc);
    let t3 = phi1_dot * phi1_dot;
    let t4 = theta_dot * n(p.yc);
    let t5 = theta_dot * n(p.xc);
    let t6 = t3 * n(p.R_minus_r1);
    let t7 = n(p.omega).product_error(n(t));
    let t8 = theta_dot * theta_dot;
    let t9 = phi2_dot * (phi2_dot * n(p.rho_minus_r2_minus_delta));
    let t10 = t3 * n(p.k13);
    let t11 = n(p.bx).mul_add(t4 + x_dot, n(p.cx) * (t1 + x));
    let t12 = n(p.bx).mul_add(x_dot - t4, n(p.cx) * (x - t1));
    let t13 = n(p.by).mul_add(t5 + y_dot, n(p.cy) * (t2 + y));
    let t14 = n(p.by).mul_add(y_dot - t5, n(p.cy) * (y - t2));
    let t15 = sin_phi1 * n(p.k15);
    let t16 = cos_phi1 * n(p.k15);
    let t17 = sin_theta.mul_add(n(p.m0_x0), cos_theta * n(p.m0_y0));
    let t18 = cos_theta.mul_sub(n(p.m0_x0), sin_theta * n(p.m0_y0));
    // Eliminates x from row phi1: l[phi1, x].
    let t19 = n(p.k23) * t15;
    // Eliminates y from row phi1: l[phi1, y].
    let t20 = n(p.k23) * t16;
    let t21 = t9.mul_add(cos_phi2, t6 * cos_phi1);
    // Eliminates x from row theta: l[theta, x].
    let t22 = n(p.k23) * t17;
    // Eliminates y from row theta: l[theta, y].
    let t23 = n(p.k23) * t18;
    let t24 = t9.mul_add(sin_phi2, t6 * sin_phi1);
    let t25 = t18.mul_add(t20, t17.mul_add(t19, n(p.k16)));
    let t26 = t8 * sin_theta.mul_add(n(p.x0), cos_theta * n(p.y0));
    let t27 = n(p.e_omega2).mul_add(t7.mul_add(cos_t0, sin_t0), t26);
    let t28 = t21.mul_add(n(p.m2), cos_phi1 * t10);
    let t29 = sin_phi2 * n(p.k14);
    // Row theta: pivot d[theta].
    let t30 = t18.neg_mul_add(t23, t17.neg_mul_add(t22, n(p.k22)));
    let t31 = t8 * cos_theta.mul_sub(n(p.x0), sin_theta * n(p.y0));
    let t32 = n(p.e_omega2).mul_add(t7.neg_mul_add(sin_t0, cos_t0), t31);
    let t33 = cos_phi2 * n(p.k14);
    let t34 = n(p.m2).mul_add(t24, sin_phi1 * t10);
    // Eliminates x from row phi2: l[phi2, x].
    let t35 = n(p.k23) * t29;
    let t36 = N::ONE / t30;
    let t37 = t32.mul_add(n(p.m0), t28 - (t12 + t11));
    // Eliminates y from row phi2: l[phi2, y].
    let t38 = n(p.k23) * t33;
    let t39 = n(p.yc).mul_add(t11 - t12, n(p.xc) * (t13 - t14));
    let t40 = t32.mul_sub(n(p.m0_y0), n(p.m0_x0) * t27);
    let t41 = n(p.m0).mul_add(t27, t34 - (t14 + t13));
    let t42 = t18.mul_add(t38, t17.mul_add(t35, n(p.k17)));
    let t43 = cos_phi2.mul_add(cos_phi1, sin_phi2 * sin_phi1);
    let t44 = n(p.m0_y0).mul_add(t27, t32 * n(p.m0_x0));
    let t45 = n(p.k14) * cos_phi2.mul_sub(t24, sin_phi2 * t21);
    // Eliminates theta from row phi1: l[phi1, theta].
    let t46 = t36 * t25;
    // Eliminates theta from row phi2: l[phi2, theta].
    let t47 = t36 * t42;
    let t48 = cos_phi1.mul_sub(t34, sin_phi1 * t28);
    let t49 = t43.mul_add(n(p.k19), n(p.k18));
    let t50 = sin_theta.mul_add(t44, cos_theta.mul_add(t40, t39));
    // Row theta: right-hand side z[theta].
    let t51 = t50 + t23.mul_sub(t41, t37 * t22);
    let t52 = t16.neg_mul_add(t20, t15.neg_mul_add(t19, n(p.k20)));
    // Row phi1: pivot d[phi1].
    let t53 = t25.neg_mul_add(t46, t52);
    let t54 = n(p.R_minus_r1).mul_add(t48, t37 * t19);
    let t55 = t25.neg_mul_add(t47, t49 - t16.mul_add(t38, t15 * t35));
    let t56 = t38.neg_mul_add(t41, t37.mul_add(t35, t45));
    let t57 = t33.neg_mul_add(t38, t29.neg_mul_add(t35, n(p.k21)));
    let t58 = N::ONE / t53;
    // Row phi1: right-hand side z[phi1].
    let t59 = t46.neg_mul_add(t51, t20.neg_mul_add(t41, t54));
    // Eliminates phi1 from row phi2: l[phi2, phi1].
    let t60 = t58 * t55;
    // Row phi2: pivot d[phi2].
    let t61 = t55.neg_mul_add(t60, t42.neg_mul_add(t47, t57));
    // Row phi2: right-hand side z[phi2].
    let phi2_ddot = t60.neg_mul_add(t59, t47.neg_mul_add(t51, t56)) / t61;
    // Back substitution: a[phi1].
    let phi1_ddot = t60.neg_mul_add(phi2_ddot, t58 * t59);
    let t62 = t47.neg_mul_add(phi2_ddot, t36 * t51);
    let t63 = t46 * phi1_ddot;
    let t64 = t35.mul_add(phi2_ddot, n(p.k23) * t37);
    let t65 = t38.neg_mul_add(phi2_ddot, n(p.k23) * t41);
    // Back substitution: a[theta].
    let t66 = t62 - t63;
    let t67 = t66.mul_add(n(p.R_over_r1), phi1_ddot * n(p.k12));
    let x_ddot = t22.neg_mul_add(t66, t19.mul_add(phi1_ddot, t64));
    // Back substitution: a[y].
    let y_ddot = t23.mul_add(t66, t20.neg_mul_add(phi1_ddot, t65));
    let theta_ddot = t63 - t62;
    let zero = N::ZERO;
    let theta1_ddot = -t67;
    let theta2_ddot = t67.mul_add(n(p.rho_over_r2), phi2_ddot * n(p.k11));
    let sound = PIVOTS_1.hold(t30, n(p.k22))
        & PIVOTS_1.hold(t53, n(p.k20))
        & PIVOTS_1.hold(t61, n(p.k21))
        & theta2_ddot.is_finite();
    if !sound {
        let pivots = [(2, t30, n(p.k22)), (4, t53, n(p.k20)), (7, t61, n(p.k21))];
        PIVOTS_1.check(pivots)?;
    }
    let accelerations = [
        x_ddot.store(),
        y_ddot.store(),
        theta_ddot.store(),
        zero.store(),
        phi1_ddot.store(),
        theta1_ddot.store(),
        zero.store(),
        phi2_ddot.store(),
        theta2_ddot.store(),
    ];
    Ok(accelerations)
}

::lagrangian::emitted::fast_function! {
    /// Lagrange's multipliers `lambda` of `M a = f + G^T lambda`.
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
    ///
    /// So far these are the accelerations `a0` without constraint forces. The multipliers follow
    /// from `C lambda = gamma - G a0`, where now `G` are the rows of the constraints and `C = G
    /// M^-1 G^T`, row after row: `d`, `l` and `z` of constraints are those of `C = L D L^T`.
    pub fn multipliers<'a, S>(Multipliers {
        p: &'a Prepared<S>,
        t: S,
        q: &'a [S; 9],
        v: &'a [S; 9],
    }) -> Result<[S; 4], ::lagrangian::emitted::Singular> = multipliers_in;
}

#[inline(always)]
fn multipliers_in<S: Copy, N: ::lagrangian::emitted::Scalar<Stored = S>>(
    call: Multipliers<'_, S>,
) -> Result<[S; 4], ::lagrangian::emitted::Singular> {
    let Multipliers { p, t, q, v } = call;
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
    let angles = [phi1, phi2, theta, t0];
    let circular = N::sin_cos_all(angles);
    let (sin_phi1, cos_phi1) = circular[0];
    let (sin_phi2, cos_phi2) = circular[1];
    let (sin_theta, cos_theta) = circular[2];
    let (sin_t0, cos_t0) = circular[3];
    let t1 = N::ONE / s2;
    let t2 = N::ONE / s1;
    let t3 = theta * n(p.xc);
    let t4 = theta * n(p.yc);
    let t5 = n(p.xc) * theta_dot;
    let t6 = n(p.yc) * theta_dot;
    let t7 = theta_dot * theta_dot;
    let t8 = n(p.omega).product_error(n(t));
    let t9 = phi1_dot * s1_dot;
    let t10 = (t3 + y).mul_add(n(p.cy), (t5 + y_dot) * n(p.by));
    let t11 = (y - t3).mul_add(n(p.cy), (y_dot - t5) * n(p.by));
    let t12 = (t4 + x).mul_add(n(p.cx), (t6 + x_dot) * n(p.bx));
    let t13 = (x - t4).mul_add(n(p.cx), (x_dot - t6) * n(p.bx));
    let t14 = t2 * (t2 * n(p.inverse_m1));
    // Eliminates s2: alone z[s2].
    let t15 = phi2_dot * (s2 * phi2_dot);
    let t16 = n(p.xc).mul_add(t11, n(p.yc) * t13);
    let t17 = s2 * (s2 * n(p.m2));
    let t18 = s1 * (s1 * n(p.m1));
    let t19 = sin_phi1 * s1;
    let t20 = cos_phi1 * s1;
    let t21 = sin_phi2 * t1;
    let t22 = sin_phi1 * t2;
    let t23 = sin_theta * n(p.x0);
    let t24 = cos_theta * n(p.y0);
    let t25 = cos_phi2 * t1;
    let t26 = sin_phi1.mul_add(sin_phi2, cos_phi1 * cos_phi2);
    let t27 = n(p.k2) * t21;
    let t28 = cos_phi1 * t2;
    let t29 = cos_theta * n(p.x0);
    let t30 = sin_theta * n(p.y0);
    // Eliminates x: coupling l[x].
    let t31 = t23 + t24;
    let t32 = n(p.k2) * t25;
    let t33 = sin_phi2.mul_sub(t20, cos_phi2 * t19);
    // Eliminates y: coupling l[y].
    let t34 = t29 - t30;
    let t35 = t31 * n(p.k3);
    let t36 = t22.mul_add(t33, cos_phi1.neg_mul_add(t26, cos_phi2));
    let t37 = t28.neg_mul_add(t33, sin_phi1.neg_mul_add(t26, sin_phi2));
    let t38 = cos_phi1.mul_sub(t27, sin_phi1 * t32);
    let t39 = t34 * n(p.k3);
    let t40 = t20.mul_add(t32, t19 * t27);
    let t41 = t28.mul_sub(t40, sin_phi1.mul_add(t38, t32));
    let t42 = t22.mul_add(t40, cos_phi1.mul_sub(t38, t27));
    let t43 = cos_phi1 * n(p.k7);
    let t44 = t8.neg_mul_add(sin_t0, cos_t0);
    let t45 = t8.mul_add(cos_t0, sin_t0);
    let t46 = n(p.k3) * t34.mul_sub(t37, t31 * t36) * n(p.k5);
    let t47 = sin_phi1 * n(p.k7);
    let t48 = t44.mul_add(n(p.e_omega2), t7.mul_sub(t29, t7 * t30));
    let t49 = t48 * n(p.m0);
    let t50 = t45.mul_add(n(p.e_omega2), t7.mul_add(t24, t7 * t23));
    let t51 = t50 * n(p.m0);
    let t52 = n(p.k3) * sin_phi1.mul_sub(t34, cos_phi1 * t31) * n(p.k5);
    let t53 = t35.neg_mul_add(t46, t36 * n(p.k7));
    let t54 = t39.mul_add(t46, t37 * n(p.k7));
    let t55 = n(p.xc).mul_add(t10, n(p.yc) * t12) - t16;
    let t56 = t12 + t13 - t49;
    let t57 = t10 + t11 - t51;
    let t58 = n(p.k5) * (n(p.k3) * t34.mul_add(t41, t31 * t42));
    let t59 = t35.neg_mul_add(t52, t43);
    let t60 = t39.mul_add(t52, t47);
    let t61 = cos_phi1.mul_sub(t53, n(p.inverse_m1) * t26);
    let t62 = sin_phi1.mul_add(t54, t61);
    let t63 = t28.neg_mul_add(t54, t22.mul_add(t53, t14 * t33));
    let t64 = t35.mul_add(t58, n(p.k7) * t42);
    let t65 = t39.mul_add(t58, n(p.k7) * t41);
    let t66 = sin_phi1.mul_add(t35, cos_phi1.mul_add(t39, n(p.minus_R)));
    let t67 = n(p.k5) * t66;
    let t68 = t39.neg_mul_add(t57, t31.mul_add(t49, t55));
    let t69 = t68 + t35.mul_sub(t56, t34 * t51);
    let t70 = cos_phi1.mul_add(t59, n(p.inverse_m1));
    let t71 = sin_phi1.mul_add(t60, t70);
    let t72 = s1.mul_sub(t63, t46 * n(p.minus_R));
    let t73 = t69 * n(p.k6);
    let t74 = t19.neg_mul_add(t63, cos_phi1.neg_mul_add(t62, t53));
    let t75 = sin_phi1.neg_mul_add(t62, t20.mul_add(t63, t54));
    let t76 = t28.mul_add(t65, t22.mul_add(t64, t14 * t40));
    let t77 = cos_phi1.mul_add(t64, n(p.inverse_m1) * t38);
    let t78 = sin_phi1.neg_mul_add(t65, t77);
    let t79 = t31.mul_add(t73, t56);
    let t80 = n(p.minus_R).neg_mul_add(t58, n(p.r1_rho_over_J1));
    let t81 = t34.neg_mul_add(t73, t57);
    let t82 = cos_phi2.mul_add(t74, n(p.inverse_m2));
    // Row bed: pivot d[bed].
    let t83 = sin_phi2.mul_add(t75, t82);
    let t84 = t22.mul_sub(t59, t28 * t60);
    let t85 = t47.mul_add(t79, t9 * N::from_f64(2.0));
    let t86 = N::ONE / t83;
    let t87 = n(p.k2) * t21.mul_sub(t74, t25 * t75);
    let t88 = cos_phi1.neg_mul_add(t78, t19.neg_mul_add(t76, t64));
    let t89 = t22.mul_add(t35.mul_add(t67, t47), s1 * t14);
    // Eliminates s1: alone z[s1].
    let t90 = t43.mul_add(t79, phi1_dot * (s1 * phi1_dot));
    let t91 = t21.mul_sub(t88, t1 * (t1 * n(p.inverse_m2)) * n(p.k2));
    let t92 = t20.neg_mul_add(t76, sin_phi1.mul_add(t78, t65));
    let t93 = n(p.minus_R).mul_add(t67, n(p.r1_squared_over_J1));
    let t94 = s1.mul_add(t28.mul_add(t39.mul_add(t67, t43), t89), t93);
    let t95 = n(p.k2).neg_mul_add(t25.mul_add(t92, t91), n(p.k8));
    // Eliminates bed from row grain: l[grain, bed].
    let t96 = t86 * t87;
    // Eliminates bed from row mortar_in_cylinder.gap: l[mortar_in_cylinder.gap, bed].
    let t97 = t62 * t86;
    // Eliminates bed from row mortar_in_cylinder.slip: l[mortar_in_cylinder.slip, bed].
    let t98 = t72 * t86;
    // Row grain: pivot d[grain].
    let t99 = t87.neg_mul_add(t96, t95);
    let t100 = t87.mul_add(t97, t78);
    let t101 = t87.neg_mul_add(t98, s1.neg_mul_add(t76, t80));
    // Row grain: right-hand side z[grain].
    let t102 = t15.mul_add(t96, t1 * (n(p.k9) * s2_dot * phi2_dot));
    let t103 = t69.mul_add(n(p.k10), t9) - t43.neg_mul_add(t81, t85);
    let t104 = N::ONE / t99;
    // Eliminates grain from row mortar_in_cylinder.gap: l[mortar_in_cylinder.gap, grain].
    let t105 = t100 * t104;
    // Eliminates grain from row mortar_in_cylinder.slip: l[mortar_in_cylinder.slip, grain].
    let t106 = t101 * t104;
    // Row mortar_in_cylinder.gap: pivot d[mortar_in_cylinder.gap].
    let t107 = t100.neg_mul_add(t105, t62.neg_mul_add(t97, t71));
    let t108 = t62.neg_mul_add(t98, s1.mul_sub(t84, n(p.minus_R) * t52));
    let t109 = t100.mul_add(t106, t108);
    let t110 = t15.neg_mul_add(t97, t47.mul_add(t81, t90));
    // Row mortar_in_cylinder.gap: right-hand side z[mortar_in_cylinder.gap].
    let t111 = t102.neg_mul_add(t105, t110);
    let t112 = N::ONE / t107;
    // Eliminates mortar_in_cylinder.gap from row mortar_in_cylinder.slip:
    // l[mortar_in_cylinder.slip, mortar_in_cylinder.gap].
    let t113 = t109 * t112;
    let t114 = t102.neg_mul_add(t106, t15.mul_add(t98, t103));
    let t115 = t101.neg_mul_add(t106, t72.neg_mul_add(t98, t94));
    // Row mortar_in_cylinder.slip: pivot d[mortar_in_cylinder.slip].
    let t116 = t109.neg_mul_add(t113, t115);
    // Row mortar_in_cylinder.slip: right-hand side z[mortar_in_cylinder.slip].
    let t117 = t111.mul_add(t113, t114) / t116;
    // Back substitution: lambda[mortar_in_cylinder.gap].
    let lambda3 = t113.mul_add(t117, t111 * t112);
    let t118 = t106.neg_mul_add(t117, t102 * t104);
    let t119 = t105 * lambda3;
    let t120 = t97.neg_mul_add(lambda3, t98.mul_add(t117, t15 * t86));
    // Back substitution: lambda[grain]; Back substitution: lambda[bed].
    let lambda1 = t96.mul_add(t118 - t119, t120);
    let lambda2 = t119 - t118;
    let lambda4 = -t117;
    let sound = PIVOTS.hold(n(p.J1), n(p.J1))
        & PIVOTS.hold(n(p.J2), n(p.J2))
        & PIVOTS.hold(n(p.m2), n(p.m2))
        & PIVOTS.hold(t17, t17)
        & PIVOTS.hold(n(p.m1), n(p.m1_plus_m2))
        & PIVOTS.hold(t18, t18)
        & PIVOTS.hold(n(p.m_plus_m0), n(p.k0))
        & PIVOTS.hold(n(p.m_plus_m0), n(p.k0))
        & PIVOTS.hold(n(p.k4), n(p.k1))
        & PIVOTS.hold(t83, t83)
        & PIVOTS.hold(t99, t95)
        & PIVOTS.hold(t107, t71)
        & PIVOTS.hold(t116, t94)
        & lambda1.is_finite();
    if !sound {
        let pivots = [
            (5, n(p.J1), n(p.J1)),
            (8, n(p.J2), n(p.J2)),
            (6, n(p.m2), n(p.m2)),
            (7, t17, t17),
            (3, n(p.m1), n(p.m1_plus_m2)),
            (4, t18, t18),
            (1, n(p.m_plus_m0), n(p.k0)),
            (0, n(p.m_plus_m0), n(p.k0)),
            (2, n(p.k4), n(p.k1)),
            (9, t83, t83),
            (10, t99, t95),
            (11, t107, t71),
            (12, t116, t94),
        ];
        PIVOTS.check(pivots)?;
    }
    let multipliers = [
        lambda1.store(),
        lambda2.store(),
        lambda3.store(),
        lambda4.store(),
    ];
    Ok(multipliers)
}

/// Kinetic energy `T`, in J.
///
/// ```text
/// T = 1/2*m*der(x)^2 + 1/2*m*der(y)^2 + 1/2*J*der(theta)^2 + 1/2*J1*der(theta1)^2
///     + 1/2*J2*der(theta2)^2 + 1/2*m0*(((der(x) - y0*cos(theta)*der(theta) -
///     x0*sin(theta)*der(theta)) - e*omega*sin(omega*t))^2 + ((der(y) + x0*cos(theta)*der(theta) -
///     y0*sin(theta)*der(theta)) + e*omega*cos(omega*t))^2) + 1/2*m1*((der(x) + (cos(phi1)*der(s1)
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
    let t0 = p.omega * t;
    let (sin_theta, cos_theta) = theta.sin_cos();
    let t1 = phi1_dot * s1;
    let t2 = phi2_dot * s2;
    let t3 = theta_dot * p.x0;
    let (sin_t0, cos_t0) = t0.sin_cos();
    let t4 = p.omega.product_error(t);
    let t5 = theta_dot * p.y0;
    let t6 = x_dot + (cos_phi1 * s1_dot - t1 * sin_phi1);
    let t7 = y_dot + (t1 * cos_phi1 + sin_phi1 * s1_dot);
    let t8 = x_dot - t3 * sin_theta - cos_theta * t5;
    let t9 = t8 - p.e_omega * (sin_t0 + t4 * cos_t0);
    let t10 = y_dot + t3 * cos_theta - sin_theta * t5;
    let t11 = p.e_omega * (cos_t0 - t4 * sin_t0) + t10;
    let t12 = cos_phi2 * s2_dot - t2 * sin_phi2 + t6;
    let t13 = t2 * cos_phi2 + sin_phi2 * s2_dot + t7;
    let t14 = (y_dot * y_dot + x_dot * x_dot) * p.m + theta_dot * (theta_dot * p.J);
    let t15 = (t7 * t7 + t6 * t6) * p.m1 + theta1_dot * (theta1_dot * p.J1) + t14;
    let t16 = (t13 * t13 + t12 * t12) * p.m2 + theta2_dot * (theta2_dot * p.J2) + t15;
    ((t11 * t11 + t9 * t9) * p.m0 + p.J0_omega2 + t16) * S::from_f64(0.5)
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
/// P = m0*e*omega*cos(omega*t)*der(der(y)) - m0*e*omega*sin(omega*t)*der(der(x))
///     + m0*e*y0*omega*sin(omega*t - theta)*der(der(theta))
///     + m0*e*x0*omega*cos(omega*t - theta)*der(der(theta))
///     + m0*e*x0*omega*sin(omega*t - theta)*der(theta)^2
///     - m0*e*y0*omega*cos(omega*t - theta)*der(theta)^2
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
    let t7 = t6 * (t5 * p.e_omega2 - (y_ddot - t3 * p.y0 - t4 * p.x0));
    let t8 = t5 * (t6 * p.e_omega2 - (t4 * p.y0 + x_ddot - p.x0 * t3)) - t7;
    t8 * p.m0_e_omega
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

/// Spin of a grain. Unit: `rad/s`.
///
/// ```text
/// grain_spin = der(phi2) + 2*rho*(der(theta1) - der(phi2))/delta
/// ```
pub fn output_grain_spin<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, v: &[S; 9]) -> S {
    let theta1_dot = v[5];
    let phi2_dot = v[7];
    phi2_dot + p.two_rho_over_delta * (theta1_dot - phi2_dot)
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

/// Everything that the description asks to observe.
pub fn outputs<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, v: &[S; 9]) -> Outputs<S> {
    Outputs {
        grain_spin: output_grain_spin(p, v),
    }
}

::lagrangian::emitted::implement! {
    machine GrainCrusher "GrainCrusher" over S, R;
    parameters {
        m, m0, m1, m2, J, J0, J1, J2, e, x0, y0, omega, cx, cy, bx, by, xc, yc, R, r1, rho, r2,
        delta, whirl1, whirl2,
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
        R: "R" "m" = 0.27;
        r1: "r1" "m" = 0.25;
        rho: "rho" "m" = 0.2;
        r2: "r2" "m" = 0.16;
        delta: "delta" "m" = 0.01;
        whirl1: "whirl1" "rad/s" = 40.0;
        whirl2: "whirl2" "rad/s" = 25.0;
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
    outputs Outputs { grain_spin } [
        grain_spin: "grain_spin" "rad/s";
    ]
    prepared Prepared {
        m, m0, m1, m2, J, J1, J2, x0, y0, omega, cx, cy, bx, by, xc, yc, r1, rho, r2, R_minus_r1,
        rho_minus_r2_minus_delta, two_rho_over_delta, e_omega, J0_omega2, half_cx, half_cy, half_bx,
        half_by, e_omega2, m1_plus_m2, m0_y0, m0_x0, k0, m0_e_omega, k1, minus_m2, k2, minus_R,
        m_plus_m0, k3, k4, k5, k6, k7, inverse_m2, inverse_m1, k8, k9, r1_rho_over_J1,
        r1_squared_over_J1, k10, rho_over_r2, k11, R_over_r1, k12, k13, k14, k15, k16, k17, k18,
        k19, k20, k21, k22, k23,
    }
    singular singular
    accelerations { (p, t, q, v, u) Accelerations { p, t, q, v } }
    system {
        matrix mass_matrix(p, t, q) = mass_matrix(p, q);
        vector bias(p, t, q, v) = bias(p, t, q, v);
        vector applied(p, t, q, v, u) = applied(p, q, v);
        vector forces(p, t, q, v, u) = forces(p, t, q, v);
        numbers constraint_positions(p, t, q) = constraint_positions(p, q);
        numbers constraint_rates(p, t, q, v) = constraint_rates(p, q, v);
        numbers constraint_matrix(p, t, q) = constraint_matrix(p, q);
        numbers constraint_bias(p, t, q, v) = constraint_bias(v);
        number kinetic_energy(p, t, q, v) = kinetic_energy(p, t, q, v);
        number potential_energy(p, t, q, u) = potential_energy(p, q);
        number dissipation(p, t, q, v, u) = dissipation(p, v);
        number work_rate(p, t, q, v, a, u) = work_rate(p, t, q, v, a);
        number dissipation_rate(p, t, q, v, u) = dissipation_rate(p, v);
        outputs outputs(p, t, q, v, a, u) = outputs(p, v);
        facts assumptions(p, t, q, v, u) = [
            ("s1 > 0", true, assumption_0(q)),
            ("s2 > 0", true, assumption_1(q)),
        ];
        constraints constraints(p) = [
            ("bed", "m", "N", true),
            ("grain", "m/s", "N", false),
            ("mortar_in_cylinder.gap", "m", "N", true),
            ("mortar_in_cylinder.slip", "m/s", "N", false),
        ];
        solved multipliers(p, t, q, v, u) = multipliers(p, t, q, v);
        workspace with_workspace(p) = ::lagrangian::emitted::constraint_workspace(9, 4);
    }
    absent [MAY_SLIDE MAY_COLLIDE]
    intervals []
    lanes [N]
    numbers []
}
