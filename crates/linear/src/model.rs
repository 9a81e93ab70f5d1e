//! The linear model of a machine, `ẋ = A x + B u`, `y = C x + D u`, about a steady motion or about any state.
//!
//! In the form of (E39) the coordinates of a machine are z, which may be displaced freely, and its rates are s, those of the
//! independent ones among z. Together they are a chart of the states that the constraints allow, and x is a deviation in this
//! chart; without constraints it holds all coordinates, then all rates. With `ż = v_z(q, s)`, `ṡ = (Tᵀ M T)⁻¹ r`, accelerations
//! `a = a° + T ṡ`, and multipliers from the rows of D of `M a = f + Gᵀ λ`, the matrices are
//!
//! ```text
//! A = ∂(ż, ṡ)/∂(z, s),  B = ∂(ż, ṡ)/∂u,  C = ∂y/∂(z, s),  D = ∂y/∂u,                (E54)
//! ```
//!
//! computed column by column over dual numbers of 32 digits. Entries within the effect of rounding in parameters,
//! state and inputs are set to 0.

mod smooth;

use lagrangian::interpreted::{InterpretedMachine, InterpretedSystem};
use lagrangian::{Machine, System};
use lagrangian_scalar::{DoubleDouble, Dual, Scalar};
use lagrangian_units::{rate_unit, state_of};
use nalgebra::DMatrix;

use crate::motion::{self, SteadyMotion};
use crate::reduced::{Choice, ContactFault, Fault, Number, Reduced, ReducedState, solve};
use crate::steady::{Options, states};
use smooth::smooth;

/// A quantity that a model may have as an output, by its index.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Observed {
    /// An output of the spec.
    Output(usize),
    /// A coordinate.
    Coordinate(usize),
    /// Its rate.
    Rate(usize),
    /// Its acceleration.
    Acceleration(usize),
    /// The multiplier of a constraint.
    Multiplier(usize),
}

/// The inputs and outputs of the model to be made.
#[derive(Clone, Debug)]
pub struct Request {
    /// The indices of inputs, in the order of the columns of B and D.
    pub inputs: Vec<usize>,
    /// Outputs, in the order of the rows of C and D.
    pub outputs: Vec<Observed>,
}

/// The name of a number and its unit.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Label {
    /// Its name: `phi`, `der(phi)`, `der(phi,2)`, `multiplier(rod)`, or that of an output or an input.
    pub name: String,
    /// Its unit.
    pub unit: String,
}

/// A linear model of r states, m inputs and p outputs.
#[derive(Clone, Debug)]
pub struct LinearModel {
    /// The coordinates at the operating point.
    pub q: Vec<f64>,
    /// The rates there.
    pub v: Vec<f64>,
    /// All inputs of the machine there.
    pub u: Vec<f64>,
    /// The outputs there.
    pub y: Vec<f64>,
    /// The labels of the states: coordinates, then rates.
    pub states: Vec<Label>,
    /// The labels of the inputs.
    pub inputs: Vec<Label>,
    /// The labels of the outputs.
    pub outputs: Vec<Label>,
    /// A, r × r.
    pub a: DMatrix<f64>,
    /// B, r × m.
    pub b: DMatrix<f64>,
    /// C, p × r.
    pub c: DMatrix<f64>,
    /// D, p × m.
    pub d: DMatrix<f64>,
    /// ẋ where x and the changes of inputs are 0; zero about an equilibrium or along a steady motion.
    pub drift: Vec<f64>,
    /// The change of all coordinates, then all rates, with x, 2n × r.
    pub basis: DMatrix<f64>,
    /// Whether there are fewer states than coordinates and rates.
    pub is_reduced: bool,
    /// Coordinates that only record how far the machine has moved, and are no states.
    pub records: Vec<String>,
    /// Bounds on the effect of rounding on each entry of A.
    pub a_bounds: DMatrix<f64>,
}

/// Why there is no model.
#[derive(Clone, Debug)]
pub enum NoModel {
    /// The equations cannot be evaluated.
    Fault(Fault),
    /// The requested multiplier, by its index, is not unique because its constraint follows from others.
    Multiplier(usize),
    /// The equations have a corner or a jump at the state; names the coordinate or rate if a single one causes it.
    Kink(Option<String>),
    /// This output has a corner or a jump at the state.
    OutputKink(String),
    /// This contact is closed, or about to close or open, and has no linearization.
    Contact(String, ContactFault),
    /// The effect of this input changes along the steady motion; names the input, and what moves.
    InputTurns(String, Moving),
    /// The gains of this output change along the steady motion; names the output, and what moves.
    OutputTurns(String, Moving),
}

/// What changes along a steady motion.
#[derive(Clone, Debug)]
pub enum Moving {
    /// A coordinate.
    Coordinate(String),
    /// The time, on which the equations depend.
    Time,
}

impl NoModel {
    /// The reason in one sentence.
    pub fn in_words(&self, system: &InterpretedSystem, options: Options) -> String {
        let turns = |what: &str, name: &str, moving: &Moving| {
            let when = match moving {
                Moving::Coordinate(coordinate) => format!("as `{coordinate}` moves"),
                Moving::Time => "with time".to_owned(),
            };
            format!(
                "the part of the {what} `{name}` in the model changes {when}, so that the model would not have constant coefficients; \
                 leave it out, or linearize about the start alone"
            )
        };
        let coordinate = |j: usize| {
            let coordinate = system.coordinates().nth(j);
            coordinate.map_or_else(|| "?".to_owned(), |coordinate| coordinate.name.to_owned())
        };
        let start = options.start;
        match self {
            NoModel::Fault(Fault::Singular(j)) => format!(
                "the mass matrix is singular in `{}` there; {start} sets another state",
                coordinate(*j)
            ),
            NoModel::Fault(Fault::NotFinite(j)) => format!(
                "the acceleration of `{}`, or a derivative of it, is not finite there; {start} sets another state",
                coordinate(*j)
            ),
            NoModel::Fault(fault) => fault.in_words(system, options),
            NoModel::Multiplier(k) => {
                let name = system.constraints().nth(*k);
                let name = name.map_or_else(|| "?".to_owned(), |c| c.name.to_owned());
                format!(
                    "`multiplier({name})` is not unique: some constraints follow from others here"
                )
            }
            NoModel::Kink(name) => {
                let place = name
                    .as_ref()
                    .map_or_else(String::new, |name| format!(" in `{name}`"));
                format!(
                    "the equations of motion have a corner or a jump{place} there, as friction has where it changes sign (`abs`, \
                     `sign`, `min` or `max`), and so have no linearization; make them smooth, or choose another state with {start}"
                )
            }
            NoModel::OutputKink(name) => format!(
                "the output `{name}` has a corner or a jump there (`abs`, `sign`, `min` or `max`), and so has no linearization; leave it out"
            ),
            NoModel::Contact(name, fault) => fault.in_words(name, start),
            NoModel::InputTurns(name, moving) => turns("input", name, moving),
            NoModel::OutputTurns(name, moving) => turns("output", name, moving),
        }
    }
}

impl From<Fault> for NoModel {
    fn from(fault: Fault) -> NoModel {
        NoModel::Fault(fault)
    }
}

/// The operating point of a model.
struct At<'a> {
    choice: &'a Choice,
    place: &'a ReducedState,
    /// Coordinates that are no states.
    records: &'a [bool],
}

/// All matrices at a state.
#[derive(Clone)]
struct Matrices {
    a: DMatrix<f64>,
    b: DMatrix<f64>,
    c: DMatrix<f64>,
    d: DMatrix<f64>,
    basis: DMatrix<f64>,
    drift: DMatrix<f64>,
    y: DMatrix<f64>,
}

impl Matrices {
    fn each(&self) -> [&DMatrix<f64>; 7] {
        let Matrices {
            a,
            b,
            c,
            d,
            basis,
            drift,
            y,
        } = self;
        [a, b, c, d, basis, drift, y]
    }

    fn each_mut(&mut self) -> [&mut DMatrix<f64>; 7] {
        let Matrices {
            a,
            b,
            c,
            d,
            basis,
            drift,
            y,
        } = self;
        [a, b, c, d, basis, drift, y]
    }
}

/// Safety factor on the observed effect of rounding.
const SAFETY: f64 = 4.0;

/// Times at which a model must be the same, in s.
const TIMES: [f64; 3] = [0.37, 1.13, 29.7];

/// The model about an equilibrium, or along a steady motion.
///
/// # Errors
/// Why there is no model.
pub fn along(
    machine: &InterpretedMachine,
    motion: &SteadyMotion,
    request: &Request,
) -> Result<LinearModel, NoModel> {
    let system = machine.prepare();
    let inputs = system.default_inputs().values;
    let found = &motion.found;
    let q = found.place.q();
    let near = states(&q, &motion.v);
    let mut reduced = Reduced::new(machine, &system, &inputs, &near).with_contacts(&near);
    let at = At {
        choice: &found.choice,
        place: &found.place,
        records: &motion.records,
    };
    let named_request = NamedRequest::new(machine, &system, request, at.choice)?;
    check_contacts(&mut reduced, &at, &motion.v)?;
    smooth(&mut reduced, &named_request, &at)?;
    let (mut here, bounds) = without_roundoff(&mut reduced, &named_request, &at)?;
    goes_on(
        &mut reduced,
        &named_request,
        &at,
        (&here, &bounds),
        &motion.v,
    )?;
    // x is the deviation from the steady motion, so the rates of that motion are no drift of the coordinates.
    here.drift.rows_mut(0, at.places().len()).fill(0.0);
    let v = motion.v.clone();
    Ok(named_request.model(&at, here, bounds, (q, v, inputs)))
}

/// Checks that the equations of motion can be linearized along a motion, and so that it has modes.
///
/// # Errors
/// If a term of the equations has a corner or a jump there.
pub fn check_smooth(machine: &InterpretedMachine, motion: &SteadyMotion) -> Result<(), NoModel> {
    let system = machine.prepare();
    let inputs = system.default_inputs().values;
    let found = &motion.found;
    let near = states(&found.place.q(), &motion.v);
    let mut reduced = Reduced::new(machine, &system, &inputs, &near).with_contacts(&near);
    let at = At {
        choice: &found.choice,
        place: &found.place,
        records: &motion.records,
    };
    let nothing = Request {
        inputs: Vec::new(),
        outputs: Vec::new(),
    };
    let named_request = NamedRequest::new(machine, &system, &nothing, at.choice)?;
    check_contacts(&mut reduced, &at, &motion.v)?;
    smooth(&mut reduced, &named_request, &at)
}

/// The model about any state, at a time. With constraints the coordinates are first projected onto them.
///
/// # Errors
/// Why there is no model.
pub fn about(
    machine: &InterpretedMachine,
    (t, q, v): (f64, &[f64], &[f64]),
    request: &Request,
) -> Result<LinearModel, NoModel> {
    let system = machine.prepare();
    let inputs = system.default_inputs().values;
    let near = states(q, v);
    let mut reduced = Reduced::new(machine, &system, &inputs, &near).with_contacts(&near);
    reduced.set_time(t);
    let mut wide: Vec<DoubleDouble> = q.iter().map(|x| (*x).into()).collect();
    reduced.project(&mut wide, &|_| true)?;
    let near: Vec<f64> = wide.iter().map(|x| x.hi()).collect();
    let n = near.len();
    reduced.check_independence(&near)?;
    let choice = reduced.choose(&near, &vec![false; n])?;
    let place = ReducedState {
        s: choice.independent.iter().map(|j| v[*j].into()).collect(),
        q: wide,
    };
    let records = reduced.integrals();
    let at = At {
        choice: &choice,
        place: &place,
        records: &records,
    };
    let named_request = NamedRequest::new(machine, &system, request, &choice)?;
    check_contacts(&mut reduced, &at, &[])?;
    smooth(&mut reduced, &named_request, &at)?;
    let (here, bounds) = without_roundoff(&mut reduced, &named_request, &at)?;
    let (wide, s) = (constants(&place.q), constants(&place.s));
    let rates = reduced.evaluate(&choice, &wide, &s)?.rates;
    let v = rates.iter().map(|v| v.value.hi()).collect();
    Ok(named_request.model(&at, here, bounds, (near, v, inputs)))
}

/// Checks that contacts are open by a margin, or closed by a margin where they yield, and that they stay so if the machine moves steadily
/// at the rates `steady`.
fn check_contacts(reduced: &mut Reduced<'_>, at: &At<'_>, steady: &[f64]) -> Result<(), NoModel> {
    let (q, s) = (constants(&at.place.q), constants(&at.place.s));
    let rates = reduced.evaluate(at.choice, &q, &s)?.rates;
    if let Some((contact, fault)) = reduced.barred_by(&q, &rates) {
        return Err(NoModel::Contact(reduced.contact_name(contact), fault));
    }
    let moving: Vec<usize> = (at.choice.places().into_iter())
        .filter(|j| steady.get(*j).is_some_and(|v| *v != 0.0))
        .collect();
    let mut places = Vec::new();
    for &j in &moving {
        places.extend(motion::elsewhere(reduced, at.choice, at.place, j));
    }
    if !moving.is_empty() {
        places.push(at.place.clone());
    }
    for there in places {
        let (q, s) = (constants(&there.q), constants(&there.s));
        // Positions at which the equations cannot be evaluated are skipped.
        let Ok(there) = reduced.evaluate(at.choice, &q, &s) else {
            continue;
        };
        if let Some(contact) = reduced.moving_gap(&q, &there.rates) {
            let name = reduced.contact_name(contact);
            return Err(NoModel::Contact(name, ContactFault::Moves));
        }
    }
    Ok(())
}

fn constants(values: &[DoubleDouble]) -> Vec<Number> {
    values.iter().copied().map(Dual::constant).collect()
}

impl At<'_> {
    /// The coordinates that are states, in the order of the spec.
    fn places(&self) -> Vec<usize> {
        let places = self.choice.places().into_iter();
        let mut places: Vec<usize> = places.filter(|j| !self.records[*j]).collect();
        places.sort_unstable();
        places
    }
}

/// A request with the names of its entries.
struct NamedRequest<'a> {
    request: &'a Request,
    coordinates: Vec<Label>,
    inputs: Vec<Label>,
    outputs: Vec<Label>,
    has_multipliers: bool,
}

/// The label of a derivative, with its unit.
fn rate(of: &Label, order: u8) -> Label {
    if let Some(state) = state_of(&of.name) {
        let unit = rate_unit(&of.name, &of.unit);
        return match order {
            1 => Label { name: state, unit },
            _ => rate(&Label { name: state, unit }, order - 1),
        };
    }
    let name = match order {
        1 => format!("der({})", of.name),
        _ => format!("der({},{order})", of.name),
    };
    let per = if order == 1 { "s" } else { "s^2" };
    let unit = match of.unit.as_str() {
        "1" => format!("1/{per}"),
        unit => format!("{unit}/{per}"),
    };
    Label { name, unit }
}

impl<'a> NamedRequest<'a> {
    fn new(
        machine: &InterpretedMachine,
        system: &InterpretedSystem,
        request: &'a Request,
        choice: &Choice,
    ) -> Result<NamedRequest<'a>, NoModel> {
        let coordinates: Vec<Label> = system
            .coordinates()
            .map(|q| Label {
                name: q.name.to_owned(),
                unit: q.unit.to_owned(),
            })
            .collect();
        let program = machine.program();
        let slot = |slot: &lagrangian_program::Slot| Label {
            name: slot.name.to_string(),
            unit: slot.label(),
        };
        let constraints: Vec<String> = system.constraints().map(|c| c.name.to_owned()).collect();
        let mut outputs = Vec::new();
        for observed in &request.outputs {
            outputs.push(match *observed {
                Observed::Output(k) => slot(&program.outputs[k]),
                Observed::Coordinate(j) => coordinates[j].clone(),
                Observed::Rate(j) => rate(&coordinates[j], 1),
                Observed::Acceleration(j) => rate(&coordinates[j], 2),
                Observed::Multiplier(k)
                    if choice.rows.len() < constraints.len() + program.quaternions.len() =>
                {
                    return Err(NoModel::Multiplier(k));
                }
                Observed::Multiplier(k) => Label {
                    name: format!("multiplier({})", constraints[k]),
                    // The unit is that of energy over that of the constraint, and constraints have no unit here.
                    unit: String::new(),
                },
            });
        }
        let inputs = request.inputs.iter();
        let is_multiplier = |o: &Observed| matches!(o, Observed::Multiplier(_));
        Ok(NamedRequest {
            inputs: inputs.map(|k| slot(&program.inputs[*k])).collect(),
            coordinates,
            outputs,
            has_multipliers: request.outputs.iter().any(is_multiplier),
            request,
        })
    }

    fn model(
        self,
        at: &At<'_>,
        matrices: Matrices,
        bounds: Matrices,
        (q, v, u): (Vec<f64>, Vec<f64>, Vec<f64>),
    ) -> LinearModel {
        let places = at.places();
        let names = places.iter().map(|j| self.coordinates[*j].clone());
        let rates = at.choice.independent.iter();
        let rates = rates.map(|j| rate(&self.coordinates[*j], 1));
        let records = self.coordinates.iter().zip(at.records);
        let is_integral = |label: &Label| state_of(&label.name).is_some();
        // The integrals of states of first order are always records, and are not reported as such.
        let records = records.filter(|(label, is_record)| **is_record && !is_integral(label));
        let integrals = self
            .coordinates
            .iter()
            .filter(|label| is_integral(label))
            .count();
        let states: Vec<Label> = names.chain(rates).collect();
        let Matrices {
            a,
            b,
            c,
            d,
            basis,
            drift,
            y,
        } = matrices;
        LinearModel {
            y: y.iter().copied().collect(),
            drift: drift.iter().copied().collect(),
            is_reduced: states.len() + integrals < 2 * q.len(),
            records: records.map(|(label, _)| label.name.clone()).collect(),
            a_bounds: bounds.a,
            inputs: self.inputs,
            outputs: self.outputs,
            states,
            a,
            b,
            c,
            d,
            basis,
            q,
            v,
            u,
        }
    }
}

/// The quantities that depend on states and inputs, over numbers with a derivative.
struct Response {
    rates: Vec<Number>,
    /// ṡ.
    accelerations: Vec<Number>,
    /// a, of all coordinates.
    all: Vec<Number>,
    /// y.
    outputs: Vec<Number>,
}

fn respond(
    reduced: &mut Reduced<'_>,
    named_request: &NamedRequest<'_>,
    choice: &Choice,
    q: &[Number],
    s: &[Number],
) -> Result<Response, Fault> {
    let here = reduced.evaluate(choice, q, s)?;
    let (n, count) = (q.len(), choice.independent.len());
    let sum = |terms: &mut dyn Iterator<Item = Number>| terms.fold(Number::ZERO, |sum, x| sum + x);
    // M T, and Tᵀ M T.
    let carried: Vec<Vec<Number>> = (0..n)
        .map(|i| {
            let column =
                |c: usize| sum(&mut (0..n).map(|j| here.mass[i * n + j] * here.along[j][c]));
            (0..count).map(column).collect()
        })
        .collect();
    let mass = (0..count).map(|r| {
        let entry = |c: usize| sum(&mut (0..n).map(|i| here.along[i][r] * carried[i][c]));
        (0..count).map(entry).collect()
    });
    let forces = here.forces.iter().map(|force| vec![*force]).collect();
    let solved = solve(mass.collect(), forces);
    let solved = solved.map_err(|k| Fault::Singular(choice.independent[k]))?;
    let accelerations: Vec<Number> = solved.into_iter().map(|row| row[0]).collect();
    let finite = |x: &Number| x.value.is_finite() && x.derivative.is_finite();
    if let Some(c) = accelerations.iter().position(|x| !finite(x)) {
        return Err(Fault::NotFinite(choice.independent[c]));
    }
    let all: Vec<Number> = (0..n)
        .map(|i| {
            let free = accelerations.iter().zip(&here.along[i]);
            here.held[i] + sum(&mut free.map(|(a, t)| *a * *t))
        })
        .collect();
    let mut multipliers = Vec::new();
    if named_request.has_multipliers {
        let rows = reduced.constraint_rows(q);
        let dependent: Vec<usize> = choice
            .position_dependent
            .iter()
            .chain(&choice.rate_dependent)
            .copied()
            .collect();
        let matrix = dependent
            .iter()
            .map(|j| choice.rows.iter().map(|k| rows[k * n + j]).collect());
        let left = dependent.iter().map(|&j| {
            let inertia = sum(&mut (0..n).map(|i| here.mass[j * n + i] * all[i]));
            vec![inertia - here.applied[j]]
        });
        let solved = solve(matrix.collect(), left.collect());
        let solved = solved.map_err(|_| Fault::Singular(dependent[0]))?;
        multipliers = vec![Number::ZERO; reduced.constraints()];
        for (k, row) in choice.rows.iter().zip(solved) {
            multipliers[*k] = row[0];
        }
    }
    let outputs = named_request
        .request
        .outputs
        .iter()
        .map(|observed| match *observed {
            Observed::Output(k) => reduced.output(k, (q, &here.rates, &all)),
            Observed::Coordinate(j) => q[j],
            Observed::Rate(j) => here.rates[j],
            Observed::Acceleration(j) => all[j],
            Observed::Multiplier(k) => multipliers[k],
        });
    Ok(Response {
        outputs: outputs.collect(),
        rates: here.rates,
        accelerations,
        all,
    })
}

/// All matrices at a state, with their round-off.
fn matrices(
    reduced: &mut Reduced<'_>,
    named_request: &NamedRequest<'_>,
    at: &At<'_>,
    place: &ReducedState,
) -> Result<Matrices, Fault> {
    let choice = at.choice;
    let (mut q, mut s) = (constants(&place.q), constants(&place.s));
    let tangent = reduced.tangent(choice, &q)?;
    let here = respond(reduced, named_request, choice, &q, &s)?;
    let places = at.places();
    let integrals = reduced.integrals();
    let (n, moving, kept) = (q.len(), s.len(), places.len());
    let states = kept + moving;
    let value = |x: &Number| x.value.hi();
    let drift = places.iter().map(|j| value(&here.rates[*j]));
    let drift = drift.chain(here.accelerations.iter().map(value));
    let outputs = here.outputs.len();
    let mut matrices = Matrices {
        a: DMatrix::zeros(states, states),
        b: DMatrix::zeros(states, named_request.request.inputs.len()),
        c: DMatrix::zeros(outputs, states),
        d: DMatrix::zeros(outputs, named_request.request.inputs.len()),
        basis: DMatrix::zeros(2 * n, states),
        drift: DMatrix::from_iterator(states, 1, drift),
        y: DMatrix::from_iterator(outputs, 1, here.outputs.iter().map(value)),
    };
    let all = choice.places();
    let columns = places
        .iter()
        .filter_map(|j| all.iter().position(|k| k == j));
    for (column, direction) in columns.enumerate() {
        let direction = &tangent[direction];
        for (q, d) in q.iter_mut().zip(direction) {
            q.derivative = *d;
        }
        let there = respond(reduced, named_request, choice, &q, &s)?;
        set_column([&mut matrices.a, &mut matrices.c], column, &places, &there);
        for (i, step) in direction.iter().enumerate() {
            if !at.records[i] {
                matrices.basis[(i, column)] = step.hi();
            }
            if !at.records[i] || integrals[i] {
                matrices.basis[(n + i, column)] = slope(&there.rates[i]);
            }
        }
    }
    q = constants(&place.q);
    for k in 0..moving {
        s[k].derivative = DoubleDouble::ONE;
        let there = respond(reduced, named_request, choice, &q, &s)?;
        s[k].derivative = DoubleDouble::ZERO;
        let column = kept + k;
        set_column([&mut matrices.a, &mut matrices.c], column, &places, &there);
        for i in (0..n).filter(|i| !at.records[*i] || integrals[*i]) {
            matrices.basis[(n + i, column)] = slope(&there.rates[i]);
        }
    }
    for (column, &input) in named_request.request.inputs.iter().enumerate() {
        reduced.inputs_mut()[input].derivative = DoubleDouble::ONE;
        let there = respond(reduced, named_request, choice, &q, &s);
        reduced.inputs_mut()[input].derivative = DoubleDouble::ZERO;
        set_column([&mut matrices.b, &mut matrices.d], column, &places, &there?);
    }
    let numbers = matrices.each().into_iter().flat_map(|m| m.iter());
    if numbers.copied().any(|x| !x.is_finite()) {
        return Err(Fault::NotFinite(places.first().copied().unwrap_or(0)));
    }
    Ok(matrices)
}

fn slope(x: &Number) -> f64 {
    x.derivative.hi()
}

/// Sets a column of two matrices to the derivatives of a response: of the rates of all states, of which these places are the first, and of
/// the outputs.
fn set_column(
    [of_states, of_outputs]: [&mut DMatrix<f64>; 2],
    column: usize,
    places: &[usize],
    response: &Response,
) {
    let rates = places.iter().map(|j| &response.rates[*j]);
    for (i, x) in rates.chain(&response.accelerations).enumerate() {
        of_states[(i, column)] = slope(x);
    }
    for (i, x) in response.outputs.iter().enumerate() {
        of_outputs[(i, column)] = slope(x);
    }
}

/// The matrices, in which entries within round-off are set to 0, and bounds on the effect of rounding on each entry.
fn without_roundoff(
    reduced: &mut Reduced<'_>,
    named_request: &NamedRequest<'_>,
    at: &At<'_>,
) -> Result<(Matrices, Matrices), Fault> {
    let mut here = matrices(reduced, named_request, at, at.place)?;
    let mut bounds = here.clone();
    for matrix in bounds.each_mut() {
        matrix.fill(0.0);
    }
    reduced.rounded(at.place, |reduced, other| {
        let Ok(found) = matrices(reduced, named_request, at, other) else {
            return;
        };
        let pairs = found.each().into_iter().zip(here.each());
        for (bound, (x, y)) in bounds.each_mut().into_iter().zip(pairs) {
            let off = (x - y).abs() * SAFETY;
            bound.zip_apply(&off, |bound, off| *bound = bound.max(off));
        }
    });
    for (matrix, bound) in here.each_mut().into_iter().zip(bounds.each()) {
        matrix.zip_apply(bound, |x, bound| {
            if x.abs() <= bound {
                *x = 0.0;
            }
        });
    }
    Ok((here, bounds))
}

/// Checks that inputs and outputs have the same gains everywhere along a steady motion, and at all times.
fn goes_on(
    reduced: &mut Reduced<'_>,
    named_request: &NamedRequest<'_>,
    at: &At<'_>,
    (here, bounds): (&Matrices, &Matrices),
    v: &[f64],
) -> Result<(), NoModel> {
    let largest = |m: &DMatrix<f64>| m.iter().fold(0.0, |largest: f64, x| largest.max(x.abs()));
    let compare = |there: &Matrices, moving: Moving| {
        let pairs = [
            (&here.b, &there.b, &bounds.b),
            (&here.c, &there.c, &bounds.c),
            (&here.d, &there.d, &bounds.d),
        ];
        for (part, (one, other, bound)) in pairs.into_iter().enumerate() {
            let rounding = motion::SAME * largest(one).max(largest(other));
            let is_other = |row: usize, column: usize| {
                let place = (row, column);
                (one[place] - other[place]).abs() > bound[place].max(rounding)
            };
            let mut places =
                (0..one.nrows()).flat_map(|row| (0..one.ncols()).map(move |c| (row, c)));
            if let Some((row, column)) = places.find(|(row, column)| is_other(*row, *column)) {
                return Err(match part {
                    0 => NoModel::InputTurns(named_request.inputs[column].name.clone(), moving),
                    _ => NoModel::OutputTurns(named_request.outputs[row].name.clone(), moving),
                });
            }
        }
        Ok(())
    };
    let coordinate = |j: usize| Moving::Coordinate(named_request.coordinates[j].name.clone());
    let places = at.choice.places();
    for &j in places.iter().filter(|j| v[**j] != 0.0) {
        for there in motion::elsewhere(reduced, at.choice, at.place, j) {
            // Positions at which the equations cannot be evaluated are skipped.
            if let Ok(there) = matrices(reduced, named_request, at, &there) {
                compare(&there, coordinate(j))?;
            }
        }
    }
    // The gains of an output that depends on a recording coordinate change along the motion.
    let (q, s) = (constants(&at.place.q), constants(&at.place.s));
    let tangent = reduced.tangent(at.choice, &q)?;
    for (column, &j) in places.iter().enumerate().filter(|(_, j)| at.records[**j]) {
        let mut q = q.clone();
        for (q, d) in q.iter_mut().zip(&tangent[column]) {
            q.derivative = *d;
        }
        let there = respond(reduced, named_request, at.choice, &q, &s)?;
        let rounding = motion::SAME * largest(&here.c);
        let mut slopes = there.outputs.iter().map(|y| y.derivative.hi().abs());
        if let Some(k) = slopes.position(|slope| slope > rounding) {
            let name = named_request.outputs[k].name.clone();
            return Err(NoModel::OutputTurns(name, coordinate(j)));
        }
    }
    for time in TIMES {
        reduced.set_time(time);
        let there = matrices(reduced, named_request, at, at.place);
        reduced.set_time(0.0);
        compare(&there?, Moving::Time)?;
    }
    Ok(())
}
