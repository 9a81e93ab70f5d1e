//! Initial paths of a search.

use super::Terrain;
use super::descent::Polygon;
use super::{between, symmetric};
use crate::linear::dot;
use crate::trial::Start;

/// The initial number of pieces.
pub const PIECES: usize = 16;

/// How far paths deviate in the middle, relative to the length of the straight one: for two coordinates, and for more.
const ASIDE: [&[f64]; 2] = [&[0.35, 1.0], &[0.5]];

/// The straight path, and paths that deviate to either side of it, orthogonally in the metric of its middle.
pub fn initial_paths(terrain: &impl Terrain, from: &[f64], to: &[f64]) -> Vec<(Start, Polygon)> {
    let n = from.len();
    let metric = symmetric(terrain.inertia(&between(from, to, 0.5)), n);
    let product =
        |x: &[f64], y: &[f64]| -> f64 { (0..n * n).map(|k| metric[k] * x[k / n] * y[k % n]).sum() };
    let straight: Vec<f64> = to.iter().zip(from).map(|(to, from)| to - from).collect();
    let length = product(&straight, &straight).max(0.0).sqrt();
    let mut paths = std::vec![(Start::Straight, bowed(from, to, &std::vec![0.0; n]))];
    // Gram–Schmidt orthogonalization; the unit vector nearest to the straight path is left out.
    let mut across: Vec<Vec<f64>> = std::vec![straight.iter().map(|x| x / length).collect()];
    let share = |i: &usize| product(&across[0], &unit(n, *i)).abs() / metric[i * n + i].sqrt();
    let nearest = (0..n).max_by(|a, b| share(a).total_cmp(&share(b)));
    for i in (0..n).filter(|i| Some(*i) != nearest) {
        let mut next = unit(n, i);
        for known in &across {
            let part = product(known, &next);
            next.iter_mut().zip(known).for_each(|(x, k)| *x -= part * k);
        }
        let size = product(&next, &next).max(0.0).sqrt();
        if size > 0.0 {
            across.push(next.iter().map(|x| x / size).collect());
        }
    }
    for part in ASIDE[usize::from(n > 2)] {
        for direction in &across[1..] {
            for side in [1.0, -1.0] {
                let by: Vec<f64> = direction.iter().map(|x| side * part * length * x).collect();
                let polygon = bowed(from, to, &by);
                paths.push((Start::Bowed { by }, polygon));
            }
        }
    }
    paths
}

fn unit(n: usize, i: usize) -> Vec<f64> {
    (0..n).map(|k| if k == i { 1.0 } else { 0.0 }).collect()
}

/// The path is at the fraction `τ²` at the fraction τ of the time, as from rest under a constant force, and
/// deviates by a half sine.
fn bowed(from: &[f64], to: &[f64], by: &[f64]) -> Polygon {
    let place = |k: usize| {
        let part = (k as f64 / PIECES as f64).powi(2);
        let mut place = between(from, to, part);
        if k < PIECES {
            let aside = (core::f64::consts::PI * part).sin();
            place.iter_mut().zip(by).for_each(|(x, d)| *x += aside * d);
        } else {
            place.copy_from_slice(to);
        }
        place
    };
    Polygon {
        places: (0..=PIECES).map(place).collect(),
    }
}

/// A path through given places with its ends moved to these; the displacement of places in between is
/// interpolated by length.
pub fn guessed(terrain: &impl Terrain, places: &[Vec<f64>], from: &[f64], to: &[f64]) -> Polygon {
    let n = from.len();
    let metric = symmetric(terrain.inertia(&between(from, to, 0.5)), n);
    let mut lengths = std::vec![0.0];
    let mut sum = 0.0;
    for pair in places.windows(2) {
        let along: Vec<f64> = pair[0].iter().zip(&pair[1]).map(|(a, b)| b - a).collect();
        let mass: Vec<f64> = metric.chunks(n).map(|row| dot(row, &along)).collect();
        sum += dot(&along, &mass).max(0.0).sqrt();
        lengths.push(sum);
    }
    let [first, last] = [&places[0], &places[places.len() - 1]];
    let place = |k: usize| {
        let part = (k as f64 / PIECES as f64).powi(2);
        let length = part * sum;
        let after = lengths
            .partition_point(|l| *l < length)
            .clamp(1, places.len() - 1);
        let piece = lengths[after] - lengths[after - 1];
        let inner = if piece > 0.0 {
            (length - lengths[after - 1]) / piece
        } else {
            0.0
        };
        let there = between(&places[after - 1], &places[after], inner);
        (0..n)
            .map(|i| there[i] + (1.0 - part) * (from[i] - first[i]) + part * (to[i] - last[i]))
            .collect()
    };
    let mut places: Vec<Vec<f64>> = (0..=PIECES).map(place).collect();
    // The ends must be exact.
    places[0] = from.to_vec();
    places[PIECES] = to.to_vec();
    Polygon { places }
}
