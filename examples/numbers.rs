//! How do I run the equations in other numbers? In `f32`, in 32 digits, and with a derivative by a parameter.
//!
//! ```sh
//! cargo run --release --example numbers
//! ```

use lagrangian::scalar::{DoubleDouble, Dual, Scalar};
use lagrangian::{Number, Singular};

lagrangian::machine! {
    /// A point mass on a massless rod; its acceleration is −g/l sin θ.
    machine Pendulum in plane {
        parameters { m: kg = 1, l: m = 0.5, g: m/s^2 = 9.75 }
        coordinates { theta: rad = 1 }
        bodies { bob { mass: m, at: l*(sin(theta), -cos(theta)) } }
        gravity (0, -g);
    }
}

/// The angular acceleration at the start, in any numbers.
pub fn acceleration<S: Number + Scalar>(machine: Pendulum<S>) -> Result<S, Singular> {
    let q = machine.start().q.to_array();
    let [a] = pendulum::accelerations(&machine.prepare(), &q)?;
    Ok(a)
}

/// The acceleration and its derivative by the length of the rod.
pub fn by_length() -> Result<Dual<f64>, Singular> {
    let mut machine = Pendulum::default().map(Dual::constant);
    machine.l = Dual::variable(0.5);
    acceleration(machine)
}

/// Prints one acceleration in several kinds of numbers.
pub fn main() -> Result<(), Singular> {
    let machine = Pendulum::default();
    println!(
        "f32:           {}",
        acceleration(machine.map(|x| x as f32))?
    );
    println!("f64:           {}", acceleration(machine)?);
    let wide = acceleration(machine.map(DoubleDouble::from_f64))?;
    println!("double-double: {} and {:e} more", wide.hi(), wide.lo());
    println!("by the length: {} 1/(m s²)", by_length()?.derivative);
    Ok(())
}
