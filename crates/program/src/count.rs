//! Counts the operations of a function.

use std::fmt;
use std::ops::AddAssign;

use rustc_hash::FxHashSet;

use super::{Function, Op};

/// Operations by kind. Reading arguments and constants costs nothing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Multiplications.
    pub multiplications: usize,
    /// Additions, subtractions, changes of sign.
    pub additions: usize,
    /// Divisions.
    pub divisions: usize,
    /// Angles whose sine, cosine or both are taken.
    pub sincos: usize,
    /// Other functions: roots, powers, arctangents, …
    pub other: usize,
    /// Comparisons of pivots.
    pub guards: usize,
}

impl Counts {
    /// The operations of one call.
    pub fn of(function: &Function) -> Counts {
        let mut counts = Counts {
            guards: function.guards.len(),
            ..Counts::default()
        };
        let mut angles = FxHashSet::default();
        for op in &function.code {
            match op {
                Op::Constant(_) | Op::Pi | Op::Read(_) => {}
                Op::Add(..) | Op::Sub(..) | Op::Neg(_) => counts.additions += 1,
                Op::Mul(..) => counts.multiplications += 1,
                // A product error takes one fused operation; a sum error three sums, and three more
                // for the order of the terms.
                Op::ProductError(..) => counts.multiplications += 1,
                Op::SumError(..) => counts.additions += 6,
                Op::Div(..) => counts.divisions += 1,
                Op::Sin(angle) | Op::Cos(angle) => {
                    counts.sincos += usize::from(angles.insert(*angle))
                }
                Op::Unary(..) | Op::Binary(..) => counts.other += 1,
            }
        }
        counts
    }

    /// Multiplications and additions: the "ops" in comparisons of programs.
    pub fn ops(&self) -> usize {
        self.multiplications + self.additions
    }

    /// An estimate of the time of a call, in tenths of a processor cycle, for choosing between programs.
    ///
    /// By throughput on a current x86 core: 2.5 multiplications or additions a cycle, 4.5 cycles
    /// for a division, 12 for a group of four sines and cosines. Other functions are counted like a
    /// sine and cosine computed alone.
    pub fn cost(&self) -> usize {
        4 * self.ops() + 45 * self.divisions + 30 * self.sincos + 120 * self.other
    }
}

impl AddAssign for Counts {
    fn add_assign(&mut self, other: Counts) {
        self.multiplications += other.multiplications;
        self.additions += other.additions;
        self.divisions += other.divisions;
        self.sincos += other.sincos;
        self.other += other.other;
        self.guards += other.guards;
    }
}

/// `12 mul, 7 add, 1 div, 2 sincos`, without kinds that do not occur; `no operations`.
impl fmt::Display for Counts {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let kinds = [
            (self.multiplications, "mul"),
            (self.additions, "add"),
            (self.divisions, "div"),
            (self.sincos, "sincos"),
            (self.other, "other"),
            (self.guards, "guards"),
        ];
        let parts: Vec<String> = kinds
            .iter()
            .filter(|(n, _)| *n > 0)
            .map(|(n, kind)| format!("{n} {kind}"))
            .collect();
        if parts.is_empty() {
            f.write_str("no operations")
        } else {
            f.write_str(&parts.join(", "))
        }
    }
}
