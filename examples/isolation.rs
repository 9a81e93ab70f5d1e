//! How do I change a parameter and compare? What a machine on a shaking floor feels, for several dampers.
//!
//! ```sh
//! cargo run --release --example isolation
//! ```

use lagrangian::{Error, Simulation};

lagrangian::machine! {
    /// A machine on a spring and a damper, on a floor that shakes; its height is
    /// measured from its rest position.
    machine OnFloor in plane {
        parameters {
            m: kg = 100, k: N/m = 1e4, b: N*s/m,
            /// Amplitude and angular frequency of the floor.
            a: m = 0.001, omega: rad/s = 20,
        }
        coordinates { y: m }
        define { stretch = y - a*sin(omega*t) }
        bodies { machine { mass: m, at: (0, y) } }
        springs { feet { stiffness: k, stretch: stretch } }
        dampers { feet { damping: b, stretch: stretch } }
    }
}

/// Amplitude of the machine divided by that of the floor: simulated, and exact.
pub fn transmitted(damping: f64) -> Result<[f64; 2], Error> {
    let on_floor = OnFloor::new(damping);
    let OnFloor { m, k, b, a, omega } = on_floor;
    // The free vibration decays as e^(−b t/2m), to below 10⁻⁹ at the end.
    let settled = 2.0 * m / b * 1e9_f64.ln();
    let period = std::f64::consts::TAU / omega;
    let run = Simulation::new(&on_floor)
        .tolerance(1e-12)
        .until(settled + period)
        .run(on_floor.start())?;
    // A quarter of a period apart, the displacements are the sine and the cosine component.
    let [sine, cosine] =
        [settled, settled + period / 4.0].map(|t| run.at(t).map(|state| state.q.y));
    let simulated = sine?.hypot(cosine?) / a;
    let exact = k.hypot(b * omega) / (k - m * omega * omega).hypot(b * omega);
    Ok([simulated, exact])
}

/// Prints the transmitted amplitude for four dampers.
pub fn main() -> Result<(), Error> {
    println!("damping [N s/m]  transmitted  exactly");
    for damping in [200.0, 400.0, 800.0, 1600.0] {
        let [simulated, exact] = transmitted(damping)?;
        println!("{damping:15} {simulated:12.9} {exact:12.9}");
    }
    println!("above the resonance the softest damper isolates best");
    Ok(())
}
