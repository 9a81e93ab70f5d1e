//! Laws of inputs as a call writes them: formulas, tables in files, and sampled controllers.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use lagrangian::interpreted::{InterpretedMachine, Signal, Signals, TableFile};
use lagrangian::{Extrapolation, Interpolation, Table};
use lagrangian_spec::diagnostic::{Report, most_similar};
use lagrangian_spec::model::Model;
use lagrangian_spec::resolve::value_in;
use lagrangian_spec::source::Sources;

use crate::plan::Law;
use crate::table;

/// The text after `--input NAME=`, parsed.
#[derive(Clone, Debug, PartialEq)]
pub enum InputArgument {
    /// A formula of the spec's language.
    Formula(String),
    /// A formula that is evaluated once in each period; its value takes effect after a delay and holds until the
    /// next one. Times in s.
    Sampled {
        /// The formula.
        formula: String,
        /// The sampling period.
        every: f64,
        /// The delay after a sample until its value takes effect.
        delay: f64,
    },
    /// A column of a table in a file.
    File {
        /// The file, `.csv` or `.parquet`.
        path: PathBuf,
        /// The column; by default the one with the name of the input.
        column: Option<String>,
        /// The interpolation between rows.
        between: Interpolation,
        /// The extrapolation before the first and after the last row.
        beyond: Extrapolation,
    },
}

/// Reads `FORMULA`, `FORMULA,every=TIME[,delay=TIME]` or `FILE[:COLUMN][,hold|linear|cubic][,end=hold|error|repeat]`.
///
/// # Errors
/// If the text is malformed: what is wrong, and what is expected instead.
pub fn parse_input(text: &str) -> Result<InputArgument, String> {
    let text = text.trim();
    let Some(end) = end_of_table_name(text, &[',', ':']) else {
        return formula(text);
    };
    let (path, rest) = text.split_at(end);
    let (column, options) = match rest.strip_prefix(':') {
        Some(rest) => {
            let column = parts(rest).first().copied().unwrap_or_default();
            if column.trim().is_empty() {
                return Err("expected the name of a column after `:`".into());
            }
            (Some(column.trim().to_owned()), &rest[column.len()..])
        }
        None => (None, rest),
    };
    let (mut between, mut beyond) = (None, None);
    for option in parts(options).into_iter().skip(1).map(str::trim) {
        let is_repeated = match option {
            "hold" => between.replace(Interpolation::Hold).is_some(),
            "linear" => between.replace(Interpolation::Linear).is_some(),
            "cubic" => between.replace(Interpolation::Cubic).is_some(),
            "end=hold" => beyond.replace(Extrapolation::Hold).is_some(),
            "end=error" => beyond.replace(Extrapolation::Error).is_some(),
            "end=repeat" => beyond.replace(Extrapolation::Repeat).is_some(),
            _ => {
                let near = most_similar(option, FILE_OPTIONS.iter().copied());
                let near = near.map(|near| format!("; did you mean `{near}`?"));
                return Err(format!(
                    "`{option}` is not an option of a table: {}{}",
                    FILE_OPTIONS.join(", "),
                    near.unwrap_or_default()
                ));
            }
        };
        if is_repeated {
            return Err(format!(
                "`{option}` is given beside another option of its kind"
            ));
        }
    }
    Ok(InputArgument::File {
        path: PathBuf::from(path),
        column,
        between: between.unwrap_or_default(),
        beyond: beyond.unwrap_or_default(),
    })
}

const FILE_OPTIONS: [&str; 6] = [
    "hold",
    "linear",
    "cubic",
    "end=hold",
    "end=error",
    "end=repeat",
];

/// The end of the name of a table at the beginning of a text, where the text ends or one of `next` follows; `None` if there is no such name.
pub fn end_of_table_name(text: &str, next: &[char]) -> Option<usize> {
    let lower = text.to_ascii_lowercase();
    let ends = [".csv", ".parquet"].iter().flat_map(|ending| {
        let found = lower.match_indices(ending);
        found.map(|(at, ending)| at + ending.len())
    });
    let is_end = |end: &usize| {
        let rest = text.get(*end..);
        rest.is_some_and(|rest| rest.is_empty() || rest.starts_with(next))
    };
    ends.filter(is_end).min()
}

/// The parts between commas that are not inside brackets.
fn parts(text: &str) -> Vec<&str> {
    let mut depth = 0_i32;
    let parts = text.split(|c: char| {
        match c {
            '(' | '[' => depth += 1,
            ')' | ']' => depth -= 1,
            _ => {}
        }
        c == ',' && depth == 0
    });
    parts.collect()
}

fn formula(text: &str) -> Result<InputArgument, String> {
    let parts = parts(text);
    let formula = parts.first().copied().unwrap_or_default().trim().to_owned();
    if formula.is_empty() {
        return Err("expected a formula or a table `.csv` or `.parquet`".into());
    }
    let (mut every, mut delay) = (None, None);
    for option in parts.iter().skip(1).map(|part| part.trim()) {
        let (name, value) = option.split_once('=').unwrap_or((option, ""));
        let time = |least: f64| {
            let (mut sources, mut report) = (Sources::new(), Report::new());
            let time = value_in(value.trim(), "s", &mut sources, &mut report);
            let messages = report.diagnostics().into_iter();
            let messages: Vec<String> = messages.map(|wrong| wrong.message.clone()).collect();
            match time {
                Some(time) if time.is_finite() && time >= least => Ok(time),
                Some(_) if least == 0.0 => Err(format!("`{option}`: a delay must not be negative")),
                Some(_) => Err(format!("`{option}`: a period must be greater than 0")),
                None => Err(format!("`{option}`: {}", messages.join("; "))),
            }
        };
        let is_repeated = match name.trim() {
            "every" => every.replace(time(f64::MIN_POSITIVE)?).is_some(),
            "delay" => delay.replace(time(0.0)?).is_some(),
            _ => {
                return Err(format!(
                    "`{option}` follows a formula, after which only `every=TIME` and `delay=TIME` may stand"
                ));
            }
        };
        if is_repeated {
            return Err(format!("`{name}` is given twice"));
        }
    }
    match (every, delay) {
        (None, None) => Ok(InputArgument::Formula(formula)),
        (Some(every), delay) => Ok(InputArgument::Sampled {
            formula,
            every,
            delay: delay.unwrap_or(0.0),
        }),
        (None, Some(_)) => {
            Err("a formula can have a delay only where it is sampled: add `every=TIME`".into())
        }
    }
}

/// Reads a table from a file, as comma-separated text or Parquet according to its ending.
///
/// # Errors
/// If the file cannot be read: what is wrong with it.
pub fn table_file(path: &Path) -> Result<TableFile, String> {
    let shown = path.display().to_string();
    let is_parquet = path
        .extension()
        .is_some_and(|ending| ending.eq_ignore_ascii_case("parquet"));
    let unread = |error: std::io::Error| format!("cannot read {shown}: {error}");
    let file = if is_parquet {
        let cells = table::cells(path).map_err(unread)?;
        TableFile::from_cells(&shown, cells)
    } else {
        let bytes = std::fs::read(path).map_err(unread)?;
        TableFile::from_bytes(&shown, &bytes)
    };
    file.map_err(|wrong| wrong.to_string())
}

impl InputArgument {
    /// The file that the law reads.
    pub fn file(&self) -> Option<&Path> {
        match self {
            InputArgument::File { path, .. } => Some(path),
            _ => None,
        }
    }

    /// The law of an input with this name and unit.
    ///
    /// # Errors
    /// If its table is invalid: what is wrong with it.
    pub fn law(&self, input: &str, unit: &str) -> Result<Law, String> {
        Ok(match self {
            InputArgument::Formula(formula) => Law::Formula(formula.clone()),
            InputArgument::Sampled {
                formula,
                every,
                delay,
            } => Law::Sampled {
                formula: formula.clone(),
                every: *every,
                delay: *delay,
            },
            InputArgument::File {
                path,
                column,
                between,
                beyond,
            } => {
                let shown = path.display().to_string();
                let file = table_file(path)?;
                let column = column.as_deref().unwrap_or(input);
                let read = file.column(column, unit);
                let (times, values) = read.map_err(|wrong| wrong.to_string())?;
                let law = Law::Table {
                    times,
                    values,
                    between: *between,
                    beyond: *beyond,
                };
                law.table(input).map_err(|why| format!("{shown}: {why}"))?;
                law
            }
        })
    }
}

impl Law {
    /// The formula of the law, if it has one.
    pub fn formula(&self) -> Option<&str> {
        match self {
            Law::Formula(formula) | Law::Sampled { formula, .. } => Some(formula),
            Law::Table { .. } => None,
        }
    }

    /// The table of the law, if it has one, for this input.
    pub(crate) fn table(&self, input: &str) -> Result<Option<Table>, String> {
        let Law::Table {
            times,
            values,
            between,
            beyond,
        } = self
        else {
            return Ok(None);
        };
        let table = Table::new(*between, *beyond, times.clone(), values.clone());
        let table = table.map_err(|wrong| wrong.to_string())?;
        Ok(Some(table.named(format!("the table of input {input}"))))
    }
}

/// The laws of inputs; the name of a family stands for all its members.
///
/// # Errors
/// If there is no such input, with a similar name as suggestion, or if a table is invalid.
pub fn laws(
    written: &[(String, InputArgument)],
    model: &Model<'_>,
) -> Result<Vec<(String, Law)>, String> {
    let inputs = || {
        let inputs = model.inputs.iter();
        inputs.map(|input| (input.name.to_string(), input.unit_text.as_str()))
    };
    let mut laws: Vec<(String, Law)> = Vec::new();
    for (name, what) in written {
        let is_meant = |own: &str| {
            own == name
                || own
                    .split_once('[')
                    .is_some_and(|(base, _)| base == name.as_str())
        };
        let meant: Vec<(String, &str)> = inputs().filter(|(own, _)| is_meant(own)).collect();
        if meant.is_empty() {
            return Err(unknown_input(name, model));
        }
        for (own, unit) in meant {
            let law = what.law(&own, unit);
            laws.push((own, law.map_err(|why| format!("--input {name}: {why}"))?));
        }
    }
    Ok(laws)
}

/// The message for an unknown input.
pub(crate) fn unknown_input(name: &str, model: &Model<'_>) -> String {
    let names: Vec<String> = model
        .inputs
        .iter()
        .map(|input| input.name.to_string())
        .collect();
    let near = most_similar(name, names.iter().map(String::as_str));
    let help = match (near, names.is_empty()) {
        (Some(near), _) => format!("did you mean `{near}`?"),
        (None, true) => "the machine has none".into(),
        (None, false) => format!("there are: {}", names.join(", ")),
    };
    format!("--input {name}: no input named `{name}`; {help}")
}

/// The signals of a machine. Their formulas are outputs whose indices `next` counts in order.
///
/// # Errors
/// If a signal is not possible: which one, and why.
pub fn signals(
    laws: &[(String, Law)],
    machine: &InterpretedMachine,
    mut next: impl FnMut() -> usize,
) -> Result<Signals, String> {
    let inputs: Vec<String> = machine
        .program()
        .inputs
        .iter()
        .map(|input| input.name.to_string())
        .collect();
    let (mut driven, mut sampled, mut sampling) = (Vec::new(), Vec::new(), None);
    for (name, law) in laws {
        let signal = match law.table(name) {
            Err(why) => return Err(format!("--input {name}: {why}")),
            Ok(Some(table)) => Signal::Table(Arc::new(table)),
            Ok(None) => Signal::Output(next()),
        };
        let Some(place) = inputs.iter().position(|input| input == name) else {
            return Err(format!("--input {name}: no input named `{name}`"));
        };
        match law {
            Law::Sampled { every, delay, .. } => {
                let own = [*every, *delay];
                if *sampling.get_or_insert(own) != own {
                    return Err(format!(
                        "--input {name}: all sampled inputs must have the same period and the same delay"
                    ));
                }
                sampled.push((place, signal));
            }
            _ => driven.push((place, signal)),
        }
    }
    let wrong = |wrong: lagrangian::interpreted::SignalError| format!("--input: {wrong}");
    let signals = Signals::new(machine, driven).map_err(wrong)?;
    match sampling {
        None => Ok(signals),
        Some(sampling) => signals
            .and_sampled(machine, sampled, sampling)
            .map_err(wrong),
    }
}

/// Why signals have no Taylor series; `None` if they have one.
pub fn without_series(signals: &Signals, machine: &InterpretedMachine) -> Option<String> {
    let input = signals.first_varying()?;
    let name = machine.program().inputs.get(input)?.name.to_string();
    Some(format!(
        "input `{name}` changes continuously, and not only at instants"
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_stands_behind_an_input_is_told_apart() {
        let file = |path: &str, column: Option<&str>, between, beyond| {
            Ok(InputArgument::File {
                path: path.into(),
                column: column.map(str::to_owned),
                between,
                beyond,
            })
        };
        let sampled = |formula: &str, every: f64, delay: f64| {
            Ok(InputArgument::Sampled {
                formula: formula.into(),
                every,
                delay,
            })
        };
        let formula = |text: &str| Ok(InputArgument::Formula(text.into()));
        for (text, known) in [
            ("0.5*sin(10*t)", formula("0.5*sin(10*t)")),
            ("max(x, y)", formula("max(x, y)")),
            ("-5*x,every=1*ms", sampled("-5*x", 1e-3, 0.0)),
            (
                "max(x,y), every=0.1, delay=20*ms",
                sampled("max(x,y)", 0.1, 0.02),
            ),
            (
                "a.csv",
                file("a.csv", None, Interpolation::Linear, Extrapolation::Hold),
            ),
            (
                "a,b (1).CSV:q[1,2],hold,end=repeat",
                file(
                    "a,b (1).CSV",
                    Some("q[1,2]"),
                    Interpolation::Hold,
                    Extrapolation::Repeat,
                ),
            ),
            (
                "C:\\runs\\a.csv.parquet:push,end=error,cubic",
                file(
                    "C:\\runs\\a.csv.parquet",
                    Some("push"),
                    Interpolation::Cubic,
                    Extrapolation::Error,
                ),
            ),
        ] {
            assert_eq!(parse_input(text), known, "{text}");
        }
        for (text, why) in [
            ("", "expected a formula"),
            ("a.csv,holds", "did you mean `hold`?"),
            ("a.csv,hold,linear", "beside another option"),
            ("a.csv:,hold", "the name of a column"),
            ("x,every=0", "a period must be greater than 0"),
            ("x,every=1*m", "expected s, found m"),
            ("x,delay=1*ms", "where it is sampled"),
            ("x,every=1,delay=-1", "a delay must not be negative"),
            ("x,every=1,every=1", "given twice"),
            ("x,often", "`every=TIME`"),
        ] {
            let message = parse_input(text).expect_err(text);
            assert!(message.contains(why), "{text}: {message}");
        }
    }
}
