//! Friction in space: its size depends on the length of a vector, and on a surface its direction is sought.

use super::super::per_contact::{FEW_CONTACTS, PerContact, Values};
use super::elimination::Equations;
use super::sharing::Undetermined;
use super::{Each, Mode, Motion, Parts, SAME, dot};
use crate::scalar::Scalar;

impl Parts<'_> {
    /// In space a friction force `f = μ |N|` depends on the length of a vector. The forces of sticking contacts depend linearly on
    /// those of sliding ones, so `N = A + B f`, and there remains one equation `f = μ |A + B f|` for each sliding contact, on a
    /// surface for both tangents together.
    ///
    /// Calls `look` with the forces, of which undetermined ones are 0.
    pub(super) fn by_sizes(&self, mode: &Mode, look: &mut dyn FnMut(Each, &Undetermined)) -> bool {
        let count = self.layout.contacts();
        let slides = |k: &usize| mode.motion[*k] != Motion::Sticks && !self.layout.is_second(*k);
        let mut sliding = PerContact::new((0..count).filter(slides).count(), 0);
        for (place, k) in sliding.iter_mut().zip((0..count).filter(slides)) {
            *place = k;
        }
        let number = sliding.len();
        // The forces without friction in the sliding contacts, and per unit of the friction of each of them.
        let mut forces: Columns<f64> = Columns::new((number + 1) * count, 0.0);
        let mut undetermined = Undetermined::none(count);
        for (part, forces) in forces.chunks_exact_mut(count.max(1)).enumerate() {
            let mut equations = Equations::new(count);
            for (k, row) in equations.rows_mut().enumerate() {
                if mode.motion[k] == Motion::Sticks {
                    let entry = self.slip_rate(k);
                    for (j, x) in row[..count].iter_mut().enumerate() {
                        *x = self.at(1 + j, entry);
                    }
                    row[count] = if part == 0 { -self.at(0, entry) } else { 0.0 };
                } else {
                    row[k] = 1.0;
                    let first = k - usize::from(self.layout.is_second(k));
                    let own = part > 0 && sliding[part - 1] == first;
                    row[count] = if own { -mode.share(k) } else { 0.0 };
                }
            }
            let Some((solved, column_of)) = equations.eliminate() else {
                return true;
            };
            if part == 0 {
                undetermined = Undetermined::of(&equations, &column_of);
            }
            forces.copy_from_slice(&solved);
        }
        // `N` of each sliding contact, in the same parts.
        let mut pressing: Columns<[f64; 3]> = Columns::new(number * (number + 1), [0.0; 3]);
        for (&k, pressing) in (sliding.iter()).zip(pressing.chunks_exact_mut(number + 1)) {
            for (part, vector) in pressing.iter_mut().enumerate() {
                for (x, i) in vector.iter_mut().zip(self.components(k)) {
                    let start = if part == 0 { self.at(0, i) } else { 0.0 };
                    let by = forces[part * count..][..count].iter().enumerate();
                    *x = by.fold(start, |sum, (j, force)| sum + self.at(1 + j, i) * force);
                }
                *vector = self.across(k, *vector);
            }
        }
        let sizes = Sizes {
            coefficients: Each::from_fn(number, |i| self.friction(sliding[i])),
            pressing,
        };
        sizes.each(&mut |sizes: &Each| {
            let mut all = Each::new(count, 0.0);
            all.copy_from_slice(&forces[..count]);
            for (of_unit, size) in forces[count..].chunks_exact(count.max(1)).zip(&**sizes) {
                for (force, by) in all.iter_mut().zip(of_unit) {
                    *force += size * by;
                }
            }
            look(all, &undetermined);
        })
    }

    /// Calls `look` with all friction forces in given states, where the contacts on surfaces in `open` start to slide in
    /// directions that are to be found. Returns false if there may be others.
    pub(super) fn each_slip_direction(
        &self,
        mode: Mode,
        open: &[usize],
        look: &mut dyn FnMut(Mode, Each),
    ) -> bool {
        match *open {
            [] => self.each_solution(&mode, &mut |forces| look(mode.clone(), forces)),
            [contact] => {
                let mut known = true;
                self.find_slip_directions(mode, contact, &mut |mode| {
                    let each = &mut |forces| look(mode.clone(), forces);
                    known &= self.each_solution(&mode, each);
                });
                known
            }
            _ => match self.find_slip_directions_together(mode, open) {
                Some(mode) => self.each_solution(&mode, &mut |forces| look(mode.clone(), forces)),
                None => false,
            },
        }
    }

    /// Finds the directions in which a contact on a surface may start to slide while all others are in given states: those in
    /// which its slip grows along itself. The search samples the circle and then bisects to round-off.
    pub(super) fn find_slip_directions(
        &self,
        mut mode: Mode,
        contact: usize,
        look: &mut dyn FnMut(Mode),
    ) {
        let mut along = |angle: f64| {
            let (sin, cos) = Scalar::sin_cos(angle);
            (
                mode.slip_direction[contact],
                mode.slip_direction[contact + 1],
            ) = (cos, sin);
            mode.clone()
        };
        // The growth of the slip to the left of the direction, and along it.
        let grows = |mode: &Mode| {
            let forces = self.friction_forces(mode).ok()?;
            let [x, y] = [contact, contact + 1].map(|k| self.sum(self.slip_rate(k), &forces)[0]);
            let [a, b] = [
                mode.slip_direction[contact],
                mode.slip_direction[contact + 1],
            ];
            Some([a * y - b * x, a * x + b * y])
        };
        let whole = 2.0 * core::f64::consts::PI;
        let at = |number: usize| whole * number as f64 / DIRECTIONS as f64;
        let mut before = grows(&along(at(0)));
        for number in 1..=DIRECTIONS {
            let (mut from, mut to) = (at(number - 1), at(number));
            let after = grows(&along(to));
            let (Some([mut aside, _]), Some([next, _])) = (before, after) else {
                before = after;
                continue;
            };
            before = after;
            if aside != 0.0 {
                if (aside > 0.0) == (next > 0.0) {
                    continue;
                }
                for _ in 0..BISECTIONS {
                    let middle = 0.5 * (from + to);
                    let Some([value, _]) = grows(&along(middle)) else {
                        break;
                    };
                    if (value > 0.0) == (aside > 0.0) {
                        (from, aside) = (middle, value)
                    } else {
                        to = middle
                    }
                }
                from = 0.5 * (from + to);
            }
            look(along(from));
        }
    }

    /// The directions of several contacts on surfaces that start to slide at once, by iteration over the contacts until none
    /// turns. `None` if one of them could go in several directions, or the iteration does not converge.
    pub(super) fn find_slip_directions_together(
        &self,
        mut mode: Mode,
        open: &[usize],
    ) -> Option<Mode> {
        for _ in 0..MOST_STEPS {
            let mut turned = 0.0_f64;
            for &contact in open {
                let (mut found, mut several) = (None, false);
                self.find_slip_directions(mode.clone(), contact, &mut |next| {
                    let forces = self.friction_forces(&next).ok();
                    if forces.is_some_and(|forces| {
                        self.accelerates_in_its_direction(&next, &forces, contact)
                    }) {
                        several |= found.as_ref().is_some_and(|known: &Mode| {
                            let [a, b] = [
                                known.slip_direction[contact],
                                known.slip_direction[contact + 1],
                            ];
                            let [c, d] = [
                                next.slip_direction[contact],
                                next.slip_direction[contact + 1],
                            ];
                            (a * d - b * c).abs() > SAME || a * c + b * d < 0.0
                        });
                        found = Some(next);
                    }
                });
                let next = found.filter(|_| !several)?;
                for k in [contact, contact + 1] {
                    turned = turned.max((next.slip_direction[k] - mode.slip_direction[k]).abs());
                }
                mode = next;
            }
            if turned <= SETTLED {
                return Some(mode);
            }
        }
        None
    }
}

/// The largest number of iterations for the friction forces of several contacts that slide in space. Newton's method takes a few;
/// a contraction by a factor of 0.9 takes this many for sixteen digits.
const MOST_STEPS: usize = 400;

/// Number of directions at which the search begins for the direction in which a contact on a surface starts to slide.
const DIRECTIONS: usize = 48;

/// Number of bisections from the angle between two of these directions to its round-off.
const BISECTIONS: usize = 54;

/// The directions of several contacts have converged if none changes by more than this in an iteration.
const SETTLED: f64 = 1e-15;

/// The unknown friction forces of sliding contacts in space: `f = μ |A + B f|`.
struct Sizes {
    coefficients: Each,
    /// `A` of each contact, followed by its columns of `B`.
    pressing: Columns<[f64; 3]>,
}

/// For each contact a value, and one for each contact that slides.
type Columns<T> = Values<T, { FEW_CONTACTS * (FEW_CONTACTS + 1) }>;

impl Sizes {
    /// How many contacts slide.
    fn number(&self) -> usize {
        self.coefficients.len()
    }

    /// `A` of a contact (part 0), or what the friction of another adds to its `N` (1 + the index of that).
    fn pressing(&self, contact: usize, part: usize) -> &[f64; 3] {
        &self.pressing[contact * (self.number() + 1) + part]
    }

    /// Calls `look` with all solutions; returns false if there may be others.
    fn each(&self, look: &mut dyn FnMut(&Each)) -> bool {
        match self.number() {
            0 => {
                look(&Each::new(0, 0.0));
                true
            }
            1 => {
                self.of_one(look);
                true
            }
            _ => {
                if self.is_contraction() {
                    self.by_newton().iter().for_each(look);
                    true
                } else {
                    false
                }
            }
        }
    }

    /// Finds the nonnegative roots of `(1 − μ²B²) f² − 2μ² A·B f − μ²A² = 0`.
    fn of_one(&self, look: &mut dyn FnMut(&Each)) {
        let [a, b] = [*self.pressing(0, 0), *self.pressing(0, 1)];
        let square = self.coefficients[0] * self.coefficients[0];
        let (first, half, last) = (
            1.0 - square * dot(&b, &b),
            square * dot(&a, &b),
            square * dot(&a, &a),
        );
        let discriminant = half * half + first * last;
        let mut found = |size: f64| {
            look(&Each::new(1, size));
        };
        let root = crate::math::sqrt(discriminant.max(0.0));
        if last == 0.0 {
            found(0.0);
        } else if first > 0.0 {
            // The other root is negative. Avoids cancellation.
            found(if half >= 0.0 {
                (half + root) / first
            } else {
                last / (root - half)
            });
        } else if half < 0.0 && discriminant >= 0.0 {
            // Pressing harder would increase the reaction further: there are two motions or none (P. Painlevé).
            found(last / (root - half));
            if first < 0.0 && discriminant > 0.0 {
                found((half - root) / first);
            }
        }
    }

    /// Whether `f ↦ μ |A + B f|` is a contraction in some norm, so that it has a unique fixed point (S. Banach). Forces change by
    /// at most `L = μ |B|` times the change of others, and the spectral radius of a nonnegative matrix is below 1 if and only if
    /// `(1 − L) x = 1` has a nonnegative solution (A. Berman, R. J. Plemmons, *Nonnegative Matrices in the Mathematical Sciences*,
    /// 1979, chapter 6, condition N38).
    fn is_contraction(&self) -> bool {
        let number = self.number();
        let mut equations = Equations::new(number);
        for (i, row) in equations.rows_mut().enumerate() {
            for (j, x) in row[..number].iter_mut().enumerate() {
                let by = self.pressing(i, 1 + j);
                *x = -self.coefficients[i] * crate::math::sqrt(dot(by, by));
            }
            row[i] += 1.0;
            row[number] = 1.0;
        }
        let solved = equations.solve();
        solved.is_some_and(|x| x.iter().all(|x| *x > 0.0))
    }

    /// The fixed point of a contraction. Newton's step linearizes the length of a reaction as its product with its present
    /// direction. If a step does not reduce the residual, it is replaced by the step of the contraction, which does.
    fn by_newton(&self) -> Option<Each> {
        let number = self.number();
        let mut sizes = Each::new(number, 0.0);
        let mut off = f64::INFINITY;
        for _ in 0..MOST_STEPS {
            let mut equations = Equations::new(number);
            let mut contracted = Each::new(number, 0.0);
            let mut here = 0.0_f64;
            for (i, row) in equations.rows_mut().enumerate() {
                let mut vector = *self.pressing(i, 0);
                for (j, size) in sizes.iter().enumerate() {
                    for (x, by) in vector.iter_mut().zip(self.pressing(i, 1 + j)) {
                        *x += by * size;
                    }
                }
                let length = crate::math::sqrt(dot(&vector, &vector));
                contracted[i] = self.coefficients[i] * length;
                here = here.max((sizes[i] - contracted[i]).abs());
                let factor = if length > 0.0 {
                    self.coefficients[i] / length
                } else {
                    0.0
                };
                for (j, x) in row[..number].iter_mut().enumerate() {
                    *x = -factor * dot(&vector, self.pressing(i, 1 + j));
                }
                row[i] += 1.0;
                row[number] = factor * dot(&vector, self.pressing(i, 0));
            }
            let largest = contracted.iter().fold(0.0_f64, |most, x| most.max(*x));
            if here <= 4.0 * f64::EPSILON * largest {
                return Some(contracted);
            }
            sizes = match equations.solve() {
                Some(next) if here < off => next,
                _ => contracted,
            };
            off = here;
        }
        None
    }
}
