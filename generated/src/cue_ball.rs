// @generated from machines/contacts/cue_ball.machine by `cargo xtask generate`; edits are lost.

//! A billiard ball that is struck with side: it slips, which bends its path, until it rolls.
//!
//! The slip keeps its direction and dies after 2u/(7 μ g); until then the path is a parabola, and
//! then straight. (G.-G. Coriolis,
//! Théorie mathématique des effets du jeu de billard, 1835.)
//!
//! 6 coordinates, 10 parameters. Arithmetic of one call:
//!
//! | function | mul | add | div | sin cos | other | temporaries |
//! | --- | --: | --: | --: | --: | --: | --: |
//! | `prepare` | 5 | 4 | 1 | 0 | 0 | 10 |
//! | `mass_matrix` | 1 | 0 | 0 | 1 | 0 | 2 |
//! | `bias` | 7 | 0 | 0 | 1 | 0 | 8 |
//! | `forces` | 7 | 0 | 0 | 1 | 0 | 8 |
//! | `accelerations` | 13 | 4 | 1 | 1 | 0 | 20 |
//! | `gaps` | 0 | 1 | 0 | 0 | 0 | 1 |
//! | `contact_rates` | 7 | 4 | 0 | 2 | 0 | 15 |
//! | `contact_matrix` | 4 | 0 | 0 | 2 | 0 | 8 |
//! | `contact_bias` | 10 | 2 | 0 | 2 | 0 | 16 |
//! | `kinetic_energy` | 15 | 8 | 0 | 1 | 0 | 25 |
//! | `potential_energy` | 1 | 0 | 0 | 0 | 0 | 1 |
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

/// A billiard ball that is struck with side: it slips, which bends its path, until it rolls.
///
/// The slip keeps its direction and dies after 2u/(7 μ g); until then the path is a parabola, and
/// then straight. (G.-G. Coriolis,
/// Théorie mathématique des effets du jeu de billard, 1835.)
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CueBall<S = f64> {
    /// `m`. Unit: `kg`. Default: 0.21.
    pub m: S,
    /// `r`. Unit: `m`. Default: 0.03075.
    pub r: S,
    /// Its velocity, and its spin about three axes. Unit: `m/s`. Default: 2.
    pub vx: S,
    /// `vy`. Unit: `m/s`. Default: 0.
    pub vy: S,
    /// `wx`. Unit: `rad/s`. Default: 40.
    pub wx: S,
    /// `wy`. Unit: `rad/s`. Default: -30.
    pub wy: S,
    /// `wz`. Unit: `rad/s`. Default: 60.
    pub wz: S,
    /// `e`. Unit: `1`. Default: 0.5.
    pub e: S,
    /// `mu`. Unit: `1`. Default: 0.2.
    pub mu: S,
    /// `g`. Unit: `m/s^2`. Default: 9.81.
    pub g: S,
}

impl<S: ::lagrangian::emitted::Scalar> CueBall<S> {
    /// Computes what depends on the parameters alone, once.
    pub fn prepare(&self) -> Prepared<S> {
        let t0 = self.m * self.r;
        let m_g = self.m * self.g;
        let k0 = t0 * (self.r * S::from_ratio(2, 5));
        let k1 = -k0;
        let minus_m_g = -m_g;
        let minus_r = -self.r;
        let minus_g = -self.g;
        let k2 = S::from_f64(2.5) / (self.r * t0);
        let pivots = [
            (0, self.m, self.m),
            (1, self.m, self.m),
            (2, self.m, self.m),
            (4, k0, k0),
            (3, k0, k0),
        ];
        Prepared {
            m: self.m,
            r: self.r,
            e: self.e,
            mu: self.mu,
            k0,
            m_g,
            k1,
            minus_m_g,
            minus_r,
            minus_g,
            k2,
            singular: PIVOTS.vanished(pivots),
        }
    }

    /// The start values of the description, at `t = 0`.
    pub fn start(&self) -> ::lagrangian::emitted::State<Coordinates<S>> {
        let zero = S::ZERO;
        let q = [zero, zero, self.r, zero, zero, zero];
        let v = [self.vx, self.vy, zero, self.wx, self.wy, self.wz];
        ::lagrangian::emitted::State {
            t: 0.0,
            q: Coordinates::from_array(q),
            v: Coordinates::from_array(v),
        }
    }
}

/// The coordinates of [`CueBall`], or their rates, by name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coordinates<S = f64> {
    /// Its centre. Unit: `m`.
    pub x: S,
    /// `y`. Unit: `m`.
    pub y: S,
    /// `z`. Unit: `m`.
    pub z: S,
    /// Its angles, about x, then y, then z of itself. Unit: `rad`.
    pub a: S,
    /// `b`. Unit: `rad`.
    pub b: S,
    /// `c`. Unit: `rad`.
    pub c: S,
}

/// The parameters of a [`CueBall`], with the work done that depends on them alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prepared<S = f64> {
    /// `m`
    m: S,
    /// `r`
    r: S,
    /// `e`
    e: S,
    /// `mu`
    mu: S,
    /// `0.4*m*r^2`
    k0: S,
    /// `m*g`
    m_g: S,
    /// `-0.4*m*r^2`
    k1: S,
    /// `-m*g`
    minus_m_g: S,
    /// `-r`
    minus_r: S,
    /// `-g`
    minus_g: S,
    /// `2.5/m/r^2`
    k2: S,
    /// Why these parameters leave the machine without accelerations, if they do.
    singular: Option<::lagrangian::emitted::Singular>,
}

/// A pivot of an elimination that is not above this share of its diagonal element may be rounding
/// errors alone.
const PIVOTS: ::lagrangian::emitted::Pivots = ::lagrangian::emitted::Pivots::new(6, 6);

/// Mass matrix `M`.
///
/// ```text
/// M[x, x] = m
/// M[y, y] = m
/// M[z, z] = m
/// M[a, a] = 2/5*m*r^2
/// M[b, b] = 2/5*m*r^2
/// M[c, a] = 2/5*m*r^2*sin(b)
/// M[c, c] = 2/5*m*r^2
/// ```
pub fn mass_matrix<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 6]) -> [[S; 6]; 6] {
    let b = q[4];
    let sin_b = b.sin();
    let zero = S::ZERO;
    let m64 = p.k0 * sin_b;
    [
        [p.m, zero, zero, zero, zero, zero],
        [zero, p.m, zero, zero, zero, zero],
        [zero, zero, p.m, zero, zero, zero],
        [zero, zero, zero, p.k0, zero, m64],
        [zero, zero, zero, zero, p.k0, zero],
        [zero, zero, zero, m64, zero, p.k0],
    ]
}

/// Bias `h`: velocity products and explicit time in the inertia forces.
///
/// ```text
/// h[a] = 2/5*m*r^2*cos(b)*der(b)*der(c)
/// h[b] = -2/5*m*r^2*cos(b)*der(a)*der(c)
/// h[c] = 2/5*m*r^2*cos(b)*der(a)*der(b)
/// ```
pub fn bias<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 6], v: &[S; 6]) -> [S; 6] {
    let b = q[4];
    let a_dot = v[3];
    let b_dot = v[4];
    let c_dot = v[5];
    let cos_b = b.cos();
    let t0 = p.k0 * cos_b * b_dot;
    let zero = S::ZERO;
    let h_a = t0 * c_dot;
    let h_b = cos_b * (c_dot * (a_dot * p.k1));
    let h_c = t0 * a_dot;
    [zero, zero, zero, h_a, h_b, h_c]
}

/// Applied generalized forces `Q`.
///
/// ```text
/// Q[z] = -m*g
/// ```
pub fn applied<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>) -> [S; 6] {
    let zero = S::ZERO;
    [zero, zero, p.minus_m_g, zero, zero, zero]
}

/// Right-hand side `f = Q - h` of `M a = f`.
pub fn forces<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 6], v: &[S; 6]) -> [S; 6] {
    let b = q[4];
    let a_dot = v[3];
    let b_dot = v[4];
    let c_dot = v[5];
    let cos_b = b.cos();
    let t0 = p.k1 * cos_b * b_dot;
    let zero = S::ZERO;
    let f_a = t0 * c_dot;
    let f_b = cos_b * (c_dot * (a_dot * p.k0));
    let f_c = t0 * a_dot;
    [zero, zero, p.minus_m_g, f_a, f_b, f_c]
}

::lagrangian::emitted::fast_function! {
    /// Accelerations `a`, the solution of `M a = f` from the mass matrix multiplied out.
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
    pub fn accelerations<'a, S>(Accelerations { p: &'a Prepared<S>, q: &'a [S; 6], v: &'a [S; 6] })
        -> Result<[S; 6], ::lagrangian::emitted::Singular> = accelerations_in;
}

#[inline(always)]
fn accelerations_in<S: Copy, N: ::lagrangian::emitted::Scalar<Stored = S>>(
    call: Accelerations<'_, S>,
) -> Result<[S; 6], ::lagrangian::emitted::Singular> {
    let Accelerations { p, q, v } = call;
    let n = N::load;
    if let Some(singular) = p.singular {
        return Err(singular);
    }
    let b = n(q[4]);
    let a_dot = n(v[3]);
    let b_dot = n(v[4]);
    let c_dot = n(v[5]);
    let (sin_b, cos_b) = b.sin_cos();
    let t0 = n(p.k0) * cos_b;
    let t1 = n(p.k0) * sin_b;
    let t2 = t0 * (c_dot * b_dot);
    // Eliminates a from row c: l[c, a].
    let t3 = n(p.k2) * t1;
    let t4 = t0 * a_dot;
    // Row c: pivot d[c].
    let t5 = t1.neg_mul_add(t3, n(p.k0));
    // Row c: right-hand side z[c].
    let t6 = b_dot.mul_sub(t4, t2 * t3) / t5;
    let zero = N::ZERO;
    // Back substitution: a[a].
    let a_ddot = t3.mul_sub(t6, n(p.k2) * t2);
    let b_ddot = t4 * (n(p.k2) * c_dot);
    let c_ddot = -t6;
    let sound = PIVOTS.hold(t5, n(p.k0)) & c_ddot.is_finite();
    if !sound {
        let pivots = [(5, t5, n(p.k0))];
        PIVOTS.check(pivots)?;
    }
    let accelerations = [
        zero.store(),
        zero.store(),
        n(p.minus_g).store(),
        a_ddot.store(),
        b_ddot.store(),
        c_ddot.store(),
    ];
    Ok(accelerations)
}

/// Gaps `g` of the unilateral contacts, in m: positive where they are open.
///
/// ```text
/// [cloth] = z - r
/// [cloth.across] = z - r
/// ```
pub fn gaps<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 6]) -> [S; 2] {
    let z = q[2];
    let gap1 = z - p.r;
    [gap1, gap1]
}

/// Rates `gamma` at which the gaps of unilateral contacts open and at which these slip, in m/s.
///
/// ```text
/// [cloth.gap] = der(z)
/// [cloth.slip] = der(x) - r*cos(a)*der(b) + r*sin(a)*cos(b)*der(c)
/// [cloth.across.gap] = der(z)
/// [cloth.across.slip] = der(y) + r*der(a) + r*sin(b)*der(c)
/// ```
pub fn contact_rates<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 6],
    v: &[S; 6],
) -> [S; 4] {
    let a_ = q[3];
    let b = q[4];
    let x_dot = v[0];
    let y_dot = v[1];
    let z_dot = v[2];
    let a_dot = v[3];
    let b_dot = v[4];
    let c_dot = v[5];
    let (sin_a_, cos_a_) = a_.sin_cos();
    let (sin_b, cos_b) = b.sin_cos();
    let t0 = c_dot * p.r;
    let rate2 = cos_b * (t0 * sin_a_) + (x_dot - cos_a_ * (p.r * b_dot));
    let rate4 = t0 * sin_b + (p.r * a_dot + y_dot);
    [z_dot, rate2, z_dot, rate4]
}

/// Derivatives of the rates of unilateral contacts by the rates of the coordinates.
///
/// ```text
/// [cloth.gap, z] = 1
/// [cloth.slip, x] = 1
/// [cloth.slip, b] = -r*cos(a)
/// [cloth.slip, c] = r*sin(a)*cos(b)
/// [cloth.across.gap, z] = 1
/// [cloth.across.slip, y] = 1
/// [cloth.across.slip, a] = r
/// [cloth.across.slip, c] = r*sin(b)
/// ```
pub fn contact_matrix<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 6]) -> [S; 24] {
    let a_ = q[3];
    let b = q[4];
    let (sin_a_, cos_a_) = a_.sin_cos();
    let (sin_b, cos_b) = b.sin_cos();
    let zero = S::ZERO;
    let one = S::ONE;
    let w2_5 = p.minus_r * cos_a_;
    let w2_6 = cos_b * (sin_a_ * p.r);
    let w4_6 = p.r * sin_b;
    [
        zero, zero, one, zero, zero, zero, one, zero, zero, zero, w2_5, w2_6, zero, zero, one,
        zero, zero, zero, zero, one, zero, p.r, zero, w4_6,
    ]
}

/// Rates `dgamma/dt` of unilateral contacts where all accelerations are 0.
///
/// ```text
/// [cloth.slip] = r*sin(a)*der(a)*der(b) + r*cos(a)*cos(b)*der(a)*der(c)
///     - r*sin(a)*sin(b)*der(b)*der(c)
/// [cloth.across.slip] = r*cos(b)*der(b)*der(c)
/// ```
pub fn contact_bias<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 6],
    v: &[S; 6],
) -> [S; 4] {
    let a_ = q[3];
    let b = q[4];
    let a_dot = v[3];
    let b_dot = v[4];
    let c_dot = v[5];
    let (sin_a_, cos_a_) = a_.sin_cos();
    let (sin_b, cos_b) = b.sin_cos();
    let t0 = sin_a_ * b_dot;
    let zero = S::ZERO;
    let bias2 = p.r * (c_dot * (cos_b * (cos_a_ * a_dot) - t0 * sin_b) + t0 * a_dot);
    let bias4 = cos_b * (c_dot * (p.r * b_dot));
    [zero, bias2, zero, bias4]
}

/// Coefficients of unilateral contacts: restitution along the normal and along the tangent (for
/// compliant contacts the parameters of their force), friction, static friction.
///
/// ```text
/// [cloth.restitution] = e
/// [cloth.friction] = mu
/// [cloth.static_friction] = mu
/// [cloth.across.restitution] = e
/// [cloth.across.friction] = mu
/// [cloth.across.static_friction] = mu
/// ```
pub fn contact_coefficients<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>) -> [S; 8] {
    let zero = S::ZERO;
    [p.e, zero, p.mu, p.mu, p.e, zero, p.mu, p.mu]
}

/// Kinetic energy `T`, in J.
///
/// ```text
/// T = 1/2*m*der(x)^2 + 1/2*m*der(y)^2 + 1/2*m*der(z)^2 + 1/5*m*r^2*cos(b)^2*der(a)^2
///     + 1/5*m*r^2*der(b)^2 + 1/5*m*r^2*(sin(b)*der(a) + der(c))^2
/// ```
pub fn kinetic_energy<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 6],
    v: &[S; 6],
) -> S {
    let b = q[4];
    let x_dot = v[0];
    let y_dot = v[1];
    let z_dot = v[2];
    let a_dot = v[3];
    let b_dot = v[4];
    let c_dot = v[5];
    let (sin_b, cos_b) = b.sin_cos();
    let t0 = cos_b * a_dot;
    let t1 = sin_b * a_dot + c_dot;
    let t2 = cos_b * x_dot - sin_b * z_dot;
    let t3 = cos_b * z_dot + sin_b * x_dot;
    let t4 = (t1 * t1 + (b_dot * b_dot + t0 * t0)) * p.k0;
    S::from_f64(0.5) * ((t3 * t3 + (y_dot * y_dot + t2 * t2)) * p.m + t4)
}

/// Potential energy `V`, in J.
///
/// ```text
/// V = m*g*z
/// ```
pub fn potential_energy<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 6]) -> S {
    let z = q[2];
    p.m_g * z
}

::lagrangian::emitted::implement! {
    machine CueBall "CueBall" over S, R;
    parameters { m, r, vx, vy, wx, wy, wz, e, mu, g } [
        m: "m" "kg" = 0.21;
        r: "r" "m" = 0.03075;
        vx: "vx" "m/s" = 2.0;
        vy: "vy" "m/s" = 0.0;
        wx: "wx" "rad/s" = 40.0;
        wy: "wy" "rad/s" = -30.0;
        wz: "wz" "rad/s" = 60.0;
        e: "e" "1" = 0.5;
        mu: "mu" "1" = 0.2;
        g: "g" "m/s^2" = 9.81;
    ]
    coordinates 6 Coordinates { x, y, z, a, b, c } [
        x: "x" "m";
        y: "y" "m";
        z: "z" "m";
        a: "a" "rad";
        b: "b" "rad";
        c: "c" "rad";
    ]
    inputs Inputs {} [], defined here
    outputs Outputs {} [], defined here
    prepared Prepared { m, r, e, mu, k0, m_g, k1, minus_m_g, minus_r, minus_g, k2 }
    singular singular
    accelerations { (p, t, q, v, u) Accelerations { p, q, v } }
    system {
        matrix mass_matrix(p, t, q) = mass_matrix(p, q);
        vector bias(p, t, q, v) = bias(p, q, v);
        vector applied(p, t, q, v, u) = applied(p);
        vector forces(p, t, q, v, u) = forces(p, q, v);
        numbers gaps(p, t, q) = gaps(p, q);
        numbers contact_rates(p, t, q, v) = contact_rates(p, q, v);
        numbers contact_matrix(p, t, q) = contact_matrix(p, q);
        numbers contact_bias(p, t, q, v) = contact_bias(p, q, v);
        numbers contact_coefficients(p, t, q, v) = contact_coefficients(p);
        number kinetic_energy(p, t, q, v) = kinetic_energy(p, q, v);
        number potential_energy(p, t, q, u) = potential_energy(p, q);
        number dissipation(p, t, q, v, u);
        number work_rate(p, t, q, v, a, u);
        number dissipation_rate(p, t, q, v, u);
        outputs outputs(p, t, q, v, a, u) = Outputs {};
        contacts unilateral_contacts(p) = [
            ::lagrangian::emitted::UnilateralContact {
                name: "cloth",
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
                name: "cloth.across",
                law: ::lagrangian::emitted::ImpactLaw::Newton,
                order: ::lagrangian::emitted::ImpactOrder::AtOnce,
                painleve: ::lagrangian::emitted::Painleve::Error,
                compliance: Option::None,
                has_friction: true,
                is_rolling_resistance: false,
                is_second_tangent: true,
                has_face: false,
            },
        ];
    }
    absent [MAY_BE_CONSTRAINED MAY_SLIDE]
    intervals []
    lanes [N]
    numbers []
}
