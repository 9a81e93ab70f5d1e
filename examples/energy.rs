//! How do I know that the energy is right? A driven vibration takes in what its damper takes out.
//!
//! ```sh
//! cargo run --release --example energy
//! ```

use lagrangian::{EnergyBalance, Error, Simulation};

lagrangian::machine! {
    /// A mass on a spring and a damper, pushed by an oscillating force.
    machine Shaker in plane {
        parameters { m: kg = 2, k: N/m = 50, b: N*s/m = 3, force: N = 10, omega: rad/s = 6 }
        coordinates { x: m }
        bodies { block { mass: m, at: (x, 0) } }
        springs { spring { stiffness: k, stretch: x } }
        dampers { damper { damping: b, stretch: x } }
        forces { push { on: x, value: force*sin(omega*t) } }
    }
}

const PERIODS: f64 = 10.0;

/// The energy balance of a steady vibration, and the exact work of the force, in J.
pub fn balance(tolerance: f64) -> Result<(EnergyBalance, f64), Error> {
    let shaker = Shaker::default();
    let Shaker {
        m,
        k,
        b,
        force,
        omega,
    } = shaker;
    // The steady vibration is x = X sin(ωt − φ): the force is ahead by φ.
    let (stiff, drag) = (k - m * omega * omega, b * omega);
    let (amplitude, phase) = (force / stiff.hypot(drag), drag.atan2(stiff));
    let mut start = shaker.start();
    start.q.x = -amplitude * phase.sin();
    start.v.x = amplitude * omega * phase.cos();
    let run = Simulation::new(&shaker)
        .tolerance(tolerance)
        .until(PERIODS * std::f64::consts::TAU / omega)
        .energy_balance(true)
        .run(start)?;
    let work = PERIODS * std::f64::consts::PI * force * amplitude * phase.sin();
    Ok((run.energy_balance().unwrap_or_default(), work))
}

/// Prints the balance for three tolerances.
pub fn main() -> Result<(), Error> {
    println!("tolerance  work [J]        exactly         dissipated      left over");
    for tolerance in [1e-4, 1e-7, 1e-10] {
        let (balance, exact) = balance(tolerance)?;
        let (work, dissipated) = (balance.work, balance.dissipated);
        let left = balance.residual();
        println!("{tolerance:9.0e}  {work:.11}  {exact:.11}  {dissipated:.11}  {left:9.1e}");
    }
    Ok(())
}
