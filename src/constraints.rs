//! Constraints in numbers: states are brought onto them, and which of them depend on others is found
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

#[cfg(feature = "std")]
use crate::Pivot;
use crate::compensated::two_sum;
use crate::math::sqrt;
use crate::{Singular, StepError, System, Vector};

/// What is left of the constraints is kept below this, relative to their
/// [scale](Constraints::relative): 450 times the roundoff of `f64`, of which the constraints
/// themselves lose some.
pub(crate) const RESIDUAL: f64 = 1e-13;

/// What is left is worked off from here: what depends on several rows keeps the bound as well.
const WORKED_OFF: f64 = 0.25 * RESIDUAL;

/// What rounding alone may change in what is left, relative: some eight operations from a coordinate
/// to a constraint.
const ROUNDOFF: f64 = 8.0 * f64::EPSILON;

/// A row depends on others if less than this is left of it beside them, relative to its length.
/// States are on the constraints to [`RESIDUAL`], so rows that depend on each other there do so to
/// about a hundred times that; and a multiplier that is held by less has lost ten of its digits.
const INDEPENDENT: f64 = 1e-10;

/// The same, far from the constraints, where rows that depend on each other *on* them do so only
/// about as exactly as the state is there.
const INDEPENDENT_AFAR: f64 = 1e-6;

/// Rows once chosen may come closer to each other before they have to be chosen anew.
const STILL_INDEPENDENT: f64 = 1e-2 * INDEPENDENT;

/// Rows that depend on others are left out, and contradict those if more than this is left of them.
const CONSISTENT: f64 = 1e-9;

/// Residuals from which whole steps are taken: a step of an integrator is never farther off.
const NEAR: f64 = 1e-3;

/// Newton's method has converged by then, or will not.
const ROUNDS: usize = 50;

/// How many numbers the work on constraints needs, for a machine of so many coordinates and
/// constraints: what [`System::lend`] is asked for.
pub const fn constraint_room(coordinates: usize, constraints: usize) -> usize {
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
    constraints.choose(system, t, q, Rank::Revealed(INDEPENDENT))?;
    constraints.accelerations(system, t, q, v, u, a)?;
    constraints.multipliers(system, t, q, v, u, multipliers)?;
    constraints.check_accelerations(system, (t, q, v, u), a)
}

/// What a run knows of the constraints of its machine.
#[derive(Clone, Debug)]
pub(crate) struct Constraints<V> {
    /// By which residuals are measured: the greatest `|qⱼ|` and `|vⱼ|` so far.
    sizes: [V; 2],
    /// 1 for a coordinate that is an angle, else 0.
    angles: V,
    /// The indices of rows that are independent, those of positions first. There are no more than
    /// coordinates.
    rows: V,
    /// How many of them there are.
    rank: usize,
    /// How many of them are of positions.
    holonomic: usize,
    /// Whether there are other rows, which depend on these.
    pub redundant: bool,
    /// By how much the last state was moved, coordinates and rates.
    pub moved: [V; 2],
    /// What is left of the chosen rows at the last state, of positions and rates, relative to their
    /// scale.
    left: [f64; 2],
    /// The same at the end of the last step: it is not an error of the next one.
    left_before: [f64; 2],
    /// How much of the move made up for what the step itself was off by; the rest is older.
    pub share: [f64; 2],
    /// What was left of the constraints then, relative to their scale.
    pub residual: f64,
    /// The greatest of these after any step.
    pub greatest_residual: f64,
}

/// How many rows to choose.
#[derive(Clone, Copy)]
enum Rank {
    /// As many as are independent by more than this.
    Revealed(f64),
    /// As many of positions, and as many in all, as were chosen before.
    Known,
}

/// A state to be brought onto the constraints, with what rounding took from it.
pub(crate) struct Place<'p, V> {
    pub t: f64,
    pub q: [&'p mut V; 2],
    pub v: [&'p mut V; 2],
}

/// The room for the work, in parts.
struct Room<'r, M> {
    n: usize,
    m: usize,
    /// `L`, lower triangle, row after row.
    metric: M,
    /// `G`, row after row; while rows are chosen, `yₖ` relative to their lengths.
    matrix: &'r mut [f64],
    /// Orthonormal vectors that span the chosen `yₖ`.
    basis: &'r mut [f64],
    /// `R` of `yⱼ = Σᵢ Rᵢⱼ basisᵢ`, row after row.
    triangle: &'r mut [f64],
    positions: &'r mut [f64],
    rates: &'r mut [f64],
    /// A number for each row.
    row: &'r mut [f64],
    /// A number for each coordinate.
    column: &'r mut [f64],
    before: &'r mut [f64],
    lengths: &'r mut [f64],
}

impl<V: Vector> Constraints<V> {
    /// No rows are chosen yet.
    ///
    /// A coordinate's size is at least 1 if it is an angle, and at the start at least that of any
    /// other of its unit.
    pub fn new<S: System<Vector = V>>(system: &S, q: &V, v: &V) -> Self {
        let zeros = q.zeros_like();
        let mut sizes = [zeros.clone(), zeros.clone()];
        let mut angles = zeros.clone();
        for (j, coordinate) in system.coordinates().enumerate() {
            for (size, of) in sizes.iter_mut().zip([q, v]) {
                let alike = system.coordinates().zip(of.as_slice());
                let alike = alike.filter(|(other, _)| other.unit == coordinate.unit);
                size.as_mut_slice()[j] = alike.fold(0.0, |size, (_, x)| x.abs().max(size));
            }
            if coordinate.unit == "rad" {
                let size = &mut sizes[0].as_mut_slice()[j];
                *size = size.max(1.0);
                angles.as_mut_slice()[j] = 1.0;
            }
        }
        Self {
            sizes,
            angles,
            rows: zeros.clone(),
            rank: 0,
            holonomic: 0,
            redundant: false,
            moved: [zeros.clone(), zeros],
            left: [0.0; 2],
            left_before: [0.0; 2],
            share: [0.0; 2],
            residual: 0.0,
            greatest_residual: 0.0,
        }
    }

    /// Brings the start of a run onto the constraints, and chooses rows there.
    pub fn begin<S: System<Vector = V>>(
        &mut self,
        system: &S,
        place: &mut Place<'_, V>,
    ) -> Result<(), StepError> {
        let mut moved = [place.q[0].zeros_like(), place.q[0].zeros_like()];
        let mut tried = Ok(false);
        for independent in [INDEPENDENT_AFAR, INDEPENDENT, INDEPENDENT] {
            let before = [place.q[0].clone(), place.v[0].clone()];
            self.choose(system, place.t, place.q[0], Rank::Revealed(independent))?;
            tried = self.bring(system, place);
            if tried.is_err() {
                place.q[0].clone_from(&before[0]);
                place.v[0].clone_from(&before[1]);
                continue;
            }
            for (moved, by) in moved.iter_mut().zip(&self.moved) {
                for (moved, by) in moved.as_mut_slice().iter_mut().zip(by.as_slice()) {
                    *moved += by;
                }
            }
            // A row that depends on others only because the state was far off may be missing still.
            if tried == Ok(false) && independent == INDEPENDENT {
                break;
            }
        }
        tried?;
        self.moved = moved;
        self.accept(place.q[0], place.v[0]);
        Ok(())
    }

    /// Takes note of a state that was brought onto the constraints.
    pub fn accept(&mut self, q: &V, v: &V) {
        for (size, of) in self.sizes.iter_mut().zip([q, v]) {
            for (size, x) in size.as_mut_slice().iter_mut().zip(of.as_slice()) {
                *size = size.max(x.abs());
            }
        }
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
        self.choose(system, t, q, Rank::Revealed(INDEPENDENT))
    }

    /// Brings a state between the ends of steps onto the constraints.
    pub fn bring_between<S: System<Vector = V>>(
        &self,
        system: &S,
        t: f64,
        q: &mut V,
        v: &mut V,
    ) -> Result<(), StepError> {
        let mut own = self.clone();
        if own.redundant {
            own.choose_as_many(system, t, q)?;
        }
        let mut low = [q.zeros_like(), v.zeros_like()];
        let [q_low, v_low] = &mut low;
        own.bring(
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
        self.choose(system, t, q, Rank::Known)
    }

    /// Chooses rows that are independent, one after the other, with what is left of each beside those
    /// before it: the first of those that leave a tenth of the most.
    fn choose<S: System<Vector = V>>(
        &mut self,
        system: &S,
        t: f64,
        q: &V,
        rank: Rank,
    ) -> Result<(), StepError> {
        let known = [self.holonomic, self.rank];
        in_room(system, t, q.as_slice().len(), |room| {
            system.constraint_matrix(t, q, room.matrix);
            room.factor(system, t, q)?;
            let n = room.n;
            for row in room.matrix.chunks_exact_mut(n) {
                forward(room.metric.as_slice(), row);
                let length = length(row);
                if length > 0.0 {
                    row.iter_mut().for_each(|x| *x /= length);
                }
            }
            self.rank = 0;
            for (phase, holonomic) in [true, false].into_iter().enumerate() {
                loop {
                    let least = match rank {
                        Rank::Revealed(least) => least.max(room.roundoff()),
                        Rank::Known if self.rank < known[phase] => 0.0,
                        Rank::Known => break,
                    };
                    let mut most = least;
                    let mut chosen = None;
                    for asked in [1.0, 0.1] {
                        let of_kind = system.constraints().enumerate();
                        let of_kind = of_kind.filter(|(_, row)| row.holonomic == holonomic);
                        for (k, _) in of_kind {
                            let left = length(&room.matrix[k * n..][..n]);
                            if asked == 1.0 {
                                most = most.max(left);
                            } else if chosen.is_none() && left > least && left >= asked * most {
                                chosen = Some(k);
                            }
                        }
                    }
                    let Some(k) = chosen.filter(|_| self.rank < n) else {
                        break;
                    };
                    self.take(room, k, least);
                }
                if holonomic {
                    self.holonomic = self.rank;
                }
            }
            self.redundant = self.rank < room.m;
            Ok(())
        })
    }

    /// Adds a row to those chosen, if it is independent by more than `least`, and takes its direction
    /// out of the others.
    fn take<M: Vector>(&mut self, room: &mut Room<'_, M>, k: usize, least: f64) {
        let n = room.n;
        room.column.copy_from_slice(&room.matrix[k * n..][..n]);
        room.matrix[k * n..][..n].fill(0.0);
        // Once more: a direction that little is left of has lost its right angles.
        for known in room.basis[..self.rank * n].chunks_exact(n) {
            remove(known, room.column);
        }
        let left = length(room.column);
        if left <= least {
            return;
        }
        let new = &mut room.basis[self.rank * n..][..n];
        for (new, x) in new.iter_mut().zip(&*room.column) {
            *new = x / left;
        }
        for row in room.matrix.chunks_exact_mut(n) {
            remove(new, row);
        }
        self.rows.as_mut_slice()[self.rank] = k as f64;
        self.rank += 1;
    }

    /// The index of a chosen row.
    fn row(&self, chosen: usize) -> usize {
        // There are far fewer rows than an `f64` counts exactly.
        self.rows.as_slice()[chosen] as usize
    }

    /// Brings a state onto the constraints by the least move, in the metric of the mass matrix: first
    /// the coordinates, then the rates. Says whether it moved.
    pub fn bring<S: System<Vector = V>>(
        &mut self,
        system: &S,
        place: &mut Place<'_, V>,
    ) -> Result<bool, StepError> {
        let t = place.t;
        for moved in &mut self.moved {
            moved.as_mut_slice().fill(0.0);
        }
        in_room(system, t, place.q[0].as_slice().len(), |room| {
            let [positions, rates] = self.left(system, room, place);
            self.left = [positions.0, rates.0];
            for (level, roundoff) in self.roundoff().into_iter().enumerate() {
                let before = self.left_before[level] + roundoff;
                let now = self.left[level];
                self.share[level] = if now > before {
                    1.0 - before / now
                } else {
                    0.0
                };
            }
            let still = positions.0 <= WORKED_OFF && rates.0 <= WORKED_OFF;
            if !still {
                self.prepare(system, room, t, place.q[0])?;
                self.newton(system, room, place, Level::Positions, positions)?;
                let [_, rates] = self.left(system, room, place);
                self.newton(system, room, place, Level::Rates, rates)?;
                let [positions, rates] = self.left(system, room, place);
                self.left = [positions.0, rates.0];
            }
            self.check(system, room, place)?;
            Ok(!still)
        })
    }

    /// What rounding alone may change in what is left of positions and rates, relative to their scale.
    /// The rows that rates go through turn by as much as angles are rounded.
    fn roundoff(&self) -> [f64; 2] {
        let angles = self.angles.as_slice().iter().zip(self.sizes[0].as_slice());
        let greatest = angles.fold(1.0_f64, |most, (is_angle, size)| most.max(is_angle * size));
        [ROUNDOFF, ROUNDOFF * greatest]
    }

    /// Newton's method on one level, with the matrices of one state while it contracts.
    ///
    /// Whether it does is judged by the length of the next correction with the same matrices, in the
    /// metric of inertia: *natural monotonicity*, P. Deuflhard, *Newton Methods for Nonlinear
    /// Problems*, 2004, section 3.3.
    fn newton<S: System<Vector = V>>(
        &mut self,
        system: &S,
        room: &mut Room<'_, S::Matrix>,
        place: &mut Place<'_, V>,
        level: Level,
        (mut left, mut worst): (f64, usize),
    ) -> Result<(), StepError> {
        let at = level as usize;
        let mut fresh = true;
        let mut far = self.distance(room, level);
        for _ in 0..ROUNDS {
            if left <= WORKED_OFF {
                return Ok(());
            }
            self.correction(room, level);
            let mut part = 1.0;
            let mut near;
            loop {
                let [y, low] = place.level(level);
                for (j, by) in room.column.iter().enumerate() {
                    let (y, low) = (&mut y.as_mut_slice()[j], &mut low.as_mut_slice()[j]);
                    if part == 1.0 {
                        room.before[j] = *y;
                    }
                    (*y, *low) = two_sum(room.before[j], *low + part * by);
                }
                (left, worst) = self.left(system, room, place)[at];
                near = self.distance(room, level);
                // Far from the constraints a whole step may be too long.
                if near <= (1.0 - 0.25 * part) * far || part < 0.01 || left < NEAR {
                    break;
                }
                part *= 0.5;
            }
            for (moved, by) in self.moved[at].as_mut_slice().iter_mut().zip(&*room.column) {
                *moved += part * by;
            }
            if left <= WORKED_OFF {
                return Ok(());
            }
            if fresh && !(near <= (1.0 - 0.125 * part) * far) {
                break;
            }
            fresh = !(near <= 0.1 * far);
            if fresh {
                // Where rows come to depend on each other on the way, there is no way on.
                if self.prepare(system, room, place.t, place.q[0]).is_err() {
                    break;
                }
                near = self.distance(room, level);
            }
            far = near;
        }
        // It may stand at the roundoff of the constraints themselves, which only shows in what the
        // last correction was.
        let sizes = self.sizes[at].as_slice();
        let y = place.level(level)[0].as_slice();
        let mut of = room.column.iter().zip(sizes).zip(y);
        let is_roundoff = of.all(|((by, size), y)| by.abs() <= RESIDUAL * size.max(y.abs()));
        if left <= RESIDUAL || (is_roundoff && left <= CONSISTENT) {
            return Ok(());
        }
        Err(StepError::Inconsistent {
            constraint: worst,
            residual: left,
            t: place.t,
        })
    }

    /// What is left of the chosen rows at a state, relative to their scale, and where most; all
    /// residuals, and the constraint matrix, stay in the room.
    fn left<S: System<Vector = V>>(
        &self,
        system: &S,
        room: &mut Room<'_, S::Matrix>,
        place: &Place<'_, V>,
    ) -> [(f64, usize); 2] {
        let (q, v) = (&*place.q[0], &*place.v[0]);
        system.residuals(place.t, q, v, room.positions, room.rates);
        system.constraint_matrix(place.t, q, room.matrix);
        let mut most = [(0.0, 0), (0.0, 0)];
        for chosen in 0..self.rank {
            let k = self.row(chosen);
            for (most, now) in most.iter_mut().zip(self.relative(room, k, q, v)) {
                // What is not a number is the most of all.
                if !(now <= most.0) {
                    *most = (now, k);
                }
            }
        }
        most
    }

    /// What is left of a row, relative to its scale: to `Σⱼ |Gₖⱼ| |qⱼ|` on positions and to
    /// `Σⱼ |Gₖⱼ| |vⱼ| + |∂gₖ/∂t|` on rates, with the greatest `|qⱼ|` and `|vⱼ|` of the run so far
    /// (an angle counts as 1 rad at least). A coordinate or rate that is off by 10⁻¹³ of its
    /// greatest value leaves no more than 10⁻¹³.
    fn relative<M>(&self, room: &Room<'_, M>, k: usize, q: &V, v: &V) -> [f64; 2] {
        let row = &room.matrix[k * room.n..][..room.n];
        let [sizes_q, sizes_v] = [self.sizes[0].as_slice(), self.sizes[1].as_slice()];
        let (mut positions, mut rates, mut by_rates) = (0.0, 0.0, 0.0);
        for (j, g) in row.iter().enumerate() {
            let (q, v) = (q.as_slice()[j], v.as_slice()[j]);
            positions += g.abs() * sizes_q[j].max(q.abs());
            rates += g.abs() * sizes_v[j].max(v.abs());
            by_rates += g * v;
        }
        rates += (room.rates[k] - by_rates).abs();
        [
            share(room.positions[k], positions),
            share(room.rates[k], rates),
        ]
    }

    /// Whether the rows that were not chosen agree with those that were; notes what is left.
    fn check<S: System<Vector = V>>(
        &mut self,
        system: &S,
        room: &Room<'_, S::Matrix>,
        place: &Place<'_, V>,
    ) -> Result<(), StepError> {
        let (q, v) = (&*place.q[0], &*place.v[0]);
        let mut most = (0.0, 0);
        for (k, _) in system.constraints().enumerate() {
            let [positions, rates] = self.relative(room, k, q, v);
            let now = if positions > rates { positions } else { rates };
            if !(now <= most.0) {
                most = (now, k);
            }
        }
        self.residual = most.0;
        if most.0 <= CONSISTENT {
            return Ok(());
        }
        Err(StepError::Inconsistent {
            constraint: most.1,
            residual: most.0,
            t: place.t,
        })
    }

    /// Whether accelerations obey the rows that were not chosen, too.
    ///
    /// They are sums of what forces would give and of what constraints take away again, so what is left
    /// is measured by the forces as well: in balance nothing else is there.
    pub fn check_accelerations<S: System<Vector = V>>(
        &self,
        system: &S,
        (t, q, v, u): (f64, &V, &V, &S::Inputs),
        a: &V,
    ) -> Result<(), StepError> {
        in_room(system, t, q.as_slice().len(), |room| {
            system.constraint_matrix(t, q, room.matrix);
            system.constraint_drift(t, q, v, room.row);
            system.mass_matrix(t, q, &mut room.metric);
            let mut f = a.zeros_like();
            system.forces(t, q, v, u, &mut f);
            let inertias = room.metric.as_slice().iter().step_by(room.n + 1);
            for (free, inertia) in room.column.iter_mut().zip(inertias) {
                *free = if *inertia > 0.0 { 1.0 / inertia } else { 0.0 };
            }
            for (free, f) in room.column.iter_mut().zip(f.as_slice()) {
                *free *= f.abs();
            }
            for (k, row) in room.matrix.chunks_exact(room.n).enumerate() {
                let (mut left, mut scale) = (-room.row[k], room.row[k].abs());
                for ((g, a), free) in row.iter().zip(a.as_slice()).zip(&*room.column) {
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

    /// Factorizes at a state: metric, basis and triangle of the chosen rows.
    fn prepare<S: System<Vector = V>>(
        &self,
        system: &S,
        room: &mut Room<'_, S::Matrix>,
        t: f64,
        q: &V,
    ) -> Result<(), StepError> {
        system.constraint_matrix(t, q, room.matrix);
        room.factor(system, t, q)?;
        let (n, rank) = (room.n, self.rank);
        for j in 0..rank {
            let k = self.row(j);
            let (known, rest) = room.basis.split_at_mut(j * n);
            let new = &mut rest[..n];
            new.copy_from_slice(&room.matrix[k * n..][..n]);
            forward(room.metric.as_slice(), new);
            let whole = length(new);
            // Twice is enough: W. Kahan in B. N. Parlett, The Symmetric Eigenvalue Problem, 6-9.
            for pass in 0..2 {
                for (i, known) in known.chunks_exact(n).enumerate() {
                    let along = remove(known, new);
                    let entry = &mut room.triangle[i * rank + j];
                    *entry = if pass == 0 { along } else { *entry + along };
                }
            }
            let left = length(new);
            if !(left > STILL_INDEPENDENT * whole) {
                let singular = Singular::constraint(k, left * left, whole * whole);
                return Err(StepError::Singular { singular, t });
            }
            new.iter_mut().for_each(|x| *x /= left);
            room.triangle[j * rank + j] = left;
        }
        Ok(())
    }

    /// The least move, in the metric of inertia, that takes what is left of the constraints away to
    /// first order: `−L⁻ᵀ Q R⁻ᵀ g`.
    fn correction<M: Vector>(&self, room: &mut Room<'_, M>, level: Level) {
        let count = self.along_basis(room, level);
        room.column.fill(0.0);
        for (j, along) in room.basis.chunks_exact(room.n).take(count).enumerate() {
            for (x, along) in room.column.iter_mut().zip(along) {
                *x -= room.row[j] * along;
            }
        }
        backward(room.metric.as_slice(), room.column);
    }

    /// How long that move is.
    fn distance<M: Vector>(&self, room: &mut Room<'_, M>, level: Level) -> f64 {
        let count = self.along_basis(room, level);
        length(&room.row[..count])
    }

    /// `R⁻ᵀ g` to `row`, for the rows of a level; says how many these are.
    fn along_basis<M: Vector>(&self, room: &mut Room<'_, M>, level: Level) -> usize {
        let count = match level {
            Level::Positions => self.holonomic,
            Level::Rates => self.rank,
        };
        for j in 0..count {
            let k = self.row(j);
            room.row[j] = match level {
                Level::Positions => room.positions[k],
                Level::Rates => room.rates[k],
            };
        }
        self.solve_transposed(room, count);
        count
    }

    /// `R⁻ᵀ row` in place, for the first `count` rows.
    fn solve_transposed<M>(&self, room: &mut Room<'_, M>, count: usize) {
        for j in 0..count {
            let mut sum = room.row[j];
            for i in 0..j {
                sum -= room.triangle[i * self.rank + j] * room.row[i];
            }
            room.row[j] = sum / room.triangle[j * self.rank + j];
        }
    }

    /// Accelerations that obey the chosen rows: `z = L⁻¹ f`, and what `z` has along the rows is
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
        in_room(system, t, q.as_slice().len(), |room| {
            self.reactions_along(system, room, (t, q, v, u), a)?;
            let metric = room.metric.as_slice();
            for (j, along) in room.basis.chunks_exact(room.n).take(self.rank).enumerate() {
                for (z, along) in a.as_mut_slice().iter_mut().zip(along) {
                    *z += room.row[j] * along;
                }
            }
            backward(metric, a.as_mut_slice());
            Ok(())
        })
    }

    /// `z = L⁻¹ f` to `z`, and to `room.row` what the reactions add along the basis, `R⁻ᵀ γ − Qᵀ z`.
    fn reactions_along<S: System<Vector = V>>(
        &self,
        system: &S,
        room: &mut Room<'_, S::Matrix>,
        (t, q, v, u): (f64, &V, &V, &S::Inputs),
        z: &mut V,
    ) -> Result<(), StepError> {
        self.prepare(system, room, t, q)?;
        system.forces(t, q, v, u, z);
        system.constraint_drift(t, q, v, room.rates);
        for j in 0..self.rank {
            room.row[j] = room.rates[self.row(j)];
        }
        self.solve_transposed(room, self.rank);
        forward(room.metric.as_slice(), z.as_mut_slice());
        for (j, along) in room.basis.chunks_exact(room.n).take(self.rank).enumerate() {
            room.row[j] -= dot(along, z.as_slice());
        }
        Ok(())
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
        in_room(system, t, q.as_slice().len(), |room| {
            self.reactions_along(system, room, (t, q, v, u), &mut z)?;
            multipliers.fill(0.0);
            room.least_norm(multipliers, |j| self.row(j), self.rank);
            Ok(())
        })
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

impl<M: Vector> Room<'_, M> {
    /// Makes `L` at a state; the matrix of the constraints is there already.
    fn factor<S: System<Matrix = M>>(
        &mut self,
        system: &S,
        t: f64,
        q: &S::Vector,
    ) -> Result<(), StepError> {
        let n = self.n;
        system.mass_matrix(t, q, &mut self.metric);
        if cholesky(self.metric.as_mut_slice(), self.lengths).is_ok() {
            return Ok(());
        }
        // Something has no inertia of its own; perhaps the constraints hold it.
        system.mass_matrix(t, q, &mut self.metric);
        let metric = self.metric.as_mut_slice();
        let weights = &mut *self.row;
        weights.fill(0.0);
        loop {
            let mut found = false;
            for (weight, row) in weights.iter_mut().zip(self.matrix.chunks_exact(n)) {
                if *weight > 0.0 {
                    continue;
                }
                // As much inertia along the constraint as there is in any of its coordinates.
                for (j, g) in row.iter().enumerate().filter(|(_, g)| **g != 0.0) {
                    *weight = weight.max(metric[j * n + j] / (g * g));
                }
                if *weight > 0.0 && weight.is_finite() {
                    found = true;
                    for i in 0..n {
                        for j in 0..n {
                            metric[i * n + j] += *weight * row[i] * row[j];
                        }
                    }
                }
            }
            if !found {
                break;
            }
        }
        cholesky(metric, self.lengths).map_err(|singular| StepError::Singular { singular, t })
    }

    /// The greatest error of a vector `L⁻¹ x` by rounding, relative to its length: the roundoff of
    /// `n` operations, times what elimination took from the diagonal.
    fn roundoff(&self) -> f64 {
        let least = self.lengths.iter().fold(1.0, |least: f64, x| least.min(*x));
        8.0 * (self.n + self.m) as f64 * f64::EPSILON / least
    }
}

impl<M: Vector> Room<'_, M> {
    /// From `c`, the reactions along the basis, in `row`: the multipliers `λ` of least norm with
    /// `Σ λₖ yₖ = Σ cⱼ basisⱼ`.
    ///
    /// With rows of length 1, `μₖ = λₖ |yₖ|`, and with those that were not chosen as `X` makes them
    /// of those that were, `μ = [I X]ᵀ (I + X Xᵀ)⁻¹ b` is the least `μ` with `[I X] μ = b`.
    fn least_norm(
        &mut self,
        multipliers: &mut [f64],
        chosen: impl Fn(usize) -> usize,
        rank: usize,
    ) {
        self.combine(&chosen, rank);
        let (n, lengths) = (self.n, &*self.positions);
        // What the chosen rows alone would carry.
        self.column[..rank].copy_from_slice(&self.row[..rank]);
        solve_triangle(self.triangle, rank, self.column);
        for j in 0..rank {
            self.column[j] *= lengths[chosen(j)];
        }
        for i in 0..rank {
            for j in 0..rank {
                let shared = self.matrix.chunks_exact(n).map(|x| x[i] * x[j]);
                let own = if i == j { 1.0 } else { 0.0 };
                self.triangle[i * rank + j] = own + shared.sum::<f64>();
            }
        }
        // At least the unit matrix: nothing stops it.
        let _ = cholesky(&mut self.triangle[..rank * rank], self.lengths);
        forward(&self.triangle[..rank * rank], &mut self.column[..rank]);
        backward(&self.triangle[..rank * rank], &mut self.column[..rank]);
        let rows = self.matrix.chunks_exact(n).zip(lengths);
        for (multiplier, (x, length)) in multipliers.iter_mut().zip(rows) {
            let shared = dot(&x[..rank], &self.column[..rank]);
            *multiplier = if *length > 0.0 { shared / length } else { 0.0 };
        }
        for j in 0..rank {
            let k = chosen(j);
            multipliers[k] = self.column[j] / lengths[k];
        }
    }

    /// Lengths of all rows to `positions`; and for each row `k` that was not chosen, how the chosen
    /// ones make it, `yₖ/|yₖ| = Σⱼ Xⱼₖ yⱼ/|yⱼ|`, to the front of its row of `matrix`. Those of the
    /// chosen are 0.
    fn combine(&mut self, chosen: impl Fn(usize) -> usize, rank: usize) {
        let n = self.n;
        for (row, length_of) in self.matrix.chunks_exact_mut(n).zip(&mut *self.positions) {
            forward(self.metric.as_slice(), row);
            *length_of = length(row);
        }
        for (k, row) in self.matrix.chunks_exact_mut(n).enumerate() {
            let whole = self.positions[k];
            if whole > 0.0 && !(0..rank).any(|j| chosen(j) == k) {
                for (along, basis) in self
                    .column
                    .iter_mut()
                    .zip(self.basis.chunks_exact(n))
                    .take(rank)
                {
                    *along = dot(basis, row);
                }
                solve_triangle(self.triangle, rank, self.column);
                row.fill(0.0);
                for (j, (x, along)) in row.iter_mut().zip(&*self.column).take(rank).enumerate() {
                    *x = along * self.positions[chosen(j)] / whole;
                }
            } else {
                row.fill(0.0);
            }
        }
    }
}

#[cfg(feature = "std")]
impl<V: Vector> Constraints<V> {
    /// For each row that was not chosen, its index and those of the chosen rows that it depends on,
    /// at a state where the rows were chosen.
    pub fn dependences<S: System<Vector = V>>(
        &self,
        system: &S,
        t: f64,
        q: &V,
    ) -> Result<std::vec::Vec<(usize, std::vec::Vec<usize>)>, StepError> {
        use std::vec::Vec;

        // What rounding leaves of 0 beside 1.
        const NOTHING: f64 = 1e-6;
        in_room(system, t, q.as_slice().len(), |room| {
            self.prepare(system, room, t, q)?;
            room.combine(|j| self.row(j), self.rank);
            let is_chosen = |k: usize| (0..self.rank).any(|j| self.row(j) == k);
            let others = room.matrix.chunks_exact(room.n).enumerate();
            let others = others.filter(|(k, _)| !is_chosen(*k));
            let others = others.map(|(k, x)| {
                let on = (0..self.rank).filter(|&j| x[j].abs() > NOTHING);
                let mut on: Vec<usize> = on.map(|j| self.row(j)).collect();
                on.sort_unstable();
                (k, on)
            });
            Ok(others.collect())
        })
    }

    /// The row that has lost most of its hold on the way from one pose to another, and what is left of
    /// it beside the others, relative to what it had; none where it had nothing.
    ///
    /// Where it is 0, rows depend on each other that did not before: more directions are free there than
    /// elsewhere, and branches of the motion may meet.
    pub fn weakest<S: System<Vector = V>>(
        &mut self,
        system: &S,
        before: (f64, &V),
        now: (f64, &V),
    ) -> Result<Option<(usize, f64)>, StepError> {
        self.choose(system, before.0, before.1, Rank::Revealed(INDEPENDENT))?;
        let mut held = before.1.zeros_like();
        let held = held.as_mut_slice();
        in_room(system, before.0, before.1.as_slice().len(), |room| {
            self.prepare(system, room, before.0, before.1)?;
            for (j, held) in held.iter_mut().take(self.rank).enumerate() {
                *held = room.triangle[j * self.rank + j];
            }
            let prepared = self.prepare(system, room, now.0, now.1);
            if let Err(StepError::Singular { singular, .. }) = prepared
                && let Pivot::Constraint(k) = singular.at
            {
                return Ok(Some((k, 0.0)));
            }
            prepared?;
            let left = (0..self.rank).map(|j| {
                let left = room.triangle[j * self.rank + j] / held[j];
                (self.row(j), left)
            });
            Ok(left.min_by(|a, b| a.1.total_cmp(&b.1)))
        })
    }

    /// The size by which a coordinate and its rate are measured.
    pub fn sizes(&self, coordinate: usize) -> [f64; 2] {
        [0, 1].map(|of: usize| self.sizes[of].as_slice()[coordinate])
    }
}

/// Lends the room for the work on constraints, in parts.
fn in_room<S: System, R>(
    system: &S,
    t: f64,
    coordinates: usize,
    work: impl FnOnce(&mut Room<'_, S::Matrix>) -> Result<R, StepError>,
) -> Result<R, StepError> {
    let (n, m) = (coordinates, system.constraints().len());
    let rank = m.min(n);
    system.lend(constraint_room(n, m), |room| {
        let mut rest = room.ok_or(StepError::NoRoom { t })?;
        let mut part = |length: usize| {
            let (part, left) = core::mem::take(&mut rest)
                .split_at_mut_checked(length)
                .ok_or(StepError::NoRoom { t })?;
            rest = left;
            Ok(part)
        };
        work(&mut Room {
            n,
            m,
            metric: S::Matrix::zeros(n * n),
            matrix: part(m * n)?,
            basis: part(rank * n)?,
            triangle: part(rank * rank)?,
            positions: part(m)?,
            rates: part(m)?,
            row: part(m)?,
            column: part(n)?,
            before: part(n)?,
            lengths: part(n)?,
        })
    })
}

/// Cholesky's factorization `L Lᵀ`, to the lower triangle; and to `shares` what is left of each
/// diagonal element, `Lᵢᵢ / √aᵢᵢ`.
fn cholesky(a: &mut [f64], shares: &mut [f64]) -> Result<(), Singular> {
    let n = root(a.len());
    let roundoff = 4.0 * n as f64 * f64::EPSILON;
    for j in 0..n {
        let diagonal = a[j * n + j];
        for i in j..n {
            let mut sum = a[i * n + j];
            for k in 0..j {
                sum -= a[i * n + k] * a[j * n + k];
            }
            if i > j {
                a[i * n + j] = sum / a[j * n + j];
                continue;
            }
            if !(sum > roundoff * diagonal) {
                return Err(Singular::new(j, sum, diagonal));
            }
            a[j * n + j] = sqrt(sum);
            shares[j] = sqrt(sum / diagonal);
        }
    }
    Ok(())
}

/// `L⁻¹ x` in place.
fn forward(l: &[f64], x: &mut [f64]) {
    let n = x.len();
    for i in 0..n {
        let known = dot(&l[i * n..][..i], &x[..i]);
        x[i] = (x[i] - known) / l[i * n + i];
    }
}

/// `L⁻ᵀ x` in place.
fn backward(l: &[f64], x: &mut [f64]) {
    let n = x.len();
    for i in (0..n).rev() {
        let mut sum = x[i];
        for k in i + 1..n {
            sum -= l[k * n + i] * x[k];
        }
        x[i] = sum / l[i * n + i];
    }
}

/// `R⁻¹ x` in place, for the upper triangle `R` of `rank` rows.
fn solve_triangle(r: &[f64], rank: usize, x: &mut [f64]) {
    for i in (0..rank).rev() {
        let known = dot(&r[i * rank..][i + 1..rank], &x[i + 1..rank]);
        x[i] = (x[i] - known) / r[i * rank + i];
    }
}

/// Takes out of `x` what it has along a unit vector, and says how much that was.
fn remove(unit: &[f64], x: &mut [f64]) -> f64 {
    let along = dot(unit, x);
    for (x, unit) in x.iter_mut().zip(unit) {
        *x -= along * unit;
    }
    along
}

fn dot(x: &[f64], y: &[f64]) -> f64 {
    x.iter().zip(y).map(|(x, y)| x * y).sum()
}

fn length(x: &[f64]) -> f64 {
    sqrt(dot(x, x))
}

/// `x` relative to a scale that may be 0.
fn share(x: f64, scale: f64) -> f64 {
    if x == 0.0 { 0.0 } else { x.abs() / scale }
}

/// The number of rows of a square matrix of so many numbers.
fn root(numbers: usize) -> usize {
    numbers.isqrt()
}
