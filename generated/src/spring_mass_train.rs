// @generated from machines/spring_mass_train.machine by `cargo xtask generate`; edits are lost.

//! A train of N equal cars on a level track, coupled by springs; the last one is the engine.
//!
//! The coordinates say how far each car is from its place in a train at rest, so the machine is
//! linear. Free at both ends it moves in the modes cos(pi j (i - 1/2)/N), where i is the car
//! and j = 0 … N-1 the mode, with the frequencies 2 sqrt(k/m) sin(pi j/(2 N)): the first of
//! them, 0, is the ride of the train as a whole, whose momentum only the engine changes. Long
//! waves all travel with d sqrt(k/m), and none has a frequency above 2 sqrt(k/m)
//! (L. Brillouin, Wave Propagation in Periodic Structures, 1946). A constant pull F stretches
//! the coupling in front of car i by (i/N) F/k in the mean: it draws i of the N cars.
//!
//! 8 coordinates, 3 parameters, 1 input, 1 output. Arithmetic of one call:
//!
//! | function | mul | add | div | sin cos | other | temporaries |
//! | --- | --: | --: | --: | --: | --: | --: |
//! | `prepare` | 3 | 2 | 1 | 0 | 0 | 6 |
//! | `applied` | 8 | 14 | 0 | 0 | 0 | 22 |
//! | `forces` | 8 | 14 | 0 | 0 | 0 | 22 |
//! | `accelerations` | 9 | 14 | 0 | 0 | 0 | 23 |
//! | `kinetic_energy` | 9 | 7 | 0 | 0 | 0 | 16 |
//! | `potential_energy` | 8 | 13 | 0 | 0 | 0 | 21 |
//! | `work_rate` | 1 | 0 | 0 | 0 | 0 | 1 |
//! | `output_drawbar` | 1 | 1 | 0 | 0 | 0 | 2 |
//! | `assumption_0` | 0 | 2 | 0 | 0 | 0 | 2 |
//! | `assumption_1` | 0 | 2 | 0 | 0 | 0 | 2 |
//! | `assumption_2` | 0 | 2 | 0 | 0 | 0 | 2 |
//! | `assumption_3` | 0 | 2 | 0 | 0 | 0 | 2 |
//! | `assumption_4` | 0 | 2 | 0 | 0 | 0 | 2 |
//! | `assumption_5` | 0 | 2 | 0 | 0 | 0 | 2 |
//! | `assumption_6` | 0 | 2 | 0 | 0 | 0 | 2 |
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

/// A train of N equal cars on a level track, coupled by springs; the last one is the engine.
///
/// The coordinates say how far each car is from its place in a train at rest, so the machine is
/// linear. Free at both ends it moves in the modes cos(pi j (i - 1/2)/N), where i is the car
/// and j = 0 … N-1 the mode, with the frequencies 2 sqrt(k/m) sin(pi j/(2 N)): the first of
/// them, 0, is the ride of the train as a whole, whose momentum only the engine changes. Long
/// waves all travel with d sqrt(k/m), and none has a frequency above 2 sqrt(k/m)
/// (L. Brillouin, Wave Propagation in Periodic Structures, 1946). A constant pull F stretches
/// the coupling in front of car i by (i/N) F/k in the mean: it draws i of the N cars.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpringMassTrain<S = f64> {
    /// Mass of a car. Unit: `kg`. Default: 20.
    pub m: S,
    /// Stiffness of a coupling. Unit: `N/m`. Default: 8000.
    pub k: S,
    /// Distance of two cars at rest. Unit: `m`. Default: 0.5.
    pub d: S,
}

impl<S: ::lagrangian::emitted::Scalar> SpringMassTrain<S> {
    /// Computes what depends on the parameters alone, once.
    pub fn prepare(&self) -> Prepared<S> {
        let inverse_m = S::ONE / self.m;
        let k_over_m = self.k * inverse_m;
        let half_k = self.k * S::from_f64(0.5);
        let half_m = self.m * S::from_f64(0.5);
        let minus_k = -self.k;
        let minus_k_over_m = -k_over_m;
        let pivots = [
            (7, self.m, self.m),
            (6, self.m, self.m),
            (5, self.m, self.m),
            (4, self.m, self.m),
            (3, self.m, self.m),
            (2, self.m, self.m),
            (0, self.m, self.m),
            (1, self.m, self.m),
        ];
        Prepared {
            m: self.m,
            k: self.k,
            d: self.d,
            half_k,
            half_m,
            minus_k,
            inverse_m,
            k_over_m,
            minus_k_over_m,
            singular: PIVOTS.vanished(pivots),
        }
    }

    /// The start values of the description, at rest and `t = 0`.
    pub fn start(&self) -> ::lagrangian::emitted::State<Coordinates<S>> {
        let zero = S::ZERO;
        let q = [zero, zero, zero, zero, zero, zero, zero, zero];
        let v = [S::ZERO; 8];
        ::lagrangian::emitted::State {
            t: 0.0,
            q: Coordinates::from_array(q),
            v: Coordinates::from_array(v),
        }
    }
}

/// The coordinates of [`SpringMassTrain`], or their rates, by name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coordinates<S = f64> {
    /// Way of each car from its place. Unit: `m`. Members: `u[1]` to `u[8]`.
    pub u: [S; 8],
}

/// What can be set while a [`SpringMassTrain`] runs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Inputs<S = f64> {
    /// Pull of the engine. Unit: `N`. Default: 200.
    pub pull: S,
}

/// What can be observed of a [`SpringMassTrain`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outputs<S = f64> {
    /// Tension of the coupling behind the engine. Unit: `N`.
    pub drawbar: S,
}

/// The parameters of a [`SpringMassTrain`], with the work done that depends on them alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prepared<S = f64> {
    /// `m`
    m: S,
    /// `k`
    k: S,
    /// `d`
    d: S,
    /// `0.5*k`
    half_k: S,
    /// `0.5*m`
    half_m: S,
    /// `-k`
    minus_k: S,
    /// `1/m`
    inverse_m: S,
    /// `k/m`
    k_over_m: S,
    /// `-k/m`
    minus_k_over_m: S,
    /// Why these parameters leave the machine without accelerations, if they do.
    singular: Option<::lagrangian::emitted::Singular>,
}

/// A pivot of an elimination that is not above this share of its diagonal element may be rounding
/// errors alone.
const PIVOTS: ::lagrangian::emitted::Pivots = ::lagrangian::emitted::Pivots::new(8, 8);

/// Mass matrix `M`.
///
/// ```text
/// M[u[1], u[1]] = m
/// M[u[2], u[2]] = m
/// M[u[3], u[3]] = m
/// M[u[4], u[4]] = m
/// M[u[5], u[5]] = m
/// M[u[6], u[6]] = m
/// M[u[7], u[7]] = m
/// M[u[8], u[8]] = m
/// ```
pub fn mass_matrix<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>) -> [[S; 8]; 8] {
    let zero = S::ZERO;
    [
        [p.m, zero, zero, zero, zero, zero, zero, zero],
        [zero, p.m, zero, zero, zero, zero, zero, zero],
        [zero, zero, p.m, zero, zero, zero, zero, zero],
        [zero, zero, zero, p.m, zero, zero, zero, zero],
        [zero, zero, zero, zero, p.m, zero, zero, zero],
        [zero, zero, zero, zero, zero, p.m, zero, zero],
        [zero, zero, zero, zero, zero, zero, p.m, zero],
        [zero, zero, zero, zero, zero, zero, zero, p.m],
    ]
}

/// Applied generalized forces `Q`.
///
/// ```text
/// Q[u[1]] = k*(u[2] - u[1])
/// Q[u[2]] = k*u[1] - 2*k*u[2] + k*u[3]
/// Q[u[3]] = k*u[2] - 2*k*u[3] + k*u[4]
/// Q[u[4]] = k*u[3] - 2*k*u[4] + k*u[5]
/// Q[u[5]] = k*u[4] - 2*k*u[5] + k*u[6]
/// Q[u[6]] = k*u[5] - 2*k*u[6] + k*u[7]
/// Q[u[7]] = k*u[6] - 2*k*u[7] + k*u[8]
/// Q[u[8]] = pull - k*(u[8] - u[7])
/// ```
pub fn applied<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 8],
    u: &Inputs<S>,
) -> [S; 8] {
    let u_1 = q[0];
    let u_2 = q[1];
    let u_3 = q[2];
    let u_4 = q[3];
    let u_5 = q[4];
    let u_6 = q[5];
    let u_7 = q[6];
    let u_8 = q[7];
    let t0 = u_1 - u_2;
    let t1 = u_2 - u_3;
    let t2 = u_3 - u_4;
    let t3 = u_4 - u_5;
    let t4 = u_5 - u_6;
    let t5 = u_6 - u_7;
    let t6 = u_7 - u_8;
    let q_u_1 = p.minus_k * t0;
    let q_u_2 = p.k * (t0 - t1);
    let q_u_3 = p.k * (t1 - t2);
    let q_u_4 = p.k * (t2 - t3);
    let q_u_5 = p.k * (t3 - t4);
    let q_u_6 = p.k * (t4 - t5);
    let q_u_7 = p.k * (t5 - t6);
    let q_u_8 = p.k * t6 + u.pull;
    [q_u_1, q_u_2, q_u_3, q_u_4, q_u_5, q_u_6, q_u_7, q_u_8]
}

/// Right-hand side `f = Q - h` of `M a = f`.
pub fn forces<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 8],
    u: &Inputs<S>,
) -> [S; 8] {
    let u_1 = q[0];
    let u_2 = q[1];
    let u_3 = q[2];
    let u_4 = q[3];
    let u_5 = q[4];
    let u_6 = q[5];
    let u_7 = q[6];
    let u_8 = q[7];
    let t0 = u_1 - u_2;
    let t1 = u_2 - u_3;
    let t2 = u_3 - u_4;
    let t3 = u_4 - u_5;
    let t4 = u_5 - u_6;
    let t5 = u_6 - u_7;
    let t6 = u_7 - u_8;
    let f_u_1 = p.minus_k * t0;
    let f_u_2 = p.k * (t0 - t1);
    let f_u_3 = p.k * (t1 - t2);
    let f_u_4 = p.k * (t2 - t3);
    let f_u_5 = p.k * (t3 - t4);
    let f_u_6 = p.k * (t4 - t5);
    let f_u_7 = p.k * (t5 - t6);
    let f_u_8 = p.k * t6 + u.pull;
    [f_u_1, f_u_2, f_u_3, f_u_4, f_u_5, f_u_6, f_u_7, f_u_8]
}

::lagrangian::emitted::fast_function! {
    /// Accelerations `a`, the solution of `M a = f` eliminated along the machine.
    ///
    /// A pivot that vanishes is an error.
    pub fn accelerations<'a, S>(Accelerations {
        p: &'a Prepared<S>,
        q: &'a [S; 8],
        u: &'a Inputs<S>,
    }) -> Result<[S; 8], ::lagrangian::emitted::Singular> = accelerations_in;
}

#[inline(always)]
fn accelerations_in<S: Copy, N: ::lagrangian::emitted::Scalar<Stored = S>>(
    call: Accelerations<'_, S>,
) -> Result<[S; 8], ::lagrangian::emitted::Singular> {
    let Accelerations { p, q, u } = call;
    let n = N::load;
    if let Some(singular) = p.singular {
        return Err(singular);
    }
    let u_1 = n(q[0]);
    let u_2 = n(q[1]);
    let u_3 = n(q[2]);
    let u_4 = n(q[3]);
    let u_5 = n(q[4]);
    let u_6 = n(q[5]);
    let u_7 = n(q[6]);
    let u_8 = n(q[7]);
    let t0 = u_1 - u_2;
    let t1 = u_2 - u_3;
    let t2 = u_3 - u_4;
    let t3 = u_4 - u_5;
    let t4 = u_5 - u_6;
    let t5 = u_6 - u_7;
    let t6 = u_7 - u_8;
    let u_1_ddot = n(p.minus_k_over_m) * t0;
    let u_2_ddot = n(p.k_over_m) * (t0 - t1);
    let u_3_ddot = n(p.k_over_m) * (t1 - t2);
    let u_4_ddot = n(p.k_over_m) * (t2 - t3);
    let u_5_ddot = n(p.k_over_m) * (t3 - t4);
    let u_6_ddot = n(p.k_over_m) * (t4 - t5);
    let u_7_ddot = n(p.k_over_m) * (t5 - t6);
    let u_8_ddot = n(p.inverse_m) * t6.mul_add(n(p.k), n(u.pull));
    let accelerations = [
        u_1_ddot.store(),
        u_2_ddot.store(),
        u_3_ddot.store(),
        u_4_ddot.store(),
        u_5_ddot.store(),
        u_6_ddot.store(),
        u_7_ddot.store(),
        u_8_ddot.store(),
    ];
    Ok(accelerations)
}

/// Kinetic energy `T`, in J.
///
/// ```text
/// T = 1/2*m*der(u[1])^2 + 1/2*m*der(u[2])^2 + 1/2*m*der(u[3])^2 + 1/2*m*der(u[4])^2
///     + 1/2*m*der(u[5])^2 + 1/2*m*der(u[6])^2 + 1/2*m*der(u[7])^2 + 1/2*m*der(u[8])^2
/// ```
pub fn kinetic_energy<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, v: &[S; 8]) -> S {
    let u_1_dot = v[0];
    let u_2_dot = v[1];
    let u_3_dot = v[2];
    let u_4_dot = v[3];
    let u_5_dot = v[4];
    let u_6_dot = v[5];
    let u_7_dot = v[6];
    let u_8_dot = v[7];
    let t0 = u_4_dot * u_4_dot + u_3_dot * u_3_dot;
    let t1 = u_8_dot * u_8_dot + u_7_dot * u_7_dot;
    let t2 = u_6_dot * u_6_dot + u_5_dot * u_5_dot + t1;
    (u_2_dot * u_2_dot + u_1_dot * u_1_dot + t0 + t2) * p.half_m
}

/// Potential energy `V`, in J.
///
/// ```text
/// V = 1/2*k*(u[2] - u[1])^2 + 1/2*k*(u[3] - u[2])^2 + 1/2*k*(u[4] - u[3])^2
///     + 1/2*k*(u[5] - u[4])^2 + 1/2*k*(u[6] - u[5])^2 + 1/2*k*(u[7] - u[6])^2
///     + 1/2*k*(u[8] - u[7])^2
/// ```
pub fn potential_energy<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 8]) -> S {
    let u_1 = q[0];
    let u_2 = q[1];
    let u_3 = q[2];
    let u_4 = q[3];
    let u_5 = q[4];
    let u_6 = q[5];
    let u_7 = q[6];
    let u_8 = q[7];
    let t0 = u_3 - u_4;
    let t1 = u_5 - u_6;
    let t2 = u_1 - u_2;
    let t3 = u_4 - u_5;
    let t4 = u_6 - u_7;
    let t5 = u_2 - u_3;
    let t6 = u_7 - u_8;
    let t7 = t3 * t3 + t0 * t0 + (t4 * t4 + t1 * t1);
    (t6 * t6 + (t5 * t5 + t2 * t2) + t7) * p.half_k
}

/// Power `P` supplied by drives, forces and inputs, in W.
///
/// ```text
/// P = der(u[8])*pull
/// ```
pub fn work_rate<S: ::lagrangian::emitted::Scalar>(v: &[S; 8], u: &Inputs<S>) -> S {
    let u_8_dot = v[7];
    u.pull * u_8_dot
}

/// Tension of the coupling behind the engine. Unit: `N`.
///
/// ```text
/// drawbar = k*(u[8] - u[7])
/// ```
pub fn output_drawbar<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 8]) -> S {
    let u_7 = q[6];
    let u_8 = q[7];
    p.minus_k * (u_7 - u_8)
}

/// By how much `d + u[2] - u[1] > 0` holds.
pub fn assumption_0<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 8]) -> S {
    let u_1 = q[0];
    let u_2 = q[1];
    u_2 + p.d - u_1
}

/// By how much `d + u[3] - u[2] > 0` holds.
pub fn assumption_1<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 8]) -> S {
    let u_2 = q[1];
    let u_3 = q[2];
    u_3 + p.d - u_2
}

/// By how much `d + u[4] - u[3] > 0` holds.
pub fn assumption_2<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 8]) -> S {
    let u_3 = q[2];
    let u_4 = q[3];
    u_4 + p.d - u_3
}

/// By how much `d + u[5] - u[4] > 0` holds.
pub fn assumption_3<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 8]) -> S {
    let u_4 = q[3];
    let u_5 = q[4];
    u_5 + p.d - u_4
}

/// By how much `d + u[6] - u[5] > 0` holds.
pub fn assumption_4<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 8]) -> S {
    let u_5 = q[4];
    let u_6 = q[5];
    u_6 + p.d - u_5
}

/// By how much `d + u[7] - u[6] > 0` holds.
pub fn assumption_5<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 8]) -> S {
    let u_6 = q[5];
    let u_7 = q[6];
    u_7 + p.d - u_6
}

/// By how much `d + u[8] - u[7] > 0` holds.
pub fn assumption_6<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 8]) -> S {
    let u_7 = q[6];
    let u_8 = q[7];
    u_8 + p.d - u_7
}

/// Everything that the description asks to observe.
pub fn outputs<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 8]) -> Outputs<S> {
    Outputs {
        drawbar: output_drawbar(p, q),
    }
}

::lagrangian::emitted::implement! {
    machine SpringMassTrain "SpringMassTrain" over S, R;
    parameters { m, k, d } [
        m: "m" "kg" = 20.0;
        k: "k" "N/m" = 8000.0;
        d: "d" "m" = 0.5;
    ]
    coordinates 8 Coordinates { u: [u_1, u_2, u_3, u_4, u_5, u_6, u_7, u_8] } [
        u_1: "u[1]" "m";
        u_2: "u[2]" "m";
        u_3: "u[3]" "m";
        u_4: "u[4]" "m";
        u_5: "u[5]" "m";
        u_6: "u[6]" "m";
        u_7: "u[7]" "m";
        u_8: "u[8]" "m";
    ]
    inputs Inputs { pull } [
        pull: "pull" "N" = 200.0;
    ] over S
    outputs Outputs { drawbar } [
        drawbar: "drawbar" "N";
    ]
    prepared Prepared { m, k, d, half_k, half_m, minus_k, inverse_m, k_over_m, minus_k_over_m }
    singular singular
    accelerations { (p, t, q, v, u) Accelerations { p, q, u } }
    system {
        matrix mass_matrix(p, t, q) = mass_matrix(p);
        vector bias(p, t, q, v);
        vector applied(p, t, q, v, u) = applied(p, q, u);
        vector forces(p, t, q, v, u) = forces(p, q, u);
        number kinetic_energy(p, t, q, v) = kinetic_energy(p, v);
        number potential_energy(p, t, q, u) = potential_energy(p, q);
        number dissipation(p, t, q, v, u);
        number work_rate(p, t, q, v, a, u) = work_rate(v, u);
        number dissipation_rate(p, t, q, v, u);
        outputs outputs(p, t, q, v, a, u) = outputs(p, q);
        facts assumptions(p, t, q, v, u) = [
            ("d + u[2] - u[1] > 0", true, assumption_0(p, q)),
            ("d + u[3] - u[2] > 0", true, assumption_1(p, q)),
            ("d + u[4] - u[3] > 0", true, assumption_2(p, q)),
            ("d + u[5] - u[4] > 0", true, assumption_3(p, q)),
            ("d + u[6] - u[5] > 0", true, assumption_4(p, q)),
            ("d + u[7] - u[6] > 0", true, assumption_5(p, q)),
            ("d + u[8] - u[7] > 0", true, assumption_6(p, q)),
        ];
    }
    absent [MAY_BE_CONSTRAINED MAY_SLIDE MAY_COLLIDE]
    intervals []
    lanes [N]
    numbers [yes]
}
