//! How a machine may move: coordinates, constraints that are independent, and the freedom left.
//!
//! What counts is the rank of `G` on the constraints: at coordinates that meet them, since two
//! constraints that say the same have independent rows wherever they are violated. Such places are
//! found from the start by Newton's method, in double-double, and from each by a step at random
//! along the directions that are free, and Newton's method again. A rank can only fall at a place,
//! so the largest found is the one that holds nearly everywhere about the start; at the start
//! itself it may be less, where motions fork. The constraints of a rate, of rolling for one, count
//! as those of a place do.

mod contradiction;

pub use contradiction::contradictions;

use lagrangian_scalar::{DoubleDouble, Scalar};
use lagrangian_symbolic::{Expr, Symbol, evaluate};
use rustc_hash::FxHashMap;

use super::{ConstraintEquation, Equations};
use lagrangian_spec::identity;
use lagrangian_spec::model::Model;

/// How many places are looked at besides the start.
const PLACES: usize = 5;

/// The most constraints and coordinates, multiplied, of a machine whose rank is found: a place takes
/// milliseconds then.
const MOST_ENTRIES: usize = 4096;

/// The most steps of Newton's method. It converges quadratically, and at a fork by halves.
const STEPS: usize = 120;

/// A row of `G` counts as dependent where no more of its length than this is left. Places are known
/// to 1e-14 at a fork and to 1e-28 elsewhere.
const DEPENDENT: f64 = 1e-10;

/// What the constraints may be off, of the size of their rows: double-double rounds at 1e-32.
const MET: f64 = 1e-26;

/// How freely a machine moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Freedom {
    /// The generalized coordinates.
    pub coordinates: usize,
    /// The fours of coordinates that turn frames, the length of each of which is no freedom.
    pub lengths: usize,
    /// The constraints, two for each rolling contact.
    pub constraints: usize,
    /// How many of them are independent; none where no place was found that meets them.
    pub independent: Option<Independent>,
}

/// How many constraints are independent.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Independent {
    /// Nearly everywhere about the start.
    pub generic: usize,
    /// At the start, or where it meets the constraints next to that.
    pub at_start: usize,
}

impl Freedom {
    /// The degrees of freedom: coordinates less independent constraints, and less the lengths of fours.
    pub fn degrees(&self) -> Option<usize> {
        let coordinates = self.coordinates - self.lengths;
        match (self.constraints, self.independent) {
            (0, _) => Some(coordinates),
            (_, independent) => coordinates.checked_sub(independent?.generic),
        }
    }
}

/// The freedom of a machine. Parameters have their defaults; those without are of the order of 1.
pub fn freedom<'d>(model: &Model<'d>, equations: &Equations<'d>) -> Freedom {
    let constraints = &equations.constraints;
    let coordinates = model.coordinates.len();
    let is_small = coordinates * constraints.len() <= MOST_ENTRIES;
    let independent = if constraints.is_empty() || !is_small {
        None
    } else {
        Places::new(model, constraints).independent()
    };
    Freedom {
        coordinates,
        lengths: model.quaternions.len(),
        constraints: constraints.len(),
        independent,
    }
}

type Row = Vec<DoubleDouble>;

/// The places of a machine, as numbers.
struct Places<'m, 'd> {
    model: &'m Model<'d>,
    /// What is to be zero, then the rows of `G`: those of places first.
    formulas: Vec<Expr<'d>>,
    /// How many constraints are of places.
    of_places: usize,
    rows: usize,
    known: FxHashMap<Symbol, DoubleDouble>,
    /// The state of the random numbers.
    seed: u64,
}

impl<'m, 'd> Places<'m, 'd> {
    fn new(model: &'m Model<'d>, constraints: &[ConstraintEquation<'d>]) -> Places<'m, 'd> {
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
            let unknown = || DoubleDouble::from_f64(identity::number(0, symbol));
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
        Places {
            model,
            formulas: residuals.chain(rows).collect(),
            of_places: of_places.count(),
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

    /// Where the spec says that the machine starts; none where that has no value.
    fn start(&self) -> Option<Row> {
        let starts: Vec<Expr<'d>> = self.model.coordinates.iter().map(|q| q.start).collect();
        let zero = DoubleDouble::from_f64(0.0);
        let value = |symbol| self.known.get(&symbol).copied().unwrap_or(zero);
        let start = evaluate(self.model.dag, &starts, value);
        start.iter().all(|q| q.is_finite()).then_some(start)
    }

    fn independent(&mut self) -> Option<Independent> {
        let mut place = self.met_near(self.start()?)?;
        let at_start = self.rank(&place)?;
        let mut generic = at_start;
        for _ in 0..PLACES {
            // Shorter steps where a long one leads to where the constraints cannot be met.
            let found = [0.3, 0.03, 0.003].into_iter().find_map(|length| {
                let step: Row = place
                    .iter()
                    .map(|q| {
                        let size = q.to_f64().abs().max(0.3);
                        DoubleDouble::from_f64(length * size * self.random())
                    })
                    .collect();
                let (_, rows) = self.at(&place)?;
                let along = free_part(&orthogonal(&rows), step);
                let moved = place.iter().zip(along).map(|(&q, d)| q + d).collect();
                self.met_near(moved)
            });
            let Some(found) = found else { break };
            place = found;
            generic = generic.max(self.rank(&place)?);
        }
        Some(Independent { generic, at_start })
    }

    /// The numbers that are known at a place.
    fn known_at(&self, place: &[DoubleDouble]) -> FxHashMap<Symbol, DoubleDouble> {
        let coordinates = self.model.coordinates.iter().zip(place);
        let mut values = self.known.clone();
        values.extend(coordinates.filter_map(|(q, &value)| Some((q.q.as_symbol()?, value))));
        values
    }

    /// What the constraints are off at a place, and the rows of `G`; none where they have no value.
    fn at(&self, place: &[DoubleDouble]) -> Option<(Row, Vec<Row>)> {
        let values = self.known_at(place);
        let zero = DoubleDouble::from_f64(0.0);
        let value = |symbol| values.get(&symbol).copied().unwrap_or(zero);
        let mut residuals = evaluate(self.model.dag, &self.formulas, value);
        if !residuals.iter().all(|value| value.is_finite()) {
            return None;
        }
        let entries = residuals.split_off(self.of_places);
        let rows = entries.chunks(place.len()).map(<[DoubleDouble]>::to_vec);
        Some((residuals, rows.collect()))
    }

    fn rank(&self, place: &[DoubleDouble]) -> Option<usize> {
        let (_, rows) = self.at(place)?;
        debug_assert_eq!(rows.len(), self.rows);
        Some(orthogonal(&rows).len())
    }

    /// A place next to this one that meets the constraints.
    fn met_near(&self, mut place: Row) -> Option<Row> {
        if self.of_places == 0 {
            return Some(place);
        }
        for _ in 0..STEPS {
            let (residuals, mut rows) = self.at(&place)?;
            rows.truncate(self.of_places);
            let sizes: Vec<f64> = rows.iter().map(|row| length(row).max(1e-300)).collect();
            let size = place.iter().map(|q| q.to_f64().abs()).fold(1.0, f64::max);
            let mut pairs = residuals.iter().zip(&sizes);
            if pairs.all(|(off, row)| off.to_f64().abs() <= MET * row.max(1.0) * size) {
                return Some(place);
            }
            let step = least_step(&rows, &residuals);
            let longest = step.iter().map(|d| d.to_f64().abs()).fold(0.0, f64::max);
            // Far from the constraints a whole step may lead anywhere.
            let damped = (0.5 * size / longest.max(1e-300)).min(1.0);
            for (q, d) in place.iter_mut().zip(step) {
                *q = *q - d * DoubleDouble::from_f64(damped);
            }
        }
        // At a fork Newton's method gains a bit a step, and ends where rounding does.
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

/// A vector less its parts along orthonormal rows.
fn free_part(rows: &[Row], mut vector: Row) -> Row {
    // Twice is enough: W. Kahan, in B. N. Parlett, The Symmetric Eigenvalue Problem (1980) §6.9.
    for row in rows.iter().chain(rows) {
        let part = dot(row, &vector);
        for (entry, &along) in vector.iter_mut().zip(row) {
            *entry = *entry - part * along;
        }
    }
    vector
}

/// Orthonormal rows that span the same, as many as are independent. The longest is taken first, by
/// the remainder of its own length.
fn orthogonal(rows: &[Row]) -> Vec<Row> {
    pivoted(rows).into_iter().map(|(_, row)| row).collect()
}

/// [`orthogonal`] rows, each with the place of the row that it comes from.
fn pivoted(rows: &[Row]) -> Vec<(usize, Row)> {
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
    let mut found: Vec<(usize, Row)> = Vec::new();
    while let Some(next) = (0..left.len()).max_by(|&a, &b| {
        let lengths = [a, b].map(|k| length(&left[k].1));
        lengths[0].total_cmp(&lengths[1]).then(b.cmp(&a))
    }) {
        let (place, row) = left.swap_remove(next);
        let known: Vec<Row> = found.iter().map(|(_, row)| row.clone()).collect();
        let row = free_part(&known, row);
        if length(&row) <= DEPENDENT {
            break;
        }
        let row = unit(&row);
        for (_, other) in &mut left {
            *other = free_part(std::slice::from_ref(&row), std::mem::take(other));
        }
        found.push((place, row));
    }
    found
}

/// The shortest step that meets, to first order, as many constraints as are independent.
fn least_step(rows: &[Row], residuals: &[DoubleDouble]) -> Row {
    let zero = DoubleDouble::from_f64(0.0);
    let width = rows.first().map_or(0, Vec::len);
    let mut step = vec![zero; width];
    // Along each new direction in turn, so that its row, which has none of the later ones, is met.
    for (place, direction) in pivoted(rows) {
        let missing = residuals[place] - dot(&rows[place], &step);
        let gain = dot(&rows[place], &direction);
        for (entry, &along) in step.iter_mut().zip(&direction) {
            *entry = *entry + missing / gain * along;
        }
    }
    step
}
