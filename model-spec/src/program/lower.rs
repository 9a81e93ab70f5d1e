//! From expressions to programs.

mod derivatives;
mod stages;

use lagrangian_symbolic::{self as symbolic, Dag, Expr, Stage, Symbol, nearest, reachable};
use rustc_hash::FxHashMap;

use super::articulated::{self, Order};
use super::choose::{Basis, Candidate, Choice, Form, best};
use super::formula::formula;
use super::graph::{Graph, Id, Scaled};
use super::net::Net;
use super::rounding::{Rounding, States};
use super::schedule::{Code, schedule};
use super::solve::{self, Elimination, Pivot, Solution};
use super::{Default, Fact, Function, Guard, Op, Program, Role, Shape, Slot, Source};
use crate::mechanics::{Equations, Unprojected};
use crate::model::{Model, Name, Stages};
use crate::unit::Unit;

/// A named result: what a function is to compute.
#[derive(Clone, Debug)]
pub struct Quantity<'d> {
    /// What it is.
    pub role: Role,
    /// How the values are arranged.
    pub shape: Shape,
    /// The values, [`Shape::len`] many, over the symbols of the model.
    pub values: Vec<Expr<'d>>,
}

impl Program {
    /// The program of a machine: every function that [`Role`] names, each in the cheapest way that
    /// is known.
    pub fn lower<'d>(model: &Model<'d>, equations: &Equations<'d>) -> Program {
        let expanded = equations.expanded();
        Program::lower_by(model, equations, expanded.as_ref(), &best)
    }

    /// The same with a choice of one's own: `choose` is given the programs for one function, two or
    /// more, and says which it is to be.
    ///
    /// `expanded` are the same equations, [multiplied out](Equations::expanded).
    pub fn lower_by<'d>(
        model: &Model<'d>,
        equations: &Equations<'d>,
        expanded: Option<&Equations<'d>>,
        choose: &dyn Fn(&[Candidate]) -> usize,
    ) -> Program {
        let slopes = |basis| match (basis, expanded) {
            (Basis::Expanded, Some(expanded)) => expanded.slopes_in_forms(model),
            _ => equations.slopes_in_forms(model),
        };
        let source = Origin {
            quantities: &quantities(model, equations),
            expanded: &expanded
                .map_or_else(Vec::new, |expanded| matrix_and_forces(model, expanded)),
            unprojected: equations.unprojected.as_ref(),
            slopes: &slopes,
        };
        Program::build(model, source, choose)
    }

    /// The program that computes the quantities.
    ///
    /// If a mass matrix and forces are among them, there are accelerations too.
    pub fn of_quantities<'d>(model: &Model<'d>, quantities: &[Quantity<'d>]) -> Program {
        let source = Origin {
            quantities,
            expanded: &[],
            unprojected: None,
            slopes: &|_| Vec::new(),
        };
        Program::build(model, source, &best)
    }

    fn build<'d>(
        model: &Model<'d>,
        source: Origin<'_, 'd>,
        choose: &dyn Fn(&[Candidate]) -> usize,
    ) -> Program {
        let mut quantities = source.quantities.to_vec();
        if let Some(machine) = source.unprojected {
            shorten_mass_matrix(model, machine, &mut quantities);
        }
        let source = Origin {
            quantities: &quantities,
            ..source
        };
        let mut starts: Vec<Expr<'d>> = model.coordinates.iter().map(|c| c.start).collect();
        if model.coordinates.iter().any(|c| !c.start_rate.is_zero()) {
            starts.extend(model.coordinates.iter().map(|c| c.start_rate));
        }
        let mut lowering = Lowering::new(model);
        lowering.lower(&all_values(source.quantities));
        lowering.lower(&starts);
        lowering.lower(&all_values(source.expanded));
        let mut default = |constant| default(&mut lowering, constant);
        let parameters = model
            .parameters
            .iter()
            .map(|p| {
                slot(
                    &p.name,
                    &p.docs,
                    p.unit,
                    &p.unit_text,
                    p.default.map(&mut default),
                )
            })
            .collect();
        let inputs = model
            .inputs
            .iter()
            .map(|i| {
                slot(
                    &i.name,
                    &i.docs,
                    i.unit,
                    &i.unit_text,
                    Some(default(i.default)),
                )
            })
            .collect();
        let coordinates = model
            .coordinates
            .iter()
            .map(|c| slot(&c.name, &c.docs, c.unit, &c.unit_text, None))
            .collect();
        let outputs = model
            .outputs
            .iter()
            .map(|o| slot(&o.name, &o.docs, o.unit, &o.unit_text, None))
            .collect();

        let start = Planned {
            role: Role::Start,
            shape: Shape::Vector(starts.len()),
            results: lowering.values(&starts),
            pivots: Vec::new(),
        };
        let start = start.only(&mut lowering.graph).function;
        let mut choices = Vec::new();
        let mut drafts: Vec<Draft> = Vec::new();
        let states = States::of(model);
        let mut take = |candidates: Vec<Draft>, graph: &Graph| {
            let (draft, choice) = taken(candidates, graph, &states, choose);
            choices.extend(choice);
            drafts.extend(draft);
        };
        for quantity in source.quantities {
            let drafts = of_quantity(&mut lowering, quantity, source.expanded);
            take(drafts, &lowering.graph);
        }
        let ways = accelerations(&mut lowering, source);
        take(ways, &lowering.graph);
        let (staged, staged_choice) = match drafts.last() {
            Some(last) if last.form.role == Role::Accelerations && !model.stages.is_empty() => {
                stages::staged(&mut lowering, source, last, &states, choose)
            }
            _ => (Vec::new(), None),
        };
        let stages = match staged.is_empty() {
            true => Stages::default(),
            false => model.stages,
        };
        let derivatives = match drafts.last() {
            Some(last) if last.form.role == Role::Accelerations => {
                derivatives(&mut lowering, source, last)
            }
            _ => None,
        };
        let has_derivatives = derivatives.is_some();
        drafts.extend(derivatives);
        drafts.extend(staged);
        choices.extend(staged_choice);
        drafts.sort_by_key(|draft| draft.function.role);
        choices.sort_by_key(Choice::role);
        let (prepare, prepared, functions) = prepare(&mut lowering.graph, drafts, model);
        let program = Program {
            name: model.name.clone(),
            docs: model.docs.clone(),
            parameters,
            coordinates,
            inputs,
            outputs,
            assumptions: facts(model),
            derivatives: match has_derivatives {
                true => model.derivatives.clone(),
                false => Vec::new(),
            },
            stages,
            prepare,
            prepared,
            start,
            functions,
            choices,
        };
        debug_assert_eq!(program.verify(), Ok(()));
        program
    }
}

fn all_values<'d>(quantities: &[Quantity<'d>]) -> Vec<Expr<'d>> {
    let values = quantities.iter().flat_map(|quantity| &quantity.values);
    values.copied().collect()
}

/// What a program is made from.
#[derive(Clone, Copy)]
struct Origin<'a, 'd> {
    quantities: &'a [Quantity<'d>],
    /// Some of the same quantities, multiplied out.
    expanded: &'a [Quantity<'d>],
    unprojected: Option<&'a Unprojected<'d>>,
    /// The derivatives of `f − M a` that are asked for, in one form or several, of the equations as
    /// they were derived or multiplied out.
    slopes: &'a dyn Fn(Basis) -> Vec<Vec<Vec<Expr<'d>>>>,
}

/// What there is to compute of a machine, in the order of [`Role`]; accelerations follow from it.
pub fn quantities<'d>(model: &Model<'d>, equations: &Equations<'d>) -> Vec<Quantity<'d>> {
    let n = model.coordinates.len();
    let scalar = |role, value| Quantity {
        role,
        shape: Shape::Scalar,
        values: vec![value],
    };
    let applied = Quantity {
        role: Role::Applied,
        shape: Shape::Vector(n),
        values: equations.applied.clone(),
    };
    let mut quantities = matrix_and_forces(model, equations);
    quantities.insert(2, applied);
    quantities.extend([
        scalar(Role::KineticEnergy, equations.kinetic_energy),
        scalar(Role::PotentialEnergy, equations.potential_energy),
        scalar(Role::Dissipation, equations.dissipation),
        scalar(Role::WorkRate, equations.work_rate),
        scalar(Role::DissipationRate, equations.dissipation_rate),
    ]);
    let outputs = equations.outputs.iter().enumerate();
    quantities.extend(outputs.map(|(index, value)| scalar(Role::Output(index), *value)));
    let assumptions = model.assumptions.iter().enumerate();
    quantities
        .extend(assumptions.map(|(index, fact)| scalar(Role::Assumption(index), fact.excess)));
    quantities
}

/// Takes the mass matrix by [`articulated::mass_matrix`] where that is shorter.
fn shorten_mass_matrix<'d>(
    model: &Model<'d>,
    machine: &Unprojected<'d>,
    quantities: &mut [Quantity<'d>],
) {
    let matrix = quantities
        .iter_mut()
        .find(|quantity| quantity.role == Role::MassMatrix);
    if let Some(matrix) = matrix
        && let Some(composite) = articulated::mass_matrix(model, machine)
        && operations(model.dag, &composite) < operations(model.dag, &matrix.values)
    {
        matrix.values = composite;
    }
}

/// How many numbers are multiplied and added at run time, before anything is shared but nodes.
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

/// `M`, `h` and `f`: what is different in equations that are multiplied out.
fn matrix_and_forces<'d>(model: &Model<'d>, equations: &Equations<'d>) -> Vec<Quantity<'d>> {
    let n = model.coordinates.len();
    let quantity = |role, shape, values: &[Expr<'d>]| Quantity {
        role,
        shape,
        values: values.to_vec(),
    };
    let matrix = equations.mass_matrix.lower();
    vec![
        quantity(Role::MassMatrix, Shape::Symmetric(n), matrix),
        quantity(Role::Bias, Shape::Vector(n), &equations.bias),
        quantity(Role::Forces, Shape::Vector(n), &equations.forces),
    ]
}

/// Expressions on their way into the graph.
struct Lowering<'m, 'd> {
    model: &'m Model<'d>,
    graph: Graph,
    sources: FxHashMap<Symbol, Source>,
    values: FxHashMap<symbolic::Id, Scaled>,
}

impl<'m, 'd> Lowering<'m, 'd> {
    fn new(model: &'m Model<'d>) -> Self {
        Lowering {
            model,
            graph: Graph::new(),
            sources: sources(model),
            values: FxHashMap::default(),
        }
    }

    /// Brings the expressions and all their parts into the graph.
    fn lower(&mut self, roots: &[Expr<'d>]) {
        for id in reachable(self.model.dag, roots) {
            if !self.values.contains_key(&id) {
                let value = self.node(&self.model.dag.node(id));
                self.values.insert(id, value);
            }
        }
    }

    /// Lets symbols stand for values that are computed once.
    fn name(&mut self, names: &[(Expr<'d>, Expr<'d>)]) {
        for (name, meaning) in names {
            self.lower(&[*meaning]);
            let whole = self.graph.whole(self.values[&meaning.id()]);
            self.values.insert(name.id(), whole);
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

    /// M and f, if both are there.
    fn system(&self, quantities: &[Quantity<'d>]) -> Option<(Vec<Scaled>, Vec<Scaled>)> {
        let values = |role| {
            let quantity = quantities.iter().find(|quantity| quantity.role == role)?;
            Some(self.values(&quantity.values))
        };
        Some((values(Role::MassMatrix)?, values(Role::Forces)?))
    }

    fn values(&self, expressions: &[Expr<'d>]) -> Vec<Scaled> {
        expressions
            .iter()
            .map(|expression| self.values[&expression.id()])
            .collect()
    }
}

/// A function before its code is written.
struct Planned {
    role: Role,
    shape: Shape,
    results: Vec<Scaled>,
    pivots: Vec<Pivot>,
}

/// A function of which it is not yet decided whether it is taken.
struct Draft {
    form: Form,
    function: Function,
    /// The nodes that its `Read(Prepared(k))` stand for.
    prepared: Vec<Id>,
    /// Pivots that parameters alone decide.
    known_pivots: Vec<Pivot>,
}

impl Draft {
    fn is_same(&self, other: &Draft) -> bool {
        self.function == other.function && self.prepared == other.prepared
    }
}

impl Planned {
    /// The function in the ways that there are: common pairs shared, and before that, factors taken
    /// out of sums.
    fn drafts(self, graph: &mut Graph, basis: Basis) -> Vec<Draft> {
        let net = self.net(graph, true);
        let mut factored = net.clone();
        let has_factors = factored.factor();
        let mut drafts = vec![self.draft(net, basis, false)];
        if has_factors {
            drafts.push(self.draft(factored, basis, true));
        }
        drafts
    }

    /// The function without a choice, of parameters.
    fn only(self, graph: &mut Graph) -> Draft {
        let net = self.net(graph, false);
        self.draft(net, Basis::Derived, false)
    }

    fn net(&self, graph: &mut Graph, cut: bool) -> Net {
        let guarded = self.pivots.iter().flat_map(|p| [p.pivot, p.scale]);
        let roots: Vec<(Id, bool)> = self
            .results
            .iter()
            .copied()
            .chain(guarded)
            .map(|x| match cut && x.negative && x.factor != Id::ONE {
                // A sign is prepared with the value that it belongs to.
                true => {
                    let x = graph.with_signed_factor(x);
                    (graph.unsigned(x), false)
                }
                false => (graph.unsigned(x), x.negative),
            })
            .collect();
        Net::new(graph, &roots, cut)
    }

    fn draft(&self, mut net: Net, basis: Basis, factored: bool) -> Draft {
        net.share_pairs();
        let Code {
            code,
            roots,
            prepared,
        } = schedule(&net);
        let (results, guarded) = roots.split_at(self.results.len());
        let n = self.shape.order();
        let guards = self
            .pivots
            .iter()
            .zip(guarded.chunks_exact(2))
            .map(|(p, values)| Guard {
                pivot: values[0],
                scale: values[1],
                tolerance: solve::pivot_tolerance(n),
                coordinate: p.coordinate,
            })
            .collect();
        Draft {
            form: Form {
                role: self.role,
                basis,
                factored,
            },
            function: Function {
                role: self.role,
                code,
                shape: self.shape,
                results: results.to_vec(),
                guards,
            },
            prepared,
            known_pivots: Vec::new(),
        }
    }
}

/// The one that is chosen, and the record of the choice if there was one.
fn taken(
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

/// What rounding does to the results of each draft, what is prepared for it included.
fn roundings(drafts: &[&Draft], graph: &Graph, states: &States) -> Option<Vec<Rounding>> {
    let all = drafts.iter().flat_map(|draft| draft.prepared.iter());
    let mut ids: Vec<Id> = all.copied().collect();
    ids.sort_unstable();
    ids.dedup();
    let roots: Vec<(Id, bool)> = ids.iter().map(|&id| (id, false)).collect();
    let Code { code, roots, .. } = schedule(&Net::new(graph, &roots, false));
    let prepare = Function {
        role: Role::Prepare,
        code,
        shape: Shape::Vector(roots.len()),
        results: roots,
        guards: Vec::new(),
    };
    let reading = drafts.iter().map(|draft| {
        let place = |id: &Id| ids.binary_search(id).unwrap_or(0);
        let prepared = draft.prepared.iter().map(place).collect();
        (&draft.function, prepared)
    });
    let functions: Vec<(&Function, Vec<usize>)> = reading.collect();
    states.roundings(&prepare, &functions)
}

/// A quantity as it was derived and multiplied out.
fn of_quantity<'d>(
    lowering: &mut Lowering<'_, 'd>,
    quantity: &Quantity<'d>,
    expanded: &[Quantity<'d>],
) -> Vec<Draft> {
    let planned = |values: &[Expr<'d>], lowering: &Lowering<'_, 'd>| Planned {
        role: quantity.role,
        shape: quantity.shape,
        results: lowering.values(values),
        pivots: Vec::new(),
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

/// The accelerations from the mass matrix, and along the machine.
fn accelerations<'d>(lowering: &mut Lowering<'_, 'd>, source: Origin<'_, 'd>) -> Vec<Draft> {
    let Some((matrix, forces)) = lowering.system(source.quantities) else {
        return Vec::new();
    };
    let mut systems = vec![(Basis::Derived, matrix, forces)];
    let expanded = lowering
        .system(source.expanded)
        .filter(|(m, f)| *m != systems[0].1 || *f != systems[0].2);
    systems.extend(expanded.map(|(matrix, forces)| (Basis::Expanded, matrix, forces)));
    let mut drafts = Vec::new();
    for basis in [Basis::Along, Basis::Ahead] {
        if let Some(machine) = source.unprojected {
            drafts.extend(along_the_machine(lowering, &systems[0].1, machine, basis));
        }
    }
    let shortest = drafts
        .iter()
        .map(|draft| draft.function.counts().ops())
        .min();
    for (basis, matrix, forces) in systems {
        let elimination = Elimination::of(&matrix, forces.len());
        // What is certainly longer is not even written down: it grows with the cube of the number
        // of coordinates.
        if shortest.is_some_and(|ops| elimination.multiplications > ops) {
            continue;
        }
        let solution = solve::solve(&mut lowering.graph, &matrix, &forces, elimination);
        drafts.extend(solved(&mut lowering.graph, solution, basis));
    }
    drafts
}

/// The accelerations with their derivatives, if any are asked for: from the equations that the
/// accelerations were taken from.
fn derivatives<'d>(
    lowering: &mut Lowering<'_, 'd>,
    source: Origin<'_, 'd>,
    accelerations: &Draft,
) -> Option<Draft> {
    let (quantities, unprojected) = match accelerations.form.basis {
        Basis::Expanded => (source.expanded, None),
        Basis::Derived | Basis::Along | Basis::Ahead => (source.quantities, source.unprojected),
    };
    let slopes = (source.slopes)(accelerations.form.basis);
    let (matrix, forces) = lowering.system(quantities)?;
    let asked = derivatives::Asked {
        matrix: &matrix,
        forces: &forces,
        unprojected,
        slopes: &slopes,
        known_pivots: &accelerations.known_pivots,
    };
    (!slopes.is_empty()).then(|| derivatives::derivatives(lowering, &asked))
}

/// The programs of a solution; pivots that parameters alone decide are kept apart.
fn solved(graph: &mut Graph, solution: Solution, basis: Basis) -> Vec<Draft> {
    let known = |p: &Pivot| p.pivot.is_known() && p.scale.is_known();
    let (known_pivots, pivots): (Vec<Pivot>, Vec<Pivot>) =
        solution.pivots.into_iter().partition(known);
    let planned = Planned {
        role: Role::Accelerations,
        shape: Shape::Vector(solution.accelerations.len()),
        results: solution.accelerations,
        pivots,
    };
    let mut drafts = planned.drafts(graph, basis);
    for draft in &mut drafts {
        draft.known_pivots.clone_from(&known_pivots);
    }
    drafts
}

/// The accelerations by [`articulated::solve`].
fn along_the_machine<'d>(
    lowering: &mut Lowering<'_, 'd>,
    matrix: &[Scaled],
    machine: &Unprojected<'d>,
    basis: Basis,
) -> Vec<Draft> {
    let order = match basis {
        Basis::Ahead => Order::Ahead,
        _ => Order::Short,
    };
    let Some(articulated::Solution {
        accelerations,
        pivots,
        names,
        ..
    }) = articulated::solve(lowering.model, machine, order)
    else {
        return Vec::new();
    };
    lowering.name(&names);
    let values: Vec<Expr<'d>> = pivots.iter().map(|(_, pivot)| *pivot).collect();
    lowering.lower(&accelerations);
    lowering.lower(&values);
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
            columns: Vec::new(),
        };
        solved(&mut lowering.graph, solution, basis)
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
    let is_cheap = 100 * ops(&full) <= (100 + DEAREST_GUARDS) * ops(&lean);
    if is_cheap { full } else { lean }
}

/// Of a machine's diagonal entries of M, against which its pivots are held, the most that they may
/// cost, in percent of the rest. Where they are not at hand, as in a chain in relative angles, a
/// pivot need only be positive.
const DEAREST_GUARDS: usize = 10;

/// The function that computes what the others read, the formulas of its results, and the others
/// with their final indices.
fn prepare(
    graph: &mut Graph,
    drafts: Vec<Draft>,
    model: &Model<'_>,
) -> (Function, Vec<String>, Vec<Function>) {
    let mut ids: Vec<Id> = drafts
        .iter()
        .flat_map(|draft| draft.prepared.iter().copied())
        .collect();
    ids.sort_unstable();
    ids.dedup();
    let index_of: FxHashMap<Id, u32> = ids
        .iter()
        .zip(0..)
        .map(|(&id, index)| (id, index))
        .collect();
    let mut pivots = Vec::new();
    let functions = drafts
        .into_iter()
        .map(|draft| {
            pivots.extend(draft.known_pivots);
            let (mut function, prepared) = (draft.function, draft.prepared);
            for op in &mut function.code {
                if let Op::Read(Source::Prepared(index)) = op {
                    *index = index_of[&prepared[*index as usize]];
                }
            }
            function
        })
        .collect();
    let formulas = ids
        .iter()
        .map(|&factor| {
            formula(
                graph,
                Scaled {
                    negative: false,
                    factor,
                    core: Id::ONE,
                },
                model,
            )
        })
        .collect();
    let planned = Planned {
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
    };
    let mut prepare = planned.only(graph).function;
    for guard in &mut prepare.guards {
        guard.tolerance = solve::pivot_tolerance(model.coordinates.len());
    }
    (prepare, formulas, functions)
}

/// Where the symbols of a model come from.
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
        lowering.model,
    );
    Default { value, text }
}
