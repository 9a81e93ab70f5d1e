//! The equations of motion in groups, as an engineer reads them: inertia, velocity terms, drive, gravity, springs, dampers,
//! and what is applied.
//!
//! Nothing new is derived: the groups of an equation add up to `(M a + h − Q)ᵢ`, and a test says so for every machine. They
//! are for reading; programs are made from `M`, `h` and `f` themselves.

use lagrangian_symbolic::normal::{self, READABLE_BUDGET};
use lagrangian_symbolic::{Expr, Node, Symbol};

use super::approximation::Approximations;
use super::kinematics::Variables;
use super::projected::{Loads, Projection};
use super::{Equations, energy, lagrange};
use lagrangian_spec::identity;
use lagrangian_spec::model::Model;

/// The most terms of a velocity term multiplied out, to see by which rates it goes.
const VELOCITY_TERMS: usize = 1000;

/// What makes an applied force, by its index in the list of the model.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Source {
    /// The weight of all bodies.
    Gravity,
    /// A spring or torsion spring.
    Spring(usize),
    /// A given potential.
    Potential(usize),
    /// A damper.
    Damper(usize),
    /// A given dissipation function.
    Dissipation(usize),
    /// An applied or generalized force.
    Force(usize),
    /// An applied torque.
    Torque(usize),
}

/// What one source contributes.
#[derive(Clone, Debug)]
pub struct Contribution<'d> {
    /// What it comes from.
    pub source: Source,
    /// Its share of the potential energy or of the dissipation function; a force has none.
    pub energy: Option<Expr<'d>>,
    /// Its share of the applied forces `Q`, one for each coordinate.
    pub forces: Vec<Expr<'d>>,
}

/// The applied forces by their sources: their sum is `Q`, eq. (E6).
pub fn contributions<'d>(model: &Model<'d>) -> Vec<Contribution<'d>> {
    let dag = model.dag;
    let x = Variables::of(model);
    let approximations = Approximations::of(model);
    let mut contributions = Vec::new();

    // Energies, each as if it were the only one: −∂V/∂q.
    let mut alone = model.clone();
    (alone.springs, alone.potentials) = (Vec::new(), Vec::new());
    let weight = model
        .gravity
        .as_ref()
        .map(|_| energy::potential_energy(&alone));
    let springs = model.springs.iter().enumerate();
    let springs = springs.map(|(k, s)| (Source::Spring(k), s.coefficient * s.stretch.square() / 2));
    let potentials = model.potentials.iter().enumerate();
    let potentials = potentials.map(|(k, potential)| (Source::Potential(k), potential.value));
    let weight = weight.map(|weight| (Source::Gravity, weight));
    for (source, value) in weight.into_iter().chain(springs).chain(potentials) {
        let value = approximations.energy(value);
        let slopes = lagrange::gradient(dag, value, &x.q);
        contributions.push(Contribution {
            source,
            energy: Some(value),
            forces: slopes.into_iter().map(|slope| -slope).collect(),
        });
    }

    // Dissipation functions: −∂D/∂v.
    let rate = &mut x.coasting(model);
    let mut dissipations = Vec::new();
    for (k, damper) in model.dampers.iter().enumerate() {
        let value = damper.coefficient * rate.of(damper.stretch).square() / 2;
        dissipations.push((Source::Damper(k), value));
    }
    let given = model.dissipations.iter().enumerate();
    dissipations.extend(given.map(|(k, term)| (Source::Dissipation(k), term.value)));
    for (source, value) in dissipations {
        let value = approximations.energy(value);
        let slopes = lagrange::gradient(dag, value, &x.v);
        contributions.push(Contribution {
            source,
            energy: Some(value),
            forces: slopes.into_iter().map(|slope| -slope).collect(),
        });
    }

    // Forces: their virtual work.
    let projection = Projection::of(model, &x);
    let mut add = |source: Source, loads: Loads<'d>| {
        contributions.push(Contribution {
            source,
            energy: None,
            forces: projection.project(&loads, 0..x.q.len()),
        });
    };
    for (k, force) in model.forces.iter().enumerate() {
        let mut loads = Loads::default();
        loads.on_force(force);
        add(Source::Force(k), loads);
    }
    for (k, torque) in model.torques.iter().enumerate() {
        let mut loads = Loads::default();
        projection.add_torques(std::slice::from_ref(torque), &mut loads);
        add(Source::Torque(k), loads);
    }
    settle(model, &mut contributions);
    contributions
}

/// What is zero becomes 0.
fn settle<'d>(model: &Model<'d>, contributions: &mut [Contribution<'d>]) {
    let forces = contributions.iter().flat_map(|c| c.forces.iter().copied());
    let mut forces: Vec<Expr<'d>> = forces.collect();
    identity::settle(model.dag, &mut forces);
    let places = contributions.iter_mut().flat_map(|c| c.forces.iter_mut());
    places.zip(forces).for_each(|(place, force)| *place = force);
}

/// What the terms of a group have in common.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Kind {
    /// The mass matrix times the accelerations.
    Inertia,
    /// Squares of rates.
    Centrifugal,
    /// Products of two rates.
    Coriolis,
    /// All of `h` where it is too long to be taken apart.
    Velocity,
    /// What explicit time contributes to the inertia.
    Drive,
    /// Weights.
    Gravity,
    /// Springs.
    Springs,
    /// Given potentials.
    Potentials,
    /// Dampers and given dissipation functions.
    Dissipation,
    /// Applied forces and torques, inputs among them: these stand on the right side.
    Applied,
}

/// Terms of one kind.
#[derive(Clone, Debug)]
pub struct Group<'d> {
    /// What they have in common.
    pub kind: Kind,
    /// The terms. Their sum stands on the left side of the equation, or on the right if they are [`Kind::Applied`].
    pub terms: Vec<Term<'d>>,
}

/// `coefficient·factor`.
#[derive(Clone, Copy, Debug)]
pub struct Term<'d> {
    /// What stands before the factor, in a form to be read.
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

/// The equation of motion of coordinate `i` in groups, in the order of their kinds; empty groups are left out.
///
/// `contributions` are those of the same model. On the left `M a + h` and what potentials and dampers do, on the right what
/// is applied.
pub fn equation<'d>(
    model: &Model<'d>,
    equations: &Equations<'d>,
    contributions: &[Contribution<'d>],
    i: usize,
) -> Vec<Group<'d>> {
    let dag = model.dag;
    let mut groups: Vec<Group<'d>> = Vec::new();
    let mut add = |kind: Kind, term: Term<'d>| {
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
            Kind::Inertia,
            Term {
                coefficient,
                factor: coordinate.a,
            },
        );
    }
    for (kind, term) in velocity_terms(model, equations.bias[i]) {
        add(kind, term);
    }
    for kind in [
        Kind::Gravity,
        Kind::Springs,
        Kind::Potentials,
        Kind::Dissipation,
        Kind::Applied,
    ] {
        let of_kind = contributions.iter().filter(|c| kind_of(c.source) == kind);
        let sum = dag.sum(of_kind.map(|contribution| contribution.forces[i]));
        let side = if kind == Kind::Applied { sum } else { -sum };
        add(
            kind,
            Term {
                coefficient: readable(side),
                factor: dag.one(),
            },
        );
    }
    groups.sort_by_key(|group| group.kind);
    groups
}

fn kind_of(source: Source) -> Kind {
    match source {
        Source::Gravity => Kind::Gravity,
        Source::Spring(_) => Kind::Springs,
        Source::Potential(_) => Kind::Potentials,
        Source::Damper(_) | Source::Dissipation(_) => Kind::Dissipation,
        Source::Force(_) | Source::Torque(_) => Kind::Applied,
    }
}

/// The bias by the rates in it. It is a polynomial of second degree in `v`; without explicit time it has no terms of a lower
/// one, since `D²p` has none, eq. (E13).
fn velocity_terms<'d>(model: &Model<'d>, bias: Expr<'d>) -> Vec<(Kind, Term<'d>)> {
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
        return vec![(Kind::Velocity, term)];
    };
    let kind = |factor: Expr<'d>| match factor.node() {
        Node::Product(factors) => match &factors[..] {
            [(_, 2)] => Kind::Centrifugal,
            _ => Kind::Coriolis,
        },
        // A rate alone, or none.
        _ => Kind::Drive,
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

/// A coefficient in a form to be read, what its terms have in common before them.
pub fn compact(expression: Expr<'_>) -> Expr<'_> {
    normal::factored(readable(expression), READABLE_BUDGET)
}

fn readable(expression: Expr<'_>) -> Expr<'_> {
    normal::readable(expression, READABLE_BUDGET)
}
