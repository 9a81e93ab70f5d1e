//! Rust: a module for one machine, as the macro expands to it and as `generated/` holds it.
//!
//! The module needs `core` and the runtime only. Its arithmetic is in plain functions, generic over the number and taking
//! the arguments that they use; `Machine` and `System` are implemented on top of them for `f64`.

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

use super::body::Plan;
use super::layout::Writer;
use super::names::{Field, Scope, identifier, snake_case};
use docs::prose;
use lagrangian_mechanics::series::ProvedSeries;
use lagrangian_mechanics::{Proved, Unproved};
use lagrangian_program::{Counts, Function, Op, Program, Role, Statement, packs};
use types::{Group, Types};

pub use stub::stub;

/// What the text depends on besides the program.
#[derive(Clone, Debug)]
pub struct Options {
    /// The path of what emitted code needs of the runtime.
    pub runtime: String,
    /// Lines for the head of the file: where it came from.
    pub origin: Vec<String>,
    /// For each role the formulas that its documentation shows, `T = 1/2*m*der(x)^2`.
    pub formulas: BTreeMap<Role, Vec<String>>,
    /// The Taylor series of the motion, if the machine asks for it.
    pub series: Option<ProvedSeries>,
    /// The most operations of a function that is not cut into pieces. Beyond some thousand a compiler that describes every
    /// variable to a debugger needs more stack than it has.
    pub longest_whole: usize,
    /// The fewest steps of a function in which what repeats itself is written as a loop.
    pub shortest_rolled: usize,
    /// The fewest operations of a library's accelerations in which those that parts of the machine have in common are written
    /// in pairs.
    pub shortest_packed: usize,
    /// Whether the structs whose fields a description names (parameters, coordinates, inputs, outputs) are marked by an
    /// attribute, [`MARK`], in whose place the macro puts those of its user.
    pub marks: bool,
}

/// Stands before a struct whose fields a description names, where they are marked.
pub const MARK: &str = "fields_of_the_description";

/// The fewest steps of a function in which what repeats itself is written as a loop.
///
/// Below, a function is short to a compiler and to a processor anyhow; and in the order of time little
/// repeats itself.
pub const SHORTEST_ROLLED: usize = 300;

/// The fewest operations of a function that is written in pairs. A shorter one fits the processor's store of decoded
/// instructions, and waits for its results more than for its instructions.
pub const SHORTEST_PACKED: usize = 1000;

impl Default for Options {
    fn default() -> Options {
        Options {
            runtime: "::lagrangian::emitted".into(),
            origin: Vec::new(),
            formulas: BTreeMap::new(),
            series: None,
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
    // The module and the type it exports share a namespace.
    if name == machine {
        format!("{name}_machine")
    } else {
        identifier(&name)
    }
}

/// The content of the module of a machine.
pub fn module(program: &Proved, options: &Options) -> String {
    Emitter::new(program, options).module()
}

/// The content of a module for a library that is called from C: the accelerations alone, and what they need. Of a machine with unilateral
/// contacts also what a simulator needs to find out which of them press: see [`OF_CONTACTS`].
///
/// It has the functions `prepared` and `evaluate`, the type `Prepared` and the tables `COORDINATES`, `PARAMETERS`, `INPUTS`; with
/// contacts the table `CONTACTS`, and a function `gaps_of` and the like for each of these quantities.
///
/// # Errors
/// If the functions alone are not what they were among all, which is a defect of the compiler.
pub fn library(program: &Proved, options: &Options) -> Result<String, Unproved> {
    let mut roles = vec![Role::Accelerations];
    if !program.unilateral.is_empty() {
        roles.extend(OF_CONTACTS);
        roles.retain(|role| program.function(*role).is_some());
    }
    let program = program.restricted(&roles)?;
    Ok(Emitter::new(&program, options).library())
}

/// The operations of a library's accelerations in pairs, if that is how they are written.
pub fn in_pairs(function: &Function, options: &Options) -> Option<Vec<Statement>> {
    let is_long = function.code.len() >= options.shortest_packed;
    is_long.then(|| packs(function)).flatten()
}

/// What a library has of a machine with unilateral contacts, beside the accelerations with all of them open. With M and the rows of
/// contacts and constraints, accelerations under any forces of contact follow, and the changes of rates by impulses.
pub const OF_CONTACTS: [Role; 7] = [
    Role::MassMatrix,
    Role::ConstraintMatrix,
    Role::Gaps,
    Role::ContactRates,
    Role::ContactMatrix,
    Role::ContactDrift,
    Role::ContactCoefficients,
];

/// What the macro expands to: the module of a machine, and the machine's type beside it.
///
/// The type is an alias and no `use`: it resolves in the body of a function too, and beside a crate of the same name.
pub fn expansion(program: &Proved, options: &Options) -> String {
    unproved_expansion(program, options)
}

/// The expansion of any program: also of one that stands where a spec is wrong, and computes nothing.
fn unproved_expansion(program: &Program, options: &Options) -> String {
    let emitter = Emitter::new(program, options);
    let (name, scalar) = (emitter.types.machine.clone(), emitter.types.scalar.clone());
    let module = module_name(&program.name);
    let f64 = emitter.types.known("f64");
    format!(
        "pub mod {module} {{\n{}}}\n\n\
         /// The machine of [`{module}`].\n\
         #[allow(dead_code, non_camel_case_types, unreachable_pub)]\n\
         pub type {name}<{scalar} = {f64}> = {module}::{name}<{scalar}>;\n",
        emitter.module()
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
    /// The paths of the prepared values in their struct: `k3`, `k7[2]`.
    prepared: Vec<String>,
    /// Those prepared values that loops count, as arrays. One may be in several of them.
    prepared_families: Vec<Field>,
    /// The loops of functions that have any.
    plans: BTreeMap<Role, Plan>,
    /// Whether the function that is being written leaves large angles to whoever calls it.
    asks_once: bool,
}

/// Lints that a formula may break, with the reason; whoever audits the code should see that no other is silenced.
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
            // The rest is straight in any case: loops are for functions that they make shorter.
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
            asks_once: false,
            types: Types::new(&program.name),
            parameters,
            coordinates: Group::new(&program.coordinates),
            inputs: Group::new(&program.inputs),
            outputs: Group::new(&program.outputs),
            writer: Writer::default(),
            program,
            options,
        }
    }

    fn module(mut self) -> String {
        self.head();
        self.machine();
        self.coordinates();
        self.inputs();
        self.outputs();
        self.prepared();
        self.pivots();
        self.derivatives();
        self.stages();
        for function in &self.program.functions {
            if self.is_emitted(function) {
                self.function(function);
            }
        }
        if !self.outputs.is_empty() {
            self.all_outputs();
        }
        self.series_kernel();
        self.impl_linearize();
        self.impl_staged();
        self.implementations();
        self.writer.finish()
    }

    /// The head of the file: where it came from, what it says, how much work it is.
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
        let count = |n: usize, what: &str| format!("{n} {what}{}", if n == 1 { "" } else { "s" });
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
        for function in program.all_functions() {
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
            if work.iter().any(|&n| n > 0) {
                let work = work.map(|n| n.to_string()).join(" | ");
                self.writer.line(format!(
                    "//! | `{}` | {work} |",
                    self.function_name(function.role)
                ));
            }
        }
        self.writer.line("//!");
        self.writer.comment(
            "//!",
            "Sine and cosine of one angle count once; subtractions and changes of sign are additions. A function that is not \
             here gives zeros.",
        );
        self.writer.gap();
        for (reason, lints) in ALLOWED {
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

    fn docs(&mut self, text: &str) {
        self.writer.comment("///", text);
    }
}

/// Values that are computed, not read.
fn temporaries(function: &Function) -> usize {
    let computed = |op: &&Op| !matches!(op, Op::Constant(_) | Op::Pi | Op::Read(_));
    function.code.iter().filter(computed).count()
}
