//! The search for the states of contacts that are possible together.

use super::super::per_contact::PerContact;
use super::{Each, Layout, Mode, Motion, Paradox, Parts, length};

/// The state that a contact enters when its normal reaction is zero: its index, its motion, and the side to which it presses.
pub(in crate::friction) type Turned = (usize, Motion, f64);

/// The states that are unknown when the state of a contact ends.
#[derive(Clone)]
pub(in crate::friction) struct OpenStates {
    /// The motion of each contact, if known.
    pub motion: PerContact<Option<Motion>>,
    /// The direction of each contact that is known to slide; 0 if the direction is unknown too.
    pub slip_direction: Each,
    /// A state that has just proved impossible: a contact, its motion, and possibly the side to which it presses.
    pub excluded: Option<(usize, Motion, Option<f64>)>,
    /// The contact that presses to the other side from here on, unless it stops.
    pub turned: Option<Turned>,
}

impl OpenStates {
    /// If only the slips are known: contacts with a slip slide, the states of the others are unknown.
    pub fn from_slips(slips: &Each, layout: Layout) -> OpenStates {
        let sliding = |slip: f64| (slip != 0.0).then_some(Motion::Slides(slip.signum()));
        let count = layout.contacts();
        let mut open_states = OpenStates {
            motion: PerContact::from_fn(count, |k| sliding(slips[k])),
            slip_direction: Each::new(count, 0.0),
            excluded: None,
            turned: None,
        };
        for k in (0..count).filter(|k| layout.has_second(*k)) {
            let speed = length([slips[k], slips[k + 1]]);
            for k in [k, k + 1] {
                open_states.motion[k] = (speed != 0.0).then_some(Motion::SlidesAlong);
                open_states.slip_direction[k] = if speed != 0.0 { slips[k] / speed } else { 0.0 };
            }
        }
        open_states
    }

    /// The only motion that is possible, with the states and the friction forces that go with it.
    ///
    /// If static friction exceeds sliding friction, both may be possible; then the contact sticks.
    ///
    /// # Errors
    /// If there is none or several, or if it cannot be decided whether there are several.
    #[cfg(feature = "std")]
    pub fn answer(&self, parts: &Parts<'_>) -> Result<(Mode, Each), Paradox> {
        let count = parts.layout.contacts();
        let blocks = parts.blocks();
        if blocks.len() <= 1 {
            return self.of_block(parts);
        }
        let (mut mode, mut forces) = (Mode::sticking(count), Each::new(count, 0.0));
        for block in &blocks {
            let (values, layout) = parts.of_block(block);
            let own = Parts {
                layout,
                values: &values,
            };
            let found = self.restricted(block).of_block(&own);
            let (own_mode, own_forces) = found.map_err(|paradox| Paradox {
                contact: block[paradox.contact],
                ..paradox
            })?;
            for (i, &k) in block.iter().enumerate() {
                mode.motion[k] = own_mode.motion[i];
                mode.press[k] = own_mode.press[i];
                mode.slip_direction[k] = own_mode.slip_direction[i];
                forces[k] = own_forces[i];
            }
        }
        Ok((mode, forces))
    }

    /// Finds the states and the forces without an allocator, for few contacts.
    #[cfg(not(feature = "std"))]
    pub fn answer(&self, parts: &Parts<'_>) -> Result<(Mode, Each), Paradox> {
        self.by_enumeration(parts)
    }

    /// This problem restricted to some of the contacts.
    #[cfg(feature = "std")]
    fn restricted(&self, block: &[usize]) -> OpenStates {
        let place = |k: usize| block.iter().position(|member| *member == k);
        OpenStates {
            motion: PerContact::from_fn(block.len(), |i| self.motion[block[i]]),
            slip_direction: Each::from_fn(block.len(), |i| self.slip_direction[block[i]]),
            excluded: (self.excluded)
                .and_then(|(k, motion, press)| place(k).map(|k| (k, motion, press))),
            turned: (self.turned)
                .and_then(|(k, motion, press)| place(k).map(|k| (k, motion, press))),
        }
    }

    /// The answer for contacts that depend on each other. One contact has few states, and each of them is examined. The states of several are
    /// found by pivoting. If nothing shows that there is only one motion, their combinations are examined, unless these are too many: then
    /// it is undecided.
    #[cfg(feature = "std")]
    fn of_block(&self, parts: &Parts<'_>) -> Result<(Mode, Each), Paradox> {
        let combinations = self.combinations(parts.layout);
        if combinations <= OF_ONE_CONTACT {
            return self.by_enumeration(parts);
        }
        let found = self.by_pivoting(parts);
        let is_only = |(mode, _): &(Mode, Each)| self.has_one_motion(parts, mode);
        if let Some(found) = found.filter(is_only) {
            return Ok(found);
        }
        if combinations <= MOST_COMBINATIONS {
            return self.by_enumeration(parts);
        }
        let mut open = (0..parts.layout.contacts()).filter(|k| self.motion[*k].is_none());
        Err(Paradox {
            contact: open.next().unwrap_or(0),
            several: true,
        })
    }

    /// The number of combinations of states that the question leaves open, without those that it excludes.
    #[cfg(feature = "std")]
    fn combinations(&self, layout: Layout) -> usize {
        let of_contact = |k: usize| {
            let all = states(layout, k).iter();
            all.filter(|(motion, _)| self.motion[k].is_none_or(|known| known == *motion))
                .count()
        };
        let asked = (0..layout.contacts()).filter(|k| !layout.is_second(*k));
        asked.fold(1, |all, k| all.saturating_mul(of_contact(k)))
    }

    /// Examines all combinations of states.
    pub(super) fn by_enumeration(&self, parts: &Parts<'_>) -> Result<(Mode, Each), Paradox> {
        let count = parts.layout.contacts();
        let holds_more = (0..count)
            .any(|k| self.motion[k].is_none() && parts.static_friction(k) > parts.friction(k));
        let mut found = Possible {
            question: self,
            parts,
            holds_more,
            best: None,
            several: None,
        };
        let mut unknown = None;
        self.each(parts.layout, &mut |mode| {
            let is_open = |k: &usize| has_open_direction(&mode, parts.layout, *k);
            let mut open = PerContact::new((0..count).filter(is_open).count(), 0);
            for (place, k) in open.iter_mut().zip((0..count).filter(is_open)) {
                *place = k;
            }
            let sliding = (0..count).find(|k| mode.motion[*k] != Motion::Sticks);
            let look = &mut |mode, friction_forces| found.look(mode, friction_forces);
            let known = parts.each_slip_direction(mode, &open, look);
            if !known {
                unknown = sliding;
            }
        });
        let Possible { best, several, .. } = found;
        // With normal reactions that friction does not change, the accelerations minimize a strictly convex function, so there are no others.
        // With more friction at rest this holds for what sticks.
        let is_proved = |(mode, _): &(Mode, Each)| {
            let mut asked = (0..count).filter(|k| self.motion[*k].is_none());
            parts.presses_regardless_of_friction()
                && (!holds_more || asked.all(|k| mode.motion[k] == Motion::Sticks))
        };
        let unknown = unknown.filter(|_| !best.as_ref().is_some_and(is_proved));
        match (best, several.or(unknown)) {
            (Some(best), None) => Ok(best),
            (Some(_), Some(contact)) => Err(Paradox {
                contact,
                several: true,
            }),
            (None, _) => Err(Paradox {
                contact: self.excluded.map_or(0, |(contact, ..)| contact),
                several: false,
            }),
        }
    }

    /// Calls `look` with every combination of states that the question leaves open.
    fn each(&self, layout: Layout, look: &mut dyn FnMut(Mode)) {
        let count = layout.contacts();
        let mut digits = PerContact::new(count, 0);
        loop {
            let mut mode = Mode::sticking(count);
            let mut is_open = true;
            for (k, &digit) in digits.iter().enumerate() {
                (mode.motion[k], mode.press[k]) = if layout.is_second(k) {
                    (mode.motion[k - 1], 1.0)
                } else {
                    states(layout, k)[digit]
                };
                if mode.motion[k] == Motion::SlidesAlong {
                    mode.slip_direction[k] = self.slip_direction[k];
                }
                is_open &= self.motion[k].is_none_or(|known| known == mode.motion[k]);
                is_open &= !self.excludes(&mode, k);
            }
            if is_open {
                look(mode);
            }
            let next = (0..count).find(|k| digits[*k] + 1 < states(layout, *k).len());
            let Some(next) = next else {
                return;
            };
            digits[next] += 1;
            digits[..next].fill(0);
        }
    }

    /// Whether the state of a contact has just proved impossible.
    pub(super) fn excludes(&self, mode: &Mode, contact: usize) -> bool {
        self.excluded.is_some_and(|(excluded, motion, press)| {
            let same_side = press.is_none_or(|press| press == mode.press[contact]);
            excluded == contact && motion == mode.motion[contact] && same_side
        })
    }
}

/// Whether a contact slides in a direction that is not known yet.
fn has_open_direction(mode: &Mode, layout: Layout, k: usize) -> bool {
    let slides = mode.motion[k] == Motion::SlidesAlong && layout.has_second(k);
    slides && mode.slip_direction[k] == 0.0 && mode.slip_direction[k + 1] == 0.0
}

/// The motions that are possible, of those that an enumeration examines.
struct Possible<'a> {
    question: &'a OpenStates,
    parts: &'a Parts<'a>,
    /// Whether a contact in question holds more at rest than while it slides.
    holds_more: bool,
    /// The motion that is found, or of several that with the most contacts that stick.
    best: Option<(Mode, Each)>,
    /// A contact that moves otherwise in another one.
    several: Option<usize>,
}

impl Possible<'_> {
    /// Examines one motion.
    fn look(&mut self, mode: Mode, friction_forces: Each) {
        let Self {
            question, parts, ..
        } = self;
        let count = parts.layout.contacts();
        // That a contact slides may be known without its direction.
        let is_asked = |k: usize| {
            let slides =
                question.motion[k] == Some(Motion::SlidesAlong) && parts.layout.has_second(k);
            slides && question.slip_direction[k] == 0.0 && question.slip_direction[k + 1] == 0.0
        };
        let accelerates_in_its_direction = |k: usize| {
            let is_known = question.motion[k].is_some() && !is_asked(k);
            is_known || parts.accelerates_in_its_direction(&mode, &friction_forces, k)
        };
        if !parts.admits(&mode, &friction_forces, question.turned)
            || !(0..count).all(accelerates_in_its_direction)
        {
            return;
        }
        let Some((known, other)) = &self.best else {
            self.best = Some((mode, friction_forces));
            return;
        };
        let sticking = |mode: &Mode| {
            let all = mode.motion.iter();
            all.filter(|motion| **motion == Motion::Sticks).count()
        };
        let more = sticking(&mode).cmp(&sticking(known));
        if parts.same(&friction_forces, other) {
            if more.is_gt() {
                self.best = Some((mode, friction_forces));
            }
        } else if self.holds_more && more.is_ne() {
            if more.is_gt() {
                self.best = Some((mode, friction_forces));
                self.several = None;
            }
        } else {
            let differs = |k: &usize| {
                known.motion[*k] != mode.motion[*k] || known.press[*k] != mode.press[*k]
            };
            self.several = (self.several).or((0..count).find(differs)).or(Some(0));
        }
    }
}

/// The states of a contact: its motion, and the side to which it presses.
fn states(layout: Layout, contact: usize) -> &'static [(Motion, f64)] {
    const IN_PLANE: [(Motion, f64); 5] = [
        (Motion::Sticks, 1.0),
        (Motion::Slides(1.0), 1.0),
        (Motion::Slides(1.0), -1.0),
        (Motion::Slides(-1.0), 1.0),
        (Motion::Slides(-1.0), -1.0),
    ];
    // In space a guide has no sides.
    const IN_SPACE: [(Motion, f64); 3] = [IN_PLANE[0], IN_PLANE[1], IN_PLANE[3]];
    const ON_SURFACE: [(Motion, f64); 2] = [IN_PLANE[0], (Motion::SlidesAlong, 1.0)];
    match layout.axes() {
        1 => &IN_PLANE,
        _ if layout.has_second(contact) => &ON_SURFACE,
        // The second tangent follows the first.
        _ if layout.is_second(contact) => &ON_SURFACE[..1],
        _ => &IN_SPACE,
    }
}

/// The states of one contact in the plane.
#[cfg(feature = "std")]
const OF_ONE_CONTACT: usize = 5;

/// The largest number of combinations of states that are examined: those of six contacts in the plane.
#[cfg(feature = "std")]
const MOST_COMBINATIONS: usize = 15_625;
