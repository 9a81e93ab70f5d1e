//! Contacts in time stepping: their impulses in a step of a fixed length.
//!
//! ```text
//! qₘ = q + h/2 v        M (v⁺ − v) = h f + Σ wₙ Λₙ + Σ wₜ Λₜ        q⁺ = qₘ + h/2 v⁺ + Σ (w − ½) h M⁻¹ (wₙ Λₙ + wₜ Λₜ)
//! 0 ≤ Λₙ ⊥ γₙ⁺ − b ≥ 0,   −Λₜ ∈ μ Λₙ Sgn ξ
//! ```
//!
//! with everything in the middle of the step, for contacts that were closed, or whose gap would be negative at the end of the step. The rates b, and the parts w of the step that are left after
//! an impulse, are those of a contact that is alone (`approach`). A contact that bounces has `ξ = γₜ⁺ + eₜ γₜ` at the instant at which it does, and any other one `ξ = γₜ⁺` at the end of the step. With w = ½ and b = −e γₙ this is Moreau's step.
//! (J. J. Moreau, *Unilateral contact and dry friction in finite freedom dynamics*, 1988,
//! section 8.) A guide presses with its mean reaction to all of this, `Λₙ = h (ν − z·f) + (ρ + M z)·(v⁺ − v) + (κ − W z)·Λ` in the terms of `guides`, to either side, and rubs with μ |Λₙ|.
//! This is the law `newton`, with all contacts at once; `laws` has the step for other laws and for static friction. A penetration at the end of a
//! step is removed by the smallest displacement in the metric of inertia (V. Acary,
//! *Projected event-capturing time-stepping schemes for nonsmooth mechanical systems with unilateral contact and Coulomb's
//! friction*, Comput. Methods Appl. Mech. Eng. 256 (2013) 224–250), and the energy that it adds is taken out of the rates (`penetration`).

mod approach;
mod laws;
mod penetration;

use std::vec::Vec;

use super::drives::{ActingContact, Drives, DrivesMemory};
use super::impact::{Meeting, acts_on};
use super::kinematics::ContactKinematics;
use super::problem::SATURATED;
use super::{ContactTrouble, Impact, ImpactLaw, ImpactOrder, Mode, UnilateralState};
use crate::at::At;
use crate::{StepError, System, Vector};
use approach::Course;
use laws::{ContactsOfStep, ImpulsesOfStep, LawsMemory};
use penetration::PenetrationMemory;

/// What contacts did in a step.
#[derive(Debug, Default)]
pub(crate) struct SteppedContacts {
    /// The impulses that they gave.
    pub impacts: Vec<Impact>,
    /// For each of these the first one of those that inertia couples with it, and the energy that is not told from that of forces which act within the step, in J: friction that ends
    /// or begins in the step does so at one of its ends.
    pub groups: Vec<usize>,
    pub untold: Vec<f64>,
    /// The work that what moves by itself did through them, and what they took, in J.
    pub work: f64,
    pub lost: f64,
    /// Contacts that were penetrated at the end of the step, and the energy that moving out of them has added, in J, where the rates did not have as much.
    pub penetrated: Vec<usize>,
    pub energy_added: f64,
    /// Contacts that shared their impulses in another way than by the rule for undetermined forces, (E79), although the motion depends on it.
    pub shared_otherwise: Vec<usize>,
    /// Contacts whose friction permitted no rates with their restitution: they met without.
    pub jammed: Vec<usize>,
    /// Contacts that touched and gave no impulse, since none of all contacts together were found: they were open in the middle of the step.
    pub left_out: Vec<usize>,
}

clone_into_memory!(SteppedContacts {
    impacts,
    groups,
    untold,
    work,
    lost,
    penetrated,
    energy_added,
    shared_otherwise,
    jammed,
    left_out,
});

impl SteppedContacts {
    /// Nothing has happened.
    pub fn clear(&mut self) {
        self.impacts.clear();
        self.groups.clear();
        self.untold.clear();
        self.penetrated.clear();
        self.shared_otherwise.clear();
        self.jammed.clear();
        self.left_out.clear();
        (self.work, self.lost, self.energy_added) = (0.0, 0.0, 0.0);
    }
}

/// Memory of steps, which serves again from one to the next: they allocate only where they meet more contacts than ever before, where contacts share a load and
/// slip, and in impacts by a law for an instant.
#[derive(Clone, Debug)]
pub(crate) struct SteppingMemory<V, M> {
    /// The rates of all contacts at the end of the step without impulses.
    free: Vec<f64>,
    /// What the contacts do after the step, and their mean forces in it.
    modes: Vec<Mode>,
    forces: Vec<[f64; 2]>,
    /// The sides to which contacts press after it.
    sides: Vec<f64>,
    meeting: Meeting,
    entries: Vec<usize>,
    matrix: M,
    /// The same rates of those that touch, the courses of their gaps, and the rates with impulses.
    free_of_touching: Vec<f64>,
    /// The reactions of guides to forces alone, with two numbers for each of those that touch, as [`ContactsOfStep`] has them; nothing without guides.
    loads: Vec<f64>,
    courses: Vec<Course>,
    after: Vec<f64>,
    impulses: ImpulsesOfStep,
    laws: LawsMemory,
    /// The change of the rates of coordinates by impulses, by those of one contact, and the mean of the rates.
    change: Vec<f64>,
    of_contact: Vec<f64>,
    /// How the impulses move the end of the step, beside changing the rates.
    shift: Vec<f64>,
    /// By how much forces change the rates in the step.
    of_forces: Vec<f64>,
    /// What the impulses of each contact took along its normal, in J: from this comes the energy with which it is moved out of what it has penetrated.
    paid: Vec<f64>,
    /// The places of impacts among the contacts that touch.
    places: Vec<usize>,
    mean: V,
    drives: DrivesMemory<V>,
    penetration: PenetrationMemory,
}

impl<V: Vector, M: Vector> SteppingMemory<V, M> {
    pub fn new(q: &V) -> Self {
        let n = q.as_slice().len();
        Self {
            free: Vec::new(),
            modes: Vec::new(),
            forces: Vec::new(),
            sides: Vec::new(),
            meeting: Meeting::default(),
            entries: Vec::new(),
            matrix: M::zeros(n * n),
            free_of_touching: Vec::new(),
            loads: Vec::new(),
            courses: Vec::new(),
            after: Vec::new(),
            impulses: ImpulsesOfStep::default(),
            laws: LawsMemory::default(),
            change: Vec::new(),
            of_contact: Vec::new(),
            shift: Vec::new(),
            of_forces: Vec::new(),
            paid: Vec::new(),
            places: Vec::new(),
            mean: q.zeros_like(),
            drives: DrivesMemory::new(q),
            penetration: PenetrationMemory::default(),
        }
    }

    /// How the impulses of the last step move its end, beside changing the rates; empty if they do not.
    pub fn shift(&self) -> &[f64] {
        &self.shift
    }
}

impl UnilateralState {
    /// Whether time stepping knows the laws of the contacts: all rigid ones.
    ///
    /// # Errors
    /// The first contact that yields.
    pub fn check_stepping(&self, t: f64) -> Result<(), StepError> {
        match (0..self.modes().len()).find(|k| self.is_compliant(*k)) {
            Some(contact) => Err(StepError::Contact {
                contact,
                trouble: ContactTrouble::NotStepped,
                t,
            }),
            None => Ok(()),
        }
    }

    /// Whether a step of all contacts is one problem, whatever closes in it.
    fn steps_in_one_problem(&self) -> bool {
        self.order == ImpactOrder::AtOnce && self.law == ImpactLaw::Newton
    }

    /// Adds the impulses of the contacts in a step of length `h` to `v`, which on entry is what the rates would be at its
    /// end without them. The middle of the step is that without impulses, and `before` are the rates at its beginning. What the contacts did is written to
    /// `stepped`, which on entry says nothing.
    ///
    /// # Errors
    /// Where the mass matrix is singular, or no impulses obey the law.
    pub fn step<S: System>(
        &mut self,
        system: &S,
        middle: At<'_, S>,
        (before, v): (&S::Vector, &mut S::Vector),
        h: f64,
        (stepped, memory): (
            &mut SteppedContacts,
            &mut SteppingMemory<S::Vector, S::Matrix>,
        ),
    ) -> Result<(), StepError> {
        let At { t, q, .. } = middle;
        let here = self.kinematics(system, (t, q, before));
        self.write_touching(system, (t, q), (&here, before, v), h, memory);
        if memory.meeting.contacts.is_empty() {
            self.set_stepped(&memory.modes, &memory.forces);
            return Ok(());
        }
        let SteppingMemory {
            modes,
            forces,
            meeting,
            entries,
            matrix,
            free_of_touching,
            loads,
            courses,
            impulses,
            laws,
            of_forces,
            ..
        } = &mut *memory;
        meeting.evaluate(system, (t, q), &here, (matrix, entries))?;
        self.write_courses(&here, (meeting, free_of_touching), h, courses);
        if courses.iter().any(Course::waits) {
            let mut waits = courses.iter().map(Course::waits);
            (meeting.contacts).retain(|_| !waits.next().unwrap_or(false));
            let mut waits = courses.iter().flat_map(|course| [course.waits(); 2]);
            free_of_touching.retain(|_| !waits.next().unwrap_or(false));
            if meeting.contacts.is_empty() {
                self.set_stepped(modes, forces);
                return Ok(());
            }
            meeting.evaluate(system, (t, q), &here, (matrix, entries))?;
            self.write_courses(&here, (meeting, free_of_touching), h, courses);
        }
        loads.clear();
        if self.has_guides() {
            meeting.guides.evaluate_loads(system, middle);
            write_loads(meeting, (of_forces, h), loads);
        }
        let contacts_of_step = ContactsOfStep {
            touching: self,
            here: &here,
            meeting,
            t,
            h,
            free: free_of_touching,
            loads,
            courses,
        };
        contacts_of_step.write_impulses(impulses, laws)?;
        let changed = self.write_change(system, (t, q), (&here, before, v), memory);
        self.tell(system, (t, q), &here, h, (stepped, memory));
        stepped.work += changed;
        self.set_stepped(&memory.modes, &memory.forces);
        if self.has_guides() {
            self.set_sides(&memory.sides);
        }
        Ok(())
    }

    /// Writes which contacts touch in a step: those that were closed, which may come back to their gaps, those that are closed in the middle, and those that would have penetrated
    /// something at its end.
    fn write_touching<S: System>(
        &self,
        system: &S,
        (t, q): (f64, &S::Vector),
        (here, before, v): (&ContactKinematics, &S::Vector, &S::Vector),
        h: f64,
        memory: &mut SteppingMemory<S::Vector, S::Matrix>,
    ) {
        let SteppingMemory {
            free,
            modes,
            forces,
            meeting,
            free_of_touching,
            shift,
            of_forces,
            paid,
            ..
        } = memory;
        let count = self.modes().len();
        free.clear();
        free.resize(2 * count, 0.0);
        system.contact_rates(t, q, v, free);
        let touches = |k: &usize| {
            let lasts = self.modes()[*k] != Mode::Open;
            let may_close = here.gaps[*k] + 0.5 * h * free[2 * *k] < 0.0;
            let closes = || may_close && Course::of(here, *k, free[2 * *k], h).closes();
            (lasts || here.is_gap_closed(*k) || closes()) && here.is_within(*k, q.as_slice())
        };
        meeting.contacts.clear();
        meeting.contacts.extend(self.in_order().filter(touches));
        free_of_touching.clear();
        (free_of_touching).extend(
            meeting
                .contacts
                .iter()
                .flat_map(|k| [free[2 * k], free[2 * k + 1]]),
        );
        modes.clear();
        modes.resize(count, Mode::Open);
        forces.clear();
        forces.resize(count, [0.0; 2]);
        paid.clear();
        paid.resize(count, 0.0);
        shift.clear();
        of_forces.clear();
        let pairs = v.as_slice().iter().zip(before.as_slice());
        of_forces.extend(pairs.map(|(free, before)| free - before));
    }

    /// Writes the courses of the gaps of contacts that touch; what depends on another contact has that one's.
    fn write_courses(
        &self,
        here: &ContactKinematics,
        (meeting, free): (&Meeting, &[f64]),
        h: f64,
        courses: &mut Vec<Course>,
    ) {
        courses.clear();
        let width = meeting.directions.len();
        for (place, &k) in meeting.contacts.iter().enumerate() {
            if self.carrier(k).is_some()
                && let Some(carrier) = courses.last()
            {
                courses.push(*carrier);
                continue;
            }
            let mut course = Course::of(here, k, free[2 * place], h);
            course.lasts = self.modes()[k] != Mode::Open;
            if course.lasts
                && !self.steps_in_one_problem()
                && let Some(forces) = self.stepped()
            {
                // What others press is not an impact that an instantaneous law should be asked about.
                course.pressed = meeting.g[2 * place * width + 2 * place] * forces[k][0];
            }
            courses.push(course);
        }
        let is_own = |place: usize| self.carrier(meeting.contacts[place]).is_none();
        for place in 0..courses.len() {
            courses[place].is_coupled = if is_own(place) || place == 0 {
                let mut others =
                    (0..courses.len()).filter(|other| *other != place && is_own(*other));
                others.any(|other| is_coupled(meeting, [place, other]))
            } else {
                courses[place - 1].is_coupled
            };
        }
        if self.steps_in_one_problem() {
            write_pressing(meeting, courses);
        }
    }

    /// Adds what the impulses do to the rates, and writes how they move the end of the step. The kinetic energy that they add with the mean rates of the step, in J.
    fn write_change<S: System>(
        &self,
        system: &S,
        (t, q): (f64, &S::Vector),
        (here, before, v): (&ContactKinematics, &S::Vector, &mut S::Vector),
        memory: &mut SteppingMemory<S::Vector, S::Matrix>,
    ) -> f64 {
        let SteppingMemory {
            meeting,
            impulses,
            change,
            shift,
            mean,
            ..
        } = memory;
        let Meeting {
            directions,
            inertia,
            images,
            ..
        } = &*meeting;
        let energy_free = system.kinetic_energy(t, q, v);
        // This is the work of the impulses along the changes of the rates that are not theirs.
        let mut known_normal = 0.0;
        for (&direction, impulse) in directions.iter().zip(impulses.all.as_flattened()) {
            let row = here.row(direction).iter();
            let terms = row.zip(before.as_slice().iter().zip(v.as_slice()));
            known_normal += impulse
                * terms
                    .map(|(w, (before, free))| w * (before - free))
                    .sum::<f64>();
        }
        inertia.write_response(images, impulses.all.as_flattened().iter().copied(), change);
        for (v, by) in v.as_mut_slice().iter_mut().zip(&*change) {
            *v += by;
        }
        if impulses
            .shifts
            .as_flattened()
            .iter()
            .any(|shift| *shift != 0.0)
        {
            let shifts = impulses.shifts.as_flattened().iter().copied();
            inertia.write_response(images, shifts, shift);
        }
        mean.clone_from(before);
        for (mean, after) in mean.as_mut_slice().iter_mut().zip(v.as_slice()) {
            *mean = 0.5 * (*mean + after);
        }
        system.kinetic_energy(t, q, v) - energy_free + 0.5 * known_normal
    }

    /// Writes what each contact did in a step, and as `work` what its impulses take with the mean rates of the step.
    fn tell<S: System>(
        &self,
        system: &S,
        (t, q): (f64, &S::Vector),
        here: &ContactKinematics,
        h: f64,
        (stepped, memory): (
            &mut SteppedContacts,
            &mut SteppingMemory<S::Vector, S::Matrix>,
        ),
    ) {
        let SteppingMemory {
            modes,
            forces,
            sides,
            meeting,
            free_of_touching: free,
            after,
            impulses,
            of_contact,
            mean,
            drives,
            paid,
            places,
            ..
        } = memory;
        let Meeting {
            contacts: active,
            inertia,
            images,
            before,
            ..
        } = &*meeting;
        contacts_at(
            active,
            &impulses.shared_otherwise,
            &mut stepped.shared_otherwise,
        );
        contacts_at(active, &impulses.jammed, &mut stepped.jammed);
        contacts_at(active, &impulses.left_out, &mut stepped.left_out);
        write_after(meeting, (free, &impulses.all), after);
        let mut drives = Drives::new(system, (t, q), drives);
        for (place, (&k, &impulse)) in active.iter().zip(&impulses.all).enumerate() {
            let Some(mode) = self.mode_of(here, (k, place), (&*impulses, &after[..]), modes) else {
                continue;
            };
            modes[k] = mode;
            forces[k] = impulse.map(|impulse| impulse / h);
            let losses = impulses.losses[place];
            paid[k] = losses[0];
            let [gap_rate, slip] = impulses.rates[place];
            let loss = losses[0] + losses[1];
            let sums = [0, 1].map(|part| before[2 * place + part] + after[2 * place + part]);
            stepped.work -= 0.5 * (impulse[0] * sums[0] + impulse[1] * sums[1]);
            stepped.lost += loss;
            let acting = ActingContact {
                contact: k,
                forces: impulse,
                rates: sums.map(|sum| 0.5 * sum),
            };
            let of_contact = &mut *of_contact;
            let response = move || {
                let by = of_contact;
                inertia.write_response(&images[2 * place..][..2], impulse, by);
                &by[..]
            };
            stepped.impacts.push(Impact {
                contact: k,
                gap_rate,
                slip,
                impulse,
                loss,
                work: drives.work(here, &acting, mean, response),
            });
        }
        (stepped.impacts).sort_unstable_by_key(|impact| impact.contact);
        write_groups(stepped, (meeting, free), places);
        if self.has_guides() {
            self.write_sides(stepped, sides);
        }
    }

    /// Writes the sides to which guides press after a step. What an impact in it made of a reaction says nothing of that.
    fn write_sides(&self, stepped: &SteppedContacts, sides: &mut Vec<f64>) {
        sides.clear();
        sides.extend_from_slice(self.sides());
        let SteppedContacts {
            impacts, groups, ..
        } = stepped;
        let is_hit = |group: usize| {
            let mut own = impacts.iter().zip(groups);
            own.any(|(impact, of)| *of == group && self.modes()[impact.contact] == Mode::Open)
        };
        for (impact, group) in impacts.iter().zip(groups) {
            let normal = impact.impulse[0];
            if self.is_guide(impact.contact) && normal != 0.0 && !is_hit(*group) {
                sides[impact.contact] = normal.signum();
            }
        }
    }

    /// What a contact did in a step, if it is closed at its end; of contacts before it this is known.
    fn mode_of(
        &self,
        here: &ContactKinematics,
        (k, place): (usize, usize),
        (impulses, after): (&ImpulsesOfStep, &[f64]),
        modes: &[Mode],
    ) -> Option<Mode> {
        // Of contacts that share a load some may press and some not, from step to step: what does not open is closed.
        let least = impulses.approaches[place].least.min(0.0);
        let opens =
            impulses.all[place] == [0.0; 2] && after[2 * place] - least > here.rate_rounding(2 * k);
        let opens = opens && !self.is_guide(k);
        if self.carrier(k).map_or(opens, |on| modes[on] == Mode::Open) {
            return None;
        }
        Some(match self.first(k) {
            first if first != k => modes[k - 1],
            _ if impulses.rests[place] => Mode::Sticks,
            _ => self.mode_after_step(here, (k, place), (&impulses.last, after)),
        })
    }

    /// What a contact did in a step that is not the second tangent of another one, with the impulses of those that touched, among which it has this place, and
    /// the rates along their directions at the end of the step.
    fn mode_after_step(
        &self,
        here: &ContactKinematics,
        (k, place): (usize, usize),
        (impulses, after): (&[[f64; 2]], &[f64]),
    ) -> Mode {
        if !self.has_friction(k) {
            return Mode::Slides(0.0);
        }
        let impulse = impulses[place];
        let pressing = match self.carrier(k) {
            Some(_) => impulses[place - 1][0],
            None => self.pressing(k, impulse[0]),
        };
        let most = here.friction(k)[0] * pressing;
        if self.second(k).is_some() {
            let used = [0, 1].map(|part| impulses[place + part][1]);
            let size = used[0].hypot(used[1]);
            let slips = [0, 1].map(|part| after[2 * (place + part) + 1]);
            let speed = slips[0].hypot(slips[1]);
            let [_, rounding] = self.slip(here, k);
            return if size < most * (1.0 - SATURATED) {
                Mode::Sticks
            } else if size > 0.0 {
                Mode::SlidesAlong(used.map(|used| -used / size))
            } else if speed > rounding[0].hypot(rounding[1]) {
                Mode::SlidesAlong(slips.map(|slip| slip / speed))
            } else {
                Mode::Sticks
            };
        }
        let slip = after[2 * place + 1];
        if impulse[1].abs() < most * (1.0 - SATURATED) {
            Mode::Sticks
        } else if impulse[1] != 0.0 {
            Mode::Slides(-impulse[1].signum())
        } else if slip.abs() > here.rate_rounding(2 * k + 1) {
            Mode::Slides(slip.signum())
        } else {
            Mode::Sticks
        }
    }
}

/// Writes which contacts are at these places.
fn contacts_at(active: &[usize], places: &[usize], contacts: &mut Vec<usize>) {
    contacts.clear();
    contacts.extend(places.iter().map(|place| active[*place]));
}

/// Writes with which acceleration forces press contacts together that inertia couples, directly or by others: what closes one of them presses the others by it. The feet of a body on
/// another one that rests on the floor fall together with the gaps that they have, and only the floor presses them.
fn write_pressing(meeting: &Meeting, courses: &mut [Course]) {
    for course in &mut *courses {
        course.pressed = if course.is_coupled {
            course.acceleration().max(0.0)
        } else {
            0.0
        };
    }
    loop {
        let mut changes = false;
        for place in 1..courses.len() {
            for other in (0..place).rev() {
                let pair = [place, other].map(|place| courses[place].pressed);
                if pair[0] != pair[1]
                    && courses[place].is_coupled
                    && courses[other].is_coupled
                    && is_coupled(meeting, [place, other])
                {
                    let most = pair[0].max(pair[1]);
                    (courses[place].pressed, courses[other].pressed) = (most, most);
                    changes = true;
                }
            }
        }
        if !changes {
            return;
        }
    }
}

/// Writes the rates of all directions with these impulses, from what they would be without.
fn write_after(meeting: &Meeting, (free, impulses): (&[f64], &[[f64; 2]]), after: &mut Vec<f64>) {
    let rows = meeting.g.chunks_exact(meeting.directions.len());
    after.clear();
    after.extend(free.iter().zip(rows).map(|(free, row)| {
        let by = row.iter().zip(impulses.as_flattened());
        free + by.map(|(g, i)| g * i).sum::<f64>()
    }));
    meeting.clear_rates_of_guides(after);
}

/// Writes the impulses of the reactions of guides to forces that change the rates of coordinates by this over a step of length `h`, each times `G_nn` of its guide.
fn write_loads(meeting: &Meeting, (change, h): (&[f64], f64), loads: &mut Vec<f64>) {
    let width = meeting.directions.len();
    loads.extend(meeting.contacts.iter().enumerate().flat_map(|(place, k)| {
        let unit = meeting.g[2 * place * width + 2 * place];
        [unit * meeting.guides.impulse_of_forces(*k, change, h), 0.0]
    }));
}

/// Writes which impacts inertia couples, directly or by others, and what energy is not told from that of forces within the step.
fn write_groups(
    stepped: &mut SteppedContacts,
    (meeting, free): (&Meeting, &[f64]),
    places: &mut Vec<usize>,
) {
    let SteppedContacts {
        impacts,
        groups,
        untold,
        ..
    } = stepped;
    let place_of = |impact: &Impact| meeting.contacts.iter().position(|k| *k == impact.contact);
    places.clear();
    places.extend(impacts.iter().filter_map(place_of));
    groups.clear();
    untold.clear();
    for (own, (&place, impact)) in places.iter().zip(&*impacts).enumerate() {
        let of_part = |part: usize| {
            let direction = 2 * place + part;
            let of_forces = free[direction] - meeting.before[direction];
            (0.5 * impact.impulse[part] * of_forces).abs()
        };
        untold.push(of_part(0) + of_part(1));
        groups.push(own);
        for other in 0..own {
            let is_coupled = is_coupled(meeting, [place, places[other]]);
            let (from, to) = (groups[other], groups[own]);
            if is_coupled && from != to {
                let (least, most) = (from.min(to), from.max(to));
                (groups.iter_mut().filter(|group| **group == most))
                    .for_each(|group| *group = least);
            }
        }
    }
}

/// Whether two contacts of a meeting share inertia. Nothing acts along the normal of a guide, but what acts along others loads it.
fn is_coupled(meeting: &Meeting, [one, other]: [usize; 2]) -> bool {
    let products = (meeting.g.as_slice(), meeting.directions.len());
    acts_on(products, [one, other]) || meeting.guides.are_there() && acts_on(products, [other, one])
}
