//! Coulomb's law for contacts in given states, and which states they may be in.

use super::MOST_CONTACTS;
use crate::{Pivot, Singular};

/// A number for each contact.
pub(super) type Each = [f64; MOST_CONTACTS];

/// What rounding may take from a condition, relative to its terms.
pub(super) const ROUNDING: f64 = 1e-12;

/// Solutions whose accelerations differ by less than this, relative to their greatest, are the same.
const SAME: f64 = 1e-9;

/// A pivot is zero below this, relative to the entries of its row.
const SINGULAR: f64 = 1e-12;

/// What a contact does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Motion {
    /// It stays where it is on its guide.
    Sticks,
    /// It slides forward (1) or backward (−1).
    Slides(f64),
}

/// The states of the contacts: what they do, and to which side they press (1 or −1).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Mode {
    pub motion: [Motion; MOST_CONTACTS],
    pub press: Each,
}

/// How many solutions there are, where it is not one, and of which contact first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Paradox {
    pub contact: usize,
    pub several: bool,
}

impl Paradox {
    pub fn singular(self) -> Singular {
        Singular {
            at: Pivot::Contact(self.contact),
            ratio: if self.several { f64::INFINITY } else { 0.0 },
        }
    }
}

/// How the results of [`System::friction`](crate::System::friction) are arranged: `1 + k` parts of `n` accelerations, `m`
/// multipliers, `k` slip rates and `k` normal reactions, then `k` coefficients of what slides and `k`
/// of what sticks.
#[derive(Clone, Copy)]
pub(super) struct Layout {
    pub n: usize,
    pub m: usize,
    pub k: usize,
}

impl Layout {
    pub const fn part(self) -> usize {
        self.n + self.m + 2 * self.k
    }

    pub const fn len(self) -> usize {
        (1 + self.k) * self.part() + 2 * self.k
    }
}

/// What follows from the friction forces.
pub(super) struct Parts<'p> {
    pub layout: Layout,
    pub values: &'p [f64],
}

impl Parts<'_> {
    /// Entry `i` of a part: of what there is without friction (0), or by the friction of a contact.
    pub fn at(&self, part: usize, i: usize) -> f64 {
        self.values[part * self.layout.part() + i]
    }

    /// Entry `i` with all friction forces, and the size of its terms.
    pub fn sum(&self, i: usize, friction_forces: &Each) -> [f64; 2] {
        let alone = self.at(0, i);
        let mut sum = [alone, alone.abs()];
        for (k, friction) in friction_forces[..self.layout.k].iter().enumerate() {
            let term = self.at(1 + k, i) * friction;
            sum = [sum[0] + term, sum[1] + term.abs()];
        }
        sum
    }

    /// Where the slip rate of a contact stands in a part.
    pub fn slip_rate(&self, contact: usize) -> usize {
        self.layout.n + self.layout.m + contact
    }

    /// Where its normal reaction stands.
    pub fn normal(&self, contact: usize) -> usize {
        self.slip_rate(contact) + self.layout.k
    }

    pub fn friction(&self, contact: usize) -> f64 {
        self.values[(1 + self.layout.k) * self.layout.part() + contact]
    }

    pub fn static_friction(&self, contact: usize) -> f64 {
        self.values[(1 + self.layout.k) * self.layout.part() + self.layout.k + contact]
    }

    /// The friction forces of contacts in given states; none where there is no such motion.
    pub fn friction_forces(&self, mode: &Mode) -> Option<Each> {
        let count = self.layout.k;
        let mut rows = [[0.0; MOST_CONTACTS + 1]; MOST_CONTACTS];
        for (k, row) in rows[..count].iter_mut().enumerate() {
            let (entry, factor, own) = match mode.motion[k] {
                Motion::Sticks => (self.slip_rate(k), 1.0, 0.0),
                Motion::Slides(sign) => {
                    (self.normal(k), sign * mode.press[k] * self.friction(k), 1.0)
                }
            };
            for (j, x) in row[..count].iter_mut().enumerate() {
                *x = factor * self.at(1 + j, entry);
            }
            row[k] += own;
            row[count] = -factor * self.at(0, entry);
        }
        solve(&mut rows, count)
    }

    /// Whether contacts in given states can have these friction forces: what sticks no more than it can
    /// hold, what slides on the side to which it is said to press. The state to which a contact turns
    /// where its reaction is zero is not asked for the side: rounding would decide.
    fn admits(&self, mode: &Mode, friction_forces: &Each, turned: Option<Turned>) -> bool {
        (0..self.layout.k).all(|k| {
            if turned == Some((k, mode.motion[k], mode.press[k])) {
                return true;
            }
            let [normal, terms] = self.sum(self.normal(k), friction_forces);
            match mode.motion[k] {
                Motion::Sticks => {
                    let most = self.static_friction(k) * normal.abs();
                    friction_forces[k].abs()
                        <= most + ROUNDING * (most + self.static_friction(k) * terms)
                }
                Motion::Slides(_) => mode.press[k] * normal >= -ROUNDING * terms,
            }
        })
    }

    /// Whether what slides off from rest does so in its direction.
    fn departs(&self, mode: &Mode, friction_forces: &Each, contact: usize) -> bool {
        let [rate, terms] = self.sum(self.slip_rate(contact), friction_forces);
        match mode.motion[contact] {
            Motion::Sticks => true,
            Motion::Slides(sign) => sign * rate >= -ROUNDING * terms,
        }
    }

    /// Whether two solutions give the machine the same accelerations.
    fn same(&self, one: &Each, other: &Each) -> bool {
        let (mut most, mut apart) = (0.0_f64, 0.0_f64);
        for i in 0..self.layout.n {
            let ([x, of_x], [y, of_y]) = (self.sum(i, one), self.sum(i, other));
            most = most.max(of_x.max(of_y));
            apart = apart.max((x - y).abs());
        }
        apart <= SAME * most
    }
}

/// A contact whose normal reaction is zero just here: in which state it is from here on, what it does
/// and to which side it presses.
pub(super) type Turned = (usize, Motion, f64);

/// What is open about the contacts where one of their states ends.
#[derive(Clone, Copy)]
pub(super) struct Question {
    /// What each contact does, if that is known.
    pub motion: [Option<Motion>; MOST_CONTACTS],
    /// What has just proved impossible: what a contact does, or the side to which it presses.
    pub excluded: Option<(usize, Motion, Option<f64>)>,
    /// What presses to the other side from here on, unless it stops.
    pub turned: Option<Turned>,
}

impl Question {
    /// Where nothing but the slips is known: what moves slides, the rest is open.
    pub fn from_slips(slips: &Each) -> Question {
        let sliding = |slip: f64| (slip != 0.0).then_some(Motion::Slides(slip.signum()));
        Question {
            motion: slips.map(sliding),
            excluded: None,
            turned: None,
        }
    }

    /// The one solution.
    ///
    /// Where what sticks holds more than what slides, both may be possible: then it sticks.
    pub fn answer(&self, parts: &Parts<'_>) -> Result<(Mode, Each), Paradox> {
        let count = parts.layout.k;
        let holds_more = (0..count)
            .any(|k| self.motion[k].is_none() && parts.static_friction(k) > parts.friction(k));
        let sticking = |mode: &Mode| {
            let all = mode.motion[..count].iter();
            all.filter(|motion| **motion == Motion::Sticks).count()
        };
        let mut best: Option<(Mode, Each)> = None;
        let mut several = None;
        self.each(count, &mut |mode| {
            let Some(friction_forces) = parts.friction_forces(&mode) else {
                return;
            };
            let departs =
                |k: usize| self.motion[k].is_some() || parts.departs(&mode, &friction_forces, k);
            if !parts.admits(&mode, &friction_forces, self.turned) || !(0..count).all(departs) {
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
                several = several.or((0..count).find(differs));
            }
        });
        match (best, several) {
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

    /// Every combination of states that the question leaves open.
    fn each(&self, count: usize, look: &mut dyn FnMut(Mode)) {
        const STATES: [(Motion, f64); 5] = [
            (Motion::Sticks, 1.0),
            (Motion::Slides(1.0), 1.0),
            (Motion::Slides(1.0), -1.0),
            (Motion::Slides(-1.0), 1.0),
            (Motion::Slides(-1.0), -1.0),
        ];
        let mut digits = [0; MOST_CONTACTS];
        loop {
            let mut mode = Mode {
                motion: [Motion::Sticks; MOST_CONTACTS],
                press: [1.0; MOST_CONTACTS],
            };
            let mut is_open = true;
            for (k, &digit) in digits[..count].iter().enumerate() {
                (mode.motion[k], mode.press[k]) = STATES[digit];
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
            let Some(next) = digits[..count].iter().position(|d| d + 1 < STATES.len()) else {
                return;
            };
            digits[next] += 1;
            digits[..next].fill(0);
        }
    }
}

/// Solves `count` equations with their right-hand sides behind them, by Gauss's elimination with a
/// full search for pivots. What is not determined is 0; none where they contradict each other.
pub(super) fn solve(
    rows: &mut [[f64; MOST_CONTACTS + 1]; MOST_CONTACTS],
    count: usize,
) -> Option<Each> {
    let rows = &mut rows[..count];
    for row in rows.iter_mut() {
        let most = row[..count]
            .iter()
            .fold(0.0_f64, |most, x| most.max(x.abs()));
        if most > 0.0 {
            row[..=count].iter_mut().for_each(|x| *x /= most);
        }
    }
    let largest = rows
        .iter()
        .fold(0.0_f64, |most, row| most.max(row[count].abs()));
    let mut column_of = [None; MOST_CONTACTS];
    for done in 0..count {
        let mut pivot = (0.0, 0, 0);
        for (i, row) in rows.iter().enumerate().skip(done) {
            for (j, x) in row[..count].iter().enumerate() {
                if x.abs() > pivot.0 {
                    pivot = (x.abs(), i, j);
                }
            }
        }
        let (size, i, j) = pivot;
        if size <= SINGULAR || size.is_nan() {
            let open = rows[done..].iter().map(|row| row[count].abs());
            if open.fold(0.0_f64, f64::max) > SAME * largest {
                return None;
            }
            break;
        }
        rows.swap(done, i);
        column_of[done] = Some(j);
        let own = rows[done];
        for (other, row) in rows.iter_mut().enumerate() {
            if other == done {
                continue;
            }
            let factor = row[j] / own[j];
            for (x, y) in row[..=count].iter_mut().zip(own) {
                *x -= factor * y;
            }
            row[j] = 0.0;
        }
    }
    let mut solution = [0.0; MOST_CONTACTS];
    for (row, column) in rows.iter().zip(column_of) {
        if let Some(j) = column {
            solution[j] = row[count] / row[j];
        }
    }
    let is_finite = solution.iter().all(|x| x.is_finite());
    is_finite.then_some(solution)
}
