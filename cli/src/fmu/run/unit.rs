// The run of a unit, for its C part (`fmu/c/runtime.c`). This file is not a module of the command: `run.rs` appends to its text the module
// `machine`, the type `Described` of the machine, the functions `of_parameters` and `of_inputs`, and constants.

use core::ffi::{c_char, c_int};
use core::mem::{Discriminant, discriminant};
use std::panic::{AssertUnwindSafe, catch_unwind};

use lagrangian::{
    Ending, Inputs, Machine, Method, PreparedRun, RunInPieces, Simulation, State, System, Vector,
    Warning,
};

/// A run, and what it borrows, which stands at fixed places.
pub struct Run {
    /// `None` only while this is dropped.
    run: Option<RunInPieces<'static, 'static, Described>>,
    prepared: *mut PreparedRun<'static, Described>,
    machine: *mut Described,
    system: <Described as Machine>::System,
    inputs: Vec<f64>,
    /// The kinds of warnings that were given.
    given: Vec<Discriminant<Warning>>,
    /// Whether a call did not come back.
    is_broken: bool,
}

impl Drop for Run {
    fn drop(&mut self) {
        // What borrows goes first.
        self.run = None;
        // SAFETY: both came from boxes, and nothing borrows from them any more.
        unsafe {
            drop(Box::from_raw(self.prepared));
            drop(Box::from_raw(self.machine));
        }
    }
}

/// How a call went, as the C part reads it: 0 without a word, 1 with a warning, 3 if it failed; with the words.
type Said = (c_int, String);

const WELL: c_int = 0;
const WARNED: c_int = 1;
const FAILED: c_int = 3;

/// What is said of a panic.
const DEFECT: &str = "a defect of lagrangian stopped the run";

impl Run {
    fn begun(
        parameters: &[f64],
        inputs: &[f64],
        states: &[f64],
        t: f64,
        tolerance: f64,
    ) -> Result<(Box<Run>, String), String> {
        let described = of_parameters(parameters);
        let system = described.prepare();
        let n = system.coordinates().len();
        let named = |numbers: &[f64]| {
            let mut vector = <<Described as Machine>::System as System>::Vector::zeros(n);
            vector.as_mut_slice().copy_from_slice(numbers);
            system.to_coordinates(&vector)
        };
        let start = State {
            t,
            q: named(&states[..n]),
            v: named(&states[n..]),
        };
        let machine = Box::into_raw(Box::new(described));
        // SAFETY: the machine stays at its place until the run is dropped.
        let simulation = Simulation::new(unsafe { &*machine });
        let simulation = simulation.method(METHOD).tolerance(tolerance);
        let prepared = match simulation.prepare(start) {
            Ok(prepared) => Box::into_raw(Box::new(prepared)),
            Err(error) => {
                // SAFETY: the machine came from a box, and nothing borrows from it.
                drop(unsafe { Box::from_raw(machine) });
                return Err(error.to_string());
            }
        };
        let mut run = Box::new(Run {
            run: None,
            prepared,
            machine,
            system,
            inputs: Vec::new(),
            given: Vec::new(),
            is_broken: false,
        });
        // SAFETY: what was prepared stays at its place until the run is dropped, and is used by the run alone.
        let prepared = unsafe { &mut *prepared };
        let warnings: Vec<String> = prepared.warnings().iter().map(Warning::to_string).collect();
        run.run = Some(prepared.begin().map_err(|error| error.to_string())?);
        run.set_inputs(inputs)?;
        Ok((run, warnings.join("; ")))
    }

    /// Makes a call, unless one before it did not come back.
    fn call<T>(&mut self, call: impl FnOnce(&mut Run) -> Result<T, String>) -> Result<T, String> {
        if self.is_broken {
            return Err(DEFECT.to_owned());
        }
        self.is_broken = true;
        let made = call(self);
        self.is_broken = false;
        made
    }

    fn get(&mut self) -> Result<&mut RunInPieces<'static, 'static, Described>, String> {
        self.run
            .as_mut()
            .ok_or_else(|| "the run has not begun".to_owned())
    }

    /// Sets the inputs, if they are others.
    fn set_inputs(&mut self, inputs: &[f64]) -> Result<(), String> {
        if self.inputs == inputs {
            return Ok(());
        }
        let now = of_inputs(inputs);
        self.get()?
            .set_inputs(now)
            .map_err(|error| error.to_string())?;
        self.inputs = inputs.to_vec();
        Ok(())
    }

    fn advance(&mut self, inputs: &[f64], until: f64) -> Result<(), String> {
        self.set_inputs(inputs)?;
        let run = self.get()?;
        let ending = run.advance_to(until).map_err(|error| error.to_string());
        run.take_contact_events();
        match ending? {
            Ending::End => Ok(()),
            other => Err(format!("the run has ended: {other:?}")),
        }
    }

    /// The warnings of which there was none of their kind before.
    fn new_warnings(&mut self) -> String {
        let warnings = self.run.as_ref().map(RunInPieces::warnings);
        let mut words = Vec::new();
        for warning in warnings.into_iter().flatten() {
            if !self.given.contains(&discriminant(&warning)) {
                self.given.push(discriminant(&warning));
                words.push(warning.to_string());
            }
        }
        words.join("; ")
    }

    /// Time, then coordinates and rates.
    fn state(&mut self, t: &mut f64, states: &mut [f64]) -> Result<(), String> {
        let state = self.get()?.state();
        let (q, v) = states.split_at_mut(states.len() / 2);
        *t = state.t;
        q.copy_from_slice(self.system.to_vector(&state.q).as_slice());
        v.copy_from_slice(self.system.to_vector(&state.v).as_slice());
        Ok(())
    }

    fn observe(
        &mut self,
        inputs: &[f64],
        accelerations: &mut [f64],
        multipliers: &mut [f64],
        potential: &mut f64,
        contacts: &mut [f64],
    ) -> Result<(), String> {
        self.set_inputs(inputs)?;
        let seen = self.get()?.observe().map_err(|error| error.to_string())?;
        accelerations.copy_from_slice(self.system.to_vector(&seen.a).as_slice());
        multipliers.copy_from_slice(&seen.multipliers);
        *potential = seen.potential_energy;
        let guided = seen.contacts.iter();
        let guided = guided.map(|guide| [0.0, guide.normal, guide.friction, guide.slip]);
        let unilateral = seen.unilateral.iter();
        let unilateral = unilateral.map(|of| [of.gap, of.normal, of.friction, of.slip]);
        for (to, values) in contacts.chunks_exact_mut(4).zip(guided.chain(unilateral)) {
            to.copy_from_slice(&values);
        }
        Ok(())
    }
}

/// Makes a call of the C part: stores its words, and answers how it went. A panic, which would be a defect of the runtime, is a failure.
///
/// # Safety
/// `message` must point to `size` characters.
unsafe fn answer(message: *mut c_char, size: usize, call: impl FnOnce() -> Said) -> c_int {
    let called = catch_unwind(AssertUnwindSafe(call));
    let (outcome, words) = called.unwrap_or_else(|_| (FAILED, DEFECT.to_owned()));
    let mut length = words.len().min(size.saturating_sub(1));
    while !words.is_char_boundary(length) {
        length -= 1;
    }
    if size > 0 {
        // SAFETY: guaranteed by the caller.
        unsafe {
            core::ptr::copy_nonoverlapping(words.as_ptr().cast(), message, length);
            message.add(length).write(0);
        }
    }
    outcome
}

fn said(done: Result<String, String>) -> Said {
    match done {
        Ok(words) if words.is_empty() => (WELL, words),
        Ok(words) => (WARNED, words),
        Err(words) => (FAILED, words),
    }
}

/// Begins a run from `states`, coordinates before rates, which then are those after impacts at the start.
///
/// # Safety
/// Each pointer must point to as many numbers as the machine has of them.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn unitRunBegin(
    to: *mut *mut Run,
    parameters: *const f64,
    inputs: *const f64,
    states: *mut f64,
    t: f64,
    tolerance: f64,
    message: *mut c_char,
    size: usize,
) -> c_int {
    // SAFETY: guaranteed by the caller.
    unsafe {
        answer(message, size, || {
            let states = core::slice::from_raw_parts_mut(states, STATES);
            let parameters = core::slice::from_raw_parts(parameters, PARAMETERS);
            let inputs = core::slice::from_raw_parts(inputs, INPUTS);
            said(
                Run::begun(parameters, inputs, states, t, tolerance).and_then(
                    |(mut run, words)| {
                        run.state(&mut 0.0, states)?;
                        to.write(Box::into_raw(run));
                        Ok(words)
                    },
                ),
            )
        })
    }
}

/// Takes a run to a time; writes the time and the state that it has reached.
///
/// # Safety
/// As for [`unitRunBegin`], which must have begun the run.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn unitRunAdvance(
    run: *mut Run,
    inputs: *const f64,
    until: f64,
    t: *mut f64,
    states: *mut f64,
    message: *mut c_char,
    size: usize,
) -> c_int {
    // SAFETY: guaranteed by the caller.
    unsafe {
        answer(message, size, || {
            let run = &mut *run;
            let inputs = core::slice::from_raw_parts(inputs, INPUTS);
            let states = core::slice::from_raw_parts_mut(states, STATES);
            said(run.call(|run| {
                let advanced = run.advance(inputs, until);
                // After an error it is the last state that is known.
                run.state(&mut *t, states)?;
                advanced.map(|()| run.new_warnings())
            }))
        })
    }
}

/// Writes accelerations, multipliers, the potential energy with that of contacts that yield, and for each contact its gap, normal force, friction and
/// slip.
///
/// # Safety
/// As for [`unitRunAdvance`].
#[unsafe(no_mangle)]
pub unsafe extern "C" fn unitRunObserve(
    run: *mut Run,
    inputs: *const f64,
    accelerations: *mut f64,
    multipliers: *mut f64,
    potential: *mut f64,
    contacts: *mut f64,
    message: *mut c_char,
    size: usize,
) -> c_int {
    // SAFETY: guaranteed by the caller.
    unsafe {
        answer(message, size, || {
            let inputs = core::slice::from_raw_parts(inputs, INPUTS);
            let accelerations = core::slice::from_raw_parts_mut(accelerations, STATES / 2);
            let multipliers = core::slice::from_raw_parts_mut(multipliers, CONSTRAINTS);
            let contacts = core::slice::from_raw_parts_mut(contacts, 4 * CONTACTS);
            let run = &mut *run;
            said(run.call(|run| {
                run.observe(
                    inputs,
                    accelerations,
                    multipliers,
                    &mut *potential,
                    contacts,
                )?;
                Ok(String::new())
            }))
        })
    }
}

/// Ends a run, if there is one.
///
/// # Safety
/// The run must not be used afterwards.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn unitRunEnd(run: *mut Run) {
    if !run.is_null() {
        // SAFETY: it came from a box.
        let _ = catch_unwind(AssertUnwindSafe(|| drop(unsafe { Box::from_raw(run) })));
    }
}
