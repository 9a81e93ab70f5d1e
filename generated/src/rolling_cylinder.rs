// @generated from machines/rolling_cylinder.machine by `cargo xtask generate`; edits are lost.

//! A cylinder that rolls inside a fixed one, in polar coordinates about the axis of the latter. It
//! moves like a
//! pendulum as long as the contact force presses.
//!
//! 3 coordinates, 5 parameters. Arithmetic of one call:
//!
//! | function | mul | add | div | sin cos | other | temporaries |
//! | --- | --: | --: | --: | --: | --: | --: |
//! | `prepare` | 11 | 6 | 5 | 0 | 0 | 22 |
//! | `start` | 0 | 1 | 0 | 0 | 0 | 1 |
//! | `mass_matrix` | 2 | 0 | 0 | 0 | 0 | 2 |
//! | `bias` | 5 | 0 | 0 | 0 | 0 | 5 |
//! | `applied` | 3 | 0 | 0 | 1 | 0 | 5 |
//! | `forces` | 8 | 3 | 0 | 1 | 0 | 13 |
//! | `constraint_positions` | 0 | 1 | 0 | 0 | 0 | 1 |
//! | `constraint_rates` | 2 | 2 | 0 | 0 | 0 | 4 |
//! | `constraint_bias` | 1 | 1 | 0 | 0 | 0 | 2 |
//! | `accelerations` | 2 | 0 | 0 | 1 | 0 | 3 |
//! | `multipliers` | 17 | 8 | 2 | 1 | 0 | 29 |
//! | `kinetic_energy` | 11 | 4 | 0 | 1 | 0 | 17 |
//! | `potential_energy` | 2 | 0 | 0 | 1 | 0 | 3 |
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

/// A cylinder that rolls inside a fixed one, in polar coordinates about the axis of the latter. It
/// moves like a
/// pendulum as long as the contact force presses.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RollingCylinder<S = f64> {
    /// `m`. Unit: `kg`. Default: 180.
    pub m: S,
    /// `J`. Unit: `kg*m^2`. Default: 9.225.
    pub J: S,
    /// Radii of the fixed cylinder and of the one that rolls. Unit: `m`. Default: 0.27.
    pub R: S,
    /// `r`. Unit: `m`. Default: 0.25.
    pub r: S,
    /// `g`. Unit: `m/s^2`. Default: 9.81.
    pub g: S,
}

impl<S: ::lagrangian::emitted::Scalar> RollingCylinder<S> {
    /// Computes what depends on the parameters alone, once.
    pub fn prepare(&self) -> Prepared<S> {
        let t0 = S::ONE / self.r;
        let m_g = self.m * self.g;
        let R_minus_r = self.R - self.r;
        let pivot_4 = self.r * self.r;
        let t1 = R_minus_r * R_minus_r;
        let t2 = t0 * (self.J * t0);
        let t3 = self.m + t2;
        let t4 = m_g * (S::ONE / t3);
        let two_m = self.m * S::from_f64(2.0);
        let minus_m = -self.m;
        let minus_m_g = -m_g;
        let inverse_m = S::ONE / self.m;
        let r_squared_over_J = pivot_4 / self.J;
        let k0 = t0 * t4;
        let k1 = -(t4 / R_minus_r);
        let pivot_1 = t3 * t1;
        let scale_1 = self.m * t1 + t2 * t1;
        let one = S::ONE;
        let pivots = [(1, pivot_1, scale_1), (3, one, one), (4, pivot_4, pivot_4)];
        Prepared {
            m: self.m,
            J: self.J,
            r: self.r,
            g: self.g,
            m_g,
            R_minus_r,
            two_m,
            minus_m,
            minus_m_g,
            inverse_m,
            r_squared_over_J,
            k0,
            k1,
            singular: PIVOTS.vanished(pivots),
        }
    }

    /// The start values of the description, at rest and `t = 0`.
    pub fn start(&self) -> ::lagrangian::emitted::State<Coordinates<S>> {
        let s = self.R - self.r;
        let one = S::ONE;
        let zero = S::ZERO;
        let q = [s, one, zero];
        let v = [S::ZERO; 3];
        ::lagrangian::emitted::State {
            t: 0.0,
            q: Coordinates::from_array(q),
            v: Coordinates::from_array(v),
        }
    }
}

/// The coordinates of [`RollingCylinder`], or their rates, by name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coordinates<S = f64> {
    /// Distance of the axes, and its direction from the one that points down. Unit: `m`.
    pub s: S,
    /// `phi`. Unit: `rad`.
    pub phi: S,
    /// Angle of the cylinder. Unit: `rad`.
    pub theta: S,
}

/// The parameters of a [`RollingCylinder`], with the work done that depends on them alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prepared<S = f64> {
    /// `m`
    m: S,
    /// `J`
    J: S,
    /// `r`
    r: S,
    /// `g`
    g: S,
    /// `m*g`
    m_g: S,
    /// `R - r`
    R_minus_r: S,
    /// `2*m`
    two_m: S,
    /// `-m`
    minus_m: S,
    /// `-m*g`
    minus_m_g: S,
    /// `1/m`
    inverse_m: S,
    /// `r^2/J`
    r_squared_over_J: S,
    /// `m*g/r/(m + J/r^2)`
    k0: S,
    /// `-m*g/(R - r)/(m + J/r^2)`
    k1: S,
    /// Why these parameters leave the machine without accelerations, if they do.
    singular: Option<::lagrangian::emitted::Singular>,
}

/// A pivot of an elimination that is not above this share of its diagonal element may be rounding
/// errors alone.
const PIVOTS: ::lagrangian::emitted::Pivots = ::lagrangian::emitted::Pivots::new(3, 5);

/// Mass matrix `M`.
///
/// ```text
/// M[s, s] = m
/// M[phi, phi] = m*s^2
/// M[theta, theta] = J
/// ```
pub fn mass_matrix<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 3]) -> [[S; 3]; 3] {
    let s = q[0];
    let zero = S::ZERO;
    let m22 = s * (p.m * s);
    [[p.m, zero, zero], [zero, m22, zero], [zero, zero, p.J]]
}

/// Bias `h`: velocity products and explicit time in the inertia forces.
///
/// ```text
/// h[s] = -m*s*der(phi)^2
/// h[phi] = 2*m*s*der(s)*der(phi)
/// ```
pub fn bias<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 3], v: &[S; 3]) -> [S; 3] {
    let s = q[0];
    let s_dot = v[0];
    let phi_dot = v[1];
    let t0 = phi_dot * s;
    let h_s = t0 * (phi_dot * p.minus_m);
    let h_phi = t0 * (p.two_m * s_dot);
    let zero = S::ZERO;
    [h_s, h_phi, zero]
}

/// Applied generalized forces `Q`.
///
/// ```text
/// Q[s] = m*g*cos(phi)
/// Q[phi] = -m*g*s*sin(phi)
/// ```
pub fn applied<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 3]) -> [S; 3] {
    let s = q[0];
    let phi = q[1];
    let (sin_phi, cos_phi) = phi.sin_cos();
    let q_s = p.m_g * cos_phi;
    let q_phi = sin_phi * (p.minus_m_g * s);
    let zero = S::ZERO;
    [q_s, q_phi, zero]
}

/// Right-hand side `f = Q - h` of `M a = f`.
pub fn forces<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 3], v: &[S; 3]) -> [S; 3] {
    let s = q[0];
    let phi = q[1];
    let s_dot = v[0];
    let phi_dot = v[1];
    let (sin_phi, cos_phi) = phi.sin_cos();
    let t0 = phi_dot * s;
    let f_s = t0 * (phi_dot * p.m) + p.m_g * cos_phi;
    let f_phi = -(t0 * (p.two_m * s_dot) + sin_phi * (s * p.m_g));
    let zero = S::ZERO;
    [f_s, f_phi, zero]
}

/// Residuals `g` of the constraints of positions; 0 for those of velocities alone.
///
/// ```text
/// g[contact.gap] = R - s - r
/// ```
pub fn constraint_positions<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 3],
) -> [S; 2] {
    let s = q[0];
    let g1 = p.R_minus_r - s;
    let zero = S::ZERO;
    [g1, zero]
}

/// Residuals `phi = G v + dg/dt` of the constraints at the level of velocities.
///
/// ```text
/// phi[contact.gap] = -der(s)
/// phi[contact.slip] = s*der(phi) + r*der(theta)
/// ```
pub fn constraint_rates<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 3],
    v: &[S; 3],
) -> [S; 2] {
    let s = q[0];
    let s_dot = v[0];
    let phi_dot = v[1];
    let theta_dot = v[2];
    let phi1 = -s_dot;
    let phi2 = theta_dot * p.r + phi_dot * s;
    [phi1, phi2]
}

/// Constraint matrix `G`, the derivatives of `phi` by the rates.
///
/// ```text
/// G[contact.gap, s] = -1
/// G[contact.slip, phi] = s
/// G[contact.slip, theta] = r
/// ```
pub fn constraint_matrix<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 3]) -> [S; 6] {
    let s = q[0];
    let zero = S::ZERO;
    [S::from_f64(-1.0), zero, zero, zero, s, p.r]
}

/// Right-hand side `gamma` of `G a = gamma`.
///
/// ```text
/// gamma[contact.slip] = -der(s)*der(phi)
/// ```
pub fn constraint_bias<S: ::lagrangian::emitted::Scalar>(v: &[S; 3]) -> [S; 2] {
    let s_dot = v[0];
    let phi_dot = v[1];
    let zero = S::ZERO;
    let gamma2 = -(phi_dot * s_dot);
    [zero, gamma2]
}

::lagrangian::emitted::fast_function! {
    /// Accelerations `a`, the solution of `M a = f + G^T lambda`, `G a = gamma` eliminated along
    /// the machine, without the coordinates that constraints settle.
    ///
    /// A pivot that vanishes is an error.
    pub fn accelerations<'a, S>(Accelerations { p: &'a Prepared<S>, q: &'a [S; 3] })
        -> Result<[S; 3], ::lagrangian::emitted::Singular> = accelerations_in;
}

#[inline(always)]
fn accelerations_in<S: Copy, N: ::lagrangian::emitted::Scalar<Stored = S>>(
    call: Accelerations<'_, S>,
) -> Result<[S; 3], ::lagrangian::emitted::Singular> {
    let Accelerations { p, q } = call;
    let n = N::load;
    if let Some(singular) = p.singular {
        return Err(singular);
    }
    let phi = n(q[1]);
    let sin_phi = phi.sin();
    let zero = N::ZERO;
    let phi_ddot = sin_phi * n(p.k1);
    let theta_ddot = sin_phi * n(p.k0);
    let accelerations = [zero.store(), phi_ddot.store(), theta_ddot.store()];
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
    let s = n(q[0]);
    let phi = n(q[1]);
    let s_dot = n(v[0]);
    let phi_dot = n(v[1]);
    let (sin_phi, cos_phi) = phi.sin_cos();
    let t0 = phi_dot * s_dot;
    let t1 = s * s;
    let t2 = t0 * N::from_f64(2.0);
    let t3 = phi_dot * (phi_dot * s);
    let t4 = s * (n(p.m) * s);
    // Row contact.slip: pivot d[contact.slip].
    let t5 = t1.mul_add(n(p.inverse_m) / t1, n(p.r_squared_over_J));
    let t6 = sin_phi.mul_sub(t3, t2 * cos_phi);
    let t7 = t2.mul_add(sin_phi, cos_phi * t3) + n(p.g);
    let lambda1 = n(p.m) * cos_phi.mul_add(t7, sin_phi * t6);
    let lambda2 = -((t0 + sin_phi.neg_mul_add(t7, cos_phi * t6)) / t5);
    let sound = PIVOTS.hold(n(p.J), n(p.J))
        & PIVOTS.hold(n(p.m), n(p.m))
        & PIVOTS.hold(t4, t4)
        & PIVOTS.hold(n(p.inverse_m), n(p.inverse_m))
        & PIVOTS.hold(t5, t5)
        & lambda2.is_finite();
    if !sound {
        let pivots = [
            (2, n(p.J), n(p.J)),
            (0, n(p.m), n(p.m)),
            (1, t4, t4),
            (3, n(p.inverse_m), n(p.inverse_m)),
            (4, t5, t5),
        ];
        PIVOTS.check(pivots)?;
    }
    let multipliers = [lambda1.store(), lambda2.store()];
    Ok(multipliers)
}

/// Kinetic energy `T`, in J.
///
/// ```text
/// T = 1/2*m*der(s)^2 + 1/2*m*s^2*der(phi)^2 + 1/2*J*der(theta)^2
/// ```
pub fn kinetic_energy<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 3],
    v: &[S; 3],
) -> S {
    let s = q[0];
    let phi = q[1];
    let s_dot = v[0];
    let phi_dot = v[1];
    let theta_dot = v[2];
    let (sin_phi, cos_phi) = phi.sin_cos();
    let t0 = phi_dot * s;
    let t1 = t0 * cos_phi + sin_phi * s_dot;
    let t2 = cos_phi * s_dot - t0 * sin_phi;
    let t3 = (t2 * t2 + t1 * t1) * p.m + theta_dot * (theta_dot * p.J);
    S::from_f64(0.5) * t3
}

/// Potential energy `V`, in J.
///
/// ```text
/// V = -m*g*s*cos(phi)
/// ```
pub fn potential_energy<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 3]) -> S {
    let s = q[0];
    let phi = q[1];
    let cos_phi = phi.cos();
    cos_phi * (p.minus_m_g * s)
}

/// By how much `s > 0` holds.
pub fn assumption_0<S: ::lagrangian::emitted::Scalar>(q: &[S; 3]) -> S {
    let s = q[0];
    s
}

::lagrangian::emitted::implement! {
    machine RollingCylinder "RollingCylinder" over S, R;
    parameters { m, J, R, r, g } [
        m: "m" "kg" = 180.0;
        J: "J" "kg*m^2" = 9.225;
        R: "R" "m" = 0.27;
        r: "r" "m" = 0.25;
        g: "g" "m/s^2" = 9.81;
    ]
    coordinates 3 Coordinates { s, phi, theta } [
        s: "s" "m";
        phi: "phi" "rad";
        theta: "theta" "rad";
    ]
    inputs Inputs {} [], defined here
    outputs Outputs {} [], defined here
    prepared Prepared {
        m, J, r, g, m_g, R_minus_r, two_m, minus_m, minus_m_g, inverse_m, r_squared_over_J, k0, k1,
    }
    singular singular
    accelerations { (p, t, q, v, u) Accelerations { p, q } }
    system {
        matrix mass_matrix(p, t, q) = mass_matrix(p, q);
        vector bias(p, t, q, v) = bias(p, q, v);
        vector applied(p, t, q, v, u) = applied(p, q);
        vector forces(p, t, q, v, u) = forces(p, q, v);
        numbers constraint_positions(p, t, q) = constraint_positions(p, q);
        numbers constraint_rates(p, t, q, v) = constraint_rates(p, q, v);
        numbers constraint_matrix(p, t, q) = constraint_matrix(p, q);
        numbers constraint_bias(p, t, q, v) = constraint_bias(v);
        number kinetic_energy(p, t, q, v) = kinetic_energy(p, q, v);
        number potential_energy(p, t, q, u) = potential_energy(p, q);
        number dissipation(p, t, q, v, u);
        number work_rate(p, t, q, v, a, u);
        number dissipation_rate(p, t, q, v, u);
        outputs outputs(p, t, q, v, a, u) = Outputs {};
        facts assumptions(p, t, q, v, u) = [("s > 0", true, assumption_0(q))];
        constraints constraints(p) = [
            ("contact.gap", "m", "N", true),
            ("contact.slip", "m/s", "N", false),
        ];
        solved multipliers(p, t, q, v, u) = multipliers(p, q, v);
        workspace with_workspace(p) = ::lagrangian::emitted::constraint_workspace(3, 2);
    }
    absent [MAY_SLIDE MAY_COLLIDE]
    intervals []
    lanes [N]
    numbers []
}
