//! Rust: a module for one machine, as the macro expands to it and as `generated/` holds it.
//!
//! The module needs only `core` and the runtime. Its arithmetic consists of plain functions that are generic over the
//! number and take only the arguments that they use; `Machine` and `System` are implemented with them for `f64`.

mod chart;
mod contact_parts;
mod derivatives;
mod docs;
mod functions;
mod implement;
mod kernel;
mod language;
mod library;
mod pivots;
mod prepared;
mod series;
mod stages;
mod structs;
mod stub;
mod types;

use std::collections::BTreeMap;
use std::rc::Rc;

use super::body::Plan;
use super::layout::Writer;
use super::names::{Field, Scope, identifier, output_functions, snake_case};
use docs::prose;
use lagrangian_mechanics::series::ProvedSeries;
use lagrangian_mechanics::{Proved, Unproved};
use lagrangian_program::contact_parts::ContactParts;
use lagrangian_program::{Counts, Function, Op, PackedStatement, Program, Role, packs};
use types::{Group, Types};

use chart::ChartOf;

pub use chart::Chart;
pub use stub::stub;

/// Settings of the text besides the program.
#[derive(Clone, Debug)]
pub struct Options {
    /// The path of the runtime in emitted code.
    pub runtime: String,
    /// Lines for the head of the file: its origin.
    pub origin: Vec<String>,
    /// For each role the formulas that its documentation shows, `T = 1/2*m*der(x)^2`.
    pub formulas: BTreeMap<Role, Vec<String>>,
    /// The Taylor series of the motion, if the machine asks for it.
    pub series: Option<ProvedSeries>,
    /// The same machine in its second chart, if its spec names one: a module within that of the machine.
    pub chart: Option<Chart>,
    /// The most operations of a function that is not cut into pieces. Above some thousand, a compiler that generates debug
    /// information for every variable overflows its stack.
    pub longest_whole: usize,
    /// The fewest steps of a function in which repeated code is written as a loop.
    pub shortest_rolled: usize,
    /// The fewest operations of a library's accelerations in which operations that parts of the machine have in common are
    /// written in pairs.
    pub shortest_packed: usize,
    /// Whether the structs with fields named by the spec (parameters, coordinates, inputs, outputs) are marked by an
    /// attribute, [`MARK`], which the macro replaces by the attributes of its user.
    pub marks: bool,
}

/// The attribute before a struct with fields named by the spec, if such structs are marked.
pub const MARK: &str = "fields_of_the_description";

/// The fewest steps of a function in which repeated code is written as a loop.
///
/// Shorter functions are short enough for compilers and processors anyway, and in the order of time they contain few repetitions.
pub const SHORTEST_ROLLED: usize = 300;

/// The fewest operations of a function that is written in pairs. A shorter one fits into the processor's cache of
/// decoded instructions, and is limited by latency more than by the number of instructions.
pub const SHORTEST_PACKED: usize = 1000;

impl Default for Options {
    fn default() -> Options {
        Options {
            runtime: "::lagrangian::emitted".into(),
            origin: Vec::new(),
            formulas: BTreeMap::new(),
            series: None,
            chart: None,
            longest_whole: super::cut::LONGEST_WHOLE,
            shortest_rolled: SHORTEST_ROLLED,
            shortest_packed: SHORTEST_PACKED,
            marks: false,
        }
    }
}

/// The name of the module of a machine.
pub fn module_name(machine: &str) -> String {
    let name = snake_case(machine);
    // The module and its exported type share a namespace.
    if name == machine {
        format!("{name}_machine")
    } else {
        identifier(&name)
    }
}

/// The content of the module of a machine.
pub fn module(program: &Proved, options: &Options) -> String {
    Emitter::new(program, options).module(ChartOf::of(options).as_ref())
}

/// Names of a [`module`] for code that is the same for every machine.
pub struct ModuleNames {
    /// The type of the machine, generic over its number.
    pub machine: String,
    /// The machine as an expression in the module, made from an array `p` of its parameters in the order of the description.
    pub of_parameters: String,
    /// The inputs in the same way, from an array `u`.
    pub of_inputs: String,
}

/// The names of the module of a machine.
pub fn names_of_module(program: &Program) -> ModuleNames {
    let types = Types::new(&program.name);
    let literal = |slots, name: &str, array: &str| {
        let mut writer = Writer::default();
        let values = Group::new(slots).literal(name, |slot| format!("{array}[{slot}]"));
        writer.expression("", &values, "");
        writer.finish()
    };
    ModuleNames {
        of_parameters: literal(&program.parameters, &types.machine, "p"),
        of_inputs: if program.inputs.is_empty() {
            format!("{}::default()", types.inputs)
        } else {
            literal(&program.inputs, &types.inputs, "u")
        },
        machine: types.machine,
    }
}

/// The content of a module for a library that is called from C: the accelerations and what they need. For a machine with unilateral
/// contacts it also has what a simulator needs to find out which of them press: see [`CONTACT_ROLES`].
///
/// It contains the functions `prepared` and `evaluate`, the type `Prepared` and the tables `COORDINATES`, `PARAMETERS`, `INPUTS`;
/// with contacts the table `CONTACTS`, and a function like `gaps_of` for each of these quantities.
///
/// # Errors
/// If a function of the reduced program differs from that of the whole program, which is a defect of the compiler.
pub fn library(program: &Proved, options: &Options) -> Result<String, Unproved> {
    let mut roles = vec![Role::Accelerations];
    if !program.unilateral.is_empty() {
        roles.extend(CONTACT_ROLES);
        roles.retain(|role| program.function(*role).is_some());
    }
    let program = program.with_only(&roles)?;
    Ok(Emitter::new(&program, options).library())
}

/// The operations of a library's accelerations in pairs, if they are written in this way.
pub fn in_pairs(function: &Function, options: &Options) -> Option<Vec<PackedStatement>> {
    let is_long = function.code.len() >= options.shortest_packed;
    is_long.then(|| packs(function)).flatten()
}

/// The quantities that a library provides for a machine with unilateral contacts, besides the accelerations with all contacts open.
/// Together with M and the rows of contacts and constraints they determine accelerations under any contact forces, and changes of
/// rates by impulses.
pub const CONTACT_ROLES: [Role; 7] = [
    Role::MassMatrix,
    Role::ConstraintMatrix,
    Role::Gaps,
    Role::ContactRates,
    Role::ContactMatrix,
    Role::ContactBias,
    Role::ContactCoefficients,
];

/// The expansion of the macro: the module of a machine, and the machine's type beside it.
///
/// The type is an alias instead of a `use`: it also resolves inside the body of a function, and beside a crate
/// of the same name.
pub fn expansion(program: &Proved, options: &Options) -> String {
    unproved_expansion(program, ChartOf::of(options).as_ref(), options)
}

/// The expansion of any program, also of the placeholder for an invalid spec, which computes nothing.
fn unproved_expansion(program: &Program, chart: Option<&ChartOf<'_>>, options: &Options) -> String {
    let emitter = Emitter::new(program, options);
    let (name, scalar) = (emitter.types.machine.clone(), emitter.types.scalar.clone());
    let module = module_name(&program.name);
    let f64 = emitter.types.known("f64");
    format!(
        "pub mod {module} {{\n{}}}\n\n\
         /// The machine of [`{module}`].\n\
         #[allow(dead_code, non_camel_case_types, unreachable_pub)]\n\
         pub type {name}<{scalar} = {f64}> = {module}::{name}<{scalar}>;\n",
        emitter.module(chart)
    )
}

struct Emitter<'a> {
    program: &'a Program,
    options: &'a Options,
    types: Types,
    writer: Writer,
    parameters: Group<'a>,
    coordinates: Group<'a>,
    inputs: Group<'a>,
    outputs: Group<'a>,
    /// The name of the function of each output.
    output_functions: Vec<String>,
    /// The path to each prepared value in its struct: `k3`, `k7[2]`.
    prepared: Vec<String>,
    /// Prepared values that loops count through, as arrays. A value may be in several of them.
    prepared_families: Vec<Field>,
    /// The loops of functions that have loops.
    plans: BTreeMap<Role, Plan>,
    /// The numbers of single contacts, where there are many.
    contact_parts: Option<Rc<ContactParts>>,
    /// Whether the module is within that of the machine in its other chart, whose lints it has.
    is_within: bool,
    /// Whether the function being written leaves the check for large angles to its caller.
    defers_angle_check: bool,
}

/// Lints that a formula may violate, with the reason; this list shows auditors that no other lint is silenced.
const ALLOWED: &[(&str, &[&str])] = &[
    (
        "A program uses some of it.",
        &["dead_code", "unreachable_pub"],
    ),
    (
        "Names and numbers are those of the description.",
        &["non_snake_case", "non_camel_case_types"],
    ),
    (
        "",
        &["clippy::approx_constant", "clippy::upper_case_acronyms"],
    ),
    (
        "Formulas are written as derived.",
        &["clippy::let_and_return", "clippy::too_many_arguments"],
    ),
    (
        "",
        &[
            "clippy::just_underscores_and_digits",
            "clippy::excessive_precision",
        ],
    ),
    ("", &["clippy::pedantic", "clippy::nursery"]),
    (
        "What the description says is no Markdown.",
        &["rustdoc::all"],
    ),
];

impl<'a> Emitter<'a> {
    fn new(program: &'a Program, options: &'a Options) -> Emitter<'a> {
        let parameters = Group::new(&program.parameters);
        let plan = |function: &Function| {
            let plan = Plan::of(function, true, options.shortest_rolled)?;
            // Loops are used only for functions that become much shorter.
            let is_worth_it = 4 * plan.len() <= 3 * plan.len_straight();
            is_worth_it.then_some((function.role, plan))
        };
        let is_whole = |role| matches!(role, Role::Accelerations | Role::Derivatives);
        let rolled = program.functions.iter().filter(|f| is_whole(f.role));
        let plans: BTreeMap<Role, Plan> = rolled.filter_map(plan).collect();
        let mut scope = Scope::with(&["singular"]);
        if options.series.is_some() {
            scope.take("series");
        }
        let prepared_families = prepared::families(program, &plans, &mut scope);
        let prepared = prepared::paths(program, &prepared_families, &mut scope);
        Emitter {
            prepared,
            prepared_families,
            plans,
            contact_parts: None,
            is_within: false,
            defers_angle_check: false,
            types: Types::new(&program.name),
            parameters,
            coordinates: Group::new(&program.coordinates),
            inputs: Group::new(&program.inputs),
            outputs: Group::new(&program.outputs),
            output_functions: output_functions(
                program.outputs.iter().map(|output| &output.name),
                str::to_owned,
            ),
            writer: Writer::default(),
            program,
            options,
        }
    }

    fn module(mut self, chart: Option<&ChartOf<'_>>) -> String {
        self.write_module();
        if let Some(chart) = chart {
            self.second_chart(chart);
        }
        self.writer.finish()
    }

    fn write_module(&mut self) {
        self.contact_parts = ContactParts::of(self.program).map(Rc::new);
        self.head();
        self.machine();
        self.coordinates();
        self.inputs();
        self.outputs();
        self.prepared();
        self.pivots();
        self.derivatives();
        self.stages();
        let program = self.program;
        for function in &program.functions {
            if self.is_emitted(function) {
                self.function(function);
            }
        }
        self.functions_of_contact_parts();
        if !self.outputs.is_empty() {
            self.all_outputs();
        }
        self.series_kernel();
        self.impl_linearize();
        self.impl_staged();
        self.implementations();
    }

    /// Writes the head of the file: its origin, its documentation, and the amount of work.
    fn head(&mut self) {
        let program = self.program;
        for line in &self.options.origin {
            self.writer.comment("//", line);
        }
        self.writer.gap();
        self.writer.comment("//!", &prose(&program.docs));
        if !program.docs.is_empty() {
            self.writer.line("//!");
        }
        let count = |n: usize, noun: &str| format!("{n} {noun}{}", if n == 1 { "" } else { "s" });
        let mut size = vec![
            count(program.coordinates.len(), "coordinate"),
            count(program.parameters.len(), "parameter"),
        ];
        for (slots, what) in [(&program.inputs, "input"), (&program.outputs, "output")] {
            if !slots.is_empty() {
                size.push(count(slots.len(), what));
            }
        }
        self.writer.comment(
            "//!",
            &format!("{}. Arithmetic of one call:", size.join(", ")),
        );
        self.writer.line("//!");
        self.writer
            .line("//! | function | mul | add | div | sin cos | other | temporaries |");
        self.writer
            .line("//! | --- | --: | --: | --: | --: | --: | --: |");
        for row in self.rows_of_work() {
            self.writer.line(row);
        }
        self.writer.line("//!");
        self.writer.comment(
            "//!",
            "Sine and cosine of one angle count once; subtractions and changes of sign are additions. A function that is not \
             here gives zeros.",
        );
        self.writer.gap();
        let lints = if self.is_within { &[] } else { ALLOWED };
        for (reason, lints) in lints {
            if !reason.is_empty() {
                self.writer.line(format!("// {reason}"));
            }
            self.writer.line(format!("#![allow({})]", lints.join(", ")));
        }
        if !self.plans.is_empty() {
            self.writer
                .line("// One counter for several arrays, some of them read backwards.");
            self.writer.line("#![allow(clippy::needless_range_loop)]");
        }
    }

    /// The rows of the table of work: one for each function that computes anything.
    fn rows_of_work(&self) -> Vec<String> {
        let of_parts = self
            .contact_parts
            .iter()
            .flat_map(|parts| &parts.program.functions);
        let functions = self.program.all_functions();
        let functions = functions.filter(|function| !self.is_by_parts(function.role));
        let row = |function: &Function| {
            let Counts {
                multiplications,
                additions,
                divisions,
                sincos,
                other,
                ..
            } = function.counts();
            let work = [
                multiplications,
                additions,
                divisions,
                sincos,
                other,
                temporaries(function),
            ];
            let is_any = work.iter().any(|&n| n > 0);
            let work = work.map(|n| n.to_string()).join(" | ");
            is_any.then(|| format!("//! | `{}` | {work} |", self.function_name(function.role)))
        };
        functions.chain(of_parts).filter_map(row).collect()
    }

    fn docs(&mut self, text: &str) {
        self.writer.comment("///", text);
    }
}

/// The number of values that are computed, not read.
fn temporaries(function: &Function) -> usize {
    let computed = |op: &&Op| !matches!(op, Op::Constant(_) | Op::Pi | Op::Read(_));
    function.code.iter().filter(computed).count()
}
