//! The search for the states of contacts that are possible together.

use super::super::MOST_CONTACTS;
use super::{Each, Layout, Mode, Motion, Paradox, Parts, length};

/// The state that a contact enters when its normal reaction is zero: its index, its motion, and the side to which it presses.
pub(in crate::friction) type Turned = (usize, Motion, f64);

/// The states that are unknown when the state of a contact ends.
#[derive(Clone, Copy)]
pub(in crate::friction) struct OpenStates {
    /// The motion of each contact, if known.
    pub motion: [Option<Motion>; MOST_CONTACTS],
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
        let mut open_states = OpenStates {
            motion: slips.map(sliding),
            slip_direction: [0.0; MOST_CONTACTS],
            excluded: None,
            turned: None,
        };
        for k in (0..layout.contacts()).filter(|k| layout.has_second(*k)) {
            let speed = length([slips[k], slips[k + 1]]);
            for k in [k, k + 1] {
                open_states.motion[k] = (speed != 0.0).then_some(Motion::SlidesAlong);
                open_states.slip_direction[k] = if speed != 0.0 { slips[k] / speed } else { 0.0 };
            }
        }
        open_states
    }

    /// The unique solution.
    ///
    /// If static friction exceeds sliding friction, both may be possible; then the contact sticks.
    pub fn answer(&self, parts: &Parts<'_>) -> Result<(Mode, Each), Paradox> {
        let count = parts.layout.contacts();
        let holds_more = (0..count)
            .any(|k| self.motion[k].is_none() && parts.static_friction(k) > parts.friction(k));
        let sticking = |mode: &Mode| {
            let all = mode.motion[..count].iter();
            all.filter(|motion| **motion == Motion::Sticks).count()
        };
        let mut best: Option<(Mode, Each)> = None;
        let mut several = None;
        let mut unknown = None;
        let mut look = |mode: Mode, friction_forces: Each| {
            // That a contact slides may be known without its direction.
            let is_asked = |k: usize| {
                let slides =
                    self.motion[k] == Some(Motion::SlidesAlong) && parts.layout.has_second(k);
                slides && self.slip_direction[k] == 0.0 && self.slip_direction[k + 1] == 0.0
            };
            let accelerates_in_its_direction = |k: usize| {
                let is_known = self.motion[k].is_some() && !is_asked(k);
                is_known || parts.accelerates_in_its_direction(&mode, &friction_forces, k)
            };
            if !parts.admits(&mode, &friction_forces, self.turned)
                || !(0..count).all(accelerates_in_its_direction)
            {
                return;
            }
            let Some((known, other)) = &best else {
                best = Some((mode, friction_forces));
                return;
            };
            let more = sticking(&mode).cmp(&sticking(known));
            if parts.same(&friction_forces, other) {
                if more.is_gt() {
                    best = Some((mode, friction_forces));
                }
            } else if holds_more && more.is_ne() {
                if more.is_gt() {
                    best = Some((mode, friction_forces));
                    several = None;
                }
            } else {
                let differs = |k: &usize| {
                    known.motion[*k] != mode.motion[*k] || known.press[*k] != mode.press[*k]
                };
                several = several.or((0..count).find(differs)).or(Some(0));
            }
        };
        self.each(parts.layout, &mut |mode| {
            let (mut open, mut number) = ([0; MOST_CONTACTS], 0);
            for k in 0..count {
                let slides = mode.motion[k] == Motion::SlidesAlong && parts.layout.has_second(k);
                if slides && mode.slip_direction[k] == 0.0 && mode.slip_direction[k + 1] == 0.0 {
                    open[number] = k;
                    number += 1;
                }
            }
            let known = parts.each_slip_direction(mode, &open[..number], &mut look);
            if !known {
                unknown = (0..count).find(|k| mode.motion[*k] != Motion::Sticks);
            }
        });
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
        let count = layout.contacts();
        let states = |k: usize| match layout.axes() {
            1 => &IN_PLANE[..],
            _ if layout.has_second(k) => &ON_SURFACE[..],
            // The second tangent follows the first.
            _ if layout.is_second(k) => &ON_SURFACE[..1],
            _ => &IN_SPACE[..],
        };
        let mut digits = [0; MOST_CONTACTS];
        loop {
            let mut mode = Mode {
                motion: [Motion::Sticks; MOST_CONTACTS],
                press: [1.0; MOST_CONTACTS],
                slip_direction: [0.0; MOST_CONTACTS],
            };
            let mut is_open = true;
            for (k, &digit) in digits[..count].iter().enumerate() {
                (mode.motion[k], mode.press[k]) = if layout.is_second(k) {
                    (mode.motion[k - 1], 1.0)
                } else {
                    states(k)[digit]
                };
                if mode.motion[k] == Motion::SlidesAlong {
                    mode.slip_direction[k] = self.slip_direction[k];
                }
                is_open &= self.motion[k].is_none_or(|known| known == mode.motion[k]);
                if let Some((contact, motion, press)) = self.excluded
                    && contact == k
                {
                    let same_side = press.is_none_or(|press| press == mode.press[k]);
                    is_open &= !(motion == mode.motion[k] && same_side);
                }
            }
            if is_open {
                look(mode);
            }
            let next = (0..count).find(|k| digits[*k] + 1 < states(*k).len());
            let Some(next) = next else {
                return;
            };
            digits[next] += 1;
            digits[..next].fill(0);
        }
    }
}
