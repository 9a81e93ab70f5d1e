//! What the rows of a sweep say about the methods that its runs chose.

use lagrangian::{Handover, MethodChoice, MethodReason};

/// The methods of a run, each but the first with the time from which it was used and the reason: `dop853, taylor from 1.3 s (8 evaluations instead of 43)`.
pub(super) fn methods(choices: &[MethodChoice], handovers: &[Handover]) -> String {
    let mut text = String::new();
    let mut begun_with = "";
    for choice in choices {
        let MethodChoice {
            t, method, reason, ..
        } = choice;
        // A run whose flights go by series changes as often as its contacts do.
        if matches!(
            reason,
            MethodReason::Open | MethodReason::Closed | MethodReason::ClosedInSeries
        ) {
            continue;
        }
        let name = method.tableau.name;
        if text.is_empty() {
            (text, begun_with) = (name.to_owned(), name);
        } else {
            text += &format!(", {name} from {t} s{}", in_short(*reason));
        }
    }
    // Changes to time stepping and back, of machines with contacts.
    for Handover { t, step, .. } in handovers {
        let name = step.map_or(begun_with, |_| "moreau");
        text += &format!(", {name} from {t} s");
    }
    text
}

/// Why a method was chosen.
fn in_short(reason: MethodReason) -> String {
    match reason {
        MethodReason::SeriesPays { cost, saved } => {
            format!(" ({cost:.0} evaluations instead of {saved:.0})")
        }
        MethodReason::Stiff { rate } if rate > 0.0 => format!(" (stiff: {rate:.1e}/s)"),
        MethodReason::Stiff { .. } => " (stiff)".into(),
        MethodReason::NotStiff { rate } => format!(" (fastest rate {rate:.1e}/s)"),
        MethodReason::NoSeries => " (no series there)".into(),
        _ => String::new(),
    }
}
