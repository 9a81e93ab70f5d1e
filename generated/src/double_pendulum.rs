// @generated from machines/double_pendulum.machine by `cargo xtask generate`; edits are lost.

//! Two point masses on massless rods, hanging one from the other. Angles are absolute, from the
//! downward vertical. From large angles the motion is chaotic; energy is conserved throughout.
//!
//! 2 coordinates, 5 parameters. Arithmetic of one call:
//!
//! | function | mul | add | div | sin cos | other | temporaries |
//! | --- | --: | --: | --: | --: | --: | --: |
//! | `prepare` | 14 | 6 | 1 | 0 | 0 | 21 |
//! | `start` | 2 | 0 | 0 | 0 | 0 | 2 |
//! | `mass_matrix` | 3 | 1 | 0 | 2 | 0 | 8 |
//! | `bias` | 8 | 1 | 0 | 2 | 0 | 13 |
//! | `applied` | 2 | 0 | 0 | 2 | 0 | 4 |
//! | `forces` | 12 | 4 | 0 | 2 | 0 | 20 |
//! | `accelerations` | 18 | 9 | 1 | 2 | 0 | 32 |
//! | `kinetic_energy` | 11 | 4 | 0 | 2 | 0 | 19 |
//! | `potential_energy` | 4 | 3 | 0 | 2 | 0 | 9 |
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

/// Two point masses on massless rods, hanging one from the other. Angles are absolute, from the
/// downward vertical. From large angles the motion is chaotic; energy is conserved throughout.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DoublePendulum<S = f64> {
    /// Mass of the upper and of the lower bob. Unit: `kg`. Default: 1.
    pub m1: S,
    /// `m2`. Unit: `kg`. Default: 1.
    pub m2: S,
    /// Length of the upper and of the lower rod. Unit: `m`. Default: 1.
    pub l1: S,
    /// `l2`. Unit: `m`. Default: 1.
    pub l2: S,
    /// `g`. Unit: `m/s^2`. Default: 9.81.
    pub g: S,
}

impl Default for DoublePendulum {
    fn default() -> Self {
        Self {
            m1: 1.0,
            m2: 1.0,
            l1: 1.0,
            l2: 1.0,
            g: 9.81,
        }
    }
}

impl<S> DoublePendulum<S> {
    /// These values as other numbers.
    pub fn map<R>(self, f: impl Fn(S) -> R) -> DoublePendulum<R> {
        DoublePendulum {
            m1: f(self.m1),
            m2: f(self.m2),
            l1: f(self.l1),
            l2: f(self.l2),
            g: f(self.g),
        }
    }
}

impl<S: ::lagrangian::Scalar> DoublePendulum<S> {
    /// Computes what depends on the parameters alone, once.
    pub fn prepare(&self) -> Prepared<S> {
        let t0 = self.l1 * self.l1;
        let t1 = self.g * self.m1;
        let k1 = self.g * self.m2;
        let t2 = self.l2 * self.m2;
        let t3 = self.m1 * t0;
        let k4 = self.l1 * t2;
        let k7 = self.g * t2;
        let pivot_0 = t3 + self.m2 * t0;
        let k8 = self.l1 * (t1 + k1);
        let k0 = self.l1 * t1;
        let k2 = t3 * S::from_f64(0.5);
        let k3 = self.m2 * S::from_f64(0.5);
        let k5 = t0 * (self.m1 + self.m2);
        let k6 = self.l2 * t2;
        let k9 = -k4;
        let k10 = -k8;
        let k11 = -k7;
        let k12 = S::ONE / pivot_0;
        let singular = if vanishes(pivot_0, pivot_0, 1.7763568394002505e-15) {
            Some(singular(0, pivot_0, pivot_0))
        } else {
            None
        };
        Prepared {
            l1: self.l1,
            l2: self.l2,
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
            k10,
            k11,
            k12,
            singular,
        }
    }

    /// The start values of the description, at rest and `t = 0`.
    pub fn start(&self) -> ::lagrangian::State<Coordinates<S>> {
        let theta1 = S::pi() * S::from_ratio(2, 3);
        let theta2 = S::pi() * S::from_f64(0.5);
        let q = [theta1, theta2];
        let v = [S::ZERO; 2];
        ::lagrangian::State {
            t: 0.0,
            q: Coordinates::from_array(q),
            v: Coordinates::from_array(v),
        }
    }
}

/// The coordinates of [`DoublePendulum`], or their rates, by name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coordinates<S = f64> {
    /// `theta1`. Unit: `rad`.
    pub theta1: S,
    /// `theta2`. Unit: `rad`.
    pub theta2: S,
}

impl<S: Copy> Coordinates<S> {
    /// The numbers in the order of the description: the order of `q` in every function here.
    pub fn to_array(self) -> [S; 2] {
        [self.theta1, self.theta2]
    }

    /// Names for numbers in the order of the description.
    pub fn from_array(q: [S; 2]) -> Self {
        Self {
            theta1: q[0],
            theta2: q[1],
        }
    }

    /// These values as other numbers.
    pub fn map<R>(self, f: impl Fn(S) -> R) -> Coordinates<R> {
        Coordinates {
            theta1: f(self.theta1),
            theta2: f(self.theta2),
        }
    }
}

/// What can be set while a [`DoublePendulum`] runs.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Inputs {}

/// What can be observed of a [`DoublePendulum`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Outputs {}

/// The parameters of a [`DoublePendulum`], with the work done that depends on them alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prepared<S = f64> {
    /// `l1`
    l1: S,
    /// `l2`
    l2: S,
    /// `m1*l1*g`
    k0: S,
    /// `m2*g`
    k1: S,
    /// `0.5*m1*l1^2`
    k2: S,
    /// `0.5*m2`
    k3: S,
    /// `m2*l1*l2`
    k4: S,
    /// `l1^2*(m1 + m2)`
    k5: S,
    /// `m2*l2^2`
    k6: S,
    /// `m2*l2*g`
    k7: S,
    /// `l1*(m2*g + m1*g)`
    k8: S,
    /// `-m2*l1*l2`
    k9: S,
    /// `-l1*(m2*g + m1*g)`
    k10: S,
    /// `-m2*l2*g`
    k11: S,
    /// `1/(m1*l1^2 + m2*l1^2)`
    k12: S,
    /// Why these parameters leave the machine without accelerations, if they do.
    singular: Option<::lagrangian::Singular>,
}

/// Mass matrix `M`.
///
/// ```text
/// M[theta1, theta1] = m1*l1^2 + m2*l1^2
/// M[theta2, theta1] = m2*l1*l2*cos(theta2 - theta1)
/// M[theta2, theta2] = m2*l2^2
/// ```
pub fn mass_matrix<S: ::lagrangian::Scalar>(p: &Prepared<S>, q: &[S; 2]) -> [[S; 2]; 2] {
    let theta1 = q[0];
    let theta2 = q[1];
    let (sin_theta2, cos_theta2) = theta2.sin_cos();
    let (sin_theta1, cos_theta1) = theta1.sin_cos();
    let m21 = (cos_theta2 * cos_theta1 + sin_theta2 * sin_theta1) * p.k4;
    [[p.k5, m21], [m21, p.k6]]
}

/// Bias `h`: velocity products and explicit time in the inertia forces.
///
/// ```text
/// h[theta1] = -m2*l1*l2*sin(theta2 - theta1)*der(theta2)^2
/// h[theta2] = m2*l1*l2*sin(theta2 - theta1)*der(theta1)^2
/// ```
pub fn bias<S: ::lagrangian::Scalar>(p: &Prepared<S>, q: &[S; 2], v: &[S; 2]) -> [S; 2] {
    let theta1 = q[0];
    let theta2 = q[1];
    let theta1_dot = v[0];
    let theta2_dot = v[1];
    let (sin_theta2, cos_theta2) = theta2.sin_cos();
    let (sin_theta1, cos_theta1) = theta1.sin_cos();
    let t0 = cos_theta2 * sin_theta1 - sin_theta2 * cos_theta1;
    let h_theta1 = t0 * (theta2_dot * (theta2_dot * p.k4));
    let h_theta2 = t0 * (theta1_dot * (p.k9 * theta1_dot));
    [h_theta1, h_theta2]
}

/// Applied generalized forces `Q`.
///
/// ```text
/// Q[theta1] = -(m1 + m2)*l1*g*sin(theta1)
/// Q[theta2] = -m2*l2*g*sin(theta2)
/// ```
pub fn applied<S: ::lagrangian::Scalar>(p: &Prepared<S>, q: &[S; 2]) -> [S; 2] {
    let theta1 = q[0];
    let theta2 = q[1];
    let sin_theta1 = theta1.sin();
    let sin_theta2 = theta2.sin();
    let q_theta1 = p.k10 * sin_theta1;
    let q_theta2 = p.k11 * sin_theta2;
    [q_theta1, q_theta2]
}

/// Right-hand side `f = Q - h` of `M a = f`.
pub fn forces<S: ::lagrangian::Scalar>(p: &Prepared<S>, q: &[S; 2], v: &[S; 2]) -> [S; 2] {
    let theta1 = q[0];
    let theta2 = q[1];
    let theta1_dot = v[0];
    let theta2_dot = v[1];
    let (sin_theta1, cos_theta1) = theta1.sin_cos();
    let (sin_theta2, cos_theta2) = theta2.sin_cos();
    let t0 = theta2_dot * theta2_dot;
    let t1 = theta1_dot * theta1_dot;
    let t2 = sin_theta2 * (cos_theta1 * p.k4);
    let t3 = cos_theta2 * (sin_theta1 * p.k4);
    let f_theta1 = t0 * t2 - (t0 * t3 + sin_theta1 * p.k8);
    let f_theta2 = t3 * t1 - (t2 * t1 + sin_theta2 * p.k7);
    [f_theta1, f_theta2]
}

/// Accelerations `a`, the solution of `M a = f` from the mass matrix multiplied out, factored.
///
/// A pivot that vanishes is an error.
pub fn accelerations<S: ::lagrangian::Number>(
    p: &Prepared<S>,
    q: &[S; 2],
    v: &[S; 2],
) -> Result<[S; 2], ::lagrangian::Singular> {
    S::run(Accelerations { p, q, v })
}

/// A call of [`accelerations`], to be run with whatever instructions the processor has.
pub struct Accelerations<'a, S> {
    /// As `accelerations` takes it.
    pub p: &'a Prepared<S>,
    /// As `accelerations` takes it.
    pub q: &'a [S; 2],
    /// As `accelerations` takes it.
    pub v: &'a [S; 2],
}

impl<S: Copy> ::lagrangian::scalar::Kernel<S> for Accelerations<'_, S> {
    type Output = Result<[S; 2], ::lagrangian::Singular>;

    #[inline(always)]
    fn run<N: ::lagrangian::Scalar<Stored = S>>(self) -> Self::Output {
        let Self { p, q, v } = self;
        let n = N::load;
        if let Some(singular) = p.singular {
            return Err(singular);
        }
        let theta1 = n(q[0]);
        let theta2 = n(q[1]);
        let theta1_dot = n(v[0]);
        let theta2_dot = n(v[1]);
        let angles = [theta2, theta1];
        let circular = N::sin_cos_all(angles);
        let (sin_theta2, cos_theta2) = circular[0];
        let (sin_theta1, cos_theta1) = circular[1];
        let t0 = cos_theta2 * sin_theta1;
        let t1 = sin_theta2 * cos_theta1;
        let t2 = cos_theta2.mul_add(cos_theta1, sin_theta2 * sin_theta1);
        let t3 = n(p.k4) * t2;
        let t4 = theta2_dot * (n(p.k4) * theta2_dot);
        let t5 = (t0 - t1).mul_add(t4, sin_theta1 * n(p.k8));
        let t6 = theta1_dot * (n(p.k4) * theta1_dot);
        let t7 = n(p.k12) * t3;
        let t8 = (t1 - t0).mul_add(t6, sin_theta2 * n(p.k7));
        let t9 = t3.neg_mul_add(t7, n(p.k6));
        let t10 = t5.neg_mul_add(t7, t8) / t9;
        let theta1_ddot = t7.mul_sub(t10, n(p.k12) * t5);
        let theta2_ddot = -t10;
        let sound =
            t9.exceeds(N::from_f64(1.7763568394002505e-15) * n(p.k6)) & theta2_ddot.is_finite();
        if !sound {
            check(t9, n(p.k6), 1.7763568394002505e-15, 1)?;
        }
        let accelerations = [theta1_ddot.store(), theta2_ddot.store()];
        Ok(accelerations)
    }
}

/// Kinetic energy `T`, in J.
///
/// ```text
/// T = 1/2*(m1 + m2)*l1^2*der(theta1)^2 + m2*l1*l2*cos(theta2 - theta1)*der(theta1)*der(theta2)
///     + 1/2*m2*l2^2*der(theta2)^2
/// ```
pub fn kinetic_energy<S: ::lagrangian::Scalar>(p: &Prepared<S>, q: &[S; 2], v: &[S; 2]) -> S {
    let theta1 = q[0];
    let theta2 = q[1];
    let theta1_dot = v[0];
    let theta2_dot = v[1];
    let (sin_theta1, cos_theta1) = theta1.sin_cos();
    let (sin_theta2, cos_theta2) = theta2.sin_cos();
    let t0 = theta1_dot * p.l1;
    let t1 = theta2_dot * p.l2;
    let t2 = t1 * cos_theta2 + t0 * cos_theta1;
    let t3 = t1 * sin_theta2 + t0 * sin_theta1;
    p.k3 * (t3 * t3 + t2 * t2) + theta1_dot * (theta1_dot * p.k2)
}

/// Potential energy `V`, in J.
///
/// ```text
/// V = -(m1 + m2)*l1*g*cos(theta1) - m2*l2*g*cos(theta2)
/// ```
pub fn potential_energy<S: ::lagrangian::Scalar>(p: &Prepared<S>, q: &[S; 2]) -> S {
    let theta1 = q[0];
    let theta2 = q[1];
    let cos_theta1 = theta1.cos();
    let cos_theta2 = theta2.cos();
    -(p.k1 * (cos_theta2 * p.l2 + cos_theta1 * p.l1) + cos_theta1 * p.k0)
}

/// Names and units.
const PARAMETERS: [(&str, &str); 5] = [
    ("m1", "kg"),
    ("m2", "kg"),
    ("l1", "m"),
    ("l2", "m"),
    ("g", "m/s^2"),
];

/// Names and units.
const COORDINATES: [(&str, &str); 2] = [("theta1", "rad"), ("theta2", "rad")];

/// Names and units.
const INPUTS: [(&str, &str); 0] = [];

/// Names and units.
const OUTPUTS: [(&str, &str); 0] = [];

impl ::lagrangian::Machine for DoublePendulum {
    type System = Prepared;

    fn name(&self) -> &str {
        "DoublePendulum"
    }

    fn parameters(&self) -> impl ExactSizeIterator<Item = (::lagrangian::Quantity<'_>, f64)> {
        let values = [self.m1, self.m2, self.l1, self.l2, self.g];
        quantities(&PARAMETERS, values)
    }

    fn parameter_mut(&mut self, index: usize) -> Option<&mut f64> {
        match index {
            0 => Some(&mut self.m1),
            1 => Some(&mut self.m2),
            2 => Some(&mut self.l1),
            3 => Some(&mut self.l2),
            4 => Some(&mut self.g),
            _ => None,
        }
    }

    fn prepare(&self) -> Prepared {
        Self::prepare(self)
    }

    fn start(&self) -> ::lagrangian::State<Coordinates> {
        Self::start(self)
    }
}

impl ::lagrangian::System for Prepared {
    type Vector = [f64; 2];
    type Matrix = [f64; 4];
    type Coordinates = Coordinates;
    type Inputs = Inputs;
    type Outputs = Outputs;

    fn coordinates(&self) -> impl ExactSizeIterator<Item = ::lagrangian::Quantity<'_>> {
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
        _: &Inputs,
        result: &mut [f64; 2],
    ) -> Result<(), ::lagrangian::Singular> {
        <f64 as ::lagrangian::Number>::run_in_place(Accelerations { p: self, q, v }, result)
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

    fn applied(&self, _: f64, q: &[f64; 2], _: &[f64; 2], _: &Inputs, result: &mut [f64; 2]) {
        *result = applied(self, q);
    }

    fn forces(&self, _: f64, q: &[f64; 2], v: &[f64; 2], _: &Inputs, result: &mut [f64; 2]) {
        *result = forces(self, q, v);
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
    ) -> impl ExactSizeIterator<Item = (::lagrangian::Quantity<'_>, f64)> {
        let values = [];
        quantities(&INPUTS, values)
    }

    fn output_values(
        &self,
        _: &Outputs,
    ) -> impl ExactSizeIterator<Item = (::lagrangian::Quantity<'_>, f64)> {
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
    ) -> impl ExactSizeIterator<Item = ::lagrangian::Assumption<'_>> {
        ::core::iter::empty()
    }
}

impl<const N: usize> ::lagrangian::Batched<N> for Prepared
where
    ::lagrangian::Lanes<N>: ::lagrangian::Number,
{
    type Batch = Prepared<::lagrangian::Lanes<N>>;
    type Vectors = [::lagrangian::Lanes<N>; 2];
    type BatchInputs = Inputs;

    fn batch(systems: [&Self; N]) -> Self::Batch {
        let lanes = |number: fn(&Self) -> f64| ::lagrangian::Lanes(systems.map(number));
        Prepared {
            l1: lanes(|p| p.l1),
            l2: lanes(|p| p.l2),
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
            k10: lanes(|p| p.k10),
            k11: lanes(|p| p.k11),
            k12: lanes(|p| p.k12),
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
        _: ::lagrangian::Lanes<N>,
        q: &Self::Vectors,
        v: &Self::Vectors,
        _: &Self::BatchInputs,
        result: &mut Self::Vectors,
    ) -> Result<(), ::lagrangian::Singular> {
        <::lagrangian::Lanes<N> as ::lagrangian::Number>::run_in_place(
            Accelerations { p, q, v },
            result,
        )
    }
}

/// A name with its unit.
fn quantity<'a>(&(name, unit): &'a (&'a str, &'a str)) -> ::lagrangian::Quantity<'a> {
    ::lagrangian::Quantity { name, unit }
}

/// Names and units beside values.
fn quantities<'a, const N: usize>(
    names: &'a [(&'a str, &'a str); N],
    values: [f64; N],
) -> impl ExactSizeIterator<Item = (::lagrangian::Quantity<'a>, f64)> {
    names.iter().map(quantity).zip(values)
}

/// Refuses a pivot of which elimination has left nothing but rounding errors of a diagonal element,
/// in any of several lanes.
#[inline(always)]
fn check<N: ::lagrangian::Scalar>(
    pivot: N,
    diagonal: N,
    share: f64,
    coordinate: usize,
) -> Result<(), ::lagrangian::Singular> {
    let bound = N::from_f64(share) * diagonal;
    match pivot.exceeds(bound) {
        true => Ok(()),
        false => Err(singular(coordinate, pivot, diagonal)),
    }
}

/// Whether elimination has left nothing but rounding errors of a diagonal element; so too if it is
/// no number.
fn vanishes<S: ::lagrangian::Scalar>(pivot: S, diagonal: S, share: f64) -> bool {
    let bound = S::from_f64(share) * diagonal;
    !pivot.exceeds(bound)
}

/// The share of a pivot that is no rounding, for the message.
#[cold]
fn singular<S: ::lagrangian::Scalar>(
    coordinate: usize,
    pivot: S,
    diagonal: S,
) -> ::lagrangian::Singular {
    ::lagrangian::Singular::new(coordinate, pivot.to_f64(), diagonal.to_f64())
}
