//! Finds repeats: stretches of a function that do the same again and again on different values.
//!
//! Links of a chain, equal arms of a tree, or mechanisms in a row give code with the same body
//! once for each of them. Nothing here knows about links. A function is a sequence of
//! [`Statement`]s; a *repeat* of period p is a stretch in which each statement has the same kind as the
//! statement p before it, and in which every operand is related to its counterpart p statements before in
//! the same way throughout:
//!
//! * it is a value of the same iteration, or of the preceding one (*carried*);
//! * it was known before the stretch begins, and is the same in all iterations, or a different
//!   value in each (a *column*).
//!
//! This is the converse of loop unrolling (as in M. Stepp, R. Tate, S. Lerner, *Equality-based
//! translation validator for LLVM*, and LLVM's loop rerolling pass), applied to code that never was
//! a loop. Contraction of a product into a sum is part of the kind of a statement, so a loop gives the
//! same bits as the straight-line code.

use std::ops::Range;

use rustc_hash::FxHashMap;

use super::{Contracted, Contractions, Function, Op, Value};
use lagrangian_symbolic::sorting::sort_by_key;

/// The smallest number of iterations of a repeat: fewer are shorter written out.
const FEWEST: usize = 4;

/// The longest body that is searched for, in statements. The search takes time proportional to it.
const LONGEST_BODY: usize = 1500;

/// The smallest number of statements that a repeat must save to be worth its loop header, its arrays and
/// its final statements, and the smallest part of a function if values must be copied into arrays
/// for it. The links of a machine are most of the function; smaller repeats are sums of products
/// that look alike by chance, and copying their operands into arrays costs more than it saves.
const LEAST_SAVING: i64 = 24;
const LEAST_SHARE: i64 = 16;

/// The largest number of positions at which a body is tried to begin.
const MOST_PHASES: usize = 64;

/// The smallest unit that an emitter writes as a statement.
#[derive(Clone, Debug, PartialEq)]
pub struct Statement {
    /// Its kind.
    pub kind: StatementKind,
    /// The values that it computes: one, or a sine and a cosine, as far as they exist.
    pub defines: [Option<Value>; 2],
    /// Its operands.
    pub operands: Vec<Value>,
    /// For a guard, its index in [`Function::guards`].
    pub guard: usize,
}

/// The kind of a statement, independent of its operands.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum StatementKind {
    /// An operation; the operands stored in it are meaningless.
    Operation(Op),
    /// A contracted product and sum: two factors and a term.
    Contraction(Contracted),
    /// Sine, cosine or both of an angle.
    Circular,
    /// Sines and cosines of several angles at once.
    AllCircular,
    /// A guard: a pivot and its scale; the bits of the tolerance.
    Guard(u64),
}

/// A stretch of statements that repeats itself.
#[derive(Clone, Debug, PartialEq)]
pub struct Repeat {
    /// The first statement.
    pub start: usize,
    /// The number of statements of an iteration.
    pub period: usize,
    /// The number of iterations.
    pub count: usize,
    /// For each statement of the first iteration the kinds of its operands.
    pub operands: Vec<Vec<Operand>>,
}

/// The kind of an operand of a statement in a repeat.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Operand {
    /// A value of the same iteration, by its index in the first.
    Same(Value),
    /// A value of the preceding iteration, by its index in the first, and the value that the first
    /// iteration uses instead.
    Carried(Value, Value),
    /// The same value in all iterations, known before.
    Invariant(Value),
    /// For each iteration a value that is known before the first.
    Column(Vec<Value>),
}

impl Repeat {
    /// The statement after the last.
    pub fn end(&self) -> usize {
        self.start + self.period * self.count
    }
}

/// A function as statements.
#[derive(Clone, Debug)]
pub struct Statements {
    /// The statements, in the order in which they are to be written.
    pub statements: Vec<Statement>,
    /// The angles of [`StatementKind::AllCircular`], with the values of their sines and cosines.
    pub angles: Vec<(Value, [Option<Value>; 2])>,
}

impl Statements {
    /// The statements of a function. With `is_for_speed`, products are contracted, and all possible
    /// angles are computed at once, as soon as they are known.
    pub fn of(function: &Function, is_for_speed: bool) -> Statements {
        let contractions = if is_for_speed {
            Contractions::of(function)
        } else {
            Contractions::none(function)
        };
        let mut circular: FxHashMap<Value, [Option<Value>; 2]> = FxHashMap::default();
        for (index, op) in function.code.iter().enumerate() {
            let value = Some(Value(index as u32));
            match op {
                Op::Sin(angle) => circular.entry(*angle).or_default()[0] = value,
                Op::Cos(angle) => circular.entry(*angle).or_default()[1] = value,
                _ => {}
            }
        }
        let angles = if is_for_speed {
            early_angles(function)
        } else {
            Vec::new()
        };
        let mut statements = Statements {
            statements: Vec::with_capacity(function.code.len()),
            angles: Vec::new(),
        };
        let mut is_done = vec![false; function.code.len()];
        if !angles.is_empty() {
            let mut is_needed = vec![false; function.code.len()];
            for angle in &angles {
                is_needed[angle.index()] = true;
            }
            for (index, op) in function.code.iter().enumerate().rev() {
                if is_needed[index] {
                    op.operands()
                        .for_each(|operand| is_needed[operand.index()] = true);
                }
            }
            for index in (0..function.code.len()).filter(|&index| is_needed[index]) {
                statements.operation(function, &contractions, &circular, index, &mut is_done);
            }
            for angle in angles {
                let pair = circular[&angle];
                for value in pair.into_iter().flatten() {
                    is_done[value.index()] = true;
                }
                statements.angles.push((angle, pair));
            }
            statements.statements.push(Statement {
                kind: StatementKind::AllCircular,
                defines: [None, None],
                operands: Vec::new(),
                guard: 0,
            });
        }
        let mut guards = function.guards.iter().enumerate().peekable();
        for index in 0..function.code.len() {
            statements.operation(function, &contractions, &circular, index, &mut is_done);
            let is_there =
                |value: Value| value.index() <= index || matches!(function.op(value), Op::Read(_));
            while let Some((guard, what)) =
                guards.next_if(|(_, guard)| is_there(guard.pivot) && is_there(guard.scale))
            {
                statements.statements.push(Statement {
                    kind: StatementKind::Guard(what.tolerance.to_bits()),
                    defines: [None, None],
                    operands: vec![what.pivot, what.scale],
                    guard,
                });
            }
        }
        statements
    }

    fn operation(
        &mut self,
        function: &Function,
        contractions: &Contractions,
        circular: &FxHashMap<Value, [Option<Value>; 2]>,
        index: usize,
        is_done: &mut [bool],
    ) {
        let value = Value(index as u32);
        let op = function.op(value);
        let is_leaf = matches!(op, Op::Constant(_) | Op::Pi | Op::Read(_));
        if is_leaf || contractions.is_part(value) || std::mem::replace(&mut is_done[index], true) {
            return;
        }
        let mut defines = [Some(value), None];
        let (kind, operands) = match (contractions.sum(value), op) {
            (Some(sum), _) => {
                let [a, b] = sum.factors;
                (StatementKind::Contraction(sum.kind), vec![a, b, sum.term])
            }
            (_, Op::Sin(angle) | Op::Cos(angle)) => {
                defines = circular[angle];
                for value in defines.into_iter().flatten() {
                    is_done[value.index()] = true;
                }
                (StatementKind::Circular, vec![*angle])
            }
            _ => (
                StatementKind::Operation(op.with_operands(|_| Value(0))),
                op.operands().collect(),
            ),
        };
        self.statements.push(Statement {
            kind,
            defines,
            operands,
            guard: 0,
        });
    }

    /// The repeats, in order and without overlap. Statements are reordered if two repeats are fused.
    pub fn repeats(&mut self, function: &Function) -> Vec<Repeat> {
        let mut repeats = Finder::new(self, function).repeats();
        let mut at = 0;
        while at + 1 < repeats.len() {
            match self.fused(function, &repeats[at], &repeats[at + 1]) {
                Some((statements, fused)) => {
                    self.statements = statements;
                    repeats.splice(at..at + 2, [fused]);
                }
                None => at += 1,
            }
        }
        repeats
    }

    /// Fuses two repeats into one, if the statements between them can be moved before or after both.
    ///
    /// Two sweeps along a chain in the same direction then no longer wait for each other, and
    /// values that the first leaves for the second need not be stored (loop fusion, K. Kennedy and
    /// J. R. Allen, *Optimizing Compilers for Modern Architectures*, 2002, section 6.2).
    fn fused(
        &self,
        function: &Function,
        first: &Repeat,
        second: &Repeat,
    ) -> Option<(Vec<Statement>, Repeat)> {
        let finder = Finder::new(self, function);
        let place = |value: Value| finder.places[value.index()].map(|(statement, _)| statement);
        let pair = Pair::of(first, second, &place)?;
        let range = pair.range();
        let [before, after] = self.around(&pair, &place);
        // Guards keep their order.
        let is_guard =
            |statement: &usize| matches!(self.statements[*statement].kind, StatementKind::Guard(_));
        if self.statements[range.clone()]
            .iter()
            .any(|statement| statement.kind == StatementKind::AllCircular)
            || pair.second(0).any(|statement| is_guard(&statement))
            || before
                .iter()
                .any(|statement| is_guard(statement) && *statement >= first.end())
        {
            return None;
        }
        let start = range.start + before.len();
        let order = (0..range.start)
            .chain(before)
            .chain(pair.bodies())
            .chain(after)
            .chain(range.end..self.statements.len());
        let statements = Statements {
            statements: order
                .map(|statement| self.statements[statement].clone())
                .collect(),
            angles: self.angles.clone(),
        };
        let finder = Finder::new(&statements, function);
        let is_in_order =
            statements.statements[..range.end]
                .iter()
                .enumerate()
                .all(|(at, statement)| {
                    let known =
                        |value: &Value| finder.places[value.index()].is_none_or(|(x, _)| x < at);
                    statement.operands.iter().all(known)
                });
        let (period, count) = (first.period + second.period, pair.count);
        let (found, _) = finder.count_iterations(start, period, start + period * count);
        let fused = finder.repeat(start, period, count);
        let fused = fused.filter(|_| is_in_order && found == count)?;
        Some((statements.statements, fused))
    }

    /// The statements from the first repeat to the end of the second that are in no body of both: before the loop those that do not depend
    /// on it, after it those that do.
    fn around(&self, pair: &Pair<'_>, place: &dyn Fn(Value) -> Option<usize>) -> [Vec<usize>; 2] {
        let range = pair.range();
        let mut in_loop = vec![false; range.len()];
        for statement in pair.bodies() {
            in_loop[statement - range.start] = true;
        }
        let mut needs_loop = vec![false; range.len()];
        let (mut before, mut after) = (Vec::new(), Vec::new());
        for statement in range.clone() {
            let mut operands = self.statements[statement]
                .operands
                .iter()
                .filter_map(|x| place(*x));
            let at = statement - range.start;
            needs_loop[at] =
                in_loop[at] || operands.any(|x| x >= range.start && needs_loop[x - range.start]);
            match (in_loop[at], needs_loop[at]) {
                (true, _) => {}
                (_, true) => after.push(statement),
                (_, false) => before.push(statement),
            }
        }
        [before, after]
    }
}

/// Two repeats whose iterations may be done side by side.
struct Pair<'r> {
    repeats: [&'r Repeat; 2],
    /// How many iterations of each precede those that both do.
    skips: [usize; 2],
    /// The number of iterations that both do.
    count: usize,
}

impl<'r> Pair<'r> {
    /// Returns `None` if too few iterations are common. `place` is the statement that defines a value.
    fn of(
        first: &'r Repeat,
        second: &'r Repeat,
        place: &dyn Fn(Value) -> Option<usize>,
    ) -> Option<Pair<'r>> {
        // The number of iterations by which the first is ahead of the second.
        let of_first = |value: &Value| {
            let statement =
                place(*value).filter(|statement| (first.start..first.end()).contains(statement))?;
            Some(((statement - first.start) / first.period) as isize)
        };
        let ahead = second.operands.iter().flatten().filter_map(|operand| {
            let Operand::Column(column) = operand else {
                return None;
            };
            let each = column.iter().enumerate();
            each.filter_map(|(i, value)| Some(of_first(value)? - i as isize))
                .max()
        });
        let ahead = ahead.max().unwrap_or(0);
        let skips = [ahead.max(0) as usize, (-ahead).max(0) as usize];
        let left = |repeat: &Repeat, skip: usize| repeat.count.checked_sub(skip);
        let count = left(first, skips[0])?.min(left(second, skips[1])?);
        if count < FEWEST || count + FEWEST < first.count.max(second.count) {
            return None;
        }
        Some(Pair {
            repeats: [first, second],
            skips,
            count,
        })
    }

    /// All statements from the start of the first to the end of the second.
    fn range(&self) -> Range<usize> {
        self.repeats[0].start..self.repeats[1].end()
    }

    fn body(&self, which: usize, i: usize) -> Range<usize> {
        let (repeat, skip) = (self.repeats[which], self.skips[which]);
        let start = repeat.start + (skip + i) * repeat.period;
        start..start + repeat.period
    }

    /// The statements of the second in a common iteration.
    fn second(&self, i: usize) -> Range<usize> {
        self.body(1, i)
    }

    /// The statements of all common iterations, in the order of the fused loop.
    fn bodies(&self) -> impl Iterator<Item = usize> {
        (0..self.count).flat_map(|i| self.body(0, i).chain(self.second(i)))
    }
}

/// The angles that depend only on arguments and their sums and products, if there are several.
pub fn early_angles(function: &Function) -> Vec<Value> {
    let code = &function.code;
    // Whether a value is known before any function was called.
    let mut is_early = vec![false; code.len()];
    let mut is_angle = vec![false; code.len()];
    let mut angles: Vec<Value> = Vec::new();
    for (index, op) in code.iter().enumerate() {
        is_early[index] = match op {
            Op::Constant(_) | Op::Pi | Op::Read(_) => true,
            Op::Add(..) | Op::Sub(..) | Op::Mul(..) | Op::Neg(_) => {
                op.operands().all(|operand| is_early[operand.index()])
            }
            _ => false,
        };
        if let Op::Sin(angle) | Op::Cos(angle) = op
            && is_early[angle.index()]
            && !std::mem::replace(&mut is_angle[angle.index()], true)
        {
            angles.push(*angle);
        }
    }
    match angles.len() {
        0 | 1 => Vec::new(),
        _ => angles,
    }
}

/// The origin of a value: a kind, and an index within it.
type Origin = (u32, i64);

struct Finder<'a> {
    statements: &'a [Statement],
    function: &'a Function,
    /// The kinds of the statements, by number.
    kinds: Vec<u32>,
    /// For each value the statement that computes it, and which of its two results it is; nothing for
    /// arguments, and for sines and cosines that are known before.
    places: Vec<Option<(usize, usize)>>,
    /// For each value that no statement computes by itself, its origin.
    origins: Vec<Option<Origin>>,
}

/// A repeat that may be chosen.
#[derive(Clone, Copy)]
struct Candidate {
    start: usize,
    period: usize,
    count: usize,
    saving: i64,
}

impl<'a> Finder<'a> {
    fn new(statements: &'a Statements, function: &'a Function) -> Finder<'a> {
        let mut numbers: FxHashMap<&StatementKind, u32> = FxHashMap::default();
        let kinds = statements.statements.iter().map(|statement| {
            let next = numbers.len() as u32;
            *numbers.entry(&statement.kind).or_insert(next)
        });
        let kinds = kinds.collect();
        let mut places = vec![None; function.code.len()];
        for (index, statement) in statements.statements.iter().enumerate() {
            for (which, value) in statement.defines.iter().enumerate() {
                if let Some(value) = value {
                    places[value.index()] = Some((index, which));
                }
            }
        }
        let mut origins: Vec<Option<Origin>> = vec![None; function.code.len()];
        for (index, op) in function.code.iter().enumerate() {
            use super::Source::*;
            origins[index] = match op {
                Op::Read(source) => Some(match source {
                    Parameter(i) => (0, i64::from(*i)),
                    Prepared(i) => (1, i64::from(*i)),
                    Time => (2, 0),
                    Coordinate(i) => (3, i64::from(*i)),
                    Velocity(i) => (4, i64::from(*i)),
                    Input(i) => (5, i64::from(*i)),
                    Acceleration(i) => (6, i64::from(*i)),
                    AtTime(i) => (9, i64::from(*i)),
                    AtPosition(i) => (10, i64::from(*i)),
                }),
                _ => None,
            };
        }
        for (index, (_, pair)) in statements.angles.iter().enumerate() {
            for (which, value) in pair.iter().enumerate() {
                if let Some(value) = value {
                    origins[value.index()] = Some((7 + which as u32, index as i64));
                }
            }
        }
        Finder {
            statements: &statements.statements,
            function,
            kinds,
            places,
            origins,
        }
    }

    fn repeats(&self) -> Vec<Repeat> {
        let mut candidates = self.candidates();
        // The largest saving first; in case of a tie the shortest body, then the first.
        sort_by_key(&mut candidates, |c| (-c.saving, c.period, c.start));
        let mut chosen: Vec<Candidate> = Vec::new();
        for candidate in candidates {
            let end = candidate.start + candidate.period * candidate.count;
            let is_free = |other: &Candidate| {
                end <= other.start || other.start + other.period * other.count <= candidate.start
            };
            if chosen.iter().all(is_free) {
                chosen.push(candidate);
            }
        }
        sort_by_key(&mut chosen, |candidate| candidate.start);
        let mut repeats: Vec<Repeat> = chosen
            .iter()
            .filter_map(|c| self.repeat(c.start, c.period, c.count))
            .collect();
        // A small repeat may read arrays that exist already, but needs no others.
        let least = self.statements.len() / LEAST_SHARE as usize;
        while let Some(worst) = repeats.iter().position(|repeat| {
            let is_small = repeat.period * (repeat.count - 1) < least;
            let mut operands = repeat.operands.iter().flatten();
            is_small
                && operands.any(|operand| match operand {
                    Operand::Column(column) => !self.is_array(column, &repeats),
                    _ => false,
                })
        }) {
            repeats.remove(worst);
        }
        repeats
    }

    /// Whether a column is already an array, without copying.
    fn is_array(&self, column: &[Value], repeats: &[Repeat]) -> bool {
        let origin = |value: &Value| {
            let Some((statement, which)) = self.places[value.index()] else {
                return self.origins[value.index()];
            };
            let (number, repeat) = repeats
                .iter()
                .enumerate()
                .find(|(_, repeat)| (repeat.start..repeat.end()).contains(&statement))?;
            let (iteration, offset) = (
                (statement - repeat.start) / repeat.period,
                (statement - repeat.start) % repeat.period,
            );
            let array = 16 + 2 * (number * self.statements.len() + offset) + which;
            Some((array as u32, iteration as i64))
        };
        column
            .iter()
            .map(origin)
            .collect::<Option<Vec<Origin>>>()
            .is_some_and(|origins| are_evenly_spaced(&origins))
    }

    fn candidates(&self) -> Vec<Candidate> {
        let n = self.statements.len();
        let mut candidates: Vec<Candidate> = Vec::new();
        for period in 1..=LONGEST_BODY.min(n / FEWEST) {
            let mut first = period;
            while first < n {
                if self.kinds[first] != self.kinds[first - period] {
                    first += 1;
                    continue;
                }
                // Statements `start..end` have the same kind as those a period before or after.
                let mut end = first;
                while end < n && self.kinds[end] == self.kinds[end - period] {
                    end += 1;
                }
                self.candidates_within(first - period, end, period, &mut candidates);
                first = end + 1;
            }
        }
        candidates
    }

    fn candidates_within(
        &self,
        mut start: usize,
        end: usize,
        period: usize,
        candidates: &mut Vec<Candidate>,
    ) {
        while start + FEWEST * period <= end {
            // A repeat of a repeat.
            let known = candidates.iter().find(|c| {
                period.is_multiple_of(c.period)
                    && period > c.period
                    && c.start <= start + period
                    && start < c.start + c.period * c.count
            });
            if let Some(known) = known {
                start = known.start + known.period * known.count;
                continue;
            }
            let (count, next) = self.count_iterations(start, period, end);
            if count < FEWEST {
                start = next.max(start + 1);
                continue;
            }
            // The stretch may carry fewer values if it is divided into iterations elsewhere; one iteration
            // later, everything that it reads may be counted.
            let best = (start..start + 2 * period)
                .step_by(period.div_ceil(MOST_PHASES))
                .filter_map(|start| {
                    let (count, _) = self.count_iterations(start, period, end);
                    self.repeat(start, period, count).map(|r| self.rate(&r))
                })
                .max_by_key(|c| (c.saving, std::cmp::Reverse(c.start)));
            if let Some(best) = best.filter(|c| c.saving >= LEAST_SAVING) {
                candidates.push(best);
            }
            start += count * period;
        }
    }

    /// Whether a value is known before a statement.
    fn is_before(&self, value: Value, start: usize) -> bool {
        self.places[value.index()].is_none_or(|(statement, _)| statement < start)
    }

    /// The number of iterations from a statement on, and where to search next if there are too few.
    fn count_iterations(&self, start: usize, period: usize, limit: usize) -> (usize, usize) {
        let mut end = start + period;
        let mut next = start + 1;
        while end < limit {
            if self.kinds[end] != self.kinds[end - period] {
                break;
            }
            let iteration = (end - start) / period;
            let (this, before) = (&self.statements[end], &self.statements[end - period]);
            let operands = this.operands.iter().zip(&before.operands);
            let mut unlike = operands
                .filter(|(a, b)| !self.matches_previous(**a, **b, start, period, iteration));
            if let Some((_, before)) = unlike.next() {
                // The later operand may be carried as soon as the earlier one is known before the
                // stretch; if that is known before already, it must be so in the first iteration.
                next = match self.places[before.index()] {
                    Some((statement, _)) if statement >= start => statement + 1,
                    _ => (end + 1).saturating_sub(2 * period),
                };
                break;
            }
            if this.defines.map(|x| x.is_some()) != before.defines.map(|x| x.is_some())
                || !self.has_even_coordinates(end, start, period)
            {
                next = end - period + 1;
                break;
            }
            end += 1;
        }
        ((end - start) / period, next)
    }

    /// Whether an operand is related to its counterpart in the preceding iteration as required.
    fn matches_previous(
        &self,
        this: Value,
        before: Value,
        start: usize,
        period: usize,
        iteration: usize,
    ) -> bool {
        let place =
            |value: Value| self.places[value.index()].filter(|(statement, _)| *statement >= start);
        match (place(this), place(before)) {
            (None, None) => true,
            (None, Some(_)) => false,
            (Some((statement, _)), None) => iteration == 1 && statement < start + period,
            (Some(this), Some(before)) => this.0 == before.0 + period && this.1 == before.1,
        }
    }

    /// Whether the coordinates of guards form an arithmetic progression over the iterations.
    fn has_even_coordinates(&self, statement: usize, start: usize, period: usize) -> bool {
        let coordinate = |statement: usize| match self.statements[statement].kind {
            StatementKind::Guard(_) => {
                self.function.guards[self.statements[statement].guard].coordinate as i64
            }
            _ => 0,
        };
        statement < start + 2 * period
            || coordinate(statement) - coordinate(statement - period)
                == coordinate(statement - period) - coordinate(statement - 2 * period)
    }

    /// The repeat with `count` iterations.
    fn repeat(&self, start: usize, period: usize, count: usize) -> Option<Repeat> {
        if count < FEWEST {
            return None;
        }
        let operand = |statement: usize, which: usize| {
            let at =
                |iteration: usize| self.statements[statement + iteration * period].operands[which];
            let (first, second) = (at(0), at(1));
            if !self.is_before(first, start) {
                return Some(Operand::Same(first));
            }
            if !self.is_before(second, start) {
                let (place, of) = self.places[second.index()]?;
                // In the first iteration, as `follow` has checked.
                let carried = self.statements[place].defines[of]?;
                return Some(Operand::Carried(carried, first)).filter(|_| place < start + period);
            }
            let column: Vec<Value> = (0..count).map(at).collect();
            Some(if column.iter().all(|value| *value == first) {
                Operand::Invariant(first)
            } else {
                Operand::Column(column)
            })
        };
        let mut operands = Vec::with_capacity(period);
        for statement in start..start + period {
            let of_statement = (0..self.statements[statement].operands.len())
                .map(|which| operand(statement, which));
            let of_statement: Vec<Operand> = of_statement.collect::<Option<_>>()?;
            // If a pivot vanishes in one of several lanes, the guard makes it undefined there, so it
            // must be a variable of the body.
            let is_argument = |value: &Value| matches!(self.function.op(*value), Op::Read(_));
            let can_be_guarded = match of_statement.first() {
                Some(Operand::Same(_)) => true,
                Some(Operand::Invariant(value)) => is_argument(value),
                Some(Operand::Column(column)) => column.iter().all(is_argument),
                _ => false,
            };
            if matches!(self.statements[statement].kind, StatementKind::Guard(_)) && !can_be_guarded
            {
                return None;
            }
            operands.push(of_statement);
        }
        Some(Repeat {
            start,
            period,
            count,
            operands,
        })
    }

    /// Rates a repeat by the statements that it saves, minus those that it adds.
    fn rate(&self, repeat: &Repeat) -> Candidate {
        let Repeat {
            start,
            period,
            count,
            ref operands,
        } = *repeat;
        let mut saving = ((count - 1) * period) as i64;
        let mut carried: Vec<&Operand> = Vec::new();
        for operand in operands.iter().flatten() {
            match operand {
                Operand::Column(column) if !self.is_evenly_spaced(column) => saving -= count as i64,
                Operand::Carried(..) if !carried.contains(&operand) => {
                    carried.push(operand);
                    saving -= 1;
                }
                _ => {}
            }
        }
        Candidate {
            start,
            period,
            count,
            saving,
        }
    }

    /// Whether a column is evenly spaced in one array, or can be stored in one.
    fn is_evenly_spaced(&self, column: &[Value]) -> bool {
        let origin = |value: &Value| match self.places[value.index()] {
            Some((statement, which)) => Some((16 + which as u32, statement as i64)),
            None => self.origins[value.index()],
        };
        let Some(origins) = column.iter().map(origin).collect::<Option<Vec<Origin>>>() else {
            return false;
        };
        are_evenly_spaced(&origins)
    }
}

/// Whether these are members of one array at even distances, or can be.
fn are_evenly_spaced(origins: &[Origin]) -> bool {
    // Prepared values can be stored in any order.
    let is_prepared = origins[0].0 == 1;
    origins.windows(2).all(|pair| pair[0].0 == pair[1].0)
        && (is_prepared
            || origins
                .windows(3)
                .all(|three| three[1].1 - three[0].1 == three[2].1 - three[1].1))
}
