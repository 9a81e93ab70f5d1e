//! States at which the rounding errors of candidate forms are compared.

use lagrangian_program::Source;
use lagrangian_program::rounding::{SplitMix, State, States};
use lagrangian_spec::model::Model;
use lagrangian_symbolic::{Expr, Symbol, evaluate, nearest};
use rustc_hash::FxHashMap;

/// The number of states drawn for each one that must satisfy all assumptions of the spec.
const TRIES: usize = 8;

/// States around the start that satisfy all assumptions of the machine. Angles and other pure numbers vary by a full turn; lengths by half of themselves plus 2
/// cm; rates by 5 rad/s and 0.5 m/s; first-order states by half of themselves plus one half. Quaternions have length 1; times are in [0, 10) s; parameters and
/// inputs have their defaults. A parameter without a default is between ½ and 2, in its unit.
///
/// Draws `count` states, or as many as satisfy the assumptions, from a generator that starts with `seed`.
pub fn around_start(model: &Model<'_>, seed: u64, count: usize) -> States {
    let mut random = SplitMix(seed);
    let parameters = model.parameters.iter();
    let parameters: Vec<f64> = parameters
        .map(|p| match p.default {
            Some(default) => nearest(default),
            None => random.uniform(0.5, 2.0),
        })
        .collect();
    let symbols = Symbols::of(model);
    let starts = model.coordinates.iter().map(|c| c.start);
    let starts: Vec<Expr<'_>> = starts
        .chain(model.coordinates.iter().map(|c| c.start_rate))
        .collect();
    let n = model.coordinates.len();
    let facts: Vec<Expr<'_>> = model.assumptions.iter().map(|fact| fact.excess).collect();
    let at_rest = State {
        t: 0.0,
        q: vec![0.0; n],
        v: vec![0.0; n],
        u: model.inputs.iter().map(|i| nearest(i.default)).collect(),
        a: vec![0.0; n],
    };
    let starts = evaluate(model.dag, &starts, |symbol| {
        symbols.value(symbol, &parameters, &at_rest)
    });
    let is_angle: Vec<bool> = model.coordinates.iter().map(|c| c.unit.is_one()).collect();
    let mut states = Vec::with_capacity(count);
    for _ in 0..TRIES * count {
        let mut rates = || -> Vec<f64> {
            let rate = |is_angle: &bool| {
                let most = if *is_angle { 5.0 } else { 0.5 };
                random.uniform(-most, most)
            };
            is_angle.iter().map(rate).collect()
        };
        let (mut v, a) = (rates(), rates());
        // A state may be restricted to one sign, which its nonzero start shows: vary it around the start.
        for (i, v) in v.iter_mut().enumerate() {
            if model.coordinates[i].rate.is_some() {
                *v = starts[n + i] + *v * (1.0 + starts[n + i].abs());
            }
        }
        let places = starts.iter().zip(&is_angle);
        let q = places.map(|(&start, &is_angle)| {
            let half = if is_angle {
                3.2
            } else {
                0.02 + 0.5 * start.abs()
            };
            random.uniform(start - half, start + half)
        });
        let mut q: Vec<f64> = q.collect();
        let fours = model.quaternions.iter();
        fours.for_each(|four| of_length_one(&mut q, four.coordinates(model)));
        let state = State {
            q,
            v,
            a,
            u: at_rest.u.clone(),
            t: random.uniform(0.0, 10.0),
        };
        let excess = evaluate(model.dag, &facts, |symbol| {
            symbols.value(symbol, &parameters, &state)
        });
        if excess.iter().all(|excess| *excess > 0.0) {
            states.push(state);
        }
        if states.len() == count {
            break;
        }
    }
    States { parameters, states }
}

/// Normalizes a quaternion to length 1, as a run does.
pub(crate) fn of_length_one(q: &mut [f64], four: [usize; 4]) {
    let length = four.iter().map(|&i| q[i] * q[i]).sum::<f64>().sqrt();
    if length > 0.0 {
        four.iter().for_each(|&i| q[i] /= length);
    }
}

/// The argument of each symbol.
pub(crate) struct Symbols(FxHashMap<Symbol, Source>);

impl Symbols {
    pub fn of(model: &Model<'_>) -> Symbols {
        Symbols(sources(model))
    }

    /// The value of a symbol at a state; NaN for a symbol that is none of the model.
    pub fn value(&self, symbol: Symbol, parameters: &[f64], state: &State) -> f64 {
        match self.0.get(&symbol) {
            Some(Source::Parameter(index)) => parameters[*index as usize],
            Some(source) => state.read(*source),
            None => f64::NAN,
        }
    }
}

/// The source of each symbol of a model.
pub(crate) fn sources(model: &Model<'_>) -> FxHashMap<Symbol, Source> {
    let mut sources = FxHashMap::default();
    let mut add = |symbol: Expr<'_>, source: Source| {
        if let Some(symbol) = symbol.as_symbol() {
            sources.insert(symbol, source);
        }
    };
    add(model.time, Source::Time);
    for (parameter, index) in model.parameters.iter().zip(0..) {
        add(parameter.symbol, Source::Parameter(index));
    }
    for (coordinate, index) in model.coordinates.iter().zip(0..) {
        add(coordinate.q, Source::Coordinate(index));
        add(coordinate.v, Source::Velocity(index));
        add(coordinate.a, Source::Acceleration(index));
    }
    for (input, index) in model.inputs.iter().zip(0..) {
        add(input.symbol, Source::Input(index));
    }
    sources
}
