// @generated from machines/block_on_incline.machine by `cargo xtask generate`; edits are lost.

//! A block on an incline whose angle may grow with time: it sticks until tan α exceeds the
//! coefficient of friction, and then slides with what is left of its weight.
//!
//! 1 coordinate, 6 parameters. Arithmetic of one call:
//!
//! | function | mul | add | div | sin cos | other | temporaries |
//! | --- | --: | --: | --: | --: | --: | --: |
//! | `prepare` | 7 | 2 | 1 | 0 | 0 | 10 |
//! | `bias` | 1 | 0 | 0 | 0 | 0 | 1 |
//! | `applied` | 4 | 9 | 0 | 1 | 0 | 10 |
//! | `forces` | 5 | 10 | 0 | 1 | 0 | 12 |
//! | `friction` | 16 | 16 | 0 | 1 | 0 | 29 |
//! | `kinetic_energy` | 12 | 13 | 0 | 1 | 0 | 22 |
//! | `potential_energy` | 5 | 9 | 0 | 1 | 0 | 11 |
//! | `work_rate` | 16 | 16 | 0 | 1 | 0 | 29 |
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

/// A block on an incline whose angle may grow with time: it sticks until tan α exceeds the
/// coefficient of friction, and then slides with what is left of its weight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BlockOnIncline<S = f64> {
    /// Mass of the block. Unit: `kg`. Default: 2.
    pub m: S,
    /// Angle of the incline at t = 0. Unit: `rad`. Default: 0.3.
    pub alpha: S,
    /// How fast the incline is raised. Unit: `rad/s`. Default: 0.
    pub rate: S,
    /// Coefficient of friction while it slides. Unit: `1`. Default: 0.4.
    pub mu: S,
    /// Coefficient of friction while it sticks. Unit: `1`. Default: 0.5.
    pub mu0: S,
    /// Acceleration of gravity. Unit: `m/s^2`. Default: 9.81.
    pub g: S,
}

impl Default for BlockOnIncline {
    fn default() -> Self {
        Self {
            m: 2.0,
            alpha: 0.3,
            rate: 0.0,
            mu: 0.4,
            mu0: 0.5,
            g: 9.81,
        }
    }
}

impl<S> BlockOnIncline<S> {
    /// These values as other numbers.
    pub fn map<R>(self, f: impl Fn(S) -> R) -> BlockOnIncline<R> {
        BlockOnIncline {
            m: f(self.m),
            alpha: f(self.alpha),
            rate: f(self.rate),
            mu: f(self.mu),
            mu0: f(self.mu0),
            g: f(self.g),
        }
    }
}

impl<S: ::lagrangian::emitted::Scalar> BlockOnIncline<S> {
    /// Computes what depends on the parameters alone, once.
    pub fn prepare(&self) -> Prepared<S> {
        let k5 = self.m * self.rate;
        let k1 = self.m * self.g;
        let k6 = self.rate * k5;
        let k0 = self.m * S::from_f64(0.5);
        let k2 = self.rate * self.rate;
        let k3 = self.rate * S::from_f64(2.0);
        let k4 = self.g * k5;
        let k7 = -k6;
        let k8 = -k1;
        let k9 = S::ONE / self.m;
        let singular = if vanishes(self.m, self.m, 8.881784197001252e-16) {
            Some(singular(0, self.m, self.m))
        } else {
            None
        };
        Prepared {
            m: self.m,
            alpha: self.alpha,
            rate: self.rate,
            g: self.g,
            k0,
            k1,
            k2,
            k3,
            k4,
            k5,
            k6,
            k7,
            k8,
            mu: self.mu,
            mu0: self.mu0,
            k9,
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

/// The coordinates of [`BlockOnIncline`], or their rates, by name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coordinates<S = f64> {
    /// How far the block has slid down, along the incline. Unit: `m`.
    pub s: S,
}

impl<S: Copy> Coordinates<S> {
    /// The numbers in the order of the description: the order of `q` in every function here.
    pub fn to_array(self) -> [S; 1] {
        [self.s]
    }

    /// Names for numbers in the order of the description.
    pub fn from_array(q: [S; 1]) -> Self {
        Self { s: q[0] }
    }

    /// These values as other numbers.
    pub fn map<R>(self, f: impl Fn(S) -> R) -> Coordinates<R> {
        Coordinates { s: f(self.s) }
    }
}

/// What can be set while a [`BlockOnIncline`] runs.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Inputs {}

/// What can be observed of a [`BlockOnIncline`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Outputs {}

/// The parameters of a [`BlockOnIncline`], with the work done that depends on them alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prepared<S = f64> {
    /// `m`
    m: S,
    /// `alpha`
    alpha: S,
    /// `rate`
    rate: S,
    /// `g`
    g: S,
    /// `0.5*m`
    k0: S,
    /// `m*g`
    k1: S,
    /// `rate^2`
    k2: S,
    /// `2*rate`
    k3: S,
    /// `m*rate*g`
    k4: S,
    /// `m*rate`
    k5: S,
    /// `m*rate^2`
    k6: S,
    /// `-m*rate^2`
    k7: S,
    /// `-m*g`
    k8: S,
    /// `mu`
    mu: S,
    /// `mu0`
    mu0: S,
    /// `1/m`
    k9: S,
    /// Why these parameters leave the machine without accelerations, if they do.
    singular: Option<::lagrangian::emitted::Singular>,
}

/// Mass matrix `M`.
///
/// ```text
/// M[s, s] = m
/// ```
pub fn mass_matrix<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>) -> [[S; 1]; 1] {
    [[p.m]]
}

/// Bias `h`: velocity products and explicit time in the inertia forces.
///
/// ```text
/// h[s] = -m*rate^2*s
/// ```
pub fn bias<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 1]) -> [S; 1] {
    let s = q[0];
    let h_s = p.k7 * s;
    [h_s]
}

/// Applied generalized forces `Q`.
///
/// ```text
/// Q[s] = m*g*sin(rate*t + alpha)
/// ```
pub fn applied<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, t: S) -> [S; 1] {
    let t0 = p.rate * t;
    let t1 = t0 + p.alpha;
    let (sin_t1, cos_t1) = t1.sin_cos();
    let t2 = sin_t1 + (t0.sum_error(p.alpha) + p.rate.product_error(t)) * cos_t1;
    let q_s = p.k1 * t2;
    [q_s]
}

/// Right-hand side `f = Q - h` of `M a = f`.
pub fn forces<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, t: S, q: &[S; 1]) -> [S; 1] {
    let s = q[0];
    let t0 = p.rate * t;
    let t1 = t0 + p.alpha;
    let (sin_t1, cos_t1) = t1.sin_cos();
    let t2 = sin_t1 + (t0.sum_error(p.alpha) + p.rate.product_error(t)) * cos_t1;
    let f_s = p.k1 * t2 + p.k6 * s;
    [f_s]
}

/// Slips `w` of the guided contacts, in m/s.
///
/// ```text
/// w[face] = der(s)
/// ```
pub fn slips<S: ::lagrangian::emitted::Scalar>(v: &[S; 1]) -> [S; 1] {
    let s_dot = v[0];
    [s_dot]
}

/// Slip matrix `tau`, the derivatives of the slips by the rates.
///
/// ```text
/// tau[face, s] = 1
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
    t: S,
    q: &[S; 1],
    v: &[S; 1],
) -> Result<[S; 8], ::lagrangian::emitted::Singular> {
    S::run(Friction { p, t, q, v })
}

/// A call of [`friction`], to be run with whatever instructions the processor has.
pub struct Friction<'a, S> {
    /// As `friction` takes it.
    pub p: &'a Prepared<S>,
    /// As `friction` takes it.
    pub t: S,
    /// As `friction` takes it.
    pub q: &'a [S; 1],
    /// As `friction` takes it.
    pub v: &'a [S; 1],
}

impl<S: Copy> ::lagrangian::emitted::scalar::Kernel<S> for Friction<'_, S> {
    type Output = Result<[S; 8], ::lagrangian::emitted::Singular>;

    #[inline(always)]
    fn run<N: ::lagrangian::emitted::Scalar<Stored = S>>(self) -> Self::Output {
        let Self { p, t, q, v } = self;
        let n = N::load;
        if let Some(singular) = p.singular {
            return Err(singular);
        }
        let s = n(q[0]);
        let s_dot = n(v[0]);
        let t0 = n(p.rate) * n(t);
        let t1 = s * n(p.k2);
        let t2 = n(p.k3) * s_dot;
        let t3 = t0 + n(p.alpha);
        let (sin_t3, cos_t3) = t3.sin_cos();
        let t4 = t0.sum_error(n(p.alpha)) + n(p.rate).product_error(n(t));
        let t5 = t4.mul_add(cos_t3, sin_t3);
        let t6 = t4.neg_mul_add(sin_t3, cos_t3);
        let r0 = n(p.k9) * t5.mul_add(n(p.k1), s * n(p.k6));
        let t7 = n(p.g) - t6.mul_sub(t2, t5 * t1);
        let t8 = t6.neg_mul_add(t7, t5 * t6.mul_add(t1, t5 * t2)) * n(p.m);
        let r2 = -t8;
        let zero = N::ZERO;
        let friction = [
            r0.store(),
            r0.store(),
            r2.store(),
            n(p.k9).store(),
            n(p.k9).store(),
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
/// T = 1/2*m*der(s)^2 + 1/2*m*rate^2*s^2
/// ```
pub fn kinetic_energy<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    t: S,
    q: &[S; 1],
    v: &[S; 1],
) -> S {
    let s = q[0];
    let s_dot = v[0];
    let t0 = p.rate * t;
    let t1 = s * p.rate;
    let t2 = t0 + p.alpha;
    let (sin_t2, cos_t2) = t2.sin_cos();
    let t3 = t0.sum_error(p.alpha) + p.rate.product_error(t);
    let t4 = sin_t2 + t3 * cos_t2;
    let t5 = cos_t2 - t3 * sin_t2;
    let t6 = t5 * s_dot - t1 * t4;
    let t7 = t1 * t5 + t4 * s_dot;
    p.k0 * (t7 * t7 + t6 * t6)
}

/// Potential energy `V`, in J.
///
/// ```text
/// V = -m*g*sin(rate*t + alpha)*s
/// ```
pub fn potential_energy<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, t: S, q: &[S; 1]) -> S {
    let s = q[0];
    let t0 = p.rate * t;
    let t1 = t0 + p.alpha;
    let (sin_t1, cos_t1) = t1.sin_cos();
    let t2 = sin_t1 + (t0.sum_error(p.alpha) + p.rate.product_error(t)) * cos_t1;
    t2 * (p.k8 * s)
}

/// Power `P` that drives, forces and inputs put in, in W.
///
/// ```text
/// P = 2*m*rate^2*s*der(s) - m*rate*g*cos(rate*t + alpha)*s
/// ```
pub fn work_rate<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    t: S,
    q: &[S; 1],
    v: &[S; 1],
    a: &[S; 1],
) -> S {
    let s = q[0];
    let s_dot = v[0];
    let s_ddot = a[0];
    let t0 = p.rate * t;
    let t1 = s * p.k2;
    let t2 = p.k3 * s_dot;
    let t3 = t0 + p.alpha;
    let (sin_t3, cos_t3) = t3.sin_cos();
    let t4 = t0.sum_error(p.alpha) + p.rate.product_error(t);
    let t5 = sin_t3 + t4 * cos_t3;
    let t6 = cos_t3 - t4 * sin_t3;
    let t7 = t5 * (t6 * (t1 - s_ddot) + t5 * t2);
    let t8 = (t6 * (t5 * (s_ddot - t1) + t6 * t2) + t7) * (s * p.k5);
    t8 - t6 * (s * p.k4)
}

/// Names and units.
const PARAMETERS: [(&str, &str); 6] = [
    ("m", "kg"),
    ("alpha", "rad"),
    ("rate", "rad/s"),
    ("mu", "1"),
    ("mu0", "1"),
    ("g", "m/s^2"),
];

/// Names and units.
const COORDINATES: [(&str, &str); 1] = [("s", "m")];

/// Names and units.
const INPUTS: [(&str, &str); 0] = [];

/// Names and units.
const OUTPUTS: [(&str, &str); 0] = [];

/// The names of the contacts that stick and slide.
const CONTACTS: [&str; 1] = ["face"];

impl ::lagrangian::emitted::Machine for BlockOnIncline {
    type System = Prepared;

    fn name(&self) -> &str {
        "BlockOnIncline"
    }

    fn parameters(
        &self,
    ) -> impl ExactSizeIterator<Item = (::lagrangian::emitted::Quantity<'_>, f64)> {
        let values = [self.m, self.alpha, self.rate, self.mu, self.mu0, self.g];
        quantities(&PARAMETERS, values)
    }

    fn parameter_mut(&mut self, index: usize) -> Option<&mut f64> {
        match index {
            0 => Some(&mut self.m),
            1 => Some(&mut self.alpha),
            2 => Some(&mut self.rate),
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

    fn bias(&self, _: f64, q: &[f64; 1], _: &[f64; 1], result: &mut [f64; 1]) {
        *result = bias(self, q);
    }

    fn applied(&self, t: f64, _: &[f64; 1], _: &[f64; 1], _: &Inputs, result: &mut [f64; 1]) {
        *result = applied(self, t);
    }

    fn forces(&self, t: f64, q: &[f64; 1], _: &[f64; 1], _: &Inputs, result: &mut [f64; 1]) {
        *result = forces(self, t, q);
    }

    fn slips(&self, _: f64, _: &[f64; 1], v: &[f64; 1], to: &mut [f64]) {
        fill(to, &slips(v));
    }

    fn slip_matrix(&self, _: f64, _: &[f64; 1], to: &mut [f64]) {
        fill(to, &slip_matrix());
    }

    fn slip_drift(&self, _: f64, _: &[f64; 1], _: &[f64; 1], to: &mut [f64]) {
        to.fill(0.0);
    }

    fn kinetic_energy(&self, t: f64, q: &[f64; 1], v: &[f64; 1]) -> f64 {
        kinetic_energy(self, t, q, v)
    }

    fn potential_energy(&self, t: f64, q: &[f64; 1], _: &Inputs) -> f64 {
        potential_energy(self, t, q)
    }

    fn dissipation(&self, _: f64, _: &[f64; 1], _: &[f64; 1], _: &Inputs) -> f64 {
        0.0
    }

    fn work_rate(&self, t: f64, q: &[f64; 1], v: &[f64; 1], a: &[f64; 1], _: &Inputs) -> f64 {
        work_rate(self, t, q, v, a)
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
        let slips: [::lagrangian::emitted::scalar::Interval; _] = slips(&v.map(near));
        for (range, w) in ranges.iter_mut().zip(slips) {
            *range = [w.lo(), w.hi()];
        }
    }

    fn friction(
        &self,
        t: f64,
        q: &[f64; 1],
        v: &[f64; 1],
        _: &Inputs,
        to: &mut [f64],
    ) -> Result<(), ::lagrangian::emitted::Singular> {
        fill(to, &friction(self, t, q, v)?);
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
