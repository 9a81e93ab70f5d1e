//! The fitted numbers as a variant of the spec, which every command and the macro accepts.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use lagrangian_fit::motion::{Sought, Subject};
use lagrangian_spec::unit::{self, state_of};

use super::{Fitted, findings};
use crate::failure::Failure;
use crate::numbers::shortest;
use crate::output::Destination;

/// The text of the variant.
///
/// # Errors
/// If the spec can no longer be found.
pub fn spec(result: &Fitted<'_, '_>, file: &Destination) -> Result<String, Failure> {
    let program = result.machine.program();
    let minimum = &result.found.minimum;
    let (mut parameters, mut coordinates) = (String::new(), String::new());
    let mut states = String::new();
    let several = result.given.len() > 1;
    let mut left = Vec::new();
    for (j, (one, x)) in result.fit.sought.iter().zip(&minimum.x).enumerate() {
        let error = match result.found.statistics.standard_error(j) {
            Some(error) => format!("Fitted, with a standard error of {}.", shortest(error)),
            None => "Not determined by the measurements.".to_owned(),
        };
        let value = shortest(*x);
        // Writing to a String cannot fail.
        let _ = match one.subject {
            Subject::Parameter(index) => {
                let unit = &program.parameters[index].unit_text;
                writeln!(
                    parameters,
                    "        /// {error}\n        {}: {unit} = {value},",
                    one.name
                )
            }
            Subject::Start(..) | Subject::Rate(..) if several => {
                left.push(one.name.clone());
                Ok(())
            }
            Subject::Start(e, place) => {
                let name = findings::coordinate(result, e, place);
                let unit = &program.coordinates[place].unit_text;
                writeln!(
                    coordinates,
                    "        /// {error}\n        {name}: {unit} = {value},"
                )
            }
            Subject::Rate(e, place) => {
                let name = findings::coordinate(result, e, place);
                let unit = &program.coordinates[place].unit_text;
                if let Some(state) = state_of(&name) {
                    let unit = unit::rate_unit(&name, unit);
                    let _ = writeln!(
                        states,
                        "        /// {error}\n        {state}: {unit} = {value},"
                    );
                    continue;
                }
                let unit = match unit.as_str() {
                    "1" => "1/s".to_owned(),
                    unit => format!("({unit})/s"),
                };
                writeln!(coordinates, "        der({name}): {unit} = {value},")
            }
        };
    }
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
    let name = lagrangian::Machine::name(result.machine);
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
    if !parameters.is_empty() {
        let _ = write!(text, "    parameters {{\n{parameters}    }}\n");
    }
    if !coordinates.is_empty() {
        let _ = write!(text, "    coordinates {{\n{coordinates}    }}\n");
    }
    if !states.is_empty() {
        let _ = write!(text, "    states {{\n{states}    }}\n");
    }
    text.push_str("}\n");
    Ok(text)
}

/// Checks that the fitted numbers can be expressed in a variant: a member of a family has no declaration of its own.
///
/// # Errors
/// If the call is invalid.
pub fn check(sought: &[Sought], experiments: usize) -> Result<(), Failure> {
    let has_statement =
        |one: &&Sought| matches!(one.subject, Subject::Parameter(_)) || experiments == 1;
    let mut stated = sought.iter().filter(has_statement);
    match stated.find(|one| one.name.contains('[')) {
        None => Ok(()),
        Some(one) => Err(Failure::Call(format!(
            "--out: `{}` is a member of a family, and a variant of a spec cannot set it separately; --json prints its value",
            one.name
        ))),
    }
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
