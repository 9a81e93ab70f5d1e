//! Compliant contacts against closed forms.

use std::f64::consts::PI;

use serde_json::Value;

use crate::collisions::{close, events, is_good, number, simulate};
use crate::support::{Scratch, lagrangian};

/// A mass that flies into a compliant wall at x = −1 m, with 3 m/s.
fn into_a_wall(parameters: &str, law: &str, until: f64) -> Value {
    let spec = Scratch::new(
        "wall.machine",
        &format!(
            "machine Wall in plane {{
                parameters {{ m: kg = 2, {parameters} }}
                coordinates {{ x: m = -1, der(x): m/s = 3 }}
                bodies {{ block {{ mass: m, at: (x, 0) }} }}
                contacts {{ wall {{ gap: -x, compliance: {law} }} }}
            }}"
        ),
    );
    let run = simulate(spec.path(), until, &[]);
    is_good(&run);
    run
}

/// The times at which the contact closes and opens.
fn touches(run: &Value) -> [f64; 2] {
    ["closes", "opens"].map(|kind| {
        let found = events(run, kind);
        assert_eq!(found.len(), 1, "{kind}: {run:#}");
        number(&found[0]["t"])
    })
}

/// With ζ = b/(2 √(k m)) = sin φ, the force reaches zero after (π − 2 φ)/(ω cos φ), with exp(−(π − 2 φ) tan φ) of the
/// initial speed. (T. Schwager, T. Pöschel, Granular Matter 9 (2007) 465–469.)
#[test]
fn a_spring_with_a_damper_bounces_as_its_damping_says() {
    for (b, phi) in [(0.0, 0.0), (40.0, 0.5_f64.asin()), (72.0, 0.9_f64.asin())] {
        let parameters = format!("k: N/m = 800, b: N*s/m = {b}");
        let run = into_a_wall(&parameters, "linear(k, b)", 1.0);
        let [closes, opens] = touches(&run);
        close(closes, 1.0 / 3.0, 1e-14);
        close(opens - closes, (PI - 2.0 * phi) / (20.0 * phi.cos()), 1e-11);
        let left = 3.0 * (-(PI - 2.0 * phi) * phi.tan()).exp();
        close(number(&run["v"]["x"]), -left, 1e-10);
        close(number(&run["energy_residual"]), 0.0, 1e-10);
        // The dissipation of the damper, and the energy left in the spring when the force reached zero.
        let lost = 9.0 - left * left;
        close(number(&run["dissipated"]), lost, 1e-9);
    }
}

/// A Hertzian contact lasts 2.943275 d/v with d = (5 m v²/(4 K))^(2/5), and returns all its energy.
#[test]
fn a_hertzian_contact_lasts_as_long_as_hertz_says() {
    let run = into_a_wall("K: N/m^(3/2) = 3e5", "hertz(K)", 0.5);
    let [closes, opens] = touches(&run);
    let (m, v, k) = (2.0_f64, 3.0_f64, 3e5_f64);
    let lasts = 3.218_065_459_719_045 * (m * m / (k * k * v)).powf(0.2);
    close(opens - closes, lasts, 1e-10);
    close(number(&run["v"]["x"]), -3.0, 1e-10);
    close(number(&run["energy_residual"]), 0.0, 1e-10);
}

/// From m v dv = −K d^(3/2) (1 + c v) dd, the speeds v before and w after obey c v − ln(1 + c v) = −c w − ln(1 − c w).
#[test]
fn hunt_and_crossleys_contact_leaves_the_speed_of_its_closed_form() {
    let run = into_a_wall(
        "K: N/m^(3/2) = 3e5, c: s/m = 0.2",
        "hunt_crossley(K, c)",
        0.5,
    );
    let (c, v) = (0.2_f64, 3.0_f64);
    let w = -number(&run["v"]["x"]);
    let side = |x: f64| x - x.ln_1p();
    close(side(c * v), side(-c * w), 1e-11);
    assert!(w > 1.5 && w < 2.5, "{w}");
    close(number(&run["dissipated"]), v * v - w * w, 1e-9);
    close(number(&run["energy_residual"]), 0.0, 1e-10);
}

/// A crushable layer is loaded for a quarter of a period of k₁ and unloaded for one of k₂. The speed after it is √(k₁/k₂)
/// of that before, and the layer is thinner by d (1 − k₁/k₂). A slower second impact does not crush it again.
#[test]
fn a_layer_is_crushed_once() {
    let spec = Scratch::new(
        "layer.machine",
        "machine Bed in plane {
            parameters { m: kg = 2, k1: N/m = 800, k2: N/m = 3200 }
            coordinates { x: m = -1, der(x): m/s = 3 }
            bodies { block { mass: m, at: (x, 0) } }
            contacts {
                bed { gap: -x, compliance: layer(k1, k2) },
                wall { gap: x + 2, restitution: 1 },
            }
        }",
    );
    let run = simulate(spec.path(), 5.0, &[]);
    is_good(&run);
    let times = |kind| -> Vec<f64> {
        let all = events(&run, kind);
        all.iter().map(|event| number(&event["t"])).collect()
    };
    let (closes, turns, opens) = (times("closes"), times("turns"), times("opens"));
    let deepest = 3.0 * (2.0_f64 / 800.0).sqrt();
    close(closes[0], 1.0 / 3.0, 1e-14);
    close(turns[0] - closes[0], PI / 2.0 / 20.0, 1e-12);
    close(opens[0] - turns[0], PI / 2.0 / 40.0, 1e-12);
    let lost = 0.75 * deepest;
    close(number(&events(&run, "opens")[0]["q"]["x"]), lost, 1e-12);
    // The mass flies to the elastic wall and back, and is reversed by the elastic part of the layer.
    close(closes[1] - opens[0], 2.0 * (2.0 + lost) / 1.5, 1e-11);
    close(opens[1] - closes[1], PI / 40.0, 1e-11);
    // It penetrates as deep as before, and no deeper.
    assert!(times("crushes").is_empty());
    close(number(&run["v"]["x"]).abs(), 1.5, 1e-11);
    let crushing = 9.0 * 0.75;
    close(number(&run["crushing_work"]), crushing, 1e-11);
    close(
        number(&run["unilateral_contacts"][0]["crushing_work"]),
        crushing,
        1e-11,
    );
    close(number(&run["dissipated"]), crushing, 1e-11);
    close(number(&run["energy_residual"]), 0.0, 1e-11);
}

/// A force that grows from beat to beat drives a plate into a layer: each beat crushes it further from where the previous
/// one ended, and the total crushing is a function of the greatest depth.
#[test]
fn a_layer_is_crushed_further_from_its_greatest_depth() {
    let spec = Scratch::new(
        "beats.machine",
        "machine Beats in plane {
            parameters { m: kg = 2, k1: N/m = 800, k2: N/m = 3200, f: N/s = 40, w: rad/s = 3 }
            coordinates { x: m }
            bodies { plate { mass: m, at: (x, 0) } }
            dampers { guide { damping: 20, stretch: x } }
            forces { drive { on: x, value: f*t*sin(w*t) } }
            contacts { bed { gap: -x, compliance: layer(k1, k2) } }
            outputs { depth: m = x }
        }",
    );
    let run = simulate(spec.path(), 12.0, &[]);
    is_good(&run);
    let (turns, crushes) = (events(&run, "turns"), events(&run, "crushes"));
    assert!(crushes.len() >= 4, "{run:#}");
    // Crushing continues at the depth of the previous turning point.
    let mut deepest = 0.0_f64;
    for crushed in &crushes {
        let t = number(&crushed["t"]);
        let before = turns.iter().rfind(|turn| number(&turn["t"]) < t);
        let before = before.expect("it turned before");
        close(number(&crushed["q"]["x"]), number(&before["q"]["x"]), 1e-12);
    }
    for turn in &turns {
        close(number(&turn["v"]["x"]), 0.0, 1e-10);
        deepest = deepest.max(number(&turn["q"]["x"]));
    }
    let crushing = 0.5 * 800.0 * 0.75 * deepest * deepest;
    close(number(&run["crushing_work"]), crushing, 1e-10 * crushing);
    close(number(&run["energy_residual"]), 0.0, 1e-9);
}

/// On a compliant floor a disc slides until it rolls: at 2/3 of its speed, after v/(3 μ g), exactly and without the creep
/// of friction laws without sticking. Its depth is the static one under its weight, and is constant.
#[test]
fn friction_of_a_floor_that_yields_is_coulombs() {
    let spec = Scratch::new(
        "disc.machine",
        "machine Disc in plane {
            parameters { m: kg = 2, r: m = 0.1, mu: 1 = 0.2, g: m/s^2 = 9.81, K: N/m^(3/2) = 1e7 }
            coordinates { x: m, y: m = r - (m*g/K)^(2/3), theta: rad, der(x): m/s = 3 }
            bodies { disc { mass: m, inertia: m*r^2/2, at: (x, y), angle: theta } }
            gravity (0, -g);
            circles { rim { on: disc, center: (0, 0), radius: r } }
            contacts { floor { circle: rim, along: ground, compliance: hertz(K), friction: mu } }
        }",
    );
    let run = simulate(spec.path(), 2.0, &[]);
    is_good(&run);
    let sticks = events(&run, "sticks");
    assert_eq!(sticks.len(), 1, "{run:#}");
    // The weight is balanced up to round-off, which excites an oscillation about the equilibrium.
    close(number(&sticks[0]["t"]), 3.0 / (3.0 * 0.2 * 9.81), 1e-10);
    close(number(&run["v"]["x"]), 2.0, 1e-10);
    close(number(&run["v"]["theta"]), -20.0, 1e-9);
    close(number(&run["energy_residual"]), 0.0, 1e-9);
}

/// What rests on a floor that yields holds the energy ½ (m g)²/k in it from the start, and loses nothing.
#[test]
fn what_is_pressed_at_the_start_holds_its_energy_there() {
    let spec = Scratch::new(
        "resting.machine",
        "machine Resting in plane {
            parameters { m: kg = 2, k: N/m = 1000, b: N*s/m = 5, g: m/s^2 = 9.81 }
            inputs { F: N }
            coordinates { y: m = -m*g/k }
            bodies { block { mass: m, at: (0, y) } }
            gravity (0, -g);
            forces { push { at: (0, y), force: (0, F) } }
            contacts { floor { gap: y, compliance: linear(k, b) } }
        }",
    );
    let sampled = ["--input", "F=0*N,every=10*ms"];
    for options in [&[][..], &sampled[..]] {
        for until in ["0", "1"] {
            let mut arguments = vec!["simulate", spec.path(), "--until", until, "--json"];
            arguments.extend(options);
            let output = lagrangian(&arguments);
            let text = String::from_utf8(output.stdout).expect("text");
            let run: Value = serde_json::from_str(&text).expect("a document");
            is_good(&run);
            close(number(&run["dissipated"]), 0.0, 1e-12);
            close(number(&run["damping_loss"]), 0.0, 1e-12);
            let own = &run["unilateral_contacts"][0];
            close(number(&own["damping_loss"]), 0.0, 1e-12);
        }
    }
    // From rest at twice this depth, until it rests: the damper takes ½ k (m g/k)².
    let output = lagrangian(&[
        "simulate",
        spec.path(),
        "--until",
        "16",
        "--start",
        "y=-0.03924",
        "--json",
    ]);
    let text = String::from_utf8(output.stdout).expect("text");
    let run: Value = serde_json::from_str(&text).expect("a document");
    is_good(&run);
    let lost = 0.5 * (2.0 * 9.81_f64).powi(2) / 1000.0;
    close(number(&run["damping_loss"]), lost, 1e-8);
    close(number(&run["dissipated"]), lost, 1e-8);
}

/// A moving compliant wall does work on the ball, and the energy balance includes it.
#[test]
fn a_wall_that_yields_and_moves_works() {
    let spec = Scratch::new(
        "box.machine",
        "machine Shaken in plane {
            parameters { m: kg = 0.1, l: m = 0.05, A: m = 0.01, w: rad/s = 40, k: N/m = 2e4, b: N*s/m = 2 }
            coordinates { x: m = 0.01, der(x): m/s = 0.3 }
            bodies { ball { mass: m, at: (x, 0) } }
            contacts {
                left  { gap: x - A*sin(w*t) + l, compliance: linear(k, b) },
                right { gap: l - x + A*sin(w*t), restitution: 0.9 },
            }
        }",
    );
    let run = simulate(spec.path(), 2.0, &[]);
    is_good(&run);
    assert!(events(&run, "opens").len() > 5);
    assert!(events(&run, "impact").len() > 5);
    close(number(&run["energy_residual"]), 0.0, 1e-10);
}

/// A layer in the bore of the crusher: the work of crushing is the energy that no impact and no damper dissipated, and
/// the balance closes.
#[test]
fn the_crusher_crushes_a_layer() {
    let run = simulate("machines/contacts/layered_crusher.machine", 0.2, &[]);
    is_good(&run);
    assert!(number(&run["crushing_work"]) > 1.0, "{run:#}");
    let dissipated = number(&run["dissipated"]);
    let known = number(&run["crushing_work"]) + number(&run["impact_loss"]);
    assert!(dissipated > known);
    close(number(&run["energy_residual"]), 0.0, 1e-6);
}

/// Errors in a law of force are reported at the wrong word.
#[test]
fn mistakes_in_laws_of_force_are_told() {
    for (field, said) in [
        (
            "compliance: spring(k, b)",
            "no force law is called `spring`",
        ),
        ("compliance: k", "a force law is expected here"),
        (
            "compliance: linear(k)",
            "`linear` takes two arguments, found 1",
        ),
        ("compliance: hertz(k)", "N/m^(3/2)"),
        (
            "compliance: hertz(K), restitution: 0.5",
            "`restitution` cannot be combined with `compliance`",
        ),
        (
            "compliance: linear(-k, b)",
            "the stiffness of a contact must be positive",
        ),
        (
            "compliance: layer(k, k/2)",
            "the unloading stiffness of a layer must not be less than its loading stiffness",
        ),
        (
            "compliance: linear(k*x/(1*m), b)",
            "a force law cannot depend on coordinates",
        ),
    ] {
        let spec = Scratch::new(
            "wrong.machine",
            &format!(
                "machine Wrong in plane {{
                    parameters {{ k: N/m = 800, b: N*s/m = 1, K: N/m^(3/2) = 5 }}
                    coordinates {{ x: m = 1 }}
                    bodies {{ block {{ mass: 1, at: (x, 0) }} }}
                    contacts {{ wall {{ gap: x, {field} }} }}
                }}"
            ),
        );
        let output = lagrangian(&["check", spec.path()]);
        let text = String::from_utf8_lossy(&output.stderr);
        assert!(text.contains(said), "{field}: {text}");
    }
}

/// Friction acts on both bodies at one place, however deep one is in the other: it changes neither their momentum nor their angular
/// momentum together, and does not depend on which of two circles the contact names first.
#[test]
fn friction_of_what_yields_keeps_the_angular_momentum() {
    let discs = |first: &str, on: &str, second: &str, big: f64, far: f64| {
        let text = format!(
            "machine Discs in plane {{
                parameters {{ r: m = 0.1, R: m = {big:?}, m: kg = 1, M: kg = 2, j: kg*m^2 = 0.005, J: kg*m^2 = 0.02, k: N/m = 1e4 }}
                coordinates {{
                    x: m = -{far:?}, y: m = 0.05, a: rad, X: m = {far:?}, Y: m, A: rad,
                    der(x): m/s = 3, der(a): rad/s = 20, der(X): m/s = -1,
                }}
                bodies {{
                    one {{ mass: m, inertia: j, at: (x, y), angle: a }},
                    two {{ mass: M, inertia: J, at: (X, Y), angle: A }},
                }}
                circles {{ rim {{ on: one, center: (0, 0), radius: r }}, bore {{ on: two, center: (0, 0), radius: R }} }}
                gravity none;
                contacts {{ touch {{ circle: {first}, {on}: {second}, compliance: linear(k, 0), friction: 0.4 }} }}
            }}"
        );
        let spec = Scratch::new("discs.machine", &text);
        let run = simulate(spec.path(), 0.5, &[]);
        is_good(&run);
        assert!(!events(&run, "opens").is_empty());
        assert!(
            number(&run["unilateral_contacts"][0]["friction_loss"]) > 0.01,
            "{run:#}"
        );
        run
    };
    let last = |run: &Value| {
        let [q, v] =
            ["q", "v"].map(|of| ["x", "y", "a", "X", "Y", "A"].map(|name| number(&run[of][name])));
        (q, v)
    };
    let angular_momentum = |run: &Value| {
        let (q, v) = last(run);
        q[0] * v[1] - q[1] * v[0] + 2.0 * (q[3] * v[4] - q[4] * v[3]) + 0.005 * v[2] + 0.02 * v[5]
    };
    let outside = discs("rim", "outside", "bore", 0.15, 0.3);
    // −m y ẋ + j ȧ at the start.
    close(angular_momentum(&outside), -0.05, 1e-11);
    let exchanged = discs("bore", "outside", "rim", 0.15, 0.3);
    let pairs = last(&outside).0.into_iter().zip(last(&exchanged).0);
    for (one, other) in pairs {
        close(one, other, 1e-12);
    }
    close(
        angular_momentum(&discs("rim", "inside", "bore", 0.5, 0.0)),
        -0.05,
        1e-11,
    );
}

/// The same for balls in space, whose axes of spin have no particular direction.
#[test]
fn friction_of_balls_that_yield_keeps_their_angular_momentum() {
    for (on, big, far) in [("outside", 0.15, 0.3), ("inside", 0.5, 0.0)] {
        let text = format!(
            "machine Balls in space {{
                parameters {{ r: m = 0.1, R: m = {big:?}, m: kg = 1, M: kg = 2, j: kg*m^2 = 0.005, J: kg*m^2 = 0.02, K: N/m^(3/2) = 1e5 }}
                coordinates {{
                    x: m = -{far:?}, y: m = 0.05, z: m = 0.02, a: rad = 0.1, b: rad = 0.2, c: rad,
                    X: m = {far:?}, Y: m, Z: m, A: rad = 0.1, B: rad = 0.3, C: rad,
                    der(x): m/s = 3, der(c): rad/s = 20, der(b): rad/s = 5, der(X): m/s = -1, der(A): rad/s = 3,
                }}
                frames {{
                    f = ground.shift(x, y, z).turn(z, a).turn(y, b).turn(z, c),
                    F = ground.shift(X, Y, Z).turn(x, A).turn(y, B).turn(z, C),
                }}
                bodies {{ one {{ mass: m, inertia: (j, j, j), frame: f }}, two {{ mass: M, inertia: (J, J, J), frame: F }} }}
                spheres {{ ball {{ on: one, center: (0, 0, 0), radius: r }}, bore {{ on: two, center: (0, 0, 0), radius: R }} }}
                gravity none;
                contacts {{ touch {{ sphere: ball, {on}: bore, compliance: hertz(K), friction: 0.4 }} }}
                define {{ L = m*cross(one.at, der(one.at)) + M*cross(two.at, der(two.at)) + j*f.spin + J*F.spin }}
                outputs {{
                    Lx: N*m*s = dot(L, (1, 0, 0)), Ly: N*m*s = dot(L, (0, 1, 0)), Lz: N*m*s = dot(L, (0, 0, 1)),
                }}
            }}"
        );
        let spec = Scratch::new("balls.machine", &text);
        let table = Scratch::new("balls.csv", "");
        let output = lagrangian(&[
            "simulate",
            spec.path(),
            "--until",
            "0.4",
            "--tolerance",
            "1e-13",
            "--every",
            "0.4",
            "--out",
            table.path(),
            "--json",
        ]);
        let run: Value = serde_json::from_slice(&output.stdout).expect("a document");
        is_good(&run);
        assert!(!events(&run, "closes").is_empty());
        let rows = std::fs::read_to_string(table.path()).expect("a table");
        let rows: Vec<Vec<&str>> = rows.lines().map(|row| row.split(',').collect()).collect();
        let value = |row: usize, column: usize| rows[row][column].parse::<f64>().expect("a number");
        for name in ["Lx", "Ly", "Lz"] {
            let column = rows[0].iter().position(|head| head.starts_with(name));
            let column = column.expect("an output");
            close(value(2, column), value(1, column), 1e-11);
        }
    }
}
