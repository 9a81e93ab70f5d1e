// @generated from machines/particle_pendulum.machine by `cargo xtask generate`; edits are lost.

//! A double pendulum in Cartesian coordinates: two particles that two rods hold. The
//! constraints are
//! scaled so that their multipliers are the forces in the rods, positive where a rod presses.
//!
//! 4 coordinates, 5 parameters. Arithmetic of one call:
//!
//! | function | mul | add | div | sin cos | other | temporaries |
//! | --- | --: | --: | --: | --: | --: | --: |
//! | `prepare` | 9 | 4 | 4 | 0 | 0 | 17 |
//! | `start` | 3 | 1 | 0 | 1 | 0 | 5 |
//! | `constraint_positions` | 6 | 6 | 0 | 0 | 0 | 12 |
//! | `constraint_rates` | 6 | 6 | 0 | 0 | 0 | 12 |
//! | `constraint_matrix` | 6 | 2 | 0 | 0 | 0 | 8 |
//! | `constraint_bias` | 6 | 4 | 0 | 0 | 0 | 10 |
//! | `accelerations` | 37 | 19 | 2 | 0 | 0 | 58 |
//! | `multipliers` | 32 | 18 | 2 | 0 | 0 | 52 |
//! | `projection` | 54 | 32 | 2 | 0 | 0 | 88 |
//! | `kinetic_energy` | 6 | 3 | 0 | 0 | 0 | 9 |
//! | `potential_energy` | 2 | 1 | 0 | 0 | 0 | 3 |
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

/// A double pendulum in Cartesian coordinates: two particles that two rods hold. The
/// constraints are
/// scaled so that their multipliers are the forces in the rods, positive where a rod presses.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ParticlePendulum<S = f64> {
    /// `m1`. Unit: `kg`. Default: 1.
    pub m1: S,
    /// `m2`. Unit: `kg`. Default: 1.
    pub m2: S,
    /// `l1`. Unit: `m`. Default: 1.
    pub l1: S,
    /// `l2`. Unit: `m`. Default: 1.
    pub l2: S,
    /// `g`. Unit: `m/s^2`. Default: 9.81.
    pub g: S,
}

impl<S: ::lagrangian::emitted::Scalar> ParticlePendulum<S> {
    /// Computes what depends on the parameters alone, once.
    pub fn prepare(&self) -> Prepared<S> {
        let inverse_l1 = S::ONE / self.l1;
        let inverse_l2 = S::ONE / self.l2;
        let m2_g = self.m2 * self.g;
        let l1_squared = self.l1 * self.l1;
        let half_over_l1 = inverse_l1 * S::from_f64(0.5);
        let l2_squared = self.l2 * self.l2;
        let half_over_l2 = S::from_f64(0.5) * inverse_l2;
        let half_m1 = self.m1 * S::from_f64(0.5);
        let half_m2 = self.m2 * S::from_f64(0.5);
        let minus_m1_g = -(self.m1 * self.g);
        let minus_m2_g = -m2_g;
        let minus_inverse_l2 = -inverse_l2;
        let minus_inverse_l1 = -inverse_l1;
        let inverse_m1 = S::ONE / self.m1;
        let inverse_m2 = S::ONE / self.m2;
        let g_over_l1 = self.g * inverse_l1;
        let pivots = [
            (0, self.m1, self.m1),
            (1, self.m1, self.m1),
            (2, self.m2, self.m2),
            (3, self.m2, self.m2),
        ];
        Prepared {
            m1: self.m1,
            m2: self.m2,
            g: self.g,
            l1_squared,
            inverse_l1,
            half_over_l1,
            l2_squared,
            inverse_l2,
            half_over_l2,
            m2_g,
            half_m1,
            half_m2,
            minus_m1_g,
            minus_m2_g,
            minus_inverse_l2,
            minus_inverse_l1,
            inverse_m1,
            inverse_m2,
            g_over_l1,
            singular: PIVOTS.vanished(pivots),
        }
    }

    /// The start values of the description, at rest and `t = 0`.
    pub fn start(&self) -> ::lagrangian::emitted::State<Coordinates<S>> {
        let y1 = self.l1 * S::from_f64(0.5);
        let t0 = S::from_ratio(2, 3) * S::pi();
        let sin_t0 = t0.sin();
        let x1 = self.l1 * sin_t0;
        let x2 = x1 + self.l2;
        let q = [x1, y1, x2, y1];
        let v = [S::ZERO; 4];
        ::lagrangian::emitted::State {
            t: 0.0,
            q: Coordinates::from_array(q),
            v: Coordinates::from_array(v),
        }
    }
}

/// The coordinates of [`ParticlePendulum`], or their rates, by name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coordinates<S = f64> {
    /// `x1`. Unit: `m`.
    pub x1: S,
    /// `y1`. Unit: `m`.
    pub y1: S,
    /// `x2`. Unit: `m`.
    pub x2: S,
    /// `y2`. Unit: `m`.
    pub y2: S,
}

/// The parameters of a [`ParticlePendulum`], with the work done that depends on them alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prepared<S = f64> {
    /// `m1`
    m1: S,
    /// `m2`
    m2: S,
    /// `g`
    g: S,
    /// `l1^2`
    l1_squared: S,
    /// `1/l1`
    inverse_l1: S,
    /// `0.5/l1`
    half_over_l1: S,
    /// `l2^2`
    l2_squared: S,
    /// `1/l2`
    inverse_l2: S,
    /// `0.5/l2`
    half_over_l2: S,
    /// `m2*g`
    m2_g: S,
    /// `0.5*m1`
    half_m1: S,
    /// `0.5*m2`
    half_m2: S,
    /// `-m1*g`
    minus_m1_g: S,
    /// `-m2*g`
    minus_m2_g: S,
    /// `-1/l2`
    minus_inverse_l2: S,
    /// `-1/l1`
    minus_inverse_l1: S,
    /// `1/m1`
    inverse_m1: S,
    /// `1/m2`
    inverse_m2: S,
    /// `g/l1`
    g_over_l1: S,
    /// Why these parameters leave the machine without accelerations, if they do.
    singular: Option<::lagrangian::emitted::Singular>,
}

/// A pivot of an elimination that is not above this share of its diagonal element may be rounding
/// errors alone.
const PIVOTS: ::lagrangian::emitted::Pivots = ::lagrangian::emitted::Pivots::new(4, 6);

/// Mass matrix `M`.
///
/// ```text
/// M[x1, x1] = m1
/// M[y1, y1] = m1
/// M[x2, x2] = m2
/// M[y2, y2] = m2
/// ```
pub fn mass_matrix<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>) -> [[S; 4]; 4] {
    let zero = S::ZERO;
    [
        [p.m1, zero, zero, zero],
        [zero, p.m1, zero, zero],
        [zero, zero, p.m2, zero],
        [zero, zero, zero, p.m2],
    ]
}

/// Applied generalized forces `Q`.
///
/// ```text
/// Q[y1] = -m1*g
/// Q[y2] = -m2*g
/// ```
pub fn applied<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>) -> [S; 4] {
    let zero = S::ZERO;
    [zero, p.minus_m1_g, zero, p.minus_m2_g]
}

/// Right-hand side `f = Q - h` of `M a = f`.
pub fn forces<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>) -> [S; 4] {
    let zero = S::ZERO;
    [zero, p.minus_m1_g, zero, p.minus_m2_g]
}

/// Residuals `g` of the constraints of positions; 0 for those of velocities alone.
///
/// ```text
/// g[upper_rod] = 1/2*x1^2/l1 + 1/2*y1^2/l1 - 1/2*l1
/// g[lower_rod] = 1/2*((x2 - x1)^2 + (y2 - y1)^2 - l2^2)/l2
/// ```
pub fn constraint_positions<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 4],
) -> [S; 2] {
    let x1 = q[0];
    let y1 = q[1];
    let x2 = q[2];
    let y2 = q[3];
    let t0 = x1 - x2;
    let t1 = y1 - y2;
    let g1 = p.half_over_l1 * (y1 * y1 + (x1 * x1 - p.l1_squared));
    let g2 = p.half_over_l2 * (t1 * t1 + (t0 * t0 - p.l2_squared));
    [g1, g2]
}

/// Residuals `phi = G v + dg/dt` of the constraints at the level of velocities.
///
/// ```text
/// phi[upper_rod] = x1*der(x1)/l1 + y1*der(y1)/l1
/// phi[lower_rod] = 1/2*(2*(x2 - x1)*(der(x2) - der(x1)) + 2*(y2 - y1)*(der(y2) - der(y1)))/l2
/// ```
pub fn constraint_rates<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 4],
    v: &[S; 4],
) -> [S; 2] {
    let x1 = q[0];
    let y1 = q[1];
    let x2 = q[2];
    let y2 = q[3];
    let x1_dot = v[0];
    let y1_dot = v[1];
    let x2_dot = v[2];
    let y2_dot = v[3];
    let t0 = (y1_dot - y2_dot) * (y1 - y2) + (x1_dot - x2_dot) * (x1 - x2);
    let phi1 = (y1_dot * y1 + x1_dot * x1) * p.inverse_l1;
    let phi2 = t0 * p.inverse_l2;
    [phi1, phi2]
}

/// Constraint matrix `G`, the derivatives of `phi` by the rates.
///
/// ```text
/// G[upper_rod, x1] = x1/l1
/// G[upper_rod, y1] = y1/l1
/// G[lower_rod, x1] = -(x2 - x1)/l2
/// G[lower_rod, y1] = -(y2 - y1)/l2
/// G[lower_rod, x2] = (x2 - x1)/l2
/// G[lower_rod, y2] = (y2 - y1)/l2
/// ```
pub fn constraint_matrix<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 4]) -> [S; 8] {
    let x1 = q[0];
    let y1 = q[1];
    let x2 = q[2];
    let y2 = q[3];
    let t0 = x1 - x2;
    let t1 = y1 - y2;
    let g1_1 = p.inverse_l1 * x1;
    let g1_2 = p.inverse_l1 * y1;
    let zero = S::ZERO;
    let g2_1 = p.inverse_l2 * t0;
    let g2_2 = p.inverse_l2 * t1;
    let g2_3 = t0 * p.minus_inverse_l2;
    let g2_4 = t1 * p.minus_inverse_l2;
    [g1_1, g1_2, zero, zero, g2_1, g2_2, g2_3, g2_4]
}

/// Right-hand side `gamma` of `G a = gamma`.
///
/// ```text
/// gamma[upper_rod] = -der(x1)^2/l1 - der(y1)^2/l1
/// gamma[lower_rod] = -1/2*(2*(der(x2) - der(x1))^2 + 2*(der(y2) - der(y1))^2)/l2
/// ```
pub fn constraint_bias<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, v: &[S; 4]) -> [S; 2] {
    let x1_dot = v[0];
    let y1_dot = v[1];
    let x2_dot = v[2];
    let y2_dot = v[3];
    let t0 = x1_dot - x2_dot;
    let t1 = y1_dot - y2_dot;
    let gamma1 = p.minus_inverse_l1 * (y1_dot * y1_dot + x1_dot * x1_dot);
    let gamma2 = p.minus_inverse_l2 * (t1 * t1 + t0 * t0);
    [gamma1, gamma2]
}

::lagrangian::emitted::fast_function! {
    /// Accelerations `a`, the solution of `M a = f + G^T lambda`, `G a = gamma` eliminated along
    /// the machine, factored.
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
    pub fn accelerations<'a, S>(Accelerations { p: &'a Prepared<S>, q: &'a [S; 4], v: &'a [S; 4] })
        -> Result<[S; 4], ::lagrangian::emitted::Singular> = accelerations_in;
}

#[inline(always)]
fn accelerations_in<S: Copy, N: ::lagrangian::emitted::Scalar<Stored = S>>(
    call: Accelerations<'_, S>,
) -> Result<[S; 4], ::lagrangian::emitted::Singular> {
    let Accelerations { p, q, v } = call;
    let n = N::load;
    if let Some(singular) = p.singular {
        return Err(singular);
    }
    let x1 = n(q[0]);
    let y1 = n(q[1]);
    let x2 = n(q[2]);
    let y2 = n(q[3]);
    let x1_dot = n(v[0]);
    let y1_dot = n(v[1]);
    let x2_dot = n(v[2]);
    let y2_dot = n(v[3]);
    let t0 = x1 - x2;
    let t1 = y1 - y2;
    let t2 = x1_dot - x2_dot;
    let t3 = y1_dot - y2_dot;
    let t4 = n(p.inverse_m1) * (n(p.inverse_l1) * x1);
    let t5 = n(p.inverse_m1) * (n(p.inverse_l1) * y1);
    let t6 = n(p.inverse_l2) * t0;
    let t7 = n(p.inverse_l2) * t1;
    let t8 = n(p.inverse_m2) * t6;
    let t9 = n(p.inverse_m1) * t6;
    let t10 = n(p.inverse_m2) * t7;
    let t11 = n(p.inverse_m1) * t7;
    let t12 = y1_dot.mul_add(y1_dot, x1_dot * x1_dot);
    let t13 = n(p.inverse_l1).neg_mul_add(t12, y1 * n(p.g_over_l1));
    // Row upper_rod: pivot d[upper_rod].
    let t14 = n(p.inverse_l1) * y1.mul_add(t5, x1 * t4);
    let t15 = n(p.inverse_l2) * t5.mul_add(t1, t4 * t0);
    let t16 = N::ONE / t14;
    let t17 = n(p.inverse_l2) * t1.mul_add(t10 + t11, t0 * (t8 + t9));
    // Eliminates upper_rod from row lower_rod: l[lower_rod, upper_rod].
    let t18 = t16 * t15;
    let t19 = n(p.inverse_l2) * t3.mul_add(t3, t2 * t2);
    // Row lower_rod: pivot d[lower_rod].
    let t20 = t15.neg_mul_add(t18, t17);
    // Row lower_rod: right-hand side z[lower_rod].
    let t21 = t18.mul_add(t13, t19) / t20;
    // Back substitution: lambda[upper_rod].
    let t22 = t18.mul_add(t21, t16 * t13);
    let x1_ddot = t4.mul_sub(t22, t9 * t21);
    let y1_ddot = t5.mul_sub(t22, t11.mul_add(t21, n(p.g)));
    let x2_ddot = t8 * t21;
    let y2_ddot = t10.mul_sub(t21, n(p.g));
    let sound = PIVOTS.hold(t14, t14) & PIVOTS.hold(t20, t17) & y1_ddot.is_finite();
    if !sound {
        let pivots = [(4, t14, t14), (5, t20, t17)];
        PIVOTS.check(pivots)?;
    }
    let accelerations = [
        x1_ddot.store(),
        y1_ddot.store(),
        x2_ddot.store(),
        y2_ddot.store(),
    ];
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
    pub fn multipliers<'a, S>(Multipliers { p: &'a Prepared<S>, q: &'a [S; 4], v: &'a [S; 4] })
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
    let x1 = n(q[0]);
    let y1 = n(q[1]);
    let x2 = n(q[2]);
    let y2 = n(q[3]);
    let x1_dot = n(v[0]);
    let y1_dot = n(v[1]);
    let x2_dot = n(v[2]);
    let y2_dot = n(v[3]);
    let t0 = n(p.inverse_l1) * x1;
    let t1 = n(p.inverse_l1) * y1;
    let t2 = x1_dot - x2_dot;
    let t3 = y1_dot - y2_dot;
    // Eliminates y1 from row upper_rod: l[upper_rod, y1].
    let t4 = t1 * n(p.inverse_m1);
    let t5 = (x1 - x2) * n(p.inverse_l2);
    let t6 = (y1 - y2) * n(p.inverse_l2);
    // Eliminates x1 from row lower_rod: l[lower_rod, x1].
    let t7 = n(p.inverse_m1) * t5;
    // Eliminates y1 from row lower_rod: l[lower_rod, y1].
    let t8 = n(p.inverse_m1) * t6;
    // Eliminates y2 from row lower_rod: l[lower_rod, y2].
    let t9 = t6 * n(p.inverse_m2);
    // Eliminates x1 from row upper_rod: l[upper_rod, x1]; Row upper_rod: pivot d[upper_rod].
    let t10 = t0.mul_add(t0 * n(p.inverse_m1), t1 * t4);
    let t11 = n(p.inverse_l1) * x1_dot.mul_add(x1_dot, y1_dot * y1_dot);
    // Row upper_rod: right-hand side z[upper_rod].
    let t12 = t4.mul_add(n(p.minus_m1_g), t11);
    let t13 = N::ONE / t10;
    let t14 = t0.mul_add(t7, t1 * t8);
    let t15 = t2.mul_add(t2, t3 * t3);
    // Eliminates x2 from row lower_rod: l[lower_rod, x2].
    let t16 = t5.mul_add(t5 * n(p.inverse_m2), t6 * t9);
    let t17 = t5.mul_add(t7, t6 * t8) + t16;
    let t18 = n(p.inverse_l2).mul_add(t15, t9 * n(p.m2_g));
    // Eliminates upper_rod from row lower_rod: l[lower_rod, upper_rod].
    let t19 = t13 * t14;
    // Row lower_rod: pivot d[lower_rod].
    let t20 = t14.neg_mul_add(t19, t17);
    // Row lower_rod: right-hand side z[lower_rod].
    let t21 = t12.neg_mul_add(t19, n(p.minus_m1_g).mul_add(t8, t18));
    let t22 = t21 / t20;
    let lambda1 = t19.mul_sub(t22, t12 * t13);
    let lambda2 = -t22;
    let sound = PIVOTS.hold(t10, t10) & PIVOTS.hold(t20, t17) & lambda2.is_finite();
    if !sound {
        let pivots = [(4, t10, t10), (5, t20, t17)];
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
    pub fn projection<'a, S>(ProjectionCall { p: &'a Prepared<S>, q: &'a [S; 4], v: &'a [S; 4] })
        -> Result<[S; 32], ::lagrangian::emitted::Singular> = projection_in;
}

#[inline(always)]
fn projection_in<S: Copy, N: ::lagrangian::emitted::Scalar<Stored = S>>(
    call: ProjectionCall<'_, S>,
) -> Result<[S; 32], ::lagrangian::emitted::Singular> {
    let ProjectionCall { p, q, v } = call;
    let n = N::load;
    if let Some(singular) = p.singular {
        return Err(singular);
    }
    let x1 = n(q[0]);
    let y1 = n(q[1]);
    let x2 = n(q[2]);
    let y2 = n(q[3]);
    let x1_dot = n(v[0]);
    let y1_dot = n(v[1]);
    let x2_dot = n(v[2]);
    let y2_dot = n(v[3]);
    let r4 = x1 * n(p.inverse_l1);
    let r5 = y1 * n(p.inverse_l1);
    let t0 = x1 - x2;
    let t1 = y1 - y2;
    let t2 = r4 * n(p.inverse_m1);
    let t3 = r5 * n(p.inverse_m1);
    let r8 = t0 * n(p.inverse_l2);
    let r9 = t1 * n(p.inverse_l2);
    let t4 = r8 * n(p.inverse_m1);
    let t5 = r8 * n(p.inverse_m2);
    let t6 = r9 * n(p.inverse_m1);
    let t7 = r9 * n(p.inverse_m2);
    let r28 = r5.mul_add(t3, r4 * t2);
    let t8 = y1.mul_add(y1, x1.mul_sub(x1, n(p.l1_squared)));
    let r0 = n(p.half_over_l1) * t8;
    let r2 = n(p.inverse_l1) * y1.mul_add(y1_dot, x1 * x1_dot);
    let t9 = t1.mul_add(t1, t0.mul_sub(t0, n(p.l2_squared)));
    let r1 = n(p.half_over_l2) * t9;
    let t10 = t1.mul_add(y1_dot - y2_dot, t0 * (x1_dot - x2_dot));
    let r3 = n(p.inverse_l2) * t10;
    let t11 = N::ONE / r28;
    let t12 = r5.mul_add(t6, r4 * t4);
    let r31 = r9.mul_add(t6, r8 * t4) + r9.mul_add(t7, r8 * t5);
    let t13 = t11 * t12;
    let t14 = r0 * t11;
    let t15 = r2 * t11;
    let r29 = t12.neg_mul_add(t13, r31);
    let t16 = N::ONE / r29;
    let t17 = r0.neg_mul_add(t13, r1) * t16;
    let t18 = t16 * r2.neg_mul_add(t13, r3);
    let t19 = t13 * t17;
    let t20 = t13 * t18;
    let t21 = t14 - t19;
    let t22 = t15 - t20;
    let zero = N::ZERO;
    let r10 = t0 * n(p.minus_inverse_l2);
    let r11 = t1 * n(p.minus_inverse_l2);
    let r16 = -t2.mul_add(t21, t4 * t17);
    let r17 = -t3.mul_add(t21, t6 * t17);
    let r18 = t5 * t17;
    let r19 = t7 * t17;
    let r20 = -t2.mul_add(t22, t4 * t18);
    let r21 = -t3.mul_add(t22, t6 * t18);
    let r22 = t5 * t18;
    let r23 = t7 * t18;
    let r24 = t19 - t14;
    let r25 = -t17;
    let r26 = t20 - t15;
    let r27 = -t18;
    let sound = PIVOTS.hold(r28, r28) & PIVOTS.hold(r29, r31) & r21.is_finite();
    if !sound {
        let pivots = [(4, r28, r28), (5, r29, r31)];
        PIVOTS.check(pivots)?;
    }
    let projection = [
        r0.store(),
        r1.store(),
        r2.store(),
        r3.store(),
        r4.store(),
        r5.store(),
        zero.store(),
        zero.store(),
        r8.store(),
        r9.store(),
        r10.store(),
        r11.store(),
        n(p.m1).store(),
        n(p.m1).store(),
        n(p.m2).store(),
        n(p.m2).store(),
        r16.store(),
        r17.store(),
        r18.store(),
        r19.store(),
        r20.store(),
        r21.store(),
        r22.store(),
        r23.store(),
        r24.store(),
        r25.store(),
        r26.store(),
        r27.store(),
        r28.store(),
        r29.store(),
        r28.store(),
        r31.store(),
    ];
    Ok(projection)
}

/// Kinetic energy `T`, in J.
///
/// ```text
/// T = 1/2*m1*der(x1)^2 + 1/2*m1*der(y1)^2 + 1/2*m2*der(x2)^2 + 1/2*m2*der(y2)^2
/// ```
pub fn kinetic_energy<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, v: &[S; 4]) -> S {
    let x1_dot = v[0];
    let y1_dot = v[1];
    let x2_dot = v[2];
    let y2_dot = v[3];
    let t0 = p.half_m1 * (y1_dot * y1_dot + x1_dot * x1_dot);
    p.half_m2 * (y2_dot * y2_dot + x2_dot * x2_dot) + t0
}

/// Potential energy `V`, in J.
///
/// ```text
/// V = m1*g*y1 + m2*g*y2
/// ```
pub fn potential_energy<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 4]) -> S {
    let y1 = q[1];
    let y2 = q[3];
    p.m2_g * y2 - p.minus_m1_g * y1
}

::lagrangian::emitted::implement! {
    machine ParticlePendulum "ParticlePendulum" over S, R;
    parameters { m1, m2, l1, l2, g } [
        m1: "m1" "kg" = 1.0;
        m2: "m2" "kg" = 1.0;
        l1: "l1" "m" = 1.0;
        l2: "l2" "m" = 1.0;
        g: "g" "m/s^2" = 9.81;
    ]
    coordinates 4 Coordinates { x1, y1, x2, y2 } [
        x1: "x1" "m";
        y1: "y1" "m";
        x2: "x2" "m";
        y2: "y2" "m";
    ]
    inputs Inputs {} [], defined here
    outputs Outputs {} [], defined here
    prepared Prepared {
        m1, m2, g, l1_squared, inverse_l1, half_over_l1, l2_squared, inverse_l2, half_over_l2, m2_g,
        half_m1, half_m2, minus_m1_g, minus_m2_g, minus_inverse_l2, minus_inverse_l1, inverse_m1,
        inverse_m2, g_over_l1,
    }
    singular singular
    accelerations { (p, t, q, v, u) Accelerations { p, q, v } }
    system {
        matrix mass_matrix(p, t, q) = mass_matrix(p);
        vector bias(p, t, q, v);
        vector applied(p, t, q, v, u) = applied(p);
        vector forces(p, t, q, v, u) = forces(p);
        numbers constraint_positions(p, t, q) = constraint_positions(p, q);
        numbers constraint_rates(p, t, q, v) = constraint_rates(p, q, v);
        numbers constraint_matrix(p, t, q) = constraint_matrix(p, q);
        numbers constraint_bias(p, t, q, v) = constraint_bias(p, v);
        number kinetic_energy(p, t, q, v) = kinetic_energy(p, v);
        number potential_energy(p, t, q, u) = potential_energy(p, q);
        number dissipation(p, t, q, v, u);
        number work_rate(p, t, q, v, a, u);
        number dissipation_rate(p, t, q, v, u);
        outputs outputs(p, t, q, v, a, u) = Outputs {};
        constraints constraints(p) = [("upper_rod", "m", "N", true), ("lower_rod", "m", "N", true)];
        solved_in_place projection(p, t, q, v) = ProjectionCall { p, q, v };
        solved multipliers(p, t, q, v, u) = multipliers(p, q, v);
        workspace with_workspace(p) = ::lagrangian::emitted::constraint_workspace(4, 2);
    }
    absent [MAY_SLIDE MAY_COLLIDE]
    intervals []
    lanes [N]
    numbers []
}
