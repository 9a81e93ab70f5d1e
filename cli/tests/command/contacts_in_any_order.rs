//! The motion does not depend on the order in which a spec lists its contacts.

use serde_json::Value;

use crate::support::{Scratch, lagrangian};

/// Discs and boxes of different sizes that fall between walls and onto each other, with friction and restitution of their own.
const FALLING: &str = "machine Falling in plane {
    parameters { m[i in 1..5]: kg = 0.5 + 0.3*i, r[i in 1..5]: m = 0.04 + 0.01*i, L: m = 0.35, mu_0: 1 = 0.6, g: m/s^2 = 9.81 }
    coordinates {
        x[i in 1..5]: m = 0.11*(i - 3) + 0.01*sin(i), y[i in 1..5]: m = 0.2 + 0.09*i, p[i in 1..5]: rad = 0.2*i,
        der(x[1]): m/s = 0.9, der(x[4]): m/s = -1.1, der(p[2]): rad/s = 3,
    }
    frames { left = ground.shift(-L, 0).turn(-pi/2), right = ground.shift(L, 0).turn(pi/2) }
    bodies { disc[i in 1..5] { mass: m[i], inertia: m[i]*r[i]^2/2, at: (x[i], y[i]), angle: p[i] } }
    circles { rim[i in 1..5] { on: disc[i], center: (0, 0), radius: r[i] } }
    gravity (0, -g);
    contacts {
        floor[i in 1..5] { circle: rim[i], along: ground, restitution: 0.2, friction: 0.4, static_friction: mu_0 },
        west[i in 1..5] { circle: rim[i], along: left, restitution: 0.5, friction: 0.1 },
        east[i in 1..5] { circle: rim[i], along: right, restitution: 0, friction: 0.8, static_friction: 1.2 },
        pair { circles: rim, restitution: 0.3, friction: 0.3, static_friction: mu_0 },
    }
}";

/// A box that tips and slides on another one, in space on four feet, and in the plane.
const FEET: &str = "machine Feet in space {
    parameters { m: kg = 2, a: m = 0.1, b: m = 0.07, h: m = 0.06, tilt: rad = 0.15, mu: 1 = 0.3, g: m/s^2 = 9.81 }
    coordinates {
        x: m, y: m, z: m = 0.1, yaw: rad, pitch: rad = tilt, roll: rad = 0.1,
        der(x): m/s = 0.6, der(yaw): rad/s = 2,
    }
    frames { held = ground.shift(x, y, z).turn(z, yaw).turn(y, pitch).turn(x, roll), slope = ground.turn(y, 0.2) }
    bodies { box { mass: m, inertia: (m*(b^2 + h^2)/3, m*(a^2 + h^2)/3, m*(a^2 + b^2)/3), frame: held } }
    gravity (0, 0, -g);
    contacts {
        front { corners: ((a, b, -h), (a, -b, -h)), on: held, along: slope, restitution: 0.2, friction: mu, static_friction: 1.3*mu },
        back { corners: ((-a, b, -h), (-a, -b, -h)), on: held, along: slope, restitution: 0, friction: mu },
        top { corners: ((-a, b, h), (-a, -b, h)), on: held, along: slope, restitution: 0.4, friction: 0.5*mu },
    }
}";

fn run(text: &str, until: &str, method: &[&str]) -> Value {
    let spec = Scratch::new("order.machine", text);
    let mut arguments = vec!["simulate", spec.path(), "--until", until, "--json"];
    arguments.extend(method);
    let output = lagrangian(&arguments);
    let run: Value = serde_json::from_slice(&output.stdout).expect("a document");
    assert_eq!(run["error"], Value::Null, "{run:#}");
    run
}

/// The lines of the section of contacts, in the opposite order.
fn reversed(text: &str) -> String {
    let (before, section) = text.split_once("contacts {\n").expect("contacts");
    let (section, after) = section
        .split_once("\n    }\n")
        .expect("the end of the section");
    let lines: Vec<&str> = section.lines().rev().collect();
    format!("{before}contacts {{\n{}\n    }}\n{after}", lines.join("\n"))
}

/// Coordinates and rates at the end are the same to the bit: by events, by time stepping, and where a run chooses.
#[test]
fn two_orders_of_contacts_give_one_motion() {
    let stepping: &[&str] = &["--method", "moreau", "--longest-step", "1e-3"];
    for (text, until) in [(FALLING, "0.8"), (FEET, "0.6")] {
        let other = reversed(text);
        assert_ne!(other, text);
        for method in [&["--method", "dop853"], stepping, &[]] {
            let [one, two] = [text, &other].map(|text| run(text, until, method));
            let count = |run: &Value| run["contact_events"].as_array().map(Vec::len);
            assert!(count(&one) > Some(10), "{one:#}");
            assert_eq!(count(&one), count(&two), "{method:?}");
            assert_eq!(one["q"], two["q"], "{method:?}");
            assert_eq!(one["v"], two["v"], "{method:?}");
        }
    }
}
