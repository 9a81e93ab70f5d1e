// @generated from machines/heavy_top.machine by `cargo xtask generate`; edits are lost.

//! A symmetrical top on a fixed point, heavy: precession psi about the vertical, nutation
//! theta from
//! it, and spin phi about the top's own axis. Energy and two angular momenta are conserved:
//! about the
//! vertical and about the top's axis, since psi and phi are cyclic.
//!
//! 3 coordinates, 5 parameters, 2 outputs. Arithmetic of one call:
//!
//! | function | mul | add | div | sin cos | other | temporaries |
//! | --- | --: | --: | --: | --: | --: | --: |
//! | `prepare` | 4 | 5 | 1 | 0 | 0 | 10 |
//! | `start` | 1 | 0 | 0 | 0 | 0 | 1 |
//! | `mass_matrix` | 3 | 1 | 0 | 1 | 0 | 5 |
//! | `bias` | 10 | 2 | 0 | 1 | 0 | 14 |
//! | `applied` | 1 | 0 | 0 | 1 | 0 | 2 |
//! | `forces` | 13 | 3 | 0 | 1 | 0 | 18 |
//! | `accelerations` | 34 | 13 | 1 | 2 | 0 | 52 |
//! | `kinetic_energy` | 9 | 4 | 0 | 1 | 0 | 15 |
//! | `potential_energy` | 1 | 0 | 0 | 1 | 0 | 2 |
//! | `output_vertical_momentum` | 6 | 2 | 0 | 1 | 0 | 10 |
//! | `output_axial_momentum` | 2 | 1 | 0 | 1 | 0 | 4 |
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

/// A symmetrical top on a fixed point, heavy: precession psi about the vertical, nutation
/// theta from
/// it, and spin phi about the top's own axis. Energy and two angular momenta are conserved:
/// about the
/// vertical and about the top's axis, since psi and phi are cyclic.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HeavyTop<S = f64> {
    /// `m`. Unit: `kg`. Default: 15.
    pub m: S,
    /// Distance of the mass centre from the fixed point. Unit: `m`. Default: 1.
    pub l: S,
    /// Inertia about the mass centre: across the axis of the top, and about it. Unit: `kg*m^2`.
    /// Default: 0.234375.
    pub A: S,
    /// `C`. Unit: `kg*m^2`. Default: 0.46875.
    pub C: S,
    /// `g`. Unit: `m/s^2`. Default: 9.81.
    pub g: S,
}

impl<S: ::lagrangian::emitted::Scalar> HeavyTop<S> {
    /// Computes what depends on the parameters alone, once.
    pub fn prepare(&self) -> Prepared<S> {
        let t0 = self.l * self.m;
        let m_l_squared = self.l * t0;
        let A_plus_m_l_squared = self.A + m_l_squared;
        let k3 = S::ONE / A_plus_m_l_squared;
        let k1 = A_plus_m_l_squared - self.C;
        let m_l_g = t0 * self.g;
        let k0 = self.C - A_plus_m_l_squared;
        let k2 = k1 * S::from_f64(2.0);
        let minus_C = -self.C;
        let k4 = -k3;
        let pivots = [
            (2, self.C, self.C),
            (1, A_plus_m_l_squared, A_plus_m_l_squared),
        ];
        Prepared {
            A: self.A,
            C: self.C,
            m_l_squared,
            A_plus_m_l_squared,
            m_l_g,
            k0,
            k1,
            k2,
            minus_C,
            k3,
            k4,
            singular: PIVOTS.vanished(pivots),
        }
    }

    /// The start values of the description, at `t = 0`.
    pub fn start(&self) -> ::lagrangian::emitted::State<Coordinates<S>> {
        let psi = S::pi();
        let theta = S::pi() * S::from_f64(0.5);
        let zero = S::ZERO;
        let q = [psi, theta, zero];
        let v = [zero, zero, S::from_f64(150.0)];
        ::lagrangian::emitted::State {
            t: 0.0,
            q: Coordinates::from_array(q),
            v: Coordinates::from_array(v),
        }
    }
}

/// The coordinates of [`HeavyTop`], or their rates, by name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coordinates<S = f64> {
    /// `psi`. Unit: `rad`.
    pub psi: S,
    /// `theta`. Unit: `rad`.
    pub theta: S,
    /// The spin with which it is let go: fast enough to carry it, at m g l/(C spin) = 2 rad/s.
    /// Unit: `rad`.
    pub phi: S,
}

/// What can be observed of a [`HeavyTop`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outputs<S = f64> {
    /// Angular momentum about the vertical: conserved. Unit: `J*s`.
    pub vertical_momentum: S,
    /// Angular momentum about the top's axis: conserved. Unit: `J*s`.
    pub axial_momentum: S,
}

/// The parameters of a [`HeavyTop`], with the work done that depends on them alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prepared<S = f64> {
    /// `A`
    A: S,
    /// `C`
    C: S,
    /// `m*l^2`
    m_l_squared: S,
    /// `A + m*l^2`
    A_plus_m_l_squared: S,
    /// `m*l*g`
    m_l_g: S,
    /// `C - (A + m*l^2)`
    k0: S,
    /// `A - C + m*l^2`
    k1: S,
    /// `2*(A - C + m*l^2)`
    k2: S,
    /// `-C`
    minus_C: S,
    /// `1/(A + m*l^2)`
    k3: S,
    /// `-1/(A + m*l^2)`
    k4: S,
    /// Why these parameters leave the machine without accelerations, if they do.
    singular: Option<::lagrangian::emitted::Singular>,
}

/// A pivot of an elimination that is not above this share of its diagonal element may be rounding
/// errors alone.
const PIVOTS: ::lagrangian::emitted::Pivots = ::lagrangian::emitted::Pivots::new(3, 3);

/// Mass matrix `M`.
///
/// ```text
/// M[psi, psi] = C*cos(theta)^2 + (m*l^2 + A)*sin(theta)^2
/// M[theta, theta] = m*l^2 + A
/// M[phi, psi] = C*cos(theta)
/// M[phi, phi] = C
/// ```
pub fn mass_matrix<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 3]) -> [[S; 3]; 3] {
    let theta = q[1];
    let cos_theta = theta.cos();
    let m11 = p.A_plus_m_l_squared - cos_theta * (cos_theta * p.k1);
    let zero = S::ZERO;
    let m31 = cos_theta * p.C;
    [
        [m11, zero, m31],
        [zero, p.A_plus_m_l_squared, zero],
        [m31, zero, p.C],
    ]
}

/// Bias `h`: velocity products and explicit time in the inertia forces.
///
/// ```text
/// h[psi] = -2*(C - m*l^2 - A)*cos(theta)*sin(theta)*der(psi)*der(theta)
///     - C*sin(theta)*der(theta)*der(phi)
/// h[theta] = C*sin(theta)*der(psi)*der(phi) - (m*l^2 + A - C)*cos(theta)*sin(theta)*der(psi)^2
/// h[phi] = -C*sin(theta)*der(psi)*der(theta)
/// ```
pub fn bias<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 3], v: &[S; 3]) -> [S; 3] {
    let theta = q[1];
    let psi_dot = v[0];
    let theta_dot = v[1];
    let phi_dot = v[2];
    let (sin_theta, cos_theta) = theta.sin_cos();
    let t0 = phi_dot * p.C;
    let t1 = cos_theta * psi_dot;
    let t2 = sin_theta * psi_dot;
    let h_psi = (t1 * p.k2 - t0) * (sin_theta * theta_dot);
    let h_theta = t2 * (t0 - t1 * p.k1);
    let h_phi = t2 * (theta_dot * p.minus_C);
    [h_psi, h_theta, h_phi]
}

/// Applied generalized forces `Q`.
///
/// ```text
/// Q[theta] = m*l*g*sin(theta)
/// ```
pub fn applied<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 3]) -> [S; 3] {
    let theta = q[1];
    let sin_theta = theta.sin();
    let zero = S::ZERO;
    let q_theta = p.m_l_g * sin_theta;
    [zero, q_theta, zero]
}

/// Right-hand side `f = Q - h` of `M a = f`.
pub fn forces<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 3], v: &[S; 3]) -> [S; 3] {
    let theta = q[1];
    let psi_dot = v[0];
    let theta_dot = v[1];
    let phi_dot = v[2];
    let (sin_theta, cos_theta) = theta.sin_cos();
    let t0 = theta_dot * p.C;
    let t1 = sin_theta * psi_dot;
    let t2 = cos_theta * t1;
    let f_psi = sin_theta * (t0 * phi_dot) - t2 * (theta_dot * p.k2);
    let f_theta = t2 * (psi_dot * p.k1) + (sin_theta * p.m_l_g - t1 * (p.C * phi_dot));
    let f_phi = t0 * t1;
    [f_psi, f_theta, f_phi]
}

::lagrangian::emitted::fast_function! {
    /// Accelerations `a`, the solution of `M a = f` eliminated along the machine.
    ///
    /// A pivot that vanishes is an error.
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
    let theta = n(q[1]);
    let phi = n(q[2]);
    let psi_dot = n(v[0]);
    let theta_dot = n(v[1]);
    let phi_dot = n(v[2]);
    let angles = [theta, phi];
    let circular = N::sin_cos_all(angles);
    let (sin_theta, cos_theta) = circular[0];
    let (sin_phi, cos_phi) = circular[1];
    let t0 = psi_dot * theta_dot;
    let t1 = sin_theta * psi_dot;
    let t2 = cos_theta * t0;
    let t3 = sin_theta * n(p.m_l_g);
    let t4 = n(p.k0) * cos_theta.mul_add(psi_dot, phi_dot);
    let t5 = sin_phi.mul_add(t1, cos_phi * theta_dot);
    let t6 = cos_phi.mul_sub(t1, sin_phi * theta_dot);
    let t7 = sin_theta * (sin_theta * n(p.A_plus_m_l_squared));
    let t8 = phi_dot.neg_mul_add(t5, cos_phi * t2);
    let t9 = phi_dot.mul_add(t6, sin_phi * t2);
    let t10 = n(p.A_plus_m_l_squared).mul_sub(t8, t4 * t5);
    let t11 = t3.mul_add(sin_phi, t10);
    let t12 = n(p.A_plus_m_l_squared).mul_add(t9, t4 * t6);
    let t13 = t3.neg_mul_add(cos_phi, t12);
    let t14 = N::ONE / sin_theta * sin_phi.mul_add(t13, cos_phi * t11);
    let psi_ddot = t14 * n(p.k4);
    let theta_ddot = n(p.k3) * sin_phi.mul_sub(t11, cos_phi * t13);
    let phi_ddot = t14.mul_add(cos_theta * n(p.k3), sin_theta * t0);
    let t15 = cos_theta.mul_add(cos_theta * n(p.C), t7);
    let sound = PIVOTS.hold(t7, t15) & phi_ddot.is_finite();
    if !sound {
        let pivots = [(0, t7, t15)];
        PIVOTS.check(pivots)?;
    }
    let accelerations = [psi_ddot.store(), theta_ddot.store(), phi_ddot.store()];
    Ok(accelerations)
}

/// Kinetic energy `T`, in J.
///
/// ```text
/// T = 1/2*(m*l^2 + A)*sin(theta)^2*der(psi)^2 + 1/2*(m*l^2 + A)*der(theta)^2
///     + 1/2*C*(cos(theta)*der(psi) + der(phi))^2
/// ```
pub fn kinetic_energy<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 3],
    v: &[S; 3],
) -> S {
    let theta = q[1];
    let psi_dot = v[0];
    let theta_dot = v[1];
    let phi_dot = v[2];
    let (sin_theta, cos_theta) = theta.sin_cos();
    let t0 = cos_theta * psi_dot + phi_dot;
    let t1 = sin_theta * psi_dot;
    let t2 = t1 * t1 + theta_dot * theta_dot;
    S::from_f64(0.5) * (t2 * p.m_l_squared + (t2 * p.A + t0 * (t0 * p.C)))
}

/// Potential energy `V`, in J.
///
/// ```text
/// V = m*l*g*cos(theta)
/// ```
pub fn potential_energy<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 3]) -> S {
    let theta = q[1];
    let cos_theta = theta.cos();
    p.m_l_g * cos_theta
}

/// Angular momentum about the vertical: conserved. Unit: `J*s`.
///
/// ```text
/// vertical_momentum = C*cos(theta)^2*der(psi) + (m*l^2 + A)*sin(theta)^2*der(psi)
///     + C*cos(theta)*der(phi)
/// ```
pub fn output_vertical_momentum<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 3],
    v: &[S; 3],
) -> S {
    let theta = q[1];
    let psi_dot = v[0];
    let phi_dot = v[2];
    let (sin_theta, cos_theta) = theta.sin_cos();
    let t0 = cos_theta * p.C;
    let t1 = cos_theta * t0 + sin_theta * (sin_theta * p.A_plus_m_l_squared);
    t0 * phi_dot + t1 * psi_dot
}

/// Angular momentum about the top's axis: conserved. Unit: `J*s`.
///
/// ```text
/// axial_momentum = C*(cos(theta)*der(psi) + der(phi))
/// ```
pub fn output_axial_momentum<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 3],
    v: &[S; 3],
) -> S {
    let theta = q[1];
    let psi_dot = v[0];
    let phi_dot = v[2];
    let cos_theta = theta.cos();
    (cos_theta * psi_dot + phi_dot) * p.C
}

/// By how much `sin(theta) > 0` holds.
pub fn assumption_0<S: ::lagrangian::emitted::Scalar>(q: &[S; 3]) -> S {
    let theta = q[1];
    let sin_theta = theta.sin();
    sin_theta
}

/// Everything that the description asks to observe.
pub fn outputs<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 3],
    v: &[S; 3],
) -> Outputs<S> {
    Outputs {
        vertical_momentum: output_vertical_momentum(p, q, v),
        axial_momentum: output_axial_momentum(p, q, v),
    }
}

::lagrangian::emitted::implement! {
    machine HeavyTop "HeavyTop" over S, R;
    parameters { m, l, A, C, g } [
        m: "m" "kg" = 15.0;
        l: "l" "m" = 1.0;
        A: "A" "kg*m^2" = 0.234375;
        C: "C" "kg*m^2" = 0.46875;
        g: "g" "m/s^2" = 9.81;
    ]
    coordinates 3 Coordinates { psi, theta, phi } [
        psi: "psi" "rad";
        theta: "theta" "rad";
        phi: "phi" "rad";
    ]
    inputs Inputs {} [], defined here
    outputs Outputs { vertical_momentum, axial_momentum } [
        vertical_momentum: "vertical_momentum" "J*s";
        axial_momentum: "axial_momentum" "J*s";
    ]
    prepared Prepared { A, C, m_l_squared, A_plus_m_l_squared, m_l_g, k0, k1, k2, minus_C, k3, k4 }
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
