//! How programs grow with the machine: the number of operations per link is constant.

use std::path::Path;

use lagrangian_mechanics::Compiled;
use lagrangian_mechanics::Oracle;
use lagrangian_mechanics::prove;
use lagrangian_program::Role;
use lagrangian_spec::diagnostic::Report;
use lagrangian_spec::source::{Disk, Sources};
use lagrangian_symbolic::{Dag, Rational};

/// Links in space on hinges with alternating axes, each with a full inertia tensor, so that no
/// frame of the chain moves in a plane.
const SPATIAL: &str = "machine Spatial in space {
    constants { N = 4 }
    parameters { l: m = 0.3, m: kg = 0.7, g: m/s^2 = 9.81 }
    coordinates { q[1..2*N]: rad = 0.2 }
    frames {
        end[0] = ground,
        fork[i in 1..N] = end[i-1].turn(x, q[2*i-1]),
        link[i in 1..N] = fork[i].shift(0, 0, l/4).turn(y, q[2*i]),
        end[i in 1..N] = link[i].shift(0, 0, l),
    }
    bodies {
        fork[i in 1..N] { mass: m/5, inertia: (0.002, 0.001, 0.003), frame: fork[i] },
        link[i in 1..N] {
            mass: m, inertia: (0.02, 0.03, 0.01, 0.001, 0, 0.002), frame: link[i], at: link[i].point(0.01, 0, l/2),
        },
    }
    gravity (0, 0, -g);
}";

/// A closed planar chain, with angles measured from bar to bar or each from the ground.
fn closed(from_the_ground: bool) -> String {
    let frames = if from_the_ground {
        "joint[0] = ground, joint[i in 1..N] = joint[i-1].shift(l*cos(q[i]), l*sin(q[i]))"
    } else {
        "joint[0] = ground, joint[i in 1..N] = joint[i-1].turn(q[i]).shift(l, 0)"
    };
    let bar = if from_the_ground {
        "at: joint[i-1].origin + polar(l/2, q[i]), angle: q[i]"
    } else {
        "frame: joint[i], at: joint[i].point(-l/2, 0)"
    };
    format!(
        "machine Closed in plane {{
            constants {{ N = 5 }}
            parameters {{ l: m = 1, m: kg = 1, J: kg*m^2 = 1/12, d: m = 2, g: m/s^2 = 9.81 }}
            coordinates {{ q[1..N]: rad = 0.3 }}
            frames {{ {frames} }}
            bodies {{ bar[i in 1..N] {{ mass: m, inertia: J, {bar} }} }}
            gravity (0, -g);
            constraints {{
                along: dot(joint[N].origin, (1, 0)) = d,
                across: dot(joint[N].origin, (0, 1)) = 0,
            }}
        }}"
    )
}

/// A binary tree of bars in the plane: bar `i` hangs from the end of bar `i/2`.
fn tree(depth: u32) -> String {
    let bars = 2usize.pow(depth) - 1;
    let mut frames = vec!["end1 = ground.turn(q[1]).shift(0, -l)".to_owned()];
    let mut bodies = vec!["bar1 { mass: m, at: end1.origin }".to_owned()];
    for bar in 2..=bars {
        let parent = bar / 2;
        frames.push(format!(
            "end{bar} = end{parent}.turn(q[{bar}]).shift(0, -l)"
        ));
        bodies.push(format!("bar{bar} {{ mass: m, at: end{bar}.origin }}"));
    }
    format!(
        "machine Tree in plane {{
            parameters {{ l: m = 0.3, m: kg = 0.7, g: m/s^2 = 9.81 }}
            coordinates {{ q[1..{bars}]: rad = 0.2 }}
            frames {{ {} }}
            bodies {{ {} }}
            gravity (0, -g);
        }}",
        frames.join(", "),
        bodies.join(", ")
    )
}

/// The size of a machine's programs.
struct Size {
    accelerations: usize,
    multipliers: usize,
    mass_matrix: usize,
    /// The number of expression nodes created during the derivation.
    nodes: usize,
}

fn compiled<R>(text: &str, n: i64, look: impl for<'d> FnOnce(&Compiled<'d>) -> R) -> R {
    let (dag, mut sources, mut report) = (Dag::new(), Sources::new(), Report::new());
    let constants: Vec<(String, Rational)> = match n {
        0 => Vec::new(),
        n => vec![("N".to_owned(), Rational::from(n))],
    };
    let model = lagrangian_spec::model(
        &dag,
        "growth",
        text,
        &constants,
        &mut Disk,
        &mut sources,
        &mut report,
    );
    match model.and_then(|model| Compiled::new(model, &mut report)) {
        Some(machine) => look(&machine),
        None => panic!("{}", report.render_short(&sources)),
    }
}

fn size(text: &str, n: i64) -> Size {
    compiled(text, n, |machine| {
        let ops = |role| {
            machine
                .program
                .function(role)
                .map_or(0, |f| f.counts().ops())
        };
        let size = Size {
            accelerations: ops(Role::Accelerations),
            multipliers: ops(Role::Multipliers),
            mass_matrix: ops(Role::MassMatrix),
            nodes: machine.model.dag.len(),
        };
        println!(
            "{} {n}: {} operations for accelerations, {} for M, {} nodes",
            machine.program.name, size.accelerations, size.mass_matrix, size.nodes
        );
        size
    })
}

fn library(name: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../../machines/{name}.machine"));
    std::fs::read_to_string(path).expect("a machine of the library")
}

/// With twice as many links, accelerations take at most 2.05 times the operations, and M at most
/// 4.1 times, as it has 3.9 times as many entries.
///
/// Nodes: M has n²/2 entries of at least one node each, and everything else takes a constant number
/// of nodes per link. So from N = 16 to 32 and 64 the count grows as a + b N + c N² with a, b, c
/// not negative, and the second increment is at most four times the first.
fn assert_linear(text: &str) {
    let (half, short, long) = (size(text, 16), size(text, 32), size(text, 64));
    let steps = (short.nodes - half.nodes, long.nodes - short.nodes);
    assert!(steps.1 <= 4 * steps.0, "nodes: {steps:?}");
    assert!(
        100 * long.accelerations <= 205 * short.accelerations,
        "accelerations: {}, {}",
        short.accelerations,
        long.accelerations
    );
    assert!(
        10 * long.mass_matrix <= 41 * short.mass_matrix,
        "M: {}, {}",
        short.mass_matrix,
        long.mass_matrix
    );
}

#[test]
fn a_chain_in_absolute_angles_costs_as_much_per_link_at_any_length() {
    assert_linear(&library("chain"));
}

#[test]
fn a_chain_in_relative_angles_costs_as_much_per_link_at_any_length() {
    assert_linear(&library("chain_relative"));
}

#[test]
fn every_link_of_a_chain_in_space_costs_the_same() {
    let [short, long] = [32, 64].map(|n| size(SPATIAL, n).accelerations);
    assert!(100 * long <= 205 * short, "{short}, {long}");
}

#[test]
fn a_chain_that_closes_costs_as_much_per_link_at_any_length() {
    for text in [closed(true), closed(false)] {
        let [short, long] = [32, 64].map(|n| size(&text, n));
        let [a, b] = [short.accelerations, long.accelerations];
        assert!(100 * b <= 205 * a, "accelerations: {a}, {b}");
        let [a, b] = [short.multipliers, long.multipliers];
        assert!(100 * b <= 205 * a, "multipliers: {a}, {b}");
    }
}

#[test]
fn a_tree_costs_as_much_per_bar_at_any_depth() {
    let (small, large) = (size(&tree(5), 0), size(&tree(6), 0));
    assert!(
        10 * large.accelerations <= 21 * small.accelerations,
        "{}, {}",
        small.accelerations,
        large.accelerations
    );
    // M couples each bar with the bars that hang on it and that it hangs on, n log n pairs: of 31
    // bars 98 pairs, of 63 bars 258, and 31 and 63 diagonal entries.
    assert!(
        (98 + 31) * large.mass_matrix <= (258 + 63) * small.mass_matrix,
        "M: {}, {}",
        small.mass_matrix,
        large.mass_matrix
    );
}

#[test]
fn chains_and_trees_obey_lagranges_equations() {
    let machines = [
        (SPATIAL.to_owned(), 1),
        (SPATIAL.to_owned(), 2),
        (tree(2), 0),
        (tree(3), 0),
        (closed(true), 8),
        (closed(false), 8),
    ];
    for (text, n) in machines {
        compiled(&text, n, |machine| {
            let oracle = Oracle::derive(&machine.model);
            assert_eq!(prove(&machine.program, &machine.model, &oracle), Ok(()));
        });
    }
}
