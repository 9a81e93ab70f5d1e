// @generated from machines/two_body_orbit.machine by `cargo xtask generate`; edits are lost.

//! Two bodies that attract each other as Newton says, seen from their common mass centre: r and
//! phi are the distance and the direction of the second from the first.
//!
//! Nothing here says "reduced mass"; it is what the derivation finds, for both bodies move with
//! the one line between them: mu = m1 m2/(m1 + m2). Each body runs in a conic with a focus in
//! the mass centre. Conserved: energy E, angular momentum mu r^2 der(phi), and the eccentricity
//! vector (P. S. Laplace, C. Runge, W. Lenz), which points from the focus to the pericentre and
//! is as long as the eccentricity e is great. Where E < 0, with the semi-major axis
//! a = G m1 m2/(-2 E), the period is 2 pi sqrt(a^3/(G (m1 + m2))), and Kepler's equation
//! u - e sin(u) = n t gives the place, r = a (1 - e cos(u)). A circle of radius r is run
//! through at der(phi)^2 = G (m1 + m2)/r^3. From rest the bodies would fall together.
//!
//! 2 coordinates, 3 parameters, 3 outputs. Arithmetic of one call:
//!
//! | function | mul | add | div | sin cos | other | temporaries |
//! | --- | --: | --: | --: | --: | --: | --: |
//! | `prepare` | 10 | 7 | 2 | 0 | 0 | 19 |
//! | `mass_matrix` | 2 | 0 | 0 | 0 | 0 | 2 |
//! | `bias` | 5 | 0 | 0 | 0 | 0 | 5 |
//! | `applied` | 1 | 0 | 1 | 0 | 0 | 2 |
//! | `forces` | 6 | 1 | 1 | 0 | 0 | 8 |
//! | `accelerations` | 11 | 1 | 1 | 0 | 0 | 13 |
//! | `kinetic_energy` | 4 | 1 | 0 | 0 | 0 | 5 |
//! | `potential_energy` | 0 | 0 | 1 | 0 | 0 | 1 |
//! | `output_momentum` | 3 | 0 | 0 | 0 | 0 | 3 |
//! | `output_eccentricity_x` | 7 | 2 | 0 | 1 | 0 | 11 |
//! | `output_eccentricity_y` | 7 | 3 | 0 | 1 | 0 | 12 |
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

/// Two bodies that attract each other as Newton says, seen from their common mass centre: r and
/// phi are the distance and the direction of the second from the first.
///
/// Nothing here says "reduced mass"; it is what the derivation finds, for both bodies move with
/// the one line between them: mu = m1 m2/(m1 + m2). Each body runs in a conic with a focus in
/// the mass centre. Conserved: energy E, angular momentum mu r^2 der(phi), and the eccentricity
/// vector (P. S. Laplace, C. Runge, W. Lenz), which points from the focus to the pericentre and
/// is as long as the eccentricity e is great. Where E < 0, with the semi-major axis
/// a = G m1 m2/(-2 E), the period is 2 pi sqrt(a^3/(G (m1 + m2))), and Kepler's equation
/// u - e sin(u) = n t gives the place, r = a (1 - e cos(u)). A circle of radius r is run
/// through at der(phi)^2 = G (m1 + m2)/r^3. From rest the bodies would fall together.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TwoBodyOrbit<S = f64> {
    /// Mass of the first body, and of the second. Unit: `kg`. Default: 3.
    pub m1: S,
    /// `m2`. Unit: `kg`. Default: 1.
    pub m2: S,
    /// Constant of gravitation, 6.674e-11 in SI units. Lengths, masses and times are chosen
    /// here to make it 1. Unit: `N*m^2/kg^2`. Default: 1.
    pub G: S,
}

impl Default for TwoBodyOrbit {
    fn default() -> Self {
        Self {
            m1: 3.0,
            m2: 1.0,
            G: 1.0,
        }
    }
}

impl<S> TwoBodyOrbit<S> {
    /// These values as other numbers.
    pub fn map<R>(self, f: impl Fn(S) -> R) -> TwoBodyOrbit<R> {
        TwoBodyOrbit {
            m1: f(self.m1),
            m2: f(self.m2),
            G: f(self.G),
        }
    }
}

impl<S: ::lagrangian::emitted::Scalar> TwoBodyOrbit<S> {
    /// Computes what depends on the parameters alone, once.
    pub fn prepare(&self) -> Prepared<S> {
        let t0 = self.m2 + self.m1;
        let k9 = S::ONE / t0;
        let k1 = self.G * (self.m2 * self.m1);
        let t1 = self.m1 * k9;
        let k2 = self.m2 * t1;
        let t2 = t1 * k2;
        let k5 = k2 * S::from_f64(2.0);
        let t3 = k9 * (self.m2 * k2);
        let k3 = t3 + t2;
        let k0 = k9 / self.G;
        let k4 = t2 * S::from_f64(0.5) + t3 * S::from_f64(0.5);
        let k6 = -k2;
        let k7 = -k1;
        let k8 = -k5;
        let k10 = -t0;
        let singular = if vanishes(k2, k3, 1.7763568394002505e-15) {
            Some(singular(0, k2, k3))
        } else {
            None
        };
        Prepared {
            G: self.G,
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

    /// The start values of the description, at `t = 0`.
    pub fn start(&self) -> ::lagrangian::emitted::State<Coordinates<S>> {
        let r = S::from_ratio(2, 5);
        let zero = S::ZERO;
        let q = [r, zero];
        let v = [zero, S::from_f64(10.0)];
        ::lagrangian::emitted::State {
            t: 0.0,
            q: Coordinates::from_array(q),
            v: Coordinates::from_array(v),
        }
    }
}

/// The coordinates of [`TwoBodyOrbit`], or their rates, by name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coordinates<S = f64> {
    /// Distance of the bodies. Unit: `m`.
    pub r: S,
    /// Direction of the second body, seen from the first.
    /// They start at the pericentre of an ellipse of e = 0.6. Unit: `rad`.
    pub phi: S,
}

impl<S: Copy> Coordinates<S> {
    /// The numbers in the order of the description: the order of `q` in every function here.
    pub fn to_array(self) -> [S; 2] {
        [self.r, self.phi]
    }

    /// Names for numbers in the order of the description.
    pub fn from_array(q: [S; 2]) -> Self {
        Self { r: q[0], phi: q[1] }
    }

    /// These values as other numbers.
    pub fn map<R>(self, f: impl Fn(S) -> R) -> Coordinates<R> {
        Coordinates {
            r: f(self.r),
            phi: f(self.phi),
        }
    }
}

/// What can be set while a [`TwoBodyOrbit`] runs.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Inputs {}

/// What can be observed of a [`TwoBodyOrbit`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outputs<S = f64> {
    /// Angular momentum about the mass centre: conserved. Unit: `J*s`.
    pub momentum: S,
    /// The eccentricity vector in ground axes: conserved. Unit: `1`.
    pub eccentricity_x: S,
    /// `eccentricity_y`. Unit: `1`.
    pub eccentricity_y: S,
}

/// The parameters of a [`TwoBodyOrbit`], with the work done that depends on them alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prepared<S = f64> {
    /// `G`
    G: S,
    /// `1/G/(m1 + m2)`
    k0: S,
    /// `m1*m2*G`
    k1: S,
    /// `m1*m2/(m1 + m2)`
    k2: S,
    /// `m1^2*m2/(m1 + m2)^2 + m1*m2^2/(m1 + m2)^2`
    k3: S,
    /// `0.5*m1*m2^2/(m1 + m2)^2 + 0.5*m1^2*m2/(m1 + m2)^2`
    k4: S,
    /// `2*m1*m2/(m1 + m2)`
    k5: S,
    /// `-m1*m2/(m1 + m2)`
    k6: S,
    /// `-m1*m2*G`
    k7: S,
    /// `-2*m1*m2/(m1 + m2)`
    k8: S,
    /// `1/(m1 + m2)`
    k9: S,
    /// `-(m1 + m2)`
    k10: S,
    /// Why these parameters leave the machine without accelerations, if they do.
    singular: Option<::lagrangian::emitted::Singular>,
}

/// Mass matrix `M`.
///
/// ```text
/// M[r, r] = m1^2*m2/(m1 + m2)^2 + m1*m2^2/(m1 + m2)^2
/// M[phi, phi] = m1*m2*r^2/(m1 + m2)
/// ```
pub fn mass_matrix<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 2]) -> [[S; 2]; 2] {
    let r = q[0];
    let zero = S::ZERO;
    let m22 = r * (r * p.k2);
    [[p.k3, zero], [zero, m22]]
}

/// Bias `h`: velocity products and explicit time in the inertia forces.
///
/// ```text
/// h[r] = -m1*m2*r*der(phi)^2/(m1 + m2)
/// h[phi] = 2*m1*m2*r*der(r)*der(phi)/(m1 + m2)
/// ```
pub fn bias<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 2], v: &[S; 2]) -> [S; 2] {
    let r = q[0];
    let r_dot = v[0];
    let phi_dot = v[1];
    let t0 = phi_dot * r;
    let h_r = t0 * (phi_dot * p.k6);
    let h_phi = t0 * (p.k5 * r_dot);
    [h_r, h_phi]
}

/// Applied generalized forces `Q`.
///
/// ```text
/// Q[r] = -m1*m2*G/r^2
/// ```
pub fn applied<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 2]) -> [S; 2] {
    let r = q[0];
    let q_r = p.k7 / (r * r);
    let zero = S::ZERO;
    [q_r, zero]
}

/// Right-hand side `f = Q - h` of `M a = f`.
pub fn forces<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 2], v: &[S; 2]) -> [S; 2] {
    let r = q[0];
    let r_dot = v[0];
    let phi_dot = v[1];
    let t0 = phi_dot * r;
    let f_r = t0 * (phi_dot * p.k2) - p.k1 / (r * r);
    let f_phi = t0 * (p.k8 * r_dot);
    [f_r, f_phi]
}

/// Accelerations `a`, the solution of `M a = f` eliminated along the machine.
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
        let r_dot = n(v[0]);
        let phi_dot = n(v[1]);
        let t0 = N::ONE / r;
        let t1 = r * (r * n(p.k2));
        let t2 = t0.mul_sub(t0 * n(p.G), r * n(p.k9) * (phi_dot * phi_dot));
        let r_ddot = n(p.k10) * t2;
        let phi_ddot = t0 * (phi_dot * (N::from_f64(-2.0) * r_dot));
        let sound = t1.exceeds(N::from_f64(1.7763568394002505e-15) * t1) & r_ddot.is_finite();
        if !sound {
            check(t1, t1, 1.7763568394002505e-15, 1)?;
        }
        let accelerations = [r_ddot.store(), phi_ddot.store()];
        Ok(accelerations)
    }
}

/// Kinetic energy `T`, in J.
///
/// ```text
/// T = 1/2*m1*m2*der(r)^2/(m1 + m2) + 1/2*m1*m2*r^2*der(phi)^2/(m1 + m2)
/// ```
pub fn kinetic_energy<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 2],
    v: &[S; 2],
) -> S {
    let r = q[0];
    let r_dot = v[0];
    let phi_dot = v[1];
    let t0 = phi_dot * r;
    p.k4 * (t0 * t0 + r_dot * r_dot)
}

/// Potential energy `V`, in J.
///
/// ```text
/// V = -m1*m2*G/r
/// ```
pub fn potential_energy<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 2]) -> S {
    let r = q[0];
    p.k7 / r
}

/// Angular momentum about the mass centre: conserved. Unit: `J*s`.
///
/// ```text
/// momentum = m1*m2*r^2*der(phi)/(m1 + m2)
/// ```
pub fn output_momentum<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 2],
    v: &[S; 2],
) -> S {
    let r = q[0];
    let phi_dot = v[1];
    r * p.k2 * (r * phi_dot)
}

/// The eccentricity vector in ground axes: conserved. Unit: `1`.
///
/// ```text
/// eccentricity_x = r^2*sin(phi)*der(r)*der(phi)/((m1 + m2)*G)
///     + r^3*cos(phi)*der(phi)^2/((m1 + m2)*G) - cos(phi)
/// ```
pub fn output_eccentricity_x<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 2],
    v: &[S; 2],
) -> S {
    let r = q[0];
    let phi = q[1];
    let r_dot = v[0];
    let phi_dot = v[1];
    let (sin_phi, cos_phi) = phi.sin_cos();
    let t0 = r * phi_dot;
    let t1 = p.k0 * r * t0;
    sin_phi * (t1 * r_dot) - cos_phi * (S::ONE - t0 * t1)
}

/// `eccentricity_y`. Unit: `1`.
///
/// ```text
/// eccentricity_y = r^3*sin(phi)*der(phi)^2/((m1 + m2)*G)
///     - r^2*cos(phi)*der(r)*der(phi)/((m1 + m2)*G) - sin(phi)
/// ```
pub fn output_eccentricity_y<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 2],
    v: &[S; 2],
) -> S {
    let r = q[0];
    let phi = q[1];
    let r_dot = v[0];
    let phi_dot = v[1];
    let (sin_phi, cos_phi) = phi.sin_cos();
    let t0 = r * phi_dot;
    let t1 = p.k0 * r * t0;
    -(cos_phi * (t1 * r_dot) + sin_phi * (S::ONE - t0 * t1))
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
        eccentricity_x: output_eccentricity_x(p, q, v),
        eccentricity_y: output_eccentricity_y(p, q, v),
    }
}

/// Names and units.
const PARAMETERS: [(&str, &str); 3] = [("m1", "kg"), ("m2", "kg"), ("G", "N*m^2/kg^2")];

/// Names and units.
const COORDINATES: [(&str, &str); 2] = [("r", "m"), ("phi", "rad")];

/// Names and units.
const INPUTS: [(&str, &str); 0] = [];

/// Names and units.
const OUTPUTS: [(&str, &str); 3] = [
    ("momentum", "J*s"),
    ("eccentricity_x", "1"),
    ("eccentricity_y", "1"),
];

impl ::lagrangian::emitted::Machine for TwoBodyOrbit {
    type System = Prepared;

    fn name(&self) -> &str {
        "TwoBodyOrbit"
    }

    fn parameters(
        &self,
    ) -> impl ExactSizeIterator<Item = (::lagrangian::emitted::Quantity<'_>, f64)> {
        let values = [self.m1, self.m2, self.G];
        quantities(&PARAMETERS, values)
    }

    fn parameter_mut(&mut self, index: usize) -> Option<&mut f64> {
        match index {
            0 => Some(&mut self.m1),
            1 => Some(&mut self.m2),
            2 => Some(&mut self.G),
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
        let values = [
            outputs.momentum,
            outputs.eccentricity_x,
            outputs.eccentricity_y,
        ];
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
            G: lanes(|p| p.G),
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

impl<S: ::lagrangian::emitted::Real> ::lagrangian::emitted::MachineIn<S> for TwoBodyOrbit<S> {
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
