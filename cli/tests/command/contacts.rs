//! The results of runs about rolling contacts: whether the normal force is compressive, and how much
//! friction they need.

use crate::support::{Scratch, lagrangian, number};
use serde_json::Value;

fn json(arguments: &[&str]) -> Value {
    let output = lagrangian(arguments);
    let text = String::from_utf8(output.stdout).expect("text");
    serde_json::from_str(&text).unwrap_or_else(|error| panic!("{error}: {text}"))
}

fn warnings(run: &Value) -> String {
    let warnings = run["warnings"].as_array().expect("a list").iter();
    warnings
        .map(|warning| warning.as_str().expect("text"))
        .collect::<Vec<_>>()
        .join("\n")
}

/// A disc that starts at rest beside the top of a drum, at the angle `psi` from the horizontal.
fn on_a_drum(friction: &str) -> String {
    format!(
        "machine Drum in plane {{
            parameters {{ m: kg = 2, R: m = 0.5, r: m = 0.1, mu: 1 = 0.2, g: m/s^2 = 9.81 }}
            coordinates {{ u: m = R + r, psi: rad = 1.4, alpha: rad }}
            bodies {{ disc {{ mass: m, inertia: m*r^2/2, at: polar(u, psi), angle: alpha }} }}
            gravity (0, -g);
            circles {{
                drum {{ on: ground, center: (0, 0), radius: R }},
                rim {{ on: disc, center: (0, 0), radius: r }},
            }}
            rolling {{ on_drum {{ circle: rim, outside: drum{friction} }} }}
        }}"
    )
}

/// By the energy, `¾ (R + r) φ̇² = g (cos φ₀ − cos φ)` from the vertical, so `N = m g (7 cos φ − 4 cos φ₀)/3`
/// and `T = m g sin φ/3` as long as the disc is on the drum.
#[test]
fn a_disc_leaves_a_drum_where_seven_cosines_are_four() {
    let spec = Scratch::new("drum.machine", &on_a_drum(", friction: mu"));
    let until = |t: f64| {
        let t = format!("{t:?}");
        json(&[
            "simulate",
            spec.path(),
            "--until",
            &t,
            "--tolerance",
            "1e-12",
            "--json",
        ])
    };
    let run = until(1.0);
    let contact = &run["contacts"][0];
    assert_eq!(contact["name"], "on_drum");
    assert_eq!(number(&contact["friction"]), 0.2);
    assert_eq!(contact["friction_needed"], Value::Null);
    let start = std::f64::consts::FRAC_PI_2 - 1.4;
    let angle_at = |t: f64| std::f64::consts::FRAC_PI_2 - number(&until(t)["q"]["psi"]);

    // The instant is found to round-off of time, the motion to ten digits.
    let leaves = angle_at(number(&contact["pulls_from"])).abs();
    assert!((7.0 * leaves.cos() - 4.0 * start.cos()).abs() < 1e-9);
    let slips = angle_at(number(&contact["slips_from"])).abs();
    let needed = slips.sin() / (7.0 * slips.cos() - 4.0 * start.cos());
    assert!((needed - 0.2).abs() < 1e-9, "{needed}");
    let said = warnings(&run);
    assert!(
        said.contains("the contact `on_drum` pulls from t = "),
        "{said}"
    );
    assert!(
        said.contains("needs more friction than its 0.2 from t = "),
        "{said}"
    );

    // Events of contacts are not listed as events of the machine.
    assert_eq!(run["events"], serde_json::json!([]));
    // Before that there is no warning.
    let before = until(0.9 * number(&contact["slips_from"]));
    assert_eq!(warnings(&before), "");
    assert_eq!(before["contacts"][0]["pulls_from"], Value::Null);
    assert_eq!(before["contacts"][0]["slips_from"], Value::Null);
}

/// For a cylinder that swings in another up to the angle a, the required friction is greatest there: with β =
/// J/(m r²), `N = m g (cos φ + 2 (cos φ − cos a)/(1 + β))` and `T = β m g sin φ/(1 + β)`.
#[test]
fn a_cylinder_that_swings_needs_most_friction_where_it_turns_round() {
    let beta = 9.225 / (180.0 * 0.25_f64.powi(2));
    let most = beta / (1.0 + beta) * 1.0_f64.tan();
    let (s, g) = (0.27 - 0.25, 9.81);
    let rate = (2.0 * g * (1.0 - 1.0_f64.cos()) / (s * (1.0 + beta))).sqrt();
    let (around, turning) = (format!("phi={rate}"), format!("theta={}", -s / 0.25 * rate));
    let machine = "machines/rolling_cylinder.machine";
    let run = json(&[
        "simulate", machine, "--until", "0.39", "--start", "phi=0", "--rate", &around, "--rate",
        &turning, "--json",
    ]);
    let contact = &run["contacts"][0];
    assert_eq!(contact["friction"], Value::Null);
    assert_eq!(contact["pulls_from"], Value::Null);
    let needed = number(&contact["friction_needed"]);
    // Between samples the maximum is that of a parabola.
    assert!((needed - most).abs() < 2e-3 * most, "{needed} {most}");
    let quarter = 0.408_121_442_879_583_4 / 4.0;
    let at = number(&contact["friction_needed_at"]) / quarter;
    assert!((at - 1.0).abs() < 0.02 || (at - 3.0).abs() < 0.02, "{at}");
    assert_eq!(warnings(&run), "");
    // At rest at the turning point of its swing.
    let point = json(&["evaluate", machine]);
    let contact = &point[0]["contacts"]["contact"];
    let weight = 180.0 * g;
    assert!((number(&contact["normal"]) - weight * 1.0_f64.cos()).abs() < 1e-12 * weight);
    assert!((number(&contact["friction_needed"]) - most).abs() < 1e-12);
}

/// Section 1.4 of the reference problems: mortar and cylinder pull on each other at the start, and the force
/// between them changes its sign within a revolution of the debalance.
#[test]
fn the_crush_process_would_open_its_contacts_within_a_revolution() {
    let machine = "machines/crushing_crusher.machine";
    let table = Scratch::new("crushing.csv", "");
    let run = json(&[
        "simulate",
        machine,
        "--until",
        "0.04",
        "--out",
        table.path(),
        "--json",
    ]);
    for (contact, name) in ["mortar_in_cylinder", "pestle_in_mortar"]
        .iter()
        .enumerate()
    {
        let found = &run["contacts"][contact];
        assert_eq!(found["name"], *name);
        assert_eq!(number(&found["pulls_from"]), 0.0);
    }
    let said = warnings(&run);
    assert!(
        said.contains("`mortar_in_cylinder` pulls from t = 0 s"),
        "{said}"
    );
    let text = std::fs::read_to_string(table.path()).expect("a table");
    let mut lines = text.lines();
    let mut head = lines.next().expect("a head").split(',');
    let column = head.position(|name| name.starts_with("multiplier(mortar_in_cylinder.gap)"));
    let column = column.expect("the force");
    let force = |line: &str| -> f64 {
        line.split(',')
            .nth(column)
            .expect("a cell")
            .parse()
            .expect("a number")
    };
    let forces: Vec<f64> = lines.map(force).collect();
    assert!((forces[0] + 19788.647529422462).abs() < 1e-6);
    assert!(forces.iter().any(|force| *force > 0.0));
}

#[test]
fn what_does_not_roll_has_no_contacts() {
    let machine = "machines/simple_pendulum.machine";
    let run = json(&["simulate", machine, "--until", "0.1", "--json"]);
    assert!(run.get("contacts").is_none());
    assert!(json(&["evaluate", machine])[0].get("contacts").is_none());
}
