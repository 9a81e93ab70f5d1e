//! Static friction and the laws of impact in time stepping, against closed forms, and against runs that find every event.

use serde_json::Value;

use crate::collisions::{close, events, number, simulate};
use crate::support::{Scratch, lagrangian};
use crate::time_stepping::step;

const G: f64 = 9.81;

/// A block on a slope, in axes along it and normal to it.
const SLOPE: &str = "machine Slope in plane {
    parameters { m: kg = 2, alpha: rad = 0.4, mu: 1 = 0.3, mu_0: 1 = 0.5, speed: m/s = 0, g: m/s^2 = 9.81 }
    coordinates { x: m, y: m, der(x): m/s = speed }
    bodies { block { mass: m, at: (x*cos(alpha) - y*sin(alpha), x*sin(alpha) + y*cos(alpha)) } }
    gravity (0, -g);
    contacts { slope { gap: y, slip: der(x), restitution: 0.4, friction: mu, static_friction: mu_0 } }
}";

/// Up to `tan α = μ₀` a block at rest stays, and one that slides down is accelerated by `g (sin α − μ cos α)`. One that slides up is braked by
/// `g (sin α + μ cos α)` and stays where it comes to rest, also where its kinetic friction could not hold it. Forces are constant, so rates have no error but
/// rounding; the step in which the block stops moves it by `v h/2` in place of `v²/(2 a)`, with `v ≤ a h`.
#[test]
fn static_friction_holds_what_rests_or_comes_to_rest() {
    let spec = Scratch::new("slope.machine", SLOPE);
    let h = 1.0 / 512.0;
    let (sin, cos) = 0.4_f64.sin_cos();
    assert!(
        0.3 < sin / cos && sin / cos < 0.5,
        "between both coefficients"
    );

    let rests = step(spec.path(), 1.0, h, &[]);
    close(number(&rests["q"]["x"]), 0.0, 1e-15);
    close(number(&rests["v"]["x"]), 0.0, 1e-15);

    let down = step(spec.path(), 1.0, h, &["--set", "speed=-0.1"]);
    close(number(&down["v"]["x"]), -0.1 - G * (sin - 0.3 * cos), 1e-12);

    let up = step(spec.path(), 1.0, h, &["--set", "speed=1"]);
    let braked = G * (sin + 0.3 * cos);
    close(number(&up["v"]["x"]), 0.0, 1e-15);
    close(number(&up["q"]["x"]), 0.5 / braked, 0.5 * braked * h * h);
    let sticks = events(&up, "sticks");
    assert_eq!(sticks.len(), 1, "{up:#}");
    close(number(&sticks[0]["t"]), 1.0 / braked, 2.0 * h);
    assert!(events(&up, "reverses").is_empty());

    // On a steeper slope it turns, and beyond its static friction it does not stay.
    let steep = ["--set", "alpha=0.5", "--set", "speed=1"];
    let turns = step(spec.path(), 1.0, h, &steep);
    let (sin, cos) = 0.5_f64.sin_cos();
    let [up, down] = [1.0, -1.0].map(|sign| G * (sin + sign * 0.3 * cos));
    // In the step in which it turns the friction of one of both directions acts for all of it.
    let expected = -down * (1.0 - 1.0 / up);
    close(number(&turns["v"]["x"]), expected, (up - down) * h);
    let from_rest = step(spec.path(), 1.0, h, &["--set", "alpha=0.5"]);
    close(number(&from_rest["v"]["x"]), -down, 1e-12);
}

/// In space the block slides and is held in whatever direction.
#[test]
fn static_friction_holds_in_space() {
    let spec = Scratch::new(
        "slope_in_space.machine",
        "machine SlopeInSpace in space {
            parameters { m: kg = 2, alpha: rad = 0.4, beta: rad = 0.7, mu: 1 = 0.3, mu_0: 1 = 0.5, speed: m/s = 0, g: m/s^2 = 9.81 }
            coordinates { x: m, y: m, z: m, der(x): m/s = speed*cos(beta), der(y): m/s = speed*sin(beta) }
            bodies { block { mass: m, at: (x, y, z) } }
            // The slope rises in the direction β.
            gravity (-g*sin(alpha)*cos(beta), -g*sin(alpha)*sin(beta), -g*cos(alpha));
            contacts { slope { gap: z, slip: (der(x), der(y)), restitution: 0.4, friction: mu, static_friction: mu_0 } }
        }",
    );
    let h = 1.0 / 512.0;
    let (sin, cos) = 0.4_f64.sin_cos();
    let rests = step(spec.path(), 1.0, h, &[]);
    let up = step(spec.path(), 1.0, h, &["--set", "speed=1"]);
    let down = step(spec.path(), 1.0, h, &["--set", "speed=-0.1"]);
    let braked = G * (sin + 0.3 * cos);
    let along = |run: &Value, what: &str| {
        let [x, y] = ["x", "y"].map(|name| number(&run[what][name]));
        let (across, along) = 0.7_f64.sin_cos();
        close(y * along - x * across, 0.0, 1e-9);
        x * along + y * across
    };
    // Cones are solved to 1e-10 of the rates of a step.
    close(along(&rests, "q"), 0.0, 1e-9);
    close(along(&up, "v"), 0.0, 1e-10);
    close(along(&up, "q"), 0.5 / braked, 0.5 * braked * h * h + 1e-9);
    let expected = -0.1 - G * (sin - 0.3 * cos);
    close(along(&down, "v"), expected, 1e-9);
}

/// A block that is pulled by a spring sticks until its static friction is used up, slips with its kinetic friction, and sticks again. Each change is found at
/// most a step late, so that the spring is then longer by `V h`, and what follows is displaced by no more than the speed of the slip makes of that.
#[test]
fn a_block_sticks_and_slips_as_with_events() {
    let spec = Scratch::new(
        "pulled.machine",
        "machine Pulled in plane {
            parameters { m: kg = 1, k: N/m = 100, V: m/s = 0.1, mu: 1 = 0.3, mu_0: 1 = 0.5, g: m/s^2 = 9.81 }
            coordinates { x: m, y: m }
            bodies { block { mass: m, at: (x, y) } }
            springs { rope { stiffness: k, stretch: V*t - x } }
            gravity (0, -g);
            contacts { floor { gap: y, slip: der(x), restitution: 0, friction: mu, static_friction: mu_0 } }
        }",
    );
    let exact = simulate(spec.path(), 2.0, &[]);
    for h in [2e-3, 1e-3, 5e-4] {
        let run = step(spec.path(), 2.0, h, &[]);
        for kind in ["slips", "sticks"] {
            let [found, known] = [&run, &exact].map(|run| events(run, kind));
            let known: Vec<_> = known
                .iter()
                .filter(|event| number(&event["t"]) > 0.1)
                .collect();
            let found: Vec<_> = found
                .iter()
                .filter(|event| number(&event["t"]) > 0.1)
                .collect();
            assert!(known.len() >= 2, "{exact:#}");
            assert_eq!(found.len(), known.len(), "{kind} {h}");
            for (place, (found, known)) in found.iter().zip(&known).enumerate() {
                let late = number(&found["t"]) - number(&known["t"]);
                assert!(
                    late.abs() <= 4.0 * (place + 1) as f64 * h,
                    "{kind} {h}: {late}"
                );
            }
        }
        // The first slip begins where k V t = μ₀ m g.
        let first = number(&events(&run, "slips")[0]["t"]) - 0.5 * G / 10.0;
        assert!((0.0..=2.0 * h).contains(&first), "{first}");
    }
}

/// A disc that falls with spin. Its inverse masses are `1/m` and `3/m` and not coupled, so that all laws agree: `Λₙ = (1 + e) m w`, and friction is `μ Λₙ`, or
/// stops the slip if that is less. The rate w is that at the floor, `w² = v² + 2 g d` after a fall by d, whatever the steps are.
#[test]
fn every_law_bounces_a_disc_alike() {
    let (e, mu, g) = (0.7, 0.2, G);
    for law in [
        "law: poisson",
        "law: poisson_glocker",
        "law: stronge",
        "order: sequence",
    ] {
        let text = format!(
            "machine Spins in plane {{
                parameters {{ m: kg = 0.5, r: m = 0.1, e: 1 = {e}, mu: 1 = {mu}, spin: rad/s = 0, g: m/s^2 = {g} }}
                coordinates {{ x: m, y: m = 0.3, theta: rad, der(x): m/s = 1, der(y): m/s = -2, der(theta): rad/s = spin }}
                bodies {{ disc {{ mass: m, inertia: m*r^2/2, at: (x, y), angle: theta }} }}
                circles {{ rim {{ on: disc, center: (0, 0), radius: r }} }}
                gravity (0, -g);
                contacts {{ floor {{ circle: rim, along: ground, restitution: e, friction: mu, static_friction: 2*mu, {law} }} }}
            }}"
        );
        let spec = Scratch::new("spins.machine", &text);
        let h = 1e-3;
        for (spin, setting) in [(20.0, "spin=20"), (-9.0, "spin=-9")] {
            let run = step(spec.path(), 0.2, h, &["--set", setting]);
            let impacts = events(&run, "impact");
            assert_eq!(impacts.len(), 1, "{law}: {run:#}");
            let pair = |name: &str| [0, 1].map(|part| number(&impacts[0][name][part]));
            let [before, after] = pair("gap_rate");
            let w = (2.0_f64.powi(2) + 2.0 * g * 0.2).sqrt();
            // The sum of 100 steps of the fall.
            let rounding = 100.0 * f64::EPSILON * w;
            close(before, -w, rounding);
            close(after, e * w, rounding);
            let [slip, left] = pair("slip");
            close(slip, 1.0 + 0.1 * spin, 1e-13);
            let most = 3.0 * mu * (1.0 + e) * w;
            close(left, slip - slip.signum() * most.min(slip.abs()), 1e-13);
            let impulse = pair("impulse")[0];
            close(impulse, 0.5 * (1.0 + e) * w, 1e-13);
        }
        // An elastic ball has the same speed at the same height, however often it bounces.
        let elastic = step(spec.path(), 3.0, h, &["--set", "e=1", "--set", "mu=0"]);
        let impacts = events(&elastic, "impact");
        assert!(impacts.len() >= 5, "{law}");
        for impact in impacts {
            let [before, after] = [0, 1].map(|part| number(&impact["gap_rate"][part]));
            close(after, -before, 1e-12);
        }
        // With restitution it comes to rest, and the balance closes.
        let run = step(spec.path(), 6.0, h, &["--set", "mu=0"]);
        close(number(&run["q"]["y"]), 0.1, 1e-12);
        close(number(&run["v"]["y"]), 0.0, 1e-12);
        close(number(&run["energy_residual"]), 0.0, 1e-11);
    }
}

/// Three equal balls in a row, of which the first hits the others, which touch: with `order: sequence`, and with laws for one contact at a time, the last one
/// flies on alone; at once they leave with −1/3, 2/3 and 2/3 of its speed.
#[test]
fn balls_in_a_row_meet_in_sequence_or_at_once() {
    let third = 1.0 / 3.0;
    let in_sequence = [0.0, 0.0, 1.0];
    for (law, expected) in [
        ("law: newton, order: sequence", in_sequence),
        ("law: poisson", in_sequence),
        ("law: stronge", in_sequence),
        ("law: poisson_glocker, order: sequence", in_sequence),
        ("law: poisson_glocker", [-third, 2.0 * third, 2.0 * third]),
    ] {
        let text = format!(
            "machine Row in plane {{
                parameters {{ d: m = 0.1 }}
                coordinates {{ x[1]: m = -0.2, x[2]: m = 0, x[3]: m = d, der(x[1]): m/s = 1 }}
                bodies {{ ball[i in 1..3] {{ mass: 1, at: (x[i], 0) }} }}
                contacts {{ pair[i in 1..2] {{ gap: x[i + 1] - x[i] - d, restitution: 1, {law} }} }}
            }}"
        );
        let spec = Scratch::new("row.machine", &text);
        let run = step(spec.path(), 0.2, 1e-3, &[]);
        for (i, expected) in expected.iter().enumerate() {
            let rate = number(&run["v"][format!("x[{}]", i + 1)]);
            close(rate, *expected, 1e-13);
        }
    }
}

/// A box that tumbles about a room without gravity: between impacts its energy is constant, and with the law of Stronge no step adds to it, also where several
/// corners meet in one step.
#[test]
fn no_step_adds_energy_by_the_law_of_stronge() {
    let table = Scratch::new("room.csv", "");
    let spec = Scratch::new(
        "room.machine",
        "machine Room in plane {
            parameters { m: kg = 1, a: m = 0.2, b: m = 0.1, L: m = 0.5, e: 1 = 0.95, mu: 1 = 0.4, mu_0: 1 = 0.6 }
            coordinates { x: m, y: m, phi: rad = 0.3, der(x): m/s = 1.1, der(y): m/s = -0.7, der(phi): rad/s = 5 }
            frames {
                held = ground.shift(x, y).turn(phi),
                down = ground.shift(0, -L), up = ground.shift(0, L).turn(pi), left = ground.shift(-L, 0).turn(-pi/2), right = ground.shift(L, 0).turn(pi/2),
            }
            bodies { box { mass: m, inertia: m*(a^2 + b^2)/3, frame: held, outline: ((a, -b), (a, b), (-a, b), (-a, -b)) } }
            contacts {
                floor { corners: outline, on: box, along: down, restitution: e, friction: mu, static_friction: mu_0, law: stronge },
                roof { corners: outline, on: box, along: up, restitution: e, friction: mu, static_friction: mu_0, law: stronge },
                west { corners: outline, on: box, along: left, restitution: e, friction: mu, static_friction: mu_0, law: stronge },
                east { corners: outline, on: box, along: right, restitution: e, friction: mu, static_friction: mu_0, law: stronge },
            }
        }",
    );
    let more = ["--every", "5e-3", "--out", table.path()];
    let run = step(spec.path(), 100.0, 5e-3, &more);
    assert!(
        events(&run, "impact").len() > 20,
        "it meets the walls often"
    );
    let text = std::fs::read_to_string(table.path()).expect("a table");
    let mut lines = text.lines().filter(|line| !line.starts_with('#'));
    let names: Vec<&str> = lines.next().expect("names").split(',').collect();
    let column = |name: &str| {
        let found = names.iter().position(|known| known.starts_with(name));
        found.unwrap_or_else(|| panic!("no {name} in {names:?}"))
    };
    let columns = ["der(x)", "der(y)", "der(phi)"].map(column);
    let inertia = (0.04 + 0.01) / 3.0;
    let mut last = f64::INFINITY;
    for line in lines {
        let row: Vec<f64> = (line.split(','))
            .map(|x| x.parse().expect("a number"))
            .collect();
        let [x, y, phi] = columns.map(|column| row[column]);
        let energy = 0.5 * (x * x + y * y + inertia * phi * phi);
        assert!(
            energy <= last * (1.0 + 1e-12),
            "{last} {energy} at {}",
            row[0]
        );
        last = energy;
    }
}

/// Discs with static friction and a law of Poisson fall into a bowl: without any option the run continues by time stepping where contacts become too frequent,
/// and the discs come to rest. Impacts in sequence, which are asked for one by one, are all located.
#[test]
fn a_run_hands_over_whatever_the_law() {
    let pile = std::fs::read_to_string("../machines/contacts/pile.machine").expect("a spec");
    for law in [
        "static_friction: 0.5",
        "law: poisson_glocker",
        "order: sequence",
    ] {
        let text = pile.replace("friction: mu", &format!("friction: mu, {law}"));
        let spec = Scratch::new("pile.machine", &text);
        let arguments = [
            "simulate",
            spec.path(),
            "--until",
            "4",
            "--json",
            "--const",
            "N=8",
            "--set",
            "e=0.3",
        ];
        let output = lagrangian(&arguments);
        let run: Value = serde_json::from_slice(&output.stdout).expect("a document");
        assert_eq!(run["error"], Value::Null, "{law}: {run:#}");
        if law == "order: sequence" {
            assert_eq!(run["handovers"], Value::Null, "{law}");
        } else {
            assert_eq!(run["handovers"][0]["to"], "moreau", "{law}: {run:#}");
        }
        for (name, rate) in run["v"].as_object().expect("rates") {
            assert!(number(rate).abs() <= 1e-9, "{law}: der({name}) = {rate}");
        }
    }
}
