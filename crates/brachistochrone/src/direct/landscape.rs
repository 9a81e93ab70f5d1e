//! A machine outside of the conditions (17) that is given by its expressions, and its fastest motion.

use std::string::String;
use std::vec::Vec;

use lagrangian_scalar::Scalar;
use lagrangian_symbolic::{Dag, Evaluation, Expr};

use super::{Search, Sought, Terrain};
use crate::error::Unsolved;
use crate::solution::{Contact, Lapse, Moment};

/// The coefficients of (8) as expressions of coordinates, rates and parameters.
#[derive(Clone, Debug)]
pub struct Coefficients<'d> {
    /// The coordinates.
    pub q: Vec<Expr<'d>>,
    /// Their rates.
    pub v: Vec<Expr<'d>>,
    /// Parameters with their values.
    pub parameters: Vec<(Expr<'d>, f64)>,
    /// The mass matrix by rows.
    pub mass: Vec<Expr<'d>>,
    /// `c_α = −Q_α`, inertia forces included.
    pub slope: Vec<Expr<'d>>,
    /// The guides that slide.
    pub guides: Vec<GuideCoefficients<'d>>,
}

/// A guide that slides, with its normal reaction `N = ν + ρ·a + Σ κ F`, where `F = −μ N` is the friction of each guide.
#[derive(Clone, Debug)]
pub struct GuideCoefficients<'d> {
    /// Its name.
    pub name: String,
    /// The direction of slip, a covector.
    pub along: Vec<Expr<'d>>,
    /// `ν`, in N.
    pub load: Expr<'d>,
    /// `ρ`.
    pub weights: Vec<Expr<'d>>,
    /// `κ`, one for each guide in order.
    pub by_friction_forces: Vec<Expr<'d>>,
    /// `μ`.
    pub friction: Expr<'d>,
}

/// Masses, forces and guides as functions of position and velocity.
#[derive(Clone, Debug)]
pub struct Landscape<'d> {
    /// The number of coordinates.
    n: usize,
    mass: Formulas<'d>,
    slope: Formulas<'d>,
    guides: Vec<Guide<'d>>,
    /// The factor of all friction coefficients.
    friction: f64,
}

/// A guide, with its reaction caused by accelerations, and that caused by loads.
#[derive(Clone, Debug)]
struct Guide<'d> {
    name: String,
    by_weights: Formulas<'d>,
    by_loads: Formulas<'d>,
}

/// Expressions, with the value of each symbol in them.
#[derive(Clone, Debug)]
struct Formulas<'d> {
    expressions: Evaluation<'d>,
    /// In the order in which the evaluation asks for them.
    symbols: Vec<Value>,
}

#[derive(Clone, Copy, Debug)]
enum Value {
    Coordinate(usize),
    Rate(usize),
    Number(f64),
}

impl<'d> Formulas<'d> {
    fn new(dag: &'d Dag, of: &Coefficients<'d>, list: &[Expr<'d>]) -> Formulas<'d> {
        let expressions = Evaluation::new(dag, list);
        let place = |list: &[Expr<'d>], symbol| {
            let mut symbols = list.iter().map(|expr| expr.as_symbol());
            symbols.position(|known| known == Some(symbol))
        };
        let value = |&symbol| {
            let rate = || place(&of.v, symbol).map(Value::Rate);
            let moving = place(&of.q, symbol).map(Value::Coordinate).or_else(rate);
            moving.unwrap_or_else(|| {
                let mut parameters = of.parameters.iter();
                let known = parameters.find(|(known, _)| known.as_symbol() == Some(symbol));
                // What has no value makes all that depends on it NaN.
                Value::Number(known.map_or(f64::NAN, |known| known.1))
            })
        };
        let symbols = expressions.symbols().iter().map(value).collect();
        Formulas {
            expressions,
            symbols,
        }
    }

    fn values<N: Scalar>(&self, q: &[N], v: &[N]) -> Vec<N> {
        let mut symbols = self.symbols.iter();
        self.expressions.values(|_| match symbols.next() {
            Some(Value::Coordinate(i)) => q[*i],
            // Masses do not depend on rates, and are evaluated without them.
            Some(Value::Rate(i)) => v.get(*i).copied().unwrap_or(N::from_f64(f64::NAN)),
            Some(Value::Number(value)) => N::from_f64(*value),
            None => N::from_f64(f64::NAN),
        })
    }
}

/// The quantities of a guide at one position, in one number type.
struct Local<N> {
    along: Vec<N>,
    by_friction_forces: Vec<N>,
    friction: N,
    /// The parts of the reaction: columns of numbers, one after the other.
    parts: Vec<N>,
}

impl<'d> Landscape<'d> {
    /// The machine with these coefficients.
    pub fn new(dag: &'d Dag, coefficients: &Coefficients<'d>) -> Landscape<'d> {
        let formulas = |list: &[Expr<'d>]| Formulas::new(dag, coefficients, list);
        let guide = |guide: &GuideCoefficients<'d>| {
            let with = |reaction: &[Expr<'d>]| {
                let mut list = guide.along.clone();
                list.extend(&guide.by_friction_forces);
                list.push(guide.friction);
                list.extend(reaction);
                formulas(&list)
            };
            Guide {
                name: guide.name.clone(),
                by_weights: with(&guide.weights),
                by_loads: with(&[guide.load]),
            }
        };
        Landscape {
            n: coefficients.q.len(),
            mass: formulas(&coefficients.mass),
            slope: formulas(&coefficients.slope),
            guides: coefficients.guides.iter().map(guide).collect(),
            friction: 1.0,
        }
    }

    /// The guides at a position, each with its reaction to accelerations or to loads.
    fn locals<N: Scalar>(&self, q: &[N], v: &[N], loads: bool) -> Vec<Local<N>> {
        let n = self.n;
        let count = self.guides.len();
        let mut locals: Vec<Local<N>> = Vec::new();
        for guide in &self.guides {
            let reaction = if loads {
                &guide.by_loads
            } else {
                &guide.by_weights
            };
            let mut values = reaction.values(q, v);
            let parts = values.split_off(n + count + 1);
            let friction = values[n + count] * N::from_f64(self.friction);
            values.truncate(n + count);
            let by_friction_forces = values.split_off(n);
            locals.push(Local {
                along: values,
                by_friction_forces,
                friction,
                parts,
            });
        }
        eliminate(&mut locals);
        locals
    }
}

/// Solves `(1 + κ μ) N = ν + ρ·a` for N, by elimination without pivoting, because friction forces change reactions little.
fn eliminate<N: Scalar>(guides: &mut [Local<N>]) {
    let count = guides.len();
    let friction_forces: Vec<N> = guides.iter().map(|guide| guide.friction).collect();
    let mut matrix: Vec<Vec<N>> = Vec::new();
    for (i, guide) in guides.iter().enumerate() {
        let coupled = guide.by_friction_forces.iter().zip(&friction_forces);
        let mut row: Vec<N> = coupled.map(|(kappa, mu)| *kappa * *mu).collect();
        row[i] = row[i] + N::ONE;
        matrix.push(row);
    }
    for k in 0..count {
        let pivot = matrix[k].clone();
        for i in (0..count).filter(|i| *i != k) {
            let factor = matrix[i][k] / matrix[k][k];
            for (entry, above) in matrix[i].iter_mut().zip(&pivot) {
                *entry = *entry - factor * *above;
            }
            for part in 0..guides[k].parts.len() {
                guides[i].parts[part] = guides[i].parts[part] - factor * guides[k].parts[part];
            }
        }
    }
    for (k, guide) in guides.iter_mut().enumerate() {
        for part in &mut guide.parts {
            *part = *part / matrix[k][k];
        }
    }
}

impl Terrain for Landscape<'_> {
    fn coordinates(&self) -> usize {
        self.n
    }

    fn inertia<N: Scalar>(&self, q: &[N]) -> Vec<N> {
        let n = q.len();
        let mut inertia = self.mass.values(q, &[]);
        for guide in self.locals(q, &[], false) {
            for (k, entry) in inertia.iter_mut().enumerate() {
                *entry = *entry + guide.friction * guide.along[k / n] * guide.parts[k % n];
            }
        }
        inertia
    }

    fn resistance<N: Scalar>(&self, q: &[N], v: &[N]) -> Vec<N> {
        let mut resistance = self.slope.values(q, v);
        for guide in self.locals(q, v, true) {
            for (entry, along) in resistance.iter_mut().zip(&guide.along) {
                *entry = *entry + guide.friction * *along * guide.parts[0];
            }
        }
        resistance
    }

    fn mass(&self, q: &[f64]) -> Vec<f64> {
        self.mass.values(q, &[])
    }

    fn with_friction(&self, share: f64) -> Option<Self> {
        let mut machine = self.clone();
        machine.friction *= share;
        (!self.guides.is_empty()).then_some(machine)
    }

    fn guides(&self) -> Vec<String> {
        let guides = self.guides.iter();
        guides.map(|guide| guide.name.clone()).collect()
    }

    fn contacts(&self, q: &[f64], v: &[f64], a: &[f64]) -> (Vec<Contact>, f64) {
        let [loads, weights] = [true, false].map(|loads| self.locals(q, v, loads));
        let mut power = 0.0;
        let contact = |(load, weight): (&Local<f64>, &Local<f64>)| {
            let dot = |x: &[f64], y: &[f64]| x.iter().zip(y).map(|(x, y)| x * y).sum::<f64>();
            let slip = dot(&load.along, v);
            let reaction = load.parts[0] + dot(&weight.parts, a);
            power -= load.friction * reaction * slip;
            Contact { slip, reaction }
        };
        let contacts = loads.iter().zip(&weights).map(contact).collect();
        (contacts, power)
    }
}

/// The fastest motion of a [`Landscape`].
///
/// It is a [`Sought`], whose functions are generic; here those that take long are compiled once, in this crate.
#[derive(Clone, Debug)]
pub struct FastestMotion<'d>(Sought<Landscape<'d>>);

impl<'d> FastestMotion<'d> {
    /// The fastest motion from rest at one position to another.
    ///
    /// # Errors
    /// The errors of [`Search::solve`].
    pub fn find(
        search: &Search,
        landscape: Landscape<'d>,
        from: &[f64],
        to: &[f64],
    ) -> Result<FastestMotion<'d>, Unsolved> {
        search.solve(landscape, from, to).map(FastestMotion)
    }

    /// What the search found: durations, trials, and the work that it took.
    pub fn sought(&self) -> &Sought<Landscape<'d>> {
        &self.0
    }

    /// [`Sought::at`].
    pub fn at(&self, time: f64) -> Moment {
        self.0.at(time)
    }

    /// [`Sought::violations`].
    pub fn violations(&self) -> Vec<Lapse> {
        self.0.violations()
    }

    /// [`Sought::best_among_turns`].
    pub fn best_among_turns(&self) -> [f64; 2] {
        self.0.best_among_turns()
    }
}
