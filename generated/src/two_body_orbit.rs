// @generated from machines/two_body_orbit.machine by `cargo xtask generate`; edits are lost.

//! Two bodies that attract each other as Newton says, seen from their common mass centre: r and
//! phi are the distance and the direction of the second from the first.
//!
//! The spec does not mention the reduced mass mu = m1 m2/(m1 + m2): it results from the derivation,
//! since both bodies move with the line between them. Each body moves on a conic with a focus in
//! the mass centre. Conserved: energy E, angular momentum mu r^2 der(phi), and the eccentricity
//! vector (P. S. Laplace, C. Runge, W. Lenz), which points from the focus to the pericentre and
//! whose length is the eccentricity e. If E < 0, with the semi-major axis
//! a = G m1 m2/(-2 E), the period is 2 pi sqrt(a^3/(G (m1 + m2))), and Kepler's equation
//! u - e sin(u) = n t gives the distance, r = a (1 - e cos(u)). On a circle of radius r,
//! der(phi)^2 = G (m1 + m2)/r^3. From rest the bodies would fall into each other.
//!
//! 2 coordinates, 3 parameters, 3 outputs. Arithmetic of one call:
//!
//! | function | mul | add | div | sin cos | other | temporaries |
//! | --- | --: | --: | --: | --: | --: | --: |
//! | `prepare` | 10 | 7 | 2 | 0 | 0 | 19 |
//! | `mass_matrix` | 2 | 0 | 0 | 0 | 0 | 2 |
//! | `bias` | 5 | 0 | 0 | 0 | 0 | 5 |
//! | `applied` | 1 | 0 | 1 | 0 | 0 | 2 |
//! | `forces` | 6 | 1 | 1 | 0 | 0 | 8 |
//! | `accelerations` | 11 | 1 | 1 | 0 | 0 | 13 |
//! | `kinetic_energy` | 4 | 1 | 0 | 0 | 0 | 5 |
//! | `potential_energy` | 0 | 0 | 1 | 0 | 0 | 1 |
//! | `output_momentum` | 3 | 0 | 0 | 0 | 0 | 3 |
//! | `output_eccentricity_x` | 7 | 2 | 0 | 1 | 0 | 11 |
//! | `output_eccentricity_y` | 7 | 3 | 0 | 1 | 0 | 12 |
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

/// Two bodies that attract each other as Newton says, seen from their common mass centre: r and
/// phi are the distance and the direction of the second from the first.
///
/// The spec does not mention the reduced mass mu = m1 m2/(m1 + m2): it results from the derivation,
/// since both bodies move with the line between them. Each body moves on a conic with a focus in
/// the mass centre. Conserved: energy E, angular momentum mu r^2 der(phi), and the eccentricity
/// vector (P. S. Laplace, C. Runge, W. Lenz), which points from the focus to the pericentre and
/// whose length is the eccentricity e. If E < 0, with the semi-major axis
/// a = G m1 m2/(-2 E), the period is 2 pi sqrt(a^3/(G (m1 + m2))), and Kepler's equation
/// u - e sin(u) = n t gives the distance, r = a (1 - e cos(u)). On a circle of radius r,
/// der(phi)^2 = G (m1 + m2)/r^3. From rest the bodies would fall into each other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TwoBodyOrbit<S = f64> {
    /// Mass of the first body, and of the second. Unit: `kg`. Default: 3.
    pub m1: S,
    /// `m2`. Unit: `kg`. Default: 1.
    pub m2: S,
    /// Constant of gravitation, 6.674e-11 in SI units. Lengths, masses and times are chosen
    /// here to make it 1. Unit: `N*m^2/kg^2`. Default: 1.
    pub G: S,
}

impl<S: ::lagrangian::emitted::Scalar> TwoBodyOrbit<S> {
    /// Computes what depends on the parameters alone, once.
    pub fn prepare(&self) -> Prepared<S> {
        let t0 = self.m2 + self.m1;
        let k7 = S::ONE / t0;
        let t1 = self.m1 * k7;
        let k1 = self.m2 * t1;
        let t2 = t1 * k1;
        let k4 = k1 * S::from_f64(2.0);
        let t3 = k7 * (self.m2 * k1);
        let k2 = t3 + t2;
        let k0 = k7 / self.G;
        let k3 = t2 * S::from_f64(0.5) + t3 * S::from_f64(0.5);
        let k5 = -k1;
        let minus_m1_m2_G = -(self.G * (self.m2 * self.m1));
        let k6 = -k4;
        let k8 = -t0;
        let pivots = [(0, k1, k2)];
        Prepared {
            G: self.G,
            k0,
            k1,
            k2,
            k3,
            k4,
            k5,
            minus_m1_m2_G,
            k6,
            k7,
            k8,
            singular: PIVOTS.vanished(pivots),
        }
    }

    /// The start values of the description, at `t = 0`.
    pub fn start(&self) -> ::lagrangian::emitted::State<Coordinates<S>> {
        let r = S::from_ratio(2, 5);
        let zero = S::ZERO;
        let q = [r, zero];
        let v = [zero, S::from_f64(10.0)];
        ::lagrangian::emitted::State {
            t: 0.0,
            q: Coordinates::from_array(q),
            v: Coordinates::from_array(v),
        }
    }
}

/// The coordinates of [`TwoBodyOrbit`], or their rates, by name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coordinates<S = f64> {
    /// Distance of the bodies. Unit: `m`.
    pub r: S,
    /// Direction of the second body, seen from the first.
    /// They start at the pericentre of an ellipse of e = 0.6. Unit: `rad`.
    pub phi: S,
}

/// What can be observed of a [`TwoBodyOrbit`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outputs<S = f64> {
    /// Angular momentum about the mass centre: conserved. Unit: `J*s`.
    pub momentum: S,
    /// The eccentricity vector in ground axes: conserved. Unit: `1`.
    pub eccentricity_x: S,
    /// `eccentricity_y`. Unit: `1`.
    pub eccentricity_y: S,
}

/// The parameters of a [`TwoBodyOrbit`], with the work done that depends on them alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prepared<S = f64> {
    /// `G`
    G: S,
    /// `1/G/(m1 + m2)`
    k0: S,
    /// `m1*m2/(m1 + m2)`
    k1: S,
    /// `m1^2*m2/(m1 + m2)^2 + m1*m2^2/(m1 + m2)^2`
    k2: S,
    /// `0.5*m1*m2^2/(m1 + m2)^2 + 0.5*m1^2*m2/(m1 + m2)^2`
    k3: S,
    /// `2*m1*m2/(m1 + m2)`
    k4: S,
    /// `-m1*m2/(m1 + m2)`
    k5: S,
    /// `-m1*m2*G`
    minus_m1_m2_G: S,
    /// `-2*m1*m2/(m1 + m2)`
    k6: S,
    /// `1/(m1 + m2)`
    k7: S,
    /// `-(m1 + m2)`
    k8: S,
    /// Why these parameters leave the machine without accelerations, if they do.
    singular: Option<::lagrangian::emitted::Singular>,
}

/// A pivot of an elimination that is not above this share of its diagonal element may be rounding
/// errors alone.
const PIVOTS: ::lagrangian::emitted::Pivots = ::lagrangian::emitted::Pivots::new(2, 2);

/// Mass matrix `M`.
///
/// ```text
/// M[r, r] = m1^2*m2/(m1 + m2)^2 + m1*m2^2/(m1 + m2)^2
/// M[phi, phi] = m1*m2*r^2/(m1 + m2)
/// ```
pub fn mass_matrix<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 2]) -> [[S; 2]; 2] {
    let r = q[0];
    let zero = S::ZERO;
    let m22 = r * (r * p.k1);
    [[p.k2, zero], [zero, m22]]
}

/// Bias `h`: velocity products and explicit time in the inertia forces.
///
/// ```text
/// h[r] = -m1*m2*r*der(phi)^2/(m1 + m2)
/// h[phi] = 2*m1*m2*r*der(r)*der(phi)/(m1 + m2)
/// ```
pub fn bias<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 2], v: &[S; 2]) -> [S; 2] {
    let r = q[0];
    let r_dot = v[0];
    let phi_dot = v[1];
    let t0 = phi_dot * r;
    let h_r = t0 * (phi_dot * p.k5);
    let h_phi = t0 * (p.k4 * r_dot);
    [h_r, h_phi]
}

/// Applied generalized forces `Q`.
///
/// ```text
/// Q[r] = -m1*m2*G/r^2
/// ```
pub fn applied<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 2]) -> [S; 2] {
    let r = q[0];
    let q_r = p.minus_m1_m2_G / (r * r);
    let zero = S::ZERO;
    [q_r, zero]
}

/// Right-hand side `f = Q - h` of `M a = f`.
pub fn forces<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 2], v: &[S; 2]) -> [S; 2] {
    let r = q[0];
    let r_dot = v[0];
    let phi_dot = v[1];
    let t0 = r * phi_dot;
    let f_r = p.minus_m1_m2_G / (r * r) + t0 * (phi_dot * p.k1);
    let f_phi = t0 * (p.k6 * r_dot);
    [f_r, f_phi]
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
    let r = n(q[0]);
    let r_dot = n(v[0]);
    let phi_dot = n(v[1]);
    let t0 = N::ONE / r;
    let t1 = r * (r * n(p.k1));
    let t2 = t0.mul_sub(t0 * n(p.G), r * n(p.k7) * (phi_dot * phi_dot));
    let r_ddot = n(p.k8) * t2;
    let phi_ddot = t0 * (phi_dot * (N::from_f64(-2.0) * r_dot));
    let sound = PIVOTS.hold(t1, t1) & r_ddot.is_finite();
    if !sound {
        let pivots = [(1, t1, t1)];
        PIVOTS.check(pivots)?;
    }
    let accelerations = [r_ddot.store(), phi_ddot.store()];
    Ok(accelerations)
}

/// Kinetic energy `T`, in J.
///
/// ```text
/// T = 1/2*m1*m2*der(r)^2/(m1 + m2) + 1/2*m1*m2*r^2*der(phi)^2/(m1 + m2)
/// ```
pub fn kinetic_energy<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 2],
    v: &[S; 2],
) -> S {
    let r = q[0];
    let r_dot = v[0];
    let phi_dot = v[1];
    let t0 = phi_dot * r;
    p.k3 * (t0 * t0 + r_dot * r_dot)
}

/// Potential energy `V`, in J.
///
/// ```text
/// V = -m1*m2*G/r
/// ```
pub fn potential_energy<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 2]) -> S {
    let r = q[0];
    p.minus_m1_m2_G / r
}

/// Angular momentum about the mass centre: conserved. Unit: `J*s`.
///
/// ```text
/// momentum = m1*m2*r^2*der(phi)/(m1 + m2)
/// ```
pub fn output_momentum<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 2],
    v: &[S; 2],
) -> S {
    let r = q[0];
    let phi_dot = v[1];
    r * p.k1 * (r * phi_dot)
}

/// The eccentricity vector in ground axes: conserved. Unit: `1`.
///
/// ```text
/// eccentricity_x = r^2*sin(phi)*der(r)*der(phi)/((m1 + m2)*G)
///     + r^3*cos(phi)*der(phi)^2/((m1 + m2)*G) - cos(phi)
/// ```
pub fn output_eccentricity_x<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 2],
    v: &[S; 2],
) -> S {
    let r = q[0];
    let phi = q[1];
    let r_dot = v[0];
    let phi_dot = v[1];
    let (sin_phi, cos_phi) = phi.sin_cos();
    let t0 = r * phi_dot;
    let t1 = p.k0 * r * t0;
    sin_phi * (t1 * r_dot) - cos_phi * (S::ONE - t0 * t1)
}

/// `eccentricity_y`. Unit: `1`.
///
/// ```text
/// eccentricity_y = r^3*sin(phi)*der(phi)^2/((m1 + m2)*G)
///     - r^2*cos(phi)*der(r)*der(phi)/((m1 + m2)*G) - sin(phi)
/// ```
pub fn output_eccentricity_y<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 2],
    v: &[S; 2],
) -> S {
    let r = q[0];
    let phi = q[1];
    let r_dot = v[0];
    let phi_dot = v[1];
    let (sin_phi, cos_phi) = phi.sin_cos();
    let t0 = r * phi_dot;
    let t1 = p.k0 * r * t0;
    -(cos_phi * (t1 * r_dot) + sin_phi * (S::ONE - t0 * t1))
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
        eccentricity_x: output_eccentricity_x(p, q, v),
        eccentricity_y: output_eccentricity_y(p, q, v),
    }
}

::lagrangian::emitted::implement! {
    machine TwoBodyOrbit "TwoBodyOrbit" over S, R;
    parameters { m1, m2, G } [
        m1: "m1" "kg" = 3.0;
        m2: "m2" "kg" = 1.0;
        G: "G" "N*m^2/kg^2" = 1.0;
    ]
    coordinates 2 Coordinates { r, phi } [
        r: "r" "m";
        phi: "phi" "rad";
    ]
    inputs Inputs {} [], defined here
    outputs Outputs { momentum, eccentricity_x, eccentricity_y } [
        momentum: "momentum" "J*s";
        eccentricity_x: "eccentricity_x" "1";
        eccentricity_y: "eccentricity_y" "1";
    ]
    prepared Prepared { G, k0, k1, k2, k3, k4, k5, minus_m1_m2_G, k6, k7, k8 }
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
