//! Whether a run counts.

use lagrangian::interpreted::InterpretedMachine;
use lagrangian::{Energies, Error, InputLaw, Machine, Solution, Warning};

use crate::shortest;

/// More than this of the energy turned over may not be missing for a run to count as good.
const MOST_MISSING: f64 = 1e-3;

/// What ended a run, in the words of the command.
pub fn said(error: &Error) -> String {
    match error {
        // The library names its method.
        Error::TooManySteps { .. } => error.to_string().replace("`max_steps`", "--max-steps"),
        error => error.to_string(),
    }
}

/// What is wrong with a run that came to its end: an energy that is no number, or too much of it missing.
pub fn objection<L: InputLaw<<InterpretedMachine as Machine>::System>>(
    run: &Solution<InterpretedMachine, L>,
) -> Option<String> {
    overflow(run.energies()).or_else(|| imbalance(run.warnings()))
}

/// Whether so much energy is missing, beyond what tolerance and rounding explain, that the motion is not that of the
/// machine.
fn imbalance(warnings: &[Warning]) -> Option<String> {
    let unexplained = |warning: &&Warning| matches!(warning, Warning::EnergyUnexplained { relative, .. } if relative.abs() > MOST_MISSING);
    warnings.iter().find(unexplained).map(ToString::to_string)
}

/// Whether an energy was greater than any number: then nothing is known of their balance.
fn overflow(energies: &[Energies]) -> Option<String> {
    let mut energies = energies.iter();
    let is_finite = |e: &&Energies| {
        [e.kinetic, e.potential, e.work, e.dissipated]
            .iter()
            .all(|x| x.is_finite())
    };
    let overflowed = energies.find(|e| !is_finite(e))?;
    let Energies {
        t,
        kinetic,
        potential,
        work,
        dissipated,
        ..
    } = overflowed;
    let named = [
        ("kinetic energy", kinetic),
        ("potential energy", potential),
        ("work of drives and forces", work),
        ("energy dissipated", dissipated),
    ];
    let (name, value) = named.into_iter().find(|(_, value)| !value.is_finite())?;
    let t = shortest(*t);
    Some(format!(
        "the {name} is not finite at t = {t} s ({value} J), so there is no balance of energy that could vouch for the run"
    ))
}
