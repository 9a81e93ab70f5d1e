//! Steady motions, their modes and their continuation in words.

use std::f64::consts::TAU;
use std::fmt::Write as _;

use lagrangian_linear::Complex;
use lagrangian_linear::spectrum::{Mode, Modes, damping};
use lagrangian_units::{rate_unit as unit_of_rate, state_of};

use super::vary::{Critical, Point, Trace};
use super::{Reached, is_moving};
use crate::numbers::{after_number, number, shown_name, width_of_names};

/// The ranges in which motions grow or do not exist, and the critical values.
pub(super) fn text_of_trace(trace: &Trace) -> String {
    let mut text = String::new();
    let unit = after_number(&trace.unit);
    let [first, last] = [trace.points.first(), trace.points.last()];
    let [first, last] = [first, last].map(|point| point.map_or(0.0, |point| point.value));
    let kind = if trace.wanted.steady.contains(&true) {
        "steady motions"
    } else {
        "equilibria"
    };
    // Writing to a String cannot fail.
    let _ = writeln!(
        text,
        "{kind} along {} from {} to {}{unit}, {} values:",
        trace.name,
        number(first),
        number(last),
        trace.points.len()
    );
    write_ranges(&mut text, trace, &unit);
    for critical in &trace.critical {
        let (name, value) = (&trace.name, number(critical.value));
        let changes = text_of_critical(critical);
        let _ = writeln!(text, "\ncritical {name} = {value}{unit}: {changes}");
    }
    text
}

/// Writes how many modes grow at each value. Consecutive values with the same description are merged into one line.
fn write_ranges(text: &mut String, trace: &Trace, unit: &str) {
    let words = |point: &Point| match &point.motion {
        Ok(motion) => {
            let growing = motion
                .modes
                .modes
                .iter()
                .filter(|mode| mode.lambda.re > 0.0)
                .count();
            match growing {
                0 => "no mode grows".to_owned(),
                1 => "1 mode grows".to_owned(),
                count => format!("{count} modes grow"),
            }
        }
        Err(why) => format!("no solution is found: {why}"),
    };
    let mut index = 0;
    while let Some(point) = trace.points.get(index) {
        let description = words(point);
        let later_points = &trace.points[index + 1..];
        let more = later_points.iter().take_while(|next| {
            words(next) == description && (next.continues || next.motion.is_err())
        });
        let count = more.count();
        let end = &trace.points[index + count];
        let range = match count {
            0 => number(point.value),
            _ => format!("{} to {}", number(point.value), number(end.value)),
        };
        let jump = match (point.motion.is_ok(), point.continues, index) {
            (true, false, 1..) => " (a different motion from before)",
            _ => "",
        };
        let _ = writeln!(text, "  {range}{unit}: {description}{jump}");
        index += count + 1;
    }
}

/// How many modes grow and oscillate before and after a critical value, and at which frequency.
fn text_of_critical(critical: &Critical) -> String {
    let Critical {
        growing,
        oscillating,
        lambda,
        ..
    } = critical;
    let count = |list: &[usize; 2], verb: [&str; 2]| {
        let before = match list[0] {
            0 => "no mode".to_owned(),
            1 => "1 mode".to_owned(),
            n => format!("{n} modes"),
        };
        let after = match list[1] {
            0 => "none".to_owned(),
            n => n.to_string(),
        };
        let verb = verb[usize::from(list[0] > 1)];
        format!("{before} {verb} before it, {after} after it")
    };
    let mut parts = Vec::new();
    if growing[0] != growing[1] {
        parts.push(count(growing, ["grows", "grow"]));
    }
    if oscillating[0] != oscillating[1] {
        parts.push(count(oscillating, ["oscillates", "oscillate"]));
    }
    let mut text = parts.join("; ");
    if let Some(lambda) = lambda.filter(|lambda| lambda.im > 0.0) {
        let _ = write!(text, ", at {} Hz", number(lambda.im / TAU));
    }
    text
}

/// The position of a steady motion, with one line for each coordinate.
pub fn text_of_place(names: &[&str], units: &[&str], reached: &Reached) -> String {
    let Reached {
        q: start,
        wanted,
        motion,
    } = reached;
    let mut text = String::new();
    let width = width_of_names(names.iter().copied());
    let found = &motion.found;
    let times = if found.steps == 1 { "step" } else { "steps" };
    let kind = if wanted.steady.contains(&true) {
        "steady motion"
    } else {
        "equilibrium"
    };
    // Writing to a String cannot fail.
    let _ = writeln!(
        text,
        "{kind}, found in {} {times} from the start:",
        found.steps
    );
    for (k, (name, q)) in names.iter().zip(found.place.q()).enumerate() {
        if let Some(state) = state_of(name) {
            let unit = after_number(&unit_of_rate(name, units[k]));
            let _ = writeln!(text, "  {state:width$}  {}{unit}", number(motion.v[k]));
            continue;
        }
        let (moved, unit) = (q - start[k], units[k]);
        // Round-off, in rad or m, is not shown.
        let q = if q.abs() <= 1e-12 { 0.0 } else { q };
        let moved = if moved.abs() <= 1e-12 { 0.0 } else { moved };
        let unit = after_number(unit);
        let _ = write!(text, "  {name:width$}  {}{unit}", number(q));
        if motion.v[k] != 0.0 || wanted.solved[k] {
            let verb = if unit == " rad" { "turning" } else { "moving" };
            let _ = write!(text, ", {verb} at {}{unit}/s", number(motion.v[k]));
            if wanted.solved[k] {
                text.push_str(" (found)");
            }
        }
        if moved != 0.0 {
            let _ = write!(text, ", moved by {}", number(moved));
        }
        text.push('\n');
    }
    text
}

/// A steady motion with its modes.
pub(super) fn text(names: &[&str], units: &[&str], reached: &Reached) -> String {
    let motion = &reached.motion;
    let modes = &motion.modes;
    let mut text = text_of_place(names, units, reached);
    if modes.free > 0 {
        let directions = directions(modes.free);
        let _ = writeln!(
            text,
            "its position is not unique: it can change in {} independent {directions}",
            modes.free
        );
    }
    if is_moving(names, motion) && modes.drifts > 0 {
        let directions = directions(modes.drifts);
        let _ = writeln!(
            text,
            "its rates are not unique: they can change in {} independent {directions}",
            modes.drifts
        );
    }
    let width = width_of_names(names.iter().copied());
    for (index, mode) in modes.modes.iter().enumerate() {
        let _ = writeln!(text, "\nmode {}: {}", index + 1, text_of_mode(mode));
        // All six printed digits must be correct.
        if mode.error > 0.5e-6 * mode.lambda.norm() && mode.kind() != "free" {
            let error = number(mode.error);
            let _ = writeln!(text, "  accurate only to {error} rad/s");
        }
        for (name, x) in names.iter().zip(&mode.shape) {
            // Amplitudes that are negligible beside 1, in rad or m, are not printed; `--json` includes them.
            if x.norm() > 1e-12 {
                let name = shown_name(name);
                let _ = writeln!(text, "  {name:width$}  {}", amplitude(*x));
            }
        }
    }
    let Modes {
        lost, lost_below, ..
    } = modes;
    if *lost > 0 {
        let (motions, are) = if *lost == 1 {
            ("motion", "is")
        } else {
            ("motions", "are")
        };
        let below = number(*lost_below);
        let _ = writeln!(
            text,
            "\n{lost} more {motions} {are} slower than {below} rad/s, too slow compared with the others to be distinguished from rest"
        );
    }
    text
}

/// How a mode moves: its frequency and its damping ratio, or how fast it grows or decays.
fn text_of_mode(mode: &Mode) -> String {
    let Complex { re, im } = mode.lambda;
    let growth = || format!("unstable, grows by a factor of e in {} s", number(1.0 / re));
    match (mode.kind(), damping(mode.lambda)) {
        ("free", _) if mode.error > 0.0 => {
            format!("free, or slower than {} rad/s", number(mode.error))
        }
        ("free", _) => "free, without a restoring force".to_owned(),
        ("growing", _) => growth(),
        ("decaying", _) => format!("decays by a factor of e in {} s", number(-1.0 / re)),
        (_, Some(ratio)) => {
            let growth = if re > 0.0 {
                format!("{}, ", growth())
            } else {
                String::new()
            };
            format!(
                "{} Hz, {} rad/s, {growth}damping ratio {}",
                number(im / TAU),
                number(im),
                number(ratio)
            )
        }
        _ => String::new(),
    }
}

fn directions(count: usize) -> &'static str {
    if count == 1 {
        "direction"
    } else {
        "directions"
    }
}

/// A real amplitude with its sign, any other with its phase in degrees.
fn amplitude(x: Complex<f64>) -> String {
    // A phase that is round-off is dropped.
    if x.im.abs() <= 1e-9 * x.norm() {
        return number(x.re);
    }
    let degrees = format!("{:.1}", x.arg().to_degrees());
    format!("{} at {degrees}°", number(x.norm()))
}
