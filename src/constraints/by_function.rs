//! Projects states that are nearly on the constraints, as the ends of steps are, by the function that a machine has for it.
//!
//! Each call gives the residuals, the rows and the corrections of both levels at a state, so a correction of the coordinates and the evaluation of
//! the residual after it are one call. The corrections are those of Newton's method with the matrices of each iteration. The rates are corrected last, with
//! the matrices of the last call: their residuals are linear in them, so the residual after a correction follows from the rows.
#![expect(
    clippy::neg_cmp_op_on_partial_ord,
    reason = "what is not a number passes no test here"
)]

use lagrangian_scalar::projection::ProjectionLayout;

use super::algebra::{dot, share};
use super::nearby::CONTRACTION;
use super::{Constraints, Level, NEAR, Unprojected, fork};
use crate::compensated::two_sum;
use crate::{System, Vector};

/// The length of the workspace: the numbers of the function, and the reciprocal of a scale for each row.
pub(super) const fn workspace(coordinates: usize, constraints: usize) -> usize {
    let layout = ProjectionLayout {
        coordinates,
        constraints,
    };
    layout.len() + constraints
}

impl<V: Vector> Constraints<V> {
    /// Projects a state onto the constraints; returns whether it moved. `None` if the machine has no function for it, or if the state is not so near, or
    /// the rows are not so independent, that the function suffices: then the state is as it was.
    #[inline(always)]
    pub(super) fn project_by_function<S: System<Vector = V>>(
        &mut self,
        system: &S,
        place: &mut Unprojected<'_, V>,
    ) -> Option<bool> {
        let layout = ProjectionLayout {
            coordinates: place.q[0].as_slice().len(),
            constraints: system.constraints().len(),
        };
        let are_all_chosen = self.choice.rank == layout.constraints;
        if !are_all_chosen || self.redundant || self.at_fork || self.kept.is_some() {
            return None;
        }
        let length = super::constraint_workspace(layout.coordinates, layout.constraints);
        system.with_workspace(length, |all| {
            let (numbers, scales) = all?.split_at_mut_checked(layout.len())?;
            let mut evaluate = |place: &Unprojected<'_, V>, numbers: &mut [f64]| {
                let (q, v) = (&*place.q[0], &*place.v[0]);
                matches!(system.projection(place.t, q, v, numbers), Ok(true))
            };
            if !evaluate(place, numbers) {
                return None;
            }
            self.project_from(&layout, numbers, scales, place, &mut evaluate)
        })
    }

    /// The strength of the weakest row in a pose; `None` if the machine has no function for it, or if rows are dependent there.
    pub(super) fn strength_by_function<S: System<Vector = V>>(
        &self,
        system: &S,
        t: f64,
        q: &V,
    ) -> Option<f64> {
        let layout = ProjectionLayout {
            coordinates: q.as_slice().len(),
            constraints: system.constraints().len(),
        };
        if self.redundant || self.choice.rank != layout.constraints {
            return None;
        }
        let length = super::constraint_workspace(layout.coordinates, layout.constraints);
        system.with_workspace(length, |all| {
            let numbers = all?.get_mut(..layout.len())?;
            let is_there = system.projection(t, q, &q.zeros_like(), numbers);
            if !matches!(is_there, Ok(true)) {
                return None;
            }
            let (pivots, compliances) = (&numbers[layout.pivots()], &numbers[layout.compliances()]);
            let mut least = 1.0_f64;
            for (k, row) in rows(&layout, numbers).enumerate() {
                let independent = crate::math::sqrt(pivots[k] / compliances[k]);
                least = least.min(independent * self.scales.strength(k, row, q));
            }
            Some(least)
        })
    }

    /// [`project_by_function`](Self::project_by_function) from the numbers of the function at the state.
    #[inline(always)]
    fn project_from(
        &mut self,
        layout: &ProjectionLayout,
        numbers: &mut [f64],
        scales: &mut [f64],
        place: &mut Unprojected<'_, V>,
        evaluate: &mut impl FnMut(&Unprojected<'_, V>, &mut [f64]) -> bool,
    ) -> Option<bool> {
        self.reduces_to_roundoff = false;
        let threshold = self.reduction_threshold();
        let residuals = self.residuals_of(layout, numbers, place);
        let now = [residuals[0][0], residuals[1][0]];
        // The negation is true of NaN.
        if !(now[0] < NEAR && now[1] < NEAR) {
            return None;
        }
        let is_moved = !(now[0] <= threshold && now[1] <= threshold);
        if is_moved && !self.holds_tightly(layout, numbers, place.q[0]) {
            return None;
        }
        for moved in &mut self.moved {
            moved.as_mut_slice().fill(0.0);
        }
        self.record_residuals_of_step(now);
        let mut left = residuals;
        if is_moved {
            self.scales.record_inertias(&numbers[layout.inertias()]);
            let before = [&place.q, &place.v].map(|[high, low]| [(*high).clone(), (*low).clone()]);
            let mut corrected = Some(());
            if now[0] > threshold {
                corrected = self.correct_coordinates(layout, numbers, scales, place, evaluate);
            }
            corrected = corrected
                .and_then(|()| self.correct_rates(layout, numbers, scales, place, evaluate));
            if corrected.is_none() {
                let levels = [&mut place.q, &mut place.v];
                for ([high, low], [high_before, low_before]) in levels.into_iter().zip(before) {
                    **high = high_before;
                    **low = low_before;
                }
                return None;
            }
            left = self.residuals_of(layout, numbers, place);
            self.chosen_residuals = [left[0][0], left[1][0]];
        }
        self.residual = left[0][1].max(left[1][1]);
        for (k, row) in rows(layout, numbers).enumerate() {
            let by_rates = dot(row, place.v[0].as_slice());
            let rate = numbers[layout.rates()][k];
            (self.scales).record_terms(k, row, (rate - by_rates).abs());
        }
        Some(is_moved)
    }

    /// The largest residuals of positions and of rates, relative to their scales now and to those of the guaranteed bound; NaN counts as the largest.
    #[inline(always)]
    fn residuals_of(
        &self,
        layout: &ProjectionLayout,
        numbers: &[f64],
        place: &Unprojected<'_, V>,
    ) -> [[f64; 2]; 2] {
        let mut most = [[0.0_f64; 2]; 2];
        let (positions, rates) = (&numbers[layout.positions()], &numbers[layout.rates()]);
        let (q, v) = (&*place.q[0], &*place.v[0]);
        let at = (q, v, self.scales.roundoff_of_rates(v));
        for (k, row) in rows(layout, numbers).enumerate() {
            let left = [positions[k], rates[k]];
            let relative = self.scales.relative_within(k, row, left, at);
            for level in 0..2 {
                let of_level = [relative[level].now, relative[level].guaranteed];
                for (most, now) in most[level].iter_mut().zip(of_level) {
                    if !(now <= *most || most.is_nan()) {
                        *most = now;
                    }
                }
            }
        }
        most
    }

    /// Whether every row is so independent of the others, and so strong in the pose, that residuals need not be reduced to round-off.
    #[inline(always)]
    fn holds_tightly(&self, layout: &ProjectionLayout, numbers: &[f64], q: &V) -> bool {
        let (pivots, compliances) = (&numbers[layout.pivots()], &numbers[layout.compliances()]);
        let mut hold = true;
        for (k, row) in rows(layout, numbers).enumerate() {
            let [now, greatest] = self.scales.sizes_of_terms(k, row, q);
            let least = fork::TIGHT * greatest;
            // A pivot that is not a number holds nothing.
            hold &= pivots[k] * (now * now) >= least * least * compliances[k];
        }
        hold
    }

    /// Corrects the coordinates until their residuals are reduced; `None` if a correction does not reduce them to a tenth.
    #[inline(always)]
    fn correct_coordinates(
        &mut self,
        layout: &ProjectionLayout,
        numbers: &mut [f64],
        scales: &mut [f64],
        place: &mut Unprojected<'_, V>,
        evaluate: &mut impl FnMut(&Unprojected<'_, V>, &mut [f64]) -> bool,
    ) -> Option<()> {
        let threshold = self.reduction_threshold();
        for (k, (row, scale)) in rows(layout, numbers).zip(&mut *scales).enumerate() {
            *scale = share(1.0, self.scales.of_positions(k, row, place.q[0]));
        }
        let mut left = largest_share(&numbers[layout.positions()], scales);
        while !(left <= threshold) {
            let moves = &numbers[layout.moves_of_coordinates()];
            let [y, low] = place.level(Level::Positions);
            apply(moves, y, low, &mut self.moved[0]);
            if !evaluate(place, numbers) {
                return None;
            }
            let before = left;
            left = largest_share(&numbers[layout.positions()], scales);
            if !(left <= threshold.max(CONTRACTION * before)) {
                return None;
            }
        }
        Some(())
    }

    /// The same of the rates.
    #[inline(always)]
    fn correct_rates(
        &mut self,
        layout: &ProjectionLayout,
        numbers: &mut [f64],
        scales: &mut [f64],
        place: &mut Unprojected<'_, V>,
        evaluate: &mut impl FnMut(&Unprojected<'_, V>, &mut [f64]) -> bool,
    ) -> Option<()> {
        let threshold = self.reduction_threshold();
        let m = layout.constraints;
        let inertial = self.scales.roundoff_of_rates(place.v[0]);
        for (k, (row, scale)) in rows(layout, numbers).zip(&mut *scales).enumerate() {
            let rate = numbers[layout.rates()][k];
            let at = (&*place.v[0], inertial);
            *scale = share(1.0, self.scales.of_rates(k, row, rate, at));
        }
        let mut left = largest_share(&numbers[layout.rates()], scales);
        let mut is_first = true;
        while !(left <= threshold) {
            if !is_first && !evaluate(place, numbers) {
                return None;
            }
            is_first = false;
            let before = place.v[0].clone();
            let [y, low] = place.level(Level::Rates);
            let moves = &numbers[layout.moves_of_rates()];
            apply(moves, y, low, &mut self.moved[1]);
            for k in 0..m {
                let at = layout.matrix().start + k * layout.coordinates;
                let ends = place.v[0].as_slice().iter().zip(before.as_slice());
                let terms = numbers[at..][..layout.coordinates].iter().zip(ends);
                let change: f64 = terms.map(|(g, (now, before))| g * (now - before)).sum();
                numbers[layout.rates()][k] += change;
            }
            let before = left;
            left = largest_share(&numbers[layout.rates()], scales);
            if !(left <= threshold.max(CONTRACTION * before)) {
                return None;
            }
        }
        Some(())
    }
}

/// The rows of the constraint matrix.
#[inline(always)]
fn rows<'n>(
    layout: &ProjectionLayout,
    numbers: &'n [f64],
) -> impl Iterator<Item = &'n [f64]> + use<'n> {
    numbers[layout.matrix()].chunks_exact(layout.coordinates.max(1))
}

/// Moves coordinates or rates, as compensated sums, and adds the moves to those before.
#[inline(always)]
fn apply<V: Vector>(moves: &[f64], y: &mut V, low: &mut V, moved: &mut V) {
    let (y, low) = (y.as_mut_slice(), low.as_mut_slice());
    let moved = moved.as_mut_slice();
    for (j, by) in moves.iter().enumerate() {
        (y[j], low[j]) = two_sum(y[j], low[j] + by);
        moved[j] += by;
    }
}

/// The largest residual relative to its scale, from the reciprocals of the scales; NaN if one is not a number.
#[inline(always)]
fn largest_share(residuals: &[f64], reciprocals: &[f64]) -> f64 {
    let mut most = 0.0_f64;
    for (left, reciprocal) in residuals.iter().zip(reciprocals) {
        let share = left.abs() * reciprocal;
        if !(share <= most || most.is_nan()) {
            most = share;
        }
    }
    most
}
