//! `lagrangian evaluate`: quantities at given states.

mod points;

use std::io::Read;

use lagrangian::interpreted::{InterpretedMachine, InterpretedSystem, Named};
use lagrangian::{
    At, ContactForce, Error, Evaluation, Machine, Quantity, Simulation, State, System,
    check_equations, loads_shared_otherwise, penetrations,
};
use lagrangian_spec::model::Model;
use lagrangian_symbolic::Dag;
use lagrangian_units::{integral_name, state_of};
use serde::Serialize;
use serde_json::{Map, Value};

use crate::call;
use crate::collisions;
use crate::contacts;
use crate::diagnostics;
use crate::failure::Failure;
use crate::numbers::{by_name, shortest, states};
use crate::output;
pub use crate::reading::set_start;
use crate::reading::{self, Reading};
use points::{Entry, Numbers, Point};

/// Residuals of constraints up to this, relative to the numbers of the state, are round-off: a thousandth of what the equations of
/// motion are checked to.
const OFF_CONSTRAINTS: f64 = 1e-12;

/// The quantities at a state.
#[derive(Debug, Serialize)]
struct Numbered {
    mass_matrix: Vec<Vec<f64>>,
    bias: Vec<f64>,
    applied: Vec<f64>,
    forces: Vec<f64>,
    accelerations: Vec<f64>,
    /// The rates of states of first order, by name; left out for machines without states.
    #[serde(skip_serializing_if = "Map::is_empty")]
    state_rates: Map<String, Value>,
    /// By the name of the constraint; left out for machines without constraints.
    multipliers: Map<String, Value>,
    /// Generalized reactions of the constraints on each coordinate, Gᵀ λ.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    reactions: Vec<f64>,
    /// Forces in contacts that roll or slide, by name.
    #[serde(skip_serializing_if = "Map::is_empty")]
    contacts: Map<String, Value>,
    kinetic_energy: f64,
    potential_energy: f64,
    dissipation: f64,
    outputs: Map<String, Value>,
    /// Facts that the spec assumes and that do not hold here, rigid contacts that are penetrated, and loads that could not be shared by the rule; left out if
    /// there are none.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    warnings: Vec<String>,
}

/// Runs the command.
///
/// # Errors
/// If the spec is invalid, or the points are not a list of points. An invalid point, or one at which the machine is
/// singular, is reported as a result.
pub fn run(call: &call::Evaluate) -> Result<(), Failure> {
    let dag = Dag::new();
    let compiled = Reading::open(&call.spec)?
        .with_values(&call.start)
        .compile(&dag)?;
    let machine = reading::machine(&compiled, &call.start)?;
    // A wrong name is an error of the call, not of each point.
    let mut start = machine.start();
    set_start(&mut start, &call.start)?;
    reading::check_kept(&start, &call.keep)?;
    let points = match &call.at {
        None => vec![Ok(Point::default())],
        Some(path) => {
            let is_input = path.as_os_str() == "-";
            let name = if is_input {
                "standard input".to_owned()
            } else {
                path.display().to_string()
            };
            let text = if is_input {
                let mut text = String::new();
                std::io::stdin().read_to_string(&mut text).map(|_| text)
            } else {
                std::fs::read_to_string(path)
            };
            let text =
                text.map_err(|error| Failure::Call(format!("cannot read {name}: {error}")))?;
            points::read(&name, &text).map_err(Failure::Call)?
        }
    };
    let results = points.into_iter().map(|point| {
        let result = point.and_then(|point| at(&compiled.model, &machine, call, point));
        result.unwrap_or_else(|error| serde_json::json!({ "error": error }))
    });
    output::line(format_args!("{:#}", Value::Array(results.collect())));
    Ok(())
}

fn at(
    model: &Model<'_>,
    machine: &InterpretedMachine,
    call: &call::Evaluate,
    point: Point,
) -> Result<Value, String> {
    let mut machine = machine.clone();
    let parameters = model.parameters.iter().map(|p| p.name.to_string());
    let parameters: Vec<String> = parameters.collect();
    let inputs = model.inputs.iter().map(|input| input.name.to_string());
    let inputs: Vec<String> = inputs.collect();
    refuse_others(
        &point.parameters,
        ("parameters", "inputs", "an input"),
        &inputs,
    )?;
    refuse_others(
        &point.inputs,
        ("inputs", "parameters", "a parameter"),
        &parameters,
    )?;
    let sets = assignments(&point.parameters, &parameters)?;
    let sets = sets.into_iter().chain(assignments(&point.inputs, &inputs)?);
    for (name, value) in sets {
        machine
            .set(&name, value)
            .map_err(|unknown| format!("not a parameter or an input: {unknown}"))?;
    }
    machine
        .check_parameters()
        .map_err(|missing| missing.to_string())?;
    if !point.parameters.is_empty() {
        diagnostics::check(&model.parameter_diagnostics(machine.parameter_values()))?;
    }
    // The start may depend on parameters, including those of the point.
    let mut state = machine.start();
    set_start(&mut state, &call.start).map_err(|_| "there is no such coordinate")?;
    state.t = point.t.unwrap_or(0.0);
    let integrals = integrals(&state.q);
    fill(&mut state.q, point.q, ("q", false))?;
    fill(&mut state.v, point.v, ("v", false))?;
    if let Some(given) = point.states {
        if !integrals.contains(&true) {
            return Err("the machine has no states of first order".to_owned());
        }
        fill(&mut state.v, Some(given), ("states", true))?;
    }
    if call.keep.names.is_empty() {
        return numbers(&machine.prepare(), &state);
    }
    // A run of length zero only projects its start onto the constraints.
    let simulation = Simulation::new(&machine).until(state.t);
    let run = reading::keep(simulation, &call.keep).run_interpreted(state);
    let state = run.map_err(|error| error.to_string())?.start().clone();
    let mut result = numbers(&machine.prepare(), &state)?;
    for (name, values) in [("q", &state.q), ("v", &state.v)] {
        result[name] = by_name(values);
    }
    if let Some(states) = states(&state.v) {
        result["states"] = states;
    }
    Ok(result)
}

/// What entries set, those of whole families before those of members; `known` are the names that exist.
///
/// # Errors
/// If a list has another length than its family, or belongs to none.
fn assignments(
    entries: &[(String, Entry)],
    known: &[String],
) -> Result<Vec<(String, f64)>, String> {
    let mut sets = Vec::new();
    for (name, entry) in entries {
        let values = match entry {
            Entry::One(value) => {
                sets.push((name.clone(), *value));
                continue;
            }
            Entry::Family(values) => values,
        };
        let is_member = |known: &&String| {
            let index = known.strip_prefix(name.as_str());
            index.is_some_and(|index| index.starts_with('['))
        };
        let members: Vec<&String> = known.iter().filter(is_member).collect();
        if members.is_empty() && !known.contains(name) {
            // Setting it reports that it does not exist, whatever the value.
            sets.push((name.clone(), f64::NAN));
        } else if members.len() == values.len() {
            sets.extend(members.into_iter().cloned().zip(values.iter().copied()));
        } else if members.is_empty() {
            return Err(format!("`{name}` is not a family but one number"));
        } else {
            return Err(format!(
                "`{name}` has {} numbers, and the family has {} members",
                values.len(),
                members.len()
            ));
        }
    }
    sets.sort_by_key(|(name, _)| name.contains('['));
    Ok(sets)
}

/// Refuses names that belong to the other one of two fields.
fn refuse_others(
    entries: &[(String, Entry)],
    (field, other, kind): (&str, &str, &str),
    others: &[String],
) -> Result<(), String> {
    let base = |name: &str| name.split('[').next().map(str::to_owned);
    let misplaced = entries
        .iter()
        .find(|(name, _)| others.iter().any(|other| base(other) == base(name)));
    match misplaced {
        Some((name, _)) => Err(format!(
            "\"{field}\": `{name}` is {kind}, which \"{other}\" sets"
        )),
        None => Ok(()),
    }
}

/// Which coordinates are integrals of states of first order.
fn integrals(coordinates: &Named) -> Vec<bool> {
    let names = coordinates.iter();
    names.map(|(name, _)| state_of(name).is_some()).collect()
}

/// Fills in the values of a point: coordinates, or their rates, which include states of first order.
fn fill(
    numbers: &mut Named,
    given: Option<Numbers>,
    (what, is_states): (&str, bool),
) -> Result<(), String> {
    let integrals = integrals(numbers);
    let places: Vec<usize> = (0..integrals.len())
        .filter(|j| integrals[*j] == is_states)
        .collect();
    match given {
        None => Ok(()),
        Some(Numbers::List(values)) if values.len() == places.len() => {
            for (place, value) in places.into_iter().zip(values) {
                numbers.values[place] = value;
            }
            Ok(())
        }
        Some(Numbers::List(values)) => {
            let counted = |count: usize, word: &str| match count {
                1 => format!("1 {word}"),
                count => format!("{count} {word}s"),
            };
            let of_machine = if is_states { "state" } else { "coordinate" };
            Err(format!(
                "{what} has {}, the machine has {}",
                counted(values.len(), "number"),
                counted(places.len(), of_machine)
            ))
        }
        Some(Numbers::ByName(entries)) => {
            let names = numbers.iter().map(|(name, _)| name);
            let names = names.filter_map(|name| match state_of(name) {
                Some(state) => is_states.then(|| state.to_owned()),
                None => (!is_states).then(|| name.to_owned()),
            });
            let names: Vec<String> = names.collect();
            for (name, value) in assignments(&entries, &names)? {
                let set = if is_states {
                    numbers.set(&integral_name(&name), value)
                } else {
                    numbers.set(&name, value)
                };
                set.map_err(|unknown| {
                    if is_states {
                        format!("no state is named `{name}`")
                    } else {
                        format!("not a coordinate: {unknown}")
                    }
                })?;
            }
            Ok(())
        }
    }
}

fn numbers(system: &InterpretedSystem, state: &State<Named>) -> Result<Value, String> {
    let State { t, q, v } = state;
    let (t, q, v) = (*t, &q.values, &v.values);
    let u = system.default_inputs();
    let n = q.len();
    let evaluated = Evaluation::of(system, At { t, q, v, u: &u });
    let found = evaluated.map_err(|error| Error::of_step(error, system).to_string())?;
    check(system, state, &found)?;
    let mut contacts = contacts::forces(system, &found.multipliers);
    contacts.extend(slips(system, &found.contacts));
    contacts.extend(collisions::forces(system, &found.unilateral));
    check_finite(&found)?;
    // The rows of states of first order come after those of the coordinates; their accelerations are the
    // rates of the states.
    let is_integral = |c: &Quantity<'_>| state_of(c.name).is_some();
    let declared = system.coordinates().filter(|c| !is_integral(c)).count();
    let state_rates = system.coordinates().zip(&found.accelerations);
    let state_rates = state_rates
        .filter_map(|(c, rate)| Some((state_of(c.name)?, Value::from(*rate))))
        .collect();
    let result = Numbered {
        mass_matrix: found
            .mass_matrix
            .chunks(n.max(1))
            .take(declared)
            .map(|row| row[..declared].to_vec())
            .collect(),
        bias: found.bias[..declared].to_vec(),
        applied: found.applied[..declared].to_vec(),
        forces: found.forces[..declared].to_vec(),
        state_rates,
        accelerations: found.accelerations[..declared].to_vec(),
        multipliers: system
            .constraints()
            .zip(found.multipliers)
            .map(|(constraint, value)| (constraint.name.to_owned(), value.into()))
            .collect(),
        reactions: found.reactions.into_iter().take(declared).collect(),
        contacts,
        kinetic_energy: found.kinetic_energy,
        potential_energy: found.potential_energy,
        dissipation: found.dissipation,
        outputs: found
            .outputs
            .iter()
            .map(|(name, value)| (name.to_owned(), value.into()))
            .collect(),
        warnings: ended_assumptions(system, (t, q, v))
            .into_iter()
            .chain(penetrated_contacts(system, (t, q, v)))
            .chain(loads_shared(system, At { t, q, v, u: &u }))
            .collect(),
    };
    serde_json::to_value(result).map_err(|error| error.to_string())
}

/// Checks that the accelerations exist and satisfy the equations of motion.
fn check(
    system: &InterpretedSystem,
    state: &State<Named>,
    found: &Evaluation<Named>,
) -> Result<(), String> {
    let is_closed = found.unilateral.iter().any(|force| force.closed);
    if !found.multipliers.is_empty() && is_closed {
        return Err(
            "the multipliers of constraints where contacts are closed are those of a run".into(),
        );
    }
    let mut accelerations = system.coordinates().zip(&found.accelerations);
    if let Some((coordinate, _)) = accelerations.find(|(_, a)| !a.is_finite()) {
        return Err(format!(
            "the acceleration of `{}` is not finite here",
            coordinate.name
        ));
    }
    let at = At {
        t: state.t,
        q: &state.q.values,
        v: &state.v.values,
        u: &system.default_inputs(),
    };
    check_equations(system, at).map_err(|error| {
        // The program takes a coordinate that a constraint determines from the others, so away from the constraints its
        // accelerations are not those of the point.
        let apart = off_constraints(system, state);
        let is_apart = matches!(error, Error::EquationsViolated { .. });
        apart
            .filter(|_| is_apart)
            .unwrap_or_else(|| error.to_string())
    })
}

/// Checks that all numbers can be written: JSON cannot represent infinity, and null would be read as a missing value.
fn check_finite(found: &Evaluation<Named>) -> Result<(), String> {
    let all: [(&str, &[f64]); 8] = [
        ("mass matrix", &found.mass_matrix),
        ("bias", &found.bias),
        ("generalized force that is applied", &found.applied),
        ("generalized force", &found.forces),
        ("reaction", &found.reactions),
        ("kinetic energy", &[found.kinetic_energy]),
        ("potential energy", &[found.potential_energy]),
        ("dissipation", &[found.dissipation]),
    ];
    for (name, values) in all {
        if let Some(value) = values.iter().find(|value| !value.is_finite()) {
            return Err(format!("the {name} is not finite here: {value}"));
        }
    }
    Ok(())
}

/// The rigid contacts that are penetrated at a state.
fn penetrated_contacts(system: &InterpretedSystem, at: (f64, &Vec<f64>, &Vec<f64>)) -> Vec<String> {
    let names: Vec<&str> = system.unilateral_contacts().map(|of| of.name).collect();
    penetrations(system, at)
        .into_iter()
        .map(|(contact, depth)| {
            format!(
                "the contact `{}` is penetrated by {} m, which a rigid contact cannot be: no run can start here, and its forces are those of a contact \
                 that just touches",
                names[contact],
                shortest(depth)
            )
        })
        .collect()
}

/// That the motion depends on how contacts share their load in a way that could not be computed, if it does.
fn loads_shared(system: &InterpretedSystem, at: At<'_, InterpretedSystem>) -> Option<String> {
    // Where contacts have no forces, their evaluation has said so.
    let contacts = loads_shared_otherwise(system, at).unwrap_or_default();
    let names: Vec<String> = (system.unilateral_contacts().enumerate())
        .filter(|(contact, _)| contacts.contains(contact))
        .map(|(_, of)| format!("`{}`", of.name))
        .collect();
    (!names.is_empty()).then(|| {
        format!(
            "the accelerations depend on how {} share their load: the distribution of equally stiff contacts could not be computed, and another \
             possible one was taken",
            names.join(", ")
        )
    })
}

/// The facts that the spec assumes and that do not hold at a state, with the default inputs: numbers computed from them are
/// meaningless there, as the distance `r` of a polar coordinate is where `r > 0` fails.
pub fn ended_assumptions(
    system: &InterpretedSystem,
    (t, q, v): (f64, &Vec<f64>, &Vec<f64>),
) -> Vec<String> {
    let inputs = system.default_inputs();
    let facts = system.assumptions(t, q, v, &inputs);
    let ended = facts.filter(|fact| !fact.holds());
    ended
        .map(|fact| {
            format!(
                "the machine assumes `{}`, which does not hold here",
                fact.text
            )
        })
        .collect()
}

/// The constraint that a state violates most, if it violates any by more than round-off.
fn off_constraints(system: &InterpretedSystem, state: &State<Named>) -> Option<String> {
    let (q, v) = (&state.q.values, &state.v.values);
    let count = system.constraints().len();
    let (mut positions, mut rates) = (vec![0.0; count], vec![0.0; count]);
    system.constraint_positions(state.t, q, &mut positions);
    system.constraint_rates(state.t, q, v, &mut rates);
    let largest = |values: &[f64]| values.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    let (of_places, of_rates) = (1.0 + largest(q), 1.0 + largest(q) + largest(v));
    let residuals = positions.iter().map(|residual| residual / of_places);
    let residuals = residuals.chain(rates.iter().map(|residual| residual / of_rates));
    let (worst, residual) = residuals
        .enumerate()
        .max_by(|(_, a), (_, b)| a.abs().total_cmp(&b.abs()))?;
    if residual.abs() <= OFF_CONSTRAINTS {
        return None;
    }
    let constraint = system.constraints().nth(worst % count)?;
    let (quantity, residual) = if worst < count {
        ("", positions[worst])
    } else {
        ("the rate of ", rates[worst - count])
    };
    Some(format!(
        "the point is not on the constraints, and its accelerations are those of a machine that is: {quantity}`{}` is off by \
         {residual:e}; with --keep none the point is moved onto them",
        constraint.name
    ))
}

/// Slip, normal reaction and friction of each guided contact, whether sliding or sticking.
fn slips(system: &InterpretedSystem, forces: &[ContactForce]) -> Vec<(String, Value)> {
    let entry = |(name, force): (&str, &ContactForce)| {
        let force = serde_json::json!({
            "slip": force.slip,
            "normal": force.normal,
            "friction": force.friction,
            "sticks": force.sticks,
        });
        (name.to_owned(), force)
    };
    system.contacts().zip(forces).map(entry).collect()
}
