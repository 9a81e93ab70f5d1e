//! The command as a library: calls by a host program about a spec in memory.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use lagrangian_cli::answer;
use lagrangian_sweep::plan::SpecText;

const BALL: &str = "machine Ball in plane {
    parameters { m: kg = 2 }
    coordinates { y: m = N }
    constants { N = 1 }
    bodies { ball { mass: m, at: (0, y) } }
    gravity (0, -9.81);
}";

fn ball() -> SpecText {
    SpecText {
        name: "nowhere/ball.machine".into(),
        text: BALL.into(),
        constants: vec![("N".into(), "3".into())],
        ..SpecText::default()
    }
}

#[test]
fn a_spec_in_memory_is_run_with_its_constants() {
    let options = ["--until", "1", "--json"].map(str::to_owned);
    let said = answer(&ball(), "simulate", &options, &Default::default());
    assert_eq!((said.status, said.err.as_str()), (0, ""));
    let document: serde_json::Value = serde_json::from_str(&said.out).expect("JSON");
    // y = N − g t²/2.
    let y = document["q"]["y"].as_f64().expect("a number");
    assert!((y - (3.0 - 9.81 / 2.0)).abs() < 1e-9, "{y}");
}

#[test]
fn what_is_wrong_is_kept_and_what_is_asked_wrongly_too() {
    let mut spec = ball();
    spec.text = spec.text.replace("mass: m", "mass: n");
    let said = answer(&spec, "check", &["--json".into()], &Default::default());
    assert_eq!(said.status, 1);
    assert!(
        said.out.contains("unknown-name") && said.out.contains("nowhere/ball.machine"),
        "{said:?}"
    );
    let said = answer(&ball(), "check", &["--jsn".into()], &Default::default());
    assert_eq!(said.status, 2);
    assert!(said.err.contains("--json"), "{said:?}");
}

#[test]
fn a_flag_ends_a_run() {
    let stop = Arc::new(AtomicBool::new(true));
    let options = ["--until", "1e9", "--max-steps", "1000000"].map(str::to_owned);
    let said = answer(&ball(), "simulate", &options, &stop);
    // 128 plus the number of SIGINT.
    assert_eq!(said.status, 130, "{said:?}");
}
