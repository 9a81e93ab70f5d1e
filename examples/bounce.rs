//! How do I stop at an event, and continue after it? A ball that bounces until it has come to rest, nearly.
//!
//! ```sh
//! cargo run --release --example bounce
//! ```

use lagrangian::{Coordinates, Crossing, Ending, Error, Simulation, State};

lagrangian::machine! {
    /// A ball above a floor at y = 0.
    machine Ball in plane {
        parameters { m: kg = 1, g: m/s^2 = 9.81 }
        coordinates { y: m = 1 }
        bodies { ball { mass: m, at: (0, y) } }
        gravity (0, -g);
    }
}

/// The first `count` times, in s, at which the ball meets the floor.
pub fn bounces(restitution: f64, count: usize) -> Result<Vec<f64>, Error> {
    let ball = Ball::default();
    let floor = |state: &State<Coordinates<Ball>>| state.q.y;
    let mut run = Simulation::new(&ball)
        .tolerance(1e-12)
        .until(100.0)
        .until_event("the floor", Crossing::Falling, floor)
        .run(ball.start())?;
    let mut times = Vec::new();
    while times.len() < count && *run.ending() != Ending::End {
        // The run ends in the state of the event.
        let mut state = *run.end();
        times.push(state.t);
        // The impact: the next run continues with another velocity. Starting on the floor is no event.
        state.v.y *= -restitution;
        let next = run.resume();
        run = next
            .until_event("the floor", Crossing::Falling, floor)
            .run(state)?;
    }
    Ok(times)
}

/// Prints the times on the floor, and their errors.
pub fn main() -> Result<(), Error> {
    let (restitution, count) = (0.8, 20);
    let times = bounces(restitution, count)?;
    // It falls for √(2h/g), and each flight is shorter than the one before by the factor `restitution`.
    let ball = Ball::default();
    let fall = (2.0 * ball.start().q.y / ball.g).sqrt();
    let mut exact = fall;
    for (number, time) in (1..).zip(times) {
        println!("{number:2}: {time:.12} s, off by {:8.1e} s", time - exact);
        exact += 2.0 * restitution.powi(number) * fall;
    }
    Ok(())
}
