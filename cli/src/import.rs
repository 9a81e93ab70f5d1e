//! `lagrangian import`: converts a robot description to a spec.

mod faults;
mod machine;
mod mjcf;
mod names;
mod number;
mod robot;
mod steps;
mod tensor;
mod text;
mod tree;
mod urdf;
mod xml;

use std::fs::File;
use std::io::Read;
use std::path::Path;

use lagrangian_spec::diagnostic::Report;
use lagrangian_spec::model::Model;
use lagrangian_spec::source::{Disk, Sources};
use lagrangian_symbolic::Dag;
use serde_json::json;

use crate::call;
use crate::diagnostics::{self, counted};
use crate::failure::Failure;
use crate::output::{
    self, Destination, Endings, MACHINE, ending_is_one_of, keep_apart, keep_document_apart,
};
use crate::progress;
use faults::Faults;
use machine::Machine;

/// The file extensions that are read.
const ROBOT: Endings = &["urdf", "xml", "mjcf"];

/// The file extension of URDF.
const URDF: Endings = &["urdf"];

/// The largest file that is read, in bytes.
const LARGEST: u64 = 16 << 20;

/// Runs the command.
///
/// # Errors
/// If the call or the file is invalid, or the spec cannot be written.
pub fn run(call: &call::Import) -> Result<(), Failure> {
    progress::now("reading the robot");
    let out = Destination::of("--out", call.out.as_ref(), MACHINE)?;
    keep_document_apart(&out, call.json)?;
    keep_apart(&out, &[(&call.path, "the robot's file")])?;
    let text = read(&call.path)?;
    let shown = call.path.display().to_string();
    let file = call.path.file_name().unwrap_or_default().to_string_lossy();
    let mut faults = Faults::new(&shown, &text);
    let robot = if ending_is_one_of(&call.path, URDF) {
        urdf::read(&text, &call.ignore, &mut faults)
    } else {
        let folder = call.path.parent().unwrap_or_else(|| Path::new(""));
        let included = |path: &Path| bytes_of(path).map_err(Failure::message);
        mjcf::read(&text, folder, &included, &call.ignore, &mut faults)
    };
    if let (Some(_), call::Base::Floating, false) =
        (&robot, call.base, ending_is_one_of(&call.path, URDF))
    {
        let message =
            "--base floating: an MJCF file itself specifies which bodies float, by `freejoint`";
        return Err(Failure::Call(message.to_owned()));
    }
    let machine = robot.and_then(|robot| machine::write(&robot, &file, call, &mut faults));
    let Some(machine) = machine.filter(|_| faults.is_empty()) else {
        return Err(Failure::Run(faults.into_message()));
    };
    check(&machine, out.as_ref())?;
    for warning in &machine.warnings {
        output::print_error(format_args!("warning: {warning}"));
    }
    if let Some(file) = &out {
        file.write_text(&machine.text)?;
    }
    show(call, &machine);
    Ok(())
}

/// The text of a file.
fn read(path: &Path) -> Result<String, Failure> {
    let shown = path.display();
    if !ending_is_one_of(path, ROBOT) {
        return Err(Failure::Call(format!(
            "{shown}: expected a robot in URDF, with the ending `.urdf`, or in MJCF, with the ending `.xml` or `.mjcf`"
        )));
    }
    text_of(path)
}

/// The text of any file.
fn text_of(path: &Path) -> Result<String, Failure> {
    let shown = path.display();
    String::from_utf8(bytes_of(path)?).map_err(|error| {
        let before = &error.as_bytes()[..error.utf8_error().valid_up_to()];
        let line = before.iter().filter(|byte| **byte == b'\n').count() + 1;
        Failure::Run(format!("{shown}:{line}: the text is not UTF-8"))
    })
}

/// The bytes of a file.
fn bytes_of(path: &Path) -> Result<Vec<u8>, Failure> {
    let shown = path.display();
    let cannot =
        |error: &dyn std::fmt::Display| Failure::Call(format!("cannot read {shown}: {error}"));
    let mut bytes = Vec::new();
    let file = File::open(path).map_err(|error| cannot(&error))?;
    file.take(LARGEST + 1)
        .read_to_end(&mut bytes)
        .map_err(|error| cannot(&error))?;
    if bytes.len() as u64 > LARGEST {
        let message = format!(
            "{shown} is larger than {} MiB, the maximum for a robot",
            LARGEST >> 20
        );
        return Err(Failure::Run(message));
    }
    Ok(bytes)
}

/// Checks that the text is a valid spec, as every other command will read it.
fn check(machine: &Machine, out: Option<&Destination>) -> Result<(), Failure> {
    let mut sources = Sources::new();
    let mut report = Report::new();
    let file = out.and_then(Destination::file).and_then(Path::to_str);
    let name = file.unwrap_or("the imported machine");
    let dag = Dag::new();
    let spec = lagrangian_spec::parse(&mut sources, name, &machine.text, &mut report);
    let model = Model::resolve_with(spec, &dag, &[], &[], &mut Disk, &mut sources, &mut report);
    match model {
        Some(_) => {
            diagnostics::print(&report, &sources);
            Ok(())
        }
        None => Err(Failure::Spec(Box::new((report, sources)))),
    }
}

fn show(call: &call::Import, machine: &Machine) {
    let [coordinates, bodies, parameters] = machine.counts;
    if call.json {
        output::line(format_args!(
            "{:#}",
            json!({
                "machine": machine.name,
                "coordinates": coordinates,
                "bodies": bodies,
                "parameters": parameters,
                "warnings": machine.warnings,
                "text": machine.text,
            })
        ));
    } else if let Some(out) = &call.out {
        output::line(format_args!(
            "{}: {}, {}, {}, {}",
            out.display(),
            machine.name,
            counted(coordinates, "coordinate", "coordinates"),
            counted(bodies, "body", "bodies"),
            counted(parameters, "parameter", "parameters"),
        ));
    } else {
        output::text(&machine.text);
    }
}
