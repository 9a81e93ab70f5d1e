// @generated from machines/grain_crusher.machine by `cargo xtask generate`; edits are lost.

//! The crush process with grains that roll on mortar and pestle both, as rollers of diameter delta
//! without mass: the pestle turns the other way than on a bed, by the relation of R. Willis. The
//! multiplier of `grain` is the friction on the pestle, and on the mortar, along the same
//! direction.
//!
//! 9 coordinates, 25 parameters, 1 output. Arithmetic of one call:
//!
//! | function | mul | add | div | sin cos | other | temporaries |
//! | --- | --: | --: | --: | --: | --: | --: |
//! | `prepare` | 52 | 21 | 10 | 0 | 0 | 83 |
//! | `start` | 4 | 6 | 2 | 0 | 0 | 12 |
//! | `mass_matrix` | 28 | 6 | 0 | 3 | 0 | 40 |
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
/// multiplier of `grain` is the friction on the pestle, and on the mortar, along the same
/// direction.
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
        let k0 = self.rho - self.r2 - self.delta;
        let k1 = self.rho + self.r2;
        let k3 = self.omega * self.e;
        let k10 = self.m1 + self.m2;
        let k11 = self.m0 * self.y0;
        let k12 = self.m0 * self.x0;
        let k21 = self.m + self.m0;
        let k13 = k10 + k21;
        let k14 = self.R - self.r1;
        let k16 = self.J + (self.y0 * k11 + self.x0 * k12);
        let k26 = S::ONE / k21;
        let k23 = k16 - k26 * (k11 * k11) - k26 * (k12 * k12);
        let k24 = S::ONE / k23;
        let pivot_10 = self.r2 * self.r2;
        let t0 = S::ONE / self.J1;
        let t1 = self.rho * t0;
        let pivot_12 = self.r1 * self.r1;
        let t2 = S::ONE / self.r2;
        let k34 = self.rho * t2;
        let k35 = k1 * t2;
        let t3 = S::ONE / self.r1;
        let k36 = self.R * t3;
        let k37 = k14 * t3;
        let k39 = self.m2 * k0;
        let k40 = k10 * k14;
        let t4 = self.J2 * k34;
        let t5 = k34 * t4;
        let t6 = k36 * t5 + self.J1 * k36;
        let t7 = k35 * t4;
        let k2 = self.rho * S::from_f64(2.0) / self.delta;
        let k4 = self.omega * (self.omega * self.J0);
        let k5 = self.cx * S::from_f64(0.5);
        let k6 = self.cy * S::from_f64(0.5);
        let k7 = self.bx * S::from_f64(0.5);
        let k8 = self.by * S::from_f64(0.5);
        let k9 = self.omega * k3;
        let k15 = self.m0 * k3;
        let k17 = -k10;
        let k18 = -self.m2;
        let k19 = -k1;
        let k20 = -self.R;
        let k22 = self.m0 * k26;
        let k25 = self.m0 * k24;
        let k27 = S::ONE / self.m2;
        let k28 = S::ONE / self.m1;
        let k29 = pivot_10 / self.J2 + self.rho * t1;
        let k30 = k1 * S::from_f64(2.0);
        let k31 = self.r1 * t1;
        let k32 = t0 * pivot_12;
        let k33 = self.R * k24;
        let k38 = self.m1 * k14;
        let k41 = k37 * t6;
        let k42 = k36 * t7;
        let k43 = k37 * t7;
        let k44 = k14 * k39;
        let k45 = k14 * k40 + k37 * (k37 * t5 + self.J1 * k37);
        let k46 = k0 * k39 + k35 * (self.J2 * k35);
        let k47 = k16 + k36 * t6;
        let k48 = S::ONE / k13;
        let one = S::ONE;
        let pivots = [
            (0, k13, k13),
            (1, k13, k13),
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
            R: self.R,
            r1: self.r1,
            rho: self.rho,
            r2: self.r2,
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
            k39,
            k40,
            k41,
            k42,
            k43,
            k44,
            k45,
            k46,
            k47,
            k48,
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

/// What can be set while a [`GrainCrusher`] runs.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Inputs {}

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
    /// `R`
    R: S,
    /// `r1`
    r1: S,
    /// `rho`
    rho: S,
    /// `r2`
    r2: S,
    /// `rho - r2 - delta`
    k0: S,
    /// `rho + r2`
    k1: S,
    /// `2*rho/delta`
    k2: S,
    /// `e*omega`
    k3: S,
    /// `J0*omega^2`
    k4: S,
    /// `0.5*cx`
    k5: S,
    /// `0.5*cy`
    k6: S,
    /// `0.5*bx`
    k7: S,
    /// `0.5*by`
    k8: S,
    /// `e*omega^2`
    k9: S,
    /// `m1 + m2`
    k10: S,
    /// `m0*y0`
    k11: S,
    /// `m0*x0`
    k12: S,
    /// `m + m0 + m1 + m2`
    k13: S,
    /// `R - r1`
    k14: S,
    /// `m0*e*omega`
    k15: S,
    /// `J + m0*x0^2 + m0*y0^2`
    k16: S,
    /// `-(m1 + m2)`
    k17: S,
    /// `-m2`
    k18: S,
    /// `-(rho + r2)`
    k19: S,
    /// `-R`
    k20: S,
    /// `m + m0`
    k21: S,
    /// `m0/(m + m0)`
    k22: S,
    /// `J + m0*x0^2 + m0*y0^2 - m0^2*y0^2/(m + m0) - m0^2*x0^2/(m + m0)`
    k23: S,
    /// `1/(J + m0*x0^2 + m0*y0^2 - m0^2*y0^2/(m + m0) - m0^2*x0^2/(m + m0))`
    k24: S,
    /// `m0/(J + m0*x0^2 + m0*y0^2 - m0^2*y0^2/(m + m0) - m0^2*x0^2/(m + m0))`
    k25: S,
    /// `1/(m + m0)`
    k26: S,
    /// `1/m2`
    k27: S,
    /// `1/m1`
    k28: S,
    /// `rho^2/J1 + r2^2/J2`
    k29: S,
    /// `2*(rho + r2)`
    k30: S,
    /// `r1*rho/J1`
    k31: S,
    /// `r1^2/J1`
    k32: S,
    /// `R/(J + m0*x0^2 + m0*y0^2 - m0^2*y0^2/(m + m0) - m0^2*x0^2/(m + m0))`
    k33: S,
    /// `rho/r2`
    k34: S,
    /// `(rho + r2)/r2`
    k35: S,
    /// `R/r1`
    k36: S,
    /// `(R - r1)/r1`
    k37: S,
    /// `m1*(R - r1)`
    k38: S,
    /// `m2*(rho - r2 - delta)`
    k39: S,
    /// `(m1 + m2)*(R - r1)`
    k40: S,
    /// `(R - r1)*(J1*R/r1 + J2*R*rho^2/r1/r2^2)/r1`
    k41: S,
    /// `J2*R*rho*(rho + r2)/r1/r2^2`
    k42: S,
    /// `J2*rho*(rho + r2)*(R - r1)/r1/r2^2`
    k43: S,
    /// `m2*(rho - r2 - delta)*(R - r1)`
    k44: S,
    /// `(R - r1)*(J1*(R - r1)/r1 + J2*rho^2*(R - r1)/r1/r2^2)/r1 + (m1 + m2)*(R - r1)^2`
    k45: S,
    /// `J2*(rho + r2)^2/r2^2 + m2*(rho - r2 - delta)^2`
    k46: S,
    /// `J + m0*x0^2 + m0*y0^2 + R*(J1*R/r1 + J2*R*rho^2/r1/r2^2)/r1`
    k47: S,
    /// `1/(m + m0 + m1 + m2)`
    k48: S,
    /// Why these parameters leave the machine without accelerations, if they do.
    singular: Option<::lagrangian::emitted::Singular>,
}

/// A pivot of an elimination that is not above this share of its diagonal element may be rounding
/// errors alone.
const PIVOTS: ::lagrangian::emitted::Pivots = ::lagrangian::emitted::Pivots {
    coordinates: 9,
    tolerance: 1.1546319456101628e-14,
};

/// A pivot of an elimination that is not above this share of its diagonal element may be rounding
/// errors alone.
const PIVOTS_1: ::lagrangian::emitted::Pivots = ::lagrangian::emitted::Pivots {
    coordinates: 9,
    tolerance: 7.993605777301127e-15,
};

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
    let t1 = p.k10 * s1;
    let t2 = p.m2 * s2;
    let t3 = sin_phi1 * cos_phi2;
    let t4 = cos_phi1 * sin_phi2;
    let t5 = cos_phi1 * cos_phi2 + sin_phi1 * sin_phi2;
    let zero = S::ZERO;
    let m31 = -(p.k12 * sin_theta + cos_theta * p.k11);
    let m32 = p.k12 * cos_theta - sin_theta * p.k11;
    let m41 = p.k10 * cos_phi1;
    let m42 = p.k10 * sin_phi1;
    let m51 = sin_phi1 * (s1 * p.k17);
    let m52 = cos_phi1 * t1;
    let m55 = s1 * t1;
    let m71 = cos_phi2 * p.m2;
    let m72 = sin_phi2 * p.m2;
    let m74 = p.m2 * t5;
    let m75 = (t4 - t3) * t0;
    let m81 = sin_phi2 * (s2 * p.k18);
    let m82 = cos_phi2 * t2;
    let m84 = t2 * (t3 - t4);
    let m85 = t5 * (t0 * s2);
    let m88 = s2 * t2;
    [
        [p.k13, zero, m31, m41, m51, zero, m71, m81, zero],
        [zero, p.k13, m32, m42, m52, zero, m72, m82, zero],
        [m31, m32, p.k16, zero, zero, zero, zero, zero, zero],
        [m41, m42, zero, p.k10, zero, zero, m74, m84, zero],
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
    let t15 = p.k9 * (sin_t0 + t2 * cos_t0) + (sin_theta * t5 + t4 * cos_theta);
    let t16 = t3 * t9 - t7 * cos_phi2 + t13;
    let t17 = p.k9 * (cos_t0 - t2 * sin_t0) + (cos_theta * t5 - t4 * sin_theta);
    let t18 = t7 * sin_phi2 + t3 * t11 + t14;
    let t19 = p.m2 * t16 + p.m1 * t13;
    let t20 = t18 * p.m2 + t14 * p.m1;
    let t21 = cos_theta * (t17 * p.k11 - t15 * p.k12);
    let h_x = -(t17 * p.m0 + t20);
    let h_y = -(p.m0 * t15 + t19);
    let h_theta = sin_theta * (t15 * p.k11 + t17 * p.k12) + t21;
    let h_s1 = -(cos_phi1 * t20 + sin_phi1 * t19);
    let h_phi1 = t20 * t10 - t12 * t19;
    let zero = S::ZERO;
    let h_s2 = p.k18 * (cos_phi2 * t18 + sin_phi2 * t16);
    let h_phi2 = p.k18 * (t11 * t16 - t18 * t9);
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
    let t21 = p.k9 * (sin_t0 + t7 * cos_t0) + (sin_theta * t8 + t5 * cos_theta);
    let t22 = t10 * sin_phi1 + t14 * t18;
    let t23 = p.k9 * (cos_t0 - t7 * sin_t0) + (cos_theta * t8 - t5 * sin_theta);
    let t24 = t14 * t20 - t10 * cos_phi1;
    let t25 = t9 * sin_phi2 + t11 * t17 + t22;
    let t26 = t11 * t19 - t9 * cos_phi2 + t24;
    let t27 = t25 * p.m2 + t22 * p.m1;
    let t28 = p.m2 * t26 + p.m1 * t24;
    let t29 = p.yc * (t16 - t15) + p.xc * (t13 - t12);
    let t30 = cos_theta * (t23 * p.k11 - t21 * p.k12) + t29;
    let f_x = t23 * p.m0 + (t27 - (t15 + t16));
    let f_y = p.m0 * t21 + (t28 - (t12 + t13));
    let f_theta = -(sin_theta * (t21 * p.k11 + t23 * p.k12) + t30);
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
    let g1 = p.k0 - s2;
    let zero = S::ZERO;
    let g3 = p.k14 - s1;
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
    let phi4 = theta1_dot * p.r1 + phi1_dot * s1 - p.R * theta_dot;
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
        p.k19,
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
        p.k20,
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

/// Accelerations `a`, the solution of `M a = f + G^T lambda`, `G a = gamma` from the mass matrix,
/// without the coordinates that constraints settle, factored.
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
        let t3 = theta_dot * n(p.yc);
        let t4 = theta_dot * n(p.xc);
        let t5 = phi2_dot * (phi2_dot * n(p.k0));
        let t6 = phi1_dot * phi1_dot;
        let t7 = n(p.omega).product_error(n(t));
        let t8 = theta_dot * theta_dot;
        let t9 = n(p.bx).mul_add(t3 + x_dot, n(p.cx) * (t1 + x));
        let t10 = n(p.bx).mul_add(x_dot - t3, n(p.cx) * (x - t1));
        let t11 = n(p.by).mul_add(t4 + y_dot, n(p.cy) * (t2 + y));
        let t12 = n(p.by).mul_add(y_dot - t4, n(p.cy) * (y - t2));
        let t13 = sin_phi1 * n(p.k40);
        let t14 = cos_phi1 * n(p.k40);
        let t15 = t6 * cos_phi1;
        let t16 = sin_theta.mul_add(n(p.k12), cos_theta * n(p.k11));
        let t17 = cos_theta.mul_sub(n(p.k12), sin_theta * n(p.k11));
        let t18 = n(p.k48) * t13;
        let t19 = n(p.k48) * t14;
        let t20 = n(p.k48) * t16;
        let t21 = n(p.k48) * t17;
        let t22 = t6 * sin_phi1;
        let t23 = t15.mul_add(n(p.k14), t5 * cos_phi2);
        let t24 = t17.mul_add(t19, t16.mul_add(t18, n(p.k41)));
        let t25 = t8 * sin_theta.mul_add(n(p.x0), cos_theta * n(p.y0));
        let t26 = n(p.k9).mul_add(t7.mul_add(cos_t0, sin_t0), t25);
        let t27 = n(p.k14).mul_add(t22, t5 * sin_phi2);
        let t28 = t23.mul_add(n(p.m2), t15 * n(p.k38));
        let t29 = t17.neg_mul_add(t21, t16.neg_mul_add(t20, n(p.k47)));
        let t30 = sin_phi2 * n(p.k39);
        let t31 = t8 * cos_theta.mul_sub(n(p.x0), sin_theta * n(p.y0));
        let t32 = n(p.k9).mul_add(t7.neg_mul_add(sin_t0, cos_t0), t31);
        let t33 = cos_phi2 * n(p.k39);
        let t34 = n(p.m2).mul_add(t27, n(p.k38) * t22);
        let t35 = N::ONE / t29;
        let t36 = n(p.k48) * t30;
        let t37 = t32.mul_add(n(p.m0), t28 - (t10 + t9));
        let t38 = n(p.k48) * t33;
        let t39 = n(p.yc).mul_add(t9 - t10, n(p.xc) * (t11 - t12));
        let t40 = t32.mul_sub(n(p.k11), n(p.k12) * t26);
        let t41 = n(p.m0).mul_add(t26, t34 - (t12 + t11));
        let t42 = t17.mul_add(t38, t16.mul_add(t36, n(p.k42)));
        let t43 = cos_phi2.mul_add(cos_phi1, sin_phi2 * sin_phi1);
        let t44 = n(p.k11).mul_add(t26, t32 * n(p.k12));
        let t45 = t35 * t24;
        let t46 = t35 * t42;
        let t47 = n(p.k39) * cos_phi2.mul_sub(t27, sin_phi2 * t23);
        let t48 = cos_phi1.mul_sub(t34, sin_phi1 * t28);
        let t49 = t43.mul_add(n(p.k44), n(p.k43));
        let t50 = sin_theta.mul_add(t44, cos_theta.mul_add(t40, t39));
        let t51 = t50 + t21.mul_sub(t41, t37 * t20);
        let t52 = t14.neg_mul_add(t19, t13.neg_mul_add(t18, n(p.k45)));
        let t53 = t24.neg_mul_add(t45, t52);
        let t54 = t24.neg_mul_add(t46, t49 - t14.mul_add(t38, t13 * t36));
        let t55 = N::ONE / t53;
        let t56 = t38.neg_mul_add(t41, t37.mul_add(t36, t47));
        let t57 = t19.neg_mul_add(t41, n(p.k14).mul_add(t48, t37 * t18));
        let t58 = t45.neg_mul_add(t51, t57);
        let t59 = t33.neg_mul_add(t38, t30.neg_mul_add(t36, n(p.k46)));
        let t60 = t55 * t54;
        let t61 = t54.neg_mul_add(t60, t42.neg_mul_add(t46, t59));
        let phi2_ddot = t60.neg_mul_add(t58, t46.neg_mul_add(t51, t56)) / t61;
        let phi1_ddot = t60.neg_mul_add(phi2_ddot, t55 * t58);
        let t62 = t46.neg_mul_add(phi2_ddot, t35 * t51);
        let t63 = t45 * phi1_ddot;
        let t64 = t36.mul_add(phi2_ddot, n(p.k48) * t37);
        let t65 = t38.neg_mul_add(phi2_ddot, n(p.k48) * t41);
        let t66 = t62 - t63;
        let t67 = t66.mul_add(n(p.k36), phi1_ddot * n(p.k37));
        let x_ddot = t20.neg_mul_add(t66, t18.mul_add(phi1_ddot, t64));
        let y_ddot = t21.mul_add(t66, t19.neg_mul_add(phi1_ddot, t65));
        let theta_ddot = t63 - t62;
        let zero = N::ZERO;
        let theta1_ddot = -t67;
        let theta2_ddot = t67.mul_add(n(p.k34), phi2_ddot * n(p.k35));
        let sound = PIVOTS_1.hold(t29, n(p.k47))
            & PIVOTS_1.hold(t53, n(p.k45))
            & PIVOTS_1.hold(t61, n(p.k46))
            & theta2_ddot.is_finite();
        if !sound {
            let pivots = [(2, t29, n(p.k47)), (4, t53, n(p.k45)), (7, t61, n(p.k46))];
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
}

/// Lagrange's multipliers `lambda` of `M a = f + G^T lambda`.
///
/// A pivot that vanishes is an error.
pub fn multipliers<S: ::lagrangian::emitted::Number>(
    p: &Prepared<S>,
    t: S,
    q: &[S; 9],
    v: &[S; 9],
) -> Result<[S; 4], ::lagrangian::emitted::Singular> {
    S::run(Multipliers { p, t, q, v })
}

/// A call of [`multipliers`], to be run with whatever instructions the processor has.
pub struct Multipliers<'a, S> {
    /// As `multipliers` takes it.
    pub p: &'a Prepared<S>,
    /// As `multipliers` takes it.
    pub t: S,
    /// As `multipliers` takes it.
    pub q: &'a [S; 9],
    /// As `multipliers` takes it.
    pub v: &'a [S; 9],
}

impl<S: Copy> ::lagrangian::emitted::scalar::Kernel<S> for Multipliers<'_, S> {
    type Output = Result<[S; 4], ::lagrangian::emitted::Singular>;

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
        let t5 = theta_dot * n(p.xc);
        let t6 = theta_dot * n(p.yc);
        let t7 = theta_dot * theta_dot;
        let t8 = n(p.omega).product_error(n(t));
        let t9 = phi1_dot * s1_dot;
        let t10 = n(p.by).mul_add(t5 + y_dot, n(p.cy) * (t3 + y));
        let t11 = n(p.by).mul_add(y_dot - t5, n(p.cy) * (y - t3));
        let t12 = n(p.bx).mul_add(t6 + x_dot, n(p.cx) * (t4 + x));
        let t13 = n(p.bx).mul_add(x_dot - t6, n(p.cx) * (x - t4));
        let t14 = t2 * (t2 * n(p.k28));
        let t15 = phi2_dot * (s2 * phi2_dot);
        let t16 = n(p.yc).mul_add(t13, n(p.xc) * t11);
        let t17 = s2 * (s2 * n(p.m2));
        let t18 = s1 * (s1 * n(p.m1));
        let t19 = sin_phi1 * s1;
        let t20 = cos_phi1 * s1;
        let t21 = sin_phi2 * t1;
        let t22 = sin_phi1 * t2;
        let t23 = sin_theta * n(p.x0);
        let t24 = cos_theta * n(p.y0);
        let t25 = cos_phi2 * t1;
        let t26 = cos_phi1.mul_add(cos_phi2, sin_phi1 * sin_phi2);
        let t27 = n(p.k1) * t21;
        let t28 = cos_phi1 * t2;
        let t29 = cos_theta * n(p.x0);
        let t30 = sin_theta * n(p.y0);
        let t31 = t23 + t24;
        let t32 = n(p.k1) * t25;
        let t33 = t20.mul_sub(sin_phi2, t19 * cos_phi2);
        let t34 = t29 - t30;
        let t35 = n(p.k22) * t31;
        let t36 = t22.mul_add(t33, cos_phi1.neg_mul_add(t26, cos_phi2));
        let t37 = t28.neg_mul_add(t33, sin_phi1.neg_mul_add(t26, sin_phi2));
        let t38 = sin_phi1.mul_sub(t32, cos_phi1 * t27);
        let t39 = n(p.k22) * t34;
        let t40 = t19.mul_add(t27, t20 * t32);
        let t41 = t28.neg_mul_add(t40, sin_phi1.neg_mul_add(t38, t32));
        let t42 = t22.neg_mul_add(t40, cos_phi1.mul_add(t38, t27));
        let t43 = cos_phi1 * n(p.k26);
        let t44 = t8.neg_mul_add(sin_t0, cos_t0);
        let t45 = t8.mul_add(cos_t0, sin_t0);
        let t46 = n(p.k24) * (n(p.k22) * t34.mul_sub(t37, t36 * t31));
        let t47 = sin_phi1 * n(p.k26);
        let t48 = n(p.k9).mul_add(t44, t29.mul_sub(t7, t30 * t7)) * n(p.m0);
        let t49 = n(p.m0) * n(p.k9).mul_add(t45, t23.mul_add(t7, t24 * t7));
        let t50 = n(p.k22) * sin_phi1.mul_sub(t34, cos_phi1 * t31);
        let t51 = n(p.k24) * t50;
        let t52 = t46.neg_mul_add(t35, t36 * n(p.k26));
        let t53 = t39.mul_add(t46, t37 * n(p.k26));
        let t54 = cos_phi1.neg_mul_add(t39, n(p.R));
        let t55 = n(p.yc).mul_add(t12, n(p.xc) * t10) - t16;
        let t56 = t13 + t12 - t48;
        let t57 = t11 + t10 - t49;
        let t58 = n(p.k24) * (n(p.k22) * t31.mul_add(t42, t34 * t41));
        let t59 = t35.neg_mul_add(t51, t43);
        let t60 = t39.mul_add(t51, t47);
        let t61 = cos_phi1.mul_sub(t52, t26 * n(p.k28));
        let t62 = sin_phi1.mul_add(t53, t61);
        let t63 = t28.neg_mul_add(t53, t22.mul_add(t52, t33 * t14));
        let t64 = t35.mul_add(t58, n(p.k26) * t42);
        let t65 = t39.mul_add(t58, n(p.k26) * t41);
        let t66 = n(p.k24) * sin_phi1.neg_mul_add(t35, t54);
        let t67 = t39.neg_mul_add(t57, t31.mul_add(t48, t55));
        let t68 = t35.mul_sub(t56, t34 * t49) + t67;
        let t69 = sin_phi1.mul_add(t60, cos_phi1.mul_add(t59, n(p.k28)));
        let t70 = s1.mul_add(t63, t46 * n(p.R));
        let t71 = n(p.k25) * t68;
        let t72 = t19.neg_mul_add(t63, cos_phi1.neg_mul_add(t62, t52));
        let t73 = sin_phi1.neg_mul_add(t62, t20.mul_add(t63, t53));
        let t74 = t28.neg_mul_add(t65, t22.neg_mul_add(t64, t14 * t40));
        let t75 = cos_phi1.mul_add(t64, n(p.k28) * t38);
        let t76 = sin_phi1.neg_mul_add(t65, t75);
        let t77 = t31.mul_add(t71, t56);
        let t78 = t34.neg_mul_add(t71, t57);
        let t79 = sin_phi2.mul_add(t73, cos_phi2.mul_add(t72, n(p.k27)));
        let t80 = t47.mul_add(t77, t9 * N::from_f64(2.0));
        let t81 = N::ONE / t79;
        let t82 = n(p.k1) * t72.mul_sub(t21, t73 * t25);
        let t83 = cos_phi1.neg_mul_add(t76, t19.mul_add(t74, t64));
        let t84 = t22.mul_add(t35.neg_mul_add(t66, t47), s1 * t14);
        let t85 = t43.mul_add(t77, phi1_dot * (s1 * phi1_dot));
        let t86 = t21.mul_add(t83, n(p.k1) * (t1 * (n(p.k27) * t1)));
        let t87 = t20.mul_add(t74, sin_phi1.mul_add(t76, t65));
        let t88 = t28.mul_add(t39.neg_mul_add(t66, t43), t84);
        let t89 = s1.mul_add(t88, n(p.R).mul_add(t66, n(p.k32)));
        let t90 = n(p.k1).mul_add(t25.mul_add(t87, t86), n(p.k29));
        let t91 = t81 * t82;
        let t92 = t62 * t81;
        let t93 = t81 * t70;
        let t94 = t82.neg_mul_add(t91, t90);
        let t95 = t82.neg_mul_add(t92, t76);
        let t96 = s1.mul_add(t74, t58.mul_add(n(p.R), n(p.k31)));
        let t97 = t82.mul_add(t93, t96);
        let t98 = s1.mul_add(t22.mul_sub(t59, t28 * t60), t51 * n(p.R));
        let t99 = t1 * (phi2_dot * (n(p.k30) * s2_dot));
        let t100 = t91.neg_mul_add(t15, t99);
        let t101 = t68.mul_add(n(p.k33), t9) - t43.neg_mul_add(t78, t80);
        let t102 = N::ONE / t94;
        let t103 = t102 * t95;
        let t104 = t102 * t97;
        let t105 = t95.neg_mul_add(t103, t62.neg_mul_add(t92, t69));
        let t106 = t95.mul_add(t104, t62.neg_mul_add(t93, t98));
        let t107 = t92.neg_mul_add(t15, t47.mul_add(t78, t85));
        let t108 = t103.neg_mul_add(t100, t107);
        let t109 = N::ONE / t105;
        let t110 = t109 * t106;
        let t111 = t104.neg_mul_add(t100, t93.mul_add(t15, t101));
        let t112 = t97.neg_mul_add(t104, t70.neg_mul_add(t93, t89));
        let t113 = t106.neg_mul_add(t110, t112);
        let t114 = t110.mul_add(t108, t111) / t113;
        let lambda3 = t110.mul_add(t114, t109 * t108);
        let t115 = t104.neg_mul_add(t114, t102 * t100);
        let t116 = t103 * lambda3;
        let t117 = t92.neg_mul_add(lambda3, t93.mul_add(t114, t81 * t15));
        let lambda1 = t91.neg_mul_add(t115 - t116, t117);
        let lambda2 = t116 - t115;
        let lambda4 = -t114;
        let sound = PIVOTS.hold(n(p.J1), n(p.J1))
            & PIVOTS.hold(n(p.J2), n(p.J2))
            & PIVOTS.hold(n(p.m2), n(p.m2))
            & PIVOTS.hold(t17, t17)
            & PIVOTS.hold(n(p.m1), n(p.k10))
            & PIVOTS.hold(t18, t18)
            & PIVOTS.hold(n(p.k21), n(p.k13))
            & PIVOTS.hold(n(p.k21), n(p.k13))
            & PIVOTS.hold(n(p.k23), n(p.k16))
            & PIVOTS.hold(t79, t79)
            & PIVOTS.hold(t94, t90)
            & PIVOTS.hold(t105, t69)
            & PIVOTS.hold(t113, t89)
            & lambda1.is_finite();
        if !sound {
            let pivots = [
                (5, n(p.J1), n(p.J1)),
                (8, n(p.J2), n(p.J2)),
                (6, n(p.m2), n(p.m2)),
                (7, t17, t17),
                (3, n(p.m1), n(p.k10)),
                (4, t18, t18),
                (1, n(p.k21), n(p.k13)),
                (0, n(p.k21), n(p.k13)),
                (2, n(p.k23), n(p.k16)),
                (9, t79, t79),
                (10, t94, t90),
                (11, t105, t69),
                (12, t113, t89),
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
    let t8 = x_dot - t3 * sin_theta - cos_theta * t5 - p.k3 * (sin_t0 + t4 * cos_t0);
    let t9 = y_dot + t3 * cos_theta - sin_theta * t5;
    let t10 = p.k3 * (cos_t0 - t4 * sin_t0) + t9;
    let t11 = cos_phi2 * s2_dot - t2 * sin_phi2 + t6;
    let t12 = t2 * cos_phi2 + sin_phi2 * s2_dot + t7;
    let t13 = (y_dot * y_dot + x_dot * x_dot) * p.m + theta_dot * (theta_dot * p.J);
    let t14 = (t7 * t7 + t6 * t6) * p.m1 + theta1_dot * (theta1_dot * p.J1) + t13;
    let t15 = (t12 * t12 + t11 * t11) * p.m2 + theta2_dot * (theta2_dot * p.J2) + t14;
    ((t10 * t10 + t8 * t8) * p.m0 + p.k4 + t15) * S::from_f64(0.5)
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
    (t5 * t5 + t3 * t3) * p.k6 + (t4 * t4 + t2 * t2) * p.k5
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
    (t5 * t5 + t3 * t3) * p.k8 + (t4 * t4 + t2 * t2) * p.k7
}

/// Power `P` that drives, forces and inputs put in, in W.
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
    let t7 = t6 * (t5 * p.k9 - (y_ddot - t3 * p.y0 - t4 * p.x0));
    (t5 * (t6 * p.k9 - (t4 * p.y0 + x_ddot - p.x0 * t3)) - t7) * p.k15
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

/// Spin of a grain. Unit: `rad/s`.
///
/// ```text
/// grain_spin = der(phi2) + 2*rho*(der(theta1) - der(phi2))/delta
/// ```
pub fn output_grain_spin<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, v: &[S; 9]) -> S {
    let theta1_dot = v[5];
    let phi2_dot = v[7];
    phi2_dot + p.k2 * (theta1_dot - phi2_dot)
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
    inputs Inputs {} []
    outputs Outputs { grain_spin } [
        grain_spin: "grain_spin" "rad/s";
    ]
    prepared Prepared {
        m, m0, m1, m2, J, J1, J2, x0, y0, omega, cx, cy, bx, by, xc, yc, R, r1, rho, r2, k0, k1, k2,
        k3, k4, k5, k6, k7, k8, k9, k10, k11, k12, k13, k14, k15, k16, k17, k18, k19, k20, k21, k22,
        k23, k24, k25, k26, k27, k28, k29, k30, k31, k32, k33, k34, k35, k36, k37, k38, k39, k40,
        k41, k42, k43, k44, k45, k46, k47, k48,
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
