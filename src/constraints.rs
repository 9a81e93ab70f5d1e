//! Projects states onto the constraints, and detects constraints that depend on others.
//!
//! All sizes are in the metric of inertia. With the Cholesky factor `M = L Lᵀ`, a row `Gₖ` becomes the vector `yₖ = L⁻¹ Gₖᵀ`; its length is
//! the acceleration, in the metric of `M`, that a unit of the multiplier gives the machine. This makes lengths and angles, forces and
//! torques comparable, and the scale of a constraint (`g = 0` or `2 g = 0`) has no effect. `M` may be singular if the constraints hold the
//! parts without inertia: then `L` is the factor of `M + Gᵀ W G`, which gives the same motion, since the constraints determine `G a`. (E.
//! Eich-Soellner, C. Führer, *Numerical Methods in Multibody Dynamics*, 1998, sections 2.3 and 5.3.)
#![expect(
    clippy::neg_cmp_op_on_partial_ord,
    reason = "what is not a number passes no test here"
)]

pub(crate) mod algebra;
mod by_function;
mod choice;
#[cfg(feature = "std")]
mod closest;
mod fork;
mod nearby;
mod reactions;
#[cfg(feature = "std")]
mod report;
mod residuals;
mod scale;
mod start;
mod workspace;

use crate::at::At;
use crate::compensated::two_sum;
use crate::math::sqrt;
use crate::{Singular, StepError, System, Vector};
use algebra::{backward, forward, length, remove, share};
use choice::{Choice, Rank};
#[cfg(feature = "std")]
pub(crate) use closest::{Violation, closest};
use reactions::{reactions_along, reactions_of_inertia};
use residuals::{Changed, Residuals};
use scale::Scales;
use workspace::{Workspace, in_workspace};

/// Bound on residuals, relative to their [scale](Scales): 450 times the round-off of `f64`, some of which the evaluation of the
/// constraints uses up.
pub(crate) const RESIDUAL: f64 = 1e-13;

/// Residuals above this are reduced, so that rows that depend on several others satisfy the bound as well.
const REDUCTION_THRESHOLD: f64 = 0.25 * RESIDUAL;

/// The threshold if rows are dependent, or nearly so: the chosen rows change along the motion, and the residuals of the other rows must be as
/// small. Newton's method continues until rounding stops it.
const REDUCTION_THRESHOLD_REDUNDANT: f64 = 4.0 * f64::EPSILON;

/// Relative change of a residual by rounding alone: some eight operations from a coordinate to a constraint.
const ROUNDOFF: f64 = 8.0 * f64::EPSILON;

/// A row depends on others if its component orthogonal to them is shorter than this, relative to its length. States satisfy the constraints
/// to [`RESIDUAL`], so rows that are dependent where the constraints hold exactly are dependent at a state to about a hundred times that;
/// and a multiplier that is held by less has lost ten of its digits.
const INDEPENDENT: f64 = 1e-10;

/// Beyond the rank that a run had so far, rows count as independent only above this value, since a pose in which rows are dependent that
/// are independent elsewhere is left as soon as it is reached.
const INDEPENDENT_BEYOND_RANK: f64 = 1e-6;

/// Chosen rows may come this close to dependence before they are chosen again.
const STILL_INDEPENDENT: f64 = 1e-2 * INDEPENDENT;

/// Dependent rows are left out; they contradict the chosen rows if their residual is larger than this.
const CONTRADICTION: f64 = 1e-9;

/// Below this residual Newton's method takes full steps; the error of an integration step is never larger.
const NEAR: f64 = 1e-3;

/// The number of iterations within which Newton's method converges, if at all.
const MOST_ITERATIONS: usize = 50;

/// The length of the workspace for constraints, for this number of coordinates and constraints: the length that is passed
/// to [`System::with_workspace`].
pub const fn constraint_workspace(coordinates: usize, constraints: usize) -> usize {
    let (n, m) = (coordinates, constraints);
    let rank = if m < n { m } else { n };
    let by_matrices = m * n + rank * n + rank * rank + 3 * m + 3 * n;
    let by_function = by_function::workspace(n, m);
    if by_matrices < by_function {
        by_function
    } else {
        by_matrices
    }
}

/// Accelerations and multipliers at a state, even if constraints are dependent. Then the motion is still determined, and of all multipliers
/// that produce it the ones of least norm are returned, `Σ λₖ² (G M⁻¹ Gᵀ)ₖₖ`. Each reaction is weighted by the acceleration that it alone
/// would give the machine, so a constraint that is stated twice is shared equally, in whatever units each is stated.
///
/// `multipliers` has a number for each constraint. This is slower than [`System::accelerations`] and [`System::multipliers`], which suffice
/// if the constraints are independent.
///
/// # Errors
/// If some motion of the machine meets no inertia, or constraints contradict each other.
pub fn least_multipliers<S: System>(
    system: &S,
    t: f64,
    q: &S::Vector,
    v: &S::Vector,
    u: &S::Inputs,
    a: &mut S::Vector,
    multipliers: &mut [f64],
) -> Result<(), StepError> {
    let mut constraints = Constraints::new(system, q, v);
    constraints.choose_again(system, t, q)?;
    constraints.accelerations(system, t, q, v, u, a)?;
    constraints.multipliers(system, t, q, v, u, multipliers)?;
    constraints.check_accelerations(system, At { t, q, v, u }, a)
}

/// State of the constraints of a machine during a run.
#[derive(Clone, Debug)]
pub(crate) struct Constraints<V> {
    /// The scales of the residuals.
    scales: Scales<V>,
    /// The rows that are enforced; the others follow from them.
    choice: Choice<V>,
    /// Whether there are other rows, which depend on these.
    pub redundant: bool,
    /// The number of all rows.
    #[cfg(feature = "std")]
    rows: usize,
    /// Whether the motion passes a pose in which rows become dependent.
    pub at_fork: bool,
    /// While it does, the strength of the rows at the end of the last step, and the number of steps since such a pose was in reach.
    strength: f64,
    steps_away: u32,
    /// Whether rows are so weak at this state that residuals are reduced to round-off.
    reduces_to_roundoff: bool,
    /// Nonzero for coordinates, and rates, that stay fixed while the start is projected onto the constraints.
    kept: Option<[V; 2]>,
    /// The displacement of the last state, coordinates and rates.
    pub moved: [V; 2],
    /// The residuals of the chosen rows at the last state, of positions and rates, relative to their scale.
    chosen_residuals: [f64; 2],
    /// These residuals at the end of the previous step, which do not count as an error of the next one.
    chosen_residuals_before: [f64; 2],
    /// The fraction of the displacement that corrects the error of the step itself; the rest is older.
    pub own_share: [f64; 2],
    /// The largest residual of the constraints at the last state, relative to their scale.
    pub residual: f64,
    /// The largest of these after any step.
    pub greatest_residual: f64,
}

/// A state to be projected onto the constraints, with the low parts of its compensated sums.
pub(crate) struct Unprojected<'p, V> {
    pub t: f64,
    pub q: [&'p mut V; 2],
    pub v: [&'p mut V; 2],
}

impl<V: Vector> Constraints<V> {
    /// The state at the beginning of a run, before rows are chosen.
    pub fn new<S: System<Vector = V>>(system: &S, q: &V, v: &V) -> Self {
        let zeros = q.zeros_like();
        Self {
            scales: Scales::new(system, q, v),
            choice: Choice::none(zeros.clone()),
            redundant: false,
            #[cfg(feature = "std")]
            rows: system.constraints().len(),
            at_fork: false,
            strength: 0.0,
            steps_away: 0,
            reduces_to_roundoff: false,
            kept: None,
            moved: [zeros.clone(), zeros],
            chosen_residuals: [0.0; 2],
            chosen_residuals_before: [0.0; 2],
            own_share: [0.0; 2],
            residual: 0.0,
            greatest_residual: 0.0,
        }
    }

    /// Records how large the terms of the rate of a row have been.
    #[cfg(feature = "std")]
    pub fn record_rate(&mut self, k: usize, rate: f64) {
        self.scales.record_rate(k, rate);
    }

    /// The rows that are not enforced, since they depend on those that are.
    #[cfg(feature = "std")]
    pub fn dependent(&self) -> impl Iterator<Item = usize> {
        let rows = if self.redundant { self.rows } else { 0 };
        (0..rows).filter(|k| !self.choice.has(*k))
    }

    /// Records a state that was projected onto the constraints.
    pub fn accept(&mut self, q: &V, v: &V) {
        self.scales.accept(q, v);
        self.greatest_residual = self.greatest_residual.max(self.residual);
        self.chosen_residuals_before = self.chosen_residuals;
    }

    /// Chooses the rows again at a state on the constraints.
    pub fn choose_again<S: System<Vector = V>>(
        &mut self,
        system: &S,
        t: f64,
        q: &V,
    ) -> Result<(), StepError> {
        let rank = match self.choice.rank {
            0 => Rank::Revealed(INDEPENDENT),
            _ => Rank::Followed(INDEPENDENT, INDEPENDENT_BEYOND_RANK),
        };
        self.choose(system, t, q, rank)
    }

    /// Projects a state between the ends of steps onto the constraints.
    pub fn project_between<S: System<Vector = V>>(
        &self,
        system: &S,
        t: f64,
        q: &mut V,
        v: &mut V,
    ) -> Result<(), StepError> {
        let mut own = self.clone();
        own.choose_as_many(system, t, q)?;
        let mut low = [q.zeros_like(), v.zeros_like()];
        let [q_low, v_low] = &mut low;
        own.project(
            system,
            &mut Unprojected {
                t,
                q: [q, q_low],
                v: [v, v_low],
            },
        )?;
        Ok(())
    }

    /// Chooses as many rows as before, but those that are best at this state.
    pub fn choose_as_many<S: System<Vector = V>>(
        &mut self,
        system: &S,
        t: f64,
        q: &V,
    ) -> Result<(), StepError> {
        if self.redundant {
            self.choose(system, t, q, Rank::Known)?;
        }
        Ok(())
    }

    fn choose<S: System<Vector = V>>(
        &mut self,
        system: &S,
        t: f64,
        q: &V,
        rank: Rank,
    ) -> Result<(), StepError> {
        let by = (&self.scales, None);
        self.choice = self.choice.choose(system, (t, q), rank, by)?;
        self.redundant = self.choice.rank < system.constraints().len();
        Ok(())
    }

    /// Projects a state onto the constraints by the smallest move in the metric of the mass matrix: first the coordinates, then the rates.
    /// Returns whether it moved.
    pub fn project<S: System<Vector = V>>(
        &mut self,
        system: &S,
        place: &mut Unprojected<'_, V>,
    ) -> Result<bool, StepError> {
        if let Some(moved) = self.project_by_function(system, place) {
            return Ok(moved);
        }
        in_workspace(system, place.t, place.q[0].as_slice().len(), |workspace| {
            let levels = [Level::Positions, Level::Rates];
            let (moved, left) = self.approach(system, workspace, place, &levels)?;
            self.check_redundant_rows(system, workspace, place, left.guaranteed)?;
            Ok(moved)
        })
    }

    /// Projects on some levels, whatever the residuals of the rows that were not chosen. Returns whether the state moved, and the residuals that
    /// are left.
    fn approach<S: System<Vector = V>>(
        &mut self,
        system: &S,
        workspace: &mut Workspace<'_, S::Matrix>,
        place: &mut Unprojected<'_, V>,
        levels: &[Level],
    ) -> Result<(bool, Residuals), StepError> {
        let t = place.t;
        self.reduces_to_roundoff = false;
        for moved in &mut self.moved {
            moved.as_mut_slice().fill(0.0);
        }
        let residuals = self.residuals(system, workspace, place, Changed::All);
        let [positions, rates] = residuals.chosen;
        self.record_residuals_of_step([positions.0, rates.0]);
        if positions.0 <= self.reduction_threshold() && rates.0 <= self.reduction_threshold() {
            return Ok((false, residuals));
        }
        if self.redundant && self.kept.is_none() {
            self.choice = self.best_choice_at(system, t, place.q[0])?;
        }
        let first = levels.first().copied().unwrap_or(Level::Positions);
        let prepared = self.factor(system, workspace, (t, place.q[0]), first);
        let hold = self.strength_after(&prepared, workspace, place.q[0]);
        self.reduces_to_roundoff = hold < fork::TIGHT;
        if !self.reduces_to_roundoff && prepared.is_ok() && levels.len() > 1 {
            self.scales.record_metric(workspace.metric.as_slice());
            if self.approach_nearby(system, workspace, place, self.chosen_residuals)? {
                let residuals = self.residuals(system, workspace, place, Changed::Nothing);
                self.chosen_residuals = residuals.chosen.map(|(left, _)| left);
                return Ok((true, residuals));
            }
        }
        let all = self.choice.clone();
        if self.kept.is_none() && hold < fork::WEAK {
            // Rows this weak would turn round-off of positions into a move.
            let by = (&self.scales, None);
            let holding = Rank::Holding(fork::WEAK);
            self.choice = all.choose(system, (t, place.q[0]), holding, by)?;
            self.factor(system, workspace, (t, place.q[0]), first)?;
        } else {
            prepared?;
        }
        self.scales.record_metric(workspace.metric.as_slice());
        let mut done = Ok(());
        for level in levels {
            let left = self.residual(system, workspace, place, *level, Changed::Nothing);
            done = done.and_then(|()| self.newton(system, workspace, place, *level, left));
        }
        let residuals = self.residuals(system, workspace, place, Changed::Nothing);
        self.choice = all;
        done?;
        self.chosen_residuals = residuals.chosen.map(|(left, _)| left);
        Ok((true, residuals))
    }

    /// Records the residuals at the end of a step before its projection, and the share of them that arose in the step itself.
    #[inline(always)]
    fn record_residuals_of_step(&mut self, residuals: [f64; 2]) {
        self.chosen_residuals = residuals;
        for (level, roundoff) in self.scales.roundoff().into_iter().enumerate() {
            let before = self.chosen_residuals_before[level] + roundoff;
            let now = self.chosen_residuals[level];
            self.own_share[level] = if now > before {
                1.0 - before / now
            } else {
                0.0
            };
        }
    }

    fn reduction_threshold(&self) -> f64 {
        if self.redundant || self.reduces_to_roundoff {
            REDUCTION_THRESHOLD_REDUNDANT
        } else {
            REDUCTION_THRESHOLD
        }
    }

    /// Newton's method on one level. It keeps the matrices of one state while it contracts.
    ///
    /// Contraction is measured by the length of the next correction with the same matrices, in the metric of inertia: *natural
    /// monotonicity*, P. Deuflhard, *Newton Methods for Nonlinear Problems*, 2004, section 3.3.
    fn newton<S: System<Vector = V>>(
        &mut self,
        system: &S,
        workspace: &mut Workspace<'_, S::Matrix>,
        place: &mut Unprojected<'_, V>,
        level: Level,
        residual: (f64, usize),
    ) -> Result<(), StepError> {
        if self.contract(system, workspace, place, level, residual) {
            return Ok(());
        }
        let (mut left, mut worst) = residual;
        // It may have stagnated at the round-off of the constraints themselves.
        let at = level as usize;
        for _ in 0..=workspace.m {
            let guaranteed = self.guaranteed_residual(workspace, place, level);
            let last = &*place.level(level)[0];
            if guaranteed.0 <= RESIDUAL
                || (guaranteed.0 <= CONTRADICTION
                    && self.scales.is_roundoff(at, workspace.column, last))
            {
                return Ok(());
            }
            (left, worst) = guaranteed;
            if !self.is_rounding(system, workspace, place, level, worst) {
                break;
            }
            let row = &workspace.matrix[worst * workspace.n..][..workspace.n];
            let of_row = match level {
                Level::Positions => workspace.positions[worst],
                Level::Rates => workspace.rates[worst],
            };
            self.scales.record_rounding(at, row, of_row);
        }
        Err(StepError::Inconsistent {
            constraint: worst,
            residual: left,
            t: place.t,
        })
    }

    /// Iterates as long as the corrections become shorter; returns whether the residual, which is the greatest one with its row, is below the
    /// threshold then.
    fn contract<S: System<Vector = V>>(
        &mut self,
        system: &S,
        workspace: &mut Workspace<'_, S::Matrix>,
        place: &mut Unprojected<'_, V>,
        level: Level,
        mut residual: (f64, usize),
    ) -> bool {
        let mut fresh = true;
        let mut far = self.distance(workspace, level);
        for _ in 0..MOST_ITERATIONS {
            if residual.0 <= self.reduction_threshold() {
                return true;
            }
            let (part, mut near) =
                self.damped_correction(system, workspace, place, level, far, &mut residual);
            if residual.0 <= self.reduction_threshold() {
                return true;
            }
            if fresh && !(near <= (1.0 - 0.125 * part) * far) {
                break;
            }
            fresh = !(near <= 0.1 * far);
            if fresh {
                // If rows become dependent on the way, the iteration cannot continue.
                let at = (place.t, &*place.q[0]);
                if self.factor(system, workspace, at, level).is_err() {
                    break;
                }
                near = self.distance(workspace, level);
            }
            far = near;
        }
        false
    }

    /// Moves the state by a correction of Newton's method, or by that part of it which makes the next one shorter than `far`. Returns the part and
    /// the length of the next correction.
    fn damped_correction<S: System<Vector = V>>(
        &mut self,
        system: &S,
        workspace: &mut Workspace<'_, S::Matrix>,
        place: &mut Unprojected<'_, V>,
        level: Level,
        far: f64,
        residual: &mut (f64, usize),
    ) -> (f64, f64) {
        let moved = match level {
            Level::Positions => Changed::All,
            Level::Rates => Changed::Rates,
        };
        self.correction(workspace, level);
        let mut part = 1.0;
        let mut near;
        loop {
            let [y, low] = place.level(level);
            for (j, by) in workspace.column.iter().enumerate() {
                let (y, low) = (&mut y.as_mut_slice()[j], &mut low.as_mut_slice()[j]);
                if part == 1.0 {
                    workspace.before[j] = *y;
                }
                (*y, *low) = two_sum(workspace.before[j], *low + part * by);
            }
            *residual = self.residual(system, workspace, place, level, moved);
            near = self.distance(workspace, level);
            // Far from the constraints a full step may be too long.
            if near <= (1.0 - 0.25 * part) * far || part < 0.01 || residual.0 < NEAR {
                break;
            }
            part *= 0.5;
        }
        let corrected = self.moved[level as usize].as_mut_slice().iter_mut();
        for (moved, by) in corrected.zip(&*workspace.column) {
            *moved += part * by;
        }
        (part, near)
    }

    /// Whether the residual of a row that the correction in `workspace.column` did not remove is round-off of its evaluation: along this
    /// correction the row scatters by as much as the residual, while its slope stays the same.
    fn is_rounding<S: System<Vector = V>>(
        &self,
        system: &S,
        workspace: &mut Workspace<'_, S::Matrix>,
        place: &mut Unprojected<'_, V>,
        level: Level,
        k: usize,
    ) -> bool {
        let n = workspace.n;
        let evaluate = |workspace: &Workspace<'_, S::Matrix>| {
            let terms = workspace.matrix[k * n..][..n]
                .iter()
                .zip(&*workspace.column);
            let slope: f64 = terms.clone().map(|(g, by)| g * by).sum();
            let length: f64 = terms.map(|(g, by)| (g * by).abs()).sum();
            let left = match level {
                Level::Positions => workspace.positions[k],
                Level::Rates => workspace.rates[k],
            };
            (left, slope, length)
        };
        let (left, slope, length) = evaluate(workspace);
        workspace
            .before
            .copy_from_slice(place.level(level)[0].as_slice());
        let (mut scatters, mut turns) = (0.0_f64, 0.0_f64);
        for part in [-1.0, -0.5, -0.25, -0.125, 0.125, 0.25, 0.5, 1.0] {
            let y = place.level(level)[0].as_mut_slice().iter_mut();
            for ((y, before), by) in y.zip(&*workspace.before).zip(&*workspace.column) {
                *y = before + part * by;
            }
            self.residuals(system, workspace, place, Changed::All);
            let (there, slope_there, _) = evaluate(workspace);
            scatters = scatters.max((there - left - part * slope).abs());
            turns = turns.max((slope_there - slope).abs());
        }
        place.level(level)[0]
            .as_mut_slice()
            .copy_from_slice(workspace.before);
        self.residuals(system, workspace, place, Changed::All);
        turns <= 1e-3 * length && scatters >= 0.0625 * left.abs()
    }

    /// Checks that accelerations satisfy the rows that were not chosen, too.
    ///
    /// They are sums of the accelerations by forces and of reactions that cancel them, so the residual is also relative to the forces: in
    /// equilibrium nothing else is there. And they come from one elimination that mixes all coordinates, so coordinates that the
    /// constraints keep at 0 are as inexact, in the metric of inertia, as the others and as their accelerations by forces:
    /// `|Gₖ| (|a| + |M⁻¹f|)`, as for rates in [`scale`].
    pub fn check_accelerations<S: System<Vector = V>>(
        &self,
        system: &S,
        At { t, q, v, u }: At<'_, S>,
        a: &V,
    ) -> Result<(), StepError> {
        in_workspace(system, t, q.as_slice().len(), |workspace| {
            system.constraint_matrix(t, q, workspace.matrix);
            system.constraint_bias(t, q, v, workspace.row);
            system.mass_matrix(t, q, &mut workspace.metric);
            let mut f = a.zeros_like();
            system.forces(t, q, v, u, &mut f);
            let inertias = workspace.metric.as_slice().iter().step_by(workspace.n + 1);
            let reciprocal = |inertia: f64| if inertia > 0.0 { 1.0 / inertia } else { 0.0 };
            let mut squares = [0.0_f64; 2];
            let numbers = f.as_slice().iter().zip(a.as_slice()).zip(inertias.clone());
            for (free, ((f, a), inertia)) in workspace.column.iter_mut().zip(numbers) {
                *free = reciprocal(*inertia) * f.abs();
                squares[0] += *free * f.abs();
                squares[1] += a * a * inertia.max(0.0);
            }
            let size = squares.map(sqrt).iter().sum::<f64>();
            for (k, row) in workspace.matrix.chunks_exact(workspace.n).enumerate() {
                let squares = row.iter().zip(inertias.clone());
                let length = sqrt(
                    squares
                        .map(|(g, inertia)| g * g * reciprocal(*inertia))
                        .sum(),
                );
                let (mut left, mut scale) = (-workspace.row[k], workspace.row[k].abs());
                scale += scale::OF_INERTIA * length * size;
                for ((g, a), free) in row.iter().zip(a.as_slice()).zip(&*workspace.column) {
                    left += g * a;
                    scale += (g * a).abs() + g.abs() * free;
                }
                let residual = share(left, scale);
                if !(residual <= CONTRADICTION) {
                    return Err(StepError::Inconsistent {
                        constraint: k,
                        residual,
                        t,
                    });
                }
            }
            Ok(())
        })
    }

    /// Factorizes metric, basis and triangle of the chosen rows at a pose.
    fn prepare<S: System<Vector = V>>(
        &self,
        system: &S,
        workspace: &mut Workspace<'_, S::Matrix>,
        at: (f64, &V),
        level: Level,
    ) -> Result<(), StepError> {
        system.constraint_matrix(at.0, at.1, workspace.matrix);
        self.factor(system, workspace, at, level)
    }

    /// Factorizes them at a pose whose constraint matrix is in the workspace already.
    fn factor<S: System<Vector = V>>(
        &self,
        system: &S,
        workspace: &mut Workspace<'_, S::Matrix>,
        at: (f64, &V),
        level: Level,
    ) -> Result<(), StepError> {
        let fixed = self.kept.as_ref().map(|kept| &kept[level as usize]);
        factor(system, workspace, at, (&self.choice, fixed))
    }

    /// The smallest move, in the metric of inertia, that removes the residual of the constraints to first order: `−L⁻ᵀ Q R⁻ᵀ g`.
    fn correction<M: Vector>(&self, workspace: &mut Workspace<'_, M>, level: Level) {
        let count = self.along_basis(workspace, level);
        workspace.column.fill(0.0);
        for (j, along) in workspace
            .basis
            .chunks_exact(workspace.n)
            .take(count)
            .enumerate()
        {
            for (x, along) in workspace.column.iter_mut().zip(along) {
                *x -= workspace.row[j] * along;
            }
        }
        backward(workspace.metric.as_slice(), workspace.column);
    }

    /// The length of that move.
    fn distance<M: Vector>(&self, workspace: &mut Workspace<'_, M>, level: Level) -> f64 {
        let count = self.along_basis(workspace, level);
        length(&workspace.row[..count])
    }

    /// Writes `R⁻ᵀ g` to `row`, for the rows of a level; returns their number.
    fn along_basis<M: Vector>(&self, workspace: &mut Workspace<'_, M>, level: Level) -> usize {
        let count = match level {
            Level::Positions => self.choice.holonomic,
            Level::Rates => self.choice.rank,
        };
        for j in 0..count {
            let k = self.choice.row(j);
            workspace.row[j] = match level {
                Level::Positions => workspace.positions[k],
                Level::Rates => workspace.rates[k],
            };
        }
        solve_transposed(workspace, self.choice.rank, count);
        count
    }

    /// Accelerations that satisfy as many rows as were chosen, but those that are best at the pose: the components of `z = L⁻¹ f` along the
    /// rows are replaced by the ones that the rows require. This needs no multipliers.
    pub fn accelerations<S: System<Vector = V>>(
        &self,
        system: &S,
        t: f64,
        q: &V,
        v: &V,
        u: &S::Inputs,
        a: &mut V,
    ) -> Result<(), StepError> {
        if self.at_fork {
            return self.accelerations_at_fork(system, At { t, q, v, u }, a);
        }
        self.accelerations_here(system, At { t, q, v, u }, a)
    }

    fn accelerations_here<S: System<Vector = V>>(
        &self,
        system: &S,
        At { t, q, v, u }: At<'_, S>,
        a: &mut V,
    ) -> Result<(), StepError> {
        let choice = self.best_choice_at(system, t, q)?;
        in_workspace(system, t, q.as_slice().len(), |workspace| {
            reactions_along(system, workspace, &choice, At { t, q, v, u }, a)?;
            let metric = workspace.metric.as_slice();
            for (j, along) in workspace
                .basis
                .chunks_exact(workspace.n)
                .take(choice.rank)
                .enumerate()
            {
                for (z, along) in a.as_mut_slice().iter_mut().zip(along) {
                    *z += workspace.row[j] * along;
                }
            }
            backward(metric, a.as_mut_slice());
            Ok(())
        })
    }

    /// A choice of as many rows as were chosen, but those that are best at a pose.
    fn best_choice_at<S: System<Vector = V>>(
        &self,
        system: &S,
        t: f64,
        q: &V,
    ) -> Result<Choice<V>, StepError> {
        if !self.redundant {
            return Ok(self.choice.clone());
        }
        self.choice
            .choose(system, (t, q), Rank::Known, (&self.scales, None))
    }

    /// Multipliers of least norm; see [`least_multipliers`].
    pub fn multipliers<S: System<Vector = V>>(
        &self,
        system: &S,
        t: f64,
        q: &V,
        v: &V,
        u: &S::Inputs,
        multipliers: &mut [f64],
    ) -> Result<(), StepError> {
        let mut z = q.zeros_like();
        let choice = self.best_choice_at(system, t, q)?;
        in_workspace(system, t, q.as_slice().len(), |workspace| {
            reactions_along(system, workspace, &choice, At { t, q, v, u }, &mut z)?;
            if workspace.is_augmented {
                reactions_of_inertia(system, workspace, choice.rank, At { t, q, v, u }, &mut z);
            }
            multipliers.fill(0.0);
            workspace.least_norm(multipliers, |j| choice.row(j), choice.rank);
            Ok(())
        })
    }
}

/// Factorizes at a pose, with chosen rows and fixed coordinates.
fn prepare<S: System>(
    system: &S,
    workspace: &mut Workspace<'_, S::Matrix>,
    (t, q): (f64, &S::Vector),
    (choice, fixed): (&Choice<S::Vector>, Option<&S::Vector>),
) -> Result<(), StepError> {
    system.constraint_matrix(t, q, workspace.matrix);
    factor(system, workspace, (t, q), (choice, fixed))
}

/// Factorizes them at a pose whose constraint matrix is in the workspace already.
fn factor<S: System>(
    system: &S,
    workspace: &mut Workspace<'_, S::Matrix>,
    (t, q): (f64, &S::Vector),
    (choice, fixed): (&Choice<S::Vector>, Option<&S::Vector>),
) -> Result<(), StepError> {
    workspace.fix_rows(fixed);
    workspace.factor(system, t, q, fixed)?;
    find_basis(workspace, choice).map_err(|singular| StepError::Singular { singular, t })
}

/// Computes basis and triangle of the chosen rows in the metric that the workspace holds.
fn find_basis<V: Vector, M: Vector>(
    workspace: &mut Workspace<'_, M>,
    choice: &Choice<V>,
) -> Result<(), Singular> {
    let (n, rank) = (workspace.n, choice.rank);
    for j in 0..rank {
        let k = choice.row(j);
        let (known, rest) = workspace.basis.split_at_mut(j * n);
        let new = &mut rest[..n];
        new.copy_from_slice(&workspace.matrix[k * n..][..n]);
        forward(workspace.metric.as_slice(), new);
        let norm = length(new);
        // Two passes suffice: W. Kahan in B. N. Parlett, The Symmetric Eigenvalue Problem, 6-9.
        for pass in 0..2 {
            for (i, known) in known.chunks_exact(n).enumerate() {
                let along = remove(known, new);
                let entry = &mut workspace.triangle[i * rank + j];
                *entry = if pass == 0 { along } else { *entry + along };
            }
        }
        let left = length(new);
        if !(left > STILL_INDEPENDENT * norm) {
            return Err(Singular::constraint(k, left * left, norm * norm));
        }
        new.iter_mut().for_each(|x| *x /= left);
        workspace.triangle[j * rank + j] = left;
    }
    Ok(())
}

/// Computes `R⁻ᵀ row` in place, for the first `count` rows of `rank`.
fn solve_transposed<M>(workspace: &mut Workspace<'_, M>, rank: usize, count: usize) {
    for j in 0..count {
        let mut sum = workspace.row[j];
        for i in 0..j {
            sum -= workspace.triangle[i * rank + j] * workspace.row[i];
        }
        workspace.row[j] = sum / workspace.triangle[j * rank + j];
    }
}

/// The level of constraints: positions or rates.
#[derive(Clone, Copy)]
enum Level {
    Positions = 0,
    Rates = 1,
}

impl<V> Unprojected<'_, V> {
    fn level(&mut self, level: Level) -> [&mut V; 2] {
        let [high, low] = match level {
            Level::Positions => &mut self.q,
            Level::Rates => &mut self.v,
        };
        [high, low]
    }
}
