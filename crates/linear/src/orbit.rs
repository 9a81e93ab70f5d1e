//! Periodic orbits: a start to which the machine returns after a period, and the stability of the orbit.
//!
//! Let Φ(x) be the state that a motion from x reaches one period T later, and Φ_T its rate there. The start of a periodic
//! motion obeys `Φ(x) − x − d = 0`, where d is the amount by which coordinates advance in a period: nothing, or whole turns.
//! Newton's method solves it:
//!
//! ```text
//! (M − 1) δx + Φ_T δT = −(Φ(x) − x − d),   M = ∂Φ/∂x                                  (E55)
//! ```
//!
//! M, the monodromy matrix, comes from the variational equations, which are integrated with the motion. Its eigenvalues are the
//! Floquet multipliers: they multiply small deviations from the motion in each period (E. A. Coddington, N. Levinson, *Theory of
//! Ordinary Differential Equations*, 1955, chapter 3, section 5, and chapter 13, section 2).
//!
//! Where the equations do not depend on time, every state of the orbit is a start, and a machine that conserves energy has an orbit
//! for every energy. (E55) then has many solutions. The search takes the one that moves the start least in the norm given by
//! inertia, `δqᵀ M δq (2π/T)² + δvᵀ M δv`, so neither units nor the choice of coordinates matter. Numbers of the start that are
//! kept do not move at all.
//!
//! A start that obeys constraints moves along them only. It is described by as many numbers as are independent there,
//! coordinates that may be displaced freely and rates ([`crate::reduced`]), and (E55) is written in these numbers: M has a row
//! and a column for each. There are as many multipliers, and they do not depend on the choice of these numbers.
//!
//! A coordinate on which no equation depends need not return: a toy that climbs down its pole, a cart that rolls on. Such a
//! coordinate shifts by the integral of its rate over a period. It is not among the numbers of (E55), but its rate is. A state of
//! first order is the rate of such a coordinate, its integral over time.

mod contacts;
mod family;
mod newton;
mod passage;

use std::fmt;

use lagrangian::interpreted::{InterpretedMachine, Named};
use lagrangian::{Machine, Simulation, State, System};
use lagrangian_program::{Op, Source};
use lagrangian_units::{rate_name, state_of};
use nalgebra::{Complex, DMatrix, DVector};

use crate::chart::Chart;
use crate::search::{MOST_STEPS, Wanted};
use crate::{starts, steady};
pub use family::{Change, Changed, Point, Trace, follow};
use passage::Passage;

/// Which period an orbit should have.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Period {
    /// This period, in s: that of the excitation or a multiple of it; or, in a family of orbits, the period that
    /// selects one of them.
    Given(f64),
    /// A period near this, in s; for machines whose equations do not depend on time.
    Near(f64),
    /// The period after which the motion from the start comes nearest to it; for machines whose equations do
    /// not depend on time.
    Sought,
}

/// Where to search for an orbit.
#[derive(Clone, Debug)]
pub struct Sought {
    /// The initial guess of the start.
    pub start: State<Named>,
    /// Its period.
    pub period: Period,
    /// Which numbers of the start the search must not change: coordinates, then rates.
    pub kept: Vec<bool>,
    /// By how much each coordinate advances in a period.
    pub advance: Vec<f64>,
    /// Which coordinates may advance by any amount; they must be among those of [`shifting`].
    pub shifts: Vec<bool>,
    /// Relative and absolute tolerance of the integration.
    pub tolerance: f64,
}

impl Sought {
    /// A search near a start for an orbit that returns to it, with no number of the start kept.
    pub fn near(start: State<Named>, period: Period) -> Sought {
        let n = start.q.values.len();
        Sought {
            start,
            period,
            kept: vec![false; 2 * n],
            advance: vec![0.0; n],
            shifts: vec![false; n],
            tolerance: 1e-11,
        }
    }
}

/// The coordinates on which no equation of motion depends: the program does not read them for forces, constraints or contacts.
/// Energies and outputs may depend on them. Integrals of states of first order are such coordinates.
pub fn shifting(machine: &InterpretedMachine) -> Vec<bool> {
    let program = machine.program();
    let mut shifts = vec![true; program.dimension()];
    for function in program.functions.iter().filter(|of| !of.role.is_observed()) {
        for op in &function.code {
            if let Op::Read(Source::Coordinate(k)) = op {
                shifts[*k as usize] = false;
            }
        }
    }
    shifts
}

/// A Floquet multiplier: the factor by which one period multiplies a small deviation from the motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Multiplier {
    /// Its value.
    pub value: Complex<f64>,
    /// Bound on the error of the value.
    pub error: f64,
    /// Whether it is 1 because a motion shifted in time is a motion too.
    pub is_trivial: bool,
}

impl Multiplier {
    /// Whether its modulus is above 1, below 1, or within its error of 1. The caller leaves out the trivial one.
    fn side(&self) -> Side {
        match self.value.norm() - 1.0 {
            _ if self.is_trivial => Side::Neither,
            off if off > self.error => Side::Grows,
            off if off < -self.error => Side::Dies,
            _ => Side::Neither,
        }
    }
}

#[derive(Clone, Copy, PartialEq)]
enum Side {
    Grows,
    Dies,
    Neither,
}

/// The stability of an orbit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stability {
    /// All neighbouring motions approach it.
    Attracting,
    /// Some neighbouring motions leave it exponentially.
    Unstable,
    /// Some multipliers are on the unit circle as far as they are known, and none is outside: (E55) does not
    /// decide the stability.
    Undecided,
}

impl Stability {
    /// The name in one word.
    pub fn name(self) -> &'static str {
        match self {
            Stability::Attracting => "stable",
            Stability::Unstable => "unstable",
            Stability::Undecided => "undecided",
        }
    }
}

/// A periodic motion.
#[derive(Clone, Debug)]
pub struct Orbit {
    /// Its start.
    pub start: State<Named>,
    /// Its period, in s.
    pub period: f64,
    /// By how much each coordinate advances in a period: as given, or as found for coordinates that shift.
    pub advance: Vec<f64>,
    /// Which coordinates may advance by any amount.
    pub shifts: Vec<bool>,
    /// The indices of the independent numbers of a state, coordinates, then rates: without constraints all numbers
    /// except those that shift.
    pub states: Vec<usize>,
    /// M, in these numbers.
    pub monodromy: DMatrix<f64>,
    /// Bound on the error of integration in each entry of M.
    pub bounds: DMatrix<f64>,
    /// The multipliers, largest modulus first; of a conjugate pair the one above the real axis first.
    pub multipliers: Vec<Multiplier>,
    /// The largest entry of `Φ(x) − x − d`, each relative to `max(1, |x|)`.
    pub residual: f64,
    /// The dimension of the family of orbits near this one, not counting the phase.
    pub family: usize,
    /// Whether the equations do not change with time.
    pub is_autonomous: bool,
    /// How many times (E55) was solved.
    pub rounds: usize,
}

impl Orbit {
    /// The stability of this orbit.
    pub fn stability(&self) -> Stability {
        let own = || self.multipliers.iter().filter(|one| !one.is_trivial);
        if own().any(|one| one.side() == Side::Grows) {
            Stability::Unstable
        } else if own().all(|one| one.side() == Side::Dies) {
            Stability::Attracting
        } else {
            Stability::Undecided
        }
    }

    /// The number of multipliers outside the unit circle.
    fn outside(&self) -> usize {
        let own = self.multipliers.iter();
        own.filter(|one| one.side() == Side::Grows).count()
    }
}

/// Why no orbit was found.
#[derive(Clone, Debug)]
pub enum NoOrbit {
    /// The machine has a feature for which there are no variational equations; the message names it.
    Refused(String),
    /// The start cannot be projected onto the constraints; why.
    Start(String),
    /// The kept numbers of the start depend on other numbers, or the constraints do not determine rates there.
    Constraints,
    /// The equations depend on time, and no period was given; lists the parameters each of which removes the time
    /// dependence when it is 0.
    Driven(Vec<String>),
    /// The equations depend on time, but not with this period: the named quantity, the acceleration of a coordinate or the rate of
    /// a state, differs one period later.
    OtherPeriod(String, f64),
    /// The equations differ after coordinates have advanced by the given amounts: the named quantity changes.
    OtherPlace(String),
    /// The equations depend on a coordinate that was declared free to shift.
    Depends(String),
    /// The period is not greater than 0 or not finite.
    NoPeriod(f64),
    /// The motion from the start does not return near it.
    NoReturn,
    /// The start is at rest, and so has no period of its own.
    Rest,
    /// A run ended early; why.
    Run(String),
    /// The search stopped at a start that returns only up to this residual, relative to `max(1, |x|)`, after
    /// this many rounds.
    Lost(f64, usize),
    /// The variational equations do not describe how runs differ, as where forces jump (`sign`): the change of the end that they
    /// predict for a change of the start, and the change that runs show, both relative to the size of the change of the start.
    Jump(f64, f64),
    /// The eigenvalue iteration failed.
    Eigenvalues,
}

impl fmt::Display for NoOrbit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            NoOrbit::Refused(why) | NoOrbit::Start(why) => write!(f, "{why}"),
            NoOrbit::Constraints => f.write_str(
                "the constraints do not determine how the start may change: the numbers of it that are kept depend on others, or the \
                 machine is in a singular pose",
            ),
            NoOrbit::Driven(names) => {
                write!(f, "the equations change with time: give a period, that of the drive or a multiple of it")?;
                match names.as_slice() {
                    [] => Ok(()),
                    names => write!(f, "; they do not change if {} = 0", names.join(" = 0, or ")),
                }
            }
            NoOrbit::OtherPeriod(what, period) => write!(
                f,
                "the equations change with time, but not with the period {period} s: a period later, {what} is different"
            ),
            NoOrbit::OtherPlace(what) => write!(
                f,
                "a machine that has advanced by this much is not the same: {what} differs there"
            ),
            NoOrbit::Depends(name) => write!(
                f,
                "the equations depend on `{name}`, so its advance in a period cannot be left open"
            ),
            NoOrbit::NoPeriod(period) => {
                write!(f, "{period} s is not a period: it must be greater than 0")
            }
            NoOrbit::NoReturn => f.write_str(
                "the motion from the start does not come back near it; start nearer to the orbit, or give an estimate of its period",
            ),
            NoOrbit::Rest => f.write_str(
                "the search ended at a state at rest, an equilibrium, or at one that moves steadily, which has no period of its own; \
                 start further away from it, or keep a number of the start",
            ),
            NoOrbit::Run(why) => f.write_str(why),
            NoOrbit::Lost(residual, rounds) => write!(
                f,
                "no orbit was found near the start: after {rounds} iterations the motion returns only to within {residual:.1e}; start \
                 nearer to it, or let the motion settle first if the orbit attracts"
            ),
            NoOrbit::Jump(predicted, found) => write!(
                f,
                "the variational equations do not describe how runs differ ({predicted:.3e} in place of {found:.3e}), as where a force jumps; \
                 make it smooth"
            ),
            NoOrbit::Eigenvalues => f.write_str("the multipliers cannot be found"),
        }
    }
}

impl std::error::Error for NoOrbit {}

/// How many times (E55) is solved at most.
const MOST_ROUNDS: usize = 60;

/// The largest error of the period that is considered, relative to the period.
const MOST_OF_PERIOD: f64 = 1e-3;

/// An orbit counts as closed when its gap is at most this many tolerances of the integration: the errors of
/// some hundred steps.
const CLOSED: f64 = 1e3;

struct Search<'a> {
    machine: &'a InterpretedMachine,
    sought: &'a Sought,
    n: usize,
    /// d, zero for rates.
    advance: DVector<f64>,
    /// Which coordinates are integrals of states of first order.
    is_integral: Vec<bool>,
    /// Which coordinates do not return: these integrals, and those that shift.
    goes_on: Vec<bool>,
}

/// Finds a periodic orbit near a start.
///
/// # Errors
/// Why no orbit was found.
pub fn find(machine: &InterpretedMachine, sought: &Sought) -> Result<Orbit, NoOrbit> {
    let system = machine.prepare();
    if system.contacts().len() > 0 {
        return Err(NoOrbit::Refused(
            "the machine has friction that sticks, which has no variational equations".into(),
        ));
    }
    let n = sought.start.q.values.len();
    if n == 0 {
        return Err(NoOrbit::Rest);
    }
    let mut advance = DVector::zeros(2 * n);
    for (to, from) in advance.iter_mut().zip(&sought.advance) {
        *to = *from;
    }
    let is_integral: Vec<bool> = system
        .coordinates()
        .map(|of| state_of(of.name).is_some())
        .collect();
    let can_shift = shifting(machine);
    let mut wrong = (0..n).filter(|k| sought.shifts[*k] && !can_shift[*k]);
    if let Some(of) = wrong.next().and_then(|k| system.coordinates().nth(k)) {
        return Err(NoOrbit::Depends(of.name.to_owned()));
    }
    let goes_on = is_integral.iter().zip(&sought.shifts);
    let search = Search {
        machine,
        sought,
        n,
        advance,
        goes_on: goes_on.map(|(a, b)| *a || *b).collect(),
        is_integral,
    };
    search.run()
}

impl Search<'_> {
    fn run(&self) -> Result<Orbit, NoOrbit> {
        let drive = self.drives().and_then(|()| {
            if self.walls_move() {
                Err(Vec::new())
            } else {
                Ok(())
            }
        });
        let is_autonomous = drive.is_ok();
        let x = self.state()?;
        if let Err(closed) = self.check_open(&x) {
            // Where the equations do not depend on time, any state of the orbit may serve as its start.
            if !is_autonomous || self.sought.kept.contains(&true) {
                return Err(closed);
            }
            let sought = Sought {
                start: self.find_open_state(&x)?.ok_or(closed)?,
                ..self.sought.clone()
            };
            let search = Search {
                sought: &sought,
                machine: self.machine,
                n: self.n,
                advance: self.advance.clone(),
                is_integral: self.is_integral.clone(),
                goes_on: self.goes_on.clone(),
            };
            let x = search.state()?;
            search.check_open(&x)?;
            return search.search_near(x, drive);
        }
        self.search_near(x, drive)
    }

    /// Searches for an orbit near a start at which no contact is closed.
    fn search_near(
        &self,
        x: DVector<f64>,
        drive: Result<(), Vec<String>>,
    ) -> Result<Orbit, NoOrbit> {
        let is_autonomous = drive.is_ok();
        // This fails early if no independent numbers describe the states near the start.
        self.chart(&x)?;
        let (mut period, is_free) = match (self.sought.period, drive) {
            (Period::Given(period), _) => (period, false),
            (Period::Near(period), Ok(())) => (period, true),
            (Period::Sought, Ok(())) => (self.first_return(&x)?, true),
            (_, Err(names)) => return Err(NoOrbit::Driven(names)),
        };
        if !(period > 0.0 && period.is_finite()) {
            return Err(NoOrbit::NoPeriod(period));
        }
        self.check_invariance(&x, period, is_autonomous)?;
        let (mut x, mut rounds) = self.newton(x, &mut period, is_free, is_autonomous)?;
        if self.sought.period == Period::Sought && self.shorten(&x, &mut period)? {
            let more;
            (x, more) = self.newton(x, &mut period, is_free, is_autonomous)?;
            rounds += more;
        }
        self.check_uncrushed(&x, period)?;
        let tolerance = self.sought.tolerance;
        let chart = &self.chart(&x)?;
        let passage = self.passage(chart, &x, period, tolerance)?;
        self.check_differences(chart, &x, period, &passage)?;
        // With ten times the tolerance the error is about ten times as large or more, so the difference of the two
        // results bounds the error.
        let coarse = self.passage(chart, &x, period, (10.0 * tolerance).min(1e-4))?;
        let size = passage.monodromy.amax();
        let by_integration =
            (&passage.monodromy - &coarse.monodromy).map(|x| x.abs().max(tolerance * size));
        let bounds = if is_autonomous {
            by_integration + self.by_period(chart, (&x, period), [&passage, &coarse])?
        } else {
            by_integration
        };
        let (multipliers, family) = self.multipliers(
            chart,
            &x,
            period,
            (&passage, &bounds),
            (is_autonomous, is_free),
        )?;
        let mut advance = self.sought.advance.clone();
        for k in (0..self.n).filter(|k| self.sought.shifts[*k]) {
            advance[k] = passage.x[k] - x[k];
        }
        Ok(Orbit {
            advance,
            shifts: self.sought.shifts.clone(),
            states: chart.indices().to_vec(),
            residual: self.largest_relative_entry(&self.gap(&x, &passage.x), &x),
            start: self.named(&x),
            period,
            monodromy: passage.monodromy,
            bounds,
            multipliers,
            family,
            is_autonomous,
            rounds,
        })
    }

    /// How much the uncertainty of the period changes M.
    ///
    /// A motion closes up to its gap and to the integration error at its end, and the state may be further along the orbit by this
    /// much. Where M is 1, as for a harmonic motion, no other measure exists, because M − 1 then holds only its own error.
    fn by_period(
        &self,
        chart: &Chart,
        (x, period): (&DVector<f64>, f64),
        [passage, coarse]: [&Passage; 2],
    ) -> Result<DMatrix<f64>, NoOrbit> {
        let scale = self.scale(chart, x, period)?;
        let length = |of: DVector<f64>| (&scale * of).norm();
        let off = length(chart.of(&self.gap(x, &passage.x)))
            + length(chart.of(&(&passage.x - &coarse.x)));
        let later = off / length(passage.rate.clone());
        if !(later > 0.0 && later.is_finite()) {
            return Ok(DMatrix::zeros(chart.size(), chart.size()));
        }
        let later = later.min(MOST_OF_PERIOD * period);
        let there = self.passage(chart, x, period + later, self.sought.tolerance)?;
        Ok((there.monodromy - &passage.monodromy).abs())
    }

    /// Returns an error where the equations depend on time: the parameters that would remove this when set to 0.
    fn drives(&self) -> Result<(), Vec<String>> {
        let v = &self.sought.start.v.values;
        let wanted = Wanted {
            steady: vec![true; self.n],
            solved: vec![false; self.n],
            rates: v.clone(),
            steps: MOST_STEPS,
        };
        steady::drives(self.machine, &self.sought.start.q.values, &wanted)
    }

    /// The start, projected onto the constraints.
    fn state(&self) -> Result<DVector<f64>, NoOrbit> {
        let start = &self.sought.start;
        let all = |state: &State<Named>| {
            let all = state.q.values.iter().chain(&state.v.values);
            DVector::from_iterator(2 * self.n, all.copied())
        };
        let system = self.machine.prepare();
        if system.constraints().len() == 0 {
            return Ok(self.with_lengths(all(start)));
        }
        let mut run = Simulation::new(self.machine).until(start.t);
        let kept = &self.sought.kept;
        if kept.contains(&true) {
            run = run.keep_none();
            for (k, of) in system.coordinates().enumerate() {
                if kept[k] {
                    run = run.keep(of.name);
                }
                if kept[self.n + k] {
                    run = run.keep(&rate_name(of.name, ""));
                }
            }
        }
        let run = run.run_interpreted(start.clone());
        let run = run.map_err(|error| NoOrbit::Start(error.to_string()))?;
        Ok(self.with_lengths(all(run.start())))
    }

    /// The same state with quaternions normalized to length 1, which then stay so. Only the ratios of the four
    /// numbers are part of the motion.
    fn with_lengths(&self, mut x: DVector<f64>) -> DVector<f64> {
        for four in &self.machine.program().quaternions {
            let square: f64 = four.iter().map(|i| x[*i] * x[*i]).sum();
            let along: f64 = four.iter().map(|i| x[*i] * x[self.n + i]).sum();
            let length = square.sqrt();
            for i in four {
                x[self.n + i] = (x[self.n + i] - x[*i] * along / square) / length;
                x[*i] /= length;
            }
        }
        x
    }

    /// The signs with which the quaternion of each frame is nearest to that of the start. A frame that has turned once has the
    /// opposite sign and the same orientation, so the state returns up to these signs, and so do its derivatives.
    fn signs(&self, x: &DVector<f64>, there: &DVector<f64>) -> DVector<f64> {
        let mut signs = DVector::repeat(2 * self.n, 1.0);
        for four in &self.machine.program().quaternions {
            let along: f64 = four.iter().map(|i| x[*i] * there[*i]).sum();
            if along < 0.0 {
                for i in four {
                    (signs[*i], signs[self.n + i]) = (-1.0, -1.0);
                }
            }
        }
        signs
    }

    /// A passage with these signs applied to its end.
    fn signed(&self, chart: &Chart, passage: Passage, signs: &DVector<f64>) -> Passage {
        let own = chart.of(signs);
        let mut monodromy = passage.monodromy;
        for (mut row, sign) in monodromy.row_iter_mut().zip(own.iter()) {
            row *= *sign;
        }
        Passage {
            rate: passage.rate.component_mul(&own),
            x: passage.x.component_mul(signs),
            monodromy,
        }
    }

    /// The chart of independent numbers for states near `x`.
    fn chart(&self, x: &DVector<f64>) -> Result<Chart, NoOrbit> {
        let chart = Chart::at(self.machine, x, &self.sought.kept, &self.goes_on);
        let chart = chart.map_err(|_| NoOrbit::Constraints)?;
        match starts::dependent_constraint(self.machine, &self.named(x)) {
            Some(constraint) => Err(NoOrbit::Refused(format!(
                "the constraint `{constraint}` follows from others, so that accelerations have no derivatives: leave it out"
            ))),
            None => Ok(chart),
        }
    }

    fn named(&self, x: &DVector<f64>) -> State<Named> {
        let mut state = self.sought.start.clone();
        state.q.values.copy_from_slice(&x.as_slice()[..self.n]);
        state.v.values.copy_from_slice(&x.as_slice()[self.n..]);
        state
    }

    /// `Φ(x) − x − d`, with zeros for coordinates that do not return.
    fn gap(&self, x: &DVector<f64>, there: &DVector<f64>) -> DVector<f64> {
        let mut gap = there - x - &self.advance;
        for (gap, goes_on) in gap.iter_mut().zip(&self.goes_on) {
            if *goes_on {
                *gap = 0.0;
            }
        }
        gap
    }

    /// The largest entry, each relative to `max(1, |x|)`.
    fn largest_relative_entry(&self, gap: &DVector<f64>, x: &DVector<f64>) -> f64 {
        let shares = gap.iter().zip(x.iter());
        shares.fold(0.0, |most, (gap, x)| most.max(gap.abs() / x.abs().max(1.0)))
    }

    /// The rate of a state: rates and accelerations.
    fn rate(&self, t: f64, x: &DVector<f64>) -> Option<DVector<f64>> {
        let system = self.machine.prepare();
        let (q, v) = (
            x.as_slice()[..self.n].to_vec(),
            x.as_slice()[self.n..].to_vec(),
        );
        let mut a = vec![0.0; self.n];
        let inputs = system.default_inputs();
        system.accelerations(t, &q, &v, &inputs, &mut a).ok()?;
        let all = v.iter().chain(&a).copied();
        let rate = DVector::from_iterator(2 * self.n, all);
        rate.iter().all(|x| x.is_finite()).then_some(rate)
    }
}
