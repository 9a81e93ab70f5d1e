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

use std::f64::consts::TAU;
use std::fmt;

use lagrangian::interpreted::{InterpretedMachine, Named, Signals};
use lagrangian::{
    Compliance, ContactMode, Crossing, Machine, Sensitive, Simulation, State, System,
};
use lagrangian_program::{Op, Role, Source};
use lagrangian_units::{rate_name, state_of};
use nalgebra::{Complex, DMatrix, DVector};

use crate::across;
use crate::chart::Chart;
use crate::poles::poles;
use crate::search::{MOST_STEPS, Wanted};
use crate::varied::Direction;
use crate::{starts, steady};

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
    let observes = |role: Role| {
        matches!(
            role,
            Role::KineticEnergy
                | Role::PotentialEnergy
                | Role::StateEnergy
                | Role::Dissipation
                | Role::WorkRate
                | Role::DissipationRate
                | Role::Output(_)
                | Role::Gradient(_)
        )
    };
    for function in program.functions.iter().filter(|of| !observes(of.role)) {
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
        match () {
            () if own().any(|one| one.side() == Side::Grows) => Stability::Unstable,
            () if own().all(|one| one.side() == Side::Dies) => Stability::Attracting,
            () => Stability::Undecided,
        }
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

/// The most steps between two changes of contacts.
const MOST_STEPS_OF_PART: usize = 10_000_000;

/// How many times (E55) is solved at most.
const MOST_ROUNDS: usize = 60;

/// How many times a step that increases the residual is halved.
const MOST_HALVINGS: usize = 12;

/// Singular values below this fraction of the largest belong to changes of the start that lead to other orbits.
const NOTHING: f64 = 1e-7;

/// The largest error of the period that is considered, relative to the period.
const MOST_OF_PERIOD: f64 = 1e-3;

/// An orbit counts as closed when its gap is at most this many tolerances of the integration: the errors of
/// some hundred steps.
const CLOSED: f64 = 1e3;

/// The most steps of a run that should return to its start.
const STEPS_OF_RETURN: usize = 20_000;

/// How many passages of the start such a run may make.
const RETURNS: usize = 24;

/// The most steps of a run that should reach a state at which no contact is closed.
const STEPS_TO_OPEN: usize = 4_000;

/// The result of integrating over one period.
struct Passage {
    /// The state at the end.
    x: DVector<f64>,
    /// M.
    monodromy: DMatrix<f64>,
    /// The rate of the independent numbers at the end.
    rate: DVector<f64>,
}

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

    /// What contacts are at a state: their gaps, their normal and tangential rates, and the coefficients of their laws.
    fn touches(&self, t: f64, q: &[f64], v: &[f64]) -> [Vec<f64>; 3] {
        let system = self.machine.prepare();
        let contacts = system.unilateral_contacts().len();
        let (q, v) = (q.to_vec(), v.to_vec());
        let mut found = [1, 2, 4].map(|numbers| vec![0.0; numbers * contacts]);
        let [gaps, rates, coefficients] = &mut found;
        system.gaps(t, &q, gaps);
        system.contact_rates(t, &q, &v, rates);
        system.contact_coefficients(t, &q, &v, coefficients);
        found
    }

    /// Whether contacts change with time: their walls move, other than a belt does at a constant speed, or the coefficients of their laws change.
    fn walls_move(&self) -> bool {
        let start = &self.sought.start;
        let rest = vec![0.0; self.n];
        let at = |later: f64| {
            let found = self.touches(start.t + later, &start.q.values, &rest);
            found.concat()
        };
        let now = at(0.0);
        let changes =
            |(now, later): (&f64, &f64)| now != later && !(now.is_nan() && later.is_nan());
        [0.37, 1.91, 17.3].into_iter().any(|later| {
            let later = at(later);
            now.iter().zip(&later).any(changes)
        })
    }

    /// The name of a contact that is not the same at two times and states, which have the same rates.
    fn other_contact(&self, places: [(f64, &DVector<f64>); 2]) -> Option<String> {
        // The rounding of the period, or of a turn, changes a phase by as much.
        const SAME: f64 = 1e-6;
        let system = self.machine.prepare();
        let [here, there] = places.map(|(t, x)| {
            let (q, v) = x.as_slice().split_at(self.n);
            self.touches(t, q, v)
        });
        let largest = |of: &[f64]| of.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        // Gaps are lengths, and rates speeds; coefficients have nothing in common.
        let sizes = [Some(largest(&here[0])), Some(largest(&here[1])), None];
        let mut kinds = here.iter().zip(&there).zip(sizes);
        let contact = kinds.find_map(|((here, there), size)| {
            let differs = |(here, there): (&f64, &f64)| {
                (here - there).abs() > SAME * size.unwrap_or(here.abs().max(there.abs()))
            };
            let at = here.iter().zip(there).position(differs)?;
            Some(at * system.unilateral_contacts().len() / here.len())
        })?;
        let contact = system.unilateral_contacts().nth(contact)?;
        Some(contact.name.to_owned())
    }

    /// Checks that no contact is closed at the start: only there do neighbouring states differ in every
    /// number of the state.
    fn check_open(&self, x: &DVector<f64>) -> Result<(), NoOrbit> {
        let system = self.machine.prepare();
        let mut gaps = vec![0.0; system.unilateral_contacts().len()];
        let q = x.as_slice()[..self.n].to_vec();
        system.gaps(self.sought.start.t, &q, &mut gaps);
        let mut contacts = system.unilateral_contacts().zip(&gaps);
        match contacts.find(|(_, gap)| **gap <= 0.0) {
            Some((contact, _)) => Err(NoOrbit::Refused(format!(
                "the contact `{}` is closed where the period begins, at the start or where the search has led: start from a state of \
                 the orbit at which no contact is closed",
                contact.name
            ))),
            None => Ok(()),
        }
    }

    /// Checks that the motion crushes no layer. A run begins with layers that nothing has crushed yet, and what is crushed stays so: the depth of a
    /// layer does not return, even if coordinates and rates do, and the next period is another motion.
    fn check_uncrushed(&self, x: &DVector<f64>, period: f64) -> Result<(), NoOrbit> {
        let system = self.machine.prepare();
        let mut contacts = system.unilateral_contacts();
        if !contacts.any(|contact| contact.compliance == Some(Compliance::Layer)) {
            return Ok(());
        }
        let start = self.named(x);
        let run = Simulation::new(self.machine)
            .tolerance(self.sought.tolerance)
            .until(start.t + period)
            .run_interpreted(start)
            .map_err(|error| NoOrbit::Run(error.to_string()))?;
        let works = run.crushing_work();
        let mut contacts = system.unilateral_contacts().zip(works);
        match contacts.find(|(_, work)| *work > 0.0) {
            Some((contact, work)) => Err(NoOrbit::Refused(format!(
                "the motion crushes the layer of `{}` by {work:.3e} J in a period, so that it does not return to its start, where nothing is crushed \
                 yet; once nothing more is crushed, the layer is a spring that pushes: give it `linear(k2, 0)` behind the thickness that is lost",
                contact.name
            ))),
            None => Ok(()),
        }
    }

    /// A state on the motion from `x` at which no contact is closed, shifted to the time of the start: the middle of the
    /// longest such interval within a period or, where the period is not known, within a limited number of steps. `None`
    /// where there is none.
    fn find_open_state(&self, x: &DVector<f64>) -> Result<Option<State<Named>>, NoOrbit> {
        let failed = |error: lagrangian::Error| NoOrbit::Run(error.to_string());
        let start = self.named(x);
        let t = start.t;
        let until = match self.sought.period {
            Period::Given(period) | Period::Near(period) => t + period,
            Period::Sought => t + 1e9,
        };
        let (run, _) = Simulation::new(self.machine)
            .tolerance(self.sought.tolerance)
            .max_steps(STEPS_TO_OPEN)
            .until(until)
            .run_interpreted_as_far_as_possible(start)
            .map_err(failed)?;
        let phases: Vec<(f64, bool)> = run
            .contact_phases()
            .map(|phase| {
                let is_open = phase.modes.iter().all(|mode| *mode == ContactMode::Open);
                (phase.since, is_open)
            })
            .collect();
        // The last phase has no end.
        let ended = phases.windows(2).filter(|pair| pair[0].1);
        let spans = ended.map(|pair| (pair[0].0, pair[1].0));
        let longest = spans.max_by(|a, b| (a.1 - a.0).total_cmp(&(b.1 - b.0)));
        let Some((from, to)) = longest.filter(|(from, to)| to > from) else {
            return Ok(None);
        };
        let state = run.at(0.5 * (from + to)).map_err(failed)?;
        Ok(Some(State { t, ..state }))
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

    /// The state a period later, without derivatives.
    fn end(&self, x: &DVector<f64>, period: f64, tolerance: f64) -> Result<DVector<f64>, NoOrbit> {
        let start = self.named(x);
        let run = Simulation::new(self.machine)
            .tolerance(tolerance)
            .until(start.t + period)
            .forget_steps()
            .run_interpreted(start);
        let run = run.map_err(|error| NoOrbit::Run(error.to_string()))?;
        let end = run.end();
        let all = end.q.values.iter().chain(&end.v.values).copied();
        let there = DVector::from_iterator(2 * self.n, all);
        let signs = self.signs(x, &there);
        Ok(there.component_mul(&signs))
    }

    /// The state a period later, with derivatives.
    fn passage(
        &self,
        chart: &Chart,
        x: &DVector<f64>,
        period: f64,
        tolerance: f64,
    ) -> Result<Passage, NoOrbit> {
        let passage = self.unsigned_passage(chart, x, period, tolerance)?;
        let signs = self.signs(x, &passage.x);
        Ok(self.signed(chart, passage, &signs))
    }

    /// The same, with the signs of quaternions as the run produced them.
    fn unsigned_passage(
        &self,
        chart: &Chart,
        x: &DVector<f64>,
        period: f64,
        tolerance: f64,
    ) -> Result<Passage, NoOrbit> {
        let failed = |error: lagrangian::Error| NoOrbit::Run(error.to_string());
        let n = self.n;
        let system = self.machine.prepare();
        if system.unilateral_contacts().len() > 0 {
            return self.passage_with_contacts(chart, x, period, tolerance);
        }
        let names: Vec<&str> = system.coordinates().map(|of| of.name).collect();
        let mut sensitive = Sensitive::new(self.machine).with_start_on_constraints();
        for &of in chart.indices() {
            sensitive = if of < n {
                sensitive.by_start(names[of])
            } else {
                sensitive.by_start_rate(names[of - n])
            }
            .map_err(failed)?;
        }
        let mut start = sensitive.start_from(self.named(x));
        let t = start.t + period;
        let spread = chart.spread(self.machine, start.t, x);
        let spread = spread.map_err(|_| NoOrbit::Constraints)?;
        for (k, column) in spread.column_iter().enumerate() {
            let (q, v) = (&mut start.q.by[k].values, &mut start.v.by[k].values);
            q.copy_from_slice(&column.as_slice()[..n]);
            v.copy_from_slice(&column.as_slice()[n..]);
        }
        let run = Simulation::new(&sensitive)
            .tolerance(tolerance)
            .until(t)
            .forget_steps()
            .run_interpreted(start)
            .map_err(failed)?;
        let (q, v) = (&run.end().q, &run.end().v);
        let there = q.value.values.iter().chain(&v.value.values).copied();
        let mut there = DVector::from_iterator(2 * n, there);
        let picked = chart.indices();
        let monodromy = DMatrix::from_fn(picked.len(), picked.len(), |i, j| match picked[i] {
            of if of < n => q.by[j].values[of],
            of => v.by[j].values[of - n],
        });
        if chart.rank() > 0 {
            // The values are taken from a run that is kept on the constraints.
            let end = self.end(x, period, tolerance)?;
            let signs = self.signs(&end, &there);
            there = end.component_mul(&signs);
        }
        let none = || NoOrbit::Run(format!("there are no accelerations at t = {t} s"));
        Ok(Passage {
            rate: chart.of(&self.rate(t, &there).ok_or_else(none)?),
            x: there,
            monodromy,
        })
    }

    /// The same across impacts and other changes of contacts.
    fn passage_with_contacts(
        &self,
        chart: &Chart,
        x: &DVector<f64>,
        period: f64,
        tolerance: f64,
    ) -> Result<Passage, NoOrbit> {
        let (n, t) = (self.n, self.sought.start.t);
        let spread = chart.spread(self.machine, t, x);
        let spread = spread.map_err(|_| NoOrbit::Constraints)?;
        let part = |rows: std::ops::Range<usize>| -> Vec<f64> {
            let own = x
                .rows_range(rows.clone())
                .iter()
                .copied()
                .collect::<Vec<_>>();
            let by = spread.column_iter();
            let by = by.flat_map(|column| {
                column
                    .rows_range(rows.clone())
                    .iter()
                    .copied()
                    .collect::<Vec<_>>()
            });
            own.into_iter().chain(by).collect()
        };
        let start = State {
            t,
            q: part(0..n),
            v: part(n..2 * n),
        };
        let signals = Signals::default();
        let wanted = across::Wanted {
            machine: self.machine,
            signals: &signals,
            directions: vec![Direction::of_start(self.machine); chart.size()],
            method: Default::default(),
            tolerance,
            until: t + period,
            most_steps: MOST_STEPS_OF_PART,
        };
        let run = across::run(&wanted, &start).map_err(|why| NoOrbit::Run(why.to_string()))?;
        let end = run.end();
        let all = end.q[..n].iter().chain(&end.v[..n]).copied();
        let there = DVector::from_iterator(2 * n, all);
        let picked = chart.indices();
        let monodromy = DMatrix::from_fn(picked.len(), picked.len(), |i, j| match picked[i] {
            of if of < n => end.q[(j + 1) * n + of],
            of => end.v[(j + 1) * n + of - n],
        });
        self.check_open(&there)?;
        let none = || {
            NoOrbit::Run(format!(
                "there are no accelerations at t = {} s",
                t + period
            ))
        };
        Ok(Passage {
            rate: chart.of(&self.rate(t + period, &there).ok_or_else(none)?),
            x: there,
            monodromy,
        })
    }

    /// S with `|S δx|² = δqᵀ M δq (2π/T)² + δvᵀ M δv` for the independent numbers, where `δv` are the rates at fixed positions.
    /// Where the mass matrix is not positive definite, the sizes of the coordinates are used instead.
    fn scale(&self, chart: &Chart, x: &DVector<f64>, period: f64) -> Result<DMatrix<f64>, NoOrbit> {
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

    /// The period after which the motion from a start comes nearest to it while passing it in the direction
    /// in which it left.
    fn first_return(&self, x: &DVector<f64>) -> Result<f64, NoOrbit> {
        let start = self.named(x);
        let rate = self.rate(start.t, x).ok_or(NoOrbit::NoReturn)?;
        // A rough time per radian, with which states are weighted; nothing depends on its exact value. States of first order are
        // as large as at the start.
        let n = self.n;
        let size = |part: &[f64], of_states: bool| {
            let own = part.iter().zip(&self.is_integral);
            let own = own.filter(|(_, is_integral)| **is_integral == of_states);
            own.map(|(x, _)| x * x).sum::<f64>().sqrt()
        };
        let [sizes, rates] = [&rate.as_slice()[..n], &rate.as_slice()[n..]];
        let ratio = |of_states: bool| {
            let (size, rate) = (size(sizes, of_states), size(rates, of_states));
            (size > 0.0 && rate > 0.0).then(|| rate / size)
        };
        if size(sizes, false) == 0.0 && rates.iter().all(|rate| *rate == 0.0) {
            return Err(NoOrbit::Rest);
        }
        let omega = ratio(false).or_else(|| ratio(true)).unwrap_or(1.0);
        let chart = &self.chart(x)?;
        let rate = chart.of(&rate);
        let scale = self.scale(chart, x, TAU / omega)?;
        let place = x + &self.advance;
        let normal = scale.transpose() * (&scale * &rate);
        let distance = {
            let (normal, place) = (normal.clone(), place.clone());
            let picked = chart.indices().to_vec();
            let fours = self.machine.program().quaternions.clone();
            move |state: &State<Named>| -> f64 {
                let sign = |k: usize| {
                    let four = fours.iter().find(|four| four.contains(&k));
                    let terms = four.into_iter().flatten();
                    let along: f64 = terms.map(|i| state.q.values[*i] * place[*i]).sum();
                    if along < 0.0 { -1.0 } else { 1.0 }
                };
                let number = |k: usize| {
                    if k < n {
                        sign(k) * state.q.values[k]
                    } else {
                        sign(k - n) * state.v.values[k - n]
                    }
                };
                let terms = picked.iter().zip(normal.iter());
                terms
                    .map(|(k, normal)| normal * (number(*k) - place[*k]))
                    .sum()
            }
        };
        let t = start.t;
        let (run, _) = Simulation::new(self.machine)
            .tolerance(self.sought.tolerance.max(1e-9))
            .max_steps(STEPS_OF_RETURN)
            .until(t + 1e9)
            .forget_steps()
            .until_nth_event(RETURNS, "return", Crossing::Rising, distance)
            .run_interpreted_as_far_as_possible(start)
            .map_err(|error| NoOrbit::Run(error.to_string()))?;
        let gaps: Vec<(f64, f64)> = run
            .events()
            .iter()
            .map(|event| {
                let all = event.state.q.values.iter().chain(&event.state.v.values);
                let there = DVector::from_iterator(2 * n, all.copied());
                let there = there.component_mul(&self.signs(&place, &there));
                let off = chart.of(&(there - &place));
                ((&scale * off).norm(), event.state.t - t)
            })
            .collect();
        let least = gaps
            .iter()
            .map(|(gap, _)| *gap)
            .fold(f64::INFINITY, f64::min);
        // The first of those that are about equally near. Within a thousandth of the way around counts as near: on an orbit all
        // returns are near but for round-off.
        let around = (&scale * &rate).norm() / omega;
        let near = (1.5 * least).max(1e-3 * around);
        let first = gaps.iter().find(|(gap, _)| *gap <= near);
        first.map(|(_, period)| *period).ok_or(NoOrbit::NoReturn)
    }

    /// Divides a period by the number of returns within it: a deviation that alternates about an orbit brings the motion nearer to
    /// its start at the second return than at the first. Returns whether the period was divided.
    fn shorten(&self, x: &DVector<f64>, period: &mut f64) -> Result<bool, NoOrbit> {
        let tolerance = self.sought.tolerance;
        let whole = *period;
        while self.advance.amax() == 0.0 {
            let mut shorter = None;
            for part in [2.0, 3.0, 5.0] {
                let there = self.end(x, *period / part, tolerance)?;
                if self.largest_relative_entry(&self.gap(x, &there), x) <= CLOSED * tolerance {
                    shorter = Some(*period / part);
                }
            }
            match shorter {
                Some(shorter) => *period = shorter,
                None => break,
            }
        }
        Ok(*period < whole)
    }

    /// Checks that the equations are the same one period later and after coordinates have advanced.
    fn check_invariance(
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
    fn newton(
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
    fn step(
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
    fn check_differences(
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
    fn multipliers(
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

/// An orbit at one value of the varied quantity.
#[derive(Clone, Debug)]
pub struct Point {
    /// The value.
    pub value: f64,
    /// The orbit there.
    pub orbit: Result<Orbit, NoOrbit>,
}

/// What happens to an orbit where multipliers cross the unit circle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Change {
    /// One crosses 1: the branch turns back, or another branch meets it or branches off.
    Fold,
    /// One crosses −1: an orbit of twice the period branches off.
    Doubling,
    /// A pair crosses the circle elsewhere: a torus branches off.
    Torus,
}

impl Change {
    /// The name in words.
    pub fn name(self) -> &'static str {
        match self {
            Change::Fold => "fold or branching",
            Change::Doubling => "period doubling",
            Change::Torus => "torus",
        }
    }
}

/// Where the number of multipliers outside the unit circle changes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Changed {
    /// The two values of the varied quantity between which it happens, brought together by bisection.
    pub between: [f64; 2],
    /// The kind of change.
    pub change: Change,
    /// The multiplier outside that is nearest to the circle.
    pub multiplier: Complex<f64>,
}

/// Orbits along a range of values.
#[derive(Clone, Debug)]
pub struct Trace {
    /// An orbit for each value, or why there is none.
    pub points: Vec<Point>,
    /// The changes along the range.
    pub changes: Vec<Changed>,
}

/// How many times a step from one value to the next is halved where no orbit is found.
const MOST_BETWEEN: u32 = 6;

/// How many times an interval in which the number of multipliers outside the circle changes is bisected.
const HALVINGS: usize = 20;

/// Follows an orbit along a range of values. `make` returns the machine at a value, and the period there if one is given. Each
/// search starts from the linear extrapolation of the last two orbits, or from the last orbit.
///
/// # Errors
/// Why there is no orbit at the first value.
pub fn follow<E>(
    make: impl Fn(f64) -> Result<(InterpretedMachine, Option<f64>), E>,
    sought: &Sought,
    values: &[f64],
) -> Result<Trace, E>
where
    E: From<NoOrbit>,
{
    let solve = |value: f64, from: &Sought| -> Result<Result<Orbit, NoOrbit>, E> {
        let (machine, period) = make(value)?;
        let mut from = from.clone();
        if let Some(period) = period {
            from.period = Period::Given(period);
        }
        Ok(find(&machine, &from))
    };
    let mut known: Vec<(f64, Orbit)> = Vec::new();
    let (mut points, mut changes) = (Vec::new(), Vec::new());
    for (k, &value) in values.iter().enumerate() {
        let mut solution = solve(value, &extrapolated(sought, &known, value))?;
        if solution.is_err()
            && let Some(orbit) = in_shorter_steps(&solve, sought, &known, value)?
        {
            solution = Ok(orbit);
        }
        if let (Err(none), 0) = (&solution, k) {
            return Err(none.clone().into());
        }
        if let Ok(orbit) = &solution {
            if let Some((before, older)) = known.last()
                && older.outside() != orbit.outside()
            {
                let ends = [(*before, older.clone()), (value, orbit.clone())];
                changes.push(located(&solve, sought, ends)?);
            }
            known.push((value, orbit.clone()));
            if known.len() > 2 {
                known.remove(0);
            }
        }
        points.push(Point {
            value,
            orbit: solution,
        });
    }
    Ok(Trace { points, changes })
}

/// What to search for at a value: an orbit near the extrapolation of the known ones.
fn extrapolated(sought: &Sought, known: &[(f64, Orbit)], value: f64) -> Sought {
    let mut from = sought.clone();
    let Some((at, last)) = known.last() else {
        return from;
    };
    from.start = last.start.clone();
    let mut period = last.period;
    if let [.., (before, older), _] = known
        && before != at
    {
        let share = (value - at) / (at - before);
        let ahead = |to: &mut Vec<f64>, older: &[f64]| {
            for (x, older) in to.iter_mut().zip(older) {
                *x += share * (*x - older);
            }
        };
        ahead(&mut from.start.q.values, &older.start.q.values);
        ahead(&mut from.start.v.values, &older.start.v.values);
        let ahead = period + share * (period - older.period);
        period = if ahead > 0.5 * period { ahead } else { period };
    }
    from.period = match from.period {
        Period::Given(given) => Period::Given(given),
        _ => Period::Near(period),
    };
    from
}

/// The orbit at a value, by shorter steps that begin at the last known orbit; `None` if there is none, or if even short steps do
/// not lead to it.
fn in_shorter_steps<E>(
    solve: &impl Fn(f64, &Sought) -> Result<Result<Orbit, NoOrbit>, E>,
    sought: &Sought,
    known: &[(f64, Orbit)],
    value: f64,
) -> Result<Option<Orbit>, E> {
    let Some(&(mut at, _)) = known.last() else {
        return Ok(None);
    };
    let mut step = 0.5 * (value - at);
    let mut orbits = known.to_vec();
    let mut halved = 1;
    while halved <= MOST_BETWEEN {
        let next = if ((value - at) / step) < 1.5 {
            value
        } else {
            at + step
        };
        match solve(next, &extrapolated(sought, &orbits, next))? {
            Ok(orbit) if next == value => return Ok(Some(orbit)),
            Ok(orbit) => {
                orbits.push((next, orbit));
                at = next;
            }
            Err(_) => {
                step *= 0.5;
                halved += 1;
            }
        }
    }
    Ok(None)
}

impl Orbit {
    /// The number of multipliers outside the unit circle.
    fn outside(&self) -> usize {
        let own = self.multipliers.iter();
        own.filter(|one| one.side() == Side::Grows).count()
    }
}

/// Where between two orbits the number of multipliers outside the circle changes.
fn located<E>(
    solve: &impl Fn(f64, &Sought) -> Result<Result<Orbit, NoOrbit>, E>,
    sought: &Sought,
    [mut low, mut high]: [(f64, Orbit); 2],
) -> Result<Changed, E> {
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low.0 + high.0);
        let mut from = sought.clone();
        from.start = low.1.start.clone();
        if !matches!(from.period, Period::Given(_)) {
            from.period = Period::Near(0.5 * (low.1.period + high.1.period));
        }
        let Ok(orbit) = solve(middle, &from)? else {
            break;
        };
        if orbit.outside() == low.1.outside() {
            low = (middle, orbit)
        } else {
            high = (middle, orbit)
        }
    }
    let outer = if low.1.outside() > high.1.outside() {
        &low.1
    } else {
        &high.1
    };
    let outside = outer
        .multipliers
        .iter()
        .filter(|one| one.side() == Side::Grows);
    let nearest = outside.min_by(|a, b| a.value.norm().total_cmp(&b.value.norm()));
    let multiplier = nearest.map_or(Complex::new(1.0, 0.0), |one| one.value);
    let is_real = multiplier.im.abs() <= 1e-6;
    let change = if !is_real {
        Change::Torus
    } else if multiplier.re > 0.0 {
        Change::Fold
    } else {
        Change::Doubling
    };
    Ok(Changed {
        between: [low.0, high.0],
        change,
        multiplier,
    })
}
