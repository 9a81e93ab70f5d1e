//! Random states of a machine, and the accuracy of its accelerations there.

use lagrangian::{Machine, System, Vector};
use lagrangian_program::Program;

use super::accuracy::Judge;
use super::random::SplitMix;
use super::states::{accelerations, vector};

/// The seed of all random states.
const SEED: u64 = 20_260_001;

/// Random states of a machine around its start at which all its assumptions hold: angles
/// in a full turn, lengths varied by half of themselves plus 2 cm, rates up to 5 rad/s
/// and 0.5 m/s, times in [0, 10).
pub struct Random<M: Machine> {
    pub system: M::System,
    start: Vec<f64>,
    is_angle: Vec<bool>,
    random: SplitMix,
}

#[derive(Debug)]
pub struct Sample {
    pub t: f64,
    pub q: Vec<f64>,
    pub v: Vec<f64>,
}

impl<M: Machine> Random<M> {
    pub fn new(machine: &M, seed: u64) -> Self {
        let system = machine.prepare();
        let start = machine.start();
        Self {
            start: system.to_vector(&start.q).as_slice().to_vec(),
            is_angle: system
                .coordinates()
                .map(|coordinate| coordinate.unit == "rad")
                .collect(),
            random: SplitMix::new(seed),
            system,
        }
    }

    pub fn sample(&mut self) -> Sample {
        for _ in 0..100_000 {
            let random = &mut self.random;
            let places = self.start.iter().zip(&self.is_angle);
            let q: Vec<f64> = places
                .map(|(&centre, &is_angle)| {
                    let half: f64 = if is_angle {
                        3.2
                    } else {
                        0.02 + 0.5 * f64::abs(centre)
                    };
                    random.uniform(centre - half, centre + half)
                })
                .collect();
            let v: Vec<f64> = self
                .is_angle
                .iter()
                .map(|&is_angle| random.uniform(-0.5, 0.5) * if is_angle { 10.0 } else { 1.0 })
                .collect();
            let t = random.uniform(0.0, 10.0);
            let (system, u) = (&self.system, self.system.default_inputs());
            let [q_vector, v_vector] = [&q, &v].map(|numbers| vector::<M::System>(numbers));
            if system
                .assumptions(t, &q_vector, &v_vector, &u)
                .all(|assumption| assumption.holds())
            {
                return Sample { t, q, v };
            }
        }
        panic!("no state near the start at which all holds that the spec assumes");
    }
}

/// Compares the accelerations of a machine at random states with 30-digit values: they must
/// be as accurate as rounding of `M` and `f` and the condition of `M` permit. `change`
/// makes the states more special.
pub fn accurate<M: Machine>(
    machine: &M,
    program: &Program,
    states: usize,
    change: impl Fn(&mut Sample),
) {
    let mut random = Random::new(machine, SEED);
    let parameters: Vec<f64> = machine.parameters().map(|(_, value)| value).collect();
    let mut judge = Judge::new(program, &parameters);
    let inputs = random.system.default_inputs();
    let values = random.system.input_values(&inputs);
    let u: Vec<f64> = values.map(|(_, value)| value).collect();
    let mut judged = Vec::new();
    for i in 0..states {
        let mut sample = random.sample();
        change(&mut sample);
        let Sample { t, q, v } = sample;
        let place = || {
            format!(
                "{}, state {i} of seed {SEED}: {t} s, {q:?}, {v:?}",
                machine.name()
            )
        };
        let a = accelerations(&random.system, t, &q, &v);
        let a = a.unwrap_or_else(|singular| panic!("{}: {singular}", place()));
        let accuracy = judge.accuracy((t, &q, &v, &u), &a).expect("not singular");
        let (error, limit, condition) = (accuracy.error, accuracy.limit, accuracy.condition);
        assert!(
            error <= limit,
            "{}: error {error:e}, limit {limit:e}, κ {condition:e}",
            place()
        );
        judged.push((accuracy.size, limit, condition, place()));
    }
    // The limit is c κ ε times the accelerations, where c reflects the number of
    // operations, about a thousand. Where the accelerating forces nearly cancel, as with
    // certain motions of a shaken pivot, the accelerations are small compared with their
    // terms; the median serves as the typical size.
    judged.sort_by(|one, other| one.0.total_cmp(&other.0));
    let median = judged.get(judged.len() / 2).map_or(0.0, |&(size, ..)| size);
    for (size, limit, condition, place) in judged {
        let usual = 1e4 * condition * f64::EPSILON * f64::max(size, median);
        assert!(
            limit <= usual,
            "{place}: a limit of {limit:e} at κ {condition:e} says nothing"
        );
    }
}
