// @generated from machines/kapitza_pendulum.machine by `cargo xtask generate`; edits are lost.

//! A pendulum whose pivot is shaken up and down, and which therefore can stand upside down.
//!
//! The angle is measured from the upward vertical. Shaken fast by little (a much less than l,
//! omega much more than sqrt(g/l)), the pendulum stands upright where a^2 omega^2 > 2 g l, and
//! sways there slowly, with the frequency sqrt(a^2 omega^2/(2 l^2) - g/l) (P. L. Kapitza, Zh.
//! Eksp. Teor. Fiz. 21 (1951) 588; L. D. Landau, E. M. Lifshitz, Mechanics, section 30). Small
//! motion about the vertical obeys Mathieu's equation y'' + (A - 2 Q cos 2x) y = 0 with x =
//! omega t/2, A = -4 g/(l omega^2), Q = 2 a/l: upright is stable exactly where A lies between
//! the characteristic values a_0(Q) and b_1(Q). Beyond the second, shaken too hard, the
//! pendulum swings with half the frequency of its pivot.
//!
//! 1 coordinate, 5 parameters, 1 output. Arithmetic of one call:
//!
//! | function | mul | add | div | sin cos | other | temporaries |
//! | --- | --: | --: | --: | --: | --: | --: |
//! | `prepare` | 11 | 0 | 1 | 0 | 0 | 12 |
//! | `bias` | 5 | 1 | 0 | 2 | 0 | 9 |
//! | `applied` | 1 | 0 | 0 | 1 | 0 | 2 |
//! | `forces` | 6 | 2 | 0 | 2 | 0 | 11 |
//! | `accelerations` | 6 | 2 | 0 | 2 | 0 | 11 |
//! | `kinetic_energy` | 11 | 3 | 0 | 2 | 0 | 18 |
//! | `potential_energy` | 6 | 2 | 0 | 2 | 0 | 11 |
//! | `work_rate` | 12 | 5 | 0 | 2 | 0 | 21 |
//! | `output_force` | 9 | 4 | 0 | 2 | 0 | 17 |
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

/// A pendulum whose pivot is shaken up and down, and which therefore can stand upside down.
///
/// The angle is measured from the upward vertical. Shaken fast by little (a much less than l,
/// omega much more than sqrt(g/l)), the pendulum stands upright where a^2 omega^2 > 2 g l, and
/// sways there slowly, with the frequency sqrt(a^2 omega^2/(2 l^2) - g/l) (P. L. Kapitza, Zh.
/// Eksp. Teor. Fiz. 21 (1951) 588; L. D. Landau, E. M. Lifshitz, Mechanics, section 30). Small
/// motion about the vertical obeys Mathieu's equation y'' + (A - 2 Q cos 2x) y = 0 with x =
/// omega t/2, A = -4 g/(l omega^2), Q = 2 a/l: upright is stable exactly where A lies between
/// the characteristic values a_0(Q) and b_1(Q). Beyond the second, shaken too hard, the
/// pendulum swings with half the frequency of its pivot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct KapitzaPendulum<S = f64> {
    /// Mass of the bob. It cancels. Unit: `kg`. Default: 1.
    pub m: S,
    /// Length of the rod. Unit: `m`. Default: 1.
    pub l: S,
    /// Amplitude of the pivot. Unit: `m`. Default: 0.1.
    pub a: S,
    /// Frequency of the pivot: it shakes with twice the least that holds the pendulum up. Unit:
    /// `rad/s`. Default: 88.
    pub omega: S,
    /// Acceleration of gravity. Unit: `m/s^2`. Default: 9.81.
    pub g: S,
}

impl Default for KapitzaPendulum {
    fn default() -> Self {
        Self {
            m: 1.0,
            l: 1.0,
            a: 0.1,
            omega: 88.0,
            g: 9.81,
        }
    }
}

impl<S> KapitzaPendulum<S> {
    /// These values as other numbers.
    pub fn map<R>(self, f: impl Fn(S) -> R) -> KapitzaPendulum<R> {
        KapitzaPendulum {
            m: f(self.m),
            l: f(self.l),
            a: f(self.a),
            omega: f(self.omega),
            g: f(self.g),
        }
    }
}

impl<S: ::lagrangian::emitted::Scalar> KapitzaPendulum<S> {
    /// Computes what depends on the parameters alone, once.
    pub fn prepare(&self) -> Prepared<S> {
        let t0 = self.m * self.l;
        let k0 = self.a * self.omega;
        let k4 = self.m * self.g;
        let k5 = self.l * t0;
        let k1 = self.omega * k0;
        let k2 = self.l * self.l;
        let k3 = self.m * S::from_f64(0.5);
        let k6 = self.g * t0;
        let k7 = k0 * k4;
        let k8 = self.m * k0;
        let k9 = k1 * t0;
        let k10 = S::ONE / k5;
        let singular = if vanishes(k5, k5, 8.881784197001252e-16) {
            Some(singular(0, k5, k5))
        } else {
            None
        };
        Prepared {
            m: self.m,
            l: self.l,
            a: self.a,
            omega: self.omega,
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
            k9,
            k10,
            singular,
        }
    }

    /// The start values of the description, at rest and `t = 0`.
    pub fn start(&self) -> ::lagrangian::emitted::State<Coordinates<S>> {
        let theta = S::from_ratio(3, 10);
        let q = [theta];
        let v = [S::ZERO; 1];
        ::lagrangian::emitted::State {
            t: 0.0,
            q: Coordinates::from_array(q),
            v: Coordinates::from_array(v),
        }
    }
}

/// The coordinates of [`KapitzaPendulum`], or their rates, by name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coordinates<S = f64> {
    /// Angle of the rod from the upward vertical. Unit: `rad`.
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

/// What can be set while a [`KapitzaPendulum`] runs.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Inputs {}

/// What can be observed of a [`KapitzaPendulum`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outputs<S = f64> {
    /// Force that shakes the pivot, upwards. Unit: `N`.
    pub force: S,
}

/// The parameters of a [`KapitzaPendulum`], with the work done that depends on them alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prepared<S = f64> {
    /// `m`
    m: S,
    /// `l`
    l: S,
    /// `a`
    a: S,
    /// `omega`
    omega: S,
    /// `g`
    g: S,
    /// `a*omega`
    k0: S,
    /// `a*omega^2`
    k1: S,
    /// `l^2`
    k2: S,
    /// `0.5*m`
    k3: S,
    /// `m*g`
    k4: S,
    /// `m*l^2`
    k5: S,
    /// `m*l*g`
    k6: S,
    /// `m*a*omega*g`
    k7: S,
    /// `m*a*omega`
    k8: S,
    /// `m*l*a*omega^2`
    k9: S,
    /// `1/m/l^2`
    k10: S,
    /// Why these parameters leave the machine without accelerations, if they do.
    singular: Option<::lagrangian::emitted::Singular>,
}

/// Mass matrix `M`.
///
/// ```text
/// M[theta, theta] = m*l^2
/// ```
pub fn mass_matrix<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>) -> [[S; 1]; 1] {
    [[p.k5]]
}

/// Bias `h`: velocity products and explicit time in the inertia forces.
///
/// ```text
/// h[theta] = m*l*a*omega^2*cos(omega*t)*sin(theta)
/// ```
pub fn bias<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, t: S, q: &[S; 1]) -> [S; 1] {
    let theta = q[0];
    let t0 = p.omega * t;
    let sin_theta = theta.sin();
    let (sin_t0, cos_t0) = t0.sin_cos();
    let h_theta = (cos_t0 - p.omega.product_error(t) * sin_t0) * (p.k9 * sin_theta);
    [h_theta]
}

/// Applied generalized forces `Q`.
///
/// ```text
/// Q[theta] = m*l*g*sin(theta)
/// ```
pub fn applied<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 1]) -> [S; 1] {
    let theta = q[0];
    let sin_theta = theta.sin();
    let q_theta = p.k6 * sin_theta;
    [q_theta]
}

/// Right-hand side `f = Q - h` of `M a = f`.
pub fn forces<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, t: S, q: &[S; 1]) -> [S; 1] {
    let theta = q[0];
    let t0 = p.omega * t;
    let sin_theta = theta.sin();
    let (sin_t0, cos_t0) = t0.sin_cos();
    let t1 = (cos_t0 - p.omega.product_error(t) * sin_t0) * (sin_theta * p.k9);
    let f_theta = sin_theta * p.k6 - t1;
    [f_theta]
}

/// Accelerations `a`, the solution of `M a = f` from the mass matrix multiplied out, factored.
///
/// A pivot that vanishes is an error.
pub fn accelerations<S: ::lagrangian::emitted::Number>(
    p: &Prepared<S>,
    t: S,
    q: &[S; 1],
) -> Result<[S; 1], ::lagrangian::emitted::Singular> {
    S::run(Accelerations { p, t, q })
}

/// A call of [`accelerations`], to be run with whatever instructions the processor has.
pub struct Accelerations<'a, S> {
    /// As `accelerations` takes it.
    pub p: &'a Prepared<S>,
    /// As `accelerations` takes it.
    pub t: S,
    /// As `accelerations` takes it.
    pub q: &'a [S; 1],
}

impl<S: Copy> ::lagrangian::emitted::scalar::Kernel<S> for Accelerations<'_, S> {
    type Output = Result<[S; 1], ::lagrangian::emitted::Singular>;

    #[inline(always)]
    fn run<N: ::lagrangian::emitted::Scalar<Stored = S>>(self) -> Self::Output {
        let Self { p, t, q } = self;
        let n = N::load;
        if let Some(singular) = p.singular {
            return Err(singular);
        }
        let theta = n(q[0]);
        let t0 = n(p.omega) * n(t);
        let angles = [theta, t0];
        let circular = N::sin_cos_all(angles);
        let (sin_theta, _) = circular[0];
        let (sin_t0, cos_t0) = circular[1];
        let t1 = n(p.omega).product_error(n(t)).neg_mul_add(sin_t0, cos_t0);
        let theta_ddot = n(p.k9).neg_mul_add(t1, n(p.k6)) * (n(p.k10) * sin_theta);
        let accelerations = [theta_ddot.store()];
        Ok(accelerations)
    }
}

/// Kinetic energy `T`, in J.
///
/// ```text
/// T = 1/2*m*(l^2*cos(theta)^2*der(theta)^2 + (-l*sin(theta)*der(theta) - a*omega*sin(omega*t))^2)
/// ```
pub fn kinetic_energy<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    t: S,
    q: &[S; 1],
    v: &[S; 1],
) -> S {
    let theta = q[0];
    let theta_dot = v[0];
    let t0 = p.omega * t;
    let (sin_theta, cos_theta) = theta.sin_cos();
    let (sin_t0, cos_t0) = t0.sin_cos();
    let t1 = cos_theta * theta_dot;
    let t2 = p.k0 * (sin_t0 + p.omega.product_error(t) * cos_t0);
    let t3 = sin_theta * (theta_dot * p.l) + t2;
    p.k3 * (t1 * (t1 * p.k2) + t3 * t3)
}

/// Potential energy `V`, in J.
///
/// ```text
/// V = m*g*(l*cos(theta) + a*cos(omega*t))
/// ```
pub fn potential_energy<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, t: S, q: &[S; 1]) -> S {
    let theta = q[0];
    let t0 = p.omega * t;
    let cos_theta = theta.cos();
    let (sin_t0, cos_t0) = t0.sin_cos();
    let t1 = cos_theta * p.l + (cos_t0 - p.omega.product_error(t) * sin_t0) * p.a;
    p.k4 * t1
}

/// Power `P` that drives, forces and inputs put in, in W.
///
/// ```text
/// P = -m*a*omega*sin(omega*t)*(l*(-sin(theta)*der(der(theta)) - cos(theta)*der(theta)^2) -
///     a*omega^2*cos(omega*t)) - m*a*omega*g*sin(omega*t)
/// ```
pub fn work_rate<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    t: S,
    q: &[S; 1],
    v: &[S; 1],
    a: &[S; 1],
) -> S {
    let theta = q[0];
    let theta_dot = v[0];
    let theta_ddot = a[0];
    let t0 = p.omega * t;
    let (sin_theta, cos_theta) = theta.sin_cos();
    let t1 = p.omega.product_error(t);
    let (sin_t0, cos_t0) = t0.sin_cos();
    let t2 = sin_t0 + t1 * cos_t0;
    let t3 = (cos_theta * (theta_dot * theta_dot) + sin_theta * theta_ddot) * p.l;
    (t3 + (cos_t0 - t1 * sin_t0) * p.k1) * (t2 * p.k8) - t2 * p.k7
}

/// Force that shakes the pivot, upwards. Unit: `N`.
///
/// ```text
/// force = m*((-(l*sin(theta)*der(der(theta)) + l*cos(theta)*der(theta)^2) -
///     a*omega^2*cos(omega*t)) + g)
/// ```
pub fn output_force<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    t: S,
    q: &[S; 1],
    v: &[S; 1],
    a: &[S; 1],
) -> S {
    let theta = q[0];
    let theta_dot = v[0];
    let theta_ddot = a[0];
    let t0 = p.omega * t;
    let (sin_theta, cos_theta) = theta.sin_cos();
    let (sin_t0, cos_t0) = t0.sin_cos();
    let t1 = (cos_theta * (theta_dot * theta_dot) + sin_theta * theta_ddot) * p.l;
    (p.g - (t1 + p.k1 * (cos_t0 - p.omega.product_error(t) * sin_t0))) * p.m
}

/// Everything that the description asks to observe.
pub fn outputs<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    t: S,
    q: &[S; 1],
    v: &[S; 1],
    a: &[S; 1],
) -> Outputs<S> {
    Outputs {
        force: output_force(p, t, q, v, a),
    }
}

/// Names and units.
const PARAMETERS: [(&str, &str); 5] = [
    ("m", "kg"),
    ("l", "m"),
    ("a", "m"),
    ("omega", "rad/s"),
    ("g", "m/s^2"),
];

/// Names and units.
const COORDINATES: [(&str, &str); 1] = [("theta", "rad")];

/// Names and units.
const INPUTS: [(&str, &str); 0] = [];

/// Names and units.
const OUTPUTS: [(&str, &str); 1] = [("force", "N")];

impl ::lagrangian::emitted::Machine for KapitzaPendulum {
    type System = Prepared;

    fn name(&self) -> &str {
        "KapitzaPendulum"
    }

    fn parameters(
        &self,
    ) -> impl ExactSizeIterator<Item = (::lagrangian::emitted::Quantity<'_>, f64)> {
        let values = [self.m, self.l, self.a, self.omega, self.g];
        quantities(&PARAMETERS, values)
    }

    fn parameter_mut(&mut self, index: usize) -> Option<&mut f64> {
        match index {
            0 => Some(&mut self.m),
            1 => Some(&mut self.l),
            2 => Some(&mut self.a),
            3 => Some(&mut self.omega),
            4 => Some(&mut self.g),
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
        t: f64,
        q: &[f64; 1],
        _: &[f64; 1],
        _: &Inputs,
        result: &mut [f64; 1],
    ) -> Result<(), ::lagrangian::emitted::Singular> {
        <f64 as ::lagrangian::emitted::Number>::run_in_place(
            Accelerations { p: self, t, q },
            result,
        )
    }

    fn mass_matrix(&self, _: f64, _: &[f64; 1], matrix: &mut [f64; 1]) {
        let rows = mass_matrix(self);
        for (to, from) in matrix.iter_mut().zip(rows.as_flattened()) {
            *to = *from;
        }
    }

    fn bias(&self, t: f64, q: &[f64; 1], _: &[f64; 1], result: &mut [f64; 1]) {
        *result = bias(self, t, q);
    }

    fn applied(&self, _: f64, q: &[f64; 1], _: &[f64; 1], _: &Inputs, result: &mut [f64; 1]) {
        *result = applied(self, q);
    }

    fn forces(&self, t: f64, q: &[f64; 1], _: &[f64; 1], _: &Inputs, result: &mut [f64; 1]) {
        *result = forces(self, t, q);
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
        outputs: &Outputs,
    ) -> impl ExactSizeIterator<Item = (::lagrangian::emitted::Quantity<'_>, f64)> {
        let values = [outputs.force];
        quantities(&OUTPUTS, values)
    }

    fn outputs(&self, t: f64, q: &[f64; 1], v: &[f64; 1], a: &[f64; 1], _: &Inputs) -> Outputs {
        outputs(self, t, q, v, a)
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
            a: lanes(|p| p.a),
            omega: lanes(|p| p.omega),
            g: lanes(|p| p.g),
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
        t: ::lagrangian::emitted::Lanes<N>,
        q: &Self::Vectors,
        _: &Self::Vectors,
        _: &Self::BatchInputs,
        result: &mut Self::Vectors,
    ) -> Result<(), ::lagrangian::emitted::Singular> {
        <::lagrangian::emitted::Lanes<N> as ::lagrangian::emitted::Number>::run_in_place(
            Accelerations { p, t, q },
            result,
        )
    }
}

impl<S: ::lagrangian::emitted::Real> ::lagrangian::emitted::MachineIn<S> for KapitzaPendulum<S> {
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
        t: S,
        q: &[S; 1],
        _: &[S; 1],
        _: &Inputs,
        result: &mut [S; 1],
    ) -> Result<(), ::lagrangian::emitted::Singular> {
        <S as ::lagrangian::emitted::Number>::run_in_place(Accelerations { p: self, t, q }, result)
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
