//! The plain-text listing of a program: `derive --as program`, and the file beside generated code for reviewers.
//!
//! Below the head of a function its form is noted if there was a choice. Each line has one
//! operation, `_7 = _3 * prepared[2]`, or the sine and cosine of one angle; a result that a line
//! computes is noted at its end.

use std::fmt::{self, Write as _};

use rustc_hash::FxHashMap;

use super::quantity::Entry;
use super::{Function, Op, Program, Role, Source, Value};
use crate::formula::number;
use lagrangian_units::{Variable, rate_name};

impl fmt::Display for Program {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "program {}", self.name)?;
        for function in self
            .all_functions()
            .filter(|function| !function.results.is_empty())
        {
            writeln!(f)?;
            f.write_str(&Listing::new(self, function).text())?;
        }
        Ok(())
    }
}

impl Program {
    /// The name of an argument, as the spec writes it; prepared values are numbered.
    pub fn source_name(&self, source: Source) -> String {
        let coordinate = |index: u32| &self.coordinates[index as usize].name;
        match source {
            Source::Parameter(index) => self.parameters[index as usize].name.to_string(),
            Source::Prepared(index) => format!("prepared[{index}]"),
            Source::Time => "t".into(),
            Source::Coordinate(index) => coordinate(index).to_string(),
            Source::Velocity(index) => rate_name(&coordinate(index).to_string(), ""),
            Source::Acceleration(index) => {
                rate_name(&rate_name(&coordinate(index).to_string(), ""), "")
            }
            Source::Input(index) => self.inputs[index as usize].name.to_string(),
            Source::AtTime(index) => format!("at_time[{index}]"),
            Source::AtPosition(index) => format!("at_position[{index}]"),
        }
    }

    /// The name of a variable, as the spec writes it.
    pub fn variable_name(&self, variable: Variable) -> String {
        self.source_name(match variable {
            Variable::Coordinate(i) => Source::Coordinate(i as u32),
            Variable::Rate(i) => Source::Velocity(i as u32),
            Variable::Input(i) => Source::Input(i as u32),
            Variable::Parameter(i) => Source::Parameter(i as u32),
        })
    }

    /// The title of a function: the name of its role, or of the output or assumption.
    pub fn title(&self, role: Role) -> String {
        match role {
            Role::Output(index) => match self.outputs.get(index) {
                Some(output) => format!("output {}", output.name),
                None => role.name(),
            },
            Role::Assumption(index) => match self.assumptions.get(index) {
                Some(fact) => format!("assumption {}", fact.text),
                None => role.name(),
            },
            _ => role.name(),
        }
    }

    /// The name of a result of a function: `mass_matrix[x, theta]`.
    pub fn result_name(&self, role: Role, index: usize) -> String {
        let name = match role {
            Role::Prepare => "prepared".into(),
            role => self.title(role),
        };
        match self.entry(role, index) {
            Entry::Whole => name,
            Entry::Of(kind, i) => format!("{name}[{}]", self.member((kind, i))),
            Entry::At(row, column) => {
                format!("{name}[{}, {}]", self.member(row), self.member(column))
            }
            Entry::Rate(i) => {
                let coordinate = self.coordinates[i].name.to_string();
                format!("{name}[{}]", rate_name(&coordinate, ""))
            }
            Entry::Derivative(i, variable) => {
                let coordinate = &self.coordinates[i].name;
                format!("{name}[{coordinate}, {}]", self.variable_name(variable))
            }
            Entry::Index(index) => format!("{name}[{index}]"),
        }
    }
}

struct Listing<'a> {
    program: &'a Program,
    function: &'a Function,
    /// The names of the values: arguments and constants by their names, the others by numbers.
    names: Vec<String>,
    /// For the sine of an angle its cosine, if both occur, and vice versa.
    partners: FxHashMap<Value, Value>,
}

impl<'a> Listing<'a> {
    fn new(program: &'a Program, function: &'a Function) -> Listing<'a> {
        let mut next = 0;
        let mut names = Vec::with_capacity(function.code.len());
        let mut circular: FxHashMap<Value, Value> = FxHashMap::default();
        let mut partners = FxHashMap::default();
        for (index, op) in function.code.iter().enumerate() {
            names.push(match op {
                Op::Constant(value) => number(value),
                Op::Pi => "pi".into(),
                Op::Read(source) => program.source_name(*source),
                _ => {
                    next += 1;
                    format!("_{}", next - 1)
                }
            });
            if let Op::Sin(angle) | Op::Cos(angle) = op
                && let Some(first) = circular.insert(*angle, Value(index as u32))
            {
                partners.insert(first, Value(index as u32));
                partners.insert(Value(index as u32), first);
            }
        }
        Listing {
            program,
            function,
            names,
            partners,
        }
    }

    fn text(&self) -> String {
        let name = self.program.title(self.function.role);
        let counts = self.function.counts();
        let mut text = format!("{name}({})  // {counts}\n", self.arguments());
        text.push_str(&self.choice());
        self.write_operations(&mut text);
        self.write_given_results(&mut text);
        self.write_guards(&mut text);
        text
    }

    /// Writes a line for each operation, with the results that it computes behind it.
    fn write_operations(&self, text: &mut String) {
        let notes = self.notes();
        for (index, op) in self.function.code.iter().enumerate() {
            let value = Value(index as u32);
            let partner = self.partners.get(&value);
            let (mut line, mut noted) = match (op, partner) {
                // Listed together with its partner above.
                (Op::Sin(_) | Op::Cos(_), Some(partner)) if *partner < value => continue,
                (Op::Sin(angle) | Op::Cos(angle), Some(&partner)) => {
                    let (sin, cos) = if matches!(op, Op::Sin(_)) {
                        (value, partner)
                    } else {
                        (partner, value)
                    };
                    let line = format!(
                        "{}, {} = sin_cos({})",
                        self.name(sin),
                        self.name(cos),
                        self.name(*angle)
                    );
                    (line, vec![sin, cos])
                }
                (Op::Constant(_) | Op::Pi | Op::Read(_), _) => continue,
                _ => (
                    format!("{} = {}", self.name(value), self.operation(op)),
                    vec![value],
                ),
            };
            noted.retain(|value| notes.contains_key(value));
            let notes: Vec<String> = noted
                .iter()
                .flat_map(|value| notes[value].clone())
                .collect();
            // Writing to a String cannot fail, here and below.
            if !notes.is_empty() {
                let _ = write!(line, "  // {}", notes.join("; "));
            }
            let _ = writeln!(text, "  {line}");
        }
    }

    /// The names of the results of each value.
    fn notes(&self) -> FxHashMap<Value, Vec<String>> {
        let role = self.function.role;
        let mut notes: FxHashMap<Value, Vec<String>> = FxHashMap::default();
        for (index, result) in self.function.results.iter().enumerate() {
            let mut note = self.program.result_name(role, index);
            if role == Role::Prepare {
                let _ = write!(note, " = {}", self.program.prepared[index]);
            }
            notes.entry(*result).or_default().push(note);
        }
        for (value, step) in &self.function.steps {
            let note = self.program.name_of_step(*step);
            notes.entry(*value).or_default().push(note);
        }
        notes
    }

    /// Writes the results that no operation computes.
    fn write_given_results(&self, text: &mut String) {
        for (index, result) in self.function.results.iter().enumerate() {
            let op = self.function.op(*result);
            if matches!(op, Op::Constant(_) | Op::Pi | Op::Read(_)) {
                let name = self.program.result_name(self.function.role, index);
                let _ = writeln!(text, "  {name} = {}", self.name(*result));
            }
        }
    }

    fn write_guards(&self, text: &mut String) {
        let program = self.program;
        for guard in &self.function.guards {
            let pivot = match guard.coordinate.checked_sub(program.dimension()) {
                None => format!("inertia of {}", program.coordinates[guard.coordinate].name),
                Some(k) => format!("constraint {}", program.constraints[k].name),
            };
            let _ = writeln!(
                text,
                "  require {} > {:e} * {}  // {pivot}",
                self.name(guard.pivot),
                guard.tolerance,
                self.name(guard.scale),
            );
        }
    }

    /// The form of the function, if there were several; for the accelerations, the rejected forms too.
    fn choice(&self) -> String {
        let mut text = String::new();
        let Some(choice) = self.program.choice(self.function.role) else {
            return text;
        };
        let chosen = choice.chosen();
        let _ = write!(text, "  // {}; {}", chosen.form, chosen.cost);
        let rounding = chosen
            .rounding
            .map(|rounding| format!("; rounding {rounding}"));
        let _ = writeln!(text, "{}", rounding.unwrap_or_default());
        if matches!(
            self.function.role,
            Role::Accelerations | Role::AccelerationsAt | Role::Friction
        ) {
            for other in choice.others() {
                let _ = writeln!(text, "  // not {other}");
            }
        }
        text
    }

    fn arguments(&self) -> String {
        let reads = self.function.reads();
        let arguments = [
            (reads.parameters, "parameters"),
            (reads.prepared, "prepared"),
            (reads.at_time, "at_time"),
            (reads.at_position, "at_position"),
            (reads.time, "t"),
            (reads.coordinates, "q"),
            (reads.velocities, "v"),
            (reads.inputs, "u"),
            (reads.accelerations, "a"),
        ];
        let read: Vec<&str> = arguments
            .into_iter()
            .filter(|(read, _)| *read)
            .map(|(_, name)| name)
            .collect();
        read.join(", ")
    }

    fn name(&self, value: Value) -> &str {
        &self.names[value.index()]
    }

    fn operation(&self, op: &Op) -> String {
        let name = |value: Value| self.name(value);
        match *op {
            Op::Constant(_) | Op::Pi | Op::Read(_) => String::new(),
            Op::Add(a, b) => format!("{} + {}", name(a), name(b)),
            Op::Sub(a, b) => format!("{} - {}", name(a), name(b)),
            Op::Mul(a, b) => format!("{} * {}", name(a), name(b)),
            Op::Div(a, b) => format!("{} / {}", name(a), name(b)),
            Op::Neg(a) => format!("-{}", name(a)),
            Op::ProductError(a, b) => format!("error({} * {})", name(a), name(b)),
            Op::SumError(a, b) => format!("error({} + {})", name(a), name(b)),
            Op::Sin(a) => format!("sin({})", name(a)),
            Op::Cos(a) => format!("cos({})", name(a)),
            Op::Unary(function, a) => format!("{}({})", function.name(), name(a)),
            Op::Binary(function, a, b) => format!("{}({}, {})", function.name(), name(a), name(b)),
        }
    }
}
