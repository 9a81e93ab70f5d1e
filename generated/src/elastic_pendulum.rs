// @generated from machines/elastic_pendulum.machine by `cargo xtask generate`; edits are lost.

//! A point mass on a spring that swings and stretches in a vertical plane, in polar
//! coordinates.
//!
//! At rest the spring is l = l0 + m g/k long. Small motion is two oscillators, which stretch
//! with sqrt(k/m) and swing with sqrt(g/l). Up and down alone the motion is harmonic however
//! large, r = l + a cos(sqrt(k/m) t), but as steady as it looks it need not be: at k/m = 4 g/l,
//! which is chosen here, each stretching feeds the swinging, and the two take the energy by
//! turns (A. Vitt, G. Gorelik, Zh. Tekh. Fiz. 3 (1933) 294). Without gravity the angular
//! momentum m r^2 der(theta) is conserved as well, and the mass can run in a circle.
//!
//! 2 coordinates, 4 parameters, 1 output. Arithmetic of one call:
//!
//! | function | mul | add | div | sin cos | other | temporaries |
//! | --- | --: | --: | --: | --: | --: | --: |
//! | `prepare` | 4 | 2 | 1 | 0 | 0 | 7 |
//! | `mass_matrix` | 2 | 0 | 0 | 0 | 0 | 2 |
//! | `bias` | 5 | 0 | 0 | 0 | 0 | 5 |
//! | `applied` | 4 | 2 | 0 | 1 | 0 | 8 |
//! | `forces` | 9 | 5 | 0 | 1 | 0 | 16 |
//! | `accelerations` | 12 | 5 | 1 | 1 | 0 | 20 |
//! | `kinetic_energy` | 8 | 3 | 0 | 1 | 0 | 13 |
//! | `potential_energy` | 4 | 2 | 0 | 1 | 0 | 7 |
//! | `output_momentum` | 3 | 0 | 0 | 0 | 0 | 3 |
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

/// A point mass on a spring that swings and stretches in a vertical plane, in polar
/// coordinates.
///
/// At rest the spring is l = l0 + m g/k long. Small motion is two oscillators, which stretch
/// with sqrt(k/m) and swing with sqrt(g/l). Up and down alone the motion is harmonic however
/// large, r = l + a cos(sqrt(k/m) t), but as steady as it looks it need not be: at k/m = 4 g/l,
/// which is chosen here, each stretching feeds the swinging, and the two take the energy by
/// turns (A. Vitt, G. Gorelik, Zh. Tekh. Fiz. 3 (1933) 294). Without gravity the angular
/// momentum m r^2 der(theta) is conserved as well, and the mass can run in a circle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ElasticPendulum<S = f64> {
    /// Mass of the bob. Unit: `kg`. Default: 1.
    pub m: S,
    /// Stiffness of the spring. Unit: `N/m`. Default: 39.24.
    pub k: S,
    /// Length of the spring without load. Unit: `m`. Default: 0.75.
    pub l0: S,
    /// Acceleration of gravity. Unit: `m/s^2`. Default: 9.81.
    pub g: S,
}

impl Default for ElasticPendulum {
    fn default() -> Self {
        Self {
            m: 1.0,
            k: 39.24,
            l0: 0.75,
            g: 9.81,
        }
    }
}

impl<S> ElasticPendulum<S> {
    /// These values as other numbers.
    pub fn map<R>(self, f: impl Fn(S) -> R) -> ElasticPendulum<R> {
        ElasticPendulum {
            m: f(self.m),
            k: f(self.k),
            l0: f(self.l0),
            g: f(self.g),
        }
    }
}

impl<S: ::lagrangian::emitted::Scalar> ElasticPendulum<S> {
    /// Computes what depends on the parameters alone, once.
    pub fn prepare(&self) -> Prepared<S> {
        let k1 = self.m * self.g;
        let k0 = self.m * S::from_f64(0.5);
        let k2 = self.k * S::from_f64(0.5);
        let k3 = self.m * S::from_f64(2.0);
        let k4 = -self.m;
        let k5 = -k1;
        let k6 = S::ONE / self.m;
        let singular = if vanishes(self.m, self.m, 1.7763568394002505e-15) {
            Some(singular(0, self.m, self.m))
        } else {
            None
        };
        Prepared {
            m: self.m,
            k: self.k,
            l0: self.l0,
            k0,
            k1,
            k2,
            k3,
            k4,
            k5,
            k6,
            singular,
        }
    }

    /// The start values of the description, at rest and `t = 0`.
    pub fn start(&self) -> ::lagrangian::emitted::State<Coordinates<S>> {
        let r = S::from_ratio(6, 5);
        let theta = S::from_ratio(1, 10);
        let q = [r, theta];
        let v = [S::ZERO; 2];
        ::lagrangian::emitted::State {
            t: 0.0,
            q: Coordinates::from_array(q),
            v: Coordinates::from_array(v),
        }
    }
}

/// The coordinates of [`ElasticPendulum`], or their rates, by name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coordinates<S = f64> {
    /// Length of the spring. Unit: `m`.
    pub r: S,
    /// Angle of the spring from the downward vertical. Unit: `rad`.
    pub theta: S,
}

impl<S: Copy> Coordinates<S> {
    /// The numbers in the order of the description: the order of `q` in every function here.
    pub fn to_array(self) -> [S; 2] {
        [self.r, self.theta]
    }

    /// Names for numbers in the order of the description.
    pub fn from_array(q: [S; 2]) -> Self {
        Self {
            r: q[0],
            theta: q[1],
        }
    }

    /// These values as other numbers.
    pub fn map<R>(self, f: impl Fn(S) -> R) -> Coordinates<R> {
        Coordinates {
            r: f(self.r),
            theta: f(self.theta),
        }
    }
}

/// What can be set while a [`ElasticPendulum`] runs.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Inputs {}

/// What can be observed of a [`ElasticPendulum`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outputs<S = f64> {
    /// Angular momentum about the pivot: conserved where nothing weighs. Unit: `J*s`.
    pub momentum: S,
}

/// The parameters of a [`ElasticPendulum`], with the work done that depends on them alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prepared<S = f64> {
    /// `m`
    m: S,
    /// `k`
    k: S,
    /// `l0`
    l0: S,
    /// `0.5*m`
    k0: S,
    /// `m*g`
    k1: S,
    /// `0.5*k`
    k2: S,
    /// `2*m`
    k3: S,
    /// `-m`
    k4: S,
    /// `-m*g`
    k5: S,
    /// `1/m`
    k6: S,
    /// Why these parameters leave the machine without accelerations, if they do.
    singular: Option<::lagrangian::emitted::Singular>,
}

/// Mass matrix `M`.
///
/// ```text
/// M[r, r] = m
/// M[theta, theta] = m*r^2
/// ```
pub fn mass_matrix<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 2]) -> [[S; 2]; 2] {
    let r = q[0];
    let zero = S::ZERO;
    let m22 = r * (p.m * r);
    [[p.m, zero], [zero, m22]]
}

/// Bias `h`: velocity products and explicit time in the inertia forces.
///
/// ```text
/// h[r] = -m*r*der(theta)^2
/// h[theta] = 2*m*r*der(r)*der(theta)
/// ```
pub fn bias<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 2], v: &[S; 2]) -> [S; 2] {
    let r = q[0];
    let r_dot = v[0];
    let theta_dot = v[1];
    let t0 = theta_dot * r;
    let h_r = t0 * (theta_dot * p.k4);
    let h_theta = t0 * (p.k3 * r_dot);
    [h_r, h_theta]
}

/// Applied generalized forces `Q`.
///
/// ```text
/// Q[r] = m*g*cos(theta) - k*(r - l0)
/// Q[theta] = -m*g*r*sin(theta)
/// ```
pub fn applied<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 2]) -> [S; 2] {
    let r = q[0];
    let theta = q[1];
    let (sin_theta, cos_theta) = theta.sin_cos();
    let q_r = (p.l0 - r) * p.k + p.k1 * cos_theta;
    let q_theta = sin_theta * (r * p.k5);
    [q_r, q_theta]
}

/// Right-hand side `f = Q - h` of `M a = f`.
pub fn forces<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 2], v: &[S; 2]) -> [S; 2] {
    let r = q[0];
    let theta = q[1];
    let r_dot = v[0];
    let theta_dot = v[1];
    let (sin_theta, cos_theta) = theta.sin_cos();
    let t0 = theta_dot * r;
    let f_r = t0 * (theta_dot * p.m) + ((p.l0 - r) * p.k + p.k1 * cos_theta);
    let f_theta = -(t0 * (p.k3 * r_dot) + sin_theta * (r * p.k1));
    [f_r, f_theta]
}

/// Accelerations `a`, the solution of `M a = f` from the mass matrix multiplied out.
///
/// A pivot that vanishes is an error.
pub fn accelerations<S: ::lagrangian::emitted::Number>(
    p: &Prepared<S>,
    q: &[S; 2],
    v: &[S; 2],
) -> Result<[S; 2], ::lagrangian::emitted::Singular> {
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

impl<S: Copy> ::lagrangian::emitted::scalar::Kernel<S> for Accelerations<'_, S> {
    type Output = Result<[S; 2], ::lagrangian::emitted::Singular>;

    #[inline(always)]
    fn run<N: ::lagrangian::emitted::Scalar<Stored = S>>(self) -> Self::Output {
        let Self { p, q, v } = self;
        let n = N::load;
        if let Some(singular) = p.singular {
            return Err(singular);
        }
        let r = n(q[0]);
        let theta = n(q[1]);
        let r_dot = n(v[0]);
        let theta_dot = n(v[1]);
        let (sin_theta, cos_theta) = theta.sin_cos();
        let t0 = r * n(p.m);
        let t1 = r * t0;
        let t2 = r * n(p.k3) * (theta_dot * r_dot);
        let t3 = n(p.k1).mul_add(cos_theta, (n(p.l0) - r) * n(p.k));
        let r_ddot = n(p.k6) * t0.mul_add(theta_dot * theta_dot, t3);
        let theta_ddot = -(sin_theta.mul_add(r * n(p.k1), t2) / t1);
        let sound = t1.exceeds(N::from_f64(1.7763568394002505e-15) * t1) & theta_ddot.is_finite();
        if !sound {
            check(t1, t1, 1.7763568394002505e-15, 1)?;
        }
        let accelerations = [r_ddot.store(), theta_ddot.store()];
        Ok(accelerations)
    }
}

/// Kinetic energy `T`, in J.
///
/// ```text
/// T = 1/2*m*der(r)^2 + 1/2*m*r^2*der(theta)^2
/// ```
pub fn kinetic_energy<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 2],
    v: &[S; 2],
) -> S {
    let r = q[0];
    let theta = q[1];
    let r_dot = v[0];
    let theta_dot = v[1];
    let (sin_theta, cos_theta) = theta.sin_cos();
    let t0 = theta_dot * r;
    let t1 = t0 * cos_theta + sin_theta * r_dot;
    let t2 = cos_theta * r_dot - t0 * sin_theta;
    p.k0 * (t2 * t2 + t1 * t1)
}

/// Potential energy `V`, in J.
///
/// ```text
/// V = 1/2*k*(r - l0)^2 - m*g*r*cos(theta)
/// ```
pub fn potential_energy<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 2]) -> S {
    let r = q[0];
    let theta = q[1];
    let cos_theta = theta.cos();
    let t0 = p.l0 - r;
    t0 * (t0 * p.k2) - cos_theta * (p.k1 * r)
}

/// Angular momentum about the pivot: conserved where nothing weighs. Unit: `J*s`.
///
/// ```text
/// momentum = m*r^2*der(theta)
/// ```
pub fn output_momentum<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 2],
    v: &[S; 2],
) -> S {
    let r = q[0];
    let theta_dot = v[1];
    r * p.m * (r * theta_dot)
}

/// By how much `r > 0` holds.
pub fn assumption_0<S: ::lagrangian::emitted::Scalar>(q: &[S; 2]) -> S {
    let r = q[0];
    r
}

/// Everything that the description asks to observe.
pub fn outputs<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 2],
    v: &[S; 2],
) -> Outputs<S> {
    Outputs {
        momentum: output_momentum(p, q, v),
    }
}

/// Names and units.
const PARAMETERS: [(&str, &str); 4] = [("m", "kg"), ("k", "N/m"), ("l0", "m"), ("g", "m/s^2")];

/// Names and units.
const COORDINATES: [(&str, &str); 2] = [("r", "m"), ("theta", "rad")];

/// Names and units.
const INPUTS: [(&str, &str); 0] = [];

/// Names and units.
const OUTPUTS: [(&str, &str); 1] = [("momentum", "J*s")];

impl ::lagrangian::emitted::Machine for ElasticPendulum {
    type System = Prepared;

    fn name(&self) -> &str {
        "ElasticPendulum"
    }

    fn parameters(
        &self,
    ) -> impl ExactSizeIterator<Item = (::lagrangian::emitted::Quantity<'_>, f64)> {
        let values = [self.m, self.k, self.l0, self.g];
        quantities(&PARAMETERS, values)
    }

    fn parameter_mut(&mut self, index: usize) -> Option<&mut f64> {
        match index {
            0 => Some(&mut self.m),
            1 => Some(&mut self.k),
            2 => Some(&mut self.l0),
            3 => Some(&mut self.g),
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
        _: &Inputs,
        result: &mut [f64; 2],
    ) -> Result<(), ::lagrangian::emitted::Singular> {
        <f64 as ::lagrangian::emitted::Number>::run_in_place(
            Accelerations { p: self, q, v },
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
    ) -> impl ExactSizeIterator<Item = (::lagrangian::emitted::Quantity<'_>, f64)> {
        let values = [];
        quantities(&INPUTS, values)
    }

    fn output_values(
        &self,
        outputs: &Outputs,
    ) -> impl ExactSizeIterator<Item = (::lagrangian::emitted::Quantity<'_>, f64)> {
        let values = [outputs.momentum];
        quantities(&OUTPUTS, values)
    }

    fn outputs(&self, _: f64, q: &[f64; 2], v: &[f64; 2], _: &[f64; 2], _: &Inputs) -> Outputs {
        outputs(self, q, v)
    }

    fn assumptions(
        &self,
        _: f64,
        q: &[f64; 2],
        _: &[f64; 2],
        _: &Inputs,
    ) -> impl ExactSizeIterator<Item = ::lagrangian::emitted::Assumption<'_>> {
        let facts = [assumption("r > 0", true, assumption_0(q))];
        facts.into_iter()
    }
}

impl<const N: usize> ::lagrangian::emitted::Batched<N> for Prepared
where
    ::lagrangian::emitted::Lanes<N>: ::lagrangian::emitted::Number,
{
    type Batch = Prepared<::lagrangian::emitted::Lanes<N>>;
    type Vectors = [::lagrangian::emitted::Lanes<N>; 2];
    type BatchInputs = Inputs;

    fn batch(systems: [&Self; N]) -> Self::Batch {
        let lanes = |number: fn(&Self) -> f64| ::lagrangian::emitted::Lanes(systems.map(number));
        Prepared {
            m: lanes(|p| p.m),
            k: lanes(|p| p.k),
            l0: lanes(|p| p.l0),
            k0: lanes(|p| p.k0),
            k1: lanes(|p| p.k1),
            k2: lanes(|p| p.k2),
            k3: lanes(|p| p.k3),
            k4: lanes(|p| p.k4),
            k5: lanes(|p| p.k5),
            k6: lanes(|p| p.k6),
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
        v: &Self::Vectors,
        _: &Self::BatchInputs,
        result: &mut Self::Vectors,
    ) -> Result<(), ::lagrangian::emitted::Singular> {
        <::lagrangian::emitted::Lanes<N> as ::lagrangian::emitted::Number>::run_in_place(
            Accelerations { p, q, v },
            result,
        )
    }
}

impl<S: ::lagrangian::emitted::Real> ::lagrangian::emitted::MachineIn<S> for ElasticPendulum<S> {
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
    type Inputs = Inputs;

    fn coordinates(&self) -> impl ExactSizeIterator<Item = ::lagrangian::emitted::Quantity<'_>> {
        COORDINATES.iter().map(quantity)
    }

    fn to_coordinates(&self, vector: &[S; 2]) -> Coordinates<S> {
        Coordinates::from_array(*vector)
    }

    fn to_vector(&self, coordinates: &Coordinates<S>) -> [S; 2] {
        coordinates.to_array()
    }

    fn default_inputs(&self) -> Inputs {
        Inputs {}
    }

    fn accelerations(
        &self,
        _: S,
        q: &[S; 2],
        v: &[S; 2],
        _: &Inputs,
        result: &mut [S; 2],
    ) -> Result<(), ::lagrangian::emitted::Singular> {
        <S as ::lagrangian::emitted::Number>::run_in_place(Accelerations { p: self, q, v }, result)
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

/// A fact and by how much it holds.
fn assumption(text: &str, strict: bool, margin: f64) -> ::lagrangian::emitted::Assumption<'_> {
    ::lagrangian::emitted::Assumption {
        text,
        margin,
        strict,
    }
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
