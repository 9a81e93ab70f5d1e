// @generated from machines/rolling_cylinder.machine by `cargo xtask generate`; edits are lost.

//! A cylinder that rolls inside a fixed one, in polar coordinates about its axis: a pendulum, as
//! long
//! as it presses.
//!
//! 3 coordinates, 5 parameters. Arithmetic of one call:
//!
//! | function | mul | add | div | sin cos | other | temporaries |
//! | --- | --: | --: | --: | --: | --: | --: |
//! | `prepare` | 11 | 6 | 5 | 0 | 0 | 22 |
//! | `start` | 0 | 1 | 0 | 0 | 0 | 1 |
//! | `mass_matrix` | 2 | 0 | 0 | 0 | 0 | 2 |
//! | `bias` | 5 | 0 | 0 | 0 | 0 | 5 |
//! | `applied` | 3 | 0 | 0 | 1 | 0 | 5 |
//! | `forces` | 8 | 3 | 0 | 1 | 0 | 13 |
//! | `constraint_positions` | 0 | 1 | 0 | 0 | 0 | 1 |
//! | `constraint_rates` | 2 | 2 | 0 | 0 | 0 | 4 |
//! | `constraint_drift` | 1 | 1 | 0 | 0 | 0 | 2 |
//! | `accelerations` | 2 | 0 | 0 | 1 | 0 | 3 |
//! | `multipliers` | 17 | 8 | 2 | 1 | 0 | 29 |
//! | `kinetic_energy` | 11 | 4 | 0 | 1 | 0 | 17 |
//! | `potential_energy` | 2 | 0 | 0 | 1 | 0 | 3 |
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

/// A cylinder that rolls inside a fixed one, in polar coordinates about its axis: a pendulum, as
/// long
/// as it presses.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RollingCylinder<S = f64> {
    /// `m`. Unit: `kg`. Default: 180.
    pub m: S,
    /// `J`. Unit: `kg*m^2`. Default: 9.225.
    pub J: S,
    /// Radii of the fixed cylinder and of the one that rolls. Unit: `m`. Default: 0.27.
    pub R: S,
    /// `r`. Unit: `m`. Default: 0.25.
    pub r: S,
    /// `g`. Unit: `m/s^2`. Default: 9.81.
    pub g: S,
}

impl Default for RollingCylinder {
    fn default() -> Self {
        Self {
            m: 180.0,
            J: 9.225,
            R: 0.27,
            r: 0.25,
            g: 9.81,
        }
    }
}

impl<S> RollingCylinder<S> {
    /// These values as other numbers.
    pub fn map<R>(self, f: impl Fn(S) -> R) -> RollingCylinder<R> {
        RollingCylinder {
            m: f(self.m),
            J: f(self.J),
            R: f(self.R),
            r: f(self.r),
            g: f(self.g),
        }
    }
}

impl<S: ::lagrangian::emitted::Scalar> RollingCylinder<S> {
    /// Computes what depends on the parameters alone, once.
    pub fn prepare(&self) -> Prepared<S> {
        let t0 = S::ONE / self.r;
        let k0 = self.m * self.g;
        let k1 = self.R - self.r;
        let pivot_4 = self.r * self.r;
        let t1 = k1 * k1;
        let t2 = t0 * (self.J * t0);
        let t3 = self.m + t2;
        let t4 = k0 * (S::ONE / t3);
        let k2 = self.m * S::from_f64(2.0);
        let k3 = -self.m;
        let k4 = -k0;
        let k5 = S::ONE / self.m;
        let k6 = pivot_4 / self.J;
        let k7 = t0 * t4;
        let k8 = -(t4 / k1);
        let pivot_1 = t3 * t1;
        let scale_1 = self.m * t1 + t2 * t1;
        let one = S::ONE;
        let singular = if vanishes(pivot_1, scale_1, 4.440892098500626e-15) {
            Some(singular(1, pivot_1, scale_1))
        } else if vanishes(one, one, 4.440892098500626e-15) {
            Some(singular(3, one, one))
        } else if vanishes(pivot_4, pivot_4, 4.440892098500626e-15) {
            Some(singular(4, pivot_4, pivot_4))
        } else {
            None
        };
        Prepared {
            m: self.m,
            J: self.J,
            r: self.r,
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
            singular,
        }
    }

    /// The start values of the description, at rest and `t = 0`.
    pub fn start(&self) -> ::lagrangian::emitted::State<Coordinates<S>> {
        let s = self.R - self.r;
        let one = S::ONE;
        let zero = S::ZERO;
        let q = [s, one, zero];
        let v = [S::ZERO; 3];
        ::lagrangian::emitted::State {
            t: 0.0,
            q: Coordinates::from_array(q),
            v: Coordinates::from_array(v),
        }
    }
}

/// The coordinates of [`RollingCylinder`], or their rates, by name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coordinates<S = f64> {
    /// Distance of the axes, and its direction from the one that points down. Unit: `m`.
    pub s: S,
    /// `phi`. Unit: `rad`.
    pub phi: S,
    /// Angle of the cylinder. Unit: `rad`.
    pub theta: S,
}

impl<S: Copy> Coordinates<S> {
    /// The numbers in the order of the description: the order of `q` in every function here.
    pub fn to_array(self) -> [S; 3] {
        [self.s, self.phi, self.theta]
    }

    /// Names for numbers in the order of the description.
    pub fn from_array(q: [S; 3]) -> Self {
        Self {
            s: q[0],
            phi: q[1],
            theta: q[2],
        }
    }

    /// These values as other numbers.
    pub fn map<R>(self, f: impl Fn(S) -> R) -> Coordinates<R> {
        Coordinates {
            s: f(self.s),
            phi: f(self.phi),
            theta: f(self.theta),
        }
    }
}

/// What can be set while a [`RollingCylinder`] runs.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Inputs {}

/// What can be observed of a [`RollingCylinder`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Outputs {}

/// The parameters of a [`RollingCylinder`], with the work done that depends on them alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prepared<S = f64> {
    /// `m`
    m: S,
    /// `J`
    J: S,
    /// `r`
    r: S,
    /// `g`
    g: S,
    /// `m*g`
    k0: S,
    /// `R - r`
    k1: S,
    /// `2*m`
    k2: S,
    /// `-m`
    k3: S,
    /// `-m*g`
    k4: S,
    /// `1/m`
    k5: S,
    /// `r^2/J`
    k6: S,
    /// `m*g/r/(m + J/r^2)`
    k7: S,
    /// `-m*g/(R - r)/(m + J/r^2)`
    k8: S,
    /// Why these parameters leave the machine without accelerations, if they do.
    singular: Option<::lagrangian::emitted::Singular>,
}

/// Mass matrix `M`.
///
/// ```text
/// M[s, s] = m
/// M[phi, phi] = m*s^2
/// M[theta, theta] = J
/// ```
pub fn mass_matrix<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 3]) -> [[S; 3]; 3] {
    let s = q[0];
    let zero = S::ZERO;
    let m22 = s * (p.m * s);
    [[p.m, zero, zero], [zero, m22, zero], [zero, zero, p.J]]
}

/// Bias `h`: velocity products and explicit time in the inertia forces.
///
/// ```text
/// h[s] = -m*s*der(phi)^2
/// h[phi] = 2*m*s*der(s)*der(phi)
/// ```
pub fn bias<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 3], v: &[S; 3]) -> [S; 3] {
    let s = q[0];
    let s_dot = v[0];
    let phi_dot = v[1];
    let t0 = phi_dot * s;
    let h_s = t0 * (phi_dot * p.k3);
    let h_phi = t0 * (p.k2 * s_dot);
    let zero = S::ZERO;
    [h_s, h_phi, zero]
}

/// Applied generalized forces `Q`.
///
/// ```text
/// Q[s] = m*g*cos(phi)
/// Q[phi] = -m*g*s*sin(phi)
/// ```
pub fn applied<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 3]) -> [S; 3] {
    let s = q[0];
    let phi = q[1];
    let (sin_phi, cos_phi) = phi.sin_cos();
    let q_s = p.k0 * cos_phi;
    let q_phi = sin_phi * (p.k4 * s);
    let zero = S::ZERO;
    [q_s, q_phi, zero]
}

/// Right-hand side `f = Q - h` of `M a = f`.
pub fn forces<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 3], v: &[S; 3]) -> [S; 3] {
    let s = q[0];
    let phi = q[1];
    let s_dot = v[0];
    let phi_dot = v[1];
    let (sin_phi, cos_phi) = phi.sin_cos();
    let t0 = phi_dot * s;
    let f_s = t0 * (phi_dot * p.m) + p.k0 * cos_phi;
    let f_phi = -(t0 * (p.k2 * s_dot) + sin_phi * (s * p.k0));
    let zero = S::ZERO;
    [f_s, f_phi, zero]
}

/// Residuals `g` of the constraints of positions; 0 for those of velocities alone.
///
/// ```text
/// g[contact.gap] = R - s - r
/// ```
pub fn constraint_positions<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 3],
) -> [S; 2] {
    let s = q[0];
    let g1 = p.k1 - s;
    let zero = S::ZERO;
    [g1, zero]
}

/// Residuals `phi = G v + dg/dt` of the constraints at the level of velocities.
///
/// ```text
/// phi[contact.gap] = -der(s)
/// phi[contact.slip] = s*der(phi) + r*der(theta)
/// ```
pub fn constraint_rates<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 3],
    v: &[S; 3],
) -> [S; 2] {
    let s = q[0];
    let s_dot = v[0];
    let phi_dot = v[1];
    let theta_dot = v[2];
    let phi1 = -s_dot;
    let phi2 = theta_dot * p.r + phi_dot * s;
    [phi1, phi2]
}

/// Constraint matrix `G`, the derivatives of `phi` by the rates.
///
/// ```text
/// G[contact.gap, s] = -1
/// G[contact.slip, phi] = s
/// G[contact.slip, theta] = r
/// ```
pub fn constraint_matrix<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 3]) -> [S; 6] {
    let s = q[0];
    let zero = S::ZERO;
    [S::from_f64(-1.0), zero, zero, zero, s, p.r]
}

/// Right-hand side `gamma` of `G a = gamma`.
///
/// ```text
/// gamma[contact.slip] = -der(s)*der(phi)
/// ```
pub fn constraint_drift<S: ::lagrangian::emitted::Scalar>(v: &[S; 3]) -> [S; 2] {
    let s_dot = v[0];
    let phi_dot = v[1];
    let zero = S::ZERO;
    let gamma2 = -(phi_dot * s_dot);
    [zero, gamma2]
}

/// Accelerations `a`, the solution of `M a = f + G^T lambda`, `G a = gamma` eliminated along the
/// machine, without the coordinates that constraints settle.
///
/// A pivot that vanishes is an error.
pub fn accelerations<S: ::lagrangian::emitted::Number>(
    p: &Prepared<S>,
    q: &[S; 3],
) -> Result<[S; 3], ::lagrangian::emitted::Singular> {
    S::run(Accelerations { p, q })
}

/// A call of [`accelerations`], to be run with whatever instructions the processor has.
pub struct Accelerations<'a, S> {
    /// As `accelerations` takes it.
    pub p: &'a Prepared<S>,
    /// As `accelerations` takes it.
    pub q: &'a [S; 3],
}

impl<S: Copy> ::lagrangian::emitted::scalar::Kernel<S> for Accelerations<'_, S> {
    type Output = Result<[S; 3], ::lagrangian::emitted::Singular>;

    #[inline(always)]
    fn run<N: ::lagrangian::emitted::Scalar<Stored = S>>(self) -> Self::Output {
        let Self { p, q } = self;
        let n = N::load;
        if let Some(singular) = p.singular {
            return Err(singular);
        }
        let phi = n(q[1]);
        let sin_phi = phi.sin();
        let zero = N::ZERO;
        let phi_ddot = sin_phi * n(p.k8);
        let theta_ddot = sin_phi * n(p.k7);
        let accelerations = [zero.store(), phi_ddot.store(), theta_ddot.store()];
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
) -> Result<[S; 2], ::lagrangian::emitted::Singular> {
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
    type Output = Result<[S; 2], ::lagrangian::emitted::Singular>;

    #[inline(always)]
    fn run<N: ::lagrangian::emitted::Scalar<Stored = S>>(self) -> Self::Output {
        let Self { p, q, v } = self;
        let n = N::load;
        if let Some(singular) = p.singular {
            return Err(singular);
        }
        let s = n(q[0]);
        let phi = n(q[1]);
        let s_dot = n(v[0]);
        let phi_dot = n(v[1]);
        let (sin_phi, cos_phi) = phi.sin_cos();
        let t0 = phi_dot * s_dot;
        let t1 = s * s;
        let t2 = t0 * N::from_f64(2.0);
        let t3 = phi_dot * (phi_dot * s);
        let t4 = s * (n(p.m) * s);
        let t5 = t1.mul_add(n(p.k5) / t1, n(p.k6));
        let t6 = sin_phi.mul_sub(t3, t2 * cos_phi);
        let t7 = t2.mul_add(sin_phi, cos_phi * t3) + n(p.g);
        let lambda1 = n(p.m) * cos_phi.mul_add(t7, sin_phi * t6);
        let lambda2 = -((t0 + sin_phi.neg_mul_add(t7, cos_phi * t6)) / t5);
        let sound = n(p.J).exceeds(N::from_f64(4.440892098500626e-15) * n(p.J))
            & n(p.m).exceeds(N::from_f64(4.440892098500626e-15) * n(p.m))
            & t4.exceeds(N::from_f64(4.440892098500626e-15) * t4)
            & n(p.k5).exceeds(N::from_f64(4.440892098500626e-15) * n(p.k5))
            & t5.exceeds(N::from_f64(4.440892098500626e-15) * t5)
            & lambda2.is_finite();
        if !sound {
            check(n(p.J), n(p.J), 4.440892098500626e-15, 2)?;
            check(n(p.m), n(p.m), 4.440892098500626e-15, 0)?;
            check(t4, t4, 4.440892098500626e-15, 1)?;
            check(n(p.k5), n(p.k5), 4.440892098500626e-15, 3)?;
            check(t5, t5, 4.440892098500626e-15, 4)?;
        }
        let multipliers = [lambda1.store(), lambda2.store()];
        Ok(multipliers)
    }
}

/// Kinetic energy `T`, in J.
///
/// ```text
/// T = 1/2*m*der(s)^2 + 1/2*m*s^2*der(phi)^2 + 1/2*J*der(theta)^2
/// ```
pub fn kinetic_energy<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 3],
    v: &[S; 3],
) -> S {
    let s = q[0];
    let phi = q[1];
    let s_dot = v[0];
    let phi_dot = v[1];
    let theta_dot = v[2];
    let (sin_phi, cos_phi) = phi.sin_cos();
    let t0 = phi_dot * s;
    let t1 = t0 * cos_phi + sin_phi * s_dot;
    let t2 = cos_phi * s_dot - t0 * sin_phi;
    let t3 = (t2 * t2 + t1 * t1) * p.m + theta_dot * (theta_dot * p.J);
    S::from_f64(0.5) * t3
}

/// Potential energy `V`, in J.
///
/// ```text
/// V = -m*g*s*cos(phi)
/// ```
pub fn potential_energy<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 3]) -> S {
    let s = q[0];
    let phi = q[1];
    let cos_phi = phi.cos();
    cos_phi * (p.k4 * s)
}

/// By how much `s > 0` holds.
pub fn assumption_0<S: ::lagrangian::emitted::Scalar>(q: &[S; 3]) -> S {
    let s = q[0];
    s
}

/// Names and units.
const PARAMETERS: [(&str, &str); 5] = [
    ("m", "kg"),
    ("J", "kg*m^2"),
    ("R", "m"),
    ("r", "m"),
    ("g", "m/s^2"),
];

/// Names and units.
const COORDINATES: [(&str, &str); 3] = [("s", "m"), ("phi", "rad"), ("theta", "rad")];

/// Names and units.
const INPUTS: [(&str, &str); 0] = [];

/// Names and units.
const OUTPUTS: [(&str, &str); 0] = [];

/// Names, units, units of multipliers, whether positions are constrained.
const CONSTRAINTS: [(&str, &str, &str, bool); 2] = [
    ("contact.gap", "m", "N", true),
    ("contact.slip", "m/s", "N", false),
];

impl ::lagrangian::emitted::Machine for RollingCylinder {
    type System = Prepared;

    fn name(&self) -> &str {
        "RollingCylinder"
    }

    fn parameters(
        &self,
    ) -> impl ExactSizeIterator<Item = (::lagrangian::emitted::Quantity<'_>, f64)> {
        let values = [self.m, self.J, self.R, self.r, self.g];
        quantities(&PARAMETERS, values)
    }

    fn parameter_mut(&mut self, index: usize) -> Option<&mut f64> {
        match index {
            0 => Some(&mut self.m),
            1 => Some(&mut self.J),
            2 => Some(&mut self.R),
            3 => Some(&mut self.r),
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
        _: &[f64; 3],
        _: &Inputs,
        result: &mut [f64; 3],
    ) -> Result<(), ::lagrangian::emitted::Singular> {
        <f64 as ::lagrangian::emitted::Number>::run_in_place(Accelerations { p: self, q }, result)
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

    fn constraint_positions(&self, _: f64, q: &[f64; 3], to: &mut [f64]) {
        fill(to, &constraint_positions(self, q));
    }

    fn constraint_rates(&self, _: f64, q: &[f64; 3], v: &[f64; 3], to: &mut [f64]) {
        fill(to, &constraint_rates(self, q, v));
    }

    fn constraint_matrix(&self, _: f64, q: &[f64; 3], to: &mut [f64]) {
        fill(to, &constraint_matrix(self, q));
    }

    fn constraint_drift(&self, _: f64, _: &[f64; 3], v: &[f64; 3], to: &mut [f64]) {
        fill(to, &constraint_drift(v));
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
        _: &Outputs,
    ) -> impl ExactSizeIterator<Item = (::lagrangian::emitted::Quantity<'_>, f64)> {
        let values = [];
        quantities(&OUTPUTS, values)
    }

    fn outputs(&self, _: f64, _: &[f64; 3], _: &[f64; 3], _: &[f64; 3], _: &Inputs) -> Outputs {
        Outputs {}
    }

    fn assumptions(
        &self,
        _: f64,
        q: &[f64; 3],
        _: &[f64; 3],
        _: &Inputs,
    ) -> impl ExactSizeIterator<Item = ::lagrangian::emitted::Assumption<'_>> {
        let facts = [assumption("s > 0", true, assumption_0(q))];
        facts.into_iter()
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
        let mut room = [0.0; ::lagrangian::emitted::constraint_workspace(3, 2)];
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
            r: lanes(|p| p.r),
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
        _: &Self::Vectors,
        _: &Self::BatchInputs,
        result: &mut Self::Vectors,
    ) -> Result<(), ::lagrangian::emitted::Singular> {
        <::lagrangian::emitted::Lanes<N> as ::lagrangian::emitted::Number>::run_in_place(
            Accelerations { p, q },
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

/// A fact and by how much it holds.
fn assumption(text: &str, strict: bool, margin: f64) -> ::lagrangian::emitted::Assumption<'_> {
    ::lagrangian::emitted::Assumption {
        text,
        margin,
        strict,
    }
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
