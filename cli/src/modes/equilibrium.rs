//! Where a machine stays: Newton's method on its forces, with their exact derivatives.
//!
//! Forces, not accelerations: a force that depends on no angle leaves the angle alone, while M⁻¹ turns along with it. Each
//! coordinate is measured in the length that its own inertia gives it, `√M_ii q_i`, so that no unit and no mass decides what
//! is small: singular values of the scaled stiffness are squares of frequencies. Directions in which forces do not change are
//! free, and nothing moves along them.
//!
//! On the way to one of many equilibria the stiffness along the others is not yet 0, but as small as the forces that are left
//! over; what comes to less than those says nothing. So steps are damped as Levenberg and Marquardt do, by the size of these
//! forces, which keeps the convergence quadratic where equilibria are not alone (N. Yamashita and M. Fukushima, *On the rate of
//! convergence of the Levenberg–Marquardt method*, Computing Suppl. 15 (2001) 239–249). A step is kept if the next one, taken
//! with the same matrix, is shorter: the natural monotonicity test (P. Deuflhard, *Newton Methods for Nonlinear Problems*,
//! 2004, section 3.3). A damped one need not be, by as much; it is kept too if it does what the linear prediction says, as
//! exactly as the test asks of a step without damping.

use lagrangian::interpreted::{InterpretedMachine, InterpretedSystem, Named};
use lagrangian::{Linearize, Singular, System};
use lagrangian_scalar::{Dual, Interval, Scalar};
use lagrangian_spec::program::{Arguments, Interpreter, Role};
use nalgebra::{DMatrix, DVector};

use super::precise;
use super::rank::{self, Direction};

/// The most steps; Newton's method takes five, and a few more for each radian on the way.
pub(super) const MOST_STEPS: usize = 200;

/// The most halvings of one step.
pub(super) const MOST_HALVINGS: usize = 30;

/// A step is as long as this at most, in rad, m, or as a share of the coordinate.
pub(super) const LONGEST_STEP: f64 = 1.0;

/// Steps end where the next one changes no coordinate by more than this, in rad, m, or as a share of the coordinate: the
/// error after it is about the square of that.
pub(super) const TOLERANCE: f64 = 1e-10;

/// A stiffness counts if it is more than this share of what forces, off zero by a step of one, would make of it.
const DAMPING: f64 = 0.1;

/// The share of what its own terms come to that a force may be off zero: a thousand roundings, and the square of
/// [`TOLERANCE`].
pub(super) const BALANCED: f64 = 1e-12;

/// A state in which nothing accelerates.
pub struct Equilibrium {
    /// The coordinates.
    pub q: Vec<f64>,
    /// How accelerations change with the coordinates near it.
    pub by_coordinates: DMatrix<f64>,
    /// How they change with the rates.
    pub by_rates: DMatrix<f64>,
    /// How many steps it took.
    pub steps: usize,
    /// Along how many directions the machine may stand elsewhere as well.
    pub free: usize,
}

/// Why there is none.
pub enum Lost {
    /// The mass matrix is singular on the way.
    Singular(Singular),
    /// An acceleration is not finite on the way, by the index of its coordinate.
    NotFinite(usize),
    /// Nothing that Newton's method can do removes this acceleration.
    Accelerates(usize, f64),
    /// No end was reached.
    NoEnd(usize),
    /// What the constraints have against it.
    Constraints(String),
}

/// The accelerations at a state, and their derivatives by the coordinates and by the rates.
pub fn linearize(
    system: &InterpretedSystem,
    t: f64,
    q: &Vec<f64>,
    v: &Vec<f64>,
    u: &Named,
) -> Result<[Vec<f64>; 3], Lost> {
    let n = q.len();
    let (mut a, mut by_q, mut by_v) = (vec![0.0; n], vec![0.0; n * n], vec![0.0; n * n]);
    system
        .linearize(t, q, v, u, &mut a, &mut by_q, &mut by_v)
        .map_err(Lost::Singular)?;
    let numbers = a.iter().enumerate();
    let entries = by_q.iter().chain(&by_v).enumerate();
    let mut rows = numbers.chain(entries.map(|(k, x)| (k % (n * n) / n, x)));
    match rows.find(|(_, x)| !x.is_finite()) {
        Some((index, _)) => Err(Lost::NotFinite(index)),
        None => Ok([a, by_q, by_v]),
    }
}

/// The generalized forces of a machine, and how they change.
pub struct Statics<'a> {
    machine: &'a InterpretedMachine,
    system: &'a InterpretedSystem,
    interpreter: Interpreter<Dual<f64>>,
    v: &'a Vec<f64>,
    u: &'a Named,
}

/// Forces, row after row their derivatives by the coordinates, and those by the rates.
pub(super) struct Derived<S>(pub(super) [Vec<S>; 3]);

/// The forces in a pose, over the lengths `1/√M_ii`.
struct Forces {
    lengths: DVector<f64>,
    forces: DVector<f64>,
    /// Their derivatives by the coordinates.
    stiffness: Vec<Direction>,
    /// What the terms of each force come to.
    sizes: DVector<f64>,
}

impl<S: Scalar<Stored = S>> Derived<S> {
    pub(super) fn new(interpreter: &mut Interpreter<Dual<S>>, [q, v, u]: [&[S]; 3]) -> Derived<S> {
        let n = q.len();
        let [mut q, mut v, u] = [q, v, u].map(constants);
        let mut forces = vec![Dual::constant(S::ZERO); n];
        let mut by = [vec![S::ZERO; n * n], vec![S::ZERO; n * n]];
        for (is_rate, j) in [false, true]
            .into_iter()
            .flat_map(|x| (0..n).map(move |j| (x, j)))
        {
            let variable = if is_rate { &mut v[j] } else { &mut q[j] };
            variable.derivative = S::ONE;
            let arguments = Arguments {
                t: Dual::constant(S::ZERO),
                q: &q,
                v: &v,
                u: &u,
                a: &[],
            };
            // Nothing in the forces can be singular; what there is no function for is 0.
            let _ = interpreter.call(Role::Forces, arguments, &mut forces);
            for (i, force) in forces.iter().enumerate() {
                by[usize::from(is_rate)][i * n + j] = force.derivative;
            }
            let variable = if is_rate { &mut v[j] } else { &mut q[j] };
            variable.derivative = S::ZERO;
        }
        let [by_q, by_v] = by;
        let forces = forces.into_iter().map(|force| force.value).collect();
        Derived([forces, by_q, by_v])
    }
}

impl<'a> Statics<'a> {
    /// The forces of `machine`, prepared as `system`, while its rates are `v`.
    pub fn new(
        machine: &'a InterpretedMachine,
        system: &'a InterpretedSystem,
        v: &'a Vec<f64>,
        u: &'a Named,
    ) -> Statics<'a> {
        let parameters = constants(machine.parameter_values());
        Statics {
            interpreter: Interpreter::new(machine.program(), &parameters),
            machine,
            system,
            v,
            u,
        }
    }

    fn mass_matrix(&self, q: &Vec<f64>) -> DMatrix<f64> {
        let n = q.len();
        let mut mass = vec![0.0; n * n];
        self.system.mass_matrix(0.0, q, &mut mass);
        DMatrix::from_row_slice(n, n, &mass)
    }

    fn at(&mut self, q: &Vec<f64>) -> Result<Forces, Lost> {
        let n = q.len();
        let mass = self.mass_matrix(q);
        // A coordinate without inertia has no length of its own.
        let length = |i: usize| {
            let length = 1.0 / mass[(i, i)].sqrt();
            Some(length).filter(|x| x.is_normal()).unwrap_or(1.0)
        };
        let lengths = DVector::from_fn(n, |i, _| length(i));
        let Derived([forces, by_q, by_v]) =
            Derived::new(&mut self.interpreter, [q, self.v, &self.u.values]);
        let row_is_finite = |i: usize| {
            let row = i * n..(i + 1) * n;
            let mut numbers = by_q[row.clone()].iter().chain(&by_v[row]);
            forces[i].is_finite() && numbers.all(|x| x.is_finite())
        };
        if let Some(i) = (0..n).find(|i| !row_is_finite(*i)) {
            return Err(Lost::NotFinite(i));
        }
        let stiffness = DMatrix::from_fn(n, n, |i, j| lengths[i] * by_q[i * n + j] * lengths[j]);
        let size = |i: usize| -> f64 {
            let row = i * n..(i + 1) * n;
            // A coordinate near 0 is a sum of terms as large as its unit, a rate is what it is.
            let by_q = by_q[row.clone()].iter().zip(q);
            let by_v = by_v[row].iter().zip(self.v);
            by_q.map(|(k, q)| k.abs() * q.abs().max(1.0))
                .chain(by_v.map(|(c, v)| (c * v).abs()))
                .sum()
        };
        Ok(Forces {
            forces: DVector::from_fn(n, |i, _| forces[i] * lengths[i]),
            stiffness: rank::directions(&stiffness).ok_or(Lost::NotFinite(0))?,
            sizes: DVector::from_fn(n, |i, _| size(i) * lengths[i]),
            lengths,
        })
    }

    /// The derivatives of the accelerations by coordinates and rates, where nothing accelerates: `M⁻¹ ∂f/∂q` and `M⁻¹ ∂f/∂v`.
    ///
    /// An entry that is 0 but for the rounding of the forces, and of the place, is 0.
    fn linearized(&self, q: &Vec<f64>) -> Result<[DMatrix<f64>; 2], Lost> {
        let n = q.len();
        let point = |x: &f64| Interval::from_f64(*x);
        let parameters: Vec<Interval> = self.machine.parameter_values().iter().map(point).collect();
        let mut interpreter = Interpreter::new(self.machine.program(), &constants(&parameters));
        let place = q.iter().map(|x| {
            let rounding = 4.0 * f64::EPSILON * x.abs().max(1.0);
            Interval::new(x - rounding, x + rounding)
        });
        let [v, u] = [self.v, &self.u.values].map(|list| list.iter().map(point).collect());
        let (place, v, u): (Vec<Interval>, Vec<Interval>, Vec<Interval>) = (place.collect(), v, u);
        let Derived([_, by_q, by_v]) = Derived::new(&mut interpreter, [&place, &v, &u]);
        let mut interpreter = Interpreter::new(
            self.machine.program(),
            &constants(self.machine.parameter_values()),
        );
        let exact = Derived::new(&mut interpreter, [q, self.v, &self.u.values]);
        let mass = self.mass_matrix(q);
        let derivative = |enclosed: &[Interval], near: &[f64]| {
            let entry = |i: usize, j: usize| match enclosed[i * n + j].contains(0.0) {
                true => 0.0,
                false => near[i * n + j],
            };
            precise::solve(&mass, &DMatrix::from_fn(n, n, entry))
        };
        let singular = Lost::Singular(Singular::new(0, 0.0, 1.0));
        match [
            derivative(&by_q, &exact.0[1]),
            derivative(&by_v, &exact.0[2]),
        ] {
            [Some(by_q), Some(by_v)] => Ok([by_q, by_v]),
            _ => Err(singular),
        }
    }

    /// The equilibrium that Newton's method reaches from `q`.
    ///
    /// # Errors
    /// If there is none on its way.
    pub fn find(&mut self, q: &[f64]) -> Result<Equilibrium, Lost> {
        let mut q = q.to_vec();
        let mut here = self.at(&q)?;
        for steps in 0..MOST_STEPS {
            let step = here.step(&here.forces, &q);
            let longest = largest_share(&step, &q);
            if longest <= TOLERANCE || here.are_rounding() {
                // The last step is taken too, unless it would leave what is exact already.
                let moved = moved(&q, &step, 1.0);
                let there = self.at(&moved)?;
                if there.forces.norm() < here.forces.norm() {
                    (q, here) = (moved, there);
                }
                return self.settled(q, &here, steps);
            }
            let mut share = (LONGEST_STEP / longest).min(1.0);
            let scaled = |step: &DVector<f64>| step.component_div(&here.lengths).norm();
            let mut next = None;
            for _ in 0..MOST_HALVINGS {
                let moved = moved(&q, &step, share);
                // A state without forces is one step too far.
                if let Ok(there) = self.at(&moved) {
                    let forces = there.forces.component_div(&there.lengths);
                    let forces = forces.component_mul(&here.lengths);
                    let measured = |f: &DVector<f64>| scaled(&here.step_for(f, &here.forces, &q));
                    let unforeseen = &forces - &here.forces - here.stretched(&step) * share;
                    let length = scaled(&step);
                    if measured(&forces) <= (1.0 - share / 4.0) * length
                        || measured(&unforeseen) <= 0.75 * share * length
                    {
                        next = Some((moved, there));
                        break;
                    }
                }
                share /= 2.0;
            }
            match next {
                Some(next) => (q, here) = next,
                None if here.left_over().is_some() => return self.settled(q, &here, steps),
                None => return Err(Lost::NoEnd(steps)),
            }
        }
        Err(Lost::NoEnd(MOST_STEPS))
    }

    /// The end of the way, if forces are in balance there.
    fn settled(&self, q: Vec<f64>, here: &Forces, steps: usize) -> Result<Equilibrium, Lost> {
        let [a, ..] = linearize(self.system, 0.0, &q, self.v, self.u)?;
        if let Some(worst) = here.left_over() {
            // Inertia may hand the force on to another coordinate.
            let share = |i: &usize| (a[*i] / here.lengths[*i]).abs();
            let index = (0..q.len()).max_by(|i, j| share(i).total_cmp(&share(j)));
            let index = index.unwrap_or(worst);
            return Err(Lost::Accelerates(index, a[index]));
        }
        let free = here.stiffness.iter().filter(|d| d.is_free()).count();
        let [by_coordinates, by_rates] = self.linearized(&q)?;
        Ok(Equilibrium {
            q,
            by_coordinates,
            by_rates,
            steps,
            free,
        })
    }
}

impl Forces {
    /// The shortest step that removes these forces as far as any does.
    fn step(&self, forces: &DVector<f64>, q: &[f64]) -> DVector<f64> {
        self.step_for(forces, forces, q)
    }

    /// The same, damped as is right for the forces `damping`.
    fn step_for(&self, forces: &DVector<f64>, damping: &DVector<f64>, q: &[f64]) -> DVector<f64> {
        let mut step = DVector::zeros(q.len());
        for direction in self.stiffness.iter().filter(|d| !d.is_free()) {
            // How far the stiffest direction of this part would yield to all that is left of its forces, at most 1.
            let shares = direction.part.iter().map(|&i| {
                let yields = damping[i] / direction.largest * self.lengths[i];
                yields.abs() / q[i].abs().max(1.0)
            });
            let damping = DAMPING * direction.largest * shares.fold(0.0, f64::max).min(1.0);
            let value = direction.value;
            // 1/σ where σ is large.
            let inverse = 1.0 / (value + damping * (damping / value));
            step -= &direction.right * (direction.left.dot(forces) * inverse);
        }
        step.component_mul(&self.lengths)
    }

    /// How a step changes the forces, to first order.
    fn stretched(&self, step: &DVector<f64>) -> DVector<f64> {
        let step = step.component_div(&self.lengths);
        let mut forces = DVector::zeros(step.len());
        for Direction {
            value, left, right, ..
        } in &self.stiffness
        {
            forces += left * (value * right.dot(&step));
        }
        forces
    }

    /// What the terms of any of the forces leave by rounding.
    fn rounding(&self) -> f64 {
        rank::tolerance(self.sizes.len()) * self.sizes.amax()
    }

    /// Whether nothing is left of the forces but rounding.
    fn are_rounding(&self) -> bool {
        let rounding = f64::EPSILON * self.sizes.len() as f64;
        let mut each = self.forces.iter().zip(&self.sizes);
        each.all(|(force, size)| force.abs() <= rounding * size)
    }

    /// Of the forces that no step would remove the one that is most off zero, if one is by more than rounding.
    fn left_over(&self) -> Option<usize> {
        let mut left = self.forces.clone();
        for direction in self.stiffness.iter().filter(|d| !d.is_free()) {
            left -= &direction.left * direction.left.dot(&self.forces);
        }
        // What comes to nothing in one coordinate may be rounded in another, that is coupled to it.
        let rounding = self.rounding();
        let share = |i: usize| {
            let (left, size) = (left[i].abs(), self.sizes[i]);
            let limit = rounding.max(BALANCED * size);
            if left <= limit { 0.0 } else { left / size }
        };
        let worst = (0..left.len()).max_by(|&i, &j| share(i).total_cmp(&share(j)))?;
        (share(worst) > 0.0).then_some(worst)
    }
}

pub(super) fn constants<S: Scalar>(values: &[S]) -> Vec<Dual<S>> {
    values.iter().copied().map(Dual::constant).collect()
}

pub(super) fn moved(q: &[f64], step: &DVector<f64>, share: f64) -> Vec<f64> {
    q.iter()
        .zip(step.iter())
        .map(|(q, x)| q + share * x)
        .collect()
}

/// The largest of the changes, each in rad, m, or as a share of its coordinate.
pub(super) fn largest_share(step: &DVector<f64>, q: &[f64]) -> f64 {
    let shares = step.iter().zip(q).map(|(x, q)| x.abs() / q.abs().max(1.0));
    shares.fold(0.0, f64::max)
}
