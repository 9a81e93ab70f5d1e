//! Expanding, folding and comparing preserve values, and identities become zero.

use crate::support::{SMOOTH, SplitMix, Tree, same, symbols};
use lagrangian_symbolic::{Dag, Expr, Stage, Tangent, normal};

const BUDGET: usize = 300;

#[test]
fn expanding_and_folding_keep_the_value() {
    let mut random = SplitMix(31);
    let mut decided = 0;
    for case in 0..1_500 {
        let dag = Dag::new();
        let symbols = symbols(&dag);
        let e = Tree::random(&mut random, 1 + case % 4, &SMOOTH).build(&dag, &symbols);
        let Some(expanded) = normal::expand(e, BUDGET) else {
            continue;
        };
        let sum = dag.sum(expanded.terms().into_iter().map(|(c, x)| c * x));
        for form in [expanded.to_expr(), expanded.fold(), sum] {
            if let Some(same) = same(&dag, form, e) {
                decided += 1;
                assert!(same, "case {case}: {e}\nbecame {form}");
            }
        }
    }
    assert!(decided > 3_000, "{decided}");
}

#[test]
fn a_difference_leads_from_one_expression_to_the_other() {
    let mut random = SplitMix(32);
    let mut decided = 0;
    for case in 0..1_000 {
        let dag = Dag::new();
        let symbols = symbols(&dag);
        let mut tree = |depth| Tree::random(&mut random, depth, &SMOOTH).build(&dag, &symbols);
        let common = tree(3);
        let (printed, derived) = (common + tree(1 + case % 3), tree(1 + case % 3) + common);
        let Some(difference) = normal::difference(printed, derived, BUDGET) else {
            continue;
        };
        let (add, drop) = (dag.sum(difference.add), dag.sum(difference.drop));
        if let Some(same) = same(&dag, printed + add - drop, derived) {
            decided += 1;
            assert!(
                same,
                "case {case}: {printed}\nand {derived}\nadd {add}\ndrop {drop}"
            );
        }
    }
    assert!(decided > 750, "{decided}");
}

#[test]
fn identities_vanish() {
    let dag = Dag::new();
    let [m, k, x, y, u, w] = symbols(&dag)[..] else {
        panic!()
    };
    let zeros = [
        (x + y).sin() - x.sin() * y.cos() - x.cos() * y.sin(),
        (x - y).cos() - x.cos() * y.cos() - x.sin() * y.sin(),
        (2 * x).sin() - 2 * x.sin() * x.cos(),
        (2 * x).cos() - 1 + 2 * x.sin().square(),
        (3 * x).cos() - 4 * x.cos().powi(3) + 3 * x.cos(),
        x.sin() - 2 * (x / 2).sin() * (x / 2).cos(),
        (x / 2).cos().square() - (1 + x.cos()) / 2,
        (x / 2 + x / 3).sin() - (5 * x / 6).sin(),
        (x + y + u).sin().square() + (x + y + u).cos().square() - 1,
        (m + k) * (x + y) * (x - y) - (m + k) * (x.square() - y.square()),
        1 / (2 * x + 2 * y) - 1 / (x + y) / 2,
        x / (x * x + x * y) - 1 / (x + y),
        (x * x + y * y).sqrt().square() - x.square() - y.square(),
        (x + y).sqrt() * (x + y).sqrt() - x - y,
        ((x + y).square() - x.square()).sqrt() - (y.square() + 2 * x * y).sqrt(),
        (-3 * x * y + x).abs().square() - x.square() * (1 - 3 * y).square(),
        (m * w * u).cos() * (k * u).cos()
            - ((m * w + k) * u).cos()
            - (m * w * u).sin() * (k * u).sin(),
        (x + dag.pi() / 3).sin() - x.sin() / 2 - x.cos() * (dag.pi() / 3).sin(),
        (x.tan() * y.tan() - 1) * x.cos() * y.cos() + (x + y).cos(),
    ];
    for e in zeros {
        let expanded = normal::expand(e, 1000).expect("few terms");
        assert!(expanded.is_zero(), "{e} is {}", expanded.to_expr());
    }
    let different = (x - y).cos() - x.cos() * y.cos() + x.sin() * y.sin();
    assert!(!normal::expand(different, 100).expect("few terms").is_zero());
}

#[test]
fn folding_finds_compound_angles_again() {
    let dag = Dag::new();
    let [m, k, x, y, u, w] = symbols(&dag)[..] else {
        panic!()
    };
    let folds = [
        (y - x).cos(),
        m * (x + y).sin(),
        -(k * u * (y - x).sin()),
        dag.sum([x, y, u]).cos(),
        dag.sum([x, y, -u]).sin() * w,
        x.sin().square(),
        m * x.sin().square() * y.sin().square(),
        (x + y).cos() * x.sin(),
        (2 * x).cos(),
        m * (x + y).sin() + k * (y - x).sin(),
        (m + k) * u * (y - x).cos() + m * w * x.sin(),
    ];
    for e in folds {
        let folded = normal::expand(e, 100).expect("few terms").fold();
        assert_eq!(folded, e, "{folded} for {e}");
    }
}

#[test]
fn hopeless_expansions_are_given_up() {
    let dag = Dag::new();
    let x: Vec<_> = (0..40)
        .map(|i| dag.symbol(&format!("x{i}"), Stage(3)))
        .collect();
    let sum = dag.sum(x.iter().copied());
    assert!(normal::expand(sum.powi(1_000_000), 200).is_none());
    assert!(normal::expand(sum.sin(), 200).is_none());
    assert!(normal::expand(x[0].sin().powi(1_000_000_001), 200).is_none());
    assert!(normal::expand((x[0] + 1).powi(2_000), 200).is_none());
    assert!(normal::expand(1 / dag.zero(), 200).is_none());
    // These are one term.
    assert!(normal::expand(x[0].powi(1_000_000), 200).is_some());
    assert!(normal::expand(sum.powi(-1_000_000), 200).is_some());
    // Large multiples of an angle are not expanded.
    let e = (1000 * x[0]).sin() + x[0].sin();
    assert_eq!(normal::expand(e, 200).map(|e| e.len()), Some(2));
    assert_eq!(normal::readable(sum.sin(), 100), sum.sin());
}

#[test]
fn collecting_groups_by_monomials_of_symbols() {
    let dag = Dag::new();
    let [m, k, x, y, u, w] = symbols(&dag)[..] else {
        panic!()
    };
    let [su, sw] = [u, w].map(|e| e.as_symbol().expect("a symbol"));
    let e = m * (u * x.cos() + w).square() + k * u * (y + x.sin()) + m * x;
    let collected = normal::collect(e, &[su, sw], 100).expect("few terms");
    let expected = [
        (u.square(), m * x.cos().square()),
        (u * w, 2 * m * x.cos()),
        (
            u,
            normal::expand(k * (y + x.sin()), 100)
                .expect("few terms")
                .to_expr(),
        ),
        (w.square(), m),
        (dag.one(), m * x),
    ];
    assert_eq!(collected, expected);
}

/// The pestle of the crusher: T₂ derived from positions, and as the paper
/// prints it with its misprints.
#[test]
fn a_printed_formula_is_mended_term_by_term() {
    let dag = Dag::new();
    let m2 = dag.symbol("m2", Stage::PARAMETER);
    let [x, y, s1, phi1, s2, phi2] =
        ["x", "y", "s1", "phi1", "s2", "phi2"].map(|name| dag.symbol(name, Stage(3)));
    let [vx, vy, vs1, vphi1, vs2, vphi2] = ["x", "y", "s1", "phi1", "s2", "phi2"]
        .map(|name| dag.symbol(&format!("der({name})"), Stage(4)));
    let rates = [
        (x, vx),
        (y, vy),
        (s1, vs1),
        (phi1, vphi1),
        (s2, vs2),
        (phi2, vphi2),
    ];
    let rates = rates.map(|(q, v)| (q.as_symbol().expect("a symbol"), v));
    let mut d = Tangent::new(&dag, &rates);
    let at = [
        dag.sum([x, s1 * phi1.cos(), s2 * phi2.cos()]),
        dag.sum([y, s1 * phi1.sin(), s2 * phi2.sin()]),
    ];
    let derived = m2 * dag.sum(at.map(|p| d.of(p).square())) / 2;
    let angle = phi2 - phi1;
    let terms = |printed: bool| {
        let squares = [vx, vy, vs1, s1 * vphi1, vs2, s2 * vphi2].map(|v| v.square());
        let products = [
            phi1.cos() * vx * vs1,
            -(s1 * phi1.sin() * vx * vphi1),
            phi2.cos() * vs2 * if printed { x } else { vx },
            -(s2 * phi2.sin() * vx * vphi2),
            phi1.sin() * vy * vs1,
            s1 * phi1.cos() * vy * vphi1 * if printed { -1 } else { 1 },
            phi2.sin() * vy * vs2,
            s2 * vy * vphi2 * if printed { -phi2.sin() } else { phi2.cos() },
            s1 * angle.sin() * vphi1 * vs2,
            s1 * s2 * angle.cos() * vphi1 * vphi2,
        ];
        // The print omits both of these.
        let left_out = [angle.cos() * vs1 * vs2, -(s2 * angle.sin() * vs1 * vphi2)];
        let left_out = left_out.into_iter().filter(|_| !printed);
        let double = products.into_iter().chain(left_out).map(|term| 2 * term);
        m2 * dag.sum(squares.into_iter().chain(double)) / 2
    };
    let right = normal::difference(terms(false), derived, 1000).expect("a page of terms");
    assert!(right.is_empty(), "{right:?}");
    let mended = normal::difference(terms(true), derived, 1000).expect("a page of terms");
    let show = |terms: &[Expr]| terms.iter().map(|e| e.to_string()).collect::<Vec<_>>();
    let mut add = show(&mended.add);
    let mut drop = show(&mended.drop);
    add.sort();
    drop.sort();
    assert_eq!(
        add,
        [
            "-m2*s2*sin(phi2 - phi1)*der(s1)*der(phi2)",
            "m2*cos(phi2 - phi1)*der(s1)*der(s2)",
            "m2*cos(phi2)*der(x)*der(s2)",
            "m2*s1*cos(phi1)*der(y)*der(phi1)",
            "m2*s2*cos(phi2)*der(y)*der(phi2)",
        ]
    );
    assert_eq!(
        drop,
        [
            "-m2*s1*cos(phi1)*der(y)*der(phi1)",
            "-m2*s2*sin(phi2)*der(y)*der(phi2)",
            "m2*x*cos(phi2)*der(s2)",
        ]
    );
}
