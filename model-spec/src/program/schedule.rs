//! From products and sums to operations, in an order that lets few values wait and keeps few of
//! them at hand.
//!
//! A product of many factors, or a sum of many terms, is computed in the order in which they are
//! known: the two that are known first become one, and so on, as D. A. Huffman's code merges the
//! two rarest letters. So what takes long, a sine or a quotient, passes through one operation and
//! not through several; of values known at once a balanced tree is made. No other order has its
//! result known earlier (M. C. Golumbic, *Combinatorial merging*, IEEE Trans. Comput. C-25 (1976)
//! 1164–1167).

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use lagrangian_symbolic::Rational;
use rustc_hash::FxHashMap;

use super::cost::latency;
use super::graph::Id;
use super::net::{Index, Item, Leaf, Net, Signed, TIME, operands};
use super::{Op, Source, Value, stages};

/// A function's code, prepared values still called by their nodes.
pub(super) struct Code {
    pub(super) code: Vec<Op>,
    pub(super) roots: Vec<Value>,
    /// What `Read(Prepared(k))` stands for.
    pub(super) prepared: Vec<Id>,
}

/// Writes the items down as operations.
pub(super) fn schedule(net: &Net) -> Code {
    let merged = merged(net);
    let mut builder = Builder::default();
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
    let (code, roots) = reorder(&builder.code, &roots);
    Code {
        code,
        roots,
        prepared: builder.prepared,
    }
}

/// The items that the roots need, operands first, but for those that are merged into others.
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

/// Products that are only a factor of another product. What has a factor that is known before stays
/// by itself: two such factors are not to meet. So does what is computed by itself in an earlier
/// stage.
fn merged(net: &Net) -> Vec<bool> {
    let uses = net.uses();
    let mut merged = vec![false; net.items.len()];
    let varies = |index: &Index| net.stages[*index as usize] > 0;
    let part = |index: Index| stages::part(net.apart, net.stages[index as usize]);
    let is_product = |index: Index| match &net.items[index as usize] {
        Item::Product { up, down } => down.is_empty() && up.iter().all(varies),
        _ => false,
    };
    for (index, item) in net.items.iter().enumerate() {
        if let Item::Product { up, .. } = item {
            for &factor in up.iter().filter(|&&factor| is_product(factor)) {
                merged[factor as usize] =
                    uses[factor as usize] == 1 && part(factor) == part(index as Index);
            }
        }
    }
    merged
}

#[derive(Default)]
struct Builder {
    code: Vec<Op>,
    /// How long after the arguments each value is known, in tenths of a cycle.
    ready: Vec<u64>,
    values: FxHashMap<Op, Value>,
    prepared: Vec<Id>,
    prepared_index: FxHashMap<Id, u32>,
}

impl Builder {
    fn op(&mut self, op: Op) -> Value {
        // Both round the same either way round.
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
                let next = self.prepared.len() as u32;
                let index = *self.prepared_index.entry(*id).or_insert(next);
                if index == next {
                    self.prepared.push(*id);
                }
                self.op(Op::Read(Source::Prepared(index)))
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
            Item::Product { up, down } => {
                let mut factors = Vec::with_capacity(up.len());
                let mut open = up.clone();
                while let Some(factor) = open.pop() {
                    match &net.items[factor as usize] {
                        Item::Product { up, .. } if merged[factor as usize] => open.extend(up),
                        _ => factors.push(factor),
                    }
                }
                let earlier_first = |mut list: Vec<Index>| {
                    list.sort_by_key(|&index| (net.stages[index as usize], index));
                    list.into_iter().map(value).collect::<Vec<Value>>()
                };
                let (up, down) = (earlier_first(factors), earlier_first(down.clone()));
                if down.is_empty() {
                    return self.product(up);
                }
                let denominator = self.product(down);
                let numerator = self.product(up);
                match self.is_zero(numerator) {
                    true => numerator,
                    false => self.op(Op::Div(numerator, denominator)),
                }
            }
            Item::Sum(terms) => {
                let mut list: Vec<Signed> = terms.clone();
                list.sort_by_key(|&(index, negative)| {
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

    /// Sine and cosine; of what time alone decides, as exact as if the angle had not been rounded.
    ///
    /// The phase ω t of a drive grows without end and its rounding error with it: after a minute at
    /// 100 rad/s it is 1e-12, the largest error of the whole evaluation. With the error δ of the
    /// rounded angle known, sin(x + δ) = sin x + δ cos x and cos(x + δ) = cos x − δ sin x to δ².
    /// The angle of a coordinate needs no such thing: it is an argument, and exact.
    fn circular(&mut self, net: &Net, angle: Index, value: Value) -> (Value, Value) {
        let (sin, cos) = (Op::Sin(value), Op::Cos(value));
        let error = match net.stages[angle as usize] {
            TIME => self.error(value),
            _ => None,
        };
        // Neither is computed where the function needs only the other: what no result needs is
        // dropped.
        let (sin, cos) = (self.op(sin), self.op(cos));
        let Some(error) = error else {
            return (sin, cos);
        };
        let (by_sin, by_cos) = (self.op(Op::Mul(error, cos)), self.op(Op::Mul(error, sin)));
        (self.op(Op::Add(sin, by_sin)), self.op(Op::Sub(cos, by_cos)))
    }

    /// The rounding error of a value, where it is that of a product, a sum or both.
    fn error(&mut self, value: Value) -> Option<Value> {
        let of_product = |builder: &mut Builder, value: Value| match builder.code[value.index()] {
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
            self.op(Op::Neg(b))
        } else {
            b
        };
        let mut error = self.op(Op::SumError(a, subtrahend));
        if let Some(first) = of_product(self, a) {
            error = self.op(Op::Add(error, first));
        }
        if let Some(second) = of_product(self, b) {
            error = match is_difference {
                true => self.op(Op::Sub(error, second)),
                false => self.op(Op::Add(error, second)),
            };
        }
        Some(error)
    }

    /// The product, factors that are known first multiplied first; of none, 1.
    fn product(&mut self, factors: Vec<Value>) -> Value {
        // A sum whose terms have gone.
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

    /// The sum of terms, those that are known first added first.
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

    /// The terms without those that take each other away.
    ///
    /// Two products of the graph may turn out to be the same operations, so that x − x is seen only
    /// here. What parameters alone decide must not be left over: that would have been prepared.
    fn without_opposites(&self, terms: Vec<(Value, bool)>) -> Vec<(Value, bool)> {
        let mut left: Vec<(Value, bool)> = Vec::with_capacity(terms.len());
        for &(value, negative) in &terms {
            match left.iter().position(|term| *term == (value, !negative)) {
                Some(opposite) => {
                    left.remove(opposite);
                }
                None if self.is_zero(value) => {}
                None => left.push((value, negative)),
            }
        }
        let is_known = |value: Value| {
            let op = &self.code[value.index()];
            matches!(op, Op::Constant(_) | Op::Pi | Op::Read(Source::Prepared(_)))
        };
        match left.is_empty() || left.iter().any(|(value, _)| !is_known(*value)) {
            true => left,
            false => terms,
        }
    }

    fn is_zero(&self, value: Value) -> bool {
        matches!(&self.code[value.index()], Op::Constant(constant) if constant.is_zero())
    }

    /// Makes one of all parts: each time of the two that are known first, the earlier in the list
    /// if several are.
    fn merge(
        &mut self,
        parts: Vec<(Value, bool)>,
        combine: impl Fn(&mut Builder, (Value, bool), (Value, bool)) -> (Value, bool),
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
            // −(a − b) = b − a exactly; if a − b is not needed otherwise, it will not be there.
            &Op::Sub(a, b) => self.op(Op::Sub(b, a)),
            _ => self.op(Op::Neg(value)),
        }
    }
}

/// The operations that the roots need, each as late as its first use allows, the operand that needs
/// more room first.
///
/// R. Sethi and J. D. Ullman, *The generation of optimal code for arithmetic expressions*, J. ACM
/// 17 (1970) 715–728: exact for trees; shared values are counted at each use here.
fn reorder(code: &[Op], roots: &[Value]) -> (Vec<Op>, Vec<Value>) {
    let mut room: Vec<u32> = Vec::with_capacity(code.len());
    let mut partner: FxHashMap<(Value, bool), Value> = FxHashMap::default();
    for (index, op) in code.iter().enumerate() {
        let mut needs = op.operands().map(|operand| room[operand.index()]);
        room.push(match (needs.next(), needs.next()) {
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
            list.sort_by_key(|operand| room[operand.index()]);
            stack.extend(list.into_iter().map(|operand| (operand, false)));
            continue;
        }
        let mut write = |value: Value, op: &Op| {
            place[value.index()] = Some(Value(ordered.len() as u32));
            let moved = |operand: Value| place[operand.index()].expect("operands come first");
            ordered.push(with_operands(op, moved));
        };
        write(value, op);
        // Sine and cosine of one angle next to each other.
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
    (ordered, roots)
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

/// The same operation on other operands.
pub(crate) fn with_operands(op: &Op, mut moved: impl FnMut(Value) -> Value) -> Op {
    match *op {
        Op::Constant(_) | Op::Pi | Op::Read(_) => op.clone(),
        Op::Add(a, b) => Op::Add(moved(a), moved(b)),
        Op::Sub(a, b) => Op::Sub(moved(a), moved(b)),
        Op::Mul(a, b) => Op::Mul(moved(a), moved(b)),
        Op::Div(a, b) => Op::Div(moved(a), moved(b)),
        Op::Neg(a) => Op::Neg(moved(a)),
        Op::ProductError(a, b) => Op::ProductError(moved(a), moved(b)),
        Op::SumError(a, b) => Op::SumError(moved(a), moved(b)),
        Op::Sin(a) => Op::Sin(moved(a)),
        Op::Cos(a) => Op::Cos(moved(a)),
        Op::Unary(function, a) => Op::Unary(function, moved(a)),
        Op::Binary(function, a, b) => Op::Binary(function, moved(a), moved(b)),
    }
}
