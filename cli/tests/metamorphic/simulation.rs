//! Short runs of a machine and of its rewritten form.

use std::f64::consts::{PI, TAU};

use lagrangian::interpreted::{InterpretedMachine, Named};
use lagrangian::{Machine as _, Simulation, State as RunState};

use super::Tally;
use super::evaluation::{Case, Expected, compile, rewrite, write};
use super::generate::Kind;
use super::machine::Expr;
use super::random::Random;
use super::text;
use super::truth::{State, World};

/// The duration of a run, in s.
const LENGTH: f64 = 0.2;
const TOLERANCE: f64 = 1e-10;
/// The distance from the start at which a second run begins, to measure the growth of errors.
const BESIDE: f64 = 1e-6;

/// The end of a run, the number of its steps, and its error in the energy balance.
struct Run {
    end: State<f64>,
    steps: f64,
    missing: f64,
}

fn run(machine: &InterpretedMachine, start: &State<f64>) -> Result<Run, String> {
    let mut state: RunState<Named> = machine.start();
    state.t = start.t;
    state.q.values.clone_from(&start.q);
    state.v.values.clone_from(&start.v);
    let solution = Simulation::new(machine)
        .until(start.t + LENGTH)
        .tolerance(TOLERANCE)
        .energy_balance(true)
        .run(state)
        .map_err(|error| error.to_string())?;
    let end = solution.end();
    Ok(Run {
        end: State {
            t: end.t,
            q: end.q.values.clone(),
            v: end.v.values.clone(),
        },
        steps: solution.statistics().steps as f64,
        missing: solution
            .energy_balance()
            .map_or(0.0, |balance| balance.residual().abs()),
    })
}

fn largest(values: impl IntoIterator<Item = f64>) -> f64 {
    values.into_iter().map(f64::abs).fold(0.0, f64::max)
}

/// The greatest difference between two states. Whole turns are ignored for a coordinate that is an angle of a position.
fn apart(a: &State<f64>, b: &State<f64>, turns: bool) -> f64 {
    let places = a.q.iter().zip(&b.q).map(|(a, b)| match turns {
        true if (a - b).abs() > PI => (a - b).abs() - TAU,
        _ => a - b,
    });
    largest(places.chain(a.v.iter().zip(&b.v).map(|(a, b)| a - b)))
}

fn beside(state: &State<f64>, random: &mut Random) -> State<f64> {
    let mut state = state.clone();
    for x in state.q.iter_mut().chain(&mut state.v) {
        *x += if random.chance(50) { BESIDE } else { -BESIDE };
    }
    state
}

/// Tests one machine and one rewritten form.
pub fn task(mut random: Random, number: usize, tally: &mut Tally) {
    let kind = Kind::ALL[number % Kind::ALL.len()];
    let Some(case) = Case::random(&mut random, kind) else {
        return;
    };
    let (rewritten, single) = rewrite(&case, &mut random);
    if rewritten.names.is_empty() {
        return;
    }
    let Ok(Some(expected)) = Expected::of_rewritten(&case, &rewritten, &single) else {
        return;
    };
    let first_text = text::spec(&case.machine, "Random");
    let written = write(&rewritten.machine, "Rewritten", &mut random);
    let programs = (
        compile(&first_text, &[]),
        compile(&written.text, &written.files),
    );
    // Another test covers refusals.
    let (Ok(first), Ok(second)) = programs else {
        return;
    };
    let (first, second) = (
        InterpretedMachine::new(first),
        InterpretedMachine::new(second),
    );
    let plain = |state: &State<lagrangian_scalar::DoubleDouble>| State {
        t: state.t.hi(),
        q: state.q.iter().map(|x| x.hi()).collect(),
        v: state.v.iter().map(|x| x.hi()).collect(),
    };
    let (start, other_start) = (plain(&case.state), plain(&expected.state));
    let Ok(one) = run(&first, &start) else {
        tally.count("a run ends early");
        return;
    };
    // The sensitivity of the end to the start, in both forms.
    let (Ok(one_beside), Ok(other_beside)) = (
        run(&first, &beside(&start, &mut random)),
        run(&second, &beside(&other_start, &mut random)),
    ) else {
        tally.count("a run ends early");
        return;
    };
    let names = format!("{kind:?}, {:?}", rewritten.names);
    let other = match run(&second, &other_start) {
        Ok(other) => other,
        Err(error) => {
            let text = &written.text;
            tally.failures.push(format!(
                "{names}: one ends early: {error}\n{text}of\n{first_text}"
            ));
            return;
        }
    };
    tally.count(format!("run: {kind:?}"));
    let mapped = |state: &State<f64>| {
        let accelerations = vec![0.0; state.q.len()];
        let expressions: &[Expr] = &rewritten.coordinates;
        let [q, v, _] = World::<f64>::new(&case.machine, state).motion(expressions, &accelerations);
        State { t: state.t, q, v }
    };
    let wanted = mapped(&one.end);
    // The measured growth includes the effect of rounding and of changes between sticking and sliding along a run.
    let turns = rewritten.names.contains(&"polar coordinates");
    let growth = [
        apart(&wanted, &mapped(&one_beside.end), turns),
        apart(&other.end, &other_beside.end, false),
        apart(&one.end, &one_beside.end, false),
    ];
    let growth = largest(growth) / BESIDE;
    let all = [&wanted, &other.end, &one.end];
    let size = 1.0
        + largest(
            all.iter()
                .flat_map(|state| state.q.iter().chain(&state.v).copied()),
        );
    let count = 2.0 * start.q.len() as f64;
    // Each step has an error of the tolerance times the size of the state in each component, which grows by the same factor
    // as the distance between the neighbouring runs.
    let bound = (one.steps + other.steps) * TOLERANCE * size * growth.max(1.0) * count;
    let error = apart(&wanted, &other.end, turns);
    let mut failures = Vec::new();
    if error.is_nan() || error > bound {
        failures.push(format!("the ends are {error:e} apart, {bound:e} may be"));
    }
    // The derivative of the energy by the state consists of forces and momenta.
    let slope = expected.size * size * count;
    for (which, run) in [("the first", &one), ("the other", &other)] {
        let bound = run.steps * TOLERANCE * size * slope * growth.max(1.0);
        if run.missing.is_nan() || run.missing > bound {
            failures.push(format!(
                "{which} misses {:e} J, {bound:e} J may be",
                run.missing
            ));
        }
    }
    if !failures.is_empty() {
        let (failures, text) = (failures.join("\n"), &written.text);
        let files: Vec<&str> = written
            .files
            .iter()
            .map(|(_, text)| text.as_str())
            .collect();
        let files = files.concat();
        tally.failures.push(format!(
            "{names}:\n{failures}\nfrom {start:?}\n{text}{files}of\n{first_text}"
        ));
    }
}
