//! The equations of motion of an interpreted machine, by calls of the functions of its program.

use std::string::String;
use std::sync::{Arc, MutexGuard};
use std::vec;
use std::vec::Vec;

use lagrangian_program as program;
use lagrangian_program::quantity::Extent;
use lagrangian_program::{Arguments, Interpreter, Program, Role, Shape};
use lagrangian_scalar::Interval;
use lagrangian_spec::model;

use super::InterpretedMachine;
use super::closed_series::ExpandingClosed;
use super::contact_parts::RunningParts;
use super::expanding::Expanding;
use super::motion_series::{self, MotionSeries};
use super::named::{Named, Names, quantities};
use super::running::{Running, at};
use crate::shared_workspace::SharedWorkspace;
use crate::{
    Assumption, Compliance, Constraint, ContactMode, ContactQuantity, ImpactLaw, ImpactOrder,
    Painleve, Pivot, Quantity, Singular, System, UnilateralContact, accelerations_with_friction,
    multipliers_with_friction,
};

/// The equations of motion of an [`InterpretedMachine`].
#[derive(Clone, Debug)]
pub struct InterpretedSystem {
    pub(super) program: Arc<Program>,
    pub(super) names: Arc<Names>,
    inputs: Vec<f64>,
    /// Memory that calls write to.
    pub(super) running: SharedWorkspace<Running>,
    /// The numbers of single contacts, where there are many.
    contact_parts: Option<SharedWorkspace<RunningParts>>,
    /// Where there are, for each coordinate and for the time whether a gap depends on it.
    gap_arguments: Option<Arc<[bool]>>,
    /// The parameters, and the same program over intervals once it is needed; for machines with guided contacts, or with
    /// [many](ContactParts) unilateral ones.
    parameters: Vec<f64>,
    enclosing: SharedWorkspace<Option<Interpreter<Interval>>>,
    pub(super) series: MotionSeries,
    has_linear_assumptions: bool,
    /// The quantities of one number that are 0 at every state.
    zeros: Arc<[Role]>,
    pub(super) expanding: SharedWorkspace<Expanding>,
    expanding_closed: SharedWorkspace<ExpandingClosed>,
}

impl InterpretedSystem {
    /// The system of a machine with the current values of its parameters.
    pub(super) fn of(machine: &InterpretedMachine) -> InterpretedSystem {
        let interpreter = Interpreter::new(&machine.program, &machine.parameters);
        let contact_parts = machine.contact_parts.as_ref().map(|parts| {
            let prepared = interpreter.prepared();
            let parts = RunningParts::new(parts.clone(), &machine.code_of_parts, prepared);
            SharedWorkspace::new(parts)
        });
        let needs_ranges = !machine.program.contacts.is_empty() || contact_parts.is_some();
        InterpretedSystem {
            program: machine.program.clone(),
            names: machine.names.clone(),
            inputs: machine.inputs.clone(),
            contact_parts,
            gap_arguments: machine.gap_arguments.clone(),
            running: SharedWorkspace::new(Running {
                compiled: machine.machine_code.prepared(&interpreter),
                interpreter,
            }),
            parameters: if needs_ranges {
                machine.parameters.clone()
            } else {
                Vec::new()
            },
            enclosing: SharedWorkspace::new(None),
            series: machine.series.clone(),
            has_linear_assumptions: machine.program.has_linear_assumptions(),
            zeros: machine.zeros.clone(),
            expanding: SharedWorkspace::new(Expanding::new(machine.machine_code.clone())),
            expanding_closed: SharedWorkspace::new(ExpandingClosed::new(
                machine.closed_series.clone(),
                machine.machine_code.clone(),
            )),
        }
    }

    /// Calls a function of the program; functions that the machine does not have return 0.
    pub(super) fn call(
        &self,
        role: Role,
        arguments: Arguments<'_, f64>,
        results: &mut [f64],
    ) -> Result<(), Singular> {
        let mut running = self.running.lock();
        let called = running.call(role, arguments, results);
        called.map_err(|singular| singular_row(&self.program, singular))
    }

    /// Calls a function whose values exist at every state, so it cannot be singular.
    fn fill(&self, role: Role, arguments: Arguments<'_, f64>, results: &mut [f64]) {
        let _ = self.call(role, arguments, results);
    }

    /// The output with this index among those of [`outputs`](System::outputs), in SI units.
    /// `a` may be empty if the output does not depend on accelerations.
    pub fn output(&self, index: usize, t: f64, q: &[f64], v: &[f64], a: &[f64], u: &[f64]) -> f64 {
        self.number(Role::Output(index), Arguments { t, q, v, u, a })
    }

    /// The numbers of a quantity of the program ([`program`](Self::program)), with the bits of compiled machines.
    ///
    /// # Errors
    /// If the machine is singular and the quantity depends on accelerations.
    ///
    /// # Panics
    /// If an argument that the quantity depends on, or `results`, has another length than in the program.
    pub fn quantity(
        &self,
        role: Role,
        arguments: Arguments<'_, f64>,
        results: &mut [f64],
    ) -> Result<(), Singular> {
        self.call(role, arguments, results)
    }

    /// The program over intervals, with the rounding of the parameters.
    fn enclosing(&self) -> MutexGuard<'_, Option<Interpreter<Interval>>> {
        let mut enclosing = self.enclosing.lock();
        if enclosing.is_none() {
            let parameters = rounded_each(&self.parameters);
            *enclosing = Some(Interpreter::new(&self.program, &parameters));
        }
        enclosing
    }

    /// Calls a function of a symmetric matrix, and writes the square matrix row after row.
    fn fill_square(&self, role: Role, arguments: Arguments<'_, f64>, matrix: &mut [f64]) {
        let n = arguments.q.len();
        let Some(matrix) = matrix.get_mut(..n * n) else {
            return;
        };
        // The lower triangle, row after row, goes to the beginning of the matrix. From the last entry on each is then moved to its place, which is not before that.
        let lower = &mut matrix[..Shape::Symmetric(n).len()];
        lower.fill(0.0);
        self.fill(role, arguments, lower);
        let mut last = lower.len();
        for i in (0..n).rev() {
            for j in (0..=i).rev() {
                last -= 1;
                matrix[i * n + j] = matrix[last];
            }
        }
        for i in 0..n {
            for j in 0..i {
                matrix[j * n + i] = matrix[i * n + j];
            }
        }
    }

    /// Calls a function that returns one number, whose value exists at every state.
    fn number(&self, role: Role, arguments: Arguments<'_, f64>) -> f64 {
        if self.zeros.contains(&role) {
            return 0.0;
        }
        let mut result = [0.0];
        match self.call(role, arguments, &mut result) {
            Ok(()) => result[0],
            Err(_) => f64::NAN,
        }
    }
}

/// The quantities of one number that are 0 at every state, of those that every system has.
pub(super) fn zeros(program: &Program) -> Arc<[Role]> {
    let is_zero = |role: &Role| {
        let (row, function) = (role.row(), program.function(*role));
        let is_number = row.extent == Extent::Number && row.method.is_some();
        is_number && function.is_none_or(|function| function.is_zero())
    };
    Role::all().filter(is_zero).collect()
}

/// A number with its rounding.
fn rounded(x: f64) -> Interval {
    Interval::new(x.next_down(), x.next_up())
}

/// Numbers with their roundings.
fn rounded_each(numbers: &[f64]) -> Vec<Interval> {
    numbers.iter().map(|x| rounded(*x)).collect()
}

/// The row at which elimination stopped; the program counts coordinates and constraints consecutively.
pub(super) fn singular_row(program: &Program, singular: program::Singular) -> Singular {
    let program::Singular { coordinate, ratio } = singular;
    let at = match coordinate.checked_sub(program.dimension()) {
        None => Pivot::Coordinate(coordinate),
        Some(constraint) => Pivot::Constraint(constraint),
    };
    Singular { at, ratio }
}

impl System for InterpretedSystem {
    type Vector = Vec<f64>;
    type Matrix = Vec<f64>;
    type Coordinates = Named;
    type Inputs = Named;
    type Outputs = Named;

    fn coordinates(&self) -> impl ExactSizeIterator<Item = Quantity<'_>> {
        quantities(&self.names.coordinates)
    }

    fn to_coordinates(&self, vector: &Vec<f64>) -> Named {
        Named::new(&self.names.coordinates, vector.clone())
    }

    fn copy_to_coordinates(&self, vector: &Vec<f64>, coordinates: &mut Named) {
        coordinates.values.clone_from(vector);
    }

    fn to_vector(&self, coordinates: &Named) -> Vec<f64> {
        coordinates.values.clone()
    }

    fn accelerations(
        &self,
        t: f64,
        q: &Vec<f64>,
        v: &Vec<f64>,
        u: &Named,
        a: &mut Vec<f64>,
    ) -> Result<(), Singular> {
        if !self.program.contacts.is_empty() {
            return accelerations_with_friction(self, t, q, v, u, a);
        }
        self.call(Role::Accelerations, at(t, q, v, &u.values), a)
    }

    fn has_linear_assumptions(&self) -> bool {
        self.has_linear_assumptions
    }

    fn check_series(&self) -> Result<(), &str> {
        match &self.series.known().series {
            Ok(_) => Ok(()),
            Err(reason) => Err(reason),
        }
    }

    fn series_cost(&self) -> Option<[f64; 2]> {
        self.series.cost(&self.program)
    }

    fn powers_cost(&self) -> [f64; 3] {
        if !self.has_powers() {
            return [0.0; 3];
        }
        let costs = self.series.cost_of_powers(&self.program);
        costs.unwrap_or_default()
    }

    fn series_derivation(&self) -> Option<f64> {
        let may_have_one = self.program.contacts.is_empty()
            && self.program.constraints.iter().all(|of| of.holonomic);
        let evaluations = || {
            if may_have_one {
                motion_series::derivation(&self.program)
            } else {
                f64::INFINITY
            }
        };
        self.series.is_on_demand().then(evaluations)
    }

    fn series(
        &self,
        t: [f64; 2],
        q: &Vec<f64>,
        v: &Vec<f64>,
        u: &Named,
        coefficients: &mut [Vec<f64>],
    ) -> Result<(), Singular> {
        let parameters = || self.running.lock().interpreter.parameters().to_vec();
        let mut expanding = self.expanding.lock();
        let at = (t, [q.as_slice(), v.as_slice(), u.values.as_slice()]);
        let expanded = expanding.expand((self.series.known(), parameters), at, coefficients);
        expanded.map_err(|singular| singular_row(&self.program, singular))
    }

    fn closed_series(
        &self,
        contacts: (&[ContactMode], &[usize]),
        t: [f64; 2],
        (q, v): (&Vec<f64>, &Vec<f64>),
        u: &Named,
        coefficients: &mut [Vec<f64>],
    ) -> Option<Result<(), Singular>> {
        let parameters = || self.running.lock().interpreter.parameters().to_vec();
        let at = (t, [q.as_slice(), v.as_slice(), u.values.as_slice()]);
        let mut expanding = self.expanding_closed.lock();
        let expanded = expanding.expand(contacts, parameters, at, coefficients)?;
        // Which contact it is matters to nobody: the run goes on by another method.
        Some(expanded.map_err(|singular| {
            let own = self.program.dimension() + self.program.constraints.len();
            let coordinate = singular.coordinate.min(own.saturating_sub(1));
            singular_row(
                &self.program,
                program::Singular {
                    coordinate,
                    ..singular
                },
            )
        }))
    }

    // <quantities: interpreted>
    fn mass_matrix(&self, t: f64, q: &Vec<f64>, matrix: &mut Vec<f64>) {
        self.fill_square(Role::MassMatrix, at(t, q, &[], &[]), matrix);
    }

    fn bias(&self, t: f64, q: &Vec<f64>, v: &Vec<f64>, bias: &mut Vec<f64>) {
        self.fill(Role::Bias, at(t, q, v, &[]), bias);
    }

    fn applied(&self, t: f64, q: &Vec<f64>, v: &Vec<f64>, u: &Named, applied: &mut Vec<f64>) {
        self.fill(Role::Applied, at(t, q, v, &u.values), applied);
    }

    fn forces(&self, t: f64, q: &Vec<f64>, v: &Vec<f64>, u: &Named, forces: &mut Vec<f64>) {
        self.fill(Role::Forces, at(t, q, v, &u.values), forces);
    }

    fn constraint_positions(&self, t: f64, q: &Vec<f64>, positions: &mut [f64]) {
        self.fill(Role::ConstraintPositions, at(t, q, &[], &[]), positions);
    }

    fn constraint_rates(&self, t: f64, q: &Vec<f64>, v: &Vec<f64>, rates: &mut [f64]) {
        self.fill(Role::ConstraintRates, at(t, q, v, &[]), rates);
    }

    fn constraint_matrix(&self, t: f64, q: &Vec<f64>, matrix: &mut [f64]) {
        self.fill(Role::ConstraintMatrix, at(t, q, &[], &[]), matrix);
    }

    fn constraint_bias(&self, t: f64, q: &Vec<f64>, v: &Vec<f64>, bias: &mut [f64]) {
        self.fill(Role::ConstraintBias, at(t, q, v, &[]), bias);
    }

    fn slips(&self, t: f64, q: &Vec<f64>, v: &Vec<f64>, slips: &mut [f64]) {
        self.fill(Role::Slips, at(t, q, v, &[]), slips);
    }

    fn slip_matrix(&self, t: f64, q: &Vec<f64>, matrix: &mut [f64]) {
        self.fill(Role::SlipMatrix, at(t, q, &[], &[]), matrix);
    }

    fn slip_bias(&self, t: f64, q: &Vec<f64>, v: &Vec<f64>, bias: &mut [f64]) {
        self.fill(Role::SlipBias, at(t, q, v, &[]), bias);
    }

    fn gaps(&self, t: f64, q: &Vec<f64>, gaps: &mut [f64]) {
        self.fill(Role::Gaps, at(t, q, &[], &[]), gaps);
    }

    fn contact_rates(&self, t: f64, q: &Vec<f64>, v: &Vec<f64>, rates: &mut [f64]) {
        self.fill(Role::ContactRates, at(t, q, v, &[]), rates);
    }

    fn contact_matrix(&self, t: f64, q: &Vec<f64>, matrix: &mut [f64]) {
        self.fill(Role::ContactMatrix, at(t, q, &[], &[]), matrix);
    }

    fn contact_bias(&self, t: f64, q: &Vec<f64>, v: &Vec<f64>, bias: &mut [f64]) {
        self.fill(Role::ContactBias, at(t, q, v, &[]), bias);
    }

    fn contact_coefficients(&self, t: f64, q: &Vec<f64>, v: &Vec<f64>, coefficients: &mut [f64]) {
        self.fill(Role::ContactCoefficients, at(t, q, v, &[]), coefficients);
    }

    fn contact_faces(&self, t: f64, q: &Vec<f64>, v: &Vec<f64>, faces: &mut [f64]) {
        self.fill(Role::ContactFaces, at(t, q, v, &[]), faces);
    }

    fn guide_matrix(&self, t: f64, q: &Vec<f64>, matrix: &mut [f64]) {
        self.fill(Role::GuideMatrix, at(t, q, &[], &[]), matrix);
    }

    fn guide_loads(&self, t: f64, q: &Vec<f64>, v: &Vec<f64>, u: &Named, loads: &mut [f64]) {
        self.fill(Role::GuideLoads, at(t, q, v, &u.values), loads);
    }

    fn kinetic_energy(&self, t: f64, q: &Vec<f64>, v: &Vec<f64>) -> f64 {
        self.number(Role::KineticEnergy, at(t, q, v, &[]))
    }

    fn potential_energy(&self, t: f64, q: &Vec<f64>, u: &Named) -> f64 {
        self.number(Role::PotentialEnergy, at(t, q, &[], &u.values))
    }

    fn state_energy(&self, t: f64, q: &Vec<f64>, v: &Vec<f64>) -> f64 {
        self.number(Role::StateEnergy, at(t, q, v, &[]))
    }

    fn dissipation(&self, t: f64, q: &Vec<f64>, v: &Vec<f64>, u: &Named) -> f64 {
        self.number(Role::Dissipation, at(t, q, v, &u.values))
    }

    fn work_rate(&self, t: f64, q: &Vec<f64>, v: &Vec<f64>, a: &Vec<f64>, u: &Named) -> f64 {
        let arguments = Arguments {
            a,
            ..at(t, q, v, &u.values)
        };
        self.number(Role::WorkRate, arguments)
    }

    fn dissipation_rate(&self, t: f64, q: &Vec<f64>, v: &Vec<f64>, u: &Named) -> f64 {
        self.number(Role::DissipationRate, at(t, q, v, &u.values))
    }
    // </quantities>

    fn has_powers(&self) -> bool {
        let powers = [Role::WorkRate, Role::DissipationRate];
        !powers.iter().all(|role| self.zeros.contains(role))
    }

    fn default_inputs(&self) -> Named {
        Named::new(&self.names.inputs, self.inputs.clone())
    }

    fn input_values(&self, inputs: &Named) -> impl ExactSizeIterator<Item = (Quantity<'_>, f64)> {
        let values: Vec<f64> = inputs.values.clone();
        quantities(&self.names.inputs).zip(values)
    }

    fn outputs(&self, t: f64, q: &Vec<f64>, v: &Vec<f64>, a: &Vec<f64>, u: &Named) -> Named {
        let arguments = Arguments {
            t,
            q,
            v,
            u: &u.values,
            a,
        };
        let roles = (0..self.program.outputs.len()).map(Role::Output);
        let values = roles.map(|role| self.number(role, arguments)).collect();
        Named::new(&self.names.outputs, values)
    }

    fn output_values(&self, outputs: &Named) -> impl ExactSizeIterator<Item = (Quantity<'_>, f64)> {
        let values: Vec<f64> = outputs.values.clone();
        quantities(&self.names.outputs).zip(values)
    }

    fn assumptions(
        &self,
        t: f64,
        q: &Vec<f64>,
        v: &Vec<f64>,
        u: &Named,
    ) -> impl ExactSizeIterator<Item = Assumption<'_>> {
        let arguments = at(t, q, v, &u.values);
        let margins: Vec<f64> = (0..self.program.assumptions.len())
            .map(|index| self.number(Role::Assumption(index), arguments))
            .collect();
        let facts = self.program.assumptions.iter().zip(margins);
        facts.map(|(fact, margin)| Assumption {
            text: &fact.text,
            margin,
            strict: fact.strict,
        })
    }

    fn constraints(&self) -> impl ExactSizeIterator<Item = Constraint<'_>> {
        let constraints = self.program.constraints.iter();
        constraints.map(|constraint| Constraint {
            name: &constraint.name,
            unit: &constraint.unit,
            multiplier_unit: &constraint.multiplier_unit,
            holonomic: constraint.holonomic,
        })
    }

    fn multipliers(
        &self,
        t: f64,
        q: &Vec<f64>,
        v: &Vec<f64>,
        u: &Named,
        multipliers: &mut [f64],
    ) -> Result<(), Singular> {
        let arguments = at(t, q, v, &u.values);
        match (&*self.program.constraints, &*self.program.contacts) {
            ([], _) => Ok(()),
            (_, []) => self.call(Role::Multipliers, arguments, multipliers),
            _ => multipliers_with_friction(self, t, q, v, u, multipliers),
        }
    }

    fn projection(
        &self,
        t: f64,
        q: &Vec<f64>,
        v: &Vec<f64>,
        numbers: &mut [f64],
    ) -> Result<bool, Singular> {
        if self.program.function(Role::Projection).is_none() {
            return Ok(false);
        }
        self.call(Role::Projection, at(t, q, v, &[]), numbers)?;
        Ok(true)
    }

    fn contacts(&self) -> impl ExactSizeIterator<Item = &str> {
        self.program.contacts.iter().map(String::as_str)
    }

    fn reaction_axes(&self) -> usize {
        self.program.reaction_axes
    }

    fn second_tangents(&self) -> u64 {
        self.program.second_tangents
    }

    fn unilateral_contacts(&self) -> impl ExactSizeIterator<Item = UnilateralContact<'_>> {
        self.program
            .unilateral
            .iter()
            .map(|contact| UnilateralContact {
                name: &contact.name,
                law: match contact.law {
                    model::ImpactLaw::Newton => ImpactLaw::Newton,
                    model::ImpactLaw::Poisson => ImpactLaw::Poisson,
                    model::ImpactLaw::PoissonGlocker => ImpactLaw::PoissonGlocker,
                    model::ImpactLaw::Stronge => ImpactLaw::Stronge,
                },
                order: match contact.order {
                    model::ImpactOrder::AtOnce => ImpactOrder::AtOnce,
                    model::ImpactOrder::Sequence => ImpactOrder::Sequence,
                },
                painleve: match contact.painleve {
                    model::Painleve::Error => Painleve::Error,
                    model::Painleve::Impact => Painleve::Impact,
                },
                compliance: contact.compliance.map(|law| match law {
                    model::Compliance::Linear => Compliance::Linear,
                    model::Compliance::Hertz => Compliance::Hertz,
                    model::Compliance::HuntCrossley => Compliance::HuntCrossley,
                    model::Compliance::Layer => Compliance::Layer,
                }),
                has_friction: contact.has_friction,
                is_rolling_resistance: contact.is_rolling_resistance,
                is_second_tangent: contact.is_second_tangent,
                has_face: contact.has_face,
            })
    }

    fn guides(&self) -> usize {
        self.program.sizes().guides
    }

    fn single_contacts(&self) -> Option<&[bool]> {
        self.gap_arguments.as_deref()
    }

    fn of_contacts(
        &self,
        quantity: ContactQuantity,
        which: &[usize],
        (t, q, v): (f64, &Vec<f64>, &Vec<f64>),
        numbers: &mut [f64],
    ) {
        if let Some(parts) = &self.contact_parts {
            parts.lock().write(quantity, which, (t, q, v), numbers);
        }
    }

    fn least_gaps(&self, t: [f64; 2], q: [&Vec<f64>; 2], least: &mut [f64]) {
        if self.contact_parts.is_none() {
            return least.fill(f64::NEG_INFINITY);
        }
        let [low, high] = q;
        let q: Vec<Interval> = (low.iter().zip(high))
            .map(|(low, high)| Interval::new(*low, *high))
            .collect();
        let mut gaps = vec![Interval::UNKNOWN; least.len()];
        let arguments = Arguments {
            t: Interval::new(t[0], t[1]),
            q: &q,
            v: &[],
            u: &[],
            a: &[],
        };
        // Gaps do not divide by a pivot.
        let _ = self
            .enclosing()
            .as_mut()
            .map(|enclosing| enclosing.call(Role::Gaps, arguments, &mut gaps));
        for (least, gap) in least.iter_mut().zip(gaps) {
            *least = gap.lo();
        }
    }

    fn kept_at_start(&self) -> impl ExactSizeIterator<Item = &str> {
        self.program.kept.iter().map(String::as_str)
    }

    fn slip_ranges(&self, t: f64, q: &Vec<f64>, v: &Vec<f64>, ranges: &mut [[f64; 2]]) {
        let mut slips = vec![Interval::UNKNOWN; ranges.len()];
        let arguments = Arguments {
            t: rounded(t),
            q: &rounded_each(q),
            v: &rounded_each(v),
            u: &[],
            a: &[],
        };
        // Slips do not divide by a pivot.
        let _ = self
            .enclosing()
            .as_mut()
            .map(|enclosing| enclosing.call(Role::Slips, arguments, &mut slips));
        for (range, slip) in ranges.iter_mut().zip(slips) {
            *range = [slip.lo(), slip.hi()];
        }
    }

    fn friction(
        &self,
        t: f64,
        q: &Vec<f64>,
        v: &Vec<f64>,
        u: &Named,
        parts: &mut [f64],
    ) -> Result<(), Singular> {
        self.call(Role::Friction, at(t, q, v, &u.values), parts)
    }
}
