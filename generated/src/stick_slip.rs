// @generated from machines/stick_slip.machine by `cargo xtask generate`; edits are lost.

//! A block on a moving belt, held by a spring: the belt drags it along until the spring tears it
//! loose, it slips back, and is caught again.
//!
//! 1 coordinate, 6 parameters. Arithmetic of one call:
//!
//! | function | mul | add | div | sin cos | other | temporaries |
//! | --- | --: | --: | --: | --: | --: | --: |
//! | `prepare` | 3 | 1 | 1 | 0 | 0 | 5 |
//! | `applied` | 1 | 0 | 0 | 0 | 0 | 1 |
//! | `forces` | 1 | 0 | 0 | 0 | 0 | 1 |
//! | `slips` | 0 | 1 | 0 | 0 | 0 | 1 |
//! | `friction` | 2 | 1 | 0 | 0 | 0 | 3 |
//! | `kinetic_energy` | 2 | 0 | 0 | 0 | 0 | 2 |
//! | `potential_energy` | 2 | 0 | 0 | 0 | 0 | 2 |
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

/// A block on a moving belt, held by a spring: the belt drags it along until the spring tears it
/// loose, it slips back, and is caught again.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StickSlip<S = f64> {
    /// Mass of the block. Unit: `kg`. Default: 1.
    pub m: S,
    /// Stiffness of the spring. Unit: `N/m`. Default: 1.
    pub k: S,
    /// Speed of the belt. Unit: `m/s`. Default: 0.2.
    pub v_b: S,
    /// Coefficient of friction while the block slips. Unit: `1`. Default: 0.5.
    pub mu: S,
    /// Coefficient of friction while it sticks. Unit: `1`. Default: 1.
    pub mu0: S,
    /// Acceleration of gravity. Unit: `m/s^2`. Default: 1.
    pub g: S,
}

impl Default for StickSlip {
    fn default() -> Self {
        Self {
            m: 1.0,
            k: 1.0,
            v_b: 0.2,
            mu: 0.5,
            mu0: 1.0,
            g: 1.0,
        }
    }
}

impl<S> StickSlip<S> {
    /// These values as other numbers.
    pub fn map<R>(self, f: impl Fn(S) -> R) -> StickSlip<R> {
        StickSlip {
            m: f(self.m),
            k: f(self.k),
            v_b: f(self.v_b),
            mu: f(self.mu),
            mu0: f(self.mu0),
            g: f(self.g),
        }
    }
}

impl<S: ::lagrangian::emitted::Scalar> StickSlip<S> {
    /// Computes what depends on the parameters alone, once.
    pub fn prepare(&self) -> Prepared<S> {
        let k0 = self.m * S::from_f64(0.5);
        let k1 = self.k * S::from_f64(0.5);
        let k2 = -self.k;
        let k3 = self.m * self.g;
        let k4 = S::ONE / self.m;
        let singular = if vanishes(self.m, self.m, 8.881784197001252e-16) {
            Some(singular(0, self.m, self.m))
        } else {
            None
        };
        Prepared {
            m: self.m,
            k: self.k,
            v_b: self.v_b,
            k0,
            k1,
            k2,
            k3,
            mu: self.mu,
            mu0: self.mu0,
            k4,
            singular,
        }
    }

    /// The start values of the description, at rest and `t = 0`.
    pub fn start(&self) -> ::lagrangian::emitted::State<Coordinates<S>> {
        let zero = S::ZERO;
        let q = [zero];
        let v = [S::ZERO; 1];
        ::lagrangian::emitted::State {
            t: 0.0,
            q: Coordinates::from_array(q),
            v: Coordinates::from_array(v),
        }
    }
}

/// The coordinates of [`StickSlip`], or their rates, by name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coordinates<S = f64> {
    /// Stretch of the spring. Unit: `m`.
    pub x: S,
}

impl<S: Copy> Coordinates<S> {
    /// The numbers in the order of the description: the order of `q` in every function here.
    pub fn to_array(self) -> [S; 1] {
        [self.x]
    }

    /// Names for numbers in the order of the description.
    pub fn from_array(q: [S; 1]) -> Self {
        Self { x: q[0] }
    }

    /// These values as other numbers.
    pub fn map<R>(self, f: impl Fn(S) -> R) -> Coordinates<R> {
        Coordinates { x: f(self.x) }
    }
}

/// What can be set while a [`StickSlip`] runs.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Inputs {}

/// What can be observed of a [`StickSlip`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Outputs {}

/// The parameters of a [`StickSlip`], with the work done that depends on them alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prepared<S = f64> {
    /// `m`
    m: S,
    /// `k`
    k: S,
    /// `v_b`
    v_b: S,
    /// `0.5*m`
    k0: S,
    /// `0.5*k`
    k1: S,
    /// `-k`
    k2: S,
    /// `m*g`
    k3: S,
    /// `mu`
    mu: S,
    /// `mu0`
    mu0: S,
    /// `1/m`
    k4: S,
    /// Why these parameters leave the machine without accelerations, if they do.
    singular: Option<::lagrangian::emitted::Singular>,
}

/// Mass matrix `M`.
///
/// ```text
/// M[x, x] = m
/// ```
pub fn mass_matrix<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>) -> [[S; 1]; 1] {
    [[p.m]]
}

/// Applied generalized forces `Q`.
///
/// ```text
/// Q[x] = -k*x
/// ```
pub fn applied<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 1]) -> [S; 1] {
    let x = q[0];
    let q_x = p.k2 * x;
    [q_x]
}

/// Right-hand side `f = Q - h` of `M a = f`.
pub fn forces<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 1]) -> [S; 1] {
    let x = q[0];
    let f_x = p.k2 * x;
    [f_x]
}

/// Slips `w` of the guided contacts, in m/s.
///
/// ```text
/// w[belt] = der(x) - v_b
/// ```
pub fn slips<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, v: &[S; 1]) -> [S; 1] {
    let x_dot = v[0];
    let w1 = x_dot - p.v_b;
    [w1]
}

/// Slip matrix `tau`, the derivatives of the slips by the rates.
///
/// ```text
/// tau[belt, x] = 1
/// ```
pub fn slip_matrix<S: ::lagrangian::emitted::Scalar>() -> [S; 1] {
    let one = S::ONE;
    [one]
}

/// What there is without friction, and what a unit of each friction force adds to it:
/// accelerations, multipliers, `dw/dt` and the normal reaction of each contact; behind these the
/// coefficients of friction. A machine with contacts has this in place of accelerations and
/// multipliers.
///
/// A pivot that vanishes is an error.
pub fn friction<S: ::lagrangian::emitted::Number>(
    p: &Prepared<S>,
    q: &[S; 1],
) -> Result<[S; 8], ::lagrangian::emitted::Singular> {
    S::run(Friction { p, q })
}

/// A call of [`friction`], to be run with whatever instructions the processor has.
pub struct Friction<'a, S> {
    /// As `friction` takes it.
    pub p: &'a Prepared<S>,
    /// As `friction` takes it.
    pub q: &'a [S; 1],
}

impl<S: Copy> ::lagrangian::emitted::scalar::Kernel<S> for Friction<'_, S> {
    type Output = Result<[S; 8], ::lagrangian::emitted::Singular>;

    #[inline(always)]
    fn run<N: ::lagrangian::emitted::Scalar<Stored = S>>(self) -> Self::Output {
        let Self { p, q } = self;
        let n = N::load;
        if let Some(singular) = p.singular {
            return Err(singular);
        }
        let x = n(q[0]);
        let r0 = -(n(p.k4) * (x * n(p.k)));
        let zero = N::ZERO;
        let friction = [
            r0.store(),
            r0.store(),
            n(p.k3).store(),
            n(p.k4).store(),
            n(p.k4).store(),
            zero.store(),
            n(p.mu).store(),
            n(p.mu0).store(),
        ];
        Ok(friction)
    }
}

/// Kinetic energy `T`, in J.
///
/// ```text
/// T = 1/2*m*der(x)^2
/// ```
pub fn kinetic_energy<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, v: &[S; 1]) -> S {
    let x_dot = v[0];
    x_dot * (x_dot * p.k0)
}

/// Potential energy `V`, in J.
///
/// ```text
/// V = 1/2*k*x^2
/// ```
pub fn potential_energy<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 1]) -> S {
    let x = q[0];
    x * (x * p.k1)
}

/// Names and units.
const PARAMETERS: [(&str, &str); 6] = [
    ("m", "kg"),
    ("k", "N/m"),
    ("v_b", "m/s"),
    ("mu", "1"),
    ("mu0", "1"),
    ("g", "m/s^2"),
];

/// Names and units.
const COORDINATES: [(&str, &str); 1] = [("x", "m")];

/// Names and units.
const INPUTS: [(&str, &str); 0] = [];

/// Names and units.
const OUTPUTS: [(&str, &str); 0] = [];

/// The names of the contacts that stick and slide.
const CONTACTS: [&str; 1] = ["belt"];

impl ::lagrangian::emitted::Machine for StickSlip {
    type System = Prepared;

    fn name(&self) -> &str {
        "StickSlip"
    }

    fn parameters(
        &self,
    ) -> impl ExactSizeIterator<Item = (::lagrangian::emitted::Quantity<'_>, f64)> {
        let values = [self.m, self.k, self.v_b, self.mu, self.mu0, self.g];
        quantities(&PARAMETERS, values)
    }

    fn parameter_mut(&mut self, index: usize) -> Option<&mut f64> {
        match index {
            0 => Some(&mut self.m),
            1 => Some(&mut self.k),
            2 => Some(&mut self.v_b),
            3 => Some(&mut self.mu),
            4 => Some(&mut self.mu0),
            5 => Some(&mut self.g),
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
        t: f64,
        q: &[f64; 1],
        v: &[f64; 1],
        u: &Inputs,
        result: &mut [f64; 1],
    ) -> Result<(), ::lagrangian::emitted::Singular> {
        ::lagrangian::emitted::accelerations_with_friction(self, t, q, v, u, result)
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

    fn slips(&self, _: f64, _: &[f64; 1], v: &[f64; 1], to: &mut [f64]) {
        fill(to, &slips(self, v));
    }

    fn slip_matrix(&self, _: f64, _: &[f64; 1], to: &mut [f64]) {
        fill(to, &slip_matrix());
    }

    fn slip_drift(&self, _: f64, _: &[f64; 1], _: &[f64; 1], to: &mut [f64]) {
        to.fill(0.0);
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
        _: &Outputs,
    ) -> impl ExactSizeIterator<Item = (::lagrangian::emitted::Quantity<'_>, f64)> {
        let values = [];
        quantities(&OUTPUTS, values)
    }

    fn outputs(&self, _: f64, _: &[f64; 1], _: &[f64; 1], _: &[f64; 1], _: &Inputs) -> Outputs {
        Outputs {}
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

    fn contacts(&self) -> impl ExactSizeIterator<Item = &str> {
        CONTACTS.iter().copied()
    }

    fn slip_ranges(&self, _: f64, _: &[f64; 1], v: &[f64; 1], ranges: &mut [[f64; 2]]) {
        let between = ::lagrangian::emitted::scalar::Interval::new;
        let near = |x: f64| between(x.next_down(), x.next_up());
        let p = Prepared {
            m: near(self.m),
            k: near(self.k),
            v_b: near(self.v_b),
            k0: near(self.k0),
            k1: near(self.k1),
            k2: near(self.k2),
            k3: near(self.k3),
            mu: near(self.mu),
            mu0: near(self.mu0),
            k4: near(self.k4),
            singular: self.singular,
        };
        let slips: [::lagrangian::emitted::scalar::Interval; _] = slips(&p, &v.map(near));
        for (range, w) in ranges.iter_mut().zip(slips) {
            *range = [w.lo(), w.hi()];
        }
    }

    fn friction(
        &self,
        _: f64,
        q: &[f64; 1],
        _: &[f64; 1],
        _: &Inputs,
        to: &mut [f64],
    ) -> Result<(), ::lagrangian::emitted::Singular> {
        fill(to, &friction(self, q)?);
        Ok(())
    }

    fn with_workspace<R>(&self, length: usize, work: impl FnOnce(Option<&mut [f64]>) -> R) -> R {
        let mut room = [0.0; ::lagrangian::emitted::contact_workspace(1, 0, 1)];
        work(room.get_mut(..length))
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

/// Writes numbers where there is room for them.
fn fill(to: &mut [f64], from: &[f64]) {
    for (to, from) in to.iter_mut().zip(from) {
        *to = *from;
    }
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
