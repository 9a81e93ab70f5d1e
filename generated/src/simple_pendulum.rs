// @generated from machines/simple_pendulum.machine by `cargo xtask generate`; edits are lost.

//! A point mass on a massless rod that turns on a fixed pivot, in a vertical plane.
//!
//! Energy is conserved. With w = sqrt(g/l) a swing of amplitude A has the period 4 K(k)/w,
//! where K is the complete elliptic integral of modulus k = sin(A/2), and from rest it moves as
//! sin(theta/2) = k cd(w t). Small swings take 2 pi/w, all of one length (C. Huygens, 1673); a
//! swing of 90 degrees takes 18 % longer, and at 180 degrees the period is infinite: the
//! pendulum that comes to rest upside down moves as theta = 4 atan(exp(w t)) - pi. Faster ones
//! turn over and over. E. T. Whittaker, Analytical Dynamics, 4th ed. 1937, section 44.
//!
//! 1 coordinate, 3 parameters, 1 output. Arithmetic of one call:
//!
//! | function | mul | add | div | sin cos | other | temporaries |
//! | --- | --: | --: | --: | --: | --: | --: |
//! | `prepare` | 4 | 2 | 1 | 0 | 0 | 7 |
//! | `start` | 1 | 0 | 0 | 0 | 0 | 1 |
//! | `applied` | 1 | 0 | 0 | 1 | 0 | 2 |
//! | `forces` | 1 | 0 | 0 | 1 | 0 | 2 |
//! | `accelerations` | 1 | 0 | 0 | 1 | 0 | 2 |
//! | `kinetic_energy` | 2 | 0 | 0 | 0 | 0 | 2 |
//! | `potential_energy` | 1 | 0 | 0 | 1 | 0 | 2 |
//! | `output_tension` | 4 | 1 | 0 | 1 | 0 | 6 |
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

/// A point mass on a massless rod that turns on a fixed pivot, in a vertical plane.
///
/// Energy is conserved. With w = sqrt(g/l) a swing of amplitude A has the period 4 K(k)/w,
/// where K is the complete elliptic integral of modulus k = sin(A/2), and from rest it moves as
/// sin(theta/2) = k cd(w t). Small swings take 2 pi/w, all of one length (C. Huygens, 1673); a
/// swing of 90 degrees takes 18 % longer, and at 180 degrees the period is infinite: the
/// pendulum that comes to rest upside down moves as theta = 4 atan(exp(w t)) - pi. Faster ones
/// turn over and over. E. T. Whittaker, Analytical Dynamics, 4th ed. 1937, section 44.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SimplePendulum<S = f64> {
    /// Mass of the bob. It cancels: light and heavy bobs swing alike. Unit: `kg`. Default: 1.
    pub m: S,
    /// Length of the rod. Unit: `m`. Default: 1.
    pub l: S,
    /// Acceleration of gravity. Unit: `m/s^2`. Default: 9.81.
    pub g: S,
}

impl<S: ::lagrangian::emitted::Scalar> SimplePendulum<S> {
    /// Computes what depends on the parameters alone, once.
    pub fn prepare(&self) -> Prepared<S> {
        let t0 = self.m * self.l;
        let m_l_squared = self.l * t0;
        let half_m_l_squared = m_l_squared * S::from_f64(0.5);
        let minus_m_l_g = -(self.g * t0);
        let minus_g_over_l = -(self.g / self.l);
        let pivots = [(0, m_l_squared, m_l_squared)];
        Prepared {
            m: self.m,
            l: self.l,
            g: self.g,
            m_l_squared,
            half_m_l_squared,
            minus_m_l_g,
            minus_g_over_l,
            singular: PIVOTS.vanished(pivots),
        }
    }

    /// The start values of the description, at rest and `t = 0`.
    pub fn start(&self) -> ::lagrangian::emitted::State<Coordinates<S>> {
        let theta = S::pi() * S::from_f64(0.5);
        let q = [theta];
        let v = [S::ZERO; 1];
        ::lagrangian::emitted::State {
            t: 0.0,
            q: Coordinates::from_array(q),
            v: Coordinates::from_array(v),
        }
    }
}

/// The coordinates of [`SimplePendulum`], or their rates, by name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coordinates<S = f64> {
    /// Angle of the rod from the downward vertical. Unit: `rad`.
    pub theta: S,
}

/// What can be observed of a [`SimplePendulum`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outputs<S = f64> {
    /// Tension of the rod; negative where the bob presses on it. It is 3 m g at the bottom
    /// of a swing from 90 degrees. Unit: `N`.
    pub tension: S,
}

/// The parameters of a [`SimplePendulum`], with the work done that depends on them alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prepared<S = f64> {
    /// `m`
    m: S,
    /// `l`
    l: S,
    /// `g`
    g: S,
    /// `m*l^2`
    m_l_squared: S,
    /// `0.5*m*l^2`
    half_m_l_squared: S,
    /// `-m*l*g`
    minus_m_l_g: S,
    /// `-g/l`
    minus_g_over_l: S,
    /// Why these parameters leave the machine without accelerations, if they do.
    singular: Option<::lagrangian::emitted::Singular>,
}

/// A pivot of an elimination that is not above this share of its diagonal element may be rounding
/// errors alone.
const PIVOTS: ::lagrangian::emitted::Pivots = ::lagrangian::emitted::Pivots::new(1, 1);

/// Mass matrix `M`.
///
/// ```text
/// M[theta, theta] = m*l^2
/// ```
pub fn mass_matrix<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>) -> [[S; 1]; 1] {
    [[p.m_l_squared]]
}

/// Applied generalized forces `Q`.
///
/// ```text
/// Q[theta] = -m*l*g*sin(theta)
/// ```
pub fn applied<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 1]) -> [S; 1] {
    let theta = q[0];
    let sin_theta = theta.sin();
    let q_theta = p.minus_m_l_g * sin_theta;
    [q_theta]
}

/// Right-hand side `f = Q - h` of `M a = f`.
pub fn forces<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 1]) -> [S; 1] {
    let theta = q[0];
    let sin_theta = theta.sin();
    let f_theta = p.minus_m_l_g * sin_theta;
    [f_theta]
}

::lagrangian::emitted::fast_function! {
    /// Accelerations `a`, the solution of `M a = f` eliminated along the machine.
    ///
    /// A pivot that vanishes is an error.
    pub fn accelerations<'a, S>(Accelerations { p: &'a Prepared<S>, q: &'a [S; 1] })
        -> Result<[S; 1], ::lagrangian::emitted::Singular> = accelerations_in;
}

#[inline(always)]
fn accelerations_in<S: Copy, N: ::lagrangian::emitted::Scalar<Stored = S>>(
    call: Accelerations<'_, S>,
) -> Result<[S; 1], ::lagrangian::emitted::Singular> {
    let Accelerations { p, q } = call;
    let n = N::load;
    if let Some(singular) = p.singular {
        return Err(singular);
    }
    let theta = n(q[0]);
    let sin_theta = theta.sin();
    let theta_ddot = n(p.minus_g_over_l) * sin_theta;
    let accelerations = [theta_ddot.store()];
    Ok(accelerations)
}

/// Kinetic energy `T`, in J.
///
/// ```text
/// T = 1/2*m*l^2*der(theta)^2
/// ```
pub fn kinetic_energy<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, v: &[S; 1]) -> S {
    let theta_dot = v[0];
    theta_dot * (theta_dot * p.half_m_l_squared)
}

/// Potential energy `V`, in J.
///
/// ```text
/// V = -m*l*g*cos(theta)
/// ```
pub fn potential_energy<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 1]) -> S {
    let theta = q[0];
    let cos_theta = theta.cos();
    p.minus_m_l_g * cos_theta
}

/// Tension of the rod; negative where the bob presses on it. It is 3 m g at the bottom
/// of a swing from 90 degrees. Unit: `N`.
///
/// ```text
/// tension = m*l*der(theta)^2 + m*g*cos(theta)
/// ```
pub fn output_tension<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 1],
    v: &[S; 1],
) -> S {
    let theta = q[0];
    let theta_dot = v[0];
    let cos_theta = theta.cos();
    (theta_dot * (theta_dot * p.l) + cos_theta * p.g) * p.m
}

/// Everything that the description asks to observe.
pub fn outputs<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 1],
    v: &[S; 1],
) -> Outputs<S> {
    Outputs {
        tension: output_tension(p, q, v),
    }
}

::lagrangian::emitted::implement! {
    machine SimplePendulum "SimplePendulum" over S, R;
    parameters { m, l, g } [
        m: "m" "kg" = 1.0;
        l: "l" "m" = 1.0;
        g: "g" "m/s^2" = 9.81;
    ]
    coordinates 1 Coordinates { theta } [
        theta: "theta" "rad";
    ]
    inputs Inputs {} [], defined here
    outputs Outputs { tension } [
        tension: "tension" "N";
    ]
    prepared Prepared { m, l, g, m_l_squared, half_m_l_squared, minus_m_l_g, minus_g_over_l }
    singular singular
    accelerations { (p, t, q, v, u) Accelerations { p, q } }
    system {
        matrix mass_matrix(p, t, q) = mass_matrix(p);
        vector bias(p, t, q, v);
        vector applied(p, t, q, v, u) = applied(p, q);
        vector forces(p, t, q, v, u) = forces(p, q);
        number kinetic_energy(p, t, q, v) = kinetic_energy(p, v);
        number potential_energy(p, t, q, u) = potential_energy(p, q);
        number dissipation(p, t, q, v, u);
        number work_rate(p, t, q, v, a, u);
        number dissipation_rate(p, t, q, v, u);
        outputs outputs(p, t, q, v, a, u) = outputs(p, q, v);
    }
    absent [MAY_BE_CONSTRAINED MAY_SLIDE MAY_COLLIDE]
    intervals []
    lanes [N]
    numbers [yes]
}
