//! Derivatives compared with the textbook rules applied to plain trees in a prime field; and derivatives
//! of deep expressions.

use crate::support::{Slope, SplitMix, Tree, residue, residues, same, symbols};
use lagrangian_scalar::{Residue, Scalar};
use lagrangian_symbolic::{Dag, Expr, Function, Stage, Tangent, evaluate, reverse, substitute};

/// The smooth functions. Those that `Residue` treats as opaque have derivatives nevertheless.
const FUNCTIONS: [Function; 13] = [
    Function::Sin,
    Function::Cos,
    Function::Tan,
    Function::Asin,
    Function::Acos,
    Function::Atan,
    Function::Atan2,
    Function::Sinh,
    Function::Cosh,
    Function::Tanh,
    Function::Exp,
    Function::Ln,
    Function::Sqrt,
];

#[test]
fn forward_derivatives_follow_the_rules() {
    let mut random = SplitMix(11);
    let mut decided = 0;
    for case in 0..2_000 {
        let tree = Tree::random(&mut random, 1 + case % 4, &FUNCTIONS);
        let dag = Dag::new();
        let symbols = symbols(&dag);
        let derivative = tree
            .build(&dag, &symbols)
            .diff(symbols[2].as_symbol().expect("x"));
        for seed in 0..4 {
            let mut at: Vec<Slope> = residues(seed)
                .into_iter()
                .map(|value| Slope {
                    value,
                    slope: Residue::ZERO,
                })
                .collect();
            at[2].slope = Residue::ONE;
            let expected = tree.value(&at);
            let found = residue(&dag, derivative, seed);
            // A root in the derivative may be undefined where the function has a value.
            if expected.value.is_finite() && expected.slope.is_finite() && found.is_finite() {
                decided += 1;
                assert_eq!(found, expected.slope, "case {case}: {tree:?}");
            }
        }
    }
    assert!(decided > 5_000, "{decided}");
}

#[test]
fn reverse_derivatives_are_the_forward_ones() {
    let mut random = SplitMix(12);
    let mut decided = 0;
    for case in 0..1_000 {
        let dag = Dag::new();
        let symbols = symbols(&dag);
        let mut tree = || Tree::random(&mut random, 1 + case % 4, &FUNCTIONS).build(&dag, &symbols);
        let seeds = [(tree(), tree()), (tree(), symbols[5])];
        let wrt: Vec<_> = symbols.iter().filter_map(|s| s.as_symbol()).collect();
        let gradient = reverse(&dag, &seeds, &wrt);
        for (symbol, found) in wrt.iter().zip(gradient) {
            let expected = dag.sum(seeds.map(|(node, weight)| weight * node.diff(*symbol)));
            if let Some(same) = same(&dag, found, expected) {
                decided += 1;
                assert!(same, "case {case}");
            }
        }
    }
    assert!(decided > 4_000, "{decided}");
}

#[test]
fn a_tangent_is_the_sum_of_its_parts() {
    let dag = Dag::new();
    let [m, _, x, y, u, w] = symbols(&dag)[..] else {
        panic!()
    };
    let [qx, qy] = [x, y].map(|e| e.as_symbol().expect("a symbol"));
    let mut d = Tangent::new(&dag, &[(qx, u), (qy, w)]);
    let e = m * (x * y).sin() + x.powi(3) / y;
    assert_eq!(
        same(&dag, d.of(e), u * e.diff(qx) + w * e.diff(qy)),
        Some(true)
    );
    assert_eq!(d.of(m), dag.zero());
    assert_eq!(d.of(x), u);
}

#[test]
fn functions_with_corners_have_slopes_beside_them() {
    let dag = Dag::new();
    let [_, _, x, y, ..] = symbols(&dag)[..] else {
        panic!()
    };
    let (sx, sy) = (x.as_symbol().expect("x"), y.as_symbol().expect("y"));
    let exprs = [
        x.abs(),
        (x * y).sign(),
        x.min(y),
        x.max(y),
        x.max(2 * x),
        x.pow(y),
        (x * x).pow(x),
    ];
    for e in exprs {
        for (at_x, at_y) in [(0.7, 1.9), (1.9, 0.7)] {
            let value = |e: Expr, dx: f64, dy: f64| {
                evaluate(&dag, &[e], |s| if s == sx { at_x + dx } else { at_y + dy })[0]
            };
            let h = 1e-5;
            let by_x = (value(e, h, 0.0) - value(e, -h, 0.0)) / (2.0 * h);
            let by_y = (value(e, 0.0, h) - value(e, 0.0, -h)) / (2.0 * h);
            // The truncation error of the central difference is h²/6 times the third derivative, its
            // rounding error 1e-16/h.
            assert!((value(e.diff(sx), 0.0, 0.0) - by_x).abs() < 1e-7, "{e:?}");
            assert!((value(e.diff(sy), 0.0, 0.0) - by_y).abs() < 1e-7, "{e:?}");
        }
    }
}

#[test]
fn substitution_replaces_all_symbols_at_once() {
    let mut random = SplitMix(13);
    let mut decided = 0;
    for case in 0..2_000 {
        let dag = Dag::new();
        let symbols = symbols(&dag);
        let none: &[Function] = &[];
        let parts = [(4, &crate::support::SMOOTH[..]), (2, none), (2, none)];
        let trees = parts.map(|(depth, functions)| Tree::random(&mut random, depth, functions));
        let [e, new_x, new_y] = [0, 1, 2].map(|i: usize| trees[i].build(&dag, &symbols));
        let [x, y] = [2, 3].map(|i: usize| symbols[i].as_symbol().expect("a symbol"));
        let [replaced] = substitute(&dag, &[e], &[(x, new_x), (y, new_y)])[..] else {
            panic!()
        };
        let mut at = residues(7);
        (at[2], at[3]) = (trees[1].value(&at), trees[2].value(&at));
        let expected = trees[0].value(&at);
        if expected.is_finite() && at[2].is_finite() && at[3].is_finite() {
            decided += 1;
            assert_eq!(
                residue(&dag, replaced, 7),
                expected,
                "case {case}: {trees:?}"
            );
        }
    }
    assert!(decided > 1_000, "{decided}");
}

#[test]
fn a_chain_of_a_hundred_thousand_nodes_needs_no_stack() {
    let dag = Dag::new();
    let x = dag.symbol("x", Stage(3));
    let symbol = x.as_symbol().expect("x");
    let mut e = x;
    for i in 0..100_000 {
        e = if i % 2 == 0 {
            e + i % 7
        } else {
            x.sin() + e.square().sqrt()
        };
    }
    let derivative = e.diff(symbol);
    let gradient = reverse(&dag, &[(e, dag.one())], &[symbol])[0];
    let moved = substitute(&dag, &[e], &[(symbol, x + 1)])[0];
    assert!(e.depends_on(symbol) && e.symbols().len() == 1);
    let values = evaluate(&dag, &[e, derivative, gradient, moved], |_| 0.3);
    assert!(values.iter().all(|value| value.is_finite()));
    assert!((values[1] - values[2]).abs() < 1e-6 * values[1].abs());
}

/// Horizontal positions of the tips of a chain of n links in relative angles.
fn relative_chain(dag: &Dag, n: usize) -> (Vec<Expr<'_>>, Vec<Expr<'_>>, Vec<Expr<'_>>) {
    let l = dag.symbol("l", Stage::PARAMETER);
    let q: Vec<_> = (0..n)
        .map(|i| dag.symbol(&format!("q{i}"), Stage(3)))
        .collect();
    let v: Vec<_> = (0..n)
        .map(|i| dag.symbol(&format!("v{i}"), Stage(4)))
        .collect();
    let (mut angle, mut x, mut y) = (dag.zero(), dag.zero(), dag.zero());
    let mut positions = Vec::new();
    for &q_i in &q {
        angle = angle + q_i;
        (x, y) = (x + l * angle.cos(), y + l * angle.sin());
        positions.extend([x, y]);
    }
    (positions, q, v)
}

/// The number of nodes of the inverse dynamics of the chain: Σ m·(D²p)·∂p/∂q.
fn nodes_of_inverse_dynamics(n: usize) -> usize {
    let dag = Dag::new();
    let m = dag.symbol("m", Stage::PARAMETER);
    let (positions, q, v) = relative_chain(&dag, n);
    let a: Vec<_> = (0..n)
        .map(|i| dag.symbol(&format!("a{i}"), Stage(6)))
        .collect();
    let symbol = |e: &Expr| e.as_symbol().expect("a symbol");
    let rates = q.iter().zip(&v).chain(v.iter().zip(&a));
    let mut d = Tangent::new(
        &dag,
        &rates.map(|(x, dx)| (symbol(x), *dx)).collect::<Vec<_>>(),
    );
    let seeds: Vec<_> = positions
        .iter()
        .map(|&p| {
            let velocity = d.of(p);
            (p, m * d.of(velocity))
        })
        .collect();
    let q: Vec<_> = q.iter().map(symbol).collect();
    let forces = reverse(&dag, &seeds, &q);
    lagrangian_symbolic::reachable(&dag, &forces).len()
}

#[test]
fn recursion_along_a_chain_is_kept() {
    let counts = [8, 16, 32, 64].map(nodes_of_inverse_dynamics);
    let per_link = |i: usize| (counts[i + 1] - counts[i]) / (8 << i);
    // The number of nodes per further link is constant.
    assert_eq!(per_link(0), per_link(1), "{counts:?}");
    assert_eq!(per_link(1), per_link(2), "{counts:?}");
    assert!(per_link(0) < 60, "{counts:?}");
}

#[test]
fn second_derivatives_are_derivatives_of_derivatives() {
    let mut random = SplitMix(14);
    let mut decided = 0;
    for case in 0..600 {
        let dag = Dag::new();
        let symbols = symbols(&dag);
        let e = Tree::random(&mut random, 1 + case % 4, &FUNCTIONS).build(&dag, &symbols);
        let [x, y, u] = [2, 3, 4].map(|i: usize| symbols[i].as_symbol().expect("a symbol"));
        let rates = [
            (x, symbols[4]),
            (y, symbols[5]),
            (u, symbols[2] * symbols[4]),
        ];
        let mut d = Tangent::new(&dag, &rates);
        let first = d.of(e);
        if let Some(same) = same(&dag, d.twice(e), d.of(first)) {
            decided += 1;
            assert!(same, "case {case}: {e}");
        }
    }
    assert!(decided > 500, "{decided}");
}

/// `|v|ⁿ` for n = 3, 5, 7 and its derivatives `n |v|ⁿ⁻² v` have values at rest,
/// however the power is written.
#[test]
fn odd_powers_of_a_length_have_slopes_at_rest() {
    let dag = Dag::new();
    let [v, w, c] = ["v", "w", "c"].map(|name| dag.symbol(name, Stage(4)));
    let symbol = |e: Expr<'_>| e.as_symbol().expect("a symbol");
    let half = |n: i64| dag.int(n) / 2;
    for square in [
        v.square() + w.square(),
        4 * v.square(),
        v.square() * c.square(),
        v.square(),
    ] {
        for n in [3, 5, 7] {
            let root = square.sqrt();
            let ways = [
                square.pow(half(n)),
                root.powi(n as i32),
                square.powi((n as i32 - 1) / 2) * root,
                square.powi((n as i32 + 1) / 2) / root,
            ];
            for way in ways {
                let scaled = c * way / 3;
                let forward = Tangent::new(&dag, &[(symbol(v), dag.one())]).of(scaled);
                let backward = reverse(&dag, &[(scaled, dag.one())], &[symbol(v), symbol(w)]);
                for (v_at, w_at, c_at) in [(0.0, 0.0, 1.5), (0.6, -0.8, 2.0), (0.0, 3.0, 0.5)] {
                    let value = |s| match s {
                        s if s == symbol(v) => v_at,
                        s if s == symbol(w) => w_at,
                        _ => c_at,
                    };
                    let roots = [
                        scaled,
                        forward,
                        backward[0],
                        backward[1],
                        square.diff(symbol(v)),
                        square,
                    ];
                    let [found, by_v, again, by_w, slope, size]: [f64; 6] =
                        evaluate(&dag, &roots, value)
                            .try_into()
                            .expect("as many as asked for");
                    let power = |n: i64| size.sqrt().powi(n as i32);
                    assert!(
                        (found - c_at * power(n) / 3.0).abs() <= 1e-13 * found.abs(),
                        "{found}"
                    );
                    let expected = c_at / 3.0 * n as f64 / 2.0 * power(n - 2) * slope;
                    for by_v in [by_v, again] {
                        assert!(
                            (by_v - expected).abs() <= 1e-13 * expected.abs(),
                            "{n}: {by_v} {expected}"
                        );
                    }
                    assert!(by_w.is_finite());
                }
            }
        }
    }
}

/// Only common factors of the whole quotient are cancelled, so a quotient
/// without a limit stays undefined.
#[test]
fn quotients_by_a_root_keep_their_values_elsewhere() {
    let dag = Dag::new();
    let [v, w] = ["v", "w"].map(|name| dag.symbol(name, Stage(4)));
    let square = v.square() + w.square();
    let expressions = [
        v / square.sqrt(),
        v.square() / square.sqrt(),
        (v * w) / (v * w).sqrt(),
        v / (v * w).sqrt(),
    ];
    let values: Vec<f64> = evaluate(&dag, &expressions, |s| {
        if Some(s) == v.as_symbol() { 3.0 } else { 4.0 }
    });
    let root = 12.0_f64.sqrt();
    for (found, expected) in values.into_iter().zip([0.6, 1.8, root, 3.0 / root]) {
        assert!((found - expected).abs() < 1e-15 * 8.0, "{found} {expected}");
    }
}
