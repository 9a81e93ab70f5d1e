//! Derivatives of a motion with respect to its start, to parameters and to inputs.
//!
//! With `x(t; s)` a motion and `s` a number that it depends on, the derivative `y = ∂q/∂s` obeys the
//! variational equation, equation (I.14.5) of E. Hairer, S. P. Nørsett, G. Wanner, *Solving Ordinary
//! Differential Equations I*, 2nd ed. 1993:
//!
//! ```text
//! ÿ = ∂a/∂q y + ∂a/∂v ẏ + ∂a/∂s
//! ```
//!
//! It is of second order, like the motion. So the motion together with its derivatives is a [`System`] again, to which
//! everything for systems applies.

use std::string::{String, ToString};
use std::vec;
use std::vec::Vec;

use crate::forward::forward;
use crate::names::rate_name;
use crate::shared_workspace::SharedWorkspace;
use crate::{
    Assumption, Coordinates, Differentiate, Error, Machine, Quantity, Singular, State, System,
    Vector,
};

/// A machine whose motion is the motion of another machine together with its derivatives.
///
/// It is a [`Machine`] itself: a [`Simulation`](crate::Simulation) runs it with any method, with events, samples and states
/// between the steps. Coordinates and rates are [`Varied`]: those of the machine, and their derivatives with respect to each
/// variable in the order in which the variables were added, in SI units: `rad` by `m` is `rad/m`.
///
/// Motion and derivatives are integrated together, and the tolerance applies to both. Derivatives may grow where the motion
/// does not (in a resonance as t, in chaos as e^{λt}), so steps that are short enough for the motion alone may be too long
/// for its derivatives. Conversely, the motion is computed with other steps than alone, so it differs by as much as the
/// tolerance allows. The absolute tolerance is the same number for all; [`absolute_of`](crate::Simulation::absolute_of) sets
/// it for one of them, `"theta by l"`.
///
/// Machines with unilateral contacts are refused, since derivatives jump where contacts open and close. They also jump where a force does,
/// as friction by `sign(der(x))` does where `der(x)` passes 0, and this is *not* found here: from there on the derivatives are wrong. Make
/// such a force smooth, or take differences of runs; `lagrangian sensitivities` compares its derivatives with them.
///
/// Machines with constraints are refused unless the caller provides the derivatives of their start
/// ([`with_start_on_constraints`](Self::with_start_on_constraints)): the start satisfies the constraints, and changes with
/// parameters as these do.
///
/// The system must have derivatives of its accelerations: it comes from a description with
/// `derivatives { coordinates, rates, … }`, which also names the parameters and `inputs` that are varied, or from the
/// interpreter. Inputs must be constant or functions of time: a law that depends on the *state*
/// ([`inputs`](crate::Simulation::inputs)) is not differentiated.
///
/// ```
/// use lagrangian::{Machine, Sensitive, Simulation};
///
/// lagrangian::machine! {
///     machine Pendulum in plane {
///         parameters { l: m = 0.5, g: m/s^2 = 9.81 }
///         coordinates { theta: rad = 1 }
///         bodies { ball { mass: 1, at: l*(sin(theta), -cos(theta)) } }
///         gravity (0, -g);
///         derivatives { coordinates, rates, l }
///     }
/// }
///
/// let pendulum = Pendulum::default();
/// let sensitive = Sensitive::new(&pendulum).by("l")?.by_start("theta")?;
/// let run = Simulation::new(&sensitive).until(2.0).run(sensitive.start())?;
/// let q = run.at(1.5)?.q;
/// println!("{} rad, {} rad/m, {} rad/rad", q.value.theta, q.by[0].theta, q.by[1].theta);
///
/// // A pendulum of another length is where the derivative says, but for the length's square.
/// let longer = Pendulum { l: 0.5001, ..pendulum };
/// let other = Simulation::new(&longer).until(2.0).run(longer.start())?;
/// let difference = other.at(1.5)?.q.theta - q.value.theta;
/// assert!((difference - q.by[0].theta * 0.0001).abs() < 1e-5 * difference.abs() + 1e-6);
/// # Ok::<(), lagrangian::Error>(())
/// ```
#[derive(Debug)]
#[must_use = "this is a machine: run it in a simulation"]
pub struct Sensitive<'m, M> {
    machine: &'m M,
    variables: Vec<Variable>,
    /// Parameters and inputs with respect to which there are derivatives.
    known: usize,
    names: Vec<(String, String)>,
    /// Whether the caller replaces the derivatives of the start by those on the constraints.
    is_on_constraints: bool,
}

impl<M> Clone for Sensitive<'_, M> {
    fn clone(&self) -> Self {
        Self {
            machine: self.machine,
            variables: self.variables.clone(),
            known: self.known,
            names: self.names.clone(),
            is_on_constraints: self.is_on_constraints,
        }
    }
}

/// A value with its derivatives.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Varied<C> {
    /// The value.
    pub value: C,
    /// Its derivatives with respect to each of the variables.
    pub by: Vec<C>,
}

/// A variable of differentiation.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Variable {
    /// The start value of a coordinate.
    Start(usize),
    /// The start value of a rate.
    StartRate(usize),
    /// One of [`Differentiate::variables`].
    Other(usize),
}

impl<'m, M: Machine<System: Differentiate>> Sensitive<'m, M> {
    /// The motion of `machine`, initially without derivatives.
    pub fn new(machine: &'m M) -> Self {
        let system = machine.prepare();
        let coordinates = system.coordinates();
        Self {
            machine,
            variables: Vec::new(),
            known: system.variables().len(),
            names: coordinates
                .map(|Quantity { name, unit }| (name.to_string(), unit.to_string()))
                .collect(),
            is_on_constraints: false,
        }
    }

    /// Accepts a machine with constraints as well. [`start_from`](Self::start_from) still returns the derivatives for
    /// numbers that are free; the caller has to replace them by those of a start that stays on the constraints as the
    /// variable changes: for a constraint g(q, t; s) = 0 of positions, `∂g/∂q y + ∂g/∂s = 0`, and for a rate φ(q, v, t; s) =
    /// 0, `∂φ/∂q y + ∂φ/∂v ẏ + ∂φ/∂s = 0`.
    ///
    /// Along such a motion both equations stay satisfied, because the accelerations of the machine keep the second
    /// derivatives of its constraints at 0. There is no projection in such a run: errors of its steps remain and grow with
    /// time, as position errors do when constraints hold at acceleration level only.
    pub fn with_start_on_constraints(mut self) -> Self {
        self.is_on_constraints = true;
        self
    }

    /// Differentiates with respect to the start value of a coordinate, `"s1"`, or `"q[3]"` in a family.
    ///
    /// # Errors
    /// If there is no such coordinate, or the machine has constraints or contacts.
    pub fn by_start(self, coordinate: &str) -> Result<Self, Error> {
        self.check_free()?;
        let index = self.coordinate(coordinate)?;
        Ok(self.with_start(index))
    }

    /// Differentiates with respect to the start value of a coordinate's rate.
    ///
    /// # Errors
    /// If there is no such coordinate, or the machine has constraints or contacts.
    pub fn by_start_rate(self, coordinate: &str) -> Result<Self, Error> {
        self.check_free()?;
        let index = self.coordinate(coordinate)?;
        Ok(self.with_start_rate(index))
    }

    /// Differentiates with respect to the start values of all coordinates, then of all rates: the state transition matrix, a
    /// column for each.
    ///
    /// # Errors
    /// If the machine has constraints or contacts.
    pub fn by_state(mut self) -> Result<Self, Error> {
        self.check_free()?;
        let n = self.dimension();
        for i in 0..n {
            self = self.with_start(i);
        }
        for i in 0..n {
            self = self.with_start_rate(i);
        }
        Ok(self)
    }

    /// Differentiates with respect to a parameter or an input. Start values stay fixed: if the description computes them from
    /// the parameter, the derivative does not include that part.
    ///
    /// # Errors
    /// If the accelerations have no derivative with respect to it: it must be in the `derivatives` of the description. Or if
    /// the machine has constraints or contacts.
    pub fn by(self, name: &str) -> Result<Self, Error> {
        self.check_free()?;
        let system = self.machine.prepare();
        let found = system
            .variables()
            .enumerate()
            .find(|(_, variable)| variable.name == name)
            .map(|(index, variable)| (index, variable.unit.to_string()));
        match found {
            Some((index, unit)) => Ok(self.with(Variable::Other(index), (name, &unit))),
            None => Err(Error::UnknownVariable {
                name: name.into(),
                known: system
                    .variables()
                    .map(|variable| variable.name.to_string())
                    .collect(),
            }),
        }
    }

    /// A start of the motion: the given state of the machine, and its derivatives, which are 0 and 1.
    pub fn start_from(
        &self,
        State { t, q, v }: State<Coordinates<M>>,
    ) -> State<Varied<Coordinates<M>>> {
        let system = self.machine.prepare();
        let unit = |index: Option<usize>| {
            let mut unit = <M::System as System>::Vector::zeros(self.dimension());
            if let Some(index) = index {
                unit.as_mut_slice()[index] = 1.0;
            }
            system.to_coordinates(&unit)
        };
        let by = |of: fn(&Variable) -> Option<usize>| {
            let variables = self.variables.iter();
            variables.map(|variable| unit(of(variable))).collect()
        };
        let start = |variable: &Variable| match variable {
            Variable::Start(index) => Some(*index),
            _ => None,
        };
        let start_rate = |variable: &Variable| match variable {
            Variable::StartRate(index) => Some(*index),
            _ => None,
        };
        State {
            t,
            q: Varied {
                value: q,
                by: by(start),
            },
            v: Varied {
                value: v,
                by: by(start_rate),
            },
        }
    }

    /// Checks that the derivatives of the motion follow from those of the accelerations. A start on constraints moves with
    /// them, as the start of a pendulum does with its length, and derivatives of the constraints with respect to parameters
    /// are not available.
    fn check_free(&self) -> Result<(), Error> {
        let system = self.machine.prepare();
        if let Some(contact) = system.unilateral_contacts().next() {
            let contact = contact.name.to_string();
            return Err(Error::CollidingSensitivity { contact });
        }
        let first = system
            .constraints()
            .next()
            .map(|constraint| constraint.name.to_string());
        match first {
            Some(constraint) if !self.is_on_constraints => {
                Err(Error::ConstrainedSensitivity { constraint })
            }
            _ => Ok(()),
        }
    }

    /// The number of the machine's own coordinates.
    fn dimension(&self) -> usize {
        self.names.len() / (1 + self.variables.len())
    }

    fn coordinate(&self, name: &str) -> Result<usize, Error> {
        let own = &self.names[..self.dimension()];
        let index = own.iter().position(|(own, _)| own == name);
        index.ok_or_else(|| Error::UnknownCoordinate { name: name.into() })
    }

    fn with_start(self, index: usize) -> Self {
        let (name, unit) = self.names[index].clone();
        self.with(Variable::Start(index), (&name, &unit))
    }

    fn with_start_rate(self, index: usize) -> Self {
        let (name, unit) = &self.names[index];
        let (name, unit) = (rate_name(name), std::format!("({unit}/s)"));
        self.with(Variable::StartRate(index), (&name, &unit))
    }

    fn with(mut self, variable: Variable, (name, unit): (&str, &str)) -> Self {
        for i in 0..self.dimension() {
            let (own, own_unit) = &self.names[i];
            let entry = (
                std::format!("{own} by {name}"),
                std::format!("{own_unit}/{unit}"),
            );
            self.names.push(entry);
        }
        self.variables.push(variable);
        self
    }
}

impl<M: Machine<System: Differentiate>> Machine for Sensitive<'_, M> {
    type System = SensitiveSystem<M::System>;

    fn name(&self) -> &str {
        self.machine.name()
    }

    fn parameters(&self) -> impl ExactSizeIterator<Item = (Quantity<'_>, f64)> {
        self.machine.parameters()
    }

    fn prepare(&self) -> Self::System {
        let n = self.dimension();
        SensitiveSystem {
            system: self.machine.prepare(),
            names: self.names.clone(),
            dimension: n,
            variables: self.variables.clone(),
            scratch: SharedWorkspace::new(Scratch {
                matrices: [
                    <M::System as System>::Matrix::zeros(n * n),
                    <M::System as System>::Matrix::zeros(n * n),
                ],
                others: vec![0.0; n * self.known],
            }),
        }
    }

    fn start(&self) -> State<Varied<Coordinates<M>>> {
        self.start_from(self.machine.start())
    }
}

/// The equations of motion of a [`Sensitive`] machine, including the variational equations.
///
/// Vectors consist of vectors of the machine, one after another: the values, then the derivatives with respect to each
/// variable. All other quantities (matrices, forces, energies, outputs) are those of the machine alone.
#[derive(Clone, Debug)]
pub struct SensitiveSystem<S: System> {
    system: S,
    names: Vec<(String, String)>,
    dimension: usize,
    variables: Vec<Variable>,
    scratch: SharedWorkspace<Scratch<S::Matrix>>,
}

/// Memory for an evaluation.
#[derive(Clone, Debug)]
struct Scratch<T> {
    /// Derivatives with respect to coordinates and to rates.
    matrices: [T; 2],
    /// Derivatives with respect to parameters and inputs.
    others: Vec<f64>,
}

impl<S: Differentiate> SensitiveSystem<S> {
    /// The values of the machine itself in a vector.
    fn own(&self, vector: &[f64]) -> S::Vector {
        let mut own = S::Vector::zeros(self.dimension);
        for (to, from) in own.as_mut_slice().iter_mut().zip(vector) {
            *to = *from;
        }
        own
    }

    /// Writes the values of the machine itself into a vector.
    fn copy(own: &S::Vector, vector: &mut [f64]) {
        for (to, from) in vector.iter_mut().zip(own.as_slice()) {
            *to = *from;
        }
    }

    fn wrapped(&self) -> &S {
        &self.system
    }

    fn put(&self, to: &mut [f64], write: impl FnOnce(&mut S::Vector)) {
        let mut own = S::Vector::zeros(self.dimension);
        write(&mut own);
        Self::copy(&own, to);
    }

    fn put_matrix(&self, to: &mut [f64], write: impl FnOnce(&mut S::Matrix)) {
        let mut own = S::Matrix::zeros(self.dimension * self.dimension);
        write(&mut own);
        for (to, from) in to.iter_mut().zip(own.as_slice()) {
            *to = *from;
        }
    }
}

impl<S: Differentiate> System for SensitiveSystem<S> {
    type Vector = Vec<f64>;
    type Matrix = Vec<f64>;
    type Coordinates = Varied<S::Coordinates>;
    type Inputs = S::Inputs;
    type Outputs = S::Outputs;
    // No code for contacts is compiled for it.
    const MAY_SLIDE: bool = false;
    const MAY_COLLIDE: bool = false;

    fn coordinates(&self) -> impl ExactSizeIterator<Item = Quantity<'_>> {
        let names = self.names.iter();
        names.map(|(name, unit)| Quantity { name, unit })
    }

    fn to_coordinates(&self, vector: &Vec<f64>) -> Self::Coordinates {
        let mut parts = vector
            .chunks(self.dimension.max(1))
            .map(|part| self.system.to_coordinates(&self.own(part)));
        // Without coordinates there are no parts.
        let none = || self.system.to_coordinates(&self.own(&[]));
        Varied {
            value: parts.next().unwrap_or_else(none),
            by: match self.dimension {
                0 => self.variables.iter().map(|_| none()).collect(),
                _ => parts.collect(),
            },
        }
    }

    fn to_vector(&self, coordinates: &Self::Coordinates) -> Vec<f64> {
        let Varied { value, by } = coordinates;
        let mut vector = vec![0.0; self.names.len()];
        // Missing derivatives are 0, and superfluous ones are ignored.
        let parts = core::iter::once(value).chain(by);
        for (part, to) in parts.zip(vector.chunks_mut(self.dimension.max(1))) {
            Self::copy(&self.system.to_vector(part), to);
        }
        vector
    }

    fn accelerations(
        &self,
        t: f64,
        q: &Vec<f64>,
        v: &Vec<f64>,
        u: &S::Inputs,
        a: &mut Vec<f64>,
    ) -> Result<(), Singular> {
        let n = self.dimension;
        let mut scratch = self.scratch.lock();
        let Scratch {
            matrices: [by_q, by_v],
            others,
        } = &mut *scratch;
        let mut own = S::Vector::zeros(n);
        let (own_q, own_v) = (self.own(q), self.own(v));
        self.system
            .differentiate(t, &own_q, &own_v, u, &mut own, by_q, by_v, others)?;
        Self::copy(&own, a);
        let (by_q, by_v) = (by_q.as_slice(), by_v.as_slice());
        for (k, variable) in self.variables.iter().enumerate() {
            let part = (k + 1) * n..(k + 2) * n;
            let (y, rate) = (&q[part.clone()], &v[part.clone()]);
            for (i, to) in a[part].iter_mut().enumerate() {
                let row = i * n..(i + 1) * n;
                let rows = by_q[row.clone()].iter().zip(y);
                let rates = by_v[row].iter().zip(rate);
                let sum: f64 = rows.chain(rates).map(|(k, y)| k * y).sum();
                let own = match variable {
                    Variable::Other(j) => others[i * (others.len() / n) + j],
                    _ => 0.0,
                };
                *to = sum + own;
            }
        }
        Ok(())
    }

    /// The mass matrix and the forces are those of the machine alone and do not cover the derivatives.
    fn equations(&self) -> usize {
        0
    }

    forward!(
        mass_matrix,
        bias,
        applied,
        forces,
        observed,
        work_rate,
        default_inputs,
        input_values,
        outputs,
        output_values,
    );

    fn assumptions(
        &self,
        t: f64,
        q: &Vec<f64>,
        v: &Vec<f64>,
        u: &S::Inputs,
    ) -> impl ExactSizeIterator<Item = Assumption<'_>> {
        let (q, v) = (self.own(q), self.own(v));
        let facts: Vec<Assumption<'_>> = self.system.assumptions(t, &q, &v, u).collect();
        facts.into_iter()
    }
}
