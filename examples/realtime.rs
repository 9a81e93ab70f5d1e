//! How do I step a machine in a loop of a fixed rate? A double pendulum in a loop of 1 kHz, with the longest time of a tick.
//!
//! ```sh
//! cargo run --release --example realtime
//! ```

use std::time::{Duration, Instant};

use lagrangian::{Method, StepError, Stepper};
use lagrangian_machines::{DoublePendulum, double_pendulum};

/// Damps both rods by torques, a thousand times a second. Passes angles, rates and the duration of each tick to `seen`.
pub fn ticks(
    count: u32,
    mut seen: impl FnMut(&lagrangian::State<double_pendulum::Coordinates>, Duration),
) -> Result<(), StepError> {
    let machine = DoublePendulum::default();
    // A step lasts one tick, so a method of fewer stages is accurate enough; nothing is allocated from here on.
    let stepper = Stepper::builder(machine.prepare())
        .method(Method::DOPRI5)
        .tolerance(1e-8);
    let mut stepper = stepper.start(machine.start())?;
    for tick in 1..=count {
        let clock = Instant::now();
        stepper.advance_to(f64::from(tick) * 1e-3)?;
        let state = stepper.state();
        seen(&state, clock.elapsed());
    }
    Ok(())
}

/// Prints the mean and the longest time of a tick.
pub fn main() -> Result<(), StepError> {
    let (mut longest, mut sum) = (Duration::ZERO, Duration::ZERO);
    ticks(10_000, |_, took| {
        longest = longest.max(took);
        sum += took;
    })?;
    println!(
        "a tick of 1 ms takes {:?}, and {longest:?} at most",
        sum / 10_000
    );
    Ok(())
}
