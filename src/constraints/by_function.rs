//! Projects states that are nearly on the constraints, such as the ends of steps, by a function of the machine's program.
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

/// The length of the workspace: the numbers of the function, and [`Sizes`] of the rows.
pub(super) const fn workspace(coordinates: usize, constraints: usize) -> usize {
    let layout = ProjectionLayout {
        coordinates,
        constraints,
    };
    layout.len() + 2 * coordinates + 4 * constraints
}

/// What residuals of rows are compared with: one number of each row.
struct Sizes<'w> {
    /// The largest coordinates and rates so far, those of the state before its correction included.
    of: [&'w mut [f64]; 2],
    /// The reciprocals of the scales now, of positions and of rates.
    now: [&'w mut [f64]; 2],
    /// The scales of the guaranteed bound, of positions and of rates.
    guaranteed: [&'w mut [f64]; 2],
}

impl<'w> Sizes<'w> {
    /// In a workspace; `None` if it is too short.
    fn within(workspace: &'w mut [f64], layout: &ProjectionLayout) -> Option<Self> {
        let constraints = layout.constraints;
        let (of, workspace) = workspace.split_at_mut_checked(2 * layout.coordinates)?;
        let of = of.split_at_mut_checked(layout.coordinates)?;
        let (now, guaranteed) = workspace.split_at_mut_checked(2 * constraints)?;
        let now = now.split_at_mut_checked(constraints)?;
        let guaranteed = guaranteed.get_mut(..2 * constraints)?;
        let guaranteed = guaranteed.split_at_mut_checked(constraints)?;
        Some(Self {
            of: [of.0, of.1],
            now: [now.0, now.1],
            guaranteed: [guaranteed.0, guaranteed.1],
        })
    }
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
        let layout = layout_of(system, place.q[0]);
        let are_all_chosen = self.choice.rank == layout.constraints;
        if !are_all_chosen || self.redundant || self.at_fork || self.kept.is_some() {
            return None;
        }
        let length = super::constraint_workspace(layout.coordinates, layout.constraints);
        system.with_workspace(length, |all| {
            // Computed again: where the numbers of coordinates and constraints are constants, so are all places now.
            let layout = layout_of(system, place.q[0]);
            let (numbers, sizes) = all?.split_at_mut_checked(layout.len())?;
            let mut sizes = Sizes::within(sizes, &layout)?;
            let mut evaluate = |place: &Unprojected<'_, V>, numbers: &mut [f64]| {
                let (q, v) = (&*place.q[0], &*place.v[0]);
                matches!(system.projection(place.t, q, v, numbers), Ok(true))
            };
            if !evaluate(place, numbers) {
                return None;
            }
            self.project_from(&layout, numbers, &mut sizes, place, &mut evaluate)
        })
    }

    /// The strength of the weakest row in a pose; `None` if the machine has no function for it, or if rows are dependent there.
    pub(super) fn strength_by_function<S: System<Vector = V>>(
        &self,
        system: &S,
        t: f64,
        q: &V,
    ) -> Option<f64> {
        let layout = layout_of(system, q);
        if self.redundant || self.choice.rank != layout.constraints {
            return None;
        }
        let length = super::constraint_workspace(layout.coordinates, layout.constraints);
        system.with_workspace(length, |all| {
            let layout = layout_of(system, q);
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
        sizes: &mut Sizes<'_>,
        place: &mut Unprojected<'_, V>,
        evaluate: &mut impl FnMut(&Unprojected<'_, V>, &mut [f64]) -> bool,
    ) -> Option<bool> {
        self.reduces_to_roundoff = false;
        let threshold = self.reduction_threshold();
        self.scales
            .write_sizes([&*place.q[0], &*place.v[0]], &mut sizes.of);
        self.measure::<false>(layout, numbers, sizes, place);
        let now = [
            largest_share(&numbers[layout.positions()], sizes.now[0]),
            largest_share(&numbers[layout.rates()], sizes.now[1]),
        ];
        // The negation is true of NaN.
        if !(now[0] < NEAR && now[1] < NEAR) {
            return None;
        }
        let is_moved = !(now[0] <= threshold && now[1] <= threshold);
        if is_moved && !self.holds_tightly(layout, numbers, sizes) {
            return None;
        }
        for moved in &mut self.moved {
            moved.as_mut_slice().fill(0.0);
        }
        self.record_residuals_of_step(now);
        if is_moved {
            self.scales.record_inertias(&numbers[layout.inertias()]);
            let before = [&place.q, &place.v].map(|[high, low]| [(*high).clone(), (*low).clone()]);
            let mut corrected = Some(());
            if now[0] > threshold {
                corrected =
                    self.correct_coordinates(layout, numbers, sizes.now[0], place, evaluate);
            }
            corrected = corrected.and_then(|()| {
                self.measure::<true>(layout, numbers, sizes, place);
                self.correct_rates(layout, numbers, sizes.now[1], place, evaluate)
            });
            if corrected.is_none() {
                let levels = [&mut place.q, &mut place.v];
                for ([high, low], [high_before, low_before]) in levels.into_iter().zip(before) {
                    **high = high_before;
                    **low = low_before;
                }
                return None;
            }
            self.chosen_residuals = [
                largest_share(&numbers[layout.positions()], sizes.now[0]),
                largest_share(&numbers[layout.rates()], sizes.now[1]),
            ];
        } else {
            self.measure::<true>(layout, numbers, sizes, place);
        }
        self.residual = largest_ratio(
            [&numbers[layout.positions()], &numbers[layout.rates()]],
            &sizes.guaranteed,
        );
        for (k, row) in rows(layout, numbers).enumerate() {
            let by_rates = dot(row, place.v[0].as_slice());
            let rate = numbers[layout.rates()][k];
            (self.scales).record_terms(k, row, (rate - by_rates).abs());
        }
        Some(is_moved)
    }

    /// Measures what the residuals of each row are compared with: now, or with `ALL` those of the guaranteed bound as well and of the rates only. Without,
    /// the sums of the terms of positions are in place of their guaranteed scales.
    ///
    /// A correction that is small relative to the scales changes these by as little, so they serve for the residuals after it, too.
    #[inline(always)]
    fn measure<const ALL: bool>(
        &self,
        layout: &ProjectionLayout,
        numbers: &[f64],
        sizes: &mut Sizes<'_>,
        place: &Unprojected<'_, V>,
    ) {
        let v = place.v[0].as_slice();
        let inertial = self.scales.roundoff_of_sizes(sizes.of[1]);
        for (k, row) in rows(layout, numbers).enumerate() {
            let terms = |of: &[f64]| -> f64 {
                let terms = row.iter().zip(of);
                terms.map(|(g, size)| g.abs() * size).sum()
            };
            let positions = terms(sizes.of[0]);
            let by_time = (numbers[layout.rates()][k] - dot(row, v)).abs();
            let of_positions = self.scales.of_position_terms(k, row, positions);
            let of_rates =
                (self.scales).of_rate_terms(k, row, terms(sizes.of[1]) + by_time, inertial);
            sizes.now[1][k] = share(1.0, of_rates.now);
            if ALL {
                sizes.guaranteed[0][k] = of_positions.guaranteed;
                sizes.guaranteed[1][k] = of_rates.guaranteed;
            } else {
                sizes.now[0][k] = share(1.0, of_positions.now);
                sizes.guaranteed[0][k] = positions;
            }
        }
    }

    /// Whether every row is so independent of the others, and so strong in the pose, that residuals need not be reduced to round-off.
    #[inline(always)]
    fn holds_tightly(&self, layout: &ProjectionLayout, numbers: &[f64], sizes: &Sizes<'_>) -> bool {
        let (pivots, compliances) = (&numbers[layout.pivots()], &numbers[layout.compliances()]);
        let mut hold = true;
        for k in 0..layout.constraints {
            let now = sizes.guaranteed[0][k];
            let greatest = self.scales.greatest_terms(k, now);
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
        scales: &[f64],
        place: &mut Unprojected<'_, V>,
        evaluate: &mut impl FnMut(&Unprojected<'_, V>, &mut [f64]) -> bool,
    ) -> Option<()> {
        let threshold = self.reduction_threshold();
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

    /// Corrects the rates until their residuals are reduced; `None` if a correction does not reduce them to a tenth.
    #[inline(always)]
    fn correct_rates(
        &mut self,
        layout: &ProjectionLayout,
        numbers: &mut [f64],
        scales: &[f64],
        place: &mut Unprojected<'_, V>,
        evaluate: &mut impl FnMut(&Unprojected<'_, V>, &mut [f64]) -> bool,
    ) -> Option<()> {
        let threshold = self.reduction_threshold();
        let m = layout.constraints;
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

/// The arrangement of the numbers of a machine.
#[inline(always)]
fn layout_of<S: System>(system: &S, q: &S::Vector) -> ProjectionLayout {
    ProjectionLayout {
        coordinates: q.as_slice().len(),
        constraints: system.constraints().len(),
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

/// The largest residual relative to a scale of its row, of positions or of rates; NaN if one is not a number. Compared by products, so that one division
/// gives it.
#[inline(always)]
fn largest_ratio(residuals: [&[f64]; 2], scales: &[&mut [f64]; 2]) -> f64 {
    let (mut most, mut scale_of_most) = (0.0_f64, 1.0);
    for (residuals, scales) in residuals.into_iter().zip(scales) {
        for (left, scale) in residuals.iter().zip(scales.iter()) {
            let left = left.abs();
            // Each is false of NaN.
            if left == 0.0 || left * scale_of_most <= most * scale {
                continue;
            }
            if left.is_nan() || scale.is_nan() {
                return f64::NAN;
            }
            (most, scale_of_most) = (left, *scale);
        }
    }
    share(most, scale_of_most)
}
