//! How do I change one force of a machine? A pendulum in air whose drag was measured, and stands in a table.
use lagrangian::{Adapted, EnergyBalance, Error, Machine, Simulation};

lagrangian::machine! {
    /// A ball on a thin rod.
    machine Pendulum in plane {
        parameters { m: kg = 0.5, l: m = 1, g: m/s^2 = 9.81 }
        coordinates { theta: rad = 1.5 }
        bodies { ball { mass: m, at: l*(sin(theta), -cos(theta)) } }
        gravity (0, -g);
    }
}

/// Measured drag in N at 0, 1, 2, … m/s.
pub const MEASURED: [f64; 6] = [0.0, 0.004, 0.016, 0.036, 0.064, 0.1];

/// The drag at a speed, interpolated linearly between the measured values.
pub fn drag(speed: f64) -> f64 {
    let below = (speed as usize).min(MEASURED.len() - 2);
    let [from, to] = [MEASURED[below], MEASURED[below + 1]];
    from + (speed - below as f64) * (to - from)
}

/// The amplitude after `t` seconds, and the energy balance.
pub fn swing(t: f64) -> Result<(f64, EnergyBalance), Error> {
    let pendulum = Pendulum::default();
    let l = pendulum.l;
    let in_air = Adapted::new(pendulum, move |_t, _q, v, _u, force| {
        force.theta -= l * drag((l * v.theta).abs()).copysign(v.theta);
    })?;
    let run = Simulation::new(&in_air)
        .until(t)
        .energy_balance(true)
        .run(in_air.start())?;
    let energy = run
        .energies()
        .last()
        .map_or(0.0, |last| last.kinetic + last.potential);
    let Pendulum { m, g, .. } = pendulum;
    Ok((
        (-energy / (m * g * l)).acos(),
        run.energy_balance().unwrap_or_default(),
    ))
}

/// Prints how the motion decays.
pub fn main() -> Result<(), Error> {
    println!("  t  amplitude  work of the drag  residual of the energies");
    for t in [10.0, 20.0, 40.0] {
        let (amplitude, balance) = swing(t)?;
        println!(
            "{t:3} {amplitude:8.4} rad {:12.6} J {:15.1e} J",
            balance.work,
            balance.residual()
        );
    }
    Ok(())
}
