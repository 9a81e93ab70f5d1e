//! Projects the start of a run onto the constraints.

use super::choice::{Choice, Rank};
use super::fork::TIGHT;
use super::workspace::{Workspace, in_workspace};
use super::{Changed, Constraints, INDEPENDENT, Level, Unprojected};
use crate::{Singular, StepError, System, Vector};

/// The independence that rows must have, from afar to near: rows that are dependent where the
/// constraints hold are dependent off the constraints only to within the distance of the state. The
/// bound that holds on the constraints comes last, and again for a row that was missing only because the
/// state was too far off.
const PASSES: [f64; 7] = [0.3, 0.1, 1e-2, 1e-4, 1e-6, INDEPENDENT, INDEPENDENT];

/// The distance from the start at which rows are examined, in units of the coordinates' sizes, and the
/// independence that rows must have there to count as new. A state at this distance from the start
/// violates the constraints by the square of it, and dependent rows become independent by as much.
const PROBE_DISTANCE: f64 = 1e-3;
const NEWLY_INDEPENDENT: f64 = 10.0 * PROBE_DISTANCE * PROBE_DISTANCE;

/// The number of displacements that are used to find how rows bend.
const DISPLACEMENTS: u32 = 3;

impl<V: Vector> Constraints<V> {
    /// Projects the start of a run onto the constraints by the smallest move in the metric of inertia, and
    /// chooses rows there.
    ///
    /// Coordinates and rates that are nonzero in `kept` stay fixed: the move is the smallest
    /// of the others.
    pub fn begin<S: System<Vector = V>>(
        &mut self,
        system: &S,
        place: &mut Unprojected<'_, V>,
        kept: Option<[V; 2]>,
    ) -> Result<(), StepError> {
        let state_before = [place.q[0].clone(), place.v[0].clone()];
        self.kept = kept;
        let mut tried = Ok(false);
        // How many passes in succession have chosen all rows and moved nothing.
        let mut at_rest = 0;
        for independent in PASSES {
            if at_rest == 1 && self.reorders_all_rows(system, (place.t, place.q[0]), independent) {
                at_rest = 2;
                break;
            }
            tried = self.pass(system, place, Rank::Revealed(independent), at_rest > 0);
            if tried == Ok(false) && independent == INDEPENDENT {
                break;
            }
            let are_all = self.kept.is_none() && self.choice.rank == system.constraints().len();
            at_rest = if tried == Ok(false) && are_all {
                at_rest + 1
            } else {
                0
            };
        }
        tried?;
        // The passes together may have moved farther than a single move with the rows that they found.
        if *place.q[0] != state_before[0] || *place.v[0] != state_before[1] {
            let projected = [place.q[0].clone(), place.v[0].clone()];
            set_state(place, &state_before);
            at_rest = 0;
            if self.pass(system, place, Rank::Known, false).is_err() {
                set_state(place, &projected);
                self.pass(system, place, Rank::Revealed(INDEPENDENT), false)?;
            }
        }
        self.kept = None;
        if at_rest < 2 {
            self.choose(system, place.t, place.q[0], Rank::Revealed(INDEPENDENT))?;
        }
        for (level, given) in state_before.iter().enumerate() {
            let now = [&*place.q[0], &*place.v[0]][level].as_slice();
            let moved = self.moved[level].as_mut_slice().iter_mut();
            for (moved, (now, given)) in moved.zip(now.iter().zip(given.as_slice())) {
                *moved = now - given;
            }
        }
        self.accept(place.q[0], place.v[0]);
        self.find_branch(system, (place.t, place.q[0], place.v[0]))
    }

    /// Chooses rows once more in the pose in which a pass has chosen all of them and moved nothing: by now it is known how they bend, so that their order may
    /// become another one. A pass with the same rows would move nothing again; and no further choice would change them, since a lower bound admits no further
    /// rows, and of rows that were all chosen before, none is preferred. Returns whether all rows are chosen; otherwise nothing changes.
    fn reorders_all_rows<S: System<Vector = V>>(
        &mut self,
        system: &S,
        at: (f64, &V),
        independent: f64,
    ) -> bool {
        let by = (&self.scales, None);
        let choice = self
            .choice
            .choose(system, at, Rank::Revealed(independent), by);
        match choice {
            Ok(choice) if choice.rank == system.constraints().len() => {
                self.choice = choice;
                true
            }
            _ => false,
        }
    }

    /// Checks whether rows are dependent in the pose at the start that are independent next to it. Then
    /// the rates decide on which branch the motion continues, and all rows that hold there are chosen.
    ///
    /// # Errors
    /// If the rates are 0: inertia cannot decide then.
    fn find_branch<S: System<Vector = V>>(
        &mut self,
        system: &S,
        (t, q, v): (f64, &V, &V),
    ) -> Result<(), StepError> {
        if !self.redundant {
            return Ok(());
        }
        let rate = self.scales.rate(v);
        let mut ahead = q.zeros_like();
        let mut later = t;
        if rate > 0.0 {
            ahead.clone_from(v);
            later += PROBE_DISTANCE / rate;
        } else {
            self.scales.displacement(0, &mut ahead);
        }
        let by = if rate > 0.0 {
            PROBE_DISTANCE / rate
        } else {
            PROBE_DISTANCE
        };
        for (ahead, q) in ahead.as_mut_slice().iter_mut().zip(q.as_slice()) {
            *ahead = q + by * *ahead;
        }
        // Rows that depend on others everywhere depend only on those.
        if self
            .project_onto_chosen(system, later, &mut ahead, &mut v.clone())
            .is_err()
        {
            return Ok(());
        }
        let by = (&self.scales, None);
        let beside = (later, &ahead);
        let choice = Choice::none(q.zeros_like()).choose(
            system,
            beside,
            Rank::Revealed(NEWLY_INDEPENDENT),
            by,
        )?;
        if choice.rank <= self.choice.rank {
            return Ok(());
        }
        if rate == 0.0 {
            let mut rows = (0..choice.rank).map(|j| choice.row(j));
            let row = rows.find(|k| !self.choice.has(*k));
            let singular = Singular::constraint(row.unwrap_or_default(), 0.0, 1.0);
            return Err(StepError::Singular { singular, t });
        }
        self.redundant = choice.rank < system.constraints().len();
        self.choice = choice;
        self.at_fork = true;
        Ok(())
    }

    /// One move, with the rows that are independent where it begins; none if these have no solution
    /// nearby. `is_known` says that how rows bend was recorded in this pose. Returns whether it moved.
    fn pass<S: System<Vector = V>>(
        &mut self,
        system: &S,
        place: &mut Unprojected<'_, V>,
        rank: Rank,
        mut is_known: bool,
    ) -> Result<bool, StepError> {
        let n = place.q[0].as_slice().len();
        let before = [place.q[0].clone(), place.v[0].clone()];
        let (mut moved, was_known) = (false, is_known);
        // The smallest move of the rates is that at the pose to which the positions have moved. Also, positions and rates may have
        // different fixed numbers, so that different rows are independent.
        let known = self.choice.clone();
        for level in [Level::Positions, Level::Rates] {
            // In the same pose, without fixed numbers, the same rows are chosen for the rates as for the positions, unless something became known
            // of them in between.
            let is_chosen = matches!(level, Level::Rates) && was_known && !moved;
            let is_chosen = is_chosen && self.kept.is_none();
            if !is_chosen {
                let fixed = self.kept.as_ref().map(|kept| &kept[level as usize]);
                let by = (&self.scales, fixed);
                self.choice = known.choose(system, (place.t, place.q[0]), rank, by)?;
                self.redundant = self.choice.rank < system.constraints().len();
            }
            let approached = in_workspace(system, place.t, n, |workspace| {
                if !is_known {
                    self.record_curvatures(system, workspace, (place.t, place.q[0]));
                }
                self.approach(system, workspace, place, &[level])
            });
            is_known = matches!(approached, Ok((false, _)));
            match approached {
                Ok((has_moved, _)) => moved |= has_moved,
                Err(error) => {
                    set_state(place, &before);
                    return Err(error);
                }
            }
        }
        in_workspace(system, place.t, n, |workspace| {
            let left = self.residuals(system, workspace, place, Changed::All);
            self.check_redundant_rows(system, workspace, place, left.guaranteed)
        })?;
        Ok(moved)
    }

    /// Records the change of rows over the sizes of the coordinates: `½ sᵀ (∂²g/∂q²) s` for some
    /// displacements `s`, from the part of `γ` that is even in the rates.
    fn record_curvatures<S: System<Vector = V>>(
        &mut self,
        system: &S,
        workspace: &mut Workspace<'_, S::Matrix>,
        (t, q): (f64, &V),
    ) {
        let mut s = q.zeros_like();
        system.constraint_bias(t, q, &s, workspace.row);
        for part in 0..DISPLACEMENTS {
            self.scales.displacement(part, &mut s);
            system.constraint_bias(t, q, &s, workspace.positions);
            s.as_mut_slice().iter_mut().for_each(|s| *s = -*s);
            system.constraint_bias(t, q, &s, workspace.rates);
            for k in 0..workspace.m {
                let even = 0.5 * (workspace.positions[k] + workspace.rates[k]) - workspace.row[k];
                self.scales.record_curvature(k, 0.5 * even.abs());
            }
        }
        self.limit_curvatures(system, workspace, (t, q), &mut s);
    }

    /// Replaces changes of rows that are not known to second order. Where a coordinate is much greater than the length over which a row turns, as far from the origin that
    /// of the distance from a point, the second order says that its terms grow with the square of the coordinate, though no row is anywhere that long: it would
    /// be taken for one that all but vanishes here. A row that is weak for its change alone is evaluated where it has changed.
    fn limit_curvatures<S: System<Vector = V>>(
        &mut self,
        system: &S,
        workspace: &mut Workspace<'_, S::Matrix>,
        (t, q): (f64, &V),
        there: &mut V,
    ) {
        system.constraint_matrix(t, q, workspace.matrix);
        let n = workspace.n.max(1);
        let mut some_are_weak = false;
        for (weak, (k, row)) in
            (workspace.rates.iter_mut()).zip(workspace.matrix.chunks_exact(n).enumerate())
        {
            let is_weak = self.scales.strength(k, row, q) < TIGHT;
            *weak = f64::from(u8::from(is_weak));
            some_are_weak |= is_weak;
        }
        if !some_are_weak {
            return;
        }
        workspace.positions.fill(0.0);
        for part in 0..DISPLACEMENTS {
            self.scales.displacement(part, there);
            for (there, q) in there.as_mut_slice().iter_mut().zip(q.as_slice()) {
                *there += q;
            }
            system.constraint_matrix(t, there, workspace.matrix);
            let rows = workspace.matrix.chunks_exact(n).enumerate();
            for (most, (k, row)) in workspace.positions.iter_mut().zip(rows) {
                let [terms, _] = self.scales.sizes_of_terms(k, row, there);
                // A row that has no value there says nothing.
                *most = if terms.is_nan() {
                    f64::INFINITY
                } else {
                    most.max(terms)
                };
            }
        }
        for (k, (most, weak)) in (workspace.positions.iter().zip(&*workspace.rates)).enumerate() {
            if *weak > 0.0 {
                self.scales.limit_curvature(k, *most, TIGHT);
            }
        }
    }
}

fn set_state<V: Vector>(place: &mut Unprojected<'_, V>, state: &[V; 2]) {
    for (of, state) in [&mut place.q, &mut place.v].into_iter().zip(state) {
        of[0].clone_from(state);
        of[1].as_mut_slice().fill(0.0);
    }
}
