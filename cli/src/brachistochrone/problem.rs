//! From a compiled machine and its parameters to numbers.

use lagrangian::interpreted::InterpretedMachine;
use lagrangian_brachistochrone::direct::landscape::{Coefficients, GuideCoefficients, Landscape};
use lagrangian_brachistochrone::{Guide, Problem, Unsolved};
use lagrangian_mechanics::Compiled;
use lagrangian_mechanics::{Brachistochronic, SlidingGuide};
use lagrangian_spec::model::Model;
use lagrangian_symbolic::{Expr, evaluate};
use nalgebra::DMatrix;

use crate::failure::Failure;

/// Whether the coefficients are constant.
pub enum Form<'d> {
    /// The conditions (17) are met.
    Constant(Problem),
    /// They are not met, for these reasons.
    Varying(Box<Landscape<'d>>, Vec<String>),
}

/// The problem of the machine's fastest motion, with the parameters of the call.
///
/// # Errors
/// If the machine has constraints or depends on time, or its mass matrix is invalid.
pub fn form<'d>(
    compiled: &Compiled<'d>,
    machine: &InterpretedMachine,
) -> Result<Form<'d>, Failure> {
    let Compiled {
        model, equations, ..
    } = compiled;
    let varies = match Brachistochronic::of(model, equations) {
        Ok(form) => return problem(compiled, machine, &form).map(Form::Constant),
        Err(unmet) => unmet,
    };
    let form = Brachistochronic::position_dependent(model, equations).map_err(|unmet| {
        let list: Vec<String> = unmet.iter().map(|unmet| format!("\n  {unmet}")).collect();
        Failure::Run(format!(
            "the fastest motion can be found only for machines that change by their motion alone:{}",
            list.concat()
        ))
    })?;
    let landscape = landscape(model, form, machine.parameter_values());
    let because = varies.iter().map(ToString::to_string).collect();
    Ok(Form::Varying(Box::new(landscape), because))
}

fn landscape<'d>(
    model: &Model<'d>,
    form: Brachistochronic<'d>,
    parameters: &[f64],
) -> Landscape<'d> {
    let symbols = model.parameters.iter().map(|parameter| parameter.symbol);
    let guide = |guide: SlidingGuide<'d>| GuideCoefficients {
        name: guide.name,
        along: guide.along,
        load: guide.load,
        weights: guide.weights,
        by_friction_forces: guide.by_friction_forces,
        friction: guide.friction,
    };
    let coefficients = Coefficients {
        q: model.coordinates.iter().map(|q| q.q).collect(),
        v: model.coordinates.iter().map(|q| q.v).collect(),
        parameters: symbols.zip(parameters.iter().copied()).collect(),
        mass: form.mass.concat(),
        slope: form.slope,
        guides: form.guides.into_iter().map(guide).collect(),
    };
    Landscape::new(model.dag, &coefficients)
}

fn problem<'d>(
    compiled: &Compiled<'d>,
    machine: &InterpretedMachine,
    form: &Brachistochronic<'d>,
) -> Result<Problem, Failure> {
    let model = &compiled.model;
    let names: Vec<String> = model
        .coordinates
        .iter()
        .map(|q| q.name.to_string())
        .collect();
    let values = |expressions: &[Expr]| at_parameters(compiled, machine, expressions);
    let mass: Vec<Vec<f64>> = form.mass.iter().map(|row| values(row)).collect();
    let refused = |unsolved: Unsolved| Failure::Run(reason(&unsolved, &names));
    let problem = Problem::new(&mass, &values(&form.slope)).map_err(refused)?;
    let guides = guides(form, values)?;
    let add = |problem: Problem, guide| problem.with_guide(guide);
    guides.into_iter().try_fold(problem, add).map_err(refused)
}

/// Values of expressions that depend on parameters alone.
pub fn at_parameters(
    compiled: &Compiled,
    machine: &InterpretedMachine,
    expressions: &[Expr],
) -> Vec<f64> {
    let parameters = || compiled.model.parameters.iter();
    let places = parameters().map(|parameter| parameter.symbol.as_symbol());
    let values = machine.parameter_values();
    let known: Vec<_> = places.zip(values).collect();
    evaluate(compiled.model.dag, expressions, |symbol| {
        let value = known.iter().find(|(known, _)| *known == Some(symbol));
        value.map_or(f64::NAN, |(_, value)| **value)
    })
}

/// The guides, with reactions that depend on accelerations alone: solves `(1 + κ μ) N = ν + ρ·a` for all of them.
fn guides<'d>(
    form: &Brachistochronic<'d>,
    values: impl Fn(&[Expr<'d>]) -> Vec<f64>,
) -> Result<Vec<Guide>, Failure> {
    let (count, n) = (form.guides.len(), form.slope.len());
    if count == 0 {
        return Ok(Vec::new()); // An empty matrix cannot be factored.
    }
    let list = |of: &dyn Fn(&SlidingGuide<'d>) -> Vec<Expr<'d>>| -> Vec<Vec<f64>> {
        form.guides.iter().map(|guide| values(&of(guide))).collect()
    };
    let scalars = list(&|guide| vec![guide.load, guide.friction]);
    let weights = list(&|guide| guide.weights.clone());
    let by_friction_forces = list(&|guide| guide.by_friction_forces.clone());
    let along = list(&|guide| guide.along.clone());
    let coupling = DMatrix::from_fn(count, count, |i, j| {
        f64::from(u8::from(i == j)) + by_friction_forces[i][j] * scalars[j][1]
    });
    let loads = DMatrix::from_fn(count, n + 1, |i, j| match j {
        0 => scalars[i][0],
        _ => weights[i][j - 1],
    });
    let reactions = coupling.lu().solve(&loads).ok_or_else(|| {
        Failure::run(
            "the normal reactions of the guides are not determined: the guides jam by friction",
        )
    })?;
    let guide = |(i, guide): (usize, &SlidingGuide<'d>)| Guide {
        name: guide.name.clone(),
        along: along[i].clone(),
        load: reactions[(i, 0)],
        weights: (1..=n).map(|j| reactions[(i, j)]).collect(),
        friction: scalars[i][1],
    };
    Ok(form.guides.iter().enumerate().map(guide).collect())
}

/// Why there is no fastest motion, with the names of coordinates instead of indices.
pub fn reason(unsolved: &Unsolved, names: &[String]) -> String {
    let name = |index: usize| names.get(index).map_or("?", String::as_str);
    match unsolved {
        Unsolved::NoInertia { coordinate, .. } => {
            format!(
                "the mass matrix is not positive definite: `{}` has no inertia",
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
            "there is no fastest motion: a small loop of directions in `{}` and `{}` multiplies the speed in no time (the friction \
             matrix is not symmetric, by {skew:.3e} of the inertia); with constraints that leave two coordinates there may be one",
            name(*one),
            name(*other)
        ),
        other => other.to_string(),
    }
}
