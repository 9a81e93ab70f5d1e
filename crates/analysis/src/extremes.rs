//! Maxima and minima of a curve.

use crate::curve::{Between, Curve, hermite};

/// A maximum or a minimum.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extreme {
    /// When, in s.
    pub t: f64,
    /// The value there.
    pub value: f64,
    /// Whether it is a maximum.
    pub is_maximum: bool,
}

/// All maxima and minima within a curve, in order of time: where the cubic between rows that has their rates turns, or the parabola
/// through a row and its neighbours where there are no rates. Extremes that differ from the one before by no more than
/// `least` are ripples, and are left out together with it.
pub fn extremes(curve: &Curve<'_>, rates: Option<&[f64]>, least: f64) -> Vec<Extreme> {
    let found = match (curve.between(), rates) {
        (Between::Hermite, Some(rates)) => by_rates(curve, rates),
        _ => by_values(curve),
    };
    without_ripples(found, least)
}

/// Where rates change sign between two rows, the extreme of the cubic that has them.
fn by_rates(curve: &Curve<'_>, rates: &[f64]) -> Vec<Extreme> {
    let (times, values) = (curve.times(), curve.values());
    let mut found = Vec::new();
    // The last row at which the curve was not at rest.
    let mut before: Option<(usize, f64)> = None;
    for (row, rate) in rates.iter().enumerate() {
        if !rate.is_finite() || !values[row].is_finite() {
            before = None;
            continue;
        }
        if *rate == 0.0 {
            continue;
        }
        if let Some((last, sign)) = before.filter(|(_, sign)| *sign != rate.signum()) {
            let (t, value) = match row - last {
                1 => {
                    let h = times[row] - times[last];
                    let x = [values[last], values[row]];
                    let d = [h * rates[last], h * rates[row]];
                    let s = turning(x, d);
                    (times[last] + s * h, hermite(s, x, d))
                }
                // At rest at rows in between.
                _ => (times[last + 1], values[last + 1]),
            };
            found.push(Extreme {
                t,
                value,
                is_maximum: sign > 0.0,
            });
        }
        before = Some((row, rate.signum()));
    }
    found
}

/// Where the cubic turns whose slopes at 0 and 1 have opposite signs: the only root of its derivative in between.
fn turning([x0, x1]: [f64; 2], [d0, d1]: [f64; 2]) -> f64 {
    let slope = |s: f64| {
        let r = 1.0 - s;
        6.0 * s * r * (x1 - x0) + d0 * r * (1.0 - 3.0 * s) + d1 * s * (3.0 * s - 2.0)
    };
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        match (slope(middle) > 0.0) == (d0 > 0.0) {
            true => low = middle,
            false => high = middle,
        }
    }
    0.5 * (low + high)
}

/// Rows that are greater or less than their neighbours, moved to the top of the parabola through the three.
fn by_values(curve: &Curve<'_>) -> Vec<Extreme> {
    let (times, values) = (curve.times(), curve.values());
    let mut found = Vec::new();
    let mut row = 1;
    while row + 1 < values.len() {
        // A flat top is one extreme.
        let mut end = row;
        while end + 1 < values.len() && values[end + 1] == values[row] {
            end += 1;
        }
        let (Some(behind), before) = (values.get(end + 1), values[row - 1]) else {
            break;
        };
        let (up, down) = (values[row] - before, values[row] - behind);
        if up * down > 0.0 {
            let (t, value) = match end == row {
                true => parabola([row - 1, row, row + 1].map(|k| (times[k], values[k]))),
                false => (0.5 * (times[row] + times[end]), values[row]),
            };
            found.push(Extreme {
                t,
                value,
                is_maximum: up > 0.0,
            });
        }
        row = end + 1;
    }
    found
}

/// Where the parabola through three points turns.
fn parabola([(t0, x0), (t1, x1), (t2, x2)]: [(f64, f64); 3]) -> (f64, f64) {
    let (a, b) = ((x1 - x0) / (t1 - t0), (x2 - x1) / (t2 - t1));
    let bend = (b - a) / (t2 - t0);
    // The slope at the row in the middle.
    let slope = a + bend * (t1 - t0);
    let step = -0.5 * slope / bend;
    (t1 + step, x1 + 0.5 * slope * step)
}

/// Without pairs of neighbours that differ by no more than `least`.
fn without_ripples(mut found: Vec<Extreme>, least: f64) -> Vec<Extreme> {
    loop {
        let gaps = found.windows(2).enumerate();
        let gaps = gaps.map(|(k, pair)| (k, (pair[1].value - pair[0].value).abs()));
        let smallest = gaps.min_by(|a, b| a.1.total_cmp(&b.1));
        match smallest {
            Some((k, gap)) if gap <= least => {
                found.drain(k..k + 2);
            }
            _ => return found,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{FRAC_PI_2, PI};

    fn check(step: f64, with_rates: bool, bounds: [f64; 2]) {
        let times: Vec<f64> = (0..(20.0 / step) as usize)
            .map(|k| k as f64 * step)
            .collect();
        let values: Vec<f64> = times.iter().map(|t| t.sin()).collect();
        let rates: Vec<f64> = times.iter().map(|t| t.cos()).collect();
        let rates = with_rates.then_some(rates.as_slice());
        let curve = Curve::new(&times, &values, rates, Between::Hermite);
        let found = extremes(&curve, rates, 0.0);
        assert_eq!(found.len(), 6);
        for (k, extreme) in found.iter().enumerate() {
            assert!((extreme.t - FRAC_PI_2 - k as f64 * PI).abs() < bounds[0]);
            assert!((extreme.value.abs() - 1.0).abs() < bounds[1]);
            assert_eq!(extreme.is_maximum, k % 2 == 0);
        }
    }

    #[test]
    fn a_sine_turns_where_its_rate_is_zero() {
        let h: f64 = 0.05;
        // Of the cubic the error is h⁴/384, its slope's h³√3/216, which moves the top by as much over the curvature 1.
        check(h, true, [h.powi(3) / 100.0, h.powi(4) / 384.0]);
        // Of the parabola h³√3/27 · x‴ with x‴ at most h near a top; its slope's error h²/3 · x‴.
        check(h, false, [h.powi(3) / 2.0, h.powi(4) / 10.0]);
    }

    #[test]
    fn ripples_are_left_out() {
        let times: Vec<f64> = (0..400).map(|k| f64::from(k) * 0.05).collect();
        let values: Vec<f64> = times
            .iter()
            .map(|t| t.sin() + 1e-3 * (40.0 * t).sin())
            .collect();
        let curve = Curve::new(&times, &values, None, Between::Cubic);
        assert_eq!(extremes(&curve, None, 0.05).len(), 6);
        let flat = [0.0, 1.0, 1.0, 0.0, 0.5];
        let curve = Curve::new(&times[..5], &flat, None, Between::Cubic);
        let found = extremes(&curve, None, 0.0);
        assert_eq!(found.len(), 2);
        assert!((found[0].t - 0.075).abs() < 1e-15 && found[0].value == 1.0);
    }
}
