//! Poses in which rows come to depend on each other that do not elsewhere: a parallelogram whose bars
//! come into line.
//!
//! There more directions are free than elsewhere, and branches of the motion may cross. Let `ε` be how much
//! of its greatest length a row has left beside the others. It vanishes in the pose, and rounding of the
//! constraint, `u`, is an error `u/ε` of positions along that row, `u/ε²` of rates and `u/ε³` of accelerations.
//! All of it lies across the motion: a row's direction is what its reaction pushes along, so what is off is
//! taken away again by the next move onto the constraints, where `ε` is no longer small. So, while a motion
//! passes such a pose,
//!
//! * its stages are projected onto the constraints before their accelerations are evaluated;
//! * accelerations within [`PASSED_OVER`] are interpolated between four states on the same branch, two before
//!   and two after, which are well held: an error of order `ε⁴`;
//! * a state with `ε` below [`WEAK`] is not moved along what holds so little: it goes on as it came, which is
//!   how the branch goes on;
//! * the errors of a step are measured along the motion, as that of the state that the constraints then
//!   make of it (E. Hairer, G. Wanner, *Solving Ordinary Differential Equations II*, 2nd ed., section VII.2).

use super::algebra::{backward, remove};
use super::choice::Rank;
use super::workspace::{Workspace, in_workspace};
use super::{Constraints, Level, Place};
use crate::{Singular, StepError, System, Vector};

/// Below this, rows no longer move a state.
pub(super) const WEAK: f64 = 1e-4;

/// Below this, residuals are worked off to rounding: a residual `r` is an error `r/ε²` of the rates across the rows, and the next
/// move, whose rows have turned by then, leaves a part of that along the motion.
pub(super) const TIGHT: f64 = 1e-2;

/// Below this, accelerations are taken from beside the pose.
pub(super) const PASSED_OVER: f64 = 3e-4;

/// Within this, a step that fails may have failed because of such a pose.
const IN_SIGHT: f64 = 0.5;

/// How far from a pose states are looked for, in units of the coordinates' sizes, or in rad.
const BESIDE: f64 = 0.1;

impl<V: Vector> Constraints<V> {
    /// How much of its greatest length the weakest of the chosen rows has left beside the others at a pose;
    /// 0 where it has nothing.
    pub fn hold<S: System<Vector = V>>(&self, system: &S, t: f64, q: &V) -> f64 {
        let hold = in_workspace(system, t, q.as_slice().len(), |workspace| {
            self.prepare(system, workspace, (t, q), Level::Rates)?;
            Ok(self.held(workspace, q))
        });
        hold.unwrap_or(0.0)
    }

    /// [`hold`](Self::hold) where rows have been factorized.
    fn held<M: Vector>(&self, workspace: &Workspace<'_, M>, q: &V) -> f64 {
        let rank = self.choice.rank;
        let mut least: f64 = 1.0;
        for j in 0..rank {
            let entries = (0..=j).map(|i| workspace.triangle[i * rank + j]);
            let whole = crate::math::sqrt(entries.map(|x| x * x).sum());
            let k = self.choice.row(j);
            let row = &workspace.matrix[k * workspace.n..][..workspace.n];
            let own = workspace.triangle[j * rank + j] / whole * self.scales.strength(k, row, q);
            least = least.min(own);
        }
        least
    }

    /// [`hold`](Self::hold) where rows may have been factorized; 1 where their factorization failed for another reason.
    pub(super) fn hold_of<M: Vector>(
        &self,
        prepared: &Result<(), StepError>,
        workspace: &Workspace<'_, M>,
        q: &V,
    ) -> f64 {
        match prepared {
            Ok(()) => self.held(workspace, q),
            Err(StepError::Singular { singular, .. })
                if matches!(singular.at, crate::Pivot::Constraint(_)) =>
            {
                0.0
            }
            Err(_) => 1.0,
        }
    }

    /// Takes note that a step between two poses failed; says whether such a pose may be why, which was not
    /// known before.
    pub fn meet_fork<S: System<Vector = V>>(&mut self, system: &S, poses: [(f64, &V); 2]) -> bool {
        if self.at_fork {
            return false;
        }
        let holds = |(t, q): &(f64, &V)| self.hold(system, *t, q) < IN_SIGHT;
        self.at_fork = poses.iter().any(holds);
        self.at_fork
    }

    /// Takes note of the end of a step: whether the pose has been passed.
    pub fn pass_fork<S: System<Vector = V>>(&mut self, system: &S, t: f64, q: &V) {
        self.at_fork = self.at_fork && self.hold(system, t, q) < IN_SIGHT;
    }

    /// Accelerations of a state that is first projected onto the constraints: a stage is off them by what the
    /// method leaves of it, and that, too, would grow as `1/ε²`.
    pub(super) fn accelerations_at_fork<S: System<Vector = V>>(
        &self,
        system: &S,
        (t, q, v, u): (f64, &V, &V, &S::Inputs),
        a: &mut V,
    ) -> Result<(), StepError> {
        if self.hold(system, t, q) < PASSED_OVER {
            return self.accelerations_across(system, (t, q, v, u), a);
        }
        let (mut q, mut v) = (q.clone(), v.clone());
        self.put_on(system, t, &mut q, &mut v)?;
        self.accelerations_here(system, (t, &q, &v, u), a)
    }

    /// Accelerations between those beside a pose, two before and two after it.
    ///
    /// They are a smooth function of the place on the line through the state along its rates, projected onto the constraints, so
    /// the cubic through four of its values is off by the fourth power of their distance.
    fn accelerations_across<S: System<Vector = V>>(
        &self,
        system: &S,
        (t, q, v, u): (f64, &V, &V, &S::Inputs),
        a: &mut V,
    ) -> Result<(), StepError> {
        let mut times = [0.0; 4];
        let mut beside: [V; 4] = a.several_zeros_like();
        for (pair, direction) in [1.0, -1.0].into_iter().enumerate() {
            let mut far = PASSED_OVER;
            for k in [2 * pair, 2 * pair + 1] {
                let at = (t, q, v, u);
                let (by, was) =
                    self.accelerations_beside(system, at, (direction, far), &mut beside[k])?;
                times[k] = by;
                // The next one is as far from this one as this one is from the pose.
                far = 2.0 * was;
            }
        }
        let a = a.as_mut_slice();
        a.fill(0.0);
        for (k, beside) in beside.iter().enumerate() {
            let others = times.iter().enumerate().filter(|(j, _)| *j != k);
            let weight: f64 = others.map(|(_, t)| t / (t - times[k])).product();
            for (a, beside) in a.iter_mut().zip(beside.as_slice()) {
                *a += weight * beside;
            }
        }
        Ok(())
    }

    /// Accelerations at the nearest state in a direction of time, from some distance on, that is held well enough; says when
    /// that is, and at which distance.
    fn accelerations_beside<S: System<Vector = V>>(
        &self,
        system: &S,
        (t, q, v, u): (f64, &V, &V, &S::Inputs),
        (direction, mut far): (f64, f64),
        a: &mut V,
    ) -> Result<(f64, f64), StepError> {
        let rate = self.scales.rate(v);
        // What comes to rest in such a pose may leave it on any branch.
        while rate > 0.0 && far < BESIDE {
            let by = direction * far / rate;
            let mut ahead = q.clone();
            for (q, v) in ahead.as_mut_slice().iter_mut().zip(v.as_slice()) {
                *q += by * v;
            }
            if self.hold(system, t + by, &ahead) >= 2.0 * PASSED_OVER {
                let mut rates = v.clone();
                self.put_on(system, t + by, &mut ahead, &mut rates)?;
                self.accelerations_here(system, (t + by, &ahead, &rates, u), a)?;
                return Ok((by, far));
            }
            far *= 1.5;
        }
        let singular = Singular::constraint(self.choice.row(0), 0.0, 1.0);
        Err(StepError::Singular { singular, t })
    }

    /// Brings a state that may be held weakly, but is held, onto all chosen rows.
    pub(super) fn put_on<S: System<Vector = V>>(
        &self,
        system: &S,
        t: f64,
        q: &mut V,
        v: &mut V,
    ) -> Result<(), StepError> {
        let mut own = self.clone();
        own.tight = true;
        let mut low = [q.zeros_like(), v.zeros_like()];
        let [q_low, v_low] = &mut low;
        let place = &mut Place {
            t,
            q: [q, q_low],
            v: [v, v_low],
        };
        in_workspace(system, t, place.q[0].as_slice().len(), |workspace| {
            own.prepare(system, workspace, (t, place.q[0]), Level::Positions)?;
            let [left, _] = own.left(system, workspace, place);
            own.newton(system, workspace, place, Level::Positions, left)?;
            own.prepare(system, workspace, (t, place.q[0]), Level::Rates)?;
            let [_, left] = own.left(system, workspace, place);
            own.newton(system, workspace, place, Level::Rates, left)
        })
    }

    /// Takes out of a change of coordinates, or of rates, what goes across the constraints at a pose.
    pub fn keep_along<S: System<Vector = V>>(
        &self,
        system: &S,
        t: f64,
        q: &V,
        change: &mut V,
    ) -> Result<(), StepError> {
        let choice = self
            .choice
            .made(system, (t, q), Rank::Known, (&self.scales, None))?;
        in_workspace(system, t, q.as_slice().len(), |workspace| {
            super::prepare(system, workspace, (t, q), (&choice, None))?;
            let (n, l) = (workspace.n, workspace.metric.as_slice());
            let change = change.as_mut_slice();
            // z = Lᵀ x
            for i in 0..n {
                change[i] = (i..n).map(|k| l[k * n + i] * change[k]).sum();
            }
            for along in workspace.basis.chunks_exact(n).take(choice.rank) {
                remove(along, change);
            }
            backward(l, change);
            Ok(())
        })
    }
}
