//! `lagrangian fit`: parameters and starts from measured motions.

mod data;
mod figure;
mod findings;
mod variant;

use std::path::Path;
use std::sync::Arc;

use lagrangian::Machine;
use lagrangian::interpreted::{InterpretedMachine, Named, Signals};
use lagrangian::methods::{Method, TAYLOR};
use lagrangian_fit::least_squares::Trouble;
use lagrangian_fit::motion::{
    Chart, ConstraintFindings, Experiment, Fit, FitResult, Quantity, Running, Sought, Subject,
};
use lagrangian_fit::searches::{Failed, Search, Sigmas, search};
use lagrangian_mechanics::Compiled;
use lagrangian_spec::unit::{self, integral_name, state_of};
use lagrangian_sweep::charts::ChartedPoints;
use lagrangian_sweep::plan::Law;
use lagrangian_sweep::signals::{self, InputArgument};
use lagrangian_symbolic::Dag;

use crate::call::{self, Bounds, SigmaOption};
use crate::evaluate::set_start;
use crate::failure::{Failure, help_with};
use crate::inputs;
use crate::interrupt;
use crate::methods;
use crate::output::{self, Destination, MACHINE, SVG, TABLE, keep_apart};
use crate::progress;
use crate::reading::{self, ChartUse, InCharts, Reading, places};
use crate::table;
use data::{Class, Given};

/// The files that a call requests.
struct Files {
    out: Option<Destination>,
    table: Option<Destination>,
    plot: Option<Destination>,
}

impl Files {
    fn new(
        call: &call::Fit,
        given: &[Given],
        everywhere: &[(String, InputArgument)],
    ) -> Result<Files, Failure> {
        let files = Files {
            out: Destination::of("--out", call.out.as_ref(), MACHINE)?,
            table: Destination::of("--table", call.table.as_ref(), TABLE)?,
            plot: Destination::of("--plot", call.plot.as_ref(), SVG)?,
        };
        output::keep_document_apart(files.all(), call.spec.json)?;
        let mut read: Vec<(&Path, &str)> = vec![(&call.spec.path, "the spec")];
        read.extend(
            given
                .iter()
                .map(|given| (given.path.as_path(), "measured data")),
        );
        let written = given.iter().flat_map(|given| inputs::files(&given.inputs));
        read.extend(written.chain(inputs::files(everywhere)));
        keep_apart(files.all(), &read)?;
        Ok(files)
    }

    fn all(&self) -> impl Iterator<Item = &Destination> {
        [&self.out, &self.table, &self.plot].into_iter().flatten()
    }
}

/// All data for the report on a fit.
struct Fitted<'a, 'f> {
    call: &'a call::Fit,
    machine: &'a InterpretedMachine,
    given: &'a [Given],
    classes: &'a [Class],
    fit: &'a mut Fit<'f>,
    sigmas: Sigmas,
    found: FitResult,
    searches: Vec<Search>,
    /// The index of the search that found the best minimum.
    best: usize,
    warnings: Vec<String>,
}

/// Runs the command.
///
/// # Errors
/// If the spec, the data or the call is invalid, or the search finds no minimum.
pub fn run(call: &call::Fit) -> Result<(), Failure> {
    let method = methods::named(&call.method)?;
    if std::ptr::eq(method, &TAYLOR) {
        return Err(Failure::Call(
            "--method taylor: a fit integrates the motion with its derivatives, which have no Taylor series; use dop853".into(),
        ));
    }
    let given = data::read_all(call)?;
    let everywhere = inputs::parse(&call.inputs)?;
    let files = Files::new(call, &given, &everywhere)?;
    let dag = Dag::new();
    let mut reading = Reading::open(&call.spec)?.with_values(&call.start);
    let laws = reading.drive(&everywhere)?;
    let formulas = reading.formulas();
    let compiled = reading.compile_in_charts(&dag, files.all(), ChartUse::IfPossible);
    let InCharts {
        mut compiled,
        cartesian,
        sources,
        ..
    } = compiled.map_err(inputs::as_call_failure)?;
    let machine = reading::machine(&compiled, &call.start)?;
    let chart = chart(&compiled, cartesian.as_ref(), call)?;
    // Formulas of inputs are not reported as outputs of the machine.
    let output_count = compiled.model.outputs.len() - formulas;
    compiled.model.outputs.truncate(output_count);
    let mut start = machine.start();
    start.q.values.fill(f64::NAN);
    start.v.values.fill(f64::NAN);
    set_start(&mut start, &call.start)?;
    reading::check_kept(&machine.start(), &call.keep)?;

    let mut experiments = Vec::new();
    for one in &given {
        let signals = signals_of(one, &laws, output_count, &machine, &compiled)?;
        let chart = chart.as_ref();
        experiments.push(one.experiment(&machine, &compiled, &start, (chart, signals))?);
    }
    let classes = data::measure(call, &machine, &compiled, &given, &mut experiments)?;
    let sought = sought(call, &machine, &compiled, &given, &experiments)?;
    check_values(&machine, &sought)?;
    let (sigmas, values) = sigmas(call, &classes, &experiments)?;
    let refusal = |parameters: &[f64]| data::refusal(&compiled, parameters);
    let mut fit = Fit {
        experiments,
        sought,
        sigmas: values,
        running: running(call, method),
        refusal: &refusal,
        runs: [0, 0],
        held: ConstraintFindings::default(),
    };
    let (measured, unknown) = (data::count(&fit.experiments), fit.sought.len());
    if measured < unknown {
        return Err(Failure::Call(format!(
            "{measured} measurements cannot determine {unknown} numbers"
        )));
    }
    progress::now("fitting");
    let count = usize::try_from(call.starts).unwrap_or(1);
    let searched = search(&mut fit, count, sigmas);
    let searched = searched.map_err(|failed| failure(failed).placed(&compiled.model, &sources))?;
    let mut result = Fitted {
        call,
        machine: &machine,
        given: &given,
        classes: &classes,
        sigmas,
        found: searched.found,
        searches: searched.searches,
        best: searched.best,
        warnings: Vec::new(),
        fit: &mut fit,
    };
    result.warnings = findings::warnings(&result);
    conclude(result, &files)
}

/// How runs are made, with the settings of a call.
fn running(call: &call::Fit, method: &'static Method) -> Running {
    let stop = interrupt::flag();
    Running {
        method,
        tolerance: call.tolerance,
        most_steps: call.max_steps,
        kept: reading::kept_names(&call.keep).map(<[String]>::to_vec),
        stop: Arc::new(move || stop.load(std::sync::atomic::Ordering::Relaxed)),
    }
}

/// The machine in the Cartesian coordinates that the spec names, if it names any and the call can be made in them.
fn chart(
    compiled: &Compiled<'_>,
    cartesian: Option<&Compiled<'_>>,
    call: &call::Fit,
) -> Result<Option<Chart>, Failure> {
    let points = ChartedPoints::of(&compiled.model);
    let Some(cartesian) = cartesian.filter(|_| points.check_kept(&call.keep.names).is_ok()) else {
        return Ok(None);
    };
    let machine = reading::machine(cartesian, &call.start.parameters_alone())?;
    let points = compiled.chart_points();
    Ok(Some(Chart { machine, points }))
}

/// The failure of a search.
fn failure(failed: Failed) -> Failure {
    match failed {
        Failed::NoStart(why) => {
            let why = why.replace("`max_steps`", "--max-steps");
            Failure::Run(format!("the search cannot begin from these values: {why}"))
        }
        Failed::Unsettled => {
            Failure::Run("the standard deviations do not converge: give them by --sigma".to_owned())
        }
        Failed::Trouble(trouble) => stopped(trouble),
    }
}

/// Writes the files and prints the results.
///
/// # Errors
/// If a file cannot be written, or the search found no minimum.
fn conclude(mut result: Fitted<'_, '_>, files: &Files) -> Result<(), Failure> {
    let error = match write_files(&mut result, files) {
        Err(Failure::Interrupted) => return Err(Failure::Interrupted),
        Err(failure) => Some(failure.message()),
        Ok(()) if result.found.minimum.ending.is_minimum() => None,
        Ok(()) => Some(format!(
            "the search {} in {} evaluations; start it closer to the solution by --set and --start, bound it by --bounds, or try several starts by --starts",
            result.found.minimum.ending.words(),
            result.found.minimum.evaluations
        )),
    };
    if result.call.spec.json {
        let mut document = findings::document(&result);
        if let Some(error) = &error {
            document["error"] = error.as_str().into();
        }
        output::line(format_args!("{document:#}"));
    } else {
        output::text(&findings::text(&result));
        for warning in &result.warnings {
            output::print_error(format_args!("warning: {warning}"));
        }
    }
    match error {
        None => Ok(()),
        Some(error) => {
            output::print_error(format_args!("error: {error}"));
            Err(Failure::AlreadyReported)
        }
    }
}

/// The signals of an experiment's inputs: its own tables, and for all other inputs the common laws, whose formulas are
/// outputs after those of the machine.
fn signals_of(
    given: &Given,
    everywhere: &[(String, Law)],
    output_count: usize,
    machine: &InterpretedMachine,
    compiled: &Compiled<'_>,
) -> Result<Signals, Failure> {
    let tables = inputs::laws(&given.inputs, &compiled.model)?;
    let mut numbers = Vec::new();
    let mut laws = Vec::new();
    let mut next = output_count;
    for (name, law) in everywhere {
        let is_replaced = tables.iter().any(|(other, _)| other == name);
        if law.formula().is_some() {
            if !is_replaced {
                numbers.push(next);
            }
            next += 1;
        }
        if !is_replaced {
            laws.push((name.clone(), law.clone()));
        }
    }
    laws.extend(tables);
    let mut numbers = numbers.into_iter();
    let signals = signals::signals(&laws, machine, || numbers.next().unwrap_or(output_count));
    signals.map_err(Failure::Call)
}

/// Writes the files of a call.
fn write_files(result: &mut Fitted<'_, '_>, files: &Files) -> Result<(), Failure> {
    if let Some(file) = &files.out {
        file.write_text(&variant::spec(result, file)?)?;
    }
    if files.table.is_none() && files.plot.is_none() {
        return Ok(());
    }
    let x = result.found.minimum.x.clone();
    if let Some(file) = &files.table {
        let columns = data::columns(result.fit, &x, result.classes).map_err(stopped)?;
        let columns: Vec<(String, &[f64])> = columns
            .iter()
            .map(|(header, values)| (header.clone(), values.as_slice()))
            .collect();
        table::write_columns(&columns, file)?;
    }
    if let Some(file) = &files.plot {
        let drawing = figure::svg(result, &x)?;
        file.write_text(&drawing)?;
    }
    Ok(())
}

/// A missing motion or an interruption, as a failure.
fn stopped(trouble: Trouble) -> Failure {
    match trouble {
        Trouble::NoValue(why) => Failure::Run(why),
        Trouble::Stopped => {
            output::print_error("interrupted: nothing is written or printed");
            Failure::Interrupted
        }
    }
}

/// The numbers that a call fits.
fn sought(
    call: &call::Fit,
    machine: &InterpretedMachine,
    compiled: &Compiled<'_>,
    given: &[Given],
    experiments: &[Experiment],
) -> Result<Vec<Sought>, Failure> {
    let names = call::names_of_option("--fit", &call.sought)?;
    let start = machine.start();
    let mut sought: Vec<Sought> = Vec::new();
    for name in &names {
        let inside = |word: &str| {
            let rest = name.strip_prefix(word)?.trim_start().strip_prefix('(')?;
            Some(rest.strip_suffix(')')?.trim())
        };
        let of_start = inside("start").map(|q| (q, true));
        let of_start = of_start.or_else(|| inside("rate").map(|q| (q, false)));
        let found = match of_start {
            Some((coordinate, is_start)) => {
                let (places, is_start) = places_of_start(name, coordinate, is_start, &start.q)?;
                of_starts(&start.q, &places, is_start, given, experiments)
            }
            None => of_parameters(name, machine, compiled, &start.q)?,
        };
        for one in found {
            if sought.iter().any(|other| other.name == one.name) {
                return Err(Failure::Call(format!(
                    "--fit names `{}` more than once",
                    one.name
                )));
            }
            sought.push(one);
        }
    }
    set_bounds(call, &mut sought)?;
    for one in &mut sought {
        begin_within_bounds(one, experiments)?;
    }
    check_fixed(machine, &sought, given, experiments)?;
    Ok(sought)
}

/// The places of the coordinates whose start or rate is fitted, and whether it is the start. The start of a state is that of the rate of
/// its integral.
fn places_of_start(
    name: &str,
    coordinate: &str,
    is_start: bool,
    q: &Named,
) -> Result<(Vec<usize>, bool), Failure> {
    let states = places(q, &integral_name(coordinate));
    let is_state = is_start && !states.is_empty();
    let mut places = if is_state {
        states
    } else {
        places(q, coordinate)
    };
    let names: Vec<&str> = q.iter().map(|(name, _)| name).collect();
    places.retain(|k| state_of(names[*k]).is_some() == is_state);
    if places.is_empty() {
        let known = names.iter();
        let known = known.map(|name| state_of(name).unwrap_or((*name).to_owned()));
        let known: Vec<String> = known.collect();
        return Err(unknown(name, "coordinate", coordinate, &known));
    }
    Ok((places, is_start && !is_state))
}

/// Sets the bounds that the call gives. Those of a member take precedence over those of its family, in whichever order they are given.
fn set_bounds(call: &call::Fit, sought: &mut [Sought]) -> Result<(), Failure> {
    let mut is_used: Vec<bool> = vec![false; call.bounds.len()];
    for one in sought {
        let short = one.name.split(" in ").next().unwrap_or_default().to_owned();
        let family = match short.split_once('[') {
            Some((before, rest)) => {
                let after = rest.split_once(']').map_or("", |(_, after)| after);
                format!("{before}{after}")
            }
            None => short.clone(),
        };
        let mut names = vec![family, short, one.name.clone()];
        names.dedup();
        for known in names {
            for (place, bound) in call.bounds.iter().enumerate() {
                if bound.name == known {
                    is_used[place] = true;
                    one.bounds = ends(bound, &one.unit)?;
                }
            }
        }
    }
    match is_used.iter().position(|used| !used) {
        None => Ok(()),
        Some(place) => Err(Failure::Call(format!(
            "--bounds {}: nothing with this name is fitted",
            call.bounds[place].name
        ))),
    }
}

/// Checks that the search begins within the bounds. A measurement may be outside of them by its error, so that a search that begins at one
/// begins at the bound instead.
fn begin_within_bounds(one: &mut Sought, experiments: &[Experiment]) -> Result<(), Failure> {
    let [low, high] = one.bounds;
    let measured = match one.subject {
        Subject::Parameter(_) => None,
        Subject::Start(e, k) => measured_at_start(&experiments[e], Quantity::Coordinate(k)),
        Subject::Rate(e, k) => measured_at_start(&experiments[e], Quantity::Rate(k)),
    };
    if measured == Some(one.from) {
        one.from = one.from.max(low).min(high);
    }
    if one.from < low || one.from > high {
        return Err(Failure::Call(format!(
            "the search for `{}` would begin at {}, outside its bounds {low} to {high}; set another initial value by {}",
            one.name,
            one.from,
            match one.subject {
                Subject::Parameter(_) => "--set",
                Subject::Start(..) => "--start",
                // The start of a state is the rate of its integral.
                Subject::Rate(..) if one.name.starts_with("start(") => "--start",
                Subject::Rate(..) => "--rate",
            }
        )));
    }
    Ok(())
}

/// Checks that no experiment gives a fixed value to what is fitted.
fn check_fixed(
    machine: &InterpretedMachine,
    sought: &[Sought],
    given: &[Given],
    experiments: &[Experiment],
) -> Result<(), Failure> {
    let parameters = sought
        .iter()
        .filter(|one| matches!(one.subject, Subject::Parameter(_)));
    let is_sought = |name: &str| parameters.clone().any(|one| one.name == name);
    let known: Vec<&str> = machine.parameters().map(|(of, _)| of.name).collect();
    for (one, experiment) in given.iter().zip(experiments) {
        for set in &one.sets {
            // The value of a family is that of the members that are not fitted, if there are any.
            let member = format!("{}[", set.name);
            let mut members = known.iter().filter(|name| name.starts_with(&member));
            let is_family = members.clone().next().is_some();
            if is_sought(&set.name) || is_family && members.all(|name| is_sought(name)) {
                return Err(Failure::Call(format!(
                    "`{}` is fitted, but --data {} gives it a fixed value",
                    set.name, experiment.name
                )));
            }
        }
    }
    Ok(())
}

fn of_parameters(
    name: &str,
    machine: &InterpretedMachine,
    compiled: &Compiled<'_>,
    coordinates: &Named,
) -> Result<Vec<Sought>, Failure> {
    let parameters: Vec<String> = machine
        .parameters()
        .map(|(of, _)| of.name.to_owned())
        .collect();
    let is_meant = |known: &String| {
        known == name || known.split_once('[').is_some_and(|(base, _)| base == name)
    };
    let meant: Vec<usize> = (0..parameters.len())
        .filter(|i| is_meant(&parameters[*i]))
        .collect();
    if meant.is_empty() {
        let is_input = compiled
            .model
            .inputs
            .iter()
            .any(|input| input.name.to_string() == name);
        let rate = name
            .strip_prefix("der(")
            .and_then(|rest| rest.strip_suffix(')'));
        let help = if is_input {
            "it is an input; it can be driven through --input by a formula with a fitted parameter"
                .to_owned()
        } else if !places(coordinates, name).is_empty() {
            format!("it is a coordinate, whose start value is fitted as start({name})")
        } else if let Some(rate) = rate.filter(|rate| !places(coordinates, rate).is_empty()) {
            format!("the initial rate is fitted as rate({rate})")
        } else if let Some(coordinate) = name.strip_suffix("(start)") {
            format!("the start value of a coordinate is fitted as start({coordinate})")
        } else {
            return Err(unknown(name, "parameter", name, &parameters));
        };
        return Err(Failure::Call(format!(
            "--fit {name}: no parameter named `{name}`; {help}"
        )));
    }
    let sought = |index: usize| {
        let name = &parameters[index];
        Sought {
            subject: Subject::Parameter(index),
            name: name.clone(),
            unit: machine.unit(name).unwrap_or("1").to_owned(),
            from: machine.parameter_values()[index],
            bounds: [f64::NEG_INFINITY, f64::INFINITY],
        }
    };
    Ok(meant.into_iter().map(sought).collect())
}

/// What an experiment measured of a quantity at t = 0, if it did.
fn measured_at_start(experiment: &Experiment, quantity: Quantity) -> Option<f64> {
    let column = experiment
        .columns
        .iter()
        .find(|column| column.quantity == quantity)?;
    let first = column.values.first().copied().flatten();
    first.filter(|_| experiment.times.first() == Some(&0.0))
}

/// The starts of coordinates, in each experiment. If a coordinate is measured at the beginning, that is its initial guess.
fn of_starts(
    coordinates: &Named,
    places: &[usize],
    is_start: bool,
    given: &[Given],
    experiments: &[Experiment],
) -> Vec<Sought> {
    let mut sought = Vec::new();
    for (e, experiment) in experiments.iter().enumerate() {
        let start = experiment.machine.start();
        for &place in places {
            let name = coordinates.iter().nth(place).map_or("", |(name, _)| name);
            let coordinate_unit = coordinates.unit(name).unwrap_or("1");
            let (subject, word, unit, level, otherwise) = if is_start {
                (
                    Subject::Start(e, place),
                    "start",
                    coordinate_unit.to_owned(),
                    0,
                    start.q.values[place],
                )
            } else {
                (
                    Subject::Rate(e, place),
                    "rate",
                    unit::rate_unit(name, coordinate_unit),
                    1,
                    start.v.values[place],
                )
            };
            let (name, word, unit) = match state_of(name) {
                Some(state) => (state, "start", unit::rate_unit(name, coordinate_unit)),
                None => (name.to_owned(), word, unit),
            };
            let quantity = if is_start {
                Quantity::Coordinate(place)
            } else {
                Quantity::Rate(place)
            };
            let from = experiment.start[level][place]
                .or_else(|| measured_at_start(experiment, quantity))
                .unwrap_or(otherwise);
            let label = match experiments.len() {
                1 => format!("{word}({name})"),
                _ => format!("{word}({name}) in {}", given[e].label),
            };
            sought.push(Sought {
                subject,
                name: label,
                unit,
                from,
                bounds: [f64::NEG_INFINITY, f64::INFINITY],
            });
        }
    }
    sought
}

/// The bounds of a call, in this unit.
fn ends(bounds: &Bounds, unit: &str) -> Result<[f64; 2], Failure> {
    let end = |set: &Option<call::Assignment>, open: f64| match set {
        None => Ok(open),
        Some(set) => set.value("--bounds", unit).map_err(Failure::Call),
    };
    let low = end(&bounds.ends[0], f64::NEG_INFINITY)?;
    let high = end(&bounds.ends[1], f64::INFINITY)?;
    if low < high {
        Ok([low, high])
    } else {
        Err(Failure::Call(format!(
            "--bounds {}: there is no value between {low} and {high}",
            bounds.name
        )))
    }
}

fn unknown(option: &str, noun: &str, name: &str, known: &[String]) -> Failure {
    let help = help_with(name, known.iter().map(String::as_str));
    Failure::Call(format!("--fit {option}: no {noun} named `{name}`; {help}"))
}

/// Checks that all parameters have values.
fn check_values(machine: &InterpretedMachine, sought: &[Sought]) -> Result<(), Failure> {
    let Err(missing) = machine.check_parameters() else {
        return Ok(());
    };
    let is_sought = missing
        .names
        .iter()
        .any(|name| sought.iter().any(|s| s.name == *name));
    let why = if is_sought {
        "; for what is fitted, this is where the search begins"
    } else {
        ""
    };
    Err(Failure::Call(format!(
        "{missing}; set them with --set {}=…{why}",
        missing.names.join("=… --set ")
    )))
}

/// The standard deviations of the measurements, as given by the call.
fn sigmas(
    call: &call::Fit,
    classes: &[Class],
    experiments: &[Experiment],
) -> Result<(Sigmas, Vec<f64>), Failure> {
    let is_auto = call.sigmas.contains(&SigmaOption::Estimated);
    if is_auto && call.sigmas.len() > 1 {
        return Err(Failure::Call(
            "--sigma auto estimates all standard deviations: it excludes any other --sigma".into(),
        ));
    }
    if is_auto {
        let spreads = (0..classes.len()).map(|class| data::root_mean_square(experiments, class));
        return Ok((Sigmas::Estimated, spreads.collect()));
    }
    if call.sigmas.is_empty() {
        let units: Vec<&str> = classes.iter().map(|class| class.unit.as_str()).collect();
        if units.windows(2).all(|pair| pair[0] == pair[1]) {
            return Ok((Sigmas::Equal, vec![1.0; classes.len()]));
        }
        let names: Vec<String> = classes
            .iter()
            .map(|c| format!("{} [{}]", c.name, c.unit))
            .collect();
        return Err(Failure::Call(format!(
            "{} have different units, so their relative weights are unknown: give their standard deviations, as in --sigma {}=…, or have \
             them estimated from the residuals by --sigma auto",
            names.join(", "),
            classes[0].name
        )));
    }
    let mut values = vec![f64::NAN; classes.len()];
    for sigma in &call.sigmas {
        let SigmaOption::Given(set) = sigma else {
            continue;
        };
        let Some(place) = classes.iter().position(|class| class.name == set.name) else {
            let known: Vec<&str> = classes.iter().map(|class| class.name.as_str()).collect();
            return Err(Failure::Call(format!(
                "--sigma {}: nothing with this name is measured; there are: {}",
                set.name,
                known.join(", ")
            )));
        };
        let value = set
            .value("--sigma", &classes[place].unit)
            .map_err(Failure::Call)?;
        if !(value > 0.0 && value.is_finite()) {
            return Err(Failure::Call(format!(
                "--sigma {}={}: a standard deviation must be greater than 0",
                set.name, set.value
            )));
        }
        values[place] = value;
    }
    let missing: Vec<&str> = classes
        .iter()
        .zip(&values)
        .filter(|(_, value)| value.is_nan())
        .map(|(class, _)| class.name.as_str())
        .collect();
    if missing.is_empty() {
        Ok((Sigmas::Given, values))
    } else {
        Err(Failure::Call(format!(
            "--sigma gives no standard deviation of {}, which is measured as well; --columns selects the columns to fit to",
            missing.join(", ")
        )))
    }
}
