//! The interpreter: runs programs over any type of number without a compiler. The command line uses
//! it, and generated code is tested against it.

use lagrangian_scalar::Scalar;
use lagrangian_symbolic::Function as Call;
use rustc_hash::FxHashMap;

use super::{Contracted, Contractions, Function, Op, Program, Role, Singular, Source, Value};

/// A program ready to run over numbers of type `S`.
///
/// It executes the operations in the order of the program, and contracts the products that
/// generated code contracts, so in the same arithmetic its results have the same bits as those of
/// generated code. Nothing is allocated after [`Interpreter::new`].
#[derive(Clone, Debug)]
pub struct Interpreter<S> {
    layout: Layout,
    prepare: Tape,
    start: Tape,
    functions: Vec<Tape>,
    /// Constants, arguments, then the values of operations.
    registers: Vec<S>,
    /// Why there are no accelerations at any state, if so.
    singular: Option<Singular>,
}

/// The arguments of a call. Those that a function does not read may be empty.
#[derive(Clone, Copy, Debug)]
pub struct Arguments<'a, S> {
    /// The time.
    pub t: S,
    /// Coordinates.
    pub q: &'a [S],
    /// Velocities.
    pub v: &'a [S],
    /// Inputs.
    pub u: &'a [S],
    /// Accelerations.
    pub a: &'a [S],
}

impl<S: Scalar<Stored = S>> Interpreter<S> {
    /// Prepares a program for the given parameters.
    ///
    /// # Panics
    /// If `parameters` is not as long as [`Program::parameters`].
    pub fn new(program: &Program, parameters: &[S]) -> Interpreter<S> {
        let Tapes {
            layout,
            prepare,
            start,
            functions,
            constants,
        } = Tapes::new(program);
        let mut registers = vec![S::ZERO; layout.constants];
        for constant in &constants {
            registers.push(match constant {
                Op::Constant(value) => value.evaluate(),
                _ => S::pi(),
            });
        }
        let mut interpreter = Interpreter {
            layout,
            prepare,
            start,
            functions,
            registers,
            singular: None,
        };
        interpreter.prepare(parameters);
        interpreter
    }

    /// Changes the parameters.
    ///
    /// # Panics
    /// If `parameters` is not as long as [`Program::parameters`].
    pub fn prepare(&mut self, parameters: &[S]) {
        self.layout.parameters.fill(&mut self.registers, parameters);
        self.prepare.run::<S>(&mut self.registers);
        for (index, value) in self.prepare.results.iter().enumerate() {
            self.registers[self.layout.prepared.start + index] = self.registers[*value as usize];
        }
        self.singular = self.prepare.check(&self.registers).err();
    }

    /// The parameters.
    pub fn parameters(&self) -> &[S] {
        let Region { start, len } = self.layout.parameters;
        &self.registers[start..start + len]
    }

    /// The prepared values, which depend on parameters alone.
    pub fn prepared(&self) -> &[S] {
        let Region { start, len } = self.layout.prepared;
        &self.registers[start..start + len]
    }

    /// Why the machine has no accelerations with these parameters, if so.
    pub fn singular(&self) -> Option<Singular> {
        self.singular
    }

    /// Writes the coordinates and velocities at the start.
    ///
    /// # Panics
    /// If `q` or `v` is not as long as [`Program::coordinates`].
    pub fn start(&mut self, q: &mut [S], v: &mut [S]) {
        self.start.run::<S>(&mut self.registers);
        let n = q.len();
        assert_eq!(v.len(), n, "q and v are as long as the coordinates");
        let results = self.start.results.iter();
        let mut values = results.map(|&value| self.registers[value as usize]);
        for place in q.iter_mut().chain(v) {
            // A machine that starts at rest has no results for its velocities.
            *place = values.next().unwrap_or(S::ZERO);
        }
    }

    /// Runs the function of a role, if the program has one, and writes its results, arranged as its
    /// [`Shape`](super::Shape) says.
    ///
    /// # Panics
    /// If an argument that the function reads, or `results`, has not the length that the
    /// program requires.
    pub fn call(
        &mut self,
        role: Role,
        arguments: Arguments<'_, S>,
        results: &mut [S],
    ) -> Result<(), Singular> {
        self.call_in::<S>(role, arguments, results)
    }

    /// [`call`](Self::call) in the arithmetic of numbers `N`, which are stored as `S`, as generated code does
    /// for accelerations and their derivatives.
    ///
    /// # Panics
    /// As [`call`](Interpreter::call).
    #[inline(always)]
    pub fn call_in<N: Scalar<Stored = S>>(
        &mut self,
        role: Role,
        arguments: Arguments<'_, S>,
        results: &mut [S],
    ) -> Result<(), Singular> {
        let Some(tape) = self.functions.iter().find(|tape| tape.role == role) else {
            return Ok(());
        };
        if let Some(singular) = self.singular.filter(|_| role.inverts()) {
            return Err(singular);
        }
        let reads = tape.reads;
        let registers = &mut self.registers;
        registers[self.layout.time] = arguments.t;
        for (read, region, values) in [
            (reads.coordinates, &self.layout.coordinates, arguments.q),
            (reads.velocities, &self.layout.velocities, arguments.v),
            (reads.inputs, &self.layout.inputs, arguments.u),
            (reads.accelerations, &self.layout.accelerations, arguments.a),
        ] {
            if read {
                region.fill(registers, values);
            }
        }
        tape.run::<N>(registers);
        tape.copy_results(registers, results);
        tape.check(registers)
    }

    /// The smallest ratio of pivot to scale in the last call, which must have been of this role; infinite if there is no pivot.
    pub fn margin(&self, role: Role) -> f64 {
        let tape = self.functions.iter().find(|tape| tape.role == role);
        let checks = tape.map_or(&[][..], |tape| &tape.checks);
        let shares = checks.iter().map(|check| {
            let [pivot, scale] =
                [check.pivot, check.scale].map(|value| self.registers[value as usize].to_f64());
            pivot / scale
        });
        shares.fold(f64::INFINITY, f64::min)
    }

    /// Passes the results of [`Role::AtTime`] or [`Role::AtPosition`] to the calls of the next stage.
    ///
    /// # Panics
    /// If `values` is not as long as the results of that role.
    pub fn set_stage_results(&mut self, role: Role, values: &[S]) {
        let region = match role {
            Role::AtTime => &self.layout.at_time,
            _ => &self.layout.at_position,
        };
        region.fill(&mut self.registers, values);
    }
}

/// The assignment of registers.
#[derive(Clone, Debug)]
struct Layout {
    parameters: Region,
    prepared: Region,
    time: usize,
    coordinates: Region,
    velocities: Region,
    inputs: Region,
    accelerations: Region,
    at_time: Region,
    at_position: Region,
    /// The first register for values of operations.
    temporaries: usize,
    /// The first register for constants.
    constants: usize,
}

#[derive(Clone, Debug)]
struct Region {
    start: usize,
    len: usize,
}

impl Region {
    fn fill<S: Copy>(&self, registers: &mut [S], values: &[S]) {
        registers[self.start..self.start + self.len].copy_from_slice(values);
    }
}

impl Layout {
    fn new(program: &Program) -> Layout {
        let mut next = 0;
        let mut region = |len: usize| {
            let start = next;
            next += len;
            Region { start, len }
        };
        let n = program.dimension();
        let left = |role| program.function(role).map_or(0, |f| f.results.len());
        Layout {
            parameters: region(program.parameters.len()),
            prepared: region(program.prepare.results.len()),
            time: region(1).start,
            coordinates: region(n),
            velocities: region(n),
            inputs: region(program.inputs.len()),
            accelerations: region(n),
            at_time: region(left(Role::AtTime)),
            at_position: region(left(Role::AtPosition)),
            temporaries: next,
            constants: 0,
        }
    }

    fn register(&self, source: Source) -> usize {
        let (region, index) = match source {
            Source::Parameter(index) => (&self.parameters, index),
            Source::Prepared(index) => (&self.prepared, index),
            Source::Time => return self.time,
            Source::Coordinate(index) => (&self.coordinates, index),
            Source::Velocity(index) => (&self.velocities, index),
            Source::Input(index) => (&self.inputs, index),
            Source::Acceleration(index) => (&self.accelerations, index),
            Source::AtTime(index) => (&self.at_time, index),
            Source::AtPosition(index) => (&self.at_position, index),
        };
        region.start + index as usize
    }
}

/// The functions of a program in terms of registers; the same for every type of number, so that they are made by code that is
/// compiled once.
struct Tapes {
    layout: Layout,
    prepare: Tape,
    start: Tape,
    functions: Vec<Tape>,
    /// The operations of constants, in the order of their registers.
    constants: Vec<Op>,
}

impl Tapes {
    fn new(program: &Program) -> Tapes {
        let mut layout = Layout::new(program);
        let mut constants = Constants::default();
        let mut tape = |function: &Function| Tape::new(function, &layout, &mut constants);
        let mut prepare = tape(&program.prepare);
        let mut start = tape(&program.start);
        let mut functions: Vec<Tape> = program.functions.iter().map(tape).collect();
        // Constants come last, since their number is known only now.
        let temporaries = [&prepare, &start]
            .into_iter()
            .chain(&functions)
            .map(|tape| tape.temporaries)
            .max();
        layout.constants = layout.temporaries + temporaries.unwrap_or(0);
        for tape in [&mut prepare, &mut start].into_iter().chain(&mut functions) {
            tape.place_constants(layout.constants);
        }
        Tapes {
            layout,
            prepare,
            start,
            functions,
            constants: constants.operations,
        }
    }
}

/// The constants of all functions, each once.
#[derive(Default)]
struct Constants {
    operations: Vec<Op>,
    index_of: FxHashMap<Op, u32>,
}

/// A register.
type Register = u32;

/// Marks the number of a constant, until the position of the constants is known.
const IS_CONSTANT: Register = 1 << 31;

/// One operation on registers.
#[derive(Clone, Copy, Debug)]
enum Instruction {
    Add {
        to: Register,
        a: Register,
        b: Register,
    },
    Sub {
        to: Register,
        a: Register,
        b: Register,
    },
    Mul {
        to: Register,
        a: Register,
        b: Register,
    },
    Div {
        to: Register,
        a: Register,
        b: Register,
    },
    Neg {
        to: Register,
        a: Register,
    },
    /// A sum with the product that is contracted into it.
    Contracted {
        kind: Contracted,
        to: Register,
        a: Register,
        b: Register,
        c: Register,
    },
    ProductError {
        to: Register,
        a: Register,
        b: Register,
    },
    SumError {
        to: Register,
        a: Register,
        b: Register,
    },
    Sin {
        to: Register,
        a: Register,
    },
    Cos {
        to: Register,
        a: Register,
    },
    SinCos {
        sin: Register,
        cos: Register,
        a: Register,
    },
    Unary {
        call: Call,
        to: Register,
        a: Register,
    },
    Binary {
        call: Call,
        to: Register,
        a: Register,
        b: Register,
    },
}

#[derive(Clone, Debug)]
struct Check {
    pivot: Register,
    scale: Register,
    tolerance: f64,
    coordinate: usize,
}

/// A function in terms of registers.
#[derive(Clone, Debug)]
struct Tape {
    role: Role,
    reads: super::Reads,
    steps: Vec<Instruction>,
    results: Vec<Register>,
    checks: Vec<Check>,
    temporaries: usize,
}

impl Instruction {
    /// The step of an operation whose operands are in registers; `None` if it takes no step, as a constant or an argument.
    fn of(op: &Op, to: Register, at: impl Fn(Value) -> Register) -> Option<Instruction> {
        let binary = |a: &Value, b: &Value| (at(*a), at(*b));
        Some(match op {
            Op::Constant(_) | Op::Pi | Op::Read(_) => return None,
            Op::Add(a, b) => {
                let (a, b) = binary(a, b);
                Instruction::Add { to, a, b }
            }
            Op::Sub(a, b) => {
                let (a, b) = binary(a, b);
                Instruction::Sub { to, a, b }
            }
            Op::Mul(a, b) => {
                let (a, b) = binary(a, b);
                Instruction::Mul { to, a, b }
            }
            Op::Div(a, b) => {
                let (a, b) = binary(a, b);
                Instruction::Div { to, a, b }
            }
            Op::ProductError(a, b) => {
                let (a, b) = binary(a, b);
                Instruction::ProductError { to, a, b }
            }
            Op::SumError(a, b) => {
                let (a, b) = binary(a, b);
                Instruction::SumError { to, a, b }
            }
            &Op::Binary(call, ref a, ref b) => {
                let (a, b) = binary(a, b);
                Instruction::Binary { call, to, a, b }
            }
            &Op::Neg(a) => Instruction::Neg { to, a: at(a) },
            &Op::Sin(a) => Instruction::Sin { to, a: at(a) },
            &Op::Cos(a) => Instruction::Cos { to, a: at(a) },
            &Op::Unary(call, a) => Instruction::Unary { call, to, a: at(a) },
        })
    }
}

impl Constants {
    /// The register of a constant, until the position of the constants is known.
    fn register(&mut self, constant: &Op) -> Register {
        let next = self.operations.len() as u32;
        let index = *self.index_of.entry(constant.clone()).or_insert(next);
        if index == next {
            self.operations.push(constant.clone());
        }
        index | IS_CONSTANT
    }
}

/// Steps in their order, where the sine and the cosine of the same register are one step.
#[derive(Default)]
struct Steps {
    steps: Vec<Instruction>,
    /// The step that computes the sine or the cosine of each register.
    circular: FxHashMap<Register, usize>,
}

impl Steps {
    fn push(&mut self, step: Instruction) {
        if let Instruction::Sin { a, .. } | Instruction::Cos { a, .. } = step {
            let earlier = self.circular.get(&a).copied();
            let destinations = match (earlier.map(|earlier| self.steps[earlier]), step) {
                (Some(Instruction::Sin { to: sin, .. }), Instruction::Cos { to: cos, .. })
                | (Some(Instruction::Cos { to: cos, .. }), Instruction::Sin { to: sin, .. }) => {
                    Some((sin, cos))
                }
                _ => None,
            };
            if let (Some(earlier), Some((sin, cos))) = (earlier, destinations) {
                self.steps[earlier] = Instruction::SinCos { sin, cos, a };
                return;
            }
            self.circular.insert(a, self.steps.len());
        }
        self.steps.push(step);
    }
}

impl Tape {
    fn new(function: &Function, layout: &Layout, constants: &mut Constants) -> Tape {
        let first = layout.temporaries;
        let mut temporaries = 0;
        let mut register: Vec<Register> = Vec::with_capacity(function.code.len());
        let mut steps = Steps::default();
        let contractions = Contractions::of(function);
        for (index, op) in function.code.iter().enumerate() {
            let value = Value(index as u32);
            if contractions.is_part(value) {
                // The sum that uses it computes it.
                register.push(Register::MAX);
                continue;
            }
            let at = |value: Value| register[value.index()];
            let to = (first + temporaries) as Register;
            let step = match contractions.sum(value) {
                Some(sum) => {
                    let ([a, b], c) = (sum.factors.map(at), at(sum.term));
                    let kind = sum.kind;
                    Some(Instruction::Contracted { kind, to, a, b, c })
                }
                None => Instruction::of(op, to, at),
            };
            register.push(match (step, op) {
                (Some(step), _) => {
                    temporaries += 1;
                    steps.push(step);
                    to
                }
                (None, Op::Read(source)) => layout.register(*source) as Register,
                (None, constant) => constants.register(constant),
            });
        }
        let at = |value: &Value| register[value.index()];
        let checks = function.guards.iter().map(|guard| Check {
            pivot: at(&guard.pivot),
            scale: at(&guard.scale),
            tolerance: guard.tolerance,
            coordinate: guard.coordinate,
        });
        Tape {
            role: function.role,
            reads: function.reads(),
            checks: checks.collect(),
            results: function.results.iter().map(at).collect(),
            steps: steps.steps,
            temporaries,
        }
    }

    fn place_constants(&mut self, first: usize) {
        let place = |register: &mut Register| {
            if *register & IS_CONSTANT != 0 {
                *register = (*register & !IS_CONSTANT) + first as Register;
            }
        };
        for step in &mut self.steps {
            match step {
                Instruction::Add { a, b, .. }
                | Instruction::Sub { a, b, .. }
                | Instruction::Mul { a, b, .. }
                | Instruction::Div { a, b, .. }
                | Instruction::ProductError { a, b, .. }
                | Instruction::SumError { a, b, .. }
                | Instruction::Binary { a, b, .. } => {
                    place(a);
                    place(b);
                }
                Instruction::Contracted { a, b, c, .. } => {
                    place(a);
                    place(b);
                    place(c);
                }
                Instruction::Neg { a, .. }
                | Instruction::Sin { a, .. }
                | Instruction::Cos { a, .. }
                | Instruction::SinCos { a, .. }
                | Instruction::Unary { a, .. } => place(a),
            }
        }
        self.results.iter_mut().for_each(place);
        for check in &mut self.checks {
            place(&mut check.pivot);
            place(&mut check.scale);
        }
    }

    /// Runs the steps in the arithmetic of numbers `N`.
    #[inline(always)]
    fn run<N: Scalar>(&self, registers: &mut [N::Stored]) {
        for step in &self.steps {
            let at = |register: Register| N::load(registers[register as usize]);
            let (to, value) = match *step {
                Instruction::Add { to, a, b } => (to, at(a) + at(b)),
                Instruction::Sub { to, a, b } => (to, at(a) - at(b)),
                Instruction::Mul { to, a, b } => (to, at(a) * at(b)),
                Instruction::Div { to, a, b } => (to, at(a) / at(b)),
                Instruction::Neg { to, a } => (to, -at(a)),
                Instruction::Contracted { kind, to, a, b, c } => {
                    let value = match kind {
                        Contracted::Add => at(a).mul_add(at(b), at(c)),
                        Contracted::Sub => at(a).mul_sub(at(b), at(c)),
                        Contracted::SubFrom => at(a).neg_mul_add(at(b), at(c)),
                    };
                    (to, value)
                }
                Instruction::ProductError { to, a, b } => (to, at(a).product_error(at(b))),
                Instruction::SumError { to, a, b } => (to, at(a).sum_error(at(b))),
                Instruction::Sin { to, a } => (to, at(a).sin()),
                Instruction::Cos { to, a } => (to, at(a).cos()),
                Instruction::SinCos { sin, cos, a } => {
                    let (of_sin, of_cos) = at(a).sin_cos();
                    registers[sin as usize] = of_sin.store();
                    (cos, of_cos)
                }
                Instruction::Unary { call, to, a } => (to, unary(call, at(a))),
                Instruction::Binary { call, to, a, b } => (to, binary(call, at(a), at(b))),
            };
            registers[to as usize] = value.store();
        }
    }

    fn copy_results<S: Copy>(&self, registers: &[S], results: &mut [S]) {
        assert_eq!(
            results.len(),
            self.results.len(),
            "space for the results of {}",
            self.role.name()
        );
        for (result, value) in results.iter_mut().zip(&self.results) {
            *result = registers[*value as usize];
        }
    }

    fn check<S: Scalar>(&self, registers: &[S]) -> Result<(), Singular> {
        for check in &self.checks {
            let (pivot, scale) = (
                registers[check.pivot as usize],
                registers[check.scale as usize],
            );
            if !pivot.exceeds(S::from_f64(check.tolerance) * scale) {
                let (pivot, scale) = (pivot.to_f64(), scale.to_f64());
                // If the scale is 0, so is the pivot: the ratio 0/0 is reported as 0.
                let ratio = if pivot == 0.0 { 0.0 } else { pivot / scale };
                return Err(Singular {
                    coordinate: check.coordinate,
                    ratio,
                });
            }
        }
        Ok(())
    }
}

/// A function of one argument.
pub fn unary<S: Scalar>(call: Call, x: S) -> S {
    match call {
        Call::Sin => x.sin(),
        Call::Cos => x.cos(),
        Call::Tan => x.tan(),
        Call::Asin => x.asin(),
        Call::Acos => x.acos(),
        Call::Atan => x.atan(),
        Call::Sinh => x.sinh(),
        Call::Cosh => x.cosh(),
        Call::Tanh => x.tanh(),
        Call::Exp => x.exp(),
        Call::Ln => x.ln(),
        Call::Sqrt => x.sqrt(),
        Call::Abs => x.abs(),
        Call::Sign => x.sign(),
        Call::Atan2 | Call::Min | Call::Max | Call::Pow => {
            unreachable!("{call:?} has two arguments")
        }
    }
}

/// A function of two arguments.
pub fn binary<S: Scalar>(call: Call, x: S, y: S) -> S {
    match call {
        Call::Atan2 => x.atan2(y),
        Call::Min => x.min(y),
        Call::Max => x.max(y),
        Call::Pow => x.powf(y),
        _ => unreachable!("{call:?} has one argument"),
    }
}
