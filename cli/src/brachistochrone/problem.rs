//! From a compiled machine and its parameters to numbers.

use lagrangian::Machine;
use lagrangian::brachistochrone::{Problem, Unsolved};
use lagrangian::interpreted::InterpretedMachine;
use lagrangian_spec::compile::Compiled;
use lagrangian_spec::mechanics::Brachistochronic;
use lagrangian_symbolic::{Expr, evaluate};

use crate::failure::Failure;

/// The problem of the machine's fastest motion, at the parameters of the call.
///
/// # Errors
/// If the machine does not meet the conditions, or its masses are no masses.
pub fn problem(compiled: &Compiled, machine: &InterpretedMachine) -> Result<Problem, Failure> {
    let Compiled {
        model, equations, ..
    } = compiled;
    let form = Brachistochronic::of(model, equations).map_err(|unmet| {
        let list: Vec<String> = unmet.iter().map(|unmet| format!("\n  {unmet}")).collect();
        Failure::Run(format!(
            "the fastest motion is known for constant masses, constant forces and constant friction only:{}",
            list.concat()
        ))
    })?;
    let names: Vec<String> = model
        .coordinates
        .iter()
        .map(|q| q.name.to_string())
        .collect();
    let values = |expressions: &[Expr]| -> Vec<f64> {
        evaluate(model.dag, expressions, |symbol| {
            let parameter = model
                .parameters
                .iter()
                .find(|parameter| parameter.symbol.as_symbol() == Some(symbol));
            let value = parameter.and_then(|parameter| {
                let name = parameter.name.to_string();
                machine
                    .parameters()
                    .find(|(quantity, _)| quantity.name == name)
            });
            value.map_or(f64::NAN, |(_, value)| value)
        })
    };
    let mass: Vec<Vec<f64>> = form.mass.iter().map(|row| values(row)).collect();
    let problem = Problem::new(&mass, &values(&form.slope));
    problem.map_err(|unsolved| Failure::Run(explained(&unsolved, &names)))
}

/// Why there is no fastest motion, with the names of coordinates where there are numbers.
pub fn explained(unsolved: &Unsolved, names: &[String]) -> String {
    let name = |index: usize| names.get(index).map_or("?", String::as_str);
    match unsolved {
        Unsolved::NoInertia { coordinate, .. } => {
            format!(
                "the mass matrix is not positive definite: `{}` meets no inertia",
                name(*coordinate)
            )
        }
        Unsolved::FrictionOutweighsInertia { coordinate, .. } => format!(
            "friction that grows with the acceleration of `{}` outweighs its inertia: the machine jams",
            name(*coordinate)
        ),
        Unsolved::LoopsFeed {
            coordinates: [one, other],
            skew,
        } => format!(
            "no motion is the fastest: a small loop of directions in `{}` and `{}` multiplies the speed in no time (the friction \
             matrix is not symmetric, by {skew:.3e} of the inertia); with constraints that leave two coordinates there may be one",
            name(*one),
            name(*other)
        ),
        other => other.to_string(),
    }
}
