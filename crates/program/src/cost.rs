//! Estimates the time of a function, to choose between programs.
//!
//! A processor works on many operations at once, so two things bound the time of a call: the work,
//! divided by the throughput, and the latency of the longest chain of dependent operations. A
//! single call takes about the larger of the two. If many calls run side by side, as in lanes,
//! latencies are hidden, and only the work counts.
//!
//! The figures are those of current x86 cores with two units for floating-point arithmetic (A. Fog,
//! *Instruction tables*, Technical University of Denmark), and measurements with emitted code for
//! the rest:
//!
//! | operation | cycles of work | cycles of latency |
//! | --- | --- | --- |
//! | multiplication, addition, fused multiply-add | 0.4 | 4 |
//! | division | 4.5 | 13 |
//! | square root | 4.5 | 18 |
//! | sine and cosine | 12 for every four angles | 45 |
//! | other functions | 12 | 45 |
//! | comparison of a pivot | 0.8 | – |

use std::cmp::Ordering;
use std::fmt;

use lagrangian_symbolic as symbolic;

use super::fusion::Timing;
use super::{Counts, Function, Op};

/// Sines and cosines that are computed together.
const PACK: usize = 4;

/// The estimated time of a function, in tenths of a processor cycle.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Cost {
    /// Its work: the time of a call among many that run side by side.
    pub throughput: u64,
    /// The latency of the longest chain of dependent operations.
    pub path: u64,
}

impl Cost {
    /// The cost of a call.
    ///
    /// [Contracted](super::fused()) products add nothing to the additions that absorb them.
    pub fn of(function: &Function) -> Cost {
        let timing = Timing::of(function);
        let contracted = timing.fused.iter().flatten().count() as u64;
        let work: u64 = function.code.iter().map(work).sum();
        // Sines and cosines are counted by angle, not by operation.
        let counts = Counts::of(function);
        let angles = 120 * counts.sincos.div_ceil(PACK) as u64;
        let guards = 8 * counts.guards as u64;
        let results = function.results.iter();
        Cost {
            throughput: work + angles + guards - ARITHMETIC * contracted,
            path: results
                .map(|result| timing.ready[result.index()])
                .max()
                .unwrap_or(0),
        }
    }

    /// The time of a single call.
    pub fn single_call(self) -> u64 {
        self.throughput.max(self.path)
    }

    /// Orders two programs by the sum of the time of a single call and that of a call among others,
    /// since one program serves for both.
    pub fn compare(self, other: Cost) -> Ordering {
        let both = |cost: Cost| cost.single_call() + cost.throughput;
        both(self).cmp(&both(other))
    }
}

/// `130 cycles alone, 63 among others`.
impl fmt::Display for Cost {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (alone, among_others) = (cycles(self.single_call()), cycles(self.throughput));
        write!(f, "{alone} cycles alone, {among_others} among others")
    }
}

/// Whole cycles, rounded up.
pub fn cycles(tenths: u64) -> String {
    tenths.div_ceil(10).to_string()
}

/// The work of a multiplication or an addition.
const ARITHMETIC: u64 = 4;

/// The work of an operation. Sines and cosines are counted by angle.
fn work(op: &Op) -> u64 {
    use symbolic::Function::{Abs, Max, Min, Sign, Sqrt};
    match op {
        Op::Constant(_) | Op::Pi | Op::Read(_) | Op::Sin(_) | Op::Cos(_) => 0,
        Op::Add(..) | Op::Sub(..) | Op::Neg(_) | Op::Mul(..) => ARITHMETIC,
        Op::ProductError(..) => ARITHMETIC,
        Op::SumError(..) => 6 * ARITHMETIC,
        Op::Unary(Abs | Sign, _) | Op::Binary(Min | Max, ..) => ARITHMETIC,
        Op::Div(..) | Op::Unary(Sqrt, _) => 45,
        Op::Unary(..) | Op::Binary(..) => 120,
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Role, Shape, Source, Value};
    use super::*;

    fn cost(code: Vec<Op>) -> Cost {
        let last = Value(code.len() as u32 - 1);
        Cost::of(&Function {
            role: Role::Output(0),
            code,
            shape: Shape::Scalar,
            results: vec![last],
            guards: Vec::new(),
            steps: Vec::new(),
        })
    }

    fn read(index: u32) -> Op {
        Op::Read(Source::Coordinate(index))
    }

    #[test]
    fn a_contracted_product_is_free_on_both_scales() {
        // x·y + x
        let sum = Op::Add(Value(2), Value(0));
        let fused = vec![read(0), read(1), Op::Mul(Value(0), Value(1)), sum];
        let expected = Cost {
            throughput: 4,
            path: 40,
        };
        assert_eq!(cost(fused), expected);
    }

    #[test]
    fn sines_of_four_angles_cost_as_much_as_one_of_one() {
        let of = |angles: u32| {
            let mut code: Vec<Op> = (0..angles).map(read).collect();
            code.extend((0..angles).map(|angle| Op::Sin(Value(angle))));
            // Their product, as a chain.
            for factor in 1..angles {
                let product = if factor == 1 {
                    angles
                } else {
                    2 * angles + factor - 2
                };
                code.push(Op::Mul(Value(product), Value(angles + factor)));
            }
            cost(code)
        };
        assert_eq!((of(1).throughput, of(1).path), (120, 450));
        assert_eq!((of(4).throughput, of(4).path), (120 + 12, 450 + 120));
        assert_eq!(of(5).throughput, 240 + 16);
    }

    #[test]
    fn a_chain_of_divisions_waits_and_alone_says_so() {
        let mut code = vec![read(0)];
        code.extend((0..5).map(|index| Op::Div(Value(index), Value(0))));
        let cost = cost(code);
        assert_eq!((cost.throughput, cost.path), (225, 650));
        assert_eq!(cost.single_call(), 650);
    }
}
