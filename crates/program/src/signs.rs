//! Removes opposites: where `x` and `−x` are both computed or prepared, one of them is removed if its users can absorb the sign.
//!
//! A sign passes through products and quotients, and vanishes in sums: `a + b` with `−b` at hand is `a − (−b)`, and `a − b` is
//! `−(b − a)`. So a value is replaced by its opposite, and the sign is passed from user to user until sums have absorbed all of
//! it. A number and its opposite are rounded alike, so nothing is lost. A change is kept only if no function gets longer or slower:
//! a sign that reaches a result would have to be changed there.

use std::collections::{BTreeMap, BTreeSet};

use rustc_hash::FxHashMap;

use super::selection::without_unused;
use super::verify::check_prepared_operations;
use super::{Function, Guard, Op, Program, Role, Source, Value};

/// Longer functions are left as they are: they are written as loops or in pieces, for which related operations must stay alike.
const LONGEST: usize = 2000;

/// The most users to which the sign of a value is passed on.
const MOST_USERS: usize = 200;

impl Program {
    /// Removes values that are the opposites of others where that costs nothing.
    pub fn settle_signs(&mut self) {
        for function in &mut self.functions {
            settle(function);
        }
        self.replace_prepared_opposites();
        self.keep_read_slots();
        for choice in &mut self.choices {
            let role = choice.role();
            let chosen = &mut choice.candidates[choice.chosen];
            if let Some(function) = self.functions.iter().find(|f| f.role == role) {
                (chosen.counts, chosen.cost) = (function.counts(), function.cost());
            }
        }
    }

    /// Reads one prepared value instead of two that are opposites.
    ///
    /// What a spec asks for besides changes nothing here: functions that it requests keep what they read, and values that only
    /// they read are not considered.
    fn replace_prepared_opposites(&mut self) {
        let functions = self.functions.iter().filter(|f| !is_requested(f.role));
        let reads = functions.flat_map(|function| &function.code);
        let read: BTreeSet<u32> = reads
            .filter_map(|op| match op {
                Op::Read(Source::Prepared(slot)) => Some(*slot),
                _ => None,
            })
            .collect();
        let prepare = &self.prepare;
        let mut slot_of: BTreeMap<Value, u32> = BTreeMap::new();
        for (value, slot) in prepare.results.iter().zip(0..) {
            if read.contains(&slot) {
                slot_of.entry(*value).or_insert(slot);
            }
        }
        let opposites = prepare.results.iter().zip(0..).filter_map(|(value, slot)| {
            let Op::Neg(of) = prepare.op(*value) else {
                return None;
            };
            let positive = *slot_of.get(of)?;
            read.contains(&slot).then_some((slot, positive))
        });
        let opposites: Vec<(u32, u32)> = opposites.collect();
        let mut gone: BTreeSet<u32> = BTreeSet::new();
        for (negative, positive) in opposites {
            for (dropped, kept) in [(negative, positive), (positive, negative)] {
                if gone.contains(&kept) || gone.contains(&dropped) {
                    continue;
                }
                if let Some(changed) = self.without(dropped, kept) {
                    for (place, function) in changed {
                        self.functions[place] = function;
                    }
                    gone.insert(dropped);
                }
            }
        }
    }

    /// The functions that read a prepared value, with the opposite of another in its place; `None` if one of them gets longer or
    /// slower.
    fn without(&self, dropped: u32, kept: u32) -> Option<Vec<(usize, Function)>> {
        let read = Op::Read(Source::Prepared(dropped));
        let mut changed = Vec::new();
        let functions = self.functions.iter().enumerate();
        for (index, function) in functions.filter(|(_, f)| !is_requested(f.role)) {
            let Some(place) = function.code.iter().position(|op| *op == read) else {
                continue;
            };
            if function.code.len() > LONGEST {
                return None;
            }
            let other = Replacement::Op(Op::Read(Source::Prepared(kept)));
            changed.push((index, with_opposite(function, Value(place as u32), other)?));
        }
        Some(changed)
    }
}

/// Whether a program has a function only if its spec asks for it.
fn is_requested(role: Role) -> bool {
    matches!(
        role,
        Role::Derivatives
            | Role::Projection
            | Role::AtTime
            | Role::AtPosition
            | Role::AccelerationsAt
    )
}

/// What takes the place of a value: its opposite.
enum Replacement {
    Op(Op),
    Value(Value),
}

/// Removes operations whose opposites are there as well, and changes of sign.
fn settle(function: &mut Function) {
    if function.code.len() > LONGEST {
        return;
    }
    let mut next = 0;
    while next < function.code.len() {
        let value = Value(next as u32);
        let replacement = match *function.op(value) {
            Op::Neg(a) => Some(Replacement::Value(a)),
            Op::Sub(a, b) if function.code[..next].contains(&Op::Sub(b, a)) => {
                Some(Replacement::Op(Op::Sub(b, a)))
            }
            _ => None,
        };
        let shorter = replacement.and_then(|other| {
            let shorter = with_opposite(function, value, other)?;
            (shorter.counts().ops() < function.counts().ops()).then_some(shorter)
        });
        match shorter {
            // Operations before this one are unchanged.
            Some(shorter) => *function = shorter,
            None => next += 1,
        }
    }
}

/// The function with a value replaced by its opposite; `None` if a sign cannot be absorbed, if it gets longer or slower, or if an
/// operation would only combine prepared values, as the product of one with its opposite does.
fn with_opposite(function: &Function, value: Value, other: Replacement) -> Option<Function> {
    let mut signs = Signs {
        function,
        code: function.code.clone(),
        places: (0..function.code.len() as u32).map(Value).collect(),
        negative: BTreeSet::new(),
    };
    match other {
        Replacement::Op(op) => signs.code[value.index()] = op,
        Replacement::Value(other) => signs.places[value.index()] = other,
    }
    signs.negative.insert(value);
    signs.pass_on(value)?;
    let changed = signs.rebuilt();
    let [before, after] = [function, &changed].map(|function| function.counts().ops());
    let is_slower = function.cost().compare(changed.cost()).is_lt();
    let prepared = check_prepared_operations(&changed.code);
    (after <= before && !is_slower && prepared.is_ok()).then_some(changed)
}

/// A function in which some values are replaced by their opposites.
struct Signs<'a> {
    function: &'a Function,
    code: Vec<Op>,
    /// The value that takes the place of each.
    places: Vec<Value>,
    /// The values that are now the opposites of what they were.
    negative: BTreeSet<Value>,
}

impl Signs<'_> {
    /// Passes the sign of a value on to all that use it.
    fn pass_on(&mut self, from: Value) -> Option<()> {
        let mut users = 0;
        for index in from.index() + 1..self.code.len() {
            let value = Value(index as u32);
            let op = &self.function.code[index];
            let [a, b] = signs_of(op, &self.negative);
            if !a && !b {
                continue;
            }
            users += 1;
            if users > MOST_USERS {
                return None;
            }
            let (op, is_negative) = match (op.clone(), a, b) {
                (Op::Neg(x), ..) => {
                    self.places[index] = x;
                    continue;
                }
                (Op::Mul(x, y), ..) => (Op::Mul(x, y), a != b),
                (Op::Div(x, y), ..) => (Op::Div(x, y), a != b),
                (Op::Add(x, y), true, true) => (Op::Add(x, y), true),
                (Op::Add(x, y), true, false) => (Op::Sub(y, x), false),
                (Op::Add(x, y), false, _) => (Op::Sub(x, y), false),
                (Op::Sub(x, y), true, true) => (Op::Sub(y, x), false),
                (Op::Sub(x, y), true, false) => (Op::Add(x, y), true),
                (Op::Sub(x, y), false, _) => (Op::Add(x, y), false),
                // Other functions would need the sign changed first.
                _ => return None,
            };
            self.code[index] = op;
            if is_negative {
                self.negative.insert(value);
            }
        }
        let guards = self.function.guards.iter();
        let mut guarded = guards.flat_map(|guard| [guard.pivot, guard.scale]);
        (!guarded.any(|value| self.negative.contains(&value))).then_some(())
    }

    /// The function with every operation once, and without those that nothing needs.
    fn rebuilt(&self) -> Function {
        let mut code: Vec<Op> = Vec::with_capacity(self.code.len());
        let mut known: FxHashMap<Op, Value> = FxHashMap::default();
        let mut moved: Vec<Value> = Vec::with_capacity(self.code.len());
        let mut push = |code: &mut Vec<Op>, op: Op| {
            *known.entry(op.clone()).or_insert_with(|| {
                code.push(op);
                Value(code.len() as u32 - 1)
            })
        };
        for (index, op) in self.code.iter().enumerate() {
            let place = self.places[index];
            if place.index() != index {
                moved.push(moved[place.index()]);
                continue;
            }
            let op = match op.with_operands(|operand| moved[operand.index()]) {
                Op::Add(a, b) if b < a => Op::Add(b, a),
                Op::Mul(a, b) if b < a => Op::Mul(b, a),
                op => op,
            };
            let value = push(&mut code, op);
            moved.push(value);
        }
        let results = self.function.results.iter().map(|result| {
            let value = moved[result.index()];
            if self.negative.contains(result) {
                push(&mut code, Op::Neg(value))
            } else {
                value
            }
        });
        let results = results.collect();
        let guards = self.function.guards.iter().map(|guard| Guard {
            pivot: moved[guard.pivot.index()],
            scale: moved[guard.scale.index()],
            ..*guard
        });
        let steps = self.function.steps.iter();
        let steps = steps.map(|(value, step)| (moved[value.index()], *step));
        without_unused(Function {
            role: self.function.role,
            code,
            shape: self.function.shape,
            results,
            guards: guards.collect(),
            steps: steps.collect(),
        })
    }
}

/// Whether the operands of an operation are the opposites of what they were.
fn signs_of(op: &Op, negative: &BTreeSet<Value>) -> [bool; 2] {
    let mut signs = op.operands().map(|operand| negative.contains(&operand));
    [signs.next(), signs.next()].map(|sign| sign.unwrap_or(false))
}

#[cfg(test)]
mod tests {
    use super::super::Shape;
    use super::*;

    /// A function of coordinates 0 to 3, which are its first operations.
    fn function(operations: Vec<Op>, results: &[u32]) -> Function {
        let reads = (0..4).map(|index| Op::Read(Source::Coordinate(index)));
        Function {
            role: Role::Applied,
            shape: Shape::Vector(results.len()),
            code: reads.chain(operations).collect(),
            results: results.iter().map(|index| Value(*index)).collect(),
            guards: Vec::new(),
            steps: Vec::new(),
        }
    }

    /// The results at some coordinates.
    fn values(function: &Function) -> Vec<f64> {
        let q = [0.7, -1.3, 2.1, 0.4];
        let mut values: Vec<f64> = Vec::new();
        for op in &function.code {
            let of = |value: &Value| values[value.index()];
            values.push(match op {
                Op::Read(Source::Coordinate(index)) => q[*index as usize],
                Op::Add(a, b) => of(a) + of(b),
                Op::Sub(a, b) => of(a) - of(b),
                Op::Mul(a, b) => of(a) * of(b),
                Op::Neg(a) => -of(a),
                Op::Sin(a) => of(a).sin(),
                other => panic!("{other:?} is not in this test"),
            });
        }
        let results = function.results.iter();
        results.map(|value| values[value.index()]).collect()
    }

    #[test]
    fn a_difference_and_its_opposite_become_one() {
        // (a − b) c + d and (b − a) d + c
        let [a, b, c, d] = [0, 1, 2, 3].map(Value);
        let mut twins = function(
            vec![
                Op::Sub(a, b),
                Op::Mul(c, Value(4)),
                Op::Add(d, Value(5)),
                Op::Sub(b, a),
                Op::Mul(d, Value(7)),
                Op::Add(c, Value(8)),
            ],
            &[6, 9],
        );
        let before = (values(&twins), twins.counts().ops());
        settle(&mut twins);
        assert_eq!(values(&twins), before.0);
        assert_eq!(twins.counts().ops(), before.1 - 1);
    }

    #[test]
    fn a_prepared_value_is_not_multiplied_by_itself() {
        // p (−p) + c, where −p of a prepared p is an operation, and p² would be one that could be prepared.
        let c = Value(2);
        let before = function(
            vec![
                Op::Read(Source::Prepared(0)),
                Op::Neg(Value(4)),
                Op::Mul(Value(4), Value(5)),
                Op::Add(c, Value(6)),
            ],
            &[7],
        );
        assert_eq!(check_prepared_operations(&before.code), Ok(()));
        let mut after = before.clone();
        settle(&mut after);
        assert_eq!(check_prepared_operations(&after.code), Ok(()));
        assert_eq!(after, before);
    }

    #[test]
    fn a_sign_that_reaches_a_result_or_a_sine_stays() {
        let [a, b, c, _] = [0, 1, 2, 3].map(Value);
        for last in [Op::Mul(c, Value(5)), Op::Sin(Value(5))] {
            let before = function(
                vec![Op::Sub(a, b), Op::Sub(b, a), last, Op::Add(a, Value(4))],
                &[6, 7],
            );
            let mut after = before.clone();
            settle(&mut after);
            assert_eq!(after, before);
        }
    }
}
