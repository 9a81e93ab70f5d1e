//! Checks that accelerations satisfy the equations of motion at a state,
//!
//! ```text
//! M a = f + Gᵀ λ + τᵀ F,   G a = γ
//! ```
//!
//! with the multipliers `λ` of the constraints and the friction forces `F` of the contacts. `M`, `f`, `G`, `γ` and
//! `a` come from different functions of a machine and from an elimination, so an error in any of them shows here.
//!
//! Round-off: with `dᵢ = √Mᵢᵢ`, elimination in a positive definite matrix, in any order and arrangement of
//! products, leaves at most `c n ε dᵢ Σⱼ dⱼ |aⱼ|` in row `i`, however ill-conditioned `M` is: N. J. Higham,
//! *Accuracy and Stability of Numerical Algorithms*, 2nd ed., 2002, theorems 10.3 and 10.4, with `|Mᵢⱼ| ≤ dᵢ dⱼ`.
//! Forces of other rows contribute `dᵢ |fⱼ|/dⱼ`. Multipliers come from a second elimination, in `G M⁻¹ Gᵀ`, and
//! from a function of their own, so they differ from those that belong to `a` by that matrix's condition number,
//! which the bound includes; for the rows of `G` it includes that of `M`.
//!
//! The terms within a force are not visible here: `k x − k x₀` may have lost most of its digits. Therefore the
//! bound allows seven digits more than `ε`, and a state that exceeds it is compared with states nearby, away from
//! such cancellations, where a wrong equation is equally wrong. The equations are violated only if all of these
//! exceed it too.

use std::string::String;
use std::vec;
use std::vec::Vec;

use crate::at::At;
use crate::error::constraint_name;
use crate::math::sqrt;
use crate::{ContactForce, Error, Pivot, System, Vector, contact_forces, least_multipliers};

/// The tolerable residual of an equation, relative to the sizes of its terms, for each coordinate: seven digits
/// more than the round-off of `f64`.
const TOLERANCE: f64 = 1e-9;

/// A row depends on those before it if less than this is orthogonal to them.
const DEPENDENT: f64 = 1e-8;

/// The distance of the states nearby, relative to the sizes of the numbers, and the number of such states.
const NEARBY_STATES: (f64, usize) = (1e-3, 4);

/// Checks that the accelerations, multipliers and friction forces of a machine at a state satisfy its equations of
/// motion to rounding: `M a = f + Gᵀ λ + τᵀ F` and `G a = γ`.
///
/// Every run checks this at its start. A machine that has no accelerations there, or no mass matrix
/// ([`System::Matrix`] of another length), passes.
///
/// # Errors
/// [`Error::EquationsViolated`], which indicates a mistake in the functions of the machine and not in
/// its description.
pub fn check_equations<S: System>(system: &S, At { t, q, v, u }: At<'_, S>) -> Result<(), Error> {
    let n = system.equations();
    if n == 0 || n != q.as_slice().len() || S::Matrix::zeros(n * n).as_slice().len() != n * n {
        return Ok(());
    }
    let Some(here) = worst(system, At { t, q, v, u }) else {
        return Ok(());
    };
    if here.share <= here.tolerance {
        return Ok(());
    }
    let nearby = (1..=NEARBY_STATES.1).filter_map(|number| {
        let (q, v) = state_beside(system, q, v, number);
        worst(system, At { t, q: &q, v: &v, u })
    });
    let shares: Vec<bool> = nearby.map(|there| there.share > there.tolerance).collect();
    if shares.len() < 2 || shares.contains(&false) {
        return Ok(());
    }
    Err(Error::EquationsViolated {
        row: here.row,
        is_constraint: here.is_constraint,
        residual: here.residual,
        terms: here.terms,
        t,
    })
}

/// The equation with the largest residual relative to its tolerance.
struct Worst {
    row: String,
    is_constraint: bool,
    residual: f64,
    terms: f64,
    /// The residual relative to the terms.
    share: f64,
    tolerance: f64,
}

/// Returns `None` if there is nothing to check: no accelerations, or none that are finite.
fn worst<S: System>(system: &S, at: At<'_, S>) -> Option<Worst> {
    let equations = Equations::at(system, at)?;
    let n = equations.inertia.as_slice().len();
    let m = equations.constraint_bias.len();
    let inertia = equations.inertia.as_slice();
    let [of_mass, of_constraints] = conditions(&equations.mass, inertia, &equations.matrix);
    let tolerance = TOLERANCE * (n + m) as f64 * of_constraints;
    let mut worst = Worst {
        row: String::new(),
        is_constraint: false,
        residual: 0.0,
        terms: 0.0,
        share: 0.0,
        tolerance,
    };
    let mut is_finite = tolerance.is_finite();
    let coordinates = (0..n).map(|i| (i, false));
    for (index, is_constraint) in coordinates.chain((0..m).map(|k| (k, true))) {
        let (Row { residual, terms }, weight) = if is_constraint {
            (equations.of_constraint(index), of_mass)
        } else {
            (equations.of_coordinate(index), 1.0)
        };
        is_finite &= residual.is_finite() && terms.is_finite();
        let share = if residual == 0.0 {
            0.0
        } else {
            residual.abs() / terms / weight
        };
        if share > worst.share {
            let row = if is_constraint {
                constraint_name(system, index)
            } else {
                let coordinate = system.coordinates().nth(index);
                coordinate.map_or("?", |coordinate| coordinate.name).into()
            };
            worst = Worst {
                row,
                is_constraint,
                residual,
                terms,
                share,
                tolerance,
            };
        }
    }
    is_finite.then_some(worst)
}

/// The equations of motion at a state, with the accelerations that are to satisfy them.
struct Equations<S: System> {
    a: S::Vector,
    mass: S::Matrix,
    /// `f + Gᵀ λ + τᵀ F`, and the sizes of its terms.
    right: S::Vector,
    right_sizes: S::Vector,
    /// `G` and `γ`.
    matrix: Vec<f64>,
    constraint_bias: Vec<f64>,
    /// `√Mᵢᵢ`.
    inertia: S::Vector,
    /// `Σⱼ √Mⱼⱼ |aⱼ| + |fⱼ|/√Mⱼⱼ`, by which rows round off in one another.
    spread: f64,
}

/// A row of the equations of motion: left side minus right side, and the size of its terms.
struct Row {
    residual: f64,
    terms: f64,
}

impl<S: System> Equations<S> {
    /// Returns `None` if there are no accelerations.
    fn at(system: &S, At { t, q, v, u }: At<'_, S>) -> Option<Self> {
        let n = q.as_slice().len();
        let (m, k) = (system.constraints().len(), system.contacts().len());
        let mut a = q.zeros_like();
        let mut multipliers = vec![0.0; m];
        let mut contacts = vec![ContactForce::default(); k];
        solve(
            system,
            At { t, q, v, u },
            &mut a,
            &mut multipliers,
            &mut contacts,
        )?;

        let mut mass = S::Matrix::zeros(n * n);
        system.mass_matrix(t, q, &mut mass);
        let [mut forces, mut applied, mut bias] = q.several_zeros_like();
        system.forces(t, q, v, u, &mut forces);
        system.applied(t, q, v, u, &mut applied);
        system.bias(t, q, v, &mut bias);
        let (mut matrix, mut constraint_bias) = (vec![0.0; m * n], vec![0.0; m]);
        system.constraint_matrix(t, q, &mut matrix);
        system.constraint_bias(t, q, v, &mut constraint_bias);
        let mut slips = vec![0.0; k * n];
        system.slip_matrix(t, q, &mut slips);

        let mut right_sizes = q.zeros_like();
        let [of_right, of_sizes] = [&mut forces, &mut right_sizes].map(|of| of.as_mut_slice());
        for (i, size) in of_sizes.iter_mut().enumerate() {
            let terms = [of_right[i], applied.as_slice()[i], bias.as_slice()[i]];
            *size = terms[0].abs() + terms[1].abs() + terms[2].abs();
        }
        let rows = matrix.chunks_exact(n).zip(&multipliers);
        let friction_forces = contacts.iter().map(|contact| &contact.friction);
        for (row, force) in rows.chain(slips.chunks_exact(n).zip(friction_forces)) {
            for i in 0..n {
                of_right[i] += row[i] * force;
                of_sizes[i] += (row[i] * force).abs();
            }
        }
        let mut inertia = q.zeros_like();
        let mut spread = 0.0;
        for (j, of_row) in inertia.as_mut_slice().iter_mut().enumerate() {
            *of_row = sqrt(mass.as_slice()[j * n + j].max(0.0));
            if *of_row > 0.0 {
                spread += *of_row * a.as_slice()[j].abs() + of_sizes[j] / *of_row;
            }
        }
        Some(Self {
            a,
            mass,
            right: forces,
            right_sizes,
            matrix,
            constraint_bias,
            inertia,
            spread,
        })
    }

    /// Row `i` of `M a = f + Gᵀ λ + τᵀ F`.
    fn of_coordinate(&self, i: usize) -> Row {
        let inertia = self.inertia.as_slice();
        let (n, mass) = (inertia.len(), self.mass.as_slice());
        let row = mass[i * n..][..n].iter().zip(self.a.as_slice());
        let left: f64 = row.clone().map(|(m, a)| m * a).sum();
        let own: f64 = row.map(|(m, a)| (m * a).abs()).sum();
        Row {
            residual: left - self.right.as_slice()[i],
            terms: own + self.right_sizes.as_slice()[i] + inertia[i] * self.spread,
        }
    }

    /// Row `k` of `G a = γ`.
    fn of_constraint(&self, k: usize) -> Row {
        let (inertia, a) = (self.inertia.as_slice(), self.a.as_slice());
        let n = inertia.len();
        let row = &self.matrix[k * n..][..n];
        let left: f64 = row.iter().zip(a).map(|(g, a)| g * a).sum();
        let mut terms = self.constraint_bias[k].abs();
        for j in 0..n {
            terms += (row[j] * a[j]).abs();
            if inertia[j] > 0.0 {
                terms += (row[j] / inertia[j]).abs() * self.spread;
            }
        }
        Row {
            residual: left - self.constraint_bias[k],
            terms,
        }
    }
}

/// Accelerations, multipliers and friction forces, as a run finds them.
fn solve<S: System>(
    system: &S,
    At { t, q, v, u }: At<'_, S>,
    a: &mut S::Vector,
    multipliers: &mut [f64],
    contacts: &mut [ContactForce],
) -> Option<()> {
    if S::MAY_SLIDE && !contacts.is_empty() {
        let at = At { t, q, v, u };
        return contact_forces(system, at, a.as_mut_slice(), multipliers, contacts).ok();
    }
    let result = system
        .accelerations(t, q, v, u, a)
        .and_then(|()| system.multipliers(t, q, v, u, multipliers));
    match result {
        Ok(()) => Some(()),
        Err(singular) => {
            if S::MAY_BE_CONSTRAINED && matches!(singular.at, Pivot::Constraint(_)) {
                return least_multipliers(system, t, q, v, u, a, multipliers).ok();
            }
            None
        }
    }
}

/// Bounds on the amplification of round-off by elimination, for the mass matrix and for the constraints: the
/// inverse squares of the shortest part of a row of unit length that is orthogonal to those before it.
fn conditions<M: Vector>(mass: &M, inertia: &[f64], matrix: &[f64]) -> [f64; 2] {
    let n = inertia.len();
    // Some coordinate has no inertia of its own and is held by the constraints; the amplification is not analysed then.
    const UNKNOWN: [f64; 2] = [1e4; 2];
    if inertia.contains(&0.0) {
        return UNKNOWN;
    }
    let (mass, mut lower) = (mass.as_slice(), mass.zeros_like());
    let lower = lower.as_mut_slice();
    let mut of_mass = 1.0_f64;
    for i in 0..n {
        for j in 0..=i {
            let known: f64 = (0..j).map(|k| lower[i * n + k] * lower[j * n + k]).sum();
            let left = mass[i * n + j] / (inertia[i] * inertia[j]) - known;
            if j < i {
                lower[i * n + j] = left / lower[j * n + j];
            } else if left > 0.0 {
                lower[i * n + i] = sqrt(left);
                of_mass = of_mass.max(1.0 / left);
            } else {
                return UNKNOWN;
            }
        }
    }
    let mut basis: Vec<f64> = Vec::new();
    let mut y = vec![0.0; if matrix.is_empty() { 0 } else { n }];
    let mut of_constraints = 1.0_f64;
    for row in matrix.chunks_exact(n) {
        for i in 0..n {
            let known: f64 = (0..i).map(|k| lower[i * n + k] * y[k]).sum();
            y[i] = (row[i] / inertia[i] - known) / lower[i * n + i];
        }
        let length = |y: &[f64]| sqrt(y.iter().map(|y| y * y).sum());
        let norm = length(&y);
        // Twice: a short remainder is orthogonal to fewer digits.
        for known in basis.chunks_exact(n).chain(basis.chunks_exact(n)) {
            let along: f64 = known.iter().zip(&y).map(|(e, y)| e * y).sum();
            y.iter_mut().zip(known).for_each(|(y, e)| *y -= along * e);
        }
        let left = length(&y);
        if left > DEPENDENT * norm {
            of_constraints = of_constraints.max((norm / left) * (norm / left));
            basis.extend(y.iter().map(|y| y / left));
        }
    }
    [of_mass, of_constraints]
}

/// A state near another one, the same for the same `draw`.
fn state_beside<S: System>(
    system: &S,
    q: &S::Vector,
    v: &S::Vector,
    number: usize,
) -> (S::Vector, S::Vector) {
    let mut draw = number as f64 * 0.414_213_562_373_095;
    let mut moved = |of: &S::Vector, angles: bool| {
        let mut moved = of.clone();
        for (j, coordinate) in system.coordinates().enumerate() {
            let of_same_unit = system.coordinates().zip(of.as_slice());
            let of_same_unit = of_same_unit.filter(|(other, _)| other.unit == coordinate.unit);
            let mut size = of_same_unit.fold(0.0, |size: f64, (_, x)| size.max(x.abs()));
            if size == 0.0 || (angles && coordinate.unit == "rad") {
                size = size.max(1.0);
            }
            // Multiples of the golden ratio are spread evenly.
            draw = (draw + 0.618_033_988_749_895) % 1.0;
            moved.as_mut_slice()[j] += NEARBY_STATES.0 * size * (2.0 * draw - 1.0);
        }
        moved
    };
    (moved(q, true), moved(v, false))
}
