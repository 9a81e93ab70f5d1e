//! How long is a pendulum's period at a large amplitude? An event, and a closed form to hold it against.
//!
//! ```sh
//! cargo run --release --example pendulum
//! ```

use lagrangian::{Crossing, Error, Simulation};

lagrangian::machine! {
    /// A point mass on a massless rod; the angle is measured from the downward vertical.
    machine Pendulum in plane {
        parameters { m: kg = 1, l: m = 0.5, g: m/s^2 = 9.81 }
        coordinates { theta: rad }
        bodies { bob { mass: m, at: l*(sin(theta), -cos(theta)) } }
        gravity (0, -g);
    }
}

/// The period of a swing to `amplitude`, in s: simulated, and exact.
pub fn period(amplitude: f64) -> Result<[f64; 2], Error> {
    let pendulum = Pendulum::default();
    let mut start = pendulum.start();
    start.q.theta = amplitude;
    let run = Simulation::new(&pendulum)
        .tolerance(1e-12)
        .until(10.0)
        .event("at the bottom", Crossing::Falling, |state| state.q.theta)
        .run(start)?;
    let [first, second, ..] = run.events() else {
        return Ok([f64::NAN; 2]); // the period is longer than ten seconds
    };

    // T = 2π √(l/g) / agm(1, cos(θ₀/2)) (C. F. Gauss, 1799).
    let (mut a, mut b) = (1.0, (amplitude / 2.0).cos());
    for _ in 0..6 {
        (a, b) = ((a + b) / 2.0, f64::sqrt(a * b));
    }
    let exact = std::f64::consts::TAU * (pendulum.l / pendulum.g).sqrt() / a;
    Ok([second.state.t - first.state.t, exact])
}

/// Prints the periods of four swings.
pub fn main() -> Result<(), Error> {
    for degrees in [1.0, 30.0, 90.0, 150.0] {
        let [simulated, exact] = period(f64::to_radians(degrees))?;
        println!("{degrees:4}°: {simulated:.12} s, exactly {exact:.12} s");
    }
    Ok(())
}
