//! Functions that are too long for a compiler, cut into pieces.
//!
//! The Rust compiler treats every `let` as a scope of its own, and its code generator descends into scopes recursively:
//! some thousand in one function overflow its stack. Before that, compile time grows faster than length. The pieces pass
//! their results on in an array `w`, which holds only values that are still needed.

use rustc_hash::FxHashMap;

use lagrangian_program::{Function, Guard, Op, Shape, Source, Value};

/// The most operations of a function that is not cut, by default. Compilers handle this length well, and the calls
/// of pieces cost nothing.
pub const LONGEST_WHOLE: usize = 2000;

/// The most and the fewest operations of a piece; in between it ends where the fewest values are live.
const LONGEST_PIECE: usize = 500;
const SHORTEST_PIECE: usize = 350;

/// A function cut into pieces.
pub struct Cut {
    /// The pieces, in the order in which they run.
    pub pieces: Vec<Piece>,
    /// The length of `w`.
    pub slots: usize,
    /// The results of the function.
    pub results: Vec<CutResult>,
}

/// A piece: a function whose results go to slots of `w`. It reads slot k as prepared value `first + k`, where `first` is the
/// number of prepared values.
pub struct Piece {
    /// The operations of the piece.
    pub function: Function,
    /// The slot of `w` for each of its results.
    pub result_slots: Vec<usize>,
}

/// Where a result is found after all pieces have run.
pub enum CutResult {
    /// In `w`.
    Slot(usize),
    /// An argument or a constant.
    Leaf(Op),
}

/// Cuts a function if it has more operations than `longest`.
pub fn cut(function: &Function, first: usize, longest: usize) -> Option<Cut> {
    let is_long = function.code.iter().filter(|op| !is_leaf(op)).count() > longest;
    is_long.then(|| Cutter::new(function, first).cut())
}

fn is_leaf(op: &Op) -> bool {
    matches!(op, Op::Constant(_) | Op::Pi | Op::Read(_))
}

struct Cutter<'a> {
    function: &'a Function,
    first: usize,
    /// For each value the index of the last operation that needs it; for results an index past all operations.
    last_use: Vec<usize>,
    /// The slots of values that earlier pieces have stored.
    slots: FxHashMap<Value, usize>,
    free: Vec<usize>,
    count: usize,
}

impl<'a> Cutter<'a> {
    fn new(function: &'a Function, first: usize) -> Cutter<'a> {
        let n = function.code.len();
        let mut last_use = vec![0; n];
        for (index, op) in function.code.iter().enumerate() {
            op.operands()
                .for_each(|value| last_use[value.index()] = index);
        }
        for guard in &function.guards {
            let checked = checked_at(guard);
            for value in [guard.pivot, guard.scale] {
                last_use[value.index()] = last_use[value.index()].max(checked);
            }
        }
        function
            .results
            .iter()
            .for_each(|value| last_use[value.index()] = n);
        Cutter {
            function,
            first,
            last_use,
            slots: FxHashMap::default(),
            free: Vec::new(),
            count: 0,
        }
    }

    fn cut(mut self) -> Cut {
        let mut pieces = Vec::new();
        let mut start = 0;
        for end in self.ends() {
            pieces.push(self.piece(start, end));
            start = end;
        }
        let place = |value: &Value| match self.slots.get(value) {
            Some(&slot) => CutResult::Slot(slot),
            None => CutResult::Leaf(self.function.op(*value).clone()),
        };
        Cut {
            results: self.function.results.iter().map(place).collect(),
            pieces,
            slots: self.count,
        }
    }

    /// Where the pieces end.
    fn ends(&self) -> Vec<usize> {
        let code = &self.function.code;
        // The number of values that are computed before an operation and needed by it or later ones.
        let mut live = vec![0isize; code.len() + 2];
        for (index, op) in code.iter().enumerate().filter(|(_, op)| !is_leaf(op)) {
            live[index + 1] += isize::from(!is_leaf(op));
            live[self.last_use[index].max(index) + 1] -= 1;
        }
        let mut alive = 0;
        let live: Vec<isize> = live
            .into_iter()
            .map(|change| {
                alive += change;
                alive
            })
            .collect();
        let mut ends = Vec::new();
        let mut length = 0;
        let mut best: Option<usize> = None;
        for (index, op) in code.iter().enumerate() {
            length += usize::from(!is_leaf(op));
            let end = index + 1;
            if length >= SHORTEST_PIECE && best.is_none_or(|best| live[end] < live[best]) {
                best = Some(end);
            }
            if let Some(end) = best.filter(|_| length >= LONGEST_PIECE) {
                ends.push(end);
                length = code[end..=index].iter().filter(|op| !is_leaf(op)).count();
                best = None;
            }
        }
        if ends.last() != Some(&code.len()) {
            ends.push(code.len());
        }
        ends
    }

    /// The piece of the operations `start..end`.
    fn piece(&mut self, start: usize, end: usize) -> Piece {
        let function = self.function;
        let mut piece = Builder {
            cutter: self,
            code: Vec::new(),
            values: FxHashMap::default(),
        };
        for index in start..end {
            let value = Value(index as u32);
            // The piece that has the sine or the cosine has stored its partner too.
            if !is_leaf(function.op(value)) && !piece.cutter.slots.contains_key(&value) {
                piece.take(value);
            }
        }
        let guards: Vec<Guard> = function
            .guards
            .iter()
            .filter(|guard| (start..end).contains(&checked_at(guard)))
            .map(|guard| Guard {
                pivot: piece.value(guard.pivot),
                scale: piece.value(guard.scale),
                ..*guard
            })
            .collect();
        let Builder { code, values, .. } = piece;
        let mut kept: Vec<Value> = values
            .keys()
            .copied()
            .filter(|&value| !is_leaf(function.op(value)) && self.last_use[value.index()] >= end)
            .filter(|value| !self.slots.contains_key(value))
            .collect();
        kept.sort_unstable();
        let results: Vec<Value> = kept.iter().map(|value| values[value]).collect();
        let own = function.steps.iter();
        let own = own.filter(|(value, _)| (start..end).contains(&value.index()));
        let steps = own.filter_map(|(value, step)| Some((*values.get(value)?, *step)));
        let mut steps: Vec<_> = steps.collect();
        steps.sort_unstable();
        let keeps: Vec<usize> = kept.iter().map(|&value| self.store(value)).collect();
        // Slots of values that are no longer needed become free, but only for the pieces after this one.
        let last_use = &self.last_use;
        let mut dead: Vec<Value> = self
            .slots
            .keys()
            .copied()
            .filter(|value| last_use[value.index()] < end)
            .collect();
        dead.sort_unstable();
        for value in dead {
            self.free.extend(self.slots.remove(&value));
        }
        let shape = Shape::Vector(results.len());
        Piece {
            function: Function {
                role: function.role,
                code,
                shape,
                results,
                guards,
                steps,
            },
            result_slots: keeps,
        }
    }

    fn store(&mut self, value: Value) -> usize {
        let slot = self.free.pop().unwrap_or_else(|| {
            self.count += 1;
            self.count - 1
        });
        self.slots.insert(value, slot);
        slot
    }
}

/// The index of the operation after which a guard can be checked.
fn checked_at(guard: &Guard) -> usize {
    guard.pivot.index().max(guard.scale.index())
}

/// The code of a piece under construction.
struct Builder<'c, 'a> {
    cutter: &'c mut Cutter<'a>,
    code: Vec<Op>,
    /// The values of the whole function, as values of the piece.
    values: FxHashMap<Value, Value>,
}

impl Builder<'_, '_> {
    /// Appends an operation to the piece, with the partner of a sine or cosine.
    fn take(&mut self, value: Value) {
        if self.values.contains_key(&value) {
            return;
        }
        let op = self.cutter.function.op(value).clone();
        let mapped = match op {
            Op::Constant(_) | Op::Pi | Op::Read(_) => op.clone(),
            Op::Add(a, b) => Op::Add(self.value(a), self.value(b)),
            Op::Sub(a, b) => Op::Sub(self.value(a), self.value(b)),
            Op::Mul(a, b) => Op::Mul(self.value(a), self.value(b)),
            Op::Div(a, b) => Op::Div(self.value(a), self.value(b)),
            Op::Neg(a) => Op::Neg(self.value(a)),
            Op::ProductError(a, b) => Op::ProductError(self.value(a), self.value(b)),
            Op::SumError(a, b) => Op::SumError(self.value(a), self.value(b)),
            Op::Sin(a) => Op::Sin(self.value(a)),
            Op::Cos(a) => Op::Cos(self.value(a)),
            Op::Unary(function, a) => Op::Unary(function, self.value(a)),
            Op::Binary(function, a, b) => Op::Binary(function, self.value(a), self.value(b)),
        };
        self.push(value, mapped);
        let partner = match op {
            Op::Sin(angle) => Op::Cos(angle),
            Op::Cos(angle) => Op::Sin(angle),
            _ => return,
        };
        let code = &self.cutter.function.code;
        if let Some(partner) = code.iter().position(|op| *op == partner) {
            self.take(Value(partner as u32));
        }
    }

    /// A value in the piece: computed here, read again, or stored by an earlier piece.
    fn value(&mut self, value: Value) -> Value {
        if let Some(&known) = self.values.get(&value) {
            return known;
        }
        let op = match self.cutter.slots.get(&value) {
            Some(&slot) => Op::Read(Source::Prepared((self.cutter.first + slot) as u32)),
            None => self.cutter.function.op(value).clone(),
        };
        debug_assert!(
            is_leaf(&op),
            "{value:?} is computed by an earlier piece or this one"
        );
        self.push(value, op)
    }

    fn push(&mut self, value: Value, op: Op) -> Value {
        self.code.push(op);
        let mapped = Value(self.code.len() as u32 - 1);
        self.values.insert(value, mapped);
        mapped
    }
}

/// A function long enough to be cut, for tests: terms like `(sin(k q))²`, all needed for the sum at the end.
#[cfg(test)]
fn long_function(terms: usize) -> Function {
    let mut code = vec![Op::Read(Source::Coordinate(0))];
    let mut push = |op: Op| {
        code.push(op);
        Value(code.len() as u32 - 1)
    };
    let mut squares = Vec::new();
    for k in 0..terms {
        let factor = push(Op::Constant(lagrangian_symbolic::Rational::from(
            k as i64 + 2,
        )));
        let angle = push(Op::Mul(factor, Value(0)));
        let (sin, cos) = (push(Op::Sin(angle)), push(Op::Cos(angle)));
        squares.push(push(Op::Mul(sin, cos)));
    }
    let mut sum = squares[0];
    for &square in squares.iter().rev() {
        sum = push(Op::Add(sum, square));
    }
    let results = vec![sum, Value(0)];
    Function {
        role: lagrangian_program::Role::Applied,
        code,
        shape: Shape::Vector(2),
        results,
        guards: Vec::new(),
        steps: Vec::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Runs straight-line code; slots of `w` are passed as prepared values.
    fn run(function: &Function, q: f64, slots: &[f64]) -> Vec<f64> {
        let mut values: Vec<f64> = Vec::new();
        for op in &function.code {
            let of = |value: &Value| values[value.index()];
            values.push(match op {
                Op::Constant(value) => value.to_f64(),
                Op::Read(Source::Prepared(slot)) => slots[*slot as usize],
                Op::Read(_) => q,
                Op::Mul(a, b) => of(a) * of(b),
                Op::Add(a, b) => of(a) + of(b),
                Op::Sin(a) => of(a).sin(),
                Op::Cos(a) => of(a).cos(),
                other => panic!("{other:?} is not in this test"),
            });
        }
        function
            .results
            .iter()
            .map(|value| values[value.index()])
            .collect()
    }

    #[test]
    fn pieces_compute_what_the_whole_computes() {
        let whole = long_function(700);
        let cut = cut(&whole, 0, LONGEST_WHOLE).expect("2800 operations are cut");
        let mut w = vec![f64::NAN; cut.slots];
        for piece in &cut.pieces {
            assert!(
                piece.function.code.iter().filter(|op| !is_leaf(op)).count() <= LONGEST_PIECE + 1
            );
            let results = run(&piece.function, 0.3, &w);
            piece
                .result_slots
                .iter()
                .zip(results)
                .for_each(|(&slot, value)| w[slot] = value);
        }
        let results: Vec<f64> = cut
            .results
            .iter()
            .map(|place| match place {
                CutResult::Slot(slot) => w[*slot],
                CutResult::Leaf(_) => 0.3,
            })
            .collect();
        assert_eq!(results, run(&whole, 0.3, &[]));
    }

    #[test]
    fn short_functions_stay_whole() {
        assert!(cut(&long_function(100), 0, LONGEST_WHOLE).is_none());
    }
}
