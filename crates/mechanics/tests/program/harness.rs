//! What these tests share: machines compiled through all stages.

use std::path::Path;

use lagrangian_mechanics::Compiled;
use lagrangian_mechanics::Proved;
use lagrangian_program::Role;
use lagrangian_spec::diagnostic::Report;
use lagrangian_spec::source::{Disk, Sources};
use lagrangian_symbolic::{Dag, Rational};

/// Compiles a text whose `extends` refers to the library, with other values of some constants.
pub fn compiled<R>(
    text: &str,
    constants: &[(&str, i64)],
    look: impl for<'d> FnOnce(&Compiled<'d>) -> R,
) -> R {
    let (dag, mut sources, mut report) = (Dag::new(), Sources::new(), Report::new());
    let constants: Vec<(String, Rational)> = constants
        .iter()
        .map(|&(name, value)| (name.to_owned(), Rational::from(value)))
        .collect();
    let name = library("test").to_string_lossy().into_owned();
    let model = lagrangian_spec::model(
        &dag,
        &name,
        text,
        &constants,
        &mut Disk,
        &mut sources,
        &mut report,
    );
    match model.and_then(|model| Compiled::new(model, &mut report)) {
        Some(machine) => look(&machine),
        None => panic!("{}", report.render_short(&sources)),
    }
}

/// The text of a machine of the library.
pub fn library_text(name: &str) -> String {
    std::fs::read_to_string(library(name)).expect("a machine of the library")
}

/// Compiles a machine of the library.
pub fn machine<R>(
    name: &str,
    constants: &[(&str, i64)],
    look: impl for<'d> FnOnce(&Compiled<'d>) -> R,
) -> R {
    compiled(&library_text(name), constants, look)
}

/// The program of a text.
pub fn program(text: &str) -> Proved {
    compiled(text, &[], |machine| machine.program.clone())
}

/// The program of a ball on a line, with the given parameters and one output.
pub fn program_of_output(parameters: &str, output: &str) -> Proved {
    let text = format!(
        "machine Test in plane {{
            parameters {{ mass: kg = 2, length: m = 1, {parameters} }}
            coordinates {{ x: rad = 0.5, y: rad = 0.3 }}
            bodies {{ ball {{ mass: mass, at: length*(x, y) }} }}
            outputs {{ out: 1 = {output} }}
        }}"
    );
    program(&text)
}

/// The operation counts of an output and of `prepare`, as text.
pub fn counts_of_output(parameters: &str, output: &str) -> String {
    let program = program_of_output(parameters, output);
    program
        .function(Role::Output(0))
        .expect("the output")
        .counts()
        .to_string()
}

fn library(name: &str) -> std::path::PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../../machines/{name}.machine"))
}

/// The machines of the library.
pub fn all_machines() -> Vec<String> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../machines");
    let paths = std::fs::read_dir(folder)
        .expect("a folder")
        .map(|entry| entry.expect("an entry").path());
    let machines = paths.filter(|path| path.extension().is_some_and(|ending| ending == "machine"));
    let mut names: Vec<String> = machines
        .map(|path| {
            path.file_stem()
                .expect("a file")
                .to_string_lossy()
                .into_owned()
        })
        .collect();
    names.sort();
    names
}

/// The machines of the library whose accelerations are a function of the
/// state: nothing sticks or slides.
pub fn smooth_machines() -> Vec<String> {
    let mut names = all_machines();
    names.retain(|name| !library_text(name).contains("sliding {"));
    names
}

/// Compiles a text with derivatives by everything, whatever its spec requests.
pub fn differentiated<R>(
    text: &str,
    constants: &[(&str, i64)],
    look: impl for<'d> FnOnce(&Compiled<'d>) -> R,
) -> R {
    let text = match text.rfind('}') {
        Some(end) => format!(
            "{} derivatives {{ coordinates, rates, inputs, parameters }} }}",
            &text[..end]
        ),
        None => text.to_owned(),
    };
    compiled(&text, constants, look)
}

/// [`differentiated`] for a machine of the library.
pub fn differentiated_machine<R>(
    name: &str,
    constants: &[(&str, i64)],
    look: impl for<'d> FnOnce(&Compiled<'d>) -> R,
) -> R {
    let text = std::fs::read_to_string(library(name)).expect("a machine of the library");
    differentiated(&text, constants, look)
}
