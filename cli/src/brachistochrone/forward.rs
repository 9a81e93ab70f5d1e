//! Verifies the result: simulated with its own law of friction under the control forces, the machine must arrive.

use std::f64::consts::PI;

use lagrangian::interpreted::Named;
use lagrangian::{Machine, Simulation};
use lagrangian_spec::model::Coordinate;
use lagrangian_symbolic::Dag;

use super::found::{Arrival, FastestResult};
use crate::call;
use crate::failure::Failure;
use crate::reading::{self, Reading};

/// The tolerance of the simulation.
const TOLERANCE: f64 = 1e-11;

/// Control forces are smooth in time: interpolation at this number of Chebyshev points is as accurate as the run.
const POINTS: u32 = 48;

/// Simulates the machine from rest under the control forces for the computed time.
///
/// # Errors
/// Why it does not arrive, as the end of a sentence.
pub fn arrival(
    call: &call::Brachistochrone,
    coordinates: &[Coordinate<'_>],
    found: &FastestResult<'_>,
) -> Result<Arrival, String> {
    let dag = Dag::new();
    let reading =
        Reading::controlled(&call.spec, coordinates).map_err(|why| derivation_failure(&why))?;
    let compiled = reading
        .compile(&dag)
        .map_err(|why| derivation_failure(&why))?;
    let start = call::Start {
        parameters: call.parameters.clone(),
        coordinates: Vec::new(),
        rates: Vec::new(),
        running: call.running,
    };
    let machine = reading::machine(&compiled, &start).map_err(|why| derivation_failure(&why))?;
    let motion = &found.motion;
    let forces = Chebyshev::new(motion.time(), |t| motion.at(t).control);
    let [from, to] = [0, found.moments.len() - 1].map(|k| &found.moments[k].q);
    let mut state = machine.start();
    state.q.values.clone_from(from);
    state.v.values.fill(0.0);
    let run = Simulation::new(&machine)
        .tolerance(TOLERANCE)
        .inputs(|t, _: &Named, _: &Named, u: &mut Named| u.values.clone_from(&forces.at(t)))
        .until(motion.time())
        .run_interpreted(state)
        .map_err(|error| format!("the machine does not arrive at the end: {error}"))?;
    let pairs = run.end().q.values.iter().zip(to);
    let far = pairs.map(|(q, to)| (q - to).abs()).fold(0.0, f64::max);
    let distances = from.iter().zip(to).map(|(from, to)| (to - from).abs());
    let off = far / distances.fold(f64::MIN_POSITIVE, f64::max);
    // A machine that sticks or lifts off ends far away.
    if off < 1e-3 {
        Ok(Arrival { off })
    } else {
        Err(format!(
            "the machine misses the end by {off:.1e} of the distance"
        ))
    }
}

/// The message that the machine with inputs for the control forces cannot be derived, as the end of a sentence.
fn derivation_failure(failure: &Failure) -> String {
    let message = "the machine with inputs for the control forces cannot be derived";
    let why = match failure {
        Failure::Spec(wrong) => {
            let errors = wrong.0.diagnostics();
            errors.first().map(|first| first.message.clone())
        }
        _ => None,
    };
    why.map_or_else(|| message.to_owned(), |why| format!("{message}: {why}"))
}

/// The interpolating polynomial at Chebyshev points of the second kind. J.-P. Berrut and L. N. Trefethen, *Barycentric
/// Lagrange interpolation*, SIAM Review 46 (2004) 501, eq. (5.4).
struct Chebyshev {
    values: Vec<(f64, Vec<f64>)>,
}

impl Chebyshev {
    fn new(until: f64, value: impl Fn(f64) -> Vec<f64>) -> Chebyshev {
        let points = (0..=POINTS).map(|k| {
            let t = until * 0.5 * (1.0 - (PI * f64::from(k) / f64::from(POINTS)).cos());
            (t, value(t))
        });
        Chebyshev {
            values: points.collect(),
        }
    }

    fn at(&self, t: f64) -> Vec<f64> {
        let last = self.values.len() - 1;
        let (mut sums, mut whole) = (vec![0.0; self.values[0].1.len()], 0.0);
        for (k, (point, value)) in self.values.iter().enumerate() {
            if t == *point {
                return value.clone();
            }
            let sign = if k % 2 == 0 { 1.0 } else { -1.0 };
            let end = if k == 0 || k == last { 0.5 } else { 1.0 };
            let weight = sign * end / (t - point);
            whole += weight;
            for (sum, value) in sums.iter_mut().zip(value) {
                *sum += weight * value;
            }
        }
        sums.iter().map(|sum| sum / whole).collect()
    }
}
