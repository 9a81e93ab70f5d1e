//! The output is the same to the last digit, whichever engine evaluates the equations.

use serde_json::Value;

use super::{err, json, status};
use crate::support::lagrangian;

/// Whether machine code is generated for this processor.
fn has_machine_code() -> bool {
    #[cfg(target_arch = "x86_64")]
    let has = is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma");
    #[cfg(not(target_arch = "x86_64"))]
    let has = false;
    has
}

/// The output of a command, without the elapsed time.
fn printed(call: &[&str], engine: &[&str]) -> Value {
    let output = lagrangian(&[call, engine].concat());
    assert_eq!(status(&output), 0, "{call:?} {engine:?}: {}", err(&output));
    let mut printed = json(&output);
    if let Some(members) = printed.as_object_mut() {
        members.remove("seconds");
    }
    printed
}

#[test]
fn every_engine_prints_the_same() {
    // A plain run, one with drives and a cushion, one with constraints, one with sticking and sliding, a stiff one, and steps by series, of which the
    // second run takes so many that compiling pays off in the middle of it.
    for call in [
        "simulate machines/double_pendulum.machine --until 3 --json",
        "simulate machines/cushioned_crusher.machine --until 0.1 --json",
        "simulate machines/closed_pendulum.machine --until 1 --json",
        "simulate machines/stick_slip.machine --until 1 --json",
        "simulate machines/simple_pendulum.machine --until 1 --method radau5 --json",
        "simulate machines/vibrating_crusher.machine --until 0.1 --method taylor --json",
        "simulate machines/double_pendulum.machine --until 20 --method taylor --tolerance 1e-13 --json",
        "simulate machines/closed_pendulum.machine --until 1 --method taylor --json",
        "evaluate machines/vibrating_crusher.machine --start s1=0.02 --start s2=0.03",
        "modes machines/elastic_pendulum.machine --json",
        "brachistochrone machines/prisms.machine --json",
    ] {
        let words: Vec<&str> = call.split(' ').collect();
        let engines: &[&[&str]] = if has_machine_code() {
            &[&["--engine", "auto"], &["--engine", "jit"], &[]]
        } else {
            &[&["--engine", "auto"], &[]]
        };
        let expected = printed(&words, &["--engine", "interpreter"]);
        for engine in engines {
            assert_eq!(printed(&words, engine), expected, "{call} {engine:?}");
        }
    }
}

#[test]
fn an_engine_that_is_not_there_is_an_error_of_the_call() {
    let call = ["evaluate", "machines/double_pendulum.machine", "--engine"];
    let unknown = lagrangian(&[&call[..], &["rustc"]].concat());
    assert_eq!(status(&unknown), 2, "{}", err(&unknown));
    let forced = lagrangian(&[&call[..], &["jit"]].concat());
    if has_machine_code() {
        assert_eq!(status(&forced), 0, "{}", err(&forced))
    } else {
        assert_eq!(status(&forced), 2, "{}", err(&forced));
        assert!(err(&forced).contains("--engine jit"), "{}", err(&forced));
    }
}
