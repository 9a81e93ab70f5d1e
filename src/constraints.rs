//! Constraints in numbers: states are projected onto them, and which of them depend on others is found
//! out.
//!
//! Everything is measured by inertia. With the Cholesky factor `M = L Lᵀ`, a row `Gₖ` becomes the
//! vector `yₖ = L⁻¹ Gₖᵀ`; its length is the acceleration, in the metric of `M`, that a unit of the
//! multiplier gives the machine. Lengths and angles, forces and torques are then of one kind, and how
//! a constraint is scaled (`g = 0` or `2 g = 0`) makes no difference. `M` may be singular where the
//! constraints hold what has no inertia: then `L` is that of `M + Gᵀ W G`, which has the same
//! motion, since the constraints decide `G a`. (E. Eich-Soellner, C. Führer, *Numerical Methods in
//! Multibody Dynamics*, 1998, sections 2.3 and 5.3.)
#![expect(
    clippy::neg_cmp_op_on_partial_ord,
    reason = "what is not a number passes no test here"
)]

pub(crate) mod algebra;
mod choice;
#[cfg(feature = "std")]
mod closest;
mod fork;
#[cfg(feature = "std")]
mod report;
mod scale;
mod start;
mod workspace;

use crate::compensated::two_sum;
use crate::math::sqrt;
use crate::{Singular, StepError, System, Vector};
use algebra::{backward, dot, forward, length, remove, share};
use choice::{Choice, Rank};
#[cfg(feature = "std")]
pub(crate) use closest::{Miss, closest};
use scale::Scales;
use workspace::{Workspace, in_workspace};

/// Residuals are kept below this, relative to their [scale](Scales): 450 times the roundoff of `f64`, of which the constraints
/// themselves lose some.
pub(crate) const RESIDUAL: f64 = 1e-13;

/// Residuals above this are reduced: so what depends on several rows keeps the bound as well.
const WORKED_OFF: f64 = 0.25 * RESIDUAL;

/// The bound of residuals where rows depend on others, or nearly so: which of them are chosen changes on the way, and the residual of
/// those that are not must be as small. Newton's method goes on until rounding stops it.
const WORKED_OFF_REDUNDANT: f64 = 4.0 * f64::EPSILON;

/// What rounding alone may change in a residual, relative: some eight operations from a coordinate
/// to a constraint.
const ROUNDOFF: f64 = 8.0 * f64::EPSILON;

/// A row depends on others if its part that is orthogonal to them is shorter than this, relative to its length.
/// States are on the constraints to [`RESIDUAL`], so rows that depend on each other there do so to
/// about a hundred times that; and a multiplier that is held by less has lost ten of its digits.
const INDEPENDENT: f64 = 1e-10;

/// Beyond the rows that a run had, only those count as independent of which more than this is left: a
/// pose in which rows depend on each other that do not elsewhere is left as soon as it is met.
const INDEPENDENT_AGAIN: f64 = 1e-6;

/// Rows once chosen may come closer to each other before they have to be chosen anew.
const STILL_INDEPENDENT: f64 = 1e-2 * INDEPENDENT;

/// Rows that depend on others are left out, and contradict those if their residual is larger than this.
const CONSISTENT: f64 = 1e-9;

/// Residuals from which whole steps are taken: a step of an integrator is never farther off.
const NEAR: f64 = 1e-3;

/// Newton's method has converged by then, or will not.
const ROUNDS: usize = 50;

/// How many numbers the work on constraints needs, for a machine of so many coordinates and
/// constraints: what [`System::with_workspace`] is asked for.
pub const fn constraint_workspace(coordinates: usize, constraints: usize) -> usize {
    let (n, m) = (coordinates, constraints);
    let rank = if m < n { m } else { n };
    m * n + rank * n + rank * rank + 3 * m + 3 * n
}

/// Accelerations and multipliers at a state, however constraints depend on each other: where some
/// do, the motion is determined nevertheless, and of all multipliers that make it those of least norm
/// are taken, `Σ λₖ² (G M⁻¹ Gᵀ)ₖₖ`. Each reaction counts by the acceleration that it alone would give
/// the machine; so the same constraint stated twice is held in halves, in whatever units it is
/// stated.
///
/// `multipliers` has a number for each constraint. Slower than [`System::accelerations`] and
/// [`System::multipliers`], which do as well where no constraint depends on others.
///
/// # Errors
/// If the machine can move in a way that meets no inertia, or constraints contradict each other.
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
    constraints.check_accelerations(system, (t, q, v, u), a)
}

/// What a run knows of the constraints of its machine.
#[derive(Clone, Debug)]
pub(crate) struct Constraints<V> {
    /// By which residuals are measured.
    scales: Scales<V>,
    /// The rows that are kept; the others follow from them.
    choice: Choice<V>,
    /// Whether there are other rows, which depend on these.
    pub redundant: bool,
    /// Whether the motion passes a pose in which rows come to depend on each other.
    pub at_fork: bool,
    /// Whether rows hold so little where the state is that residuals are worked off to rounding.
    tight: bool,
    /// Coordinates, and rates, that stay as they are while the start is projected onto the constraints:
    /// those that are not 0.
    kept: Option<[V; 2]>,
    /// By how much the last state was moved, coordinates and rates.
    pub moved: [V; 2],
    /// The residuals of the chosen rows at the last state, of positions and rates, relative to their
    /// scale.
    left: [f64; 2],
    /// These residuals at the end of the last step: they are not an error of the next one.
    left_before: [f64; 2],
    /// How much of the move made up for what the step itself was off by; the rest is older.
    pub share: [f64; 2],
    /// The residual of the constraints then, relative to their scale.
    pub residual: f64,
    /// The greatest of these after any step.
    pub greatest_residual: f64,
}

/// A state to be projected onto the constraints, with what rounding took from it.
pub(crate) struct Place<'p, V> {
    pub t: f64,
    pub q: [&'p mut V; 2],
    pub v: [&'p mut V; 2],
}

impl<V: Vector> Constraints<V> {
    /// No rows are chosen yet.
    pub fn new<S: System<Vector = V>>(system: &S, q: &V, v: &V) -> Self {
        let zeros = q.zeros_like();
        Self {
            scales: Scales::new(system, q, v),
            choice: Choice::none(zeros.clone()),
            redundant: false,
            at_fork: false,
            tight: false,
            kept: None,
            moved: [zeros.clone(), zeros],
            left: [0.0; 2],
            left_before: [0.0; 2],
            share: [0.0; 2],
            residual: 0.0,
            greatest_residual: 0.0,
        }
    }

    /// Takes note of a state that was projected onto the constraints.
    pub fn accept(&mut self, q: &V, v: &V) {
        self.scales.accept(q, v);
        self.greatest_residual = self.greatest_residual.max(self.residual);
        self.left_before = self.left;
    }

    /// Chooses the rows anew at a state on the constraints.
    pub fn choose_again<S: System<Vector = V>>(
        &mut self,
        system: &S,
        t: f64,
        q: &V,
    ) -> Result<(), StepError> {
        let rank = match self.choice.rank {
            0 => Rank::Revealed(INDEPENDENT),
            _ => Rank::Followed(INDEPENDENT, INDEPENDENT_AGAIN),
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
            &mut Place {
                t,
                q: [q, q_low],
                v: [v, v_low],
            },
        )?;
        Ok(())
    }

    /// As many rows as before, but those that are best at a state.
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
        self.choice = self.choice.made(system, (t, q), rank, by)?;
        self.redundant = self.choice.rank < system.constraints().len();
        Ok(())
    }

    /// Projects a state onto the constraints by the least move, in the metric of the mass matrix: first
    /// the coordinates, then the rates. Says whether it moved.
    pub fn project<S: System<Vector = V>>(
        &mut self,
        system: &S,
        place: &mut Place<'_, V>,
    ) -> Result<bool, StepError> {
        in_workspace(system, place.t, place.q[0].as_slice().len(), |workspace| {
            let moved =
                self.approach(system, workspace, place, &[Level::Positions, Level::Rates])?;
            self.check(system, workspace, place)?;
            Ok(moved)
        })
    }

    /// Projects on some levels, whatever the residuals of the rows that were not chosen.
    fn approach<S: System<Vector = V>>(
        &mut self,
        system: &S,
        workspace: &mut Workspace<'_, S::Matrix>,
        place: &mut Place<'_, V>,
        levels: &[Level],
    ) -> Result<bool, StepError> {
        let t = place.t;
        self.tight = false;
        for moved in &mut self.moved {
            moved.as_mut_slice().fill(0.0);
        }
        let [positions, rates] = self.left(system, workspace, place);
        self.left = [positions.0, rates.0];
        for (level, roundoff) in self.scales.roundoff().into_iter().enumerate() {
            let before = self.left_before[level] + roundoff;
            let now = self.left[level];
            self.share[level] = if now > before {
                1.0 - before / now
            } else {
                0.0
            };
        }
        if positions.0 <= self.worked_off() && rates.0 <= self.worked_off() {
            return Ok(false);
        }
        if self.redundant && self.kept.is_none() {
            self.choice = self.best_at(system, t, place.q[0])?;
        }
        let all = self.choice.clone();
        let first = levels.first().copied().unwrap_or(Level::Positions);
        let prepared = self.prepare(system, workspace, (t, place.q[0]), first);
        let hold = self.hold_of(&prepared, workspace, place.q[0]);
        self.tight = hold < fork::TIGHT;
        if self.kept.is_none() && hold < fork::WEAK {
            // What holds so little would turn rounding of positions into a move.
            let by = (&self.scales, None);
            let holding = Rank::Holding(fork::WEAK);
            self.choice = all.made(system, (t, place.q[0]), holding, by)?;
            self.prepare(system, workspace, (t, place.q[0]), first)?;
        } else {
            prepared?;
        }
        self.scales.note_metric(workspace.metric.as_slice());
        let mut done = Ok(());
        for level in levels {
            let left = self.left(system, workspace, place)[*level as usize];
            done = done.and_then(|()| self.newton(system, workspace, place, *level, left));
        }
        let [positions, rates] = self.left(system, workspace, place);
        self.choice = all;
        done?;
        self.left = [positions.0, rates.0];
        Ok(true)
    }

    fn worked_off(&self) -> f64 {
        if self.redundant || self.tight {
            WORKED_OFF_REDUNDANT
        } else {
            WORKED_OFF
        }
    }

    /// Newton's method on one level, with the matrices of one state while it contracts.
    ///
    /// Whether it does is judged by the length of the next correction with the same matrices, in the
    /// metric of inertia: *natural monotonicity*, P. Deuflhard, *Newton Methods for Nonlinear
    /// Problems*, 2004, section 3.3.
    fn newton<S: System<Vector = V>>(
        &mut self,
        system: &S,
        workspace: &mut Workspace<'_, S::Matrix>,
        place: &mut Place<'_, V>,
        level: Level,
        (mut left, mut worst): (f64, usize),
    ) -> Result<(), StepError> {
        let at = level as usize;
        let mut fresh = true;
        let mut far = self.distance(workspace, level);
        for _ in 0..ROUNDS {
            if left <= self.worked_off() {
                return Ok(());
            }
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
                (left, worst) = self.left(system, workspace, place)[at];
                near = self.distance(workspace, level);
                // Far from the constraints a whole step may be too long.
                if near <= (1.0 - 0.25 * part) * far || part < 0.01 || left < NEAR {
                    break;
                }
                part *= 0.5;
            }
            for (moved, by) in self.moved[at]
                .as_mut_slice()
                .iter_mut()
                .zip(&*workspace.column)
            {
                *moved += part * by;
            }
            if left <= self.worked_off() {
                return Ok(());
            }
            if fresh && !(near <= (1.0 - 0.125 * part) * far) {
                break;
            }
            fresh = !(near <= 0.1 * far);
            if fresh {
                // Where rows come to depend on each other on the way, there is no way on.
                let at = (place.t, &*place.q[0]);
                if self.prepare(system, workspace, at, level).is_err() {
                    break;
                }
                near = self.distance(workspace, level);
            }
            far = near;
        }
        // It may stand at the roundoff of the constraints themselves.
        for _ in 0..=workspace.m {
            let promised = self.promised(workspace, place, level);
            let last = &*place.level(level)[0];
            if promised.0 <= RESIDUAL
                || (promised.0 <= CONSISTENT && self.scales.is_roundoff(at, workspace.column, last))
            {
                return Ok(());
            }
            (left, worst) = promised;
            if !self.is_rounding(system, workspace, place, level, worst) {
                break;
            }
            let row = &workspace.matrix[worst * workspace.n..][..workspace.n];
            let of_row = match level {
                Level::Positions => workspace.positions[worst],
                Level::Rates => workspace.rates[worst],
            };
            self.scales.note_grain(at, row, of_row);
        }
        Err(StepError::Inconsistent {
            constraint: worst,
            residual: left,
            t: place.t,
        })
    }

    /// Whether the residual of a row is rounding in its evaluation, where the correction in
    /// `workspace.column` did not take it away: along this, the row scatters by as much as the residual,
    /// although its slope is the same.
    fn is_rounding<S: System<Vector = V>>(
        &self,
        system: &S,
        workspace: &mut Workspace<'_, S::Matrix>,
        place: &mut Place<'_, V>,
        level: Level,
        k: usize,
    ) -> bool {
        let n = workspace.n;
        let seen = |workspace: &Workspace<'_, S::Matrix>| {
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
        let (left, slope, length) = seen(workspace);
        workspace
            .before
            .copy_from_slice(place.level(level)[0].as_slice());
        let (mut scatters, mut turns) = (0.0_f64, 0.0_f64);
        for part in [-1.0, -0.5, -0.25, -0.125, 0.125, 0.25, 0.5, 1.0] {
            let y = place.level(level)[0].as_mut_slice().iter_mut();
            for ((y, before), by) in y.zip(&*workspace.before).zip(&*workspace.column) {
                *y = before + part * by;
            }
            self.left(system, workspace, place);
            let (there, slope_there, _) = seen(workspace);
            scatters = scatters.max((there - left - part * slope).abs());
            turns = turns.max((slope_there - slope).abs());
        }
        place.level(level)[0]
            .as_mut_slice()
            .copy_from_slice(workspace.before);
        self.left(system, workspace, place);
        turns <= 1e-3 * length && scatters >= 0.0625 * left.abs()
    }

    /// The greatest residuals of the rows at a state, relative to their scale, and where they are; all
    /// residuals, and the constraint matrix, stay in the workspace.
    fn left<S: System<Vector = V>>(
        &self,
        system: &S,
        workspace: &mut Workspace<'_, S::Matrix>,
        place: &Place<'_, V>,
    ) -> [(f64, usize); 2] {
        let (q, v) = (&*place.q[0], &*place.v[0]);
        system.constraint_positions(place.t, q, workspace.positions);
        system.constraint_rates(place.t, q, v, workspace.rates);
        system.constraint_matrix(place.t, q, workspace.matrix);
        let mut most = [(0.0, 0), (0.0, 0)];
        for k in 0..workspace.m {
            let is_chosen = self.choice.has(k);
            for (most, now) in most.iter_mut().zip(self.relative(workspace, k, q, v)) {
                // Others come nearer with the chosen ones, unless they contradict them.
                if !is_chosen && !(now.now <= CONSISTENT) {
                    continue;
                }
                // What is not a number is the most of all.
                if !(now.now <= most.0) {
                    *most = (now.now, k);
                }
            }
        }
        most
    }

    /// The greatest residual of the chosen rows on one level, relative to what is promised, and where it is.
    fn promised<M>(
        &self,
        workspace: &Workspace<'_, M>,
        place: &Place<'_, V>,
        level: Level,
    ) -> (f64, usize) {
        let mut most = (0.0, 0);
        for chosen in 0..self.choice.rank {
            let k = self.choice.row(chosen);
            let now = self.relative(workspace, k, place.q[0], place.v[0])[level as usize];
            if !(now.promised <= most.0) {
                most = (now.promised, k);
            }
        }
        most
    }

    fn relative<M>(
        &self,
        workspace: &Workspace<'_, M>,
        k: usize,
        q: &V,
        v: &V,
    ) -> [scale::Relative; 2] {
        let row = &workspace.matrix[k * workspace.n..][..workspace.n];
        let left = [workspace.positions[k], workspace.rates[k]];
        self.scales.relative(k, row, left, q, v)
    }

    /// Whether the rows that were not chosen agree with those that were; notes the residual, and the
    /// size of the terms.
    fn check<S: System<Vector = V>>(
        &mut self,
        system: &S,
        workspace: &Workspace<'_, S::Matrix>,
        place: &Place<'_, V>,
    ) -> Result<(), StepError> {
        let (q, v) = (&*place.q[0], &*place.v[0]);
        let mut most = (0.0, 0);
        for (k, _) in system.constraints().enumerate() {
            let [positions, rates] = self.relative(workspace, k, q, v).map(|of| of.promised);
            let now = if positions > rates { positions } else { rates };
            if !(now <= most.0) {
                most = (now, k);
            }
        }
        self.residual = most.0;
        if !(most.0 <= CONSISTENT) {
            return Err(StepError::Inconsistent {
                constraint: most.1,
                residual: most.0,
                t: place.t,
            });
        }
        for (k, row) in workspace
            .matrix
            .chunks_exact(workspace.n.max(1))
            .enumerate()
        {
            let by_rates = dot(row, v.as_slice());
            self.scales
                .note_terms(k, row, (workspace.rates[k] - by_rates).abs());
        }
        Ok(())
    }

    /// Whether accelerations obey the rows that were not chosen, too.
    ///
    /// They are sums of what forces would give and of what constraints take away again, so the residual
    /// is measured by the forces as well: in balance nothing else is there. And they come out of one
    /// elimination that mixes all coordinates, so those that the constraints keep at 0 are as inexact as
    /// the others are, and as what forces would give these, by inertia: `|Gₖ| (|a| + |M⁻¹f|)`, as for rates
    /// in [`scale`].
    pub fn check_accelerations<S: System<Vector = V>>(
        &self,
        system: &S,
        (t, q, v, u): (f64, &V, &V, &S::Inputs),
        a: &V,
    ) -> Result<(), StepError> {
        in_workspace(system, t, q.as_slice().len(), |workspace| {
            system.constraint_matrix(t, q, workspace.matrix);
            system.constraint_drift(t, q, v, workspace.row);
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
                if !(residual <= CONSISTENT) {
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

    /// Factorizes at a pose: metric, basis and triangle of the chosen rows.
    fn prepare<S: System<Vector = V>>(
        &self,
        system: &S,
        workspace: &mut Workspace<'_, S::Matrix>,
        at: (f64, &V),
        level: Level,
    ) -> Result<(), StepError> {
        let fixed = self.kept.as_ref().map(|kept| &kept[level as usize]);
        prepare(system, workspace, at, (&self.choice, fixed))
    }

    /// The least move, in the metric of inertia, that takes the residual of the constraints away to
    /// first order: `−L⁻ᵀ Q R⁻ᵀ g`.
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

    /// How long that move is.
    fn distance<M: Vector>(&self, workspace: &mut Workspace<'_, M>, level: Level) -> f64 {
        let count = self.along_basis(workspace, level);
        length(&workspace.row[..count])
    }

    /// `R⁻ᵀ g` to `row`, for the rows of a level; says how many these are.
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

    /// Accelerations that obey as many rows as were chosen, those that are best at the pose: `z = L⁻¹ f`, and what `z` has along the rows is
    /// replaced by what these ask for. No multiplier is needed.
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
            return self.accelerations_at_fork(system, (t, q, v, u), a);
        }
        self.accelerations_here(system, (t, q, v, u), a)
    }

    fn accelerations_here<S: System<Vector = V>>(
        &self,
        system: &S,
        (t, q, v, u): (f64, &V, &V, &S::Inputs),
        a: &mut V,
    ) -> Result<(), StepError> {
        let choice = self.best_at(system, t, q)?;
        in_workspace(system, t, q.as_slice().len(), |workspace| {
            reactions_along(system, workspace, &choice, (t, q, v, u), a)?;
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

    /// As many rows as were chosen, but those that are best at a pose.
    fn best_at<S: System<Vector = V>>(
        &self,
        system: &S,
        t: f64,
        q: &V,
    ) -> Result<Choice<V>, StepError> {
        if !self.redundant {
            return Ok(self.choice.clone());
        }
        self.choice
            .made(system, (t, q), Rank::Known, (&self.scales, None))
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
        let choice = self.best_at(system, t, q)?;
        in_workspace(system, t, q.as_slice().len(), |workspace| {
            reactions_along(system, workspace, &choice, (t, q, v, u), &mut z)?;
            if workspace.is_lent {
                reactions_of_inertia(system, workspace, choice.rank, (t, q, v, u), &mut z);
            }
            multipliers.fill(0.0);
            workspace.least_norm(multipliers, |j| choice.row(j), choice.rank);
            Ok(())
        })
    }
}

/// Factorizes at a pose, with rows of a choice and coordinates that are fixed.
fn prepare<S: System>(
    system: &S,
    workspace: &mut Workspace<'_, S::Matrix>,
    (t, q): (f64, &S::Vector),
    (choice, fixed): (&Choice<S::Vector>, Option<&S::Vector>),
) -> Result<(), StepError> {
    system.constraint_matrix(t, q, workspace.matrix);
    workspace.fix_rows(fixed);
    workspace.factor(system, t, q, fixed)?;
    let (n, rank) = (workspace.n, choice.rank);
    for j in 0..rank {
        let k = choice.row(j);
        let (known, rest) = workspace.basis.split_at_mut(j * n);
        let new = &mut rest[..n];
        new.copy_from_slice(&workspace.matrix[k * n..][..n]);
        forward(workspace.metric.as_slice(), new);
        let whole = length(new);
        // Twice is enough: W. Kahan in B. N. Parlett, The Symmetric Eigenvalue Problem, 6-9.
        for pass in 0..2 {
            for (i, known) in known.chunks_exact(n).enumerate() {
                let along = remove(known, new);
                let entry = &mut workspace.triangle[i * rank + j];
                *entry = if pass == 0 { along } else { *entry + along };
            }
        }
        let left = length(new);
        if !(left > STILL_INDEPENDENT * whole) {
            let singular = Singular::constraint(k, left * left, whole * whole);
            return Err(StepError::Singular { singular, t });
        }
        new.iter_mut().for_each(|x| *x /= left);
        workspace.triangle[j * rank + j] = left;
    }
    Ok(())
}

/// `z = L⁻¹ f` to `z`, and to `workspace.row` what the reactions add along the basis, `R⁻ᵀ γ − Qᵀ z`.
fn reactions_along<S: System>(
    system: &S,
    workspace: &mut Workspace<'_, S::Matrix>,
    choice: &Choice<S::Vector>,
    (t, q, v, u): (f64, &S::Vector, &S::Vector, &S::Inputs),
    z: &mut S::Vector,
) -> Result<(), StepError> {
    prepare(system, workspace, (t, q), (choice, None))?;
    system.forces(t, q, v, u, z);
    system.constraint_drift(t, q, v, workspace.rates);
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

/// Where `M` is singular and the metric is that of `M + Gᵀ W G`, reactions along the basis are those of accelerations
/// that meet this inertia; put into `workspace.row` in place of them are `M a − f`. `z` is used up.
fn reactions_of_inertia<S: System>(
    system: &S,
    workspace: &mut Workspace<'_, S::Matrix>,
    rank: usize,
    (t, q, v, u): (f64, &S::Vector, &S::Vector, &S::Inputs),
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

/// `R⁻ᵀ row` in place, for the first `count` rows of `rank`.
fn solve_transposed<M>(workspace: &mut Workspace<'_, M>, rank: usize, count: usize) {
    for j in 0..count {
        let mut sum = workspace.row[j];
        for i in 0..j {
            sum -= workspace.triangle[i * rank + j] * workspace.row[i];
        }
        workspace.row[j] = sum / workspace.triangle[j * rank + j];
    }
}

/// Positions or rates.
#[derive(Clone, Copy)]
enum Level {
    Positions = 0,
    Rates = 1,
}

impl<V> Place<'_, V> {
    fn level(&mut self, level: Level) -> [&mut V; 2] {
        let [high, low] = match level {
            Level::Positions => &mut self.q,
            Level::Rates => &mut self.v,
        };
        [high, low]
    }
}
