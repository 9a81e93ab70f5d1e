// @generated from machines/wedge_and_block.machine by `cargo xtask generate`; edits are lost.

//! A block slides down a wedge that slides on a table: what presses on either depends on how both
//! accelerate.
//!
//! 2 coordinates, 6 parameters. Arithmetic of one call:
//!
//! | function | mul | add | div | sin cos | other | temporaries |
//! | --- | --: | --: | --: | --: | --: | --: |
//! | `prepare` | 20 | 11 | 2 | 1 | 0 | 35 |
//! | `kinetic_energy` | 7 | 3 | 0 | 0 | 0 | 10 |
//! | `potential_energy` | 1 | 0 | 0 | 0 | 0 | 1 |
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

/// A block slides down a wedge that slides on a table: what presses on either depends on how both
/// accelerate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WedgeAndBlock<S = f64> {
    /// Mass of the wedge. Unit: `kg`. Default: 3.
    pub M: S,
    /// Mass of the block. Unit: `kg`. Default: 1.
    pub m: S,
    /// Angle of the wedge. Unit: `rad`. Default: (1/6)*pi.
    pub alpha: S,
    /// Coefficient of friction between block and wedge. Unit: `1`. Default: 0.1.
    pub mu1: S,
    /// Coefficient of friction between wedge and table. Unit: `1`. Default: 0.02.
    pub mu2: S,
    /// Acceleration of gravity. Unit: `m/s^2`. Default: 9.81.
    pub g: S,
}

impl Default for WedgeAndBlock {
    fn default() -> Self {
        Self {
            M: 3.0,
            m: 1.0,
            alpha: 0.5235987755982989,
            mu1: 0.1,
            mu2: 0.02,
            g: 9.81,
        }
    }
}

impl<S> WedgeAndBlock<S> {
    /// These values as other numbers.
    pub fn map<R>(self, f: impl Fn(S) -> R) -> WedgeAndBlock<R> {
        WedgeAndBlock {
            M: f(self.M),
            m: f(self.m),
            alpha: f(self.alpha),
            mu1: f(self.mu1),
            mu2: f(self.mu2),
            g: f(self.g),
        }
    }
}

impl<S: ::lagrangian::emitted::Scalar> WedgeAndBlock<S> {
    /// Computes what depends on the parameters alone, once.
    pub fn prepare(&self) -> Prepared<S> {
        let (sin_self_alpha, cos_self_alpha) = self.alpha.sin_cos();
        let k6 = self.m + self.M;
        let t0 = S::ONE / k6;
        let k5 = self.m * cos_self_alpha;
        let t1 = self.m * sin_self_alpha;
        let t2 = k5 * t0;
        let k2 = t1 * self.g;
        let pivot_1 = self.m - k5 * t2;
        let k9 = S::ONE / pivot_1;
        let t3 = t1 * k9;
        let t4 = t2 * k9;
        let k8 = self.g * t3;
        let k12 = t0 + t2 * t4;
        let k13 = t2 * t3;
        let t5 = t1 * k8;
        let k1 = sin_self_alpha * sin_self_alpha;
        let k3 = S::from_f64(0.5) * self.M;
        let k4 = self.m * S::from_f64(0.5);
        let k7 = -k2;
        let k10 = self.m * self.g + self.g * self.M - t5;
        let k11 = self.g * k5 - t2 * t5;
        let k14 = t1 * k12;
        let k15 = -(t2 * k8);
        let k16 = -t4;
        let k17 = -t3;
        let k18 = -k13;
        let singular = if vanishes(k6, k6, 1.7763568394002505e-15) {
            Some(singular(0, k6, k6))
        } else if vanishes(pivot_1, self.m, 1.7763568394002505e-15) {
            Some(singular(1, pivot_1, self.m))
        } else {
            None
        };
        Prepared {
            m: self.m,
            k0: cos_self_alpha,
            k1,
            k2,
            k3,
            k4,
            k5,
            k6,
            k7,
            mu2: self.mu2,
            mu1: self.mu1,
            k8,
            k9,
            k10,
            k11,
            k12,
            k13,
            k14,
            k15,
            k16,
            k17,
            k18,
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

/// The coordinates of [`WedgeAndBlock`], or their rates, by name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coordinates<S = f64> {
    /// How far the wedge has moved. Unit: `m`.
    pub x: S,
    /// How far the block has slid down the wedge. Unit: `m`.
    pub s: S,
}

impl<S: Copy> Coordinates<S> {
    /// The numbers in the order of the description: the order of `q` in every function here.
    pub fn to_array(self) -> [S; 2] {
        [self.x, self.s]
    }

    /// Names for numbers in the order of the description.
    pub fn from_array(q: [S; 2]) -> Self {
        Self { x: q[0], s: q[1] }
    }

    /// These values as other numbers.
    pub fn map<R>(self, f: impl Fn(S) -> R) -> Coordinates<R> {
        Coordinates {
            x: f(self.x),
            s: f(self.s),
        }
    }
}

/// What can be set while a [`WedgeAndBlock`] runs.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Inputs {}

/// What can be observed of a [`WedgeAndBlock`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Outputs {}

/// The parameters of a [`WedgeAndBlock`], with the work done that depends on them alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prepared<S = f64> {
    /// `m`
    m: S,
    /// `cos(alpha)`
    k0: S,
    /// `sin(alpha)^2`
    k1: S,
    /// `m*g*sin(alpha)`
    k2: S,
    /// `0.5*M`
    k3: S,
    /// `0.5*m`
    k4: S,
    /// `m*cos(alpha)`
    k5: S,
    /// `M + m`
    k6: S,
    /// `-m*g*sin(alpha)`
    k7: S,
    /// `mu2`
    mu2: S,
    /// `mu1`
    mu1: S,
    /// `m*g*sin(alpha)/(m - m^2*cos(alpha)^2/(M + m))`
    k8: S,
    /// `1/(m - m^2*cos(alpha)^2/(M + m))`
    k9: S,
    /// `M*g + m*g - m^2*g*sin(alpha)^2/(m - m^2*cos(alpha)^2/(M + m))`
    k10: S,
    /// `m*g*cos(alpha) - m^3*g*cos(alpha)*sin(alpha)^2/(M + m)/(m - m^2*cos(alpha)^2/(M + m))`
    k11: S,
    /// `1/(M + m) + m^2*cos(alpha)^2/(M + m)^2/(m - m^2*cos(alpha)^2/(M + m))`
    k12: S,
    /// `m^2*cos(alpha)*sin(alpha)/(M + m)/(m - m^2*cos(alpha)^2/(M + m))`
    k13: S,
    /// `m*sin(alpha)*(1/(M + m) + m^2*cos(alpha)^2/(M + m)^2/(m - m^2*cos(alpha)^2/(M + m)))`
    k14: S,
    /// `-m^2*g*cos(alpha)*sin(alpha)/(M + m)/(m - m^2*cos(alpha)^2/(M + m))`
    k15: S,
    /// `-m*cos(alpha)/(M + m)/(m - m^2*cos(alpha)^2/(M + m))`
    k16: S,
    /// `-m*sin(alpha)/(m - m^2*cos(alpha)^2/(M + m))`
    k17: S,
    /// `-m^2*cos(alpha)*sin(alpha)/(M + m)/(m - m^2*cos(alpha)^2/(M + m))`
    k18: S,
    /// Why these parameters leave the machine without accelerations, if they do.
    singular: Option<::lagrangian::emitted::Singular>,
}

/// Mass matrix `M`.
///
/// ```text
/// M[x, x] = M + m
/// M[s, x] = m*cos(alpha)
/// M[s, s] = m
/// ```
pub fn mass_matrix<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>) -> [[S; 2]; 2] {
    [[p.k6, p.k5], [p.k5, p.m]]
}

/// Applied generalized forces `Q`.
///
/// ```text
/// Q[s] = m*g*sin(alpha)
/// ```
pub fn applied<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>) -> [S; 2] {
    let zero = S::ZERO;
    [zero, p.k2]
}

/// Right-hand side `f = Q - h` of `M a = f`.
pub fn forces<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>) -> [S; 2] {
    let zero = S::ZERO;
    [zero, p.k2]
}

/// Slips `w` of the guided contacts, in m/s.
///
/// ```text
/// w[table] = der(x)
/// w[slope] = der(s)
/// ```
pub fn slips<S: ::lagrangian::emitted::Scalar>(v: &[S; 2]) -> [S; 2] {
    let x_dot = v[0];
    let s_dot = v[1];
    [x_dot, s_dot]
}

/// Slip matrix `tau`, the derivatives of the slips by the rates.
///
/// ```text
/// tau[table, x] = 1
/// tau[slope, s] = 1
/// ```
pub fn slip_matrix<S: ::lagrangian::emitted::Scalar>() -> [S; 4] {
    let one = S::ONE;
    let zero = S::ZERO;
    [one, zero, zero, one]
}

/// What there is without friction, and what a unit of each friction force adds to it:
/// accelerations, multipliers, `dw/dt` and the normal reaction of each contact; behind these the
/// coefficients of friction. A machine with contacts has this in place of accelerations and
/// multipliers.
///
/// A pivot that vanishes is an error.
pub fn friction<S: ::lagrangian::emitted::Number>(
    p: &Prepared<S>,
) -> Result<[S; 22], ::lagrangian::emitted::Singular> {
    S::run(Friction { p })
}

/// A call of [`friction`], to be run with whatever instructions the processor has.
pub struct Friction<'a, S> {
    /// As `friction` takes it.
    pub p: &'a Prepared<S>,
}

impl<S: Copy> ::lagrangian::emitted::scalar::Kernel<S> for Friction<'_, S> {
    type Output = Result<[S; 22], ::lagrangian::emitted::Singular>;

    #[inline(always)]
    fn run<N: ::lagrangian::emitted::Scalar<Stored = S>>(self) -> Self::Output {
        let Self { p } = self;
        let n = N::load;
        if let Some(singular) = p.singular {
            return Err(singular);
        }
        let friction = [
            n(p.k15).store(),
            n(p.k8).store(),
            n(p.k15).store(),
            n(p.k8).store(),
            n(p.k10).store(),
            n(p.k11).store(),
            n(p.k12).store(),
            n(p.k16).store(),
            n(p.k12).store(),
            n(p.k16).store(),
            n(p.k13).store(),
            n(p.k14).store(),
            n(p.k16).store(),
            n(p.k9).store(),
            n(p.k16).store(),
            n(p.k9).store(),
            n(p.k17).store(),
            n(p.k18).store(),
            n(p.mu2).store(),
            n(p.mu1).store(),
            n(p.mu2).store(),
            n(p.mu1).store(),
        ];
        Ok(friction)
    }
}

/// Kinetic energy `T`, in J.
///
/// ```text
/// T = 1/2*(M + m)*der(x)^2 + m*cos(alpha)*der(x)*der(s) + 1/2*m*der(s)^2
/// ```
pub fn kinetic_energy<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, v: &[S; 2]) -> S {
    let x_dot = v[0];
    let s_dot = v[1];
    let t0 = s_dot * p.k0 + x_dot;
    p.k4 * (s_dot * (s_dot * p.k1) + t0 * t0) + x_dot * (x_dot * p.k3)
}

/// Potential energy `V`, in J.
///
/// ```text
/// V = -m*g*sin(alpha)*s
/// ```
pub fn potential_energy<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 2]) -> S {
    let s = q[1];
    p.k7 * s
}

/// Names and units.
const PARAMETERS: [(&str, &str); 6] = [
    ("M", "kg"),
    ("m", "kg"),
    ("alpha", "rad"),
    ("mu1", "1"),
    ("mu2", "1"),
    ("g", "m/s^2"),
];

/// Names and units.
const COORDINATES: [(&str, &str); 2] = [("x", "m"), ("s", "m")];

/// Names and units.
const INPUTS: [(&str, &str); 0] = [];

/// Names and units.
const OUTPUTS: [(&str, &str); 0] = [];

/// The names of the contacts that stick and slide.
const CONTACTS: [&str; 2] = ["table", "slope"];

impl ::lagrangian::emitted::Machine for WedgeAndBlock {
    type System = Prepared;

    fn name(&self) -> &str {
        "WedgeAndBlock"
    }

    fn parameters(
        &self,
    ) -> impl ExactSizeIterator<Item = (::lagrangian::emitted::Quantity<'_>, f64)> {
        let values = [self.M, self.m, self.alpha, self.mu1, self.mu2, self.g];
        quantities(&PARAMETERS, values)
    }

    fn parameter_mut(&mut self, index: usize) -> Option<&mut f64> {
        match index {
            0 => Some(&mut self.M),
            1 => Some(&mut self.m),
            2 => Some(&mut self.alpha),
            3 => Some(&mut self.mu1),
            4 => Some(&mut self.mu2),
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
    type Vector = [f64; 2];
    type Matrix = [f64; 4];
    type Coordinates = Coordinates;
    type Inputs = Inputs;
    type Outputs = Outputs;
    const MAY_BE_CONSTRAINED: bool = false;
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
        t: f64,
        q: &[f64; 2],
        v: &[f64; 2],
        u: &Inputs,
        result: &mut [f64; 2],
    ) -> Result<(), ::lagrangian::emitted::Singular> {
        ::lagrangian::emitted::accelerations_with_friction(self, t, q, v, u, result)
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

    fn applied(&self, _: f64, _: &[f64; 2], _: &[f64; 2], _: &Inputs, result: &mut [f64; 2]) {
        *result = applied(self);
    }

    fn forces(&self, _: f64, _: &[f64; 2], _: &[f64; 2], _: &Inputs, result: &mut [f64; 2]) {
        *result = forces(self);
    }

    fn slips(&self, _: f64, _: &[f64; 2], v: &[f64; 2], to: &mut [f64]) {
        fill(to, &slips(v));
    }

    fn slip_matrix(&self, _: f64, _: &[f64; 2], to: &mut [f64]) {
        fill(to, &slip_matrix());
    }

    fn slip_drift(&self, _: f64, _: &[f64; 2], _: &[f64; 2], to: &mut [f64]) {
        to.fill(0.0);
    }

    fn kinetic_energy(&self, _: f64, _: &[f64; 2], v: &[f64; 2]) -> f64 {
        kinetic_energy(self, v)
    }

    fn potential_energy(&self, _: f64, q: &[f64; 2], _: &Inputs) -> f64 {
        potential_energy(self, q)
    }

    fn dissipation(&self, _: f64, _: &[f64; 2], _: &[f64; 2], _: &Inputs) -> f64 {
        0.0
    }

    fn work_rate(&self, _: f64, _: &[f64; 2], _: &[f64; 2], _: &[f64; 2], _: &Inputs) -> f64 {
        0.0
    }

    fn dissipation_rate(&self, _: f64, _: &[f64; 2], _: &[f64; 2], _: &Inputs) -> f64 {
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

    fn outputs(&self, _: f64, _: &[f64; 2], _: &[f64; 2], _: &[f64; 2], _: &Inputs) -> Outputs {
        Outputs {}
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

    fn contacts(&self) -> impl ExactSizeIterator<Item = &str> {
        CONTACTS.iter().copied()
    }

    fn slip_ranges(&self, _: f64, _: &[f64; 2], v: &[f64; 2], ranges: &mut [[f64; 2]]) {
        let between = ::lagrangian::emitted::scalar::Interval::new;
        let near = |x: f64| between(x.next_down(), x.next_up());
        let slips: [::lagrangian::emitted::scalar::Interval; _] = slips(&v.map(near));
        for (range, w) in ranges.iter_mut().zip(slips) {
            *range = [w.lo(), w.hi()];
        }
    }

    fn friction(
        &self,
        _: f64,
        _: &[f64; 2],
        _: &[f64; 2],
        _: &Inputs,
        to: &mut [f64],
    ) -> Result<(), ::lagrangian::emitted::Singular> {
        fill(to, &friction(self)?);
        Ok(())
    }

    fn with_workspace<R>(&self, length: usize, work: impl FnOnce(Option<&mut [f64]>) -> R) -> R {
        let mut room = [0.0; ::lagrangian::emitted::contact_workspace(2, 0, 2)];
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
