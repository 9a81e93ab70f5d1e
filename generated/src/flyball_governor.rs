// @generated from machines/flyball_governor.machine by `cargo xtask generate`; edits are lost.

//! J. Watt's governor: two balls on arms that swing in the plane of a turning shaft, joined by
//! links to
//! a sleeve that slides on the shaft. It starts in steady rotation with the arms at 0.6 rad, if
//! arms and
//! links are of one length.
//!
//! 3 coordinates, 6 parameters, 1 input. Arithmetic of one call:
//!
//! | function | mul | add | div | sin cos | other | temporaries |
//! | --- | --: | --: | --: | --: | --: | --: |
//! | `prepare` | 18 | 4 | 4 | 0 | 0 | 26 |
//! | `start` | 7 | 3 | 1 | 1 | 2 | 15 |
//! | `mass_matrix` | 2 | 1 | 0 | 1 | 0 | 4 |
//! | `bias` | 6 | 0 | 0 | 1 | 0 | 8 |
//! | `applied` | 1 | 0 | 0 | 1 | 0 | 2 |
//! | `forces` | 7 | 2 | 0 | 1 | 0 | 11 |
//! | `constraint_positions` | 5 | 3 | 0 | 1 | 0 | 10 |
//! | `constraint_rates` | 8 | 3 | 0 | 1 | 0 | 13 |
//! | `constraint_matrix` | 5 | 2 | 0 | 1 | 0 | 9 |
//! | `constraint_bias` | 13 | 5 | 0 | 1 | 0 | 20 |
//! | `accelerations` | 36 | 15 | 2 | 1 | 0 | 55 |
//! | `multipliers` | 31 | 14 | 1 | 1 | 0 | 48 |
//! | `projection` | 29 | 11 | 1 | 1 | 0 | 43 |
//! | `kinetic_energy` | 8 | 3 | 0 | 1 | 0 | 12 |
//! | `potential_energy` | 2 | 2 | 0 | 1 | 0 | 5 |
//! | `work_rate` | 1 | 0 | 0 | 0 | 0 | 1 |
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

/// J. Watt's governor: two balls on arms that swing in the plane of a turning shaft, joined by
/// links to
/// a sleeve that slides on the shaft. It starts in steady rotation with the arms at 0.6 rad, if
/// arms and
/// links are of one length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FlyballGovernor<S = f64> {
    /// Lengths of an arm and of a link. Unit: `m`. Default: 0.2.
    pub l: S,
    /// `b`. Unit: `m`. Default: 0.2.
    pub b: S,
    /// Masses of a ball and of the sleeve. Unit: `kg`. Default: 0.5.
    pub m: S,
    /// `M`. Unit: `kg`. Default: 2.
    pub M: S,
    /// Inertia of the shaft, with what it drives, about its axis. Unit: `kg*m^2`. Default: 0.02.
    pub J: S,
    /// `g`. Unit: `m/s^2`. Default: 9.81.
    pub g: S,
}

impl<S: ::lagrangian::emitted::Scalar> FlyballGovernor<S> {
    /// Computes what depends on the parameters alone, once.
    pub fn prepare(&self) -> Prepared<S> {
        let t0 = S::ONE / self.l;
        let inverse_b = S::ONE / self.b;
        let l_squared = self.l * self.l;
        let two_l = self.l * S::from_f64(2.0);
        let l_squared_m = l_squared * self.m;
        let two_l_squared_m = l_squared_m * S::from_f64(2.0);
        let half_over_l = S::from_f64(0.5) * t0;
        let half_over_b = inverse_b * S::from_f64(0.5);
        let b_squared = self.b * self.b;
        let M_g = self.M * self.g;
        let half_J = self.J * S::from_f64(0.5);
        let half_M = self.M * S::from_f64(0.5);
        let four_l_squared_m = l_squared_m * S::from_f64(4.0);
        let two_l_squared = l_squared * S::from_f64(2.0);
        let l_over_b = self.l * inverse_b;
        let l_squared_over_b = l_squared * inverse_b;
        let J_plus_two_l_squared_m = self.J + two_l_squared_m;
        let minus_two_l_squared_m = -two_l_squared_m;
        let minus_two_l_m_g = -(two_l * (self.g * self.m));
        let minus_half_over_b = -half_over_b;
        let inverse_M = S::ONE / self.M;
        let k0 = t0 * half_over_l / self.m;
        let g_over_b = self.g * inverse_b;
        let pivots = [(1, two_l_squared_m, two_l_squared_m), (2, self.M, self.M)];
        Prepared {
            l: self.l,
            M: self.M,
            J: self.J,
            g: self.g,
            b_squared,
            l_squared,
            inverse_b,
            half_over_b,
            l_squared_m,
            M_g,
            half_J,
            half_M,
            two_l_squared_m,
            four_l_squared_m,
            two_l_squared,
            l_over_b,
            l_squared_over_b,
            J_plus_two_l_squared_m,
            minus_two_l_squared_m,
            minus_two_l_m_g,
            minus_half_over_b,
            two_l,
            half_over_l,
            inverse_M,
            k0,
            g_over_b,
            singular: PIVOTS.vanished(pivots),
        }
    }

    /// The start values of the description, at `t = 0`.
    pub fn start(&self) -> ::lagrangian::emitted::State<Coordinates<S>> {
        let alpha = S::from_ratio(3, 5);
        let (sin_alpha, cos_alpha) = alpha.sin_cos();
        let t0 = sin_alpha * self.l;
        let zero = S::ZERO;
        let s = (self.b * self.b - t0 * t0).sqrt() + cos_alpha * self.l;
        let phi_rate = ((self.m + self.M) * self.g / (cos_alpha * (self.l * self.m))).sqrt();
        let q = [zero, alpha, s];
        let v = [phi_rate, zero, zero];
        ::lagrangian::emitted::State {
            t: 0.0,
            q: Coordinates::from_array(q),
            v: Coordinates::from_array(v),
        }
    }
}

/// The coordinates of [`FlyballGovernor`], or their rates, by name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coordinates<S = f64> {
    /// Angle of the shaft, and of the arms from it. Unit: `rad`.
    pub phi: S,
    /// `alpha`. Unit: `rad`.
    pub alpha: S,
    /// Depth of the sleeve below the hinge of the arms. Unit: `m`.
    pub s: S,
}

/// What can be set while a [`FlyballGovernor`] runs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Inputs<S = f64> {
    /// Torque on the shaft. Unit: `N*m`. Default: 0.
    pub drive: S,
}

/// The parameters of a [`FlyballGovernor`], with the work done that depends on them alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prepared<S = f64> {
    /// `l`
    l: S,
    /// `M`
    M: S,
    /// `J`
    J: S,
    /// `g`
    g: S,
    /// `b^2`
    b_squared: S,
    /// `l^2`
    l_squared: S,
    /// `1/b`
    inverse_b: S,
    /// `0.5/b`
    half_over_b: S,
    /// `l^2*m`
    l_squared_m: S,
    /// `M*g`
    M_g: S,
    /// `0.5*J`
    half_J: S,
    /// `0.5*M`
    half_M: S,
    /// `2*l^2*m`
    two_l_squared_m: S,
    /// `4*l^2*m`
    four_l_squared_m: S,
    /// `2*l^2`
    two_l_squared: S,
    /// `l/b`
    l_over_b: S,
    /// `l^2/b`
    l_squared_over_b: S,
    /// `J + 2*l^2*m`
    J_plus_two_l_squared_m: S,
    /// `-2*l^2*m`
    minus_two_l_squared_m: S,
    /// `-2*l*m*g`
    minus_two_l_m_g: S,
    /// `-0.5/b`
    minus_half_over_b: S,
    /// `2*l`
    two_l: S,
    /// `0.5/l`
    half_over_l: S,
    /// `1/M`
    inverse_M: S,
    /// `0.5/l^2/m`
    k0: S,
    /// `g/b`
    g_over_b: S,
    /// Why these parameters leave the machine without accelerations, if they do.
    singular: Option<::lagrangian::emitted::Singular>,
}

/// A pivot of an elimination that is not above this share of its diagonal element may be rounding
/// errors alone.
const PIVOTS: ::lagrangian::emitted::Pivots = ::lagrangian::emitted::Pivots::new(3, 4);

/// Mass matrix `M`.
///
/// ```text
/// M[phi, phi] = 2*l^2*m*sin(alpha)^2 + J
/// M[alpha, alpha] = 2*l^2*m
/// M[s, s] = M
/// ```
pub fn mass_matrix<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 3]) -> [[S; 3]; 3] {
    let alpha = q[1];
    let sin_alpha = alpha.sin();
    let m11 = sin_alpha * (sin_alpha * p.two_l_squared_m) + p.J;
    let zero = S::ZERO;
    [
        [m11, zero, zero],
        [zero, p.two_l_squared_m, zero],
        [zero, zero, p.M],
    ]
}

/// Bias `h`: velocity products and explicit time in the inertia forces.
///
/// ```text
/// h[phi] = 4*l^2*m*sin(alpha)*cos(alpha)*der(phi)*der(alpha)
/// h[alpha] = -2*l^2*m*sin(alpha)*cos(alpha)*der(phi)^2
/// ```
pub fn bias<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 3], v: &[S; 3]) -> [S; 3] {
    let alpha = q[1];
    let phi_dot = v[0];
    let alpha_dot = v[1];
    let (sin_alpha, cos_alpha) = alpha.sin_cos();
    let t0 = cos_alpha * (sin_alpha * phi_dot);
    let h_phi = t0 * (p.four_l_squared_m * alpha_dot);
    let h_alpha = t0 * (phi_dot * p.minus_two_l_squared_m);
    let zero = S::ZERO;
    [h_phi, h_alpha, zero]
}

/// Applied generalized forces `Q`.
///
/// ```text
/// Q[phi] = drive
/// Q[alpha] = -2*l*m*g*sin(alpha)
/// Q[s] = M*g
/// ```
pub fn applied<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 3],
    u: &Inputs<S>,
) -> [S; 3] {
    let alpha = q[1];
    let sin_alpha = alpha.sin();
    let q_alpha = p.minus_two_l_m_g * sin_alpha;
    [u.drive, q_alpha, p.M_g]
}

/// Right-hand side `f = Q - h` of `M a = f`.
pub fn forces<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 3],
    v: &[S; 3],
    u: &Inputs<S>,
) -> [S; 3] {
    let alpha = q[1];
    let phi_dot = v[0];
    let alpha_dot = v[1];
    let (sin_alpha, cos_alpha) = alpha.sin_cos();
    let t0 = cos_alpha * (sin_alpha * phi_dot);
    let f_phi = u.drive - p.four_l_squared_m * alpha_dot * t0;
    let f_alpha = sin_alpha * p.minus_two_l_m_g + phi_dot * p.two_l_squared_m * t0;
    [f_phi, f_alpha, p.M_g]
}

/// Residuals `g` of the constraints of positions; 0 for those of velocities alone.
///
/// ```text
/// g[links] = 1/2*s^2/b - l*s*cos(alpha)/b + 1/2*l^2/b - 1/2*b
/// ```
pub fn constraint_positions<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 3],
) -> [S; 1] {
    let alpha = q[1];
    let s = q[2];
    let (sin_alpha, cos_alpha) = alpha.sin_cos();
    let t0 = s - cos_alpha * p.l;
    let t1 = p.b_squared - sin_alpha * (sin_alpha * p.l_squared) - t0 * t0;
    let g1 = p.minus_half_over_b * t1;
    [g1]
}

/// Residuals `phi = G v + dg/dt` of the constraints at the level of velocities.
///
/// ```text
/// phi[links] = l*s*sin(alpha)*der(alpha)/b + s*der(s)/b - l*cos(alpha)*der(s)/b
/// ```
pub fn constraint_rates<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 3],
    v: &[S; 3],
) -> [S; 1] {
    let alpha = q[1];
    let s = q[2];
    let alpha_dot = v[1];
    let s_dot = v[2];
    let (sin_alpha, cos_alpha) = alpha.sin_cos();
    let t0 = sin_alpha * alpha_dot;
    let t1 = (t0 * p.l + s_dot) * (S::from_f64(2.0) * (s - cos_alpha * p.l));
    let phi1 = (t1 + t0 * (cos_alpha * p.two_l_squared)) * p.half_over_b;
    [phi1]
}

/// Constraint matrix `G`, the derivatives of `phi` by the rates.
///
/// ```text
/// G[links, alpha] = l*s*sin(alpha)/b
/// G[links, s] = (s - l*cos(alpha))/b
/// ```
pub fn constraint_matrix<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 3]) -> [S; 3] {
    let alpha = q[1];
    let s = q[2];
    let (sin_alpha, cos_alpha) = alpha.sin_cos();
    let t0 = s - cos_alpha * p.l;
    let zero = S::ZERO;
    let g1_2 = sin_alpha * (cos_alpha * p.l_squared_over_b + t0 * p.l_over_b);
    let g1_3 = t0 * p.inverse_b;
    [zero, g1_2, g1_3]
}

/// Right-hand side `gamma` of `G a = gamma`.
///
/// ```text
/// gamma[links] = -l*s*cos(alpha)*der(alpha)^2/b - 2*l*sin(alpha)*der(alpha)*der(s)/b - der(s)^2/b
/// ```
pub fn constraint_bias<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 3],
    v: &[S; 3],
) -> [S; 1] {
    let alpha = q[1];
    let s = q[2];
    let alpha_dot = v[1];
    let s_dot = v[2];
    let (sin_alpha, cos_alpha) = alpha.sin_cos();
    let t0 = alpha_dot * alpha_dot;
    let t1 = cos_alpha * p.l;
    let t2 = sin_alpha * (alpha_dot * p.l) + s_dot;
    let t3 = (cos_alpha * cos_alpha - sin_alpha * sin_alpha) * (t0 * p.two_l_squared);
    let t4 = ((s - t1) * (t0 * t1) + t2 * t2) * S::from_f64(2.0) + t3;
    let gamma1 = p.minus_half_over_b * t4;
    [gamma1]
}

::lagrangian::emitted::fast_function! {
    /// Accelerations `a`, the solution of `M a = f + G^T lambda`, `G a = gamma` from the mass
    /// matrix multiplied out.
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
    pub fn accelerations<'a, S>(Accelerations {
        p: &'a Prepared<S>,
        q: &'a [S; 3],
        v: &'a [S; 3],
        u: &'a Inputs<S>,
    }) -> Result<[S; 3], ::lagrangian::emitted::Singular> = accelerations_in;
}

#[inline(always)]
fn accelerations_in<S: Copy, N: ::lagrangian::emitted::Scalar<Stored = S>>(
    call: Accelerations<'_, S>,
) -> Result<[S; 3], ::lagrangian::emitted::Singular> {
    let Accelerations { p, q, v, u } = call;
    let n = N::load;
    if let Some(singular) = p.singular {
        return Err(singular);
    }
    let alpha = n(q[1]);
    let s = n(q[2]);
    let phi_dot = n(v[0]);
    let alpha_dot = n(v[1]);
    let s_dot = n(v[2]);
    let (sin_alpha, cos_alpha) = alpha.sin_cos();
    let t0 = sin_alpha * alpha_dot;
    let t1 = cos_alpha.neg_mul_add(n(p.l), s);
    let t2 = cos_alpha * alpha_dot;
    let t3 = sin_alpha * cos_alpha;
    let t4 = n(p.l).mul_add(t0, s_dot);
    let t5 = t1 * n(p.inverse_b);
    let t6 = phi_dot * (n(p.two_l_squared_m) * phi_dot);
    let t7 = t6.mul_add(t3, sin_alpha * n(p.minus_two_l_m_g));
    let t8 = cos_alpha * (phi_dot * n(p.four_l_squared_m));
    let t9 = cos_alpha * n(p.two_l_squared_m);
    // Row phi: pivot d[phi].
    let t10 = cos_alpha.neg_mul_add(t9, n(p.J_plus_two_l_squared_m));
    let t11 = t3 * n(p.l_squared_over_b);
    let t12 = t1.mul_add(sin_alpha * n(p.l_over_b), t11);
    // Eliminates s from row links: l[links, s].
    let t13 = t5 * n(p.inverse_M);
    // Eliminates alpha from row links: l[links, alpha].
    let t14 = t12 * n(p.k0);
    let t15 = t4.mul_add(t4, t1 * (alpha_dot * n(p.l) * t2));
    let t16 = t2.mul_sub(t2, t0 * t0) * n(p.two_l_squared);
    // Row links: pivot d[links].
    let t17 = t12.mul_add(t14, t5 * t13);
    let t18 = t15.mul_add(N::from_f64(2.0), t16);
    let t19 = t7.mul_add(t14, t13 * n(p.M_g));
    // Row links: right-hand side z[links].
    let t20 = t18.mul_add(n(p.half_over_b), t19) / t17;
    let phi_ddot = t0.neg_mul_add(t8, n(u.drive)) / t10;
    // Back substitution: a[alpha].
    let alpha_ddot = -t14.mul_sub(t20, t7 * n(p.k0));
    // Back substitution: a[s].
    let s_ddot = t13.neg_mul_add(t20, n(p.g));
    let sound = PIVOTS.hold(t10, t10) & PIVOTS.hold(t17, t17) & alpha_ddot.is_finite();
    if !sound {
        let pivots = [(0, t10, t10), (3, t17, t17)];
        PIVOTS.check(pivots)?;
    }
    let accelerations = [phi_ddot.store(), alpha_ddot.store(), s_ddot.store()];
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
    pub fn multipliers<'a, S>(Multipliers { p: &'a Prepared<S>, q: &'a [S; 3], v: &'a [S; 3] })
        -> Result<[S; 1], ::lagrangian::emitted::Singular> = multipliers_in;
}

#[inline(always)]
fn multipliers_in<S: Copy, N: ::lagrangian::emitted::Scalar<Stored = S>>(
    call: Multipliers<'_, S>,
) -> Result<[S; 1], ::lagrangian::emitted::Singular> {
    let Multipliers { p, q, v } = call;
    let n = N::load;
    if let Some(singular) = p.singular {
        return Err(singular);
    }
    let alpha = n(q[1]);
    let s = n(q[2]);
    let phi_dot = n(v[0]);
    let alpha_dot = n(v[1]);
    let s_dot = n(v[2]);
    let (sin_alpha, cos_alpha) = alpha.sin_cos();
    let t0 = alpha_dot * alpha_dot;
    let t1 = cos_alpha * n(p.l);
    let t2 = sin_alpha.mul_add(n(p.l) * alpha_dot, s_dot);
    let t3 = sin_alpha * sin_alpha;
    let t4 = t1 * t0;
    let t5 = s - t1;
    let t6 = sin_alpha * (n(p.two_l) * phi_dot.mul_add(phi_dot, t0));
    // Eliminates phi: inertia d[phi].
    let t7 = t3.mul_add(n(p.two_l_squared_m), n(p.J));
    let t8 = cos_alpha * n(p.l_squared_over_b);
    let t9 = n(p.inverse_b) * t5;
    let t10 = cos_alpha.mul_sub(cos_alpha, t3);
    let t11 = sin_alpha * t5.mul_add(n(p.l_over_b), t8);
    let t12 = t10 * (t0 * n(p.two_l_squared));
    let t13 = sin_alpha * N::from_f64(2.0);
    let t14 = N::from_f64(2.0).mul_add(t5.mul_add(t4, t2 * t2), t12);
    let t15 = t14.mul_add(n(p.half_over_b), t5 * n(p.g_over_b));
    let t16 = (t4 + n(p.g)).neg_mul_add(t13, cos_alpha * t6);
    // Row links: pivot d[links].
    let t17 = t11.mul_add(t11 * n(p.k0), t9 * (t9 * n(p.inverse_M)));
    let lambda1 = -(t16.mul_add(t11 * n(p.half_over_l), t15) / t17);
    let sound = PIVOTS.hold(t7, t7) & PIVOTS.hold(t17, t17) & lambda1.is_finite();
    if !sound {
        let pivots = [(0, t7, t7), (3, t17, t17)];
        PIVOTS.check(pivots)?;
    }
    let multipliers = [lambda1.store()];
    Ok(multipliers)
}

::lagrangian::emitted::fast_function! {
    /// Residuals of positions and rates, rows of `G`, the smallest displacements onto the
    /// constraints, and how independent these are. Only for machines whose constraints
    /// are independent.
    ///
    /// A pivot that vanishes is an error.
    pub fn projection<'a, S>(ProjectionCall { p: &'a Prepared<S>, q: &'a [S; 3], v: &'a [S; 3] })
        -> Result<[S; 18], ::lagrangian::emitted::Singular> = projection_in;
}

#[inline(always)]
fn projection_in<S: Copy, N: ::lagrangian::emitted::Scalar<Stored = S>>(
    call: ProjectionCall<'_, S>,
) -> Result<[S; 18], ::lagrangian::emitted::Singular> {
    let ProjectionCall { p, q, v } = call;
    let n = N::load;
    if let Some(singular) = p.singular {
        return Err(singular);
    }
    let alpha = n(q[1]);
    let s = n(q[2]);
    let alpha_dot = n(v[1]);
    let s_dot = n(v[2]);
    let (sin_alpha, cos_alpha) = alpha.sin_cos();
    let t0 = cos_alpha.neg_mul_add(n(p.l), s);
    let t1 = sin_alpha * alpha_dot;
    let t2 = cos_alpha * n(p.l_squared_over_b);
    let r4 = t0 * n(p.inverse_b);
    let t3 = sin_alpha * n(p.l_squared);
    let t4 = cos_alpha * n(p.two_l_squared_m);
    let r5 = cos_alpha.neg_mul_add(t4, n(p.J_plus_two_l_squared_m));
    let r3 = sin_alpha * t0.mul_add(n(p.l_over_b), t2);
    let t5 = r4 * n(p.inverse_M);
    let t6 = t1 * (cos_alpha * n(p.two_l_squared));
    let t7 = n(p.l).mul_add(t1, s_dot);
    let t8 = sin_alpha.neg_mul_add(t3, n(p.b_squared));
    let t9 = t0.neg_mul_add(t0, t8);
    let t10 = r3 * n(p.k0);
    let r1 = n(p.half_over_b) * t7.mul_add(t0 * N::from_f64(2.0), t6);
    let r16 = r3.mul_add(t10, r4 * t5);
    let t11 = N::ONE / r16;
    let t12 = r1 * t11;
    let r14 = t9 * n(p.half_over_b) * t11;
    let r0 = t9 * n(p.minus_half_over_b);
    let zero = N::ZERO;
    let r9 = t10 * r14;
    let r10 = t5 * r14;
    let r12 = -(t10 * t12);
    let r13 = -(t5 * t12);
    let r15 = -t12;
    let sound = PIVOTS.hold(r5, r5) & PIVOTS.hold(r16, r16) & r13.is_finite();
    if !sound {
        let pivots = [(0, r5, r5), (3, r16, r16)];
        PIVOTS.check(pivots)?;
    }
    let projection = [
        r0.store(),
        r1.store(),
        zero.store(),
        r3.store(),
        r4.store(),
        r5.store(),
        n(p.two_l_squared_m).store(),
        n(p.M).store(),
        zero.store(),
        r9.store(),
        r10.store(),
        zero.store(),
        r12.store(),
        r13.store(),
        r14.store(),
        r15.store(),
        r16.store(),
        r16.store(),
    ];
    Ok(projection)
}

/// Kinetic energy `T`, in J.
///
/// ```text
/// T = l^2*m*sin(alpha)^2*der(phi)^2 + 1/2*J*der(phi)^2 + l^2*m*der(alpha)^2 + 1/2*M*der(s)^2
/// ```
pub fn kinetic_energy<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 3],
    v: &[S; 3],
) -> S {
    let alpha = q[1];
    let phi_dot = v[0];
    let alpha_dot = v[1];
    let s_dot = v[2];
    let sin_alpha = alpha.sin();
    let t0 = phi_dot * phi_dot;
    let t1 = (alpha_dot * alpha_dot + sin_alpha * (t0 * sin_alpha)) * p.l_squared_m;
    t1 + (s_dot * (s_dot * p.half_M) + t0 * p.half_J)
}

/// Potential energy `V`, in J.
///
/// ```text
/// V = -M*g*s - 2*l*m*g*cos(alpha)
/// ```
pub fn potential_energy<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 3]) -> S {
    let alpha = q[1];
    let s = q[2];
    let cos_alpha = alpha.cos();
    -(p.M_g * s - cos_alpha * p.minus_two_l_m_g)
}

/// Power `P` supplied by drives, forces and inputs, in W.
///
/// ```text
/// P = der(phi)*drive
/// ```
pub fn work_rate<S: ::lagrangian::emitted::Scalar>(v: &[S; 3], u: &Inputs<S>) -> S {
    let phi_dot = v[0];
    u.drive * phi_dot
}

::lagrangian::emitted::implement! {
    machine FlyballGovernor "FlyballGovernor" over S, R;
    parameters { l, b, m, M, J, g } [
        l: "l" "m" = 0.2;
        b: "b" "m" = 0.2;
        m: "m" "kg" = 0.5;
        M: "M" "kg" = 2.0;
        J: "J" "kg*m^2" = 0.02;
        g: "g" "m/s^2" = 9.81;
    ]
    coordinates 3 Coordinates { phi, alpha, s } [
        phi: "phi" "rad";
        alpha: "alpha" "rad";
        s: "s" "m";
    ]
    inputs Inputs { drive } [
        drive: "drive" "N*m" = 0.0;
    ] over S
    outputs Outputs {} [], defined here
    prepared Prepared {
        l, M, J, g, b_squared, l_squared, inverse_b, half_over_b, l_squared_m, M_g, half_J, half_M,
        two_l_squared_m, four_l_squared_m, two_l_squared, l_over_b, l_squared_over_b,
        J_plus_two_l_squared_m, minus_two_l_squared_m, minus_two_l_m_g, minus_half_over_b, two_l,
        half_over_l, inverse_M, k0, g_over_b,
    }
    singular singular
    accelerations { (p, t, q, v, u) Accelerations { p, q, v, u } }
    system {
        matrix mass_matrix(p, t, q) = mass_matrix(p, q);
        vector bias(p, t, q, v) = bias(p, q, v);
        vector applied(p, t, q, v, u) = applied(p, q, u);
        vector forces(p, t, q, v, u) = forces(p, q, v, u);
        numbers constraint_positions(p, t, q) = constraint_positions(p, q);
        numbers constraint_rates(p, t, q, v) = constraint_rates(p, q, v);
        numbers constraint_matrix(p, t, q) = constraint_matrix(p, q);
        numbers constraint_bias(p, t, q, v) = constraint_bias(p, q, v);
        number kinetic_energy(p, t, q, v) = kinetic_energy(p, q, v);
        number potential_energy(p, t, q, u) = potential_energy(p, q);
        number dissipation(p, t, q, v, u);
        number work_rate(p, t, q, v, a, u) = work_rate(v, u);
        number dissipation_rate(p, t, q, v, u);
        outputs outputs(p, t, q, v, a, u) = Outputs {};
        constraints constraints(p) = [("links", "m", "N", true)];
        solved_in_place projection(p, t, q, v) = ProjectionCall { p, q, v };
        solved multipliers(p, t, q, v, u) = multipliers(p, q, v);
        workspace with_workspace(p) = ::lagrangian::emitted::constraint_workspace(3, 1);
    }
    absent [MAY_SLIDE MAY_COLLIDE]
    intervals []
    lanes [N]
    numbers []
}
