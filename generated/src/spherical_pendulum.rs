// @generated from machines/spherical_pendulum.machine by `cargo xtask generate`; edits are lost.

//! A point mass on a massless rod that swings from a fixed point in every direction.
//!
//! Conserved: energy, and the angular momentum about the vertical, since phi is cyclic. At the
//! angle theta the pendulum runs in a circle if der(phi)^2 = g/(l cos(theta)), the conical
//! pendulum (C. Huygens, 1673); beside that it nods with the frequency
//! sqrt(g (1 + 3 cos(theta)^2)/(l cos(theta))). In general the height is an elliptic function
//! of time, z = z1 + (z2 - z1) sn^2, between two levels (E. T. Whittaker, Analytical Dynamics,
//! 4th ed. 1937, section 55). From one lowest point to the next, the plane of the swing turns
//! by more than pi and less than 2 pi.
//!
//! The angles fail where the rod is vertical: der(phi) has no meaning there. A pendulum with
//! angular momentum never gets there; one without it is the simple pendulum.
//!
//! 2 coordinates, 3 parameters, 3 outputs. Arithmetic of one call:
//!
//! | function | mul | add | div | sin cos | other | temporaries |
//! | --- | --: | --: | --: | --: | --: | --: |
//! | `prepare` | 5 | 5 | 1 | 0 | 0 | 11 |
//! | `start` | 1 | 0 | 0 | 0 | 0 | 1 |
//! | `mass_matrix` | 2 | 0 | 0 | 1 | 0 | 3 |
//! | `bias` | 6 | 0 | 0 | 1 | 0 | 8 |
//! | `applied` | 1 | 0 | 0 | 1 | 0 | 2 |
//! | `forces` | 7 | 1 | 0 | 1 | 0 | 10 |
//! | `accelerations` | 9 | 1 | 1 | 1 | 0 | 13 |
//! | `kinetic_energy` | 4 | 1 | 0 | 1 | 0 | 6 |
//! | `potential_energy` | 1 | 0 | 0 | 1 | 0 | 2 |
//! | `output_vertical_momentum` | 3 | 0 | 0 | 1 | 0 | 4 |
//! | `output_height` | 1 | 0 | 0 | 1 | 0 | 2 |
//! | `output_tension` | 6 | 2 | 0 | 1 | 0 | 10 |
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

/// A point mass on a massless rod that swings from a fixed point in every direction.
///
/// Conserved: energy, and the angular momentum about the vertical, since phi is cyclic. At the
/// angle theta the pendulum runs in a circle if der(phi)^2 = g/(l cos(theta)), the conical
/// pendulum (C. Huygens, 1673); beside that it nods with the frequency
/// sqrt(g (1 + 3 cos(theta)^2)/(l cos(theta))). In general the height is an elliptic function
/// of time, z = z1 + (z2 - z1) sn^2, between two levels (E. T. Whittaker, Analytical Dynamics,
/// 4th ed. 1937, section 55). From one lowest point to the next, the plane of the swing turns
/// by more than pi and less than 2 pi.
///
/// The angles fail where the rod is vertical: der(phi) has no meaning there. A pendulum with
/// angular momentum never gets there; one without it is the simple pendulum.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SphericalPendulum<S = f64> {
    /// Mass of the bob. Unit: `kg`. Default: 1.
    pub m: S,
    /// Length of the rod. Unit: `m`. Default: 1.
    pub l: S,
    /// Acceleration of gravity. Unit: `m/s^2`. Default: 9.81.
    pub g: S,
}

impl<S: ::lagrangian::emitted::Scalar> SphericalPendulum<S> {
    /// Computes what depends on the parameters alone, once.
    pub fn prepare(&self) -> Prepared<S> {
        let t0 = self.m * self.l;
        let m_l_squared = self.l * t0;
        let two_m_l_squared = m_l_squared * S::from_f64(2.0);
        let half_m_l_squared = m_l_squared * S::from_f64(0.5);
        let minus_m_l_squared = -m_l_squared;
        let minus_m_l_g = -(self.g * t0);
        let minus_two_m_l_squared = -two_m_l_squared;
        let minus_l = -self.l;
        let minus_inverse_l = -(S::ONE / self.l);
        let pivots = [(1, m_l_squared, m_l_squared)];
        Prepared {
            m: self.m,
            g: self.g,
            m_l_squared,
            half_m_l_squared,
            two_m_l_squared,
            minus_m_l_squared,
            minus_m_l_g,
            minus_two_m_l_squared,
            minus_l,
            minus_inverse_l,
            singular: PIVOTS.vanished(pivots),
        }
    }

    /// The start values of the description, at `t = 0`.
    pub fn start(&self) -> ::lagrangian::emitted::State<Coordinates<S>> {
        let zero = S::ZERO;
        let theta = S::from_ratio(1, 3) * S::pi();
        let q = [zero, theta];
        let v = [S::from_f64(3.0), zero];
        ::lagrangian::emitted::State {
            t: 0.0,
            q: Coordinates::from_array(q),
            v: Coordinates::from_array(v),
        }
    }
}

/// The coordinates of [`SphericalPendulum`], or their rates, by name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coordinates<S = f64> {
    /// Direction in which the pendulum hangs, about the upward vertical.
    /// A little less than what makes it a conical pendulum, sqrt(g/(l cos(theta))) = 4.4.
    /// Unit: `rad`.
    pub phi: S,
    /// Angle of the rod from the downward vertical. Unit: `rad`.
    pub theta: S,
}

/// What can be observed of a [`SphericalPendulum`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outputs<S = f64> {
    /// Angular momentum about the vertical: conserved. Unit: `J*s`.
    pub vertical_momentum: S,
    /// Height of the bob above the fixed point. Unit: `m`.
    pub height: S,
    /// Tension of the rod. Unit: `N`.
    pub tension: S,
}

/// The parameters of a [`SphericalPendulum`], with the work done that depends on them alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prepared<S = f64> {
    /// `m`
    m: S,
    /// `g`
    g: S,
    /// `m*l^2`
    m_l_squared: S,
    /// `0.5*m*l^2`
    half_m_l_squared: S,
    /// `2*m*l^2`
    two_m_l_squared: S,
    /// `-m*l^2`
    minus_m_l_squared: S,
    /// `-m*l*g`
    minus_m_l_g: S,
    /// `-2*m*l^2`
    minus_two_m_l_squared: S,
    /// `-l`
    minus_l: S,
    /// `-1/l`
    minus_inverse_l: S,
    /// Why these parameters leave the machine without accelerations, if they do.
    singular: Option<::lagrangian::emitted::Singular>,
}

/// A pivot of an elimination that is not above this share of its diagonal element may be rounding
/// errors alone.
const PIVOTS: ::lagrangian::emitted::Pivots = ::lagrangian::emitted::Pivots::new(2, 2);

/// Mass matrix `M`.
///
/// ```text
/// M[phi, phi] = m*l^2*sin(theta)^2
/// M[theta, theta] = m*l^2
/// ```
pub fn mass_matrix<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 2]) -> [[S; 2]; 2] {
    let theta = q[1];
    let sin_theta = theta.sin();
    let m11 = sin_theta * (sin_theta * p.m_l_squared);
    let zero = S::ZERO;
    [[m11, zero], [zero, p.m_l_squared]]
}

/// Bias `h`: velocity products and explicit time in the inertia forces.
///
/// ```text
/// h[phi] = 2*m*l^2*cos(theta)*sin(theta)*der(phi)*der(theta)
/// h[theta] = -m*l^2*cos(theta)*sin(theta)*der(phi)^2
/// ```
pub fn bias<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 2], v: &[S; 2]) -> [S; 2] {
    let theta = q[1];
    let phi_dot = v[0];
    let theta_dot = v[1];
    let (sin_theta, cos_theta) = theta.sin_cos();
    let t0 = sin_theta * (cos_theta * phi_dot);
    let h_phi = t0 * (p.two_m_l_squared * theta_dot);
    let h_theta = t0 * (phi_dot * p.minus_m_l_squared);
    [h_phi, h_theta]
}

/// Applied generalized forces `Q`.
///
/// ```text
/// Q[theta] = -m*l*g*sin(theta)
/// ```
pub fn applied<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 2]) -> [S; 2] {
    let theta = q[1];
    let sin_theta = theta.sin();
    let zero = S::ZERO;
    let q_theta = p.minus_m_l_g * sin_theta;
    [zero, q_theta]
}

/// Right-hand side `f = Q - h` of `M a = f`.
pub fn forces<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 2], v: &[S; 2]) -> [S; 2] {
    let theta = q[1];
    let phi_dot = v[0];
    let theta_dot = v[1];
    let (sin_theta, cos_theta) = theta.sin_cos();
    let t0 = sin_theta * (cos_theta * phi_dot);
    let f_phi = p.minus_two_m_l_squared * theta_dot * t0;
    let f_theta = sin_theta * p.minus_m_l_g + phi_dot * p.m_l_squared * t0;
    [f_phi, f_theta]
}

::lagrangian::emitted::fast_function! {
    /// Accelerations `a`, the solution of `M a = f` eliminated along the machine.
    ///
    /// A pivot that vanishes is an error.
    pub fn accelerations<'a, S>(Accelerations { p: &'a Prepared<S>, q: &'a [S; 2], v: &'a [S; 2] })
        -> Result<[S; 2], ::lagrangian::emitted::Singular> = accelerations_in;
}

#[inline(always)]
fn accelerations_in<S: Copy, N: ::lagrangian::emitted::Scalar<Stored = S>>(
    call: Accelerations<'_, S>,
) -> Result<[S; 2], ::lagrangian::emitted::Singular> {
    let Accelerations { p, q, v } = call;
    let n = N::load;
    if let Some(singular) = p.singular {
        return Err(singular);
    }
    let theta = n(q[1]);
    let phi_dot = n(v[0]);
    let theta_dot = n(v[1]);
    let (sin_theta, cos_theta) = theta.sin_cos();
    let t0 = cos_theta * phi_dot;
    let t1 = sin_theta * (sin_theta * n(p.m_l_squared));
    let t2 = (phi_dot * n(p.minus_l)).mul_add(t0, n(p.g));
    let phi_ddot = N::from_f64(-2.0) * theta_dot * t0 / sin_theta;
    let theta_ddot = sin_theta * n(p.minus_inverse_l) * t2;
    let sound = PIVOTS.hold(t1, t1) & phi_ddot.is_finite();
    if !sound {
        let pivots = [(0, t1, t1)];
        PIVOTS.check(pivots)?;
    }
    let accelerations = [phi_ddot.store(), theta_ddot.store()];
    Ok(accelerations)
}

/// Kinetic energy `T`, in J.
///
/// ```text
/// T = 1/2*m*l^2*sin(theta)^2*der(phi)^2 + 1/2*m*l^2*der(theta)^2
/// ```
pub fn kinetic_energy<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 2],
    v: &[S; 2],
) -> S {
    let theta = q[1];
    let phi_dot = v[0];
    let theta_dot = v[1];
    let sin_theta = theta.sin();
    let t0 = sin_theta * phi_dot;
    p.half_m_l_squared * (t0 * t0 + theta_dot * theta_dot)
}

/// Potential energy `V`, in J.
///
/// ```text
/// V = -m*l*g*cos(theta)
/// ```
pub fn potential_energy<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 2]) -> S {
    let theta = q[1];
    let cos_theta = theta.cos();
    p.minus_m_l_g * cos_theta
}

/// Angular momentum about the vertical: conserved. Unit: `J*s`.
///
/// ```text
/// vertical_momentum = m*l^2*sin(theta)^2*der(phi)
/// ```
pub fn output_vertical_momentum<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 2],
    v: &[S; 2],
) -> S {
    let theta = q[1];
    let phi_dot = v[0];
    let sin_theta = theta.sin();
    sin_theta * (sin_theta * (p.m_l_squared * phi_dot))
}

/// Height of the bob above the fixed point. Unit: `m`.
///
/// ```text
/// height = -l*cos(theta)
/// ```
pub fn output_height<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 2]) -> S {
    let theta = q[1];
    let cos_theta = theta.cos();
    p.minus_l * cos_theta
}

/// Tension of the rod. Unit: `N`.
///
/// ```text
/// tension = m*(l*(sin(theta)^2*der(phi)^2 + der(theta)^2) + g*cos(theta))
/// ```
pub fn output_tension<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 2],
    v: &[S; 2],
) -> S {
    let theta = q[1];
    let phi_dot = v[0];
    let theta_dot = v[1];
    let (sin_theta, cos_theta) = theta.sin_cos();
    let t0 = sin_theta * phi_dot;
    (cos_theta * p.g - (theta_dot * theta_dot + t0 * t0) * p.minus_l) * p.m
}

/// By how much `sin(theta) > 0` holds.
pub fn assumption_0<S: ::lagrangian::emitted::Scalar>(q: &[S; 2]) -> S {
    let theta = q[1];
    let sin_theta = theta.sin();
    sin_theta
}

/// Everything that the description asks to observe.
pub fn outputs<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 2],
    v: &[S; 2],
) -> Outputs<S> {
    Outputs {
        vertical_momentum: output_vertical_momentum(p, q, v),
        height: output_height(p, q),
        tension: output_tension(p, q, v),
    }
}

::lagrangian::emitted::implement! {
    machine SphericalPendulum "SphericalPendulum" over S, R;
    parameters { m, l, g } [
        m: "m" "kg" = 1.0;
        l: "l" "m" = 1.0;
        g: "g" "m/s^2" = 9.81;
    ]
    coordinates 2 Coordinates { phi, theta } [
        phi: "phi" "rad";
        theta: "theta" "rad";
    ]
    inputs Inputs {} [], defined here
    outputs Outputs { vertical_momentum, height, tension } [
        vertical_momentum: "vertical_momentum" "J*s";
        height: "height" "m";
        tension: "tension" "N";
    ]
    prepared Prepared {
        m, g, m_l_squared, half_m_l_squared, two_m_l_squared, minus_m_l_squared, minus_m_l_g,
        minus_two_m_l_squared, minus_l, minus_inverse_l,
    }
    singular singular
    accelerations { (p, t, q, v, u) Accelerations { p, q, v } }
    system {
        matrix mass_matrix(p, t, q) = mass_matrix(p, q);
        vector bias(p, t, q, v) = bias(p, q, v);
        vector applied(p, t, q, v, u) = applied(p, q);
        vector forces(p, t, q, v, u) = forces(p, q, v);
        number kinetic_energy(p, t, q, v) = kinetic_energy(p, q, v);
        number potential_energy(p, t, q, u) = potential_energy(p, q);
        number dissipation(p, t, q, v, u);
        number work_rate(p, t, q, v, a, u);
        number dissipation_rate(p, t, q, v, u);
        outputs outputs(p, t, q, v, a, u) = outputs(p, q, v);
        facts assumptions(p, t, q, v, u) = [("sin(theta) > 0", true, assumption_0(q))];
    }
    absent [MAY_BE_CONSTRAINED MAY_SLIDE MAY_COLLIDE]
    intervals []
    lanes [N]
    numbers [yes]
}
