// @generated from machines/dc_motor.machine by `cargo xtask generate`; edits are lost.

//! A motor with a permanent magnet that turns a flywheel: a voltage drives a current through its
//! winding, the
//! current makes a torque, and turning makes a voltage against it.
//!
//! 2 coordinates, 6 parameters, 1 input, 1 output. Arithmetic of one call:
//!
//! | function | mul | add | div | sin cos | other | temporaries |
//! | --- | --: | --: | --: | --: | --: | --: |
//! | `prepare` | 3 | 1 | 2 | 0 | 0 | 6 |
//! | `applied` | 5 | 3 | 0 | 0 | 0 | 8 |
//! | `forces` | 5 | 3 | 0 | 0 | 0 | 8 |
//! | `accelerations` | 6 | 3 | 0 | 0 | 0 | 9 |
//! | `kinetic_energy` | 2 | 0 | 0 | 0 | 0 | 2 |
//! | `state_energy` | 2 | 0 | 0 | 0 | 0 | 2 |
//! | `dissipation` | 2 | 0 | 0 | 0 | 0 | 2 |
//! | `work_rate` | 5 | 4 | 0 | 0 | 0 | 9 |
//! | `dissipation_rate` | 4 | 1 | 0 | 0 | 0 | 5 |
//! | `output_supplied` | 1 | 0 | 0 | 0 | 0 | 1 |
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

/// A motor with a permanent magnet that turns a flywheel: a voltage drives a current through its
/// winding, the
/// current makes a torque, and turning makes a voltage against it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DcMotor<S = f64> {
    /// Moment of inertia of the rotor with the flywheel. Unit: `kg*m^2`. Default: 0.0002.
    pub J: S,
    /// Mass of the rotor. Unit: `kg`. Default: 0.4.
    pub m: S,
    /// Damping in the bearings. Unit: `N*m*s`. Default: 0.0001.
    pub b: S,
    /// Inductance of the winding. Unit: `H`. Default: 0.002.
    pub L: S,
    /// Its resistance. Unit: `ohm`. Default: 0.5.
    pub R: S,
    /// Torque by current, and voltage by rate: in SI units one number. Unit: `N*m/A`.
    /// Default: 0.05.
    pub k: S,
}

impl<S: ::lagrangian::emitted::Scalar> DcMotor<S> {
    /// Computes what depends on the parameters alone, once.
    pub fn prepare(&self) -> Prepared<S> {
        let inverse_L = S::ONE / self.L;
        let half_b = self.b * S::from_f64(0.5);
        let half_L = self.L * S::from_f64(0.5);
        let half_J = self.J * S::from_f64(0.5);
        let minus_inverse_J = -(S::ONE / self.J);
        let one = S::ONE;
        let pivots = [(0, self.J, self.J), (1, one, one)];
        Prepared {
            J: self.J,
            b: self.b,
            R: self.R,
            k: self.k,
            inverse_L,
            half_b,
            half_L,
            half_J,
            minus_inverse_J,
            singular: PIVOTS.vanished(pivots),
        }
    }

    /// The start values of the description, at rest and `t = 0`.
    pub fn start(&self) -> ::lagrangian::emitted::State<Coordinates<S>> {
        let zero = S::ZERO;
        let q = [zero, zero];
        let v = [S::ZERO; 2];
        ::lagrangian::emitted::State {
            t: 0.0,
            q: Coordinates::from_array(q),
            v: Coordinates::from_array(v),
        }
    }
}

/// The coordinates of [`DcMotor`], or their rates, by name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coordinates<S = f64> {
    /// Angle of the rotor. Unit: `rad`.
    pub phi: S,
    /// Current in the winding. Among rates the state `i`, in `A`; among coordinates its integral
    /// over time, on which nothing depends.
    pub i: S,
}

/// What can be set while a [`DcMotor`] runs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Inputs<S = f64> {
    /// Voltage at the terminals. Unit: `V`. Default: 12.
    pub U: S,
}

/// What can be observed of a [`DcMotor`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outputs<S = f64> {
    /// Power at the terminals. Unit: `W`.
    pub supplied: S,
}

/// The parameters of a [`DcMotor`], with the work done that depends on them alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prepared<S = f64> {
    /// `J`
    J: S,
    /// `b`
    b: S,
    /// `R`
    R: S,
    /// `k`
    k: S,
    /// `1/L`
    inverse_L: S,
    /// `0.5*b`
    half_b: S,
    /// `0.5*L`
    half_L: S,
    /// `0.5*J`
    half_J: S,
    /// `-1/J`
    minus_inverse_J: S,
    /// Why these parameters leave the machine without accelerations, if they do.
    singular: Option<::lagrangian::emitted::Singular>,
}

/// A pivot of an elimination that is not above this share of its diagonal element may be rounding
/// errors alone.
const PIVOTS: ::lagrangian::emitted::Pivots = ::lagrangian::emitted::Pivots::new(2, 2);

/// Mass matrix `M`.
///
/// ```text
/// M[phi, phi] = J
/// M[integral(i), integral(i)] = 1
/// ```
pub fn mass_matrix<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>) -> [[S; 2]; 2] {
    let zero = S::ZERO;
    let one = S::ONE;
    [[p.J, zero], [zero, one]]
}

/// Applied generalized forces `Q`.
///
/// ```text
/// Q[phi] = k*i - b*der(phi)
/// Q[integral(i)] = (U - k*der(phi) - R*i)/L
/// ```
pub fn applied<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    v: &[S; 2],
    u: &Inputs<S>,
) -> [S; 2] {
    let phi_dot = v[0];
    let i_dot = v[1];
    let q_phi = i_dot * p.k - phi_dot * p.b;
    let q_i = p.inverse_L * (u.U - p.k * phi_dot - i_dot * p.R);
    [q_phi, q_i]
}

/// Right-hand side `f = Q - h` of `M a = f`.
pub fn forces<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    v: &[S; 2],
    u: &Inputs<S>,
) -> [S; 2] {
    let phi_dot = v[0];
    let i_dot = v[1];
    let f_phi = i_dot * p.k - phi_dot * p.b;
    let f_i = p.inverse_L * (u.U - p.k * phi_dot - i_dot * p.R);
    [f_phi, f_i]
}

::lagrangian::emitted::fast_function! {
    /// Accelerations `a`, the solution of `M a = f` eliminated along the machine.
    ///
    /// A pivot that vanishes is an error.
    pub fn accelerations<'a, S>(Accelerations {
        p: &'a Prepared<S>,
        v: &'a [S; 2],
        u: &'a Inputs<S>,
    }) -> Result<[S; 2], ::lagrangian::emitted::Singular> = accelerations_in;
}

#[inline(always)]
fn accelerations_in<S: Copy, N: ::lagrangian::emitted::Scalar<Stored = S>>(
    call: Accelerations<'_, S>,
) -> Result<[S; 2], ::lagrangian::emitted::Singular> {
    let Accelerations { p, v, u } = call;
    let n = N::load;
    if let Some(singular) = p.singular {
        return Err(singular);
    }
    let phi_dot = n(v[0]);
    let i_dot = n(v[1]);
    let t0 = n(p.k).neg_mul_add(phi_dot, n(u.U));
    let t1 = phi_dot.mul_sub(n(p.b), i_dot * n(p.k));
    let phi_ddot = n(p.minus_inverse_J) * t1;
    let i_ddot = n(p.inverse_L) * i_dot.neg_mul_add(n(p.R), t0);
    let accelerations = [phi_ddot.store(), i_ddot.store()];
    Ok(accelerations)
}

/// Kinetic energy `T`, in J.
///
/// ```text
/// T = 1/2*J*der(phi)^2
/// ```
pub fn kinetic_energy<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, v: &[S; 2]) -> S {
    let phi_dot = v[0];
    phi_dot * (phi_dot * p.half_J)
}

/// Energy `E` that states of first order store, in J.
///
/// ```text
/// E = 1/2*L*i^2
/// ```
pub fn state_energy<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, v: &[S; 2]) -> S {
    let i_dot = v[1];
    i_dot * (i_dot * p.half_L)
}

/// Dissipation function `D`, in W.
///
/// ```text
/// D = 1/2*b*der(phi)^2
/// ```
pub fn dissipation<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, v: &[S; 2]) -> S {
    let phi_dot = v[0];
    phi_dot * (phi_dot * p.half_b)
}

/// Power `P` supplied by drives, forces and inputs, in W.
///
/// ```text
/// P = i*U
/// ```
pub fn work_rate<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    v: &[S; 2],
    u: &Inputs<S>,
) -> S {
    let phi_dot = v[0];
    let i_dot = v[1];
    let t0 = phi_dot * p.k;
    let t1 = i_dot * p.R;
    t0 * i_dot + (i_dot * t1 + i_dot * (u.U - t0 - t1))
}

/// Power `R` dissipated by dampers, in W.
///
/// ```text
/// R = b*der(phi)^2 + R*i^2
/// ```
pub fn dissipation_rate<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, v: &[S; 2]) -> S {
    let phi_dot = v[0];
    let i_dot = v[1];
    phi_dot * (phi_dot * p.b) + i_dot * (i_dot * p.R)
}

/// Power at the terminals. Unit: `W`.
///
/// ```text
/// supplied = i*U
/// ```
pub fn output_supplied<S: ::lagrangian::emitted::Scalar>(v: &[S; 2], u: &Inputs<S>) -> S {
    let i_dot = v[1];
    u.U * i_dot
}

/// Everything that the description asks to observe.
pub fn outputs<S: ::lagrangian::emitted::Scalar>(v: &[S; 2], u: &Inputs<S>) -> Outputs<S> {
    Outputs {
        supplied: output_supplied(v, u),
    }
}

::lagrangian::emitted::implement! {
    machine DcMotor "DcMotor" over S, R;
    parameters { J, m, b, L, R, k } [
        J: "J" "kg*m^2" = 0.0002;
        m: "m" "kg" = 0.4;
        b: "b" "N*m*s" = 0.0001;
        L: "L" "H" = 0.002;
        R: "R" "ohm" = 0.5;
        k: "k" "N*m/A" = 0.05;
    ]
    coordinates 2 Coordinates { phi, i } [
        phi: "phi" "rad";
        i: "integral(i)" "A*s";
    ]
    inputs Inputs { U } [
        U: "U" "V" = 12.0;
    ] over S
    outputs Outputs { supplied } [
        supplied: "supplied" "W";
    ]
    prepared Prepared { J, b, R, k, inverse_L, half_b, half_L, half_J, minus_inverse_J }
    singular singular
    accelerations { (p, t, q, v, u) Accelerations { p, v, u } }
    system {
        matrix mass_matrix(p, t, q) = mass_matrix(p);
        vector bias(p, t, q, v);
        vector applied(p, t, q, v, u) = applied(p, v, u);
        vector forces(p, t, q, v, u) = forces(p, v, u);
        number kinetic_energy(p, t, q, v) = kinetic_energy(p, v);
        number potential_energy(p, t, q, u);
        number state_energy(p, t, q, v) = state_energy(p, v);
        number dissipation(p, t, q, v, u) = dissipation(p, v);
        number work_rate(p, t, q, v, a, u) = work_rate(p, v, u);
        number dissipation_rate(p, t, q, v, u) = dissipation_rate(p, v);
        outputs outputs(p, t, q, v, a, u) = outputs(v, u);
    }
    absent [MAY_BE_CONSTRAINED MAY_SLIDE MAY_COLLIDE]
    intervals []
    lanes [N]
    numbers [yes]
}
