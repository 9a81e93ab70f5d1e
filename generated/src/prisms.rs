// @generated from machines/prisms.machine by `cargo xtask generate`; edits are lost.

//! Two prisms with Coulomb friction: one slides down on the other, which slides on the floor (D.
//! Đurić,
//! *On Brachistochronic Motion of a Multibody System with Real Constraints*, figure 1).
//!
//! The defaults are those of the paper's example, with 9.81 m/s² for the gravity that it does not
//! give.
//!
//! 2 coordinates, 6 parameters. Arithmetic of one call:
//!
//! | function | mul | add | div | sin cos | other | temporaries |
//! | --- | --: | --: | --: | --: | --: | --: |
//! | `prepare` | 28 | 11 | 3 | 1 | 0 | 44 |
//! | `slips` | 1 | 0 | 0 | 0 | 0 | 1 |
//! | `kinetic_energy` | 6 | 3 | 0 | 0 | 0 | 9 |
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

/// Two prisms with Coulomb friction: one slides down on the other, which slides on the floor (D.
/// Đurić,
/// *On Brachistochronic Motion of a Multibody System with Real Constraints*, figure 1).
///
/// The defaults are those of the paper's example, with 9.81 m/s² for the gravity that it does not
/// give.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prisms<S = f64> {
    /// Mass of the prism that slides down. Unit: `kg`. Default: 32/13.
    pub m: S,
    /// Mass of the prism on the floor. Unit: `kg`. Default: 20/13.
    pub M: S,
    /// Angle of the rough side to the horizontal. Unit: `rad`. Default: 0.25*pi.
    pub alpha: S,
    /// Coefficient of friction between the prisms. Unit: `1`. Default: 0.1.
    pub mu1: S,
    /// Coefficient of friction on the floor. Unit: `1`. Default: 0.02.
    pub mu2: S,
    /// Acceleration of gravity. Unit: `m/s^2`. Default: 9.81.
    pub g: S,
}

impl Default for Prisms {
    fn default() -> Self {
        Self {
            m: 2.4615384615384617,
            M: 1.5384615384615385,
            alpha: 0.7853981633974483,
            mu1: 0.1,
            mu2: 0.02,
            g: 9.81,
        }
    }
}

impl<S> Prisms<S> {
    /// These values as other numbers.
    pub fn map<R>(self, f: impl Fn(S) -> R) -> Prisms<R> {
        Prisms {
            m: f(self.m),
            M: f(self.M),
            alpha: f(self.alpha),
            mu1: f(self.mu1),
            mu2: f(self.mu2),
            g: f(self.g),
        }
    }
}

impl<S: ::lagrangian::emitted::Scalar> Prisms<S> {
    /// Computes what depends on the parameters alone, once.
    pub fn prepare(&self) -> Prepared<S> {
        let (sin_self_alpha, cos_self_alpha) = self.alpha.sin_cos();
        let k1 = self.m + self.M;
        let t0 = self.m * self.g;
        let t1 = S::ONE / k1;
        let t2 = self.m * t1;
        let k6 = S::ONE / cos_self_alpha;
        let t3 = sin_self_alpha * self.m;
        let k0 = k6 * (t3 * self.g);
        let t4 = sin_self_alpha * k6;
        let k5 = k6 * (self.m * k6);
        let pivot_1 = k5 - self.m * t2;
        let t5 = S::ONE / pivot_1;
        let k17 = k6 * t5;
        let k14 = t2 * t5;
        let t6 = t3 * k17;
        let k15 = t1 + t2 * k14;
        let k9 = self.g * t6;
        let k10 = t2 * k9;
        let k11 = k6 * k9;
        let k2 = t4 * t4;
        let k3 = self.M * S::from_f64(0.5);
        let k4 = self.m * S::from_f64(0.5);
        let k7 = -self.m;
        let k8 = -k0;
        let k12 = t0 + self.g * self.M - t3 * k11;
        let k13 = cos_self_alpha * t0 - t3 * k10;
        let k16 = t2 * k17;
        let k18 = k6 * k17;
        let k19 = -(t2 * t6);
        let k20 = -(t3 * k15);
        let k21 = -(k6 * t6);
        let singular = if vanishes(k1, k1, 1.7763568394002505e-15) {
            Some(singular(0, k1, k1))
        } else if vanishes(pivot_1, k5, 1.7763568394002505e-15) {
            Some(singular(1, pivot_1, k5))
        } else {
            None
        };
        Prepared {
            k0,
            k1,
            k2,
            k3,
            k4,
            k5,
            k6,
            k7,
            k8,
            mu2: self.mu2,
            mu1: self.mu1,
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
            k19,
            k20,
            k21,
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

/// The coordinates of [`Prisms`], or their rates, by name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coordinates<S = f64> {
    /// How far the prism on the floor has moved. Unit: `m`.
    pub q1: S,
    /// How far the other has moved on it, horizontally and to the other side. Unit: `m`.
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

/// What can be set while a [`Prisms`] runs.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Inputs {}

/// What can be observed of a [`Prisms`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Outputs {}

/// The parameters of a [`Prisms`], with the work done that depends on them alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prepared<S = f64> {
    /// `m*g*sin(alpha)/cos(alpha)`
    k0: S,
    /// `m + M`
    k1: S,
    /// `sin(alpha)^2/cos(alpha)^2`
    k2: S,
    /// `0.5*M`
    k3: S,
    /// `0.5*m`
    k4: S,
    /// `m/cos(alpha)^2`
    k5: S,
    /// `1/cos(alpha)`
    k6: S,
    /// `-m`
    k7: S,
    /// `-m*g*sin(alpha)/cos(alpha)`
    k8: S,
    /// `mu2`
    mu2: S,
    /// `mu1`
    mu1: S,
    /// `m*g*sin(alpha)/cos(alpha)/(m/cos(alpha)^2 - m^2/(m + M))`
    k9: S,
    /// `m^2*g*sin(alpha)/cos(alpha)/(m + M)/(m/cos(alpha)^2 - m^2/(m + M))`
    k10: S,
    /// `m*g*sin(alpha)/cos(alpha)^2/(m/cos(alpha)^2 - m^2/(m + M))`
    k11: S,
    /// `M*g + m*g - m^2*g*sin(alpha)^2/cos(alpha)^2/(m/cos(alpha)^2 - m^2/(m + M))`
    k12: S,
    /// `m*g*cos(alpha) - m^3*g*sin(alpha)^2/cos(alpha)/(m + M)/(m/cos(alpha)^2 - m^2/(m + M))`
    k13: S,
    /// `m/(m + M)/(m/cos(alpha)^2 - m^2/(m + M))`
    k14: S,
    /// `1/(m + M) + m^2/(m + M)^2/(m/cos(alpha)^2 - m^2/(m + M))`
    k15: S,
    /// `m/cos(alpha)/(m + M)/(m/cos(alpha)^2 - m^2/(m + M))`
    k16: S,
    /// `1/cos(alpha)/(m/cos(alpha)^2 - m^2/(m + M))`
    k17: S,
    /// `1/cos(alpha)^2/(m/cos(alpha)^2 - m^2/(m + M))`
    k18: S,
    /// `-m^2*sin(alpha)/cos(alpha)/(m + M)/(m/cos(alpha)^2 - m^2/(m + M))`
    k19: S,
    /// `-m*sin(alpha)*(1/(m + M) + m^2/(m + M)^2/(m/cos(alpha)^2 - m^2/(m + M)))`
    k20: S,
    /// `-m*sin(alpha)/cos(alpha)^2/(m/cos(alpha)^2 - m^2/(m + M))`
    k21: S,
    /// Why these parameters leave the machine without accelerations, if they do.
    singular: Option<::lagrangian::emitted::Singular>,
}

/// Mass matrix `M`.
///
/// ```text
/// M[q1, q1] = m + M
/// M[q2, q1] = -m
/// M[q2, q2] = m/cos(alpha)^2
/// ```
pub fn mass_matrix<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>) -> [[S; 2]; 2] {
    [[p.k1, p.k7], [p.k7, p.k5]]
}

/// Applied generalized forces `Q`.
///
/// ```text
/// Q[q2] = m*g*sin(alpha)/cos(alpha)
/// ```
pub fn applied<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>) -> [S; 2] {
    let zero = S::ZERO;
    [zero, p.k0]
}

/// Right-hand side `f = Q - h` of `M a = f`.
pub fn forces<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>) -> [S; 2] {
    let zero = S::ZERO;
    [zero, p.k0]
}

/// Slips `w` of the guided contacts, in m/s.
///
/// ```text
/// w[floor] = der(q1)
/// w[incline] = der(q2)/cos(alpha)
/// ```
pub fn slips<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, v: &[S; 2]) -> [S; 2] {
    let q1_dot = v[0];
    let q2_dot = v[1];
    let w2 = p.k6 * q2_dot;
    [q1_dot, w2]
}

/// Slip matrix `tau`, the derivatives of the slips by the rates.
///
/// ```text
/// tau[floor, q1] = 1
/// tau[incline, q2] = 1/cos(alpha)
/// ```
pub fn slip_matrix<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>) -> [S; 4] {
    let one = S::ONE;
    let zero = S::ZERO;
    [one, zero, zero, p.k6]
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
            n(p.k10).store(),
            n(p.k9).store(),
            n(p.k10).store(),
            n(p.k11).store(),
            n(p.k12).store(),
            n(p.k13).store(),
            n(p.k15).store(),
            n(p.k14).store(),
            n(p.k15).store(),
            n(p.k16).store(),
            n(p.k19).store(),
            n(p.k20).store(),
            n(p.k16).store(),
            n(p.k17).store(),
            n(p.k16).store(),
            n(p.k18).store(),
            n(p.k21).store(),
            n(p.k19).store(),
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
/// T = 1/2*(m + M)*der(q1)^2 - m*der(q1)*der(q2) + 1/2*m*der(q2)^2/cos(alpha)^2
/// ```
pub fn kinetic_energy<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, v: &[S; 2]) -> S {
    let q1_dot = v[0];
    let q2_dot = v[1];
    let t0 = q1_dot - q2_dot;
    p.k4 * (q2_dot * (q2_dot * p.k2) + t0 * t0) + q1_dot * (q1_dot * p.k3)
}

/// Potential energy `V`, in J.
///
/// ```text
/// V = -m*g*sin(alpha)*q2/cos(alpha)
/// ```
pub fn potential_energy<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 2]) -> S {
    let q2 = q[1];
    p.k8 * q2
}

/// Names and units.
const PARAMETERS: [(&str, &str); 6] = [
    ("m", "kg"),
    ("M", "kg"),
    ("alpha", "rad"),
    ("mu1", "1"),
    ("mu2", "1"),
    ("g", "m/s^2"),
];

/// Names and units.
const COORDINATES: [(&str, &str); 2] = [("q1", "m"), ("q2", "m")];

/// Names and units.
const INPUTS: [(&str, &str); 0] = [];

/// Names and units.
const OUTPUTS: [(&str, &str); 0] = [];

/// The names of the contacts that stick and slide.
const CONTACTS: [&str; 2] = ["floor", "incline"];

impl ::lagrangian::emitted::Machine for Prisms {
    type System = Prepared;

    fn name(&self) -> &str {
        "Prisms"
    }

    fn parameters(
        &self,
    ) -> impl ExactSizeIterator<Item = (::lagrangian::emitted::Quantity<'_>, f64)> {
        let values = [self.m, self.M, self.alpha, self.mu1, self.mu2, self.g];
        quantities(&PARAMETERS, values)
    }

    fn parameter_mut(&mut self, index: usize) -> Option<&mut f64> {
        match index {
            0 => Some(&mut self.m),
            1 => Some(&mut self.M),
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
        fill(to, &slips(self, v));
    }

    fn slip_matrix(&self, _: f64, _: &[f64; 2], to: &mut [f64]) {
        fill(to, &slip_matrix(self));
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
        let p = Prepared {
            k0: near(self.k0),
            k1: near(self.k1),
            k2: near(self.k2),
            k3: near(self.k3),
            k4: near(self.k4),
            k5: near(self.k5),
            k6: near(self.k6),
            k7: near(self.k7),
            k8: near(self.k8),
            mu2: near(self.mu2),
            mu1: near(self.mu1),
            k9: near(self.k9),
            k10: near(self.k10),
            k11: near(self.k11),
            k12: near(self.k12),
            k13: near(self.k13),
            k14: near(self.k14),
            k15: near(self.k15),
            k16: near(self.k16),
            k17: near(self.k17),
            k18: near(self.k18),
            k19: near(self.k19),
            k20: near(self.k20),
            k21: near(self.k21),
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
