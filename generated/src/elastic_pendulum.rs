// @generated from machines/elastic_pendulum.machine by `cargo xtask generate`; edits are lost.

//! A point mass on a spring that swings and stretches in a vertical plane, in polar
//! coordinates.
//!
//! At rest the spring is l = l0 + m g/k long. Small motion is two oscillators, which stretch
//! with sqrt(k/m) and swing with sqrt(g/l). Up and down alone the motion is harmonic however
//! large, r = l + a cos(sqrt(k/m) t), but as steady as it looks it need not be: at k/m = 4 g/l,
//! which is chosen here, each stretching feeds the swinging, and the two take the energy by
//! turns (A. Vitt, G. Gorelik, Zh. Tekh. Fiz. 3 (1933) 294). Without gravity the angular
//! momentum m r^2 der(theta) is conserved as well, and the mass can run in a circle.
//!
//! 2 coordinates, 4 parameters, 1 output. Arithmetic of one call:
//!
//! | function | mul | add | div | sin cos | other | temporaries |
//! | --- | --: | --: | --: | --: | --: | --: |
//! | `prepare` | 4 | 2 | 1 | 0 | 0 | 7 |
//! | `mass_matrix` | 2 | 0 | 0 | 0 | 0 | 2 |
//! | `bias` | 5 | 0 | 0 | 0 | 0 | 5 |
//! | `applied` | 4 | 2 | 0 | 1 | 0 | 8 |
//! | `forces` | 9 | 5 | 0 | 1 | 0 | 16 |
//! | `accelerations` | 12 | 5 | 1 | 1 | 0 | 20 |
//! | `kinetic_energy` | 8 | 3 | 0 | 1 | 0 | 13 |
//! | `potential_energy` | 4 | 2 | 0 | 1 | 0 | 7 |
//! | `output_momentum` | 3 | 0 | 0 | 0 | 0 | 3 |
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

/// A point mass on a spring that swings and stretches in a vertical plane, in polar
/// coordinates.
///
/// At rest the spring is l = l0 + m g/k long. Small motion is two oscillators, which stretch
/// with sqrt(k/m) and swing with sqrt(g/l). Up and down alone the motion is harmonic however
/// large, r = l + a cos(sqrt(k/m) t), but as steady as it looks it need not be: at k/m = 4 g/l,
/// which is chosen here, each stretching feeds the swinging, and the two take the energy by
/// turns (A. Vitt, G. Gorelik, Zh. Tekh. Fiz. 3 (1933) 294). Without gravity the angular
/// momentum m r^2 der(theta) is conserved as well, and the mass can run in a circle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ElasticPendulum<S = f64> {
    /// Mass of the bob. Unit: `kg`. Default: 1.
    pub m: S,
    /// Stiffness of the spring. Unit: `N/m`. Default: 39.24.
    pub k: S,
    /// Length of the spring without load. Unit: `m`. Default: 0.75.
    pub l0: S,
    /// Acceleration of gravity. Unit: `m/s^2`. Default: 9.81.
    pub g: S,
}

impl<S: ::lagrangian::emitted::Scalar> ElasticPendulum<S> {
    /// Computes what depends on the parameters alone, once.
    pub fn prepare(&self) -> Prepared<S> {
        let half_m = self.m * S::from_f64(0.5);
        let half_k = self.k * S::from_f64(0.5);
        let two_m = self.m * S::from_f64(2.0);
        let minus_m = -self.m;
        let minus_m_g = -(self.m * self.g);
        let inverse_m = S::ONE / self.m;
        let pivots = [(0, self.m, self.m)];
        Prepared {
            m: self.m,
            k: self.k,
            l0: self.l0,
            half_m,
            half_k,
            two_m,
            minus_m,
            minus_m_g,
            inverse_m,
            singular: PIVOTS.vanished(pivots),
        }
    }

    /// The start values of the description, at rest and `t = 0`.
    pub fn start(&self) -> ::lagrangian::emitted::State<Coordinates<S>> {
        let r = S::from_ratio(6, 5);
        let theta = S::from_ratio(1, 10);
        let q = [r, theta];
        let v = [S::ZERO; 2];
        ::lagrangian::emitted::State {
            t: 0.0,
            q: Coordinates::from_array(q),
            v: Coordinates::from_array(v),
        }
    }
}

/// The coordinates of [`ElasticPendulum`], or their rates, by name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coordinates<S = f64> {
    /// Length of the spring. Unit: `m`.
    pub r: S,
    /// Angle of the spring from the downward vertical. Unit: `rad`.
    pub theta: S,
}

/// What can be observed of a [`ElasticPendulum`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outputs<S = f64> {
    /// Angular momentum about the pivot: conserved where nothing weighs. Unit: `J*s`.
    pub momentum: S,
}

/// The parameters of a [`ElasticPendulum`], with the work done that depends on them alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prepared<S = f64> {
    /// `m`
    m: S,
    /// `k`
    k: S,
    /// `l0`
    l0: S,
    /// `0.5*m`
    half_m: S,
    /// `0.5*k`
    half_k: S,
    /// `2*m`
    two_m: S,
    /// `-m`
    minus_m: S,
    /// `-m*g`
    minus_m_g: S,
    /// `1/m`
    inverse_m: S,
    /// Why these parameters leave the machine without accelerations, if they do.
    singular: Option<::lagrangian::emitted::Singular>,
}

/// A pivot of an elimination that is not above this share of its diagonal element may be rounding
/// errors alone.
const PIVOTS: ::lagrangian::emitted::Pivots = ::lagrangian::emitted::Pivots::new(2, 2);

/// Mass matrix `M`.
///
/// ```text
/// M[r, r] = m
/// M[theta, theta] = m*r^2
/// ```
pub fn mass_matrix<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 2]) -> [[S; 2]; 2] {
    let r = q[0];
    let zero = S::ZERO;
    let m22 = r * (p.m * r);
    [[p.m, zero], [zero, m22]]
}

/// Bias `h`: velocity products and explicit time in the inertia forces.
///
/// ```text
/// h[r] = -m*r*der(theta)^2
/// h[theta] = 2*m*r*der(r)*der(theta)
/// ```
pub fn bias<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 2], v: &[S; 2]) -> [S; 2] {
    let r = q[0];
    let r_dot = v[0];
    let theta_dot = v[1];
    let t0 = theta_dot * r;
    let h_r = t0 * (theta_dot * p.minus_m);
    let h_theta = t0 * (p.two_m * r_dot);
    [h_r, h_theta]
}

/// Applied generalized forces `Q`.
///
/// ```text
/// Q[r] = m*g*cos(theta) - k*(r - l0)
/// Q[theta] = -m*g*r*sin(theta)
/// ```
pub fn applied<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 2]) -> [S; 2] {
    let r = q[0];
    let theta = q[1];
    let (sin_theta, cos_theta) = theta.sin_cos();
    let q_r = (p.l0 - r) * p.k - cos_theta * p.minus_m_g;
    let q_theta = sin_theta * (r * p.minus_m_g);
    [q_r, q_theta]
}

/// Right-hand side `f = Q - h` of `M a = f`.
pub fn forces<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 2], v: &[S; 2]) -> [S; 2] {
    let r = q[0];
    let theta = q[1];
    let r_dot = v[0];
    let theta_dot = v[1];
    let (sin_theta, cos_theta) = theta.sin_cos();
    let t0 = theta_dot * r;
    let f_r = (p.l0 - r) * p.k - cos_theta * p.minus_m_g + t0 * (theta_dot * p.m);
    let f_theta = -(t0 * (p.two_m * r_dot) - sin_theta * (r * p.minus_m_g));
    [f_r, f_theta]
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
    let r = n(q[0]);
    let theta = n(q[1]);
    let r_dot = n(v[0]);
    let theta_dot = n(v[1]);
    let (sin_theta, cos_theta) = theta.sin_cos();
    let t0 = r * n(p.m);
    // Row theta: pivot d[theta].
    let t1 = r * t0;
    let t2 = r * n(p.two_m) * (theta_dot * r_dot);
    let t3 = (n(p.l0) - r) * n(p.k);
    let t4 = cos_theta.neg_mul_add(n(p.minus_m_g), t3);
    let r_ddot = t0.mul_add(theta_dot * theta_dot, t4) * n(p.inverse_m);
    let theta_ddot = -(sin_theta.neg_mul_add(r * n(p.minus_m_g), t2) / t1);
    let sound = PIVOTS.hold(t1, t1) & theta_ddot.is_finite();
    if !sound {
        let pivots = [(1, t1, t1)];
        PIVOTS.check(pivots)?;
    }
    let accelerations = [r_ddot.store(), theta_ddot.store()];
    Ok(accelerations)
}

/// Kinetic energy `T`, in J.
///
/// ```text
/// T = 1/2*m*der(r)^2 + 1/2*m*r^2*der(theta)^2
/// ```
pub fn kinetic_energy<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 2],
    v: &[S; 2],
) -> S {
    let r = q[0];
    let theta = q[1];
    let r_dot = v[0];
    let theta_dot = v[1];
    let (sin_theta, cos_theta) = theta.sin_cos();
    let t0 = theta_dot * r;
    let t1 = t0 * cos_theta + sin_theta * r_dot;
    let t2 = cos_theta * r_dot - t0 * sin_theta;
    p.half_m * (t2 * t2 + t1 * t1)
}

/// Potential energy `V`, in J.
///
/// ```text
/// V = 1/2*k*(r - l0)^2 - m*g*r*cos(theta)
/// ```
pub fn potential_energy<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 2]) -> S {
    let r = q[0];
    let theta = q[1];
    let cos_theta = theta.cos();
    let t0 = p.l0 - r;
    t0 * (t0 * p.half_k) + cos_theta * (r * p.minus_m_g)
}

/// Angular momentum about the pivot: conserved where nothing weighs. Unit: `J*s`.
///
/// ```text
/// momentum = m*r^2*der(theta)
/// ```
pub fn output_momentum<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 2],
    v: &[S; 2],
) -> S {
    let r = q[0];
    let theta_dot = v[1];
    r * p.m * (r * theta_dot)
}

/// By how much `r > 0` holds.
pub fn assumption_0<S: ::lagrangian::emitted::Scalar>(q: &[S; 2]) -> S {
    let r = q[0];
    r
}

/// Everything that the description asks to observe.
pub fn outputs<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 2],
    v: &[S; 2],
) -> Outputs<S> {
    Outputs {
        momentum: output_momentum(p, q, v),
    }
}

::lagrangian::emitted::implement! {
    machine ElasticPendulum "ElasticPendulum" over S, R;
    parameters { m, k, l0, g } [
        m: "m" "kg" = 1.0;
        k: "k" "N/m" = 39.24;
        l0: "l0" "m" = 0.75;
        g: "g" "m/s^2" = 9.81;
    ]
    coordinates 2 Coordinates { r, theta } [
        r: "r" "m";
        theta: "theta" "rad";
    ]
    inputs Inputs {} [], defined here
    outputs Outputs { momentum } [
        momentum: "momentum" "J*s";
    ]
    prepared Prepared { m, k, l0, half_m, half_k, two_m, minus_m, minus_m_g, inverse_m }
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
        facts assumptions(p, t, q, v, u) = [("r > 0", true, assumption_0(q))];
    }
    absent [MAY_BE_CONSTRAINED MAY_SLIDE MAY_COLLIDE]
    intervals []
    lanes [N]
    numbers [yes]
}
