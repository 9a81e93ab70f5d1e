// @generated from machines/slider_crank.machine by `cargo xtask generate`; edits are lost.

//! A slider-crank: a crank turns, a rod joins it to a slider on a rail through the crank's
//! axis. One
//! degree of freedom; the loop is closed by two constraints, whose multipliers are what the pin
//! at the
//! slider carries.
//!
//! 3 coordinates, 9 parameters. Arithmetic of one call:
//!
//! | function | mul | add | div | sin cos | other | temporaries |
//! | --- | --: | --: | --: | --: | --: | --: |
//! | `prepare` | 22 | 12 | 2 | 0 | 0 | 36 |
//! | `start` | 4 | 3 | 1 | 0 | 2 | 10 |
//! | `mass_matrix` | 3 | 1 | 0 | 2 | 0 | 8 |
//! | `bias` | 8 | 1 | 0 | 2 | 0 | 13 |
//! | `applied` | 2 | 0 | 0 | 2 | 0 | 4 |
//! | `forces` | 12 | 4 | 0 | 2 | 0 | 20 |
//! | `constraint_positions` | 4 | 3 | 0 | 2 | 0 | 11 |
//! | `constraint_rates` | 6 | 4 | 0 | 2 | 0 | 14 |
//! | `constraint_matrix` | 4 | 0 | 0 | 2 | 0 | 8 |
//! | `constraint_bias` | 8 | 2 | 0 | 2 | 0 | 14 |
//! | `accelerations` | 53 | 28 | 3 | 2 | 0 | 88 |
//! | `multipliers` | 45 | 21 | 3 | 2 | 0 | 73 |
//! | `projection` | 49 | 33 | 3 | 2 | 0 | 89 |
//! | `kinetic_energy` | 16 | 6 | 0 | 2 | 0 | 26 |
//! | `potential_energy` | 4 | 2 | 0 | 2 | 0 | 8 |
//! | `assumption_0` | 0 | 0 | 0 | 1 | 0 | 1 |
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

/// A slider-crank: a crank turns, a rod joins it to a slider on a rail through the crank's
/// axis. One
/// degree of freedom; the loop is closed by two constraints, whose multipliers are what the pin
/// at the
/// slider carries.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SliderCrank<S = f64> {
    /// Lengths of crank and rod. Unit: `m`. Default: 0.15.
    pub a: S,
    /// `b`. Unit: `m`. Default: 0.35.
    pub b: S,
    /// `m1`. Unit: `kg`. Default: 0.5.
    pub m1: S,
    /// `m2`. Unit: `kg`. Default: 0.8.
    pub m2: S,
    /// `m3`. Unit: `kg`. Default: 1.2.
    pub m3: S,
    /// Inertias about the mass centres. Unit: `kg*m^2`. Default: 0.001.
    pub J1: S,
    /// `J2`. Unit: `kg*m^2`. Default: 0.008.
    pub J2: S,
    /// `g`. Unit: `m/s^2`. Default: 9.81.
    pub g: S,
    /// Rate of the crank when the run starts. Unit: `rad/s`. Default: 20.
    pub omega: S,
}

impl<S: ::lagrangian::emitted::Scalar> SliderCrank<S> {
    /// Computes what depends on the parameters alone, once.
    pub fn prepare(&self) -> Prepared<S> {
        let t0 = self.a * self.a;
        let t1 = S::from_f64(0.5) * self.g;
        let m2_g = self.m2 * self.g;
        let t2 = self.b * self.m2;
        let t3 = self.m1 * t0;
        let t4 = t1 * self.m1;
        let half_a_b_m2 = t2 * (self.a * S::from_f64(0.5));
        let k3 = t3 * S::from_f64(0.25) + (self.J1 + self.m2 * t0);
        let t5 = (self.m1 + self.m2 * S::from_f64(4.0)) * (t0 * S::from_f64(0.25));
        let half_b = self.b * S::from_f64(0.5);
        let half_a_m1_g = self.a * t4;
        let k0 = S::from_f64(0.125) * (S::from_f64(4.0) * self.J1 + t3);
        let half_m3 = self.m3 * S::from_f64(0.5);
        let k1 = self.J1 + t5;
        let k2 = self.J2 + t2 * (self.b * S::from_f64(0.25));
        let minus_a = -self.a;
        let minus_half_a_b_m2 = -half_a_b_m2;
        let k4 = -(self.a * (m2_g + t4));
        let minus_half_b_m2_g = -(t1 * t2);
        let minus_b = -self.b;
        let inverse_m3 = S::ONE / self.m3;
        let k5 = S::ONE / k3;
        let pivots = [(2, self.m3, self.m3), (0, k3, k3)];
        Prepared {
            a: self.a,
            b: self.b,
            m2: self.m2,
            m3: self.m3,
            J2: self.J2,
            half_b,
            m2_g,
            half_a_m1_g,
            k0,
            half_m3,
            half_a_b_m2,
            k1,
            k2,
            k3,
            minus_a,
            minus_half_a_b_m2,
            k4,
            minus_half_b_m2_g,
            minus_b,
            inverse_m3,
            k5,
            singular: PIVOTS.vanished(pivots),
        }
    }

    /// The start values of the description, at `t = 0`.
    pub fn start(&self) -> ::lagrangian::emitted::State<Coordinates<S>> {
        let theta = S::pi() * S::from_f64(0.5);
        let phi = -(self.a / self.b).asin();
        let s = (self.b * self.b - self.a * self.a).sqrt();
        let zero = S::ZERO;
        let s_rate = -(self.a * self.omega);
        let q = [theta, phi, s];
        let v = [self.omega, zero, s_rate];
        ::lagrangian::emitted::State {
            t: 0.0,
            q: Coordinates::from_array(q),
            v: Coordinates::from_array(v),
        }
    }
}

/// The coordinates of [`SliderCrank`], or their rates, by name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coordinates<S = f64> {
    /// Angles of crank and rod from the rail. Unit: `rad`.
    pub theta: S,
    /// `phi`. Unit: `rad`.
    pub phi: S,
    /// Position of the slider. Unit: `m`.
    pub s: S,
}

/// The parameters of a [`SliderCrank`], with the work done that depends on them alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prepared<S = f64> {
    /// `a`
    a: S,
    /// `b`
    b: S,
    /// `m2`
    m2: S,
    /// `m3`
    m3: S,
    /// `J2`
    J2: S,
    /// `0.5*b`
    half_b: S,
    /// `m2*g`
    m2_g: S,
    /// `0.5*a*m1*g`
    half_a_m1_g: S,
    /// `0.125*(a^2*m1 + 4*J1)`
    k0: S,
    /// `0.5*m3`
    half_m3: S,
    /// `0.5*a*b*m2`
    half_a_b_m2: S,
    /// `J1 + 0.25*a^2*(m1 + 4*m2)`
    k1: S,
    /// `J2 + 0.25*b^2*m2`
    k2: S,
    /// `J1 + a^2*m2 + 0.25*a^2*m1`
    k3: S,
    /// `-a`
    minus_a: S,
    /// `-0.5*a*b*m2`
    minus_half_a_b_m2: S,
    /// `-a*(m2*g + 0.5*m1*g)`
    k4: S,
    /// `-0.5*b*m2*g`
    minus_half_b_m2_g: S,
    /// `-b`
    minus_b: S,
    /// `1/m3`
    inverse_m3: S,
    /// `1/(J1 + a^2*m2 + 0.25*a^2*m1)`
    k5: S,
    /// Why these parameters leave the machine without accelerations, if they do.
    singular: Option<::lagrangian::emitted::Singular>,
}

/// A pivot of an elimination that is not above this share of its diagonal element may be rounding
/// errors alone.
const PIVOTS: ::lagrangian::emitted::Pivots = ::lagrangian::emitted::Pivots::new(3, 5);

/// Mass matrix `M`.
///
/// ```text
/// M[theta, theta] = 1/4*a^2*m1 + a^2*m2 + J1
/// M[phi, theta] = 1/2*a*b*m2*cos(phi - theta)
/// M[phi, phi] = 1/4*b^2*m2 + J2
/// M[s, s] = m3
/// ```
pub fn mass_matrix<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 3]) -> [[S; 3]; 3] {
    let theta = q[0];
    let phi = q[1];
    let (sin_phi, cos_phi) = phi.sin_cos();
    let (sin_theta, cos_theta) = theta.sin_cos();
    let m21 = (sin_phi * sin_theta + cos_phi * cos_theta) * p.half_a_b_m2;
    let zero = S::ZERO;
    [[p.k1, m21, zero], [m21, p.k2, zero], [zero, zero, p.m3]]
}

/// Bias `h`: velocity products and explicit time in the inertia forces.
///
/// ```text
/// h[theta] = -1/2*a*b*m2*sin(phi - theta)*der(phi)^2
/// h[phi] = 1/2*a*b*m2*sin(phi - theta)*der(theta)^2
/// ```
pub fn bias<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 3], v: &[S; 3]) -> [S; 3] {
    let theta = q[0];
    let phi = q[1];
    let theta_dot = v[0];
    let phi_dot = v[1];
    let (sin_phi, cos_phi) = phi.sin_cos();
    let (sin_theta, cos_theta) = theta.sin_cos();
    let t0 = sin_phi * cos_theta - cos_phi * sin_theta;
    let h_theta = t0 * (phi_dot * (p.minus_half_a_b_m2 * phi_dot));
    let h_phi = t0 * (theta_dot * (theta_dot * p.half_a_b_m2));
    let zero = S::ZERO;
    [h_theta, h_phi, zero]
}

/// Applied generalized forces `Q`.
///
/// ```text
/// Q[theta] = -1/2*(m1 + 2*m2)*a*g*cos(theta)
/// Q[phi] = -1/2*b*m2*g*cos(phi)
/// ```
pub fn applied<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 3]) -> [S; 3] {
    let theta = q[0];
    let phi = q[1];
    let cos_theta = theta.cos();
    let cos_phi = phi.cos();
    let q_theta = p.k4 * cos_theta;
    let q_phi = p.minus_half_b_m2_g * cos_phi;
    let zero = S::ZERO;
    [q_theta, q_phi, zero]
}

/// Right-hand side `f = Q - h` of `M a = f`.
pub fn forces<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 3], v: &[S; 3]) -> [S; 3] {
    let theta = q[0];
    let phi = q[1];
    let theta_dot = v[0];
    let phi_dot = v[1];
    let (sin_theta, cos_theta) = theta.sin_cos();
    let (sin_phi, cos_phi) = phi.sin_cos();
    let t0 = phi_dot * phi_dot;
    let t1 = theta_dot * theta_dot;
    let t2 = sin_phi * (cos_theta * p.half_a_b_m2);
    let t3 = cos_phi * (sin_theta * p.half_a_b_m2);
    let f_theta = t0 * t2 - (t0 * t3 - cos_theta * p.k4);
    let f_phi = t1 * t3 - (t1 * t2 - cos_phi * p.minus_half_b_m2_g);
    let zero = S::ZERO;
    [f_theta, f_phi, zero]
}

/// Residuals `g` of the constraints of positions; 0 for those of velocities alone.
///
/// ```text
/// g[along] = a*cos(theta) - s + b*cos(phi)
/// g[across] = a*sin(theta) + b*sin(phi)
/// ```
pub fn constraint_positions<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 3],
) -> [S; 2] {
    let theta = q[0];
    let phi = q[1];
    let s = q[2];
    let (sin_theta, cos_theta) = theta.sin_cos();
    let (sin_phi, cos_phi) = phi.sin_cos();
    let g1 = p.b * cos_phi + p.a * cos_theta - s;
    let g2 = p.b * sin_phi + p.a * sin_theta;
    [g1, g2]
}

/// Residuals `phi = G v + dg/dt` of the constraints at the level of velocities.
///
/// ```text
/// phi[along] = -a*sin(theta)*der(theta) - b*sin(phi)*der(phi) - der(s)
/// phi[across] = a*cos(theta)*der(theta) + b*cos(phi)*der(phi)
/// ```
pub fn constraint_rates<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 3],
    v: &[S; 3],
) -> [S; 2] {
    let theta = q[0];
    let phi = q[1];
    let theta_dot = v[0];
    let phi_dot = v[1];
    let s_dot = v[2];
    let (sin_theta, cos_theta) = theta.sin_cos();
    let (sin_phi, cos_phi) = phi.sin_cos();
    let t0 = theta_dot * p.a;
    let t1 = phi_dot * p.b;
    let phi1 = -(t1 * sin_phi + t0 * sin_theta + s_dot);
    let phi2 = t1 * cos_phi + t0 * cos_theta;
    [phi1, phi2]
}

/// Constraint matrix `G`, the derivatives of `phi` by the rates.
///
/// ```text
/// G[along, theta] = -a*sin(theta)
/// G[along, phi] = -b*sin(phi)
/// G[along, s] = -1
/// G[across, theta] = a*cos(theta)
/// G[across, phi] = b*cos(phi)
/// ```
pub fn constraint_matrix<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 3]) -> [S; 6] {
    let theta = q[0];
    let phi = q[1];
    let (sin_theta, cos_theta) = theta.sin_cos();
    let (sin_phi, cos_phi) = phi.sin_cos();
    let g1_1 = p.minus_a * sin_theta;
    let g1_2 = p.minus_b * sin_phi;
    let g2_1 = cos_theta * p.a;
    let g2_2 = cos_phi * p.b;
    let zero = S::ZERO;
    [g1_1, g1_2, S::from_f64(-1.0), g2_1, g2_2, zero]
}

/// Right-hand side `gamma` of `G a = gamma`.
///
/// ```text
/// gamma[along] = a*cos(theta)*der(theta)^2 + b*cos(phi)*der(phi)^2
/// gamma[across] = a*sin(theta)*der(theta)^2 + b*sin(phi)*der(phi)^2
/// ```
pub fn constraint_bias<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 3],
    v: &[S; 3],
) -> [S; 2] {
    let theta = q[0];
    let phi = q[1];
    let theta_dot = v[0];
    let phi_dot = v[1];
    let (sin_theta, cos_theta) = theta.sin_cos();
    let (sin_phi, cos_phi) = phi.sin_cos();
    let t0 = theta_dot * (theta_dot * p.a);
    let t1 = phi_dot * (phi_dot * p.b);
    let gamma1 = t1 * cos_phi + t0 * cos_theta;
    let gamma2 = t1 * sin_phi + t0 * sin_theta;
    [gamma1, gamma2]
}

::lagrangian::emitted::fast_function! {
    /// Accelerations `a`, the solution of `M a = f + G^T lambda`, `G a = gamma` from the mass
    /// matrix multiplied out, factored.
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
    ///
    /// The rows of constraints are those of `G a = gamma`: there `M` stands for `G`, with zeros for
    /// two constraints, and `f` for `gamma`. Their unknowns are the multipliers.
    pub fn accelerations<'a, S>(Accelerations { p: &'a Prepared<S>, q: &'a [S; 3], v: &'a [S; 3] })
        -> Result<[S; 3], ::lagrangian::emitted::Singular> = accelerations_in;
}

#[inline(always)]
fn accelerations_in<S: Copy, N: ::lagrangian::emitted::Scalar<Stored = S>>(
    call: Accelerations<'_, S>,
) -> Result<[S; 3], ::lagrangian::emitted::Singular> {
    let Accelerations { p, q, v } = call;
    let n = N::load;
    if let Some(singular) = p.singular {
        return Err(singular);
    }
    let theta = n(q[0]);
    let phi = n(q[1]);
    let theta_dot = n(v[0]);
    let phi_dot = n(v[1]);
    let angles = [phi, theta];
    let circular = N::sin_cos_all(angles);
    let (sin_phi, cos_phi) = circular[0];
    let (sin_theta, cos_theta) = circular[1];
    let t0 = phi_dot * phi_dot;
    let t1 = theta_dot * theta_dot;
    let t2 = cos_theta * n(p.a);
    let t3 = sin_theta * n(p.a);
    let t4 = sin_phi * n(p.b);
    let t5 = cos_phi * n(p.b);
    // Eliminates theta from row across: l[across, theta].
    let t6 = t2 * n(p.k5);
    // Eliminates theta from row along: l[along, theta].
    let t7 = t3 * n(p.k5);
    let t8 = cos_phi.mul_sub(sin_theta, sin_phi * cos_theta);
    let t9 = cos_phi.mul_add(cos_theta, sin_phi * sin_theta);
    let t10 = n(p.half_a_b_m2) * t9;
    let t11 = (t0 * n(p.half_a_b_m2)).mul_sub(t8, cos_theta * n(p.k4));
    let t12 = cos_phi * n(p.minus_half_b_m2_g);
    // Eliminates theta from row phi: l[phi, theta].
    let t13 = n(p.k5) * t10;
    let t14 = t7.neg_mul_add(t10, t4);
    let t15 = t6.neg_mul_add(t10, t5);
    // Row phi: pivot d[phi].
    let t16 = t10.neg_mul_add(t13, n(p.k2));
    // Row phi: right-hand side z[phi].
    let t17 = t11.mul_add(t13, (t1 * n(p.half_a_b_m2)).mul_add(t8, t12));
    let t18 = N::ONE / t16;
    // Eliminates phi from row along: l[along, phi].
    let t19 = t14 * t18;
    // Eliminates phi from row across: l[across, phi].
    let t20 = t15 * t18;
    // Row along: pivot d[along].
    let t21 = t14.mul_add(t19, t3.mul_add(t7, n(p.inverse_m3)));
    let t22 = t14.mul_add(t20, t3 * t6);
    let t23 = t7.neg_mul_add(t11, t1.mul_add(t2, t0 * t5));
    // Row along: right-hand side z[along].
    let t24 = t17.mul_add(t19, t23);
    let t25 = t6.mul_add(t11, t1.mul_add(t3, t0 * t4));
    let t26 = t15.mul_add(t20, t2 * t6);
    let t27 = N::ONE / t21;
    // Eliminates along from row across: l[across, along].
    let t28 = t22 * t27;
    // Row across: pivot d[across].
    let t29 = t22.neg_mul_add(t28, t26);
    // Row across: right-hand side z[across].
    let t30 = t24.mul_add(t28, t17.neg_mul_add(t20, t25)) / t29;
    // Back substitution: lambda[along].
    let t31 = t28.mul_add(t30, t24 * t27);
    // Back substitution: a[phi].
    let t32 = t19.mul_sub(t31, t20.mul_add(t30, t17 * t18));
    let t33 = t7.neg_mul_add(t31, t6.mul_sub(t30, n(p.k5) * t11));
    // Back substitution: a[theta].
    let theta_ddot = t13.mul_add(t32, t33);
    let phi_ddot = -t32;
    // Back substitution: a[s].
    let s_ddot = -(n(p.inverse_m3) * t31);
    let sound = PIVOTS.hold(t16, n(p.k2))
        & PIVOTS.hold(t21, t21)
        & PIVOTS.hold(t29, t26)
        & s_ddot.is_finite();
    if !sound {
        let pivots = [(1, t16, n(p.k2)), (3, t21, t21), (4, t29, t26)];
        PIVOTS.check(pivots)?;
    }
    let accelerations = [theta_ddot.store(), phi_ddot.store(), s_ddot.store()];
    Ok(accelerations)
}

::lagrangian::emitted::fast_function! {
    /// Lagrange's multipliers `lambda` of `M a = f + G^T lambda`.
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
    ///
    /// The rows of constraints are those of `G a = gamma`: there `M` stands for `G`, with zeros for
    /// two constraints, and `f` for `gamma`. Their unknowns are the multipliers.
    pub fn multipliers<'a, S>(Multipliers { p: &'a Prepared<S>, q: &'a [S; 3], v: &'a [S; 3] })
        -> Result<[S; 2], ::lagrangian::emitted::Singular> = multipliers_in;
}

#[inline(always)]
fn multipliers_in<S: Copy, N: ::lagrangian::emitted::Scalar<Stored = S>>(
    call: Multipliers<'_, S>,
) -> Result<[S; 2], ::lagrangian::emitted::Singular> {
    let Multipliers { p, q, v } = call;
    let n = N::load;
    if let Some(singular) = p.singular {
        return Err(singular);
    }
    let theta = n(q[0]);
    let phi = n(q[1]);
    let theta_dot = n(v[0]);
    let phi_dot = n(v[1]);
    let angles = [phi, theta];
    let circular = N::sin_cos_all(angles);
    let (sin_phi, cos_phi) = circular[0];
    let (sin_theta, cos_theta) = circular[1];
    let t0 = phi_dot * phi_dot;
    let t1 = theta_dot * theta_dot;
    let t2 = cos_theta * n(p.a);
    let t3 = sin_theta * n(p.a);
    let t4 = sin_phi * n(p.b);
    let t5 = cos_phi * n(p.b);
    // Eliminates theta from row across: l[across, theta].
    let t6 = t2 * n(p.k5);
    // Eliminates theta from row along: l[along, theta].
    let t7 = t3 * n(p.k5);
    let t8 = cos_phi.mul_sub(sin_theta, sin_phi * cos_theta);
    let t9 = cos_phi.mul_add(cos_theta, sin_phi * sin_theta);
    let t10 = n(p.half_a_b_m2) * t9;
    let t11 = (t0 * n(p.half_a_b_m2)).mul_sub(t8, cos_theta * n(p.k4));
    let t12 = cos_phi * n(p.minus_half_b_m2_g);
    // Eliminates theta from row phi: l[phi, theta].
    let t13 = n(p.k5) * t10;
    let t14 = t7.neg_mul_add(t10, t4);
    let t15 = t6.neg_mul_add(t10, t5);
    // Row phi: pivot d[phi].
    let t16 = t10.neg_mul_add(t13, n(p.k2));
    // Row phi: right-hand side z[phi].
    let t17 = t11.mul_add(t13, (t1 * n(p.half_a_b_m2)).mul_add(t8, t12));
    let t18 = N::ONE / t16;
    // Eliminates phi from row along: l[along, phi].
    let t19 = t14 * t18;
    // Eliminates phi from row across: l[across, phi].
    let t20 = t15 * t18;
    // Row along: pivot d[along].
    let t21 = t14.mul_add(t19, t3.mul_add(t7, n(p.inverse_m3)));
    let t22 = t14.mul_add(t20, t3 * t6);
    let t23 = t7.neg_mul_add(t11, t1.mul_add(t2, t0 * t5));
    // Row along: right-hand side z[along].
    let t24 = t17.mul_add(t19, t23);
    let t25 = t6.mul_add(t11, t1.mul_add(t3, t0 * t4));
    let t26 = t15.mul_add(t20, t2 * t6);
    let t27 = N::ONE / t21;
    // Eliminates along from row across: l[across, along].
    let t28 = t22 * t27;
    // Row across: pivot d[across].
    let t29 = t22.neg_mul_add(t28, t26);
    // Row across: right-hand side z[across].
    let lambda2 = t24.mul_add(t28, t17.neg_mul_add(t20, t25)) / t29;
    // Back substitution: lambda[along].
    let lambda1 = t28.mul_add(lambda2, t24 * t27);
    let sound = PIVOTS.hold(t16, n(p.k2))
        & PIVOTS.hold(t21, t21)
        & PIVOTS.hold(t29, t26)
        & lambda1.is_finite();
    if !sound {
        let pivots = [(1, t16, n(p.k2)), (3, t21, t21), (4, t29, t26)];
        PIVOTS.check(pivots)?;
    }
    let multipliers = [lambda1.store(), lambda2.store()];
    Ok(multipliers)
}

::lagrangian::emitted::fast_function! {
    /// Residuals of positions and rates, rows of `G`, the smallest displacements onto the
    /// constraints, and how independent these are. Only for machines whose constraints
    /// are independent.
    ///
    /// A pivot that vanishes is an error.
    pub fn projection<'a, S>(ProjectionCall { p: &'a Prepared<S>, q: &'a [S; 3], v: &'a [S; 3] })
        -> Result<[S; 27], ::lagrangian::emitted::Singular> = projection_in;
}

#[inline(always)]
fn projection_in<S: Copy, N: ::lagrangian::emitted::Scalar<Stored = S>>(
    call: ProjectionCall<'_, S>,
) -> Result<[S; 27], ::lagrangian::emitted::Singular> {
    let ProjectionCall { p, q, v } = call;
    let n = N::load;
    if let Some(singular) = p.singular {
        return Err(singular);
    }
    let theta = n(q[0]);
    let phi = n(q[1]);
    let s = n(q[2]);
    let theta_dot = n(v[0]);
    let phi_dot = n(v[1]);
    let s_dot = n(v[2]);
    let angles = [phi, theta];
    let circular = N::sin_cos_all(angles);
    let (sin_phi, cos_phi) = circular[0];
    let (sin_theta, cos_theta) = circular[1];
    let r7 = cos_theta * n(p.a);
    let t0 = sin_theta * n(p.a);
    let t1 = sin_phi * n(p.b);
    let r8 = cos_phi * n(p.b);
    let t2 = r7 * n(p.k5);
    let t3 = t0 * n(p.k5);
    let t4 = r8 + r7;
    let r1 = t1 + t0;
    let t5 = sin_phi.mul_add(sin_theta, cos_phi * cos_theta);
    let t6 = t5 * n(p.half_a_b_m2);
    let r3 = r8.mul_add(phi_dot, r7 * theta_dot);
    let t7 = s - t4;
    let t8 = n(p.k5) * t6;
    let t9 = t6.neg_mul_add(t3, t1);
    let t10 = t6.neg_mul_add(t2, r8);
    let t11 = t1.mul_add(phi_dot, t0 * theta_dot) + s_dot;
    let t12 = t6.neg_mul_add(t8, n(p.k2));
    let t13 = N::ONE / t12;
    let t14 = t13 * t9;
    let t15 = t13 * t10;
    let r23 = t9.mul_add(t14, t0.mul_add(t3, n(p.inverse_m3)));
    let t16 = t9.mul_add(t15, t0 * t2);
    let r26 = t10.mul_add(t15, r7 * t2);
    let t17 = N::ONE / r23;
    let t18 = t17 * t16;
    let r24 = t16.neg_mul_add(t18, r26);
    let t19 = N::ONE / r24;
    let t20 = t7.neg_mul_add(t18, r1) * t19;
    let t21 = t19 * t11.neg_mul_add(t18, r3);
    let r19 = t18.neg_mul_add(t20, t7 * t17);
    let r21 = t18.neg_mul_add(t21, t11 * t17);
    let t22 = t14.mul_add(r19, t15 * t20);
    let t23 = t14.mul_add(r21, t15 * t21);
    let r0 = t4 - s;
    let r2 = -t11;
    let r4 = sin_theta * n(p.minus_a);
    let r5 = sin_phi * n(p.minus_b);
    let zero = N::ZERO;
    let r13 = t8.mul_sub(t22, t3.mul_add(r19, t2 * t20));
    let r14 = -t22;
    let r15 = -(n(p.inverse_m3) * r19);
    let r16 = t8.mul_sub(t23, t3.mul_add(r21, t2 * t21));
    let r17 = -t23;
    let r18 = -(n(p.inverse_m3) * r21);
    let r20 = -t20;
    let r22 = -t21;
    let sound =
        PIVOTS.hold(t12, n(p.k2)) & PIVOTS.hold(r23, r23) & PIVOTS.hold(r24, r26) & r18.is_finite();
    if !sound {
        let pivots = [(1, t12, n(p.k2)), (3, r23, r23), (4, r24, r26)];
        PIVOTS.check(pivots)?;
    }
    let projection = [
        r0.store(),
        r1.store(),
        r2.store(),
        r3.store(),
        r4.store(),
        r5.store(),
        N::from_f64(-1.0).store(),
        r7.store(),
        r8.store(),
        zero.store(),
        n(p.k3).store(),
        n(p.k2).store(),
        n(p.m3).store(),
        r13.store(),
        r14.store(),
        r15.store(),
        r16.store(),
        r17.store(),
        r18.store(),
        r19.store(),
        r20.store(),
        r21.store(),
        r22.store(),
        r23.store(),
        r24.store(),
        r23.store(),
        r26.store(),
    ];
    Ok(projection)
}

/// Kinetic energy `T`, in J.
///
/// ```text
/// T = 1/8*(a^2*m1 + 4*a^2*m2 + 4*J1)*der(theta)^2
///     + 1/2*a*b*m2*cos(phi - theta)*der(theta)*der(phi) + 1/8*(b^2*m2 + 4*J2)*der(phi)^2
///     + 1/2*m3*der(s)^2
/// ```
pub fn kinetic_energy<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 3],
    v: &[S; 3],
) -> S {
    let theta = q[0];
    let phi = q[1];
    let theta_dot = v[0];
    let phi_dot = v[1];
    let s_dot = v[2];
    let (sin_theta, cos_theta) = theta.sin_cos();
    let (sin_phi, cos_phi) = phi.sin_cos();
    let t0 = theta_dot * p.a;
    let t1 = p.half_b * phi_dot;
    let t2 = t1 * sin_phi + t0 * sin_theta;
    let t3 = t1 * cos_phi + t0 * cos_theta;
    let t4 = (t3 * t3 + t2 * t2) * p.m2 + phi_dot * (phi_dot * p.J2);
    let t5 = s_dot * (s_dot * p.half_m3) + theta_dot * (theta_dot * p.k0);
    t4 * S::from_f64(0.5) + t5
}

/// Potential energy `V`, in J.
///
/// ```text
/// V = 1/2*(m1 + 2*m2)*a*g*sin(theta) + 1/2*b*m2*g*sin(phi)
/// ```
pub fn potential_energy<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 3]) -> S {
    let theta = q[0];
    let phi = q[1];
    let sin_theta = theta.sin();
    let sin_phi = phi.sin();
    let t0 = p.m2_g * (p.half_b * sin_phi + sin_theta * p.a);
    t0 + sin_theta * p.half_a_m1_g
}

/// By how much `cos(phi) > 0` holds.
pub fn assumption_0<S: ::lagrangian::emitted::Scalar>(q: &[S; 3]) -> S {
    let phi = q[1];
    let cos_phi = phi.cos();
    cos_phi
}

::lagrangian::emitted::implement! {
    machine SliderCrank "SliderCrank" over S, R;
    parameters { a, b, m1, m2, m3, J1, J2, g, omega } [
        a: "a" "m" = 0.15;
        b: "b" "m" = 0.35;
        m1: "m1" "kg" = 0.5;
        m2: "m2" "kg" = 0.8;
        m3: "m3" "kg" = 1.2;
        J1: "J1" "kg*m^2" = 0.001;
        J2: "J2" "kg*m^2" = 0.008;
        g: "g" "m/s^2" = 9.81;
        omega: "omega" "rad/s" = 20.0;
    ]
    coordinates 3 Coordinates { theta, phi, s } [
        theta: "theta" "rad";
        phi: "phi" "rad";
        s: "s" "m";
    ]
    inputs Inputs {} [], defined here
    outputs Outputs {} [], defined here
    prepared Prepared {
        a, b, m2, m3, J2, half_b, m2_g, half_a_m1_g, k0, half_m3, half_a_b_m2, k1, k2, k3, minus_a,
        minus_half_a_b_m2, k4, minus_half_b_m2_g, minus_b, inverse_m3, k5,
    }
    singular singular
    accelerations { (p, t, q, v, u) Accelerations { p, q, v } }
    system {
        matrix mass_matrix(p, t, q) = mass_matrix(p, q);
        vector bias(p, t, q, v) = bias(p, q, v);
        vector applied(p, t, q, v, u) = applied(p, q);
        vector forces(p, t, q, v, u) = forces(p, q, v);
        numbers constraint_positions(p, t, q) = constraint_positions(p, q);
        numbers constraint_rates(p, t, q, v) = constraint_rates(p, q, v);
        numbers constraint_matrix(p, t, q) = constraint_matrix(p, q);
        numbers constraint_bias(p, t, q, v) = constraint_bias(p, q, v);
        number kinetic_energy(p, t, q, v) = kinetic_energy(p, q, v);
        number potential_energy(p, t, q, u) = potential_energy(p, q);
        number dissipation(p, t, q, v, u);
        number work_rate(p, t, q, v, a, u);
        number dissipation_rate(p, t, q, v, u);
        outputs outputs(p, t, q, v, a, u) = Outputs {};
        facts assumptions(p, t, q, v, u) = [("cos(phi) > 0", true, assumption_0(q))];
        constraints constraints(p) = [("along", "m", "N", true), ("across", "m", "N", true)];
        solved_in_place projection(p, t, q, v) = ProjectionCall { p, q, v };
        solved multipliers(p, t, q, v, u) = multipliers(p, q, v);
        workspace with_workspace(p) = ::lagrangian::emitted::constraint_workspace(3, 2);
    }
    absent [MAY_SLIDE MAY_COLLIDE]
    intervals []
    lanes [N]
    numbers []
}
