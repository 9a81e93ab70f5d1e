// @generated from machines/heavy_top.machine by `cargo xtask generate`; edits are lost.

//! A symmetrical top on a fixed point, heavy: precession psi about the vertical, nutation theta
//! from
//! it, and spin phi about the top's own axis. Energy and two angular momenta are conserved: about
//! the
//! vertical and about the top's axis, since psi and phi are cyclic.
//!
//! 3 coordinates, 5 parameters, 2 outputs. Arithmetic of one call:
//!
//! | function | mul | add | div | sin cos | other | temporaries |
//! | --- | --: | --: | --: | --: | --: | --: |
//! | `prepare` | 4 | 5 | 1 | 0 | 0 | 10 |
//! | `start` | 1 | 0 | 0 | 0 | 0 | 1 |
//! | `mass_matrix` | 3 | 1 | 0 | 1 | 0 | 5 |
//! | `bias` | 10 | 2 | 0 | 1 | 0 | 14 |
//! | `applied` | 1 | 0 | 0 | 1 | 0 | 2 |
//! | `forces` | 13 | 3 | 0 | 1 | 0 | 18 |
//! | `accelerations` | 34 | 13 | 1 | 2 | 0 | 52 |
//! | `kinetic_energy` | 9 | 4 | 0 | 1 | 0 | 15 |
//! | `potential_energy` | 1 | 0 | 0 | 1 | 0 | 2 |
//! | `output_vertical_momentum` | 6 | 2 | 0 | 1 | 0 | 10 |
//! | `output_axial_momentum` | 2 | 1 | 0 | 1 | 0 | 4 |
//! | `assumption_0` | 0 | 0 | 0 | 1 | 0 | 1 |
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

/// A symmetrical top on a fixed point, heavy: precession psi about the vertical, nutation theta
/// from
/// it, and spin phi about the top's own axis. Energy and two angular momenta are conserved: about
/// the
/// vertical and about the top's axis, since psi and phi are cyclic.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HeavyTop<S = f64> {
    /// `m`. Unit: `kg`. Default: 15.
    pub m: S,
    /// Distance of the mass centre from the fixed point. Unit: `m`. Default: 1.
    pub l: S,
    /// Inertia about the mass centre: across the axis of the top, and about it. Unit: `kg*m^2`.
    /// Default: 0.234375.
    pub A: S,
    /// `C`. Unit: `kg*m^2`. Default: 0.46875.
    pub C: S,
    /// `g`. Unit: `m/s^2`. Default: 9.81.
    pub g: S,
}

impl Default for HeavyTop {
    fn default() -> Self {
        Self {
            m: 15.0,
            l: 1.0,
            A: 0.234375,
            C: 0.46875,
            g: 9.81,
        }
    }
}

impl<S> HeavyTop<S> {
    /// These values as other numbers.
    pub fn map<R>(self, f: impl Fn(S) -> R) -> HeavyTop<R> {
        HeavyTop {
            m: f(self.m),
            l: f(self.l),
            A: f(self.A),
            C: f(self.C),
            g: f(self.g),
        }
    }
}

impl<S: ::lagrangian::emitted::Scalar> HeavyTop<S> {
    /// Computes what depends on the parameters alone, once.
    pub fn prepare(&self) -> Prepared<S> {
        let t0 = self.l * self.m;
        let k0 = self.l * t0;
        let k1 = self.A + k0;
        let k7 = S::ONE / k1;
        let k4 = k1 - self.C;
        let k2 = t0 * self.g;
        let k3 = self.C - k1;
        let k5 = k4 * S::from_f64(2.0);
        let k6 = -self.C;
        let k8 = -k7;
        let singular = if vanishes(self.C, self.C, 2.6645352591003757e-15) {
            Some(singular(2, self.C, self.C))
        } else if vanishes(k1, k1, 2.6645352591003757e-15) {
            Some(singular(1, k1, k1))
        } else {
            None
        };
        Prepared {
            A: self.A,
            C: self.C,
            k0,
            k1,
            k2,
            k3,
            k4,
            k5,
            k6,
            k7,
            k8,
            singular,
        }
    }

    /// The start values of the description, at `t = 0`.
    pub fn start(&self) -> ::lagrangian::emitted::State<Coordinates<S>> {
        let psi = S::pi();
        let theta = S::pi() * S::from_f64(0.5);
        let zero = S::ZERO;
        let q = [psi, theta, zero];
        let v = [zero, zero, S::from_f64(150.0)];
        ::lagrangian::emitted::State {
            t: 0.0,
            q: Coordinates::from_array(q),
            v: Coordinates::from_array(v),
        }
    }
}

/// The coordinates of [`HeavyTop`], or their rates, by name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coordinates<S = f64> {
    /// `psi`. Unit: `rad`.
    pub psi: S,
    /// `theta`. Unit: `rad`.
    pub theta: S,
    /// The spin with which it is let go: fast enough to carry it, at m g l/(C spin) = 2 rad/s.
    /// Unit: `rad`.
    pub phi: S,
}

impl<S: Copy> Coordinates<S> {
    /// The numbers in the order of the description: the order of `q` in every function here.
    pub fn to_array(self) -> [S; 3] {
        [self.psi, self.theta, self.phi]
    }

    /// Names for numbers in the order of the description.
    pub fn from_array(q: [S; 3]) -> Self {
        Self {
            psi: q[0],
            theta: q[1],
            phi: q[2],
        }
    }

    /// These values as other numbers.
    pub fn map<R>(self, f: impl Fn(S) -> R) -> Coordinates<R> {
        Coordinates {
            psi: f(self.psi),
            theta: f(self.theta),
            phi: f(self.phi),
        }
    }
}

/// What can be set while a [`HeavyTop`] runs.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Inputs {}

/// What can be observed of a [`HeavyTop`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outputs<S = f64> {
    /// Angular momentum about the vertical: conserved. Unit: `J*s`.
    pub vertical_momentum: S,
    /// Angular momentum about the top's axis: conserved. Unit: `J*s`.
    pub axial_momentum: S,
}

/// The parameters of a [`HeavyTop`], with the work done that depends on them alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prepared<S = f64> {
    /// `A`
    A: S,
    /// `C`
    C: S,
    /// `m*l^2`
    k0: S,
    /// `A + m*l^2`
    k1: S,
    /// `m*l*g`
    k2: S,
    /// `C - (A + m*l^2)`
    k3: S,
    /// `A - C + m*l^2`
    k4: S,
    /// `2*(A - C + m*l^2)`
    k5: S,
    /// `-C`
    k6: S,
    /// `1/(A + m*l^2)`
    k7: S,
    /// `-1/(A + m*l^2)`
    k8: S,
    /// Why these parameters leave the machine without accelerations, if they do.
    singular: Option<::lagrangian::emitted::Singular>,
}

/// Mass matrix `M`.
///
/// ```text
/// M[psi, psi] = C*cos(theta)^2 + (m*l^2 + A)*sin(theta)^2
/// M[theta, theta] = m*l^2 + A
/// M[phi, psi] = C*cos(theta)
/// M[phi, phi] = C
/// ```
pub fn mass_matrix<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 3]) -> [[S; 3]; 3] {
    let theta = q[1];
    let cos_theta = theta.cos();
    let m11 = p.k1 - cos_theta * (cos_theta * p.k4);
    let zero = S::ZERO;
    let m31 = cos_theta * p.C;
    [[m11, zero, m31], [zero, p.k1, zero], [m31, zero, p.C]]
}

/// Bias `h`: velocity products and explicit time in the inertia forces.
///
/// ```text
/// h[psi] = -2*(C - m*l^2 - A)*cos(theta)*sin(theta)*der(psi)*der(theta)
///     - C*sin(theta)*der(theta)*der(phi)
/// h[theta] = C*sin(theta)*der(psi)*der(phi) - (m*l^2 + A - C)*cos(theta)*sin(theta)*der(psi)^2
/// h[phi] = -C*sin(theta)*der(psi)*der(theta)
/// ```
pub fn bias<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 3], v: &[S; 3]) -> [S; 3] {
    let theta = q[1];
    let psi_dot = v[0];
    let theta_dot = v[1];
    let phi_dot = v[2];
    let (sin_theta, cos_theta) = theta.sin_cos();
    let t0 = phi_dot * p.C;
    let t1 = cos_theta * psi_dot;
    let t2 = sin_theta * psi_dot;
    let h_psi = (t1 * p.k5 - t0) * (sin_theta * theta_dot);
    let h_theta = t2 * (t0 - t1 * p.k4);
    let h_phi = t2 * (theta_dot * p.k6);
    [h_psi, h_theta, h_phi]
}

/// Applied generalized forces `Q`.
///
/// ```text
/// Q[theta] = m*l*g*sin(theta)
/// ```
pub fn applied<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 3]) -> [S; 3] {
    let theta = q[1];
    let sin_theta = theta.sin();
    let zero = S::ZERO;
    let q_theta = p.k2 * sin_theta;
    [zero, q_theta, zero]
}

/// Right-hand side `f = Q - h` of `M a = f`.
pub fn forces<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 3], v: &[S; 3]) -> [S; 3] {
    let theta = q[1];
    let psi_dot = v[0];
    let theta_dot = v[1];
    let phi_dot = v[2];
    let (sin_theta, cos_theta) = theta.sin_cos();
    let t0 = theta_dot * p.C;
    let t1 = sin_theta * psi_dot;
    let t2 = cos_theta * t1;
    let f_psi = sin_theta * (t0 * phi_dot) - t2 * (theta_dot * p.k5);
    let f_theta = t2 * (psi_dot * p.k4) + (sin_theta * p.k2 - t1 * (p.C * phi_dot));
    let f_phi = t0 * t1;
    [f_psi, f_theta, f_phi]
}

/// Accelerations `a`, the solution of `M a = f` eliminated along the machine.
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
        let theta = n(q[1]);
        let phi = n(q[2]);
        let psi_dot = n(v[0]);
        let theta_dot = n(v[1]);
        let phi_dot = n(v[2]);
        let angles = [theta, phi];
        let circular = N::sin_cos_all(angles);
        let (sin_theta, cos_theta) = circular[0];
        let (sin_phi, cos_phi) = circular[1];
        let t0 = psi_dot * theta_dot;
        let t1 = sin_theta * psi_dot;
        let t2 = cos_theta * t0;
        let t3 = sin_theta * n(p.k2);
        let t4 = n(p.k3) * cos_theta.mul_add(psi_dot, phi_dot);
        let t5 = sin_phi.mul_add(t1, cos_phi * theta_dot);
        let t6 = cos_phi.mul_sub(t1, sin_phi * theta_dot);
        let t7 = sin_theta * (sin_theta * n(p.k1));
        let t8 = phi_dot.neg_mul_add(t5, cos_phi * t2);
        let t9 = phi_dot.mul_add(t6, sin_phi * t2);
        let t10 = t3.mul_add(sin_phi, n(p.k1).mul_sub(t8, t4 * t5));
        let t11 = t3.neg_mul_add(cos_phi, n(p.k1).mul_add(t9, t4 * t6));
        let t12 = N::ONE / sin_theta * sin_phi.mul_add(t11, cos_phi * t10);
        let psi_ddot = t12 * n(p.k8);
        let theta_ddot = n(p.k7) * sin_phi.mul_sub(t10, cos_phi * t11);
        let phi_ddot = t12.mul_add(cos_theta * n(p.k7), sin_theta * t0);
        let t13 = cos_theta.mul_add(cos_theta * n(p.C), t7);
        let sound = t7.exceeds(N::from_f64(2.6645352591003757e-15) * t13) & phi_ddot.is_finite();
        if !sound {
            check(t7, t13, 2.6645352591003757e-15, 0)?;
        }
        let accelerations = [psi_ddot.store(), theta_ddot.store(), phi_ddot.store()];
        Ok(accelerations)
    }
}

/// Kinetic energy `T`, in J.
///
/// ```text
/// T = 1/2*(m*l^2 + A)*sin(theta)^2*der(psi)^2 + 1/2*(m*l^2 + A)*der(theta)^2
///     + 1/2*C*(cos(theta)*der(psi) + der(phi))^2
/// ```
pub fn kinetic_energy<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 3],
    v: &[S; 3],
) -> S {
    let theta = q[1];
    let psi_dot = v[0];
    let theta_dot = v[1];
    let phi_dot = v[2];
    let (sin_theta, cos_theta) = theta.sin_cos();
    let t0 = cos_theta * psi_dot + phi_dot;
    let t1 = sin_theta * psi_dot;
    let t2 = t1 * t1 + theta_dot * theta_dot;
    S::from_f64(0.5) * (t2 * p.k0 + (t2 * p.A + t0 * (t0 * p.C)))
}

/// Potential energy `V`, in J.
///
/// ```text
/// V = m*l*g*cos(theta)
/// ```
pub fn potential_energy<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 3]) -> S {
    let theta = q[1];
    let cos_theta = theta.cos();
    p.k2 * cos_theta
}

/// Angular momentum about the vertical: conserved. Unit: `J*s`.
///
/// ```text
/// vertical_momentum = C*cos(theta)^2*der(psi) + (m*l^2 + A)*sin(theta)^2*der(psi)
///     + C*cos(theta)*der(phi)
/// ```
pub fn output_vertical_momentum<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 3],
    v: &[S; 3],
) -> S {
    let theta = q[1];
    let psi_dot = v[0];
    let phi_dot = v[2];
    let (sin_theta, cos_theta) = theta.sin_cos();
    let t0 = cos_theta * p.C;
    let t1 = (cos_theta * t0 + sin_theta * (sin_theta * p.k1)) * psi_dot;
    t0 * phi_dot + t1
}

/// Angular momentum about the top's axis: conserved. Unit: `J*s`.
///
/// ```text
/// axial_momentum = C*(cos(theta)*der(psi) + der(phi))
/// ```
pub fn output_axial_momentum<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 3],
    v: &[S; 3],
) -> S {
    let theta = q[1];
    let psi_dot = v[0];
    let phi_dot = v[2];
    let cos_theta = theta.cos();
    (cos_theta * psi_dot + phi_dot) * p.C
}

/// By how much `sin(theta) > 0` holds.
pub fn assumption_0<S: ::lagrangian::emitted::Scalar>(q: &[S; 3]) -> S {
    let theta = q[1];
    let sin_theta = theta.sin();
    sin_theta
}

/// Everything that the description asks to observe.
pub fn outputs<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 3],
    v: &[S; 3],
) -> Outputs<S> {
    Outputs {
        vertical_momentum: output_vertical_momentum(p, q, v),
        axial_momentum: output_axial_momentum(p, q, v),
    }
}

/// Names and units.
const PARAMETERS: [(&str, &str); 5] = [
    ("m", "kg"),
    ("l", "m"),
    ("A", "kg*m^2"),
    ("C", "kg*m^2"),
    ("g", "m/s^2"),
];

/// Names and units.
const COORDINATES: [(&str, &str); 3] = [("psi", "rad"), ("theta", "rad"), ("phi", "rad")];

/// Names and units.
const INPUTS: [(&str, &str); 0] = [];

/// Names and units.
const OUTPUTS: [(&str, &str); 2] = [("vertical_momentum", "J*s"), ("axial_momentum", "J*s")];

impl ::lagrangian::emitted::Machine for HeavyTop {
    type System = Prepared;

    fn name(&self) -> &str {
        "HeavyTop"
    }

    fn parameters(
        &self,
    ) -> impl ExactSizeIterator<Item = (::lagrangian::emitted::Quantity<'_>, f64)> {
        let values = [self.m, self.l, self.A, self.C, self.g];
        quantities(&PARAMETERS, values)
    }

    fn parameter_mut(&mut self, index: usize) -> Option<&mut f64> {
        match index {
            0 => Some(&mut self.m),
            1 => Some(&mut self.l),
            2 => Some(&mut self.A),
            3 => Some(&mut self.C),
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
    type Vector = [f64; 3];
    type Matrix = [f64; 9];
    type Coordinates = Coordinates;
    type Inputs = Inputs;
    type Outputs = Outputs;
    const MAY_BE_CONSTRAINED: bool = false;
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

    fn applied(&self, _: f64, q: &[f64; 3], _: &[f64; 3], _: &Inputs, result: &mut [f64; 3]) {
        *result = applied(self, q);
    }

    fn forces(&self, _: f64, q: &[f64; 3], v: &[f64; 3], _: &Inputs, result: &mut [f64; 3]) {
        *result = forces(self, q, v);
    }

    fn kinetic_energy(&self, _: f64, q: &[f64; 3], v: &[f64; 3]) -> f64 {
        kinetic_energy(self, q, v)
    }

    fn potential_energy(&self, _: f64, q: &[f64; 3], _: &Inputs) -> f64 {
        potential_energy(self, q)
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
        let values = [outputs.vertical_momentum, outputs.axial_momentum];
        quantities(&OUTPUTS, values)
    }

    fn outputs(&self, _: f64, q: &[f64; 3], v: &[f64; 3], _: &[f64; 3], _: &Inputs) -> Outputs {
        outputs(self, q, v)
    }

    fn assumptions(
        &self,
        _: f64,
        q: &[f64; 3],
        _: &[f64; 3],
        _: &Inputs,
    ) -> impl ExactSizeIterator<Item = ::lagrangian::emitted::Assumption<'_>> {
        let facts = [assumption("sin(theta) > 0", true, assumption_0(q))];
        facts.into_iter()
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
            A: lanes(|p| p.A),
            C: lanes(|p| p.C),
            k0: lanes(|p| p.k0),
            k1: lanes(|p| p.k1),
            k2: lanes(|p| p.k2),
            k3: lanes(|p| p.k3),
            k4: lanes(|p| p.k4),
            k5: lanes(|p| p.k5),
            k6: lanes(|p| p.k6),
            k7: lanes(|p| p.k7),
            k8: lanes(|p| p.k8),
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

impl<S: ::lagrangian::emitted::Real> ::lagrangian::emitted::MachineIn<S> for HeavyTop<S> {
    type System = Prepared<S>;

    fn prepare(&self) -> Prepared<S> {
        Self::prepare(self)
    }

    fn start(&self) -> ::lagrangian::emitted::State<Coordinates<S>> {
        Self::start(self)
    }
}

impl<S: ::lagrangian::emitted::Real> ::lagrangian::emitted::SystemIn<S> for Prepared<S> {
    type Vector = [S; 3];
    type Coordinates = Coordinates<S>;
    type Inputs = Inputs;

    fn coordinates(&self) -> impl ExactSizeIterator<Item = ::lagrangian::emitted::Quantity<'_>> {
        COORDINATES.iter().map(quantity)
    }

    fn to_coordinates(&self, vector: &[S; 3]) -> Coordinates<S> {
        Coordinates::from_array(*vector)
    }

    fn to_vector(&self, coordinates: &Coordinates<S>) -> [S; 3] {
        coordinates.to_array()
    }

    fn default_inputs(&self) -> Inputs {
        Inputs {}
    }

    fn accelerations(
        &self,
        _: S,
        q: &[S; 3],
        v: &[S; 3],
        _: &Inputs,
        result: &mut [S; 3],
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
