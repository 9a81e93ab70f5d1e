//! Derivatives of programs, as programs: the chain rule, applied to each operation.
//!
//! A [tangent](Program::tangent) is a program with twice as many arguments: the parameters are followed by their changes, the
//! coordinates by theirs, and so on; in the results the accelerations are followed by their changes. An
//! [adjoint](Program::adjoint) goes through the same operations in reverse and gives the derivatives of one number by all
//! arguments at once, at the cost of a few evaluations, independently of the number of arguments. A. Griewank and A. Walther,
//! *Evaluating Derivatives*, 2nd ed., SIAM 2008, chapter 3.
//!
//! Both are converted to a [`Graph`] again, so that values of parameters alone are prepared, and common parts are found. A
//! rounding error ([`Op::ProductError`]) has no derivative; phases are written anew with errors of their own.

use std::collections::BTreeMap;

use lagrangian_symbolic::sorting::sort_by_key;
use lagrangian_symbolic::{Function as Call, Rational};
use lagrangian_units::{Name, Stages};

use super::graph::{Graph, Id, Scaled};
use super::net::Net;
use super::schedule::{Code, LARGEST_FACTORED, prepared, schedule};
use super::{Function, Guard, Op, Program, Role, Shape, Slot, Source, Value};

impl Program {
    /// The changes of accelerations, outputs and the start under changes of parameters, coordinates, rates and inputs.
    ///
    /// Its parameters, coordinates, rates, accelerations and inputs are those of this program, each followed by their changes.
    /// [`Role::Accelerations`] and [`Role::Start`] give values and changes; [`Role::Output`] gives the change of that output,
    /// given the accelerations and their changes. Time does not change.
    pub fn tangent(&self) -> Program {
        let mut lift = Differentiation::new(self);
        let start = lift.values(&self.start);
        let start_changes = lift.changes(&self.start, &start);
        let n = self.dimension().max(1);
        let mut results = Vec::new();
        for block in self.start.results.chunks(n) {
            results.extend(block.iter().map(|x| start[x.index()]));
            results.extend(block.iter().map(|x| start_changes[x.index()]));
        }
        let (start, _) = lift.function(Part::new(Role::Start, results), false);
        let mut parts = Vec::new();
        for function in self.functions.iter().filter(|f| is_differentiated(f.role)) {
            let values = lift.values(function);
            let changes = lift.changes(function, &values);
            let of = |list: &[Scaled]| -> Vec<Scaled> {
                let results = function.results.iter();
                results.map(|x| list[x.index()]).collect()
            };
            let mut part = Part::new(function.role, of(&changes));
            if function.role == Role::Accelerations {
                part = Part::new(function.role, [of(&values), of(&changes)].concat());
                part.guards = lift.guards(function, &values, self.dimension());
            }
            if let Role::Output(_) = function.role {
                part.shape = Shape::Scalar;
            }
            parts.push(part);
        }
        let docs = format!(
            "What the accelerations and outputs of `{}` change by where its arguments change.",
            self.name
        );
        let doubled = |slots: &[Slot]| -> Vec<Slot> {
            let changes = slots.iter().map(change_of);
            slots.iter().cloned().chain(changes).collect()
        };
        let shape = Program {
            name: format!("{}Tangent", self.name),
            docs,
            parameters: doubled(&self.parameters),
            coordinates: doubled(&self.coordinates),
            inputs: doubled(&self.inputs),
            outputs: self.outputs.iter().map(change_of).collect(),
            ..self.without_functions()
        };
        lift.assemble(shape, start, parts, self.dimension())
    }

    /// The derivatives of accelerations and outputs in reverse mode.
    ///
    /// Its inputs are those of this program, followed by a weight for each acceleration. [`Role::Adjoint`] gives the
    /// derivatives of the weighted sum of the accelerations by all coordinates, rates, parameters and inputs;
    /// [`Role::Gradient`] those of an output by the same and by the accelerations.
    pub fn adjoint(&self) -> Program {
        let mut lift = Differentiation::new(self);
        let mut parts = Vec::new();
        let inputs = self.inputs.len() as u32;
        for function in self.functions.iter().filter(|f| is_differentiated(f.role)) {
            let values = lift.values(function);
            let seeds: Vec<Scaled> = match function.role {
                Role::Output(_) => vec![lift.graph.constant(&Rational::ONE)],
                _ => {
                    let weights =
                        (0..function.results.len() as u32).map(|i| Source::Input(inputs + i));
                    weights.map(|source| lift.graph.read(source)).collect()
                }
            };
            let results = lift.gradient(function, &values, &seeds);
            parts.push(match function.role {
                Role::Output(i) => Part::new(Role::Gradient(i), results),
                _ => Part {
                    guards: lift.guards(function, &values, 0),
                    ..Part::new(
                        Role::Adjoint,
                        results[..results.len() - self.dimension()].to_vec(),
                    )
                },
            });
        }
        sort_by_key(&mut parts, |part| part.role);
        let weights = self.coordinates.iter().map(|slot| Slot {
            name: with_prefix(&slot.name, "weight_"),
            docs: format!("The weight of the acceleration of `{}`.", slot.name),
            ..change_of(slot)
        });
        let shape = Program {
            name: format!("{}Adjoint", self.name),
            docs: format!(
                "Derivatives of accelerations and outputs of `{}`, backwards.",
                self.name
            ),
            inputs: self.inputs.iter().cloned().chain(weights).collect(),
            ..self.without_functions()
        };
        lift.assemble(shape, self.start.clone(), parts, 0)
    }

    /// The arguments of this machine, without any functions.
    fn without_functions(&self) -> Program {
        Program {
            quaternions: Vec::new(),
            assumptions: Vec::new(),
            contacts: Vec::new(),
            reaction_axes: 1,
            second_tangents: 0,
            unilateral: Vec::new(),
            kept: Vec::new(),
            derivatives: Vec::new(),
            stages: Stages::default(),
            ..self.with_functions(|_| false)
        }
    }
}

/// Whether functions of this role are differentiated.
pub fn is_differentiated(role: Role) -> bool {
    matches!(role, Role::Accelerations | Role::Output(_))
}

/// The change of a number, as an argument or an output.
fn change_of(slot: &Slot) -> Slot {
    Slot {
        name: with_prefix(&slot.name, "d_"),
        docs: format!("What `{}` changes by.", slot.name),
        default: None,
        ..slot.clone()
    }
}

fn with_prefix(name: &Name, prefix: &str) -> Name {
    Name {
        base: format!("{prefix}{}", name.base),
        ..name.clone()
    }
}

/// A function before its code is written.
struct Part {
    role: Role,
    shape: Shape,
    results: Vec<Scaled>,
    guards: Vec<Pivot>,
}

impl Part {
    fn new(role: Role, results: Vec<Scaled>) -> Part {
        Part {
            role,
            shape: Shape::Vector(results.len()),
            results,
            guards: Vec::new(),
        }
    }
}

/// A guard, by its values.
struct Pivot {
    values: [Scaled; 2],
    tolerance: f64,
    coordinate: usize,
}

/// The change of a value with its operands: `Σ slope·change / divisor`.
struct Slopes {
    by: [Option<(Value, Scaled)>; 2],
    divisor: Option<Scaled>,
}

/// Converts a program to its derivatives.
struct Differentiation<'p> {
    program: &'p Program,
    graph: Graph,
    /// The value of each operation of `prepare`.
    prepare_values: Vec<Scaled>,
    /// The change of each prepared value.
    prepared_changes: Vec<Scaled>,
}

impl<'p> Differentiation<'p> {
    fn new(program: &'p Program) -> Differentiation<'p> {
        let mut lift = Differentiation {
            program,
            graph: Graph::default(),
            prepare_values: Vec::new(),
            prepared_changes: Vec::new(),
        };
        lift.prepare_values = lift.values(&program.prepare);
        let values = std::mem::take(&mut lift.prepare_values);
        let changes = lift.changes(&program.prepare, &values);
        let results = program.prepare.results.iter();
        lift.prepared_changes = results.map(|x| changes[x.index()]).collect();
        lift.prepare_values = values;
        lift
    }

    /// The values of all operations of a function. Values that are used several times stay whole.
    fn values(&mut self, function: &Function) -> Vec<Scaled> {
        let is_shared = shared(function);
        let mut values: Vec<Scaled> = Vec::with_capacity(function.code.len());
        for (index, op) in function.code.iter().enumerate() {
            let x = |value: Value| values[value.index()];
            let graph = &mut self.graph;
            let value = match *op {
                Op::Constant(ref value) => graph.constant(value),
                Op::Pi => graph.pi(),
                Op::Read(Source::Prepared(i)) => {
                    self.prepare_values[self.program.prepare.results[i as usize].index()]
                }
                Op::Read(source) => graph.read(source),
                Op::Add(a, b) => graph.sum(&[x(a), x(b)]),
                Op::Sub(a, b) => graph.sum(&[x(a), x(b).negated()]),
                Op::Mul(a, b) => graph.product(&[(x(a), 1), (x(b), 1)]),
                Op::Div(a, b) => graph.quotient(x(a), x(b)),
                Op::Neg(a) => x(a).negated(),
                Op::ProductError(..) | Op::SumError(..) => Scaled::ZERO,
                Op::Sin(a) => graph.function(Call::Sin, &[x(a)]),
                Op::Cos(a) => graph.function(Call::Cos, &[x(a)]),
                Op::Unary(call, a) => graph.function(call, &[x(a)]),
                Op::Binary(call, a, b) => graph.function(call, &[x(a), x(b)]),
            };
            values.push(if is_shared[index] {
                self.graph.opaque(value)
            } else {
                value
            });
        }
        values
    }

    /// The changes of all operations of a function.
    fn changes(&mut self, function: &Function, values: &[Scaled]) -> Vec<Scaled> {
        let is_shared = shared(function);
        let mut changes: Vec<Scaled> = Vec::with_capacity(function.code.len());
        for (index, op) in function.code.iter().enumerate() {
            let change = match *op {
                Op::Read(Source::Prepared(i)) => self.prepared_changes[i as usize],
                Op::Read(source) => match self.change_argument(source) {
                    Some(change) => self.graph.read(change),
                    None => Scaled::ZERO,
                },
                _ => {
                    let slopes = self.slopes(op, Value(index as u32), values);
                    let by = slopes.by.into_iter().flatten();
                    let by = by.filter(|(operand, _)| !changes[operand.index()].is_zero());
                    let by: Vec<(Value, Scaled)> = by.collect();
                    let terms = by.into_iter().map(|(operand, slope)| {
                        self.graph
                            .product(&[(slope, 1), (changes[operand.index()], 1)])
                    });
                    let terms: Vec<Scaled> = terms.collect();
                    let sum = self.graph.sum(&terms);
                    self.divided(sum, slopes.divisor)
                }
            };
            changes.push(if is_shared[index] {
                self.graph.opaque(change)
            } else {
                change
            });
        }
        changes
    }

    /// The argument that holds the change of an argument; time has none.
    fn change_argument(&self, source: Source) -> Option<Source> {
        let n = self.program.dimension() as u32;
        Some(match source {
            Source::Parameter(i) => Source::Parameter(self.program.parameters.len() as u32 + i),
            Source::Coordinate(i) => Source::Coordinate(n + i),
            Source::Velocity(i) => Source::Velocity(n + i),
            Source::Acceleration(i) => Source::Acceleration(n + i),
            Source::Input(i) => Source::Input(self.program.inputs.len() as u32 + i),
            Source::Time | Source::Prepared(_) | Source::AtTime(_) | Source::AtPosition(_) => {
                return None;
            }
        })
    }

    /// The derivatives of `Σ seed·result` by coordinates, rates, parameters, inputs and accelerations.
    fn gradient(
        &mut self,
        function: &Function,
        values: &[Scaled],
        seeds: &[Scaled],
    ) -> Vec<Scaled> {
        let mut by = BTreeMap::new();
        let seeded = function.results.iter().copied().zip(seeds.iter().copied());
        self.reverse_sweep(function, values, seeded.collect(), &mut by);
        let prepared = self.program.prepare.results.iter().zip(0..);
        let seeds =
            prepared.filter_map(|(x, i)| Some((*x, self.sum_of(&mut by, Source::Prepared(i))?)));
        let seeds: Vec<(Value, Scaled)> = seeds.collect();
        let prepare_values = std::mem::take(&mut self.prepare_values);
        self.reverse_sweep(&self.program.prepare, &prepare_values, seeds, &mut by);
        self.prepare_values = prepare_values;
        let (n, program) = (self.program.dimension() as u32, self.program);
        let all = (0..n).map(Source::Coordinate);
        let all = all.chain((0..n).map(Source::Velocity));
        let all = all.chain((0..program.parameters.len() as u32).map(Source::Parameter));
        let all = all.chain((0..program.inputs.len() as u32).map(Source::Input));
        let all = all.chain((0..n).map(Source::Acceleration));
        all.map(|source| self.sum_of(&mut by, source).unwrap_or(Scaled::ZERO))
            .collect()
    }

    fn sum_of(&mut self, by: &mut BTreeMap<Source, Vec<Scaled>>, source: Source) -> Option<Scaled> {
        let terms = by.remove(&source)?;
        Some(self.graph.sum(&terms))
    }

    /// Adds to `by` the derivatives of a weighted sum of a function's values with respect to its arguments.
    fn reverse_sweep(
        &mut self,
        function: &Function,
        values: &[Scaled],
        weights: Vec<(Value, Scaled)>,
        by: &mut BTreeMap<Source, Vec<Scaled>>,
    ) {
        let mut terms: Vec<Vec<Scaled>> = vec![Vec::new(); function.code.len()];
        for (value, weight) in weights {
            terms[value.index()].push(weight);
        }
        for (index, op) in function.code.iter().enumerate().rev() {
            let weight = self.graph.sum(&std::mem::take(&mut terms[index]));
            if weight.is_zero() {
                continue;
            }
            if let Op::Read(source) = op {
                by.entry(*source).or_default().push(weight);
                continue;
            }
            let slopes = self.slopes(op, Value(index as u32), values);
            let weight = self.divided(weight, slopes.divisor);
            // It goes to several operands, or to sums.
            let weight = self.graph.opaque(weight);
            for (operand, slope) in slopes.by.into_iter().flatten() {
                let term = self.graph.product(&[(slope, 1), (weight, 1)]);
                terms[operand.index()].push(term);
            }
        }
    }

    fn divided(&mut self, x: Scaled, divisor: Option<Scaled>) -> Scaled {
        match divisor {
            Some(divisor) if !x.is_zero() => self.graph.quotient(x, divisor),
            _ => x,
        }
    }

    /// The derivatives of an operation by its operands.
    fn slopes(&mut self, op: &Op, value: Value, values: &[Scaled]) -> Slopes {
        let x = |value: Value| values[value.index()];
        let graph = &mut self.graph;
        let one = graph.constant(&Rational::ONE);
        let (mut by, mut divisor) = ([None, None], None);
        match *op {
            Op::Constant(_) | Op::Pi | Op::Read(_) => {}
            Op::ProductError(..) | Op::SumError(..) => {}
            Op::Add(a, b) => by = [Some((a, one)), Some((b, one))],
            Op::Sub(a, b) => by = [Some((a, one)), Some((b, one.negated()))],
            Op::Mul(a, b) => by = [Some((a, x(b))), Some((b, x(a)))],
            Op::Div(a, b) => {
                by = [Some((a, one)), Some((b, x(value).negated()))];
                divisor = Some(x(b));
            }
            Op::Neg(a) => by[0] = Some((a, one.negated())),
            Op::Sin(a) => by[0] = Some((a, graph.function(Call::Cos, &[x(a)]))),
            Op::Cos(a) => by[0] = Some((a, graph.function(Call::Sin, &[x(a)]).negated())),
            Op::Unary(call, a) => {
                let (slope, under) = slope(graph, call, x(a), x(value));
                by[0] = Some((a, slope));
                divisor = under;
            }
            Op::Binary(call, a, b) => {
                let (slopes, under) = self.slopes_of_two(call, [x(a), x(b)], x(value));
                by = [Some((a, slopes[0])), Some((b, slopes[1]))];
                divisor = under;
            }
        }
        Slopes { by, divisor }
    }

    /// The derivatives of a function of two arguments, and their common divisor.
    fn slopes_of_two(
        &mut self,
        call: Call,
        [a, b]: [Scaled; 2],
        value: Scaled,
    ) -> ([Scaled; 2], Option<Scaled>) {
        let graph = &mut self.graph;
        let one = graph.constant(&Rational::ONE);
        match call {
            Call::Atan2 => {
                let squares = [graph.product(&[(a, 2)]), graph.product(&[(b, 2)])];
                ([b, a.negated()], Some(graph.sum(&squares)))
            }
            // The mean of both if the arguments are equal, as for dual numbers.
            Call::Min | Call::Max => {
                let difference = graph.sum(&[a, b.negated()]);
                let sign = graph.function(Call::Sign, &[difference]);
                let two = graph.constant(&Rational::from(2));
                let one_more = graph.sum(&[one, sign]);
                let one_less = graph.sum(&[one, sign.negated()]);
                let slopes = match call {
                    Call::Max => [one_more, one_less],
                    _ => [one_less, one_more],
                };
                (slopes, Some(two))
            }
            Call::Pow => {
                let below = graph.sum(&[b, one.negated()]);
                let power = graph.function(Call::Pow, &[a, below]);
                let by_base = graph.product(&[(b, 1), (power, 1)]);
                let logarithm = graph.function(Call::Ln, &[a]);
                let by_exponent = graph.product(&[(value, 1), (logarithm, 1)]);
                ([by_base, by_exponent], None)
            }
            call => unreachable!("{call:?} has one argument"),
        }
    }

    /// The guards of a function; the indices of constraints are moved by `further` additional coordinates.
    fn guards(&self, function: &Function, values: &[Scaled], further: usize) -> Vec<Pivot> {
        let n = self.program.dimension();
        let guards = function.guards.iter().map(|guard| Pivot {
            values: [guard.pivot, guard.scale].map(|x| values[x.index()]),
            tolerance: guard.tolerance,
            coordinate: if guard.coordinate < n {
                guard.coordinate
            } else {
                guard.coordinate + further
            },
        });
        guards.collect()
    }

    /// The program of the parts, with the arguments of `shape`.
    fn assemble(
        mut self,
        shape: Program,
        start: Function,
        parts: Vec<Part>,
        further: usize,
    ) -> Program {
        let functions: Vec<(Function, Vec<Id>)> = parts
            .into_iter()
            .map(|part| self.function(part, true))
            .collect();
        let names = &shape.parameters;
        let name = |source: Source| match source {
            Source::Parameter(i) => names[i as usize].name.to_string(),
            _ => unreachable!("parameters alone are prepared"),
        };
        let (ids, formulas, functions) = prepared(&mut self.graph, functions, &name);
        let known = |factor: Id| Scaled {
            negative: false,
            factor,
            core: Id::ONE,
        };
        let prepare_values = std::mem::take(&mut self.prepare_values);
        let mut prepare = Part::new(Role::Prepare, ids.into_iter().map(known).collect());
        prepare.guards = self.guards(&self.program.prepare, &prepare_values, further);
        let (prepare, _) = self.function(prepare, false);
        let program = Program {
            prepared: formulas,
            prepare,
            start,
            functions,
            ..shape
        };
        debug_assert_eq!(program.verify(), Ok(()));
        program
    }

    /// The code of a part, the shorter of two forms; with `cut`, values of parameters alone are arguments, and are returned.
    fn function(&mut self, part: Part, cut: bool) -> (Function, Vec<Id>) {
        let guarded = part.guards.iter().flat_map(|pivot| pivot.values);
        let values: Vec<Scaled> = part.results.iter().copied().chain(guarded).collect();
        let net = Net::of_values(&mut self.graph, &values, cut);
        let mut factored = net.clone();
        let mut ways = vec![net];
        if cut && ways[0].size() <= LARGEST_FACTORED && factored.factor() {
            ways.push(factored);
        }
        let ways = ways.into_iter().map(|mut net| {
            net.share_pairs();
            let Code {
                code,
                roots,
                prepared,
                ..
            } = schedule(&net, cut.then_some(&mut self.graph));
            let (results, guarded) = roots.split_at(part.results.len());
            let guards = part.guards.iter().zip(guarded.chunks_exact(2));
            let guards = guards.map(|(pivot, values)| Guard {
                pivot: values[0],
                scale: values[1],
                tolerance: pivot.tolerance,
                coordinate: pivot.coordinate,
            });
            let function = Function {
                role: part.role,
                code,
                shape: part.shape,
                results: results.to_vec(),
                guards: guards.collect(),
                steps: Vec::new(),
            };
            (function, prepared)
        });
        let shortest = ways.min_by_key(|(function, _)| function.counts().ops());
        shortest.expect("there is a first way")
    }
}

/// For each operation whether its value is used more than once.
fn shared(function: &Function) -> Vec<bool> {
    let mut uses = vec![0u32; function.code.len()];
    let operands = function.code.iter().flat_map(Op::operands);
    for value in operands.chain(function.results.iter().copied()) {
        uses[value.index()] += 1;
    }
    uses.into_iter().map(|count| count > 1).collect()
}

/// The derivative of a function at `x`, given its value `y`, and its divisor.
fn slope(graph: &mut Graph, call: Call, x: Scaled, y: Scaled) -> (Scaled, Option<Scaled>) {
    let one = graph.constant(&Rational::ONE);
    let square = |graph: &mut Graph, x: Scaled| graph.product(&[(x, 2)]);
    match call {
        Call::Sin => (graph.function(Call::Cos, &[x]), None),
        Call::Cos => (graph.function(Call::Sin, &[x]).negated(), None),
        Call::Tan => {
            let square = square(graph, y);
            (graph.sum(&[one, square]), None)
        }
        Call::Asin | Call::Acos => {
            let factors = [graph.sum(&[one, x.negated()]), graph.sum(&[one, x])];
            let area = graph.product(&[(factors[0], 1), (factors[1], 1)]);
            let root = graph.function(Call::Sqrt, &[area]);
            let sign = match call {
                Call::Acos => one.negated(),
                _ => one,
            };
            (sign, Some(root))
        }
        Call::Atan => {
            let square = square(graph, x);
            (one, Some(graph.sum(&[one, square])))
        }
        Call::Sinh => (graph.function(Call::Cosh, &[x]), None),
        Call::Cosh => (graph.function(Call::Sinh, &[x]), None),
        // This form does not cancel if tanh is close to 1.
        Call::Tanh => {
            let cosh = graph.function(Call::Cosh, &[x]);
            (one, Some(square(graph, cosh)))
        }
        Call::Exp => (y, None),
        Call::Ln => (one, Some(x)),
        Call::Sqrt => {
            let two = graph.constant(&Rational::from(2));
            (one, Some(graph.product(&[(two, 1), (y, 1)])))
        }
        Call::Abs => (graph.function(Call::Sign, &[x]), None),
        // Constant on either side.
        Call::Sign => (Scaled::ZERO, None),
        Call::Atan2 | Call::Min | Call::Max | Call::Pow => {
            unreachable!("{call:?} has two arguments")
        }
    }
}
