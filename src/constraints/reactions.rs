//! Reactions along the basis of the chosen rows.

use super::algebra::{backward, dot, forward};
use super::choice::Choice;
use super::workspace::Workspace;
use super::{prepare, solve_transposed};
use crate::at::At;
use crate::{StepError, System, Vector};

/// Writes `z = L⁻¹ f` to `z`, and the contribution of the reactions along the basis, `R⁻ᵀ γ − Qᵀ z`, to `workspace.row`.
pub(super) fn reactions_along<S: System>(
    system: &S,
    workspace: &mut Workspace<'_, S::Matrix>,
    choice: &Choice<S::Vector>,
    At { t, q, v, u }: At<'_, S>,
    z: &mut S::Vector,
) -> Result<(), StepError> {
    prepare(system, workspace, (t, q), (choice, None))?;
    system.forces(t, q, v, u, z);
    system.constraint_bias(t, q, v, workspace.rates);
    for j in 0..choice.rank {
        workspace.row[j] = workspace.rates[choice.row(j)];
    }
    solve_transposed(workspace, choice.rank, choice.rank);
    forward(workspace.metric.as_slice(), z.as_mut_slice());
    for (j, along) in workspace
        .basis
        .chunks_exact(workspace.n)
        .take(choice.rank)
        .enumerate()
    {
        workspace.row[j] -= dot(along, z.as_slice());
    }
    Ok(())
}

/// If `M` is singular and the metric is that of `M + Gᵀ W G`, the reactions along the basis belong to this inertia. Replaces them in
/// `workspace.row` by those of `M a − f`. `z` is overwritten.
pub(super) fn reactions_of_inertia<S: System>(
    system: &S,
    workspace: &mut Workspace<'_, S::Matrix>,
    rank: usize,
    At { t, q, v, u }: At<'_, S>,
    z: &mut S::Vector,
) {
    let n = workspace.n;
    let a = z.as_mut_slice();
    for (along, row) in workspace.basis.chunks_exact(n).zip(&workspace.row[..rank]) {
        a.iter_mut()
            .zip(along)
            .for_each(|(a, along)| *a += row * along);
    }
    backward(workspace.metric.as_slice(), a);
    let mut mass = S::Matrix::zeros(n * n);
    system.mass_matrix(t, q, &mut mass);
    let mut reactions = q.zeros_like();
    system.forces(t, q, v, u, &mut reactions);
    let rows = mass.as_slice().chunks_exact(n);
    for (reaction, row) in reactions.as_mut_slice().iter_mut().zip(rows) {
        *reaction = dot(row, a) - *reaction;
    }
    forward(workspace.metric.as_slice(), reactions.as_mut_slice());
    for (row, along) in workspace.row[..rank]
        .iter_mut()
        .zip(workspace.basis.chunks_exact(n))
    {
        *row = dot(along, reactions.as_slice());
    }
}
