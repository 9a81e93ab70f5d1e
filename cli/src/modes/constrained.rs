//! Where a machine with constraints stays, and how it moves about that place.
//!
//! At rest it may move along the directions `N` with `G N = 0`, and the reactions `Gᵀλ` do nothing along
//! them: it stays where `Nᵀ f = 0`. A step along `N z` changes `f + Gᵀλ`, λ held, by `K N z` with
//! `K = ∂f/∂q + Σ λₖ ∂Gₖ/∂q`, since the directions turn as the constraints bend. With `Nᵀ M N = 1` the
//! motion near that place is
//!
//! ```text
//! z̈ = Nᵀ K N z + Nᵀ (∂f/∂v) N ż
//! ```
//!
//! (J. Nocedal and S. J. Wright, *Numerical Optimization*, 2nd ed. 2006, section 18.1, for Newton's method
//! along the directions that constraints leave.) After each step the pose is brought back onto the
//! constraints by the least move. Redundant constraints change neither `N` nor what comes of λ.

use lagrangian::interpreted::{InterpretedMachine, InterpretedSystem, Named};
use lagrangian::{Error, Machine, Simulation, System, least_multipliers};
use lagrangian_scalar::Dual;
use lagrangian_spec::program::{Arguments, Interpreter, Role};
use nalgebra::{Complex, DMatrix, DVector};

use super::equilibrium::{
    BALANCED, Derived, Equilibrium, LONGEST_STEP, Lost, MOST_HALVINGS, MOST_STEPS, TOLERANCE,
    constants, largest_share, moved,
};
use super::rank::{self, Direction};
use super::spectrum::{self, Modes};

/// A row of G holds nothing that others do not hold if less than this is left of it beside them.
const INDEPENDENT: f64 = 1e-8;

/// The equilibrium that Newton's method reaches from a pose, and the modes there.
///
/// # Errors
/// If there is none on its way; nothing instead of modes where their iterations do not end.
pub fn find(
    machine: &InterpretedMachine,
    system: &InterpretedSystem,
    q: &[f64],
    u: &Named,
) -> Result<(Equilibrium, Option<Modes>), Lost> {
    let parameters = constants(machine.parameter_values());
    let mut search = Search {
        interpreter: Interpreter::new(machine.program(), &parameters),
        machine,
        system,
        u,
    };
    let mut here = search.at(q)?;
    for steps in 0..MOST_STEPS {
        let step = here.step();
        let longest = largest_share(&step, &here.q);
        if longest <= TOLERANCE {
            if let Ok(there) = search.at(&moved(&here.q, &step, 1.0))
                && there.forces.norm() < here.forces.norm()
            {
                here = there;
            }
            return settled(here, steps);
        }
        let mut share = (LONGEST_STEP / longest).min(1.0);
        let mut next = None;
        for _ in 0..MOST_HALVINGS {
            // A pose that cannot be on the constraints is one step too far.
            if let Ok(there) = search.at(&moved(&here.q, &step, share))
                && there.forces.norm() <= (1.0 - share / 4.0) * here.forces.norm()
            {
                next = Some(there);
                break;
            }
            share /= 2.0;
        }
        match next {
            Some(next) => here = next,
            None => return settled(here, steps),
        }
    }
    Err(Lost::NoEnd(MOST_STEPS))
}

/// The end of the way, if nothing is left of the forces there.
fn settled(here: Pose, steps: usize) -> Result<(Equilibrium, Option<Modes>), Lost> {
    if !here.is_balanced() {
        let accelerations = &here.directions * &here.forces;
        let index = accelerations.icamax();
        return Err(Lost::Accelerates(index, accelerations[index]));
    }
    let free = here.parts.iter().filter(|d| d.is_free()).count();
    let modes = spectrum::modes(&here.stiffness, &here.damping).map(|mut modes| {
        for mode in &mut modes.modes {
            mode.shape = in_coordinates(&here.directions, &mode.shape);
        }
        modes
    });
    let found = Equilibrium {
        q: here.q,
        by_coordinates: here.stiffness,
        by_rates: here.damping,
        steps,
        free: free + here.held_in_rates,
    };
    Ok((found, modes))
}

/// A shape along directions as one in coordinates, the largest number 1.
fn in_coordinates(directions: &DMatrix<f64>, shape: &[Complex<f64>]) -> Vec<Complex<f64>> {
    let along = DVector::from_column_slice(shape);
    let shape = directions.map(|x| Complex::new(x, 0.0)) * along;
    let largest = shape.iter().map(|x| x.norm()).fold(0.0, f64::max);
    let first = shape
        .iter()
        .find(|x| x.norm() >= (1.0 - 1e-9) * largest && largest > 0.0);
    let unit = first.copied().unwrap_or(Complex::new(1.0, 0.0));
    // What is nothing but rounding, beside 1.
    let settle = |x: f64| if x.abs() <= 1e-12 { 0.0 } else { x };
    let scaled = shape.iter().map(|x| x / unit);
    scaled
        .map(|x| Complex::new(settle(x.re), settle(x.im)))
        .collect()
}

/// What poses are looked at with.
struct Search<'a> {
    machine: &'a InterpretedMachine,
    system: &'a InterpretedSystem,
    interpreter: Interpreter<Dual<f64>>,
    u: &'a Named,
}

/// A pose on the constraints, at rest.
struct Pose {
    q: Vec<f64>,
    /// `N`, with `Nᵀ M N = 1`.
    directions: DMatrix<f64>,
    /// `Nᵀ f`.
    forces: DVector<f64>,
    /// What the terms of each of these come to.
    sizes: DVector<f64>,
    /// What rounding may leave of all forces together, where the terms of one come to nothing.
    rounding: f64,
    /// `Nᵀ K N`, and its singular values.
    stiffness: DMatrix<f64>,
    parts: Vec<Direction>,
    /// `Nᵀ (∂f/∂v) N`.
    damping: DMatrix<f64>,
    /// In how many directions the constraints hold rates only.
    held_in_rates: usize,
}

impl Search<'_> {
    fn at(&mut self, q: &[f64]) -> Result<Pose, Lost> {
        let q = self.brought(q)?;
        let n = q.len();
        let (v, system) = (vec![0.0; n], self.system);
        let constraints: Vec<bool> = system.constraints().map(|c| c.holonomic).collect();
        let m = constraints.len();
        let (mut a, mut multipliers) = (vec![0.0; n], vec![0.0; m]);
        least_multipliers(system, 0.0, &q, &v, self.u, &mut a, &mut multipliers)
            .map_err(|error| Lost::Constraints(Error::of_step(error, system).to_string()))?;

        let mut mass = vec![0.0; n * n];
        system.mass_matrix(0.0, &q, &mut mass);
        let mass = DMatrix::from_row_slice(n, n, &mass);
        let mut rows = vec![0.0; m * n];
        system.constraint_matrix(0.0, &q, &mut rows);
        let rows = DMatrix::from_row_slice(m, n, &rows);
        let (directions, held_in_rates) = directions(&mass, &rows, &constraints)
            .ok_or_else(|| Lost::Singular(lagrangian::Singular::new(0, 0.0, 1.0)))?;

        let Derived([forces, by_q, by_v]) =
            Derived::new(&mut self.interpreter, [&q, &v, &self.u.values]);
        let mut numbers = forces.iter().chain(&by_q).chain(&by_v);
        if let Some(place) = numbers.position(|x| !x.is_finite()) {
            return Err(Lost::NotFinite(place % n));
        }
        let curvature = self.curvature(&q, &multipliers);
        let own = DMatrix::from_row_slice(n, n, &by_q);
        let size = |i: usize| -> f64 {
            let springs = (0..n).map(|j| (own[(i, j)] * q[j].abs().max(1.0)).abs());
            let reactions = (0..m).map(|k| (rows[(k, i)] * multipliers[k]).abs());
            forces[i].abs() + springs.chain(reactions).sum::<f64>()
        };
        // In the length that the inertia of each coordinate gives it.
        let squares = (0..n).map(|i| size(i).powi(2) / mass[(i, i)]);
        let rounding = rank::tolerance(n) * squares.sum::<f64>().sqrt();
        let sizes = directions.abs().transpose() * DVector::from_fn(n, |i, _| size(i));
        let along = |k: DMatrix<f64>| directions.transpose() * k * &directions;
        let stiffness = along(own + curvature);
        Ok(Pose {
            forces: directions.transpose() * DVector::from_vec(forces),
            sizes,
            rounding,
            parts: rank::directions(&stiffness).ok_or(Lost::NotFinite(0))?,
            stiffness,
            damping: along(DMatrix::from_row_slice(n, n, &by_v)),
            directions,
            held_in_rates,
            q,
        })
    }

    /// The pose on the constraints that is nearest, as inertia measures it.
    fn brought(&self, q: &[f64]) -> Result<Vec<f64>, Lost> {
        let mut start = self.machine.start();
        start.q.values.copy_from_slice(q);
        start.v.values.fill(0.0);
        let run = Simulation::new(self.machine).until(start.t).run(start);
        let run = run.map_err(|error| Lost::Constraints(error.to_string()))?;
        if let Some((name, _)) = run.start().v.iter().find(|(_, v)| *v != 0.0) {
            let moves = format!("the constraints move `{name}`: the machine is at rest nowhere");
            return Err(Lost::Constraints(moves));
        }
        Ok(run.start().q.values.clone())
    }

    /// `Σ λₖ ∂Gₖ/∂q`.
    fn curvature(&mut self, q: &[f64], multipliers: &[f64]) -> DMatrix<f64> {
        let (n, m) = (q.len(), multipliers.len());
        let [mut q, v, u] = [q, &vec![0.0; n], &self.u.values].map(constants);
        let mut rows = vec![Dual::constant(0.0); m * n];
        let mut curvature = DMatrix::zeros(n, n);
        for j in 0..n {
            q[j].derivative = 1.0;
            let arguments = Arguments {
                t: Dual::constant(0.0),
                q: &q,
                v: &v,
                u: &u,
                a: &[],
            };
            // Nothing in the rows can be singular.
            let _ = self
                .interpreter
                .call(Role::ConstraintMatrix, arguments, &mut rows);
            for (row, multiplier) in rows.chunks_exact(n).zip(multipliers) {
                for (i, g) in row.iter().enumerate() {
                    curvature[(i, j)] += multiplier * g.derivative;
                }
            }
            q[j].derivative = 0.0;
        }
        curvature
    }
}

impl Pose {
    /// Newton's step, in coordinates; along free directions there is none.
    fn step(&self) -> DVector<f64> {
        let mut along = DVector::zeros(self.forces.len());
        for direction in self.parts.iter().filter(|d| !d.is_free()) {
            along -= &direction.right * (direction.left.dot(&self.forces) / direction.value);
        }
        &self.directions * along
    }

    fn is_balanced(&self) -> bool {
        let mut each = self.forces.iter().zip(&self.sizes);
        each.all(|(force, size)| force.abs() <= self.rounding.max(BALANCED * size))
    }
}

/// The directions `N` that all rows leave, with `Nᵀ M N = 1`; and how many directions the rows leave that
/// hold positions, but not those that hold rates. Nothing where `M` is singular.
fn directions(
    mass: &DMatrix<f64>,
    rows: &DMatrix<f64>,
    holonomic: &[bool],
) -> Option<(DMatrix<f64>, usize)> {
    let n = mass.nrows();
    let lower = mass.clone().cholesky()?.l();
    let mut known: Vec<DVector<f64>> = Vec::new();
    let mut held = [0, 0];
    for is_position in [true, false] {
        for (k, _) in holonomic
            .iter()
            .enumerate()
            .filter(|(_, h)| **h == is_position)
        {
            let row = lower.solve_lower_triangular(&rows.row(k).transpose())?;
            if let Some(row) = beside(&known, &row, INDEPENDENT) {
                known.push(row);
                held[usize::from(!is_position)] += 1;
            }
        }
    }
    let (first, mut left) = (known.len(), n - known.len());
    while left > 0 {
        // Of the axes, that of which most is left.
        let axes = (0..n).map(|i| DVector::from_fn(n, |j, _| if i == j { 1.0 } else { 0.0 }));
        let part = |axis: &DVector<f64>| {
            let along = known.iter().map(|unit| unit.dot(axis).powi(2));
            1.0 - along.sum::<f64>()
        };
        let axis = axes.max_by(|a, b| part(a).total_cmp(&part(b)))?;
        known.push(beside(&known, &axis, 0.0)?);
        left -= 1;
    }
    let across: Option<Vec<DVector<f64>>> = known[first..]
        .iter()
        .map(|unit| lower.transpose().solve_upper_triangular(unit))
        .collect();
    let across = across?;
    Some((
        DMatrix::from_fn(n, across.len(), |i, k| across[k][i]),
        held[1],
    ))
}

/// What is left of a vector beside orthonormal ones, of length 1; nothing where that is less than a share
/// of it.
fn beside(known: &[DVector<f64>], vector: &DVector<f64>, least: f64) -> Option<DVector<f64>> {
    let mut left = vector.clone();
    // Twice is enough: W. Kahan in B. N. Parlett, The Symmetric Eigenvalue Problem, 6-9.
    for _ in 0..2 {
        for unit in known {
            left -= unit * unit.dot(&left);
        }
    }
    let length = left.norm();
    (length > least * vector.norm()).then(|| left / length)
}
