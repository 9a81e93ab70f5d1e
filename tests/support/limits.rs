//! Bounds on the error of a run, derived from its tolerance.

use lagrangian::{Coordinates, InputLaw, Machine, Simulation, Solution, State};

use super::references::{Row, error, greatest};
use super::states::numbers;

/// Runs a machine and compares a quantity that it should conserve with its value at the start.
pub fn conserves<M: Machine>(
    machine: &M,
    start: State<Coordinates<M>>,
    (until, tolerance): (f64, f64),
    quantity: impl Fn(&M::System, f64, &[f64]) -> f64,
) {
    let run = Simulation::new(machine)
        .tolerance(tolerance)
        .until(until)
        .run(start);
    let run = run.unwrap_or_else(|error| panic!("{}: {error}", machine.name()));
    let of = |t: f64, y: &[f64]| quantity(run.system(), t, y);
    let at_end = |state: &State<_>| of(state.t, &numbers(run.system(), state));
    let (before, after) = (at_end(run.start()), at_end(run.end()));
    let limit = drift(&run, tolerance, of);
    let change = (after - before).abs();
    assert!(
        change <= limit,
        "{}: {before} became {after}; limit {limit:e}",
        machine.name()
    );
    // An error in a term of the equations would change the conserved quantity by
    // about the size of that term.
    let turnover = greatest(run.steps().map(|state| at_end(&state).abs())).max(1e-3);
    assert!(
        limit < 1e-2 * turnover,
        "{}: a limit of {limit:e} says nothing of {turnover}",
        machine.name()
    );
}

/// The bound on how much a run may change a quantity that the motion conserves.
///
/// A step keeps the root mean square of `δyᵢ / (τ (1 + |yᵢ|))` over its 2n numbers below 1, so by
/// the Cauchy–Schwarz inequality it changes `f` by at most `s τ` with
/// `s = √(2n) ‖∂f/∂yᵢ (1 + |yᵢ|)‖₂`. The motion neither amplifies nor damps an error in a
/// conserved quantity, so the changes of all steps add up to at most `τ Σ s`. The bound also
/// includes rounding in the two values of `f` that are compared, as if each `yᵢ` were off by 16
/// units in the last place.
fn drift<M: Machine, L: InputLaw<M::System>>(
    run: &Solution<M, L>,
    tolerance: f64,
    f: impl Fn(f64, &[f64]) -> f64,
) -> f64 {
    let mut sum = 0.0;
    let mut greatest: f64 = 0.0;
    for state in run.steps() {
        let sensitivity = sensitivity(&numbers(run.system(), &state), |y| f(state.t, y));
        sum += sensitivity * tolerance;
        greatest = greatest.max(sensitivity);
    }
    sum + 2.0 * 16.0 * f64::EPSILON * greatest
}

/// `√(2n) ‖∂f/∂yᵢ (1 + |yᵢ|)‖₂`, by central differences.
fn sensitivity(y: &[f64], f: impl Fn(&[f64]) -> f64) -> f64 {
    let squares = (0..y.len()).map(|i| {
        // The truncation error of the difference is of the order of h² and its rounding error of
        // the order of ε/h: 1e-10 relative.
        let h = 1e-5 * (1.0 + y[i].abs());
        let at = |yi: f64| {
            let mut y = y.to_vec();
            y[i] = yi;
            f(&y)
        };
        let derivative = (at(y[i] + h) - at(y[i] - h)) / (2.0 * h);
        (derivative * (1.0 + y[i].abs())).powi(2)
    });
    (y.len() as f64 * squares.sum::<f64>()).sqrt()
}

/// Compares a run with references; `view` extracts from its state the numbers that they give.
///
/// With step sizes chosen for the tolerance τ, the error of a run is proportional to τ. Its
/// distance from a run with a tolerance a hundred times larger is therefore the error of the coarse
/// run to within 1 %, and a hundred times its own error. That distance is the limit, which leaves a
/// factor of a hundred for deviations from proportionality. The limit itself must not exceed
/// `bound`, or the test would show nothing. Errors are relative to `scales + |reference|`.
pub fn follows<'a, M: Machine>(
    machine: &'a M,
    start: &State<Coordinates<M>>,
    tolerance: f64,
    known: (&[Row], &[f64], f64),
    view: impl Fn(&[f64]) -> Vec<f64>,
) {
    let settings = |run: Simulation<'a, M>, tolerance| run.tolerance(tolerance);
    follows_with(machine, start, (tolerance, settings), known, view);
}

/// Like [`follows`], with the caller's settings for each of the two tolerances.
pub fn follows_with<'a, M: Machine>(
    machine: &'a M,
    start: &State<Coordinates<M>>,
    (tolerance, settings): (f64, impl Fn(Simulation<'a, M>, f64) -> Simulation<'a, M>),
    (rows, scales, bound): (&[Row], &[f64], f64),
    view: impl Fn(&[f64]) -> Vec<f64>,
) {
    let until = rows
        .iter()
        .fold(start.t, |until, row| f64::max(until, row.t));
    let run = |tolerance| {
        let simulation = settings(Simulation::new(machine), tolerance).until(until);
        simulation
            .run(start.clone())
            .unwrap_or_else(|error| panic!("{}: {error}", machine.name()))
    };
    let (name, runs) = (machine.name(), [run(tolerance), run(100.0 * tolerance)]);
    holds(name, &runs, (rows, scales, bound), view);
}

/// Like [`follows`], for two finished runs; the second has a tolerance a hundred times larger.
pub fn holds<M: Machine, L: InputLaw<M::System>>(
    name: &str,
    [fine, coarse]: &[Solution<M, L>; 2],
    (rows, scales, bound): (&[Row], &[f64], f64),
    view: impl Fn(&[f64]) -> Vec<f64>,
) {
    for row in rows {
        let [fine, coarse] = [fine, coarse].map(|run| view(&numbers_at(run, row.t)));
        let distances = fine.iter().zip(&coarse).zip(scales);
        let limit = greatest(distances.map(|((a, b), s)| (a - b).abs() / (s + a.abs())));
        let error = error(&fine, row, scales);
        let t = row.t;
        assert!(
            limit <= bound,
            "{name} at {t} s: a limit of {limit:e} says nothing"
        );
        assert!(
            error <= limit,
            "{name} at {t} s: error {error:e}, limit {limit:e}"
        );
    }
}

/// Coordinates and rates of a run at a time.
pub fn numbers_at<M: Machine, L: InputLaw<M::System>>(run: &Solution<M, L>, t: f64) -> Vec<f64> {
    let state = run.at(t).expect("the time is within the run");
    numbers(run.system(), &state)
}
