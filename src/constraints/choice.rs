//! Chooses the rows that are enforced: as many as are independent, and among these the strongest at a pose.

use super::algebra::{forward, length, remove};
use super::scale::Scales;
use super::workspace::{Workspace, in_workspace};
use crate::{StepError, System, Vector};

/// Independent rows, those of positions first. There are at most as many as coordinates.
#[derive(Clone, Debug)]
pub(crate) struct Choice<V> {
    rows: V,
    /// The number of rows.
    pub rank: usize,
    /// The number of rows of positions.
    pub holonomic: usize,
}

/// How many rows to choose.
#[derive(Clone, Copy)]
pub(crate) enum Rank {
    /// All rows that are independent by more than this.
    Revealed(f64),
    /// All rows that are independent by more than the first number; beyond the previous rank, only rows that are
    /// independent by more than the second.
    Followed(f64, f64),
    /// As many rows of positions, and as many in total, as were chosen before.
    Known,
    /// All rows whose strength exceeds this: see [`Constraints::strength`](super::Constraints::strength).
    Holding(f64),
}

impl<V: Vector> Choice<V> {
    /// No row.
    pub fn none(zeros: V) -> Self {
        Self {
            rows: zeros,
            rank: 0,
            holonomic: 0,
        }
    }

    /// The index of a chosen row.
    pub fn row(&self, chosen: usize) -> usize {
        // The number of rows is far below the integers that `f64` represents exactly.
        self.rows.as_slice()[chosen] as usize
    }

    /// Whether a row was chosen.
    pub fn has(&self, k: usize) -> bool {
        (0..self.rank).any(|j| self.row(j) == k)
    }

    /// Chooses rows at a pose, one after the other, by the length of the component of each that is orthogonal to those
    /// before it: the first row with at least half of the greatest length, or preferably a row that was chosen before
    /// and has at least a quarter of it, so that rows do not change needlessly from one evaluation to the next.
    ///
    /// *Whether* a row is independent is decided by that component relative to the row's present length. *Which* row
    /// is better is decided relative to the largest size of its terms in the run: a row that vanishes in a pose is not
    /// lost there, but a larger part of it is round-off. This is the Gram–Schmidt process with column pivoting, in the
    /// metric of inertia (G. H. Golub, C. F. Van Loan, *Matrix Computations*, 4th ed., section 5.4.2).
    pub fn choose<S: System<Vector = V>>(
        &self,
        system: &S,
        (t, q): (f64, &V),
        rank: Rank,
        (scales, fixed): (&Scales<V>, Option<&V>),
    ) -> Result<Self, StepError> {
        let mut choice = Self::none(q.zeros_like());
        in_workspace(system, t, q.as_slice().len(), |workspace| {
            system.constraint_matrix(t, q, workspace.matrix);
            let n = workspace.n;
            for (k, row) in workspace.matrix.chunks_exact(n.max(1)).enumerate() {
                workspace.rates[k] = scales.strength(k, row, q);
            }
            workspace.fix_rows(fixed);
            workspace.factor(system, t, q, fixed)?;
            for row in workspace.matrix.chunks_exact_mut(n.max(1)) {
                forward(workspace.metric.as_slice(), row);
                let length = length(row);
                if length > 0.0 {
                    row.iter_mut().for_each(|x| *x /= length);
                }
            }
            let roundoff = workspace.roundoff();
            for (known, holonomic) in [(self.holonomic, true), (self.rank, false)] {
                loop {
                    let least = match rank {
                        Rank::Revealed(least) => least.max(roundoff),
                        Rank::Followed(least, _) if choice.rank < known => least.max(roundoff),
                        Rank::Followed(_, more) => more.max(roundoff),
                        Rank::Known if choice.rank < known => 0.0,
                        Rank::Known => break,
                        Rank::Holding(_) => roundoff,
                    };
                    let Some((k, held)) =
                        choice.best_row(system, workspace, holonomic, (least, self))
                    else {
                        break;
                    };
                    if matches!(rank, Rank::Holding(least) if held <= least) {
                        break;
                    }
                    choice.add(workspace, k, least);
                }
                if holonomic {
                    choice.holonomic = choice.rank;
                }
            }
            Ok(choice)
        })
    }

    /// The next row to be chosen, if any is independent by more than `least`, and its component orthogonal to the
    /// chosen rows, relative to the largest size of the row.
    fn best_row<S: System<Vector = V>>(
        &self,
        system: &S,
        workspace: &Workspace<'_, S::Matrix>,
        holonomic: bool,
        (least, before): (f64, &Self),
    ) -> Option<(usize, f64)> {
        if self.rank >= workspace.n.min(workspace.m) {
            return None;
        }
        let held = |k: usize| {
            let left = length(&workspace.matrix[k * workspace.n..][..workspace.n]);
            // The weaker a row, the larger the part of its direction that is round-off.
            (left > least).then_some((k, left * workspace.rates[k]))
        };
        let rows = || {
            let rows = system.constraints().enumerate();
            let rows = rows.filter(move |(_, row)| row.holonomic == holonomic);
            rows.filter_map(|(k, _)| held(k))
        };
        let most = rows().map(|(_, held)| held).reduce(f64::max)?;
        let was_chosen = || rows().find(|(k, held)| before.has(*k) && *held >= 0.25 * most);
        was_chosen().or_else(|| rows().find(|(_, held)| *held >= 0.5 * most))
    }

    /// Adds a row to the chosen ones, if it is independent by more than `least`, and removes its direction
    /// from the others.
    fn add<M: Vector>(&mut self, workspace: &mut Workspace<'_, M>, k: usize, least: f64) {
        let n = workspace.n;
        workspace
            .column
            .copy_from_slice(&workspace.matrix[k * n..][..n]);
        workspace.matrix[k * n..][..n].fill(0.0);
        // Once more: a short remainder is orthogonal to fewer digits.
        for known in workspace.basis[..self.rank * n].chunks_exact(n) {
            remove(known, workspace.column);
        }
        let left = length(workspace.column);
        if left <= least {
            return;
        }
        let new = &mut workspace.basis[self.rank * n..][..n];
        for (new, x) in new.iter_mut().zip(&*workspace.column) {
            *new = x / left;
        }
        for row in workspace.matrix.chunks_exact_mut(n) {
            remove(new, row);
        }
        self.rows.as_mut_slice()[self.rank] = k as f64;
        self.rank += 1;
    }
}
