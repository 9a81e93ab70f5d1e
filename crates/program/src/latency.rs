//! Latencies of operations, by the table of [`Cost`](crate::Cost).

use lagrangian_symbolic as symbolic;

use super::Op;

/// The latency of an operation, from its operands to its value, in tenths of a processor cycle.
pub fn latency(op: &Op) -> u64 {
    use symbolic::Function::{Abs, Max, Min, Sign, Sqrt};
    match op {
        Op::Constant(_) | Op::Pi | Op::Read(_) => 0,
        Op::Add(..) | Op::Sub(..) | Op::Neg(_) | Op::Mul(..) => 40,
        Op::Unary(Abs | Sign, _) | Op::Binary(Min | Max, ..) => 40,
        Op::ProductError(..) => 40,
        Op::SumError(..) => 160,
        Op::Div(..) => 130,
        Op::Unary(Sqrt, _) => 180,
        Op::Sin(_) | Op::Cos(_) | Op::Unary(..) | Op::Binary(..) => 450,
    }
}
