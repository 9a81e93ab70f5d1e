//! Interpolation between the rows of a table.

/// How values between rows are interpolated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Interpolation {
    /// The Hermite cubic through the values and rates of both rows: its error is h⁴/384 times the fourth derivative.
    Hermite,
    /// The cubic through the two rows before and the two after, at either end through the outermost four rows; used where there are
    /// no rates. Its error is 3h⁴/128 times the fourth derivative, in the first and last interval h⁴/24 times.
    Cubic,
    /// Linear interpolation.
    Linear,
}

impl Interpolation {
    /// The name in words.
    pub fn name(self) -> &'static str {
        match self {
            Interpolation::Hermite => "cubic with rates",
            Interpolation::Cubic => "cubic",
            Interpolation::Linear => "linear",
        }
    }

    /// The factor by which the interpolation error of a smooth curve shrinks where rows are twice as dense.
    fn gain(self) -> f64 {
        match self {
            Interpolation::Hermite | Interpolation::Cubic => 16.0,
            Interpolation::Linear => 4.0,
        }
    }
}

/// A column of a table as a function of time.
#[derive(Clone, Debug)]
pub struct Curve<'a> {
    times: &'a [f64],
    values: &'a [f64],
    rates: Option<&'a [f64]>,
    between: Interpolation,
}

impl<'a> Curve<'a> {
    /// A column, with the column of its rates if there is one. All must be equally long.
    ///
    /// [`Interpolation::Hermite`] without rates becomes [`Interpolation::Cubic`].
    pub fn new(
        times: &'a [f64],
        values: &'a [f64],
        rates: Option<&'a [f64]>,
        between: Interpolation,
    ) -> Curve<'a> {
        let between = match (between, rates) {
            (Interpolation::Hermite, None) => Interpolation::Cubic,
            (between, _) => between,
        };
        Curve {
            times,
            values,
            rates,
            between,
        }
    }

    /// How values between rows are interpolated.
    pub fn interpolation(&self) -> Interpolation {
        self.between
    }

    /// The times of the rows, in s.
    pub fn times(&self) -> &'a [f64] {
        self.times
    }

    /// The values of the rows, in the unit of the curve.
    pub fn values(&self) -> &'a [f64] {
        self.values
    }

    /// The value at a time in s, in the unit of the curve; NaN outside the table, and next to a row without a value.
    pub fn at(&self, t: f64) -> f64 {
        let after = self.times.partition_point(|row| *row < t);
        match self.times.get(after) {
            Some(row) if *row == t => self.values[after],
            Some(_) if after > 0 => self.within(after - 1, after, t, 1),
            _ => f64::NAN,
        }
    }

    /// The value between two rows that are `stride` rows apart; further rows that are needed have the same spacing.
    fn within(&self, left: usize, right: usize, t: f64, stride: usize) -> f64 {
        let (t0, t1) = (self.times[left], self.times[right]);
        let (x0, x1) = (self.values[left], self.values[right]);
        let h = t1 - t0;
        let s = (t - t0) / h;
        match (self.between, self.rates) {
            (Interpolation::Hermite, Some(rates)) => {
                hermite(s, [x0, x1], [h * rates[left], h * rates[right]])
            }
            (Interpolation::Linear, _) => x0 + s * (x1 - x0),
            _ => {
                // The four rows around the interval, or the outermost four.
                let before = left.checked_sub(stride);
                let behind = Some(right + stride).filter(|row| *row < self.times.len());
                let rows = match (before, behind) {
                    (Some(before), Some(behind)) => vec![before, left, right, behind],
                    (None, Some(behind)) => {
                        let further = Some(behind + stride).filter(|row| *row < self.times.len());
                        [left, right, behind].into_iter().chain(further).collect()
                    }
                    (Some(before), None) => {
                        let further = before.checked_sub(stride);
                        further.into_iter().chain([before, left, right]).collect()
                    }
                    (None, None) => vec![left, right],
                };
                lagrange(self.times, self.values, &rows, t)
            }
        }
    }

    /// An estimate of the interpolation error: the largest difference between a row and its interpolation from its neighbours,
    /// divided by the factor that a smooth curve gains where rows are twice as dense. 0 with fewer than three rows.
    pub fn interpolation_error(&self) -> f64 {
        let inner = 1..self.times.len().saturating_sub(1);
        let off = inner.map(|row| {
            let interpolated = match self.between {
                // From rows at odd distances, which are two rows apart.
                Interpolation::Cubic => self.without(row),
                _ => self.within(row - 1, row + 1, self.times[row], 2),
            };
            (interpolated - self.values[row]).abs() / self.between.gain()
        });
        off.fold(0.0, f64::max)
    }

    /// The greatest difference between two values.
    pub fn range(&self) -> f64 {
        let finite = || {
            self.values
                .iter()
                .copied()
                .filter(|value| value.is_finite())
        };
        let greatest = finite().fold(f64::NEG_INFINITY, f64::max);
        (greatest - finite().fold(f64::INFINITY, f64::min)).max(0.0)
    }

    /// Whether the curve oscillates more than once in two rows, so that it seems to have other frequencies: its changes from row to row
    /// are not those that its rates give. False without rates.
    ///
    /// A sine of amplitude A and angular frequency ω with rows h apart changes by up to 2 A sin(ωh/2), and the mean of the rates at both
    /// rows gives h ω A cos(ωh/2). At two rows in a period the difference is 2 A, its root mean square is √2 A, and the range of the rows
    /// is at most 2 A; with more rows it is less, and with fewer it grows. Differences up to `least` do not count.
    pub fn is_undersampled(&self, least: f64) -> bool {
        let Some(rates) = self.rates else {
            return false;
        };
        let pairs = self.times.windows(2).zip(self.values.windows(2));
        let off = pairs.zip(rates.windows(2)).map(|((t, x), v)| {
            let by_rates = (t[1] - t[0]) * (v[0] + v[1]) / 2.0;
            x[1] - x[0] - by_rates
        });
        let off: Vec<f64> = off.filter(|off| off.is_finite()).collect();
        let squares: f64 = off.iter().map(|off| off * off).sum();
        let off = (squares / off.len().max(1) as f64).sqrt();
        off > (self.range() * std::f64::consts::FRAC_1_SQRT_2).max(least)
    }

    /// The interpolation of a row from the rows at odd distances.
    fn without(&self, row: usize) -> f64 {
        let last = self.times.len() - 1;
        let away = [-1, 1, -3, 3, -5, 5].map(|k: isize| row.checked_add_signed(k));
        let rows = away.into_iter().flatten().filter(|k| *k <= last);
        let rows: Vec<usize> = rows.take(4).collect();
        lagrange(self.times, self.values, &rows, self.times[row])
    }

    /// The instants, in s, at which the curve crosses a level, each with whether it rises there. Touching the level is no crossing; a
    /// curve that stays on the level crosses it where it leaves on the other side.
    pub fn crossings(&self, level: f64) -> Vec<(f64, bool)> {
        let mut crossings = Vec::new();
        // The last row that was not on the level.
        let mut before: Option<(usize, f64)> = None;
        for (row, x) in self.values.iter().map(|x| x - level).enumerate() {
            if x.is_nan() {
                before = None;
            } else if x != 0.0 {
                if let Some((last, side)) = before.filter(|(_, side)| *side != x.signum()) {
                    let t = match row - last {
                        1 => self.root(last, row, level, side),
                        // Rows in between are on the level: the crossing is at the last of them.
                        _ => self.times[row - 1],
                    };
                    crossings.push((t, side < 0.0));
                }
                before = Some((row, x.signum()));
            }
        }
        crossings
    }

    /// The instant between two rows at which the curve crosses a level, by bisection: 60 steps exhaust the
    /// digits of an interval.
    fn root(&self, left: usize, right: usize, level: f64, side: f64) -> f64 {
        let (mut low, mut high) = (self.times[left], self.times[right]);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if !(low < middle && middle < high) {
                break;
            }
            if (self.at(middle) - level) * side > 0.0 {
                low = middle
            } else {
                high = middle
            }
        }
        0.5 * (low + high)
    }
}

/// The cubic with values x and slopes d at s = 0 and s = 1.
pub(crate) fn hermite(s: f64, [x0, x1]: [f64; 2], [d0, d1]: [f64; 2]) -> f64 {
    let r = 1.0 - s;
    // This form is exact at both ends.
    r * r * (x0 * (1.0 + 2.0 * s) + s * d0) + s * s * (x1 * (1.0 + 2.0 * r) - r * d1)
}

/// The Lagrange polynomial through some rows.
fn lagrange(times: &[f64], values: &[f64], rows: &[usize], t: f64) -> f64 {
    let term = |&i: &usize| {
        let factors = rows.iter().filter(|j| **j != i);
        let weight: f64 = factors
            .map(|&j| (t - times[j]) / (times[i] - times[j]))
            .product();
        weight * values[i]
    };
    rows.iter().map(term).sum()
}

/// The instants of two tables within the time that both cover, in order. Instants closer together than 1e-9 of the
/// distance of rows are merged.
pub fn common_times(one: &[f64], other: &[f64]) -> Vec<f64> {
    let (Some(from), Some(to)) = (
        one.first().zip(other.first()).map(|(a, b)| a.max(*b)),
        one.last().zip(other.last()).map(|(a, b)| a.min(*b)),
    ) else {
        return Vec::new();
    };
    let within = |times: &[f64]| -> Vec<f64> {
        let inside = times.iter().copied();
        inside.filter(|t| (from..=to).contains(t)).collect()
    };
    let (mut all, others) = (within(one), within(other));
    let spacing = |times: &[f64]| {
        let count = times.len().max(2) - 1;
        (to - from) / count as f64
    };
    let same = 1e-9 * spacing(&all).min(spacing(&others));
    let first_times = all.clone();
    let is_new = |t: &f64| {
        let place = first_times.partition_point(|row| row < t);
        let near = [place.checked_sub(1), Some(place)];
        let mut near = near
            .into_iter()
            .flatten()
            .filter_map(|k| first_times.get(k));
        near.all(|row| (row - t).abs() > same)
    };
    all.extend(others.into_iter().filter(is_new));
    all.sort_by(f64::total_cmp);
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sine(count: usize, step: f64) -> [Vec<f64>; 3] {
        let times: Vec<f64> = (0..count).map(|k| k as f64 * step).collect();
        let values = times.iter().map(|t| t.sin()).collect();
        let rates = times.iter().map(|t| t.cos()).collect();
        [times, values, rates]
    }

    #[test]
    fn errors_between_rows_are_those_of_the_remainders() {
        let h = 0.1;
        let [times, values, rates] = sine(64, h);
        // Remainders of the interpolation of sin, whose derivatives are at most 1.
        for (between, bound) in [
            (Interpolation::Hermite, h.powi(4) / 384.0),
            (Interpolation::Cubic, h.powi(4) / 24.0),
            (Interpolation::Linear, h.powi(2) / 8.0),
        ] {
            let curve = Curve::new(&times, &values, Some(&rates), between);
            let off = (0..6300).map(|k| {
                let t = 1e-3 * f64::from(k);
                (curve.at(t) - t.sin()).abs()
            });
            let off = off.fold(0.0, f64::max);
            assert!(off <= bound * (1.0 + 1e-9), "{between:?}: {off} {bound}");
            assert!(off >= 0.2 * bound, "{between:?}: {off} {bound}");
            // The estimate of the error is the error, up to the factor between the middle of an interval and its ends.
            let estimated = curve.interpolation_error();
            assert!(
                (0.2..5.0).contains(&(estimated / off)),
                "{between:?}: {estimated} {off}"
            );
        }
    }

    /// A sine is undersampled below two rows in a period, at whatever phases the rows are.
    #[test]
    fn rates_show_that_a_sine_is_undersampled() {
        for (rows_in_a_period, is_undersampled) in [
            (20.0, false),
            (2.2, false),
            (1.9, true),
            (1.3, true),
            (1.0, true),
        ] {
            let h = std::f64::consts::TAU / rows_in_a_period;
            let phases: Vec<f64> = (0..500).map(|k| 0.4 + h * f64::from(k)).collect();
            let values: Vec<f64> = phases.iter().map(|phase| phase.sin()).collect();
            let rates: Vec<f64> = phases.iter().map(|phase| phase.cos()).collect();
            let curve = Curve::new(&phases, &values, Some(&rates), Interpolation::Hermite);
            assert_eq!(
                curve.is_undersampled(1e-9),
                is_undersampled,
                "{rows_in_a_period}"
            );
            let curve = Curve::new(&phases, &values, None, Interpolation::Cubic);
            assert!(!curve.is_undersampled(1e-9));
        }
        // A shaft that turns uniformly has the rate of its changes, however far apart rows are.
        let (times, rates) = ([0.0, 1.0, 2.0], [50.0; 3]);
        let curve = Curve::new(
            &times,
            &[0.0, 50.0, 100.0],
            Some(&rates),
            Interpolation::Hermite,
        );
        assert!(!curve.is_undersampled(1e-9));
    }

    #[test]
    fn rows_are_met_and_nothing_is_known_beyond_them() {
        let [times, values, rates] = sine(9, 0.3);
        for between in [
            Interpolation::Hermite,
            Interpolation::Cubic,
            Interpolation::Linear,
        ] {
            let curve = Curve::new(&times, &values, Some(&rates), between);
            for (t, x) in times.iter().zip(&values) {
                assert_eq!(curve.at(*t), *x);
            }
            assert!(curve.at(-1e-9).is_nan() && curve.at(2.41).is_nan());
        }
        let curve = Curve::new(&times, &values, None, Interpolation::Hermite);
        assert_eq!(curve.interpolation(), Interpolation::Cubic);
    }

    #[test]
    fn a_cubic_is_met_by_cubics_from_any_four_rows() {
        let times = [0.0, 0.5, 0.75, 2.0, 3.0];
        let cubic = |t: f64| 1.0 - 2.0 * t + 0.5 * t * t * t;
        let values = times.map(cubic);
        let rates = times.map(|t| -2.0 + 1.5 * t * t);
        for rates in [None, Some(&rates[..])] {
            let curve = Curve::new(&times, &values, rates, Interpolation::Hermite);
            for t in [0.1, 0.6, 1.3, 2.9] {
                // About a dozen operations on numbers up to 10.
                assert!((curve.at(t) - cubic(t)).abs() < 12.0 * 10.0 * f64::EPSILON);
            }
        }
    }

    #[test]
    fn crossings_are_where_a_sine_is_zero() {
        let [times, values, rates] = sine(200, 0.1);
        let curve = Curve::new(&times, &values, Some(&rates), Interpolation::Hermite);
        let found = curve.crossings(0.0);
        // sin starts on the level and does not cross it there.
        assert_eq!(found.len(), 6);
        for (k, (t, rises)) in found.iter().enumerate() {
            let exact = std::f64::consts::PI * (k + 1) as f64;
            assert!((t - exact).abs() < 0.1_f64.powi(4) / 384.0);
            assert_eq!(*rises, k % 2 == 1);
        }
        // Rows on the level, after which the curve leaves on the same side or on the other.
        let touching = Curve::new(
            &[0.0, 1.0, 2.0],
            &[1.0, 0.0, 1.0],
            None,
            Interpolation::Linear,
        );
        assert_eq!(touching.crossings(0.0), []);
        let times = [0.0, 1.0, 2.0, 3.0];
        let resting = Curve::new(&times, &[1.0, 0.0, 0.0, -1.0], None, Interpolation::Linear);
        assert_eq!(resting.crossings(0.0), [(2.0, false)]);
    }

    #[test]
    fn instants_of_both_are_common() {
        let found = common_times(&[0.0, 1.0, 2.0, 3.0], &[0.5, 1.0 + 1e-13, 2.5]);
        assert_eq!(found, [0.5, 1.0, 2.0, 2.5]);
        assert_eq!(common_times(&[0.0, 1.0], &[2.0, 3.0]), []);
    }
}
