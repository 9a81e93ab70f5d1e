//! Trajectories per second: one after another by a stepper, and 4 or 8 at a time by an ensemble.
//!
//! ```sh
//! cargo bench --bench ensemble
//! cargo bench --bench ensemble -- --ends FOLDER
//! ```
//!
//! The second command runs 256 double pendulums and 256 crushers at many tolerances, and writes their end states
//! for `benches/peers/ensembles.py`.

mod timing;

use std::hint::black_box;

use lagrangian::{Batched, Ensemble, Machine, Method, Stepper, System, Trajectory};
use lagrangian_machines::{CartPole, Crusher9, DoublePendulum, VibratingCrusher};

/// Trajectories of one machine with various durations and starts.
fn trajectories<M: Machine>(machine: &M, end: f64) -> Vec<Trajectory<M::System>>
where
    M::System: Clone,
{
    (0..400)
        .map(|i| {
            let part = f64::from(i) / 400.0;
            let mut trajectory = Trajectory::of(machine, end * (0.5 + part));
            let mut q = trajectory.system.to_vector(&trajectory.start.q);
            for q in lagrangian::Vector::as_mut_slice(&mut q) {
                *q += 0.01 * part;
            }
            trajectory.start.q = trajectory.system.to_coordinates(&q);
            trajectory
        })
        .collect()
}

/// Trajectories per second of processor time, the best of twenty measurements.
fn rate(count: usize, mut run: impl FnMut()) -> f64 {
    let seconds = (0..20).map(|_| timing::seconds(&mut run).0);
    count as f64 / seconds.fold(f64::INFINITY, f64::min)
}

fn compare<M: Machine>(machine: &M, end: f64, method: &'static Method, tolerance: f64)
where
    M::System: Batched<4> + Batched<8> + 'static,
{
    let trajectories = trajectories(machine, end);
    let alone = rate(trajectories.len(), || {
        for trajectory in &trajectories {
            let stepper = Stepper::builder(trajectory.system).method(method);
            let mut stepper = stepper
                .tolerance(tolerance)
                .start(trajectory.start.clone())
                .expect("accelerations");
            stepper.advance_to(trajectory.end).expect("a run");
            black_box(stepper.q());
        }
    });
    let arrived = |_, arrived: Result<_, _>| {
        black_box(arrived.is_ok());
    };
    let four = rate(trajectories.len(), || {
        let ensemble = Ensemble::<4>::new().method(method).tolerance(tolerance);
        ensemble.run(trajectories.iter().cloned(), arrived);
    });
    let eight = rate(trajectories.len(), || {
        let ensemble = Ensemble::<8>::new().method(method).tolerance(tolerance);
        ensemble.run(trajectories.iter().cloned(), arrived);
    });
    println!(
        "| {} | {} | {tolerance:e} | {alone:.0} | {four:.0} | {eight:.0} | {:.2} |",
        machine.name(),
        method.tableau.name,
        four.max(eight) / alone
    );
}

/// Runs at many tolerances with each method. Prints a line of JSON with the seconds of processor time, the best of nine
/// measurements, and writes a file of the end states, coordinates and then rates of each, as 64-bit numbers in little-endian order.
fn ends<M: Machine, const W: usize>(
    folder: &str,
    name: &str,
    trajectories: &[Trajectory<M::System>],
) where
    M::System: Batched<W> + 'static,
{
    for method in [Method::DOP853, Method::TAYLOR] {
        for power in 4..=13 {
            let tolerance = 10_f64.powi(-power);
            let ensemble = Ensemble::<W>::new().method(method).tolerance(tolerance);
            let mut ends = vec![Vec::<f64>::new(); trajectories.len()];
            let times = (0..9).map(|_| {
                let run = || {
                    ensemble.run(trajectories.iter().cloned(), |i, arrived: Result<_, _>| {
                        let arrival: lagrangian::Arrival<_> = arrived.expect("a run");
                        let system = &trajectories[i].system;
                        let both = [&arrival.end.q, &arrival.end.v].map(|x| system.to_vector(x));
                        let numbers = both.iter().flat_map(lagrangian::Vector::as_slice);
                        ends[i].clear();
                        ends[i].extend(numbers);
                    });
                };
                timing::seconds(run).0
            });
            let seconds = times.fold(f64::INFINITY, f64::min);
            let method = method.tableau.name;
            let file = format!("{folder}/{name}-{method}-{W}-{power}.bin");
            let bytes: Vec<u8> = ends
                .iter()
                .flatten()
                .flat_map(|x| x.to_le_bytes())
                .collect();
            std::fs::write(&file, bytes).expect("the folder takes files");
            println!(
                "{{\"machine\": \"{name}\", \"method\": \"{method}, {W} lanes\", \"tolerance\": {tolerance:e}, \
                 \"seconds\": {seconds}, \"file\": \"{file}\"}}"
            );
        }
    }
}

/// A grid of 16 by 16 points in the unit square.
fn grid() -> impl Iterator<Item = [f64; 2]> {
    const SIDE: u32 = 16;
    (0..SIDE * SIDE).map(|i| [i / SIDE, i % SIDE].map(|k| f64::from(k) / f64::from(SIDE - 1)))
}

/// The runs that `benches/peers/ensembles.py` compares: double pendulums released at rest from a grid of angles, for 5 s, and
/// crushers from a grid of distances, for 0.5 s.
fn all_ends(folder: &str) {
    let pendulum = Trajectory::of(&DoublePendulum::default(), 5.0);
    let pendulums = grid().map(|[i, k]| {
        let mut trajectory = pendulum.clone();
        let start = &mut trajectory.start;
        (start.q.theta1, start.q.theta2) = (0.1 + 0.9 * i, 0.1 + 0.9 * k);
        (start.v.theta1, start.v.theta2) = (0.0, 0.0);
        trajectory
    });
    let pendulums: Vec<_> = pendulums.collect();
    ends::<DoublePendulum, 4>(folder, "pendulum", &pendulums);
    ends::<DoublePendulum, 8>(folder, "pendulum", &pendulums);
    let crusher = Trajectory::of(&Crusher9::default(), 0.5);
    let crushers = grid().map(|[i, k]| {
        let mut trajectory = crusher.clone();
        let start = &mut trajectory.start;
        (start.q.s1, start.q.s2) = (0.14 + 0.02 * i, 0.09 + 0.02 * k);
        trajectory
    });
    let crushers: Vec<_> = crushers.collect();
    ends::<Crusher9, 4>(folder, "crusher", &crushers);
    ends::<Crusher9, 8>(folder, "crusher", &crushers);
}

fn main() {
    let mut arguments = std::env::args().skip_while(|argument| argument != "--ends");
    if let Some(folder) = arguments.nth(1) {
        return all_ends(&folder);
    }
    println!("| machine | method | tolerance | one by one | 4 at a time | 8 at a time | gain |");
    println!("| --- | --- | --: | --: | --: | --: | --: |");
    for (method, tolerance) in [(Method::DOP853, 1e-9), (Method::DOPRI5, 1e-5)] {
        compare(&DoublePendulum::default(), 2.0, method, tolerance);
        compare(&CartPole::default(), 2.0, method, tolerance);
        compare(&VibratingCrusher::default(), 0.2, method, tolerance);
    }
    for tolerance in [1e-6, 1e-9, 1e-12] {
        compare(&DoublePendulum::default(), 2.0, Method::TAYLOR, tolerance);
        compare(&Crusher9::default(), 0.2, Method::TAYLOR, tolerance);
    }
    compare(&Crusher9::default(), 0.2, Method::DOP853, 1e-9);
}
