//! The equations of motion in the independent rates that constraints leave, and their derivatives, with 32 digits.
//!
//! The constraints `G v + b = 0` determine the rates `v_D` of as many coordinates from those of the others, `s = v_I`: so
//! `v = v(q, s)` and `∂v/∂s = T` with `G T = 0`, where the rows `T_I` are those of the identity. With the accelerations a°
//! that the constraints require where `ṡ = 0`, that is `a°_I = 0` and `G a° = γ`, the motion obeys
//!
//! ```text
//! (Tᵀ M T) ṡ = r(q, s) = Tᵀ (f − M a°)                                              (E39)
//! ```
//!
//! without multipliers. Constraints on positions tie coordinates too: the first entries of `D`, `q_H`, are determined by
//! them, one for each. The other coordinates, `z`, which are I and the remaining dependent coordinates F, may be displaced
//! freely: `δq = H δz`.
//!
//! Everything is evaluated over dual numbers of 32 digits (`Dual`), so derivatives need no differences and are correct
//! in every digit of an `f64`. To bound the effect of rounding in the parameters and the state, [`Reduced::linearized`]
//! repeats the evaluation with perturbed roundings: a number within that bound may be 0.

mod choice;
mod contacts;
mod projection;

use lagrangian::System;
use lagrangian::interpreted::{InterpretedMachine, InterpretedSystem};
use lagrangian_eigen::precise;
use lagrangian_program::{Arguments, Interpreter, Role, Shape};
use lagrangian_scalar::{DoubleDouble, Dual, Scalar};
use lagrangian_units::state_of;
use nalgebra::{DMatrix, DVector};

pub use choice::Choice;
pub use contacts::ContactFault;
pub use projection::largest_relative_change;

/// A number of 32 digits with a derivative.
pub(crate) type Number = Dual<DoubleDouble>;

/// How many times the evaluation is repeated with parameters and state rounded differently.
const ROUNDINGS: usize = 6;

/// Safety factor on the largest effect of rounding that these repetitions show.
const SAFETY: f64 = 4.0;

/// Why the equations cannot be evaluated at a state.
#[derive(Clone, Debug)]
pub enum Fault {
    /// The mass matrix is singular: this coordinate has no inertia independent of the others.
    Singular(usize),
    /// A quantity of this coordinate is not finite.
    NotFinite(usize),
    /// The rate of this coordinate is given, but follows from the others.
    Follows(usize),
    /// The constraints cannot be met near the state; the index of the one with the largest residual.
    Unmet(usize),
    /// This constraint depends on the others at the state, but not near it.
    Dependent(usize),
}

/// A state: the coordinates, and the rates of I.
#[derive(Clone, Debug)]
pub struct ReducedState {
    /// All coordinates.
    pub q: Vec<DoubleDouble>,
    /// The rates of I.
    pub s: Vec<DoubleDouble>,
}

impl ReducedState {
    /// The coordinates as `f64`.
    pub fn q(&self) -> Vec<f64> {
        self.q.iter().map(|x| x.hi()).collect()
    }
}

/// The equations at a state and their derivatives.
#[derive(Clone, Debug)]
pub struct Linearized {
    /// v, of all coordinates.
    pub rates: DMatrix<f64>,
    /// r.
    pub forces: DMatrix<f64>,
    /// Tᵀ M T.
    pub mass: DMatrix<f64>,
    /// ∂r/∂z.
    pub by_places: DMatrix<f64>,
    /// ∂r/∂z without the part `(∂T/∂z)ᵀ M b`, `b = T (Tᵀ M T)⁻¹ r`, in which the change of T meets unbalanced forces. Which
    /// displacements leave r at 0 then does not depend on the choice of I.
    pub as_balanced: DMatrix<f64>,
    /// The covariant derivative of r in the metric M: `as_balanced` without the contribution of the curvature of M,
    /// `½ (∂M(Tᵢ) Hⱼ + ∂M(Hⱼ) Tᵢ) b − ½ Tᵢ ∂M(b) Hⱼ`. Newton's method with this matrix takes the same path for each
    /// choice of I, and `rᵀ (Tᵀ M T)⁻¹ r` falls along its steps. (P.-A. Absil, R. Mahony, R. Sepulchre, *Optimization
    /// Algorithms on Matrix Manifolds*, 2008, sections 5.3 and 6.1.)
    pub covariant: DMatrix<f64>,
    /// ∂r/∂s.
    pub by_rates: DMatrix<f64>,
    /// ∂v_F/∂z.
    pub rate_dependent_by_places: DMatrix<f64>,
    /// T.
    pub along: DMatrix<f64>,
    /// H.
    pub tangent: DMatrix<f64>,
}

/// All matrices of a [`Linearized`], borrowed as `$borrow` says.
macro_rules! matrices {
    ($of:expr, $($borrow:tt)+) => {
        [
            $($borrow)+ $of.rates,
            $($borrow)+ $of.forces,
            $($borrow)+ $of.mass,
            $($borrow)+ $of.by_places,
            $($borrow)+ $of.as_balanced,
            $($borrow)+ $of.covariant,
            $($borrow)+ $of.by_rates,
            $($borrow)+ $of.rate_dependent_by_places,
            $($borrow)+ $of.along,
            $($borrow)+ $of.tangent,
        ]
    };
}

impl Linearized {
    fn each(&self) -> [&DMatrix<f64>; 10] {
        matrices!(self, &)
    }

    fn each_mut(&mut self) -> [&mut DMatrix<f64>; 10] {
        matrices!(self, &mut)
    }

    /// Widens bounds, entry by entry, to the difference of two evaluations times `SAFETY`.
    fn widen(&mut self, other: &Linearized, from: &Linearized) {
        let pairs = other.each().into_iter().zip(from.each());
        for (bound, (x, y)) in self.each_mut().into_iter().zip(pairs) {
            let off = (x - y).abs() * SAFETY;
            bound.zip_apply(&off, |bound, off| *bound = bound.max(off));
        }
    }

    /// The derivative of r by displacements that the constraints allow, for Newton's method.
    pub fn stiffness(&self, choice: &Choice) -> DMatrix<f64> {
        &self.covariant * self.displaced(choice)
    }

    /// The derivative of r by displacements, from [`as_balanced`](Linearized::as_balanced): a displacement that
    /// leaves r unchanged meets no restoring force.
    pub fn dependence(&self, choice: &Choice) -> DMatrix<f64> {
        &self.as_balanced * self.displaced(choice)
    }

    /// The change of z along T.
    pub fn displaced(&self, choice: &Choice) -> DMatrix<f64> {
        let places = choice.places();
        DMatrix::from_fn(places.len(), self.along.ncols(), |i, j| {
            self.along[(places[i], j)]
        })
    }
}

/// The machine in the form of (E39).
pub struct Reduced<'a> {
    machine: &'a InterpretedMachine,
    system: &'a InterpretedSystem,
    interpreter: Interpreter<Number>,
    inputs: Vec<Number>,
    /// The time at which everything is evaluated, in s.
    time: f64,
    /// Which constraints hold positions.
    holonomic: Vec<bool>,
    /// The quaternions, as four indices of coordinates each. Their lengths are no part of the motion: here constraints
    /// `(e·e − 1)/2 = 0` hold them at 1. These follow the constraints of the machine, and no force of the machine has a
    /// component along them.
    fours: Vec<[usize; 4]>,
    /// Coordinates on which nothing depends.
    idle: Vec<bool>,
    /// The unilateral contacts whose forces are part of f; none unless [`with_contacts`](Self::with_contacts) adds them.
    contacts: Vec<contacts::Contact>,
}

impl<'a> Reduced<'a> {
    /// Sets up the equations of a machine that was prepared as `system`, and looks at them near `q` and `v`.
    pub fn new(
        machine: &'a InterpretedMachine,
        system: &'a InterpretedSystem,
        inputs: &[f64],
        states: &[(Vec<f64>, Vec<f64>)],
    ) -> Reduced<'a> {
        let parameters = constants(machine.parameter_values());
        let mut reduced = Reduced {
            interpreter: Interpreter::new(machine.program(), &parameters),
            machine,
            system,
            inputs: constants(inputs),
            time: 0.0,
            holonomic: system.constraints().map(|c| c.holonomic).collect(),
            fours: machine.program().quaternions.clone(),
            idle: Vec::new(),
            contacts: Vec::new(),
        };
        let of_lengths = reduced.fours.iter().map(|_| true);
        reduced.holonomic.extend(of_lengths);
        let n = system.coordinates().len();
        reduced.idle = (0..n)
            .map(|j| states.iter().all(|(q, v)| reduced.is_idle(j, q, v)))
            .collect();
        reduced
    }

    /// Which coordinates are integrals of states of first order.
    pub fn integrals(&self) -> Vec<bool> {
        let coordinates = self.system.coordinates();
        coordinates.map(|c| state_of(c.name).is_some()).collect()
    }

    /// The number of coordinates.
    pub fn dimension(&self) -> usize {
        self.idle.len()
    }

    /// The inputs, each with a derivative.
    pub(crate) fn inputs_mut(&mut self) -> &mut [Number] {
        &mut self.inputs
    }

    /// The time at which everything is evaluated, in s.
    pub(crate) fn time(&self) -> f64 {
        self.time
    }

    /// Sets the time at which everything is evaluated from now on, in s.
    pub(crate) fn set_time(&mut self, time: f64) {
        self.time = time;
    }

    /// The number of constraints, including those on the lengths of quaternions.
    pub(crate) fn constraints(&self) -> usize {
        self.holonomic.len()
    }

    /// The rows of the constraint matrix, one after the other.
    pub(crate) fn constraint_rows(&mut self, q: &[Number]) -> Vec<Number> {
        let (n, m) = (q.len(), self.holonomic.len());
        let zero = vec![Number::ZERO; n];
        self.call(Role::ConstraintMatrix, (q, &zero), m * n, self.time)
    }

    /// Evaluates the output with this index.
    pub(crate) fn output(
        &mut self,
        index: usize,
        (q, v, a): (&[Number], &[Number], &[Number]),
    ) -> Number {
        let mut result = [Number::ZERO];
        let arguments = Arguments {
            t: Number::from_f64(self.time),
            q,
            v,
            u: &self.inputs,
            a,
        };
        // An output has no pivots, so the call cannot fail.
        let _ = self
            .interpreter
            .call(Role::Output(index), arguments, &mut result);
        result[0]
    }

    fn call(
        &mut self,
        role: Role,
        (q, v): (&[Number], &[Number]),
        count: usize,
        t: f64,
    ) -> Vec<Number> {
        let mut results = vec![Number::ZERO; count];
        let arguments = Arguments {
            t: Number::from_f64(t),
            q,
            v,
            u: &self.inputs,
            a: &[],
        };
        // The entries for quaternion lengths follow those of the machine's own constraints.
        let of_each = match role {
            Role::ConstraintMatrix => q.len(),
            Role::ConstraintRates | Role::ConstraintBias | Role::ConstraintPositions => 1,
            _ => 0,
        };
        let (own, of_lengths) = results.split_at_mut(count - of_each * self.fours.len());
        // None of these functions has pivots, so the call cannot fail; a function that the program lacks leaves zeros.
        let _ = self.interpreter.call(role, arguments, own);
        if role == Role::Forces {
            self.add_contact_forces((q, v), t, own);
        }
        let dot = |four: &[usize; 4], a: &[Number], b: &[Number]| {
            let terms = four.iter().map(|&i| a[i] * b[i]);
            terms.fold(Number::ZERO, |sum, term| sum + term)
        };
        for (four, held) in self.fours.iter().zip(of_lengths.chunks_mut(of_each.max(1))) {
            match role {
                Role::ConstraintMatrix => four.iter().for_each(|&i| held[i] = q[i]),
                Role::ConstraintRates => held[0] = dot(four, q, v),
                Role::ConstraintBias => held[0] = -dot(four, v, v),
                _ => held[0] = (dot(four, q, q) - Number::ONE) * Number::from_f64(0.5),
            }
        }
        results
    }

    /// All terms of the equations at a state.
    pub(crate) fn ingredients(&mut self, q: &[Number], v: &[Number], t: f64) -> [Vec<Number>; 6] {
        let (n, m) = (q.len(), self.holonomic.len());
        [
            (Role::MassMatrix, Shape::Symmetric(n).len()),
            (Role::Forces, n),
            (Role::ConstraintMatrix, m * n),
            (Role::ConstraintRates, m),
            (Role::ConstraintBias, m),
            (Role::ConstraintPositions, m),
        ]
        .map(|(role, count)| self.call(role, (q, v), count, t))
    }

    /// Whether nothing depends on a coordinate.
    fn is_idle(&mut self, j: usize, q: &[f64], v: &[f64]) -> bool {
        let (mut q, v) = (constants(q), constants(v));
        q[j].derivative = DoubleDouble::ONE;
        let [all @ .., positions] = self.ingredients(&q, &v, 0.0);
        // A constraint on positions depends on it through its row.
        drop(positions);
        all.iter().flatten().all(|x| x.derivative.hi() == 0.0)
    }

    /// Whether the equations are the same at all times.
    pub fn stands_still(&mut self, states: &[(Vec<f64>, Vec<f64>)]) -> bool {
        states.iter().all(|(q, v)| {
            let (q, v) = (constants(q), constants(v));
            let mut at = |t| {
                let mut all = self.ingredients(&q, &v, t).concat();
                all.extend(self.gaps_and_rates(&q, &v, t));
                let values: Vec<DoubleDouble> = all.iter().map(|x| x.value).collect();
                // A value that is not finite cannot be compared.
                values.iter().all(|x| x.is_finite()).then_some(values)
            };
            let first = at(0.0);
            first.is_some() && [0.37, 1.13, 29.7].into_iter().all(|t| at(t) == first)
        })
    }

    /// Whether the mass matrix is regular at all of these states.
    pub fn is_regular(&self, states: &[(Vec<f64>, Vec<f64>)]) -> bool {
        let mut masses = states.iter().map(|(q, _)| self.mass(q).cholesky());
        masses.all(|factors| factors.is_some())
    }

    fn mass(&self, q: &[f64]) -> DMatrix<f64> {
        let n = q.len();
        let mut mass = vec![0.0; n * n];
        self.system.mass_matrix(0.0, &q.to_vec(), &mut mass);
        DMatrix::from_row_slice(n, n, &mass)
    }

    fn rows(&self, q: &[f64]) -> DMatrix<f64> {
        let (n, m) = (q.len(), self.holonomic.len());
        let mut rows = vec![0.0; m * n];
        let (own, of_lengths) = rows.split_at_mut((m - self.fours.len()) * n);
        self.system.constraint_matrix(0.0, &q.to_vec(), own);
        for (four, row) in self.fours.iter().zip(of_lengths.chunks_mut(n.max(1))) {
            four.iter().for_each(|&i| row[i] = q[i]);
        }
        DMatrix::from_row_slice(m, n, &rows)
    }

    /// The metric of displacements: `L` with `L Lᵀ = M`, or the square roots of the diagonal where M is singular.
    fn metric(&self, q: &[f64]) -> DMatrix<f64> {
        let mass = self.mass(q);
        let own = |i: usize| {
            let root = mass[(i, i)].sqrt();
            if root.is_normal() { root } else { 1.0 }
        };
        let lower = mass.clone().cholesky().map(|factors| factors.l());
        lower
            .filter(|l| l.iter().all(|x| x.is_finite()))
            .unwrap_or_else(|| DMatrix::from_diagonal(&DVector::from_fn(q.len(), |i, _| own(i))))
    }

    /// The residuals of the constraints on positions, each in its own unit.
    fn positions(&mut self, q: &[DoubleDouble]) -> Vec<f64> {
        let wide: Vec<Number> = q.iter().copied().map(Dual::constant).collect();
        let still = vec![Number::ZERO; q.len()];
        let count = self.holonomic.len();
        let values = self.call(Role::ConstraintPositions, (&wide, &still), count, self.time);
        values.iter().map(|x| x.value.hi()).collect()
    }

    /// All terms of the equations, over numbers with a derivative.
    pub(crate) fn evaluate(
        &mut self,
        choice: &Choice,
        q: &[Number],
        s: &[Number],
    ) -> Result<Evaluated, Fault> {
        let (n, m) = (q.len(), self.holonomic.len());
        let zero = vec![Number::ZERO; n];
        let rows = self.call(Role::ConstraintMatrix, (q, &zero), m * n, self.time);
        let offset = self.call(Role::ConstraintRates, (q, &zero), m, self.time);
        let dependent = choice.dependent();
        let count = choice.independent.len();
        let [square, right] = blocks(choice, &dependent, (&rows, &offset), s);
        let singular = || Fault::Singular(dependent.first().copied().unwrap_or(0));
        let solved = solve(square.clone(), right).map_err(|_| singular())?;
        let mut along = vec![vec![Number::ZERO; count]; n];
        let mut v = zero;
        for (c, &j) in choice.independent.iter().enumerate() {
            along[j][c] = Number::ONE;
            v[j] = s[c];
        }
        for (row, &j) in solved.into_iter().zip(&dependent) {
            v[j] = row[count];
            along[j].copy_from_slice(&row[..count]);
        }
        let bias = self.call(Role::ConstraintBias, (q, &v), m, self.time);
        let right = choice.rows.iter().map(|&k| vec![bias[k]]).collect();
        let solved = solve(square, right).map_err(|_| singular())?;
        let mass = self.mass_at(q, &v);
        let applied = self.call(Role::Forces, (q, &v), n, self.time);
        let mut forces = applied.clone();
        for (a, &j) in solved.iter().zip(&dependent) {
            for (i, force) in forces.iter_mut().enumerate() {
                *force = *force - mass[i * n + j] * a[0];
            }
        }
        let reduced = (0..count).map(|c| {
            let terms = along.iter().zip(&forces);
            terms.fold(Number::ZERO, |sum, (row, force)| sum + row[c] * *force)
        });
        let reduced: Vec<Number> = reduced.collect();
        let finite = |x: &Number| x.value.is_finite() && x.derivative.is_finite();
        if let Some(c) = reduced.iter().position(|x| !finite(x)) {
            return Err(Fault::NotFinite(choice.independent[c]));
        }
        if let Some(j) = v.iter().position(|x| !finite(x)) {
            return Err(Fault::NotFinite(j));
        }
        let mut held = vec![Number::ZERO; n];
        for (a, &j) in solved.iter().zip(&dependent) {
            held[j] = a[0];
        }
        Ok(Evaluated {
            rates: v,
            forces: reduced,
            along,
            mass,
            applied,
            held,
        })
    }

    /// M, row after row.
    fn mass_at(&mut self, q: &[Number], v: &[Number]) -> Vec<Number> {
        let n = q.len();
        let count = Shape::Symmetric(n).len();
        let lower = self.call(Role::MassMatrix, (q, v), count, self.time);
        let mut mass = vec![Number::ZERO; n * n];
        for (index, entry) in lower.into_iter().enumerate() {
            let (i, j) = Shape::place(index);
            (mass[i * n + j], mass[j * n + i]) = (entry, entry);
        }
        mass
    }

    /// The displacement of all coordinates with each entry of z, in 32 digits.
    pub(crate) fn tangent(
        &mut self,
        choice: &Choice,
        q: &[Number],
    ) -> Result<Vec<Vec<DoubleDouble>>, Fault> {
        let (n, m) = (q.len(), self.holonomic.len());
        let places = choice.places();
        let mut tangent = vec![vec![DoubleDouble::ZERO; n]; places.len()];
        for (column, &j) in tangent.iter_mut().zip(&places) {
            column[j] = DoubleDouble::ONE;
        }
        let held = choice.position_dependent.len();
        if held > 0 {
            let zero = vec![Number::ZERO; n];
            let rows = self.call(Role::ConstraintMatrix, (q, &zero), m * n, self.time);
            let pick = |list: &[usize], sign: Number| -> Vec<Vec<Number>> {
                let row = |k: &usize| list.iter().map(|j| sign * rows[k * n + j]).collect();
                choice.rows[..held].iter().map(row).collect()
            };
            let solved = solve(
                pick(&choice.position_dependent, Number::ONE),
                pick(&places, -Number::ONE),
            );
            let solved = solved.map_err(|_| Fault::Singular(choice.position_dependent[0]))?;
            for (row, &j) in solved.into_iter().zip(&choice.position_dependent) {
                for (column, x) in tangent.iter_mut().zip(row) {
                    column[j] = x.value;
                }
            }
        }
        Ok(tangent)
    }

    /// The equations at a state, and their derivatives.
    fn linearize(&mut self, choice: &Choice, place: &ReducedState) -> Result<Linearized, Fault> {
        let constant = |list: &[DoubleDouble]| -> Vec<Number> {
            list.iter().copied().map(Dual::constant).collect()
        };
        let (mut q, mut s) = (constant(&place.q), constant(&place.s));
        let n = q.len();
        let tangent = self.tangent(choice, &q)?;
        let (count, places) = (choice.independent.len(), choice.places().len());
        let here = self.evaluate(choice, &q, &s)?;
        let value = |x: &Number| x.value.hi();
        let along = DMatrix::from_fn(n, count, |i, j| value(&here.along[i][j]));
        let mass = DMatrix::from_fn(n, n, |i, j| value(&here.mass[i * n + j]));
        let mut linearized = Linearized {
            rates: DMatrix::from_fn(n, 1, |i, _| value(&here.rates[i])),
            forces: DMatrix::from_fn(count, 1, |i, _| value(&here.forces[i])),
            mass: along.transpose() * &mass * &along,
            by_places: DMatrix::zeros(count, places),
            as_balanced: DMatrix::zeros(count, places),
            covariant: DMatrix::zeros(count, places),
            by_rates: DMatrix::zeros(count, count),
            rate_dependent_by_places: DMatrix::zeros(choice.rate_dependent.len(), places),
            along,
            tangent: DMatrix::from_fn(n, places, |i, j| tangent[j][i].hi()),
        };
        let numbers = linearized.mass.iter().position(|x| !x.is_finite());
        if let Some(index) = numbers {
            return Err(Fault::NotFinite(choice.independent[index / count]));
        }
        let slope = |x: &Number| x.derivative.hi();
        let accelerations = divided(&linearized.mass, &linearized.forces);
        let accelerations = accelerations.unwrap_or_else(|| DMatrix::zeros(count, 1));
        let displaced = linearized.displaced(choice);
        let (along_z, b) = (
            &displaced * &accelerations,
            &linearized.along * accelerations,
        );
        let unbalanced = mass * &b;
        // ∂M(Hⱼ) b, and ∂M(b).
        let mut bent = DMatrix::zeros(n, places);
        let mut along_b = DMatrix::zeros(n, n);
        for (column, direction) in tangent.iter().enumerate() {
            for (q, d) in q.iter_mut().zip(direction) {
                q.derivative = *d;
            }
            let there = self.evaluate(choice, &q, &s)?;
            for (i, force) in there.forces.iter().enumerate() {
                linearized.by_places[(i, column)] = slope(force);
                let rows = there.along.iter().zip(unbalanced.iter());
                let turned: f64 = rows.map(|(row, x)| slope(&row[i]) * x).sum();
                linearized.as_balanced[(i, column)] = slope(force) - turned;
            }
            let change = DMatrix::from_fn(n, n, |i, j| slope(&there.mass[i * n + j]));
            bent.set_column(column, &(&change * b.column(0)));
            along_b += change * along_z[column];
            for (i, &j) in choice.rate_dependent.iter().enumerate() {
                linearized.rate_dependent_by_places[(i, column)] = slope(&there.rates[j]);
            }
        }
        let (along, tangent) = (linearized.along.transpose(), &linearized.tangent);
        let bends = displaced.transpose() * bent.transpose() * tangent + &along * bent
            - along * along_b * tangent;
        linearized.covariant = &linearized.as_balanced - bends * 0.5;
        q = constant(&place.q);
        for column in 0..count {
            s[column].derivative = DoubleDouble::ONE;
            let there = self.evaluate(choice, &q, &s)?;
            for (i, force) in there.forces.iter().enumerate() {
                linearized.by_rates[(i, column)] = slope(force);
            }
            s[column].derivative = DoubleDouble::ZERO;
        }
        Ok(linearized)
    }

    /// The equations at a state, and bounds on the effect of rounding in parameters and state on each entry.
    ///
    /// # Errors
    /// If they cannot be evaluated.
    pub fn linearized(
        &mut self,
        choice: &Choice,
        place: &ReducedState,
    ) -> Result<(Linearized, Linearized), Fault> {
        let here = self.linearize(choice, place)?;
        let mut bounds = here.clone();
        bounds
            .each_mut()
            .into_iter()
            .for_each(|matrix| matrix.fill(0.0));
        self.rounded(place, |reduced, other| {
            if let Ok(found) = reduced.linearize(choice, other) {
                bounds.widen(&found, &here);
            }
        });
        Ok((here, bounds))
    }

    /// Calls `work` several times, with state, parameters and inputs rounded differently each time.
    pub(crate) fn rounded(
        &mut self,
        place: &ReducedState,
        mut work: impl FnMut(&mut Self, &ReducedState),
    ) {
        let mut next = noise();
        let values = self.machine.parameter_values().to_vec();
        let inputs = self.inputs.clone();
        for _ in 0..ROUNDINGS {
            let mut rounded = |x: f64| DoubleDouble::from(x) * (DoubleDouble::ONE + next().into());
            let parameters: Vec<Number> =
                values.iter().map(|x| Dual::constant(rounded(*x))).collect();
            let s = place.s.iter().map(|x| rounded(x.hi())).collect();
            let q = place.q.iter().map(|x| {
                let unit = DoubleDouble::from(x.hi().abs().max(1.0) * next());
                *x + unit
            });
            let other = ReducedState { q: q.collect(), s };
            let rounded = |x: &Number| Number::from_f64(x.value.hi() * (1.0 + next()));
            self.inputs = inputs.iter().map(rounded).collect();
            self.interpreter.prepare(&parameters);
            work(self, &other);
        }
        self.interpreter.prepare(&constants(&values));
        self.inputs = inputs;
    }

    /// The equations at a state, without bounds.
    ///
    /// # Errors
    /// If they cannot be evaluated.
    pub fn linearized_only(
        &mut self,
        choice: &Choice,
        place: &ReducedState,
    ) -> Result<Linearized, Fault> {
        self.linearize(choice, place)
    }
}

/// The terms of the equations, over numbers with a derivative.
pub(crate) struct Evaluated {
    /// v, of all coordinates.
    pub rates: Vec<Number>,
    /// r.
    pub forces: Vec<Number>,
    /// T, row after row.
    pub along: Vec<Vec<Number>>,
    /// M, row after row.
    pub mass: Vec<Number>,
    /// f.
    pub applied: Vec<Number>,
    /// a°.
    pub held: Vec<Number>,
}

/// The blocks of the chosen constraints `G v + b = 0`, with the rows of G one after the other: of the `dependent` coordinates, `G_D`, and of
/// all else, `−G_I` followed by `−b − G_I s`.
fn blocks(
    choice: &Choice,
    dependent: &[usize],
    (rows, offset): (&[Number], &[Number]),
    s: &[Number],
) -> [Vec<Vec<Number>>; 2] {
    let n = dependent.len() + choice.independent.len();
    let entry = |k: usize, j: usize| rows[k * n + j];
    let of_dependent = choice.rows.iter();
    let of_dependent = of_dependent.map(|&k| dependent.iter().map(|&j| entry(k, j)).collect());
    let of_others = choice.rows.iter().map(|&k| {
        let independent = choice.independent.iter();
        let mut row: Vec<Number> = independent.map(|&j| -entry(k, j)).collect();
        let sum = row
            .iter()
            .zip(s)
            .fold(-offset[k], |sum, (g, s)| sum + *g * *s);
        row.push(sum);
        row
    });
    [of_dependent.collect(), of_others.collect()]
}

/// `A⁻¹ B` by Gaussian elimination with pivoting.
///
/// # Errors
/// If A is singular: the first column that depends on those before it.
pub(crate) fn solve(
    mut a: Vec<Vec<Number>>,
    mut b: Vec<Vec<Number>>,
) -> Result<Vec<Vec<Number>>, usize> {
    let n = a.len();
    for k in 0..n {
        let size = |i: &usize| a[*i][k].value.hi().abs();
        let pivot = (k..n)
            .max_by(|i, j| size(i).total_cmp(&size(j)))
            .unwrap_or(k);
        a.swap(k, pivot);
        b.swap(k, pivot);
        let (above, below) = a.split_at_mut(k + 1);
        let pivot = above[k][k];
        if pivot.value.hi() == 0.0 || !pivot.value.is_finite() {
            return Err(k);
        }
        let (above_b, below_b) = b.split_at_mut(k + 1);
        for (row, row_b) in below.iter_mut().zip(below_b) {
            let factor = row[k] / pivot;
            for (x, p) in row.iter_mut().zip(&above[k]).skip(k) {
                *x = *x - factor * *p;
            }
            for (x, p) in row_b.iter_mut().zip(&above_b[k]) {
                *x = *x - factor * *p;
            }
        }
    }
    for k in (0..n).rev() {
        for c in 0..b[k].len() {
            let known = (k + 1..n).fold(b[k][c], |sum, j| sum - a[k][j] * b[j][c]);
            b[k][c] = known / a[k][k];
        }
    }
    Ok(b)
}

/// A fixed sequence of pseudorandom numbers between −ε and ε.
fn noise() -> impl FnMut() -> f64 {
    let mut state = 0x5DEE_CE66_u64;
    move || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        ((state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0) * f64::EPSILON
    }
}

fn constants(values: &[f64]) -> Vec<Number> {
    values.iter().map(|x| Number::from_f64(*x)).collect()
}

/// `M⁻¹ B`, in which only the results are rounded to `f64`. `None` where M is singular.
pub fn divided(mass: &DMatrix<f64>, b: &DMatrix<f64>) -> Option<DMatrix<f64>> {
    match b.ncols() {
        0 => Some(b.clone()),
        _ => precise::solve(mass, b),
    }
}
