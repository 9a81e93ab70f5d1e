//! The measurements: tables in files, and the settings that a call gives for each.

use std::collections::BTreeSet;
use std::path::PathBuf;

use lagrangian::interpreted::{InterpretedMachine, Named, Signals};
use lagrangian::{Machine, State, System, UnknownName};
use lagrangian_fit::least_squares::Trouble;
use lagrangian_fit::motion::{Chart, Column, Experiment, Fit, Quantity};
use lagrangian_mechanics::Compiled;
use lagrangian_spec::diagnostic::{Severity, most_similar};
use lagrangian_spec::unit::{self, state_of};
use lagrangian_sweep::signals::{self, InputArgument};

use crate::call::{self, Assignment};
use crate::failure::{Failure, help_with};
use crate::output;
use crate::reading;

/// A file of measurements with the settings of the call: `run.csv,start(phi)=0.3,m=2,torque=run.csv:u`.
pub struct Given {
    /// The file.
    pub path: PathBuf,
    /// Its name in messages.
    pub label: String,
    /// Parameters and inputs that differ in this experiment.
    pub sets: Vec<Assignment>,
    /// Starts of coordinates and rates that differ in this experiment.
    pub starts: [Vec<Assignment>; 2],
    /// Tables that drive inputs.
    pub inputs: Vec<(String, InputArgument)>,
}

/// The measurements with the same name, in all experiments.
#[derive(Clone)]
pub struct Class {
    pub name: String,
    pub unit: String,
    pub quantity: Quantity,
}

/// The files of a call.
///
/// # Errors
/// If the call is invalid.
pub fn read_all(call: &call::Fit) -> Result<Vec<Given>, Failure> {
    let mut all: Vec<Given> = Vec::new();
    for text in &call.data {
        let experiment =
            read(text).map_err(|why| Failure::Call(format!("--data {text}: {why}")))?;
        if all.iter().any(|other| other.path == experiment.path) {
            return Err(Failure::Call(format!(
                "--data names {} more than once: its measurements would count twice",
                experiment.label
            )));
        }
        all.push(experiment);
    }
    Ok(all)
}

/// Reads `FILE[,NAME=VALUE…]`.
fn read(text: &str) -> Result<Given, String> {
    let wanted =
        "expected a table `.csv` or `.parquet`, followed by NAME=VALUE separated by commas";
    let (path, rest) = text.split_at(signals::end_of_table_name(text, &[',']).ok_or(wanted)?);
    let mut given = Given {
        path: PathBuf::from(path),
        label: path.to_owned(),
        sets: Vec::new(),
        starts: [Vec::new(), Vec::new()],
        inputs: Vec::new(),
    };
    let mut names = BTreeSet::new();
    for text in settings(rest).ok_or(wanted)? {
        let set = call::assignment(&text)?;
        if !names.insert(set.name.clone()) {
            return Err(format!("`{}` is set more than once", set.name));
        }
        given.take(set)?;
    }
    // Whole families precede their members, in whichever order they are given.
    let [starts, rates] = &mut given.starts;
    for list in [&mut given.sets, starts, rates] {
        list.sort_by_key(|set| set.name.contains('['));
    }
    Ok(given)
}

/// The settings behind the name of a table, each with its options; `None` if options come first.
fn settings(rest: &str) -> Option<Vec<String>> {
    let mut settings: Vec<String> = Vec::new();
    let mut depth = 0_i32;
    let parts = rest.split(|c: char| {
        match c {
            '(' | '[' => depth += 1,
            ')' | ']' => depth -= 1,
            _ => {}
        }
        c == ',' && depth == 0
    });
    for part in parts.skip(1) {
        let name = part.split_once('=').map(|(name, _)| name.trim());
        // Options of a table or of a controller follow it.
        let is_option = !matches!(name, Some(name) if !["end", "every", "delay"].contains(&name));
        if !is_option {
            settings.push(part.to_owned());
            continue;
        }
        let last = settings.last_mut()?;
        last.push(',');
        last.push_str(part);
    }
    Some(settings)
}

impl Given {
    /// Takes a setting: of a start, of the table that drives an input, or of a parameter.
    fn take(&mut self, set: Assignment) -> Result<(), String> {
        let inside = |word: &str| {
            let rest = set.name.strip_prefix(word)?.strip_prefix('(')?;
            Some(rest.strip_suffix(')')?.trim().to_owned())
        };
        if let Some(name) = inside("start") {
            self.starts[0].push(Assignment { name, ..set });
            return Ok(());
        }
        if let Some(name) = inside("rate") {
            self.starts[1].push(Assignment { name, ..set });
            return Ok(());
        }
        match signals::parse_input(&set.value) {
            Ok(written @ InputArgument::File { .. }) => self.inputs.push((set.name, written)),
            Ok(InputArgument::Sampled { .. }) => {
                return Err(format!(
                    "`{}`: a controller is the same in all experiments: give it by --input",
                    set.name
                ));
            }
            Ok(InputArgument::Formula(_)) | Err(_) => self.sets.push(set),
        }
        Ok(())
    }

    /// The experiment without measurements. `start` holds the starts that the call gives for all experiments, and NaN elsewhere.
    ///
    /// # Errors
    /// If a name or a value is invalid.
    pub fn experiment(
        &self,
        machine: &InterpretedMachine,
        compiled: &Compiled<'_>,
        start: &State<Named>,
        (chart, signals): (Option<&Chart>, Signals),
    ) -> Result<Experiment, Failure> {
        let option = format!("--data {}:", self.label);
        let machine = self.machine(&option, machine, compiled)?;
        let start = self.start(&option, start)?;
        let known_numbers = |numbers: &Named| {
            numbers
                .values
                .iter()
                .map(|x| (!x.is_nan()).then_some(*x))
                .collect()
        };
        Ok(Experiment {
            name: self.label.clone(),
            start: [known_numbers(&start.q), known_numbers(&start.v)],
            chart: chart.map(|chart| self.chart(chart, &option)).transpose()?,
            machine,
            signals,
            times: Vec::new(),
            columns: Vec::new(),
        })
    }

    /// The machine with the parameters and inputs of this experiment; `option` is what messages begin with.
    fn machine(
        &self,
        option: &str,
        machine: &InterpretedMachine,
        compiled: &Compiled<'_>,
    ) -> Result<InterpretedMachine, Failure> {
        let wrong = |why: String| Failure::Call(format!("{option} {why}"));
        let mut machine = machine.clone();
        for set in &self.sets {
            let Some(unit) = machine.unit(&set.name).map(str::to_owned) else {
                let known: Vec<String> =
                    machine.parameters().map(|(of, _)| of.name.into()).collect();
                let help = match most_similar(&set.name, known.iter().map(String::as_str)) {
                    Some(near) => format!("did you mean `{near}`?"),
                    None => "start values are given as start(NAME) and rate(NAME)".into(),
                };
                let why = format!("no parameter or input named `{}`; {help}", set.name);
                return Err(wrong(why));
            };
            let value = set.value(option, &unit).map_err(Failure::Call)?;
            machine
                .set(&set.name, value)
                .map_err(|unknown| wrong(unknown.to_string()))?;
        }
        if !self.sets.is_empty()
            && let Some(why) = refusal(compiled, machine.parameter_values())
        {
            return Err(wrong(why));
        }
        Ok(machine)
    }

    /// The start with the values of this experiment.
    fn start(&self, option: &str, start: &State<Named>) -> Result<State<Named>, Failure> {
        let unknown = |unknown: UnknownName| Failure::Call(format!("{option} {unknown}"));
        let mut start = start.clone();
        let [starts, rates] = &self.starts;
        for set in starts {
            // A state of first order is the rate of its integral.
            if let Some((integral, unit)) = reading::state_named(&start.v, &set.name) {
                let value = set.value(option, &unit).map_err(Failure::Call)?;
                start.v.set(&integral, value).map_err(unknown)?;
                continue;
            }
            let unit = start.q.unit(&set.name).unwrap_or_default().to_owned();
            start.q.clone().set(&set.name, 0.0).map_err(unknown)?;
            let value = set.value(option, &unit).map_err(Failure::Call)?;
            start.q.set(&set.name, value).map_err(unknown)?;
        }
        for set in rates {
            let unit = start.v.unit(&set.name).unwrap_or_default();
            let unit = format!("({unit})/s");
            start.v.clone().set(&set.name, 0.0).map_err(unknown)?;
            let value = set.value(option, &unit).map_err(Failure::Call)?;
            start.v.set(&set.name, value).map_err(unknown)?;
        }
        Ok(start)
    }

    /// The machine in Cartesian coordinates with what differs in this experiment.
    fn chart(&self, chart: &Chart, option: &str) -> Result<Chart, Failure> {
        let mut chart = chart.clone();
        for set in &self.sets {
            let unit = chart.machine.unit(&set.name).map(str::to_owned);
            let value = set.value(option, &unit.unwrap_or_default());
            // The name was checked for the machine of the spec.
            let _ = chart.machine.set(&set.name, value.map_err(Failure::Call)?);
        }
        Ok(chart)
    }
}

/// Why the spec does not allow these parameters, if it does not.
pub fn refusal(compiled: &Compiled<'_>, parameters: &[f64]) -> Option<String> {
    let diagnostics = compiled.model.parameter_diagnostics(parameters);
    let wrong = diagnostics
        .iter()
        .find(|diagnostic| diagnostic.code.severity() == Severity::Error);
    wrong.map(|wrong| format!("{} [{}]", wrong.message, wrong.code))
}

/// All measurable quantities of a machine.
fn measurable(machine: &InterpretedMachine, compiled: &Compiled<'_>) -> Vec<Class> {
    let system = machine.prepare();
    let mut all = Vec::new();
    for (i, of) in system.coordinates().enumerate() {
        // A state of first order is the rate of its integral, which is not measurable.
        if let Some(state) = state_of(of.name) {
            all.push(Class {
                name: state,
                unit: unit::rate_unit(of.name, of.unit),
                quantity: Quantity::Rate(i),
            });
            continue;
        }
        all.push(Class {
            name: of.name.to_owned(),
            unit: of.unit.to_owned(),
            quantity: Quantity::Coordinate(i),
        });
        all.push(Class {
            name: format!("der({})", of.name),
            unit: unit::rate_unit(of.name, of.unit),
            quantity: Quantity::Rate(i),
        });
    }
    let outputs = &machine.program().outputs[..compiled.model.outputs.len()];
    for (i, slot) in outputs.iter().enumerate() {
        all.push(Class {
            name: slot.name.to_string(),
            unit: slot.label(),
            quantity: Quantity::Output(i),
        });
    }
    all
}

/// Reads the measurements into the experiments, and prints notes on unused columns; returns the measured quantities.
///
/// # Errors
/// If a table or `--columns` is invalid.
pub fn measure(
    call: &call::Fit,
    machine: &InterpretedMachine,
    compiled: &Compiled<'_>,
    given: &[Given],
    experiments: &mut [Experiment],
) -> Result<Vec<Class>, Failure> {
    let known = measurable(machine, compiled);
    let requested = call::names_of_option("--columns", &call.columns)?;
    check_columns(&requested, &known)?;
    let wrong = |why: String| Failure::Call(format!("--data {why}"));
    let mut classes: Vec<Class> = Vec::new();
    let mut notes = Vec::new();
    for (one, experiment) in given.iter().zip(experiments.iter_mut()) {
        let file = signals::table_file(&one.path).map_err(wrong)?;
        let names: Vec<String> = file.columns().into_iter().map(|(name, _)| name).collect();
        let mut unused = Vec::new();
        for name in &names {
            let class = known.iter().find(|class| class.name == *name);
            let is_asked = requested.is_empty() || requested.contains(name);
            let Some(class) = class.filter(|_| is_asked) else {
                if requested.is_empty() {
                    unused.push(name.as_str());
                }
                continue;
            };
            let measured = file.measured(name, &class.unit);
            let (times, values) = measured.map_err(|why| wrong(why.to_string()))?;
            experiment.times = times;
            let values: Vec<Option<f64>> = values
                .into_iter()
                .map(|value| (!value.is_nan()).then_some(value))
                .collect();
            if values.iter().all(Option::is_none) {
                continue;
            }
            let before = classes.iter().position(|other| other.name == *name);
            let sigma = before.unwrap_or(classes.len());
            if before.is_none() {
                classes.push(class.clone());
            }
            experiment.columns.push(Column {
                quantity: class.quantity,
                sigma,
                values,
            });
        }
        check_times(one, experiment, &names, (&known[..], &requested[..]))?;
        if !unused.is_empty() {
            notes.push(note_on_unused(&one.label, &unused, &known));
        }
    }
    let is_used = |name: &&String| !classes.iter().any(|class| class.name == **name);
    if let Some(name) = requested.iter().find(is_used) {
        return Err(Failure::Call(format!(
            "--columns {name}: no table has measurements of it"
        )));
    }
    for note in notes {
        output::print_error(format_args!("note: {note}"));
    }
    Ok(classes)
}

/// Refuses names of `--columns` that occur twice, or that no quantity has.
fn check_columns(requested: &[String], known: &[Class]) -> Result<(), Failure> {
    for (place, name) in requested.iter().enumerate() {
        if requested[..place].contains(name) {
            return Err(Failure::Call(format!(
                "--columns names `{name}` more than once"
            )));
        }
        if !known.iter().any(|class| class.name == *name) {
            let help = help_with(name, known.iter().map(|class| class.name.as_str()));
            return Err(Failure::Call(format!(
                "--columns {name}: no coordinate, rate or output is named `{name}`; {help}"
            )));
        }
    }
    Ok(())
}

/// A note on the columns of a table to which nothing is fitted.
fn note_on_unused(label: &str, unused: &[&str], known: &[Class]) -> String {
    let near = unused.iter().find_map(|name| {
        let near = most_similar(name, known.iter().map(|class| class.name.as_str()))?;
        Some(format!("; did you mean `{near}` by `{name}`?"))
    });
    let unused: Vec<String> = unused.iter().map(|name| format!("`{name}`")).collect();
    format!(
        "{label}: nothing is fitted to {}, which is not a coordinate, a rate or an output of the machine{}",
        unused.join(", "),
        near.unwrap_or_default()
    )
}

/// Why a table has no measurements, before a list of the quantities that can be measured.
fn without_measurements(names: &[String], known: &[Class]) -> String {
    const MOST_SHOWN: usize = 12;
    let quoted = |names: &mut dyn Iterator<Item = &String>| {
        let shown: Vec<String> = names.map(|name| format!("`{name}`")).collect();
        let more = if shown.len() > MOST_SHOWN {
            ", …"
        } else {
            ""
        };
        format!("{}{more}", shown[..shown.len().min(MOST_SHOWN)].join(", "))
    };
    let is_known = |name: &&String| known.iter().any(|class| class.name == **name);
    if names.is_empty() {
        return "it has no column besides `t`; quantities of the machine are".into();
    }
    if names.iter().any(|name| is_known(&name)) {
        let empty = quoted(&mut names.iter().filter(is_known));
        return format!("there is no number in {empty}; quantities of the machine are");
    }
    format!(
        "none of its columns, {}, is among the quantities of the machine",
        quoted(&mut names.iter())
    )
}

/// Checks that an experiment can be run over the times of its measurements.
fn check_times(
    given: &Given,
    experiment: &mut Experiment,
    names: &[String],
    (known, asked): (&[Class], &[String]),
) -> Result<(), Failure> {
    let label = &given.label;
    if experiment.columns.is_empty() && !asked.is_empty() {
        return Err(Failure::Call(format!(
            "--data {label}: it has no measurements of {}; its columns are {}",
            asked.join(", "),
            names.join(", ")
        )));
    }
    if experiment.columns.is_empty() {
        let shown: Vec<&str> = known
            .iter()
            .map(|class| class.name.as_str())
            .take(12)
            .collect();
        return Err(Failure::Call(format!(
            "--data {label}: {}: {}",
            without_measurements(names, known),
            shown.join(", ")
        )));
    }
    // Rows without measurements are ignored.
    let rows: Vec<usize> = (0..experiment.times.len())
        .filter(|row| {
            experiment
                .columns
                .iter()
                .any(|column| column.values[*row].is_some())
        })
        .collect();
    experiment.times = rows.iter().map(|row| experiment.times[*row]).collect();
    for column in &mut experiment.columns {
        column.values = rows.iter().map(|row| column.values[*row]).collect();
    }
    let first = experiment.times.first().copied().unwrap_or(0.0);
    let last = experiment.times.last().copied().unwrap_or(0.0);
    if first < 0.0 {
        return Err(Failure::Call(format!(
            "--data {label}: it begins at t = {first} s, but the machine starts at 0: shift the times"
        )));
    }
    if last > 0.0 {
        Ok(())
    } else {
        Err(Failure::Call(format!(
            "--data {label}: nothing is measured after the start at t = 0"
        )))
    }
}

/// The number of measurements.
pub fn count(experiments: &[Experiment]) -> usize {
    let columns = experiments
        .iter()
        .flat_map(|experiment| &experiment.columns);
    columns
        .map(|column| column.values.iter().flatten().count())
        .sum()
}

/// The root mean square of the measurements under one name about their mean; 1 if they are constant.
pub fn root_mean_square(experiments: &[Experiment], class: usize) -> f64 {
    let columns = experiments
        .iter()
        .flat_map(|experiment| &experiment.columns);
    let of_class = columns.filter(|column| column.sigma == class);
    let values: Vec<f64> = of_class
        .flat_map(|column| column.values.iter().flatten().copied())
        .collect();
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    let square = values.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>() / values.len() as f64;
    if square > 0.0 { square.sqrt() } else { 1.0 }
}

/// Measured and computed values and their differences: one row for each time, NaN where nothing was measured.
///
/// # Errors
/// If there is no motion.
pub fn columns(
    fit: &mut Fit<'_>,
    x: &[f64],
    classes: &[Class],
) -> Result<Vec<(String, Vec<f64>)>, Trouble> {
    let header = |name: String, unit: &str| match unit {
        "1" => name,
        unit => format!("{name} [{unit}]"),
    };
    let mut columns = vec![
        (header("experiment".into(), "1"), Vec::new()),
        (header("t".into(), "s"), Vec::new()),
    ];
    for class in classes {
        columns.push((header(class.name.clone(), &class.unit), Vec::new()));
        columns.push((
            header(format!("computed({})", class.name), &class.unit),
            Vec::new(),
        ));
        columns.push((
            header(format!("residual({})", class.name), &class.unit),
            Vec::new(),
        ));
    }
    for e in 0..fit.experiments.len() {
        let computed = fit.computed(e, x)?;
        let experiment = &fit.experiments[e];
        for (row, t) in experiment.times.iter().enumerate() {
            columns[0].1.push(e as f64 + 1.0);
            columns[1].1.push(*t);
            for class in 0..classes.len() {
                let place = experiment
                    .columns
                    .iter()
                    .position(|column| column.sigma == class);
                let measured = place.and_then(|c| experiment.columns[c].values[row]);
                let measured = measured.unwrap_or(f64::NAN);
                let value = place.map_or(f64::NAN, |c| computed[row][c]);
                for (offset, number) in [measured, value, measured - value].into_iter().enumerate()
                {
                    columns[2 + 3 * class + offset].1.push(number);
                }
            }
        }
    }
    Ok(columns)
}
