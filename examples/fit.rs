//! How do I find parameters from a measurement? Length and damping of a pendulum, from the angles of ten seconds.
use lagrangian::{Error, Machine, Sensitive, Simulation};

lagrangian::machine! {
    /// A ball on a rod, damped in its hinge.
    machine Pendulum in plane {
        parameters { m: kg = 1, l: m = 1, b: N*m*s = 0.1, g: m/s^2 = 9.81 }
        coordinates { theta: rad = 1 }
        bodies { ball { mass: m, at: l*(sin(theta), -cos(theta)) } }
        gravity (0, -g);
        dissipations { hinge: 1/2*b*der(theta)^2 }
        derivatives { coordinates, rates, l, b }
    }
}

/// The times of the measurements, in s.
fn times() -> impl Iterator<Item = f64> {
    (1..=100).map(|i| f64::from(i) / 10.0)
}

/// The angles of a pendulum at these times.
pub fn angles(pendulum: &Pendulum) -> Result<Vec<f64>, Error> {
    let run = Simulation::new(pendulum).tolerance(1e-11).until(10.0);
    let run = run.run(pendulum.start())?;
    times().map(|t| Ok(run.at(t)?.q.theta)).collect()
}

/// The pendulum whose angles fit the measured ones best, by the Gauss–Newton method from a guess.
pub fn fit(mut guess: Pendulum, measured: &[f64]) -> Result<Pendulum, Error> {
    for _ in 0..20 {
        let varied = Sensitive::new(&guess).by("l")?.by("b")?;
        let run = Simulation::new(&varied).tolerance(1e-11).until(10.0);
        let run = run.run(varied.start())?;
        // The normal equations of two unknowns, JᵀJ δ = Jᵀ r.
        let ([mut a, mut b, mut c], [mut d, mut e]) = ([0.0; 3], [0.0; 2]);
        for (t, measured) in times().zip(measured) {
            let q = run.at(t)?.q;
            let ([x, y], off) = ([q.by[0].theta, q.by[1].theta], measured - q.value.theta);
            (a, b, c) = (a + x * x, b + x * y, c + y * y);
            (d, e) = (d + x * off, e + y * off);
        }
        let determinant = a * c - b * b;
        guess.set("l", guess.l + (c * d - b * e) / determinant)?;
        guess.set("b", guess.b + (a * e - b * d) / determinant)?;
    }
    Ok(guess)
}

/// Recovers the parameters of a pendulum from its motion.
pub fn main() -> Result<(), Error> {
    let mut other = Pendulum::default();
    (other.l, other.b) = (1.1, 0.15);
    let found = fit(Pendulum::default(), &angles(&other)?)?;
    println!("l = {:.9} m, b = {:.9} N m s", found.l, found.b);
    Ok(())
}
