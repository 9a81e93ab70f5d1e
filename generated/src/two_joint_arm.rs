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

impl Default for TwoJointArm {
    fn default() -> Self {
        Self {
            l1: 0.4,
            l2: 0.35,
            c1: 0.2,
            c2: 0.16,
            m1: 4.0,
            m2: 2.5,
            J1: 0.06,
            J2: 0.03,
            g: 9.81,
        }
    }
}

impl<S> TwoJointArm<S> {
    /// These values as other numbers.
    pub fn map<R>(self, f: impl Fn(S) -> R) -> TwoJointArm<R> {
        TwoJointArm {
            l1: f(self.l1),
            l2: f(self.l2),
            c1: f(self.c1),
            c2: f(self.c2),
            m1: f(self.m1),
            m2: f(self.m2),
            J1: f(self.J1),
            J2: f(self.J2),
            g: f(self.g),
        }
    }
}

impl<S: ::lagrangian::emitted::Scalar> TwoJointArm<S> {
    /// Computes what depends on the parameters alone, once.
    pub fn prepare(&self) -> Prepared<S> {
        let t0 = self.m1 * self.c1;
        let t1 = self.c2 * self.m2;
        let t2 = self.l1 * self.m2;
        let t3 = self.c1 * t0 + self.J1;
        let k1 = t0 * self.g;
        let k4 = self.J2 + self.c2 * t1;
        let k7 = self.c2 * t2;
        let k0 = self.l1 * self.l2;
        let k2 = self.m2 * self.g;
        let k3 = S::from_f64(0.5) * t3;
        let k5 = self.g * t1;
        let k6 = k1 + self.g * t2;
        let k8 = k7 * S::from_f64(2.0);
        let k9 = k4 + (t3 + self.l1 * t2);
        Prepared {
            l1: self.l1,
            l2: self.l2,
            c2: self.c2,
            m2: self.m2,
            J2: self.J2,
            k0,
            k1,
            k2,
            k3,
            k4,
            k5,
            k6,
            k7,
            k8,
            k9,
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

impl<S: Copy> Coordinates<S> {
    /// The numbers in the order of the description: the order of `q` in every function here.
    pub fn to_array(self) -> [S; 2] {
        [self.q1, self.q2]
    }

    /// Names for numbers in the order of the description.
    pub fn from_array(q: [S; 2]) -> Self {
        Self { q1: q[0], q2: q[1] }
    }

    /// These values as other numbers.
    pub fn map<R>(self, f: impl Fn(S) -> R) -> Coordinates<R> {
        Coordinates {
            q1: f(self.q1),
            q2: f(self.q2),
        }
    }
}

/// What can be set while a [`TwoJointArm`] runs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Inputs<S = f64> {
    /// Torque of the motor in the shoulder, and in the elbow. Unit: `N*m`. Default: 0.
    pub tau1: S,
    /// `tau2`. Unit: `N*m`. Default: 0.
    pub tau2: S,
}

impl Default for Inputs {
    fn default() -> Self {
        Self {
            tau1: 0.0,
            tau2: 0.0,
        }
    }
}

impl<S> Inputs<S> {
    /// These values as other numbers.
    pub fn map<R>(self, f: impl Fn(S) -> R) -> Inputs<R> {
        Inputs {
            tau1: f(self.tau1),
            tau2: f(self.tau2),
        }
    }
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
    k0: S,
    /// `c1*m1*g`
    k1: S,
    /// `m2*g`
    k2: S,
    /// `0.5*(J1 + c1^2*m1)`
    k3: S,
    /// `J2 + c2^2*m2`
    k4: S,
    /// `c2*m2*g`
    k5: S,
    /// `c1*m1*g + l1*m2*g`
    k6: S,
    /// `l1*c2*m2`
    k7: S,
    /// `2*l1*c2*m2`
    k8: S,
    /// `J1 + J2 + c1^2*m1 + c2^2*m2 + l1^2*m2`
    k9: S,
}

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
    let m11 = cos_q2 * p.k8 + p.k9;
    let m21 = cos_q2 * p.k7 + p.k4;
    [[m11, m21], [m21, p.k4]]
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
    let h_q1 = -(sin_q2 * (q2_dot * (q2_dot * p.k7 + q1_dot * p.k8)));
    let h_q2 = sin_q2 * (q1_dot * (p.k7 * q1_dot));
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
    let t1 = p.k5 * cos_t0;
    let q_q1 = u.tau1 - (t1 + p.k6 * cos_q1);
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
    let t1 = p.k5 * cos_t0;
    let t2 = sin_q2 * (q2_dot * (q2_dot * p.k7 + q1_dot * p.k8));
    let f_q1 = t2 + (u.tau1 - (t1 + p.k6 * cos_q1));
    let f_q2 = u.tau2 - t1 - sin_q2 * (q1_dot * (p.k7 * q1_dot));
    [f_q1, f_q2]
}

/// Accelerations `a`, the solution of `M a = f` from the mass matrix multiplied out, factored.
///
/// A pivot that vanishes is an error.
pub fn accelerations<S: ::lagrangian::emitted::Number>(
    p: &Prepared<S>,
    q: &[S; 2],
    v: &[S; 2],
    u: &Inputs<S>,
) -> Result<[S; 2], ::lagrangian::emitted::Singular> {
    S::run(Accelerations { p, q, v, u })
}

/// A call of [`accelerations`], to be run with whatever instructions the processor has.
pub struct Accelerations<'a, S> {
    /// As `accelerations` takes it.
    pub p: &'a Prepared<S>,
    /// As `accelerations` takes it.
    pub q: &'a [S; 2],
    /// As `accelerations` takes it.
    pub v: &'a [S; 2],
    /// As `accelerations` takes it.
    pub u: &'a Inputs<S>,
}

impl<S: Copy> ::lagrangian::emitted::scalar::Kernel<S> for Accelerations<'_, S> {
    type Output = Result<[S; 2], ::lagrangian::emitted::Singular>;

    #[inline(always)]
    fn run<N: ::lagrangian::emitted::Scalar<Stored = S>>(self) -> Self::Output {
        let Self { p, q, v, u } = self;
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
        let t1 = cos_q2.mul_add(n(p.k8), n(p.k9));
        let t2 = cos_q2.mul_add(n(p.k7), n(p.k4));
        let t3 = N::ONE / t1;
        let t4 = n(p.k5) * cos_t0;
        let t5 = q1_dot * (n(p.k7) * q1_dot);
        let t6 = q2_dot * n(p.k7).mul_add(q2_dot, n(p.k8) * q1_dot);
        let t7 = n(u.tau1) - n(p.k6).mul_add(cos_q1, t4);
        let t8 = sin_q2.mul_add(t6, t7);
        let t9 = t3 * t2;
        let t10 = t2.neg_mul_add(t9, n(p.k4));
        let t11 = t9.neg_mul_add(t8, sin_q2.neg_mul_add(t5, n(u.tau2) - t4));
        let q2_ddot = t11 / t10;
        let q1_ddot = t9.neg_mul_add(q2_ddot, t3 * t8);
        let sound = t1.exceeds(N::from_f64(1.7763568394002505e-15) * t1)
            & t10.exceeds(N::from_f64(1.7763568394002505e-15) * n(p.k4))
            & q1_ddot.is_finite();
        if !sound {
            check(t1, t1, 1.7763568394002505e-15, 0)?;
            check(t10, n(p.k4), 1.7763568394002505e-15, 1)?;
        }
        let accelerations = [q1_ddot.store(), q2_ddot.store()];
        Ok(accelerations)
    }
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
    t6 + q1_dot * (q1_dot * p.k3)
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
    p.k2 * (sin_t0 * p.c2 + sin_q1 * p.l1) + sin_q1 * p.k1
}

/// Power `P` that drives, forces and inputs put in, in W.
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
    p.k0 * sin_q2.abs()
}

/// Everything that the description asks to observe.
pub fn outputs<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 2]) -> Outputs<S> {
    Outputs {
        x: output_x(p, q),
        y: output_y(p, q),
        manipulability: output_manipulability(p, q),
    }
}

/// Names and units.
const PARAMETERS: [(&str, &str); 9] = [
    ("l1", "m"),
    ("l2", "m"),
    ("c1", "m"),
    ("c2", "m"),
    ("m1", "kg"),
    ("m2", "kg"),
    ("J1", "kg*m^2"),
    ("J2", "kg*m^2"),
    ("g", "m/s^2"),
];

/// Names and units.
const COORDINATES: [(&str, &str); 2] = [("q1", "rad"), ("q2", "rad")];

/// Names and units.
const INPUTS: [(&str, &str); 2] = [("tau1", "N*m"), ("tau2", "N*m")];

/// Names and units.
const OUTPUTS: [(&str, &str); 3] = [("x", "m"), ("y", "m"), ("manipulability", "m^2")];

impl ::lagrangian::emitted::Machine for TwoJointArm {
    type System = Prepared;

    fn name(&self) -> &str {
        "TwoJointArm"
    }

    fn parameters(
        &self,
    ) -> impl ExactSizeIterator<Item = (::lagrangian::emitted::Quantity<'_>, f64)> {
        let values = [
            self.l1, self.l2, self.c1, self.c2, self.m1, self.m2, self.J1, self.J2, self.g,
        ];
        quantities(&PARAMETERS, values)
    }

    fn parameter_mut(&mut self, index: usize) -> Option<&mut f64> {
        match index {
            0 => Some(&mut self.l1),
            1 => Some(&mut self.l2),
            2 => Some(&mut self.c1),
            3 => Some(&mut self.c2),
            4 => Some(&mut self.m1),
            5 => Some(&mut self.m2),
            6 => Some(&mut self.J1),
            7 => Some(&mut self.J2),
            8 => Some(&mut self.g),
            _ => None,
        }
    }

    fn prepare(&self) -> Prepared {
        Self::prepare(self)
    }

    fn start(&self) -> ::lagrangian::emitted::State<Coordinates> {
        Self::start(self)
    }
}

impl ::lagrangian::emitted::System for Prepared {
    type Vector = [f64; 2];
    type Matrix = [f64; 4];
    type Coordinates = Coordinates;
    type Inputs = Inputs;
    type Outputs = Outputs;
    const MAY_BE_CONSTRAINED: bool = false;
    const MAY_SLIDE: bool = false;
    const MAY_COLLIDE: bool = false;

    fn coordinates(&self) -> impl ExactSizeIterator<Item = ::lagrangian::emitted::Quantity<'_>> {
        COORDINATES.iter().map(quantity)
    }

    fn to_coordinates(&self, vector: &[f64; 2]) -> Coordinates {
        Coordinates::from_array(*vector)
    }

    fn to_vector(&self, coordinates: &Coordinates) -> [f64; 2] {
        coordinates.to_array()
    }

    fn accelerations(
        &self,
        _: f64,
        q: &[f64; 2],
        v: &[f64; 2],
        u: &Inputs,
        result: &mut [f64; 2],
    ) -> Result<(), ::lagrangian::emitted::Singular> {
        <f64 as ::lagrangian::emitted::Number>::run_in_place(
            Accelerations { p: self, q, v, u },
            result,
        )
    }

    fn mass_matrix(&self, _: f64, q: &[f64; 2], matrix: &mut [f64; 4]) {
        let rows = mass_matrix(self, q);
        for (to, from) in matrix.iter_mut().zip(rows.as_flattened()) {
            *to = *from;
        }
    }

    fn bias(&self, _: f64, q: &[f64; 2], v: &[f64; 2], result: &mut [f64; 2]) {
        *result = bias(self, q, v);
    }

    fn applied(&self, _: f64, q: &[f64; 2], _: &[f64; 2], u: &Inputs, result: &mut [f64; 2]) {
        *result = applied(self, q, u);
    }

    fn forces(&self, _: f64, q: &[f64; 2], v: &[f64; 2], u: &Inputs, result: &mut [f64; 2]) {
        *result = forces(self, q, v, u);
    }

    fn kinetic_energy(&self, _: f64, q: &[f64; 2], v: &[f64; 2]) -> f64 {
        kinetic_energy(self, q, v)
    }

    fn potential_energy(&self, _: f64, q: &[f64; 2], _: &Inputs) -> f64 {
        potential_energy(self, q)
    }

    fn dissipation(&self, _: f64, _: &[f64; 2], _: &[f64; 2], _: &Inputs) -> f64 {
        0.0
    }

    fn work_rate(&self, _: f64, _: &[f64; 2], v: &[f64; 2], _: &[f64; 2], u: &Inputs) -> f64 {
        work_rate(v, u)
    }

    fn dissipation_rate(&self, _: f64, _: &[f64; 2], _: &[f64; 2], _: &Inputs) -> f64 {
        0.0
    }

    fn default_inputs(&self) -> Inputs {
        Inputs::default()
    }

    fn input_values(
        &self,
        inputs: &Inputs,
    ) -> impl ExactSizeIterator<Item = (::lagrangian::emitted::Quantity<'_>, f64)> {
        let values = [inputs.tau1, inputs.tau2];
        quantities(&INPUTS, values)
    }

    fn output_values(
        &self,
        outputs: &Outputs,
    ) -> impl ExactSizeIterator<Item = (::lagrangian::emitted::Quantity<'_>, f64)> {
        let values = [outputs.x, outputs.y, outputs.manipulability];
        quantities(&OUTPUTS, values)
    }

    fn outputs(&self, _: f64, q: &[f64; 2], _: &[f64; 2], _: &[f64; 2], _: &Inputs) -> Outputs {
        outputs(self, q)
    }

    fn assumptions(
        &self,
        _: f64,
        _: &[f64; 2],
        _: &[f64; 2],
        _: &Inputs,
    ) -> impl ExactSizeIterator<Item = ::lagrangian::emitted::Assumption<'_>> {
        ::core::iter::empty()
    }
}

impl<const N: usize> ::lagrangian::emitted::Batched<N> for Prepared
where
    ::lagrangian::emitted::Lanes<N>: ::lagrangian::emitted::Number,
{
    type Batch = Prepared<::lagrangian::emitted::Lanes<N>>;
    type Vectors = [::lagrangian::emitted::Lanes<N>; 2];
    type BatchInputs = Inputs<::lagrangian::emitted::Lanes<N>>;

    fn batch(systems: [&Self; N]) -> Self::Batch {
        let lanes = |number: fn(&Self) -> f64| ::lagrangian::emitted::Lanes(systems.map(number));
        Prepared {
            l1: lanes(|p| p.l1),
            l2: lanes(|p| p.l2),
            c2: lanes(|p| p.c2),
            m2: lanes(|p| p.m2),
            J2: lanes(|p| p.J2),
            k0: lanes(|p| p.k0),
            k1: lanes(|p| p.k1),
            k2: lanes(|p| p.k2),
            k3: lanes(|p| p.k3),
            k4: lanes(|p| p.k4),
            k5: lanes(|p| p.k5),
            k6: lanes(|p| p.k6),
            k7: lanes(|p| p.k7),
            k8: lanes(|p| p.k8),
            k9: lanes(|p| p.k9),
        }
    }

    fn batch_inputs(inputs: [&Inputs; N]) -> Self::BatchInputs {
        let lanes = |number: fn(&Inputs) -> f64| ::lagrangian::emitted::Lanes(inputs.map(number));
        Inputs {
            tau1: lanes(|u| u.tau1),
            tau2: lanes(|u| u.tau2),
        }
    }

    fn inputs_of_lane(inputs: &Self::BatchInputs, lane: usize) -> Inputs {
        Inputs {
            tau1: inputs.tau1[lane],
            tau2: inputs.tau2[lane],
        }
    }

    fn is_singular(&self) -> bool {
        false
    }

    fn batch_accelerations(
        p: &Self::Batch,
        _: ::lagrangian::emitted::Lanes<N>,
        q: &Self::Vectors,
        v: &Self::Vectors,
        u: &Self::BatchInputs,
        result: &mut Self::Vectors,
    ) -> Result<(), ::lagrangian::emitted::Singular> {
        <::lagrangian::emitted::Lanes<N> as ::lagrangian::emitted::Number>::run_in_place(
            Accelerations { p, q, v, u },
            result,
        )
    }
}

impl<S: ::lagrangian::emitted::Real> ::lagrangian::emitted::MachineIn<S> for TwoJointArm<S> {
    type System = Prepared<S>;

    fn prepare(&self) -> Prepared<S> {
        Self::prepare(self)
    }

    fn start(&self) -> ::lagrangian::emitted::State<Coordinates<S>> {
        Self::start(self)
    }
}

impl<S: ::lagrangian::emitted::Real> ::lagrangian::emitted::SystemIn<S> for Prepared<S> {
    type Vector = [S; 2];
    type Coordinates = Coordinates<S>;
    type Inputs = Inputs<S>;

    fn coordinates(&self) -> impl ExactSizeIterator<Item = ::lagrangian::emitted::Quantity<'_>> {
        COORDINATES.iter().map(quantity)
    }

    fn to_coordinates(&self, vector: &[S; 2]) -> Coordinates<S> {
        Coordinates::from_array(*vector)
    }

    fn to_vector(&self, coordinates: &Coordinates<S>) -> [S; 2] {
        coordinates.to_array()
    }

    fn default_inputs(&self) -> Inputs<S> {
        <Inputs>::default().map(S::from_f64)
    }

    fn accelerations(
        &self,
        _: S,
        q: &[S; 2],
        v: &[S; 2],
        u: &Inputs<S>,
        result: &mut [S; 2],
    ) -> Result<(), ::lagrangian::emitted::Singular> {
        <S as ::lagrangian::emitted::Number>::run_in_place(
            Accelerations { p: self, q, v, u },
            result,
        )
    }
}

/// A name with its unit.
fn quantity<'a>(&(name, unit): &'a (&'a str, &'a str)) -> ::lagrangian::emitted::Quantity<'a> {
    ::lagrangian::emitted::Quantity { name, unit }
}

/// Names and units beside values.
fn quantities<'a, const N: usize>(
    names: &'a [(&'a str, &'a str); N],
    values: [f64; N],
) -> impl ExactSizeIterator<Item = (::lagrangian::emitted::Quantity<'a>, f64)> {
    names.iter().map(quantity).zip(values)
}

/// Refuses a pivot of which elimination has left nothing but rounding errors of a diagonal element,
/// in any of several lanes.
#[inline(always)]
fn check<N: ::lagrangian::emitted::Scalar>(
    pivot: N,
    diagonal: N,
    share: f64,
    coordinate: usize,
) -> Result<(), ::lagrangian::emitted::Singular> {
    let bound = N::from_f64(share) * diagonal;
    match pivot.exceeds(bound) {
        true => Ok(()),
        false => Err(singular(coordinate, pivot, diagonal)),
    }
}

/// The share of a pivot that is no rounding, for the message.
#[cold]
fn singular<S: ::lagrangian::emitted::Scalar>(
    coordinate: usize,
    pivot: S,
    diagonal: S,
) -> ::lagrangian::emitted::Singular {
    let [pivot, diagonal] = [pivot, diagonal].map(|x| x.to_f64());
    ::lagrangian::emitted::Singular::new(coordinate, pivot, diagonal)
}
