// @generated from machines/cart_pole.machine by `cargo xtask generate`; edits are lost.

//! A cart on a rail with a pole hinged to it; a motor pushes the cart. The pole's angle is measured
//! from the upward vertical, so that a controller balances it at zero.
//!
//! 2 coordinates, 7 parameters, 1 input, 2 outputs. Arithmetic of one call:
//!
//! | function | mul | add | div | sin cos | other | temporaries |
//! | --- | --: | --: | --: | --: | --: | --: |
//! | `prepare` | 8 | 4 | 1 | 0 | 0 | 13 |
//! | `mass_matrix` | 1 | 0 | 0 | 1 | 0 | 2 |
//! | `bias` | 3 | 0 | 0 | 1 | 0 | 4 |
//! | `applied` | 3 | 2 | 0 | 1 | 0 | 6 |
//! | `forces` | 6 | 3 | 0 | 1 | 0 | 10 |
//! | `accelerations` | 12 | 7 | 1 | 1 | 0 | 22 |
//! | `kinetic_energy` | 12 | 4 | 0 | 1 | 0 | 18 |
//! | `potential_energy` | 1 | 0 | 0 | 1 | 0 | 2 |
//! | `dissipation` | 4 | 1 | 0 | 0 | 0 | 5 |
//! | `work_rate` | 1 | 0 | 0 | 0 | 0 | 1 |
//! | `dissipation_rate` | 4 | 1 | 0 | 0 | 0 | 5 |
//! | `output_tip` | 1 | 0 | 0 | 1 | 0 | 2 |
//! | `output_hinge_force` | 5 | 2 | 0 | 1 | 0 | 9 |
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

/// A cart on a rail with a pole hinged to it; a motor pushes the cart. The pole's angle is measured
/// from the upward vertical, so that a controller balances it at zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CartPole<S = f64> {
    /// Mass of the cart. Unit: `kg`. Default: 1.
    pub cart: S,
    /// Mass of the pole. Unit: `kg`. Default: 0.1.
    pub pole: S,
    /// Half the length of the pole. Unit: `m`. Default: 0.5.
    pub l: S,
    /// Inertia of the pole about its mass centre: pole (2 l)^2 / 12 for a uniform one. Unit:
    /// `kg*m^2`. Default: 1/120.
    pub J: S,
    /// Viscous friction of the rail and of the hinge. Unit: `N*s/m`. Default: 0.05.
    pub rail: S,
    /// `hinge`. Unit: `N*m*s`. Default: 0.001.
    pub hinge: S,
    /// `g`. Unit: `m/s^2`. Default: 9.81.
    pub g: S,
}

impl Default for CartPole {
    fn default() -> Self {
        Self {
            cart: 1.0,
            pole: 0.1,
            l: 0.5,
            J: 0.008333333333333333,
            rail: 0.05,
            hinge: 0.001,
            g: 9.81,
        }
    }
}

impl<S> CartPole<S> {
    /// These values as other numbers.
    pub fn map<R>(self, f: impl Fn(S) -> R) -> CartPole<R> {
        CartPole {
            cart: f(self.cart),
            pole: f(self.pole),
            l: f(self.l),
            J: f(self.J),
            rail: f(self.rail),
            hinge: f(self.hinge),
            g: f(self.g),
        }
    }
}

impl<S: ::lagrangian::emitted::Scalar> CartPole<S> {
    /// Computes what depends on the parameters alone, once.
    pub fn prepare(&self) -> Prepared<S> {
        let k7 = self.pole + self.cart;
        let k5 = self.pole * self.l;
        let k0 = self.l * S::from_f64(2.0);
        let k1 = self.l * self.l;
        let k2 = k5 * self.g;
        let k3 = self.hinge * S::from_f64(0.5);
        let k4 = self.rail * S::from_f64(0.5);
        let k6 = S::from_f64(0.5) * self.cart;
        let k8 = self.J + self.l * k5;
        let k9 = -k5;
        let k10 = -self.pole;
        let k11 = S::ONE / k7;
        let singular = if vanishes(k7, k7, 1.7763568394002505e-15) {
            Some(singular(0, k7, k7))
        } else {
            None
        };
        Prepared {
            pole: self.pole,
            l: self.l,
            J: self.J,
            rail: self.rail,
            hinge: self.hinge,
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
            singular,
        }
    }

    /// The start values of the description, at rest and `t = 0`.
    pub fn start(&self) -> ::lagrangian::emitted::State<Coordinates<S>> {
        let zero = S::ZERO;
        let theta = S::from_ratio(1, 20);
        let q = [zero, theta];
        let v = [S::ZERO; 2];
        ::lagrangian::emitted::State {
            t: 0.0,
            q: Coordinates::from_array(q),
            v: Coordinates::from_array(v),
        }
    }
}

/// The coordinates of [`CartPole`], or their rates, by name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coordinates<S = f64> {
    /// `x`. Unit: `m`.
    pub x: S,
    /// `theta`. Unit: `rad`.
    pub theta: S,
}

impl<S: Copy> Coordinates<S> {
    /// The numbers in the order of the description: the order of `q` in every function here.
    pub fn to_array(self) -> [S; 2] {
        [self.x, self.theta]
    }

    /// Names for numbers in the order of the description.
    pub fn from_array(q: [S; 2]) -> Self {
        Self {
            x: q[0],
            theta: q[1],
        }
    }

    /// These values as other numbers.
    pub fn map<R>(self, f: impl Fn(S) -> R) -> Coordinates<R> {
        Coordinates {
            x: f(self.x),
            theta: f(self.theta),
        }
    }
}

/// What can be set while a [`CartPole`] runs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Inputs<S = f64> {
    /// Force of the motor on the cart. Unit: `N`. Default: 0.
    pub push: S,
}

impl Default for Inputs {
    fn default() -> Self {
        Self { push: 0.0 }
    }
}

impl<S> Inputs<S> {
    /// These values as other numbers.
    pub fn map<R>(self, f: impl Fn(S) -> R) -> Inputs<R> {
        Inputs { push: f(self.push) }
    }
}

/// What can be observed of a [`CartPole`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outputs<S = f64> {
    /// Height of the pole's tip above the hinge. Unit: `m`.
    pub tip: S,
    /// Force of the pole on the hinge along the rail. Unit: `N`.
    pub hinge_force: S,
}

/// The parameters of a [`CartPole`], with the work done that depends on them alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prepared<S = f64> {
    /// `pole`
    pole: S,
    /// `l`
    l: S,
    /// `J`
    J: S,
    /// `rail`
    rail: S,
    /// `hinge`
    hinge: S,
    /// `2*l`
    k0: S,
    /// `l^2`
    k1: S,
    /// `pole*l*g`
    k2: S,
    /// `0.5*hinge`
    k3: S,
    /// `0.5*rail`
    k4: S,
    /// `pole*l`
    k5: S,
    /// `0.5*cart`
    k6: S,
    /// `cart + pole`
    k7: S,
    /// `J + pole*l^2`
    k8: S,
    /// `-pole*l`
    k9: S,
    /// `-pole`
    k10: S,
    /// `1/(cart + pole)`
    k11: S,
    /// Why these parameters leave the machine without accelerations, if they do.
    singular: Option<::lagrangian::emitted::Singular>,
}

/// Mass matrix `M`.
///
/// ```text
/// M[x, x] = cart + pole
/// M[theta, x] = pole*l*cos(theta)
/// M[theta, theta] = pole*l^2 + J
/// ```
pub fn mass_matrix<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 2]) -> [[S; 2]; 2] {
    let theta = q[1];
    let cos_theta = theta.cos();
    let m21 = p.k5 * cos_theta;
    [[p.k7, m21], [m21, p.k8]]
}

/// Bias `h`: velocity products and explicit time in the inertia forces.
///
/// ```text
/// h[x] = -pole*l*sin(theta)*der(theta)^2
/// ```
pub fn bias<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 2], v: &[S; 2]) -> [S; 2] {
    let theta = q[1];
    let theta_dot = v[1];
    let sin_theta = theta.sin();
    let h_x = sin_theta * (theta_dot * (theta_dot * p.k9));
    let zero = S::ZERO;
    [h_x, zero]
}

/// Applied generalized forces `Q`.
///
/// ```text
/// Q[x] = push - rail*der(x)
/// Q[theta] = pole*l*g*sin(theta) - hinge*der(theta)
/// ```
pub fn applied<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 2],
    v: &[S; 2],
    u: &Inputs<S>,
) -> [S; 2] {
    let theta = q[1];
    let x_dot = v[0];
    let theta_dot = v[1];
    let sin_theta = theta.sin();
    let q_x = u.push - x_dot * p.rail;
    let q_theta = p.k2 * sin_theta - theta_dot * p.hinge;
    [q_x, q_theta]
}

/// Right-hand side `f = Q - h` of `M a = f`.
pub fn forces<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 2],
    v: &[S; 2],
    u: &Inputs<S>,
) -> [S; 2] {
    let theta = q[1];
    let x_dot = v[0];
    let theta_dot = v[1];
    let sin_theta = theta.sin();
    let f_x = sin_theta * (theta_dot * (theta_dot * p.k5)) + (u.push - x_dot * p.rail);
    let f_theta = sin_theta * p.k2 - theta_dot * p.hinge;
    [f_x, f_theta]
}

/// Accelerations `a`, the solution of `M a = f` from the mass matrix multiplied out.
///
/// A pivot that vanishes is an error.
pub fn accelerations<S: ::lagrangian::emitted::Number>(
    p: &Prepared<S>,
    q: &[S; 2],
    v: &[S; 2],
    u: &Inputs<S>,
) -> Result<[S; 2], ::lagrangian::emitted::Singular> {
    S::run(Accelerations { p, q, v, u })
}

/// A call of [`accelerations`], to be run with whatever instructions the processor has.
pub struct Accelerations<'a, S> {
    /// As `accelerations` takes it.
    pub p: &'a Prepared<S>,
    /// As `accelerations` takes it.
    pub q: &'a [S; 2],
    /// As `accelerations` takes it.
    pub v: &'a [S; 2],
    /// As `accelerations` takes it.
    pub u: &'a Inputs<S>,
}

impl<S: Copy> ::lagrangian::emitted::scalar::Kernel<S> for Accelerations<'_, S> {
    type Output = Result<[S; 2], ::lagrangian::emitted::Singular>;

    #[inline(always)]
    fn run<N: ::lagrangian::emitted::Scalar<Stored = S>>(self) -> Self::Output {
        let Self { p, q, v, u } = self;
        let n = N::load;
        if let Some(singular) = p.singular {
            return Err(singular);
        }
        let theta = n(q[1]);
        let x_dot = n(v[0]);
        let theta_dot = n(v[1]);
        let (sin_theta, cos_theta) = theta.sin_cos();
        let t0 = n(p.k5) * cos_theta;
        let t1 = x_dot.neg_mul_add(n(p.rail), n(u.push));
        let t2 = sin_theta.mul_add(theta_dot * (n(p.k5) * theta_dot), t1);
        let t3 = n(p.k11) * t0;
        let t4 = sin_theta.neg_mul_add(n(p.k2), theta_dot * n(p.hinge));
        let t5 = t0.neg_mul_add(t3, n(p.k8));
        let t6 = t3.mul_add(t2, t4) / t5;
        let x_ddot = t3.mul_add(t6, n(p.k11) * t2);
        let theta_ddot = -t6;
        let sound =
            t5.exceeds(N::from_f64(1.7763568394002505e-15) * n(p.k8)) & theta_ddot.is_finite();
        if !sound {
            check(t5, n(p.k8), 1.7763568394002505e-15, 1)?;
        }
        let accelerations = [x_ddot.store(), theta_ddot.store()];
        Ok(accelerations)
    }
}

/// Kinetic energy `T`, in J.
///
/// ```text
/// T = 1/2*(cart + pole)*der(x)^2 + pole*l*cos(theta)*der(x)*der(theta)
///     + 1/2*(pole*l^2 + J)*der(theta)^2
/// ```
pub fn kinetic_energy<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 2],
    v: &[S; 2],
) -> S {
    let theta = q[1];
    let x_dot = v[0];
    let theta_dot = v[1];
    let (sin_theta, cos_theta) = theta.sin_cos();
    let t0 = theta_dot * theta_dot;
    let t1 = cos_theta * (theta_dot * p.l) + x_dot;
    let t2 = (sin_theta * (sin_theta * (t0 * p.k1)) + t1 * t1) * p.pole + t0 * p.J;
    S::from_f64(0.5) * t2 + x_dot * (x_dot * p.k6)
}

/// Potential energy `V`, in J.
///
/// ```text
/// V = pole*l*g*cos(theta)
/// ```
pub fn potential_energy<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 2]) -> S {
    let theta = q[1];
    let cos_theta = theta.cos();
    p.k2 * cos_theta
}

/// Dissipation function `D`, in W.
///
/// ```text
/// D = 1/2*rail*der(x)^2 + 1/2*hinge*der(theta)^2
/// ```
pub fn dissipation<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, v: &[S; 2]) -> S {
    let x_dot = v[0];
    let theta_dot = v[1];
    x_dot * (x_dot * p.k4) + theta_dot * (theta_dot * p.k3)
}

/// Power `P` that drives, forces and inputs put in, in W.
///
/// ```text
/// P = der(x)*push
/// ```
pub fn work_rate<S: ::lagrangian::emitted::Scalar>(v: &[S; 2], u: &Inputs<S>) -> S {
    let x_dot = v[0];
    u.push * x_dot
}

/// Power `R` that dampers take out, in W.
///
/// ```text
/// R = rail*der(x)^2 + hinge*der(theta)^2
/// ```
pub fn dissipation_rate<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, v: &[S; 2]) -> S {
    let x_dot = v[0];
    let theta_dot = v[1];
    x_dot * (x_dot * p.rail) + theta_dot * (theta_dot * p.hinge)
}

/// Height of the pole's tip above the hinge. Unit: `m`.
///
/// ```text
/// tip = 2*l*cos(theta)
/// ```
pub fn output_tip<S: ::lagrangian::emitted::Scalar>(p: &Prepared<S>, q: &[S; 2]) -> S {
    let theta = q[1];
    let cos_theta = theta.cos();
    p.k0 * cos_theta
}

/// Force of the pole on the hinge along the rail. Unit: `N`.
///
/// ```text
/// hinge_force = -pole*(der(der(x)) + (l*cos(theta)*der(der(theta)) - l*sin(theta)*der(theta)^2))
/// ```
pub fn output_hinge_force<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 2],
    v: &[S; 2],
    a: &[S; 2],
) -> S {
    let theta = q[1];
    let theta_dot = v[1];
    let x_ddot = a[0];
    let theta_ddot = a[1];
    let (sin_theta, cos_theta) = theta.sin_cos();
    let t0 = (cos_theta * theta_ddot - sin_theta * (theta_dot * theta_dot)) * p.l;
    p.k10 * (t0 + x_ddot)
}

/// Everything that the description asks to observe.
pub fn outputs<S: ::lagrangian::emitted::Scalar>(
    p: &Prepared<S>,
    q: &[S; 2],
    v: &[S; 2],
    a: &[S; 2],
) -> Outputs<S> {
    Outputs {
        tip: output_tip(p, q),
        hinge_force: output_hinge_force(p, q, v, a),
    }
}

/// Names and units.
const PARAMETERS: [(&str, &str); 7] = [
    ("cart", "kg"),
    ("pole", "kg"),
    ("l", "m"),
    ("J", "kg*m^2"),
    ("rail", "N*s/m"),
    ("hinge", "N*m*s"),
    ("g", "m/s^2"),
];

/// Names and units.
const COORDINATES: [(&str, &str); 2] = [("x", "m"), ("theta", "rad")];

/// Names and units.
const INPUTS: [(&str, &str); 1] = [("push", "N")];

/// Names and units.
const OUTPUTS: [(&str, &str); 2] = [("tip", "m"), ("hinge_force", "N")];

impl ::lagrangian::emitted::Machine for CartPole {
    type System = Prepared;

    fn name(&self) -> &str {
        "CartPole"
    }

    fn parameters(
        &self,
    ) -> impl ExactSizeIterator<Item = (::lagrangian::emitted::Quantity<'_>, f64)> {
        let values = [
            self.cart, self.pole, self.l, self.J, self.rail, self.hinge, self.g,
        ];
        quantities(&PARAMETERS, values)
    }

    fn parameter_mut(&mut self, index: usize) -> Option<&mut f64> {
        match index {
            0 => Some(&mut self.cart),
            1 => Some(&mut self.pole),
            2 => Some(&mut self.l),
            3 => Some(&mut self.J),
            4 => Some(&mut self.rail),
            5 => Some(&mut self.hinge),
            6 => Some(&mut self.g),
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
        u: &Inputs,
        result: &mut [f64; 2],
    ) -> Result<(), ::lagrangian::emitted::Singular> {
        <f64 as ::lagrangian::emitted::Number>::run_in_place(
            Accelerations { p: self, q, v, u },
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

    fn applied(&self, _: f64, q: &[f64; 2], v: &[f64; 2], u: &Inputs, result: &mut [f64; 2]) {
        *result = applied(self, q, v, u);
    }

    fn forces(&self, _: f64, q: &[f64; 2], v: &[f64; 2], u: &Inputs, result: &mut [f64; 2]) {
        *result = forces(self, q, v, u);
    }

    fn kinetic_energy(&self, _: f64, q: &[f64; 2], v: &[f64; 2]) -> f64 {
        kinetic_energy(self, q, v)
    }

    fn potential_energy(&self, _: f64, q: &[f64; 2], _: &Inputs) -> f64 {
        potential_energy(self, q)
    }

    fn dissipation(&self, _: f64, _: &[f64; 2], v: &[f64; 2], _: &Inputs) -> f64 {
        dissipation(self, v)
    }

    fn work_rate(&self, _: f64, _: &[f64; 2], v: &[f64; 2], _: &[f64; 2], u: &Inputs) -> f64 {
        work_rate(v, u)
    }

    fn dissipation_rate(&self, _: f64, _: &[f64; 2], v: &[f64; 2], _: &Inputs) -> f64 {
        dissipation_rate(self, v)
    }

    fn default_inputs(&self) -> Inputs {
        Inputs::default()
    }

    fn input_values(
        &self,
        inputs: &Inputs,
    ) -> impl ExactSizeIterator<Item = (::lagrangian::emitted::Quantity<'_>, f64)> {
        let values = [inputs.push];
        quantities(&INPUTS, values)
    }

    fn output_values(
        &self,
        outputs: &Outputs,
    ) -> impl ExactSizeIterator<Item = (::lagrangian::emitted::Quantity<'_>, f64)> {
        let values = [outputs.tip, outputs.hinge_force];
        quantities(&OUTPUTS, values)
    }

    fn outputs(&self, _: f64, q: &[f64; 2], v: &[f64; 2], a: &[f64; 2], _: &Inputs) -> Outputs {
        outputs(self, q, v, a)
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
}

impl<const N: usize> ::lagrangian::emitted::Batched<N> for Prepared
where
    ::lagrangian::emitted::Lanes<N>: ::lagrangian::emitted::Number,
{
    type Batch = Prepared<::lagrangian::emitted::Lanes<N>>;
    type Vectors = [::lagrangian::emitted::Lanes<N>; 2];
    type BatchInputs = Inputs<::lagrangian::emitted::Lanes<N>>;

    fn batch(systems: [&Self; N]) -> Self::Batch {
        let lanes = |number: fn(&Self) -> f64| ::lagrangian::emitted::Lanes(systems.map(number));
        Prepared {
            pole: lanes(|p| p.pole),
            l: lanes(|p| p.l),
            J: lanes(|p| p.J),
            rail: lanes(|p| p.rail),
            hinge: lanes(|p| p.hinge),
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
            singular: None,
        }
    }

    fn batch_inputs(inputs: [&Inputs; N]) -> Self::BatchInputs {
        let lanes = |number: fn(&Inputs) -> f64| ::lagrangian::emitted::Lanes(inputs.map(number));
        Inputs {
            push: lanes(|u| u.push),
        }
    }

    fn inputs_of_lane(inputs: &Self::BatchInputs, lane: usize) -> Inputs {
        Inputs {
            push: inputs.push[lane],
        }
    }

    fn is_singular(&self) -> bool {
        self.singular.is_some()
    }

    fn batch_accelerations(
        p: &Self::Batch,
        _: ::lagrangian::emitted::Lanes<N>,
        q: &Self::Vectors,
        v: &Self::Vectors,
        u: &Self::BatchInputs,
        result: &mut Self::Vectors,
    ) -> Result<(), ::lagrangian::emitted::Singular> {
        <::lagrangian::emitted::Lanes<N> as ::lagrangian::emitted::Number>::run_in_place(
            Accelerations { p, q, v, u },
            result,
        )
    }
}

impl<S: ::lagrangian::emitted::Real> ::lagrangian::emitted::MachineIn<S> for CartPole<S> {
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
    type Inputs = Inputs<S>;

    fn coordinates(&self) -> impl ExactSizeIterator<Item = ::lagrangian::emitted::Quantity<'_>> {
        COORDINATES.iter().map(quantity)
    }

    fn to_coordinates(&self, vector: &[S; 2]) -> Coordinates<S> {
        Coordinates::from_array(*vector)
    }

    fn to_vector(&self, coordinates: &Coordinates<S>) -> [S; 2] {
        coordinates.to_array()
    }

    fn default_inputs(&self) -> Inputs<S> {
        <Inputs>::default().map(S::from_f64)
    }

    fn accelerations(
        &self,
        _: S,
        q: &[S; 2],
        v: &[S; 2],
        u: &Inputs<S>,
        result: &mut [S; 2],
    ) -> Result<(), ::lagrangian::emitted::Singular> {
        <S as ::lagrangian::emitted::Number>::run_in_place(
            Accelerations { p: self, q, v, u },
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
