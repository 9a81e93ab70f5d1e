// @generated from machines/two_joint_arm.machine by `cargo xtask generate`; edits are lost.

//! A robot's arm with two revolute joints in a vertical plane, a motor in each.
//!
//! The first angle is measured from the horizontal, the second from the first link. The
//! equations are every textbook's, M(q) a + C(q, v) v + g(q) = tau (M. W. Spong, S. Hutchinson,
//! M. Vidyasagar, Robot Modeling and Control, 2006, ch. 7). M depends on q2 alone. With
//! the C of Christoffel's symbols dM/dt - 2 C is skew, so that motors put in exactly the power
//! tau . v: the arm is passive. Motors that give tau = M(q) (what is wanted) + C v + g make
//! each joint move as if it were alone: computed torque. Without motors it is a double
//! pendulum.
//!
//! 2 coordinates, 9 parameters, 2 inputs, 3 outputs. Arithmetic of one call:
//!
//! | function | mul | add | div | sin cos | other | temporaries |
//! | --- | --: | --: | --: | --: | --: | --: |
//! | `prepare` | 14 | 5 | 0 | 0 | 0 | 19 |
//! | `start` | 2 | 0 | 0 | 0 | 0 | 2 |
//! | `mass_matrix` | 2 | 2 | 0 | 1 | 0 | 5 |
//! | `bias` | 7 | 2 | 0 | 1 | 0 | 10 |
//! | `applied` | 2 | 4 | 0 | 2 | 0 | 8 |
//! | `forces` | 9 | 7 | 0 | 3 | 0 | 19 |
//! | `accelerations` | 16 | 12 | 2 | 3 | 0 | 34 |
//! | `kinetic_energy` | 14 | 7 | 0 | 2 | 0 | 25 |
//! | `potential_energy` | 4 | 3 | 0 | 2 | 0 | 9 |
//! | `work_rate` | 2 | 1 | 0 | 0 | 0 | 3 |
//! | `output_x` | 2 | 2 | 0 | 2 | 0 | 6 |
//! | `output_y` | 2 | 2 | 0 | 2 | 0 | 6 |
//! | `output_manipulability` | 1 | 0 | 0 | 1 | 1 | 3 |
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

/// A robot's arm with two revolute joints in a vertical plane, a motor in each.
///
/// The first angle is measured from the horizontal, the second from the first link. The
/// equations are every textbook's, M(q) a + C(q, v) v + g(q) = tau (M. W. Spong, S. Hutchinson,
/// M. Vidyasagar, Robot Modeling and Control, 2006, ch. 7). M depends on q2 alone. With
/// the C of Christoffel's symbols dM/dt - 2 C is skew, so that motors put in exactly the power
/// tau . v: the arm is passive. Motors that give tau = M(q) (what is wanted) + C v + g make
/// each joint move as if it were alone: computed torque. Without motors it is a double
/// pendulum.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TwoJointArm<S = f64> {
    /// Length of each link. Unit: `m`. Default: 0.4.
    pub l1: S,
    /// `l2`. Unit: `m`. Default: 0.35.
    pub l2: S,
    /// Distance of each link's mass centre from its joint. Unit: `m`. Default: 0.2.
    pub c1: S,
    /// `c2`. Unit: `m`. Default: 0.16.
    pub c2: S,
    /// Mass of each link. Unit: `kg`. Default: 4.
    pub m1: S,
    /// `m2`. Unit: `kg`. Default: 2.5.
    pub m2: S,
    /// Inertia of each link about its mass centre. Unit: `kg*m^2`. Default: 0.06.
    pub J1: S,
    /// `J2`. Unit: `kg*m^2`. Default: 0.03.
    pub J2: S,
    /// Acceleration of gravity. Unit: `m/s^2`. Default: 9.81.
    pub g: S,
}

impl<S: ::lagrangian::emitted::Scalar> TwoJointArm<S> {
    /// Computes what depends on the parameters alone, once.
    pub fn prepare(&self) -> Prepared<S> {
        let t0 = self.m1 * self.c1;
        let t1 = self.c2 * self.m2;
        let t2 = self.l1 * self.m2;
        let t3 = self.c1 * t0 + self.J1;
        let c1_m1_g = t0 * self.g;
        let J2_plus_c2_squared_m2 = self.J2 + self.c2 * t1;
        let l1_c2_m2 = self.c2 * t2;
        let l1_l2 = self.l1 * self.l2;
        let m2_g = self.m2 * self.g;
        let k0 = S::from_f64(0.5) * t3;
        let c2_m2_g = self.g * t1;
        let c1_m1_g_plus_l1_m2_g = c1_m1_g + self.g * t2;
        let two_l1_c2_m2 = l1_c2_m2 * S::from_f64(2.0);
        let k1 = J2_plus_c2_squared_m2 + (t3 + self.l1 * t2);
        Prepared {
            l1: self.l1,
            l2: self.l2,
            c2: self.c2,
            m2: self.m2,
            J2: self.J2,
            l1_l2,
            c1_m1_g,
            m2_g,
            k0,
            J2_plus_c2_squared_m2,
            c2_m2_g,
            c1_m1_g_plus_l1_m2_g,
            l1_c2_m2,
            two_l1_c2_m2,
            k1,
        }
    }

    /// The start values of the description, at rest and `t = 0`.
    pub fn start(&self) -> ::lagrangian::emitted::State<Coordinates<S>> {
        let q1 = S::pi() * S::from_ratio(1, 6);
        let q2 = S::pi() * S::from_ratio(1, 3);
        let q = [q1, q2];
        let v = [S::ZERO; 2];
        ::lagrangian::emitted::State {
            t: 0.0,
            q: Coordinates::from_array(q),
            v: Coordinates::from_array(v),
        }
    }
}

/// The coordinates of [`TwoJointArm`], or their rates, by name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coordinates<S = f64> {
    /// Shoulder: angle of the upper arm from the horizontal. Unit: `rad`.
    pub q1: S,
    /// Elbow: angle of the forearm from the upper arm. Unit: `rad`.
    pub q2: S,
}

/// What can be set while a [`TwoJointArm`] runs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Inputs<S = f64> {
    /// Torque of the motor in the shoulder, and in the elbow. Unit: `N*m`. Default: 0.
    pub tau1: S,
    /// `tau2`. Unit: `N*m`. Default: 0.
    pub tau2: S,
}

/// What can be observed of a [`TwoJointArm`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outputs<S = f64> {
    /// Where the tip is. Unit: `m`.
    pub x: S,
    /// `y`. Unit: `m`.
    pub y: S,
    /// Area of the tip's motions when both joints move at 1 rad/s: 0 where the arm is
    /// stretched out or folded, and the tip cannot be moved along it. Unit: `m^2`.
    pub manipulability: S,
}

/// The parameters of a [`TwoJointArm`], with the work done that depends on them alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prepared<S = f64> {
    /// `l1`
    l1: S,
    /// `l2`
    l2: S,
    /// `c2`
    c2: S,
    /// `m2`
    m2: S,
    /// `J2`
    J2: S,
    /// `l1*l2`
    l1_l2: S,
    /// `c1*m1*g`
    c1_m1_g: S,
    /// `m2*g`
    m2_g: S,
    /// `0.5*(J1 + c1^2*m1)`
    k0: S,
    /// `J2 + c2^2*m2`
    J2_plus_c2_squared_m2: S,
    /// `c2*m2*g`
    c2_m2_g: S,
    /// `c1*m1*g + l1*m2*g`
    c1_m1_g_plus_l1_m2_g: S,
    /// `l1*c2*m2`
    l1_c2_m2: S,
    /// `2*l1*c2*m2`
    two_l1_c2_m2: S,
    /// `J1 + J2 + c1^2*m1 + c2^2*m2 + l1^2*m2`
    k1: S,
}

/// A pivot of an elimination that is not above this share of its diagonal element may be rounding
/// errors alone.
const PIVOTS: ::lagrangian::emitted::Pivots = ::lagrangian::emitted::Pivots::new(2, 2);

/// Mass matrix `M`.
///
/// ```text
/// M[q1, q1] = 2*l1*c2*m2*cos(q2) + l1^2*m2 + c1^2*m1 + c2^2*m2 + J1 + J2
/// M[q2, q1] = l1*c2*m2*cos(q2) + c2^2*m2 + J2
/// M[q2, q2] = c2^2*m2 + J2
/// ```
pub fn mass_matrix<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 2]) -> [[S; 2]; 2] {
    let q2 = q[1];
    let cos_q2 = q2.cos();
    let m11 = cos_q2 * p.two_l1_c2_m2 + p.k1;
    let m21 = cos_q2 * p.l1_c2_m2 + p.J2_plus_c2_squared_m2;
    [[m11, m21], [m21, p.J2_plus_c2_squared_m2]]
}

/// Bias `h`: velocity products and explicit time in the inertia forces.
///
/// ```text
/// h[q1] = -2*l1*c2*m2*sin(q2)*der(q1)*der(q2) - l1*c2*m2*sin(q2)*der(q2)^2
/// h[q2] = l1*c2*m2*sin(q2)*der(q1)^2
/// ```
pub fn bias<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 2], v: &[S; 2]) -> [S; 2] {
    let q2 = q[1];
    let q1_dot = v[0];
    let q2_dot = v[1];
    let sin_q2 = q2.sin();
    let h_q1 = -(sin_q2 * (q2_dot * (q2_dot * p.l1_c2_m2 + q1_dot * p.two_l1_c2_m2)));
    let h_q2 = sin_q2 * (q1_dot * (p.l1_c2_m2 * q1_dot));
    [h_q1, h_q2]
}

/// Applied generalized forces `Q`.
///
/// ```text
/// Q[q1] = tau1 - (l1*m2 + c1*m1)*g*cos(q1) - c2*m2*g*cos(q1 + q2)
/// Q[q2] = tau2 - c2*m2*g*cos(q1 + q2)
/// ```
pub fn applied<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 2],
    u: &Inputs<S>,
) -> [S; 2] {
    let q1 = q[0];
    let q2 = q[1];
    let cos_q1 = q1.cos();
    let t0 = q2 + q1;
    let cos_t0 = t0.cos();
    let t1 = p.c2_m2_g * cos_t0;
    let q_q1 = u.tau1 - (t1 + p.c1_m1_g_plus_l1_m2_g * cos_q1);
    let q_q2 = u.tau2 - t1;
    [q_q1, q_q2]
}

/// Right-hand side `f = Q - h` of `M a = f`.
pub fn forces<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 2],
    v: &[S; 2],
    u: &Inputs<S>,
) -> [S; 2] {
    let q1 = q[0];
    let q2 = q[1];
    let q1_dot = v[0];
    let q2_dot = v[1];
    let cos_q1 = q1.cos();
    let sin_q2 = q2.sin();
    let t0 = q2 + q1;
    let cos_t0 = t0.cos();
    let t1 = p.c2_m2_g * cos_t0;
    let t2 = sin_q2 * (q2_dot * (q2_dot * p.l1_c2_m2 + q1_dot * p.two_l1_c2_m2));
    let f_q1 = t2 + (u.tau1 - (t1 + p.c1_m1_g_plus_l1_m2_g * cos_q1));
    let f_q2 = u.tau2 - t1 - sin_q2 * (q1_dot * (p.l1_c2_m2 * q1_dot));
    [f_q1, f_q2]
}

::lagrangian::emitted::fast_function! {
    /// Accelerations `a`, the solution of `M a = f` from the mass matrix multiplied out, factored.
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
    pub fn accelerations<'a, S>(Accelerations {
        p: &'a Prepared<S>,
        q: &'a [S; 2],
        v: &'a [S; 2],
        u: &'a Inputs<S>,
    }) -> Result<[S; 2], ::lagrangian::emitted::Singular> = accelerations_in;
}

#[inline(always)]
fn accelerations_in<S: Copy, N: ::lagrangian::emitted::Scalar<Stored = S>>(
    call: Accelerations<'_, S>,
) -> Result<[S; 2], ::lagrangian::emitted::Singular> {
    let Accelerations { p, q, v, u } = call;
    let n = N::load;
    let q1 = n(q[0]);
    let q2 = n(q[1]);
    let q1_dot = n(v[0]);
    let q2_dot = n(v[1]);
    let t0 = q2 + q1;
    let angles = [q2, q1, t0];
    let circular = N::sin_cos_all(angles);
    let (sin_q2, cos_q2) = circular[0];
    let (_, cos_q1) = circular[1];
    let (_, cos_t0) = circular[2];
    let t1 = n(p.l1_c2_m2).mul_add(q2_dot, n(p.two_l1_c2_m2) * q1_dot);
    // Row q1: pivot d[q1].
    let t2 = cos_q2.mul_add(n(p.two_l1_c2_m2), n(p.k1));
    let t3 = cos_q2.mul_add(n(p.l1_c2_m2), n(p.J2_plus_c2_squared_m2));
    let t4 = N::ONE / t2;
    let t5 = n(p.c2_m2_g) * cos_t0;
    let t6 = q1_dot * (n(p.l1_c2_m2) * q1_dot);
    let t7 = n(u.tau1) - n(p.c1_m1_g_plus_l1_m2_g).mul_add(cos_q1, t5);
    let t8 = sin_q2.mul_add(q2_dot * t1, t7);
    // Eliminates q1 from row q2: l[q2, q1].
    let t9 = t4 * t3;
    // Row q2: pivot d[q2].
    let t10 = t3.neg_mul_add(t9, n(p.J2_plus_c2_squared_m2));
    // Row q2: right-hand side z[q2].
    let t11 = t9.neg_mul_add(t8, sin_q2.neg_mul_add(t6, n(u.tau2) - t5));
    let q2_ddot = t11 / t10;
    // Back substitution: a[q1].
    let q1_ddot = t9.neg_mul_add(q2_ddot, t4 * t8);
    let sound =
        PIVOTS.hold(t2, t2) & PIVOTS.hold(t10, n(p.J2_plus_c2_squared_m2)) & q1_ddot.is_finite();
    if !sound {
        let pivots = [(0, t2, t2), (1, t10, n(p.J2_plus_c2_squared_m2))];
        PIVOTS.check(pivots)?;
    }
    let accelerations = [q1_ddot.store(), q2_ddot.store()];
    Ok(accelerations)
}

/// Kinetic energy `T`, in J.
///
/// ```text
/// T = 1/2*(c1^2*m1 + J1)*der(q1)^2 + 1/2*J2*(der(q1) + der(q2))^2 + 1/2*m2*((-l1*sin(q1)*der(q1) -
///     c2*sin(q1 + q2)*(der(q1) + der(q2)))^2 + (l1*cos(q1)*der(q1) + c2*cos(q1 + q2)*(der(q1) +
///     der(q2)))^2)
/// ```
pub fn kinetic_energy<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 2],
    v: &[S; 2],
) -> S {
    let q1 = q[0];
    let q2 = q[1];
    let q1_dot = v[0];
    let q2_dot = v[1];
    let t0 = q2 + q1;
    let (sin_q1, cos_q1) = q1.sin_cos();
    let t1 = q2_dot + q1_dot;
    let t2 = q1_dot * p.l1;
    let (sin_t0, cos_t0) = t0.sin_cos();
    let t3 = t1 * p.c2;
    let t4 = t3 * sin_t0 + t2 * sin_q1;
    let t5 = t3 * cos_t0 + t2 * cos_q1;
    let t6 = S::from_f64(0.5) * ((t5 * t5 + t4 * t4) * p.m2 + t1 * (t1 * p.J2));
    t6 + q1_dot * (q1_dot * p.k0)
}

/// Potential energy `V`, in J.
///
/// ```text
/// V = (l1*m2 + c1*m1)*g*sin(q1) + c2*m2*g*sin(q1 + q2)
/// ```
pub fn potential_energy<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 2]) -> S {
    let q1 = q[0];
    let q2 = q[1];
    let sin_q1 = q1.sin();
    let t0 = q2 + q1;
    let sin_t0 = t0.sin();
    p.m2_g * (sin_t0 * p.c2 + sin_q1 * p.l1) + sin_q1 * p.c1_m1_g
}

/// Power `P` supplied by drives, forces and inputs, in W.
///
/// ```text
/// P = der(q1)*tau1 + der(q2)*tau2
/// ```
pub fn work_rate<S: ::lagrangian::emitted::Scalar>(v: &[S; 2], u: &Inputs<S>) -> S {
    let q1_dot = v[0];
    let q2_dot = v[1];
    u.tau2 * q2_dot + u.tau1 * q1_dot
}

/// Where the tip is. Unit: `m`.
///
/// ```text
/// x = l1*cos(q1) + l2*cos(q1 + q2)
/// ```
pub fn output_x<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 2]) -> S {
    let q1 = q[0];
    let q2 = q[1];
    let cos_q1 = q1.cos();
    let t0 = q2 + q1;
    let cos_t0 = t0.cos();
    cos_t0 * p.l2 + cos_q1 * p.l1
}

/// `y`. Unit: `m`.
///
/// ```text
/// y = l1*sin(q1) + l2*sin(q1 + q2)
/// ```
pub fn output_y<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 2]) -> S {
    let q1 = q[0];
    let q2 = q[1];
    let sin_q1 = q1.sin();
    let t0 = q2 + q1;
    let sin_t0 = t0.sin();
    sin_t0 * p.l2 + sin_q1 * p.l1
}

/// Area of the tip's motions when both joints move at 1 rad/s: 0 where the arm is
/// stretched out or folded, and the tip cannot be moved along it. Unit: `m^2`.
///
/// ```text
/// manipulability = l1*l2*abs(sin(q2))
/// ```
pub fn output_manipulability<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 2]) -> S {
    let q2 = q[1];
    let sin_q2 = q2.sin();
    p.l1_l2 * sin_q2.abs()
}

/// Everything that the description asks to observe.
pub fn outputs<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 2]) -> Outputs<S> {
    Outputs {
        x: output_x(p, q),
        y: output_y(p, q),
        manipulability: output_manipulability(p, q),
    }
}

::lagrangian::emitted::implement! {
    machine TwoJointArm "TwoJointArm" over S, R;
    parameters { l1, l2, c1, c2, m1, m2, J1, J2, g } [
        l1: "l1" "m" = 0.4;
        l2: "l2" "m" = 0.35;
        c1: "c1" "m" = 0.2;
        c2: "c2" "m" = 0.16;
        m1: "m1" "kg" = 4.0;
        m2: "m2" "kg" = 2.5;
        J1: "J1" "kg*m^2" = 0.06;
        J2: "J2" "kg*m^2" = 0.03;
        g: "g" "m/s^2" = 9.81;
    ]
    coordinates 2 Coordinates { q1, q2 } [
        q1: "q1" "rad";
        q2: "q2" "rad";
    ]
    inputs Inputs { tau1, tau2 } [
        tau1: "tau1" "N*m" = 0.0;
        tau2: "tau2" "N*m" = 0.0;
    ] over S
    outputs Outputs { x, y, manipulability } [
        x: "x" "m";
        y: "y" "m";
        manipulability: "manipulability" "m^2";
    ]
    prepared Prepared {
        l1, l2, c2, m2, J2, l1_l2, c1_m1_g, m2_g, k0, J2_plus_c2_squared_m2, c2_m2_g,
        c1_m1_g_plus_l1_m2_g, l1_c2_m2, two_l1_c2_m2, k1,
    }
    accelerations { (p, t, q, v, u) Accelerations { p, q, v, u } }
    system {
        matrix mass_matrix(p, t, q) = mass_matrix(p, q);
        vector bias(p, t, q, v) = bias(p, q, v);
        vector applied(p, t, q, v, u) = applied(p, q, u);
        vector forces(p, t, q, v, u) = forces(p, q, v, u);
        number kinetic_energy(p, t, q, v) = kinetic_energy(p, q, v);
        number potential_energy(p, t, q, u) = potential_energy(p, q);
        number dissipation(p, t, q, v, u);
        number work_rate(p, t, q, v, a, u) = work_rate(v, u);
        number dissipation_rate(p, t, q, v, u);
        outputs outputs(p, t, q, v, a, u) = outputs(p, q);
    }
    absent [MAY_BE_CONSTRAINED MAY_SLIDE MAY_COLLIDE]
    intervals []
    lanes [N]
    numbers [yes]
}
