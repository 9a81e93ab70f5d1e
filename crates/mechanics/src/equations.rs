//! Derives the [`Equations`] of motion of a [`Model`].
//!
//! ```text
//! M a = f = Q − h        M(q, t)   mass matrix
//!                        h(q, v, t)  bias: every velocity product and explicit-time term
//!                        Q(q, v, t, u)  applied generalized forces
//! ```
//!
//! There are two derivations. [`Oracle`] is Lagrange's equations of the second kind, term by term;
//! [`Equations::derive`] takes the cheaper route of [`projected`] wherever it holds, which is always except
//! under approximations. Tests prove that both are equal, at random points of a prime field, for every
//! machine of the library. Whatever is generated for any machine is also proved against [`literal`], the same
//! equations evaluated rather than expanded. The numbers (E1), (E2), … are those of `docs/equations.md`.
//!
//! Invariants: every expression is defined; `M` contains no `v`, `a` or inputs, `h` no `a` and no
//! inputs; `Q` and `f` contain no `a`; no contribution of explicit time is dropped.

mod approximation;
mod brachistochrone;
mod carrying;
mod composite;
mod constraints;
mod derivatives;
mod energy;
mod freedom;
pub mod groups;
pub(crate) mod guide;
mod guided;
pub mod integrals;
mod kinematics;
mod lagrange;
mod lengths;
pub(crate) mod literal;

mod power;
mod projected;
pub(crate) mod reduction;
pub(crate) mod refusal;
pub(crate) mod shorter;
mod sliding;
mod symmetric;
pub(crate) mod unilateral;

use lagrangian_symbolic::{Expr, Node, Symbol, normal};

pub use brachistochrone::{Brachistochronic, SlidingGuide, UnmetCondition};
pub use carrying::Carrying;
pub use constraints::{ConstraintEquation, constraints};
pub use freedom::{Freedom, Independent, contradictions, freedom};
pub use kinematics::angular_velocities;
pub use lagrange::{Oracle, OracleConstraint, OracleReaction, OracleSliding};
pub use reduction::{Dependent, ReducedModel, Reduction, dependents};
pub use refusal::MOST_COORDINATES;
pub use sliding::{MOST_CONTACTS, Reaction, SlidingEquation};
pub use symmetric::Symmetric;
pub use unilateral::{DirectionEquation, UnilateralEquation};

use approximation::Approximations;
use kinematics::Variables;
use lagrangian_spec::diagnostic::Report;
use lagrangian_spec::identity;
use lagrangian_spec::model::Model;
use projected::{Loads, Projection};

/// The largest number of terms of an entry of `M` or `h` that is multiplied out; longer ones have
/// never given the shorter program.
const EXPANDED_TERMS: usize = 200;

/// The largest number of coordinates of equations that are multiplied out: from four links of a
/// chain on the expanded equations do not give the shorter program, and the number of terms grows
/// with the cube of the number of coordinates.
const EXPANDED_COORDINATES: usize = 6;

/// The equations of motion of a machine, and everything else that is derived from its energies.
#[derive(Clone, Debug)]
pub struct Equations<'d> {
    /// Kinetic energy `T(q, v, t)`, eq. (E1).
    pub kinetic_energy: Expr<'d>,
    /// Potential energy `V(q, t)`, eq. (E2).
    pub potential_energy: Expr<'d>,
    /// Energy `E(s, q, t)` stored in first-order states, eq. (E59).
    pub state_energy: Expr<'d>,
    /// Rayleigh's dissipation function `D(q, v, t)`, eq. (E3).
    pub dissipation: Expr<'d>,
    /// Mass matrix `M(q, t)`, eq. (E4).
    pub mass_matrix: Symmetric<Expr<'d>>,
    /// Bias `h(q, v, t)`, eq. (E5).
    pub bias: Vec<Expr<'d>>,
    /// Applied generalized forces `Q(q, v, t, u)`, eq. (E6).
    pub applied: Vec<Expr<'d>>,
    /// `f = Q − h`, eq. (E7), in a form of its own that is shorter than the difference.
    pub forces: Vec<Expr<'d>>,
    /// The equations of motion before projection, where no coordinate is approximated.
    pub unprojected: Option<Unprojected<'d>>,
    /// The bilateral constraints. The accelerations obey them; `M`, `h`, `Q` and `f` do not contain them.
    pub constraints: Vec<ConstraintEquation<'d>>,
    /// The guided contacts with friction, which are not contained in `M`, `h`, `Q` and `f` either.
    pub sliding: Vec<SlidingEquation<'d>>,
    /// The unilateral contacts, which are contained in nothing else here. Behind these stand the guides, if there are both; then `sliding` is empty.
    pub unilateral: Vec<UnilateralEquation<'d>>,
    /// The normal reactions of the guides among the unilateral contacts, over the forces of all contacts, the friction of guides among them.
    pub guides: Vec<Reaction<'d>>,
    /// This machine without the coordinates that constraints determine, if there are any.
    pub reduction: Option<Box<Reduction<'d>>>,
    /// The residual of the equations of motion at given accelerations, `f − M a`, eq. (E25); with
    /// constraints `f − M a + Gᵀ λ`, followed by `γ − G a`. Empty if no derivative is asked for.
    pub residual: Vec<Expr<'d>>,
    /// For each variable of [`Model::derivatives`], the derivatives of `f − M a` with respect to it
    /// at given accelerations, one for each coordinate, followed by one for each constraint.
    pub residual_derivatives: Vec<Vec<Expr<'d>>>,
    /// Power of forces, torques, inputs and prescribed motion, eq. (E19). Accelerations may occur.
    pub work_rate: Expr<'d>,
    /// Power taken out by dissipation, eq. (E18).
    pub dissipation_rate: Expr<'d>,
    /// The values of [`Model::outputs`], in their order. Accelerations may occur.
    pub outputs: Vec<Expr<'d>>,
    /// Quantities of single bodies, in the order of [`Model::bodies`].
    pub bodies: Vec<BodyEquations<'d>>,
    /// How `M`, `h` and `f` were derived.
    pub route: Route,
}

/// Inertia and loads at the velocities that carry them, before projection onto the coordinates:
///
/// ```text
/// T = ½ Σ weight u w,    Σ (weight ẇ − load) ∂u/∂v = 0
/// ```
///
/// The velocities `u(q, v, t)` are nodes of one graph, in which the velocity of a body is built
/// from that of the body it hangs on. Solving on this graph instead of solving `M a = f` makes the
/// cost of a chain's accelerations linear in its length.
#[derive(Clone, Debug)]
pub struct Unprojected<'d> {
    /// Every pair of velocities with inertia.
    pub inertia: Vec<InertialPair<'d>>,
    /// Each `u` with the load on it.
    pub loads: Vec<(Expr<'d>, Expr<'d>)>,
    /// Whether velocities have accelerations when all coordinate accelerations are zero. If false,
    /// these accelerations are already among the loads, and `u̇` is `Σ aᵢ ∂u/∂vᵢ` alone.
    pub has_bias_accelerations: bool,
}

/// A term `½ weight u w` of the kinetic energy.
///
/// Two bodies may share a velocity `u` that is horizontal for one and vertical for the other, so the
/// acceleration of free fall belongs to the pair and not to `u`.
#[derive(Clone, Copy, Debug)]
pub struct InertialPair<'d> {
    /// `u`.
    pub u: Expr<'d>,
    /// `w`, often `u` again.
    pub w: Expr<'d>,
    /// The mass or moment of inertia; if `u` and `w` differ, twice the product of inertia.
    pub weight: Expr<'d>,
    /// The acceleration of free fall along `u`, for pairs `u u` whose weights are not among the
    /// loads: the load on `u` is this times `weight`.
    pub free_fall: Option<Expr<'d>>,
}

impl<'d> InertialPair<'d> {
    /// A pair without free fall: gravity does not act on it, or its weight is among the loads.
    pub(crate) fn without_gravity(u: Expr<'d>, w: Expr<'d>, weight: Expr<'d>) -> InertialPair<'d> {
        InertialPair {
            u,
            w,
            weight,
            free_fall: None,
        }
    }
}

/// What is derived for one body.
#[derive(Clone, Debug)]
pub struct BodyEquations<'d> {
    /// Its mass centre, in ground axes.
    pub position: Vec<Expr<'d>>,
    /// The velocity of its mass centre, in ground axes; exact, whatever is approximated.
    pub velocity: Vec<Expr<'d>>,
    /// Its kinetic energy.
    pub kinetic_energy: Expr<'d>,
}

/// How the equations were derived.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Route {
    /// By projecting accelerations: short, and equal to Lagrange's equations.
    Projected,
    /// By Lagrange's equations of an approximated kinetic energy.
    Lagrange,
}

impl<'d> Equations<'d> {
    /// Derives the equations of a machine. Returns nothing, and reports each reason, if it has none.
    pub fn derive(model: &Model<'d>, report: &mut Report) -> Option<Equations<'d>> {
        if refusal::refuse_unsupported(model, report)
            || refusal::refuse_unoriented(model, report)
            || refusal::refuse_many_coordinates(model, report)
            || refusal::refuse_many_constraints(model, report)
            || lengths::report_dependence_on_lengths(model, report)
        {
            return None;
        }
        // The bound holds for every machine; expressions that it leaves undefined are refused below.
        model.dag.set_limit(refusal::MOST_SIZE);
        let equations = Equations::within_bounds(model, report);
        model.dag.set_limit(usize::MAX);
        equations
    }

    /// Derives the equations while the size of the graph is bounded.
    fn within_bounds(model: &Model<'d>, report: &mut Report) -> Option<Equations<'d>> {
        let approximations = Approximations::of(model);
        let derived = if approximations.is_empty() {
            exact(model)
        } else {
            approximate(model, &approximations)
        };
        let Some(mut equations) = derived else {
            refusal::refuse_large(model, report);
            return None;
        };
        equations.remove_cancelling_variables(model);
        equations.add_power_of_constraints(model);
        if !model.derivatives.is_empty() {
            equations.residual = derivatives::constrained_residual(
                model,
                &equations.residual,
                &equations.constraints,
            );
        }
        let Some(slopes) = derivatives::residual_derivatives(model, &equations.residual) else {
            refusal::refuse_large(model, report);
            return None;
        };
        equations.residual_derivatives = slopes;
        if !model.dag.is_exhausted() {
            let relaxed = match &model.relaxed {
                Some(relaxed) => unilateral::unilateral(relaxed, report)?,
                None => Vec::new(),
            };
            let directions = relaxed.into_iter().flat_map(|contact| contact.directions);
            let rows: Vec<_> = directions.map(|direction| direction.row).collect();
            equations.sliding = sliding::sliding(model, &rows, report)?;
            equations.unilateral = unilateral::unilateral(model, report)?;
            guided::beside_contacts(model, &mut equations);
        }
        equations.reduction = reduction::reduction(model, &equations.constraints);
        if model.dag.is_exhausted() {
            refusal::refuse_large(model, report);
            return None;
        }
        let refused = refusal::refuse_undefined(model, &equations, report) || {
            let (matrix, constraints) = (&equations.mass_matrix, &equations.constraints);
            refusal::refuse_massless(model, matrix, constraints, report)
                || refusal::refuse_massless_contacts(model, matrix, report)
        };
        (!refused).then_some(equations)
    }

    /// These equations with `M` and `h` multiplied out; nothing if that takes too many terms.
    ///
    /// If only a few coordinates depend on each other, this is shorter, because terms that a
    /// projection computes along one axis and projects back onto it cancel. A double pendulum takes
    /// 29 multiplications and additions instead of 40; a chain of six links 377 instead of 339.
    /// Applied forces stay as they are: a spring's force must be computed from its stretch, or
    /// cancellation among the terms of the difference amplifies round-off.
    pub fn expanded(&self) -> Option<Equations<'d>> {
        if self.bias.len() > EXPANDED_COORDINATES {
            return None;
        }
        let mut expanded = self.clone();
        // Elimination along the machine would be the same; the other program contains it already.
        expanded.unprojected = None;
        expanded.reduction = None;
        // The bias goes first, since it is the part that exceeds the limit.
        let matrix = expanded.mass_matrix.lower_mut();
        for entry in expanded.bias.iter_mut().chain(matrix) {
            *entry = normal::expand(*entry, EXPANDED_TERMS)?.to_expr();
        }
        for ((force, &bias), &applied) in expanded
            .forces
            .iter_mut()
            .zip(&expanded.bias)
            .zip(&self.applied)
        {
            // Added term by term, so that the sum can be regrouped as a whole.
            *force = match bias.node() {
                Node::Sum(terms) => {
                    let dag = bias.dag();
                    let inertia = terms.iter().map(|(x, c)| dag.expr(*x) * -c.clone());
                    dag.sum([applied].into_iter().chain(inertia))
                }
                _ => applied - bias,
            };
        }
        Some(expanded)
    }

    /// The derivatives of `f − M a` in several forms: as they were derived and, for few
    /// coordinates, from `M` and `f` as they stand here, which may be shorter if these are
    /// multiplied out. Empty if none is asked for.
    pub(crate) fn residual_derivatives_in_forms(
        &self,
        model: &Model<'d>,
    ) -> Vec<Vec<Vec<Expr<'d>>>> {
        if self.residual_derivatives.is_empty() {
            return Vec::new();
        }
        let mut forms = vec![self.residual_derivatives.clone()];
        if self.bias.len() <= EXPANDED_COORDINATES {
            let unbalanced = derivatives::residual(model, &self.mass_matrix, &self.forces);
            let unbalanced =
                derivatives::constrained_residual(model, &unbalanced, &self.constraints);
            forms.extend(derivatives::residual_derivatives(model, &unbalanced));
        }
        forms
    }

    /// The generalized friction force on a coordinate if every contact slides along its direction and presses on the side of its
    /// normal, eqs. (E33) and (E34): `−Σ μ N τᵢ`, with accelerations in it. Normal reactions caused by constraints and by other
    /// friction forces are not included. On a surface a contact slides in any direction, and each tangent has its share.
    pub fn sliding_friction(&self, model: &Model<'d>, coordinate: usize) -> Expr<'d> {
        let friction = |(k, s): (usize, &SlidingEquation<'d>)| {
            let first = k - usize::from(s.is_second());
            let part = match s.surface {
                None => model.dag.one(),
                Some(_) => {
                    let slips = [first, first + 1].map(|k| self.sliding[k].slip.square());
                    s.slip / model.dag.sum(slips).sqrt()
                }
            };
            -(s.friction * s.pressing(model) * part * s.row[coordinate])
        };
        let all = self.sliding.iter().enumerate();
        model.dag.sum(all.map(friction))
    }

    /// Adds the power of rheonomic constraints, `v·Gᵀλ = v·(M a − f)`; the others do no work.
    fn add_power_of_constraints(&mut self, model: &Model<'d>) {
        let dag = model.dag;
        let moves = constraints::rates_at_rest(model, &self.constraints);
        if moves.iter().all(|rate| rate.is_zero()) {
            return;
        }
        let forces = derivatives::residual(model, &self.mass_matrix, &self.forces);
        // The row of a state is not a balance of forces, and no constraint contributes to it.
        let rows = model.coordinates.iter().zip(forces);
        let rows = rows.filter(|(coordinate, _)| coordinate.rate.is_none());
        let power = rows.map(|(coordinate, left)| -(coordinate.v * left));
        // The inertia and the load on the lengths of quaternions contribute no power.
        let mut total = Variables::of(model).total(model);
        let lengths = model.quaternions.iter().map(|four| {
            let rate = total.of(four.log_length());
            let load = four.load(&four.e.map(|e| total.of(e)));
            -(rate * (four.inertia * total.of(rate) - load))
        });
        let all = std::iter::once(self.work_rate).chain(power).chain(lengths);
        self.work_rate = dag.sum(all);
    }

    /// Removes coordinates and time from equations that do not depend on them, eqs. (E21) and (E22).
    fn remove_cancelling_variables(&mut self, model: &Model<'d>) {
        let x = Variables::of(model);
        let candidates: Vec<Symbol> = x.q.iter().copied().chain([x.t]).collect();
        let energies = [self.kinetic_energy, self.potential_energy, self.dissipation];
        let sources: Vec<Expr<'d>> = energies.into_iter().chain(self.applied.clone()).collect();
        let cyclic = identity::cyclic(model.dag, &sources, &candidates);
        let mut all: Vec<&mut Expr<'d>> = self.dynamics();
        let values: Vec<Expr<'d>> = all.iter().map(|e| **e).collect();
        let mut values = identity::with_zeros_for(model.dag, values, &cyclic);
        identity::remove_spurious_symbols(model.dag, &mut values);
        all.iter_mut()
            .zip(values)
            .for_each(|(place, value)| **place = value);
    }

    /// All expressions that follow from energies and forces alone.
    fn dynamics(&mut self) -> Vec<&mut Expr<'d>> {
        let lists = [
            &mut self.bias,
            &mut self.applied,
            &mut self.forces,
            &mut self.residual,
        ];
        let scalars = [
            &mut self.kinetic_energy,
            &mut self.potential_energy,
            &mut self.dissipation,
            &mut self.dissipation_rate,
        ];
        let vectors = lists.into_iter().flatten();
        self.mass_matrix
            .lower_mut()
            .iter_mut()
            .chain(vectors)
            .chain(scalars)
            .collect()
    }
}

/// Kinetic energy of all bodies, eq. (E1), in the axes of their frames, and in axes that do not spin with bodies of revolution.
pub(crate) fn kinetic_energies<'d>(model: &Model<'d>) -> [Expr<'d>; 2] {
    let x = Variables::of(model);
    let projection = Projection::of(model, &x);
    [
        projection.kinetic_energies(),
        projection.kinetic_energies_without_spin(),
    ]
    .map(|energies| model.dag.sum(energies))
}

/// The exact equations, by projection; nothing if they become too large.
fn exact<'d>(model: &Model<'d>) -> Option<Equations<'d>> {
    let dag = model.dag;
    let x = Variables::of(model);
    let projection = Projection::of(model, &x);
    let all = 0..x.q.len();

    let kinetic_energies = projection.kinetic_energies();
    let potential_energy = energy::potential_energy(model);
    let dissipation = energy::dissipation(model, &mut x.without_acceleration(model));

    let mut weightless = Loads::default();
    projection.add_applied(&mut weightless);
    let mut applied = Loads::default();
    projection.add_gravity(&mut applied);
    projection.add_applied(&mut applied);
    // Reversed inertia forces together with gravity, so that one sweep collects all loads.
    let mut forces = projection.bias_loads(-1, true);
    projection.add_applied(&mut forces);

    Some(Equations {
        kinetic_energy: dag.sum(kinetic_energies.iter().copied()),
        potential_energy,
        state_energy: dag.sum(model.energies_of_states()),
        dissipation,
        mass_matrix: projection.mass_matrix()?,
        bias: projection.project(&projection.bias_loads(1, false), all.clone()),
        applied: projection.project(&applied, all.clone()),
        unprojected: Some(projection.unprojected(&weightless, &forces)),
        constraints: constraints::constraints(model),
        sliding: Vec::new(),
        unilateral: Vec::new(),
        guides: Vec::new(),
        reduction: None,
        forces: projection.project(&forces, all),
        residual: if model.derivatives.is_empty() {
            Vec::new()
        } else {
            projection.residual()
        },
        residual_derivatives: Vec::new(),
        work_rate: power::work_rate(model, &x, &projection, potential_energy),
        dissipation_rate: power::dissipation_rate(model, &x, dissipation),
        outputs: model.outputs.iter().map(|output| output.value).collect(),
        bodies: bodies(model, &x, kinetic_energies),
        route: Route::Projected,
    })
}

/// The equations of approximated energies, by Lagrange's equations; nothing if they become too large.
fn approximate<'d>(
    model: &Model<'d>,
    approximations: &Approximations<'d>,
) -> Option<Equations<'d>> {
    let dag = model.dag;
    let x = Variables::of(model);
    let projection = Projection::of(model, &x);

    let frozen = |mut rate| {
        let motions = kinematics::literal_motion(model, &mut rate);
        motions
            .iter()
            .map(|motion| approximations.motion(motion))
            .collect::<Vec<_>>()
    };
    let motions = frozen(x.without_acceleration(model));
    let driving = frozen(x.explicit_time(model));
    let pairs = model.bodies.iter().zip(&motions);
    let kinetic_energies = pairs
        .clone()
        .map(|(body, u)| energy::kinetic_energy(body, u));
    let kinetic_energies = approximations.energies(&kinetic_energies.collect::<Vec<_>>());
    let driven = pairs
        .zip(&driving)
        .map(|((body, u), u_0)| energy::kinetic_form(body, u, u_0));

    let kinetic_energy = dag.sum(kinetic_energies.iter().copied());
    let potential_energy = approximations.energy(energy::potential_energy(model));
    let dissipation = energy::dissipation(model, &mut x.without_acceleration(model));
    let dissipation = approximations.energy(dissipation);
    let driven = approximations.energy(dag.sum(driven));

    let (mass_matrix, bias) = lagrange::inertia(model, &x, kinetic_energy)?;
    let mut loads = Loads::of_energies(dag, potential_energy, dissipation);
    projection.add_forces(&mut loads);
    projection.add_state_rates(&mut loads);
    let applied = projection.project(&loads, 0..x.q.len());
    let forces: Vec<Expr<'d>> = applied
        .iter()
        .zip(&bias)
        .map(|(&applied, &bias)| applied - bias)
        .collect();
    let unbalanced = if model.derivatives.is_empty() {
        Vec::new()
    } else {
        derivatives::residual(model, &mass_matrix, &forces)
    };
    Some(Equations {
        kinetic_energy,
        potential_energy,
        state_energy: dag.sum(model.energies_of_states()),
        dissipation,
        mass_matrix,
        forces,
        bias,
        applied,
        unprojected: None,
        constraints: constraints::constraints(model),
        sliding: Vec::new(),
        unilateral: Vec::new(),
        guides: Vec::new(),
        reduction: None,
        residual: unbalanced,
        residual_derivatives: Vec::new(),
        work_rate: power::work_rate_of_energies(
            model,
            &x,
            &projection,
            [kinetic_energy, potential_energy, driven],
        ),
        dissipation_rate: power::dissipation_rate(model, &x, dissipation),
        outputs: model.outputs.iter().map(|output| output.value).collect(),
        bodies: bodies(model, &x, kinetic_energies),
        route: Route::Lagrange,
    })
}

/// Positions and velocities of the bodies, and their shares of the kinetic energy.
fn bodies<'d>(
    model: &Model<'d>,
    x: &Variables<'d>,
    kinetic_energies: Vec<Expr<'d>>,
) -> Vec<BodyEquations<'d>> {
    let mut rate = x.without_acceleration(model);
    let of_body =
        |(body, kinetic_energy): (&lagrangian_spec::model::Body<'d>, Expr<'d>)| BodyEquations {
            position: body.at.clone(),
            velocity: body.at.iter().map(|&x| rate.of(x)).collect(),
            kinetic_energy,
        };
    model
        .bodies
        .iter()
        .zip(kinetic_energies)
        .map(of_body)
        .collect()
}
