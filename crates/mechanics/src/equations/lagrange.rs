//! Lagrange's equations of the second kind, term by term as a textbook writes them.
//!
//! ```text
//! d/dt ∂T/∂vᵢ − ∂T/∂qᵢ = −∂V/∂qᵢ − ∂D/∂vᵢ + Fᵢ
//! ```
//!
//! This derivation is the reference for everything else: [`Oracle`] takes no shortcut, and no code
//! is emitted from it unless an approximation asks for these very equations
//! ([`super::approximation`]). Explicit time is never dropped: the `d/dt` is that of eq. (E8).

use lagrangian_symbolic::{Expr, Symbol, Tangent, substitute};

use super::approximation::Approximations;
use super::constraints::{self, ConstraintEquation};
use super::energy;
use super::guide::{guide, guides_of, occurs_in_equation, relative, unit};
use super::kinematics::{self, Variables, gradient};
use super::projected::with_state;
use super::symmetric::Symmetric;
use lagrangian_spec::model::circles::rotation_angle;
use lagrangian_spec::model::element::Load;
use lagrangian_spec::model::{FrameOrBody, Model, Rotation, Space};

/// The literal Lagrange equations of a machine. Slow to derive and long; never emitted.
pub struct Oracle<'d> {
    /// `T`, eq. (E1).
    pub kinetic_energy: Expr<'d>,
    /// `V`, eq. (E2).
    pub potential_energy: Expr<'d>,
    /// `D`, eq. (E3).
    pub dissipation: Expr<'d>,
    /// `M`, eq. (E4).
    pub mass_matrix: Symmetric<Expr<'d>>,
    /// `h`, eq. (E5).
    pub bias: Vec<Expr<'d>>,
    /// `Q`, eq. (E6).
    pub applied: Vec<Expr<'d>>,
    /// The bilateral constraints.
    pub constraints: Vec<OracleConstraint<'d>>,
    /// The guided contacts with friction.
    pub sliding: Vec<OracleSliding<'d>>,
    /// `d/dt ∂T/∂v − ∂T/∂q − Q` with the accelerations in it, eq. (E7): zero along every motion.
    pub residual: Vec<Expr<'d>>,
}

/// A constraint; every derivative is taken by the chain rule, one variable at a time.
pub struct OracleConstraint<'d> {
    /// `g`; zero if only velocities are constrained.
    pub position: Expr<'d>,
    /// `φ = Σ vᵢ ∂g/∂qᵢ + ∂g/∂t`, or the given constraint of rates.
    pub rate: Expr<'d>,
    /// `∂φ/∂vᵢ`.
    pub row: Vec<Expr<'d>>,
    /// `Σ vᵢ ∂φ/∂qᵢ + Σ aᵢ ∂φ/∂vᵢ + ∂φ/∂t`: zero along every motion.
    pub residual: Expr<'d>,
}

/// A guided contact; every derivative is taken by the chain rule, one variable at a time.
pub struct OracleSliding<'d> {
    /// `w`.
    pub slip: Expr<'d>,
    /// `∂w/∂vᵢ`.
    pub row: Vec<Expr<'d>>,
    /// `Σ vᵢ ∂w/∂qᵢ + ∂w/∂t`.
    pub bias: Expr<'d>,
    /// `dw/dt` with the accelerations in it.
    pub slip_rate: Expr<'d>,
    /// In space the unit vector that determines the pressing part of the reaction: the normal of a surface, or the tangent of a curve.
    pub reference_direction: Vec<Expr<'d>>,
    /// For each component of the reaction the equation of the displacement that opens the guide in that direction.
    pub reactions: Vec<OracleReaction<'d>>,
    /// `μ` and `μ₀`.
    pub coefficients: [Expr<'d>; 2],
}

/// The equation of a displacement that opens a guide.
pub struct OracleReaction<'d> {
    /// The residual of inertia and applied forces.
    pub residual: Expr<'d>,
    /// The coefficients of the multipliers of the constraints along that displacement.
    pub by_multipliers: Vec<Expr<'d>>,
    /// The coefficients of the friction forces of the contacts.
    pub by_friction_forces: Vec<Expr<'d>>,
    /// The coefficients of the components of the normal reactions.
    pub by_normals: Vec<Expr<'d>>,
}

impl<'d> Oracle<'d> {
    /// Derives the equations, with every derivative where the textbook has it.
    ///
    /// The model must be accepted by [`super::Equations::derive`].
    pub fn derive(model: &Model<'d>) -> Oracle<'d> {
        let dag = model.dag;
        let x = Variables::of(model);
        let approximations = Approximations::of(model);
        let total = &mut x.total(model);

        let motions = kinematics::literal_motion(model, total);
        let bodies = model.bodies.iter().zip(&motions);
        let exact = bodies.map(|(b, u)| energy::kinetic_energy(b, &approximations.motion(u)));
        let kinetic_energy = approximations.energy(dag.sum(exact));
        let potential_energy = approximations.energy(energy::potential_energy(model));
        let dissipation = approximations.energy(energy::dissipation(model, total));
        let applied = applied(model, &x, potential_energy, dissipation);
        // The lengths of quaternions have inertia as bodies do, eq. (E74), but no energy of the machine.
        let lengths = model.quaternions.iter();
        let lengths = lengths.map(|four| four.inertia * total.of(four.log_length()).square() / 2);
        let resisting = dag.sum([kinetic_energy].into_iter().chain(lengths));
        let momenta: Vec<Expr<'d>> = x.v.iter().map(|&v_i| resisting.diff(v_i)).collect();
        let inertia = |momentum_rate: &mut Tangent<'d>, i: usize| {
            momentum_rate.of(momenta[i]) - resisting.diff(x.q[i])
        };
        let coasting = &mut x.without_acceleration(model);
        let along = |e: Expr<'d>| {
            let explicit = std::iter::once(e.diff(x.t));
            let moving = model.coordinates.iter().zip(&x.q);
            model
                .dag
                .sum(explicit.chain(moving.map(|(c, &q)| e.diff(q) * c.v)))
        };
        let constraint = |equation: ConstraintEquation<'d>| {
            let rate = equation.position.map_or(equation.rate, along);
            let row: Vec<Expr<'d>> = x.v.iter().map(|&v| rate.diff(v)).collect();
            let accelerating = model.coordinates.iter().zip(&row);
            let accelerating = accelerating.map(|(c, &slope)| slope * c.a);
            OracleConstraint {
                position: equation.position.unwrap_or(dag.zero()),
                residual: dag.sum(accelerating.chain([along(rate)])),
                row,
                rate,
            }
        };
        let constraints = constraints::constraints(model);
        Oracle {
            sliding: sliding(model),
            constraints: constraints.into_iter().map(constraint).collect(),
            mass_matrix: mass_matrix(model, &momenta, &x.v),
            bias: (0..x.q.len()).map(|i| inertia(coasting, i)).collect(),
            residual: (0..x.q.len())
                .map(|i| {
                    let residual = inertia(total, i) - applied[i];
                    match model.coordinates[i].rate {
                        Some(_) => residual + model.coordinates[i].a,
                        None => residual,
                    }
                })
                .collect(),
            kinetic_energy,
            potential_energy,
            dissipation,
            applied,
        }
    }
}

/// The guided contacts of a machine, by Lagrange's equations of the relaxed machine.
fn sliding<'d>(model: &Model<'d>) -> Vec<OracleSliding<'d>> {
    let Some(relaxed) = &model.relaxed else {
        return Vec::new();
    };
    let dag = model.dag;
    let (n, x) = (model.coordinates.len(), Variables::of(relaxed));
    let shut: Vec<_> = (n..x.q.len())
        .flat_map(|i| [x.q[i], x.v[i], x.a[i]])
        .map(|symbol| (symbol, dag.zero()))
        .collect();
    let closed = |e: Expr<'d>| substitute(dag, &[e], &shut)[0];
    let oracle = Oracle::derive(relaxed);
    let sliding = model.sliding();
    let guides: Vec<_> = sliding.iter().map(|s| guide(model, s)).collect();
    let numbers = guides_of(model);
    let pairs = || relaxed.sliding().into_iter().zip(&guides);
    let mut coasting = x.without_acceleration(relaxed);
    let rates: Vec<_> = pairs()
        .map(|(sliding, guide)| relative(relaxed, sliding, guide, &mut coasting))
        .collect();
    let contact = |k: usize| {
        let dimension = model.space.dimension();
        let along = |axis: &[Expr<'d>], column: &dyn Fn(usize) -> Expr<'d>| {
            let pairs = (n + dimension * numbers[k]..).zip(axis);
            closed(dag.sum(pairs.map(|(i, &normal)| normal * column(i))))
        };
        let reaction = |axis: &Vec<Expr<'d>>| OracleReaction {
            residual: along(axis, &|i| oracle.residual[i]),
            by_multipliers: oracle
                .constraints
                .iter()
                .map(|c| along(axis, &|i| c.row[i]))
                .collect(),
            by_friction_forces: rates
                .iter()
                .map(|rate| along(axis, &|i| rate.slip.diff(x.v[i])))
                .collect(),
            // The two contacts of a surface share one reaction, which counts once.
            by_normals: (rates.iter().enumerate())
                .flat_map(|(j, rate)| rate.normal_velocity.iter().map(move |off| (j, off)))
                .map(|(j, off)| {
                    if occurs_in_equation(&numbers, k, j) {
                        along(axis, &|i| off.diff(x.v[i]))
                    } else {
                        dag.zero()
                    }
                })
                .collect(),
        };
        let slip = closed(rates[k].slip);
        let row: Vec<Expr<'d>> = (0..n).map(|i| slip.diff(x.v[i])).collect();
        let moving = (0..n).map(|i| slip.diff(x.q[i]) * model.coordinates[i].v);
        let bias = dag.sum(moving.chain([slip.diff(x.t)]));
        let accelerating = row
            .iter()
            .zip(&model.coordinates)
            .map(|(&tau, c)| tau * c.a);
        let sliding = sliding[k];
        let telling = match (sliding.tangent, &sliding.normal) {
            (Some(_), Some(normal)) => unit(normal),
            _ => guides[k].along.clone(),
        };
        OracleSliding {
            reference_direction: telling,
            slip,
            slip_rate: dag.sum(accelerating.chain([bias])),
            bias,
            reactions: guides[k].axes.iter().map(reaction).collect(),
            coefficients: [
                sliding.friction,
                sliding.static_friction.unwrap_or(sliding.friction),
            ],
            row,
        }
    };
    (0..guides.len()).map(contact).collect()
}

/// Mass matrix, eq. (E4): `Mᵢⱼ = ∂²T/∂vᵢ∂vⱼ = ∂pᵢ/∂vⱼ`.
///
/// `T` is quadratic in `v`, so `M` is symmetric and free of `v`.
fn mass_matrix<'d>(model: &Model<'d>, momenta: &[Expr<'d>], v: &[Symbol]) -> Symmetric<Expr<'d>> {
    Symmetric::from_lower(v.len(), |i, j| {
        let entry = momenta[i].diff(v[j]);
        if i == j {
            with_state(model, i, entry)
        } else {
            entry
        }
    })
}

/// Applied generalized forces, eq. (E6): `Qᵢ = −∂V/∂qᵢ − ∂D/∂vᵢ + Fᵢ`, where `F` is the virtual
/// work of forces and torques: `Fᵢ = Σ F·∂x/∂qᵢ + Σ F ∂s/∂qᵢ + Σ M·∂ω/∂vᵢ`.
fn applied<'d>(
    model: &Model<'d>,
    x: &Variables<'d>,
    potential_energy: Expr<'d>,
    dissipation: Expr<'d>,
) -> Vec<Expr<'d>> {
    let force = |i: usize| {
        let rate = &mut x.partial(model, i);
        let mut terms = vec![-potential_energy.diff(x.q[i]), -dissipation.diff(x.v[i])];
        terms.extend(model.coordinates[i].rate);
        for four in &model.quaternions {
            let place = |e: Expr<'d>| model.coordinates.iter().find(|c| c.q == e);
            let rates = four.e.map(|e| place(e).map_or(model.dag.zero(), |c| c.v));
            terms.push(four.load(&rates) * four.log_length().diff(x.q[i]));
        }
        for load in model.loads() {
            match load {
                Load::Point { at, force } => {
                    terms.extend(at.iter().zip(force).map(|(&x, &f)| f * rate.of(x)));
                }
                Load::Coordinate { coordinate, value } if *coordinate == i => terms.push(*value),
                Load::Coordinate { .. } => {}
                Load::Along { measure, force, .. } => terms.push(*force * rate.of(*measure)),
                Load::Torque { on, torque } => terms.extend(power(model, *on, torque, rate)),
            }
        }
        model.dag.sum(terms)
    };
    (0..x.q.len()).map(force).collect()
}

/// The power of a torque on a body or frame that turns at the given rate, as terms of a sum.
fn power<'d>(
    model: &Model<'d>,
    on: FrameOrBody,
    torque: &[Expr<'d>],
    rate: &mut Tangent<'d>,
) -> Vec<Expr<'d>> {
    match (model.space, model.rotation(on)) {
        (Space::Plane, rotation) => {
            let angle = rotation_angle(model, rotation).into_iter();
            angle.map(|angle| torque[0] * rate.of(angle)).collect()
        }
        (Space::Space, Rotation::Frame(pose)) => {
            // The torque in the body's axes times the angular velocity in them.
            let turning = kinematics::angular_velocity_of_axes(model, pose, rate);
            let axes = model.poses[pose.index()].axes.iter();
            let along = |axis: &Vec<Expr<'d>>| {
                let terms = axis.iter().zip(torque).map(|(&e, &m)| e * m);
                model.dag.sum(terms)
            };
            axes.zip(turning)
                .map(|(axis, turning)| along(axis) * turning)
                .collect()
        }
        (Space::Space, _) => Vec::new(),
    }
}

/// `M` and `h` from any kinetic energy, eqs. (E4) and (E5), in as few sweeps as possible:
/// `p = ∂T/∂v` and `∂T/∂q` are one reverse sweep each, `M` one for each of its rows, and
/// `h = ṗ − ∂T/∂q` at `a = 0` one forward sweep. Nothing if they become too large.
pub(super) fn inertia<'d>(
    model: &Model<'d>,
    x: &Variables<'d>,
    kinetic_energy: Expr<'d>,
) -> Option<(Symmetric<Expr<'d>>, Vec<Expr<'d>>)> {
    let dag = model.dag;
    let momenta = gradient(dag, kinetic_energy, &x.v);
    let slopes = gradient(dag, kinetic_energy, &x.q);
    let mut rows: Vec<Vec<Expr<'d>>> = Vec::with_capacity(momenta.len());
    for (i, &momentum) in momenta.iter().enumerate() {
        if model.dag.is_exhausted() {
            return None;
        }
        rows.push(gradient(dag, momentum, &x.v[..=i]));
    }
    let rate = &mut x.without_acceleration(model);
    let bias = momenta
        .iter()
        .zip(slopes)
        .map(|(&p, slope)| rate.of(p) - slope)
        .collect();
    let entry = |i: usize, j: usize| {
        if i == j {
            with_state(model, i, rows[i][j])
        } else {
            rows[i][j]
        }
    };
    Some((Symmetric::from_lower(x.q.len(), entry), bias))
}
