//! Signals that drive the inputs of a machine read from a spec: formulas, tables, functions, and sampled controllers.

use core::fmt::{self, Debug, Display};
use std::string::String;
use std::sync::Arc;
use std::vec::Vec;

use lagrangian_program::{Op, Program, Role, Source};

use super::{InterpretedMachine, InterpretedSystem, Named};
use crate::table::Table;
use crate::{InputLaw, Machine, NoPiece, Piece, Simulation};

/// A function of time, coordinates and rates.
pub type SignalFunction = Arc<dyn Fn(f64, &[f64], &[f64]) -> f64 + Send + Sync>;

/// The signal of an input.
#[derive(Clone)]
#[non_exhaustive]
pub enum Signal {
    /// The output with this index: a formula in the spec language.
    Output(usize),
    /// The value of a table.
    Table(Arc<Table>),
    /// A function of time and state, which must depend on its arguments alone and be smooth.
    Function(SignalFunction),
}

impl Debug for Signal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Output(output) => f.debug_tuple("Output").field(output).finish(),
            Self::Table(table) => f.debug_tuple("Table").field(&table.name()).finish(),
            Self::Function(_) => f.write_str("Function"),
        }
    }
}

/// The driven inputs of a machine, each with its signal; the others keep their defaults.
///
/// ```
/// use lagrangian::interpreted::{InterpretedMachine, Signal, Signals};
/// use lagrangian::{Machine, Simulation, Table};
///
/// let text = "machine Cart in plane {
///     parameters { m: kg = 2 }
///     coordinates { x: m }
///     inputs { push: N }
///     bodies { cart { mass: m, at: (x, 0) } }
///     forces { motor { on: x, value: push } }
/// }";
/// let cart = InterpretedMachine::from_text(text).build()?;
/// // 4 N for a second, and then nothing.
/// let push = Table::hold([0.0, 1.0], [4.0, 0.0])?;
/// let signals = Signals::new(&cart, [(0, Signal::Table(push.into()))])?;
/// let run = signals.drive(Simulation::new(&cart).until(3.0), &cart).run(cart.start())?;
/// assert!((run.end().q.values[0] - 5.0).abs() < 1e-13);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, Default)]
pub struct Signals {
    /// Ordered so that each reads only inputs that were set before.
    rules: Arc<[Rule]>,
    sampled: Option<Sampled>,
}

/// An input and its signal.
#[derive(Clone, Debug)]
struct Rule {
    /// The index of the input.
    input: usize,
    signal: Signal,
    /// Whether it has one value within each piece of time.
    is_constant: bool,
}

/// Inputs that are set at certain instants and hold between them.
#[derive(Clone, Debug)]
struct Sampled {
    rules: Arc<[Rule]>,
    period: f64,
    delay: f64,
}

/// Why signals cannot drive a machine.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum SignalError {
    /// There is no input, or no output, with this index.
    NoSuch(usize),
    /// An input is driven more than once.
    Twice(String),
    /// A formula reads accelerations, which depend on the input in turn.
    Accelerations(String),
    /// Formulas read each other's inputs.
    Circle(Vec<String>),
}

impl Display for SignalError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoSuch(number) => write!(f, "there is no input or output number {number}"),
            Self::Twice(input) => write!(f, "input `{input}` is driven more than once"),
            Self::Accelerations(input) => write!(
                f,
                "input `{input}`: its formula depends on accelerations, which depend on it in turn or jump where contacts change"
            ),
            Self::Circle(inputs) if inputs.len() == 1 => write!(
                f,
                "input `{}`: its formula depends on the input itself",
                inputs[0]
            ),
            Self::Circle(inputs) => write!(
                f,
                "the formulas of the inputs `{}` depend on each other",
                inputs.join("`, `")
            ),
        }
    }
}

impl core::error::Error for SignalError {}

impl Signals {
    /// Signals for the inputs with these indices. A formula may read other inputs, but not in a cycle, and no accelerations.
    ///
    /// # Errors
    /// The signal that is not possible, and why.
    pub fn new(
        machine: &InterpretedMachine,
        driven: impl IntoIterator<Item = (usize, Signal)>,
    ) -> Result<Signals, SignalError> {
        Signals::default().and(machine, driven, None)
    }

    /// Adds inputs that are set at the start and every `period` seconds after it. They take effect `delay` seconds later and hold
    /// until they are set again. A formula reads sampled inputs, including its own, as they were set at the previous sample, and
    /// initially their defaults.
    ///
    /// # Errors
    /// The signal that is not possible, and why.
    pub fn and_sampled(
        self,
        machine: &InterpretedMachine,
        driven: impl IntoIterator<Item = (usize, Signal)>,
        [period, delay]: [f64; 2],
    ) -> Result<Signals, SignalError> {
        self.and(machine, driven, Some([period, delay]))
    }

    fn and(
        self,
        machine: &InterpretedMachine,
        driven: impl IntoIterator<Item = (usize, Signal)>,
        sampling: Option<[f64; 2]>,
    ) -> Result<Signals, SignalError> {
        let program = &*machine.program;
        let name = |input: usize| machine.names.inputs[input].name.clone();
        let known = self.rules.iter().chain(self.sampled_rules());
        let mut taken: Vec<usize> = known.map(|rule| rule.input).collect();
        let mut open: Vec<(Rule, Dependences)> = Vec::new();
        for (input, signal) in driven {
            if input >= machine.names.inputs.len() {
                return Err(SignalError::NoSuch(input));
            }
            if taken.contains(&input) {
                return Err(SignalError::Twice(name(input)));
            }
            taken.push(input);
            let reads = Dependences::of(program, &signal)?;
            if reads.accelerations {
                return Err(SignalError::Accelerations(name(input)));
            }
            let rule = Rule {
                input,
                signal,
                is_constant: false,
            };
            open.push((rule, reads));
        }
        if let Some([period, delay]) = sampling {
            let rules = open.into_iter().map(|(rule, _)| rule).collect();
            let sampled = Some(Sampled {
                rules,
                period,
                delay,
            });
            return Ok(Signals { sampled, ..self });
        }
        let mut rules: Vec<Rule> = self.rules.to_vec();
        while !open.is_empty() {
            let waits = |reads: &Dependences| {
                let mut others = open.iter();
                others.any(|(other, _)| reads.inputs.contains(&other.input))
            };
            let Some(next) = open.iter().position(|(_, reads)| !waits(reads)) else {
                return Err(SignalError::Circle(names_of_circle(&open, name)));
            };
            let (rule, reads) = open.remove(next);
            let mut varying = rules.iter().filter(|rule| !rule.is_constant);
            let follows = varying.any(|rule| reads.inputs.contains(&rule.input));
            rules.push(Rule {
                is_constant: reads.is_constant && !follows,
                ..rule
            });
        }
        Ok(Signals {
            rules: rules.into(),
            ..self
        })
    }

    fn sampled_rules(&self) -> &[Rule] {
        self.sampled.as_ref().map_or(&[], |sampled| &sampled.rules)
    }

    /// The indices of the driven inputs with their signals, ordered so that each reads only inputs that were set before. Sampled
    /// inputs are not included.
    pub fn driven(&self) -> impl Iterator<Item = (usize, &Signal)> {
        self.rules.iter().map(|rule| (rule.input, &rule.signal))
    }

    /// Whether nothing is driven.
    pub fn is_empty(&self) -> bool {
        self.rules.is_empty() && self.sampled.is_none()
    }

    /// The index of the first input that changes within pieces of time. If there is one, the motion has no Taylor series.
    pub fn first_varying(&self) -> Option<usize> {
        let varying = self.rules.iter().filter(|rule| !rule.is_constant);
        varying.map(|rule| rule.input).min()
    }

    /// Whether some inputs are set at certain instants and hold between them. [`InputLaw::set`] does not know their values; an
    /// [`Observation`](crate::Observation) does.
    pub fn is_sampled(&self) -> bool {
        self.sampled.is_some()
    }

    /// Drives the inputs of a simulation of the machine by these signals.
    pub fn drive<'a, L>(
        &self,
        simulation: Simulation<'a, InterpretedMachine, L>,
        machine: &InterpretedMachine,
    ) -> Simulation<'a, InterpretedMachine, Signals> {
        self.sample(simulation.law(self.clone()), machine)
    }

    /// Adds the controller of these signals, if they have one, to a simulation whose inputs already have a law.
    pub fn sample<'a, L>(
        &self,
        simulation: Simulation<'a, InterpretedMachine, L>,
        machine: &InterpretedMachine,
    ) -> Simulation<'a, InterpretedMachine, L>
    where
        L: InputLaw<InterpretedSystem>,
    {
        let Some(sampled) = self.sampled.clone() else {
            return simulation;
        };
        let (law, system) = (self.clone(), machine.prepare());
        let [period, delay] = [sampled.period, sampled.delay];
        let is_function = |rule: &Rule| matches!(rule.signal, Signal::Function(_));
        let has_memory = sampled.rules.iter().any(is_function);
        let controlled =
            simulation.sampled_with_delay(period, delay, move |state, inputs: &mut Named| {
                let (t, q, v) = (state.t, &state.q.values, &state.v.values);
                let mut set_inputs = inputs.clone();
                law.set(&system, t, q, v, &mut set_inputs);
                for rule in &*sampled.rules {
                    inputs.values[rule.input] =
                        value(rule, Piece::ALL, &system, (t, q, v), &set_inputs.values);
                }
            });
        if has_memory {
            controlled
        } else {
            controlled.sampled_without_memory()
        }
    }
}

/// The value of the signal of a rule at a state, with the inputs that are known so far.
fn value(
    rule: &Rule,
    piece: Piece,
    system: &InterpretedSystem,
    (t, q, v): (f64, &[f64], &[f64]),
    inputs: &[f64],
) -> f64 {
    match &rule.signal {
        Signal::Output(output) => system.output(*output, t, q, v, &[], inputs),
        Signal::Table(table) => table.value_in(piece, t),
        Signal::Function(function) => function(t, q, v),
    }
}

/// The dependences of a signal.
struct Dependences {
    inputs: Vec<usize>,
    accelerations: bool,
    /// Whether it depends on nothing that changes within a piece of time, except possibly on inputs.
    is_constant: bool,
}

impl Dependences {
    fn of(program: &Program, signal: &Signal) -> Result<Dependences, SignalError> {
        let mut reads = Dependences {
            inputs: Vec::new(),
            accelerations: false,
            is_constant: true,
        };
        match signal {
            Signal::Table(table) => reads.is_constant = table.is_constant_in_pieces(),
            Signal::Function(_) => reads.is_constant = false,
            Signal::Output(output) => {
                let function = program.function(Role::Output(*output));
                let function = function.ok_or(SignalError::NoSuch(*output))?;
                for op in &function.code {
                    match op {
                        Op::Read(Source::Input(input)) => reads.inputs.push(*input as usize),
                        Op::Read(Source::Acceleration(_)) => reads.accelerations = true,
                        Op::Read(Source::Parameter(_) | Source::Prepared(_)) => {}
                        Op::Read(_) => reads.is_constant = false,
                        _ => {}
                    }
                }
            }
        }
        Ok(reads)
    }
}

/// The inputs that form a cycle, in the order in which each reads the next.
fn names_of_circle(open: &[(Rule, Dependences)], name: impl Fn(usize) -> String) -> Vec<String> {
    let next = |at: usize| {
        let reads = &open[at].1.inputs;
        open.iter()
            .position(|(other, _)| reads.contains(&other.input))
    };
    // Every open rule reads an input of another open rule, so following them from any one ends in a cycle.
    let mut path: Vec<usize> = Vec::new();
    let mut at = 0;
    loop {
        if let Some(since) = path.iter().position(|known| *known == at) {
            return path[since..]
                .iter()
                .map(|at| name(open[*at].0.input))
                .collect();
        }
        path.push(at);
        match next(at) {
            Some(found) => at = found,
            None => return path.iter().map(|at| name(open[*at].0.input)).collect(),
        }
    }
}

impl InputLaw<InterpretedSystem> for Signals {
    fn set(
        &self,
        system: &InterpretedSystem,
        t: f64,
        q: &Vec<f64>,
        v: &Vec<f64>,
        inputs: &mut Named,
    ) {
        self.set_in(Piece::ALL, system, t, q, v, inputs);
    }

    fn is_constant(&self) -> bool {
        self.rules.is_empty()
    }

    fn piece(&self, t: f64, forward: bool, order: u32) -> Result<Piece, NoPiece<'_>> {
        let mut all = Piece::ALL;
        for rule in &*self.rules {
            if let Signal::Table(table) = &rule.signal {
                all = all.and(table.piece(t, forward, order)?, forward);
            }
        }
        Ok(all)
    }

    fn set_in(
        &self,
        piece: Piece,
        system: &InterpretedSystem,
        t: f64,
        q: &Vec<f64>,
        v: &Vec<f64>,
        inputs: &mut Named,
    ) {
        for rule in &*self.rules {
            inputs.values[rule.input] = value(rule, piece, system, (t, q, v), &inputs.values);
        }
    }

    fn is_constant_in_pieces(&self) -> bool {
        self.rules.iter().all(|rule| rule.is_constant)
    }

    fn is_partial(&self) -> bool {
        true
    }
}
