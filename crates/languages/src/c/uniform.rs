//! The same C file, followed by a set of functions whose names and arguments are the same for every machine, for generic
//! code; and the derivatives of accelerations and outputs, in forward and reverse mode.
//!
//! Their names begin with `unit` and have no underscore, so none is a name of the file before them, which all have one.

use std::collections::BTreeMap;

use lagrangian_mechanics::Proved;
use lagrangian_program::{Function, Program, Reads, Role, Shape, Slot, is_differentiated};

use super::{Emitter, sign, sum_error};
use lagrangian_emit::layout::Writer;

/// Functions with more operations than this are not differentiated: a C compiler would need minutes for the derivatives.
pub const MOST_OPERATIONS: usize = 20_000;

/// Whether a machine is small enough for derivatives.
pub fn may_have_derivatives(program: &Program) -> bool {
    let functions = program.functions.iter();
    let differentiated = functions.filter(|function| is_differentiated(function.role));
    let operations: usize = differentiated.map(|function| function.code.len()).sum();
    operations + program.prepare.code.len() <= MOST_OPERATIONS
}

/// The derivatives of a machine, each proved.
pub struct Derivatives {
    /// The result of [`Program::tangent`].
    pub tangent: Proved,
    /// The result of [`Program::adjoint`].
    pub adjoint: Proved,
}

/// The text of the file. `origin` holds lines for its head, `formulas` those that comments show.
pub fn file(
    program: &Proved,
    derivatives: Option<&Derivatives>,
    origin: &[String],
    formulas: &BTreeMap<Role, Vec<String>>,
) -> String {
    let further = derivatives.map(|d| [Emitter::new(&d.tangent), Emitter::new(&d.adjoint)]);
    let emitter = Emitter::new(program);
    let mut writer = Writer::default();
    let programs: Vec<&Program> = [&emitter]
        .into_iter()
        .chain(further.iter().flatten())
        .map(|emitter| emitter.program)
        .collect();
    emitter.head(&mut writer, origin);
    sum_error(&mut writer, &programs);
    emitter.types(&mut writer);
    sign(&mut writer, &programs);
    emitter.functions(&mut writer, formulas);
    emitter.sizes(&mut writer, derivatives.is_some());
    emitter.uniform(&mut writer);
    match &further {
        Some([tangent, adjoint]) => {
            tangent.tangent(&mut writer);
            adjoint.adjoint(&mut writer);
        }
        None => without_derivatives(&mut writer),
    }
    writer.finish()
}

/// The arguments of every function except those that depend on parameters alone.
fn arguments(of: &str) -> String {
    format!("const {of}Prepared *p, double t, const double *q, const double *v, const double *u")
}

/// The definitions that replace missing derivatives.
fn without_derivatives(writer: &mut Writer) {
    writer.gap();
    writer.line("/* This machine is too large for derivatives: these are not called. */");
    for of in ["UnitTangent", "UnitAdjoint"] {
        writer.line(format!("typedef UnitPrepared {of}Prepared;"));
    }
    for (of, name) in [
        ("UnitTangent", "unitTangent"),
        ("UnitAdjoint", "unitAdjoint"),
    ] {
        let arguments = arguments(of);
        writer.open(format!(
            "static void {name}Prepare(const double *x, {of}Prepared *p) {{"
        ));
        writer.line("(void)x, (void)p;");
        writer.close("}");
        writer.open(format!(
            "static int {name}Accelerations({arguments}, double *to) {{"
        ));
        writer.line("(void)p, (void)t, (void)q, (void)v, (void)u, (void)to;");
        writer.line("return 0;");
        writer.close("}");
    }
    let signatures = [
        ("UnitTangent", "unitTangentOutputs", "const double *a"),
        ("UnitAdjoint", "unitAdjointOutput", "const double *a, int k"),
    ];
    for (of, name, further) in signatures {
        let arguments = arguments(of);
        writer.open(format!(
            "static void {name}({arguments}, {further}, double *to) {{"
        ));
        writer.line("(void)p, (void)t, (void)q, (void)v, (void)u, (void)a, (void)to;");
        if further.ends_with('k') {
            writer.line("(void)k;");
        }
        writer.close("}");
    }
}

impl Emitter<'_> {
    /// The functions of the machine under its own names.
    fn functions(&self, writer: &mut Writer, formulas: &BTreeMap<Role, Vec<String>>) {
        self.prepare(writer);
        let program = self.program;
        for function in [&program.start].into_iter().chain(&program.functions) {
            self.function(writer, function, formulas.get(&function.role));
        }
    }

    fn sizes(&self, writer: &mut Writer, has_derivatives: bool) {
        let program = self.program;
        writer.gap();
        writer.line("/* How many there are of each. */");
        writer.open("enum {");
        for (name, count) in [
            ("COORDINATES", program.coordinates.len()),
            ("PARAMETERS", program.parameters.len()),
            ("INPUTS", program.inputs.len()),
            ("OUTPUTS", program.outputs.len()),
            ("FACTS", program.assumptions.len()),
            ("CONSTRAINTS", program.constraints.len()),
            ("HAS_DERIVATIVES", usize::from(has_derivatives)),
        ] {
            writer.line(format!("{name} = {count},"));
        }
        writer.close("};");
    }

    /// Fills a struct of the machine from an array, where a function reads it.
    fn fill_struct(
        &self,
        writer: &mut Writer,
        what: &str,
        slots: &[Slot],
        paths: &[String],
        from: &str,
    ) {
        writer.line(format!("{}_{what} of_{what};", self.prefix));
        for (i, path) in paths.iter().enumerate() {
            writer.line(format!("of_{what}.{path} = {from}[{i}];"));
        }
        if slots.is_empty() {
            writer.line(format!("of_{what}.none = 0;"));
        }
    }

    /// The call of a function with the arguments that are common to all machines; `result` holds those after its inputs.
    fn call(&self, reads: Reads, role: Role, result: &[&str]) -> String {
        let passed = self
            .arguments(reads)
            .into_iter()
            .map(|(name, _)| match name {
                "self" => "&of_parameters",
                "u" => "&of_inputs",
                name => name,
            });
        let passed: Vec<&str> = passed.chain(result.iter().copied()).collect();
        let name = self.function_name(role);
        format!("{}_{name}({})", self.prefix, passed.join(", "))
    }

    /// The arguments that a function reads, as its signature requires.
    fn read_by(&self, function: &Function) -> Reads {
        let mut reads = function.reads();
        reads.parameters |= function.role == Role::Start;
        let checks = function.role.inverts() && !self.program.prepare.guards.is_empty();
        reads.prepared |= checks;
        reads
    }

    /// The type of prepared values, and the function that computes them.
    fn uniform_prepare(&self, writer: &mut Writer, of: &str, name: &str) {
        writer.gap();
        writer.line(format!("typedef {}_prepared {of}Prepared;", self.prefix));
        writer.gap();
        writer.line("/* What depends on the parameters x alone. */");
        writer.open(format!(
            "static void {name}(const double *x, {of}Prepared *p) {{"
        ));
        self.fill_parameters(writer);
        writer.line(format!("{}_prepare(&of_parameters, p);", self.prefix));
        writer.close("}");
    }

    fn fill_parameters(&self, writer: &mut Writer) {
        let slots = &self.program.parameters;
        self.fill_struct(writer, "parameters", slots, &self.parameters, "x");
        writer.line("(void)x;");
    }

    fn fill_inputs(&self, writer: &mut Writer) {
        self.fill_struct(writer, "inputs", &self.program.inputs, &self.inputs, "u");
    }

    /// A function that solves the equations.
    fn uniform_solving(&self, writer: &mut Writer, of: &str, name: &str, role: Role) {
        let arguments = arguments(of);
        writer.gap();
        writer.line("/* 0, or 1 + the number of the coordinate whose pivot vanishes. */");
        writer.open(format!("static int {name}({arguments}, double *to) {{"));
        match self.program.function(role) {
            Some(function) => {
                let reads = self.read_by(function);
                self.mark_unused(writer, reads, &[]);
                if reads.inputs {
                    self.fill_inputs(writer);
                }
                let call = self.call(reads, role, &["to"]);
                writer.line(format!("return {call};"));
            }
            None => {
                self.mark_unused(writer, Reads::default(), &["to"]);
                writer.line("return 0;");
            }
        }
        writer.close("}");
    }

    /// A function that fills an array, for machines with constraints; matrices are stored row by row.
    fn uniform_list(&self, writer: &mut Writer, name: &str, role: Role) {
        let arguments = arguments("Unit");
        writer.gap();
        writer.open(format!("static void {name}({arguments}, double *to) {{"));
        let program = self.program;
        let function = program.function(role);
        match function.filter(|_| !program.constraints.is_empty()) {
            Some(function) if self.is_written(function) => {
                let reads = self.read_by(function);
                self.mark_unused(writer, reads, &[]);
                if reads.inputs {
                    self.fill_inputs(writer);
                }
                let to = match function.shape {
                    Shape::Symmetric(n) => format!("(double (*)[{n}])to"),
                    _ => "to".to_owned(),
                };
                writer.line(format!("{};", self.call(reads, role, &[&to])));
            }
            function => {
                self.mark_unused(writer, Reads::default(), &["to"]);
                let len = function.map_or(0, |f| f.results.len());
                for i in 0..len {
                    writer.line(format!("to[{i}] = 0.0;"));
                }
            }
        }
        writer.close("}");
    }

    /// The derivatives in forward mode.
    fn tangent(&self, writer: &mut Writer) {
        self.types(writer);
        self.functions(writer, &BTreeMap::new());
        self.uniform_prepare(writer, "UnitTangent", "unitTangentPrepare");
        let role = Role::Accelerations;
        self.uniform_solving(writer, "UnitTangent", "unitTangentAccelerations", role);
        self.numbered(
            writer,
            "UnitTangent",
            ("unitTangentOutputs", ", const double *a, double *to"),
            self.program.outputs.len(),
            Role::Output,
        );
    }

    /// The derivatives in reverse mode.
    fn adjoint(&self, writer: &mut Writer) {
        self.types(writer);
        self.functions(writer, &BTreeMap::new());
        self.uniform_prepare(writer, "UnitAdjoint", "unitAdjointPrepare");
        self.uniform_solving(
            writer,
            "UnitAdjoint",
            "unitAdjointAccelerations",
            Role::Adjoint,
        );
        let arguments = arguments("UnitAdjoint");
        writer.gap();
        writer.line("/* The derivatives of output k. */");
        writer.open(format!(
            "static void unitAdjointOutput({arguments}, const double *a, int k, double *to) {{"
        ));
        self.mark_unused(writer, Reads::default(), &["a", "to"]);
        let is_gradient = |function: &&Function| matches!(function.role, Role::Gradient(_));
        let gradients = || self.program.functions.iter().filter(is_gradient);
        if gradients().any(|function| function.reads().inputs) {
            self.fill_inputs(writer);
        }
        writer.open("switch (k) {");
        for function in gradients() {
            if let Role::Gradient(i) = function.role {
                let call = self.call(self.read_by(function), function.role, &["to"]);
                writer.line(format!("case {i}: {call}; break;"));
            }
        }
        writer.line("default: break;");
        writer.close("}");
        writer.close("}");
    }

    fn uniform(&self, writer: &mut Writer) {
        let program = self.program;
        self.uniform_prepare(writer, "Unit", "unitPrepare");
        writer.gap();
        writer.line("/* Coordinates and their rates at the start. */");
        writer.open("static void unitStart(const double *x, double *to) {");
        let count = program.start.results.len();
        for i in count..2 * program.dimension() {
            writer.line(format!("to[{i}] = 0.0;"));
        }
        self.fill_parameters(writer);
        writer.line(format!("{}_start(&of_parameters, to);", self.prefix));
        writer.close("}");
        self.uniform_solving(writer, "Unit", "unitAccelerations", Role::Accelerations);
        let name = "unitMultipliers";
        self.uniform_solving(writer, "Unit", name, Role::Multipliers);
        for (name, role) in [
            ("unitConstraintPositions", Role::ConstraintPositions),
            ("unitConstraintRates", Role::ConstraintRates),
            ("unitConstraintMatrix", Role::ConstraintMatrix),
            ("unitMassMatrix", Role::MassMatrix),
        ] {
            self.uniform_list(writer, name, role);
        }
        let arguments = arguments("Unit");
        for (name, role) in [
            ("unitKineticEnergy", Role::KineticEnergy),
            ("unitPotentialEnergy", Role::PotentialEnergy),
        ] {
            writer.gap();
            writer.line("/* In J. */");
            writer.open(format!("static double {name}({arguments}) {{"));
            let function = program.function(role).filter(|f| self.is_written(f));
            match function {
                Some(function) => {
                    let reads = self.read_by(function);
                    self.mark_unused(writer, reads, &[]);
                    if reads.inputs {
                        self.fill_inputs(writer);
                    }
                    writer.line(format!("return {};", self.call(reads, role, &[])));
                }
                None => {
                    self.mark_unused(writer, Reads::default(), &[]);
                    writer.line("return 0.0;");
                }
            }
            writer.close("}");
        }
        self.numbered(
            writer,
            "Unit",
            ("unitOutputs", ", const double *a, double *to"),
            program.outputs.len(),
            Role::Output,
        );
        self.numbered(
            writer,
            "Unit",
            ("unitFacts", ", const double *a, double *to"),
            program.assumptions.len(),
            Role::Assumption,
        );
    }

    /// One function that computes all numbers of a list.
    fn numbered(
        &self,
        writer: &mut Writer,
        of: &str,
        (name, further): (&str, &str),
        count: usize,
        role: fn(usize) -> Role,
    ) {
        let program = self.program;
        let arguments = arguments(of);
        writer.gap();
        writer.open(format!("static void {name}({arguments}{further}) {{"));
        let functions =
            (0..count).map(|i| program.function(role(i)).filter(|f| self.is_written(f)));
        let functions: Vec<Option<&Function>> = functions.collect();
        let reads_inputs = functions
            .iter()
            .flatten()
            .any(|function| function.reads().inputs);
        self.mark_unused(writer, Reads::default(), &["a", "to"]);
        if reads_inputs {
            self.fill_inputs(writer);
        }
        for (i, function) in functions.into_iter().enumerate() {
            let value = match function {
                Some(function) => self.call(self.read_by(function), role(i), &[]),
                None => "0.0".to_owned(),
            };
            writer.line(format!("to[{i}] = {value};"));
        }
        writer.close("}");
    }

    /// Marks unused arguments, so that compilers do not warn.
    fn mark_unused(&self, writer: &mut Writer, reads: Reads, further: &[&str]) {
        let all = [
            ("p", reads.prepared),
            ("t", reads.time),
            ("q", reads.coordinates),
            ("v", reads.velocities),
            ("u", reads.inputs),
        ];
        let unread = all.into_iter().filter(|(_, is_read)| !is_read);
        let names = unread.map(|(name, _)| name).chain(further.iter().copied());
        for name in names {
            writer.line(format!("(void){name};"));
        }
    }
}
