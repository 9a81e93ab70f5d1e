//! Tables: functions of one variable given by a file, `table("torque.csv", der(phi))`.
//!
//! Between its rows a table is the monotone cubic interpolant of F. N. Fritsch and J. Butland, *A method for
//! constructing local monotone piecewise cubic interpolants*, SIAM J. Sci. Stat. Comput. 5 (1984) 300–304, with
//! three-point slopes at its ends (the `pchip` of MATLAB and SciPy): it has no extrema besides those of the rows,
//! and a derivative everywhere.
//!
//! It is written as a sum of the increments from row to row, so that it is an expression like any
//! other, exact in rational numbers:
//!
//! ```text
//! f(x) = y₀ + Σ u (d + u (c + u b)),     u = min(max(x − xᵢ, 0), xᵢ₊₁ − xᵢ)
//! ```

use lagrangian_symbolic::{Expr, Rational};
use rustc_hash::FxHashMap;

use super::Resolver;
use super::names::declared_measure;
use super::text;
use super::value::{Scope, Value, dependence};
use crate::diagnostic::{Code, Diagnostic, Report, most_similar};
use crate::model::{Assumption, stage};
use crate::source::{Files, SourceId, Sources, Span};
use crate::syntax::{Expression, ExpressionKind, Quantity, Spec};
use crate::token::lex;
use crate::unit::Measure;

/// The largest number of rows of a table: each costs ten operations at every evaluation.
pub const ROW_LIMIT: usize = 500;

/// The longest number in a cell, in bytes.
const LONGEST_NUMBER: usize = 40;

/// The syntax of tables, for messages.
const HELP: &str = "a table is `table(\"torque.csv\", x)`, or with its column `table(\"motor.csv:torque\", x)`, and \
                    with `hold` after it keeps its first and last value beyond its ends";

/// The tables of a spec and its bases, by the source and path that name their files.
pub(super) struct Tables(FxHashMap<(SourceId, String), Result<Table, String>>);

/// The contents of a table file.
struct Table {
    columns: Vec<Column>,
}

struct Column {
    name: String,
    /// Its unit, with its text in the file.
    unit: Option<(Measure, String)>,
    values: Vec<Rational>,
}

impl Tables {
    /// Reads every file that the specs name.
    pub fn load(specs: &[Spec], files: &mut dyn Files, sources: &mut Sources) -> Tables {
        let mut tables = FxHashMap::default();
        for written in specs.iter().flat_map(|spec| &spec.tables) {
            let (file, _) = file_and_column(&written.value);
            let key = (written.span.source, file.to_owned());
            tables.entry(key).or_insert_with(|| {
                let from = sources.name(written.span.source).to_owned();
                match files.read(file, Some(&from)) {
                    Err(reason) => Err(format!("cannot read `{file}`: {reason}")),
                    Ok((name, text)) => {
                        // Registered as a source, so that a command does not overwrite a file that
                        // its spec reads.
                        sources.add(name, text.as_str());
                        Table::parse(&text).map_err(|wrong| format!("`{file}`: {wrong}"))
                    }
                }
            });
        }
        Tables(tables)
    }
}

/// Splits `motor.csv:torque`.
fn file_and_column(written: &str) -> (&str, Option<&str>) {
    match written.rsplit_once(':') {
        // A single letter before the colon is the drive of a path.
        Some((file, column)) if file.len() > 1 && !column.contains(['/', '\\']) => {
            (file, Some(column))
        }
        _ => (written, None),
    }
}

impl Table {
    /// Parses a text: a line of headers, `speed [rpm], torque [N*m]`, then rows of numbers, separated by
    /// commas or semicolons. `#` begins a comment.
    fn parse(text: &str) -> Result<Table, String> {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let lines = text.lines().zip(1..);
        let lines =
            lines.map(|(line, number)| (line.split('#').next().unwrap_or("").trim(), number));
        let mut lines = lines.filter(|(line, _)| !line.is_empty());
        let Some((header, number)) = lines.next() else {
            return Err("it has no rows".to_owned());
        };
        let separator = if header.contains(';') { ';' } else { ',' };
        let columns = header
            .split(separator)
            .map(|cell| Column::from_header(cell.trim(), number));
        let mut columns = columns.collect::<Result<Vec<_>, _>>()?;
        if columns.len() < 2 {
            return Err(format!(
                "line {number}: a table has two columns or more, found one"
            ));
        }
        for (count, (line, number)) in lines.enumerate() {
            if count == ROW_LIMIT {
                return Err(format!(
                    "it has more than {ROW_LIMIT} rows: leave out what is not needed"
                ));
            }
            let cells: Vec<&str> = line.split(separator).collect();
            if cells.len() != columns.len() {
                let (found, expected) = (cells.len(), columns.len());
                return Err(format!(
                    "line {number}: expected {expected} columns, found {found}"
                ));
            }
            for (column, cell) in columns.iter_mut().zip(cells) {
                let cell = cell.trim();
                let Some(value) = number_in(cell) else {
                    let name = &column.name;
                    return Err(format!(
                        "line {number}, column `{name}`: `{cell}` is not a number"
                    ));
                };
                column.values.push(value);
            }
            let first = &columns[0];
            if let [.., before, last] = &first.values[..]
                && before >= last
            {
                let name = &first.name;
                return Err(format!(
                    "line {number}, column `{name}`: each row must be larger than the one before"
                ));
            }
        }
        if columns[0].values.len() < 2 {
            return Err("a table has two rows or more".to_owned());
        }
        Ok(Table { columns })
    }

    /// The requested column; by default the second of two.
    fn column(&self, asked: Option<&str>) -> Result<&Column, (Code, String, Option<String>)> {
        let others = &self.columns[1..];
        let names = || others.iter().map(|column| column.name.as_str());
        let Some(asked) = asked else {
            return match others {
                [only] => Ok(only),
                _ => {
                    let message = "this table has several columns, and none is named".to_owned();
                    let names = names().collect::<Vec<_>>().join("`, `");
                    let help = format!("write `\"….csv:column\"`, with one of `{names}`");
                    Err((Code::WrongArguments, message, Some(help)))
                }
            };
        };
        others
            .iter()
            .find(|column| column.name == asked)
            .ok_or_else(|| {
                let message = format!("this table has no column `{asked}` after its first");
                let help = match most_similar(asked, names()) {
                    Some(near) => format!("did you mean `{near}`?"),
                    None => format!(
                        "its columns are `{}`",
                        names().collect::<Vec<_>>().join("`, `")
                    ),
                };
                (Code::UnknownName, message, Some(help))
            })
    }
}

impl Column {
    /// A column with a header: `torque`, `torque [N*m]`.
    fn from_header(header: &str, line: usize) -> Result<Column, String> {
        let (name, unit) = match header.split_once('[') {
            None => (header, None),
            Some((name, rest)) => {
                let unit = rest.strip_suffix(']').map(str::trim);
                let unknown = || format!("line {line}: `{header}` has no unit such as `[N*m]`");
                let unit = unit.ok_or_else(unknown)?;
                (
                    name.trim(),
                    Some((measure(unit).ok_or_else(unknown)?, unit.to_owned())),
                )
            }
        };
        if name.is_empty() || number_in(name).is_some() {
            return Err(format!(
                "line {line}: `{header}` names no column, as `torque [N*m]` does"
            ));
        }
        if unit.is_none()
            && let Some((name, unit)) = without_brackets(name)
        {
            return Err(format!(
                "line {line}: the unit of `{header}` is written in brackets, as in `{name} [{unit}]`"
            ));
        }
        Ok(Column {
            name: name.to_owned(),
            unit,
            values: Vec::new(),
        })
    }

    /// A value with the unit of the column.
    fn shown(&self, value: &Rational) -> String {
        match &self.unit {
            Some((_, unit)) if unit != "1" => format!("{} {unit}", value.to_f64()),
            _ => value.to_f64().to_string(),
        }
    }
}

/// Name and unit of a header whose unit is not in brackets: `angle/deg`, `angle (deg)`.
fn without_brackets(header: &str) -> Option<(&str, &str)> {
    let in_parentheses = || header.strip_suffix(')')?.split_once('(');
    let (name, unit) = in_parentheses().or_else(|| header.split_once('/'))?;
    let [name, unit] = [name, unit].map(str::trim);
    let is_unit = unit.contains(char::is_alphabetic) && measure(unit).is_some();
    (is_unit && !name.is_empty()).then_some((name, unit))
}

/// A number in the format of tables: `-1.5e-3`, `.5`, `+2`.
fn number_in(cell: &str) -> Option<Rational> {
    let is_number = |c: char| c.is_ascii_digit() || "+-.eE".contains(c);
    if cell.len() > LONGEST_NUMBER || !cell.chars().all(is_number) {
        return None;
    }
    let (sign, digits) = match cell.strip_prefix(['+', '-']) {
        Some(digits) if cell.starts_with('-') => ("-", digits),
        Some(digits) => ("", digits),
        None => ("", cell),
    };
    let leading_zero = if digits.starts_with('.') { "0" } else { "" };
    Rational::parse_decimal(&format!("{sign}{leading_zero}{digits}"))
}

/// The measure of a unit as a spec would write it.
fn measure(unit: &str) -> Option<Measure> {
    let (mut sources, mut report) = (Sources::new(), Report::new());
    let texts = [unit, "0"].map(|text| {
        let source = sources.add("a unit", text);
        (source, lex(source, text, &mut report))
    });
    let [unit, zero] = &texts;
    let written = Quantity::parse([(unit.0, &unit.1), (zero.0, &zero.1)], &mut report);
    if report.has_errors() {
        None
    } else {
        declared_measure(&written)
    }
}

/// The coefficients of `u (d + u (c + u b))` after each row except the last.
fn cubics(x: &[Rational], y: &[Rational]) -> Option<Vec<[Rational; 3]>> {
    let pairs = |list: &[Rational]| -> Vec<Rational> {
        list.windows(2).map(|pair| &pair[1] - &pair[0]).collect()
    };
    let (widths, rises) = (pairs(x), pairs(y));
    let slopes = rises
        .iter()
        .zip(&widths)
        .map(|(rise, width)| rise.checked_div(width));
    let slopes: Vec<Rational> = slopes.collect::<Option<_>>()?;
    let (two, three) = (Rational::from(2), Rational::from(3));
    let last = slopes.len() - 1;
    let mut tangents = Vec::with_capacity(x.len());
    tangents.push(match last {
        0 => slopes[0].clone(),
        _ => end_slope([&widths[0], &widths[1]], [&slopes[0], &slopes[1]])?,
    });
    for k in 1..=last {
        let ([h0, h1], [s0, s1]) = ([&widths[k - 1], &widths[k]], [&slopes[k - 1], &slopes[k]]);
        let agree = !(s0 * s1).is_negative() && !s0.is_zero() && !s1.is_zero();
        tangents.push(if agree {
            // The harmonic mean, weighted by the lengths of both sides.
            let (w0, w1) = (&(&two * h1) + h0, &(&two * h0) + h1);
            let over = &w0.checked_div(s0)? + &w1.checked_div(s1)?;
            (&w0 + &w1).checked_div(&over)?
        } else {
            Rational::ZERO
        });
    }
    tangents.push(match last {
        0 => slopes[0].clone(),
        _ => end_slope(
            [&widths[last], &widths[last - 1]],
            [&slopes[last], &slopes[last - 1]],
        )?,
    });
    let cubic = |k: usize| {
        let (h, s, [d0, d1]) = (&widths[k], &slopes[k], [&tangents[k], &tangents[k + 1]]);
        let second = &(&three * s) - &(&(&two * d0) + d1);
        let third = &(d0 + d1) - &(&two * s);
        let square = h * h;
        Some([
            d0.clone(),
            second.checked_div(h)?,
            third.checked_div(&square)?,
        ])
    };
    (0..=last).map(cubic).collect()
}

/// The slope at an end, from the parabola through three rows, limited to avoid overshoot.
fn end_slope([h0, h1]: [&Rational; 2], [s0, s1]: [&Rational; 2]) -> Option<Rational> {
    let (two, three) = (Rational::from(2), Rational::from(3));
    let first = &(&(&two * h0) + h1) * s0;
    let slope = (&first - &(h0 * s1)).checked_div(&(h0 + h1))?;
    let limit = &three * s0;
    Some(match () {
        () if slope.signum() != s0.signum() => Rational::ZERO,
        () if s0.signum() != s1.signum() && slope.abs() > limit.abs() => limit,
        () => slope,
    })
}

/// What a table is called with.
struct TableCall<'a> {
    file: &'a Expression,
    /// The path, with the column if there is a choice.
    written: &'a str,
    argument: &'a Expression,
    hold: bool,
}

impl<'a, 'd, 'r> Resolver<'a, 'd, 'r> {
    /// `table("torque.csv", x)`, with an optional `hold`.
    pub(super) fn table(
        &mut self,
        arguments: &'a [Expression],
        span: Span,
        scope: Scope<'a>,
    ) -> Value<'d> {
        let Some(call) = self.table_call(arguments, span) else {
            return Value::Unknown;
        };
        let (argument, hold) = (call.argument, call.hold);
        let (path, asked) = file_and_column(call.written);
        let Some([first, column]) = self.table_columns(call.file, path, asked) else {
            return Value::Unknown;
        };
        let unit = first.unit.as_ref().map(|(measure, _)| measure.unit);
        let Some(x) = self.scalar(argument, scope.with_expected_unit(unit)) else {
            return Value::Unknown;
        };
        let mut at = x.expr;
        if let Some((measure, _)) = &first.unit {
            let why = format!("`{}` of `{path}` is in this unit", first.name);
            self.require_unit(x.unit, measure.unit, argument.span, &why);
            self.refuse_varying_number(&x, measure.unit, argument.span);
            // A bare number is in the unit of the table.
            if x.unit.is_some() && !measure.is_si() {
                at = measure.of_si(self.dag) * at;
            }
        }
        if !hold && !self.stays_within((first, path), at, argument, scope) {
            return Value::Unknown;
        }
        let Some(value) = self.interpolated([first, column], at, hold) else {
            let message = format!("the numbers of `{path}` are too long");
            self.error(Code::NumberOutOfRange, call.file.span, message);
            return Value::Unknown;
        };
        match &column.unit {
            None => self.finish(value, None, None, span),
            Some((measure, _)) => {
                let value = measure.in_si(self.dag) * value;
                self.finish(value, Some(measure.unit), None, span)
            }
        }
    }

    /// The arguments of a table.
    fn table_call(&mut self, arguments: &'a [Expression], span: Span) -> Option<TableCall<'a>> {
        let (file, argument, hold) = match arguments {
            [file, argument] => (file, argument, None),
            [file, argument, hold] => (file, argument, Some(hold)),
            _ => {
                let message = format!(
                    "`table` takes a file and a number, found {}",
                    arguments.len()
                );
                let diagnostic = Diagnostic::new(Code::WrongArguments, span, message);
                self.push(diagnostic.help(HELP));
                return None;
            }
        };
        let ExpressionKind::Text(written) = &file.kind else {
            if file.kind != ExpressionKind::Error {
                let message = "the file of a table is expected here, in quotes";
                let diagnostic = Diagnostic::new(Code::WrongArguments, file.span, message);
                self.push(diagnostic.help(HELP));
            }
            return None;
        };
        if let Some(hold) = hold {
            let is_hold = matches!(&hold.kind, ExpressionKind::Name(name)
                if name.index.is_none() && name.base.text == "hold");
            if !is_hold {
                let message =
                    "only `hold` is allowed here: without it a table has no values beyond its ends";
                let diagnostic = Diagnostic::new(Code::WrongArguments, hold.span, message);
                self.push(diagnostic.help(HELP));
                return None;
            }
        }
        Some(TableCall {
            file,
            written,
            argument,
            hold: hold.is_some(),
        })
    }

    /// The first column of a table, and the one that is asked for.
    fn table_columns(
        &mut self,
        file: &Expression,
        path: &str,
        asked: Option<&str>,
    ) -> Option<[&'r Column; 2]> {
        let tables: Option<&'r Tables> = self.tables;
        let found = tables.and_then(|all| all.0.get(&(file.span.source, path.to_owned())));
        let table = match found {
            Some(Ok(table)) => table,
            Some(Err(message)) => {
                let diagnostic = Diagnostic::new(Code::UnreadableFile, file.span, message.clone());
                self.push(diagnostic.help("the path is relative to the file that contains it"));
                return None;
            }
            None => {
                let message = "a table is read only if a spec names it";
                let diagnostic = Diagnostic::new(Code::UnreadableFile, file.span, message);
                self.push(diagnostic.help("name it there: `define { characteristic = table(…) }`"));
                return None;
            }
        };
        match table.column(asked) {
            Ok(column) => Some([&table.columns[0], column]),
            Err((code, message, help)) => {
                let diagnostic = Diagnostic::new(code, file.span, message);
                self.push(super::names::with_help(diagnostic, help));
                None
            }
        }
    }

    /// Records that the argument stays within the ends of the table; a run ends where it does not. Returns
    /// false if that was refused.
    fn stays_within(
        &mut self,
        (first, path): (&Column, &str),
        at: Expr<'d>,
        argument: &'a Expression,
        scope: Scope<'a>,
    ) -> bool {
        if at.stage() > stage::VELOCITY {
            let of = dependence(at.stage());
            let message = format!("a run cannot check that {of} stay between the ends of a table");
            let diagnostic = Diagnostic::new(Code::ForbiddenDependence, argument.span, message);
            self.push(diagnostic.help("state what holds beyond them: `table(\"…\", x, hold)`"));
            return false;
        }
        let [begin, .., end] = &first.values[..] else {
            return false;
        };
        let bounds = [(begin, ">="), (end, "<=")];
        for (bound, sign) in bounds {
            let bound_here = self.dag.constant(bound.clone());
            let excess = match sign {
                ">=" => at - bound_here,
                _ => bound_here - at,
            };
            if excess
                .as_constant()
                .is_some_and(|excess| excess.is_negative())
            {
                let message = format!("this is beyond the end of `{path}`, {}", first.shown(bound));
                let diagnostic = Diagnostic::new(Code::OutsideDomain, argument.span, message);
                self.push(diagnostic.help(HELP));
                return false;
            }
            let shown = text::shown(argument, scope.index);
            self.add_fact(Assumption {
                text: format!("{shown} {sign} {}, the end of {path}", first.shown(bound)),
                excess,
                strict: false,
                span: argument.span,
            });
        }
        true
    }

    /// The value of a column at an argument of the first column, in the units of the table.
    fn interpolated(
        &self,
        [first, column]: [&Column; 2],
        at: Expr<'d>,
        hold: bool,
    ) -> Option<Expr<'d>> {
        let constant = |value: &Rational| self.dag.constant(value.clone());
        let x = &first.values;
        let cubics = cubics(x, &column.values)?;
        let last = cubics.len() - 1;
        let mut terms = Vec::with_capacity(x.len());
        terms.push(constant(&column.values[0]));
        for (k, [d, c, b]) in cubics.iter().enumerate() {
            let mut u = at - constant(&x[k]);
            if k > 0 || hold {
                u = u.max(self.dag.zero());
            }
            if k < last || hold {
                u = u.min(constant(&(&x[k + 1] - &x[k])));
            }
            terms.push(u * (constant(d) + u * (constant(c) + u * constant(b))));
        }
        Some(self.dag.sum(terms))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wrong(text: &str) -> String {
        Table::parse(text).err().expect("something is wrong")
    }

    #[test]
    fn tables_have_headers_with_units_and_rows_of_numbers() {
        let text =
            "\u{feff}# measured\nspeed [rpm]; torque [N*m] ; note\n-1;.5;2e3 # here\n\n+2.5;-3;0\n";
        let table = Table::parse(text).expect("a table");
        let names: Vec<_> = table
            .columns
            .iter()
            .map(|column| column.name.as_str())
            .collect();
        assert_eq!(names, ["speed", "torque", "note"]);
        let values: Vec<f64> = table
            .columns
            .iter()
            .flat_map(|c| &c.values)
            .map(Rational::to_f64)
            .collect();
        assert_eq!(values, [-1.0, 2.5, 0.5, -3.0, 2000.0, 0.0]);
        let (measure, unit) = table.columns[0].unit.as_ref().expect("a unit");
        assert!((measure.to_f64() - std::f64::consts::PI / 30.0).abs() < 1e-16);
        assert_eq!(unit, "rpm");
        assert!(table.columns[2].unit.is_none());
    }

    #[test]
    fn what_is_wrong_in_a_table_is_said_with_its_place() {
        assert!(wrong("").contains("no rows"));
        assert!(wrong("a\n1\n").contains("line 1: a table has two columns"));
        assert!(wrong("1, 2\n3, 4\n").contains("line 1: `1` names no column"));
        assert!(wrong("x, y [furlong]\n").contains("line 1: `y [furlong]` has no unit"));
        assert!(wrong("x, y\n1, 2\n").contains("two rows"));
        assert!(wrong("x, y\n1, 2\n1, 3\n").contains("line 3, column `x`: each row"));
        assert!(
            wrong("x, y\n1, 2\n2, two\n").contains("line 3, column `y`: `two` is not a number")
        );
        assert!(wrong("x, y\n1, 2\n2\n").contains("line 3: expected 2 columns, found 1"));
        let many: String = (0..=ROW_LIMIT).map(|k| format!("{k},0\n")).collect();
        assert!(wrong(&format!("x,y\n{many}")).contains("more than 500 rows"));
    }

    #[test]
    fn a_column_stands_behind_a_colon_and_no_drive_or_folder_does() {
        assert_eq!(file_and_column("a.csv"), ("a.csv", None));
        assert_eq!(file_and_column("a.csv:torque"), ("a.csv", Some("torque")));
        assert_eq!(file_and_column("C:/a.csv"), ("C:/a.csv", None));
        assert_eq!(file_and_column("C:a.csv"), ("C:a.csv", None));
    }
}
