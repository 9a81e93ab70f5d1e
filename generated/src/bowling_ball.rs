// @generated from machines/contacts/bowling_ball.machine by `cargo xtask generate`; edits are lost.

//! A ball that is thrown along a lane without spin: it slips until friction has given it the spin
//! of rolling.
//!
//! 3 coordinates, 6 parameters. Arithmetic of one call:
//!
//! | function | mul | add | div | sin cos | other | temporaries |
//! | --- | --: | --: | --: | --: | --: | --: |
//! | `prepare` | 4 | 2 | 0 | 0 | 0 | 6 |
//! | `gaps` | 0 | 1 | 0 | 0 | 0 | 1 |
//! | `contact_rates` | 1 | 1 | 0 | 0 | 0 | 2 |
//! | `kinetic_energy` | 6 | 2 | 0 | 0 | 0 | 8 |
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

/// A ball that is thrown along a lane without spin: it slips until friction has given it the spin
/// of rolling.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BowlingBall<S = f64> {
    /// `m`. Unit: `kg`. Default: 7.
    pub m: S,
    /// `r`. Unit: `m`. Default: 0.108.
    pub r: S,
    /// `speed`. Unit: `m/s`. Default: 8.
    pub speed: S,
    /// Its spin at the start, positive against the sense in which it will roll. Unit: `rad/s`.
    /// Default: 0.
    pub spin: S,
    /// `mu`. Unit: `1`. Default: 0.1.
    pub mu: S,
    /// `g`. Unit: `m/s^2`. Default: 9.81.
    pub g: S,
}

impl<S: ::lagrangian::emitted::Scalar> BowlingBall<S> {
    /// Computes what depends on the parameters alone, once.
    pub fn prepare(&self) -> Prepared<S> {
        let m_g = self.m * self.g;
        let k0 = self.m * self.r * (self.r * S::from_ratio(2, 5));
        let minus_m_g = -m_g;
        let minus_g = -self.g;
        let pivots = [(0, self.m, self.m), (1, self.m, self.m), (2, k0, k0)];
        Prepared {
            m: self.m,
            r: self.r,
            mu: self.mu,
            k0,
            m_g,
            minus_m_g,
            minus_g,
            singular: PIVOTS.vanished(pivots),
        }
    }

    /// The start values of the description, at `t = 0`.
    pub fn start(&self) -> ::lagrangian::emitted::State<Coordinates<S>> {
        let zero = S::ZERO;
        let q = [zero, self.r, zero];
        let v = [self.speed, zero, self.spin];
        ::lagrangian::emitted::State {
            t: 0.0,
            q: Coordinates::from_array(q),
            v: Coordinates::from_array(v),
        }
    }
}

/// The coordinates of [`BowlingBall`], or their rates, by name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coordinates<S = f64> {
    /// `x`. Unit: `m`.
    pub x: S,
    /// `y`. Unit: `m`.
    pub y: S,
    /// `theta`. Unit: `rad`.
    pub theta: S,
}

/// The parameters of a [`BowlingBall`], with the work done that depends on them alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prepared<S = f64> {
    /// `m`
    m: S,
    /// `r`
    r: S,
    /// `mu`
    mu: S,
    /// `0.4*m*r^2`
    k0: S,
    /// `m*g`
    m_g: S,
    /// `-m*g`
    minus_m_g: S,
    /// `-g`
    minus_g: S,
    /// Why these parameters leave the machine without accelerations, if they do.
    singular: Option<::lagrangian::emitted::Singular>,
}

/// A pivot of an elimination that is not above this share of its diagonal element may be rounding
/// errors alone.
const PIVOTS: ::lagrangian::emitted::Pivots = ::lagrangian::emitted::Pivots::new(3, 3);

/// Mass matrix `M`.
///
/// ```text
/// M[x, x] = m
/// M[y, y] = m
/// M[theta, theta] = 2/5*m*r^2
/// ```
pub fn mass_matrix<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>) -> [[S; 3]; 3] {
    let zero = S::ZERO;
    [[p.m, zero, zero], [zero, p.m, zero], [zero, zero, p.k0]]
}

/// Applied generalized forces `Q`.
///
/// ```text
/// Q[y] = -m*g
/// ```
pub fn applied<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>) -> [S; 3] {
    let zero = S::ZERO;
    [zero, p.minus_m_g, zero]
}

/// Right-hand side `f = Q - h` of `M a = f`.
pub fn forces<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>) -> [S; 3] {
    let zero = S::ZERO;
    [zero, p.minus_m_g, zero]
}

::lagrangian::emitted::fast_function! {
    /// Accelerations `a`, the solution of `M a = f`.
    ///
    /// A pivot that vanishes is an error.
    pub fn accelerations<'a, S>(Accelerations { p: &'a Prepared<S> })
        -> Result<[S; 3], ::lagrangian::emitted::Singular> = accelerations_in;
}

#[inline(always)]
fn accelerations_in<S: Copy, N: ::lagrangian::emitted::Scalar<Stored = S>>(
    call: Accelerations<'_, S>,
) -> Result<[S; 3], ::lagrangian::emitted::Singular> {
    let Accelerations { p } = call;
    let n = N::load;
    if let Some(singular) = p.singular {
        return Err(singular);
    }
    let zero = N::ZERO;
    let accelerations = [zero.store(), n(p.minus_g).store(), zero.store()];
    Ok(accelerations)
}

/// Gaps `g` of the unilateral contacts, in m: positive where they are open.
///
/// ```text
/// [lane] = y - r
/// ```
pub fn gaps<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 3]) -> [S; 1] {
    let y = q[1];
    let gap1 = y - p.r;
    [gap1]
}

/// Rates `gamma` at which the gaps of unilateral contacts open and at which these slip, in m/s.
///
/// ```text
/// [lane.gap] = der(y)
/// [lane.slip] = der(x) + r*der(theta)
/// ```
pub fn contact_rates<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, v: &[S; 3]) -> [S; 2] {
    let x_dot = v[0];
    let y_dot = v[1];
    let theta_dot = v[2];
    let rate2 = theta_dot * p.r + x_dot;
    [y_dot, rate2]
}

/// Derivatives of the rates of unilateral contacts by the rates of the coordinates.
///
/// ```text
/// [lane.gap, y] = 1
/// [lane.slip, x] = 1
/// [lane.slip, theta] = r
/// ```
pub fn contact_matrix<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>) -> [S; 6] {
    let zero = S::ZERO;
    let one = S::ONE;
    [zero, one, zero, one, zero, p.r]
}

/// Coefficients of unilateral contacts: restitution along the normal and along the tangent (for
/// compliant contacts the parameters of their force), friction, static friction.
///
/// ```text
/// [lane.friction] = mu
/// [lane.static_friction] = mu
/// ```
pub fn contact_coefficients<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>) -> [S; 4] {
    let zero = S::ZERO;
    [zero, zero, p.mu, p.mu]
}

/// Kinetic energy `T`, in J.
///
/// ```text
/// T = 1/2*m*der(x)^2 + 1/2*m*der(y)^2 + 1/5*m*r^2*der(theta)^2
/// ```
pub fn kinetic_energy<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, v: &[S; 3]) -> S {
    let x_dot = v[0];
    let y_dot = v[1];
    let theta_dot = v[2];
    let t0 = (y_dot * y_dot + x_dot * x_dot) * p.m + theta_dot * (theta_dot * p.k0);
    S::from_f64(0.5) * t0
}

/// Potential energy `V`, in J.
///
/// ```text
/// V = m*g*y
/// ```
pub fn potential_energy<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 3]) -> S {
    let y = q[1];
    p.m_g * y
}

::lagrangian::emitted::implement! {
    machine BowlingBall "BowlingBall" over S, R;
    parameters { m, r, speed, spin, mu, g } [
        m: "m" "kg" = 7.0;
        r: "r" "m" = 0.108;
        speed: "speed" "m/s" = 8.0;
        spin: "spin" "rad/s" = 0.0;
        mu: "mu" "1" = 0.1;
        g: "g" "m/s^2" = 9.81;
    ]
    coordinates 3 Coordinates { x, y, theta } [
        x: "x" "m";
        y: "y" "m";
        theta: "theta" "rad";
    ]
    inputs Inputs {} [], defined here
    outputs Outputs {} [], defined here
    prepared Prepared { m, r, mu, k0, m_g, minus_m_g, minus_g }
    singular singular
    accelerations { (p, t, q, v, u) Accelerations { p } }
    system {
        matrix mass_matrix(p, t, q) = mass_matrix(p);
        vector bias(p, t, q, v);
        vector applied(p, t, q, v, u) = applied(p);
        vector forces(p, t, q, v, u) = forces(p);
        numbers gaps(p, t, q) = gaps(p, q);
        numbers contact_rates(p, t, q, v) = contact_rates(p, v);
        numbers contact_matrix(p, t, q) = contact_matrix(p);
        numbers contact_bias(p, t, q, v);
        numbers contact_coefficients(p, t, q, v) = contact_coefficients(p);
        number kinetic_energy(p, t, q, v) = kinetic_energy(p, v);
        number potential_energy(p, t, q, u) = potential_energy(p, q);
        number dissipation(p, t, q, v, u);
        number work_rate(p, t, q, v, a, u);
        number dissipation_rate(p, t, q, v, u);
        outputs outputs(p, t, q, v, a, u) = Outputs {};
        contacts unilateral_contacts(p) = [
            ::lagrangian::emitted::UnilateralContact {
                name: "lane",
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
