//! Contacts that stick or stop: slips that are 0 to the last bit.

use super::law::Equations;
use super::per_contact::PerContact;
use super::{Contacts, Motion, slips, with_parts};
use crate::{StepError, System, Vector};

impl Contacts {
    /// Keeps sticking contacts at rest after a step.
    #[inline]
    pub fn hold<S: System>(
        &self,
        system: &S,
        (t, q, u): (f64, &S::Vector, &S::Inputs),
        v: [&mut S::Vector; 2],
    ) -> Result<(), StepError> {
        if !self.sticks() {
            return Ok(());
        }
        let sticks = |k: usize| self.mode.motion[k] == Motion::Sticks;
        let resting = PerContact::from_fn(self.count, sticks);
        self.stop_contacts(system, (t, q, u), v, &resting)
    }

    pub(super) fn sticks(&self) -> bool {
        self.mode.motion.contains(&Motion::Sticks)
    }

    /// Corrects accelerations of sticking contacts by their round-off: if one coordinate alone produces the slip, its acceleration is
    /// known without friction.
    pub(super) fn correct_sticking_accelerations<S: System>(
        &self,
        system: &S,
        (t, q, v): (f64, &S::Vector, &S::Vector),
        a: &mut S::Vector,
        workspace: &mut [f64],
    ) {
        let n = q.as_slice().len();
        let (rows, bias) = workspace[..self.count * (n + 1)].split_at_mut(self.count * n);
        system.slip_matrix(t, q, rows);
        system.slip_bias(t, q, v, bias);
        for (k, row) in rows.chunks_exact(n).enumerate() {
            if self.mode.motion[k] == Motion::Sticks
                && let Some(i) = only_entry(row)
            {
                a.as_mut_slice()[i] = -bias[k] / row[i];
            }
        }
    }

    /// Stops the contacts that are to rest, by the smallest change of the rates in the metric of inertia. If one coordinate alone
    /// produces the slip, it stops to the last bit.
    pub(super) fn stop_contacts<S: System>(
        &self,
        system: &S,
        (t, q, u): (f64, &S::Vector, &S::Inputs),
        [v, v_low]: [&mut S::Vector; 2],
        resting: &[bool],
    ) -> Result<(), StepError> {
        let before = v.clone();
        let now = slips(system, t, q, v);
        let moving = |k: usize| resting[k] && now[k] != 0.0;
        if !(0..self.count).any(moving) {
            return Ok(());
        }
        let stopped = with_parts(system, t, q, &before, u, |parts, workspace| {
            let (n, count) = (parts.layout.response.coordinates, self.count);
            // dw = W Λ for impulses Λ along the contacts, with dw = −w for those that rest.
            let mut equations = Equations::new(count);
            for (k, row) in equations.rows_mut().enumerate() {
                if !resting[k] {
                    row[k] = 1.0;
                    continue;
                }
                for (j, x) in row[..count].iter_mut().enumerate() {
                    if resting[j] {
                        *x = parts.at(1 + j, parts.slip_rate(k));
                    }
                }
                row[count] = -now[k];
            }
            if let Some(impulses) = equations.solve() {
                for (i, v) in v.as_mut_slice().iter_mut().enumerate() {
                    let by = (0..count).map(|k| parts.at(1 + k, i) * impulses[k]);
                    let by: f64 = by.sum();
                    if by != 0.0 {
                        *v += by;
                        v_low.as_mut_slice()[i] = 0.0;
                    }
                }
            }
            let matrix = &mut workspace[..count * n];
            system.slip_matrix(t, q, matrix);
            for (k, row) in matrix.chunks_exact(n).enumerate() {
                if resting[k]
                    && let Some(i) = only_entry(row)
                {
                    v.as_mut_slice()[i] = 0.0;
                    v_low.as_mut_slice()[i] = 0.0;
                    let left = slips(system, t, q, v)[k];
                    if left != 0.0 {
                        v.as_mut_slice()[i] = -left / row[i];
                    }
                }
            }
            Ok(())
        });
        stopped.map_err(|singular| StepError::Singular { singular, t })
    }
}

/// The index of the only nonzero entry of a row, if there is exactly one.
fn only_entry(row: &[f64]) -> Option<usize> {
    let mut entries = row.iter().enumerate().filter(|(_, x)| **x != 0.0);
    match (entries.next(), entries.next()) {
        (Some((i, _)), None) => Some(i),
        _ => None,
    }
}
