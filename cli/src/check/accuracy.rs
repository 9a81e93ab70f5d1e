//! `lagrangian check --accuracy`: the rounding errors of a machine's program, compared with double-doubles.

use lagrangian::Machine;
use lagrangian::interpreted::InterpretedMachine;
use lagrangian_mechanics::{Compiled, around_start};
use lagrangian_program::accuracy::{Accuracy, AccuracyTest};
use lagrangian_program::rounding::{SplitMix, State};
use lagrangian_program::{Program, Slot};
use serde_json::{Map, Value, json};

use crate::output;

/// The number of states sampled around the start.
const AROUND: usize = 256;

/// The number of these from which extreme states are made.
const EXTREME: usize = 128;

/// The number of these from which a search leads towards singular states.
const SINGULAR: usize = 16;

/// The result.
pub struct AccuracyCheck {
    quantities: Vec<Accuracy>,
    states: Vec<(StateChoice, State)>,
}

/// How a state was chosen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum StateChoice {
    Around,
    Extreme,
    Singular,
}

impl StateChoice {
    fn words(self) -> &'static str {
        match self {
            StateChoice::Around => "around the start",
            StateChoice::Extreme => "extreme",
            StateChoice::Singular => "nearly singular",
        }
    }
}

/// Evaluates a machine around its start, at extreme and at nearly singular states.
pub fn evaluate(compiled: &Compiled<'_>) -> AccuracyCheck {
    let program: &Program = &compiled.program;
    let machine = InterpretedMachine::new(compiled.program.clone());
    let drawn = around_start(&compiled.model, 3, AROUND);
    let mut with_parameters = machine.clone();
    for (index, value) in drawn.parameters.iter().enumerate() {
        // Parameters without a default were sampled too.
        if let Some(parameter) = with_parameters.parameter_mut(index) {
            *parameter = *value;
        }
    }
    let system = with_parameters.prepare();
    let mut judge = AccuracyTest::new(program, &drawn.parameters);
    let mut random = SplitMix(4);
    let extreme = drawn.states.iter().take(EXTREME);
    let extreme: Vec<State> = extreme
        .map(|state| extreme_state(program, state, &mut random))
        .filter(|state| judge.satisfies_assumptions(state))
        .collect();
    let singular = drawn.states.iter().take(SINGULAR);
    let singular: Vec<State> = singular.map(|from| judge.towards_singular(from)).collect();
    let kinds = [
        (StateChoice::Around, drawn.states),
        (StateChoice::Extreme, extreme),
        (StateChoice::Singular, singular),
    ];
    let states: Vec<(StateChoice, State)> = kinds
        .into_iter()
        .flat_map(|(kind, states)| states.into_iter().map(move |state| (kind, state)))
        .collect();
    for (_, state) in &states {
        judge.examine(state, &mut |role, arguments, results| {
            system.quantity(role, arguments, results).is_ok()
        });
    }
    AccuracyCheck {
        quantities: judge.finish(),
        states,
    }
}

/// An extreme state: angles of many turns, large rates, late time.
fn extreme_state(program: &Program, state: &State, random: &mut SplitMix) -> State {
    let mut stretched = state.clone();
    stretched.t *= 10_f64.powf(random.uniform(0.0, 6.0));
    let by = 10_f64.powf(random.uniform(0.0, 6.0));
    for (slot, i) in program.coordinates.iter().zip(0..) {
        if slot.unit.is_one() {
            stretched.q[i] *= 10_f64.powf(random.uniform(0.0, 5.0));
        }
        stretched.v[i] *= by;
        stretched.a[i] *= by;
    }
    // Quaternions keep the length that a run would give them.
    for &four in &program.quaternions {
        let length = four
            .map(|i| stretched.q[i].powi(2))
            .iter()
            .sum::<f64>()
            .sqrt();
        four.iter().for_each(|&i| stretched.q[i] /= length);
    }
    stretched
}

impl AccuracyCheck {
    /// Prints a table, followed by the worst state.
    pub fn print(&self, program: &Program) {
        let count = |kind| self.states.iter().filter(|(k, _)| *k == kind).count();
        output::line(format_args!(
            "accuracy at {} states around the start, {} extreme and {} nearly singular ones:",
            count(StateChoice::Around),
            count(StateChoice::Extreme),
            count(StateChoice::Singular)
        ));
        output::line(format_args!(
            "{:24} {:>8} {:>8} {:>10}  where it is worst",
            "quantity", "median", "worst", "ulps there"
        ));
        for found in &self.quantities {
            let title = program.title(found.role);
            if found.worst.share == 0.0 {
                output::line(format_args!("{title:24} {:>8}", "exact"));
                continue;
            }
            let (kind, _) = self.states[found.worst.state];
            output::line(format_args!(
                "{title:24} {:>8} {:>8} {:>10}  {}, {}",
                rounded(found.median),
                rounded(found.worst.share),
                rounded(found.worst.units),
                program.result_name(found.role, found.worst.index),
                kind.words(),
            ));
        }
        let worst = self
            .quantities
            .iter()
            .max_by(|a, b| a.worst.share.total_cmp(&b.worst.share));
        if let Some(worst) = worst {
            let state = Value::Object(numbers(program, &self.states[worst.worst.state].1));
            output::line(format_args!(
                "the worst state, for {}: {state}",
                program.title(worst.role)
            ));
        }
    }

    /// The result as JSON: a list of quantities.
    pub fn json(&self, program: &Program) -> Value {
        let quantity = |found: &Accuracy| {
            let (kind, state) = &self.states[found.worst.state];
            json!({
                "quantity": program.title(found.role),
                "states": found.known,
                "median": found.median,
                "worst": found.worst.share,
                "ulps": found.worst.units,
                "error": found.worst.error,
                "result": program.result_name(found.role, found.worst.index),
                "kind": kind.words(),
                "state": numbers(program, state),
            })
        };
        self.quantities.iter().map(quantity).collect()
    }
}

/// Rounds to two decimals or, if large, to a power of ten.
fn rounded(number: f64) -> String {
    if number < 1e4 {
        format!("{number:.2}")
    } else {
        format!("{number:.1e}")
    }
}

/// A state in the form that `evaluate --at` reads.
fn numbers(program: &Program, state: &State) -> Map<String, Value> {
    let named = |slots: &[Slot], values: &[f64]| -> Value {
        let pairs = slots.iter().zip(values);
        let pairs = pairs.map(|(slot, value)| (slot.name.to_string(), json!(value)));
        Value::Object(pairs.collect())
    };
    let mut numbers = Map::new();
    numbers.insert("t".into(), json!(state.t));
    numbers.insert("q".into(), named(&program.coordinates, &state.q));
    numbers.insert("v".into(), named(&program.coordinates, &state.v));
    if !program.inputs.is_empty() {
        numbers.insert("inputs".into(), named(&program.inputs, &state.u));
    }
    numbers
}
