//! The JSON on the page of the command line matches what the command reads and writes.

use std::process::{Command, Stdio};

use serde_json::Value;

use crate::page::{Page, root};

/// The JSON blocks of the page, where `…` stands for anything.
fn blocks() -> Vec<Value> {
    let page = Page::open("docs/command-line.md");
    let blocks = page.blocks().into_iter();
    let blocks = blocks.filter(|block| block.language == "json");
    let text = blocks.map(|block| block.text.replace("{…}", "{}").replace('…', "null"));
    text.map(|text| serde_json::from_str(&text).unwrap_or_else(|error| panic!("{error}: {text}")))
        .collect()
}

/// The output of the command.
fn printed(arguments: &[&str]) -> Value {
    let mut command = Command::new(env!("CARGO_BIN_EXE_lagrangian"));
    let command = command.current_dir(root()).args(arguments);
    let output = command.stdin(Stdio::null()).output();
    let output = output.expect("the command runs").stdout;
    serde_json::from_slice(&output).expect("JSON")
}

fn keys(value: &Value) -> Vec<&String> {
    value.as_object().expect("an object").keys().collect()
}

#[test]
fn results_have_the_keys_that_the_page_prints() {
    let [
        point,
        evaluated,
        simulated,
        modes,
        model,
        orbit,
        compared,
        fastest,
    ] = &blocks()[..]
    else {
        panic!("the page has other blocks of JSON");
    };
    let spec = "machines/double_pendulum.machine";

    let name = format!("lagrangian-{}-points.json", std::process::id());
    let path = std::env::temp_dir().join(name);
    std::fs::write(&path, format!("[{point}]")).expect("a temporary file");
    let results = printed(&["evaluate", spec, "--at", &path.to_string_lossy()]);
    let _ = std::fs::remove_file(&path); // a remaining file does no harm
    assert_eq!(keys(&results[0]), keys(evaluated));
    assert!(results[0]["accelerations"][1].is_f64());

    let summary = printed(&["simulate", spec, "--until", "0.1", "--json"]);
    assert_eq!(keys(&summary), keys(simulated));

    let found = printed(&["modes", spec, "--start", "theta1=0.1", "--json"]);
    assert_eq!(keys(&found), keys(modes));
    assert_eq!(keys(&found["equilibrium"]), keys(&modes["equilibrium"]));
    assert_eq!(keys(&found["modes"][0]), keys(&modes["modes"][0]));

    let found = printed(&["linearize", "machines/cart_pole.machine", "--json"]);
    assert_eq!(keys(&found), keys(model));
    assert_eq!(keys(&found["at"]), keys(&model["at"]));
    for (list, entry) in [
        ("states", "states"),
        ("eigenvalues", "eigenvalues"),
        ("outputs", "states"),
    ] {
        assert_eq!(keys(&found[list][0]), keys(&model[entry][0]));
    }

    let upright = [
        "orbit",
        "machines/kapitza_pendulum.machine",
        "--start",
        "theta=0",
    ];
    let found = printed(&[&upright[..], &["--period", "2*pi/omega", "--json"]].concat());
    assert_eq!(keys(&found), keys(orbit));
    assert_eq!(keys(&found["at"]), keys(&orbit["at"]));
    assert_eq!(
        keys(&found["multipliers"][0]),
        keys(&orbit["multipliers"][0])
    );

    let within = ["--until", "0.1", "--within", "1e-3", "--json"];
    let found = printed(&[&["compare", spec, spec][..], &within].concat());
    assert_eq!(keys(&found), keys(compared));
    assert_eq!(
        keys(&found["quantities"][0]),
        keys(&compared["quantities"][0])
    );

    let prisms = ["brachistochrone", "machines/prisms.machine"];
    let to = ["--natural", "--to", "q1=12,q2=6", "--json"];
    let found = printed(&[&prisms[..], &to].concat());
    assert_eq!(keys(&found), keys(fastest));
    assert_eq!(keys(&found["parameters"]), keys(&fastest["parameters"]));
    assert_eq!(keys(&found["path"][1]), keys(&fastest["path"][0]));
}
