//! The motion does not depend on the order in which a spec lists its contacts.

use serde_json::Value;

use crate::support::{Scratch, lagrangian};

/// Discs and boxes of different sizes that fall between walls and onto each other, with friction and restitution of their own.
const FALLING: &str = "machine Falling in plane {
    parameters { m[i in 1..5]: kg = 0.5 + 0.3*i, r[i in 1..5]: m = 0.04 + 0.01*i, L: m = 0.35, mu_0: 1 = 0.6, g: m/s^2 = 9.81 }
    coordinates {
        x[i in 1..5]: m = 0.11*(i - 3) + 0.01*sin(i), y[i in 1..5]: m = 0.1 + 0.15*i, p[i in 1..5]: rad = 0.2*i,
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

/// Numbers between two bounds that look drawn at random.
pub(crate) struct Drawn(u64);

impl Drawn {
    pub(crate) fn new(seed: u64) -> Drawn {
        Drawn(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1)
    }

    pub(crate) fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        low + (high - low) * (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }
}

/// Discs or boxes that are thrown into a box without a lid, each with its own restitution and friction, and the energy by which an error of the balance is measured.
fn scene(seed: u64, boxes: bool) -> (String, f64) {
    let mut drawn = Drawn::new(seed);
    let (mut coordinates, mut bodies, mut circles, mut contacts) =
        (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    let mut frames = Vec::new();
    let mut energy = 0.0;
    let count = 3 + seed as usize % 3;
    let mut law = {
        let mut drawn = Drawn(seed + 77);
        move || {
            let (e, mu) = (drawn.between(-0.3, 0.8).max(0.0), drawn.between(0.05, 0.8));
            let more = drawn.between(0.8, 1.6).max(1.0);
            format!(
                "restitution: {e:.4}, friction: {mu:.4}, static_friction: {:.4}",
                mu * more
            )
        }
    };
    for k in 0..count {
        let (row, place) = (k / 2, k % 2);
        let x = 0.4 * place as f64 - 0.2 + drawn.between(-0.03, 0.03);
        let y = 0.2 + 0.3 * row as f64 + drawn.between(0.0, 0.05);
        let [vx, vy, w] = [0; 3].map(|_| drawn.between(-1.5, 1.5));
        let (m, r) = (drawn.between(0.5, 2.0), drawn.between(0.06, 0.1));
        energy += m * (9.81 + 0.5 * (vx * vx + vy * vy));
        coordinates.push(format!(
            "x{k}: m = {x:.4}, y{k}: m = {y:.4}, p{k}: rad = {w:.4}, der(x{k}): m/s = {vx:.4}, der(y{k}): m/s = {vy:.4}, der(p{k}): rad/s = {w:.4}"
        ));
        frames.push(format!("f{k} = ground.shift(x{k}, y{k}).turn(p{k})"));
        let (touching, outline) = if boxes {
            let h = 0.7 * r;
            let outline = format!(
                ", outline: (({r:.4}, -{h:.4}), ({r:.4}, {h:.4}), (-{r:.4}, {h:.4}), (-{r:.4}, -{h:.4}))"
            );
            (format!("corners: outline, on: b{k}"), outline)
        } else {
            circles.push(format!(
                "c{k} {{ on: b{k}, center: (0, 0), radius: {r:.4} }}"
            ));
            (format!("circle: c{k}"), String::new())
        };
        bodies.push(format!(
            "b{k} {{ mass: {m:.4}, inertia: {:.6}, frame: f{k}{outline} }}",
            0.5 * m * r * r
        ));
        for wall in ["floor", "west", "east"] {
            contacts.push(format!(
                "        {wall}{k} {{ {touching}, along: {wall}, {} }},",
                law()
            ));
        }
        for other in 0..k {
            let pair = if boxes {
                format!("corners: outline, on: b{k}, against: outline, of: b{other}")
            } else {
                format!("circle: c{k}, outside: c{other}")
            };
            contacts.push(format!(
                "        pair{k}with{other} {{ {pair}, {} }},",
                law()
            ));
        }
    }
    let circles = match circles.join(", ") {
        none if none.is_empty() => none,
        some => format!("circles {{ {some} }}"),
    };
    let text = format!(
        "machine Thrown in plane {{
    coordinates {{ {} }}
    frames {{ floor = ground, west = ground.shift(-0.45, 0).turn(-pi/2), east = ground.shift(0.45, 0).turn(pi/2), {} }}
    bodies {{ {} }}
    {circles}
    gravity (0, -9.81);
    contacts {{\n{}\n    }}\n}}",
        coordinates.join(", "),
        frames.join(", "),
        bodies.join(", "),
        contacts.join("\n"),
    );
    (text, energy)
}

/// Whatever is thrown: a run ends, with the same motion in both orders, and its energy balance closes. Masses are constant and gravity is too, so that steps of
/// time stepping leave no residual either.
#[test]
fn what_is_thrown_comes_to_its_end_in_any_order() {
    for (seed, boxes) in [
        (1, false),
        (2, false),
        (3, false),
        (4, false),
        (1, true),
        (2, true),
    ] {
        let (text, energy) = scene(seed, boxes);
        let [one, two] = [text.clone(), reversed(&text)].map(|text| run(&text, "1", &[]));
        let residual = one["energy_residual"].as_f64().expect("a number");
        assert!(
            residual.abs() <= 1e-9 * energy,
            "{seed} {boxes}: {residual:e}\n{text}"
        );
        assert_eq!(one["q"], two["q"], "{seed} {boxes}: {text}");
        assert_eq!(one["v"], two["v"], "{seed} {boxes}: {text}");
    }
}
