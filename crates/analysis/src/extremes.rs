//! Maxima and minima of a curve.

use crate::curve::{Curve, Interpolation, hermite};

/// A maximum or a minimum.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extreme {
    /// The time, in s.
    pub t: f64,
    /// The value there, in the unit of the curve.
    pub value: f64,
    /// Whether it is a maximum.
    pub is_maximum: bool,
}

/// All maxima and minima within a curve, in order of time. With rates, they are the turning points of the cubics between rows;
/// without, the vertices of parabolas through a row and its neighbours.
///
/// Ripples are left out: on both sides of a maximum the curve must fall by more than `least` before it reaches a greater value, a
/// gap or its end; minima accordingly.
pub fn extremes(curve: &Curve<'_>, rates: Option<&[f64]>, least: f64) -> Vec<Extreme> {
    let rates = rates.filter(|_| curve.interpolation() == Interpolation::Hermite);
    let (times, values) = (curve.times(), curve.values());
    let is_known =
        |row: usize| values[row].is_finite() && rates.is_none_or(|rates| rates[row].is_finite());
    let mut extremes = Vec::new();
    let mut row = 0;
    while row < values.len() {
        let first = row;
        while row < values.len() && is_known(row) {
            row += 1;
        }
        if first < row {
            let rows = first..row;
            let (times, values) = (&times[rows.clone()], &values[rows.clone()]);
            let turns = match rates {
                Some(rates) => by_rates(times, values, &rates[rows]),
                None => by_values(times, values),
            };
            without_ripples(
                &turns,
                [values[0], values[values.len() - 1]],
                least,
                &mut extremes,
            );
        }
        row += 1;
    }
    extremes
}

/// The extremes of the cubics between rows at which rates change sign.
fn by_rates(times: &[f64], values: &[f64], rates: &[f64]) -> Vec<Extreme> {
    let mut extremes = Vec::new();
    // The last row at which the rate was not 0.
    let mut before: Option<(usize, f64)> = None;
    for (row, rate) in rates.iter().enumerate() {
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
                // The rates of rows in between are 0.
                _ => (times[last + 1], values[last + 1]),
            };
            extremes.push(Extreme {
                t,
                value,
                is_maximum: sign > 0.0,
            });
        }
        before = Some((row, rate.signum()));
    }
    extremes
}

/// The turning point of a cubic whose slopes at 0 and 1 have opposite signs: the only root of its derivative in between.
fn turning([x0, x1]: [f64; 2], [d0, d1]: [f64; 2]) -> f64 {
    let slope = |s: f64| {
        let r = 1.0 - s;
        6.0 * s * r * (x1 - x0) + d0 * r * (1.0 - 3.0 * s) + d1 * s * (3.0 * s - 2.0)
    };
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if (slope(middle) > 0.0) == (d0 > 0.0) {
            low = middle
        } else {
            high = middle
        }
    }
    0.5 * (low + high)
}

/// Rows greater or less than their neighbours, moved to the vertex of the parabola through the three.
fn by_values(times: &[f64], values: &[f64]) -> Vec<Extreme> {
    let mut extremes = Vec::new();
    let mut row = 1;
    while row + 1 < values.len() {
        // Equal neighbouring rows are one extreme.
        let mut end = row;
        while end + 1 < values.len() && values[end + 1] == values[row] {
            end += 1;
        }
        let (Some(behind), before) = (values.get(end + 1), values[row - 1]) else {
            break;
        };
        let (up, down) = (values[row] - before, values[row] - behind);
        if up * down > 0.0 {
            let (t, value) = if end == row {
                parabola([row - 1, row, row + 1].map(|k| (times[k], values[k])))
            } else {
                (0.5 * (times[row] + times[end]), values[row])
            };
            extremes.push(Extreme {
                t,
                value,
                is_maximum: up > 0.0,
            });
        }
        row = end + 1;
    }
    extremes
}

/// The vertex of the parabola through three points.
fn parabola([(t0, x0), (t1, x1), (t2, x2)]: [(f64, f64); 3]) -> (f64, f64) {
    let (a, b) = ((x1 - x0) / (t1 - t0), (x2 - x1) / (t2 - t1));
    let bend = (b - a) / (t2 - t0);
    // The slope at the middle row.
    let slope = a + bend * (t1 - t0);
    let step = -0.5 * slope / bend;
    (t1 + step, x1 + 0.5 * slope * step)
}

/// Selects the turning points of a curve that are not ripples.
///
/// The curve is followed from its start. When it has fallen by more than `least` from the greatest value since the last minimum,
/// that value is a maximum; minima accordingly. The first one found is left out, because before it the curve has not moved by
/// more than `least`.
fn without_ripples(
    turns: &[Extreme],
    [start, end]: [f64; 2],
    least: f64,
    found: &mut Vec<Extreme>,
) {
    // The greatest and the least value since the last extreme, with their turning points unless they are at an end.
    let (mut greatest, mut smallest) = ((start, None), (start, None));
    // Whether the curve rises, once known: the next extreme is then a maximum.
    let mut rises: Option<bool> = None;
    let turns = turns.iter().map(|turn| (turn.value, Some(*turn)));
    for point in turns.chain([(end, None)]) {
        if point.0 > greatest.0 {
            greatest = point;
        }
        if point.0 < smallest.0 {
            smallest = point;
        }
        let (turned, goes_up) = match rises {
            Some(true) | None if greatest.0 - point.0 > least => (greatest.1, false),
            Some(false) | None if point.0 - smallest.0 > least => (smallest.1, true),
            _ => continue,
        };
        if rises.is_some() {
            found.extend(turned);
        }
        rises = Some(goes_up);
        (greatest, smallest) = (point, point);
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
        let curve = Curve::new(&times, &values, rates, Interpolation::Hermite);
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
        // The error of the cubic is h⁴/384, and that of its slope h³√3/216, which shifts the maximum by as much,
        // divided by the curvature 1.
        check(h, true, [h.powi(3) / 100.0, h.powi(4) / 384.0]);
        // The error of the parabola is h³√3/27 · x‴ with x‴ at most h near a maximum; that of its slope is h²/3 · x‴.
        check(h, false, [h.powi(3) / 2.0, h.powi(4) / 10.0]);
    }

    #[test]
    fn ripples_are_left_out() {
        let times: Vec<f64> = (0..400).map(|k| f64::from(k) * 0.05).collect();
        let values: Vec<f64> = times
            .iter()
            .map(|t| t.sin() + 1e-3 * (40.0 * t).sin())
            .collect();
        let curve = Curve::new(&times, &values, None, Interpolation::Cubic);
        assert_eq!(extremes(&curve, None, 0.05).len(), 6);
        let flat = [0.0, 1.0, 1.0, 0.0, 0.5];
        let curve = Curve::new(&times[..5], &flat, None, Interpolation::Cubic);
        let found = extremes(&curve, None, 0.0);
        assert_eq!(found.len(), 2);
        // Up to its end the curve rises by only 0.53.
        assert_eq!(extremes(&curve, None, 0.6), found[..1]);
        assert!((found[0].t - 0.075).abs() < 1e-15 && found[0].value == 1.0);
    }

    /// Turning points with these values, alternately maxima and minima.
    fn turns(values: &[f64]) -> Vec<Extreme> {
        let pairs = values.windows(3).enumerate();
        let pairs = pairs.filter(|(_, x)| (x[1] - x[0]) * (x[1] - x[2]) > 0.0);
        let turns = pairs.map(|(k, x)| Extreme {
            t: (k + 1) as f64,
            value: x[1],
            is_maximum: x[1] > x[0],
        });
        turns.collect()
    }

    #[test]
    fn noise_on_a_monotone_curve_is_no_extreme() {
        let times: Vec<f64> = (0..200).map(|k| f64::from(k) * 0.05).collect();
        for phase in 0..60 {
            // The ends lie anywhere on the ripple, so that the number of turning points is even or odd.
            let ripple = |t: f64| 1e-3 * (40.0 * t + 0.1 * f64::from(phase)).sin();
            let values: Vec<f64> = times.iter().map(|t| (-t).exp() + ripple(*t)).collect();
            let slopes = |t: &f64| -(-t).exp() + 0.04 * (40.0 * t + 0.1 * f64::from(phase)).cos();
            let rates: Vec<f64> = times.iter().map(slopes).collect();
            for rates in [None, Some(rates.as_slice())] {
                let curve = Curve::new(&times, &values, rates, Interpolation::Hermite);
                assert!(extremes(&curve, rates, 0.0).len() > 20);
                assert_eq!(extremes(&curve, rates, 3e-3), []);
            }
        }
    }

    /// A direct implementation of the definition: both sides of each turning point, until the curve passes
    /// its value or ends.
    #[test]
    fn extremes_are_those_with_slopes_to_both_sides() {
        let mut state = 1_u64;
        let mut random = || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            (state >> 33) as f64 / f64::from(1_u32 << 31)
        };
        for _ in 0..2000 {
            let count = 2 + (random() * 12.0) as usize;
            let values: Vec<f64> = (0..count).map(|_| random()).collect();
            let least = 0.8 * random();
            let slope = |beside: &mut dyn Iterator<Item = &f64>, top: f64, sign: f64| {
                let side = beside.map(|x| sign * (top - x));
                side.take_while(|below| *below >= 0.0).fold(0.0, f64::max)
            };
            let is_one = |turn: &Extreme| {
                let (k, sign) = (turn.t as usize, if turn.is_maximum { 1.0 } else { -1.0 });
                let before = slope(&mut values[..k].iter().rev(), turn.value, sign);
                before.min(slope(&mut values[k + 1..].iter(), turn.value, sign)) > least
            };
            let turns = turns(&values);
            let expected: Vec<Extreme> = turns.iter().copied().filter(is_one).collect();
            let mut found = Vec::new();
            without_ripples(&turns, [values[0], values[count - 1]], least, &mut found);
            assert_eq!(found, expected, "{values:?} {least}");
        }
    }

    #[test]
    fn a_gap_is_an_end() {
        let times: Vec<f64> = (0..9).map(f64::from).collect();
        let values = [0.0, 2.0, 1.5, f64::NAN, 0.0, 3.0, 0.0, 0.2, 0.1];
        let curve = Curve::new(&times, &values, None, Interpolation::Cubic);
        let found = extremes(&curve, None, 1.0);
        assert!(
            found.len() == 1 && (found[0].t - 5.0).abs() < 0.5,
            "{found:?}"
        );
    }
}
