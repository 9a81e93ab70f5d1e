//! Specs that a program reads at run time.

use lagrangian::interpreted::InterpretedMachine;
use lagrangian::{Error, Machine, Simulation, TAYLOR};

const CHAIN: &str = "machine Chain in plane {
    constants { N = 2 }
    parameters { m: kg = 1, l: m = 0.5, g: m/s^2 = 9.81 }
    coordinates { theta[1..N]: rad = 0.5 }
    frames { end[0] = ground, end[i in 1..N] = end[i-1].shift(l*sin(theta[i]), -l*cos(theta[i])) }
    bodies { ball[i in 1..N] { mass: m, at: end[i].origin } }
    gravity (0, -g);
}";

#[test]
fn a_text_is_read_with_its_constants() {
    let chain = InterpretedMachine::from_text(CHAIN)
        .constant("N", 5)
        .build()
        .unwrap();
    assert_eq!(chain.program().dimension(), 5);
    for wrong in [f64::NAN, f64::INFINITY] {
        let error = InterpretedMachine::from_text(CHAIN)
            .constant("N", wrong)
            .build();
        let Err(Error::Spec { diagnostics, .. }) = error else {
            panic!("{wrong} is no constant");
        };
        assert_eq!(diagnostics[0].code, "number-out-of-range");
    }
    let error = InterpretedMachine::from_text(CHAIN)
        .constant("n", 5)
        .build()
        .unwrap_err();
    assert!(error.to_string().contains("did you mean `N`?"), "{error}");
}

#[test]
fn a_file_is_read_as_the_library_has_it() {
    let crusher =
        InterpretedMachine::from_file(crate::support::library::path("vibrating_crusher")).unwrap();
    let compiled = lagrangian_machines::VibratingCrusher::default();
    let run = Simulation::new(&crusher)
        .until(0.05)
        .run(crusher.start())
        .unwrap();
    let same = Simulation::new(&compiled)
        .until(0.05)
        .run(compiled.start())
        .unwrap();
    assert_eq!(run.end().q.values, same.end().q.to_array());
}

#[test]
fn everything_wrong_with_a_text_has_its_place() {
    let text = CHAIN
        .replace("l*sin(", "l*sine(")
        .replace("mass: m,", "mas: m,");
    let Err(Error::Spec {
        diagnostics,
        omitted,
    }) = InterpretedMachine::from_text(text)
        .named("chain.machine")
        .build()
    else {
        panic!("two words are wrong");
    };
    let told: Vec<_> = diagnostics
        .iter()
        .map(|of| {
            (
                of.code.as_str(),
                of.file.as_str(),
                of.line,
                of.words.as_str(),
            )
        })
        .collect();
    assert!(
        told.contains(&("unknown-function", "chain.machine", 5, "sine")),
        "{told:?}"
    );
    assert!(
        told.contains(&("unknown-field", "chain.machine", 6, "mas")),
        "{told:?}"
    );
    let sine = &diagnostics[told.iter().position(|of| of.3 == "sine").unwrap()];
    // The text before `sine` is `    frames { end[0] = ground, end[i in 1..N] = end[i-1].shift(l*`.
    assert_eq!(sine.column, 65);
    assert_eq!(omitted, 0);
    let error = InterpretedMachine::from_file("machines/nowhere.machine").unwrap_err();
    assert!(error.to_string().contains("unreadable-file"), "{error}");
}

#[test]
fn what_a_caller_needs_is_one_error() {
    fn runs() -> Result<f64, Error> {
        let mut chain = InterpretedMachine::from_text(CHAIN).with_series().build()?;
        chain.set("l", 0.25)?;
        chain.check_parameters()?;
        let run = Simulation::new(&chain).method(&TAYLOR).until(1.0);
        Ok(run.run(chain.start())?.end().t)
    }
    assert_eq!(runs(), Ok(1.0));
    let mut chain = InterpretedMachine::from_text(CHAIN).build().unwrap();
    let unknown = chain.set("L", 1.0).unwrap_err();
    assert_eq!(unknown.near.as_deref(), Some("l"));
}

/// Two of the three constraints are equivalent, and all of them together fix `y` and `z`, while a force pushes `x`. The
/// force on `x` leaves rounding of its own size in the accelerations of `y` and `z`, which consist of nothing else.
#[test]
fn accelerations_that_constraints_keep_at_0_are_as_inexact_as_the_others() {
    let held = InterpretedMachine::from_text(
        "machine Held in plane {
            parameters { m: kg = 1, l: m = 1, c: m = 0.1 }
            coordinates { x: m = -1.5, der(x): m/s = 0.25, y: m, z: m }
            bodies {
                a { mass: m, at: (y + z, x) },
                b { mass: 2*m, at: (y, z + 0.25*x*z/l) },
            }
            forces { push { on: x, value: 0.5*N } }
            constraints {
                sum: y + 0.5*z = c,
                rolls: sin(z/l)*der(z) = cos(z/l)*der(y),
                twice: 2*sin(z/l)*der(z) = 2*cos(z/l)*der(y),
            }
        }",
    )
    .build()
    .unwrap();
    for k in 0..40 {
        let z = 1.7 - 0.0875 * f64::from(k);
        // At rest, and with the rates that rounding leaves where a start is computed.
        for rest in [0.0, 1.25e-33] {
            let mut start = held.start();
            start.q.values = vec![-1.5, 0.1 - 0.5 * z, z];
            start.v.values = vec![0.25, -rest, 2.0 * rest];
            let run = Simulation::new(&held).until(0.1).run(start);
            let run = run.unwrap_or_else(|error| panic!("z = {z}, {rest}: {error}"));
            assert!((run.end().q.values[2] - z).abs() < 1e-14, "z = {z}");
        }
    }
}
