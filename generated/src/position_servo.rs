// @generated from machines/position_servo.machine by `cargo xtask generate`; edits are lost.

//! An arm that a motor holds level against its weight: a controller with an integrator looks at a
//! filtered angle, and
//! sets the voltage.
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

/// An arm that a motor holds level against its weight: a controller with an integrator looks at a
/// filtered angle, and
/// sets the voltage.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PositionServo<S = f64> {
    /// Mass of the arm, and the distance of its mass centre from the axis. Unit: `kg`. Default:
    /// 1.2.
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

impl Default for PositionServo {
    fn default() -> Self {
        Self {
            m: 1.2,
            a: 0.25,
            J: 0.04,
            n: 40.0,
            L: 0.002,
            R: 0.5,
            k: 0.05,
            b: 0.3,
            kp: 30.0,
            ki: 40.0,
            kd: 4.0,
            tau: 0.01,
            g: 9.81,
        }
    }
}

impl<S> PositionServo<S> {
    /// These values as other numbers.
    pub fn map<R>(self, f: impl Fn(S) -> R) -> PositionServo<R> {
        PositionServo {
            m: f(self.m),
            a: f(self.a),
            J: f(self.J),
            n: f(self.n),
            L: f(self.L),
            R: f(self.R),
            k: f(self.k),
            b: f(self.b),
            kp: f(self.kp),
            ki: f(self.ki),
            kd: f(self.kd),
            tau: f(self.tau),
            g: f(self.g),
        }
    }
}

impl<S: ::lagrangian::emitted::Scalar> PositionServo<S> {
    /// Computes what depends on the parameters alone, once.
    pub fn prepare(&self) -> Prepared<S> {
        let t0 = self.a * self.m;
        let k3 = S::ONE / self.tau;
        let k6 = self.a * t0 + self.J;
        let k0 = self.k * self.n;
        let k1 = k3 * self.kd;
        let k2 = S::ONE / self.L;
        let k4 = self.b * S::from_f64(0.5);
        let k5 = self.L * S::from_f64(0.5);
        let k7 = S::from_f64(0.5) * k6;
        let k8 = t0 * self.g;
        let k9 = -(S::ONE / k6);
        let one = S::ONE;
        let singular = if vanishes(one, one, 3.552713678800501e-15) {
            Some(singular(1, one, one))
        } else if vanishes(one, one, 3.552713678800501e-15) {
            Some(singular(2, one, one))
        } else if vanishes(one, one, 3.552713678800501e-15) {
            Some(singular(3, one, one))
        } else if vanishes(k6, k6, 3.552713678800501e-15) {
            Some(singular(0, k6, k6))
        } else {
            None
        };
        Prepared {
            R: self.R,
            b: self.b,
            kp: self.kp,
            ki: self.ki,
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
            singular,
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

impl<S: Copy> Coordinates<S> {
    /// The numbers in the order of the description: the order of `q` in every function here.
    pub fn to_array(self) -> [S; 4] {
        [self.theta, self.i, self.seen, self.error]
    }

    /// Names for numbers in the order of the description.
    pub fn from_array(q: [S; 4]) -> Self {
        Self {
            theta: q[0],
            i: q[1],
            seen: q[2],
            error: q[3],
        }
    }

    /// These values as other numbers.
    pub fn map<R>(self, f: impl Fn(S) -> R) -> Coordinates<R> {
        Coordinates {
            theta: f(self.theta),
            i: f(self.i),
            seen: f(self.seen),
            error: f(self.error),
        }
    }
}

/// What can be set while a [`PositionServo`] runs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Inputs<S = f64> {
    /// Where the arm is wanted. Unit: `rad`. Default: 0.
    pub wanted: S,
}

impl Default for Inputs {
    fn default() -> Self {
        Self { wanted: 0.0 }
    }
}

impl<S> Inputs<S> {
    /// These values as other numbers.
    pub fn map<R>(self, f: impl Fn(S) -> R) -> Inputs<R> {
        Inputs {
            wanted: f(self.wanted),
        }
    }
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
    k0: S,
    /// `kd/tau`
    k1: S,
    /// `1/L`
    k2: S,
    /// `1/tau`
    k3: S,
    /// `0.5*b`
    k4: S,
    /// `0.5*L`
    k5: S,
    /// `J + m*a^2`
    k6: S,
    /// `0.5*(J + m*a^2)`
    k7: S,
    /// `m*a*g`
    k8: S,
    /// `-1/(J + m*a^2)`
    k9: S,
    /// Why these parameters leave the machine without accelerations, if they do.
    singular: Option<::lagrangian::emitted::Singular>,
}

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
        [p.k6, zero, zero, zero],
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
    let t1 = error_dot * p.ki - t0 * p.k1 - (seen_dot - u.wanted) * p.kp;
    let q_theta = p.k0 * i_dot - p.k8 * cos_theta - theta_dot * p.b;
    let q_i = p.k2 * (t1 - (i_dot * p.R + theta_dot * p.k0));
    let q_seen = t0 * p.k3;
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
    let t1 = error_dot * p.ki - t0 * p.k1 - (seen_dot - u.wanted) * p.kp;
    let f_theta = p.k0 * i_dot - p.k8 * cos_theta - theta_dot * p.b;
    let f_i = p.k2 * (t1 - (i_dot * p.R + theta_dot * p.k0));
    let f_seen = t0 * p.k3;
    let f_error = u.wanted - seen_dot;
    [f_theta, f_i, f_seen, f_error]
}

/// Accelerations `a`, the solution of `M a = f` eliminated along the machine.
///
/// A pivot that vanishes is an error.
pub fn accelerations<S: ::lagrangian::emitted::Number>(
    p: &Prepared<S>,
    q: &[S; 4],
    v: &[S; 4],
    u: &Inputs<S>,
) -> Result<[S; 4], ::lagrangian::emitted::Singular> {
    S::run(Accelerations { p, q, v, u })
}

/// A call of [`accelerations`], to be run with whatever instructions the processor has.
pub struct Accelerations<'a, S> {
    /// As `accelerations` takes it.
    pub p: &'a Prepared<S>,
    /// As `accelerations` takes it.
    pub q: &'a [S; 4],
    /// As `accelerations` takes it.
    pub v: &'a [S; 4],
    /// As `accelerations` takes it.
    pub u: &'a Inputs<S>,
}

impl<S: Copy> ::lagrangian::emitted::scalar::Kernel<S> for Accelerations<'_, S> {
    type Output = Result<[S; 4], ::lagrangian::emitted::Singular>;

    #[inline(always)]
    fn run<N: ::lagrangian::emitted::Scalar<Stored = S>>(self) -> Self::Output {
        let Self { p, q, v, u } = self;
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
        let t1 = t0.neg_mul_add(n(p.k1), error_dot * n(p.ki));
        let t2 = (seen_dot - n(u.wanted)).neg_mul_add(n(p.kp), t1);
        let t3 = t2 - i_dot.mul_add(n(p.R), theta_dot * n(p.k0));
        let t4 = n(p.k0).mul_sub(i_dot, theta_dot * n(p.b));
        let theta_ddot = n(p.k9) * n(p.k8).mul_sub(cos_theta, t4);
        let i_ddot = n(p.k2) * t3;
        let seen_ddot = t0 * n(p.k3);
        let error_ddot = n(u.wanted) - seen_dot;
        let accelerations = [
            theta_ddot.store(),
            i_ddot.store(),
            seen_ddot.store(),
            error_ddot.store(),
        ];
        Ok(accelerations)
    }
}

/// Kinetic energy `T`, in J.
///
/// ```text
/// T = 1/2*(m*a^2 + J)*der(theta)^2
/// ```
pub fn kinetic_energy<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, v: &[S; 4]) -> S {
    let theta_dot = v[0];
    theta_dot * (theta_dot * p.k7)
}

/// Potential energy `V`, in J.
///
/// ```text
/// V = m*a*g*sin(theta)
/// ```
pub fn potential_energy<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 4]) -> S {
    let theta = q[0];
    let sin_theta = theta.sin();
    p.k8 * sin_theta
}

/// Energy `E` that states of first order store, in J.
///
/// ```text
/// E = 1/2*L*i^2
/// ```
pub fn state_energy<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, v: &[S; 4]) -> S {
    let i_dot = v[1];
    i_dot * (i_dot * p.k5)
}

/// Dissipation function `D`, in W.
///
/// ```text
/// D = 1/2*b*der(theta)^2
/// ```
pub fn dissipation<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, v: &[S; 4]) -> S {
    let theta_dot = v[0];
    theta_dot * (theta_dot * p.k4)
}

/// Power `P` that drives, forces and inputs put in, in W.
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
    let t0 = p.k0 * theta_dot;
    let t1 = i_dot * p.R;
    let t2 = error_dot * p.ki - p.k1 * (theta - seen_dot);
    let t3 = i_dot * t1 + i_dot * (t2 - (seen_dot - u.wanted) * p.kp - (t0 + t1));
    t0 * i_dot + t3
}

/// Power `R` that dampers take out, in W.
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
    let t0 = error_dot * p.ki - p.k1 * (theta - seen_dot);
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

/// Names and units.
const PARAMETERS: [(&str, &str); 13] = [
    ("m", "kg"),
    ("a", "m"),
    ("J", "kg*m^2"),
    ("n", "1"),
    ("L", "H"),
    ("R", "ohm"),
    ("k", "N*m/A"),
    ("b", "N*m*s"),
    ("kp", "V"),
    ("ki", "V/s"),
    ("kd", "V*s"),
    ("tau", "s"),
    ("g", "m/s^2"),
];

/// Names and units.
const COORDINATES: [(&str, &str); 4] = [
    ("theta", "rad"),
    ("integral(i)", "A*s"),
    ("integral(seen)", "rad*s"),
    ("integral(error)", "rad*s*s"),
];

/// Names and units.
const INPUTS: [(&str, &str); 1] = [("wanted", "rad")];

/// Names and units.
const OUTPUTS: [(&str, &str); 1] = [("voltage", "V")];

impl ::lagrangian::emitted::Machine for PositionServo {
    type System = Prepared;

    fn name(&self) -> &str {
        "PositionServo"
    }

    fn parameters(
        &self,
    ) -> impl ExactSizeIterator<Item = (::lagrangian::emitted::Quantity<'_>, f64)> {
        let values = [
            self.m, self.a, self.J, self.n, self.L, self.R, self.k, self.b, self.kp, self.ki,
            self.kd, self.tau, self.g,
        ];
        quantities(&PARAMETERS, values)
    }

    fn parameter_mut(&mut self, index: usize) -> Option<&mut f64> {
        match index {
            0 => Some(&mut self.m),
            1 => Some(&mut self.a),
            2 => Some(&mut self.J),
            3 => Some(&mut self.n),
            4 => Some(&mut self.L),
            5 => Some(&mut self.R),
            6 => Some(&mut self.k),
            7 => Some(&mut self.b),
            8 => Some(&mut self.kp),
            9 => Some(&mut self.ki),
            10 => Some(&mut self.kd),
            11 => Some(&mut self.tau),
            12 => Some(&mut self.g),
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
    type Vector = [f64; 4];
    type Matrix = [f64; 16];
    type Coordinates = Coordinates;
    type Inputs = Inputs;
    type Outputs = Outputs;
    const MAY_BE_CONSTRAINED: bool = false;
    const MAY_SLIDE: bool = false;
    const MAY_COLLIDE: bool = false;

    fn coordinates(&self) -> impl ExactSizeIterator<Item = ::lagrangian::emitted::Quantity<'_>> {
        COORDINATES.iter().map(quantity)
    }

    fn to_coordinates(&self, vector: &[f64; 4]) -> Coordinates {
        Coordinates::from_array(*vector)
    }

    fn to_vector(&self, coordinates: &Coordinates) -> [f64; 4] {
        coordinates.to_array()
    }

    fn accelerations(
        &self,
        _: f64,
        q: &[f64; 4],
        v: &[f64; 4],
        u: &Inputs,
        result: &mut [f64; 4],
    ) -> Result<(), ::lagrangian::emitted::Singular> {
        <f64 as ::lagrangian::emitted::Number>::run_in_place(
            Accelerations { p: self, q, v, u },
            result,
        )
    }

    fn mass_matrix(&self, _: f64, _: &[f64; 4], matrix: &mut [f64; 16]) {
        let rows = mass_matrix(self);
        for (to, from) in matrix.iter_mut().zip(rows.as_flattened()) {
            *to = *from;
        }
    }

    fn bias(&self, _: f64, _: &[f64; 4], _: &[f64; 4], result: &mut [f64; 4]) {
        *result = [0.0; 4];
    }

    fn applied(&self, _: f64, q: &[f64; 4], v: &[f64; 4], u: &Inputs, result: &mut [f64; 4]) {
        *result = applied(self, q, v, u);
    }

    fn forces(&self, _: f64, q: &[f64; 4], v: &[f64; 4], u: &Inputs, result: &mut [f64; 4]) {
        *result = forces(self, q, v, u);
    }

    fn kinetic_energy(&self, _: f64, _: &[f64; 4], v: &[f64; 4]) -> f64 {
        kinetic_energy(self, v)
    }

    fn potential_energy(&self, _: f64, q: &[f64; 4], _: &Inputs) -> f64 {
        potential_energy(self, q)
    }

    fn state_energy(&self, _: f64, _: &[f64; 4], v: &[f64; 4]) -> f64 {
        state_energy(self, v)
    }

    fn dissipation(&self, _: f64, _: &[f64; 4], v: &[f64; 4], _: &Inputs) -> f64 {
        dissipation(self, v)
    }

    fn work_rate(&self, _: f64, q: &[f64; 4], v: &[f64; 4], _: &[f64; 4], u: &Inputs) -> f64 {
        work_rate(self, q, v, u)
    }

    fn dissipation_rate(&self, _: f64, _: &[f64; 4], v: &[f64; 4], _: &Inputs) -> f64 {
        dissipation_rate(self, v)
    }

    fn default_inputs(&self) -> Inputs {
        Inputs::default()
    }

    fn input_values(
        &self,
        inputs: &Inputs,
    ) -> impl ExactSizeIterator<Item = (::lagrangian::emitted::Quantity<'_>, f64)> {
        let values = [inputs.wanted];
        quantities(&INPUTS, values)
    }

    fn output_values(
        &self,
        outputs: &Outputs,
    ) -> impl ExactSizeIterator<Item = (::lagrangian::emitted::Quantity<'_>, f64)> {
        let values = [outputs.voltage];
        quantities(&OUTPUTS, values)
    }

    fn outputs(&self, _: f64, q: &[f64; 4], v: &[f64; 4], _: &[f64; 4], u: &Inputs) -> Outputs {
        outputs(self, q, v, u)
    }

    fn assumptions(
        &self,
        _: f64,
        _: &[f64; 4],
        _: &[f64; 4],
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
    type Vectors = [::lagrangian::emitted::Lanes<N>; 4];
    type BatchInputs = Inputs<::lagrangian::emitted::Lanes<N>>;

    fn batch(systems: [&Self; N]) -> Self::Batch {
        let lanes = |number: fn(&Self) -> f64| ::lagrangian::emitted::Lanes(systems.map(number));
        Prepared {
            R: lanes(|p| p.R),
            b: lanes(|p| p.b),
            kp: lanes(|p| p.kp),
            ki: lanes(|p| p.ki),
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
            singular: None,
        }
    }

    fn batch_inputs(inputs: [&Inputs; N]) -> Self::BatchInputs {
        let lanes = |number: fn(&Inputs) -> f64| ::lagrangian::emitted::Lanes(inputs.map(number));
        Inputs {
            wanted: lanes(|u| u.wanted),
        }
    }

    fn inputs_of_lane(inputs: &Self::BatchInputs, lane: usize) -> Inputs {
        Inputs {
            wanted: inputs.wanted[lane],
        }
    }

    fn is_singular(&self) -> bool {
        self.singular.is_some()
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

impl<S: ::lagrangian::emitted::Real> ::lagrangian::emitted::MachineIn<S> for PositionServo<S> {
    type System = Prepared<S>;

    fn prepare(&self) -> Prepared<S> {
        Self::prepare(self)
    }

    fn start(&self) -> ::lagrangian::emitted::State<Coordinates<S>> {
        Self::start(self)
    }
}

impl<S: ::lagrangian::emitted::Real> ::lagrangian::emitted::SystemIn<S> for Prepared<S> {
    type Vector = [S; 4];
    type Coordinates = Coordinates<S>;
    type Inputs = Inputs<S>;

    fn coordinates(&self) -> impl ExactSizeIterator<Item = ::lagrangian::emitted::Quantity<'_>> {
        COORDINATES.iter().map(quantity)
    }

    fn to_coordinates(&self, vector: &[S; 4]) -> Coordinates<S> {
        Coordinates::from_array(*vector)
    }

    fn to_vector(&self, coordinates: &Coordinates<S>) -> [S; 4] {
        coordinates.to_array()
    }

    fn default_inputs(&self) -> Inputs<S> {
        <Inputs>::default().map(S::from_f64)
    }

    fn accelerations(
        &self,
        _: S,
        q: &[S; 4],
        v: &[S; 4],
        u: &Inputs<S>,
        result: &mut [S; 4],
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

/// Whether elimination has left nothing but rounding errors of a diagonal element; so too if it is
/// no number.
fn vanishes<S: ::lagrangian::emitted::Scalar>(pivot: S, diagonal: S, share: f64) -> bool {
    let bound = S::from_f64(share) * diagonal;
    !pivot.exceeds(bound)
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
