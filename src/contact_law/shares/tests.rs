//! Tests of the sharing of loads.

use super::*;
use std::vec;
use std::vec::Vec;

/// Numbers between −1 and 1 that look drawn at random.
fn drawn(seed: &mut u64) -> f64 {
    *seed ^= *seed << 13;
    *seed ^= *seed >> 7;
    *seed ^= *seed << 17;
    (*seed >> 11) as f64 / (1u64 << 52) as f64 - 1.0
}

/// The shared margin of contacts that are all in one group, the undetermined forces, and the limits.
fn shared(sharers: &[Sharer], by: &[f64], free: usize) -> (f64, Vec<f64>, Vec<Option<Limit>>) {
    let mut groups = vec![0; free];
    group(by, &mut groups);
    let mut numbers = vec![0.0; numbers_length(sharers.len(), free)];
    let mut places = vec![0; places_length(sharers.len(), free)];
    let (mut forces, mut limits) = (vec![0.0; free], vec![None; sharers.len()]);
    let margin = share(
        sharers,
        (by, &groups, 0),
        (&mut numbers, &mut places),
        (&mut forces, &mut limits),
    );
    (margin.expect("solved").value, forces, limits)
}

fn sticks(static_friction: f64, normal: f64, tangential: f64) -> Sharer {
    Sharer {
        static_friction: Some(static_friction),
        presses: true,
        normal,
        tangential: [tangential, 0.0],
    }
}

/// Blocks in a row that hold a force P: `|Tᵢ| ≤ μᵢ (Nᵢ − s)` and `Σ Tᵢ = −P` give `s = (Σ μᵢ Nᵢ − |P|)/Σ μᵢ`, which all of them
/// limit, as far as that is less than the least normal force.
#[test]
fn blocks_in_a_row_hold_up_to_the_sum_of_their_friction() {
    let blocks = [(0.5, 10.0), (0.3, 4.0), (0.2, 7.0), (0.0, 3.0)];
    for pull in [-5.0, -2.0, 0.0, 3.0, 5.0, 7.6, 9.0] {
        // The first holds everything; what another takes, it does not.
        let mut first = -pull;
        let mut sharers = Vec::new();
        for (friction, normal) in blocks {
            sharers.push(sticks(friction, normal, first));
            first = 0.0;
        }
        let mut by = vec![0.0; 4 * 9];
        for i in 0..3 {
            by[3 + i] = -1.0;
            by[9 * (i + 1) + 3 + i] = 1.0;
        }
        let (margin, forces, limits) = shared(&sharers, &by, 3);
        let expected = f64::min(7.6 - f64::abs(pull), 4.0);
        // Each of some ten operations rounds numbers of at most 10.
        assert!((margin - expected).abs() < 1e-14, "{margin} for {expected}");
        assert!(forces[2].abs() < 1e-14, "{forces:?}");
        let way = Some(Limit::Friction([if pull > 0.0 { -1.0 } else { 1.0 }, 0.0]));
        if expected < 4.0 {
            assert_eq!(limits, [way, way, way, None]);
        }
    }
}

/// The best of all points where as many conditions as there are unknowns are just satisfied, and all others are satisfied.
#[test]
fn no_corner_of_the_conditions_is_better() {
    let mut seed = 0x9e37_79b9_7f4a_7c15;
    for case in 0..400 {
        let free = 1 + case % 3;
        let count = free + 1 + case % 2;
        let mut by: Vec<f64> = (0..PARTS * free * count)
            .map(|_| drawn(&mut seed))
            .collect();
        let mut sharers = Vec::new();
        for (k, own) in by.chunks_exact_mut(PARTS * free).enumerate() {
            own[2 * free..].fill(0.0);
            // With normal forces that change little the margin is bounded; some contacts only press.
            own[..free].iter_mut().for_each(|x| *x *= 0.1);
            let mut sharer = sticks(
                0.5 + 0.4 * drawn(&mut seed),
                drawn(&mut seed),
                drawn(&mut seed),
            );
            if k == count - 1 && count > free + 1 {
                sharer.static_friction = None;
                own[free..].fill(0.0);
            }
            sharers.push(sharer);
        }
        let mut rows: Vec<Vec<f64>> = Vec::new();
        for (sharer, own) in sharers.iter().zip(by.chunks_exact(PARTS * free)) {
            let friction = sharer.static_friction;
            let signs: &[f64] = if friction.is_some() {
                &[1.0, -1.0]
            } else {
                &[0.0]
            };
            for sign in signs {
                let factor = friction.unwrap_or(1.0);
                let mut row: Vec<f64> = (0..free)
                    .map(|i| factor * own[i] - sign * own[free + i])
                    .collect();
                row.push(-factor);
                row.push(factor * sharer.normal - sign * sharer.tangential[0]);
                rows.push(row);
            }
        }
        let mut best = f64::NEG_INFINITY;
        for set in 0_u32..1 << rows.len() {
            if set.count_ones() as usize != free + 1 {
                continue;
            }
            let chosen: Vec<&Vec<f64>> = (0..rows.len())
                .filter(|i| set >> i & 1 == 1)
                .map(|i| &rows[i])
                .collect();
            let Some(point) = corner(&chosen) else {
                continue;
            };
            let value = |row: &Vec<f64>| {
                let terms = row.iter().zip(&point).map(|(a, x)| a * x);
                terms.sum::<f64>() + row[free + 1]
            };
            if rows.iter().all(|row| value(row) > -1e-9) {
                best = best.max(point[free]);
            }
        }
        let (margin, ..) = shared(&sharers, &by, free);
        // A margin without bound has no corner above all others.
        if margin.is_finite() {
            assert!(
                (margin - best).abs() < 1e-8,
                "case {case}: {margin}, {best}"
            );
        }
    }
}

/// Where rows of coefficients and a constant are 0.
fn corner(rows: &[&Vec<f64>]) -> Option<Vec<f64>> {
    let n = rows.len();
    let mut a: Vec<Vec<f64>> = rows.iter().map(|row| (*row).clone()).collect();
    for i in 0..n {
        let pivot = (i..n).max_by(|p, q| a[*p][i].abs().total_cmp(&a[*q][i].abs()))?;
        a.swap(i, pivot);
        if a[i][i].abs() < 1e-6 {
            return None;
        }
        let own = a[i].clone();
        for (_, row) in a.iter_mut().enumerate().filter(|(j, _)| *j != i) {
            let factor = row[i] / own[i];
            row.iter_mut().zip(&own).for_each(|(x, y)| *x -= factor * y);
        }
    }
    Some((0..n).map(|i| -a[i][n] / a[i][i]).collect())
}

/// The same contacts with their friction along a direction that is turned against both tangents: what the linear programme says in the
/// plane, the cones say in space.
#[test]
fn cones_of_which_only_two_edges_count_are_the_linear_programme() {
    let mut seed = 0x2545_f491_4f6c_dd1d;
    for case in 0..300 {
        let free = 1 + case % 4;
        let count = free + 1 + case % 3;
        let mut by: Vec<f64> = (0..PARTS * free * count)
            .map(|_| drawn(&mut seed))
            .collect();
        let mut sharers = Vec::new();
        for own in by.chunks_exact_mut(PARTS * free) {
            own[..free].iter_mut().for_each(|x| *x *= 0.1);
            own[2 * free..].fill(0.0);
            let friction = 0.5 + 0.4 * drawn(&mut seed);
            sharers.push(sticks(friction, drawn(&mut seed), drawn(&mut seed)));
        }
        let (sin, cos) = (3.0 * drawn(&mut seed)).sin_cos();
        let mut turned = sharers.clone();
        let mut turned_by = by.clone();
        for (sharer, own) in turned
            .iter_mut()
            .zip(turned_by.chunks_exact_mut(PARTS * free))
        {
            let along = sharer.tangential[0];
            sharer.tangential = [cos * along, sin * along];
            let (along, across) = own[free..].split_at_mut(free);
            for (along, across) in along.iter_mut().zip(across) {
                (*along, *across) = (cos * *along, sin * *along);
            }
        }
        let (expected, _, limits) = shared(&sharers, &by, free);
        let (margin, _, turned_limits) = shared(&turned, &turned_by, free);
        if expected == f64::INFINITY {
            assert_eq!(margin, expected, "case {case}");
            continue;
        }
        // The distance from the dual margin at which the steps end, for forces of at most 3.
        assert!(
            (margin - expected).abs() < 1e-10,
            "case {case}: {margin}, {expected}"
        );
        for (limit, turned) in limits.iter().zip(&turned_limits) {
            let (Some(Limit::Friction([along, _])), Some(Limit::Friction(direction))) =
                (limit, turned)
            else {
                continue;
            };
            assert!((direction[0] - along * cos).abs() < 1e-6, "case {case}");
            assert!((direction[1] - along * sin).abs() < 1e-6, "case {case}");
        }
    }
}

/// The undetermined forces of contacts of a body: `N`, and `T` along both tangents, of each as a column of `w`, by which the body is loaded.
fn of_body(columns: &[[f64; 6]], load: [f64; 6]) -> (Vec<f64>, Vec<Vec<f64>>) {
    let n = columns.len();
    // Gauss–Jordan elimination of `Σ columns f = −load`.
    let mut rows: Vec<Vec<f64>> = (0..6)
        .map(|i| {
            let mut row: Vec<f64> = columns.iter().map(|column| column[i]).collect();
            row.push(-load[i]);
            row
        })
        .collect();
    let mut basic = Vec::new();
    for j in 0..n {
        let done = basic.len();
        let Some(pivot) = (done..6).max_by(|a, b| rows[*a][j].abs().total_cmp(&rows[*b][j].abs()))
        else {
            break;
        };
        if rows[pivot][j].abs() < 1e-9 {
            continue;
        }
        rows.swap(done, pivot);
        let by = rows[done][j];
        rows[done].iter_mut().for_each(|x| *x /= by);
        let own = rows[done].clone();
        for (_, row) in rows.iter_mut().enumerate().filter(|(i, _)| *i != done) {
            let factor = row[j];
            row.iter_mut().zip(&own).for_each(|(x, y)| *x -= factor * y);
        }
        basic.push(j);
    }
    let mut forces = vec![0.0; n];
    basic
        .iter()
        .zip(&rows)
        .for_each(|(j, row)| forces[*j] = row[n]);
    let free = (0..n).filter(|j| !basic.contains(j));
    let of_unit = free.map(|free| {
        let mut of_unit = vec![0.0; n];
        of_unit[free] = 1.0;
        basic
            .iter()
            .zip(&rows)
            .for_each(|(j, row)| of_unit[*j] = -row[free]);
        of_unit
    });
    (forces, of_unit.collect())
}

/// The shared margin of contacts of a body: points, normals, and tangents.
fn margin_of_body(
    contacts: &[([f64; 3], [[f64; 3]; 3])],
    frictions: &[f64],
    load: [f64; 6],
) -> (f64, Vec<Option<Limit>>) {
    let cross = |a: [f64; 3], b: [f64; 3]| {
        let part = |i: usize, j: usize| a[i] * b[j] - a[j] * b[i];
        [part(1, 2), part(2, 0), part(0, 1)]
    };
    let columns: Vec<[f64; 6]> = (contacts.iter())
        .flat_map(|(point, directions)| {
            directions.map(|d| {
                let turns = cross(*point, d);
                [d[0], d[1], d[2], turns[0], turns[1], turns[2]]
            })
        })
        .collect();
    let (forces, of_unit) = of_body(&columns, load);
    let free = of_unit.len();
    let mut by = Vec::new();
    for k in 0..columns.len() {
        by.extend(of_unit.iter().map(|of_unit| of_unit[k]));
    }
    let sharers: Vec<Sharer> = (forces.chunks_exact(3).zip(frictions))
        .map(|(own, friction)| Sharer {
            static_friction: Some(*friction),
            presses: true,
            normal: own[0],
            tangential: [own[1], own[2]],
        })
        .collect();
    let (margin, _, limits) = shared(&sharers, &by, free);
    (margin, limits)
}

const UPRIGHT: [[f64; 3]; 3] = [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];

/// A table with legs around its mass centre that is pushed at the ground: `Σ |Tᵢ| ≥ P` and `|Tᵢ| ≤ μ (Nᵢ − s)` give `n s = W − P/μ`.
#[test]
fn a_table_holds_up_to_its_friction_in_every_direction() {
    for legs in 4..9 {
        let leg = |i: usize| {
            let angle = 0.3 + 2.0 * core::f64::consts::PI * i as f64 / legs as f64;
            ([angle.cos(), angle.sin(), 0.0], UPRIGHT)
        };
        let contacts: Vec<_> = (0..legs).map(leg).collect();
        for direction in [0.0_f64, 0.4, 2.0, -1.1] {
            for push in [0.0, 1.0, 3.9, 4.1] {
                let (sin, cos) = direction.sin_cos();
                let load = [push * cos, push * sin, -10.0, 0.0, 0.0, 0.0];
                let (margin, limits) = margin_of_body(&contacts, &vec![0.4; legs], load);
                let expected = (10.0 - push / 0.4) / legs as f64;
                assert!((margin - expected).abs() < 1e-11, "{margin}, {expected}");
                for limit in limits.iter().filter(|_| push > 0.0) {
                    let Some(Limit::Friction(friction)) = limit else {
                        panic!("{limits:?}");
                    };
                    // A direction with an error ε changes what limits by ε².
                    assert!((friction[0] + cos).abs() < 1e-5, "{limits:?}");
                    assert!((friction[1] + sin).abs() < 1e-5, "{limits:?}");
                }
            }
        }
    }
}

/// A body in a V groove with sides at an angle β, along which it is pulled. Friction down the sides wedges it in, `N = N₀ + T tan β` with
/// `2 N₀ cos β = W`, and `(P/2)² + T² ≤ μ² N²` has a solution T as long as `P ≤ 2 μ N₀/√(1 − μ² tan² β)`.
#[test]
fn a_body_in_a_groove_is_wedged_in() {
    for beta in [0.2_f64, 0.7, 1.0] {
        let (sin, cos) = beta.sin_cos();
        // One contact on each side in front and behind.
        let contact = |side: f64, x: f64| {
            let normal = [0.0, -side * sin, cos];
            let along = [1.0, 0.0, 0.0];
            let up = [0.0, side * cos, sin];
            ([x, side, 0.0], [normal, along, up])
        };
        let contacts = [(1.0, 0.5), (-1.0, 0.5), (1.0, -0.5), (-1.0, -0.5)];
        let contacts = contacts.map(|(side, x)| contact(side, x));
        for friction in [0.1, 0.36, 0.6] {
            let normal = 10.0 / (2.0 * cos);
            let wedged = friction * beta.tan();
            let most = 2.0 * friction * normal / (1.0 - wedged * wedged).sqrt();
            for (share, holds) in [(1.0 - 1e-9, true), (1.0 + 1e-9, false)] {
                let load = [share * most, 0.0, -10.0, 0.0, 0.0, 0.0];
                let (margin, _) = margin_of_body(&contacts, &[friction; 4], load);
                assert_eq!(margin > 0.0, holds, "β = {beta}, μ = {friction}: {margin}");
            }
        }
    }
}

/// A body between two walls that press on each other as hard as they like is held by any friction.
#[test]
fn what_presses_itself_harder_holds() {
    let sharers = [sticks(0.1, 0.0, 3.0), sticks(0.1, 0.0, 0.0)];
    let by = [1.0, 0.0, 0.0, -1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0, 0.0];
    assert_eq!(shared(&sharers, &by, 2).0, f64::INFINITY);
}

/// Two contacts without friction share what one of them would have to hold: they hold nothing, but what a third one with friction leaves them.
#[test]
fn contacts_without_friction_hold_nothing() {
    let mut sharers = vec![sticks(0.0, 5.0, 3.0), sticks(0.0, 4.0, 0.0)];
    let by = [0.0, 1.0, 0.0, 0.0, -1.0, 0.0];
    let (margin, _, limits) = shared(&sharers, &by, 1);
    assert!(margin < 0.0, "{margin}");
    assert!(limits.contains(&Some(Limit::Friction([1.0, 0.0]))));
    sharers[0].tangential[0] = 1e-12;
    assert_eq!(shared(&sharers, &by, 1).0, f64::INFINITY);
    sharers[0].tangential[0] = 3.0;
    sharers.push(sticks(0.5, 8.0, 0.0));
    let by = [
        [0.0, 0.0, 1.0, 0.0, 0.0, 0.0],
        [0.0, 0.0, -1.0, 1.0, 0.0, 0.0],
        [0.0, 0.0, 0.0, -1.0, 0.0, 0.0],
    ];
    // 3 N of at most 0.5 (8 N − s).
    assert_eq!(shared(&sharers, by.as_flattened(), 2).0, 2.0);
}

#[test]
fn contacts_that_share_nothing_are_in_groups_of_their_own() {
    let mut groups = [9; 3];
    // The first and the third force meet in the second contact.
    let by = [
        1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, //
        0.0, 0.0, 2.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, //
        0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0,
    ];
    group(&by, &mut groups);
    assert_eq!(groups, [0, 1, 0]);
}
