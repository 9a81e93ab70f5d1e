//! Lowers the expressions of the equations to a [`Program`] of straight-line arithmetic.

mod accelerations;
mod articulated;
mod bars;
mod choosing;
mod chosen;
mod closed;
mod derivatives;
mod friction;
mod projection;
mod slots;
mod stages;
mod turned;

use lagrangian_symbolic::{self as symbolic, Dag, Expr, Stage, Symbol, reachable};
use rustc_hash::FxHashMap;

use crate::equations::UnilateralEquation;
use crate::quantities::{Quantity, quantities, quantity};
use crate::states::sources;
use crate::{ConstraintEquation, Equations, Reduction, SlidingEquation, Unprojected};
use accelerations::{is_mostly_formulas, ways_to_accelerations};
use choosing::{Draft, PlannedFunction};
use chosen::ChosenFunctions;
use lagrangian_program::EliminationStep;
use lagrangian_program::choose::{Basis, Candidate, Choice, Form, best};
use lagrangian_program::graph::{Graph, Id, Scaled};
use lagrangian_program::schedule::prepared;
use lagrangian_program::solve::System;
use lagrangian_program::{Constraint, Function, Program, Role, Shape, Source, Unilateral};
use lagrangian_spec::model::Model;
use slots::{Slots, facts, name_of, start_name, start_values};

/// The largest number of multiplications of an elimination that is written down: each becomes an
/// instruction, and takes 2 kB until then. 115 fully coupled coordinates take this many.
const MOST_MULTIPLICATIONS: usize = 250_000;

/// Lowers a machine to its program: every function of [`Role`], each in the cheapest known form.
pub fn lower<'d>(model: &Model<'d>, equations: &Equations<'d>) -> Program {
    let expanded = equations.expanded();
    lower_by(model, equations, expanded.as_ref(), &best)
}

/// [`lower`] with another choice: `choose` is given two or more drafts of one function and says
/// which one to take.
///
/// `expanded` are the same equations, [multiplied out](Equations::expanded).
pub fn lower_by<'d>(
    model: &Model<'d>,
    equations: &Equations<'d>,
    expanded: Option<&Equations<'d>>,
    choose: &dyn Fn(&[Candidate]) -> usize,
) -> Program {
    let slopes = |basis| match (basis, expanded) {
        (Basis::Expanded, Some(expanded)) => expanded.residual_derivatives_in_forms(model),
        _ => equations.residual_derivatives_in_forms(model),
    };
    let reduced = equations.reduction.as_ref().map(|reduction| {
        let (model, equations) = (&reduction.machine.0, &reduction.equations);
        let expanded = equations.expanded();
        let expanded = expanded.map(|expanded| matrix_and_forces(model, &expanded));
        (
            &**reduction,
            quantities(model, equations),
            expanded.unwrap_or_default(),
        )
    });
    let multipliers = equations.constraints.iter().map(|c| c.multiplier);
    let multipliers: Vec<Expr<'d>> = multipliers.collect();
    let [unprojected, cut_open] = by_loops(equations.unprojected.as_ref(), is_open(equations));
    let source = LoweringInput {
        quantities: &quantities(model, equations),
        expanded: &expanded.map_or_else(Vec::new, |expanded| matrix_and_forces(model, expanded)),
        unprojected,
        cut_open,
        slopes: &slopes,
        sliding: &equations.sliding,
        multipliers: &multipliers,
        reduced: reduced.as_ref().map(|(reduction, quantities, expanded)| {
            let unprojected = reduction.equations.unprojected.as_ref();
            let [unprojected, cut_open] = by_loops(unprojected, reduction.constraints.is_empty());
            EquationSet {
                model: &reduction.machine.0,
                quantities,
                expanded,
                unprojected,
                cut_open,
                reduction: Some(reduction),
            }
        }),
    };
    let mut program = build(
        model,
        source,
        equations.constraints.iter().map(constraint).collect(),
        choose,
    );
    program.contacts = equations.sliding.iter().map(|s| s.name.clone()).collect();
    program.reaction_axes = model.space.reaction_axes();
    let seconds = equations.sliding.iter().enumerate();
    let seconds = seconds.filter(|(_, sliding)| sliding.is_second());
    program.second_tangents = seconds.fold(0, |all, (k, _)| all | 1 << k);
    program.unilateral = equations.unilateral.iter().map(unilateral).collect();
    debug_assert_eq!(program.verify(), Ok(()));
    program
}

/// Equations before projection, of an open machine and of a closed-loop mechanism: elimination along the machine would not close
/// the loops of the second.
fn by_loops<T>(unprojected: Option<T>, is_open: bool) -> [Option<T>; 2] {
    if is_open {
        [unprojected, None]
    } else {
        [None, unprojected]
    }
}

/// What a program states of a unilateral contact.
fn unilateral(equation: &UnilateralEquation<'_>) -> Unilateral {
    Unilateral {
        name: equation.name.clone(),
        law: equation.law,
        order: equation.order,
        painleve: equation.painleve,
        compliance: equation.compliance,
        has_friction: equation.has_friction,
        is_rolling_resistance: equation.is_rolling_resistance,
        is_second_tangent: equation.is_second_tangent,
        has_face: equation.face.is_some(),
        is_guide: equation.is_guide,
    }
}

/// The program that computes the quantities.
///
/// If a mass matrix and forces are among them, the accelerations are computed too.
pub fn of_quantities<'d>(model: &Model<'d>, quantities: &[Quantity<'d>]) -> Program {
    let source = LoweringInput {
        quantities,
        expanded: &[],
        unprojected: None,
        cut_open: None,
        slopes: &|_| Vec::new(),
        sliding: &[],
        multipliers: &[],
        reduced: None,
    };
    build(model, source, Vec::new(), &best)
}

/// The program of these equations, without the names of contacts.
fn build<'d>(
    model: &Model<'d>,
    source: LoweringInput<'_, 'd>,
    constraints: Vec<Constraint>,
    choose: &dyn Fn(&[Candidate]) -> usize,
) -> Program {
    let mut quantities = source.quantities.to_vec();
    if let Some(machine) = source.unprojected {
        shorten_mass_matrix(model, machine, &mut quantities);
    }
    let source = LoweringInput {
        quantities: &quantities,
        ..source
    };
    let starts = start_values(model);
    let mut lowering = Lowering::new(model, constraints.len());
    lowering.lower(&all_values(source.quantities));
    lowering.lower(&starts);
    lowering.lower(&all_values(source.expanded));
    let slots = Slots::of(&mut lowering);
    let start = PlannedFunction {
        role: Role::Start,
        shape: Shape::Vector(starts.len()),
        results: lowering.values(&starts),
        pivots: Vec::new(),
        rows: 0,
        steps: Vec::new(),
    };
    let start = start.only(&mut lowering.graph).function;

    let mut chosen = ChosenFunctions::new(model, choose);
    for quantity in source.quantities {
        let drafts = of_quantity(&mut lowering, quantity, source.expanded);
        chosen.take(drafts, &lowering.graph);
    }
    let ways = ways_to_accelerations(&mut lowering, source);
    chosen.take(ways, &lowering.graph);
    let granted = chosen.add_functions_of_accelerations(&mut lowering, source);
    let (drafts, choices) = chosen.in_order();
    let (prepare, prepared, functions) =
        prepare(&mut lowering.graph, drafts, model, constraints.len());
    let quaternions = model.quaternions.iter();
    let kept = model.kept.iter();
    let mut program = Program {
        name: model.name.clone(),
        docs: model.docs.clone(),
        parameters: slots.parameters,
        coordinates: slots.coordinates,
        quaternions: quaternions.map(|four| four.coordinates(model)).collect(),
        inputs: slots.inputs,
        outputs: slots.outputs,
        assumptions: facts(model),
        constraints,
        contacts: Vec::new(),
        reaction_axes: 1,
        second_tangents: 0,
        unilateral: Vec::new(),
        kept: kept.map(|kept| start_name(model, *kept)).collect(),
        derivatives: granted.derivatives,
        stages: granted.stages,
        prepare,
        prepared,
        start,
        functions,
        choices,
    };
    program.settle_signs();
    // If there are contacts, the caller names them and verifies the program afterwards.
    if source.sliding.is_empty() && model.contacts.is_empty() {
        debug_assert_eq!(program.verify(), Ok(()));
    }
    program
}

fn is_open(equations: &Equations<'_>) -> bool {
    equations.constraints.is_empty()
}

fn all_values<'d>(quantities: &[Quantity<'d>]) -> Vec<Expr<'d>> {
    let values = quantities.iter().flat_map(|quantity| &quantity.values);
    values.copied().collect()
}

/// What a program is made from.
#[derive(Clone, Copy)]
struct LoweringInput<'a, 'd> {
    quantities: &'a [Quantity<'d>],
    /// Some of the same quantities, multiplied out.
    expanded: &'a [Quantity<'d>],
    unprojected: Option<&'a Unprojected<'d>>,
    /// The unprojected equations of a closed-loop mechanism.
    cut_open: Option<&'a Unprojected<'d>>,
    /// The requested derivatives of `f − M a`, in one form or several, of the equations as derived
    /// or multiplied out.
    slopes: &'a dyn Fn(Basis) -> Vec<Vec<Vec<Expr<'d>>>>,
    /// The contacts with friction.
    sliding: &'a [SlidingEquation<'d>],
    /// The symbols of their multipliers.
    multipliers: &'a [Expr<'d>],
    /// This machine without the coordinates that constraints determine.
    reduced: Option<EquationSet<'a, 'd>>,
}

/// A set of equations from which accelerations can be solved.
#[derive(Clone, Copy)]
struct EquationSet<'a, 'd> {
    model: &'a Model<'d>,
    quantities: &'a [Quantity<'d>],
    expanded: &'a [Quantity<'d>],
    unprojected: Option<&'a Unprojected<'d>>,
    cut_open: Option<&'a Unprojected<'d>>,
    /// How its coordinates are embedded in those of the machine, if the machine has more.
    reduction: Option<&'a Reduction<'d>>,
}

impl<'a, 'd> LoweringInput<'a, 'd> {
    /// The set with all coordinates.
    fn all_coordinates(self, model: &'a Model<'d>) -> EquationSet<'a, 'd> {
        EquationSet {
            model,
            quantities: self.quantities,
            expanded: self.expanded,
            unprojected: self.unprojected,
            cut_open: self.cut_open,
            reduction: None,
        }
    }

    /// The quantities of the equations in all coordinates, multiplied out if the accelerations follow from those.
    fn in_all_coordinates(self, accelerations: &Draft) -> (Basis, &'a [Quantity<'d>]) {
        match accelerations.form {
            Form {
                basis: Basis::Expanded,
                reduced: false,
                ..
            } => (Basis::Expanded, self.expanded),
            _ => (Basis::Derived, self.quantities),
        }
    }
}

/// The description of a constraint in the program.
fn constraint(equation: &ConstraintEquation<'_>) -> Constraint {
    Constraint {
        name: equation.name.clone(),
        unit: equation.unit.to_string(),
        multiplier_unit: equation.multiplier_unit().to_string(),
        holonomic: equation.position.is_some(),
    }
}

/// Replaces the mass matrix by that of [`articulated::mass_matrix`] if that is shorter.
fn shorten_mass_matrix<'d>(
    model: &Model<'d>,
    machine: &Unprojected<'d>,
    quantities: &mut [Quantity<'d>],
) {
    let matrix = quantities
        .iter_mut()
        .find(|quantity| quantity.role == Role::MassMatrix);
    if let Some(matrix) = matrix
        && !is_mostly_formulas(model, machine)
        && let Some(composite) = articulated::mass_matrix(model, machine)
        && operations(model.dag, &composite) < operations(model.dag, &matrix.values)
    {
        matrix.values = composite;
    }
}

/// The number of multiplications and additions at run time, sharing only identical nodes.
fn operations(dag: &Dag, roots: &[Expr<'_>]) -> usize {
    let varies = |id: &symbolic::Id| dag.expr(*id).stage() > Stage::PARAMETER;
    let each = |id: symbolic::Id| match dag.node(id) {
        symbolic::Node::Sum(terms) if varies(&id) => terms.len() - 1,
        symbolic::Node::Product(factors) => {
            let varying = factors.iter().filter(|(factor, _)| varies(factor)).count();
            varying.saturating_sub(usize::from(varying == factors.len()))
        }
        _ => 0,
    };
    reachable(dag, roots).into_iter().map(each).sum()
}

/// `M`, `h` and `f`: the quantities that differ if the equations are multiplied out.
fn matrix_and_forces<'d>(model: &Model<'d>, equations: &Equations<'d>) -> Vec<Quantity<'d>> {
    [Role::MassMatrix, Role::Bias, Role::Forces]
        .into_iter()
        .filter_map(|role| quantity(model, equations, role))
        .collect()
}

/// Converts expressions to nodes of the graph.
struct Lowering<'m, 'd> {
    model: &'m Model<'d>,
    /// The number of constraints.
    constraints: usize,
    graph: Graph,
    sources: FxHashMap<Symbol, Source>,
    values: FxHashMap<symbolic::Id, Scaled>,
}

impl<'m, 'd> Lowering<'m, 'd> {
    fn new(model: &'m Model<'d>, constraints: usize) -> Self {
        Lowering {
            model,
            constraints,
            graph: Graph::default(),
            sources: sources(model),
            values: FxHashMap::default(),
        }
    }

    /// Adds the expressions and all their parts to the graph.
    fn lower(&mut self, roots: &[Expr<'d>]) {
        for id in reachable(self.model.dag, roots) {
            if !self.values.contains_key(&id) {
                let value = self.node(&self.model.dag.node(id));
                self.values.insert(id, value);
            }
        }
    }

    /// Makes symbols stand for values that are computed once.
    fn name(&mut self, names: &[(Expr<'d>, Expr<'d>)]) {
        for (name, meaning) in names {
            self.lower(&[*meaning]);
            let value = self.graph.opaque(self.values[&meaning.id()]);
            self.values.insert(name.id(), value);
        }
    }

    fn node(&mut self, node: &symbolic::Node) -> Scaled {
        match node {
            symbolic::Node::Constant(value) => self.graph.constant(value),
            symbolic::Node::Pi => self.graph.pi(),
            symbolic::Node::Symbol(symbol) => {
                let source = self
                    .sources
                    .get(symbol)
                    .expect("expressions are over symbols of their model");
                self.graph.read(*source)
            }
            symbolic::Node::Sum(terms) => {
                let terms: Vec<Scaled> = terms
                    .iter()
                    .map(|(id, coefficient)| {
                        let coefficient = self.graph.constant(coefficient);
                        self.graph
                            .product(&[(coefficient, 1), (self.values[id], 1)])
                    })
                    .collect();
                self.graph.sum(&terms)
            }
            symbolic::Node::Product(factors) => {
                let factors: Vec<(Scaled, i32)> = factors
                    .iter()
                    .map(|(id, power)| (self.values[id], *power))
                    .collect();
                self.graph.product(&factors)
            }
            symbolic::Node::Function(function, arguments) => {
                let arguments: Vec<Scaled> = arguments.iter().map(|id| self.values[id]).collect();
                self.graph.function(*function, &arguments)
            }
        }
    }

    /// `M` and `f`, if both are present, followed by the constraints that belong to them.
    fn system(
        &mut self,
        quantities: &[Quantity<'d>],
        constraints: &[Quantity<'d>],
    ) -> Option<System> {
        let values = |quantities: &[Quantity<'d>], role| {
            let quantity = quantities.iter().find(|quantity| quantity.role == role)?;
            Some(self.values(&quantity.values))
        };
        let mut matrix = values(quantities, Role::MassMatrix)?;
        let mut forces = values(quantities, Role::Forces)?;
        let coordinates = forces.len();
        let rows = values(constraints, Role::ConstraintMatrix).unwrap_or_default();
        let biases = values(constraints, Role::ConstraintBias).unwrap_or_default();
        // A machine whose coordinates are all determined by constraints has rows without entries.
        for k in 0..biases.len() {
            matrix.extend(&rows[k * coordinates..][..coordinates]);
            matrix.extend(vec![Scaled::ZERO; k + 1]);
        }
        forces.extend(biases);
        let system = System {
            matrix,
            forces,
            coordinates,
            held_constraints: Vec::new(),
        };
        Some(system.regularized(&mut self.graph))
    }

    fn values(&self, expressions: &[Expr<'d>]) -> Vec<Scaled> {
        expressions
            .iter()
            .map(|expression| self.values[&expression.id()])
            .collect()
    }
}

/// The drafts of a quantity, as derived and multiplied out.
fn of_quantity<'d>(
    lowering: &mut Lowering<'_, 'd>,
    quantity: &Quantity<'d>,
    expanded: &[Quantity<'d>],
) -> Vec<Draft> {
    let planned = |values: &[Expr<'d>], lowering: &Lowering<'_, 'd>| PlannedFunction {
        role: quantity.role,
        shape: quantity.shape,
        results: lowering.values(values),
        pivots: Vec::new(),
        rows: 0,
        steps: Vec::new(),
    };
    let derived = planned(&quantity.values, lowering);
    let other = expanded
        .iter()
        .find(|other| other.role == quantity.role)
        .map(|other| planned(&other.values, lowering))
        .filter(|other| other.results != derived.results);
    let mut drafts = derived.drafts(&mut lowering.graph, Basis::Derived);
    if let Some(other) = other {
        drafts.extend(other.drafts(&mut lowering.graph, Basis::Expanded));
    }
    drafts
}

/// The largest cost, in percent of the rest, of computing the diagonal entries of `M` with which
/// pivots are compared. If they are not available at this cost, as in a chain in relative angles, a
/// pivot need only be positive.
const MOST_GUARD_COST: usize = 10;

/// The function that computes the prepared values, the formulas of its results, and the other
/// functions with their final indices.
fn prepare(
    graph: &mut Graph,
    drafts: Vec<Draft>,
    model: &Model<'_>,
    constraints: usize,
) -> (Function, Vec<String>, Vec<Function>) {
    let mut pivots = Vec::new();
    let rows = model.coordinates.len() + constraints;
    let functions = drafts.into_iter().map(|draft| {
        pivots.extend(draft.known_pivots);
        (draft.function, draft.prepared)
    });
    let functions = functions.collect();
    let (ids, formulas, functions) = prepared(graph, functions, &|source| name_of(model, source));
    let planned = PlannedFunction {
        role: Role::Prepare,
        shape: Shape::Vector(ids.len()),
        results: ids
            .iter()
            .map(|&factor| Scaled {
                negative: false,
                factor,
                core: Id::ONE,
            })
            .collect(),
        pivots,
        rows,
        steps: Vec::new(),
    };
    let prepare = planned.only(graph).function;
    (prepare, formulas, functions)
}

/// The values of the steps that are in the graph: those that the accelerations need.
fn labelled(
    lowering: &Lowering<'_, '_>,
    steps: &[(Expr<'_>, EliminationStep)],
) -> Vec<(Scaled, EliminationStep)> {
    let values = steps.iter().filter_map(|(expression, step)| {
        let value = lowering.values.get(&expression.id())?;
        Some((*value, *step))
    });
    values.collect()
}
