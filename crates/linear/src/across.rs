//! Derivatives of the run of a machine with unilateral contacts, continued across changes of the contacts.
//!
//! Between two changes of the contacts a motion and its derivatives obey the variational equations of one machine
//! ([`crate::varied`]). Where h(t, x) = 0 triggers a change, its instant moves by δt, and everything that happens there is
//! evaluated over dual numbers at the moved instant. With the states x⁻ before and x⁺ = R(t, x⁻) after, and their time
//! derivatives ẋ⁻ and ẋ⁺,
//!
//! ```text
//! δt = −(∂h/∂x δx⁻ + ∂h/∂s)/ḣ,   δx⁺ = d/ds R(t + δt, x⁻ + δx⁻ + ẋ⁻ δt) − ẋ⁺ δt                      (E66)
//! ```
//!
//! (M. A. Aizerman, F. R. Gantmakher, *On the stability of periodic motions*, J. Appl. Math. Mech. 22 (1958) 1065–1078; R. I.
//! Leine, H. Nijmeijer, *Dynamics and Bifurcations of Non-Smooth Mechanical Systems*, 2004, chapter 7.) R is the law of impact,
//! with those contacts pressing, sticking and slipping that the run has found to do so; without an impact it is the identity.

use std::fmt;
use std::sync::Arc;

use lagrangian::interpreted::{InterpretedMachine, Named, Signals};
use lagrangian::{
    Compliance, ContactImpact, ContactMode, ImpactLaw, ImpactOrder, InputLaw, Machine, Method,
    PhaseCause, Simulation, Solution, State, System,
};
use lagrangian_program::Interpreter;
use lagrangian_scalar::Dual;

use crate::varied::{
    Direction, DualState, Phase, Sought, Varied, VariedInputs, VariedLaw, VariedSystem,
};

type Number = Dual<f64>;

/// The penetration depth that would follow without an impact must be at least this many tolerances of the preceding
/// gap. Below that the contact grazes, and it is not certain that the impact happens at all.
const GRAZES: f64 = 100.0;

/// Accelerations before and after a change that agree to this fraction are continuous, as far as a run of the usual
/// tolerance can resolve.
const GOES_ON: f64 = 1e-6;

/// Friction within this fraction of its limit is saturated.
const SATURATED: f64 = 1e-10;

/// A slip below this fraction of the terms that it sums is round-off: a few units of it for each of at most some dozens of terms.
const ROUND_OFF_OF_SLIP: f64 = 256.0 * f64::EPSILON;

/// Contacts whose impulses change each other's rates by less than this fraction are uncoupled.
const COUPLED: f64 = 1e-12;

/// Derivatives below this fraction of the terms that they sum are round-off.
const ROUNDING: f64 = 1e-9;

/// The run to be made.
#[derive(Clone, Debug)]
pub struct Wanted<'m> {
    /// The machine.
    pub machine: &'m InterpretedMachine,
    /// The signals that drive its inputs.
    pub signals: &'m Signals,
    /// The directions of differentiation. They are best scaled so that derivatives are of the size of the motion,
    /// because one tolerance serves both.
    pub directions: Vec<Direction>,
    /// The method of integration.
    pub method: &'static Method,
    /// Relative and absolute tolerance, of motion and derivatives.
    pub tolerance: f64,
    /// The end of the run, in s.
    pub until: f64,
    /// The most steps of a part between two changes, and of the run itself.
    pub most_steps: usize,
}

/// A run with its derivatives, in parts from one change of the contacts to the next.
pub struct Across<'m> {
    parts: Vec<Part<'m>>,
    /// The state after the last change, if nothing follows it.
    end: State<Vec<f64>>,
    /// The number of changes passed.
    changes: usize,
}

/// What can be evaluated at a state of the run.
pub struct Observed<'a> {
    /// The equations of motion, between two changes.
    pub system: &'a VariedSystem,
    /// Accelerations and their derivatives in each direction.
    pub a: Vec<f64>,
    /// Inputs with theirs.
    pub inputs: VariedInputs,
}

/// The motion between two changes.
struct Part<'m> {
    from: f64,
    law: VariedLaw<'m>,
    run: Solution<Varied<'m>, VariedLaw<'m>>,
}

/// Why there are no derivatives.
#[derive(Clone, Debug)]
pub enum NoDerivatives {
    /// A run ended early.
    Run(lagrangian::Error),
    /// The run has no derivatives from a certain change on.
    Broken {
        /// The time of that change, in s.
        t: f64,
        /// The contact.
        contact: String,
        /// Why.
        why: &'static str,
    },
}

impl fmt::Display for NoDerivatives {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            NoDerivatives::Run(error) => write!(f, "{error}"),
            NoDerivatives::Broken { t, contact, why } => write!(
                f,
                "the run has no derivatives from t = {t} s on: the contact `{contact}` {why}"
            ),
        }
    }
}

impl std::error::Error for NoDerivatives {}

impl<'m> Across<'m> {
    /// The state at a time within the run, followed by its derivatives in each direction; at a change the state after it.
    ///
    /// # Errors
    /// If it cannot be evaluated.
    pub fn at(&self, t: f64) -> Result<State<Vec<f64>>, lagrangian::Error> {
        if t == self.end.t {
            return Ok(self.end.clone());
        }
        match self.part(t) {
            Some(part) => part.run.at(t),
            None => Ok(self.end.clone()),
        }
    }

    /// The state at the end of the run.
    pub fn end(&self) -> &State<Vec<f64>> {
        &self.end
    }

    /// The number of changes of contacts.
    pub fn changes(&self) -> usize {
        self.changes
    }

    /// Accelerations and inputs at a state of the run, which must be that of [`at`](Self::at) for this time.
    ///
    /// # Errors
    /// If they cannot be evaluated.
    pub fn observe(
        &self,
        t: f64,
        (q, v): (&Vec<f64>, &Vec<f64>),
    ) -> Result<Observed<'_>, lagrangian::Error> {
        let Some(part) = self.part(t) else {
            return Err(lagrangian::Error::StepsForgotten);
        };
        let system = part.run.system();
        let mut inputs = system.default_inputs();
        part.law.set(system, t, q, v, &mut inputs);
        let mut a = vec![0.0; q.len()];
        system
            .accelerations(t, q, v, &inputs, &mut a)
            .map_err(|singular| {
                let error = lagrangian::StepError::Singular { singular, t };
                lagrangian::Error::of_step(error, system)
            })?;
        Ok(Observed { system, a, inputs })
    }

    fn part(&self, t: f64) -> Option<&Part<'m>> {
        let after = self.parts.partition_point(|part| part.from <= t);
        self.parts.get(after.saturating_sub(1))
    }
}

/// Runs a machine with derivatives in some directions. In `start`, the derivatives follow the start itself.
///
/// # Errors
/// If the run ends early, or has no derivatives.
pub fn run<'m>(wanted: &Wanted<'m>, start: &State<Vec<f64>>) -> Result<Across<'m>, NoDerivatives> {
    let Wanted {
        machine,
        signals,
        directions,
        ..
    } = wanted;
    let system = machine.prepare();
    if let Some(contact) = system
        .unilateral_contacts()
        .find(|contact| contact.is_second_tangent)
    {
        return Err(NoDerivatives::Broken {
            t: start.t,
            contact: contact.name.to_owned(),
            why: "slips in two directions, for which there are no derivatives across changes of contacts",
        });
    }
    if let Some(contact) = system
        .unilateral_contacts()
        .find(|contact| contact.has_face)
    {
        return Err(NoDerivatives::Broken {
            t: start.t,
            contact: contact.name.to_owned(),
            why: "is between two polygons, for which there are no derivatives where a corner reaches the end of a face",
        });
    }
    let n = system.coordinates().len();
    let mut own = machine.start();
    own.t = start.t;
    own.q.values.copy_from_slice(&start.q[..n]);
    own.v.values.copy_from_slice(&start.v[..n]);
    let base = Simulation::new(*machine)
        .law((*signals).clone())
        .tolerance(wanted.tolerance)
        .method(wanted.method)
        .until(wanted.until)
        .max_steps(wanted.most_steps)
        .run_interpreted(own)
        .map_err(NoDerivatives::Run)?;
    let passing = Passing {
        wanted,
        names: system
            .unilateral_contacts()
            .map(|contact| contact.name.to_owned())
            .collect(),
        laws: system
            .unilateral_contacts()
            .map(|contact| (contact.law, contact.order))
            .collect(),
        n,
        directions: directions.len(),
        interpreters: std::cell::RefCell::new(interpreters(machine, directions)),
    };
    passing.run(&base, start.clone())
}

/// The program of a machine over numbers with a derivative in each direction.
pub fn interpreters(
    machine: &InterpretedMachine,
    directions: &[Direction],
) -> Vec<Interpreter<Number>> {
    let of_direction = |direction: &Direction| {
        let values = machine.parameter_values().iter();
        let parameters: Vec<Number> = (values.zip(&direction.parameters))
            .map(|(value, derivative)| Dual {
                value: *value,
                derivative: *derivative,
            })
            .collect();
        Interpreter::new(machine.program(), &parameters)
    };
    directions.iter().map(of_direction).collect()
}

/// An impact of a contact, as the run reported it.
type ReportedImpact = (usize, ContactImpact);

struct Passing<'w, 'm> {
    wanted: &'w Wanted<'m>,
    names: Vec<String>,
    laws: Vec<(ImpactLaw, ImpactOrder)>,
    n: usize,
    directions: usize,
    interpreters: std::cell::RefCell<Vec<Interpreter<Number>>>,
}

/// A change: its time, the modes of the contacts before and after it, and its cause.
struct Change<'a> {
    t: f64,
    before: &'a Phase,
    after: &'a mut Phase,
    cause: PhaseCause,
    hits: &'a [ReportedImpact],
    ended: &'a [usize],
    /// How far each gap opened since it was last closed.
    excursions: &'a [f64],
}

impl<'m> Passing<'_, 'm> {
    fn run(
        &self,
        base: &Solution<InterpretedMachine, Signals>,
        mut state: State<Vec<f64>>,
    ) -> Result<Across<'m>, NoDerivatives> {
        let system = base.system();
        let mut phase = Phase::open(system, self.directions);
        let mut parts: Vec<Part<'m>> = Vec::new();
        let mut excursions = vec![0.0; phase.modes.len()];
        let mut changes = 0;
        let all: Vec<_> = base.contact_phases().collect();
        if all.is_empty() {
            // Without contacts one part is the whole run.
            let part = self.part(&phase, state, base.end().t)?;
            let end = part.run.end().clone();
            return Ok(Across {
                parts: vec![part],
                end,
                changes,
            });
        }
        for (index, event) in all.iter().enumerate() {
            let ends = all.get(index + 1).map_or(base.end().t, |next| next.since);
            let mut after = Phase {
                modes: event.modes.to_vec(),
                ..phase.clone()
            };
            for (layer, is_loaded) in after.layers.iter_mut().zip(&event.loaded) {
                layer.is_loaded = *is_loaded;
            }
            // The values are those of the run itself, so they carry no error of the variational integration.
            let here = base.at(event.since).map_err(NoDerivatives::Run)?;
            if index == 0 {
                self.put_values(&mut state, &here);
                self.check_start(&state, &after, &event.impacts)?;
            } else {
                let change = Change {
                    t: event.since,
                    before: &phase,
                    after: &mut after,
                    cause: event.cause,
                    hits: &event.impacts,
                    ended: event.ended,
                    excursions: &excursions,
                };
                self.cross_change(change, &mut state, &here)?;
                changes += 1;
            }
            phase = after;
            for (k, excursion) in excursions.iter_mut().enumerate() {
                if phase.is_closed(k) || event.impacts.iter().any(|(contact, _)| *contact == k) {
                    *excursion = 0.0;
                }
            }
            let is_last = index + 1 == all.len();
            if ends > event.since || is_last && parts.is_empty() {
                self.check_forces(&state, &phase)?;
                let part = self.part(&phase, state.clone(), ends)?;
                let mut gaps = vec![0.0; excursions.len()];
                for t in [event.since, 0.5 * (event.since + ends), ends] {
                    let at = part.run.at(t).map_err(NoDerivatives::Run)?;
                    system.gaps(t, &at.q[..self.n].to_vec(), &mut gaps);
                    for (excursion, gap) in excursions.iter_mut().zip(&gaps) {
                        *excursion = excursion.max(gap.abs());
                    }
                }
                state = part.run.end().clone();
                parts.push(part);
            }
        }
        Ok(Across {
            parts,
            end: state,
            changes,
        })
    }

    /// Integrates from a state until contacts change.
    fn part(
        &self,
        phase: &Phase,
        start: State<Vec<f64>>,
        until: f64,
    ) -> Result<Part<'m>, NoDerivatives> {
        let signals = self.wanted.signals;
        let varied = Varied {
            machine: self.wanted.machine,
            directions: self.wanted.directions.clone(),
            signals,
            phase: Some(Arc::new(phase.clone())),
        };
        let from = start.t;
        let simulation = Simulation::new(&varied)
            .law(VariedLaw(signals))
            .tolerance(self.wanted.tolerance)
            .method(self.wanted.method)
            .until(until)
            .max_steps(self.wanted.most_steps);
        let run = VariedLaw::run(simulation, start);
        let run = run.map_err(NoDerivatives::Run)?;
        Ok(Part {
            from,
            law: VariedLaw(signals),
            run,
        })
    }

    fn broken(&self, t: f64, contact: usize, why: &'static str) -> NoDerivatives {
        NoDerivatives::Broken {
            t,
            contact: self.names[contact].clone(),
            why,
        }
    }

    fn put_values(&self, state: &mut State<Vec<f64>>, own: &State<Named>) {
        state.q[..self.n].copy_from_slice(&own.q.values);
        state.v[..self.n].copy_from_slice(&own.v.values);
    }

    /// Time, coordinates and rates with their derivatives in a direction, where the instant moves by `by` and the state moves along
    /// with these accelerations.
    fn moved(&self, state: &State<Vec<f64>>, direction: usize, by: f64, a: &[f64]) -> Vec<Number> {
        let n = self.n;
        let part = (direction + 1) * n;
        let time = [Dual {
            value: state.t,
            derivative: by,
        }];
        let place = (0..n).map(|i| Dual {
            value: state.q[i],
            derivative: state.q[part + i] + state.v[i] * by,
        });
        let rate = (0..n).map(|i| Dual {
            value: state.v[i],
            derivative: state.v[part + i] + a[i] * by,
        });
        time.into_iter().chain(place).chain(rate).collect()
    }

    /// Evaluates a function at a state in a direction.
    fn place<T>(
        &self,
        state: Vec<Number>,
        direction: usize,
        phase: &Phase,
        ask: impl FnOnce(&mut DualState<'_>) -> Option<T>,
    ) -> Option<T> {
        let inputs = self.inputs(&state, direction);
        let mut interpreters = self.interpreters.borrow_mut();
        let interpreter = interpreters.get_mut(direction)?;
        let mut place = DualState::new(interpreter, state, &inputs, phase).ok()?;
        ask(&mut place)
    }

    /// Inputs at a state, with their derivatives in a direction.
    fn inputs(&self, state: &[Number], direction: usize) -> Vec<Number> {
        let varied = Varied {
            machine: self.wanted.machine,
            directions: vec![self.wanted.directions[direction].clone()],
            signals: self.wanted.signals,
            phase: None,
        };
        let system = varied.prepare();
        let n = self.n;
        let with_derivatives = |list: &[Number]| -> Vec<f64> {
            let values = list.iter().map(|x| x.value);
            values.chain(list.iter().map(|x| x.derivative)).collect()
        };
        let (q, v) = (
            with_derivatives(&state[1..=n]),
            with_derivatives(&state[n + 1..]),
        );
        let mut inputs = system.default_inputs();
        VariedLaw(self.wanted.signals).set(&system, state[0].value, &q, &v, &mut inputs);
        let own = inputs.own.values.iter().zip(&inputs.by[0]);
        own.map(|(value, derivative)| Dual {
            value: *value,
            derivative: *derivative,
        })
        .collect()
    }

    /// The accelerations while the contact phase does not change.
    fn accelerations(&self, state: &State<Vec<f64>>, phase: &Phase) -> Option<Vec<f64>> {
        let still = self.moved(state, 0, 0.0, &vec![0.0; self.n]);
        self.place(still, 0, phase, |place| {
            let reaction = place.reaction(phase, 0).ok()?;
            Some(reaction.a.iter().map(|a| a.value).collect())
        })
    }

    /// Checks that the loads of the closed contacts are unique.
    fn check_forces(&self, state: &State<Vec<f64>>, phase: &Phase) -> Result<(), NoDerivatives> {
        if self.directions == 0 || phase.is_free() || self.accelerations(state, phase).is_some() {
            return Ok(());
        }
        let closed = (0..phase.modes.len()).find(|k| phase.is_closed(*k));
        Err(self.broken(
            state.t,
            closed.unwrap_or(0),
            "shares its load with others, and the shares are not unique",
        ))
    }

    /// Checks that the start has no impact, and that contacts closed there stay closed in every direction.
    fn check_start(
        &self,
        state: &State<Vec<f64>>,
        phase: &Phase,
        hits: &[ReportedImpact],
    ) -> Result<(), NoDerivatives> {
        if let Some((contact, _)) = hits.first() {
            return Err(self.broken(
                state.t,
                *contact,
                "has an impact at the start itself, before which there is no motion; start a little before or after it",
            ));
        }
        for direction in 0..self.directions {
            let still = self.moved(state, direction, 0.0, &vec![0.0; self.n]);
            let size = still
                .iter()
                .fold(0.0_f64, |most, x| most.max(x.derivative.abs()));
            let left = self.place(still, direction, phase, |place| {
                let closed = (0..phase.modes.len()).filter(|k| phase.is_closed(*k));
                let mut rigid = closed.filter(|k| phase.compliances[phase.presses(*k)].is_none());
                Some(rigid.find(|&k| {
                    let sticks = phase.modes[k] == ContactMode::Sticks && phase.has_friction[k];
                    let is_open = !phase.rolls[k]
                        && (off(place.gaps[k], size) || off(place.rates[2 * k], size));
                    is_open || sticks && off(place.rates[2 * k + 1], size)
                }))
            });
            if let Some(Some(contact)) = left {
                return Err(self.broken(
                    state.t,
                    contact,
                    "touches at the start, and the variation would open it, penetrate it or let it slip; start with it open",
                ));
            }
        }
        Ok(())
    }

    /// Carries the derivatives across a change. `here` is the state after it.
    fn cross_change(
        &self,
        change: Change<'_>,
        state: &mut State<Vec<f64>>,
        here: &State<Named>,
    ) -> Result<(), NoDerivatives> {
        if self.directions == 0 {
            self.put_values(state, here);
            return Ok(());
        }
        if change.hits.is_empty() {
            return self.cross_without_impact(change, state, here);
        }
        let one_after_the_other = self.closing_contacts(&change, state)?;
        let mut phase = change.before.clone();
        for (round, &contact) in one_after_the_other.iter().enumerate() {
            let is_last = round + 1 == one_after_the_other.len();
            let hits: Vec<ReportedImpact> = match one_after_the_other.len() {
                1 => change.hits.to_vec(),
                _ => (change.hits.iter())
                    .filter(|(k, _)| *k == contact)
                    .copied()
                    .collect(),
            };
            let mut next = phase.clone();
            if is_last {
                next = change.after.clone();
            } else {
                next.modes[contact] = change.after.modes[contact];
            }
            let ended: &[usize] = if is_last { change.ended } else { &[] };
            self.cross_impact(
                contact,
                (&phase, &mut next),
                (&hits, ended),
                change.excursions[contact],
                state,
            )?;
            phase = next;
        }
        let (t, hits) = (change.t, change.hits);
        *change.after = phase;
        if !has_rates(state, here, hits) {
            return Err(self.broken(
                t,
                one_after_the_other[0],
                "takes part in several rounds of impacts at one instant",
            ));
        }
        self.put_values(state, here);
        Ok(())
    }

    /// The contacts whose gaps close in an impact and whose impacts are evaluated one after the other: one, or several that are
    /// uncoupled, in any order.
    ///
    /// # Errors
    /// If it matters which comes first, or if there are none.
    fn closing_contacts(
        &self,
        change: &Change<'_>,
        state: &State<Vec<f64>>,
    ) -> Result<Vec<usize>, NoDerivatives> {
        let before = |k: usize| change.before.modes[k];
        let mut closing: Vec<usize> = (change.hits.iter())
            .filter(|(k, hit)| {
                let is_own = !change.before.rolls[*k];
                is_own && before(*k) == ContactMode::Open && hit.gap_rate[0] < 0.0
            })
            .map(|(k, _)| *k)
            .collect();
        closing.dedup();
        let is_sequence = self.laws[change.hits[0].0].1 == ImpactOrder::Sequence;
        match closing[..] {
            [] => Err(self.broken(
                change.t,
                change.hits[0].0,
                "has an impact without a gap that closes",
            )),
            [first, ..] if is_sequence => Ok(vec![first]),
            [_] => Ok(closing),
            [_, second, ..] => {
                let apart = (change.hits.len() == closing.len() && change.ended.is_empty())
                    .then(|| self.are_uncoupled(&closing, state, change.before))
                    .flatten();
                if apart != Some(true) {
                    return Err(self.broken(
                        change.t,
                        second,
                        "has an impact at the same instant as another, and it matters which of the two comes first",
                    ));
                }
                Ok(closing)
            }
        }
    }

    /// Whether the impulses of these contacts leave each other's rates unchanged.
    fn are_uncoupled(
        &self,
        contacts: &[usize],
        state: &State<Vec<f64>>,
        phase: &Phase,
    ) -> Option<bool> {
        let still = self.moved(state, 0, 0.0, &vec![0.0; self.n]);
        self.place(still, 0, phase, |place| {
            let mut apart = true;
            for &k in contacts {
                for part in [0, 1] {
                    let (change, _) = place.respond(&[], place.row(2 * k + part))?;
                    let by = |direction: usize| {
                        let terms = place.row(direction).iter().zip(&change);
                        terms.fold([0.0; 2], |[sum, size], (w, by)| {
                            let term = w.value * by.value;
                            [sum + term, size + term.abs()]
                        })
                    };
                    for &other in contacts.iter().filter(|other| **other != k) {
                        for direction in [2 * other, 2 * other + 1] {
                            let [sum, size] = by(direction);
                            apart &= sum.abs() <= COUPLED * size;
                        }
                    }
                }
            }
            Some(apart)
        })
    }

    /// Carries the derivatives across an impact that one closing gap triggers.
    fn cross_impact(
        &self,
        contact: usize,
        (before, after): (&Phase, &mut Phase),
        (hits, ended): (&[ReportedImpact], &[usize]),
        excursion: f64,
        state: &mut State<Vec<f64>>,
    ) -> Result<(), NoDerivatives> {
        let t = state.t;
        let broken = |contact: usize, why| self.broken(t, contact, why);
        let no_forces = || {
            broken(
                contact,
                "shares its load with others, and the shares are not unique",
            )
        };
        let a_before = self.accelerations(state, before).ok_or_else(no_forces)?;
        let (mut moved, mut shifts) = (Vec::new(), Vec::new());
        for direction in 0..self.directions {
            let still = self.moved(state, direction, 0.0, &a_before);
            let [gap, rate, bend] = self
                .place(still, direction, before, |place| {
                    let a: Vec<Number> = a_before.iter().map(|a| Dual::constant(*a)).collect();
                    let bend = place.acceleration(2 * contact, &a);
                    Some([place.gaps[contact], place.rates[2 * contact], bend])
                })
                .ok_or_else(no_forces)?;
            // The penetration depth that would follow without the impact.
            let depth = 0.5 * rate.value * rate.value / bend.value.abs();
            if rate.value >= 0.0 || depth < GRAZES * self.wanted.tolerance * excursion {
                return Err(broken(
                    contact,
                    "is grazed: whether it touches at all depends on the variation",
                ));
            }
            let by = -gap.derivative / rate.value;
            let there = self.moved(state, direction, by, &a_before);
            let v = self.place(there.clone(), direction, before, |place| {
                Some(self.rates_after(place, (before, &*after), (hits, ended)))
            });
            let v = v
                .ok_or_else(no_forces)?
                .map_err(|(contact, why)| broken(contact, why))?;
            moved.push((there, v));
            shifts.push(by);
        }
        let n = self.n;
        for (i, v) in moved[0].1.iter().enumerate() {
            state.v[i] = v.value;
        }
        let places: Vec<Vec<Number>> = moved.iter().map(|(there, _)| there.clone()).collect();
        self.load_layers(after, &places);
        let a_after = self.accelerations(state, after).ok_or_else(|| {
            broken(
                contact,
                "shares its load with others, and the shares are not unique",
            )
        })?;
        for (direction, ((there, v), by)) in moved.into_iter().zip(shifts).enumerate() {
            let part = (direction + 1) * n;
            for i in 0..n {
                state.q[part + i] = there[1 + i].derivative - v[i].value * by;
                state.v[part + i] = v[i].derivative - a_after[i] * by;
            }
        }
        Ok(())
    }

    /// The rates after an impact.
    fn rates_after(
        &self,
        place: &mut DualState<'_>,
        (before, after): (&Phase, &Phase),
        (hits, ended): (&[ReportedImpact], &[usize]),
    ) -> Result<Vec<Number>, (usize, &'static str)> {
        let is_sequence = hits.len() > 1 && self.laws[hits[0].0].1 == ImpactOrder::Sequence;
        let rounds: Vec<&[ReportedImpact]> = if is_sequence {
            hits.chunks(1).collect()
        } else {
            vec![hits]
        };
        for round in rounds {
            self.impact(place, (before, after), round)?;
        }
        if !ended.is_empty() {
            // Without friction, the remaining rates at the end of a bouncing sequence are set to zero.
            let mut sought = Vec::new();
            for k in (0..after.modes.len()).filter(|k| after.is_closed(*k)) {
                let rigid = after.compliances[after.presses(k)].is_none();
                let sticks = |phase: &Phase| phase.modes[k] == ContactMode::Sticks;
                let stuck = after.has_friction[k] && sticks(before) && sticks(after);
                for (part, is_held) in [(0, rigid && !after.rolls[k]), (1, rigid && stuck)] {
                    if is_held {
                        let row = place.row(2 * k + part).to_vec();
                        sought.push(Sought {
                            along: row.clone(),
                            row,
                            change: zero() - place.rates[2 * k + part],
                        });
                    }
                }
            }
            self.impulses_for(place, &sought, &after.modes).ok_or((
                ended[0],
                "stops bouncing where several contacts share a load",
            ))?;
        }
        Ok(place.v.clone())
    }

    /// Applies the impulses that bring about the sought changes of rates; returns these impulses.
    fn impulses_for(
        &self,
        place: &mut DualState<'_>,
        sought: &[Sought],
        modes: &[ContactMode],
    ) -> Option<Vec<Number>> {
        let (change, impulses) = place.respond(sought, &vec![zero(); self.n])?;
        for (v, by) in place.v.iter_mut().zip(&change) {
            *v = *v + *by;
        }
        for direction in 0..2 * modes.len() {
            let row = place.row(direction).to_vec();
            let by = row.iter().zip(&change);
            let by = by.fold(zero(), |sum, (w, by)| sum + *w * *by);
            place.rates[direction] = place.rates[direction] + by;
        }
        Some(impulses)
    }

    /// One impact of contacts that take part simultaneously, by Newton's law, with pressing, sticking and slipping
    /// as the run found them.
    fn impact(
        &self,
        place: &mut DualState<'_>,
        (before, after): (&Phase, &Phase),
        hits: &[ReportedImpact],
    ) -> Result<(), (usize, &'static str)> {
        let greatest = hits.iter().fold(0.0_f64, |most, (_, hit)| {
            most.max(hit.impulse[0].abs()).max(hit.impulse[1].abs())
        });
        let one = Dual::constant(1.0);
        let mut sought = Vec::new();
        let mut idle = Vec::new();
        for (k, hit) in hits.iter().filter(|(k, _)| !after.rolls[*k]) {
            let is_idle = hit.impulse[0] <= 1e-12 * greatest;
            // Contacts at rest that receive no impulse press as well, but only if they stay closed.
            let stays_closed = before.is_closed(*k) && after.is_closed(*k);
            if !(hit.impulse[0] > 1e-12 * greatest || stays_closed) {
                continue;
            }
            if is_idle {
                idle.push((sought.len(), *k));
            }
            let mut along = place.row(2 * k).to_vec();
            let mut tangents = Vec::new();
            for (j, own) in [*k, k + 1].into_iter().filter_map(|j| impact_of(hits, j)) {
                if after.presses(j) != *k || !after.has_friction[j] {
                    continue;
                }
                if self.laws[*k].0 != ImpactLaw::Newton {
                    return Err((
                        *k,
                        "has impacts with friction by a law other than `newton`, for which there are no derivatives",
                    ));
                }
                let tangent = Tangent {
                    contact: j,
                    own,
                    is_idle,
                    most: place.coefficients(j)[2].value * hit.impulse[0],
                };
                let friction = tangent.friction(place, after);
                match friction.map_err(|why| (*k, why))? {
                    ImpactFriction::Sticks(tangent) => tangents.push(tangent),
                    ImpactFriction::Slips { friction, row } => {
                        crate::varied::add(&mut along, friction, &row);
                    }
                }
            }
            if self.laws[*k].0 != ImpactLaw::Newton && hits.len() > 1 && !self.is_alone(hits, *k) {
                return Err((
                    *k,
                    "has an impact together with others by a law other than `newton`, for which there are no derivatives",
                ));
            }
            // The gap of a contact that stays closed without an impulse does not open before the impact, nor does it in any variation: what round-off
            // leaves of its rate would count where the impact itself is as weak.
            let change = if is_idle {
                zero()
            } else {
                let [restitution, ..] = place.coefficients(*k);
                zero() - (one + restitution) * place.rates[2 * k]
            };
            sought.push(Sought {
                along,
                row: place.row(2 * k).to_vec(),
                change,
            });
            sought.append(&mut tangents);
        }
        let impulses = self.impulses_for(place, &sought, &after.modes).ok_or((
            hits[0].0,
            "shares its impact with others, and the shares are not unique",
        ))?;
        check_idle(&impulses, &idle)
    }

    /// Whether a contact is the only one with an impulse.
    fn is_alone(&self, hits: &[ReportedImpact], contact: usize) -> bool {
        hits.iter()
            .all(|(k, hit)| *k == contact || hit.impulse == [0.0; 2])
    }

    /// Carries the derivatives across a change without an impact, in which only accelerations jump.
    fn cross_without_impact(
        &self,
        change: Change<'_>,
        state: &mut State<Vec<f64>>,
        here: &State<Named>,
    ) -> Result<(), NoDerivatives> {
        let Some(contact) = self.changing_contact(&change)? else {
            self.put_values(state, here);
            return Ok(());
        };
        let Change {
            t,
            before,
            after,
            cause,
            ..
        } = change;
        let shared = || {
            self.broken(
                t,
                contact,
                "shares its load with others, and the shares are not unique",
            )
        };
        let a_before = self.accelerations(state, before).ok_or_else(shared)?;
        self.put_values(state, here);
        // Where a layer begins to unload by itself its depth is at a maximum, so a shift of the instant does not
        // change it to first order.
        let still = |direction| self.moved(state, direction, 0.0, &vec![0.0; self.n]);
        let places: Vec<Vec<Number>> = (0..self.directions).map(still).collect();
        self.load_layers(after, &places);
        let a_after = self.accelerations(state, after).ok_or_else(shared)?;
        let jump = a_before.iter().zip(&a_after).map(|(a, b)| (a - b).abs());
        let jump = jump.fold(0.0, f64::max);
        let size = (a_before.iter().chain(&a_after)).fold(0.0_f64, |most, a| most.max(a.abs()));
        if jump <= GOES_ON * size {
            return Ok(());
        }
        let instant = Instant {
            t,
            cause,
            contact,
            before,
            a_before: &a_before,
        };
        let shifts = self.shifts(&instant, after, state)?;
        for (direction, by) in shifts.into_iter().enumerate() {
            let part = (direction + 1) * self.n;
            for i in 0..self.n {
                state.v[part + i] += (a_before[i] - a_after[i]) * by;
            }
        }
        Ok(())
    }

    /// The contact whose change this is; `None` if nothing changes.
    ///
    /// # Errors
    /// If the instant of the change has no derivative.
    fn changing_contact(&self, change: &Change<'_>) -> Result<Option<usize>, NoDerivatives> {
        let (before, after) = (change.before, &*change.after);
        let first = (0..before.modes.len()).find(|k| before.modes[*k] != after.modes[*k]);
        let contact = match change.cause {
            PhaseCause::Lifts(k)
            | PhaseCause::Stops(k)
            | PhaseCause::Breaks(k)
            | PhaseCause::Presses(k)
            | PhaseCause::Turns(k) => k,
            PhaseCause::Stepped => {
                return Err(self.broken(
                    change.t,
                    first.unwrap_or(0),
                    "was continued by time stepping, which does not locate instants",
                ));
            }
            _ => match first {
                Some(k) => k,
                None => return Ok(None),
            },
        };
        let grazes = before.modes[contact] == ContactMode::Open
            && after.is_closed(contact)
            && after.compliances[after.presses(contact)].is_none();
        if grazes {
            return Err(self.broken(change.t, contact, "closes with zero speed"));
        }
        Ok(Some(contact))
    }

    /// The derivative in each direction of the instant at which forces jump.
    fn shifts(
        &self,
        instant: &Instant<'_>,
        after: &Phase,
        state: &State<Vec<f64>>,
    ) -> Result<Vec<f64>, NoDerivatives> {
        let &Instant {
            cause,
            contact,
            before,
            ..
        } = instant;
        let broken = |contact: usize, why| self.broken(instant.t, contact, why);
        if cause == PhaseCause::Asked {
            return Err(broken(
                contact,
                "changes where forces jump, from an unknown cause",
            ));
        }
        if matches!(cause, PhaseCause::Breaks(_) | PhaseCause::Lifts(_))
            && !self.wanted.signals.is_empty()
        {
            return Err(broken(
                contact,
                "changes where forces jump, by a force that depends on a driven input",
            ));
        }
        // Several slips that stop at the same instant count as one event only if they always stop together.
        let stops = |k: &usize| match (before.modes[*k], after.modes[*k]) {
            (ContactMode::Slides(from), ContactMode::Sticks) => from != 0.0,
            (ContactMode::Slides(from), ContactMode::Slides(to)) => from != to && from != 0.0,
            _ => false,
        };
        let others = (0..before.modes.len()).filter(stops);
        let others: Vec<usize> = others.filter(|k| *k != contact).collect();
        let mut shifts = Vec::new();
        for direction in 0..self.directions {
            let shift = |contact| self.shift(instant, contact, state, direction);
            let by = shift(contact).filter(|by| by.is_finite()).ok_or_else(|| {
                broken(
                    contact,
                    "changes at an instant whose derivative is infinite",
                )
            })?;
            for &other in &others {
                let together = shift(other).is_some_and(|of_other| {
                    (of_other - by).abs() <= 1e-6 * (by.abs() + of_other.abs())
                });
                if !together {
                    return Err(broken(
                        other,
                        "happens to stop slipping at the same instant as another",
                    ));
                }
            }
            shifts.push(by);
        }
        Ok(shifts)
    }

    /// δt in a direction, eq. (E66), if this contact triggers the change.
    fn shift(
        &self,
        instant: &Instant<'_>,
        contact: usize,
        state: &State<Vec<f64>>,
        direction: usize,
    ) -> Option<f64> {
        let margin = |by: f64| {
            let there = self.moved(state, direction, by, instant.a_before);
            self.place(there, direction, instant.before, |place| {
                self.margin(place, (instant.before, instant.cause), contact, direction)
            })
        };
        // The derivative along the motion, ḣ, is the change of the margin with a shift of the instant.
        let changes = margin(0.0)?.derivative;
        let with_time = margin(1.0)?.derivative;
        Some(-changes / (with_time - changes))
    }

    /// The function whose zero triggers a change of a contact.
    fn margin(
        &self,
        place: &mut DualState<'_>,
        (before, cause): (&Phase, PhaseCause),
        contact: usize,
        direction: usize,
    ) -> Option<Number> {
        match cause {
            PhaseCause::Presses(_) => Some(place.gaps[contact]),
            PhaseCause::Lifts(_) | PhaseCause::Breaks(_) => {
                let [.., most] = place.coefficients(contact);
                let reaction = place.reaction(before, direction).ok()?;
                let [normal, tangential] = reaction.forces[contact];
                let normal = if before.rolls[contact] {
                    reaction.forces[contact - 1][0]
                } else {
                    normal
                };
                match cause {
                    PhaseCause::Lifts(_) => Some(normal),
                    _ => {
                        let sign = Dual::constant(tangential.value.signum());
                        Some(most * normal - sign * tangential)
                    }
                }
            }
            _ => Some(place.rates[2 * contact + 1]),
        }
    }

    /// Sets, in each direction, the depth to which a layer was pressed for layers that start to unload at this change.
    fn load_layers(&self, after: &mut Phase, places: &[Vec<Number>]) {
        let is_layer = |k: &usize| after.compliances[*k] == Some(Compliance::Layer);
        let layers: Vec<usize> = (0..after.modes.len()).filter(is_layer).collect();
        for k in layers {
            for (direction, there) in places.iter().enumerate() {
                let depth = self.place(there.clone(), direction, after, |place| {
                    Some(place.depth(k))
                });
                let layer = &mut after.layers[k];
                if let Some(depth) = depth
                    && depth.value >= layer.depth[direction].value
                    && !layer.is_loaded
                {
                    layer.depth[direction] = depth;
                }
            }
        }
    }
}

/// An instant at which accelerations jump without an impact.
struct Instant<'i> {
    t: f64,
    cause: PhaseCause,
    /// The contact that changes.
    contact: usize,
    before: &'i Phase,
    a_before: &'i [f64],
}

/// A tangent of a contact in an impact.
struct Tangent<'t> {
    /// The contact whose slip is along it.
    contact: usize,
    own: &'t ContactImpact,
    /// Whether the contact presses without an impulse.
    is_idle: bool,
    /// The greatest impulse of friction.
    most: f64,
}

/// The friction along a tangent in an impact.
enum ImpactFriction {
    /// The slip after the impact is that before it times −eₜ, the tangential restitution.
    Sticks(Sought),
    /// Friction is this multiple of the normal impulse.
    Slips { friction: Number, row: Vec<Number> },
}

impl Tangent<'_> {
    /// Whether it sticks or slips, as the run found it.
    fn friction(
        &self,
        place: &DualState<'_>,
        after: &Phase,
    ) -> Result<ImpactFriction, &'static str> {
        let &Tangent {
            contact: j,
            own,
            is_idle,
            most,
        } = self;
        let [_, tangential, friction, _] = place.coefficients(j);
        let row = place.row(2 * j + 1).to_vec();
        let left = own.slip[1] + tangential.value * own.slip[0];
        let size = own.slip[0].abs() + own.slip[1].abs();
        let sticks = if is_idle {
            after.modes[j] == ContactMode::Sticks
        } else {
            // The friction of an impact that is far weaker than its slip is fast is known only to the round-off of that slip, and so
            // whether it is saturated. What still slips has not stuck. A slip that an earlier impact has stopped is rounding alone,
            // and is so small only beside the rates of the gap, from which that impact computed it.
            let terms = row.iter().zip(&place.v);
            let terms = terms.map(|(w, v)| (w.value * v.value).abs());
            let terms: f64 = terms.chain(own.gap_rate.map(f64::abs)).sum();
            let goes_on = left.abs() > (ROUNDING * size).max(ROUND_OFF_OF_SLIP * terms);
            !goes_on && own.impulse[1].abs() < most * (1.0 - SATURATED)
        };
        if sticks {
            let one = Dual::constant(1.0);
            return Ok(ImpactFriction::Sticks(Sought {
                along: row.clone(),
                change: zero() - (one + tangential) * place.rates[2 * j + 1],
                row,
            }));
        }
        let sign = match after.modes[j] {
            ContactMode::Slides(sign) if is_idle => -sign,
            _ => own.impulse[1].signum(),
        };
        if !is_idle && most > 0.0 && left.abs() <= ROUNDING * size {
            return Err("is on the boundary between slipping and sticking in its impact");
        }
        Ok(ImpactFriction::Slips {
            friction: Dual::constant(sign) * friction,
            row,
        })
    }
}

/// A contact's part in an impact, if it takes part.
fn impact_of(hits: &[ReportedImpact], contact: usize) -> Option<(usize, &ContactImpact)> {
    let found = hits.iter().find(|(other, _)| *other == contact);
    found.map(|(k, hit)| (*k, hit))
}

/// Checks that contacts without an impulse, given by the indices of their impulses, have none under the variation: one of one
/// sign would press such a contact, one of the other sign would open it.
fn check_idle(impulses: &[Number], idle: &[(usize, usize)]) -> Result<(), (usize, &'static str)> {
    let size = impulses
        .iter()
        .fold(0.0_f64, |most, x| most.max(x.derivative.abs()));
    for &(index, contact) in idle {
        if impulses[index].derivative.abs() > ROUNDING * size {
            return Err((
                contact,
                "touches without an impulse while others have impacts, and would have one, or open, under the variation",
            ));
        }
    }
    Ok(())
}

/// Whether the law of impact over dual numbers has given the same rates as the run.
fn has_rates(state: &State<Vec<f64>>, run: &State<Named>, hits: &[ReportedImpact]) -> bool {
    let jump: f64 = (hits.iter())
        .map(|(_, hit)| hit.gap_rate[0].abs() + hit.gap_rate[1].abs())
        .fold(0.0, f64::max);
    let rates = &run.v.values;
    let size = rates.iter().fold(0.0_f64, |most, v| most.max(v.abs()));
    let is_other = |(found, v): (&f64, &f64)| (found - v).abs() > 1e-3 * size.max(jump);
    !state.v.iter().zip(rates).any(is_other)
}

fn zero() -> Number {
    Dual::constant(0.0)
}

/// Whether a derivative exceeds round-off for a direction of this size.
fn off(x: Number, size: f64) -> bool {
    x.derivative.abs() > ROUNDING * size
}
