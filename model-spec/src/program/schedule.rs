//! From products and sums to operations, in an order that keeps few values waiting.

use lagrangian_symbolic::Rational;
use rustc_hash::FxHashMap;

use super::graph::Id;
use super::net::{Index, Item, Leaf, Net, Signed, TIME, operands};
use super::{Op, Value};

/// A function's code, prepared values still called by their nodes.
pub(super) struct Code {
    pub(super) code: Vec<Op>,
    pub(super) roots: Vec<Value>,
    /// What `Read(Prepared(k))` stands for.
    pub(super) prepared: Vec<Id>,
}

/// Writes the items down as operations.
pub(super) fn schedule(net: &Net) -> Code {
    let mut builder = Builder::default();
    let mut value_of: Vec<Option<Value>> = vec![None; net.items.len()];
    for index in in_order(net) {
        value_of[index as usize] = Some(builder.item(net, index, &value_of));
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

/// The items that the roots need, operands first.
fn in_order(net: &Net) -> Vec<Index> {
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
            order.push(index);
        } else if !std::mem::replace(&mut entered[index as usize], true) {
            stack.push((index, true));
            operands(&net.items[index as usize], |operand| {
                stack.push((operand, false))
            });
        }
    }
    order
}

#[derive(Default)]
struct Builder {
    code: Vec<Op>,
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
        self.code.push(op.clone());
        self.values.insert(op, value);
        value
    }

    fn item(&mut self, net: &Net, index: Index, value_of: &[Option<Value>]) -> Value {
        let value = |index: Index| value_of[index as usize].expect("operands come first");
        match &net.items[index as usize] {
            Item::Leaf(Leaf::Op(op)) => self.op(op.clone()),
            Item::Leaf(Leaf::Prepared(id)) => {
                let next = self.prepared.len() as u32;
                let index = *self.prepared_index.entry(*id).or_insert(next);
                if index == next {
                    self.prepared.push(*id);
                }
                self.op(Op::Read(super::Source::Prepared(index)))
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
                let earlier_first = |list: &[Index]| {
                    let mut list = list.to_vec();
                    list.sort_by_key(|&index| (net.stages[index as usize], index));
                    list.into_iter().map(value).collect::<Vec<Value>>()
                };
                let (up, down) = (earlier_first(up), earlier_first(down));
                if down.is_empty() {
                    return self.product(up);
                }
                let denominator = self.product(down);
                let numerator = self.product(up);
                self.op(Op::Div(numerator, denominator))
            }
            Item::Sum(terms) => {
                let mut terms: Vec<Signed> = terms.clone();
                terms.sort_by_key(|&(index, negative)| {
                    (negative, net.stages[index as usize], index)
                });
                self.sum(
                    terms
                        .into_iter()
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

    /// The product as a balanced tree; of none, 1.
    fn product(&mut self, mut factors: Vec<Value>) -> Value {
        while factors.len() > 1 {
            factors = factors
                .chunks(2)
                .map(|pair| {
                    if let &[a, b] = pair {
                        self.op(Op::Mul(a, b))
                    } else {
                        pair[0]
                    }
                })
                .collect();
        }
        match factors.first() {
            Some(&value) => value,
            None => self.op(Op::Constant(Rational::ONE)),
        }
    }

    /// The sum of terms, positive ones first: three in a row, more as a balanced tree.
    fn sum(&mut self, mut terms: Vec<(Value, bool)>) -> Value {
        while terms.len() > 1 {
            terms = terms
                .chunks(2)
                .map(|pair| match *pair {
                    [(a, minus_a), (b, minus_b)] if minus_a == minus_b => {
                        (self.op(Op::Add(a, b)), minus_a)
                    }
                    // Positive terms stand first.
                    [(a, _), (b, _)] => (self.op(Op::Sub(a, b)), false),
                    _ => pair[0],
                })
                .collect();
        }
        match terms.first() {
            Some(&(value, false)) => value,
            Some(&(value, true)) => self.negative(value),
            None => self.op(Op::Constant(Rational::ZERO)),
        }
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
pub(super) fn with_operands(op: &Op, moved: impl Fn(Value) -> Value) -> Op {
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
