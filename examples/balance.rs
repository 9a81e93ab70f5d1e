//! How does a controller drive a machine? The cart and pole of the library, balanced by a force that depends on its state.
//!
//! ```sh
//! cargo run --release --example balance
//! ```

use lagrangian::{Error, Simulation};

lagrangian::machine!(file = "../machines/cart_pole.machine");

/// Position of the cart, in m, and angle of the pole, in rad, second by second.
pub fn balance(angle: f64) -> Result<Vec<[f64; 2]>, Error> {
    let cart_pole = CartPole::default();
    let mut start = cart_pole.start();
    start.q.theta = angle;
    let run = Simulation::new(&cart_pole)
        .until(10.0)
        .inputs(|_t, q, v, u| u.push = 40.0 * q.theta + 8.0 * v.theta + 1.5 * q.x + 3.0 * v.x)
        .run(start)?;
    let states = run.every(1.0)?;
    Ok(states
        .iter()
        .map(|state| [state.q.x, state.q.theta])
        .collect())
}

/// Prints ten seconds of the motion.
pub fn main() -> Result<(), Error> {
    println!("  t       x   theta");
    for (t, [x, theta]) in balance(0.2)?.into_iter().enumerate() {
        println!("{t:3} {x:7.4} {theta:7.4}");
    }
    Ok(())
}
