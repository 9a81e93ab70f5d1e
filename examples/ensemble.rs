//! How do I run thousands of trajectories fast? Several at a time, side by side in the registers of the processor.
//!
//! ```sh
//! cargo run --release --example ensemble
//! ```

use lagrangian::{Ensemble, Trajectory};

lagrangian::machine! {
    /// A point mass on a massless rod.
    machine Swing in plane {
        parameters { l: m = 0.5, g: m/s^2 = 9.81 }
        coordinates { theta: rad }
        bodies { bob { mass: 1, at: l*(sin(theta), -cos(theta)) } }
        gravity (0, -g);
    }
}

/// The least initial rate at the lowest point, in multiples of `step`, with which a pendulum of each length goes over the top;
/// found by trying all of them.
pub fn least_rates(lengths: &[f64], step: f64) -> Vec<f64> {
    const MOST: usize = 500;
    let trajectories = (0..lengths.len() * MOST).map(|number| {
        let machine = Swing {
            l: lengths[number / MOST],
            ..Default::default()
        };
        let mut start = machine.start();
        start.v.theta = step * (number % MOST) as f64;
        Trajectory::new(machine.prepare(), start, 3.0)
    });
    let mut least = vec![f64::INFINITY; lengths.len()];
    Ensemble::<4>::new()
        .tolerance(1e-6)
        .run(trajectories, |number, arrived| {
            let rate = step * (number % MOST) as f64;
            let place = &mut least[number / MOST];
            if arrived.is_ok_and(|arrival| arrival.end.q.theta > std::f64::consts::PI) {
                *place = place.min(rate);
            }
        });
    least
}

/// Prints the rates for three lengths.
pub fn main() {
    let lengths = [0.25, 0.5, 1.0];
    for (length, rate) in lengths.iter().zip(least_rates(&lengths, 0.05)) {
        println!("{length} m: {rate:.2} rad/s");
    }
}
