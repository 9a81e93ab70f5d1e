//! How do I run a machine a thousand times, on all processors? How far a ball flies, thrown at many angles.
use lagrangian::{Crossing, Error, Machine, Simulation};
use std::thread;

lagrangian::machine! {
    /// A ball in still air with linear drag.
    machine Ball in plane {
        parameters { m: kg = 0.15, drag: N*s/m = 0.02, g: m/s^2 = 9.81 }
        coordinates { x: m, y: m }
        bodies { ball { mass: m, at: (x, y) } }
        gravity (0, -g);
        dissipations { air: 1/2*drag*(der(x)^2 + der(y)^2) }
    }
}

/// How far it flies, thrown at 30 m/s at an angle in rad.
pub fn range(ball: &Ball, angle: f64) -> Result<f64, Error> {
    let mut start = ball.start();
    (start.v.y, start.v.x) = (30.0 * angle.sin(), 30.0 * angle.cos());
    let run = Simulation::new(ball).until(20.0).forget_steps();
    let run = run.until_event("ground", Crossing::Falling, |state| state.q.y);
    Ok(run.run(start)?.end().q.x)
}

/// The angle and the range of the farthest of `count` throws, which the processors share.
pub fn best(ball: &Ball, count: usize) -> Result<(f64, f64), Error> {
    let processors = thread::available_parallelism().map_or(1, usize::from);
    let throws = |first: usize| -> Result<Vec<(f64, f64)>, Error> {
        let angle = |i| std::f64::consts::FRAC_PI_2 * (i + 1) as f64 / (count + 1) as f64;
        let own = (first..count).step_by(processors).map(angle);
        own.map(|angle| Ok((angle, range(ball, angle)?))).collect()
    };
    let parts: Result<Vec<Vec<(f64, f64)>>, Error> = thread::scope(|scope| {
        let spawned = (0..processors).map(|first| scope.spawn(move || throws(first)));
        let threads: Vec<_> = spawned.collect();
        let mut threads = threads.into_iter();
        threads.try_fold(Vec::new(), |mut all, thread| {
            all.push(thread.join().expect("no run panics")?);
            Ok(all)
        })
    });
    let throws = parts?.into_iter().flatten();
    Ok(throws.fold((0.0, 0.0), |best, of| if of.1 > best.1 { of } else { best }))
}

/// Prints the best throw with and without drag.
pub fn main() -> Result<(), Error> {
    let mut ball = Ball::default();
    for drag in [0.0, 0.02] {
        ball.set("drag", drag)?;
        let (angle, range) = best(&ball, 899)?;
        println!(
            "drag {drag:4} N s/m: {range:.1} m at {:.1}°",
            angle.to_degrees()
        );
    }
    Ok(())
}
