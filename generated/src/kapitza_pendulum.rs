// @generated from machines/kapitza_pendulum.machine by `cargo xtask generate`; edits are lost.

//! A pendulum whose pivot is shaken up and down, and which therefore can stand upside down.
//!
//! The angle is measured from the upward vertical. Shaken fast by little (a much less than l,
//! omega much more than sqrt(g/l)), the pendulum stands upright where a^2 omega^2 > 2 g l, and
//! sways there slowly, with the frequency sqrt(a^2 omega^2/(2 l^2) - g/l) (P. L. Kapitza, Zh.
//! Eksp. Teor. Fiz. 21 (1951) 588; L. D. Landau, E. M. Lifshitz, Mechanics, section 30). Small
//! motion about the vertical obeys Mathieu's equation y'' + (A - 2 Q cos 2x) y = 0 with x =
//! omega t/2, A = -4 g/(l omega^2), Q = 2 a/l: upright is stable exactly where A lies between
//! the characteristic values a_0(Q) and b_1(Q). Beyond the second, shaken too hard, the
//! pendulum swings with half the frequency of its pivot.
//!
//! 1 coordinate, 5 parameters, 1 output. Arithmetic of one call:
//!
//! | function | mul | add | div | sin cos | other | temporaries |
//! | --- | --: | --: | --: | --: | --: | --: |
//! | `prepare` | 11 | 0 | 1 | 0 | 0 | 12 |
//! | `bias` | 5 | 1 | 0 | 2 | 0 | 9 |
//! | `applied` | 1 | 0 | 0 | 1 | 0 | 2 |
//! | `forces` | 6 | 2 | 0 | 2 | 0 | 11 |
//! | `accelerations` | 6 | 2 | 0 | 2 | 0 | 11 |
//! | `kinetic_energy` | 11 | 3 | 0 | 2 | 0 | 18 |
//! | `potential_energy` | 6 | 2 | 0 | 2 | 0 | 11 |
//! | `work_rate` | 12 | 5 | 0 | 2 | 0 | 21 |
//! | `output_force` | 9 | 4 | 0 | 2 | 0 | 17 |
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

/// A pendulum whose pivot is shaken up and down, and which therefore can stand upside down.
///
/// The angle is measured from the upward vertical. Shaken fast by little (a much less than l,
/// omega much more than sqrt(g/l)), the pendulum stands upright where a^2 omega^2 > 2 g l, and
/// sways there slowly, with the frequency sqrt(a^2 omega^2/(2 l^2) - g/l) (P. L. Kapitza, Zh.
/// Eksp. Teor. Fiz. 21 (1951) 588; L. D. Landau, E. M. Lifshitz, Mechanics, section 30). Small
/// motion about the vertical obeys Mathieu's equation y'' + (A - 2 Q cos 2x) y = 0 with x =
/// omega t/2, A = -4 g/(l omega^2), Q = 2 a/l: upright is stable exactly where A lies between
/// the characteristic values a_0(Q) and b_1(Q). Beyond the second, shaken too hard, the
/// pendulum swings with half the frequency of its pivot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct KapitzaPendulum<S = f64> {
    /// Mass of the bob. It cancels. Unit: `kg`. Default: 1.
    pub m: S,
    /// Length of the rod. Unit: `m`. Default: 1.
    pub l: S,
    /// Amplitude of the pivot. Unit: `m`. Default: 0.1.
    pub a: S,
    /// Frequency of the pivot: it shakes with twice the least that holds the pendulum up. Unit:
    /// `rad/s`. Default: 88.
    pub omega: S,
    /// Acceleration of gravity. Unit: `m/s^2`. Default: 9.81.
    pub g: S,
}

impl<S: ::lagrangian::emitted::Scalar> KapitzaPendulum<S> {
    /// Computes what depends on the parameters alone, once.
    pub fn prepare(&self) -> Prepared<S> {
        let t0 = self.m * self.l;
        let a_omega = self.a * self.omega;
        let m_g = self.m * self.g;
        let m_l_squared = self.l * t0;
        let a_omega2 = self.omega * a_omega;
        let l_squared = self.l * self.l;
        let half_m = self.m * S::from_f64(0.5);
        let m_l_g = self.g * t0;
        let m_a_omega_g = a_omega * m_g;
        let m_a_omega = self.m * a_omega;
        let m_l_a_omega2 = a_omega2 * t0;
        let k0 = S::ONE / m_l_squared;
        let pivots = [(0, m_l_squared, m_l_squared)];
        Prepared {
            m: self.m,
            l: self.l,
            a: self.a,
            omega: self.omega,
            g: self.g,
            a_omega,
            a_omega2,
            l_squared,
            half_m,
            m_g,
            m_l_squared,
            m_l_g,
            m_a_omega_g,
            m_a_omega,
            m_l_a_omega2,
            k0,
            singular: PIVOTS.vanished(pivots),
        }
    }

    /// The start values of the description, at rest and `t = 0`.
    pub fn start(&self) -> ::lagrangian::emitted::State<Coordinates<S>> {
        let theta = S::from_ratio(3, 10);
        let q = [theta];
        let v = [S::ZERO; 1];
        ::lagrangian::emitted::State {
            t: 0.0,
            q: Coordinates::from_array(q),
            v: Coordinates::from_array(v),
        }
    }
}

/// The coordinates of [`KapitzaPendulum`], or their rates, by name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coordinates<S = f64> {
    /// Angle of the rod from the upward vertical. Unit: `rad`.
    pub theta: S,
}

/// What can be observed of a [`KapitzaPendulum`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outputs<S = f64> {
    /// Force that shakes the pivot, upwards. Unit: `N`.
    pub force: S,
}

/// The parameters of a [`KapitzaPendulum`], with the work done that depends on them alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prepared<S = f64> {
    /// `m`
    m: S,
    /// `l`
    l: S,
    /// `a`
    a: S,
    /// `omega`
    omega: S,
    /// `g`
    g: S,
    /// `a*omega`
    a_omega: S,
    /// `a*omega^2`
    a_omega2: S,
    /// `l^2`
    l_squared: S,
    /// `0.5*m`
    half_m: S,
    /// `m*g`
    m_g: S,
    /// `m*l^2`
    m_l_squared: S,
    /// `m*l*g`
    m_l_g: S,
    /// `m*a*omega*g`
    m_a_omega_g: S,
    /// `m*a*omega`
    m_a_omega: S,
    /// `m*l*a*omega^2`
    m_l_a_omega2: S,
    /// `1/m/l^2`
    k0: S,
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

/// Bias `h`: velocity products and explicit time in the inertia forces.
///
/// ```text
/// h[theta] = m*l*a*omega^2*cos(omega*t)*sin(theta)
/// ```
pub fn bias<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, t: S, q: &[S; 1]) -> [S; 1] {
    let theta = q[0];
    let t0 = p.omega * t;
    let sin_theta = theta.sin();
    let (sin_t0, cos_t0) = t0.sin_cos();
    let t1 = cos_t0 - p.omega.product_error(t) * sin_t0;
    let h_theta = t1 * (p.m_l_a_omega2 * sin_theta);
    [h_theta]
}

/// Applied generalized forces `Q`.
///
/// ```text
/// Q[theta] = m*l*g*sin(theta)
/// ```
pub fn applied<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 1]) -> [S; 1] {
    let theta = q[0];
    let sin_theta = theta.sin();
    let q_theta = p.m_l_g * sin_theta;
    [q_theta]
}

/// Right-hand side `f = Q - h` of `M a = f`.
pub fn forces<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, t: S, q: &[S; 1]) -> [S; 1] {
    let theta = q[0];
    let t0 = p.omega * t;
    let sin_theta = theta.sin();
    let (sin_t0, cos_t0) = t0.sin_cos();
    let t1 = cos_t0 - p.omega.product_error(t) * sin_t0;
    let f_theta = sin_theta * p.m_l_g - t1 * (sin_theta * p.m_l_a_omega2);
    [f_theta]
}

::lagrangian::emitted::fast_function! {
    /// Accelerations `a`, the solution of `M a = f` from the mass matrix multiplied out, factored.
    ///
    /// A pivot that vanishes is an error.
    pub fn accelerations<'a, S>(Accelerations { p: &'a Prepared<S>, t: S, q: &'a [S; 1] })
        -> Result<[S; 1], ::lagrangian::emitted::Singular> = accelerations_in;
}

#[inline(always)]
fn accelerations_in<S: Copy, N: ::lagrangian::emitted::Scalar<Stored = S>>(
    call: Accelerations<'_, S>,
) -> Result<[S; 1], ::lagrangian::emitted::Singular> {
    let Accelerations { p, t, q } = call;
    let n = N::load;
    if let Some(singular) = p.singular {
        return Err(singular);
    }
    let theta = n(q[0]);
    let t0 = n(p.omega) * n(t);
    let angles = [theta, t0];
    let circular = N::sin_cos_all(angles);
    let (sin_theta, _) = circular[0];
    let (sin_t0, cos_t0) = circular[1];
    let t1 = n(p.omega).product_error(n(t)).neg_mul_add(sin_t0, cos_t0);
    let t2 = n(p.m_l_a_omega2).neg_mul_add(t1, n(p.m_l_g));
    let theta_ddot = t2 * (n(p.k0) * sin_theta);
    let accelerations = [theta_ddot.store()];
    Ok(accelerations)
}

/// Kinetic energy `T`, in J.
///
/// ```text
/// T = 1/2*m*(l^2*cos(theta)^2*der(theta)^2 + (-l*sin(theta)*der(theta) - a*omega*sin(omega*t))^2)
/// ```
pub fn kinetic_energy<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    t: S,
    q: &[S; 1],
    v: &[S; 1],
) -> S {
    let theta = q[0];
    let theta_dot = v[0];
    let t0 = p.omega * t;
    let (sin_theta, cos_theta) = theta.sin_cos();
    let (sin_t0, cos_t0) = t0.sin_cos();
    let t1 = cos_theta * theta_dot;
    let t2 = p.a_omega * (sin_t0 + p.omega.product_error(t) * cos_t0);
    let t3 = sin_theta * (theta_dot * p.l) + t2;
    p.half_m * (t1 * (t1 * p.l_squared) + t3 * t3)
}

/// Potential energy `V`, in J.
///
/// ```text
/// V = m*g*(l*cos(theta) + a*cos(omega*t))
/// ```
pub fn potential_energy<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, t: S, q: &[S; 1]) -> S {
    let theta = q[0];
    let t0 = p.omega * t;
    let cos_theta = theta.cos();
    let (sin_t0, cos_t0) = t0.sin_cos();
    let t1 = cos_theta * p.l + (cos_t0 - p.omega.product_error(t) * sin_t0) * p.a;
    p.m_g * t1
}

/// Power `P` supplied by drives, forces and inputs, in W.
///
/// ```text
/// P = -m*a*omega*sin(omega*t)*(l*(-sin(theta)*der(der(theta)) - cos(theta)*der(theta)^2) -
///     a*omega^2*cos(omega*t)) - m*a*omega*g*sin(omega*t)
/// ```
pub fn work_rate<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    t: S,
    q: &[S; 1],
    v: &[S; 1],
    a: &[S; 1],
) -> S {
    let theta = q[0];
    let theta_dot = v[0];
    let theta_ddot = a[0];
    let t0 = p.omega * t;
    let (sin_theta, cos_theta) = theta.sin_cos();
    let t1 = p.omega.product_error(t);
    let (sin_t0, cos_t0) = t0.sin_cos();
    let t2 = sin_t0 + t1 * cos_t0;
    let t3 = (cos_theta * (theta_dot * theta_dot) + sin_theta * theta_ddot) * p.l;
    let t4 = (t3 + (cos_t0 - t1 * sin_t0) * p.a_omega2) * (t2 * p.m_a_omega);
    t4 - t2 * p.m_a_omega_g
}

/// Force that shakes the pivot, upwards. Unit: `N`.
///
/// ```text
/// force = m*((-(l*sin(theta)*der(der(theta)) + l*cos(theta)*der(theta)^2) -
///     a*omega^2*cos(omega*t)) + g)
/// ```
pub fn output_force<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    t: S,
    q: &[S; 1],
    v: &[S; 1],
    a: &[S; 1],
) -> S {
    let theta = q[0];
    let theta_dot = v[0];
    let theta_ddot = a[0];
    let t0 = p.omega * t;
    let (sin_theta, cos_theta) = theta.sin_cos();
    let (sin_t0, cos_t0) = t0.sin_cos();
    let t1 = (cos_theta * (theta_dot * theta_dot) + sin_theta * theta_ddot) * p.l;
    let t2 = p.g - (t1 + p.a_omega2 * (cos_t0 - p.omega.product_error(t) * sin_t0));
    t2 * p.m
}

/// Everything that the description asks to observe.
pub fn outputs<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    t: S,
    q: &[S; 1],
    v: &[S; 1],
    a: &[S; 1],
) -> Outputs<S> {
    Outputs {
        force: output_force(p, t, q, v, a),
    }
}

::lagrangian::emitted::implement! {
    machine KapitzaPendulum "KapitzaPendulum" over S, R;
    parameters { m, l, a, omega, g } [
        m: "m" "kg" = 1.0;
        l: "l" "m" = 1.0;
        a: "a" "m" = 0.1;
        omega: "omega" "rad/s" = 88.0;
        g: "g" "m/s^2" = 9.81;
    ]
    coordinates 1 Coordinates { theta } [
        theta: "theta" "rad";
    ]
    inputs Inputs {} [], defined here
    outputs Outputs { force } [
        force: "force" "N";
    ]
    prepared Prepared {
        m, l, a, omega, g, a_omega, a_omega2, l_squared, half_m, m_g, m_l_squared, m_l_g,
        m_a_omega_g, m_a_omega, m_l_a_omega2, k0,
    }
    singular singular
    accelerations { (p, t, q, v, u) Accelerations { p, t, q } }
    system {
        matrix mass_matrix(p, t, q) = mass_matrix(p);
        vector bias(p, t, q, v) = bias(p, t, q);
        vector applied(p, t, q, v, u) = applied(p, q);
        vector forces(p, t, q, v, u) = forces(p, t, q);
        number kinetic_energy(p, t, q, v) = kinetic_energy(p, t, q, v);
        number potential_energy(p, t, q, u) = potential_energy(p, t, q);
        number dissipation(p, t, q, v, u);
        number work_rate(p, t, q, v, a, u) = work_rate(p, t, q, v, a);
        number dissipation_rate(p, t, q, v, u);
        outputs outputs(p, t, q, v, a, u) = outputs(p, t, q, v, a);
    }
    absent [MAY_BE_CONSTRAINED MAY_SLIDE MAY_COLLIDE]
    intervals []
    lanes [N]
    numbers [yes]
}
