//! How do I design a controller and run it as a computer does? A pole on a cart, held by a linear-quadratic regulator at 50 Hz.
use lagrangian::{Error, Sensitive, Simulation};
use std::array::from_fn;
lagrangian::machine! {
    /// A pole, hinged to a cart that a motor pushes; the angle is measured from the upward vertical.
    machine Balancer in plane {
        parameters { M: kg = 1, m: kg = 0.1, l: m = 0.5, g: m/s^2 = 9.81 }
        coordinates { x: m, theta: rad = 0.2 }
        inputs { push: N }
        bodies { cart { mass: M, at: (x, 0) }, bob { mass: m, at: cart.at + l*(sin(theta), cos(theta)) } }
        gravity (0, -g);
        forces { motor { on: x, value: push } }
        derivatives { coordinates, rates, inputs }
    }
}

const PERIOD: f64 = 0.02;
const COSTS: [f64; 4] = [10.0, 10.0, 1.0, 1.0];

/// The gain `k` of `u = −k x` that minimizes `Σ x Q x + u²` over all samples, with [`COSTS`] on the diagonal of Q.
pub fn gain() -> Result<[f64; 4], Error> {
    // From one sample to the next x becomes A x + b u: the derivatives of the motion at rest upright, column by column.
    let machine = Balancer::default();
    let linear = Sensitive::new(&machine).by_state()?.by("push")?;
    let mut start = linear.start_from(machine.start());
    start.q.value.theta = 0.0;
    let run = Simulation::new(&linear).until(PERIOD).run(start)?;
    let (q, v) = (&run.end().q.by, &run.end().v.by);
    let column = |i: usize| [q[i].x, q[i].theta, v[i].x, v[i].theta];
    let (a, b): ([[f64; 4]; 4], _) = (from_fn(column), column(4));
    let dot = |x: [f64; 4], y: [f64; 4]| (0..4).map(|i| x[i] * y[i]).sum::<f64>();
    // Riccati's equation, P = Q + Aᵀ P (A − b k) with k = bᵀ P A / (1 + bᵀ P b), iterated to its fixed point.
    let (mut p, mut k) = ([[0.0; 4]; 4], [0.0; 4]);
    for _ in 0..2000 {
        let times = |x: [f64; 4]| p.map(|row| dot(row, x));
        k = a.map(|column| dot(times(b), column) / (1.0 + dot(b, times(b))));
        let left: [[f64; 4]; 4] = from_fn(|j| from_fn(|i| a[j][i] - b[i] * k[j]));
        let cost = |i, j| if i == j { COSTS[i] } else { 0.0 };
        p = from_fn(|i| from_fn(|j| cost(i, j) + dot(times(a[i]), left[j])));
    }
    Ok(k)
}

/// Position and angle after `t` seconds.
pub fn balanced(t: f64) -> Result<[f64; 2], Error> {
    let (k, machine) = (gain()?, Balancer::default());
    let run = Simulation::new(&machine)
        .until(t)
        .sampled(PERIOD, |now, u| {
            u.push = -k[0] * now.q.x - k[1] * now.q.theta - k[2] * now.v.x - k[3] * now.v.theta;
        });
    Ok(run.run(machine.start())?.end().q.to_array())
}

/// Prints the gain, and the state that it leads to.
pub fn main() -> Result<(), Error> {
    println!("k = {:.4?}, after 10 s {:.6?}", gain()?, balanced(10.0)?);
    Ok(())
}
