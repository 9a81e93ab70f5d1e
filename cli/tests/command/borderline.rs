//! Contacts exactly at the limits of what they do: without friction, at the limit of it, lifting at the same instant, or going on from a state that was
//! saved.

use serde_json::Value;

use crate::collisions::{close, events, is_good, number, simulate};
use crate::support::{Scratch, lagrangian};

fn simulate_by(spec: &Scratch, until: &str, method: &str, tolerance: &str) -> Value {
    let arguments = ["simulate", spec.path(), "--until", until, "--json"];
    let by = ["--method", method, "--tolerance", tolerance];
    let output = lagrangian(&[&arguments[..], &by].concat());
    serde_json::from_slice(&output.stdout).expect("a document")
}

/// A block without friction, pushed by F sin(ω t) from rest: x = F/(m ω) t − F/(m ω²) sin(ω t). At the start nothing pushes, and there is no
/// friction whose direction could tell which way it will slip. In space it is pushed along both tangents.
#[test]
fn what_has_no_friction_moves_as_soon_as_it_is_pushed() {
    let plane = Scratch::new(
        "pushed.machine",
        "machine Pushed in plane {
            parameters { m: kg = 1, F: N = 1, w: rad/s = 3, mu: 1 = 0, g: m/s^2 = 9.81 }
            coordinates { x: m, y: m }
            bodies { block { mass: m, at: (x, y) } }
            forces { push { on: x, value: F*sin(w*t) } }
            gravity (0, -g);
            contacts { floor { gap: y, slip: der(x), restitution: 0, friction: mu } }
        }",
    );
    let space = Scratch::new(
        "pushed.machine",
        "machine Pushed in space {
            parameters { m: kg = 1, F: N = 1, w: rad/s = 3, mu: 1 = 0, g: m/s^2 = 9.81 }
            coordinates { x: m, z: m, y: m }
            frames { block = ground.shift(x, z, y) }
            bodies { block { mass: m, frame: block } }
            forces { push { on: x, value: F*sin(w*t) }, across { on: z, value: -2*F*sin(w*t) } }
            gravity (0, 0, -g);
            contacts { floor { point: (0, 0, 0), on: block, along: ground, restitution: 0, friction: mu } }
        }",
    );
    for force in [1.0, -1.0] {
        let set = format!("F={force}");
        let w = 3.0_f64;
        let t = 2.0_f64;
        let expected = force * (t / w - (w * t).sin() / (w * w));
        for (spec, factors) in [(&plane, [1.0, 0.0]), (&space, [1.0, -2.0])] {
            let run = simulate(spec.path(), t, &[&set]);
            is_good(&run);
            close(number(&run["q"]["x"]), factors[0] * expected, 1e-11);
            if factors[1] != 0.0 {
                close(number(&run["q"]["z"]), factors[1] * expected, 1e-11);
            }
            close(number(&run["dissipated"]), 0.0, 1e-14);
        }
    }
}

/// Two discs in a bowl, which carry a third one, roll apart until they let go of it, both at the same instant. With the angle ψ of the lower ones, rates
/// follow from the energy, 2 m ρ² ψ̇²/2 + m (y′ ψ̇)²/2 + V(ψ) = V(ψ₀) where y(ψ) is the height of the upper one, and they let go where its acceleration is
/// −g, at t = 0.38266612738094706; from there the lower ones are pendulums of length ρ. All of it was integrated with 30 digits.
#[test]
fn contacts_that_lift_at_the_same_instant_stay_open() {
    let spec = Scratch::new(
        "three.machine",
        "machine Three in plane {
            parameters { m: kg = 1, r: m = 0.1, R: m = 1, e: 1 = 0, g: m/s^2 = 9.81, psi: rad = 0.11134101434096388 }
            coordinates {
                x1: m = -(R-r)*sin(psi), y1: m = -(R-r)*cos(psi), x2: m = (R-r)*sin(psi), y2: m = -(R-r)*cos(psi),
                x3: m, y3: m = -(R-r)*cos(psi) + 2*r*cos(30*deg),
            }
            frames { d1 = ground.shift(x1, y1), d2 = ground.shift(x2, y2), d3 = ground.shift(x3, y3) }
            bodies { b1 { mass: m, at: (x1, y1) }, b2 { mass: m, at: (x2, y2) }, b3 { mass: m, at: (x3, y3) } }
            circles {
                bowl { on: ground, center: (0, 0), radius: R },
                c[1] { on: d1, center: (0, 0), radius: r },
                c[2] { on: d2, center: (0, 0), radius: r },
                c[3] { on: d3, center: (0, 0), radius: r },
            }
            gravity (0, -g);
            contacts { wall[i in 1..3] { circle: c[i], inside: bowl, restitution: e }, pair { circles: c, restitution: e } }
        }",
    );
    for method in ["dop853", "dopri5", "radau5"] {
        for tolerance in ["1e-6", "1e-7", "1e-8", "1e-9", "1e-10", "1e-11", "1e-12"] {
            // Some twenty steps, each with an error of at most the tolerance.
            let within = 20.0 * tolerance.parse::<f64>().expect("a number");
            let run = simulate_by(&spec, "0.42", method, tolerance);
            assert_eq!(run["error"], Value::Null, "{method} {tolerance}");
            let lifts = events(&run, "lifts");
            let lifted: Vec<f64> = lifts.iter().map(|event| number(&event["t"])).collect();
            assert_eq!(lifted.len(), 2, "{method} {tolerance}: {lifted:?}");
            close(lifted[0], 0.382_666_127_380_947_1, within);
            close(lifted[1], lifted[0], within);
            close(number(&run["q"]["x2"]), 0.198_519_157_850_942_83, within);
            close(number(&run["q"]["y3"]), -0.845_155_608_333_112_7, within);
        }
    }
}

/// A box on the edge of another one, beyond which its centre is, begins to turn about that edge with exactly the friction that there is: from rest the
/// force there is 0.3 of the normal one with a lever of 0.05 m and 0.1 m, and less as it turns. It is a pendulum: φ̈ = m g (b cos φ + h sin φ)/J
/// about the edge.
#[test]
fn a_start_exactly_at_the_limit_of_friction_sticks_if_less_is_needed_after_it() {
    let settings = ["start=-0.45", "speed=0", "mu_floor=0.3", "h=0.1"];
    let run = simulate("machines/contacts/box_on_box.machine", 0.1, &settings);
    is_good(&run);
    let (b, h, g) = (0.05, 0.1, 9.81);
    let inertia = 2.0 * h * h / 3.0 + b * b + h * h;
    let acceleration = |phi: f64| g * (b * phi.cos() + h * phi.sin()) / inertia;
    // The method of Runge and Kutta in 1000 steps, whose error is of the order of 1e-12.
    let (mut phi, mut rate) = (0.0, 0.0);
    let step = 0.1 / 1000.0;
    for _ in 0..1000 {
        let k1 = (rate, acceleration(phi));
        let k2 = (
            rate + 0.5 * step * k1.1,
            acceleration(phi + 0.5 * step * k1.0),
        );
        let k3 = (
            rate + 0.5 * step * k2.1,
            acceleration(phi + 0.5 * step * k2.0),
        );
        let k4 = (rate + step * k3.1, acceleration(phi + step * k3.0));
        phi += step / 6.0 * (k1.0 + 2.0 * k2.0 + 2.0 * k3.0 + k4.0);
        rate += step / 6.0 * (k1.1 + 2.0 * k2.1 + 2.0 * k3.1 + k4.1);
    }
    close(number(&run["q"]["theta"]), phi, 1e-11);
    close(
        number(&run["q"]["x"]),
        -0.4 - b * phi.cos() - h * phi.sin(),
        1e-11,
    );
    close(number(&run["q"]["X"]), 0.0, 1e-12);
    close(number(&run["dissipated"]), 0.0, 1e-12);
}

/// A box turns about the edge of another one, which rests and whose rates are the rounding that a run has left of them. A run that starts there
/// ends where one that goes on does.
#[test]
fn a_run_goes_on_from_a_state_in_contact() {
    let settings = ["start=0.45", "speed=0", "mu_floor=0.4"];
    let spec = "machines/contacts/box_on_box.machine";
    for (first, then) in [(0.1, 0.1), (0.3, 0.05), (0.07, 0.2)] {
        let whole = simulate(spec, first + then, &settings);
        let begun = simulate(spec, first, &settings);
        let until = format!("{then:?}");
        let mut arguments: Vec<String> = ["simulate", spec, "--until", &until, "--json"]
            .into_iter()
            .chain(["--tolerance", "1e-13"])
            .map(String::from)
            .collect();
        for setting in settings {
            arguments.extend(["--set".into(), setting.into()]);
        }
        for (option, of) in [("--start", "q"), ("--rate", "v")] {
            for (name, value) in begun[of].as_object().expect("numbers") {
                arguments.extend([option.into(), format!("{name}={:?}", number(value))]);
            }
        }
        let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
        let output = lagrangian(&arguments);
        let again: Value = serde_json::from_slice(&output.stdout).expect("a document");
        is_good(&again);
        assert!(
            number(&again["steps"]) <= number(&whole["steps"]) + 20.0,
            "{}",
            again["steps"]
        );
        for of in ["q", "v"] {
            for (name, value) in whole[of].as_object().expect("numbers") {
                close(number(&again[of][name]), number(value), 1e-9);
            }
        }
    }
}

/// A mass on a table that moves up and down: while it rests there, the table does the work m g a sin(ω t) − m a² ω² sin²(ω t)/2, and where it lands on one
/// that rises with u, the impulse times u. It does so wherever the height of the mass is measured from.
#[test]
fn the_work_of_a_wall_does_not_depend_on_coordinates() {
    let spec = |at: &str, start: &str, rate: &str, table: &str| {
        Scratch::new(
            "table.machine",
            &format!(
                "machine Table in plane {{
                    parameters {{ m: kg = 2, a: m = 0.01, w: rad/s = 20, u: m/s = 0.7, e: 1 = 0.5, g: m/s^2 = 9.81 }}
                    coordinates {{ y: m = {start}, der(y): m/s = {rate} }}
                    frames {{ table = ground.shift(0, {table}), mass = ground.shift(0, {at}) }}
                    bodies {{ mass {{ mass: m, frame: mass, inertia: 1 }} }}
                    gravity (0, -g);
                    contacts {{ table {{ point: (0, 0), on: mass, along: table, restitution: e }} }}
                }}"
            ),
        )
    };
    let (m, a, w, u, e, g, t) = (2.0, 0.01, 20.0_f64, 0.7, 0.5, 9.81, 0.13);
    let resting = m * g * a * (w * t).sin() - 0.5 * m * (a * w * (w * t).sin()).powi(2);
    for (at, rate) in [
        ("y", "a*w"),
        ("y + a*sin(w*t)", "0"),
        ("y + a*sin(w*t)/3", "2/3*a*w"),
    ] {
        for method in ["dop853", "moreau"] {
            let spec = spec(at, "0", rate, "a*sin(w*t)");
            let mut arguments = vec!["simulate", spec.path(), "--until", "0.13", "--json"];
            let within = match method {
                "moreau" => {
                    arguments.extend(["--method", method, "--longest-step", "1e-4"]);
                    1e-3
                }
                _ => {
                    arguments.extend(["--tolerance", "1e-12"]);
                    1e-11
                }
            };
            let output = lagrangian(&arguments);
            let run: Value = serde_json::from_slice(&output.stdout).expect("a document");
            is_good(&run);
            close(
                number(&run["unilateral_contacts"][0]["work"]),
                resting,
                within,
            );
            close(number(&run["work"]), resting, within);
        }
    }
    // It falls by h and closes with the sum of both speeds.
    let closes = |h: f64| ((u * u + 2.0 * g * h).sqrt(), m * (1.0 + e));
    let (speed, factor) = closes(0.3);
    for (at, rate) in [("y", "0"), ("y + u*t", "-u"), ("y - 2*u*t", "2*u")] {
        let spec = spec(at, "0.3", rate, "u*t");
        let until = (speed - u) / g + 0.05;
        let run = simulate(spec.path(), until, &[]);
        is_good(&run);
        assert_eq!(events(&run, "impact").len(), 1);
        close(
            number(&run["unilateral_contacts"][0]["work"]),
            factor * speed * u,
            1e-11,
        );
        close(number(&run["work"]), factor * speed * u, 1e-11);
    }
}

/// A pendulum whose pivot moves with u strikes a wall at rest, which does no work. The rod takes Λ sin θ of the impulse, and the pivot Λ sin²θ
/// along its way.
#[test]
fn what_drives_a_body_does_work_in_its_impacts() {
    let spec = Scratch::new(
        "pendulum.machine",
        "machine Pendulum in plane {
            parameters { m: kg = 1.5, l: m = 0.8, u: m/s = 0.6, X: m = 0.6, e: 1 = 0.4, g: m/s^2 = 9.81 }
            coordinates { theta: rad = -0.5 }
            bodies { bob { mass: m, at: (u*t + l*sin(theta), -l*cos(theta)) } }
            gravity (0, -g);
            contacts { wall { gap: X - u*t - l*sin(theta), restitution: e } }
        }",
    );
    let run = simulate(spec.path(), 0.8, &[]);
    is_good(&run);
    let impacts = events(&run, "impact");
    let done: f64 = impacts
        .iter()
        .map(|impact| {
            let sin = number(&impact["q"]["theta"]).sin();
            number(&impact["impulse"][0]) * sin * sin * 0.6
        })
        .sum();
    assert!(!impacts.is_empty() && done > 0.01, "{done}");
    close(number(&run["unilateral_contacts"][0]["work"]), done, 1e-12);
}

/// A crank drives a block to and fro over a floor with friction, which takes μ m g of its way: from its energy J ω²/2 + m (r ω sin θ)²/2. At each dead centre
/// the slip stops, and no force of the floor could keep it at rest there.
#[test]
fn a_slip_passes_the_dead_centre_of_a_crank() {
    let spec = Scratch::new(
        "crank.machine",
        "machine Crank in plane {
            parameters { m: kg = 1, J: kg*m^2 = 0.5, r: m = 0.2, mu: 1 = 0.3, w: rad/s = 5, g: m/s^2 = 9.81 }
            coordinates { theta: rad = 1, y: m, der(theta): rad/s = w }
            bodies { wheel { mass: 1, inertia: J, at: (0, 0), angle: theta }, block { mass: m, at: (r*cos(theta), y) } }
            gravity (0, -g);
            contacts { floor { gap: y, slip: der(r*cos(theta)), restitution: 0, friction: mu } }
        }",
    );
    for method in ["dop853", "dopri5", "radau5"] {
        for tolerance in ["1e-3", "1e-6", "1e-9", "1e-12"] {
            let run = simulate_by(&spec, "1.9", method, tolerance);
            assert_eq!(run["error"], Value::Null, "{method} {tolerance}");
            let (theta, rate) = (number(&run["q"]["theta"]), number(&run["v"]["theta"]));
            let energy =
                |theta: f64, rate: f64| 0.5 * (0.5 + (0.2 * theta.sin()).powi(2)) * rate * rate;
            let turns = (theta / std::f64::consts::PI).floor();
            assert_eq!(turns, 2.0);
            let way = 0.2 * ((1.0_f64.cos() + 1.0) + 2.0 + (1.0 - theta.cos()));
            let lost = energy(1.0, 5.0) - energy(theta, rate);
            // Some forty steps.
            let within = 40.0 * tolerance.parse::<f64>().expect("a number");
            close(lost, 0.3 * 9.81 * way, within);
            assert_eq!(events(&run, "reverses").len(), 2, "{method} {tolerance}");
        }
    }
}

/// Newton's law with different coefficients along normal and tangent creates energy in an oblique impact with friction: with inverse masses 1.45 and −0.6,
/// e = 1, eₜ = 0 and rates −v and 0.2 v the impulse along the tangent is 0.91 v/2.25, and the gain ½ 0.2 v times that. A gain that is less than the
/// rounding of the potential energy, 1 J, cannot be seen in a balance of energies, and nothing is said of it.
#[test]
fn energy_below_rounding_is_not_created() {
    let spec = Scratch::new(
        "oblique.machine",
        "machine Oblique in plane {
            parameters { v: m/s = 1, z: m = 0.1, c: m = 0.3, d: m = 0.4 }
            coordinates { x: m, y: m, phi: rad, der(x): m/s = 0.2*v, der(y): m/s = -v }
            bodies { rod { mass: 1, inertia: 0.2, at: (x, y + z), angle: phi } }
            gravity (0, -10);
            contacts {
                tip {
                    gap: y + c*phi, slip: der(x) - d*der(phi), restitution: 1, tangential_restitution: 0, friction: 0.5,
                },
            }
        }",
    );
    let gain = |v: f64| 0.5 * 0.2 * 0.91 / 2.25 * v * v;
    let run = simulate(spec.path(), 1e-3, &["v=1"]);
    let warnings = run["warnings"].as_array().expect("warnings");
    let is_said = |warning: &Value| {
        let text = warning.as_str().expect("text");
        text.contains("created energy") && text.contains(&format!("{:.2e} J", gain(1.0)))
    };
    assert!(warnings.iter().any(is_said), "{warnings:?}");
    let run = simulate(spec.path(), 1e-12, &["v=1e-9"]);
    is_good(&run);
    let impact = events(&run, "impact")[0];
    close(number(&impact["loss"]), -gain(1e-9), 1e-12 * gain(1e-9));
}

/// A family of one disc makes no pairs, and it falls and slides as it does without them.
#[test]
fn a_family_of_one_has_no_pairs() {
    let of_one = lagrangian(&[
        "simulate",
        "machines/contacts/pile.machine",
        "--const",
        "N=1",
        "--until",
        "0.6",
        "--json",
    ]);
    let of_one: Value = serde_json::from_slice(&of_one.stdout).expect("a document");
    is_good(&of_one);
    let text = std::fs::read_to_string("../machines/contacts/pile.machine").expect("a spec");
    let pair = "pair { circles: rim, restitution: e, friction: mu },";
    assert!(text.contains(pair));
    let spec = Scratch::new("alone.machine", &text.replace(pair, ""));
    let alone = lagrangian(&[
        "simulate",
        spec.path(),
        "--const",
        "N=1",
        "--until",
        "0.6",
        "--json",
    ]);
    let alone: Value = serde_json::from_slice(&alone.stdout).expect("a document");
    assert_eq!(of_one["q"], alone["q"]);
    assert_eq!(of_one["v"], alone["v"]);
    assert!(!events(&of_one, "impact").is_empty());
}

/// A body of 1 kg and 1 kg m² slides on three feet that are 1e-5 m apart. What friction forces are where depends on how they share the load, and rates of 1e-10
/// of the others tell which distribution is that of feet that all yield alike: above rounding, but not by what a complementarity problem can be solved to. A
/// warning says where and when another one was taken; feet 0.1 m apart have none.
#[test]
fn a_load_that_is_shared_otherwise_is_told() {
    let spec = Scratch::new(
        "near.machine",
        "machine Near in plane {
            parameters { d: m = 1e-5, mu: 1 = 0.1 }
            coordinates { x: m, y: m, theta: rad, der(x): m/s = 0.5 }
            frames { held = ground.shift(x, y).turn(theta) }
            bodies { body { mass: 1, inertia: 1, frame: held } }
            gravity (0, -9.81);
            contacts {
                left { point: (-d, 0), on: held, along: ground, restitution: 0, friction: mu },
                middle { point: (0.3*d, 0), on: held, along: ground, restitution: 0, friction: mu },
                right { point: (d, 0), on: held, along: ground, restitution: 0, friction: mu },
            }
        }",
    );
    let run = simulate(spec.path(), 0.1, &[]);
    let warnings = run["warnings"].as_array().expect("warnings");
    let said = "the motion depends on how `left`, `middle` and `right` share their load at t = 0 s";
    assert!(
        warnings
            .iter()
            .any(|warning| warning.as_str().is_some_and(|text| text.starts_with(said))),
        "{warnings:?}"
    );
    let text = lagrangian(&["simulate", spec.path(), "--until", "0.1"]);
    let text = String::from_utf8_lossy(&text.stdout).into_owned();
    assert!(text.contains(&format!("warning: {said}")), "{text}");
    for d in ["d=0.1", "d=1e-3"] {
        is_good(&simulate(spec.path(), 0.1, &[d]));
    }
    // So it is at a state.
    let said = "the accelerations depend on how `left`, `middle`, `right` share their load";
    for (d, is_told) in [("d=1e-5", true), ("d=0.1", false)] {
        let at_start = lagrangian(&["evaluate", spec.path(), "--set", d]);
        let text = String::from_utf8_lossy(&at_start.stdout);
        assert!(at_start.status.success(), "{text}");
        assert_eq!(text.contains(said), is_told, "{d}: {text}");
    }
}

/// Discs in a box that is shaken: the lowest one stands on the floor by its rolling resistance, others fall on it, and it begins to roll where that is used up.
/// What it does then does not depend on the order in which the contacts are written.
#[test]
fn a_disc_under_others_begins_to_roll() {
    let runs = [false, true].map(|reversed| {
        let mut contacts: Vec<String> = Vec::new();
        for i in 0..4 {
            contacts.push(format!("f{i} {{ circle: c{i}, along: floor, restitution: 0.2, friction: 0.494, rolling_resistance: 0.0019 }}"));
            for side in ["left", "right"] {
                contacts.push(format!("{side}{i} {{ circle: c{i}, along: {side}, restitution: 0.2, friction: 0.494 }}"));
            }
            for j in 0..i {
                contacts.push(format!("p{i}{j} {{ circle: c{i}, outside: c{j}, restitution: 0.2, friction: 0.494 }}"));
            }
        }
        if reversed {
            contacts.reverse();
        }
        let spec = Scratch::new(
            "discs.machine",
            &format!(
                "machine Discs in plane {{
                    parameters {{ g: m/s^2 = 9.81 }}
                    coordinates {{ x0: m = 0.0202, y0: m = 0.154, p0: rad, x1: m = -0.0131, y1: m = 0.3776, p1: rad,
                        x2: m = -0.0412, y2: m = 0.584, p2: rad, x3: m = 0.0346, y3: m = 0.7181, p3: rad }}
                    frames {{ floor = ground.shift(0.01074*m*sin(25.11*rad/s*t), 0), left = floor.shift(-0.141, 0).turn(-pi/2),
                        right = floor.shift(0.141, 0).turn(pi/2) }}
                    bodies {{ d0 {{ mass: 0.273, inertia: 0.00040991, at: (x0, y0), angle: p0 }},
                        d1 {{ mass: 1.295, inertia: 0.00331018, at: (x1, y1), angle: p1 }},
                        d2 {{ mass: 0.401, inertia: 0.00020789, at: (x2, y2), angle: p2 }},
                        d3 {{ mass: 1.743, inertia: 0.00266513, at: (x3, y3), angle: p3 }} }}
                    circles {{ c0 {{ on: d0, center: (0, 0), radius: 0.0548 }}, c1 {{ on: d1, center: (0, 0), radius: 0.0715 }},
                        c2 {{ on: d2, center: (0, 0), radius: 0.0322 }}, c3 {{ on: d3, center: (0, 0), radius: 0.0553 }} }}
                    gravity (0, -g);
                    contacts {{ {} }}
                }}",
                contacts.join(", ")
            ),
        );
        let run = simulate_by(&spec, "0.3", "dop853", "1e-9");
        is_good(&run);
        let rolls = events(&run, "slips");
        let rolls = rolls.iter().filter(|e| e["contact"] == "f0.rolling");
        assert_eq!(rolls.count(), 1, "{run:#}");
        run
    });
    for coordinate in ["x0", "p0", "x1", "p1", "x2", "y2", "x3", "y3"] {
        let [one, other] = [0, 1].map(|i| number(&runs[i]["q"][coordinate]));
        close(one, other, 1e-9);
    }
}
