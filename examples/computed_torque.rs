//! How do I get M, h and Q for a controller of my own? A robot's arm that follows a linear law, whatever its dynamics.
//!
//! ```sh
//! cargo run --release --example computed_torque
//! ```

use lagrangian::{Error, Simulation, System};

lagrangian::machine! {
    /// An arm of two joints in a vertical plane, with friction in them.
    machine Arm in plane {
        parameters { a: m = 0.4, b: m = 0.3, m: kg = 2, J: kg*m^2 = 0.02, c: N*m*s = 0.5, g: m/s^2 = 9.81 }
        coordinates { shoulder: rad = -pi/2, elbow: rad }
        inputs { tau1: N*m, tau2: N*m }
        frames { upper = ground.turn(shoulder), lower = upper.shift(a, 0).turn(elbow) }
        bodies {
            upper { mass: m, inertia: J, frame: upper, at: upper.point(a/2, 0) },
            lower { mass: m, inertia: J, frame: lower, at: lower.point(b/2, 0) },
        }
        gravity (0, -g);
        dissipations { joints: 1/2*c*(der(shoulder)^2 + der(elbow)^2) }
        forces { motor1 { on: shoulder, value: tau1 }, motor2 { on: elbow, value: tau2 } }
    }
}

const GOAL: [f64; 2] = [0.5, 1.0];
/// How fast the arm approaches its goal, in 1/s.
const RATE: f64 = 4.0;

/// The distance of each joint from the goal after `t` seconds, relative to the initial distance.
pub fn left(t: f64) -> Result<[f64; 2], Error> {
    let arm = Arm::default();
    let system = arm.prepare();
    let run = Simulation::new(&arm)
        .tolerance(1e-11)
        .until(t)
        .inputs(|t, q, v, u| {
            let (q, v) = (q.to_array(), v.to_array());
            // M a + h = Q: the motors must add to Q what gives the acceleration a of the law.
            let (mut m, mut h, mut rest) = ([0.0; 4], [0.0; 2], [0.0; 2]);
            system.mass_matrix(t, &q, &mut m);
            system.bias(t, &q, &v, &mut h);
            system.applied(t, &q, &v, &system.default_inputs(), &mut rest);
            let a = [0, 1].map(|i| -2.0 * RATE * v[i] - RATE * RATE * (q[i] - GOAL[i]));
            [u.tau1, u.tau2] =
                [0, 1].map(|i| m[2 * i] * a[0] + m[2 * i + 1] * a[1] + h[i] - rest[i]);
        })
        .run(arm.start())?;
    let [start, end] = [run.start(), run.end()].map(|state| state.q.to_array());
    Ok([0, 1].map(|i| (end[i] - GOAL[i]) / (start[i] - GOAL[i])))
}

/// Prints the distance of the joints from their goal, and that of the linear law.
pub fn main() -> Result<(), Error> {
    println!("  t  shoulder     elbow        (1 + kt) exp(-kt)");
    for t in [0.5, 1.0, 2.0] {
        let ([shoulder, elbow], exact) = (left(t)?, (1.0 + RATE * t) * (-RATE * t).exp());
        println!("{t:3}  {shoulder:.9}  {elbow:.9}  {exact:.9}");
    }
    Ok(())
}
