//! How do I run a whole motion in other numbers? In `f32`, in 32 digits, and with its derivative by a parameter.
//!
//! ```sh
//! cargo run --release --example digits
//! ```

use lagrangian::scalar::{DoubleDouble, Dual, Scalar};
use lagrangian::{ExplicitStepper, MachineIn, Real, StepError, Vector};

lagrangian::machine! {
    /// A block on a spring: x = cos ωt, ω² = k/m.
    machine Oscillator in plane {
        parameters { m: kg = 2, k: N/m = 8 }
        coordinates { x: m = 1 }
        bodies { block { mass: m, at: (x, 0) } }
        springs { spring { stiffness: k, stretch: x } }
    }
}

/// The first coordinate of any machine at a time, in any numbers, and the number of steps taken.
pub fn at<N: Real, M: MachineIn<N>>(machine: &M, t: N) -> Result<(N, usize), StepError> {
    let mut stepper = ExplicitStepper::builder(machine.prepare()).start(machine.start())?;
    stepper.advance_to(t)?;
    Ok((stepper.q().as_slice()[0], stepper.work().steps))
}

/// Prints the position after ten seconds in several kinds of numbers.
pub fn main() -> Result<(), StepError> {
    let machine = Oscillator::default();
    let (x, steps) = at(&machine.map(|x| x as f32), 10.0)?;
    println!("f32:            {x:.9} in {steps} steps");
    let (x, steps) = at(&machine, 10.0)?;
    println!("f64:            {x:.15} in {steps} steps");
    let ten = DoubleDouble::from_f64(10.0);
    let (x, steps) = at(&machine.map(DoubleDouble::from_f64), ten)?;
    println!(
        "double-double:  {:.15} {:+e} in {steps} steps",
        x.hi(),
        x.lo()
    );
    let mut varied = machine.map(Dual::constant);
    varied.k = Dual::variable(machine.k);
    let (x, steps) = at(&varied, Dual::constant(10.0))?;
    println!(
        "by the spring:  {:.12} m/(N/m) in {steps} steps",
        x.derivative
    );
    Ok(())
}
