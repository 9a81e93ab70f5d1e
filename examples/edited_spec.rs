//! How does a program let its user edit a machine while it runs? A text becomes a machine, or messages with places.
//!
//! ```sh
//! cargo run --release --example edited_spec
//! ```

use lagrangian::interpreted::InterpretedMachine;
use lagrangian::{Error, Machine, Simulation};

const TEXT: &str = "machine Chain in plane {
    constants { N = 2 }
    parameters { m: kg = 1, l: m = 0.5, g: m/s^2 = 9.81 }
    coordinates { theta[1..N]: rad = 0.5 }
    frames { end[0] = ground, end[i in 1..N] = end[i-1].shift(l*sin(theta[i]), -l*cos(theta[i])) }
    bodies { ball[i in 1..N] { mass: m, at: end[i].origin } }
    gravity (0, -g);
}";

/// The angle of the last of `rods` rods after a second, or the errors in the text.
pub fn last_angle(text: &str, rods: u8) -> Result<f64, Error> {
    let mut chain = InterpretedMachine::from_text(text)
        .named("chain")
        .constant("N", rods)
        .build()?;
    chain.set("l", 1.0 / f64::from(rods))?;
    let run = Simulation::new(&chain).until(1.0).run(chain.start())?;
    Ok(run.end().q.values.last().copied().unwrap_or(f64::NAN))
}

/// Line, column and message of each mistake, for an editor to show.
pub fn marks(error: &Error) -> Vec<(usize, usize, String)> {
    let Error::Spec { diagnostics, .. } = error else {
        return Vec::new();
    };
    let mark = |of: &lagrangian::interpreted::Diagnostic| (of.line, of.column, of.message.clone());
    diagnostics.iter().map(mark).collect()
}

/// Prints the messages for a misspelled function, and the result for the corrected text.
pub fn main() -> Result<(), Error> {
    if let Err(error) = last_angle(&TEXT.replace("cos(", "cosine("), 3) {
        println!("{error}\nmarks at {:?}", marks(&error));
    }
    for rods in 1..=4 {
        println!("{rods} rods: {:.6} rad", last_angle(TEXT, rods)?);
    }
    Ok(())
}
