//! How freely machines move: against what is counted by hand, and against ranks that are known
//! because the constraints were made with them.

use lagrangian_mechanics::{Freedom, Independent, equations::freedom};

use crate::harness::{derived, library, text_of};

fn of(text: &str) -> Freedom {
    derived(text, freedom)
}

fn counts(text: &str) -> (usize, usize, Option<(usize, usize)>) {
    let Freedom {
        coordinates,
        constraints,
        independent,
    } = of(text);
    let independent = independent.map(|Independent { generic, at_start }| (generic, at_start));
    (coordinates, constraints, independent)
}

#[test]
fn mechanisms_move_as_grübler_says() {
    // 3 (n − 1) − 2 j, with links and joints counted on the drawing.
    for (name, degrees) in [("slider_crank", 1), ("four_bar", 1), ("closed_pendulum", 3)] {
        assert_eq!(of(&text_of(name)).degrees(), Some(degrees), "{name}");
    }
}

#[test]
fn every_mechanism_of_the_library_can_move() {
    for entry in std::fs::read_dir(library()).expect("the library") {
        let path = entry.expect("an entry").path();
        if path
            .extension()
            .is_none_or(|extension| extension != "machine")
        {
            continue;
        }
        let name = path
            .file_stem()
            .expect("a name")
            .to_string_lossy()
            .into_owned();
        let text = text_of(&name);
        if !text.contains("constraints {") && !text.contains("rolling {") {
            continue;
        }
        let found = of(&text);
        assert!(
            found.degrees().is_some_and(|degrees| degrees > 0),
            "{name}: {found:?}"
        );
    }
}

const PENDULUM: &str = "machine P in plane {
    parameters { l: m = 1.5 }
    coordinates { x: m = 0.9, y: m = -1.2 }
    bodies { bob { mass: 1, at: (x, y) } }
    gravity (0, -9.81);
    constraints { CONSTRAINTS }
}";

#[test]
fn what_is_said_twice_counts_once() {
    let with = |constraints: &str| counts(&PENDULUM.replace("CONSTRAINTS", constraints));
    assert_eq!(with("rod: x^2 + y^2 = l^2"), (2, 1, Some((1, 1))));
    let twice = "rod: x^2 + y^2 = l^2, again: sqrt(x^2 + y^2) = l, rate: x*der(x) + y*der(y) = 0";
    assert_eq!(with(twice), (2, 3, Some((1, 1))));
    // Off the constraints the rows of these two are independent, and on them they are not.
    let rim = "rod: x^2 + y^2 = l^2, rim: (x^2 + y^2)*(x^2 + y^2 - l^2)*(2 + x/l) = 0";
    assert_eq!(with(rim), (2, 2, Some((1, 1))));
    // A machine that cannot move.
    assert_eq!(
        with("rod: x^2 + y^2 = l^2, wall: x = 0.9"),
        (2, 2, Some((2, 2)))
    );
    assert_eq!(
        of(&PENDULUM.replace("CONSTRAINTS", "a: x = 0.9, b: y = -1.2")).degrees(),
        Some(0)
    );
}

#[test]
fn a_start_where_motions_fork_is_told() {
    // A parallelogram of unit cranks, flat: there it may turn into a crossed one.
    let bars = |start: &str| {
        counts(&format!(
            "machine Bars in plane {{
                constants {{ l: m = 1 }}
                coordinates {{ a: rad = {start}, b: rad, c: rad = {start} }}
                bodies {{
                    left {{ mass: 1, at: l*direction(a) }},
                    rod {{ mass: 1, at: l*direction(a) + 2*l*direction(b) }},
                    right {{ mass: 1, at: (4*l, 0) + l*direction(c) }},
                }}
                gravity none;
                constraints {{
                    x: cos(a) + 4*cos(b) = 4 + cos(c),
                    y: sin(a) + 4*sin(b) = sin(c),
                }}
            }}"
        ))
    };
    assert_eq!(bars("1"), (3, 2, Some((2, 2))));
    assert_eq!(bars("0"), (3, 2, Some((2, 1))));
}

#[test]
fn the_rank_of_a_mixture_is_the_rank_of_what_was_mixed() {
    // Residuals h_k(q), independent nearly everywhere and zero at the start, mixed by integer matrices
    // of known rank: the first `rank` columns of each row are at random, with an identity in the
    // first rows.
    let mut seed = 20_251_122u64;
    let mut random = move |below: u64| {
        seed = seed
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (seed >> 33) % below
    };
    for case in 0..24 {
        let n = 3 + random(4) as usize;
        let rank = 1 + random(n as u64 - 1) as usize;
        let rows = rank + random(4) as usize;
        let h: Vec<String> = (0..rank)
            .map(|k| {
                let other = (k + 1) % n;
                format!(
                    "sin(q{k}) + {}*q{k}*q{other} + {}*q{other}^2",
                    random(3),
                    random(3)
                )
            })
            .collect();
        let constraints: Vec<String> = (0..rows)
            .map(|row| {
                let weight = |k: usize, free: u64| match row < rank {
                    true => i64::from(row == k),
                    false => free as i64 - 3,
                };
                let terms: Vec<String> = h
                    .iter()
                    .enumerate()
                    .map(|(k, h)| format!("({})*({h})", weight(k, random(7))))
                    .collect();
                format!("c{row}: {} + 0*q0 = 0", terms.join(" + "))
            })
            .collect();
        let coordinates: Vec<String> = (0..n).map(|k| format!("q{k}: rad")).collect();
        let bodies: Vec<String> = (0..n)
            .map(|k| {
                format!(
                    "b{k} {{ mass: 1, inertia: {}, at: (0, 0), angle: q{k} }}",
                    k + 1
                )
            })
            .collect();
        let text = format!(
            "machine M in plane {{ coordinates {{ {} }} bodies {{ {} }} constraints {{ {} }} }}",
            coordinates.join(", "),
            bodies.join(", "),
            constraints.join(", "),
        );
        // A row of zeros constrains nothing, and is refused.
        if constraints
            .iter()
            .any(|row| !row.contains("1)*") && !row.contains("2)*") && !row.contains("3)*"))
        {
            continue;
        }
        let (_, _, independent) = counts(&text);
        assert_eq!(independent, Some((rank, rank)), "case {case}: {text}");
    }
}
