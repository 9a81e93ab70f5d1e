//! Conserved quantities of a machine, and variables that do not occur in its equations: facts that are
//! tested, not assumed.
//!
//! Each is decided in the prime field, see [`lagrangian_spec::identity`]. What cannot be decided is not reported.

use lagrangian_symbolic::Expr;

use super::kinematics::Variables;
use super::{Equations, constraints, kinematics};
use lagrangian_spec::identity;
use lagrangian_spec::model::{Model, stage};

/// Facts about the equations of a machine.
#[derive(Clone, Debug)]
pub struct EquationProperties<'d> {
    /// Coordinates on which neither kinetic nor potential energy depends.
    pub cyclic: Vec<Cyclic<'d>>,
    /// The balance of energy.
    pub energy: EnergyBalance<'d>,
    /// Whether neither an energy, nor the dissipation, nor an applied force depends on explicit time.
    pub autonomous: bool,
    /// Whether the mass matrix depends on nothing but parameters.
    pub constant_mass_matrix: bool,
    /// Coordinates whose accelerations are coupled, directly or through others: the diagonal blocks of the mass matrix.
    pub blocks: Vec<Vec<usize>>,
}

/// A coordinate on which neither kinetic nor potential energy depends, also called ignorable.
#[derive(Clone, Debug)]
pub struct Cyclic<'d> {
    /// The index of the coordinate.
    pub coordinate: usize,
    /// Its momentum `∂T/∂v`.
    pub momentum: Expr<'d>,
    /// The generalized force on it, including reactions of constraints. It alone changes the
    /// momentum, which is conserved if it is 0.
    pub force: Expr<'d>,
}

/// The balance of energy along every motion.
#[derive(Clone, Debug)]
pub enum EnergyBalance<'d> {
    /// `T + V`, with the energy stored in first-order states, is conserved.
    Conserved,
    /// `Σ vᵢ ∂T/∂vᵢ − T + V`, Jacobi's integral, is conserved, but `T + V` is not: something is driven in a way that
    /// does not bring explicit time into the energies.
    Jacobi(Expr<'d>),
    /// `d(T + V)/dt = P − R`, eq. (E20).
    Balance,
}

impl<'d> EquationProperties<'d> {
    /// The facts about a machine.
    pub fn of(model: &Model<'d>, equations: &Equations<'d>) -> EquationProperties<'d> {
        EquationProperties {
            cyclic: cyclic(model, equations),
            energy: energy(model, equations),
            autonomous: is_autonomous(model, equations),
            constant_mass_matrix: equations
                .mass_matrix
                .lower()
                .iter()
                .all(|entry| entry.stage() <= stage::PARAMETER),
            blocks: blocks(model, equations),
        }
    }
}

/// By Lagrange's equations `dpᵢ/dt = ∂T/∂qᵢ + Qᵢ`: if `∂T/∂qᵢ = ∂V/∂qᵢ = 0`, the momentum is changed by `Qᵢ` alone, and
/// is conserved if `Qᵢ = 0`. H. Goldstein, C. Poole, J. Safko, *Classical Mechanics*, 3rd ed. 2002, §2.6.
fn cyclic<'d>(model: &Model<'d>, equations: &Equations<'d>) -> Vec<Cyclic<'d>> {
    let dag = model.dag;
    let x = Variables::of(model);
    let slopes = |of| kinematics::gradient(dag, of, &x.q);
    let kinetic = slopes(equations.kinetic_energy);
    let potential = slopes(equations.potential_energy);
    let momenta = kinematics::gradient(dag, equations.kinetic_energy, &x.v);
    // For the integral of a state the fact is trivial.
    let places = (0..x.q.len()).filter(|&i| model.coordinates[i].rate.is_none());
    let ignorable = places.filter(|&i| is_zero(kinetic[i]) && is_zero(potential[i]));
    let cyclic = |coordinate: usize| {
        let reactions = equations.constraints.iter();
        let reactions = reactions.map(|c| c.row[coordinate] * c.multiplier);
        let force = dag.sum([equations.applied[coordinate]].into_iter().chain(reactions));
        Cyclic {
            coordinate,
            momentum: momenta[coordinate],
            force: if is_zero(force) { dag.zero() } else { force },
        }
    };
    ignorable.map(cyclic).collect()
}

/// `d/dt (Σ vᵢ ∂T/∂vᵢ − T + V) = Σ vᵢ Fᵢ − ∂T/∂t + ∂V/∂t`, where F are the forces that come neither from V nor from
/// inertia; by (E20) `d(T + V)/dt = P − R`. Goldstein, §2.7.
fn energy<'d>(model: &Model<'d>, equations: &Equations<'d>) -> EnergyBalance<'d> {
    let dag = model.dag;
    let x = Variables::of(model);
    if is_zero(equations.work_rate) && is_zero(equations.dissipation_rate) {
        return EnergyBalance::Conserved;
    }
    if model.energies_of_states().next().is_some() || model.losses().next().is_some() {
        return EnergyBalance::Balance;
    }
    // A rheonomic constraint does work that no potential accounts for.
    let still = constraints::rates_at_rest(model, &equations.constraints);
    if !still.into_iter().all(is_zero) {
        return EnergyBalance::Balance;
    }
    let (kinetic, potential) = (equations.kinetic_energy, equations.potential_energy);
    let momenta = kinematics::gradient(dag, kinetic, &x.v);
    let slopes = kinematics::gradient(dag, potential, &x.q);
    let rates = model.coordinates.iter().map(|c| c.v);
    let others = equations
        .applied
        .iter()
        .zip(slopes)
        .map(|(&q, slope)| q + slope);
    let is_state = model.coordinates.iter().map(|c| c.rate.is_some());
    let power = rates.clone().zip(others).zip(is_state);
    let power = power.filter(|(_, is_state)| !is_state);
    let power = power.map(|((v, force), _)| v * force);
    let mut explicit = x.explicit_time(model);
    let change = [-explicit.of(kinetic), explicit.of(potential)];
    if !is_zero(dag.sum(power.chain(change))) {
        return EnergyBalance::Balance;
    }
    let products = rates.zip(momenta).map(|(v, momentum)| v * momentum);
    let integral = dag.sum(products.chain([-kinetic, potential]));
    match identity::equal(integral, kinetic + potential) {
        Some(true) => EnergyBalance::Conserved,
        _ => EnergyBalance::Jacobi(integral),
    }
}

fn is_autonomous(model: &Model<'_>, equations: &Equations<'_>) -> bool {
    let mut explicit = Variables::of(model).explicit_time(model);
    let energies = [
        equations.kinetic_energy,
        equations.potential_energy,
        equations.dissipation,
    ];
    let mut sources = energies
        .into_iter()
        .chain(equations.applied.iter().copied());
    sources.all(|source| is_zero(explicit.of(source)))
}

/// Coordinates that are connected by entries of the mass matrix; each list and the list of lists are in ascending order.
fn blocks(model: &Model<'_>, equations: &Equations<'_>) -> Vec<Vec<usize>> {
    let n = equations.mass_matrix.dimension();
    let mut block: Vec<usize> = (0..n).collect();
    for (i, j, entry) in equations.mass_matrix.entries() {
        if !entry.is_zero() && block[i] != block[j] {
            let (from, to) = (block[i].max(block[j]), block[i].min(block[j]));
            block
                .iter_mut()
                .filter(|b| **b == from)
                .for_each(|b| *b = to);
        }
    }
    let places = || (0..n).filter(|&i| model.coordinates[i].rate.is_none());
    let members = |b: usize| places().filter(|&i| block[i] == b).collect::<Vec<_>>();
    (0..n)
        .map(members)
        .filter(|members| !members.is_empty())
        .collect()
}

/// Whether an expression is certainly 0.
fn is_zero(expression: Expr<'_>) -> bool {
    identity::is_zero(expression) == Some(true)
}
