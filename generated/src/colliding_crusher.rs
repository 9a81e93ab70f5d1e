// @generated from machines/contacts/colliding_crusher.machine by `cargo xtask generate`; edits
// are lost.

//! The vibrating crusher from rest, with unilateral contacts: the mortar collides with the cylinder
//! of the platform, the
//! pestle with the bore of the mortar. Mortar and pestle have fixed axes, so that one may pass
//! through the centre of
//! the other; the platform turns by small angles.
//!
//! 9 coordinates, 22 parameters, 10 outputs. Arithmetic of one call:
//!
//! | function | mul | add | div | sin cos | other | temporaries |
//! | --- | --: | --: | --: | --: | --: | --: |
//! | `prepare` | 24 | 21 | 2 | 0 | 0 | 47 |
//! | `bias` | 8 | 3 | 0 | 1 | 0 | 13 |
//! | `applied` | 14 | 19 | 0 | 0 | 0 | 33 |
//! | `forces` | 22 | 23 | 0 | 1 | 0 | 47 |
//! | `accelerations` | 29 | 25 | 0 | 1 | 0 | 56 |
//! | `gaps` | 4 | 8 | 0 | 0 | 2 | 14 |
//! | `contact_rates` | 20 | 20 | 2 | 0 | 2 | 44 |
//! | `contact_matrix` | 8 | 10 | 2 | 0 | 2 | 22 |
//! | `contact_bias` | 26 | 20 | 4 | 0 | 2 | 52 |
//! | `kinetic_energy` | 27 | 16 | 0 | 1 | 0 | 45 |
//! | `potential_energy` | 7 | 7 | 0 | 0 | 0 | 14 |
//! | `dissipation` | 7 | 7 | 0 | 0 | 0 | 14 |
//! | `work_rate` | 11 | 7 | 0 | 1 | 0 | 20 |
//! | `dissipation_rate` | 7 | 7 | 0 | 0 | 0 | 14 |
//! | `output_s1` | 2 | 3 | 0 | 0 | 1 | 6 |
//! | `output_s2` | 2 | 3 | 0 | 0 | 1 | 6 |
//! | `output_ground_force` | 6 | 3 | 0 | 0 | 1 | 10 |
//! | `output_R_theta` | 9 | 6 | 1 | 0 | 1 | 17 |
//! | `output_R_s1` | 8 | 7 | 1 | 0 | 1 | 17 |
//! | `output_R_phi1` | 6 | 5 | 0 | 0 | 0 | 11 |
//! | `output_R_theta1` | 1 | 0 | 0 | 0 | 0 | 1 |
//! | `output_R_s2` | 5 | 4 | 1 | 0 | 1 | 11 |
//! | `output_R_phi2` | 3 | 3 | 0 | 0 | 0 | 6 |
//! | `output_R_theta2` | 1 | 0 | 0 | 0 | 0 | 1 |
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

/// The vibrating crusher from rest, with unilateral contacts: the mortar collides with the cylinder
/// of the platform, the
/// pestle with the bore of the mortar. Mortar and pestle have fixed axes, so that one may pass
/// through the centre of
/// the other; the platform turns by small angles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CollidingCrusher<S = f64> {
    /// Mass and inertia of the platform. Unit: `kg`. Default: 600.
    pub m: S,
    /// `J`. Unit: `kg*m^2`. Default: 60.
    pub J: S,
    /// Mass of the debalance, its eccentricity, its axis on the platform, its speed. Unit: `kg`.
    /// Default: 40.
    pub m0: S,
    /// `e`. Unit: `m`. Default: 0.1.
    pub e: S,
    /// `x0`. Unit: `m`. Default: 0.05.
    pub x0: S,
    /// `y0`. Unit: `m`. Default: 0.03.
    pub y0: S,
    /// `w`. Unit: `rad/s`. Default: 50*pi.
    pub w: S,
    /// Mass and inertia of the mortar, and of the pestle. Unit: `kg`. Default: 180.
    pub m1: S,
    /// `J1`. Unit: `kg*m^2`. Default: 9.225.
    pub J1: S,
    /// `m2`. Unit: `kg`. Default: 120.
    pub m2: S,
    /// `J2`. Unit: `kg*m^2`. Default: 1.536.
    pub J2: S,
    /// Stiffness and damping of the suspension along each axis, and where its four corners are.
    /// Unit: `N/m`. Default: 600000.
    pub c: S,
    /// `b`. Unit: `N*s/m`. Default: 3000.
    pub b: S,
    /// `xc`. Unit: `m`. Default: 0.4.
    pub xc: S,
    /// `yc`. Unit: `m`. Default: 0.3.
    pub yc: S,
    /// Radii of the cylinder, of the mortar, of its bore, and of the pestle. Unit: `m`.
    /// Default: 0.27.
    pub R: S,
    /// `r1`. Unit: `m`. Default: 0.25.
    pub r1: S,
    /// `rho`. Unit: `m`. Default: 0.2.
    pub rho: S,
    /// `r2`. Unit: `m`. Default: 0.16.
    pub r2: S,
    /// Thickness of the bed in the bore. Unit: `m`. Default: 0.01.
    pub delta: S,
    /// Restitution and friction of both contacts. Unit: `1`. Default: 0.5.
    pub eN: S,
    /// `mu`. Unit: `1`. Default: 0.3.
    pub mu: S,
}

impl<S: ::lagrangian::emitted::Scalar> CollidingCrusher<S> {
    /// Computes what depends on the parameters alone, once.
    pub fn prepare(&self) -> Prepared<S> {
        let m_plus_m0 = self.m + self.m0;
        let m0_x0 = self.x0 * self.m0;
        let t0 = self.y0 * self.m0;
        let e_w = self.w * self.e;
        let rho_minus_delta = self.rho - self.delta;
        let t1 = S::ONE / m_plus_m0;
        let e_w_squared = self.w * e_w;
        let k0 = self.J + self.x0 * m0_x0 + self.y0 * t0;
        let m0_e_w_squared = e_w_squared * self.m0;
        let m0_e_x0_w_squared = e_w_squared * m0_x0;
        let m0_e_y0_w_squared = e_w_squared * t0;
        let t2 = m0_x0 * t1;
        let t3 = t0 * t1;
        let t4 = S::ONE - self.m0 * t1;
        let pivot_2 = k0 - m0_x0 * t2 - t0 * t3;
        let t5 = S::ONE / pivot_2;
        let quarter_c = self.c * S::from_f64(0.25);
        let quarter_b = self.b * S::from_f64(0.25);
        let half_m0 = self.m0 * S::from_f64(0.5);
        let half_c = self.c * S::from_f64(0.5);
        let half_b = self.b * S::from_f64(0.5);
        let R_minus_r1 = self.R - self.r1;
        let rho_minus_r2_minus_delta = rho_minus_delta - self.r2;
        let minus_m0_y0 = -t0;
        let minus_m0_e_w_squared = -m0_e_w_squared;
        let minus_R = -self.R;
        let k1 = self.delta - self.rho;
        let minus_m0_e_w = -(e_w * self.m0);
        let minus_m2 = -self.m2;
        let k2 = m0_e_x0_w_squared * t4;
        let k3 = m0_e_y0_w_squared * t4;
        let k4 = self.xc + t2;
        let k5 = self.xc - t2;
        let k6 = self.yc + t3;
        let k7 = self.yc - t3;
        let k8 = t0 * t5;
        let k9 = m0_x0 * t5;
        let k10 = -t1;
        let k11 = -t5;
        let pivots = [
            (3, self.m1, self.m1),
            (4, self.m1, self.m1),
            (5, self.J1, self.J1),
            (6, self.m2, self.m2),
            (7, self.m2, self.m2),
            (8, self.J2, self.J2),
            (1, m_plus_m0, m_plus_m0),
            (0, m_plus_m0, m_plus_m0),
            (2, pivot_2, k0),
        ];
        Prepared {
            m: self.m,
            J: self.J,
            x0: self.x0,
            y0: self.y0,
            w: self.w,
            m1: self.m1,
            J1: self.J1,
            m2: self.m2,
            J2: self.J2,
            c: self.c,
            b: self.b,
            xc: self.xc,
            yc: self.yc,
            R: self.R,
            r1: self.r1,
            r2: self.r2,
            eN: self.eN,
            mu: self.mu,
            rho_minus_delta,
            e_w,
            quarter_c,
            quarter_b,
            e_w_squared,
            m0_e_w_squared,
            half_m0,
            m_plus_m0,
            m0_x0,
            k0,
            m0_e_x0_w_squared,
            m0_e_y0_w_squared,
            half_c,
            half_b,
            R_minus_r1,
            rho_minus_r2_minus_delta,
            minus_m0_y0,
            minus_m0_e_w_squared,
            minus_R,
            k1,
            minus_m0_e_w,
            minus_m2,
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
            singular: PIVOTS.vanished(pivots),
        }
    }

    /// The start values of the description, at rest and `t = 0`.
    pub fn start(&self) -> ::lagrangian::emitted::State<Coordinates<S>> {
        let x1 = S::from_ratio(1, 500);
        let zero = S::ZERO;
        let y2 = S::from_ratio(3, 1000);
        let q = [zero, zero, zero, x1, zero, zero, x1, y2, zero];
        let v = [S::ZERO; 9];
        ::lagrangian::emitted::State {
            t: 0.0,
            q: Coordinates::from_array(q),
            v: Coordinates::from_array(v),
        }
    }
}

/// The coordinates of [`CollidingCrusher`], or their rates, by name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coordinates<S = f64> {
    /// `x`. Unit: `m`.
    pub x: S,
    /// `y`. Unit: `m`.
    pub y: S,
    /// `theta`. Unit: `rad`.
    pub theta: S,
    /// `x1`. Unit: `m`.
    pub x1: S,
    /// `y1`. Unit: `m`.
    pub y1: S,
    /// `theta1`. Unit: `rad`.
    pub theta1: S,
    /// `x2`. Unit: `m`.
    pub x2: S,
    /// `y2`. Unit: `m`.
    pub y2: S,
    /// `theta2`. Unit: `rad`.
    pub theta2: S,
}

/// What can be observed of a [`CollidingCrusher`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outputs<S = f64> {
    /// `s1`. Unit: `m`.
    pub s1: S,
    /// `s2`. Unit: `m`.
    pub s2: S,
    /// `ground_force`. Unit: `N`.
    pub ground_force: S,
    /// The generalized reactions of both contacts along θ, s₁, φ₁, θ₁, s₂, φ₂ and θ₂ of the crusher
    /// in polar coordinates; those along x
    /// and y are 0, for contacts within the whole move none of it. Unit: `N*m`.
    pub R_theta: S,
    /// `R_s1`. Unit: `N`.
    pub R_s1: S,
    /// `R_phi1`. Unit: `N*m`.
    pub R_phi1: S,
    /// `R_theta1`. Unit: `N*m`.
    pub R_theta1: S,
    /// `R_s2`. Unit: `N`.
    pub R_s2: S,
    /// `R_phi2`. Unit: `N*m`.
    pub R_phi2: S,
    /// `R_theta2`. Unit: `N*m`.
    pub R_theta2: S,
}

/// The parameters of a [`CollidingCrusher`], with the work done that depends on them alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prepared<S = f64> {
    /// `m`
    m: S,
    /// `J`
    J: S,
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
    /// `c`
    c: S,
    /// `b`
    b: S,
    /// `xc`
    xc: S,
    /// `yc`
    yc: S,
    /// `R`
    R: S,
    /// `r1`
    r1: S,
    /// `r2`
    r2: S,
    /// `eN`
    eN: S,
    /// `mu`
    mu: S,
    /// `rho - delta`
    rho_minus_delta: S,
    /// `e*w`
    e_w: S,
    /// `0.25*c`
    quarter_c: S,
    /// `0.25*b`
    quarter_b: S,
    /// `e*w^2`
    e_w_squared: S,
    /// `m0*e*w^2`
    m0_e_w_squared: S,
    /// `0.5*m0`
    half_m0: S,
    /// `m + m0`
    m_plus_m0: S,
    /// `m0*x0`
    m0_x0: S,
    /// `J + m0*x0^2 + m0*y0^2`
    k0: S,
    /// `m0*e*x0*w^2`
    m0_e_x0_w_squared: S,
    /// `m0*e*y0*w^2`
    m0_e_y0_w_squared: S,
    /// `0.5*c`
    half_c: S,
    /// `0.5*b`
    half_b: S,
    /// `R - r1`
    R_minus_r1: S,
    /// `rho - r2 - delta`
    rho_minus_r2_minus_delta: S,
    /// `-m0*y0`
    minus_m0_y0: S,
    /// `-m0*e*w^2`
    minus_m0_e_w_squared: S,
    /// `-R`
    minus_R: S,
    /// `-(rho - delta)`
    k1: S,
    /// `-m0*e*w`
    minus_m0_e_w: S,
    /// `-m2`
    minus_m2: S,
    /// `m0*e*x0*w^2*(1 - m0/(m + m0))`
    k2: S,
    /// `m0*e*y0*w^2*(1 - m0/(m + m0))`
    k3: S,
    /// `xc + m0*x0/(m + m0)`
    k4: S,
    /// `xc - m0*x0/(m + m0)`
    k5: S,
    /// `yc + m0*y0/(m + m0)`
    k6: S,
    /// `yc - m0*y0/(m + m0)`
    k7: S,
    /// `m0*y0/(J + m0*x0^2 + m0*y0^2 - m0^2*x0^2/(m + m0) - m0^2*y0^2/(m + m0))`
    k8: S,
    /// `m0*x0/(J + m0*x0^2 + m0*y0^2 - m0^2*x0^2/(m + m0) - m0^2*y0^2/(m + m0))`
    k9: S,
    /// `-1/(m + m0)`
    k10: S,
    /// `-1/(J + m0*x0^2 + m0*y0^2 - m0^2*x0^2/(m + m0) - m0^2*y0^2/(m + m0))`
    k11: S,
    /// Why these parameters leave the machine without accelerations, if they do.
    singular: Option<::lagrangian::emitted::Singular>,
}

/// A pivot of an elimination that is not above this share of its diagonal element may be rounding
/// errors alone.
const PIVOTS: ::lagrangian::emitted::Pivots = ::lagrangian::emitted::Pivots::new(9, 9);

/// Mass matrix `M`.
///
/// ```text
/// M[x, x] = m + m0
/// M[y, y] = m + m0
/// M[theta, x] = -m0*y0
/// M[theta, y] = m0*x0
/// M[theta, theta] = J + m0*x0^2 + m0*y0^2
/// M[x1, x1] = m1
/// M[y1, y1] = m1
/// M[theta1, theta1] = J1
/// M[x2, x2] = m2
/// M[y2, y2] = m2
/// M[theta2, theta2] = J2
/// ```
pub fn mass_matrix<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>) -> [[S; 9]; 9] {
    let zero = S::ZERO;
    [
        [
            p.m_plus_m0,
            zero,
            p.minus_m0_y0,
            zero,
            zero,
            zero,
            zero,
            zero,
            zero,
        ],
        [
            zero,
            p.m_plus_m0,
            p.m0_x0,
            zero,
            zero,
            zero,
            zero,
            zero,
            zero,
        ],
        [
            p.minus_m0_y0,
            p.m0_x0,
            p.k0,
            zero,
            zero,
            zero,
            zero,
            zero,
            zero,
        ],
        [zero, zero, zero, p.m1, zero, zero, zero, zero, zero],
        [zero, zero, zero, zero, p.m1, zero, zero, zero, zero],
        [zero, zero, zero, zero, zero, p.J1, zero, zero, zero],
        [zero, zero, zero, zero, zero, zero, p.m2, zero, zero],
        [zero, zero, zero, zero, zero, zero, zero, p.m2, zero],
        [zero, zero, zero, zero, zero, zero, zero, zero, p.J2],
    ]
}

/// Bias `h`: velocity products and explicit time in the inertia forces.
///
/// ```text
/// h[x] = -m0*e*w^2*cos(w*t)
/// h[y] = -m0*e*w^2*sin(w*t)
/// h[theta] = m0*e*y0*w^2*cos(w*t) - m0*e*x0*w^2*sin(w*t)
/// ```
pub fn bias<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, t: S) -> [S; 9] {
    let t0 = p.w * t;
    let t1 = p.w.product_error(t);
    let (sin_t0, cos_t0) = t0.sin_cos();
    let t2 = sin_t0 + t1 * cos_t0;
    let t3 = cos_t0 - t1 * sin_t0;
    let h_x = p.minus_m0_e_w_squared * t3;
    let h_y = p.minus_m0_e_w_squared * t2;
    let h_theta = t3 * p.m0_e_y0_w_squared - t2 * p.m0_e_x0_w_squared;
    let zero = S::ZERO;
    [h_x, h_y, h_theta, zero, zero, zero, zero, zero, zero]
}

/// Applied generalized forces `Q`.
///
/// ```text
/// Q[x] = -b*der(x) - c*x
/// Q[y] = -b*der(y) - c*y
/// Q[theta] = -(xc^2 + yc^2)*b*der(theta) - (xc^2 + yc^2)*c*theta
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
    let t1 = theta_dot * p.yc;
    let t2 = theta * p.xc;
    let t3 = theta_dot * p.xc;
    let t4 = p.half_b * (x_dot - t1) + p.half_c * (x - t0);
    let t5 = p.half_b * (t1 + x_dot) + p.half_c * (t0 + x);
    let t6 = p.half_b * (t3 + y_dot) + p.half_c * (t2 + y);
    let t7 = p.half_b * (y_dot - t3) + p.half_c * (y - t2);
    let q_x = -(t4 + t5);
    let q_y = -(t6 + t7);
    let q_theta = p.xc * (t7 - t6) - p.yc * (t5 - t4);
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
    let x_dot = v[0];
    let y_dot = v[1];
    let theta_dot = v[2];
    let t0 = p.w * t;
    let t1 = theta * p.xc;
    let t2 = p.yc * theta;
    let t3 = theta_dot * p.xc;
    let t4 = theta_dot * p.yc;
    let t5 = p.w.product_error(t);
    let (sin_t0, cos_t0) = t0.sin_cos();
    let t6 = p.half_b * (t3 + y_dot) + p.half_c * (t1 + y);
    let t7 = p.half_b * (y_dot - t3) + p.half_c * (y - t1);
    let t8 = p.half_b * (x_dot - t4) + p.half_c * (x - t2);
    let t9 = p.half_b * (t4 + x_dot) + p.half_c * (t2 + x);
    let t10 = cos_t0 - t5 * sin_t0;
    let t11 = sin_t0 + t5 * cos_t0;
    let t12 = t10 * p.m0_e_y0_w_squared + (p.yc * (t9 - t8) - p.xc * (t7 - t6));
    let f_x = p.m0_e_w_squared * t10 - (t8 + t9);
    let f_y = p.m0_e_w_squared * t11 - (t6 + t7);
    let f_theta = t11 * p.m0_e_x0_w_squared - t12;
    let zero = S::ZERO;
    [f_x, f_y, f_theta, zero, zero, zero, zero, zero, zero]
}

::lagrangian::emitted::fast_function! {
    /// Accelerations `a`, the solution of `M a = f` eliminated along the machine.
    ///
    /// A pivot that vanishes is an error.
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
    let x_dot = n(v[0]);
    let y_dot = n(v[1]);
    let theta_dot = n(v[2]);
    let t0 = n(p.w) * n(t);
    let t1 = theta * n(p.xc);
    let t2 = n(p.yc) * theta;
    let t3 = theta_dot * n(p.xc);
    let t4 = theta_dot * n(p.yc);
    let t5 = n(p.w).product_error(n(t));
    let (sin_t0, cos_t0) = t0.sin_cos();
    let t6 = n(p.half_b).mul_add(t3 + y_dot, n(p.half_c) * (t1 + y));
    let t7 = n(p.half_b).mul_add(y_dot - t3, n(p.half_c) * (y - t1));
    let t8 = n(p.half_b).mul_add(t4 + x_dot, n(p.half_c) * (t2 + x));
    let t9 = n(p.half_b).mul_add(x_dot - t4, n(p.half_c) * (x - t2));
    let t10 = n(p.k7).mul_add(t9, n(p.k4) * t7);
    let t11 = t5.neg_mul_add(sin_t0, cos_t0);
    let t12 = t5.mul_add(cos_t0, sin_t0);
    let t13 = n(p.k6).mul_add(t8, n(p.k5) * t6) - t10;
    let t14 = t12.neg_mul_add(n(p.k2), t11.mul_add(n(p.k3), t13));
    let t15 = t11.neg_mul_add(n(p.m0_e_w_squared), t9 + t8);
    let t16 = t12.neg_mul_add(n(p.m0_e_w_squared), t6 + t7);
    // Back substitution: a[x].
    let x_ddot = n(p.k10) * t14.mul_add(n(p.k8), t15);
    // Back substitution: a[y].
    let y_ddot = n(p.k10) * t14.neg_mul_add(n(p.k9), t16);
    let theta_ddot = t14 * n(p.k11);
    let zero = N::ZERO;
    let accelerations = [
        x_ddot.store(),
        y_ddot.store(),
        theta_ddot.store(),
        zero.store(),
        zero.store(),
        zero.store(),
        zero.store(),
        zero.store(),
        zero.store(),
    ];
    Ok(accelerations)
}

/// Gaps `g` of the unilateral contacts, in m: positive where they are open.
///
/// ```text
/// [outer] = R - sqrt((x1 - x)^2 + (y1 - y)^2) - r1
/// [inner] = rho - sqrt((x2 - x1)^2 + (y2 - y1)^2) - r2 - delta
/// ```
pub fn gaps<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 9]) -> [S; 2] {
    let x = q[0];
    let y = q[1];
    let x1 = q[3];
    let y1 = q[4];
    let x2 = q[6];
    let y2 = q[7];
    let t0 = x - x1;
    let t1 = x1 - x2;
    let t2 = y - y1;
    let t3 = y1 - y2;
    let gap1 = p.R_minus_r1 - (t2 * t2 + t0 * t0).sqrt();
    let gap2 = p.rho_minus_r2_minus_delta - (t3 * t3 + t1 * t1).sqrt();
    [gap1, gap2]
}

/// Rates `gamma` at which the gaps of unilateral contacts open and at which these slip, in m/s.
///
/// ```text
/// [outer.gap] = -1/2*(2*(x1 - x)*(der(x1) - der(x)) + 2*(y1 - y)*(der(y1) - der(y)))/sqrt((x1 -
///     x)^2 + (y1 - y)^2)
/// [outer.slip] = r1*der(theta1) - R*der(theta)
///     + ((x1 - x)*(der(y1) - der(y)) - (y1 - y)*(der(x1) - der(x)))/sqrt((x1 - x)^2 + (y1 - y)^2)
/// [inner.gap] = -1/2*(2*(x2 - x1)*(der(x2) - der(x1)) + 2*(y2 - y1)*(der(y2) - der(y1)))/sqrt((x2
///     - x1)^2 + (y2 - y1)^2)
/// [inner.slip] = r2*der(theta2) - (rho - delta)*der(theta1) + ((x2 - x1)*(der(y2) - der(y1)) - (y2
///     - y1)*(der(x2) - der(x1)))/sqrt((x2 - x1)^2 + (y2 - y1)^2)
/// ```
pub fn contact_rates<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 9],
    v: &[S; 9],
) -> [S; 4] {
    let x = q[0];
    let y = q[1];
    let x1 = q[3];
    let y1 = q[4];
    let x2 = q[6];
    let y2 = q[7];
    let x_dot = v[0];
    let y_dot = v[1];
    let theta_dot = v[2];
    let x1_dot = v[3];
    let y1_dot = v[4];
    let theta1_dot = v[5];
    let x2_dot = v[6];
    let y2_dot = v[7];
    let theta2_dot = v[8];
    let t0 = x - x1;
    let t1 = x1 - x2;
    let t2 = y - y1;
    let t3 = y1 - y2;
    let t4 = x_dot - x1_dot;
    let t5 = x1_dot - x2_dot;
    let t6 = y_dot - y1_dot;
    let t7 = y1_dot - y2_dot;
    let t8 = S::ONE / (t2 * t2 + t0 * t0).sqrt();
    let t9 = S::ONE / (t3 * t3 + t1 * t1).sqrt();
    let t10 = theta2_dot * p.r2 - theta1_dot * p.rho_minus_delta;
    let rate1 = -(t8 * (t2 * t6 + t0 * t4));
    let rate2 = t8 * (t0 * t6 - t2 * t4) + (theta1_dot * p.r1 - theta_dot * p.R);
    let rate3 = -(t9 * (t3 * t7 + t1 * t5));
    let rate4 = t9 * (t1 * t7 - t3 * t5) + t10;
    [rate1, rate2, rate3, rate4]
}

/// Derivatives of the rates of unilateral contacts by the rates of the coordinates.
///
/// ```text
/// [outer.gap, x] = (x1 - x)/sqrt((x1 - x)^2 + (y1 - y)^2)
/// [outer.gap, y] = (y1 - y)/sqrt((x1 - x)^2 + (y1 - y)^2)
/// [outer.gap, x1] = -(x1 - x)/sqrt((x1 - x)^2 + (y1 - y)^2)
/// [outer.gap, y1] = -(y1 - y)/sqrt((x1 - x)^2 + (y1 - y)^2)
/// [outer.slip, x] = (y1 - y)/sqrt((x1 - x)^2 + (y1 - y)^2)
/// [outer.slip, y] = -(x1 - x)/sqrt((x1 - x)^2 + (y1 - y)^2)
/// [outer.slip, theta] = -R
/// [outer.slip, x1] = -(y1 - y)/sqrt((x1 - x)^2 + (y1 - y)^2)
/// [outer.slip, y1] = (x1 - x)/sqrt((x1 - x)^2 + (y1 - y)^2)
/// [outer.slip, theta1] = r1
/// [inner.gap, x1] = (x2 - x1)/sqrt((x2 - x1)^2 + (y2 - y1)^2)
/// [inner.gap, y1] = (y2 - y1)/sqrt((x2 - x1)^2 + (y2 - y1)^2)
/// [inner.gap, x2] = -(x2 - x1)/sqrt((x2 - x1)^2 + (y2 - y1)^2)
/// [inner.gap, y2] = -(y2 - y1)/sqrt((x2 - x1)^2 + (y2 - y1)^2)
/// [inner.slip, x1] = (y2 - y1)/sqrt((x2 - x1)^2 + (y2 - y1)^2)
/// [inner.slip, y1] = -(x2 - x1)/sqrt((x2 - x1)^2 + (y2 - y1)^2)
/// [inner.slip, theta1] = delta - rho
/// [inner.slip, x2] = -(y2 - y1)/sqrt((x2 - x1)^2 + (y2 - y1)^2)
/// [inner.slip, y2] = (x2 - x1)/sqrt((x2 - x1)^2 + (y2 - y1)^2)
/// [inner.slip, theta2] = r2
/// ```
pub fn contact_matrix<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 9]) -> [S; 36] {
    let x = q[0];
    let y = q[1];
    let x1 = q[3];
    let y1 = q[4];
    let x2 = q[6];
    let y2 = q[7];
    let t0 = x - x1;
    let t1 = x1 - x2;
    let t2 = y - y1;
    let t3 = y1 - y2;
    let t4 = S::ONE / (t2 * t2 + t0 * t0).sqrt();
    let t5 = S::ONE / (t3 * t3 + t1 * t1).sqrt();
    let w1_4 = t0 * t4;
    let w1_5 = t2 * t4;
    let w3_7 = t1 * t5;
    let w3_8 = t3 * t5;
    let w1_1 = -w1_4;
    let w1_2 = -w1_5;
    let w3_4 = -w3_7;
    let w3_5 = -w3_8;
    let zero = S::ZERO;
    [
        w1_1, w1_2, zero, w1_4, w1_5, zero, zero, zero, zero, w1_2, w1_4, p.minus_R, w1_5, w1_1,
        p.r1, zero, zero, zero, zero, zero, zero, w3_4, w3_5, zero, w3_7, w3_8, zero, zero, zero,
        zero, w3_5, w3_7, p.k1, w3_8, w3_4, p.r2,
    ]
}

/// Rates `dgamma/dt` of unilateral contacts where all accelerations are 0.
///
/// ```text
/// [outer.gap] = 1/4*(2*(x1 - x)*(der(x1) - der(x)) + 2*(y1 - y)*(der(y1) - der(y)))^2/(sqrt((x1 -
///     x)^2 + (y1 - y)^2)*((x1 - x)^2 + (y1 - y)^2))
///     - 1/2*(2*(der(x1) - der(x))^2 + 2*(der(y1) - der(y))^2)/sqrt((x1 - x)^2 + (y1 - y)^2)
/// [outer.slip] = -1/2*((x1 - x)*(der(y1) - der(y)) - (y1 - y)*(der(x1) - der(x)))*(2*(x1 -
///     x)*(der(x1) - der(x)) + 2*(y1 - y)*(der(y1) - der(y)))/(sqrt((x1 - x)^2 + (y1 - y)^2)*((x1 -
///     x)^2 + (y1 - y)^2))
/// [inner.gap] = 1/4*(2*(x2 - x1)*(der(x2) - der(x1)) + 2*(y2 - y1)*(der(y2) -
///     der(y1)))^2/(sqrt((x2 - x1)^2 + (y2 - y1)^2)*((x2 - x1)^2 + (y2 - y1)^2))
///     - 1/2*(2*(der(x2) - der(x1))^2 + 2*(der(y2) - der(y1))^2)/sqrt((x2 - x1)^2 + (y2 - y1)^2)
/// [inner.slip] = -1/2*((x2 - x1)*(der(y2) - der(y1)) - (y2 - y1)*(der(x2) - der(x1)))*(2*(x2 -
///     x1)*(der(x2) - der(x1)) + 2*(y2 - y1)*(der(y2) - der(y1)))/(sqrt((x2 - x1)^2 + (y2 -
///     y1)^2)*((x2 - x1)^2 + (y2 - y1)^2))
/// ```
pub fn contact_bias<S: ::lagrangian::emitted::Scalar>(q: &[S; 9], v: &[S; 9]) -> [S; 4] {
    let x = q[0];
    let y = q[1];
    let x1 = q[3];
    let y1 = q[4];
    let x2 = q[6];
    let y2 = q[7];
    let x_dot = v[0];
    let y_dot = v[1];
    let x1_dot = v[3];
    let y1_dot = v[4];
    let x2_dot = v[6];
    let y2_dot = v[7];
    let t0 = x - x1;
    let t1 = x1 - x2;
    let t2 = y - y1;
    let t3 = y1 - y2;
    let t4 = x_dot - x1_dot;
    let t5 = x1_dot - x2_dot;
    let t6 = y_dot - y1_dot;
    let t7 = y1_dot - y2_dot;
    let t8 = t2 * t2 + t0 * t0;
    let t9 = t3 * t3 + t1 * t1;
    let t10 = t2 * t6 + t0 * t4;
    let t11 = t3 * t7 + t1 * t5;
    let t12 = S::ONE / t8 * t10;
    let t13 = S::ONE / t9 * t11;
    let t14 = S::ONE / t8.sqrt();
    let t15 = S::ONE / t9.sqrt();
    let bias1 = t14 * (t10 * t12 - (t6 * t6 + t4 * t4));
    let bias2 = -(t14 * (t12 * (t0 * t6 - t2 * t4)));
    let bias3 = t15 * (t11 * t13 - (t7 * t7 + t5 * t5));
    let bias4 = -(t15 * (t13 * (t1 * t7 - t3 * t5)));
    [bias1, bias2, bias3, bias4]
}

/// Coefficients of unilateral contacts: restitution along the normal and along the tangent (for
/// compliant contacts the parameters of their force), friction, static friction.
///
/// ```text
/// [outer.restitution] = eN
/// [outer.friction] = mu
/// [outer.static_friction] = mu
/// [inner.restitution] = eN
/// [inner.friction] = mu
/// [inner.static_friction] = mu
/// ```
pub fn contact_coefficients<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>) -> [S; 8] {
    let zero = S::ZERO;
    [p.eN, zero, p.mu, p.mu, p.eN, zero, p.mu, p.mu]
}

/// Kinetic energy `T`, in J.
///
/// ```text
/// T = 1/2*m*der(x)^2 + 1/2*m*der(y)^2 + 1/2*J*der(theta)^2 + 1/2*m1*der(x1)^2 + 1/2*m1*der(y1)^2
///     + 1/2*J1*der(theta1)^2 + 1/2*m2*der(x2)^2 + 1/2*m2*der(y2)^2 + 1/2*J2*der(theta2)^2 +
///     1/2*m0*((der(x) - y0*der(theta) - e*w*sin(w*t))^2 + (der(y) + x0*der(theta) +
///     e*w*cos(w*t))^2)
/// ```
pub fn kinetic_energy<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, t: S, v: &[S; 9]) -> S {
    let x_dot = v[0];
    let y_dot = v[1];
    let theta_dot = v[2];
    let x1_dot = v[3];
    let y1_dot = v[4];
    let theta1_dot = v[5];
    let x2_dot = v[6];
    let y2_dot = v[7];
    let theta2_dot = v[8];
    let t0 = p.w * t;
    let t1 = p.w.product_error(t);
    let (sin_t0, cos_t0) = t0.sin_cos();
    let t2 = (y1_dot * y1_dot + x1_dot * x1_dot) * p.m1;
    let t3 = (y2_dot * y2_dot + x2_dot * x2_dot) * p.m2;
    let t4 = (y_dot * y_dot + x_dot * x_dot) * p.m + theta_dot * (theta_dot * p.J);
    let t5 = t2 + theta1_dot * (theta1_dot * p.J1) + t4;
    let t6 = x_dot - theta_dot * p.y0 - p.e_w * (sin_t0 + t1 * cos_t0);
    let t7 = p.e_w * (cos_t0 - t1 * sin_t0) + (y_dot + theta_dot * p.x0);
    let t8 = (t3 + theta2_dot * (theta2_dot * p.J2) + t5) * S::from_f64(0.5);
    t8 + p.half_m0 * (t7 * t7 + t6 * t6)
}

/// Potential energy `V`, in J.
///
/// ```text
/// V = 1/2*c*x^2 + 1/2*c*y^2 + 1/2*(xc^2 + yc^2)*c*theta^2
/// ```
pub fn potential_energy<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 9]) -> S {
    let x = q[0];
    let y = q[1];
    let theta = q[2];
    let t0 = theta * p.yc;
    let t1 = theta * p.xc;
    let t2 = x - t0;
    let t3 = t1 + y;
    let t4 = t0 + x;
    let t5 = y - t1;
    (t4 * t4 + t2 * t2 + (t5 * t5 + t3 * t3)) * p.quarter_c
}

/// Dissipation function `D`, in W.
///
/// ```text
/// D = 1/2*b*der(x)^2 + 1/2*b*der(y)^2 + 1/2*(xc^2 + yc^2)*b*der(theta)^2
/// ```
pub fn dissipation<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, v: &[S; 9]) -> S {
    let x_dot = v[0];
    let y_dot = v[1];
    let theta_dot = v[2];
    let t0 = theta_dot * p.yc;
    let t1 = theta_dot * p.xc;
    let t2 = x_dot - t0;
    let t3 = t1 + y_dot;
    let t4 = t0 + x_dot;
    let t5 = y_dot - t1;
    (t4 * t4 + t2 * t2 + (t5 * t5 + t3 * t3)) * p.quarter_b
}

/// Power `P` supplied by drives, forces and inputs, in W.
///
/// ```text
/// P = m0*e*w*cos(w*t)*der(der(y)) - m0*e*w*sin(w*t)*der(der(x))
///     + m0*e*x0*w*cos(w*t)*der(der(theta)) + m0*e*y0*w*sin(w*t)*der(der(theta))
/// ```
pub fn work_rate<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, t: S, a: &[S; 9]) -> S {
    let x_ddot = a[0];
    let y_ddot = a[1];
    let theta_ddot = a[2];
    let t0 = p.w * t;
    let t1 = p.w.product_error(t);
    let (sin_t0, cos_t0) = t0.sin_cos();
    let t2 = sin_t0 + t1 * cos_t0;
    let t3 = cos_t0 - t1 * sin_t0;
    let t4 = t3 * (theta_ddot * p.x0 + y_ddot - t2 * p.e_w_squared);
    let t5 = t2 * (x_ddot - theta_ddot * p.y0 - t3 * p.e_w_squared) - t4;
    p.minus_m0_e_w * t5
}

/// Power `R` dissipated by dampers, in W.
///
/// ```text
/// R = b*der(x)^2 + b*der(y)^2 + (xc^2 + yc^2)*b*der(theta)^2
/// ```
pub fn dissipation_rate<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, v: &[S; 9]) -> S {
    let x_dot = v[0];
    let y_dot = v[1];
    let theta_dot = v[2];
    let t0 = theta_dot * p.yc;
    let t1 = theta_dot * p.xc;
    let t2 = x_dot - t0;
    let t3 = t1 + y_dot;
    let t4 = t0 + x_dot;
    let t5 = y_dot - t1;
    p.half_b * (t4 * t4 + t2 * t2 + (t5 * t5 + t3 * t3))
}

/// `s1`. Unit: `m`.
///
/// ```text
/// s1 = sqrt((x1 - x)^2 + (y1 - y)^2)
/// ```
pub fn output_s1<S: ::lagrangian::emitted::Scalar>(q: &[S; 9]) -> S {
    let x = q[0];
    let y = q[1];
    let x1 = q[3];
    let y1 = q[4];
    let t0 = x - x1;
    let t1 = y - y1;
    (t1 * t1 + t0 * t0).sqrt()
}

/// `s2`. Unit: `m`.
///
/// ```text
/// s2 = sqrt((x2 - x1)^2 + (y2 - y1)^2)
/// ```
pub fn output_s2<S: ::lagrangian::emitted::Scalar>(q: &[S; 9]) -> S {
    let x1 = q[3];
    let y1 = q[4];
    let x2 = q[6];
    let y2 = q[7];
    let t0 = x1 - x2;
    let t1 = y1 - y2;
    (t1 * t1 + t0 * t0).sqrt()
}

/// `ground_force`. Unit: `N`.
///
/// ```text
/// ground_force = sqrt((b*der(x) + c*x)^2 + (b*der(y) + c*y)^2)
/// ```
pub fn output_ground_force<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 9],
    v: &[S; 9],
) -> S {
    let x = q[0];
    let y = q[1];
    let x_dot = v[0];
    let y_dot = v[1];
    let t0 = p.b * x_dot + p.c * x;
    let t1 = p.b * y_dot + p.c * y;
    (t1 * t1 + t0 * t0).sqrt()
}

/// The generalized reactions of both contacts along θ, s₁, φ₁, θ₁, s₂, φ₂ and θ₂ of the crusher in
/// polar coordinates; those along x
/// and y are 0, for contacts within the whole move none of it. Unit: `N*m`.
///
/// ```text
/// R_theta = -R*((x1 - x)*(m1*der(der(y1)) + m2*der(der(y2))) - (y1 - y)*(m1*der(der(x1)) +
///     m2*der(der(x2))))/sqrt((x1 - x)^2 + (y1 - y)^2)
/// ```
pub fn output_R_theta<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 9],
    a: &[S; 9],
) -> S {
    let x = q[0];
    let y = q[1];
    let x1 = q[3];
    let y1 = q[4];
    let x1_ddot = a[3];
    let y1_ddot = a[4];
    let x2_ddot = a[6];
    let y2_ddot = a[7];
    let t0 = x - x1;
    let t1 = y - y1;
    let t2 = t1 * (p.m2 * x2_ddot + p.m1 * x1_ddot);
    let t3 = (t0 * (p.m2 * y2_ddot + p.m1 * y1_ddot) - t2) * p.R;
    t3 / (t1 * t1 + t0 * t0).sqrt()
}

/// `R_s1`. Unit: `N`.
///
/// ```text
/// R_s1 = ((x1 - x)*(m1*der(der(x1)) + m2*der(der(x2))) + (y1 - y)*(m1*der(der(y1)) +
///     m2*der(der(y2))))/sqrt((x1 - x)^2 + (y1 - y)^2)
/// ```
pub fn output_R_s1<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 9], a: &[S; 9]) -> S {
    let x = q[0];
    let y = q[1];
    let x1 = q[3];
    let y1 = q[4];
    let x1_ddot = a[3];
    let y1_ddot = a[4];
    let x2_ddot = a[6];
    let y2_ddot = a[7];
    let t0 = x - x1;
    let t1 = y - y1;
    let t2 = t0 * (p.m2 * x2_ddot + p.m1 * x1_ddot);
    let t3 = t1 * (p.m2 * y2_ddot + p.m1 * y1_ddot) + t2;
    -(t3 / (t1 * t1 + t0 * t0).sqrt())
}

/// `R_phi1`. Unit: `N*m`.
///
/// ```text
/// R_phi1 = (x1 - x)*(m1*der(der(y1)) + m2*der(der(y2)))
///     - (y1 - y)*(m1*der(der(x1)) + m2*der(der(x2)))
/// ```
pub fn output_R_phi1<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 9],
    a: &[S; 9],
) -> S {
    let x = q[0];
    let y = q[1];
    let x1 = q[3];
    let y1 = q[4];
    let x1_ddot = a[3];
    let y1_ddot = a[4];
    let x2_ddot = a[6];
    let y2_ddot = a[7];
    let t0 = (p.m2 * y2_ddot + p.m1 * y1_ddot) * (x - x1);
    (p.m2 * x2_ddot + p.m1 * x1_ddot) * (y - y1) - t0
}

/// `R_theta1`. Unit: `N*m`.
///
/// ```text
/// R_theta1 = J1*der(der(theta1))
/// ```
pub fn output_R_theta1<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, a: &[S; 9]) -> S {
    let theta1_ddot = a[5];
    theta1_ddot * p.J1
}

/// `R_s2`. Unit: `N`.
///
/// ```text
/// R_s2 = (m2*(x2 - x1)*der(der(x2)) + m2*(y2 - y1)*der(der(y2)))/sqrt((x2 - x1)^2 + (y2 - y1)^2)
/// ```
pub fn output_R_s2<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 9], a: &[S; 9]) -> S {
    let x1 = q[3];
    let y1 = q[4];
    let x2 = q[6];
    let y2 = q[7];
    let x2_ddot = a[6];
    let y2_ddot = a[7];
    let t0 = x1 - x2;
    let t1 = y1 - y2;
    p.minus_m2 * (t1 * y2_ddot + t0 * x2_ddot) / (t1 * t1 + t0 * t0).sqrt()
}

/// `R_phi2`. Unit: `N*m`.
///
/// ```text
/// R_phi2 = m2*(x2 - x1)*der(der(y2)) - m2*(y2 - y1)*der(der(x2))
/// ```
pub fn output_R_phi2<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 9],
    a: &[S; 9],
) -> S {
    let x1 = q[3];
    let y1 = q[4];
    let x2 = q[6];
    let y2 = q[7];
    let x2_ddot = a[6];
    let y2_ddot = a[7];
    p.minus_m2 * ((x1 - x2) * y2_ddot - (y1 - y2) * x2_ddot)
}

/// `R_theta2`. Unit: `N*m`.
///
/// ```text
/// R_theta2 = J2*der(der(theta2))
/// ```
pub fn output_R_theta2<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, a: &[S; 9]) -> S {
    let theta2_ddot = a[8];
    theta2_ddot * p.J2
}

/// Everything that the description asks to observe.
pub fn outputs<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 9],
    v: &[S; 9],
    a: &[S; 9],
) -> Outputs<S> {
    Outputs {
        s1: output_s1(q),
        s2: output_s2(q),
        ground_force: output_ground_force(p, q, v),
        R_theta: output_R_theta(p, q, a),
        R_s1: output_R_s1(p, q, a),
        R_phi1: output_R_phi1(p, q, a),
        R_theta1: output_R_theta1(p, a),
        R_s2: output_R_s2(p, q, a),
        R_phi2: output_R_phi2(p, q, a),
        R_theta2: output_R_theta2(p, a),
    }
}

::lagrangian::emitted::implement! {
    machine CollidingCrusher "CollidingCrusher" over S, R;
    parameters {
        m, J, m0, e, x0, y0, w, m1, J1, m2, J2, c, b, xc, yc, R, r1, rho, r2, delta, eN, mu,
    } [
        m: "m" "kg" = 600.0;
        J: "J" "kg*m^2" = 60.0;
        m0: "m0" "kg" = 40.0;
        e: "e" "m" = 0.1;
        x0: "x0" "m" = 0.05;
        y0: "y0" "m" = 0.03;
        w: "w" "rad/s" = 157.07963267948966;
        m1: "m1" "kg" = 180.0;
        J1: "J1" "kg*m^2" = 9.225;
        m2: "m2" "kg" = 120.0;
        J2: "J2" "kg*m^2" = 1.536;
        c: "c" "N/m" = 600000.0;
        b: "b" "N*s/m" = 3000.0;
        xc: "xc" "m" = 0.4;
        yc: "yc" "m" = 0.3;
        R: "R" "m" = 0.27;
        r1: "r1" "m" = 0.25;
        rho: "rho" "m" = 0.2;
        r2: "r2" "m" = 0.16;
        delta: "delta" "m" = 0.01;
        eN: "eN" "1" = 0.5;
        mu: "mu" "1" = 0.3;
    ]
    coordinates 9 Coordinates { x, y, theta, x1, y1, theta1, x2, y2, theta2 } [
        x: "x" "m";
        y: "y" "m";
        theta: "theta" "rad";
        x1: "x1" "m";
        y1: "y1" "m";
        theta1: "theta1" "rad";
        x2: "x2" "m";
        y2: "y2" "m";
        theta2: "theta2" "rad";
    ]
    inputs Inputs {} [], defined here
    outputs Outputs {
        s1, s2, ground_force, R_theta, R_s1, R_phi1, R_theta1, R_s2, R_phi2, R_theta2,
    } [
        s1: "s1" "m";
        s2: "s2" "m";
        ground_force: "ground_force" "N";
        R_theta: "R_theta" "N*m";
        R_s1: "R_s1" "N";
        R_phi1: "R_phi1" "N*m";
        R_theta1: "R_theta1" "N*m";
        R_s2: "R_s2" "N";
        R_phi2: "R_phi2" "N*m";
        R_theta2: "R_theta2" "N*m";
    ]
    prepared Prepared {
        m, J, x0, y0, w, m1, J1, m2, J2, c, b, xc, yc, R, r1, r2, eN, mu, rho_minus_delta, e_w,
        quarter_c, quarter_b, e_w_squared, m0_e_w_squared, half_m0, m_plus_m0, m0_x0, k0,
        m0_e_x0_w_squared, m0_e_y0_w_squared, half_c, half_b, R_minus_r1, rho_minus_r2_minus_delta,
        minus_m0_y0, minus_m0_e_w_squared, minus_R, k1, minus_m0_e_w, minus_m2, k2, k3, k4, k5, k6,
        k7, k8, k9, k10, k11,
    }
    singular singular
    accelerations { (p, t, q, v, u) Accelerations { p, t, q, v } }
    system {
        matrix mass_matrix(p, t, q) = mass_matrix(p);
        vector bias(p, t, q, v) = bias(p, t);
        vector applied(p, t, q, v, u) = applied(p, q, v);
        vector forces(p, t, q, v, u) = forces(p, t, q, v);
        numbers gaps(p, t, q) = gaps(p, q);
        numbers contact_rates(p, t, q, v) = contact_rates(p, q, v);
        numbers contact_matrix(p, t, q) = contact_matrix(p, q);
        numbers contact_bias(p, t, q, v) = contact_bias(q, v);
        numbers contact_coefficients(p, t, q, v) = contact_coefficients(p);
        number kinetic_energy(p, t, q, v) = kinetic_energy(p, t, v);
        number potential_energy(p, t, q, u) = potential_energy(p, q);
        number dissipation(p, t, q, v, u) = dissipation(p, v);
        number work_rate(p, t, q, v, a, u) = work_rate(p, t, a);
        number dissipation_rate(p, t, q, v, u) = dissipation_rate(p, v);
        outputs outputs(p, t, q, v, a, u) = outputs(p, q, v, a);
        contacts unilateral_contacts(p) = [
            ::lagrangian::emitted::UnilateralContact {
                name: "outer",
                law: ::lagrangian::emitted::ImpactLaw::Newton,
                order: ::lagrangian::emitted::ImpactOrder::AtOnce,
                painleve: ::lagrangian::emitted::Painleve::Error,
                compliance: Option::None,
                has_friction: true,
                is_rolling_resistance: false,
                is_second_tangent: false,
                has_face: false,
            },
            ::lagrangian::emitted::UnilateralContact {
                name: "inner",
                law: ::lagrangian::emitted::ImpactLaw::Newton,
                order: ::lagrangian::emitted::ImpactOrder::AtOnce,
                painleve: ::lagrangian::emitted::Painleve::Error,
                compliance: Option::None,
                has_friction: true,
                is_rolling_resistance: false,
                is_second_tangent: false,
                has_face: false,
            },
        ];
    }
    absent [MAY_BE_CONSTRAINED MAY_SLIDE]
    intervals []
    lanes [N]
    numbers []
}
