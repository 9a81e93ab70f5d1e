//! From text to a program, which is shared by all machines with the same text.

use std::collections::VecDeque;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};
use std::thread;

use lagrangian::interpreted::InterpretedMachine;
use lagrangian_jit::Library;
use lagrangian_mechanics::Compiled;
use lagrangian_program::Slot;
use lagrangian_spec::diagnostic::{Report, Severity};
use lagrangian_spec::model::Model;
use lagrangian_spec::resolve::Formula;
use lagrangian_spec::source::{Disk, Files, Sources};
use lagrangian_sweep::charts::ChartedPoints;
use lagrangian_sweep::plan::{FileRecorder, RecordedFiles, SpecText};
use lagrangian_symbolic::Dag;
use pyo3::exceptions::{PyOSError, PyRuntimeError, PyValueError};
use pyo3::prelude::*;

use crate::errors::{self, Told};

/// The stack size of the thread that derives, which is that of the command.
pub const STACK: usize = 64 << 20;

/// The size of the cache of programs.
const REMEMBERED: usize = 64;

/// A formula besides those of the spec: its name, its name in messages, its text and its unit.
pub type Asked = (String, String, String, Option<String>);

/// A quantity: name, unit, documentation.
type Described = (String, String, String);

/// A derived spec.
pub struct Derived {
    pub text: SpecText,
    pub formulas: Vec<Asked>,
    pub machine: InterpretedMachine,
    pub docs: String,
    pub parameters: Vec<(String, String, String, Option<f64>)>,
    pub inputs: Vec<(String, String, String, f64)>,
    /// Parameters that follow from others.
    pub derived_parameters: Vec<Described>,
    pub coordinates: Vec<Described>,
    pub outputs: Vec<Described>,
    /// The names of constraints with the units of their multipliers.
    pub constraints: Vec<(String, String)>,
    pub contacts: Vec<String>,
    /// The documentation of named elements, including constraints and contacts.
    pub elements: Vec<(String, String)>,
    pub warnings: Vec<Told>,
    /// For each formula the index of its output.
    pub numbers: Vec<usize>,
    /// For each fact that the spec assumes its text and its place in the spec: `swing.machine:7:14`.
    pub assumptions: Vec<(String, String)>,
    /// Whether the spec names Cartesian coordinates for polar ones.
    has_charts: bool,
    cartesian: OnceLock<Option<Cartesian>>,
    library: OnceLock<Option<Arc<Library>>>,
}

/// A machine in the Cartesian coordinates that its spec names.
pub struct Cartesian {
    pub machine: InterpretedMachine,
    /// The points that are given in two charts.
    pub points: ChartedPoints,
}

/// Why there is no program.
pub enum Trouble {
    /// The spec has errors: as text, and one by one.
    Spec(String, Vec<Told>),
    /// A constant is not a number.
    Constant(String),
    /// An error of the operating system.
    System(String),
}

impl Trouble {
    pub fn raise(self, py: Python<'_>) -> PyErr {
        match self {
            Trouble::Spec(text, told) => errors::of_spec(py, text, told),
            Trouble::Constant(message) => PyValueError::new_err(message),
            Trouble::System(message) => PyRuntimeError::new_err(message),
        }
    }
}

/// The source of the texts that a spec extends.
pub enum Bases {
    /// These texts, by the names that the spec uses.
    Given(Vec<(String, String)>),
    /// Files on disk.
    Disk,
    /// The recorded texts of a spec that was read before.
    Kept,
}

struct Given(Vec<(String, String)>);

impl Files for Given {
    fn read(&mut self, path: &str, _: Option<&str>) -> Result<(String, String), String> {
        let found = self.0.iter().find(|(name, _)| name == path);
        let found = found.ok_or_else(|| "it is not among `files`".to_owned())?;
        Ok(found.clone())
    }
}

/// The cache of derived programs, the most recently used last.
static KNOWN: Mutex<VecDeque<(String, Arc<Derived>)>> = Mutex::new(VecDeque::new());

fn known(key: &str) -> Option<Arc<Derived>> {
    let mut known = KNOWN.lock().unwrap_or_else(PoisonError::into_inner);
    let place = known.iter().position(|(of, _)| of == key)?;
    let found = known.remove(place)?;
    let derived = found.1.clone();
    known.push_back(found);
    Some(derived)
}

fn remember(key: String, derived: &Arc<Derived>) {
    let mut known = KNOWN.lock().unwrap_or_else(PoisonError::into_inner);
    if known.len() == REMEMBERED {
        known.pop_front();
    }
    known.push_back((key, derived.clone()));
}

impl Derived {
    /// Reads a text, and derives its program unless it is in the cache.
    pub fn new(
        mut text: SpecText,
        bases: Bases,
        formulas: Vec<Asked>,
    ) -> Result<Arc<Derived>, Trouble> {
        let work = move || {
            let constants = text.constants().map_err(Trouble::Constant)?;
            let (dag, mut sources, mut report) = (Dag::new(), Sources::new(), Report::new());
            let asked: Vec<Formula<'_>> = formulas.iter().map(to_formula).collect();
            let kept = std::mem::take(&mut text.files);
            let mut disk = Disk;
            let mut given;
            let mut read;
            let files: &mut dyn Files = match bases {
                Bases::Disk => &mut disk,
                Bases::Given(files) => {
                    given = Given(files);
                    &mut given
                }
                Bases::Kept => {
                    read = RecordedFiles(&kept);
                    &mut read
                }
            };
            let mut recorded = FileRecorder::new(files);
            let spec = lagrangian_spec::parse(&mut sources, &text.name, &text.text, &mut report);
            let spec = spec.with_given(text.given.iter().cloned());
            let model = Model::resolve_with(
                spec,
                &dag,
                &constants,
                &asked,
                &mut recorded,
                &mut sources,
                &mut report,
            );
            text.files = recorded.read;
            let key = serde_json::to_string(&(&text, &formulas)).unwrap_or_default();
            if model.is_some()
                && let Some(derived) = known(&key)
            {
                return Ok(derived);
            }
            let compiled = model.and_then(|model| Compiled::for_runs(model, &mut report));
            let diagnostics = errors::as_values(&report, &sources);
            let Some(compiled) = compiled else {
                return Err(Trouble::Spec(
                    errors::as_text(&report, &sources),
                    diagnostics,
                ));
            };
            let mut derived = Derived::of(&compiled, text, formulas, diagnostics);
            let stated = compiled.model.assumptions.iter();
            derived.assumptions = stated
                .map(|stated| {
                    let (line, column) = sources.line_column(stated.span);
                    let file = sources.name(stated.span.source);
                    (stated.text.clone(), format!("{file}:{line}:{column}"))
                })
                .collect();
            let derived = Arc::new(derived);
            remember(key, &derived);
            Ok(derived)
        };
        let made = thread::Builder::new().stack_size(STACK).spawn(work);
        match made.map(thread::JoinHandle::join) {
            Ok(Ok(derived)) => derived,
            Ok(Err(panic)) => std::panic::resume_unwind(panic),
            Err(error) => Err(Trouble::System(format!(
                "cannot start a thread for the derivation: {error}"
            ))),
        }
    }

    fn of(
        compiled: &Compiled<'_>,
        text: SpecText,
        formulas: Vec<Asked>,
        told: Vec<Told>,
    ) -> Derived {
        let model = &compiled.model;
        let program = &compiled.program;
        let own = program.outputs.len() - formulas.len();
        let default = |slot: &Slot| slot.default.as_ref().map(|default| default.value);
        let plain = |slot: &Slot| (slot.name.to_string(), slot.label(), slot.docs.clone());
        let with = |slot: &Slot| {
            let (name, unit, docs) = plain(slot);
            (name, unit, docs, default(slot))
        };
        let mut machine = InterpretedMachine::new(program.clone());
        // Its constants were numbers when the model was made.
        if let Ok(text) = text.of_series(false) {
            machine = machine.with_series_on_demand(move || text.derive());
        }
        let system = lagrangian::Machine::prepare(&machine);
        let constraints = lagrangian::System::constraints(&system);
        let constraints = constraints.map(|c| (c.name.to_owned(), c.multiplier_unit.to_owned()));
        let contacts = lagrangian::System::contacts(&system).map(str::to_owned);
        let unilateral = lagrangian::System::unilateral_contacts(&system);
        let unilateral = unilateral.map(|contact| contact.name.to_owned());
        Derived {
            docs: model.docs.clone(),
            parameters: program.parameters.iter().map(with).collect(),
            inputs: program
                .inputs
                .iter()
                .map(|slot| {
                    let (name, unit, docs, value) = with(slot);
                    (name, unit, docs, value.unwrap_or(0.0))
                })
                .collect(),
            derived_parameters: model
                .derived_parameters
                .iter()
                .map(|own| {
                    let unit = own.unit_text.clone();
                    (own.name.to_string(), unit, own.docs.clone())
                })
                .collect(),
            coordinates: program.coordinates.iter().map(plain).collect(),
            outputs: program.outputs[..own].iter().map(plain).collect(),
            constraints: constraints.collect(),
            contacts: contacts.chain(unilateral).collect(),
            elements: model
                .elements
                .iter()
                .map(|element| (element.name.to_string(), element.docs.clone()))
                .collect(),
            numbers: (own..program.outputs.len()).collect(),
            warnings: told,
            machine,
            text,
            formulas,
            assumptions: Vec::new(),
            has_charts: !model.charts.is_empty(),
            cartesian: OnceLock::new(),
            library: OnceLock::new(),
        }
    }

    /// The machine in the Cartesian coordinates that the spec names, derived when it is first needed; `None` if the spec names none, or
    /// if a formula contains a polar coordinate that they do not have.
    pub fn cartesian(&self) -> Option<&Cartesian> {
        if !self.has_charts {
            return None;
        }
        let derive = || {
            let made = self.with_model(|mut model, report| {
                let points = ChartedPoints::of(&model);
                let other = model.cartesian.take();
                let other = other.filter(|model| model.uncharted.is_empty())?;
                let compiled = Compiled::for_runs(model, report)?;
                let other = Compiled::for_runs(*other, report)?;
                compiled.check_chart(&other, report)?;
                let machine = InterpretedMachine::new(other.program.clone());
                Some((machine, points))
            });
            let (mut machine, points) = made.ok().flatten()?;
            // Its constants were numbers when the model was made.
            if let Ok(text) = self.text.of_series(true) {
                machine = machine.with_series_on_demand(move || text.derive());
            }
            Some(Cartesian { machine, points })
        };
        self.cartesian.get_or_init(derive).as_ref()
    }

    /// The message of an error, followed by the place in the spec if that states its reason.
    pub fn placed(&self, error: &lagrangian::Error) -> String {
        let place = match error {
            lagrangian::Error::AssumptionEnded { assumption, .. } => {
                let mut stated = self.assumptions.iter();
                stated.find(|(text, _)| text == assumption)
            }
            _ => None,
        };
        match place {
            Some((_, place)) => format!("{error} ({place})"),
            None => error.to_string(),
        }
    }

    /// Calls a function with the model of this text. A model belongs to one thread, so it is built for the call.
    pub fn with_model<T: Send>(
        &self,
        work: impl FnOnce(Model<'_>, &mut Report) -> T + Send,
    ) -> Result<T, Trouble> {
        let constants = self.text.constants().map_err(Trouble::Constant)?;
        let made = thread::scope(|scope| {
            let work = || {
                let (dag, mut sources, mut report) = (Dag::new(), Sources::new(), Report::new());
                let text = &self.text;
                let spec =
                    lagrangian_spec::parse(&mut sources, &text.name, &text.text, &mut report);
                let spec = spec.with_given(text.given.iter().cloned());
                let asked: Vec<Formula<'_>> = self.formulas.iter().map(to_formula).collect();
                let files = &mut RecordedFiles(&text.files);
                let model = Model::resolve_with(
                    spec,
                    &dag,
                    &constants,
                    &asked,
                    files,
                    &mut sources,
                    &mut report,
                );
                match model {
                    Some(model) => Ok(work(model, &mut report)),
                    None => Err(Trouble::Spec(
                        errors::as_text(&report, &sources),
                        errors::as_values(&report, &sources),
                    )),
                }
            };
            let thread = thread::Builder::new().stack_size(STACK);
            thread
                .spawn_scoped(scope, work)
                .map(thread::ScopedJoinHandle::join)
        });
        match made {
            Ok(Ok(done)) => done,
            Ok(Err(panic)) => std::panic::resume_unwind(panic),
            Err(error) => Err(Trouble::System(format!(
                "cannot start a thread for the derivation: {error}"
            ))),
        }
    }

    /// Machine code for this number of states, compiled on first use; `None` if it is not available.
    pub fn library(&self, lanes: usize) -> Option<Arc<Library>> {
        let make = || {
            let program = Arc::new(self.machine.program().clone());
            Library::for_lanes(program, lanes, true).ok().map(Arc::new)
        };
        self.library.get_or_init(make).clone()
    }

    /// Why the spec refuses these parameters, for example a negative mass.
    pub fn refusal(&self, values: &[f64]) -> Result<Option<String>, Trouble> {
        self.with_model(|model, _| {
            let diagnostics = model.parameter_diagnostics(values);
            let error = diagnostics
                .iter()
                .find(|of| of.code.severity() == Severity::Error);
            error.map(|error| format!("{} [{}]", error.message, error.code))
        })
    }

    /// The first of many sets of parameters that is refused: its index and the reason.
    pub fn first_refused(&self, all: &[Vec<f64>]) -> Result<Option<(usize, String)>, Trouble> {
        self.with_model(|model, _| {
            for (place, values) in all.iter().enumerate() {
                let diagnostics = model.parameter_diagnostics(values);
                let error = diagnostics
                    .iter()
                    .find(|of| of.code.severity() == Severity::Error);
                if let Some(error) = error {
                    return Some((place, format!("{} [{}]", error.message, error.code)));
                }
            }
            None
        })
    }
}

fn to_formula((name, said, text, unit): &Asked) -> Formula<'_> {
    Formula {
        name,
        source_name: said,
        text,
        unit: unit.as_deref(),
    }
}

/// A derived program.
#[pyclass(frozen, module = "lagrangian._native")]
pub struct Program {
    pub derived: Arc<Derived>,
}

/// Derives a spec: from a file if there is no text, otherwise from the text under a name. The bases that it extends are
/// given, or read beside that name.
#[pyfunction]
pub fn derive(
    py: Python<'_>,
    name: String,
    text: Option<String>,
    files: Option<Vec<(String, String)>>,
    constants: Vec<(String, String)>,
) -> PyResult<Program> {
    let (name, text) = match text {
        Some(text) => (name, text),
        None => Disk
            .read(&name, None)
            .map_err(|reason| PyOSError::new_err(format!("cannot read {name}: {reason}")))?,
    };
    let bases = files.map_or(Bases::Disk, Bases::Given);
    let text = SpecText {
        name,
        text,
        files: Vec::new(),
        constants,
        given: Vec::new(),
    };
    compile(py, text, bases, Vec::new())
}

fn compile(
    py: Python<'_>,
    text: SpecText,
    bases: Bases,
    formulas: Vec<Asked>,
) -> PyResult<Program> {
    let derived = py.detach(|| Derived::new(text, bases, formulas));
    let derived = derived.map_err(|trouble| trouble.raise(py))?;
    Ok(Program { derived })
}

/// The program for a state from [`Program::state`].
#[pyfunction]
pub fn rebuild(py: Python<'_>, state: &str) -> PyResult<Program> {
    let text: SpecText = serde_json::from_str(state)
        .map_err(|error| PyValueError::new_err(format!("this is not a machine: {error}")))?;
    compile(py, text, Bases::Kept, Vec::new())
}

#[pymethods]
impl Program {
    /// Texts and constants, from which the program can be rebuilt.
    fn state(&self) -> String {
        serde_json::to_string(&self.derived.text).unwrap_or_default()
    }

    #[getter]
    fn name(&self) -> &str {
        lagrangian::Machine::name(&self.derived.machine)
    }

    #[getter]
    fn elements(&self) -> Vec<(String, String)> {
        self.derived.elements.clone()
    }

    #[getter]
    fn docs(&self) -> &str {
        &self.derived.docs
    }

    #[getter]
    fn file(&self) -> &str {
        &self.derived.text.name
    }

    #[getter]
    fn text(&self) -> &str {
        &self.derived.text.text
    }

    #[getter]
    fn files(&self) -> Vec<(String, String)> {
        let files = self.derived.text.files.iter();
        files
            .map(|file| (file.name.clone(), file.text.clone()))
            .collect()
    }

    #[getter]
    fn constants(&self) -> Vec<(String, String)> {
        self.derived.text.constants.clone()
    }

    /// Names, units, docs and values.
    #[getter]
    fn parameters(&self) -> Vec<(String, String, String, Option<f64>)> {
        self.derived.parameters.clone()
    }

    /// Names, units, docs and values.
    #[getter]
    fn inputs(&self) -> Vec<(String, String, String, f64)> {
        self.derived.inputs.clone()
    }

    /// Names, units and docs.
    #[getter]
    fn coordinates(&self) -> Vec<Described> {
        self.derived.coordinates.clone()
    }

    /// Names, units and docs.
    #[getter]
    fn outputs(&self) -> Vec<Described> {
        self.derived.outputs.clone()
    }

    /// Names, and the units of their multipliers.
    #[getter]
    fn constraints(&self) -> Vec<(String, String)> {
        self.derived.constraints.clone()
    }

    #[getter]
    fn contacts(&self) -> Vec<String> {
        self.derived.contacts.clone()
    }

    #[getter]
    fn warnings(&self) -> Vec<Told> {
        self.derived.warnings.clone()
    }

    /// The indices of the outputs that formulas became.
    #[getter]
    fn formulas(&self) -> Vec<usize> {
        self.derived.numbers.clone()
    }

    /// This program with formulas as additional outputs.
    fn with_formulas(&self, py: Python<'_>, formulas: Vec<Asked>) -> PyResult<Program> {
        compile(py, self.derived.text.clone(), Bases::Kept, formulas)
    }

    /// This program with other values of constants.
    fn with_constants(
        &self,
        py: Python<'_>,
        constants: Vec<(String, String)>,
    ) -> PyResult<Program> {
        let mut text = self.derived.text.clone();
        text.constants = constants;
        compile(py, text, Bases::Kept, Vec::new())
    }

    /// Whether derivatives of its motions are continued across changes of unilateral contacts, or mapped between charts.
    #[getter]
    fn is_continued(&self) -> [bool; 2] {
        let program = self.derived.machine.program();
        [!program.unilateral.is_empty(), self.derived.has_charts]
    }

    /// Names, units and docs of the parameters that follow from others.
    #[getter]
    fn derived_parameters(&self) -> Vec<Described> {
        self.derived.derived_parameters.clone()
    }

    /// This program with derived parameters made independent.
    fn with_given(&self, py: Python<'_>, names: Vec<String>) -> PyResult<Program> {
        let mut text = self.derived.text.clone();
        text.given.extend(names);
        text.given.sort_unstable();
        text.given.dedup();
        compile(py, text, Bases::Kept, Vec::new())
    }

    /// Why the spec refuses these parameters.
    fn refusal(&self, py: Python<'_>, values: Vec<f64>) -> PyResult<Option<String>> {
        let refused = py.detach(|| self.derived.refusal(&values));
        refused.map_err(|trouble| trouble.raise(py))
    }

    /// The equations or the code as text: `markdown`, `latex`, `html`, `rust`, `c` or `program`.
    fn derive(&self, py: Python<'_>, form: &str) -> PyResult<String> {
        use lagrangian_print::document::Document;
        use lagrangian_print::{html, latex, markdown};
        let name = std::path::Path::new(&self.derived.text.name).file_name();
        let file = name.map_or_else(String::new, |name| name.to_string_lossy().into_owned());
        let origin = vec![format!("@generated from {file} by `lagrangian derive`.")];
        let known = [
            "markdown", "latex", "html", "article", "rust", "c", "program",
        ];
        if !known.contains(&form) {
            return Err(PyValueError::new_err(format!(
                "no form named {form:?}; there are: {}",
                known.join(", ")
            )));
        }
        let text = py.detach(|| {
            self.derived.with_model(|model, report| {
                if form == "rust" {
                    let (compiled, cartesian) = Compiled::in_charts(model, report)?;
                    let options = lagrangian_emit::rust::Options {
                        origin,
                        ..lagrangian_emit::rust::Options::of(&compiled, cartesian.as_ref())
                    };
                    return Some(lagrangian_emit::rust::module(&compiled.program, &options));
                }
                let compiled = Compiled::new(model, report)?;
                let formulas = || compiled.formulas();
                Some(match form {
                    "markdown" => markdown::text(&Document::new(&compiled)),
                    "latex" => latex::text(&Document::new(&compiled)),
                    "html" => html::text(&Document::new(&compiled)),
                    "article" => html::article(&Document::new(&compiled)),
                    "c" => lagrangian_languages::c::file(&compiled.program, &origin, &formulas()),
                    _ => compiled.program.to_string(),
                })
            })
        });
        let text = text.map_err(|trouble| trouble.raise(py))?;
        text.ok_or_else(|| {
            PyRuntimeError::new_err("the machine was derived before, but cannot be derived again")
        })
    }
}
