//! How do I integrate by a method of my own? The 3/8 rule of Kutta, given as its tableau.
use lagrangian::methods::{MethodError, Tableau};
use lagrangian::{Error, Method, Simulation};
use lagrangian_machines::SimplePendulum;

/// Kutta's 3/8 rule of order 4, with weights of order 3 for the error, `(1/12, 1/2, 1/4, 0, 1/6)`; leaked because a simulation borrows its method for good.
pub fn three_eighths() -> Result<&'static Method, MethodError> {
    let method = Method::try_new(Tableau {
        name: "kutta38",
        title: "Kutta's 3/8 rule",
        order: 4,
        error_power: 4,
        dense_order: 3,
        stages: 4,
        c: &[0.0, 1.0 / 3.0, 2.0 / 3.0, 1.0, 1.0],
        a: &[
            &[],
            &[1.0 / 3.0],
            &[-1.0 / 3.0, 1.0],
            &[1.0, -1.0, 1.0],
            &[1.0 / 8.0, 3.0 / 8.0, 3.0 / 8.0, 1.0 / 8.0],
        ],
        error: &[1.0 / 24.0, -1.0 / 8.0, 1.0 / 8.0, 1.0 / 8.0, -1.0 / 6.0],
        coarse_error: None,
        dense: &[],
        step_change: (0.2, 5.0),
        smoothing: 0.0,
        stability: None,
        spectrum: None,
    })?;
    Ok(Box::leak(Box::new(method)))
}

/// The angle of a pendulum after two seconds, and the number of evaluations.
pub fn swing(method: &'static Method, tolerance: f64) -> Result<(f64, usize), Error> {
    let machine = SimplePendulum::default();
    let run = Simulation::new(&machine)
        .method(method)
        .tolerance(tolerance);
    let run = run.until(2.0).run(machine.start())?;
    Ok((run.end().q.to_array()[0], run.statistics().evaluations))
}

/// Prints its cost and that of the built-in methods.
pub fn main() -> Result<(), Box<dyn std::error::Error>> {
    for method in [
        three_eighths()?,
        Method::BS32,
        Method::DOPRI5,
        Method::DOP853,
    ] {
        let (angle, evaluations) = swing(method, 1e-8)?;
        println!(
            "{:24} {angle:.9} rad, {evaluations:6} evaluations",
            method.tableau.title
        );
    }
    Ok(())
}
