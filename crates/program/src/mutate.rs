//! Programs with one mistake each, which a [proof](super::prove()) must detect.

use lagrangian_symbolic::Rational;

use super::{Function, Op, Program, Role, Source, Value};

/// A program with one mistake.
#[derive(Clone, Debug)]
pub struct Mutant {
    /// The change: function, index, and the operation before and after.
    pub change: String,
    /// The program with the change.
    pub program: Program,
}

/// Programs that differ from this one in the sign, the coefficient, the function or the operand of
/// a single operation: every `stride`-th of all of them.
///
/// # Panics
/// If `stride` is 0.
pub fn mutants(program: &Program, stride: usize) -> impl Iterator<Item = Mutant> {
    let prepare = changes(program, &program.prepare).map(|change| (None, change));
    let others = program.functions.iter().enumerate();
    let others = others.flat_map(|(index, function)| {
        changes(program, function).map(move |change| (Some(index), change))
    });
    prepare
        .chain(others)
        .step_by(stride)
        .map(|(function, (index, op))| {
            let mut program = program.clone();
            let function = match function {
                Some(function) => &mut program.functions[function],
                None => &mut program.prepare,
            };
            let change = format!(
                "{}, {index}: {:?} became {op:?}",
                function.role.name(),
                function.code[index]
            );
            function.code[index] = op;
            Mutant { change, program }
        })
}

/// For each value whether it is 0 in exact arithmetic, in which a mistake in its use therefore has no effect.
fn vanishing(function: &Function) -> Vec<bool> {
    let mut vanishes: Vec<bool> = Vec::with_capacity(function.code.len());
    for op in &function.code {
        let is = |value: &Value| vanishes[value.index()];
        vanishes.push(match op {
            Op::ProductError(..) | Op::SumError(..) => true,
            Op::Mul(a, b) => is(a) || is(b),
            Op::Add(a, b) | Op::Sub(a, b) => is(a) && is(b),
            Op::Neg(a) | Op::Div(a, _) => is(a),
            _ => false,
        });
    }
    vanishes
}

/// Every mistake in a function that exact arithmetic can detect.
fn changes<'a>(
    program: &'a Program,
    function: &'a Function,
) -> impl Iterator<Item = (usize, Op)> + 'a {
    let vanishes = vanishing(function);
    function
        .code
        .iter()
        .enumerate()
        .flat_map(move |(index, op)| {
            // A change of sign or of another factor of a zero value changes nothing.
            if vanishes[index] {
                return Vec::new();
            }
            let is_zero = |value: &Value| vanishes[value.index()];
            let before = |value: Value| {
                value
                    .index()
                    .checked_sub(1)
                    .map(|index| Value(index as u32))
            };
            let wrong = match op {
                Op::Add(_, b) | Op::Sub(_, b) if is_zero(b) => vec![],
                Op::Add(a, b) => vec![Some(Op::Sub(*a, *b)), before(*b).map(|b| Op::Add(*a, b))],
                Op::Sub(a, b) => vec![Some(Op::Add(*a, *b)), before(*b).map(|b| Op::Sub(*a, b))],
                Op::Mul(a, b) => vec![Some(Op::Add(*a, *b)), before(*b).map(|b| Op::Mul(*a, b))],
                Op::Div(a, b) => vec![Some(Op::Mul(*a, *b)), before(*b).map(|b| Op::Div(*a, b))],
                Op::Neg(a) => vec![Some(Op::Add(*a, *a))],
                Op::ProductError(..) | Op::SumError(..) => vec![],
                Op::Sin(a) => vec![Some(Op::Cos(*a))],
                Op::Cos(a) => vec![Some(Op::Sin(*a))],
                Op::Constant(value) => {
                    vec![
                        Some(Op::Constant(-value)),
                        Some(Op::Constant(value + &Rational::ONE)),
                    ]
                }
                Op::Pi => vec![Some(Op::Constant(Rational::ONE))],
                Op::Read(source) => vec![neighbour(program, *source).map(Op::Read)],
                Op::Unary(_, a) => vec![Some(Op::Add(*a, *a))],
                Op::Binary(function, a, b) => {
                    vec![Some(Op::Binary(*function, *a, *a)), Some(Op::Add(*a, *b))]
                }
            };
            let others = wrong.into_iter().flatten().filter(|wrong| wrong != op);
            others.map(|wrong| (index, wrong)).collect::<Vec<_>>()
        })
}

/// The argument next to an argument.
fn neighbour(program: &Program, source: Source) -> Option<Source> {
    let n = program.dimension();
    let results = |role| program.function(role).map_or(0, |f| f.results.len());
    let beside = |index: u32, len: usize| (len > 1).then(|| (index + 1) % len as u32);
    match source {
        Source::Parameter(index) => beside(index, program.parameters.len()).map(Source::Parameter),
        Source::Prepared(index) => beside(index, program.prepared.len()).map(Source::Prepared),
        Source::Time => None,
        Source::Coordinate(index) => beside(index, n).map(Source::Coordinate),
        Source::Velocity(index) => beside(index, n).map(Source::Velocity),
        Source::Input(index) => beside(index, program.inputs.len()).map(Source::Input),
        Source::Acceleration(index) => beside(index, n).map(Source::Acceleration),
        Source::AtTime(index) => beside(index, results(Role::AtTime)).map(Source::AtTime),
        Source::AtPosition(index) => {
            beside(index, results(Role::AtPosition)).map(Source::AtPosition)
        }
    }
}
