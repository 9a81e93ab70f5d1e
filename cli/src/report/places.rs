//! The values that a page computes at every instant, and which distances between points are constant.
//!
//! A point is represented by the index of its first component in one list of values; equal points share an index.
//! Whether two points keep their distance for every motion is decided exactly in the prime field of [`Residue`], where
//! every parameter has one random value and every coordinate several.

use std::collections::BTreeMap;

use lagrangian_scalar::{Residue, Scalar};
use lagrangian_spec::model::{Model, stage};
use lagrangian_symbolic::{Expr, Id, Symbol, evaluate};

/// The number of random sets of parameters that are tried: square roots of some have no value in the field.
const WORLDS: u64 = 4;

/// The number of random states for each set, and how many of them must have a value and agree. The probability of accepting
/// a wrong «constant» is about 2⁻¹⁰⁰.
const STATES: u64 = 6;
const NEEDED: usize = 3;

/// The values, with each list of components stored once.
#[derive(Default)]
pub struct Places<'d> {
    values: Vec<Expr<'d>>,
    known: BTreeMap<Vec<Id>, usize>,
}

impl<'d> Places<'d> {
    /// The index of the first of these components.
    pub fn of(&mut self, components: &[Expr<'d>]) -> usize {
        let ids: Vec<Id> = components.iter().map(|component| component.id()).collect();
        let next = self.values.len();
        let place = *self.known.entry(ids).or_insert(next);
        if place == next {
            self.values.extend_from_slice(components);
        }
        place
    }

    /// All values.
    pub fn values(&self) -> &[Expr<'d>] {
        &self.values
    }

    /// The values in all states of the random experiment.
    pub fn experiment(&self, model: &Model<'d>) -> Experiment {
        Experiment::new(model, &self.values)
    }

    /// Returns the values.
    pub fn into_values(self) -> Vec<Expr<'d>> {
        self.values
    }
}

/// The values for random parameter sets (worlds) and states (time and coordinates).
pub struct Experiment {
    /// `worlds[w][s][place]`.
    worlds: Vec<Vec<Vec<Residue>>>,
}

impl Experiment {
    /// Evaluates the values in all worlds and states.
    pub fn new(model: &Model<'_>, values: &[Expr<'_>]) -> Experiment {
        let state = |world: u64, state: u64| {
            let value = |symbol: Symbol| {
                let known = model.dag.stage_of(symbol) <= stage::PARAMETER;
                let seed = world * (STATES + 1) + if known { 0 } else { state + 1 };
                Residue::random(seed, symbol.index() as u64)
            };
            evaluate(model.dag, values, value)
        };
        let world = |w| (0..STATES).map(|s| state(w, s)).collect();
        Experiment {
            worlds: (0..WORLDS).map(world).collect(),
        }
    }

    /// Whether a function of the values is the same in every state of a world.
    fn is_constant(&self, f: impl Fn(&[Residue]) -> Residue) -> bool {
        for states in &self.worlds {
            let defined: Vec<Residue> = states
                .iter()
                .map(|state| f(state))
                .filter(|value| value.is_finite())
                .take(NEEDED + 1)
                .collect();
            if let [first, rest @ ..] = defined.as_slice()
                && defined.len() >= NEEDED
            {
                return rest.iter().all(|value| value == first);
            }
        }
        false
    }

    /// Whether a value is constant.
    pub fn value_is_constant(&self, place: usize) -> bool {
        self.is_constant(|x| x[place])
    }

    /// Whether two points with `dimension` components keep their distance.
    pub fn keeps_distance(&self, a: usize, b: usize, dimension: usize) -> bool {
        self.is_constant(|x| square(x, [a, b], dimension))
    }

    /// Whether a point is fixed in the frame with this origin and these axes, whose components are stored one axis
    /// after the other.
    pub fn rests(&self, point: usize, origin: usize, axes: usize, dimension: usize) -> bool {
        (0..dimension).all(|axis| {
            self.is_constant(|x| {
                let along = |k| x[axes + axis * dimension + k] * (x[point + k] - x[origin + k]);
                (1..dimension).fold(along(0), |sum, k| sum + along(k))
            })
        })
    }

    /// Whether a vector has constant length, given the indices of its nonzero components.
    pub fn keeps_length(&self, components: &[usize]) -> bool {
        self.is_constant(|x| {
            let square = |place: &usize| x[*place] * x[*place];
            components
                .iter()
                .fold(Residue::ZERO, |sum, place| sum + square(place))
        })
    }

    /// Whether two points coincide.
    pub fn coincide(&self, a: usize, b: usize, dimension: usize) -> bool {
        let zero = |x: &[Residue]| (0..dimension).all(|k| x[a + k] == x[b + k]);
        a == b || self.worlds.iter().flatten().all(|state| zero(state))
    }

    /// Whether the distance of two points is a stretch up to a constant: `|a − b| = ±(stretch + c)`.
    ///
    /// Square roots are avoided: with `e = |a − b|² − stretch²` the condition is `e = 2 c · stretch + c²`, so the pairs
    /// (stretch, e) lie on a line whose slope and intercept are consistent. Returns whether `c` is 0.
    pub fn is_stretch(&self, a: usize, b: usize, stretch: usize, dimension: usize) -> Option<bool> {
        let (slope, intercept) = self.line(stretch, |x| {
            square(x, [a, b], dimension) - x[stretch] * x[stretch]
        })?;
        let c = slope / (Residue::ONE + Residue::ONE);
        (intercept == c * c).then_some(c == Residue::ZERO)
    }

    /// Whether a constraint keeps the distance of two points: its function `g` vanishes together with `|a − b| − c`
    /// or `|a − b|² − c`.
    pub fn is_kept(&self, a: usize, b: usize, g: usize, dimension: usize) -> bool {
        let of_square = self.line(g, |x| square(x, [a, b], dimension));
        of_square.is_some_and(|(slope, _)| slope != Residue::ZERO)
            || self.is_stretch(a, b, g, dimension).is_some()
    }

    /// Slope and intercept of a function of the values that depends linearly on one of them; `None` if it does not, or if
    /// that value is constant.
    fn line(&self, by: usize, f: impl Fn(&[Residue]) -> Residue) -> Option<(Residue, Residue)> {
        for states in &self.worlds {
            let pairs: Vec<(Residue, Residue)> = states
                .iter()
                .map(|x| (x[by], f(x)))
                .filter(|(x, y)| x.is_finite() && y.is_finite())
                .collect();
            let [(x0, y0), (x1, y1), rest @ ..] = pairs.as_slice() else {
                continue;
            };
            if rest.len() + 2 < NEEDED || x0 == x1 {
                continue;
            }
            let (dx, dy) = (*x1 - *x0, *y1 - *y0);
            if !rest.iter().all(|(x, y)| dy * (*x - *x0) == (*y - *y0) * dx) {
                return None;
            }
            let slope = dy / dx;
            return Some((slope, *y0 - slope * *x0));
        }
        None
    }
}

/// The squared distance of two points with `dimension` components.
fn square(x: &[Residue], [a, b]: [usize; 2], dimension: usize) -> Residue {
    let square = |k| {
        let d = x[a + k] - x[b + k];
        d * d
    };
    (1..dimension).fold(square(0), |sum, k| sum + square(k))
}
