//! The rounding errors that the choice between programs estimates agree with measured ones.

use crate::support::library::{self, CONSTRAINED, MACHINES};
use crate::support::random::SplitMix;
use crate::support::sampling::{Random, Sample};
use lagrangian::interpreted::InterpretedMachine;
use lagrangian_mechanics::Proved;
use lagrangian_native::Fused;
use lagrangian_program::{Arguments, Candidate, Interpreter, MOST_ROUNDING, Role, Slot};
use lagrangian_scalar::DoubleDouble;

/// The number of states at which an estimate is made: see `crates/program/src/rounding.rs`.
const ESTIMATED: f64 = 31.0;
/// The number of states at which errors are measured here.
const STATES: usize = 101;
/// The number of points near each of these states at which errors are measured; their rounding errors are unrelated.
const NEAR: usize = 16;

/// The logarithm of ‖Δr‖/‖r‖ of the results of a function, in units of 2⁻⁵³ and against double-double numbers, at each of the
/// states where there are any results. It is the root mean square over points near the state, whose values, parameters included,
/// differ from the state's in the sixth digit.
fn measured(program: &Proved, role: Role) -> Vec<f64> {
    let machine = InterpretedMachine::new(program.clone());
    let default = |slot: &Slot| slot.default.as_ref().expect("a default").value;
    let parameters: Vec<f64> = program.parameters.iter().map(default).collect();
    let inputs: Vec<f64> = program.inputs.iter().map(default).collect();
    let (mut fused, mut exact) = (
        Interpreter::new(program, &parameters),
        Interpreter::new(program, &wide(&parameters)),
    );
    let len = program.function(role).map_or(0, |f| f.results.len());
    let (mut computed, mut truth) = (vec![0.0; len], vec![DoubleDouble::from(0.0); len]);
    let mut random = Random::new(&machine, 20_261_121);
    let mut digits = SplitMix::new(7);
    let mut errors = Vec::with_capacity(STATES);
    for _ in 0..STATES {
        let Sample { t, mut q, v } = random.sample();
        // The four numbers of a quaternion have the length at which a run keeps them, as in the estimate of the choice.
        for four in &program.quaternions {
            let length = four.iter().map(|&i| q[i] * q[i]).sum::<f64>().sqrt();
            four.iter().for_each(|&i| q[i] /= length);
        }
        let a = vec![0.3; q.len()];
        let mut sum = 0.0;
        for _ in 0..NEAR {
            let mut near = |x: &[f64]| -> Vec<f64> {
                x.iter()
                    .map(|x| x * (1.0 + 1e-6 * digits.uniform(-1.0, 1.0)))
                    .collect()
            };
            let parameters = near(&parameters);
            fused.prepare(&parameters);
            exact.prepare(&wide(&parameters));
            let [time, q, v, u, a] = [&[t], q.as_slice(), &v, &inputs, &a].map(&mut near);
            let at = Arguments {
                t: time[0],
                q: &q,
                v: &v,
                u: &u,
                a: &a,
            };
            fused
                .call_in::<Fused>(role, at, &mut computed)
                .expect("a regular state");
            let [q, v, u, a] = [&q, &v, &u, &a].map(|x| wide(x));
            let at = Arguments {
                t: time[0].into(),
                q: &q,
                v: &v,
                u: &u,
                a: &a,
            };
            exact.call(role, at, &mut truth).expect("a regular state");
            let errors = computed
                .iter()
                .zip(&truth)
                .map(|(computed, truth)| (DoubleDouble::from(*computed) - *truth).hi());
            sum += square(errors) / square(truth.iter().map(|truth| truth.hi()));
        }
        let error = (sum / NEAR as f64).sqrt() / (f64::EPSILON / 2.0);
        if error.is_finite() {
            errors.push(error.ln());
        }
    }
    errors.sort_by(f64::total_cmp);
    errors
}

fn wide(numbers: &[f64]) -> Vec<DoubleDouble> {
    numbers.iter().map(|x| DoubleDouble::from(*x)).collect()
}

fn square(numbers: impl Iterator<Item = f64>) -> f64 {
    numbers.map(|x| x * x).sum()
}

/// The value below which the given fraction of sorted numbers lies.
fn quantile(sorted: &[f64], share: f64) -> f64 {
    sorted[(share * (sorted.len() - 1) as f64).round() as usize]
}

/// How far the logarithm of an estimate may be from that of the median measured error. The logarithms of the measured errors
/// have the standard deviation `spread`.
///
/// Where most of the error comes from one number that has about the same size everywhere, the estimate takes its rounding for
/// that of a number of any size, which is between 1/(1.47) and 1.36 of the true one. The rest is chance. The standard error of
/// the median of N normal numbers is √(π/2N) times their standard deviation. Four sweeps leave a variance of 2/4 in the square
/// of an error, which is 1/8 in its logarithm; 16 points near a state leave one of 1/32 at most. The limit allows three standard
/// errors of both together.
fn limit(spread: f64) -> f64 {
    let estimated = (spread.powi(2) + 1.0 / 8.0) / ESTIMATED;
    let measured = (spread.powi(2) + 1.0 / 32.0) / STATES as f64;
    let by_size = 1.47_f64.ln();
    by_size + 3.0 * (std::f64::consts::FRAC_PI_2 * (estimated + measured)).sqrt()
}

#[test]
fn rounding_of_machines_without_constraints_is_what_the_choice_takes_it_for() {
    check_rounding(MACHINES.into_iter());
}

#[test]
fn rounding_of_machines_with_constraints_is_what_the_choice_takes_it_for() {
    check_rounding(CONSTRAINED.into_iter());
}

fn check_rounding(machines: impl Iterator<Item = &'static str>) {
    for name in machines {
        for choice in &library::program(name, &[]).choices {
            let role = choice.role();
            // The voltage is the same at all states here and provides most of the power. The estimate varies inputs over any
            // size, for which losses and supplied power cancel.
            if (name, role) == ("dc_motor", Role::WorkRate) {
                continue;
            }
            let judge = |(index, candidate): (usize, &Candidate)| {
                let errors = measured(&library::program_by(name, &[], &|_| index), role);
                let spread = 0.5 * (quantile(&errors, 0.84) - quantile(&errors, 0.16));
                let rounding = candidate.rounding.expect("regular states");
                let (estimate, median) = (rounding.units().ln(), quantile(&errors, 0.5));
                // The estimate for the turn of a quaternion about an axis is twice the measured loss, which is on the safe side;
                // the estimate does not know which of its numbers round less than others of their size.
                let is_turn = (name, role) == ("upright_top", Role::Output(1));
                let more = if is_turn { 1.25_f64.ln() } else { 0.0 };
                assert!(
                    median - estimate <= limit(spread) && estimate - median <= limit(spread) + more,
                    "{name}, {}, {candidate}: measured {:.2}, e^{spread:.2}",
                    role.name(),
                    median.exp(),
                );
                (estimate, median)
            };
            let judged: Vec<(f64, f64)> = choice.candidates.iter().enumerate().map(judge).collect();
            // A factor of two, and the ratio of two estimates is correct to within a factor of one and a half.
            let least = judged
                .iter()
                .map(|(_, median)| *median)
                .fold(f64::INFINITY, f64::min);
            let taken = judged[choice.chosen].1;
            assert!(
                taken - least <= (1.5 * MOST_ROUNDING as f64).ln(),
                "{name}, {}: {} times what it might be",
                role.name(),
                (taken - least).exp()
            );
        }
    }
}
