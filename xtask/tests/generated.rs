//! What is committed in `generated/` is what the compiler makes of `machines/`, and rustfmt has nothing to say about it.

use std::io::Write;
use std::path::Path;
use std::process::{Command, Stdio};

use lagrangian_emit::rust;
use lagrangian_mechanics::Compiled;
use lagrangian_spec::diagnostic::Report;
use lagrangian_spec::source::{Disk, Files, Sources};
use lagrangian_symbolic::{Dag, Rational};

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .parent()
        .expect("xtask is a folder of the project")
}

#[test]
fn generated_code_is_fresh() {
    let files = xtask::generate(root()).expect("the library compiles");
    let stale = xtask::stale(root(), &files).expect("the folders can be read");
    assert!(
        stale.is_empty(),
        "run `cargo xtask generate`: {stale:?} differ from what it writes"
    );
}

/// The module of a machine.
fn module(name: &str, text: &str, constants: &[(String, Rational)]) -> String {
    let (dag, mut sources, mut report) = (Dag::new(), Sources::new(), Report::new());
    let compiled = lagrangian_spec::model(
        &dag,
        name,
        text,
        constants,
        &mut Disk,
        &mut sources,
        &mut report,
    )
    .and_then(|model| Compiled::new(model, &mut report))
    .unwrap_or_else(|| panic!("{}", report.render_short(&sources)));
    let options = rust::Options {
        formulas: compiled.formulas(),
        ..rust::Options::default()
    };
    rust::module(&compiled.program, &options)
}

/// What rustfmt would change; nothing where there is no rustfmt.
fn changed_by_rustfmt(text: &str) -> String {
    let rustfmt = Command::new("rustfmt")
        .args(["--edition", "2024", "--check", "--color", "never"])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn();
    let Ok(mut rustfmt) = rustfmt else {
        eprintln!("there is no rustfmt; nothing is checked");
        return String::new();
    };
    let mut input = rustfmt.stdin.take().expect("it is a pipe");
    input.write_all(text.as_bytes()).expect("rustfmt reads");
    drop(input);
    let output = rustfmt.wait_with_output().expect("rustfmt ends");
    String::from_utf8_lossy(&output.stdout).into_owned() + &String::from_utf8_lossy(&output.stderr)
}

fn is_formatted(text: &str, what: &str) {
    is_left_by_rustfmt(text, what);
    let wide = text.lines().find(|line| line.chars().count() > 100);
    assert_eq!(wide, None, "{what} has a line of more than 100 columns");
}

fn is_left_by_rustfmt(text: &str, what: &str) {
    let changes = changed_by_rustfmt(text);
    assert!(changes.is_empty(), "{what}: {changes}");
}

#[test]
fn emitted_code_is_as_rustfmt_leaves_it() {
    for file in xtask::generate(root()).expect("the library compiles") {
        let what = file.path.to_string_lossy();
        // Comments of the runtime, parts of which are generated, are wider.
        if file.path.starts_with("generated/src") {
            is_formatted(&file.text, &what);
        } else if what.ends_with(".rs") {
            is_left_by_rustfmt(&file.text, &what);
        }
    }
}

#[test]
fn long_chains_are_as_rustfmt_leaves_them() {
    for machine in ["chain", "chain_relative"] {
        let path = root().join("machines").join(format!("{machine}.machine"));
        let (name, text) = Disk
            .read(&path.to_string_lossy(), None)
            .expect("the library is there");
        for size in [1, 2, 3, 5, 10, 20] {
            let constants = [("N".to_owned(), Rational::from(size))];
            is_formatted(
                &module(&name, &text, &constants),
                &format!("{machine} of {size}"),
            );
        }
    }
}

#[test]
fn odd_names_and_long_words_are_as_rustfmt_leaves_them() {
    let text = "
        /// A machine whose documentation goes on and on, in one line that nobody has broken, as people do write it.
        ///
        ///     four blanks would make this a test
        /// ```
        /// and so would three backquotes
        /// ```
        machine Result in plane {
            parameters {
                /// Named like a keyword, and without a default.
                type: kg, S: N/m, move[1..12]: m,
                /// The stiffness of a spring that has been given a name of unusual length by somebody.
                the_stiffness_of_the_spring: N/m = 1/3,
            }
            coordinates {
                loop: m, PARAMETERS: m = move[3], None: m, singular: m, t0: m, p: m, f64_: m,
                the_displacement_of_the_block: m,
                der_: rad, q[1..12]: rad = 0.125, h_q_1: rad,
            }
            inputs { u[-1..1]: N = 0, super_: N = 1 }
            assume { the_displacement_of_the_block > -1000*move[12], PARAMETERS >= 0 }
            bodies {
                a { mass: type, inertia: type*move[1]^2, at: (PARAMETERS + t0, singular + loop*sin(der_)), angle: q[1] },
                b { mass: 2*type, at: a.at + polar(None, q[12] - q[2]) + (p, f64_) },
                first { mass: type, at: (t0, loop) },
                second { mass: type, at: (p, f64_) },
                third { mass: type, at: (move[1]*der_, move[1]*q[12]) },
                c { mass: 3*type, at: b.at + polar(the_displacement_of_the_block, h_q_1) },
                d[i in 3..11] { mass: type, inertia: type*move[i]^2, at: (move[i]*cos(q[i]), 0), angle: q[i] + q[2] },
            }
            springs {
                x { stiffness: S, stretch: PARAMETERS },
                y { stiffness: the_stiffness_of_the_spring,
                    stretch: the_displacement_of_the_block - move[1] },
            }
            forces { pull[i in -1..1] { on: loop, value: u[i] }, push { on: t0, value: super_*min(1, max(t0/move[1], 0)) } }
            outputs { Ok: m/s = der(loop), list[0..2]: m^2 = loop^2 + move[3]*sqrt(t0^2 + 1) }
        }";
    is_formatted(&module("odd.machine", text, &[]), "odd names");
}
