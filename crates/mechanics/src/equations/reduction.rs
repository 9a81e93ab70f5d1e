//! Eliminates coordinates that constraints determine, by substitution into the machine.
//!
//! If one coordinate enters a constraint of positions linearly, with a coefficient that depends on
//! parameters alone, the constraint gives that coordinate as an expression in the others:
//! `s = R − r`, `y = x²/l`, `phi = omega t`. Substituting it everywhere removes both the coordinate
//! and the constraint, and Lagrange's equations are derived in fewer coordinates, by every route. The
//! same holds for a constraint of rates whose coefficients depend on parameters alone, as for rolling
//! wheels: it gives `q_d = Σ cᵢ qᵢ + C`. The constant `C` is determined by the start, and is computed
//! from the state where it matters.
//!
//! The state keeps all coordinates. The dependent ones have accelerations that follow from the
//! others, `a_d = D²(q_d)`, and are kept on the constraints like every state.

use std::collections::BTreeSet;

use lagrangian_symbolic::{Expr, Symbol, evaluate, nearest, substitute};

use super::Equations;
use super::constraints::ConstraintEquation;
use super::kinematics::Variables;
use lagrangian_spec::diagnostic::{Code, Diagnostic, Report};
use lagrangian_spec::identity;
use lagrangian_spec::model::element::{Contribution, Load};
use lagrangian_spec::model::{Inertia, Model, PoseChange, Rotation, stage};

/// A machine without the coordinates that constraints determine.
#[derive(Clone, Debug)]
pub struct Reduction<'d> {
    /// The machine, with the remaining coordinates and constraints.
    pub machine: ReducedModel<'d>,
    /// Its equations.
    pub equations: Equations<'d>,
    /// The indices of the remaining coordinates.
    pub coordinates: Vec<usize>,
    /// The indices of the remaining constraints.
    pub constraints: Vec<usize>,
    /// The eliminated coordinates.
    pub dependents: Vec<Dependent<'d>>,
}

/// A model whose debug output is only its name.
#[derive(Clone)]
pub struct ReducedModel<'d>(pub Model<'d>);

impl std::fmt::Debug for ReducedModel<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.0.name)
    }
}

/// A coordinate that a constraint determines.
#[derive(Clone, Debug)]
pub struct Dependent<'d> {
    /// Its index.
    pub coordinate: usize,
    /// The index of the constraint.
    pub constraint: usize,
    /// Its coefficient in the constraint: ∂g/∂q or ∂φ/∂v with respect to it, of parameters alone.
    pub coefficient: Expr<'d>,
    /// Its position, as a function of the other coordinates and perhaps of the symbol of its `offset`.
    pub position: Expr<'d>,
    /// Its rate, as a function of the others and their rates.
    pub rate: Expr<'d>,
    /// Its acceleration.
    pub acceleration: Expr<'d>,
    /// For a constraint of rates: a symbol for the constant that the start determines, and its meaning.
    pub offset: Option<[Expr<'d>; 2]>,
}

/// The coordinates that constraints determine, each in terms of the remaining ones.
pub fn dependents<'d>(
    model: &Model<'d>,
    constraints: &[ConstraintEquation<'d>],
) -> Vec<Dependent<'d>> {
    let mut dependents: Vec<Dependent<'d>> = Vec::new();
    if constraints.is_empty() || !model.approximations.is_empty() {
        return dependents;
    }
    let x = Variables::of(model);
    let uses = uses(model, &x);
    loop {
        let settled: BTreeSet<usize> = dependents.iter().map(|d| d.constraint).collect();
        let mut open = (0..constraints.len()).filter(|k| !settled.contains(k));
        let next = open.find_map(|k| dependent(model, &x, &uses, &dependents, k, &constraints[k]));
        let Some(next) = next else {
            return dependents;
        };
        let map = replacements(&x, std::slice::from_ref(&next));
        for before in &mut dependents {
            let parts = [before.position, before.rate, before.acceleration];
            let put = substitute(model.dag, &parts, &map);
            [before.position, before.rate, before.acceleration] = [put[0], put[1], put[2]];
        }
        dependents.push(next);
    }
}

/// The error of an assumption that fails in every state, with the default parameters, because constraints determine the coordinates in it:
/// `s > 0` for a circle that rolls inside of a smaller one, whose centres are at the distance `s = R − r`.
///
/// Such a machine has no states, so its program can be compared with nothing.
pub fn violated_assumption<'d>(
    model: &Model<'d>,
    constraints: &[ConstraintEquation<'d>],
) -> Option<Diagnostic> {
    let dependents = dependents(model, constraints);
    let x = Variables::of(model);
    let map = replacements(&x, &dependents);
    let default = |symbol: Symbol| {
        let mut parameters = model.parameters.iter();
        let parameter = parameters.find(|p| p.symbol.as_symbol() == Some(symbol));
        let value = parameter.and_then(|parameter| parameter.default);
        value.map_or(f64::NAN, |value| {
            evaluate(model.dag, &[value], |_| f64::NAN)[0]
        })
    };
    model.assumptions.iter().find_map(|fact| {
        let excess = substitute(model.dag, &[fact.excess], &map)[0];
        let excess = identity::as_function_of_parameters(excess)?;
        let excess = evaluate(model.dag, &[excess], default)[0];
        let fails = excess < 0.0 || fact.strict && excess == 0.0;
        let symbols = fact.excess.symbols();
        let by = dependents.iter().find(|d| symbols.contains(&x.q[d.coordinate]));
        let by = by.filter(|_| fails)?;
        let message = format!(
            "`{}` does not hold in any state, with the default parameters: the constraint `{}` determines `{}`",
            fact.text, constraints[by.constraint].name, model.coordinates[by.coordinate].name
        );
        let diagnostic = Diagnostic::new(Code::FalseAssumption, fact.span, message);
        Some(diagnostic.help("correct the constraint, the assumption, or the default parameters"))
    })
}

/// The replacements of the dependent coordinates, their rates and accelerations.
fn replacements<'d>(x: &Variables<'d>, dependents: &[Dependent<'d>]) -> Vec<(Symbol, Expr<'d>)> {
    let of = |d: &Dependent<'d>| {
        let i = d.coordinate;
        [
            (x.q[i], d.position),
            (x.v[i], d.rate),
            (x.a[i], d.acceleration),
        ]
    };
    dependents.iter().flat_map(of).collect()
}

/// The coordinate that is best eliminated by a constraint, if there is one.
fn dependent<'d>(
    model: &Model<'d>,
    x: &Variables<'d>,
    uses: &[usize],
    found: &[Dependent<'d>],
    index: usize,
    constraint: &ConstraintEquation<'d>,
) -> Option<Dependent<'d>> {
    let dag = model.dag;
    let equation = constraint.position.unwrap_or(constraint.rate);
    let equation = substitute(dag, &[equation], &replacements(x, found))[0];
    let variables = match constraint.position {
        Some(_) => &x.q,
        None => &x.v,
    };
    let is_left = |i: &usize| !found.iter().any(|d| d.coordinate == *i);
    let left: Vec<usize> = (0..variables.len()).filter(is_left).collect();
    let slope = |&i: &usize| {
        let slope = equation.diff(variables[i]);
        identity::as_function_of_parameters(slope).map(|slope| (i, slope))
    };
    let slopes: Vec<(usize, Expr<'d>)> = left.iter().filter_map(slope).collect();
    if constraint.position.is_none() && slopes.len() < left.len() {
        return None;
    }
    let usable = slopes.iter().filter(|(_, slope)| is_usable(model, *slope));
    let by_use = |&&(i, slope): &&(usize, Expr<'d>)| {
        let is_number = slope.stage() == stage::CONSTANT;
        (uses[i], !is_number, slope.size(), std::cmp::Reverse(i))
    };
    let &(coordinate, coefficient) = usable.min_by_key(by_use)?;
    let at_zero = [(variables[coordinate], dag.zero())];
    let rest = substitute(dag, &[equation], &at_zero)[0];
    let (position, offset) = match constraint.position {
        Some(_) => (-(rest / coefficient), None),
        None => {
            // All coefficients depend on parameters alone, so q_d = C + Σ cᵢ qᵢ + b t.
            let others = slopes.iter().filter(|(i, _)| *i != coordinate);
            let along = others.map(|&(i, slope)| -(slope / coefficient) * dag.expr_of(x.q[i]));
            let at_rest: Vec<_> = left.iter().map(|&i| (x.v[i], dag.zero())).collect();
            let alone = substitute(dag, &[equation], &at_rest)[0];
            let alone = identity::as_function_of_parameters(alone)?;
            let driven = -(alone / coefficient) * model.time;
            let shared = dag.sum(along.chain([driven]));
            let name = format!("offset({})", model.coordinates[coordinate].name);
            let offset = dag.symbol(&name, stage::POSITION);
            let meaning = model.coordinates[coordinate].q - shared;
            (dag.sum([offset, shared]), Some([offset, meaning]))
        }
    };
    let rate = x.without_acceleration(model).of(position);
    let acceleration = x.total(model).of(rate);
    let parts = [position, rate, acceleration];
    let has_value = !parts.iter().any(|part| part.is_undefined());
    has_value.then_some(Dependent {
        coordinate,
        constraint: index,
        coefficient,
        position,
        rate,
        acceleration,
        offset,
    })
}

/// Whether a coefficient may be divided by, that is, is not 0. If it is 0 for the parameters in the spec,
/// another coordinate or none is the better choice, even though this one would do for other parameters.
fn is_usable(model: &Model<'_>, coefficient: Expr<'_>) -> bool {
    if identity::is_zero(coefficient) != Some(false) {
        return false;
    }
    let default = |symbol: Symbol| {
        let mut parameters = model.parameters.iter();
        let parameter = parameters.find(|p| p.symbol.as_symbol() == Some(symbol));
        parameter.and_then(|p| p.default).map_or(1.0, nearest)
    };
    let value = evaluate(model.dag, &[coefficient], default)[0];
    value.is_finite() && value != 0.0
}

/// The number of expressions of the machine in which each coordinate occurs.
fn uses(model: &Model<'_>, x: &Variables<'_>) -> Vec<usize> {
    let mut model = model.clone();
    let all: Vec<_> = expressions(&mut model)
        .into_iter()
        .map(|e| e.symbols())
        .collect();
    let of = |q: &Symbol| all.iter().filter(|symbols| symbols.contains(q)).count();
    x.q.iter().map(of).collect()
}

/// Every expression that enters the equations of motion.
fn expressions<'m, 'd>(model: &'m mut Model<'d>) -> Vec<&'m mut Expr<'d>> {
    let mut all: Vec<&'m mut Expr<'d>> = Vec::new();
    for pose in &mut model.poses {
        all.extend(&mut pose.origin);
        all.extend(pose.axes.iter_mut().flatten());
        all.push(&mut pose.angle);
        match &mut pose.step {
            PoseChange::Ground => {}
            PoseChange::Shift(along) => all.extend(along),
            PoseChange::Turn { angle, .. } => all.push(angle),
            // No constraint determines a component of a quaternion without knowing its length: a constraint that holds
            // for every length is not linear in one component.
            PoseChange::Quaternion(_) => {}
        }
    }
    for body in &mut model.bodies {
        all.push(&mut body.mass);
        all.extend(&mut body.at);
        all.extend(body.local.iter_mut().flat_map(|local| &mut local.point));
        match &mut body.inertia {
            Inertia::Particle => {}
            Inertia::Planar(inertia) => all.push(inertia),
            Inertia::Tensor(inertia) => all.extend(inertia),
        }
        if let Rotation::Angle(angle) = &mut body.rotation {
            all.push(angle);
        }
    }
    all.extend(model.coordinates.iter_mut().filter_map(|c| c.rate.as_mut()));
    let elements = model.elements.iter_mut();
    all.extend(elements.flat_map(|element| element.expressions_mut()));
    all.extend(model.assumptions.iter_mut().map(|fact| &mut fact.excess));
    for circle in &mut model.circles {
        all.extend(&mut circle.center);
        all.push(&mut circle.radius);
    }
    all
}

/// The machine without the coordinates that constraints determine; nothing if there are none, or if
/// it has no equations without them.
pub(super) fn reduction<'d>(
    model: &Model<'d>,
    constraints: &[ConstraintEquation<'d>],
) -> Option<Box<Reduction<'d>>> {
    let dependents = dependents(model, constraints);
    // Derivatives, the results of stages, and friction refer to the whole state.
    let is_whole = !model.derivatives.is_empty() || !model.stages.is_empty();
    if dependents.is_empty() || is_whole || !model.sliding().is_empty() {
        return None;
    }
    let x = Variables::of(model);
    let map = replacements(&x, &dependents);
    let is_dependent = |i: &usize| dependents.iter().any(|d| d.coordinate == *i);
    let coordinates: Vec<usize> = (0..x.q.len()).filter(|i| !is_dependent(i)).collect();
    let is_settled = |k: &usize| dependents.iter().any(|d| d.constraint == *k);
    let left: Vec<usize> = (0..constraints.len()).filter(|k| !is_settled(k)).collect();

    let mut reduced = model.clone();
    for element in &mut reduced.elements {
        let all = std::mem::take(&mut element.contributions).into_iter();
        let reduced = all.flat_map(|one| contribution(one, &x, &coordinates, &dependents));
        element.contributions = reduced.collect();
    }
    reduced.coordinates = coordinates
        .iter()
        .map(|&i| model.coordinates[i].clone())
        .collect();
    reduced.outputs.clear();
    reduced.published.clear();
    let mut places = expressions(&mut reduced);
    let before: Vec<Expr<'d>> = places.iter().map(|place| **place).collect();
    let after = substitute(model.dag, &before, &map);
    places
        .iter_mut()
        .zip(after)
        .for_each(|(place, value)| **place = value);

    let mut equations = Equations::derive(&reduced, &mut Report::new())?;
    let kept = left.iter().map(|&k| {
        let constraint = &constraints[k];
        let position = constraint.position.unwrap_or(model.dag.zero());
        let parts = [position, constraint.rate];
        let parts = substitute(model.dag, &parts, &map);
        let position = constraint.position.map(|_| parts[0]);
        constraint.restated(&reduced, position, parts[1])
    });
    equations.constraints = kept.collect();
    Some(Box::new(Reduction {
        machine: ReducedModel(reduced),
        equations,
        coordinates,
        constraints: left,
        dependents,
    }))
}

/// A contribution without the part that constraints take over. Constraints are counted separately, and a force on a dependent
/// coordinate acts on the coordinates that determine it.
fn contribution<'d>(
    contribution: Contribution<'d>,
    x: &Variables<'d>,
    coordinates: &[usize],
    dependents: &[Dependent<'d>],
) -> Vec<Contribution<'d>> {
    let (coordinate, value) = match contribution {
        Contribution::Constraint(_) | Contribution::Rolling(_) => return Vec::new(),
        Contribution::Load(Load::Coordinate { coordinate, value }) => (coordinate, value),
        other => return vec![other],
    };
    let on = |coordinate, value| Contribution::Load(Load::Coordinate { coordinate, value });
    let own = coordinates.iter().position(|i| *i == coordinate);
    let mut acting: Vec<_> = own.into_iter().map(|place| on(place, value)).collect();
    let dependent = dependents.iter().find(|d| d.coordinate == coordinate);
    for (place, &i) in coordinates.iter().enumerate() {
        let share = dependent.map(|d| d.rate.diff(x.v[i]));
        let share = share.filter(|share| !share.is_zero());
        acting.extend(share.map(|share| on(place, value * share)));
    }
    acting
}
