//! The difference of two curves.

use crate::curve::Curve;

/// The difference of the second of two curves from the first, in their common unit.
#[derive(Clone, Debug, PartialEq)]
pub struct Difference {
    /// The largest absolute difference.
    pub largest: f64,
    /// The time of the largest difference, in s.
    pub at: f64,
    /// The root of the mean square over time, `√(∫ d² dt / ∫ dt)` by the trapezoidal rule.
    pub rms: f64,
    /// The scale of relative differences: the maximum minus the minimum of the first curve. A curve whose range is at most 1e-9 of
    /// its largest value counts as constant; its scale is this value.
    pub range: f64,
    /// Whether `range` is the value of a constant curve.
    pub is_constant: bool,
    /// The second minus the first at each instant; NaN where a curve has no value.
    pub values: Vec<f64>,
    /// The number of instants at which both have a value.
    pub count: usize,
}

/// A curve whose range is at most this fraction of its size is constant but for the round-off of a run.
const CONSTANT: f64 = 1e-9;

impl Difference {
    /// The largest difference relative to the range; `None` where both are 0.
    pub fn relative(&self) -> Option<f64> {
        match (self.largest, self.range) {
            (0.0, _) => Some(0.0),
            (_, 0.0) => None,
            (largest, range) => Some(largest / range),
        }
    }
}

/// The difference of two curves at increasing instants; `None` where they have no values at a common instant.
pub fn difference(times: &[f64], one: &Curve<'_>, other: &Curve<'_>) -> Option<Difference> {
    let (mut least, mut greatest) = (f64::INFINITY, f64::NEG_INFINITY);
    let mut values = Vec::with_capacity(times.len());
    let (mut largest, mut at, mut count) = (0.0, f64::NAN, 0);
    let (mut area, mut length) = (0.0, 0.0);
    let mut squares = 0.0;
    let mut before: Option<(f64, f64)> = None;
    for &t in times {
        let x = nearest(one, t);
        let d = nearest(other, t) - x;
        values.push(d);
        if d.is_nan() {
            before = None;
            continue;
        }
        (least, greatest) = (least.min(x), greatest.max(x));
        if d.abs() > largest || count == 0 {
            (largest, at) = (d.abs(), t);
        }
        count += 1;
        squares += d * d;
        if let Some((t0, d0)) = before {
            area += 0.5 * (t - t0) * (d0 * d0 + d * d);
            length += t - t0;
        }
        before = Some((t, d));
    }
    if count == 0 {
        return None;
    }
    let size = least.abs().max(greatest.abs());
    let is_constant = greatest - least <= CONSTANT * size;
    let mean = if length > 0.0 {
        area / length
    } else {
        squares / count as f64
    };
    Some(Difference {
        largest,
        at,
        rms: mean.sqrt(),
        range: if is_constant { size } else { greatest - least },
        is_constant,
        values,
        count,
    })
}

/// The value at an instant, or at a row that differs from it only by round-off.
fn nearest(curve: &Curve<'_>, t: f64) -> f64 {
    let times = curve.times();
    let place = times.partition_point(|row| *row < t);
    let spacing = match times {
        [first, .., last] => (last - first) / (times.len() - 1) as f64,
        _ => 0.0,
    };
    let near = [place.checked_sub(1), Some(place)];
    let near = near.into_iter().flatten().find(|k| {
        let row = times.get(*k);
        row.is_some_and(|row| (row - t).abs() <= 1e-9 * spacing)
    });
    match near {
        Some(row) => curve.values()[row],
        None => curve.at(t),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::curve::{Interpolation, common_times};

    #[test]
    fn two_sines_are_apart_as_the_formula_says() {
        // sin t and sin t + 0.01 sin 2t, sampled at different instants: the largest difference is 0.01 at π/4, and the root mean
        // square over whole periods is 0.01/√2.
        let rows = |count: usize| -> Vec<f64> {
            let step = std::f64::consts::TAU / count as f64;
            (0..=count).map(|k| k as f64 * step).collect()
        };
        let (t1, t2) = (rows(1000), rows(777));
        let x1: Vec<f64> = t1.iter().map(|t| t.sin()).collect();
        let v1: Vec<f64> = t1.iter().map(|t| t.cos()).collect();
        let x2: Vec<f64> = t2
            .iter()
            .map(|t| t.sin() + 0.01 * (2.0 * t).sin())
            .collect();
        let one = Curve::new(&t1, &x1, Some(&v1), Interpolation::Hermite);
        let other = Curve::new(&t2, &x2, None, Interpolation::Hermite);
        let times = common_times(&t1, &t2);
        let found = difference(&times, &one, &other).unwrap();
        // Instants are at most 2π/1777 apart, so the maximum is missed by 0.01 (2·step/2)²/2; the interpolation
        // error is below 1e-10.
        let step = std::f64::consts::TAU / 777.0;
        assert!((found.largest - 0.01).abs() < 0.01 * step * step / 2.0 + 1e-10);
        assert!(
            (found.at - std::f64::consts::FRAC_PI_4).abs() % std::f64::consts::FRAC_PI_2 < step
        );
        assert!((found.rms - 0.01 / 2.0_f64.sqrt()).abs() < 1e-6 * 0.01);
        assert!((found.range - 2.0).abs() < 1e-5);
        assert!(!found.is_constant);
        assert!(one.interpolation_error() < 1e-10 && other.interpolation_error() < 1e-9);
    }

    #[test]
    fn a_constant_is_measured_by_its_value() {
        let times = [0.0, 1.0, 2.0];
        let one = Curve::new(
            &times,
            &[10.0, 10.0 + 1e-12, 10.0],
            None,
            Interpolation::Linear,
        );
        let other = Curve::new(&times, &[10.0, 10.0, 10.1], None, Interpolation::Linear);
        let found = difference(&times, &one, &other).unwrap();
        assert!(found.is_constant);
        assert!((found.relative().unwrap() - 0.01).abs() < 1e-12);
        let nothing = Curve::new(&times, &[0.0; 3], None, Interpolation::Linear);
        assert_eq!(
            difference(&times, &nothing, &nothing).unwrap().relative(),
            Some(0.0)
        );
        assert_eq!(difference(&times, &nothing, &one).unwrap().relative(), None);
        let gap = Curve::new(&times, &[f64::NAN; 3], None, Interpolation::Linear);
        assert_eq!(difference(&times, &one, &gap), None);
    }
}
