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

mod impacts;
mod without_impact;

use std::fmt;
use std::sync::Arc;

use lagrangian::interpreted::{InterpretedMachine, Named, Signals};
use lagrangian::{
    Compliance, ContactImpact, ContactMode, ImpactLaw, ImpactOrder, InputLaw, Machine, Method,
    PhaseCause, Simulation, Solution, State, System,
};
use lagrangian_program::Interpreter;
use lagrangian_scalar::Dual;

use crate::varied::{Direction, DualState, Phase, Varied, VariedInputs, VariedLaw, VariedSystem};

type Number = Dual<f64>;

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
                sides: self.sides(base, [event.since, ends])?,
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

    /// The signs of the reactions of the guides between two changes.
    fn sides(
        &self,
        base: &Solution<InterpretedMachine, Signals>,
        [since, ends]: [f64; 2],
    ) -> Result<Vec<f64>, NoDerivatives> {
        let guides = base.system().guides();
        if guides == 0 {
            return Ok(Vec::new());
        }
        let middle = since + 0.5 * (ends - since);
        let seen = base.observe(middle).map_err(NoDerivatives::Run)?;
        let of_guides = &seen.unilateral[seen.unilateral.len() - guides..];
        Ok(of_guides.iter().map(|of| of.normal.signum()).collect())
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
            self.cross_without_impact(change, state, here)
        } else {
            self.cross_impacts(change, state, here)
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

fn zero() -> Number {
    Dual::constant(0.0)
}

/// Whether a derivative exceeds round-off for a direction of this size.
fn off(x: Number, size: f64) -> bool {
    x.derivative.abs() > ROUNDING * size
}
