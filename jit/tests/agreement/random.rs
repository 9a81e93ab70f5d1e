//! Functions that no compiler would emit: random sequences of all operations, with values that stay live for so long that
//! registers run out. Also bounds the cost of compiling them.

use std::sync::Arc;
use std::time::{SystemTime, UNIX_EPOCH};

use lagrangian_jit::{Level, Library};
use lagrangian_mechanics::Compiled;
use lagrangian_program::{Function, Guard, Op, Program, Role, Shape, Source, Value};
use lagrangian_spec::diagnostic::Report;
use lagrangian_spec::source::{InMemory, Sources};
use lagrangian_symbolic::{Dag, Function as Named, Rational};

use super::check::{Numbers, agrees};
use super::library::defaults;

/// How many times two functions are generated.
const ROUNDS: u64 = 60;

/// A machine whose functions are replaced by random ones.
const FRAME: &str = "machine Frame in plane {
    parameters { m1: kg = 1.5, m2: kg = 2, m3: kg = 0.5, k: N/m = 3, l: m = 1 }
    inputs { f: N = 1, h: N = 2 }
    coordinates { x: m = 0, y: m = 0, z: m = 0 }
    bodies { a { mass: m1, at: (x, l) }, b { mass: m2, at: (y, x) }, c { mass: m3, at: (x + y + z, 0) } }
    springs { s { stiffness: k, stretch: x - z } }
    forces { p { on: x, value: f }, r { on: z, value: h } }
}";

fn frame() -> Program {
    let (dag, mut sources, mut report) = (Dag::new(), Sources::new(), Report::new());
    let mut files = InMemory::new();
    let model = lagrangian_spec::model(
        &dag,
        "frame.machine",
        FRAME,
        &[],
        &mut files,
        &mut sources,
        &mut report,
    );
    let compiled = model.and_then(|model| Compiled::new(model, &mut report));
    let compiled = compiled.unwrap_or_else(|| panic!("{}", report.render_short(&sources)));
    compiled.program.into_program()
}

/// A random function with this many operations, including calls of library functions if `calls` is set.
fn function(
    numbers: &mut Numbers,
    frame: &Program,
    role: Role,
    len: usize,
    calls: bool,
) -> Function {
    const TWO: [Named; 4] = [Named::Atan2, Named::Min, Named::Max, Named::Pow];
    let mut code = vec![Op::Read(Source::Time)];
    code.extend((0..3).map(|index| Op::Read(Source::Coordinate(index))));
    code.extend((0..3).map(|index| Op::Read(Source::Velocity(index))));
    code.extend((0..2).map(|index| Op::Read(Source::Input(index))));
    code.extend((0..3).map(|index| Op::Read(Source::Acceleration(index))));
    let prepared = frame.prepare.results.len() as u32;
    code.extend((0..prepared).map(|index| Op::Read(Source::Prepared(index))));
    code.push(Op::Pi);
    code.push(Op::Constant(Rational::from(-3)));
    // The maximum distance of operands: short distances make long dependency chains, long ones need many registers.
    let reach = [4, 20, 80, 1000][numbers.below(4)];
    for _ in 0..len {
        let last = code.len();
        let mut any = || Value((last - 1 - numbers.below(reach.min(last))) as u32);
        let (a, b) = (any(), any());
        code.push(match numbers.below(if calls { 32 } else { 26 }) {
            0..6 => Op::Mul(a, b),
            6..12 => Op::Add(a, b),
            12..18 => Op::Sub(a, b),
            18 | 19 => Op::Div(a, b),
            20 => Op::Neg(a),
            21 => Op::ProductError(a, b),
            22 => Op::SumError(a, b),
            23 => Op::Unary([Named::Abs, Named::Sign, Named::Sqrt][numbers.below(3)], a),
            24 => Op::Binary([Named::Min, Named::Max][numbers.below(2)], a, b),
            25 => Op::Constant(Rational::from(numbers.below(9) as i64 - 4)),
            26 | 27 => Op::Sin(a),
            28 | 29 => Op::Cos(a),
            30 => Op::Unary(Named::ALL[numbers.below(Named::ALL.len())], a),
            _ => Op::Binary(TWO[numbers.below(4)], a, b),
        });
        if let Some(Op::Unary(named, a)) = code.last().cloned()
            && (TWO.contains(&named) || matches!(named, Named::Sin | Named::Cos))
        {
            code.pop();
            code.push(Op::Cos(a));
        }
    }
    let count = code.len();
    // The results are from the last half, so that many operations contribute to them.
    let mut any = |from: usize| Value((from + numbers.below(count - from)) as u32);
    let results: Vec<Value> = (0..5).map(|_| any(count / 2)).collect();
    let guards = if role.inverts() {
        (0..3)
            .map(|coordinate| Guard {
                pivot: any(0),
                scale: any(0),
                tolerance: 1e-3,
                coordinate,
            })
            .collect()
    } else {
        Vec::new()
    };
    Function {
        role,
        code,
        shape: Shape::Vector(results.len()),
        results,
        guards,
        steps: Vec::new(),
    }
}

/// The seed of random numbers: that of the environment, or the time.
pub fn seed() -> u64 {
    match std::env::var("JIT_SEED")
        .ok()
        .and_then(|text| text.parse().ok())
    {
        Some(seed) => seed,
        None => SystemTime::now()
            .duration_since(UNIX_EPOCH)
            .map_or(1, |time| time.as_nanos() as u64 % 1_000_000_007),
    }
}

#[test]
fn random_rows_of_operations_have_the_bits_of_the_interpreter() {
    if Level::here().is_none() {
        println!("no machine code on this processor, or not in this build");
        return;
    }
    let seed = seed();
    println!("JIT_SEED={seed}");
    let frame = frame();
    let parameters = defaults(&frame);
    let mut compared = 0;
    for round in 0..ROUNDS {
        let mut numbers = Numbers(seed.wrapping_mul(1_000_003).wrapping_add(round));
        let mut program = frame.clone();
        let len = [3, 30, 100, 400][numbers.below(4)];
        // One function that is contracted and has guards, and one that is neither.
        let roles = [Role::Accelerations, Role::WorkRate];
        program.functions = roles
            .into_iter()
            .map(|role| {
                let calls = numbers.below(4) > 0;
                function(&mut numbers, &frame, role, len, calls)
            })
            .collect();
        let agreed = agrees(&Arc::new(program), &parameters, seed + round, 16);
        compared += agreed
            .unwrap_or_else(|difference| panic!("JIT_SEED={seed}, round {round}: {difference}"));
    }
    // Five results of two functions at 16 states, for one state and in two ways each for four and eight; more than a tenth
    // of them must be finite.
    let most = ROUNDS as usize * 2 * 5 * 16 * 5 * Level::all().count();
    println!("{compared} of {most} results are finite");
    assert!(compared > most / 10);
}

/// The work of compiling is proportional to the number of operations: per operation, a function of 100 000
/// takes no more than one of 1000.
#[test]
fn many_operations_are_compiled_in_proportion() {
    let Some(level) = Level::here() else {
        println!("no machine code on this processor, or not in this build");
        return;
    };
    let frame = frame();
    let work = |len: usize| {
        let mut numbers = Numbers(7);
        let mut program = frame.clone();
        program.functions = vec![loop {
            // Chooses a function whose operands are far apart.
            let function = function(&mut numbers, &frame, Role::Accelerations, len, true);
            if function.code.len() >= len {
                break function;
            }
        }];
        for layout in [
            Library::one(level),
            Library::several(level, 8, true).expect("there are eight lanes"),
        ] {
            let library = Library::of(Arc::new(program.clone()), layout).expect("pages");
            let code = library.code(Role::Accelerations).expect("it compiles");
            let work = code.work();
            println!("{len} operations: {work:?}, {} bytes", code.length());
            // Besides its own instruction an operation takes at most two loads, a copy, a store and an
            // eviction; the longest operations have twenty instructions. For each of these, finding a register
            // examines each of the 32 once.
            assert!(work.instructions <= 12 * len, "{work:?}");
            assert!(work.evictions <= 3 * len, "{work:?}");
            assert!(work.looks <= 32 * 12 * len, "{work:?}");
            assert!(code.length() <= 12 * 12 * len, "{} bytes", code.length());
        }
    };
    work(1000);
    work(100_000);
}
