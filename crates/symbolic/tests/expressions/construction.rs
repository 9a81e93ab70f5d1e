//! Simplification by constructors preserves values and keeps the invariants that `dag` promises.

use crate::support::{SMOOTH, SplitMix, Tree, all_functions, residue, residues, symbols};
use lagrangian_scalar::Scalar;
use lagrangian_symbolic::{Dag, Function, Node, Rational, Stage, evaluate, nearest};

#[test]
fn construction_keeps_the_value_exactly() {
    let mut random = SplitMix(1);
    let mut decided = 0;
    for case in 0..20_000 {
        let tree = Tree::random(&mut random, 1 + case % 4, &SMOOTH);
        let dag = Dag::new();
        let e = tree.build(&dag, &symbols(&dag));
        for seed in 0..3 {
            let expected = tree.value(&residues(seed));
            if expected.is_finite() {
                decided += 1;
                let value = residue(&dag, e, seed);
                assert_eq!(value, expected, "case {case}: {tree:?}\nbecame {e:?}");
            }
        }
    }
    assert!(decided > 45_000, "{decided}");
}

#[test]
fn construction_keeps_the_value_of_every_function() {
    let mut random = SplitMix(2);
    let functions = all_functions();
    let mut decided = 0;
    for case in 0..20_000 {
        let tree = Tree::random(&mut random, 1 + case % 3, &functions);
        let dag = Dag::new();
        let e = tree.build(&dag, &symbols(&dag));
        let at: Vec<f64> = (0..6).map(|_| 0.2 + 1.5 * random.uniform()).collect();
        let expected = tree.value(&at);
        let shaken = tree.value(&at.iter().map(|x| x * (1.0 + 1e-9)).collect::<Vec<_>>());
        // If a value depends on the last digits of its arguments, two
        // ways of rounding may disagree.
        let stable = (expected - shaken).abs() < 1e-5 * expected.abs().min(1.0);
        // In floating point sin(π) is not 0, so 1/sin(π) has a value.
        if stable && !e.is_undefined() {
            decided += 1;
            let value = evaluate(&dag, &[e], |s| at[s.index()])[0];
            let close = (value - expected).abs() < 1e-5 * expected.abs().max(1.0);
            assert!(
                close,
                "case {case}: {value} for {expected}: {tree:?}\nbecame {e:?}"
            );
        }
    }
    assert!(decided > 10_000, "{decided}");
}

#[test]
fn the_same_construction_gives_the_same_nodes() {
    let build = || {
        let dag = Dag::new();
        let symbols = symbols(&dag);
        let mut random = SplitMix(3);
        for _ in 0..500 {
            Tree::random(&mut random, 4, &all_functions()).build(&dag, &symbols);
        }
        dag.ids().map(|id| dag.node(id)).collect::<Vec<Node>>()
    };
    assert_eq!(build(), build());
}

#[test]
fn children_are_older_and_in_order() {
    let dag = Dag::new();
    let symbols = symbols(&dag);
    let mut random = SplitMix(4);
    for _ in 0..3_000 {
        let e = Tree::random(&mut random, 4, &all_functions()).build(&dag, &symbols);
        for id in lagrangian_symbolic::reachable(&dag, &[e]) {
            let mut children = Vec::new();
            let node = dag.node(id);
            node.for_each_child(|child| children.push(child));
            assert!(children.iter().all(|&child| child < id));
            match node {
                Node::Sum(terms) => {
                    assert!(children.is_sorted_by(|a, b| a < b));
                    assert!(terms.iter().all(|(_, c)| !c.is_zero()));
                    assert!(terms.len() > 1 || !terms[0].1.is_one());
                }
                Node::Product(factors) => {
                    assert!(children.is_sorted_by(|a, b| a < b));
                    assert!(factors.iter().all(|(_, n)| *n != 0));
                    assert!(factors.len() > 1 || factors[0].1 != 1);
                }
                _ => {}
            }
        }
    }
}

#[test]
fn like_terms_and_like_factors_merge() {
    let dag = Dag::new();
    let [m, k, x, y, ..] = symbols(&dag)[..] else {
        panic!()
    };
    assert_eq!(dag.sum([x, y, -x, 2 * y]), 3 * y);
    assert_eq!(dag.sum([x, y]) - dag.sum([y, x]), dag.zero());
    assert_eq!(x * y * x / y, x.square());
    assert_eq!(x / x, dag.one());
    assert_eq!(dag.zero() * x, dag.zero());
    assert_eq!((2 * x) * (3 * y), 6 * (x * y));
    assert_eq!((2 * x).powi(-2), x.powi(-2) / 4);
    assert_eq!(x.sqrt() * x.sqrt(), x);
    assert_eq!(x.sqrt().powi(-3) * x, 1 / x.sqrt());
    assert_eq!(x.abs().square(), x.square());
    assert_ne!(x.square().sqrt(), x);
    assert_eq!(m * x + k * x, (m + k) * x);
    assert_eq!(m * x + x, (m + 1) * x);
    assert_eq!(2 * (m * x) - (m * x), m * x);
    assert_eq!(
        dag.sum([m * x * y, k * y, -(k * x * y)]),
        dag.sum([(m - k) * x * y, k * y])
    );
}

#[test]
fn squares_of_sine_and_cosine_join() {
    let dag = Dag::new();
    let [m, k, x, y, ..] = symbols(&dag)[..] else {
        panic!()
    };
    let (s, c) = (x.sin(), x.cos());
    assert_eq!(s.square() + c.square(), dag.one());
    assert_eq!(
        dag.sum([m * s.square(), k * y, m * c.square()]),
        dag.sum([m, k * y])
    );
    assert_eq!(m * s.square() + m * c.square() - m, dag.zero());
    assert_eq!(s.powi(4) + s.square() * c.square(), s.square());
    assert_eq!(c.powi(3) + s.square() * c, c);
    assert_eq!(
        dag.sum([
            m * y * s.square(),
            k * y * s.square(),
            (m + k) * y * c.square()
        ]),
        (m + k) * y
    );
    assert_ne!(s.square() + 2 * c.square(), dag.one());
    assert_ne!(s.square() - c.square(), dag.one());
}

#[test]
fn sums_are_not_flattened_nor_products_distributed() {
    let dag = Dag::new();
    let [_, _, x, y, u, w] = symbols(&dag)[..] else {
        panic!()
    };
    let inner = x + y;
    let Node::Sum(terms) = (inner + u).node() else {
        panic!()
    };
    assert_eq!(terms.len(), 2);
    let Node::Product(factors) = (inner * (u + w)).node() else {
        panic!()
    };
    assert_eq!(factors.len(), 2);
    let Node::Sum(terms) = (2 * inner).node() else {
        panic!()
    };
    assert_eq!(terms.len(), 1);
    assert_eq!(
        (x + y).sin().node(),
        dag.function(Function::Sin, &[inner]).node()
    );
}

#[test]
fn signs_leave_odd_and_even_functions() {
    let dag = Dag::new();
    let [_, _, x, y, ..] = symbols(&dag)[..] else {
        panic!()
    };
    assert_eq!((-x).sin(), -x.sin());
    assert_eq!((-x).cos(), x.cos());
    assert_eq!((y - x).sin(), -(x - y).sin());
    assert_eq!((-2 * (y - x)).cos(), (2 * (x - y)).cos());
    assert_eq!((-2 * (y - x)).sin(), (2 * (x - y)).sin());
    assert_eq!((-x).tan(), -x.tan());
    assert_eq!((-x).atan(), -x.atan());
    assert_eq!((-3 * x).abs(), 3 * x.abs());
    assert_eq!((-3 * x).sign(), -x.sign());
    assert_eq!(x.min(y), y.min(x));
}

#[test]
fn constants_have_exact_values() {
    let dag = Dag::new();
    let x = dag.symbol("x", Stage(3));
    let pi = dag.pi();
    let ratio = |n, d| dag.constant(Rational::new(n, d).expect("not over 0"));
    assert_eq!(pi.sin(), dag.zero());
    assert_eq!((pi / 6).sin(), ratio(1, 2));
    assert_eq!((2 * pi / 3).cos(), ratio(-1, 2));
    assert_eq!((-7 * pi / 2).sin(), dag.one());
    assert_eq!(dag.zero().cos(), dag.one());
    assert_eq!((x + pi / 2).sin(), x.cos());
    assert_eq!((x - pi).cos(), -x.cos());
    assert_eq!((pi - x).sin(), x.sin());
    assert_eq!((3 * pi / 2 - x).cos(), -x.sin());
    assert_eq!(ratio(4, 9).sqrt(), ratio(2, 3));
    assert_eq!(dag.zero().exp(), dag.one());
    assert_eq!(dag.one().ln(), dag.zero());
    assert_eq!(ratio(-5, 2).abs(), ratio(5, 2));
    assert_eq!(ratio(-5, 2).sign(), dag.int(-1));
    assert_eq!(dag.zero().sign(), dag.zero());
    assert_eq!(dag.int(2).max(dag.int(3)), dag.int(3));
    assert_eq!(x.pow(dag.int(3)), x.powi(3));
    assert_eq!(x.pow(ratio(-1, 2)), 1 / x.sqrt());
    assert_eq!(dag.one().atan(), pi / 4);
    assert_eq!(x.asin().sin(), x);
    assert_eq!(x.ln().exp(), x);
}

#[test]
fn what_has_no_value_is_reported_and_sticks() {
    let dag = Dag::new();
    let x = dag.symbol("x", Stage(3));
    for e in [
        1 / dag.zero(),
        x / (x - x),
        dag.zero() / 0,
        dag.zero().ln(),
        dag.int(-1).ln(),
        dag.int(-4).sqrt(),
        dag.int(2).asin(),
        (dag.pi() / 2).tan(),
        dag.zero().atan2(dag.zero()),
        dag.int(2).powi(1_000_000_000),
        dag.int(10).pow(dag.int(10).powi(18)),
        x.powi(i32::MAX).powi(2),
        dag.function(Function::Sin, &[]),
    ] {
        assert!(e.is_undefined(), "{e:?}");
        assert!((dag.zero() * e).is_undefined());
        assert!((e - e).is_undefined());
        assert!((e + x).sin().is_undefined());
        assert!(x.pow(e).is_undefined());
        assert!(!evaluate(&dag, &[e], |_| 1.0)[0].is_finite());
    }
    assert_eq!(x.checked_div(dag.zero()), None);
    assert_eq!(x.checked_div(dag.int(2)), Some(x / 2));
}

#[test]
fn long_rows_take_memory_in_proportion() {
    let dag = Dag::new();
    let symbols: Vec<_> = (0..20_000)
        .map(|i| dag.symbol(&format!("x{i}"), Stage(3)))
        .collect();
    let row = symbols.iter().fold(dag.one(), |row, &x| row * x);
    let at_once = dag.product(symbols.iter().copied());
    let value = |e| evaluate(&dag, &[e], |s| 1.0 + 1e-6 * s.index() as f64)[0];
    assert!((value(row) / value(at_once) - 1.0).abs() < 1e-9);
    // At most 64 in every product; the total kept for a row is below 33 factors per step.
    let mut kept = 0;
    for id in dag.ids() {
        dag.node(id).for_each_child(|_| kept += 1);
    }
    assert!(kept < 40 * symbols.len(), "{kept}");
}

#[test]
fn constants_are_rounded_once() {
    let dag = Dag::new();
    let hundredth = dag.constant(Rational::parse_decimal("0.01").expect("a decimal"));
    // 4.999958333472221974206625…e-5; in f64 alone a third of the digits would cancel.
    let versine = dag.one() - hundredth.cos();
    assert_eq!(nearest(versine), 4.999_958_333_472_222e-5);
    let huge = dag.constant(Rational::from(700)).exp();
    assert_eq!(nearest(huge), 1.014_232_054_735_004_5e304);
    assert!(nearest(dag.symbol("x", Stage(0))).is_nan());
    assert!(nearest((-dag.pi()).sqrt()).is_nan());
}
