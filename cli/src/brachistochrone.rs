//! `lagrangian brachistochrone`: the fastest motion from rest at one place to another.

mod figures;
mod problem;

use std::f64::consts::{PI, TAU};
use std::time::Instant;

use lagrangian::brachistochrone::{Brachistochrone, Lapse, Moment, Problem};
use lagrangian::interpreted::{InterpretedMachine, Named};
use lagrangian::{Machine, System};
use lagrangian_symbolic::Dag;
use serde_json::{Map, Value, json};

use crate::call::{self, Assignment};
use crate::failure::Failure;
use crate::output;
use crate::reading::{self, Reading};
use crate::recording::{Column, Kind, Recording};
use crate::simulate::shortest;
use crate::table;

/// The motion is told at so many moments after the start, after equal parts of the turn of its direction.
const MOMENTS: u32 = 200;

/// What was found, and what it is told in.
pub struct Found {
    motion: Brachistochrone,
    moments: Vec<Moment>,
    /// ε of (30), in rad, at each moment; of two coordinates.
    angles: Option<Vec<f64>>,
    names: Vec<String>,
    units: Vec<String>,
    seconds: f64,
}

/// Runs the command.
///
/// # Errors
/// If the spec or the call is at fault, the machine does not meet the conditions, or there is no fastest motion.
pub fn run(call: &call::Brachistochrone) -> Result<(), Failure> {
    let dag = Dag::new();
    let compiled = Reading::open(&call.spec)?.compile(&dag)?;
    let start = call::Start {
        parameters: call.parameters.clone(),
        coordinates: Vec::new(),
        rates: Vec::new(),
    };
    let machine = reading::machine(compiled.program.clone(), &start)?;
    machine.check_parameters().map_err(|missing| {
        Failure::Run(format!(
            "{missing}; set them with --set {}=…",
            missing.names.join("=… --set ")
        ))
    })?;
    let problem = problem::problem(&compiled, &machine)?;
    let [from, to] = ends(call, &machine, &problem)?;
    let names: Vec<String> = machine
        .start()
        .q
        .iter()
        .map(|(name, _)| name.to_owned())
        .collect();
    let clock = Instant::now();
    let motion = problem
        .solve(&from, &to)
        .map_err(|unsolved| Failure::Run(problem::explained(&unsolved, &names)))?;
    let seconds = clock.elapsed().as_secs_f64();
    let moments: Vec<Moment> = (0..=MOMENTS)
        .map(|k| motion.after_part(f64::from(k) / f64::from(MOMENTS)))
        .collect();
    let system = machine.prepare();
    let units = system.coordinates().map(|q| q.unit.to_owned()).collect();
    let angles = (names.len() == 2).then(|| angles(&motion, &moments));
    let found = Found {
        motion,
        moments,
        angles,
        names,
        units,
        seconds,
    };
    let failed = |path: &std::path::Path, error: String| {
        Failure::Call(format!("cannot write {}: {error}", path.display()))
    };
    if let Some(path) = &call.out {
        table::write(&found.recording(), path).map_err(|error| failed(path, error.to_string()))?;
    }
    if let Some(path) = &call.plot {
        let drawn = figures::svg(machine.name(), &found)
            .and_then(|text| std::fs::write(path, text).map_err(|error| error.to_string()));
        drawn.map_err(|error| failed(path, error))?;
    }
    match call.spec.json {
        true => output::line(format_args!("{:#}", found.document())),
        false => found.print(machine.name()),
    }
    Ok(())
}

/// Start and end in the machine's coordinates.
fn ends(
    call: &call::Brachistochrone,
    machine: &InterpretedMachine,
    problem: &Problem,
) -> Result<[Vec<f64>; 2], Failure> {
    let mut values: Named = machine.start().q;
    if call.natural {
        values.values = problem.to_normal(&values.values);
    }
    let mut place = |assignments: &[Assignment]| -> Result<Vec<f64>, Failure> {
        for set in assignments {
            values
                .set(&set.name, set.value)
                .map_err(|unknown| reading::name_error("coordinate", &unknown))?;
        }
        Ok(match call.natural {
            true => problem.from_normal(&values.values),
            false => values.values.clone(),
        })
    };
    Ok([place(&call.from)?, place(&call.to)?])
}

/// ε at each moment, without jumps, the first from −π to π.
fn angles(motion: &Brachistochrone, moments: &[Moment]) -> Vec<f64> {
    let mut before = 0.0;
    let angle = |moment: &Moment| {
        let e = motion.problem().to_normal(&moment.direction);
        let angle = e[1].atan2(e[0]);
        before = angle + ((before - angle) / TAU).round() * TAU;
        before
    };
    moments.iter().map(angle).collect()
}

impl Found {
    /// The constants C* of (22), in normal coordinates.
    fn constants(&self) -> Vec<f64> {
        let c = self.motion.constants();
        let columns = self.motion.problem().normal_coordinates();
        let along = |k: &Vec<f64>| k.iter().zip(&c).map(|(k, c)| k * c).sum();
        columns.iter().map(along).collect()
    }

    /// What the guides do that Coulomb's law does not allow, and what may be better than this.
    fn warnings(&self) -> Vec<String> {
        let told = |lapse: &Lapse| match lapse.backwards {
            true => format!(
                "`{}` slides backwards from t = {} s: friction was taken to act against its `direction`",
                lapse.guide,
                shortest(lapse.time)
            ),
            false => format!(
                "the normal reaction of `{}` is negative from t = {} s, {:.6} N at least: it would have to pull",
                lapse.guide,
                shortest(lapse.time),
                lapse.least
            ),
        };
        self.motion.lapses().iter().map(told).collect()
    }

    fn by_name(&self, values: &[f64]) -> Value {
        let values = values.iter().map(|x| x + 0.0); // No −0 for who stands still.
        let pairs = self.names.iter().zip(values);
        pairs
            .map(|(name, x)| (name.clone(), json!(x)))
            .collect::<Map<_, _>>()
            .into()
    }

    fn document(&self) -> Value {
        let [less, more] = self.motion.best_among_turns();
        let mut parameters = Map::new();
        parameters.insert("kappa".into(), json!(self.motion.kappa()));
        parameters.insert("turn".into(), json!(self.motion.turn()));
        parameters.insert("best_among_turns".into(), json!([less, more]));
        if let Some(angles) = &self.angles {
            parameters.insert("epsilon_start".into(), json!(angles[0]));
            parameters.insert("epsilon_end".into(), json!(angles[angles.len() - 1]));
        }
        for (k, c) in self.constants().iter().enumerate() {
            parameters.insert(format!("C{}", k + 1), json!(c));
        }
        let path: Vec<Value> = (0..self.moments.len()).map(|k| self.moment(k)).collect();
        json!({
            "time": self.motion.time(),
            "parameters": parameters,
            "start": path[0],
            "end": path[path.len() - 1],
            "path": path,
            "warnings": self.warnings(),
            "seconds": self.seconds,
        })
    }

    fn moment(&self, index: usize) -> Value {
        let moment = &self.moments[index];
        let mut document = json!({
            "t": moment.time,
            "q": self.by_name(&moment.q),
            "v": self.by_name(&moment.v),
            "a": self.by_name(&moment.a),
            "control": self.by_name(&moment.control),
            "friction_power": moment.friction_power + 0.0,
            "multiplier": moment.multiplier,
        });
        let guides = self.motion.problem().guides().iter().zip(&moment.contacts);
        let reactions: Map<String, Value> = guides
            .map(|(guide, contact)| (guide.name.clone(), json!(contact.reaction)))
            .collect();
        if let Some(fields) = document.as_object_mut() {
            fields.insert("reactions".into(), reactions.into());
            if let Some(angles) = &self.angles {
                fields.insert("epsilon".into(), json!(angles[index]));
            }
        }
        document
    }

    /// One row for each moment.
    fn recording(&self) -> Recording {
        let column = |name: String, unit: String, kind, value: &dyn Fn(usize) -> f64| Column {
            name,
            unit,
            kind,
            values: (0..self.moments.len()).map(value).collect(),
        };
        let mut columns = Vec::new();
        let named = || self.names.iter().zip(&self.units).enumerate();
        for (i, (name, unit)) in named() {
            columns.push(column(name.clone(), unit.clone(), Kind::Coordinate, &|k| {
                self.moments[k].q[i]
            }));
        }
        for (i, (name, unit)) in named() {
            let unit = if unit == "1" {
                "1/s".into()
            } else {
                format!("{unit}/s")
            };
            columns.push(column(format!("der({name})"), unit, Kind::Rate, &|k| {
                self.moments[k].v[i]
            }));
        }
        for (i, (name, unit)) in named() {
            let unit = if unit == "m" {
                "N".into()
            } else {
                format!("J/{unit}")
            };
            columns.push(column(
                format!("control {name}"),
                unit,
                Kind::Output,
                &|k| self.moments[k].control[i],
            ));
        }
        for (i, guide) in self.motion.problem().guides().iter().enumerate() {
            let name = format!("reaction {}", guide.name);
            columns.push(column(name, "N".into(), Kind::Output, &|k| {
                self.moments[k].contacts[i].reaction
            }));
        }
        columns.push(column(
            "friction power".into(),
            "W".into(),
            Kind::Output,
            &|k| self.moments[k].friction_power,
        ));
        if let Some(angles) = &self.angles {
            columns.push(column("epsilon".into(), "rad".into(), Kind::Output, &|k| {
                angles[k]
            }));
        }
        Recording {
            times: self.moments.iter().map(|moment| moment.time).collect(),
            columns,
        }
    }

    fn print(&self, machine: &str) {
        let motion = &self.motion;
        output::line(format_args!(
            "{machine}: {} s is the least time",
            shortest(motion.time())
        ));
        output::line(format_args!("  found in {:.1} µs", 1e6 * self.seconds));
        let width = self
            .names
            .iter()
            .map(|name| name.chars().count())
            .max()
            .unwrap_or(0);
        let ends = [("from", 0), ("to", self.moments.len() - 1)];
        for (what, index) in ends {
            output::line(format_args!("  {what}"));
            let moment = &self.moments[index];
            for (i, name) in self.names.iter().enumerate() {
                let pad = " ".repeat(width - name.chars().count());
                output::line(format_args!(
                    "    {name}{pad} = {:<24} der({name}){pad} = {}",
                    shortest(moment.q[i]),
                    shortest(moment.v[i] + 0.0)
                ));
            }
        }
        if let Some(angles) = &self.angles {
            output::line(format_args!(
                "  direction in normal coordinates: from ε = {} to {} rad",
                shortest(angles[0]),
                shortest(angles[angles.len() - 1])
            ));
        }
        let constants: Vec<String> = self.constants().iter().map(|c| shortest(*c)).collect();
        output::line(format_args!(
            "  constants of Euler's equations: {}",
            constants.join(", ")
        ));
        let least = |value: &dyn Fn(&Moment) -> f64| {
            self.moments.iter().map(value).fold(f64::INFINITY, f64::min)
        };
        for (i, guide) in motion.problem().guides().iter().enumerate() {
            let reaction = least(&|moment| moment.contacts[i].reaction);
            output::line(format_args!(
                "  normal reaction of {}: {reaction:.6} N at least",
                guide.name
            ));
        }
        let [less, more] = motion.best_among_turns();
        if less > -PI || more < PI {
            output::line(format_args!(
                "  better than with sudden turns between {:.1}° and {:.1}°; beyond, friction saved in turning would pay",
                less.to_degrees(),
                more.to_degrees()
            ));
        }
        for warning in self.warnings() {
            output::line(format_args!("  warning: {warning}"));
        }
    }
}
