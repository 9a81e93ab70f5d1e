// @generated from machines/bead_in_shell.machine by `cargo xtask generate`; edits are lost.

//! A bead between two rough spherical shells, which hold it from both sides: a spherical pendulum
//! with dry friction. The
//! reaction of the shells keeps it at its distance from the centre, also where it passes over
//! the top.
//!
//! 2 coordinates, 5 parameters. Arithmetic of one call:
//!
//! | function | mul | add | div | sin cos | other | temporaries |
//! | --- | --: | --: | --: | --: | --: | --: |
//! | `prepare` | 10 | 3 | 2 | 0 | 1 | 16 |
//! | `mass_matrix` | 2 | 0 | 0 | 1 | 0 | 3 |
//! | `bias` | 6 | 0 | 0 | 1 | 0 | 8 |
//! | `applied` | 1 | 0 | 0 | 1 | 0 | 2 |
//! | `forces` | 7 | 1 | 0 | 1 | 0 | 10 |
//! | `slips` | 27 | 12 | 1 | 2 | 2 | 46 |
//! | `slip_matrix` | 27 | 12 | 1 | 2 | 2 | 46 |
//! | `slip_bias` | 65 | 30 | 1 | 2 | 2 | 102 |
//! | `friction` | 150 | 77 | 2 | 2 | 2 | 235 |
//! | `kinetic_energy` | 4 | 1 | 0 | 1 | 0 | 6 |
//! | `potential_energy` | 1 | 0 | 0 | 1 | 0 | 2 |
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

/// A bead between two rough spherical shells, which hold it from both sides: a spherical pendulum
/// with dry friction. The
/// reaction of the shells keeps it at its distance from the centre, also where it passes over
/// the top.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BeadInShell<S = f64> {
    /// Mass of the bead. Unit: `kg`. Default: 0.05.
    pub m: S,
    /// Distance from the centre of the shells. Unit: `m`. Default: 0.4.
    pub R: S,
    /// Coefficient of friction while it slides. Unit: `1`. Default: 0.2.
    pub mu: S,
    /// Coefficient of friction while it sticks. Unit: `1`. Default: 0.3.
    pub mu0: S,
    /// Acceleration of gravity. Unit: `m/s^2`. Default: 9.81.
    pub g: S,
}

impl<S: ::lagrangian::emitted::Scalar> BeadInShell<S> {
    /// Computes what depends on the parameters alone, once.
    pub fn prepare(&self) -> Prepared<S> {
        let t0 = self.R * self.R;
        let m_R = self.m * self.R;
        let k0 = t0.sqrt();
        let m_R_squared = self.R * m_R;
        let two_m_R_squared = m_R_squared * S::from_f64(2.0);
        let t1 = S::ONE / k0;
        let k1 = self.R * t1;
        let half_m_R_squared = m_R_squared * S::from_f64(0.5);
        let k2 = t0 * t1;
        let two_R = self.R * S::from_f64(2.0);
        let k3 = k0 * S::from_f64(2.0);
        let minus_m_R_squared = -m_R_squared;
        let minus_m_R_g = -(self.g * m_R);
        let minus_two_m_R_squared = -two_m_R_squared;
        let k4 = S::ONE / m_R_squared;
        let pivots = [(0, m_R_squared, m_R_squared)];
        Prepared {
            m: self.m,
            R: self.R,
            g: self.g,
            k0,
            k1,
            m_R_squared,
            m_R,
            half_m_R_squared,
            two_m_R_squared,
            k2,
            two_R,
            k3,
            minus_m_R_squared,
            minus_m_R_g,
            minus_two_m_R_squared,
            mu: self.mu,
            mu0: self.mu0,
            k4,
            singular: PIVOTS.vanished(pivots),
        }
    }

    /// The start values of the description, at `t = 0`.
    pub fn start(&self) -> ::lagrangian::emitted::State<Coordinates<S>> {
        let one = S::ONE;
        let zero = S::ZERO;
        let q = [one, zero];
        let v = [zero, S::from_f64(7.0)];
        ::lagrangian::emitted::State {
            t: 0.0,
            q: Coordinates::from_array(q),
            v: Coordinates::from_array(v),
        }
    }
}

/// The coordinates of [`BeadInShell`], or their rates, by name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coordinates<S = f64> {
    /// Angle from the lowest place, and around the vertical. Unit: `rad`.
    pub theta: S,
    /// `phi`. Unit: `rad`.
    pub phi: S,
}

/// The parameters of a [`BeadInShell`], with the work done that depends on them alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prepared<S = f64> {
    /// `m`
    m: S,
    /// `R`
    R: S,
    /// `g`
    g: S,
    /// `sqrt(R^2)`
    k0: S,
    /// `R/sqrt(R^2)`
    k1: S,
    /// `m*R^2`
    m_R_squared: S,
    /// `m*R`
    m_R: S,
    /// `0.5*m*R^2`
    half_m_R_squared: S,
    /// `2*m*R^2`
    two_m_R_squared: S,
    /// `R^2/sqrt(R^2)`
    k2: S,
    /// `2*R`
    two_R: S,
    /// `2*sqrt(R^2)`
    k3: S,
    /// `-m*R^2`
    minus_m_R_squared: S,
    /// `-m*R*g`
    minus_m_R_g: S,
    /// `-2*m*R^2`
    minus_two_m_R_squared: S,
    /// `mu`
    mu: S,
    /// `mu0`
    mu0: S,
    /// `1/m/R^2`
    k4: S,
    /// Why these parameters leave the machine without accelerations, if they do.
    singular: Option<::lagrangian::emitted::Singular>,
}

/// A pivot of an elimination that is not above this share of its diagonal element may be rounding
/// errors alone.
const PIVOTS: ::lagrangian::emitted::Pivots = ::lagrangian::emitted::Pivots::new(2, 2);

/// Mass matrix `M`.
///
/// ```text
/// M[theta, theta] = m*R^2
/// M[phi, phi] = m*R^2*sin(theta)^2
/// ```
pub fn mass_matrix<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 2]) -> [[S; 2]; 2] {
    let theta = q[0];
    let sin_theta = theta.sin();
    let zero = S::ZERO;
    let m22 = sin_theta * (p.m_R_squared * sin_theta);
    [[p.m_R_squared, zero], [zero, m22]]
}

/// Bias `h`: velocity products and explicit time in the inertia forces.
///
/// ```text
/// h[theta] = -m*R^2*sin(theta)*cos(theta)*der(phi)^2
/// h[phi] = 2*m*R^2*sin(theta)*cos(theta)*der(theta)*der(phi)
/// ```
pub fn bias<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 2], v: &[S; 2]) -> [S; 2] {
    let theta = q[0];
    let theta_dot = v[0];
    let phi_dot = v[1];
    let (sin_theta, cos_theta) = theta.sin_cos();
    let t0 = cos_theta * (sin_theta * phi_dot);
    let h_theta = t0 * (phi_dot * p.minus_m_R_squared);
    let h_phi = t0 * (p.two_m_R_squared * theta_dot);
    [h_theta, h_phi]
}

/// Applied generalized forces `Q`.
///
/// ```text
/// Q[theta] = -m*R*g*sin(theta)
/// ```
pub fn applied<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 2]) -> [S; 2] {
    let theta = q[0];
    let sin_theta = theta.sin();
    let q_theta = p.minus_m_R_g * sin_theta;
    let zero = S::ZERO;
    [q_theta, zero]
}

/// Right-hand side `f = Q - h` of `M a = f`.
pub fn forces<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 2], v: &[S; 2]) -> [S; 2] {
    let theta = q[0];
    let theta_dot = v[0];
    let phi_dot = v[1];
    let (sin_theta, cos_theta) = theta.sin_cos();
    let t0 = cos_theta * (sin_theta * phi_dot);
    let f_theta = sin_theta * p.minus_m_R_g + phi_dot * p.m_R_squared * t0;
    let f_phi = p.minus_two_m_R_squared * theta_dot * t0;
    [f_theta, f_phi]
}

/// Slips `w` of the guided contacts, in m/s.
///
/// ```text
/// w[shells] = …
/// w[shells.across] = R*sqrt(R^2)*sin(theta)^2*sin(phi)*cos(theta)*der(theta)/(R*cos(theta) +
///     sqrt(R^2)*sign(R*cos(theta)/sqrt(R^2) - 5/16) + sqrt(R^2)*abs(sign(R*cos(theta)/sqrt(R^2) -
///     5/16)) - sqrt(R^2)) - sqrt(R^2)*sin(theta)^2*sin(phi)*der(theta)
///     - R*sin(phi)*cos(theta)*sign(R*cos(theta)/sqrt(R^2) - 5/16)*der(theta)
///     - R*sin(phi)*cos(theta)*abs(sign(R*cos(theta)/sqrt(R^2) - 5/16))*der(theta)
///     + R*sin(phi)*cos(theta)*der(theta)
///     - R*sin(theta)*cos(phi)*sign(R*cos(theta)/sqrt(R^2) - 5/16)*der(phi)
///     - R*sin(theta)*cos(phi)*abs(sign(R*cos(theta)/sqrt(R^2) - 5/16))*der(phi)
///     + R*sin(theta)*cos(phi)*der(phi)
/// ```
pub fn slips<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 2], v: &[S; 2]) -> [S; 2] {
    let theta = q[0];
    let phi = q[1];
    let theta_dot = v[0];
    let phi_dot = v[1];
    let (sin_theta, cos_theta) = theta.sin_cos();
    let (sin_phi, cos_phi) = phi.sin_cos();
    let t0 = p.k0 * theta_dot;
    let t1 = cos_theta * p.k1;
    let t2 = sin_theta * sin_theta;
    let t3 = sin_theta * phi_dot;
    let t4 = cos_theta * theta_dot;
    let t5 = sin_phi * t2;
    let t6 = (t1 - S::from_f64(0.3125)).sign();
    let t7 = cos_phi * t3 + sin_phi * t4;
    let t8 = cos_phi * t4 - sin_phi * t3;
    let t9 = S::ONE - t6 - t6.abs();
    let t10 = t9 * (cos_phi * t2);
    let t11 = S::ONE / (t1 - t9);
    let t12 = t11 * p.R;
    let t13 = (S::ONE + t11 * (cos_phi * t10)) * (p.R * t8);
    let t14 = (t9 + t11 * (sin_phi * t5)) * (p.R * t7);
    let w1 = t10 * (t12 * (sin_phi * t7) - t0) + t13;
    let w2 = t5 * (t12 * (cos_phi * t8) - t0) + t14;
    [w1, w2]
}

/// Slip matrix `tau`, the derivatives of the slips by the rates.
///
/// ```text
/// tau[shells, theta] = …
/// tau[shells, phi] = -R*sin(theta)*sin(phi)
/// tau[shells.across, theta] = R*sqrt(R^2)*sin(theta)^2*sin(phi)*cos(theta)/(R*cos(theta) +
///     sqrt(R^2)*sign(R*cos(theta)/sqrt(R^2) - 5/16) + sqrt(R^2)*abs(sign(R*cos(theta)/sqrt(R^2) -
///     5/16)) - sqrt(R^2)) - sqrt(R^2)*sin(theta)^2*sin(phi)
///     - R*sin(phi)*cos(theta)*sign(R*cos(theta)/sqrt(R^2) - 5/16)
///     - R*sin(phi)*cos(theta)*abs(sign(R*cos(theta)/sqrt(R^2) - 5/16)) + R*sin(phi)*cos(theta)
/// tau[shells.across, phi] = R*sin(theta)*cos(phi)
///     - R*sin(theta)*cos(phi)*sign(R*cos(theta)/sqrt(R^2) - 5/16)
///     - R*sin(theta)*cos(phi)*abs(sign(R*cos(theta)/sqrt(R^2) - 5/16))
/// ```
pub fn slip_matrix<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 2]) -> [S; 4] {
    let theta = q[0];
    let phi = q[1];
    let (sin_theta, cos_theta) = theta.sin_cos();
    let (sin_phi, cos_phi) = phi.sin_cos();
    let t0 = cos_theta * p.k1;
    let t1 = cos_theta * p.R;
    let t2 = sin_theta * cos_phi;
    let t3 = sin_theta * sin_phi;
    let t4 = sin_theta * p.k0;
    let t5 = t1 * sin_phi;
    let t6 = (t0 - S::from_f64(0.3125)).sign();
    let t7 = S::ONE - t6 - t6.abs();
    let t8 = t2 * t7;
    let t9 = S::ONE / (t0 - t7);
    let t10 = t2 * t9;
    let t11 = t7 + t9 * (t3 * t3);
    let t12 = S::ONE + t8 * t10;
    let t13 = t10 * t3;
    let tau1_1 = t12 * (t1 * cos_phi) - (t8 * t4 - t13 * (t7 * t5));
    let tau1_2 = p.R * (t8 * t13 - t12 * t3);
    let tau2_1 = t5 * t11 - (t3 * t4 - t10 * (t2 * t5));
    let tau2_2 = p.R * (t2 * t11 - t3 * t13);
    [tau1_1, tau1_2, tau2_1, tau2_2]
}

/// Rates `dw/dt` of the slips where all accelerations are 0.
///
/// ```text
/// sigma[shells] = …
/// sigma[shells.across] = …
/// ```
pub fn slip_bias<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 2],
    v: &[S; 2],
) -> [S; 2] {
    let theta = q[0];
    let phi = q[1];
    let theta_dot = v[0];
    let phi_dot = v[1];
    let (sin_theta, cos_theta) = theta.sin_cos();
    let (sin_phi, cos_phi) = phi.sin_cos();
    let t0 = p.k1 * cos_theta;
    let t1 = cos_theta * cos_phi;
    let t2 = theta_dot * sin_phi;
    let t3 = sin_theta * cos_phi;
    let t4 = sin_theta * sin_phi;
    let t5 = theta_dot * t1;
    let t6 = cos_theta * t2;
    let t7 = phi_dot * t3;
    let t8 = t4 * phi_dot;
    let t9 = (t0 - S::from_f64(0.3125)).sign();
    let t10 = phi_dot * t5;
    let t11 = phi_dot * t6;
    let t12 = t7 + t6;
    let t13 = t3 * (sin_phi * p.R);
    let t14 = t5 - t8;
    let t15 = S::ONE - t9 - t9.abs();
    let t16 = t2 * (sin_theta * theta_dot) - t10 - (t10 - phi_dot * t8);
    let t17 = t11 + phi_dot * t7 + (t11 + t3 * (theta_dot * theta_dot));
    let t18 = S::ONE / (t0 - t15);
    let t19 = t18 * t3;
    let t20 = t4 * t18;
    let t21 = t15 * t19;
    let t22 = p.k1 * t18 * (sin_theta * sin_theta) + cos_theta * S::from_f64(2.0);
    let t23 = phi_dot * p.R * (cos_phi * cos_phi - sin_phi * sin_phi);
    let t24 = sin_theta * (t23 + t2 * (t19 * p.k2)) + t2 * (t1 * p.two_R);
    let t25 = (t2 * t22 + t7 * S::from_f64(2.0)) * (t12 * t20);
    let t26 = (t22 * (theta_dot * cos_phi) - t8 * S::from_f64(2.0)) * (t21 * t14);
    let t27 = t18 * (t12 * t24 - t13 * t16) - theta_dot * (t5 * p.k3 - t8 * p.k0);
    let t28 = t18 * (t24 * t14 - t13 * t17) - theta_dot * (p.k0 * t7 + p.k3 * t6);
    let bias1 = t27 * (sin_theta * t15) + p.R * (t26 - t17 * (S::ONE + t3 * t21));
    let bias2 = sin_theta * t28 + p.R * (t25 - t16 * (t15 + t4 * t20));
    [bias1, bias2]
}

::lagrangian::emitted::fast_function! {
    /// Accelerations, multipliers, `dw/dt` and the normal reaction of each contact without
    /// friction, and the change of each by a unit of each friction force; followed by the
    /// coefficients of friction. A machine with guided contacts has this in place of accelerations
    /// and multipliers.
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
    pub fn friction<'a, S>(Friction { p: &'a Prepared<S>, q: &'a [S; 2], v: &'a [S; 2] })
        -> Result<[S; 40], ::lagrangian::emitted::Singular> = friction_in;
}

#[inline(always)]
fn friction_in<S: Copy, N: ::lagrangian::emitted::Scalar<Stored = S>>(
    call: Friction<'_, S>,
) -> Result<[S; 40], ::lagrangian::emitted::Singular> {
    let Friction { p, q, v } = call;
    let n = N::load;
    if let Some(singular) = p.singular {
        return Err(singular);
    }
    let theta = n(q[0]);
    let phi = n(q[1]);
    let theta_dot = n(v[0]);
    let phi_dot = n(v[1]);
    let angles = [theta, phi];
    let circular = N::sin_cos_all(angles);
    let (sin_theta, cos_theta) = circular[0];
    let (sin_phi, cos_phi) = circular[1];
    let t0 = theta_dot * theta_dot;
    let t1 = cos_theta * n(p.k1);
    let t2 = cos_theta * theta_dot;
    let t3 = sin_theta * cos_phi;
    let t4 = sin_theta * sin_phi;
    let t5 = sin_theta * theta_dot;
    let t6 = cos_theta * n(p.m_R_squared);
    let t7 = cos_theta * sin_phi;
    let t8 = sin_theta * n(p.k0);
    let t9 = sin_phi * t2;
    let t10 = t3 * phi_dot;
    let t11 = t4 * phi_dot;
    let t12 = cos_phi * t2;
    let t13 = t4 * n(p.R);
    let t14 = t3 * n(p.R);
    let t15 = (t1 - N::from_f64(0.3125)).sign();
    let t16 = t9 * phi_dot;
    let t17 = t9 + t10;
    let t18 = t11 * n(p.R);
    let t19 = t12 - t11;
    let t20 = phi_dot * t12;
    // Row phi: pivot d[phi].
    let t21 = cos_theta.neg_mul_add(t6, n(p.m_R_squared));
    let t22 = sin_theta * phi_dot;
    let t23 = t9 * n(p.two_R);
    let t24 = N::ONE - t15 - t15.abs();
    let t25 = phi_dot.mul_add(t10, t16) + t0.mul_add(t3, t16);
    let t26 = t10 * n(p.R);
    let t27 = t5 * n(p.k0);
    let t28 = cos_theta * cos_phi;
    let t29 = t3 * t24;
    let t30 = N::ONE / t21;
    let t31 = t0.mul_sub(t4, t20) - phi_dot.neg_mul_add(t11, t20);
    let t32 = N::ONE / (t1 - t24);
    let t33 = theta_dot * t2;
    let t34 = t22.mul_add(t6 * phi_dot, sin_theta * n(p.minus_m_R_g));
    let r0 = t34 * n(p.k4);
    let t35 = t33 * n(p.k3);
    let t36 = t7 * n(p.m_R);
    let t37 = t28 * n(p.m_R);
    let t38 = t4 * n(p.m_R);
    let t39 = phi_dot.mul_add(t18, t0 * t13);
    let t40 = t30 * (t22 * (t2 * n(p.two_m_R_squared)));
    let t41 = t3 * t32;
    let t42 = t4 * t32;
    let t43 = t3 * n(p.m_R);
    let t44 = sin_theta * n(p.m_R);
    let t45 = t24 * t41;
    let t46 = t18 * t42;
    let t47 = t5 * t42;
    let t48 = t19 * t41;
    let t49 = t4 * t41;
    let t50 = t3 * t45;
    let t51 = t17 * t45;
    let t52 = t13 * t45;
    let t53 = N::from_f64(2.0) * t45;
    let t54 = t47 * n(p.k2);
    let t55 = t4.mul_add(t42, t24);
    let t56 = N::ONE + t50;
    let t57 = t7.neg_mul_add(t52, t8 * t29);
    let t58 = (n(p.R) * t28).neg_mul_add(t56, t57);
    let t59 = t11 * N::from_f64(2.0) * t41;
    let t60 = (t7 * t14).neg_mul_add(t41, t4 * t8);
    let t61 = (t7 * n(p.R)).neg_mul_add(t55, t60);
    let t62 = t12.mul_add(t53, t45 * (n(p.k1) * t5 * t41));
    let t63 = t31.neg_mul_add(t52, t23.mul_sub(t51, t17 * t24 * t46));
    let t64 = n(p.R) * t4.neg_mul_add(t56, t4 * t50);
    let t65 = (t9 * N::from_f64(2.0)).mul_add(t42, t59);
    let t66 = t48.mul_add(t54, t23.mul_sub(t48, t13 * t25 * t41));
    let t67 = n(p.R) * t3.mul_sub(t55, t4 * t49);
    let t68 = n(p.k4) * t58;
    let t69 = n(p.k4) * t61;
    let t70 = t29.mul_sub(t35, t24 * (t11 * t27));
    let t71 = t26.mul_sub(t48, t19 * t46) + t66;
    let r11 = t30 * t64;
    let r21 = t30 * t67;
    let t72 = t19.mul_sub(t11.neg_mul_add(t53, t62), t25 * t56);
    let t73 = t63 + t26.mul_add(t51, t51 * t54) - t70;
    let t74 = t17.mul_sub(t47.mul_add(n(p.k1) * t42, t65), t31 * t55);
    let t75 = phi_dot.mul_add(t26, phi_dot.mul_add(t23, t0 * t14));
    let t76 = t20.neg_mul_add(n(p.two_R), t39).mul_sub(n(p.m), r0 * t36);
    let r35 = n(p.k1) * t4;
    let t77 = n(p.R).mul_add(t74, t71 - t4.mul_add(t35, t10 * t27));
    let r4 = t38.mul_sub(t40, t75.mul_sub(n(p.m), r0 * t37));
    let r5 = -t40.mul_add(t43, t76);
    let r6 = r0.mul_add(t44, n(p.m) * n(p.R).mul_add(t33, n(p.g)));
    let r14 = -t38.mul_add(r11, t37.mul_add(t68, t56));
    let r15 = t43.mul_sub(r11, t36.mul_add(t68, t4 * t45));
    let r16 = t44.neg_mul_add(t68, n(p.k1) * t29);
    let r24 = -t38.mul_add(r21, t37.mul_add(t69, t49));
    let r25 = t43.mul_sub(r21, t36.mul_add(t69, t55));
    let r26 = t44.neg_mul_add(t69, r35);
    let r34 = n(p.k1) * t3;
    let r36 = -t1;
    let r1 = -t40;
    let r2 = n(p.R).mul_add(t72, t73) - t40.mul_add(t64, r0 * t58);
    let r3 = t77 - t40.mul_add(t67, r0 * t61);
    let r10 = -t68;
    let r12 = t64.mul_add(r11, t58 * t68);
    let r13 = t67.mul_add(r11, t61 * t68);
    let r20 = -t69;
    let r22 = t64.mul_add(r21, t58 * t69);
    let r23 = t67.mul_add(r21, t61 * t69);
    let sound = PIVOTS.hold(t21, t21) & r14.is_finite();
    if !sound {
        let pivots = [(1, t21, t21)];
        PIVOTS.check(pivots)?;
    }
    let friction = [
        r0.store(),
        r1.store(),
        r2.store(),
        r3.store(),
        r4.store(),
        r5.store(),
        r6.store(),
        r4.store(),
        r5.store(),
        r6.store(),
        r10.store(),
        r11.store(),
        r12.store(),
        r13.store(),
        r14.store(),
        r15.store(),
        r16.store(),
        r14.store(),
        r15.store(),
        r16.store(),
        r20.store(),
        r21.store(),
        r22.store(),
        r23.store(),
        r24.store(),
        r25.store(),
        r26.store(),
        r24.store(),
        r25.store(),
        r26.store(),
        n(p.mu).store(),
        n(p.mu).store(),
        n(p.mu0).store(),
        n(p.mu0).store(),
        r34.store(),
        r35.store(),
        r36.store(),
        r34.store(),
        r35.store(),
        r36.store(),
    ];
    Ok(friction)
}

/// Kinetic energy `T`, in J.
///
/// ```text
/// T = 1/2*m*R^2*der(theta)^2 + 1/2*m*R^2*sin(theta)^2*der(phi)^2
/// ```
pub fn kinetic_energy<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 2],
    v: &[S; 2],
) -> S {
    let theta = q[0];
    let theta_dot = v[0];
    let phi_dot = v[1];
    let sin_theta = theta.sin();
    let t0 = sin_theta * phi_dot;
    p.half_m_R_squared * (theta_dot * theta_dot + t0 * t0)
}

/// Potential energy `V`, in J.
///
/// ```text
/// V = -m*R*g*cos(theta)
/// ```
pub fn potential_energy<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 2]) -> S {
    let theta = q[0];
    let cos_theta = theta.cos();
    p.minus_m_R_g * cos_theta
}

::lagrangian::emitted::implement! {
    machine BeadInShell "BeadInShell" over S, R;
    parameters { m, R, mu, mu0, g } [
        m: "m" "kg" = 0.05;
        R: "R" "m" = 0.4;
        mu: "mu" "1" = 0.2;
        mu0: "mu0" "1" = 0.3;
        g: "g" "m/s^2" = 9.81;
    ]
    coordinates 2 Coordinates { theta, phi } [
        theta: "theta" "rad";
        phi: "phi" "rad";
    ]
    inputs Inputs {} [], defined here
    outputs Outputs {} [], defined here
    prepared Prepared {
        m, R, g, k0, k1, m_R_squared, m_R, half_m_R_squared, two_m_R_squared, k2, two_R, k3,
        minus_m_R_squared, minus_m_R_g, minus_two_m_R_squared, mu, mu0, k4,
    }
    singular singular
    accelerations friction
    system {
        matrix mass_matrix(p, t, q) = mass_matrix(p, q);
        vector bias(p, t, q, v) = bias(p, q, v);
        vector applied(p, t, q, v, u) = applied(p, q);
        vector forces(p, t, q, v, u) = forces(p, q, v);
        numbers slips(p, t, q, v) = slips(p, q, v);
        numbers slip_matrix(p, t, q) = slip_matrix(p, q);
        numbers slip_bias(p, t, q, v) = slip_bias(p, q, v);
        number kinetic_energy(p, t, q, v) = kinetic_energy(p, q, v);
        number potential_energy(p, t, q, u) = potential_energy(p, q);
        number dissipation(p, t, q, v, u);
        number work_rate(p, t, q, v, a, u);
        number dissipation_rate(p, t, q, v, u);
        outputs outputs(p, t, q, v, a, u) = Outputs {};
        names contacts(p) = ["shells", "shells.across"];
        count reaction_axes(p) = 3;
        bits second_tangents(p) = 2;
        ranges slip_ranges(p, q, v) = slips(p, q, v);
        solved friction(p, t, q, v, u) = friction(p, q, v);
        workspace with_workspace(p) = ::lagrangian::emitted::contact_workspace_in_space(2, 0, 2);
    }
    absent [MAY_BE_CONSTRAINED MAY_COLLIDE]
    intervals [yes]
    lanes []
    numbers []
}
