//! The fitted numbers as a variant of the spec, which every command and the macro accepts.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use lagrangian::{Machine, System};
use lagrangian_fit::motion::Subject;
use lagrangian_program::Slot;
use lagrangian_spec::unit::{self, state_of};

use super::Fitted;
use crate::failure::Failure;
use crate::numbers::shortest;
use crate::output::Destination;

/// The declarations of a variant, by section.
#[derive(Default)]
struct Lines {
    parameters: String,
    inputs: String,
    coordinates: String,
    states: String,
}

impl Lines {
    /// The start of a coordinate, or of its rate, or of a state, whose integral is the coordinate. Writing to a String cannot fail.
    fn start(&mut self, coordinate: &Slot, is_rate: bool, value: f64, remark: &str) {
        let (name, unit) = (coordinate.name.to_string(), &coordinate.unit_text);
        let (remark, value) = (format!("        /// {remark}\n"), shortest(value));
        let _ = match (state_of(&name), is_rate) {
            (Some(state), true) => {
                let unit = unit::rate_unit(&name, unit);
                writeln!(self.states, "{remark}        {state}: {unit} = {value},")
            }
            (Some(_), false) => Ok(()),
            (None, true) => {
                let unit = match unit.as_str() {
                    "1" => "1/s".to_owned(),
                    unit => format!("({unit})/s"),
                };
                writeln!(self.coordinates, "        der({name}): {unit} = {value},")
            }
            (None, false) => {
                writeln!(
                    self.coordinates,
                    "{remark}        {name}: {unit} = {value},"
                )
            }
        };
    }

    fn value(lines: &mut String, slot: &Slot, value: f64, remark: &str) {
        let (name, unit, value) = (&slot.name, &slot.unit_text, shortest(value));
        let _ = writeln!(
            lines,
            "        /// {remark}\n        {name}: {unit} = {value},"
        );
    }

    /// The values that the call sets and does not fit, with which the fitted values are determined. Of several experiments these
    /// are the values of parameters that all of them share.
    fn held(&mut self, result: &Fitted<'_, '_>) {
        const REMARK: &str = "Set in the call of the fit.";
        let program = result.machine.program();
        let sought = |slot: &Slot| {
            let name = slot.name.to_string();
            result.fit.sought.iter().any(|one| one.name == name)
        };
        let only = match result.given {
            [only] => Some(only),
            _ => None,
        };
        let own = |name: &str| {
            let mut own = result.given.iter().flat_map(|given| &given.sets);
            only.is_none() && own.any(|set| is_of(name, &set.name))
        };
        let is_set = |slot: &Slot| {
            let name = slot.name.to_string();
            let alone = only.into_iter().flat_map(|given| &given.sets);
            let mut sets = result.call.start.parameters.iter().chain(alone);
            sets.any(|set| is_of(&name, &set.name)) && !own(&name) && !sought(slot)
        };
        let machine = match result.fit.experiments.as_slice() {
            [only] => &only.machine,
            _ => result.machine,
        };
        let values = program.parameters.iter().zip(machine.parameter_values());
        for (slot, value) in values.filter(|(slot, _)| is_set(slot)) {
            Lines::value(&mut self.parameters, slot, *value, REMARK);
        }
        let values = machine.prepare().default_inputs().values;
        let values = program.inputs.iter().zip(values);
        for (slot, value) in values.filter(|(slot, _)| is_set(slot)) {
            Lines::value(&mut self.inputs, slot, value, REMARK);
        }
        let [experiment] = result.fit.experiments.as_slice() else {
            return;
        };
        let is_sought = |level: usize, place: usize| {
            let mut all = result.fit.sought.iter();
            all.any(|one| match one.subject {
                Subject::Start(_, other) => level == 0 && other == place,
                Subject::Rate(_, other) => level == 1 && other == place,
                Subject::Parameter(_) => false,
            })
        };
        for (level, starts) in experiment.start.iter().enumerate() {
            for (place, start) in starts.iter().enumerate() {
                if let (Some(value), false) = (start, is_sought(level, place)) {
                    self.start(&program.coordinates[place], level == 1, *value, REMARK);
                }
            }
        }
    }
}

/// Whether a name is the same as another, or that of a member of the family with the other name.
fn is_of(name: &str, other: &str) -> bool {
    let rest = name.strip_prefix(other);
    rest.is_some_and(|rest| rest.is_empty() || rest.starts_with('['))
}

/// The text of the variant.
///
/// # Errors
/// If the spec can no longer be found.
pub fn spec(result: &Fitted<'_, '_>, file: &Destination) -> Result<String, Failure> {
    let program = result.machine.program();
    let minimum = &result.found.minimum;
    let mut lines = Lines::default();
    let several = result.given.len() > 1;
    let mut left = Vec::new();
    for (j, (one, x)) in result.fit.sought.iter().zip(&minimum.x).enumerate() {
        let remark = match result.found.statistics.standard_error(j) {
            Some(error) => format!("Fitted, with a standard error of {}.", shortest(error)),
            None => "Not determined by the measurements.".to_owned(),
        };
        match one.subject {
            Subject::Parameter(index) => {
                let slot = &program.parameters[index];
                Lines::value(&mut lines.parameters, slot, *x, &remark);
            }
            Subject::Start(..) | Subject::Rate(..) if several => left.push(one.name.clone()),
            Subject::Start(_, place) => {
                lines.start(&program.coordinates[place], false, *x, &remark);
            }
            Subject::Rate(_, place) => {
                lines.start(&program.coordinates[place], true, *x, &remark);
            }
        }
    }
    lines.held(result);
    let files: Vec<&str> = result
        .given
        .iter()
        .map(|given| given.label.as_str())
        .collect();
    let base = relative(&result.call.spec.path, file.file())?;
    let base = base.replace('\\', "\\\\").replace('"', "\\\"");
    let mut text = format!("/// Fitted to {} by `lagrangian fit`.\n", files.join(", "));
    if !left.is_empty() {
        let _ = writeln!(
            text,
            "/// Each experiment has its own start: {} are not part of this variant.",
            left.join(", ")
        );
    }
    let name = result.machine.name();
    let _ = writeln!(text, "machine {name}Fitted extends \"{base}\" {{");
    for (name, value) in &result.call.spec.constants {
        // A derived parameter that was fitted becomes a parameter with this value.
        let mut known = program.parameters.iter();
        let known = known.find(|slot| slot.name.to_string() == *name);
        if let Some(slot) = known {
            let unit = &slot.unit_text;
            let _ = writeln!(text, "    parameters {{ {name}: {unit} = {value} }}");
            continue;
        }
        let _ = writeln!(text, "    constants {{ {name} = {value} }}");
    }
    for (section, lines) in [
        ("parameters", &lines.parameters),
        ("inputs", &lines.inputs),
        ("coordinates", &lines.coordinates),
        ("states", &lines.states),
    ] {
        if !lines.is_empty() {
            let _ = write!(text, "    {section} {{\n{lines}    }}\n");
        }
    }
    text.push_str("}\n");
    Ok(text)
}

/// The relative path of a spec from the folder of a file.
fn relative(spec: &Path, file: Option<&Path>) -> Result<String, Failure> {
    let canonical = |path: &Path| {
        path.canonicalize()
            .map_err(|error| Failure::Run(format!("cannot find {}: {error}", path.display())))
    };
    let spec_path = canonical(spec)?;
    let Some(folder) = file.and_then(Path::parent) else {
        return Ok(spec_path.to_string_lossy().into_owned());
    };
    let folder = if folder.as_os_str().is_empty() {
        PathBuf::from(".")
    } else {
        folder.to_owned()
    };
    let folder = canonical(&folder)?;
    let (from, to): (Vec<_>, Vec<_>) = (
        folder.components().collect(),
        spec_path.components().collect(),
    );
    let shared = from.iter().zip(&to).take_while(|(a, b)| a == b).count();
    if shared == 0 {
        return Ok(spec_path.to_string_lossy().into_owned());
    }
    let up = from[shared..].iter().map(|_| "..".to_owned());
    let down = to[shared..]
        .iter()
        .map(|part| part.as_os_str().to_string_lossy().into_owned());
    Ok(up.chain(down).collect::<Vec<_>>().join("/"))
}
