//! Newton's method for equation (E55), and the multipliers of the orbit that it finds.

use std::f64::consts::TAU;

use super::passage::Passage;
use super::{CLOSED, MOST_ROUNDS, Multiplier, NoOrbit, Search};
use crate::chart::Chart;
use lagrangian::{Machine, System};
use lagrangian_eigen::poles::poles;
use lagrangian_units::state_of;
use nalgebra::{Complex, DMatrix, DVector};

impl Search<'_> {
    /// S with `|S δx|² = δqᵀ M δq (2π/T)² + δvᵀ M δv` for the independent numbers, where `δv` are the rates at fixed positions.
    /// Where the mass matrix is not positive definite, the sizes of the coordinates are used instead.
    pub(super) fn scale(
        &self,
        chart: &Chart,
        x: &DVector<f64>,
        period: f64,
    ) -> Result<DMatrix<f64>, NoOrbit> {
        let (n, omega) = (self.n, TAU / period);
        let system = self.machine.prepare();
        let mut mass = vec![0.0; n * n];
        let q = x.as_slice()[..n].to_vec();
        system.mass_matrix(self.sought.start.t, &q, &mut mass);
        let mass = DMatrix::from_row_slice(n, n, &mass);
        let spread = chart.spread(self.machine, self.sought.start.t, x);
        let spread = spread.map_err(|_| NoOrbit::Constraints)?;
        let places = chart.indices().iter().filter(|of| **of < n).count();
        let (size, speeds) = (chart.size(), chart.size() - places);
        let factor = |across: DMatrix<f64>| -> DMatrix<f64> {
            let size = across.ncols();
            if size == 0 {
                return DMatrix::zeros(0, 0);
            }
            let mass = match chart.rank() {
                0 if size == n => mass.clone(),
                _ => across.transpose() * &mass * across,
            };
            let factor = mass.cholesky().map(|cholesky| cholesky.l().transpose());
            let factor = factor.filter(|factor| factor.iter().all(|x| x.is_finite()));
            factor.unwrap_or_else(|| DMatrix::identity(size, size))
        };
        let mut scale = DMatrix::zeros(size, size);
        let of_places = factor(spread.view((0, 0), (n, places)).into_owned());
        let of_rates = factor(spread.view((n, places), (n, speeds)).into_owned());
        scale
            .view_mut((0, 0), (places, places))
            .copy_from(&(of_places * omega));
        scale
            .view_mut((places, places), (speeds, speeds))
            .copy_from(&of_rates);
        Ok(scale)
    }

    /// Checks that the equations are the same one period later and after coordinates have advanced.
    pub(super) fn check_invariance(
        &self,
        x: &DVector<f64>,
        period: f64,
        is_autonomous: bool,
    ) -> Result<(), NoOrbit> {
        let system = self.machine.prepare();
        let name = |k: usize| {
            let coordinate = system.coordinates().nth(k);
            let name = coordinate.map_or("?", |coordinate| coordinate.name);
            match state_of(name) {
                Some(state) => format!("the rate of `{state}`"),
                None => format!("the acceleration of `{name}`"),
            }
        };
        let t = self.sought.start.t;
        // States beside the start in generic directions, and times within the period.
        for (k, part) in [0.0, 0.13, 0.31, 0.57, 0.83].into_iter().enumerate() {
            let mut state = x.clone();
            for (j, x) in state.iter_mut().enumerate() {
                let shift = ((3 + 7 * j + 13 * k) * 29 % 97) as f64 / 97.0 - 0.5;
                *x += 0.4 * shift * x.abs().max(1.0);
            }
            let t = t + part * period;
            let Some(here) = self.rate(t, &state) else {
                continue;
            };
            let differs = |there: &DVector<f64>| {
                let size = here.rows(self.n, self.n).amax();
                let off = |k: &usize| (there[self.n + k] - here[self.n + k]).abs();
                // The rounding of the period, or of a turn, changes a phase by as much, and forces may amplify it.
                (0..self.n).find(|k| off(k) > 1e-6 * size)
            };
            // Accelerations are those with all contacts open, and walls must be the same as well.
            let touched = |name: String| format!("what the contact `{name}` touches");
            if !is_autonomous
                && let Some(name) = self.other_contact([(t, &state), (t + period, &state)])
            {
                return Err(NoOrbit::OtherPeriod(touched(name), period));
            }
            if !is_autonomous
                && let Some(k) = self.rate(t + period, &state).as_ref().and_then(differs)
            {
                return Err(NoOrbit::OtherPeriod(name(k), period));
            }
            if self.advance.amax() > 0.0 {
                let there = self.rate(t, &(&state + &self.advance));
                if let Some(k) = there.as_ref().and_then(differs) {
                    return Err(NoOrbit::OtherPlace(name(k)));
                }
                let there = &state + &self.advance;
                if let Some(name) = self.other_contact([(t, &state), (t, &there)]) {
                    return Err(NoOrbit::OtherPlace(touched(name)));
                }
            }
        }
        Ok(())
    }

    /// Newton's method, with steps that are halved where they increase the residual. Returns the start and the
    /// number of times that (E55) was solved.
    pub(super) fn newton(
        &self,
        mut x: DVector<f64>,
        period: &mut f64,
        is_free: bool,
        is_autonomous: bool,
    ) -> Result<(DVector<f64>, usize), NoOrbit> {
        let tolerance = self.sought.tolerance;
        let mut chart = self.chart(&x)?;
        let mut passage = self.passage(&chart, &x, *period, tolerance)?;
        let mut rounds = 0;
        loop {
            let gap = self.gap(&x, &passage.x);
            let scale = self.scale(&chart, &x, *period)?;
            let own_gap = chart.of(&gap);
            let off = (&scale * &own_gap).norm();
            if self.largest_relative_entry(&gap, &x) <= tolerance {
                break;
            }
            let better = (rounds < MOST_ROUNDS).then(|| {
                let (dx, dt) = self.step(&chart, &scale, &passage, &own_gap, is_free)?;
                let mut part = 1.0;
                for _ in 0..MOST_HALVINGS {
                    let t = self.sought.start.t;
                    let next = chart.moved(self.machine, t, &x, &(&dx * part));
                    let length = *period + dt * part;
                    // A step must not halve the period or double it: a vanishing period is no solution, and a
                    // doubled one belongs to another orbit.
                    if let Ok(next) = next
                        && length > 0.5 * *period
                        && length < 2.0 * *period
                    {
                        let there = self.passage(&chart, &next, length, tolerance);
                        if let Ok(there) = there {
                            let off_there = (&scale * chart.of(&self.gap(&next, &there.x))).norm();
                            if off_there < (1.0 - 0.1 * part) * off {
                                return Some((next, length, there));
                            }
                        }
                    }
                    part *= 0.5;
                }
                None
            });
            match better.flatten() {
                Some((next, length, there)) => {
                    (x, *period, passage) = (next, length, there);
                    rounds += 1;
                    let other = self.chart(&x)?;
                    if other.indices() != chart.indices() {
                        passage = self.passage(&other, &x, *period, tolerance)?;
                        chart = other;
                    }
                }
                None if self.largest_relative_entry(&gap, &x) <= CLOSED * tolerance => break,
                None => return Err(NoOrbit::Lost(self.largest_relative_entry(&gap, &x), rounds)),
            }
        }
        // A state at rest returns after any time.
        let scale = self.scale(&chart, &x, *period)?;
        let moves = (&scale * &passage.rate).norm() * *period;
        let size = (&scale * chart.of(&x).map(|x| x.abs().max(1.0))).norm();
        if is_autonomous && self.advance.amax() == 0.0 && moves <= 1e-6 * size {
            Err(NoOrbit::Rest)
        } else {
            Ok((x, rounds))
        }
    }

    /// The smallest change of the start that solves (E55) in the least-squares sense, and the change of the period.
    pub(super) fn step(
        &self,
        chart: &Chart,
        scale: &DMatrix<f64>,
        passage: &Passage,
        gap: &DVector<f64>,
        is_free: bool,
    ) -> Option<(DVector<f64>, f64)> {
        let size = chart.size();
        let is_free_number = |k: &usize| !self.sought.kept[chart.indices()[*k]];
        let free: Vec<usize> = (0..size).filter(is_free_number).collect();
        let columns = DMatrix::from_fn(size, free.len(), |i, j| f64::from(i == free[j]));
        let metric = columns.transpose() * scale.transpose() * scale * &columns;
        let factor = metric.cholesky()?.l().transpose();
        let back = factor.clone().try_inverse()?;
        let change = &passage.monodromy - DMatrix::identity(size, size);
        let mut matrix = scale * change * &columns * &back;
        let mut right = -(scale * gap);
        let rate = scale * &passage.rate;
        let along = (is_free && rate.norm() > 0.0).then(|| &rate / rate.norm());
        if free.is_empty() {
            // When the whole start is kept, only the period is left to solve for.
            let dt = along.map_or(0.0, |along| along.dot(&right) / rate.norm());
            return Some((DVector::zeros(size), dt));
        }
        let (full, whole) = (matrix.clone(), right.clone());
        if let Some(along) = &along {
            // Removes the component that the period takes care of.
            matrix -= along * (along.transpose() * &full);
            right -= along * along.dot(&whole);
        }
        let own = (scale * &passage.monodromy * &columns * &back).amax();
        let svd = matrix.svd(true, true);
        // Where M is 1, M − 1 holds only the error of M.
        let least = NOTHING * svd.singular_values.max().max(own);
        let z = svd.solve(&right, least).ok()?;
        let dt = along.map_or(0.0, |along| along.dot(&(whole - full * &z)) / rate.norm());
        let dx = columns * back * z;
        (dx.iter().all(|x| x.is_finite()) && dt.is_finite()).then_some((dx, dt))
    }

    /// Checks that runs differ as the variational equations predict, along a generic direction.
    pub(super) fn check_differences(
        &self,
        chart: &Chart,
        x: &DVector<f64>,
        period: f64,
        passage: &Passage,
    ) -> Result<(), NoOrbit> {
        let tolerance = self.sought.tolerance;
        let direction = DVector::from_fn(chart.size(), |j, _| {
            (((3 + 7 * j) * 29 % 97) as f64 / 97.0 - 0.4) * x[chart.indices()[j]].abs().max(1.0)
        });
        let direction = &direction / direction.norm();
        let difference = |h: f64| -> Result<DVector<f64>, NoOrbit> {
            let [plus, minus] = [h, -h].map(|h| {
                let t = self.sought.start.t;
                let from = chart.moved(self.machine, t, x, &(&direction * h));
                let from = from.map_err(|_| NoOrbit::Constraints)?;
                self.end(&from, period, tolerance)
            });
            Ok(chart.of(&(plus? - minus?)) / (2.0 * h))
        };
        let [coarse, fine] = [2e-5, 1e-5].map(difference);
        let (coarse, fine) = (coarse?, fine?);
        let predicted = &passage.monodromy * &direction;
        let off = (&predicted - &fine).amax();
        // The error of the finer difference is a third of the difference between the two where it is quadratic in the change; the
        // error of the ends of runs, divided by the change, comes on top.
        let size = passage.monodromy.amax().max(1.0);
        let known = 4.0 * (&coarse - &fine).amax() + CLOSED * tolerance * size / 1e-5;
        let significant = 1e-3 * size;
        if off > known.max(significant) {
            Err(NoOrbit::Jump(predicted.amax(), fine.amax()))
        } else {
            Ok(())
        }
    }

    /// The multipliers, and the dimension of the family of orbits near this one.
    ///
    /// Where the equations do not depend on time, the rate of the state is an eigenvector of the eigenvalue 1. The other
    /// eigenvalues are taken from the complement of this direction: in the whole matrix, where 1 may be a double eigenvalue with
    /// one eigenvector, they would be known only to the square root of its error.
    pub(super) fn multipliers(
        &self,
        chart: &Chart,
        x: &DVector<f64>,
        period: f64,
        (passage, bounds): (&Passage, &DMatrix<f64>),
        (is_autonomous, is_free): (bool, bool),
    ) -> Result<(Vec<Multiplier>, usize), NoOrbit> {
        let size = chart.size();
        let scale = self.scale(chart, x, period)?;
        let back = scale.clone().try_inverse().ok_or(NoOrbit::Eigenvalues)?;
        let scaled = &scale * &passage.monodromy * &back;
        let scaled_bounds = scale.abs() * bounds * back.abs();
        let rate = &scale * &passage.rate;
        let has_phase = is_autonomous && rate.norm() > 0.0;
        let mut multipliers = Vec::new();
        let across = if has_phase {
            let along = &rate / rate.norm();
            let off = (&scaled * &along - &along).norm();
            multipliers.push(Multiplier {
                value: Complex::new(1.0, 0.0),
                error: off,
                is_trivial: true,
            });
            // The first column of Q is the direction of the rate.
            let mut all = DMatrix::identity(size, size);
            let pivot = along.icamax();
            all.swap_columns(0, pivot);
            all.set_column(0, &along);
            all.qr().q().columns(1, size - 1).into_owned()
        } else {
            DMatrix::identity(size, size)
        };
        let rest = across.transpose() * &scaled * &across;
        let rest_bounds = across.abs().transpose() * &scaled_bounds * across.abs();
        let poles_of_rest = poles(&rest, &rest_bounds).ok_or(NoOrbit::Eigenvalues)?;
        let mut rest_multipliers: Vec<Multiplier> = poles_of_rest
            .into_iter()
            .map(|pole| Multiplier {
                value: pole.lambda,
                error: pole.error,
                is_trivial: false,
            })
            .collect();
        rest_multipliers.sort_by(|a, b| {
            let key = |one: &Multiplier| (one.value.norm(), one.value.im);
            let ((a1, a2), (b1, b2)) = (key(a), key(b));
            // Both of a conjugate pair have the same modulus, bit for bit.
            b1.total_cmp(&a1).then(b2.total_cmp(&a2))
        });
        // Changes of the start that (E55) leaves free besides the one along the motion; with a free period, also
        // all that the period may absorb.
        let mut matrix = &scaled - DMatrix::identity(size, size);
        if is_free && rate.norm() > 0.0 {
            let along = &rate / rate.norm();
            matrix -= &along * (along.transpose() * &matrix);
        }
        let values = matrix.svd(false, false).singular_values;
        let least = (NOTHING * values.max()).max(scaled_bounds.norm());
        let open = values.iter().filter(|x| **x <= least).count();
        let own = open.saturating_sub(usize::from(has_phase));
        multipliers.extend(rest_multipliers);
        Ok((multipliers, own))
    }
}

/// How many times a step that increases the residual is halved.
const MOST_HALVINGS: usize = 12;

/// Singular values below this fraction of the largest belong to changes of the start that lead to other orbits.
const NOTHING: f64 = 1e-7;
