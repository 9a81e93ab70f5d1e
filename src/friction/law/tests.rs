//! Pivoting, blocks and proofs of uniqueness, against all combinations of states.

use std::vec;
use std::vec::Vec;

use super::*;

/// Numbers between −1 and 1 that look drawn at random.
fn drawn(seed: &mut u64) -> f64 {
    *seed ^= *seed << 13;
    *seed ^= *seed >> 7;
    *seed ^= *seed << 17;
    (*seed >> 11) as f64 / (1u64 << 52) as f64 - 1.0
}

/// Contacts of unit masses: slips `w = τ v`, reactions `N = N₀ + K F`.
struct Drawn {
    layout: Layout,
    values: Vec<f64>,
}

impl Drawn {
    /// Contacts of `coordinates` masses whose reactions depend on friction as strongly as `by_friction` says, some of which hold more at rest
    /// if `holds_more`.
    fn new(
        seed: &mut u64,
        (count, coordinates, axes): (usize, usize, usize),
        by_friction: f64,
        holds_more: bool,
    ) -> Drawn {
        let mut list = |number: usize, size: f64| -> Vec<f64> {
            (0..number).map(|_| size * drawn(seed)).collect()
        };
        let rows: Vec<Vec<f64>> = (0..count).map(|_| list(coordinates, 1.0)).collect();
        let alone = list(coordinates, 2.0);
        let normals: Vec<Vec<f64>> = (0..=count)
            .map(|part| list(axes * count, if part == 0 { 3.0 } else { by_friction }))
            .collect();
        let mu: Vec<f64> = list(count, 0.4).iter().map(|x| 0.5 + x).collect();
        let more = list(count, 0.2);
        let more = |k: usize| if holds_more { more[k].max(0.0) } else { 0.0 };
        let at_rest = (0..count).map(|k| mu[k] + more(k)).collect();
        let directions = match axes {
            1 => vec![],
            _ => (0..count)
                .flat_map(|_| {
                    let direction = list(3, 1.0);
                    let length = dot(
                        &[direction[0], direction[1], direction[2]],
                        &[direction[0], direction[1], direction[2]],
                    )
                    .sqrt();
                    direction.into_iter().map(move |x| x / length)
                })
                .collect(),
        };
        let slip = |row: &Vec<f64>, a: &[f64]| row.iter().zip(a).map(|(x, y)| x * y).sum();
        let part = |part: usize| {
            let a = if part == 0 { &alone } else { &rows[part - 1] };
            crate::scalar::friction::FrictionPart {
                accelerations: a.clone(),
                multipliers: vec![],
                slip_rates: rows.iter().map(|row| slip(row, a)).collect(),
                normals: normals[part].clone(),
            }
        };
        let response = FrictionLayout {
            coordinates,
            constraints: 0,
            contacts: count,
            axes,
        };
        let values = FrictionLayout::arrange((0..=count).map(part), [mu, at_rest], directions);
        Drawn {
            layout: Layout {
                response,
                seconds: 0,
            },
            values: values.collect(),
        }
    }

    fn parts(&self) -> Parts<'_> {
        Parts {
            layout: self.layout,
            values: &self.values,
        }
    }
}

/// A question in which contacts slide to either side or rest.
fn question(seed: &mut u64, count: usize) -> OpenStates {
    let slips = Each::from_fn(count, |_| {
        let slip = drawn(seed);
        if slip.abs() < 0.6 { 0.0 } else { slip }
    });
    let layout = Layout {
        response: FrictionLayout {
            coordinates: 1,
            constraints: 0,
            contacts: count,
            axes: 1,
        },
        seconds: 0,
    };
    OpenStates::from_slips(&slips, layout)
}

/// Asserts that two solutions have the same accelerations, to what solving `count` equations with well-conditioned matrices leaves of
/// rounding.
fn assert_same(parts: &Parts<'_>, case: usize, one: &(Mode, Each), other: &(Mode, Each)) {
    for i in 0..parts.layout.response.coordinates {
        let ([x, size], [y, _]) = (parts.sum(i, &one.1), parts.sum(i, &other.1));
        assert!(
            (x - y).abs() <= 1e-9 * size.max(1.0),
            "case {case}: {x} and {y}\n{one:?}\n{other:?}"
        );
    }
}

/// How often each thing happened.
#[derive(Debug, Default)]
struct Tally {
    unique: usize,
    none: usize,
    several: usize,
    found: usize,
    proved: usize,
}

/// Compares pivoting and proofs with all combinations, for contacts that are drawn at random.
fn compare(cases: usize, axes: usize, by_friction: f64, holds_more: bool) -> Tally {
    let mut seed = 0x9e37_79b9_7f4a_7c15 ^ (axes as u64) << 20 ^ by_friction.to_bits();
    let mut tally = Tally::default();
    for case in 0..cases {
        let count = 2 + case % 3;
        // As many coordinates as contacts or more, so that friction forces are determined.
        let drawn = Drawn::new(
            &mut seed,
            (count, count + case % 2, axes),
            by_friction,
            holds_more,
        );
        let (parts, open) = (drawn.parts(), question(&mut seed, count));
        let all = open.by_enumeration(&parts);
        let found = open.by_pivoting(&parts);
        match &all {
            Ok(_) => tally.unique += 1,
            Err(Paradox { several: false, .. }) => tally.none += 1,
            Err(_) => tally.several += 1,
        }
        let is_proved = |(mode, _): &(Mode, Each)| open.has_one_motion(&parts, mode);
        if let Some(found) = &found {
            tally.found += 1;
            tally.proved += usize::from(is_proved(found));
            match &all {
                Ok(all) if !holds_more || is_proved(found) => {
                    assert_same(&parts, case, found, all);
                    assert!(found.0 == all.0, "case {case}: {found:?}\n{all:?}");
                }
                Ok(_) => {}
                Err(paradox) => {
                    assert!(paradox.several, "case {case}: none, but {found:?}");
                    assert!(!is_proved(found), "case {case}: several, but proved");
                }
            }
        } else if let Ok(all) = &all {
            assert!(
                !is_proved(all),
                "case {case}: proved, but not found: {all:?}"
            );
        }
        // Together they say what all combinations say.
        match (open.answer(&parts), &all) {
            (Ok(answer), Ok(all)) => assert_same(&parts, case, &answer, all),
            (Err(answer), Err(all)) => assert_eq!(answer.several, all.several, "case {case}"),
            (answer, all) => panic!("case {case}: {answer:?}, {all:?}"),
        }
    }
    tally
}

#[test]
fn where_friction_presses_nothing_there_is_one_motion_and_pivoting_finds_it() {
    let tally = compare(2000, 1, 0.0, false);
    assert_eq!(
        (tally.unique, tally.found, tally.proved),
        (2000, 2000, 2000)
    );
}

#[test]
fn where_friction_presses_weakly_most_motions_are_proved_to_be_the_only_one() {
    let tally = compare(2000, 1, 0.2, false);
    assert_eq!(tally.unique, tally.found, "{tally:?}");
    assert!(tally.proved > 200, "{tally:?}");
}

#[test]
fn paradoxes_are_never_proved_to_have_one_motion() {
    let tally = compare(3000, 1, 3.0, false);
    assert!(tally.none > 100 && tally.several > 100, "{tally:?}");
    // Where there is one, pivoting may miss it, since the matrix is of no class for which it is known to succeed.
    assert!(tally.found > tally.unique / 2, "{tally:?}");
}

#[test]
fn with_more_friction_at_rest_what_is_proved_is_what_all_combinations_say() {
    let tally = compare(2000, 1, 0.1, true);
    assert!(tally.proved > 100, "{tally:?}");
}

#[test]
fn lengths_of_reactions_in_space_are_found_as_a_fixed_point() {
    for by_friction in [0.0, 0.1] {
        let tally = compare(600, 3, by_friction, false);
        assert!(tally.proved > 100, "{tally:?}");
    }
}

/// Two machines side by side are asked one by one, and the answer is that of all their combinations.
#[test]
fn contacts_that_do_not_depend_on_each_other_are_asked_apart() {
    let mut seed = 0x2545_f491_4f6c_dd1d;
    let mut blocks = vec![];
    for case in 0..200 {
        let mut drawn = Drawn::new(&mut seed, (4, 4, 1), 0.5, false);
        let response = drawn.layout.response;
        // Contacts 0 and 2, and 1 and 3.
        for k in 0..4 {
            for j in (0..4).filter(|j| (j + k) % 2 == 1) {
                for place in [response.slip_rate(k), response.normal(k).start] {
                    drawn.values[response.entry(1 + j, place)] = 0.0;
                }
            }
        }
        let (parts, open) = (drawn.parts(), question(&mut seed, 4));
        blocks = parts.blocks();
        match (open.answer(&parts), open.by_enumeration(&parts)) {
            (Ok(answer), Ok(all)) => {
                assert_same(&parts, case, &answer, &all);
                assert!(answer.0 == all.0, "case {case}: {answer:?}\n{all:?}");
            }
            // One machine may have none where the other has several.
            (Err(_), Err(_)) => {}
            (answer, all) => panic!("case {case}: {answer:?}, {all:?}"),
        }
    }
    assert_eq!(blocks, [vec![0, 2], vec![1, 3]]);
}
