//! Decides which products are contracted into the sums that use them.
//!
//! Programs keep multiplications and additions apart; a processor with a fused multiply-add computes
//! `a·b ± c` in one operation with one rounding. Whether to contract is the choice of the emitter;
//! which products to contract is decided here, once for the emitters and for the [cost](super::Cost).

use super::latency::latency;
use super::{Function, Op, Value};

/// An operand of an addition or a subtraction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// The first.
    Left,
    /// The second.
    Right,
}

/// For each operation the operand that is a product to be contracted into it, if there is one:
/// `Left` for `a·b + c` and `a·b − c`, `Right` for `c + a·b` and `c − a·b`.
///
/// Such a product is used only once in the whole function, by this addition or subtraction, so its
/// multiplication need not be written. If both operands are such products, the one whose factors
/// are known later is contracted, and the other is multiplied in the meantime; if both are known at
/// the same time, the left one is contracted.
pub fn fused(function: &Function) -> Vec<Option<Side>> {
    Timing::of(function).fused
}

/// A sum and the product that is contracted into it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Contraction {
    /// The kind of contraction.
    pub kind: Contracted,
    /// The factors a and b of the product.
    pub factors: [Value; 2],
    /// The other term, c.
    pub term: Value,
}

/// The operation on a product and a term.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Contracted {
    /// a·b + c
    Add,
    /// a·b − c
    Sub,
    /// c − a·b
    SubFrom,
}

/// The result of [`fused`], by sums and by products.
#[derive(Clone, Debug)]
pub struct Contractions {
    sums: Vec<Option<Contraction>>,
    /// Whether a value is a product that is part of a sum.
    is_part: Vec<bool>,
}

impl Contractions {
    /// The contractions of a function.
    pub fn of(function: &Function) -> Contractions {
        let n = function.code.len();
        let mut all = Contractions {
            sums: vec![None; n],
            is_part: vec![false; n],
        };
        for (index, side) in fused(function).into_iter().enumerate() {
            let op = &function.code[index];
            let (Op::Add(left, right) | Op::Sub(left, right), Some(side)) = (op, side) else {
                continue;
            };
            let (product, term) = match side {
                Side::Left => (*left, *right),
                Side::Right => (*right, *left),
            };
            let Op::Mul(a, b) = *function.op(product) else {
                continue;
            };
            let kind = match (op, side) {
                (Op::Add(..), _) => Contracted::Add,
                (_, Side::Left) => Contracted::Sub,
                (_, Side::Right) => Contracted::SubFrom,
            };
            all.is_part[product.index()] = true;
            all.sums[index] = Some(Contraction {
                kind,
                factors: [a, b],
                term,
            });
        }
        all
    }

    /// No contractions: every operation stands by itself.
    pub fn none(function: &Function) -> Contractions {
        let n = function.code.len();
        Contractions {
            sums: vec![None; n],
            is_part: vec![false; n],
        }
    }

    /// The contraction in a sum, if a product is contracted into it.
    pub fn sum(&self, value: Value) -> Option<Contraction> {
        self.sums[value.index()]
    }

    /// Whether a value is a product that the sum using it computes.
    pub fn is_part(&self, value: Value) -> bool {
        self.is_part[value.index()]
    }
}

/// The times at which values are known.
pub struct Timing {
    /// The result of [`fused`].
    pub fused: Vec<Option<Side>>,
    /// For each operation, how long after the arguments its value is known if only its operands
    /// delay it, in tenths of a cycle.
    pub ready: Vec<u64>,
}

impl Timing {
    pub fn of(function: &Function) -> Timing {
        let uses = uses(function);
        let code = &function.code;
        let mut timing = Timing {
            fused: Vec::with_capacity(code.len()),
            ready: Vec::with_capacity(code.len()),
        };
        for op in code {
            // When the factors of a product that can be contracted are known.
            let factors = |value: Value| match function.op(value) {
                Op::Mul(a, b) if uses[value.index()] == 1 => {
                    Some(timing.ready_time(*a).max(timing.ready_time(*b)))
                }
                _ => None,
            };
            let (side, start) = match op {
                Op::Add(a, b) | Op::Sub(a, b) => match (factors(*a), factors(*b)) {
                    (Some(left), Some(right)) if left < right => {
                        (Some(Side::Right), right.max(timing.ready_time(*a)))
                    }
                    (Some(left), _) => (Some(Side::Left), left.max(timing.ready_time(*b))),
                    (None, Some(right)) => (Some(Side::Right), right.max(timing.ready_time(*a))),
                    (None, None) => (None, timing.latest(op)),
                },
                _ => (None, timing.latest(op)),
            };
            timing.fused.push(side);
            timing.ready.push(start + latency(op));
        }
        timing
    }

    fn ready_time(&self, value: Value) -> u64 {
        self.ready[value.index()]
    }

    /// When the last operand is known.
    fn latest(&self, op: &Op) -> u64 {
        let known = op.operands().map(|operand| self.ready_time(operand));
        known.max().unwrap_or(0)
    }
}

/// For each operation, how long after the arguments its value is known if only its operands delay
/// it, in tenths of a cycle.
pub fn ready_times(function: &Function) -> Vec<u64> {
    Timing::of(function).ready
}

/// How often each value is used: by operations and guards, and as a result.
pub fn uses(function: &Function) -> Vec<u32> {
    let mut uses = vec![0; function.code.len()];
    let operands = function.code.iter().flat_map(Op::operands);
    let guards = function.guards.iter();
    let guarded = guards.flat_map(|guard| [guard.pivot, guard.scale]);
    let results = function.results.iter().copied();
    for value in operands.chain(guarded).chain(results) {
        uses[value.index()] += 1;
    }
    uses
}

#[cfg(test)]
mod tests {
    use super::super::{Role, Shape, Source};
    use super::*;

    /// A function of coordinates 0, 1, 2 and more operations, the last of which are results.
    fn function(more: &[Op], results: usize) -> Function {
        let mut code: Vec<Op> = (0..3).map(|i| Op::Read(Source::Coordinate(i))).collect();
        code.extend_from_slice(more);
        let first = code.len() - results;
        Function {
            role: Role::Output(0),
            shape: Shape::Vector(results),
            results: (first..code.len())
                .map(|index| Value(index as u32))
                .collect(),
            code,
            guards: Vec::new(),
            steps: Vec::new(),
        }
    }

    fn v(index: u32) -> Value {
        Value(index)
    }

    #[test]
    fn a_product_used_once_is_contracted() {
        let left = function(&[Op::Mul(v(0), v(1)), Op::Sub(v(3), v(2))], 1);
        assert_eq!(fused(&left)[4], Some(Side::Left));
        let right = function(&[Op::Mul(v(0), v(1)), Op::Sub(v(2), v(3))], 1);
        assert_eq!(fused(&right)[4], Some(Side::Right));
        // With or without contraction, only the sum has an entry.
        assert_eq!(fused(&right)[..4], [None; 4]);
    }

    #[test]
    fn a_product_used_again_is_not() {
        let result = function(&[Op::Mul(v(0), v(1)), Op::Add(v(2), v(3))], 2);
        assert_eq!(fused(&result)[4], None);
        let doubled = function(&[Op::Mul(v(0), v(1)), Op::Add(v(3), v(3))], 1);
        assert_eq!(fused(&doubled)[4], None);
        let operations = [
            Op::Mul(v(0), v(1)),
            Op::Add(v(2), v(3)),
            Op::Sub(v(4), v(3)),
        ];
        assert_eq!(fused(&function(&operations, 1)), [None; 6]);
    }

    #[test]
    fn of_two_products_the_later_one_is_contracted() {
        // x·y + z·sin(x): the sine takes longer.
        let later = [
            Op::Mul(v(0), v(1)),
            Op::Sin(v(0)),
            Op::Mul(v(2), v(4)),
            Op::Add(v(3), v(5)),
        ];
        assert_eq!(fused(&function(&later, 1))[6], Some(Side::Right));
        let equal = [
            Op::Mul(v(0), v(1)),
            Op::Mul(v(1), v(2)),
            Op::Sub(v(3), v(4)),
        ];
        assert_eq!(fused(&function(&equal, 1))[5], Some(Side::Left));
    }
}
