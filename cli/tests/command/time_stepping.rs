//! Moreau's time stepping against closed forms, and against runs that find every impact.

use serde_json::Value;

use crate::collisions::{close, events, number};
use crate::support::{Scratch, lagrangian};

/// A run by time stepping with steps of the length `h`.
pub fn step(spec: &str, until: f64, h: f64, more: &[&str]) -> Value {
    let (until, h) = (format!("{until:?}"), format!("{h:?}"));
    let mut arguments = vec!["simulate", spec, "--until", &until, "--json"];
    arguments.extend(["--method", "moreau", "--longest-step", &h]);
    arguments.extend(more);
    let output = lagrangian(&arguments);
    let text = String::from_utf8(output.stdout).expect("text");
    let said = String::from_utf8_lossy(&output.stderr);
    let run: Value = serde_json::from_str(&text).unwrap_or_else(|e| panic!("{e}: {text}{said}"));
    assert_eq!(run["error"], Value::Null, "{run:#}");
    run
}

/// A ball falls exactly, since gravity is constant; its impact is at most one step late, and its rate at impact at most g h too large. So after
/// the first bounce the error of its position is at most (1 + e) v h, plus the effect of the rate.
#[test]
fn a_ball_bounces_at_most_a_step_late() {
    let (e, g) = (0.8, 9.81_f64);
    let first = (2.0 / g).sqrt();
    let (t, speed) = (0.9, g * first);
    let after = e * speed * (t - first) - 0.5 * g * (t - first).powi(2);
    for h in [1e-2, 1e-3, 1e-4] {
        let run = step("machines/contacts/bouncing_ball.machine", t, h, &[]);
        let impacts = events(&run, "impact");
        assert_eq!(impacts.len(), 1);
        let [before, behind] = [0, 1].map(|part| number(&impacts[0]["gap_rate"][part]));
        assert!(
            (behind + e * before).abs() <= 1e-14 * speed,
            "{before} {behind}"
        );
        let late = number(&impacts[0]["t"]) - first;
        assert!((-h..=2.0 * h).contains(&late), "{late}");
        let bound = (1.0 + e) * (speed + g * h) * 2.0 * h + (1.0 + e) * g * h * (t - first);
        close(number(&run["q"]["y"]), after, bound);
    }
}

/// What moves by itself, a constraint or the place of a body, works also in a step with an impact, and that is counted once: the residual
/// decreases with the step, and the work approaches that of a run that finds every impact.
#[test]
fn what_moves_works_once_in_a_step_with_an_impact() {
    let bead = "machine Bead in plane {
        parameters { m: kg = 1, W: rad/s = 3, k: N/m = 20, l: m = 0.2, end: m = 0.6, g: m/s^2 = 9.81 }
        coordinates { x: m = 0.3, y: m, der(y): m/s = 0.9 }
        define { s = x*cos(W*t) + y*sin(W*t) }
        bodies { bead { mass: m, at: (x, y) } }
        gravity (0, -g);
        constraints { rod: x*sin(W*t) - y*cos(W*t) = 0 }
        springs { spring { stiffness: k, stretch: s - l } }
        contacts { stop { gap: end - s, restitution: 0.5 } }
    }";
    let shaken = "machine Shaken in plane {
        parameters { m: kg = 0.8, g: m/s^2 = 9.81, A: m = 0.03, B: m = 0.01, w: rad/s = 15 }
        coordinates { x: m, y: m = 0.02, der(x): m/s = -A*w, der(y): m/s = -2*B*w }
        bodies { block { mass: m, at: (x + A*sin(w*t), y + B*sin(2*w*t)) } }
        gravity (0, -g);
        contacts { plate { gap: y, slip: der(x), restitution: 0.3, friction: 0.25 } }
    }";
    for (text, until, within) in [(bead, 3.0, 0.1), (shaken, 1.5, 0.01)] {
        let spec = Scratch::new("moves.machine", text);
        let exact = crate::collisions::simulate(spec.path(), until, &[]);
        let run = step(spec.path(), until, 2.5e-4, &[]);
        close(number(&run["energy_residual"]), 0.0, within);
        close(number(&run["work"]), number(&exact["work"]), within);
        close(
            number(&run["dissipated"]),
            number(&exact["dissipated"]),
            within,
        );
    }
}

/// Without contacts the error decreases with the square of the step length.
#[test]
fn between_contacts_its_order_is_2() {
    let spec = Scratch::new(
        "swings.machine",
        "machine Swings in plane {
            parameters { m: kg = 1, l: m = 1, g: m/s^2 = 9.81 }
            coordinates { phi: rad = 1 }
            bodies { bob { mass: m, at: l*(sin(phi), -cos(phi)) } }
            gravity (0, -g);
            contacts { wall { gap: l*(2*rad - phi), restitution: 0.5 } }
        }",
    );
    let exact = lagrangian(&[
        "simulate",
        spec.path(),
        "--until",
        "1",
        "--json",
        "--tolerance",
        "1e-13",
    ]);
    let exact: Value = serde_json::from_slice(&exact.stdout).expect("JSON");
    let error = |h: f64| {
        let run = step(spec.path(), 1.0, h, &[]);
        number(&run["q"]["phi"]) - number(&exact["q"]["phi"])
    };
    let errors = [4e-3, 2e-3, 1e-3].map(error);
    // c h² + d h³ + …: the quotients approach 4, and the second is half as far from it as the first.
    let [first, second] = [errors[0] / errors[1], errors[1] / errors[2]];
    assert!(
        (second - 4.0).abs() < 0.04 && (first - 4.0).abs() < 0.08,
        "{errors:?}"
    );
}

/// Without friction and with e = 1, no impact changes the energy, however many bodies collide: 0 ≤ Λ ⊥ γ⁺ + γ⁻ ≥ 0 implies Λ·(γ⁺ + γ⁻) = 0.
/// Without gravity the energy is constant up to round-off for any step length.
#[test]
fn elastic_discs_keep_their_energy_to_rounding() {
    let run = step(
        "machines/contacts/pile.machine",
        4.0,
        5e-3,
        &[
            "--const",
            "N=6",
            "--set",
            "g=0",
            "--set",
            "e=1",
            "--set",
            "mu=0",
            "--rate",
            "x[1]=1",
            "--rate",
            "y[2]=-0.7",
            "--rate",
            "x[4]=0.3",
        ],
    );
    let impacts = events(&run, "impact").len();
    assert!(impacts > 20, "{impacts}");
    let energy = 0.5 * 0.05 * (1.0 + 0.49 + 0.09);
    let v = run["v"].as_object().expect("rates");
    let of = |name: &str, mass: f64| -> f64 {
        let own = v.iter().filter(|(key, _)| key.starts_with(name));
        own.map(|(_, rate)| 0.5 * mass * number(rate).powi(2)).sum()
    };
    let now = of("x[", 0.05) + of("y[", 0.05) + of("theta[", 0.5 * 0.05 * 0.0025);
    // A few roundings of the rates at each impact.
    close(
        now,
        energy,
        64.0 * f64::EPSILON * energy * (impacts + 10) as f64,
    );
}

/// Discs that fall into a bowl come to rest without penetrating each other, and the energy balance contains all their energy. Sticking is
/// exact: at the end the rates are round-off.
#[test]
fn a_pile_comes_to_rest() {
    let table = Scratch::new("pile.csv", "");
    std::fs::remove_file(table.path()).expect("removed");
    let run = step(
        "machines/contacts/pile.machine",
        6.0,
        2e-3,
        &["--const", "N=8", "--every", "0.02", "--out", table.path()],
    );
    for (name, rate) in run["v"].as_object().expect("rates") {
        assert!(number(rate).abs() <= 1e-12, "der({name}) = {rate}");
    }
    let text = std::fs::read_to_string(table.path()).expect("table");
    let mut lines = text.lines();
    let names: Vec<&str> = lines.next().expect("header").split(',').collect();
    let gaps: Vec<usize> = (0..names.len())
        .filter(|k| names[*k].contains("gap("))
        .collect();
    assert!(gaps.len() >= 8 + 28, "{names:?}");
    let mut pressed = 0.0_f64;
    for line in lines {
        let row: Vec<f64> = line
            .split(',')
            .map(|x| x.parse().expect("number"))
            .collect();
        for &k in &gaps {
            // The gap is accurate to about 1e-12 of its terms, which are at most 1 m.
            assert!(row[k] > -4e-12, "{} = {} at {}", names[k], row[k], row[0]);
        }
        let normal = (0..names.len()).filter(|k| names[*k].contains("normal("));
        pressed = pressed.max(normal.map(|k| row[k]).fold(0.0, f64::max));
    }
    assert!(pressed > 8.0 * 0.05 * 9.81, "{pressed}");
    // Gravity and masses are constant, so steps change the energy only by impulses, and the balance closes up to some roundings of the
    // energies per step.
    let lost = number(&run["impact_loss"]);
    let (residual, steps) = (number(&run["energy_residual"]), number(&run["steps"]));
    assert!(
        lost > 0.0 && residual.abs() <= 16.0 * f64::EPSILON * steps * lost,
        "{lost} {residual}"
    );
}

/// A disc with friction slips, and then rolls at two thirds of its initial rate. The law of friction is exact during slipping and sticking;
/// only the transition has an error of one step.
#[test]
fn a_disc_slides_until_it_rolls() {
    let spec = Scratch::new(
        "rolls.machine",
        "machine Rolls in plane {
            parameters { m: kg = 2, r: m = 0.1, mu: 1 = 0.2, g: m/s^2 = 9.81 }
            coordinates { x: m, y: m = 0.1, theta: rad }
            bodies { disc { mass: m, inertia: m*r^2/2, at: (x, y), angle: theta } }
            circles { rim { on: disc, center: (0, 0), radius: r } }
            gravity (0, -g);
            contacts { floor { circle: rim, along: ground, restitution: 0, friction: mu } }
        }",
    );
    // While it slips, v = v₀ − μ g t and r ω = 2 μ g t, so it rolls from t₁ = v₀/(3 μ g) on, at 2 v₀/3.
    let (v0, mu, g, r) = (1.5, 0.2, 9.81, 0.1);
    let h = 1e-3;
    let run = step(spec.path(), 1.0, h, &["--rate", "x=1.5"]);
    let rolls = 2.0 / 3.0 * v0;
    // The angular momentum about a point of the floor is conserved, so the rate is exact up to round-off for any step length.
    close(number(&run["v"]["x"]), rolls, 1e-12);
    close(number(&run["v"]["theta"]), -rolls / r, 1e-11);
    let slips = v0 / (3.0 * mu * g);
    let way = v0 * slips - 0.5 * mu * g * slips * slips + rolls * (1.0 - slips);
    close(number(&run["q"]["x"]), way, 3.0 * mu * g * h);
    let sticks = events(&run, "sticks");
    assert_eq!(sticks.len(), 1, "{run:#}");
    close(number(&sticks[0]["t"]), slips, 2.0 * h);
}

#[test]
fn what_time_stepping_does_not_know_is_refused() {
    let said = |arguments: &[&str]| {
        let output = lagrangian(arguments);
        assert!(!output.status.success());
        String::from_utf8(output.stderr).expect("text")
    };
    let ball = "machines/contacts/bouncing_ball.machine";
    let without = said(&["simulate", ball, "--until", "1", "--method", "moreau"]);
    assert!(without.contains("--longest-step"), "{without}");
    let woodpecker = "machines/contacts/layered_crusher.machine";
    let yields = said(&[
        "simulate",
        woodpecker,
        "--until",
        "1e-2",
        "--method",
        "moreau",
        "--longest-step",
        "1e-3",
    ]);
    assert!(
        yields
            .contains("`moreau` supports rigid contacts, with any law, and none with `compliance`"),
        "{yields}"
    );
    let rows = std::env::temp_dir().join("stepped_rows.csv");
    let rows = rows.to_str().expect("a path");
    let arguments = [
        "sweep",
        ball,
        "--until",
        "1",
        "--method",
        "moreau",
        "--vary",
        "e=0.1..0.9:3",
        "--out",
        rows,
    ];
    let sweep = said(&arguments);
    assert!(sweep.contains("fixed length"), "{sweep}");
}

fn auto(spec: &str, until: &str, more: &[&str]) -> Value {
    let mut arguments = vec!["simulate", spec, "--until", until, "--json"];
    arguments.extend(more);
    let output = lagrangian(&arguments);
    let text = String::from_utf8(output.stdout).expect("text");
    let said = String::from_utf8_lossy(&output.stderr);
    let run: Value = serde_json::from_str(&text).unwrap_or_else(|e| panic!("{e}: {text}{said}"));
    assert_eq!(run["error"], Value::Null, "{run:#}");
    run
}

/// The woodpecker changes its contacts ten times per beat indefinitely, at some instants with its spring at rest: that is not often, whatever
/// the run's length, so the run continues by events. After 60 beats it is on its cycle, whose period is from `orbit/woodpecker.py`. Deviations
/// of its start, 2 ‰ of a period, are multiplied by 0.839 in each beat, to below 1e-7 of it.
#[test]
fn a_run_that_goes_on_for_long_goes_on_by_events() {
    for until in ["9", "40"] {
        let run = auto("machines/contacts/woodpecker.machine", until, &[]);
        assert_eq!(run["handovers"], Value::Null, "{until}");
        let pecks = events(&run, "impact").into_iter();
        let pecks = pecks.filter(|impact| impact["contact"] == "beak");
        let pecks: Vec<f64> = pecks.map(|impact| number(&impact["t"])).collect();
        assert!(pecks.len() > 60, "{}", pecks.len());
        close(pecks[60] - pecks[59], 0.145_976_065_143_751_8, 1.5e-8);
    }
}

/// Without any option discs fall into a bowl and come to rest. Where contacts become too frequent, the run continues by time stepping, and
/// reports when, with which step, and that the error is not bounded. The energy balance closes as for time stepping.
#[test]
fn a_run_hands_over_where_discs_pile_up() {
    let run = auto("machines/contacts/pile.machine", "6", &["--const", "N=8"]);
    close(number(&run["t"]), 6.0, 0.0);
    let handovers = run["handovers"].as_array().expect("handovers");
    assert_eq!(handovers[0]["to"], "moreau", "{handovers:#?}");
    let (t, step) = (number(&handovers[0]["t"]), number(&handovers[0]["step"]));
    // A disc falls to the bottom within √(2·0.45/g) ≈ 0.30 s, at 3 m/s, and gravity takes the same time to stop such a speed; the step is a
    // 256th of it.
    assert!(
        t > 0.1 && t < 1.5 && step > 1e-4 && step < 2e-3,
        "{t} {step}"
    );
    let warnings = run["warnings"].as_array().expect("warnings");
    let said = warnings.iter().filter_map(Value::as_str);
    let said: Vec<&str> = said
        .filter(|said| said.contains("time stepping in steps of"))
        .collect();
    assert!(
        said.len() == 1 && said[0].contains("is not controlled"),
        "{warnings:?}"
    );
    for (name, rate) in run["v"].as_object().expect("rates") {
        assert!(number(rate).abs() <= 1e-9, "der({name}) = {rate}");
    }
    let lost = number(&run["impact_loss"]);
    // Before the change the energy balance closes to the tolerance of 1e-9, after it to round-off.
    assert!(
        lost > 0.0 && number(&run["energy_residual"]).abs() < 1e-7 * lost,
        "{run:#}"
    );
    // At rest steps become longer: 6 s in steps of the initial length would be 10 times as many.
    assert!(number(&run["steps"]) < 6.0 / step, "{}", run["steps"]);
}

/// A pile at rest takes long steps. Its discs share their load in many ways and its slips are rounding, whose signs decide nothing: before they were known to
/// be rounding contacts changed every 1.2 ms, some 25 000 times in 30 s.
#[test]
fn a_pile_at_rest_takes_long_steps() {
    let discs = ["--const", "N=8", "--set", "d=0.0701728813559322"];
    let run = auto("machines/contacts/pile.machine", "30", &discs);
    for (name, rate) in run["v"].as_object().expect("rates") {
        assert!(number(rate).abs() <= 1e-9, "der({name}) = {rate}");
    }
    // It comes to rest within a second. Steps of 10 ms would make 3000.
    assert!(number(&run["steps"]) < 1500.0, "{}", run["steps"]);
}

/// Where nothing piles up a run by `auto` is that of `dop853`, to the bit.
#[test]
fn a_run_that_finds_every_event_stays_as_it_is() {
    for (spec, until) in [
        ("machines/contacts/bouncing_ball.machine", "5"),
        ("machines/contacts/rocking_block.machine", "4"),
        ("machines/contacts/colliding_crusher.machine", "0.5"),
    ] {
        let [mut one, mut other] =
            [&[][..], &["--method", "dop853"][..]].map(|more| auto(spec, until, more));
        assert_eq!(one["handovers"], Value::Null);
        for run in [&mut one, &mut other] {
            run["seconds"] = Value::Null;
            // Only a run that may choose its method reports its choice.
            run["methods"] = Value::Null;
        }
        assert_eq!(one, other);
    }
}

/// Contacts whose law time stepping does not support are followed by events, whatever the options.
#[test]
fn a_law_that_time_stepping_does_not_know_is_not_handed_over() {
    let run = auto(
        "machines/contacts/newtons_cradle.machine",
        "1.5",
        &["--method", "auto"],
    );
    assert_eq!(run["handovers"], Value::Null);
}

/// A run whose last step of time stepping is longer than the others by less than a hundredth, so that no tiny step remains, ends: such a step was taken for one
/// that had been lengthened at rest, and was taken again for ever. The step is known from another run, and the end is in the middle of a hundredth of it.
#[test]
fn a_last_step_that_is_a_little_longer_ends_the_run() {
    let spec = Scratch::new(
        "heap.machine",
        "machine Heap in plane {
            parameters { m: kg = 0.05, r: m = 0.05, d: m = 0.12, R: m = 0.4, e: 1 = 0.3, mu: 1 = 0.3, g: m/s^2 = 9.81 }
            coordinates {
                x[i in 1..7]: m = d*sqrt(i)*cos(2.4*i*rad),
                y[i in 1..7]: m = d*sqrt(i)*sin(2.4*i*rad),
                theta[i in 1..7]: rad,
            }
            bodies { disc[i in 1..7] { mass: m, inertia: m*r^2/2, at: (x[i], y[i]), angle: theta[i] } }
            circles {
                bowl { on: ground, center: (0, 0), radius: R },
                rim[i in 1..7] { on: disc[i], center: (0, 0), radius: r },
            }
            gravity (0, -g);
            contacts {
                wall[i in 1..7] { circle: rim[i], inside: bowl, restitution: e, friction: mu },
                pair { circles: rim, restitution: e, friction: mu },
            }
        }",
    );
    let known = auto(spec.path(), "0.5", &[]);
    let handover = &known["handovers"][0];
    let (t, h) = (number(&handover["t"]), number(&handover["step"]));
    for steps in [1.0, 40.0, 120.0, 121.0, 122.0] {
        let until = t + (steps + 0.005) * h;
        let run = auto(spec.path(), &format!("{until:?}"), &[]);
        close(number(&run["t"]), until, 1e-12);
    }
}

/// A ceiling comes down on a block that lies on the floor: no rate of the block keeps both contacts from closing further, so that there are no impulses of both. In the step in which the
/// ceiling reaches the block, behind its middle, only the floor gives one, and a warning says so; the block stays where it is.
#[test]
fn contacts_that_are_left_out_of_a_step_are_named() {
    let spec = Scratch::new(
        "pressed.machine",
        "machine Pressed in plane {
            coordinates { y: m }
            bodies { block { mass: 2, at: (0, y) } }
            gravity (0, -9.81);
            contacts {
                floor { gap: y, restitution: 0 },
                ceiling { gap: 0.115*m - (1*m/s)*t - y, restitution: 0.5 },
            }
        }",
    );
    let said = |until: f64| {
        let run = step(spec.path(), until, 0.03, &[]);
        assert!(number(&run["q"]["y"]).abs() <= 1e-15, "{run:#}");
        let warnings = run["warnings"].as_array().expect("warnings");
        let said = warnings.iter().filter_map(Value::as_str);
        let said = said.filter(|said| said.contains("no impulses of all contacts"));
        said.map(str::to_owned).collect::<Vec<_>>()
    };
    // The ceiling is 5 mm below the block at the end of the fourth step, and 10 mm above it in its middle.
    assert_eq!(said(0.09), [""; 0]);
    let [said] = &said(0.12)[..] else {
        panic!("one step is told");
    };
    assert!(
        said.contains("t = 0.12 s")
            && said.contains("and not `ceiling`")
            && !said.contains("there were"),
        "{said}"
    );
}
