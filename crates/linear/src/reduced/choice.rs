//! Which coordinates follow from which constraints.

use nalgebra::DVector;

use super::{Fault, Reduced};

/// A row of G depends on others if its part that is orthogonal to them is shorter than this. A row determines no
/// coordinate in which its entry is smaller than this.
pub(super) const INDEPENDENT: f64 = 1e-8;

/// A row that is independent of the others by less than this depends on them at a position nearby, where constraints have no
/// linear approximation; a search that ends there has come only so near to it.
const BARELY_INDEPENDENT: f64 = 1e-6;

/// Among coordinates that a row could determine, one on which nothing depends is preferred if its share of the row
/// is at least this.
const PREFERRED: f64 = 1e-2;

/// Which coordinates follow from which constraints.
#[derive(Clone, Debug, PartialEq)]
pub struct Choice {
    /// An independent set of constraints, those of positions first.
    pub rows: Vec<usize>,
    /// I, the independent coordinates.
    pub independent: Vec<usize>,
    /// H, the coordinates determined by constraints of positions.
    pub position_dependent: Vec<usize>,
    /// F, the coordinates of which only the rates are determined.
    pub rate_dependent: Vec<usize>,
}

impl Choice {
    /// The coordinates that may be displaced freely, I and F.
    pub fn places(&self) -> Vec<usize> {
        [self.independent.as_slice(), &self.rate_dependent].concat()
    }

    pub(super) fn dependent(&self) -> Vec<usize> {
        [self.position_dependent.as_slice(), &self.rate_dependent].concat()
    }
}

impl Reduced<'_> {
    /// Checks that no constraint is all but dependent on the others at a position.
    ///
    /// # Errors
    /// If one is.
    pub fn check_independence(&self, q: &[f64]) -> Result<(), Fault> {
        let (rows, lower) = (self.rows(q), self.metric(q));
        let mut known: Vec<DVector<f64>> = Vec::new();
        for is_position in [true, false] {
            for k in (0..rows.nrows()).filter(|k| self.holonomic[*k] == is_position) {
                let row = lower.solve_lower_triangular(&rows.row(k).transpose());
                let row = row.ok_or(Fault::Singular(0))?;
                let Some(unit) = across(&known, &row, INDEPENDENT) else {
                    continue;
                };
                if across(&known, &row, BARELY_INDEPENDENT).is_none() {
                    return Err(Fault::Dependent(k));
                }
                known.push(unit);
            }
        }
        Ok(())
    }

    /// Chooses the coordinates that follow at a position, among those whose rates are not `given`.
    ///
    /// # Errors
    /// If a given rate follows from the others.
    pub fn choose(&self, q: &[f64], given: &[bool]) -> Result<Choice, Fault> {
        let n = q.len();
        let (rows, lower) = (self.rows(q), self.metric(q));
        if let Some(place) = rows.iter().position(|x| !x.is_finite()) {
            return Err(Fault::NotFinite(place / rows.nrows().max(1)));
        }
        let mut known: Vec<DVector<f64>> = Vec::new();
        let mut chosen: Vec<(usize, DVector<f64>)> = Vec::new();
        for is_position in [true, false] {
            for k in (0..rows.nrows()).filter(|k| self.holonomic[*k] == is_position) {
                let row = rows.row(k).transpose();
                let measured = lower.solve_lower_triangular(&row);
                let measured = measured.ok_or(Fault::Singular(0))?;
                if let Some(unit) = across(&known, &measured, INDEPENDENT) {
                    known.push(unit);
                    // Each coordinate is measured in its own length.
                    let scaled = DVector::from_fn(n, |j, _| row[j] / lower.row(j).norm());
                    let size = scaled.norm();
                    chosen.push((k, scaled / size));
                }
            }
        }
        // Gaussian elimination; the largest entry of a row selects the coordinate that the row determines.
        let mut follows = vec![None; n];
        let mut left: Vec<usize> = (0..chosen.len()).collect();
        let mut order = [Vec::new(), Vec::new()];
        while !left.is_empty() {
            let positions: Vec<usize> = left
                .iter()
                .copied()
                .filter(|i| self.holonomic[chosen[*i].0])
                .collect();
            let candidates = if positions.is_empty() {
                left.clone()
            } else {
                positions
            };
            let best = |may: &dyn Fn(usize) -> bool| {
                let all = candidates.iter().flat_map(|&i| (0..n).map(move |j| (i, j)));
                let all = all.filter(|(_, j)| follows[*j].is_none() && may(*j));
                let size = |&(i, j): &(usize, usize)| f64::abs(chosen[i].1[j]);
                let best = all.max_by(|a, b| size(a).total_cmp(&size(b)));
                best.map(|place| (place, size(&place)))
            };
            let any = best(&|j| !given[j]).filter(|(_, size)| *size > INDEPENDENT);
            let Some((place, largest)) = any else {
                let ((_, j), _) = best(&|_| true).ok_or(Fault::Singular(0))?;
                return Err(Fault::Follows(j));
            };
            let idle = best(&|j| !given[j] && self.idle[j]);
            let (i, j) = idle
                .filter(|(_, size)| *size > PREFERRED * largest)
                .map_or(place, |(place, _)| place);
            let row = chosen[i].1.clone() / chosen[i].1[j];
            left.retain(|other| *other != i);
            for &other in &left {
                let factor = chosen[other].1[j];
                chosen[other].1 -= &row * factor;
            }
            follows[j] = Some(i);
            order[usize::from(!self.holonomic[chosen[i].0])].push((chosen[i].0, j));
        }
        let [position_dependent, rate_dependent] = order;
        let rows = position_dependent
            .iter()
            .chain(&rate_dependent)
            .map(|(k, _)| *k)
            .collect();
        let coordinates = |list: Vec<(usize, usize)>| list.into_iter().map(|(_, j)| j).collect();
        Ok(Choice {
            rows,
            independent: (0..n).filter(|j| follows[*j].is_none()).collect(),
            position_dependent: coordinates(position_dependent),
            rate_dependent: coordinates(rate_dependent),
        })
    }
}

/// The component of a vector orthogonal to orthonormal ones, as a unit vector; none where it is shorter than
/// `least` times the vector.
pub(super) fn across(
    known: &[DVector<f64>],
    vector: &DVector<f64>,
    least: f64,
) -> Option<DVector<f64>> {
    let mut left = vector.clone();
    // Orthogonalizing twice is enough: W. Kahan in B. N. Parlett, The Symmetric Eigenvalue Problem, 6-9.
    for _ in 0..2 {
        for unit in known {
            left -= unit * unit.dot(&left);
        }
    }
    let length = left.norm();
    (length > least * vector.norm()).then(|| left / length)
}
