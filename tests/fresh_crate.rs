//! The macro in a crate outside the workspace, as a user has it: with specs inline and in a file, after an edit of
//! the file, and with mistakes.
//!
//! `UPDATE_UI=1 cargo test --test fresh_crate` writes the compiler's current output beside the programs in `tests/ui/macro/`. Read
//! the difference as a user would.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::{Mutex, MutexGuard};

/// Only one cargo runs at a time, because the crates share a build folder.
static CARGO: Mutex<()> = Mutex::new(());

/// A crate in a temporary folder, which is removed when the test ends.
struct Crate {
    folder: PathBuf,
    _alone: MutexGuard<'static, ()>,
}

impl Crate {
    /// A crate that depends only on the library in this checkout.
    fn new(name: &str) -> Crate {
        Self::with(name, "")
    }

    /// A crate with further settings of the dependency, such as `, default-features = false`.
    fn with(name: &str, settings: &str) -> Crate {
        let alone = CARGO
            .lock()
            .unwrap_or_else(|poisoned| poisoned.into_inner());
        let folder = std::env::temp_dir().join(format!("lagrangian-{name}-{}", std::process::id()));
        let fresh = Crate {
            folder,
            _alone: alone,
        };
        let root = concat!(env!("CARGO_MANIFEST_DIR"), "/..");
        fresh.write(
            "Cargo.toml",
            &format!(
                "[package]\nname = {name:?}\nversion = \"0.1.0\"\nedition = \"2021\"\n\n\
                 [dependencies]\nlagrangian = {{ path = \"{root}/lagrangian\"{settings} }}\n\n[workspace]\n"
            ),
        );
        // Uses the versions that are present already, so that nothing is downloaded.
        fs::copy(
            Path::new(root).join("Cargo.lock"),
            fresh.folder.join("Cargo.lock"),
        )
        .expect("the lock file is committed");
        fresh
    }

    fn write(&self, path: &str, text: &str) {
        let path = self.folder.join(path);
        fs::create_dir_all(path.parent().expect("it is in the crate"))
            .expect("a temporary folder can be made");
        fs::write(path, text).expect("a temporary file can be written");
    }

    /// The build folder that all crates share.
    fn target() -> PathBuf {
        Path::new(env!("CARGO_TARGET_TMPDIR")).join("fresh-crate")
    }

    fn cargo(&self, arguments: &[&str]) -> Output {
        Command::new(env!("CARGO"))
            .args(arguments)
            .args(["--offline", "--quiet"])
            .current_dir(&self.folder)
            .env("CARGO_TARGET_DIR", Self::target())
            .env("CARGO_TERM_COLOR", "never")
            // A debugger needs it, and these tests do not.
            .env("CARGO_PROFILE_DEV_DEBUG", "false")
            .env_remove("RUSTFLAGS")
            .output()
            .expect("cargo runs")
    }

    /// Runs the crate's program and returns its output.
    fn run(&self) -> String {
        let output = self.cargo(&["run"]);
        assert!(
            output.status.success(),
            "{}",
            String::from_utf8_lossy(&output.stderr)
        );
        String::from_utf8(output.stdout).expect("it prints text")
    }
}

impl Drop for Crate {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.folder); // a folder left behind does no harm
    }
}

const OSCILLATOR: &str = "
/// A block on a spring.
machine Oscillator in plane {
    constants { twice = 2 }
    parameters { m: kg = 1, c: N/m = 40 }
    coordinates { x: m = 0.25 }
    bodies { block { mass: m, at: (twice*x, 0) } }
    springs { spring { stiffness: c, stretch: twice*x } }
}
";

/// The machines of a program have no contacts and no constraints, so the program must not contain the runtime's functions for
/// these, which would otherwise be compiled once for each machine. The symbols of a program name its functions.
fn has_no_code_of_absent_features(program: &str) {
    let path = Crate::target().join("debug").join(program);
    let program = fs::read(path).expect("the program has just run");
    let has = |name: &str| {
        let mut windows = program.windows(name.len());
        windows.any(|bytes| bytes == name.as_bytes())
    };
    assert!(has("step_of_fixed_length"), "functions are not named");
    for (name, source) in [
        (
            "resolve_penetration",
            include_str!("../src/contact/stepping/penetration.rs"),
        ),
        ("find_branch", include_str!("../src/constraints/start.rs")),
    ] {
        assert!(
            source.contains(&format!("fn {name}<")),
            "{name} is no function"
        );
        assert!(
            !has(name),
            "the program has `{name}`, which no machine of it needs"
        );
    }
}

#[test]
fn a_fresh_crate_follows_its_spec() {
    let fresh = Crate::new("oscillator");
    fresh.write("machines/oscillator.machine", OSCILLATOR);
    fresh.write(
        "machines/driven.machine",
        "machine Driven extends \"oscillator.machine\" { inputs { u: N } forces { drive { on: x, value: u } } }",
    );
    fresh.write(
        "src/main.rs",
        r#"
        #![deny(warnings, missing_docs, clippy::all)]
        //! Machines from files.
        use lagrangian::Simulation;

        lagrangian::machine!(file = "machines/driven.machine");

        fn main() {
            // In a function, with another constant, and beside a crate of the same name: this one.
            lagrangian::machine!(file = "machines/oscillator.machine", twice = 3);
            let machine = Oscillator { c: 10.0, ..Default::default() };
            let run = Simulation::new(&machine).tolerance(1e-10).until(1.0).run(machine.start()).unwrap();
            let exact = 0.25 * 10f64.sqrt().cos();
            assert!((run.at(1.0).unwrap().q.x - exact).abs() < 1e-8);
            let prepared = Driven::default().prepare();
            let a = driven::accelerations(&prepared, &[0.0], &driven::Inputs { u: 8.0 }).unwrap();
            println!("{} {} {}", machine.start().q.x, Driven::default().start().q.x, a[0]);
        }
        "#,
    );
    assert_eq!(fresh.run(), "0.25 0.25 2\n");
    has_no_code_of_absent_features("oscillator");
    // An edit of a file that the macro reads, or that such a file extends, recompiles the crate.
    fresh.write(
        "machines/oscillator.machine",
        &OSCILLATOR.replace("0.25", "0.5").replace("= 2", "= 4"),
    );
    fresh.write("src/main.rs.orig", "");
    let edited = fresh.cargo(&["run"]);
    // The program's spring now starts elsewhere, so its own assertion fails, which shows that the edit took effect.
    assert!(
        String::from_utf8_lossy(&edited.stderr).contains("assertion failed"),
        "{edited:?}"
    );
    fresh.write(
        "machines/oscillator.machine",
        &OSCILLATOR.replace("= 2", "= 4"),
    );
    assert_eq!(fresh.run(), "0.25 0.25 0.5\n");
}

#[test]
fn machines_stand_inline_side_by_side() {
    let fresh = Crate::new("inline");
    fresh.write(
        "src/main.rs",
        r#"
        #![deny(warnings, missing_docs, clippy::all, clippy::pedantic, clippy::nursery)]
        #![forbid(unsafe_code)]
        //! Machines in the source.

        /// What a library that has the runtime inside does.
        pub mod inside {
            pub use lagrangian as runtime;
        }

        lagrangian::machine! {
            /// A pendulum of `N` bobs.
            machine Pendulum in plane {
                constants { N = 2 }
                parameters { l: m = 1, m: kg = 1, g: m/s^2 = 9.81 }
                coordinates { q[1..N]: rad = 0.1 }
                frames { rod[0] = ground, rod[i in 1..N] = rod[i-1].turn(q[i]).shift(l, 0) }
                bodies { bob[i in 1..N] { mass: m, at: rod[i].origin } }
                gravity (g, 0);
            }
        }

        lagrangian::machine! {
            crate = crate::inside::runtime;
            /// Names that mean something to Rust, and lines that would be tests:
            ///
            ///     this_is_no_test(
            machine Result in plane {
                parameters { r#type: kg, S: N/m = 40, N: 1 = 3.14, d: m = 1 }
                coordinates { PARAMETERS: m = d, None: m, singular: m, p: m, t0: m, w: m, zero: m, q_p: m }
                bodies {
                    a { mass: r#type, at: (PARAMETERS + t0, None + N*singular) },
                    b { mass: r#type, at: a.at + (p + q_p, w + 2*zero) },
                    c { mass: r#type, at: (p - w, zero) }, d { mass: r#type, at: (singular, None - w) },
                    e { mass: r#type, at: (t0, 0) }, f { mass: r#type, at: (p, q_p) },
                }
                springs { spring { stiffness: S, stretch: PARAMETERS } }
            }
        }

        macro_rules! spring_of {
            ($name:ident, $stiffness:expr) => {
                lagrangian::machine! {
                    machine $name in plane {
                        parameters { m: kg = 1 }
                        coordinates { x: m = 1 }
                        bodies { block { mass: m, at: (x, 0) } }
                        springs { spring { stiffness: 2*$stiffness, stretch: x } }
                    }
                }
            };
        }
        spring_of!(Soft, 1 + 2);

        fn main() {
            let machine = Pendulum::default();
            let single = machine.map(|x| x as f32).prepare();
            let double = machine.prepare();
            let a = pendulum::accelerations(&double, &[0.1, 0.2], &[0.3, 0.4]).unwrap();
            let b = pendulum::accelerations(&single, &[0.1, 0.2], &[0.3, 0.4]).unwrap();
            assert!((a[0] - f64::from(b[0])).abs() < 1e-5);
            assert_eq!(Result::new(2.0).start().q.PARAMETERS, 1.0);
            let soft = soft::accelerations(&Soft::default().prepare(), &[1.0]);
            println!("{:?} {soft:?}", machine.start().q);
        }
        "#,
    );
    // The cast is the user's own code, so lints are allowed there.
    let text = fs::read_to_string(fresh.folder.join("src/main.rs")).expect("it was just written");
    fresh.write(
        "src/main.rs",
        &text.replace(
            "fn main()",
            "#[allow(clippy::all, clippy::pedantic)]\nfn main()",
        ),
    );
    assert_eq!(fresh.run(), "Coordinates { q: [0.1, 0.1] } Ok([-6.0])\n");
    if Command::new(env!("CARGO"))
        .args(["clippy", "--version"])
        .output()
        .is_ok_and(|output| output.status.success())
    {
        let clippy = fresh.cargo(&["clippy"]);
        assert!(
            clippy.status.success(),
            "{}",
            String::from_utf8_lossy(&clippy.stderr)
        );
    }
}

#[test]
fn mistakes_are_told_at_the_users_tokens() {
    let fresh = Crate::new("mistakes");
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("ui/macro");
    let mut programs: Vec<String> = Vec::new();
    for entry in fs::read_dir(&folder).expect("the folder is part of the repository") {
        let path = entry.expect("the folder can be read").path();
        let name = path
            .file_name()
            .expect("a file has a name")
            .to_string_lossy()
            .into_owned();
        let text = fs::read_to_string(&path).expect("it is text");
        if let Some(stem) = name.strip_suffix(".rs") {
            fresh.write(&format!("src/bin/{name}"), &text);
            programs.push(stem.to_owned());
        } else if name.ends_with(".machine") {
            fresh.write(&format!("machines/{name}"), &text);
        }
    }
    programs.sort();
    assert!(!programs.is_empty());
    for program in programs {
        let output = fresh.cargo(&["check", "--bin", &program, "--message-format", "short"]);
        assert!(!output.status.success(), "{program} compiles");
        let said = String::from_utf8_lossy(&output.stderr)
            .replace(&*fresh.folder.to_string_lossy(), "$CRATE");
        // Cargo itself adds the line with the number of errors.
        let said: Vec<&str> = said
            .lines()
            .filter(|line| !line.starts_with("error: could not compile"))
            .collect();
        let said = said.join("\n") + "\n";
        let path = folder.join(format!("{program}.expected"));
        if std::env::var_os("UPDATE_UI").is_some() {
            fs::write(&path, &said).expect("the repository can be written");
        }
        let expected = fs::read_to_string(&path)
            .unwrap_or_default()
            .replace("\r\n", "\n");
        assert_eq!(said, expected, "{program}");
    }
}

/// If a spec lacks something that a use of its machine requires, the error states the line to add.
#[test]
fn a_missing_ability_names_the_line_to_add_to_the_spec() {
    let fresh = Crate::new("abilities");
    fresh.write(
        "src/main.rs",
        r#"
        lagrangian::machine! {
            machine Plain in plane {
                parameters { l: m = 1, g: m/s^2 = 9.81 }
                coordinates { theta: rad = 1 }
                bodies { bob { mass: 1, at: l*(sin(theta), -cos(theta)) } }
                gravity (0, -g);
            }
        }
        lagrangian::machine! {
            machine Held in plane {
                parameters { l: m = 1 }
                coordinates { x: m = 1, y: m }
                bodies { bob { mass: 1, at: (x, y) } }
                constraints { rod: x^2 + y^2 = l^2 }
            }
        }
        fn linearize<S: lagrangian::Linearize>(_: &S) {}
        fn differentiate<S: lagrangian::Differentiate>(_: &S) {}
        fn stage<S: lagrangian::Staged>(_: &S) {}
        fn in_single_precision<M: lagrangian::MachineIn<f32>>(_: &M) {}
        fn main() {
            let system = Plain::default().prepare();
            linearize(&system);
            differentiate(&system);
            stage(&system);
            in_single_precision(&Plain::default().map(|x| x as f32));
            in_single_precision(&Held::default().map(|x| x as f32));
        }
        "#,
    );
    let output = fresh.cargo(&["check"]);
    assert!(!output.status.success(), "it compiles");
    let said = String::from_utf8_lossy(&output.stderr);
    for part in [
        "does not provide the derivatives of its accelerations with respect to the state",
        "add the line `derivatives { coordinates, rates }` to the description of the machine",
        "does not provide the derivatives of its accelerations with respect to the state, parameters and inputs",
        "are not evaluated in stages",
        "add the line `stages { time, coordinates }` to the description of the machine",
        "is not a machine in the numbers `f32`",
        "where it has no constraints and no contacts",
    ] {
        assert!(said.contains(part), "`{part}` is not in:\n{said}");
    }
    // The machine without constraints can be used with these numbers.
    assert_eq!(
        said.matches("is not a machine in the numbers").count(),
        1,
        "{said}"
    );
}

/// A firmware has no standard library and defines its own panic handler. If any crate of the dependency tree used the standard
/// library, there would be two panic handlers, which the compiler refuses.
#[test]
fn a_firmware_needs_no_standard_library() {
    let settings = ", default-features = false, features = [\"macros\"]";
    let fresh = Crate::with("firmware", settings);
    fresh.write(
        "src/lib.rs",
        r#"
        #![no_std]
        #![forbid(unsafe_code)]

        lagrangian::machine! {
            machine Pendulum in plane {
                parameters { l: m = 0.5, g: m/s^2 = 9.81 }
                coordinates { theta: rad = 1 }
                inputs { torque: N*m }
                bodies { bob { mass: 1, at: l*(sin(theta), -cos(theta)) } }
                gravity (0, -g);
                forces { motor { on: theta, value: torque } }
            }
        }

        #[panic_handler]
        fn halt(_: &core::panic::PanicInfo<'_>) -> ! {
            loop {}
        }

        use lagrangian::{ControlledStepper, Ensemble, ExplicitStepper, Method, StepError, Stepper, Trajectory};

        pub struct Model(ControlledStepper<pendulum::Prepared>);

        impl Model {
            pub fn new() -> Result<Self, StepError> {
                let machine = Pendulum::default();
                let stepper = Stepper::builder(machine.prepare()).method(Method::BS32);
                Ok(Self(stepper.tolerance(1e-5).start(machine.start())?))
            }

            pub fn tick(&mut self, t: f64, torque: f64) -> Result<f64, StepError> {
                self.0.set_inputs(pendulum::Inputs { torque });
                self.0.advance_to(t)?;
                Ok(self.0.state().q.theta)
            }
        }

        /// In single precision, as a processor without doubles has it.
        pub fn single(t: f32) -> Result<f32, StepError> {
            let machine = Pendulum::default().map(|x| x as f32);
            let mut stepper = ExplicitStepper::builder(machine.prepare()).start(machine.start())?;
            stepper.advance_to(t)?;
            Ok(stepper.state().q.theta)
        }

        pub fn several(ends: [f64; 8]) -> [f64; 8] {
            let machine = Pendulum::default();
            let mut angles = [0.0; 8];
            let trajectories = ends.map(|end| Trajectory::of(&machine, end));
            Ensemble::<2>::new().run(trajectories, |number, arrived| {
                angles[number] = arrived.map_or(f64::NAN, |arrival| arrival.end.q.theta);
            });
            angles
        }
        "#,
    );
    let output = fresh.cargo(&["check"]);
    assert!(
        output.status.success(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
}
