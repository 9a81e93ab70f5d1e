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
    /// Torque by current, and voltage by rate: in SI units one number. Unit: `N*m/A`. Default:
    /// 0.05.
    pub k: S,
}

impl Default for DcMotor {
    fn default() -> Self {
        Self {
            J: 0.0002,
            m: 0.4,
            b: 0.0001,
            L: 0.002,
            R: 0.5,
            k: 0.05,
        }
    }
}

impl<S> DcMotor<S> {
    /// These values as other numbers.
    pub fn map<R>(self, f: impl Fn(S) -> R) -> DcMotor<R> {
        DcMotor {
            J: f(self.J),
            m: f(self.m),
            b: f(self.b),
            L: f(self.L),
            R: f(self.R),
            k: f(self.k),
        }
    }
}

impl<S: ::lagrangian::emitted::Scalar> DcMotor<S> {
    /// Computes what depends on the parameters alone, once.
    pub fn prepare(&self) -> Prepared<S> {
        let k0 = S::ONE / self.L;
        let k1 = self.b * S::from_f64(0.5);
        let k2 = self.L * S::from_f64(0.5);
        let k3 = self.J * S::from_f64(0.5);
        let k4 = -(S::ONE / self.J);
        let one = S::ONE;
        let singular = if vanishes(self.J, self.J, 1.7763568394002505e-15) {
            Some(singular(0, self.J, self.J))
        } else if vanishes(one, one, 1.7763568394002505e-15) {
            Some(singular(1, one, one))
        } else {
            None
        };
        Prepared {
            J: self.J,
            b: self.b,
            R: self.R,
            k: self.k,
            k0,
            k1,
            k2,
            k3,
            k4,
            singular,
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

impl<S: Copy> Coordinates<S> {
    /// The numbers in the order of the description: the order of `q` in every function here.
    pub fn to_array(self) -> [S; 2] {
        [self.phi, self.i]
    }

    /// Names for numbers in the order of the description.
    pub fn from_array(q: [S; 2]) -> Self {
        Self { phi: q[0], i: q[1] }
    }

    /// These values as other numbers.
    pub fn map<R>(self, f: impl Fn(S) -> R) -> Coordinates<R> {
        Coordinates {
            phi: f(self.phi),
            i: f(self.i),
        }
    }
}

/// What can be set while a [`DcMotor`] runs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Inputs<S = f64> {
    /// Voltage at the terminals. Unit: `V`. Default: 12.
    pub U: S,
}

impl Default for Inputs {
    fn default() -> Self {
        Self { U: 12.0 }
    }
}

impl<S> Inputs<S> {
    /// These values as other numbers.
    pub fn map<R>(self, f: impl Fn(S) -> R) -> Inputs<R> {
        Inputs { U: f(self.U) }
    }
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
    k0: S,
    /// `0.5*b`
    k1: S,
    /// `0.5*L`
    k2: S,
    /// `0.5*J`
    k3: S,
    /// `-1/J`
    k4: S,
    /// Why these parameters leave the machine without accelerations, if they do.
    singular: Option<::lagrangian::emitted::Singular>,
}

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
    let q_i = p.k0 * (u.U - p.k * phi_dot - i_dot * p.R);
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
    let f_i = p.k0 * (u.U - p.k * phi_dot - i_dot * p.R);
    [f_phi, f_i]
}

/// Accelerations `a`, the solution of `M a = f` eliminated along the machine.
///
/// A pivot that vanishes is an error.
pub fn accelerations<S: ::lagrangian::emitted::Number>(
    p: &Prepared<S>,
    v: &[S; 2],
    u: &Inputs<S>,
) -> Result<[S; 2], ::lagrangian::emitted::Singular> {
    S::run(Accelerations { p, v, u })
}

/// A call of [`accelerations`], to be run with whatever instructions the processor has.
pub struct Accelerations<'a, S> {
    /// As `accelerations` takes it.
    pub p: &'a Prepared<S>,
    /// As `accelerations` takes it.
    pub v: &'a [S; 2],
    /// As `accelerations` takes it.
    pub u: &'a Inputs<S>,
}

impl<S: Copy> ::lagrangian::emitted::scalar::Kernel<S> for Accelerations<'_, S> {
    type Output = Result<[S; 2], ::lagrangian::emitted::Singular>;

    #[inline(always)]
    fn run<N: ::lagrangian::emitted::Scalar<Stored = S>>(self) -> Self::Output {
        let Self { p, v, u } = self;
        let n = N::load;
        if let Some(singular) = p.singular {
            return Err(singular);
        }
        let phi_dot = n(v[0]);
        let i_dot = n(v[1]);
        let t0 = n(p.k).neg_mul_add(phi_dot, n(u.U));
        let phi_ddot = n(p.k4) * phi_dot.mul_sub(n(p.b), i_dot * n(p.k));
        let i_ddot = n(p.k0) * i_dot.neg_mul_add(n(p.R), t0);
        let accelerations = [phi_ddot.store(), i_ddot.store()];
        Ok(accelerations)
    }
}

/// Kinetic energy `T`, in J.
///
/// ```text
/// T = 1/2*J*der(phi)^2
/// ```
pub fn kinetic_energy<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, v: &[S; 2]) -> S {
    let phi_dot = v[0];
    phi_dot * (phi_dot * p.k3)
}

/// Energy `E` that states of first order store, in J.
///
/// ```text
/// E = 1/2*L*i^2
/// ```
pub fn state_energy<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, v: &[S; 2]) -> S {
    let i_dot = v[1];
    i_dot * (i_dot * p.k2)
}

/// Dissipation function `D`, in W.
///
/// ```text
/// D = 1/2*b*der(phi)^2
/// ```
pub fn dissipation<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, v: &[S; 2]) -> S {
    let phi_dot = v[0];
    phi_dot * (phi_dot * p.k1)
}

/// Power `P` that drives, forces and inputs put in, in W.
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

/// Power `R` that dampers take out, in W.
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

/// Names and units.
const PARAMETERS: [(&str, &str); 6] = [
    ("J", "kg*m^2"),
    ("m", "kg"),
    ("b", "N*m*s"),
    ("L", "H"),
    ("R", "ohm"),
    ("k", "N*m/A"),
];

/// Names and units.
const COORDINATES: [(&str, &str); 2] = [("phi", "rad"), ("integral(i)", "A*s")];

/// Names and units.
const INPUTS: [(&str, &str); 1] = [("U", "V")];

/// Names and units.
const OUTPUTS: [(&str, &str); 1] = [("supplied", "W")];

impl ::lagrangian::emitted::Machine for DcMotor {
    type System = Prepared;

    fn name(&self) -> &str {
        "DcMotor"
    }

    fn parameters(
        &self,
    ) -> impl ExactSizeIterator<Item = (::lagrangian::emitted::Quantity<'_>, f64)> {
        let values = [self.J, self.m, self.b, self.L, self.R, self.k];
        quantities(&PARAMETERS, values)
    }

    fn parameter_mut(&mut self, index: usize) -> Option<&mut f64> {
        match index {
            0 => Some(&mut self.J),
            1 => Some(&mut self.m),
            2 => Some(&mut self.b),
            3 => Some(&mut self.L),
            4 => Some(&mut self.R),
            5 => Some(&mut self.k),
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
        _: &[f64; 2],
        v: &[f64; 2],
        u: &Inputs,
        result: &mut [f64; 2],
    ) -> Result<(), ::lagrangian::emitted::Singular> {
        <f64 as ::lagrangian::emitted::Number>::run_in_place(
            Accelerations { p: self, v, u },
            result,
        )
    }

    fn mass_matrix(&self, _: f64, _: &[f64; 2], matrix: &mut [f64; 4]) {
        let rows = mass_matrix(self);
        for (to, from) in matrix.iter_mut().zip(rows.as_flattened()) {
            *to = *from;
        }
    }

    fn bias(&self, _: f64, _: &[f64; 2], _: &[f64; 2], result: &mut [f64; 2]) {
        *result = [0.0; 2];
    }

    fn applied(&self, _: f64, _: &[f64; 2], v: &[f64; 2], u: &Inputs, result: &mut [f64; 2]) {
        *result = applied(self, v, u);
    }

    fn forces(&self, _: f64, _: &[f64; 2], v: &[f64; 2], u: &Inputs, result: &mut [f64; 2]) {
        *result = forces(self, v, u);
    }

    fn kinetic_energy(&self, _: f64, _: &[f64; 2], v: &[f64; 2]) -> f64 {
        kinetic_energy(self, v)
    }

    fn potential_energy(&self, _: f64, _: &[f64; 2], _: &Inputs) -> f64 {
        0.0
    }

    fn state_energy(&self, _: f64, _: &[f64; 2], v: &[f64; 2]) -> f64 {
        state_energy(self, v)
    }

    fn dissipation(&self, _: f64, _: &[f64; 2], v: &[f64; 2], _: &Inputs) -> f64 {
        dissipation(self, v)
    }

    fn work_rate(&self, _: f64, _: &[f64; 2], v: &[f64; 2], _: &[f64; 2], u: &Inputs) -> f64 {
        work_rate(self, v, u)
    }

    fn dissipation_rate(&self, _: f64, _: &[f64; 2], v: &[f64; 2], _: &Inputs) -> f64 {
        dissipation_rate(self, v)
    }

    fn default_inputs(&self) -> Inputs {
        Inputs::default()
    }

    fn input_values(
        &self,
        inputs: &Inputs,
    ) -> impl ExactSizeIterator<Item = (::lagrangian::emitted::Quantity<'_>, f64)> {
        let values = [inputs.U];
        quantities(&INPUTS, values)
    }

    fn output_values(
        &self,
        outputs: &Outputs,
    ) -> impl ExactSizeIterator<Item = (::lagrangian::emitted::Quantity<'_>, f64)> {
        let values = [outputs.supplied];
        quantities(&OUTPUTS, values)
    }

    fn outputs(&self, _: f64, _: &[f64; 2], v: &[f64; 2], _: &[f64; 2], u: &Inputs) -> Outputs {
        outputs(v, u)
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
            J: lanes(|p| p.J),
            b: lanes(|p| p.b),
            R: lanes(|p| p.R),
            k: lanes(|p| p.k),
            k0: lanes(|p| p.k0),
            k1: lanes(|p| p.k1),
            k2: lanes(|p| p.k2),
            k3: lanes(|p| p.k3),
            k4: lanes(|p| p.k4),
            singular: None,
        }
    }

    fn batch_inputs(inputs: [&Inputs; N]) -> Self::BatchInputs {
        let lanes = |number: fn(&Inputs) -> f64| ::lagrangian::emitted::Lanes(inputs.map(number));
        Inputs { U: lanes(|u| u.U) }
    }

    fn inputs_of_lane(inputs: &Self::BatchInputs, lane: usize) -> Inputs {
        Inputs { U: inputs.U[lane] }
    }

    fn is_singular(&self) -> bool {
        self.singular.is_some()
    }

    fn batch_accelerations(
        p: &Self::Batch,
        _: ::lagrangian::emitted::Lanes<N>,
        _: &Self::Vectors,
        v: &Self::Vectors,
        u: &Self::BatchInputs,
        result: &mut Self::Vectors,
    ) -> Result<(), ::lagrangian::emitted::Singular> {
        <::lagrangian::emitted::Lanes<N> as ::lagrangian::emitted::Number>::run_in_place(
            Accelerations { p, v, u },
            result,
        )
    }
}

impl<S: ::lagrangian::emitted::Real> ::lagrangian::emitted::MachineIn<S> for DcMotor<S> {
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
        _: &[S; 2],
        v: &[S; 2],
        u: &Inputs<S>,
        result: &mut [S; 2],
    ) -> Result<(), ::lagrangian::emitted::Singular> {
        <S as ::lagrangian::emitted::Number>::run_in_place(Accelerations { p: self, v, u }, result)
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
