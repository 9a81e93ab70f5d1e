// @generated from machines/simple_pendulum.machine by `cargo xtask generate`; edits are lost.

//! A point mass on a massless rod that turns on a fixed pivot, in a vertical plane.
//!
//! Energy is conserved. With w = sqrt(g/l) a swing of amplitude A has the period 4 K(k)/w,
//! where K is the complete elliptic integral of modulus k = sin(A/2), and from rest it moves as
//! sin(theta/2) = k cd(w t). Small swings take 2 pi/w, all of one length (C. Huygens, 1673); a
//! swing of 90 degrees takes 18 % longer, and at 180 degrees the period is infinite: the
//! pendulum that comes to rest upside down moves as theta = 4 atan(exp(w t)) - pi. Faster ones
//! turn over and over. E. T. Whittaker, Analytical Dynamics, 4th ed. 1937, section 44.
//!
//! 1 coordinate, 3 parameters, 1 output. Arithmetic of one call:
//!
//! | function | mul | add | div | sin cos | other | temporaries |
//! | --- | --: | --: | --: | --: | --: | --: |
//! | `prepare` | 4 | 2 | 1 | 0 | 0 | 7 |
//! | `start` | 1 | 0 | 0 | 0 | 0 | 1 |
//! | `applied` | 1 | 0 | 0 | 1 | 0 | 2 |
//! | `forces` | 1 | 0 | 0 | 1 | 0 | 2 |
//! | `accelerations` | 1 | 0 | 0 | 1 | 0 | 2 |
//! | `kinetic_energy` | 2 | 0 | 0 | 0 | 0 | 2 |
//! | `potential_energy` | 1 | 0 | 0 | 1 | 0 | 2 |
//! | `output_tension` | 4 | 1 | 0 | 1 | 0 | 6 |
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

/// A point mass on a massless rod that turns on a fixed pivot, in a vertical plane.
///
/// Energy is conserved. With w = sqrt(g/l) a swing of amplitude A has the period 4 K(k)/w,
/// where K is the complete elliptic integral of modulus k = sin(A/2), and from rest it moves as
/// sin(theta/2) = k cd(w t). Small swings take 2 pi/w, all of one length (C. Huygens, 1673); a
/// swing of 90 degrees takes 18 % longer, and at 180 degrees the period is infinite: the
/// pendulum that comes to rest upside down moves as theta = 4 atan(exp(w t)) - pi. Faster ones
/// turn over and over. E. T. Whittaker, Analytical Dynamics, 4th ed. 1937, section 44.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SimplePendulum<S = f64> {
    /// Mass of the bob. It cancels: light and heavy bobs swing alike. Unit: `kg`. Default: 1.
    pub m: S,
    /// Length of the rod. Unit: `m`. Default: 1.
    pub l: S,
    /// Acceleration of gravity. Unit: `m/s^2`. Default: 9.81.
    pub g: S,
}

impl Default for SimplePendulum {
    fn default() -> Self {
        Self {
            m: 1.0,
            l: 1.0,
            g: 9.81,
        }
    }
}

impl<S> SimplePendulum<S> {
    /// These values as other numbers.
    pub fn map<R>(self, f: impl Fn(S) -> R) -> SimplePendulum<R> {
        SimplePendulum {
            m: f(self.m),
            l: f(self.l),
            g: f(self.g),
        }
    }
}

impl<S: ::lagrangian::emitted::Scalar> SimplePendulum<S> {
    /// Computes what depends on the parameters alone, once.
    pub fn prepare(&self) -> Prepared<S> {
        let t0 = self.m * self.l;
        let k0 = self.l * t0;
        let k1 = k0 * S::from_f64(0.5);
        let k2 = -(self.g * t0);
        let k3 = -(self.g / self.l);
        let singular = if vanishes(k0, k0, 8.881784197001252e-16) {
            Some(singular(0, k0, k0))
        } else {
            None
        };
        Prepared {
            m: self.m,
            l: self.l,
            g: self.g,
            k0,
            k1,
            k2,
            k3,
            singular,
        }
    }

    /// The start values of the description, at rest and `t = 0`.
    pub fn start(&self) -> ::lagrangian::emitted::State<Coordinates<S>> {
        let theta = S::pi() * S::from_f64(0.5);
        let q = [theta];
        let v = [S::ZERO; 1];
        ::lagrangian::emitted::State {
            t: 0.0,
            q: Coordinates::from_array(q),
            v: Coordinates::from_array(v),
        }
    }
}

/// The coordinates of [`SimplePendulum`], or their rates, by name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coordinates<S = f64> {
    /// Angle of the rod from the downward vertical. Unit: `rad`.
    pub theta: S,
}

impl<S: Copy> Coordinates<S> {
    /// The numbers in the order of the description: the order of `q` in every function here.
    pub fn to_array(self) -> [S; 1] {
        [self.theta]
    }

    /// Names for numbers in the order of the description.
    pub fn from_array(q: [S; 1]) -> Self {
        Self { theta: q[0] }
    }

    /// These values as other numbers.
    pub fn map<R>(self, f: impl Fn(S) -> R) -> Coordinates<R> {
        Coordinates {
            theta: f(self.theta),
        }
    }
}

/// What can be set while a [`SimplePendulum`] runs.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Inputs {}

/// What can be observed of a [`SimplePendulum`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outputs<S = f64> {
    /// Tension of the rod; negative where the bob presses on it. It is 3 m g at the bottom
    /// of a swing from 90 degrees. Unit: `N`.
    pub tension: S,
}

/// The parameters of a [`SimplePendulum`], with the work done that depends on them alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prepared<S = f64> {
    /// `m`
    m: S,
    /// `l`
    l: S,
    /// `g`
    g: S,
    /// `m*l^2`
    k0: S,
    /// `0.5*m*l^2`
    k1: S,
    /// `-m*l*g`
    k2: S,
    /// `-g/l`
    k3: S,
    /// Why these parameters leave the machine without accelerations, if they do.
    singular: Option<::lagrangian::emitted::Singular>,
}

/// Mass matrix `M`.
///
/// ```text
/// M[theta, theta] = m*l^2
/// ```
pub fn mass_matrix<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>) -> [[S; 1]; 1] {
    [[p.k0]]
}

/// Applied generalized forces `Q`.
///
/// ```text
/// Q[theta] = -m*l*g*sin(theta)
/// ```
pub fn applied<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 1]) -> [S; 1] {
    let theta = q[0];
    let sin_theta = theta.sin();
    let q_theta = p.k2 * sin_theta;
    [q_theta]
}

/// Right-hand side `f = Q - h` of `M a = f`.
pub fn forces<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 1]) -> [S; 1] {
    let theta = q[0];
    let sin_theta = theta.sin();
    let f_theta = p.k2 * sin_theta;
    [f_theta]
}

/// Accelerations `a`, the solution of `M a = f` eliminated along the machine.
///
/// A pivot that vanishes is an error.
pub fn accelerations<S: ::lagrangian::emitted::Number>(
    p: &Prepared<S>,
    q: &[S; 1],
) -> Result<[S; 1], ::lagrangian::emitted::Singular> {
    S::run(Accelerations { p, q })
}

/// A call of [`accelerations`], to be run with whatever instructions the processor has.
pub struct Accelerations<'a, S> {
    /// As `accelerations` takes it.
    pub p: &'a Prepared<S>,
    /// As `accelerations` takes it.
    pub q: &'a [S; 1],
}

impl<S: Copy> ::lagrangian::emitted::scalar::Kernel<S> for Accelerations<'_, S> {
    type Output = Result<[S; 1], ::lagrangian::emitted::Singular>;

    #[inline(always)]
    fn run<N: ::lagrangian::emitted::Scalar<Stored = S>>(self) -> Self::Output {
        let Self { p, q } = self;
        let n = N::load;
        if let Some(singular) = p.singular {
            return Err(singular);
        }
        let theta = n(q[0]);
        let sin_theta = theta.sin();
        let theta_ddot = n(p.k3) * sin_theta;
        let accelerations = [theta_ddot.store()];
        Ok(accelerations)
    }
}

/// Kinetic energy `T`, in J.
///
/// ```text
/// T = 1/2*m*l^2*der(theta)^2
/// ```
pub fn kinetic_energy<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, v: &[S; 1]) -> S {
    let theta_dot = v[0];
    theta_dot * (theta_dot * p.k1)
}

/// Potential energy `V`, in J.
///
/// ```text
/// V = -m*l*g*cos(theta)
/// ```
pub fn potential_energy<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 1]) -> S {
    let theta = q[0];
    let cos_theta = theta.cos();
    p.k2 * cos_theta
}

/// Tension of the rod; negative where the bob presses on it. It is 3 m g at the bottom
/// of a swing from 90 degrees. Unit: `N`.
///
/// ```text
/// tension = m*l*der(theta)^2 + m*g*cos(theta)
/// ```
pub fn output_tension<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 1],
    v: &[S; 1],
) -> S {
    let theta = q[0];
    let theta_dot = v[0];
    let cos_theta = theta.cos();
    (theta_dot * (theta_dot * p.l) + cos_theta * p.g) * p.m
}

/// Everything that the description asks to observe.
pub fn outputs<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 1],
    v: &[S; 1],
) -> Outputs<S> {
    Outputs {
        tension: output_tension(p, q, v),
    }
}

/// Names and units.
const PARAMETERS: [(&str, &str); 3] = [("m", "kg"), ("l", "m"), ("g", "m/s^2")];

/// Names and units.
const COORDINATES: [(&str, &str); 1] = [("theta", "rad")];

/// Names and units.
const INPUTS: [(&str, &str); 0] = [];

/// Names and units.
const OUTPUTS: [(&str, &str); 1] = [("tension", "N")];

impl ::lagrangian::emitted::Machine for SimplePendulum {
    type System = Prepared;

    fn name(&self) -> &str {
        "SimplePendulum"
    }

    fn parameters(
        &self,
    ) -> impl ExactSizeIterator<Item = (::lagrangian::emitted::Quantity<'_>, f64)> {
        let values = [self.m, self.l, self.g];
        quantities(&PARAMETERS, values)
    }

    fn parameter_mut(&mut self, index: usize) -> Option<&mut f64> {
        match index {
            0 => Some(&mut self.m),
            1 => Some(&mut self.l),
            2 => Some(&mut self.g),
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
    type Vector = [f64; 1];
    type Matrix = [f64; 1];
    type Coordinates = Coordinates;
    type Inputs = Inputs;
    type Outputs = Outputs;
    const MAY_BE_CONSTRAINED: bool = false;
    const MAY_SLIDE: bool = false;
    const MAY_COLLIDE: bool = false;

    fn coordinates(&self) -> impl ExactSizeIterator<Item = ::lagrangian::emitted::Quantity<'_>> {
        COORDINATES.iter().map(quantity)
    }

    fn to_coordinates(&self, vector: &[f64; 1]) -> Coordinates {
        Coordinates::from_array(*vector)
    }

    fn to_vector(&self, coordinates: &Coordinates) -> [f64; 1] {
        coordinates.to_array()
    }

    fn accelerations(
        &self,
        _: f64,
        q: &[f64; 1],
        _: &[f64; 1],
        _: &Inputs,
        result: &mut [f64; 1],
    ) -> Result<(), ::lagrangian::emitted::Singular> {
        <f64 as ::lagrangian::emitted::Number>::run_in_place(Accelerations { p: self, q }, result)
    }

    fn mass_matrix(&self, _: f64, _: &[f64; 1], matrix: &mut [f64; 1]) {
        let rows = mass_matrix(self);
        for (to, from) in matrix.iter_mut().zip(rows.as_flattened()) {
            *to = *from;
        }
    }

    fn bias(&self, _: f64, _: &[f64; 1], _: &[f64; 1], result: &mut [f64; 1]) {
        *result = [0.0; 1];
    }

    fn applied(&self, _: f64, q: &[f64; 1], _: &[f64; 1], _: &Inputs, result: &mut [f64; 1]) {
        *result = applied(self, q);
    }

    fn forces(&self, _: f64, q: &[f64; 1], _: &[f64; 1], _: &Inputs, result: &mut [f64; 1]) {
        *result = forces(self, q);
    }

    fn kinetic_energy(&self, _: f64, _: &[f64; 1], v: &[f64; 1]) -> f64 {
        kinetic_energy(self, v)
    }

    fn potential_energy(&self, _: f64, q: &[f64; 1], _: &Inputs) -> f64 {
        potential_energy(self, q)
    }

    fn dissipation(&self, _: f64, _: &[f64; 1], _: &[f64; 1], _: &Inputs) -> f64 {
        0.0
    }

    fn work_rate(&self, _: f64, _: &[f64; 1], _: &[f64; 1], _: &[f64; 1], _: &Inputs) -> f64 {
        0.0
    }

    fn dissipation_rate(&self, _: f64, _: &[f64; 1], _: &[f64; 1], _: &Inputs) -> f64 {
        0.0
    }

    fn default_inputs(&self) -> Inputs {
        Inputs::default()
    }

    fn input_values(
        &self,
        _: &Inputs,
    ) -> impl ExactSizeIterator<Item = (::lagrangian::emitted::Quantity<'_>, f64)> {
        let values = [];
        quantities(&INPUTS, values)
    }

    fn output_values(
        &self,
        outputs: &Outputs,
    ) -> impl ExactSizeIterator<Item = (::lagrangian::emitted::Quantity<'_>, f64)> {
        let values = [outputs.tension];
        quantities(&OUTPUTS, values)
    }

    fn outputs(&self, _: f64, q: &[f64; 1], v: &[f64; 1], _: &[f64; 1], _: &Inputs) -> Outputs {
        outputs(self, q, v)
    }

    fn assumptions(
        &self,
        _: f64,
        _: &[f64; 1],
        _: &[f64; 1],
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
    type Vectors = [::lagrangian::emitted::Lanes<N>; 1];
    type BatchInputs = Inputs;

    fn batch(systems: [&Self; N]) -> Self::Batch {
        let lanes = |number: fn(&Self) -> f64| ::lagrangian::emitted::Lanes(systems.map(number));
        Prepared {
            m: lanes(|p| p.m),
            l: lanes(|p| p.l),
            g: lanes(|p| p.g),
            k0: lanes(|p| p.k0),
            k1: lanes(|p| p.k1),
            k2: lanes(|p| p.k2),
            k3: lanes(|p| p.k3),
            singular: None,
        }
    }

    fn batch_inputs(_: [&Inputs; N]) -> Self::BatchInputs {
        Inputs {}
    }

    fn inputs_of_lane(_: &Self::BatchInputs, _: usize) -> Inputs {
        Inputs {}
    }

    fn is_singular(&self) -> bool {
        self.singular.is_some()
    }

    fn batch_accelerations(
        p: &Self::Batch,
        _: ::lagrangian::emitted::Lanes<N>,
        q: &Self::Vectors,
        _: &Self::Vectors,
        _: &Self::BatchInputs,
        result: &mut Self::Vectors,
    ) -> Result<(), ::lagrangian::emitted::Singular> {
        <::lagrangian::emitted::Lanes<N> as ::lagrangian::emitted::Number>::run_in_place(
            Accelerations { p, q },
            result,
        )
    }
}

impl<S: ::lagrangian::emitted::Real> ::lagrangian::emitted::MachineIn<S> for SimplePendulum<S> {
    type System = Prepared<S>;

    fn prepare(&self) -> Prepared<S> {
        Self::prepare(self)
    }

    fn start(&self) -> ::lagrangian::emitted::State<Coordinates<S>> {
        Self::start(self)
    }
}

impl<S: ::lagrangian::emitted::Real> ::lagrangian::emitted::SystemIn<S> for Prepared<S> {
    type Vector = [S; 1];
    type Coordinates = Coordinates<S>;
    type Inputs = Inputs;

    fn coordinates(&self) -> impl ExactSizeIterator<Item = ::lagrangian::emitted::Quantity<'_>> {
        COORDINATES.iter().map(quantity)
    }

    fn to_coordinates(&self, vector: &[S; 1]) -> Coordinates<S> {
        Coordinates::from_array(*vector)
    }

    fn to_vector(&self, coordinates: &Coordinates<S>) -> [S; 1] {
        coordinates.to_array()
    }

    fn default_inputs(&self) -> Inputs {
        Inputs {}
    }

    fn accelerations(
        &self,
        _: S,
        q: &[S; 1],
        _: &[S; 1],
        _: &Inputs,
        result: &mut [S; 1],
    ) -> Result<(), ::lagrangian::emitted::Singular> {
        <S as ::lagrangian::emitted::Number>::run_in_place(Accelerations { p: self, q }, result)
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
