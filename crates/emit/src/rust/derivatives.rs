//! The struct of accelerations with their derivatives, and its traits for the runtime.

use super::Emitter;
use super::docs::prose;
use crate::layout::Layout;
use lagrangian_program::{Role, Shape};
use lagrangian_spec::model::Variable;

/// Derivatives by variables of one kind: a field of the struct.
struct Field {
    name: &'static str,
    docs: String,
    /// The columns of the matrix of [`Role::Derivatives`]; column 0 holds the accelerations.
    columns: std::ops::Range<usize>,
}

impl Emitter<'_> {
    /// The fields in the order of their columns.
    fn derivative_fields(&self) -> Vec<Field> {
        let columns = &self.program.derivatives;
        let kind = |variable: &Variable| match variable {
            Variable::Coordinate(_) => ("by_coordinates", "By the coordinates."),
            Variable::Rate(_) => ("by_rates", "By the rates of the coordinates."),
            Variable::Input(_) => ("by_inputs", "By the inputs."),
            Variable::Parameter(_) => ("by_parameters", ""),
        };
        let mut first = 1;
        let fields = columns.chunk_by(|a, b| kind(a) == kind(b)).map(|chunk| {
            let (name, docs) = kind(&chunk[0]);
            let names: Vec<String> = chunk
                .iter()
                .map(|variable| format!("`{}`", self.program.variable_name(*variable)))
                .collect();
            let docs = if docs.is_empty() {
                format!("By {}.", names.join(", "))
            } else {
                docs.to_owned()
            };
            let columns = first..first + chunk.len();
            first = columns.end;
            Field {
                name,
                docs,
                columns,
            }
        });
        fields.collect()
    }

    /// Writes the struct that the function returns, if there is one.
    pub(super) fn derivatives(&mut self) {
        if self.program.derivatives.is_empty() {
            return;
        }
        let (name, scalar) = (self.types.derivatives.clone(), self.types.scalar.clone());
        let n = self.program.dimension();
        self.writer.gap();
        self.docs(
            "Accelerations with their derivatives, in SI units: row `i` is about the acceleration of coordinate `i`, column `j` is \
             by variable `j`.",
        );
        self.writer.line("#[derive(Clone, Copy, Debug, PartialEq)]");
        self.writer.open(format!("pub struct {name}<{scalar}> {{"));
        self.docs("The accelerations.");
        self.writer
            .line(format!("pub accelerations: [{scalar}; {n}],"));
        for Field {
            name,
            docs,
            columns,
        } in self.derivative_fields()
        {
            self.docs(&prose(&docs));
            let m = columns.len();
            self.writer
                .line(format!("pub {name}: [[{scalar}; {m}]; {n}],"));
        }
        self.writer.close("}");
    }

    /// The struct literal, from the texts of the matrix.
    pub(super) fn derivatives_literal(&self, shape: Shape, texts: &[String]) -> Layout {
        let (n, width) = match shape {
            Shape::Matrix(rows, columns) => (rows, columns),
            _ => (0, 0),
        };
        let text = |i: usize, j: usize| Layout::Atom(texts[i * width + j].clone());
        let accelerations = Layout::nested((0..n).map(|i| text(i, 0)));
        let mut fields = vec![("accelerations".to_owned(), accelerations)];
        for Field { name, columns, .. } in self.derivative_fields() {
            let row = |i: usize| Layout::nested(columns.clone().map(|j| text(i, j)));
            fields.push((name.to_owned(), Layout::nested((0..n).map(row))));
        }
        Layout::Struct(self.types.derivatives.clone(), fields)
    }

    /// Writes `Linearize`, if the derivatives by all coordinates and rates exist.
    pub(super) fn impl_linearize(&mut self) {
        let n = self.program.dimension();
        if !self.program.has_linearization() {
            return;
        }
        let Some(function) = self.emitted(Role::Derivatives) else {
            return;
        };
        let runtime = self.options.runtime.clone();
        let f64 = self.types.known("f64");
        let result = format!("{}<(), {runtime}::Singular>", self.types.known("Result"));
        let call = self.call_with("derivatives", self.needs(function));
        self.writer.gap();
        self.writer.open(format!(
            "impl {runtime}::Linearize for {} {{",
            self.types.prepared
        ));
        let vector = format!("&[{f64}; {n}]");
        let reads = function.reads();
        let named = |name: &str, is_read: bool, kind: String| {
            format!("{}: {kind}", if is_read { name } else { "_" })
        };
        let arguments = [
            "&self".to_owned(),
            named("t", reads.time, f64.clone()),
            named("q", reads.coordinates, vector.clone()),
            named("v", reads.velocities, vector),
            named("u", reads.inputs, format!("&{}", self.types.inputs)),
            format!("a: &mut [{f64}; {n}]"),
            format!("by_coordinates: &mut [{f64}; {}]", n * n),
            format!("by_rates: &mut [{f64}; {}]", n * n),
        ];
        self.writer
            .signature("fn linearize", &arguments, Some(&result));
        self.write_derivatives_by_state(&call);
        self.writer.line("Ok(())");
        self.writer.close("}");
        self.writer.close("}");
        self.impl_differentiate(&arguments, &call);
    }

    /// Writes the call, and the accelerations and their derivatives by the state from it.
    fn write_derivatives_by_state(&mut self, call: &str) {
        self.writer.line(format!("let derivatives = {call}?;"));
        self.writer.line("*a = derivatives.accelerations;");
        for name in ["by_coordinates", "by_rates"] {
            self.writer
                .line(format!("let rows = derivatives.{name}.as_flattened();"));
            self.writer.line(format!("{name}.copy_from_slice(rows);"));
        }
    }

    /// Writes `Differentiate`: the same with the derivatives by further variables.
    fn impl_differentiate(&mut self, arguments: &[String], call: &str) {
        let runtime = self.options.runtime.clone();
        let f64 = self.types.known("f64");
        let result = format!("{}<(), {runtime}::Singular>", self.types.known("Result"));
        let iterator = self.types.known("ExactSizeIterator");
        let n = self.program.dimension();
        let others = &self.program.derivatives[2 * n..];
        let names = others.iter().map(|variable| {
            let slot = match variable {
                Variable::Coordinate(i) | Variable::Rate(i) => &self.program.coordinates[*i],
                Variable::Input(i) => &self.program.inputs[*i],
                Variable::Parameter(i) => &self.program.parameters[*i],
            };
            let items = [slot.name.to_string(), slot.label().to_owned()];
            let items = items.map(|item| Layout::Atom(format!("{item:?}")));
            Layout::List(format!("{runtime}::Quantity::new("), items.to_vec(), ")")
        });
        let table = Layout::nested(names);
        let width = others.len();
        // All fields after the first two.
        let fields: Vec<&str> = self.derivative_fields()[2..]
            .iter()
            .map(|field| field.name)
            .collect();

        self.writer.gap();
        self.writer.open(format!(
            "impl {runtime}::Differentiate for {} {{",
            self.types.prepared
        ));
        let quantities = format!("impl {iterator}<Item = {runtime}::Quantity<'_>>");
        self.writer
            .signature("fn variables", &["&self".into()], Some(&quantities));
        let head = format!("let variables: [{runtime}::Quantity<'_>; {width}] = ");
        self.writer.expression(&head, &table, ";");
        self.writer.line("variables.into_iter()");
        self.writer.close("}");

        self.writer.gap();
        let mut arguments = arguments.to_vec();
        let values = if width > 0 { "by_variables" } else { "_" };
        arguments.push(format!("{values}: &mut [{f64}]"));
        self.writer
            .signature("fn differentiate", &arguments, Some(&result));
        self.write_derivatives_by_state(call);
        if width > 0 {
            self.writer.open(format!(
                "for (i, row) in by_variables.chunks_exact_mut({width}).take({n}).enumerate() {{"
            ));
            let chain = fields.iter().skip(1).fold(
                format!("derivatives.{}[i].iter()", fields[0]),
                |all, name| format!("{all}.chain(&derivatives.{name}[i])"),
            );
            self.writer
                .open(format!("for (to, from) in row.iter_mut().zip({chain}) {{"));
            self.writer.line("*to = *from;");
            self.writer.close("}");
            self.writer.close("}");
        }
        self.writer.line("Ok(())");
        self.writer.close("}");
        self.writer.close("}");
    }
}
