//! Machines that are read from a spec at run time, without a Rust compiler.
//!
//! Interpreted machines are slower than emitted code by a factor of about ten, and otherwise the same: they execute the same
//! operations in the same order. With the feature `jit` an [`Engine`] compiles frequently called functions to machine code,
//! which is as fast as emitted code.

use core::fmt;
use std::boxed::Box;
use std::string::{String, ToString};
use std::sync::{Arc, MutexGuard};
use std::vec;
use std::vec::Vec;

use lagrangian_mechanics::Proved;
use lagrangian_mechanics::series::ProvedSeries;
use lagrangian_program as program;
use lagrangian_program::contact_parts::ContactParts;
use lagrangian_program::series::NoSeries;
use lagrangian_program::{Arguments, Interpreter, Program, Role, Shape, Slot};
use lagrangian_scalar::{Dual, Interval, Kernel, Scalar};
use lagrangian_spec::model::{self, Variable};
use lagrangian_spec::token::normalized;

mod contact_parts;
mod enclosure;
mod engine;
mod expanding;
#[cfg(feature = "jit")]
mod in_lanes;
mod in_numbers;
mod in_series;
mod motion_series;
mod precise;
mod reading;
mod recording;
mod runs;
mod signals;
mod table_file;

use contact_parts::RunningParts;
use expanding::Expanding;
use motion_series::MotionSeries;

use crate::settings::TaskWithStart;
use crate::shared_workspace::SharedWorkspace;

pub use crate::error::{Diagnostic, MissingParameters, NoMachineCode, NoNumbers, Note};
pub use crate::names::UnknownName;
pub use enclosure::{Enclosure, NotEnclosed};
pub use engine::Engine;
pub use in_numbers::InterpretedSystemIn;
pub use in_series::SeriesStepper;
pub use precise::{PreciseEnd, PreciseRun};
pub use reading::Reading;
pub use recording::{Column, ColumnKind, Recording};
pub use signals::{Signal, SignalError, SignalFunction, Signals};
pub use table_file::{TableFile, TableFileError};

use crate::{
    Assumption, Compliance, Constraint, ContactQuantity, Differentiate, ImpactLaw, ImpactOrder,
    Linearize, Machine, Number, Painleve, Pivot, Quantity, Singular, Staged, State, System,
    UnilateralContact, accelerations_with_friction, multipliers_with_friction,
};

/// A machine whose equations are interpreted, with the values of its parameters.
#[derive(Clone, Debug)]
pub struct InterpretedMachine {
    program: Arc<Program>,
    names: Arc<Names>,
    parameters: Vec<f64>,
    inputs: Vec<f64>,
    series: MotionSeries,
    machine_code: engine::MachineCode,
    /// The numbers of single contacts, where there are many, and their machine code.
    contact_parts: Option<Arc<ContactParts>>,
    gap_arguments: Option<Arc<[bool]>>,
    code_of_parts: engine::MachineCode,
}

/// Numbers under the names of coordinates, inputs or outputs; a member of a family is called `q[3]`.
#[derive(Clone, PartialEq)]
pub struct Named {
    labels: Arc<[Label]>,
    /// The numbers, in the order of the description.
    pub values: Vec<f64>,
}

/// The settings and the start of a run.
type RunTask<'a, 'l> = TaskWithStart<'a, 'l, InterpretedMachine>;

/// Name and unit of a number.
#[derive(Debug, PartialEq, Eq)]
struct Label {
    name: String,
    unit: String,
}

#[derive(Debug)]
struct Names {
    parameters: Arc<[Label]>,
    coordinates: Arc<[Label]>,
    inputs: Arc<[Label]>,
    outputs: Arc<[Label]>,
}

/// The equations of motion of an [`InterpretedMachine`].
#[derive(Clone, Debug)]
pub struct InterpretedSystem {
    program: Arc<Program>,
    names: Arc<Names>,
    inputs: Vec<f64>,
    /// Memory that calls write to.
    running: SharedWorkspace<Running>,
    /// The numbers of single contacts, where there are many.
    contact_parts: Option<SharedWorkspace<RunningParts>>,
    /// Where there are, for each coordinate and for the time whether a gap depends on it.
    gap_arguments: Option<Arc<[bool]>>,
    /// The parameters, and the same program over intervals once it is needed; for machines with guided contacts, or with
    /// [many](ContactParts) unilateral ones.
    parameters: Vec<f64>,
    enclosing: SharedWorkspace<Option<Interpreter<Interval>>>,
    series: MotionSeries,
    has_linear_assumptions: bool,
    has_state_energy: bool,
    /// Whether it has work and losses that are not always 0.
    has_powers: [bool; 2],
    expanding: SharedWorkspace<Expanding>,
}

/// Executes the functions of a system.
#[derive(Clone, Debug)]
struct Running {
    /// The interpreter with its registers.
    interpreter: Interpreter<f64>,
    /// Machine code that replaces the interpreter where there is any.
    compiled: engine::Compiled,
}

impl InterpretedMachine {
    /// The machine of a program, with its parameters and inputs at their defaults. A parameter without a default is NaN until
    /// it is [`set`](Self::set).
    pub fn new(program: Proved) -> InterpretedMachine {
        let program = program.into_program();
        let default = |slot: &Slot, otherwise: f64| {
            slot.default
                .as_ref()
                .map_or(otherwise, |default| default.value)
        };
        let names = Names {
            parameters: labels(&program.parameters),
            coordinates: labels(&program.coordinates),
            inputs: labels(&program.inputs),
            outputs: labels(&program.outputs),
        };
        let contact_parts = ContactParts::of(&program);
        InterpretedMachine {
            parameters: program
                .parameters
                .iter()
                .map(|slot| default(slot, f64::NAN))
                .collect(),
            inputs: program
                .inputs
                .iter()
                .map(|slot| default(slot, 0.0))
                .collect(),
            names: Arc::new(names),
            gap_arguments: contact_parts
                .as_ref()
                .map(|parts| parts.gap_arguments().into()),
            contact_parts: contact_parts.map(Arc::new),
            program: Arc::new(program),
            machine_code: engine::MachineCode::default(),
            code_of_parts: engine::MachineCode::default(),
            series: MotionSeries::none("its series was not derived"),
        }
    }

    /// This machine with the Taylor series of its motion, which [`TAYLOR`](crate::TAYLOR) needs, or with the reason
    /// why it has none.
    ///
    /// ```
    /// use lagrangian::interpreted::InterpretedMachine;
    /// use lagrangian::{Machine, Simulation, TAYLOR};
    /// use lagrangian_mechanics::{Compiled, series::ProvedSeries};
    /// use lagrangian_spec::{diagnostic::Report, source::{InMemory, Sources}};
    ///
    /// let text = "machine Swing in plane {
    ///     parameters { m: kg = 1, l: m = 1, g: m/s^2 = 9.81 }
    ///     coordinates { theta: rad = 0.5 }
    ///     bodies { bob { mass: m, at: l*(sin(theta), -cos(theta)) } }
    ///     gravity (0, -g);
    /// }";
    /// let (dag, mut sources, mut report) = (Default::default(), Sources::new(), Report::new());
    /// let files = &mut InMemory::new();
    /// let model = lagrangian_spec::model(&dag, "swing", text, &[], files, &mut sources, &mut report);
    /// let Some(swing) = model.and_then(|model| Compiled::new(model, &mut report)) else {
    ///     panic!("{}", report.render_short(&sources));
    /// };
    /// let machine = InterpretedMachine::new(swing.program.clone())
    ///     .with_series(ProvedSeries::derive(&swing.model));
    /// let run = Simulation::new(&machine).tolerance(1e-14).method(&TAYLOR).until(10.0);
    /// let run = run.run(machine.start())?;
    /// assert!(run.statistics().steps < 100); // dop853 takes 336
    /// # Ok::<(), lagrangian::Error>(())
    /// ```
    pub fn with_series(mut self, series: Result<ProvedSeries, NoSeries>) -> InterpretedMachine {
        self.series = MotionSeries::given(series);
        self
    }

    /// This machine with a function that derives the Taylor series of its motion: once for the machine, its clones and their runs, when the first of
    /// them needs it. Machines that are read by [`from_text`](Self::from_text) and [`from_file`](Self::from_file) have one.
    ///
    /// Runs by [`TAYLOR`](crate::TAYLOR) need the series from the start. A run that [chooses its method](crate::Simulation::automatic) begins without it,
    /// and asks for it after as many steps as take about as long as its derivation, if the rest of the run is longer still. When that is follows from counts of steps and
    /// operations, and not from whether another run has derived the series before.
    pub fn with_series_on_demand(
        mut self,
        derive: impl Fn() -> Result<ProvedSeries, NoSeries> + Send + Sync + 'static,
    ) -> InterpretedMachine {
        self.series = MotionSeries::on_demand(Box::new(derive));
        self
    }

    /// This machine with all contacts evaluated together, however far they are: what tests compare with.
    #[doc(hidden)]
    #[must_use]
    pub fn without_single_contacts(mut self) -> InterpretedMachine {
        (self.contact_parts, self.gap_arguments) = (None, None);
        self
    }

    /// Sets the engine that executes its functions, by default the interpreter. Systems that were prepared before keep theirs.
    ///
    /// # Errors
    /// If machine code is requested and is not available on this processor or in this build; then nothing is changed.
    pub fn set_engine(&mut self, engine: Engine) -> Result<(), NoMachineCode> {
        let machine_code = engine::MachineCode::new(engine, &self.program)?;
        if let Some(parts) = &self.contact_parts {
            self.code_of_parts =
                engine::MachineCode::new(engine, &Arc::new(parts.program.clone()))?;
        }
        self.machine_code = machine_code;
        Ok(())
    }

    /// Sets a parameter, or the default of an input. The name of a family sets all its members.
    ///
    /// # Errors
    /// If there is no such name.
    pub fn set(&mut self, name: &str, value: f64) -> Result<(), UnknownName> {
        let parameters = self.names.parameters.iter().zip(&mut self.parameters);
        let inputs = self.names.inputs.iter().zip(&mut self.inputs);
        let all = parameters.chain(inputs);
        assign(all, name, value)
    }

    /// The unit of the parameter or input with this name, or of the members of the family; `None` if there is none.
    pub fn unit(&self, name: &str) -> Option<&str> {
        unit(
            self.names.parameters.iter().chain(self.names.inputs.iter()),
            name,
        )
    }

    /// Whether [`run_interpreted_in_lanes`](crate::Simulation::run_interpreted_in_lanes) makes runs of this machine in lanes,
    /// with any parameters, by an explicit method or by Taylor series and with constant inputs: it does if the machine has machine code and no
    /// guides (`sliding`). With [`Engine::Auto`] it does so once code has paid off for one run.
    pub fn may_run_in_lanes(&self) -> bool {
        let by_series = || {
            let known = self.series.if_known();
            known.is_some_and(|known| known.code.pays_in_lanes(&self.machine_code))
        };
        self.program.contacts.is_empty() && (self.machine_code.pays_in_lanes() || by_series())
    }

    /// The program that is interpreted.
    pub fn program(&self) -> &Program {
        &self.program
    }

    /// The values of the parameters in SI units, in the order of the description.
    pub fn parameter_values(&self) -> &[f64] {
        &self.parameters
    }

    /// Whether every parameter has a value.
    ///
    /// # Errors
    /// The error holds the names of those that have none.
    pub fn check_parameters(&self) -> Result<(), MissingParameters> {
        let slots = self.program.parameters.iter().zip(&self.parameters);
        let missing = slots.filter(|(slot, value)| slot.default.is_none() && value.is_nan());
        let names: Vec<String> = missing.map(|(slot, _)| slot.name.to_string()).collect();
        if names.is_empty() {
            Ok(())
        } else {
            Err(MissingParameters { names })
        }
    }
}

impl Machine for InterpretedMachine {
    type System = InterpretedSystem;

    fn name(&self) -> &str {
        &self.program.name
    }

    fn parameters(&self) -> impl ExactSizeIterator<Item = (Quantity<'_>, f64)> {
        quantities(&self.names.parameters).zip(self.parameters.iter().copied())
    }

    fn parameter_mut(&mut self, index: usize) -> Option<&mut f64> {
        self.parameters.get_mut(index)
    }

    fn prepare(&self) -> InterpretedSystem {
        let interpreter = Interpreter::new(&self.program, &self.parameters);
        let contact_parts = self.contact_parts.as_ref().map(|parts| {
            let prepared = interpreter.prepared();
            let parts = RunningParts::new(parts.clone(), &self.code_of_parts, prepared);
            SharedWorkspace::new(parts)
        });
        let needs_ranges = !self.program.contacts.is_empty() || contact_parts.is_some();
        InterpretedSystem {
            program: self.program.clone(),
            names: self.names.clone(),
            inputs: self.inputs.clone(),
            contact_parts,
            gap_arguments: self.gap_arguments.clone(),
            running: SharedWorkspace::new(Running {
                compiled: self.machine_code.prepared(&interpreter),
                interpreter,
            }),
            parameters: if needs_ranges {
                self.parameters.clone()
            } else {
                Vec::new()
            },
            enclosing: SharedWorkspace::new(None),
            series: self.series.clone(),
            has_linear_assumptions: self.program.has_linear_assumptions(),
            has_state_energy: self.program.function(Role::StateEnergy).is_some(),
            has_powers: self.program.has_powers(),
            expanding: SharedWorkspace::new(Expanding::new(self.machine_code.clone())),
        }
    }

    fn start(&self) -> State<Named> {
        let n = self.program.dimension();
        let (mut q, mut v) = (vec![0.0; n], vec![0.0; n]);
        Interpreter::new(&self.program, &self.parameters).start(&mut q, &mut v);
        let named = |values| Named {
            labels: self.names.coordinates.clone(),
            values,
        };
        State {
            t: 0.0,
            q: named(q),
            v: named(v),
        }
    }
}

impl InterpretedSystem {
    /// Calls a function of the program; functions that the machine does not have return 0.
    fn call(
        &self,
        role: Role,
        arguments: Arguments<'_, f64>,
        results: &mut [f64],
    ) -> Result<(), Singular> {
        let mut running = self.running.lock();
        let called = running.call(role, arguments, results);
        called.map_err(|singular| singular_row(&self.program, singular))
    }

    /// Calls a function whose values exist at every state, so it cannot be singular.
    fn fill(&self, role: Role, arguments: Arguments<'_, f64>, results: &mut [f64]) {
        let _ = self.call(role, arguments, results);
    }

    /// The output with this index among those of [`outputs`](System::outputs), in SI units.
    /// `a` may be empty if the output does not depend on accelerations.
    pub fn output(&self, index: usize, t: f64, q: &[f64], v: &[f64], a: &[f64], u: &[f64]) -> f64 {
        self.number(Role::Output(index), Arguments { t, q, v, u, a })
    }

    /// The numbers of a quantity of the program ([`program`](Self::program)), with the bits of compiled machines.
    ///
    /// # Errors
    /// If the machine is singular and the quantity depends on accelerations.
    ///
    /// # Panics
    /// If an argument that the quantity depends on, or `results`, has another length than in the program.
    pub fn quantity(
        &self,
        role: Role,
        arguments: Arguments<'_, f64>,
        results: &mut [f64],
    ) -> Result<(), Singular> {
        self.call(role, arguments, results)
    }

    /// The program over intervals, with the rounding of the parameters.
    fn enclosing(&self) -> MutexGuard<'_, Option<Interpreter<Interval>>> {
        let mut enclosing = self.enclosing.lock();
        if enclosing.is_none() {
            let parameters = rounded_each(&self.parameters);
            *enclosing = Some(Interpreter::new(&self.program, &parameters));
        }
        enclosing
    }

    /// Calls a function that returns one number, whose value exists at every state.
    fn number(&self, role: Role, arguments: Arguments<'_, f64>) -> f64 {
        let mut result = [0.0];
        match self.call(role, arguments, &mut result) {
            Ok(()) => result[0],
            Err(_) => f64::NAN,
        }
    }
}

/// A number with its rounding.
fn rounded(x: f64) -> Interval {
    Interval::new(x.next_down(), x.next_up())
}

/// Numbers with their roundings.
fn rounded_each(numbers: &[f64]) -> Vec<Interval> {
    numbers.iter().map(|x| rounded(*x)).collect()
}

impl Running {
    fn call(
        &mut self,
        role: Role,
        arguments: Arguments<'_, f64>,
        results: &mut [f64],
    ) -> Result<(), program::Singular> {
        let Self {
            interpreter,
            compiled,
        } = self;
        if compiled.call(role, arguments, results) {
            return Ok(());
        }
        if role.is_fast() {
            // In the arithmetic of compiled machines, with the same bits.
            f64::run(Call {
                interpreter,
                role,
                arguments,
                results,
            })
        } else {
            interpreter.call(role, arguments, results)
        }
    }
}

/// The row at which elimination stopped; the program counts coordinates and constraints consecutively.
fn singular_row(program: &Program, singular: program::Singular) -> Singular {
    let program::Singular { coordinate, ratio } = singular;
    let at = match coordinate.checked_sub(program.dimension()) {
        None => Pivot::Coordinate(coordinate),
        Some(constraint) => Pivot::Constraint(constraint),
    };
    Singular { at, ratio }
}

/// A call of the interpreter, executed with the instructions that the processor supports.
struct Call<'a> {
    interpreter: &'a mut Interpreter<f64>,
    role: Role,
    arguments: Arguments<'a, f64>,
    results: &'a mut [f64],
}

impl Kernel<f64> for Call<'_> {
    type Output = Result<(), program::Singular>;

    #[inline(always)]
    fn run<N: Scalar<Stored = f64>>(self) -> Self::Output {
        self.interpreter
            .call_in::<N>(self.role, self.arguments, self.results)
    }
}

impl System for InterpretedSystem {
    type Vector = Vec<f64>;
    type Matrix = Vec<f64>;
    type Coordinates = Named;
    type Inputs = Named;
    type Outputs = Named;

    fn coordinates(&self) -> impl ExactSizeIterator<Item = Quantity<'_>> {
        quantities(&self.names.coordinates)
    }

    fn to_coordinates(&self, vector: &Vec<f64>) -> Named {
        Named {
            labels: self.names.coordinates.clone(),
            values: vector.clone(),
        }
    }

    fn copy_to_coordinates(&self, vector: &Vec<f64>, coordinates: &mut Named) {
        coordinates.values.clone_from(vector);
    }

    fn to_vector(&self, coordinates: &Named) -> Vec<f64> {
        coordinates.values.clone()
    }

    fn accelerations(
        &self,
        t: f64,
        q: &Vec<f64>,
        v: &Vec<f64>,
        u: &Named,
        a: &mut Vec<f64>,
    ) -> Result<(), Singular> {
        if !self.program.contacts.is_empty() {
            return accelerations_with_friction(self, t, q, v, u, a);
        }
        self.call(Role::Accelerations, at(t, q, v, &u.values), a)
    }

    fn has_linear_assumptions(&self) -> bool {
        self.has_linear_assumptions
    }

    fn check_series(&self) -> Result<(), &str> {
        if !self.program.unilateral.is_empty() {
            return Err("it has contacts that close and open");
        }
        match &self.series.known().series {
            Ok(_) => Ok(()),
            Err(reason) => Err(reason),
        }
    }

    fn series_cost(&self) -> Option<[f64; 2]> {
        self.series.cost(&self.program)
    }

    fn series_derivation(&self) -> Option<f64> {
        let may_have_one = self.program.contacts.is_empty()
            && self.program.unilateral.is_empty()
            && self.program.constraints.iter().all(|of| of.holonomic);
        let evaluations = || match may_have_one {
            true => motion_series::derivation(&self.program),
            false => f64::INFINITY,
        };
        self.series.is_on_demand().then(evaluations)
    }

    fn series(
        &self,
        t: [f64; 2],
        q: &Vec<f64>,
        v: &Vec<f64>,
        u: &Named,
        coefficients: &mut [Vec<f64>],
    ) -> Result<(), Singular> {
        let parameters = || self.running.lock().interpreter.parameters().to_vec();
        let mut expanding = self.expanding.lock();
        let at = (t, [q.as_slice(), v.as_slice(), u.values.as_slice()]);
        let expanded = expanding.expand((self.series.known(), parameters), at, coefficients);
        expanded.map_err(|singular| singular_row(&self.program, singular))
    }

    fn mass_matrix(&self, t: f64, q: &Vec<f64>, matrix: &mut Vec<f64>) {
        let n = q.len();
        let mut lower = vec![0.0; Shape::Symmetric(n).len()];
        self.fill(Role::MassMatrix, at(t, q, &[], &[]), &mut lower);
        let mut entries = lower.iter();
        for i in 0..n {
            for (j, entry) in (0..=i).zip(&mut entries) {
                for place in [i * n + j, j * n + i] {
                    if let Some(place) = matrix.get_mut(place) {
                        *place = *entry;
                    }
                }
            }
        }
    }

    fn bias(&self, t: f64, q: &Vec<f64>, v: &Vec<f64>, bias: &mut Vec<f64>) {
        self.fill(Role::Bias, at(t, q, v, &[]), bias);
    }

    fn applied(&self, t: f64, q: &Vec<f64>, v: &Vec<f64>, u: &Named, applied: &mut Vec<f64>) {
        self.fill(Role::Applied, at(t, q, v, &u.values), applied);
    }

    fn forces(&self, t: f64, q: &Vec<f64>, v: &Vec<f64>, u: &Named, forces: &mut Vec<f64>) {
        self.fill(Role::Forces, at(t, q, v, &u.values), forces);
    }

    fn kinetic_energy(&self, t: f64, q: &Vec<f64>, v: &Vec<f64>) -> f64 {
        self.number(Role::KineticEnergy, at(t, q, v, &[]))
    }

    fn potential_energy(&self, t: f64, q: &Vec<f64>, u: &Named) -> f64 {
        self.number(Role::PotentialEnergy, at(t, q, &[], &u.values))
    }

    fn state_energy(&self, t: f64, q: &Vec<f64>, v: &Vec<f64>) -> f64 {
        if !self.has_state_energy {
            return 0.0;
        }
        self.number(Role::StateEnergy, at(t, q, v, &[]))
    }

    fn dissipation(&self, t: f64, q: &Vec<f64>, v: &Vec<f64>, u: &Named) -> f64 {
        self.number(Role::Dissipation, at(t, q, v, &u.values))
    }

    fn work_rate(&self, t: f64, q: &Vec<f64>, v: &Vec<f64>, a: &Vec<f64>, u: &Named) -> f64 {
        if !self.has_powers[0] {
            return 0.0;
        }
        let u = &u.values;
        self.number(Role::WorkRate, Arguments { t, q, v, u, a })
    }

    fn dissipation_rate(&self, t: f64, q: &Vec<f64>, v: &Vec<f64>, u: &Named) -> f64 {
        if !self.has_powers[1] {
            return 0.0;
        }
        self.number(Role::DissipationRate, at(t, q, v, &u.values))
    }

    fn has_powers(&self) -> bool {
        self.has_powers != [false; 2]
    }

    fn default_inputs(&self) -> Named {
        Named {
            labels: self.names.inputs.clone(),
            values: self.inputs.clone(),
        }
    }

    fn input_values(&self, inputs: &Named) -> impl ExactSizeIterator<Item = (Quantity<'_>, f64)> {
        let values: Vec<f64> = inputs.values.clone();
        quantities(&self.names.inputs).zip(values)
    }

    fn outputs(&self, t: f64, q: &Vec<f64>, v: &Vec<f64>, a: &Vec<f64>, u: &Named) -> Named {
        let arguments = Arguments {
            t,
            q,
            v,
            u: &u.values,
            a,
        };
        let roles = (0..self.program.outputs.len()).map(Role::Output);
        let values = roles.map(|role| self.number(role, arguments)).collect();
        Named {
            labels: self.names.outputs.clone(),
            values,
        }
    }

    fn output_values(&self, outputs: &Named) -> impl ExactSizeIterator<Item = (Quantity<'_>, f64)> {
        let values: Vec<f64> = outputs.values.clone();
        quantities(&self.names.outputs).zip(values)
    }

    fn assumptions(
        &self,
        t: f64,
        q: &Vec<f64>,
        v: &Vec<f64>,
        u: &Named,
    ) -> impl ExactSizeIterator<Item = Assumption<'_>> {
        let arguments = at(t, q, v, &u.values);
        let margins: Vec<f64> = (0..self.program.assumptions.len())
            .map(|index| self.number(Role::Assumption(index), arguments))
            .collect();
        let facts = self.program.assumptions.iter().zip(margins);
        facts.map(|(fact, margin)| Assumption {
            text: &fact.text,
            margin,
            strict: fact.strict,
        })
    }

    fn constraints(&self) -> impl ExactSizeIterator<Item = Constraint<'_>> {
        let constraints = self.program.constraints.iter();
        constraints.map(|constraint| Constraint {
            name: &constraint.name,
            unit: &constraint.unit,
            multiplier_unit: &constraint.multiplier_unit,
            holonomic: constraint.holonomic,
        })
    }

    fn constraint_positions(&self, t: f64, q: &Vec<f64>, residuals: &mut [f64]) {
        self.fill(Role::ConstraintPositions, at(t, q, &[], &[]), residuals);
    }

    fn constraint_rates(&self, t: f64, q: &Vec<f64>, v: &Vec<f64>, residuals: &mut [f64]) {
        self.fill(Role::ConstraintRates, at(t, q, v, &[]), residuals);
    }

    fn constraint_matrix(&self, t: f64, q: &Vec<f64>, matrix: &mut [f64]) {
        self.fill(Role::ConstraintMatrix, at(t, q, &[], &[]), matrix);
    }

    fn constraint_bias(&self, t: f64, q: &Vec<f64>, v: &Vec<f64>, bias: &mut [f64]) {
        self.fill(Role::ConstraintBias, at(t, q, v, &[]), bias);
    }

    fn multipliers(
        &self,
        t: f64,
        q: &Vec<f64>,
        v: &Vec<f64>,
        u: &Named,
        multipliers: &mut [f64],
    ) -> Result<(), Singular> {
        let arguments = at(t, q, v, &u.values);
        match (&*self.program.constraints, &*self.program.contacts) {
            ([], _) => Ok(()),
            (_, []) => self.call(Role::Multipliers, arguments, multipliers),
            _ => multipliers_with_friction(self, t, q, v, u, multipliers),
        }
    }

    fn contacts(&self) -> impl ExactSizeIterator<Item = &str> {
        self.program.contacts.iter().map(String::as_str)
    }

    fn reaction_axes(&self) -> usize {
        self.program.reaction_axes
    }

    fn second_tangents(&self) -> u64 {
        self.program.second_tangents
    }

    fn unilateral_contacts(&self) -> impl ExactSizeIterator<Item = UnilateralContact<'_>> {
        self.program
            .unilateral
            .iter()
            .map(|contact| UnilateralContact {
                name: &contact.name,
                law: match contact.law {
                    model::ImpactLaw::Newton => ImpactLaw::Newton,
                    model::ImpactLaw::Poisson => ImpactLaw::Poisson,
                    model::ImpactLaw::PoissonGlocker => ImpactLaw::PoissonGlocker,
                    model::ImpactLaw::Stronge => ImpactLaw::Stronge,
                },
                order: match contact.order {
                    model::ImpactOrder::AtOnce => ImpactOrder::AtOnce,
                    model::ImpactOrder::Sequence => ImpactOrder::Sequence,
                },
                painleve: match contact.painleve {
                    model::Painleve::Error => Painleve::Error,
                    model::Painleve::Impact => Painleve::Impact,
                },
                compliance: contact.compliance.map(|law| match law {
                    model::Compliance::Linear => Compliance::Linear,
                    model::Compliance::Hertz => Compliance::Hertz,
                    model::Compliance::HuntCrossley => Compliance::HuntCrossley,
                    model::Compliance::Layer => Compliance::Layer,
                }),
                has_friction: contact.has_friction,
                is_rolling_resistance: contact.is_rolling_resistance,
                is_second_tangent: contact.is_second_tangent,
                has_face: contact.has_face,
            })
    }

    fn gaps(&self, t: f64, q: &Vec<f64>, gaps: &mut [f64]) {
        self.fill(Role::Gaps, at(t, q, &[], &[]), gaps);
    }

    fn contact_faces(&self, t: f64, q: &Vec<f64>, v: &Vec<f64>, faces: &mut [f64]) {
        self.fill(Role::ContactFaces, at(t, q, v, &[]), faces);
    }

    fn contact_rates(&self, t: f64, q: &Vec<f64>, v: &Vec<f64>, rates: &mut [f64]) {
        self.fill(Role::ContactRates, at(t, q, v, &[]), rates);
    }

    fn contact_matrix(&self, t: f64, q: &Vec<f64>, matrix: &mut [f64]) {
        self.fill(Role::ContactMatrix, at(t, q, &[], &[]), matrix);
    }

    fn contact_bias(&self, t: f64, q: &Vec<f64>, v: &Vec<f64>, bias: &mut [f64]) {
        self.fill(Role::ContactBias, at(t, q, v, &[]), bias);
    }

    fn contact_coefficients(&self, t: f64, q: &Vec<f64>, v: &Vec<f64>, coefficients: &mut [f64]) {
        self.fill(Role::ContactCoefficients, at(t, q, v, &[]), coefficients);
    }

    fn single_contacts(&self) -> Option<&[bool]> {
        self.gap_arguments.as_deref()
    }

    fn of_contacts(
        &self,
        quantity: ContactQuantity,
        which: &[usize],
        (t, q, v): (f64, &Vec<f64>, &Vec<f64>),
        numbers: &mut [f64],
    ) {
        if let Some(parts) = &self.contact_parts {
            parts.lock().write(quantity, which, (t, q, v), numbers);
        }
    }

    fn least_gaps(&self, t: [f64; 2], q: [&Vec<f64>; 2], least: &mut [f64]) {
        if self.contact_parts.is_none() {
            return least.fill(f64::NEG_INFINITY);
        }
        let [low, high] = q;
        let q: Vec<Interval> = (low.iter().zip(high))
            .map(|(low, high)| Interval::new(*low, *high))
            .collect();
        let mut gaps = vec![Interval::UNKNOWN; least.len()];
        let arguments = Arguments {
            t: Interval::new(t[0], t[1]),
            q: &q,
            v: &[],
            u: &[],
            a: &[],
        };
        // Gaps do not divide by a pivot.
        let _ = self
            .enclosing()
            .as_mut()
            .map(|enclosing| enclosing.call(Role::Gaps, arguments, &mut gaps));
        for (least, gap) in least.iter_mut().zip(gaps) {
            *least = gap.lo();
        }
    }

    fn kept_at_start(&self) -> impl ExactSizeIterator<Item = &str> {
        self.program.kept.iter().map(String::as_str)
    }

    fn slips(&self, t: f64, q: &Vec<f64>, v: &Vec<f64>, slips: &mut [f64]) {
        self.fill(Role::Slips, at(t, q, v, &[]), slips);
    }

    fn slip_ranges(&self, t: f64, q: &Vec<f64>, v: &Vec<f64>, ranges: &mut [[f64; 2]]) {
        let mut slips = vec![Interval::UNKNOWN; ranges.len()];
        let arguments = Arguments {
            t: rounded(t),
            q: &rounded_each(q),
            v: &rounded_each(v),
            u: &[],
            a: &[],
        };
        // Slips do not divide by a pivot.
        let _ = self
            .enclosing()
            .as_mut()
            .map(|enclosing| enclosing.call(Role::Slips, arguments, &mut slips));
        for (range, slip) in ranges.iter_mut().zip(slips) {
            *range = [slip.lo(), slip.hi()];
        }
    }

    fn slip_matrix(&self, t: f64, q: &Vec<f64>, matrix: &mut [f64]) {
        self.fill(Role::SlipMatrix, at(t, q, &[], &[]), matrix);
    }

    fn slip_bias(&self, t: f64, q: &Vec<f64>, v: &Vec<f64>, bias: &mut [f64]) {
        self.fill(Role::SlipBias, at(t, q, v, &[]), bias);
    }

    fn friction(
        &self,
        t: f64,
        q: &Vec<f64>,
        v: &Vec<f64>,
        u: &Named,
        parts: &mut [f64],
    ) -> Result<(), Singular> {
        self.call(Role::Friction, at(t, q, v, &u.values), parts)
    }
}

impl Linearize for InterpretedSystem {
    fn linearize(
        &self,
        t: f64,
        q: &Vec<f64>,
        v: &Vec<f64>,
        u: &Named,
        a: &mut Vec<f64>,
        by_coordinates: &mut Vec<f64>,
        by_rates: &mut Vec<f64>,
    ) -> Result<(), Singular> {
        let n = q.len();
        if !self.program.contacts.is_empty() || !self.program.unilateral.is_empty() {
            // Sticking contacts have no linearization, and the law of sliding ones is not differentiated.
            return Err(Singular {
                at: Pivot::NotDifferentiated(0),
                ratio: 0.0,
            });
        }
        let u = &u.values;
        if !self.program.has_linearization() {
            return self.linearize_by_duals(t, [q, v, u], a, by_coordinates, by_rates);
        }
        let width = 1 + self.program.derivatives.len();
        let mut rows = vec![0.0; n * width];
        let arguments = Arguments { t, q, v, u, a: &[] };
        self.call(Role::Derivatives, arguments, &mut rows)?;
        for (i, row) in rows.chunks_exact(width).enumerate() {
            a[i] = row[0];
            by_coordinates[i * n..][..n].copy_from_slice(&row[1..][..n]);
            by_rates[i * n..][..n].copy_from_slice(&row[1 + n..][..n]);
        }
        Ok(())
    }
}

impl Staged for InterpretedSystem {
    type AtTime = Stage;
    type AtPosition = Stage;

    fn at_time(&self, t: f64) -> Stage {
        let mut stage = Stage {
            values: vec![t],
            q: Vec::new(),
        };
        if self.program.stages.time {
            stage.values = self.values_of(Role::AtTime);
            // Values that depend on time alone cannot be singular.
            let _ = self.call(Role::AtTime, at(t, &[], &[], &[]), &mut stage.values);
        }
        stage
    }

    fn at_position(&self, before: &Stage, q: &Vec<f64>) -> Result<Stage, Singular> {
        if !self.program.stages.coordinates {
            let (values, q) = (before.values.clone(), q.clone());
            return Ok(Stage { values, q });
        }
        let mut values = self.values_of(Role::AtPosition);
        let stage = (Role::AtTime, before.values.as_slice());
        self.call_after(stage, (Role::AtPosition, [q, &[], &[]]), &mut values)?;
        let q = Vec::new();
        Ok(Stage { values, q })
    }

    fn accelerations_at(
        &self,
        Stage { values, q }: &Stage,
        v: &Vec<f64>,
        u: &Named,
        a: &mut Vec<f64>,
    ) -> Result<(), Singular> {
        if !self.program.contacts.is_empty() {
            return accelerations_with_friction(self, values[0], q, v, u, a);
        }
        let role = if self.program.stages.is_empty() {
            Role::Accelerations
        } else {
            Role::AccelerationsAt
        };
        let before = if self.program.stages.coordinates {
            Role::AtPosition
        } else {
            Role::AtTime
        };
        self.call_after((before, values), (role, [q, v, &u.values]), a)
    }
}

/// The results of one stage of the accelerations of an [`InterpretedSystem`] that the next one needs.
#[derive(Clone, Debug)]
pub struct Stage {
    /// The results of the stage, or the time if there is no such stage.
    values: Vec<f64>,
    /// The coordinates if they are not a stage.
    q: Vec<f64>,
}

impl InterpretedSystem {
    /// Zeros, one for each value that a stage computes for later ones.
    fn values_of(&self, role: Role) -> Vec<f64> {
        let function = self.program.function(role);
        vec![0.0; function.map_or(0, |function| function.results.len())]
    }

    /// Calls a function with the results of a stage, or with the time if that is not a stage. Both happen under one lock,
    /// because otherwise another thread could set its own results in between.
    fn call_after(
        &self,
        (stage, left): (Role, &[f64]),
        (role, [q, v, u]): (Role, [&[f64]; 3]),
        results: &mut [f64],
    ) -> Result<(), Singular> {
        let mut running = self.running.lock();
        let t = if stage == Role::AtTime && !self.program.stages.time {
            left[0]
        } else {
            running.interpreter.set_stage_results(stage, left);
            running.compiled.set_stage_results(stage, left);
            f64::NAN // the time is not used
        };
        let called = running.call(role, at(t, q, v, u), results);
        called.map_err(|singular| singular_row(&self.program, singular))
    }
}

/// The arguments of a call without accelerations.
fn at<'a>(t: f64, q: &'a [f64], v: &'a [f64], u: &'a [f64]) -> Arguments<'a, f64> {
    Arguments { t, q, v, u, a: &[] }
}

impl Differentiate for InterpretedSystem {
    fn variables(&self) -> impl ExactSizeIterator<Item = Quantity<'_>> {
        let own = if self.program.has_linearization() {
            &self.program.derivatives[2 * self.program.dimension()..]
        } else {
            &[]
        };
        own.iter().map(|variable| {
            let Label { name, unit } = match variable {
                Variable::Coordinate(i) | Variable::Rate(i) => &self.names.coordinates[*i],
                Variable::Input(i) => &self.names.inputs[*i],
                Variable::Parameter(i) => &self.names.parameters[*i],
            };
            Quantity { name, unit }
        })
    }

    fn differentiate(
        &self,
        t: f64,
        q: &Vec<f64>,
        v: &Vec<f64>,
        u: &Named,
        a: &mut Vec<f64>,
        by_coordinates: &mut Vec<f64>,
        by_rates: &mut Vec<f64>,
        by_variables: &mut [f64],
    ) -> Result<(), Singular> {
        let n = q.len();
        if !self.program.has_linearization() {
            return self.linearize(t, q, v, u, a, by_coordinates, by_rates);
        }
        let others = self.program.derivatives.len() - 2 * n;
        let width = 1 + 2 * n + others;
        let mut rows = vec![0.0; n * width];
        let u = &u.values;
        let arguments = Arguments { t, q, v, u, a: &[] };
        self.call(Role::Derivatives, arguments, &mut rows)?;
        for (i, row) in rows.chunks_exact(width).enumerate() {
            a[i] = row[0];
            by_coordinates[i * n..][..n].copy_from_slice(&row[1..][..n]);
            by_rates[i * n..][..n].copy_from_slice(&row[1 + n..][..n]);
            let places = by_variables.iter_mut().skip(i * others);
            for (to, from) in places.zip(&row[1 + 2 * n..]) {
                *to = *from;
            }
        }
        Ok(())
    }
}

impl InterpretedSystem {
    /// The derivatives if the description does not request any: the accelerations over dual numbers, evaluated once for each
    /// coordinate and each rate.
    fn linearize_by_duals(
        &self,
        t: f64,
        state: [&[f64]; 3],
        a: &mut [f64],
        by_coordinates: &mut [f64],
        by_rates: &mut [f64],
    ) -> Result<(), Singular> {
        let duals = |values: &[f64]| -> Vec<Dual<f64>> {
            values.iter().copied().map(Dual::constant).collect()
        };
        let parameters = duals(self.running.lock().interpreter.parameters());
        let mut interpreter = Interpreter::new(&self.program, &parameters);
        let [mut q, mut v, u] = state.map(duals);
        let n = q.len();
        let mut row = vec![Dual::constant(0.0); n];
        for j in 0..2 * n {
            let is_rate = j >= n;
            let variable = if is_rate { &mut v[j - n] } else { &mut q[j] };
            variable.derivative = 1.0;
            let arguments = Arguments {
                t: Dual::constant(t),
                q: &q,
                v: &v,
                u: &u,
                a: &[],
            };
            interpreter
                .call(Role::Accelerations, arguments, &mut row)
                .map_err(|singular| singular_row(&self.program, singular))?;
            let to = if is_rate {
                &mut *by_rates
            } else {
                &mut *by_coordinates
            };
            for (i, dual) in row.iter().enumerate() {
                a[i] = dual.value;
                to[i * n + j % n] = dual.derivative;
            }
            let variable = if is_rate { &mut v[j - n] } else { &mut q[j] };
            variable.derivative = 0.0;
        }
        Ok(())
    }
}

impl Named {
    /// The number of this name.
    pub fn get(&self, name: &str) -> Option<f64> {
        let name = &*normalized(name);
        let place = self.labels.iter().position(|label| label.name == name)?;
        self.values.get(place).copied()
    }

    /// Sets the number of this name; the name of a family sets all its members.
    ///
    /// # Errors
    /// If there is no such name.
    pub fn set(&mut self, name: &str, value: f64) -> Result<(), UnknownName> {
        assign(self.labels.iter().zip(&mut self.values), name, value)
    }

    /// The unit of the number with this name, or of the members of the family; `None` if there is none.
    pub fn unit(&self, name: &str) -> Option<&str> {
        unit(self.labels.iter(), name)
    }

    /// The names with their numbers, in the order of the description.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = (&str, f64)> {
        let names = self.labels.iter().map(|label| label.name.as_str());
        names.zip(self.values.iter().copied())
    }
}

/// Serializes as a map from names to numbers.
#[cfg(feature = "serde")]
impl serde::Serialize for Named {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.iter())
    }
}

/// Serializes as a map from the names of the parameters to their values.
#[cfg(feature = "serde")]
impl serde::Serialize for InterpretedMachine {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.parameters().map(|(of, value)| (of.name, value)))
    }
}

impl fmt::Debug for Named {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_map().entries(self.iter()).finish()
    }
}

/// Sets the number called `name`, or the members of the family called `name`.
fn assign<'a>(
    numbers: impl Iterator<Item = (&'a Label, &'a mut f64)>,
    name: &str,
    value: f64,
) -> Result<(), UnknownName> {
    let mut known = Vec::new();
    let mut found = false;
    let name = &*normalized(name);
    for (label, number) in numbers {
        if label.is_meant_by(name) {
            *number = value;
            found = true;
        } else {
            known.push(label.name.clone());
        }
    }
    if found {
        Ok(())
    } else {
        Err(UnknownName::new(name, known.iter().map(String::as_str)))
    }
}

/// The unit of the first number that a name refers to.
fn unit<'a>(mut labels: impl Iterator<Item = &'a Label>, name: &str) -> Option<&'a str> {
    let name = &*normalized(name);
    let label = labels.find(|label| label.is_meant_by(name));
    label.map(|label| label.unit.as_str())
}

impl Label {
    /// Whether a name, in the normal form of specs, is this label or the family that it belongs to.
    fn is_meant_by(&self, name: &str) -> bool {
        let family = self.name.split_once('[').map(|(base, _)| base);
        self.name == name || family == Some(name)
    }
}

fn labels(slots: &[Slot]) -> Arc<[Label]> {
    slots
        .iter()
        .map(|slot| Label {
            name: slot.name.to_string(),
            unit: slot.label(),
        })
        .collect()
}

fn quantities(labels: &[Label]) -> impl ExactSizeIterator<Item = Quantity<'_>> {
    labels.iter().map(|label| Quantity {
        name: &label.name,
        unit: &label.unit,
    })
}
