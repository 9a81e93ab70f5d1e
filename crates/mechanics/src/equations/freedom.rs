//! Degrees of freedom of a machine: coordinates, independent constraints, and the difference.
//!
//! The number of independent constraints is the rank of `G` at coordinates that satisfy the
//! constraints; elsewhere it may be larger, since two equivalent constraints have independent rows
//! wherever they are violated. Such places are found by Newton's method in double-double, from the
//! start, and from each place after a random step along the free directions. The rank can only be
//! lower at special places, so the largest one found holds nearly everywhere about the start; at
//! the start itself it may be lower, at a bifurcation of motions. Constraints of rates, such as
//! rolling, count like those of positions.

mod contradiction;

pub use contradiction::contradictions;

use lagrangian_scalar::{DoubleDouble, Scalar};
use lagrangian_symbolic::{Expr, Symbol, evaluate};
use rustc_hash::FxHashMap;

use super::{ConstraintEquation, Equations};
use lagrangian_spec::identity;
use lagrangian_spec::model::Model;

/// The number of places that are examined besides the start.
const CONFIGURATIONS: usize = 5;

/// The largest product of the numbers of constraints and coordinates for which the rank is computed;
/// a place then takes milliseconds.
const MOST_ENTRIES: usize = 4096;

/// The largest number of steps of Newton's method. It converges quadratically, but only linearly,
/// by halves, at a bifurcation.
const STEPS: usize = 120;

/// A row of `G` counts as dependent if at most this fraction of its length remains. Places are
/// known to 1e-14 at a bifurcation and to 1e-28 elsewhere.
const DEPENDENT: f64 = 1e-10;

/// The tolerance of residuals, relative to the size of their rows: double-double rounds at 1e-32.
const RESIDUAL_TOLERANCE: f64 = 1e-26;

/// The degrees of freedom of a machine.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Freedom {
    /// The generalized coordinates.
    pub coordinates: usize,
    /// The number of quaternions that turn frames; the length of each is not a degree of freedom.
    pub lengths: usize,
    /// The constraints, two for each rolling contact.
    pub constraints: usize,
    /// The number of independent ones; none if no place was found that satisfies them.
    pub independent: Option<Independent>,
}

/// The number of independent constraints.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Independent {
    /// Nearly everywhere about the start.
    pub generic: usize,
    /// At the start, or at the nearest place that satisfies the constraints.
    pub at_start: usize,
}

impl Freedom {
    /// The degrees of freedom: coordinates minus independent constraints and minus the lengths of quaternions.
    pub fn degrees(&self) -> Option<usize> {
        let coordinates = self.coordinates - self.lengths;
        match (self.constraints, self.independent) {
            (0, _) => Some(coordinates),
            (_, independent) => coordinates.checked_sub(independent?.generic),
        }
    }
}

/// The freedom of a machine. Parameters have their defaults; those without a default are of the
/// order of 1.
pub fn freedom<'d>(model: &Model<'d>, equations: &Equations<'d>) -> Freedom {
    let constraints = &equations.constraints;
    let coordinates = model.coordinates.len();
    let is_small = coordinates * constraints.len() <= MOST_ENTRIES;
    let independent = if constraints.is_empty() || !is_small {
        None
    } else {
        Configurations::new(model, constraints).independent()
    };
    Freedom {
        coordinates,
        lengths: model.quaternions.len(),
        constraints: constraints.len(),
        independent,
    }
}

type Row = Vec<DoubleDouble>;

/// Evaluates the constraints of a machine at places.
struct Configurations<'m, 'd> {
    model: &'m Model<'d>,
    /// The residuals, then the rows of `G`; constraints of positions come first.
    formulas: Vec<Expr<'d>>,
    /// The number of constraints of positions.
    position_constraints: usize,
    rows: usize,
    known: FxHashMap<Symbol, DoubleDouble>,
    /// The state of the random numbers.
    seed: u64,
}

impl<'m, 'd> Configurations<'m, 'd> {
    fn new(model: &'m Model<'d>, constraints: &[ConstraintEquation<'d>]) -> Configurations<'m, 'd> {
        let of_places = constraints.iter().filter(|c| c.position.is_some());
        let of_rates = constraints.iter().filter(|c| c.position.is_none());
        let residuals = of_places.clone().filter_map(|c| c.position);
        let rows = of_places
            .clone()
            .chain(of_rates)
            .flat_map(|c| c.row.clone());
        let mut known = FxHashMap::default();
        for parameter in &model.parameters {
            let Some(symbol) = parameter.symbol.as_symbol() else {
                continue;
            };
            let unknown = || DoubleDouble::from_f64(identity::sample_value(0, symbol));
            let default = parameter.default.map(|default| {
                evaluate(model.dag, &[default], |_| DoubleDouble::from_f64(f64::NAN))[0]
            });
            known.insert(symbol, default.unwrap_or_else(unknown));
        }
        known.extend(
            model
                .time
                .as_symbol()
                .map(|t| (t, DoubleDouble::from_f64(0.0))),
        );
        Configurations {
            model,
            formulas: residuals.chain(rows).collect(),
            position_constraints: of_places.count(),
            rows: constraints.len(),
            known,
            seed: 0x9E37_79B9_7F4A_7C15,
        }
    }

    /// A number between −1 and 1.
    fn random(&mut self) -> f64 {
        // G. Marsaglia, Xorshift RNGs, J. Stat. Softw. 8 (2003) 14.
        self.seed ^= self.seed << 13;
        self.seed ^= self.seed >> 7;
        self.seed ^= self.seed << 17;
        (self.seed >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }

    /// The start of the machine in the spec; none if it has no value.
    fn start(&self) -> Option<Row> {
        let starts: Vec<Expr<'d>> = self.model.coordinates.iter().map(|q| q.start).collect();
        let zero = DoubleDouble::from_f64(0.0);
        let value = |symbol| self.known.get(&symbol).copied().unwrap_or(zero);
        let start = evaluate(self.model.dag, &starts, value);
        start.iter().all(|q| q.is_finite()).then_some(start)
    }

    fn independent(&mut self) -> Option<Independent> {
        let mut place = self.consistent_configuration(self.start()?)?;
        let at_start = self.rank(&place)?;
        let mut generic = at_start;
        for _ in 0..CONFIGURATIONS {
            // Take a shorter step if a longer one leads to where the constraints cannot be satisfied.
            let found = [0.3, 0.03, 0.003].into_iter().find_map(|length| {
                let step: Row = place
                    .iter()
                    .map(|q| {
                        let size = q.to_f64().abs().max(0.3);
                        DoubleDouble::from_f64(length * size * self.random())
                    })
                    .collect();
                let (_, rows) = self.at(&place)?;
                let along = orthogonal_part(&orthonormalized(&rows), step);
                let moved = place.iter().zip(along).map(|(&q, d)| q + d).collect();
                self.consistent_configuration(moved)
            });
            let Some(found) = found else { break };
            place = found;
            generic = generic.max(self.rank(&place)?);
        }
        Some(Independent { generic, at_start })
    }

    /// The values of the symbols at a place.
    fn symbol_values(&self, place: &[DoubleDouble]) -> FxHashMap<Symbol, DoubleDouble> {
        let coordinates = self.model.coordinates.iter().zip(place);
        let mut values = self.known.clone();
        values.extend(coordinates.filter_map(|(q, &value)| Some((q.q.as_symbol()?, value))));
        values
    }

    /// The residuals of the constraints at a place, and the rows of `G`; none if they have no value.
    fn at(&self, place: &[DoubleDouble]) -> Option<(Row, Vec<Row>)> {
        let values = self.symbol_values(place);
        let zero = DoubleDouble::from_f64(0.0);
        let value = |symbol| values.get(&symbol).copied().unwrap_or(zero);
        let mut residuals = evaluate(self.model.dag, &self.formulas, value);
        if !residuals.iter().all(|value| value.is_finite()) {
            return None;
        }
        let entries = residuals.split_off(self.position_constraints);
        let rows = entries.chunks(place.len()).map(<[DoubleDouble]>::to_vec);
        Some((residuals, rows.collect()))
    }

    fn rank(&self, place: &[DoubleDouble]) -> Option<usize> {
        let (_, rows) = self.at(place)?;
        debug_assert_eq!(rows.len(), self.rows);
        Some(orthonormalized(&rows).len())
    }

    /// A place near this one that satisfies the constraints.
    fn consistent_configuration(&self, mut place: Row) -> Option<Row> {
        if self.position_constraints == 0 {
            return Some(place);
        }
        for _ in 0..STEPS {
            let (residuals, mut rows) = self.at(&place)?;
            rows.truncate(self.position_constraints);
            let sizes: Vec<f64> = rows.iter().map(|row| length(row).max(1e-300)).collect();
            let size = place.iter().map(|q| q.to_f64().abs()).fold(1.0, f64::max);
            let mut pairs = residuals.iter().zip(&sizes);
            if pairs
                .all(|(off, row)| off.to_f64().abs() <= RESIDUAL_TOLERANCE * row.max(1.0) * size)
            {
                return Some(place);
            }
            let step = minimum_norm_step(&rows, &residuals);
            let longest = step.iter().map(|d| d.to_f64().abs()).fold(0.0, f64::max);
            // Far from the constraints a full step may lead anywhere.
            let damped = (0.5 * size / longest.max(1e-300)).min(1.0);
            for (q, d) in place.iter_mut().zip(step) {
                *q = *q - d * DoubleDouble::from_f64(damped);
            }
        }
        // At a bifurcation Newton's method gains one bit per step, and ends at round-off.
        let (residuals, _) = self.at(&place)?;
        let off = residuals.iter().map(|off| off.to_f64().abs());
        (off.fold(0.0, f64::max) <= 1e-20).then_some(place)
    }
}

fn dot(a: &[DoubleDouble], b: &[DoubleDouble]) -> DoubleDouble {
    let zero = DoubleDouble::from_f64(0.0);
    a.iter().zip(b).fold(zero, |sum, (&a, &b)| sum + a * b)
}

fn length(row: &[DoubleDouble]) -> f64 {
    dot(row, row).to_f64().sqrt()
}

/// A vector minus its components along orthonormal rows.
fn orthogonal_part(rows: &[Row], mut vector: Row) -> Row {
    // Twice is enough: W. Kahan, in B. N. Parlett, The Symmetric Eigenvalue Problem (1980) §6.9.
    for row in rows.iter().chain(rows) {
        let part = dot(row, &vector);
        for (entry, &along) in vector.iter_mut().zip(row) {
            *entry = *entry - part * along;
        }
    }
    vector
}

/// Orthonormal rows that span the same space, as many as are independent. The row with the largest
/// remainder relative to its length is taken first.
fn orthonormalized(rows: &[Row]) -> Vec<Row> {
    orthonormalized_with_indices(rows)
        .into_iter()
        .map(|(_, row)| row)
        .collect()
}

/// The rows of [`orthonormalized`], each with the index of the row that it comes from.
fn orthonormalized_with_indices(rows: &[Row]) -> Vec<(usize, Row)> {
    let unit = |row: &Row| {
        let length = dot(row, row).sqrt();
        row.iter().map(|&entry| entry / length).collect::<Row>()
    };
    let longest = rows.iter().map(|row| length(row)).fold(0.0, f64::max);
    let mut left: Vec<(usize, Row)> = rows
        .iter()
        .enumerate()
        .filter(|(_, row)| length(row) > DEPENDENT * longest.max(1e-300))
        .map(|(place, row)| (place, unit(row)))
        .collect();
    let mut chosen: Vec<(usize, Row)> = Vec::new();
    while let Some(next) = (0..left.len()).max_by(|&a, &b| {
        let lengths = [a, b].map(|k| length(&left[k].1));
        lengths[0].total_cmp(&lengths[1]).then(b.cmp(&a))
    }) {
        let (place, row) = left.swap_remove(next);
        let known: Vec<Row> = chosen.iter().map(|(_, row)| row.clone()).collect();
        let row = orthogonal_part(&known, row);
        if length(&row) <= DEPENDENT {
            break;
        }
        let row = unit(&row);
        for (_, other) in &mut left {
            *other = orthogonal_part(std::slice::from_ref(&row), std::mem::take(other));
        }
        chosen.push((place, row));
    }
    chosen
}

/// The shortest step that satisfies, to first order, as many constraints as are independent.
fn minimum_norm_step(rows: &[Row], residuals: &[DoubleDouble]) -> Row {
    let zero = DoubleDouble::from_f64(0.0);
    let width = rows.first().map_or(0, Vec::len);
    let mut step = vec![zero; width];
    // Along each new direction in turn: its row has no component along later ones, so it stays satisfied.
    for (place, direction) in orthonormalized_with_indices(rows) {
        let missing = residuals[place] - dot(&rows[place], &step);
        let gain = dot(&rows[place], &direction);
        for (entry, &along) in step.iter_mut().zip(&direction) {
            *entry = *entry + missing / gain * along;
        }
    }
    step
}
