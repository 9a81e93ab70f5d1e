// @generated from machines/chaplygin_sleigh.machine by `cargo xtask generate`; edits are lost.

//! A sleigh of S. A. Chaplygin: a rigid body on ice with one blade, which goes along itself only;
//! its
//! mass centre is ahead of the blade. It turns until it runs with the mass centre in front.
//!
//! 3 coordinates, 3 parameters, 1 output. Arithmetic of one call:
//!
//! | function | mul | add | div | sin cos | other | temporaries |
//! | --- | --: | --: | --: | --: | --: | --: |
//! | `prepare` | 2 | 2 | 2 | 0 | 0 | 6 |
//! | `mass_matrix` | 2 | 0 | 0 | 1 | 0 | 4 |
//! | `bias` | 4 | 0 | 0 | 1 | 0 | 6 |
//! | `forces` | 4 | 0 | 0 | 1 | 0 | 6 |
//! | `constraint_rates` | 2 | 1 | 0 | 1 | 0 | 5 |
//! | `constraint_matrix` | 0 | 1 | 0 | 1 | 0 | 3 |
//! | `constraint_drift` | 4 | 1 | 0 | 1 | 0 | 7 |
//! | `accelerations` | 22 | 8 | 1 | 1 | 0 | 33 |
//! | `multipliers` | 10 | 4 | 1 | 1 | 0 | 17 |
//! | `kinetic_energy` | 9 | 4 | 0 | 1 | 0 | 15 |
//! | `output_along` | 2 | 1 | 0 | 1 | 0 | 5 |
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

/// A sleigh of S. A. Chaplygin: a rigid body on ice with one blade, which goes along itself only;
/// its
/// mass centre is ahead of the blade. It turns until it runs with the mass centre in front.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ChaplyginSleigh<S = f64> {
    /// `m`. Unit: `kg`. Default: 1.
    pub m: S,
    /// Inertia about the mass centre. Unit: `kg*m^2`. Default: 0.05.
    pub J: S,
    /// Distance of the mass centre ahead of the blade. Unit: `m`. Default: 0.3.
    pub a: S,
}

impl Default for ChaplyginSleigh {
    fn default() -> Self {
        Self {
            m: 1.0,
            J: 0.05,
            a: 0.3,
        }
    }
}

impl<S> ChaplyginSleigh<S> {
    /// These values as other numbers.
    pub fn map<R>(self, f: impl Fn(S) -> R) -> ChaplyginSleigh<R> {
        ChaplyginSleigh {
            m: f(self.m),
            J: f(self.J),
            a: f(self.a),
        }
    }
}

impl<S: ::lagrangian::emitted::Scalar> ChaplyginSleigh<S> {
    /// Computes what depends on the parameters alone, once.
    pub fn prepare(&self) -> Prepared<S> {
        let k0 = self.m * self.a;
        let k1 = self.J + self.a * k0;
        let k2 = -k0;
        let k3 = S::ONE / self.m;
        let k4 = S::ONE / self.J;
        let singular = if vanishes(self.m, self.m, 3.552713678800501e-15) {
            Some(singular(0, self.m, self.m))
        } else if vanishes(self.m, self.m, 3.552713678800501e-15) {
            Some(singular(1, self.m, self.m))
        } else if vanishes(self.J, k1, 3.552713678800501e-15) {
            Some(singular(2, self.J, k1))
        } else {
            None
        };
        Prepared {
            m: self.m,
            J: self.J,
            a: self.a,
            k0,
            k1,
            k2,
            k3,
            k4,
            singular,
        }
    }

    /// The start values of the description, at `t = 0`.
    pub fn start(&self) -> ::lagrangian::emitted::State<Coordinates<S>> {
        let zero = S::ZERO;
        let x_rate = S::from_ratio(2, 5);
        let q = [zero, zero, zero];
        let v = [x_rate, zero, S::from_f64(3.0)];
        ::lagrangian::emitted::State {
            t: 0.0,
            q: Coordinates::from_array(q),
            v: Coordinates::from_array(v),
        }
    }
}

/// The coordinates of [`ChaplyginSleigh`], or their rates, by name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coordinates<S = f64> {
    /// Where the blade touches the ice. Unit: `m`.
    pub x: S,
    /// `y`. Unit: `m`.
    pub y: S,
    /// Direction of the blade. Unit: `rad`.
    pub phi: S,
}

impl<S: Copy> Coordinates<S> {
    /// The numbers in the order of the description: the order of `q` in every function here.
    pub fn to_array(self) -> [S; 3] {
        [self.x, self.y, self.phi]
    }

    /// Names for numbers in the order of the description.
    pub fn from_array(q: [S; 3]) -> Self {
        Self {
            x: q[0],
            y: q[1],
            phi: q[2],
        }
    }

    /// These values as other numbers.
    pub fn map<R>(self, f: impl Fn(S) -> R) -> Coordinates<R> {
        Coordinates {
            x: f(self.x),
            y: f(self.y),
            phi: f(self.phi),
        }
    }
}

/// What can be set while a [`ChaplyginSleigh`] runs.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Inputs {}

/// What can be observed of a [`ChaplyginSleigh`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outputs<S = f64> {
    /// Speed along the blade. Unit: `m/s`.
    pub along: S,
}

/// The parameters of a [`ChaplyginSleigh`], with the work done that depends on them alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prepared<S = f64> {
    /// `m`
    m: S,
    /// `J`
    J: S,
    /// `a`
    a: S,
    /// `m*a`
    k0: S,
    /// `J + m*a^2`
    k1: S,
    /// `-m*a`
    k2: S,
    /// `1/m`
    k3: S,
    /// `1/J`
    k4: S,
    /// Why these parameters leave the machine without accelerations, if they do.
    singular: Option<::lagrangian::emitted::Singular>,
}

/// Mass matrix `M`.
///
/// ```text
/// M[x, x] = m
/// M[y, y] = m
/// M[phi, x] = -m*a*sin(phi)
/// M[phi, y] = m*a*cos(phi)
/// M[phi, phi] = m*a^2 + J
/// ```
pub fn mass_matrix<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 3]) -> [[S; 3]; 3] {
    let phi = q[2];
    let (sin_phi, cos_phi) = phi.sin_cos();
    let zero = S::ZERO;
    let m31 = p.k2 * sin_phi;
    let m32 = cos_phi * p.k0;
    [[p.m, zero, m31], [zero, p.m, m32], [m31, m32, p.k1]]
}

/// Bias `h`: velocity products and explicit time in the inertia forces.
///
/// ```text
/// h[x] = -m*a*cos(phi)*der(phi)^2
/// h[y] = -m*a*sin(phi)*der(phi)^2
/// ```
pub fn bias<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 3], v: &[S; 3]) -> [S; 3] {
    let phi = q[2];
    let phi_dot = v[2];
    let (sin_phi, cos_phi) = phi.sin_cos();
    let t0 = phi_dot * (phi_dot * p.k2);
    let h_x = t0 * cos_phi;
    let h_y = t0 * sin_phi;
    let zero = S::ZERO;
    [h_x, h_y, zero]
}

/// Right-hand side `f = Q - h` of `M a = f`.
pub fn forces<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 3], v: &[S; 3]) -> [S; 3] {
    let phi = q[2];
    let phi_dot = v[2];
    let (sin_phi, cos_phi) = phi.sin_cos();
    let t0 = phi_dot * (phi_dot * p.k0);
    let f_x = t0 * cos_phi;
    let f_y = t0 * sin_phi;
    let zero = S::ZERO;
    [f_x, f_y, zero]
}

/// Residuals `phi = G v + dg/dt` of the constraints at the level of velocities.
///
/// ```text
/// phi[blade] = cos(phi)*der(y) - sin(phi)*der(x)
/// ```
pub fn constraint_rates<S: ::lagrangian::emitted::Scalar>(q: &[S; 3], v: &[S; 3]) -> [S; 1] {
    let phi = q[2];
    let x_dot = v[0];
    let y_dot = v[1];
    let (sin_phi, cos_phi) = phi.sin_cos();
    let phi1 = cos_phi * y_dot - sin_phi * x_dot;
    [phi1]
}

/// Constraint matrix `G`, the derivatives of `phi` by the rates.
///
/// ```text
/// G[blade, x] = -sin(phi)
/// G[blade, y] = cos(phi)
/// ```
pub fn constraint_matrix<S: ::lagrangian::emitted::Scalar>(q: &[S; 3]) -> [S; 3] {
    let phi = q[2];
    let (sin_phi, cos_phi) = phi.sin_cos();
    let g1_1 = -sin_phi;
    let zero = S::ZERO;
    [g1_1, cos_phi, zero]
}

/// Right-hand side `gamma` of `G a = gamma`.
///
/// ```text
/// gamma[blade] = cos(phi)*der(x)*der(phi) + sin(phi)*der(y)*der(phi)
/// ```
pub fn constraint_drift<S: ::lagrangian::emitted::Scalar>(q: &[S; 3], v: &[S; 3]) -> [S; 1] {
    let phi = q[2];
    let x_dot = v[0];
    let y_dot = v[1];
    let phi_dot = v[2];
    let (sin_phi, cos_phi) = phi.sin_cos();
    let gamma1 = cos_phi * (phi_dot * x_dot) + sin_phi * (phi_dot * y_dot);
    [gamma1]
}

/// Accelerations `a`, the solution of `M a = f + G^T lambda`, `G a = gamma` eliminated along the
/// machine.
///
/// A pivot that vanishes is an error.
pub fn accelerations<S: ::lagrangian::emitted::Number>(
    p: &Prepared<S>,
    q: &[S; 3],
    v: &[S; 3],
) -> Result<[S; 3], ::lagrangian::emitted::Singular> {
    S::run(Accelerations { p, q, v })
}

/// A call of [`accelerations`], to be run with whatever instructions the processor has.
pub struct Accelerations<'a, S> {
    /// As `accelerations` takes it.
    pub p: &'a Prepared<S>,
    /// As `accelerations` takes it.
    pub q: &'a [S; 3],
    /// As `accelerations` takes it.
    pub v: &'a [S; 3],
}

impl<S: Copy> ::lagrangian::emitted::scalar::Kernel<S> for Accelerations<'_, S> {
    type Output = Result<[S; 3], ::lagrangian::emitted::Singular>;

    #[inline(always)]
    fn run<N: ::lagrangian::emitted::Scalar<Stored = S>>(self) -> Self::Output {
        let Self { p, q, v } = self;
        let n = N::load;
        if let Some(singular) = p.singular {
            return Err(singular);
        }
        let phi = n(q[2]);
        let x_dot = n(v[0]);
        let y_dot = n(v[1]);
        let phi_dot = n(v[2]);
        let (sin_phi, cos_phi) = phi.sin_cos();
        let t0 = phi_dot * phi_dot;
        let t1 = sin_phi * n(p.a);
        let t2 = cos_phi * n(p.a);
        let t3 = sin_phi * (phi_dot * y_dot);
        let t4 = n(p.a) * sin_phi.mul_add(sin_phi, cos_phi * cos_phi);
        let t5 = t4 * n(p.k4);
        let t6 = t5.mul_add(t1, sin_phi * n(p.k3));
        let t7 = t2.mul_add(t5, cos_phi * n(p.k3));
        let t8 = cos_phi.mul_add(t7, sin_phi * t6);
        let t9 = cos_phi.mul_add(phi_dot * x_dot, t3) / t8;
        let x_ddot = t6.neg_mul_add(t9, t0 * t2);
        let y_ddot = t7.mul_add(t9, t0 * t1);
        let phi_ddot = -(t5 * t9);
        let sound = t8.exceeds(N::from_f64(3.552713678800501e-15) * t8) & phi_ddot.is_finite();
        if !sound {
            check(t8, t8, 3.552713678800501e-15, 3)?;
        }
        let accelerations = [x_ddot.store(), y_ddot.store(), phi_ddot.store()];
        Ok(accelerations)
    }
}

/// Lagrange's multipliers `lambda` of `M a = f + G^T lambda`.
///
/// A pivot that vanishes is an error.
pub fn multipliers<S: ::lagrangian::emitted::Number>(
    p: &Prepared<S>,
    q: &[S; 3],
    v: &[S; 3],
) -> Result<[S; 1], ::lagrangian::emitted::Singular> {
    S::run(Multipliers { p, q, v })
}

/// A call of [`multipliers`], to be run with whatever instructions the processor has.
pub struct Multipliers<'a, S> {
    /// As `multipliers` takes it.
    pub p: &'a Prepared<S>,
    /// As `multipliers` takes it.
    pub q: &'a [S; 3],
    /// As `multipliers` takes it.
    pub v: &'a [S; 3],
}

impl<S: Copy> ::lagrangian::emitted::scalar::Kernel<S> for Multipliers<'_, S> {
    type Output = Result<[S; 1], ::lagrangian::emitted::Singular>;

    #[inline(always)]
    fn run<N: ::lagrangian::emitted::Scalar<Stored = S>>(self) -> Self::Output {
        let Self { p, q, v } = self;
        let n = N::load;
        if let Some(singular) = p.singular {
            return Err(singular);
        }
        let phi = n(q[2]);
        let x_dot = n(v[0]);
        let y_dot = n(v[1]);
        let phi_dot = n(v[2]);
        let (sin_phi, cos_phi) = phi.sin_cos();
        let t0 = sin_phi * sin_phi;
        let t1 = cos_phi * cos_phi;
        let t2 = n(p.a).mul_add(n(p.a) * (t0 + t1) * n(p.k4), n(p.k3));
        let t3 = t1.mul_add(t2, t0 * t2);
        let lambda1 = cos_phi.mul_add(x_dot, sin_phi * y_dot) * phi_dot / t3;
        let sound = t3.exceeds(N::from_f64(3.552713678800501e-15) * t3) & lambda1.is_finite();
        if !sound {
            check(t3, t3, 3.552713678800501e-15, 3)?;
        }
        let multipliers = [lambda1.store()];
        Ok(multipliers)
    }
}

/// Kinetic energy `T`, in J.
///
/// ```text
/// T = 1/2*J*der(phi)^2
///     + 1/2*m*((der(x) - a*sin(phi)*der(phi))^2 + (der(y) + a*cos(phi)*der(phi))^2)
/// ```
pub fn kinetic_energy<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 3],
    v: &[S; 3],
) -> S {
    let phi = q[2];
    let x_dot = v[0];
    let y_dot = v[1];
    let phi_dot = v[2];
    let (sin_phi, cos_phi) = phi.sin_cos();
    let t0 = phi_dot * p.a;
    let t1 = x_dot - t0 * sin_phi;
    let t2 = t0 * cos_phi + y_dot;
    let t3 = (t2 * t2 + t1 * t1) * p.m + phi_dot * (phi_dot * p.J);
    S::from_f64(0.5) * t3
}

/// Speed along the blade. Unit: `m/s`.
///
/// ```text
/// along = cos(phi)*der(x) + sin(phi)*der(y)
/// ```
pub fn output_along<S: ::lagrangian::emitted::Scalar>(q: &[S; 3], v: &[S; 3]) -> S {
    let phi = q[2];
    let x_dot = v[0];
    let y_dot = v[1];
    let (sin_phi, cos_phi) = phi.sin_cos();
    sin_phi * y_dot + cos_phi * x_dot
}

/// Everything that the description asks to observe.
pub fn outputs<S: ::lagrangian::emitted::Scalar>(q: &[S; 3], v: &[S; 3]) -> Outputs<S> {
    Outputs {
        along: output_along(q, v),
    }
}

/// Names and units.
const PARAMETERS: [(&str, &str); 3] = [("m", "kg"), ("J", "kg*m^2"), ("a", "m")];

/// Names and units.
const COORDINATES: [(&str, &str); 3] = [("x", "m"), ("y", "m"), ("phi", "rad")];

/// Names and units.
const INPUTS: [(&str, &str); 0] = [];

/// Names and units.
const OUTPUTS: [(&str, &str); 1] = [("along", "m/s")];

/// Names, units, units of multipliers, whether positions are constrained.
const CONSTRAINTS: [(&str, &str, &str, bool); 1] = [("blade", "m/s", "N", false)];

impl ::lagrangian::emitted::Machine for ChaplyginSleigh {
    type System = Prepared;

    fn name(&self) -> &str {
        "ChaplyginSleigh"
    }

    fn parameters(
        &self,
    ) -> impl ExactSizeIterator<Item = (::lagrangian::emitted::Quantity<'_>, f64)> {
        let values = [self.m, self.J, self.a];
        quantities(&PARAMETERS, values)
    }

    fn parameter_mut(&mut self, index: usize) -> Option<&mut f64> {
        match index {
            0 => Some(&mut self.m),
            1 => Some(&mut self.J),
            2 => Some(&mut self.a),
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
    type Vector = [f64; 3];
    type Matrix = [f64; 9];
    type Coordinates = Coordinates;
    type Inputs = Inputs;
    type Outputs = Outputs;
    const MAY_SLIDE: bool = false;
    const MAY_COLLIDE: bool = false;

    fn coordinates(&self) -> impl ExactSizeIterator<Item = ::lagrangian::emitted::Quantity<'_>> {
        COORDINATES.iter().map(quantity)
    }

    fn to_coordinates(&self, vector: &[f64; 3]) -> Coordinates {
        Coordinates::from_array(*vector)
    }

    fn to_vector(&self, coordinates: &Coordinates) -> [f64; 3] {
        coordinates.to_array()
    }

    fn accelerations(
        &self,
        _: f64,
        q: &[f64; 3],
        v: &[f64; 3],
        _: &Inputs,
        result: &mut [f64; 3],
    ) -> Result<(), ::lagrangian::emitted::Singular> {
        <f64 as ::lagrangian::emitted::Number>::run_in_place(
            Accelerations { p: self, q, v },
            result,
        )
    }

    fn mass_matrix(&self, _: f64, q: &[f64; 3], matrix: &mut [f64; 9]) {
        let rows = mass_matrix(self, q);
        for (to, from) in matrix.iter_mut().zip(rows.as_flattened()) {
            *to = *from;
        }
    }

    fn bias(&self, _: f64, q: &[f64; 3], v: &[f64; 3], result: &mut [f64; 3]) {
        *result = bias(self, q, v);
    }

    fn applied(&self, _: f64, _: &[f64; 3], _: &[f64; 3], _: &Inputs, result: &mut [f64; 3]) {
        *result = [0.0; 3];
    }

    fn forces(&self, _: f64, q: &[f64; 3], v: &[f64; 3], _: &Inputs, result: &mut [f64; 3]) {
        *result = forces(self, q, v);
    }

    fn constraint_positions(&self, _: f64, _: &[f64; 3], to: &mut [f64]) {
        to.fill(0.0);
    }

    fn constraint_rates(&self, _: f64, q: &[f64; 3], v: &[f64; 3], to: &mut [f64]) {
        fill(to, &constraint_rates(q, v));
    }

    fn constraint_matrix(&self, _: f64, q: &[f64; 3], to: &mut [f64]) {
        fill(to, &constraint_matrix(q));
    }

    fn constraint_drift(&self, _: f64, q: &[f64; 3], v: &[f64; 3], to: &mut [f64]) {
        fill(to, &constraint_drift(q, v));
    }

    fn kinetic_energy(&self, _: f64, q: &[f64; 3], v: &[f64; 3]) -> f64 {
        kinetic_energy(self, q, v)
    }

    fn potential_energy(&self, _: f64, _: &[f64; 3], _: &Inputs) -> f64 {
        0.0
    }

    fn dissipation(&self, _: f64, _: &[f64; 3], _: &[f64; 3], _: &Inputs) -> f64 {
        0.0
    }

    fn work_rate(&self, _: f64, _: &[f64; 3], _: &[f64; 3], _: &[f64; 3], _: &Inputs) -> f64 {
        0.0
    }

    fn dissipation_rate(&self, _: f64, _: &[f64; 3], _: &[f64; 3], _: &Inputs) -> f64 {
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
        let values = [outputs.along];
        quantities(&OUTPUTS, values)
    }

    fn outputs(&self, _: f64, q: &[f64; 3], v: &[f64; 3], _: &[f64; 3], _: &Inputs) -> Outputs {
        outputs(q, v)
    }

    fn assumptions(
        &self,
        _: f64,
        _: &[f64; 3],
        _: &[f64; 3],
        _: &Inputs,
    ) -> impl ExactSizeIterator<Item = ::lagrangian::emitted::Assumption<'_>> {
        ::core::iter::empty()
    }

    fn constraints(&self) -> impl ExactSizeIterator<Item = ::lagrangian::emitted::Constraint<'_>> {
        CONSTRAINTS.iter().map(constraint)
    }

    fn multipliers(
        &self,
        _: f64,
        q: &[f64; 3],
        v: &[f64; 3],
        _: &Inputs,
        to: &mut [f64],
    ) -> Result<(), ::lagrangian::emitted::Singular> {
        fill(to, &multipliers(self, q, v)?);
        Ok(())
    }

    fn with_workspace<R>(&self, length: usize, work: impl FnOnce(Option<&mut [f64]>) -> R) -> R {
        let mut room = [0.0; ::lagrangian::emitted::constraint_workspace(3, 1)];
        work(room.get_mut(..length))
    }
}

impl<const N: usize> ::lagrangian::emitted::Batched<N> for Prepared
where
    ::lagrangian::emitted::Lanes<N>: ::lagrangian::emitted::Number,
{
    type Batch = Prepared<::lagrangian::emitted::Lanes<N>>;
    type Vectors = [::lagrangian::emitted::Lanes<N>; 3];
    type BatchInputs = Inputs;

    fn batch(systems: [&Self; N]) -> Self::Batch {
        let lanes = |number: fn(&Self) -> f64| ::lagrangian::emitted::Lanes(systems.map(number));
        Prepared {
            m: lanes(|p| p.m),
            J: lanes(|p| p.J),
            a: lanes(|p| p.a),
            k0: lanes(|p| p.k0),
            k1: lanes(|p| p.k1),
            k2: lanes(|p| p.k2),
            k3: lanes(|p| p.k3),
            k4: lanes(|p| p.k4),
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

/// A constraint, as it is called.
fn constraint<'a>(
    &(name, unit, multiplier_unit, holonomic): &'a (&'a str, &'a str, &'a str, bool),
) -> ::lagrangian::emitted::Constraint<'a> {
    ::lagrangian::emitted::Constraint {
        name,
        unit,
        multiplier_unit,
        holonomic,
    }
}

/// Writes numbers where there is room for them.
fn fill(to: &mut [f64], from: &[f64]) {
    for (to, from) in to.iter_mut().zip(from) {
        *to = *from;
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
    if let Some(constraint) = coordinate.checked_sub(3) {
        return ::lagrangian::emitted::Singular::constraint(constraint, pivot, diagonal);
    }
    ::lagrangian::emitted::Singular::new(coordinate, pivot, diagonal)
}
