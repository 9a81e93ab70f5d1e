//! Lowers the expressions of the equations to a [`Program`] of straight-line arithmetic.

mod articulated;
mod bars;
mod closed;
mod derivatives;
mod friction;
mod stages;
pub(crate) mod states;
mod turned;

use lagrangian_symbolic::{self as symbolic, Dag, Expr, Stage, Symbol, nearest, reachable};
use rustc_hash::FxHashMap;

use crate::equations::UnilateralEquation;
use crate::{ConstraintEquation, Equations, Reduction, SlidingEquation, Unprojected};
use articulated::Order;
use lagrangian_program::EliminationStep;
use lagrangian_program::Rounding;
use lagrangian_program::choose::{Basis, Candidate, Choice, Form, best};
use lagrangian_program::formula::formula;
use lagrangian_program::graph::{Graph, Id, Scaled};
use lagrangian_program::net::Net;
use lagrangian_program::quantity::Sizes;
use lagrangian_program::rounding::{self, States};
use lagrangian_program::schedule::{Code, LARGEST_FACTORED, prepared, schedule};
use lagrangian_program::solve::{self, Elimination, Pivot, Solution, System};
use lagrangian_program::{
    Constraint, Default, Fact, Function, Guard, Program, Role, Shape, Slot, Source, Unilateral,
};
use lagrangian_spec::model::{Model, Name, Stages, Variable, stage};
use lagrangian_spec::unit::Unit;
use lagrangian_units::rate_name;

/// A result that a function is to compute, by its role.
#[derive(Clone, Debug)]
pub struct Quantity<'d> {
    /// Its role.
    pub role: Role,
    /// How the values are arranged.
    pub shape: Shape,
    /// The values, [`Shape::len`] of them, over the symbols of the model.
    pub values: Vec<Expr<'d>>,
}

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

/// The coordinates at the start, and behind them their rates if any of these is not 0.
fn start_values<'d>(model: &Model<'d>) -> Vec<Expr<'d>> {
    let mut starts: Vec<Expr<'d>> = model.coordinates.iter().map(|c| c.start).collect();
    if model.coordinates.iter().any(|c| !c.start_rate.is_zero()) {
        starts.extend(model.coordinates.iter().map(|c| c.start_rate));
    }
    starts
}

/// The drafts of the accelerations, or of the response to friction, from which these follow.
fn ways_to_accelerations<'d>(
    lowering: &mut Lowering<'_, 'd>,
    source: LoweringInput<'_, 'd>,
) -> Vec<Draft> {
    let mut ways = if source.sliding.is_empty() {
        accelerations(lowering, source.all_coordinates(lowering.model))
    } else {
        friction::friction(lowering, source)
    };
    if let Some(reduced) = source.reduced {
        let offsets = reduced.reduction.into_iter().flat_map(|r| &r.dependents);
        let offsets = offsets.filter_map(|d| d.offset.map(|[name, meaning]| (name, meaning)));
        lowering.name(&offsets.collect::<Vec<_>>());
        lowering.lower(&all_values(reduced.quantities));
        lowering.lower(&all_values(reduced.expanded));
        ways.extend(accelerations(lowering, reduced));
    }
    ways
}

/// The named numbers that a program takes and gives.
struct Slots {
    parameters: Vec<Slot>,
    coordinates: Vec<Slot>,
    inputs: Vec<Slot>,
    outputs: Vec<Slot>,
}

impl Slots {
    fn of(lowering: &mut Lowering<'_, '_>) -> Slots {
        let model = lowering.model;
        let mut default = |constant| default(lowering, constant);
        let (parameters, inputs) = (model.parameters.iter(), model.inputs.iter());
        let parameters = parameters.map(|p| {
            let default = p.default.map(&mut default);
            slot(&p.name, &p.docs, p.unit, &p.unit_text, default)
        });
        let parameters = parameters.collect();
        let inputs = inputs.map(|i| {
            let default = Some(default(i.default));
            slot(&i.name, &i.docs, i.unit, &i.unit_text, default)
        });
        let inputs = inputs.collect();
        let (coordinates, outputs) = (model.coordinates.iter(), model.outputs.iter());
        let coordinates = coordinates.map(|c| slot(&c.name, &c.docs, c.unit, &c.unit_text, None));
        let outputs = outputs.map(|o| slot(&o.name, &o.docs, o.unit, &o.unit_text, None));
        Slots {
            parameters,
            coordinates: coordinates.collect(),
            inputs,
            outputs: outputs.collect(),
        }
    }
}

/// The functions of a program, each in the form that was chosen.
struct ChosenFunctions<'c> {
    choose: &'c dyn Fn(&[Candidate]) -> usize,
    /// The states at which the effect of round-off on candidates is estimated.
    states: States,
    drafts: Vec<Draft>,
    choices: Vec<Choice>,
}

/// What a program has of what a spec requests.
struct Granted {
    stages: Stages,
    derivatives: Vec<Variable>,
}

impl<'c> ChosenFunctions<'c> {
    fn new(model: &Model<'_>, choose: &'c dyn Fn(&[Candidate]) -> usize) -> Self {
        ChosenFunctions {
            choose,
            states: states::around_start(model, 1, rounding::STATES),
            drafts: Vec::new(),
            choices: Vec::new(),
        }
    }

    /// Chooses one of the drafts of a function; without drafts there is no function.
    fn take(&mut self, candidates: Vec<Draft>, graph: &Graph) {
        let (draft, choice) = chosen_draft(candidates, graph, &self.states, self.choose);
        self.choices.extend(choice);
        self.drafts.extend(draft);
    }

    /// Adds the functions that are made from the accelerations, which were taken last: the accelerations in stages, their
    /// derivatives, and the multipliers.
    fn add_functions_of_accelerations<'d>(
        &mut self,
        lowering: &mut Lowering<'_, 'd>,
        source: LoweringInput<'_, 'd>,
    ) -> Granted {
        let mut granted = Granted {
            stages: Stages::default(),
            derivatives: Vec::new(),
        };
        let last = self.drafts.last();
        let Some(at_once) = last.filter(|last| last.form.role == Role::Accelerations) else {
            return granted;
        };
        let model = lowering.model;
        let (staged, staged_choice) = if model.stages.is_empty() {
            (Vec::new(), None)
        } else {
            stages::staged(lowering, source, at_once, &self.states, self.choose)
        };
        if !staged.is_empty() {
            granted.stages = model.stages;
        }
        let derivatives = derivatives(lowering, source, at_once);
        if derivatives.is_some() {
            granted.derivatives.clone_from(&model.derivatives);
        }
        let multipliers = if lowering.constraints == 0 {
            Vec::new()
        } else {
            multipliers(lowering, source, at_once)
        };
        self.take(multipliers, &lowering.graph);
        self.drafts.extend(derivatives);
        self.drafts.extend(staged);
        self.choices.extend(staged_choice);
        granted
    }

    /// The functions and the choices in the order of roles.
    fn in_order(mut self) -> (Vec<Draft>, Vec<Choice>) {
        self.drafts.sort_by_key(|draft| draft.function.role);
        self.choices.sort_by_key(Choice::role);
        (self.drafts, self.choices)
    }
}

/// The name of a start value: the name of its coordinate, or `der(phi)`.
fn start_name(model: &Model<'_>, of: Variable) -> String {
    match of {
        Variable::Rate(i) => rate_name(&model.coordinates[i].name.to_string(), ""),
        Variable::Coordinate(i) => model.coordinates[i].name.to_string(),
        Variable::Parameter(i) => model.parameters[i].name.to_string(),
        Variable::Input(i) => model.inputs[i].name.to_string(),
    }
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
}

/// The quantities of a machine, in the order of [`Role`]; accelerations follow from them.
pub fn quantities<'d>(model: &Model<'d>, equations: &Equations<'d>) -> Vec<Quantity<'d>> {
    let outputs = (0..equations.outputs.len()).map(Role::Output);
    let facts = (0..model.assumptions.len()).map(Role::Assumption);
    let own = Role::all().filter(|role| !matches!(role, Role::Output(_) | Role::Assumption(_)));
    let roles = own.chain(outputs).chain(facts);
    roles
        .filter_map(|role| quantity(model, equations, role))
        .collect()
}

/// A quantity as expressions; `None` if the machine does not have it, or if it follows from others.
fn quantity<'d>(model: &Model<'d>, equations: &Equations<'d>, role: Role) -> Option<Quantity<'d>> {
    let sizes = Sizes {
        coordinates: model.coordinates.len(),
        constraints: equations.constraints.len(),
        contacts: equations.sliding.len(),
        reaction_axes: model.space.reaction_axes(),
        unilateral: equations.unilateral.len(),
        faces: (equations.unilateral.iter())
            .filter(|u| u.face.is_some())
            .count(),
        derivatives: model.derivatives.len(),
        stores: model.energies_of_states().next().is_some(),
    };
    if !role.row().needs.are_met(sizes) {
        return None;
    }
    let (constraints, sliding) = (equations.constraints.iter(), equations.sliding.iter());
    let unilateral = &equations.unilateral;
    let directions = unilateral.iter().flat_map(|u| &u.directions);
    let zero = model.dag.zero();
    let values = match role {
        Role::MassMatrix => equations.mass_matrix.lower().to_vec(),
        Role::Bias => equations.bias.clone(),
        Role::Applied => equations.applied.clone(),
        Role::Forces => equations.forces.clone(),
        Role::KineticEnergy => vec![equations.kinetic_energy],
        Role::PotentialEnergy => vec![equations.potential_energy],
        Role::StateEnergy => vec![equations.state_energy],
        Role::Dissipation => vec![equations.dissipation],
        Role::WorkRate => vec![equations.work_rate],
        Role::DissipationRate => vec![equations.dissipation_rate],
        Role::ConstraintPositions => constraints.map(|c| c.position.unwrap_or(zero)).collect(),
        Role::ConstraintRates => constraints.map(|c| c.rate).collect(),
        Role::ConstraintMatrix => constraints.flat_map(|c| c.row.iter().copied()).collect(),
        Role::ConstraintBias => constraints.map(|c| c.bias).collect(),
        Role::Slips => sliding.map(|s| s.slip).collect(),
        Role::SlipMatrix => sliding.flat_map(|s| s.row.iter().copied()).collect(),
        Role::SlipBias => sliding.map(|s| s.bias).collect(),
        Role::Gaps => unilateral.iter().map(|u| u.gap).collect(),
        Role::ContactFaces => unilateral.iter().filter_map(|u| u.face).flatten().collect(),
        Role::ContactRates => directions.map(|d| d.rate).collect(),
        Role::ContactMatrix => directions.flat_map(|d| d.row.iter().copied()).collect(),
        Role::ContactBias => directions.map(|d| d.bias).collect(),
        Role::ContactCoefficients => unilateral.iter().flat_map(|u| u.coefficients).collect(),
        Role::Output(index) => vec![equations.outputs[index]],
        Role::Assumption(index) => vec![model.assumptions[index].excess],
        // These are found by elimination, or are not expressions of the equations.
        Role::Prepare
        | Role::Start
        | Role::Accelerations
        | Role::Multipliers
        | Role::Friction
        | Role::Derivatives
        | Role::Adjoint
        | Role::Gradient(_)
        | Role::AtTime
        | Role::AtPosition
        | Role::AccelerationsAt => return None,
    };
    Some(Quantity {
        role,
        shape: role.row().extent.shape(sizes)?,
        values,
    })
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

/// A function before its code is written.
struct PlannedFunction {
    role: Role,
    shape: Shape,
    results: Vec<Scaled>,
    pivots: Vec<Pivot>,
    /// The number of rows of the system that the pivots belong to.
    rows: usize,
    /// The steps of the elimination that finds the results.
    steps: Vec<(Scaled, EliminationStep)>,
}

/// A candidate form of a function, before one of them is chosen.
struct Draft {
    form: Form,
    function: Function,
    /// The nodes that its `Read(Prepared(k))` refer to.
    prepared: Vec<Id>,
    /// Pivots that depend on parameters alone.
    known_pivots: Vec<Pivot>,
}

impl Draft {
    fn is_same(&self, other: &Draft) -> bool {
        let [a, b] = [&self.function, &other.function];
        let is_same = a.code == b.code && a.results == b.results && a.guards == b.guards;
        is_same && self.prepared == other.prepared
    }
}

impl PlannedFunction {
    /// The function in its alternative forms: with common pairs shared, and with factors taken out
    /// of sums before that.
    fn drafts(self, graph: &mut Graph, basis: Basis) -> Vec<Draft> {
        let net = self.net(graph, true);
        let mut factored = net.clone();
        let has_factors = net.size() <= LARGEST_FACTORED && factored.factor();
        let mut drafts = vec![self.draft(Some(graph), net, basis, false)];
        if has_factors {
            drafts.push(self.draft(Some(graph), factored, basis, true));
        }
        drafts
    }

    /// The function in its only form, for functions of parameters.
    fn only(self, graph: &mut Graph) -> Draft {
        let net = self.net(graph, false);
        self.draft(None, net, Basis::Derived, false)
    }

    fn net(&self, graph: &mut Graph, cut: bool) -> Net {
        let guarded = self.pivots.iter().flat_map(|p| [p.pivot, p.scale]);
        let values: Vec<Scaled> = self.results.iter().copied().chain(guarded).collect();
        Net::of_elimination(graph, &values, &self.steps, cut)
    }

    /// The function of a net. If the graph is given, values that depend on parameters alone are prepared.
    fn draft(
        &self,
        graph: Option<&mut Graph>,
        mut net: Net,
        basis: Basis,
        factored: bool,
    ) -> Draft {
        net.share_pairs();
        let Code {
            code,
            roots,
            prepared,
            steps,
        } = schedule(&net, graph);
        let (results, guarded) = roots.split_at(self.results.len());
        let guards = self
            .pivots
            .iter()
            .zip(guarded.chunks_exact(2))
            .map(|(p, values)| Guard {
                pivot: values[0],
                scale: values[1],
                tolerance: solve::pivot_tolerance(self.rows),
                coordinate: p.coordinate,
            })
            .collect();
        Draft {
            form: Form {
                role: self.role,
                basis,
                reduced: false,
                factored,
            },
            function: Function {
                role: self.role,
                code,
                shape: self.shape,
                results: results.to_vec(),
                guards,
                steps,
            },
            prepared,
            known_pivots: Vec::new(),
        }
    }
}

/// The draft that is chosen, and the record of the choice if there was one.
fn chosen_draft(
    mut drafts: Vec<Draft>,
    graph: &Graph,
    states: &States,
    choose: &dyn Fn(&[Candidate]) -> usize,
) -> (Option<Draft>, Option<Choice>) {
    let mut different: Vec<Draft> = Vec::with_capacity(drafts.len());
    for draft in drafts.drain(..) {
        if !different.iter().any(|other| draft.is_same(other)) {
            different.push(draft);
        }
    }
    if different.len() < 2 {
        return (different.pop(), None);
    }
    let roundings = roundings(&different.iter().collect::<Vec<_>>(), graph, states);
    let candidate = |(index, draft): (usize, &Draft)| Candidate {
        form: draft.form,
        counts: draft.function.counts(),
        cost: draft.function.cost(),
        rounding: roundings.as_ref().map(|roundings| roundings[index]),
    };
    let candidates: Vec<Candidate> = different.iter().enumerate().map(candidate).collect();
    let chosen = choose(&candidates).min(candidates.len() - 1);
    let draft = different.swap_remove(chosen);
    (Some(draft), Some(Choice { candidates, chosen }))
}

/// The effect of round-off on the results of each draft, including the values prepared for it.
fn roundings(drafts: &[&Draft], graph: &Graph, states: &States) -> Option<Vec<Rounding>> {
    let all = drafts.iter().flat_map(|draft| draft.prepared.iter());
    let mut ids: Vec<Id> = all.copied().collect();
    ids.sort_unstable();
    ids.dedup();
    let roots: Vec<(Id, bool)> = ids.iter().map(|&id| (id, false)).collect();
    let Code { code, roots, .. } = schedule(&Net::new(graph, &roots, false), None);
    let prepare = Function {
        role: Role::Prepare,
        code,
        shape: Shape::Vector(roots.len()),
        results: roots,
        guards: Vec::new(),
        steps: Vec::new(),
    };
    let reading = drafts.iter().map(|draft| {
        let place = |id: &Id| ids.binary_search(id).unwrap_or(0);
        let prepared = draft.prepared.iter().map(place).collect();
        (&draft.function, prepared)
    });
    let functions: Vec<(&Function, Vec<usize>)> = reading.collect();
    states.roundings(&prepare, &functions)
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

/// The drafts of the accelerations, from the mass matrix and along the machine.
fn accelerations<'d>(lowering: &mut Lowering<'_, 'd>, source: EquationSet<'_, 'd>) -> Vec<Draft> {
    let Some(derived) = lowering.system(source.quantities, source.quantities) else {
        return Vec::new();
    };
    let mut systems = vec![(Basis::Derived, derived)];
    let expanded = lowering
        .system(source.expanded, source.quantities)
        .filter(|expanded| *expanded != systems[0].1);
    systems.extend(expanded.map(|system| (Basis::Expanded, system)));
    let elimination = Elimination::of(&lowering.graph, &systems[0].1);
    let has_other = elimination.multiplications <= MOST_MULTIPLICATIONS;
    let mut drafts = Vec::new();
    for basis in [Basis::Along, Basis::Ahead] {
        // At least one draft is needed; if formulas are nearly all of the work, a second one is not tried.
        let machine = source
            .unprojected
            .filter(|machine| !has_other || !is_mostly_formulas(source.model, machine));
        let Some(machine) = machine else {
            break;
        };
        let matrix = &systems[0].1.matrix;
        match along_the_machine(lowering, source, matrix, machine, (basis, has_other)) {
            Some(along) => drafts.extend(along),
            // The other order is no shorter.
            None => break,
        }
    }
    if let Some(machine) = source.cut_open
        && let Some(solution) = closed::solve(lowering, source.model, &systems[0].1, machine)
    {
        drafts.extend(solved(lowering, source, solution, Basis::Along));
    }
    let shortest = drafts
        .iter()
        .map(|draft| draft.function.counts().ops())
        .min();
    for (basis, system) in systems {
        let elimination = Elimination::of(&lowering.graph, &system);
        // A certainly longer elimination is not even written down, since it grows with the cube of
        // the number of coordinates.
        let most = shortest.map_or(MOST_MULTIPLICATIONS, |ops| ops.min(MOST_MULTIPLICATIONS));
        if elimination.multiplications > most {
            continue;
        }
        let solution = solve::solve(&mut lowering.graph, &system, elimination);
        drafts.extend(solved(lowering, source, solution, basis));
    }
    drafts
}

/// The scale in the guard of a squared coefficient that depends on parameters alone: `n Σ t²` over its
/// terms `t`, times the tolerance of guards, so that the guard fails if the coefficient may be nothing
/// but round-off of its terms. `None` if its round-off is negligible: a product, or a sum or difference
/// of two given numbers.
fn rounding_of(coefficient: Expr<'_>, rows: usize) -> Option<Expr<'_>> {
    let dag = coefficient.dag();
    let symbolic::Node::Sum(terms) = coefficient.node() else {
        return None;
    };
    let is_given = |(id, c): &(symbolic::Id, lagrangian_symbolic::Rational)| {
        let is_symbol = dag.expr(*id).as_symbol().is_some();
        is_symbol && c.abs().is_one()
    };
    if terms.len() < 2 || (terms.len() == 2 && terms.iter().all(is_given)) {
        return None;
    }
    let squares = terms
        .iter()
        .map(|(id, c)| (dag.expr(*id) * c.clone()).square());
    let tolerance = solve::pivot_tolerance(rows) * terms.len() as f64;
    // Rounded up to a power of 2, so that the tolerance is not a number in the equations.
    let halvings = -tolerance.log2().ceil() as i32;
    Some(dag.sum(squares) / dag.int(2).powi(halvings))
}

/// The largest number of nodes of velocities and loads, and how many more for every pair of coordinates, for
/// which an elimination order is searched. A chain of 64 links takes some 20 for each pair.
const FORMULAS: [usize; 2] = [20_000, 1_000];

/// Whether velocities and loads are so long, relative to the number of coordinates, that the elimination order
/// cannot matter: it changes the products for pairs of coordinates, not the formulas.
fn is_mostly_formulas(model: &Model<'_>, machine: &Unprojected<'_>) -> bool {
    let carriers = machine.inertia.iter().flat_map(|pair| [pair.u, pair.w]);
    let loads = machine.loads.iter().flat_map(|&(u, load)| [u, load]);
    let roots: Vec<Expr<'_>> = carriers.chain(loads).collect();
    let coordinates = model.coordinates.len();
    let pairs = coordinates * (coordinates + 1) / 2;
    reachable(model.dag, &roots).len() > FORMULAS[0] + FORMULAS[1] * pairs
}

/// The largest number of multiplications of an elimination that is written down: each becomes an
/// instruction, and takes 2 kB until then. 115 fully coupled coordinates take this many.
const MOST_MULTIPLICATIONS: usize = 250_000;

/// Extends a solution for the independent coordinates to all coordinates.
fn embedded<'d>(
    lowering: &mut Lowering<'_, 'd>,
    reduction: &Reduction<'d>,
    solution: Solution,
) -> Solution {
    let all = lowering.model.coordinates.len();
    let left = &reduction.coordinates;
    let mut accelerations = vec![Scaled::ZERO; all];
    for (&i, &value) in left.iter().zip(&solution.accelerations) {
        accelerations[i] = value;
    }
    // Values that were lowered earlier, such as outputs, may contain the accelerations as arguments.
    let before = lowering.values.clone();
    for (i, value) in accelerations.iter().enumerate() {
        let symbol = lowering.model.coordinates[i].a;
        lowering.values.insert(symbol.id(), *value);
    }
    let dag = lowering.model.dag;
    let is_later = |id: &symbolic::Id| dag.expr(*id).stage() >= stage::ACCELERATION;
    let is_symbol = |id: &symbolic::Id| dag.expr(*id).as_symbol().is_some();
    lowering
        .values
        .retain(|id, _| !is_later(id) || is_symbol(id));
    let following: Vec<Expr<'d>> = reduction
        .dependents
        .iter()
        .map(|d| d.acceleration)
        .collect();
    lowering.lower(&following);
    for (dependent, value) in reduction.dependents.iter().zip(lowering.values(&following)) {
        accelerations[dependent.coordinate] = value;
    }
    lowering.values = before;

    let row = |row: usize| match row.checked_sub(left.len()) {
        None => left[row],
        Some(constraint) => all + reduction.constraints[constraint],
    };
    let pivots = solution.pivots.into_iter().map(|pivot| Pivot {
        coordinate: row(pivot.coordinate),
        ..pivot
    });
    let mut pivots: Vec<Pivot> = pivots.collect();
    // The coefficient was divided by; the determinant contains its square.
    let rows = all + lowering.constraints;
    for dependent in &reduction.dependents {
        lowering.lower(&[dependent.coefficient]);
        let coefficient = lowering.values(&[dependent.coefficient])[0];
        let pivot = lowering.graph.product(&[(coefficient, 2)]);
        let pivot = lowering.graph.opaque(pivot);
        pivots.push(Pivot {
            coordinate: all + dependent.constraint,
            pivot,
            scale: match rounding_of(dependent.coefficient, rows) {
                None => pivot,
                Some(rounding) => {
                    lowering.lower(&[rounding]);
                    lowering.values(&[rounding])[0]
                }
            },
        });
    }
    let steps = solution.steps.into_iter();
    Solution {
        accelerations,
        multipliers: Vec::new(),
        pivots,
        columns: Vec::new(),
        steps: steps
            .map(|(value, step)| (value, step.with_rows(row)))
            .collect(),
    }
}

/// The multipliers of the constraints, from the equations in all coordinates.
fn multipliers<'d>(
    lowering: &mut Lowering<'_, 'd>,
    source: LoweringInput<'_, 'd>,
    accelerations: &Draft,
) -> Vec<Draft> {
    let (basis, quantities) = match accelerations.form {
        Form {
            basis: Basis::Expanded,
            reduced: false,
            ..
        } => (Basis::Expanded, source.expanded),
        _ => (Basis::Derived, source.quantities),
    };
    let Some(system) = lowering.system(quantities, source.quantities) else {
        return Vec::new();
    };
    let elimination = Elimination::of(&lowering.graph, &system);
    let work = elimination.multiplications;
    let along = source.cut_open.and_then(|machine| {
        let solution = closed::solve(lowering, lowering.model, &system, machine)?;
        Some((Basis::Along, solution))
    });
    let mut drafts = Vec::new();
    let mut draft = |lowering: &mut Lowering<'_, 'd>, basis, solution: Solution| {
        let known = &accelerations.known_pivots;
        let pivots = solution.pivots.into_iter();
        let planned = PlannedFunction {
            role: Role::Multipliers,
            shape: Shape::Vector(solution.multipliers.len()),
            results: solution.multipliers,
            pivots: pivots.filter(|pivot| !known.contains(pivot)).collect(),
            rows: system.forces.len(),
            steps: solution.steps,
        };
        let ways = planned.drafts(&mut lowering.graph, basis);
        let shortest = ways.iter().map(|draft| draft.function.counts().ops()).min();
        drafts.extend(ways);
        shortest
    };
    let shortest = along.and_then(|(basis, solution)| draft(lowering, basis, solution));
    if work <= shortest.unwrap_or(MOST_MULTIPLICATIONS) {
        let solution = solve::solve(&mut lowering.graph, &system, elimination);
        draft(lowering, basis, solution);
    }
    drafts
}

/// The accelerations with their derivatives, if any are requested, from the same equations as the accelerations.
fn derivatives<'d>(
    lowering: &mut Lowering<'_, 'd>,
    source: LoweringInput<'_, 'd>,
    accelerations: &Draft,
) -> Option<Draft> {
    let (quantities, unprojected) = match accelerations.form.basis {
        Basis::Expanded => (source.expanded, None),
        Basis::Derived | Basis::Along | Basis::Ahead => (source.quantities, source.unprojected),
    };
    let slopes = (source.slopes)(accelerations.form.basis);
    let system = lowering.system(quantities, source.quantities)?;
    let input = derivatives::DerivativeInput {
        system: &system,
        multipliers: source.multipliers,
        unprojected,
        residual_derivatives: &slopes,
        known_pivots: &accelerations.known_pivots,
    };
    (!slopes.is_empty()).then(|| derivatives::derivatives(lowering, &input))
}

/// The drafts of a solution; pivots that depend on parameters alone are kept apart.
fn solved<'d>(
    lowering: &mut Lowering<'_, 'd>,
    source: EquationSet<'_, 'd>,
    solution: Solution,
    basis: Basis,
) -> Vec<Draft> {
    let solution = match source.reduction {
        Some(reduction) => embedded(lowering, reduction, solution),
        None => solution,
    };
    let known = |p: &Pivot| p.pivot.is_known() && p.scale.is_known();
    let (known_pivots, pivots): (Vec<Pivot>, Vec<Pivot>) =
        solution.pivots.into_iter().partition(known);
    let planned = PlannedFunction {
        role: Role::Accelerations,
        rows: solution.accelerations.len() + solution.multipliers.len(),
        shape: Shape::Vector(solution.accelerations.len()),
        results: solution.accelerations,
        pivots,
        steps: solution.steps,
    };
    let mut drafts = planned.drafts(&mut lowering.graph, basis);
    for draft in &mut drafts {
        draft.form.reduced = source.reduction.is_some();
        draft.known_pivots.clone_from(&known_pivots);
    }
    drafts
}

/// The accelerations by [`articulated::solve`]; `None` if these are too long and the mass matrix already gives another draft.
fn along_the_machine<'d>(
    lowering: &mut Lowering<'_, 'd>,
    source: EquationSet<'_, 'd>,
    matrix: &[Scaled],
    machine: &Unprojected<'d>,
    (basis, has_other): (Basis, bool),
) -> Option<Vec<Draft>> {
    let order = match basis {
        Basis::Ahead => Order::Ahead,
        _ => Order::Short,
    };
    // A frame that is turned by a quaternion moves with three velocities.
    let Some(turned::TurnSolution {
        accelerations,
        pivots,
        solution: articulated::ArticulatedSolution { names, labels, .. },
        ..
    }) = turned::solve(source.model, machine, order)
    else {
        return Some(Vec::new());
    };
    let values: Vec<Expr<'d>> = pivots.iter().map(|(_, pivot)| *pivot).collect();
    if has_other {
        let named = names.iter().map(|(_, value)| *value);
        let all: Vec<Expr<'d>> = named
            .chain(accelerations.iter().chain(&values).copied())
            .collect();
        if symbolic::evaluation_work(source.model.dag, &all) > LARGEST_FACTORED {
            return None;
        }
    }
    lowering.name(&names);
    lowering.lower(&accelerations);
    lowering.lower(&values);
    let labels = labelled(lowering, &labels);
    let results = lowering.values(&accelerations);
    let pivots: Vec<(usize, Scaled)> = pivots
        .iter()
        .map(|(coordinate, _)| *coordinate)
        .zip(lowering.values(&values))
        .collect();
    let mut with_scales = |scale: &dyn Fn(usize, Scaled) -> Scaled| {
        let pivots = pivots.iter().map(|&(coordinate, pivot)| Pivot {
            coordinate,
            pivot,
            scale: scale(coordinate, pivot),
        });
        let solution = Solution {
            pivots: pivots.collect(),
            accelerations: results.clone(),
            multipliers: Vec::new(),
            columns: Vec::new(),
            steps: labels.clone(),
        };
        solved(lowering, source, solution, basis)
    };
    let diagonal = |i: usize| matrix[Shape::index(i, i)];
    let full = with_scales(&|i, _| diagonal(i));
    let lean = with_scales(&|i, pivot| {
        if diagonal(i).is_known() {
            diagonal(i)
        } else {
            pivot
        }
    });
    let ops = |drafts: &[Draft]| {
        let counts = drafts.iter().map(|draft| draft.function.counts().ops());
        counts.min().unwrap_or(0)
    };
    let is_cheap = 100 * ops(&full) <= (100 + MOST_GUARD_COST) * ops(&lean);
    Some(if is_cheap { full } else { lean })
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

/// The source of each symbol of a model.
pub(super) fn sources(model: &Model<'_>) -> FxHashMap<Symbol, Source> {
    let mut sources = FxHashMap::default();
    let mut add = |symbol: Expr<'_>, source: Source| {
        if let Some(symbol) = symbol.as_symbol() {
            sources.insert(symbol, source);
        }
    };
    add(model.time, Source::Time);
    for (parameter, index) in model.parameters.iter().zip(0..) {
        add(parameter.symbol, Source::Parameter(index));
    }
    for (coordinate, index) in model.coordinates.iter().zip(0..) {
        add(coordinate.q, Source::Coordinate(index));
        add(coordinate.v, Source::Velocity(index));
        add(coordinate.a, Source::Acceleration(index));
    }
    for (input, index) in model.inputs.iter().zip(0..) {
        add(input.symbol, Source::Input(index));
    }
    sources
}

fn facts(model: &Model<'_>) -> Vec<Fact> {
    let assumptions = model.assumptions.iter();
    assumptions
        .map(|a| Fact {
            text: a.text.clone(),
            strict: a.strict,
        })
        .collect()
}

fn slot(name: &Name, docs: &str, unit: Unit, unit_text: &str, default: Option<Default>) -> Slot {
    Slot {
        name: name.clone(),
        docs: docs.to_owned(),
        unit,
        unit_text: unit_text.to_owned(),
        default,
    }
}

/// A constant, as a number and as text.
fn default<'d>(lowering: &mut Lowering<'_, 'd>, constant: Expr<'d>) -> Default {
    let value = nearest(constant);
    lowering.lower(&[constant]);
    let text = formula(
        &mut lowering.graph,
        lowering.values[&constant.id()],
        &|source| name_of(lowering.model, source),
    );
    Default { value, text }
}

/// The name of an argument.
fn name_of(model: &Model<'_>, source: Source) -> String {
    let coordinate = |index: u32| model.coordinates[index as usize].name.to_string();
    match source {
        Source::Parameter(index) => model.parameters[index as usize].name.to_string(),
        Source::Prepared(index) => format!("prepared {index}"),
        Source::Time => "t".into(),
        Source::Coordinate(index) => coordinate(index),
        Source::Velocity(index) => rate_name(&coordinate(index), ""),
        Source::Acceleration(index) => rate_name(&rate_name(&coordinate(index), ""), ""),
        Source::Input(index) => model.inputs[index as usize].name.to_string(),
        Source::AtTime(index) => format!("at time {index}"),
        Source::AtPosition(index) => format!("at position {index}"),
    }
}
