//! The paper on the crusher, formula by formula as printed in `machines/paper_crusher.machine`,
//! compared with the machine that it describes; `docs/errata.md`, which lists the errors, compared
//! with the result; and the corrected formulas, typed in by hand.

use std::collections::BTreeSet;

use lagrangian_mechanics::Equations;
use lagrangian_print::compare::{Comparison, compare};
use lagrangian_scalar::{DoubleDouble, Scalar};
use lagrangian_spec::diagnostic::Report;
use lagrangian_spec::model::{Model, PublishedItem, PublishedQuantity};
use lagrangian_spec::source::{Disk, Sources, Span};
use lagrangian_spec::syntax::{
    Expression, ExpressionKind, Published, PublishedItem as Printed, Spanned, Statement,
};
use lagrangian_symbolic::{Dag, Expr, Rational, evaluate, normal, text};

use crate::harness::{derived, library, text_of};

/// The result of comparing the paper's formulas.
struct Errata {
    /// Every formula of the block, and whether it agrees.
    formulas: Vec<(String, bool)>,
    /// The changes, omissions and additions, formula by formula: as printed, and as it should be.
    mistakes: Vec<[String; 3]>,
}

fn errata() -> Errata {
    derived(&text_of("paper_crusher"), |model, equations| {
        let comparisons = compare(model, equations);
        Errata {
            formulas: comparisons
                .iter()
                .map(|c| (c.item.clone(), c.agrees))
                .collect(),
            mistakes: comparisons.iter().flat_map(mistakes).collect(),
        }
    })
}

/// One entry for each change, then for each term to drop, then for each to add.
fn mistakes(comparison: &Comparison<'_>) -> Vec<[String; 3]> {
    let changes = comparison.changes();
    let [add, drop] = comparison.terms().map(|terms| {
        let texts = terms.into_iter().map(|term| term.text);
        texts.collect::<Vec<String>>()
    });
    let line = |printed: &str, right: &str| {
        [&comparison.item, printed, right].map(|cell: &str| cell.to_owned())
    };
    let undotted = comparison.superfluous_dots.iter();
    let mut lines: Vec<_> = undotted.map(|u| line(&u.from, &u.to)).collect();
    lines.extend(changes.iter().map(|&(i, j)| line(&drop[i], &add[j])));
    let alone = |k: &usize, side: fn(&(usize, usize)) -> usize| {
        changes.iter().all(|change| side(change) != *k)
    };
    let dropped = (0..drop.len()).filter(|k| alone(k, |change| change.0));
    lines.extend(dropped.map(|k| line(&drop[k], "")));
    let added = (0..add.len()).filter(|k| alone(k, |change| change.1));
    lines.extend(added.map(|k| line("", &add[k])));
    lines
}

/// The page from the heading of the paper on.
fn page() -> String {
    let path = library().join("../docs/errata.md");
    let page = std::fs::read_to_string(path).expect("the page can be read");
    let start = page.find("## Dynamical simulation of a vibrating crush machine");
    page[start.expect("the paper has a section")..].to_owned()
}

/// The text between backticks.
fn quoted(cell: &str) -> String {
    let mut parts = cell.trim().split('`');
    match (parts.next(), parts.next(), parts.next()) {
        (Some(""), Some(inside), Some("")) => inside.to_owned(),
        _ => String::new(),
    }
}

#[test]
fn the_page_lists_what_the_comparison_finds() {
    let listed: Vec<[String; 3]> = page()
        .lines()
        .filter(|line| line.starts_with("| `"))
        .map(|line| {
            let cells: Vec<&str> = line.split('|').collect();
            assert_eq!(cells.len(), 6, "{line}");
            assert!(!cells[4].trim().is_empty(), "no reason: {line}");
            [1, 2, 3].map(|k| quoted(cells[k]))
        })
        .collect();
    let found = errata().mistakes;
    for (listed, found) in listed.iter().zip(&found) {
        assert_eq!(listed, found);
    }
    assert_eq!(listed.len(), found.len());
}

#[test]
fn every_verdict_of_the_page_is_checked_by_hand() {
    let page = page();
    let checked: Vec<(String, bool)> = page
        .lines()
        .filter_map(|line| line.strip_prefix("- `")?.split_once('`'))
        .map(|(formula, rest)| {
            let verdict = rest.trim_start();
            let (agrees, differs) = (
                verdict.starts_with("agrees"),
                verdict.starts_with("differs"),
            );
            assert!(agrees != differs, "no verdict on {formula}");
            (formula.to_owned(), agrees)
        })
        .collect();
    assert_eq!(checked, errata().formulas);
}

#[test]
fn sixteen_of_the_papers_formulas_are_wrong() {
    let formulas = errata().formulas;
    let wrong = formulas.iter().filter(|(_, agrees)| !agrees).count();
    assert_eq!((wrong, formulas.len()), (16, 31));
    // Positions and velocities of three bodies, T₀ to T₃, T, U, Φ, and for nine coordinates Q and
    // the equation of motion.
    let quantities: BTreeSet<&String> = formulas.iter().map(|(formula, _)| formula).collect();
    assert_eq!(quantities.len(), 6 + 4 + 3 + 9 + 9);
}

#[test]
fn units_give_five_of_the_misprints_away() {
    derived(&text_of("paper_crusher"), |model, equations| {
        let comparisons = compare(model, equations).into_iter();
        let remarked: Vec<(String, usize)> = comparisons
            .map(|c| (c.item, c.remarks.len()))
            .filter(|(_, remarks)| *remarks > 0)
            .collect();
        // A missing dot and a superfluous s₁; a missing dot; ẏ₁ is a velocity, but m₁ has no rate;
        // the cosine of a velocity; a force and a superfluous dot among moments.
        let expected = [
            ("kinetic_energy mortar", 2),
            ("kinetic_energy pestle", 1),
            ("kinetic_energy", 1),
            ("equation x", 1),
            ("equation phi2", 2),
        ];
        assert_eq!(remarked, expected.map(|(item, n)| (item.to_owned(), n)));
    });
}

#[test]
fn what_is_told_mends_the_print() {
    // Every formula with the changes that the comparison proposes, compiled again.
    let paper = text_of("paper_crusher");
    let mended = derived(&paper, |model, equations| {
        let items = model.published.iter().flat_map(|block| &block.items);
        let comparisons = compare(model, equations);
        items
            .zip(&comparisons)
            .map(|(item, comparison)| mended(item, comparison))
            .collect::<Vec<_>>()
    });
    assert_agreement(&with_block(&paper, &mended.join(", ")), mended.len());
}

/// A machine with another published block.
fn with_block(machine: &str, items: &str) -> String {
    let open = machine.trim_end().trim_end_matches('}');
    format!("{open} published \"mended\" {{ {items} }} }}")
}

/// All formulas of a block, added to the machine, agree.
fn assert_agreement(machine: &str, count: usize) {
    derived(machine, |model, equations| {
        let comparisons = compare(model, equations);
        let mended: Vec<_> = comparisons.iter().filter(|c| c.block == "mended").collect();
        assert_eq!(mended.len(), count);
        for comparison in mended {
            let (add, drop) = (comparison.add(), comparison.drop());
            assert!(comparison.agrees, "{}: {add:?}, {drop:?}", comparison.item);
        }
    });
}

/// `printed + Σ add − Σ drop` in the syntax of the spec.
fn mended(item: &PublishedItem, comparison: &Comparison) -> String {
    let printed: Vec<String> = item.printed.iter().map(|&e| text(e, e.dag())).collect();
    let mut formula = match printed.as_slice() {
        [one] => one.clone(),
        several => format!("({})", several.join(", ")),
    };
    let undotted = comparison
        .superfluous_dots
        .iter()
        .map(|undotted| &undotted.term);
    comparison
        .add()
        .iter()
        .chain(undotted)
        .for_each(|term| formula += &format!(" + ({term})"));
    comparison
        .drop()
        .iter()
        .for_each(|term| formula += &format!(" - ({term})"));
    match item.quantity {
        PublishedQuantity::Equation(_) => format!("{}: {formula} = 0", item.text),
        _ => format!("{} = {formula}", item.text),
    }
}

/// The formulas that do not depend on the suspension, corrected by hand.
const CORRECTED: &str = "
    position debalance = (
        x + x0*cos(theta) - y0*sin(theta) + e*cos(omega*t),
        y + x0*sin(theta) + y0*cos(theta) + e*sin(omega*t)
    ),
    velocity debalance = (
        der(x) - x0*sin(theta)*der(theta) - y0*cos(theta)*der(theta) - e*omega*sin(omega*t),
        der(y) + x0*cos(theta)*der(theta) - y0*sin(theta)*der(theta) + e*omega*cos(omega*t)
    ),
    kinetic_energy debalance =
        m0*(der(x)^2 + der(y)^2)/2 + m0*(x0^2 + y0^2)*der(theta)^2/2 + J0*omega^2/2 + m0*e^2*omega^2/2
        + m0*x0*der(y)*der(theta) - m0*y0*der(x)*der(theta)
        - m0*e*omega*sin(omega*t)*der(x) + m0*e*omega*cos(omega*t)*der(y)
        + m0*e*omega*(y0*sin(omega*t) + x0*cos(omega*t))*der(theta),
    position mortar = (x + s1*cos(phi1), y + s1*sin(phi1)),
    velocity mortar = (
        der(x) + der(s1)*cos(phi1) - s1*sin(phi1)*der(phi1),
        der(y) + der(s1)*sin(phi1) + s1*cos(phi1)*der(phi1)
    ),
    kinetic_energy mortar =
        m1/2*(der(x)^2 + der(y)^2 + der(s1)^2 + s1^2*der(phi1)^2
            + 2*cos(phi1)*der(x)*der(s1) - 2*s1*sin(phi1)*der(x)*der(phi1)
            + 2*sin(phi1)*der(y)*der(s1) + 2*s1*cos(phi1)*der(y)*der(phi1)) + J1*der(theta1)^2/2,
    position pestle = (x + s1*cos(phi1) + s2*cos(phi2), y + s1*sin(phi1) + s2*sin(phi2)),
    velocity pestle = (
        der(x) + der(s1)*cos(phi1) - s1*sin(phi1)*der(phi1) + der(s2)*cos(phi2) - s2*sin(phi2)*der(phi2),
        der(y) + der(s1)*sin(phi1) + s1*cos(phi1)*der(phi1) + der(s2)*sin(phi2) + s2*cos(phi2)*der(phi2)
    ),
    kinetic_energy pestle =
        m2/2*(der(x)^2 + der(y)^2 + der(s1)^2 + s1^2*der(phi1)^2 + der(s2)^2 + s2^2*der(phi2)^2
            + 2*cos(phi1)*der(x)*der(s1) - 2*s1*sin(phi1)*der(x)*der(phi1)
            + 2*cos(phi2)*der(x)*der(s2) - 2*s2*sin(phi2)*der(x)*der(phi2)
            + 2*sin(phi1)*der(y)*der(s1) + 2*s1*cos(phi1)*der(y)*der(phi1)
            + 2*sin(phi2)*der(y)*der(s2) + 2*s2*cos(phi2)*der(y)*der(phi2)
            + 2*cos(phi2 - phi1)*der(s1)*der(s2) - 2*s2*sin(phi2 - phi1)*der(s1)*der(phi2)
            + 2*s1*sin(phi2 - phi1)*der(phi1)*der(s2) + 2*s1*s2*cos(phi2 - phi1)*der(phi1)*der(phi2))
        + J2*der(theta2)^2/2,
    kinetic_energy platform = m/2*(der(x)^2 + der(y)^2) + J/2*der(theta)^2,
    kinetic_energy =
        (m0 + m + m1 + m2)*(der(x)^2 + der(y)^2)/2 + (J + m0*(x0^2 + y0^2))*der(theta)^2/2
        + J1*der(theta1)^2/2 + J2*der(theta2)^2/2 + (J0 + m0*e^2)*omega^2/2
        - m0*y0*der(x)*der(theta) + m0*x0*der(y)*der(theta)
        - m0*e*omega*sin(omega*t)*der(x) + m0*e*omega*cos(omega*t)*der(y)
        + m0*e*omega*(y0*sin(omega*t) + x0*cos(omega*t))*der(theta)
        + (m1 + m2)*der(s1)^2/2 + (m1 + m2)*s1^2*der(phi1)^2/2 + m2*s2^2*der(phi2)^2/2 + m2*der(s2)^2/2
        + (m1 + m2)*cos(phi1)*der(x)*der(s1) + (m1 + m2)*sin(phi1)*der(y)*der(s1)
        - (m1 + m2)*s1*sin(phi1)*der(x)*der(phi1) + (m1 + m2)*s1*cos(phi1)*der(y)*der(phi1)
        + m2*cos(phi2)*der(x)*der(s2) + m2*sin(phi2)*der(y)*der(s2)
        - m2*s2*sin(phi2)*der(x)*der(phi2) + m2*s2*cos(phi2)*der(y)*der(phi2)
        + m2*cos(phi2 - phi1)*der(s1)*der(s2) - m2*s2*sin(phi2 - phi1)*der(s1)*der(phi2)
        + m2*s1*sin(phi2 - phi1)*der(phi1)*der(s2) + m2*s1*s2*cos(phi2 - phi1)*der(phi1)*der(phi2),
    force theta1 = 0, force theta2 = 0, force s1 = 0, force s2 = 0, force phi1 = 0, force phi2 = 0,
    equation theta1: J1*der(der(theta1)) = 0,
    equation theta2: J2*der(der(theta2)) = 0,
    equation s1:
        (m1 + m2)*(cos(phi1)*der(der(x)) + sin(phi1)*der(der(y)) + der(der(s1)) - s1*der(phi1)^2)
        + m2*cos(phi2 - phi1)*(der(der(s2)) - s2*der(phi2)^2)
        - m2*sin(phi2 - phi1)*(s2*der(der(phi2)) + 2*der(s2)*der(phi2)) = 0,
    equation s2:
        m2*(cos(phi2)*der(der(x)) + sin(phi2)*der(der(y)) + der(der(s2)) - s2*der(phi2)^2)
        + m2*cos(phi2 - phi1)*(der(der(s1)) - s1*der(phi1)^2)
        + m2*sin(phi2 - phi1)*(s1*der(der(phi1)) + 2*der(s1)*der(phi1)) = 0,
    equation phi1:
        (m1 + m2)*s1*(-sin(phi1)*der(der(x)) + cos(phi1)*der(der(y)) + s1*der(der(phi1)) + 2*der(s1)*der(phi1))
        + m2*s1*sin(phi2 - phi1)*(der(der(s2)) - s2*der(phi2)^2)
        + m2*s1*cos(phi2 - phi1)*(s2*der(der(phi2)) + 2*der(s2)*der(phi2)) = 0,
    equation phi2:
        m2*s2*(-sin(phi2)*der(der(x)) + cos(phi2)*der(der(y)) + s2*der(der(phi2)) + 2*der(s2)*der(phi2))
        - m2*s2*sin(phi2 - phi1)*(der(der(s1)) - s1*der(phi1)^2)
        + m2*s2*cos(phi2 - phi1)*(s1*der(der(phi1)) + 2*der(s1)*der(phi1)) = 0,";

/// The left sides of the platform's equations, corrected by hand, without the
/// suspension's forces but with the drive.
const PLATFORM: [(&str, &str); 3] = [
    (
        "x",
        "(m0 + m1 + m2 + m)*der(der(x)) - m0*y0*der(der(theta))
        + (m1 + m2)*(cos(phi1)*(der(der(s1)) - s1*der(phi1)^2) - sin(phi1)*(s1*der(der(phi1)) + 2*der(s1)*der(phi1)))
        + m2*(cos(phi2)*(der(der(s2)) - s2*der(phi2)^2) - sin(phi2)*(s2*der(der(phi2)) + 2*der(s2)*der(phi2)))
        - m0*e*omega^2*cos(omega*t)",
    ),
    (
        "y",
        "(m0 + m1 + m2 + m)*der(der(y)) + m0*x0*der(der(theta))
        + (m1 + m2)*(sin(phi1)*(der(der(s1)) - s1*der(phi1)^2) + cos(phi1)*(s1*der(der(phi1)) + 2*der(s1)*der(phi1)))
        + m2*(sin(phi2)*(der(der(s2)) - s2*der(phi2)^2) + cos(phi2)*(s2*der(der(phi2)) + 2*der(s2)*der(phi2)))
        - m0*e*omega^2*sin(omega*t)",
    ),
    (
        "theta",
        "-m0*y0*der(der(x)) + m0*x0*der(der(y)) + (J + m0*(x0^2 + y0^2))*der(der(theta))
        - m0*e*omega^2*(x0*sin(omega*t) - y0*cos(omega*t))",
    ),
];

/// The formulas that depend on the suspension: U, Φ, and Q of x, y and θ.
fn suspension([potential, dissipation, x, y, theta]: [&str; 5]) -> String {
    let mut items =
        format!("{CORRECTED} potential_energy = {potential}, dissipation = {dissipation},");
    for ((coordinate, inertia), force) in PLATFORM.into_iter().zip([x, y, theta]) {
        items +=
            &format!("force {coordinate} = {force}, equation {coordinate}: {inertia} = {force},");
    }
    items
}

#[test]
fn with_its_misprints_mended_the_paper_is_right_about_its_single_pair() {
    let items = suspension([
        "cx/2*(x - yc*theta)^2 + cy/2*(y + xc*theta)^2",
        "bx/2*(der(x) - yb*der(theta))^2 + by/2*(der(y) + xb*der(theta))^2",
        "-cx*(x - yc*theta) - bx*(der(x) - yb*der(theta))",
        "-cy*(y + xc*theta) - by*(der(y) + xb*der(theta))",
        "yc*cx*(x - yc*theta) + yb*bx*(der(x) - yb*der(theta)) \
         - xc*cy*(y + xc*theta) - xb*by*(der(y) + xb*der(theta))",
    ]);
    assert_agreement(&with_block(&text_of("paper_crusher"), &items), 31);
}

#[test]
fn the_frozen_crusher_is_the_mended_paper_on_two_pairs() {
    // The left and the right pair add up along x and y, and their couplings with the rotation
    // cancel: there are no cross terms.
    let items = suspension([
        "cx*(x^2 + yc^2*theta^2) + cy*(y^2 + xc^2*theta^2)",
        "bx*(der(x)^2 + yc^2*der(theta)^2) + by*(der(y)^2 + xc^2*der(theta)^2)",
        "-2*cx*x - 2*bx*der(x)",
        "-2*cy*y - 2*by*der(y)",
        "-2*(cx*yc^2 + cy*xc^2)*theta - 2*(bx*yc^2 + by*xc^2)*der(theta)",
    ]);
    assert_agreement(&with_block(&text_of("frozen_crusher"), &items), 31);
}

#[test]
fn the_single_pair_leaves_one_turn_free() {
    // K (yc, −xc, 1)ᵀ = 0 for the stiffnesses of x, y and θ, and the same for the dampers about
    // their joint.
    derived(&text_of("paper_crusher"), |model, equations| {
        let symbol = |name: &str| {
            let parameter = model.parameters.iter().find(|p| p.name.base == name);
            parameter.expect("a parameter of the paper").symbol
        };
        let coordinates = &model.coordinates[..3];
        let free = |energy: Expr<'_>, velocity: bool, [a, b]: [&str; 2]| {
            let at = |k: usize| {
                let c = &coordinates[k];
                if velocity { c.v } else { c.q }
                    .as_symbol()
                    .expect("a symbol")
            };
            let turn = [symbol(b), -symbol(a), model.dag.one()];
            for i in 0..3 {
                let row = (0..3).map(|j| energy.diff(at(i)).diff(at(j)) * turn[j]);
                let pulled = normal::expand(model.dag.sum(row), 100);
                assert!(pulled.is_some_and(|pulled| pulled.is_zero()));
            }
        };
        free(equations.potential_energy, false, ["xc", "yc"]);
        free(equations.dissipation, true, ["xb", "yb"]);
    });
}

/// A state of the crusher, and its accelerations on four corners with the angle frozen, on four
/// corners exactly, and on the single pair. They were computed in absolute coordinates in C++, and
/// by a computer algebra system from T; the two agree to 4e-18.
const TIME: &str = "0.0123";
const STATE: [&str; 18] = [
    "0.003", "-0.002", "0.04", "0.013", "0.7", "-0.3", "0.021", "-1.1", "0.45", //
    "0.15", "-0.22", "0.9", "0.31", "6", "-4", "-0.17", "9", "3",
];
const ACCELERATIONS: [(&str, [&str; 9]); 3] = [
    (
        "frozen_crusher",
        [
            "-58.06880151689501474344",
            "147.2349983706741734878",
            "-22.88686035959440883306",
            "-49.96992096563012409130",
            "-11826.19132404101207146",
            "0",
            "1.701",
            "145.7142857142857142857",
            "0",
        ],
    ),
    (
        "vibrating_crusher",
        [
            "-58.07058210490390359123",
            "147.2370143100931101659",
            "-23.59906154851835761514",
            "-49.96985780063283169436",
            "-11826.39816725667530903",
            "0",
            "1.701",
            "145.7142857142857142857",
            "0",
        ],
    ),
    (
        "paper_crusher",
        [
            "-45.50741769969406675791",
            "130.4712336753392601786",
            "1.517842147577850116677",
            "-48.77788351827255924442",
            "-10217.42977881604323225",
            "0",
            "1.701",
            "145.7142857142857142857",
            "0",
        ],
    ),
];

#[test]
fn three_models_of_the_suspension_accelerate_as_computed_elsewhere() {
    let decimal = |digits: &str| -> DoubleDouble {
        let number = Rational::parse_decimal(digits);
        number.expect("a decimal number").evaluate()
    };
    for (machine, accelerations) in ACCELERATIONS {
        derived(&text_of(machine), |model, equations| {
            let n = model.coordinates.len();
            let mut known = vec![(model.time, decimal(TIME))];
            for (k, c) in model.coordinates.iter().enumerate() {
                known.push((c.q, decimal(STATE[k])));
                known.push((c.v, decimal(STATE[n + k])));
            }
            for p in &model.parameters {
                let default = p.default.expect("every parameter has one");
                let value = evaluate(model.dag, &[default], |_| DoubleDouble::ZERO);
                known.push((p.symbol, value[0]));
            }
            let value = |symbol| {
                let found = known.iter().find(|(e, _)| e.as_symbol() == Some(symbol));
                found.expect("all symbols are known").1
            };
            let entries = evaluate(model.dag, equations.mass_matrix.lower(), value);
            let forces = evaluate(model.dag, &equations.forces, value);
            for (i, &force) in forces.iter().enumerate() {
                let (mut left, mut size) = (-force, force.abs());
                for (j, digits) in accelerations.iter().enumerate() {
                    let (low, high) = (i.min(j), i.max(j));
                    let part = entries[high * (high + 1) / 2 + low] * decimal(digits);
                    left = left + part;
                    size = size + part.abs();
                }
                // The two reference computations agree to 4e-18 of the accelerations.
                let limit = DoubleDouble::from_f64(4e-18) * size;
                assert!(!left.abs().exceeds(limit), "{machine}, row {i}: {left:?}");
            }
        });
    }
}

#[test]
fn one_more_wrong_sign_anywhere_is_found() {
    let (dag, mut sources, mut report) = (Dag::new(), Sources::new(), Report::new());
    let name = library().join("paper_crusher.machine");
    let paper = text_of("paper_crusher");
    let name = name.to_string_lossy();
    let mut spec = lagrangian_spec::parse(&mut sources, &name, &paper, &mut report);
    let [block] = spec.published.as_slice() else {
        panic!("one block holds all formulas");
    };
    // Every mutant is a block of its own, so that all are compared with the same equations.
    let mut mutants: Vec<(usize, String, Published)> = Vec::new();
    for (k, item) in block.items.iter().enumerate() {
        for (place, statement) in flipped(&item.statement) {
            let span = place.start as usize..place.end as usize;
            let title = format!("mutant {}", mutants.len());
            let mutant = Published {
                title: Spanned {
                    value: title,
                    span: block.title.span,
                },
                items: vec![Printed {
                    statement,
                    ..item.clone()
                }],
                ..block.clone()
            };
            mutants.push((k, paper[span].to_owned(), mutant));
        }
    }
    let blocks = mutants.iter().map(|(_, _, mutant)| mutant.clone());
    spec.published.extend(blocks);
    let model = Model::resolve(spec, &dag, &[], &mut Disk, &mut sources, &mut report);
    let model = model.unwrap_or_else(|| panic!("{}", report.render_short(&sources)));
    let equations = Equations::derive(&model, &mut report).expect("it can be derived");
    let comparisons = compare(&model, &equations);
    let (originals, flipped) = comparisons.split_at(31);
    assert_eq!(flipped.len(), mutants.len());
    let said = |c: &Comparison<'_>| (c.agrees, c.add(), c.drop(), c.superfluous_dots.clone());
    let mut survivors = Vec::new();
    for ((k, place, _), (comparison, block)) in mutants
        .iter()
        .zip(flipped.iter().zip(&model.published[1..]))
    {
        let original = &originals[*k];
        if said(comparison) == said(original) {
            // The mutant is equivalent: the formula is the same node, or
            // in an equation its negative.
            let (was, is) = (
                &model.published[0].items[*k].printed,
                &block.items[0].printed,
            );
            let negative: Vec<_> = was.iter().map(|&e| -e).collect();
            let is_equation = original.item.starts_with("equation");
            assert!(
                is == was || (is_equation && *is == negative),
                "{}: the sign of {place} goes unnoticed",
                original.item
            );
            survivors.push((original.item.as_str(), place.as_str()));
        }
    }
    eprintln!(
        "{} mutants, {} of them no change",
        mutants.len(),
        survivors.len()
    );
    assert!(mutants.len() > 300);
    // −J θ″ = 0 is equivalent to J θ″ = 0.
    let expected = [
        ("equation theta1", "J1*der(der(theta1))"),
        ("equation theta2", "J2*der(der(theta2))"),
    ];
    assert_eq!(survivors, expected);
}

/// Copies of the statement with the sign of one term flipped, for every term in it and in its
/// brackets, and the position of that term.
fn flipped(statement: &Statement) -> Vec<(Span, Statement)> {
    let mut all = Vec::new();
    match statement {
        Statement::Value(value) => all.extend(
            flips(value)
                .into_iter()
                .map(|(span, value)| (span, Statement::Value(value))),
        ),
        Statement::Equation(equation) => {
            for (span, left) in flips(&equation.left) {
                let mut flipped = equation.clone();
                flipped.left = left;
                all.push((span, Statement::Equation(flipped)));
            }
            for (span, right) in flips(&equation.right) {
                let mut flipped = equation.clone();
                flipped.right = right;
                all.push((span, Statement::Equation(flipped)));
            }
        }
    }
    all
}

/// Copies of an expression with the sign of one term flipped; a single term counts as a sum, unless it is 0.
fn flips(expression: &Expression) -> Vec<(Span, Expression)> {
    match &expression.kind {
        ExpressionKind::Tuple(components) => {
            let mut all = Vec::new();
            for (k, component) in components.iter().enumerate() {
                for (span, flipped) in flips(component) {
                    let mut components = components.clone();
                    components[k] = flipped;
                    let kind = ExpressionKind::Tuple(components);
                    all.push((
                        span,
                        Expression {
                            kind,
                            ..expression.clone()
                        },
                    ));
                }
            }
            all
        }
        ExpressionKind::Sum(_) => inner_flips(expression),
        ExpressionKind::Number(number) if number == "0" => Vec::new(),
        _ => {
            let kind = ExpressionKind::Negative(Box::new(expression.clone()));
            let whole = Expression {
                kind,
                ..expression.clone()
            };
            let mut all = vec![(expression.span, whole)];
            all.extend(inner_flips(expression));
            all
        }
    }
}

/// Copies of the expression with the sign of a term of one of its inner sums flipped.
fn inner_flips(expression: &Expression) -> Vec<(Span, Expression)> {
    let mut all = Vec::new();
    let mut push = |span, kind| {
        all.push((
            span,
            Expression {
                kind,
                ..expression.clone()
            },
        ))
    };
    match &expression.kind {
        ExpressionKind::Sum(terms) => {
            for (k, term) in terms.iter().enumerate() {
                let mut flipped = terms.clone();
                flipped[k].negative = !term.negative;
                push(term.value.span, ExpressionKind::Sum(flipped));
                for (span, value) in inner_flips(&term.value) {
                    let mut flipped = terms.clone();
                    flipped[k].value = value;
                    push(span, ExpressionKind::Sum(flipped));
                }
            }
        }
        ExpressionKind::Product(factors) => {
            for (k, factor) in factors.iter().enumerate() {
                for (span, value) in inner_flips(&factor.value) {
                    let mut flipped = factors.clone();
                    flipped[k].value = value;
                    push(span, ExpressionKind::Product(flipped));
                }
            }
        }
        ExpressionKind::Negative(inner) => {
            for (span, value) in inner_flips(inner) {
                push(span, ExpressionKind::Negative(Box::new(value)));
            }
        }
        ExpressionKind::Power(base, exponent) => {
            for (span, value) in inner_flips(base) {
                push(
                    span,
                    ExpressionKind::Power(Box::new(value), exponent.clone()),
                );
            }
        }
        ExpressionKind::Call(call) => {
            for (k, argument) in call.arguments.iter().enumerate() {
                for (span, value) in inner_flips(argument) {
                    let mut flipped = call.clone();
                    flipped.arguments[k] = value;
                    push(span, ExpressionKind::Call(flipped));
                }
            }
        }
        _ => {}
    }
    all
}
