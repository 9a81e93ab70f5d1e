// @generated from machines/bead_on_hoop.machine by `cargo xtask generate`; edits are lost.

//! A bead on a rough hoop that is turned about its vertical diameter. It sticks wherever friction
//! can hold it. The reaction of the
//! hoop lies in its plane, and while the bead slides it also has a component across this plane.
//!
//! 1 coordinate, 5 parameters. Arithmetic of one call:
//!
//! | function | mul | add | div | sin cos | other | temporaries |
//! | --- | --: | --: | --: | --: | --: | --: |
//! | `prepare` | 13 | 2 | 2 | 0 | 0 | 17 |
//! | `bias` | 2 | 0 | 0 | 1 | 0 | 4 |
//! | `applied` | 1 | 0 | 0 | 1 | 0 | 2 |
//! | `forces` | 3 | 1 | 0 | 1 | 0 | 6 |
//! | `slips` | 1 | 0 | 0 | 0 | 0 | 1 |
//! | `friction` | 30 | 12 | 0 | 2 | 0 | 46 |
//! | `kinetic_energy` | 5 | 1 | 0 | 1 | 0 | 7 |
//! | `potential_energy` | 1 | 0 | 0 | 1 | 0 | 2 |
//! | `work_rate` | 3 | 0 | 0 | 1 | 0 | 5 |
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

/// A bead on a rough hoop that is turned about its vertical diameter. It sticks wherever friction
/// can hold it. The reaction of the
/// hoop lies in its plane, and while the bead slides it also has a component across this plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BeadOnHoop<S = f64> {
    /// Mass of the bead. Unit: `kg`. Default: 0.01.
    pub m: S,
    /// Radius of the hoop. Unit: `m`. Default: 0.2.
    pub r: S,
    /// How fast the hoop is turned. Unit: `rad/s`. Default: 10.
    pub omega: S,
    /// Coefficient of friction. Unit: `1`. Default: 0.2.
    pub mu: S,
    /// Acceleration of gravity. Unit: `m/s^2`. Default: 9.81.
    pub g: S,
}

impl<S: ::lagrangian::emitted::Scalar> BeadOnHoop<S> {
    /// Computes what depends on the parameters alone, once.
    pub fn prepare(&self) -> Prepared<S> {
        let t0 = S::ONE / self.r;
        let inverse_m = S::ONE / self.m;
        let t1 = self.r * self.omega;
        let m_r = self.m * self.r;
        let r_squared_omega2 = t1 * t1;
        let m_r_squared = self.r * m_r;
        let m_r_squared_omega2 = self.m * r_squared_omega2;
        let k1 = t0 * inverse_m;
        let r_squared = self.r * self.r;
        let half_m = self.m * S::from_f64(0.5);
        let r_omega2 = self.omega * t1;
        let two_m_r_squared_omega2 = m_r_squared_omega2 * S::from_f64(2.0);
        let minus_m_r_squared_omega2 = -m_r_squared_omega2;
        let minus_m_r_g = -(self.g * m_r);
        let two_r_omega = t1 * S::from_f64(2.0);
        let k0 = t0 * k1;
        let pivots = [(0, m_r_squared, m_r_squared)];
        Prepared {
            m: self.m,
            r: self.r,
            omega: self.omega,
            g: self.g,
            m_r_squared,
            r_squared_omega2,
            r_squared,
            half_m,
            r_omega2,
            m_r,
            m_r_squared_omega2,
            two_m_r_squared_omega2,
            minus_m_r_squared_omega2,
            minus_m_r_g,
            mu: self.mu,
            two_r_omega,
            k0,
            k1,
            inverse_m,
            singular: PIVOTS.vanished(pivots),
        }
    }

    /// The start values of the description, at rest and `t = 0`.
    pub fn start(&self) -> ::lagrangian::emitted::State<Coordinates<S>> {
        let zero = S::ZERO;
        let q = [zero];
        let v = [S::ZERO; 1];
        ::lagrangian::emitted::State {
            t: 0.0,
            q: Coordinates::from_array(q),
            v: Coordinates::from_array(v),
        }
    }
}

/// The coordinates of [`BeadOnHoop`], or their rates, by name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coordinates<S = f64> {
    /// How far the bead is from the lowest point. Unit: `rad`.
    pub theta: S,
}

/// The parameters of a [`BeadOnHoop`], with the work done that depends on them alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prepared<S = f64> {
    /// `m`
    m: S,
    /// `r`
    r: S,
    /// `omega`
    omega: S,
    /// `g`
    g: S,
    /// `m*r^2`
    m_r_squared: S,
    /// `r^2*omega^2`
    r_squared_omega2: S,
    /// `r^2`
    r_squared: S,
    /// `0.5*m`
    half_m: S,
    /// `r*omega^2`
    r_omega2: S,
    /// `m*r`
    m_r: S,
    /// `m*r^2*omega^2`
    m_r_squared_omega2: S,
    /// `2*m*r^2*omega^2`
    two_m_r_squared_omega2: S,
    /// `-m*r^2*omega^2`
    minus_m_r_squared_omega2: S,
    /// `-m*r*g`
    minus_m_r_g: S,
    /// `mu`
    mu: S,
    /// `2*r*omega`
    two_r_omega: S,
    /// `1/m/r^2`
    k0: S,
    /// `1/m/r`
    k1: S,
    /// `1/m`
    inverse_m: S,
    /// Why these parameters leave the machine without accelerations, if they do.
    singular: Option<::lagrangian::emitted::Singular>,
}

/// A pivot of an elimination that is not above this share of its diagonal element may be rounding
/// errors alone.
const PIVOTS: ::lagrangian::emitted::Pivots = ::lagrangian::emitted::Pivots::new(1, 1);

/// Mass matrix `M`.
///
/// ```text
/// M[theta, theta] = m*r^2
/// ```
pub fn mass_matrix<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>) -> [[S; 1]; 1] {
    [[p.m_r_squared]]
}

/// Bias `h`: velocity products and explicit time in the inertia forces.
///
/// ```text
/// h[theta] = -m*r^2*omega^2*sin(theta)*cos(theta)
/// ```
pub fn bias<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 1]) -> [S; 1] {
    let theta = q[0];
    let (sin_theta, cos_theta) = theta.sin_cos();
    let h_theta = cos_theta * (p.minus_m_r_squared_omega2 * sin_theta);
    [h_theta]
}

/// Applied generalized forces `Q`.
///
/// ```text
/// Q[theta] = -m*r*g*sin(theta)
/// ```
pub fn applied<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 1]) -> [S; 1] {
    let theta = q[0];
    let sin_theta = theta.sin();
    let q_theta = p.minus_m_r_g * sin_theta;
    [q_theta]
}

/// Right-hand side `f = Q - h` of `M a = f`.
pub fn forces<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 1]) -> [S; 1] {
    let theta = q[0];
    let (sin_theta, cos_theta) = theta.sin_cos();
    let t0 = cos_theta * (sin_theta * p.m_r_squared_omega2);
    let f_theta = sin_theta * p.minus_m_r_g + t0;
    [f_theta]
}

/// Slips `w` of the guided contacts, in m/s.
///
/// ```text
/// w[wire] = r*der(theta)
/// ```
pub fn slips<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, v: &[S; 1]) -> [S; 1] {
    let theta_dot = v[0];
    let w1 = theta_dot * p.r;
    [w1]
}

/// Slip matrix `tau`, the derivatives of the slips by the rates.
///
/// ```text
/// tau[wire, theta] = r
/// ```
pub fn slip_matrix<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>) -> [S; 1] {
    [p.r]
}

::lagrangian::emitted::fast_function! {
    /// Accelerations, multipliers, `dw/dt` and the normal reaction of each contact without
    /// friction, and the change of each by a unit of each friction force; followed by the
    /// coefficients of friction. A machine with guided contacts has this in place of accelerations
    /// and multipliers.
    ///
    /// A pivot that vanishes is an error.
    pub fn friction<'a, S>(Friction { p: &'a Prepared<S>, t: S, q: &'a [S; 1], v: &'a [S; 1] })
        -> Result<[S; 15], ::lagrangian::emitted::Singular> = friction_in;
}

#[inline(always)]
fn friction_in<S: Copy, N: ::lagrangian::emitted::Scalar<Stored = S>>(
    call: Friction<'_, S>,
) -> Result<[S; 15], ::lagrangian::emitted::Singular> {
    let Friction { p, t, q, v } = call;
    let n = N::load;
    if let Some(singular) = p.singular {
        return Err(singular);
    }
    let theta = n(q[0]);
    let theta_dot = n(v[0]);
    let t0 = n(t) * n(p.omega);
    let angles = [theta, t0];
    let circular = N::sin_cos_all(angles);
    let (sin_theta, cos_theta) = circular[0];
    let (sin_t0, cos_t0) = circular[1];
    let t1 = n(t).product_error(n(p.omega));
    let t2 = theta_dot * n(p.two_r_omega);
    let t3 = theta_dot * (theta_dot * n(p.r));
    let t4 = t3 * sin_theta;
    let t5 = sin_theta * n(p.r_omega2);
    let t6 = t3.mul_add(cos_theta, n(p.g));
    let t7 = t1.neg_mul_add(sin_t0, cos_t0);
    let t8 = t1.mul_add(cos_t0, sin_t0);
    let r12 = cos_theta * t7;
    let r13 = cos_theta * t8;
    let t9 = n(p.m_r) * cos_theta.mul_sub(t4 + t5, sin_theta * t6);
    let r0 = n(p.k0) * t9;
    let t10 = n(p.m_r) * r0;
    let t11 = n(p.m) * t2.mul_add(r13, t4.mul_add(t7, t5 * t7));
    let t12 = n(p.m) * r12.neg_mul_add(t2, t4.mul_add(t8, t5 * t8));
    let r1 = n(p.r) * r0;
    let r2 = t10.mul_sub(r12, t11);
    let r3 = t10.mul_sub(r13, t12);
    let r4 = sin_theta.mul_add(t10, t6 * n(p.m));
    let zero = N::ZERO;
    let friction = [
        r0.store(),
        r1.store(),
        r2.store(),
        r3.store(),
        r4.store(),
        n(p.k1).store(),
        n(p.inverse_m).store(),
        zero.store(),
        zero.store(),
        zero.store(),
        n(p.mu).store(),
        n(p.mu).store(),
        r12.store(),
        r13.store(),
        sin_theta.store(),
    ];
    Ok(friction)
}

/// Kinetic energy `T`, in J.
///
/// ```text
/// T = 1/2*m*r^2*der(theta)^2 + 1/2*m*r^2*omega^2*sin(theta)^2
/// ```
pub fn kinetic_energy<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 1],
    v: &[S; 1],
) -> S {
    let theta = q[0];
    let theta_dot = v[0];
    let sin_theta = theta.sin();
    let t0 = sin_theta * (sin_theta * p.r_squared_omega2);
    p.half_m * (theta_dot * (theta_dot * p.r_squared) + t0)
}

/// Potential energy `V`, in J.
///
/// ```text
/// V = -m*r*g*cos(theta)
/// ```
pub fn potential_energy<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 1]) -> S {
    let theta = q[0];
    let cos_theta = theta.cos();
    p.minus_m_r_g * cos_theta
}

/// Power `P` supplied by drives, forces and inputs, in W.
///
/// ```text
/// P = 2*m*r^2*omega^2*sin(theta)*cos(theta)*der(theta)
/// ```
pub fn work_rate<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 1], v: &[S; 1]) -> S {
    let theta = q[0];
    let theta_dot = v[0];
    let (sin_theta, cos_theta) = theta.sin_cos();
    cos_theta * (sin_theta * (p.two_m_r_squared_omega2 * theta_dot))
}

::lagrangian::emitted::implement! {
    machine BeadOnHoop "BeadOnHoop" over S, R;
    parameters { m, r, omega, mu, g } [
        m: "m" "kg" = 0.01;
        r: "r" "m" = 0.2;
        omega: "omega" "rad/s" = 10.0;
        mu: "mu" "1" = 0.2;
        g: "g" "m/s^2" = 9.81;
    ]
    coordinates 1 Coordinates { theta } [
        theta: "theta" "rad";
    ]
    inputs Inputs {} [], defined here
    outputs Outputs {} [], defined here
    prepared Prepared {
        m, r, omega, g, m_r_squared, r_squared_omega2, r_squared, half_m, r_omega2, m_r,
        m_r_squared_omega2, two_m_r_squared_omega2, minus_m_r_squared_omega2, minus_m_r_g, mu,
        two_r_omega, k0, k1, inverse_m,
    }
    singular singular
    accelerations friction
    system {
        matrix mass_matrix(p, t, q) = mass_matrix(p);
        vector bias(p, t, q, v) = bias(p, q);
        vector applied(p, t, q, v, u) = applied(p, q);
        vector forces(p, t, q, v, u) = forces(p, q);
        numbers slips(p, t, q, v) = slips(p, v);
        numbers slip_matrix(p, t, q) = slip_matrix(p);
        numbers slip_bias(p, t, q, v);
        number kinetic_energy(p, t, q, v) = kinetic_energy(p, q, v);
        number potential_energy(p, t, q, u) = potential_energy(p, q);
        number dissipation(p, t, q, v, u);
        number work_rate(p, t, q, v, a, u) = work_rate(p, q, v);
        number dissipation_rate(p, t, q, v, u);
        outputs outputs(p, t, q, v, a, u) = Outputs {};
        names contacts(p) = ["wire"];
        count reaction_axes(p) = 3;
        ranges slip_ranges(p, v) = slips(p, v);
        solved friction(p, t, q, v, u) = friction(p, t, q, v);
        workspace with_workspace(p) = ::lagrangian::emitted::contact_workspace_in_space(1, 0, 1);
    }
    absent [MAY_BE_CONSTRAINED MAY_COLLIDE]
    intervals [yes]
    lanes []
    numbers []
}
