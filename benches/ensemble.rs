//! How many trajectories a second: one after another by a stepper, and 4 or 8 at a time by an ensemble.
//!
//! ```sh
//! cargo bench --bench ensemble
//! cargo bench --bench ensemble -- --ends FOLDER
//! ```
//!
//! The second runs 256 double pendulums to many tolerances, and writes where they end, for `benches/peers/ensembles.py`.

mod timing;

use std::hint::black_box;

use lagrangian::{Batched, Ensemble, Machine, Method, Stepper, System, Trajectory};
use lagrangian_machines::{CartPole, DoublePendulum, VibratingCrusher};

/// Trajectories of one kind, of several lengths and starts.
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

/// Trajectories a second of the processor's time, the best of twenty times.
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

/// Double pendulums from a grid of angles at rest, for 5 s: for each tolerance a line of JSON with the processor's seconds, the best of
/// nine times, and a file of the ends, θ1, θ2 and their rates for each, as 64-bit numbers in little-endian order.
fn ends(folder: &str) {
    const SIDE: u32 = 16;
    const END: f64 = 5.0;
    let machine = DoublePendulum::default();
    let start = Trajectory::of(&machine, END);
    let trajectories: Vec<_> = (0..SIDE * SIDE)
        .map(|i| {
            let mut trajectory = start.clone();
            let at = |k: u32| 0.1 + 0.9 * f64::from(k) / f64::from(SIDE - 1);
            trajectory.start.q.theta1 = at(i / SIDE);
            trajectory.start.q.theta2 = at(i % SIDE);
            (trajectory.start.v.theta1, trajectory.start.v.theta2) = (0.0, 0.0);
            trajectory
        })
        .collect();
    for power in 4..=13 {
        let tolerance = 10_f64.powi(-power);
        let ensemble = Ensemble::<8>::new()
            .method(Method::DOP853)
            .tolerance(tolerance);
        let mut ends = vec![[f64::NAN; 4]; trajectories.len()];
        let times = (0..9).map(|_| {
            let run = || {
                ensemble.run(trajectories.iter().cloned(), |i, arrived: Result<_, _>| {
                    if let Ok(lagrangian::Arrival { end, .. }) = arrived {
                        let (q, v) = (end.q, end.v);
                        ends[i] = [q.theta1, q.theta2, v.theta1, v.theta2];
                    }
                });
            };
            timing::seconds(run).0
        });
        let seconds = times.fold(f64::INFINITY, f64::min);
        let file = format!("{folder}/lagrangian-{power}.bin");
        let bytes: Vec<u8> = ends
            .iter()
            .flatten()
            .flat_map(|x| x.to_le_bytes())
            .collect();
        std::fs::write(&file, bytes).expect("the folder takes files");
        println!("{{\"tolerance\": {tolerance:e}, \"seconds\": {seconds}, \"file\": \"{file}\"}}");
    }
}

fn main() {
    let mut arguments = std::env::args().skip_while(|argument| argument != "--ends");
    if let Some(folder) = arguments.nth(1) {
        return ends(&folder);
    }
    println!("| machine | method | tolerance | one by one | 4 at a time | 8 at a time | gain |");
    println!("| --- | --- | --: | --: | --: | --: | --: |");
    for (method, tolerance) in [(Method::DOP853, 1e-9), (Method::DOPRI5, 1e-5)] {
        compare(&DoublePendulum::default(), 2.0, method, tolerance);
        compare(&CartPole::default(), 2.0, method, tolerance);
        compare(&VibratingCrusher::default(), 0.2, method, tolerance);
    }
}
