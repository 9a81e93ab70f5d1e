// @generated from machines/rolling_coin.machine by `cargo xtask generate`; edits are lost.

//! A coin, or a disc, that rolls on a table: position of the contact point, heading, lean and
//! roll. The
//! material point that touches is at rest: two constraints on rates alone.
//!
//! 5 coordinates, 5 parameters. Arithmetic of one call:
//!
//! | function | mul | add | div | sin cos | other | temporaries |
//! | --- | --: | --: | --: | --: | --: | --: |
//! | `prepare` | 7 | 6 | 2 | 0 | 0 | 15 |
//! | `mass_matrix` | 10 | 1 | 0 | 2 | 0 | 15 |
//! | `bias` | 23 | 7 | 0 | 2 | 0 | 34 |
//! | `applied` | 1 | 0 | 0 | 1 | 0 | 2 |
//! | `forces` | 24 | 9 | 0 | 2 | 0 | 37 |
//! | `constraint_rates` | 5 | 3 | 0 | 1 | 0 | 10 |
//! | `constraint_matrix` | 0 | 1 | 0 | 1 | 0 | 3 |
//! | `constraint_bias` | 6 | 2 | 0 | 1 | 0 | 10 |
//! | `accelerations` | 101 | 56 | 5 | 2 | 0 | 166 |
//! | `multipliers` | 84 | 41 | 5 | 2 | 0 | 134 |
//! | `projection` | 62 | 36 | 5 | 2 | 0 | 107 |
//! | `kinetic_energy` | 20 | 10 | 0 | 2 | 0 | 34 |
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

/// A coin, or a disc, that rolls on a table: position of the contact point, heading, lean and
/// roll. The
/// material point that touches is at rest: two constraints on rates alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RollingCoin<S = f64> {
    /// `m`. Unit: `kg`. Default: 1.
    pub m: S,
    /// `r`. Unit: `m`. Default: 0.1.
    pub r: S,
    /// `g`. Unit: `m/s^2`. Default: 9.81.
    pub g: S,
    /// Inertia about the axis, and across it; those of a uniform disc. Unit: `kg*m^2`.
    /// Default: 0.005.
    pub C: S,
    /// `A`. Unit: `kg*m^2`. Default: 0.0025.
    pub A: S,
}

impl<S: ::lagrangian::emitted::Scalar> RollingCoin<S> {
    /// Computes what depends on the parameters alone, once.
    pub fn prepare(&self) -> Prepared<S> {
        let m_r = self.m * self.r;
        let inverse_C = S::ONE / self.C;
        let t0 = self.r * m_r;
        let A_plus_m_r_squared = self.A + t0;
        let C_plus_m_r_squared = self.C + t0;
        let k0 = C_plus_m_r_squared - self.A;
        let r_over_C = self.r * inverse_C;
        let m_r_g = m_r * self.g;
        let two_m_r = m_r * S::from_f64(2.0);
        let k1 = S::from_f64(2.0) * k0;
        let minus_m_r = -m_r;
        let minus_C = -self.C;
        let minus_r = -self.r;
        let k2 = S::ONE / A_plus_m_r_squared;
        let r_squared_over_C = self.r * r_over_C;
        let pivots = [
            (4, self.C, self.C),
            (3, A_plus_m_r_squared, A_plus_m_r_squared),
        ];
        Prepared {
            m: self.m,
            r: self.r,
            C: self.C,
            A: self.A,
            m_r_g,
            m_r,
            C_plus_m_r_squared,
            A_plus_m_r_squared,
            two_m_r,
            k0,
            k1,
            minus_m_r,
            minus_C,
            minus_r,
            k2,
            inverse_C,
            r_over_C,
            r_squared_over_C,
            singular: PIVOTS.vanished(pivots),
        }
    }

    /// The start values of the description, at `t = 0`.
    pub fn start(&self) -> ::lagrangian::emitted::State<Coordinates<S>> {
        let zero = S::ZERO;
        let lean = S::from_ratio(-1, 5);
        let x_rate = S::from_f64(0.8437240238811389) + S::from_f64(-4.102211543469247e-17);
        let heading_rate = S::from_f64(1.6229615122531817) + S::from_f64(-1.1074752849271055e-16);
        let roll_rate = S::from_f64(8.437240238811388) + S::from_f64(7.000018702782318e-16);
        let q = [zero, zero, zero, lean, zero];
        let v = [x_rate, zero, heading_rate, zero, roll_rate];
        ::lagrangian::emitted::State {
            t: 0.0,
            q: Coordinates::from_array(q),
            v: Coordinates::from_array(v),
        }
    }
}

/// The coordinates of [`RollingCoin`], or their rates, by name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coordinates<S = f64> {
    /// `x`. Unit: `m`.
    pub x: S,
    /// `y`. Unit: `m`.
    pub y: S,
    /// `heading`. Unit: `rad`.
    pub heading: S,
    /// `lean`. Unit: `rad`.
    pub lean: S,
    /// `roll`. Unit: `rad`.
    pub roll: S,
}

/// The parameters of a [`RollingCoin`], with the work done that depends on them alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prepared<S = f64> {
    /// `m`
    m: S,
    /// `r`
    r: S,
    /// `C`
    C: S,
    /// `A`
    A: S,
    /// `m*r*g`
    m_r_g: S,
    /// `m*r`
    m_r: S,
    /// `C + m*r^2`
    C_plus_m_r_squared: S,
    /// `A + m*r^2`
    A_plus_m_r_squared: S,
    /// `2*m*r`
    two_m_r: S,
    /// `C - A + m*r^2`
    k0: S,
    /// `2*(C - A + m*r^2)`
    k1: S,
    /// `-m*r`
    minus_m_r: S,
    /// `-C`
    minus_C: S,
    /// `-r`
    minus_r: S,
    /// `1/(A + m*r^2)`
    k2: S,
    /// `1/C`
    inverse_C: S,
    /// `r/C`
    r_over_C: S,
    /// `r^2/C`
    r_squared_over_C: S,
    /// Why these parameters leave the machine without accelerations, if they do.
    singular: Option<::lagrangian::emitted::Singular>,
}

/// A pivot of an elimination that is not above this share of its diagonal element may be rounding
/// errors alone.
const PIVOTS: ::lagrangian::emitted::Pivots = ::lagrangian::emitted::Pivots::new(5, 7);

/// Mass matrix `M`.
///
/// ```text
/// M[x, x] = m
/// M[y, y] = m
/// M[heading, x] = m*r*cos(heading)*sin(lean)
/// M[heading, y] = m*r*sin(heading)*sin(lean)
/// M[heading, heading] = A*cos(lean)^2 + (m*r^2 + C)*sin(lean)^2
/// M[lean, x] = m*r*sin(heading)*cos(lean)
/// M[lean, y] = -m*r*cos(heading)*cos(lean)
/// M[lean, lean] = m*r^2 + A
/// M[roll, heading] = C*sin(lean)
/// M[roll, roll] = C
/// ```
pub fn mass_matrix<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 5]) -> [[S; 5]; 5] {
    let heading = q[2];
    let lean = q[3];
    let (sin_heading, cos_heading) = heading.sin_cos();
    let (sin_lean, cos_lean) = lean.sin_cos();
    let t0 = p.m_r * sin_heading;
    let zero = S::ZERO;
    let m31 = sin_lean * (p.m_r * cos_heading);
    let m32 = sin_lean * t0;
    let m33 = p.C_plus_m_r_squared - cos_lean * (cos_lean * p.k0);
    let m41 = cos_lean * t0;
    let m42 = cos_lean * (cos_heading * p.minus_m_r);
    let m53 = sin_lean * p.C;
    [
        [p.m, zero, m31, m41, zero],
        [zero, p.m, m32, m42, zero],
        [m31, m32, m33, zero, m53],
        [m41, m42, zero, p.A_plus_m_r_squared, zero],
        [zero, zero, m53, zero, p.C],
    ]
}

/// Bias `h`: velocity products and explicit time in the inertia forces.
///
/// ```text
/// h[x] = 2*m*r*cos(heading)*cos(lean)*der(heading)*der(lean)
///     - m*r*sin(heading)*sin(lean)*der(heading)^2 - m*r*sin(heading)*sin(lean)*der(lean)^2
/// h[y] = m*r*cos(heading)*sin(lean)*der(heading)^2
///     + 2*m*r*sin(heading)*cos(lean)*der(heading)*der(lean)
///     + m*r*cos(heading)*sin(lean)*der(lean)^2
/// h[heading] = 2*(m*r^2 + C - A)*cos(lean)*sin(lean)*der(heading)*der(lean)
///     + C*cos(lean)*der(lean)*der(roll)
/// h[lean] = -(m*r^2 + C - A)*cos(lean)*sin(lean)*der(heading)^2
///     - C*cos(lean)*der(heading)*der(roll)
/// h[roll] = C*cos(lean)*der(heading)*der(lean)
/// ```
pub fn bias<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 5], v: &[S; 5]) -> [S; 5] {
    let heading = q[2];
    let lean = q[3];
    let heading_dot = v[2];
    let lean_dot = v[3];
    let roll_dot = v[4];
    let (sin_lean, cos_lean) = lean.sin_cos();
    let (sin_heading, cos_heading) = heading.sin_cos();
    let t0 = roll_dot * p.C;
    let t1 = lean_dot * lean_dot;
    let t2 = cos_lean * lean_dot;
    let t3 = p.m_r * sin_lean;
    let t4 = heading_dot * sin_lean;
    let t5 = t2 * p.two_m_r;
    let t6 = t3 * sin_heading;
    let t7 = t3 * cos_heading;
    let h_x = heading_dot * (cos_heading * t5 - heading_dot * t6) - t6 * t1;
    let h_y = heading_dot * (heading_dot * t7 + sin_heading * t5) + t1 * t7;
    let h_heading = t2 * (t0 + t4 * p.k1);
    let h_lean = -((t0 + t4 * p.k0) * (heading_dot * cos_lean));
    let h_roll = t2 * (heading_dot * p.C);
    [h_x, h_y, h_heading, h_lean, h_roll]
}

/// Applied generalized forces `Q`.
///
/// ```text
/// Q[lean] = m*r*g*sin(lean)
/// ```
pub fn applied<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 5]) -> [S; 5] {
    let lean = q[3];
    let sin_lean = lean.sin();
    let zero = S::ZERO;
    let q_lean = p.m_r_g * sin_lean;
    [zero, zero, zero, q_lean, zero]
}

/// Right-hand side `f = Q - h` of `M a = f`.
pub fn forces<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 5], v: &[S; 5]) -> [S; 5] {
    let heading = q[2];
    let lean = q[3];
    let heading_dot = v[2];
    let lean_dot = v[3];
    let roll_dot = v[4];
    let (sin_lean, cos_lean) = lean.sin_cos();
    let (sin_heading, cos_heading) = heading.sin_cos();
    let t0 = lean_dot * lean_dot;
    let t1 = roll_dot * p.C;
    let t2 = cos_lean * lean_dot;
    let t3 = p.m_r * sin_lean;
    let t4 = heading_dot * sin_lean;
    let t5 = t2 * p.two_m_r;
    let t6 = t3 * sin_heading;
    let t7 = t3 * cos_heading;
    let f_x = t6 * t0 - heading_dot * (cos_heading * t5 - heading_dot * t6);
    let f_y = -(heading_dot * (heading_dot * t7 + sin_heading * t5) + t0 * t7);
    let f_heading = -(t2 * (t1 + t4 * p.k1));
    let f_lean = (t1 + t4 * p.k0) * (heading_dot * cos_lean) + sin_lean * p.m_r_g;
    let f_roll = t2 * (heading_dot * p.minus_C);
    [f_x, f_y, f_heading, f_lean, f_roll]
}

/// Residuals `phi = G v + dg/dt` of the constraints at the level of velocities.
///
/// ```text
/// phi[ahead] = cos(heading)*der(x) + sin(heading)*der(y) - r*der(roll)
/// phi[across] = cos(heading)*der(y) - sin(heading)*der(x)
/// ```
pub fn constraint_rates<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 5],
    v: &[S; 5],
) -> [S; 2] {
    let heading = q[2];
    let x_dot = v[0];
    let y_dot = v[1];
    let roll_dot = v[4];
    let (sin_heading, cos_heading) = heading.sin_cos();
    let phi1 = cos_heading * x_dot + sin_heading * y_dot + roll_dot * p.minus_r;
    let phi2 = cos_heading * y_dot - sin_heading * x_dot;
    [phi1, phi2]
}

/// Constraint matrix `G`, the derivatives of `phi` by the rates.
///
/// ```text
/// G[ahead, x] = cos(heading)
/// G[ahead, y] = sin(heading)
/// G[ahead, roll] = -r
/// G[across, x] = -sin(heading)
/// G[across, y] = cos(heading)
/// ```
pub fn constraint_matrix<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 5]) -> [S; 10] {
    let heading = q[2];
    let (sin_heading, cos_heading) = heading.sin_cos();
    let zero = S::ZERO;
    let g2_1 = -sin_heading;
    [
        cos_heading,
        sin_heading,
        zero,
        zero,
        p.minus_r,
        g2_1,
        cos_heading,
        zero,
        zero,
        zero,
    ]
}

/// Right-hand side `gamma` of `G a = gamma`.
///
/// ```text
/// gamma[ahead] = sin(heading)*der(x)*der(heading) - cos(heading)*der(y)*der(heading)
/// gamma[across] = cos(heading)*der(x)*der(heading) + sin(heading)*der(y)*der(heading)
/// ```
pub fn constraint_bias<S: ::lagrangian::emitted::Scalar>(q: &[S; 5], v: &[S; 5]) -> [S; 2] {
    let heading = q[2];
    let x_dot = v[0];
    let y_dot = v[1];
    let heading_dot = v[2];
    let (sin_heading, cos_heading) = heading.sin_cos();
    let t0 = heading_dot * y_dot;
    let t1 = heading_dot * x_dot;
    let gamma1 = sin_heading * t1 - t0 * cos_heading;
    let gamma2 = cos_heading * t1 + t0 * sin_heading;
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
    pub fn accelerations<'a, S>(Accelerations { p: &'a Prepared<S>, q: &'a [S; 5], v: &'a [S; 5] })
        -> Result<[S; 5], ::lagrangian::emitted::Singular> = accelerations_in;
}

#[inline(always)]
fn accelerations_in<S: Copy, N: ::lagrangian::emitted::Scalar<Stored = S>>(
    call: Accelerations<'_, S>,
) -> Result<[S; 5], ::lagrangian::emitted::Singular> {
    let Accelerations { p, q, v } = call;
    let n = N::load;
    if let Some(singular) = p.singular {
        return Err(singular);
    }
    let heading = n(q[2]);
    let lean = n(q[3]);
    let x_dot = n(v[0]);
    let y_dot = n(v[1]);
    let heading_dot = n(v[2]);
    let lean_dot = n(v[3]);
    let roll_dot = n(v[4]);
    let angles = [lean, heading];
    let circular = N::sin_cos_all(angles);
    let (sin_lean, cos_lean) = circular[0];
    let (sin_heading, cos_heading) = circular[1];
    let t0 = lean_dot * lean_dot;
    let t1 = n(p.C) * roll_dot;
    let t2 = sin_lean * n(p.C);
    let t3 = cos_lean * n(p.m_r);
    let t4 = sin_lean * n(p.m_r);
    let t5 = cos_lean * lean_dot;
    let t6 = sin_lean * heading_dot;
    // Eliminates roll from row heading: l[heading, roll].
    let t7 = n(p.inverse_C) * t2;
    let t8 = cos_lean * n(p.k0);
    let t9 = cos_lean.neg_mul_add(t8, n(p.C_plus_m_r_squared));
    let t10 = sin_heading * t3;
    let t11 = t4 * cos_heading;
    let t12 = cos_heading * t3;
    let t13 = t4 * sin_heading;
    let t14 = t2 * n(p.r_over_C);
    let t15 = t5 * n(p.two_m_r);
    // Row heading: pivot d[heading].
    let t16 = t2.neg_mul_add(t7, t9);
    // Eliminates lean from row x: l[x, lean].
    let t17 = n(p.k2) * t10;
    let t18 = t5 * (n(p.C) * heading_dot);
    // Eliminates lean from row y: l[y, lean].
    let t19 = n(p.k2) * t12;
    let t20 = N::ONE / t16;
    let t21 = n(p.k0).mul_add(t6, t1);
    let t22 = t21.mul_add(cos_lean * heading_dot, sin_lean * n(p.m_r_g));
    let t23 = cos_heading.mul_sub(t15, t13 * heading_dot);
    let t24 = t11.mul_add(heading_dot, sin_heading * t15);
    // Row heading: right-hand side z[heading].
    let t25 = t5.mul_sub(t6.mul_add(n(p.k1), t1), t7 * t18);
    let t26 = sin_heading.mul_sub(x_dot, cos_heading * y_dot);
    // Eliminates heading from row x: l[x, heading].
    let t27 = t20 * t11;
    // Eliminates heading from row y: l[y, heading].
    let t28 = t20 * t13;
    // Eliminates heading from row ahead: l[ahead, heading].
    let t29 = t20 * t14;
    let t30 = cos_heading.mul_add(x_dot, sin_heading * y_dot);
    // Row x: pivot d[x].
    let t31 = t11.neg_mul_add(t27, t10.neg_mul_add(t17, n(p.m)));
    let t32 = t11.neg_mul_add(t28, t10 * t19);
    let t33 = t11.neg_mul_add(t29, cos_heading);
    let t34 = t17.mul_add(t22, heading_dot.mul_sub(t23, t13 * t0));
    // Row x: right-hand side z[x].
    let t35 = t27.neg_mul_add(t25, t34);
    let t36 = t19.neg_mul_add(t22, heading_dot.mul_add(t24, t11 * t0));
    let t37 = N::ONE / t31;
    let t38 = heading_dot.mul_sub(t26, n(p.r_over_C) * t18);
    // Eliminates x from row y: l[y, x].
    let t39 = t37 * t32;
    // Eliminates x from row ahead: l[ahead, x].
    let t40 = t37 * t33;
    // Eliminates x from row across: l[across, x].
    let t41 = sin_heading * t37;
    let t42 = t13.neg_mul_add(t28, t12.neg_mul_add(t19, n(p.m)));
    // Row y: pivot d[y].
    let t43 = t32.neg_mul_add(t39, t42);
    let t44 = t32.neg_mul_add(t40, t13.neg_mul_add(t29, sin_heading));
    let t45 = t32.mul_add(t41, cos_heading);
    // Row y: right-hand side z[y].
    let t46 = t39.neg_mul_add(t35, t28.neg_mul_add(t25, t36));
    let t47 = N::ONE / t43;
    // Eliminates y from row ahead: l[ahead, y].
    let t48 = t47 * t44;
    // Eliminates y from row across: l[across, y].
    let t49 = t47 * t45;
    let t50 = t33.mul_add(t40, t14.mul_add(t29, n(p.r_squared_over_C)));
    // Row ahead: pivot d[ahead].
    let t51 = t44.mul_add(t48, t50);
    let t52 = t49.neg_mul_add(t44, t41 * t33);
    // Row ahead: right-hand side z[ahead].
    let t53 = t48.mul_add(t46, t40.mul_add(t35, t29.mul_add(t25, t38)));
    let t54 = t45.mul_add(t49, sin_heading * t41);
    let t55 = N::ONE / t51;
    // Eliminates ahead from row across: l[across, ahead].
    let t56 = t55 * t52;
    let t57 = t49.mul_add(t46, t41.neg_mul_add(t35, heading_dot * t30));
    // Row across: pivot d[across].
    let t58 = t52.neg_mul_add(t56, t54);
    // Row across: right-hand side z[across].
    let t59 = t56.mul_add(t53, t57) / t58;
    // Back substitution: lambda[ahead].
    let t60 = t56.mul_add(t59, t55 * t53);
    let t61 = t49.neg_mul_add(t59, t47 * t46);
    let t62 = t48 * t60;
    let t63 = t40.neg_mul_add(t60, t41.mul_add(t59, t37 * t35));
    // Back substitution: a[y].
    let t64 = t61 - t62;
    let t65 = t39 * t64;
    let t66 = t28.neg_mul_add(t64, t29.neg_mul_add(t60, t20 * t25));
    // Back substitution: a[x].
    let t67 = t63 - t65;
    let t68 = t27 * t67;
    let t69 = n(p.r_over_C).mul_add(t60, n(p.inverse_C) * t18);
    let x_ddot = t65 - t63;
    let y_ddot = t62 - t61;
    let heading_ddot = t68 - t66;
    // Back substitution: a[lean].
    let lean_ddot = t17.mul_add(t67, t19.neg_mul_add(t64, n(p.k2) * t22));
    // Back substitution: a[heading].
    let roll_ddot = t7.mul_sub(t66 - t68, t69);
    let sound = PIVOTS.hold(t16, t9)
        & PIVOTS.hold(t31, n(p.m))
        & PIVOTS.hold(t43, n(p.m))
        & PIVOTS.hold(t51, t51)
        & PIVOTS.hold(t58, t54)
        & roll_ddot.is_finite();
    if !sound {
        let pivots = [
            (2, t16, t9),
            (0, t31, n(p.m)),
            (1, t43, n(p.m)),
            (5, t51, t51),
            (6, t58, t54),
        ];
        PIVOTS.check(pivots)?;
    }
    let accelerations = [
        x_ddot.store(),
        y_ddot.store(),
        heading_ddot.store(),
        lean_ddot.store(),
        roll_ddot.store(),
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
    pub fn multipliers<'a, S>(Multipliers { p: &'a Prepared<S>, q: &'a [S; 5], v: &'a [S; 5] })
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
    let heading = n(q[2]);
    let lean = n(q[3]);
    let x_dot = n(v[0]);
    let y_dot = n(v[1]);
    let heading_dot = n(v[2]);
    let lean_dot = n(v[3]);
    let roll_dot = n(v[4]);
    let angles = [lean, heading];
    let circular = N::sin_cos_all(angles);
    let (sin_lean, cos_lean) = circular[0];
    let (sin_heading, cos_heading) = circular[1];
    let t0 = lean_dot * lean_dot;
    let t1 = n(p.C) * roll_dot;
    let t2 = sin_lean * n(p.C);
    let t3 = cos_lean * n(p.m_r);
    let t4 = sin_lean * n(p.m_r);
    let t5 = cos_lean * lean_dot;
    let t6 = sin_lean * heading_dot;
    // Eliminates roll from row heading: l[heading, roll].
    let t7 = t2 * n(p.inverse_C);
    let t8 = cos_lean * n(p.k0);
    let t9 = cos_lean.neg_mul_add(t8, n(p.C_plus_m_r_squared));
    let t10 = sin_heading * t3;
    let t11 = t4 * cos_heading;
    let t12 = cos_heading * t3;
    let t13 = t4 * sin_heading;
    let t14 = t2 * n(p.r_over_C);
    let t15 = t5 * n(p.two_m_r);
    // Row heading: pivot d[heading].
    let t16 = t2.neg_mul_add(t7, t9);
    // Eliminates lean from row x: l[x, lean].
    let t17 = n(p.k2) * t10;
    let t18 = t5 * (n(p.C) * heading_dot);
    // Eliminates lean from row y: l[y, lean].
    let t19 = n(p.k2) * t12;
    let t20 = N::ONE / t16;
    let t21 = n(p.k0).mul_add(t6, t1);
    let t22 = t21.mul_add(cos_lean * heading_dot, sin_lean * n(p.m_r_g));
    let t23 = cos_heading.mul_sub(t15, t13 * heading_dot);
    let t24 = t11.mul_add(heading_dot, sin_heading * t15);
    // Row heading: right-hand side z[heading].
    let t25 = t5.mul_sub(t6.mul_add(n(p.k1), t1), t7 * t18);
    let t26 = sin_heading.mul_sub(x_dot, cos_heading * y_dot);
    // Eliminates heading from row x: l[x, heading].
    let t27 = t20 * t11;
    // Eliminates heading from row y: l[y, heading].
    let t28 = t20 * t13;
    // Eliminates heading from row ahead: l[ahead, heading].
    let t29 = t20 * t14;
    let t30 = cos_heading.mul_add(x_dot, sin_heading * y_dot);
    // Row x: pivot d[x].
    let t31 = t11.neg_mul_add(t27, t10.neg_mul_add(t17, n(p.m)));
    let t32 = t11.neg_mul_add(t28, t10 * t19);
    let t33 = t11.neg_mul_add(t29, cos_heading);
    let t34 = t17.mul_add(t22, heading_dot.mul_sub(t23, t13 * t0));
    // Row x: right-hand side z[x].
    let t35 = t27.neg_mul_add(t25, t34);
    let t36 = t19.neg_mul_add(t22, heading_dot.mul_add(t24, t11 * t0));
    let t37 = N::ONE / t31;
    let t38 = heading_dot.mul_sub(t26, n(p.r_over_C) * t18);
    // Eliminates x from row y: l[y, x].
    let t39 = t37 * t32;
    // Eliminates x from row ahead: l[ahead, x].
    let t40 = t37 * t33;
    // Eliminates x from row across: l[across, x].
    let t41 = sin_heading * t37;
    let t42 = t13.neg_mul_add(t28, t12.neg_mul_add(t19, n(p.m)));
    // Row y: pivot d[y].
    let t43 = t32.neg_mul_add(t39, t42);
    let t44 = t32.neg_mul_add(t40, t13.neg_mul_add(t29, sin_heading));
    let t45 = t32.mul_add(t41, cos_heading);
    // Row y: right-hand side z[y].
    let t46 = t39.neg_mul_add(t35, t28.neg_mul_add(t25, t36));
    let t47 = N::ONE / t43;
    // Eliminates y from row ahead: l[ahead, y].
    let t48 = t47 * t44;
    // Eliminates y from row across: l[across, y].
    let t49 = t47 * t45;
    let t50 = t33.mul_add(t40, t14.mul_add(t29, n(p.r_squared_over_C)));
    // Row ahead: pivot d[ahead].
    let t51 = t44.mul_add(t48, t50);
    let t52 = t44.neg_mul_add(t49, t33 * t41);
    // Row ahead: right-hand side z[ahead].
    let t53 = t48.mul_add(t46, t40.mul_add(t35, t29.mul_add(t25, t38)));
    let t54 = t45.mul_add(t49, sin_heading * t41);
    let t55 = N::ONE / t51;
    // Eliminates ahead from row across: l[across, ahead].
    let t56 = t55 * t52;
    let t57 = t49.mul_add(t46, t41.neg_mul_add(t35, heading_dot * t30));
    // Row across: pivot d[across].
    let t58 = t52.neg_mul_add(t56, t54);
    // Row across: right-hand side z[across].
    let lambda2 = t56.mul_add(t53, t57) / t58;
    // Back substitution: lambda[ahead].
    let lambda1 = t56.mul_add(lambda2, t55 * t53);
    let sound = PIVOTS.hold(t16, t9)
        & PIVOTS.hold(t31, n(p.m))
        & PIVOTS.hold(t43, n(p.m))
        & PIVOTS.hold(t51, t51)
        & PIVOTS.hold(t58, t54)
        & lambda1.is_finite();
    if !sound {
        let pivots = [
            (2, t16, t9),
            (0, t31, n(p.m)),
            (1, t43, n(p.m)),
            (5, t51, t51),
            (6, t58, t54),
        ];
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
    pub fn projection<'a, S>(ProjectionCall { p: &'a Prepared<S>, q: &'a [S; 5], v: &'a [S; 5] })
        -> Result<[S; 37], ::lagrangian::emitted::Singular> = projection_in;
}

#[inline(always)]
fn projection_in<S: Copy, N: ::lagrangian::emitted::Scalar<Stored = S>>(
    call: ProjectionCall<'_, S>,
) -> Result<[S; 37], ::lagrangian::emitted::Singular> {
    let ProjectionCall { p, q, v } = call;
    let n = N::load;
    if let Some(singular) = p.singular {
        return Err(singular);
    }
    let heading = n(q[2]);
    let lean = n(q[3]);
    let x_dot = n(v[0]);
    let y_dot = n(v[1]);
    let roll_dot = n(v[4]);
    let angles = [lean, heading];
    let circular = N::sin_cos_all(angles);
    let (sin_lean, cos_lean) = circular[0];
    let (sin_heading, cos_heading) = circular[1];
    let t0 = sin_lean * n(p.C);
    let t1 = sin_heading * n(p.m_r);
    let t2 = cos_heading * n(p.m_r);
    let t3 = cos_lean * n(p.k0);
    let r16 = cos_lean.neg_mul_add(t3, n(p.C_plus_m_r_squared));
    let t4 = t0 * n(p.inverse_C);
    let t5 = cos_lean * t1;
    let t6 = sin_lean * t2;
    let t7 = cos_lean * t2;
    let t8 = sin_lean * t1;
    let t9 = t0 * n(p.r_over_C);
    let t10 = t0.neg_mul_add(t4, r16);
    let r3 = cos_heading.mul_sub(y_dot, sin_heading * x_dot);
    let t11 = n(p.k2) * t5;
    let t12 = n(p.k2) * t7;
    let t13 = sin_heading.mul_add(y_dot, cos_heading * x_dot);
    let r2 = roll_dot.neg_mul_add(n(p.r), t13);
    let t14 = N::ONE / t10;
    let t15 = t14 * t6;
    let t16 = t14 * t8;
    let t17 = t14 * t9;
    let t18 = t6.neg_mul_add(t15, t5.neg_mul_add(t11, n(p.m)));
    let t19 = t6.neg_mul_add(t16, t5 * t12);
    let t20 = t6.neg_mul_add(t17, cos_heading);
    let t21 = N::ONE / t18;
    let t22 = t21 * t19;
    let t23 = t21 * t20;
    let t24 = sin_heading * t21;
    let t25 = t8.neg_mul_add(t16, t7.neg_mul_add(t12, n(p.m)));
    let t26 = t19.neg_mul_add(t22, t25);
    let t27 = t19.neg_mul_add(t23, t8.neg_mul_add(t17, sin_heading));
    let t28 = t19.mul_add(t24, cos_heading);
    let t29 = N::ONE / t26;
    let t30 = t29 * t27;
    let t31 = t29 * t28;
    let t32 = t20.mul_add(t23, t9.mul_add(t17, n(p.r_squared_over_C)));
    let r33 = t27.mul_add(t30, t32);
    let t33 = t31.neg_mul_add(t27, t24 * t20);
    let r36 = t28.mul_add(t31, sin_heading * t24);
    let t34 = N::ONE / r33;
    let t35 = t34 * t33;
    let r34 = t33.neg_mul_add(t35, r36);
    let t36 = r2.mul_add(t35, r3) / r34;
    let t37 = t35.mul_add(t36, r2 * t34);
    let t38 = t30.mul_add(t37, t31 * t36);
    let r24 = t22.mul_add(t38, t23.neg_mul_add(t37, t24 * t36));
    let t39 = t15.mul_add(r24, t16.neg_mul_add(t38, t17 * t37));
    let zero = N::ZERO;
    let r9 = -sin_heading;
    let r25 = -t38;
    let r26 = -t39;
    let r27 = -t11.mul_add(r24, t12 * t38);
    let r28 = t4.mul_add(t39, n(p.r_over_C) * t37);
    let r31 = -t37;
    let r32 = -t36;
    let sound = PIVOTS.hold(t10, r16)
        & PIVOTS.hold(t18, n(p.m))
        & PIVOTS.hold(t26, n(p.m))
        & PIVOTS.hold(r33, r33)
        & PIVOTS.hold(r34, r36)
        & r28.is_finite();
    if !sound {
        let pivots = [
            (2, t10, r16),
            (0, t18, n(p.m)),
            (1, t26, n(p.m)),
            (5, r33, r33),
            (6, r34, r36),
        ];
        PIVOTS.check(pivots)?;
    }
    let projection = [
        zero.store(),
        zero.store(),
        r2.store(),
        r3.store(),
        cos_heading.store(),
        sin_heading.store(),
        zero.store(),
        zero.store(),
        n(p.minus_r).store(),
        r9.store(),
        cos_heading.store(),
        zero.store(),
        zero.store(),
        zero.store(),
        n(p.m).store(),
        n(p.m).store(),
        r16.store(),
        n(p.A_plus_m_r_squared).store(),
        n(p.C).store(),
        zero.store(),
        zero.store(),
        zero.store(),
        zero.store(),
        zero.store(),
        r24.store(),
        r25.store(),
        r26.store(),
        r27.store(),
        r28.store(),
        zero.store(),
        zero.store(),
        r31.store(),
        r32.store(),
        r33.store(),
        r34.store(),
        r33.store(),
        r36.store(),
    ];
    Ok(projection)
}

/// Kinetic energy `T`, in J.
///
/// ```text
/// T = 1/2*A*cos(lean)^2*der(heading)^2 + 1/2*A*der(lean)^2
///     + 1/2*C*(sin(lean)*der(heading) + der(roll))^2 + 1/2*m*(sin(lean)^2*(cos(heading)*der(y) -
///     sin(heading)*der(x))^2 + (r*sin(lean)*der(heading) + (cos(heading)*der(x) +
///     sin(heading)*der(y)))^2 + (cos(lean)*(cos(heading)*der(y) - sin(heading)*der(x)) -
///     r*der(lean))^2)
/// ```
pub fn kinetic_energy<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 5],
    v: &[S; 5],
) -> S {
    let heading = q[2];
    let lean = q[3];
    let x_dot = v[0];
    let y_dot = v[1];
    let heading_dot = v[2];
    let lean_dot = v[3];
    let roll_dot = v[4];
    let (sin_heading, cos_heading) = heading.sin_cos();
    let (sin_lean, cos_lean) = lean.sin_cos();
    let t0 = sin_lean * heading_dot;
    let t1 = cos_lean * heading_dot;
    let t2 = cos_heading * y_dot - sin_heading * x_dot;
    let t3 = t0 + roll_dot;
    let t4 = cos_heading * x_dot + sin_heading * y_dot - p.minus_r * t0;
    let t5 = sin_lean * t2;
    let t6 = lean_dot * p.minus_r + cos_lean * t2;
    let t7 = (lean_dot * lean_dot + t1 * t1) * p.A + t3 * (t3 * p.C);
    (t7 + (t4 * t4 + t5 * t5 + t6 * t6) * p.m) * S::from_f64(0.5)
}

/// Potential energy `V`, in J.
///
/// ```text
/// V = m*r*g*cos(lean)
/// ```
pub fn potential_energy<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 5]) -> S {
    let lean = q[3];
    let cos_lean = lean.cos();
    p.m_r_g * cos_lean
}

::lagrangian::emitted::implement! {
    machine RollingCoin "RollingCoin" over S, R;
    parameters { m, r, g, C, A } [
        m: "m" "kg" = 1.0;
        r: "r" "m" = 0.1;
        g: "g" "m/s^2" = 9.81;
        C: "C" "kg*m^2" = 0.005;
        A: "A" "kg*m^2" = 0.0025;
    ]
    coordinates 5 Coordinates { x, y, heading, lean, roll } [
        x: "x" "m";
        y: "y" "m";
        heading: "heading" "rad";
        lean: "lean" "rad";
        roll: "roll" "rad";
    ]
    inputs Inputs {} [], defined here
    outputs Outputs {} [], defined here
    prepared Prepared {
        m, r, C, A, m_r_g, m_r, C_plus_m_r_squared, A_plus_m_r_squared, two_m_r, k0, k1, minus_m_r,
        minus_C, minus_r, k2, inverse_C, r_over_C, r_squared_over_C,
    }
    singular singular
    accelerations { (p, t, q, v, u) Accelerations { p, q, v } }
    system {
        matrix mass_matrix(p, t, q) = mass_matrix(p, q);
        vector bias(p, t, q, v) = bias(p, q, v);
        vector applied(p, t, q, v, u) = applied(p, q);
        vector forces(p, t, q, v, u) = forces(p, q, v);
        numbers constraint_positions(p, t, q);
        numbers constraint_rates(p, t, q, v) = constraint_rates(p, q, v);
        numbers constraint_matrix(p, t, q) = constraint_matrix(p, q);
        numbers constraint_bias(p, t, q, v) = constraint_bias(q, v);
        number kinetic_energy(p, t, q, v) = kinetic_energy(p, q, v);
        number potential_energy(p, t, q, u) = potential_energy(p, q);
        number dissipation(p, t, q, v, u);
        number work_rate(p, t, q, v, a, u);
        number dissipation_rate(p, t, q, v, u);
        outputs outputs(p, t, q, v, a, u) = Outputs {};
        constraints constraints(p) = [("ahead", "m/s", "N", false), ("across", "m/s", "N", false)];
        solved_in_place projection(p, t, q, v) = ProjectionCall { p, q, v };
        solved multipliers(p, t, q, v, u) = multipliers(p, q, v);
        workspace with_workspace(p) = ::lagrangian::emitted::constraint_workspace(5, 2);
    }
    absent [MAY_SLIDE MAY_COLLIDE]
    intervals []
    lanes [N]
    numbers []
}
