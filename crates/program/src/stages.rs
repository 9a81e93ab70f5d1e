//! Divides the accelerations into stages: what depends on time alone, what depends on coordinates too,
//! and the rest, which is repeated when only rates change.
//!
//! ```text
//! t ─▶ at_time ─▶ values ─┐
//!                      q ─┴▶ at_position ─▶ values ─┐
//!                                           v, u ───┴▶ accelerations
//! ```
//!
//! A program is cut where the stage of its values changes; exactly the values that one part
//! computes and a later one reads are handed on. Before that, every product and every sum is
//! regrouped so that early operands, including divisors, are combined first: `v² m l cos θ` must
//! not begin with v², and `f/d` with only f changing becomes a multiplication by an earlier `1/d`.

use rustc_hash::FxHashMap;

use super::net::{Index, Item, Net, POSITION, Signed, Stage, TIME, stage_of};
use super::{Function, Guard, Op, Role, Shape, Source, Value};
use lagrangian_units::Stages;

/// The part that computes values of a stage.
pub fn part(apart: Stages, stage: Stage) -> usize {
    usize::from(apart.time && stage > TIME) + usize::from(apart.coordinates && stage > POSITION)
}

impl Net {
    /// Regroups products and sums by the parts that know their factors and terms.
    pub fn separate_stages(&mut self, apart: Stages) {
        self.separate = apart;
        for index in 0..self.items.len() {
            match self.items[index].clone() {
                Item::Product {
                    factors: up,
                    divisors: down,
                } => {
                    let (up, down) = self.product_by_parts(index as Index, up, down);
                    self.items[index] = Item::Product {
                        factors: up,
                        divisors: down,
                    };
                }
                Item::Sum(terms) => {
                    let terms = self.sum_by_parts(index as Index, terms);
                    self.items[index] = Item::Sum(terms);
                }
                Item::Leaf(_) | Item::Function(..) => {}
            }
        }
    }

    fn part_of(&self, index: Index) -> usize {
        part(self.separate, self.stages[index as usize])
    }

    /// The factors and divisors of a product; those of earlier parts form a product of their own.
    fn product_by_parts(
        &mut self,
        product: Index,
        mut up: Vec<Index>,
        mut down: Vec<Index>,
    ) -> (Vec<Index>, Vec<Index>) {
        for limit in 0..self.part_of(product) {
            let varies = |net: &Net, index: &Index| net.stages[*index as usize] > 0;
            let is_early = |net: &Net, index: &Index| net.part_of(*index) <= limit;
            let (early_up, late_up): (Vec<_>, Vec<_>) =
                up.iter().copied().partition(|index| is_early(self, index));
            let (early_down, late_down): (Vec<_>, Vec<_>) = down
                .iter()
                .copied()
                .partition(|index| is_early(self, index));
            // Values of parameters alone are prepared, and are no work for a part.
            let has_work = early_up.iter().chain(&early_down).any(|i| varies(self, i));
            if has_work && (early_up.len() > 1 || !early_down.is_empty()) {
                let early = self.add(Item::Product {
                    factors: early_up,
                    divisors: early_down,
                });
                up = late_up;
                up.push(early);
                down = late_down;
            }
        }
        (up, down)
    }

    /// The terms of a sum; those of earlier parts form a sum of their own.
    fn sum_by_parts(&mut self, sum: Index, mut terms: Vec<Signed>) -> Vec<Signed> {
        for limit in 0..self.part_of(sum) {
            let (mut early, late): (Vec<Signed>, Vec<Signed>) = terms
                .iter()
                .copied()
                .partition(|(index, _)| self.part_of(*index) <= limit);
            let varies = early.iter().any(|(i, _)| self.stages[*i as usize] > 0);
            if varies && early.len() > 1 {
                // A sum that begins with a negative term would need an extra change of sign.
                let negative = early.iter().all(|(_, negative)| *negative);
                if negative {
                    early.iter_mut().for_each(|term| term.1 = false);
                }
                let early = self.add(Item::Sum(early));
                terms = late;
                terms.push((early, negative));
            }
        }
        terms
    }
}

/// The functions that compute in stages what `whole` computes at once.
pub fn split(whole: &Function, apart: Stages) -> Vec<Function> {
    let mut roles = Vec::new();
    roles.extend(apart.time.then_some(Role::AtTime));
    roles.extend(apart.coordinates.then_some(Role::AtPosition));
    roles.push(Role::AccelerationsAt);
    let parts = parts(&whole.code, apart);
    let last = roles.len() - 1;
    // The stage of time alone reports no pivots; the next stage reports them.
    let first_guarded = usize::from(apart.time);
    let guarded_in = |guard: &Guard| {
        let part = |value: Value| parts[value.index()];
        part(guard.pivot).max(part(guard.scale)).max(first_guarded)
    };

    let read_until = last_reads(whole, &parts, guarded_in, last);
    let mut functions: Vec<Function> = Vec::with_capacity(roles.len());
    let mut handed: Vec<Value> = Vec::new();
    for (number, &role) in roles.iter().enumerate() {
        let mut builder = Builder {
            whole,
            parts: &parts,
            number,
            before: number.checked_sub(1).map(|before| roles[before]),
            passed: &handed,
            code: Vec::new(),
            values: FxHashMap::default(),
        };
        let is_mine = |index: &usize| parts[*index] == number && !is_known(&whole.code[*index]);
        for index in (0..whole.code.len()).filter(is_mine) {
            builder.value(Value(index as u32));
        }
        let here = whole.guards.iter().filter(|g| guarded_in(g) == number);
        let guards: Vec<Guard> = here
            .map(|guard| Guard {
                pivot: builder.value(guard.pivot),
                scale: builder.value(guard.scale),
                ..*guard
            })
            .collect();
        let next: Vec<Value> = (0..whole.code.len())
            .filter(|&index| parts[index] <= number && read_until[index] > number)
            .filter(|&index| !is_known(&whole.code[index]))
            .map(|index| Value(index as u32))
            .collect();
        let wanted = if number == last {
            &whole.results
        } else {
            &next
        };
        let results: Vec<Value> = wanted.iter().map(|&value| builder.value(value)).collect();
        let own = whole.steps.iter();
        let own = own.filter(|(value, _)| parts[value.index()] == number);
        let steps = own.filter_map(|(value, step)| Some((*builder.values.get(value)?, *step)));
        let mut steps: Vec<_> = steps.collect();
        steps.sort_unstable();
        functions.push(Function {
            role,
            shape: Shape::Vector(results.len()),
            code: builder.code,
            results,
            guards,
            steps,
        });
        handed = next;
    }
    functions
}

/// The last part that reads each value; results are read in the `last` one.
fn last_reads(
    whole: &Function,
    parts: &[usize],
    guarded_in: impl Fn(&Guard) -> usize,
    last: usize,
) -> Vec<usize> {
    let mut read_until = parts.to_vec();
    let mut read = |value: Value, by: usize| {
        read_until[value.index()] = read_until[value.index()].max(by);
    };
    for (index, op) in whole.code.iter().enumerate() {
        op.operands()
            .for_each(|operand| read(operand, parts[index]));
    }
    for guard in &whole.guards {
        let by = guarded_in(guard);
        read(guard.pivot, by);
        read(guard.scale, by);
    }
    whole.results.iter().for_each(|&value| read(value, last));
    read_until
}

/// For each value the part that computes it, or reads it first.
fn parts(code: &[Op], apart: Stages) -> Vec<usize> {
    let mut stages: Vec<Stage> = Vec::with_capacity(code.len());
    for op in code {
        let own = match op {
            Op::Read(source) => stage_of(*source),
            _ => 0,
        };
        let operands = op.operands().map(|operand| stages[operand.index()]);
        stages.push(operands.max().unwrap_or(0).max(own));
    }
    stages.into_iter().map(|stage| part(apart, stage)).collect()
}

/// Values that are available to every part.
fn is_known(op: &Op) -> bool {
    matches!(op, Op::Constant(_) | Op::Pi | Op::Read(Source::Prepared(_)))
}

/// The code of a part under construction.
struct Builder<'a> {
    whole: &'a Function,
    parts: &'a [usize],
    number: usize,
    /// The role of the preceding part.
    before: Option<Role>,
    /// The values that the preceding part hands on, in the order of its results.
    passed: &'a [Value],
    code: Vec<Op>,
    /// The values of the whole function that this part has.
    values: FxHashMap<Value, Value>,
}

impl Builder<'_> {
    /// The value of the whole function in this part; operands that this part computes are already there.
    fn value(&mut self, value: Value) -> Value {
        if let Some(&known) = self.values.get(&value) {
            return known;
        }
        let op = self.whole.op(value);
        let op = match self.before {
            Some(before) if self.parts[value.index()] < self.number && !is_known(op) => {
                let place = self.passed.binary_search(&value);
                let place = place.expect("what a part reads was handed on") as u32;
                Op::Read(match before {
                    Role::AtTime => Source::AtTime(place),
                    _ => Source::AtPosition(place),
                })
            }
            _ => {
                let operands: Vec<Value> = op.operands().collect();
                let moved: Vec<Value> = operands.iter().map(|&o| self.value(o)).collect();
                let moved: FxHashMap<Value, Value> = operands.into_iter().zip(moved).collect();
                op.with_operands(|operand| moved[&operand])
            }
        };
        self.code.push(op);
        let place = Value(self.code.len() as u32 - 1);
        self.values.insert(value, place);
        place
    }
}
