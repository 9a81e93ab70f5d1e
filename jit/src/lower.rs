//! Lowers the operations of a program to those of a processor.
//!
//! Operations without an instruction are calls: sines and cosines, and functions such as `atan2`. All calls whose
//! arguments are known at the same time are grouped, so code is a sequence of *phases*: arithmetic up to the arguments of
//! calls, the calls, arithmetic with their results, and so on; most machines have two. An operation is placed in the last
//! phase that is early enough for the operations that need it, so that few values must be kept across calls.

use std::collections::HashMap;

use lagrangian_program::{Contracted, Contractions, Function, Op, Source};
use lagrangian_scalar::Scalar;
use lagrangian_symbolic::Function as Named;

/// The index of a [`Node`].
pub type Id = u32;

/// A value.
#[derive(Clone, Copy, Debug)]
pub enum Node {
    /// A value that is in memory before it is needed.
    Leaf(Location),
    /// An instruction with two operands.
    Binary(Instruction, Id, Id),
    /// A sum with the product contracted into it: the factors and the term.
    Contracted(Contracted, [Id; 2], Id),
    /// A square root.
    Root(Id),
    /// All ones where a comparison holds, zeros elsewhere.
    Compare(Predicate, Id, Id),
    /// Records in which lanes the first operand exceeds the second; it has no value.
    Guard(Id, Id),
}

/// An instruction with two operands.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Instruction {
    /// a + b
    Add,
    /// a − b
    Sub,
    /// a·b
    Mul,
    /// a/b
    Div,
    /// a where a < b, otherwise b.
    Min,
    /// a where a > b, otherwise b.
    Max,
    /// Bitwise and.
    And,
    /// Bitwise or.
    Or,
    /// Bitwise exclusive or.
    Xor,
}

impl Instruction {
    /// Whether the operands may be swapped.
    pub fn is_symmetric(self) -> bool {
        use Instruction::{Add, And, Mul, Or, Xor};
        matches!(self, Add | Mul | And | Or | Xor)
    }

    /// Whether it is bitwise: then an operand in memory must be as long as the register.
    pub fn is_of_bits(self) -> bool {
        use Instruction::{And, Or, Xor};
        matches!(self, And | Or | Xor)
    }
}

/// A comparison, with the number that instructions use for it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Predicate {
    /// At least one of the two is NaN.
    Unordered = 0x03,
    /// Neither is NaN, and they differ.
    Different = 0x0c,
    /// a < b
    Less = 0x11,
    /// a > b
    Greater = 0x1e,
}

/// The memory location of a value.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Location {
    /// Among the constants beside the code.
    Constant(u32),
    /// Among the arguments of the call.
    Argument(Base, u32),
    /// In the workspace for values between instructions.
    Workspace(u32),
}

/// The arguments of a call, each a row of numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Base {
    /// The time.
    Time,
    /// Coordinates.
    Coordinates,
    /// Velocities.
    Velocities,
    /// Inputs.
    Inputs,
    /// Prepared values; parameters in functions that read these.
    Known,
    /// Accelerations.
    Accelerations,
    /// The results of the stage of time.
    AtTime,
    /// The results of the stage of position.
    AtPosition,
    /// The destination of the results.
    Results,
}

impl Base {
    /// The number of arguments.
    pub const COUNT: usize = 9;
}

/// Calls of the same function, grouped.
#[derive(Clone, Debug)]
pub struct Call {
    /// The function.
    pub kind: CallKind,
    /// The arguments; any number of angles for sines and cosines.
    pub arguments: Vec<Id>,
    /// The workspace slot of the first argument; the others follow.
    pub from: u32,
    /// The workspace slot of the first result: all sines, then all cosines.
    pub to: u32,
}

/// The function of a call.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CallKind {
    /// Sines and cosines of angles.
    Circular,
    /// A function of one or two arguments.
    Named(Named),
    /// A product of a matrix and a vector, written in line.
    Matrix(Matrix),
}

/// A matrix among the coordinates, column by column, whose rows are summed in several lanes of a register. It reads up to 8 numbers behind its last one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Matrix {
    /// Where it begins.
    pub place: u32,
    /// The distance between columns.
    pub stride: u32,
    /// The number of rows.
    pub rows: u32,
    /// Whether each result is two sums, of the columns with even and with odd indices.
    pub is_split: bool,
}

/// How sums and sines are computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Arithmetic {
    /// Contracted, with the sines of `lagrangian-native`: for functions that are called often.
    Fused,
    /// Every operation separately, with the sines of `libm`.
    Plain,
}

/// A function lowered to instructions.
#[derive(Debug, Default)]
pub struct Lowered {
    /// All values.
    pub nodes: Vec<Node>,
    /// The phases.
    pub phases: Vec<Phase>,
    /// The values that are stored, each in a number of an argument.
    pub results: Vec<(Id, Base, u32)>,
    /// The bits of the constants.
    pub constants: Vec<u64>,
    /// The number of workspace slots that the calls need.
    pub workspace: u32,
    /// The count of numbers read or stored of each argument.
    pub reads: [u32; Base::COUNT],
    /// Whether there are guards.
    pub is_guarded: bool,
}

/// Arithmetic, followed by calls.
#[derive(Debug, Default)]
pub struct Phase {
    /// The values to compute, in this order.
    pub order: Vec<Id>,
    /// The calls; none in the last phase.
    pub calls: Vec<Call>,
}

/// A call before slots are assigned to its arguments and results.
struct Wanted {
    kind: CallKind,
    arguments: Vec<Id>,
    results: Vec<Id>,
}

/// The instructions of a function under construction.
#[derive(Default)]
pub struct Builder {
    nodes: Vec<Node>,
    /// The values in the order of the program, without leaves.
    order: Vec<Id>,
    leaves: HashMap<Location, Id>,
    constants: Vec<u64>,
    constant_of: HashMap<u64, u32>,
    wanted: Vec<Wanted>,
    /// The sine and cosine of an angle.
    circular: HashMap<Id, [Id; 2]>,
    /// The call whose result a leaf is.
    call_of: HashMap<Id, usize>,
}

const SIGN: u64 = 1 << 63;

impl Builder {
    /// Appends a value.
    pub fn add(&mut self, node: Node) -> Id {
        let id = self.nodes.len() as Id;
        self.nodes.push(node);
        if !matches!(node, Node::Leaf(_)) {
            self.order.push(id);
        }
        id
    }

    /// An instruction with two operands.
    pub fn binary(&mut self, instruction: Instruction, a: Id, b: Id) -> Id {
        self.add(Node::Binary(instruction, a, b))
    }

    /// A value in memory.
    pub fn leaf(&mut self, place: Location) -> Id {
        match self.leaves.get(&place) {
            Some(id) => *id,
            None => {
                let id = self.add(Node::Leaf(place));
                self.leaves.insert(place, id);
                id
            }
        }
    }

    fn bits(&mut self, bits: u64) -> Id {
        let next = self.constants.len() as u32;
        let index = *self.constant_of.entry(bits).or_insert(next);
        if index == next {
            self.constants.push(bits);
        }
        self.leaf(Location::Constant(index))
    }

    /// A constant.
    pub fn number(&mut self, number: f64) -> Id {
        self.bits(number.to_bits())
    }

    /// The results of a call whose slots are not yet assigned.
    pub fn call(&mut self, kind: CallKind, arguments: Vec<Id>, results: usize) -> Vec<Id> {
        let call = self.wanted.len();
        let place = Node::Leaf(Location::Workspace(0));
        let results: Vec<Id> = (0..results).map(|_| self.add(place)).collect();
        self.call_of.extend(results.iter().map(|id| (*id, call)));
        self.wanted.push(Wanted {
            kind,
            arguments,
            results: results.clone(),
        });
        results
    }

    /// The sine and the cosine of an angle.
    pub fn circular(&mut self, angle: Id) -> [Id; 2] {
        if let Some(both) = self.circular.get(&angle) {
            return *both;
        }
        let results = self.call(CallKind::Circular, vec![angle], 2);
        let sin_cos = [results[0], results[1]];
        self.circular.insert(angle, sin_cos);
        sin_cos
    }

    /// Moves values in memory.
    pub fn relocate(&mut self, to: impl Fn(Location) -> Location) {
        for node in &mut self.nodes {
            if let Node::Leaf(location) = node {
                *location = to(*location);
            }
        }
    }

    fn read(&mut self, source: Source) -> Id {
        let (base, index) = match source {
            Source::Parameter(index) | Source::Prepared(index) => (Base::Known, index),
            Source::Time => (Base::Time, 0),
            Source::Coordinate(index) => (Base::Coordinates, index),
            Source::Velocity(index) => (Base::Velocities, index),
            Source::Input(index) => (Base::Inputs, index),
            Source::Acceleration(index) => (Base::Accelerations, index),
            Source::AtTime(index) => (Base::AtTime, index),
            Source::AtPosition(index) => (Base::AtPosition, index),
        };
        self.leaf(Location::Argument(base, index))
    }

    /// The rounding error of a product.
    pub fn product_error(&mut self, arithmetic: Arithmetic, a: Id, b: Id) -> Id {
        use Instruction::{Mul, Sub};
        let product = self.binary(Mul, a, b);
        if arithmetic == Arithmetic::Fused {
            return self.add(Node::Contracted(Contracted::Sub, [a, b], product));
        }
        // Step by step as for `f64`: T. J. Dekker, *A floating-point technique for extending the available
        // precision*, Numer. Math. 18 (1971) 224–242.
        let splitter = self.number(134_217_729.0); // 2²⁷ + 1
        let mut halves = |x: Id| {
            let c = self.binary(Mul, splitter, x);
            let rest = self.binary(Sub, c, x);
            let high = self.binary(Sub, c, rest);
            [high, self.binary(Sub, x, high)]
        };
        let [a1, a0] = halves(a);
        let [b1, b0] = halves(b);
        let mut left = product;
        for (x, y) in [(a1, b1), (a0, b1), (a1, b0)] {
            let part = self.binary(Mul, x, y);
            left = self.binary(Sub, left, part);
        }
        let lowest = self.binary(Mul, a0, b0);
        let error = self.binary(Sub, lowest, left);
        // Splitting overflows for numbers near the largest.
        let size = self.magnitude(error);
        let infinity = self.number(f64::INFINITY);
        let is_finite = self.add(Node::Compare(Predicate::Less, size, infinity));
        self.binary(Instruction::And, is_finite, error)
    }

    /// The value with the other sign.
    pub fn negative(&mut self, a: Id) -> Id {
        let sign = self.bits(SIGN);
        self.binary(Instruction::Xor, a, sign)
    }

    /// The rounding error of a sum.
    pub fn sum_error(&mut self, a: Id, b: Id) -> Id {
        use Instruction::{Add, Sub};
        let sum = self.binary(Add, a, b);
        let b_kept = self.binary(Sub, sum, a);
        let a_kept = self.binary(Sub, sum, b_kept);
        let lost_a = self.binary(Sub, a, a_kept);
        let lost_b = self.binary(Sub, b, b_kept);
        self.binary(Add, lost_a, lost_b)
    }

    fn magnitude(&mut self, a: Id) -> Id {
        let all_but_sign = self.bits(!SIGN);
        self.binary(Instruction::And, a, all_but_sign)
    }

    /// `otherwise`, or `a` where that is NaN; there `otherwise` must be all zeros.
    fn or_undefined(&mut self, a: Id, otherwise: Id) -> Id {
        let is_undefined = self.add(Node::Compare(Predicate::Unordered, a, a));
        let undefined = self.binary(Instruction::And, is_undefined, a);
        self.binary(Instruction::Or, otherwise, undefined)
    }

    fn sign(&mut self, a: Id) -> Id {
        let (sign, zero, one) = (self.bits(SIGN), self.number(0.0), self.number(1.0));
        let own = self.binary(Instruction::And, a, sign);
        let one = self.binary(Instruction::Or, own, one);
        let is_any = self.add(Node::Compare(Predicate::Different, a, zero));
        let of_defined = self.binary(Instruction::And, is_any, one);
        self.or_undefined(a, of_defined)
    }

    /// The minimum or maximum; NaN if an operand is NaN.
    fn extreme(&mut self, instruction: Instruction, a: Id, b: Id) -> Id {
        // The instruction gives b where a is NaN.
        let extreme = self.binary(instruction, a, b);
        let ones = self.bits(u64::MAX);
        let is_undefined = self.add(Node::Compare(Predicate::Unordered, a, a));
        let is_defined = self.binary(Instruction::Xor, is_undefined, ones);
        let of_defined = self.binary(Instruction::And, is_defined, extreme);
        self.or_undefined(a, of_defined)
    }

    /// A function of one argument.
    pub fn unary(&mut self, function: Named, a: Id) -> Id {
        match function {
            Named::Sin => self.circular(a)[0],
            Named::Cos => self.circular(a)[1],
            Named::Sqrt => self.add(Node::Root(a)),
            Named::Abs => self.magnitude(a),
            Named::Sign => self.sign(a),
            _ => self.call(CallKind::Named(function), vec![a], 1)[0],
        }
    }

    /// A function of two arguments.
    pub fn pair(&mut self, function: Named, a: Id, b: Id) -> Id {
        match function {
            Named::Min => self.extreme(Instruction::Min, a, b),
            Named::Max => self.extreme(Instruction::Max, a, b),
            _ => self.call(CallKind::Named(function), vec![a, b], 1)[0],
        }
    }
}

impl Lowered {
    /// The instructions of a function.
    pub fn new(function: &Function, arithmetic: Arithmetic) -> Lowered {
        let mut builder = Builder::default();
        let contractions = match arithmetic {
            Arithmetic::Fused => Contractions::of(function),
            Arithmetic::Plain => Contractions::none(function),
        };
        // Guards, ordered by the operation after which both their operands are known.
        let mut guards: Vec<(usize, usize)> = function
            .guards
            .iter()
            .enumerate()
            .map(|(index, guard)| (guard.pivot.index().max(guard.scale.index()), index))
            .collect();
        guards.sort_unstable();
        let mut guards = guards.into_iter().peekable();

        let mut id_of: Vec<Id> = Vec::with_capacity(function.code.len());
        for (index, op) in function.code.iter().enumerate() {
            let value = lagrangian_program::Value(index as u32);
            let at = |value: lagrangian_program::Value| id_of[value.index()];
            let id = match *op {
                // The sum that uses the product computes it.
                _ if contractions.is_part(value) => Id::MAX,
                _ if let Some(sum) = contractions.sum(value) => builder.add(Node::Contracted(
                    sum.kind,
                    sum.factors.map(at),
                    at(sum.term),
                )),
                Op::Constant(ref value) => builder.number(value.evaluate()),
                Op::Pi => builder.number(f64::pi()),
                Op::Read(source) => builder.read(source),
                Op::Add(a, b) => builder.binary(Instruction::Add, at(a), at(b)),
                Op::Sub(a, b) => builder.binary(Instruction::Sub, at(a), at(b)),
                Op::Mul(a, b) => builder.binary(Instruction::Mul, at(a), at(b)),
                Op::Div(a, b) => builder.binary(Instruction::Div, at(a), at(b)),
                Op::Neg(a) => builder.negative(at(a)),
                Op::ProductError(a, b) => builder.product_error(arithmetic, at(a), at(b)),
                Op::SumError(a, b) => builder.sum_error(at(a), at(b)),
                Op::Sin(a) => builder.circular(at(a))[0],
                Op::Cos(a) => builder.circular(at(a))[1],
                Op::Unary(function, a) => builder.unary(function, at(a)),
                Op::Binary(function, a, b) => builder.pair(function, at(a), at(b)),
            };
            id_of.push(id);
            while let Some((_, guard)) = guards.next_if(|(after, _)| *after == index) {
                let guard = &function.guards[guard];
                let [pivot, scale] = [guard.pivot, guard.scale].map(|value| id_of[value.index()]);
                let tolerance = builder.number(guard.tolerance);
                let bound = builder.binary(Instruction::Mul, tolerance, scale);
                builder.add(Node::Guard(pivot, bound));
            }
        }
        let results = (0..).zip(&function.results);
        let results = results.map(|(at, value)| (id_of[value.index()], Base::Results, at));
        builder.in_phases(results.collect())
    }
}

/// When values become known, relative to the calls of functions.
struct Known {
    /// For each value, the phase in which it becomes known.
    values: Vec<u32>,
    /// For each call, the phase after which it is made.
    calls: Vec<u32>,
    /// The last phase.
    last: u32,
}

impl Known {
    fn of(builder: &Builder) -> Known {
        let count = builder.nodes.len();
        let mut values = vec![0u32; count];
        let mut calls = vec![0u32; builder.wanted.len()];
        for id in 0..count {
            values[id] = match builder.nodes[id] {
                Node::Leaf(_) => match builder.call_of.get(&(id as Id)) {
                    Some(call) => {
                        // Arguments have smaller ids than results.
                        let arguments = builder.wanted[*call].arguments.iter();
                        let behind = arguments.map(|id| values[*id as usize]).max();
                        calls[*call] = behind.unwrap_or(0);
                        calls[*call] + 1
                    }
                    None => 0,
                },
                node => {
                    let operands = node.operands();
                    operands.map(|id| values[id as usize]).max().unwrap_or(0)
                }
            };
        }
        let last = calls.iter().map(|phase| phase + 1).max().unwrap_or(0);
        Known {
            values,
            calls,
            last,
        }
    }
}

/// The memory between phases: arguments and results of calls.
#[derive(Default)]
struct Workspace {
    length: u32,
}

impl Workspace {
    /// A call of a function for all that want it, with the places of its arguments and results; the nodes of the results read these.
    fn place(&mut self, nodes: &mut [Node], calls: &[&Wanted], kind: CallKind) -> Call {
        let arguments: Vec<Id> = calls
            .iter()
            .flat_map(|call| call.arguments.iter().copied())
            .collect();
        let from = self.length;
        let to = from + arguments.len() as u32;
        self.length = to;
        // All first results, then all second ones.
        let most = calls.iter().map(|call| call.results.len()).max();
        for index in 0..most.unwrap_or(0) {
            for id in calls.iter().filter_map(|call| call.results.get(index)) {
                nodes[*id as usize] = Node::Leaf(Location::Workspace(self.length));
                self.length += 1;
            }
        }
        if let CallKind::Matrix(_) = kind {
            // The last register of results may be partly unused.
            self.length += 8;
        }
        Call {
            kind,
            arguments,
            from,
            to,
        }
    }
}

impl Builder {
    /// Assigns phases to all values that these results need.
    pub fn in_phases(mut self, results: Vec<(Id, Base, u32)>) -> Lowered {
        let known = Known::of(&self);
        let (phase, is_guarded) = self.latest_phases(&known, &results);
        let mut phases: Vec<Phase> = (0..=known.last).map(|_| Phase::default()).collect();
        for id in &self.order {
            if let Some(phase) = phases.get_mut(phase[*id as usize] as usize) {
                phase.order.push(*id);
            }
        }
        let mut workspace = Workspace::default();
        for (number, phase) in phases.iter_mut().enumerate() {
            let here = self.wanted.iter().zip(&known.calls);
            let here = here.filter(|(_, stands)| **stands as usize == number);
            let (circular, others): (Vec<&Wanted>, Vec<&Wanted>) = here
                .map(|(call, _)| call)
                .partition(|call| call.kind == CallKind::Circular);
            if !circular.is_empty() {
                let call = workspace.place(&mut self.nodes, &circular, CallKind::Circular);
                phase.calls.push(call);
            }
            for call in others {
                let call = workspace.place(&mut self.nodes, &[call], call.kind);
                phase.calls.push(call);
            }
        }
        let reads = self.reads(&results);
        Lowered {
            nodes: self.nodes,
            phases,
            results,
            constants: self.constants,
            workspace: workspace.length,
            reads,
            is_guarded,
        }
    }

    /// The last phase in which each value is early enough, above all of them if it is not needed; and whether there are guards.
    fn latest_phases(&self, known: &Known, results: &[(Id, Base, u32)]) -> (Vec<u32>, bool) {
        let mut phase = vec![u32::MAX; known.values.len()];
        for (id, ..) in results {
            phase[*id as usize] = known.last;
        }
        for (call, stands) in self.wanted.iter().zip(&known.calls) {
            for id in &call.arguments {
                let phase = &mut phase[*id as usize];
                *phase = (*phase).min(*stands);
            }
        }
        let mut is_guarded = false;
        for id in (0..phase.len()).rev() {
            let node = self.nodes[id];
            if matches!(node, Node::Guard(..)) {
                // All guards are in one phase, so that no call separates them.
                phase[id] = known.last;
                is_guarded = true;
            }
            let own = phase[id];
            for operand in node.operands() {
                let phase = &mut phase[operand as usize];
                *phase = (*phase).min(own);
            }
        }
        (phase, is_guarded)
    }

    /// How many numbers are read or written behind each pointer.
    fn reads(&self, results: &[(Id, Base, u32)]) -> [u32; Base::COUNT] {
        let mut reads = [0; Base::COUNT];
        let mut reach = |base: Base, index: u32| {
            let reads = &mut reads[base as usize];
            *reads = (*reads).max(index + 1);
        };
        for node in &self.nodes {
            if let Node::Leaf(Location::Argument(base, index)) = *node {
                reach(base, index);
            }
        }
        for (_, base, index) in results {
            reach(*base, *index);
        }
        reads
    }
}

impl Node {
    /// Its operands.
    pub fn operands(self) -> impl Iterator<Item = Id> {
        let (a, b, c) = match self {
            Node::Leaf(_) => (None, None, None),
            Node::Root(a) => (Some(a), None, None),
            Node::Binary(_, a, b) | Node::Compare(_, a, b) | Node::Guard(a, b) => {
                (Some(a), Some(b), None)
            }
            Node::Contracted(_, [a, b], c) => (Some(a), Some(b), Some(c)),
        };
        a.into_iter().chain(b).chain(c)
    }
}
