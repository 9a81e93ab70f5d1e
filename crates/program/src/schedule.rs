//! Schedules the products and sums of a [`Net`] as operations, in an order that keeps waiting times
//! short and few values alive.
//!
//! The operands of a product of many factors, or of a sum of many terms, are combined in the order
//! in which they become known: the two that are known first are merged into one, and so on, as D.
//! A. Huffman's code merges the two rarest letters. So the result of a slow operation, such as a
//! sine or a quotient, passes through one operation and not through several; values known at the
//! same time form a balanced tree. No other order makes the result known earlier (M. C. Golumbic,
//! *Combinatorial merging*, IEEE Trans. Comput. C-25 (1976) 1164–1167).

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use lagrangian_symbolic::Rational;
use lagrangian_symbolic::sorting::sort_by_key;
use rustc_hash::FxHashMap;

use super::formula::formula;
use super::fusion::Contractions;
use super::graph::{Graph, Id, Node, Scaled};
use super::latency::latency;
use super::net::{Index, Item, Leaf, Net, Signed, TIME, operands};
use super::steps::{EliminationStep, is_labelled};
use super::{Function, Op, Role, Shape, Source, Value, stages};

/// The code of a function, with prepared values still identified by their nodes.
pub struct Code {
    /// The operations.
    pub code: Vec<Op>,
    /// The requested values, among them.
    pub roots: Vec<Value>,
    /// The nodes that `Read(Prepared(k))` refer to.
    pub prepared: Vec<Id>,
    /// The values that are steps of an elimination.
    pub steps: Vec<(Value, EliminationStep)>,
}

/// The largest number of operands of a function for which a second form is tried: beyond it, each
/// form takes a second.
pub const LARGEST_FACTORED: usize = 200_000;

/// Collects the prepared values that functions read: returns their nodes, their formulas, and the functions with the indices
/// of these; `name` gives the name of an argument.
pub fn prepared(
    graph: &mut Graph,
    functions: Vec<(Function, Vec<Id>)>,
    name: &dyn Fn(Source) -> String,
) -> (Vec<Id>, Vec<String>, Vec<Function>) {
    let all = functions.iter().flat_map(|(_, prepared)| prepared);
    let mut ids: Vec<Id> = all.copied().collect();
    ids.sort_unstable();
    ids.dedup();
    let index_of: FxHashMap<Id, u32> = ids.iter().copied().zip(0..).collect();
    let functions = functions.into_iter().map(|(mut function, prepared)| {
        for op in &mut function.code {
            if let Op::Read(Source::Prepared(index)) = op {
                *index = index_of[&prepared[*index as usize]];
            }
        }
        function
    });
    let functions = functions.collect();
    let formulas = ids.iter().map(|&factor| {
        let value = Scaled {
            negative: false,
            factor,
            core: Id::ONE,
        };
        formula(graph, value, name)
    });
    let formulas = formulas.collect();
    (ids, formulas, functions)
}

/// Writes the items as operations. If their graph is given, values that turn out to depend on
/// parameters alone become prepared values.
pub fn schedule(net: &Net, graph: Option<&mut Graph>) -> Code {
    let merged = merged(net);
    let mut builder = Builder {
        graph,
        ..Builder::default()
    };
    let mut value_of: Vec<Option<Value>> = vec![None; net.items.len()];
    for index in in_order(net, &merged) {
        value_of[index as usize] = Some(builder.item(net, index, &merged, &value_of));
    }
    let value = |index: Index| value_of[index as usize].expect("operands come first");
    let roots: Vec<Value> = net
        .roots
        .iter()
        .map(|&(index, negative)| {
            if negative {
                builder.negative(value(index))
            } else {
                value(index)
            }
        })
        .collect();
    let (code, roots, first) = reorder(&builder.code, &roots);
    let (code, roots, second) = by_time(code, roots);
    let place = |index: Index| {
        let place = first[value_of[index as usize]?.index()]?;
        second[place.index()]
    };
    let steps = net.steps.iter();
    let steps = steps.filter_map(|(index, step)| Some((place(*index)?, *step)));
    let mut steps: Vec<(Value, EliminationStep)> = steps
        .filter(|(value, _)| is_labelled(&code[value.index()]))
        .collect();
    steps.sort_unstable();
    steps.dedup();
    Code {
        code,
        roots,
        prepared: builder.prepared,
        steps,
    }
}

/// The items that the roots need, operands first, without those that are merged into others.
fn in_order(net: &Net, merged: &[bool]) -> Vec<Index> {
    let mut order = Vec::with_capacity(net.items.len());
    let mut entered = vec![false; net.items.len()];
    let mut stack: Vec<(Index, bool)> = net
        .roots
        .iter()
        .rev()
        .map(|(root, _)| (*root, false))
        .collect();
    while let Some((index, done)) = stack.pop() {
        if done {
            if !merged[index as usize] {
                order.push(index);
            }
        } else if !std::mem::replace(&mut entered[index as usize], true) {
            stack.push((index, true));
            operands(&net.items[index as usize], |operand| {
                stack.push((operand, false))
            });
        }
    }
    order
}

/// Products that are only a factor of another product, and so are merged into it. A product with a
/// factor that depends on parameters alone stays separate, so that two such factors never meet. So
/// does one that is computed separately in an earlier stage.
fn merged(net: &Net) -> Vec<bool> {
    let uses = net.uses();
    let mut merged = vec![false; net.items.len()];
    let varies = |index: &Index| net.stages[*index as usize] > 0;
    let part = |index: Index| stages::part(net.separate, net.stages[index as usize]);
    let is_product = |index: Index| match &net.items[index as usize] {
        Item::Product {
            factors: up,
            divisors: down,
        } => down.is_empty() && up.iter().all(varies),
        _ => false,
    };
    for (index, item) in net.items.iter().enumerate() {
        if let Item::Product { factors: up, .. } = item {
            for &factor in up.iter().filter(|&&factor| is_product(factor)) {
                merged[factor as usize] =
                    uses[factor as usize] == 1 && part(factor) == part(index as Index);
            }
        }
    }
    merged
}

#[derive(Default)]
struct Builder<'g> {
    /// The graph in which values are prepared, if they are.
    graph: Option<&'g mut Graph>,
    code: Vec<Op>,
    /// When each value is known, in tenths of a cycle after the arguments.
    ready: Vec<u64>,
    values: FxHashMap<Op, Value>,
    prepared: Vec<Id>,
    prepared_index: FxHashMap<Id, u32>,
}

impl Builder<'_> {
    fn op(&mut self, op: Op) -> Value {
        let op = self.prepared(&op).unwrap_or(op);
        // The rounding does not depend on the order of the operands.
        let op = match op {
            Op::Add(a, b) if b < a => Op::Add(b, a),
            Op::Mul(a, b) if b < a => Op::Mul(b, a),
            other => other,
        };
        if let Some(&value) = self.values.get(&op) {
            return value;
        }
        let value =
            Value(u32::try_from(self.code.len()).expect("memory ends before 2^32 operations"));
        let operands = op.operands().map(|operand| self.ready[operand.index()]);
        self.ready.push(operands.max().unwrap_or(0) + latency(&op));
        self.code.push(op.clone());
        self.values.insert(op, value);
        value
    }

    /// The replacement of an operation whose operands all depend on parameters alone. The graph has
    /// prepared the values that it recognized as such; but two of its products may turn out to be the
    /// same operations, so that a sum becomes zero, or one of its terms, only here. Signs stay, since
    /// they cost less than one more prepared value.
    fn prepared(&mut self, op: &Op) -> Option<Op> {
        use lagrangian_symbolic::Function::{Cos, Sin};
        let graph = self.graph.as_deref_mut()?;
        let is_known = |value: Value| is_known(&self.code[value.index()]);
        if op.operands().next().is_none() || !op.operands().all(is_known) {
            return None;
        }
        let operands: Vec<Scaled> = op
            .operands()
            .map(|value| match &self.code[value.index()] {
                Op::Constant(constant) => graph.constant(constant),
                Op::Read(Source::Prepared(index)) => graph.scaled(self.prepared[*index as usize]),
                _ => graph.pi(),
            })
            .collect();
        let value = match (op, operands.as_slice()) {
            (Op::Add(..), all) => graph.sum(all),
            (Op::Sub(..), &[a, b]) => graph.sum(&[a, b.negated()]),
            (Op::Mul(..), &[a, b]) => graph.product(&[(a, 1), (b, 1)]),
            (Op::Div(..), &[a, b]) => graph.quotient(a, b),
            (Op::Sin(_), all) => graph.function(Sin, all),
            (Op::Cos(_), all) => graph.function(Cos, all),
            (Op::Unary(function, _) | Op::Binary(function, ..), all) => {
                graph.function(*function, all)
            }
            _ => return None,
        };
        let constant = match graph.node(value.factor) {
            Node::Constant(constant) if value.negative => Some(-constant),
            Node::Constant(constant) => Some(constant.clone()),
            _ => None,
        };
        if let Some(constant) = constant {
            return Some(Op::Constant(constant));
        }
        let factor = graph.with_signed_factor(value).factor;
        Some(self.read_prepared(factor))
    }

    fn read_prepared(&mut self, id: Id) -> Op {
        let next = self.prepared.len() as u32;
        let index = *self.prepared_index.entry(id).or_insert(next);
        if index == next {
            self.prepared.push(id);
        }
        Op::Read(Source::Prepared(index))
    }

    fn item(
        &mut self,
        net: &Net,
        index: Index,
        merged: &[bool],
        value_of: &[Option<Value>],
    ) -> Value {
        let value = |index: Index| value_of[index as usize].expect("operands come first");
        match &net.items[index as usize] {
            Item::Leaf(Leaf::Op(op)) => self.op(op.clone()),
            Item::Leaf(Leaf::Prepared(id)) => {
                let read = self.read_prepared(*id);
                self.op(read)
            }
            Item::Function(function, arguments) => {
                use lagrangian_symbolic::Function::{Cos, Sin};
                match (function, arguments.as_slice()) {
                    (Sin, &[x]) => self.circular(net, x, value(x)).0,
                    (Cos, &[x]) => self.circular(net, x, value(x)).1,
                    (_, &[x]) => self.op(Op::Unary(*function, value(x))),
                    (_, &[x, y]) => self.op(Op::Binary(*function, value(x), value(y))),
                    _ => unreachable!("functions have one argument or two"),
                }
            }
            Item::Product {
                factors: up,
                divisors: down,
            } => {
                let mut factors = Vec::with_capacity(up.len());
                let mut open = up.clone();
                while let Some(factor) = open.pop() {
                    match &net.items[factor as usize] {
                        Item::Product { factors: up, .. } if merged[factor as usize] => {
                            open.extend(up)
                        }
                        _ => factors.push(factor),
                    }
                }
                let earlier_first = |mut list: Vec<Index>| {
                    sort_by_key(&mut list, |&index| (net.stages[index as usize], index));
                    list.into_iter().map(value).collect::<Vec<Value>>()
                };
                let (up, down) = (earlier_first(factors), earlier_first(down.clone()));
                if down.is_empty() {
                    return self.product(up);
                }
                let denominator = self.product(down);
                let numerator = self.product(up);
                if self.is_zero(numerator) {
                    numerator
                } else {
                    self.op(Op::Div(numerator, denominator))
                }
            }
            Item::Sum(terms) => {
                let mut list: Vec<Signed> = terms.clone();
                sort_by_key(&mut list, |&(index, negative)| {
                    (negative, net.stages[index as usize], index)
                });
                let terms = list.into_iter();
                self.sum(
                    terms
                        .map(|(index, negative)| (value(index), negative))
                        .collect(),
                )
            }
        }
    }

    /// Sine and cosine. If the angle depends on time alone, they are as exact as if the angle had
    /// not been rounded.
    ///
    /// The phase ω t of a drive grows without bound, and its rounding error with it: after a minute
    /// at 100 rad/s it is 1e-12, the largest error of the whole evaluation. If the error δ of the
    /// rounded angle is known, sin(x + δ) = sin x + δ cos x and cos(x + δ) = cos x − δ sin x to
    /// order δ². The angle of a coordinate needs no such correction: it is an argument, and exact.
    fn circular(&mut self, net: &Net, angle: Index, value: Value) -> (Value, Value) {
        let (sin, cos) = (Op::Sin(value), Op::Cos(value));
        let error = match net.stages[angle as usize] {
            TIME => self.error(value),
            _ => None,
        };
        // An unused sine or cosine costs nothing, because operations that no result needs are dropped.
        let (sin, cos) = (self.op(sin), self.op(cos));
        let Some(error) = error else {
            return (sin, cos);
        };
        let (by_sin, by_cos) = (self.op(Op::Mul(error, cos)), self.op(Op::Mul(error, sin)));
        (self.op(Op::Add(sin, by_sin)), self.op(Op::Sub(cos, by_cos)))
    }

    /// The rounding error of a value that is a product, a sum or both.
    fn error(&mut self, value: Value) -> Option<Value> {
        let of_product = |builder: &mut Self, value: Value| match builder.code[value.index()] {
            Op::Mul(a, b) => Some(builder.op(Op::ProductError(a, b))),
            _ => None,
        };
        if let Some(error) = of_product(self, value) {
            return Some(error);
        }
        let (a, b, is_difference) = match self.code[value.index()] {
            Op::Add(a, b) => (a, b, false),
            Op::Sub(a, b) => (a, b, true),
            _ => return None,
        };
        let subtrahend = if is_difference {
            match &self.code[b.index()] {
                Op::Constant(constant) => self.op(Op::Constant(-constant)),
                _ => self.op(Op::Neg(b)),
            }
        } else {
            b
        };
        let mut error = self.op(Op::SumError(a, subtrahend));
        if let Some(first) = of_product(self, a) {
            error = self.op(Op::Add(error, first));
        }
        if let Some(second) = of_product(self, b) {
            error = if is_difference {
                self.op(Op::Sub(error, second))
            } else {
                self.op(Op::Add(error, second))
            };
        }
        Some(error)
    }

    /// The product; factors that are known first are multiplied first. The empty product is 1.
    fn product(&mut self, factors: Vec<Value>) -> Value {
        // A sum whose terms have cancelled.
        if let Some(&zero) = factors.iter().find(|factor| self.is_zero(**factor)) {
            return zero;
        }
        let factors = factors.into_iter().map(|factor| (factor, false)).collect();
        let product = self.merge(factors, |builder, a, b| {
            (builder.op(Op::Mul(a.0, b.0)), false)
        });
        match product {
            Some((value, _)) => value,
            None => self.op(Op::Constant(Rational::ONE)),
        }
    }

    /// The sum of terms; those that are known first are added first.
    fn sum(&mut self, terms: Vec<(Value, bool)>) -> Value {
        let terms = self.without_opposites(terms);
        let sum = self.merge(terms, |builder, a, b| match (a, b) {
            ((a, minus_a), (b, minus_b)) if minus_a == minus_b => {
                (builder.op(Op::Add(a, b)), minus_a)
            }
            ((a, false), (b, _)) | ((b, _), (a, _)) => (builder.op(Op::Sub(a, b)), false),
        });
        match sum {
            Some((value, false)) => value,
            Some((value, true)) => self.negative(value),
            None => self.op(Op::Constant(Rational::ZERO)),
        }
    }

    /// The terms without pairs that cancel.
    ///
    /// Two products of the graph may turn out to be the same operations, so that x − x is
    /// recognized only here.
    fn without_opposites(&self, terms: Vec<(Value, bool)>) -> Vec<(Value, bool)> {
        let mut left: Vec<Option<(Value, bool)>> = Vec::with_capacity(terms.len());
        // The positions of the terms, since searching a long sum would take too long.
        let mut places: FxHashMap<(Value, bool), Vec<usize>> = FxHashMap::default();
        let is_long = terms.len() > LINEAR_SEARCH_LIMIT;
        if is_long {
            places.reserve(terms.len());
        }
        for (value, negative) in terms {
            let sought = (value, !negative);
            let opposite = if is_long {
                places.get_mut(&sought).and_then(Vec::pop)
            } else {
                left.iter().position(|term| *term == Some(sought))
            };
            match opposite {
                Some(opposite) => left[opposite] = None,
                None if self.is_zero(value) => {}
                None => {
                    if is_long {
                        places
                            .entry((value, negative))
                            .or_default()
                            .push(left.len());
                    }
                    left.push(Some((value, negative)));
                }
            }
        }
        left.into_iter().flatten().collect()
    }

    fn is_zero(&self, value: Value) -> bool {
        matches!(&self.code[value.index()], Op::Constant(constant) if constant.is_zero())
    }

    /// Merges all parts into one: repeatedly the two that are known first, or the earlier in the
    /// list in case of a tie.
    fn merge(
        &mut self,
        parts: Vec<(Value, bool)>,
        combine: impl Fn(&mut Self, (Value, bool), (Value, bool)) -> (Value, bool),
    ) -> Option<(Value, bool)> {
        let mut next = parts.len();
        let parts = parts.into_iter().enumerate();
        let mut queue: BinaryHeap<_> = parts
            .map(|(place, part)| Reverse((self.ready[part.0.index()], place, part)))
            .collect();
        while let Some(Reverse((_, _, first))) = queue.pop() {
            let Some(Reverse((_, _, second))) = queue.pop() else {
                return Some(first);
            };
            let part = combine(self, first, second);
            queue.push(Reverse((self.ready[part.0.index()], next, part)));
            next += 1;
        }
        None
    }

    fn negative(&mut self, value: Value) -> Value {
        match &self.code[value.index()] {
            Op::Constant(constant) => {
                let constant = -constant;
                self.op(Op::Constant(constant))
            }
            // −(a − b) = b − a exactly; a − b is dropped if nothing else needs it.
            &Op::Sub(a, b) => self.op(Op::Sub(b, a)),
            _ => self.op(Op::Neg(value)),
        }
    }
}

/// Sums of up to this many terms are searched linearly for terms that cancel.
const LINEAR_SEARCH_LIMIT: usize = 32;

/// Whether a value depends on parameters alone, and is computed with them.
fn is_known(op: &Op) -> bool {
    matches!(op, Op::Constant(_) | Op::Pi | Op::Read(Source::Prepared(_)))
}

/// The operations that the roots need, each as late as its first use allows; the operand that needs
/// more registers comes first.
///
/// R. Sethi and J. D. Ullman, *The generation of optimal code for arithmetic expressions*, J. ACM
/// 17 (1970) 715–728: exact for trees; shared values are counted at each use here.
///
/// The last part of the result are the new places of the operations.
fn reorder(code: &[Op], roots: &[Value]) -> (Vec<Op>, Vec<Value>, Vec<Option<Value>>) {
    let mut registers: Vec<u32> = Vec::with_capacity(code.len());
    let mut partner: FxHashMap<(Value, bool), Value> = FxHashMap::default();
    for (index, op) in code.iter().enumerate() {
        let mut needs = op.operands().map(|operand| registers[operand.index()]);
        registers.push(match (needs.next(), needs.next()) {
            (Some(a), Some(b)) if a == b => a.saturating_add(1),
            (Some(a), Some(b)) => a.max(b),
            (Some(a), None) => a,
            _ => 1,
        });
        match *op {
            Op::Sin(angle) => partner.insert((angle, true), Value(index as u32)),
            Op::Cos(angle) => partner.insert((angle, false), Value(index as u32)),
            _ => None,
        };
    }
    let live = live(code, roots);
    let mut place: Vec<Option<Value>> = vec![None; code.len()];
    let mut ordered: Vec<Op> = Vec::new();
    let mut stack: Vec<(Value, bool)> = roots.iter().rev().map(|root| (*root, false)).collect();
    while let Some((value, ready)) = stack.pop() {
        if place[value.index()].is_some() {
            continue;
        }
        let op = &code[value.index()];
        if !ready {
            stack.push((value, true));
            let mut list: Vec<Value> = op.operands().collect();
            list.reverse();
            sort_by_key(&mut list, |operand| registers[operand.index()]);
            stack.extend(list.into_iter().map(|operand| (operand, false)));
            continue;
        }
        let mut write = |value: Value, op: &Op| {
            place[value.index()] = Some(Value(ordered.len() as u32));
            let moved = |operand: Value| place[operand.index()].expect("operands come first");
            ordered.push(op.with_operands(moved));
        };
        write(value, op);
        // The sine and cosine of an angle are placed next to each other.
        let other = match *op {
            Op::Sin(angle) => partner.get(&(angle, false)),
            Op::Cos(angle) => partner.get(&(angle, true)),
            _ => None,
        };
        if let Some(&other) = other
            && live[other.index()]
        {
            write(other, &code[other.index()]);
        }
    }
    let roots = roots
        .iter()
        .map(|root| place[root.index()].expect("roots are reached"))
        .collect();
    (ordered, roots, place)
}

/// The operations in the order in which a processor starts them.
///
/// A processor looks ahead only a few hundred operations. So operations that wait for each other,
/// like those from link to link of a chain, must be interleaved with those of another such chain, or
/// the two chains take their times one after the other. This simulates a processor with two
/// arithmetic units that starts, among the operations whose operands are known, the one with the
/// longest chain of dependents (list scheduling: T. C. Hu, *Parallel sequencing and assembly line
/// problems*, Operations Research 9 (1961) 841–848).
///
/// Products that are contracted into sums, and reads, stay at their first use. If the total work
/// takes longer than the longest chain, the order with the fewest live values is kept.
///
/// The last part of the result are the new places of the operations.
fn by_time(code: Vec<Op>, roots: Vec<Value>) -> (Vec<Op>, Vec<Value>, Vec<Option<Value>>) {
    let function = Function {
        role: Role::Output(0),
        shape: Shape::Vector(roots.len()),
        code,
        results: roots,
        guards: Vec::new(),
        steps: Vec::new(),
    };
    let cost = function.cost();
    if cost.path <= cost.throughput || function.code.len() > LONGEST_SCHEDULED {
        let places = (0..function.code.len() as u32).map(|index| Some(Value(index)));
        return (function.code, function.results, places.collect());
    }
    let rows = Dependencies::of(&function);
    let mut writer = InOrder::new(&function);
    for index in rows.start_order() {
        writer.write(index);
    }
    let roots = function.results.iter();
    roots.for_each(|root| writer.write(root.index()));
    let place = |root: &Value| writer.place[root.index()].expect("roots are written");
    let roots = function.results.iter().map(place).collect();
    (writer.code, roots, writer.place)
}

/// The dependencies among operations.
struct Dependencies {
    /// The latency of each operation, in tenths of a cycle; `None` for values that are not
    /// operations of their own.
    latencies: Vec<Option<u64>>,
    /// The operations that wait for each.
    users: Vec<Vec<u32>>,
    /// The number of operands that each waits for.
    operand_counts: Vec<u32>,
}

/// The longest function that is ordered by time. Longer ones are cut into pieces or written as loops,
/// for which related operations must stay together.
pub const LONGEST_SCHEDULED: usize = 8000;

/// The number of arithmetic operations that are started in a cycle.
const UNITS: u32 = 2;
const CYCLE: u64 = 10;

impl Dependencies {
    fn of(function: &Function) -> Dependencies {
        let n = function.code.len();
        let contractions = Contractions::of(function);
        let mut rows = Dependencies {
            latencies: Vec::with_capacity(n),
            users: vec![Vec::new(); n],
            operand_counts: vec![0; n],
        };
        let is_read = |op: &Op| matches!(op, Op::Constant(_) | Op::Pi | Op::Read(_));
        for (index, op) in function.code.iter().enumerate() {
            let value = Value(index as u32);
            if is_read(op) || contractions.is_part(value) {
                rows.latencies.push(None);
                continue;
            }
            rows.latencies.push(Some(latency(op)));
            let operands: Vec<Value> = match contractions.sum(value) {
                Some(sum) => vec![sum.factors[0], sum.factors[1], sum.term],
                None => op.operands().collect(),
            };
            for operand in operands {
                if rows.latencies[operand.index()].is_some() {
                    rows.users[operand.index()].push(value.0);
                    rows.operand_counts[index] += 1;
                }
            }
        }
        rows
    }

    /// The time from the start of each operation to the end of the longest chain that depends on it.
    fn heights(&self) -> Vec<u64> {
        let mut heights = vec![0; self.latencies.len()];
        for index in (0..heights.len()).rev() {
            let after = self.users[index].iter();
            let after = after.map(|user| heights[*user as usize]).max();
            heights[index] = after.unwrap_or(0) + self.latencies[index].unwrap_or(0);
        }
        heights
    }

    /// The operations in the order of their starts.
    fn start_order(mut self) -> Vec<usize> {
        let heights = self.heights();
        let mut known: Vec<u64> = vec![0; heights.len()];
        // Operations by the time at which their operands are known, and those whose operands are
        // known, by height.
        let mut later: BinaryHeap<Reverse<(u64, u32)>> = BinaryHeap::new();
        let mut now: BinaryHeap<(u64, Reverse<u32>)> = BinaryHeap::new();
        for (index, takes) in self.latencies.iter().enumerate() {
            if takes.is_some() && self.operand_counts[index] == 0 {
                later.push(Reverse((0, index as u32)));
            }
        }
        let mut order = Vec::with_capacity(heights.len());
        let (mut time, mut busy) = (0, 0);
        loop {
            while let Some(&Reverse((at, index))) = later.peek()
                && at <= time
            {
                later.pop();
                now.push((heights[index as usize], Reverse(index)));
            }
            if busy == UNITS || now.is_empty() {
                let Some(next) = later.peek().map(|Reverse((at, _))| *at) else {
                    if now.is_empty() {
                        return order;
                    }
                    (time, busy) = (time + CYCLE, 0);
                    continue;
                };
                time = if now.is_empty() {
                    next.max(time)
                } else {
                    time + CYCLE
                };
                busy = 0;
                continue;
            }
            let Some((_, Reverse(index))) = now.pop() else {
                continue;
            };
            let index = index as usize;
            order.push(index);
            busy += 1;
            let end = time + self.latencies[index].unwrap_or(0);
            for &user in &self.users[index] {
                let user = user as usize;
                known[user] = known[user].max(end);
                self.operand_counts[user] -= 1;
                if self.operand_counts[user] == 0 {
                    later.push(Reverse((known[user], user as u32)));
                }
            }
        }
    }
}

/// Writes operations in a given order, each preceded by those of its operands that are not yet written.
struct InOrder<'a> {
    function: &'a Function,
    /// The sines and cosines, by angle.
    circular: FxHashMap<(Value, bool), usize>,
    place: Vec<Option<Value>>,
    code: Vec<Op>,
}

impl<'a> InOrder<'a> {
    fn new(function: &'a Function) -> InOrder<'a> {
        let circular = function.code.iter().enumerate();
        let circular = circular.filter_map(|(index, op)| match op {
            Op::Sin(angle) => Some(((*angle, true), index)),
            Op::Cos(angle) => Some(((*angle, false), index)),
            _ => None,
        });
        InOrder {
            function,
            circular: circular.collect(),
            place: vec![None; function.code.len()],
            code: Vec::with_capacity(function.code.len()),
        }
    }

    fn write(&mut self, index: usize) {
        let mut open = vec![(index, false)];
        while let Some((index, is_ready)) = open.pop() {
            if self.place[index].is_some() {
                continue;
            }
            let op = &self.function.code[index];
            if !is_ready {
                open.push((index, true));
                let operands: Vec<Value> = op.operands().collect();
                open.extend(
                    operands
                        .iter()
                        .rev()
                        .map(|operand| (operand.index(), false)),
                );
                continue;
            }
            self.push(index);
            // The sine and cosine of an angle are placed next to each other.
            let partner = match *op {
                Op::Sin(angle) => self.circular.get(&(angle, false)),
                Op::Cos(angle) => self.circular.get(&(angle, true)),
                _ => None,
            };
            if let Some(&partner) = partner
                && self.place[partner].is_none()
            {
                self.push(partner);
            }
        }
    }

    fn push(&mut self, index: usize) {
        self.place[index] = Some(Value(self.code.len() as u32));
        let moved = |operand: Value| self.place[operand.index()].expect("operands come first");
        self.code
            .push(self.function.code[index].with_operands(moved));
    }
}

fn live(code: &[Op], roots: &[Value]) -> Vec<bool> {
    let mut live = vec![false; code.len()];
    roots.iter().for_each(|root| live[root.index()] = true);
    for (index, op) in code.iter().enumerate().rev() {
        if live[index] {
            op.operands()
                .for_each(|operand| live[operand.index()] = true);
        }
    }
    live
}
