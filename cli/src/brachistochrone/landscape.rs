//! A machine outside of the conditions (17) in the form of the direct method: its own expressions for any number type.

use lagrangian::Scalar;
use lagrangian_brachistochrone::Contact;
use lagrangian_brachistochrone::direct::Terrain;
use lagrangian_mechanics::Brachistochronic;
use lagrangian_spec::model::Model;
use lagrangian_symbolic::{Evaluation, Expr, Symbol};

/// Masses, forces and guides as functions of position and velocity.
#[derive(Clone)]
pub struct Landscape<'a, 'd> {
    model: &'a Model<'d>,
    form: Brachistochronic<'d>,
    /// Parameter values by symbol, sorted.
    parameters: Vec<(Symbol, f64)>,
    coordinates: Vec<(Symbol, usize)>,
    rates: Vec<(Symbol, usize)>,
    mass: Evaluation<'a>,
    slope: Evaluation<'a>,
    /// For each guide the reaction caused by accelerations, and that caused by loads.
    guides: Vec<[Evaluation<'a>; 2]>,
    /// The factor of all friction coefficients.
    friction: f64,
}

/// The quantities of a guide at one position, in one number type.
struct Local<N> {
    along: Vec<N>,
    by_friction_forces: Vec<N>,
    friction: N,
    /// The parts of the reaction: columns of numbers, one after the other.
    parts: Vec<N>,
}

impl<'a, 'd> Landscape<'a, 'd> {
    /// The machine with these parameter values.
    pub fn new(model: &'a Model<'d>, form: Brachistochronic<'d>, parameters: &[f64]) -> Self {
        let known = model.parameters.iter().zip(parameters);
        let known = known.filter_map(|(p, value)| Some((p.symbol.as_symbol()?, *value)));
        let mut parameters: Vec<_> = known.collect();
        let numbered = |of: &dyn Fn(usize) -> Expr<'d>| {
            let symbols =
                (0..model.coordinates.len()).filter_map(|i| Some((of(i).as_symbol()?, i)));
            let mut symbols: Vec<_> = symbols.collect();
            symbols.sort_unstable_by_key(|(symbol, _)| *symbol);
            symbols
        };
        parameters.sort_unstable_by_key(|(symbol, _)| *symbol);
        let evaluation = |list: &[Expr<'d>]| Evaluation::new(model.dag, list);
        let guides = form.guides.iter().map(|guide| {
            [guide.weights.as_slice(), &[guide.load]].map(|reaction| {
                let mut list = guide.along.clone();
                list.extend(&guide.by_friction_forces);
                list.push(guide.friction);
                list.extend(reaction);
                evaluation(&list)
            })
        });
        Landscape {
            mass: evaluation(&form.mass.concat()),
            slope: evaluation(&form.slope),
            guides: guides.collect(),
            coordinates: numbered(&|i| model.coordinates[i].q),
            rates: numbered(&|i| model.coordinates[i].v),
            model,
            form,
            parameters,
            friction: 1.0,
        }
    }

    fn values<N: Scalar>(&self, expressions: &Evaluation<'_>, q: &[N], v: &[N]) -> Vec<N> {
        expressions.values(|symbol| {
            let place = |list: &[(Symbol, usize)]| {
                let found = list.binary_search_by_key(&symbol, |(symbol, _)| *symbol);
                found.ok().map(|found| list[found].1)
            };
            let moving = place(&self.coordinates).and_then(|i| q.get(i));
            let moving = moving.or_else(|| place(&self.rates).and_then(|i| v.get(i)));
            moving.copied().unwrap_or_else(|| {
                let known = &self.parameters;
                let found = known.binary_search_by_key(&symbol, |(symbol, _)| *symbol);
                N::from_f64(found.map_or(f64::NAN, |found| known[found].1))
            })
        })
    }

    /// The guides at a position, each with its reaction to accelerations or to loads.
    fn locals<N: Scalar>(&self, q: &[N], v: &[N], loads: bool) -> Vec<Local<N>> {
        let n = self.model.coordinates.len();
        let count = self.form.guides.len();
        let mut locals: Vec<Local<N>> = Vec::new();
        for [by_weights, by_loads] in &self.guides {
            let reaction = if loads { by_loads } else { by_weights };
            let mut values = self.values(reaction, q, v);
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

impl Terrain for Landscape<'_, '_> {
    fn coordinates(&self) -> usize {
        self.model.coordinates.len()
    }

    fn inertia<N: Scalar>(&self, q: &[N]) -> Vec<N> {
        let n = q.len();
        let mut inertia = self.values(&self.mass, q, &[]);
        for guide in self.locals(q, &[], false) {
            for (k, entry) in inertia.iter_mut().enumerate() {
                *entry = *entry + guide.friction * guide.along[k / n] * guide.parts[k % n];
            }
        }
        inertia
    }

    fn resistance<N: Scalar>(&self, q: &[N], v: &[N]) -> Vec<N> {
        let mut resistance = self.values(&self.slope, q, v);
        for guide in self.locals(q, v, true) {
            for (entry, along) in resistance.iter_mut().zip(&guide.along) {
                *entry = *entry + guide.friction * *along * guide.parts[0];
            }
        }
        resistance
    }

    fn mass(&self, q: &[f64]) -> Vec<f64> {
        self.values(&self.mass, q, &[])
    }

    fn with_friction(&self, share: f64) -> Option<Self> {
        let mut machine = self.clone();
        machine.friction *= share;
        (!self.form.guides.is_empty()).then_some(machine)
    }

    fn guides(&self) -> Vec<String> {
        let guides = self.form.guides.iter();
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
