//! Inputs that a plan sets.

use lagrangian::InputLaw;
use lagrangian::interpreted::{InterpretedSystem, Named};

/// What the inputs do.
#[derive(Clone, Debug, Default)]
pub(crate) struct Laws {
    /// Which inputs, each with what it does.
    pub rules: Vec<(usize, Rule)>,
}

/// What an input does.
#[derive(Clone, Debug)]
pub(crate) enum Rule {
    /// It is the output of this number.
    Output(usize),
    /// It goes through values at times.
    Table { times: Vec<f64>, values: Vec<f64> },
}

impl InputLaw<InterpretedSystem> for Laws {
    fn set(
        &self,
        system: &InterpretedSystem,
        t: f64,
        q: &Vec<f64>,
        v: &Vec<f64>,
        inputs: &mut Named,
    ) {
        for (place, rule) in &self.rules {
            inputs.values[*place] = match rule {
                // It does not depend on inputs that are set: those that it reads have their defaults.
                Rule::Output(output) => system.output(*output, t, q, v, &[], &inputs.values),
                Rule::Table { times, values } => between(times, values, t),
            };
        }
    }

    fn is_constant(&self) -> bool {
        self.rules.is_empty()
    }
}

/// The value at a time on straight lines between those of a table.
fn between(times: &[f64], values: &[f64], t: f64) -> f64 {
    let next = times.partition_point(|time| *time <= t);
    let value = |place: usize| values.get(place).copied().unwrap_or(f64::NAN);
    match next {
        0 => value(0),
        _ if next >= times.len() => value(times.len() - 1),
        _ => {
            let share = (t - times[next - 1]) / (times[next] - times[next - 1]);
            value(next - 1) + share * (value(next) - value(next - 1))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tables_are_straight_between_their_values() {
        let at = |t| between(&[0.0, 1.0, 3.0], &[2.0, 4.0, 0.0], t);
        for (t, known) in [
            (-1.0, 2.0),
            (0.0, 2.0),
            (0.5, 3.0),
            (1.0, 4.0),
            (2.0, 2.0),
            (9.0, 0.0),
        ] {
            assert_eq!(at(t), known);
        }
    }
}
