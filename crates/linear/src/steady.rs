//! The steady motion of a machine from its program and a start, and messages about why there is none.

use lagrangian::interpreted::{InterpretedMachine, InterpretedSystem};
use lagrangian::{Machine, System};
use lagrangian_program::Role;

use crate::motion::{self, State, SteadyMotion, Unsteady};
use crate::reduced::{Fault, Reduced, ReducedState};
use crate::search::{self, Lost, Wanted};

/// Why there is no steady motion.
pub enum NoMotion {
    /// The search failed.
    Lost(Lost),
    /// The state that was found is not steady.
    Unsteady(Unsteady),
}

/// The names of the options with which the caller's user chooses the start, for messages.
#[derive(Clone, Copy, Debug)]
pub struct Options {
    /// The option for start values, as in `--start`.
    pub start: &'static str,
    /// The option for coordinates that move steadily, as in `--steady`.
    pub steady: &'static str,
}

/// The steady motion that the search reaches from `q`, and the small motions about it.
///
/// # Errors
/// Why there is no steady motion.
pub fn motion(
    machine: &InterpretedMachine,
    q: &[f64],
    wanted: &Wanted,
) -> Result<SteadyMotion, NoMotion> {
    let system = machine.prepare();
    let inputs = system.default_inputs().values;
    let near = states(q, &wanted.given());
    let mut reduced = Reduced::new(machine, &system, &inputs, &near).with_contacts(&near);
    let wanted = &wanted.with_states(&reduced.integrals());
    let result = search::find(&mut reduced, q, wanted);
    let equilibrium = result.map_err(|lost| match start_is_unsteady(&mut reduced, q, wanted) {
        // If the equations depend on a moving coordinate, forces cannot stay in balance; that is the better explanation.
        Some(unsteady) => NoMotion::Unsteady(unsteady),
        None => NoMotion::Lost(lost),
    })?;
    let independence = reduced.check_independence(&equilibrium.place.q());
    independence.map_err(|fault| NoMotion::Lost(fault.into()))?;
    let motion = motion::near(&mut reduced, equilibrium, &wanted.steady);
    motion.map_err(NoMotion::Unsteady)
}

/// Whether the equations depend, at the start of the search, on coordinates that should move steadily.
fn start_is_unsteady(reduced: &mut Reduced<'_>, q: &[f64], wanted: &Wanted) -> Option<Unsteady> {
    if !wanted.steady.contains(&true) {
        return None;
    }
    let mut wide: Vec<_> = q.iter().map(|x| (*x).into()).collect();
    reduced.project(&mut wide, &|_| true).ok()?;
    let choice = reduced.choose(q, &wanted.steady).ok()?;
    let s = choice.independent.iter().map(|j| {
        if wanted.steady[*j] {
            wanted.rates[*j].into()
        } else {
            0.0.into()
        }
    });
    let place = ReducedState {
        s: s.collect(),
        q: wide,
    };
    let (here, bounds) = reduced.linearized(&choice, &place).ok()?;
    let state = State {
        choice: &choice,
        place: &place,
        here: &here,
        bounds: &bounds,
    };
    motion::records(reduced, &state).err()
}

/// The start, and two generic states near it.
pub(crate) fn states(q: &[f64], v: &[f64]) -> [(Vec<f64>, Vec<f64>); 3] {
    let beside = |list: &[f64], seed: usize| -> Vec<f64> {
        let shift = |k: usize| 0.01 + ((seed + 7 * k) * 29 % 97) as f64 / 997.0;
        list.iter()
            .enumerate()
            .map(|(k, x)| x + shift(k) * x.abs().max(1.0))
            .collect()
    };
    [
        (q.to_vec(), v.to_vec()),
        (beside(q, 1), beside(v, 2)),
        (beside(q, 3), beside(v, 4)),
    ]
}

/// Checks that the equations of a machine do not depend on time; otherwise it is at rest nowhere.
///
/// # Errors
/// If they do: the names of the parameters each of which removes the time dependence when it is 0.
pub fn drives(machine: &InterpretedMachine, q: &[f64], wanted: &Wanted) -> Result<(), Vec<String>> {
    let reads_time = |role: &Role| {
        let function = machine.program().function(*role);
        function.is_some_and(|function| function.reads().time)
    };
    let roles = [
        Role::MassMatrix,
        Role::Forces,
        Role::ConstraintMatrix,
        Role::ConstraintRates,
        Role::ConstraintBias,
        Role::ConstraintPositions,
        Role::Gaps,
        Role::ContactRates,
    ];
    if !roles.iter().any(reads_time) {
        return Ok(());
    }
    let states = states(q, &wanted.given());
    // A drive that parameters hold still, such as `cos(0*t)`, gives the same numbers at all times. Values that are
    // not finite decide nothing.
    let stands_still = |machine: &InterpretedMachine| {
        let system = machine.prepare();
        let inputs = system.default_inputs().values;
        let reduced = Reduced::new(machine, &system, &inputs, &[]);
        reduced.with_contacts(&[]).stands_still(&states)
    };
    if stands_still(machine) {
        return Ok(());
    }
    // A machine that loses its inertia when a parameter is 0 does not count either: the drive would have no effect on it.
    let is_regular = |machine: &InterpretedMachine| {
        let system = machine.prepare();
        Reduced::new(machine, &system, &[], &[]).is_regular(&states)
    };
    let has_inertia = is_regular(machine);
    let stops = |name: &String| {
        let mut still = machine.clone();
        still.set(name, 0.0).is_ok() && (is_regular(&still) || !has_inertia) && stands_still(&still)
    };
    let names = machine.parameters();
    let names = names.map(|(parameter, _)| parameter.name.to_owned());
    Err(names.filter(stops).collect())
}

fn name(system: &InterpretedSystem, index: usize) -> String {
    let coordinate = system.coordinates().nth(index);
    coordinate.map_or_else(|| "?".to_owned(), |coordinate| coordinate.name.to_owned())
}

impl NoMotion {
    /// The reason in one sentence.
    pub fn in_words(
        &self,
        system: &InterpretedSystem,
        wanted: &Wanted,
        options: Options,
    ) -> String {
        match self {
            NoMotion::Lost(lost) => reason_search_failed(system, wanted, lost, options),
            NoMotion::Unsteady(unsteady) => reason_unsteady(system, unsteady, options),
        }
    }
}

fn reason_unsteady(system: &InterpretedSystem, unsteady: &Unsteady, options: Options) -> String {
    let name = |index: &usize| name(system, *index);
    match unsteady {
        Unsteady::Depends(index) => format!(
            "`{}` cannot turn steadily: the equations of motion depend on where it is",
            name(index)
        ),
        Unsteady::Follows(index, other) => format!(
            "`{}` cannot turn steadily: the rate of `{}` changes with it, and the equations of motion depend on where that is",
            name(other),
            name(index)
        ),
        Unsteady::Fault(fault) => fault.in_words(system, options),
        Unsteady::NoEigenvalues => "the eigenvalues cannot be found".to_owned(),
    }
}

impl Fault {
    /// The reason in one sentence.
    pub fn in_words(&self, system: &InterpretedSystem, options: Options) -> String {
        let name = |index: &usize| name(system, *index);
        let constraint = |index: &usize| {
            let constraint = system.constraints().nth(*index);
            constraint.map_or_else(|| "?".to_owned(), |c| c.name.to_owned())
        };
        let Options { start, steady } = options;
        match self {
            Fault::Singular(index) => format!(
                "the mass matrix is singular in `{}` during the search for an equilibrium; {start} sets another start of the search",
                name(index)
            ),
            Fault::NotFinite(index) => format!(
                "the acceleration of `{}`, or a derivative of it, is not finite during the search for an equilibrium; {start} sets \
                 another start of the search",
                name(index)
            ),
            Fault::Follows(index) => format!(
                "{steady} {0}: by the constraints, the rate of `{0}` follows from the others; leave it or one of those out",
                name(index)
            ),
            Fault::Unmet(index) => format!(
                "the constraint `{}` cannot be met near the start; {start} sets another start of the search",
                constraint(index)
            ),
            Fault::Dependent(index) => format!(
                "the constraint `{}` depends on the others where the search ends, and not near it, so that they have no linear \
                 approximation there; write them such that none follows from the others, or set another start by {start}",
                constraint(index)
            ),
        }
    }
}

fn reason_search_failed(
    system: &InterpretedSystem,
    wanted: &Wanted,
    lost: &Lost,
    options: Options,
) -> String {
    let Options { start, steady } = options;
    let kind = if wanted.steady.contains(&true) {
        "steady motion"
    } else {
        "equilibrium"
    };
    let place = if wanted.steady.contains(&true) {
        format!("{start} sets another start of the search, {steady} other rates")
    } else {
        format!("{start} sets another start of the search")
    };
    let contacts = || system.unilateral_contacts();
    let rigid = contacts().find(|contact| contact.compliance.is_none());
    let rubs = contacts().find(|contact| contact.compliance.is_some() && contact.has_friction);
    let left_out = match (rigid, rubs) {
        (Some(contact), _) => format!(
            "; rigid contacts, as `{}`, count as open, since there are no modes where one is closed",
            contact.name
        ),
        (None, Some(contact)) => format!(
            "; friction, as of the contact `{}`, is left out where nothing slips, since it has no linearization there",
            contact.name
        ),
        (None, None) => String::new(),
    };
    match lost {
        Lost::Fault(fault) => fault.in_words(system, options),
        Lost::Accelerates(index, left) => format!(
            "there is no {kind} near the start: nothing balances the acceleration {left:.3e} of `{}`; {place}{left_out}",
            name(system, *index)
        ),
        Lost::NoEnd(steps) => {
            let times = if *steps == 1 { "step" } else { "steps" };
            format!("no {kind} was found in {steps} {times} from the start; {place}{left_out}")
        }
    }
}
