//! Degrees of freedom of machines, compared with counts by hand, and with ranks that are known by construction.

use lagrangian_mechanics::{Freedom, Independent, contradictions, equations::freedom};
use lagrangian_spec::diagnostic::{Code, Report};

use crate::harness::{derived, library, text_of};

fn of(text: &str) -> Freedom {
    derived(text, freedom)
}

fn counts(text: &str) -> (usize, usize, Option<(usize, usize)>) {
    let Freedom {
        coordinates,
        lengths: _,
        constraints,
        independent,
    } = of(text);
    let independent = independent.map(|Independent { generic, at_start }| (generic, at_start));
    (coordinates, constraints, independent)
}

/// A body whose orientation is four numbers has six degrees of freedom, and three on a ball joint.
#[test]
fn four_numbers_are_three_freedoms() {
    let body = "machine Body in space { coordinates { x: m, y: m, z: m, e[0]: 1 = 1, e[1..3]: 1 }
        frames { f = ground.shift(x, y, z).turn(e[0], e[1], e[2], e[3]) }
        bodies { body { mass: 1, inertia: (1, 2, 3), frame: f, at: f.point(0, 0, 1) } } JOINT }";
    let joint = "constraints { a: x = 0, b: y = 0, c: z = 0 }";
    assert_eq!(of(&body.replace("JOINT", "")).degrees(), Some(6));
    assert_eq!(of(&body.replace("JOINT", joint)).degrees(), Some(3));
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
        assert_eq!(told(&text), Vec::<String>::new(), "{name}");
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
    // The rows of these two constraints are independent off the constraints, and dependent on them.
    let rim = "rod: x^2 + y^2 = l^2, rim: (x^2 + y^2)*(x^2 + y^2 - l^2)*(2 + x/l) = 0";
    assert_eq!(with(rim), (2, 2, Some((1, 1))));
    // This machine cannot move.
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
    // A parallelogram of unit cranks in the flat position, where it may continue as a crossed one.
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
    // Residuals h_k(q), independent nearly everywhere and zero at the start, are mixed by integer matrices of known rank:
    // the first `rank` columns of each row are random, with an identity in the first rows.
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
                let weight = |k: usize, free: u64| {
                    if row < rank {
                        i64::from(row == k)
                    } else {
                        free as i64 - 3
                    }
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
        // A row of zeros constrains nothing and is refused.
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

/// The messages about contradictions.
fn told(text: &str) -> Vec<String> {
    derived(text, |model, equations| {
        let mut report = Report::new();
        contradictions(model, equations, &mut report);
        let messages = report.messages().into_iter();
        messages
            .map(|message| {
                assert_eq!(message.code, Code::Contradiction);
                message.message.clone()
            })
            .collect()
    })
}

/// The text of a particle with these constraints.
fn particle(constraints: &str) -> String {
    format!(
        "machine P in plane {{ parameters {{ w: rad/s = 1.3, d: m = 2 }} coordinates {{ x: m = 1, y: m = 0.3 }} bodies {{ p {{ mass: 1, at: (x, y) }} }}
         constraints {{ {constraints} }} }}"
    )
}

#[test]
fn contradicting_constraints_are_named_with_their_residuals() {
    for (constraints, expected) in [
        // At x = 3/2 both have the same residual.
        (
            "one: x = 1, two: x = 2",
            "`two` contradicts `one` near the start: its residual is 5.00e-1 m",
        ),
        // A circle of radius 1 and the line x = 2, with rows evaluated at (1, 0.3), whose lengths are 2 √1.09 and 1. The
        // minimum of (x² − 1)²/4.36 + (x − 2)² satisfies 2 x³ − 2 x + 4.36 (x − 2) = 0: x = 1.394885.
        (
            "rod: x^2 + y^2 = 1, wall: x = 2",
            "`wall` contradicts `rod` near the start: its residual is 6.05e-1 m",
        ),
        (
            "alone: x^2 + y^2 = -1",
            "`alone` cannot be met near the start: its residual is 1.00e0 m^2",
        ),
        (
            "held: x = 1, moved: der(x) = 2",
            "`moved` contradicts `held` near the start: its residual is 1.00e0 m/s",
        ),
        (
            "a: der(x) = 1, b: 2*der(x) = 4",
            "`b` contradicts `a` near the start: its residual is 1.00e0 m/s",
        ),
    ] {
        let told = told(&particle(constraints));
        assert!(
            matches!(&told[..], [only] if only.contains(expected)),
            "{constraints}: {told:?}"
        );
    }
}

#[test]
fn what_can_be_met_contradicts_nothing() {
    for constraints in [
        "one: x = 1, two: x = 1",
        // Circles that touch from outside, and from inside: they have exactly one common point.
        "a: x^2 + y^2 = 1, b: (x - 2)^2 + y^2 = 1",
        "a: x^2 + y^2 = 4, b: (x - 1)^2 + y^2 = 1",
        "a: x = d*sin(w*t), b: der(x) = d*w*cos(w*t)",
        "ring: x^2 + y^2 = 1, again: 3*sqrt(x^2 + y^2) = 3, drive: der(x) = 0.1",
        "far: x = 1e6, level: y = x",
    ] {
        assert_eq!(
            told(&particle(constraints)),
            Vec::<String>::new(),
            "{constraints}"
        );
    }
}

/// Random rows through a random point, the last a linear combination of the others, with and without an added constant.
#[test]
fn dependent_rows_contradict_where_something_is_added() {
    let clock = std::time::SystemTime::now()
        .duration_since(std::time::UNIX_EPOCH)
        .map_or(1, |now| now.as_nanos() as u64);
    let seed = std::env::var("SEED")
        .ok()
        .and_then(|seed| seed.parse().ok());
    let mut state: u64 = seed.unwrap_or(clock) | 1;
    println!("SEED={state}");
    let mut random = move || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        // Numbers of few digits, so that sums of products are exact.
        (state >> 56) as f64 / 16.0 - 8.0
    };
    const COUNT: usize = 4;
    for _ in 0..20 {
        let point: Vec<f64> = (0..COUNT).map(|_| random()).collect();
        let mut rows: Vec<Vec<f64>> = (0..2)
            .map(|_| (0..COUNT).map(|_| random()).collect())
            .collect();
        let weights = [random() + 9.0, random() + 9.0];
        rows.push(
            (0..COUNT)
                .map(|j| weights[0] * rows[0][j] + weights[1] * rows[1][j])
                .collect(),
        );
        for added in [0.0, 0.25] {
            let rows = rows.iter().enumerate().map(|(k, row)| {
                let terms: Vec<String> = row
                    .iter()
                    .enumerate()
                    .map(|(j, a)| format!("({a})*x{j}"))
                    .collect();
                let right: f64 = row.iter().zip(&point).map(|(a, q)| a * q).sum();
                let right = right + if k == 2 { added } else { 0.0 };
                format!("c{k}: {} = {right}", terms.join(" + "))
            });
            let rows: Vec<String> = rows.collect();
            let names: Vec<String> = (0..COUNT).map(|j| format!("x{j}: m = 0.5")).collect();
            let bodies: Vec<String> = (0..COUNT)
                .map(|j| format!("b{j} {{ mass: 1, at: (x{j}, 0) }}"))
                .collect();
            let text = format!(
                "machine M in plane {{ coordinates {{ {} }} bodies {{ {} }} constraints {{ {} }} }}",
                names.join(", "),
                bodies.join(", "),
                rows.join(", ")
            );
            let told = told(&text);
            let expected = if added == 0.0 {
                Vec::new()
            } else {
                vec!["the constraint `c2` contradicts `c0`, `c1` near the start"]
            };
            assert_eq!(told.len(), expected.len(), "{text}: {told:?}");
            for (told, expected) in told.iter().zip(expected) {
                assert!(told.starts_with(expected), "{text}: {told}");
            }
        }
    }
}
