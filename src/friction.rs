//! Coulomb friction in guided contacts: which contacts stick, which slide, and their forces.
//!
//! ```text
//! slides   F = −s μ |N|,   s = sgn w         until w = 0
//! sticks   dw/dt = 0,  |F| ≤ μ₀ |N|          until |F| = μ₀ |N|
//! ```
//!
//! Accelerations, `dw/dt` and the normal reactions `N` are affine functions of the friction forces `F` of all contacts
//! ([`System::friction`]). For given states of the contacts this leaves one equation for each of them, `F + s η μ N(F) = 0` or
//! `dw/dt(F) = 0`, where η is the sign of `N`. They are solved with complete pivoting: the matrix is not symmetric, and it may be
//! singular (P. Painlevé, *Leçons sur le frottement*, 1895). In space `N` is a vector across the guide, and `|F| = μ |N(F)|` is not
//! linear: for one contact it is quadratic; for several it has a unique solution if it is a contraction. If that cannot be shown, the
//! run ends with an error.
//!
//! On a surface the slip has two components, along two tangents. Each tangent is represented as a contact, the second behind the first
//! ([`System::second_tangents`]). The two obey the same law together, with the direction of the slip in place of its sign:
//!
//! ```text
//! slides   F = −μ |N| w/|w|                   until w = 0
//! sticks   dw/dt = 0,  |F| ≤ μ₀ |N|           until |F| = μ₀ |N|
//! ```
//!
//! A contact that starts to slide from rest goes in the direction `e` for which `dw/dt` with `F = −μ |N| e` is along `e`. When a slip
//! stops, its speed has a minimum and no sign change. Therefore the motion is continued smoothly through rest, as if the slip reversed
//! along the direction that it had at the beginning of the step. Where the slip becomes perpendicular to that direction, the step ends:
//! there if the slip has vanished, and shortly before if it has turned.
//!
//! The states of all contacts have to be determined together. This is done only when a contact comes to rest, breaks away, or changes
//! the side on which it presses. In the plane this is a linear complementarity problem, that of pairs of opposite unilateral contacts
//! ([`contact_law`](crate::contact_law); F. Pfeiffer, C. Glocker, *Multibody Dynamics with Unilateral Contacts*, 1996, chapters 5 and 6). Contacts
//! that do not depend on each other are solved for separately. If it is not proved that there is only one solution (E80), all combinations are
//! examined, unless there are too many, which shows whether there is only one.
//! In between, the states are kept: the motion is smooth, and sticking contacts are held at `w = 0` itself. In the plane contacts that stick
//! and depend on each other hold as long as any distribution of their forces permits it (`shares`); then they break away together.

mod at_rest;
#[cfg(feature = "std")]
mod changes;
mod law;
mod per_contact;

#[cfg(feature = "std")]
pub(crate) use changes::{Cause, Change};
use law::{Each, Layout, OpenStates, Paradox, Parts, length};
pub(crate) use law::{Mode, Motion};

use per_contact::{FEW_CONTACTS, PerContact};

use crate::at::At;
use crate::scalar::friction::FrictionLayout;
use crate::{Pivot, Singular, StepError, System, Vector};

/// A slip on a surface below this, relative to the largest in the run, keeps the direction that it had at the beginning of the step.
const NO_DIRECTION: f64 = 1e-14;

/// The length of the workspace for constraints and contacts, which is passed to [`System::with_workspace`].
///
/// In space reactions have three components; use [`contact_workspace_in_space`].
pub const fn contact_workspace(coordinates: usize, constraints: usize, contacts: usize) -> usize {
    workspace(coordinates, constraints, contacts, 1)
}

/// Like [`contact_workspace`], for a machine in space.
pub const fn contact_workspace_in_space(
    coordinates: usize,
    constraints: usize,
    contacts: usize,
) -> usize {
    workspace(coordinates, constraints, contacts, 3)
}

const fn workspace(coordinates: usize, constraints: usize, contacts: usize, axes: usize) -> usize {
    let of_friction = FrictionLayout {
        coordinates,
        constraints,
        contacts,
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

/// The state of a contact and its forces.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ContactForce {
    /// The slip rate along its direction, in m/s. On a surface it is the component along one of the two tangents, each of which is
    /// represented as a contact.
    pub slip: f64,
    /// The normal reaction, in N. In the plane it is positive if it pushes the body to the side of the normal; in space it is the length
    /// of the vector.
    pub normal: f64,
    /// The friction force on the body along the direction, in N.
    pub friction: f64,
    /// Whether it sticks.
    pub sticks: bool,
}

/// State of the guided contacts during a run.
#[derive(Clone, Debug)]
pub(crate) struct Contacts {
    count: usize,
    /// The contacts that are second tangents of surfaces, as a bit mask.
    seconds: u64,
    /// The state of each contact. The direction of a sliding contact is the one at the beginning of the step: the motion is continued
    /// smoothly through rest, as if the slip reversed, and the step then ends there.
    pub mode: Mode,
    /// The largest slips so far.
    sizes: Each,
    /// Whether directions are continued through rest.
    continues_through_rest: bool,
}

/// Accelerations and multipliers of a machine with contacts, and the contact forces, at a state.
///
/// A contact whose slip is nonzero slides. For all contacts whose slip is 0 to rounding ([`System::slip_ranges`]) it is decided
/// together whether they stick or start to slide. A run knows more: there a contact that has come to rest stays at rest until its
/// friction is used up.
///
/// # Errors
/// If the machine itself is singular, if no motion or several motions are possible with these contacts ([`Pivot::Contact`]), or if the
/// machine has no workspace ([`Pivot::NoWorkspace`]).
pub fn contact_forces<S: System>(
    system: &S,
    At { t, q, v, u }: At<'_, S>,
    accelerations: &mut [f64],
    multipliers: &mut [f64],
    forces: &mut [ContactForce],
) -> Result<(), Singular> {
    require_memory(system)?;
    let slips = resting_slips(system, t, q, v);
    with_parts(system, t, q, v, u, |parts, _| {
        let known = OpenStates::from_slips(&slips, parts.layout);
        let (mode, friction_forces) = known.answer(parts).map_err(Paradox::singular)?;
        results(parts, &friction_forces, accelerations, multipliers);
        contact_forces_of_mode(parts, &mode, &friction_forces, &slips, forces);
        Ok(())
    })
}

/// [`System::accelerations`] of a machine with contacts, from [`contact_forces`].
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
        At { t, q, v, u },
        a.as_mut_slice(),
        &mut [],
        &mut [],
    )
}

/// [`System::multipliers`] of a machine with contacts, from [`contact_forces`].
pub fn multipliers_with_friction<S: System>(
    system: &S,
    t: f64,
    q: &S::Vector,
    v: &S::Vector,
    u: &S::Inputs,
    multipliers: &mut [f64],
) -> Result<(), Singular> {
    contact_forces(system, At { t, q, v, u }, &mut [], multipliers, &mut [])
}

/// Calls `work` with the response of the machine to friction forces, and with the remaining workspace.
fn with_parts<S: System, R>(
    system: &S,
    t: f64,
    q: &S::Vector,
    v: &S::Vector,
    u: &S::Inputs,
    work: impl FnOnce(&Parts<'_>, &mut [f64]) -> Result<R, Singular>,
) -> Result<R, Singular> {
    let response = FrictionLayout {
        coordinates: q.as_slice().len(),
        constraints: system.constraints().len(),
        contacts: system.contacts().len(),
        axes: system.reaction_axes(),
    };
    let layout = Layout {
        response,
        seconds: system.second_tangents(),
    };
    let length = workspace(
        response.coordinates,
        response.constraints,
        response.contacts,
        response.axes,
    );
    system.with_workspace(length, |workspace| {
        // Without an allocator, a machine without a workspace, or with one that is too small, returns an error.
        let workspace = workspace.filter(|workspace| workspace.len() >= length);
        let Some((values, rest)) =
            workspace.and_then(|workspace| workspace.split_at_mut_checked(response.len()))
        else {
            return Err(NO_WORKSPACE);
        };
        system.friction(t, q, v, u, values)?;
        work(&Parts { layout, values }, rest)
    })
}

/// Without an allocator there is memory for few contacts only.
fn require_memory<S: System>(system: &S) -> Result<(), Singular> {
    if cfg!(feature = "std") || system.contacts().len() <= FEW_CONTACTS {
        return Ok(());
    }
    Err(NO_WORKSPACE)
}

const NO_WORKSPACE: Singular = Singular {
    at: Pivot::NoWorkspace,
    ratio: 0.0,
};

fn slips<S: System>(system: &S, t: f64, q: &S::Vector, v: &S::Vector) -> Each {
    let mut slips = Each::new(system.contacts().len(), 0.0);
    system.slips(t, q, v, &mut slips);
    slips
}

/// The slips, with 0 for contacts that rest to rounding.
fn resting_slips<S: System>(system: &S, t: f64, q: &S::Vector, v: &S::Vector) -> Each {
    let mut slips = slips(system, t, q, v);
    if slips.iter().all(|slip| *slip == 0.0) {
        return slips;
    }
    let mut ranges = PerContact::new(slips.len(), [f64::INFINITY; 2]);
    system.slip_ranges(t, q, v, &mut ranges);
    for (slip, [from, to]) in slips.iter_mut().zip(ranges.iter().copied()) {
        if from.is_finite() && to.is_finite() && from <= 0.0 && to >= 0.0 {
            *slip = 0.0;
        }
    }
    slips
}

/// Accelerations and multipliers with these friction forces, as many as the slices hold.
fn results(parts: &Parts<'_>, friction_forces: &Each, a: &mut [f64], multipliers: &mut [f64]) {
    for (i, a) in a.iter_mut().enumerate() {
        *a = parts.sum(i, friction_forces)[0];
    }
    for (i, multiplier) in multipliers.iter_mut().enumerate() {
        *multiplier = parts.sum(parts.layout.response.multiplier(i), friction_forces)[0];
    }
}

/// The contact forces in these states with these friction forces.
fn contact_forces_of_mode(
    parts: &Parts<'_>,
    mode: &Mode,
    friction_forces: &Each,
    slips: &Each,
    forces: &mut [ContactForce],
) {
    for (k, force) in forces.iter_mut().enumerate().take(parts.layout.contacts()) {
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
        require_memory(system).map_err(|singular| StepError::Singular { singular, t })?;
        let slips = resting_slips(system, t, q, v);
        let mode = with_parts(system, t, q, v, u, |parts, _| {
            let open_states = OpenStates::from_slips(&slips, parts.layout);
            let (mode, _) = open_states.answer(parts).map_err(Paradox::singular)?;
            Ok(mode)
        });
        let mut contacts = Contacts {
            count: system.contacts().len(),
            seconds: system.second_tangents(),
            continues_through_rest: true,
            mode: mode.map_err(|singular| StepError::Singular { singular, t })?,
            sizes: Each::new(slips.len(), 0.0),
        };
        contacts.accept(system, t, q, v);
        Ok(contacts)
    }

    /// Records a state.
    pub fn accept<S: System>(&mut self, system: &S, t: f64, q: &S::Vector, v: &S::Vector) {
        for (size, slip) in self.sizes.iter_mut().zip(&*slips(system, t, q, v)) {
            *size = size.max(slip.abs());
        }
    }

    /// Records the directions of sliding contacts at the beginning of a step.
    pub fn record_headings<S: System>(&mut self, system: &S, t: f64, q: &S::Vector, v: &S::Vector) {
        if self.slides_on_surface() {
            let as_seen = Contacts {
                continues_through_rest: false,
                ..self.clone()
            };
            self.mode = as_seen.mode_of(&slips(system, t, q, v));
        }
    }

    /// The contacts as seen after the run, at any time until their next change, by which a slip may have turned in any direction.
    #[cfg(feature = "std")]
    pub fn for_later_observation(&self) -> Contacts {
        Contacts {
            continues_through_rest: false,
            ..self.clone()
        }
    }

    fn slides_on_surface(&self) -> bool {
        self.seconds != 0 && self.mode.motion.contains(&Motion::SlidesAlong)
    }

    /// Whether a contact is the first of the two tangents of a surface.
    fn has_second(&self, contact: usize) -> bool {
        // The last contact is none, so that no bit is shifted out.
        contact + 1 < self.count && self.seconds >> (contact + 1) & 1 != 0
    }

    /// The first of the two tangents of each contact on a surface.
    fn on_surfaces(&self) -> impl Iterator<Item = usize> {
        (0..self.count).filter(|k| self.has_second(*k))
    }

    /// The state of each contact with these slips. A sliding contact goes along its slip, or has come through rest since the step
    /// began, in which case its slip counts as reversed.
    fn mode_of(&self, slips: &Each) -> Mode {
        let mut mode = self.mode.clone();
        if !self.slides_on_surface() {
            return mode;
        }
        for k in self
            .on_surfaces()
            .filter(|k| self.mode.motion[*k] == Motion::SlidesAlong)
        {
            let speed = length([slips[k], slips[k + 1]]);
            let greatest = length([self.sizes[k], self.sizes[k + 1]]);
            if speed == 0.0 || speed <= NO_DIRECTION * greatest {
                continue;
            }
            let heading = [mode.slip_direction[k], mode.slip_direction[k + 1]];
            let ahead = heading[0] * slips[k] + heading[1] * slips[k + 1];
            let way = if self.continues_through_rest && ahead < 0.0 {
                -speed
            } else {
                speed
            };
            (mode.slip_direction[k], mode.slip_direction[k + 1]) =
                (slips[k] / way, slips[k + 1] / way);
        }
        mode
    }

    /// The state of each contact as [`mode_of`](Self::mode_of) says, which in most machines is the one at the beginning of the step.
    fn seen<'m>(&'m self, slips: impl FnOnce() -> Each, memory: &'m mut Option<Mode>) -> &'m Mode {
        if self.slides_on_surface() {
            memory.insert(self.mode_of(&slips()))
        } else {
            &self.mode
        }
    }

    /// Accelerations in the present states of the contacts; sticking contacts do not creep.
    pub fn accelerations<S: System>(
        &self,
        system: &S,
        At { t, q, v, u }: At<'_, S>,
        a: &mut S::Vector,
    ) -> Result<(), Singular> {
        let mut memory = None;
        let mode = self.seen(|| slips(system, t, q, v), &mut memory);
        with_parts(system, t, q, v, u, |parts, workspace| {
            let friction_forces = friction_forces(parts, mode)?;
            results(parts, &friction_forces, a.as_mut_slice(), &mut []);
            if self.sticks() {
                self.correct_sticking_accelerations(system, (t, q, v), a, workspace);
            }
            Ok(())
        })
    }

    /// The forces in the contacts and the multipliers.
    #[cfg(feature = "std")]
    pub fn forces<S: System>(
        &self,
        system: &S,
        At { t, q, v, u }: At<'_, S>,
        multipliers: &mut [f64],
        forces: &mut [ContactForce],
    ) -> Result<(), Singular> {
        let slips = slips(system, t, q, v);
        with_parts(system, t, q, v, u, |parts, _| {
            let shared = parts.shared_forces(&self.mode_of(&slips));
            let (friction_forces, _) = shared.map_err(Paradox::singular)?;
            results(parts, &friction_forces, &mut [], multipliers);
            contact_forces_of_mode(parts, &self.mode, &friction_forces, &slips, forces);
            Ok(())
        })
    }

    /// The powers of the friction forces, in W: the work that prescribed motion does through them, and the loss, `−Σ Fₖ wₖ`. Their
    /// difference is the power on the coordinates, `Σ Fₖ τₖ v`.
    pub fn power<S: System>(&self, system: &S, At { t, q, v, u }: At<'_, S>) -> [f64; 2] {
        let slips = slips(system, t, q, v);
        let power = with_parts(system, t, q, v, u, |parts, workspace| {
            let mut memory = None;
            let mode = self.seen(|| slips.clone(), &mut memory);
            let friction_forces = friction_forces(parts, mode)?;
            let n = parts.layout.response.coordinates;
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
}

fn friction_forces(parts: &Parts<'_>, mode: &Mode) -> Result<Each, Singular> {
    parts.friction_forces(mode).map_err(Paradox::singular)
}
