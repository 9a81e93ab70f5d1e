//! How do I take single steps, without an allocator? The core of every run, for a controller or a loop in real time.
//!
//! ```sh
//! cargo run --release --example single_steps
//! ```

use lagrangian::{DefaultInputs, METHODS, NoBalance, StepError, Stepper, System, Tolerance};

lagrangian::machine! {
    /// A block on a spring, with x = cos t.
    machine Oscillator in plane {
        parameters { m: kg = 1, k: N/m = 1 }
        coordinates { x: m = 1 }
        bodies { block { mass: m, at: (x, 0) } }
        springs { spring { stiffness: k, stretch: x } }
    }
}

/// Calls `seen` with time and position every tenth of a second, and returns the number of steps.
pub fn steps(until: f64, mut seen: impl FnMut(f64, f64)) -> Result<usize, StepError> {
    let machine = Oscillator::default();
    let (system, start) = (machine.prepare(), machine.start());
    let start = (0.0, start.q.to_array(), start.v.to_array());
    let tolerance = Tolerance {
        relative: 1e-10,
        absolute: [1e-10],
    };
    let (law, alongside, method) = (DefaultInputs, NoBalance, &METHODS[0]);
    let mut stepper = Stepper::new(&system, law, alongside, method, tolerance, start, until)?;
    let mut ticks = (0..).map(|tick| f64::from(tick) / 10.0).peekable();
    while !stepper.is_done() {
        stepper.step()?;
        // Steps are as long as the tolerance permits; between their ends the motion is known as accurately as there.
        let (from, to) = (stepper.t_before(), stepper.t());
        let piece = stepper.interpolant()?;
        while let Some(t) = ticks.next_if(|&t| t <= to) {
            let ([x], _) = piece.state_at((t - from) / (to - from));
            seen(t, x);
        }
    }
    Ok(stepper.work().steps)
}

/// Prints the motion at every tenth of a second.
pub fn main() -> Result<(), StepError> {
    let coordinates = Oscillator::default().prepare();
    let unit = coordinates.coordinates().next().map_or("", |x| x.unit);
    let taken = steps(2.0, |t, x| println!("{t:3.1} s {x:13.10} {unit}"))?;
    println!("{taken} steps");
    Ok(())
}
