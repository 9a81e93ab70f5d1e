//! `lagrangian brachistochrone`: the fastest motion from rest at one position to another.

mod figures;
mod forward;
mod found;
mod guess;
mod page;
mod problem;
mod tried;

use std::time::Instant;

use lagrangian::interpreted::{InterpretedMachine, Named};
use lagrangian::{Machine, System};
use lagrangian_brachistochrone::direct::{FastestMotion, Search};
use lagrangian_mechanics::Compiled;
use lagrangian_symbolic::Dag;
use lagrangian_units::rate_name;

use crate::call::{self, Assignment};
use crate::failure::Failure;
use crate::output::{self, Destination, PAGE, SVG, TABLE, keep_apart, keep_document_apart};
use crate::progress;
use crate::reading::{self, Reading};
use crate::table;
use found::{FastestResult, Motion};
use problem::Form;

/// Runs the command.
///
/// # Errors
/// If the spec or the call is invalid, the machine does not meet the conditions, or there is no fastest motion.
pub fn run(call: &call::Brachistochrone) -> Result<(), Failure> {
    let files = [
        Destination::of("--out", call.out.as_ref(), TABLE)?,
        Destination::of("--plot", call.plot.as_ref(), SVG)?,
        Destination::of("--report", call.report.as_ref(), PAGE)?,
    ];
    let all = || files.iter().flatten();
    keep_document_apart(all(), call.spec.json)?;
    let guess = call
        .guess
        .as_ref()
        .map(|path| (path.as_path(), "the guess"));
    let read: Vec<_> = guess.into_iter().collect();
    keep_apart(
        all(),
        &[&[(call.spec.path.as_path(), "the spec")], &read[..]].concat(),
    )?;
    let dag = Dag::new();
    let compiled = Reading::open(&call.spec)?.compile_beside(&dag, all())?;
    refuse_states(&compiled)?;
    let start = call::Start {
        parameters: call.parameters.clone(),
        coordinates: Vec::new(),
        rates: Vec::new(),
        running: call.running,
    };
    let machine = reading::machine(&compiled, &start)?;
    reading::check_parameters(&machine)?;
    let form = problem::form(&compiled, &machine)?;
    let [from, to] = ends(call, &compiled, &machine, &form)?;
    let coordinates = &compiled.program.coordinates;
    let names: Vec<String> = coordinates
        .iter()
        .map(|slot| slot.name.to_string())
        .collect();
    let guess = call.guess.as_deref();
    let guess = guess
        .map(|path| guess::read(path, coordinates))
        .transpose()?;
    progress::now("searching for the fastest motion");
    let clock = Instant::now();
    let (motion, because) = match form {
        Form::Constant(_) if guess.is_some() => {
            let why = "the motion has a closed form and needs no search: leave out `--guess`";
            return Err(Failure::Call(why.to_owned()));
        }
        Form::Constant(problem) => {
            let found = problem.solve(&from, &to);
            (found.map(Box::new).map(Motion::Closed), Vec::new())
        }
        Form::Varying(landscape, because) => {
            let search = guess.into_iter().fold(Search::new(), Search::guess);
            let found = FastestMotion::find(&search, *landscape, &from, &to);
            (found.map(Box::new).map(Motion::Direct), because)
        }
    };
    let motion = motion.map_err(|unsolved| tried::failure(&unsolved, &names))?;
    let seconds = clock.elapsed().as_secs_f64();
    let system = machine.prepare();
    let units = system.coordinates().map(|q| q.unit.to_owned()).collect();
    let mut found = FastestResult::new(motion, names, units, seconds);
    found.because = because;
    found.arrival = forward::arrival(call, &compiled.model.coordinates, &found);
    write(&files, &compiled, &machine, &found)?;
    if call.spec.json {
        output::line(format_args!("{:#}", found.document()))
    } else {
        found.print(machine.name())
    }
    if found.is_motion() {
        Ok(())
    } else {
        Err(Failure::AlreadyReported)
    }
}

/// Refuses a machine with states of first order.
fn refuse_states(compiled: &Compiled<'_>) -> Result<(), Failure> {
    let mut states = compiled.model.coordinates.iter();
    match states.find(|c| c.rate.is_some()) {
        None => Ok(()),
        Some(state) => Err(Failure::Run(format!(
            "the machine has the state `{}`, whose value at the end is not prescribed: fastest motions are found only for machines without `states`",
            rate_name(&state.name.to_string(), "")
        ))),
    }
}

/// Writes the requested files.
fn write(
    [out, plot, report]: &[Option<Destination>; 3],
    compiled: &Compiled<'_>,
    machine: &InterpretedMachine,
    found: &FastestResult<'_>,
) -> Result<(), Failure> {
    if let Some(file) = out {
        table::write(&found.recording(), file)?;
    }
    if let Some(file) = plot {
        file.write_text(&figures::svg(machine.name(), found).map_err(Failure::Run)?)?;
    }
    if let Some(file) = report {
        file.write_text(&page::page(found, compiled, machine)?)?;
    }
    Ok(())
}

/// Start and end in the machine's coordinates. The spec provides what the call omits; if neither gives an end,
/// coordinates keep their start values.
fn ends(
    call: &call::Brachistochrone,
    compiled: &Compiled<'_>,
    machine: &InterpretedMachine,
    form: &Form<'_>,
) -> Result<[Vec<f64>; 2], Failure> {
    let problem = match form {
        Form::Constant(problem) if call.natural => Some(problem),
        Form::Varying(_, because) if call.natural => {
            return Err(Failure::Run(format!(
                "there are no normal coordinates: {}",
                because.join("; ")
            )));
        }
        _ => None,
    };
    let place =
        |from: Vec<f64>, assignments: &[Assignment], option: &str| -> Result<Vec<f64>, Failure> {
            let mut values: Named = machine.start().q;
            values.values = match problem {
                Some(problem) => problem.to_normal(&from),
                None => from,
            };
            for set in reading::families_first(assignments) {
                // Normal coordinates are in √kg·m, a unit that cannot be written.
                let unit = match problem {
                    Some(_) => "1".to_owned(),
                    None => values.unit(&set.name).unwrap_or("1").to_owned(),
                };
                reading::assign(&mut values, set, option, &unit)?;
            }
            Ok(match problem {
                Some(problem) => problem.from_normal(&values.values),
                None => values.values,
            })
        };
    let from = place(machine.start().q.values, &call.from, "--from")?;
    let destination = problem::at_parameters(compiled, machine, &compiled.model.destination);
    if destination.is_empty() && call.to.is_empty() {
        return Err(Failure::Call(
            "it is not specified where the motion ends: give `--to`, or add a section `brachistochrone { … }` to the spec".to_owned(),
        ));
    }
    let to = if destination.is_empty() {
        from.clone()
    } else {
        destination
    };
    let to = place(to, &call.to, "--to")?;
    Ok([from, to])
}
