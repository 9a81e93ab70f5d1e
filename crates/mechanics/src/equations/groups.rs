//! The equations of motion as groups of terms for an engineer to read: inertia, velocity terms, drive, gravity, springs,
//! dampers, and applied forces.
//!
//! Nothing new is derived: the groups of an equation add up to `(M a + h − Q)ᵢ`, as a test checks for every machine. They
//! are for reading only; programs are made from `M`, `h` and `f` themselves.

use lagrangian_symbolic::normal::{self, READABLE_BUDGET};
use lagrangian_symbolic::sorting::sort_by_key;
use lagrangian_symbolic::{Expr, Node, Symbol};

use super::approximation::Approximations;
use super::kinematics::Variables;
use super::projected::{Loads, Projection};
use super::{Equations, energy, kinematics};
use lagrangian_spec::identity;
use lagrangian_spec::model::Model;
use lagrangian_spec::model::element::{Contribution, Energy};

/// The largest number of terms of a velocity term that is multiplied out to find the rates in it.
const VELOCITY_TERMS: usize = 1000;

/// One contribution of one element: the energy that it stores, the dissipation, or the force that it applies.
#[derive(Clone, Debug)]
pub struct Share<'d> {
    /// The element, by its index in [`Model::elements`].
    pub element: usize,
    /// Its kind of term in an equation.
    pub kind: TermKind,
    /// Its share of the potential energy or of the dissipation function; a force has none.
    pub energy: Option<Expr<'d>>,
    /// Its share of the applied forces `Q`, one for each coordinate.
    pub forces: Vec<Expr<'d>>,
}

/// The applied forces by element: their sum is `Q`, eq. (E6).
pub fn force_shares<'d>(model: &Model<'d>) -> Vec<Share<'d>> {
    let x = Variables::of(model);
    let mut shares = energy_shares(model, &x);
    shares.extend(load_shares(model, &x));
    replace_zero_forces(model, &mut shares);
    shares
}

/// The shares of weights and springs, each energy by itself, `−∂V/∂q`, and those of dissipation functions, `−∂D/∂v`.
fn energy_shares<'d>(model: &Model<'d>, x: &Variables<'d>) -> Vec<Share<'d>> {
    let dag = model.dag;
    let approximations = Approximations::of(model);
    let mut shares = Vec::new();
    let elements = || model.elements.iter().enumerate();
    let share = |element, kind, value, by: &[Symbol]| {
        let value = approximations.energy(value);
        let slopes = kinematics::gradient(dag, value, by);
        Share {
            element,
            kind,
            energy: Some(value),
            forces: slopes.into_iter().map(|slope| -slope).collect(),
        }
    };
    for (index, element) in elements() {
        let mut all = element.contributions.iter();
        if all.any(|one| matches!(one, Contribution::Gravity(_))) {
            let weight = dag.sum(energy::weights(model));
            shares.push(share(index, TermKind::Gravity, weight, &x.q));
        }
    }
    for (index, element) in elements() {
        let all = element.contributions.iter();
        let stored: Vec<&Energy<'d>> = all.filter_map(Contribution::stored).collect();
        if !stored.is_empty() {
            let is_deformed = stored.iter().any(|e| matches!(e, Energy::Quadratic(_)));
            let kind = if is_deformed {
                TermKind::Springs
            } else {
                TermKind::Potentials
            };
            let value = dag.sum(stored.into_iter().map(energy::stored));
            shares.push(share(index, kind, value, &x.q));
        }
    }
    let rate = &mut x.without_acceleration(model);
    let mut dissipations = Vec::new();
    for (index, element) in elements() {
        let all = element.contributions.iter();
        let dissipated = all.filter_map(Contribution::dissipated);
        let values: Vec<_> = dissipated.map(|e| energy::dissipated(e, rate)).collect();
        if !values.is_empty() {
            dissipations.push((index, dag.sum(values)));
        }
    }
    for (index, value) in dissipations {
        shares.push(share(index, TermKind::Dissipation, value, &x.v));
    }
    shares
}

/// The shares of forces: their virtual work.
fn load_shares<'d>(model: &Model<'d>, x: &Variables<'d>) -> Vec<Share<'d>> {
    let projection = Projection::of(model, x);
    let mut shares = Vec::new();
    for (element, contribution) in model.elements.iter().enumerate() {
        let all = contribution.contributions.iter();
        let acting: Vec<_> = all.filter_map(Contribution::load).collect();
        if acting.is_empty() {
            continue;
        }
        let mut loads = Loads::default();
        projection.add_loads(acting.into_iter(), &mut loads);
        shares.push(Share {
            element,
            kind: TermKind::Applied,
            energy: None,
            forces: projection.project(&loads, 0..x.q.len()),
        });
    }
    shares
}

/// The forces on the lengths of quaternions, eq. (E75), one for each coordinate: a part of `Q` that comes from no element.
pub fn length_forces<'d>(model: &Model<'d>) -> Vec<Expr<'d>> {
    if model.quaternions.is_empty() {
        return vec![model.dag.zero(); model.coordinates.len()];
    }
    let x = Variables::of(model);
    let projection = Projection::of(model, &x);
    let mut loads = Loads::default();
    projection.add_lengths(&mut loads);
    projection.project(&loads, 0..x.q.len())
}

/// Replaces forces that are identically zero by 0.
fn replace_zero_forces<'d>(model: &Model<'d>, shares: &mut [Share<'d>]) {
    let forces = shares.iter().flat_map(|c| c.forces.iter().copied());
    let mut forces: Vec<Expr<'d>> = forces.collect();
    identity::remove_spurious_symbols(model.dag, &mut forces);
    let places = shares.iter_mut().flat_map(|c| c.forces.iter_mut());
    places.zip(forces).for_each(|(place, force)| *place = force);
}

/// The kind of the terms of a group.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum TermKind {
    /// The mass matrix times the accelerations.
    Inertia,
    /// Squares of rates.
    Centrifugal,
    /// Products of two rates.
    Coriolis,
    /// All of `h`, if it is too long to be split.
    Velocity,
    /// Contributions of explicit time to the inertia forces.
    Drive,
    /// Weights.
    Gravity,
    /// Springs.
    Springs,
    /// Given potentials.
    Potentials,
    /// Dampers and given dissipation functions.
    Dissipation,
    /// Applied forces and torques, including inputs: these stand on the right side.
    Applied,
}

/// Terms of one kind.
#[derive(Clone, Debug)]
pub struct Group<'d> {
    /// Their kind.
    pub kind: TermKind,
    /// The terms. Their sum stands on the left side of the equation, or on the right if they are [`TermKind::Applied`].
    pub terms: Vec<Term<'d>>,
}

/// `coefficient·factor`.
#[derive(Clone, Copy, Debug)]
pub struct Term<'d> {
    /// The coefficient of the factor, in readable form.
    pub coefficient: Expr<'d>,
    /// An acceleration, a product of rates, or 1.
    pub factor: Expr<'d>,
}

impl<'d> Term<'d> {
    /// The product.
    pub fn value(&self) -> Expr<'d> {
        self.coefficient * self.factor
    }
}

/// The equation of motion of coordinate `i` in groups, in the order of their kinds, without empty groups.
///
/// `shares` are those of the same model. On the left are `M a + h` and the forces of potentials and dampers, on the
/// right the applied forces.
pub fn equation<'d>(
    model: &Model<'d>,
    equations: &Equations<'d>,
    shares: &[Share<'d>],
    i: usize,
) -> Vec<Group<'d>> {
    let dag = model.dag;
    let mut groups: Vec<Group<'d>> = Vec::new();
    let mut add = |kind: TermKind, term: Term<'d>| {
        if term.coefficient.is_zero() {
            return;
        }
        match groups.iter_mut().find(|group| group.kind == kind) {
            Some(group) => group.terms.push(term),
            None => groups.push(Group {
                kind,
                terms: vec![term],
            }),
        }
    };
    for (j, coordinate) in model.coordinates.iter().enumerate() {
        let coefficient = compact(*equations.mass_matrix.get(i, j));
        add(
            TermKind::Inertia,
            Term {
                coefficient,
                factor: coordinate.a,
            },
        );
    }
    for (kind, term) in velocity_terms(model, equations.bias[i]) {
        add(kind, term);
    }
    let on_lengths = length_forces(model);
    for kind in [
        TermKind::Gravity,
        TermKind::Springs,
        TermKind::Potentials,
        TermKind::Dissipation,
        TermKind::Applied,
    ] {
        let of_kind = shares.iter().filter(|share| share.kind == kind);
        let sum = of_kind.map(|share| share.forces[i]);
        // The row of a state gives its rate.
        let rate = model.coordinates[i].rate;
        let others = rate.into_iter().chain([on_lengths[i]]);
        let sum = dag.sum(sum.chain(others.filter(|_| kind == TermKind::Applied)));
        let side = if kind == TermKind::Applied { sum } else { -sum };
        add(
            kind,
            Term {
                coefficient: readable(side),
                factor: dag.one(),
            },
        );
    }
    sort_by_key(&mut groups, |group| group.kind);
    groups
}

/// The bias, split by the rates in it. It is a quadratic polynomial in `v`; without explicit time it has only terms of
/// second degree, like `D²p`, eq. (E13).
fn velocity_terms<'d>(model: &Model<'d>, bias: Expr<'d>) -> Vec<(TermKind, Term<'d>)> {
    if bias.is_zero() {
        return Vec::new();
    }
    let dag = model.dag;
    let rates: Vec<Symbol> = model
        .coordinates
        .iter()
        .filter_map(|c| c.v.as_symbol())
        .collect();
    let Some(collected) = normal::collect(bias, &rates, VELOCITY_TERMS) else {
        let term = Term {
            coefficient: readable(bias),
            factor: dag.one(),
        };
        return vec![(TermKind::Velocity, term)];
    };
    let kind = |factor: Expr<'d>| match factor.node() {
        Node::Product(factors) => match &factors[..] {
            [(_, 2)] => TermKind::Centrifugal,
            _ => TermKind::Coriolis,
        },
        // A single rate, or none.
        _ => TermKind::Drive,
    };
    let terms = collected.into_iter();
    terms
        .map(|(factor, coefficient)| {
            let coefficient = compact(coefficient);
            (
                kind(factor),
                Term {
                    coefficient,
                    factor,
                },
            )
        })
        .collect()
}

/// A coefficient in readable form, with the common factors of its terms taken out.
pub fn compact(expression: Expr<'_>) -> Expr<'_> {
    normal::factored(readable(expression), READABLE_BUDGET)
}

fn readable(expression: Expr<'_>) -> Expr<'_> {
    normal::readable(expression, READABLE_BUDGET)
}
