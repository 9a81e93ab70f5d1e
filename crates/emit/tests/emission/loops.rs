//! Repeated code is emitted once, as a loop.

use lagrangian_emit::rust;
use lagrangian_mechanics::Compiled;
use lagrangian_mechanics::Proved;
use lagrangian_program::{Function, Op, Repeat, Role, Shape, Source, Statements, Value};
use lagrangian_spec::diagnostic::Report;
use lagrangian_spec::source::{Disk, Files, Sources};
use lagrangian_symbolic::{Dag, Rational};

/// The program of a chain whose links differ.
fn chain(spec: &str, links: i64) -> Proved {
    let (dag, mut sources, mut report) = (Dag::new(), Sources::new(), Report::new());
    let path = format!("{}/../../{spec}.machine", env!("CARGO_MANIFEST_DIR"));
    let (name, text) = Disk.read(&path, None).expect("it is there");
    lagrangian_spec::model(
        &dag,
        &name,
        &text,
        &[("N".to_owned(), Rational::from(links))],
        &mut Disk,
        &mut sources,
        &mut report,
    )
    .and_then(|model| Compiled::new(model, &mut report))
    .unwrap_or_else(|| panic!("{}", report.render_short(&sources)))
    .program
}

/// The code of a library without the tables of names and the lines that read the parameters, which
/// have an entry per parameter.
fn code(program: &Proved) -> String {
    let text = rust::library(program, &rust::Options::default()).expect("a proof");
    let after = text.find("/// Computes what").expect("it prepares");
    let before = text.find("/// What is prepared of").expect("it has a row");
    let rest = text.find("/// The inputs.").expect("it has inputs");
    format!("{}{}", &text[after..before], &text[rest..])
}

/// With the number of links only the lists of values for the loops grow, by a line for each; for 128
/// links they are at most half of the code.
#[test]
fn twice_the_links_are_far_from_twice_the_code() {
    for spec in ["benches/peers/chain", "machines/chain_relative"] {
        let [short, long] = [128, 256].map(|links| code(&chain(spec, links)));
        assert!(short.contains("for i in 0.."), "{spec}: no loop");
        let growth = long.len() as f64 / short.len() as f64;
        assert!(
            growth <= 1.5,
            "{spec}: {} bytes, {} bytes",
            short.len(),
            long.len()
        );
    }
}

/// Long chains are written with loops; functions short enough to be scheduled
/// in the order of time are not.
#[test]
fn loops_begin_where_a_function_is_long() {
    let has_loops = |links| code(&chain("benches/peers/chain", links)).contains("for i in");
    assert!(has_loops(128));
    assert!(!has_loops(16));
}

/// `x ← x + aᵢ·qᵢ` repeated after a different beginning; the results are the last sum and all terms.
fn horner(links: u32) -> Function {
    let mut code = Vec::new();
    let mut push = |op: Op| {
        code.push(op);
        Value(code.len() as u32 - 1)
    };
    let first = push(Op::Read(Source::Velocity(0)));
    let mut x = push(Op::Mul(first, first));
    let mut results = Vec::new();
    for i in 0..links {
        let (a, q) = (
            push(Op::Read(Source::Prepared(i))),
            push(Op::Read(Source::Coordinate(links - 1 - i))),
        );
        let sine = push(Op::Unary(lagrangian_symbolic::Function::Exp, x));
        let difference = push(Op::Sub(q, sine));
        let product = push(Op::Mul(a, difference));
        let quotient = push(Op::Div(product, sine));
        x = push(Op::Add(quotient, x));
        results.push(difference);
    }
    results.push(x);
    Function {
        role: Role::Output(0),
        shape: Shape::Vector(results.len()),
        code,
        results,
        guards: Vec::new(),
        steps: Vec::new(),
    }
}

fn repeats(function: &Function) -> Vec<Repeat> {
    Statements::of(function, false).repeats(function)
}

#[test]
fn a_repeat_has_the_shortest_body_and_all_iterations() {
    let found = repeats(&horner(10));
    let [repeat] = found.as_slice() else {
        panic!("{found:?}")
    };
    // After the product in front of it, each repetition has five operations.
    assert_eq!((repeat.start, repeat.period, repeat.count), (1, 5, 10));
}

#[test]
fn what_differs_in_one_iteration_ends_a_repeat() {
    let mut function = horner(20);
    let sums = (0..function.code.len()).filter(|&i| matches!(function.code[i], Op::Add(..)));
    let sum = sums.into_iter().nth(11).expect("there are 20 of them");
    if let Op::Add(a, b) = function.code[sum] {
        function.code[sum] = Op::Sub(a, b);
    }
    let found = repeats(&function);
    let iterations: Vec<usize> = found.iter().map(|repeat| repeat.count).collect();
    assert_eq!(iterations, [11, 8], "{found:?}");
}

#[test]
fn three_iterations_are_no_repeat() {
    assert_eq!(repeats(&horner(3)), []);
}
