//! Coulomb friction in guided contacts: what sticks, what slides, and with which forces.
//!
//! ```text
//! slides   F = −s μ |N|,   s = sgn w         until w = 0
//! sticks   dw/dt = 0,  |F| ≤ μ₀ |N|          until |F| = μ₀ |N|
//! ```
//!
//! A machine says how accelerations, `dw/dt` and the normal reactions `N` depend on the friction forces `F`
//! of all its contacts ([`System::friction`]): linearly. With the states of the contacts given, what
//! is left is one equation for each of them, `F + s η μ N(F) = 0` or `dw/dt(F) = 0`, where η is the
//! sign of `N`. They are solved with a full search for pivots: the matrix is not symmetric, and it
//! may be singular (P. Painlevé, *Leçons sur le frottement*, 1895). In space `N` is a vector across the guide, and
//! `|F| = μ |N(F)|` is no linear equation: of one contact it is of the second degree, and of several it has
//! one solution where it is a contraction. Where that cannot be shown the run ends and says so.
//!
//! Which states the contacts are in is a question for all of them at once, and it is asked only where
//! something comes to rest, breaks away, or changes the side on which it presses. Then every
//! combination is looked at; that there is exactly one solution is found out and not presumed. (F.
//! Pfeiffer, C. Glocker, *Multibody Dynamics with Unilateral Contacts*, 1996, chapters 5 and 6, write
//! the same as a linear complementarity problem.) In between, the states stay as they are: the motion
//! is smooth, and what sticks is held at `w = 0` itself.

mod law;

#[cfg(feature = "std")]
use law::ROUNDING;
use law::{Each, Layout, Paradox, Parts, Question, solve};
pub(crate) use law::{Mode, Motion};

use crate::system::MOST_CONTACTS;
use crate::{Pivot, Singular, StepError, System, Vector};

/// Slips below this, relative to the greatest of the same contact in the run, count as rest where
/// another contact comes to rest.
#[cfg(feature = "std")]
const AT_REST: f64 = 1e-10;

/// How many numbers the work on constraints and contacts needs: what [`System::with_workspace`] is asked for.
///
/// In space reactions have three components, and it is [`contact_workspace_in_space`].
pub const fn contact_workspace(coordinates: usize, constraints: usize, contacts: usize) -> usize {
    workspace(coordinates, constraints, contacts, 1)
}

/// As [`contact_workspace`], for a machine in space.
pub const fn contact_workspace_in_space(
    coordinates: usize,
    constraints: usize,
    contacts: usize,
) -> usize {
    workspace(coordinates, constraints, contacts, 3)
}

const fn workspace(coordinates: usize, constraints: usize, contacts: usize, axes: usize) -> usize {
    let of_friction = Layout {
        n: coordinates,
        m: constraints,
        k: contacts,
        axes,
    }
    .len()
        + contacts * (coordinates + 1);
    let of_constraints = crate::constraint_workspace(coordinates, constraints);
    if of_friction > of_constraints {
        of_friction
    } else {
        of_constraints
    }
}

/// A contact at a state.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ContactForce {
    /// How fast it slides along its direction, in m/s.
    pub slip: f64,
    /// The normal reaction, in N. In the plane it is positive where it presses the body to the side of the normal; in space it
    /// is the length of the vector.
    pub normal: f64,
    /// The friction on the body along the direction, in N.
    pub friction: f64,
    /// Whether it sticks.
    pub sticks: bool,
}

/// What a run knows of its contacts.
#[derive(Clone, Debug)]
pub(crate) struct Contacts {
    count: usize,
    pub mode: Mode,
    /// The greatest slips so far.
    sizes: Each,
}

/// What ended the state of a contact.
#[cfg(feature = "std")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Change {
    /// Which contact.
    pub contact: usize,
    pub cause: Cause,
}

/// By how much the state of a contact holds, negative where it does not, and what rounding may take
/// from that.
#[cfg(feature = "std")]
#[derive(Clone, Copy, Debug)]
pub(crate) struct Margin {
    pub value: f64,
    pub rounding: f64,
}

#[cfg(feature = "std")]
impl Margin {
    /// Of what does not end.
    pub(crate) const ENDLESS: Margin = Margin {
        value: f64::INFINITY,
        rounding: 0.0,
    };

    /// Whether a state has ended that had this margin before: it is clearly lost now, or it was
    /// clearly there before. What is zero within rounding throughout has not ended. *When* a state
    /// ended is a question of the value alone.
    pub fn is_lost_since(self, before: Margin) -> bool {
        self.value < -self.rounding || (self.value < 0.0 && before.value > before.rounding)
    }
}

#[cfg(feature = "std")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Cause {
    /// It came to rest.
    Stopped,
    /// Its friction would have to be greater than it can be.
    BrokeAway,
    /// Its normal reaction went through zero.
    Turned,
}

/// Accelerations and multipliers of a machine with contacts, and the forces in these, at a state.
///
/// A contact whose slip is not 0 slides. Where it is 0 within rounding
/// ([`System::slip_ranges`]), all contacts at rest are asked
/// together whether they stick or slide off. A run knows more: there a contact that has come to rest
/// stays so until its friction is used up.
///
/// # Errors
/// Beside what makes the machine itself singular, where no motion has these contacts, or several have
/// ([`Pivot::Contact`]), or the machine has no workspace ([`Pivot::NoWorkspace`]).
pub fn contact_forces<S: System>(
    system: &S,
    (t, q, v, u): (f64, &S::Vector, &S::Vector, &S::Inputs),
    accelerations: &mut [f64],
    multipliers: &mut [f64],
    forces: &mut [ContactForce],
) -> Result<(), Singular> {
    let slips = resting_slips(system, t, q, v);
    with_parts(system, t, q, v, u, |parts, _| {
        let known = Question::from_slips(&slips);
        let (mode, friction_forces) = known.answer(parts).map_err(Paradox::singular)?;
        results(parts, &friction_forces, accelerations, multipliers);
        in_contacts(parts, &mode, &friction_forces, &slips, forces);
        Ok(())
    })
}

/// [`System::accelerations`] of a machine with contacts, by [`contact_forces`].
pub fn accelerations_with_friction<S: System>(
    system: &S,
    t: f64,
    q: &S::Vector,
    v: &S::Vector,
    u: &S::Inputs,
    a: &mut S::Vector,
) -> Result<(), Singular> {
    contact_forces(
        system,
        (t, q, v, u),
        a.as_mut_slice(),
        &mut [],
        &mut [ContactForce::default(); MOST_CONTACTS],
    )
}

/// [`System::multipliers`] of a machine with contacts, by [`contact_forces`].
pub fn multipliers_with_friction<S: System>(
    system: &S,
    t: f64,
    q: &S::Vector,
    v: &S::Vector,
    u: &S::Inputs,
    multipliers: &mut [f64],
) -> Result<(), Singular> {
    contact_forces(
        system,
        (t, q, v, u),
        &mut [],
        multipliers,
        &mut [ContactForce::default(); MOST_CONTACTS],
    )
}

/// What the machine says of friction forces, and the workspace beside it.
fn with_parts<S: System, R>(
    system: &S,
    t: f64,
    q: &S::Vector,
    v: &S::Vector,
    u: &S::Inputs,
    work: impl FnOnce(&Parts<'_>, &mut [f64]) -> Result<R, Singular>,
) -> Result<R, Singular> {
    let layout = Layout {
        n: q.as_slice().len(),
        m: system.constraints().len(),
        k: system.contacts().len(),
        axes: system.reaction_axes(),
    };
    let length = workspace(layout.n, layout.m, layout.k, layout.axes);
    system.with_workspace(length, |workspace| {
        // Without an allocator a machine with none, or too small a one, has no answer.
        let workspace = workspace.filter(|workspace| workspace.len() >= length);
        let Some((values, rest)) =
            workspace.and_then(|workspace| workspace.split_at_mut_checked(layout.len()))
        else {
            return Err(Singular {
                at: Pivot::NoWorkspace,
                ratio: 0.0,
            });
        };
        system.friction(t, q, v, u, values)?;
        work(&Parts { layout, values }, rest)
    })
}

fn slips<S: System>(system: &S, t: f64, q: &S::Vector, v: &S::Vector) -> Each {
    let mut slips = [0.0; MOST_CONTACTS];
    let count = system.contacts().len();
    system.slips(t, q, v, &mut slips[..count]);
    slips
}

/// The slips, 0 where a contact rests within rounding.
fn resting_slips<S: System>(system: &S, t: f64, q: &S::Vector, v: &S::Vector) -> Each {
    let mut slips = slips(system, t, q, v);
    if slips == [0.0; MOST_CONTACTS] {
        return slips;
    }
    let mut ranges = [[f64::INFINITY; 2]; MOST_CONTACTS];
    system.slip_ranges(t, q, v, &mut ranges[..system.contacts().len()]);
    for (slip, [from, to]) in slips.iter_mut().zip(ranges) {
        if from.is_finite() && to.is_finite() && from <= 0.0 && to >= 0.0 {
            *slip = 0.0;
        }
    }
    slips
}

/// Accelerations and multipliers with these friction forces, as far as they are asked for.
fn results(parts: &Parts<'_>, friction_forces: &Each, a: &mut [f64], multipliers: &mut [f64]) {
    for (i, a) in a.iter_mut().enumerate() {
        *a = parts.sum(i, friction_forces)[0];
    }
    for (i, multiplier) in multipliers.iter_mut().enumerate() {
        *multiplier = parts.sum(parts.layout.n + i, friction_forces)[0];
    }
}

/// The forces in contacts of these states with these friction forces.
fn in_contacts(
    parts: &Parts<'_>,
    mode: &Mode,
    friction_forces: &Each,
    slips: &Each,
    forces: &mut [ContactForce],
) {
    for (k, force) in forces.iter_mut().enumerate().take(parts.layout.k) {
        let sticks = mode.motion[k] == Motion::Sticks;
        *force = ContactForce {
            slip: if sticks { 0.0 } else { slips[k] },
            normal: parts.reaction(k, friction_forces)[0],
            friction: friction_forces[k],
            sticks,
        };
    }
}

impl Contacts {
    /// The states of the contacts at the start of a run.
    pub fn begin<S: System>(
        system: &S,
        t: f64,
        q: &S::Vector,
        v: &S::Vector,
        u: &S::Inputs,
    ) -> Result<Contacts, StepError> {
        let question = Question::from_slips(&resting_slips(system, t, q, v));
        let mode = with_parts(system, t, q, v, u, |parts, _| {
            let (mode, _) = question.answer(parts).map_err(Paradox::singular)?;
            Ok(mode)
        });
        let mut contacts = Contacts {
            count: system.contacts().len(),
            mode: mode.map_err(|singular| StepError::Singular { singular, t })?,
            sizes: [0.0; MOST_CONTACTS],
        };
        contacts.accept(system, t, q, v);
        Ok(contacts)
    }

    /// Takes note of a state.
    pub fn accept<S: System>(&mut self, system: &S, t: f64, q: &S::Vector, v: &S::Vector) {
        for (size, slip) in self.sizes.iter_mut().zip(slips(system, t, q, v)) {
            *size = size.max(slip.abs());
        }
    }

    /// Accelerations in the states that the contacts are in; of what sticks, without any creep.
    pub fn accelerations<S: System>(
        &self,
        system: &S,
        (t, q, v, u): (f64, &S::Vector, &S::Vector, &S::Inputs),
        a: &mut S::Vector,
    ) -> Result<(), Singular> {
        with_parts(system, t, q, v, u, |parts, workspace| {
            let friction_forces = self.friction_forces(parts)?;
            results(parts, &friction_forces, a.as_mut_slice(), &mut []);
            if self.sticks() {
                self.still(system, (t, q, v), a, workspace);
            }
            Ok(())
        })
    }

    /// The forces in the contacts, and the multipliers.
    #[cfg(feature = "std")]
    pub fn forces<S: System>(
        &self,
        system: &S,
        (t, q, v, u): (f64, &S::Vector, &S::Vector, &S::Inputs),
        multipliers: &mut [f64],
        forces: &mut [ContactForce],
    ) -> Result<(), Singular> {
        let slips = slips(system, t, q, v);
        with_parts(system, t, q, v, u, |parts, _| {
            let friction_forces = self.friction_forces(parts)?;
            results(parts, &friction_forces, &mut [], multipliers);
            in_contacts(parts, &self.mode, &friction_forces, &slips, forces);
            Ok(())
        })
    }

    /// The powers of the friction forces, in W: the work that what moves by itself does through them, and
    /// what is lost, `−Σ Fₖ wₖ`. Together they are the power on the coordinates, `Σ Fₖ τₖ v`.
    pub fn power<S: System>(
        &self,
        system: &S,
        (t, q, v, u): (f64, &S::Vector, &S::Vector, &S::Inputs),
    ) -> [f64; 2] {
        let slips = slips(system, t, q, v);
        let power = with_parts(system, t, q, v, u, |parts, workspace| {
            let friction_forces = self.friction_forces(parts)?;
            let n = parts.layout.n;
            let rows = &mut workspace[..self.count * n];
            system.slip_matrix(t, q, rows);
            let mut power = [0.0; 2];
            for (k, row) in rows.chunks_exact(n).enumerate() {
                let rate: f64 = row.iter().zip(v.as_slice()).map(|(tau, v)| tau * v).sum();
                power[0] += friction_forces[k] * rate;
                if self.mode.motion[k] != Motion::Sticks {
                    power[1] -= friction_forces[k] * slips[k];
                }
            }
            power[0] += power[1];
            Ok(power)
        });
        power.unwrap_or([f64::NAN; 2])
    }

    /// By how much the states of the contacts hold, two numbers for each: what slides is on its side
    /// of rest and presses to its side; what sticks has friction left.
    #[cfg(feature = "std")]
    pub fn margins<S: System>(
        &self,
        system: &S,
        (t, q, v, u): (f64, &S::Vector, &S::Vector, &S::Inputs),
    ) -> Result<[[Margin; 2]; MOST_CONTACTS], StepError> {
        let slips = slips(system, t, q, v);
        let margins = with_parts(system, t, q, v, u, |parts, _| {
            let friction_forces = self.friction_forces(parts)?;
            let mut margins = [[Margin::ENDLESS; 2]; MOST_CONTACTS];
            for (k, margin) in margins[..self.count].iter_mut().enumerate() {
                let [normal, terms] = parts.reaction(k, &friction_forces);
                *margin = match self.mode.motion[k] {
                    Motion::Sticks => {
                        let coefficient = parts.static_friction(k);
                        let reserve = Margin {
                            value: coefficient * normal.abs() - friction_forces[k].abs(),
                            rounding: ROUNDING * coefficient * terms,
                        };
                        [reserve, Margin::ENDLESS]
                    }
                    Motion::Slides(sign) => [
                        Margin {
                            value: sign * slips[k],
                            rounding: 0.0,
                        },
                        match parts.layout.axes {
                            1 => Margin {
                                value: self.mode.press[k] * normal,
                                rounding: ROUNDING * terms,
                            },
                            // In space a guide has no sides.
                            _ => Margin::ENDLESS,
                        },
                    ],
                };
            }
            Ok(margins)
        });
        margins.map_err(|singular| StepError::Singular { singular, t })
    }

    /// The states that seem to have ended, by their margins, and which of the two margins says so.
    #[cfg(feature = "std")]
    pub fn seem_ended(
        &self,
        margins: &[[Margin; 2]; MOST_CONTACTS],
    ) -> [Option<(Change, usize)>; 2 * MOST_CONTACTS] {
        let mut ended = [None; 2 * MOST_CONTACTS];
        for (k, margins) in margins[..self.count].iter().enumerate() {
            for (kind, margin) in margins.iter().enumerate() {
                if margin.value >= 0.0 {
                    continue;
                }
                let cause = match (self.mode.motion[k], kind) {
                    (Motion::Sticks, _) => Cause::BrokeAway,
                    (Motion::Slides(_), 0) => Cause::Stopped,
                    (Motion::Slides(_), _) => Cause::Turned,
                };
                let contact = k;
                ended[2 * k + kind] = Some((Change { contact, cause }, kind));
            }
        }
        ended
    }

    /// Whether the motion is determined: with what sticks and slides as it does, no other side to
    /// press to gives another motion.
    #[cfg(feature = "std")]
    pub fn check<S: System>(
        &self,
        system: &S,
        (t, q, v, u): (f64, &S::Vector, &S::Vector, &S::Inputs),
    ) -> Result<(), StepError> {
        let question = Question {
            motion: self.mode.motion.map(Some),
            excluded: None,
            turned: None,
        };
        with_parts(system, t, q, v, u, |parts, _| {
            match question.answer(parts) {
                Err(paradox) if paradox.several => Err(paradox.singular()),
                // Where there is none, its state has ended: that is seen elsewhere.
                _ => Ok(()),
            }
        })
        .map_err(|singular| StepError::Singular { singular, t })
    }

    /// Decides anew after the state of a contact has ended, and stops what has come to rest.
    #[cfg(feature = "std")]
    pub fn change<S: System>(
        &mut self,
        system: &S,
        (t, q, u): (f64, &S::Vector, &S::Inputs),
        v: [&mut S::Vector; 2],
        change: Change,
        is_at_once: bool,
    ) -> Result<(), StepError> {
        let now = slips(system, t, q, v[0]);
        let mut resting = [false; MOST_CONTACTS];
        for k in 0..self.count {
            resting[k] = match self.mode.motion[k] {
                Motion::Sticks => true,
                Motion::Slides(_) => now[k].abs() <= AT_REST * self.sizes[k],
            };
        }
        let k = change.contact;
        resting[k] |= change.cause == Cause::Stopped;
        let [v, v_low] = v;
        self.stop(system, (t, q, u), [&mut *v, v_low], &resting)?;
        let mut motion: [Option<Motion>; MOST_CONTACTS] =
            core::array::from_fn(|k| (!resting[k]).then_some(self.mode.motion[k]));
        let own = (k, self.mode.motion[k]);
        let at = |singular| StepError::Singular { singular, t };
        if change.cause == Cause::BrokeAway {
            let held = with_parts(system, t, q, v, u, |parts, _| self.friction_forces(parts));
            let held = held.map_err(at)?;
            // Against what held it. Just here its slip may not even grow: it is where the friction of
            // what sticks and of what slides are the same.
            motion[k] = Some(Motion::Slides(-held[k].signum()));
        }
        let question = Question {
            motion,
            excluded: match change.cause {
                Cause::BrokeAway => None,
                Cause::Turned => Some((own.0, own.1, Some(self.mode.press[k]))),
                // It did not even begin to slide so.
                Cause::Stopped if is_at_once => Some((own.0, own.1, None)),
                Cause::Stopped => None,
            },
            turned: (change.cause == Cause::Turned).then_some((own.0, own.1, -self.mode.press[k])),
        };
        let decided = with_parts(system, t, q, v, u, |parts, _| {
            question.answer(parts).map_err(Paradox::singular)
        });
        (self.mode, _) = decided.map_err(at)?;
        Ok(())
    }

    /// Keeps what sticks at rest, after a step.
    #[inline]
    pub fn hold<S: System>(
        &self,
        system: &S,
        (t, q, u): (f64, &S::Vector, &S::Inputs),
        v: [&mut S::Vector; 2],
    ) -> Result<(), StepError> {
        if !self.sticks() {
            return Ok(());
        }
        let resting = self.mode.motion.map(|motion| motion == Motion::Sticks);
        self.stop(system, (t, q, u), v, &resting)
    }

    fn sticks(&self) -> bool {
        self.mode.motion[..self.count].contains(&Motion::Sticks)
    }

    fn friction_forces(&self, parts: &Parts<'_>) -> Result<Each, Singular> {
        parts.friction_forces(&self.mode).map_err(Paradox::singular)
    }

    /// Accelerations of what sticks that only rounding keeps from being what they must be: where one
    /// coordinate alone makes the slip, its acceleration is known without any friction.
    fn still<S: System>(
        &self,
        system: &S,
        (t, q, v): (f64, &S::Vector, &S::Vector),
        a: &mut S::Vector,
        workspace: &mut [f64],
    ) {
        let n = q.as_slice().len();
        let (rows, drift) = workspace[..self.count * (n + 1)].split_at_mut(self.count * n);
        system.slip_matrix(t, q, rows);
        system.slip_drift(t, q, v, drift);
        for (k, row) in rows.chunks_exact(n).enumerate() {
            if self.mode.motion[k] == Motion::Sticks
                && let Some(i) = only_entry(row)
            {
                a.as_mut_slice()[i] = -drift[k] / row[i];
            }
        }
    }

    /// Stops the contacts that are to rest, by the least change of the rates in the metric of
    /// inertia. Where one coordinate alone makes the slip, to the last bit.
    fn stop<S: System>(
        &self,
        system: &S,
        (t, q, u): (f64, &S::Vector, &S::Inputs),
        [v, v_low]: [&mut S::Vector; 2],
        resting: &[bool; MOST_CONTACTS],
    ) -> Result<(), StepError> {
        let before = v.clone();
        let now = slips(system, t, q, v);
        let moving = |k: usize| resting[k] && now[k] != 0.0;
        if !(0..self.count).any(moving) {
            return Ok(());
        }
        let stopped = with_parts(system, t, q, &before, u, |parts, workspace| {
            let (n, count) = (parts.layout.n, self.count);
            // dw = W Λ for impulses Λ along the contacts: those that rest get dw = −w.
            let mut rows = [[0.0; MOST_CONTACTS + 1]; MOST_CONTACTS];
            for (k, row) in rows[..count].iter_mut().enumerate() {
                if !resting[k] {
                    row[k] = 1.0;
                    continue;
                }
                for (j, x) in row[..count].iter_mut().enumerate() {
                    if resting[j] {
                        *x = parts.at(1 + j, parts.slip_rate(k));
                    }
                }
                row[count] = -now[k];
            }
            if let Some(impulses) = solve(&mut rows, count) {
                for (i, v) in v.as_mut_slice().iter_mut().enumerate() {
                    let by = (0..count).map(|k| parts.at(1 + k, i) * impulses[k]);
                    let by: f64 = by.sum();
                    if by != 0.0 {
                        *v += by;
                        v_low.as_mut_slice()[i] = 0.0;
                    }
                }
            }
            let matrix = &mut workspace[..count * n];
            system.slip_matrix(t, q, matrix);
            for (k, row) in matrix.chunks_exact(n).enumerate() {
                if resting[k]
                    && let Some(i) = only_entry(row)
                {
                    v.as_mut_slice()[i] = 0.0;
                    v_low.as_mut_slice()[i] = 0.0;
                    let left = slips(system, t, q, v)[k];
                    if left != 0.0 {
                        v.as_mut_slice()[i] = -left / row[i];
                    }
                }
            }
            Ok(())
        });
        stopped.map_err(|singular| StepError::Singular { singular, t })
    }
}

/// The place of the only entry of a row that is not zero.
fn only_entry(row: &[f64]) -> Option<usize> {
    let mut entries = row.iter().enumerate().filter(|(_, x)| **x != 0.0);
    match (entries.next(), entries.next()) {
        (Some((i, _)), None) => Some(i),
        _ => None,
    }
}
