//! States as plain rows of numbers, for any machine.

use lagrangian::{Coordinates, Machine, Singular, State, System, Vector};

/// The state of a machine with the given coordinates and rates.
pub fn state<M: Machine>(machine: &M, t: f64, q: &[f64], v: &[f64]) -> State<Coordinates<M>> {
    let system = machine.prepare();
    let named = |numbers: &[f64]| system.to_coordinates(&vector::<M::System>(numbers));
    State {
        t,
        q: named(q),
        v: named(v),
    }
}

/// A system's vector with these entries.
pub fn vector<S: System>(numbers: &[f64]) -> S::Vector {
    let mut vector = S::Vector::zeros(numbers.len());
    vector.as_mut_slice().copy_from_slice(numbers);
    vector
}

/// Coordinates, then rates.
pub fn numbers<S: System>(system: &S, state: &State<S::Coordinates>) -> Vec<f64> {
    let rows = [&state.q, &state.v].map(|row| system.to_vector(row));
    rows.iter()
        .flat_map(|row| row.as_slice())
        .copied()
        .collect()
}

/// The mass matrix in row-major order.
pub fn mass_matrix<S: System>(system: &S, t: f64, q: &S::Vector) -> Vec<f64> {
    let n = q.as_slice().len();
    let mut matrix = S::Matrix::zeros(n * n);
    system.mass_matrix(t, q, &mut matrix);
    matrix.as_slice().to_vec()
}

/// The sum of kinetic and potential energy.
pub fn energy<S: System>(system: &S, t: f64, y: &[f64]) -> f64 {
    let (q, v) = y.split_at(y.len() / 2);
    let (q, v) = (vector::<S>(q), vector::<S>(v));
    system.kinetic_energy(t, &q, &v) + system.potential_energy(t, &q, &system.default_inputs())
}

/// The accelerations with all inputs at their defaults.
pub fn accelerations<S: System>(
    system: &S,
    t: f64,
    q: &[f64],
    v: &[f64],
) -> Result<Vec<f64>, Singular> {
    let (q, v) = (vector::<S>(q), vector::<S>(v));
    let mut a = q.zeros_like();
    system.accelerations(t, &q, &v, &system.default_inputs(), &mut a)?;
    Ok(a.as_slice().to_vec())
}
