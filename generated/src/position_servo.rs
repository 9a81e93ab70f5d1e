// @generated from machines/position_servo.machine by `cargo xtask generate`; edits are lost.

//! An arm that a motor holds level against its weight: a controller with an integrator measures the
//! angle through a filter,
//! and sets the voltage.
//!
//! 4 coordinates, 13 parameters, 1 input, 1 output. Arithmetic of one call:
//!
//! | function | mul | add | div | sin cos | other | temporaries |
//! | --- | --: | --: | --: | --: | --: | --: |
//! | `prepare` | 8 | 2 | 3 | 0 | 0 | 13 |
//! | `applied` | 10 | 9 | 0 | 1 | 0 | 20 |
//! | `forces` | 10 | 9 | 0 | 1 | 0 | 20 |
//! | `accelerations` | 11 | 9 | 0 | 1 | 0 | 21 |
//! | `kinetic_energy` | 2 | 0 | 0 | 0 | 0 | 2 |
//! | `potential_energy` | 1 | 0 | 0 | 1 | 0 | 2 |
//! | `state_energy` | 2 | 0 | 0 | 0 | 0 | 2 |
//! | `dissipation` | 2 | 0 | 0 | 0 | 0 | 2 |
//! | `work_rate` | 8 | 8 | 0 | 0 | 0 | 16 |
//! | `dissipation_rate` | 4 | 1 | 0 | 0 | 0 | 5 |
//! | `output_voltage` | 3 | 4 | 0 | 0 | 0 | 7 |
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

/// An arm that a motor holds level against its weight: a controller with an integrator measures the
/// angle through a filter,
/// and sets the voltage.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PositionServo<S = f64> {
    /// Mass of the arm, and the distance of its mass centre from the axis. Unit: `kg`.
    /// Default: 1.2.
    pub m: S,
    /// `a`. Unit: `m`. Default: 0.25.
    pub a: S,
    /// Its moment of inertia about the mass centre, with that of the rotor seen through the gear.
    /// Unit: `kg*m^2`. Default: 0.04.
    pub J: S,
    /// Gear ratio. Unit: `1`. Default: 40.
    pub n: S,
    /// The motor: inductance, resistance, torque by current. Unit: `H`. Default: 0.002.
    pub L: S,
    /// `R`. Unit: `ohm`. Default: 0.5.
    pub R: S,
    /// `k`. Unit: `N*m/A`. Default: 0.05.
    pub k: S,
    /// Friction of the gear. Unit: `N*m*s`. Default: 0.3.
    pub b: S,
    /// Gains of the controller. Unit: `V`. Default: 30.
    pub kp: S,
    /// `ki`. Unit: `V/s`. Default: 40.
    pub ki: S,
    /// `kd`. Unit: `V*s`. Default: 4.
    pub kd: S,
    /// Time constant of the filter. Unit: `s`. Default: 0.01.
    pub tau: S,
    /// `g`. Unit: `m/s^2`. Default: 9.81.
    pub g: S,
}

impl<S: ::lagrangian::emitted::Scalar> PositionServo<S> {
    /// Computes what depends on the parameters alone, once.
    pub fn prepare(&self) -> Prepared<S> {
        let t0 = self.a * self.m;
        let inverse_tau = S::ONE / self.tau;
        let J_plus_m_a_squared = self.a * t0 + self.J;
        let n_k = self.k * self.n;
        let kd_over_tau = inverse_tau * self.kd;
        let inverse_L = S::ONE / self.L;
        let half_b = self.b * S::from_f64(0.5);
        let half_L = self.L * S::from_f64(0.5);
        let k0 = S::from_f64(0.5) * J_plus_m_a_squared;
        let m_a_g = t0 * self.g;
        let k1 = -(S::ONE / J_plus_m_a_squared);
        let one = S::ONE;
        let pivots = [
            (1, one, one),
            (2, one, one),
            (3, one, one),
            (0, J_plus_m_a_squared, J_plus_m_a_squared),
        ];
        Prepared {
            R: self.R,
            b: self.b,
            kp: self.kp,
            ki: self.ki,
            n_k,
            kd_over_tau,
            inverse_L,
            inverse_tau,
            half_b,
            half_L,
            J_plus_m_a_squared,
            k0,
            m_a_g,
            k1,
            singular: PIVOTS.vanished(pivots),
        }
    }

    /// The start values of the description, at `t = 0`.
    pub fn start(&self) -> ::lagrangian::emitted::State<Coordinates<S>> {
        let zero = S::ZERO;
        let q = [S::from_f64(-0.5), zero, zero, zero];
        let v = [zero, zero, S::from_f64(-0.5), zero];
        ::lagrangian::emitted::State {
            t: 0.0,
            q: Coordinates::from_array(q),
            v: Coordinates::from_array(v),
        }
    }
}

/// The coordinates of [`PositionServo`], or their rates, by name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coordinates<S = f64> {
    /// Angle of the arm above the horizontal. Unit: `rad`.
    pub theta: S,
    /// Current in the winding. Among rates the state `i`, in `A`; among coordinates its integral
    /// over time, on which nothing depends.
    pub i: S,
    /// The angle as the controller sees it. Among rates the state `seen`, in `rad`; among
    /// coordinates its integral over time, on which nothing depends.
    pub seen: S,
    /// The error that was, summed up. Among rates the state `error`, in `rad*s`; among coordinates
    /// its integral over time, on which nothing depends.
    pub error: S,
}

/// What can be set while a [`PositionServo`] runs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Inputs<S = f64> {
    /// Where the arm is wanted. Unit: `rad`. Default: 0.
    pub wanted: S,
}

/// What can be observed of a [`PositionServo`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outputs<S = f64> {
    /// Voltage that the controller sets. Unit: `V`.
    pub voltage: S,
}

/// The parameters of a [`PositionServo`], with the work done that depends on them alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prepared<S = f64> {
    /// `R`
    R: S,
    /// `b`
    b: S,
    /// `kp`
    kp: S,
    /// `ki`
    ki: S,
    /// `n*k`
    n_k: S,
    /// `kd/tau`
    kd_over_tau: S,
    /// `1/L`
    inverse_L: S,
    /// `1/tau`
    inverse_tau: S,
    /// `0.5*b`
    half_b: S,
    /// `0.5*L`
    half_L: S,
    /// `J + m*a^2`
    J_plus_m_a_squared: S,
    /// `0.5*(J + m*a^2)`
    k0: S,
    /// `m*a*g`
    m_a_g: S,
    /// `-1/(J + m*a^2)`
    k1: S,
    /// Why these parameters leave the machine without accelerations, if they do.
    singular: Option<::lagrangian::emitted::Singular>,
}

/// A pivot of an elimination that is not above this share of its diagonal element may be rounding
/// errors alone.
const PIVOTS: ::lagrangian::emitted::Pivots = ::lagrangian::emitted::Pivots::new(4, 4);

/// Mass matrix `M`.
///
/// ```text
/// M[theta, theta] = m*a^2 + J
/// M[integral(i), integral(i)] = 1
/// M[integral(seen), integral(seen)] = 1
/// M[integral(error), integral(error)] = 1
/// ```
pub fn mass_matrix<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>) -> [[S; 4]; 4] {
    let zero = S::ZERO;
    let one = S::ONE;
    [
        [p.J_plus_m_a_squared, zero, zero, zero],
        [zero, one, zero, zero],
        [zero, zero, one, zero],
        [zero, zero, zero, one],
    ]
}

/// Applied generalized forces `Q`.
///
/// ```text
/// Q[theta] = n*k*i - b*der(theta) - m*a*g*cos(theta)
/// Q[integral(i)] = ((kp*(wanted - seen) + ki*error - kd*(theta - seen)/tau) - n*k*der(theta) -
///     R*i)/L
/// Q[integral(seen)] = (theta - seen)/tau
/// Q[integral(error)] = wanted - seen
/// ```
pub fn applied<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 4],
    v: &[S; 4],
    u: &Inputs<S>,
) -> [S; 4] {
    let theta = q[0];
    let theta_dot = v[0];
    let i_dot = v[1];
    let seen_dot = v[2];
    let error_dot = v[3];
    let cos_theta = theta.cos();
    let t0 = theta - seen_dot;
    let t1 = error_dot * p.ki - t0 * p.kd_over_tau - (seen_dot - u.wanted) * p.kp;
    let q_theta = p.n_k * i_dot - p.m_a_g * cos_theta - theta_dot * p.b;
    let q_i = p.inverse_L * (t1 - (i_dot * p.R + theta_dot * p.n_k));
    let q_seen = t0 * p.inverse_tau;
    let q_error = u.wanted - seen_dot;
    [q_theta, q_i, q_seen, q_error]
}

/// Right-hand side `f = Q - h` of `M a = f`.
pub fn forces<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 4],
    v: &[S; 4],
    u: &Inputs<S>,
) -> [S; 4] {
    let theta = q[0];
    let theta_dot = v[0];
    let i_dot = v[1];
    let seen_dot = v[2];
    let error_dot = v[3];
    let cos_theta = theta.cos();
    let t0 = theta - seen_dot;
    let t1 = error_dot * p.ki - t0 * p.kd_over_tau - (seen_dot - u.wanted) * p.kp;
    let f_theta = p.n_k * i_dot - p.m_a_g * cos_theta - theta_dot * p.b;
    let f_i = p.inverse_L * (t1 - (i_dot * p.R + theta_dot * p.n_k));
    let f_seen = t0 * p.inverse_tau;
    let f_error = u.wanted - seen_dot;
    [f_theta, f_i, f_seen, f_error]
}

::lagrangian::emitted::fast_function! {
    /// Accelerations `a`, the solution of `M a = f` eliminated along the machine.
    ///
    /// A pivot that vanishes is an error.
    pub fn accelerations<'a, S>(Accelerations {
        p: &'a Prepared<S>,
        q: &'a [S; 4],
        v: &'a [S; 4],
        u: &'a Inputs<S>,
    }) -> Result<[S; 4], ::lagrangian::emitted::Singular> = accelerations_in;
}

#[inline(always)]
fn accelerations_in<S: Copy, N: ::lagrangian::emitted::Scalar<Stored = S>>(
    call: Accelerations<'_, S>,
) -> Result<[S; 4], ::lagrangian::emitted::Singular> {
    let Accelerations { p, q, v, u } = call;
    let n = N::load;
    if let Some(singular) = p.singular {
        return Err(singular);
    }
    let theta = n(q[0]);
    let theta_dot = n(v[0]);
    let i_dot = n(v[1]);
    let seen_dot = n(v[2]);
    let error_dot = n(v[3]);
    let cos_theta = theta.cos();
    let t0 = theta - seen_dot;
    let t1 = t0.neg_mul_add(n(p.kd_over_tau), error_dot * n(p.ki));
    let t2 = (seen_dot - n(u.wanted)).neg_mul_add(n(p.kp), t1);
    let t3 = t2 - i_dot.mul_add(n(p.R), theta_dot * n(p.n_k));
    let t4 = n(p.n_k).mul_sub(i_dot, theta_dot * n(p.b));
    let theta_ddot = n(p.k1) * n(p.m_a_g).mul_sub(cos_theta, t4);
    let i_ddot = n(p.inverse_L) * t3;
    let seen_ddot = t0 * n(p.inverse_tau);
    let error_ddot = n(u.wanted) - seen_dot;
    let accelerations = [
        theta_ddot.store(),
        i_ddot.store(),
        seen_ddot.store(),
        error_ddot.store(),
    ];
    Ok(accelerations)
}

/// Kinetic energy `T`, in J.
///
/// ```text
/// T = 1/2*(m*a^2 + J)*der(theta)^2
/// ```
pub fn kinetic_energy<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, v: &[S; 4]) -> S {
    let theta_dot = v[0];
    theta_dot * (theta_dot * p.k0)
}

/// Potential energy `V`, in J.
///
/// ```text
/// V = m*a*g*sin(theta)
/// ```
pub fn potential_energy<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 4]) -> S {
    let theta = q[0];
    let sin_theta = theta.sin();
    p.m_a_g * sin_theta
}

/// Energy `E` that states of first order store, in J.
///
/// ```text
/// E = 1/2*L*i^2
/// ```
pub fn state_energy<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, v: &[S; 4]) -> S {
    let i_dot = v[1];
    i_dot * (i_dot * p.half_L)
}

/// Dissipation function `D`, in W.
///
/// ```text
/// D = 1/2*b*der(theta)^2
/// ```
pub fn dissipation<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, v: &[S; 4]) -> S {
    let theta_dot = v[0];
    theta_dot * (theta_dot * p.half_b)
}

/// Power `P` supplied by drives, forces and inputs, in W.
///
/// ```text
/// P = kp*i*wanted - (kp - kd/tau)*i*seen + ki*i*error - kd*theta*i/tau
/// ```
pub fn work_rate<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 4],
    v: &[S; 4],
    u: &Inputs<S>,
) -> S {
    let theta = q[0];
    let theta_dot = v[0];
    let i_dot = v[1];
    let seen_dot = v[2];
    let error_dot = v[3];
    let t0 = p.n_k * theta_dot;
    let t1 = i_dot * p.R;
    let t2 = error_dot * p.ki - p.kd_over_tau * (theta - seen_dot);
    let t3 = i_dot * t1 + i_dot * (t2 - (seen_dot - u.wanted) * p.kp - (t0 + t1));
    t0 * i_dot + t3
}

/// Power `R` dissipated by dampers, in W.
///
/// ```text
/// R = b*der(theta)^2 + R*i^2
/// ```
pub fn dissipation_rate<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, v: &[S; 4]) -> S {
    let theta_dot = v[0];
    let i_dot = v[1];
    theta_dot * (theta_dot * p.b) + i_dot * (i_dot * p.R)
}

/// Voltage that the controller sets. Unit: `V`.
///
/// ```text
/// voltage = kp*(wanted - seen) + ki*error - kd*(theta - seen)/tau
/// ```
pub fn output_voltage<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 4],
    v: &[S; 4],
    u: &Inputs<S>,
) -> S {
    let theta = q[0];
    let seen_dot = v[2];
    let error_dot = v[3];
    let t0 = error_dot * p.ki - p.kd_over_tau * (theta - seen_dot);
    t0 - (seen_dot - u.wanted) * p.kp
}

/// Everything that the description asks to observe.
pub fn outputs<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 4],
    v: &[S; 4],
    u: &Inputs<S>,
) -> Outputs<S> {
    Outputs {
        voltage: output_voltage(p, q, v, u),
    }
}

::lagrangian::emitted::implement! {
    machine PositionServo "PositionServo" over S, R;
    parameters { m, a, J, n, L, R, k, b, kp, ki, kd, tau, g } [
        m: "m" "kg" = 1.2;
        a: "a" "m" = 0.25;
        J: "J" "kg*m^2" = 0.04;
        n: "n" "1" = 40.0;
        L: "L" "H" = 0.002;
        R: "R" "ohm" = 0.5;
        k: "k" "N*m/A" = 0.05;
        b: "b" "N*m*s" = 0.3;
        kp: "kp" "V" = 30.0;
        ki: "ki" "V/s" = 40.0;
        kd: "kd" "V*s" = 4.0;
        tau: "tau" "s" = 0.01;
        g: "g" "m/s^2" = 9.81;
    ]
    coordinates 4 Coordinates { theta, i, seen, error } [
        theta: "theta" "rad";
        i: "integral(i)" "A*s";
        seen: "integral(seen)" "rad*s";
        error: "integral(error)" "rad*s*s";
    ]
    inputs Inputs { wanted } [
        wanted: "wanted" "rad" = 0.0;
    ] over S
    outputs Outputs { voltage } [
        voltage: "voltage" "V";
    ]
    prepared Prepared {
        R, b, kp, ki, n_k, kd_over_tau, inverse_L, inverse_tau, half_b, half_L, J_plus_m_a_squared,
        k0, m_a_g, k1,
    }
    singular singular
    accelerations { (p, t, q, v, u) Accelerations { p, q, v, u } }
    system {
        matrix mass_matrix(p, t, q) = mass_matrix(p);
        vector bias(p, t, q, v);
        vector applied(p, t, q, v, u) = applied(p, q, v, u);
        vector forces(p, t, q, v, u) = forces(p, q, v, u);
        number kinetic_energy(p, t, q, v) = kinetic_energy(p, v);
        number potential_energy(p, t, q, u) = potential_energy(p, q);
        number state_energy(p, t, q, v) = state_energy(p, v);
        number dissipation(p, t, q, v, u) = dissipation(p, v);
        number work_rate(p, t, q, v, a, u) = work_rate(p, q, v, u);
        number dissipation_rate(p, t, q, v, u) = dissipation_rate(p, v);
        outputs outputs(p, t, q, v, a, u) = outputs(p, q, v, u);
    }
    absent [MAY_BE_CONSTRAINED MAY_SLIDE MAY_COLLIDE]
    intervals []
    lanes [N]
    numbers [yes]
}
