//! Decides whether a run counts as good.

use lagrangian::interpreted::InterpretedMachine;
use lagrangian::{Energies, Error, InputLaw, Machine, Solution, Warning};

use crate::shortest;

/// The largest part of the energy exchanged that may be missing in a good run.
const MOST_MISSING: f64 = 1e-3;

/// The reason why a run ended, in the words of the command.
pub fn message_of(error: &Error) -> String {
    match error {
        // The library's message names its own method.
        Error::TooManySteps { .. } => error.to_string().replace("`max_steps`", "--max-steps"),
        error => error.to_string(),
    }
}

/// What is wrong with a run that reached its end: an energy that is not a number, or too much energy missing.
pub fn energy_error<L: InputLaw<<InterpretedMachine as Machine>::System>>(
    run: &Solution<InterpretedMachine, L>,
) -> Option<String> {
    overflow(run.energies()).or_else(|| imbalance(run.warnings()))
}

/// Whether more energy is missing than tolerance and round-off explain, so that the motion is not that of the machine.
fn imbalance(warnings: &[Warning]) -> Option<String> {
    let unexplained = |warning: &&Warning| matches!(warning, Warning::EnergyUnexplained { relative, .. } if relative.abs() > MOST_MISSING);
    warnings.iter().find(unexplained).map(ToString::to_string)
}

/// Whether an energy overflowed: its balance is then unknown.
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
        "the {name} is not finite at t = {t} s ({value} J), so the energy balance cannot confirm the run"
    ))
}
