//! The motion of a machine together with its derivatives by anything it depends on, equation (I.14.5) of E. Hairer, S. P.
//! Nørsett, G. Wanner, *Solving Ordinary Differential Equations I*, 2nd ed. 1993.
//!
//! The proved program itself is evaluated over dual numbers, once for each direction of differentiation. A direction may change
//! anything that the motion depends on: parameters, inputs, starts that follow from parameters, and the state through formulas
//! that drive inputs. The same evaluation gives derivatives of outputs. The spec needs no `derivatives`.
//!
//! Within one phase of a run the state of each unilateral contact is fixed: a closed contact is a constraint, and a slipping
//! one has friction in one direction. [`crate::across`] joins the phases.

mod contacts;

use std::sync::{Arc, Mutex, PoisonError};

use lagrangian::interpreted::{InterpretedMachine, InterpretedSystem, Named, Signal, Signals};
use lagrangian::{
    Assumption, Error, InputLaw, Machine, NoPiece, Piece, Quantity, Simulation, Singular, Solution,
    State, System,
};
use lagrangian_program::{Arguments, Interpreter, Role};
use lagrangian_scalar::Dual;

pub(crate) use contacts::{Acts, DualState, Sought, SoughtReaction};
pub use contacts::{Layer, Phase};

/// A direction of differentiation: the change of each parameter, and of each input that nothing drives.
#[derive(Clone, Debug)]
pub struct Direction {
    /// The change of each parameter.
    pub parameters: Vec<f64>,
    /// The change of the value that each input has while nothing drives it.
    pub inputs: Vec<f64>,
}

impl Direction {
    /// A direction in which neither parameters nor inputs change; the start may.
    pub fn of_start(machine: &InterpretedMachine) -> Direction {
        Direction {
            parameters: vec![0.0; machine.program().parameters.len()],
            inputs: vec![0.0; machine.program().inputs.len()],
        }
    }
}

/// A machine that is run together with its derivatives.
#[derive(Clone, Debug)]
pub struct Varied<'m> {
    /// The machine.
    pub machine: &'m InterpretedMachine,
    /// The directions of differentiation.
    pub directions: Vec<Direction>,
    /// The signals that drive its inputs.
    pub signals: &'m Signals,
    /// The phase of its unilateral contacts; `None` if all are open.
    pub phase: Option<Arc<Phase>>,
}

/// Its equations of motion. Vectors hold those of the machine one after another: the values, then the derivatives
/// in each direction.
#[derive(Debug)]
pub struct VariedSystem {
    system: InterpretedSystem,
    dimension: usize,
    names: Vec<(String, String)>,
    phase: Option<Arc<Phase>>,
    /// Derivatives of inputs that nothing drives, in each direction.
    inputs: Vec<Vec<f64>>,
    /// The program with its parameters, one interpreter for each direction.
    duals: Mutex<Vec<Interpreter<Dual<f64>>>>,
    /// Inputs that are formulas, with the indices of these formulas, ordered such that each reads only
    /// inputs set before it.
    formulas: Vec<(usize, usize)>,
}

/// Inputs with their derivatives in each direction.
#[derive(Clone, Debug)]
pub struct VariedInputs {
    /// The inputs.
    pub own: Named,
    /// Their derivatives.
    pub by: Vec<Vec<f64>>,
}

impl Varied<'_> {
    /// The starts of the machine as its spec gives them, in each direction: coordinates and rates.
    pub fn starts(&self) -> Vec<[Vec<f64>; 2]> {
        let program = self.machine.program();
        let n = program.dimension();
        let zero = Dual::constant(0.0);
        let one = |direction: &Direction| {
            let parameters = self.duals(direction);
            let mut interpreter = Interpreter::new(program, &parameters);
            let (mut q, mut v) = (vec![zero; n], vec![zero; n]);
            interpreter.start(&mut q, &mut v);
            [q, v].map(|duals| duals.iter().map(|dual| dual.derivative).collect())
        };
        self.directions.iter().map(one).collect()
    }

    fn duals(&self, direction: &Direction) -> Vec<Dual<f64>> {
        let values = self.machine.parameter_values().iter();
        values
            .zip(&direction.parameters)
            .map(|(value, derivative)| Dual {
                value: *value,
                derivative: *derivative,
            })
            .collect()
    }
}

impl Machine for Varied<'_> {
    type System = VariedSystem;

    fn name(&self) -> &str {
        self.machine.name()
    }

    fn parameters(&self) -> impl ExactSizeIterator<Item = (Quantity<'_>, f64)> {
        self.machine.parameters()
    }

    fn prepare(&self) -> VariedSystem {
        let system = self.machine.prepare();
        let program = self.machine.program();
        let own: Vec<(String, String)> = system
            .coordinates()
            .map(|of| (of.name.to_owned(), of.unit.to_owned()))
            .collect();
        let mut names = own.clone();
        for k in 1..=self.directions.len() {
            // These names cannot collide with those of a spec, and the unit is one that no coordinate has.
            names.extend(
                own.iter()
                    .map(|(name, unit)| (format!("{name} by {k}"), format!("{unit} by {k}"))),
            );
        }
        let driven = self.signals.driven();
        let formulas = driven.filter_map(|(input, signal)| match signal {
            Signal::Output(output) => Some((input, *output)),
            _ => None,
        });
        VariedSystem {
            dimension: own.len(),
            names,
            duals: Mutex::new(
                self.directions
                    .iter()
                    .map(|direction| Interpreter::new(program, &self.duals(direction)))
                    .collect(),
            ),
            formulas: formulas.collect(),
            phase: self.phase.clone(),
            inputs: self.directions.iter().map(|of| of.inputs.clone()).collect(),
            system,
        }
    }

    fn start(&self) -> State<Vec<f64>> {
        let State { t, q, v } = self.machine.start();
        let starts = self.starts();
        let all = |own: Vec<f64>, level: usize| {
            let by = starts.iter().flat_map(|start| start[level].iter().copied());
            own.into_iter().chain(by).collect()
        };
        State {
            t,
            q: all(q.values, 0),
            v: all(v.values, 1),
        }
    }
}

impl VariedSystem {
    /// The part of a vector that belongs to the machine, as dual numbers in a direction.
    fn part(&self, vector: &[f64], direction: usize) -> Vec<Dual<f64>> {
        let n = self.dimension;
        let derivatives = &vector[(direction + 1) * n..][..n];
        duals(&vector[..n], derivatives)
    }

    fn own(&self, vector: &[f64]) -> Vec<f64> {
        vector[..self.dimension].to_vec()
    }

    fn interpreters(&self) -> std::sync::MutexGuard<'_, Vec<Interpreter<Dual<f64>>>> {
        // A poisoned lock is harmless: each call of an interpreter writes everything that it reads.
        self.duals.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The derivatives of inputs that are formulas.
    fn vary_inputs(&self, t: f64, q: &[f64], v: &[f64], inputs: &mut VariedInputs) {
        if self.formulas.is_empty() {
            return;
        }
        for (k, interpreter) in self.interpreters().iter_mut().enumerate() {
            let (q, v) = (self.part(q, k), self.part(v, k));
            for (input, output) in &self.formulas {
                let u = duals(&inputs.own.values, &inputs.by[k]);
                let at = Arguments {
                    t: Dual::constant(t),
                    q: &q,
                    v: &v,
                    u: &u,
                    a: &[],
                };
                inputs.by[k][*input] = derivative_of_output(interpreter, *output, at);
            }
        }
    }

    /// The derivatives of an output, in each direction.
    pub fn output(
        &self,
        output: usize,
        t: f64,
        [q, v, a]: [&[f64]; 3],
        u: &VariedInputs,
    ) -> Vec<f64> {
        let mut interpreters = self.interpreters();
        let one = |(k, interpreter): (usize, &mut Interpreter<Dual<f64>>)| {
            let (q, v, a) = (self.part(q, k), self.part(v, k), self.part(a, k));
            let u = duals(&u.own.values, &u.by[k]);
            let at = Arguments {
                t: Dual::constant(t),
                q: &q,
                v: &v,
                u: &u,
                a: &a,
            };
            derivative_of_output(interpreter, output, at)
        };
        interpreters.iter_mut().enumerate().map(one).collect()
    }
}

/// The derivative of an output, NaN where it has no value.
fn derivative_of_output(
    interpreter: &mut Interpreter<Dual<f64>>,
    output: usize,
    at: Arguments<'_, Dual<f64>>,
) -> f64 {
    let mut value = [Dual::constant(0.0)];
    match interpreter.call(Role::Output(output), at, &mut value) {
        Ok(()) => value[0].derivative,
        Err(_) => f64::NAN,
    }
}

fn duals(values: &[f64], derivatives: &[f64]) -> Vec<Dual<f64>> {
    let pairs = values.iter().zip(derivatives);
    pairs
        .map(|(value, derivative)| Dual {
            value: *value,
            derivative: *derivative,
        })
        .collect()
}

impl System for VariedSystem {
    type Vector = Vec<f64>;
    type Matrix = Vec<f64>;
    type Coordinates = Vec<f64>;
    type Inputs = VariedInputs;
    type Outputs = ();

    fn coordinates(&self) -> impl ExactSizeIterator<Item = Quantity<'_>> {
        let names = self.names.iter();
        names.map(|(name, unit)| Quantity { name, unit })
    }

    fn to_coordinates(&self, vector: &Vec<f64>) -> Vec<f64> {
        vector.clone()
    }

    fn to_vector(&self, coordinates: &Vec<f64>) -> Vec<f64> {
        coordinates.clone()
    }

    fn accelerations(
        &self,
        t: f64,
        q: &Vec<f64>,
        v: &Vec<f64>,
        u: &VariedInputs,
        a: &mut Vec<f64>,
    ) -> Result<(), Singular> {
        let n = self.dimension;
        if let Some(phase) = self.phase.as_ref().filter(|phase| !phase.is_free()) {
            for (k, interpreter) in self.interpreters().iter_mut().enumerate() {
                let (q, v) = (self.part(q, k), self.part(v, k));
                let u = duals(&u.own.values, &u.by[k]);
                let state = [Dual::constant(t)].into_iter().chain(q).chain(v);
                let mut at = DualState::new(interpreter, state.collect(), &u, phase)?;
                let reaction = at.reaction(phase, k)?;
                for (i, dual) in reaction.a.iter().enumerate() {
                    a[i] = dual.value;
                    a[(k + 1) * n + i] = dual.derivative;
                }
            }
            return Ok(());
        }
        let mut own = vec![0.0; n];
        self.system
            .accelerations(t, &self.own(q), &self.own(v), &u.own, &mut own)?;
        a[..n].copy_from_slice(&own);
        let mut row = vec![Dual::constant(0.0); n];
        for (k, interpreter) in self.interpreters().iter_mut().enumerate() {
            let (q, v) = (self.part(q, k), self.part(v, k));
            let u = duals(&u.own.values, &u.by[k]);
            let arguments = Arguments {
                t: Dual::constant(t),
                q: &q,
                v: &v,
                u: &u,
                a: &[],
            };
            let called = interpreter.call(Role::Accelerations, arguments, &mut row);
            let part = &mut a[(k + 1) * n..][..n];
            for (to, dual) in part.iter_mut().zip(&row) {
                // If the pivot is singular, the call for the values has returned an error already.
                *to = match called {
                    Ok(()) => dual.derivative,
                    Err(_) => f64::NAN,
                };
            }
        }
        Ok(())
    }

    /// The mass matrix and the forces are those of the machine alone, so a run has no equations to check.
    fn equations(&self) -> usize {
        0
    }

    fn default_inputs(&self) -> VariedInputs {
        let own = self.system.default_inputs();
        VariedInputs {
            by: self.inputs.clone(),
            own,
        }
    }

    fn outputs(&self, _: f64, _: &Vec<f64>, _: &Vec<f64>, _: &Vec<f64>, _: &VariedInputs) {}

    fn assumptions(
        &self,
        t: f64,
        q: &Vec<f64>,
        v: &Vec<f64>,
        u: &VariedInputs,
    ) -> impl ExactSizeIterator<Item = Assumption<'_>> {
        let (q, v) = (self.own(q), self.own(v));
        let facts: Vec<Assumption<'_>> = self.system.assumptions(t, &q, &v, &u.own).collect();
        facts.into_iter()
    }
}

/// The signals of a machine, as the input law of the machine with its derivatives.
#[derive(Clone, Debug)]
pub struct VariedLaw<'m>(pub &'m Signals);

impl<'m> VariedLaw<'m> {
    /// Runs a simulation under this law. The function is not generic, so runs of varied machines are compiled in this crate and not
    /// again where they are called.
    ///
    /// # Errors
    /// The errors of [`Simulation::run`].
    pub fn run<'a>(
        simulation: Simulation<'a, Varied<'m>, VariedLaw<'m>>,
        start: State<Vec<f64>>,
    ) -> Result<Solution<Varied<'m>, VariedLaw<'m>>, Error> {
        simulation.run(start)
    }
}

impl InputLaw<VariedSystem> for VariedLaw<'_> {
    fn set(
        &self,
        system: &VariedSystem,
        t: f64,
        q: &Vec<f64>,
        v: &Vec<f64>,
        inputs: &mut VariedInputs,
    ) {
        self.set_in(Piece::ALL, system, t, q, v, inputs);
    }

    fn is_constant(&self) -> bool {
        InputLaw::<InterpretedSystem>::is_constant(self.0)
    }

    fn piece(&self, t: f64, forward: bool, order: u32) -> Result<Piece, NoPiece<'_>> {
        InputLaw::<InterpretedSystem>::piece(self.0, t, forward, order)
    }

    fn set_in(
        &self,
        piece: Piece,
        system: &VariedSystem,
        t: f64,
        q: &Vec<f64>,
        v: &Vec<f64>,
        inputs: &mut VariedInputs,
    ) {
        let (own_q, own_v) = (system.own(q), system.own(v));
        self.0
            .set_in(piece, &system.system, t, &own_q, &own_v, &mut inputs.own);
        system.vary_inputs(t, q, v, inputs);
    }

    fn is_constant_in_pieces(&self) -> bool {
        InputLaw::<InterpretedSystem>::is_constant_in_pieces(self.0)
    }
}
