// @generated from machines/gyroscope_in_gimbals.machine by `cargo xtask generate`; edits are lost.

//! A rotor in two gimbals: the outer turns about the vertical, the inner in it about a
//! horizontal axis, the rotor in that about its own axis. A weight hangs on the inner gimbal,
//! on the rotor's axis. Gimbals have inertia.
//!
//! alpha and gamma are cyclic. Conserved: energy, the rotor's angular momentum about its axis
//! H, and the angular momentum about the vertical. With its axis level the gyroscope precesses
//! steadily at exactly der(alpha) = w g d/H, whatever its gimbals are; inclined, at the roots of
//! a quadratic equation, of which the slow one tends to w g d/H as the rotor gets faster.
//! Disturbed it nods, without gravity at H cos(beta)/sqrt(I J), where I and J are all that
//! turns about the outer and the inner axis: gimbals slow that down. And they make it drift: as
//! it nods by b to either side of beta, the outer gimbal goes round at
//! -H b^2 sin(beta) (A1 + B2)/(2 I^2) on the average, which would be 0 without the gimbals'
//! inertia (B. T. Plymale, R. Goodstein, J. Appl. Mech. 22 (1955) 365; K. Magnus, Kreisel,
//! 1971).
//!
//! These angles are the joints of a device, so nothing fails where beta is a right angle but
//! the device itself: gimbal lock, in which rotor and outer gimbal turn about one line.
//!
//! 3 coordinates, 12 parameters, 2 outputs. Arithmetic of one call:
//!
//! | function | mul | add | div | sin cos | other | temporaries |
//! | --- | --: | --: | --: | --: | --: | --: |
//! | `prepare` | 6 | 17 | 1 | 0 | 0 | 24 |
//! | `mass_matrix` | 3 | 1 | 0 | 1 | 0 | 5 |
//! | `bias` | 10 | 3 | 0 | 1 | 0 | 15 |
//! | `applied` | 1 | 0 | 0 | 1 | 0 | 2 |
//! | `forces` | 13 | 4 | 0 | 1 | 0 | 19 |
//! | `accelerations` | 16 | 7 | 1 | 1 | 0 | 26 |
//! | `kinetic_energy` | 16 | 8 | 0 | 1 | 0 | 26 |
//! | `potential_energy` | 1 | 0 | 0 | 1 | 0 | 2 |
//! | `output_rotor_momentum` | 2 | 1 | 0 | 1 | 0 | 4 |
//! | `output_vertical_momentum` | 8 | 4 | 0 | 1 | 0 | 14 |
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

/// A rotor in two gimbals: the outer turns about the vertical, the inner in it about a
/// horizontal axis, the rotor in that about its own axis. A weight hangs on the inner gimbal,
/// on the rotor's axis. Gimbals have inertia.
///
/// alpha and gamma are cyclic. Conserved: energy, the rotor's angular momentum about its axis
/// H, and the angular momentum about the vertical. With its axis level the gyroscope precesses
/// steadily at exactly der(alpha) = w g d/H, whatever its gimbals are; inclined, at the roots of
/// a quadratic equation, of which the slow one tends to w g d/H as the rotor gets faster.
/// Disturbed it nods, without gravity at H cos(beta)/sqrt(I J), where I and J are all that
/// turns about the outer and the inner axis: gimbals slow that down. And they make it drift: as
/// it nods by b to either side of beta, the outer gimbal goes round at
/// -H b^2 sin(beta) (A1 + B2)/(2 I^2) on the average, which would be 0 without the gimbals'
/// inertia (B. T. Plymale, R. Goodstein, J. Appl. Mech. 22 (1955) 365; K. Magnus, Kreisel,
/// 1971).
///
/// These angles are the joints of a device, so nothing fails where beta is a right angle but
/// the device itself: gimbal lock, in which rotor and outer gimbal turn about one line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GyroscopeInGimbals<S = f64> {
    /// Inertia of the outer gimbal about its axis, the vertical. Unit: `kg*m^2`. Default: 0.002.
    pub A1: S,
    /// Inertia of the inner gimbal: about its axis, about the rotor's, about the third. Unit:
    /// `kg*m^2`. Default: 0.0012.
    pub A2: S,
    /// `B2`. Unit: `kg*m^2`. Default: 0.0008.
    pub B2: S,
    /// `C2`. Unit: `kg*m^2`. Default: 0.0008.
    pub C2: S,
    /// Inertia of the rotor: across its axis, and about it. Unit: `kg*m^2`. Default: 0.0015.
    pub A3: S,
    /// `C3`. Unit: `kg*m^2`. Default: 0.0025.
    pub C3: S,
    /// Masses of the gimbals and of the rotor. Their centres rest, so nothing depends on
    /// them. Unit: `kg`. Default: 0.5.
    pub m1: S,
    /// `m2`. Unit: `kg`. Default: 0.4.
    pub m2: S,
    /// `m3`. Unit: `kg`. Default: 1.2.
    pub m3: S,
    /// Mass of the weight, and its distance from the centre. Unit: `kg`. Default: 0.05.
    pub w: S,
    /// `d`. Unit: `m`. Default: 0.12.
    pub d: S,
    /// Acceleration of gravity. Unit: `m/s^2`. Default: 9.81.
    pub g: S,
}

impl<S: ::lagrangian::emitted::Scalar> GyroscopeInGimbals<S> {
    /// Computes what depends on the parameters alone, once.
    pub fn prepare(&self) -> Prepared<S> {
        let t0 = self.d * self.w;
        let t1 = self.d * t0;
        let w_d_g = t0 * self.g;
        let k1 = self.A3 + (self.A2 + t1);
        let k0 = self.A3 + (self.C2 + t1);
        let k2 = self.B2 - k0;
        let k6 = self.B2 + self.C3 - k0;
        let t2 = k1 - k2;
        let t3 = self.C3 + (k1 + k2);
        let k3 = self.A1 + k0;
        let k4 = self.C3 + k2;
        let k5 = t2 - t3;
        let half_A1 = self.A1 * S::from_f64(0.5);
        let half_w_d_squared = t1 * S::from_f64(0.5);
        let k7 = k6 * S::from_f64(2.0);
        let minus_w_d_g = -w_d_g;
        let minus_C3 = -self.C3;
        let k8 = t3 - t2;
        let k9 = -(S::ONE / k1);
        let pivots = [(2, self.C3, self.C3), (1, k1, k1)];
        Prepared {
            A1: self.A1,
            A2: self.A2,
            B2: self.B2,
            C2: self.C2,
            A3: self.A3,
            C3: self.C3,
            k0,
            k1,
            k2,
            k3,
            w_d_g,
            k4,
            k5,
            half_A1,
            half_w_d_squared,
            k6,
            k7,
            minus_w_d_g,
            minus_C3,
            k8,
            k9,
            singular: PIVOTS.vanished(pivots),
        }
    }

    /// The start values of the description, at `t = 0`.
    pub fn start(&self) -> ::lagrangian::emitted::State<Coordinates<S>> {
        let zero = S::ZERO;
        let beta = S::from_ratio(1, 5);
        let q = [zero, beta, zero];
        let v = [zero, zero, S::from_f64(300.0)];
        ::lagrangian::emitted::State {
            t: 0.0,
            q: Coordinates::from_array(q),
            v: Coordinates::from_array(v),
        }
    }
}

/// The coordinates of [`GyroscopeInGimbals`], or their rates, by name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coordinates<S = f64> {
    /// Turn of the outer gimbal about the vertical. Unit: `rad`.
    pub alpha: S,
    /// Inclination of the rotor's axis, upwards from the horizontal. Unit: `rad`.
    pub beta: S,
    /// Turn of the rotor in the inner gimbal.
    /// Its speed: fast beside the rates that the weight makes. Unit: `rad`.
    pub gamma: S,
}

/// What can be observed of a [`GyroscopeInGimbals`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outputs<S = f64> {
    /// Angular momentum of the rotor about its axis, H: conserved. Unit: `J*s`.
    pub rotor_momentum: S,
    /// Angular momentum of everything about the vertical: conserved. Unit: `J*s`.
    pub vertical_momentum: S,
}

/// The parameters of a [`GyroscopeInGimbals`], with the work done that depends on them alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prepared<S = f64> {
    /// `A1`
    A1: S,
    /// `A2`
    A2: S,
    /// `B2`
    B2: S,
    /// `C2`
    C2: S,
    /// `A3`
    A3: S,
    /// `C3`
    C3: S,
    /// `C2 + A3 + w*d^2`
    k0: S,
    /// `A3 + A2 + w*d^2`
    k1: S,
    /// `B2 - (A3 + C2 + w*d^2)`
    k2: S,
    /// `A1 + A3 + C2 + w*d^2`
    k3: S,
    /// `w*d*g`
    w_d_g: S,
    /// `C3 + B2 - (A3 + C2 + w*d^2)`
    k4: S,
    /// `A3 + A2 + w*d^2 - (B2 - (A3 + C2 + w*d^2)) - (C3 + A3 + A2 + w*d^2 + B2 - (A3 + C2
    /// + w*d^2))`
    k5: S,
    /// `0.5*A1`
    half_A1: S,
    /// `0.5*w*d^2`
    half_w_d_squared: S,
    /// `B2 - C2 - A3 + C3 - w*d^2`
    k6: S,
    /// `2*(B2 - C2 - A3 + C3 - w*d^2)`
    k7: S,
    /// `-w*d*g`
    minus_w_d_g: S,
    /// `-C3`
    minus_C3: S,
    /// `C3 + A3 + A2 + w*d^2 + B2 - (A3 + C2 + w*d^2) - (A3 + A2 + w*d^2 - (B2 - (A3 + C2
    /// + w*d^2)))`
    k8: S,
    /// `-1/(A3 + A2 + w*d^2)`
    k9: S,
    /// Why these parameters leave the machine without accelerations, if they do.
    singular: Option<::lagrangian::emitted::Singular>,
}

/// A pivot of an elimination that is not above this share of its diagonal element may be rounding
/// errors alone.
const PIVOTS: ::lagrangian::emitted::Pivots = ::lagrangian::emitted::Pivots::new(3, 3);

/// Mass matrix `M`.
///
/// ```text
/// M[alpha, alpha] = (B2 + C3)*sin(beta)^2 + (C2 + A3 + w*d^2)*cos(beta)^2 + A1
/// M[beta, beta] = A2 + A3 + w*d^2
/// M[gamma, alpha] = C3*sin(beta)
/// M[gamma, gamma] = C3
/// ```
pub fn mass_matrix<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 3]) -> [[S; 3]; 3] {
    let beta = q[1];
    let sin_beta = beta.sin();
    let m11 = sin_beta * (sin_beta * p.k4) + p.k3;
    let zero = S::ZERO;
    let m31 = sin_beta * p.C3;
    [[m11, zero, m31], [zero, p.k1, zero], [m31, zero, p.C3]]
}

/// Bias `h`: velocity products and explicit time in the inertia forces.
///
/// ```text
/// h[alpha] = 2*(B2 - C2 - A3 + C3 - w*d^2)*sin(beta)*cos(beta)*der(alpha)*der(beta)
///     + C3*cos(beta)*der(beta)*der(gamma)
/// h[beta] = -(B2 - C2 - A3 + C3 - w*d^2)*sin(beta)*cos(beta)*der(alpha)^2
///     - C3*cos(beta)*der(alpha)*der(gamma)
/// h[gamma] = C3*cos(beta)*der(alpha)*der(beta)
/// ```
pub fn bias<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 3], v: &[S; 3]) -> [S; 3] {
    let beta = q[1];
    let alpha_dot = v[0];
    let beta_dot = v[1];
    let gamma_dot = v[2];
    let (sin_beta, cos_beta) = beta.sin_cos();
    let t0 = gamma_dot * p.C3;
    let t1 = sin_beta * alpha_dot;
    let t2 = cos_beta * alpha_dot;
    let h_alpha = (t0 + t1 * p.k7) * (cos_beta * beta_dot);
    let h_beta = -(t2 * (t0 + t1 * p.k6));
    let h_gamma = t2 * (beta_dot * p.C3);
    [h_alpha, h_beta, h_gamma]
}

/// Applied generalized forces `Q`.
///
/// ```text
/// Q[beta] = -w*d*g*cos(beta)
/// ```
pub fn applied<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 3]) -> [S; 3] {
    let beta = q[1];
    let cos_beta = beta.cos();
    let zero = S::ZERO;
    let q_beta = p.minus_w_d_g * cos_beta;
    [zero, q_beta, zero]
}

/// Right-hand side `f = Q - h` of `M a = f`.
pub fn forces<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 3], v: &[S; 3]) -> [S; 3] {
    let beta = q[1];
    let alpha_dot = v[0];
    let beta_dot = v[1];
    let gamma_dot = v[2];
    let (sin_beta, cos_beta) = beta.sin_cos();
    let t0 = cos_beta * alpha_dot;
    let t1 = sin_beta * alpha_dot;
    let t2 = beta_dot * t0;
    let t3 = (t1 + gamma_dot) * p.C3;
    let f_alpha = t2 * (sin_beta * p.k5) - t3 * (cos_beta * beta_dot);
    let f_beta = t3 * t0 - (cos_beta * p.w_d_g - t0 * (t1 * p.k2));
    let f_gamma = t2 * p.minus_C3;
    [f_alpha, f_beta, f_gamma]
}

::lagrangian::emitted::fast_function! {
    /// Accelerations `a`, the solution of `M a = f` eliminated along the machine, pivots ahead.
    ///
    /// A pivot that vanishes is an error.
    ///
    /// Velocities are eliminated from the tips of the machine to the ground, with the inertia `G`
    /// and the loads `g` that remain on them. Comments name these numbers where they are computed,
    /// up to signs and factors that depend on parameters alone, for coordinate `i` or the velocity
    /// in its place; `k` are the velocities that follow:
    ///
    /// ```text
    /// d[i] = G[i, i], l[i] = G[i, k]/d[i], z[i] = g[i]/d[i]
    /// a[i] = z[i] - sum l[i]*a[k]
    /// ```
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
    let beta = n(q[1]);
    let alpha_dot = n(v[0]);
    let beta_dot = n(v[1]);
    let gamma_dot = n(v[2]);
    let (sin_beta, cos_beta) = beta.sin_cos();
    let t0 = gamma_dot * n(p.C3);
    let t1 = sin_beta * sin_beta;
    let t2 = sin_beta * alpha_dot;
    let t3 = cos_beta * beta_dot;
    // Eliminates alpha: inertia d[alpha].
    let t4 = t1.mul_add(n(p.k2), n(p.k3));
    let t5 = alpha_dot.neg_mul_add(t0, n(p.w_d_g));
    let t6 = t2.neg_mul_add(alpha_dot * n(p.k4), t5);
    let t7 = N::ONE / t4 * (t2.mul_add(n(p.k8), t0) * t3);
    let alpha_ddot = -t7;
    let beta_ddot = t6 * (cos_beta * n(p.k9));
    let gamma_ddot = sin_beta.mul_sub(t7, alpha_dot * t3);
    let t8 = t1.mul_add(n(p.k4), n(p.k3));
    let sound = PIVOTS.hold(t4, t8) & gamma_ddot.is_finite();
    if !sound {
        let pivots = [(0, t4, t8)];
        PIVOTS.check(pivots)?;
    }
    let accelerations = [alpha_ddot.store(), beta_ddot.store(), gamma_ddot.store()];
    Ok(accelerations)
}

/// Kinetic energy `T`, in J.
///
/// ```text
/// T = 1/2*B2*sin(beta)^2*der(alpha)^2 + 1/2*(C2 + A3 + w*d^2)*cos(beta)^2*der(alpha)^2
///     + 1/2*A1*der(alpha)^2 + 1/2*(A2 + A3 + w*d^2)*der(beta)^2
///     + 1/2*C3*(sin(beta)*der(alpha) + der(gamma))^2
/// ```
pub fn kinetic_energy<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 3],
    v: &[S; 3],
) -> S {
    let beta = q[1];
    let alpha_dot = v[0];
    let beta_dot = v[1];
    let gamma_dot = v[2];
    let (sin_beta, cos_beta) = beta.sin_cos();
    let t0 = alpha_dot * alpha_dot;
    let t1 = beta_dot * beta_dot;
    let t2 = sin_beta * alpha_dot + gamma_dot;
    let t3 = cos_beta * cos_beta;
    let t4 = t3 * t0 + t1;
    let t5 = t0 * (t3 * p.C2 + sin_beta * (sin_beta * p.B2)) + t1 * p.A2;
    let t6 = (t4 * p.A3 + t2 * (t2 * p.C3) + t5) * S::from_f64(0.5);
    t6 + (t4 * p.half_w_d_squared + t0 * p.half_A1)
}

/// Potential energy `V`, in J.
///
/// ```text
/// V = w*d*g*sin(beta)
/// ```
pub fn potential_energy<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 3]) -> S {
    let beta = q[1];
    let sin_beta = beta.sin();
    p.w_d_g * sin_beta
}

/// Angular momentum of the rotor about its axis, H: conserved. Unit: `J*s`.
///
/// ```text
/// rotor_momentum = C3*(sin(beta)*der(alpha) + der(gamma))
/// ```
pub fn output_rotor_momentum<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 3],
    v: &[S; 3],
) -> S {
    let beta = q[1];
    let alpha_dot = v[0];
    let gamma_dot = v[2];
    let sin_beta = beta.sin();
    (sin_beta * alpha_dot + gamma_dot) * p.C3
}

/// Angular momentum of everything about the vertical: conserved. Unit: `J*s`.
///
/// ```text
/// vertical_momentum = (B2 + C3)*sin(beta)^2*der(alpha) + (C2 + A3 + w*d^2)*cos(beta)^2*der(alpha)
///     + A1*der(alpha) + C3*sin(beta)*der(gamma)
/// ```
pub fn output_vertical_momentum<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 3],
    v: &[S; 3],
) -> S {
    let beta = q[1];
    let alpha_dot = v[0];
    let gamma_dot = v[2];
    let (sin_beta, cos_beta) = beta.sin_cos();
    let t0 = cos_beta * (cos_beta * p.k0) + (sin_beta * (sin_beta * p.B2) + p.A1);
    (sin_beta * alpha_dot + gamma_dot) * (sin_beta * p.C3) + alpha_dot * t0
}

/// Everything that the description asks to observe.
pub fn outputs<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 3],
    v: &[S; 3],
) -> Outputs<S> {
    Outputs {
        rotor_momentum: output_rotor_momentum(p, q, v),
        vertical_momentum: output_vertical_momentum(p, q, v),
    }
}

::lagrangian::emitted::implement! {
    machine GyroscopeInGimbals "GyroscopeInGimbals" over S, R;
    parameters { A1, A2, B2, C2, A3, C3, m1, m2, m3, w, d, g } [
        A1: "A1" "kg*m^2" = 0.002;
        A2: "A2" "kg*m^2" = 0.0012;
        B2: "B2" "kg*m^2" = 0.0008;
        C2: "C2" "kg*m^2" = 0.0008;
        A3: "A3" "kg*m^2" = 0.0015;
        C3: "C3" "kg*m^2" = 0.0025;
        m1: "m1" "kg" = 0.5;
        m2: "m2" "kg" = 0.4;
        m3: "m3" "kg" = 1.2;
        w: "w" "kg" = 0.05;
        d: "d" "m" = 0.12;
        g: "g" "m/s^2" = 9.81;
    ]
    coordinates 3 Coordinates { alpha, beta, gamma } [
        alpha: "alpha" "rad";
        beta: "beta" "rad";
        gamma: "gamma" "rad";
    ]
    inputs Inputs {} [], defined here
    outputs Outputs { rotor_momentum, vertical_momentum } [
        rotor_momentum: "rotor_momentum" "J*s";
        vertical_momentum: "vertical_momentum" "J*s";
    ]
    prepared Prepared {
        A1, A2, B2, C2, A3, C3, k0, k1, k2, k3, w_d_g, k4, k5, half_A1, half_w_d_squared, k6, k7,
        minus_w_d_g, minus_C3, k8, k9,
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
    }
    absent [MAY_BE_CONSTRAINED MAY_SLIDE MAY_COLLIDE]
    intervals []
    lanes [N]
    numbers [yes]
}
