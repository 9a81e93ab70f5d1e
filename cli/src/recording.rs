//! The quantities of a recording that are drawn.

use lagrangian::Solution;
pub use lagrangian::interpreted::{Column, ColumnKind, Recording};
use lagrangian::interpreted::{InterpretedMachine, Signals};

/// A run of a machine read from a spec.
pub type Run = Solution<InterpretedMachine, Signals>;

/// The groups that are drawn together: coordinates, rates, outputs and multipliers by unit, energies, the residual; of the
/// requested kinds, without empty groups.
pub fn panels<'a>(recording: &'a Recording, kinds: &[ColumnKind]) -> Vec<Panel<'a>> {
    let mut panels: Vec<Panel> = Vec::new();
    for &kind in kinds {
        for column in recording.of_kind(kind) {
            let unit = column.unit.as_str();
            let same = |panel: &&mut Panel| panel.kind == kind && panel.unit == unit;
            match panels.iter_mut().find(same) {
                Some(panel) => panel.columns.push(column),
                None => panels.push(Panel {
                    kind,
                    unit,
                    columns: vec![column],
                }),
            }
        }
    }
    panels
}

/// Quantities with a common axis.
pub struct Panel<'a> {
    /// The kind of quantity.
    pub kind: ColumnKind,
    /// Their unit.
    pub unit: &'a str,
    /// The quantities.
    pub columns: Vec<&'a Column>,
}

/// Values below this in their unit are round-off; beside numbers of 1 or more it is relative. No tolerance determines
/// coordinates more accurately.
pub const ROUNDING: f64 = 1e-12;

/// The least and the greatest finite number; `None` if there are none.
pub fn extent(values: impl Iterator<Item = f64>) -> Option<[f64; 2]> {
    let finite = values.filter(|value| value.is_finite());
    finite.fold(None, |extent, value| {
        let [low, high] = extent.unwrap_or([value; 2]);
        Some([low.min(value), high.max(value)])
    })
}

impl Panel<'_> {
    /// The variation of all curves together that counts as more than round-off, so that they are not drawn as straight
    /// lines. In the energy balance round-off itself is of interest.
    pub fn rounding(&self) -> f64 {
        let values = self.columns.iter().flat_map(|column| &column.values);
        let sizes = values.map(|value| value.abs());
        let largest = extent(sizes).map_or(0.0, |[_, largest]| largest);
        match self.kind {
            ColumnKind::Residual => 0.0,
            ColumnKind::Coordinate | ColumnKind::Rate => ROUNDING * largest.max(1.0),
            ColumnKind::Output
            | ColumnKind::Input
            | ColumnKind::Contact
            | ColumnKind::Multiplier
            | ColumnKind::Energy => {
                // These values may be small relative to their unit, and result from a few hundred operations.
                1e3 * f64::EPSILON * largest
            }
        }
    }

    /// The label of the axis: `coordinates [rad]`.
    pub fn label(&self) -> String {
        let plural = match self.kind {
            ColumnKind::Coordinate => "coordinates",
            ColumnKind::Rate => "rates",
            ColumnKind::Output => "outputs",
            ColumnKind::Input => "inputs",
            ColumnKind::Multiplier => "multipliers",
            ColumnKind::Contact => "contacts",
            ColumnKind::Energy => "energy",
            ColumnKind::Residual => "energy balance",
        };
        format!("{plural} [{}]", self.unit)
    }
}

/// The same curve without the inner points of constant stretches.
pub fn steady(times: &[f64], values: &[f64]) -> (Vec<f64>, Vec<f64>) {
    let last = values.len().saturating_sub(1);
    let is_kept = |i: &usize| {
        let (before, after) = (values.get(i.wrapping_sub(1)), values.get(i + 1));
        *i == 0 || *i == last || before != Some(&values[*i]) || after != Some(&values[*i])
    };
    let changing = (0..values.len()).filter(is_kept);
    changing.map(|i| (times[i], values[i])).unzip()
}

/// Thins a curve to about `most` points such that it looks the same: the lowest and the highest point of each
/// stretch, in order. A value that is not finite becomes NaN, a gap in the curve, of which each stretch keeps both ends.
pub fn thin(times: &[f64], values: &[f64], most: usize) -> Vec<(f64, f64)> {
    let finite_or_gap = |value: &f64| if value.is_finite() { *value } else { f64::NAN };
    let values = values.iter().map(finite_or_gap);
    let points: Vec<(f64, f64)> = times.iter().copied().zip(values).collect();
    if points.len() <= most {
        return points;
    }
    let stretch = points.len().div_ceil((most / 2).max(1));
    let mut kept = Vec::with_capacity(most + 2);
    for part in points.chunks(stretch) {
        let is_gap = |place: &usize| part[*place].1.is_nan();
        let finite = || (0..part.len()).filter(move |place| !is_gap(place));
        let by_value = |a: &usize, b: &usize| part[*a].1.total_cmp(&part[*b].1);
        let of_interest = [
            finite().min_by(by_value),
            finite().max_by(by_value),
            (0..part.len()).find(is_gap),
            (0..part.len()).rfind(is_gap),
        ];
        let mut places: Vec<usize> = of_interest.into_iter().flatten().collect();
        places.sort_unstable();
        places.dedup();
        kept.extend(places.into_iter().map(|place| part[place]));
    }
    kept.extend(points.last());
    kept
}

/// The parts of a thinned curve between its gaps.
pub fn parts(points: &[(f64, f64)]) -> impl Iterator<Item = &[(f64, f64)]> {
    let parts = points.split(|(_, value)| value.is_nan());
    parts.filter(|part| !part.is_empty())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_thinned_curve_keeps_its_extremes() {
        let times: Vec<f64> = (0..100_000).map(f64::from).collect();
        let mut values = vec![0.0; times.len()];
        values[70_001] = 5.0;
        values[123] = -3.0;
        let kept = thin(&times, &values, 1500);
        assert!(kept.len() <= 1502);
        assert!(kept.contains(&(70_001.0, 5.0)) && kept.contains(&(123.0, -3.0)));
    }

    #[test]
    fn where_there_is_no_number_the_curve_has_a_gap() {
        let times: Vec<f64> = (0..9).map(f64::from).collect();
        let [none, much] = [f64::NAN, f64::INFINITY];
        let values = [none, 1.0, 2.0, much, none, 3.0, -much, 4.0, 5.0];
        let points = thin(&times, &values, 1500);
        let found: Vec<&[(f64, f64)]> = parts(&points).collect();
        let [first, last] = [[(1.0, 1.0), (2.0, 2.0)], [(7.0, 4.0), (8.0, 5.0)]];
        assert_eq!(found, [&first[..], &[(5.0, 3.0)], &last]);

        // Thinned, it has the same parts: values that increase have their extremes at the ends.
        let times: Vec<f64> = (0..100_000).map(f64::from).collect();
        let value = |i: i32| {
            if (i / 10_000) % 2 == 0 {
                f64::from(i)
            } else {
                none
            }
        };
        let values: Vec<f64> = (0..100_000).map(value).collect();
        let points = thin(&times, &values, 1500);
        let found: Vec<&[(f64, f64)]> = parts(&points).collect();
        assert_eq!(found.len(), 5);
        for (part, begin) in found.iter().zip([0.0, 2e4, 4e4, 6e4, 8e4]) {
            assert_eq!(part.first(), Some(&(begin, begin)));
            assert_eq!(part.last(), Some(&(begin + 9999.0, begin + 9999.0)));
        }
    }

    #[test]
    fn what_does_not_change_is_two_points() {
        let times: Vec<f64> = (0..9).map(f64::from).collect();
        let values = [0.0, 0.0, 0.0, 4.0, 5.0, 5.0, 5.0, 5.0, 0.0];
        let (kept, of) = steady(&times, &values);
        assert_eq!(kept, [0.0, 2.0, 3.0, 4.0, 7.0, 8.0]);
        assert_eq!(of, [0.0, 0.0, 4.0, 5.0, 5.0, 0.0]);
        assert_eq!(steady(&[], &[]), (Vec::new(), Vec::new()));
    }

    #[test]
    fn rounding_is_told_from_motion_but_not_in_the_balance() {
        let rounding = |kind, values: &[f64]| {
            let column = Column {
                name: "x".into(),
                unit: "m".into(),
                kind,
                values: values.to_vec(),
            };
            let panel = Panel {
                kind,
                unit: "m",
                columns: vec![&column],
            };
            panel.rounding()
        };
        // A coordinate at rest at 0 within round-off, and one that moves by a nanometre.
        assert!(rounding(ColumnKind::Coordinate, &[1e-16, -3e-17]) > 1e-15);
        assert!(rounding(ColumnKind::Coordinate, &[1.0, 1.0 + 1e-9]) < 1e-10);
        assert!(rounding(ColumnKind::Energy, &[9.81, 9.81 + 2e-15]) > 2e-15);
        assert!(rounding(ColumnKind::Multiplier, &[1e-9, -1e-9]) < 1e-12);
        assert_eq!(rounding(ColumnKind::Residual, &[1e-16, f64::NAN]), 0.0);
        assert_eq!(extent([f64::NAN].into_iter()), None);
    }

    #[test]
    fn every_other_instant_keeps_the_last() {
        let values = vec![0.0, 1.0, 2.0, 3.0];
        let recording = Recording {
            times: values.clone(),
            columns: vec![Column {
                name: "x".into(),
                unit: "m".into(),
                kind: ColumnKind::Coordinate,
                values,
            }],
        };
        let thinned = recording.each(2);
        assert_eq!(thinned.times, [0.0, 2.0, 3.0]);
        assert_eq!(thinned.columns[0].values, [0.0, 2.0, 3.0]);
    }
}
