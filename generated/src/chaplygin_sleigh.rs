// @generated from machines/chaplygin_sleigh.machine by `cargo xtask generate`; edits are lost.

//! The sleigh of S. A. Chaplygin: a rigid body on ice with one blade, which moves only along its
//! own direction;
//! the mass centre is ahead of the blade. It turns until it runs with the mass centre in front.
//!
//! 3 coordinates, 3 parameters, 1 output. Arithmetic of one call:
//!
//! | function | mul | add | div | sin cos | other | temporaries |
//! | --- | --: | --: | --: | --: | --: | --: |
//! | `prepare` | 2 | 2 | 2 | 0 | 0 | 6 |
//! | `mass_matrix` | 2 | 0 | 0 | 1 | 0 | 4 |
//! | `bias` | 4 | 0 | 0 | 1 | 0 | 6 |
//! | `forces` | 4 | 0 | 0 | 1 | 0 | 6 |
//! | `constraint_rates` | 2 | 1 | 0 | 1 | 0 | 5 |
//! | `constraint_matrix` | 0 | 1 | 0 | 1 | 0 | 3 |
//! | `constraint_bias` | 4 | 1 | 0 | 1 | 0 | 7 |
//! | `accelerations` | 22 | 8 | 1 | 1 | 0 | 33 |
//! | `multipliers` | 10 | 4 | 1 | 1 | 0 | 17 |
//! | `projection` | 20 | 11 | 2 | 1 | 0 | 35 |
//! | `kinetic_energy` | 9 | 4 | 0 | 1 | 0 | 15 |
//! | `output_along` | 2 | 1 | 0 | 1 | 0 | 5 |
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

/// The sleigh of S. A. Chaplygin: a rigid body on ice with one blade, which moves only along its
/// own direction;
/// the mass centre is ahead of the blade. It turns until it runs with the mass centre in front.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ChaplyginSleigh<S = f64> {
    /// `m`. Unit: `kg`. Default: 1.
    pub m: S,
    /// Inertia about the mass centre. Unit: `kg*m^2`. Default: 0.05.
    pub J: S,
    /// Distance of the mass centre ahead of the blade. Unit: `m`. Default: 0.3.
    pub a: S,
}

impl<S: ::lagrangian::emitted::Scalar> ChaplyginSleigh<S> {
    /// Computes what depends on the parameters alone, once.
    pub fn prepare(&self) -> Prepared<S> {
        let m_a = self.m * self.a;
        let J_plus_m_a_squared = self.J + self.a * m_a;
        let minus_m_a = -m_a;
        let inverse_m = S::ONE / self.m;
        let inverse_J = S::ONE / self.J;
        let pivots = [
            (0, self.m, self.m),
            (1, self.m, self.m),
            (2, self.J, J_plus_m_a_squared),
        ];
        Prepared {
            m: self.m,
            J: self.J,
            a: self.a,
            m_a,
            J_plus_m_a_squared,
            minus_m_a,
            inverse_m,
            inverse_J,
            singular: PIVOTS.vanished(pivots),
        }
    }

    /// The start values of the description, at `t = 0`.
    pub fn start(&self) -> ::lagrangian::emitted::State<Coordinates<S>> {
        let zero = S::ZERO;
        let x_rate = S::from_ratio(2, 5);
        let q = [zero, zero, zero];
        let v = [x_rate, zero, S::from_f64(3.0)];
        ::lagrangian::emitted::State {
            t: 0.0,
            q: Coordinates::from_array(q),
            v: Coordinates::from_array(v),
        }
    }
}

/// The coordinates of [`ChaplyginSleigh`], or their rates, by name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coordinates<S = f64> {
    /// Where the blade touches the ice. Unit: `m`.
    pub x: S,
    /// `y`. Unit: `m`.
    pub y: S,
    /// Direction of the blade. Unit: `rad`.
    pub phi: S,
}

/// What can be observed of a [`ChaplyginSleigh`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outputs<S = f64> {
    /// Speed along the blade. Unit: `m/s`.
    pub along: S,
}

/// The parameters of a [`ChaplyginSleigh`], with the work done that depends on them alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prepared<S = f64> {
    /// `m`
    m: S,
    /// `J`
    J: S,
    /// `a`
    a: S,
    /// `m*a`
    m_a: S,
    /// `J + m*a^2`
    J_plus_m_a_squared: S,
    /// `-m*a`
    minus_m_a: S,
    /// `1/m`
    inverse_m: S,
    /// `1/J`
    inverse_J: S,
    /// Why these parameters leave the machine without accelerations, if they do.
    singular: Option<::lagrangian::emitted::Singular>,
}

/// A pivot of an elimination that is not above this share of its diagonal element may be rounding
/// errors alone.
const PIVOTS: ::lagrangian::emitted::Pivots = ::lagrangian::emitted::Pivots::new(3, 4);

/// Mass matrix `M`.
///
/// ```text
/// M[x, x] = m
/// M[y, y] = m
/// M[phi, x] = -m*a*sin(phi)
/// M[phi, y] = m*a*cos(phi)
/// M[phi, phi] = m*a^2 + J
/// ```
pub fn mass_matrix<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 3]) -> [[S; 3]; 3] {
    let phi = q[2];
    let (sin_phi, cos_phi) = phi.sin_cos();
    let zero = S::ZERO;
    let m31 = p.minus_m_a * sin_phi;
    let m32 = cos_phi * p.m_a;
    [
        [p.m, zero, m31],
        [zero, p.m, m32],
        [m31, m32, p.J_plus_m_a_squared],
    ]
}

/// Bias `h`: velocity products and explicit time in the inertia forces.
///
/// ```text
/// h[x] = -m*a*cos(phi)*der(phi)^2
/// h[y] = -m*a*sin(phi)*der(phi)^2
/// ```
pub fn bias<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 3], v: &[S; 3]) -> [S; 3] {
    let phi = q[2];
    let phi_dot = v[2];
    let (sin_phi, cos_phi) = phi.sin_cos();
    let t0 = phi_dot * (phi_dot * p.minus_m_a);
    let h_x = t0 * cos_phi;
    let h_y = t0 * sin_phi;
    let zero = S::ZERO;
    [h_x, h_y, zero]
}

/// Right-hand side `f = Q - h` of `M a = f`.
pub fn forces<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 3], v: &[S; 3]) -> [S; 3] {
    let phi = q[2];
    let phi_dot = v[2];
    let (sin_phi, cos_phi) = phi.sin_cos();
    let t0 = phi_dot * (phi_dot * p.m_a);
    let f_x = t0 * cos_phi;
    let f_y = t0 * sin_phi;
    let zero = S::ZERO;
    [f_x, f_y, zero]
}

/// Residuals `phi = G v + dg/dt` of the constraints at the level of velocities.
///
/// ```text
/// phi[blade] = cos(phi)*der(y) - sin(phi)*der(x)
/// ```
pub fn constraint_rates<S: ::lagrangian::emitted::Scalar>(q: &[S; 3], v: &[S; 3]) -> [S; 1] {
    let phi = q[2];
    let x_dot = v[0];
    let y_dot = v[1];
    let (sin_phi, cos_phi) = phi.sin_cos();
    let phi1 = cos_phi * y_dot - sin_phi * x_dot;
    [phi1]
}

/// Constraint matrix `G`, the derivatives of `phi` by the rates.
///
/// ```text
/// G[blade, x] = -sin(phi)
/// G[blade, y] = cos(phi)
/// ```
pub fn constraint_matrix<S: ::lagrangian::emitted::Scalar>(q: &[S; 3]) -> [S; 3] {
    let phi = q[2];
    let (sin_phi, cos_phi) = phi.sin_cos();
    let g1_1 = -sin_phi;
    let zero = S::ZERO;
    [g1_1, cos_phi, zero]
}

/// Right-hand side `gamma` of `G a = gamma`.
///
/// ```text
/// gamma[blade] = cos(phi)*der(x)*der(phi) + sin(phi)*der(y)*der(phi)
/// ```
pub fn constraint_bias<S: ::lagrangian::emitted::Scalar>(q: &[S; 3], v: &[S; 3]) -> [S; 1] {
    let phi = q[2];
    let x_dot = v[0];
    let y_dot = v[1];
    let phi_dot = v[2];
    let (sin_phi, cos_phi) = phi.sin_cos();
    let gamma1 = cos_phi * (phi_dot * x_dot) + sin_phi * (phi_dot * y_dot);
    [gamma1]
}

::lagrangian::emitted::fast_function! {
    /// Accelerations `a`, the solution of `M a = f + G^T lambda`, `G a = gamma` eliminated along
    /// the machine.
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
    let phi = n(q[2]);
    let x_dot = n(v[0]);
    let y_dot = n(v[1]);
    let phi_dot = n(v[2]);
    let (sin_phi, cos_phi) = phi.sin_cos();
    let t0 = phi_dot * phi_dot;
    let t1 = sin_phi * n(p.a);
    let t2 = cos_phi * n(p.a);
    let t3 = sin_phi * (phi_dot * y_dot);
    let t4 = n(p.a) * sin_phi.mul_add(sin_phi, cos_phi * cos_phi);
    let t5 = t4 * n(p.inverse_J);
    let t6 = t5.mul_add(t1, sin_phi * n(p.inverse_m));
    let t7 = t2.mul_add(t5, cos_phi * n(p.inverse_m));
    // Row blade: pivot d[blade].
    let t8 = cos_phi.mul_add(t7, sin_phi * t6);
    let t9 = cos_phi.mul_add(phi_dot * x_dot, t3) / t8;
    let x_ddot = t6.neg_mul_add(t9, t0 * t2);
    let y_ddot = t7.mul_add(t9, t0 * t1);
    let phi_ddot = -(t5 * t9);
    let sound = PIVOTS.hold(t8, t8) & phi_ddot.is_finite();
    if !sound {
        let pivots = [(3, t8, t8)];
        PIVOTS.check(pivots)?;
    }
    let accelerations = [x_ddot.store(), y_ddot.store(), phi_ddot.store()];
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
    let phi = n(q[2]);
    let x_dot = n(v[0]);
    let y_dot = n(v[1]);
    let phi_dot = n(v[2]);
    let (sin_phi, cos_phi) = phi.sin_cos();
    let t0 = sin_phi * sin_phi;
    let t1 = cos_phi * cos_phi;
    let t2 = n(p.a) * (t0 + t1) * n(p.inverse_J);
    let t3 = n(p.a).mul_add(t2, n(p.inverse_m));
    // Row blade: pivot d[blade].
    let t4 = t1.mul_add(t3, t0 * t3);
    let lambda1 = cos_phi.mul_add(x_dot, sin_phi * y_dot) * phi_dot / t4;
    let sound = PIVOTS.hold(t4, t4) & lambda1.is_finite();
    if !sound {
        let pivots = [(3, t4, t4)];
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
    let phi = n(q[2]);
    let x_dot = n(v[0]);
    let y_dot = n(v[1]);
    let (sin_phi, cos_phi) = phi.sin_cos();
    let t0 = sin_phi * n(p.m_a);
    let t1 = cos_phi * n(p.m_a);
    let t2 = sin_phi * n(p.inverse_m);
    let t3 = cos_phi * n(p.inverse_m);
    let t4 = n(p.inverse_m) * t0;
    let t5 = n(p.inverse_m) * t1;
    let r1 = cos_phi.mul_sub(y_dot, sin_phi * x_dot);
    let t6 = t1.mul_add(t3, t0 * t2);
    let t7 = t0.neg_mul_add(t4, n(p.J_plus_m_a_squared));
    let t8 = t1.neg_mul_add(t5, t7);
    let t9 = t6 / t8;
    let r16 = t6.mul_add(t9, cos_phi.mul_add(t3, sin_phi * t2));
    let t10 = r1 / r16;
    let r13 = t9 * t10;
    let zero = N::ZERO;
    let r2 = -sin_phi;
    let r11 = t4.mul_add(r13, t2 * t10);
    let r12 = -t5.mul_add(r13, t3 * t10);
    let r15 = -t10;
    let sound = PIVOTS.hold(t8, n(p.J_plus_m_a_squared)) & PIVOTS.hold(r16, r16) & r12.is_finite();
    if !sound {
        let pivots = [(2, t8, n(p.J_plus_m_a_squared)), (3, r16, r16)];
        PIVOTS.check(pivots)?;
    }
    let projection = [
        zero.store(),
        r1.store(),
        r2.store(),
        cos_phi.store(),
        zero.store(),
        n(p.m).store(),
        n(p.m).store(),
        n(p.J_plus_m_a_squared).store(),
        zero.store(),
        zero.store(),
        zero.store(),
        r11.store(),
        r12.store(),
        r13.store(),
        zero.store(),
        r15.store(),
        r16.store(),
        r16.store(),
    ];
    Ok(projection)
}

/// Kinetic energy `T`, in J.
///
/// ```text
/// T = 1/2*J*der(phi)^2
///     + 1/2*m*((der(x) - a*sin(phi)*der(phi))^2 + (der(y) + a*cos(phi)*der(phi))^2)
/// ```
pub fn kinetic_energy<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 3],
    v: &[S; 3],
) -> S {
    let phi = q[2];
    let x_dot = v[0];
    let y_dot = v[1];
    let phi_dot = v[2];
    let (sin_phi, cos_phi) = phi.sin_cos();
    let t0 = phi_dot * p.a;
    let t1 = x_dot - t0 * sin_phi;
    let t2 = t0 * cos_phi + y_dot;
    let t3 = (t2 * t2 + t1 * t1) * p.m + phi_dot * (phi_dot * p.J);
    S::from_f64(0.5) * t3
}

/// Speed along the blade. Unit: `m/s`.
///
/// ```text
/// along = cos(phi)*der(x) + sin(phi)*der(y)
/// ```
pub fn output_along<S: ::lagrangian::emitted::Scalar>(q: &[S; 3], v: &[S; 3]) -> S {
    let phi = q[2];
    let x_dot = v[0];
    let y_dot = v[1];
    let (sin_phi, cos_phi) = phi.sin_cos();
    sin_phi * y_dot + cos_phi * x_dot
}

/// Everything that the description asks to observe.
pub fn outputs<S: ::lagrangian::emitted::Scalar>(q: &[S; 3], v: &[S; 3]) -> Outputs<S> {
    Outputs {
        along: output_along(q, v),
    }
}

::lagrangian::emitted::implement! {
    machine ChaplyginSleigh "ChaplyginSleigh" over S, R;
    parameters { m, J, a } [
        m: "m" "kg" = 1.0;
        J: "J" "kg*m^2" = 0.05;
        a: "a" "m" = 0.3;
    ]
    coordinates 3 Coordinates { x, y, phi } [
        x: "x" "m";
        y: "y" "m";
        phi: "phi" "rad";
    ]
    inputs Inputs {} [], defined here
    outputs Outputs { along } [
        along: "along" "m/s";
    ]
    prepared Prepared { m, J, a, m_a, J_plus_m_a_squared, minus_m_a, inverse_m, inverse_J }
    singular singular
    accelerations { (p, t, q, v, u) Accelerations { p, q, v } }
    system {
        matrix mass_matrix(p, t, q) = mass_matrix(p, q);
        vector bias(p, t, q, v) = bias(p, q, v);
        vector applied(p, t, q, v, u);
        vector forces(p, t, q, v, u) = forces(p, q, v);
        numbers constraint_positions(p, t, q);
        numbers constraint_rates(p, t, q, v) = constraint_rates(q, v);
        numbers constraint_matrix(p, t, q) = constraint_matrix(q);
        numbers constraint_bias(p, t, q, v) = constraint_bias(q, v);
        number kinetic_energy(p, t, q, v) = kinetic_energy(p, q, v);
        number potential_energy(p, t, q, u);
        number dissipation(p, t, q, v, u);
        number work_rate(p, t, q, v, a, u);
        number dissipation_rate(p, t, q, v, u);
        outputs outputs(p, t, q, v, a, u) = outputs(q, v);
        constraints constraints(p) = [("blade", "m/s", "N", false)];
        solved_in_place projection(p, t, q, v) = ProjectionCall { p, q, v };
        solved multipliers(p, t, q, v, u) = multipliers(p, q, v);
        workspace with_workspace(p) = ::lagrangian::emitted::constraint_workspace(3, 1);
    }
    absent [MAY_SLIDE MAY_COLLIDE]
    intervals []
    lanes [N]
    numbers []
}
