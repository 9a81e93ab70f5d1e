//! Packs operations in pairs, for machines with equal parts.
//!
//! A robot has a left arm and a right arm, a quadruped four equal legs: their operations are the same on different
//! values. If a register holds two numbers, one instruction computes both. Compilers find such pairs by adjacent memory
//! accesses (S. Larsen and S. Amarasinghe, *Exploiting superword level parallelism with multimedia instruction sets*,
//! PLDI 2000, 145–156); limbs have none here, so this looks for operations in equivalent positions of the function.
//!
//! Each operation gets a color from what it is computed from and from what is computed from it, up to some distance (the
//! refinement of B. Weisfeiler and A. Leman, 1968). Two operations of one color are the seed of a pair of parts, and
//! further pairs follow from each pair: the operands of both, and the operations that use both in the same way. Only
//! operations of the same depth become a pair, so that no pair depends on itself through another pair.
//!
//! Pairing changes neither the set of operations nor their operands: the results have the same bits as those
//! of the function.

use std::hash::{Hash, Hasher};

use rustc_hash::{FxHashMap, FxHasher};

use super::repeats::{StatementKind, early_angles};
use super::{Contracted, Contractions, Function, Op, Source, Value};

/// The distance that colors cover.
const DISTANCE: usize = 8;

/// The distances at which seeds are searched: large ones first, since agreement over a large distance is more reliable.
const SEED_DISTANCES: [usize; 4] = [8, 6, 5, 4];

/// The largest number of operations of one color, and of users of one value, that are compared with each other. Larger
/// sets are skipped: they are not distinctive, and comparing all of their pairs would take too long.
const MOST_ALIKE: usize = 64;

/// Pairs must save at least one in this many operations. Smaller savings come from operations that look alike by chance.
const LEAST_SHARE: usize = 8;

/// A statement of the emitted code.
#[derive(Clone, Debug, PartialEq)]
pub enum PackedStatement {
    /// One operation; for the sine and cosine of one angle, either of them.
    One(Value),
    /// Two operations of one kind.
    Two(Pack),
}

/// Two operations of one kind.
#[derive(Clone, Debug, PartialEq)]
pub struct Pack {
    /// The operation.
    pub operation: PackedOperation,
    /// The values that they compute.
    pub values: [Value; 2],
    /// Their operands, slot by slot.
    pub operands: Vec<[Value; 2]>,
}

/// The operation of a pair.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum PackedOperation {
    /// a + b
    Add,
    /// a − b
    Sub,
    /// a·b
    Mul,
    /// a/b
    Div,
    /// A contracted product and sum.
    Contraction(Contracted),
}

impl PackedOperation {
    /// Whether the first two operands may be exchanged.
    fn commutes(self) -> bool {
        !matches!(self, PackedOperation::Sub | PackedOperation::Div)
    }
}

/// The operations of a function in pairs, each after its operands; `None` if that does not pay. Products are
/// contracted, and angles that are [early](early_angles) are known before.
pub fn packs(function: &Function) -> Option<Vec<PackedStatement>> {
    let mut finder = Finder::new(function);
    finder.find();
    finder.prune();
    let packs = finder.lane.iter().filter(|lane| **lane == Some(0));
    let packs = packs.count() - finder.pairs_of_arguments();
    let operations = finder.nodes.iter().filter(|node| node.operation.is_some());
    (packs > 0 && packs * LEAST_SHARE >= operations.count()).then(|| finder.statements())
}

/// The kind of a value from the point of view of its users.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
enum ValueKind {
    /// Computed here.
    Operation,
    /// Known before; two such values can be adjacent in memory.
    Known,
    /// An argument of the state, by its kind.
    Argument(u8),
    /// Part of another operation, or not needed.
    Absent,
}

struct Node {
    value_kind: ValueKind,
    /// Its operation, if it may be one of a pair.
    operation: Option<PackedOperation>,
    /// A hash of its operation.
    kind: u64,
    operands: Vec<Value>,
    /// The number of operations on the longest path from the arguments to it.
    depth: u32,
    users: Vec<Value>,
}

struct Finder<'a> {
    function: &'a Function,
    nodes: Vec<Node>,
    /// The colors of each value, by increasing distance.
    colors: Vec<[u64; DISTANCE]>,
    partner: Vec<Option<Value>>,
    /// Its index in its pair.
    lane: Vec<Option<u8>>,
    /// Pairs whose neighbours are still to be examined.
    pending: Vec<[Value; 2]>,
}

fn hash(of: impl Hash) -> u64 {
    let mut hasher = FxHasher::default();
    of.hash(&mut hasher);
    hasher.finish()
}

impl<'a> Finder<'a> {
    fn new(function: &'a Function) -> Finder<'a> {
        let nodes = nodes(function);
        let colors = colors(&nodes);
        let n = nodes.len();
        Finder {
            function,
            nodes,
            colors,
            partner: vec![None; n],
            lane: vec![None; n],
            pending: Vec::new(),
        }
    }

    fn node(&self, value: Value) -> &Node {
        &self.nodes[value.index()]
    }

    fn is_paired(&self, value: Value) -> bool {
        self.partner[value.index()].is_some()
    }

    /// Whether these two are a pair, in this order.
    fn is_pair(&self, [a, b]: [Value; 2]) -> bool {
        self.partner[a.index()] == Some(b) && self.lane[a.index()] == Some(0)
    }

    /// The distance up to which two values look alike.
    fn common_distance(&self, a: Value, b: Value) -> usize {
        let pairs = self.colors[a.index()].iter().zip(&self.colors[b.index()]);
        pairs.take_while(|(a, b)| a == b).count()
    }

    /// How well two operands go together, 0 for not at all. With `is_strict`, operations must already be a pair.
    fn operand_score(&self, a: Value, b: Value, is_strict: bool) -> u32 {
        if a == b {
            return 1;
        }
        let (sort, other) = (self.node(a).value_kind, self.node(b).value_kind);
        let is_free = !self.is_paired(a) && !self.is_paired(b);
        match (sort, other) {
            _ if sort != other => 0,
            (ValueKind::Known, _) => 1,
            (ValueKind::Operation, _) if self.is_pair([a, b]) => 3,
            (ValueKind::Operation, _) => u32::from(is_free && !is_strict),
            (ValueKind::Argument(_), _) if self.is_pair([a, b]) => 2,
            (ValueKind::Argument(_), _) => u32::from(is_free),
            (ValueKind::Absent, _) => 0,
        }
    }

    /// The operands of two operations side by side, if these can be a pair, and how well they fit.
    fn paired_operands(
        &self,
        x: Value,
        y: Value,
        is_strict: bool,
    ) -> Option<(u32, Vec<[Value; 2]>)> {
        let (first, second) = (self.node(x), self.node(y));
        let operation = first.operation?;
        if x == y || second.operation != Some(operation) || first.depth != second.depth {
            return None;
        }
        let rated = |order: [usize; 3]| {
            let columns = first.operands.iter().zip(order);
            let columns: Vec<[Value; 2]> = columns
                .map(|(a, place)| [*a, second.operands[place]])
                .collect();
            let mut fits = columns
                .iter()
                .map(|&[a, b]| self.operand_score(a, b, is_strict));
            let rate = fits.try_fold(0, |sum, fit| (fit > 0).then_some(sum + fit));
            rate.map(|rate| (rate, columns))
        };
        let straight = rated([0, 1, 2]);
        let crossed = if operation.commutes() {
            rated([1, 0, 2])
        } else {
            None
        };
        match (&straight, &crossed) {
            (Some(a), Some(b)) if b.0 > a.0 => crossed,
            (None, _) => crossed,
            _ => straight,
        }
    }

    fn pair(&mut self, x: Value, y: Value) {
        for (value, other, lane) in [(x, y, 0), (y, x, 1)] {
            self.partner[value.index()] = Some(other);
            self.lane[value.index()] = Some(lane);
        }
        self.pending.push([x, y]);
    }

    fn unpair(&mut self, x: Value) {
        for value in [Some(x), self.partner[x.index()]].into_iter().flatten() {
            self.partner[value.index()] = None;
            self.lane[value.index()] = None;
        }
    }

    /// Grows pairs from seeds.
    fn find(&mut self) {
        for distance in SEED_DISTANCES {
            let mut classes: FxHashMap<u64, Vec<Value>> = FxHashMap::default();
            for (index, node) in self.nodes.iter().enumerate() {
                if node.operation.is_some() {
                    let color = self.colors[index][distance - 1];
                    classes.entry(color).or_default().push(Value(index as u32));
                }
            }
            let mut classes: Vec<Vec<Value>> = classes.into_values().collect();
            classes.retain(|class| (2..=MOST_ALIKE).contains(&class.len()));
            classes.sort_unstable_by_key(|class| (class.len(), class[0]));
            for class in classes {
                for (place, &x) in class.iter().enumerate() {
                    let later = class[place + 1..].iter().copied();
                    let mut fitting = later.filter(|&y| {
                        let is_free = !self.is_paired(x) && !self.is_paired(y);
                        is_free && self.paired_operands(x, y, false).is_some()
                    });
                    if let Some(y) = fitting.next() {
                        self.pair(x, y);
                        self.add_implied();
                    }
                }
            }
        }
    }

    /// Adds the pairs that follow from existing ones.
    fn add_implied(&mut self) {
        while let Some([x, y]) = self.pending.pop() {
            if let Some((_, columns)) = self.paired_operands(x, y, false) {
                for [a, b] in columns {
                    let (first, second) = (self.node(a), self.node(b));
                    let can_be = match first.value_kind {
                        ValueKind::Operation => {
                            self.paired_operands(a, b, false).is_some()
                                && self.common_distance(a, b) > 0
                        }
                        ValueKind::Argument(_) => first.value_kind == second.value_kind,
                        _ => false,
                    };
                    if a != b && can_be && !self.is_paired(a) && !self.is_paired(b) {
                        self.pair(a, b);
                    }
                }
            }
            self.pair_users(x, y);
        }
    }

    /// Pairs the operations that use both values of a pair.
    fn pair_users(&mut self, x: Value, y: Value) {
        let [first, second] = [x, y].map(|value| &self.node(value).users);
        if first.len().max(second.len()) > MOST_ALIKE {
            return;
        }
        let mut candidates = Vec::new();
        for &a in first.iter().filter(|a| !self.is_paired(**a)) {
            for &b in second.iter().filter(|b| !self.is_paired(**b)) {
                if let Some((fit, _)) = self.paired_operands(a, b, true) {
                    candidates.push((2 * fit as usize + self.common_distance(a, b), a, b));
                }
            }
        }
        candidates.sort_unstable_by_key(|&(rate, a, b)| (std::cmp::Reverse(rate), a, b));
        for (_, a, b) in candidates {
            let is_free = !self.is_paired(a) && !self.is_paired(b);
            if is_free && self.paired_operands(a, b, true).is_some() {
                self.pair(a, b);
            }
        }
    }

    /// Removes pairs that cost more than they save: two operands from different places have to be combined in one
    /// register, and the second result has to be extracted if it is used by itself.
    fn prune(&mut self) {
        loop {
            let is_bad = |&x: &Value| {
                let Some((y, 0)) = self.partner[x.index()].zip(self.lane[x.index()]) else {
                    return false;
                };
                if self.node(x).operation.is_none() {
                    return false;
                }
                let Some((_, columns)) = self.paired_operands(x, y, false) else {
                    return true;
                };
                let gathered = columns.iter().filter(|&&[a, b]| {
                    self.node(a).value_kind == ValueKind::Operation
                        && a != b
                        && !self.is_pair([a, b])
                });
                let users = &self.node(y).users;
                let is_taken_out =
                    users.is_empty() || users.iter().any(|user| !self.is_paired(*user));
                2 * gathered.count() + usize::from(is_taken_out) > 2
            };
            let all = (0..self.nodes.len()).map(|index| Value(index as u32));
            let bad: Vec<Value> = all.filter(is_bad).collect();
            if bad.is_empty() {
                return;
            }
            for x in bad {
                self.unpair(x);
            }
        }
    }

    /// The number of pairs of arguments, which save nothing.
    fn pairs_of_arguments(&self) -> usize {
        let all = self.nodes.iter().zip(&self.lane);
        all.filter(|(node, lane)| node.operation.is_none() && **lane == Some(0))
            .count()
    }

    /// The operations that results and guards need, in depth-first order.
    fn statements(&self) -> Vec<PackedStatement> {
        let mut statements = Vec::new();
        let mut is_entered = vec![false; self.nodes.len()];
        let results = self.function.results.iter().copied();
        let guards = self.function.guards.iter();
        let guards = guards.flat_map(|guard| [guard.pivot, guard.scale]);
        let mut open: Vec<(Value, bool)> = results
            .chain(guards)
            .map(|value| (self.first(value), false))
            .collect();
        open.reverse();
        while let Some((value, is_ready)) = open.pop() {
            if self.node(value).value_kind != ValueKind::Operation {
                continue;
            }
            let pack = self.pack(value);
            if is_ready {
                statements.push(pack.map_or(PackedStatement::One(value), PackedStatement::Two));
                continue;
            }
            if std::mem::replace(&mut is_entered[value.index()], true) {
                continue;
            }
            open.push((value, true));
            let mut needed: Vec<Value> = match &pack {
                Some(pack) => pack.operands.iter().flatten().copied().collect(),
                None => self.node(value).operands.clone(),
            };
            needed.reverse();
            open.extend(needed.into_iter().map(|value| (self.first(value), false)));
        }
        statements
    }

    /// The first value of the pair that a value belongs to.
    fn first(&self, value: Value) -> Value {
        match (self.partner[value.index()], self.lane[value.index()]) {
            (Some(other), Some(1)) => other,
            _ => value,
        }
    }

    /// The pair whose first value is given.
    fn pack(&self, x: Value) -> Option<Pack> {
        let y = self.partner[x.index()]?;
        let (_, operands) = self.paired_operands(x, y, false)?;
        Some(Pack {
            operation: self.node(x).operation?,
            values: [x, y],
            operands,
        })
    }
}

/// The values of a function as nodes.
fn nodes(function: &Function) -> Vec<Node> {
    let contractions = Contractions::of(function);
    let early = EarlyValues::of(function);
    let mut nodes: Vec<Node> = Vec::with_capacity(function.code.len());
    for (index, op) in function.code.iter().enumerate() {
        let value = Value(index as u32);
        let value_kind = early.kind(value, op, &contractions);
        let (mut operation, mut operands) = (None, Vec::new());
        if value_kind == ValueKind::Operation {
            let sum = contractions.sum(value);
            operation = match (sum, op) {
                (Some(sum), _) => Some(PackedOperation::Contraction(sum.kind)),
                (_, Op::Add(..)) => Some(PackedOperation::Add),
                (_, Op::Sub(..)) => Some(PackedOperation::Sub),
                (_, Op::Mul(..)) => Some(PackedOperation::Mul),
                (_, Op::Div(..)) => Some(PackedOperation::Div),
                _ => None,
            };
            operands = match sum {
                Some(sum) => vec![sum.factors[0], sum.factors[1], sum.term],
                None => op.operands().collect(),
            };
        }
        let kind = match value_kind {
            ValueKind::Argument(which) => u64::from(which),
            ValueKind::Known => 0,
            _ => hash(StatementKind::Operation(op.with_operands(|_| Value(0)))),
        };
        let below = operands.iter().map(|operand| nodes[operand.index()].depth);
        nodes.push(Node {
            value_kind,
            operation,
            kind: hash((value_kind, operation, kind)),
            depth: match value_kind {
                ValueKind::Operation => 1 + below.max().unwrap_or(0),
                _ => 0,
            },
            operands,
            users: Vec::new(),
        });
    }
    for index in 0..nodes.len() {
        for operand in nodes[index].operands.clone() {
            let users = &mut nodes[operand.index()].users;
            if users.last() != Some(&Value(index as u32)) {
                users.push(Value(index as u32));
            }
        }
    }
    nodes
}

/// The values that are computed before everything else: angles of arguments, and what these are made of.
struct EarlyValues {
    is_early: Vec<bool>,
    is_angle: Vec<bool>,
}

impl EarlyValues {
    fn of(function: &Function) -> EarlyValues {
        let mut is_angle = vec![false; function.code.len()];
        for angle in early_angles(function) {
            is_angle[angle.index()] = true;
        }
        let mut is_early = is_angle.clone();
        for (index, op) in function.code.iter().enumerate().rev() {
            if is_early[index] {
                op.operands()
                    .for_each(|operand| is_early[operand.index()] = true);
            }
        }
        EarlyValues { is_early, is_angle }
    }

    /// How a value comes to be known.
    fn kind(&self, value: Value, op: &Op, contractions: &Contractions) -> ValueKind {
        match op {
            Op::Constant(_) | Op::Pi | Op::Read(Source::Parameter(_) | Source::Prepared(_)) => {
                ValueKind::Known
            }
            Op::Read(source) => ValueKind::Argument(match source {
                Source::Coordinate(_) => 0,
                Source::Velocity(_) => 1,
                Source::Acceleration(_) => 2,
                Source::Input(_) => 3,
                _ => 4,
            }),
            Op::Sin(angle) if self.is_angle[angle.index()] => ValueKind::Argument(5),
            Op::Cos(angle) if self.is_angle[angle.index()] => ValueKind::Argument(6),
            // Computed before everything else, and there are few of these.
            _ if self.is_early[value.index()] => ValueKind::Argument(7),
            _ if contractions.is_part(value) => ValueKind::Absent,
            _ => ValueKind::Operation,
        }
    }
}

/// Colors of the operations below and above, nearest first.
fn colors(nodes: &[Node]) -> Vec<[u64; DISTANCE]> {
    let mut below: Vec<u64> = nodes.iter().map(|node| node.kind).collect();
    let mut above = below.clone();
    let mut colors = vec![[0; DISTANCE]; nodes.len()];
    for distance in 0..DISTANCE {
        let next_below = nodes.iter().map(|node| {
            let mut operands: Vec<u64> = node.operands.iter().map(|x| below[x.index()]).collect();
            if node.operation.is_some_and(PackedOperation::commutes) {
                operands[..2].sort_unstable();
            }
            hash((node.kind, operands))
        });
        let next_below: Vec<u64> = next_below.collect();
        let next_above = nodes.iter().enumerate().map(|(index, node)| {
            let mut users: Vec<(u64, u64)> = Vec::with_capacity(node.users.len());
            for user in &node.users {
                let user = (&nodes[user.index()], above[user.index()]);
                // The slots in which the value stands; for commuting slots only how often it occurs.
                let commutes = user.0.operation.is_some_and(PackedOperation::commutes);
                for (slot, operand) in user.0.operands.iter().enumerate() {
                    if operand.index() == index {
                        let slot = if commutes && slot < 2 { 0 } else { slot as u64 };
                        users.push((slot, user.1));
                    }
                }
            }
            users.sort_unstable();
            hash((node.kind, users))
        });
        above = next_above.collect();
        below = next_below;
        for (color, both) in colors.iter_mut().zip(below.iter().zip(&above)) {
            color[distance] = hash(both);
        }
    }
    colors
}

#[cfg(test)]
mod tests {
    use super::super::{Role, Shape};
    use super::*;

    /// Two limbs on one body: each has values of its own, one sum uses both, and results depend on it.
    fn limbs(last: fn(Value, Value) -> Op) -> Function {
        let mut code = Vec::new();
        let mut op = |op: Op| {
            code.push(op);
            Value(code.len() as u32 - 1)
        };
        let limb = |op: &mut dyn FnMut(Op) -> Value, i: u32| {
            let q = op(Op::Read(Source::Coordinate(i)));
            let v = op(Op::Read(Source::Velocity(i)));
            let k = op(Op::Read(Source::Prepared(i)));
            let mut inertia = op(Op::Mul(q, v));
            for _ in 0..6 {
                let product = op(Op::Mul(inertia, k));
                inertia = op(Op::Add(product, q));
            }
            op(Op::Mul(inertia, inertia))
        };
        let (left, right) = (limb(&mut op, 0), limb(&mut op, 1));
        let sum = op(Op::Add(left, right));
        let results = vec![op(Op::Div(sum, left)), op(last(sum, right))];
        Function {
            role: Role::Accelerations,
            shape: Shape::Vector(2),
            code,
            results,
            guards: Vec::new(),
            steps: Vec::new(),
        }
    }

    /// Checks that each operation occurs once, after its operands.
    fn check(function: &Function, statements: &[PackedStatement]) {
        let contractions = Contractions::of(function);
        let is_read = |value: &Value| matches!(function.op(*value), Op::Read(_) | Op::Constant(_));
        let mut is_known: Vec<bool> = (0..function.code.len())
            .map(|index| is_read(&Value(index as u32)))
            .collect();
        for statement in statements {
            let all: Vec<(Value, Vec<Value>)> = match statement {
                PackedStatement::One(value) => {
                    let sum = contractions.sum(*value);
                    let operands = sum.map(|sum| vec![sum.factors[0], sum.factors[1], sum.term]);
                    let own = || function.op(*value).operands().collect();
                    vec![(*value, operands.unwrap_or_else(own))]
                }
                PackedStatement::Two(pack) => (0..2)
                    .map(|lane| {
                        let operands = pack.operands.iter().map(|pair| pair[lane]);
                        (pack.values[lane], operands.collect())
                    })
                    .collect(),
            };
            for (value, operands) in &all {
                assert!(!is_known[value.index()], "{value:?} stands twice");
                assert!(operands.iter().all(|operand| is_known[operand.index()]));
            }
            all.iter()
                .for_each(|(value, _)| is_known[value.index()] = true);
        }
        let is_there = |index: usize| is_known[index] || contractions.is_part(Value(index as u32));
        assert!((0..function.code.len()).all(is_there));
    }

    #[test]
    fn operations_that_limbs_have_in_common_are_pairs() {
        let function = limbs(Op::Div);
        let statements = packs(&function).expect("all but one are alike");
        check(&function, &statements);
        let pairs = statements.iter().filter_map(|statement| match statement {
            PackedStatement::Two(pack) => Some(pack.operation),
            PackedStatement::One(_) => None,
        });
        let contractions = [PackedOperation::Contraction(Contracted::Add); 6];
        let expected = [
            &[PackedOperation::Mul],
            &contractions[..],
            &[PackedOperation::Mul, PackedOperation::Div],
        ]
        .concat();
        assert_eq!(pairs.collect::<Vec<_>>(), expected);
    }

    #[test]
    fn what_differs_stays_by_itself() {
        let function = limbs(Op::Mul);
        let statements = packs(&function).expect("most are alike");
        check(&function, &statements);
        let is_pair = |statement: &&PackedStatement| matches!(statement, PackedStatement::Two(_));
        assert_eq!(statements.iter().filter(is_pair).count(), 8);
    }

    #[test]
    fn a_chain_of_operations_has_no_pairs() {
        let mut code = vec![Op::Read(Source::Coordinate(0))];
        code.extend((0..20).map(|index| Op::Mul(Value(index), Value(0))));
        let function = Function {
            role: Role::Accelerations,
            shape: Shape::Vector(1),
            results: vec![Value(20)],
            code,
            guards: Vec::new(),
            steps: Vec::new(),
        };
        assert_eq!(packs(&function), None);
    }
}
