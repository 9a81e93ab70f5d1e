//! From expressions to programs.

mod derivatives;

use lagrangian_symbolic::{self as symbolic, Dag, Expr, Stage, Symbol, nearest, reachable};
use rustc_hash::FxHashMap;

use super::articulated;
use super::formula::formula;
use super::graph::{Graph, Id, Scaled};
use super::net::Net;
use super::schedule::{Code, schedule};
use super::solve::{self, Elimination, Pivot, Solution};
use super::{Counts, Default, Fact, Function, Guard, Op, Program, Role, Shape, Slot, Source};
use crate::mechanics::{Equations, Unprojected};
use crate::model::{Model, Name};
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
    /// The program of a machine: every function that [`Role`] names.
    pub fn lower<'d>(model: &Model<'d>, equations: &Equations<'d>) -> Program {
        let quantities = quantities(model, equations);
        let unprojected = equations.unprojected.as_ref();
        Program::build(
            model,
            &quantities,
            unprojected,
            &equations.slopes_in_forms(model),
        )
    }

    /// The program that computes the quantities.
    ///
    /// If a mass matrix and forces are among them, there are accelerations too.
    pub fn of_quantities<'d>(model: &Model<'d>, quantities: &[Quantity<'d>]) -> Program {
        Program::build(model, quantities, None, &[])
    }

    fn build<'d>(
        model: &Model<'d>,
        quantities: &[Quantity<'d>],
        unprojected: Option<&Unprojected<'d>>,
        slopes: &[Vec<Vec<Expr<'d>>>],
    ) -> Program {
        let mut quantities = quantities.to_vec();
        if let Some(machine) = unprojected {
            shorten_mass_matrix(model, machine, &mut quantities);
        }
        let quantities = &quantities;
        let roots: Vec<Expr<'d>> = quantities
            .iter()
            .flat_map(|quantity| quantity.values.iter().copied())
            .collect();
        let mut starts: Vec<Expr<'d>> = model.coordinates.iter().map(|c| c.start).collect();
        if model.coordinates.iter().any(|c| !c.start_rate.is_zero()) {
            starts.extend(model.coordinates.iter().map(|c| c.start_rate));
        }
        let mut lowering = Lowering::new(model);
        lowering.lower(&roots);
        lowering.lower(&starts);
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

        let planned: Vec<Planned> = quantities
            .iter()
            .map(|quantity| Planned {
                role: quantity.role,
                shape: quantity.shape,
                results: lowering.values(&quantity.values),
                pivots: Vec::new(),
            })
            .collect();
        let start = Planned {
            role: Role::Start,
            shape: Shape::Vector(starts.len()),
            results: lowering.values(&starts),
            pivots: Vec::new(),
        };
        let start = start.function(&mut lowering.graph, false).0;
        let results = |role| {
            planned
                .iter()
                .find(|p| p.role == role)
                .map(|p| p.results.clone())
        };
        let mut functions: Vec<(Function, Vec<Id>)> = planned
            .iter()
            .map(|p| p.function(&mut lowering.graph, true))
            .collect();
        let mut known_pivots = Vec::new();
        if let (Some(matrix), Some(forces)) = (results(Role::MassMatrix), results(Role::Forces)) {
            let accelerations = accelerations(&mut lowering, &matrix, &forces, unprojected);
            known_pivots = accelerations.known_pivots;
            functions.push(accelerations.function);
            if !slopes.is_empty() {
                let asked = derivatives::Asked {
                    matrix: &matrix,
                    forces: &forces,
                    unprojected,
                    slopes,
                    known_pivots: &known_pivots,
                };
                functions.push(derivatives::derivatives(&mut lowering, &asked));
            }
        }
        functions.sort_by_key(|(function, _)| function.role);
        let graph = &mut lowering.graph;
        let (prepare, prepared, functions) = prepare(graph, functions, known_pivots, model);
        let program = Program {
            name: model.name.clone(),
            docs: model.docs.clone(),
            parameters,
            coordinates,
            inputs,
            outputs,
            assumptions: facts(model),
            derivatives: match slopes.is_empty() {
                true => Vec::new(),
                false => model.derivatives.clone(),
            },
            prepare,
            prepared,
            start,
            functions,
        };
        debug_assert_eq!(program.verify(), Ok(()));
        program
    }
}

/// What there is to compute of a machine, in the order of [`Role`]; accelerations follow from it.
pub fn quantities<'d>(model: &Model<'d>, equations: &Equations<'d>) -> Vec<Quantity<'d>> {
    let n = model.coordinates.len();
    let scalar = |role, value| Quantity {
        role,
        shape: Shape::Scalar,
        values: vec![value],
    };
    let vector = |role, values: &[Expr<'d>]| Quantity {
        role,
        shape: Shape::Vector(n),
        values: values.to_vec(),
    };
    let mut quantities = vec![
        Quantity {
            role: Role::MassMatrix,
            shape: Shape::Symmetric(n),
            values: equations.mass_matrix.lower().to_vec(),
        },
        vector(Role::Bias, &equations.bias),
        vector(Role::Applied, &equations.applied),
        vector(Role::Forces, &equations.forces),
        scalar(Role::KineticEnergy, equations.kinetic_energy),
        scalar(Role::PotentialEnergy, equations.potential_energy),
        scalar(Role::Dissipation, equations.dissipation),
        scalar(Role::WorkRate, equations.work_rate),
        scalar(Role::DissipationRate, equations.dissipation_rate),
    ];
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

impl Planned {
    /// The function, and the nodes that its `Read(Prepared(k))` stand for.
    fn function(&self, graph: &mut Graph, cut: bool) -> (Function, Vec<Id>) {
        let guarded = self.pivots.iter().flat_map(|p| [p.pivot, p.scale]);
        let roots: Vec<(Id, bool)> = self
            .results
            .iter()
            .copied()
            .chain(guarded)
            .map(|x| match cut && x.negative && x.is_known() {
                // A sign is prepared with the value that it belongs to.
                true => (graph.signed(x), false),
                false => (graph.unsigned(x), x.negative),
            })
            .collect();
        let mut net = Net::new(graph, &roots, cut);
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
        let function = Function {
            role: self.role,
            code,
            shape: self.shape,
            results: results.to_vec(),
            guards,
        };
        (function, prepared)
    }
}

/// The function that computes the accelerations.
struct Accelerations {
    function: (Function, Vec<Id>),
    /// Pivots that parameters alone decide.
    known_pivots: Vec<Pivot>,
}

impl Accelerations {
    fn new(graph: &mut Graph, solution: Solution) -> Accelerations {
        let known = |p: &Pivot| p.pivot.is_known() && p.scale.is_known();
        let (known_pivots, pivots) = solution.pivots.into_iter().partition(known);
        let planned = Planned {
            role: Role::Accelerations,
            shape: Shape::Vector(solution.accelerations.len()),
            results: solution.accelerations,
            pivots,
        };
        Accelerations {
            function: planned.function(graph, true),
            known_pivots,
        }
    }

    fn counts(&self) -> Counts {
        self.function.0.counts()
    }
}

/// The accelerations by the way that is cheaper to run: from the mass matrix, or along the machine.
fn accelerations<'d>(
    lowering: &mut Lowering<'_, 'd>,
    matrix: &[Scaled],
    forces: &[Scaled],
    unprojected: Option<&Unprojected<'d>>,
) -> Accelerations {
    let along = unprojected.and_then(|machine| along_the_machine(lowering, matrix, machine));
    let elimination = Elimination::of(matrix, forces.len());
    let along = match along {
        // What is certainly longer is not even written down: it grows with the cube of the number
        // of coordinates.
        Some(along) if elimination.multiplications > along.counts().ops() => return along,
        other => other,
    };
    let by_matrix = solve::solve(&mut lowering.graph, matrix, forces, elimination);
    let by_matrix = Accelerations::new(&mut lowering.graph, by_matrix);
    match along {
        Some(along) if along.counts().cost() <= by_matrix.counts().cost() => along,
        _ => by_matrix,
    }
}

/// The accelerations by [`articulated::solve`].
fn along_the_machine<'d>(
    lowering: &mut Lowering<'_, 'd>,
    matrix: &[Scaled],
    machine: &Unprojected<'d>,
) -> Option<Accelerations> {
    let articulated::Solution {
        accelerations,
        pivots,
        ..
    } = articulated::solve(lowering.model, machine)?;
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
        Accelerations::new(&mut lowering.graph, solution)
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
    let is_cheap = 100 * full.counts().ops() <= (100 + DEAREST_GUARDS) * lean.counts().ops();
    Some(if is_cheap { full } else { lean })
}

/// Of a machine's diagonal entries of M, against which its pivots are held, the most that they may
/// cost, in percent of the rest. Where they are not at hand, as in a chain in relative angles, a
/// pivot need only be positive.
const DEAREST_GUARDS: usize = 10;

/// The function that computes what the others read, the formulas of its results, and the others
/// with their final indices.
fn prepare(
    graph: &mut Graph,
    functions: Vec<(Function, Vec<Id>)>,
    pivots: Vec<Pivot>,
    model: &Model<'_>,
) -> (Function, Vec<String>, Vec<Function>) {
    let mut ids: Vec<Id> = functions
        .iter()
        .flat_map(|(_, prepared)| prepared.iter().copied())
        .collect();
    ids.sort_unstable();
    ids.dedup();
    let index_of: FxHashMap<Id, u32> = ids
        .iter()
        .zip(0..)
        .map(|(&id, index)| (id, index))
        .collect();
    let functions = functions
        .into_iter()
        .map(|(mut function, prepared)| {
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
    let mut prepare = planned.function(graph, false).0;
    for guard in &mut prepare.guards {
        guard.tolerance = solve::pivot_tolerance(model.coordinates.len());
    }
    (prepare, formulas, functions)
}

/// Where the symbols of a model come from.
fn sources(model: &Model<'_>) -> FxHashMap<Symbol, Source> {
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
