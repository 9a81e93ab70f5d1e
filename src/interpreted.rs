//! Machines that are read from a spec at run time, without a Rust compiler.
//!
//! Interpreted machines are slower than emitted code by a factor of about ten, and otherwise the same: they execute the same
//! operations in the same order. With the feature `jit` an [`Engine`] compiles frequently called functions to machine code,
//! which is as fast as emitted code.

use std::boxed::Box;
use std::string::{String, ToString};
use std::sync::Arc;
use std::vec;
use std::vec::Vec;

use lagrangian_mechanics::Proved;
use lagrangian_mechanics::series::{ProvedContactSeries, ProvedSeries};
use lagrangian_program::contact_parts::ContactParts;
use lagrangian_program::series::NoSeries;
use lagrangian_program::{Interpreter, Program, Role, Slot};

mod closed_series;
mod contact_parts;
mod derivatives;
mod enclosure;
mod engine;
mod expanding;
#[cfg(feature = "jit")]
mod in_lanes;
mod in_numbers;
mod in_series;
mod motion_series;
mod named;
mod precise;
mod reading;
mod recording;
mod running;
mod runs;
mod signals;
mod staged;
mod system;
mod table_file;

use closed_series::ClosedSeries;
use motion_series::MotionSeries;
use named::{Names, assign, quantities, unit};

use crate::settings::TaskWithStart;
use crate::{Machine, Quantity, State};

pub use crate::error::{Diagnostic, MissingParameters, NoMachineCode, NoNumbers, Note};
pub use crate::names::UnknownName;
pub use enclosure::{Enclosure, NotEnclosed};
pub use engine::Engine;
pub use in_numbers::InterpretedSystemIn;
pub use in_series::SeriesStepper;
pub use named::Named;
pub use precise::{PreciseEnd, PreciseRun};
pub use reading::Reading;
pub use recording::{Column, ColumnKind, Recording};
pub use signals::{Signal, SignalError, SignalFunction, Signals};
pub use staged::Stage;
pub use system::InterpretedSystem;
pub use table_file::{TableFile, TableFileError};

/// A machine whose equations are interpreted, with the values of its parameters.
#[derive(Clone, Debug)]
pub struct InterpretedMachine {
    program: Arc<Program>,
    names: Arc<Names>,
    parameters: Vec<f64>,
    inputs: Vec<f64>,
    series: MotionSeries,
    closed_series: ClosedSeries,
    machine_code: engine::MachineCode,
    /// The numbers of single contacts, where there are many, and their machine code.
    contact_parts: Option<Arc<ContactParts>>,
    gap_arguments: Option<Arc<[bool]>>,
    /// The quantities of one number that are 0 at every state.
    zeros: Arc<[Role]>,
    code_of_parts: engine::MachineCode,
}

/// The settings and the start of a run.
type RunTask<'a, 'l> = TaskWithStart<'a, 'l, InterpretedMachine>;

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
            names: Arc::new(Names::of(&program)),
            gap_arguments: contact_parts
                .as_ref()
                .map(|parts| parts.gap_arguments().into()),
            contact_parts: contact_parts.map(Arc::new),
            zeros: system::zeros(&program),
            program: Arc::new(program),
            machine_code: engine::MachineCode::default(),
            code_of_parts: engine::MachineCode::default(),
            series: MotionSeries::none("its series was not derived"),
            closed_series: ClosedSeries::default(),
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

    /// This machine with a function that derives the series of its motion while unilateral contacts are closed: once for the machine, its clones and their
    /// runs, when a contact closes in a run by [`TAYLOR`](crate::TAYLOR). Without it such a run goes by another method while one is closed.
    pub fn with_contact_series_on_demand(
        mut self,
        derive: impl Fn() -> Result<ProvedContactSeries, NoSeries> + Send + Sync + 'static,
    ) -> InterpretedMachine {
        self.closed_series = ClosedSeries::on_demand(Box::new(derive));
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
        InterpretedSystem::of(self)
    }

    fn start(&self) -> State<Named> {
        let n = self.program.dimension();
        let (mut q, mut v) = (vec![0.0; n], vec![0.0; n]);
        Interpreter::new(&self.program, &self.parameters).start(&mut q, &mut v);
        let named = |values| Named::new(&self.names.coordinates, values);
        State {
            t: 0.0,
            q: named(q),
            v: named(v),
        }
    }
}

/// Serializes as a map from the names of the parameters to their values.
#[cfg(feature = "serde")]
impl serde::Serialize for InterpretedMachine {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.parameters().map(|(of, value)| (of.name, value)))
    }
}
