//! Rolling resistance against closed forms: a torque of at most ρ times the normal force against the rate of rolling.

use serde_json::Value;

use crate::collisions::{close, events, is_good, number, simulate};
use crate::support::lagrangian;

const SPEC: &str = "machines/contacts/rolling_out.machine";

const G: f64 = 9.81;

/// With I = m r²/2 the torque ρ m g on a rolling disc gives ẍ = −2 ρ g/(3 r), until it rests after 3 v² r/(4 ρ g); its entire
/// energy, ¾ m v², is dissipated by then.
#[test]
fn a_disc_rolls_out() {
    let (m, r) = (2.0, 0.1);
    for (rho, speed) in [(0.004, 1.0), (0.001, 0.3), (0.02, -2.0_f64)] {
        let settings = [format!("rho={rho}"), format!("speed={speed}")];
        let settings: Vec<&str> = settings.iter().map(String::as_str).collect();
        let brakes = 2.0 / 3.0 * rho * G / r;
        let stops = speed.abs() / brakes;
        let run = simulate(SPEC, 1.5 * stops, &settings);
        is_good(&run);
        let way = 0.75 * speed * speed * r / (rho * G) * speed.signum();
        close(number(&run["q"]["x"]), way, 1e-11 * way.abs());
        close(number(&run["q"]["theta"]), -way / r, 1e-11 * way.abs() / r);
        // A sticking contact is held up to the rounding of its former rates.
        close(number(&run["v"]["x"]), 0.0, 1e-14 * speed.abs());
        close(number(&run["v"]["theta"]), 0.0, 1e-14 * speed.abs() / r);
        let rests = events(&run, "sticks");
        assert_eq!(rests.len(), 1, "{run:#}");
        assert_eq!(rests[0]["contact"], "floor.rolling");
        close(number(&rests[0]["t"]), stops, 1e-12 * (1.0 + stops));
        let had = 0.75 * m * speed * speed;
        close(number(&run["dissipated"]), had, 1e-11 * had);
        // The rolling direction has no impacts and neither closes nor lifts: these events belong to the contact.
        for kind in ["impact", "closes", "lifts"] {
            let own = events(&run, kind).into_iter();
            assert_eq!(
                own.filter(|event| event["contact"] == "floor.rolling")
                    .count(),
                0
            );
        }
    }
}

/// While the disc slips, friction and resistance act separately: v = v₀ − μ g t and r ω = 2 (μ − ρ/r) g t, so it rolls from t₁ =
/// v₀/(g (3 μ − 2 ρ/r)) on.
#[test]
fn a_disc_that_slips_is_turned_by_both() {
    let (r, mu, rho, speed) = (0.1, 0.3, 0.01, 3.0_f64);
    let rolls = speed / (G * (3.0 * mu - 2.0 * rho / r));
    let output = lagrangian(&[
        "simulate",
        SPEC,
        "--until",
        "0.9",
        "--json",
        "--tolerance",
        "1e-13",
        "--set",
        "mu=0.3",
        "--set",
        "rho=0.01",
        "--set",
        "speed=3",
        "--rate",
        "theta=0",
    ]);
    let run: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    is_good(&run);
    let sticks = events(&run, "sticks");
    // From rest it begins to turn at once, because friction exceeds the resistance, so the only stick event is that of the contact.
    assert_eq!(sticks.len(), 1, "{run:#}");
    assert_eq!(sticks[0]["contact"], "floor");
    close(number(&sticks[0]["t"]), rolls, 1e-12);
    let then = speed - mu * G * rolls;
    let after = then - 2.0 / 3.0 * rho * G / r * (0.9 - rolls);
    close(number(&run["v"]["x"]), after, 1e-12);
    close(number(&run["v"]["theta"]), -after / r, 1e-11);
}

/// On a slope a disc stays in place for tan α < ρ/r, and rolls with 2/3 (sin α − ρ/r cos α) g beyond that.
#[test]
fn a_slope_holds_a_disc_up_to_its_resistance() {
    let (r, rho) = (0.1, 0.004);
    let most = f64::atan(rho / r);
    for (share, moves) in [(0.999_f64, false), (1.001, true), (3.0, true)] {
        let slope = share * most;
        let run = simulate(SPEC, 2.0, &[&format!("slope={slope:?}"), "speed=0"]);
        is_good(&run);
        let rate = if moves {
            -2.0 / 3.0 * G * (slope.sin() - rho / r * slope.cos()) * 2.0
        } else {
            0.0
        };
        close(number(&run["v"]["x"]), rate, 1e-12);
        close(number(&run["q"]["x"]), rate, 1e-12);
    }
}

/// An impact has an angular impulse of at most ρ Λₙ in total: without friction, ω falls by 2 ρ (1 + e) v/r², and not below 0.
#[test]
fn an_impact_slows_a_spin() {
    let (r, rho, e, m) = (0.1, 0.004, 0.5, 2.0);
    for law in ["newton", "poisson_glocker"] {
        for spin in [-5.0, 5.0, 0.1_f64] {
            let text = std::fs::read_to_string(
                std::path::Path::new(env!("CARGO_MANIFEST_DIR"))
                    .join("..")
                    .join(SPEC),
            );
            let text = text
                .expect("spec")
                .replace("friction: mu,", &format!("law: {law}, friction: mu,"));
            let spec = crate::support::Scratch::new("spins.machine", &text);
            let height = 0.2;
            let falls = f64::sqrt(2.0 * height / G);
            let until = format!("{:?}", 1.5 * falls);
            let rate = format!("theta={spin}");
            let output = lagrangian(&[
                "simulate",
                spec.path(),
                "--until",
                &until,
                "--json",
                "--tolerance",
                "1e-13",
                "--set",
                "mu=0",
                "--set",
                "e=0.5",
                "--set",
                "h=0.2",
                "--set",
                "speed=0",
                "--rate",
                &rate,
            ]);
            let run: Value = serde_json::from_slice(&output.stdout).expect("JSON");
            is_good(&run);
            let speed = G * falls;
            let most: f64 = 2.0 * rho * (1.0 + e) * speed / (r * r);
            let after = f64::signum(spin) * (spin.abs() - most).max(0.0);
            close(number(&run["v"]["theta"]), after, 1e-11);
            let lost = 0.5 * m * speed * speed * (1.0 - e * e);
            let turning = 0.25 * m * r * r * (spin * spin - after * after);
            close(number(&run["impact_loss"]), lost + turning, 1e-12 * lost);
        }
    }
}

/// With time stepping the law holds in each step: while the disc rolls its rate is exact, and only the time of rest has an error
/// of one step.
#[test]
fn time_stepping_knows_it() {
    let (r, rho, speed, h) = (0.1, 0.004, 1.0, 1e-3);
    let brakes = 2.0 / 3.0 * rho * G / r;
    for (until, rate) in [(1.0, speed - brakes), (5.0, 0.0)] {
        let until = format!("{until:?}");
        let output = lagrangian(&[
            "simulate",
            SPEC,
            "--until",
            &until,
            "--json",
            "--method",
            "moreau",
            "--longest-step",
            "1e-3",
        ]);
        let run: Value = serde_json::from_slice(&output.stdout).expect("JSON");
        assert_eq!(run["error"], Value::Null, "{run:#}");
        close(number(&run["v"]["x"]), rate, 1e-11);
        if rate == 0.0 {
            let way = 0.75 * speed * speed * r / (rho * G);
            close(number(&run["q"]["x"]), way, brakes * h * h * 2.0 + 1e-11);
        }
    }
}

#[test]
fn what_resists_no_rolling_is_refused() {
    let refused = |from: &str, to: &str, words: &str| {
        let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR"))
            .join("..")
            .join(SPEC);
        let text = std::fs::read_to_string(path).expect("spec");
        assert!(text.contains(from));
        let spec = crate::support::Scratch::new("refused.machine", &text.replace(from, to));
        let output = lagrangian(&["check", spec.path()]);
        let said = String::from_utf8_lossy(&output.stderr).into_owned()
            + &String::from_utf8_lossy(&output.stdout);
        assert!(!output.status.success() && said.contains(words), "{said}");
    };
    refused(
        "friction: mu,",
        "friction: mu, law: stronge,",
        "`law: stronge` does not support `rolling_resistance`",
    );
    refused(
        "friction: mu,",
        "friction: mu, painleve: impact,",
        "`painleve: impact` does not support `rolling_resistance`",
    );
    refused("rho: m = 0.004", "rho: m = -0.004", "must not be negative");
    refused(
        "rolling_resistance: rho",
        "rolling_resistance: mu",
        "is a length, in m",
    );
    refused(
        "circle: rim, along: ground",
        "point: (0, -r), on: disc, along: ground",
        "`rolling_resistance`",
    );
}
